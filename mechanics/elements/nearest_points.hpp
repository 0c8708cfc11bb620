// The points in which shapes without radii come nearest to each other. Where there are several pairs, what is found is
// one of them, and bounds hold all: pairs that are nearest make a convex set.
//
// Of two segments w + s a - t b (segment_distance.hpp) s = s₀ of the lines, no more than h, then t = a·b s + b·w, no
// more than k, and s = a·b t - a·w, no more than h: with s given, such a t is nearest, and likewise s. Where |x|² is
// less than `leastSize`, at an angle below 0.9°, s starts from what is off by h at most, since both are no more than h,
// and either end or anything between may be nearest. A sample starts in between, and so has points that are hardly
// farther.
//
// Of solids, pairs are offered one after the other, and the nearer is kept: a corner and what is nearest to it of the
// other solid, an edge and an edge. The corners of the set of all nearest pairs are among these.
//
// A direction is that of w, divided by |w|. Where |w| is less than `leastDistance` it is any one with components from
// -1 to 1.
#pragma once

#include <algorithm>
#include <cmath>

#include "mechanics/elements/solid_distance.hpp"

namespace gamut {

/// In one frame [m]. Where there are several pairs, all are equally far `apart`, whichever they are.
template <class S>
struct NearestPoints {
  Vector3<S> one, other, apart;  ///< the latter from the one to the other

  NearestPoints(Vector3<S> ofOne, Vector3<S> ofOther) : NearestPoints(ofOne, ofOther, ofOther - ofOne) {}
  NearestPoints(Vector3<S> ofOne, Vector3<S> ofOther, Vector3<S> difference)
      : one(std::move(ofOne)), other(std::move(ofOther)), apart(std::move(difference)) {}

  /// A component of others.
  void take(const NearestPoints& others, int axis) {
    one[axis] = others.one[axis];
    other[axis] = others.other[axis];
    apart[axis] = others.apart[axis];
  }
  /// The same of some, where `share` is 1.
  void mix(const NearestPoints& others, std::initializer_list<int> axes, const S& share) {
    for (Vector3<S> NearestPoints::*part : {&NearestPoints::one, &NearestPoints::other, &NearestPoints::apart})
      for (const int axis : axes)
        (this->*part)[axis] = (this->*part)[axis] + ((others.*part)[axis] - (this->*part)[axis]) * share;
  }
};

/// Nobody knows which number from -1 to 1.
template <class S>
S anySign() {
  return constant<S>(Interval(-1.0, 1.0));
}

/// No farther from 0 than `most`; in doubles exactly that where it would be.
template <class S>
S within(const S& x, const S& most) {
  return positive(S(S(2.0) * most - positive(S(most - x)))) - most;
}

/// 1 where x is below `limit`, else 0; at `limit` either.
template <class S>
S isBelow(const S& x, double limit) {
  return S(0.5) + S(0.5) * signOf(S(S(limit) - x));
}

/// A unit vector along w [m]; where w is next to nothing, any of [-1, 1]³.
template <class S>
Vector3<S> directionAlong(const Vector3<S>& w) {
  using std::max, std::sqrt;
  constexpr double leastDistance = 0x1p-40;  // m
  const S size = sqrt(squares(w)), divisor = max(size, S(leastDistance)), isNone = isBelow(size, leastDistance);
  Vector3<S> direction;
  for (int i = 0; i < 3; ++i) {
    const S along = w[i] / divisor;
    direction[i] = along + (anySign<S>() - along) * isNone;
  }
  return direction;
}

/// Of two stretches of a line: where they overlap, any number that both have.
template <class S>
struct NearestNumbers {
  S one, other, apart;

  NearestNumbers(const typename Solid<S>::Extent& first, const typename Solid<S>::Extent& second) {
    using std::max, std::min;
    const S low = max(S(first.middle - first.half), S(second.middle - second.half)),
            high = min(S(first.middle + first.half), S(second.middle + second.half));
    const S place = S(0.5) * (low + high) + anySign<S>() * positive(S(S(0.5) * (high - low)));
    one = first.middle + within(S(place - first.middle), first.half);
    other = second.middle + within(S(place - second.middle), second.half);
    const S between = second.middle - first.middle;
    apart = between - within(between, S(first.half + second.half));
  }
};

template <class S>
Vector3<S> nearestTo(const Vector3<S>& point, const Segment<S>& segment) {
  const Vector3<S> apart = point - segment.middle;
  return segment.middle + segment.along * within(S(segment.along.dot(apart)), segment.half);
}

/// Of two that are parallel as far as formulas tell.
template <class S>
NearestPoints<S> nearestOfParallel(const Segment<S>& one, const Segment<S>& other) {
  const Vector3<S> between = other.middle - one.middle;
  const S along = one.along.dot(between);
  const NearestNumbers<S> numbers({S(0.0), one.half}, {along, other.half});
  return {one.middle + one.along * numbers.one, other.middle + one.along * S(numbers.other - along),
          between + one.along * S(numbers.apart - along)};
}

template <class S>
NearestPoints<S> nearestOf(const Segment<S>& one, const Segment<S>& other) {
  using std::max;
  constexpr double leastSize = 0x1p-12;
  const Vector3<S> w = one.middle - other.middle, x = one.along.cross(other.along);
  if (Crossing<S>(x, x).isParallel()) return nearestOfParallel(one, other);
  const S ofOne = one.along.dot(w), ofOther = other.along.dot(w), both = one.along.dot(other.along);
  const S size = squares(x), ofLines = x.dot(other.along.cross(w)) / S(max(size, S(leastSize)));
  S s = within(ofLines, one.half) + one.half * anySign<S>() * isBelow(size, leastSize);
  const S t = within(S(ofOther + both * s), other.half);
  s = within(S(both * t - ofOne), one.half);
  return {one.middle + one.along * s, other.middle + other.along * t};
}

/// The nearest of the pairs that were offered. Two whose squares differ by 2⁻⁴⁰ of the square of `size` count as alike
/// for bounds, since rounding tells nothing of them.
template <class S>
class NearestPair {
 public:
  NearestPair(NearestPoints<S> first, const S& size)
      : pair_(std::move(first)),
        square_(squares(pair_.apart)),
        doubt_(anySign<S>() * (S(0x1p-40) * gamut::square(size))) {}

  /// `square`: of their distance, or more if they are none of both shapes.
  void offer(const NearestPoints<S>& pair, const S& square) {
    using std::min;
    const S isNearer = S(0.5) + S(0.5) * signOf(S(square_ - square + doubt_));
    pair_.mix(pair, {0, 1, 2}, isNearer);
    square_ = min(square_, square);
  }
  void offer(const NearestPoints<S>& pair) { offer(pair, squares(pair.apart)); }

  const NearestPoints<S>& pair() const { return pair_; }

 private:
  NearestPoints<S> pair_;
  S square_, doubt_;
};

/// Half of the edges' lengths, together [m].
template <class S>
S sizeOf(const Solid<S>& solid) {
  S size(0.0);
  for (const auto& edge : solid.edges) size = size + edge.half;
  return size;
}

/// Of a polyhedron. What is beyond the sides of a face counts for twice what it is away from that (Solid::squareTo): so
/// no face is as near as the point of an edge that is nearest.
template <class S>
Vector3<S> nearestOfFaces(const Vector3<S>& point, const Solid<S>& solid) {
  const auto alongEdge = [&](const typename Solid<S>::Edge& edge) {
    return NearestPoints<S>{point, nearestTo(point, solid.along(edge))};
  };
  NearestPair<S> nearest(alongEdge(solid.edges[0]), sizeOf(solid));
  for (std::size_t e = 1; e < solid.edges.size(); ++e) nearest.offer(alongEdge(solid.edges[e]));
  for (const auto& face : solid.faces) {
    const S height = face.normal.dot(point) - face.offset;
    S out(0.0);
    for (const auto& [side, offset] : face.sides) out = out + square(positive(S(side.dot(point) - offset)));
    nearest.offer({point, point - face.normal * height}, S(square(height) + S(2.0) * solid.spread * out));
  }
  const S inside = S(0.5) - S(0.5) * signOf(solid.beyond(point));
  return nearest.pair().other + inside * (point - nearest.pair().other);
}

template <class S>
Vector3<S> nearestTo(const Vector3<S>& point, const Solid<S>& solid) {
  if (solid.isSegment()) return nearestTo(point, solid.along(solid.edges[0]));
  if (!solid.isCuboid()) return nearestOfFaces(point, solid);
  return {within(point[0], solid.halves[0]), within(point[1], solid.halves[1]), within(point[2], solid.halves[2])};
}

/// In the axes of the second of two solids. Where they overlap it is any point of the box that holds what both have in
/// common, and the same of both.
template <class S>
class SolidNearest {
 public:
  explicit SolidNearest(const SolidPair<S>& pair) : pair_(pair), one_(pair.one_), other_(pair.other_) {}

  NearestPoints<S> points() const;

 private:
  using Edge = typename Solid<S>::Edge;

  Vector3<S> inOther(const Vector3<S>& point) const { return pair_.origin_ + pair_.axes_ * point; }
  NearestPoints<S> fromCorner(std::size_t corner) const {
    return {pair_.oneCorners_[corner], nearestTo(pair_.oneCorners_[corner], other_)};
  }
  NearestPoints<S> toCorner(std::size_t corner) const {
    return {inOther(nearestTo(pair_.otherCorners_[corner], one_)), other_.corners[corner]};
  }
  void offerEdges(NearestPair<S>& nearest) const;
  NearestPoints<S> across(int ofOne, int ofOther) const;
  NearestPoints<S> alongAxis(int axis) const;

  const SolidPair<S>& pair_;
  const Solid<S>&one_, &other_;
};

template <class S>
NearestPoints<S> SolidNearest<S>::points() const {
  if (const auto [ofOne, ofOther] = pair_.shared(); ofOther >= 0) return across(ofOne, ofOther);
  NearestPair<S> nearest(fromCorner(0), sizeOf(one_) + sizeOf(other_));
  for (std::size_t k = 1; k < one_.corners.size(); ++k) nearest.offer(fromCorner(k));
  for (std::size_t k = 0; k < other_.corners.size(); ++k) nearest.offer(toCorner(k));
  offerEdges(nearest);
  NearestPoints<S> common = alongAxis(0), points = nearest.pair();
  for (const int axis : {1, 2}) common.take(alongAxis(axis), axis);
  points.mix(common, {0, 1, 2}, pair_.overlap());
  return points;
}

/// Pairs of edges that are parallel have ends among those that are nearest.
template <class S>
void SolidNearest<S>::offerEdges(NearestPair<S>& nearest) const {
  for (const Edge& a : one_.edges) {
    const Vector3<S>&ownA = one_.directions[a.direction], &seenA = pair_.oneDirections_[a.direction];
    const Segment<S> first{SolidPair<S>::middleOf(pair_.oneCorners_, a), seenA, a.half};
    for (const Edge& b : other_.edges) {
      const Vector3<S>&ownB = other_.directions[b.direction], &seenB = pair_.otherDirections_[b.direction];
      if (Crossing<S>(seenA.cross(ownB), ownA.cross(seenB)).isParallel()) continue;
      nearest.offer(nearestOf(first, other_.along(b)));
    }
  }
}

/// What they are apart along the shared direction, and across it, are two questions (SolidPair::squareAcross); of boxes
/// that share all three, three.
template <class S>
NearestPoints<S> SolidNearest<S>::across(int ofOne, int ofOther) const {
  const int next = (ofOther + 1) % 3, last = (ofOther + 2) % 3;
  NearestPoints<S> points = alongAxis(ofOther);
  const Vector3<S> along = pair_.axes_.transpose().col(next);
  if (one_.isCuboid() && std::ranges::count_if(along, [](const S& x) { return !isKnownZero(x); }) == 1) {
    points.take(alongAxis(next), next);
    points.take(alongAxis(last), last);
    return points;
  }
  const auto flat = [&](Vector3<S> x) {
    x[ofOther] = S(0.0);
    return x;
  };
  const auto fromOne = [&](std::size_t k) {
    const Vector3<S> corner = flat(pair_.oneCorners_[k]);
    return NearestPoints<S>{corner, nearestTo(corner, other_)};
  };
  const auto toOne = [&](std::size_t k) {
    Vector3<S> corner = pair_.otherCorners_[k];
    if (ofOne >= 0) corner[ofOne] = S(0.0);
    return NearestPoints<S>{flat(inOther(nearestTo(corner, one_))), flat(other_.corners[k])};
  };
  NearestPair<S> nearest(fromOne(0), sizeOf(one_) + sizeOf(other_));
  for (std::size_t k = 1; k < one_.corners.size(); ++k)  // of a box those at one end
    if (ofOne < 0 || (k >> detail::at(ofOne) & 1U) == 0) nearest.offer(fromOne(k));
  for (std::size_t k = 0; k < other_.corners.size(); ++k)
    if ((k >> detail::at(ofOther) & 1U) == 0) nearest.offer(toOne(k));
  NearestPoints<S> inPlane = nearest.pair(), common = alongAxis(next);
  common.take(alongAxis(last), last);
  inPlane.mix(common, {next, last}, pair_.overlapAcross(ofOne, ofOther));
  for (const int axis : {next, last}) points.take(inPlane, axis);
  return points;
}

/// Of what both reach along an axis, as that component.
template <class S>
NearestPoints<S> SolidNearest<S>::alongAxis(int axis) const {
  const Vector3<S> direction = unitMatrix<S>().col(axis);
  auto own = one_.extent(pair_.inOne(direction));
  own.middle = pair_.origin_[axis] + own.middle;
  const NearestNumbers<S> numbers(own, other_.extent(direction));
  NearestPoints<S> points(zeroVector<S>(), zeroVector<S>());
  points.one[axis] = numbers.one;
  points.other[axis] = numbers.other;
  points.apart[axis] = numbers.apart;
  return points;
}

}  // namespace gamut
