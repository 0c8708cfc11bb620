// Where coordinates that close loops come to a dead point.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/machine.hpp"

namespace gamut {

/// A dead point of the nominal motion.
struct DeadPoint {
  double time = 0;                            ///< s, about
  std::vector<std::string> coordinates = {};  ///< dependent ones that may move there though all others stand still
  std::vector<std::string> others = {};       ///< that hold the loops best there, as many as depend in all
  bool isDriven = false;                      ///< nothing moves by itself, so that no force passes it

  /// "the nominal motion comes to a dead point of A.angle, B.angle at about 0.28 s, where they follow from no others".
  std::string sentence() const;
  /// What passes it.
  std::string advice() const;
};

/// The first up to the horizon, found along the motion of loops that are held by multipliers. Nothing where there is
/// none, or loops are held anyhow, and something moves by itself.
std::optional<DeadPoint> deadPointOf(const Study& study);

}  // namespace gamut
