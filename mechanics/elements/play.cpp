#include "mechanics/elements/play.hpp"

#include <cmath>
#include <utility>

#include "mechanics/assembler.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/elements/across.hpp"

namespace gamut {
namespace {

Fault noClearance(const std::string& name) {
  return {"clearance", "the clearance of '" + name + "' is negative", "at least 0 m", true};
}

/// A coordinate axis across both: the third.
Axis thirdAxis(const Axis& first, const Axis& second) {
  const auto a = first.direction(), b = second.direction();  // of 0, 1 and -1
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

void Play::describe(Fields& f) {
  f.frame({"from", "", "the frame of the hole, or of the pin"}, from);
  f.movedFrame({"to", "", "the frame of the other"}, to, from);
  f.axis({"axis", "", "of both; `\"z\"` unless given"}, axis);
  f.number({"clearance", "m", "the radial one, half the difference of their diameters", true}, clearance);
  f.number({"eccentricity", "1", "how far off, from 0 to 1, of the clearance"}, eccentricity);
  f.number({"direction", "rad",
            "about the axis, from the coordinate axis that follows it cyclically (of z: x); of a skew axis u from u × "
            "e, e the coordinate axis that is most across it"},
           direction);
  f.number({"axial", "m", "how far off along the axis"}, axial);
  f.drawsPlay(clearance);
}

template <class S>
void Play::assemble(Assembler<S>& a) const {
  using std::cos, std::sin;
  const auto [first, second] = across<S>(axis);
  const S off = a.number(clearance) * a.number(eccentricity), angle = a.number(direction);
  const Vector3<S> offset =
      first * S(off * cos(angle)) + second * S(S(axis.sign()) * (off * sin(angle))) + axis.unit<S>() * a.number(axial);
  a.template add<RigidLink<S>>(a.frame(from), a.frame(to), offset);
}

std::vector<Fault> Play::faults(const RangeOf& rangeOf) const {
  std::vector<Fault> found;
  if (rangeOf(clearance).lower() < 0) found.push_back(noClearance(name));
  if (!isSubset(rangeOf(eccentricity), Interval(0.0, 1.0)))
    found.push_back({"eccentricity", "the eccentricity of '" + name + "' is not from 0 to 1",
                     "0 where the axes meet, 1 where the parts touch", true});
  return found;
}

GAMUT_ASSEMBLE(Play)

void GuidePlay::describe(Fields& f) {
  f.frame({"from", "", "the frame of the guide"}, from);
  f.movedFrame({"to", "", "the frame of the slider"}, to, from);
  f.axis({"axis", "", "of the guide: `\"x\"` (unless given), `\"y\"`, `\"z\"`, or one with a minus sign"}, axis);
  f.axis({"across", "", "another one of these: in which the slider has play; `\"y\"` unless given"}, across);
  f.number({"length", "m", "of the slider, between its ends", true}, length);
  f.number({"clearance", "m", "how far its ends may lie off, to either side", true}, clearance);
  f.number({"front", "1", "how far its end in the direction of `axis` lies off, from -1 to 1, of the clearance"},
           front);
  f.number({"rear", "1", "likewise, its other end"}, rear);
  f.drawsPlay(clearance);
}

template <class S>
void GuidePlay::assemble(Assembler<S>& a) const {
  using std::asin;
  const S c = a.number(clearance), ahead = c * a.number(front), behind = c * a.number(rear);
  const S angle = asin(S((ahead - behind) / a.number(length)));
  a.template add<RigidLink<S>>(a.frame(from), a.frame(to), across.unit<S>() * S(S(0.5) * (ahead + behind)),
                               Rotation<S>(thirdAxis(axis, across), angle));
}

std::vector<Fault> GuidePlay::faults(const RangeOf& rangeOf) const {
  std::vector<Fault> found;
  if (!axis.isAligned() || !across.isAligned() || axis.index() == across.index())
    found.push_back({"across", "the directions of '" + name + "' are no two coordinate axes",
                     "two of \"x\", \"y\", \"z\"; a weld ahead of it turns them", true});
  if (rangeOf(clearance).lower() < 0) found.push_back(noClearance(name));
  if (!((rangeOf(length) - 2.0 * rangeOf(clearance)).lower() >= 0) || !(rangeOf(length).lower() > 0))
    found.push_back(
        {"length", "the length of '" + name + "' is less than twice its clearance", "a longer slider", true});
  for (const auto& [key, number] : {std::pair("front", &front), std::pair("rear", &rear)})
    if (!isSubset(rangeOf(*number), Interval(-1.0, 1.0)))
      found.push_back({key, "the play `" + std::string(key) + "` of '" + name + "' is not from -1 to 1",
                       "1 where that end touches the guide", true});
  return found;
}

GAMUT_ASSEMBLE(GuidePlay)

}  // namespace gamut
