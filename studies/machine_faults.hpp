// Why a study's mechanism cannot be moved, with the place in the study's file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"
#include "studies/study.hpp"

namespace gamut {

/// While an exception is handled that recording the study's mechanism threw: throws the StudyError that it means, or
/// that exception again.
[[noreturn]] void refuseMechanism(const Study& study);

/// Throws a StudyError if in a mechanism whose loops close a joint, or several together, move no mass at the start.
void refuseMasslessLoops(const Study& study);

/// Throws a StudyError: loops are not proved to close for values of the free parameters in a part of their box, of
/// which it names those that the equations, a program of them, ask for.
[[noreturn]] void refuseOpenLoops(const Study& study, const std::vector<std::string>& freeParameters, const Box& part,
                                  const Program& equations);

/// Likewise: a position of rest, or a mode there, is not proved for them.
[[noreturn]] void refuseUnprovedRest(const Study& study, const std::vector<std::string>& freeParameters,
                                     const Box& part, bool isPosition, std::span<const Program> equations);

/// Throws a StudyError if a quantity that varies in time is in the rows that close loops, at the start or elsewhere:
/// positions would have to follow it at once. `irregular`: what keeps loops that closed forms close from being put so,
/// if they are such.
void refuseVaryingLoops(const Study& study, const std::vector<std::string>& freeParameters,
                        const std::string& irregular);

}  // namespace gamut
