#include "mechanics/element.hpp"

#include "mechanics/element_members.hpp"

namespace gamut {

GAMUT_COMPILED_HERE(Frame)
GAMUT_COMPILED_HERE(Transmission)
GAMUT_COMPILED_HERE(Chain)

}  // namespace gamut
