// One flow over a box tells by its models how much less would do; so a greater box is tried, then one that is little
// greater than what that told, since a lesser box is known more tightly.
#include "studies/running/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "analyses/flow/image.hpp"
#include "analyses/requirements/requirement.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/watch.hpp"

namespace gamut {
namespace {

class Finder {
 public:
  Finder(const Machine& machine, const ToleranceOptions& options)
      : machine_(machine), study_(machine.study), options_(options) {
    if (study_.requirements.empty()) throw std::invalid_argument("the study has no [[requirement]]");
    if (study_.uncertain.empty()) throw std::invalid_argument("the study has no [[uncertain]] quantity");
  }

  AllowedDeviations find() {
    AllowedDeviations found;
    const std::size_t count = study_.uncertain.size();
    found.nominal = violatedAtNominal();
    if (found.nominal.empty()) found.together = largest(std::vector<char>(count, 1));
    for (std::size_t q = 0; q < count; ++q) {
      done_ = static_cast<double>(q + 1) / static_cast<double>(count + 1);
      if (options_.progress) options_.progress(done_);
      AllowedDeviation& alone = found.alone.emplace_back();
      if (count == 1 || !found.nominal.empty()) {
        alone = found.together;
      } else {
        std::vector<char> deviate(count, 0);
        deviate[q] = 1;
        alone = largest(deviate);
      }
      alone.name = study_.uncertain[q].uncertain.name;
      alone.interval = inward(q, alone.factor);
    }
    return found;
  }

 private:
  /// Rounded outward, but for factor 1: as stated.
  Interval scaled(std::size_t quantity, double factor) const {
    const Uncertain& u = study_.uncertain[quantity].uncertain;
    return factor == 1 ? u.range : Interval(u.nominal) + Interval(factor) * (u.range - Interval(u.nominal));
  }

  /// The same, rounded inward.
  Interval inward(std::size_t quantity, double factor) const {
    const Uncertain& u = study_.uncertain[quantity].uncertain;
    const auto end = [&](double of) {
      return Interval(u.nominal) + Interval(factor) * (Interval(of) - Interval(u.nominal));
    };
    const double lower = end(u.range.lower()).upper(), upper = end(u.range.upper()).lower();
    return lower <= upper ? Interval(lower, upper) : Interval(u.nominal);
  }

  double worked() const { return static_cast<double>(Work::counted() - began_); }

  struct Trial {
    double proved = 0;  ///< this factor
    std::string limit;  ///< why it is less than what was tried; empty if it is not
  };

  FlowOptions ownOptions() const {
    FlowOptions options = flowOptions(machine_, options_.jobs, options_.cancelled);
    options.budget = std::max(0.1, options_.budget - worked() / Work::perSecond);
    return options;
  }

  /// Where no time passes.
  std::shared_ptr<const FlowModels> modelsOver(const Box& box) const {
    return findImage(machine_.equations().g, 0.0, box, {}, marginOutputs(study_), study_.flow.degree,
                     options_.cancelled, imageWork, machine_.remainders, machine_.plainly())
        .models;
  }

  /// A flow of the nominal values alone tells.
  std::string violatedAtNominal() const {
    Box box = machine_.box;
    for (const auto [number, slot] : machine_.constants) box[slot] = study_.uncertain[number].uncertain.nominal;
    const auto models =
        !study_.moves() ? modelsOver(machine_.within(box)) : modelMargins(machine_, ownOptions(), box).models();
    for (const Requirement& requirement : study_.requirements)
      if (models && models->at.size() > rowOf(study_.times, requirement.demand.until) &&
          Cells(*models, questionOf(study_, requirement, models->at.size())).whole()->verdict() ==
              Cell::Verdict::violated)
        return requirement.name;
    return {};
  }

  /// Deviations of these quantities `factor` times the stated ones.
  Trial attempt(const std::vector<char>& deviate, double factor) {
    std::vector<Uncertain> uncertain;
    Box box = machine_.box;
    for (std::size_t q = 0; q < study_.uncertain.size(); ++q) {
      Uncertain& u = uncertain.emplace_back(study_.uncertain[q].uncertain);
      if (deviate[q] != 0) u.range = scaled(q, factor);
      box[machine_.motion.slot[q]] = u.range;
    }
    std::vector<CellQuantity> quantities;
    std::vector<char> deviates;
    for (const auto [number, slot] : machine_.constants) {
      quantities.push_back({slot, &uncertain[number]});
      deviates.push_back(deviate[number]);
    }
    std::shared_ptr<const FlowModels> models;
    Trial trial{1, {}};
    std::string why;
    try {
      box = machine_.closed(std::move(box));
      if (!study_.moves()) {
        models = modelsOver(box);
      } else {
        const Tube tube = modelMargins(machine_, ownOptions(), box);
        models = tube.models();
        why = tube.why();
      }
    } catch (const std::invalid_argument& error) {  // no such box makes sense
      return {0, error.what()};
    } catch (const StudyError& error) {  // nor closes all loops
      return {0, error.problem()};
    }
    if (!models) return {0, why.empty() ? "the enclosure was not found" : why};
    RequirementOptions own;
    own.cancelled = options_.cancelled;
    for (const Requirement& requirement : study_.requirements) {
      const std::size_t until = rowOf(study_.times, requirement.demand.until);
      const bool reaches = models->at.size() > until;
      const CellQuestion question = questionOf(study_, requirement, models->at.size());
      if (!reaches && (requirement.demand.isAlways || question.from >= models->at.size())) return {0, why};
      const double part = guaranteedFactor(*models, question, quantities, deviates, own);
      if (part < trial.proved) trial = {part, requirement.name};
    }
    trial.proved = mulDown(trial.proved, factor);
    return trial;
  }

  /// What is proved of some factor holds of all that are less.
  AllowedDeviation largest(const std::vector<char>& deviate) {
    AllowedDeviation found;
    double tried = 1;
    const auto isCancelled = [&] {
      return (options_.cancelled != nullptr && *options_.cancelled) || worked() > options_.budget * Work::perSecond;
    };
    double least = 0, failed = 2 * options_.most;  // `least` is proved
    constexpr int mostTrials = 12;
    for (int trial = 0; trial < mostTrials && !isCancelled(); ++trial) {
      const Trial result = attempt(deviate, tried);
      if (result.limit.empty()) {
        least = std::max(least, tried);
        if (tried >= options_.most) break;
        tried = failed > options_.most ? std::min(2 * tried, options_.most) : std::sqrt(least * failed);
      } else {
        failed = std::min(failed, tried);
        least = std::max(least, result.proved);
        found.limit = result.limit;
        if (failed <= least * (1 + options_.accuracy)) break;
        const double next =
            least > 0 ? std::min(least * (1 + 2 * options_.accuracy), std::sqrt(least * failed)) : failed / 4;
        if (least == 0 && failed < 1e-3) break;
        tried = next;
      }
      if (failed <= least * (1 + options_.accuracy)) break;
    }
    found.factor = least;
    if (least >= options_.most) found.limit.clear();
    found.isUnknown = isCancelled();
    if (found.isUnknown)
      found.limit = options_.cancelled != nullptr && *options_.cancelled ? "interrupted" : "the time limit";
    return found;
  }

  const Machine& machine_;
  const Study& study_;
  const ToleranceOptions& options_;
  const std::uint64_t began_ = Work::counted();
  double done_ = 0;
};

}  // namespace

AllowedDeviations findTolerances(const Machine& machine, const ToleranceOptions& options) {
  return Finder(machine, options).find();
}

}  // namespace gamut
