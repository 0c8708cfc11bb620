#include "mechanics/joints.hpp"

namespace gamut {

GAMUT_COMPILED_HERE(RevoluteJoint)
GAMUT_COMPILED_HERE(PrismaticJoint)
GAMUT_COMPILED_HERE(SphericalJoint)
GAMUT_COMPILED_HERE(BallAxes)

}  // namespace gamut
