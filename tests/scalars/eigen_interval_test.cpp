// Eigen with intervals: the same formula of intervals, and in 100 digits of elements inside them. Containment is exact.
#include <Eigen/LU>
#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>

#include "scalars/eigen.hpp"
#include "scalars/interval.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::eigen_interval_test {
namespace {

using namespace gamut::testing;
using Digits100 =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<100, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;
template <class S, int rows, int columns = rows>
using Matrix = Eigen::Matrix<S, rows, columns>;

class EigenWithInterval : public ::testing::Test {
 protected:
  /// Intervals in [-2, 2], and a matrix of elements of theirs.
  template <int rows, int columns>
  struct Pair {
    Matrix<Interval, rows, columns> intervals;
    Matrix<Digits100, rows, columns> inside;
  };

  template <int rows, int columns = rows>
  Pair<rows, columns> random(int rowCount = rows, int columnCount = columns, double widest = 4) {
    Pair<rows, columns> pair;
    pair.intervals.resize(rowCount, columnCount);
    pair.inside.resize(rowCount, columnCount);
    for (int i = 0; i < rowCount * columnCount; ++i) {
      const double lower = random_.uniform(-2, 2), upper = std::min(2.0, lower + random_.uniform(0, widest));
      pair.intervals.data()[i] = random_.integer(0, 3) == 0 ? Interval(lower) : Interval(lower, upper);
      pair.inside.data()[i] = random_.elementOf(pair.intervals.data()[i]);
    }
    return pair;
  }

  /// f of the intervals must hold f of what is inside, element by element.
  template <class F, class... Pairs>
  static void expectHeld(F f, const Pairs&... pairs) {
    const auto enclosure = f(pairs.intervals...);
    const auto value = f(pairs.inside...);
    if constexpr (std::is_same_v<std::decay_t<decltype(enclosure)>, Interval>) {
      EXPECT_TRUE(holds(enclosure, value)) << enclosure << " and " << value;
    } else {
      ASSERT_EQ(enclosure.size(), value.size());
      for (Eigen::Index i = 0; i < value.size(); ++i) {
        EXPECT_TRUE(holds(enclosure.data()[i], value.data()[i])) << enclosure.data()[i] << " and " << value.data()[i];
      }
    }
  }

  template <class A, class B>
  static void expectProduct(const Matrix<Interval, Eigen::Dynamic>& product, const A& a, const B& b) {
    ASSERT_TRUE(product.rows() == a.inside.rows() && product.cols() == b.inside.cols());
    for (Eigen::Index i = 0; i < product.rows(); ++i) {
      for (Eigen::Index j = 0; j < product.cols(); ++j) {
        Digits100 sum = 0;
        for (Eigen::Index k = 0; k < a.inside.cols(); ++k) sum += a.inside(i, k) * b.inside(k, j);
        EXPECT_TRUE(holds(product(i, j), sum));
      }
    }
  }

  static bool holds(const Interval& x, const Digits100& value) {
    return (x.lower() == -infinity || Digits100(x.lower()) <= value) &&
           (x.upper() == infinity || value <= Digits100(x.upper()));
  }

  RandomDoubles random_;
  static constexpr int times = cases / 4;
};

TEST_F(EigenWithInterval, ProductsHoldTheProductsOfElements) {
  for (int i = 0; i < times; ++i) {
    const auto a = random<3>(), b = random<3>();
    const auto u = random<3, 1>(), v = random<3, 1>();
    expectHeld([](const auto& x, const auto& y) { return (x * y).eval(); }, a, b);
    expectHeld([](const auto& x, const auto& y) { return (x * y).eval(); }, a, u);
    expectHeld([](const auto& x, const auto& y) { return (x.transpose() * y).eval(); }, u, a);
    expectHeld([](const auto& x, const auto& y) { return (x * y.transpose() - y * x.transpose()).eval(); }, u, v);
    expectHeld([](const auto& x, const auto& y) { return x.dot(y); }, u, v);
    expectHeld([](const auto& x, const auto& y) { return x.cross(y); }, u, v);
  }
}

TEST_F(EigenWithInterval, NormsHoldTheNormsOfElements) {
  for (int i = 0; i < times; ++i) {
    const auto u = random<3, 1>();
    expectHeld([](const auto& x) { return x.squaredNorm(); }, u);
    expectHeld([](const auto& x) { return x.norm(); }, u);
    expectHeld([](const auto& x) { return (x / x.norm()).eval(); }, u);
    expectHeld([](const auto& x) { return x.maxCoeff(); }, u);
    expectHeld([](const auto& x) { return x.cwiseAbs().minCoeff(); }, u);
    expectHeld([](const auto& x) { return x.template lpNorm<1>(); }, u);
  }
}

TEST_F(EigenWithInterval, InversesAndDeterminantsHoldThoseOfElements) {
  const auto inverse = [](const auto& x) { return x.inverse().eval(); };
  const auto determinant = [](const auto& x) { return x.determinant(); };
  for (int i = 0; i < times; ++i) {
    const double widest = i % 2 == 0 ? 4 : 0.1;
    const auto two = random<2>(2, 2, widest);
    const auto three = random<3>(3, 3, widest);
    const auto four = random<4>(4, 4, widest);
    expectHeld(inverse, two);
    expectHeld(inverse, three);
    expectHeld(inverse, four);
    expectHeld(determinant, two);
    expectHeld(determinant, three);
    expectHeld(determinant, four);
  }
}

TEST_F(EigenWithInterval, QuaternionsHoldTheRotationsOfElements) {
  const auto product = [](const auto& x, const auto& y) {
    using S = typename std::decay_t<decltype(x)>::Scalar;
    const Eigen::Quaternion<S> p(x), q(y);  // coefficients in the order x, y, z, w
    return Matrix<S, 4, 1>((p * q.conjugate()).coeffs());
  };
  const auto rotationMatrix = [](const auto& x) {
    using S = typename std::decay_t<decltype(x)>::Scalar;
    return Matrix<S, 3>(Eigen::Quaternion<S>(x).toRotationMatrix());
  };
  const auto rotated = [](const auto& x, const auto& u) {
    using S = typename std::decay_t<decltype(x)>::Scalar;
    return Matrix<S, 3, 1>(Eigen::Quaternion<S>(x) * u);
  };
  const auto aboutAxis = [](const auto& x) {
    using S = typename std::decay_t<decltype(x)>::Scalar;
    return Matrix<S, 3>(Eigen::AngleAxis<S>(x(3), x.template head<3>()).toRotationMatrix());
  };
  for (int i = 0; i < times; ++i) {
    const auto p = random<4, 1>(), q = random<4, 1>();
    const auto u = random<3, 1>();
    expectHeld(product, p, q);
    expectHeld(rotationMatrix, p);
    expectHeld(rotated, p, u);
    if (i < times / 50) expectHeld(aboutAxis, p);  // the sine of 100 digits takes its time
  }
}

TEST_F(EigenWithInterval, MatricesOfAnySizeHoldTheProductsOfElements) {
  constexpr int any = Eigen::Dynamic;
  for (int i = 0; i < times / 50; ++i) {
    const auto a = random<any>(5, 7), b = random<any>(7, 4);
    const auto u = random<any, 1>(7, 1);
    expectProduct(a.intervals * b.intervals, a, b);
    expectProduct(a.intervals * u.intervals, a, u);
    expectHeld([](const auto& x) { return x.norm(); }, a);
  }
}

TEST_F(EigenWithInterval, DoublesAndMatricesOfDoublesMultiplyIntervals) {
  for (int i = 0; i < times; ++i) {
    const double factor = random_.uniform(-2, 2);
    const Eigen::Matrix3d left = Eigen::Matrix3d::NullaryExpr([&] { return random_.uniform(-2, 2); });
    const auto a = random<3>();
    const auto u = random<3, 1>();
    const Matrix<Interval, 3> scaled = factor * a.intervals, product = left * a.intervals, right = a.intervals * left;
    const Matrix<Interval, 3, 1> image = left * u.intervals;
    const Matrix<Digits100, 3> exactLeft = left.cast<Digits100>();
    for (int k = 0; k < 9; ++k) {
      EXPECT_TRUE(holds(scaled(k), Digits100(factor) * a.inside(k)));
      EXPECT_TRUE(holds(product(k), (exactLeft * a.inside).eval()(k)));
      EXPECT_TRUE(holds(right(k), (a.inside * exactLeft).eval()(k)));
      EXPECT_TRUE(isEqual(left.cast<Interval>()(k), left(k)));
    }
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(holds(image(k), (exactLeft * u.inside).eval()(k)));
  }
}

}  // namespace
}  // namespace gamut::eigen_interval_test
