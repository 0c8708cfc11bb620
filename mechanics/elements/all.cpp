// In the order of the documentation.
#include "mechanics/elements/all.hpp"

namespace gamut {

std::vector<Described> elementTypes() {
  return {Revolute{},
          Prismatic{},
          Screw{},
          Cylindrical{},
          Universal{},
          Planar{},
          Spherical{},
          Skate{},
          RollingWheel{},
          RollingBall{},
          Free{},
          Weld{},
          Link{},
          Mass{},
          Spring{},
          JointSpring{},
          Bushing{},
          JointFriction{},
          SmoothedJointFriction{},
          JointStop{},
          RigidStop{},
          PlaneContact{},
          Motor{},
          Force{},
          JointForce{},
          Drive{},
          TableDrive{},
          Coupling{},
          State{},
          Distance{},
          RelativeMotion{}};
}

}  // namespace gamut
