#include "reports/requirements.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <optional>

#include "studies/results/extremes.hpp"
#include "studies/results/instants.hpp"
#include "studies/told.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

constexpr std::size_t mostShown = 200;  // on a page; some 300 kB

/// Of a text without a number 0, of one too small for a double what is left of it.
double numberIn(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

constexpr const char* nothing = "0 to 1";

/// "0.9684 to 0.9702", outward; "1" of a number that is exactly known; `nothing` where that is what is known.
std::string rangeOfShare(double lower, double upper) {
  if (lower == upper) return numberText(lower, 6);
  const auto [low, high] = outwardBounds(lower, upper, 1, 3);
  return fmt::format("{} to {}", numberIn(low) <= 0 ? "0" : low, numberIn(high) >= 1 ? "1" : high);
}

/// "first angle 136.298 deg": the digits tell values within the interval apart.
std::string valueText(const UncertainInfo& quantity, double value) {
  const Told told(quantity);
  const double size = std::max(std::fabs(quantity.lower), std::fabs(quantity.upper));
  const int digits = std::max(6, digitsFor(size, quantity.upper - quantity.lower, 5));
  return inUnit(fmt::format("{} {}", quantity.name, numberText(told.of(value), digits)), told.unit());
}

/// Of the probability that it is violated: 1 - p is exact from 0.5 to 1 (Sterbenz) and at 0; else its next neighbour
/// bounds it.
std::pair<double, double> violationBounds(const RequirementResult& requirement) {
  const auto complement = [](double p, double towards) {
    return p == 0 || p >= 0.5 ? 1 - p : std::nextafter(1 - p, towards);
  };
  return {complement(requirement.probabilityUpper, 0), complement(requirement.probabilityLower, 1)};
}

/// x rounded down, never above x.
std::string atLeastText(double x, int digits) {
  const std::string below = atMostText(-x, digits);
  return below.starts_with('-') ? below.substr(1) : below == "0" ? below : "-" + below;
}

class RequirementWording {
 public:
  RequirementWording(const Results& results, const RequirementResult& requirement)
      : results_(results), r_(requirement) {}

  RequirementWords words() const {
    return {r_.name,
            r_.statement + window(),
            r_.isViolatedInSimulation ? "simulated" : std::string(wordOf(r_.word)),
            r_.isViolatedInSimulation       ? "violated in simulation, not proved"
            : r_.word == Decision::met      ? "met"
            : r_.word == Decision::violated ? "violated"
            : r_.word == Decision::partly   ? "violated for some values"
                                            : open(),
            guaranteed(),
            probable(),
            results_.fuzzy.present ? possible() : "",
            estimated()};
  }

 private:
  std::string window() const {
    if (results_.horizon == 0 || (r_.from == 0 && r_.until == results_.horizon)) return {};
    return r_.from == r_.until ? fmt::format(", at {} s", numberText(r_.from, 6))
                               : fmt::format(", from {} s to {} s", numberText(r_.from, 6), numberText(r_.until, 6));
  }

  /// What is not proved for want of time that is.
  std::string open() const {
    const std::optional<double> end = endOfProof(results_);
    if (!end || !(*end < r_.until)) return "open";
    return r_.metUntil < r_.until ? fmt::format("not proved behind {}", reachedText(r_.metUntil)) : "not proved";
  }

  std::string guaranteed() const {
    if (r_.word == Decision::met)
      return "met for every value" + std::string(results_.horizon == 0 ? ""
                                                 : r_.isAlways         ? ", at every instant"
                                                                       : ", at every instant that counts");
    if (r_.word == Decision::violated) return "violated for every value" + violation();
    std::string text = r_.word == Decision::partly ? "violated for some values" + violation()
                       : r_.isViolatedInSimulation ? "not proved, but violated in simulation" + simulation()
                                                   : "neither proved nor refuted";
    if (r_.word == Decision::open && !r_.why.empty()) text += ": " + r_.why;
    if (r_.word == Decision::open && !r_.advice.empty()) text += fmt::format(" (what may help: {})", r_.advice);
    if (r_.word == Decision::open && r_.metUntil > r_.from && r_.metUntil < r_.until)
      text += fmt::format("; met until {} of {}", reachedText(r_.metUntil), timeText(r_.until));
    if (r_.factor > 0)
      text += fmt::format("; met where all deviate by up to {} of what is stated", percentText(r_.factor));
    if (r_.met > 0) text += fmt::format("; met for {} of the box", percentText(r_.met));
    return text;
  }

  /// ", by sample 17 (short by 0.27 mm at 3.2 s)".
  std::string simulation() const {
    return fmt::format(", by {} (short by {}{})", results_.stochastic.nameOf(r_.worstSample),
                       sampledMissOf(results_, r_),
                       results_.horizon > 0 ? fmt::format(" at {} s", numberText(r_.worstTime, 6)) : "");
  }

  /// "angle 0.51 rad, … (short by 0.0012 m at 0.8 s)".
  std::string violation() const {
    std::vector<std::string> values;
    for (std::size_t q = 0; q < r_.violation.size(); ++q)
      if (std::isnan(r_.violation[q]))
        continue;
      else if (variesInTime(results_.uncertain[q]))
        values.push_back(fmt::format("{} as it varies there", results_.uncertain[q].name));
      else
        values.push_back(valueText(results_.uncertain[q], r_.violation[q]));
    if (values.empty()) return {};
    constexpr std::size_t most = 6;
    const std::size_t others = values.size() > most ? values.size() - most : 0;
    if (others > 0) values.resize(most);
    std::string text = fmt::format(
        ", as by {}{}{}", r_.violationSample < 0 ? "" : results_.stochastic.nameOf(r_.violationSample) + ": ",
        fmt::join(values, ", "), others > 0 ? fmt::format(" and {} more", others) : std::string());
    if (r_.isViolatedBetween && (std::isnan(r_.violationUpper) || std::isnan(r_.violationTime)))
      text += " (between output times)";
    else if (!std::isnan(r_.violationUpper) && r_.violationUpper <= 0)
      text += fmt::format(" (short by {}{})", missOf(results_, r_),
                          results_.horizon > 0 ? fmt::format(" at {} s", numberText(r_.violationTime, 6)) : "");
    return text;
  }

  std::string probable() const {
    std::vector<std::string> parts;
    const bool isProved = results_.interval.present || results_.fuzzy.present;
    if (isProved && rangeOfShare(r_.probabilityLower, r_.probabilityUpper) == nothing)
      parts.push_back("nothing is proved of the probability" +
                      (r_.word == Decision::partly && !r_.why.empty() ? ": " + r_.why : ""));
    else if (isProved)
      parts.push_back(fmt::format("violated with a probability of {}, proved", violationProbability(r_)));
    if (r_.samples > 0) {
      std::string share = fmt::format("{} of {} samples meet it{}", r_.samples - r_.violating, r_.samples,
                                      results_.horizon > 0 ? " at the output times" : "");
      if (!std::isnan(r_.shareLower))
        share += fmt::format(" (95 % confidence: {})", rangeOfShare(r_.shareLower, r_.shareUpper));
      parts.push_back(std::move(share));
    }
    return fmt::format("{}", fmt::join(parts, "; "));
  }

  std::string estimated() const {
    const std::string probability = estimateOf(r_);
    if (probability.empty()) return {};
    const RequirementEstimate& of = r_.estimate;
    const std::int64_t missing = of.samples - of.met - of.violated;
    std::string text = fmt::format(
        "of {} independent samples {} meet it at the output times{}: a probability of {} with 95 % confidence "
        "(sampled, "
        "not proved)",
        of.samples, of.met, missing > 0 ? fmt::format(", {} did not arrive", missing) : "", probability);
    constexpr double least = 1e-4;  // of that the share of a linear function is known to as much
    if (std::isnan(of.firstOrder)) return text;
    return text + (of.firstOrder > 1 - least ? "; to first order more than 0.9999"
                   : of.firstOrder < least   ? "; to first order less than 0.0001"
                                             : fmt::format("; to first order {}", numberText(of.firstOrder, 4)));
  }

  std::string possible() const {
    const std::string possibility = rangeOfShare(r_.violationLeast, r_.violationMost);
    if (possibility == nothing) return "nothing is proved of the possibility";
    return fmt::format("violated with a possibility of {}, met with a necessity of {}", possibility,
                       rangeOfShare(1 - r_.violationMost, 1 - r_.violationLeast));
  }

  const Results& results_;
  const RequirementResult& r_;
};

/// In the margin's unit, and in that in which the limit is stated, if that is another: "0.25 rad (14.3 deg)".
std::string missText(const Results& results, const RequirementResult& requirement, double miss) {
  const std::string& unit = results.outputs[requirement.margin].unit;
  const double size = motionSize(results, requirement.margin);
  const std::string text = inUnit(tellingText(miss, size, 3), unit);
  if (isLittle(miss, size)) return text;
  for (const MarginInfo& margin : marginsOf(results, requirement))
    if (const Told stated(unit, margin.unit); stated.of(1.0) != 1)  // not "°" beside "deg"
      return fmt::format("{} ({})", text, inUnit(numberText(stated.of(miss), 3), stated.unit()));
  return text;
}

/// Whether values of the others alone violate it, whichever quantity has none but its nominal value.
bool isAloneRefuted(const RequirementResult& requirement) {
  const std::vector<double>& upper = requirement.aloneUpper;
  return requirement.word != Decision::met && upper.size() > 1 &&
         std::ranges::all_of(upper, [](double factor) { return factor == 0; });
}

/// A quantity of which a narrower tolerance would do alone.
struct WayAlone {
  std::string name, enough, stated;  ///< the latter two: that tolerance, and the one that is stated
};

/// Three at most, that which need shrink least first.
std::vector<WayAlone> waysAlone(const Results& results, const RequirementResult& requirement) {
  const std::vector<double>& lower = requirement.aloneLower;
  std::vector<WayAlone> ways;
  if (requirement.word == Decision::met || lower.size() < 2 || lower.size() != results.uncertain.size()) return ways;
  std::vector<std::size_t> enough(lower.size());
  std::iota(enough.begin(), enough.end(), std::size_t{0});
  std::erase_if(enough, [&](std::size_t q) { return !(lower[q] > 0); });
  std::ranges::stable_sort(enough, std::greater<>(), [&](std::size_t q) { return lower[q]; });
  constexpr std::size_t most = 3;
  enough.resize(std::min(most, enough.size()));
  for (const std::size_t q : enough) {
    const UncertainInfo& of = results.uncertain[q];
    ways.push_back({of.name, narrowedText(of, lower[q]), of.stated.empty() ? narrowedText(of, 1) : of.stated});
  }
  return ways;
}

bool isViolated(const RequirementResult& requirement) {
  return requirement.word == Decision::violated || requirement.word == Decision::partly;
}

}  // namespace

std::string violationProbability(const RequirementResult& requirement) {
  const auto [least, most] = violationBounds(requirement);
  if (least == most) return numberText(most, 6);
  if (least == 0) return atMostText(most, 4) + " at most";
  const auto [from, to] = outwardBounds(least, most, 1, 2, 1e-3);
  return fmt::format("{} to {}", from, numberIn(to) >= 1 ? "1" : to);
}

std::string violationShare(const RequirementResult& requirement) {
  const auto [least, most] = violationBounds(requirement);
  return percentRange(least, most);
}

std::string percentRange(double least, double most) {
  // What is multiplied is off by half a unit in the last place at most.
  const double from = least == 0 ? 0 : std::nextafter(100 * least, 0.0),
               to = most == 1 ? 100 : std::nextafter(100 * most, 100.0);
  if (from == 0) return atMostText(to, 3) + " % at most";
  const auto [lower, upper] = outwardBounds(from, to, 100, 2, 0.1);
  return lower == upper ? lower + " %" : fmt::format("{} to {} %", lower, numberIn(upper) >= 100 ? "100" : upper);
}

std::string percentText(double share) { return numberText(std::floor(1000 * share) / 10, 4) + " %"; }

bool variesInTime(const UncertainInfo& quantity) { return quantity.distribution.starts_with("varies"); }

std::string missOf(const Results& results, const RequirementResult& requirement) {
  return missText(results, requirement, -0.5 * (requirement.violationLower + requirement.violationUpper));
}

std::string sampledMissOf(const Results& results, const RequirementResult& requirement) {
  return missText(results, requirement, -requirement.worstMargin);
}

std::string estimateOf(const RequirementResult& requirement) {
  const RequirementEstimate& of = requirement.estimate;
  const bool isOpen = requirement.word == Decision::open || requirement.word == Decision::partly;
  if (!isOpen || of.samples == 0 || std::isnan(of.lower)) return {};
  constexpr int digits = 5;
  const auto [lower, upper] = outwardText(of.lower, of.upper, digits);
  return of.upper == 1   ? "at least " + lower
         : of.lower == 0 ? "at most " + upper
                         : fmt::format("{} to {}", lower, upper);
}

std::vector<RequirementWords> wordsOfRequirements(const Results& results) {
  std::vector<RequirementWords> words;
  for (const RequirementResult& requirement : results.requirements)
    words.push_back(RequirementWording(results, requirement).words());
  return words;
}

std::string stateOf(const RequirementResult& requirement) {
  return requirement.isViolatedInSimulation     ? "violated in simulation"
         : requirement.word == Decision::partly ? "violated"
                                                : std::string(wordOf(requirement.word));
}

int severityOf(const RequirementResult& requirement) {
  return requirement.word == Decision::violated ? 0
         : requirement.word == Decision::partly ? 1
         : requirement.isViolatedInSimulation   ? 2
         : requirement.word == Decision::open   ? 3
                                                : 4;
}

std::vector<std::size_t> shownRequirements(const Results& results) {
  std::vector<std::size_t> shown(results.requirements.size());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  std::ranges::stable_sort(shown, {}, [&](std::size_t r) {
    const RequirementResult& requirement = results.requirements[r];
    return std::pair(severityOf(requirement),
                     requirement.word == Decision::partly ? requirement.probabilityLower : 0.0);
  });
  shown.resize(std::min(shown.size(), mostShown));
  return shown;
}

std::string unshownRequirements(const Results& results) {
  const std::size_t count = results.requirements.size();
  return count > mostShown ? fmt::format("and {} more in the results file", count - mostShown) : "";
}

Decision wordOfRequirements(const Results& results) {
  if (std::ranges::any_of(results.requirements, isViolated)) return Decision::violated;
  return std::ranges::all_of(results.requirements, [](const RequirementResult& r) { return r.word == Decision::met; })
             ? Decision::met
             : Decision::open;
}

std::string shrinkSentence(const RequirementResult& requirement) {
  return requirement.factor > 0 && requirement.word != Decision::met
             ? fmt::format(" It is met in every case if all tolerances shrink to {} of what is stated.",
                           percentText(requirement.factor))
             : "";
}

std::string narrowedText(const UncertainInfo& quantity, double factor) {
  constexpr double alike = 1e-6;
  constexpr int digits = 3;
  const Interval nominal(quantity.nominal), below = Interval(factor) * (nominal - Interval(quantity.lower)),
                                            above = Interval(factor) * (Interval(quantity.upper) - nominal);
  const Told told(quantity);
  const Interval &less = below.lower() < above.lower() ? below : above,
                 &more = below.lower() < above.lower() ? above : below;
  const bool isAlike = more.upper() <= (1 + alike) * less.lower(),
             isShare = quantity.stated.empty() || quantity.stated.find('%') != std::string::npos;
  if (isAlike && isShare && quantity.nominal != 0)
    return fmt::format("± {} %", atLeastText((Interval(100.0) * less / abs(nominal)).lower(), digits));
  if (isAlike && !quantity.stated.starts_with('['))
    return "± " + inUnit(atLeastText(told.of(less).lower(), digits), told.unit());
  const double lower = told.of(nominal - below).upper(), upper = told.of(nominal + above).lower();
  const int shown = digitsFor(std::max(std::fabs(lower), std::fabs(upper)), upper - lower, digits);
  return inUnit(fmt::format("[{}, {}]", atMostText(lower, shown), atLeastText(upper, shown)), told.unit());
}

std::string aloneSentence(const Results& results, const RequirementResult& requirement) {
  std::string text;
  for (const WayAlone& way : waysAlone(results, requirement))
    text += fmt::format("{}{} at {} instead of {}", text.empty() ? " One tolerance alone would do: " : ", or ",
                        way.name, way.enough, way.stated);
  if (!text.empty()) return text + ".";
  return isAloneRefuted(requirement) ? " No tolerance would do alone, however tight." : "";
}

std::string holdsText(const Results& results, const RequirementResult& requirement) {
  const bool isFactorKnown = requirement.factor > 0 && requirement.word != Decision::met;
  std::string text =
      isFactorKnown ? fmt::format("if all tolerances shrink to {} of what is stated", percentText(requirement.factor))
                    : "";
  const std::vector<WayAlone> ways = waysAlone(results, requirement);
  for (const WayAlone& way : ways)
    text += fmt::format("{}{} alone shrinks from {} to {}", text.empty() ? "if " : ", or ", way.name, way.stated,
                        way.enough);
  if (ways.empty() && isAloneRefuted(requirement))
    text += text.empty() ? "by no tolerance alone, however tight" : "; by none alone, however tight";
  return text;
}

}  // namespace gamut
