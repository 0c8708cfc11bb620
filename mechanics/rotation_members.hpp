// Members of class templates, for those who compile them.
#pragma once

#include "mechanics/rotation.hpp"

#include <cmath>

namespace gamut {

template <class S>
Rotation<S>::Rotation(const Axis& axis, const S& angle, int quarterTurns) {
  using std::cos, std::sin;
  S c = cos(angle), s = sin(angle);
  for (int i = 0; i < (quarterTurns % 4 + 4) % 4; ++i) {  // cos(β + π/2) = −sin β, sin(β + π/2) = cos β
    const S turned = -s;
    s = c;
    c = turned;
  }
  *this = Rotation(axis, std::move(c), std::move(s));
}

template <class S>
Rotation<S>::Rotation(const Axis& axis, S c, S s) {
  if (axis.isAligned()) {
    plane_ =
        Plane{(axis.index() + 1) % 3, (axis.index() + 2) % 3, std::move(c), axis.sign() < 0 ? S(-s) : std::move(s)};
    return;
  }
  // Rodrigues: A = c I + s [u]× + (1 − c) u uᵀ
  const Vector3<S> u = axis.unit<S>();
  const S rest = S(1.0) - c;
  dense_.emplace();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    (*dense_)(i, i) = c + rest * square(u[i]);
    (*dense_)(i, j) = rest * (u[i] * u[j]) - s * u[k];
    (*dense_)(j, i) = rest * (u[i] * u[j]) + s * u[k];
  }
}

template <class S>
Rotation<S>::Rotation(const Quaternion<S>& e) {
  const auto& [w, x, y, z] = e;
  const S one(1.0), two(2.0), xx = square(x), yy = square(y), zz = square(z);
  const S wx = w * x, wy = w * y, wz = w * z, xy = x * y, yz = y * z, zx = z * x;
  dense_.emplace();
  *dense_ << one - two * (yy + zz), two * (xy - wz), two * (zx + wy),  //
      two * (xy + wz), one - two * (zz + xx), two * (yz - wx),         //
      two * (zx - wy), two * (yz + wx), one - two * (xx + yy);
}

template <class S>
Vector3<S> Rotation<S>::toParent(const Vector3<S>& x) const {
  if (dense_) return *dense_ * x;
  Vector3<S> y = x;
  if (plane_) {
    y[plane_->i] = plane_->c * x[plane_->i] - plane_->s * x[plane_->j];
    y[plane_->j] = plane_->s * x[plane_->i] + plane_->c * x[plane_->j];
  }
  return y;
}

template <class S>
Vector3<S> Rotation<S>::toChild(const Vector3<S>& x) const {
  if (dense_) return dense_->transpose() * x;
  Vector3<S> y = x;
  if (plane_) {
    y[plane_->i] = plane_->c * x[plane_->i] + plane_->s * x[plane_->j];
    y[plane_->j] = plane_->c * x[plane_->j] - plane_->s * x[plane_->i];
  }
  return y;
}

template <class S>
Matrix3<S> Rotation<S>::matrixToParent(const Matrix3<S>& m) const {
  Matrix3<S> turned;
  for (int i = 0; i < 3; ++i) turned.row(i) = toParent(Vector3<S>(m.row(i).transpose())).transpose();
  for (int j = 0; j < 3; ++j) turned.col(j) = toParent(Vector3<S>(turned.col(j)));
  return turned;
}

template <class S>
Matrix3<S> Rotation<S>::symmetricToParent(const Matrix3<S>& m) const {
  if (!plane_) {
    Matrix3<S> turned = matrixToParent(m);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < i; ++j) turned(i, j) = turned(j, i);
    return turned;
  }
  const auto& [i, j, c, s] = *plane_;
  const int k = 3 - i - j;
  const S u = c * m(i, i) - s * m(i, j), v = c * m(i, j) - s * m(j, j), first = c * u - s * v;
  Matrix3<S> turned = m;
  turned(i, i) = first;
  turned(j, j) = isKnownZero(c) ? m(i, i) : S(m(i, i) + m(j, j) - first);  // a right angle swaps both
  turned(i, j) = turned(j, i) = s * u + c * v;
  turned(i, k) = turned(k, i) = c * m(i, k) - s * m(j, k);
  turned(j, k) = turned(k, j) = s * m(i, k) + c * m(j, k);
  return turned;
}

template <class S>
TurningAxes<S> Rotation<S>::toParent(const TurningAxes<S>& turning) const {
  TurningAxes<S> turned;
  for (int j = 0; j < 3; ++j) turned.axes.col(j) = toParent(Vector3<S>(turning.axes.col(j)));
  turned.omega = toParent(turning.omega);
  return turned;
}

template <class S>
SpatialInertia<S> Rotation<S>::toParent(SpatialInertia<S> inertia) const {
  if (dense_ && turns_.empty())
    return {symmetricToParent(inertia.angular), matrixToParent(inertia.coupling), symmetricToParent(inertia.linear)};
  if (plane_) turn(inertia, *plane_);
  for (auto plane = turns_.rbegin(); plane != turns_.rend(); ++plane) turn(inertia, *plane);
  return inertia;
}

template <class S>
Matrix3<S> Rotation<S>::after(const Matrix3<S>& r) const {
  Matrix3<S> product;
  for (int row = 0; row < 3; ++row) product.row(row) = toChild(r.row(row).transpose()).transpose();
  return product;
}

template <class S>
Rotation<S> Rotation<S>::then(const Rotation& next) const {
  if (!plane_ && !dense_) return next;
  if (!next.plane_ && !next.dense_) return *this;
  Rotation both;
  both.dense_ = next.after(matrix());
  if (isMadeOfTurns() && next.isMadeOfTurns()) {
    both.turns_ = turns();
    for (const Plane& plane : next.turns()) both.turns_.push_back(plane);
  }
  return both;
}

template <class S>
Matrix3<S> Rotation<S>::matrix() const {
  Matrix3<S> identity;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) identity(i, j) = S(i == j ? 1.0 : 0.0);
  return dense_ ? *dense_ : after(identity);
}

template <class S>
void Rotation<S>::turn(SpatialInertia<S>& inertia, const Plane& plane) {
  const auto& [i, j, c, s] = plane;
  const int k = 3 - i - j;
  const S squared = square(s), product = s * c;
  const auto turnPlane = [&, i = i, j = j](Matrix3<S>& m, const S& sum) {
    const S difference = m(i, i) - m(j, j);
    const S onDiagonal = squared * difference + product * sum, across = product * difference - squared * sum;
    m(i, i) = m(i, i) - onDiagonal;
    m(j, j) = m(j, j) + onDiagonal;
    m(i, j) = m(i, j) + across;
    m(j, i) = m(j, i) + across;
  };
  const auto turnPair = [&c = c, &s = s](S& x, S& y) {
    const S turned = c * x - s * y;
    y = s * x + c * y;
    x = turned;
  };
  for (Matrix3<S>* m : {&inertia.angular, &inertia.linear}) {
    turnPlane(*m, S(2.0) * (*m)(i, j));
    turnPair((*m)(i, k), (*m)(j, k));
    (*m)(k, i) = (*m)(i, k);
    (*m)(k, j) = (*m)(j, k);
  }
  Matrix3<S>& coupling = inertia.coupling;
  turnPlane(coupling, coupling(i, j) + coupling(j, i));
  turnPair(coupling(i, k), coupling(j, k));
  turnPair(coupling(k, i), coupling(k, j));
}

}  // namespace gamut
