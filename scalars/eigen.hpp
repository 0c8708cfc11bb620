// Eigen with Gamut's scalars: Eigen::Matrix<S, 3, 1>, products, sums, dot, cross, norm, transpose, quaternions,
// inverses and determinants up to 4 x 4 (3 x 3 for all), and double * Matrix<S>. Comparisons are absent on purpose:
// what branches on values (pivoting decompositions, isApprox, normalized(), a quaternion's inverse) does not compile.
// Write v / v.norm(); for larger systems of intervals see algebra/verified_algebra.hpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <type_traits>

namespace gamut {

class Interval;
class Samples;
class Fuzzy;
class Recorded;

namespace detail {

/// What Eigen needs to know of a real scalar that is not a machine number: to be initialised, and not to be cheap.
template <class S>
struct EigenScalar : Eigen::GenericNumTraits<double> {
  using Real = S;
  using NonInteger = S;
  using Nested = S;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = Eigen::HugeCost,
    AddCost = Eigen::HugeCost,
    MulCost = Eigen::HugeCost
  };
};

/// The imaginary part of a real scalar. Eigen 3.4's general products ask whether it is zero, even of real scalars; this
/// answers at compile time, without a comparison of scalars.
struct NoImaginaryPart {
  template <class S>
  friend constexpr bool operator==(NoImaginaryPart, const S&) {
    return true;
  }
};

}  // namespace detail
}  // namespace gamut

namespace Eigen {

template <>
struct NumTraits<gamut::Interval> : gamut::detail::EigenScalar<gamut::Interval> {
  enum { RequireInitialization = 1, ReadCost = 2, AddCost = 8, MulCost = 16 };
};
template <>
struct NumTraits<gamut::Samples> : gamut::detail::EigenScalar<gamut::Samples> {};
template <>
struct NumTraits<gamut::Fuzzy> : gamut::detail::EigenScalar<gamut::Fuzzy> {};
template <>
struct NumTraits<gamut::Recorded> : gamut::detail::EigenScalar<gamut::Recorded> {};

#define GAMUT_EIGEN_SCALAR(S)                                                 \
  template <class BinaryOp>                                                   \
  struct ScalarBinaryOpTraits<gamut::S, double, BinaryOp> {                   \
    using ReturnType = gamut::S;                                              \
  };                                                                          \
  template <class BinaryOp>                                                   \
  struct ScalarBinaryOpTraits<double, gamut::S, BinaryOp> {                   \
    using ReturnType = gamut::S;                                              \
  };                                                                          \
  template <>                                                                 \
  struct internal::imag_retval<gamut::S> {                                    \
    using type = gamut::detail::NoImaginaryPart;                              \
  };                                                                          \
  template <>                                                                 \
  struct internal::imag_impl<gamut::S> {                                      \
    static gamut::detail::NoImaginaryPart run(const gamut::S&) { return {}; } \
  };
GAMUT_EIGEN_SCALAR(Interval)
GAMUT_EIGEN_SCALAR(Samples)
GAMUT_EIGEN_SCALAR(Fuzzy)
GAMUT_EIGEN_SCALAR(Recorded)
#undef GAMUT_EIGEN_SCALAR

/// Products of matrices of intervals are their entries' sums: blocks laid out for machine numbers' caches gain nothing
/// and take seconds to compile.
template <class Lhs, class Rhs>
requires std::is_same_v<typename Lhs::Scalar, gamut::Interval>
struct internal::generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemmProduct>
    : internal::generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, CoeffBasedProductMode> {
};
template <class Lhs, class Rhs>
requires std::is_same_v<typename Lhs::Scalar, gamut::Interval>
struct internal::generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemvProduct>
    : internal::generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, CoeffBasedProductMode> {
};

}  // namespace Eigen
