// The convex polyhedron that is the hull of some points, found exactly: numbers are rational.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "mechanics/description/fields.hpp"
#include "mechanics/description/units.hpp"
#include "scalars/interval.hpp"

namespace gamut {

class Polyhedron {
 public:
  using Point = std::array<mpq_class, 3>;
  using Direction = std::array<Interval, 3>;  ///< a unit vector
  struct Edge {
    std::size_t from, to, direction;  ///< corners; of `directions()`
    Interval half;                    ///< of its length
  };
  /// x with normal·x = offset and, of each side, no more of its normal, which lies in the face, than its offset.
  struct Face {
    struct Side {
      Direction normal;
      Interval offset;
    };
    Direction normal;  ///< outwards
    Interval offset;
    std::vector<Side> sides;
  };

  static constexpr std::size_t mostPoints = 40;

  /// Of `mostPoints` at most. There are no faces if all lie in one plane.
  explicit Polyhedron(const std::vector<Point>& points);

  const std::vector<Point>& corners() const { return corners_; }
  const std::vector<Edge>& edges() const { return edges_; }
  const std::vector<Face>& faces() const { return faces_; }
  /// Of edges, and of faces, one each way.
  const std::vector<Direction>& directions() const { return directions_; }
  const std::vector<Direction>& normals() const { return normals_; }
  /// No angle a of a face has a greater 1/sin²(a/2).
  double spread() const { return spread_; }

 private:
  void addFace(const std::vector<Point>& points, const Point& normal, std::vector<std::size_t> inPlane);
  std::size_t cornerAt(const Point& point);

  std::vector<Point> corners_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  std::vector<Direction> directions_, normals_;
  std::vector<Point> edgeVectors_, faceVectors_;  // of directions_ and normals_, of any length
  double spread_ = 1;
};

/// None where a number is a formula, or no double and not rational.
std::optional<std::vector<Polyhedron::Point>> exactPoints(const std::vector<ExpressionVector>& points);

/// The tightest enclosure.
Interval enclosureOf(const mpq_class& number);

}  // namespace gamut
