// Derivatives by initial values and parameters: against closed forms and against difference quotients of the reference,
// whose error (1e-15 squared) is far below any width here.
#include "analyses/flow/derivatives.hpp"

#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

/// A driven, damped pendulum: angle, rate; length, damping, drive.
Program drivenPendulum() {
  return record(2, 3, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[2] * cos(3.0 * t) - 9.81 * sin(x[0]) / p[0] - p[1] * x[1] * abs(2.0 + x[1]);
  });
}

const Program outputs = record(2, 3, 2, [](auto t, const auto& x, const auto& p, auto& y) {
  y[0] = p[0] * sin(x[0]);
  y[1] = sqr(x[1]) + p[2] * t;
});

TEST(DerivativeFlow, HoldsDifferenceQuotients) {
  const Box box{Interval(0.4, 0.45), Interval(-0.1, 0.1), Interval(0.9, 1), 0.25, Interval(0.5, 0.52)};
  const std::vector<double> times{0.5, 1};
  const std::vector<int> by{4, 0, 2, 1};
  const DerivativeFlow flow(drivenPendulum(), outputs, by);
  const Tube tube = flow.enclose(box, 1, times);
  ASSERT_EQ(tube.why(), "");
  Reference reference(drivenPendulum());
  Evaluator<Precise> g(outputs);
  Points points(5);
  const auto outputsOf = [&](const Vector& start, double time, const Vector& x) {
    g.setParameters(Vector(start.begin() + 2, start.end()));
    return g(Precise(time), x);
  };
  for (int trial = 0; trial < 12; ++trial) {
    const Vector start = trial % 2 == 0 ? points.corner(box) : points.inside(box);
    for (std::size_t b = 0; b < by.size(); ++b) {
      const Precise step(0x1p-50);
      Vector less = start, more = start;
      less[static_cast<std::size_t>(by[b])] -= step;
      more[static_cast<std::size_t>(by[b])] += step;
      const std::vector<Vector> before = reference(less, times), after = reference(more, times);
      for (std::size_t i = 0; i < times.size(); ++i) {
        const Vector low = outputsOf(less, times[i], before[i]), high = outputsOf(more, times[i], after[i]);
        for (int s = 0; s < 2; ++s) {
          const auto of = static_cast<std::size_t>(s);
          EXPECT_THAT(tube.states(i + 1)[flow.derivative(s, static_cast<int>(b))],
                      Encloses(Precise((after[i][of] - before[i][of]) / (2 * step))));
          EXPECT_THAT(tube.outputs(i + 1)[flow.outputDerivative(s, static_cast<int>(b))],
                      Encloses(Precise((high[of] - low[of]) / (2 * step))));
        }
      }
    }
  }
}

/// x = x0 e^{-k t} + (u/k)(1 - e^{-k t}): tight, and next to zero where nothing depends on q.
TEST(DerivativeFlow, IsTightOnALinearEquation) {
  const Program f = record(1, 3, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[1] - p[0] * x[0]; });
  const DerivativeFlow flow(f, {0, 1, 2, 3});
  const Tube tube = flow.enclose({Interval(1, 2), 0.5, 0.25, Interval(3, 4)}, 2);
  const std::vector<Interval>& x = tube.at(2);
  const Interval decay = exp(Interval(-1));
  EXPECT_LT(width(x[flow.derivative(0, 0)]), 1e-13);
  EXPECT_TRUE(contains(x[flow.derivative(0, 0)], midpoint(decay)));
  EXPECT_TRUE(contains(x[flow.derivative(0, 2)], midpoint((Interval(1) - decay) / 0.5)));
  EXPECT_TRUE(contains(x[flow.derivative(0, 3)], 0.0));
  EXPECT_LT(width(x[flow.derivative(0, 3)]), 1e-20);
  // ∂x/∂k = -t x0 e^{-kt} - u/k² (1 - e^{-kt}) + (u t/k) e^{-kt}
  const Interval byDecay = -2.0 * Interval(1, 2) * decay - (Interval(1) - decay) + decay;
  EXPECT_LT(width(x[flow.derivative(0, 1)]), 1.0001 * width(byDecay));
  EXPECT_TRUE(contains(x[flow.derivative(0, 1)], midpoint(byDecay)));
}

TEST(DerivativeFlow, RefusesJumpsOfWhatItIsBy) {
  const auto across = [](Recorded (*jump)(const Recorded& t, const Recorded& x, const Recorded& p)) {
    return record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
      dx[0] = 1.0;
      dx[1] = jump(t, x[0], p[0]);
    });
  };
  const Program ofState = across([](const Recorded&, const Recorded& x, const Recorded&) { return sign(x); });
  const Program ofParameter = across([](const Recorded&, const Recorded&, const Recorded& p) { return sign(p); });
  const Program ofTime = across([](const Recorded& t, const Recorded&, const Recorded&) { return sign(t - 0.5); });
  const Program ofKink = across([](const Recorded&, const Recorded& x, const Recorded&) { return abs(x); });
  EXPECT_THROW(DerivativeFlow(ofState, {0}), std::invalid_argument);
  EXPECT_THROW(DerivativeFlow(ofKink, ofState, {0}), std::invalid_argument) << "an output";
  EXPECT_THROW(DerivativeFlow(ofParameter, {2}), std::invalid_argument);
  EXPECT_NO_THROW(DerivativeFlow(ofParameter, {0}));
  EXPECT_NO_THROW(DerivativeFlow(ofTime, {0}));
  // |x| from -¾ … -½ to ¼ … ½: y = ½(x0² + (1 + x0)²), ∂y/∂x0 = 1 + 2 x0.
  const DerivativeFlow flow(ofKink, {0});
  const Tube tube = flow.enclose({Interval(-0.75, -0.5), 0.0, 0.0}, 1);
  EXPECT_TRUE(isSubset(Interval(-0.5, 0.0), tube.at(1)[flow.derivative(1, 0)]));
}

TEST(DerivativeFlow, RefusesWhatTheBoxDoesNotHave) {
  EXPECT_THROW(DerivativeFlow(drivenPendulum(), {5}), std::invalid_argument);
  EXPECT_THROW(DerivativeFlow(drivenPendulum(), {-1}), std::invalid_argument);
  FlowOptions options;
  options.varying = {{1}};
  EXPECT_THROW(DerivativeFlow(drivenPendulum(), {3}, options), std::invalid_argument);
  EXPECT_THROW(DerivativeFlow(drivenPendulum(), {0}).enclose({0.0, 0.0}, 1), std::invalid_argument);
  EXPECT_EQ(DerivativeFlow(drivenPendulum(), {}).enclose({0.1, 0.0, 1.0, 0.25, 0.5}, 1).at(1).size(), 2U);
}

}  // namespace
}  // namespace gamut::testing
