// The machine as it stands at the start, in SVG: what the script of the page moves later, element by element.
#pragma once

#include <string>

#include "reports/drawing/view.hpp"
#include "studies/results/machine.hpp"

namespace gamut {

/// Links, joints by their kind, masses with their names, springs and the ground; behind them the samples, the
/// enclosures at the start and the region that they sweep. `label` for those who cannot see it.
std::string drawMachine(const MachineResult& machine, const View& view, const std::string& label);

/// Whether some place is enclosed.
bool isEnclosed(const MachineResult& machine);

/// The same numbers and looks for the script, as JSON: places are whole numbers of a unit so small that nobody sees it,
/// enclosures rounded outward.
std::string machineData(const MachineResult& machine, const View& view);

}  // namespace gamut
