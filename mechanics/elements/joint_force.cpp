// Q += F(t, x, p): power F q̇.
#include "mechanics/elements/joint_force.hpp"

#include "mechanics/assembler.hpp"

namespace gamut {
namespace {

template <class S>
class JointForceLoad final : public Load<S> {
 public:
  JointForceLoad(Variable<S>& variable, Signal<S> force) : variable_(variable), force_(std::move(force)) {}

  S power() const { return force_() * variable_.rate; }

 private:
  void applyForce() override { variable_.force += force_(); }

  Variable<S>& variable_;
  Signal<S> force_;
};

}  // namespace

void JointForce::describe(Fields& f) {
  const Coordinate kind = f.coordinateOf({"joint", "", "the joint, or one of its coordinates"}, joint);
  f.signal({"force", forceUnitOf(kind), "in the direction in which the coordinate grows", true}, force);
  f.measure({"power", "W", "that it brings in"});
}

template <class S>
void JointForce::assemble(Assembler<S>& a) const {
  const auto& load = a.template add<JointForceLoad<S>>(a.coordinate(joint), a.signal(force));
  a.measure("power", [&load] { return load.power(); });
}

GAMUT_ASSEMBLE(JointForce)

}  // namespace gamut
