// The joint distribution of quantities with a Gaussian copula: boxes of the independent normal numbers w that it is
// made of, with their probabilities. Over a box a sum of functions of these quantities is linear in w but for little,
// and the distribution of what is linear in independent numbers is found by convolution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "analyses/dependence.hpp"
#include "analyses/probability/binned_polynomial.hpp"
#include "analyses/probability/convolution.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// c Π η^power, of several symbols.
struct MixedTerm {
  double c = 0;
  std::vector<std::pair<std::size_t, std::size_t>> powers;  ///< which, and its power
};

class CopulaMasses {
 public:
  /// w[axis] lies between two nodes.
  struct Box {
    std::vector<std::uint16_t> from, until;
    double mass = 1;  ///< but for a relative error of a rounding an axis
  };

  /// Of those `rows` of the copula, rising; `below`: the distribution function of each at the edges of its bins.
  CopulaMasses(const GaussianCopula& copula, std::vector<std::size_t> rows,
               const std::vector<std::vector<Interval>>& below);

  /// Σ|error| of the probabilities of boxes is at most that.
  double error() const { return error_; }
  Box whole() const;
  /// In which bins the quantity of a row is, from the first to behind the last.
  std::pair<long, long> binsOf(const Box& box, std::size_t row) const;
  /// Halves of that w which moves this quantity most; false where there are none.
  bool halve(const Box& box, std::size_t row, Box& lower, Box& upper) const;

  /// f of each row, with tables, whose bins begin at `first`, and terms in several rows, all of η in [-1,1].
  struct Function {
    std::vector<BinnedPolynomial> f;
    std::vector<long> first;
    std::vector<MixedTerm> mixed;
  };
  /// Of such a function + rest, in multiples of a step, on those boxes. The error is that of roundings alone.
  GridSum sumOf(const std::vector<Box>& boxes, const Function& function, const Interval& rest, double step) const;

 private:
  friend class CopulaSum;
  struct Row {
    std::vector<double> root;             // middles
    double error = 0;                     // of root·w, at most
    std::vector<double> above, notAbove;  // [edge] the quantity is above it where z > above, not where z <= notAbove
  };
  /// What root·w of a row is on a box.
  std::pair<double, double> numbersOf(const Box& box, const Row& row) const;
  static std::pair<long, long> binsOf(const Row& row, double low, double high);
  void halve(const Box& box, std::size_t axis, std::pair<Box&, Box&> into) const;

  std::size_t axes_;
  std::vector<Row> rows_;
  double error_ = 0;
};

}  // namespace gamut
