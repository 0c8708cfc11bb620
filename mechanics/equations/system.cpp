#include "mechanics/equations/system.hpp"

#include "mechanics/equations/system_members.hpp"

namespace gamut {

GAMUT_COMPILED_HERE(System)

}  // namespace gamut
