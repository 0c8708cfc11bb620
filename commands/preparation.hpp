// The machine of a study, before anything runs: what recording it and proving where it starts may take.
#pragma once

#include <optional>

#include "studies/machine.hpp"

namespace gamut {

/// Progress on a terminal, unless it is quiet. Where it takes more CPU time than `timeLimit` (s), or the study's limit,
/// and more than a second, the program says so and ends with the exit code of that, as by an interrupt; no file is
/// touched.
Machine prepared(Study study, bool isQuiet, std::optional<double> timeLimit = {});

}  // namespace gamut
