// A user's own joint whose positions are no integrals of its speeds: a ball joint by a unit quaternion and body rates.
#include <gtest/gtest.h>

#include <cmath>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

/// With A the rotation of e = (e0, e⃗), R' = R A, r' = Aᵀ r, ω' = Aᵀ ω + u, ω̇' = Aᵀ ω̇ + Aᵀ ω × u + u̇, Q = τ'; and
/// ė = ½ e ∘ (0, u).
template <class S>
class BallTransmission final : public Transmission<S> {
 public:
  BallTransmission(Frame<S>& from, Frame<S>& to, std::array<S*, 4> e, std::array<Speed<S>*, 3> u)
      : Transmission<S>(from, to), e_(e), u_(u) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    const Frame<S>& k = this->from_;
    Frame<S>& moved = this->to_;
    const Matrix3<S> a = rotation(), back = a.transpose();
    moved.R = k.R * a;
    moved.r = back * k.r;
    if (level == MotionLevel::position) return;
    const Vector3<S> acceleration(u_[0]->acceleration, u_[1]->acceleration, u_[2]->acceleration);
    moved.omegaDot = back * k.omegaDot + acceleration;
    moved.a = back * k.a;
    if (level == MotionLevel::acceleration) return;
    const Vector3<S> carried = back * k.omega;
    moved.omega = carried + rate();
    moved.v = back * k.v;
    moved.omegaDot += carried.cross(rate());
  }
  void doForce(ForceKind = ForceKind::all) override {
    const Matrix3<S> a = rotation();
    this->from_.f += a * this->to_.f;
    this->from_.tau += a * this->to_.tau;
    for (int i = 0; i < 3; ++i) u_[static_cast<std::size_t>(i)]->force += this->to_.tau[i];
  }
  std::vector<Speed<S>*> speeds() const override { return {u_.begin(), u_.end()}; }
  using Transmission<S>::inFrom;
  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override {
    const Matrix3<S> a = rotation();
    return {a * point.position, a * Vector3<S>(point.velocity + rate().cross(point.position))};
  }

  S positionRate(int i) const {
    const S &w = *e_[0], &x = *e_[1], &y = *e_[2], &z = *e_[3];
    const Vector3<S> u = rate();
    const S twice = i == 0   ? S(-(x * u[0]) - y * u[1] - z * u[2])
                    : i == 1 ? S(w * u[0] + y * u[2] - z * u[1])
                    : i == 2 ? S(w * u[1] + z * u[0] - x * u[2])
                             : S(w * u[2] + x * u[1] - y * u[0]);
    return S(0.5) * twice;
  }

 private:
  Vector3<S> rate() const { return {u_[0]->rate, u_[1]->rate, u_[2]->rate}; }
  Matrix3<S> rotation() const {
    const S &w = *e_[0], &x = *e_[1], &y = *e_[2], &z = *e_[3];
    const S two(2.0), one(1.0);
    Matrix3<S> a;
    a << one - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y),  //
        two * (x * y + w * z), one - two * (x * x + z * z), two * (y * z - w * x),   //
        two * (x * z - w * y), two * (y * z + w * x), one - two * (x * x + y * y);
    return a;
  }

  std::array<S*, 4> e_;
  std::array<Speed<S>*, 3> u_;
};

struct Ball {
  static constexpr const char* type = "ball";
  static constexpr const char* summary = "a ball joint";
  std::string name, from, to;
  std::array<Expression, 4> quaternion = {1.0, 0.0, 0.0, 0.0};
  ExpressionVector rate = {0.0, 0.0, 0.0};

  static std::string positionKey(int i) { return "e" + std::to_string(i); }
  static std::string rateKey(int i) { return std::string("rate.") + components[static_cast<std::size_t>(i)]; }

  void describe(Fields& f) {
    f.frame({"from", "", "the frame that carries the joint"}, from);
    f.movedFrame({"to", "", "the frame that turns"}, to, from);
    for (int i = 0; i < 4; ++i)
      f.position({positionKey(i), "1", "at the start"}, quaternion[static_cast<std::size_t>(i)]);
    for (int i = 0; i < 3; ++i)
      f.speed({rateKey(i), "rad/s", "in the axes of `to`"}, rate[static_cast<std::size_t>(i)]);
  }
  template <class S>
  void assemble(Assembler<S>& a) const {
    std::array<S*, 4> e;
    std::array<Speed<S>*, 3> u;
    const auto joint = std::make_shared<BallTransmission<S>*>();
    for (int i = 0; i < 4; ++i)
      e[static_cast<std::size_t>(i)] = &a.position(positionKey(i), [joint, i] { return (*joint)->positionRate(i); });
    for (int i = 0; i < 3; ++i) u[static_cast<std::size_t>(i)] = &a.speed(rateKey(i));
    *joint = &a.template add<BallTransmission<S>>(a.frame(from), a.frame(to), e, u);
  }
};

Mechanism top() {
  Mechanism m;
  m.add(Ball{"ball", "inertial", "A"});
  m.add(Mass{"body", "A", 1.3, {0.1, -0.2, 0.4}, {0.4, 0.5, 0.3, 0.02, 0.05, -0.03}});
  m.setGravity({0.3, 0.7, -9.81});
  return m;
}

/// J u̇ + u × J u = c × m Aᵀ g about the fixed point, and |e| is kept.
TEST(BallJoint, OfAUserFollowsEulersEquation) {
  Matrix3<double> theta;
  theta << 0.4, 0.02, -0.03, 0.02, 0.5, 0.05, -0.03, 0.05, 0.3;
  const Vector3<double> c(0.1, -0.2, 0.4), g(0.3, 0.7, -9.81);
  const double mass = 1.3;
  const Matrix3<double> j = theta + mass * (c.squaredNorm() * Matrix3<double>::Identity() - c * c.transpose());
  const Mechanism m = top();
  EXPECT_EQ(m.positions(), 4U);
  EXPECT_EQ(m.degreesOfFreedom(), 3);
  testing::RandomStates states;
  for (const Formulation formulation : {Formulation::sparse, Formulation::articulated}) {
    Evaluator<double> motion(recordMotion(m, {}, formulation));
    for (int round = 0; round < 50; ++round) {
      std::vector<double> x = states(7, 1.4);
      const double norm = std::hypot(std::hypot(x[0], x[1]), std::hypot(x[2], x[3]));
      for (int i = 0; i < 4; ++i) x[static_cast<std::size_t>(i)] /= norm;
      const std::vector<double> dx = motion(0.0, x);
      const Eigen::Quaterniond e(x[0], x[1], x[2], x[3]);
      const Vector3<double> u(x[4], x[5], x[6]), uDot(dx[4], dx[5], dx[6]);
      const Vector3<double> moment = c.cross(mass * (e.toRotationMatrix().transpose() * g));
      EXPECT_LT((j * uDot + u.cross(j * u) - moment).norm(), 1e-12 * (1 + uDot.norm()));
      const Eigen::Quaterniond half(0.0, u[0] / 2, u[1] / 2, u[2] / 2), rate = e * half;
      EXPECT_NEAR(dx[0], rate.w(), 1e-15);
      EXPECT_NEAR(dx[1], rate.x(), 1e-15);
      EXPECT_NEAR(dx[2], rate.y(), 1e-15);
      EXPECT_NEAR(dx[3], rate.z(), 1e-15);
    }
  }
}

TEST(BallJoint, OfAUserServesEveryScalar) {
  const Mechanism m = top();
  const std::vector<double> x = {0.8, 0.0, 0.6, 0.0, 1.0, -2.0, 0.5};
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
