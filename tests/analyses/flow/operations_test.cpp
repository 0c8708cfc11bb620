// The flow on every elementary function and on random right-hand sides, from thin and wide boxes of one to three
// uncertain quantities, with outputs, against trajectories of the reference.
#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

/// x' built from one function of both states, of time and of the parameter; bounded enough to be followed for a second.
Program withFunction(const std::string& name) {
  return record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = 0.5 * apply(name, {x[0], 0.8}, {x[1] + t, 0.5}).value - 0.3 * x[0];
    dx[1] = 0.4 * apply(name, {x[1] - 0.5 * t, 0.3}, {p[0], 0.7}).value * p[0] - x[1];
  });
}

class FlowOfFunction : public ::testing::TestWithParam<std::string> {};

TEST_P(FlowOfFunction, HoldsTrajectoriesFromThinAndWideBoxes) {
  const Program f = withFunction(GetParam());
  const std::vector<Box> boxes = {{0.8, 0.4, 0.7},
                                  {Interval(0.75, 0.85), 0.4, 0.7},
                                  {0.8, Interval(0.3, 0.5), Interval(0.6, 0.8)},
                                  {Interval(0.79, 0.81), Interval(0.39, 0.41), Interval(0.65, 0.75)}};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    SCOPED_TRACE("box " + std::to_string(i));
    Containment c{f, boxes[i], 1.0, {0.1, 0.35, 0.7}};
    c.g = standardOutputs(2, 1);
    c.options.order = i % 2 == 0 ? 20 : 8;
    if (i % 2 == 1) c.options.tolerance = 1e-9;
    c.options.degree = i == 0 ? -1 : 3;
    c.options.maxPieces = 8;
    expectContainment(c, 4);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Flow, FlowOfFunction, ::testing::ValuesIn(elementaryNames()),
                         [](const auto& name) { return name.param; });

TEST(Flow, OfRandomRightHandSidesHoldsTrajectories) {
  Points points(17);
  int followed = 0;
  for (int round = 0; round < 80; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    RandomExpressions expression(points, nominal);
    Containment c;
    c.f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) { expression(t, x, p, dx, 6); });
    c.g = record(2, 1, 3, [&](auto t, const auto& x, const auto& p, auto& y) { expression(t, x, p, y, 5); });
    for (double value : nominal) c.box.push_back(value + Interval(-1, 1) * (points.integer(0, 2) * 0.02));
    c.horizon = 0.6;
    c.times = {0.1, 0.45};
    c.options.order = points.integer(4, 30);
    c.options.tolerance = std::pow(10.0, -points.integer(5, 16));
    c.options.degree = points.integer(1, 5);
    c.options.frameDegree = points.integer(0, 3);
    c.options.splitDefect = std::pow(10.0, -points.integer(4, 9));
    c.options.maxPieces = points.integer(1, 6);
    Judge judge(c, static_cast<unsigned>(round));
    followed += judge.tube().why().empty();
    judge.judge(4);
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(followed, 70);
}

TEST(EncloseImage, HoldsOutputsOfRandomExpressionsAndIsNestedInSubBoxes) {
  Points points(23);
  for (int round = 0; round < 60; ++round) {
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    RandomExpressions expression(points, nominal);
    const Program g =
        record(2, 1, 2, [&](auto t, const auto& x, const auto& p, auto& y) { expression(t, x, p, y, 6); });
    Box box, inner;
    for (double value : nominal) {
      const double half = points.integer(0, 2) * 0.1;
      box.push_back(value + Interval(-half, half));
      inner.push_back(value + Interval(-0.5 * half, 0.25 * half));
    }
    const auto ranges = encloseImage(g, 0.125, box, {inner}, points.integer(1, 5));
    Evaluator<Precise> outputs(g);
    for (int sample = 0; sample < 8; ++sample) {
      const bool isInner = sample % 2 == 1;
      const Vector at = sample < 4 ? points.corner(isInner ? inner : box) : points.inside(isInner ? inner : box);
      outputs.setParameters(Vector{at[2]});
      const Vector y = outputs(Precise(0.125), Vector{at[0], at[1]});
      for (std::size_t i = 0; i < y.size(); ++i) {
        if (!isfinite(y[i])) continue;  // outside the domain of g
        ASSERT_THAT(ranges[0][i], Encloses(y[i]));
        if (isInner) {
          ASSERT_THAT(ranges[1][i], Encloses(y[i]));
        }
        EXPECT_TRUE(isSubset(ranges[1][i], ranges[0][i]));
      }
    }
  }
}

}  // namespace
}  // namespace gamut::testing
