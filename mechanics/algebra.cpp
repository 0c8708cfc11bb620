#include "mechanics/algebra.hpp"

#include "mechanics/algebra_members.hpp"

namespace gamut {

GAMUT_FOR_EVERY_SCALAR(GAMUT_SMALL_ALGEBRA, )

}  // namespace gamut
