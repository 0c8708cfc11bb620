// The frame that a shape is: its origin is the middle of the shape, its axes are those that the shape is stated in.
#pragma once

#include <memory>
#include <utility>

#include "mechanics/description/described.hpp"
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

/// The words that all shapes begin with.
inline void describeShape(Fields& f, std::string& name, std::string& at) {
  f.frame({"at", "", "the frame that carries it"}, at);
  f.movedFrame({"name", "", "the shape's own frame"}, name, at);
}

/// Of a length of the shape `name` that may be below zero.
inline std::vector<Fault> faultsOfLength(const RangeOf& rangeOf, const Expression& length, const std::string& key,
                                         const std::string& name) {
  if (rangeOf(length).lower() >= 0) return {};
  return {{key, "the " + key + " of '" + name + "' is negative", "a " + key + " of at least 0 m"}};
}

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
