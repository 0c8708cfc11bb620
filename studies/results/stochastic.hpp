// What is probable.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analyses/table.hpp"
#include "studies/results/part.hpp"

namespace gamut {

/// Samples one by one: values of the uncertain quantities, and motions. Numbers as in DisputedSample.
struct KeptSamples {
  bool present = false;
  double storage = 0;             ///< bytes that they may take
  std::int64_t valuesEvery = 1;   ///< values are of the samples whose number it divides, and the centre; 0: of none
  std::int64_t motionsEvery = 1;  ///< motions likewise; a multiple of the other
  std::vector<std::int64_t> number;
  std::vector<double> values;  ///< [number][quantity]
  std::vector<std::int64_t> motionNumber;
  std::vector<double> motions;  ///< [motionNumber][time][output], NaN where a sample did not arrive

  /// Of how many: "values of all, motions of one in 18".
  std::string text() const;
};

/// Where the enclosure's polynomials tell that outputs are extreme, as far as other samples do not come near.
struct ExtremeSamples {
  bool present = false;              ///< there are any
  std::vector<std::int64_t> number;  ///< as in DisputedSample
  std::vector<double> values;        ///< [number][quantity]
};

/// Courses that switch from value to value, of the samples among the extremes that have such: one entry a value of one
/// quantity, by sample, then quantity, then time.
struct SwitchingResult {
  bool present = false;  ///< there are any
  std::vector<std::int64_t> entry;
  std::vector<std::int64_t> number;    ///< of the sample, as in DisputedSample
  std::vector<std::int64_t> quantity;  ///< that varies in time
  std::vector<double> from, value;     ///< s, and in SI units of the quantity
};

/// One that could not be followed to the horizon.
struct FailedSampleResult {
  std::int64_t number = 0;  ///< as in DisputedSample
  double reached = 0;       ///< s
  std::string why;
};

/// What the first of the plan's samples said already, by how many they are; of every output averages over time.
struct ConvergenceResult {
  bool present = false;
  std::vector<std::int64_t> samples;  ///< rising
  std::vector<double> spanned;        ///< [samples][output]: share of the envelope of all
  std::vector<double> meanError;      ///< [samples][output]: half the 95 % interval, in standard deviations
};

/// How samples were placed: a Plan (analyses/samples/sampling.hpp), in its words.
enum class Placement : unsigned char { sobol, random, latinHypercube, halton, grid };
template <>
inline constexpr std::array<std::string_view, 5> words<Placement>{"sobol", "random", "latin-hypercube", "halton",
                                                                  "grid"};

/// Its `reached`: all samples that were followed arrived there; envelope and statistics end there.
struct StochasticResult final : Answer {
  static constexpr std::string_view name = "stochastic";
  /// The plan's samples, the corners, the centre, the points of the transformation and the extremes.
  std::int64_t planned() const { return firstExtreme() + static_cast<std::int64_t>(extremes.number.size()); }
  std::int64_t firstExtreme() const { return centre() + 1 + alphaPoints; }
  std::int64_t centre() const { return samples + corners + alphaCorners; }

  /// "sample 17", "corner 3", "corner 3 of the alpha-cuts", "the centre", "point 3 of the alpha-cuts", "extreme 3", as
  /// `gamut replay` knows it: the plan's samples come first, then the corners of the box, those of the alpha-cuts, the
  /// centre, the points of the transformation, and the extremes.
  std::string nameOf(std::int64_t number) const;

  Placement plan = Placement::sobol;
  std::int64_t samples = 0;       ///< that count in the statistics
  std::int64_t corners = 0;       ///< of the uncertain box, integrated besides, without weight
  std::int64_t alphaCorners = 0;  ///< of the alpha-cuts' boxes, likewise
  std::int64_t alphaPoints = 0;   ///< of the transformation, likewise
  std::int64_t integrated = 0;    ///< how many of all these and the centre were followed before the analysis ended
  double relativeTolerance = 0, absoluteTolerance = 0;
  std::int64_t packWidth = 1;              ///< samples of one number / packWidth were integrated together
  std::int64_t failures = 0;               ///< of all these and the centre that were not followed to the horizon
  std::vector<FailedSampleResult> failed;  ///< the first thousand of them
  Envelope envelope;                       ///< of all samples, weight or none
  // Errors and bounds of 95 % confidence, each number by itself; NaN where none holds.
  Table mean, meanError, deviation, deviationError;  ///< errors: half the width of the interval
  std::vector<double> probabilities;                 ///< of the quantiles
  std::vector<Table> quantiles;                      ///< one table a probability
  std::vector<Table> quantileLower, quantileUpper;   ///< likewise: between which the quantiles of all motions lie
  double covered = 0;  ///< share of all motions that lies in the envelope, with 95 % confidence; 0: none holds
  ConvergenceResult convergence;
  Table resolution;         ///< no quantile is farther than this from that of the samples themselves
  Table error;              ///< the witness's own error, measured at tighter tolerance
  ExtremeSamples extremes;  ///< likewise sampled besides, those on switching courses the last of them
  SwitchingResult switching;
  KeptSamples kept;

  std::string_view word() const override { return name; }
  std::string title() const override;
  std::string amount() const override;
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
