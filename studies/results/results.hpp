// Everything a study produced, as plain data: what the HDF5 file holds, what the JSON summary and the report show.
// The report and the verdict are computed from this alone. Each part is described in a file of its own.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "studies/results/comparison.hpp"
#include "studies/results/fuzzy.hpp"
#include "studies/results/interval.hpp"
#include "studies/results/origin.hpp"
#include "studies/results/picture.hpp"
#include "studies/results/probability.hpp"
#include "studies/results/requirements.hpp"
#include "studies/results/stochastic.hpp"
#include "studies/results/surrogate.hpp"

namespace gamut {

/// Lower and upper bounds of every output at every output time.
using Bounds = Envelope;

struct Results : Origin {
  IntervalResult interval;
  StochasticResult stochastic;
  FuzzyResult fuzzy;
  ComparisonResult comparison;
  RequirementsResult requirements;
  std::vector<MarginInfo> margins;  ///< of all of them, one after the other
  DistributionResult distribution;
  SensitivityResult sensitivity;
  std::vector<Boxed<FurtherPart>> further = furtherParts();  ///< one each; of what nobody else knows the type of
  SurrogateResult surrogate;
  PictureResult picture;

  /// What analyses found, in the order of the file.
  std::vector<Part*> parts();
  std::vector<const Part*> parts() const;
  std::array<const Answer*, 3> answers() const { return {&interval, &stochastic, &fuzzy}; }

  /// Of the further parts the one of this type; an empty one where there is none.
  template <class P>
  const P& of() const {
    static const P none;
    for (const Boxed<FurtherPart>& part : further)
      if (const auto* found = dynamic_cast<const P*>(&*part)) return *found;
    return none;
  }
  template <class P>
  P& of() {
    for (Boxed<FurtherPart>& part : further)
      if (auto* found = dynamic_cast<P*>(&*part)) return *found;
    return static_cast<P&>(*further.emplace_back(std::make_unique<P>()));
  }
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

/// What keeps a verdict from being complete, of the first further part that does; empty if none does.
std::string unfinishedPart(const Results& results);
/// Its reason.
std::string whyUnfinished(const Results& results);

/// The time up to which every analysis that was asked for got (s).
double reachedTime(const Results& results);

/// Why the run ended before all was done, every reason once; empty if it did not.
std::string whyEnded(const Results& results);

}  // namespace gamut
