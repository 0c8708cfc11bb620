// Sine and cosine of a, computed together.
#pragma once

#include <span>
#include <type_traits>

#include "scalars/elementary/vector_functions.hpp"
#include "scalars/operations/function.hpp"

namespace gamut {

template <>
struct Function<Op::sin> : AnyFunction {
  static constexpr std::string_view noun = "sine", known = "sin 0 = 0", odd = "sin(-x) = -sin x";
  static constexpr bool pairsByItself = true;

  template <class S>
  static void both(const S& a, S& sine, S& cosine) {
    using std::cos, std::sin;
    if constexpr (requires { requires std::is_same_v<decltype(sinCos(a).sin), S>; }) {
      const auto both = sinCos(a);
      sine = both.sin;
      cosine = both.cos;
    } else {
      sine = sin(a);
      cosine = cos(a);
    }
  }
  /// Of a sample, and of many at once: the same to the bit.
  static void ofSample(double a, double& sine, double& cosine) {
    const SineCosine both = sineCosine(a);
    sine = both.sine;
    cosine = both.cosine;
  }
  static void ofPack(VectorUnit unit, std::span<const double> a, std::span<double> sine, std::span<double> cosine) {
    sineCosine(unit, a, sine, cosine);
  }
  static void fine(const DoubleDouble& a, FineValue& sine, FineValue& cosine) {
    const detail::FineSinCos both = detail::fineSinCos(a);
    sine = both.sin;
    cosine = both.cos;
  }
  static int derivative(auto& r, int i, int, int, int d) { return r.mul(i + 1, d); }
  /// s' = a' c, c' = -a' s
  GAMUT_INLINE static void order(auto& c, int x, int a, int, int i) {
    c.at(x, i) = c.slopes(a, x + 1, i, i);
    c.at(x + 1, i) = -c.slopes(a, x, i, i);
  }
};

template <>
struct Function<Op::cos> : AnyFunction {
  static constexpr std::string_view noun = "cosine", known = "cos 0 = 1", even = "cos(-x) = cos x";
  static constexpr double value = 1;
  static int derivative(auto& r, int i, int, int, int d) { return r.neg(r.mul(i - 1, d)); }
};

}  // namespace gamut
