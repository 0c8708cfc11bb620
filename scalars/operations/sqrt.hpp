// The square root of a.
#pragma once

#include "scalars/operations/function.hpp"

namespace gamut {

template <>
struct Function<Op::sqrt> : AnyFunction {
  static constexpr Domain domain = Domain::nonnegative;
  static constexpr std::string_view refusal = "square root of a constant that may be negative";
  static constexpr std::string_view exact = "√c, where it is a double";

  template <class S>
  static S of(const S& a) {
    using std::sqrt;
    return sqrt(a);
  }
  GAMUT_INLINE static FineValue fine(const DoubleDouble& a, auto fused) {
    return {detail::squareRoot<fused.value>(a), 0};
  }
  /// d/(2√a)
  static int derivative(auto& r, int i, int, int, int d) {
    const int inverse = r.recip(i);
    return r.mul(r.mul(r.constant(0.5), inverse), d);
  }
  /// r r = a
  GAMUT_INLINE static void order(auto& c, int x, int a, int, int i) {
    c.at(x, i) = c.quotient(c.half(c.difference(c.at(a, i), c.convolution(x, x, i, 1, i - 1))), c.at(x, 0));
  }
};

}  // namespace gamut
