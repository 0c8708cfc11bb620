// What the highest grades of a flow's polynomials hold, and what would be left of it if a symbol were halved.
#pragma once

#include <vector>

#include "analyses/flow/series/monomials.hpp"

namespace gamut {

class Archive;

/// Sums over steps and states, each state in proportion to the most that it varies.
class TopGrades {
 public:
  /// Of a set after a step: n polynomials in `m`, of degree 2 at least, one behind the other.
  void add(const std::vector<double>& p, const Monomials& m);
  void join(const TopGrades& other);
  void archive(Archive& all);

  bool isEmpty() const { return variation_.empty(); }
  /// So many times less is in the two highest grades than in the two that are one lower; at least 1.
  double decay() const;
  /// So many times less would be in the two highest if ξ_l, halved so often already (once at most), were halved again:
  /// Σ|c_α| 2^-bα_l / Σ|c_α| 2^-(b+1)α_l; at least 1.
  double gainOfHalving(int symbol, int before) const;

 private:
  double total(const std::vector<double>& sums, std::size_t stride = 1, std::size_t offset = 0) const;

  std::vector<double> variation_, high_, low_;  // one a state
  std::vector<double> halved_, quartered_;      // what is left of high_, state by state, one a symbol
};

}  // namespace gamut
