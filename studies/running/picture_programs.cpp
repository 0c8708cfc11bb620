// Recorded apart from the study's outputs, so that these stay what they are.
#include "studies/running/picture_programs.hpp"

#include <algorithm>
#include <iterator>

#include "mechanics/assembly.hpp"
#include "scalars/recorded.hpp"
#include "studies/results/interval.hpp"

namespace gamut {
namespace {

std::vector<std::size_t> seenTimes(std::size_t times, std::size_t points) {
  const std::size_t most = std::clamp(mostSeenPlaces / std::max<std::size_t>(points, 1), leastSeenTimes, mostSeenTimes);
  const std::size_t every = times <= most ? 1 : (times - 1 + most - 2) / (most - 1);
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < times; i += every) seen.push_back(i);
  if (seen.back() + 1 < times) seen.push_back(times - 1);
  return seen;
}

}  // namespace

Seen whatIsSeen(const Machine& machine) {
  const Study& study = machine.study;
  Seen seen;
  seen.skeleton = skeletonOf(study.mechanism, machine.freeParameters);
  if (seen.empty()) return seen;
  const Skeleton& skeleton = seen.skeleton;
  const std::size_t points = skeleton.points.size();
  const auto moving = static_cast<std::size_t>(
      std::ranges::count_if(skeleton.points, [](const Skeleton::Point& point) { return !point.isFixed; }));
  seen.times = seenTimes(study.times.size(), moving);
  for (const std::size_t i : seen.times) seen.at.push_back(study.times[i]);
  seen.isEnclosed = study.asksFor<IntervalResult>() && moving <= mostEnclosedPoints;
  using Moved = Assembly<Recorded>;
  seen.positions = recordedOf(machine, 3 * points, [&](const Moved& moved) { return positionsOf(moved, skeleton); });
  seen.velocities = recordedOf(machine, 3 * points, [&](const Moved& moved) { return velocitiesOf(moved, skeleton); });
  seen.drawn = recordedOf(machine, 3 * (points + skeleton.axes.size()), [&](const Moved& moved) {
    std::vector<Recorded> all = positionsOf(moved, skeleton);
    std::ranges::copy(axesOf(moved, skeleton), std::back_inserter(all));
    return all;
  });
  const auto isProfile = [](const Skeleton::Part& part) { return part.kind == Skeleton::Kind::profile; };
  const auto profiles = static_cast<std::size_t>(std::ranges::count_if(skeleton.parts, isProfile));
  if (profiles == 0) return seen;
  seen.heights = recordedOf(machine, 2 * profiles, [&](const Moved& moved) {
    std::vector<Recorded> all;
    for (const Skeleton::Part& part : skeleton.parts) {
      if (!isProfile(part)) continue;
      all.push_back(moved.output(part.height));
      all.push_back(moved.number(part.speed));
    }
    return all;
  });
  return seen;
}

}  // namespace gamut
