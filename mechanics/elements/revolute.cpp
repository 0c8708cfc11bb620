#include "mechanics/elements/revolute.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/joints.hpp"

namespace gamut {

void Revolute::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the joint"}, from);
  f.movedFrame({"to", "", "the frame that turns"}, to, from);
  f.jointAxis({"axis", "", "about which it turns", true}, axis, from);
  f.coordinate({"angle", "rad", "at the start"}, angle, Coordinate::angle, {"rate", "rad/s", "at the start"}, rate);
  f.movesAs({.steps = {{.turns = true, .axis = axis}}});
}

template <class S>
void Revolute::assemble(Assembler<S>& a) const {
  a.template add<RevoluteJoint<S>>(a.frame(from), a.frame(to), a.variable("angle"), axis);
}

GAMUT_ASSEMBLE(Revolute)

}  // namespace gamut
