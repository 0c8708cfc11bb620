#include "mechanics/elements/spring.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/springs.hpp"

namespace gamut {

void Spring::describe(Fields& f) {
  f.frame({"from", "", "the frame at one end"}, from);
  f.otherFrame({"to", "", "the frame at the other end"}, to, from);
  f.number({"stiffness", "N/m", ""}, stiffness);
  f.number({"rest_length", "m", "at which it pulls and pushes nothing"}, restLength);
  f.number({"damping", "N s/m", ""}, damping);
  f.vector({"from_point", "m", "where it is fixed in `from`"}, fromPoint);
  f.vector({"to_point", "m", "where it is fixed in `to`"}, toPoint);
  f.drawsSpring({from, fromPoint}, {to, toPoint}, {stiffness, damping});
  f.measureLength({"length", "m", "of the spring"});
  f.measure({"force", "N", "that pushes its ends apart"});
}

template <class S>
void Spring::assemble(Assembler<S>& a) const {
  Chord<S> chord(a.frame(from), a.vector(fromPoint), a.frame(to), a.vector(toPoint));
  const auto& spring =
      a.template add<SpringDamper<S>>(std::move(chord), a.number(stiffness), a.number(restLength), a.number(damping));
  a.measure("length", [&spring] { return spring.chord().length(); });
  a.measure("force", [&spring] { return spring.force(); });
}

GAMUT_ASSEMBLE(Spring)

}  // namespace gamut
