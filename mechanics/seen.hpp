// A frame as one sees it that it hangs on: with nothing of what lies further inwards.
#pragma once

#include "mechanics/element.hpp"

namespace gamut {

/// A point fixed to a frame, and the frame's axes, as another frame sees them that it hangs on.
template <class S>
struct SeenFrame {
  MovingPoint<S> point;
  TurningAxes<S> turning;
};

template <class S>
SeenFrame<S> seenFrom(const Frame<S>* base, const Frame<S>* frame, const Vector3<S>& point) {
  SeenFrame<S> seen{{point, zeroVector<S>()}, {}};
  for (; frame != base; frame = &frame->origin->from()) {
    seen.point = frame->origin->inFrom(seen.point);
    seen.turning = frame->origin->axesInFrom(seen.turning);
  }
  return seen;
}

/// The outermost frame that both hang on.
template <class S>
const Frame<S>* commonBase(const Frame<S>* a, const Frame<S>* b) {
  const auto inner = [](const Frame<S>* frame) { return frame->origin ? &frame->origin->from() : nullptr; };
  for (; a; a = inner(a))
    for (const Frame<S>* other = b; other; other = inner(other))
      if (a == other) return a;
  return nullptr;  // not of one mechanism
}

}  // namespace gamut
