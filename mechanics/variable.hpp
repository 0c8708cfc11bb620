// What moves a joint: speeds, with the generalised forces that work on them, and positions.
#pragma once

#include <string>
#include <utility>

#include "mechanics/algebra.hpp"

namespace gamut {

/// A generalised speed u with its acceleration u̇ and its generalised force Q (power Q u): what equations of motion are
/// about.
template <class S>
struct Speed {
  Speed() = default;
  /// `speedName` is used in messages.
  explicit Speed(std::string speedName) : name(std::move(speedName)) {}
  Speed(const Speed&) = delete;
  Speed& operator=(const Speed&) = delete;

  S rate = S(0.0);
  S acceleration = S(0.0);
  S force = S(0.0);
  std::string name;
};

/// A coordinate q whose rate is its speed, q̇ = u: an angle [rad, rad/s, rad/s², N m] or a displacement [m, m/s, m/s²,
/// N].
template <class S>
struct Variable : Speed<S> {
  using Speed<S>::Speed;

  S position = S(0.0);
};

}  // namespace gamut
