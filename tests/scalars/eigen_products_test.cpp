// Eigen with Interval, Samples and Fuzzy: products of small matrices.
#include "tests/scalars/eigen_of.hpp"

namespace gamut::eigen_products_test {
namespace {

using namespace gamut::testing;

template <class S>
class EigenProductsWith : public EigenOf<S> {};
TYPED_TEST_SUITE(EigenProductsWith, EigenScalars);

TYPED_TEST(EigenProductsWith, ProductsOfMatricesAndVectors) {
  this->expectAll(this->m * this->x, this->a * this->u);
  this->expectAll(this->m * this->n, this->a * this->b);
  this->expectAll(this->m.transpose() * this->n * this->x, this->a.transpose() * this->b * this->u);
  this->expectAll(this->x * this->y.transpose(), this->u * this->v.transpose());
}

TYPED_TEST(EigenProductsWith, ProductsWithMatricesOfDoubles) {
  this->expectAll(this->a * this->x, this->a * this->u);
  this->expectAll(this->m * this->v, this->a * this->v);
}

}  // namespace
}  // namespace gamut::eigen_products_test
