// The same numbers on paper as on the screen: whole ones, and sums in the same order.
#include "reports/drawing/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/drawing/screen.hpp"

namespace gamut {
namespace {

constexpr double pinLength = 9;  // half, in units of the paper

bool isOnPaper(const Sight& sight) { return std::isfinite(sight.x) && std::isfinite(sight.y); }
std::string text(double x) { return fmt::format("{:.1f}", x + 0.0); }
std::string pair(const Sight& at) { return text(at.x) + " " + text(at.y); }
std::string straight(const Sight& from, const Sight& to) { return "M" + pair(from) + "L" + pair(to); }

/// Places as seen from a straight line: `along` its length as a share, `aside` in units of the paper.
class Beside {
 public:
  Beside(const Sight& from, const Sight& to)
      : from_(from), dx_(to.x - from.x), dy_(to.y - from.y), length_(std::hypot(dx_, dy_)) {}
  double length() const { return length_; }
  std::string at(double along, double aside) const {
    const double part = aside / length_;
    return pair({from_.x + along * dx_ - part * dy_, from_.y + along * dy_ + part * dx_});
  }

 private:
  Sight from_;
  double dx_, dy_, length_;
};

/// Nine turns between two straight ends, beside the line.
std::string spring(const Sight& from, const Sight& to, double beside) {
  const Beside line(from, to);
  constexpr double end = 0.14;
  std::string path = "M" + pair(from);
  if (line.length() > 1 && beside != 0) path += "L" + line.at(0, beside);
  for (int i = 0; line.length() > 1 && i <= 18; ++i)
    path += "L" + line.at(end + (1 - 2 * end) * i / 18, beside + (i % 2 == 0 ? 0 : i % 4 == 1 ? 6 : -6));
  if (line.length() > 1 && beside != 0) path += "L" + line.at(1, beside);
  return path + "L" + pair(to);
}

/// A cylinder, which is open towards `to`, and a piston in it.
std::string damper(const Sight& from, const Sight& to, double beside) {
  const Beside line(from, to);
  if (!(line.length() > 1)) return straight(from, to);
  constexpr double half = 5, closed = 0.36, piston = 0.52, open = 0.66;
  const auto at = [&](double along, double aside) { return line.at(along, beside + aside); };
  std::string path = "M" + pair(from) + "L" + at(0, 0) + "L" + at(closed, 0);
  path += "M" + at(open, half) + "L" + at(closed, half) + "L" + at(closed, -half) + "L" + at(open, -half);
  path += "M" + at(piston, half - 1) + "L" + at(piston, 1 - half);
  return path + "M" + at(piston, 0) + "L" + at(1, 0) + "L" + pair(to);
}

class Picture {
 public:
  Picture(const Scene& scene, const Stance& stance) : s_(scene), stance_(stance) {}

  /// Corners of the box of point k, wider by what the point may sag until another row; none if not known.
  std::vector<Sight> box(std::size_t row, std::size_t k, const Place& room) const {
    const Place lower = s_.at(s_.lower, row, k), upper = s_.at(s_.upper, row, k);
    std::vector<Sight> corners;
    if (!isKnown(lower) || !isKnown(upper) || !isKnown(room)) return corners;
    for (unsigned corner = 0; corner < 8; ++corner) {
      Place place;
      for (std::size_t d = 0; d < 3; ++d) place[d] = (corner >> d & 1U) != 0 ? upper[d] + room[d] : lower[d] - room[d];
      corners.push_back(sightOf(s_, place, stance_));
    }
    return corners;
  }

  std::string now() const {
    std::string path;
    for (const std::size_t k : s_.moving) path += hullPath(box(stance_.row, k, {0, 0, 0}));
    return path;
  }

  /// Between two times a point is within the hull of its boxes at both, each wider by what it may leave the straight
  /// line between them.
  std::string swept() const {
    std::string path;
    for (const std::size_t k : s_.moving)
      for (std::size_t row = 1; row < s_.time.size(); ++row) {
        std::vector<Sight> both = box(row - 1, k, s_.at(s_.sag, row, k)), end = box(row, k, s_.at(s_.sag, row, k));
        if (both.empty() || end.empty()) continue;
        both.insert(both.end(), end.begin(), end.end());
        path += hullPath(std::move(both));
      }
    return path;
  }

  std::string sample(std::size_t number) const {
    std::string path;
    for (const auto& [from, to] : s_.links) {
      const Sight a = point(s_.samples, number * s_.time.size() + stance_.row, from),
                  b = point(s_.samples, number * s_.time.size() + stance_.row, to);
      if (isOnPaper(a) && isOnPaper(b)) path += straight(a, b);
    }
    return path;
  }

  Sight point(const std::vector<double>& places, std::size_t row, std::size_t k) const {
    return sightOf(s_, s_.at(places, row, k), stance_);
  }

  /// Where a vector points to; NaN where unknown.
  Sight direction(const Place& v) const { return {dot(v, stance_.right), 0 - dot(v, stance_.up)}; }

  /// A circle where it points at the beholder, or nowhere.
  std::string pin(const Sight& at, std::size_t number) const {
    Sight to = direction(axis(number));
    if (!isOnPaper(to)) to = {};
    const double x = pinLength * to.x, y = pinLength * to.y;
    return straight({at.x - x, at.y - y}, {at.x + x, at.y + y});
  }

  /// What of a plane lies beneath a point; hatched below where it is seen from its edge.
  std::string plane(const Shape& shape) const {
    const Place normal = axis(shape.axis), foot = footOf(shape, normal);
    if (!isKnown(normal) || !isKnown(foot)) return {};
    const Place toBeholder = cross(stance_.right, stance_.up);
    Place level = cross(normal, toBeholder);
    if (norm(level) < 0.01) level = stance_.right;
    const double length = norm(level);
    for (double& part : level) part /= length;
    const Sight at = sightOf(s_, foot, stance_), a = times(direction(level), shape.size),
                b = times(direction(cross(normal, level)), 0.6 * shape.size);
    if (std::fabs(dot(normal, toBeholder)) >= 0.05)
      return "M" + pair({at.x - a.x - b.x, at.y - a.y - b.y}) + "L" + pair({at.x + a.x - b.x, at.y + a.y - b.y}) + "L" +
             pair({at.x + a.x + b.x, at.y + a.y + b.y}) + "L" + pair({at.x - a.x + b.x, at.y - a.y + b.y}) + "Z";
    std::vector<Sight> line;
    constexpr int steps = 12;
    for (int k = -steps; k <= steps; ++k) line.push_back({at.x + k * a.x / steps, at.y + k * a.y / steps});
    return ground(line, direction(level), direction(normal));
  }

  /// The profile beneath a point, hatched below.
  std::string road(const Sight& at, const Shape& shape) const {
    const std::vector<double>& heights = s_.roads[shape.from];
    const std::size_t steps = heights.size() / std::max<std::size_t>(1, s_.time.size());
    const Sight up = direction(axis(shape.axis)), ahead = direction(axis(shape.axis + 1));
    if (!isOnPaper(up) || !isOnPaper(ahead) || steps < 2) return {};
    std::vector<Sight> line;
    for (std::size_t k = 0; k < steps; ++k) {
      const double along = (2 * static_cast<double>(k) / static_cast<double>(steps - 1) - 1) * shape.size,
                   height = Scene::unit * heights[stance_.row * steps + k];
      line.push_back({at.x + along * ahead.x + height * up.x, at.y + along * ahead.y + height * up.y});
    }
    return ground(line, ahead, up);
  }

  /// Two straight lines around two wheels; none where one of them is within the other.
  std::string belt(const Shape& shape) const {
    const Place axle = axis(shape.axis), first = s_.at(s_.nominal, stance_.row, shape.from),
                second = s_.at(s_.nominal, stance_.row, shape.to);
    Place across = minus(second, first);
    const double beside = dot(across, axle);
    for (std::size_t i = 0; i < 3; ++i) across[i] = Scene::unit * (across[i] - beside * axle[i]);
    const double distance = norm(across), along = (shape.size - shape.other) / distance;
    if (!isKnown(axle) || !(std::fabs(along) < 1)) return {};
    for (double& part : across) part /= distance;
    const double aside = std::sqrt(1 - along * along);
    const Sight e = direction(across), c = direction(cross(axle, across)), p = sightOf(s_, first, stance_),
                q = sightOf(s_, second, stance_);
    std::string path;
    for (const double side : {aside, -aside}) {
      const double x = along * e.x + side * c.x, y = along * e.y + side * c.y;
      path += straight({p.x + shape.size * x, p.y + shape.size * y}, {q.x + shape.other * x, q.y + shape.other * y});
    }
    return path;
  }

  /// Its rim, and the spoke along the axis behind that of the axle; nothing where one of them is unknown.
  std::string wheel(const Sight& at, std::size_t number, double radius) const {
    const Place axle = axis(number), along = axis(number + 1);
    const Sight u = direction(along), v = direction(cross(axle, along));
    if (!isOnPaper(u) || !isOnPaper(v)) return {};
    constexpr int corners = 32;
    constexpr double turn = 2 * 3.14159265358979323846;
    std::string path;
    for (int k = 0; k < corners; ++k) {
      const double x = radius * std::cos(turn * k / corners), y = radius * std::sin(turn * k / corners);
      path += (k == 0 ? "M" : "L") + pair({at.x + x * u.x + y * v.x, at.y + x * u.y + y * v.y});
    }
    return path + "Z" + straight(at, {at.x + radius * u.x, at.y + radius * u.y});
  }

 private:
  Place axis(std::size_t number) const {
    return placeOf(s_.axes, stance_.row, s_.axes.size() / std::max<std::size_t>(1, 3 * s_.time.size()), number);
  }

  static Sight times(const Sight& a, double factor) { return {factor * a.x, factor * a.y}; }

  /// What lies of the plane beneath the second point.
  Place footOf(const Shape& shape, const Place& normal) const {
    Place foot = s_.at(s_.nominal, stance_.row, shape.to);
    const double height = dot(minus(foot, s_.at(s_.nominal, stance_.row, shape.from)), normal);
    for (std::size_t i = 0; i < 3; ++i) foot[i] = foot[i] - height * normal[i];
    return foot;
  }

  /// A line, and short ones from every fourth place of it, backwards and down.
  static std::string ground(const std::vector<Sight>& line, const Sight& ahead, const Sight& up) {
    constexpr std::size_t every = 4;
    constexpr double back = 4, down = 6;
    std::string path, hatch;
    bool isBegun = false;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const bool isThere = isOnPaper(line[k]);
      if (isThere) path += (isBegun ? "L" : "M") + pair(line[k]);
      if (isThere && k % every == every / 2)
        hatch +=
            straight(line[k], {line[k].x - back * ahead.x - down * up.x, line[k].y - back * ahead.y - down * up.y});
      isBegun = isThere;
    }
    return path + hatch;
  }

  const Scene& s_;
  const Stance& stance_;
};

}  // namespace

Sight sightOf(const Scene& scene, const Place& place, const Stance& stance) {
  const View& view = scene.view;
  return {view.width / 2 + Scene::unit * dot(place, stance.right),
          view.height / 2 - Scene::unit * dot(place, stance.up)};
}

/// By rising x, then the lower and the upper chain (A. M. Andrew, Inf. Process. Lett. 9, 1979).
std::string hullPath(std::vector<Sight> sights) {
  std::ranges::sort(sights, [](const Sight& a, const Sight& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::string path;
  const auto chain = [&] {
    std::vector<Sight> found;
    for (const Sight& p : sights) {
      const auto turnsRight = [&] {
        const Sight &a = found[found.size() - 2], &b = found.back();
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) <= 0;
      };
      while (found.size() >= 2 && turnsRight()) found.pop_back();
      found.push_back(p);
    }
    for (std::size_t i = 0; i + 1 < found.size(); ++i) path += (path.empty() ? "M" : "L") + pair(found[i]);
  };
  chain();
  std::ranges::reverse(sights);
  chain();
  return path.empty() ? path : path + "Z";
}

std::vector<std::pair<std::string_view, std::string>> attributesOf(const Scene& scene, const Shape& shape,
                                                                   const Stance& stance) {
  using enum Shape::Form;
  const Picture picture(scene, stance);
  if (shape.form == sample) return {{"d", picture.sample(shape.from)}};
  if (shape.form == now) return {{"d", picture.now()}};
  if (shape.form == swept) return {{"d", picture.swept()}};
  if (shape.form == arrow || shape.form == letter) {
    Place e{};
    e[shape.from] = 1;
    const Sight to = picture.direction(e), at{30, scene.view.height - 30};
    if (std::hypot(to.x, to.y) <= 0.2) return {};
    if (shape.form == arrow) return {{"d", straight(at, {at.x + 20 * to.x, at.y + 20 * to.y})}};
    return {{"x", text(at.x + 28 * to.x)}, {"y", text(at.y + 28 * to.y + 4)}};
  }
  const bool isAtOne = shape.form == pin || shape.form == wheel || shape.form == road;
  const Sight to = picture.point(scene.nominal, stance.row, shape.to),
              from = isAtOne ? to : picture.point(scene.nominal, stance.row, shape.from);
  if (!isOnPaper(from) || !isOnPaper(to)) return {};
  if (shape.form == circle) return {{"cx", text(to.x)}, {"cy", text(to.y)}};
  if (shape.form == name) return {{"x", text(to.x + 15)}, {"y", text(to.y - 9)}};
  if (shape.form == sign) return {{"transform", "translate(" + pair(to) + ")"}};
  return {{"d", shape.form == pin       ? picture.pin(to, shape.from)
                : shape.form == wheel   ? picture.wheel(to, shape.from, shape.size)
                : shape.form == belt    ? picture.belt(shape)
                : shape.form == plane   ? picture.plane(shape)
                : shape.form == road    ? picture.road(to, shape)
                : shape.form == zigzag  ? spring(from, to, shape.size)
                : shape.form == dashpot ? damper(from, to, shape.size)
                                        : straight(from, to)}};
}

std::string sceneData(const Scene& scene) {
  constexpr const char* forms[] = {"line", "zigzag", "dashpot", "circle", "name", "sign",  "pin",   "wheel",
                                   "belt", "plane",  "road",    "sample", "now",  "swept", "arrow", "letter"};
  const View& view = scene.view;
  std::vector<std::string> shapes, links, roads;
  for (const Shape& shape : scene.shapes)
    shapes.push_back(fmt::format("[\"{}\",{},{},{:.1f},{},{:.1f}]", forms[static_cast<int>(shape.form)], shape.from,
                                 shape.to, shape.size, shape.axis, shape.other));
  for (const auto& [from, to] : scene.links) links.push_back(fmt::format("[{},{}]", from, to));
  const auto vector = [](const Place& v) { return numberList({v[0], v[1], v[2]}, 9); };
  const auto wholes = [](const std::vector<double>& list) { return numberList(list, 10); };
  for (const std::vector<double>& heights : scene.roads) roads.push_back(wholes(heights));
  return fmt::format(
      R"({{"unit":{},"width":{:g},"height":{:g},"pin":{},"right":{},"up":{},"vertical":{},"isSide":{},"time":{},)"
      R"("points":{},"shapes":{},"links":{},"moving":{},"nominal":{},"axes":{},"samples":{},"lower":{},"upper":{},"sag":{},"roads":{}}})",
      Scene::unit, view.width, view.height, pinLength, vector(view.right), vector(view.up), vector(view.vertical),
      view.isSideView, numberList(scene.time, 9), scene.points, jsonList(shapes), jsonList(links),
      wholes({scene.moving.begin(), scene.moving.end()}), wholes(scene.nominal), numberList(scene.axes, 4),
      wholes(scene.samples), wholes(scene.lower), wholes(scene.upper), wholes(scene.sag), jsonList(roads));
}

}  // namespace gamut
