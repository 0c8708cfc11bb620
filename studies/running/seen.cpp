// Recorded apart from the study's outputs, so that these stay what they are.
#include "studies/running/seen.hpp"

#include <algorithm>
#include <span>

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

/// `what(assembly)` at a state and time of the study's motion.
template <class What>
Program recordedOf(const Machine& machine, std::size_t values, const What& what) {
  const Study& study = machine.study;
  const bool moves = study.analysis != Study::Analysis::kinematics;
  const int numbers = static_cast<int>(machine.box.size()), states = static_cast<int>(machine.states);
  return record(moves ? states : 0, moves ? numbers - states : numbers, static_cast<int>(values),
                [&](auto t, const auto& x, const auto& p, auto& y) {
                  const std::span<const Recorded> given(p);
                  Assembly<Recorded> assembly(study.mechanism, machine.freeParameters,
                                              moves ? given : given.subspan(machine.states));
                  if (study.isMotionGiven())
                    assembly.setState({}, t);
                  else
                    moves ? assembly.setMotion(x, t) : assembly.setMotion(given.first(machine.states));
                  std::ranges::copy(what(assembly), y.begin());
                });
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
  return seen;
}

}  // namespace gamut
