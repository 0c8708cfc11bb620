// From the description of a mechanism to the programs that analyses work with.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/equations/formulation.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// ẋ = f(t, x, p): x = [q; u; z] in the order of Mechanism::stateNames(), p the named parameters in the order given;
/// every other number is a constant of the program. Throws std::invalid_argument for an incomplete mechanism, for a
/// name that is no parameter, and if a joint moves no inertia.
Program recordMotion(const Mechanism& mechanism, const std::vector<std::string>& freeParameters = {},
                     Formulation formulation = Formulation::sparse);

/// y = g(t, x, p): one value for each output, as in Assembly::output. Throws std::invalid_argument as recordMotion, and
/// for an unknown output.
Program recordOutputs(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      const std::vector<std::string>& outputs);

}  // namespace gamut
