#include "mechanics/joints.hpp"

#include "mechanics/joints_members.hpp"

namespace gamut {

GAMUT_COMPILED_HERE(RevoluteJoint)
GAMUT_COMPILED_HERE(PrismaticJoint)
GAMUT_COMPILED_HERE(ScrewJoint)
GAMUT_COMPILED_HERE(SphericalJoint)

}  // namespace gamut
