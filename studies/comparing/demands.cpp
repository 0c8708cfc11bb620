// What holds for every value against what holds for some of them; parts of one box that overlap; bounds that do not
// meet.
#include "studies/comparing/demands.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scalars/interval.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

bool isMetSomewhere(const RequirementResult& r) { return r.met > 0 || r.factor > 0; }
bool isViolatedSomewhere(const RequirementResult& r) { return r.word == Decision::partly || r.violated > 0; }

bool isForAll(const RequirementResult& r) { return r.word == Decision::met || r.word == Decision::violated; }

/// Whether all values of `every` show an answer of which `some`, whose values are among them, shows the opposite.
bool isRefuted(const RequirementResult& every, const RequirementResult& some) {
  return (every.word == Decision::met && isViolatedSomewhere(some)) ||
         (every.word == Decision::violated && isMetSomewhere(some));
}

std::string answerOf(const RequirementResult& r) {
  return isForAll(r)              ? std::string(wordOf(r.word)) + " for every value"
         : isViolatedSomewhere(r) ? "violated for some"
                                  : "met for some";
}

bool areApart(double lower, double upper, double otherLower, double otherUpper) {
  return upper < otherLower || otherUpper < lower;
}

/// "0.5937 to 0.5979", rounded outward.
std::string rangeOf(double lower, double upper) {
  const auto [below, above] = outwardText(lower, upper, 6);
  return below == above ? below : fmt::format("{} to {}", below, above);
}

/// Parts of one box.
bool areMoreThanAll(double part, double otherPart) { return part > (Interval(1.0) - Interval(otherPart)).upper(); }

}  // namespace

bool isSameDemand(const Results& first, const RequirementResult& one, const Results& second,
                  const RequirementResult& other) {
  const auto isSameTerm = [](const MarginInfo& a, const MarginInfo& b) {
    return a.what == b.what && a.isAbove == b.isAbove && a.limitText == b.limitText && a.isStrict == b.isStrict;
  };
  return one.isAlways == other.isAlways && one.from == other.from && one.until == other.until &&
         one.margins == other.margins && !marginsOf(first, one).empty() &&
         std::ranges::equal(marginsOf(first, one), marginsOf(second, other), isSameTerm);
}

std::string oppositionOf(const RequirementResult& one, const RequirementResult& other, const Relation& relation,
                         bool isSame, bool haveCuts) {
  const bool areOpposite = isForAll(one) && isForAll(other) && one.word != other.word;
  if ((areOpposite && (!isSame || relation.areShared)) ||
      (isSame &&
       ((relation.isSecondInFirst && isRefuted(one, other)) || (relation.isFirstInSecond && isRefuted(other, one)))))
    return fmt::format("{} in A, {} in B", answerOf(one), answerOf(other));
  if (isSame && relation.isSameQuestion() &&
      (areMoreThanAll(one.met, other.violated) || areMoreThanAll(other.met, one.violated)))
    return fmt::format("met for a part of {} and violated for one of {} in A, {} and {} in B", one.met, one.violated,
                       other.met, other.violated);
  if (relation.hasSameDistributions &&
      areApart(one.probabilityLower, one.probabilityUpper, other.probabilityLower, other.probabilityUpper))
    return fmt::format("met with a probability of {} in A, {} in B",
                       rangeOf(one.probabilityLower, one.probabilityUpper),
                       rangeOf(other.probabilityLower, other.probabilityUpper));
  if (relation.hasSameMemberships && haveCuts &&
      areApart(one.violationLeast, one.violationMost, other.violationLeast, other.violationMost))
    return fmt::format("violated with a possibility of {} in A, {} in B",
                       rangeOf(one.violationLeast, one.violationMost),
                       rangeOf(other.violationLeast, other.violationMost));
  return {};
}

}  // namespace gamut
