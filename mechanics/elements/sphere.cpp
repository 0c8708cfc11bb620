#include "mechanics/elements/sphere.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/elements/shape_frame.hpp"

namespace gamut {

void Sphere::describe(Fields& f) {
  describeShape(f, name, at);
  f.number({"radius", "m", "0, a point, unless given"}, radius);
  f.vector({"centre", "m", "in `at`; its origin unless given"}, centre);
  f.drawsShape({radius});
}

template <class S>
void Sphere::assemble(Assembler<S>& a) const {
  Outline<S> outline;
  outline.radius = a.number(radius);
  a.template add<ShapeFrame<S>>(a.frame(at), a.frame(name), Place<S>{{}, a.vector(centre)}, outline);
}

std::vector<Fault> Sphere::faults(const RangeOf& rangeOf) const {
  return faultsOfLength(rangeOf, radius, "radius", name);
}

GAMUT_ASSEMBLE(Sphere)

}  // namespace gamut
