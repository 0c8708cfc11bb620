// Of two segments, w + s a - t b is what their points are from each other, with unit vectors a and b, |s| ≤ h, |t| ≤ k
// and w the difference of their middles. Let x = a × b. On the whole lines s₀ = x·(b × w)/|x|² and t₀ = x·(a × w)/|x|²
// are nearest, and with s = s₀ + δ given, nearest is t = t₀ + a·b δ, where |w + s a - t b|² is greater by |x|² δ². So
//
//   E = min over the four ends y, seen from the middle of the other segment, of |y × b|² + max(|b·y| - k, 0)²
//   e = max(0, min(h |x|² - |x·(b × w)|, k |x|² - |x·(a × w)|))
//   d² = E - e²/|x|²
//
// If s₀ and t₀ are inside, the least is there, and at an end it is greater by |x|² (h - |s₀|)², or more, or by
// |x|² (k - |t₀|)²; of the smaller of both by no more, since |t₀ + a·b δ| ≤ |t₀| + |δ| then is inside too. Else the
// least is at an end, and e is zero. In a plane x has one component alone, by which e can be divided as it stands. Else
// |x|² is replaced by no less than `least`, which leaves out
//
//   e²/|x|² (1 - |x|²/least) ≤ q e (1 - |x|²/least),   q = min(h, k),   since e ≤ q |x|²,
//
// where |x|² is less: at most q² least/4, of segments that cross within their ends at an angle below 0.45°.
#include "mechanics/elements/separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/assembler.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/elements/seen.hpp"
#include "mechanics/elements/shape_frame.hpp"

namespace gamut {
namespace {

using std::abs, std::max, std::min, std::sqrt;

constexpr double least = 0x1p-14;

template <class S>
S squares(const Vector3<S>& x) {
  return square(x[0]) + square(x[1]) + square(x[2]);
}

template <class S>
S positive(const S& x) {
  return S(max(x, S(0.0)));
}

template <class S>
struct Segment {
  Vector3<S> middle, along;
  S half;

  /// From a point, squared.
  S squareTo(const Vector3<S>& point) const {
    const Vector3<S> y = point - middle;
    return squares<S>(y.cross(along)) + square(positive(S(S(abs(S(along.dot(y)))) - half)));
  }
  /// From the nearer end of another one, squared.
  S squareToEnds(const Segment& other) const {
    const Vector3<S> reach = other.along * other.half;
    return S(min(squareTo(other.middle + reach), squareTo(other.middle - reach)));
  }
};

/// By what the square of the distance of two segments is less than that of their ends: e²/|x|².
template <class S>
S squareInside(const Segment<S>& one, const Segment<S>& other) {
  const Vector3<S> w = one.middle - other.middle, x = one.along.cross(other.along);
  const Vector3<S> y = other.along.cross(w), z = one.along.cross(w);
  int across = -1, components = 0;
  for (int i = 0; i < 3; ++i)
    if (!isKnownZero(x[i])) across = i, ++components;
  if (components == 0) return S(0.0);  // parallel
  const auto inside = [&](const S& size, const S& first, const S& second) {
    return positive(S(min(S(one.half * size - S(abs(first))), S(other.half * size - S(abs(second))))));
  };
  if (components == 1) return square(inside(S(abs(x[across])), y[across], z[across]));
  const S size = squares(x), e = inside(size, S(x.dot(y)), S(x.dot(z)));
  const S missing = positive(S(S(1.0) - S(1 / least) * size)), half = min(one.half, other.half);
  const S within = min(S(e / S(max(size, S(least)))), half);
  return e * (within + constant<S>(Interval(0.0, 1.0)) * (half * missing));
}

template <class S>
S squareBetween(const Segment<S>& one, const Segment<S>& other) {
  const S ends = min(one.squareToEnds(other), other.squareToEnds(one));
  return positive(S(ends - squareInside(one, other)));
}

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
ShapeCore coreOf(const Frame<S>& frame) {
  const auto* shape = dynamic_cast<const ShapeFrame<S>*>(frame.origin);
  return shape == nullptr ? ShapeCore::point : shape->outline().core;
}

template <class S>
S distanceOf(const Frame<S>& from, const Frame<S>& to) {
  const Frame<S>* base = commonBase<S>(&from, &to);
  const Placed<S> one(from, base), other(to, base);
  if (one.is(ShapeCore::cuboid)) return fromBox(other.middle(), one) - other.outline.radius;
  if (other.is(ShapeCore::cuboid)) return fromBox(one.middle(), other) - one.outline.radius;
  return S(sqrt(squareBetween(one, other))) - (one.outline.radius + other.outline.radius);
}

}  // namespace

void Separation::describe(Fields& f) {
  f.frame({"from", "", "a shape, or a frame"}, from);
  f.otherFrame({"to", "", "the other one"}, to, from);
  f.measure({"distance", "m",
             "between the nearest points of their surfaces; below 0 where they overlap: spheres and capsules by what "
             "both radii are more than the distance of centres or segments, so by no more than both radii"});
}

template <class S>
void Separation::assemble(Assembler<S>& a) const {
  const Frame<S>&one = a.frame(from), &other = a.frame(to);
  const std::array cores = {coreOf(one), coreOf(other)};
  if (std::ranges::count(cores, ShapeCore::cuboid) > std::ranges::count(cores, ShapeCore::point))
    throw UnfitPart(name, "'" + name + "' is between a box and what is no sphere", "a box and a sphere, or a frame");
  a.measure("distance", [&one, &other] { return distanceOf(one, other); });
}

GAMUT_ASSEMBLE(Separation)

}  // namespace gamut
