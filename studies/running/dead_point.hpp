// Where coordinates that close loops come to a dead point.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studies/machine.hpp"

namespace gamut {

/// A dead point of a motion.
struct DeadPoint {
  double from = 0, to = 0;                    ///< s: the motion comes to it between these
  std::vector<std::string> coordinates = {};  ///< dependent ones that may move there though all others stand still
  std::vector<std::string> others = {};       ///< that hold the loops best there, as many as depend in all
  bool isDriven = false;                      ///< nothing moves by itself, so that no force passes it
  std::vector<std::string> alike = {};        ///< loops whose rows depend on each other there: nothing passes it

  /// "the nominal motion comes to a dead point of A.angle, B.angle between 0.28 s and 0.2801 s, where they follow from
  /// no others".
  std::string sentence(std::string_view whose = "the nominal motion") const;
  /// What passes it, or how not to come to it.
  std::string advice() const;
};

/// The first up to the horizon, found along the motion of loops that are held by multipliers, between two of 400 parts
/// of it, and then of 64 parts of such a part: one that begins and ends between two of 400 is not seen. Nothing where
/// there is none, where loops are held anyhow, and it is one that they pass, and where the motion takes more than so
/// many seconds of CPU to it.
std::optional<DeadPoint> deadPointOf(const Study& study, double seconds = 5);

/// The same of the motion of these values of the uncertain quantities, of which none varies in time, that ended at this
/// time [s].
std::optional<DeadPoint> deadPointOf(const Machine& machine, std::span<const double> values, double ended,
                                     double seconds);

/// The line "file:line:column: note: what" of a dead point that is ahead; empty where there is none. Costs an
/// integration of the nominal motion, of 2 s of CPU at most.
std::string noteOfDeadPoint(const Study& study);

}  // namespace gamut
