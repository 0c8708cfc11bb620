// Motions with known solutions, shared by the tests of sampling and comparison.
#pragma once

#include <vector>

#include "analyses/samples/ensemble.hpp"
#include "scalars/recorded.hpp"

namespace gamut::testing_motions {

inline std::vector<double> timesTo(double horizon, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(horizon * i / count);
  return times;
}

inline Uncertain uniformly(const char* name, double lower, double nominal, double upper) {
  return {name,
          {lower, upper},
          nominal,
          Distribution::uniform({lower, upper}),
          Membership::triangular(lower, nominal, upper)};
}

/// x' = -p x, x(0) = 1, p in [0.5, 1.5]; output x = exp(-p t).
inline UncertainMotion decay(double horizon = 2, int count = 40) {
  UncertainMotion system;
  system.motion.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = -p[0] * x[0]; });
  system.motion.g = record(1, 1, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  system.motion.times = timesTo(horizon, count);
  system.nominal = {1.0, 1.0};
  system.uncertain = {uniformly("rate", 0.5, 1.0, 1.5)};
  system.slot = {1};
  return system;
}

/// x'' = -w² x, from x(0) in [0.5, 1.5] at rest, w in [1, 3]; outputs x = x(0) cos wt and x' = -w x(0) sin wt.
inline UncertainMotion oscillator(double horizon = 3, int count = 30) {
  UncertainMotion system;
  system.motion.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sqr(p[0]) * x[0];
  });
  system.motion.g = record(2, 1, 2, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0];
    y[1] = x[1];
  });
  system.motion.times = timesTo(horizon, count);
  system.nominal = {1.0, 0.0, 2.0};
  system.uncertain = {uniformly("frequency", 1.0, 2.0, 3.0), uniformly("amplitude", 0.5, 1.0, 1.5)};
  system.slot = {2, 0};
  return system;
}

/// No states: y = 2 p + 1 + t for p in [0, 1].
inline UncertainMotion line() {
  UncertainMotion system;
  system.motion.f = record(0, 1, [](auto, const auto&, const auto&, auto&) {});
  system.motion.g = record(0, 1, 1, [](auto t, const auto&, const auto& p, auto& y) { y[0] = 2.0 * p[0] + 1.0 + t; });
  system.motion.times = {0, 1};
  system.nominal = {0.5};
  system.uncertain = {uniformly("p", 0, 0.5, 1)};
  system.slot = {0};
  return system;
}

}  // namespace gamut::testing_motions
