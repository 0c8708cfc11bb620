// The frame that a shape is: its origin is the middle of the shape, its axes are those that the shape is stated in.
#pragma once

#include <memory>
#include <utility>

#include "mechanics/joint.hpp"
#include "mechanics/polyhedron.hpp"

namespace gamut {

/// What a shape is all points within its radius of, about the origin of its frame.
enum class ShapeCore {
  point,    ///< the origin
  segment,  ///< s `axis`, |s| ≤ halves[0]
  cuboid,   ///< x with |x_i| ≤ halves[i]
  polyhedron,
};

template <class S>
struct Outline {
  ShapeCore core = ShapeCore::point;
  S radius = S(0.0);                  ///< m
  Vector3<S> axis = zeroVector<S>(),  ///< of a segment: a unit vector
      halves = zeroVector<S>();       ///< m
  std::shared_ptr<const Polyhedron> polyhedron = nullptr;
};

/// Fixes the frame `to` of a shape to the frame that carries it.
template <class S>
class ShapeFrame final : public Joint<S> {
 public:
  ShapeFrame(Frame<S>& from, Frame<S>& to, Place<S> place, Outline<S> outline)
      : Joint<S>(from, to), place_(std::move(place)), outline_(std::move(outline)) {}

  const Outline<S>& outline() const { return outline_; }

 private:
  Place<S> place() const override { return place_; }

  Place<S> place_;
  Outline<S> outline_;
};

}  // namespace gamut
