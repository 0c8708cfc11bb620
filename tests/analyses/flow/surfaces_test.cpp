// Jumps and kinks where something is zero that is not linear in the states: trajectories whose events are located in
// 128 bits must lie inside, exactly, and bounds are hardly wider than they.
#include "analyses/flow/surfaces.hpp"

#include <gmock/gmock.h>

#include <map>

#include "analyses/flow/embedding.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/analyses/flow/jumping_machine.hpp"

namespace gamut::testing {
namespace {

const auto keepAll = [](const std::vector<Side>&, const Vector&, Vector&) {};
const auto anySign = Interval(-1.0, 1.0);

/// ẋ of two or three states and so many parameters, once more with signs in place of absolute values.
template <class Of>
std::pair<Program, Program> withKinksAndSigns(int n, int k, Of f) {
  const auto size = [](const Recorded& u) { return abs(u); };
  const auto bySign = [](const Recorded& u) { return u * sign(u); };
  return {record(n, k, [=](auto t, const auto& x, const auto& p, auto& dx) { f(size, t, x, p, dx); }),
          record(n, k, [=](auto t, const auto& x, const auto& p, auto& dx) { f(bySign, t, x, p, dx); })};
}

const std::vector<JumpingMachine>& machines() {
  const auto wall = withKinksAndSigns(2, 2, [](auto size, auto, const auto& x, const auto& p, auto& dx) {
    const Recorded beyond = sin(x[0]) - p[0];
    dx[0] = x[1];
    dx[1] = -p[1] * 0.5 * (beyond + size(beyond)) * cos(x[0]);
  });
  const auto gear = withKinksAndSigns(3, 2, [](auto size, auto, const auto& x, const auto& p, auto& dx) {
    const Recorded apart = p[0] * x[0] - x[2];
    dx[0] = x[1];
    dx[1] = -x[0] - 0.25 * size(apart);
    dx[2] = 0.5 * p[1];
  });
  static const std::vector<JumpingMachine> machines{
      // What a wheel of uncertain radius carries along: slips, then rolls, and keeps rolling.
      {"Wheel",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                const Recorded slip = sign(x[0] - p[0] * x[1]);
                dx[0] = -p[1] * slip - 0.25 * x[0];
                dx[1] = p[0] * p[1] * slip;
              }),
       {0.0, 2.0, 1.0, 1.0},
       {0.0, anySign, anySign, anySign},
       3,
       [](const auto& sides, const Vector& p, Vector& x) {
         if (sides[0] == Side::held) x[0] = p[0] * x[1];
       },
       1.005},
      // A relay that brings a mass to its place by place and speed: passed once, then held.
      {"Relay",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -p[1] * sign(x[0] + p[0] * x[1]);
              }),
       {1.0, 0.0, 0.375, 2.0},
       {anySign, 0.0, anySign, anySign},
       2,
       [](const auto& sides, const Vector& p, Vector& x) {
         if (sides[0] == Side::held) x[0] = -p[0] * x[1];
       },
       1.005},
      // Across a disc in which something pulls.
      {"Disc",
       record(3, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = 1.0 + 0.0 * x[0];
                dx[1] = x[2];
                dx[2] = where(p[0] * p[0] - x[0] * x[0] - x[1] * x[1], p[1], Recorded(0.0));
              }),
       {-2.0, 0.125, 0.25, 1.0, -1.0},
       {0.0, anySign, anySign, anySign, anySign},
       4,
       keepAll,
       1.005},
      // A course that time and a quantity tell.
      {"Course",
       record(2, 2,
              [](auto t, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -p[1] * sign(x[0] + 0.5 - p[0] * sin(3.0 * t));
              }),
       {0.0, 1.0, 0.5, 2.0},
       {0.0, anySign, anySign, anySign},
       2,
       keepAll,
       1.005},
      // A sine that changes its sign, beside cosines of its angle and of another.
      {"Sine",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = 0.5 * cos(x[0]);
                dx[1] = 0.25 * p[0] * cos(x[1]) + 0.25 * cos(x[0]) - 0.125 * p[1] * sign(sin(x[1]));
              }),
       {0.25, -0.5, 1.0, 1.0},
       {0.0, anySign, anySign, anySign},
       3,
       keepAll,
       1.005},
      {"Wall", wall.first, {0.0, 1.0, 0.5, 64.0}, {0.0, anySign, anySign, anySign}, 1, keepAll, 1.005, wall.second},
      {"Gear",
       gear.first,
       {1.0, 0.0, 0.0, 2.0, 1.0},
       {anySign, 0.0, 0.0, anySign, anySign},
       3,
       keepAll,
       1.005,
       gear.second}};
  return machines;
}

class FlowSurfaces : public ::testing::TestWithParam<JumpingMachine> {};

TEST_P(FlowSurfaces, HoldTrajectories) { holdsTrajectories(GetParam(), {0.0, 1e-6, 0.02}, 6); }

INSTANTIATE_TEST_SUITE_P(Of, FlowSurfaces, ::testing::ValuesIn(machines()),
                         [](const auto& machine) { return machine.param.name; });

/// Arguments of time and a quantity alone: a state moves them only where time is one.
TEST(FlowSurfacesOfTime, AreHeldAsOthersAre) {
  const Program f =
      record(1, 1, [](auto t, const auto& x, const auto& p, auto& dx) { dx[0] = sign(sin(p[0] * t)) - 0.25 * x[0]; });
  const Program late = record(1, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = where(t - constant<Recorded>(Interval("0.3")) * p[0], Recorded(1.0), Recorded(-1.0)) - 0.25 * x[0];
  });
  for (const Program& each : {f, late}) {
    const Tube tube = Flow(each).enclose({0.5, Interval(1.5, 1.75)}, 3, {1.0, 2.5});
    ASSERT_EQ(tube.why(), "");
    SlidingReference reference(each, keepAll);
    for (const double p : {1.5, 1.625, 1.75}) {
      const std::vector<Vector> motion = reference({Precise(0.5), Precise(p)}, {1.0, 2.5, 3.0});
      for (std::size_t row = 0; row < motion.size(); ++row)
        EXPECT_THAT(tube.states(row + 1)[0], Encloses(motion[row][0]));
    }
    EXPECT_GT(reference.events, 0);
  }
}

FlowFormulation formulationOf(const Program& f) {
  const Program none = record(f.states(), f.parameters(), 0, [](const auto&, const auto&, const auto&, auto&) {});
  return {f, none, {}, none};
}

TEST(WithSurfaces, AddsAStateForEach) {
  const auto of = withSurfaces(formulationOf(record(2, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = sign(x[0] * x[1]) + sign(x[0]) + 3.0 * sign(p[0] * x[0] - sin(t)) + sign(p[0] * p[0] - 1.0);
    dx[1] = sign(x[0] * x[1]) * x[0];
  })));
  ASSERT_TRUE(of);
  EXPECT_EQ(of->motion.states(), 4);
  EXPECT_EQ(of->states, 2);
  // In which order is nobody's concern.
  Evaluator<Precise> starts(of->starts), rates(of->motion);
  const Vector p{Precise(7.0)};
  starts.setParameters(p);
  rates.setParameters(p);
  Vector x{Precise(0.5), Precise(-2.0), Precise(0.0), Precise(0.0)};
  const Vector at0 = starts(Precise(0.0), x);
  const std::size_t product = at0[0] == -1 ? 0 : 1, other = 1 - product;
  EXPECT_EQ(at0[product], -1);
  EXPECT_EQ(at0[other], 3.5);
  x[2 + product] = 2;  // the motion looks at these alone
  x[2 + other] = -3;
  const Vector dx = rates(Precise(0.0), x);
  EXPECT_EQ(dx[0], 1 + 1 - 3 + 1);
  EXPECT_EQ(dx[1], 0.5);
  EXPECT_EQ(dx[2 + product], dx[0] * x[1] + x[0] * dx[1]);
  EXPECT_EQ(dx[2 + other], 7 * dx[0] - 1);
}

TEST(WithSurfaces, AddsNoneForWhatIsLinearOrBendsItselfNorForKinks) {
  EXPECT_FALSE(withSurfaces(formulationOf(record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = sign(0.5 * x[0] - x[1] + p[0]) + abs(x[0] * x[1]);
    dx[1] = sign(x[0] * abs(x[1])) * sign(sin(p[0]));
  }))));
}

TEST(WithSurfaces, AddsNoMoreThanAreWorthIt) {
  EXPECT_FALSE(withSurfaces(formulationOf(record(1, 5, [](auto, const auto& x, const auto& p, auto& dx) {
    Recorded sum(0.0);
    for (const Recorded& each : p) sum += sign(each * x[0] - 1.0);
    dx[0] = sum;
  }))));
}

TEST(WithSurfaces, LeavesOutputsAloneThatDoNotJump) {
  const Program f =
      record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = -sign(x[0] * p[0] - 1.0); });
  const Program g = record(1, 1, 2, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = x[0] * p[0] - 1.0;
    y[1] = sign(x[0] * p[0] - 1.0);
  });
  const Program none = record(1, 1, 0, [](const auto&, const auto&, const auto&, auto&) {});
  const auto of = withSurfaces({f, g, {}, none});
  ASSERT_TRUE(of);
  Evaluator<Precise> outputs(of->outputs);
  outputs.setParameters(Vector{Precise(2.0)});
  const Vector y = outputs(Precise(0.0), Vector{Precise(3.0), Precise(-1.0)});
  EXPECT_EQ(y[0], 5);
  EXPECT_EQ(y[1], -1);
}

TEST(PlaceSurfaces, KeepsTheirDependenceOnWhatIsUncertain) {
  const auto of = withSurfaces(formulationOf(
      record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = -sign(x[0] * p[0] - 1.0); })));
  ASSERT_TRUE(of);
  const Box box = of->boxOf({Interval(1, 3), Interval(3, 5)});
  EXPECT_THAT(box[1], Encloses(Precise(2.0)));
  EXPECT_THAT(box[1], Encloses(Precise(14.0)));
  const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1, 1}, 2);
  FlowSet set = startOf(Embedding(box, 2, {}, {}, 1), 2, *monomials, 1);
  ASSERT_TRUE(placeSurfaces(set, of->starts, monomials));
  std::map<std::vector<int>, double> known;
  for (int m = 0; m < monomials->count(); ++m)
    known[{monomials->exponent(m, 0), monomials->exponent(m, 1)}] =
        set.p[static_cast<std::size_t>(monomials->count() + m)];
  const std::map<std::vector<int>, double> wanted{{{0, 0}, 7.0}, {{1, 0}, 4.0}, {{0, 1}, 2.0},
                                                  {{1, 1}, 1.0}, {{2, 0}, 0.0}, {{0, 2}, 0.0}};
  EXPECT_EQ(known, wanted);  // (2 + ξ)(4 + η) - 1
  EXPECT_LE(set.R[1], 1e-12);
}

TEST(PlaceSurfaces, SaysWhereTheyAreNotDefined) {
  const auto of = withSurfaces(formulationOf(
      record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = -sign(sqrt(x[0]) * p[0] - 1.0); })));
  ASSERT_TRUE(of);
  const Box box = of->boxOf({Interval(-1, 3), Interval(3, 5)});
  EXPECT_FALSE(isBounded(box[1]));
}

}  // namespace
}  // namespace gamut::testing
