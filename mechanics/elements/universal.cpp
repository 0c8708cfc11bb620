// Two revolute joints about a hidden frame, the cross.
#include "mechanics/elements/universal.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/joints.hpp"

namespace gamut {

void Universal::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the joint"}, from);
  f.movedFrame({"to", "", "the frame that turns"}, to, from);
  f.jointAxis({"axis", "", "of the first angle; `\"x\"` unless given"}, axis, from);
  f.jointAxis({"second_axis", "", "of the second angle; `\"y\"` unless given"}, secondAxis, to);
  f.coordinate({"angle1", "rad", "at the start"}, angle1, Coordinate::angle, {"rate1", "rad/s", "at the start"}, rate1);
  f.coordinate({"angle2", "rad", "at the start"}, angle2, Coordinate::angle, {"rate2", "rad/s", "at the start"}, rate2);
  f.movesAs({.steps = {{.turns = true, .axis = axis}, {.turns = true, .axis = secondAxis}}});
}

std::vector<Fault> Universal::faults(const RangeOf& /*rangeOf*/) const {
  if (!axis.isParallelTo(secondAxis)) return {};
  return {{"second_axis", "the axes of '" + name + "' are parallel", "two axes that differ in direction"}};
}

template <class S>
void Universal::assemble(Assembler<S>& a) const {
  Frame<S>& cross = a.hiddenFrame();
  a.template add<RevoluteJoint<S>>(a.frame(from), cross, a.variable("angle1"), axis);
  a.template add<RevoluteJoint<S>>(cross, a.frame(to), a.variable("angle2"), secondAxis);
}

GAMUT_ASSEMBLE(Universal)

}  // namespace gamut
