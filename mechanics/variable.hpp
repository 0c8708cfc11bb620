// Joint variables: what a joint's motion is made of, and the generalised force that works on it.
#pragma once

#include <string>
#include <utility>

#include "mechanics/algebra.hpp"

namespace gamut {

/// A minimal coordinate q with rate q̇, acceleration q̈ and generalised force Q (power Q q̇).
template <class S>
struct Variable {
  Variable() = default;
  /// `variableName` is used in messages.
  explicit Variable(std::string variableName) : name(std::move(variableName)) {}

  S position = S(0.0);
  S rate = S(0.0);
  S acceleration = S(0.0);
  S force = S(0.0);
  std::string name;

 protected:
  ~Variable() = default;
};

/// An angle [rad, rad/s, rad/s², N m].
template <class S>
struct AngularVariable final : Variable<S> {
  using Variable<S>::Variable;
};

/// A displacement [m, m/s, m/s², N].
template <class S>
struct LinearVariable final : Variable<S> {
  using Variable<S>::Variable;
};

}  // namespace gamut
