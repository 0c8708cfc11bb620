// What contradicts counts first, then what is beyond the tolerances.
#include "studies/comparing/difference.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "studies/comparing/common_units.hpp"

namespace gamut {
namespace {

std::vector<Excess> excessesOf(const Changes& changes, const Tolerances& tolerances) {
  std::vector<Excess> found;
  for (const OutputChange& output : changes.outputs) {
    if (output.isMargin) continue;
    const OutputTolerances& allowed = tolerances.ofOutput(output.name);
    const auto compareWidths = [&](Excess::Of of, const WidthRatio& ratio) {
      if (ratio.greatest > 1 + allowed.wider)
        found.push_back({of, output.name, ratio.greatest, 1 + allowed.wider, ratio.greatestTime});
    };
    compareWidths(Excess::Of::enclosure, output.enclosure);
    compareWidths(Excess::Of::alphaCuts, output.alphaCuts);
    if (const double ratio = output.overestimation.second / output.overestimation.first;
        allowed.overestimation && ratio > 1 + *allowed.overestimation)
      found.push_back({Excess::Of::overestimation, output.name, ratio, 1 + *allowed.overestimation});
    if (const double more = output.gap.second - output.gap.first; more > allowed.gap)
      found.push_back({Excess::Of::gap, output.name, more, allowed.gap});
  }
  for (const AnswerChange& answer : changes.answers) {
    const double missing = answer.reached.first > 0 ? 1 - answer.reached.second / answer.reached.first : 0;
    const bool isNewlyEnded = answer.reached.first == 0 && answer.reached.second == 0 && !answer.endsEarly.first;
    if (answer.endsEarly.second && (missing > tolerances.shorter || isNewlyEnded))
      found.push_back({Excess::Of::reached, answer.name, missing, tolerances.shorter, answer.reached.second});
  }
  for (const RequirementChange& requirement : changes.requirements)
    if (requirement.isLost && requirement.isSameDemand)
      found.push_back({Excess::Of::requirement, requirement.name, 0, 0, 0, requirement.word});
  if (changes.isVerdictWorse) found.push_back({Excess::Of::verdict, "", 0, 0, 0, changes.verdict});
  if (const double ratio = changes.cpu.second / changes.cpu.first; tolerances.cpu && ratio > *tolerances.cpu)
    found.push_back({Excess::Of::cpu, "", ratio, *tolerances.cpu});
  return found;
}

}  // namespace

Difference compareResults(const Results& first, const Results& asStated, const Tolerances& tolerances) {
  Difference difference;
  const std::optional<Results> converted = inUnitsOf(first, asStated);
  const Results& second = converted ? *converted : asStated;
  difference.shared = sharedOf(first, second);
  for (std::size_t i = 0; i < second.outputs.size(); ++i)
    if (const OutputInfo& now = second.outputs[i], &before = asStated.outputs[i]; now.unit != before.unit)
      difference.shared.converted.push_back({now.name, {now.unit, before.unit}});
  difference.relation = relationOf(first, second, difference.shared);
  difference.changes = changesOf(first, second, difference.shared, difference.relation.isSameQuestion());
  difference.contradictions = contradictionsOf(first, second, difference.shared, difference.relation);
  if (difference.shared.answers == 0 && difference.contradictions.compared == 0)
    throw NotComparable("no answer is in both; expected results of studies that compare some of the same");
  difference.excesses = excessesOf(difference.changes, tolerances);
  const std::vector<Contradiction>& found = difference.contradictions.found;
  difference.word = std::ranges::any_of(found, &Contradiction::isProof) ? Difference::Word::error
                    : !found.empty()                                    ? Difference::Word::incompatible
                    : !difference.excesses.empty()                      ? Difference::Word::worse
                                                                        : Difference::Word::agree;
  return difference;
}

}  // namespace gamut
