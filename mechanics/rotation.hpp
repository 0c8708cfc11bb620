// Rotations. One about a coordinate axis mixes two components only and is applied that way: exact zeros and ones never
// meet a multiplication, which is what keeps recorded programs small.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "mechanics/algebra.hpp"
#include "mechanics/axis.hpp"
#include "mechanics/frame.hpp"
#include "mechanics/quaternion.hpp"
#include "mechanics/spatial_inertia.hpp"
#include "scalars/traits.hpp"

namespace gamut {

template <class S>
auto Axis::unit() const {
  const std::array<Interval, 3> own = enclosure();
  Vector3<S> u;
  for (int i = 0; i < 3; ++i) u[i] = constant<S>(own[i]);
  return u;
}

/// A rotation A from frame K to frame K': a vector with components x' in K' has components A x' in K.
template <class S>
class Rotation {
 public:
  /// No rotation.
  Rotation() = default;

  /// By `angle` [rad] about `axis`, plus `quarterTurns` exact right angles (so that 90° has exact zeros and ones).
  Rotation(const Axis& axis, const S& angle, int quarterTurns = 0);

  /// By the angle of this cosine and sine.
  Rotation(const Axis& axis, S cosine, S sine);

  /// Of a unit quaternion.
  explicit Rotation(const Quaternion<S>& e);

  /// A x'.
  Vector3<S> toParent(const Vector3<S>& x) const;

  /// Aᵀ x.
  Vector3<S> toChild(const Vector3<S>& x) const;

  /// A M Aᵀ.
  Matrix3<S> matrixToParent(const Matrix3<S>& m) const;

  /// The same for a symmetric M, which it stays; about a coordinate axis the trace of the turned part is kept.
  Matrix3<S> symmetricToParent(const Matrix3<S>& m) const;

  /// Column by column.
  TurningAxes<S> toParent(const TurningAxes<S>& turning) const;

  /// What an inertia behind this rotation is in front of it: turn by turn, if it is made of turns about coordinate
  /// axes, which together take fewer operations than the whole.
  SpatialInertia<S> toParent(SpatialInertia<S> inertia) const;

  /// R A, the orientation behind a frame of orientation R: rows of R are vectors of K.
  Matrix3<S> after(const Matrix3<S>& r) const;

  /// This rotation followed by `next`, which is given in the rotated frame.
  Rotation then(const Rotation& next) const;

  Matrix3<S> matrix() const;

  /// Whether it was made as no rotation.
  bool isNone() const { return !plane_ && !dense_; }

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
  static void turn(SpatialInertia<S>& inertia, const Plane& plane);

  std::optional<Plane> plane_;
  std::optional<Matrix3<S>> dense_;
  std::vector<Plane> turns_;  ///< that dense_ is made of, the first one first; none if it is not
};

GAMUT_COMPILED_ELSEWHERE(Rotation)

}  // namespace gamut
