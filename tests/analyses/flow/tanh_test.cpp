// The flow on tanh whose argument goes from one end, where it is ±1 to the last digit, through zero to the other:
// against solutions in closed form, since no series knows from out there what comes.
#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

const std::vector<double> times{0.05, 0.25, 0.39, 0.399, 0.4, 0.401, 0.404, 0.41, 0.43};

/// v' = -tanh(v/ε) has sinh(v/ε) = sinh(v_0/ε) e^{-t/ε}.
Precise slowed(const Precise& v, const Precise& epsilon, double t) {
  return Precise(epsilon * asinh(Precise(sinh(v / epsilon) * exp(-Precise(t) / epsilon))));
}

TEST(FlowOfTanh, BringsABodyToRestByFriction) {
  constexpr double epsilon = 0x1p-10;
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -tanh((1 / epsilon) * x[1]);
  });
  for (const Interval& start : {Interval(0.4), Interval(-0.4), Interval(0.396, 0.404), Interval(-0.4001, -0.3999)}) {
    const Tube tube = Flow(f).enclose({0.0, start}, times.back(), times);
    ASSERT_EQ(tube.why(), "") << start;
    for (std::size_t i = 0; i < tube.reachedTimes(); ++i)
      for (double part : {0.0, 0.37, 0.5, 1.0}) {
        const double v = std::clamp(start.lower() + part * width(start), start.lower(), start.upper());
        EXPECT_THAT(tube.states(i)[1], Encloses(slowed(v, epsilon, tube.times()[i]))) << v << " at " << tube.times()[i];
      }
    // The last speeds differ by less and less; a thin start stays thin.
    EXPECT_LT(width(tube.at(times.back())[1]), 1e-10) << start;
    EXPECT_LT(width(tube.at(times.back())[0]), 1.001 * 0.4 * width(start) + 1e-12) << start;
  }
}

TEST(FlowOfTanh, FollowsASwitchFromOneEndToTheOther) {
  // x' = a tanh(400 (t - 1)): x = x_0 + a (log cosh(400 (t - 1)) - log cosh 400) / 400.
  const Program f =
      record(1, 1, [](auto t, const auto&, const auto& p, auto& dx) { dx[0] = p[0] * tanh(400.0 * (t - 1.0)); });
  const Interval a(0.5, 0.75);
  const std::vector<double> at{0.5, 0.96, 0.99, 0.998, 1.0, 1.003, 1.5, 2.0};
  for (int order : {8, 20, 30})
    for (double tolerance : {1e-15, 1e-6}) {
      FlowOptions options;
      options.order = order;
      options.tolerance = tolerance;
      const Tube tube = Flow(f, options).enclose({0.25, a}, 2.0, at);
      ASSERT_EQ(tube.why(), "");
      for (std::size_t i = 0; i < tube.reachedTimes(); ++i)
        for (double slope : {a.lower(), a.upper(), 0.6}) {
          const Precise u = 400 * (Precise(tube.times()[i]) - 1);
          const Precise x = 0.25 + slope * (log(cosh(u)) - log(cosh(Precise(400)))) / 400;
          EXPECT_THAT(tube.states(i)[0], Encloses(x)) << order << ' ' << tolerance << " at " << tube.times()[i];
        }
      EXPECT_LT(width(tube.at(2.0)[0]), 1e-12 + 100 * tolerance) << order << ' ' << tolerance;
    }
}

TEST(FlowOfTanh, HoldsTrajectoriesThroughTheKnee) {
  for (const Interval& start : {Interval(0.3), Interval(0.29, 0.31)}) {
    Containment c;
    c.f = record(2, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
      dx[0] = x[1];
      dx[1] = -p[0] * tanh(100.0 * x[1]) - 0.125 * x[0] + 0.1 * sin(3.0 * t);
    });
    c.g = standardOutputs(2, 1);
    c.box = {0.25, start, 1.0};
    c.horizon = 0.6;
    c.times = {0.1, 0.25, 0.3, 0.32, 0.4};
    expectContainment(c, 4);
  }
}

TEST(FlowOfTanh, IsBoundedUpToTheLargestArguments) {
  for (double factor : {1e150, 8e307}) {
    const Program f = record(1, 0, [&](auto, const auto& x, const auto&, auto& dx) { dx[0] = tanh(factor * x[0]); });
    EXPECT_NO_THROW({
      const Tube tube = Flow(f).enclose({1.5}, 1);
      EXPECT_EQ(tube.why().empty(), tube.reached() == 1);
      EXPECT_TRUE(tube.reached() < 1 || contains(tube.at(1)[0], 2.5));
    }) << factor;
  }
}

}  // namespace
}  // namespace gamut::testing
