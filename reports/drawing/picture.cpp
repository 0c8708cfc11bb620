// A class for each kind of part says how it looks.
#include "reports/drawing/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>

#include "reports/drawing/gears.hpp"
#include "reports/words.hpp"
#include "studies/told.hpp"

namespace gamut {
namespace {

constexpr std::size_t mostNames = 14, mostLargeJoints = 12;

/// Counted from a place; what lies farther than any paper is unknown.
std::vector<double> wholes(const std::vector<double>& places, const Place& from, double scale,
                           double (*rounded)(double)) {
  constexpr double farthest = 1e9;
  std::vector<double> list;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double whole = rounded((places[i] - from[i % 3]) * scale / Scene::unit);
    list.push_back(std::fabs(whole) < farthest ? whole : NAN);
  }
  return list;
}

std::string titleOf(const std::string& words) { return "<title>" + escapeHtml(words) + "</title>"; }

std::string titleOf(const PartInfo& part) {
  std::string words = part.name + " (" + part.type;
  if (const Told told("kg", part.told); part.kind == PartKind::mass)
    words += ", " + inUnit(numberText(told.of(part.mass), 6), told.unit());
  if (part.kind == PartKind::play) words += ", " + inUnit(numberText(part.radius, 4), "m") + " to either side";
  return titleOf(words + ")");
}

std::string classOf(std::string_view name) { return fmt::format("class=\"{}\"", name); }

class Builder {
 public:
  explicit Builder(const PictureResult& machine) : m_(machine) {}

  Scene scene() {
    placePoints();
    if (isEnclosed(m_)) add(Form::swept, 0, 0, "swept", classOf("swept"));
    for (std::size_t k = 0; k < m_.places.sample.size(); ++k) add(Form::sample, k, 0, "sample", classOf("sample"));
    addGround();
    for (const PartInfo& part : m_.parts) addShape(part);
    for (std::size_t i = 0; i < m_.parts.size(); ++i) addWheel(i);
    addRoads();
    for (std::size_t i = 0; i < m_.parts.size(); ++i) addPlane(i);
    for (std::size_t i = 0; i < m_.parts.size(); ++i) addGear(i);
    for (const PartInfo& part : m_.parts) addLine(part);
    for (const PartInfo& part : m_.parts) addLoad(part);
    for (const PartInfo& part : m_.parts) addPlay(part);
    for (const PartInfo& part : m_.parts)
      if (part.kind == PartKind::mass) addMass(part);
    for (std::size_t i = 0; i < m_.parts.size(); ++i) addJoint(i);
    for (std::size_t i = 0; i < m_.parts.size(); ++i) addSign(i);
    if (isEnclosed(m_)) add(Form::now, 0, 0, "now", classOf("now"));  // masses are larger than most enclosures
    if (numberOf(PartKind::mass) <= mostNames) addNames();
    for (std::size_t i = 0; i < std::min<std::size_t>(3, m_.directions.size()); ++i) {
      add(Form::arrow, i, 0, "", classOf("direction"));
      add(Form::letter, i, 0, "", classOf("middle"), escapeHtml(m_.directions[i].name));
    }
    return std::move(s_);
  }

 private:
  using Form = Shape::Form;

  void add(Form form, std::size_t from, std::size_t to, const char* layer, const std::string& look,
           const std::string& content = "", double size = 0) {
    s_.shapes.push_back({form, from, to, size, look, content, layer});
  }
  void add(Form form, const PartInfo& part, const std::string& look, double size = 0) {
    add(form, part.from, part.to, "nominal", look, titleOf(part), size);
  }
  /// Play is told as numbers, which no motion changes.
  static bool isFixedOn(const PartInfo& part) { return part.kind == PartKind::rigid || part.kind == PartKind::play; }
  std::size_t numberOf(PartKind kind) const {
    return static_cast<std::size_t>(std::ranges::count(m_.parts, kind, &PartInfo::kind));
  }

  void placePoints() {
    s_.view = viewOf(m_);
    s_.points = m_.points.size();
    s_.time = m_.places.time;
    s_.isDense = numberOf(PartKind::joint) > mostLargeJoints;
    const Places& p = m_.places;
    const Place& centre = s_.view.centre;
    s_.nominal = wholes(p.nominal, centre, s_.view.scale, std::round);
    s_.samples = wholes(p.samples, centre, s_.view.scale, std::round);
    s_.lower = wholes(p.lower, centre, s_.view.scale, std::floor);
    s_.upper = wholes(p.upper, centre, s_.view.scale, std::ceil);
    s_.sag = wholes(p.sag, {0, 0, 0}, s_.view.scale, std::ceil);
    for (const double x : p.axes) s_.axes.push_back(std::fabs(x) <= 1.1 ? x : NAN);
    for (std::size_t k = 0; k < m_.points.size(); ++k)
      if (!staysPut(k)) s_.moving.push_back(k);
    for (const PartInfo& part : m_.parts)
      if ((isFixedOn(part) || part.kind == PartKind::mass) && part.from != part.to)
        s_.links.emplace_back(part.from, part.to);
  }

  /// A point that never moves and is known so well that no box around it could be seen.
  bool staysPut(std::size_t k) const {
    constexpr double visible = 3;  // units
    const Place lower = s_.at(s_.lower, 0, k), upper = s_.at(s_.upper, 0, k);
    bool isSharp = m_.points[k].isFixed;
    for (std::size_t i = 0; i < 3; ++i) isSharp = isSharp && !(upper[i] - lower[i] > visible);
    return isSharp;
  }

  /// The foot of what carries this point: rigid parts lead from one to the other.
  std::uint64_t footOf(std::uint64_t point) const {
    for (std::size_t step = 0; step < m_.parts.size(); ++step) {
      const auto below = std::ranges::find_if(m_.parts, [&](const PartInfo& part) {
        return isFixedOn(part) && part.to == point && part.from != point && m_.points[part.from].isGround;
      });
      if (below == m_.parts.end()) break;
      point = below->from;
    }
    return point;
  }

  /// Where something hangs on the inertial frame; what may move any way does not.
  void addGround() {
    std::vector<char> isHeld(m_.points.size(), 0);
    for (const PartInfo& part : m_.parts)
      if ((part.kind == PartKind::joint && part.turns + part.slides < 6 && !isGround(part)) ||
          part.kind == PartKind::spring)
        for (const std::uint64_t point : {part.from, part.to})
          if (m_.points[point].isGround) isHeld[footOf(point)] = 1;
    for (std::size_t k = 0; k < m_.points.size(); ++k)
      if (isHeld[k] != 0)
        add(Form::sign, k, k, "", classOf("ground"),
            titleOf(m_.points[k].name + ": fixed") +
                "<path class=\"hatch\" d=\"M-15 17l5 -6M-9 17l5 -6M-3 17l5 -6M3 17l5 -6M9 17l5 -6\"/>"
                "<path d=\"M0 0L-9 11H9ZM-15 11H15\"/>");
  }

  /// A joint that is seen as the road or the plane beneath what it moves.
  bool isGround(const PartInfo& joint) const {
    return std::ranges::any_of(m_.parts, [&](const PartInfo& part) {
      return (part.kind == PartKind::profile && part.from == joint.from && part.to == joint.to) ||
             (part.kind == PartKind::plane && part.name == joint.name);
    });
  }

  std::size_t axisOf(std::size_t part) const {
    return static_cast<std::size_t>(std::ranges::find(m_.axes, part, &AxisInfo::part) - m_.axes.begin());
  }

  void addPlane(std::size_t i) {
    constexpr double half = 60;
    const PartInfo& part = m_.parts[i];
    const std::size_t normal = axisOf(i);
    if (part.kind != PartKind::plane || normal >= m_.axes.size()) return;
    add(Form::plane, part.from, part.to, "", classOf("road"), titleOf(part), half);
    s_.shapes.back().axis = normal;
  }

  /// Each as far as halfway to the next.
  void addRoads() {
    for (std::size_t k = 0; k < m_.profiles.size(); ++k) {
      const ProfileInfo& road = m_.profiles[k];
      const PartInfo& part = m_.parts[road.part];
      const std::size_t up = axisOf(road.part);
      if (up + 1 >= m_.axes.size()) continue;
      s_.roads.push_back(wholes(seenHeights(road, up + 1), {0, 0, 0}, s_.view.scale, std::round));
      add(Form::road, s_.roads.size() - 1, part.to, "", classOf("road"), titleOf(part),
          std::round(10 * std::min(road.reach * s_.view.scale, 1e4)) / 10);
      s_.shapes.back().axis = up;
    }
  }
  std::vector<double> seenHeights(const ProfileInfo& road, std::size_t along) const {
    const auto startOf = [&](const ProfileInfo& of) { return s_.at(m_.places.nominal, 0, m_.parts[of.part].to); };
    const Place ahead = placeOf(m_.places.axes, 0, m_.axes.size(), along);
    double first = -INFINITY, last = INFINITY;
    for (const ProfileInfo& other : m_.profiles) {
      const double half = 0.5 * dot(minus(startOf(other), startOf(road)), ahead);
      if (half < 0) first = std::max(first, half);
      if (half > 0) last = std::min(last, half);
    }
    std::vector<double> heights = road.heights;
    const std::vector<double>& step = m_.places.step;
    for (std::size_t i = 0; i < heights.size(); ++i)
      if (const double at = step[i % step.size()] * road.reach; at < first || at > last) heights[i] = NAN;
    return heights;
  }

  /// Wheels whose radii tell the ratio, with the belt about them; else a line from joint to joint, with a sign.
  void addGear(std::size_t i) {
    const PartInfo& part = m_.parts[i];
    if (part.kind != PartKind::gear) return;
    const auto wheels = gearWheelsOf(m_, i);
    if (!wheels) {
      if (part.from != part.to) add(Form::line, part, classOf("belt"));
      return;
    }
    const auto paper = [&](double radius) { return std::round(10 * std::min(radius * s_.view.scale, 1e4)) / 10; };
    if (wheels->first > 0)
      add(Form::wheel, wheels->firstAxle, part.from, "nominal", classOf("wheel gear"), titleOf(part),
          paper(wheels->first));
    if (wheels->second > 0)
      add(Form::wheel, wheels->secondAxle, part.to, "nominal", classOf("wheel gear"), titleOf(part),
          paper(wheels->second));
    if (!wheels->isBelt) return;
    add(Form::belt, part, classOf("belt"), paper(wheels->first));
    s_.shapes.back().axis = wheels->firstAxle;
    s_.shapes.back().other = paper(wheels->second);
  }

  /// As wide as it is, round at its ends: a sphere is a line without length.
  void addShape(const PartInfo& part) {
    constexpr double hairline = 1.2, largest = 1e4;
    if (part.kind != PartKind::shape) return;
    add(Form::line, part,
        fmt::format("class=\"shape\" stroke-width=\"{:.1f}\"",
                    std::clamp(2 * part.radius * s_.view.scale, hairline, largest)));
  }

  /// What acts, or is seen otherwise than as a line between its points.
  static bool isLoad(const PartInfo& part) {
    using enum PartKind;
    constexpr std::array loads{spring, damper, motor, friction, gear, plane, profile};
    return std::ranges::count(loads, part.kind) > 0;
  }

  void addLine(const PartInfo& part) {
    if (part.from == part.to || isLoad(part) || part.kind == PartKind::shape || part.kind == PartKind::play) return;
    if (part.kind == PartKind::joint && isGround(part)) return;
    const bool slides = part.kind == PartKind::joint && part.slides == 1 && part.turns <= 1;
    add(Form::line, part,
        classOf(part.kind == PartKind::rigid  ? (isUnderSpring(part) ? "rail" : "link")
                : part.kind == PartKind::mass ? "arm"
                : slides                      ? "rail"
                                              : "loose"));
  }

  /// The one that carries what a spring slides upon, in its direction, and nothing else: it says how long the spring is
  /// at rest.
  const PartInfo* linkUnder(const PartInfo& load) const {
    const auto isUnder = [&](const PartInfo& part) { return part.kind == PartKind::rigid && part.to == load.from; };
    const auto link = std::ranges::find_if(m_.parts, isUnder);
    if (load.slides != 1 || link == m_.parts.end() || link->from == link->to) return nullptr;
    for (const PartInfo& part : m_.parts)
      if (const bool isHeld = part.kind == PartKind::joint && part.from == load.from && part.to == load.to;
          !isHeld && !isLoad(part) && &part != &*link && (part.from == load.from || part.to == load.from))
        return nullptr;
    for (std::size_t a = 0; a < m_.axes.size(); ++a) {
      const PartInfo& joint = m_.parts[m_.axes[a].part];
      if (joint.kind != PartKind::joint || joint.from != load.from || joint.to != load.to) continue;
      const Place axis = placeOf(m_.places.axes, 0, m_.axes.size(), a),
                  along = minus(s_.at(s_.nominal, 0, link->to), s_.at(s_.nominal, 0, link->from));
      constexpr double parallel = 0.999;
      if (std::fabs(dot(axis, along)) >= parallel * norm(along)) return &*link;
    }
    return nullptr;
  }
  bool isUnderSpring(const PartInfo& link) const {
    return std::ranges::any_of(m_.parts, [&](const PartInfo& part) {
      return (part.kind == PartKind::spring || part.kind == PartKind::damper) && linkUnder(part) == &link;
    });
  }

  /// A spring and a damper of one element stand beside each other.
  void addLoad(const PartInfo& part) {
    constexpr double aside = 11;
    const bool isSpring = part.kind == PartKind::spring;
    if ((!isSpring && part.kind != PartKind::damper) || (part.turns > 0 && part.slides == 0)) return;
    const PartInfo* link = linkUnder(part);
    const auto isOneOf = [&](const PartInfo& other) {
      return (other.kind == PartKind::spring || other.kind == PartKind::damper) && other.name == part.name;
    };
    const bool isPair = std::ranges::count_if(m_.parts, isOneOf) > 1;
    add(isSpring ? Form::zigzag : Form::dashpot, link ? link->from : part.from, part.to, "nominal", classOf("spring"),
        titleOf(part), isPair ? (isSpring ? -aside : aside) : 0);
  }

  /// At a joint: what turns it, rubs or resists in it, gears that are not seen as wheels, and a spring that it winds,
  /// which lies about it.
  void addSign(std::size_t i) {
    const PartInfo& part = m_.parts[i];
    if (part.kind == PartKind::spring && part.turns == 1)
      add(Form::sign, part.to, part.to, "nominal", classOf("coil"),
          titleOf(part) +
              "<path d=\"M0 -5a5 5 0 0 1 0 10a7.5 7.5 0 0 1 0 -15a10 10 0 0 1 0 20a12.5 12.5 0 0 1 -9 -4\"/>");
    const std::string_view sign = signOf(i);
    if (sign.empty()) return;
    const auto [x, y] = roomFor(part.to);
    add(Form::sign, part.to, part.to, "nominal", classOf(part.kind == PartKind::motor ? "motor" : "load"),
        titleOf(part) +
            fmt::format("<g transform=\"{}translate({} {})\">{}</g>", s_.isDense ? "scale(0.6) " : "", x, y, sign));
  }

  /// Of 16 by 16 units: a motor, the shoes of a brake about a drum or a rail, a piston, two wheels.
  std::string_view signOf(std::size_t i) const {
    const PartInfo& part = m_.parts[i];
    const bool turns = part.turns == 1;
    if (part.kind == PartKind::motor) return "<circle r=\"8\"/><text y=\"4\">M</text>";
    if (part.kind == PartKind::friction && turns)
      return "<circle r=\"4\"/><path class=\"shoe\" d=\"M-4 -5.5a7 7 0 0 0 0 11M4 -5.5a7 7 0 0 1 0 11\"/>";
    if (part.kind == PartKind::friction) return "<path d=\"M-9 0H9\"/><path class=\"shoe\" d=\"M-5 -3.2H5M-5 3.2H5\"/>";
    if (part.kind == PartKind::damper && turns) return "<path d=\"M-6 -3V6H6V-3M-4.5 1.5H4.5M0 1.5V-8\"/>";
    if (part.kind == PartKind::gear && !gearWheelsOf(m_, i))
      return "<circle cx=\"-3\" r=\"5\"/><circle cx=\"5.5\" r=\"3.5\"/>";
    return {};
  }

  /// Where the next sign at a point stands: about it, but for where its name is.
  std::pair<int, int> roomFor(std::uint64_t point) {
    constexpr std::array<std::pair<int, int>, 6> rooms{{{-17, 17}, {17, 17}, {-17, -17}, {0, 27}, {-36, 17}, {36, 17}}};
    return rooms[signs_[point]++ % rooms.size()];
  }

  /// As large as it is, seen from where it stands; a disc where only mass and inertia are known.
  void addWheel(std::size_t i) {
    const PartInfo& part = m_.parts[i];
    const auto axle = std::ranges::find(m_.axes, i, &AxisInfo::part);
    if (part.kind != PartKind::wheel || !(part.radius > 0) || axle == m_.axes.end()) return;
    constexpr double largest = 1e4;
    add(Form::wheel, static_cast<std::size_t>(axle - m_.axes.begin()), part.to, "nominal", classOf("wheel"),
        titleOf(part), std::round(10 * std::min(part.radius * s_.view.scale, largest)) / 10);
  }

  /// The hole that a pin has play in, or the room of a slider's ends: a ring about what it lies off, mostly larger than
  /// it is.
  void addPlay(const PartInfo& part) {
    constexpr double least = 10, most = 1e4;
    if (part.kind != PartKind::play) return;
    add(Form::circle, part.from, part.from, "nominal",
        fmt::format("class=\"play\" r=\"{:.1f}\"", std::clamp(part.radius * s_.view.scale, least, most)),
        titleOf(part));
  }

  void addMass(const PartInfo& part) {
    double most = 0;
    for (const PartInfo& other : m_.parts) most = std::max(most, other.mass);
    constexpr double least = 5, greatest = 13, together = 100;
    const double largest = std::clamp(together / static_cast<double>(numberOf(PartKind::mass)), least, greatest);
    const bool isWheel = std::ranges::any_of(m_.parts, [&](const PartInfo& other) {
      return other.kind == PartKind::wheel && other.to == part.to && other.radius > 0;
    });
    const double radius = isWheel    ? 0.5 * least
                          : most > 0 ? std::max(least, largest * std::cbrt(std::max(part.mass, 0.0) / most))
                                     : least;
    add(Form::circle, part, fmt::format("class=\"mass\" r=\"{:.1f}\"", radius));
  }

  /// A hinge is a pin along its axis, round at its ends, so that it is a circle where it points at the beholder; a
  /// slider is one with square ends; a universal joint has two pins, a ball none.
  void addJoint(std::size_t i) {
    const PartInfo& part = m_.parts[i];
    if (part.kind == PartKind::rigid && part.from == part.to && part.type == "weld")
      add(Form::line, part, classOf("weld"));
    if (part.kind != PartKind::joint || part.turns + part.slides > 3) return;
    if (part.slides > 0 && isGround(part)) return;
    bool hasPin = false;
    for (const std::string_view side : {"edge", "face"})
      for (std::size_t a = 0; a < m_.axes.size(); ++a) {
        if (m_.axes[a].part != i) continue;
        hasPin = true;
        add(Form::pin, a, part.to, "nominal",
            classOf(fmt::format("pin {} {}", side, part.slides > 0 ? "slider" : "hinge")), titleOf(part));
      }
    if (!hasPin || part.turns + part.slides > 1 || part.turns == 3)
      add(Form::circle, part, fmt::format("class=\"ball\" r=\"{}\"", hasPin ? 2 : 6));
  }

  /// The heaviest first; a name that would lie over one before it is not seen at the start, but said of its mass.
  void addNames() {
    std::vector<const PartInfo*> order;
    for (const PartInfo& part : m_.parts)
      if (part.kind == PartKind::mass) order.push_back(&part);
    std::ranges::stable_sort(order, std::greater<>(), [](const PartInfo* part) { return part->mass; });
    std::vector<std::pair<Sight, double>> shown;  // beginnings of baselines, and their lengths
    for (auto at = order.begin(); at != order.end(); ++at) {
      const PartInfo& part = **at;
      constexpr double letter = 6.8, size = 12, lead = 1.1;
      const double above = lead * static_cast<double>(std::count_if(
                                      order.begin(), at, [&](const PartInfo* other) { return other->to == part.to; }));
      const double width = letter * static_cast<double>(part.name.size());
      Sight base = sightOf(s_, s_.at(s_.nominal, 0, part.to), {0, s_.view.right, s_.view.up});
      base.y -= above * size;
      const bool isOver = std::ranges::any_of(shown, [&](const auto& other) {
        const auto& [begin, length] = other;
        return base.x < begin.x + length && begin.x < base.x + width && std::abs(base.y - begin.y) < size;
      });
      if (!isOver && isKnown(s_.at(s_.nominal, 0, part.to))) shown.emplace_back(base, width);
      add(Form::name, part.from, part.to, "nominal",
          fmt::format("class=\"name\" dy=\"{:.1f}em\"{}", 0 - above, isOver ? " visibility=\"hidden\"" : ""),
          escapeHtml(part.name));
    }
  }

  const PictureResult& m_;
  Scene s_;
  std::map<std::uint64_t, std::size_t> signs_;  // how many stand at a point
};

/// A round length of about a fifth of the width.
std::string scaleBar(const View& view) {
  if (!(view.size > 0)) return {};
  const double wanted = 130 / view.scale, power = std::pow(10, std::floor(std::log10(wanted)));
  const double length = wanted >= 5 * power ? 5 * power : wanted >= 2 * power ? 2 * power : power;
  const auto [factor, unit] = length >= 1000   ? std::pair(1e-3, "km")
                              : length >= 1    ? std::pair(1.0, "m")
                              : length >= 1e-3 ? std::pair(1e3, "mm")
                                               : std::pair(1e6, "µm");
  const double right = view.width - 14, left = right - length * view.scale, y = view.height - 14;
  return fmt::format(
      "<path class=\"scale\" d=\"M{0:.1f} {2:.1f}v-6M{0:.1f} {3:.1f}H{1:.1f}M{1:.1f} {2:.1f}v-6\"/>"
      "<text class=\"middle\" x=\"{4:.1f}\" y=\"{5:.1f}\">{6} {7}</text>\n",
      left, right, y, y - 3, 0.5 * (left + right), y - 10, numberText(length * factor, 6), unit);
}

/// The nominal place of a point at the start.
Place startOf(const PictureResult& machine, std::size_t point) {
  return placeOf(machine.places.nominal, 0, machine.points.size(), point);
}

/// The farthest two of them are apart.
double sizeOf(const PictureResult& machine) {
  double size = 0;
  for (std::size_t k = 0; k < machine.points.size(); ++k)
    for (std::size_t l = 0; l < k; ++l) size = std::fmax(size, norm(minus(startOf(machine, k), startOf(machine, l))));
  return size;
}

/// The farthest that a nominal point, or one of a sample, comes from where it stands at the start.
double travelOf(const PictureResult& machine) {
  double travel = 0;
  for (const std::vector<double>* places : {&machine.places.nominal, &machine.places.samples})
    for (std::size_t i = 0; 3 * i < places->size(); ++i)
      travel = std::fmax(travel, norm(minus(placeOf(*places, 0, 0, i), startOf(machine, i % machine.points.size()))));
  return travel;
}

/// 1, 2, 5, 10, 20, …: so that the farthest way is seen, and no longer than a tenth of the machine.
double magnificationOf(const PictureResult& machine) {
  constexpr double seen = 0.03, drawn = 0.1, nothing = 1e-7;  // of the size
  constexpr std::size_t most = 400;                           // points: all pairs are looked at
  if (machine.points.empty() || machine.points.size() > most || machine.places.time.size() < 2) return 1;
  const double share = travelOf(machine) / sizeOf(machine);
  if (!(share < seen) || !(share > nothing)) return 1;
  const double wanted = drawn / share, power = std::pow(10, std::floor(std::log10(wanted)));
  return std::round(wanted >= 5 * power ? 5 * power : wanted >= 2 * power ? 2 * power : power);
}

/// All ways from where points stand at the start so many times as long.
PictureResult magnified(PictureResult machine, double factor) {
  const PictureResult original = machine;
  Places& places = machine.places;
  for (std::vector<double>* list : {&places.nominal, &places.samples, &places.lower, &places.upper})
    for (std::size_t i = 0; i < list->size(); ++i) {
      const double start = startOf(original, i / 3 % original.points.size())[i % 3];
      (*list)[i] = start + factor * ((*list)[i] - start);
    }
  for (double& sag : places.sag) sag *= factor;
  for (ProfileInfo& road : machine.profiles)
    for (double& height : road.heights) height *= factor;
  return machine;
}

const char* tagOf(Shape::Form form) {
  using enum Shape::Form;
  return form == circle ? "circle" : form == name || form == letter ? "text" : form == sign ? "g" : "path";
}

template <class IsDrawn>
std::string drawShapes(const Scene& scene, std::size_t row, const std::string& label, const IsDrawn& isDrawn) {
  const View& view = scene.view;
  std::string svg =
      fmt::format("<svg class=\"drawing machine{}\" viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"{}\">\n{}\n",
                  scene.isDense ? " dense" : "", view.width, view.height, escapeHtml(label), titleOf(label));
  for (const Shape& shape : scene.shapes) {
    if (!isDrawn(shape)) continue;
    const auto attributes = attributesOf(scene, shape, {row, view.right, view.up});
    svg += fmt::format("<{} {} data-shape=\"{}\"", tagOf(shape.form), shape.look, shape.layer);
    for (const auto& [name, text] : attributes) svg += fmt::format(" {}=\"{}\"", name, text);
    svg += fmt::format("{}>{}</{}>\n", attributes.empty() ? " visibility=\"hidden\"" : "", shape.content,
                       tagOf(shape.form));
  }
  return svg + scaleBar(view) + "</svg>\n";
}

}  // namespace

Scene sceneOf(const PictureResult& machine) {
  const double factor = magnificationOf(machine);
  Scene scene = factor > 1 ? Builder(magnified(machine, factor)).scene() : Builder(machine).scene();
  scene.magnification = factor;
  return scene;
}

std::string drawScene(const Scene& scene, const std::string& label) {
  return drawShapes(scene, 0, label, [](const Shape&) { return true; });
}

std::string drawPose(const Scene& scene, std::size_t row, const std::string& label) {
  using enum Shape::Form;
  return drawShapes(scene, row, label, [](const Shape& shape) {
    return shape.form != swept && shape.form != name && shape.form != arrow && shape.form != letter;
  });
}

bool isEnclosed(const PictureResult& machine) {
  return std::ranges::any_of(machine.places.lower, [](double x) { return std::isfinite(x); });
}

}  // namespace gamut
