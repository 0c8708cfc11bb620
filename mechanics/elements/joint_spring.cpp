#include "mechanics/elements/joint_spring.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/springs.hpp"

namespace gamut {

void JointSpring::describe(Fields& f) {
  const Coordinate kind = f.coordinateOf({"joint", "", "the joint, or one of its coordinates"}, joint);
  const std::string unit = unitOf(kind), force = forceUnitOf(kind);
  f.number({"stiffness", force + "/" + unit, ""}, stiffness);
  f.number({"rest", unit, "where it pulls and pushes nothing"}, rest);
  f.number({"damping", force + " s/" + unit, ""}, damping);
  f.drawsJointSpring(joint, {stiffness, damping});
}

template <class S>
void JointSpring::assemble(Assembler<S>& a) const {
  a.template add<JointSpringDamper<S>>(a.coordinate(joint), a.number(stiffness), a.number(rest), a.number(damping));
}

GAMUT_ASSEMBLE(JointSpring)

}  // namespace gamut
