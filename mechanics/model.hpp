// From the description of a mechanism to the programs that analyses work with.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/equations/formulation.hpp"
#include "scalars/program/program.hpp"
#include "scalars/program/resting.hpp"

namespace gamut {

class Recorded;

template <class S>
class Assembly;

/// ẋ = f(t, x, p): x = [q; u; z] in the order of Mechanism::stateNames(), p the named parameters in the order given;
/// every other number is a constant of the program. States that start by one of them are differences
/// (Assembly::setMotion). Throws std::invalid_argument for an incomplete mechanism, for a name that is no parameter,
/// and if a joint moves no inertia.
Program recordMotion(const Mechanism& mechanism, const std::vector<std::string>& freeParameters = {},
                     Formulation formulation = Formulation::sparse);

/// Of loops that name no dependent coordinates, by the element that closes each, such as hold them firmly where the
/// nominal machine starts (firmDependents, equations/loop_rows.hpp). Empty where these are those that the mechanism
/// has, or nothing can be said.
DependentsOf firmerDependents(const Mechanism& mechanism, const std::set<std::string>& given);
/// Whether the nominal machine is found closed from where its closed position is looked for.
bool startsClosed(const Mechanism& mechanism);

/// Newton's map of the loops at the start (Assembly::closingMap), of n differences as states, one a dependent
/// coordinate, and of the named parameters.
Program recordClosing(const Mechanism& mechanism, const std::vector<std::string>& freeParameters);
/// The same of their rates, where loops are held (Assembly::closingRatesMap): further parameters are what the positions
/// are off by.
Program recordClosingRates(const Mechanism& mechanism, const std::vector<std::string>& freeParameters);

/// A step towards where loops close at the start, of n differences from where those of the nominal machine do, as
/// states, and of the named parameters: δ − J⁻¹ g(. + δ), J the nominal machine's in doubles. Each step finds one more
/// power of the parameters.
Program recordApproach(const Mechanism& mechanism, const std::vector<std::string>& freeParameters);

/// The rows g of all loops, of the states (themselves, not differences) and of the named parameters.
Program recordLoops(const Mechanism& mechanism, const std::vector<std::string>& freeParameters);

/// Throws UnfitPart if points between which an element measures a length do not lie apart at the start.
void checkStart(const Mechanism& mechanism);

/// The coordinates and speeds of this motion that come to rest on rigid ends.
std::vector<RestingPair> restsOf(const Mechanism& mechanism);

/// An output has no value, whatever the motion; what() says so of it: "has no value: why".
class UndefinedOutput : public std::invalid_argument {
 public:
  UndefinedOutput(std::size_t output, const std::string& sentence) : std::invalid_argument(sentence), output_(output) {}
  /// Which of those that were asked for.
  std::size_t output() const { return output_; }

 private:
  std::size_t output_;
};

/// The values of outputs, as in Assembly::output. Throws UndefinedOutput.
std::vector<Recorded> recordOutputs(const Assembly<Recorded>& assembly, std::span<const Expression> outputs);

/// y = g(t, x, p): one value for each output. Throws std::invalid_argument as recordMotion, for an unknown output, and
/// UndefinedOutput.
Program recordOutputs(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      std::span<const Expression> outputs);
Program recordOutputs(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      const std::vector<std::string>& outputs);

}  // namespace gamut
