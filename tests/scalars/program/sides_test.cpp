// Jumps on one side, on the other, and held between.
#include "scalars/program/sides.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scalars/evaluation/evaluate.hpp"
#include "scalars/program/linear_form.hpp"
#include "scalars/recorded.hpp"

namespace gamut::testing::sides_test {
namespace {

/// A mass on a spring that rubs: states x, v; parameter c.
Program rubbing() {
  return record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -(p[0] * x[0]) - 3.0 * sign(x[1]);
  });
}

TEST(Sides, AboveAndBelowAreTheTwoSides) {
  const Program f = rubbing();
  ASSERT_EQ(jumpsOf(f).size(), 1u);
  const std::vector<double> x{0.5, 0.0}, p{2.0};
  for (const Side side : {Side::below, Side::between, Side::above}) {
    const double s = static_cast<double>(side);
    EXPECT_EQ(evaluate<double>(onSides(f, std::vector{side}), x, p, 0.0), (std::vector{0.0, -1.0 - 3 * s, 0.0, s}));
  }
}

TEST(Sides, HeldIsTheMeanThatStays) {
  const std::vector<double> x{0.5, 0.0}, p{2.0};
  const std::vector<double> y = evaluate<double>(onSides(rubbing(), std::vector{Side::held}), x, p, 0.0);
  EXPECT_EQ(y[0], 0);
  EXPECT_NEAR(y[1], 0, 1e-16);
  EXPECT_NEAR(y[3], -1.0 / 3, 1e-16);
}

TEST(Sides, RatesOfArgumentsAreAlongTheMotion) {
  const Program f = record(2, 0, [](auto t, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -x[0] - sign(x[1] - x[0] * t);
  });
  const std::vector<double> y =
      evaluate<double>(withSignsGiven(f), std::vector{2.0, 3.0}, std::vector{0.5}, 5.0);  // s = 0.5
  EXPECT_EQ(y, (std::vector{3.0, -2.5, -7.0, -2.5 - 3.0 * 5.0 - 2.0}));
}

/// What rubs, and the acceleration: at standstill the first holds still.
TEST(Sides, OutputsAreThoseOfTheSide) {
  const Program g = record(2, 1, 4, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = -3.0 * sign(x[1]);
    y[1] = -(p[0] * x[0]) - 3.0 * sign(x[1]);
    y[2] = sign(-2.0 * x[1]);     // of the same surface
    y[3] = sign(x[0]) + sign(t);  // of none
  });
  const std::vector<double> x{0.5, 0.0}, p{2.0};
  const auto found = [&](Side side) {
    return evaluate<double>(outputsOnSides(rubbing(), g, std::vector{side}), x, p, 0.0);
  };
  EXPECT_EQ(found(Side::above), (std::vector{-3.0, -4.0, -1.0, 1.0}));
  EXPECT_EQ(found(Side::below), (std::vector{3.0, 2.0, 1.0, 1.0}));
  const std::vector<double> held = found(Side::held);
  EXPECT_NEAR(held[0], 1.0, 1e-15);
  EXPECT_NEAR(held[1], 0.0, 1e-15);
  EXPECT_NEAR(held[2], 1.0 / 3, 1e-15);
  EXPECT_EQ(held[3], 1.0);
  EXPECT_EQ(evaluate<double>(withSignsGiven(rubbing(), g), x, {2.0, 0.5}, 0.0), (std::vector{-1.5, -2.5, -0.5, 1.0}));
}

/// Of two, one is held: what holds it depends on the other's sign, which is a parameter.
TEST(Sides, OpenSignsMayBeGiven) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    const auto first = sign(x[0]);
    dx[1] = -sign(x[1]);
    dx[0] = p[0] - 2.0 * first - 0.5 * dx[1];
  });
  const Program g = record(2, 1, 3, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = sign(3.0 * x[0]);
    y[1] = sign(-x[1]);
    y[2] = sign(x[0] + x[1]);  // of none
  });
  const Program given = outputsWithOpenSignsGiven(f, g, std::vector{Side::held, Side::open});
  EXPECT_EQ(given.parameters(), 3);
  const std::vector<double> x{0.0, 7.0}, p{0.25, 99.0, -0.5};  // the held one's is not looked at
  const std::vector<double> y = evaluate<double>(given, x, p, 0.0);
  EXPECT_NEAR(y[0], 0.0, 1e-15);  // (0.25 - 0.25)/2
  EXPECT_EQ(y[1], 0.5);
  EXPECT_EQ(y[2], 1.0);
  EXPECT_EQ(evaluate<double>(argumentsOfSigns(f), x, p, 0.0), x);
}

/// Two rubbing masses that one matrix couples: M v' = F - μ sign(v).
TEST(Sides, SeveralAreHeldAtOnce) {
  const Program f = record(2, 2, [](auto, const auto& v, const auto& p, auto& dv) {
    const auto a = p[0] - 2.0 * sign(v[0]), b = p[1] - 4.0 * sign(v[1]);  // inverse of [[2, 1], [1, 1]]
    dv[0] = a - b;
    dv[1] = 2.0 * b - a;
  });
  const std::vector<double> v{0.0, 0.0}, p{1.0, -3.0};
  const std::vector<double> both = evaluate<double>(onSides(f, std::vector{Side::held, Side::held}), v, p, 0.0);
  EXPECT_NEAR(both[0], 0, 1e-15);
  EXPECT_NEAR(both[1], 0, 1e-15);
  EXPECT_NEAR(both[4], 0.5, 1e-15);
  EXPECT_NEAR(both[5], -0.75, 1e-15);
  const std::vector<double> one =
      evaluate<double>(onSides(f, std::vector{Side::above, Side::held}), v, p, 0.0);  // a = -1: 2b = a
  EXPECT_NEAR(one[0], -0.5, 1e-15);
  EXPECT_NEAR(one[1], 0, 1e-15);
  EXPECT_NEAR(one[5], (-3.0 + 0.5) / 4, 1e-15);
}

/// What holds is a force: coefficients that scale it have no part in what follows, however little is known of them.
TEST(Sides, WhatHoldsDoesNotDependOnItsCoefficient) {
  const Program f = record(3, 2, [](auto t, const auto& v, const auto& p, auto& dv) {
    const auto first = p[0] * (2.0 * -sign(v[0])), second = p[1] * sqr(p[0]) * sign(v[1]);
    dv[0] = t + first - 0.5 * second;
    dv[1] = 0.25 + 0.5 * first - second;
    dv[2] = first + second;
  });
  const std::vector<Interval> v{Interval(0), Interval(0), Interval(0)}, p{Interval(1, 2), Interval(0.5, 3)};
  for (const bool both : {false, true}) {
    const Side other = both ? Side::held : Side::between;
    const std::vector<Interval> y = evaluate<Interval>(onSides(f, std::vector{Side::held, other}), v, p, Interval(0.5));
    const double truth = -0.5;  // of the first: 0.5 + first - second/2 = 0 = 0.25 + first/2 - second
    EXPECT_TRUE(contains(y[2], truth)) << y[2];
    EXPECT_LT(width(y[2]), 1e-14);
    EXPECT_TRUE(contains(y[5], -truth / 2)) << y[5];  // -first/(2 p), of p in [1, 2]
    EXPECT_TRUE(contains(y[5], -truth / 4)) << y[5];
  }
}

TEST(Sides, ProductsOfSignsAreNotAffine) {
  const auto isAffine = [](const auto& formula) {
    return isAffineInSigns(record(2, 0, [&](auto, const auto& x, const auto&, auto& dx) {
      dx[0] = x[1];
      dx[1] = formula(x);
    }));
  };
  EXPECT_TRUE(isAffine([](const auto& x) { return -x[0] * sign(x[1]) - 2.0 * sign(x[0]); }));
  EXPECT_TRUE(isAffine([](const auto& x) { return sin(x[0]); }));
  EXPECT_FALSE(isAffine([](const auto& x) { return sign(x[0]) * sign(x[1]); }));
  EXPECT_FALSE(isAffine([](const auto& x) { return 1.0 / (2.0 + sign(x[1])); }));
  EXPECT_FALSE(isAffine([](const auto& x) { return sqr(3.0 + sign(x[1])); }));
  EXPECT_FALSE(isAffine([](const auto& x) { return sign(x[0] + sign(x[1])); }));
}

TEST(Sides, OneSignToTheFirstPowerIsTheSameOnBothSides) {
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sign(x[1]) * where(x[1], Recorded(2.0), x[0]) + sqr(3.0 + sign(x[1]));
  });
  const Program affine = affineInSign(f);
  EXPECT_FALSE(isAffineInSigns(f));
  EXPECT_TRUE(isAffineInSigns(affine));
  for (const double v : {-2.0, 0.25}) {
    const std::vector<double> x{0.75, v};
    EXPECT_EQ(evaluate<double>(affine, x), evaluate<double>(f, x));
  }
  EXPECT_EQ(evaluate<double>(affine, std::vector{0.75, 0.0})[1], 0.5 * ((16 - 2.0) + (4 + 0.75)));
  const Program root = record(
      1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = sqrt(x[0] * sign(x[0])); });  // not on both sides
  EXPECT_TRUE(isIdentical(affineInSign(root), root));
}

TEST(LinearForms, AreThoseOfArguments) {
  const Program f = record(3, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = sign(-2.0 * (x[0] - x[2]) + 0.5 * p[0] - 3.0);
    dx[1] = sign(x[0] * x[1]);
    dx[2] = sign(p[0] - 1.0) + sign(x[1] - t);
  });
  std::vector<std::optional<LinearForm>> forms;
  for (const int jump : jumpsOf(f)) forms.push_back(linearFormOf(f, f.nodes()[static_cast<std::size_t>(jump)].a));
  ASSERT_EQ(forms.size(), 4u);
  ASSERT_TRUE(forms[0].has_value());
  const double sense = forms[0]->states[0] / -2.0;  // a sign may have been taken out
  EXPECT_EQ(std::fabs(sense), 1);
  EXPECT_EQ(forms[0]->states, (std::vector{-2 * sense, 0.0, 2 * sense}));
  EXPECT_EQ(forms[0]->parameters, std::vector{0.5 * sense});
  EXPECT_TRUE(isEqual(forms[0]->constant, Interval(-3.0 * sense)));
  for (std::size_t other : {1u, 2u, 3u}) EXPECT_FALSE(forms[other].has_value()) << other;
  const LinearForm a{{0, 1, -1}, {2}, Interval(-0.5), 1}, b{{0, -3, 3}, {-6}, Interval(1.5), 1};
  LinearForm c = b;
  c.constant = Interval(1.25);
  const LinearForm alone{{0, 0, 1}, {0}, Interval(0.0), 2};
  const std::vector<std::pair<std::size_t, int>> follow{{1, 2}, {0, 1}};  // x₂ first, then x₁ from it
  EXPECT_EQ(statesThatFollow({&a, &alone}), follow);
  EXPECT_EQ(signOfRatio(a, b), -1);
  EXPECT_EQ(signOfRatio(b, b), 1);
  EXPECT_EQ(signOfRatio(c, b), 0);
  EXPECT_EQ(signOfRatio({{0, 1, 0}, {0}, Interval(0.0), 1}, {{0, 1, 1}, {0}, Interval(0.0), 1}), 0);
}

/// A held argument of one state rests exactly, whatever rounding leaves of its rate.
TEST(Sides, HeldStatesRestExactly) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1] + 0.1;
    dx[1] = -(p[0] * x[0]) - 0.3 * sign(x[1]);
  });
  for (const double x : {0.1, 0.7, 1.3}) {
    const std::vector<double> y = evaluate<double>(onSides(f, std::vector{Side::held}), {x, 0.0}, {0.1});
    EXPECT_EQ(y[0], 0.1);
    EXPECT_EQ(y[1], 0);
  }
}

/// One held and one open: on both sides of the open one what both sides fixed give.
TEST(Sides, OpenOnesKeepTheirSigns) {
  const Program f = record(2, 0, [](auto, const auto& v, const auto&, auto& dv) {
    const auto a = 1.0 - 2.0 * sign(v[0]), b = -3.0 - 4.0 * sign(v[1] - 1.0);
    dv[0] = a - b;
    dv[1] = 2.0 * b - a;
  });
  for (const double v : {0.5, 1.5}) {
    const std::vector<double> x{0.0, v};
    const Side side = v > 1 ? Side::above : Side::below;
    const std::vector<double> open = evaluate<double>(onSides(f, std::vector{Side::held, Side::open}), x);
    const std::vector<double> fixed = evaluate<double>(onSides(f, std::vector{Side::held, side}), x);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(open[i], fixed[i], 1e-14);
    EXPECT_EQ(open[5], static_cast<double>(side));
  }
}

TEST(Sides, RefusesWhatCannotBe) {
  const Program of = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1] - sign(x[1]);
    dx[1] = 1.0;
  });
  EXPECT_THROW(onSides(of, std::vector{Side::held}), std::domain_error);
  EXPECT_THROW(onSides(of, std::vector{Side::above, Side::above}), std::invalid_argument);
  const Program nested =
      record(1, 0, [](auto t, const auto& x, const auto&, auto& dx) { dx[0] = -sign(x[0] + sign(t - 1.0)); });
  EXPECT_THROW(onSides(nested, std::vector{Side::open, Side::open}), std::invalid_argument);
}

TEST(Sides, MultiplesShareTheirSign) {
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = 0.5 - sign(x[0] - x[1]) + sign(x[0] - 1.0);
    dx[1] = sign(3.0 * (x[1] - x[0])) - 2.0 * sign(2.0 * x[0] - 2.0);
  });
  const Program one = withOneSignASurface(f);
  EXPECT_EQ(jumpsOf(f).size(), 4u);
  EXPECT_EQ(jumpsOf(one).size(), 2u);
  for (const double a : {0.25, 1.5})
    for (const double b : {0.5, 1.25}) EXPECT_EQ(evaluate<double>(one, {a, b}), evaluate<double>(f, {a, b}));
}

TEST(Sides, ConstantFactorsAreTakenOffArguments) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = sign(-(0.1 * (x[0] - p[0])) / 0.3) + sign(0.7 * (0.9 * x[0] * x[1]));
    dx[1] = sign(p[0] * x[0]) + 3.0 * sign(x[0] - p[0]);
  });
  const Program plain = withOneSignASurface(f);
  EXPECT_EQ(jumpsOf(plain).size(), 3u);
  EXPECT_TRUE(linearFormOf(plain, plain.nodes()[static_cast<std::size_t>(jumpsOf(plain)[0])].a));
  for (const double a : {-0.25, 1.5})
    for (const double b : {-0.5, 0.0, 1.25})
      EXPECT_EQ(evaluate<double>(plain, {a, b}, {0.5}), evaluate<double>(f, {a, b}, {0.5}));
}

TEST(Sides, KinksWhereASignJumpsJumpWithIt) {
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = sign(2.0 * x[0] - 1.0) * x[1] - abs(0.5 - x[0]) + abs(x[1]);
    dx[1] = x[0];
  });
  const Program jumping = withJumpingKinks(f);
  EXPECT_EQ(std::ranges::count(f.nodes(), Op::abs, &Node::op), 2);
  EXPECT_EQ(std::ranges::count(jumping.nodes(), Op::abs, &Node::op), 1);
  EXPECT_EQ(jumpsOf(withOneSignASurface(jumping)).size(), 1u);
  for (const double a : {0.25, 0.5, 1.5})
    for (const double b : {-0.5, 1.25}) EXPECT_EQ(evaluate<double>(jumping, {a, b}), evaluate<double>(f, {a, b}));
  const Program ofKinks = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = -sign(x[0]) / (1.0 + abs(x[0]));  // affine in its sign, which |x| as x sign x would end
  });
  EXPECT_EQ(withJumpingKinks(ofKinks).nodes().size(), ofKinks.nodes().size());
}

TEST(Sides, FactorsWithoutStatesAreTakenOffKinks) {
  const Program f = record(2, 2, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = max(Recorded(0.0), -p[0] * x[0]) + abs(-(x[0] - p[1]) / p[0]);
    dx[1] = abs(0.1 * sin(t) * (x[0] * x[1])) + abs(p[0] * p[1]) + abs(x[0] + p[0]);
  });
  const Program bare = withBareKinks(f);
  int linear = 0;
  for (const Node& node : bare.nodes())
    if (node.op == Op::abs && linearFormOf(bare, node.a)) ++linear;
  EXPECT_EQ(linear, 3);
  for (const double a : {-0.25, 0.0, 1.5})
    for (const double k : {-2.0, 3.0}) {
      const std::vector<double> was = evaluate<double>(f, {a, 0.75}, {k, 0.5}),
                                is = evaluate<double>(bare, {a, 0.75}, {k, 0.5});
      for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(is[i], was[i], 1e-15 * std::abs(was[i])) << a << " " << k;
    }
  EXPECT_TRUE(isIdentical(withBareKinks(bare), bare));
}

TEST(Sides, FactorsWithoutStatesAreTakenOffSigns) {
  const Program f = record(2, 2, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = sign(-p[0] * x[0]) + sign(-(x[0] - p[1]) / p[0]);
    dx[1] = sign(0.1 * sin(t) * (x[0] * x[1])) + sign(p[0] * p[1]) + sign(x[0] + p[0]);
  });
  const Program bare = withBareSigns(f);
  int linear = 0;
  for (const int jump : jumpsOf(bare))
    if (const auto form = linearFormOf(bare, bare.nodes()[static_cast<std::size_t>(jump)].a))
      linear += form->states[0] != 0 || form->states[1] != 0;
  EXPECT_EQ(linear, 3);
  for (const double a : {-0.25, 0.0, 0.5, 1.5})
    for (const double k : {-2.0, 3.0})
      EXPECT_EQ(evaluate<double>(bare, {a, 0.75}, {k, 0.5}), evaluate<double>(f, {a, 0.75}, {k, 0.5})) << a << " " << k;
  EXPECT_TRUE(isIdentical(withBareSigns(bare), bare));
}

}  // namespace
}  // namespace gamut::testing::sides_test
