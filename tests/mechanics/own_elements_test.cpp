// A user's own joint whose positions are no integrals of its speeds: a hinge by the cosine and the sine of its angle.
#include <gtest/gtest.h>

#include <cmath>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

/// About z, by the speed u: ċ = −s u, ṡ = c u.
template <class S>
class WheelTransmission final : public Transmission<S> {
 public:
  WheelTransmission(Frame<S>& from, Frame<S>& to, const S& c, const S& s, Speed<S>& u)
      : Transmission<S>(from, to), c_(c), s_(s), u_(u) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    const Frame<S>& k = this->from_;
    Frame<S>& moved = this->to_;
    const Matrix3<S> a = rotation(), back = a.transpose();
    moved.R = k.R * a;
    moved.r = back * k.r;
    if (level == MotionLevel::position) return;
    moved.omegaDot = back * k.omegaDot + axis() * u_.acceleration;
    moved.a = back * k.a;
    if (level == MotionLevel::acceleration) return;
    const Vector3<S> carried = back * k.omega, own = axis() * u_.rate;
    moved.omega = carried + own;
    moved.v = back * k.v;
    moved.omegaDot += carried.cross(own);
  }
  void doForce(ForceKind = ForceKind::all) override {
    this->from_.f += rotation() * this->to_.f;
    this->from_.tau += rotation() * this->to_.tau;
    u_.force += this->to_.tau[2];
  }
  std::vector<Speed<S>*> speeds() const override { return {&u_}; }
  using Transmission<S>::inFrom;
  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override {
    const Vector3<S> turning = axis() * u_.rate;
    return {rotation() * point.position, rotation() * Vector3<S>(point.velocity + turning.cross(point.position))};
  }

 private:
  static Vector3<S> axis() { return {S(0.0), S(0.0), S(1.0)}; }
  Matrix3<S> rotation() const {
    Matrix3<S> a;
    a << c_, -s_, S(0.0), s_, c_, S(0.0), S(0.0), S(0.0), S(1.0);
    return a;
  }

  const S &c_, &s_;
  Speed<S>& u_;
};

struct Wheel {
  static constexpr const char* type = "wheel";
  static constexpr const char* summary = "a hinge by the cosine and the sine of its angle";
  std::string name, from, to;
  Expression cosine = 1.0, sine = 0.0, rate = 0.0;

  void describe(Fields& f) {
    f.frame({"from", "", "the frame that carries the joint"}, from);
    f.movedFrame({"to", "", "the frame that turns"}, to, from);
    f.position({"cosine", "1", "at the start"}, cosine);
    f.position({"sine", "1", "at the start"}, sine);
    f.speed({"rate", "rad/s", "at the start"}, rate);
  }
  template <class S>
  void assemble(Assembler<S>& a) const {
    Speed<S>& u = a.speed("rate");
    const auto joint = std::make_shared<std::array<S*, 2>>();
    (*joint)[0] = &a.position("cosine", [joint, &u] { return S(-(*(*joint)[1] * u.rate)); });
    (*joint)[1] = &a.position("sine", [joint, &u] { return S(*(*joint)[0] * u.rate); });
    a.template add<WheelTransmission<S>>(a.frame(from), a.frame(to), *(*joint)[0], *(*joint)[1], u);
  }
};

/// Three wheels, one behind the other, or as many hinges.
template <class Joint>
Mechanism threeOf() {
  Mechanism m;
  std::string from = Mechanism::inertialFrame;
  for (const std::string number : {"0", "1", "2"}) {
    Joint joint{"joint" + number, from, "K" + number};
    if constexpr (std::is_same_v<Joint, Revolute>) joint.axis = axisZ;
    m.add(joint);
    m.add(Mass{"body" + number, "K" + number, 1.3, {0.1, -0.2, 0.4}, {0.4, 0.5, 0.3, 0.02, 0.05, -0.03}});
    m.add(Link{"link" + number, "K" + number, "E" + number, {0.5, 0.1, 0.0}, {{axisX, 0, 0.4}}});
    from = "E" + number;
  }
  m.setGravity({0.3, 0.7, -9.81});
  return m;
}

/// As a hinge moves, and c² + s² is kept.
TEST(OwnJoint, MovesAsTheHingeThatItIs) {
  const Mechanism wheels = threeOf<Wheel>(), hinges = threeOf<Revolute>();
  EXPECT_EQ(wheels.positions(), 6U);
  EXPECT_EQ(wheels.degreesOfFreedom(), 3);
  testing::RandomStates states;
  for (const Formulation formulation : {Formulation::sparse, Formulation::articulated}) {
    Evaluator<double> motion(recordMotion(wheels, {}, formulation)), truth(recordMotion(hinges, {}, formulation));
    for (int round = 0; round < 50; ++round) {
      const std::vector<double> x = states(6, 1.4);
      std::vector<double> y;
      for (std::size_t i = 0; i < 3; ++i) y.insert(y.end(), {std::cos(x[i]), std::sin(x[i])});
      y.insert(y.end(), x.begin() + 3, x.end());
      const std::vector<double> dx = truth(0.0, x), dy = motion(0.0, y);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(dy[6 + i], dx[3 + i], 1e-11 * (1 + std::abs(dx[3 + i])));
        EXPECT_NEAR(dy[2 * i] * y[2 * i] + dy[2 * i + 1] * y[2 * i + 1], 0, 1e-15);
        EXPECT_NEAR(dy[2 * i + 1], y[2 * i] * dx[i], 1e-15);
      }
    }
  }
}

TEST(OwnJoint, ServesEveryScalar) {
  const Mechanism m = threeOf<Wheel>();
  const std::vector<double> x = {0.8, 0.6, 1.0, 0.0, 0.6, -0.8, 1.0, -2.0, 0.5};
  const auto rates = [&]<class S>(S /*scalar*/) {
    Assembly<S> assembly(m);
    assembly.setState(std::vector<S>(x.begin(), x.end()));
    return assembly.rates();
  };
  const std::vector<double> a = rates(0.0);
  const std::vector<Interval> b = rates(Interval(0.0));
  const std::vector<Samples> c = rates(Samples(0.0));
  const std::vector<Fuzzy> d = rates(Fuzzy(0.0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(midpoint(b[i]), a[i], 1e-12);
    EXPECT_LE(width(b[i]), 1e-11);
    EXPECT_NEAR(c[i][0], a[i], 1e-12);
    EXPECT_NEAR(midpoint(d[i].cut(0.0)), a[i], 1e-12);
  }
}

}  // namespace
}  // namespace gamut
