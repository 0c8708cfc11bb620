// Loads that do not ask how far a frame has turned about an axis through where they act.
#pragma once

#include "mechanics/axis.hpp"
#include "mechanics/frame.hpp"

namespace gamut {

template <class S>
class LoadOnAxis {
 public:
  LoadOnAxis() = default;
  LoadOnAxis(const LoadOnAxis&) = delete;
  LoadOnAxis& operator=(const LoadOnAxis&) = delete;
  virtual ~LoadOnAxis() = default;

  /// From now on it acts on `unturned`, which moves as `turned` does but for its axes (spin.hpp), if it acts on
  /// `turned`, on this axis through its origin.
  virtual void moveAhead(const Frame<S>& turned, const Axis& axis, Frame<S>& unturned) = 0;
};

}  // namespace gamut
