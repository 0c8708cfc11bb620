// The drawings that a page carries as SVG: readable on paper and without a script. How layers look is said by the
// page's style sheet (StyleSheet), by their names.
#pragma once

#include <string>

#include "reports/drawing/beside.hpp"
#include "reports/drawing/plot.hpp"

namespace gamut {

/// The layers over time, 720 x 280 units. `label` says for those who cannot see it what is drawn.
std::string drawPlot(const Plot& plot, const std::string& label);

/// The same, and beside it on the same axis what is known at an instant; values there are drawn less `around`.
std::string drawPlotWith(const BesideMoment& moment, double around, const Plot& plot, const std::string& label);

/// The same on smaller paper; shares are drawn from 0 to 1.
std::string drawSmall(const Plot& plot, const std::string& label, bool isShare = false);

/// The ratios over time, 720 x 280 units; empty where there are none.
std::string drawRatios(const Plot& plot, const std::string& label);

/// Kinematics: one bar a layer, stacks level by level; at the first time.
std::string drawBars(const Plot& plot, const std::string& label);

/// One entry a layer, on paper the key to the drawings. The script makes each a switch.
std::string drawKey(const std::vector<Layer>& layers, const std::string& label);

}  // namespace gamut
