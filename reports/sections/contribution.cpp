// Layers in the order of the analyses.
#include "reports/sections/contribution.hpp"

namespace gamut {

Plot plotOf(const Results& results, std::size_t output) {
  const std::string& unit = results.outputs[output].unit;
  Plot plot{results.outputs[output].name, unit == "1" ? "" : unit, results.time, {}, {}};
  for (const Contribution* analysis : analyses) analysis->draw(results, output, plot);
  return plot;
}

}  // namespace gamut
