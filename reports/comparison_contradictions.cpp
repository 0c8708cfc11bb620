// Both sets with digits enough to see them apart, rounded outward.
#include "reports/comparison_contradictions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "studies/comparing/both.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// Both, with digits enough to show how far they are apart.
Both<std::string> boundsOfBoth(const Contradiction& c) {
  double magnitude = 0;
  for (const double bound : {c.lower, c.upper, c.otherLower, c.otherUpper})
    if (std::isfinite(bound)) magnitude = std::max(magnitude, std::fabs(bound));
  const int digits = digitsFor(magnitude, c.distance, 2);
  return {intervalText(c.lower, c.upper, digits), intervalText(c.otherLower, c.otherUpper, digits)};
}

std::string timesOf(const Contradiction& c, bool moves) {
  if (!moves) return "";
  return c.times.size() == 1 ? fmt::format(" at {}", timeText(c.time, 10))
                             : fmt::format(" at {} times, farthest at {}", c.times.size(), timeText(c.time, 10));
}

/// What is compared: "the enclosures".
std::string nameOf(const Contradiction& c) {
  using Of = Contradiction::Of;
  switch (c.of) {
    case Of::enclosure:
      return "the enclosures";
    case Of::tube:
      return "the enclosures between output times";
    case Of::plainIntervals:
      return "the plain intervals";
    case Of::alphaCut:
      return fmt::format("the alpha-cuts of {}", numberText(c.at));
    case Of::sample:
      return fmt::format("samples of {} and the enclosure of {}", c.isSampleOfFirst ? "A" : "B",
                         c.isSampleOfFirst ? "B" : "A");
    case Of::distribution:
      return "the probabilities";
    case Of::mean:
      return "the means";
    case Of::deviation:
      return "the standard deviations";
    case Of::firstIndex:
      return fmt::format("the Sobol' indices of {}", c.detail);
    case Of::totalIndex:
      return fmt::format("the total Sobol' indices of {}", c.detail);
    case Of::requirement:
      break;
  }
  return "the answers";
}

std::string contradictionText(const Contradiction& c, bool moves) {
  using Of = Contradiction::Of;
  if (c.of == Of::requirement) return c.detail;
  const std::string times = timesOf(c, moves), name = nameOf(c);
  const std::string unit = c.of == Of::firstIndex || c.of == Of::totalIndex ? "" : c.unit;
  if (c.of == Of::distribution) {
    const bool isMoreInFirst = c.lower > c.otherUpper;
    const int digits = digitsFor(1, c.distance, 2);
    const std::string least = outwardText(isMoreInFirst ? c.lower : c.otherLower, 1, digits).first,
                      most = outwardText(0, isMoreInFirst ? c.otherUpper : c.upper, digits).second;
    return fmt::format("{} of at most {} have no value in common{}: at {} {} in A, at {} {} in B", name,
                       inUnit(numberText(c.at, 6), unit), times, isMoreInFirst ? "least" : "most",
                       isMoreInFirst ? least : most, isMoreInFirst ? "most" : "least", isMoreInFirst ? most : least);
  }
  const auto [first, second] = boundsOfBoth(c);
  if (c.of == Of::sample)
    return fmt::format("samples of {} lie outside the enclosure of {}{}, by {}: {} in A, {} in B",
                       c.isSampleOfFirst ? "A" : "B", c.isSampleOfFirst ? "B" : "A", times,
                       inUnit(numberText(c.distance, 3), unit), inUnit(first, unit), inUnit(second, unit));
  return fmt::format("{} have no value in common{}: {} in A, {} in B", name, times, inUnit(first, unit),
                     inUnit(second, unit));
}

}  // namespace

std::string contradictionsText(const std::vector<Contradiction>& found, bool moves) {
  std::vector<std::string> lines, names;
  const bool isProved = std::ranges::any_of(found, &Contradiction::isProof);
  for (const Contradiction& c : found) {
    const auto known = std::ranges::find(names, c.name);
    if (known == names.end()) {
      names.push_back(c.name);
      lines.push_back(fmt::format("  {}: {}{}", c.name, contradictionText(c, moves),
                                  isProved && !c.isProof ? " (of another question: no error)" : ""));
    } else if (std::string& line = lines[known - names.begin()];
               line.find(nameOf(c)) == std::string::npos && c.of != Contradiction::Of::tube) {
      line += (line.find("; likewise ") == std::string::npos ? "; likewise " : ", ") + nameOf(c);
    }
  }
  return lines.empty() ? "" : fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace gamut
