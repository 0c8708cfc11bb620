// 1/a.
#pragma once

#include "scalars/operations/function.hpp"

namespace gamut {

template <>
struct Function<Op::recip> : AnyFunction {
  static constexpr Domain domain = Domain::nonzero;
  static constexpr std::string_view refusal = "division by a constant that may be zero";
  static constexpr bool isInFormulas = false;

  template <class S>
  static S of(const S& a) {
    return S(1.0) / a;
  }
  GAMUT_INLINE static FineValue fine(const DoubleDouble& a, auto fused) {
    return {detail::quotient<fused.value>({1, 0}, a), 0};
  }
  /// -d/a²
  static int derivative(auto& r, int i, int, int, int d) { return r.neg(r.mul(r.sqr(i), d)); }
  /// r a = 1
  GAMUT_INLINE static void order(auto& c, int x, int a, int, int i) {
    c.at(x, i) = c.quotient(-c.convolution(x, a, i, 0, i - 1), c.at(a, 0));
  }
};

}  // namespace gamut
