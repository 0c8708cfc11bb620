// Directions across an axis, for elements that hold, or let move, what lies across it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/rotation.hpp"

namespace gamut {

/// Two unit vectors that are perpendicular to the axis, and to each other: of an aligned axis those of the two
/// coordinate axes that follow it cyclically, whatever its sign.
template <class S>
std::array<Vector3<S>, 2> across(const Axis& axis) {
  if (axis.isAligned()) {
    std::array<Vector3<S>, 2> unit;
    for (int i = 0; i < 2; ++i) {
      unit[i] = zeroVector<S>();
      unit[i][(axis.index() + 1 + i) % 3] = S(1.0);
    }
    return unit;
  }
  const auto direction = axis.direction();
  const auto least =
      std::ranges::min_element(direction, {}, [](double c) { return c < 0 ? -c : c; }) - direction.begin();
  Vector3<S> other = zeroVector<S>();
  other[least] = S(1.0);
  using std::sqrt;
  const Vector3<S> u = axis.unit<S>(), first = u.cross(other) / S(sqrt(S(S(1.0) - square(u[least]))));
  return {first, u.cross(first)};
}

}  // namespace gamut
