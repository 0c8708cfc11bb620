#include "mechanics/elements/separation.hpp"

#include <cmath>

#include "mechanics/assembler.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/elements/nearest_points.hpp"
#include "mechanics/elements/shape_frame.hpp"
#include "mechanics/elements/solid_distance.hpp"
#include "mechanics/seen.hpp"

namespace gamut {
namespace {

/// A frame and the shape that it is, as the frame sees it that both shapes hang on.
template <class S>
struct Placed {
  Outline<S> outline;
  SeenFrame<S> frame;

  Placed(const Frame<S>& own, const Frame<S>* base) : frame(seenFrom<S>(base, &own, zeroVector<S>())) {
    if (const auto* shape = dynamic_cast<const ShapeFrame<S>*>(own.origin)) outline = shape->outline();
  }
  bool is(ShapeCore core) const { return outline.core == core; }
  const Vector3<S>& middle() const { return frame.point.position; }
  Segment<S> segment() const { return {middle(), frame.turning.axes * outline.axis, outline.halves[0]}; }
};

/// Of a point from a box: outside √Σ max(m_i, 0)², inside max m_i, with m_i = |y_i| - h_i of the point y in its axes.
template <class S>
S fromBox(const Vector3<S>& point, const Placed<S>& box) {
  using std::abs, std::max, std::min, std::sqrt;
  const Vector3<S> y = box.frame.turning.axes.transpose() * Vector3<S>(point - box.middle());
  Vector3<S> m, outside;
  for (int i = 0; i < 3; ++i) {
    m[i] = S(abs(y[i])) - box.outline.halves[i];
    outside[i] = positive(m[i]);
  }
  return S(sqrt(squares(outside))) + S(min(S(max(S(max(m[0], m[1])), m[2])), S(0.0)));
}

template <class S>
S squareBetween(const Placed<S>& one, const Placed<S>& other) {
  using enum ShapeCore;
  if (one.is(segment) && other.is(segment)) return squareBetween(one.segment(), other.segment());
  if (one.is(segment)) return one.segment().squareTo(other.middle());
  if (other.is(segment)) return other.segment().squareTo(one.middle());
  return squares<S>(one.middle() - other.middle());
}

template <class S>
Solid<S> solidOf(const Outline<S>& outline) {
  if (outline.core == ShapeCore::polyhedron) return Solid<S>(*outline.polyhedron);
  return outline.core == ShapeCore::segment ? Solid<S>::segment(outline.axis, outline.halves[0])
                                            : Solid<S>::cuboid(outline.halves);
}

/// From a solid: of a point, of a segment, of another solid, but for the radii.
template <class S>
S fromSolid(const Placed<S>& one, const Placed<S>& solid) {
  using std::min, std::sqrt;
  if (one.is(ShapeCore::point) && solid.is(ShapeCore::cuboid)) return fromBox(one.middle(), solid);
  const Matrix3<S> inSolid = solid.frame.turning.axes.transpose();
  const Vector3<S> apart = inSolid * Vector3<S>(one.middle() - solid.middle());
  const Solid<S> own = solidOf(solid.outline);
  if (one.is(ShapeCore::point))  // inside, the nearest of the surface is in the face that it is least behind
    return S(sqrt(own.squareTo(apart))) + S(2.0) * S(min(own.beyond(apart), S(0.0)));
  const SolidPair<S> pair(solidOf(one.outline), own, inSolid * one.frame.turning.axes, apart);
  return S(sqrt(pair.squareBetween()));
}

template <class S>
bool isSolid(const Placed<S>& placed) {
  return placed.is(ShapeCore::cuboid) || placed.is(ShapeCore::polyhedron);
}

template <class S>
S distanceOf(const Frame<S>& from, const Frame<S>& to) {
  using enum ShapeCore;
  using std::sqrt;
  const Frame<S>* base = commonBase<S>(&from, &to);
  const Placed<S> one(from, base), other(to, base);
  const S radii = one.outline.radius + other.outline.radius;
  if (isSolid(other)) return fromSolid(one, other) - radii;
  if (isSolid(one)) return fromSolid(other, one) - radii;
  return S(sqrt(squareBetween(one, other))) - radii;
}

// ---- Nearest points -------------------------------------------------------------------------------------------------

template <class S>
NearestPoints<S> nearestToSolid(const Placed<S>& one, const Placed<S>& solid) {
  const Matrix3<S>& axes = solid.frame.turning.axes;
  const Vector3<S> apart = axes.transpose() * Vector3<S>(one.middle() - solid.middle());
  const Solid<S> own = solidOf(solid.outline);
  if (one.is(ShapeCore::point)) return {one.middle(), solid.middle() + axes * nearestTo(apart, own)};
  const SolidPair<S> pair(solidOf(one.outline), own, axes.transpose() * one.frame.turning.axes, apart);
  const NearestPoints<S> points = SolidNearest<S>(pair).points();
  return {solid.middle() + axes * points.one, solid.middle() + axes * points.other, axes * points.apart};
}

/// But for the radii.
template <class S>
NearestPoints<S> nearestOf(const Placed<S>& one, const Placed<S>& other) {
  using enum ShapeCore;
  if (isSolid(other)) return nearestToSolid(one, other);
  if (isSolid(one)) {
    const NearestPoints<S> points = nearestToSolid(other, one);
    return {points.other, points.one, -points.apart};
  }
  if (one.is(segment) && other.is(segment)) return nearestOf(one.segment(), other.segment());
  return {one.is(segment) ? nearestTo(other.middle(), one.segment()) : one.middle(),
          other.is(segment) ? nearestTo(one.middle(), other.segment()) : other.middle()};
}

/// Two shapes at their nearest points, in the frame that both hang on.
template <class S>
struct Closest {
  const Frame<S>* base;
  Placed<S> one, other;
  NearestPoints<S> cores;
  Vector3<S> direction;  ///< from one to the other

  Closest(const Frame<S>& from, const Frame<S>& to)
      : base(commonBase<S>(&from, &to)),
        one(from, base),
        other(to, base),
        cores(nearestOf(one, other)),
        direction(directionAlong(cores.apart)) {}

  Vector3<S> inInertial(const Vector3<S>& point) const { return base->inInertial({point, zeroVector<S>()}).position; }
  Vector3<S> ofOne() const { return inInertial(cores.one + direction * one.outline.radius); }
  Vector3<S> ofOther() const { return inInertial(cores.other - direction * other.outline.radius); }
  static Vector3<S> velocityOf(const Placed<S>& placed, const Vector3<S>& point) {
    return placed.frame.point.velocity + placed.frame.turning.omega.cross(point - placed.middle());
  }
  /// As directions and points change, the distance does not, to first order.
  S rate() const { return direction.dot(velocityOf(other, cores.other) - velocityOf(one, cores.one)); }
};

template <class S>
bool isFlat(const Frame<S>& frame) {
  const auto* shape = dynamic_cast<const ShapeFrame<S>*>(frame.origin);
  if (shape == nullptr || shape->outline().core != ShapeCore::polyhedron) return false;
  return shape->outline().polyhedron == nullptr || shape->outline().polyhedron->faces().empty();
}

}  // namespace

void Separation::describe(Fields& f) {
  f.frame({"from", "", "a shape, or a frame"}, from);
  f.otherFrame({"to", "", "the other one"}, to, from);
  f.measure(
      {"distance", "m",
       "between the nearest points of their surfaces. Below 0 where they overlap: by both radii, less what centres or "
       "segments are apart; of a box and a sphere by how far that would have to be drawn out; of a box and a "
       "capsule by its radius at most; of a hull likewise; of two boxes or hulls 0, less the radii"});
  f.measure({"rate", "m/s", "at which the distance grows"});
  for (const char* component : components)
    f.measure({std::string("from.") + component, "m", "of the nearest point of `from`, in the inertial frame"});
  for (const char* component : components)
    f.measure({std::string("to.") + component, "m", "of the nearest point of `to`, likewise"});
}

template <class S>
void Separation::assemble(Assembler<S>& a) const {
  const Frame<S>&one = a.frame(from), &other = a.frame(to);
  for (const auto& [shape, word] : {std::pair(&one, &from), std::pair(&other, &to)})
    if (isFlat(*shape))
      throw UnfitPart(name, "'" + name + "' is from '" + *word + "', whose points lie in one plane", "a solid");
  a.measure("distance", [&one, &other] { return distanceOf(one, other); });
  a.measure("rate", [&one, &other] { return Closest<S>(one, other).rate(); });
  for (int i = 0; i < 3; ++i) {
    const std::string component = components[detail::at(i)];
    a.measure("from." + component, [&one, &other, i] { return S(Closest<S>(one, other).ofOne()[i]); });
    a.measure("to." + component, [&one, &other, i] { return S(Closest<S>(one, other).ofOther()[i]); });
  }
}

GAMUT_ASSEMBLE(Separation)

}  // namespace gamut
