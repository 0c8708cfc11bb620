// Twelve double pendulums (lengths, masses, gravity, starts; one to three quantities uncertain), each assembled from
// elements, recorded, and enclosed by the flow; then random trajectories of an independent integrator, box corners
// first. Every one must lie in the tube at every output time and between, compared exactly. Usage:
//     containment_campaign [trajectories = 600]
// Prints a table; the exit status is 1 if one trajectory is outside, or a flow ended before its horizon.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "tests/campaigns/quadruple_pendulum.hpp"

namespace gamut::campaigns {
namespace {

/// The nine numbers of a double pendulum, and which of them are uncertain.
enum Quantity : std::size_t { psi1, psi2, rate1, rate2, length1, length2, mass1, mass2, gravity };
constexpr const char* parameterNames[] = {"upper.length", "lower.length", "elbow.mass", "tip.mass", "fall"};
constexpr const char* shortNames[] = {"psi1", "psi2", "rate1", "rate2", "l1", "l2", "m1", "m2", "g"};

struct Uncertain {
  Quantity quantity;
  double relativeRadius;
};

struct Variant {
  std::array<double, 9> nominal;
  std::vector<Uncertain> uncertain;
  double horizon;
  int degree = -1;
};

const std::vector<Variant>& variants() {
  constexpr std::array<double, 9> published{2.356194490192345, -1.727875959474386, 0.43, 0.67, 1, 1, 1, 1, 9.81};
  static const std::vector<Variant> list = {
      {published, {{psi1, 0.01}}, 2.3, 16},
      {published, {{psi1, 0.005}}, 3, 16},
      {published, {{length1, 0.01}}, 2, 12},
      {published, {{gravity, 0.01}, {psi2, 0.005}}, 1.5, 8},
      {published, {{mass2, 0.02}, {rate1, 0.05}}, 1.5, 8},
      {published, {{length2, 0.004}, {psi1, 0.004}, {mass1, 0.01}}, 1, 6},
      {{0.5, 0.3, -0.2, 1.1, 0.8, 1.3, 2, 0.5, 9.81}, {{psi1, 0.1}}, 3, 12},
      {{1.2, -0.4, 0, 0, 0.25, 0.5, 0.1, 0.3, 1.62}, {{length1, 0.02}, {length2, 0.02}}, 2, 8},
      {{3.1, 0.2, 0.5, -0.5, 1.5, 0.75, 3, 1, 3.71}, {{mass1, 0.03}, {mass2, 0.03}, {rate2, 0.05}}, 2, 5},
      {{-1, 2.5, 3, -2, 1, 0.5, 1, 4, 24.79}, {{gravity, 0.005}, {rate1, 0.005}}, 1, 8},
      {{0.1, -0.1, 0, 0, 2, 1, 1, 1, 9.81}, {{psi1, 0.5}, {psi2, 0.5}, {length2, 0.01}}, 3, 5},
      {{2.0, 1.0, -3, 5, 1, 1, 1, 0.01, 9.81}, {{psi1, 0.002}, {rate2, 0.002}, {length1, 0.002}}, 1.2, 5},
  };
  return list;
}

/// The pendulum of a variant, put together from joints, links and masses; lengths, masses and gravity by name.
Mechanism mechanismOf(const std::array<double, 9>& nominal) {
  Mechanism m;
  for (std::size_t i = 0; i < 5; ++i) m.addParameter(parameterNames[i], nominal[length1 + i]);
  m.add(Revolute{"shoulder", "inertial", "K1", axisX, nominal[psi1], nominal[rate1]});
  m.add(Link{"upper", "K1", "K2", {0.0, 0.0, gamut::Expression::named("upper.length", -1.0)}});
  m.add(Mass{"elbowBody", "K2", gamut::Expression::named("elbow.mass")});
  m.add(Revolute{"elbow", "K2", "K3", axisX, nominal[psi2], nominal[rate2]});
  m.add(Link{"lower", "K3", "K4", {0.0, 0.0, gamut::Expression::named("lower.length", -1.0)}});
  m.add(Mass{"tipBody", "K4", gamut::Expression::named("tip.mass")});
  m.setGravity({0.0, 0.0, gamut::Expression::named("fall", -1.0)});
  return m;
}

/// What one variant's trajectories met.
struct Outcome {
  std::string names;
  Tube tube;
  long trajectories = 0, comparisons = 0, outside = 0;
  double filled = 0;  // least part of an enclosure, at the horizon, that the trajectories' hull fills
};

class Campaign {
 public:
  Campaign(const Variant& variant, unsigned seed) : v_(variant), engine_(seed) {
    std::vector<std::string> free;
    for (const Uncertain& u : v_.uncertain) {
      const double value = v_.nominal[u.quantity], radius = std::fabs(value) * u.relativeRadius;
      ranges_.push_back({value - radius, value + radius});
      outcome_.names += fmt::format("{}{} ±{:g} %", outcome_.names.empty() ? "" : ", ", shortNames[u.quantity],
                                    100 * u.relativeRadius);
    }
    for (std::size_t s = 0; s < 4; ++s) box_.push_back(rangeOf(static_cast<Quantity>(s)));
    for (const Uncertain& u : v_.uncertain)
      if (u.quantity >= length1) {
        free.push_back(parameterNames[u.quantity - length1]);
        box_.push_back(rangeOf(u.quantity));
      }
    std::vector<double> times;
    for (int i = 1; i <= 40; ++i) times.push_back(v_.horizon * i / 40);
    FlowOptions options;
    options.degree = v_.degree;
    options.splitDefect = 1e-10;
    options.maxPieces = 200;
    outcome_.tube = Flow(recordMotion(mechanismOf(v_.nominal), free), options).enclose(box_, v_.horizon, times);
  }

  Outcome run(long trajectories) {
    const Tube& tube = outcome_.tube;
    // The output times that were reached, and a moment between each two.
    std::vector<double> moments;
    for (std::size_t i = 1; i < tube.reachedTimes(); ++i) {
      moments.push_back(tube.times()[i - 1] + between() * (tube.times()[i] - tube.times()[i - 1]));
      moments.push_back(tube.times()[i]);
    }
    std::array<Interval, 4> sampled;
    for (long i = 0; i < trajectories; ++i) {
      const auto x = quadrupleTrajectory(draw(i), moments);
      ++outcome_.trajectories;
      for (std::size_t m = 0; m < moments.size(); ++m) {
        const std::size_t row = m / 2 + 1;
        compare(tube.statesOver(row), x[m]);
        if (m % 2 == 1) compare(tube.states(row), x[m]);
      }
      if (x.empty()) continue;
      for (std::size_t s = 0; s < 4; ++s) {
        const Interval last(static_cast<double>(x.back()[s]));
        sampled[s] = i == 0 ? last : hull(sampled[s], last);
      }
    }
    outcome_.filled = 1;
    for (std::size_t s = 0; s < 4 && !moments.empty(); ++s)
      outcome_.filled = std::min(outcome_.filled, width(sampled[s]) / width(tube.states(tube.reachedTimes() - 1)[s]));
    return outcome_;
  }

 private:
  Interval rangeOf(Quantity quantity) const {
    for (std::size_t i = 0; i < v_.uncertain.size(); ++i)
      if (v_.uncertain[i].quantity == quantity) return ranges_[i];
    return v_.nominal[quantity];
  }
  double between() { return std::uniform_real_distribution<>(0.01, 0.99)(engine_); }

  /// Corners first, then points anywhere in the box.
  PendulumData draw(long number) {
    std::array<double, 9> value = v_.nominal;
    const bool corner = number < (1L << v_.uncertain.size());
    for (std::size_t i = 0; i < v_.uncertain.size(); ++i) {
      const double part =
          corner ? static_cast<double>((number >> i) & 1) : std::uniform_real_distribution<>(0, 1)(engine_);
      const double inside = ranges_[i].lower() * (1 - part) + ranges_[i].upper() * part;
      value[v_.uncertain[i].quantity] = std::clamp(inside, ranges_[i].lower(), ranges_[i].upper());
    }
    return {value[length1], value[length2], value[mass1],
            value[mass2],   value[gravity], {value[psi1], value[psi2], value[rate1], value[rate2]}};
  }

  void compare(const std::vector<Interval>& enclosure, const std::array<Quad, 4>& x) {
    for (std::size_t s = 0; s < 4; ++s) {
      ++outcome_.comparisons;
      if (!(enclosure[s].lower() <= x[s] && x[s] <= enclosure[s].upper())) ++outcome_.outside;
    }
  }

  const Variant& v_;
  std::mt19937_64 engine_;
  std::vector<Interval> ranges_;
  Box box_;
  Outcome outcome_;
};

int run(long trajectories) {
  fmt::print("{:<38} {:>7} {:>7} {:>6} {:>12} {:>11} {:>7} {:>7} {:>8} {:>8}\n", "uncertain", "horizon", "reached",
             "pieces", "trajectories", "comparisons", "outside", "filled", "flow/s", "check/s");
  long outside = 0, comparisons = 0;
  bool early = false;
  const auto& list = variants();
  const auto seconds = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  for (std::size_t i = 0; i < list.size(); ++i) {
    const double began = seconds();
    Campaign campaign(list[i], static_cast<unsigned>(i + 1));
    const double enclosed = seconds();
    const long share = trajectories / static_cast<long>(list.size()) +
                       (static_cast<long>(i) < trajectories % static_cast<long>(list.size()));
    const Outcome o = campaign.run(share);
    fmt::print("{:<38} {:>7.2f} {:>7.3f} {:>6} {:>12} {:>11} {:>7} {:>7.3f} {:>8.2f} {:>8.2f}\n", o.names,
               list[i].horizon, o.tube.reached(), o.tube.pieces(), o.trajectories, o.comparisons, o.outside, o.filled,
               enclosed - began, seconds() - enclosed);
    std::fflush(stdout);
    outside += o.outside;
    comparisons += o.comparisons;
    early = early || !o.tube.why().empty();
  }
  fmt::print("{} trajectories, {} comparisons, {} outside, {:.1f} s CPU{}\n", trajectories, comparisons, outside,
             seconds(), early ? "; some flows ended early" : "");
  return outside > 0 || early ? 1 : 0;
}

}  // namespace
}  // namespace gamut::campaigns

int main(int argc, char** argv) {
  const long trajectories = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 600;
  if (trajectories < 12) {
    fmt::print(stderr, "usage: containment_campaign [trajectories, at least 12]\n");
    return 2;
  }
  return gamut::campaigns::run(trajectories);
}
