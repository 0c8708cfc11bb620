// Small vectors and matrices over any scalar.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "mechanics/scalars.hpp"
#include "scalars/eigen.hpp"
#include "scalars/fuzzy.hpp"
#include "scalars/recorded.hpp"
#include "scalars/samples.hpp"
#include "scalars/traits.hpp"

namespace gamut {

template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;

// Sums and products of plain ones, compiled once for each scalar of the library (algebra_members.hpp), as expressions
// of Eigen's would be wherever they stand: these are what takes longest to compile in elements.
template <class S>
Vector3<S> operator+(const Vector3<S>& a, const Vector3<S>& b);
template <class S>
Vector3<S> operator-(const Vector3<S>& a, const Vector3<S>& b);
template <class S>
Vector3<S> operator-(const Vector3<S>& a);
template <class S>
Vector3<S> operator*(const Vector3<S>& a, const S& factor);
template <class S>
Vector3<S> operator*(const S& factor, const Vector3<S>& a);
template <class S>
Vector3<S>& operator+=(Vector3<S>& sum, const Vector3<S>& a);
template <class S>
Vector3<S>& operator-=(Vector3<S>& rest, const Vector3<S>& a);
template <class S>
Matrix3<S> operator+(const Matrix3<S>& a, const Matrix3<S>& b);
template <class S>
Matrix3<S> operator-(const Matrix3<S>& a, const Matrix3<S>& b);
template <class S>
Vector3<S> operator*(const Matrix3<S>& a, const Vector3<S>& b);
template <class S>
Vector3<S> operator*(const Eigen::Transpose<Matrix3<S>>& a, const Vector3<S>& b);
template <class S>
Vector3<S> operator*(const Eigen::Transpose<const Matrix3<S>>& a, const Vector3<S>& b);
template <class S>
Matrix3<S> operator*(const Matrix3<S>& a, const Matrix3<S>& b);
template <class S>
Matrix3<S> operator*(const Eigen::Transpose<Matrix3<S>>& a, const Matrix3<S>& b);
template <class S>
Matrix3<S> operator*(const Eigen::Transpose<const Matrix3<S>>& a, const Matrix3<S>& b);

#define GAMUT_SMALL_ALGEBRA(KEYWORD, S)                                                                    \
  KEYWORD template Vector3<S> operator+(const Vector3<S>& a, const Vector3<S>& b);                         \
  KEYWORD template Vector3<S> operator-(const Vector3<S>& a, const Vector3<S>& b);                         \
  KEYWORD template Vector3<S> operator-(const Vector3<S>& a);                                              \
  KEYWORD template Vector3<S> operator*(const Vector3<S>& a, const S& factor);                             \
  KEYWORD template Vector3<S> operator*(const S& factor, const Vector3<S>& a);                             \
  KEYWORD template Vector3<S>& operator+=(Vector3<S>& sum, const Vector3<S>& a);                           \
  KEYWORD template Vector3<S>& operator-=(Vector3<S>& rest, const Vector3<S>& a);                          \
  KEYWORD template Matrix3<S> operator+(const Matrix3<S>& a, const Matrix3<S>& b);                         \
  KEYWORD template Matrix3<S> operator-(const Matrix3<S>& a, const Matrix3<S>& b);                         \
  KEYWORD template Vector3<S> operator*(const Matrix3<S>& a, const Vector3<S>& b);                         \
  KEYWORD template Vector3<S> operator*(const Eigen::Transpose<Matrix3<S>>& a, const Vector3<S>& b);       \
  KEYWORD template Vector3<S> operator*(const Eigen::Transpose<const Matrix3<S>>& a, const Vector3<S>& b); \
  KEYWORD template Matrix3<S> operator*(const Matrix3<S>& a, const Matrix3<S>& b);                         \
  KEYWORD template Matrix3<S> operator*(const Eigen::Transpose<Matrix3<S>>& a, const Matrix3<S>& b);       \
  KEYWORD template Matrix3<S> operator*(const Eigen::Transpose<const Matrix3<S>>& a, const Matrix3<S>& b);
GAMUT_FOR_EVERY_SCALAR(GAMUT_SMALL_ALGEBRA, extern)

template <class S>
Vector3<S> zeroVector() {
  return Vector3<S>(S(0.0), S(0.0), S(0.0));
}

template <class S>
Matrix3<S> zeroMatrix() {
  Matrix3<S> zero;
  for (int i = 0; i < 3; ++i) zero.col(i) = zeroVector<S>();
  return zero;
}

template <class S>
Matrix3<S> unitMatrix() {
  Matrix3<S> unit = zeroMatrix<S>();
  for (int i = 0; i < 3; ++i) unit(i, i) = S(1.0);
  return unit;
}

/// W with  ω̇ × d + ω × (ω × d) = W d  for every offset d that is fixed in the moving frame. Written as
/// [ω̇]× + ω ωᵀ − |ω|² I, whose squares are shared by all offsets of one body.
template <class S>
Matrix3<S> offsetAcceleration(const Vector3<S>& omega, const Vector3<S>& omegaDot) {
  const S xx = square(omega[0]), yy = square(omega[1]), zz = square(omega[2]);
  const S xy = omega[0] * omega[1], yz = omega[1] * omega[2], zx = omega[2] * omega[0];
  Matrix3<S> w;
  w << -(yy + zz), xy - omegaDot[2], zx + omegaDot[1],  //
      xy + omegaDot[2], -(xx + zz), yz - omegaDot[0],   //
      zx - omegaDot[1], yz + omegaDot[0], -(xx + yy);
  return w;
}

}  // namespace gamut
