// Values are found as rationals in the unit in which they are stated, so that 0.9:1.1:21 has 0.91 and not what sums of
// doubles come to.
#include "studies/sweep_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "mechanics/description/written_units.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

constexpr const char* waysToSweep = "NAME=FROM:TO:COUNT, such as rod.length=0.9:1.1:21, or NAME=A,B,C";

std::string withoutBlanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == text.npos ? "" : std::string(text.substr(first, last - first + 1));
}

std::vector<std::string> partsOf(std::string_view text, char by) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(by, begin), text.size());
    parts.push_back(withoutBlanks(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

/// Numbers in a unit.
struct StatedValues {
  std::string unit;
  std::vector<mpq_class> numbers;
};

/// In `one` of a unit; a multiple of pi, which no rational is, as the double nearest to it.
mpq_class numberInUnit(const Amount& amount, const Amount& one) {
  const Amount number = amount.hasUnit ? quotient(amount, one) : amount;
  const double approximate = nearest(number);
  if (!std::isfinite(approximate)) throw Refusal("a number is not finite", "finite numbers");
  return number.piPower == 0 ? number.value : mpq_class(approximate);
}

StatedValues statedIn(const std::string& name, const std::vector<std::string>& texts, bool sharesLast) {
  std::vector<Amount> amounts;
  std::vector<std::string> units;
  for (const std::string& text : texts) {
    const Amount amount = parseAmount(text);
    if (amount.isRelative)
      throw Refusal(fmt::format("'{}': {} is a share of something", name, text), "numbers, with a unit or without");
    units.push_back(unitBehindNumber(text));
    if (amount.hasUnit && units.back().empty()) units.back() = unitOf(amount.dimension);
    amounts.push_back(amount);
  }
  for (std::size_t i = amounts.size(); sharesLast && i-- > 1;)
    if (!amounts[i - 1].hasUnit && amounts[i].hasUnit) {
      amounts[i - 1] = product(amounts[i - 1], oneOfUnit(units[i]));
      units[i - 1] = units[i];
    }
  const auto first = std::ranges::find_if(units, [](const std::string& unit) { return !unit.empty(); });
  StatedValues stated{first == units.end() ? "" : *first, {}};
  const Amount one = oneOfUnit(stated.unit);
  for (std::size_t i = 0; i < amounts.size(); ++i) {
    if (amounts[i].hasUnit && !(amounts[i].dimension == one.dimension))
      throw Refusal(fmt::format("'{}': {} and {} are of different kinds", name, stated.unit, units[i]),
                    "numbers in units of one kind");
    if (!amounts[i].hasUnit && !stated.unit.empty() && sharesLast)
      throw Refusal(fmt::format("'{}': {} has no unit, what stands before it has one", name, texts[i]),
                    fmt::format("\"{} {}\"", texts[i], stated.unit));
    if (!amounts[i].hasUnit && !stated.unit.empty()) {  // in the SI unit
      amounts[i].dimension = one.dimension;
      amounts[i].hasUnit = true;
    }
    stated.numbers.push_back(numberInUnit(amounts[i], one));
  }
  return stated;
}

/// The double nearest to a rational.
double nearestTo(const mpq_class& value) {
  Amount amount;
  amount.value = value;
  return nearest(amount) + 0.0;  // no -0
}

SweepAxis asStated(const std::string& name, const StatedValues& stated) {
  SweepAxis axis{name, stated.unit, {}};
  for (const mpq_class& number : stated.numbers) axis.values.push_back(nearestTo(number));
  return axis;
}

SweepAxis sortedAxis(SweepAxis axis) {
  std::ranges::sort(axis.values);
  return axis;
}

std::size_t countIn(const std::string& name, const std::string& text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1 || count > mostSweepPoints)
    throw Refusal(fmt::format("'{}': '{}' is no number of values", name, text),
                  fmt::format("a whole number from 1 to {}", mostSweepPoints));
  return count;
}

}  // namespace

std::string SweepAxis::stated(std::size_t value) const {
  const std::string number = fmt::format("{}", values[value]);
  return unit.empty() ? number : fmt::format("\"{} {}\"", number, unit);
}

std::size_t SweepPlan::points() const {
  if (axes.empty()) return 0;
  if (!isGrid) return axes.front().values.size();
  std::size_t product = 1;
  for (const SweepAxis& axis : axes) product = std::min(product * axis.values.size(), mostSweepPoints + 1);
  return product;
}

std::size_t SweepPlan::place(std::size_t point, std::size_t axis) const {
  if (!isGrid) return point;
  for (std::size_t later = axes.size() - 1; later > axis; --later) point /= axes[later].values.size();
  return point % axes[axis].values.size();
}

std::string SweepPlan::told(std::size_t point) const {
  std::string text;
  for (std::size_t a = 0; a < axes.size(); ++a)
    text += fmt::format("{}{} = {}", a == 0 ? "" : ", ", axes[a].name,
                        inUnit(fmt::format("{}", value(point, a)), axes[a].toldUnit()));
  return text;
}

void check(const SweepPlan& plan) {
  if (plan.axes.empty()) throw Refusal("nothing is swept", waysToSweep);
  std::set<std::string> names;
  for (const SweepAxis& axis : plan.axes) {
    if (!names.insert(axis.name).second) throw Refusal(fmt::format("'{}' is swept twice", axis.name), "each once");
    if (plan.isGrid && std::ranges::adjacent_find(axis.values) != axis.values.end())
      throw Refusal(fmt::format("'{}' has a value twice", axis.name), "different values");
    if (axis.values.empty()) throw Refusal(fmt::format("'{}' has no value", axis.name), "one value at least");
    if (!plan.isGrid && axis.values.size() != plan.axes.front().values.size())
      throw Refusal(fmt::format("'{}' has {} values, '{}' has {}", axis.name, axis.values.size(),
                                plan.axes.front().name, plan.axes.front().values.size()),
                    "as many of each");
  }
  if (plan.points() > mostSweepPoints)
    throw Refusal(fmt::format("the sweep has more than {} points", mostSweepPoints), "fewer values");
}

SweepAxis sweepAxis(const std::string& name, const std::vector<std::string>& numbers, bool sharesLast) {
  return sortedAxis(asStated(name, statedIn(name, numbers, sharesLast)));
}

SweepAxis sweepColumn(const std::string& name, const std::vector<std::string>& numbers) {
  return asStated(name, statedIn(name, numbers, false));
}

SweepAxis evenSweepAxis(const std::string& name, const std::string& from, const std::string& to, std::size_t count,
                        bool sharesLast) {
  const StatedValues stated = statedIn(name, {from, to}, sharesLast);
  SweepAxis axis{name, stated.unit, {}};
  const mpq_class first = stated.numbers[0], step = stated.numbers[1] - first;
  for (std::size_t i = 0; i < count; ++i)
    axis.values.push_back(nearestTo(count == 1 ? first : mpq_class(first + step * i / (count - 1))));
  return sortedAxis(std::move(axis));
}

SweepAxis parseSweepAxis(std::string_view text) {
  const std::size_t equal = text.find('=');
  const std::string name = withoutBlanks(text.substr(0, equal));
  if (equal == text.npos || name.empty()) throw Refusal(fmt::format("'{}' says not what is swept", text), waysToSweep);
  const std::string_view values = text.substr(equal + 1);
  if (values.find(':') == values.npos) return sweepAxis(name, partsOf(values, ','), true);
  const std::vector<std::string> parts = partsOf(values, ':');
  if (parts.size() != 3) throw Refusal(fmt::format("'{}': '{}' is no range", name, withoutBlanks(values)), waysToSweep);
  return evenSweepAxis(name, parts[0], parts[1], countIn(name, parts[2]), true);
}

}  // namespace gamut
