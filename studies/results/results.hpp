// Everything a study produced, as plain data: what the HDF5 file holds, what the JSON summary and the report show.
// The report and the verdict are computed from this alone. Each part is described in a file of its own.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "studies/results/comparison.hpp"
#include "studies/results/fuzzy.hpp"
#include "studies/results/interval.hpp"
#include "studies/results/machine.hpp"
#include "studies/results/origin.hpp"
#include "studies/results/probability.hpp"
#include "studies/results/requirements.hpp"
#include "studies/results/stochastic.hpp"
#include "studies/results/surrogate.hpp"

namespace gamut {

/// Lower and upper bounds of every output at every output time.
using Bounds = Envelope;

/// An analysis has its member here, and its row in parts().
struct Results : Origin {
  IntervalResult interval;
  StochasticResult stochastic;
  FuzzyResult fuzzy;
  ComparisonResult comparison;
  std::vector<RequirementResult> requirements;
  std::vector<MarginInfo> margins;  ///< of all of them, one after the other
  DistributionResult distribution;
  SensitivityResult sensitivity;
  DerivativeResult derivatives;
  SurrogateResult surrogate;
  MachineResult machine;

  /// What analyses found, in the order of the file.
  std::array<Part*, 9> parts() {
    return {&interval,    &stochastic,  &fuzzy,     &comparison, &distribution,
            &sensitivity, &derivatives, &surrogate, &machine};
  }
  std::array<const Part*, 9> parts() const {
    std::array<const Part*, 9> parts{};
    std::ranges::copy(const_cast<Results&>(*this).parts(), parts.begin());
    return parts;
  }
  std::array<const Answer*, 3> answers() const { return {&interval, &stochastic, &fuzzy}; }
};

/// The requirement whose margin an output is; null of others.
const RequirementResult* requirementOf(const Results& results, std::size_t output);
/// Of one requirement, in turn.
std::span<const MarginInfo> marginsOf(const Results& results, const RequirementResult& requirement);
/// Whether an output is there as the margin of a requirement.
bool isMargin(const Results& results, std::size_t output);

/// All groups of the file, in its order. They point into the results; what is const stays as it is.
std::vector<Group> describe(Results& results);
const std::vector<Group> describe(const Results& results);

/// The paths of the fields in which two results differ, in number of records, shape or a single bit.
std::vector<std::string> differences(const Results& one, const Results& other);

/// The time up to which every analysis that was asked for got (s).
double reachedTime(const Results& results);

/// Why the run ended before all was done, every reason once; empty if it did not.
std::string whyEnded(const Results& results);

}  // namespace gamut
