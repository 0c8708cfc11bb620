// What is tried at last: one piece of one degree after the other, as somebody would who fixes the degree by hand.
#pragma once

#include <memory>
#include <vector>

#include "analyses/flow/cause.hpp"
#include "analyses/flow/flow.hpp"
#include "analyses/flow/step/scales.hpp"
#include "analyses/flow/task.hpp"

namespace gamut {

/// `best` met with whole boxes of degree 3, 4, 5 and 6, which are not bisected, where rounds ended early and a higher
/// degree may let them go on, or where quantities were too many to be bisected for tightness (`limit`). Each is run if
/// it is expected to take no more than is left of what the rounds took (`work`), or of half a minute of counted work
/// (of five seconds, if they arrived). `looseness` as refine tells it. Nothing is tried with a degree that was stated.
Tube withPlainDegrees(const FlowQuestion& question, const Box& box, const std::vector<Box>& levels,
                      std::shared_ptr<const FlowScales> scales, Tube best, const FlowCause& limit, double work,
                      double& looseness);

}  // namespace gamut
