// Layers in the order of the analyses.
#include "reports/sections/contribution.hpp"

namespace gamut {

Plot plotOf(const Results& results, std::size_t output) {
  Plot plot{results.outputs[output].name, results.outputs[output].unit, results.time, {}, {}};
  for (const Contribution* analysis : analyses) analysis->draw(results, output, plot);
  return plot;
}

}  // namespace gamut
