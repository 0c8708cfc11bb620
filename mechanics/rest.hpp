// A mechanism at rest, and how it vibrates about there, as functions of its free parameters.
//
// With v = [q; z; λ], coordinates, own states and multipliers of loops, and the rows of motion R(v, v̇, v̈)
// (Assembly::rowsOfMotion), rest is R(v, 0, 0) = 0. What is near to it moves as v + φ e^(st) with
//
//   (F_0 + s F_1 + s² F_2) φ = 0,   F_0 = ∂R/∂v, F_1 = ∂R/∂v̇, F_2 = ∂R/∂v̈ at rest
//
// (F. Tisseur & K. Meerbergen, The quadratic eigenvalue
// problem, SIAM Review 43, 2001). A pair s = −ζω ± iω√(1−ζ²) is a mode: frequency ω/2π, damping ratio ζ. Position and
// modes are roots of equations that hold the parameters: families (analyses/roots), each about a centre that Newton's
// steps from the nominal root write down. Where nothing damps, a mode is a real φ with its ω²; two of which the
// frequencies may meet within the box are an invariant subspace X with F_0 X = F_2 X Λ, and roots of Λ.
#pragma once

#include <complex>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

/// Where a mechanism without own states rests, f(q) + G(q)ᵀ λ = 0 and g(q) = 0 of its coordinates and the multipliers
/// of its loops, that may be any: with λ = Λ μ/μ0, μ0 > 0,
///
///   μ0 f + Λ Gᵀ μ = 0,   g = 0,   μ0² + |μ|² = 1.
struct RestEquations {
  Program roots;      ///< these, of q and, where there are loops, μ0 and μ, and of the free parameters
  Program stiffness;  ///< of the same: K = −∂(f + Gᵀ λ)/∂q, bordered by G, symmetric and row by row
  Box multipliers;    ///< which holds all (μ0, μ)
};

/// Throws UnfitPart as Rest does.
RestEquations restEquations(const Mechanism& mechanism, const std::vector<std::string>& freeParameters);

/// How many eigenvalues of a symmetric matrix, n by n and row by row, are below zero: with T near to its eigenvectors
/// Tᵀ K T has as many (J. J. Sylvester), and those of its discs (S. Gershgorin) that lie below zero count them. Nothing
/// where a disc holds zero, or where the matrix is certainly not symmetric.
std::optional<int> negativeEigenvalues(const std::vector<Interval>& matrix, int n);

class Rest {
 public:
  /// Of a program of parameters one that comes near to it over their box, and is simpler to bound.
  using Approximation = std::function<Program(const Program&)>;

  /// The rest that the mechanism comes to from its initial position as if through honey; `parameters`: the box of the
  /// free ones, `modes`: those that are wanted, 1 the slowest. Throws UnfitPart where there is none, where it is not
  /// one position, and where coordinates do not say it all (balls, free frames, rolling, rigid ends, what moves in
  /// time).
  Rest(const Mechanism& mechanism, const std::vector<std::string>& freeParameters, const Box& parameters,
       const std::set<int>& modes, const Approximation& approximated);

  /// Newton's maps of position and modes, of what each leaves open as states. Parameters: those of the mechanism; of
  /// modes what the position leaves open besides.
  const std::vector<Program>& families() const { return families_; }
  /// How much all families leave open.
  int remainders() const;

  struct Found {
    std::vector<Recorded> state;                 ///< x = [q; u; z], in the order of Mechanism::stateNames()
    std::map<std::string, Recorded> known;       ///< frequency.1 [Hz], damping.1 …, of wanted modes
    std::map<std::string, std::string> unknown;  ///< of those that have none: why
  };
  /// While recording: at these remainders and parameters.
  Found at(std::span<const Recorded> remainders, std::span<const Recorded> parameters) const;
  /// Likewise, by Newton's steps from the centres, that leave open no more than their rounding: as samples go.
  Found at(std::span<const Recorded> parameters) const;

  /// Of the nominal values, in doubles: s of all modes and of what does not oscillate.
  const std::vector<std::complex<double>>& eigenvalues() const { return eigenvalues_; }

 private:
  /// Of so many rows: R, and F_0, F_1, F_2 row by row.
  template <class S>
  struct Linear {
    int size;
    std::vector<S> rows, byPosition, byRate, byAcceleration;
  };
  /// Modes that are found together, from their nominal values.
  struct Block {
    std::vector<int> modes;
    bool isDamped;
    std::vector<double> nominal;  ///< X column by column, then Λ row by row; damped: Re φ, Im φ, Re s, Im s
    std::vector<double> dual;     ///< C, row by row: C X = 1; damped: Re c, Im c
    std::vector<double> unit;     ///< of what is left open of each: about as large as they are
  };

  template <class S>
  Linear<S> linearAt(const std::vector<S>& v, std::span<const S> parameters) const;
  std::vector<double> settled(std::vector<double> v, std::span<const double> parameters) const;
  std::vector<double> rooted(std::vector<double> v, std::span<const double> parameters) const;
  bool hasPotential(const Box& parameters) const;
  void refuseLoose(const Linear<double>& at) const;
  std::vector<std::complex<double>> eigenvaluesOf(const Linear<double>& at) const;
  void takeModes(const Box& parameters, const std::set<int>& modes);
  std::vector<std::vector<int>> blocksOf(const Box& parameters, const std::set<int>& modes) const;
  Block undampedBlock(const Linear<double>& at, std::vector<int> modes) const;
  Block dampedBlock(const Linear<double>& at, int mode) const;
  void refine(Block& block, const Linear<double>& at) const;

  template <class S>
  static std::vector<S> rowsOf(const Block& block, const Linear<S>& at, std::span<const S> w);
  template <class S>
  static std::vector<S> slopesOf(const Block& block, const Linear<S>& at, std::span<const S> w);
  std::vector<Recorded> rooted(std::vector<Recorded> v, std::span<const Recorded> parameters) const;
  std::vector<Recorded> rooted(const Block& block, std::vector<Recorded> w, const Linear<Recorded>& at) const;
  std::vector<Recorded> positionAt(std::span<const Recorded> parameters) const;
  Found foundAt(const std::vector<Recorded>& v, const std::vector<std::vector<Recorded>>& modes,
                std::span<const Recorded> parameters) const;
  void tell(const Block& block, const std::vector<Recorded>& w, const Linear<Recorded>& at, Found& found) const;

  std::vector<std::string> names_;  // of coordinates, then of own states
  int coordinates_ = 0, ownStates_ = 0, speeds_ = 0, parameters_ = 0, size_ = 0;
  std::vector<bool> turns_;
  Program linear_;                      // R with its Jacobian, of v, v̇, v̈
  std::vector<double> nominal_, unit_;  // of the latter is what is left open of v
  bool isDamped_ = false, dependsOnParameters_ = false;
  std::vector<std::complex<double>> eigenvalues_, modes_;
  std::vector<Block> blocks_;
  std::vector<Program> centres_, families_;
};

}  // namespace gamut
