// The units of a run one after the other.
#include "studies/running/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include "analyses/communicator.hpp"
#include "analyses/consistency.hpp"
#include "mechanics/assembly.hpp"
#include "studies/assumed_rows.hpp"
#include "studies/named_texts.hpp"
#include "studies/printable.hpp"
#include "studies/running/ranks_of_run.hpp"
#include "studies/running/run_memory.hpp"
#include "studies/running/units.hpp"
#include "studies/told.hpp"
#include "studies/version.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// "a, b: Gaussian copula, rank correlation 0.5; c, d: unknown; samples are of one of the joint distributions that are
/// possible".
std::string dependenceText(const Study& study) {
  std::vector<std::string> texts;
  const auto namesOf = [&](const std::vector<std::size_t>& quantities) {
    std::vector<std::string> names;
    for (const std::size_t q : quantities) names.push_back(study.uncertain[q].uncertain.name);
    return fmt::format("{}", fmt::join(names, ", "));
  };
  for (const GaussianCopula& copula : study.dependence.copulas) {
    std::vector<std::string> rows;
    for (std::size_t i = 1; i < copula.rank().size(); ++i) {
      std::vector<std::string> row;
      for (std::size_t j = 0; j < i; ++j) row.push_back(fmt::format("{:.6g}", midpoint(copula.rank()[i][j])));
      rows.push_back(fmt::format("{}", fmt::join(row, ", ")));
    }
    texts.push_back(fmt::format("{}: Gaussian copula, rank correlation{} {}", namesOf(copula.quantities()),
                                rows.size() > 1 ? "s, row by row," : "", fmt::join(rows, " | ")));
  }
  for (const std::vector<std::size_t>& group : study.dependence.unknown) texts.push_back(namesOf(group) + ": unknown");
  const bool areSeveral =
      !study.dependence.unknown.empty() || std::ranges::any_of(study.uncertain, [](const UncertainQuantity& q) {
        return !q.varies && !q.uncertain.distribution.isPrecise();
      });
  if (areSeveral) texts.emplace_back("samples are of one of the joint distributions that are possible");
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string assumptionsText(const Study& study) {
  std::vector<std::string> texts;
  for (const Assumption& assumption : assumptionsOn(study.mechanism)) texts.push_back(assumption.sentence);
  return fmt::format("{}", fmt::join(texts, "; "));
}

/// "pin: coupler.angle = -0.552 rad, rocker.angle = 1.6 rad; …".
std::string assemblyText(const Study& study) {
  const Mechanism& mechanism = study.mechanism;
  if (!mechanism.isClosed() || study.analysis == Study::Analysis::equilibria) return {};
  const Assembly<double> assembly(mechanism);
  const std::vector<std::string> known = mechanism.outputQuantities();
  std::vector<std::string> texts;
  for (const Mechanism::Closed& loop : mechanism.loops()) {
    std::vector<std::string> places;
    for (const std::string& name : loop.by)
      if (std::ranges::find(known, name) != known.end())
        places.push_back(
            fmt::format("{} = {}", name, inUnit(numberText(assembly.output(name), 6), mechanism.unitOf(name))));
    texts.push_back(fmt::format("{}: {}", loop.element, fmt::join(places, ", ")));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

/// The part of the results that is known before anything runs. Words as they are read back from a file.
Results withOrigin(const Run& run) {
  const Study& study = run.study;
  Results results;
  Origin& origin = results;
  results.further.clear();
  for (const Boxed<FurtherAnalysis>& analysis : study.analyses) results.further.emplace_back(analysis->part());
  origin.studyText = study.text;
  origin.robotText = study.robot;
  origin.tablesText = inOneText(study.tables);
  origin.studyFile = printable(study.file);
  origin.title = printable(study.title);
  origin.analysis = study.analysisName();
  origin.limits = run.limits;
  origin.seed = run.options.seed.value_or(study.ensemble.seed);
  origin.version = version();
  origin.host = printable(hostName());
  origin.date = dateTime();
  origin.libraries = libraryVersions();
  origin.outputs.assign(study.outputs.begin(), study.outputs.end());
  origin.horizon = study.horizon;
  origin.time = study.times;
  origin.dependence = dependenceText(study);
  origin.assumptions = assumptionsText(study);
  origin.assembly = assemblyText(study);
  for (const UncertainQuantity& q : study.uncertain) {
    const Uncertain& u = q.uncertain;
    origin.uncertain.push_back({u.name, q.quantity, q.unit, u.range.lower(), u.nominal, u.range.upper(),
                                std::string(u.distribution.name()), std::string(u.membership.name())});
    UncertainInfo& info = origin.uncertain.back();
    info.told = q.told;
    info.stated = q.stated;
    if (q.varies) {
      const Told own(q.unit, "");  // a comparison looks at this text, in whatever units two studies are stated
      info.distribution = info.membership =
          std::isfinite(q.rate) ? fmt::format("varies by {:.6g} {} at most", q.rate, own.rateUnit()) : "varies freely";
      continue;
    }
    const auto add = [&](ShapeKind shape, const std::vector<ShapeNumber>& numbers) {
      for (const ShapeNumber& n : numbers)
        origin.shapes.push_back({u.name, shape, n.name, n.value, n.isOfQuantity ? q.unit : "1"});
    };
    add(ShapeKind::distribution, u.distribution.numbers());
    add(ShapeKind::membership, u.membership.numbers());
    if (u.distribution.isPrecise()) info.inconsistency = inconsistency(u.distribution, u.membership);
  }
  addCost(origin, "equations", run.machine.cpu);
  return results;
}

}  // namespace

Run::Run(const Machine& whatMoves, const RunOptions& howToRun, const Limits& itsLimits)
    : machine(whatMoves),
      study(machine.study),
      options(howToRun),
      limits(itsLimits),
      watch(limits, options.cancelled, {options.overdue}, machine.cpu) {
  if (options.communicator == nullptr) return;
  options.communicator->heed(
      watch.everStopped(), [this](const std::string& told) { watch.hear(told); }, [this] { return watch.tell(); });
}

Run::~Run() {
  if (options.communicator != nullptr) options.communicator->heed(nullptr, {}, {});
}

double agreed(const Run& run, double own) {
  return run.options.communicator != nullptr ? run.options.communicator->agreed(own) : own;
}

std::function<void(double)> Run::progressOf(const std::string& task) const {
  if (!options.progress) return {};
  return [this, task](double fraction) { options.progress(task, fraction); };
}

Limits limitsOf(const Study& study, const RunOptions& options) {
  StatedLimits limits = study.limits;
  if (options.timeLimit) limits.time = options.timeLimit;
  if (options.memoryLimit) limits.memory = options.memoryLimit;
  return limits.resolved();
}

/// The samples' share, with what was proved before them and the tables of what is kept of them: when a file is written
/// or a page drawn, the samples' are gone.
double memoryNeeded(const Study& study, const RunOptions& options) {
  if (!study.asksFor<StochasticResult>()) return 0;
  const std::size_t levels = study.asksFor<FuzzyResult>() ? static_cast<std::size_t>(study.levels) : 0;
  const std::size_t times = study.times.size(), outputs = study.outputs.size(), quantities = study.uncertain.size();
  constexpr double beside = 2049;  // corners and centre at most
  const std::size_t counted = options.samples.value_or(study.ensemble.samples);
  const double samples = static_cast<double>(counted) + beside;
  const double all = samples * static_cast<double>(sizeof(double) * (2 + quantities + times * outputs));
  constexpr double copies = 3;  // the samples, the file in HDF5's hands and in ours
  const bool isEnclosed = study.asksFor<IntervalResult>() || levels > 0;
  // Twice: what the flow holds is taken over, in pages that hardly come back.
  const double proved = isEnclosed ? static_cast<double>(sizeof(double) * 4 * (2 + levels) * times * outputs) : 0;
  constexpr double program = 6e7;
  return program + proved + ensembleBytes({times, outputs, quantities, counted, levels}) +
         copies * std::min(study.storage, all);
}

Results run(const Machine& machine, const RunOptions& options) {
  const LastOfRanks last(options.communicator);
  checkRanks(machine, options);
  Run run(machine, options, agreedLimits(limitsOf(machine.study, options), options.communicator));
  Results results = withOrigin(run);
  SampledMotion samples(machine);
  ModelMasses masses = massesOf(machine);
  stateRequirements(machine.study, results);
  const Seen seen = lookAtMachine(run, results.picture);
  Enclosure enclosure;
  RunMemory once(run, samples, enclosure, masses, results);
  once([&] { takeFirstSamples(run, samples, results); });
  once([&] { enclosure = enclose(run, seen, samples.scales, results); });
  std::string failure;
  const auto goOn = [&](const auto& units) {  // a failure must not cost what was proved
    try {
      units();
    } catch (const std::exception& error) {
      if (failure.empty()) failure = printable(error.what());
    }
  };
  goOn([&] {
    once([&] { takeOtherSamples(run, enclosure, samples, results); });
    once([&] { countRequirements(machine.study, results); });
    once([&] { estimateRequirements(run, enclosure.reachedTimes, samples, results); });
    once([&] { seekAdvice(run, samples.scales, enclosure, results); });
    once([&] { checkRequirements(run, samples, enclosure, masses, results); });
    once([&] { boundProbabilities(run, samples.scales, enclosure, masses, results); });
    once([&] { compareShares(machine.study, samples, results); });
    once([&] { findFurther(run, results); });
  });
  noteStop(run, failure, results);
  const bool isWhole = failure.empty();
  goOn([&] {
    compareAnswers(run, enclosure.reachedTimes, samples, results);
    if (isWhole) showSamples(run, seen, enclosure.why, samples.motion, results);
  });
  if (isWhole && !failure.empty()) noteStop(run, failure, results);
  results.cpu = run.watch.spent();
  results.memory = peakMemory();
  addCostsOfRanks(options.communicator, results.cpu, results.memory);
  return results;
}

}  // namespace gamut
