// -1, 0 or 1 as a is below, at or above 0; its derivative is 0. In ẋ = f it stands for every value of [-1, 1] where a
// is 0, as in Filippov's solutions.
#pragma once

#include "scalars/operations/function.hpp"

namespace gamut {

template <>
struct Function<Op::sign> : AnyFunction {
  static constexpr bool isSmooth = false;
  static constexpr std::string_view exact = "sign c, where it is known", odd = "sign(-x) = -sign x";

  template <class S>
  static S of(const S& a) {
    return signOf(a);
  }
  static int derivative(auto&, int, int, int, int) { return -1; }
  static void order(auto& c, int x, int, int, int i) { c.at(x, i) = 0.0; }
};

}  // namespace gamut
