#include "mechanics/bodies.hpp"

#include "mechanics/bodies_members.hpp"

namespace gamut {

GAMUT_COMPILED_HERE(RigidLink)
GAMUT_COMPILED_HERE(MassElement)

}  // namespace gamut
