#include "mechanics/elements/mass.hpp"

#include <algorithm>

#include "mechanics/assembler.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/elements/inertia.hpp"

namespace gamut {

void Mass::describe(Fields& f) {
  f.frame({"at", "", "the frame that it is fixed to"}, at);
  f.carriesMass({at, centre}, mass,
                rotation.empty() ? std::span<const Expression>(inertia).first(3) : std::span<const Expression>());
  f.number({"mass", "kg", "the mass, not negative", true}, mass);
  f.vector({"centre", "m", "centre of mass, in `at`"}, centre);
  f.numbers(
      {"inertia", "kg m^2", "`[xx, yy, zz]` or `[xx, yy, zz, xy, yz, zx]`, about the centre, in the axes of `at`"},
      inertia, symmetricEntries, 3);
  f.rotations({"rotation", "rad", "of the inertia's axes against `at`; written as that of a link"}, rotation);
  for (const char* component : components) {
    f.measure({std::string("position.") + component, "m", "of the centre, in the inertial frame"});
    f.measure({std::string("velocity.") + component, "m/s", "of the centre, in the inertial frame"});
    f.measureSolved({std::string("acceleration.") + component, "m/s^2", "of the centre, in the inertial frame"});
  }
}

template <class S>
void Mass::assemble(Assembler<S>& a) const {
  const auto& body = a.template add<MassElement<S>>(a.frame(at), a.number(mass), a.vector(centre),
                                                    a.rotation(rotation).symmetricToParent(a.symmetric(inertia)));
  for (int i = 0; i < 3; ++i) {
    const std::string component = components[i];
    a.measure("position." + component, [&body, i] { return body.position().position[i]; });
    a.measure("velocity." + component, [&body, i] { return body.position().velocity[i]; });
    a.measureSolved("acceleration." + component, [&body, i] { return body.acceleration()[i]; });
  }
}

std::vector<Fault> Mass::faults(const RangeOf& rangeOf) const {
  if (rangeOf(mass).upper() < 0) return {{"mass", "the mass of '" + name + "' is negative", "a mass of at least 0 kg"}};
  std::array<Interval, 6> tensor;
  std::ranges::transform(inertia, tensor.begin(), rangeOf);
  const std::string fault = impossibilityOf(tensor);
  if (fault.empty()) return {};
  return {{"inertia", "the inertia of '" + name + "' " + fault,
           "an inertia that a body can have, each moment no greater than the other two together"}};
}

GAMUT_ASSEMBLE(Mass)

}  // namespace gamut
