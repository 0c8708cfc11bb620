// A margin belongs to an output if its formula names what the output is, and their numbers differ by one number.
#include "reports/sections/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "reports/sections/contribution.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The number c with margin = scale (output - c) (sign 1) or scale (c - output) (sign -1) in all bounds; NaN if there
/// is none.
double limitBetween(const Bounds& bounds, std::size_t margin, std::size_t output, int sign, double scale) {
  double least = INFINITY, greatest = -INFINITY, size = 0;
  for (std::size_t i = 0; i < bounds.lower.times; ++i) {
    const double low = bounds.lower(i, output), high = bounds.upper(i, output);
    const double below = bounds.lower(i, margin) / scale, above = bounds.upper(i, margin) / scale;
    for (const double c : {(sign > 0 ? low : high) - sign * below, (sign > 0 ? high : low) - sign * above}) {
      if (!std::isfinite(c)) continue;
      least = std::min(least, c);
      greatest = std::max(greatest, c);
    }
    if (std::isfinite(low) && std::isfinite(high)) size = std::max({size, std::abs(low), std::abs(high)});
  }
  constexpr double alike = 1e-6;  // enclosures of both differ by roundings and by what is cut off
  return least <= greatest && greatest - least <= alike * std::max(size, std::abs(least)) ? 0.5 * (least + greatest)
                                                                                          : std::nan("");
}

/// How much one of the unit is in SI units.
double factorOf(const std::string& unit) {
  static const std::map<std::string, double> units{
      {"deg", degree}, {"°", degree},  {"mrad", 1e-3}, {"rpm", std::numbers::pi / 30},
      {"km", 1e3},     {"cm", 1e-2},   {"mm", 1e-3},   {"um", 1e-6},
      {"in", 0.0254},  {"ft", 0.3048}, {"g", 1e-3},    {"t", 1e3},
      {"ms", 1e-3},    {"kN", 1e3},    {"kW", 1e3},    {"kJ", 1e3}};
  const auto found = units.find(unit);
  return found == units.end() ? 1 : found->second;
}

/// An angle without unit beside a margin that is one: numbers tell that it is in degrees.
bool isBareAngle(const Results& results, std::size_t margin, std::size_t output) {
  const std::string &of = results.outputs[margin].unit, &in = results.outputs[output].unit;
  return (of == "rad" || of == "deg") && (in.empty() || in == "1");
}

/// How much one of the output's unit is in the margin's.
double scaleOf(const Results& results, std::size_t margin, std::size_t output) {
  const std::string &of = results.outputs[margin].unit, &in = results.outputs[output].unit;
  if (isBareAngle(results, margin, output)) return degree / factorOf(of);
  return of == in ? 1 : factorOf(in) / factorOf(of);
}

/// 1 where the quantity stands as a term of a margin's formula, "q - 3" or "3 - (-(q))", -1 where it is taken away,
/// "3 - (q)"; 0 where it is no term, or one more than once.
int sideOf(const std::string& formula, const std::string& quantity) {
  int side = 0;
  for (auto at = formula.find(quantity); at != std::string::npos; at = formula.find(quantity, at + 1)) {
    const auto last = formula.find_last_not_of("(-+ ", at == 0 ? std::string::npos : at - 1);
    const std::size_t begin = at == 0 || last == std::string::npos ? 0 : last + 1;
    const auto end = formula.find_first_not_of(") ", at + quantity.size());
    const bool isTerm =
        (begin < at || at == 0) && (end == std::string::npos || formula[end] == '-' || formula[end] == '+');
    if (!isTerm) continue;
    if (side != 0) return 0;
    side = std::count(formula.begin() + static_cast<long>(begin), formula.begin() + static_cast<long>(at), '-') % 2 == 0
               ? 1
               : -1;
  }
  return side;
}

/// It varies, so that another limit would be seen.
bool varies(const Bounds& bounds, std::size_t output) {
  double least = INFINITY, greatest = -INFINITY;
  for (std::size_t i = 0; i < bounds.lower.times; ++i) {
    least = std::fmin(least, bounds.lower(i, output));
    greatest = std::fmax(greatest, bounds.upper(i, output));
  }
  return greatest - least > 1e-3 * std::max(std::abs(least), std::abs(greatest));
}

/// As a limit is stated: few decimals, if they say the same.
double rounded(double value, double size) {
  for (int digits = 1; digits < 8; ++digits)
    if (const double near = std::strtod(numberText(value, digits).c_str(), nullptr);
        std::abs(near - value) <= 1e-7 * size)
      return near;
  return value;
}

/// "40 deg" of what is stated so and drawn in rad, or as a number.
std::string labelOf(const Results& results, const Limit& limit, const std::string& unit) {
  const std::string& statement = results.requirements[limit.requirement].statement;
  if (isBareAngle(results, limit.margin, limit.output)) return "limit " + numberText(limit.value, 6) + " deg";
  const std::string number = numberText(limit.value, 6) + (unit.empty() ? "" : " " + unit);
  const std::size_t at = statement.find(" deg");
  const bool isStatedInDegrees =
      unit == "rad" && at != std::string::npos &&
      (at + 4 == statement.size() || std::isalnum(static_cast<unsigned char>(statement[at + 4])) == 0);
  if (!isStatedInDegrees) return "limit " + number;
  return fmt::format("limit {} deg ({})", numberText(rounded(limit.value / degree, std::abs(limit.value / degree)), 6),
                     number);
}

void drawRequired(const Results& results, std::size_t output, Plot& plot) {
  Layer layer{.name = "limit",
              .words = "limit of a requirement",
              .style = {colour::red, 0, 1.8, true},
              .kind = Layer::Kind::line,
              .isInSpread = false};
  for (const Limit& limit : limitsOf(results)) {
    if (limit.output != output) continue;
    const RequirementResult& requirement = results.requirements[limit.requirement];
    Line line(results.time.size(), std::nan(""));
    for (std::size_t i = 0; i < line.size(); ++i)
      if (results.horizon == 0 || (results.time[i] >= requirement.from && results.time[i] <= requirement.until))
        line[i] = limit.value;
    layer.bands.push_back({std::move(line), {}});
    layer.labels.push_back(labelOf(results, limit, plot.unit));
  }
  if (!layer.bands.empty()) plot.layers.push_back(std::move(layer));
}

std::vector<Column> requiredColumns(const Results&, const Finding&) { return {}; }

}  // namespace

const Contribution required{requiredColumns, drawRequired};

std::vector<Limit> limitsOf(const Results& results) {
  std::vector<Limit> limits;
  const Bounds* bounds = bestKnown(results);
  for (std::size_t r = 0; r < results.requirements.size(); ++r) {
    const RequirementResult& requirement = results.requirements[r];
    for (std::size_t m = requirement.margin; m < requirement.margin + static_cast<std::uint64_t>(requirement.margins);
         ++m) {
      if (m >= results.outputs.size()) continue;
      Limit limit{r, m, m, 0};
      std::size_t longest = 0;
      for (std::size_t o = 0; bounds != nullptr && o < results.outputs.size(); ++o) {
        const std::string& quantity = results.outputs[o].quantity;
        const double scale = scaleOf(results, m, o);
        const bool isNamed = results.outputs[m].quantity.find(quantity) != std::string::npos;
        if (isMargin(results, o) || quantity.size() <= longest || !(isNamed || (scale != 1 && varies(*bounds, o))))
          continue;
        const int side = sideOf(results.outputs[m].quantity, quantity);
        const double above = side < 0 ? std::nan("") : limitBetween(*bounds, m, o, 1, scale),
                     below = side > 0 ? std::nan("") : limitBetween(*bounds, m, o, -1, scale);
        // Of what is symmetric about zero numbers do not tell the side.
        if (std::isnan(above) == std::isnan(below)) continue;
        const double value = std::isnan(above) ? below : above;
        limit.output = o;
        limit.value = rounded(value, std::abs(value));
        longest = isNamed ? quantity.size() : 0;
      }
      limits.push_back(limit);
    }
  }
  return limits;
}

std::optional<Limit> nearestLimit(const Results& results) {
  const std::vector<Limit> limits = limitsOf(results);
  const Bounds* bounds = bestKnown(results);
  std::optional<Limit> nearest;
  double least = INFINITY;
  for (std::size_t r = 0; bounds != nullptr && r < results.requirements.size(); ++r) {
    const RequirementResult& requirement = results.requirements[r];
    double slack = requirement.isAlways ? INFINITY : -INFINITY;
    const Limit* decisive = nullptr;
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      if (results.horizon > 0 && (results.time[i] < requirement.from || results.time[i] > requirement.until)) continue;
      const Limit* tightest = nullptr;
      for (const Limit& limit : limits)
        if (limit.requirement == r && std::isfinite(bounds->lower(i, limit.margin)) &&
            (tightest == nullptr || bounds->lower(i, limit.margin) < bounds->lower(i, tightest->margin)))
          tightest = &limit;
      if (tightest == nullptr) continue;
      const double margin = bounds->lower(i, tightest->margin);
      if (decisive != nullptr && !(requirement.isAlways ? margin < slack : margin > slack)) continue;
      slack = margin;
      decisive = tightest;
    }
    if (decisive == nullptr) continue;
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      low = std::fmin(low, bounds->lower(i, decisive->margin));
      high = std::fmax(high, bounds->upper(i, decisive->margin));
    }
    const double share = slack / std::max(high - low, std::numeric_limits<double>::min());
    if (nearest && share >= least) continue;
    least = share;
    nearest = *decisive;
  }
  if (!nearest && !limits.empty()) nearest = limits.front();
  return nearest;
}

double instantOf(const Results& results, std::size_t output) {
  std::optional<Limit> found = nearestLimit(results);
  if (!found || found->output != output) {
    const std::vector<Limit> limits = limitsOf(results);
    const auto first = std::ranges::find(limits, output, &Limit::output);
    found = first == limits.end() ? std::nullopt : std::optional<Limit>(*first);
  }
  const double time = found ? decisiveTime(results, results.requirements[found->requirement]) : std::nan("");
  return std::isnan(time) ? widestTime(results, output) : time;
}

}  // namespace gamut
