#include "mechanics/joint.hpp"

#include "mechanics/joint_members.hpp"

namespace gamut {

GAMUT_COMPILED_HERE(Joint)

}  // namespace gamut
