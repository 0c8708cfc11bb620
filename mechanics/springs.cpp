#include "mechanics/springs.hpp"

#include "mechanics/springs_members.hpp"

namespace gamut {

GAMUT_COMPILED_HERE(Chord)
GAMUT_COMPILED_HERE(SpringDamper)
GAMUT_COMPILED_HERE(JointSpringDamper)

}  // namespace gamut
