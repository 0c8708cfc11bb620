// Programs of a mechanism: its assembly is moved once by Recorded.
#include "mechanics/model.hpp"

#include <stdexcept>

#include "mechanics/assembly.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

Program recordMotion(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                     Formulation formulation) {
  const int states = static_cast<int>(mechanism.stateNames().size());
  mechanism.checkMasses();
  try {
    return record(states, static_cast<int>(freeParameters.size()), [&](auto t, const auto& x, const auto& p, auto& dx) {
      Assembly<Recorded> assembly(mechanism, freeParameters, p);
      const std::vector<Recorded> rates = assembly.motionRates(x, t, formulation);
      for (std::size_t i = 0; i < rates.size(); ++i) dx[i] = rates[i];
    });
  } catch (const std::domain_error& error) {
    throw std::invalid_argument(std::string("the motion of the mechanism is not determined: ") + error.what());
  }
}

std::vector<Recorded> recordOutputs(const Assembly<Recorded>& assembly, const std::vector<std::string>& outputs) {
  std::vector<Recorded> values;
  for (const std::string& output : outputs) {
    try {
      values.push_back(assembly.output(output));
    } catch (const std::domain_error& error) {
      throw UndefinedOutput(values.size(), "'" + output + "' has no value: " + error.what());
    }
  }
  return values;
}

Program recordOutputs(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      const std::vector<std::string>& outputs) {
  return record(static_cast<int>(mechanism.stateNames().size()), static_cast<int>(freeParameters.size()),
                static_cast<int>(outputs.size()), [&](auto t, const auto& x, const auto& p, auto& y) {
                  Assembly<Recorded> assembly(mechanism, freeParameters, p);
                  const std::vector<Recorded> values =
                      assembly.ofMotion(x, t, [&] { return recordOutputs(assembly, outputs); });
                  for (std::size_t i = 0; i < values.size(); ++i) y[i] = values[i];
                });
}

}  // namespace gamut
