// Eigen with Interval, Samples and Fuzzy: sums and products of vectors, determinants.
#include "scalars/eigen.hpp"

#include <Eigen/LU>

#include "tests/scalars/eigen_of.hpp"

namespace gamut::eigen_test {
namespace {

using namespace gamut::testing;

template <class S>
class EigenWith : public EigenOf<S> {};
TYPED_TEST_SUITE(EigenWith, EigenScalars);

TYPED_TEST(EigenWith, SumsAndMultiples) {
  this->expectAll(this->x + this->y, this->u + this->v);
  this->expectAll(-this->x - this->y, -this->u - this->v);
  this->expectAll(2.0 * this->x, 2.0 * this->u);
  this->expectAll(this->m * 0.5, this->a * 0.5);
  this->expectAll(this->x / 2.0, this->u / 2.0);
  this->expectAll(TypeParam(3) * this->x, 3.0 * this->u);
}

TYPED_TEST(EigenWith, DotCrossAndSquaredNorm) {
  EXPECT_TRUE(is(this->x.dot(this->y), this->u.dot(this->v)));
  EXPECT_TRUE(is(this->x.squaredNorm(), this->u.squaredNorm()));
  EXPECT_TRUE(is(this->m.trace(), this->a.trace()));
  EXPECT_TRUE(is(this->x.sum(), this->u.sum()));
  this->expectAll(this->x.cross(this->y), this->u.cross(this->v));
}

TYPED_TEST(EigenWith, DeterminantAndInverseOfThreeByThreeNeedNoComparison) {
  EXPECT_TRUE(is(this->m.determinant(), 240));
  const Eigen::Matrix3d triangular{{2, 4, 8}, {0, 4, 16}, {0, 0, 8}};
  const typename TestFixture::Matrix inverse = triangular.cast<TypeParam>().inverse();
  this->expectAll(inverse * triangular.cast<TypeParam>(), Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace gamut::eigen_test
