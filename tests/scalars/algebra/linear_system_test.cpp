// Linear systems of every scalar: solutions have small residuals, whatever the units; enclosures hold the solutions of
// every system inside; what is singular is said to be.
#include "scalars/algebra/linear_system.hpp"

#include <bit>
#include <stdexcept>

#include "scalars/index.hpp"
#include "tests/scalars/high_precision.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::testing::linear_system_test {
namespace {

using ::testing::Each;
using Precise = Digits<110>;

constexpr MatrixKind kinds[] = {MatrixKind::general, MatrixKind::positiveDefinite};

/// A matrix row by row.
template <class S>
struct Matrix {
  MatrixKind kind;
  int size;
  std::vector<S> entries;

  S& operator()(int i, int j) { return entries[detail::at(i * size + j)]; }
  const S& operator()(int i, int j) const { return entries[detail::at(i * size + j)]; }

  template <class T>
  Matrix<T> as() const {
    return {kind, size, std::vector<T>(entries.begin(), entries.end())};
  }
  std::vector<S> solve(std::vector<S> x, bool transposed = false) const {
    LinearSystem<S>(kind, size, entries).solve(x, transposed);
    return x;
  }
};

Matrix<double> randomMatrix(MatrixKind kind, int n, RandomDoubles& random) {
  Matrix<double> m{kind, n, std::vector<double>(detail::at(n * n))};
  if (kind == MatrixKind::general) {
    for (double& entry : m.entries) entry = random.uniform(-1, 1);
    return m;
  }
  // B Bᵀ plus a little on the diagonal, in small integers over a power of two: the products are exact.
  std::vector<double> b(detail::at(n * n));
  for (double& entry : b) entry = random.integer(-8, 8) / 8.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      double sum = i == j ? 0.5 : 0.0;
      for (int k = 0; k < n; ++k) sum += b[detail::at(i * n + k)] * b[detail::at(j * n + k)];
      m(i, j) = sum;
    }
  return m;
}

std::vector<double> randomVector(int n, RandomDoubles& random) {
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(random.uniform(-1, 1));
  return x;
}

/// The greatest |M x - r| of a row relative to what was added in it, |M| |x| + |r|.
template <class S>
Precise relativeResidual(const Matrix<S>& m, const std::vector<S>& x, const std::vector<S>& r, bool transposed) {
  Precise worst(0.0);
  for (int i = 0; i < m.size; ++i) {
    Precise residual(-r[detail::at(i)]), size(abs(residual));
    for (int j = 0; j < m.size; ++j) {
      const Precise term = Precise(transposed ? m(j, i) : m(i, j)) * Precise(x[detail::at(j)]);
      residual += term;
      size += abs(term);
    }
    if (size != 0) worst = std::max(worst, Precise(abs(residual) / size));
    if (isnan(residual)) return residual;
  }
  return worst;
}

template <class S>
void expectSmallResiduals(const Precise& unit) {
  RandomDoubles random;
  for (MatrixKind kind : kinds)
    for (int n : {1, 2, 3, 10, 30})
      for (int trial = 0; trial < 20; ++trial)
        for (bool transposed : {false, true}) {
          const Matrix<S> m = randomMatrix(kind, n, random).as<S>();
          const std::vector<double> numbers = randomVector(n, random);
          const std::vector<S> r(numbers.begin(), numbers.end());
          ASSERT_LE(relativeResidual(m, m.solve(r, transposed), r, transposed), unit * (40 * n * n))
              << n << " equations, trial " << trial;
        }
}

TEST(LinearSystem, OfDoublesHasSmallResiduals) { expectSmallResiduals<double>(Precise(0x1p-53)); }
TEST(LinearSystem, OfHighPrecisionHasSmallResiduals) { expectSmallResiduals<HighPrecision>(Precise("1e-49")); }

TEST(LinearSystem, DoesNotDependOnTheUnitsOfRowsAndColumns) {
  RandomDoubles random;
  for (int trial = 0; trial < 200; ++trial)
    for (MatrixKind kind : kinds)
      for (bool transposed : {false, true}) {
        const int n = 4;
        const Matrix<double> m = randomMatrix(kind, n, random);
        const std::vector<double> r = randomVector(n, random);
        std::vector<double> rows, columns;  // powers of two: the scaled problem is the same, to the bit
        for (int i = 0; i < n; ++i) rows.push_back(std::ldexp(1.0, random.integer(-40, 40)));
        for (int i = 0; i < n; ++i)
          columns.push_back(kind == MatrixKind::general ? std::ldexp(1.0, random.integer(-40, 40))
                                                        : rows[detail::at(i)]);
        Matrix<double> scaled = m;
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j) scaled(i, j) *= rows[detail::at(i)] * columns[detail::at(j)];
        std::vector<double> scaledRight = r;
        for (int i = 0; i < n; ++i) scaledRight[detail::at(i)] *= (transposed ? columns : rows)[detail::at(i)];
        const std::vector<double> x = scaled.solve(scaledRight, transposed);
        std::vector<double> unscaled = x;
        for (int i = 0; i < n; ++i) unscaled[detail::at(i)] *= (transposed ? rows : columns)[detail::at(i)];
        if (kind == MatrixKind::positiveDefinite) {
          ASSERT_EQ(unscaled, m.solve(r, transposed)) << "trial " << trial;
        }
        ASSERT_LE(relativeResidual(m, unscaled, r, transposed), Precise(0x1p-50)) << "trial " << trial;
      }
}

TEST(LinearSystem, SolvesEachRowInItsOwnUnits) {
  // With the first row as pivot, 1e10 swallows all that the second says, unless the solution is refined.
  const Matrix<double> m{MatrixKind::general, 2, {1e-6, 1e10, 1e-7, 1e-7}};
  const std::vector<double> r{1e10, 2e-7};
  const std::vector<double> x = m.solve(r);
  EXPECT_NEAR(x[0], 1, 1e-9);
  EXPECT_NEAR(x[1], 1, 1e-9);
  // Here, nothing would be left of the others to refine by.
  for (const double unit : {1e30, 1e-30, 1.0}) {
    Matrix<double> rows{MatrixKind::general, 3, {1e-20, 1, 1, 1, 1, 0.5, 1, 0.5, 2}};
    for (int j = 0; j < 3; ++j) rows(0, j) *= unit;
    for (bool transposed : {false, true}) {
      const std::vector<double> right{transposed ? 1 : unit, 2, 3}, solved = rows.solve(right, transposed);
      EXPECT_LE(relativeResidual(rows, solved, right, transposed), Precise(0x1p-50)) << unit;
    }
  }
}

TEST(LinearSystem, OfAPermutationExchangesOnly) {
  const Matrix<double> m{MatrixKind::general, 3, {0, 2, 0, 0, 0, 4, 8, 0, 0}};
  EXPECT_EQ(m.solve({2, 4, 8}), (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(m.solve({16, 2, 12}), (std::vector<double>{1.5, 8, 0.5}));
  EXPECT_EQ(m.solve({16, 2, 12}, true), (std::vector<double>{1, 3, 2}));
}

TEST(LinearSystem, OfEqualPositionsAndOfBlocksIsSolved) {
  // Equal masses at equal places: 2 on the diagonal, 1 beside it; and two such blocks.
  Matrix<double> m{MatrixKind::positiveDefinite, 6, std::vector<double>(36)};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      if (i / 3 == j / 3) m(i, j) = i == j ? 2 : 1;
  for (MatrixKind kind : kinds) {
    m.kind = kind;
    const std::vector<double> x = m.solve({4, 4, 4, 8, 8, 8});
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(x[detail::at(i)], i < 3 ? 1 : 2, 1e-15);
  }
}

TEST(LinearSystem, ReadsAPositiveDefiniteMatrixFromItsLowerTriangle) {
  const Matrix<double> m{MatrixKind::positiveDefinite, 2, {4, NAN, 2, 5}};
  EXPECT_EQ(m.solve({8, 12}), (std::vector<double>{1, 2}));
  const Matrix<Interval> ranges{MatrixKind::positiveDefinite, 2, {4, Interval::empty(), 2, 5}};
  EXPECT_THAT(ranges.solve({8, 12})[0], EnclosesExactly(HighPrecision(1)));
  EXPECT_LT(width(ranges.solve({8, 12})[0]), 1e-14);
}

TEST(LinearSystem, ThatIsSingularOrNotPositiveHasNoNumberForASolution) {
  const Matrix<double> dependent{MatrixKind::general, 3, {1, 2, 3, 2, 4, 6, 1, 0, 1}},
      zeroColumn{MatrixKind::general, 3, {1, 0, 3, 2, 0, 6, 1, 0, 1}}, zero{MatrixKind::general, 1, {0}},
      indefinite{MatrixKind::positiveDefinite, 3, {1, 2, 0, 2, 1, 0, 0, 0, 1}},
      semidefinite{MatrixKind::positiveDefinite, 3, {1, 1, 0, 1, 1, 0, 0, 0, 1}};
  for (const Matrix<double>& m : {dependent, zeroColumn, zero, indefinite, semidefinite})
    for (bool transposed : {false, true}) {
      const std::vector<double> r(detail::at(m.size), 1.0);
      EXPECT_THAT(m.solve(r, transposed), Each(::testing::IsNan()));
      const auto precise = m.as<HighPrecision>().solve(std::vector<HighPrecision>(r.begin(), r.end()), transposed);
      for (const HighPrecision& x : precise) EXPECT_TRUE(isnan(x));
    }
  for (const Matrix<double>& m : {dependent, zeroColumn, zero, semidefinite})
    for (bool transposed : {false, true})
      for (const Interval& x : m.as<Interval>().solve(std::vector<Interval>(detail::at(m.size), 1.0), transposed))
        EXPECT_TRUE(isEqual(x, Interval::entire())) << x;
}

/// The solution of a real system, in 110 digits.
std::vector<Precise> truth(const Matrix<double>& m, const std::vector<double>& r, bool transposed) {
  Matrix<Precise> precise = m.as<Precise>();
  precise.kind = MatrixKind::general;
  return precise.solve(std::vector<Precise>(r.begin(), r.end()), transposed);
}

TEST(LinearSystem, OfIntervalsHoldsTheSolutionsOfEverySystemInside) {
  RandomDoubles random;
  int bounded = 0, all = 0;
  for (int trial = 0; trial < 300; ++trial)
    for (MatrixKind kind : kinds)
      for (int n : {1, 2, 3, 5}) {
        const Matrix<double> centre = randomMatrix(kind, n, random);
        const double spread = trial % 3 == 0 ? 0 : std::ldexp(1.0, -random.integer(4, 30));
        Matrix<Interval> ranges = centre.as<Interval>();
        for (Interval& entry : ranges.entries) entry = entry + spread * Interval(-1, 1);
        const std::vector<double> middle = randomVector(n, random);
        std::vector<Interval> right(middle.begin(), middle.end());
        for (Interval& r : right) r = r + spread * Interval(-1, 1);
        for (bool transposed : {false, true}) {
          const std::vector<Interval> x = ranges.solve(right, transposed);
          ++all;
          bounded += isBounded(x[0]);
          for (int inside = 0; inside < 4; ++inside) {  // corners first
            Matrix<double> m = centre;
            std::vector<double> r = middle;
            const auto member = [&](const Interval& range) {
              return inside < 2 ? (random.integer(0, 1) == 0 ? range.lower() : range.upper()) : random.elementOf(range);
            };
            for (int i = 0; i < n; ++i) {
              r[detail::at(i)] = member(right[detail::at(i)]);
              for (int j = 0; j < n; ++j) m(i, j) = member(ranges(i, j));
              for (int j = 0; j < i && kind == MatrixKind::positiveDefinite; ++j) m(j, i) = m(i, j);
            }
            const std::vector<Precise> exact = truth(m, r, transposed);
            for (int i = 0; i < n; ++i)
              ASSERT_TRUE(Precise(x[detail::at(i)].lower()) <= exact[detail::at(i)] &&
                          exact[detail::at(i)] <= Precise(x[detail::at(i)].upper()))
                  << x[detail::at(i)] << " misses " << exact[detail::at(i)] << ", trial " << trial;
          }
        }
      }
  EXPECT_GE(bounded, all * 9 / 10);
}

TEST(LinearSystem, OfIntervalsIsProvedOnceForAllRightHandSidesAndAnewForAnotherMatrix) {
  RandomDoubles random;
  LinearSystem<Interval> system;
  for (int trial = 0; trial < 60; ++trial)
    for (MatrixKind kind : kinds) {
      const int n = random.integer(1, 9);
      Matrix<Interval> m = randomMatrix(kind, n, random).as<Interval>();
      if (kind == MatrixKind::general)
        for (Interval& entry : m.entries) entry = entry + 0x1p-12 * Interval(-1, 1);
      system.assign(kind, n, [&](int i, int j) { return m(i, j); });
      for (int solve = 0; solve < 6; ++solve) {
        const std::vector<double> numbers = randomVector(n, random);
        std::vector<Interval> x(numbers.begin(), numbers.end());
        const bool transposed = random.integer(0, 1) == 1;
        const std::vector<Interval> alone = m.solve(x, transposed);
        system.solve(x, transposed);
        for (int i = 0; i < n; ++i)
          ASSERT_TRUE(isEqual(x[detail::at(i)], alone[detail::at(i)])) << "trial " << trial << ", solution " << solve;
      }
    }
}

TEST(LinearSystem, OfThinIntervalsIsTightWhateverTheUnits) {
  RandomDoubles random;
  for (int trial = 0; trial < 50; ++trial)
    for (MatrixKind kind : kinds) {
      Matrix<double> m = randomMatrix(kind, 7, random);
      for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 7; ++j) m(i, j) = std::ldexp(m(i, j), 5 * (i + j) - 30);
      const std::vector<double> r = randomVector(7, random);
      const std::vector<Interval> x = m.as<Interval>().solve(std::vector<Interval>(r.begin(), r.end()));
      const std::vector<Precise> exact = truth(m, r, false);
      for (std::size_t i = 0; i < 7; ++i) {
        ASSERT_TRUE(Precise(x[i].lower()) <= exact[i] && exact[i] <= Precise(x[i].upper())) << x[i];
        ASSERT_LE(width(x[i]), 1e-9 * magnitude(x[i])) << x[i];
      }
    }
}

TEST(LinearSystem, OfWhatIsEmptyOrUnboundedIsEmptyOrUnbounded) {
  const Matrix<Interval> withEmpty{MatrixKind::general, 2, {2, 0, Interval::empty(), 2}};
  for (const Interval& x : withEmpty.solve({1, 1})) EXPECT_TRUE(isEmpty(x)) << x;
  const Matrix<Interval> fine{MatrixKind::general, 2, {2, 0, 0, 2}};
  for (const Interval& x : fine.solve({1, Interval::empty()})) EXPECT_TRUE(isEmpty(x)) << x;
  for (const Interval& x : fine.solve({1, Interval(0, infinity)})) EXPECT_TRUE(isEqual(x, Interval::entire())) << x;
}

TEST(LinearSystem, OfFuzzyNumbersIsTheSystemOfEachCut) {
  const Fuzzy stiffness = Fuzzy::triangular(3.5, 4, 4.5, 5);
  const Matrix<Fuzzy> m{MatrixKind::positiveDefinite, 2, {stiffness, 1.0, 1.0, 3.0}};
  const std::vector<Fuzzy> x = m.solve({1.0, Fuzzy::triangular(1.5, 2, 2.5, 5)});
  for (std::size_t level = 0; level < 5; ++level) {
    const std::vector<Interval> cut =
        Matrix<Interval>{MatrixKind::positiveDefinite, 2, {stiffness.cut(level), 1, 1, 3}}.solve(
            {1, Fuzzy::triangular(1.5, 2, 2.5, 5).cut(level)});
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(x[i].levels(), 5u);
      EXPECT_THAT(x[i].cut(level), IsSubsetOf(cut[i]));
      EXPECT_LT(width(x[i].cut(level)), 1.1 * width(cut[i]) + 1e-14);
    }
  }
  // Crisp matrices have one level; what is singular in its support alone is unbounded there alone.
  EXPECT_EQ((Matrix<Fuzzy>{MatrixKind::general, 1, {2.0}}.solve({stiffness})[0].levels()), 5u);
  const Fuzzy quotient = Matrix<Fuzzy>{MatrixKind::general, 1, {Fuzzy::triangular(0, 1, 2, 3)}}.solve({1.0})[0];
  EXPECT_TRUE(isEqual(quotient.support(), Interval::entire()));
  EXPECT_TRUE(isBounded(quotient.core()));
  EXPECT_THROW((Matrix<Fuzzy>{MatrixKind::general, 1, {stiffness}}.solve({Fuzzy::triangular(0, 1, 2, 3)})),
               std::invalid_argument);
}

TEST(LinearSystem, OfSamplesIsTheSystemOfEachSample) {
  RandomDoubles random;
  for (MatrixKind kind : kinds)
    for (bool transposed : {false, true}) {
      const int n = 4;
      const Matrix<double> varying[] = {randomMatrix(kind, n, random),
                                        randomMatrix(kind, n, random),
                                        {kind, n, std::vector<double>(16)}};  // the last is singular
      Matrix<Samples> m{kind, n, {}};
      for (std::size_t k = 0; k < 16; ++k)
        m.entries.push_back(
            Samples(std::vector<double>{varying[0].entries[k], varying[1].entries[k], varying[2].entries[k]}));
      const std::vector<Samples> x = m.solve({1.0, Samples(std::vector<double>{2, 3, 4}), 5.0, 6.0}, transposed);
      for (std::size_t sample = 0; sample < 3; ++sample) {
        const std::vector<double> alone = varying[sample].solve({1, 2 + static_cast<double>(sample), 5, 6}, transposed);
        for (std::size_t i = 0; i < 4; ++i) {
          EXPECT_EQ(x[i].size(), 3u);
          if (sample < 2) {
            EXPECT_EQ(std::bit_cast<std::uint64_t>(x[i][sample]), std::bit_cast<std::uint64_t>(alone[i]));
          } else {
            EXPECT_TRUE(std::isnan(x[i][sample]));
          }
        }
      }
    }
  const Matrix<Samples> constant{MatrixKind::general, 1, {4.0}};
  EXPECT_EQ(constant.solve({Samples(std::vector<double>{2, 4})})[0][1], 1);
  EXPECT_TRUE(constant.solve({2.0})[0].isConstant());
  EXPECT_THROW((Matrix<Samples>{MatrixKind::general, 1, {Samples(std::vector<double>{1, 2})}}.solve(
                   {Samples(std::vector<double>{1, 2, 3})})),
               std::invalid_argument);
}

TEST(LinearSystem, RefusesWhatDoesNotFitTogether) {
  EXPECT_THROW(LinearSystem<double>(MatrixKind::general, 2, {1, 2, 3}), std::invalid_argument);
  EXPECT_THROW(LinearSystem<double>(MatrixKind::general, 0, {}), std::invalid_argument);
  EXPECT_THROW(LinearSystem<Interval>(MatrixKind::general, 2, std::vector<Interval>(3)), std::invalid_argument);
  EXPECT_THROW(LinearSystem<Fuzzy>(MatrixKind::general, 2, std::vector<Fuzzy>(3)), std::invalid_argument);
  EXPECT_THROW(LinearSystem<Samples>(MatrixKind::general, 2, std::vector<Samples>(3)), std::invalid_argument);
  EXPECT_THROW((Matrix<double>{MatrixKind::general, 1, {1}}.solve({1, 2})), std::invalid_argument);
  EXPECT_THROW((Matrix<Interval>{MatrixKind::general, 1, {1}}.solve({1, 2})), std::invalid_argument);
  EXPECT_THROW((Matrix<Fuzzy>{MatrixKind::general, 1, {1.0}}.solve({1.0, 2.0})), std::invalid_argument);
  EXPECT_THROW((Matrix<Samples>{MatrixKind::general, 1, {1.0}}.solve({1.0, 2.0})), std::invalid_argument);
}

}  // namespace
}  // namespace gamut::testing::linear_system_test
