// Of many quantities not all corners of a box can be sampled: those are, besides, in which outputs are extreme as far
// as they depend linearly on the quantities, which the signs of their differences along each axis name.
#pragma once

#include <cstddef>
#include <vector>

#include "analyses/samples/sample_block.hpp"
#include "analyses/samples/transformation.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// So many points at most.
inline constexpr std::size_t mostNamedCorners = 1024;

/// Values that lie at the lower, then at the upper end of the range of each quantity, all others nominal.
std::vector<std::vector<double>> axisPoints(const Box& range, const std::vector<double>& nominal);

/// The corners of all boxes in which outputs are least and greatest by the trajectories of the axis points, each once:
/// of all outputs at output times spread over all, so many as there may be.
TransformationPoints namedCorners(const SampleBlock& alongAxes, const std::vector<Box>& boxes, std::size_t times,
                                  std::size_t outputs);

}  // namespace gamut
