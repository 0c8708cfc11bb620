// Stability near rest against the criterion of Routh and Hurwitz in long doubles, of motions with one and two
// coordinates, thin and of intervals, and of loops.
#include "mechanics/rest_stability.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "scalars/algebra/decompositions.hpp"

namespace gamut::rest_stability {
namespace {

using enum RestStability;
using Numbers = std::vector<double>;

std::vector<Interval> intervals(const Numbers& numbers, double tolerance = 0) {
  std::vector<Interval> all;
  for (const double x : numbers) all.push_back(Interval(x) * Interval(1 - tolerance, 1 + tolerance));
  return all;
}

/// Of two coordinates: M = diag(1, m), det(s² M + s C + K) = a0 s⁴ + a1 s³ + a2 s² + a3 s + a4.
struct Motion {
  double m;
  Numbers k, c;

  std::array<long double, 5> polynomial() const {
    const auto [k0, k1, k2, k3] = std::array<long double, 4>{k[0], k[1], k[2], k[3]};
    const auto [c0, c1, c2, c3] = std::array<long double, 4>{c[0], c[1], c[2], c[3]};
    return {m, c0 * m + c3, k0 * m + k3 + c0 * c3 - c1 * c2, c0 * k3 + k0 * c3 - c1 * k2 - k1 * c2, k0 * k3 - k1 * k2};
  }
  /// None where that is a matter of roundings.
  std::optional<bool> isStable() const {
    const auto [a0, a1, a2, a3, a4] = polynomial();
    const long double last = a1 * a2 * a3 - a0 * a3 * a3 - a1 * a1 * a4;
    for (const long double each : {a1, a2, a3, a4, last})
      if (std::fabs(each) < 1e-9L) return {};
    return a1 > 0 && a2 > 0 && a3 > 0 && a4 > 0 && last > 0;
  }
  NearRest nearRest(double tolerance = 0) const {
    return {2, intervals(k, tolerance), intervals(c, tolerance), intervals({1, 0, 0, m}, tolerance), {}};
  }
};

Motion randomMotion(std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  Motion motion{std::exp(2 * number(random)), Numbers(4), Numbers(4)};
  for (double& each : motion.c) each = number(random);
  for (double& each : motion.k) each = 2 * number(random);
  motion.k[2] = motion.k[1];
  if (random() % 2 == 0) motion.k[0] = 2 + motion.k[0], motion.k[3] = 2 + motion.k[3];
  return motion;
}

TEST(RestStability, IsThatOfRouthAndHurwitz) {
  std::mt19937_64 random(1);
  int known = 0, stable = 0;
  constexpr int tried = 3000;
  for (int number = 0; number < tried; ++number) {
    const Motion motion = randomMotion(random);
    const NearRest near = motion.nearRest();
    const std::optional<int> negatives = negativeEigenvalues(near.stiffness, 2);
    const std::optional<bool> expected = motion.isStable();
    if (!negatives || !expected) continue;
    const RestStability found = stabilityOf(near, *negatives);
    if (found == unknown) continue;
    ++known;
    EXPECT_EQ(found == RestStability::stable, *expected) << number;
    stable += *expected ? 1 : 0;
  }
  EXPECT_GT(known, tried * 98 / 100);
  EXPECT_GT(stable, tried / 20);
}

TEST(RestStability, OfIntervalsIsThatOfAllInThem) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> share(-0.05, 0.05);
  int known = 0;
  for (int number = 0; number < 1000; ++number) {
    const Motion motion = randomMotion(random);
    const std::optional<int> negatives = negativeEigenvalues(intervals(motion.k, 0.05), 2);
    if (!negatives) continue;
    const RestStability found = stabilityOf(motion.nearRest(0.05), *negatives);
    if (found == unknown) continue;
    ++known;
    for (int sample = 0; sample < 20; ++sample) {
      Motion other = motion;
      other.m *= 1 + share(random);
      for (Numbers* numbers : {&other.k, &other.c})
        for (double& each : *numbers) each *= 1 + share(random);
      other.k[2] = other.k[1];
      const std::optional<bool> expected = other.isStable();
      EXPECT_TRUE(!expected || *expected == (found == RestStability::stable)) << number;
    }
  }
  EXPECT_GT(known, 300);
}

TEST(RestStability, NeedsNoDamperOnEveryCoordinate) {
  const Numbers coupled = {2, -1, -1, 2};
  EXPECT_EQ(stabilityOf(Motion{1, coupled, {0, 0, 0, 0}}.nearRest(0.1), 0), stable);
  EXPECT_EQ(stabilityOf(Motion{1, coupled, {0, 0, 0, 0.1}}.nearRest(0.1), 0), stable);
  EXPECT_EQ(stabilityOf(Motion{1, coupled, {0, 0, 0, -0.1}}.nearRest(0.1), 0), unstable);
  EXPECT_EQ(stabilityOf(Motion{1, coupled, {0.3, 0, 0, -0.1}}.nearRest(), 0), stable);
  EXPECT_EQ(stabilityOf(Motion{1, coupled, {0.1, 0, 0, -0.3}}.nearRest(), 0), unstable);
  // Between both: one of two equal motions is not damped, which no interval can tell from one that is driven.
  EXPECT_NE(stabilityOf(Motion{1, coupled, {0.1, -0.1, -0.1, 0.1}}.nearRest(0.1), 0), unstable);
}

/// Of a mass and a spring in very small units, and in very large ones.
TEST(RestStability, KnowsNoUnits) {
  for (const double length : {1e-9, 1.0, 1e9})
    for (const double time : {1e-6, 1.0, 1e6}) {
      const double k = length * length, c = k * time, m = c * time;
      Numbers stiffness = {2 * k, -k / 1e3, -k / 1e3, 2 * k / 1e6}, damping = {0.3 * c, 0, 0, -0.1 * c / 1e6},
              mass = {m, 0, 0, m / 1e6};
      const auto near = [&](const Numbers& itsDamping) {
        return NearRest{2, intervals(stiffness), intervals(itsDamping), intervals(mass), {}};
      };
      EXPECT_EQ(stabilityOf(near(damping), 0), stable) << length << " " << time;
      for (double& each : damping) each = -each;
      EXPECT_EQ(stabilityOf(near(damping), 0), unstable) << length << " " << time;
    }
}

/// q1 = 2 q2: K, C and M along (2, 1).
TEST(RestStability, IsOfTheMotionAlongLoops) {
  NearRest near{2, intervals({1, 0, 0, -3}), intervals({-1, 0, 0, 5}), intervals({1, 0, 0, 1}), intervals({1, -2})};
  const std::optional<NearRest> along = near.reduced();
  ASSERT_TRUE(along.has_value());
  ASSERT_EQ(along->n, 1);
  // Along (2, 1) or (1, 1/2), whichever is solved for.
  const double scale = midpoint(along->mass[0]) / 5;
  EXPECT_TRUE(contains(along->stiffness[0], 1 * scale));
  EXPECT_TRUE(contains(along->damping[0], 1 * scale));
  EXPECT_EQ(stabilityOf(*along, 0), stable);
  near.damping[0] = Interval(-2.0);
  EXPECT_EQ(stabilityOf(*near.reduced(), 0), unstable);
  near.held = intervals({0, 0});
  EXPECT_FALSE(near.reduced().has_value());
}

/// The greatest real part of s, det(s² + s C + K) = 0.
double greatestRealPart(const Eigen::MatrixXd& k, const Eigen::MatrixXd& c) {
  const auto n = k.rows();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -k;
  a.bottomRightCorner(n, n) = -c;
  return eigenvaluesOf(a).real().maxCoeff();
}

/// Dampers, fewer than coordinates and more, with c_k at the ends of their intervals and between.
TEST(RestStability, OfDampersIsThatOfAllInThem) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-1, 1), share(0, 1);
  int stables = 0, unstables = 0;
  for (int n = 1; n <= 5; ++n)
    for (int tried = 0; tried < 60; ++tried) {
      Resistances of{n, {}, {Interval(1.0), Interval(0.0, 2.0)}, intervals(Numbers(n * n, 0.0))};
      std::vector<Eigen::VectorXd> rates;
      for (int k = 0; k <= tried % (n + 2); ++k) {
        const double least = tried % 3 == 0 ? number(random) : tried % 3 == 1 ? 0 : share(random);
        of.coefficients.emplace_back(least, least + share(random));
        rates.push_back(Eigen::VectorXd::NullaryExpr(n, [&] { return std::round(2 * number(random)); }));
      }
      for (int i = 0; i < n && tried % 2 == 0; ++i) of.others[i * n + i] = Interval(0.0, share(random));
      Eigen::MatrixXd k = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return number(random); });
      k = Eigen::MatrixXd(k + k.transpose());
      if (tried % 4 < 2) k += 2 * n * Eigen::MatrixXd::Identity(n, n);
      const Eigen::VectorXd squares = pencilValuesOf(k, Eigen::MatrixXd::Identity(n, n));
      if (squares.cwiseAbs().minCoeff() < 1e-3) continue;
      const RestStability found = stabilityOf(of, static_cast<int>((squares.array() < 0).count()));
      if (found == unknown) continue;
      ++(found == stable ? stables : unstables);
      for (int sample = 0; sample < 20; ++sample) {
        const auto at = [&](const Interval& range) {
          return sample < 2 ? (sample == 0 ? range.lower() : range.upper())
                            : range.lower() + share(random) * (range.upper() - range.lower());
        };
        Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n);
        for (std::size_t j = 0; j < rates.size(); ++j) c += at(of.coefficients[j]) * rates[j] * rates[j].transpose();
        for (int i = 0; i < n; ++i) c(i, i) += at(of.others[i * n + i]);
        const double most = greatestRealPart(k, c);
        EXPECT_TRUE(found == stable ? most < 1e-9 : most > 1e-6) << n << " " << tried << " " << most;
      }
    }
  EXPECT_GT(stables, 50);
  EXPECT_GT(unstables, 50);
}

TEST(RestStability, OfDampersIsNotClaimedWhereTheyMayDrive) {
  Resistances of{2, intervals({0.1}), intervals({1}), intervals({0, 0, 0, 0})};
  EXPECT_EQ(stabilityOf(of, 0), stable);
  EXPECT_EQ(stabilityOf(of, 1), unstable);
  EXPECT_EQ(stabilityOf(of, 2), unstable);
  of.coefficients[0] = Interval(-1e-9, 0.2);
  EXPECT_EQ(stabilityOf(of, 0), unknown);
  EXPECT_EQ(stabilityOf(of, 2), unstable);
  of.coefficients[0] = Interval(0.0, 0.2);
  EXPECT_EQ(stabilityOf(of, 0), stable);
  // What turns the motion aside takes no energy, but may hold what would fall.
  of.others = intervals({0, 0.5, -0.5, 0});
  EXPECT_EQ(stabilityOf(of, 0), stable);
  EXPECT_EQ(stabilityOf(of, 2), unknown);
  of.others = intervals({0, 0.5, 0.5, 0});
  EXPECT_EQ(stabilityOf(of, 0), unknown);
  of.others = intervals({0, 0, 0, 0});
  of.masses.emplace_back(-0.1, 1.0);
  EXPECT_EQ(stabilityOf(of, 0), unknown);
  EXPECT_EQ(stabilityOf(of, 1), unknown);
}

TEST(RestStability, IsNotAskedOfForcesWithoutAPotential) {
  EXPECT_TRUE((Motion{1, {2, -1, -1, 2}, {0, 0, 0, 0}}.nearRest().hasPotential()));
  EXPECT_FALSE((Motion{1, {2, -1, 1, 2}, {0, 0, 0, 0}}.nearRest().hasPotential()));
  NearRest near = Motion{1, {2, 0, 0, 2}, {0, 0, 0, 0}}.nearRest();
  near.stiffness[1] = Interval(-0.5, 0.5);  // a kink
  EXPECT_FALSE(near.hasPotential());
}

TEST(RestStability, IsNotAskedWhereRatesHaveKinks) {
  const Resistances near{2, intervals({0.3}), intervals({1}), intervals({0.1, 0, 0, 0.1})};
  Resistances moving = near;
  moving.others[0] = Interval(0.1) + Interval(-1e-90, 1e-90);
  EXPECT_TRUE(near.isSmooth(moving));
  moving.others[0] = Interval(-2.9, 3.1);
  EXPECT_FALSE(near.isSmooth(moving));
  moving = near;
  moving.coefficients[0] = Interval(0.3, 0.4);
  EXPECT_FALSE(near.isSmooth(moving));
}

TEST(RestStability, IsNotAskedWhereForcesOfPositionHaveKinks) {
  const NearRest near = Motion{1, {2, -1, -1, 2}, {0, 0, 0, 0}}.nearRest();
  NearRest beside = near;
  beside.stiffness[0] += Interval(-1e-90, 1e-90);
  EXPECT_TRUE(near.isSmooth(beside));
  beside.stiffness[0] = Interval(1.0, 2.0);
  EXPECT_FALSE(near.isSmooth(beside));
}

}  // namespace
}  // namespace gamut::rest_stability
