// A gliding joint, to where the wheel touches the plane, then hinges for lean and turn with the tread and the rim
// between them.
#include "mechanics/elements/rolling_wheel.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/elements/touching.hpp"
#include "mechanics/joints.hpp"

namespace gamut {
namespace {

/// How a wheel that rolls moves the point where it touches a plane, by its lean θ about x and its turn φ about its axle
/// y. With ρ the radius to which its tread is crowned, and R that of the circle about which it is, v + ω × (touching −
/// centre) = 0, v the velocity of the centre, says
///
///   along = (R + ρ cos θ) φ̇     across = −ρ θ̇
///
/// Ahead of the joints.
template <class S>
class WheelRolling final : public Gearing<S> {
 public:
  /// `circle`: R, `crown`: ρ [m].
  WheelRolling(Variable<S>& lean, Variable<S>& angle, S circle, S crown)
      : lean_(lean), angle_(angle), circle_(std::move(circle)), crown_(std::move(crown)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    using std::cos, std::sin;
    if (level != MotionLevel::acceleration) {
      reach_ = circle_ + crown_ * S(cos(lean_.position));
      slope_ = crown_ * S(sin(lean_.position));
    }
    if (level == MotionLevel::position) return;
    along_.acceleration = reach_ * angle_.acceleration;
    across_.acceleration = -(crown_ * lean_.acceleration);
    if (level == MotionLevel::acceleration) return;
    along_.rate = reach_ * angle_.rate;
    across_.rate = -(crown_ * lean_.rate);
    along_.acceleration = along_.acceleration - slope_ * lean_.rate * angle_.rate;
  }

  void doForce(ForceKind = ForceKind::all) override {
    angle_.force += reach_ * along_.force;
    lean_.force -= crown_ * across_.force;
  }

  Speed<S>& along() { return along_; }
  Speed<S>& across() { return across_; }

 private:
  Variable<S>& lean_;
  Variable<S>& angle_;
  S circle_, crown_;
  S reach_ = S(0.0), slope_ = S(0.0);  // R + ρ cos θ, ρ sin θ
  Speed<S> along_, across_;
};

}  // namespace

void RollingWheel::describe(Fields& f) {
  f.frame({"from", "", "the frame whose x and y span the plane"}, from);
  f.movedFrame({"to", "", "the frame of the wheel"}, to, from);
  f.number({"radius", "m", "of the wheel, from its centre to the middle of its tread", true}, radius);
  f.number({"crown_radius", "m",
            "to which its tread is rounded, seen from ahead; less than that of the wheel; 0, an edge, unless given"},
           crownRadius);
  f.coordinate({"heading", "rad", "at the start: from x of `from` to where the wheel rolls"}, heading,
               Coordinate::angle, {"heading_rate", "rad/s", "at the start"}, headingRate);
  f.coordinate({"lean", "rad", "at the start: about the direction in which it rolls, above 0 to its right"}, lean,
               Coordinate::angle, {"lean_rate", "rad/s", "at the start"}, leanRate);
  f.coordinate({"angle", "rad", "at the start: about its axle, above 0 forwards"}, angle, Coordinate::angle,
               {"rate", "rad/s", "at the start"}, angleRate);
  describePlace(f, "where it touches the plane", x, y);
  describeTouching(f);
  f.drawsWheel(axisY, radius);
  f.drawsPlane({from}, axisZ, {to}, 0.0);
  f.measureSolved({"longitudinal_force", "N", "of the plane, in the direction in which the wheel rolls"});
  f.measureSolved({"lateral_force", "N", "of the plane, to the left of it"});
}

std::vector<Fault> RollingWheel::faults(const RangeOf& rangeOf) const {
  const Interval wheel = rangeOf(radius), crown = rangeOf(crownRadius);
  if (wheel.lower() <= 0) return {{"radius", "the radius of '" + name + "' is not positive", "a radius above 0 m"}};
  if (crown.lower() < 0) return {{"crown_radius", "the crown radius of '" + name + "' is negative", "at least 0 m"}};
  if (crown.upper() >= wheel.lower())
    return {{"crown_radius", "the crown radius of '" + name + "' may be as great as its radius",
             "a smaller one, or a rolling-ball", true}};
  if (!certainlyLess(abs(rangeOf(lean)), halfPi()))
    return {{"lean", "the wheel '" + name + "' may lie flat, or under its plane, at the start",
             "a lean of less than 90 deg to either side", true}};
  return {};
}

template <class S>
void RollingWheel::assemble(Assembler<S>& a) const {
  const S crown = a.number(crownRadius), circle = a.number(radius) - crown;
  Variable<S>&leaning = a.variable("lean"), &turning = a.variable("angle");
  auto& wheel = a.template add<WheelRolling<S>>(leaning, turning, circle, crown);
  const Gliding<S> gliding{&a.variable("heading"), &wheel.along(), &wheel.across()};
  Frame<S>&touching = a.hiddenFrame(), &crownCentre = a.hiddenFrame(), &leant = a.hiddenFrame(), &hub = a.hiddenFrame();
  a.template add<GlidingJoint<S>>(a.frame(from), touching, gliding, placeOf(a, gliding));
  a.template add<RigidLink<S>>(touching, crownCentre, Vector3<S>(S(0.0), S(0.0), crown));
  a.template add<RevoluteJoint<S>>(crownCentre, leant, leaning, axisX);
  a.template add<RigidLink<S>>(leant, hub, Vector3<S>(S(0.0), S(0.0), circle));
  a.template add<RevoluteJoint<S>>(hub, a.frame(to), turning, axisY);
  measureTouching(a, touching);
  a.measureSolved("longitudinal_force", [&touching] { return S(-touching.f[0]); });
  a.measureSolved("lateral_force", [&touching] { return S(-touching.f[1]); });
}

GAMUT_ASSEMBLE(RollingWheel)

}  // namespace gamut
