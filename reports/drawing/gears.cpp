// With i the ratio of the second joint by the first and D how far their axes are apart: r₁ = |i| r₂, and r₁ + r₂ = D
// where the wheels touch.
#include "reports/drawing/gears.hpp"

#include <algorithm>
#include <cmath>

#include "reports/drawing/view.hpp"

namespace gamut {
namespace {

constexpr double parallel = 1e-3;

Place axisAt(const PictureResult& machine, std::size_t axis) {
  return placeOf(machine.places.axes, 0, machine.axes.size(), axis);
}

std::optional<GearWheels> rackWheel(const PictureResult& machine, const PartInfo& gear, std::size_t first) {
  const std::size_t slide = first, axle = first + 1;
  if (!(std::fabs(dot(axisAt(machine, axle), axisAt(machine, slide))) < parallel) || !(gear.radius > 0)) return {};
  return GearWheels{0, gear.radius, 0, axle, false};
}

}  // namespace

std::optional<GearWheels> gearWheelsOf(const PictureResult& machine, std::size_t part) {
  const PartInfo& gear = machine.parts[part];
  const auto axis = std::ranges::find(machine.axes, part, &AxisInfo::part);
  const auto first = static_cast<std::size_t>(axis - machine.axes.begin());
  const auto count = static_cast<std::size_t>(std::ranges::count(machine.axes, part, &AxisInfo::part));
  if (gear.kind != PartKind::gear) return {};
  if (gear.turns == 1 && count == 3) return rackWheel(machine, gear, first);
  if (gear.turns != 2 || count != 4) return {};
  const Place axle = axisAt(machine, first), other = axisAt(machine, first + 2);
  if (!(norm(cross(axle, other)) < parallel)) return {};
  Place way = minus(placeOf(machine.places.nominal, 0, machine.points.size(), gear.to),
                    placeOf(machine.places.nominal, 0, machine.points.size(), gear.from));
  const double size = norm(way), beside = dot(way, axle);
  for (std::size_t i = 0; i < 3; ++i) way[i] -= beside * axle[i];
  const double distance = norm(way), ratio = dot(axle, other) > 0 ? gear.ratio : -gear.ratio;
  if (!(distance > parallel * size)) return {};
  const bool isBelt = ratio > 0;
  constexpr double ofBelt = 0.6;
  const double both = isBelt ? ofBelt * distance : distance, by = std::fabs(ratio);
  return GearWheels{both * by / (1 + by), both / (1 + by), first, first + 2, isBelt};
}

}  // namespace gamut
