// What the file says of requirements.
#include "studies/results/requirements.hpp"

#include <algorithm>
#include <functional>

namespace gamut {
namespace {

std::vector<Field> fieldsOfDemand(RequirementResult& r) {
  return {{"name", &r.name, unit::none, "as in the study"},
          {"statement", &r.statement, unit::none, "what is demanded"},
          {"always", &r.isAlways, unit::none, "1: at all times of the window; 0: once at least"},
          {"from", &r.from, unit::second, "begin of the window"},
          {"until", &r.until, unit::second, "end of the window"},
          {"margin", &r.margin, unit::none, "index of the output that is its first margin: above zero where it is met",
           allowed::count, dimension::output},
          {"margins", &r.margins, unit::none, "so many outputs from there on are its margins", {1, 2}},
          {"word", Choice::of(r.word), unit::none,
           "guaranteed: \"met\" or \"violated\" (for every value of the uncertain quantities), \"partly\" (violated "
           "for some), \"open\""},
          {"why", &r.why, unit::none, "why no more is known; empty if all is"},
          {"advice", &r.advice, unit::none,
           "what may help: a key of a study and its value, or words; empty if nothing is known to"},
          {"met_until", &r.metUntil, unit::second,
           "always: it is met for every value up to this output time; NaN: not even at the first one of the window"}};
}

std::vector<Field> fieldsOfGuarantee(RequirementResult& r) {
  return {
      {"met", &r.met, unit::one, "part of the uncertain box for which it is proved to be met", allowed::share},
      {"violated", &r.violated, unit::one, "part for which it is proved to be violated", allowed::share},
      {"factor", &r.factor, unit::one,
       "it is proved to be met where deviations from the nominal values are up to so many times those of the "
       "intervals; 1: for all",
       allowed::share},
      fresh({"alone_lower",
             &r.aloneLower,
             unit::one,
             "it is proved to be met where this quantity alone deviates by up to so many times what is stated, and all "
             "others by as much as is stated; 0: that is proved of no factor",
             {dimension::quantity},
             allowed::share}),
      fresh({"alone_upper",
             &r.aloneUpper,
             unit::one,
             "where it deviates by as much or more, that is proved to violate it for some values; 0: whatever that "
             "quantity is; 1: of no lesser factor is that known",
             {dimension::quantity},
             allowed::share}),
      {"violation",
       &r.violation,
       unit::ofQuantity,
       "values for which it is proved to be violated; of what varies in time, the number that chooses its course; NaN "
       "where none are known, or whatever it does",
       {dimension::quantity}},
      {"violation_sample",
       &r.violationSample,
       unit::none,
       "number of the sample that has these values, or, at an interval's end, some roundings beside them; -1: none has",
       {-1, allowed::count.greatest}},
      {"violation_between", &r.isViolatedBetween, unit::none,
       "1: these violate it between output times alone, as far as that is proved"},
      {"violation_time", &r.violationTime, unit::second,
       "when they violate it, at an output time unless violation_between says otherwise; NaN: it is not known when"},
      {"violation_lower", &r.violationLower, unit::none, "lower bound of the margin there, in its unit"},
      {"violation_upper", &r.violationUpper, unit::none, "upper bound"}};
}

std::vector<Field> fieldsOfSampling(RequirementResult& r) {
  return {{"probability_lower", &r.probabilityLower, unit::one, "proved bound of the probability that it is met",
           allowed::share},
          {"probability_upper", &r.probabilityUpper, unit::one, "upper bound", allowed::share},
          {"samples", &r.samples, unit::none, "samples of the plan that arrived", allowed::count},
          {"violating", &r.violating, unit::none, "of these, violate it at the output times", allowed::count},
          {"share_lower", &r.shareLower, unit::one,
           "95 % confidence interval (Clopper and Pearson) of the probability that it is met at the output times; NaN "
           "unless all samples arrived and are independent"},
          {"share_upper", &r.shareUpper, unit::one, "its upper end"},
          {"worst_sample",
           &r.worstSample,
           unit::none,
           "number of the sample that comes closest to violating it, or violates it most; -1: none",
           {-1, allowed::count.greatest}},
          {"worst_time", &r.worstTime, unit::second, "when"},
          {"worst_margin", &r.worstMargin, unit::none, "its margin then, in its unit"},
          {"violated_in_simulation", &r.isViolatedInSimulation, unit::none,
           "1: the word is \"open\", and it misses the requirement by more than the error of its integration"}};
}

std::vector<Field> fieldsOfEstimate(RequirementResult& r) {
  return {
      {"estimate_samples", &r.estimate.samples, unit::none,
       "where the proof ends before the window does: independent samples besides, from which the probability that it "
       "is met is estimated",
       allowed::count},
      {"estimate_met", &r.estimate.met, unit::none, "of these, meet it at the output times", allowed::count},
      {"estimate_violated", &r.estimate.violated, unit::none, "violate it there; the others did not arrive",
       allowed::count},
      {"estimate_lower", &r.estimate.lower, unit::one,
       "95 % confidence interval (Clopper and Pearson) of that probability, whatever those that did not arrive would "
       "have done: sampled, not proved; NaN without samples"},
      {"estimate_upper", &r.estimate.upper, unit::one, "its upper end"},
      {"estimate_first_order", &r.estimate.firstOrder, unit::one,
       "the probability that it would have if the worst margin were the linear function of the quantities that fits "
       "the first samples best; NaN where none does"},
      {"violation_possibility_lower", &r.violationLeast, unit::one,
       "proved bound of the possibility that it is violated; its necessity is 1 minus the possibility", allowed::share},
      {"violation_possibility_upper", &r.violationMost, unit::one, "upper bound", allowed::share}};
}

std::vector<Field> fieldsOf(RequirementResult& r) {
  std::vector<Field> all = fieldsOfDemand(r);
  for (const auto& part : {fieldsOfGuarantee(r), fieldsOfSampling(r), fieldsOfEstimate(r)})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<Field> fieldsOfMargin(MarginInfo& m) {
  using dimension::output;
  return {{"margin", &m.output, unit::none,
           "index of the output that is the margin: above zero where the limit is kept", allowed::count, output},
          {"what", &m.what, unit::none, "what is limited, as the study states it"},
          {"above", &m.isAbove, unit::none, "1: it is to be above its limit; 0: below"},
          {"limit_text", &m.limitText, unit::none, "of what, as the study states it"},
          {"limit_unit", &m.unit, unit::none, "unit in which it does; empty where that is no number with a unit"},
          {"strict", &m.isStrict, unit::none, "0: the limit itself is allowed"},
          {"number", &m.isNumber, unit::none, "1: the limit is stated as a number, and what is limited is none"},
          {"limited", &m.limited, unit::none,
           "index of the output that is limited by a number; that of the margin where there is none", allowed::count,
           output},
          {"limit", &m.limit, unit::none, "that number, in the unit of that output"}};
}

std::vector<Field> fieldsOfCell(RequirementCell& c) {
  return {{"number", &c.number, unit::none, "number of the cell", allowed::count},
          {"requirement", &c.requirement, unit::none, "index of the requirement", allowed::count, "/requirements/name"},
          {"word", Choice::of(c.word), unit::none,
           "\"met\" or \"violated\" for all values in the cell, \"open\" where neither is proved"},
          {"lower",
           &c.lower,
           unit::one,
           "where the cell begins: -1 is the lower end of the quantity's interval, 1 the upper one",
           {dimension::quantity},
           {-1, 1}},
          {"upper", &c.upper, unit::one, "where it ends", {dimension::quantity}, {-1, 1}}};
}

std::vector<Field> fieldsOfProof(RequirementsResult& r) { return r.fieldsAnd({}); }

}  // namespace

void describe(std::vector<MarginInfo>& margins, std::vector<Group>& groups) {
  groups.push_back(listOf("/margins", "what requirements limit", "/margins/margin", margins, fieldsOfMargin));
}

void RequirementsResult::describe(std::vector<Group>& groups) {
  std::vector<RequirementResult>& requirements = *this;
  groups.push_back(listOf("/requirements", "what the motion is to keep", "/requirements/name", requirements, fieldsOf));
  groups.back().inJson = {{"always", ""},
                          {"margin", ""},
                          {"margins", ""},
                          {"word", "guaranteed"},
                          {"alone", "alone/*"},
                          {"violation", "violation/*"},
                          {"violation_sample", ""},
                          {"violation_between", ""},
                          {"violation_time", ""},
                          {"violation_lower", ""},
                          {"violation_upper", ""},
                          {"share", "confidence"},
                          {"worst_time", "simulated_violation/time"},
                          {"worst_margin", "simulated_violation/margin"},
                          {"violated_in_simulation", ""},
                          {"estimate_samples", "estimate/samples"},
                          {"estimate_met", "estimate/met"},
                          {"estimate_violated", "estimate/violated"},
                          {"estimate", "estimate/confidence"},
                          {"estimate_first_order", "estimate/first_order"}};
  groups.back().makesSense = [&requirements](std::size_t i) {
    const RequirementResult& r = requirements[i];
    return r.probabilityLower <= r.probabilityUpper && r.violationLeast <= r.violationMost &&
           r.violating <= r.samples && r.estimate.met + r.estimate.violated <= r.estimate.samples &&
           isInterval(r.violationLower, r.violationUpper) && r.from <= r.until &&
           std::ranges::equal(r.aloneLower, r.aloneUpper, std::less_equal<>());
  };
  groups.push_back(groupOf("/requirements/proof", "how their proof ended", *this, fieldsOfProof));
  groups.push_back(listOf("/requirements/cells", "parts of the uncertain box, of each requirement all of it",
                          "/requirements/cells/number", cells, fieldsOfCell));
  groups.back().makesSense = [this](std::size_t i) {
    return std::ranges::equal(cells[i].lower, cells[i].upper, std::less_equal<>());
  };
}

}  // namespace gamut
