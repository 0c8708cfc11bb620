// Polynomials at points against what their curved sums say of them.
#include "analyses/probability/curved_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gamut::testing {
namespace {

double valueOf(const std::vector<double>& c, const Monomials& m, const std::vector<double>& eta) {
  long double sum = 0;
  for (std::size_t g = 0; g < c.size(); ++g) {
    long double term = c[g];
    for (int l = 0; l < m.symbols(); ++l)
      for (int n = m.exponent(static_cast<int>(g), l); n > 0; --n) term *= eta[static_cast<std::size_t>(l)];
    sum += term;
  }
  return static_cast<double>(sum);
}

/// Of any coefficients: none, some, or all of them near those of a curve of the linear terms.
TEST(CurvedSum, HoldsItsPolynomial) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 300; ++round) {
    const int k = 1 + round % 6;
    const Monomials m(std::vector<int>(static_cast<std::size_t>(k), 1), 2 + round % 4);
    const double unit = round % 3 == 0 ? 1e-9 : round % 3 == 1 ? 1.0 : 1e6, bend = round % 2 == 0 ? 0.02 : 1;
    std::vector<double> c(static_cast<std::size_t>(round % 5 == 0 ? m.countUpTo(2) : m.count()));
    for (std::size_t g = 0; g < c.size(); ++g)
      c[g] =
          any(random) < -0.5 ? 0 : unit * any(random) * std::pow(bend, std::max(0, m.grade(static_cast<int>(g)) - 1));
    const CurvedSum sum = curvedSumOf(c, m, std::vector<char>(static_cast<std::size_t>(k), 1));
    std::vector<double> eta(static_cast<std::size_t>(k));
    for (int point = 0; point < 200; ++point) {
      for (double& x : eta) x = point % 3 == 0 ? std::copysign(1.0, any(random)) : any(random);
      double s = 0;
      for (std::size_t l = 0; l < eta.size(); ++l)
        for (std::size_t n = 1; n < sum.f[l].size(); ++n) s += sum.f[l][n] * std::pow(eta[l], static_cast<double>(n));
      const double y = valueOf(c, m, eta), rounding = 1e-13 * unit * 100;
      ASSERT_LE(std::fabs(s), sum.reach + rounding);
      ASSERT_GE(y, sum.at(s) + sum.constant - sum.down - rounding) << round;
      ASSERT_LE(y, sum.at(s) + sum.constant + sum.up + rounding) << round;
      const double value = sum.reach * any(random), above = sum.above(value), below = sum.below(value);
      if (s > above) {
        ASSERT_GT(sum.at(s), value - rounding);
      }
      if (s < below) {
        ASSERT_LT(sum.at(s), value + rounding);
      }
      ASSERT_LE(below, above);
    }
  }
}

TEST(CurvedSum, LeavesLittleOfASine) {
  constexpr int k = 20;
  const Monomials m(std::vector<int>(k, 1), 2);
  std::vector<double> c(static_cast<std::size_t>(m.count()), 0.0);
  double plain = 0;
  for (int g = 0; g < m.count(); ++g) {  // sin(1 + 0.005 Σ η) to the second order
    int most = 0;
    for (int l = 0; l < k; ++l) most = std::max(most, m.exponent(g, l));
    const double a = 0.005;
    double& own = c[static_cast<std::size_t>(g)];
    own = m.grade(g) == 0 ? std::sin(1.0) : m.grade(g) == 1 ? a * std::cos(1.0) : -0.5 * a * a * std::sin(1.0);
    if (m.grade(g) == 2 && most == 1) own *= 2, plain += std::fabs(own);
  }
  const CurvedSum sum = curvedSumOf(c, m, std::vector<char>(k, 1));
  EXPECT_LT(sum.down + sum.up, 0.05 * plain);
}

}  // namespace
}  // namespace gamut::testing
