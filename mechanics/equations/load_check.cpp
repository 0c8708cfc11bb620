// Loads are what remains at u̇ = 0: one that is moved by u̇ would be inertia that no formulation knows of.
#include <stdexcept>

#include "mechanics/equations/system.hpp"
#include "scalars/program/differentiation.hpp"

namespace gamut {

void checkLoads(System<Recorded>& system) {
  Recorder& recorder = *Recorder::current();
  std::vector<Recorded> accelerations;
  std::vector<std::pair<int, int>> seeds;
  for (int i = 0; i < system.degreesOfFreedom(); ++i) {
    accelerations.push_back(Recorded::node(recorder.unknown()));
    seeds.emplace_back(accelerations.back().node(), recorder.constant(1.0));
  }
  system.setAccelerations(accelerations);
  system.doMotion();
  system.doForce(ForceKind::applied);
  std::vector<int> forces;
  for (const Recorded& force : system.generalisedForces()) forces.push_back(force.node());
  for (int derivative : tangents(recorder, forces, seeds))
    if (!isKnownZero(Recorded::node(derivative)))
      throw std::logic_error(
          "a load depends on accelerations, so that it has inertia; only an Inertia, such as MassElement, may state "
          "it");
}

}  // namespace gamut
