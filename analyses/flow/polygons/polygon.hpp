// Convex polygons that are known by their sides: what is wanted of one is what it reaches in a direction, bounded by
// two sides, so that no corner has to be found exactly. docs/flow.md, section 6.
#pragma once

#include <array>
#include <vector>

#include "scalars/interval.hpp"

namespace gamut {

/// Directions and places in the plane.
using PlaneVector = std::array<double, 2>;
using PlaneBox = std::array<Interval, 2>;

inline double dot(const PlaneVector& a, const PlaneVector& b) { return a[0] * b[0] + a[1] * b[1]; }
inline double cross(const PlaneVector& a, const PlaneVector& b) { return a[0] * b[1] - a[1] * b[0]; }
inline Interval dot(const PlaneBox& a, const PlaneBox& b) { return a[0] * b[0] + a[1] * b[1]; }
inline Interval cross(const PlaneBox& a, const PlaneBox& b) { return a[0] * b[1] - a[1] * b[0]; }
inline PlaneBox enclosed(const PlaneVector& a) { return {Interval(a[0]), Interval(a[1])}; }

/// All x with normal·x ≤ offset; `rate` is of whoever moves it.
struct PolygonSide {
  PlaneVector normal;
  double offset;
  double rate = 0;
};

/// The x on the inner side of all sides: their normals turn counterclockwise, each by less than a half turn.
class Polygon {
 public:
  Polygon() = default;
  /// False: no bounds follow from these sides.
  bool load(std::vector<PolygonSide> sides);

  const std::vector<PolygonSide>& sides() const { return sides_; }
  std::size_t next(std::size_t i) const { return i + 1 < sides_.size() ? i + 1 : 0; }
  std::size_t before(std::size_t i) const { return (i > 0 ? i : sides_.size()) - 1; }
  /// All of it lies in here.
  const PlaneBox& box() const { return box_; }
  /// u·x is no greater for any x in it.
  double reach(const PlaneVector& u) const;
  /// Where sides i and i + 1 meet, about.
  PlaneVector corner(std::size_t i) const;
  bool isAway(const PlaneBox& from) const;  ///< proved to have no x in there
  bool holds(const PlaneVector& x) const;   ///< about

 private:
  double reach(const PlaneVector& u, double largest) const;
  std::vector<PolygonSide> sides_;
  PlaneBox box_;
  double largest_ = 0;  // |x| + |y| at most
};

}  // namespace gamut
