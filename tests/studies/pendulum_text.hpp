// What studies of a pendulum begin with, as they are written in a study file.
#pragma once

#include <string>

namespace gamut {

/// A hinge about x at the inertial frame and a rod from there to `tip`. `initial` and `rod`: further lines of the hinge
/// and of the link, the link's vector among these.
inline std::string hingeAndRod(const std::string& initial, const std::string& rod) {
  return R"([[mechanism.element]]
type = "revolute"
name = "hinge"
from = "inertial"
to = "K1"
axis = "x"
)" + initial +
         R"([[mechanism.element]]
type = "link"
name = "rod"
from = "K1"
to = "tip"
)" + rod;
}

/// A rod that hangs down, as long (in m) as a parameter of its own says.
inline std::string hangingRod(const std::string& length) {
  return "vector = [0, 0, \"-rod.length\"]\nparameters = { length = " + length + " }\n";
}

/// A mass at the rod's tip.
inline std::string bobOf(const std::string& mass) {
  return "[[mechanism.element]]\ntype = \"mass\"\nname = \"bob\"\nat = \"tip\"\nmass = " + mass + "\n";
}

/// Gravity, the hinge, the rod and the bob.
inline std::string pendulumMechanism(const std::string& initial, const std::string& rod, const std::string& mass) {
  return "[mechanism]\ngravity = [0, 0, -9.81]\n" + hingeAndRod(initial, rod) + bobOf(mass);
}

/// How uncertain the angle is that the pendulum starts from.
inline std::string uncertainStart(const std::string& interval) {
  return "[[uncertain]]\nname = \"start\"\nquantity = \"hinge.angle\"\ninterval = \"" + interval +
         "\"\ndistribution = { type = \"uniform\" }\n";
}

}  // namespace gamut
