// All elementary functions: written by CMakeLists.txt of analyses from what stands in this folder.
#pragma once

#include "analyses/flow/operations/abs.hpp"
#include "analyses/flow/operations/atan.hpp"
#include "analyses/flow/operations/exp.hpp"
#include "analyses/flow/operations/log.hpp"
#include "analyses/flow/operations/recip.hpp"
#include "analyses/flow/operations/sign.hpp"
#include "analyses/flow/operations/sin_cos.hpp"
#include "analyses/flow/operations/sqrt.hpp"
#include "analyses/flow/operations/tanh_sech2.hpp"
