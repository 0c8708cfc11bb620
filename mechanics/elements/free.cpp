// Three prismatic joints, then a spherical one, with hidden frames between them.
#include "mechanics/elements/free.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/joints.hpp"

namespace gamut {

void Free::describe(Fields& f) {
  f.frame({"from", "", "the frame that it moves against"}, from);
  f.movedFrame({"to", "", "the frame that moves"}, to, from);
  f.coordinates({"position", "m", "`[x, y, z]` at the start: the place of `to` in `from`"}, position,
                Coordinate::displacement, {"velocity", "m/s", "`[x, y, z]` at the start: its rate"}, velocity);
  f.orientation({"orientation", "rad", "at the start: " + orientationForms}, orientation,
                {"rate", "rad/s", "`[x, y, z]` at the start: the angular velocity against `from`, in the axes of `to`"},
                rate);
}

template <class S>
void Free::assemble(Assembler<S>& a) const {
  Frame<S>* at = &a.frame(from);
  const std::array<Axis, 3> axes = {axisX, axisY, axisZ};
  for (std::size_t i = 0; i < 3; ++i) {
    Frame<S>& slid = a.hiddenFrame();
    a.template add<PrismaticJoint<S>>(*at, slid, a.variable(std::string("position.") + components[i]), axes[i]);
    at = &slid;
  }
  a.template add<SphericalJoint<S>>(*at, a.frame(to), a.orientation("rate"));
}

GAMUT_ASSEMBLE(Free)

}  // namespace gamut
