// Closest approaches: how near two shapes come over the whole motion, when, and where.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

/// Of the output NAME.distance of a `separation`, proved: for every value of the uncertain quantities.
struct Approach {
  struct Range {
    double lower, upper;
  };

  std::size_t output = 0;
  std::string name;           ///< of the separation
  Range least{};              ///< the distance at the closest approach lies in it, in its unit
  std::vector<Range> when;    ///< which comes at a time in one of these, in order [s]
  double until = 0;           ///< s: of the motion up to this time
  bool isAtAllTimes = false;  ///< that is all of it
  /// Where the nearest points are then, x, y, z in the inertial frame, in their units, as far as they are outputs and
  /// known.
  std::array<std::optional<Range>, 3> from, to;
};

/// Of all such outputs. Where NAME.rate is an output too, times at which it cannot be zero are left out.
std::vector<Approach> approachesOf(const Results& results);

/// Each in a line: "gap.distance is least at [58.1, 60.2] mm, between 0.35 s and 0.4 s, from (…) to (…)".
std::vector<std::string> approachLines(const Results& results, const std::vector<Approach>& approaches);

}  // namespace gamut
