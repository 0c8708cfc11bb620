// q' = i q + c, Q += i Q': ahead of both joints (Gear).
#include "mechanics/elements/coupling.hpp"

#include "mechanics/assembler.hpp"

namespace gamut {

void Coupling::describe(Fields& f) {
  const Coordinate leader = f.coordinateOf({"to", "", "the joint that it follows, or one of its coordinates"}, to);
  const Coordinate kind = f.followingCoordinate(
      {"joint", "", "the joint that follows, or one of its coordinates: no state any more"}, joint, to);
  const std::string perLeader = std::string(unitOf(kind)) + "/" + unitOf(leader);
  f.number({"ratio", kind == leader ? "1" : perLeader, "1 unless given; rad/m or m/rad where one turns, one slides"},
           ratio);
  f.number({"offset", unitOf(kind), "where it is when the other is at 0"}, offset);
  f.drawsGear(to, joint, ratio);
}

template <class S>
void Coupling::assemble(Assembler<S>& a) const {
  a.template addFirst<Gear<S>>(a.coordinate(to), a.coordinate(joint), a.number(ratio), a.number(offset));
}

GAMUT_ASSEMBLE(Coupling)

}  // namespace gamut
