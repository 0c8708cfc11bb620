// Of two solids, convex and bounded by planes, each seen from the axes of the other; one may be a segment. Where they
// are apart, the square of their distance is that of a corner of one from the other, or of an edge from an edge, and
// all of these are squares between points of both:
//
//   d² = min(corners of one from the other, corners of the other from the one, edges from edges).
//
// Where a direction of a box is the same in both, as where all moves in planes across it, what they are apart along it
// and across it are two questions: the second is of polygons, which are apart by what a corner is from the other one.
//
// Where they overlap d is 0, though corners and edges may be apart, as of a rod through a plate. They are apart if and
// only if a plane along a face of one, or along an edge of each, lies between them (S. Gottschalk, M. Lin and
// D. Manocha, OBBTree, SIGGRAPH 1996): if one of the gaps along these directions, whatever their lengths, is above
// zero.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mechanics/elements/segment_distance.hpp"
#include "mechanics/polyhedron.hpp"
#include "scalars/index.hpp"

namespace gamut {

/// In its own axes [m].
template <class S>
struct Solid {
  struct Edge {
    std::size_t from, to, direction;  ///< corners; of `directions`
    S half;                           ///< of its length
  };
  /// x with normal·x = offset, and no more of each side's.
  struct Face {
    Vector3<S> normal;
    S offset;
    std::vector<std::pair<Vector3<S>, S>> sides;
  };
  /// What it reaches along a direction.
  struct Extent {
    S middle, half;
  };
  std::vector<Vector3<S>> corners, directions, normals;  ///< unit vectors; of normals one each way
  std::vector<Edge> edges;
  std::vector<S> halves;    ///< along each direction, if it is as far to either side of the origin: a box, a segment
  std::vector<Face> faces;  ///< of others
  S spread = S(1.0);        ///< 1/sin²(a/2), no angle of a face is less than a

  /// |x_i| ≤ halves[i]
  static Solid cuboid(const Vector3<S>& halves);
  /// s `along`, |s| ≤ half
  static Solid segment(const Vector3<S>& along, const S& half);
  explicit Solid(const Polyhedron& hull);
  Solid() = default;

  bool isCuboid() const { return halves.size() == 3; }
  bool isSegment() const { return halves.size() == 1; }
  Segment<S> along(const Edge& edge) const {
    return {S(0.5) * (corners[edge.from] + corners[edge.to]), directions[edge.direction], edge.half};
  }
  /// Of a point from it, outside [m²]; inside 0 from a box, and from others the distance of their surface.
  S squareTo(const Vector3<S>& point) const;
  /// Of a box, as if it had no end along direction k.
  S squareAcross(const Vector3<S>& point, int k) const;
  /// How far a point is beyond the face that it is farthest beyond; below 0 inside.
  S beyond(const Vector3<S>& point) const;
  /// Times the direction's length.
  Extent extent(const Vector3<S>& direction) const;
};

template <class S>
Solid<S>::Solid(const Polyhedron& hull) : spread(hull.spread()) {
  const auto vector = [](const Polyhedron::Direction& of) {
    return Vector3<S>(constant<S>(of[0]), constant<S>(of[1]), constant<S>(of[2]));
  };
  for (const Polyhedron::Point& corner : hull.corners())
    corners.push_back(vector({enclosureOf(corner[0]), enclosureOf(corner[1]), enclosureOf(corner[2])}));
  for (const auto& direction : hull.directions()) directions.push_back(vector(direction));
  for (const auto& normal : hull.normals()) normals.push_back(vector(normal));
  for (const Polyhedron::Edge& edge : hull.edges())
    edges.push_back({edge.from, edge.to, edge.direction, constant<S>(edge.half)});
  for (const Polyhedron::Face& face : hull.faces()) {
    faces.push_back({vector(face.normal), constant<S>(face.offset), {}});
    for (const auto& side : face.sides) faces.back().sides.emplace_back(vector(side.normal), constant<S>(side.offset));
  }
}

template <class S>
Solid<S> Solid<S>::cuboid(const Vector3<S>& halves) {
  Solid box;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Vector3<S>& place = box.corners.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<int>(i);
      const bool isFar = (corner >> i & 1U) != 0;
      place[k] = isFar ? halves[k] : S(-halves[k]);
      if (!isFar) box.edges.push_back({corner, corner | std::size_t(1) << i, i, halves[k]});
    }
  }
  for (int i = 0; i < 3; ++i) {
    box.directions.push_back(unitMatrix<S>().col(i));
    box.halves.push_back(halves[i]);
  }
  box.normals = box.directions;
  return box;
}

template <class S>
Solid<S> Solid<S>::segment(const Vector3<S>& along, const S& half) {
  Solid line;
  line.corners = {along * half, along * S(-half)};
  line.directions = {along};
  line.halves = {half};
  line.edges = {{0, 1, 0, half}};
  return line;
}

/// A point y at an edge of a face, or beyond a corner with the angle a, is beyond the face's sides by `out` at most one
/// of, and of these one is sin(a/2) of its distance or more: so no candidate is less than the distance.
template <class S>
S Solid<S>::squareTo(const Vector3<S>& point) const {
  using std::min;
  if (isCuboid()) return squareAcross(point, -1);
  S least = along(edges[0]).squareTo(point);
  for (const Edge& edge : edges) least = min(least, along(edge).squareTo(point));
  for (const Face& face : faces) {
    S out(0.0);
    for (const auto& [side, offset] : face.sides) out = out + square(positive(S(side.dot(point) - offset)));
    least = min(least, S(square(S(face.normal.dot(point) - face.offset)) + spread * out));
  }
  return least;
}

template <class S>
S Solid<S>::squareAcross(const Vector3<S>& point, int k) const {
  using std::abs;
  S sum(0.0);
  for (int i = 0; i < 3; ++i)
    if (i != k) sum = sum + square(positive(S(S(abs(point[i])) - halves[detail::at(i)])));
  return sum;
}

template <class S>
S Solid<S>::beyond(const Vector3<S>& point) const {
  using std::max;
  const auto of = [&](const Face& face) { return S(face.normal.dot(point) - face.offset); };
  S most = of(faces.front());
  for (const Face& face : faces) most = max(most, of(face));
  return most;
}

template <class S>
typename Solid<S>::Extent Solid<S>::extent(const Vector3<S>& direction) const {
  using std::abs, std::max, std::min;
  if (!halves.empty()) {
    S sum(0.0);
    for (std::size_t i = 0; i < halves.size(); ++i) sum = sum + halves[i] * S(abs(S(directions[i].dot(direction))));
    return {S(0.0), sum};
  }
  S least = corners[0].dot(direction), most = least;
  for (const Vector3<S>& corner : corners) {
    least = min(least, S(corner.dot(direction)));
    most = max(most, S(corner.dot(direction)));
  }
  return {S(0.5) * (least + most), S(0.5) * (most - least)};
}

template <class S>
class SolidNearest;

/// Two solids. The first has its origin at `origin`, in the axes of the second, and its axes there are `axes`. A
/// segment is the first, and the second none.
template <class S>
class SolidPair {
 public:
  SolidPair(Solid<S> one, Solid<S> other, const Matrix3<S>& axes, const Vector3<S>& origin)
      : one_(std::move(one)), other_(std::move(other)), axes_(axes), origin_(origin) {
    const Vector3<S> otherOrigin = -(axes.transpose() * origin);
    for (const Vector3<S>& x : one_.corners) oneCorners_.push_back(origin + axes * x);
    for (const Vector3<S>& x : other_.corners) otherCorners_.push_back(otherOrigin + axes.transpose() * x);
    for (const Vector3<S>& x : one_.directions) oneDirections_.push_back(axes * x);
    for (const Vector3<S>& x : other_.directions) otherDirections_.push_back(axes.transpose() * x);
  }

  S squareBetween() const;

 private:
  friend class SolidNearest<S>;
  using Edge = typename Solid<S>::Edge;
  using Vectors = std::vector<Vector3<S>>;

  Vector3<S> inOne(const Vector3<S>& direction) const { return axes_.transpose() * direction; }
  static bool isKnownToVanish(const Vector3<S>& x) {
    return isKnownZero(x[0]) && isKnownZero(x[1]) && isKnownZero(x[2]);
  }
  static Vector3<S> middleOf(const Vectors& corners, const Edge& edge) {
    return S(0.5) * (corners[edge.from] + corners[edge.to]);
  }
  static std::vector<std::vector<S>> cornersToEdges(const Vectors& corners, const Solid<S>& solid);

  /// A direction of either that is the same; of a segment -1, and one that it is at right angles to. {-1, -1}: none.
  std::pair<int, int> shared() const;
  S squareAcross(int ofOne, int ofOther) const;
  void takeEdges(S& least) const;
  /// Along a direction in the axes of the second, times its length.
  S gap(const Vector3<S>& direction) const;
  /// 1 where they overlap, 0 where they are apart; the latter as seen along a direction that is shared.
  S overlap() const;
  S overlapAcross(int ofOne, int ofOther) const;
  static S isNone(const S& gap) { return S(0.5) - S(0.5) * signOf(gap); }

  Solid<S> one_, other_;
  Matrix3<S> axes_;
  Vector3<S> origin_;
  Vectors oneCorners_, oneDirections_, otherCorners_, otherDirections_;  // as the other one sees them
};

template <class S>
std::pair<int, int> SolidPair<S>::shared() const {
  for (int j = 0; other_.isCuboid() && j < 3; ++j) {
    if (one_.isSegment() && isKnownZero(oneDirections_[0][j])) return {-1, j};
    for (int i = 0; one_.isCuboid() && i < 3; ++i)
      if (isKnownToVanish(oneDirections_[detail::at(i)].cross(other_.directions[detail::at(j)]))) return {i, j};
  }
  return {-1, -1};
}

template <class S>
S SolidPair<S>::squareBetween() const {
  using std::min;
  if (const auto [ofOne, ofOther] = shared(); ofOther >= 0) return squareAcross(ofOne, ofOther);
  S least = other_.squareTo(oneCorners_.front());
  for (const Vector3<S>& corner : oneCorners_) least = min(least, other_.squareTo(corner));
  for (const Vector3<S>& corner : otherCorners_) least = min(least, one_.squareTo(corner));
  takeEdges(least);
  return positive(least) * (S(1.0) - overlap());
}

/// Across the direction `ofOther` of a box, which is `ofOne` of another box, or at right angles to a segment.
template <class S>
S SolidPair<S>::squareAcross(int ofOne, int ofOther) const {
  using std::abs, std::min;
  const Vector3<S>& across = other_.directions[detail::at(ofOther)];
  const auto flat = [&](Vector3<S> x) {
    x[ofOther] = S(0.0);
    return x;
  };
  const bool isSegment = ofOne < 0;
  const Segment<S> segment{flat(origin_), oneDirections_[0], one_.halves[0]};
  S least = other_.squareAcross(oneCorners_[0], ofOther);
  for (std::size_t k = 0; k < oneCorners_.size(); ++k)  // of a box those at one end
    if (isSegment || (k >> detail::at(ofOne) & 1U) == 0)
      least = min(least, other_.squareAcross(oneCorners_[k], ofOther));
  for (std::size_t k = 0; k < otherCorners_.size(); ++k)
    if ((k >> detail::at(ofOther) & 1U) == 0)
      least = min(least,
                  isSegment ? segment.squareTo(flat(other_.corners[k])) : one_.squareAcross(otherCorners_[k], ofOne));
  return square(positive(gap(across))) + least * (S(1.0) - overlapAcross(ofOne, ofOther));
}

template <class S>
S SolidPair<S>::overlapAcross(int ofOne, int ofOther) const {
  const bool isSegment = ofOne < 0;
  S overlaps(1.0);
  for (int k = 0; k < 3; ++k) {
    if (k != ofOther) overlaps = overlaps * isNone(gap(other_.directions[detail::at(k)]));
    if (!isSegment && k != ofOne) overlaps = overlaps * isNone(gap(oneDirections_[detail::at(k)]));
  }
  if (isSegment) overlaps = overlaps * isNone(gap(oneDirections_[0].cross(other_.directions[detail::at(ofOther)])));
  return overlaps;
}

/// Of corners from the edges of a solid in whose axes they are.
template <class S>
std::vector<std::vector<S>> SolidPair<S>::cornersToEdges(const Vectors& corners, const Solid<S>& solid) {
  std::vector<std::vector<S>> all;
  for (const Vector3<S>& corner : corners) {
    std::vector<S>& ofCorner = all.emplace_back();
    for (const Edge& edge : solid.edges) ofCorner.push_back(solid.along(edge).squareTo(corner));
  }
  return all;
}

template <class S>
void SolidPair<S>::takeEdges(S& least) const {
  using std::min;
  const auto toOther = cornersToEdges(oneCorners_, other_), toOne = cornersToEdges(otherCorners_, one_);
  for (std::size_t e = 0; e < one_.edges.size(); ++e)
    for (std::size_t f = 0; f < other_.edges.size(); ++f) {
      const Edge &a = one_.edges[e], &b = other_.edges[f];
      const Vector3<S>&ownA = one_.directions[a.direction], &seenA = oneDirections_[a.direction],
            &ownB = other_.directions[b.direction], &seenB = otherDirections_[b.direction];
      const Crossing<S> crossing(seenA.cross(ownB), ownA.cross(seenB));
      if (crossing.isParallel()) continue;
      const Vector3<S> inOther = middleOf(oneCorners_, a) - middleOf(other_.corners, b),
                       inOwn = middleOf(one_.corners, a) - middleOf(otherCorners_, b);
      const S first = crossing.nearest(0, ownB.cross(inOther)), second = crossing.nearest(1, ownA.cross(inOwn)),
              ends = min(S(min(toOther[a.from][f], toOther[a.to][f])), S(min(toOne[b.from][e], toOne[b.to][e])));
      least = min(least, S(ends - crossing.squareInside(a.half, first, b.half, second)));
    }
}

template <class S>
S SolidPair<S>::gap(const Vector3<S>& direction) const {
  using std::abs;
  const auto own = one_.extent(inOne(direction)), others = other_.extent(direction);
  return S(abs(S(origin_.dot(direction)) + own.middle - others.middle)) - own.half - others.half;
}

/// Of edges that are parallel but for what rounding leaves, gaps may be what it leaves too, above zero: so they count
/// from somewhere between 0 and 2⁻⁴⁰ of the solids' lengths on, which bounds take for either.
template <class S>
S SolidPair<S>::overlap() const {
  S overlaps(1.0), size(0.0);
  const auto normalsOf = [&](const Solid<S>& solid, bool isSeen) {
    for (const Vector3<S>& own : solid.normals) {
      const Vector3<S> normal = isSeen ? Vector3<S>(axes_ * own) : own;
      overlaps = overlaps * isNone(gap(normal));
    }
  };
  normalsOf(other_, false);
  normalsOf(one_, true);
  for (const Solid<S>* solid : {&one_, &other_})
    for (const Edge& edge : solid->edges) size = size + edge.half;
  const S slack = constant<S>(Interval(0.0, 0x1p-40)) * size;
  for (const Vector3<S>& a : oneDirections_)
    for (const Vector3<S>& b : other_.directions)
      if (const Vector3<S> x = a.cross(b); !isKnownToVanish(x)) overlaps = overlaps * isNone(S(gap(x) - slack));
  return overlaps;
}

}  // namespace gamut
