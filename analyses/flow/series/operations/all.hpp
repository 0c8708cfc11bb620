// All elementary functions: written by CMakeLists.txt of analyses from what stands in this folder.
#pragma once

#include "analyses/flow/series/operations/abs.hpp"
#include "analyses/flow/series/operations/atan.hpp"
#include "analyses/flow/series/operations/exp.hpp"
#include "analyses/flow/series/operations/log.hpp"
#include "analyses/flow/series/operations/recip.hpp"
#include "analyses/flow/series/operations/sign.hpp"
#include "analyses/flow/series/operations/sin_cos.hpp"
#include "analyses/flow/series/operations/sqrt.hpp"
#include "analyses/flow/series/operations/tanh_sech2.hpp"
