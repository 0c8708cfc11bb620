// By bounds at the output times.
#include "studies/results/instants.hpp"

#include <algorithm>
#include <cmath>

namespace gamut {

const Bounds* bestKnown(const Results& results) {
  const auto isKnown = [](const Bounds& bounds) {
    return std::ranges::any_of(bounds.lower.data, [](double x) { return std::isfinite(x); });
  };
  if (results.interval.present && isKnown(results.interval.at)) return &results.interval.at;
  if (results.stochastic.present && isKnown(results.stochastic.envelope)) return &results.stochastic.envelope;
  if (results.fuzzy.present && !results.fuzzy.outer.empty() && isKnown(results.fuzzy.outer.front()))
    return &results.fuzzy.outer.front();
  return nullptr;
}

double decisiveTime(const Results& results, const RequirementResult& requirement) {
  if (requirement.isViolatedInSimulation) return requirement.worstTime;
  if (!std::isnan(requirement.violationTime)) return requirement.violationTime;
  const Bounds* bounds = bestKnown(results);
  double decisive = std::nan(""), slack = 0;
  for (std::size_t i = 0; bounds != nullptr && i < results.time.size(); ++i) {
    if (results.horizon > 0 && (results.time[i] < requirement.from || results.time[i] > requirement.until)) continue;
    double least = std::nan("");
    for (std::uint64_t m = 0; m < static_cast<std::uint64_t>(requirement.margins); ++m)
      least = std::fmin(least, bounds->lower(i, requirement.margin + m));
    if (std::isnan(least) || (!std::isnan(decisive) && !(requirement.isAlways ? least < slack : least > slack)))
      continue;
    decisive = results.time[i];
    slack = least;
  }
  return decisive;
}

std::optional<double> endOfProof(const Results& results) {
  const bool isEnclosed = results.interval.present;
  if (results.horizon == 0 || (!isEnclosed && !results.fuzzy.present)) return {};
  const double reached = isEnclosed ? results.interval.reached : results.fuzzy.reached;
  return reached < results.horizon ? std::optional<double>(reached) : std::nullopt;
}

std::string toldName(const Results& results, std::size_t output, std::size_t time) {
  const std::string& name = results.outputs[output].name;
  const RequirementResult* r = requirementOf(results, output);
  if (r == nullptr) return name;
  const bool demands = results.horizon == 0 || (results.time[time] >= r->from && results.time[time] <= r->until);
  return demands ? "margin of " + name : "";
}

double widestTime(const Results& results, std::size_t output) {
  const Bounds* bounds = bestKnown(results);
  double time = std::nan(""), widest = -1;
  for (std::size_t i = 0; bounds != nullptr && i < results.time.size(); ++i)
    if (const double width = bounds->upper(i, output) - bounds->lower(i, output);
        std::isfinite(width) && width > widest) {
      widest = width;
      time = results.time[i];
    }
  return time;
}

}  // namespace gamut
