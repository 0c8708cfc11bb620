// An ensemble all of whose trajectories are kept, collected from the blocks as they arrive.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>

#include "analyses/comparison/comparison.hpp"
#include "analyses/samples/ensemble.hpp"

namespace gamut::testing_motions {

struct WholeEnsemble : Ensemble {
  std::vector<FailedSample> failed;
  bool complete = false;
  Table error;
  std::size_t samples = 0, corners = 0, boxCorners = 0, failures = 0, reachedTimes = 0, packWidth = 0, counted = 0;
  double reached = 0;
  std::string why;
  Envelope summary;  ///< the run's own envelope
  Statistics statistics;
  std::vector<Envelope> innerCuts;

  std::size_t centre() const { return samples + corners + boxCorners; }
  double operator()(std::size_t sample, std::size_t time, std::size_t output) const {
    return trajectory(sample)[time * outputs + output];
  }
  /// Of the trajectories as they are now.
  Envelope envelope() const {
    Envelope result(times.size(), outputs);
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t t = 0; t < times.size(); ++t)
        for (std::size_t o = 0; o < outputs; ++o) result.include(t, o, (*this)(i, t, o));
    return result;
  }
};

inline WholeEnsemble sampleEnsemble(const UncertainMotion& system, const EnsembleOptions& options = {},
                                    const std::vector<double>& probabilities = {0.01, 0.05, 0.5, 0.95, 0.99}) {
  EnsembleRun run(system, options);
  const Sampling& sampling = run.sampling();
  WholeEnsemble e;
  e.times = system.motion.times;
  e.outputs = system.motion.outputs();
  e.quantities = sampling.quantities();
  e.samples = sampling.samples();
  e.corners = sampling.corners();
  e.boxCorners = sampling.boxCorners();
  e.data.assign(sampling.size() * e.times.size() * e.outputs, std::numeric_limits<double>::quiet_NaN());
  e.values.resize(sampling.size() * e.quantities);
  run.integrateFirst();
  run.integrateOthers({}, [&](SampleBlock& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const std::size_t number = block.first() + i;
      std::ranges::copy(block.trajectory(i), e.trajectory(number).begin());
      std::ranges::copy(block.values(i), e.values.begin() + static_cast<std::ptrdiff_t>(number * e.quantities));
    }
  });
  e.failed = run.failed();
  e.failures = run.failures();
  e.complete = run.isComplete();
  e.counted = run.counted();
  e.reached = run.reached();
  e.reachedTimes = run.reachedTimes();
  e.why = run.why();
  e.packWidth = run.packWidth();
  e.error = run.error();
  e.summary = run.envelope();
  e.statistics = run.statistics(probabilities);
  e.innerCuts = run.innerCuts();
  return e;
}

}  // namespace gamut::testing_motions
