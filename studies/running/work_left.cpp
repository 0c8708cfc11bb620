// What requirements and probabilities are found from, and how much work that may take.
#include <algorithm>

#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {

bool asksForDistributions(const Study& study) {
  return study.distribution.count > 0 && study.asksFor<StochasticResult>() &&
         (study.asksFor<IntervalResult>() || study.asksFor<FuzzyResult>()) &&
         study.outputs.size() > marginOutputs(study).size();
}

double workForRequirements(const Run& run) {
  const Shares& shares = run.study.shares;
  const double all = shares.cuts + shares.requirements + (asksForDistributions(run.study) ? 0 : shares.probabilities);
  return std::max(0.0, all * run.basis() - run.spent.cuts - run.spent.requirements);
}

double workForProbabilities(const Run& run) {
  const Shares& shares = run.study.shares;
  return std::max(0.0, (shares.cuts + shares.requirements + shares.probabilities) * run.basis() - run.spent.cuts -
                           run.spent.requirements - run.spent.probabilities);
}

void boundModels(const Run& run, FlowOptions& options) {
  constexpr double mostAt = 1.28e8;  // bytes, but at the times of distributions: of more output times there are fewer
  options.modelAtBytes = options.modelBytes = std::min(options.modelBytes, 0.25 * run.limits.enclosureMemory);
  options.thinAtBytes = std::min(mostAt, options.modelAtBytes);
  options.firstAt = distributionRows(run.study);
}

FlowOptions tighterOptions(const Run& run, double longestStep, const char* task) {
  FlowOptions options = flowOptions(run.machine, run.options.jobs, run.watch.stop());
  options.longestStep = std::min(options.longestStep, longestStep);
  options.progress = run.progressOf(task);
  boundModels(run, options);
  return options;
}

}  // namespace gamut
