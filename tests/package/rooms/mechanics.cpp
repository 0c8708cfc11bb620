// Mechanics alone: a pendulum let go at 30 degrees, put together from the library's elements, and with an element of
// its own, made of the library's parts. It fails unless the acceleration, which is -9.81 / 0.5 * sin(30 degrees) =
// -9.81 rad/s², lies in the enclosures of both, assembled and recorded, and they are narrow.
#include <gamut/mechanics/assembly.hpp>
#include <gamut/mechanics/bodies.hpp>
#include <gamut/mechanics/elements/all.hpp>
#include <gamut/mechanics/joints.hpp>
#include <gamut/mechanics/model.hpp>
#include <gamut/mechanics/springs.hpp>
#include <gamut/scalars/evaluation/evaluate.hpp>

using namespace gamut;

struct Arm {
  static constexpr const char* type = "arm";
  static constexpr const char* summary = "a rod on a hinge with a spring that rests where it starts";
  std::string name, from, to;
  Expression length = 0.0, stiffness = 0.0, angle = 0.0, rate = 0.0;

  void describe(Fields& f) {
    f.frame({"from", "", "the frame that carries the hinge"}, from);
    f.movedFrame({"to", "", "the frame at the rod's end"}, to, from);
    f.number({"length", "m", "of the rod", true}, length);
    f.number({"stiffness", "N m/rad", "of the spring"}, stiffness);
    f.coordinate({"angle", "rad", "at the start"}, angle, Coordinate::angle, {"rate", "rad/s", "at the start"}, rate);
  }
  template <class S>
  void assemble(Assembler<S>& a) const {
    Frame<S>& turned = a.hiddenFrame();
    a.template add<RevoluteJoint<S>>(a.frame(from), turned, a.variable("angle"), axisX);
    const Vector3<S> rod(S(0.0), S(0.0), -a.number(length));
    a.template add<RigidLink<S>>(turned, a.frame(to), rod, a.rotation({}));
    a.template add<JointSpringDamper<S>>(a.variable("angle"), a.number(stiffness), a.number(angle), S(0.0));
  }
};

bool isRight(Mechanism& pendulum) {
  pendulum.setGravity({0.0, 0.0, Interval("-9.81")});
  Assembly<Interval> assembled(pendulum);
  const Interval direct = assembled.accelerations()[0];
  const Interval recorded = evaluate<Interval>(recordMotion(pendulum), assembled.initialState())[1];
  const auto isTight = [](const Interval& x) { return isSubset(Interval("-9.81"), x) && width(x) < 1e-12; };
  return isTight(direct) && isTight(recorded);
}

int main() {
  Mechanism ofElements;
  ofElements.addParameter("rod.length", 0.5, "m");
  ofElements.add(Revolute{"hinge", "inertial", "K1", axisX, pi() / 6.0, 0.0});
  ofElements.add(Link{"rod", "K1", "K2", {0.0, 0.0, Expression::named("rod.length", -1.0)}});
  ofElements.add(Mass{"bob", "K2", Interval("0.1")});

  Mechanism own;
  own.add(Arm{"arm", "inertial", "end", 0.5, 3.0, pi() / 6.0, 0.0});
  own.add(Mass{"bob", "end", Interval("0.1")});
  return isRight(ofElements) && isRight(own) ? 0 : 1;
}
