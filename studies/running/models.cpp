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

namespace {

/// What enclosure and samples took.
double basis(const Run& run) {
  return std::max(run.spent.enclosure + run.spent.samples, Shares::least * Work::perSecond);
}

}  // namespace

double workForRequirements(const Run& run) {
  const Shares& shares = run.study.shares;
  const double all = shares.cuts + shares.requirements + (asksForDistributions(run.study) ? 0 : shares.probabilities);
  return std::max(0.0, all * basis(run) - run.spent.cuts - run.spent.requirements);
}

double workForProbabilities(const Run& run) {
  const Shares& shares = run.study.shares;
  return std::max(0.0, (shares.cuts + shares.requirements + shares.probabilities) * basis(run) - run.spent.cuts -
                           run.spent.requirements - run.spent.probabilities);
}

void boundModels(const Run& run, FlowOptions& options) {
  options.modelAtBytes = options.modelBytes = std::min(options.modelBytes, 0.25 * run.results.limits.enclosureMemory);
  options.thinAtBytes = std::min(mostModelBytes, options.modelAtBytes);
  options.firstAt = distributionRows(run.study);
}

bool tightenModels(Run& run, double tightness, double work, double longestStep, const char* task) {
  constexpr double hardly = 0.5;  // of the enclosure's: a tighter flow takes more
  run.spent.isAll = !(work > hardly * run.spent.enclosure);
  if (run.spent.isAll) return false;
  FlowOptions options = flowOptions(run.machine, run.options.jobs, run.watch.stop());
  options.tightness = tightness;
  options.longestStep = std::min(options.longestStep, longestStep);
  options.budget = work / Work::perSecond;
  options.progress = run.progressOf(task);
  boundModels(run, options);
  const bool all = asksForDistributions(run.study);
  const Tube tube = (all ? modelAll : modelMargins)(run.machine, std::move(options), run.machine.box);
  run.spent.isAll = tube.why() == Tube::overBudget;
  const std::shared_ptr<const FlowModels>& models = tube.models();
  if (!models || models->at.size() < run.enclosed.models->at.size() || models->modelled < run.enclosed.models->modelled)
    return false;
  run.enclosed.models = models;
  run.enclosed.modelTightness = tightness;
  return true;
}

}  // namespace gamut
