#include "mechanics/elements/spherical.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/joints.hpp"

namespace gamut {

void Spherical::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the joint"}, from);
  f.movedFrame({"to", "", "the frame that turns"}, to, from);
  f.orientation({"orientation", "rad", "at the start: " + orientationForms}, orientation,
                {"rate", "rad/s", "`[x, y, z]` at the start: the angular velocity against `from`, in the axes of `to`"},
                rate);
}

template <class S>
void Spherical::assemble(Assembler<S>& a) const {
  a.template add<SphericalJoint<S>>(a.frame(from), a.frame(to), a.orientation("rate"));
}

GAMUT_ASSEMBLE(Spherical)

}  // namespace gamut
