// Sparse factors of a matrix of doubles: solutions against their exact residuals in 128 bits, in rows of any scale,
// with structure (chains, arrows, permutations), and what singular matrices give.
#include "analyses/flow/series/linear_factors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scalars/index.hpp"
#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

using detail::at;

struct CoupledSystem {
  int n;
  std::vector<double> a, b;
  double& entry(int i, int j) { return a[at(i * n + j)]; }
};

/// A diagonal that is not small, `extra` more entries a row, rows and columns permuted, rows of any binary scale.
CoupledSystem randomSystem(Points& points, int n, int extra, int scales) {
  CoupledSystem s{n, std::vector<double>(at(n * n)), std::vector<double>(at(n))};
  std::vector<int> column(at(n));
  std::iota(column.begin(), column.end(), 0);
  for (int i = n - 1; i > 0; --i) std::swap(column[at(i)], column[at(points.integer(0, i))]);
  for (int i = 0; i < n; ++i) {
    const int exponent = points.integer(-scales, scales);
    for (int k = 0; k < extra; ++k) s.entry(i, points.integer(0, n - 1)) = std::ldexp(points.uniform(-1, 1), exponent);
    s.entry(i, column[at(i)]) = std::ldexp(points.uniform(2, 3) * (extra + 1), exponent);
    s.b[at(i)] = std::ldexp(points.uniform(-1, 1), exponent);
  }
  return s;
}

/// |b - A x| in 128 bits, and |b| + |A||x|.
struct Left {
  Precise residual, size;
  int terms = 0;
};
Left left(CoupledSystem& s, const std::vector<double>& x, int row) {
  Left result{Precise(s.b[at(row)]), Precise(std::fabs(s.b[at(row)]))};
  for (int j = 0; j < s.n; ++j) {
    const Precise product = Precise(s.entry(row, j)) * Precise(x[at(j)]);
    result.residual -= product;
    result.size += abs(product);
    result.terms += s.entry(row, j) != 0;
  }
  result.residual = abs(result.residual);
  return result;
}

TEST(LinearFactors, SolveUpToTheRoundingOfTheirResidualAndMeasureIt) {
  Points points(3);
  for (int round = 0; round < 300; ++round) {
    const int n = std::vector{1, 2, 3, 7, 10, 30, 60}[at(round % 7)], scales = round % 3 == 0 ? 0 : 300;
    CoupledSystem s = randomSystem(points, n, points.integer(0, 5), scales);
    LinearFactors factors(n);
    factors.factorise(s.a.data());
    std::vector<double> x = s.b, residual(at(n), 0.0), norms;
    factors.solve(x.data(), residual.data());
    for (double value : x) norms.push_back(std::fabs(value));
    for (int i = 0; i < n; ++i) {
      const Left exact = left(s, x, i);
      const Precise rounding = Precise(0x1p-53) * exact.size;
      ASSERT_LE(exact.residual, Precise(residual[at(i)]) + (exact.terms + 1) * Precise(1 + 1e-12) * rounding)
          << "round " << round << ", row " << i << " of " << n;
      EXPECT_LE(exact.residual, (exact.terms + 3) * rounding) << "refined: round " << round << ", row " << i;
      EXPECT_LE(Precise(residual[at(i)]), (2 * exact.terms + 4) * rounding) << "round " << round << ", row " << i;
      EXPECT_NEAR(factors.size(i, norms.data()) + std::fabs(s.b[at(i)]), static_cast<double>(exact.size),
                  1e-13 * static_cast<double>(exact.size));
    }
  }
}

TEST(LinearFactors, AddToTheResidualThatIsThere) {
  LinearFactors factors(1);
  const double a = 2;
  factors.factorise(&a);
  double x = 3, residual = 7;
  factors.solve(&x, &residual);
  EXPECT_EQ(x, 1.5);
  EXPECT_EQ(residual, 7);
}

TEST(LinearFactors, MeasureWhatIllConditionedSystemsMiss) {
  // Rows that nearly agree: x is far off, the residual still small, and known.
  Points points(4);
  for (int round = 0; round < 100; ++round) {
    const int n = points.integer(2, 8);
    CoupledSystem s = randomSystem(points, n, n, 0);
    for (int j = 0; j < n; ++j) {
      s.entry(0, j) = points.uniform(1, 2);
      s.entry(1, j) = s.entry(0, j) * (1 + std::ldexp(points.uniform(-1, 1), -45));
    }
    LinearFactors factors(n);
    factors.factorise(s.a.data());
    std::vector<double> x = s.b, residual(at(n), 0.0);
    factors.solve(x.data(), residual.data());
    for (int i = 0; i < n; ++i) {
      const Left exact = left(s, x, i);
      ASSERT_LE(exact.residual,
                Precise(residual[at(i)]) + (exact.terms + 1) * Precise(1 + 1e-12) * Precise(0x1p-53) * exact.size);
    }
  }
}

TEST(LinearFactors, InverseHoldsColumnByColumn) {
  Points points(5);
  for (int n : {1, 3, 10, 30}) {
    CoupledSystem s = randomSystem(points, n, 3, 0);
    LinearFactors factors(n);
    factors.factorise(s.a.data());
    const std::vector<double>& c = factors.inverse();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        double product = i == j ? -1 : 0;
        for (int k = 0; k < n; ++k) product += c[at(i * n + k)] * s.entry(k, j);
        EXPECT_NEAR(product, 0, 1e-12) << i << ", " << j << " of " << n;
      }
  }
}

TEST(LinearFactors, FactoriseAnewWithoutTraceOfTheMatrixBefore) {
  Points points(6);
  LinearFactors used(10);
  for (int round = 0; round < 10; ++round) {
    CoupledSystem s = randomSystem(points, 10, round, 5);
    LinearFactors fresh(10);
    fresh.factorise(s.a.data());
    used.factorise(s.a.data());
    std::vector<double> x = s.b, y = s.b, rx(10, 0.0), ry(10, 0.0);
    fresh.solve(x.data(), rx.data());
    used.solve(y.data(), ry.data());
    EXPECT_EQ(x, y);
    EXPECT_EQ(rx, ry);
    EXPECT_EQ(fresh.inverse(), used.inverse());
  }
}

TEST(LinearFactors, ArrowsAreSolvedFromTheirTip) {
  // An arrow whose dense row and column come first fills in wholly unless they are eliminated last; then nothing rounds
  // here: powers of two all the way, and a last pivot of 1.
  const int n = 17;
  CoupledSystem s{n, std::vector<double>(at(n * n)), std::vector<double>(at(n), 0.0)};
  for (int i = 0; i < n; ++i) s.entry(i, i) = 1, s.entry(0, i) = s.entry(i, 0) = 0x1p-10;
  s.entry(0, 0) = 16 * 0x1p-20 + 1;
  s.b[0] = 1;
  LinearFactors factors(n);
  factors.factorise(s.a.data());
  std::vector<double> x = s.b, residual(at(n), 0.0);
  factors.solve(x.data(), residual.data());
  EXPECT_EQ(x[0], 1);
  for (int i = 1; i < n; ++i) EXPECT_EQ(x[at(i)], -0x1p-10);
  for (double r : residual) EXPECT_EQ(r, 0);
  for (int i = 1; i < n; ++i)
    for (int j = 1; j < n; ++j)
      EXPECT_EQ(factors.inverse()[at(i * n + j)], (i == j ? 1 : 0) + 0x1p-20) << i << ", " << j;
}

TEST(LinearFactors, WhatIsSingularOrNotFiniteGivesNaN) {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const std::vector<double>& a : {std::vector<double>{1, 2, 2, 4},
                                       {0, 0, 0, 1},
                                       {0, 1, 0, 1},
                                       {0, 0, 0, 0},
                                       {nan, 0, 0, 1},
                                       {infinity, 0, 0, 1},
                                       {1, infinity, 0, 1},
                                       {1, 0, nan, 1}}) {
    LinearFactors factors(2);
    factors.factorise(a.data());
    std::vector<double> x{1, 1}, residual{0, 0};
    factors.solve(x.data(), residual.data());
    EXPECT_TRUE(std::isnan(x[0]) || std::isnan(x[1])) << a[0] << " " << a[1] << " " << a[2];
  }
}

}  // namespace
}  // namespace gamut::testing
