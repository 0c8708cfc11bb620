// Programs of a mechanism: its assembly is moved once by Recorded.
#include "mechanics/model.hpp"

#include <stdexcept>

#include "mechanics/assembly.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

Program recordMotion(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                     Formulation formulation) {
  const int f = mechanism.degreesOfFreedom();
  mechanism.checkMasses();
  try {
    return record(2 * f, static_cast<int>(freeParameters.size()), [&](auto, const auto& x, const auto& p, auto& dx) {
      Assembly<Recorded> assembly(mechanism, freeParameters, p);
      assembly.setState(x);
      const std::vector<Recorded> acceleration = assembly.accelerations(formulation);
      const auto split = static_cast<std::size_t>(f);
      for (std::size_t i = 0; i < split; ++i) {
        dx[i] = x[split + i];
        dx[split + i] = acceleration[i];
      }
    });
  } catch (const std::domain_error& error) {
    throw std::invalid_argument(std::string("the motion of the mechanism is not determined: ") + error.what());
  }
}

Program recordOutputs(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      const std::vector<std::string>& outputs) {
  return record(2 * mechanism.degreesOfFreedom(), static_cast<int>(freeParameters.size()),
                static_cast<int>(outputs.size()), [&](auto, const auto& x, const auto& p, auto& y) {
                  Assembly<Recorded> assembly(mechanism, freeParameters, p);
                  assembly.setState(x);
                  for (std::size_t i = 0; i < outputs.size(); ++i) y[i] = assembly.output(outputs[i]);
                });
}

}  // namespace gamut
