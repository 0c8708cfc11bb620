// Joints stand behind frames of their own, so that each number of the file is one number of the mechanism, by name.
#include "studies/robots/robot_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mechanics/elements/all.hpp"
#include "studies/printable.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

constexpr std::array<const char*, 3> turns = {"roll", "pitch", "yaw"};

/// Gives a joint its frames and its axis.
class Placing final : public Onlooker {
 public:
  Placing(std::string from, std::string to, const Axis& axis)
      : from_(std::move(from)), to_(std::move(to)), axis_(axis) {}

  void frame(const Word& /*word*/, std::string& name) override { name = from_; }
  void movedFrame(const Word& /*word*/, std::string& name, const std::string& /*from*/) override { name = to_; }
  void axis(const Word& /*word*/, Axis& axis) override { axis = axis_; }

 private:
  std::string from_, to_;
  Axis axis_;
};

class RobotElements {
 public:
  RobotElements(const Robot& robot, const RobotChoices& choices, Mechanism& mechanism)
      : robot_(robot), choices_(choices), mechanism_(mechanism) {}

  std::vector<RobotElement> make() {
    addBase();
    addBody(robot_.root());
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
      addJoint(robot_.joints[i]);
      addBody(robot_.links[i + 1]);
    }
    if (choices_.mimic) addMimics();
    for (const Robot::Joint& joint : robot_.joints) addResistance(joint);
    return std::move(elements_);
  }

 private:
  void add(Described element, int line) { elements_.push_back({std::move(element), line}); }

  [[noreturn]] void refuse(int line, const std::string& what, const std::string& expected) const {
    throw StudyError(fmt::format("{}:{}", robot_.file, line), what, expected);
  }

  Expression number(const std::string& name, const Interval& value, const char* unit) {
    mechanism_.addParameter(name, value, unit);
    return Expression::named(name);
  }

  ExpressionVector vector(const std::string& name, const std::array<Interval, 3>& xyz) {
    ExpressionVector vector = {0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i) vector[i] = number(name + "." + components[i], xyz[i], "m");
    return vector;
  }

  /// About fixed axes x, y, z is about z, y, x of the frame that turns along.
  std::vector<FixedRotation> rotation(const std::string& name, const std::array<Interval, 3>& rpy) {
    const std::array<Axis, 3> axes = {axisX, axisY, axisZ};
    std::vector<FixedRotation> rotation;
    for (std::size_t i = 0; i < 3; ++i)
      rotation.insert(rotation.begin(), {axes[i], 0, number(name + "." + turns[i], rpy[i], "rad")});
    return rotation;
  }

  void addBase() {
    const Robot::Link& root = robot_.root();
    const std::string name = root.name + ".base";
    if (choices_.isFree)
      add(Free{name, Mechanism::inertialFrame, root.name}, root.line);
    else
      add(Weld{name, Mechanism::inertialFrame, root.name}, root.line);
  }

  void addBody(const Robot::Link& link) {
    for (std::size_t i = 0; i < link.shapes.size(); ++i)
      addShape(link, link.shapes[i], link.shapes.size() == 1 ? "" : fmt::format(".{}", i + 1));
    if (!link.inertial) return;
    const Robot::Inertial& inertial = *link.inertial;
    Mass body{link.name + ".body", link.name};
    body.mass = number(link.name + ".mass", inertial.mass, "kg");
    body.centre = vector(link.name + ".centre", inertial.place.xyz);
    for (std::size_t i = 0; i < 6; ++i)
      body.inertia[i] = number(link.name + ".inertia." + symmetricEntries[i], inertial.inertia[i], "kg m^2");
    body.rotation = rotation(link.name + ".inertia", inertial.place.rpy);
    add(std::move(body), link.line);
  }

  /// A cylinder by the capsule that holds it.
  void addShape(const Robot::Link& link, const Robot::Shape& shape, const std::string& number) {
    const std::string name = link.name + ".collision" + number, origin = name + ".origin";
    add(Link{origin, link.name, origin, vector(origin, shape.place.xyz), rotation(origin, shape.place.rpy)},
        shape.line);
    switch (shape.kind) {
      case Robot::Shape::Kind::box:
        add(Cuboid{name, origin, {shape.size[0], shape.size[1], shape.size[2]}}, shape.line);
        break;
      case Robot::Shape::Kind::sphere:
        add(Sphere{name, origin, shape.radius}, shape.line);
        break;
      case Robot::Shape::Kind::cylinder:
        add(Capsule{name, origin, shape.radius, shape.length, axisZ}, shape.line);
        break;
    }
  }

  void addJoint(const Robot::Joint& joint) {
    const std::string origin = joint.name + ".origin";
    ExpressionVector place = vector(origin, joint.origin.xyz);
    std::vector<FixedRotation> turn = rotation(origin, joint.origin.rpy);
    if (joint.type == Robot::Type::fixed) {
      add(Link{joint.name, joint.parent, joint.child, std::move(place), std::move(turn)}, joint.line);
      return;
    }
    add(Link{origin, joint.parent, origin, std::move(place), std::move(turn)}, joint.line);
    add(movable(joint, origin), joint.line);
  }

  Described movable(const Robot::Joint& joint, const std::string& from) const {
    if (joint.type == Robot::Type::planar && !joint.axis.isAligned())
      refuse(joint.line, fmt::format("the plane of '{}' is across ({})", joint.name, joint.direction),
             "a plane across an axis of its origin, 1 0 0, 0 1 0 or 0 0 1, which may be turned");
    Described element = elementOf(joint.type);
    element.setName(joint.name);
    Placing placing(from, joint.child, joint.axis);
    element.describe(placing);
    return element;
  }

  /// Those that follow others after these.
  void addMimics() {
    std::vector<std::string> done;
    const auto isDone = [&](const Robot::Joint& joint) { return std::ranges::count(done, joint.name) != 0; };
    const auto addBehindLeader = [&](const Robot::Joint& first) {
      std::vector<const Robot::Joint*> open = {&first};
      while (!open.empty()) {
        const Robot::Joint& joint = *open.back();
        const Robot::Joint& leader = *std::ranges::find(robot_.joints, joint.mimic->joint, &Robot::Joint::name);
        if (leader.mimic && !isDone(leader)) {
          open.push_back(&leader);
          continue;
        }
        open.pop_back();
        if (isDone(joint)) continue;
        done.push_back(joint.name);
        const std::string name = joint.name + ".mimic";
        add(Coupling{name, joint.name, leader.name, joint.mimic->multiplier, joint.mimic->offset}, joint.mimic->line);
      }
    };
    for (const Robot::Joint& joint : robot_.joints)
      if (joint.mimic) addBehindLeader(joint);
  }

  /// Viscous damping and dry friction: −d q̇ and −F sign(q̇).
  void addResistance(const Robot::Joint& joint) {
    if (!hasCoordinate(joint)) return;
    const bool slides = joint.type == Robot::Type::prismatic;
    const auto isZero = [](const Interval& x) { return isEqual(x, Interval(0.0)); };
    const auto add = [&](const std::string& name, const Interval& value, const char* unit, const std::string& law) {
      mechanism_.addParameter(name, value, unit);
      this->add(JointForce{name, joint.name, Expression::parse(fmt::format(fmt::runtime(law), name, joint.name))},
                joint.line);
    };
    if (choices_.damping && !isZero(joint.damping))
      add(joint.name + ".damping", joint.damping, slides ? "N s/m" : "N m s/rad", "-'{}' * '{}.rate'");
    if (choices_.friction && !isZero(joint.friction))
      add(joint.name + ".friction", joint.friction, slides ? "N" : "N m", "-'{}' * sign('{}.rate')");
  }

  const Robot& robot_;
  const RobotChoices& choices_;
  Mechanism& mechanism_;
  std::vector<RobotElement> elements_;
};

}  // namespace

std::vector<RobotElement> robotElements(const Robot& robot, const RobotChoices& choices, Mechanism& mechanism) {
  return RobotElements(robot, choices, mechanism).make();
}

}  // namespace gamut
