// Two prismatic joints and a revolute one, with hidden frames between them.
#include "mechanics/elements/planar.hpp"

#include <array>

#include "mechanics/assembler.hpp"
#include "mechanics/joints.hpp"

namespace gamut {
namespace {

/// The coordinate axis that stands so many places behind an aligned one.
const Axis& following(const Axis& axis, int by) {
  static const std::array<Axis, 3> axes = {axisX, axisY, axisZ};
  return axes[(axis.index() + by + 3) % 3];
}

}  // namespace

void Planar::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the joint"}, from);
  f.movedFrame({"to", "", "the frame that slides and turns"}, to, from);
  f.jointAxis({"axis", "", "the normal: `\"x\"`, `\"y\"` or `\"z\"`, which it is unless given"}, axis, from);
  f.coordinate({"displacement1", "m", "at the start, along the axis that follows the normal: x for z"}, displacement1,
               Coordinate::displacement, {"displacement1_rate", "m/s", "at the start"}, displacement1Rate);
  f.coordinate({"displacement2", "m", "at the start, along the next: y for z"}, displacement2, Coordinate::displacement,
               {"displacement2_rate", "m/s", "at the start"}, displacement2Rate);
  f.coordinate({"angle", "rad", "at the start"}, angle, Coordinate::angle, {"angle_rate", "rad/s", "at the start"},
               angleRate);
  f.movesAs({.steps = {{.slides = true, .axis = following(axis, 1)},
                       {.slides = true, .axis = following(axis, 2)},
                       {.turns = true, .axis = axis}}});
}

std::vector<Fault> Planar::faults(const RangeOf& /*rangeOf*/) const {
  if (axis.isAligned()) return {};
  return {{"axis", "the plane of '" + name + "' is none of the coordinate planes",
           "\"x\", \"y\" or \"z\"; a weld ahead of the joint turns its plane"}};
}

template <class S>
void Planar::assemble(Assembler<S>& a) const {
  Frame<S>&first = a.hiddenFrame(), &second = a.hiddenFrame();
  a.template add<PrismaticJoint<S>>(a.frame(from), first, a.variable("displacement1"), following(axis, 1));
  a.template add<PrismaticJoint<S>>(first, second, a.variable("displacement2"), following(axis, 2));
  a.template add<RevoluteJoint<S>>(second, a.frame(to), a.variable("angle"), axis);
}

GAMUT_ASSEMBLE(Planar)

}  // namespace gamut
