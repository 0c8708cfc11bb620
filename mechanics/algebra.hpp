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
