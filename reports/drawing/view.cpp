// The plane of the motion is that of the two longest independent ways between points.
#include "reports/drawing/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/drawing/axes.hpp"
#include "reports/drawing/gears.hpp"

namespace gamut {
namespace {

Place times(const Place& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
constexpr double negligible = 1e-30;  // what is shorter is nothing

Place normalised(const Place& a) { return times(a, 1 / norm(a)); }

Place axis(std::size_t i) {
  Place e{0, 0, 0};
  e[i] = 1;
  return e;
}

/// All that is known of two lists.
std::vector<Place> knownOf(const std::vector<double>& one, const std::vector<double>& other) {
  std::vector<Place> found;
  for (const auto* of : {&one, &other})
    for (std::size_t k = 0; 3 * k < of->size(); ++k)
      if (const Place place = placeOf(*of, 0, 0, k); isKnown(place)) found.push_back(place);
  return found;
}

/// The direction of all axes at the start; zero if they differ, or there are none.
Place commonAxis(const PictureResult& machine) {
  Place common{0, 0, 0};
  for (std::size_t a = 0; a < machine.axes.size(); ++a) {
    const Place one = placeOf(machine.places.axes, 0, machine.axes.size(), a);
    if (!isKnown(one) || !(norm(one) > negligible) || machine.parts[machine.axes[a].part].turns == 0) continue;
    if (norm(common) == 0) common = one;
    if (norm(cross(common, one)) > 1e-6) return {0, 0, 0};
  }
  return norm(common) > 0 ? normalised(common) : common;
}

/// Normal to the plane of all places, or zero: they fill space. Places on a line, or at one place, are in many planes:
/// that across all axes is chosen, or one that looks familiar.
Place normalOf(const PictureResult& machine, const std::vector<Place>& places) {
  constexpr double flat = 1e-6;  // of the size
  Place longest{0, 0, 0}, normal{0, 0, 0};
  for (const Place& place : places)
    if (const Place way = minus(place, places.front()); norm(way) > norm(longest)) longest = way;
  const double size = norm(longest);
  const Place turning = commonAxis(machine);
  if (size == 0) return turning;
  for (const Place& place : places)
    if (const Place across = cross(longest, minus(place, places.front())); norm(across) > norm(normal)) normal = across;
  if (norm(normal) <= flat * size * size) {
    if (norm(turning) > 0 && std::fabs(dot(turning, longest)) <= flat * size) return turning;
    const Place along = normalised(longest), across = std::fabs(along[1]) > 0.7 ? axis(0) : axis(1);
    return normalised(minus(across, times(along, dot(across, along))));
  }
  normal = normalised(normal);
  for (const Place& place : places)
    if (std::fabs(dot(minus(place, places.front()), normal)) > flat * size) return {0, 0, 0};
  return normal;
}

/// Looked at so that the usual axes point to the right and up: x towards the beholder, y away, z towards.
Place towards(const Place& normal) {
  std::size_t main = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::fabs(normal[i]) > std::fabs(normal[main]) + 1e-9) main = i;
  const bool isRight = main == 1 ? normal[1] < 0 : normal[main] > 0;
  return isRight ? normal : times(normal, -1);
}

void aim(View& view, const Place& toBeholder, const Place& upwards) {
  Place up = minus(upwards, times(toBeholder, dot(upwards, toBeholder)));
  if (norm(up) < 0.1) {  // a table seen from above
    const Place other = std::fabs(toBeholder[1]) < 0.7 ? axis(1) : axis(2);
    up = minus(other, times(toBeholder, dot(other, toBeholder)));
  }
  view.up = normalised(up);
  view.right = cross(view.up, toBeholder);
}

Place againstGravity(const PictureResult& machine) {
  Place gravity{0, 0, 0};
  for (std::size_t i = 0; i < std::min<std::size_t>(3, machine.directions.size()); ++i)
    gravity[i] = machine.directions[i].gravity;
  return isKnown(gravity) && norm(gravity) > negligible ? normalised(times(gravity, -1)) : axis(2);
}

/// Enclosures may add a quarter of the motions' size on each side.
Range extent(const PictureResult& machine, const std::vector<Place>& motions, const Place& along) {
  Range range, wide;
  for (const Place& place : motions) range.hold(dot(place, along));
  for (const Place& place : knownOf(machine.places.lower, machine.places.upper)) wide.hold(dot(place, along));
  if (!(range.high >= range.low)) return {0, 0};
  const double room = range.high > range.low ? 0.25 * (range.high - range.low) : 1e300;
  if (wide.high >= wide.low) {
    range.low = std::min(range.low, std::max(wide.low, range.low - room));
    range.high = std::max(range.high, std::min(wide.high, range.high + room));
  }
  return range;
}

}  // namespace

Place placeOf(const std::vector<double>& places, std::size_t row, std::size_t points, std::size_t k) {
  const std::size_t at = 3 * (row * points + k);
  if (at + 3 > places.size()) return {NAN, NAN, NAN};
  return {places[at], places[at + 1], places[at + 2]};
}

bool isKnown(const Place& place) {
  constexpr double farthest = 1e30;  // m; from far away squares are not finite, nor is paper
  return std::ranges::all_of(place, [](double x) { return std::fabs(x) <= farthest; });
}

namespace {

/// Eight places of the rim of a wheel about an axis, wherever it goes.
void addRim(const PictureResult& machine, std::size_t point, std::size_t axis, double radius,
            std::vector<Place>& places) {
  const std::size_t axes = machine.axes.size();
  for (std::size_t row = 0; row < std::max<std::size_t>(1, machine.places.time.size()); ++row) {
    const Place centre = placeOf(machine.places.nominal, row, machine.points.size(), point),
                axle = placeOf(machine.places.axes, row, axes, axis),
                spoke = placeOf(machine.places.axes, row, axes, axis + 1);
    const Place across = cross(axle, spoke);
    const double half = std::sqrt(0.5);
    for (const Place& way : {spoke, across, minus(times(spoke, half), times(across, half)),
                             minus(times(spoke, half), times(across, -half))})
      for (const double along : {radius, -radius})
        if (const Place rim = minus(centre, times(way, along)); isKnown(rim)) places.push_back(rim);
  }
}

void addRims(const PictureResult& machine, std::vector<Place>& places) {
  for (std::size_t a = 0; a + 1 < machine.axes.size(); ++a) {
    const PartInfo& part = machine.parts[machine.axes[a].part];
    if (part.kind == PartKind::wheel && machine.axes[a + 1].part == machine.axes[a].part)
      addRim(machine, part.to, a, part.radius, places);
  }
  for (std::size_t i = 0; i < machine.parts.size(); ++i)
    if (const auto wheels = gearWheelsOf(machine, i)) {
      if (wheels->first > 0) addRim(machine, machine.parts[i].from, wheels->firstAxle, wheels->first, places);
      if (wheels->second > 0) addRim(machine, machine.parts[i].to, wheels->secondAxle, wheels->second, places);
    }
}

/// The way ahead over a road is seen too; that hardly makes the machine wider.
void addRoads(const PictureResult& machine, std::vector<Place>& places) {
  constexpr double little = 0.01;  // of its reach
  for (const ProfileInfo& road : machine.profiles) {
    const auto up = std::ranges::find(machine.axes, road.part, &AxisInfo::part);
    if (up == machine.axes.end()) continue;
    const auto along = static_cast<std::size_t>(up - machine.axes.begin()) + 1;
    const Place at = placeOf(machine.places.nominal, 0, machine.points.size(), machine.parts[road.part].to),
                ahead = placeOf(machine.places.axes, 0, machine.axes.size(), along);
    if (const Place next = minus(at, times(ahead, -little * road.reach)); isKnown(next)) places.push_back(next);
  }
}

View aimedView(const PictureResult& machine) {
  constexpr double margin = 64, marginUp = 36, leastHeight = 240, mostHeight = 460;
  View view;
  view.width = paperWidth;
  std::vector<Place> motions = knownOf(machine.places.nominal, machine.places.samples);
  addRims(machine, motions);
  addRoads(machine, motions);
  if (motions.empty()) return view;
  const Place normal = normalOf(machine, motions);
  view.isSideView = norm(normal) > 0;
  const Place up = view.vertical = againstGravity(machine);
  if (view.isSideView) {
    aim(view, towards(normal), up);
  } else {  // thirty degrees above the horizon, x to the right and towards the beholder
    const Place side = std::fabs(up[2]) > 0.9   ? Place{0.5, -0.8, 0}
                       : std::fabs(up[1]) > 0.9 ? Place{0.5, 0, 0.8}
                                                : Place{0, 0.5, 0.8};
    Place level = minus(side, times(up, dot(side, up)));
    level = normalised(level);
    aim(view, normalised({level[0] + 0.45 * up[0], level[1] + 0.45 * up[1], level[2] + 0.45 * up[2]}), up);
  }
  const Place toBeholder = cross(view.right, view.up);
  const Range across = extent(machine, motions, view.right), upwards = extent(machine, motions, view.up),
              deep = extent(machine, motions, toBeholder);
  const auto middle = [](const Range& range) { return 0.5 * range.low + 0.5 * range.high; };
  for (std::size_t i = 0; i < 3; ++i)
    view.centre[i] = middle(across) * view.right[i] + middle(upwards) * view.up[i] + middle(deep) * toBeholder[i];
  double wide = across.high - across.low, high = upwards.high - upwards.low;
  if (!view.isSideView) {  // however it is turned about the vertical
    double radius = 0;
    for (const Place& place : motions) {
      const Place way = minus(place, view.centre);
      radius = std::max(radius, norm(minus(way, times(up, dot(way, up)))));
    }
    const Range along = extent(machine, motions, up);
    wide = 2 * radius;
    high = (along.high - along.low) * dot(view.up, up) + 2 * radius * std::fabs(dot(toBeholder, up));
  }
  double farthest = 0;
  for (const Place& place : motions) farthest = std::max(farthest, norm(place));
  constexpr double rounding = 1e-12;
  if (std::max(wide, high) <= std::max(rounding * farthest, negligible)) wide = high = 0;
  view.size = std::max(wide, high);
  const double room = view.width - 2 * margin;
  view.height = mostHeight;
  if (view.size > 0) {
    const double fitting = wide > 0 ? room / wide * high + 2 * marginUp : mostHeight;
    view.height = std::clamp(fitting, leastHeight, mostHeight);
    view.scale = std::min(wide > 0 ? room / wide : INFINITY, high > 0 ? (view.height - 2 * marginUp) / high : INFINITY);
  }
  return view;
}

bool isFinite(const View& view) {
  return isKnown(view.right) && isKnown(view.up) && isKnown(view.vertical) && isKnown(view.centre) &&
         std::isfinite(view.scale) && view.scale > 0;
}

}  // namespace

View viewOf(const PictureResult& machine) {
  View view = aimedView(machine);
  if (isFinite(view)) return view;
  View any;
  any.width = view.width;
  any.height = view.height;
  return any;
}

}  // namespace gamut
