#include "mechanics/elements/weld.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/description/orientation.hpp"

namespace gamut {

void Weld::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the other"}, from);
  f.movedFrame({"to", "", "the frame that is fixed to it"}, to, from);
  f.rotations({"rotation", "rad", "of `to` against `from`: " + orientationForms}, rotation);
  f.movesAs({.rotation = rotation});
}

template <class S>
void Weld::assemble(Assembler<S>& a) const {
  a.template add<RigidLink<S>>(a.frame(from), a.frame(to), zeroVector<S>(), a.rotation(rotation));
}

GAMUT_ASSEMBLE(Weld)

}  // namespace gamut
