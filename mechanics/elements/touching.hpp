// Where a wheel, a ball or an edge touches a plane, and what is measured there.
#pragma once

#include "mechanics/assembler.hpp"
#include "mechanics/elements/gliding.hpp"

namespace gamut {

inline void describeTouching(Fields& f) {
  f.measureSolved({"normal_force", "N", "of the plane, which presses if it is above 0"});
  f.measureSolved({"squared_grip", "1", "the square of the coefficient of friction that it needs, at least"});
}

/// `touching`: the frame, in the axes of the plane but for a turn about its normal, that all of the wheel hangs on.
template <class S>
void measureTouching(Assembler<S>& a, const Frame<S>& touching) {
  a.measureSolved("normal_force", [&touching] { return S(-touching.f[2]); });
  a.measureSolved("squared_grip", [&touching] {  // smooth where there is no friction, as its root is not
    return S(S(square(touching.f[0]) + square(touching.f[1])) / S(square(touching.f[2])));
  });
}

/// `x` and `y`, which start there.
inline void describePlace(Fields& f, const std::string& meaning, Expression& x, Expression& y) {
  f.position({"x", "m", "at the start: " + meaning + ", in `from`"}, x);
  f.position({"y", "m", "likewise"}, y);
  f.measure({"x_rate", "m/s", "at which `x` changes"});
  f.measure({"y_rate", "m/s", "at which `y` changes"});
}

template <class S>
PlaceInPlane<S> placeOf(Assembler<S>& a, const Signal<S>& xRate, const Signal<S>& yRate) {
  a.measure("x_rate", xRate);
  a.measure("y_rate", yRate);
  return {&a.position("x", xRate), &a.position("y", yRate)};
}

template <class S>
PlaceInPlane<S> placeOf(Assembler<S>& a, const Gliding<S>& gliding) {
  return placeOf<S>(
      a, [gliding] { return gliding.placeRate(0); }, [gliding] { return gliding.placeRate(1); });
}

}  // namespace gamut
