// Machines of many sizes whose formulations are compared: chains in a plane and in space, trees, and what closes on
// itself. Bodies are rods of 0.3 m and 1 kg, more or less; gravity acts along −z (of linkages −y).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/elements/all.hpp"

namespace gamut::benchmarks {

struct Machine {
  std::string name;
  int size = 0;  ///< bodies; of linkages, loops
  Mechanism mechanism;
  std::vector<std::string> masses;  ///< that are uncertain: three, spread over all of them
};

namespace parts {

inline std::string numbered(const char* what, int i) { return what + std::to_string(i); }

/// First, middle and last.
inline std::vector<std::string> threeOf(const std::vector<std::string>& all) {
  std::vector<std::string> some{all.front()};
  for (const std::size_t i : {all.size() / 2, all.size() - 1})
    if (std::ranges::find(some, all[i]) == some.end()) some.push_back(all[i]);
  return some;
}

/// A rod that hangs on a hinge, and its end.
inline void addRod(Mechanism& m, int i, const std::string& from, const Axis& axis, double angle, bool isInSpace) {
  const std::string body = numbered("body", i);
  m.add(Revolute{numbered("hinge", i), from, body, axis, angle, 0.0});
  m.add(Link{numbered("rod", i), body, numbered("end", i), {0.0, 0.0, -0.3}});
  if (isInSpace)
    m.add(Mass{numbered("mass", i), body, 1.0, {0.01, 0.02, -0.15}, {0.0078, 0.0077, 4e-4, 1e-4, -2e-4, 1e-4}});
  else
    m.add(Mass{numbered("mass", i), body, 1.0, {0.0, 0.0, -0.15}, {0.0075, 0.0075, 1e-4, 0.0, 0.0, 0.0}});
}

inline Machine machineOf(std::string name, int size, Mechanism m, const char* gravityAxis = "z") {
  m.setGravity(*gravityAxis == 'z' ? ExpressionVector{0.0, 0.0, -9.81} : ExpressionVector{0.0, -9.81, 0.0});
  std::vector<std::string> masses;
  for (const Mechanism::NamedValue& each : m.parameters())
    if (each.name.ends_with(".mass")) masses.push_back(each.name);
  return {std::move(name), size, std::move(m), threeOf(masses)};
}

inline double startOf(int i) { return i == 0 ? 0.5 : i % 2 == 0 ? 0.1 : -0.15; }  // rad

}  // namespace parts

inline Machine chain(int bodies, bool isInSpace) {
  Mechanism m;
  std::string from = Mechanism::inertialFrame;
  for (int i = 0; i < bodies; ++i) {
    parts::addRod(m, i, from, isInSpace && i % 2 == 1 ? axisY : axisX, parts::startOf(i), isInSpace);
    from = parts::numbered("end", i);
  }
  return parts::machineOf(isInSpace ? "chain in space" : "chain in a plane", bodies, std::move(m));
}

/// Arms of four bodies on a trunk of two, in space.
inline Machine arms(int many) {
  Mechanism m;
  parts::addRod(m, 0, Mechanism::inertialFrame, axisX, 0.5, true);
  parts::addRod(m, 1, "end0", axisY, -0.15, true);
  int next = 2;
  for (int arm = 0; arm < many; ++arm) {
    std::string from = "end1";
    for (int i = 0; i < 4; ++i, ++next) {
      parts::addRod(m, next, from, i % 2 == 0 ? axisX : axisY, i == 0 ? 0.6 * (arm + 1) : parts::startOf(i), true);
      from = parts::numbered("end", next);
    }
  }
  return parts::machineOf("arms on a trunk", next, std::move(m));
}

/// Each body carries two, in space.
inline Machine binaryTree(int levels) {
  Mechanism m;
  const int bodies = (1 << levels) - 1;
  for (int i = 0; i < bodies; ++i)
    parts::addRod(m, i, i == 0 ? Mechanism::inertialFrame : parts::numbered("end", (i - 1) / 2),
                  std::bit_width(static_cast<unsigned>(i + 1)) % 2 == 1 ? axisX : axisY,
                  i == 0       ? 0.5
                  : i % 2 == 0 ? 0.4
                               : -0.3,
                  true);
  return parts::machineOf("binary tree", bodies, std::move(m));
}

/// Four-bar linkages in a plane, each on the coupler of the one before.
inline Machine ladder(int loops) {
  using parts::numbered;
  Mechanism m;
  std::string base = Mechanism::inertialFrame;
  for (int i = 0; i < loops; ++i) {
    const std::string crank = numbered("crank", i), coupler = numbered("coupler", i), rocker = numbered("rocker", i);
    m.add(Revolute{crank, base, crank + "_frame", axisZ, 1.0, i == 0 ? 1.0 : 0.0});
    m.add(Link{crank + "_arm", crank + "_frame", crank + "_pin", {0.3, 0.0, 0.0}});
    m.add(Mass{crank + "_body", crank + "_frame", 1.0, {0.15, 0.0, 0.0}, {0.0075, 0.0075, 0.0075, 0.0, 0.0, 0.0}});
    m.add(Revolute{coupler, crank + "_pin", coupler + "_frame", axisZ, -0.5, 0.0});
    m.add(Link{coupler + "_arm", coupler + "_frame", coupler + "_end", {0.8, 0.0, 0.0}});
    m.add(Mass{coupler + "_body", coupler + "_frame", 2.0, {0.4, 0.1, 0.0}, {0.1, 0.1, 0.1, 0.0, 0.0, 0.0}});
    m.add(Link{numbered("ground", i), base, rocker + "_pivot", {0.9, 0.0, 0.0}});
    m.add(Revolute{rocker, rocker + "_pivot", rocker + "_frame", axisZ, 1.6, 0.0});
    m.add(Link{rocker + "_arm", rocker + "_frame", rocker + "_end", {0.6, 0.0, 0.0}});
    m.add(Mass{rocker + "_body", rocker + "_frame", 1.5, {0.3, 0.0, 0.0}, {0.05, 0.05, 0.05, 0.0, 0.0, 0.0}});
    Closure pin;
    pin.name = numbered("pin", i);
    pin.as = "pin";
    pin.from = rocker + "_end";
    pin.to = coupler + "_end";
    pin.dependent = {coupler + ".angle", rocker + ".angle"};
    m.add(std::move(pin));
    base = coupler + "_frame";
  }
  return parts::machineOf("four-bar linkages", loops, std::move(m), "y");
}

/// A platform on six legs of two bodies, which springs and dampers hold.
inline Machine stewartPlatform() {
  using parts::numbered;
  Mechanism m;
  m.add(Prismatic{"x", "inertial", "at_x", axisX, 0.0, 0.0});
  m.add(Prismatic{"y", "at_x", "at_y", axisY, 0.0, 0.0});
  m.add(Prismatic{"z", "at_y", "at_z", axisZ, 0.6, 0.0});
  m.add(Revolute{"yaw", "at_z", "at_yaw", axisZ, 0.0, 0.0});
  m.add(Revolute{"pitch", "at_yaw", "at_pitch", axisY, 0.0, 0.0});
  m.add(Revolute{"roll", "at_pitch", "platform", axisX, 0.0, 0.0});
  m.add(Mass{"platform_body", "platform", 20.0, {0.0, 0.0, 0.0}, {0.5, 0.5, 0.9, 0.0, 0.0, 0.0}});
  for (int i = 0; i < 6; ++i) {
    constexpr double third = 2 * std::numbers::pi / 3, foot = 0.35, ball = 0.7;  // rad, from the third's middle
    const double side = i % 2 == 0 ? -1 : 1, middle = third * (i / 2);
    const std::array<double, 2> at{0.5 * std::cos(middle + side * foot), 0.5 * std::sin(middle + side * foot)},
        to{0.3 * std::cos(middle + side * ball), 0.3 * std::sin(middle + side * ball)};
    const double dx = to[0] - at[0], dy = to[1] - at[1], dz = 0.6, length = std::hypot(dx, dy, dz);
    const std::string tube = numbered("tube", i), rod = numbered("shaft", i), leg = numbered("leg", i);
    m.add(Link{numbered("base", i), "inertial", numbered("foot", i), {at[0], at[1], 0.0}});
    Universal hang;
    hang.name = numbered("hang", i);
    hang.from = numbered("foot", i);
    hang.to = tube;
    hang.angle1 = std::atan2(-dy, dz);
    hang.angle2 = std::asin(dx / length);
    m.add(hang);
    m.add(Mass{tube + "_body", tube, 2.0, {0.0, 0.0, 0.15}, {0.02, 0.02, 0.001, 0.0, 0.0, 0.0}});
    m.add(Prismatic{leg, tube, rod, axisZ, length, 0.0});
    m.add(JointSpring{numbered("spring", i), leg, 5000.0, length, 100.0});
    m.add(Mass{rod + "_body", rod, 1.0, {0.0, 0.0, -0.15}, {0.01, 0.01, 0.0005, 0.0, 0.0, 0.0}});
    Closure joint;
    joint.name = numbered("ball", i);
    joint.as = "ball";
    joint.from = rod;
    joint.to = "platform";
    joint.toPoint = {to[0], to[1], 0.0};
    joint.dependent = {hang.name + ".angle1", hang.name + ".angle2", leg + ".displacement"};
    m.add(std::move(joint));
  }
  return parts::machineOf("Stewart platform", 6, std::move(m));
}

}  // namespace gamut::benchmarks
