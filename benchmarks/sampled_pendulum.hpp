// The double pendulum of all benchmarks to 3 s, 300 output times, its first angle uniform within ± 1 %, for sampling.
#pragma once

#include <utility>
#include <vector>

#include "analyses/samples/ensemble.hpp"
#include "benchmarks/double_pendulum.hpp"

namespace gamut::benchmarks {

constexpr double sampledHorizon = 3;
constexpr int sampledTimes = 300;

inline std::vector<double> outputTimes() {
  std::vector<double> times;
  for (int i = 1; i <= sampledTimes; ++i) times.push_back(sampledHorizon * i / sampledTimes);
  return times;
}

/// With these outputs of its states.
inline UncertainMotion sampledPendulum(Program outputs) {
  const Box start = doublePendulumStart(0.01);
  UncertainMotion pendulum;
  pendulum.motion.f = doublePendulumProgram();
  pendulum.motion.g = std::move(outputs);
  pendulum.motion.times = outputTimes();
  for (const Interval& value : start) pendulum.nominal.push_back(midpoint(value));
  const double nominal = pendulum.nominal[0];
  pendulum.uncertain.push_back({"first angle", start[0], nominal, Distribution::uniform(start[0]),
                                Membership::triangular(start[0].lower(), nominal, start[0].upper())});
  pendulum.slot = {0};
  return pendulum;
}

}  // namespace gamut::benchmarks
