#include "mechanics/elements/capsule.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/elements/shape_frame.hpp"

namespace gamut {

void Capsule::describe(Fields& f) {
  describeShape(f, name, at);
  f.number({"radius", "m", "0, a segment, unless given"}, radius);
  f.number({"length", "m", "of the segment, from the centre of one end to that of the other", true}, length);
  f.axis({"axis", "", "of the segment, in `at`; `\"z\"` unless given"}, axis);
  f.vector({"centre", "m", "the middle of the segment, in `at`; its origin unless given"}, centre);
  f.drawsShape({radius, length, axis});
}

template <class S>
void Capsule::assemble(Assembler<S>& a) const {
  Outline<S> outline{ShapeCore::segment, a.number(radius), axis.unit<S>()};
  outline.halves[0] = S(0.5) * a.number(length);
  if (isKnownZero(outline.halves[0])) outline.core = ShapeCore::point;
  a.template add<ShapeFrame<S>>(a.frame(at), a.frame(name), Place<S>{{}, a.vector(centre)}, outline);
}

std::vector<Fault> Capsule::faults(const RangeOf& rangeOf) const {
  std::vector<Fault> found = faultsOfLength(rangeOf, radius, "radius", name);
  for (Fault& fault : faultsOfLength(rangeOf, length, "length", name)) found.push_back(std::move(fault));
  return found;
}

GAMUT_ASSEMBLE(Capsule)

}  // namespace gamut
