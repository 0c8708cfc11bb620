#include "mechanics/elements/skate.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/rolling.hpp"

namespace gamut {

void Skate::describe(Fields& f) {
  f.frame({"from", "", "the frame whose x and y span the plane"}, from);
  f.movedFrame({"to", "", "the frame that glides"}, to, from);
  f.coordinate({"path", "m", "at the start: how far it went forwards"}, path, Coordinate::displacement,
               {"speed", "m/s", "at the start: along x of `to`"}, pathRate);
  f.coordinate({"angle", "rad", "at the start: from x of `from` to that of `to`"}, angle, Coordinate::angle,
               {"angle_rate", "rad/s", "at the start"}, angleRate);
  f.position({"x", "m", "at the start: where `to` is in `from`"}, x);
  f.position({"y", "m", "likewise"}, y);
  f.measureSolved({"side_force", "N", "that keeps it from slipping sideways, along y of `to`"});
}

template <class S>
void Skate::assemble(Assembler<S>& a) const {
  Frame<S>& moved = a.frame(to);
  Gliding<S> gliding{&a.variable("angle"), &a.variable("path")};
  gliding.place = {&a.position("x", [gliding] { return gliding.placeRate(0); }),
                   &a.position("y", [gliding] { return gliding.placeRate(1); })};
  a.template add<GlidingJoint<S>>(a.frame(from), moved, gliding);
  a.measureSolved("side_force", [&moved] { return S(-moved.f[1]); });
}

GAMUT_ASSEMBLE(Skate)

}  // namespace gamut
