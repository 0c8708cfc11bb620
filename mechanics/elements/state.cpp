#include "mechanics/elements/state.hpp"

#include "mechanics/assembler.hpp"

namespace gamut {

void State::describe(Fields& f) {
  const std::string unit = f.state({"initial", "", "at the start, with the unit that the state has"}, initial);
  f.stateRate({"rate", unit + "/s", "its change in time", true}, rate);
}

template <class S>
void State::assemble(Assembler<S>& a) const {
  a.state(a.signal(rate));
}

GAMUT_ASSEMBLE(State)

}  // namespace gamut
