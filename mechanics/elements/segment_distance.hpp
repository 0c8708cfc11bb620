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
#pragma once

#include <array>
#include <cmath>

#include "mechanics/algebra.hpp"

namespace gamut {

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

/// x = a × b of two directions, seen from two frames, which may be one. Numbers of segments along a and b are times
/// |x|² here, or, where x has one component in either, times |x|.
template <class S>
class Crossing {
 public:
  Crossing(const Vector3<S>& x, const Vector3<S>& seenElsewhere) : views_{View(x), View(seenElsewhere)} {
    using std::abs;
    isParallel_ = views_[0].known == 0 || views_[1].known == 0;
    isPlanar_ = views_[0].known == 1 && views_[1].known == 1;
    size_ = isPlanar_ ? S(abs(x[views_[0].last])) : squares(x);
  }

  /// As far as the formulas tell.
  bool isParallel() const { return isParallel_; }
  /// s₀ of b × w, or t₀ of a × w, seen from the first frame or the second.
  S nearest(std::size_t frame, const Vector3<S>& product) const {
    const View& view = views_[frame];
    return isPlanar_ ? product[view.last] : S(view.x.dot(product));
  }

  /// e²/|x|²: by what the square of the distance is less than that of the ends. `first` is s₀, `second` t₀.
  S squareInside(const S& half, const S& first, const S& otherHalf, const S& second) const {
    using std::abs, std::max, std::min;
    constexpr double leastSize = 0x1p-12;
    const S e = positive(S(min(S(half * size_ - S(abs(first))), S(otherHalf * size_ - S(abs(second))))));
    if (isPlanar_) return square(e);
    const S missing = positive(S(S(1.0) - S(1 / leastSize) * size_)), least = min(half, otherHalf);
    const S within = min(S(e / S(max(size_, S(leastSize)))), least);
    return e * (within + constant<S>(Interval(0.0, 1.0)) * (least * missing));
  }

 private:
  struct View {
    explicit View(const Vector3<S>& seen) : x(seen) {
      for (int i = 0; i < 3; ++i)
        if (!isKnownZero(x[i])) last = i, ++known;
    }

    Vector3<S> x;
    int last = 0, known = 0;  // components that may not be zero
  };

  std::array<View, 2> views_;
  S size_ = S(0.0);
  bool isParallel_ = false, isPlanar_ = false;
};

template <class S>
S squareBetween(const Segment<S>& one, const Segment<S>& other) {
  using std::min;
  const S ends = min(one.squareToEnds(other), other.squareToEnds(one));
  const Vector3<S> x = one.along.cross(other.along), w = one.middle - other.middle;
  const Crossing<S> crossing(x, x);
  if (crossing.isParallel()) return ends;
  const S first = crossing.nearest(0, other.along.cross(w)), second = crossing.nearest(1, one.along.cross(w));
  return positive(S(ends - crossing.squareInside(one.half, first, other.half, second)));
}

}  // namespace gamut
