// Verified inverses, solutions and determinants, judged by elimination in 100 digits: for condition numbers up to 10^12
// its error is below 10^-80, while no enclosure is narrower than 10^-17 of what it encloses. Containment is exact.
#include "scalars/algebra/verified_algebra.hpp"

#include <algorithm>
#include <cfenv>
#include <optional>
#include <vector>

#include "tests/scalars/high_precision.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::verified_algebra_test {
namespace {

using namespace gamut::testing;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using IntervalMatrix = Eigen::Matrix<Interval, Eigen::Dynamic, Eigen::Dynamic>;
using Digits100 = Digits<100>;

constexpr double unit = 0x1p-53;

// ---- The judge ------------------------------------------------------------------------------------------------------

struct Judge {
  /// a x = b, and det a; nothing for a singular matrix.
  static std::optional<Judge> solve(const MatrixXd& a, const MatrixXd& b) {
    const Index n = a.rows(), columns = n + b.cols();
    std::vector<std::vector<Digits100>> rows(n, std::vector<Digits100>(columns));
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < columns; ++j) rows[i][j] = j < n ? a(i, j) : b(i, j - n);
    }
    Digits100 determinant = 1;
    for (Index k = 0; k < n; ++k) {
      const auto pivot = std::max_element(rows.begin() + k, rows.end(),
                                          [k](const auto& x, const auto& y) { return abs(x[k]) < abs(y[k]); });
      if ((*pivot)[k] == 0) return std::nullopt;
      if (pivot != rows.begin() + k) {
        std::swap(*pivot, rows[k]);
        determinant = -determinant;
      }
      determinant *= rows[k][k];
      const Digits100 reciprocal = 1 / rows[k][k];
      for (Index j = k; j < columns; ++j) rows[k][j] *= reciprocal;
      for (Index i = 0; i < n; ++i) {
        if (i == k || rows[i][k] == 0) continue;
        const Digits100 factor = rows[i][k];
        for (Index j = k; j < columns; ++j) rows[i][j] -= factor * rows[k][j];
      }
    }
    for (auto& row : rows) row.erase(row.begin(), row.begin() + n);
    return Judge{std::move(rows), determinant};
  }
  static Judge invert(const MatrixXd& a) { return *solve(a, MatrixXd::Identity(a.rows(), a.rows())); }
  static Digits100 determinantOf(const MatrixXd& a) { return solve(a, MatrixXd(a.rows(), 0))->determinant; }

  double greatest() const {
    double result = 0;
    for (const auto& row : x) {
      for (const Digits100& element : row) result = std::max(result, std::abs(static_cast<double>(element)));
    }
    return result;
  }

  std::vector<std::vector<Digits100>> x;
  Digits100 determinant;
};

bool holds(const Interval& x, const Digits100& value) {
  return (std::isinf(x.lower()) || Digits100(x.lower()) <= value) &&
         (std::isinf(x.upper()) || value <= Digits100(x.upper()));
}

template <class Enclosure>
int escapes(const Enclosure& enclosure, const Judge& judge) {
  int count = 0;
  for (Index i = 0; i < enclosure.rows(); ++i) {
    for (Index j = 0; j < enclosure.cols(); ++j) count += !holds(enclosure(i, j), judge.x[i][j]);
  }
  return count;
}

template <class Enclosure>
double greatestRadius(const Enclosure& enclosure) {
  double result = 0;
  for (Index i = 0; i < enclosure.size(); ++i) result = std::max(result, radius(enclosure.data()[i]));
  return result;
}

// ---- The matrices ---------------------------------------------------------------------------------------------------

class RandomMatrices : public RandomDoubles {
 public:
  MatrixXd matrix(Index rows, Index columns, double bound = 1) {
    return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(-bound, bound); });
  }

  /// A product of random reflections, applied to x from the left.
  MatrixXd reflected(MatrixXd x) {
    for (Index k = 0; k < x.rows(); ++k) {
      const VectorXd v = matrix(x.rows(), 1);
      x -= (2 / v.squaredNorm() * v) * (v.transpose() * x).eval();
    }
    return x;
  }

  MatrixXd orthogonal(Index n) { return reflected(MatrixXd::Identity(n, n)); }

  /// Singular values from 1 down to 1 / condition, evenly in the logarithm; known to about 16 digits.
  MatrixXd conditioned(Index n, double condition) {
    MatrixXd diagonal = MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) diagonal(i, i) = n == 1 ? 1 : std::pow(condition, -double(i) / double(n - 1));
    return reflected(reflected(diagonal).transpose());
  }

  /// a with every element widened by up to `relative` of the greatest; some stay thin.
  IntervalMatrix around(const MatrixXd& a, double relative) {
    const double most = relative * a.cwiseAbs().maxCoeff();
    IntervalMatrix result(a.rows(), a.cols());
    for (Index i = 0; i < a.size(); ++i) {
      const double x = a.data()[i];
      result.data()[i] = integer(0, 3) == 0 ? Interval(x) : Interval(x - uniform(0, most), x + uniform(0, most));
    }
    return result;
  }

  MatrixXd inside(const IntervalMatrix& a) {
    MatrixXd result(a.rows(), a.cols());
    for (Index i = 0; i < a.size(); ++i) result.data()[i] = elementOf(a.data()[i]);
    return result;
  }

  /// Rows (or columns) multiplied by factors between 10^-exponent and 10^exponent.
  VectorXd scales(Index n, double exponent) {
    return VectorXd::NullaryExpr(n, [&] { return std::pow(10.0, uniform(-exponent, exponent)); });
  }

  /// Integers, with a last row that is the sum of the others.
  MatrixXd singular(Index n) {
    MatrixXd a = MatrixXd::NullaryExpr(n, n, [&] { return integer(-9, 9); });
    a.row(n - 1) = a.topRows(n - 1).colwise().sum();
    return a;
  }

  /// Integers, with an inverse of integers: a product of triangular matrices with ones on the diagonal.
  MatrixXd unimodular(Index n) {
    MatrixXd lower = MatrixXd::Identity(n, n), upper = lower;
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < j; ++i) {
        upper(i, j) = integer(-2, 2);
        lower(j, i) = integer(-2, 2);
      }
    }
    return lower * upper;
  }
};

struct Size {
  Index n;
  int times;
};
constexpr Size sizes[] = {{1, 200}, {2, 200}, {3, 200}, {6, 100}, {12, 20}, {30, 2}};
constexpr double conditions[] = {1, 1e3, 1e6, 1e9, 1e12};

// ---- Inverses -------------------------------------------------------------------------------------------------------

TEST(VerifiedInverse, HoldsTheExactInverseForConditionNumbersUpToATrillion) {
  RandomMatrices random;
  for (const auto [n, times] : sizes) {
    for (const double condition : conditions) {
      for (int time = 0; time < times; ++time) {
        const MatrixXd a = random.conditioned(n, condition);
        const auto inverse = verifiedInverse(a);
        ASSERT_TRUE(inverse) << n << ", " << condition << ": " << inverse.reason();
        const Judge judge = Judge::invert(a);
        ASSERT_EQ(escapes(*inverse, judge), 0) << n << ", " << condition;
        ASSERT_LE(greatestRadius(*inverse), 4 * double(n * (n + 1)) * condition * unit * judge.greatest());
      }
    }
  }
}

TEST(VerifiedInverse, HoldsTheExactInverseOfSixtyRows) {
  RandomMatrices random;
  for (const double condition : {10.0, 1e12}) {
    const MatrixXd a = random.conditioned(60, condition);
    const auto inverse = verifiedInverse(a);
    ASSERT_TRUE(inverse) << inverse.reason();
    EXPECT_EQ(escapes(*inverse, Judge::invert(a)), 0) << condition;
  }
}

TEST(VerifiedInverse, IsNotClaimedBeyondTheConditionNumbersOfDoubles) {
  RandomMatrices random;
  std::vector<MatrixXd> matrices{
      MatrixXd{{1, 1 + 2 * unit}, {1 - unit, 1 + unit}},
      MatrixXd{{64919121, -159018721}, {41869520.5, -102558961}},  // determinant 1 (Rump 2010, example 1.1)
  };
  for (const Index n : {6, 12, 30, 60}) {  // smaller ones may be random factors away from well-conditioned ones
    for (const double condition : {1e17, 1e18, 1e20}) {
      for (int time = 0; time < 10; ++time) matrices.push_back(random.conditioned(n, condition));
    }
  }
  for (const MatrixXd& a : matrices) {
    const auto inverse = verifiedInverse(a);
    EXPECT_FALSE(inverse) << a;
    EXPECT_THAT(inverse.reason(), ::testing::HasSubstr("the matrix may be singular"));
    EXPECT_FALSE(verifiedSolve(a, random.matrix(a.rows(), 1))) << a;
  }
}

TEST(VerifiedInverse, LosesNothingByBadlyScaledRowsAndColumns) {
  RandomMatrices random;
  for (const double exponent : {3.0, 30.0, 100.0}) {
    for (const Index n : {2, 6, 12}) {
      const MatrixXd a = random.scales(n, exponent).asDiagonal() * random.conditioned(n, 1e3) *
                         random.scales(n, exponent).asDiagonal();
      const auto inverse = verifiedInverse(a);
      ASSERT_TRUE(inverse) << n << ", " << exponent << ": " << inverse.reason();
      const Judge judge = Judge::invert(a);
      EXPECT_EQ(escapes(*inverse, judge), 0) << n << ", " << exponent;
      const MatrixXd b = random.matrix(n, 1);
      const auto solution = verifiedSolve(a, b);
      ASSERT_TRUE(solution);
      EXPECT_EQ(escapes(*solution, *Judge::solve(a, b)), 0) << n << ", " << exponent;
      for (Index i = 0; i < n; ++i) {
        double row = 0;  // elements in a row of the inverse differ by the rows' scales, so judge the greatest
        for (Index j = 0; j < n; ++j) row = std::max(row, radius((*inverse)(i, j)) / magnitude((*inverse)(i, j)));
        EXPECT_LT(row, 1e-8) << n << ", " << exponent;
      }
    }
  }
}

TEST(VerifiedInverse, IsNeverClaimedOfSingularMatricesNorAnythingElse) {
  RandomMatrices random;
  std::vector<MatrixXd> matrices{MatrixXd::Zero(1, 1), MatrixXd::Zero(5, 5), MatrixXd::Ones(3, 3)};
  for (const Index n : {2, 3, 6, 12, 30, 60}) {
    for (int time = 0; time < 100 / n + 1; ++time) matrices.push_back(random.singular(n));
    MatrixXd a = random.matrix(n, n);
    a.row(n / 2).setZero();
    matrices.push_back(a);
    matrices.push_back(a.transpose());
    a = random.matrix(n, n);
    a.col(0) = 2 * a.col(n - 1);
    matrices.push_back(a);
    matrices.push_back(VectorXd::Constant(n, 3.0) * Eigen::RowVectorXd::Constant(n, 1e-200));
  }
  for (const MatrixXd& a : matrices) {
    const Index n = a.rows();
    EXPECT_FALSE(verifiedInverse(a)) << a;
    EXPECT_FALSE(verifiedOrthogonalInverse(a)) << a;
    EXPECT_FALSE(verifiedSolve(a, MatrixXd::Zero(n, 1))) << a;
    EXPECT_FALSE(verifiedDeterminant(a)) << a;
  }
}

TEST(VerifiedInverse, HoldsInversesThatAreDoubles) {
  RandomMatrices random;
  for (const Index n : {1, 2, 3, 5, 8}) {
    for (int time = 0; time < 20; ++time) {
      const MatrixXd a = random.unimodular(n);
      const auto inverse = verifiedInverse(a);
      ASSERT_TRUE(inverse) << inverse.reason();
      EXPECT_EQ(escapes(*inverse, Judge::invert(a)), 0);
      EXPECT_EQ(verifiedDeterminant(a)->sign, 1);
      EXPECT_TRUE(contains(verifiedDeterminant(a)->value, 1));
    }
  }
  const Eigen::Matrix3d permutation{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, transposition{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(escapes(*verifiedInverse(permutation), Judge::invert(permutation)), 0);
  EXPECT_LE(greatestRadius(*verifiedInverse(permutation)), 16 * unit);
  EXPECT_EQ(verifiedDeterminant(permutation)->sign, 1);
  EXPECT_EQ(verifiedDeterminant(transposition)->sign, -1);
}

TEST(VerifiedInverse, HoldsWithElementsThatAreSubnormalOrHuge) {
  RandomMatrices random;
  const std::vector<MatrixXd> matrices{
      MatrixXd{{smallest}},
      MatrixXd{{-largest}},
      MatrixXd{{0x1p-1022, 0}, {0, 0x1p1023}},
      MatrixXd{{1e308, 1e308}, {-1e308, 1e308}},
      MatrixXd{{1e-310, 0, 1e-320}, {1e300, 1e-310, 0}, {0, 1, 1e-300}},
      MatrixXd{{1, smallest}, {0x1p500, 1}},
      MatrixXd{{1, 1e-200, 1e200}, {1e-200, 1e200, 1}, {1e150, 1, 1e-200}},
      random.conditioned(6, 100) * 1e-308,
      random.conditioned(6, 100) * 1e-315,
      random.conditioned(6, 100) * 1e307,
  };
  int verified = 0;
  for (const MatrixXd& a : matrices) {
    const MatrixXd b = random.matrix(a.rows(), 2);
    if (const auto inverse = verifiedInverse(a)) {
      ++verified;
      EXPECT_EQ(escapes(*inverse, Judge::invert(a)), 0) << a << "\n" << *inverse;
    }
    if (const auto solution = verifiedSolve(a, b)) {
      ++verified;
      EXPECT_EQ(escapes(*solution, *Judge::solve(a, b)), 0) << a;
    }
    if (const auto determinant = verifiedDeterminant(a)) {
      ++verified;
      EXPECT_TRUE(holds(determinant->value, Judge::determinantOf(a))) << a;
      EXPECT_EQ(determinant->sign, Judge::determinantOf(a) > 0 ? 1 : -1) << a;
    }
  }
  EXPECT_EQ(verified, 3 * int(matrices.size()));
}

TEST(VerifiedInverse, OfIntervalsHoldsTheInverseOfEveryMatrixInside) {
  RandomMatrices random;
  for (const Index n : {1, 2, 3, 6, 12}) {
    for (const double width : {0.0, 1e-12, 1e-6, 1e-3}) {
      const MatrixXd centre = random.conditioned(n, 10);
      const IntervalMatrix a = random.around(centre, width);
      const auto inverse = verifiedInverse(a);
      ASSERT_TRUE(inverse) << n << ", " << width << ": " << inverse.reason();
      for (int time = 0; time < 60 / n + 2; ++time) {
        ASSERT_EQ(escapes(*inverse, Judge::invert(random.inside(a))), 0) << n << ", " << width;
      }
    }
  }
}

TEST(VerifiedInverse, OfIntervalsIsAboutAsWideAsItMustBe) {
  RandomMatrices random;
  const Index n = 6;
  const IntervalMatrix a = random.around(random.conditioned(n, 10), 1e-6);
  const IntervalMatrix inverse = *verifiedInverse(a);
  // To first order the exact range of element (i, j) has the radius sum |C_ik| rad_kl |C_lj|.
  const MatrixXd c = a.unaryExpr([](const Interval& x) { return midpoint(x); }).cast<double>().eval().inverse();
  const MatrixXd radii = a.unaryExpr([](const Interval& x) { return radius(x); }).cast<double>();
  const MatrixXd least = c.cwiseAbs() * radii * c.cwiseAbs();
  for (Index i = 0; i < n * n; ++i) EXPECT_LE(radius(inverse.data()[i]), 1.01 * least.data()[i]);
}

TEST(VerifiedInverse, IsNeverClaimedOfIntervalsThatHoldASingularMatrix) {
  RandomMatrices random;
  for (const Index n : {1, 2, 3, 6, 12}) {
    for (int time = 0; time < 100; ++time) {
      const MatrixXd singular = n == 1 ? MatrixXd::Zero(1, 1) : random.singular(n);
      IntervalMatrix a = singular.cast<Interval>();
      for (Index i = 0; i < a.size(); ++i) {  // the singular matrix often lies on the boundary, or in the corner
        const double radius = std::pow(10.0, random.integer(-15, 0)), x = singular.data()[i];
        a.data()[i] = Interval(random.integer(0, 1) ? x : x - radius, random.integer(0, 1) ? x : x + radius);
      }
      EXPECT_FALSE(verifiedInverse(a)) << a;
      EXPECT_FALSE(verifiedSolve(a, MatrixXd::Ones(n, 1))) << a;
      EXPECT_FALSE(verifiedDeterminant(a)) << a;
    }
  }
}

TEST(VerifiedInverse, TakesFixedSizesBlocksExpressionsAndRowMajorMatrices) {
  RandomMatrices random;
  const MatrixXd large = random.conditioned(8, 10);
  const Eigen::Matrix3d a = large.topLeftCorner<3, 3>();
  const Verified<Eigen::Matrix<Interval, 3, 3>> fixed = verifiedInverse(a);
  const Judge judge = Judge::invert(a);
  EXPECT_EQ(escapes(*fixed, judge), 0);
  EXPECT_EQ(escapes(*verifiedInverse(large.topLeftCorner(3, 3)), judge), 0);
  EXPECT_EQ(escapes(*verifiedInverse(Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(a)), judge), 0);
  EXPECT_EQ(escapes(*verifiedInverse(a.transpose().transpose()), judge), 0);
  EXPECT_EQ(escapes(*verifiedInverse(2 * a - a), judge), 0);
  EXPECT_EQ(escapes(*verifiedInverse(a.cast<Interval>()), judge), 0);
  const Eigen::Vector3d b(1, 2, 3);
  const Verified<Eigen::Matrix<Interval, 3, 1>> x = verifiedSolve(a, b);
  EXPECT_EQ(escapes(*x, *Judge::solve(a, b)), 0);
  EXPECT_EQ(
      escapes(*verifiedSolve(a, large.row(1).head(3).transpose()), *Judge::solve(a, large.row(1).head(3).transpose())),
      0);
  const MatrixXd one = MatrixXd::Constant(1, 1, 2.0);
  const Eigen::RowVector3d row(1, 2, 3);
  EXPECT_EQ(escapes(*verifiedSolve(one, row), *Judge::solve(one, row)), 0);
  EXPECT_EQ(verifiedInverse(MatrixXd(0, 0))->size(), 0);
  EXPECT_TRUE(isEqual(verifiedDeterminant(MatrixXd(0, 0))->value, 1));
}

TEST(VerifiedInverse, RefusesWhatIsNoMatrixOfRealsAndSaysWhatIsUnbounded) {
  using ::testing::HasSubstr;
  using ::testing::ThrowsMessage;
  const MatrixXd good = MatrixXd::Identity(2, 2);
  MatrixXd bad = good;
  EXPECT_THAT([] { verifiedInverse(MatrixXd(2, 3)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("must be square, not 2 x 3")));
  EXPECT_THAT([&] { verifiedSolve(good, MatrixXd(3, 1)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("2 x 2 and right-hand sides of size 3 x 1")));
  for (const double value : {infinity, -infinity, std::nan("")}) {
    bad(1, 0) = value;
    EXPECT_THAT([&] { verifiedInverse(bad); }, ThrowsMessage<std::invalid_argument>(HasSubstr("element (1, 0) is")));
    EXPECT_THROW(verifiedOrthogonalInverse(bad), std::invalid_argument);
    EXPECT_THROW(verifiedDeterminant(bad), std::invalid_argument);
    EXPECT_THROW(verifiedSolve(bad, good), std::invalid_argument);
    EXPECT_THROW(verifiedSolve(good, bad), std::invalid_argument);
  }
  IntervalMatrix intervals = good.cast<Interval>();
  intervals(0, 1) = Interval(1, infinity);
  const auto unbounded = verifiedInverse(intervals);
  ASSERT_FALSE(unbounded);
  EXPECT_THAT(unbounded.reason(), HasSubstr("element (0, 1) is unbounded"));
  EXPECT_THAT(verifiedSolve(good, intervals).reason(), HasSubstr("of the right-hand side element (0, 1) is unbounded"));
  EXPECT_THAT([&] { unbounded.value(); }, ThrowsMessage<std::runtime_error>(HasSubstr("element (0, 1) is unbounded")));
  intervals(1, 1) = Interval::empty();
  EXPECT_THAT([&] { verifiedInverse(intervals); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("element (1, 1) is an empty interval")));
}

// ---- Solutions ------------------------------------------------------------------------------------------------------

TEST(VerifiedSolve, HoldsTheExactSolutionsToAnUlpOfTheirGreatestElement) {
  RandomMatrices random;
  for (const auto [n, times] : sizes) {
    for (const double condition : conditions) {
      for (int time = 0; time < times; ++time) {
        const MatrixXd a = random.conditioned(n, condition),
                       b = random.matrix(n, 1 + time % 3, std::pow(10.0, time - 20));
        const auto solution = verifiedSolve(a, b);
        ASSERT_TRUE(solution) << n << ", " << condition << ": " << solution.reason();
        const Judge judge = *Judge::solve(a, b);
        ASSERT_EQ(escapes(*solution, judge), 0) << n << ", " << condition;
        ASSERT_LE(greatestRadius(*solution), 4 * unit * judge.greatest()) << n << ", " << condition;
      }
    }
  }
}

TEST(VerifiedSolve, HoldsTheExactSolutionOfSixtyRows) {
  RandomMatrices random;
  for (const double condition : {10.0, 1e12}) {
    const MatrixXd a = random.conditioned(60, condition), b = random.matrix(60, 2);
    const auto solution = verifiedSolve(a, b);
    ASSERT_TRUE(solution) << solution.reason();
    EXPECT_EQ(escapes(*solution, *Judge::solve(a, b)), 0) << condition;
  }
}

TEST(VerifiedSolve, OfIntervalsHoldsTheSolutionOfEverySystemInside) {
  RandomMatrices random;
  for (const Index n : {1, 2, 3, 6, 12}) {
    for (const double width : {1e-12, 1e-6, 1e-3}) {
      const IntervalMatrix a = random.around(random.conditioned(n, 10), width),
                           b = random.around(random.matrix(n, 2), width);
      const MatrixXd thinA = random.inside(a), thinB = random.inside(b);
      const auto both = verifiedSolve(a, b), left = verifiedSolve(a, thinB), right = verifiedSolve(thinA, b);
      ASSERT_TRUE(both && left && right) << n << ", " << width;
      for (int time = 0; time < 40 / n + 2; ++time) {
        const MatrixXd insideA = random.inside(a), insideB = random.inside(b);
        ASSERT_EQ(escapes(*both, *Judge::solve(insideA, insideB)), 0) << n << ", " << width;
        ASSERT_EQ(escapes(*left, *Judge::solve(insideA, thinB)), 0) << n << ", " << width;
        ASSERT_EQ(escapes(*right, *Judge::solve(thinA, insideB)), 0) << n << ", " << width;
      }
    }
  }
}

TEST(VerifiedSolve, ReachesTheEndsOfAnIntervalRightHandSide) {
  const Eigen::Matrix2d a{{2, 0}, {0, 4}};
  const Eigen::Matrix<Interval, 2, 1> b(Interval(-1, 3), Interval(8, 16)), x = *verifiedSolve(a, b);
  EXPECT_THAT(x(0), ::testing::AllOf(IsSubsetOf(Interval(-0.5 - 1e-13, 1.5 + 1e-13))));
  EXPECT_TRUE(isSubset(Interval(-0.5, 1.5), x(0)));
  EXPECT_TRUE(isSubset(Interval(2, 4), x(1)));
}

TEST(VerifiedSolve, SaysWhenASolutionOverflows) {
  const Eigen::Matrix<double, 1, 1> a(1e-300), b(1e300);
  const auto x = verifiedSolve(a, b);
  EXPECT_TRUE(!x || x->value().upper() == infinity);
}

// ---- Nearly orthogonal matrices -------------------------------------------------------------------------------------

TEST(VerifiedOrthogonalInverse, HoldsTheExactInverseOfRotationsThatSufferedRounding) {
  RandomMatrices random;
  for (const Index n : {1, 2, 3, 6, 12, 30}) {
    const MatrixXd q = random.orthogonal(n);
    for (const double disturbance : {0.0, 1e-9, 1e-4}) {
      const MatrixXd a = q + random.matrix(n, n, disturbance);
      const auto inverse = verifiedOrthogonalInverse(a);
      ASSERT_TRUE(inverse) << n << ", " << disturbance << ": " << inverse.reason();
      EXPECT_EQ(escapes(*inverse, Judge::invert(a)), 0) << n << ", " << disturbance;
      EXPECT_LE(greatestRadius(*inverse), 4 * double(n * n) * (unit + disturbance)) << n << ", " << disturbance;
    }
    const IntervalMatrix intervals = random.around(q, 1e-5);
    const auto inverse = verifiedOrthogonalInverse(intervals);
    ASSERT_TRUE(inverse) << n << inverse.reason();
    EXPECT_EQ(escapes(*inverse, Judge::invert(random.inside(intervals))), 0) << n;
  }
  EXPECT_FALSE(verifiedOrthogonalInverse(MatrixXd(2 * MatrixXd::Identity(3, 3))));
}

// ---- Determinants ---------------------------------------------------------------------------------------------------

TEST(VerifiedDeterminant, HasTheExactSignAndHoldsTheExactValue) {
  RandomMatrices random;
  for (const auto [n, times] : sizes) {
    for (const double condition : conditions) {
      for (int time = 0; time < times; ++time) {
        const MatrixXd a = random.conditioned(n, condition);
        const auto determinant = verifiedDeterminant(a);
        ASSERT_TRUE(determinant) << n << ", " << condition << ": " << determinant.reason();
        const Digits100 exact = Judge::determinantOf(a);
        ASSERT_EQ(determinant->sign, exact > 0 ? 1 : -1);
        ASSERT_TRUE(holds(determinant->value, exact)) << n << ", " << condition;
        const double relative = radius(determinant->value) / magnitude(determinant->value);
        ASSERT_LE(relative, 8 * double(n * n * (n + 1)) * condition * unit) << n << ", " << condition;
      }
    }
  }
}

TEST(VerifiedDeterminant, KeepsItsSignWhereTheValueUnderflowsOrOverflows) {
  RandomMatrices random;
  for (const double scale : {1e-100, 1e-308, 1e100, 1e300}) {
    const MatrixXd a = scale * random.conditioned(60, 10);
    const auto determinant = verifiedDeterminant(a);
    ASSERT_TRUE(determinant);
    const Digits100 exact = Judge::determinantOf(a);
    EXPECT_EQ(determinant->sign, exact > 0 ? 1 : -1);
    EXPECT_TRUE(holds(determinant->value, exact));
  }
}

TEST(VerifiedDeterminant, OfIntervalsHoldsThatOfEveryMatrixInside) {
  RandomMatrices random;
  for (const Index n : {1, 2, 3, 6, 12}) {
    const IntervalMatrix a = random.around(random.conditioned(n, 10), 1e-5);
    const auto determinant = verifiedDeterminant(a);
    ASSERT_TRUE(determinant) << determinant.reason();
    for (int time = 0; time < 20; ++time) {
      EXPECT_TRUE(holds(determinant->value, Judge::determinantOf(random.inside(a)))) << n;
    }
  }
}

// ---- Rounding modes -------------------------------------------------------------------------------------------------

constexpr int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

/// f(), computed in a rounding mode that ends with it.
template <class Function>
auto rounded(int mode, const Function& f) {
  struct Mode {
    explicit Mode(int mode) : before(std::fegetround()) { std::fesetround(mode); }
    ~Mode() { std::fesetround(before); }
    int before;
  } const scope(mode);
  return f();
}

TEST(VerifiedAlgebra, HoldsInWhicheverRoundingModeTheCallerLeft) {
  RandomMatrices random;
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    for (const Index n : {1, 3, 6, 12}) {
      for (const double condition : {1.0, 1e6, 1e11}) {
        const MatrixXd a = random.conditioned(n, condition), b = random.matrix(n, 2), q = random.orthogonal(n);
        const IntervalMatrix wide = random.around(random.conditioned(n, 10), 1e-5);
        std::fesetround(mode);
        const auto inverse = verifiedInverse(a), transposed = verifiedOrthogonalInverse(q),
                   ofWide = verifiedInverse(wide);
        const auto solution = verifiedSolve(a, b);
        const auto determinant = verifiedDeterminant(a);
        const bool kept = std::fegetround() == mode;
        std::fesetround(FE_TONEAREST);
        ASSERT_TRUE(kept && inverse && transposed && ofWide && solution && determinant) << n << ", " << condition;
        const Judge judge = Judge::invert(a);
        EXPECT_EQ(escapes(*inverse, judge), 0) << mode << ", " << n << ", " << condition;
        EXPECT_EQ(escapes(*transposed, Judge::invert(q)), 0) << mode << ", " << n << ", " << condition;
        EXPECT_EQ(escapes(*ofWide, Judge::invert(random.inside(wide))), 0) << mode << ", " << n << ", " << condition;
        EXPECT_EQ(escapes(*solution, *Judge::solve(a, b)), 0) << mode << ", " << n << ", " << condition;
        EXPECT_TRUE(holds(determinant->value, judge.determinant)) << mode << ", " << n << ", " << condition;
      }
    }
  }
}

TEST(VerifiedSolve, HoldsTheEndsOfRightHandSidesAsWideAsCanBeInEveryRoundingMode) {
  const Eigen::Matrix2d a{{2, 0}, {0, 1}};
  for (const int mode : modes) {
    for (const double end : {1e160, 1e170, 1e300, largest}) {
      const Eigen::Matrix<Interval, 2, 1> b(Interval(-end, end), Interval(-1, 1));
      const auto x = rounded(mode, [&] { return verifiedSolve(a, b); });
      ASSERT_TRUE(x) << mode << ", " << end << ": " << x.reason();
      EXPECT_TRUE(isSubset(Interval(-end / 2, end / 2), (*x)(0))) << mode << ": " << (*x)(0);
      EXPECT_TRUE(isSubset(Interval(-1, 1), (*x)(1))) << mode << ": " << (*x)(1);
      EXPECT_LE((*x)(0).upper(), end / 2 * (1 + 1e-13)) << mode;
    }
  }
}

TEST(VerifiedSolve, IsNotDeceivedByOverflowsThatEndAtTheLargestDouble) {
  RandomMatrices random;
  int verified = 0;
  const auto judge = [&](const MatrixXd& a, const MatrixXd& b) {
    for (const int mode : modes) {
      const auto x = rounded(mode, [&] { return verifiedSolve(a, b); });
      if (!x) continue;
      ++verified;
      EXPECT_EQ(escapes(*x, *Judge::solve(a, b)), 0) << mode << "\n" << a << "\n" << b << "\n" << *x;
    }
  };
  judge(MatrixXd{{3 * 0x1p997, 0x1p998, -0x1p999}, {3 * 0x1p997, 0x1p999, 0x1p999}, {0, 0x1p-1000, -0x1p-999}},
        VectorXd{{0, 0, 4}});
  for (int time = 0; time < 2000; ++time) {  // great rows times great solutions, which cancel
    const Index n = random.integer(2, 4);
    const int exponent = random.integer(994, 1020), last = random.integer(-1001, -900);
    const MatrixXd integers = MatrixXd::NullaryExpr(n, n, [&] { return random.integer(-4, 4); });
    MatrixXd a = std::ldexp(1.0, exponent) * integers, b = MatrixXd::Zero(n, 1);
    a.row(n - 1) = std::ldexp(1.0, last) * integers.row(n - 1);
    b(n - 1) = random.integer(1, 4);
    judge(a, b);
  }
  EXPECT_GT(verified, 400);
}

TEST(VerifiedAlgebra, HoldsForElementsOfAllMagnitudesInEveryRoundingMode) {
  RandomMatrices random;
  int verified = 0;
  for (int time = 0; time < 2000; ++time) {
    const Index n = random.integer(1, 4);
    const auto power = [&](int most) { return std::ldexp(1.0, random.integer(-most, most)); };
    IntervalMatrix a = random.around(random.matrix(n, n), power(40) * 0x1p-50), b(n, 1);
    for (Index k = 0; k < n; ++k) {
      a.row(k) *= Interval(power(450));
      a.col(k) *= Interval(power(450));
      const double end = power(1000);
      b(k) = Interval(-end, random.integer(0, 1) ? end : power(1000));
    }
    const MatrixXd insideA = random.inside(a), insideB = random.inside(b);
    const auto exact = Judge::solve(insideA, insideB);
    for (const int mode : modes) {
      const auto inverse = rounded(mode, [&] { return verifiedInverse(a); });
      const auto determinant = rounded(mode, [&] { return verifiedDeterminant(a); });
      const auto solution = rounded(mode, [&] { return verifiedSolve(a, b); });
      verified += bool(inverse) + bool(determinant) + bool(solution);
      if (inverse) {
        ASSERT_EQ(escapes(*inverse, Judge::invert(insideA)), 0) << mode << "\n" << a;
      }
      if (determinant) {
        ASSERT_TRUE(holds(determinant->value, exact->determinant)) << mode << "\n" << a;
      }
      if (solution) {
        ASSERT_EQ(escapes(*solution, *exact), 0) << mode << "\n" << a << "\n" << b;
      }
    }
  }
  EXPECT_GT(verified, 6000);
}

}  // namespace
}  // namespace gamut::verified_algebra_test
