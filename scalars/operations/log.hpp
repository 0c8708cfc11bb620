// The natural logarithm of a; the denominator of its derivative is a.
#pragma once

#include "scalars/operations/function.hpp"

namespace gamut {

template <>
struct Function<Op::log> : AnyFunction {
  static constexpr Domain domain = Domain::positive;
  static constexpr std::string_view refusal = "logarithm of a constant that may not be positive";
  static constexpr std::string_view known = "log 1 = 0";
  static constexpr double point = 1;

  template <class S>
  static S of(const S& a) {
    using std::log;
    return log(a);
  }
  static FineValue fine(const DoubleDouble& a, auto) { return detail::fineLog(a); }

  static constexpr bool hasDenominator = true;
  static int denominator(auto&, int a) { return a; }
  static bool isDenominator(const auto&, int b, int a) { return b == a; }
  static std::string denominatorMessage(int, const std::string& line) {
    return "both operands of log are the same node, not " + line;
  }
  static int derivative(auto& r, int, int a, int, int d) { return r.mul(r.recip(a), d); }
  /// r' b = a'
  GAMUT_INLINE static void order(auto& c, int x, int a, int b, int i) {
    c.at(x, i) = c.quotient(c.difference(c.at(a, i), c.slopes(x, b, i, i - 1)), c.at(b, 0));
  }
};

}  // namespace gamut
