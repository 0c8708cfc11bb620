// Wheels that stand for a gear between two joints.
#pragma once

#include <cstddef>
#include <optional>

#include "studies/results/picture.hpp"

namespace gamut {

struct GearWheels {
  double first = 0, second = 0;               ///< radii, m; 0: none at this joint
  std::size_t firstAxle = 0, secondAxle = 0;  ///< axes
  bool isBelt = false;                        ///< the wheels do not touch
};

/// Pitch circles that touch, of joints that turn against each other about parallel axes; wheels of a belt, of joints
/// that turn alike, whose radii have the ratio too; or the one wheel that rolls on a rack. Nothing of other gears: only
/// that they are there can be seen. As everything stands at the start.
std::optional<GearWheels> gearWheelsOf(const PictureResult& machine, std::size_t part);

}  // namespace gamut
