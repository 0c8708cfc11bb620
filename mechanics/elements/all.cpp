// In the order of the documentation: written by CMakeLists.txt of mechanics from what stands in this folder.
#include "mechanics/elements/all.hpp"

namespace gamut {

std::vector<Described> elementTypes() {
  std::vector<Described> types;
  types.emplace_back(Revolute{});
  types.emplace_back(Prismatic{});
  types.emplace_back(Screw{});
  types.emplace_back(Cylindrical{});
  types.emplace_back(Universal{});
  types.emplace_back(Planar{});
  types.emplace_back(Spherical{});
  types.emplace_back(Skate{});
  types.emplace_back(RollingWheel{});
  types.emplace_back(RollingBall{});
  types.emplace_back(Free{});
  types.emplace_back(Weld{});
  types.emplace_back(Play{});
  types.emplace_back(GuidePlay{});
  types.emplace_back(Link{});
  types.emplace_back(Closure{});
  types.emplace_back(RodClosure{});
  types.emplace_back(Mass{});
  types.emplace_back(Spring{});
  types.emplace_back(JointSpring{});
  types.emplace_back(Bushing{});
  types.emplace_back(JointFriction{});
  types.emplace_back(SmoothedJointFriction{});
  types.emplace_back(JointStop{});
  types.emplace_back(RigidStop{});
  types.emplace_back(PlaneContact{});
  types.emplace_back(Motor{});
  types.emplace_back(Force{});
  types.emplace_back(JointForce{});
  types.emplace_back(Drive{});
  types.emplace_back(TableDrive{});
  types.emplace_back(Coupling{});
  types.emplace_back(State{});
  types.emplace_back(Distance{});
  types.emplace_back(RelativeMotion{});
  types.emplace_back(Sphere{});
  types.emplace_back(Capsule{});
  types.emplace_back(Cuboid{});
  types.emplace_back(Hull{});
  types.emplace_back(Separation{});
  return types;
}

}  // namespace gamut
