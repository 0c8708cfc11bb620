// Loops all of whose other coordinates are driven, each of which closes as a triangle does: at every moment they stand
// where closed forms put them, and nothing has to be followed. Directions of joints are then known, and angles but for
// whole turns: courses tell these, of the nominal machine, from which angles of other values may be half a turn away.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/angle_courses.hpp"
#include "mechanics/description/mechanism.hpp"

namespace gamut {

/// Of the angles of such loops, over times from 0 to `horizon` [s], or to where the nominal machine comes to a dead
/// point; none where not all loops are of this kind, or the nominal machine cannot be followed from the start, or turns
/// in a way that no few times of driven angles follow.
std::optional<AngleCourses> placedLoops(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                                        double horizon);

}  // namespace gamut
