// Whether a mechanism stays near to where it rests.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scalars/interval.hpp"

namespace gamut {

/// What moves near rest: M q̈ + C q̇ + K q = 0, of coordinates that loops hold by G q = 0; for all of the intervals'
/// values, row by row.
struct NearRest {
  static constexpr double rounding = 1e-7;  ///< what is more, of what there is, is no rounding

  int n = 0;  ///< coordinates
  std::vector<Interval> stiffness, damping, mass, held;

  /// K, C, M and G one after the other (RestEquations::nearRest).
  static NearRest of(int coordinates, const std::vector<Interval>& matrices);
  /// Whether K, at one value, is symmetric to what is left of it by rounding, as that of forces with a potential.
  bool hasPotential() const;
  /// Whether K and C are, to rounding, those of what lies and moves `about` there by next to nothing: no force has a
  /// kink.
  bool isSmooth(const NearRest& about) const;
  /// Of what K's entries i, j and j, i are sums of, about.
  double sizeOfStiffness(int i, int j) const;
  /// The motion along the loops: of G q = 0 so many coordinates as G has rows are solved for. Nothing where they cannot
  /// be for all values.
  std::optional<NearRest> reduced() const;
};

enum class RestStability { unstable = -1, unknown = 0, stable = 1 };

/// Of a reduced motion whose mass is positive and whose K, symmetric as that of forces with a potential, has so many
/// negative eigenvalues at every value. Without C:
///
///   stable where K has none (J. L. Lagrange, P. G. L. Dirichlet), else unstable;
///
/// with C + Cᵀ = 2 D:
///
///   D ≥ 0 and none: stable;   D > 0 and some: unstable (N. G. Chetaev, The Stability of Motion, 1961);
///   an odd number: unstable, for det(s² M + s C + K) changes its sign at an s > 0;
///   tr M⁻¹ C < 0: unstable, for all real parts together are −tr M⁻¹ C;
///   else with X = Xᵀ for which Pᵀ X Q + Qᵀ X P < 0, P ẏ = Q y the motion of y = [q; q̇]: as many eigenvalues have real
///   parts above 0 as X has below (A. Ostrowski & H. Schneider, J. Math. Anal. Appl. 4, 1962), and none is on the axis.
RestStability stabilityOf(const NearRest& reduced, int negatives);

/// How many eigenvalues of a symmetric matrix, n by n and row by row, are below zero: with T near to its eigenvectors
/// Tᵀ K T has as many (J. J. Sylvester), and those of its discs (S. Gershgorin) that lie below zero count them. Nothing
/// where a disc holds zero, or where the matrix is certainly not symmetric.
std::optional<int> negativeEigenvalues(const std::vector<Interval>& matrix, int n);

}  // namespace gamut
