// Eigenvalues λ_0 ≤ λ_1 ≤ … of a symmetric pencil at a root, K x = λ M x with K, M of v and p and R(v, p) = 0, for all
// parameters p in a box: each is the one of its number at every p, whether it meets others or not.
//
// M is positive definite, so K − σM has as many negative eigenvalues as there are λ below σ (J. J. Sylvester). Along
// the root K − σM changes with p_i by D_i = dK/dp_i − σ dM/dp_i. Where −B_i ⪯ D_i ⪯ A_i in the order of K. Löwner with
// B_i, A_i ⪰ 0 for all p of the box, then for a, the ends of which B_i or A_i is less, or any others,
//
//   K − σM ⪰ (K − σM)(a) − Σ w_i B_i (or A_i, from an upper end),   w_i the width of p_i,
//
// and likewise from above. Of stiffnesses and masses of one sign B_i or A_i is nothing, so that the bounds are the
// eigenvalues at two corners. Where M is not proved so to be positive definite, as of pendulums of uncertain lengths,
// it is by its pivots over the box, and the bounds are those of the pencil that they make of it, of which M is 1, on
// pieces.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class EigenvalueBounds {
 public:
  /// Where the root of thin parameters lies: what is left open of it.
  using Open = std::function<Box(const Box& parameters)>;

  /// `pencil`: of n states v and the parameters: R, then the lower triangles of K and M, row by row. `root`: v, of the
  /// parameters and of what is left `open`. `basis`: Φ, row by row: with ΦᵀMΦ near 1 and ΦᵀKΦ nearly diagonal in the
  /// middle of the box.
  EigenvalueBounds(const Program& pencil, const Program& root, const std::vector<double>& basis, const Box& parameters,
                   const Box& open, const Open& openAt);
  ~EigenvalueBounds();

  /// Of eigenvalues of so many numbers, which are above zero, over a part of the box; entire where nothing is proved.
  std::vector<Interval> ranges(const std::vector<int>& numbers, const Box& part) const;

  struct Beside {
    std::vector<Interval> off;     ///< λ − c(p)
    std::vector<Interval> ranges;  ///< λ
  };
  /// Of eigenvalues of so many numbers, whose `ranges` are known. `near`: of parameters, each c; `shapes`: x of each,
  /// whose vector is about Φx and whose component of its own number is 1.
  Beside beside(const Program& near, const Program& shapes, const std::vector<int>& numbers,
                const std::vector<Interval>& ranges) const;

  /// Eigenvalues of numbers from `first` to `last`, beside all others.
  struct Cluster {
    int first, last;
    int size() const { return last - first + 1; }
    friend bool operator==(const Cluster&, const Cluster&) = default;
  };
  /// What the eigenvectors Φ y of these span, for all parameters: the basis of it that is the identity in so many
  /// `references`, components of Φ y; row by row, all components. Nothing where it is not proved that they stay apart
  /// from all others and that there is such a basis, or once `cancelled`. `negatives`: how many eigenvalues are below
  /// zero.
  std::optional<std::vector<Interval>> basisOf(const Cluster& cluster, const std::vector<int>& references,
                                               int negatives, const std::atomic<bool>* cancelled = nullptr) const;

 private:
  struct Piece;
  struct Parts;
  Interval roomOf(const Cluster& cluster, const Box& part, int negatives) const;

  std::unique_ptr<const Parts> parts_;
};

}  // namespace gamut
