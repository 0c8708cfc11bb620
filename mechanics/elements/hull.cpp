#include "mechanics/elements/hull.hpp"

#include <cmath>
#include <memory>

#include "mechanics/assembler.hpp"
#include "mechanics/elements/shape_frame.hpp"

namespace gamut {

void Hull::describe(Fields& f) {
  describeShape(f, name, at);
  f.points({"points", "m",
            "4 to 40, from `centre`, numbers each: `[[0, 0, 0], [\"10 cm\", 0, 0], …]`; those inside "
            "the hull of the others count for nothing",
            true},
           points);
  f.number({"radius", "m", "what lies within it of the hull belongs to the shape; 0 unless given"}, radius);
  f.vector({"centre", "m", "where the points are counted from, in `at`; its origin unless given"}, centre);
  f.drawsShape({radius, 0.0, axisZ, std::nullopt, points});
}

template <class S>
void Hull::assemble(Assembler<S>& a) const {
  Outline<S> outline{ShapeCore::polyhedron, a.number(radius)};
  if (const auto exact = exactPoints(points)) outline.polyhedron = std::make_shared<Polyhedron>(*exact);
  a.template add<ShapeFrame<S>>(a.frame(at), a.frame(name), Place<S>{{}, a.vector(centre)}, std::move(outline));
}

std::vector<Fault> Hull::faults(const RangeOf& rangeOf) const {
  if (std::vector<Fault> found = faultsOfLength(rangeOf, radius, "radius", name); !found.empty()) return found;
  const auto exact = exactPoints(points);
  if (!exact) return {{"points", "a point of '" + name + "' is no number", "lengths, such as 0.1 or \"10 cm\"", true}};
  if (exact->size() > Polyhedron::mostPoints)
    return {{"points", "'" + name + "' has " + std::to_string(exact->size()) + " points", "40 at most", true}};
  const Polyhedron hull(*exact);
  if (hull.faces().empty())
    return {{"points", "the points of '" + name + "' lie in one plane", "4 at least that do not", true}};
  if (!std::isfinite(hull.spread()))
    return {{"points", "a face of '" + name + "' has an angle too small for numbers", "a wider one", true}};
  return {};
}

GAMUT_ASSEMBLE(Hull)

}  // namespace gamut
