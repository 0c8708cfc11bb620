// A plane through three points is a face's if all others are on one side. The corners of a face go round it: from the
// least point on, next is the one that all others are to the left of, seen from outside, and of several on one line the
// farthest.
#include "mechanics/polyhedron.hpp"

#include <algorithm>

#include "mechanics/description/units.hpp"

namespace gamut {
namespace {

using Point = Polyhedron::Point;

mpq_class dot(const Point& x, const Point& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Point difference(const Point& x, const Point& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Point cross(const Point& x, const Point& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
bool isZero(const Point& x) { return x[0] == 0 && x[1] == 0 && x[2] == 0; }

Interval lengthOf(const Point& x) { return sqrt(enclosureOf(dot(x, x))); }

/// Exact where it is along an axis.
Polyhedron::Direction unitOf(const Point& x) {
  const bool isAligned = std::ranges::count_if(x, [](const mpq_class& part) { return part != 0; }) == 1;
  Polyhedron::Direction unit = {0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i)
    if (x[i] != 0) unit[i] = isAligned ? Interval(sgn(x[i])) : enclosureOf(x[i]) / lengthOf(x);
  return unit;
}

/// normal·x of a unit vector along `normal`, which is of any length.
Interval offsetOf(const Point& normal, const Point& x) { return enclosureOf(dot(normal, x)) / lengthOf(normal); }

/// At least 1/sin²(a/2) = 2/(1 - cos a) of the angle a between two sides u, v, one after the other, |u||v| cos a =
/// -u·v. Where it is acute, 1 - cos a = |u × v|²/(|u||v| (|u||v| - u·v)), by exact products, has a value however acute
/// it is.
double spreadOf(const Point& u, const Point& v) {
  const mpq_class along = dot(u, v);
  const Interval lengths = sqrt(enclosureOf(dot(u, u) * dot(v, v)));
  if (along >= 0) return (Interval(2.0) / (Interval(1.0) + enclosureOf(along) / lengths)).upper();
  const Point across = cross(u, v);
  return (Interval(2.0) * lengths * (lengths - enclosureOf(along)) / enclosureOf(dot(across, across))).upper();
}

/// The number of the direction of `vector`, either way, among `vectors`, to which it is added if it is new.
std::size_t directionOf(const Point& vector, std::vector<Point>& vectors, std::vector<Polyhedron::Direction>& units) {
  const auto found = std::ranges::find_if(vectors, [&](const Point& other) { return isZero(cross(vector, other)); });
  const auto number = static_cast<std::size_t>(found - vectors.begin());
  if (found == vectors.end()) {
    vectors.push_back(vector);
    units.push_back(unitOf(vector));
  }
  return number;
}

}  // namespace

Interval enclosureOf(const mpq_class& number) { return enclose(Amount{number, 0, {}}); }

std::optional<std::vector<Point>> exactPoints(const std::vector<ExpressionVector>& points) {
  std::vector<Point> exact;
  for (const ExpressionVector& point : points) {
    Point& own = exact.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      if (!point[i].isConstant()) return std::nullopt;
      const Interval value = point[i].evaluate<Interval>([](const std::string&) { return Interval::entire(); });
      if (const auto amount = point[i].amount(); amount && amount->piPower == 0)
        own[i] = amount->value;
      else if (value.lower() == value.upper())
        own[i] = value.lower();
      else
        return std::nullopt;
    }
  }
  return exact;
}

Polyhedron::Polyhedron(const std::vector<Point>& points) {
  std::vector<std::vector<std::size_t>> known;  // planes, by the points in them
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        Point normal = cross(difference(points[j], points[i]), difference(points[k], points[i]));
        if (isZero(normal)) continue;
        std::vector<std::size_t> inPlane;
        bool isAbove = false, isBelow = false;
        for (std::size_t l = 0; l < points.size() && !(isAbove && isBelow); ++l) {
          const int side = sgn(dot(normal, difference(points[l], points[i])));
          isAbove = isAbove || side > 0;
          isBelow = isBelow || side < 0;
          if (side == 0) inPlane.push_back(l);
        }
        if (isAbove == isBelow || std::ranges::count(known, inPlane) != 0) continue;
        known.push_back(inPlane);
        if (isAbove)
          for (mpq_class& part : normal) part = -part;
        addFace(points, normal, std::move(inPlane));
      }
}

std::size_t Polyhedron::cornerAt(const Point& point) {
  const auto found = std::ranges::find(corners_, point);
  const auto number = static_cast<std::size_t>(found - corners_.begin());
  if (found == corners_.end()) corners_.push_back(point);
  return number;
}

void Polyhedron::addFace(const std::vector<Point>& points, const Point& normal, std::vector<std::size_t> inPlane) {
  std::ranges::sort(inPlane, [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
  std::vector<Point> round = {points[inPlane.front()]};
  while (true) {
    const Point& at = round.back();
    Point next = at;
    for (const std::size_t candidate : inPlane) {
      const Point &other = points[candidate], ahead = difference(other, at);
      if (isZero(ahead)) continue;
      const Point best = difference(next, at);
      const int side = sgn(dot(normal, cross(best, ahead)));
      if (isZero(best) || side < 0 || (side == 0 && dot(ahead, ahead) > dot(best, best))) next = other;
    }
    if (next == round.front()) break;
    round.push_back(next);
  }
  Face face{unitOf(normal), offsetOf(normal, round.front()), {}};
  directionOf(normal, faceVectors_, normals_);
  for (std::size_t i = 0; i < round.size(); ++i) {
    const Point &from = round[i], &to = round[(i + 1) % round.size()];
    const Point along = difference(to, from), outwards = cross(along, normal);
    face.sides.push_back({unitOf(outwards), offsetOf(outwards, from)});
    const std::size_t first = cornerAt(from), second = cornerAt(to);
    if (std::ranges::none_of(edges_, [&](const Edge& edge) { return edge.from == second && edge.to == first; }))
      edges_.push_back({first, second, directionOf(along, edgeVectors_, directions_), lengthOf(along) / Interval(2.0)});
    spread_ = std::max(spread_, spreadOf(along, difference(round[(i + 2) % round.size()], to)));
  }
  faces_.push_back(std::move(face));
}

}  // namespace gamut
