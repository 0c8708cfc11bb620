#include "scalars/algebra/decompositions.hpp"

GAMUT_DECOMPOSITIONS()
