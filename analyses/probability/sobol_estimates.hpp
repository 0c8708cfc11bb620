// Sobol' indices as samples tell them, beside their proved bounds.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "analyses/surrogate/surrogate_evaluator.hpp"
#include "analyses/uncertainty.hpp"

namespace gamut {

/// [time][output][quantity]: estimates, and half the width of their 95 % confidence intervals; NaN where the output
/// does not vary.
struct SobolEstimates {
  std::vector<double> first, firstError, total, totalError;
};

/// Outputs of samples, times by slices: `evaluate` gives those of one slice, by its number, of samples
/// [sample][quantity], [sample][time of the slice][output]; `settle` moves values of one sample, by roundings.
struct SampledOutputs {
  std::vector<SurrogateEvaluator::Slice> slices;
  std::function<void(std::span<double> values)> settle;
  std::function<void(std::size_t slice, std::span<const double> values, std::span<double> outputs)> evaluate;
};

/// From so many independent samples of each of two sets, and as many a quantity that have it of the second set and all
/// else of the first (A. Saltelli et al., Computer Physics Communications 181, 2010, for the first index; M. Jansen,
/// ibid. 117, 1999, for the total one). `times`, `outputs`: how many there are. Once `cancelled` is set, no
/// more are found: NaN, of all outputs at a time.
SobolEstimates estimateSobolIndices(const SampledOutputs& sampled, std::size_t times, std::size_t outputs,
                                    const std::vector<const Uncertain*>& uncertain, std::size_t samples,
                                    std::uint64_t seed, const std::atomic<bool>* cancelled = nullptr);
/// By a surrogate.
SobolEstimates estimateSobolIndices(const SurrogateEvaluator& evaluator, std::size_t times, std::size_t outputs,
                                    const std::vector<const Uncertain*>& uncertain, std::size_t samples,
                                    std::uint64_t seed, const std::atomic<bool>* cancelled = nullptr);

}  // namespace gamut
