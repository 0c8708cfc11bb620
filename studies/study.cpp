#include "studies/study.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "mechanics/description/units.hpp"
#include "studies/printable.hpp"

namespace gamut {

StudyError::StudyError(std::string place, std::string problem, std::string expected)
    : std::runtime_error(complaintAt(place, problem, expected)),
      place_(std::move(place)),
      problem_(std::move(problem)),
      expected_(std::move(expected)) {}

Expression WantedOutput::inUnit() const {
  const Amount one = oneOfUnit(unit);
  return one.value == 1 && one.piPower == 0 ? expression : expression / Expression(one);
}

std::string Study::unitTold(const std::string& number, const std::string& own) const {
  const Dimension kind = dimensionOf(own);
  const auto fits = [&](const std::string& unit) { return !unit.empty() && isCompatible(dimensionOf(unit), kind); };
  if (const auto stated = units.find(number); stated != units.end() && fits(stated->second)) return stated->second;
  for (const UncertainQuantity& each : uncertain)
    if (each.quantity == number && fits(each.told)) return each.told;
  for (const WantedOutput& output : outputs)
    if (output.quantity == number && fits(output.unit)) return output.unit;
  std::map<std::string, int> counts;
  for (const auto& [name, unit] : units)
    if (dimensionOf(unit) == kind) ++counts[unit];
  const auto most = std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; });
  return most == counts.end() ? own : most->first;
}

const std::string& StudyPlaces::of(std::string name) const {
  while (!named.contains(name) && name.find('.') != std::string::npos) name.resize(name.rfind('.'));
  const auto found = named.find(name);
  return found == named.end() ? mechanism : found->second;
}

}  // namespace gamut
