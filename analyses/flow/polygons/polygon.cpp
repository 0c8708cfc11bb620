// Bounds of a convex polygon by linear programming's dual: u = a·normal + b·next with a, b ≥ 0.
#include "analyses/flow/polygons/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gamut {

bool Polygon::load(std::vector<PolygonSide> sides) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  sides_ = std::move(sides);
  largest_ = infinite;
  box_ = {Interval::entire(), Interval::entire()};
  if (sides_.size() < 3) return false;
  for (std::size_t i = 0; i < sides_.size(); ++i)
    if (!(cross(sides_[i].normal, sides_[next(i)].normal) > 0) || !std::isfinite(sides_[i].offset)) return false;
  // u differs from a·normal + b·next by 2^-34 at most, so |x|∞ ≤ size + 2^-33 |x|∞: it is finite, since the sides
  // close.
  double size = 0;
  for (const PlaneVector& u : {PlaneVector{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) size = std::max(size, reach(u, 0));
  if (!std::isfinite(size)) return false;
  largest_ = 2 * size * (1 + 0x1p-30);
  const double right = reach({1, 0}), left = -reach({-1, 0}), top = reach({0, 1}), bottom = -reach({0, -1});
  if (!(left <= right && bottom <= top)) return false;
  box_ = {Interval(left, right), Interval(bottom, top)};
  return true;
}

double Polygon::reach(const PlaneVector& u) const { return reach(u, largest_); }

/// Any a, b ≥ 0 will do; what is left of u meets |x| + |y| ≤ largest.
double Polygon::reach(const PlaneVector& u, double largest) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double least = infinite;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const PolygonSide &one = sides_[i], &other = sides_[next(i)];
    const double along = cross(one.normal, u), across = cross(u, other.normal);
    const double whole = cross(one.normal, other.normal);
    const double a = std::max(0.0, across / whole), b = std::max(0.0, along / whole);
    const double little = -1e-12 * whole;
    if (!(along >= little && across >= little)) continue;
    if (!(a < 0x1p100 && b < 0x1p100)) continue;
    double rest = 0;
    for (std::size_t k : {0U, 1U})
      rest = std::max(rest, magnitude(Interval(u[k]) - Interval(a) * one.normal[k] - Interval(b) * other.normal[k]));
    if (!(rest <= 0x1p-34 * std::max(std::fabs(u[0]), std::fabs(u[1])))) continue;
    const Interval bound = Interval(a) * one.offset + Interval(b) * other.offset + Interval(rest) * largest;
    least = std::min(least, bound.upper());
  }
  return least;
}

PlaneVector Polygon::corner(std::size_t i) const {
  const PolygonSide &one = sides_[i], &other = sides_[next(i)];
  const double whole = cross(one.normal, other.normal);
  return {(one.offset * other.normal[1] - other.offset * one.normal[1]) / whole,
          (one.normal[0] * other.offset - other.normal[0] * one.offset) / whole};
}

bool Polygon::isAway(const PlaneBox& from) const {
  return std::ranges::any_of(
      sides_, [&](const PolygonSide& side) { return dot(enclosed(side.normal), from).lower() > side.offset; });
}

bool Polygon::holds(const PlaneVector& x) const {
  return std::ranges::all_of(sides_, [&](const PolygonSide& side) { return dot(side.normal, x) <= side.offset; });
}

}  // namespace gamut
