#include "mechanics/elements/box.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/description/orientation.hpp"
#include "mechanics/elements/shape_frame.hpp"

namespace gamut {

void Cuboid::describe(Fields& f) {
  describeShape(f, name, at);
  f.numbers({"size", "m", "of its edges along x, y and z", true}, size, components, 3);
  f.vector({"centre", "m", "in `at`; its origin unless given"}, centre);
  f.rotations({"rotation", "rad", "of its edges against the axes of `at`: " + orientationForms}, rotation);
  f.drawsShape({0.0, 0.0, axisZ, size});
}

template <class S>
void Cuboid::assemble(Assembler<S>& a) const {
  Outline<S> outline{ShapeCore::cuboid};
  outline.halves = a.vector(size) * S(0.5);
  a.template add<ShapeFrame<S>>(a.frame(at), a.frame(name), Place<S>{a.rotation(rotation), a.vector(centre)}, outline);
}

std::vector<Fault> Cuboid::faults(const RangeOf& rangeOf) const {
  std::vector<Fault> found;
  for (const Expression& length : size)
    if (found.empty() && rangeOf(length).lower() < 0)
      found.push_back({"size", "an edge of '" + name + "' is negative", "edges of at least 0 m"});
  return found;
}

GAMUT_ASSEMBLE(Cuboid)

}  // namespace gamut
