// The drawings that a page carries as SVG: readable on paper and without a script. Colours come from the page's style
// sheet, by class.
#pragma once

#include <string>

#include "reports/curves.hpp"

namespace gamut {

/// Bands and lines over time, 720 x 280 units. `label` says for those who cannot see it what is drawn.
std::string drawCurves(const Curves& curves, const std::string& label);

/// Overestimation over time, 720 x 130 units; empty where none was found.
std::string drawOverestimation(const Curves& curves, const std::string& label);

/// Kinematics: one bar an answer, the alpha-cuts stacked into the shape of the membership; at the first time.
std::string drawBars(const Curves& curves, const std::string& label);

}  // namespace gamut
