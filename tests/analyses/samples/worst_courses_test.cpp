// Worst courses reach what is known of linear motions, and stand where nothing is to be gained by their switches.
#include "analyses/samples/worst_courses.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "analyses/samples/arbiter.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

/// What samples take of ẋ = f, y = g, whose parameters, behind the initial values, may be uncertain.
struct Inputs {
  std::vector<double> nominal;
  std::vector<Uncertain> uncertain;
  std::vector<int> slot;
  std::vector<std::size_t> varying;
  std::vector<double> rates;
};

constexpr double freely = std::numeric_limits<double>::infinity();

UncertainMotion motionWith(const Program& f, const Program& g, const std::vector<double>& times, const Inputs& inputs) {
  UncertainMotion system;
  system.motion.f = f;
  system.motion.g = g;
  system.motion.times = times;
  system.nominal = inputs.nominal;
  system.uncertain = inputs.uncertain;
  system.slot = inputs.slot;
  system.switching = {system.motion, inputs.varying, inputs.rates, {}};
  return system;
}

Uncertain between(double lower, double nominal, double upper) {
  Uncertain result;
  result.name = "w";
  result.range = Interval(lower, upper);
  result.nominal = nominal;
  result.distribution = Distribution::uniform(result.range);
  result.membership = Membership::trapezoidal(lower, lower, upper, upper);
  return result;
}

constexpr double stiffness = 9.0, damping = 0.4;

/// ẍ + 0.4 ẋ + 9 x = w, seen with its speed and acceleration.
UncertainMotion oscillatorAlong(const Uncertain& w, double rate = freely) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] - damping * x[1] - stiffness * x[0];
  });
  const Program g = record(2, 1, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = x[0];
    y[1] = p[0] - damping * x[1] - stiffness * x[0];
  });
  return motionWith(f, g, {0.0, 0.7, 2.0, 5.0}, {{0, 0, w.nominal}, {w}, {2}, {0}, {rate}});
}

/// ∫ |h| from 0 to T of h = e^{-a s} sin(ω s)/ω, from zero to zero of the sine.
double absoluteResponse(double T) {
  const double a = damping / 2, omega = std::sqrt(stiffness - a * a), pi = std::acos(-1.0);
  const auto antiderivative = [&](double s) {
    return -std::exp(-a * s) * (a * std::sin(omega * s) / omega + std::cos(omega * s)) / (a * a + omega * omega);
  };
  double sum = 0;
  for (double from = 0; from < T; from += pi / omega)
    sum += std::fabs(antiderivative(std::min(T, from + pi / omega)) - antiderivative(from));
  return sum;
}

/// Follows them as samples; the greatest, and the least, of an output at a time.
struct Ends {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
};

Ends endsOf(UncertainMotion system, const std::vector<WorstCourse>& courses, std::size_t row, std::size_t output) {
  Ends ends;
  for (std::size_t k = 0; k < courses.size(); ++k) {
    std::vector<double> values = courses[k].values;
    for (const std::size_t q : system.switching.quantities) values[q] = numberOfSwitching(system.uncertain[q].range, k);
    system.switching.courses.push_back(courses[k].courses);
    const SampleBlock block = integrateValues(system, {}, values);
    EXPECT_EQ(block.runs[0].times, system.motion.times.size());
    ends.least = std::min(ends.least, block(0, row, output));
    ends.greatest = std::max(ends.greatest, block(0, row, output));
  }
  return ends;
}

WorstCourseOptions options(std::vector<std::size_t> outputs) {
  WorstCourseOptions result;
  result.outputs = std::move(outputs);
  result.fastest = 6;
  return result;
}

TEST(WorstCourses, ReachTheNormOfALinearMotion) {
  const UncertainMotion system = oscillatorAlong(between(-1, 0, 3));
  const std::vector<WorstCourse> courses = worstCourses(system, options({0, 1}));
  const double middle = 1, radius = 2, error = 1e-9;  // of what varies; of the integration
  for (std::size_t row = 1; row < system.motion.times.size(); ++row) {
    const double T = system.motion.times[row], norm = absoluteResponse(T);
    const double a = damping / 2, omega = std::sqrt(stiffness - a * a);
    const double steady =
        (1 - std::exp(-a * T) * (a * std::sin(omega * T) / omega + std::cos(omega * T))) / (a * a + omega * omega);
    const double least = middle * steady - radius * norm, greatest = middle * steady + radius * norm;
    const Ends ends = endsOf(system, courses, row, 0);
    EXPECT_LT(ends.greatest, greatest + error);
    EXPECT_GT(ends.greatest, greatest - 1e-6 * radius * norm);
    EXPECT_GT(ends.least, least - error);
    EXPECT_LT(ends.least, least + 1e-6 * radius * norm);
  }
}

/// The acceleration at a time has what varies in it itself, which may be of another sign than just before.
TEST(WorstCourses, SwitchAtTheLastMomentForWhatAnOutputHolds) {
  const UncertainMotion system = oscillatorAlong(between(-1, 0, 1));
  const std::vector<WorstCourse> courses = worstCourses(system, options({1}));
  // w - ∫ of its response with that of the acceleration, by a fine sum.
  const double T = 5, a = damping / 2, omega = std::sqrt(stiffness - a * a);
  double norm = 1;
  constexpr int steps = 2'000'000;
  for (int i = 0; i < steps; ++i) {
    const double s = (i + 0.5) * T / steps, e = std::exp(-a * s);
    const double h = e * std::sin(omega * s) / omega,
                 rate = e * (std::cos(omega * s) - a * std::sin(omega * s) / omega);
    norm += std::fabs(damping * rate + stiffness * h) * T / steps;
  }
  const Ends ends = endsOf(system, courses, 3, 1);
  EXPECT_NEAR(ends.greatest, norm, 1e-6 * norm);
  EXPECT_NEAR(ends.least, -norm, 1e-6 * norm);
}

/// A pendulum, 10 times as much moved as its linear motion would say.
UncertainMotion pendulumAlong(const Uncertain& w, const Uncertain& length) {
  const Program f = record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] - 9.81 / p[1] * sin(x[0]);
  });
  const Program g = record(2, 2, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  return motionWith(f, g, {3.0, 6.0}, {{0.5, 0, 0, 1}, {w, length}, {2, 3}, {0}, {freely}});
}

TEST(WorstCourses, OfANonlinearMotionGainNothingByOtherSwitches) {
  const Uncertain w = between(-0.3, 0, 0.3), length = between(0.98, 1, 1.03);
  const UncertainMotion system = pendulumAlong(w, length);
  const std::vector<WorstCourse> courses = worstCourses(system, options({0}));
  ASSERT_EQ(courses.size(), 4U);
  // The last time's greatest and least come first.
  for (std::size_t i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1 : -1;
    const auto valueOf = [&](const WorstCourse& course) { return sign * endsOf(system, {course}, 1, 0).least; };
    const double best = valueOf(courses[i]);
    EXPECT_NE(courses[i].values[1], length.nominal);
    const std::vector<double>& from = courses[i].courses[0].from;
    ASSERT_GT(from.size(), 4U);
    for (std::size_t k = 1; k < from.size(); ++k)
      for (const double later : {-0.02, 0.02}) {
        WorstCourse other = courses[i];
        other.courses[0].from[k] += later;
        EXPECT_LT(valueOf(other), best) << k;
      }
    WorstCourse other = courses[i];
    other.values[1] = courses[i].values[1] == length.range.upper() ? length.range.lower() : length.range.upper();
    EXPECT_LT(valueOf(other), best);
  }
}

TEST(WorstCourses, AreFollowedAsTheirFormulasAre) {
  UncertainMotion system = pendulumAlong(between(-0.3, 0, 0.3), between(0.98, 1, 1.03));
  const std::vector<WorstCourse> courses = worstCourses(system, options({0}));
  ASSERT_THAT(courses, Not(IsEmpty()));
  system.switching.courses.push_back(courses[0].courses);
  std::vector<double> values = courses[0].values;
  values[0] = numberOfSwitching(system.uncertain[0].range, 0);
  const SampleBlock block = integrateValues(system, {}, values);
  const std::vector<double> again = integrateByTaylor(system.motionAt(values), system.start(values));
  for (std::size_t row = 0; row < 2; ++row) EXPECT_NEAR(block(0, row, 0), again[row], 1e-9);
}

TEST(WorstCourses, AreNoneWhereTheyAreNotKnown) {
  EXPECT_THAT(worstCourses(oscillatorAlong(between(-1, 0, 1), 0.5), options({0})), IsEmpty());  // bounded in rate
  EXPECT_THAT(worstCourses(oscillatorAlong(between(1, 1, 1)), options({0})), IsEmpty());
  EXPECT_THAT(worstCourses(oscillatorAlong(between(-1, 0, 1)), options({})), IsEmpty());
  const Program f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] - sign(x[0]); });
  const Program g = record(1, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  EXPECT_THAT(worstCourses(motionWith(f, g, {1.0}, {{0, 0}, {between(-2, 0, 2)}, {1}, {0}, {freely}}), options({0})),
              IsEmpty());
}

/// No more than a budget allows, spread over all times; an interrupt leaves none.
TEST(WorstCourses, EndWithTheirBudget) {
  const UncertainMotion system = oscillatorAlong(between(-1, 0, 1));
  WorstCourseOptions few = options({0, 1});
  few.most = 3;
  EXPECT_EQ(worstCourses(system, few).size(), 3U);
  few.budget = 0;
  EXPECT_THAT(worstCourses(system, few), IsEmpty());
  const std::atomic<bool> cancelled{true};
  WorstCourseOptions stopped = options({0});
  stopped.cancelled = &cancelled;
  EXPECT_THAT(worstCourses(system, stopped), IsEmpty());
}

}  // namespace
}  // namespace gamut
