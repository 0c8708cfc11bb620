// What is proved of each requirement: by the models of its margins, and, where these do not decide, by a flow of the
// values for which it most likely is violated.
#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "analyses/requirements/requirement.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// What holds of the whole window, of what was found up to where the models reach.
void forgetWhatIsNotKnown(RequirementFinding& finding, bool isAlways) {
  if (isAlways) {
    finding.isAlwaysMet = false;
    finding.met = finding.factor = 0;
    finding.probability = Interval(0.0, finding.probability.upper());
    finding.violationPossibility = Interval(finding.violationPossibility.lower(), 1.0);
  } else {
    finding.isNeverMet = false;
    finding.violated = 0;
    finding.violating.clear();
    finding.probability = Interval(finding.probability.lower(), 1.0);
    finding.violationPossibility = Interval(0.0, finding.violationPossibility.upper());
  }
}

/// The box with these values of what is uncertain.
Box boxAt(const Problem& problem, const std::vector<double>& values) {
  Box box = problem.box;
  for (std::size_t q = 0; q < values.size(); ++q)
    if (const auto slot = static_cast<std::size_t>(problem.motion.slot[q]); !std::isnan(values[q]))
      box[slot] = values[q];
  return box;
}

/// Models of the margins for these values alone; null where they do not reach the window.
std::shared_ptr<const FlowModels> modelsAt(Run& run, const std::vector<double>& values, const CellQuestion& question) {
  const Box box = boxAt(run.problem, values);
  if (run.study.analysis == Study::Analysis::kinematics)
    return modelImage(run.study.motion.g, 0.0, box, marginOutputs(run.study), run.study.flow.degree, run.watch.stop());
  const Tube tube =
      modelMargins(run.study, flowOptions(run.study, run.problem, run.options.jobs, run.watch.stop()), box);
  return tube.reachedTimes() > question.until ? tube.models() : nullptr;
}

/// Whether all that is known of these values is that they violate it; then when, and by how much, where that is told.
bool isViolatedAt(Run& run, const std::vector<double>& values, const CellQuestion& question,
                  RequirementResult& result) {
  const auto models = modelsAt(run, values, question);
  if (!models || Cells(*models, question).whole()->verdict() != Cell::Verdict::violated) return false;
  result.violation = values;
  const bool isAlways = question.when == CellQuestion::When::always;
  std::optional<Interval> found;
  for (std::size_t row = question.from; row <= question.until; ++row)
    for (std::size_t k = 0; k < question.margins.size(); ++k) {
      Interval bound = Interval::empty();
      for (const auto& snapshot : models->at[row])
        bound = hull(bound, snapshot->outputs[static_cast<std::size_t>(question.margins[k])].bound);
      if (question.isMetAtZero[k] != 0 ? !(bound.upper() < 0) : !(bound.upper() <= 0)) continue;
      if (found && (isAlways ? bound.upper() >= found->upper() : bound.upper() <= found->upper())) continue;
      found = bound;
      result.violationTime = run.study.motion.times[row];
    }
  result.isViolatedBetween = isAlways && !found;
  if (!found) return true;
  result.violationLower = found->lower();
  result.violationUpper = found->upper();
  return true;
}

/// Besides what is known already: all of it holds.
void take(RequirementResult& result, const RequirementFinding& finding) {
  if (result.word != "partly" || finding.isNeverMet)
    result.word = finding.isAlwaysMet ? "met" : finding.isNeverMet ? "violated" : "open";
  result.met = std::max(result.met, finding.met);
  result.violated = std::max(result.violated, finding.violated);
  result.factor = std::max(result.factor, finding.factor);
  result.probabilityLower = std::max(result.probabilityLower, finding.probability.lower());
  result.probabilityUpper = std::min(result.probabilityUpper, finding.probability.upper());
  result.violationLeast = std::max(result.violationLeast, finding.violationPossibility.lower());
  result.violationMost = std::min(result.violationMost, finding.violationPossibility.upper());
}

/// By the degree of possibility of values that violate it.
void noteMembership(const Study& study, RequirementResult& result) {
  double degree = 1;
  for (std::size_t q = 0; q < study.uncertain.size(); ++q)
    if (!std::isnan(result.violation[q]))
      degree = std::min(degree, study.uncertain[q].uncertain.membership(result.violation[q]));
  result.violationLeast = std::max(result.violationLeast, std::min(degree, result.violationMost));
}

/// Whether bounds are so far apart that tighter models are worth their while.
bool isVague(const Run& run, const RequirementResult& result) {
  constexpr double gap = 0.008;
  const bool isOneProbability = isPlain(run.study);
  return result.word != "met" && result.word != "violated" &&
         (result.word == "open" || (isOneProbability && result.probabilityUpper - result.probabilityLower > gap) ||
          result.violationMost - result.violationLeast > 6 * gap);
}

/// What models of the margins say of one requirement; no less than what is known of it already.
void examineModels(Run& run, const FlowModels& models, std::size_t number, std::vector<std::vector<double>>& suspects) {
  const Study& study = run.study;
  const Requirement& requirement = study.requirements[number];
  const CellQuestion whole = questionOf(study, requirement, study.motion.times.size());
  if (models.at.size() <= whole.from) return;
  const CellQuestion question = questionOf(study, requirement, models.at.size());
  std::vector<CellQuantity> quantities;
  for (std::size_t q = 0; q < study.uncertain.size(); ++q)
    if (!study.uncertain[q].varies) quantities.push_back({run.problem.motion.slot[q], &study.uncertain[q].uncertain});
  RequirementOptions options;
  std::vector<FlowSymbol> symbols;
  for (const CellQuantity& quantity : quantities)
    symbols.push_back(models.components[static_cast<std::size_t>(quantity.component)]);
  options.masses = &jointMasses(run, models.symbols, symbols);
  options.cancelled = run.watch.stop();
  RequirementFinding finding = gamut::examine(models, question, quantities, options);
  if (question.until < whole.until) forgetWhatIsNotKnown(finding, requirement.isAlways);
  RequirementResult& result = run.results.requirements[number];
  take(result, finding);
  for (const std::vector<double>& values : {finding.violating, finding.doubtful}) {
    if (values.empty()) continue;
    std::vector<double>& all = suspects.emplace_back();
    for (std::size_t q = 0, next = 0; q < study.uncertain.size(); ++q)
      all.push_back(study.uncertain[q].varies ? RequirementResult::unknown : values[next++]);
  }
  if (finding.violating.empty()) return;  // else the models prove it; a flow of its own will tell when and by how much
  if (result.word == "open") result.word = "partly";
  result.violation = suspects.front();
}

/// Values that violate it, by a flow of their own: of the worst sample, or where the models leave most doubt.
void findViolation(Run& run, std::size_t number, std::vector<std::vector<double>> suspects) {
  RequirementResult& result = run.results.requirements[number];
  const CellQuestion whole = questionOf(run.study, run.study.requirements[number], run.study.motion.times.size());
  const bool isOfSample = result.worstSample >= 0 && result.worstMargin < 0;
  if (isOfSample) {  // a corner's values are those of the rounded intervals: what is meant lies some roundings inside
    std::vector<double> values = run.worst[number];
    for (std::size_t q = 0; q < values.size(); ++q)
      if (const Interval inside = run.study.uncertain[q].uncertain.inside(); !std::isnan(values[q]) && !isEmpty(inside))
        values[q] = std::clamp(values[q], inside.lower(), inside.upper());
    suspects.insert(suspects.begin(), std::move(values));
  }
  for (std::size_t i = 0; i < suspects.size(); ++i) {
    if (*run.watch.stop() || !isViolatedAt(run, suspects[i], whole, result)) continue;
    if (isOfSample && i == 0) result.violationSample = result.worstSample;
    if (result.word == "open") result.word = "partly";
    noteMembership(run.study, result);
    return;
  }
}

constexpr const char* tooLoose = "the enclosure is not tight enough to tell";

std::string whyOpen(const Run& run, const RequirementResult& result) {
  if (*run.watch.stop()) return run.watch.why();
  if (!run.study.asksFor<IntervalResult>() && !run.study.asksFor<FuzzyResult>()) return "no enclosure was asked for";
  if (!run.enclosed.models) return run.enclosed.why.empty() ? "models of its margins found no room" : run.enclosed.why;
  if (run.study.motion.times[run.enclosed.models->at.size() - 1] < result.until) return run.enclosed.why;
  return result.word == "open" ? tooLoose : "";
}

/// Does it while there is room, and takes the time of it.
template <class Prove>
void proveWhileThereIsRoom(Run& run, const Prove& prove) {
  if (run.study.requirements.empty()) return;
  run.watch.begin(Watch::Stage::rest);
  const double start = processCpuSeconds();
  try {
    prove();
  } catch (const std::bad_alloc&) {
    run.watch.memoryFailed();
    for (RequirementResult& result : run.results.requirements)
      if (result.word == "open") result.why = run.watch.why();
  }
  run.results.interval.cpu += processCpuSeconds() - start;
}

void proveAll(Run& run) {
  const std::size_t count = run.study.requirements.size();
  std::vector<std::vector<std::vector<double>>> suspects(count);
  const auto examineAll = [&](const FlowModels& models) {
    for (std::size_t r = 0; r < count; ++r)
      if (isVague(run, run.results.requirements[r])) {
        std::vector<std::vector<double>> found;
        examineModels(run, models, r, found);
        suspects[r].insert(suspects[r].begin(), found.begin(), found.end());
      }
  };
  if (run.enclosed.models) examineAll(*run.enclosed.models);
  double excess = run.study.flow.tightness - 1;
  for (int round = 0; round < 2 && run.enclosed.models; ++round) {
    if (run.study.analysis == Study::Analysis::kinematics || *run.watch.stop() ||
        std::ranges::none_of(run.results.requirements, [&](const auto& result) { return isVague(run, result); }))
      break;
    constexpr double parts = 128;  // of the horizon: outputs leave the chords of long steps
    constexpr double budget = 4;
    const double longest = round == 0 ? run.study.horizon : run.study.horizon / parts;
    if (!tightenModels(run, 1 + (excess /= 4), budget, longest, "requirements")) break;
    examineAll(*run.enclosed.models);
  }
  for (std::size_t r = 0; r < count; ++r) {
    RequirementResult& result = run.results.requirements[r];
    if (result.word != "met") findViolation(run, r, std::move(suspects[r]));
    if (result.word == "open" || result.word == "partly") result.why = whyOpen(run, result);
  }
}

}  // namespace

void stateRequirements(Run& run) {
  for (const Requirement& requirement : run.study.requirements) {
    RequirementResult& result = run.results.requirements.emplace_back();
    result.name = requirement.name;
    result.statement = requirement.statement;
    result.isAlways = requirement.isAlways;
    result.from = requirement.from;
    result.until = requirement.until;
    result.margin = requirement.margins.front();
    result.margins = static_cast<std::int64_t>(requirement.margins.size());
    for (std::size_t k = 0; k < requirement.isMetAtZero.size(); ++k)
      result.metAtZero |= static_cast<std::int64_t>(requirement.isMetAtZero[k] != 0 ? 1 : 0) << k;
    result.violation.assign(run.study.uncertain.size(), RequirementResult::unknown);
  }
  run.worst.resize(run.study.requirements.size());
}

void checkRequirements(Run& run) {
  proveWhileThereIsRoom(run, [&] { proveAll(run); });
}

void refuteRequirements(Run& run) {
  proveWhileThereIsRoom(run, [&] {
    for (std::size_t r = 0; r < run.results.requirements.size(); ++r) {
      RequirementResult& result = run.results.requirements[r];
      if (result.word != "open") continue;
      findViolation(run, r, {});
      if (result.word != "open" && result.why == tooLoose) result.why.clear();
    }
  });
}

}  // namespace gamut
