// Unknowns of a recorded linear system that can be eliminated without harm: those with an entry that is a number, never
// zero whatever the inputs are. Sparse systems lose what merely copies or adds.
#pragma once

#include <span>
#include <vector>

#include "scalars/recorded.hpp"

namespace gamut {

class LinearReduction {
 public:
  /// Eliminates from the matrix `entries` (row by row) as long as a pivot that is a number leaves no more entries than
  /// there were; afterwards it holds the rest in rows() and columns(), of as many elements.
  LinearReduction(int size, std::vector<Recorded>& entries);

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
