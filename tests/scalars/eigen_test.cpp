// Eigen with every scalar: the same law-based tests for Interval, Samples and Fuzzy, judged by the plain double result.
#include "scalars/eigen.hpp"

#include <Eigen/LU>

#include "scalars/fuzzy.hpp"
#include "scalars/samples.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut {
namespace {

using namespace gamut::testing;

// Integers: each double operation below is exact, so every scalar must give just that value.
bool is(const Interval& x, double value) { return isEqual(x, value); }
bool is(const Samples& x, double value) { return x.minimum() == value && x.maximum() == value; }
bool is(const Fuzzy& x, double value) { return is(x.support(), value) && is(x.core(), value); }

template <class S>
class EigenWith : public ::testing::Test {
 protected:
  using Vector = Eigen::Matrix<S, 3, 1>;
  using Matrix = Eigen::Matrix<S, 3, 3>;
  const Eigen::Vector3d u{1, -2, 3}, v{4, 5, -6};
  const Eigen::Matrix3d a{{1, 2, 3}, {-4, 5, 6}, {7, -8, 9}}, b{{2, 0, 1}, {1, -3, 5}, {4, 4, -1}};
  const Vector x = u.cast<S>(), y = v.cast<S>();
  const Matrix m = a.cast<S>(), n = b.cast<S>();

  template <class Actual, class Expected>
  void expectAll(const Eigen::MatrixBase<Actual>& actual, const Eigen::MatrixBase<Expected>& expected) {
    ASSERT_EQ(actual.rows(), expected.rows());
    ASSERT_EQ(actual.cols(), expected.cols());
    for (Eigen::Index i = 0; i < actual.rows(); ++i) {
      for (Eigen::Index j = 0; j < actual.cols(); ++j) {
        EXPECT_TRUE(is(S(actual(i, j)), expected(i, j))) << i << ", " << j << ": " << S(actual(i, j));
      }
    }
  }
};

using Scalars = ::testing::Types<Interval, Samples, Fuzzy>;
TYPED_TEST_SUITE(EigenWith, Scalars);

TYPED_TEST(EigenWith, SumsAndMultiples) {
  this->expectAll(this->x + this->y, this->u + this->v);
  this->expectAll(-this->x - this->y, -this->u - this->v);
  this->expectAll(2.0 * this->x, 2.0 * this->u);
  this->expectAll(this->m * 0.5, this->a * 0.5);
  this->expectAll(this->x / 2.0, this->u / 2.0);
  this->expectAll(TypeParam(3) * this->x, 3.0 * this->u);
}

TYPED_TEST(EigenWith, ProductsOfMatricesAndVectors) {
  this->expectAll(this->m * this->x, this->a * this->u);
  this->expectAll(this->m * this->n, this->a * this->b);
  this->expectAll(this->m.transpose() * this->n * this->x, this->a.transpose() * this->b * this->u);
  this->expectAll(this->x * this->y.transpose(), this->u * this->v.transpose());
}

TYPED_TEST(EigenWith, ProductsWithMatricesOfDoubles) {
  this->expectAll(this->a * this->x, this->a * this->u);
  this->expectAll(this->m * this->v, this->a * this->v);
}

TYPED_TEST(EigenWith, DotCrossAndSquaredNorm) {
  EXPECT_TRUE(is(this->x.dot(this->y), this->u.dot(this->v)));
  EXPECT_TRUE(is(this->x.squaredNorm(), this->u.squaredNorm()));
  EXPECT_TRUE(is(this->m.trace(), this->a.trace()));
  EXPECT_TRUE(is(this->x.sum(), this->u.sum()));
  this->expectAll(this->x.cross(this->y), this->u.cross(this->v));
}

TYPED_TEST(EigenWith, ConstantMatricesAndBlocks) {
  using Dynamic = Eigen::Matrix<TypeParam, Eigen::Dynamic, Eigen::Dynamic>;
  this->expectAll(TestFixture::Matrix::Identity() * this->x, this->u);
  this->expectAll(TestFixture::Vector::Zero(), Eigen::Vector3d::Zero());
  Dynamic large = Dynamic::Zero(6, 6);
  large.template block<3, 3>(3, 3) = this->m;
  large.template topLeftCorner<3, 3>() += this->n;
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 6);
  expected.block<3, 3>(3, 3) = this->a;
  expected.topLeftCorner<3, 3>() += this->b;
  this->expectAll(large, expected);
  this->expectAll(large * large, expected * expected);
  this->expectAll(large * large.col(4), expected * expected.col(4));
  this->expectAll(large.row(4) * large, expected.row(4) * expected);
}

TYPED_TEST(EigenWith, LargeProducts) {
  using Dynamic = Eigen::Matrix<TypeParam, Eigen::Dynamic, Eigen::Dynamic>;
  Eigen::MatrixXd left(24, 24), right(24, 24);
  for (int i = 0; i < left.size(); ++i) {
    left(i) = i % 7 - 3;
    right(i) = i % 5 - 2;
  }
  const Dynamic product = left.cast<TypeParam>() * right.cast<TypeParam>();
  this->expectAll(product, left * right);
}

TYPED_TEST(EigenWith, DeterminantAndInverseOfThreeByThreeNeedNoComparison) {
  EXPECT_TRUE(is(this->m.determinant(), 240));
  const Eigen::Matrix3d triangular{{2, 4, 8}, {0, 4, 16}, {0, 0, 8}};
  const typename TestFixture::Matrix inverse = triangular.cast<TypeParam>().inverse();
  this->expectAll(inverse * triangular.cast<TypeParam>(), Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace gamut
