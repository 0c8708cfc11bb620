// Eigen with a scalar, judged by the plain double result.
#pragma once

#include <gtest/gtest.h>

#include "scalars/eigen.hpp"
#include "scalars/fuzzy.hpp"
#include "scalars/samples.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::testing {

// Integers: each double operation below is exact, so every scalar must give just that value.
inline bool is(const Interval& x, double value) { return isEqual(x, value); }
inline bool is(const Samples& x, double value) { return x.minimum() == value && x.maximum() == value; }
inline bool is(const Fuzzy& x, double value) { return is(x.support(), value) && is(x.core(), value); }

/// Matrices of small integers, in doubles and in the scalar.
template <class S>
class EigenOf : public ::testing::Test {
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

using EigenScalars = ::testing::Types<Interval, Samples, Fuzzy>;

}  // namespace gamut::testing
