// The hyperbolic tangent of a, and 1 - tanh² a, its derivative, computed together.
#pragma once

#include "scalars/operations/function.hpp"

namespace gamut {

template <>
struct Function<Op::tanh> : AnyFunction {
  static constexpr std::string_view known = "tanh 0 = 0", odd = "tanh(-x) = -tanh x";

  template <class S>
  static S of(const S& a) {
    using std::tanh;
    return tanh(a);
  }
  template <class S>
  static void both(const S& a, S& tangent, S& slope) {
    tangent = of(a);
    slope = S(1.0) - square(tangent);
  }
  static int derivative(auto& r, int i, int, int, int d) { return r.mul(i + 1, d); }
  /// t' = a' s, s = 1 - t²
  static void order(auto& c, int x, int a, int, int i) {
    c.at(x, i) = c.slopes(a, x + 1, i, i);
    c.at(x + 1, i) = -c.convolution(x, x, i, 0, i);
  }
};

template <>
struct Function<Op::sech2> : AnyFunction {
  static constexpr std::string_view known = "sech² 0 = 1", even = "sech²(-x) = sech² x";
  static constexpr std::string_view before = "sech(", behind = ")^2";
  static constexpr double value = 1;
  static constexpr bool isInFormulas = false;
  /// (1 - t²)' = -2 t t', t' = sech²
  static int derivative(auto& r, int i, int, int, int d) {
    const int product = r.mul(i - 1, i);
    return r.mul(r.constant(-2.0), r.mul(product, d));
  }
};

}  // namespace gamut
