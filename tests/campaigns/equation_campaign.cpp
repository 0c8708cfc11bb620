// Equations of many kinds, each from a thin, a narrow and a wide start (initial values and parameters), enclosed by the
// flow as it chooses for itself; then trajectories in 128 bits, corners first, with events located and inputs switched.
// Every one must lie in the tube at every output time and between, compared exactly. Usage:
//     equation_campaign [trajectories of each start = 3]
// Prints a table; the exit status is 1 if one trajectory is outside, or if a start has none.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "tests/analyses/event_reference.hpp"
#include "tests/analyses/sliding_reference.hpp"
#include "tests/analyses/switching_courses.hpp"

namespace gamut::testing {
namespace {

struct Equation {
  std::string name;
  Program f;
  std::vector<double> start;   // initial values, then parameters
  std::vector<double> spread;  // of each; a wide start is ± spread, a narrow one a thousandth of it
  double horizon;
  std::vector<VaryingParameter> varying = {};
  SlidingReference::Rest rest = {};  // where solutions are held at jumps
};

template <class Function>
Program equations(int n, int k, Function function) {
  return record(n, k, [&](auto t, const auto& x, const auto& p, auto& dx) { function(t, x, p, dx); });
}

Program chain(int masses) {
  return equations(2 * masses, 1, [masses](auto, const auto& x, const auto& p, auto& dx) {
    for (int i = 0; i < masses; ++i) {
      const auto at = [&](int k) { return static_cast<std::size_t>(k); };
      dx[at(i)] = x[at(masses + i)];
      Recorded pull = i > 0 ? x[at(i - 1)] - x[at(i)] : -x[at(0)];
      if (i + 1 < masses) pull += x[at(i + 1)] - x[at(i)];
      dx[at(masses + i)] = p[0] * pull - 0.5 * x[at(i)] * sqr(x[at(i)]);
    }
  });
}

std::vector<Equation> equationList() {
  using std::vector;
  std::vector<Equation> list;
  const auto add = [&](const char* name, int n, int k, vector<double> start, vector<double> spread, double horizon,
                       auto function, vector<VaryingParameter> varying = {}) {
    list.push_back({name, equations(n, k, function), std::move(start), std::move(spread), horizon, std::move(varying)});
  };
  add("oscillator", 2, 1, {1, 0, 4}, {0.3, 0.3, 0.2}, 6, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * x[0];
  });
  add("pendulum", 2, 2, {1.5, 0, 9.81, 0.1}, {0.1, 0.1, 0.1, 0.05}, 3,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[1];
        dx[1] = -p[0] * sin(x[0]) - p[1] * x[1];
      });
  add("pendulum at the top", 2, 0, {3.14159, 0}, {0.01, 0.01}, 2, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -9.81 * sin(x[0]);
  });
  add("double pendulum", 4, 1, {2.356, -1.728, 0.43, 0.67, 9.81}, {0.01, 0.01, 0, 0, 0.01}, 1.5,
      [](auto, const auto& x, const auto& p, auto& dx) {
        const Recorded c = cos(x[1]), s = sin(x[1]), sum = x[2] + x[3], m12 = 1.0 + c, m11 = 1.0 + m12;
        const Recorded b1 = s * sqr(sum) - 2.0 * p[0] * sin(x[0]), b2 = -p[0] * sin(x[0] + x[1]) - s * sqr(x[2]);
        const Recorded determinant = m11 - c * m12;
        dx[0] = x[2];
        dx[1] = x[3];
        dx[2] = (b1 - c * b2) / determinant;
        dx[3] = (m11 * b2 - m12 * b1) / determinant;
      });
  add("van der Pol", 2, 1, {1.4, 2.4, 1}, {0.1, 0.1, 0.02}, 4, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] * (1.0 - sqr(x[0])) * x[1] - x[0];
  });
  add("Duffing, driven", 2, 1, {0.5, 0, 0.3}, {0.1, 0.1, 0.05}, 5, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = x[0] - x[0] * sqr(x[0]) - 0.2 * x[1] + p[0] * cos(1.2 * t);
  });
  add("Lorenz", 3, 1, {15, 15, 36, 28}, {0.05, 0.05, 0.05, 0.05}, 0.7,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = 10.0 * (x[1] - x[0]);
        dx[1] = x[0] * (p[0] - x[2]) - x[1];
        dx[2] = x[0] * x[1] - 8.0 / 3.0 * x[2];
      });
  add("Rössler", 3, 0, {0, -8.4, 0.03}, {0.1, 0.1, 0.01}, 4, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = -x[1] - x[2];
    dx[1] = x[0] + 0.2 * x[1];
    dx[2] = 0.2 + x[2] * (x[0] - 5.7);
  });
  add("predator and prey", 2, 4, {1, 1, 1.5, 1, 1, 3}, {0.1, 0.1, 0.01, 0.01, 0.01, 0.01}, 4,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[0] * (p[0] - p[1] * x[1]);
        dx[1] = x[1] * (p[2] * x[0] - p[3]);
      });
  add("Kepler", 4, 1, {0.5, 0, 0, 1.7320508, 0}, {1e-3, 1e-3, 0, 1e-3, 1e-4}, 6,
      [](auto, const auto& x, const auto& p, auto& dx) {
        const Recorded r2 = sqr(x[0]) + sqr(x[1]), r3 = r2 * sqrt(r2);
        dx[0] = x[2];
        dx[1] = x[3];
        dx[2] = -(1.0 + p[0]) * x[0] / r3;
        dx[3] = -(1.0 + p[0]) * x[1] / r3;
      });
  add("Brusselator", 2, 2, {1, 1, 1, 1.5}, {0.1, 0.1, 0.02, 0.02}, 5, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = p[0] + sqr(x[0]) * x[1] - (p[1] + 1.0) * x[0];
    dx[1] = p[1] * x[0] - sqr(x[0]) * x[1];
  });
  add("seven reactions", 7, 0, {1.2, 1.05, 1.5, 2.4, 1, 0.1, 0.45}, {0.05, 0.05, 0.05, 0.05, 0.05, 0.02, 0.05}, 5,
      [](auto, const auto& x, const auto&, auto& dx) {
        dx[0] = 1.4 * x[2] - 0.9 * x[0];
        dx[1] = 2.5 * x[4] - 1.5 * x[1];
        dx[2] = 0.6 * x[6] - 0.8 * x[1] * x[2];
        dx[3] = 2.0 - 1.3 * x[2] * x[3];
        dx[4] = 0.7 * x[0] - x[3] * x[4];
        dx[5] = 0.3 * x[0] - 3.1 * x[5];
        dx[6] = 1.8 * x[5] - 1.5 * x[1] * x[6];
      });
  add("rigid body", 3, 3, {1, 0.1, 0.5, 1, 2, 3}, {0.1, 0.05, 0.1, 0.01, 0.01, 0.01}, 5,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = (p[1] - p[2]) * x[1] * x[2] / p[0];
        dx[1] = (p[2] - p[0]) * x[2] * x[0] / p[1];
        dx[2] = (p[0] - p[1]) * x[0] * x[1] / p[2];
      });
  add("quaternion", 4, 3, {1, 0, 0, 0, 0.5, -1, 2}, {0, 0, 0, 0, 0.1, 0.1, 0.1}, 5,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = -0.5 * (x[1] * p[0] + x[2] * p[1] + x[3] * p[2]);
        dx[1] = 0.5 * (x[0] * p[0] + x[2] * p[2] - x[3] * p[1]);
        dx[2] = 0.5 * (x[0] * p[1] + x[3] * p[0] - x[1] * p[2]);
        dx[3] = 0.5 * (x[0] * p[2] + x[1] * p[1] - x[2] * p[0]);
      });
  add("FitzHugh and Nagumo", 2, 1, {-1, 1, 0.5}, {0.1, 0.1, 0.05}, 8, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[0] - x[0] * sqr(x[0]) / 3.0 - x[1] + p[0];
    dx[1] = 0.08 * (x[0] + 0.7 - 0.8 * x[1]);
  });
  list.push_back({"chain of five masses",
                  chain(5),
                  {0.5, 0, 0, 0, 0, 0, 0, 0, 0, 1, 20},
                  {0.05, 0, 0, 0, 0, 0, 0, 0, 0, 0.1, 0.2},
                  2});
  list.push_back({"chain of twelve masses",
                  chain(12),
                  {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9},
                  {0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1},
                  1});
  add("logistic", 1, 2, {0.1, 2, 1}, {0.05, 0.2, 0.1}, 4,
      [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * x[0] * (1.0 - x[0] / p[1]); });
  add("towards an escape", 1, 1, {1, 1}, {0.02, 0.02}, 0.9,
      [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sqr(x[0]); });
  add("epidemic", 3, 2, {0.99, 0.01, 0, 1.5, 0.5}, {0, 0.005, 0, 0.1, 0.05}, 10,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = -p[0] * x[0] * x[1];
        dx[1] = p[0] * x[0] * x[1] - p[1] * x[1];
        dx[2] = p[1] * x[1];
      });
  add("enzyme", 2, 2, {2, 0, 1, 0.5}, {0.2, 0, 0.1, 0.05}, 3, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = -p[0] * x[0] / (p[1] + x[0]);
    dx[1] = p[0] * x[0] / (p[1] + x[0]) - 0.3 * x[1];
  });
  add("spring pendulum", 4, 2, {0.75, 0.5, 0, 0, 1, 40}, {0.02, 0.02, 0, 0, 0.01, 0.5}, 2,
      [](auto, const auto& x, const auto& p, auto& dx) {
        const Recorded length = sqrt(sqr(x[0]) + sqr(x[1])), pull = p[1] * (length - p[0]) / length;
        dx[0] = x[2];
        dx[1] = x[3];
        dx[2] = -pull * x[0];
        dx[3] = 9.81 - pull * x[1];
      });
  add("quarter car", 4, 2, {0.05, 0.02, 0, 0, 200, 30}, {0.01, 0.005, 0, 0, 5, 1}, 2,
      [](auto, const auto& x, const auto& p, auto& dx) {
        const Recorded spring = p[0] * (x[0] - x[1]) * (1.0 + 20.0 * sqr(x[0] - x[1])) + p[1] * 0.1 * (x[2] - x[3]);
        dx[0] = x[2];
        dx[1] = x[3];
        dx[2] = -spring;
        dx[3] = 8.0 * (spring - 1500.0 * x[1] * 0.2);
      });
  add("x log x", 1, 1, {0.5, 1}, {0.05, 0.1}, 2,
      [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = -p[0] * x[0] * log(x[0]); });
  add("smooth friction", 2, 1, {1, 0, 5}, {0.1, 0.1, 0.2}, 4, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -4.0 * x[0] - 0.5 * tanh(p[0] * x[1]);
  });
  add("arc tangent", 2, 0, {2, 0}, {0.2, 0.2}, 6, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -3.0 * atan(x[0]) - 0.1 * x[1];
  });
  add("tank", 1, 1, {2, 0.8}, {0.1, 0.05}, 2,
      [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = 0.3 - p[0] * sqrt(x[0]); });
  add("exponential", 2, 1, {0, 0, 1}, {0.1, 0.1, 0.05}, 3, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] * (exp(-x[0]) - 1.0) - 0.2 * x[1];
  });
  add("quick relaxation", 1, 1, {0, 50}, {0.5, 1}, 3,
      [](auto t, const auto& x, const auto& p, auto& dx) { dx[0] = -p[0] * (x[0] - cos(t)); });
  add("swing, pumped", 2, 1, {0.2, 0, 0.2}, {0.05, 0.05, 0.05}, 6, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -4.0 * (1.0 + p[0] * sin(4.0 * t)) * sin(x[0]);
  });
  add("coupled oscillators", 4, 2, {1, 1, 0, 0, 1, 0.9}, {0.1, 0.1, 0, 0, 0.02, 0.05}, 8,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[2];
        dx[1] = x[3];
        dx[2] = -p[0] * x[0] + p[1] * (x[1] - x[0]);
        dx[3] = -x[1] + p[1] * (x[0] - x[1]);
      });
  add("Hénon and Heiles", 4, 0, {0.1, 0.2, 0.3, 0.1}, {0.01, 0.01, 0.01, 0.01}, 8,
      [](auto, const auto& x, const auto&, auto& dx) {
        dx[0] = x[2];
        dx[1] = x[3];
        dx[2] = -x[0] - 2.0 * x[0] * x[1];
        dx[3] = -x[1] - sqr(x[0]) + sqr(x[1]);
      });
  add("contact", 2, 1, {1, 0, 1}, {0.002, 0, 0.002}, 1.5, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -9.81 - 100.0 * p[0] * min(x[0], Recorded(0.0)) - 0.1 * x[1];
  });
  add("saturation", 2, 0, {1, 0}, {0.02, 0.02}, 4, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = max(Recorded(-0.5), min(Recorded(0.5), -4.0 * x[0] - x[1]));
  });
  add("backlash", 2, 1, {0, 0, 5}, {0.02, 0.02, 0.1}, 6, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = cos(t) - x[0] - p[0] * (max(x[0] - 0.5, Recorded(0.0)) + min(x[0] + 0.5, Recorded(0.0)));
  });
  add("dry friction", 2, 1, {1, -0.0625, 0.3}, {0.05, 0, 0.01}, 3.5, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -4.0 * x[0] - p[0] * sign(x[1]);
  });
  add("switched rate", 1, 1, {1, 1.5}, {0.05, 0.01}, 1,
      [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = where(x[0] - p[0], Recorded(1.0), Recorded(2.0)); });
  add("quadratic drag", 2, 1, {1, 0, 0.4}, {0.1, 0.1, 0.02}, 5, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -x[0] - p[0] * abs(x[1]) * x[1];
  });
  add("oscillator, pushed", 2, 2, {0, 0, 0, 25}, {0, 0, 1, 0.1}, 3,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[1];
        dx[1] = p[0] - p[1] * x[0] - 0.5 * x[1];
      },
      {{0}});
  add("pendulum, shaken", 2, 2, {0.3, 0, 0, 1}, {0.02, 0, 0.2, 0.01}, 2,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[1];
        dx[1] = (p[0] * cos(x[0]) - 9.81 * sin(x[0])) / p[1] - 0.2 * x[1];
      },
      {{0}});
  add("stiffness that varies", 2, 2, {1, 0, 4, 0}, {0.05, 0.05, 0.2, 0.1}, 3,
      [](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[1] + p[1] * x[0];
        dx[1] = -p[0] * x[0];
      },
      {{0}, {1}});
  // State `x` rests, or moves as parameter `p` says.
  const auto held = [&](std::size_t x, std::size_t p = 9) {
    list.back().rest = [=](const vector<Side>& sides, const Vector& parameters, Vector& states) {
      if (sides[0] == Side::held) states[x] = p < parameters.size() ? parameters[p] : Precise(0);
    };
  };
  add("comes to rest", 2, 1, {1, 0, 0.22}, {0.02, 0, 0.005}, 10, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -x[0] - p[0] * sign(x[1]);
  });
  held(1);
  add("stick and slip", 2, 2, {0, 0.25, 1, 0.25}, {0, 0, 0.01, 0}, 12,
      [](auto, const auto& x, const auto& p, auto& dx) {
        const auto u = x[1] - p[1];
        dx[0] = x[1];
        dx[1] = -x[0] - p[0] * sign(u) / (1.0 + 2.0 * abs(u));
      });
  held(1, 1);
  add("breaks loose", 2, 2, {0, 0, 0.5, 1}, {0, 0, 0.01, 0.01}, 4, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] * t - p[1] * sign(x[1]);
  });
  held(1);
  add("hinge that rubs", 2, 1, {1, 0, 0.5}, {0.01, 0, 0.01}, 2.5, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -9.81 * sin(x[0]) - p[0] * sign(x[1]);
  });
  held(1);
  return list;
}

struct Outcome {
  long trajectories = 0, comparisons = 0, outside = 0;
};

Outcome judge(const Equation& equation, const Box& box, const Tube& tube, int trajectories, Points& points) {
  Outcome outcome;
  const std::vector<double>& times = tube.times();
  std::vector<double> moments;  // dyadic parts of the horizon, output times among them
  std::vector<std::size_t> row;
  for (int i = 1; i <= 64; ++i) {
    const double moment = equation.horizon * i / 64;
    if (moment > tube.reached()) break;
    std::size_t r = 0;
    while (times[r] < moment) ++r;
    if (r >= tube.reachedTimes()) break;
    moments.push_back(moment);
    row.push_back(r);
  }
  if (moments.empty()) return outcome;
  EventReference reference(equation.f);
  SlidingReference sliding(equation.f, equation.rest);
  const int n = equation.f.states();
  for (int trial = 0; trial < trajectories; ++trial) {
    const Vector start = trial % 2 == 0 ? points.corner(box) : points.inside(box);
    std::vector<Vector> motion;
    if (equation.rest) {
      motion = sliding(start, moments);
    } else if (equation.varying.empty()) {
      motion = reference(start, moments);
    } else {
      const Course course = switching(box, n, equation.varying, equation.horizon, points.integer(0, 20), points);
      motion = follow(equation.f, Vector(start.begin(), start.begin() + n), course, moments);
    }
    ++outcome.trajectories;
    for (std::size_t m = 0; m < moments.size(); ++m)
      for (std::size_t s = 0; s < motion[m].size(); ++s) {
        outcome.comparisons += 2;
        outcome.outside += encloses(tube.statesOver(row[m])[s], motion[m][s]) ? 0 : 1;
        if (times[row[m]] == moments[m]) outcome.outside += encloses(tube.states(row[m])[s], motion[m][s]) ? 0 : 1;
      }
  }
  return outcome;
}

int run(int trajectories) {
  fmt::print("{:<24} {:>8} {:>8} {:>8} {:>7} {:>8} {:>9} {:>12} {:>8}\n", "equations", "start", "horizon", "reached",
             "pieces", "tight", "flow/s", "trajectories", "outside");
  Outcome all;
  int without = 0;  // trajectories
  Points points(1);
  for (const Equation& equation : equationList())
    for (const auto& [name, share] : {std::pair("thin", 0.0), std::pair("narrow", 1e-3), std::pair("wide", 1.0)}) {
      Box box;
      for (std::size_t i = 0; i < equation.start.size(); ++i) {
        const double radius = share * equation.spread[i];
        box.push_back(Interval(equation.start[i] - radius, equation.start[i] + radius));
      }
      FlowOptions options;
      options.varying = equation.varying;
      options.budget = 20;
      std::vector<double> times;
      for (int i = 1; i <= 8; ++i) times.push_back(equation.horizon * i / 8);
      const Tube tube = Flow(equation.f, options).enclose(box, equation.horizon, times);
      const Outcome outcome = judge(equation, box, tube, share == 0 ? 1 + trajectories / 10 : trajectories, points);
      fmt::print("{:<24} {:>8} {:>8.3g} {:>8.3g} {:>7} {:>8.4f} {:>9.3f} {:>12} {:>8}\n", equation.name, name,
                 equation.horizon, tube.reached(), tube.pieces(), tube.tightness(), tube.cpuSeconds(),
                 outcome.trajectories, outcome.outside);
      std::fflush(stdout);
      without += outcome.trajectories == 0;
      all.trajectories += outcome.trajectories;
      all.comparisons += outcome.comparisons;
      all.outside += outcome.outside;
    }
  fmt::print("{} trajectories, {} comparisons, {} outside\n", all.trajectories, all.comparisons, all.outside);
  return all.outside > 0 || without > 0 ? 1 : 0;
}

}  // namespace
}  // namespace gamut::testing

int main(int argc, char** argv) {
  const long trajectories = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 3;
  if (trajectories < 1) {
    fmt::print(stderr, "usage: equation_campaign [trajectories of each start, at least 1]\n");
    return 2;
  }
  return gamut::testing::run(static_cast<int>(trajectories));
}
