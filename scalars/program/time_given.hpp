// Time as a number like any other.
#pragma once

#include "scalars/program/program.hpp"

namespace gamut {

/// The program with time as a last parameter; of time itself nothing depends any more.
Program withTimeGiven(const Program& program);

}  // namespace gamut
