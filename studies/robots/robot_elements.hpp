// A robot as elements of a mechanism.
#pragma once

#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "studies/robots/robot.hpp"
#include "studies/settings.hpp"

namespace gamut {

/// An element, and where in the robot's file it comes from.
struct RobotElement {
  Described element;
  std::string place;  ///< "file:line"
};

/// Declares the robot's numbers in the mechanism: LINK.mass, LINK.centre.x … z, LINK.inertia.xx …, the inertia's
/// LINK.inertia.roll, pitch and yaw, JOINT.origin.x … z, JOINT.origin.roll, pitch and yaw, and, where they are not 0,
/// JOINT.damping, JOINT.friction, JOINT.stiffness with JOINT.rest, JOINT.armature. Returns the elements that are to be
/// added to it, in this order: a frame LINK for each link, its shapes LINK.collision behind frames
/// LINK.collision.origin, numbered if there are several, a mass LINK.body, a joint JOINT behind a frame JOINT.origin.
/// Throws StudyError for what is not supported yet, std::invalid_argument as Mechanism::addParameter does.
std::vector<RobotElement> robotElements(const Robot& robot, const RobotChoices& choices, Mechanism& mechanism);

}  // namespace gamut
