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
  /// Whether K is, to rounding, that of what lies and moves `about` there by next to nothing: no force has a kink.
  bool isSmooth(const NearRest& about) const;
  /// Of what K's entries i, j and j, i are sums of, about.
  double sizeOfStiffness(int i, int j) const;
  /// The motion along the loops: of G q = 0 so many coordinates as G has rows are solved for. Nothing where they cannot
  /// be for all values.
  std::optional<NearRest> reduced() const;
};

/// C = Σ c_k j_k j_kᵀ + R, c_k of loads that say so (mechanics/resisting.hpp), R of all others, and the
/// masses; for all of the intervals' values.
struct Resistances {
  int n = 0;  ///< coordinates
  std::vector<Interval> coefficients, masses, others;

  /// c_k, masses, R row by row, one after the other (RestEquations::resisting).
  static Resistances of(int coordinates, int resistances, int masses, const std::vector<Interval>& all);
  /// Whether all that makes up C is, to rounding, that of what lies and moves `about` there by next to nothing. Where
  /// much cancels in C itself, as of a damper that one coordinate does not move, its own rounding says nothing.
  bool isSmooth(const Resistances& about) const;
  /// None is negative.
  bool areMassesPositive() const;
  /// R acts on each coordinate by its own speed alone.
  bool isSymmetric() const;
  /// C + Cᵀ ≥ 0: by no c_k < 0, and by the pivots of R.
  bool takesEnergy() const;
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

/// Of a motion whose M and K are as above, along loops or not, since along them j_k is Zᵀ j_k:
///
///   no negative eigenvalue and C + Cᵀ ≥ 0: stable, for ½ (q̇ᵀ M q̇ + qᵀ K q) falls or stays;
///   some, and C = Cᵀ: unstable, for the least eigenvalue of s² M + s C + K is negative at s = 0 and not as s → ∞, so
///   it is zero at an s > 0 (Lord Kelvin & P. G. Tait, 1879; any c_k).
///
/// No interval of C's entries could tell the first where it has an eigenvalue 0, as a damper between two masses has.
RestStability stabilityOf(const Resistances& of, int negatives);

/// How many eigenvalues of a symmetric matrix, n by n and row by row, are below zero: with T near to its eigenvectors
/// Tᵀ K T has as many (J. J. Sylvester), and those of its discs (S. Gershgorin) that lie below zero count them. Nothing
/// where a disc holds zero, or where the matrix is certainly not symmetric.
std::optional<int> negativeEigenvalues(const std::vector<Interval>& matrix, int n);

}  // namespace gamut
