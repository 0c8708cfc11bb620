#include "mechanics/rotation.hpp"

#include "mechanics/rotation_members.hpp"

namespace gamut {

GAMUT_COMPILED_HERE(Rotation)

}  // namespace gamut
