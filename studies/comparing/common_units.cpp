// Whatever describes itself as of the unit of the output.
#include "studies/comparing/common_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "studies/told.hpp"

namespace gamut {
namespace {

using UnitsOfOutputs = std::vector<std::optional<Told>>;  // one an output of the second

UnitsOfOutputs unitsFor(const Results& first, const Results& second) {
  UnitsOfOutputs units(second.outputs.size());
  for (std::size_t i = 0; i < second.outputs.size(); ++i) {
    const OutputInfo& output = second.outputs[i];
    const auto same = std::ranges::find(first.outputs, output.name, &OutputInfo::name);
    if (same == first.outputs.end() || same->unit == output.unit || isMargin(second, i)) continue;
    if (const Told told(output.unit, same->unit); told.unit() == same->unit) units[i] = told;
  }
  return units;
}

/// Where a number is rounded to.
enum class Rounding { nearest, down, up };

Rounding roundingOf(const Field& field, std::size_t end, std::size_t ends) {
  if (ends == 2) return end == 0 ? Rounding::down : Rounding::up;
  if (field.name.ends_with("lower")) return Rounding::down;
  return field.name.ends_with("upper") || field.name.ends_with("error") ? Rounding::up : Rounding::nearest;
}

double convertedNumber(const Told& unit, double x, Rounding rounding) {
  if (!std::isfinite(x)) return x;
  if (rounding == Rounding::nearest) return unit.of(x);
  const Interval enclosure = unit.of(Interval(x));
  return rounding == Rounding::down ? enclosure.lower() : enclosure.upper();
}

void convertOutputs(const Field& field, const Extents& extents, const UnitsOfOutputs& units, bool isForgotten) {
  const auto* numbers = std::get_if<Numbers>(&field.value);
  const auto output = std::ranges::find(field.dimensions, dimension::output);
  if (numbers == nullptr || field.unit != unit::ofOutput || output == field.dimensions.end()) return;
  const GridShape behind = shapeOf({output + 1, field.dimensions.end()}, extents);
  const std::size_t inner = std::accumulate(behind.begin(), behind.end(), std::size_t{1}, std::multiplies<>());
  const std::size_t ends = numbers->ends().size();
  for (std::size_t end = 0; end < ends && inner > 0; ++end)
    for (std::vector<double>* list : numbers->lists(end))
      for (std::size_t i = 0; i < list->size(); ++i)
        if (const auto& unit = units[i / inner % units.size()]; unit)
          (*list)[i] = isForgotten ? std::numeric_limits<double>::quiet_NaN()
                                   : convertedNumber(*unit, (*list)[i], roundingOf(field, end, ends));
}

}  // namespace

std::optional<Results> inUnitsOf(const Results& first, const Results& second) {
  const UnitsOfOutputs units = unitsFor(first, second);
  if (std::ranges::none_of(units, [](const auto& unit) { return unit.has_value(); })) return {};
  std::optional<Results> found(second);
  const std::vector<Group> groups = describe(*found);
  const Extents extents = extentsOf(groups);
  const auto isOfDistributions = [&](const Field& field) {
    const auto* numbers = std::get_if<Numbers>(&field.value);
    const auto* const* grid = numbers == nullptr ? nullptr : std::get_if<Grid*>(&numbers->holder());
    return grid != nullptr && *grid == &found->distribution.value;
  };
  for (const Group& group : groups)
    for (std::size_t i = 0; i < group.size; ++i)
      for (const Field& field : group.fields(i)) convertOutputs(field, extents, units, isOfDistributions(field));
  for (std::size_t i = 0; i < units.size(); ++i)
    if (units[i]) found->outputs[i].unit = units[i]->unit();
  return found;
}

}  // namespace gamut
