// Joints stand behind frames of their own, so that each number of the file is one number of the mechanism, by name.
#include "studies/robots/robot_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "mechanics/description/orientation.hpp"
#include "mechanics/elements/all.hpp"
#include "studies/printable.hpp"
#include "studies/robots/robot_parts.hpp"

namespace gamut {
namespace {

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
  /// `part`: a link, a joint, a shape.
  template <class Part>
  void add(Described element, const Part& part) {
    elements_.push_back(
        {std::move(element), fmt::format("{}:{}", part.file.empty() ? robot_.file : part.file, part.line)});
  }

  Expression number(const std::string& name, const Interval& value, const char* unit) {
    if (!isDeclared_) mechanism_.addParameter(name, value, unit);
    return Expression::named(name);
  }

  ExpressionVector vector(const std::string& name, const std::array<Interval, 3>& xyz) {
    ExpressionVector vector = {0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i) vector[i] = number(name + "." + components[i], xyz[i], "m");
    return vector;
  }

  /// About fixed axes x, y, z is about z, y, x of the frame that turns along.
  std::vector<FixedRotation> rotation(const std::string& name, const Robot::Place& place) {
    if (place.turns) return turning(name, *place.turns);
    const std::array<Axis, 3> axes = {axisX, axisY, axisZ};
    std::vector<FixedRotation> rotation;
    for (std::size_t i = 0; i < 3; ++i)
      rotation.insert(rotation.begin(), {axes[i], 0, number(name + "." + rollPitchYawNames[i], place.rpy[i], "rad")});
    return rotation;
  }

  std::vector<FixedRotation> turning(const std::string& name, const std::vector<Robot::Turn>& turns) {
    std::vector<FixedRotation> rotation;
    for (const Robot::Turn& turn : turns) {
      const std::string which = turn.key.empty() ? "" : "." + turn.key;
      if (turn.quaternion) {
        Quaternion<Expression> e = {0.0, 0.0, 0.0, 0.0};
        for (std::size_t i = 0; i < 4; ++i)
          e[i] = number(fmt::format("{}.quaternion{}.{}", name, which, quaternionComponents[i]), (*turn.quaternion)[i],
                        "1");
        rotation.push_back(byQuaternion(e));
      } else {
        rotation.push_back({turn.axis, turn.quarterTurns, number(name + ".angle" + which, turn.angle, "rad")});
      }
    }
    return rotation;
  }

  static std::vector<FixedRotation> backwards(std::vector<FixedRotation> rotation) {
    std::ranges::reverse(rotation);
    for (FixedRotation& turn : rotation) {
      turn.quarterTurns = -turn.quarterTurns;
      turn.angle = -turn.angle;
      if (turn.quaternion)
        for (std::size_t i = 1; i < 4; ++i) (*turn.quaternion)[i] = -(*turn.quaternion)[i];
    }
    return rotation;
  }

  /// Adds what leads from one frame to the next, by an element of this name.
  void addStep(const Robot::Joint& joint, const Robot::Step& step, const std::string& from, const std::string& name) {
    isDeclared_ = step.isShared && !shared_.insert(step.name).second;
    ExpressionVector place = vector(step.name, step.place.xyz);
    std::vector<FixedRotation> turns = rotation(step.name, step.place);
    isDeclared_ = false;
    if (step.turnsOnly) place = {0.0, 0.0, 0.0};
    if (!step.isBack) {
      add(Link{name, from, step.frame, std::move(place), std::move(turns)}, joint);
      return;
    }
    if (step.turnsOnly) {
      add(Link{name, from, step.frame, std::move(place), backwards(std::move(turns))}, joint);
      return;
    }
    const std::string turned = turns.empty() ? from : step.frame + ".turned";
    if (!turns.empty()) add(Link{name + ".turn", from, turned, {0.0, 0.0, 0.0}, backwards(std::move(turns))}, joint);
    for (Expression& component : place) component = -component;
    add(Link{name, turned, step.frame, std::move(place), {}}, joint);
  }

  void addBase() {
    const Robot::Link& root = robot_.root();
    const std::string name = root.name + ".base";
    if (choices_.isFree)
      add(Free{name, Mechanism::inertialFrame, root.name}, root);
    else
      add(Weld{name, Mechanism::inertialFrame, root.name}, root);
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
    body.rotation = rotation(link.name + ".inertia", inertial.place);
    add(std::move(body), link);
  }

  /// A cylinder by the capsule that holds it.
  void addShape(const Robot::Link& link, const Robot::Shape& shape, const std::string& number) {
    const std::string name = link.name + ".collision" + number, origin = name + ".origin";
    add(Link{origin, link.name, origin, vector(origin, shape.place.xyz), rotation(origin, shape.place)}, shape);
    switch (shape.kind) {
      case Robot::Shape::Kind::box:
        add(Cuboid{name, origin, {shape.size[0], shape.size[1], shape.size[2]}}, shape);
        break;
      case Robot::Shape::Kind::sphere:
        add(Sphere{name, origin, shape.radius}, shape);
        break;
      case Robot::Shape::Kind::hull: {
        std::vector<ExpressionVector> points;
        for (const auto& [x, y, z] : shape.points) points.push_back({x, y, z});
        add(Hull{name, origin, std::move(points), shape.radius}, shape);
        break;
      }
      case Robot::Shape::Kind::cylinder:
      case Robot::Shape::Kind::capsule:
        add(Capsule{name, origin, shape.radius, shape.length, axisZ}, shape);
        break;
    }
  }

  void addJoint(const Robot::Joint& joint) {
    const std::string origin = joint.name + ".origin";
    std::vector<Robot::Step> before = joint.before;
    if (before.empty()) before.push_back({origin, origin, joint.origin});
    const bool isFixed = joint.type == Robot::Type::fixed;
    if (isFixed) before.back().frame = joint.child;
    std::string from = joint.parent;
    for (const Robot::Step& step : before) {
      addStep(joint, step, from, isFixed && &step == &before.back() ? joint.name : step.frame);
      from = step.frame;
    }
    if (isFixed) return;
    const std::string moved = joint.after.empty() ? joint.child : joint.name + ".moved";
    add(movable(joint, from, moved), joint);
    from = moved;
    for (std::size_t i = 0; i < joint.after.size(); ++i) {
      addStep(joint, joint.after[i], from,
              joint.after.size() == 1 ? joint.name + ".back" : fmt::format("{}.back.{}", joint.name, i + 1));
      from = joint.after[i].frame;
    }
  }

  Described movable(const Robot::Joint& joint, const std::string& from, const std::string& to) const {
    if (joint.type == Robot::Type::planar && !joint.axis.isAligned())
      refuse(robot_, joint.file, joint.line,
             fmt::format("the plane of '{}' is across ({})", joint.name, joint.direction),
             "a plane across an axis of its origin, 1 0 0, 0 1 0 or 0 0 1, which may be turned");
    Described element = elementOf(joint.type);
    element.setName(joint.name);
    Placing placing(from, to, joint.axis);
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
        add(Coupling{name, joint.name, leader.name, joint.mimic->multiplier, joint.mimic->offset}, *joint.mimic);
      }
    };
    for (const Robot::Joint& joint : robot_.joints)
      if (joint.mimic) addBehindLeader(joint);
  }

  /// Viscous damping and dry friction, −d q̇ and −F sign(q̇), a spring and the inertia of a rotor.
  void addResistance(const Robot::Joint& joint) {
    if (!hasCoordinate(joint)) return;
    const bool slides = joint.type == Robot::Type::prismatic;
    const auto isZero = [](const Interval& x) { return isEqual(x, Interval(0.0)); };
    const auto add = [&](const std::string& name, const Interval& value, const char* unit, const std::string& law) {
      mechanism_.addParameter(name, value, unit);
      this->add(JointForce{name, joint.name, Expression::parse(fmt::format(fmt::runtime(law), name, joint.name))},
                joint);
    };
    if (choices_.damping && !isZero(joint.damping))
      add(joint.name + ".damping", joint.damping, slides ? "N s/m" : "N m s/rad", "-'{}' * '{}.rate'");
    if (choices_.friction && !isZero(joint.friction))
      add(joint.name + ".friction", joint.friction, slides ? "N" : "N m", "-'{}' * sign('{}.rate')");
    if (choices_.springs && !isZero(joint.stiffness)) {
      const Expression stiffness = number(joint.name + ".stiffness", joint.stiffness, slides ? "N/m" : "N m/rad");
      const Expression rest = number(joint.name + ".rest", joint.rest, slides ? "m" : "rad");
      this->add(JointSpring{joint.name + ".spring", joint.name, stiffness, rest}, joint);
    }
    if (!isZero(joint.armature)) {  // of a slider kg, at 1 rad of a rotor for each m
      const std::string name = joint.name + ".armature";
      mechanism_.addParameter(name, joint.armature, slides ? "kg" : "kg m^2");
      const Expression inertia = Expression::parse(fmt::format(fmt::runtime(slides ? "'{}' * 1 m^2" : "'{}'"), name));
      this->add(Motor{joint.name + ".rotor", joint.name, 0.0, 1.0, inertia}, joint);
    }
  }

  const Robot& robot_;
  const RobotChoices& choices_;
  Mechanism& mechanism_;
  std::vector<RobotElement> elements_;
  std::set<std::string> shared_;  ///< places whose numbers are declared
  bool isDeclared_ = false;       ///< what numbers are asked for is so
};

}  // namespace

std::vector<RobotElement> robotElements(const Robot& robot, const RobotChoices& choices, Mechanism& mechanism) {
  return RobotElements(robot, choices, mechanism).make();
}

}  // namespace gamut
