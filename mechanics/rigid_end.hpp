// A rigid end of a joint's travel, as assembled.
#pragma once

#include <string>

namespace gamut {

/// What strikes it leaves it at `restitution` times its speed.
template <class S>
struct RigidEnd {
  std::string coordinate;  ///< its full name
  S at = S(0.0), restitution = S(1.0);
  bool isUpper = false;     ///< the coordinate stays below `at`
  bool startsAway = false;  ///< the motion starts away from it, not towards it
};

}  // namespace gamut
