// Every motion comes down to the least upper bound U at least, so it is nearest at a time at which a lower bound is no
// more than U. The distance d of convex shapes has derivatives to both sides: the greatest and the least of the rates
// of all pairs of nearest points, with the velocities before and behind. Where d is least, inside the motion, the one
// before is not above zero and the one behind not below: so bounds over an interval with such a time hold zero, or
// change their sign from that to the next. At the start the one behind is not below zero, at the end the one before not
// above.
#include "reports/approaches.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "studies/results/extremes.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// An output time, or what lies between it and the one before.
struct Moment {
  std::size_t row;
  bool isInstant;
};

class Approaches {
 public:
  explicit Approaches(const Results& results)
      : results_(results), at_(results.interval.at), over_(results.interval.over) {}

  std::optional<Approach> of(std::size_t output, const std::string& name) const {
    Approach found;
    found.output = output;
    found.name = name;
    const std::size_t rows = reached(output);
    if (rows < 2) return {};
    found.least = leastOf(output, rows);
    found.until = results_.time[rows - 1];
    found.isAtAllTimes = rows == results_.time.size();
    if (!std::isfinite(found.least.upper)) return {};
    const std::vector<Moment> moments = momentsOf(output, name, rows, found.least.upper);
    if (moments.empty()) return {};
    for (const Moment& moment : moments) {
      const double until = results_.time[moment.row], from = moment.isInstant ? until : results_.time[moment.row - 1];
      if (!found.when.empty() && found.when.back().upper == from)
        found.when.back().upper = until;
      else
        found.when.push_back({from, until});
    }
    for (std::size_t i = 0; i < 3; ++i) {
      constexpr const char* components[] = {".x", ".y", ".z"};
      found.from[i] = rangeIn(numberOf(name + ".from" + components[i]), moments);
      found.to[i] = rangeIn(numberOf(name + ".to" + components[i]), moments);
    }
    return found;
  }

 private:
  std::size_t reached(std::size_t output) const {
    std::size_t rows = 0;
    while (rows < over_.lower.times && !std::isnan(at_.lower(rows, output)) && !std::isnan(over_.lower(rows, output)))
      ++rows;
    return rows;
  }

  Approach::Range leastOf(std::size_t output, std::size_t rows) const {
    Approach::Range least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < rows; ++i) {
      least.lower = std::min(least.lower, over_.lower(i, output));
      least.upper = std::min({least.upper, at_.upper(i, output), over_.upper(i, output)});
    }
    return least;
  }

  std::optional<std::size_t> numberOf(const std::string& quantity) const {
    const auto found = std::ranges::find(results_.outputs, quantity, &OutputInfo::quantity);
    if (found == results_.outputs.end()) return {};
    return static_cast<std::size_t>(found - results_.outputs.begin());
  }

  /// At which a motion can be nearest that comes down to `most`.
  std::vector<Moment> momentsOf(std::size_t output, const std::string& name, std::size_t rows, double most) const {
    const std::optional<std::size_t> rate = numberOf(name + ".rate");
    const auto falls = [&](std::size_t i) { return rate && over_.upper(i, *rate) < 0; };
    const auto rises = [&](std::size_t i) { return rate && over_.lower(i, *rate) > 0; };
    std::vector<Moment> moments;
    for (std::size_t i = 0; i < rows; ++i) {
      if (i > 0 && over_.lower(i, output) <= most && !falls(i) && !rises(i)) moments.push_back({i, false});
      const bool canBe = i == 0 ? !falls(1) : i + 1 == rows ? !rises(i) : falls(i) && rises(i + 1);
      if (canBe && at_.lower(i, output) <= most) moments.push_back({i, true});
    }
    return moments;
  }

  std::optional<Approach::Range> rangeIn(const std::optional<std::size_t>& output,
                                         const std::vector<Moment>& moments) const {
    Approach::Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Moment& moment : moments) {
      if (!output) return {};
      const Bounds& bounds = moment.isInstant ? at_ : over_;
      const double lower = bounds.lower(moment.row, *output), upper = bounds.upper(moment.row, *output);
      if (!std::isfinite(lower) || !std::isfinite(upper)) return {};
      range = {std::min(range.lower, lower), std::max(range.upper, upper)};
    }
    if (range.lower <= range.upper) return range;
    return {};
  }

  const Results& results_;
  const Bounds &at_, &over_;
};

std::string rangeIn(const Approach::Range& range, double size) {
  const auto [lower, upper] = boundsText(range.lower, range.upper, size);
  return lower == upper ? lower : fmt::format("[{}, {}]", lower, upper);
}

/// Each component in its output's unit.
std::string placeText(const Results& results, const std::string& end,
                      const std::array<std::optional<Approach::Range>, 3>& place) {
  double size = 0;
  for (const std::optional<Approach::Range>& range : place) {
    if (!range) return {};
    size = std::max({size, std::abs(range->lower), std::abs(range->upper)});
  }
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr const char* components[] = {".x", ".y", ".z"};
    const auto output = std::ranges::find(results.outputs, end + components[i], &OutputInfo::quantity);
    parts.push_back(inUnit(rangeIn(*place[i], size), output->unit));
  }
  return fmt::format("({})", fmt::join(parts, ", "));
}

std::string spansText(const std::vector<Approach::Range>& when) {
  std::vector<std::string> parts;
  for (const Approach::Range& span : when)
    parts.push_back(span.lower == span.upper
                        ? "at " + timeText(span.lower)
                        : fmt::format("between {} and {}", timeText(span.lower), timeText(span.upper)));
  constexpr std::size_t most = 4;
  if (parts.size() > most)
    return fmt::format("at times between {} and {}", timeText(when.front().lower), timeText(when.back().upper));
  return fmt::format("{}", fmt::join(parts, " or "));
}

}  // namespace

std::vector<Approach> approachesOf(const Results& results) {
  constexpr std::string_view word = ".distance";
  std::vector<Approach> all;
  if (!results.interval.present || results.interval.over.empty() || !(results.horizon > 0)) return all;
  for (std::size_t j = 0; j < results.outputs.size(); ++j) {
    std::string name = results.outputs[j].quantity;
    if (!name.ends_with(word) || isMargin(results, j)) continue;
    name.resize(name.size() - word.size());
    if (const std::optional<Approach> found = Approaches(results).of(j, name)) all.push_back(*found);
  }
  return all;
}

std::vector<std::string> approachLines(const Results& results, const std::vector<Approach>& approaches) {
  std::vector<std::string> lines;
  for (const Approach& a : approaches) {
    const std::string from = placeText(results, a.name + ".from", a.from),
                      to = placeText(results, a.name + ".to", a.to);
    lines.push_back(fmt::format("{} is least at {}, {}{}{}{}", results.outputs[a.output].name,
                                inUnit(rangeIn(a.least, motionSize(results, a.output)), results.outputs[a.output].unit),
                                spansText(a.when), from.empty() ? "" : ", from " + from, to.empty() ? "" : " to " + to,
                                a.isAtAllTimes ? "" : fmt::format(" (up to {})", reachedText(a.until))));
  }
  return lines;
}

}  // namespace gamut
