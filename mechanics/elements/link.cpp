#include "mechanics/elements/link.hpp"

#include <algorithm>

#include "mechanics/assembler.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/description/orientation.hpp"

namespace gamut {

void Link::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the link"}, from);
  f.movedFrame({"to", "", "the frame at its end"}, to, from);
  f.vector({"vector", "m", "the place of `to` in `from`", true}, vector);
  f.rotations({"rotation", "rad", "of `to` against `from`: " + orientationForms}, rotation);
  f.movesAs({vector, rotation});
}

template <class S>
void Link::assemble(Assembler<S>& a) const {
  a.template add<RigidLink<S>>(a.frame(from), a.frame(to), a.vector(vector), a.rotation(rotation));
}

std::vector<Fault> Link::doubts(const RangeOf& nominal, const RangeOf& range) const {
  const auto mayBeZero = [](const RangeOf& rangeOf) {
    return [&](const Expression& component) { return contains(rangeOf(component), 0); };
  };
  if (std::ranges::all_of(vector, mayBeZero(nominal)) || !std::ranges::all_of(vector, mayBeZero(range))) return {};
  return {{"vector",
           "the interval holds a value with which the link '" + name +
               "' has no length; where the motion is not determined there, nothing can be guaranteed",
           "a length"}};
}

GAMUT_ASSEMBLE(Link)

}  // namespace gamut
