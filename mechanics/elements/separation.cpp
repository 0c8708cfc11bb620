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
// |x|² is replaced by no less than `leastSize`, which leaves out
//
//   e²/|x|² (1 - |x|²/leastSize) ≤ q e (1 - |x|²/leastSize),   q = min(h, k),   since e ≤ q |x|²,
//
// where |x|² is less: at most q² leastSize/4, of segments that cross within their ends at an angle below 0.9°.
#include "mechanics/elements/separation.hpp"

#include <cmath>

#include "mechanics/assembler.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/seen.hpp"
#include "mechanics/elements/shape_frame.hpp"

namespace gamut {
namespace {

constexpr double leastSize = 0x1p-12;

template <class S>
S squares(const Vector3<S>& x) {
  return square(x[0]) + square(x[1]) + square(x[2]);
}

template <class S>
S positive(const S& x) {
  using std::max;
  return S(max(x, S(0.0)));
}

template <class S>
struct Segment {
  Vector3<S> middle, along;
  S half;

  /// From a point, squared.
  S squareTo(const Vector3<S>& point) const {
    using std::abs;
    const Vector3<S> y = point - middle;
    return squares<S>(y.cross(along)) + square(positive(S(S(abs(S(along.dot(y)))) - half)));
  }
  /// From the nearer end of another one, squared.
  S squareToEnds(const Segment& other) const {
    using std::min;
    const Vector3<S> reach = other.along * other.half;
    return S(min(squareTo(other.middle + reach), squareTo(other.middle - reach)));
  }
};

/// By what the square of the distance of two segments is less than that of their ends: e²/|x|².
template <class S>
S squareInside(const Segment<S>& one, const Segment<S>& other) {
  using std::abs, std::max, std::min;
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
  const S missing = positive(S(S(1.0) - S(1 / leastSize) * size)), half = min(one.half, other.half);
  const S within = min(S(e / S(max(size, S(leastSize)))), half);
  return e * (within + constant<S>(Interval(0.0, 1.0)) * (half * missing));
}

template <class S>
S squareBetween(const Segment<S>& one, const Segment<S>& other) {
  using std::min;
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
  using std::abs, std::max, std::min, std::sqrt;
  const Vector3<S> y = box.frame.turning.axes.transpose() * Vector3<S>(point - box.middle());
  Vector3<S> m, outside;
  for (int i = 0; i < 3; ++i) {
    m[i] = S(abs(y[i])) - box.outline.halves[i];
    outside[i] = positive(m[i]);
  }
  return S(sqrt(squares(outside))) + S(min(S(max(S(max(m[0], m[1])), m[2])), S(0.0)));
}

/// Of a segment x + s a, |s| ≤ h, from a box, in its axes: √ of the least F(s) = Σ max(|x_i + s a_i| - h_i, 0)².
///
/// F is convex, and quadratic in pieces: with A the axes i for which a term is above zero, on the side σ_i, its slope
/// is 2 Σ_A a_i (x_i + s a_i - σ_i h_i). Where F is least over an interval, F rises from its end on, with some A that
/// has D = Σ_A a_i² > 0, or the end is that of the segment. So the least F is that of an end or of one of
///
///   s = -Σ_A a_i (x_i - σ_i h_i)/D     for all A and σ, clamped to |s| ≤ h, where F is no less than its least.
///
/// Here D is replaced by `tiny` where it is less. Were a_i = 0 for the axes with a_i² < tiny, A would do without them,
/// and √F would be another by no more than δ, δ² = h² Σ a_i² over these: so the least is too great by 2δ at most.
template <class S>
S fromBox(const Segment<S>& segment, const Placed<S>& box) {
  using std::abs, std::max, std::min, std::sqrt;
  constexpr double tiny = 0x1p-60, root = 0x1p-30;
  const Matrix3<S> inBox = box.frame.turning.axes.transpose();
  const Vector3<S> x = inBox * Vector3<S>(segment.middle - box.middle()), a = inBox * segment.along;
  const Vector3<S>& halves = box.outline.halves;
  const auto squareAt = [&](const S& s) {
    S sum(0.0);
    for (int i = 0; i < 3; ++i) sum = sum + square(positive(S(S(abs(S(x[i] + s * a[i]))) - halves[i])));
    return sum;
  };
  S lowest = min(squareAt(segment.half), squareAt(S(-segment.half)));
  unsigned moving = 0;  // axes
  for (unsigned i = 0; i < 3; ++i) moving |= isKnownZero(a[i]) ? 0U : 1U << i;
  for (unsigned axes = 1; axes < 8; ++axes) {
    if ((axes & ~moving) != 0) continue;
    S size(0.0);
    for (unsigned i = 0; i < 3; ++i)
      if ((axes >> i & 1U) != 0) size = size + square(a[i]);
    for (unsigned sides = 0; sides < 8; ++sides) {
      if ((sides & ~axes) != 0) continue;
      S slope(0.0);
      for (unsigned i = 0; i < 3; ++i)
        if ((axes >> i & 1U) != 0)
          slope = slope + a[i] * ((sides >> i & 1U) != 0 ? x[i] + halves[i] : x[i] - halves[i]);
      const S s = axes == moving ? S(-slope) : S(-slope / S(max(size, S(tiny))));  // of all axes |a|² = 1
      lowest = min(lowest, squareAt(S(max(S(min(s, segment.half)), S(-segment.half)))));
    }
  }
  S slack(0.0);
  for (unsigned i = 0; i < 3; ++i)
    if ((moving >> i & 1U) != 0) {
      const S turned = abs(a[i]);
      slack = slack + S(min(turned, positive(S(S(2 * root) - turned))));
    }
  return S(sqrt(lowest)) - constant<S>(Interval(0.0, 2.0)) * (segment.half * slack);
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
S fromBox(const Placed<S>& round, const Placed<S>& box) {
  const bool isSegment = round.is(ShapeCore::segment);
  return (isSegment ? fromBox(round.segment(), box) : fromBox(round.middle(), box)) - round.outline.radius;
}

template <class S>
ShapeCore coreOf(const Frame<S>& frame) {
  const auto* shape = dynamic_cast<const ShapeFrame<S>*>(frame.origin);
  return shape == nullptr ? ShapeCore::point : shape->outline().core;
}

template <class S>
S distanceOf(const Frame<S>& from, const Frame<S>& to) {
  using std::sqrt;
  const Frame<S>* base = commonBase<S>(&from, &to);
  const Placed<S> one(from, base), other(to, base);
  if (other.is(ShapeCore::cuboid)) return fromBox(one, other);
  if (one.is(ShapeCore::cuboid)) return fromBox(other, one);
  return S(sqrt(squareBetween(one, other))) - (one.outline.radius + other.outline.radius);
}

}  // namespace

void Separation::describe(Fields& f) {
  f.frame({"from", "", "a shape, or a frame"}, from);
  f.otherFrame({"to", "", "the other one"}, to, from);
  f.measure(
      {"distance", "m",
       "between the nearest points of their surfaces. Below 0 where they overlap: by both radii, less what centres or "
       "segments are apart; of a box and a sphere by how far that would have to be drawn out; of a box and a "
       "capsule by its radius at most"});
}

template <class S>
void Separation::assemble(Assembler<S>& a) const {
  const Frame<S>&one = a.frame(from), &other = a.frame(to);
  if (coreOf(one) == ShapeCore::cuboid && coreOf(other) == ShapeCore::cuboid)
    throw UnfitPart(name, "'" + name + "' is between two boxes", "a box and a sphere, a capsule or a frame");
  a.measure("distance", [&one, &other] { return distanceOf(one, other); });
}

GAMUT_ASSEMBLE(Separation)

}  // namespace gamut
