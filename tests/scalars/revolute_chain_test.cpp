// The arm that the benchmarks move, against Newton and Euler: the torques that its accelerations need, computed in the
// frame of the base with rotation matrices, are the torques it was given.
#include "benchmarks/revolute_chain.hpp"

#include <Eigen/Dense>
#include <vector>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/recorded.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::benchmarks::revolute_chain_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

JointValues<double> inverseDynamics(const Arm<double>& arm, const JointValues<double>& q, const JointValues<double>& v,
                                    const JointValues<double>& acceleration) {
  Matrix3d frame = Matrix3d::Identity();
  Vector3d w = Vector3d::Zero(), alpha = Vector3d::Zero(), a(0, 0, gravity), origin = Vector3d::Zero();
  std::vector<Vector3d> axes, origins, forces, moments;
  for (std::size_t i = 0; i < joints; ++i) {
    const double d = seats[i].length;
    const Vector3d shift = frame * (seats[i].axis == 'y' ? Vector3d(0, d, 0) : Vector3d(0, 0, d));
    a += alpha.cross(shift) + w.cross(w.cross(shift));
    origin += shift;
    if (i > 0) frame = frame * (Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished();
    frame = frame * Eigen::AngleAxisd(q[i], Vector3d::UnitZ()).toRotationMatrix();
    const Vector3d axis = frame.col(2);
    alpha += w.cross(v[i] * axis) + acceleration[i] * axis;
    w += v[i] * axis;
    const Link<double>& link = arm[i];
    const Symmetric<double>& s = link.inertia;
    const Matrix3d own = (Matrix3d() << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz).finished();
    const Matrix3d inertia = frame * own * frame.transpose();
    const Vector3d h = frame * Vector3d(link.moment.x, link.moment.y, link.moment.z);
    forces.push_back(link.mass * a + alpha.cross(h) + w.cross(w.cross(h)));
    moments.push_back(inertia * alpha + w.cross(inertia * w) + h.cross(a));
    axes.push_back(axis);
    origins.push_back(origin);
  }
  JointValues<double> torque;
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
  for (std::size_t i = joints; i-- > 0;) {
    if (i + 1 < joints) moment += (origins[i + 1] - origins[i]).cross(force);
    force += forces[i];
    moment += moments[i];
    torque[i] = moment.dot(axes[i]);
  }
  return torque;
}

TEST(RevoluteChain, ForwardDynamicsInvertsInverseDynamics) {
  gamut::testing::RandomDoubles random;
  const Arm<double> arm = armOf(usualMasses);
  const Program program = record(3 * joints, joints, joints, [](auto, const auto& x, const auto& p, auto& y) {
    JointValues<Recorded> q, v, torque, masses;
    for (std::size_t i = 0; i < joints; ++i)
      q[i] = x[i], v[i] = x[joints + i], torque[i] = x[2 * joints + i], masses[i] = p[i];
    std::ranges::copy(ForwardDynamics<Recorded>::of(armOf(masses), q, v, torque), y.begin());
  });
  Evaluator<double> recorded(program);
  recorded.setParameters(usualMasses);
  for (int k = 0; k < 1000; ++k) {
    JointValues<double> q, v, torque;
    for (std::size_t i = 0; i < joints; ++i)
      q[i] = random.uniform(-3, 3), v[i] = random.uniform(-2, 2), torque[i] = random.uniform(-10, 10);
    std::vector<double> x;
    for (const auto* part : {&q, &v, &torque}) x.insert(x.end(), part->begin(), part->end());
    const std::vector<double> byProgram = recorded(0.0, x);
    const JointValues<double> acceleration = ForwardDynamics<double>::of(arm, q, v, torque);
    const JointValues<double> back = inverseDynamics(arm, q, v, acceleration);
    for (std::size_t i = 0; i < joints; ++i) {
      ASSERT_NEAR(back[i], torque[i], 1e-11);
      ASSERT_NEAR(byProgram[i], acceleration[i], 1e-10 * (1 + std::fabs(acceleration[i])));
    }
  }
}

}  // namespace
}  // namespace gamut::benchmarks::revolute_chain_test
