#include "mechanics/elements/rigid_stop.hpp"

#include "mechanics/assembler.hpp"

namespace gamut {

void RigidStop::describe(Fields& f) {
  const std::string unit =
      unitOf(f.struckCoordinate({"joint", "", "the joint, or one of its coordinates"}, joint, start));
  f.number({"at", unit, "where the joint strikes it", true}, at);
  f.number({"restitution", "1", "speed behind an impact by that ahead of it: above 0, and at most 1", true},
           restitution);
  f.choice({"end", "", "`\"lower\"` (unless given), and the joint stays above `at`, or `\"upper\"`"}, end,
           {"lower", "upper"});
  f.measure({"gap", unit, "how far the joint is from it"});
}

template <class S>
void RigidStop::assemble(Assembler<S>& a) const {
  const bool isUpper = end == "upper";
  const S place = a.number(at);
  const Variable<S>& q = a.coordinate(joint);
  a.endTravel({joint, place, a.number(restitution), isUpper, isUpper != start.isRising});
  a.measure("gap", [&q, place, isUpper] { return isUpper ? S(place - q.position) : S(q.position - place); });
}

std::vector<Fault> RigidStop::faults(const RangeOf& rangeOf) const {
  std::vector<Fault> found;
  const Interval e = rangeOf(restitution), rate = rangeOf(start.rate);
  if (e.lower() <= 0 || e.upper() > 1)
    found.push_back({"restitution", "the restitution of '" + name + "' is not above 0 and at most 1",
                     "a number such as 0.8; an end without rebound may be an elastic one, `joint-stop`", true});
  const Interval gap = end == "upper" ? rangeOf(at) - rangeOf(start.position) : rangeOf(start.position) - rangeOf(at);
  if (gap.lower() <= 0)
    found.push_back(
        {"at", "'" + joint + "' starts at '" + name + "', or beyond it", "a start inside its travel", true});
  if (start.isRising ? rate.lower() < 0 : rate.upper() > 0)
    found.push_back({"joint", "'" + joint + "' may start towards '" + name + "' as well as away from it",
                     "a rate at the start that is above 0, or below it, whatever the uncertain quantities are", true});
  return found;
}

GAMUT_ASSEMBLE(RigidStop)

}  // namespace gamut
