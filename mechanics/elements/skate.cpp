#include "mechanics/elements/skate.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/elements/touching.hpp"

namespace gamut {

void Skate::describe(Fields& f) {
  f.frame({"from", "", "the frame whose x and y span the plane"}, from);
  f.movedFrame({"to", "", "the frame that glides"}, to, from);
  f.coordinate({"path", "m", "at the start: how far it went forwards"}, path, Coordinate::displacement,
               {"speed", "m/s", "at the start: along x of `to`"}, pathRate);
  f.coordinate({"angle", "rad", "at the start: from x of `from` to that of `to`"}, angle, Coordinate::angle,
               {"angle_rate", "rad/s", "at the start"}, angleRate);
  describePlace(f, "where `to` is", x, y);
  f.measureSolved({"lateral_force", "N", "that keeps it from slipping sideways, along y of `to`"});
}

template <class S>
void Skate::assemble(Assembler<S>& a) const {
  Frame<S>& moved = a.frame(to);
  const Gliding<S> gliding{&a.variable("angle"), &a.variable("path")};
  a.template add<GlidingJoint<S>>(a.frame(from), moved, gliding, placeOf(a, gliding));
  a.measureSolved("lateral_force", [&moved] { return S(-moved.f[1]); });
}

GAMUT_ASSEMBLE(Skate)

}  // namespace gamut
