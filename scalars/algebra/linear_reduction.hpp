// Unknowns of a recorded linear system that can be eliminated without harm: those with an entry that is a number, never
// zero whatever the inputs are. Sparse systems lose what merely copies or adds.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "scalars/recorded.hpp"

namespace gamut {

class LinearReduction {
 public:
  /// A square matrix: of each row the entries by their columns; others are zero.
  using Rows = std::vector<std::map<int, Recorded>>;

  /// Eliminates from the matrix as long as a pivot that is a number leaves no more entries than there were; afterwards
  /// it holds the rest in rows() and columns(), of as many elements. The time that this takes grows with the entries
  /// that there are, not with all that there could be.
  explicit LinearReduction(Rows& matrix);

  const std::vector<int>& rows() const { return rows_; }
  const std::vector<int>& columns() const { return columns_; }

  /// Right-hand sides r become those of the rest.
  void reduce(std::span<Recorded> r) const;
  /// The eliminated unknowns, from the reduced right-hand sides and the unknowns of the rest in x.
  void complete(std::span<const Recorded> r, std::span<Recorded> x) const;

 private:
  struct Term {
    int index;
    Recorded value;
  };
  struct Step {
    int row, column;
    Recorded inverse;
    std::vector<Term> lower, upper;
  };
  std::vector<int> rows_, columns_;
  std::vector<Step> steps_;
};

}  // namespace gamut
