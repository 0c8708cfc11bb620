// A sample violates a requirement only as far as its integration can be believed; the thin flow of its values, and of
// the very course that a quantity took, proves it.
#include "studies/running/violations.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "analyses/flow/image.hpp"
#include "analyses/requirements/refutation.hpp"
#include "analyses/samples/courses.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

constexpr std::size_t mostSuspects = 1024;

bool comesFirst(const Suspect& a, const Suspect& b) {
  return a.margin != b.margin ? a.margin < b.margin : a.sample < b.sample;
}

/// The motion of single values, and what of it still varies in time.
struct ThinMotion {
  Motion motion;
  Regular regular;
  Box box;
  std::vector<VaryingParameter> varying;
};

class ThinFlows {
 public:
  ThinFlows(const Run& run, const UncertainMotion& motion, const Requirement& requirement, RequirementResult& result)
      : run_(run),
        motion_(motion),
        requirement_(requirement),
        result_(result),
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
    const Demand& demand = requirement_.demand;
    const ThinQuestion asked{questionOf(run_.study, requirement_, run_.study.times.size()),
                             demand.from,
                             demand.until,
                             run_.study.times,
                             looksBetween,
                             run_.watch.stop()};
    const auto found = refute(asked, [&](const std::vector<double>& times) { return marginsOf(*motion, times); });
    if (!found) return false;
    result_.isViolatedBetween = found->isBetween;
    if (!found->margin) return true;
    result_.violationTime = found->time;
    result_.violationLower = found->margin->lower();
    result_.violationUpper = found->margin->upper();
    return true;
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
    ThinMotion thin{run_.machine.equations(), run_.machine.regular, run_.machine.box, run_.machine.varying};
    std::vector<VaryingQuantity> courses;
    std::vector<std::pair<int, SwitchingCourse>> switching;
    const std::vector<SwitchingCourse>* const switchingAt = motion_.switchingAt(values);
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
      thin.box[motion_.slot[q]] = isNarrow ? quantity.uncertain.range : Interval(values[q]);
      if (!quantity.varies) continue;
      // Ends are rounded outward from decimals: the course keeps to what lies inside.
      VaryingQuantity& of = courses.emplace_back(run_.machine.courses[course]);
      of.range = quantity.uncertain.inside();
      if (isEmpty(of.range)) return std::nullopt;
      of.nominal = std::clamp(of.nominal, of.range.lower(), of.range.upper());
      std::erase_if(thin.varying, [&](const VaryingParameter& input) { return input.parameter == of.parameter; });
    }
    thin.box = run_.machine.within(std::move(thin.box));
    for (Program* program : {&thin.motion.f, &thin.motion.g, &thin.regular.values}) {
      if (program->outputs() == 0) continue;
      if (!switching.empty()) *program = withSwitching(*program, switching);
      if (!courses.empty()) *program = withCourses(*program, courses, run_.machine.slowest, run_.machine.fastest);
    }
    return thin;
  }

  ThinMargins marginsOf(const ThinMotion& of, const std::vector<double>& times) {
    if (!run_.study.moves())
      return {findImage(run_.machine.equations().g, 0.0, of.box, {}, marginOutputs(run_.study), run_.study.flow.degree,
                        run_.watch.stop(), imageWork, run_.machine.remainders, run_.machine.plainly())
                  .models,
              {0.0}};
    FlowOptions options = options_;
    options.varying = of.varying;
    const Tube tube = modelMarginsOf(run_.study, of.motion, of.regular, std::move(options), of.box, times);
    steps_ += tube.steps();
    ended_ = tube.why();
    ThinMargins thin{tube.models(), tube.times()};
    for (std::size_t row = 0; row < tube.reachedTimes(); ++row) thin.over.push_back(tube.outputsOver(row));
    return thin;
  }

  const Run& run_;
  const UncertainMotion& motion_;  // with the switching courses that samples follow
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
double doubtOf(const Study& study, const Results& results, std::size_t number) {
  constexpr double roundings = 0x1p-44;  // of the greatest that was sampled
  const RequirementResult& result = results.requirements[number];
  const StochasticResult& stochastic = results.stochastic;
  double doubt = 0;
  if (result.worstSample < 0) return doubt;
  const std::size_t row = rowOf(study.times, result.worstTime);
  for (const std::size_t output : study.requirements[number].marginOutputs()) {
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

std::string findViolation(const Run& run, const SampledMotion& samples, std::size_t number, std::vector<Suspect> others,
                          Results& results) {
  const Study& study = run.study;
  RequirementResult& result = results.requirements[number];
  constexpr long mostSteps = 20000;  // of all flows together, about: the last one ends
  ThinFlows flows(run, samples.motion, study.requirements[number], result);
  const std::vector<Suspect> sampled = samples.suspects[number].sorted();
  std::string why;
  const auto tries = [&](const Suspect& suspect, bool looksBetween) {
    if (*run.watch.stop() || flows.steps() > mostSteps) return false;
    const std::vector<double> values = insideValues(study, suspect.values);
    const bool isProved = flows.proves(values, looksBetween);
    if (!isProved && why.empty() && suspect.violates) why = flows.why();
    if (!isProved) return false;
    result.violation = values;
    result.violationSample = suspect.sample;
    if (result.word == Decision::open) result.word = Decision::partly;
    if (study.uncertain.empty()) {  // there is no other motion
      result.word = Decision::violated;
      result.violated = 1;
      result.probabilityUpper = result.probabilityLower = 0;
    }
    noteMembership(study, result);
    return true;
  };
  const double doubt = doubtOf(study, results, number);
  constexpr int mostDoubtful = 4;  // of samples whose errors are as large as what they miss
  int doubtful = 0;
  for (const Suspect& suspect : sampled)
    if (suspect.violates && (-suspect.margin > doubt || ++doubtful <= mostDoubtful) && tries(suspect, false)) return {};
  for (const Suspect& suspect : others)
    if (tries(suspect, true)) return {};
  if (result.word == Decision::open && !sampled.empty() && !sampled.front().violates && tries(sampled.front(), true))
    return {};
  return why;
}

bool isViolatedInSimulation(const Study& study, const Results& results, std::size_t number) {
  const RequirementResult& result = results.requirements[number];
  return result.worstSample >= 0 && -result.worstMargin > doubtOf(study, results, number);
}

bool isJustMet(const Study& study, const Results& results, std::size_t number) {
  const RequirementResult& result = results.requirements[number];
  return result.worstSample >= 0 && std::fabs(result.worstMargin) <= doubtOf(study, results, number);
}

}  // namespace gamut
