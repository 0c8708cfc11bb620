// What an acceleration of a frame costs: inertia about the frame's origin, and how it is seen from another point.
#pragma once

#include "mechanics/algebra.hpp"

namespace gamut {

/// [d]×, with [d]× x = d × x.
template <class S>
Matrix3<S> crossMatrix(const Vector3<S>& d) {
  Matrix3<S> m;
  m << S(0.0), -d[2], d[1], d[2], S(0.0), -d[0], -d[1], d[0], S(0.0);
  return m;
}

/// The moment τ = A ω̇ + B a and the force f = Bᵀ ω̇ + C a that an acceleration (ω̇, a) of a frame needs [kg m², kg m,
/// kg]; A and C are symmetric.
template <class S>
struct SpatialInertia {
  Matrix3<S> angular = zeroMatrix<S>(), coupling = zeroMatrix<S>(), linear = zeroMatrix<S>();

  /// About a point −d away: with D = [d]×, a becomes a − D ω̇ and τ becomes τ + D f, hence
  /// C' = C, B' = B + D C, A' = A − B D + D B'ᵀ.
  SpatialInertia shifted(const Vector3<S>& d) const {
    const Matrix3<S> cross = crossMatrix(d);
    SpatialInertia result = *this;
    result.coupling += cross * linear;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        result.angular(i, j) =
            angular(i, j) - coupling.row(i).dot(cross.col(j)) + cross.row(i).dot(result.coupling.row(j));
        result.angular(j, i) = result.angular(i, j);
      }
    return result;
  }

  SpatialInertia& operator+=(const SpatialInertia& other) {
    angular += other.angular;
    coupling += other.coupling;
    linear += other.linear;
    return *this;
  }
};

}  // namespace gamut
