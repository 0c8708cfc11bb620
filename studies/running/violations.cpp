// A sample violates a requirement only as far as its integration can be believed; the thin flow of its values, and of
// the very course that a quantity took, proves it. Between output times violations are looked for where bounds leave
// doubt, at more and more instants.
#include "studies/running/violations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "analyses/requirements/cells.hpp"
#include "analyses/samples/courses.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

constexpr std::size_t mostSuspects = 1024;

bool comesFirst(const Suspect& a, const Suspect& b) {
  return a.margin != b.margin ? a.margin < b.margin : a.sample < b.sample;
}

/// Models of the margins for single values, and where what they say leaves doubt.
struct Thin {
  std::shared_ptr<const FlowModels> models;
  std::vector<double> times;                // rows of the models
  std::vector<std::vector<Interval>> over;  // [row][margin of the study]: since the time before
};

/// The motion of single values, and what of it still varies in time.
struct ThinMotion {
  Motion motion;
  Box box;
  std::vector<VaryingParameter> varying;
};

class ThinFlows {
 public:
  ThinFlows(Run& run, std::size_t number)
      : run_(run),
        requirement_(run.study.requirements[number]),
        result_(run.results.requirements[number]),
        options_(flowOptions(run.machine, run.options.jobs, run.watch.stop())) {
    constexpr double least = 2, times = 4;  // s; the enclosure's
    options_.budget = std::max(least, times * run.spent.enclosure / Work::perSecond);
  }

  /// Whether all that is known of these values is that they violate it; then when, and by how much, as far as that is
  /// told. `looksBetween`: also between output times, where doubt is left there.
  bool proves(const std::vector<double>& values, bool looksBetween) {
    ended_.clear();
    const std::optional<ThinMotion> motion = motionAt(values);
    if (!motion) return false;
    std::vector<double> times = run_.study.times;
    constexpr int mostRounds = 6;
    for (int round = 0; round <= (looksBetween ? mostRounds : 0) && !*run_.watch.stop(); ++round) {
      const Thin thin = thinAt(*motion, times);
      if (!thin.models || thin.models->at.size() <= rowOf(thin.times, requirement_.demand.from)) return false;
      const CellQuestion question = questionOf(thin);
      const bool isWhole = thin.times[question.until] == requirement_.demand.until;
      const Cell::Verdict verdict = Cells(*thin.models, question).whole()->verdict();
      // Once is enough of what must be always met; of what must be met once all of the window counts.
      if (verdict == Cell::Verdict::violated && (isWhole || requirement_.demand.isAlways)) {
        note(thin, question);
        return true;
      }
      if (verdict == Cell::Verdict::met && (isWhole || !requirement_.demand.isAlways)) return false;
      if (!addDoubtful(thin, question, times)) return false;
    }
    return false;
  }

  /// Why the last values were not found to violate it.
  std::string why() const {
    if (*run_.watch.stop()) return run_.watch.why();
    return ended_.empty() ? "a flow of its values alone does not bound its margin below zero"
                          : "a flow of its values alone ends: " + ended_;
  }
  /// Steps of all flows so far.
  long steps() const { return steps_; }

 private:
  /// Programs in which what varies takes its course; nothing where no such course is certainly meant.
  std::optional<ThinMotion> motionAt(const std::vector<double>& values) const {
    ThinMotion thin{run_.machine.equations(), run_.machine.box, run_.machine.varying};
    std::vector<VaryingQuantity> courses;
    std::vector<std::pair<int, SwitchingCourse>> switching;
    const std::vector<SwitchingCourse>* const switchingAt = run_.motion.switchingAt(values);
    std::size_t next = 0;
    for (std::size_t q = 0; q < values.size(); ++q) {
      const UncertainQuantity& quantity = run_.study.uncertain[q];
      const std::size_t course = quantity.varies ? next++ : 0;
      if (std::isnan(values[q])) continue;
      if (quantity.varies && switchingAt != nullptr) {
        const Interval inside = quantity.uncertain.inside();
        if (isEmpty(inside)) return std::nullopt;
        const int parameter = run_.machine.courses[course].parameter;
        auto& [of, switches] = switching.emplace_back(parameter, (*switchingAt)[course]);
        for (double& value : switches.values) value = std::clamp(value, inside.lower(), inside.upper());
        std::erase_if(thin.varying, [&](const VaryingParameter& input) { return input.parameter == parameter; });
        continue;
      }
      // Where an interval is no wider than roundings, nobody knows which numbers are meant: all that may be.
      const bool isNarrow = !quantity.varies && isEmpty(quantity.uncertain.inside());
      thin.box[static_cast<std::size_t>(run_.motion.slot[q])] =
          isNarrow ? quantity.uncertain.range : Interval(values[q]);
      if (!quantity.varies) continue;
      // Ends are rounded outward from decimals: the course keeps to what lies inside.
      VaryingQuantity& of = courses.emplace_back(run_.machine.courses[course]);
      of.range = quantity.uncertain.inside();
      if (isEmpty(of.range)) return std::nullopt;
      of.nominal = std::clamp(of.nominal, of.range.lower(), of.range.upper());
      std::erase_if(thin.varying, [&](const VaryingParameter& input) { return input.parameter == of.parameter; });
    }
    for (Program* program : {&thin.motion.f, &thin.motion.g}) {
      if (!switching.empty()) *program = withSwitching(*program, switching);
      if (!courses.empty()) *program = withCourses(*program, courses, run_.machine.slowest, run_.machine.fastest);
    }
    return thin;
  }

  Thin thinAt(const ThinMotion& of, const std::vector<double>& times) {
    if (run_.study.analysis == Study::Analysis::kinematics)
      return {modelImage(run_.machine.equations().g, 0.0, of.box, marginOutputs(run_.study), run_.study.flow.degree,
                         run_.watch.stop()),
              {0.0},
              {}};
    FlowOptions options = options_;
    options.varying = of.varying;
    const Tube tube = modelMarginsOf(run_.study, of.motion, std::move(options), of.box, times);
    steps_ += tube.steps();
    ended_ = tube.why();
    Thin thin{tube.models(), tube.times(), {}};
    for (std::size_t row = 0; row < tube.reachedTimes(); ++row) thin.over.push_back(tube.outputsOver(row));
    return thin;
  }

  CellQuestion questionOf(const Thin& thin) const {
    return gamut::questionOf(run_.study, requirement_, thin.times, thin.models->at.size());
  }

  /// Adds times to those gaps of the window where it may be violated (where it may be met, of what must be so once),
  /// the worst of them; false if there is nothing to add.
  bool addDoubtful(const Thin& thin, const CellQuestion& question, std::vector<double>& times) const {
    constexpr std::size_t most = 32;
    constexpr int parts = 8;
    constexpr double finest = 0x1p-30;  // of the horizon
    struct Doubtful {
      double doubt;  // the greater, the more there is to look for
      std::size_t row;
    };
    std::vector<Doubtful> gaps;
    for (std::size_t row = question.from + 1; row <= question.until && row < thin.over.size(); ++row) {
      double least = std::numeric_limits<double>::infinity(), greatest = least;
      for (std::size_t k = 0; k < question.margins.size(); ++k) {
        const Interval& over = thin.over[row][static_cast<std::size_t>(question.margins[k])];
        least = std::min(least, over.lower());
        greatest = std::min(greatest, over.upper());
      }
      const double doubt = requirement_.demand.isAlways ? -least : greatest;
      if (doubt >= 0 && thin.times[row] - thin.times[row - 1] > finest * run_.study.horizon)
        gaps.push_back({doubt, row});
    }
    std::ranges::stable_sort(gaps, std::greater<>(), &Doubtful::doubt);
    if (gaps.size() > most) gaps.resize(most);
    for (const Doubtful& gap : gaps)
      for (int part = 1; part < parts; ++part) {
        const double from = thin.times[gap.row - 1], to = thin.times[gap.row], time = from + (to - from) * part / parts;
        if (time > from && time < to) times.push_back(time);
      }
    std::ranges::sort(times);
    const auto repeated = std::ranges::unique(times);
    times.erase(repeated.begin(), repeated.end());
    return !gaps.empty();
  }

  /// When it is missed most (of what must be met once: least), and by how much; at an output time, if there is one.
  void note(const Thin& thin, const CellQuestion& question) {
    std::optional<Interval> found;
    bool isFoundBetween = false;
    for (std::size_t row = question.from; row <= question.until; ++row) {
      const bool isBetween = !std::ranges::binary_search(run_.study.times, thin.times[row]);
      for (std::size_t k = 0; k < question.margins.size(); ++k) {
        Interval bound = Interval::empty();
        for (const auto& snapshot : thin.models->at[row])
          bound = hull(bound, snapshot->outputs[static_cast<std::size_t>(question.margins[k])].bound);
        if (question.isStrict[k] != 0 ? !(bound.upper() <= 0) : !(bound.upper() < 0)) continue;
        const bool isFurther =
            found && (requirement_.demand.isAlways ? bound.upper() >= found->upper() : bound.upper() <= found->upper());
        if (found && isBetween == isFoundBetween ? isFurther : found && isBetween) continue;
        found = bound;
        isFoundBetween = isBetween;
        result_.violationTime = thin.times[row];
      }
    }
    result_.isViolatedBetween = requirement_.demand.isAlways && (!found || isFoundBetween);
    if (!found) return;
    result_.violationLower = found->lower();
    result_.violationUpper = found->upper();
  }

  Run& run_;
  const Requirement& requirement_;
  RequirementResult& result_;
  FlowOptions options_;
  long steps_ = 0;
  std::string ended_;
};

/// A corner's values are those of the rounded intervals: what is meant lies some roundings inside. Numbers beyond
/// choose courses.
std::vector<double> insideValues(const Study& study, std::vector<double> values) {
  for (std::size_t q = 0; q < values.size(); ++q)
    if (const Interval inside = study.uncertain[q].uncertain.inside();
        contains(study.uncertain[q].uncertain.range, values[q]) && !isEmpty(inside))
      values[q] = std::clamp(values[q], inside.lower(), inside.upper());
  return values;
}

/// By the degree of possibility of values that violate it whatever varies in time does.
void noteMembership(const Study& study, RequirementResult& result) {
  double degree = 1;
  for (std::size_t q = 0; q < study.uncertain.size(); ++q) {
    if (std::isnan(result.violation[q])) continue;
    if (study.uncertain[q].varies) return;
    degree = std::min(degree, study.uncertain[q].uncertain.membership(result.violation[q]));
  }
  result.violationLeast = std::max(result.violationLeast, std::min(degree, result.violationMost));
}

/// By how much the margin of the worst sample may be wrong, at the time at which it is told.
double doubtOf(const Run& run, std::size_t number) {
  constexpr double roundings = 0x1p-44;  // of the greatest that was sampled
  const RequirementResult& result = run.results.requirements[number];
  const StochasticResult& stochastic = run.results.stochastic;
  double doubt = 0;
  if (result.worstSample < 0) return doubt;
  const std::size_t row = rowOf(run.study.times, result.worstTime);
  for (const std::size_t output : run.study.requirements[number].marginOutputs()) {
    if (const Table& error = stochastic.error; !error.empty()) doubt = std::fmax(doubt, error(row, output));
    const Envelope& all = stochastic.envelope;
    if (all.empty()) continue;
    const double greatest = std::fmax(std::fabs(all.lower(row, output)), std::fabs(all.upper(row, output)));
    doubt = std::fmax(doubt, roundings * greatest);
  }
  return doubt;
}

}  // namespace

void Suspects::add(Suspect suspect) {
  all_.push_back(std::move(suspect));
  if (all_.size() < 2 * mostSuspects) return;
  std::ranges::nth_element(all_, all_.begin() + static_cast<std::ptrdiff_t>(mostSuspects), comesFirst);
  all_.resize(mostSuspects);
}

std::vector<Suspect> Suspects::sorted() const {
  std::vector<Suspect> sorted = all_;
  std::ranges::sort(sorted, comesFirst);
  if (sorted.size() > mostSuspects) sorted.resize(mostSuspects);
  return sorted;
}

std::string findViolation(Run& run, std::size_t number, std::vector<Suspect> others) {
  RequirementResult& result = run.results.requirements[number];
  constexpr long mostSteps = 20000;  // of all flows together, about: the last one ends
  ThinFlows flows(run, number);
  const std::vector<Suspect> samples = run.suspects[number].sorted();
  std::string why;
  const auto tries = [&](const Suspect& suspect, bool looksBetween) {
    if (*run.watch.stop() || flows.steps() > mostSteps) return false;
    const std::vector<double> values = insideValues(run.study, suspect.values);
    const bool isProved = flows.proves(values, looksBetween);
    if (!isProved && why.empty() && suspect.violates) why = flows.why();
    if (!isProved) return false;
    result.violation = values;
    result.violationSample = suspect.sample;
    if (result.word == Decision::open) result.word = Decision::partly;
    if (run.study.uncertain.empty()) {  // there is no other motion
      result.word = Decision::violated;
      result.violated = 1;
      result.probabilityUpper = result.probabilityLower = 0;
    }
    noteMembership(run.study, result);
    return true;
  };
  const double doubt = doubtOf(run, number);
  constexpr int mostDoubtful = 4;  // of samples whose errors are as large as what they miss
  int doubtful = 0;
  for (const Suspect& suspect : samples)
    if (suspect.violates && (-suspect.margin > doubt || ++doubtful <= mostDoubtful) && tries(suspect, false)) return {};
  for (const Suspect& suspect : others)
    if (tries(suspect, true)) return {};
  if (result.word == Decision::open && !samples.empty() && !samples.front().violates && tries(samples.front(), true))
    return {};
  return why;
}

bool isViolatedInSimulation(const Run& run, std::size_t number) {
  const RequirementResult& result = run.results.requirements[number];
  return result.worstSample >= 0 && -result.worstMargin > doubtOf(run, number);
}

bool isJustMet(const Run& run, std::size_t number) {
  const RequirementResult& result = run.results.requirements[number];
  return result.worstSample >= 0 && std::fabs(result.worstMargin) <= doubtOf(run, number);
}

}  // namespace gamut
