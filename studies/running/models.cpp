// What requirements and probabilities are found from, by a flow of its own where the enclosure's knows too little.
#include <algorithm>
#include <utility>

#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {

bool asksForDistributions(const Study& study) {
  return study.distribution.count > 0 && study.asksFor<StochasticResult>() &&
         (study.asksFor<IntervalResult>() || study.asksFor<FuzzyResult>()) &&
         study.outputs.size() > marginOutputs(study).size();
}

bool tightenModels(Run& run, double tightness, double budget, double longestStep, const char* task) {
  constexpr double leastBudget = 2;  // s
  FlowOptions options = flowOptions(run.study, run.problem, run.options.jobs, run.watch.stop());
  options.tightness = tightness;
  options.longestStep = std::min(options.longestStep, longestStep);
  options.budget = std::max(leastBudget, budget * run.enclosed.cpu);
  options.progress = run.progressOf(task);
  options.modelAtBytes = options.modelBytes = std::min(options.modelBytes, 0.25 * run.results.limits.enclosureMemory);
  const bool all = asksForDistributions(run.study);
  const auto models = (all ? modelAll : modelMargins)(run.study, std::move(options), run.problem.box).models();
  if (!models || models->at.size() < run.enclosed.models->at.size() || models->modelled < run.enclosed.models->modelled)
    return false;
  run.enclosed.models = models;
  run.enclosed.modelTightness = tightness;
  return true;
}

}  // namespace gamut
