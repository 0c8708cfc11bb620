// The nominal motion in doubles; the side on which coordinates close their loops changes at a dead point.
#include "studies/running/dead_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "analyses/samples/witness.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/equations/loop_rows.hpp"
#include "mechanics/model.hpp"

namespace gamut {
namespace {

/// Its loops held, every number nominal.
struct NominalMotion {
  std::vector<double> trajectory;  // all states at each time
  std::size_t reached = 0;         // times
  std::vector<double> times;
  bool isWhole = true;  // else the last times come close to where it ends
};

NominalMotion nominalMotion(const Mechanism& held, double horizon) {
  constexpr double seconds = 5;  // of CPU
  const std::vector<std::string> names = held.stateNames();
  constexpr int parts = 400;  // of the horizon
  NominalMotion found;
  for (int i = 1; i <= parts; ++i) found.times.push_back(i == parts ? horizon : horizon * i / parts);
  Motion motion;
  motion.f = recordMotion(held, {}, Formulation::articulated);
  motion.g = recordOutputs(held, {}, names);
  std::vector<double> start = Assembly<double>(held).initialState();  // of what loops follow from, differences
  std::vector<std::string> dependents = held.dependents(), rates = held.dependentRates();
  dependents.insert(dependents.end(), rates.begin(), rates.end());
  for (const std::string& name : dependents)
    start[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())] = 0;
  const auto follow = [&] {
    motion.times = found.times;
    found.trajectory.resize(names.size() * found.times.size());
    const Integration run = Witness(motion).integrate(start, {}, found.trajectory, seconds);
    found.reached = run.times;
    return run.reached;
  };
  const double end = follow();
  found.isWhole = found.reached == found.times.size();
  if (found.isWhole) return found;
  found.times.resize(found.reached);
  for (const double before : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7})
    if (const double time = (1 - before) * end; time > (found.times.empty() ? 0.0 : found.times.back()))
      found.times.push_back(time);
  if (!found.times.empty()) follow();
  return found;
}

std::string listed(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

}  // namespace

std::optional<DeadPoint> deadPointOf(const Study& study) {
  if (!study.moves() || !study.mechanism.isClosed()) return std::nullopt;
  Mechanism held = study.mechanism;
  held.holdLoops();
  const bool isDriven = static_cast<std::size_t>(held.degreesOfFreedom()) == held.dependents().size();
  if (study.mechanism.areLoopsHeld() && !isDriven) return std::nullopt;
  const NominalMotion motion = nominalMotion(held, study.horizon);
  const std::size_t states = held.stateNames().size();
  Assembly<double> assembly(held);
  const auto gripAt = [&] { return gripOfLoops(held, assembly.system()); };
  LoopGrip before = gripAt();
  const double first = std::abs(before.determinant);
  double time = 0;
  for (std::size_t i = 0; i < motion.reached; ++i) {
    assembly.setState(std::span(motion.trajectory).subspan(i * states, states), motion.times[i]);
    LoopGrip grip = gripAt();
    constexpr double dead = 1e-4, deadAtEnd = 1e-2;  // come to as the root of time
    const double own = std::abs(grip.determinant), other = std::abs(before.determinant);
    const bool isPassed = grip.determinant * before.determinant < 0,
               isLast = !motion.isWhole && i + 1 == motion.reached;
    if (isPassed || own < (isLast ? deadAtEnd : dead) * first) {
      const double part = isPassed ? other / (other + own) : 1.0;
      LoopGrip& nearer = isPassed && other < own ? before : grip;
      return DeadPoint{time + part * (motion.times[i] - time), std::move(nearer.loose), std::move(nearer.best),
                       isDriven};
    }
    before = std::move(grip);
    time = motion.times[i];
  }
  return std::nullopt;
}

std::string DeadPoint::sentence() const {
  return fmt::format("the nominal motion comes to a dead point of {} at about {:.3g} s, where {} from no others",
                     listed(coordinates), time, coordinates.size() == 1 ? "it follows" : "they follow");
}

std::string DeadPoint::advice() const {
  std::string names;
  for (const std::string& name : others) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  if (isDriven) return "a drive of another joint, or a motion that stays off the dead point";
  return fmt::format("mechanism.loops = \"multipliers\"{}",
                     names.empty() ? "" : fmt::format(", or dependent = [{}], which are firm there", names));
}

}  // namespace gamut
