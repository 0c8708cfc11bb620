// What is demanded, and what is known of it, in whole sentences.
#include "reports/plain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "reports/requirements.hpp"
#include "studies/results/extremes.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// “tip height” of 'tip height'; formulas as they are.
std::string quotedName(const std::string& what) {
  const bool isQuoted = what.size() > 2 && what.front() == '\'' && what.find('\'', 1) == what.size() - 1;
  return "\u201c" + (isQuoted ? what.substr(1, what.size() - 2) : what) + "\u201d";
}

/// Who is where: "“height”", "above 0.2 m"; without a place where a statement says more than that.
struct DemandWords {
  std::string who, where;
};

DemandWords demandWords(const Results& results, const RequirementResult& requirement) {
  const std::span<const MarginInfo> margins = marginsOf(results, requirement);
  if (margins.empty() || !std::ranges::all_of(margins, &MarginInfo::isNumber))
    return {"\u201c" + requirement.name + "\u201d", ""};
  const std::string who = quotedName(margins[0].what);
  if (margins.size() == 1) return {who, (margins[0].isAbove ? "above " : "below ") + margins[0].limitText};
  const bool isLowerFirst = margins[0].isAbove;
  return {who, fmt::format("between {} and {}", margins[isLowerFirst ? 0 : 1].limitText,
                           margins[isLowerFirst ? 1 : 0].limitText)};
}

bool isProbabilityProved(const Results& results) { return results.interval.present || results.fuzzy.present; }

/// Violated for some values, and met with hardly any probability, proved.
bool isRarelyMet(const Results& results, const RequirementResult& requirement) {
  constexpr double rare = 0.01;
  return requirement.word == Decision::partly && isProbabilityProved(results) && requirement.probabilityUpper <= rare;
}

std::string rareText(const RequirementResult& requirement) {
  return requirement.probabilityUpper > 0
             ? fmt::format("a probability of {} at most", atMostText(requirement.probabilityUpper, 2))
             : "single values without any probability";
}

class Sentence {
 public:
  Sentence(const Results& results, const RequirementResult& requirement)
      : results_(results), r_(requirement), demand_(demandWords(results, requirement)) {}

  std::string text() const {
    const std::string words = said();
    if (words.starts_with("the ")) return "T" + words.substr(1);
    return words.starts_with("in ") ? "I" + words.substr(1) : words;
  }

  std::optional<ViolationFacts> facts() const {
    if (r_.word != Decision::partly && r_.word != Decision::violated) return std::nullopt;
    std::vector<std::string> likely;
    if (r_.word == Decision::violated)
      likely.emplace_back("always");
    else if (isRarelyMet(results_, r_))
      likely.push_back("in all cases but for " + rareText(r_));
    else if (isProbabilityTelling())
      likely.push_back(violationShare(r_) + " of all cases, proved");
    if (r_.samples > 0) likely.push_back(simulatedFact());
    return ViolationFacts{(r_.word == Decision::partly ? "in some cases, " : "") + does(false) + window(),
                          fmt::format("{}", fmt::join(likely, "; ")), missedFact()};
  }

 private:
  /// With what they tell of all cases, where they do not all violate it.
  std::string simulatedFact() const {
    std::string text = fmt::format("{} of {} simulated cases{}", r_.violating, r_.samples, whereLookedAt());
    if (r_.word != Decision::violated && !std::isnan(r_.shareLower))
      text += fmt::format(", so {} of all with 95 % confidence", percentRange(1 - r_.shareUpper, 1 - r_.shareLower));
    return text;
  }

  /// Samples are known at the output times alone.
  const char* whereLookedAt() const {
    return results_.horizon == 0 || r_.from == r_.until ? "" : " at the output times";
  }

  std::string said() const {
    if (r_.word == Decision::met)
      return does(true) + (r_.isAlways ? "" : ", at least once,") + " in every case" + window() + ".";
    if (r_.word == Decision::violated) return does(true) + " in no case" + window() + "." + violation() + share();
    if (r_.word == Decision::partly) {
      const std::string what = does(false) + window() + ".";
      return (isRarelyMet(results_, r_) ? fmt::format("But for {}, {}", rareText(r_), what)
                                        : "In some cases, " + what + probability()) +
             violation() + share();
    }
    if (r_.isViolatedInSimulation)
      return fmt::format("in simulation, {}{}: {} misses {} by {}{}. That is not proved{}.{}", does(false), window(),
                         results_.stochastic.nameOf(r_.worstSample), demand_.where.empty() ? "it" : "the limit",
                         sampledMissOf(results_, r_),
                         results_.horizon > 0 ? fmt::format(" at {} s", numberText(r_.worstTime, 6)) : "",
                         r_.why.empty() ? "" : ": " + r_.why, share());
    return fmt::format("It is not decided whether {} in every case{}{}.{}{}", does(true), window(),
                       r_.why.empty() ? "" : ": " + r_.why, reach(), share());
  }

  /// How far it is decided, and what may help.
  std::string reach() const {
    std::string text;
    if (r_.metUntil > r_.from && r_.metUntil < r_.until)
      text += fmt::format(" It is until {}.", reachedText(r_.metUntil));
    if (!r_.advice.empty()) text += fmt::format(" What may help: {}.", r_.advice);
    if (const std::string probability = estimateOf(r_); !probability.empty())
      text += fmt::format(
          " By simulated cases alone, which prove nothing, it is met with a probability of {} (95 % confidence).",
          probability);
    return text;
  }

  /// "“height” stays above 0.2 m", "“height” does not stay above 0.2 m".
  std::string does(bool is) const {
    if (demand_.where.empty()) return demand_.who + (is ? " is kept" : " is not kept");
    const bool isRise = demand_.where.starts_with("above"), isFall = demand_.where.starts_with("below");
    if (r_.isAlways) return fmt::format("{} {} {}", demand_.who, is ? "stays" : "does not stay", demand_.where);
    return fmt::format("{} {} {}", demand_.who,
                       isRise   ? (is ? "rises" : "does not rise")
                       : isFall ? (is ? "falls" : "does not fall")
                                : (is ? "comes" : "does not come"),
                       demand_.where);
  }

  std::string window() const {
    if (results_.horizon == 0 || (r_.from == 0 && r_.until == results_.horizon)) return {};
    return r_.from == r_.until ? fmt::format(" at {} s", numberText(r_.from, 6))
                               : fmt::format(" from {} s to {} s", numberText(r_.from, 6), numberText(r_.until, 6));
  }

  bool isProbabilityTelling() const {
    constexpr double telling = 0.5;
    return isProbabilityProved(results_) && r_.probabilityUpper - r_.probabilityLower < telling;
  }

  /// That it is violated, as far as that is proved.
  std::string probability() const {
    if (!isProbabilityTelling()) return {};
    return fmt::format(" The proved probability of that is {}.", violationProbability(r_));
  }

  /// Whether each value of the violation is an end of its interval, but for roundings.
  bool isAtEnds() const {
    for (std::size_t q = 0; q < r_.violation.size(); ++q) {
      const UncertainInfo& of = results_.uncertain[q];
      const double value = r_.violation[q], nearest = std::min(std::abs(value - of.lower), std::abs(of.upper - value));
      if (!std::isnan(value) && !isLittle(nearest, of.upper - of.lower)) return false;
    }
    return true;
  }

  /// The case that violates it, its name, and by how much it does: "one simulated case", "sample 17", "the limit by
  /// 0.2 mm at 3 s".
  struct Violation {
    std::string who, name, missed;
    std::string named() const { return name.empty() ? who : fmt::format("{} ({})", who, name); }
  };

  std::optional<Violation> knownViolation() const {
    const bool isKnown = std::ranges::any_of(r_.violation, [](double x) { return !std::isnan(x); });
    if (!isKnown) return std::nullopt;
    const std::string name = r_.violationSample < 0 ? "" : results_.stochastic.nameOf(r_.violationSample);
    const bool isMissKnown = r_.violationUpper <= 0;
    if (name.empty() && !isMissKnown && !r_.isViolatedBetween) return std::nullopt;  // it would say nothing
    const std::string who = name.empty() ? "one case that was found"
                            : name.find("corner") != std::string::npos || isAtEnds()
                                ? "an extreme combination of the tolerances"
                            : name.find("point") != std::string::npos ? "a combination within the tolerances"
                            : name.starts_with("sample")              ? "one simulated case"
                                                                      : "an extreme case";
    const std::string what = demand_.where.empty() ? "that" : "the limit";
    if (r_.isViolatedBetween) return Violation{who, name, what + " for an instant"};
    if (!isMissKnown) return Violation{who, name, what};
    return Violation{who, name,
                     fmt::format("{} by {}{}", what, missOf(results_, r_),
                                 std::isnan(r_.violationTime) || results_.horizon == 0
                                     ? ""
                                     : fmt::format(" at {} s", numberText(r_.violationTime, 6)))};
  }

  std::string violation() const {
    const std::optional<Violation> known = knownViolation();
    if (!known) return {};
    return fmt::format("{}{} it misses {}.", r_.word == Decision::violated ? " For example, in " : " In ",
                       known->named(), known->missed);
  }

  std::string missedFact() const {
    const std::optional<Violation> known = knownViolation();
    return known ? fmt::format("{}, in {}", known->missed, known->who) : "";
  }

  std::string share() const {
    if (r_.samples == 0) return {};
    if (r_.violating == 0)
      return fmt::format(" None of {} simulated cases was seen to miss it{}.", r_.samples, whereLookedAt());
    return fmt::format(" {} of {} simulated cases {}{}.", r_.violating, r_.samples,
                       !r_.isAlways                                              ? "were not seen to meet it"
                       : r_.word == Decision::open && !r_.isViolatedInSimulation ? "seem to miss it"
                                                                                 : "miss it",
                       whereLookedAt());
  }

  const Results& results_;
  const RequirementResult& r_;
  DemandWords demand_;
};

constexpr const char* everyCase = "in every case that the stated tolerances allow";

/// When an output comes to its least and greatest, unless it is about there all the time.
std::string extremesText(const Results& results, const MotionRange& range) {
  const std::string least = whenLeast(results, range), greatest = whenGreatest(results, range);
  std::vector<std::string> parts;
  if (!least.empty() && least != "throughout") parts.push_back("least " + least);
  if (!greatest.empty() && greatest != "throughout") parts.push_back("greatest " + greatest);
  return parts.empty() ? "" : fmt::format(" It is {}.", fmt::join(parts, ", "));
}

/// Between which numbers an output stays, when it comes there, and how far apart cases are at one time.
std::string whereIs(const Results& results, std::size_t output) {
  const std::optional<MotionRange> range = bestMotionRange(results, output);
  if (!range) return "Nothing certain is known of its outputs.";
  const bool isProved = range->source == MotionRange::Source::ofProof,
             isSampled = range->source == MotionRange::Source::ofSamples;
  const std::string begin =
      isSampled ? fmt::format("In {}, ", countText(results.stochastic.integrated, "simulated case")) : "";
  const std::string end = isProved    ? fmt::format(" {}", everyCase)
                          : isSampled ? "; nothing is proved of other cases"
                                      : " in every case that is held possible";
  const OutputInfo& info = results.outputs[output];
  const auto [from, to] = peaksText(range->least.value, range->greatest.value);
  const std::string greatest = inUnit(to, info.unit);
  if (results.horizon == 0)
    return fmt::format("{}\u201c{}\u201d lies between {} and {}{}.", begin, info.name, from, greatest, end);
  const double size = motionSize(results, output);
  return fmt::format("{}\u201c{}\u201d stays between {} and {} from {} to {}{}{}.{} At {}, its spread is {} at most.",
                     begin, info.name, from, greatest, timeText(results.time.front()), reachedText(range->until),
                     range->isBetween ? "" : " (looked at the output times)", end, extremesText(results, *range),
                     range->isAtAllTimes ? "any output time" : "the times that are known",
                     inUnit(atMostText(range->width, 2, size), info.unit));
}

std::string ofRequirements(const Results& results) {
  const std::vector<RequirementResult>& all = results.requirements;
  const auto count = [&](Decision word) { return std::ranges::count(all, word, &RequirementResult::word); };
  const auto met = count(Decision::met), violated = count(Decision::violated),
             rarely = std::ranges::count_if(all, [&](const RequirementResult&r) { return isRarelyMet(results, r); }),
             partly = count(Decision::partly) - rarely;
  const auto number = static_cast<std::ptrdiff_t>(all.size());
  const auto simulated =
      std::ranges::count_if(all, [](const RequirementResult& r) { return r.isViolatedInSimulation; });
  const auto open = number - met - violated - rarely - partly - simulated;
  if (met == number)
    return number == 1   ? fmt::format("The requirement is met {}.", everyCase)
           : number == 2 ? fmt::format("Both requirements are met {}.", everyCase)
                         : fmt::format("All {} requirements are met {}.", number, everyCase);
  if (number == 1)
    return violated > 0    ? "The requirement is violated in every case that the stated tolerances allow."
           : rarely > 0    ? fmt::format("The requirement is violated, but for {}.", rareText(all.front()))
           : partly > 0    ? "The requirement can be violated within the stated tolerances."
           : simulated > 0 ? "The requirement is violated in simulated cases, which is not proved."
                           : "It is not decided whether the requirement is met in every case.";
  std::vector<std::string> parts;
  const auto add = [&](std::ptrdiff_t some, const char* one, const char* many) {
    if (some > 0)
      parts.push_back(fmt::format("{}{} {}", some, parts.empty() ? fmt::format(" of {} requirements", number) : "",
                                  some == 1 ? one : many));
  };
  add(violated, "is violated in every case", "are violated in every case");
  add(rarely, "is violated but for a tiny probability", "are violated but for a tiny probability");
  add(partly, "can be violated within the stated tolerances", "can be violated within the stated tolerances");
  add(simulated, "is violated in simulation, not proved", "are violated in simulation, not proved");
  add(open, "is not decided", "are not decided");
  add(met, "is met in every case", "are met in every case");
  return fmt::format("{}.", fmt::join(parts, "; "));
}

/// How far a run came that did not come to its end.
std::string ofEnd(const Results& results, const Verdict& verdict) {
  const std::string why = whyEnded(results), unfinished = unfinishedPart(results);
  if (why.empty() && !verdict.endsEarly)
    return unfinished.empty() ? "" : fmt::format(" The computation is incomplete: {}.", whyUnfinished(results));
  const double reached = reachedTime(results);
  const bool isShort = results.horizon > 0 && reached < results.horizon;
  return fmt::format(" The computation is incomplete{}{}.",
                     isShort ? fmt::format(", and what it says of all cases ends at {} of {}", reachedText(reached),
                                           timeText(results.horizon))
                             : "",
                     why.empty() ? "" : ": " + why);
}

}  // namespace

std::vector<std::string> plainRequirements(const Results& results) {
  std::vector<std::string> sentences;
  for (const RequirementResult& requirement : results.requirements)
    sentences.push_back(Sentence(results, requirement).text());
  return sentences;
}

std::vector<std::optional<ViolationFacts>> violationFacts(const Results& results) {
  std::vector<std::optional<ViolationFacts>> facts;
  for (const RequirementResult& requirement : results.requirements)
    facts.push_back(Sentence(results, requirement).facts());
  return facts;
}

std::string plainSummary(const Results& results, const Verdict& verdict, std::size_t output) {
  if (verdict.word == Agreement::outside)
    return "These results contradict each other: simulated cases leave what was computed as certain. Do not rely on "
           "them.";
  std::string text = !results.requirements.empty()     ? ofRequirements(results)
                     : output < results.outputs.size() ? whereIs(results, output)
                                                       : "Nothing was computed.";
  if (verdict.word == Agreement::unresolved)
    text += " Whether all simulated cases agree with this could not be decided: treat it with caution.";
  return text + ofEnd(results, verdict);
}

}  // namespace gamut
