// The types of elements that there are: the one place where a new one is entered.
#pragma once

#include "mechanics/elements/bushing.hpp"
#include "mechanics/elements/coupling.hpp"
#include "mechanics/elements/cylindrical.hpp"
#include "mechanics/elements/distance.hpp"
#include "mechanics/elements/drive.hpp"
#include "mechanics/elements/force.hpp"
#include "mechanics/elements/free.hpp"
#include "mechanics/elements/joint_force.hpp"
#include "mechanics/elements/joint_friction.hpp"
#include "mechanics/elements/joint_spring.hpp"
#include "mechanics/elements/joint_stop.hpp"
#include "mechanics/elements/link.hpp"
#include "mechanics/elements/mass.hpp"
#include "mechanics/elements/motor.hpp"
#include "mechanics/elements/planar.hpp"
#include "mechanics/elements/prismatic.hpp"
#include "mechanics/elements/relative_motion.hpp"
#include "mechanics/elements/revolute.hpp"
#include "mechanics/elements/screw.hpp"
#include "mechanics/elements/spherical.hpp"
#include "mechanics/elements/spring.hpp"
#include "mechanics/elements/state.hpp"
#include "mechanics/elements/universal.hpp"
#include "mechanics/elements/weld.hpp"

namespace gamut {

/// An empty description of each, in the order of the documentation, for visitors to fill in.
inline std::vector<Described> elementTypes() {
  return {Revolute{},    Prismatic{},     Screw{},         Cylindrical{},
          Universal{},   Planar{},        Spherical{},     Free{},
          Weld{},        Link{},          Mass{},          Spring{},
          JointSpring{}, Bushing{},       JointFriction{}, SmoothedJointFriction{},
          JointStop{},   Motor{},         Force{},         JointForce{},
          Drive{},       TableDrive{},    Coupling{},      State{},
          Distance{},    RelativeMotion{}};
}

}  // namespace gamut
