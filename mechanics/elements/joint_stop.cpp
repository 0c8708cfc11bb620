#include "mechanics/elements/joint_stop.hpp"

#include "mechanics/elements/coordinate_load.hpp"

namespace gamut {

void JointStop::describe(Fields& f) {
  const Coordinate kind = f.coordinateOf({"joint", "", "the joint, or one of its coordinates"}, joint);
  const std::string unit = unitOf(kind);
  f.number({"lower", unit, "end of the travel", true}, lower);
  f.number({"upper", unit, "end of the travel", true}, upper);
  f.number({"stiffness", std::string(forceUnitOf(kind)) + "/" + unit, "", true}, stiffness);
  f.number({"damping", "s/" + unit, "of the stiffness, by the speed of entering"}, damping);
  describeCoordinateLoad(f, kind);
}

template <class S>
void JointStop::assemble(Assembler<S>& a) const {
  const S first = a.number(lower), last = a.number(upper), k = a.number(stiffness), d = a.number(damping);
  addCoordinateLoad(a, joint, [first, last, k, d](const Variable<S>& q) {
    using std::max;
    const S below = max(S(first - q.position), S(0.0)), above = max(S(q.position - last), S(0.0));
    return S(k * (below * (S(1.0) - d * q.rate) - above * (S(1.0) + d * q.rate)));
  });
}

std::vector<Fault> JointStop::faults(const RangeOf& rangeOf) const {
  std::vector<Fault> found;
  if (!(rangeOf(lower).upper() < rangeOf(upper).lower()))
    found.push_back({"upper", "the upper stop of '" + name + "' is not above the lower one", "a place above `lower`"});
  if (rangeOf(stiffness).lower() < 0)
    found.push_back({"stiffness", "the stiffness of '" + name + "' is negative", "at least 0: stops push back"});
  if (rangeOf(damping).lower() < 0)
    found.push_back({"damping", "the damping of '" + name + "' is negative", "at least 0"});
  return found;
}

GAMUT_ASSEMBLE(JointStop)

}  // namespace gamut
