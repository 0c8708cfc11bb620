// All elementary functions:
// written by CMakeLists.txt of scalars from what stands in this folder.
#pragma once

#include "scalars/operations/abs.hpp"
#include "scalars/operations/atan.hpp"
#include "scalars/operations/exp.hpp"
#include "scalars/operations/log.hpp"
#include "scalars/operations/recip.hpp"
#include "scalars/operations/sign.hpp"
#include "scalars/operations/sin_cos.hpp"
#include "scalars/operations/sqrt.hpp"
#include "scalars/operations/tanh_sech2.hpp"
