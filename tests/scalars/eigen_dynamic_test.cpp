// Eigen with Interval, Samples and Fuzzy: matrices of any size and their blocks.
#include "tests/scalars/eigen_of.hpp"

namespace gamut::eigen_dynamic_test {
namespace {

using namespace gamut::testing;

template <class S>
class EigenOfAnySizeWith : public EigenOf<S> {};
TYPED_TEST_SUITE(EigenOfAnySizeWith, EigenScalars);

TYPED_TEST(EigenOfAnySizeWith, ConstantMatricesAndBlocks) {
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

TYPED_TEST(EigenOfAnySizeWith, LargeProducts) {
  using Dynamic = Eigen::Matrix<TypeParam, Eigen::Dynamic, Eigen::Dynamic>;
  Eigen::MatrixXd left(24, 24), right(24, 24);
  for (int i = 0; i < left.size(); ++i) {
    left(i) = i % 7 - 3;
    right(i) = i % 5 - 2;
  }
  const Dynamic product = left.cast<TypeParam>() * right.cast<TypeParam>();
  this->expectAll(product, left * right);
}

}  // namespace
}  // namespace gamut::eigen_dynamic_test
