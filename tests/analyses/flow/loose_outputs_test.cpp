// Outputs with kinks, and of which plain intervals alone are known over a whole piece: parts of it tell their bounds at
// output times. Judged by trajectories, and by how much wider they are than these.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

/// Two oscillators, each with so many uncertain stiffnesses in a row, and what adds the first of them up.
Containment oscillators(int stiffnesses) {
  const int k = 2 * stiffnesses;
  Containment c;
  const auto squareOf = [=](const auto& p, int which) {
    Recorded sum = 9.0;
    for (int i = 0; i < stiffnesses; ++i) sum += p[static_cast<std::size_t>(which * stiffnesses + i)];
    return sum;
  };
  c.f = record(5, k, [=](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -squareOf(p, 0) * sin(x[0]);
    dx[2] = x[3];
    dx[3] = -squareOf(p, 1) * x[2];
    dx[4] = p[0];
  });
  c.g = record(5, k, 6, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = abs(x[0]);
    y[1] = sqrt(sqr(x[0]) + sqr(x[2] - 0.2));  // may come to zero
    y[2] = max(x[0], x[2]) - 3.0 * abs(p[0] - 0.02);
    y[3] = x[1] / (1.0 + abs(x[2]));
    y[4] = sqrt(abs(x[0] - x[2]) + sqr(x[1] - x[3]));
    y[5] = abs(x[4] + p[0]);
  });
  c.box = {Interval(0.45, 0.55), Interval(-0.05, 0.05), Interval(0.3, 0.36), Interval(0.0), Interval(0.0)};
  for (int i = 0; i < k; ++i) c.box.push_back(Interval(-0.05 - 0.01 * i, 0.06));
  c.horizon = 0.8;
  for (int i = 1; i < 8; ++i) c.times.push_back(0.1 * i);
  return c;
}

TEST(LooseOutputs, HoldEverySolution) {
  for (const int stiffnesses : {1, 3}) {
    SCOPED_TRACE(stiffnesses);
    Containment c = oscillators(stiffnesses);
    c.levels = {c.box};
    for (Interval& side : c.levels[0])
      side = Interval(midpoint(side) - 0.2 * width(side), midpoint(side) + 0.2 * width(side));
    c.options.maxPieces = 2;
    Judge judge(c);
    EXPECT_EQ(judge.tube().reached(), c.horizon) << judge.tube().why();
    judge.judge(16);
  }
}

TEST(LooseOutputs, HoldEverySolutionBesideInputs) {
  Containment c = oscillators(1);
  c.options.varying = {{0, 1.0}};
  c.horizon = 0.4;
  c.times.resize(3);
  Judge judge(c);
  EXPECT_EQ(judge.tube().reached(), c.horizon) << judge.tube().why();
  judge.judge(16);
}

/// Beside a state that rests, at the start as well as later: of what states span all is known, so that parts tell all.
Containment besideRest() {
  Containment c;
  c.f = record(4, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -(9.0 + p[0]) * x[0];
    dx[2] = x[3];
    dx[3] = -4.0 * x[2];
  });
  c.g = record(4, 1, 3, [](auto, const auto& x, const auto& p, auto& y) {
    const Recorded kink = abs(x[0] - 0.5);
    y[0] = sqrt(sqr(x[0] - 0.5) + sqr(p[0])) - abs(x[0] - 0.48);
    y[1] = atan2(1.01 * kink + 0.01 - kink, x[2] - 0.3 - p[0]);  // over the whole piece any angle
    y[2] = max(x[0], p[0] + 0.5) - min(x[0], 0.5 - p[0]);
  });
  c.box = {Interval(0.45, 0.55), Interval(0.0), Interval(0.0), Interval(0.0), Interval(-0.05, 0.06)};
  c.horizon = 0.1;
  c.times = {0.05};
  c.options.maxPieces = 32;
  return c;
}

TEST(LooseOutputs, AreAsTightAtTheStartAndBesideStatesThatRest) {
  const Containment c = besideRest();
  Judge judge(c);
  judge.judge(8);
  const Tube& tube = judge.tube();
  EXPECT_LT(tube.tightness(), 1.03);
  Evaluator<double> outputs(*c.g);
  for (std::size_t row = 0; row < tube.reachedTimes(); ++row) {
    SCOPED_TRACE(tube.times()[row]);
    std::vector<double> least(3, 10), greatest(3, -10);
    constexpr int parts = 80;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; j <= parts; ++j) {
        const double x = 0.45 + 0.1 * i / parts, p = -0.05 + 0.11 * j / parts, w = std::sqrt(9 + p);
        const double time = tube.times()[row];
        const std::vector<double> parameters{p}, state{x * std::cos(w * time), -x * w * std::sin(w * time), 0.0, 0.0};
        outputs.setParameters(parameters);
        const auto y = outputs(time, state);
        for (std::size_t o = 0; o < 3; ++o) {
          least[o] = std::min(least[o], y[o]);
          greatest[o] = std::max(greatest[o], y[o]);
        }
      }
    for (std::size_t o = 0; o < 3; ++o)
      EXPECT_LT(width(tube.outputs(row)[o]), 1.03 * (greatest[o] - least[o])) << o << ' ' << tube.outputs(row)[o];
  }
}

/// Of a start that is known but for rounding, whose remainder grows until it gets symbols of its own: these are none of
/// the box, and no matter for cuts.
TEST(LooseOutputs, AreKnownOfRemaindersWithSymbolsOfTheirOwn) {
  Containment c;
  c.f = record(1, 0, [](auto t, const auto& x, const auto&, auto& dx) { dx[0] = 5.0 * (x[0] - cos(t)) - sin(t); });
  c.g = record(1, 0, 2, [](auto t, const auto& x, const auto&, auto& y) {
    const Recorded off = x[0] - cos(t);
    y[0] = abs(off) - 0.99 * abs(off - 1e-7);
    y[1] = sqrt(sqr(off) + sqr(off * (1.0 - off)));
  });
  c.box = {Interval(1.0 - 0x1p-44, 1.0 + 0x1p-44)};
  c.horizon = 4;
  c.times = {1, 2, 3, 3.5};
  for (const bool split : {true, false}) {
    SCOPED_TRACE(split);
    c.options.split = split;
    Judge judge(c);
    EXPECT_EQ(judge.tube().reached(), c.horizon) << judge.tube().why();
    judge.judge(6);
  }
}

}  // namespace
}  // namespace gamut::testing
