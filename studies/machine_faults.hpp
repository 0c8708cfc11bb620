// Why a study's mechanism cannot be moved, with the place in the study's file.
#pragma once

#include "studies/study.hpp"

namespace gamut {

/// While an exception is handled that recording the study's mechanism threw: throws the StudyError that it means, or
/// that exception again.
[[noreturn]] void refuseMechanism(const Study& study);

}  // namespace gamut
