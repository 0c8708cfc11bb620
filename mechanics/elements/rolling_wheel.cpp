// A gliding joint, to where the wheel touches the plane, then hinges for lean and turn with the tread and the rim
// between them.
#include "mechanics/elements/rolling_wheel.hpp"

#include <cmath>

#include "mechanics/assembler.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/joints.hpp"
#include "mechanics/rolling.hpp"

namespace gamut {

void RollingWheel::describe(Fields& f) {
  f.frame({"from", "", "the frame whose x and y span the plane"}, from);
  f.movedFrame({"to", "", "the frame of the wheel"}, to, from);
  f.number({"radius", "m", "of the wheel, from its centre to the middle of its tread", true}, radius);
  f.number({"tread", "m", "radius to which the tread is rounded, at most that of the wheel; 0, an edge, unless given"},
           tread);
  f.coordinate({"heading", "rad", "at the start: from x of `from` to where the wheel rolls"}, heading,
               Coordinate::angle, {"heading_rate", "rad/s", "at the start"}, headingRate);
  f.coordinate({"lean", "rad", "at the start: about the direction in which it rolls, above 0 to its right"}, lean,
               Coordinate::angle, {"lean_rate", "rad/s", "at the start"}, leanRate);
  f.coordinate({"angle", "rad", "at the start: about its axle, above 0 forwards"}, angle, Coordinate::angle,
               {"rate", "rad/s", "at the start"}, angleRate);
  f.position({"x", "m", "at the start: where it touches the plane, in `from`"}, x);
  f.position({"y", "m", "likewise"}, y);
  f.measureSolved({"normal_force", "N", "of the plane on the wheel"});
  f.measureSolved({"drive_force", "N", "of the plane on the wheel, in the direction in which it rolls"});
  f.measureSolved({"side_force", "N", "of the plane on the wheel, to its left"});
  f.measureSolved({"squared_grip", "1", "the square of the coefficient of friction that it needs, at least"});
}

std::vector<Fault> RollingWheel::faults(const RangeOf& rangeOf) const {
  const Interval wheel = rangeOf(radius), rounding = rangeOf(tread);
  if (wheel.lower() <= 0) return {{"radius", "the radius of '" + name + "' is not positive", "a radius above 0 m"}};
  if (rounding.lower() < 0) return {{"tread", "the tread of '" + name + "' is negative", "at least 0 m"}};
  if (rounding.upper() > wheel.upper())
    return {{"tread", "the tread of '" + name + "' is rounded to more than the wheel's radius", "at most the radius"}};
  return {};
}

template <class S>
void RollingWheel::assemble(Assembler<S>& a) const {
  const S rounding = a.number(tread), rim = a.number(radius) - rounding;
  Variable<S>&leaning = a.variable("lean"), &turning = a.variable("angle");
  auto& wheel = a.template add<WheelRolling<S>>(leaning, turning, rim, rounding);
  Gliding<S> gliding{&a.variable("heading"), &wheel.along(), &wheel.across()};
  gliding.place = {&a.position("x", [gliding] { return gliding.placeRate(0); }),
                   &a.position("y", [gliding] { return gliding.placeRate(1); })};
  Frame<S>&touching = a.hiddenFrame(), &treadCentre = a.hiddenFrame(), &leant = a.hiddenFrame(), &hub = a.hiddenFrame();
  a.template add<GlidingJoint<S>>(a.frame(from), touching, gliding);
  a.template add<RigidLink<S>>(touching, treadCentre, Vector3<S>(S(0.0), S(0.0), rounding));
  a.template add<RevoluteJoint<S>>(treadCentre, leant, leaning, axisX);
  a.template add<RigidLink<S>>(leant, hub, Vector3<S>(S(0.0), S(0.0), rim));
  a.template add<RevoluteJoint<S>>(hub, a.frame(to), turning, axisY);
  a.measureSolved("normal_force", [&touching] { return S(-touching.f[2]); });
  a.measureSolved("drive_force", [&touching] { return S(-touching.f[0]); });
  a.measureSolved("side_force", [&touching] { return S(-touching.f[1]); });
  a.measureSolved("squared_grip", [&touching] { return squaredGripOf<S>(touching.f); });
}

GAMUT_ASSEMBLE(RollingWheel)

}  // namespace gamut
