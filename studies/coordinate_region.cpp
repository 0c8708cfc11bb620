#include "studies/coordinate_region.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "mechanics/description/names.hpp"

namespace gamut {
namespace {

/// By more than reading rounds.
const Interval slightlyMore(1 + 0x1p-50), slightlyLess(1 - 0x1p-50);

/// From where to where it surely is.
Interval between(const Interval& lower, const Interval& upper) {
  return lower.upper() <= upper.lower() ? Interval(lower.upper(), upper.lower()) : Interval::empty();
}

bool isAngle(const Mechanism::JointCoordinate& coordinate) { return coordinate.kind == Coordinate::angle; }

std::optional<FurtherAnalysis::Refusal> refusalOf(const Mechanism& mechanism, const std::string& name,
                                                  const StatedRange& range) {
  using Refusal = FurtherAnalysis::Refusal;
  try {
    const Mechanism::JointCoordinate& joint = mechanism.coordinate(name, "ranges");
    const std::string unit = isAngle(joint) ? "rad" : "m";
    for (const Amount& end : {range.first, range.second})
      if (end.hasUnit ? !(end.dimension == dimensionOf(unit)) : end.isRelative)
        return Refusal{
            "ranges", fmt::format("the range of '{}' is not in {}", joint.name, unit),
            isAngle(joint) ? "two angles, such as [\"-90 deg\", \"90 deg\"]" : "two lengths, such as [0, \"20 mm\"]"};
    if (joint.isDriven)
      return Refusal{"ranges", fmt::format("'{}' is driven, so that it has no range", joint.name),
                     "coordinates that are free"};
    if (!(nearest(range.first) <= nearest(range.second)))
      return Refusal{"ranges", fmt::format("the range of '{}' ends before it begins", joint.name), "[lower, upper]"};
  } catch (const UnknownName& unknown) {
    return Refusal{"ranges", unknown.problem(), unknown.expected()};
  }
  return {};
}

}  // namespace

Interval turnAbout(double middle) {
  const Interval half = pi() * slightlyMore;
  return hull(Interval(middle) - half, Interval(middle) + half);
}

void CoordinateRegion::describe(Settings& s) {
  NumberOf angle{"rad"}, displacement{"m"};
  angle.written = &angleUnit_;
  displacement.written = &displacementUnit_;
  angle.least = displacement.least = 0;
  angle.fault = displacement.fault = "is below 0";
  angle.expected = displacement.expected = "how far from the initial value";
  s.ranges({"ranges",
            "`{ shoulder = [\"-90 deg\", \"90 deg\"], 'lift.displacement' = [0, \"20 mm\"] }`: from where to where "
            "coordinates, or joints of one, are looked at",
            ""},
           ranges_);
  s.optional({"angles", "how far from their initial values other angles are looked at, either way", "a whole turn"},
             angle, angles_);
  s.optional({"displacements", "likewise of displacements, m", ""}, displacement, displacements_);
}

std::optional<FurtherAnalysis::Refusal> CoordinateRegion::refusal(const Mechanism& mechanism,
                                                                  const std::string& section) const {
  for (const auto& [name, range] : ranges_)
    if (std::optional<FurtherAnalysis::Refusal> refusal = refusalOf(mechanism, name, range)) return refusal;
  const auto isNamed = [&](const Mechanism::JointCoordinate& joint) {
    return std::ranges::any_of(ranges_,
                               [&](const auto& each) { return &mechanism.coordinate(each.first, "") == &joint; });
  };
  for (const Mechanism::JointCoordinate& joint : mechanism.coordinates())
    if (!isAngle(joint) && !joint.isDriven && !displacements_ && !isNamed(joint))
      return FurtherAnalysis::Refusal{"displacements", fmt::format("how far '{}' is looked at is not said", joint.name),
                                      fmt::format("{0}.ranges, or {0}.displacements", section)};
  return {};
}

std::vector<CoordinateRegion::Side> CoordinateRegion::sides(const Mechanism& mechanism) const {
  std::vector<Side> sides;
  std::vector<std::string> names = mechanism.stateNames();
  names.resize(mechanism.positions());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Mechanism::JointCoordinate& joint = *mechanism.coordinates().find(names[i]);
    const Interval start = mechanism.rangeOf(mechanism.initialState()[i]);
    const std::optional<double>& half = isAngle(joint) ? angles_ : displacements_;
    Side side{names[i], turnAbout(midpoint(start)), {}, isAngle(joint) && !half};
    if (half) {
      const Interval away = Interval(*half) * slightlyMore, near = Interval(*half) * slightlyLess;
      side.range = hull(start - away, start + away);
      side.inner = between(start - near, start + near);
    }
    for (const auto& [name, range] : ranges_)
      if (&mechanism.coordinate(name, "") == &joint) {
        side.range = hull(enclose(range.first), enclose(range.second));
        side.inner = between(enclose(range.first), enclose(range.second));
        side.isTurn = false;
      }
    constexpr double little = 1e-9;  // rad
    side.isTurn = side.isTurn || (isAngle(joint) && magnitude(Interval(width(side.range)) - twoPi()) < little);
    if (side.isTurn) {
      const Interval middle(midpoint(side.range)), near = pi() * slightlyLess;
      side.range = turnAbout(middle.lower());
      side.inner = between(middle - near, middle + near);
    }
    sides.push_back(std::move(side));
  }
  return sides;
}

std::string CoordinateRegion::units(const Study& study, std::size_t coordinates) const {
  std::map<std::string, std::string, std::less<>> ofRanges;
  for (const auto& [name, range] : ranges_)
    if (!range.unit.empty()) ofRanges[study.mechanism.coordinate(name, "").name] = range.unit;
  return unitsToldOf(study, coordinates, angleUnit_, displacementUnit_, ofRanges);
}

std::string unitsToldOf(const Study& study, std::size_t coordinates, const std::string& angles,
                        const std::string& displacements,
                        const std::map<std::string, std::string, std::less<>>& ofRanges) {
  std::string units;
  const std::vector<std::string> names = study.mechanism.stateNames();
  for (std::size_t i = 0; i < coordinates; ++i) {
    const Mechanism::JointCoordinate& joint = *study.mechanism.coordinates().find(names[i]);
    const std::string own = gamut::unitOf(joint.kind), &looked = isAngle(joint) ? angles : displacements;
    const auto range = ofRanges.find(names[i]);
    std::string unit = range != ofRanges.end() ? range->second : study.unitTold(names[i], own);
    if (unit == own && !looked.empty()) unit = looked;
    units += (i > 0 ? ", " : "") + unit;
  }
  return units;
}

}  // namespace gamut
