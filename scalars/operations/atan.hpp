// The arc tangent of a; b is the node 1 + a², the denominator of its derivative.
#pragma once

#include "scalars/operations/function.hpp"

namespace gamut {

template <>
struct Function<Op::atan> : AnyFunction {
  static constexpr std::string_view known = "atan 0 = 0";

  template <class S>
  static S of(const S& a) {
    using std::atan;
    return atan(a);
  }
  static FineValue fine(const DoubleDouble& a, auto) { return detail::fineAtan(a); }

  static constexpr bool hasDenominator = true;
  static int denominator(auto& r, int a) {
    const int square = r.sqr(a);
    return r.add(r.constant(1.0), square);
  }
  static bool isDenominator(const auto& nodes, int b, int a) { return nodes.isOnePlusSquare(b, a); }
  static std::string denominatorMessage(int b, const std::string&) {
    return "the second operand of atan is 1 plus the square of the first, which node " + std::to_string(b) + " is not";
  }
  static int derivative(auto& r, int, int, int b, int d) { return r.mul(r.recip(b), d); }
  /// r' b = a'
  GAMUT_INLINE static void order(auto& c, int x, int a, int b, int i) {
    c.at(x, i) = c.quotient(c.difference(c.at(a, i), c.slopes(x, b, i, i - 1)), c.at(b, 0));
  }
};

}  // namespace gamut
