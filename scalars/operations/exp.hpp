// The exponential of a.
#pragma once

#include "scalars/operations/function.hpp"

namespace gamut {

template <>
struct Function<Op::exp> : AnyFunction {
  static constexpr std::string_view known = "exp 0 = 1";
  static constexpr double value = 1;

  template <class S>
  static S of(const S& a) {
    using std::exp;
    return exp(a);
  }
  static FineValue fine(const DoubleDouble& a, auto) { return detail::fineExp(a); }
  static int derivative(auto& r, int i, int, int, int d) { return r.mul(i, d); }
  /// r' = a' r
  GAMUT_INLINE static void order(auto& c, int x, int a, int, int i) { c.at(x, i) = c.slopes(a, x, i, i); }
};

}  // namespace gamut
