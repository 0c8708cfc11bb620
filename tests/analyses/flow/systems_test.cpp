// The flow on classical systems, from thin and wide boxes, judged by trajectories of the reference; and the published
// double pendulum, whose enclosures must be as tight as the published and sampled figures say.
#include "analyses/flow/derivatives.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

struct System {
  std::string name;
  Program f;
  std::vector<double> start;
  std::vector<double> radius;  // of the wide box, one a start value and a parameter
  double horizon;
};

void PrintTo(const System& system, std::ostream* out) { *out << system.name; }

/// Four-bar linkage in the angles q of its bars (crank 1, coupler 2, rocker 2 about (2.5, 0)), unit masses at both
/// moving joints, a moment on the crank: [M Gᵀ; G 0] [q̈; λ] = [Q; −Ġ q̇], symmetric and indefinite.
Program fourBar() {
  return record(6, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    const Recorded s1 = sin(x[0]), c1 = cos(x[0]), s2 = sin(x[1]), c2 = cos(x[1]), s3 = sin(x[2]), c3 = cos(x[2]);
    const Recorded zero(0.0), coupling = 2.0 * (c1 * c2 + s1 * s2), w1 = sqr(x[3]), w2 = sqr(x[4]), w3 = sqr(x[5]);
    const Recorded turning = 2.0 * (c1 * s2 - s1 * c2);  // of both masses, from the velocities of the two bars
    const LinearSystem<Recorded> system(MatrixKind::general, 5,
                                        {2.0,      coupling,  zero,      -s1,       c1,         //
                                         coupling, 4.0,       zero,      -2.0 * s2, 2.0 * c2,   //
                                         zero,     zero,      0.5,       2.0 * s3,  -2.0 * c3,  //
                                         -s1,      -2.0 * s2, 2.0 * s3,  zero,      zero,       //
                                         c1,       2.0 * c2,  -2.0 * c3, zero,      zero});
    std::vector<Recorded> y{turning * w2 - 2.0 * 9.81 * c1 + p[0], -turning * w1 - 2.0 * 9.81 * c2, zero,
                            c1 * w1 + 2.0 * c2 * w2 - 2.0 * c3 * w3, s1 * w1 + 2.0 * s2 * w2 - 2.0 * s3 * w3};
    system.solve(y);
    for (std::size_t i = 0; i < 3; ++i) {
      dx[i] = x[3 + i];
      dx[3 + i] = y[i];
    }
  });
}

std::vector<System> systems() {
  return {
      {"Lorenz",
       record(3, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = 10.0 * (x[1] - x[0]);
                dx[1] = x[0] * (p[0] - x[2]) - x[1];
                dx[2] = x[0] * x[1] - x[2] * 8.0 / 3.0;
              }),
       {1.0, 2.0, 20.0, 28.0},
       {0.05, 0.0, 0.1, 0.0},
       1.5},
      {"VanDerPol",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = p[0] * (1.0 - sqr(x[0])) * x[1] - x[0];
              }),
       {1.4, 2.4, 1.0},
       {0.15, 0.05, 0.0},
       4.0},
      {"LotkaVolterra",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = p[0] * x[0] * (1.0 - x[1]);
                dx[1] = p[1] * x[1] * (x[0] - 1.0);
              }),
       {1.2, 1.1, 3.0, 1.0},
       {0.0, 0.0, 0.01, 0.01},
       5.0},
      {"Brusselator",
       record(2, 0,
              [](auto, const auto& x, const auto&, auto& dx) {
                const auto cycle = sqr(x[0]) * x[1];
                dx[0] = 1.0 + cycle - 4.0 * x[0];
                dx[1] = 3.0 * x[0] - cycle;
              }),
       {1.0, 1.0},
       {0.05, 0.05},
       5.0},
      {"Kepler",
       record(4, 0,
              [](auto, const auto& x, const auto&, auto& dx) {
                const auto r2 = sqr(x[0]) + sqr(x[1]);
                const auto r3 = r2 * sqrt(r2);
                dx[0] = x[2];
                dx[1] = x[3];
                dx[2] = -x[0] / r3;
                dx[3] = -x[1] / r3;
              }),
       {0.5, 0.0, 0.0, 1.75},
       {0.005, 0.0, 0.0, 0.0},
       5.0},
      {"Duffing",
       record(2, 1,
              [](auto t, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = x[0] - x[0] * sqr(x[0]) - 0.25 * x[1] + p[0] * cos(1.5 * t);
              }),
       {0.5, 0.1, 0.3},
       {0.02, 0.0, 0.02},
       5.0},
      {"Robertson",
       record(3, 0,
              [](auto, const auto& x, const auto&, auto& dx) {
                const auto first = 0.04 * x[0], second = 30.0 * sqr(x[1]), third = 10.0 * x[1] * x[2];
                dx[0] = third - first;
                dx[1] = first - third - second;
                dx[2] = second;
              }),
       {1.0, 0.0, 0.0},
       {0.01, 0.0, 0.01},
       10.0},
      {"FourBarWithMultipliers",
       fourBar(),
       {0.9, 0.6419199037671257, 1.709487822156159, 0.0, 0.0, 0.0, 3.0},
       {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.3},
       2.0},
  };
}

class ClassicalSystem : public ::testing::TestWithParam<System> {
 protected:
  Containment containment(double scale) const {
    const System& s = GetParam();
    Containment c;
    c.f = s.f;
    for (std::size_t i = 0; i < s.start.size(); ++i)
      c.box.push_back(s.start[i] + Interval(-1, 1) * (scale * s.radius[i]));
    c.horizon = s.horizon;
    c.times = {0.1 * s.horizon, 0.5 * s.horizon, 0.83 * s.horizon};
    c.g = standardOutputs(s.f.states(), s.f.parameters());
    return c;
  }
};

TEST_P(ClassicalSystem, HoldsTheTrajectoryFromAThinStart) {
  const Tube tube = expectContainment(containment(0), 1);
  for (const Interval& state : tube.at(GetParam().horizon)) EXPECT_LT(width(state), 1e-9);
}

TEST_P(ClassicalSystem, HoldsTrajectoriesFromAWideBox) {
  Containment c = containment(1);
  c.options.maxPieces = 30;
  c.options.splitDefect = 1e-6;
  expectContainment(c, 6);
}

TEST_P(ClassicalSystem, HoldsTrajectoriesWithoutSplitting) {
  Containment c = containment(0.2);
  c.options.split = false;
  c.options.tolerance = 1e-8;
  c.options.order = 9;
  c.options.degree = 3;
  expectContainment(c, 6, false);
}

INSTANTIATE_TEST_SUITE_P(Flow, ClassicalSystem, ::testing::ValuesIn(systems()),
                         [](const auto& system) { return system.param.name; });

/// Rauh, Auer, Hofer (SCAN 2006), eq. (24) with m = l = 1, by Cramer's rule. States (ψ1, ψ2, ψ1', ψ2').
template <class S, class States, class Rates>
void doublePendulum(const S& g, const States& x, Rates& dx) {
  const auto c = cos(x[1]), s = sin(x[1]), sum = x[2] + x[3];
  const auto m12 = 1.0 + c, m11 = 2.0 + c;  // each row divided by its common factors
  const auto b1 = s * sqr(sum) - 2.0 * g * sin(x[0]), b2 = -g * sin(x[0] + x[1]) - s * sqr(x[2]);
  const auto d = m11 - c * m12;
  dx[0] = x[2];
  dx[1] = x[3];
  dx[2] = (b1 - c * b2) / d;
  dx[3] = (m11 * b2 - m12 * b1) / d;
}

Containment doublePendulumWithin(double relative) {
  Containment c;
  c.f = record(4, 0, [](auto, const auto& x, const auto&, auto& dx) {
    doublePendulum(constant<Recorded>(Interval("9.81")), x, dx);
  });
  c.truth = record(4, 1, [](auto, const auto& x, const auto& p, auto& dx) { doublePendulum(p[0], x, dx); });
  c.decimals = {Precise("9.81")};
  c.box = {0.75 * pi() * Interval(1 - relative, 1 + relative), -11.0 * pi() / 20.0, Interval("0.43"), Interval("0.67")};
  return c;
}

TEST(PublishedPendulum, ThinStartStaysAsThinAsPromised) {
  Containment c = doublePendulumWithin(0);
  c.horizon = 10;
  c.times = {1, 5};
  Judge judge(c);
  const Precise pi = acos(Precise(-1.0));
  judge.follow({pi * 3 / 4, pi * -11 / 20, Precise("0.43"), Precise("0.67")});
  for (const Interval& state : judge.tube().at(1)) EXPECT_LE(width(state), 3e-13);
  for (const Interval& state : judge.tube().at(10)) EXPECT_LE(width(state), 6e-11);
}

/// `value` in two doubles.
PreciseValue preciseValue(int component, const Precise& value) {
  PreciseValue result;
  result.component = component;
  result.high = static_cast<double>(value);
  result.low = static_cast<double>(Precise(value - result.high));
  result.radius = 0x1p-106 * std::fabs(result.high);
  return result;
}

TEST(PublishedPendulum, IsKnownToItsLastDigitsWhereItsNumbersAre) {
  Containment c = doublePendulumWithin(0);
  c.f = *c.truth;  // gravity is a parameter
  c.truth = {};
  c.decimals = {};
  c.box.push_back(Interval("9.81"));
  c.g = standardOutputs(4, 1);
  c.horizon = 10;
  c.times = {1, 5};
  const Precise pi = acos(Precise(-1.0));
  const Vector start{pi * 3 / 4, pi * -11 / 20, Precise("0.43"), Precise("0.67"), Precise("9.81")};
  for (int i = 0; i < 5; ++i) c.options.precise.push_back(preciseValue(i, start[static_cast<std::size_t>(i)]));
  Judge judge(c);
  judge.follow(start);
  for (const Interval& state : judge.tube().at(1)) EXPECT_LE(width(state), 1e-15);
  for (const Interval& state : judge.tube().at(10)) EXPECT_LE(width(state), 1e-14);
}

/// Doubles are known so; at last the remainder gets symbols of its own.
TEST(PublishedPendulum, FromDoublesStaysOneUnitWideForLong) {
  Containment c;
  c.f = record(4, 0, [](auto, const auto& x, const auto&, auto& dx) { doublePendulum(Recorded(9.8125), x, dx); });
  c.g = standardOutputs(4, 0);
  c.box = {2.35, -1.73, 0.43, 0.67};
  c.horizon = 37;
  c.times = {10, 20, 30};
  Judge judge(c);
  judge.follow({2.35, -1.73, 0.43, 0.67});
  for (const Interval& state : judge.tube().at(10)) EXPECT_LE(width(state), 0x1p-52 * std::max(2.0, magnitude(state)));
  for (const Interval& state : judge.tube().at(30)) EXPECT_LE(width(state), 1e-9);
  for (const Interval& state : judge.tube().at(37)) EXPECT_LE(width(state), 1e-3);
}

/// ẋ = p x: the derivatives by start and parameter, where both are known beyond doubles.
TEST(PreciseValues, OfParametersReachDerivatives) {
  const Program f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * x[0]; });
  const Precise x0("0.3"), p("0.7");
  FlowOptions options;
  options.precise = {preciseValue(0, x0), preciseValue(1, p)};
  const DerivativeFlow flow(f, {0, 1}, options);
  const Tube tube = flow.enclose({Interval("0.3"), Interval("0.7")}, 2);
  const Precise growth = exp(Precise(2 * p));
  EXPECT_THAT(tube.at(2)[0], Encloses(Precise(x0 * growth)));
  EXPECT_THAT(tube.at(2)[flow.derivative(0, 0)], Encloses(growth));
  EXPECT_THAT(tube.at(2)[flow.derivative(0, 1)], Encloses(Precise(2 * x0 * growth)));
  for (const Interval& state : tube.at(2)) EXPECT_LE(width(state), 0x1p-52 * magnitude(state));
}

/// A level that is thin where the box is not: the precise value is not one of its own.
TEST(PreciseValues, DoNotCountWhereTheBoxIsWide) {
  Containment c;
  c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sin(x[0]);
  });
  c.box = {Interval(0.5, 1.5), 0.0};
  c.levels = {{Interval(0.9, 0.9), 0.0}};
  c.horizon = 3;
  c.options.precise = {PreciseValue{0, 1.0, 0.0, 0.0}};
  Judge judge(c);
  judge.follow({0.9, 0.0}, 1);
}

TEST(PublishedPendulum, PreciseValuesMustBeOfTheBoxAndInOrder) {
  const Containment c = doublePendulumWithin(0);
  for (const PreciseValue& wrong : {PreciseValue{4, 1, 0, 0}, PreciseValue{-1, 1, 0, 0}, PreciseValue{0, 1, 1e-10, 0},
                                    PreciseValue{0, 1, 0, -1}, PreciseValue{0, std::nan(""), 0, 0}}) {
    FlowOptions options;
    options.precise = {wrong};
    EXPECT_THROW(Flow(c.f, options), std::invalid_argument);
  }
  FlowOptions options;
  options.precise = {PreciseValue{3, 0.67, 0, 0}, PreciseValue{3, 0.67, 0, 0}};
  EXPECT_THROW(Flow(c.f, options), std::invalid_argument) << "said twice";
  options.precise = {PreciseValue{3, 0.68, 0, 0}};
  EXPECT_THROW(Flow(c.f, options).enclose(c.box, 1), std::invalid_argument) << "not in the box";
}

TEST(PublishedPendulum, OnePercentBoxIsAsTightAsDenseSampling) {
  Containment c = doublePendulumWithin(0.01);
  c.horizon = 2.29;
  c.times = {0.4, 1.0, 2.0};
  const Tube tube = expectContainment(c, 3);
  // Products of the widths of 4001 sampled trajectories.
  const double sampled[] = {1.898e-4, 1.012e-3, 4.364e-4};
  for (std::size_t i = 0; i < 3; ++i) {
    double volume = 1;
    for (const Interval& state : tube.at(c.times[i])) volume *= width(state);
    EXPECT_LE(volume, 1.041 * sampled[i]) << "at " << c.times[i];
  }
}

}  // namespace
}  // namespace gamut::testing
