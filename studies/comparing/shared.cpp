// Names and times, matched.
#include "studies/comparing/shared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

namespace gamut {
namespace {

/// The places of those with equal names, in the order of the first; names that only one has go into `others`.
template <class Named>
std::vector<Match> sharedNames(const std::vector<Named>& first, const std::vector<Named>& second,
                               Both<std::vector<std::string>>& others) {
  std::vector<Match> places;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto found = std::ranges::find(second, first[i].name, &Named::name);
    if (found == second.end())
      others.first.push_back(first[i].name);
    else
      places.push_back({i, static_cast<std::size_t>(found - second.begin())});
  }
  for (const Named& named : second)
    if (std::ranges::find(first, named.name, &Named::name) == first.end()) others.second.push_back(named.name);
  return places;
}

/// The answers that results hold, as sentences name them.
std::vector<std::string> answersOf(const Results& results) {
  std::vector<std::string> answers;
  if (results.interval.present) answers.emplace_back("enclosure");
  if (results.stochastic.present) answers.emplace_back("samples");
  if (results.fuzzy.present) answers.emplace_back("alpha-cuts");
  if (results.distribution.present) answers.emplace_back("bounds of probabilities");
  if (results.sensitivity.present) answers.emplace_back("sensitivities");
  return answers;
}

/// What the requirement says whose margin an output is; empty of all others.
std::string demandOf(const Results& results, std::size_t output) {
  const RequirementResult* requirement = requirementOf(results, output);
  return requirement == nullptr ? "" : requirement->statement;
}

}  // namespace

std::vector<Match> sharedNumbers(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<Match> places;
  for (std::size_t i = 0, k = 0; i < first.size() && k < second.size();) {
    if (first[i] == second[k])
      places.push_back({i++, k++});
    else if (first[i] < second[k])
      ++i;
    else
      ++k;
  }
  return places;
}

Shared sharedOf(const Results& first, const Results& second) {
  Shared shared;
  shared.outputs = sharedNames(first.outputs, second.outputs, shared.otherOutputs);
  std::erase_if(shared.outputs, [&](const Match& output) {  // margins of another demand, or unit, are other outputs
    const std::string demand = demandOf(first, output.first);
    const bool isOtherUnit = first.outputs[output.first].unit != second.outputs[output.second].unit;
    return demand != demandOf(second, output.second) || (!demand.empty() && isOtherUnit);
  });
  std::erase_if(shared.outputs, [&](const Match& output) {
    const OutputInfo &one = first.outputs[output.first], &other = second.outputs[output.second];
    if (one.unit == other.unit) return false;
    shared.incomparable.push_back({one.name, {one.unit, other.unit}});
    return true;
  });
  if (shared.outputs.empty() && !shared.incomparable.empty())
    throw NotComparable(
        fmt::format("the output '{}' is in {} in the first and in {} in the second; expected units of one kind",
                    shared.incomparable.front().name, shared.incomparable.front().unit.first,
                    shared.incomparable.front().unit.second));
  if (shared.outputs.empty())
    throw NotComparable("no output is in both; expected results of studies with outputs of the same name");
  shared.times = sharedNumbers(first.time, second.time);
  if (shared.times.empty())
    throw NotComparable("no output time is in both; expected results of studies with some of the same output times");
  shared.otherTimes = {first.time.size() - shared.times.size(), second.time.size() - shared.times.size()};
  shared.requirements = sharedNames(first.requirements, second.requirements, shared.otherRequirements);
  const std::vector<std::string> answers = answersOf(first), otherAnswers = answersOf(second);
  const auto isIn = [](const auto& list) {
    return [&](const std::string& word) { return std::ranges::find(list, word) != list.end(); };
  };
  std::ranges::remove_copy_if(answers, std::back_inserter(shared.otherAnswers.first), isIn(otherAnswers));
  std::ranges::remove_copy_if(otherAnswers, std::back_inserter(shared.otherAnswers.second), isIn(answers));
  shared.answers = answers.size() - shared.otherAnswers.first.size();
  return shared;
}

}  // namespace gamut
