// The validated flow of systems with two to ten uncertain quantities, as studies have them, all by themselves (the
// defaults choose). Baseline of the same run: one trajectory of the same system in plain doubles.
// Counters: time reached (s), pieces, and the greatest overestimation of a state at the end: width of the enclosure
// over that of the trajectories from all corners of the box and from the best of their neighbours (coordinate ascent).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/recorded.hpp"

namespace gamut::benchmarks {
namespace {

struct Case {
  std::string name;
  Program f;
  std::vector<double> nominal;  // states, then parameters
  std::vector<double> radius;   // likewise; 0: known
  double horizon = 1;

  Box box() const {
    Box box;
    for (std::size_t i = 0; i < nominal.size(); ++i)
      box.push_back(radius[i] > 0 ? Interval(nominal[i] - radius[i], nominal[i] + radius[i]) : Interval(nominal[i]));
    return box;
  }
};

/// The states at the horizon, by the classical Runge-Kutta method.
std::vector<double> trajectory(const Case& c, std::span<const double> start, int steps = 2000) {
  Evaluator<double> f(c.f);
  const auto n = static_cast<std::size_t>(c.f.states());
  f.setParameters(start.subspan(n));
  std::vector<double> x(start.begin(), start.begin() + static_cast<std::ptrdiff_t>(n));
  const double h = c.horizon / steps;
  const auto moved = [&](const std::vector<double>& k, double by) {
    std::vector<double> y = x;
    for (std::size_t i = 0; i < n; ++i) y[i] += by * k[i];
    return y;
  };
  for (int step = 0; step < steps; ++step) {
    const double t = h * step;
    const std::vector<double> a = f(t, x), b = f(t + h / 2, moved(a, h / 2)), d = f(t + h / 2, moved(b, h / 2)),
                              e = f(t + h, moved(d, h));
    for (std::size_t i = 0; i < n; ++i) x[i] += h / 6 * (a[i] + 2 * b[i] + 2 * d[i] + e[i]);
  }
  return x;
}

/// Width of every state's range at the horizon, from inside.
std::vector<double> sampledWidths(const Case& c) {
  std::vector<std::size_t> uncertain;
  for (std::size_t i = 0; i < c.radius.size(); ++i)
    if (c.radius[i] > 0) uncertain.push_back(i);
  const auto n = static_cast<std::size_t>(c.f.states());
  std::map<std::vector<int>, std::vector<double>> known;  // place of each uncertain quantity: -4 … 4
  const auto at = [&](const std::vector<int>& place) -> const std::vector<double>& {
    std::vector<double>& x = known[place];
    if (!x.empty()) return x;
    std::vector<double> start = c.nominal;
    for (std::size_t k = 0; k < uncertain.size(); ++k) start[uncertain[k]] += place[k] / 4.0 * c.radius[uncertain[k]];
    return x = trajectory(c, start, 400);
  };
  for (unsigned corner = 0; corner < 1U << uncertain.size(); ++corner) {
    std::vector<int> place;
    for (std::size_t k = 0; k < uncertain.size(); ++k) place.push_back((corner >> k & 1U) != 0 ? 4 : -4);
    at(place);
  }
  std::vector<double> widths;
  for (std::size_t i = 0; i < n; ++i) {
    double ends[2];
    for (const int side : {-1, 1}) {
      const auto better = [&](const auto& a, const auto& b) { return side * a.second[i] < side * b.second[i]; };
      std::vector<int> best = std::max_element(known.begin(), known.end(), better)->first;
      for (bool moves = true; moves;) {
        moves = false;
        for (std::size_t k = 0; k < best.size(); ++k)
          for (const int step : {-2, -1, 1, 2}) {
            std::vector<int> next = best;
            next[k] = std::clamp(next[k] + step, -4, 4);
            if (side * at(next)[i] > side * at(best)[i]) best = next, moves = true;
          }
      }
      ends[(side + 1) / 2] = at(best)[i];
    }
    widths.push_back(ends[1] - ends[0]);
  }
  return widths;
}

/// Two bars of masses and lengths as parameters, hanging from above; angles from the vertical.
Case doublePendulum() {
  return {"doublePendulum4",
          record(4, 4,
                 [](auto, const auto& x, const auto& p, auto& dx) {
                   const auto &l1 = p[0], &l2 = p[1], &m1 = p[2], &m2 = p[3];
                   const Recorded cosine = cos(x[1]), sine = sin(x[1]), sum = x[2] + x[3], g(Interval("9.81"));
                   const Recorded a11 = m1 * l1 + m2 * (l1 + l2 * cosine), a12 = m2 * l2 * cosine,
                                  a21 = m2 * (l1 * cosine + l2), a22 = m2 * l2;
                   const Recorded b1 = -g * (m1 + m2) * sin(x[0]) + m2 * l2 * sine * sum * sum;
                   const Recorded b2 = -g * m2 * sin(x[0] + x[1]) - m2 * l1 * sine * x[2] * x[2];
                   const Recorded d = a11 * a22 - a12 * a21;
                   dx[0] = x[2];
                   dx[1] = x[3];
                   dx[2] = (b1 * a22 - a12 * b2) / d;
                   dx[3] = (a11 * b2 - b1 * a21) / d;
                 }),
          {0.75 * 3.14159, -0.55 * 3.14159, 0.43, 0.67, 1, 1, 1, 1},
          {0, 0, 0, 0, 5e-3, 5e-3, 5e-3, 5e-3},
          2};
}

Case predatorAndPrey() {
  return {"predatorAndPrey6",
          record(2, 4,
                 [](auto, const auto& x, const auto& p, auto& dx) {
                   dx[0] = x[0] * (p[0] - p[1] * x[1]);
                   dx[1] = x[1] * (p[2] * x[0] - p[3]);
                 }),
          {1, 1, 1.5, 1, 1, 3},
          {0.1, 0.1, 0.015, 0.01, 0.01, 0.03},
          5};
}

/// Two revolutions from the pericentre of an ellipse, e = 0.5.
Case kepler() {
  return {"kepler4",
          record(4, 0,
                 [](auto, const auto& x, const auto&, auto& dx) {
                   const Recorded square = sqr(x[0]) + sqr(x[1]), cube = square * sqrt(square);
                   dx[0] = x[2];
                   dx[1] = x[3];
                   dx[2] = -x[0] / cube;
                   dx[3] = -x[1] / cube;
                 }),
          {0.5, 0, 0, std::sqrt(3.0)},
          {1e-3, 1e-3, 1e-3, 1e-3},
          4 * 3.14159265};
}

/// Fifteen masses in a row, held and coupled by springs with a cubic part; ten of the stiffnesses are uncertain.
Case chainOfMasses() {
  constexpr int masses = 15;
  Case c{"chainOfMasses10",
         record(2 * masses, 10,
                [](auto, const auto& x, const auto& p, auto& dx) {
                  const auto place = [&](int i) { return i < 0 || i >= masses ? Recorded(0.0) : x[i]; };
                  for (int i = 0; i < masses; ++i) {
                    const auto force = [&](int spring) {
                      const Recorded stretch = place(spring) - place(spring - 1);
                      return p[spring % 10] * (stretch + stretch * sqr(stretch));
                    };
                    dx[i] = x[masses + i];
                    dx[masses + i] = force(i + 1) - force(i);
                  }
                }),
         {},
         {},
         2};
  for (int i = 0; i < masses; ++i) c.nominal.push_back(0.5 * std::sin(0.4 * (i + 1)));
  for (int i = 0; i < masses; ++i) c.nominal.push_back(0.2 * std::cos(0.7 * i));
  c.radius.assign(2 * masses, 0.0);
  for (int k = 0; k < 10; ++k) {
    c.nominal.push_back(1 + 0.122 * k);
    c.radius.push_back(0.01 * c.nominal.back());
  }
  return c;
}

void plainTrajectory(benchmark::State& state, const Case& c) {
  for (auto _ : state) benchmark::DoNotOptimize(trajectory(c, c.nominal));
}

void enclosure(benchmark::State& state, const Case& c) {
  const Flow flow(c.f, FlowOptions());
  Tube tube;
  for (auto _ : state) tube = flow.enclose(c.box(), c.horizon);
  const std::vector<double> sampled = sampledWidths(c);
  double greatest = 0;
  for (std::size_t i = 0; i < sampled.size(); ++i)
    if (tube.reached() >= c.horizon) greatest = std::max(greatest, width(tube.at(c.horizon)[i]) / sampled[i]);
  state.counters["reached"] = tube.reached();
  state.counters["pieces"] = tube.pieces();
  state.counters["overestimation"] = greatest;
}

const bool areRegistered = [] {
  for (const Case& c : {doublePendulum(), predatorAndPrey(), kepler(), chainOfMasses()}) {
    benchmark::RegisterBenchmark(("plainTrajectory/" + c.name).c_str(), plainTrajectory, c)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("enclosure/" + c.name).c_str(), enclosure, c)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
  return true;
}();

}  // namespace
}  // namespace gamut::benchmarks
