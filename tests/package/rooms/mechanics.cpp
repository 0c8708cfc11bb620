// Mechanics alone: a pendulum let go at 30 degrees, assembled, recorded, and made by hand. It fails unless its
// acceleration, which is -9.81 / 0.5 * sin(30 degrees) = -9.81 rad/s², lies in all enclosures and they are narrow.
#include <gamut/mechanics/assembly.hpp>
#include <gamut/mechanics/bodies.hpp>
#include <gamut/mechanics/elements/all.hpp>
#include <gamut/mechanics/joints.hpp>
#include <gamut/mechanics/model.hpp>
#include <gamut/mechanics/springs.hpp>
#include <gamut/scalars/evaluation/evaluate.hpp>

using namespace gamut;

int main() {
  Mechanism pendulum;
  pendulum.addParameter("rod.length", 0.5, "m");
  pendulum.add(Revolute{"hinge", "inertial", "K1", axisX, pi() / 6.0, 0.0});
  pendulum.add(Link{"rod", "K1", "K2", {0.0, 0.0, Expression::named("rod.length", -1.0)}});
  pendulum.add(Mass{"bob", "K2", Interval("0.1")});
  pendulum.setGravity({0.0, 0.0, Interval("-9.81")});

  Assembly<Interval> assembled(pendulum);
  const Interval direct = assembled.accelerations()[0];
  const Interval recorded = evaluate<Interval>(recordMotion(pendulum), assembled.initialState())[1];
  Frame<Interval> ground, arm, end;
  Variable<Interval> angle;
  RevoluteJoint<Interval> hinge(ground, arm, angle, axisX);
  RigidLink<Interval> rod(arm, end, {0.0, 0.0, -0.5});
  MassElement<Interval> bob(end, Interval("0.1"));
  JointSpringDamper<Interval> slack(angle, 0.0, 0.0, 0.0);
  Chain<Interval> chain;
  chain << hinge << rod << bob << slack;
  System<Interval> system({angle}, chain, ground, {0.0, 0.0, Interval("-9.81")});
  angle.position = pi() / 6.0;
  const Interval byHand = system.accelerations()[0];

  const auto isRight = [](const Interval& x) { return isSubset(Interval("-9.81"), x) && width(x) < 1e-13; };
  return isRight(direct) && isRight(recorded) && isRight(byHand) ? 0 : 1;
}
