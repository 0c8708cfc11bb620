// A prismatic and a revolute joint with one axis, and a hidden frame between them.
#include "mechanics/elements/cylindrical.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/joints.hpp"

namespace gamut {

void Cylindrical::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the joint"}, from);
  f.movedFrame({"to", "", "the frame that slides and turns"}, to, from);
  f.jointAxis({"axis", "", "of both", true}, axis, from);
  f.coordinate({"displacement", "m", "at the start"}, displacement, Coordinate::displacement,
               {"displacement_rate", "m/s", "at the start"}, displacementRate);
  f.coordinate({"angle", "rad", "at the start"}, angle, Coordinate::angle, {"angle_rate", "rad/s", "at the start"},
               angleRate);
  f.movesAs({.steps = {{.slides = true, .axis = axis}, {.turns = true, .axis = axis}}});
}

template <class S>
void Cylindrical::assemble(Assembler<S>& a) const {
  Frame<S>& slid = a.hiddenFrame();
  a.template add<PrismaticJoint<S>>(a.frame(from), slid, a.variable("displacement"), axis);
  a.template add<RevoluteJoint<S>>(slid, a.frame(to), a.variable("angle"), axis);
}

GAMUT_ASSEMBLE(Cylindrical)

}  // namespace gamut
