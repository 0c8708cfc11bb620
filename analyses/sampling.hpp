// Where samples are put: plans of points in the unit cube (one axis an uncertain quantity), which the distributions'
// quantiles map to values. Beside the samples, which alone count in statistics, every plan has the corners of the box
// and the nominal centre: there extremes are often found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "analyses/uncertainty.hpp"

namespace gamut {

enum class Plan {
  sobol,           ///< low-discrepancy sequence of Sobol', randomly shifted; at most 40 quantities
  random,          ///< independent uniform points
  latinHypercube,  ///< one point in each of N strata of every axis
  halton,          ///< low-discrepancy sequence of Halton, randomly shifted; at most 1229 quantities
  grid,            ///< every combination of equally spaced values, both ends included
};

/// "sobol", "random", "latin-hypercube", "halton", "grid".
std::string_view nameOf(Plan plan);
/// Throws std::invalid_argument, naming the choices, for another name.
Plan planNamed(std::string_view name);

/// The points of one plan. Numbers 0 … samples()-1 are the samples, then follow the corners, the centre is last.
/// Which point a number has follows from the seed and the number (for a Latin hypercube and a grid also from the number
/// of samples), never from the number of jobs.
class Sampling {
 public:
  /// At least `samples` points (> 0) for so many quantities: exactly so many, except that a grid has c^quantities
  /// points, c >= 2 the least count an axis that gives enough, and that without quantities there is one sample and no
  /// corner. Throws std::invalid_argument where the plan cannot serve so many quantities.
  Sampling(Plan plan, std::size_t quantities, std::size_t samples, std::uint64_t seed);

  std::size_t quantities() const { return quantities_; }
  std::size_t samples() const { return samples_; }
  /// All 2^quantities for at most ten quantities, otherwise 1024: an orthogonal array, in which any two quantities
  /// meet in all four combinations of their ends equally often (up to 1023 quantities; up to 512 any three do).
  std::size_t corners() const { return corners_; }
  std::size_t centre() const { return samples_ + corners_; }
  std::size_t size() const { return samples_ + corners_ + 1; }

  /// Coordinates (0 … 1) of a sample or corner, one a quantity.
  std::vector<double> unitPoint(std::size_t number) const;
  /// Values of the quantities: quantiles for samples, ends of the ranges for corners, nominal values for the centre.
  std::vector<double> values(std::size_t number, const std::vector<Uncertain>& uncertain) const;

 private:
  bool isUpper(std::size_t corner, std::size_t quantity) const;

  std::size_t quantities_, samples_, corners_;
  std::vector<double> unit_;  // [sample][quantity]
};

}  // namespace gamut
