// What is probable: many samples of the uncertain quantities, integrated by the witness (CVODE), by Adams's method in
// packs, and what they say together: envelope, moments, quantiles, inner alpha-cuts, and the witness's own error.
// Trajectories are kept, so that the comparison can name the sample that leaves an enclosure.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "analyses/sampling.hpp"
#include "analyses/table.hpp"
#include "analyses/uncertainty.hpp"
#include "analyses/witness.hpp"

namespace gamut {

/// A motion whose start values are partly uncertain.
struct UncertainMotion {
  Motion motion;
  std::vector<double> nominal;       ///< initial values, then parameters
  std::vector<Uncertain> uncertain;  ///< the uncertain quantities
  std::vector<int> slot;             ///< of each uncertain quantity: its place in `nominal`

  /// The start values for these values of the uncertain quantities.
  std::vector<double> start(std::span<const double> values) const;
  /// Throws std::invalid_argument, saying what does not fit together.
  void check() const;
};

struct EnsembleOptions {
  Plan plan = Plan::sobol;
  std::size_t samples = 4096;
  std::uint64_t seed = 1;
  Tolerance tolerance;
  Method method = Method::adams;
  /// CPU time after which a sample fails; a pack that takes longer is given up and its samples integrated one by one
  double secondsPerSample = std::numeric_limits<double>::infinity();
  int jobs = 1;                                  ///< threads
  std::function<void(double)> progress;          ///< called with the fraction done (0 … 1), from any thread
  const std::atomic<bool>* cancelled = nullptr;  ///< set from outside to end early; what was integrated is kept
};

/// A sample that CVODE could not follow to the horizon.
struct FailedSample {
  std::size_t number = 0;
  std::size_t times = 0;  ///< number of output times reached
  double reached = 0;     ///< s
  std::string why;
};

/// The integrated samples: numbers 0 … samples-1 count in the statistics, then follow the corners, the centre is last.
struct Ensemble {
  std::vector<double> times;  ///< s
  std::size_t outputs = 0;
  std::size_t samples = 0;
  std::size_t corners = 0;
  std::vector<double> values;  ///< of the uncertain quantities: [number][quantity]
  std::size_t quantities = 0;
  std::vector<double> data;          ///< [number][time][output]; NaN where a sample did not arrive
  std::vector<FailedSample> failed;  ///< by rising number
  std::size_t integrated = 0;        ///< how many have arrived or failed; size() unless cancelled
  bool complete = false;             ///< false if cancelled
  double reached = 0;                ///< s: the last output time at which all that were integrated have arrived
  std::string why;  ///< why that is before the horizon, naming the first sample that failed; "cancelled"; or empty
  Tolerance tolerance;
  Method method = Method::adams;
  std::size_t packWidth = 1;  ///< samples of one number / packWidth were integrated together, see sampleEnsemble
  Table error;     ///< witness error: greatest change of a re-integrated sample at a hundred times tighter tolerance
  double cpu = 0;  ///< s, all threads

  std::size_t size() const { return samples + corners + 1; }
  std::size_t centre() const { return samples + corners; }
  double operator()(std::size_t number, std::size_t time, std::size_t output) const {
    return data[(number * times.size() + time) * outputs + output];
  }
  /// One sample's trajectory: [time][output].
  std::span<double> trajectory(std::size_t number) {
    return std::span(data).subspan(number * times.size() * outputs, times.size() * outputs);
  }
  std::span<const double> trajectory(std::size_t number) const {
    return std::span(data).subspan(number * times.size() * outputs, times.size() * outputs);
  }
  std::span<const double> valuesOf(std::size_t number) const {
    return std::span(values).subspan(number * quantities, quantities);
  }

  /// Of samples, corners and centre.
  Envelope envelope() const;
};

/// Integrates all samples, corners and the centre of `system`, and measures the witness's error on every fiftieth
/// sample, integrated once more alone (on at least eight, or all if there are fewer; without states, where nothing is
/// integrated, against 128-bit arithmetic). By Adams's method the samples of one number / packWidth are integrated
/// together, in the steps of the one that needs the shortest: a sample's trajectory is what its pack gave. Packs of so
/// few samples that they would cost more than the samples alone, packs of which a sample fails, and all samples by
/// Method::bdf are integrated one by one. Samples that fail are named and left out. Every number depends on the
/// options' plan, samples, seed, tolerance and method alone, but which samples took too long. Throws
/// std::invalid_argument for options or a system that make no sense.
Ensemble sampleEnsemble(const UncertainMotion& system, const EnsembleOptions& options = {});

/// The trajectory of sample `number`, [time][output], bit for bit as in sampleEnsemble(system, options), by integrating
/// its pack alone. Throws as sampleEnsemble does, and std::invalid_argument for a number that no sample has.
std::vector<double> replaySample(const UncertainMotion& system, const EnsembleOptions& options, std::size_t number);

/// What the samples (without corners and centre) say; a failed sample counts as long as it lasted.
struct Statistics {
  Table mean;
  Table deviation;                    ///< with N-1; NaN for a single sample
  std::vector<double> probabilities;  ///< of the quantiles
  std::vector<Table> quantiles;       ///< one a probability; between samples by linear interpolation
};
Statistics statistics(const Ensemble& ensemble,
                      const std::vector<double>& probabilities = {0.01, 0.05, 0.5, 0.95, 0.99});

/// Inner alpha-cuts: one envelope a level of alpha, over the samples, corners and centre in which every quantity has at
/// least that membership. `uncertain` as in the system sampled. NaN where no sample belongs.
std::vector<Envelope> innerCuts(const Ensemble& ensemble, const std::vector<Uncertain>& uncertain,
                                const std::vector<double>& alpha);

}  // namespace gamut
