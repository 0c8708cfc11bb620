// The double pendulum: written as a user writes it in C++, judged by the published equations, moved by every scalar.
#include <gmock/gmock.h>

#include <boost/multiprecision/mpfr.hpp>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/joints.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

using testing::doublePendulum;
using testing::publishedDoublePendulum;
using testing::RandomStates;
using Precise =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<60>, boost::multiprecision::et_off>;

bool holds(const Interval& enclosure, const Precise& value) {
  return Precise(enclosure.lower()) <= value && value <= Precise(enclosure.upper());
}

std::array<Precise, 2> preciseAccelerations(const std::vector<double>& x) {
  return publishedDoublePendulum<Precise>({x[0], x[1], x[2], x[3]}, Precise("9.81"));
}

/// The whole program of a user: accelerations of the double pendulum in the state x.
template <class S>
std::vector<S> accelerationsInUserCode(const std::vector<S>& x) {
  Frame<S> K0, K1, K2, K3, K4;
  Variable<S> psi1, psi2;
  RevoluteJoint<S> shoulder(K0, K1, psi1, axisY), elbow(K2, K3, psi2, axisY);
  RigidLink<S> upper(K1, K2, {0, 0, -1}), lower(K3, K4, {0, 0, -1});
  MassElement<S> middle(K2, 1.0), tip(K4, 1.0);
  Chain<S> chain;
  chain << shoulder << upper << middle << elbow << lower << tip;
  System<S> system({psi1, psi2}, chain, K0, {0, 0, constant<S>(Interval("-9.81"))});

  psi1.position = x[0], psi2.position = x[1], psi1.rate = x[2], psi2.rate = x[3];
  return system.accelerations();
}

TEST(DoublePendulum, InUserCodeFollowsThePublishedEquations) {
  RandomStates states;
  for (int i = 0; i < 1000; ++i) {
    const std::vector<double> x = states(4), a = accelerationsInUserCode(x);
    const auto expected = publishedDoublePendulum<double>({x[0], x[1], x[2], x[3]}, 9.81);
    const double scale = std::abs(expected[0]) + std::abs(expected[1]);
    EXPECT_NEAR(a[0], expected[0], 1e-12 * scale);
    EXPECT_NEAR(a[1], expected[1], 1e-12 * scale);
  }
}

TEST(DoublePendulum, MovedByIntervalsEnclosesThePublishedEquations) {
  RandomStates states;
  for (int i = 0; i < 1000; ++i) {
    const std::vector<double> x = states(4);
    const std::vector<Interval> a = accelerationsInUserCode(std::vector<Interval>(x.begin(), x.end()));
    const auto expected = preciseAccelerations(x);
    for (std::size_t j : {0u, 1u}) EXPECT_TRUE(holds(a[j], expected[j])) << a[j] << " misses " << expected[j];
  }
}

TEST(DoublePendulum, MovedByWideIntervalsEnclosesEverySampleInside) {
  RandomStates states;
  for (int i = 0; i < 200; ++i) {
    const std::vector<double> centre = states(4);
    std::vector<Interval> box;
    for (double c : centre) box.emplace_back(c - 0.1, c + 0.1);
    const std::vector<Interval> a = accelerationsInUserCode(box);
    for (int k = 0; k < 10; ++k) {
      std::vector<double> x = states(4, 0.09);
      for (std::size_t j = 0; j < 4; ++j) x[j] += centre[j];
      const auto expected = preciseAccelerations(x);
      for (std::size_t j : {0u, 1u}) EXPECT_TRUE(holds(a[j], expected[j])) << a[j] << " misses " << expected[j];
    }
    for (const Interval& acceleration : a) EXPECT_TRUE(isBounded(acceleration)) << "a pivot lost its sign";
  }
}

TEST(DoublePendulum, MovedByAPackOfSamplesIsMovedSampleBySample) {
  RandomStates states;
  std::vector<std::vector<double>> xs, columns(4);
  for (int i = 0; i < 64; ++i) {
    xs.push_back(states(4));
    for (std::size_t j = 0; j < 4; ++j) columns[j].push_back(xs.back()[j]);
  }
  std::vector<Samples> pack(columns.begin(), columns.end());
  const std::vector<Samples> a = accelerationsInUserCode(pack);
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const auto alone = accelerationsInUserCode(std::vector<Samples>(xs[i].begin(), xs[i].end()));
    const std::vector<double> number = accelerationsInUserCode(xs[i]);  // with the C library's sine and cosine
    for (std::size_t j : {0u, 1u}) {
      EXPECT_EQ(a[j][i], alone[j][0]);
      EXPECT_NEAR(a[j][i], number[j], 1e-13 * (1 + std::fabs(number[j])));
    }
  }
}

TEST(DoublePendulum, MovedByFuzzyNumbersIsMovedCutByCut) {
  const std::vector<Fuzzy> x = {Fuzzy::triangular(2.2, 2.3, 2.5, 5), Fuzzy::triangular(-1.8, -1.7, -1.6, 5),
                                Fuzzy(0.43), Fuzzy::triangular(0.6, 0.67, 0.7, 5)};
  const std::vector<Fuzzy> a = accelerationsInUserCode(x);
  for (std::size_t level = 0; level < 5; ++level) {
    std::vector<Interval> box;
    for (const Fuzzy& value : x) box.push_back(value.cut(level));
    const std::vector<Interval> expected = accelerationsInUserCode(box);
    for (std::size_t j : {0u, 1u}) EXPECT_TRUE(isEqual(a[j].cut(level), expected[j]));
  }
  const auto precise = preciseAccelerations({2.3, -1.7, 0.43, 0.67});
  for (std::size_t j : {0u, 1u}) EXPECT_NEAR(midpoint(a[j].core()), precise[j].convert_to<double>(), 1e-12);
}

TEST(DoublePendulum, RecordedFollowsThePublishedEquationsAndEnclosesThem) {
  const Program f = recordMotion(doublePendulum());
  Evaluator<double> inDoubles(f);
  Evaluator<Interval> inIntervals(f);
  RandomStates states;
  for (int i = 0; i < 1000; ++i) {
    const std::vector<double> x = states(4), dx = inDoubles(0.0, x);
    const std::vector<Interval> enclosure = inIntervals(Interval(0.0), std::vector<Interval>(x.begin(), x.end()));
    const auto expected = preciseAccelerations(x);
    EXPECT_EQ(dx[0], x[2]);
    EXPECT_EQ(dx[1], x[3]);
    for (std::size_t j : {0u, 1u}) {
      const double value = expected[j].convert_to<double>();
      EXPECT_NEAR(dx[2 + j], value, 1e-12 * (1 + std::abs(value)));
      EXPECT_TRUE(holds(enclosure[2 + j], expected[j])) << enclosure[2 + j] << " misses " << expected[j];
    }
  }
}

TEST(DoublePendulum, WithLengthsAndMassesAsParametersFollowsThePublishedEquations) {
  const Program f = recordMotion(doublePendulum(), {"upper.length", "lower.length", "elbowMass.mass", "tip.mass"});
  Evaluator<double> evaluate(f);
  RandomStates states;
  for (int i = 0; i < 1000; ++i) {
    const std::vector<double> x = states(4), p = states(4, 0.8);
    const std::array<double, 2> l = {1 + p[0], 1 + p[1]}, m = {1 + p[2], 1 + p[3]};
    evaluate.setParameters(std::vector<double>{l[0], l[1], m[0], m[1]});
    const std::vector<double> dx = evaluate(0.0, x);
    const auto expected = publishedDoublePendulum<double>({x[0], x[1], x[2], x[3]}, 9.81, l, m);
    const double scale = std::abs(expected[0]) + std::abs(expected[1]);
    EXPECT_NEAR(dx[2], expected[0], 1e-10 * scale);
    EXPECT_NEAR(dx[3], expected[1], 1e-10 * scale);
  }
}

int count(const Program& program, Op op) {
  int n = 0;
  for (std::size_t i = 0; i < program.nodes().size(); ++i)
    n += program.nodes()[i].op == op && !program.isInvariant(static_cast<int>(i));
  return n;
}

TEST(DoublePendulum, IsAShortProgram) {
  const Program f = recordMotion(doublePendulum());
  EXPECT_LE(f.operations(), 23) << f;
  EXPECT_LE(count(f, Op::mul), 7) << f;
  EXPECT_LE(count(f, Op::sqr), 3) << f;
  EXPECT_EQ(count(f, Op::recip), 1) << f;
  EXPECT_EQ(count(f, Op::sin), 2) << f;
  EXPECT_LE(recordMotion(doublePendulum(), {"upper.length", "lower.length", "elbowMass.mass", "tip.mass"}).operations(),
            36);
}

// LNCS 5045, Section 4.2: intervals carried outwards by r' = ΔRᵀ r + Δr give y in [1.1993, 1.3853] and z in
// [-0.1947, -0.0086]; the exact range is y in [1.285938, 1.298736], z in [-0.183016, -0.020402].
TEST(DoublePendulum, TipPositionInIntervalsReproducesThePublishedOneOutwardsAndBeatsItInwards) {
  Assembly<Interval> arm(doublePendulum());
  const Interval psi1 = 0.75 * pi() + pi() / 50 * Interval(-1, 1), psi2 = -11 * pi() / 20;
  arm.setState(std::vector<Interval>{psi1, psi2, 0.0, 0.0});
  const Frame<Interval>& tip = arm.frame("K4");
  const Vector3<Interval> outwards = tip.R * tip.r;
  EXPECT_TRUE(isEqual(outwards[0], 0.0));
  EXPECT_NEAR(outwards[1].lower(), 1.1993, 1e-4);
  EXPECT_NEAR(outwards[1].upper(), 1.3853, 1e-4);
  EXPECT_NEAR(outwards[2].lower(), -0.1947, 1e-4);
  EXPECT_NEAR(outwards[2].upper(), -0.0086, 1e-4);

  const Interval y = arm.output("tip.position.y"), z = arm.output("K4.position.z");
  EXPECT_TRUE(isInterior(y, Interval("[1.1993, 1.3853]"))) << y;
  EXPECT_TRUE(isInterior(z, Interval("[-0.1947, -0.0086]"))) << z;
  EXPECT_TRUE(isSubset(Interval("[1.285939, 1.298735]"), y)) << y;
  EXPECT_TRUE(isSubset(Interval("[-0.183015, -0.020403]"), z)) << z;
  EXPECT_NEAR(width(z), 0.183016 - 0.020402, 2e-6) << "carried inwards, the height is the exact range";
}

}  // namespace
}  // namespace gamut
