// Machines that are equations rather than studies: chains of masses, an orbit, stiff rates. What a flow makes of them
// by its defaults, given 60 s of CPU time and two threads each.
//
//     machine_equations [SECONDS] [NAME ...]   # those whose name begins so, otherwise all; SECONDS in place of 60
//
// Told of each: the time reached of that asked for (s), the greatest overestimation of a state (width of its enclosure
// over that of samples), pieces, CPU time of the enclosure (s), and why it ended early. Samples are the centre, values
// at random, and for each state at each output time both corners that the signs of its differences name; counted are
// times at which they are at least 1e-3 as wide as at their widest. README.md beside this file tells what for.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gamut/flow.hpp>

namespace gamut::benchmarks {
namespace {

using Values = std::vector<double>;

struct Case {
  std::string name;
  Program f;
  std::function<void(const Values& x, const Values& p, Values& dx)> plain;  // the same, in plain doubles
  Values nominal;                                                           // states, then parameters
  Values radius;                                                            // likewise; 0: known
  double horizon = 1;                                                       // s
  int steps = 1000;  // of a sample, from one output time to the next
};

constexpr int kTimes = 20;  // output times behind the start, evenly spread

template <class Rates>
Case ofRates(std::string name, const Rates& rates, int states, Values nominal, Values radius, double horizon,
             int steps) {
  const int parameters = static_cast<int>(nominal.size()) - states;
  return {std::move(name),
          record(states, parameters, [&](auto, const auto& x, const auto& p, auto& dx) { rates(x, p, dx); }),
          [rates](const Values& x, const Values& p, Values& dx) { rates(x, p, dx); },
          std::move(nominal),
          std::move(radius),
          horizon,
          steps};
}

/// Masses of 1 kg in a row between two walls, the first displaced by 0.1 m; springs of 100 N/m, each uncertain by
/// itself, beside dampers of 0.5 N s/m. `cubic`: the part of a spring's linear force that is added to it at 0.1 m and
/// grows with the cube of the stretch.
Case chain(int masses, int percent, double cubic) {
  const auto rates = [masses, cubic](const auto& x, const auto& p, auto& dx) {
    using Scalar = std::decay_t<decltype(x[0] + x[0])>;
    const auto force = [&](int spring) {  // with which spring `spring` pulls the mass before it
      const auto difference = [&](int first) {
        const auto at = [&](int mass) { return x[first + mass]; };
        if (spring == 0) return Scalar(at(0));
        return spring == masses ? Scalar(-at(masses - 1)) : Scalar(at(spring) - at(spring - 1));
      };
      const Scalar stretch = difference(0), elastic = p[spring] * stretch;
      const Scalar damped = 0.5 * difference(masses);
      return cubic > 0 ? Scalar(elastic * (1 + 100 * cubic * (stretch * stretch)) + damped) : Scalar(elastic + damped);
    };
    for (int i = 0; i < masses; ++i) {
      dx[i] = x[masses + i];
      dx[masses + i] = force(i + 1) - force(i);
    }
  };
  const auto states = static_cast<std::size_t>(2 * masses);
  Values nominal(states, 0.0), radius(states, 0.0);
  nominal[0] = 0.1;
  nominal.resize(states + static_cast<std::size_t>(masses) + 1, 100.0);
  radius.resize(nominal.size(), static_cast<double>(percent));
  return ofRates(
      (cubic > 0 ? "cubic_chain_" : "linear_chain_") + std::to_string(masses) + "_" + std::to_string(percent), rates,
      2 * masses, nominal, radius, 5, 50);
}

/// A hundred revolutions from the pericentre of an ellipse, e = 0.1.
Case kepler() {
  const auto rates = [](const auto& x, const auto&, auto& dx) {
    using std::sqrt;
    const auto square = x[0] * x[0] + x[1] * x[1];
    const auto cube = square * sqrt(square);
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = -x[0] / cube;
    dx[3] = -x[1] / cube;
  };
  return ofRates("kepler", rates, 4, {0.9, 0, 0, std::sqrt(1.1 / 0.9)}, Values(4, 1e-5), 200 * std::numbers::pi, 20000);
}

/// Robertson's reactions, all three rates ± 5 %.
Case robertson() {
  const auto rates = [](const auto& x, const auto& p, auto& dx) {
    const auto first = p[0] * x[0], second = p[1] * (x[1] * x[1]), third = p[2] * x[1] * x[2];
    dx[0] = third - first;
    dx[1] = first - third - second;
    dx[2] = second;
  };
  return ofRates("robertson", rates, 3, {1, 0, 0, 0.04, 3e7, 1e4}, {0, 0, 0, 0.002, 1.5e6, 500}, 40, 20000);
}

/// Van der Pol's oscillator, mu = 100, the initial value ± 1 %.
Case vanDerPol() {
  const auto rates = [](const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = 100 * (1 - x[0] * x[0]) * x[1] - x[0];
  };
  return ofRates("van_der_pol", rates, 2, {2, 0}, {0.02, 0}, 100, 50000);
}

/// The states at all output times, one after the other, by the classical Runge-Kutta method.
Values motion(const Case& c, const Values& start) {
  const auto n = static_cast<std::size_t>(c.f.states());
  Values x(start.begin(), start.begin() + static_cast<std::ptrdiff_t>(n)), y(n), k[4], all;
  const Values p(start.begin() + static_cast<std::ptrdiff_t>(n), start.end());
  for (Values& rate : k) rate.resize(n);
  const double h = c.horizon / kTimes / c.steps, part[4] = {0, h / 2, h / 2, h};
  for (int time = 0; time < kTimes; ++time) {
    for (int step = 0; step < c.steps; ++step) {
      for (int stage = 0; stage < 4; ++stage) {
        y = x;
        for (std::size_t i = 0; stage > 0 && i < n; ++i) y[i] += part[stage] * k[stage - 1][i];
        c.plain(y, p, k[stage]);
      }
      for (std::size_t i = 0; i < n; ++i) x[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
    }
    all.insert(all.end(), x.begin(), x.end());
  }
  return all;
}

/// Width of every state at every output time, from inside.
Values sampledWidths(const Case& c) {
  std::vector<std::size_t> uncertain;
  for (std::size_t i = 0; i < c.radius.size(); ++i)
    if (c.radius[i] > 0) uncertain.push_back(i);
  const Values centre = motion(c, c.nominal);
  Values least = centre, greatest = centre;
  const auto sample = [&](const auto& place) {  // of each uncertain quantity, -1 … 1
    Values start = c.nominal;
    for (std::size_t k = 0; k < uncertain.size(); ++k) start[uncertain[k]] += place(k) * c.radius[uncertain[k]];
    Values all = motion(c, start);
    for (std::size_t i = 0; i < all.size(); ++i) {
      least[i] = std::min(least[i], all[i]);
      greatest[i] = std::max(greatest[i], all[i]);
    }
    return all;
  };
  std::set<std::vector<bool>> corners;
  std::vector<Values> differences;
  for (std::size_t k = 0; k < uncertain.size(); ++k) {
    const Values up = sample([&](std::size_t l) { return l == k ? 0.05 : 0.0; });
    const Values down = sample([&](std::size_t l) { return l == k ? -0.05 : 0.0; });
    differences.emplace_back(up.size());
    std::transform(up.begin(), up.end(), down.begin(), differences[k].begin(), std::minus<>());
  }
  for (std::size_t i = 0; i < centre.size(); ++i) {
    std::vector<bool> corner;
    for (const Values& difference : differences) corner.push_back(difference[i] > 0);
    corners.insert(corner);
    corner.flip();
    corners.insert(corner);
  }
  for (const std::vector<bool>& corner : corners) sample([&](std::size_t k) { return corner[k] ? 1.0 : -1.0; });
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int number = 0; number < 64; ++number) sample([&](std::size_t) { return anywhere(random); });
  std::transform(greatest.begin(), greatest.end(), least.begin(), greatest.begin(), std::minus<>());
  return greatest;
}

void tell(const Case& c, double budget) {
  FlowOptions options;
  options.budget = budget;
  options.jobs = 2;
  Box box;
  for (std::size_t i = 0; i < c.nominal.size(); ++i)
    box.push_back(c.radius[i] > 0 ? Interval(c.nominal[i] - c.radius[i], c.nominal[i] + c.radius[i])
                                  : Interval(c.nominal[i]));
  Values times;
  for (int time = 1; time <= kTimes; ++time) times.push_back(c.horizon * time / kTimes);
  const Tube tube = Flow(c.f, options).enclose(box, c.horizon, times);
  const Values sampled = sampledWidths(c);
  const auto n = static_cast<std::size_t>(c.f.states());
  double ratio = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double widest = 0;
    for (std::size_t time = 0; time < kTimes; ++time) widest = std::max(widest, sampled[time * n + i]);
    for (std::size_t time = 1; time < tube.reachedTimes(); ++time) {
      const double width = sampled[(time - 1) * n + i];
      if (width >= 1e-3 * widest)
        ratio = std::max(ratio, (tube.states(time)[i].upper() - tube.states(time)[i].lower()) / width);
    }
  }
  std::printf("%-20s %9.4g of %-6.4g %10.4g %7d %8.1f  %s\n", c.name.c_str(), tube.reached(), c.horizon, ratio,
              tube.pieces(), tube.cpuSeconds(), tube.why().c_str());
  std::fflush(stdout);
}

}  // namespace
}  // namespace gamut::benchmarks

int main(int argc, char** argv) {
  using namespace gamut::benchmarks;
  std::vector<Case> cases;
  for (const int masses : {8, 15, 30})
    for (const int percent : {5, 10})
      for (const double cubic : {0.0, 0.3}) cases.push_back(chain(masses, percent, cubic));
  cases.push_back(kepler());
  cases.push_back(robertson());
  cases.push_back(vanDerPol());
  std::vector<std::string> wanted(argv + 1, argv + argc);
  double budget = 60;  // s
  if (!wanted.empty() && wanted[0].find_first_not_of("0123456789.") == std::string::npos) {
    budget = std::stod(wanted[0]);
    wanted.erase(wanted.begin());
  }
  std::printf("%-20s %9s    %-6s %10s %7s %8s\n", "", "reached", "s", "ratio", "pieces", "CPU (s)");
  for (const Case& c : cases)
    if (wanted.empty() ||
        std::any_of(wanted.begin(), wanted.end(), [&](const std::string& name) { return c.name.starts_with(name); }))
      tell(c, budget);
}
