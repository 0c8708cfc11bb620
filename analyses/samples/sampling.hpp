// Where samples are put: plans of points in the unit cube (one axis an uncertain quantity), which the distributions'
// quantiles map to values. Beside the samples, which alone count in statistics, every plan has the corners of the box,
// the corners of boxes inside it and the nominal centre, and it may have points of a transformation: there extremes are
// often found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "analyses/dependence.hpp"
#include "analyses/samples/transformation.hpp"
#include "analyses/uncertainty.hpp"

namespace gamut {

enum class Plan {
  sobol,           ///< low-discrepancy sequences of Sobol', scrambled
  random,          ///< independent uniform points
  latinHypercube,  ///< one point of each batch in each of its strata of every axis
  halton,          ///< low-discrepancy sequences of Halton, scrambled
  grid,            ///< every combination of equally spaced values, both ends included
};

/// "sobol", "random", "latin-hypercube", "halton", "grid".
std::string_view nameOf(Plan plan);
/// Throws std::invalid_argument, naming the choices, for another name.
Plan planNamed(std::string_view name);

/// Uncertain quantities that a plan serves at most: 3667 of Sobol's, 1229 of Halton's; the greatest number of all
/// others, though a grid's points soon are too many.
std::size_t mostQuantities(Plan plan);

/// Whether the first of more samples are where those of fewer are.
bool keepsFirstPoints(Plan plan);

/// The points of a plan's samples, one after the other.
class PointSequence {
 public:
  virtual ~PointSequence() = default;
  /// Coordinates (0 … 1) of the next sample, one a quantity.
  virtual void next(std::span<double> point) = 0;
};

/// Samples whose numbers leave the same rest are a batch, independent of the others: how these differ says how far off
/// they are together (A. B. Owen, Monte Carlo theory, methods and examples, section 17.3).
inline constexpr std::size_t batchCount = 16;

/// Corners of all inner boxes together, at most.
inline constexpr std::size_t mostBoxCorners = 1024;

/// The points of one plan; none is kept. Numbers 0 … samples()-1 are the samples, then follow the corners, then the
/// corners of the inner boxes, the centre, and what is added besides. Which point a number has follows from the seed
/// and the number (for a Latin hypercube and a grid also from the number of samples), never from the number of jobs.
class Sampling {
 public:
  /// At least `samples` points (> 0) for so many quantities: exactly so many, except that a grid has c^quantities
  /// points, c >= 2 the least count an axis that gives enough, that of the other plans but the random one 32 points or
  /// more are a multiple of 16, in batches of equal size that are randomised each by itself, and that without
  /// quantities there is one sample and no corner. `boxes`: one interval a quantity each. Throws std::invalid_argument
  /// where the plan cannot serve so many quantities.
  Sampling(Plan plan, std::size_t quantities, std::size_t samples, std::uint64_t seed, std::vector<Box> boxes = {});

  /// The samples' values, not those of corners, depend on each other so. The points in the unit cube do not.
  void correlate(std::vector<GaussianCopula> copulas) { copulas_ = std::move(copulas); }

  std::size_t quantities() const { return quantities_; }
  std::size_t samples() const { return samples_; }
  /// All 2^quantities for at most ten quantities, otherwise 1024: an orthogonal array, in which any two quantities
  /// meet in all four combinations of their ends equally often (up to 1023 quantities; up to 512 any three do).
  std::size_t corners() const { return ends_.count(); }
  /// Of all inner boxes together. Of each as many, 2^bits, as make no more than 1024 of all, but at least two: all of
  /// them for six quantities and sixteen boxes; for more an orthogonal array as above (up to 2^bits - 1 quantities).
  std::size_t boxCorners() const { return boxes_.size() * boxEnds_.count(); }
  const std::vector<Box>& boxes() const { return boxes_; }
  std::size_t centre() const { return samples_ + corners() + boxCorners(); }
  /// Of all transformations that were added.
  std::size_t points() const { return size() - centre() - 1; }
  std::size_t size() const { return zones_.back(); }

  /// Points that follow all others.
  void add(TransformationPoints points);

  /// Numbers begin … end - 1 of one kind.
  struct Zone {
    std::size_t begin, end;
  };
  /// The samples, the corners with the centre, or points that were added together: that which `number` is of.
  Zone zoneOf(std::size_t number) const;

  /// Coordinates (0 … 1) of a sample or corner (of its box), one a quantity. Quick where the numbers rise; to go back
  /// takes as long as to come from 0.
  void unitPoint(std::size_t number, std::span<double> point);
  std::vector<double> unitPoint(std::size_t number);
  /// Makes coordinates into values of the quantities: quantiles for samples, ends of the ranges or boxes for corners;
  /// whatever the coordinates, nominal values for the centre, and values of their own for points that were added.
  void toValues(std::size_t number, const std::vector<Uncertain>& uncertain, std::span<double> point) const;
  std::vector<double> values(std::size_t number, const std::vector<Uncertain>& uncertain);

 private:
  Plan plan_;
  std::size_t quantities_, samples_, batches_ = 1;
  std::uint64_t seed_;
  std::vector<Box> boxes_;
  std::vector<GaussianCopula> copulas_;
  Ends ends_, boxEnds_;
  std::vector<TransformationPoints> added_;
  std::vector<std::size_t> zones_;  // ends
  std::unique_ptr<PointSequence> sequence_;
  std::size_t position_ = 0;  // number of the sequence's next point
};

}  // namespace gamut
