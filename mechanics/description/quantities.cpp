#include "mechanics/description/quantities.hpp"

#include "mechanics/description/fields.hpp"

namespace gamut {
namespace {

template <class Quantity>
void addVector(std::vector<Quantity>& list, const std::string& name, const std::string& unit, bool isSolved = false) {
  for (const char* component : components) list.push_back({name + "." + component, unit, isSolved});
}

}  // namespace

const std::vector<FrameQuantity>& frameQuantities() {
  static const std::vector<FrameQuantity> all = [] {
    std::vector<FrameQuantity> list;
    addVector(list, "position", "m");
    addVector(list, "velocity", "m/s");
    addVector(list, "acceleration", "m/s^2", true);
    addVector(list, "angular_velocity", "rad/s");
    addVector(list, "angular_acceleration", "rad/s^2", true);
    addVector(list, "rotation_vector", "rad");
    for (const char* angle : rollPitchYawNames) list.push_back({std::string("orientation.") + angle, "rad"});
    return list;
  }();
  return all;
}

const std::vector<WholeQuantity>& wholeQuantities() {
  static const std::vector<WholeQuantity> all = [] {
    std::vector<WholeQuantity> list = {{"energy", "J", false, false},
                                       {"energy.kinetic", "J", false, false},
                                       {"energy.potential", "J", false, false},
                                       {"energy.gravity", "J", false, false},
                                       {"energy.springs", "J", false, false}};
    addVector(list, "momentum", "kg m/s");
    addVector(list, "angular_momentum", "kg m^2/s");
    addVector(list, "centre_of_mass.position", "m");
    addVector(list, "centre_of_mass.velocity", "m/s");
    addVector(list, "centre_of_mass.acceleration", "m/s^2", true);
    return list;
  }();
  return all;
}

}  // namespace gamut
