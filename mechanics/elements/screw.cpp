#include "mechanics/elements/screw.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/joints.hpp"

namespace gamut {

void Screw::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the joint"}, from);
  f.movedFrame({"to", "", "the frame that turns and slides"}, to, from);
  f.axis({"axis", "", "of both", true}, axis);
  f.number({"lead", "m", "how far it slides in one turn; below 0 for a left-handed thread", true}, lead);
  f.coordinate({"angle", "rad", "at the start"}, angle, Coordinate::angle, {"rate", "rad/s", "at the start"}, rate);
}

template <class S>
void Screw::assemble(Assembler<S>& a) const {
  const S turn = constant<S>(Interval(2.0) * pi());
  a.template add<ScrewJoint<S>>(a.frame(from), a.frame(to), a.variable("angle"), a.number(lead) / turn, axis);
}

GAMUT_ASSEMBLE(Screw)

}  // namespace gamut
