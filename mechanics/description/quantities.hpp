// What can be measured of every frame and of every machine, by name.
#pragma once

#include <string>
#include <vector>

namespace gamut {

/// Of a frame, as the inertial frame sees it and in its axes: FRAME.NAME.
struct FrameQuantity {
  std::string name, unit;
  bool isSolved = false;  ///< known once the equations of motion are solved
};
/// position, velocity, acceleration, angular_velocity, angular_acceleration and rotation_vector, each .x … .z;
/// orientation.roll, .pitch, .yaw. In this order, three components each.
const std::vector<FrameQuantity>& frameQuantities();

/// Of the whole machine. Its first word is no name of a part.
struct WholeQuantity {
  std::string name, unit;
  bool isSolved = false, isOfMass = true;  ///< isOfMass: there is none without a mass
};
/// energy, energy.kinetic, energy.potential, energy.gravity, energy.springs; then, each .x … .z, momentum,
/// angular_momentum, centre_of_mass.position, centre_of_mass.velocity, centre_of_mass.acceleration.
const std::vector<WholeQuantity>& wholeQuantities();

}  // namespace gamut
