#include "mechanics/rolling.hpp"

#include "mechanics/rolling_members.hpp"

namespace gamut {

GAMUT_COMPILED_HERE(GlidingJoint)
GAMUT_COMPILED_HERE(WheelRolling)
GAMUT_COMPILED_HERE(RollingBallJoint)
GAMUT_COMPILED_HERE(BallAxes)

}  // namespace gamut
