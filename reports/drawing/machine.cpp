// One element of SVG for each part, and for each a class that says how it looks; reports/page/machine.js computes the
// same paths when the picture moves.
#include "reports/drawing/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string_view>

#include "reports/drawing/axes.hpp"
#include "reports/words.hpp"
#include "studies/told.hpp"

namespace gamut {
namespace {

constexpr double jointLength = 9;  // of a hinge's pin, half, in units of the paper
constexpr std::size_t mostNames = 14, mostLargeJoints = 12;

template <class... Arguments>
void add(std::string& svg, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(svg), format, std::forward<Arguments>(arguments)...);
}

std::string polygon(const std::vector<Sight>& corners) {
  std::string path;
  for (std::size_t i = 0; i < corners.size(); ++i)
    add(path, "{}{:.1f} {:.1f}", i == 0 ? "M" : "L", corners[i].x, corners[i].y);
  return path.empty() ? path : path + "Z";
}

std::string line(const Sight& from, const Sight& to) {
  return fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", from.x, from.y, to.x, to.y);
}

/// Nine turns between two straight ends.
std::string zigzag(const Sight& from, const Sight& to) {
  const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  constexpr double end = 0.14, turns = 9, width = 6;
  std::string path = fmt::format("M{:.1f} {:.1f}", from.x, from.y);
  if (length > 1)
    for (int i = 0; i <= 2 * static_cast<int>(turns); ++i) {
      const double along = end + (1 - 2 * end) * i / (2 * turns), aside = i % 2 == 0 ? 0 : i % 4 == 1 ? width : -width;
      add(path, "L{:.1f} {:.1f}", from.x + along * dx - aside * dy / length, from.y + along * dy + aside * dx / length);
    }
  return path + fmt::format("L{:.1f} {:.1f}", to.x, to.y);
}

class Drawing {
 public:
  Drawing(const MachineResult& machine, const View& view) : m_(machine), view_(view) {}

  std::string svg(const std::string& label) {
    svg_ = fmt::format(
        "<svg class=\"drawing machine{}\" viewBox=\"0 0 {:g} {:g}\" role=\"img\" "
        "aria-label=\"{}\">\n<title>{}</title>\n",
        numberOf("joint") > mostLargeJoints ? " dense" : "", view_.width, view_.height, escapeHtml(label),
        escapeHtml(label));
    drawEnclosures();
    drawSamples();
    drawGround();
    for (std::size_t i = 0; i < m_.parts.size(); ++i) drawLine(i);
    for (std::size_t i = 0; i < m_.parts.size(); ++i) drawMass(i);
    for (std::size_t i = 0; i < m_.parts.size(); ++i) drawJoint(i);
    svg_ += now_;  // in front, since masses are larger than most enclosures
    drawNames();
    drawDirections();
    drawScale();
    return svg_ + "</svg>\n";
  }

 private:
  Place at(std::size_t point) const { return placeOf(m_.places.nominal, 0, m_.points.size(), point); }
  std::size_t numberOf(std::string_view kind) const {
    return static_cast<std::size_t>(std::ranges::count(m_.parts, kind, &PartInfo::kind));
  }
  /// Of what is not known a place that is hidden.
  Sight seen(std::size_t point) const { return isKnown(at(point)) ? view_(at(point)) : Sight(); }
  const char* visibility(const PartInfo& part) const {
    return isKnown(at(part.from)) && isKnown(at(part.to)) ? "" : " visibility=\"hidden\"";
  }
  /// Between two times a point is within the hull of its boxes at both, each wider by what it may leave the straight
  /// line between them.
  void drawEnclosures() {
    if (!isEnclosed(m_)) return;
    const Places& p = m_.places;
    std::string swept, now;
    for (std::size_t k = 0; k < m_.points.size(); ++k) {
      if (staysPut(k)) continue;
      const auto corners = [&](std::size_t row, std::size_t sag, double side) {
        Place lower = placeOf(p.lower, row, m_.points.size(), k), upper = placeOf(p.upper, row, m_.points.size(), k);
        const Place room = placeOf(p.sag, sag, m_.points.size(), k);
        for (std::size_t i = 0; side > 0 && i < 3; ++i) lower[i] -= room[i], upper[i] += room[i];
        if (!isKnown(lower) || !isKnown(upper)) return std::vector<Sight>();
        return cornersOf(view_, lower, upper);
      };
      now += polygon(hullOf(corners(0, 0, 0)));
      for (std::size_t row = 1; row < p.time.size(); ++row) {
        std::vector<Sight> both = corners(row - 1, row, 1), end = corners(row, row, 1);
        if (both.empty() || end.empty()) continue;
        both.insert(both.end(), end.begin(), end.end());
        swept += polygon(hullOf(std::move(both)));
      }
    }
    add(svg_, "<path class=\"swept\" d=\"{}\"/>\n", swept);
    now_ = "<path class=\"now\" d=\"" + now + "\"/>\n";
  }

  /// A point that never moves and is known so well that no box around it could be seen.
  bool staysPut(std::size_t k) const {
    constexpr double visible = 0.05;
    const Place lower = placeOf(m_.places.lower, 0, m_.points.size(), k),
                upper = placeOf(m_.places.upper, 0, m_.points.size(), k);
    bool isSharp = m_.points[k].isFixed;
    for (std::size_t i = 0; i < 3; ++i) isSharp = isSharp && !((upper[i] - lower[i]) * view_.scale > visible);
    return isSharp;
  }

  void drawSamples() {
    const std::size_t points = m_.points.size(), times = m_.places.time.size();
    for (std::size_t s = 0; s < m_.places.sample.size(); ++s) {
      std::string path;
      for (const PartInfo& part : m_.parts) {
        if (part.kind != "rigid" && part.kind != "mass") continue;
        const Place from = placeOf(m_.places.samples, s * times, points, part.from),
                    to = placeOf(m_.places.samples, s * times, points, part.to);
        if (part.from != part.to && isKnown(from) && isKnown(to)) path += line(view_(from), view_(to));
      }
      add(svg_, "<path class=\"sample\" data-sample=\"{}\" d=\"{}\"/>\n", s, path);
    }
  }

  /// The foot of what carries this point: rigid parts lead from one to the other.
  std::uint64_t footOf(std::uint64_t point) const {
    for (std::size_t step = 0; step < m_.parts.size(); ++step) {
      const auto below = std::ranges::find_if(m_.parts, [&](const PartInfo& part) {
        return part.kind == "rigid" && part.to == point && part.from != point && m_.points[part.from].isGround;
      });
      if (below == m_.parts.end()) break;
      point = below->from;
    }
    return point;
  }

  /// Where something hangs on the inertial frame; what may move any way does not.
  void drawGround() {
    std::vector<char> isHeld(m_.points.size(), 0);
    for (const PartInfo& part : m_.parts)
      if ((part.kind == "joint" && part.turns + part.slides < 6) || part.kind == "spring")
        for (const std::uint64_t point : {part.from, part.to})
          if (m_.points[point].isGround) isHeld[footOf(point)] = 1;
    for (std::size_t k = 0; k < m_.points.size(); ++k) {
      if (isHeld[k] == 0 || !isKnown(at(k))) continue;
      const Sight at = seen(k);
      add(svg_,
          "<g class=\"ground\" data-point=\"{}\" transform=\"translate({:.1f} {:.1f})\"><title>{}: fixed</title>"
          "<path class=\"hatch\" d=\"M-15 17l5 -6M-9 17l5 -6M-3 17l5 -6M3 17l5 -6M9 17l5 -6\"/>"
          "<path d=\"M0 0L-9 11H9ZM-15 11H15\"/></g>\n",
          k, at.x, at.y, escapeHtml(m_.points[k].name));
    }
  }

  void drawLine(std::size_t i) {
    const PartInfo& part = m_.parts[i];
    const bool slides = part.kind == "joint" && part.slides == 1 && part.turns <= 1;
    const std::string_view kind = part.kind == "rigid"    ? "link"
                                  : part.kind == "mass"   ? "arm"
                                  : part.kind == "spring" ? "spring"
                                  : slides                ? "rail"
                                                          : "loose";
    if (part.from == part.to) return;
    const Sight from = seen(part.from), to = seen(part.to);
    add(svg_, "<path class=\"{}\" data-part=\"{}\"{} d=\"{}\"><title>{}</title></path>\n", kind, i, visibility(part),
        part.kind == "spring" ? zigzag(from, to) : line(from, to), titleOf(part));
  }

  void drawMass(std::size_t i) {
    const PartInfo& part = m_.parts[i];
    if (part.kind != "mass") return;
    double most = 0;
    for (const PartInfo& other : m_.parts) most = std::max(most, other.mass);
    constexpr double least = 5, greatest = 13, together = 100;
    const double largest = std::clamp(together / static_cast<double>(numberOf("mass")), least, greatest);
    const double radius = most > 0 ? std::max(least, largest * std::cbrt(std::max(part.mass, 0.0) / most)) : least;
    const Sight at = seen(part.to);
    add(svg_,
        "<circle class=\"mass\" data-part=\"{}\"{} cx=\"{:.1f}\" cy=\"{:.1f}\" "
        "r=\"{:.1f}\"><title>{}</title></circle>\n",
        i, visibility(part), at.x, at.y, radius, titleOf(part));
  }

  /// A hinge is a pin along its axis, round at its ends, so that it is a circle where it points at the beholder; a
  /// slider is one with square ends; a universal joint has two pins, a ball none.
  void drawJoint(std::size_t i) {
    const PartInfo& part = m_.parts[i];
    const Sight at = seen(part.to);
    if (part.kind == "rigid" && part.from == part.to && part.type == "weld") {
      add(svg_, "<path class=\"weld\" data-part=\"{}\"{} d=\"{}\"><title>{}</title></path>\n", i, visibility(part),
          line(at, at), titleOf(part));
    }
    if (part.kind != "joint" || part.turns + part.slides > 3) return;
    bool hasPin = false;
    for (const std::string_view layer : {"edge", "face"})
      for (std::size_t a = 0; a < m_.axes.size(); ++a) {
        if (m_.axes[a].part != i) continue;
        hasPin = true;
        const Sight along = view_.direction(placeOf(m_.places.axes, 0, m_.axes.size(), a));
        constexpr double most = 1.1;  // of a unit vector
        const double length = std::hypot(along.x, along.y) <= most ? jointLength : 0;
        const Sight ahead{at.x + length * along.x, at.y + length * along.y},
            behind{at.x - length * along.x, at.y - length * along.y};
        add(svg_, "<path class=\"pin {} {}\" data-axis=\"{}\"{} d=\"{}\"><title>{}</title></path>\n", layer,
            part.slides > 0 ? "slider" : "hinge", a, visibility(part), length > 0 ? line(behind, ahead) : line(at, at),
            titleOf(part));
      }
    if (!hasPin || part.turns + part.slides > 1 || part.turns == 3)
      add(svg_,
          "<circle class=\"ball\" data-part=\"{}\"{} cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{}</title></circle>\n",
          i, visibility(part), at.x, at.y, hasPin ? 2 : 6, titleOf(part));
  }

  /// The heaviest first; a name that would lie over one before it is not seen, but said of its mass.
  void drawNames() {
    if (numberOf("mass") > mostNames) return;
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < m_.parts.size(); ++i)
      if (m_.parts[i].kind == "mass") order.push_back(i);
    std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return m_.parts[i].mass; });
    std::vector<std::size_t> named;
    std::vector<Sight> shown;  // left ends of baselines
    std::vector<double> widths;
    for (const std::size_t i : order) {
      const PartInfo& part = m_.parts[i];
      const auto before = static_cast<double>(std::ranges::count(named, part.to));
      named.push_back(part.to);
      constexpr double letter = 6.8, size = 12, lead = 1.1;
      const Sight at = seen(part.to), text{at.x + 15, at.y - 9};
      const Sight base{text.x, text.y - lead * before * size};
      const double wide = letter * static_cast<double>(part.name.size());
      bool isOver = false;
      for (std::size_t k = 0; k < shown.size(); ++k)
        isOver = isOver || (base.x < shown[k].x + widths[k] && shown[k].x < base.x + wide &&
                            std::abs(base.y - shown[k].y) < size);
      const std::string hidden = visibility(part);
      if (!isOver && hidden.empty()) {
        shown.push_back(base);
        widths.push_back(wide);
      }
      add(svg_, "<text class=\"name\" data-part=\"{}\"{} x=\"{:.1f}\" y=\"{:.1f}\" dy=\"{:.1f}em\">{}</text>\n", i,
          isOver ? " visibility=\"hidden\"" : hidden, text.x, text.y, 0 - lead * before, escapeHtml(part.name));
    }
  }

  void drawDirections() {
    const Sight at{30, view_.height - 30};
    for (std::size_t i = 0; i < std::min<std::size_t>(3, m_.directions.size()); ++i) {
      Place e{0, 0, 0};
      e[i] = 1;
      const Sight to = view_.direction(e);
      const bool isShown = std::hypot(to.x, to.y) > 0.2;
      add(svg_,
          "<g class=\"direction\" data-direction=\"{}\"{}><path d=\"{}\"/><text class=\"middle\" x=\"{:.1f}\" "
          "y=\"{:.1f}\">{}</text></g>\n",
          i, isShown ? "" : " visibility=\"hidden\"", line(at, {at.x + 20 * to.x, at.y + 20 * to.y}), at.x + 28 * to.x,
          at.y + 28 * to.y + 4, escapeHtml(m_.directions[i].name));
    }
  }

  /// A round length of about a fifth of the width.
  void drawScale() {
    if (!(view_.size > 0)) return;
    const double wanted = 130 / view_.scale, power = std::pow(10, std::floor(std::log10(wanted)));
    const double length = wanted >= 5 * power ? 5 * power : wanted >= 2 * power ? 2 * power : power;
    const auto [factor, unit] = length >= 1000   ? std::pair(1e-3, "km")
                                : length >= 1    ? std::pair(1.0, "m")
                                : length >= 1e-3 ? std::pair(1e3, "mm")
                                                 : std::pair(1e6, "µm");
    const double right = view_.width - 14, left = right - length * view_.scale, y = view_.height - 14;
    add(svg_,
        "<path class=\"scale\" d=\"M{0:.1f} {2:.1f}v-6M{0:.1f} {3:.1f}H{1:.1f}M{1:.1f} {2:.1f}v-6\"/>"
        "<text class=\"middle\" x=\"{4:.1f}\" y=\"{5:.1f}\">{6} {7}</text>\n",
        left, right, y, y - 3, 0.5 * (left + right), y - 10, numberText(length * factor, 6), unit);
  }

  static std::string titleOf(const PartInfo& part) {
    std::string words = part.name + " (" + part.type;
    if (const Told told("kg", part.told); part.kind == "mass")
      words += ", " + inUnit(numberText(told.of(part.mass), 6), told.unit());
    return escapeHtml(words + ")");
  }

  const MachineResult& m_;
  const View& view_;
  std::string svg_, now_;
};

/// Lists of whole numbers of a unit, from the centre; what is not finite is null.
class Whole {
 public:
  Whole(const View& view, double unit) : view_(view), unit_(unit) {}

  enum class Rounding { nearest, down, up };
  std::string places(const std::vector<double>& values, Rounding rounding, bool fromCentre = true) const {
    std::string list;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double units = (values[i] - (fromCentre ? view_.centre[i % 3] : 0)) / unit_;
      const double whole = rounding == Rounding::down ? std::floor(units)
                           : rounding == Rounding::up ? std::ceil(units)
                                                      : std::round(units);
      list += list.empty() ? "" : ",";
      if (std::isfinite(whole) && std::fabs(whole) < 1e9)
        add(list, "{}", static_cast<long long>(whole));
      else
        list += "null";
    }
    return "[" + list + "]";
  }

 private:
  const View& view_;
  double unit_;
};

template <class List, class Text>
std::string listed(const List& list, const Text& text) {
  std::string all;
  for (const auto& one : list) all += (all.empty() ? "" : ",") + text(one);
  return "[" + all + "]";
}

std::string vectorText(const Place& v) { return fmt::format("[{:.9g},{:.9g},{:.9g}]", v[0], v[1], v[2]); }

}  // namespace

bool isEnclosed(const MachineResult& machine) {
  return std::ranges::any_of(machine.places.lower, [](double x) { return std::isfinite(x); });
}

std::string drawMachine(const MachineResult& machine, const View& view, const std::string& label) {
  return Drawing(machine, view).svg(label);
}

std::string machineData(const MachineResult& machine, const View& view) {
  using enum Whole::Rounding;
  const double unit = 0.02 / view.scale;  // a fiftieth of the paper's
  const Whole whole(view, unit);
  const Places& p = machine.places;
  std::string axes;
  for (const double x : p.axes)
    axes += (axes.empty() ? "" : ",") + (std::fabs(x) <= 1.1 ? fmt::format("{:.4g}", x) : std::string("null"));
  return fmt::format(
      R"({{"unit":{:.9g},"scale":{:.9g},"width":{:g},"height":{:g},"right":{},"up":{},"vertical":{},"isSide":{},"pin":{:g},)"
      R"("time":{},"fixed":{},"parts":{},"axisOf":{},"nominal":{},"axes":[{}],"samples":{},"lower":{},"upper":{},"sag":{}}})",
      unit, view.scale, view.width, view.height, vectorText(view.right), vectorText(view.up), vectorText(view.vertical),
      view.isSideView, jointLength, listed(p.time, [](double t) { return fmt::format("{:.9g}", t); }),
      listed(machine.points, [](const PointInfo& point) { return std::string(point.isFixed ? "1" : "0"); }),
      listed(machine.parts,
             [](const PartInfo& part) { return fmt::format("[{},{},{}]", jsonText(part.kind), part.from, part.to); }),
      listed(machine.axes, [](const AxisInfo& axis) { return std::to_string(axis.part); }),
      whole.places(p.nominal, nearest), axes, whole.places(p.samples, nearest), whole.places(p.lower, down),
      whole.places(p.upper, up), whole.places(p.sag, up, false));
}

}  // namespace gamut
