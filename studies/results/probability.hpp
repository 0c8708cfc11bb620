// What is proved about the probability of the outputs' values, and whose doing their spread is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

/// Bounds of distribution functions, of all outputs but the requirements' margins, at some output times; of all joint
/// distributions that the quantities may have.
struct DistributionResult final : Part {
  double cpu = 0;             ///< s, sensitivities and all flows for both included
  double wanted = 0;          ///< gap that was aimed at
  double gap = 0;             ///< the greatest; 1 if some are not known at all
  double band = 0;            ///< half, of Dvoretzky, Kiefer and Wolfowitz at 95 %; 0: none holds
  std::vector<double> time;   ///< s: output times
  std::vector<double> point;  ///< 0, 1, ...: numbers of the values, as many as the longest list has
  Grid value;                 ///< time, output, point: rising, then NaN
  Grid lower, upper;          ///< likewise: of the probability that the output is not above the value
  Grid sampled;               ///< likewise: of the samples
  Grid gaps;                  ///< time, output; NaN where nothing is known
  Grid excess;                ///< time, output: by how much the samples' share leaves the bounds, at most

  /// Those of an output at a time.
  std::span<const double> values(std::size_t at, std::size_t output) const {
    const std::span<const double> all = value.row(at, output);
    return all.first(
        static_cast<std::size_t>(std::ranges::find_if(all, [](double x) { return std::isnan(x); }) - all.begin()));
  }

  std::string title() const override { return "probabilities"; }
  double spent() const override { return cpu; }
  std::string amount() const override;
  void describe(std::vector<Group>& groups) override;
};

/// Bounds of Sobol' indices, at more times, those of the distributions among them; those of a quantity that varies in
/// time are not known.
struct SensitivityResult final : Part {
  std::vector<double> time;    ///< s: output times
  BoundGrids mean, deviation;  ///< time, output
  BoundGrids first, total;     ///< time, output, quantity
  Grid pinched;                ///< time, output, quantity, at the times of distributions alone
  std::int64_t samples = 0;    ///< of the polynomials, from which indices are estimated besides
  Grid firstSampled, firstError, totalSampled, totalError;  ///< time, output, quantity

  std::string title() const override { return "sensitivities"; }
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
