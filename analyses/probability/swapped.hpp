// Independent summands that are replaced by numbers on a grid with the same means: what that does to the sum is of
// second order, as long as two others among them are left as they are. For e with |E e| <= μ and E e² <= s², which in
// each of a summand's bins does not depend on R,
//
//   |P(R + e <= x) - P(R <= x)| <= μ sup f_R + ½ s² sup |f_R'|,
//
// and where R holds Y of a density of at most M, and Z of one that varies by V in all, f_R is at most M and
// |f_R(x) - f_R(x')| <= M ∫|f_Z(y + x - x') - f_Z(y)| dy <= M V |x - x'|, whatever else it holds. Of these two every
// bin is then taken for one of even density, and cut into parts as small as a step: |P(Y + Z <= x) - P(Y + Z' <= x)| is
// the mean of |F_Z - F_Z'| at x - Y.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "analyses/probability/binned_polynomial.hpp"
#include "analyses/probability/convolution.hpp"
#include "analyses/uncertainty.hpp"

namespace gamut {

/// f(η) of a symbol on a part: bins of [-1,1] with their masses, off by `error` in all, and by how much |∫ (η - middle)
/// dF| over them is more than nothing, in halves of their width (`leansOf`; the error in this is `error` likewise).
struct Summand {
  const std::vector<double>& f;  ///< [power]
  const double *mass, *lean;
  long bins;
  double error;
  Distribution::DensityBound density;  ///< of η
};

/// What it does to a sum if it is replaced, and what it does for it if it is not.
class Swapped {
 public:
  Swapped(const Summand& summand, double step);

  /// The probability of the part, at most.
  double all() const { return all_; }
  double variance() const { return variance_; }
  double bin() const { return bin_; }        ///< its width, as values of f, at most
  double mean() const { return mean_; }      ///< μ, of values in the part
  double square() const { return square_; }  ///< s²
  Distribution::DensityBound density() const { return density_; }
  /// Of bins of even density: how dense that is, and by how much the distribution function is off in any but some bins;
  /// and the probability of these.
  double evenDensity() const { return even_; }
  double sag() const { return sag_; }
  double sagging() const { return sagging_; }

 private:
  double all_ = 0, variance_ = 0, bin_ = 0, mean_ = 0, square_ = 0, even_ = 0, sag_ = 0, sagging_ = 0;
  Distribution::DensityBound density_;
};

/// Whether the polynomial rises or falls all over [-1,1], as its coefficients tell: else no density is known of it.
bool isSteep(const std::vector<double>& f);

/// Each bin's mass on the two multiples of the step beside f at its middle, such that this is their mean.
GridMasses onGrid(const Summand& summand, double step);

/// By how much the sum's distribution function is off where all but two are replaced, over the probability of all.
/// Infinite where no density of theirs is known.
double shiftOf(const std::vector<Swapped>& summands, std::size_t first, std::size_t second);

/// The two that are best not replaced, if bounds of the sum are closer so than those of bins, and by how much its
/// distribution function is off then, if all that it holds has such a probability.
struct Unswapped {
  std::size_t first = 0, second = 0;
  double off = 0;
};
std::optional<Unswapped> unswapped(const std::vector<Swapped>& summands, double step, double all);

}  // namespace gamut
