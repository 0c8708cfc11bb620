// Rows of Closing: a ball's three directions, or those across an axis, or the axis itself; and axes at right angles.
#include "mechanics/elements/closure.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "mechanics/assembler.hpp"
#include "mechanics/closing.hpp"
#include "mechanics/elements/across.hpp"

namespace gamut {
namespace {

/// What a closure holds: directions along which its points stay together, `along` and `across` its axis, and whether
/// the axes stay parallel.
struct Held {
  const char* as;
  bool along, across, parallel;
  int turns, slides;  // as it is seen
};

constexpr std::array held = {Held{"ball", true, true, false, 3, 0}, Held{"hinge", true, true, true, 1, 0},
                             Held{"pin", false, true, false, 1, 0}, Held{"cylinder", false, true, true, 1, 1},
                             Held{"plane", true, false, false, 3, 2}};

const Held& heldAs(const std::string& as) { return *std::ranges::find(held, as, &Held::as); }

void describeEnds(Fields& f, std::string& from, std::string& to, ExpressionVector& fromPoint,
                  ExpressionVector& toPoint) {
  f.frame({"from", "", "a frame"}, from);
  f.otherFrame({"to", "", "the other frame"}, to, from);
  f.vector({"from_point", "m", "a point in `from`"}, fromPoint);
  f.vector({"to_point", "m", "a point in `to`"}, toPoint);
  f.drawsLink({from}, {from, fromPoint});
  f.drawsLink({to}, {to, toPoint});
}

constexpr const char* dependentMeaning =
    "a list of the coordinates that follow from the others, such as `[\"coupler\", \"rocker\"]`: those of the "
    "loop that stand last, without an initial rate, and hold it firmly unless given. Their initial values are where "
    "the "
    "closed position is looked for";

constexpr const char* redundantMeaning =
    "so many of its rows are assumed to follow from all others, for the numbers' sake, as in linkages that move though "
    "they hold more than leaves them free: which are left out is found where it starts, and told; samples have to keep "
    "them. 0 unless given";

}  // namespace

HeldRows Closure::wanted() const {
  const Held& holds = heldAs(as);
  const bool hasAxis = !(holds.along && holds.across) || holds.parallel;
  return {holds.along, holds.across, holds.parallel, hasAxis ? std::optional(axis) : std::nullopt, toAxis};
}

void Closure::describe(Fields& f) {
  describeEnds(f, from, to, fromPoint, toPoint);
  std::vector<std::string> words;
  for (const Held& each : held) words.emplace_back(each.as);
  f.choice(
      {"as", "",
       "`ball`: the points stay together; `hinge`: the axes too; `pin`: the point of `to` stays on the axis "
       "through that of `from`, as in planar loops a hinge is; `cylinder`: and the axes stay together; `plane`: it "
       "stays in the plane across the axis. `ball` unless given"},
      as, words);
  f.jointAxis({"axis", "", "in `from`; `\"z\"` unless given"}, axis, from);
  f.drawsJoint({to, toPoint}, heldAs(as).turns, heldAs(as).slides);
  f.axis({"to_axis", "", "of a `hinge` and a `cylinder`: the same axis in `to`; `\"z\"` unless given"}, toAxis);
  f.closesBetween({from, fromPoint}, {to, toPoint}, wanted(), left);
  f.count({"redundant", "", redundantMeaning}, redundant, rows().count());
  f.dependentCoordinates({"dependent", "", dependentMeaning}, dependent,
                         {from, to, rows().count() - redundant, redundant});
  for (const char* component : components)
    f.measureSolved({std::string("force.") + component, "N", "what it does to `to`, in inertial axes"});
  for (const char* component : components)
    f.measureSolved({std::string("moment.") + component, "N m", "the same about the point of `to`"});
}

std::vector<Fault> Closure::faults(const RangeOf& /*rangeOf*/) const {
  if (heldAs(as).parallel || toAxis.direction() == axisZ.direction()) return {};
  return {{"to_axis", "'" + name + "' is a " + as + ", which holds no axis of `to`",
           "none, or `hinge` or `cylinder`, which hold the axes together"}};
}

template <class S>
void Closure::assemble(Assembler<S>& a) const {
  const HeldRows holds = rows();
  const Axis along = holds.axis.value_or(axis);
  const std::array<Vector3<S>, 2> besides = across<S>(along);
  std::vector<Vector3<S>> directions;
  if (holds.along) directions.push_back(along.unit<S>());
  if (holds.across) directions.insert(directions.end(), besides.begin(), besides.end());
  std::vector<typename Closing<S>::RightAngle> rightAngles;
  if (holds.parallel)
    for (const Vector3<S>& each : besides) rightAngles.emplace_back(each, toAxis.unit<S>());
  const Closing<S>* closing = nullptr;  // where all holds anyway
  if (holds.count() > 0) {
    auto& added = a.template add<Closing<S>>(CarriedPoint<S>{&a.frame(from), a.vector(fromPoint)},
                                             CarriedPoint<S>{&a.frame(to), a.vector(toPoint)}, std::move(directions),
                                             std::move(rightAngles), along);
    a.closes(added);
    closing = &added;
  }
  const auto bears = [closing] { return closing != nullptr && !closing->multipliers().empty(); };
  for (int i = 0; i < 3; ++i) {
    a.measureSolved(std::string("force.") + components[i],
                    [closing, bears, i] { return bears() ? S(closing->force()[i]) : S(0.0); });
    a.measureSolved(std::string("moment.") + components[i],
                    [closing, bears, i] { return bears() ? S(closing->moment()[i]) : S(0.0); });
  }
}

GAMUT_ASSEMBLE(Closure)

void RodClosure::describe(Fields& f) {
  describeEnds(f, from, to, fromPoint, toPoint);
  f.number({"length", "m", "the distance of the points", true}, length);
  f.drawsLink({from, fromPoint}, {to, toPoint});
  for (const FixedPoint& end : {FixedPoint{from, fromPoint}, FixedPoint{to, toPoint}}) f.drawsJoint(end, 3, 0);
  f.count({"redundant", "", redundantMeaning}, redundant, 1);
  f.dependentCoordinates({"dependent", "", dependentMeaning}, dependent, {from, to, 1 - redundant, redundant});
  f.measureSolved({"force", "N", "by which it pushes its ends apart"});
}

std::vector<Fault> RodClosure::faults(const RangeOf& rangeOf) const {
  if (rangeOf(length).lower() > 0) return {};
  return {{"length", "the length of '" + name + "' is not above 0 m", "a length above 0 m", true}};
}

template <class S>
void RodClosure::assemble(Assembler<S>& a) const {
  auto& rod = a.template add<Rod<S>>(CarriedPoint<S>{&a.frame(from), a.vector(fromPoint)},
                                     CarriedPoint<S>{&a.frame(to), a.vector(toPoint)}, a.number(length));
  a.closes(rod);
  a.measureSolved("force", [&rod] { return rod.multipliers().empty() ? S(0.0) : rod.push(); });
}

GAMUT_ASSEMBLE(RodClosure)

}  // namespace gamut
