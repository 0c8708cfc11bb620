// The published double pendulum that all benchmarks move: two point masses of 1 kg on massless rods of 1 m, the second
// angle relative to the first; ψ1(0) = 3π/4 (± 1 % where uncertain), ψ2(0) = -11π/20, rates 0.43 and 0.67 rad/s.
// Equations: Rauh, Auer, Hofer, ValEncIA-IVP: A Comparison with Other Initial Value Problem Solvers (2006), eq. (24).
#pragma once

#include <array>
#include <cmath>

#include "scalars/interval.hpp"
#include "scalars/recorded.hpp"
#include "scalars/traits.hpp"

namespace gamut::benchmarks {

/// dx = f(x) for x = (ψ1, ψ2, ψ1', ψ2'), by Cramer's rule on the 2 x 2 system of eq. (24) with m = l = 1 and gravity g.
template <class S, class States, class Rates>
void doublePendulum(const S& g, const States& x, Rates& dx) {
  using std::cos, std::sin;
  const S cos2 = cos(x[1]);
  const S sin2 = sin(x[1]);
  const S sum = x[2] + x[3];
  const S m12 = 1.0 + cos2;
  const S m11 = 1.0 + m12;
  const S b1 = sin2 * sum * sum - 2.0 * g * sin(x[0]);
  const S b2 = -(g * sin(x[0] + x[1])) - sin2 * x[2] * x[2];
  const S determinant = m11 - cos2 * m12;
  dx[0] = x[2];
  dx[1] = x[3];
  dx[2] = (b1 - cos2 * b2) / determinant;
  dx[3] = (m11 * b2 - m12 * b1) / determinant;
}

inline Program doublePendulumProgram() {
  return record(4, 0, [](auto, const auto& x, const auto&, auto& dx) {
    doublePendulum(constant<Recorded>(Interval("9.81")), x, dx);
  });
}

/// The initial box; `relativeRadius` of the first angle, 0 for a thin start.
inline Box doublePendulumStart(double relativeRadius = 0) {
  const Interval first = 0.75 * pi();
  return {first * Interval(1 - relativeRadius, 1 + relativeRadius), -(Interval(11) * pi()) / 20, Interval("0.43"),
          Interval("0.67")};
}

/// The baseline: one motion from the nominal start to `horizon` (s), in plain doubles by the classical Runge-Kutta
/// method with steps of 1 ms. Returns the last state.
inline std::array<double, 4> plainTrajectory(double horizon) {
  using State = std::array<double, 4>;
  constexpr double step = 1e-3, g = 9.81;
  const auto moved = [](const State& x, const State& rate, double time) {
    State y{};
    for (std::size_t i = 0; i < 4; ++i) y[i] = x[i] + time * rate[i];
    return y;
  };
  const Box start = doublePendulumStart();
  State x{}, k1{}, k2{}, k3{}, k4{};
  for (std::size_t i = 0; i < 4; ++i) x[i] = midpoint(start[i]);
  for (long i = 0, steps = std::lround(horizon / step); i < steps; ++i) {
    doublePendulum(g, x, k1);
    doublePendulum(g, moved(x, k1, step / 2), k2);
    doublePendulum(g, moved(x, k2, step / 2), k3);
    doublePendulum(g, moved(x, k3, step), k4);
    for (std::size_t j = 0; j < 4; ++j) x[j] += step / 6 * (k1[j] + 2 * (k2[j] + k3[j]) + k4[j]);
  }
  return x;
}

}  // namespace gamut::benchmarks
