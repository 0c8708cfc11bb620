// The parts in the order of the file, and what is asked of all of them.
#include "studies/results/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gamut {

std::vector<Part*> Results::parts() {
  std::vector<Part*> parts{&interval, &stochastic, &fuzzy, &comparison, &requirements, &distribution, &sensitivity};
  for (Boxed<FurtherPart>& part : further) parts.push_back(&*part);
  parts.insert(parts.end(), {&surrogate, &picture});
  return parts;
}

std::vector<const Part*> Results::parts() const {
  const std::vector<Part*> parts = const_cast<Results&>(*this).parts();
  return {parts.begin(), parts.end()};
}

std::string FurtherPart::unfinished() const {
  return stopped.empty() ? "" : fmt::format("{} were not {} to the end", title(), verb());
}

std::vector<Group> describe(Results& results) {
  std::vector<Group> groups;
  describe(static_cast<Origin&>(results), groups);
  describe(results.margins, groups);
  for (Part* part : results.parts()) part->describe(groups);
  return groups;
}

const std::vector<Group> describe(const Results& results) {
  return describe(const_cast<Results&>(results));  // resize, which alone changes anything, is not const
}

std::vector<std::string> differences(const Results& one, const Results& other) {
  const std::vector<Group> some = describe(one), others = describe(other);
  std::vector<std::string> paths;
  for (std::size_t g = 0; g < some.size(); ++g) {
    if (some[g].size != others[g].size) {
      paths.emplace_back(some[g].path);
      continue;
    }
    std::vector<std::string> found;
    for (std::size_t i = 0; i < some[g].size; ++i) {
      const std::vector<Field> fields = some[g].fields(i), otherFields = others[g].fields(i);
      for (std::size_t f = 0; f < fields.size(); ++f)
        if (!isSame(fields[f].value, otherFields[f].value)) found.push_back(pathOf(some[g], fields[f]));
    }
    std::ranges::sort(found);
    paths.insert(paths.end(), found.begin(), std::unique(found.begin(), found.end()));
  }
  return paths;
}

const RequirementResult* requirementOf(const Results& results, std::size_t output) {
  const auto found = std::ranges::find_if(results.requirements, [&](const RequirementResult& r) {
    return output >= r.margin && output < r.margin + static_cast<std::uint64_t>(r.margins);
  });
  return found == results.requirements.end() ? nullptr : &*found;
}

std::span<const MarginInfo> marginsOf(const Results& results, const RequirementResult& requirement) {
  const std::span<const MarginInfo> all(results.margins);
  const auto first = std::ranges::find(all, requirement.margin, &MarginInfo::output);
  const auto count = std::min<std::ptrdiff_t>(all.end() - first, requirement.margins);
  return all.subspan(static_cast<std::size_t>(first - all.begin()), static_cast<std::size_t>(count));
}

bool isMargin(const Results& results, std::size_t output) { return requirementOf(results, output) != nullptr; }

std::string unfinishedPart(const Results& results) {
  for (const Boxed<FurtherPart>& part : results.further)
    if (std::string text = part->unfinished(); !text.empty()) return text;
  return {};
}

std::string whyUnfinished(const Results& results) {
  for (const Boxed<FurtherPart>& part : results.further)
    if (!part->unfinished().empty()) return part->whyUnfinished();
  return {};
}

double reachedTime(const Results& results) {
  double reached = results.horizon;
  for (const Answer* answer : results.answers())
    if (answer->present) reached = std::min(reached, answer->reached);
  return reached;
}

std::string whyEnded(const Results& results) {
  std::vector<std::string> reasons;
  const auto add = [&](const std::string& why) {
    if (!why.empty() && std::ranges::find(reasons, why) == reasons.end()) reasons.push_back(why);
  };
  for (const Answer* answer : results.answers()) add(answer->why);
  add(results.comparison.why);
  for (const Part* part : results.parts()) add(part->stopped);
  add(results.stopped);
  return fmt::format("{}", fmt::join(reasons, "; "));
}

}  // namespace gamut
