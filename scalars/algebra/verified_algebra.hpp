// Verified dense linear algebra: inverses, solutions and determinants that are proved to enclose the exact ones, for
// matrices of doubles and of intervals. Or a plain statement that nothing could be proved, and why.
//
//   Eigen::MatrixXd a = ...;                                  // Eigen::Matrix3d, Eigen::Matrix<Interval, 6, 6>, ...
//   const auto inverse = verifiedInverse(a);
//   if (!inverse) std::cerr << inverse.reason();              // "the matrix may be singular: ..."
//   else std::cout << (*inverse)(0, 0);                       // an Interval: it holds the exact inverse's element
//
// For a matrix of intervals every result holds for every real matrix inside. A matrix that is singular, or intervals
// that hold a singular one, can never be verified; regular ones are, as a rule, up to condition numbers of about
// 10^15 / n after scaling rows and columns by powers of two (so bad scaling costs nothing, up to factors of 10^140).
//
// How: floating-point algebra guesses R, about the inverse of A; then G >= |I - R A| is computed elementwise, with an
// a-priori bound for its rounding errors, and if its row sums stay below 1 then A is regular and A^-1 lies near R
// (Rump, Verification methods, Acta Numerica 2010, section 10.8; each step is proved in verified_proof.hpp).
// Interval elimination would be wider by orders of magnitude, and needs comparisons that intervals do not have.
//
// No rounding mode is touched, and the enclosures hold in whichever the caller left (widest when it is not to nearest);
// modes that flush subnormal numbers to zero are beyond them, as in elementary/rounding.hpp.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "scalars/eigen.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// A proved result, or the reason why there is none.
template <class T>
class Verified {
 public:
  Verified(T value) : value_(std::move(value)) {}  // NOLINT(google-explicit-*): implicit on purpose

  static Verified failure(std::string reason) {
    Verified result;
    result.reason_ = std::move(reason);
    return result;
  }

  explicit operator bool() const { return value_.has_value(); }

  /// The result. Throws std::runtime_error with the reason when nothing was proved.
  const T& value() const {
    if (!value_) throw std::runtime_error(reason_);
    return *value_;
  }
  const T& operator*() const { return value(); }
  const T* operator->() const { return &value(); }

  /// Why nothing was proved; empty when something was.
  const std::string& reason() const { return reason_; }

 private:
  Verified() = default;

  std::optional<T> value_;
  std::string reason_;
};

/// A determinant that is certainly not zero.
struct Determinant {
  /// 1 or -1; also right where the value underflows or overflows, when the interval reaches to 0 or to infinity.
  int sign;
  Interval value;
};

namespace detail {

template <class S>
using DenseView =
    Eigen::Ref<const Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<Eigen::Dynamic>>;

// Results are written in column order. The text returned says why nothing was proved; empty when all was.
// Instantiated for S and B = double and Interval.
template <class S>
std::string enclosedInverse(const DenseView<S>& a, Interval* inverse);
template <class S>
std::string enclosedOrthogonalInverse(const DenseView<S>& a, Interval* inverse);
template <class S, class B>
std::string enclosedSolution(const DenseView<S>& a, const DenseView<B>& b, Interval* solution);
template <class S>
std::string enclosedDeterminant(const DenseView<S>& a, Determinant& determinant);

/// A matrix of intervals, proved to be regular once for all its right-hand sides: each is enclosed as by verifiedSolve.
class RegularMatrix {
 public:
  explicit RegularMatrix(const DenseView<Interval>& a);
  ~RegularMatrix();

  /// The solutions for b, which has one column; false where nothing was proved.
  bool enclose(const DenseView<Interval>& b, Interval* solution) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;  // null: unbounded
};

template <class A>
concept RealOrIntervalMatrix =
    std::is_same_v<typename A::Scalar, double> || std::is_same_v<typename A::Scalar, Interval>;

/// A matrix of intervals with as many rows as `Rows` and as many columns as `Columns`, fixed where those are.
template <class Rows, class Columns>
using Enclosure = Eigen::Matrix<Interval, Rows::RowsAtCompileTime, Columns::ColsAtCompileTime>;

template <class T>
Verified<T> verifiedUnless(const std::string& failure, T& value) {
  return failure.empty() ? Verified<T>(std::move(value)) : Verified<T>::failure(failure);
}

}  // namespace detail

// All functions throw std::invalid_argument, naming the sizes or the element, for matrices that do not fit together,
// NaN and infinities among doubles, and empty intervals. An unbounded interval is a reason for not verifying.

/// An enclosure of the inverses of all matrices in a, which is square. Each radius is about n kappa 2^-53 times the
/// inverse's norm, kappa the condition number (plus what a's own intervals cause); verifiedSolve with the identity as
/// right-hand side is accurate to about an ulp instead, and costs several times as much.
template <class A>
requires detail::RealOrIntervalMatrix<A> Verified<detail::Enclosure<A, A>> verifiedInverse(
    const Eigen::MatrixBase<A>& a) {
  detail::Enclosure<A, A> inverse(a.rows(), a.cols());
  return detail::verifiedUnless(detail::enclosedInverse<typename A::Scalar>(a.derived(), inverse.data()), inverse);
}

/// verifiedInverse for a matrix that is nearly orthogonal, such as a rotation that has suffered rounding: the transpose
/// is the guess, so that elimination is saved. Fails when a transpose(a) is far from the identity.
template <class A>
requires detail::RealOrIntervalMatrix<A> Verified<detail::Enclosure<A, A>> verifiedOrthogonalInverse(
    const Eigen::MatrixBase<A>& a) {
  detail::Enclosure<A, A> inverse(a.rows(), a.cols());
  return detail::verifiedUnless(detail::enclosedOrthogonalInverse<typename A::Scalar>(a.derived(), inverse.data()),
                                inverse);
}

/// An enclosure of the solutions x of a x = b for all matrices in a (square) and all right-hand sides in b, one a
/// column. Residuals are computed in about doubled precision: for doubles each column is enclosed to about an ulp of
/// its greatest element, whatever the condition number, as far as it can be verified at all.
template <class A, class B>
requires(detail::RealOrIntervalMatrix<A>&& detail::RealOrIntervalMatrix<B>)
    Verified<detail::Enclosure<A, B>> verifiedSolve(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  detail::Enclosure<A, B> solution(a.rows(), b.cols());
  return detail::verifiedUnless(
      detail::enclosedSolution<typename A::Scalar, typename B::Scalar>(a.derived(), b.derived(), solution.data()),
      solution);
}

/// The sign and an enclosure of the determinants of all matrices in a, which is square: verified only if none is zero.
template <class A>
requires detail::RealOrIntervalMatrix<A> Verified<Determinant> verifiedDeterminant(const Eigen::MatrixBase<A>& a) {
  Determinant determinant{1, 1.0};
  return detail::verifiedUnless(detail::enclosedDeterminant<typename A::Scalar>(a.derived(), determinant), determinant);
}

}  // namespace gamut
