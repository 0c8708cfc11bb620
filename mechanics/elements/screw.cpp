#include "mechanics/elements/screw.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/joint.hpp"

namespace gamut {
namespace {

/// Turns frame `to` about an axis u fixed in both frames, and slides it along that by `lead` [m/rad] times the angle β:
/// A(u, β), d = u h β, s = (u, u h).
template <class S>
class ScrewJoint final : public Joint<S> {
 public:
  ScrewJoint(Frame<S>& from, Frame<S>& to, Variable<S>& angle, S lead, const Axis& axis)
      : Joint<S>(from, to, {&angle}), angle_(angle), lead_(std::move(lead)), axis_(axis) {}

 private:
  Place<S> place() const override {
    return {Rotation<S>(axis_, angle_.position), axis_.template unit<S>() * S(lead_ * angle_.position)};
  }
  std::vector<Twist<S>> motions() const override {
    const Vector3<S> u = axis_.template unit<S>();
    return {{u, u * lead_}};
  }

  Variable<S>& angle_;
  S lead_;
  Axis axis_;
};

}  // namespace

void Screw::describe(Fields& f) {
  f.frame({"from", "", "the frame that carries the joint"}, from);
  f.movedFrame({"to", "", "the frame that turns and slides"}, to, from);
  f.jointAxis({"axis", "", "of both", true}, axis, from);
  f.number({"lead", "m", "how far it slides in one turn; below 0 for a left-handed thread", true}, lead);
  f.coordinate({"angle", "rad", "at the start"}, angle, Coordinate::angle, {"rate", "rad/s", "at the start"}, rate);
  f.movesAs({.steps = {{.turns = true, .slides = true, .axis = axis}}});
}

template <class S>
void Screw::assemble(Assembler<S>& a) const {
  const S turn = constant<S>(Interval(2.0) * pi());
  a.template add<ScrewJoint<S>>(a.frame(from), a.frame(to), a.variable("angle"), a.number(lead) / turn, axis);
}

GAMUT_ASSEMBLE(Screw)

}  // namespace gamut
