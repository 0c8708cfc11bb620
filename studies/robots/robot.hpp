// A Robot is what a file says of a machine, in URDF (https://wiki.ros.org/urdf/XML), MJCF
// (https://mujoco.readthedocs.io/en/stable/XMLreference.html) or SDFormat (http://sdformat.org/spec): links with their
// inertia, joints between them as a tree, numbers as enclosures of the decimals that stand there. Whatever is wrong in
// the file is said with file and line.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mechanics/axis.hpp"
#include "mechanics/description/described.hpp"
#include "scalars/interval.hpp"

namespace gamut {

struct Robot {
  /// About an axis of the frame that the turn before has reached, or by a quaternion of any length.
  struct Turn {
    Axis axis = axisX;
    int quarterTurns = 0;                                    ///< exact ones, besides
    Interval angle = 0.0;                                    ///< rad
    std::optional<std::array<Interval, 4>> quaternion = {};  ///< w, x, y, z, instead
    std::string key = {};                                    ///< of one among several, by which its number is named
  };
  /// Of a frame in another: m, and rad about the fixed axes x, y, z, in this order.
  struct Place {
    std::array<Interval, 3> xyz = {0.0, 0.0, 0.0}, rpy = {0.0, 0.0, 0.0};
    std::optional<std::vector<Turn>> turns = {};  ///< instead of `rpy`, one after the other
  };
  /// From a frame to another that stands there, or back.
  struct Step {
    std::string frame;  ///< the one that it leads to
    std::string name;   ///< of its numbers
    Place place;
    bool isBack = false;
    bool isShared = false;  ///< others have the same numbers
    bool turnsOnly = false;
  };
  struct Inertial {
    Place place;                                                       ///< of the centre of mass, in the link
    Interval mass = 0.0;                                               ///< kg
    std::array<Interval, 6> inertia = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};  ///< xx, yy, zz, xy, yz, zx, in axes of `place`
  };
  /// A box, a sphere, a cylinder or a capsule along z about its origin; the hull of a mesh.
  struct Shape {
    enum class Kind { box, sphere, cylinder, capsule, hull };
    Kind kind = Kind::box;
    int line = 0;
    std::string file = {};
    Place place;                                     ///< in the link
    std::array<Interval, 3> size = {0.0, 0.0, 0.0};  ///< m, of a box
    Interval radius = 0.0, length = 0.0;             ///< m, of others
    std::vector<std::array<double, 3>> points = {};  ///< m, of a hull: all within `radius` of theirs belongs to it
  };
  struct Link {
    std::string name;
    int line = 0;
    std::string file = {};  ///< here and elsewhere: empty where it is the robot's
    std::optional<Inertial> inertial = {};
    std::vector<Shape> shapes = {};  ///< if they are taken
  };
  enum class Type { revolute, continuous, prismatic, fixed, planar, floating, ball };
  /// What stands in the file; nothing is held to it.
  struct Limits {
    std::optional<double> lower, upper, effort, velocity;  ///< rad or m, N m or N, rad/s or m/s
  };
  struct Mimic {
    std::string joint;
    Interval multiplier = 1.0, offset = 0.0;
    int line = 0;
    std::string file = {};
  };
  struct Joint {
    std::string name;
    int line = 0;
    std::string file = {};
    Type type = Type::fixed;
    std::string parent, child;
    Place origin;                   ///< of the joint, and of `child` where the joint is at 0, in `parent`
    std::vector<Step> before = {};  ///< from `parent` to the joint, instead of `origin` if there are any
    std::vector<Step> after = {};   ///< from the joint to `child`, if they are apart
    Axis axis = axisX;
    std::string direction = "1 0 0";         ///< of the axis, as it stands in the file
    Interval damping = 0.0, friction = 0.0;  ///< N m s/rad or N s/m, N m or N
    Interval stiffness = 0.0, rest = 0.0;    ///< of a spring: N m/rad or N/m, rad or m
    Interval armature = 0.0;                 ///< of the rotor that drives it, as the joint feels it: kg m² or kg
    std::optional<Limits> limits = {};
    std::optional<Mimic> mimic = {};
    int depth = 0;  ///< how many joints lie between it and the root
  };

  std::string name;
  std::string file;                                     ///< as messages call it
  bool isWorld = false;                                 ///< its root is what stands still
  std::optional<std::array<Interval, 3>> gravity = {};  ///< m/s², if the file states it
  std::vector<Link> links;                              ///< the root first, each after the one that carries it
  std::vector<Joint> joints;                            ///< joint i moves link i + 1
  std::vector<std::string> notes;                       ///< what is left out: lines "file:line: note: what"

  const Link& root() const { return links.front(); }
};

/// Whether it turns about an axis or slides along one.
bool hasCoordinate(const Robot::Joint& joint);
/// Degrees of freedom: none of a joint that follows another.
int freedomOf(const Robot::Joint& joint);

/// "revolute", …, as in the file.
std::string_view wordOf(Robot::Type type);
/// The type of element that says to be this one (Described::urdfTypes).
const Described& elementOf(Robot::Type type);

/// The file's text; where it includes others a JSON object of them all, by the names by which they are included, the
/// file itself by the empty one. Throws StudyError, for files that no robot description is as large as, too.
std::string textOfRobot(const std::string& path);

/// Of such a text: URDF, MJCF or SDFormat, as its outermost element says. Throws StudyError. `name` is what messages
/// call the file. The shapes by which it touches are taken if they are asked for.
Robot readRobotText(const std::string& text, const std::string& name, bool takesShapes = false);

}  // namespace gamut
