// The machine as a scene, and as it stands at the start, in SVG: what the script of the page moves later, element by
// element.
#pragma once

#include <string>

#include "reports/drawing/scene.hpp"
#include "studies/results/picture.hpp"

namespace gamut {

/// Motions that would hardly be seen are magnified: ways from where points stand at the start, and what encloses them.
/// Links, joints by their kind, masses with their names, springs and the ground; behind them the samples and the region
/// that the enclosures sweep, in front the enclosures at one time.
Scene sceneOf(const PictureResult& machine);

/// As it stands at the start; `label` for those who cannot see it.
std::string drawScene(const Scene& scene, const std::string& label);

/// At a time, for paper: without names, and without the region that is swept.
std::string drawPose(const Scene& scene, std::size_t row, const std::string& label);

/// Whether some place is enclosed.
bool isEnclosed(const PictureResult& machine);

}  // namespace gamut
