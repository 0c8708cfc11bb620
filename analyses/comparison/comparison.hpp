// How the guaranteed and the probable agree: every sample must lie inside the enclosure at every output time. A sample
// found outside is integrated again by Taylor series, in doubles and at last by the arbiter; what then still lies
// outside by more than its own measured error refutes the enclosure. Samples of the same values are looked at once. The
// arbiter takes the worst first and stops after sixteen of which one refutes. How wide the enclosure is against the
// envelope of the samples, its overestimation, is measured only where the envelope stands clear of the witness's error.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "analyses/comparison/unmoved.hpp"
#include "analyses/samples/ensemble.hpp"

namespace gamut {

/// Some samples with their trajectories.
struct Ensemble {
  std::vector<double> times;  ///< s
  std::size_t outputs = 0, quantities = 0;
  std::vector<double> values;  ///< of the uncertain quantities: [sample][quantity]
  std::vector<double> data;    ///< [sample][time][output]; NaN where a sample did not arrive

  std::size_t size() const { return data.size() / (times.size() * outputs); }
  /// One sample's trajectory: [time][output].
  std::span<double> trajectory(std::size_t sample) {
    return std::span(data).subspan(sample * times.size() * outputs, times.size() * outputs);
  }
  std::span<const double> trajectory(std::size_t sample) const {
    return std::span(data).subspan(sample * times.size() * outputs, times.size() * outputs);
  }
  std::span<const double> valuesOf(std::size_t sample) const {
    return std::span(values).subspan(sample * quantities, quantities);
  }
};

/// Samples that are compared, wherever they are kept. Several threads may ask for different ones at once.
class ComparedSamples {
 public:
  ComparedSamples() = default;
  ComparedSamples(const ComparedSamples&) = delete;
  ComparedSamples& operator=(const ComparedSamples&) = delete;
  virtual ~ComparedSamples() = default;
  virtual std::size_t size() const = 0;
  virtual std::span<const double> valuesOf(std::size_t sample) const = 0;
  /// Copies: of many outputs those of all samples at once would be as much as the samples themselves.
  virtual std::vector<double> trajectory(std::size_t sample) const = 0;
  virtual void setTrajectory(std::size_t sample, std::span<const double> trajectory) = 0;
};

/// What an enclosure claims at the ensemble's output times.
struct EnclosureBounds {
  Envelope bounds;               ///< lower and upper bounds; the rows of the reached times count
  std::size_t reachedTimes = 0;  ///< number of output times up to which it is proved
};

struct ComparisonOptions {
  double decisive = 10;     ///< a sample further outside than so many times its measured error refutes the enclosure
  bool asksArbiter = true;  ///< where it is already known that the enclosure is refuted, that can be saved
  const KnownOutputs* known = nullptr;  ///< what outputs are, whatever the sample
  int jobs = 1;                         ///< threads
  std::function<void(double)>
      progress;  ///< called with the fraction of the arbiter's work that is done, from any thread
  const std::atomic<bool>* cancelled = nullptr;  ///< set from outside to end early; disputes left are "interrupted"
};

/// A sample that was found outside and looked at again.
struct Dispute {
  std::size_t number = 0;  ///< of the sample; those without weight follow the others
  std::size_t time = 0;    ///< index of the output time of its greatest excursion (at first, if none remained)
  std::size_t output = 0;  ///< index of the output
  double value = 0, lower = 0, upper = 0;
  double distance = 0;   ///< outside, after the last integration
  double error = 0;      ///< this sample's measured error there: the greatest change so far by the last
                         ///< integration, at least 4 ulp of the output's magnitude; infinite if none came so far
  double excursion = 0;  ///< distance / error
  std::string decided;   ///< by what: "Taylor 53 bits", "Taylor 128 bits"; "rounding": outside by no more than that
                         ///< floor, after worse ones were found inside; "unresolved", or "interrupted" before that
  bool outside = false;  ///< it refutes the enclosure
  std::vector<double> farthest;  ///< one an output: how far it lies outside at most, after the last integration
};

struct Comparison {
  double excursion = 0;           ///< the greatest of all disputes
  std::vector<Dispute> disputes;  ///< by rising number
};

/// How wide an enclosure is against an envelope.
struct Overestimation {
  Table ratio;  ///< enclosure width over envelope width; NaN where the envelope is too narrow to tell, or
  /// the enclosure infinite
  Table excess;                                               ///< enclosure width minus envelope width
  double maximum = std::numeric_limits<double>::quiet_NaN();  ///< of the ratios
  double median = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> maximumOf;  ///< one an output
};

/// Against the envelope of samples whose integration has this error, and 4 ulp of an output's magnitude at least: one
/// narrower than a hundred errors says nothing. `floors`, one an output or none: where both widths differ by no more
/// than that, nothing is told.
Overestimation measureOverestimation(const EnclosureBounds& enclosure, const Envelope& envelope, const Table& error,
                                     const std::vector<double>& floors = {});

/// How much of alpha-cuts samples leave, [level][output]: the widths' difference over the widest proved cut's width, at
/// the time at which that is greatest, and the index of that time. NaN (and an index beyond all) where no sample is so
/// possible, or the widest cut no wider than a hundred errors.
struct CutGaps {
  std::vector<double> gap;
  std::vector<std::size_t> row;
};

/// At the first `times` output times; the widest cut first.
CutGaps measureGaps(const std::vector<Envelope>& outer, const std::vector<Envelope>& inner, const Table& error,
                    std::size_t times);

/// Compares at all output times that the enclosure reached. Samples found outside get their refined trajectories in
/// `ensemble`. Throws std::invalid_argument where the shapes do not fit or a bound is NaN.
Comparison compare(const EnclosureBounds& enclosure, Ensemble& ensemble, const UncertainMotion& system,
                   const ComparisonOptions& options = {});
/// Likewise, of samples of the system's times and outputs.
Comparison compare(const EnclosureBounds& enclosure, ComparedSamples& samples, const UncertainMotion& system,
                   const ComparisonOptions& options = {});

}  // namespace gamut
