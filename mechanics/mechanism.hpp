// A Mechanism is the description of a machine: elements in the order of assembly, from the inertial frame outwards, and
// the numbers in them by name. It computes no motion; an Assembly<S> is made from it for a scalar, a Program by
// recordMotion.
//
//   Mechanism pendulum;
//   pendulum.addParameter("rod.length", Interval(1.0));
//   pendulum.add(Revolute{"hinge", "inertial", "K1", axisX, 0.5, 0.0});
//   pendulum.add(Link{"rod", "K1", "K2", {0.0, 0.0, Expression::named("rod.length", -1.0)}});
//   pendulum.add(Mass{"bob", "K2", Interval("0.1")});
//   pendulum.setGravity({0.0, 0.0, Interval("-9.81")});
//
// Every number has a name under which it may be made uncertain: ELEMENT.NUMBER, or, where it is a formula, those of the
// parameters in it.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mechanics/axis.hpp"
#include "mechanics/expression.hpp"
#include "scalars/interval.hpp"

namespace gamut {

using ExpressionVector = std::array<Expression, 3>;

/// Revolute joint, hinge or pin; names NAME.angle [rad] and NAME.rate [rad/s] (initial values and states).
struct Revolute {
  std::string name, from, to;
  Axis axis;
  Expression angle = 0.0, rate = 0.0;
};

/// Prismatic joint or slider; names NAME.displacement [m] and NAME.rate [m/s] (initial values and states).
struct Prismatic {
  std::string name, from, to;
  Axis axis;
  Expression displacement = 0.0, rate = 0.0;
};

/// A fixed rotation: exact right angles plus an angle [rad] about an axis.
struct FixedRotation {
  Axis axis;
  int quarterTurns = 0;
  Expression angle = 0.0;
};

/// Rigid link from `from` to `to`; names NAME.vector.x … z [m], NAME.rotation.1 … [rad]. Rotations follow the offset,
/// each about an axis of the frame that the one before has reached.
struct Link {
  std::string name, from, to;
  ExpressionVector vector;
  std::vector<FixedRotation> rotation = {};
};

/// A body at frame `at`; names NAME.mass [kg], NAME.centre.x … z [m], NAME.inertia.xx … zx [kg m²] (about the centre).
struct Mass {
  std::string name, at;
  Expression mass;
  ExpressionVector centre = {0.0, 0.0, 0.0};
  /// xx, yy, zz, xy, yz, zx
  std::array<Expression, 6> inertia = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
};

/// Spring and damper between points of two frames; names NAME.stiffness [N/m], NAME.rest_length [m], NAME.damping
/// [N s/m], NAME.from_point.x … and NAME.to_point.x … [m].
struct Spring {
  std::string name, from, to;
  Expression stiffness, restLength, damping = 0.0;
  ExpressionVector fromPoint = {0.0, 0.0, 0.0}, toPoint = {0.0, 0.0, 0.0};
};

/// Spring and viscous friction on a joint's own variable; names NAME.stiffness [N m/rad or N/m], NAME.rest [rad or m],
/// NAME.damping [N m s/rad or N s/m].
struct JointSpring {
  std::string name, joint;
  Expression stiffness, rest = 0.0, damping = 0.0;
};

using ElementDescription = std::variant<Revolute, Prismatic, Link, Mass, Spring, JointSpring>;

class Mechanism {
 public:
  /// The frame in which everything stands.
  static constexpr const char* inertialFrame = "inertial";

  struct NamedValue {
    std::string name, unit;
    Interval nominal;
  };
  /// A parameter that follows from others.
  struct Derived {
    std::string name, unit;
    Expression formula;
  };

  Mechanism();

  // All of these throw std::invalid_argument with a sentence that says what is wrong and what was expected.

  /// Declares a parameter before its first use. Without a unit it takes that of its first use.
  void addParameter(const std::string& name, const Interval& nominal, const std::string& unit = "");
  /// Declares a parameter that follows from others, which have been declared with their units. Throws UnitError where
  /// its terms do not fit together.
  void addDerived(const std::string& name, const Expression& formula);
  void add(Revolute joint);
  void add(Prismatic joint);
  void add(Link link);
  void add(Mass mass);
  void add(Spring spring);
  void add(JointSpring spring);
  /// Acceleration of free fall in the inertial frame [m/s²]; names gravity.x … z. Zero unless set; set at most once.
  void setGravity(ExpressionVector gravity);
  /// Throws UnknownName, WrongUnit or UnitError if a number, called `name`, is not of this dimension. Parameters
  /// without a unit count as plain numbers; a single one may also be what makes it so, and what it then is, is
  /// returned.
  Dimension check(const Expression& number, const std::string& name, const Dimension& expected) const;
  /// Throws if there is no joint, or a mass with an inertia that no body has.
  void check() const;
  /// What is wrong with the inertia of one of the elements for some values within the ranges, as a clause: "the inertia
  /// of 'arm' has a negative principal moment"; empty if nothing certainly is. Numbers without a range are nominal.
  std::string inertiaFault(const Mass& mass, const std::map<std::string, Interval>& ranges) const;
  /// Throws if there is a joint that no mass hangs on: its motion would not be determined.
  void checkMasses() const;

  /// Elements as added, every constant replaced by a reference to the parameter or initial value named after it.
  const std::vector<ElementDescription>& elements() const { return elements_; }
  /// Empty where none was set.
  const std::optional<ExpressionVector>& gravity() const { return gravity_; }
  const std::vector<std::string>& frames() const { return frames_; }

  /// Numbers on which motion depends, in the order of their declaration.
  const std::vector<NamedValue>& parameters() const { return parameters_; }
  bool isParameter(const std::string& name) const { return find(parameters_, name) != nullptr; }
  /// Whether it is a parameter, derived or not.
  bool knows(const std::string& name) const { return isParameter(name) || findDerived(name) != nullptr; }
  /// Those that follow from others, in the order of their declaration.
  const std::vector<Derived>& derived() const { return derived_; }
  /// Whether a number depends on this parameter, directly or by derived ones.
  bool dependsOn(const Expression& number, const std::string& parameter) const;
  /// Initial values given as numbers (not by a parameter).
  const std::vector<NamedValue>& initialValues() const { return initials_; }
  /// Names of all numbers that may be uncertain: initial values, then parameters.
  std::vector<std::string> quantities() const;
  /// The value of such a number, or of a derived parameter.
  Interval nominal(const std::string& quantity) const;
  /// A number where parameters have these ranges; those without a range are nominal.
  Interval rangeOf(const Expression& number, const std::map<std::string, Interval>& ranges = {}) const;

  int degreesOfFreedom() const { return static_cast<int>(positions_.size()); }
  /// Joint positions, then joint rates, in the order of the joints: x = [q; q̇].
  std::vector<std::string> stateNames() const;
  /// The initial values of the states, in that order.
  std::vector<Expression> initialState() const;

  /// Everything that can be looked at: states; FRAME.position.x … z and FRAME.velocity.x … z, in the inertial frame;
  /// the same for a mass, at its centre; energy, energy.kinetic, energy.potential.
  std::vector<std::string> outputQuantities() const;
  /// The unit of any quantity, number or output.
  std::string unitOf(const std::string& quantity) const;

 private:
  struct State {
    std::string name, unit;
    Expression initial;
  };

  static const NamedValue* find(const std::vector<NamedValue>& values, const std::string& name);
  void checkParameterName(const std::string& name) const;
  void checkNewName(const std::string& kind, const std::string& name) const;
  void checkFrame(const std::string& frame, const std::string& of) const;
  void addFrame(const std::string& from, const std::string& to, const std::string& of);
  void addState(std::vector<State>& states, const std::string& name, const std::string& unit,
                const Expression& initial);
  /// Throws if its names or units do not fit; a constant becomes the parameter `name`.
  void use(Expression& number, const std::string& name, const std::string& unit);
  /// Throws if one of its names is no parameter.
  void checkNames(const Expression& number, const std::string& name) const;
  std::vector<std::string> withoutUnit(const Expression& number) const;
  const Derived* findDerived(const std::string& name) const;
  void use(ExpressionVector& vector, const std::string& name, const std::string& unit);
  template <class Description>
  void keep(Description element);
  std::vector<std::string> masses() const;
  std::vector<std::string> joints() const;

  std::vector<ElementDescription> elements_;
  std::optional<ExpressionVector> gravity_;
  std::vector<std::string> names_, frames_;
  std::vector<NamedValue> parameters_, initials_;
  std::vector<Derived> derived_;
  std::vector<State> positions_, rates_;
};

}  // namespace gamut
