// The machines that the mechanics tests move, and a published right-hand side to judge them by.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/elements/all.hpp"

namespace gamut::testing {

/// Two point masses of 1 kg on massless rods of 1 m; the second angle is relative to the first. With the axis x, as in
/// LNCS 5045, the tip moves in the plane of y and z.
inline Mechanism doublePendulum(const Axis& axis = axisX) {
  Mechanism m;
  m.addParameter("upper.length", 1.0);
  m.addParameter("lower.length", 1.0);
  m.add(Revolute{"shoulder", "inertial", "K1", axis, 0.75 * pi(), Interval("0.43")});
  m.add(Link{"upper", "K1", "K2", {0.0, 0.0, Expression::named("upper.length", -1.0)}});
  m.add(Mass{"elbowMass", "K2", 1.0});
  m.add(Revolute{"elbow", "K2", "K3", axis, -11 * pi() / 20, Interval("0.67")});
  m.add(Link{"lower", "K3", "K4", {0.0, 0.0, Expression::named("lower.length", -1.0)}});
  m.add(Mass{"tip", "K4", 1.0});
  m.setGravity({0.0, 0.0, Interval("-9.81")});
  return m;
}

/// The published right-hand side of the double pendulum (Rauh, Auer, Hofer, SCAN 2006, eq. 24), solved by Cramer's
/// rule: accelerations of (ψ1, ψ2) for x = (ψ1, ψ2, ψ̇1, ψ̇2), lengths l and masses m.
template <class T>
std::array<T, 2> publishedDoublePendulum(const std::array<T, 4>& x, const T& g, const std::array<T, 2>& l = {1, 1},
                                         const std::array<T, 2>& m = {1, 1}) {
  using std::cos, std::sin;
  const T c = cos(x[1]), s = sin(x[1]), sum = x[2] + x[3];
  const T a11 = m[0] * l[0] + m[1] * (l[0] + l[1] * c), a12 = m[1] * l[1] * c;
  const T a21 = m[1] * (l[0] * c + l[1]), a22 = m[1] * l[1];
  const T b1 = -g * (m[0] + m[1]) * sin(x[0]) + m[1] * l[1] * s * sum * sum;
  const T b2 = -g * m[1] * sin(x[0] + x[1]) - m[1] * l[0] * s * x[2] * x[2];
  const T d = a11 * a22 - a12 * a21;
  return {(b1 * a22 - a12 * b2) / d, (a11 * b2 - b1 * a21) / d};
}

/// A spatial arm with everything on it: aligned, reversed and oblique axes, a slider, fixed rotations, bodies with full
/// inertia tensors off their frames, a spring from the ground and springs on joints; `damping` for all of them.
inline Mechanism spatialArm(const Interval& damping = 0.0, double hipRate = 1.1) {
  Mechanism m;
  m.add(Revolute{"base", "inertial", "A", axisZ, 0.3, 0.5});
  m.add(Mass{"column", "A", 2.0, {0.1, -0.2, 0.3}, {0.4, 0.5, 0.3, 0.02, -0.03, 0.05}});
  m.add(Link{"offset", "A", "B", {0.2, -0.1, 0.5}, {{axisX, 1, 0.0}, {Axis(1, 2, -2), 0, 0.4}}});
  m.add(Revolute{"hip", "B", "C", Axis(0, -1, 0), -0.7, hipRate});
  m.add(Link{"boom", "C", "D", {0.0, 0.3, -0.8}});
  m.add(Mass{"boomBody", "D", 1.5, {0.0, 0.05, 0.4}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
  m.add(Prismatic{"slide", "D", "E", Axis(1, 0, -3), 0.4, -0.6});
  m.add(Mass{"carriage", "E", 0.7, {0.02, 0.0, 0.03}, {0.03, 0.02, 0.04, 0.0, 0.0, 0.0}});
  m.add(Revolute{"wrist", "E", "F", Axis(2, -1, 2), 1.2, 0.9});
  m.add(Mass{"hand", "F", 0.4, {0.1, 0.2, -0.1}, {0.01, 0.02, 0.015, 0.001, 0.002, -0.001}});
  m.add(Spring{"tether", "inertial", "F", 30.0, 0.6, damping, {1.0, 1.5, -0.5}, {0.1, 0.0, 0.2}});
  m.add(JointSpring{"hipSpring", "hip", 4.0, 0.2, damping});
  m.add(JointSpring{"slideSpring", "slide", 25.0, 0.1, damping});
  m.setGravity({0.5, -1.0, -9.0});
  return m;
}

/// Where a state stands among all; behind the last if there is none of this name.
inline std::size_t placeOf(const Mechanism& m, const std::string& state) {
  const std::vector<std::string> names = m.stateNames();
  return static_cast<std::size_t>(std::ranges::find(names, state) - names.begin());
}

/// Random states of n values in [-bound, bound].
class RandomStates {
 public:
  std::vector<double> operator()(std::size_t n, double bound = 3) {
    std::vector<double> x(n);
    for (double& value : x) value = std::uniform_real_distribution<>(-bound, bound)(engine_);
    return x;
  }

 private:
  std::mt19937_64 engine_{2004};
};

/// Random states of a machine, with unit quaternions.
inline std::vector<double> statesOf(const Mechanism& m, RandomStates& random, double bound = 1.5) {
  const std::vector<std::string> names = m.stateNames();
  std::vector<double> x = random(names.size(), bound);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].ends_with(".quaternion.w")) continue;
    x[i] += 2;
    const double length = std::hypot(std::hypot(x[i], x[i + 1]), std::hypot(x[i + 2], x[i + 3]));
    for (std::size_t k = i; k < i + 4; ++k) x[k] /= length;
  }
  return x;
}

}  // namespace gamut::testing
