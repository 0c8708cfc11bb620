// |a|; its derivative is sign a.
#pragma once

#include "scalars/operations/function.hpp"

namespace gamut {

template <>
struct Function<Op::abs> : AnyFunction {
  static constexpr bool isSmooth = false;
  static constexpr std::string_view exact = "|c|, where it is a double", even = "|-x| = |x|";

  template <class S>
  static S of(const S& a) {
    using std::abs;
    return abs(a);
  }
  static int derivative(auto& r, int, int a, int, int d) { return r.mul(r.sign(a), d); }
  /// As just after the expansion point.
  static void order(auto& c, int x, int a, int, int i) { c.at(x, i) = c.after(a, i) * c.at(a, i); }
};

}  // namespace gamut
