// Rotations. One about a coordinate axis mixes two components only and is applied that way: exact zeros and ones never
// meet a multiplication, which is what keeps recorded programs small.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "mechanics/algebra.hpp"
#include "mechanics/axis.hpp"
#include "mechanics/quaternion.hpp"
#include "mechanics/spatial_inertia.hpp"
#include "scalars/traits.hpp"

namespace gamut {

template <class S>
auto Axis::unit() const {
  const std::array<Interval, 3> own = enclosure();
  Vector3<S> u;
  for (int i = 0; i < 3; ++i) u[i] = constant<S>(own[static_cast<std::size_t>(i)]);
  return u;
}

/// A rotation A from frame K to frame K': a vector with components x' in K' has components A x' in K.
template <class S>
class Rotation {
 public:
  /// No rotation.
  Rotation() = default;

  /// By `angle` [rad] about `axis`, plus `quarterTurns` exact right angles (so that 90° has exact zeros and ones).
  Rotation(const Axis& axis, const S& angle, int quarterTurns = 0) {
    using std::cos, std::sin;
    const S beta = axis.sign() < 0 ? S(-angle) : angle;
    const int turns = ((axis.sign() < 0 ? -(quarterTurns % 4) : quarterTurns % 4) + 4) % 4;
    S c = cos(beta), s = sin(beta);
    for (int i = 0; i < turns; ++i) {  // cos(β + π/2) = −sin β, sin(β + π/2) = cos β
      const S turned = -s;
      s = c;
      c = turned;
    }
    if (axis.isAligned()) {
      plane_ = Plane{(axis.index() + 1) % 3, (axis.index() + 2) % 3, c, s};
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

  /// Of a unit quaternion.
  explicit Rotation(const Quaternion<S>& e) {
    const auto& [w, x, y, z] = e;
    const S one(1.0), two(2.0), xx = square(x), yy = square(y), zz = square(z);
    const S wx = w * x, wy = w * y, wz = w * z, xy = x * y, yz = y * z, zx = z * x;
    dense_.emplace();
    *dense_ << one - two * (yy + zz), two * (xy - wz), two * (zx + wy),  //
        two * (xy + wz), one - two * (zz + xx), two * (yz - wx),         //
        two * (zx - wy), two * (yz + wx), one - two * (xx + yy);
  }

  /// A x'.
  Vector3<S> toParent(const Vector3<S>& x) const {
    if (dense_) return *dense_ * x;
    Vector3<S> y = x;
    if (plane_) {
      y[plane_->i] = plane_->c * x[plane_->i] - plane_->s * x[plane_->j];
      y[plane_->j] = plane_->s * x[plane_->i] + plane_->c * x[plane_->j];
    }
    return y;
  }

  /// Aᵀ x.
  Vector3<S> toChild(const Vector3<S>& x) const {
    if (dense_) return dense_->transpose() * x;
    Vector3<S> y = x;
    if (plane_) {
      y[plane_->i] = plane_->c * x[plane_->i] + plane_->s * x[plane_->j];
      y[plane_->j] = plane_->c * x[plane_->j] - plane_->s * x[plane_->i];
    }
    return y;
  }

  /// A M Aᵀ.
  Matrix3<S> matrixToParent(const Matrix3<S>& m) const {
    Matrix3<S> turned;
    for (int i = 0; i < 3; ++i) turned.row(i) = toParent(Vector3<S>(m.row(i).transpose())).transpose();
    for (int j = 0; j < 3; ++j) turned.col(j) = toParent(Vector3<S>(turned.col(j)));
    return turned;
  }

  /// The same for a symmetric M, which it stays; about a coordinate axis the trace of the turned part is kept.
  Matrix3<S> symmetricToParent(const Matrix3<S>& m) const {
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
    turned(j, j) = m(i, i) + m(j, j) - first;
    turned(i, j) = turned(j, i) = s * u + c * v;
    turned(i, k) = turned(k, i) = c * m(i, k) - s * m(j, k);
    turned(j, k) = turned(k, j) = s * m(i, k) + c * m(j, k);
    return turned;
  }

  /// What an inertia behind this rotation is in front of it: turn by turn, if it is made of turns about coordinate
  /// axes, which together take fewer operations than the whole.
  SpatialInertia<S> toParent(SpatialInertia<S> inertia) const {
    if (dense_ && turns_.empty())
      return {symmetricToParent(inertia.angular), matrixToParent(inertia.coupling), symmetricToParent(inertia.linear)};
    if (plane_) turn(inertia, *plane_);
    for (auto plane = turns_.rbegin(); plane != turns_.rend(); ++plane) turn(inertia, *plane);
    return inertia;
  }

  /// R A, the orientation behind a frame of orientation R: rows of R are vectors of K.
  Matrix3<S> after(const Matrix3<S>& r) const {
    Matrix3<S> product;
    for (int row = 0; row < 3; ++row) product.row(row) = toChild(r.row(row).transpose()).transpose();
    return product;
  }

  /// This rotation followed by `next`, which is given in the rotated frame.
  Rotation then(const Rotation& next) const {
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

  Matrix3<S> matrix() const {
    Matrix3<S> identity;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) identity(i, j) = S(i == j ? 1.0 : 0.0);
    return dense_ ? *dense_ : after(identity);
  }

 private:
  /// Rotation of the components i and j, which follow the axis cyclically.
  struct Plane {
    int i, j;
    S c, s;
  };
  bool isMadeOfTurns() const { return plane_ || !turns_.empty(); }
  std::vector<Plane> turns() const { return plane_ ? std::vector<Plane>{*plane_} : turns_; }

  /// A M Aᵀ for each part of the inertia. In the plane, M changes by multiples of (m_ii − m_jj, m_ij + m_ji) alone, so
  /// that its trace and m_ij − m_ji are kept.
  static void turn(SpatialInertia<S>& inertia, const Plane& plane) {
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

  std::optional<Plane> plane_;
  std::optional<Matrix3<S>> dense_;
  std::vector<Plane> turns_;  ///< that dense_ is made of, the first one first; none if it is not
};

}  // namespace gamut
