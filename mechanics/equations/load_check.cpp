// Loads are what remains at u̇ = 0: one that is moved by u̇ would be inertia that no formulation knows of.
#include <stdexcept>
#include <utility>
#include <vector>

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

/// One pass with all u̇ as variables: what no resisted component is computed from moves nothing.
void checkMoved(System<Recorded>& system) {
  Recorder& recorder = *Recorder::current();
  std::vector<Recorded> accelerations;
  for (int i = 0; i < system.degreesOfFreedom(); ++i) accelerations.push_back(Recorded::node(recorder.unknown()));
  std::vector<int> open;
  for (const Recorded& component : system.resisted(accelerations)) open.push_back(component.node());
  std::vector<char> isNeeded(static_cast<std::size_t>(recorder.size()), 0);
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    if (std::exchange(isNeeded[node], 1) == 0)
      detail::forEachOperand(recorder.table(), node, [&](int operand) { open.push_back(operand); });
  }
  for (std::size_t j = 0; j < accelerations.size(); ++j)
    if (isNeeded[accelerations[j].node()] == 0)
      throw std::domain_error("the variable " + system.speeds()[j].get().name + " moves no mass");
}

}  // namespace gamut
