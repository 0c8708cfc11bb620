#include "mechanics/elements/prismatic.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/joints.hpp"

namespace gamut {

void Prismatic::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the joint"}, from);
  f.movedFrame({"to", "", "the frame that slides"}, to, from);
  f.jointAxis({"axis", "", "along which it slides", true}, axis, from);
  f.coordinate({"displacement", "m", "at the start"}, displacement, Coordinate::displacement,
               {"rate", "m/s", "at the start"}, rate);
  f.movesAs({.steps = {{.slides = true, .axis = axis}}});
}

template <class S>
void Prismatic::assemble(Assembler<S>& a) const {
  a.template add<PrismaticJoint<S>>(a.frame(from), a.frame(to), a.variable("displacement"), axis);
}

GAMUT_ASSEMBLE(Prismatic)

}  // namespace gamut
