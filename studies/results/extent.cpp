// From the stored numbers. What cannot be told counts as less.
#include "studies/results/extent.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gamut {
namespace {

/// Of what was asked for; 0 where nothing was.
double shareOf(const Results& results, const Answer& answer) {
  if (!answer.present) return 0;
  if (results.horizon > 0) return std::min(1.0, answer.reached / results.horizon);
  return answer.why.empty() ? 1 : 0;
}

/// Looser may be what came farther.
bool isAsTight(const Results& one, const Results& other) {
  if (!other.interval.present || shareOf(one, one.interval) > shareOf(other, other.interval)) return true;
  return std::isnan(other.interval.tightness) || one.interval.tightness <= other.interval.tightness;
}

bool isAsFinished(const Part* one, const Part* other) {
  return !other->present || (one->present && (one->stopped.empty() || !other->stopped.empty()));
}

bool decidesAsMuch(const Results& one, const Results& other) {
  return std::ranges::all_of(other.requirements, [&](const RequirementResult& r) {
    const auto same = std::ranges::find(one.requirements, r.statement, &RequirementResult::statement);
    return r.word == Decision::open || (same != one.requirements.end() && same->word != Decision::open);
  });
}

}  // namespace

bool holdsAsMuch(const Results& one, const Results& other) {
  const auto mine = one.answers(), others = other.answers();
  for (std::size_t i = 0; i < mine.size(); ++i)
    if (shareOf(one, *mine[i]) < shareOf(other, *others[i])) return false;
  return one.stochastic.integrated >= other.stochastic.integrated && isAsTight(one, other) &&
         std::ranges::equal(one.parts(), other.parts(), isAsFinished) && decidesAsMuch(one, other);
}

bool asksTheSame(const Results& one, const Results& other) {
  return one.studyText == other.studyText && one.robotText == other.robotText && one.tablesText == other.tablesText &&
         one.seed == other.seed && one.stochastic.samples == other.stochastic.samples && one.version == other.version;
}

}  // namespace gamut
