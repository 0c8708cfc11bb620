// The units of a run that samples ask for, on results that hold all else.
#include "studies/running/extension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "analyses/samples/sampling.hpp"
#include "scalars/archive.hpp"
#include "studies/printable.hpp"
#include "studies/running/ranks_of_run.hpp"
#include "studies/running/run_memory.hpp"
#include "studies/running/sampled_study.hpp"
#include "studies/running/units.hpp"
#include "studies/version.hpp"

namespace gamut {
namespace {

/// So many samples does the plan have then.
Sampling samplingOf(const Study& study, const Results& results, std::size_t samples) {
  Sampling sampling(study.ensemble.plan, study.uncertain.size(), samples, results.seed);
  sampling.correlate(study.dependence.copulas);
  return sampling;
}

/// The text of the study may have another meaning for another version.
void checkStudy(const Study& study, const Results& results) {
  bool isSame = results.time == study.times && results.outputs.size() == study.outputs.size() &&
                results.uncertain.size() == study.uncertain.size() &&
                wordOf(results.stochastic.plan) == nameOf(study.ensemble.plan);
  for (std::size_t i = 0; isSame && i < study.outputs.size(); ++i)
    isSame = results.outputs[i].name == study.outputs[i].name && results.outputs[i].unit == study.outputs[i].unit;
  for (std::size_t i = 0; isSame && i < study.uncertain.size(); ++i) {
    const Uncertain& uncertain = study.uncertain[i].uncertain;
    isSame = results.uncertain[i].name == uncertain.name && results.uncertain[i].lower == uncertain.range.lower() &&
             results.uncertain[i].upper == uncertain.range.upper();
  }
  if (isSame) return;
  throw std::invalid_argument(
      fmt::format("{} had read another study from the same text; expected results by this "
                  "version of Gamut, or run the study again",
                  takerOfSamples(results)));
}

/// Whether samples of these numbers have the values that they had.
void checkValues(const Study& study, const Results& results, Sampling sampling) {
  const KeptSamples& kept = results.stochastic.kept;
  std::vector<Uncertain> uncertain;
  for (const UncertainQuantity& quantity : study.uncertain) uncertain.push_back(quantity.uncertain);
  const std::size_t n = uncertain.size();
  for (std::size_t row = 0; row < kept.number.size() && kept.number[row] < results.stochastic.samples; ++row) {
    const std::vector<double> values = sampling.values(static_cast<std::size_t>(kept.number[row]), uncertain);
    for (std::size_t q = 0; q < n; ++q)
      if (std::bit_cast<std::uint64_t>(values[q]) != std::bit_cast<std::uint64_t>(kept.values[row * n + q]))
        throw std::invalid_argument(
            fmt::format("sample {} would have {} = {} and had {}; expected results by this version of Gamut, or run "
                        "the study again",
                        kept.number[row], uncertain[q].name, values[q], kept.values[row * n + q]));
  }
}

/// Throws std::invalid_argument unless more samples can come to those that there are. How many there are then.
std::size_t checkedSamples(const Study& study, const Results& results, const RunOptions& options) {
  const StochasticResult& stochastic = results.stochastic;
  if (!stochastic.present)
    throw std::invalid_argument("holds no samples; expected results of a study that compares \"stochastic\"");
  checkStudy(study, results);
  if (!keepsFirstPoints(study.ensemble.plan))
    throw std::invalid_argument(
        fmt::format("its samples are of the plan {}, by which more samples lie elsewhere, all of them; expected sobol, "
                    "halton or random, or run the study again",
                    wordOf(stochastic.plan)));
  const Sampling sampling = samplingOf(study, results, options.samples.value_or(0));
  const auto samples = static_cast<std::int64_t>(sampling.samples());
  const bool isIncomplete = stochastic.integrated < stochastic.planned();
  if (samples < stochastic.samples || (samples == stochastic.samples && !isIncomplete))
    throw std::invalid_argument(fmt::format("holds {} samples, and would hold {}; expected {}{}", stochastic.samples,
                                            samples, isIncomplete ? "at least as many" : "more",
                                            study.uncertain.empty() ? ", but nothing is uncertain" : ""));
  return sampling.samples();
}

/// All that samples said.
void forgetSamples(Results& results, std::size_t samples) {
  constexpr double unknown = RequirementResult::unknown;
  const std::int64_t before = results.stochastic.samples;
  StochasticResult none;
  none.cpu = results.stochastic.cpu;
  none.extremes = std::move(results.stochastic.extremes);  // where they are does not depend on samples that come
  none.switching = std::move(results.stochastic.switching);
  results.stochastic = std::move(none);
  results.fuzzy.inner.clear();
  results.fuzzy.influence = {};
  results.fuzzy.transformation.gap = results.fuzzy.transformation.gapTime = {};
  results.comparison = {};
  for (RequirementResult& result : results.requirements) {
    result.samples = result.violating = 0;
    result.shareLower = result.shareUpper = result.worstTime = result.worstMargin = unknown;
    result.worstSample = -1;
    result.isViolatedInSimulation = false;
    result.estimate = {};
    if (result.violationSample >= before)  // a corner, the centre, or a point
      result.violationSample += static_cast<std::int64_t>(samples) - before;
  }
}

void noteExtension(const Limits& limits, std::int64_t before, Results& results) {
  ExtensionInfo& extension = results.extensions.emplace_back();
  extension.before = before;
  extension.version = version();
  extension.host = printable(hostName());
  extension.date = dateTime();
  extension.timeLimit = limits.time;
  extension.memoryLimit = limits.memory;
}

}  // namespace

std::uint64_t digestOf(const Results& results) {
  Results copy = results;  // what is written may be read into the same place
  std::uint64_t digest = 0;
  Archive all = Archive::writing([&](const void* bytes, std::size_t size) {
    const std::string_view part(static_cast<const char*>(bytes), size);
    digest = (digest ^ std::hash<std::string_view>()(part)) * 0x9e3779b97f4a7c15;
  });
  all(copy);
  return digest;
}

Extension extend(const Machine& machine, const Results& former, const RunOptions& options) {
  const LastOfRanks last(options.communicator);
  checkRanks(machine, options, options.communicator != nullptr ? fmt::format("{}", digestOf(former)) : "");
  const Study& study = machine.study;
  const std::size_t count = checkedSamples(study, former, options);
  checkValues(study, former, samplingOf(study, former, count));
  Limits limits = agreedLimits(limitsOf(study, options), options.communicator);
  limits.sampleTime = former.limits.sampleTime;
  Run run(machine, options, limits);
  Extension extension;
  Results& results = extension.results = former;
  addCost(results, "equations", machine.cpu);
  noteExtension(limits, former.stochastic.samples, results);
  SampledMotion samples(machine);
  samples.former.emplace(former, count);
  samples.motion = withSwitchingOf(former, std::move(samples.motion));
  Enclosure enclosure;
  enclosure.reachedTimes = enclosedTimes(former);
  ModelMasses masses = massesOf(machine);
  forgetSamples(results, count);
  RunMemory once(run, samples, enclosure, masses, results);
  once([&] { takeFirstSamples(run, samples, results); });
  once([&] { takeOtherSamples(run, enclosure, samples, results); });
  once([&] { countRequirements(study, results); });
  once([&] { estimateRequirements(run, enclosure.reachedTimes, samples, results); });
  once([&] { refuteRequirements(run, samples, results); });
  once([&] { compareShares(study, samples, results); });
  noteStop(run, "", results);
  compareAnswers(run, enclosure.reachedTimes, samples, results);
  double cpu = run.watch.spent(), memory = peakMemory();
  addCostsOfRanks(options.communicator, cpu, memory);
  results.extensions.back().cpu = cpu;
  results.cpu += cpu;
  results.memory = std::max(results.memory, memory);
  extension.isMore = results.stochastic.integrated >= former.stochastic.integrated;
  extension.met = samples.former->met();
  extension.changed = samples.former->changed();
  return extension;
}

}  // namespace gamut
