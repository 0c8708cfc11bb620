// What is proved of each requirement: by the models of its margins, and, where these do not decide, by a flow of the
// values for which it most likely is violated.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "analyses/checkpoints.hpp"
#include "analyses/requirements/decided_cells.hpp"
#include "analyses/requirements/requirement.hpp"
#include "analyses/requirements/start.hpp"
#include "analyses/shared_indices.hpp"
#include "scalars/archive.hpp"
#include "studies/results/extremes.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/margins.hpp"
#include "studies/running/run_memory.hpp"
#include "studies/running/units.hpp"
#include "studies/words.hpp"

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

/// Besides what is known already: all of it holds.
void take(RequirementResult& result, const RequirementFinding& finding) {
  if (result.word != Decision::partly || finding.isNeverMet)
    result.word = finding.isAlwaysMet ? Decision::met : finding.isNeverMet ? Decision::violated : Decision::open;
  result.met = std::max(result.met, finding.met);
  result.violated = std::max(result.violated, finding.violated);
  result.factor = std::max(result.factor, finding.factor);
  result.probabilityLower = std::max(result.probabilityLower, finding.probability.lower());
  result.probabilityUpper = std::min(result.probabilityUpper, finding.probability.upper());
  result.violationLeast = std::max(result.violationLeast, finding.violationPossibility.lower());
  result.violationMost = std::min(result.violationMost, finding.violationPossibility.upper());
}

/// Whether bounds are so far apart that tighter models are worth their while.
bool isVague(const Study& study, const RequirementResult& result) {
  constexpr double gap = 0.008;
  const bool isOneProbability = isPlain(study);
  return result.word != Decision::met && result.word != Decision::violated &&
         (result.word == Decision::open ||
          (isOneProbability && result.probabilityUpper - result.probabilityLower > gap) ||
          result.violationMost - result.violationLeast > 6 * gap);
}

/// Why no more is known, and what may help.
struct Reason {
  std::string why, advice;
};

const Reason exactly{"its limit is met exactly, as far as can be told: rounded numbers prove neither", "another limit"};

/// What the enclosure says of a margin that is left open: where it reaches how far below zero.
Reason ofMargin(const Study& study, const Results& results, const Requirement& requirement) {
  const Reason loose{"the enclosure is not tight enough to tell",
                     fmt::format("interval.tightness = {:.6g}", 1 + (study.flow.tightness - 1) / 4)};
  const std::vector<double>& times = study.times;
  const IntervalResult& interval = results.interval;
  if (!requirement.demand.isAlways || interval.at.empty()) return loose;
  struct Least {
    double margin = std::numeric_limits<double>::infinity(), time = 0;
    std::size_t output = 0;
  } at, over;
  const std::size_t from = rowOf(times, requirement.demand.from), until = rowOf(times, requirement.demand.until);
  for (const std::size_t output : requirement.marginOutputs())
    for (std::size_t row = from; row <= until; ++row) {
      const double lower = interval.at.lower(row, output);
      if (lower < at.margin) at = {lower, times[row], output};
      if (row == from || interval.over.empty()) continue;
      if (const double since = interval.over.lower(row, output); since < over.margin)
        over = {since, times[row], output};
    }
  const Least& least = at.margin > 0 ? over : at;
  if (!std::isfinite(least.margin) || !(least.margin < 0)) return loose;
  const double size = motionSize(results, least.output);
  if (isLittle(least.margin, size)) return exactly;
  const std::string below = inUnit(atMostText(-least.margin, 3, size), study.outputs[least.output].unit);
  if (study.horizon == 0) return {fmt::format("its margin is proved to be above -{} only", below), ""};
  if (at.margin > 0)
    return {fmt::format("between output times, before {} s, its margin is proved to be above -{} only",
                        numberText(least.time, 6), below),
            "more output times (study.output_step)"};
  return {fmt::format("its margin is proved to be above -{} only at {} s", below, numberText(least.time, 6)),
          loose.advice};
}

/// Whether all of the box is met, as far as so many cells tell.
bool isMetThroughout(const FlowModels& models, const CellQuestion& question) {
  constexpr int most = 256;
  Cells cells(models, question);
  std::vector<std::unique_ptr<Cell>> open;
  open.push_back(cells.whole());
  for (int count = 0; !open.empty(); ++count) {
    const std::unique_ptr<Cell> cell = std::move(open.back());
    open.pop_back();
    if (cell->verdict() == Cell::Verdict::met) continue;
    if (cell->verdict() == Cell::Verdict::violated || count >= most) return false;
    std::vector<std::unique_ptr<Cell>> halves = cells.halves(*cell);
    if (halves.empty()) return false;
    for (std::unique_ptr<Cell>& half : halves) open.push_back(std::move(half));
  }
  return true;
}

/// The last output time of the window up to which it is always met, for every value; NaN if there is none.
double metUntil(const Machine& machine, const FlowModels& models, const Requirement& requirement) {
  const Study& study = machine.study;
  CellQuestion question = questionOf(study, requirement, models.at.size());
  if (!requirement.demand.isAlways || models.at.size() <= question.from) return RequirementResult::unknown;
  std::vector<char> isOwned(static_cast<std::size_t>(models.symbols), 0);
  for (std::size_t q = 0; q < study.uncertain.size(); ++q)
    if (const int symbol = models.components[machine.motion.slot[q]].symbol; symbol >= 0) isOwned[symbol] = 1;
  for (int l = 0; l < models.symbols; ++l)
    if (isOwned[l] == 0) question.besides.push_back(l);
  std::size_t met = question.from,
              open = question.until + 1;  // it is met before the one, and not known up to the other
  const auto isMetUntil = [&](std::size_t row) {
    question.until = row;
    return isMetThroughout(models, question);
  };
  if (!isMetUntil(met)) return RequirementResult::unknown;
  while (open - met > 1) {
    const std::size_t middle = met + (open - met) / 2;
    (isMetUntil(middle) ? met : open) = middle;
  }
  return study.times[met];
}

/// Of each margin, in turn, whether it must be above zero; otherwise zero is enough.
std::vector<bool> areStrict(const Study& study) {
  std::vector<bool> result;
  for (const Requirement& requirement : study.requirements)
    for (const DemandTerm& term : requirement.demand.terms) result.push_back(term.isStrict);
  return result;
}

/// At the very moment of a jump an output has a value of its own, which the enclosure knows; models hold what it comes
/// to on both sides. Where zero is enough of a margin, and the enclosure, in which what is exact is not rounded, begins
/// there, it says more than they do: x <= 0.75 of 0.5 ± 0.25.
std::shared_ptr<const FlowModels> sharpenedByEnclosure(const Study& study, const IntervalResult& interval,
                                                       std::shared_ptr<const FlowModels> models) {
  const std::vector<int> margins = marginOutputs(study);
  const std::vector<bool> isStrict = areStrict(study);
  const auto isAtZero = [&](std::size_t k, double lower, const Interval& bound) {
    return !isStrict[k] && lower >= 0 && bound.lower() < 0;
  };
  std::shared_ptr<FlowModels> sharpened;
  for (std::size_t row = 0; row < models->at.size() && row < interval.at.lower.times; ++row)
    for (std::size_t part = 0; part < models->at[row].size(); ++part) {
      std::shared_ptr<FlowSnapshot> own;
      for (std::size_t k = 0; k < margins.size(); ++k) {
        const auto output = static_cast<std::size_t>(margins[k]);
        const double lower = interval.at.lower(row, output), upper = interval.at.upper(row, output);
        const Interval& bound = models->at[row][part]->outputs[k].bound;
        if (!(upper - lower < 0.5 * width(bound)) && !isAtZero(k, lower, bound)) continue;
        const Interval both = intersection(bound, Interval(lower, upper));
        if (isEmpty(both)) continue;
        if (!own) own = std::make_shared<FlowSnapshot>(*models->at[row][part]);
        own->outputs[k].bound = both;
      }
      if (!own) continue;
      if (!sharpened) sharpened = std::make_shared<FlowModels>(*models);
      sharpened->at[row][part] = std::move(own);
    }
  const std::size_t chordRows = interval.over.empty() ? 0 : std::min(models->over.size(), interval.over.lower.times);
  for (std::size_t row = 0; row < chordRows; ++row)
    for (std::size_t chord = 0; chord < models->over[row].size(); ++chord)
      for (std::size_t k = 0; k < margins.size(); ++k) {
        const auto output = static_cast<std::size_t>(margins[k]);
        const double lower = interval.over.lower(row, output), upper = interval.over.upper(row, output);
        const Interval& bound = models->over[row][chord].bound[k];
        if (!isAtZero(k, lower, bound)) continue;
        const Interval both = intersection(bound, Interval(lower, upper));
        if (isEmpty(both)) continue;
        if (!sharpened) sharpened = std::make_shared<FlowModels>(*models);
        sharpened->over[row][chord].bound[k] = both;
      }
  if (sharpened) return sharpened;
  return models;
}

/// Where zero is enough of a margin, it may begin there.
std::shared_ptr<const FlowModels> sharpenedModels(const Machine& machine, const IntervalResult& interval,
                                                  const std::shared_ptr<const FlowModels>& known) {
  const Study& study = machine.study;
  const std::vector<bool> isStrict = areStrict(study);
  const bool isAtZero = std::ranges::find(isStrict, false) != isStrict.end();
  const std::shared_ptr<const FlowModels> models = sharpenedByEnclosure(study, interval, known);
  if (!isAtZero || !machine.varying.empty() || study.horizon == 0) return models;
  return sharpenedAtStart(models, machine.equations().f, machine.equations().g, marginOutputs(study), machine.box);
}

/// Does it while there is room, and takes the time of it.
template <class Prove>
void proveWhileThereIsRoom(Run& run, Results& results, const Prove& prove) {
  RequirementsResult& all = results.requirements;
  if (all.empty()) return;
  run.watch.begin(Watch::Stage::rest);
  all.present = true;
  const auto task = [&] {
    const Charge charge(nullptr, &all.cpu);
    prove();
  };
  if (!hasRoomFor(run, task)) {
    for (RequirementResult& result : all)
      if (result.word == Decision::open) result.why = run.watch.why();
  }
  const auto open = std::ranges::find(all, Decision::open, &RequirementResult::word);
  all.why = open == all.end() ? "" : open->why;
  if (*run.watch.stop()) all.stopped = run.watch.why();
}

/// Of all requirements of a run, what is proved: by what is known of their margins, then by tighter flows.
class RequirementProof {
 public:
  RequirementProof(Run& run, const SampledMotion& samples, Enclosure& enclosure, ModelMasses& masses, Results& results)
      : run_(run),
        study_(run.study),
        samples_(samples),
        enclosure_(enclosure),
        masses_(masses),
        results_(results),
        suspects_(results.requirements.size()) {}

  void proveAll() {
    // A third of what is left is for what the enclosure's own models say, and half of what then is left for a tighter
    // flow.
    constexpr double ofKnown = 1.0 / 3;
    constexpr double parts = 128;  // of the horizon: outputs leave the chords of long steps
    if (enclosure_.models) examineAll(ofKnown);
    for (int round = 0; round < 2 && mayTighten(); ++round) {
      {
        const Charge charge(&run_.spent.requirements);
        const double longest = round == 0 ? study_.horizon : study_.horizon / parts;
        const double work = 0.5 * workForRequirements(run_);
        if (!enclosure_.models.tighten(4, work, tighterOptions(run_, longest, "requirements"))) break;
      }
      examineAll(round == 0 ? 0.5 : 1);
    }
    for (std::size_t r = 0; r < results_.requirements.size(); ++r)
      if (results_.requirements[r].word != Decision::met) proveViolation(r);
    proveAlone();
    keepCells();
  }

 private:
  /// So many are looked at, on all threads and ranks, before it is noted what was found.
  static constexpr std::size_t together = 8;

  bool mayTighten() const {
    return enclosure_.models.mayTighten() && !*run_.watch.stop() &&
           std::ranges::any_of(results_.requirements, [&](const auto& result) { return isVague(study_, result); });
  }

  std::shared_ptr<const FlowModels> models() const {
    return sharpenedModels(run_.machine, results_.interval, enclosure_.models.get());
  }

  /// With this part of the work that is left, of which each gets as much.
  void examineAll(double part) {
    const std::shared_ptr<const FlowModels> known = models();
    std::vector<std::size_t> open;
    for (std::size_t r = 0; r < results_.requirements.size(); ++r)
      if (isVague(study_, results_.requirements[r])) open.push_back(r);
    const double work = part * workForRequirements(run_) / static_cast<double>(std::max<std::size_t>(open.size(), 1));
    for (std::size_t first = 0; first < open.size(); first += together)
      examineThese(*known, std::span(open).subspan(first, std::min(together, open.size() - first)), work);
  }

  void proveViolation(std::size_t number) {
    RequirementResult& result = results_.requirements[number];
    const std::string unsettled = findViolation(run_, samples_, number, std::move(suspects_[number]), results_);
    result.isViolatedInSimulation =
        result.word == Decision::open && gamut::isViolatedInSimulation(study_, results_, number);
    if (result.word != Decision::violated) {
      Reason reason = whyOpen(number, unsettled);
      result.why = std::move(reason.why);
      result.advice = std::move(reason.advice);
    }
    if (result.word == Decision::open && enclosure_.models)
      result.metUntil = metUntil(run_.machine, *models(), study_.requirements[number]);
  }

  /// Unless it is remembered; each with this much work.
  void examineThese(const FlowModels& models, std::span<const std::size_t> these, double work) {
    const Charge charge(&run_.spent.requirements);
    CheckpointedTask checkpoint(run_.options.checkpoints);
    std::vector<std::vector<Suspect>> found(these.size());
    const auto end = [&](Archive& all) { all(results_, found, masses_); };
    if (checkpoint.recall(end, {}) != CheckpointedTask::Recalled::end) {
      std::vector<FlowSymbol> symbols;
      for (const CellQuantity& quantity : quantities()) symbols.push_back(models.components[quantity.component]);
      const JointMasses& masses = masses_.in(models.symbols, symbols);
      shareOut(
          these.size(), [&](std::size_t i) { examine(models, these[i], work, masses, found[i]); },
          [&](Archive& all, std::size_t i) {
            RequirementResult& of = results_.requirements[these[i]];
            all(of.word, of.met, of.violated, of.factor, of.probabilityLower, of.probabilityUpper, of.violationLeast,
                of.violationMost, of.violation, found[i]);
          });
      checkpoint.end(end);
    }
    for (std::size_t i = 0; i < these.size(); ++i)
      suspects_[these[i]].insert(suspects_[these[i]].begin(), found[i].begin(), found[i].end());
  }

  /// Over threads and ranks.
  template <class Task, class Result>
  void shareOut(std::size_t count, const Task& task, const Result& result) {
    forEachShared(
        run_.options.communicator, run_.options.jobs, count, run_.watch.stop(), [&] { return task; }, result);
  }

  std::vector<CellQuantity> quantities() const {
    std::vector<CellQuantity> quantities;
    for (const ConstantQuantity& of : run_.machine.constants)
      quantities.push_back({of.slot, &study_.uncertain[of.number].uncertain});
    return quantities;
  }

  /// How far each quantity alone must deviate less: with a quarter of the work that is left, of which each gets as
  /// much.
  void proveAlone() {
    std::vector<std::size_t> asked;
    for (std::size_t r = 0; r < results_.requirements.size(); ++r) {
      RequirementResult& result = results_.requirements[r];
      if (result.word == Decision::met) std::ranges::fill(result.aloneLower, 1.0);
      if (result.word == Decision::violated) std::ranges::fill(result.aloneUpper, 0.0);
      const bool isOpen = result.word == Decision::open || result.word == Decision::partly;
      if (isOpen && isModelled(result)) asked.push_back(r);
    }
    if (asked.empty() || run_.machine.constants.empty()) return;
    const Charge charge(&run_.spent.requirements);
    CheckpointedTask checkpoint(run_.options.checkpoints);
    const auto end = [&](Archive& all) { all(results_); };
    if (checkpoint.recall(end, {}) == CheckpointedTask::Recalled::end) return;
    const std::shared_ptr<const FlowModels> known = models();
    const std::size_t constants = run_.machine.constants.size(), all = asked.size() * constants;
    double left = 0.25 * workForRequirements(run_);
    for (std::size_t first = 0; first < all; first += together) {
      if (!(left > 0) || *run_.watch.stop()) break;
      const std::uint64_t before = Work::counted();
      const double work = left / static_cast<double>(all - first);
      const auto of = [&](std::size_t i) { return std::pair(asked[(first + i) / constants], (first + i) % constants); };
      shareOut(
          std::min(together, all - first), [&](std::size_t i) { proveAlone(*known, of(i).first, of(i).second, work); },
          [&](Archive& one, std::size_t i) {
            RequirementResult& result = results_.requirements[of(i).first];
            const std::size_t quantity = run_.machine.constants[of(i).second].number;
            one(result.aloneLower[quantity], result.aloneUpper[quantity]);
          });
      left -= static_cast<double>(Work::counted() - before);
    }
    checkpoint.end(end);
  }

  /// Of one of the constant quantities.
  void proveAlone(const FlowModels& models, std::size_t number, std::size_t constant, double work) {
    RequirementOptions options;
    options.mostWork = work;
    options.cancelled = run_.watch.stop();
    const Interval factor = factorAlone(models, questionOf(study_, study_.requirements[number], models.at.size()),
                                        quantities(), constant, options);
    RequirementResult& result = results_.requirements[number];
    const std::size_t quantity = run_.machine.constants[constant].number;
    result.aloneLower[quantity] = factor.lower();
    result.aloneUpper[quantity] = factor.upper();
  }

  /// Whether there are models of all of its window.
  bool isModelled(const RequirementResult& result) const {
    const std::size_t reached = enclosure_.models ? enclosure_.models->at.size() : 0;
    return reached > 0 && study_.times[reached - 1] >= result.until;
  }

  /// What single parts of the box are proved to do, for who looks for a better design: with a little of the work that
  /// is left, which takes none away from what comes later.
  void keepCells() {
    if (run_.machine.constants.empty()) return;
    CheckpointedTask checkpoint(run_.options.checkpoints);
    const auto end = [&](Archive& all) { all(results_); };
    if (checkpoint.recall(end, {}) == CheckpointedTask::Recalled::end) return;
    keepAllCells();
    checkpoint.end(end);
  }

  void keepAllCells() {
    constexpr double share = 0.1, most = 0.5 * Work::perSecond;  // the latter of a requirement
    const Work::Aside aside;
    const std::shared_ptr<const FlowModels> known = enclosure_.models ? models() : nullptr;
    const double work =
        std::min(most, share * workForRequirements(run_) / static_cast<double>(study_.requirements.size()));
    for (std::size_t r = 0; r < study_.requirements.size(); ++r) {
      const RequirementResult& result = results_.requirements[r];
      const std::vector<double> ends(study_.uncertain.size(), 1.0), starts(study_.uncertain.size(), -1.0);
      if (result.word == Decision::met || result.word == Decision::violated)
        addCell({0, r, result.word, starts, ends});
      else if (isModelled(result) && work > 0)
        keepCells(*known, r, work);
    }
  }

  void keepCells(const FlowModels& models, std::size_t number, double work) {
    constexpr std::size_t most = 3000;
    RequirementOptions options;
    options.mostCells = most;
    options.mostWork = work;
    options.cancelled = run_.watch.stop();
    const CellQuestion question = questionOf(study_, study_.requirements[number], models.at.size());
    for (const auto& [part, verdict] : decidedCells(models, question, quantities(), options)) {
      RequirementCell cell;
      cell.requirement = number;
      cell.word = verdict == Cell::Verdict::met        ? Decision::met
                  : verdict == Cell::Verdict::violated ? Decision::violated
                                                       : Decision::open;
      cell.lower.assign(study_.uncertain.size(), -1.0);
      cell.upper.assign(study_.uncertain.size(), 1.0);
      for (const ConstantQuantity& of : run_.machine.constants) {
        const int symbol = models.components[of.slot].symbol;
        if (symbol < 0) continue;
        cell.lower[of.number] = part.centre[symbol] - part.half[symbol];
        cell.upper[of.number] = part.centre[symbol] + part.half[symbol];
      }
      addCell(std::move(cell));
    }
  }

  void addCell(RequirementCell cell) {
    std::vector<RequirementCell>& cells = results_.requirements.cells;
    cell.number = static_cast<std::int64_t>(cells.size());
    cells.push_back(std::move(cell));
  }

  /// What models of the margins say of one requirement; no less than what is known of it already.
  void examine(const FlowModels& models, std::size_t number, double work, const JointMasses& masses,
               std::vector<Suspect>& suspects) {
    const Requirement& requirement = study_.requirements[number];
    const CellQuestion whole = questionOf(study_, requirement, study_.times.size());
    if (models.at.size() <= whole.from) return;
    const CellQuestion question = questionOf(study_, requirement, models.at.size());
    const std::vector<CellQuantity> quantities = this->quantities();
    RequirementOptions options;
    options.masses = &masses;
    options.mostWork = work;
    options.cancelled = run_.watch.stop();
    RequirementFinding finding = gamut::examine(models, question, quantities, options);
    if (question.until < whole.until) forgetWhatIsNotKnown(finding, requirement.demand.isAlways);
    RequirementResult& result = results_.requirements[number];
    take(result, finding);
    for (const std::vector<double>& values : {finding.violating, finding.doubtful}) {
      if (values.empty()) continue;
      std::vector<double>& all = suspects.emplace_back().values;
      all.assign(study_.uncertain.size(), RequirementResult::unknown);
      for (std::size_t i = 0; i < values.size(); ++i) all[run_.machine.constants[i].number] = values[i];
    }
    if (finding.violating.empty())
      return;  // else the models prove it; a flow of its own will tell when and by how much
    if (result.word == Decision::open) result.word = Decision::partly;
    result.violation = suspects.front().values;
  }

  /// One cause, the first that holds.
  Reason whyOpen(std::size_t number, const std::string& unsettled) const {
    const RequirementResult& result = results_.requirements[number];
    const bool isEnclosureShort = !enclosure_.why.empty() &&
                                  (!enclosure_.models || study_.times[enclosure_.models->at.size() - 1] < result.until);
    if (isEnclosureShort && result.word == Decision::open &&
        !result.isViolatedInSimulation)  // whatever came to an end later
      return {enclosure_.why, enclosure_.advice};
    if (*run_.watch.stop()) return {run_.watch.why(), adviceOf(run_.watch)};
    if (result.isViolatedInSimulation && !unsettled.empty()) return {unsettled, ""};
    if (!run_.isEnclosed()) return {"no enclosure was asked for", "study.compare with \"interval\""};
    if (isEnclosureShort) return {enclosure_.why, enclosure_.advice};
    if (!enclosure_.models) return {"models of its margins found no room", "a greater limits.enclosure_memory"};
    if (result.word != Decision::open) return {};
    if (isJustMet(study_, results_, number)) return exactly;
    if (enclosure_.models.isWorkDone())
      return {"the work that limits.requirements allows is done",
              fmt::format("limits.requirements = {:.6g}", 4 * std::max(study_.shares.requirements, 0.25))};
    return ofMargin(study_, results_, study_.requirements[number]);
  }

  Run& run_;
  const Study& study_;
  const SampledMotion& samples_;
  Enclosure& enclosure_;
  ModelMasses& masses_;
  Results& results_;
  std::vector<std::vector<Suspect>> suspects_;  // of each requirement, by models
};

}  // namespace

void stateRequirements(const Study& study, Results& results) {
  for (const Requirement& requirement : study.requirements) {
    RequirementResult& result = results.requirements.emplace_back();
    result.name = requirement.name;
    result.statement = requirement.statement;
    result.isAlways = requirement.demand.isAlways;
    result.from = requirement.demand.from;
    result.until = requirement.demand.until;
    result.margin = requirement.firstMargin;
    result.margins = static_cast<std::int64_t>(requirement.margins());
    result.violation.assign(study.uncertain.size(), RequirementResult::unknown);
    result.aloneLower.assign(study.uncertain.size(), 0.0);
    result.aloneUpper.assign(study.uncertain.size(), 1.0);
  }
  results.margins = marginsOf(study);
}

void checkRequirements(Run& run, const SampledMotion& samples, Enclosure& enclosure, ModelMasses& masses,
                       Results& results) {
  proveWhileThereIsRoom(run, results, [&] {
    RequirementProof(run, samples, enclosure, masses, results).proveAll();
    if (enclosure.models && !enclosure.models->at.empty())
      results.requirements.reached = run.study.times[enclosure.models->at.size() - 1];
  });
}

void refuteRequirements(Run& run, const SampledMotion& samples, Results& results) {
  proveWhileThereIsRoom(run, results, [&] {
    for (std::size_t r = 0; r < results.requirements.size(); ++r) {
      RequirementResult& result = results.requirements[r];
      if (result.word != Decision::open) continue;
      const std::string unsettled = findViolation(run, samples, r, {}, results);
      result.isViolatedInSimulation = result.word == Decision::open && isViolatedInSimulation(run.study, results, r);
      if (result.word != Decision::open)
        result.why.clear(), result.advice.clear();
      else if (result.isViolatedInSimulation && !unsettled.empty())
        result.why = unsettled, result.advice.clear();
    }
  });
}

}  // namespace gamut
