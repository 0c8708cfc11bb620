// A Mechanism is the description of a machine: elements in the order of assembly, from the inertial frame outwards, and
// the numbers in them by name. It computes no motion; an Assembly<S> is made from it for a scalar, a Program by
// recordMotion.
//
//   Mechanism pendulum;
//   pendulum.addParameter("rod.length", Interval(1.0));
//   pendulum.add(Revolute{"hinge", "inertial", "K1", axisX, 0.5, 0.0});  // mechanics/elements/all.hpp
//   pendulum.add(Link{"rod", "K1", "K2", {0.0, 0.0, Expression::named("rod.length", -1.0)}});
//   pendulum.add(Mass{"bob", "K2", Interval("0.1")});
//   pendulum.setGravity({0.0, 0.0, Interval("-9.81")});
//
// Every number has a name under which it may be made uncertain: ELEMENT.NUMBER, or, where it is a formula, those of the
// parameters in it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "mechanics/description/described.hpp"
#include "mechanics/description/expression.hpp"
#include "mechanics/description/named.hpp"
#include "scalars/interval.hpp"

namespace gamut {

class Program;

/// A number of a mechanism whose formula does not fit; the problem begins with "'NUMBER': ".
class WrongNumber : public UnitError {
 public:
  WrongNumber(const std::string& number, const std::string& problem, const std::string& expected)
      : UnitError("'" + number + "': " + problem, expected), number_(number) {}
  const std::string& number() const { return number_; }

 private:
  std::string number_;
};

/// Coordinates by the element that closes a loop by them.
using DependentsOf = std::map<std::string, std::vector<std::string>>;

class Mechanism {
 public:
  /// The frame in which everything stands.
  static constexpr const char* inertialFrame = "inertial";

  struct NamedValue {
    std::string name, unit;
    Interval nominal;
    std::optional<Amount> exact = std::nullopt;  ///< the number itself, where it is known
  };
  /// A parameter that follows from others.
  struct Derived {
    std::string name, unit;
    Expression formula;
  };

  Mechanism();

  // All of these throw a Refusal.

  /// Declares a parameter before its first use. Without a unit it takes that of its first use.
  void addParameter(const std::string& name, const Interval& nominal, const std::string& unit = "");
  /// The same of a number that is known exactly: parameters that are equal then are one number wherever they stand.
  void addParameter(const std::string& name, const Amount& nominal, const std::string& unit = "");
  /// Declares a parameter that follows from others; those that were declared without a unit are plain numbers. Throws
  /// UnitError where its terms do not fit together.
  void addDerived(const std::string& name, const Expression& formula);
  /// Adds an element of any type: what its description says is checked, but for expressions of motion, whose names may
  /// be defined later. Its numbers become references to the parameters named after them.
  void add(Described element);
  /// Acceleration of free fall in the inertial frame [m/s²]; names gravity.x … z. Zero unless set; set at most once.
  void setGravity(ExpressionVector gravity);
  /// Acceleration of the base, expressions of time [m/s²]; names base_acceleration.x … z. The inertial frame then is
  /// one that moves with the base: what is measured is measured as seen from there. Zero unless set; set at most once.
  void setBaseAcceleration(ExpressionVector acceleration);
  /// Throws UnknownName, WrongUnit or WrongNumber if a number, called `name`, is not of this unit's kind. Parameters
  /// without a unit count as plain numbers; a single one may also be what makes it so, and what it then is, is
  /// returned.
  Dimension check(const Expression& number, const std::string& name, const std::string& unit) const;
  /// Throws if there is nothing that could move or be uncertain, if an expression of motion names what there is not or
  /// has another unit, or if an element has a fault.
  void check() const;
  /// The part of it that concerns the expressions of motion of one element.
  void checkSignals(const std::string& element) const;
  /// What is wrong with an element for some values within the ranges. Numbers without a range are nominal.
  std::vector<Fault> faults(const Described& element, const std::map<std::string, Interval>& ranges) const;
  /// Throws if there is a joint that no mass hangs on: its motion would not be determined.
  void checkMasses() const;
  /// Natural frequencies and damping ratios at rest are quantities too: frequency.1 …, damping.1 … of so many modes as
  /// there are speeds (mechanics/rest.hpp).
  void measureModes();
  /// An expression in which what has a name here is meant by it. Throws UnitError.
  Expression parse(std::string_view text) const;
  /// The dimension of an expression of time, parameters and whatever can be measured. Throws UnknownName or UnitError.
  Dimension dimensionOf(const Expression& signal) const;

  /// Elements as added, every constant replaced by a reference to the parameter or initial value named after it.
  const std::vector<Described>& elements() const { return elements_; }
  /// Empty where none was set.
  const std::optional<ExpressionVector>& gravity() const { return gravity_; }
  const std::optional<ExpressionVector>& baseAcceleration() const { return baseAcceleration_; }
  const std::vector<std::string>& frames() const { return frames_; }

  /// Numbers on which motion depends, in the order of their declaration.
  const Named<NamedValue>& parameters() const { return parameters_; }
  bool isParameter(const std::string& name) const { return parameters_.find(name) != nullptr; }
  /// Whether it is a parameter, derived or not.
  bool knows(const std::string& name) const { return isParameter(name) || derived_.find(name) != nullptr; }
  /// Those that follow from others, in the order of their declaration.
  const Named<Derived>& derived() const { return derived_; }
  /// Whether a number depends on this parameter, directly or by derived ones.
  bool dependsOn(const Expression& number, const std::string& parameter) const;
  /// All parameters that a number depends on, directly or by derived ones, which are among them.
  std::unordered_set<std::string> needsOf(const Expression& number) const;
  /// Initial values given as numbers (not by a parameter).
  const Named<NamedValue>& initialValues() const { return initials_; }
  /// Names of all numbers that may be uncertain: initial values, then parameters.
  std::vector<std::string> quantities() const;
  /// Of numbers, then of what follows from others.
  std::vector<std::string> parameterNames() const;
  bool mayBeUncertain(const std::string& name) const { return initials_.find(name) != nullptr || isParameter(name); }
  /// The value of such a number, or of a derived parameter.
  Interval nominal(const std::string& quantity) const;
  /// A number where parameters have these ranges; those without a range are nominal.
  Interval rangeOf(const Expression& number, const std::map<std::string, Interval>& ranges = {}) const;

  /// A coordinate of a joint: NAME.KEY, with NAME.RATE.
  struct JointCoordinate {
    std::string element, name, rate;
    Coordinate kind;
    bool isDriven = false;     ///< it is no state
    bool isDependent = false;  ///< it closes a loop: its rate is no state unless loops are held by multipliers
  };
  const Named<JointCoordinate>& coordinates() const { return coordinates_; }
  /// The coordinate of this name, or with a rate of this name; null if there is none.
  const JointCoordinate* coordinateWith(const std::string& name) const;
  /// By the joint's name if it has just one, or by the coordinate's own. Throws UnknownName, saying that `of` asks.
  const JointCoordinate& coordinate(const std::string& name, const std::string& of) const;

  /// Whether it strikes a rigid end of its travel, by its full name; and whether any does.
  bool isStruck(const std::string& coordinate) const { return struck_.contains(coordinate); }
  bool isStruck() const { return !struck_.empty(); }

  /// The coordinates that close loops, in the order of the rows that they close.
  const std::vector<std::string>& dependents() const { return dependents_; }
  bool isClosed() const { return !dependents_.empty(); }
  /// Whether its initial rate is 0, as that of one that depends on others has to be.
  bool startsWithoutRate(const JointCoordinate& coordinate) const;
  /// Has loops held by multipliers, once nothing more is added: all speeds are states then, those of dependent
  /// coordinates last, which follow from the others at the start alone. So the motion passes their dead points.
  void holdLoops();
  bool areLoopsHeld() const { return isClosed() && isSpeed(dependentRates().front()); }
  std::vector<std::string> dependentRates() const;
  /// What closes a loop, and by which coordinates.
  struct Closed {
    std::string element;
    std::vector<std::string> by;
    bool isChosen;              ///< by structure, not by name
    std::size_t redundant = 0;  ///< rows besides that are assumed to follow from all others
  };
  const std::vector<Closed>& loops() const { return loops_; }
  /// What closures leave out of what they hold, as it holds anyway.
  struct LeftOut {
    std::string element, sentence;
    std::set<std::string> restsOn;  ///< parameters by whose nominal values alone it holds
  };
  const std::vector<LeftOut>& leftOut() const { return leftOut_; }
  /// Where the loops nearly close at the start: what dependent coordinates differ by from those of the nominal machine,
  /// of the values of these free parameters. Recorded machines begin Newton's steps there.
  void closeNear(std::vector<std::string> freeParameters, std::shared_ptr<const Program> offsets) {
    nearby_ = {std::move(freeParameters), std::move(offsets)};
  }
  /// Null where nothing is known for these.
  const Program* closesNear(const std::vector<std::string>& freeParameters) const {
    return nearby_.freeParameters == freeParameters ? nearby_.offsets.get() : nullptr;
  }
  /// Of these quantities, those that motion is recorded with as free parameters: what is no initial value, and, of what
  /// closes on itself, what initial values of dependent coordinates follow from: initial positions, and, of loops that
  /// are held, speeds.
  bool isFreeParameter(const std::string& quantity) const;

  /// The name of a speed's acceleration: hinge.rate, hinge.acceleration; sleeve.angle_rate, sleeve.angle_acceleration;
  /// ball.rate.x, ball.acceleration.x; any other NAME, NAME_acceleration.
  static std::string accelerationOf(const std::string& speed);

  /// What moves a frame, and whether by own coordinates.
  struct Moved {
    std::string frame, from, element;
    bool isByJoint;
  };
  /// Frames that elements move, in the order of assembly.
  const Named<Moved, &Moved::frame>& moved() const { return moved_; }
  /// What stands before ".force.x" and ".moment.x" in the names of the reaction that moves a frame: ELEMENT.reaction,
  /// or, of a further frame that the element moves, ELEMENT.FRAME.reaction.
  std::string reactionOf(const std::string& frame) const;

  /// A measured length between points that lie apart at the start.
  struct Length {
    std::string quantity, type, element;
  };
  const std::vector<Length>& lengths() const { return lengths_; }

  /// How many positions there are.
  std::size_t positions() const { return positions_.size(); }
  bool isSpeed(const std::string& state) const { return speeds_.find(state) != nullptr; }
  /// How many speeds there are.
  int degreesOfFreedom() const { return static_cast<int>(speeds_.size()); }
  /// Positions, then speeds, in the order of the joints, then own states of elements: x = [q; u; z].
  std::vector<std::string> stateNames() const;
  /// The initial values of the states, in that order.
  std::vector<Expression> initialState() const;
  /// Of each state, whether its initial value follows from one of these parameters.
  std::vector<bool> startsWith(const std::vector<std::string>& freeParameters) const;

  /// Everything that can be looked at: states; motion of frames and quantities of the whole
  /// (description/quantities.hpp); accelerations of speeds; reactions; what elements measure.
  std::vector<std::string> outputQuantities() const;
  /// Of all that formulas of outputs may name, outputs first.
  std::vector<std::string> namesInFormulas() const;
  bool isOutputQuantity(const std::string& name) const { return unitOfMeasured(name) != nullptr; }
  /// The unit of any quantity, number or output.
  std::string unitOf(const std::string& quantity) const;

 private:
  class Checker;
  struct State {
    std::string name, unit;
    Expression initial;
  };
  struct Measured {
    std::string name, unit, element;
    bool isSolved;          ///< known once the equations of motion are solved
    bool isMotion = false;  ///< positions and speeds tell it, whatever its element's expressions are
  };
  /// Names of coordinates, of which one follows the other.
  struct Following {
    std::string follower, leader;
  };
  /// What an expression of motion may name.
  enum class Reach { time, motion, solution };
  struct Signal {
    std::string element, name, unit;
    Reach reach;
    Expression expression;
  };

  void checkParameterName(const std::string& name) const;
  void checkNewName(const std::string& kind, const std::string& name) const;
  void checkFrame(const std::string& frame, const std::string& of) const;
  void addFrame(const std::string& from, const std::string& to, const std::string& of);
  void addState(Named<State>& states, const std::string& name, const std::string& unit, const Expression& initial);
  void addMeasured(const std::string& name, const std::string& unit, const std::string& of, bool isSolved = false,
                   bool isMotion = false);
  void addSignal(Signal signal, Expression& expression);
  void drive(const std::string& coordinate, const std::string& by);
  void depend(const std::string& coordinate, const std::string& by);
  /// A driven or dependent one starts as what moves it says.
  void requireNoInitial(const std::string& number, const JointCoordinate& of, const std::string& by) const;
  /// Coordinates of the joints between two frames that may depend on others, in the order of their description; without
  /// those that have an initial rate where so many are left that are `needed`.
  std::vector<std::string> coordinatesBetween(const std::string& from, const std::string& to, std::size_t needed) const;
  /// What moves with a frame: itself, or one that it carries, also by coordinates that follow one of the element that
  /// moves it.
  std::map<std::string, bool> framesThatMoveMass() const;
  /// Throws if its names or units do not fit; a constant becomes the parameter `name`.
  void use(Expression& number, const std::string& name, const std::string& unit);
  /// Throws if one of its names is no parameter.
  void checkNames(const Expression& number, const std::string& name) const;
  void checkSignal(const Signal& signal) const;
  void refuseRateWithUnit(const Signal& signal) const;
  /// Throws if what the expression says is needed to compute what it names.
  void checkCycle(const Signal& signal) const;
  /// Where no units are used at all, time is a plain number as well.
  bool isWithoutUnits(const Expression& rate) const;
  std::vector<std::string> withoutUnit(const Expression& number) const;
  /// Of states and of what is measured; null for any other.
  const std::string* unitOfMeasured(const std::string& name) const;

  std::vector<Described> elements_;
  std::optional<ExpressionVector> gravity_, baseAcceleration_;
  std::unordered_set<std::string> names_, isFrame_;
  std::vector<std::string> frames_, massFrames_;
  Named<Moved, &Moved::frame> moved_;
  std::unordered_map<std::string, std::string> firstFrames_;  // that elements move
  Named<NamedValue> parameters_, initials_;
  Named<Derived> derived_;
  Named<State> positions_, speeds_, ownStates_;
  Named<JointCoordinate> coordinates_;
  std::unordered_map<std::string, std::string> coordinateOfRate_;
  std::unordered_map<std::string, std::vector<std::string>> coordinatesOf_;  // elements
  std::vector<Following> followings_;
  std::vector<std::string> dependents_;  // coordinates
  std::vector<Closed> loops_;
  std::vector<LeftOut> leftOut_;
  struct Nearby {
    std::vector<std::string> freeParameters;
    std::shared_ptr<const Program> offsets;
  };
  Nearby nearby_;
  std::unordered_map<std::string, std::string> struck_;  // coordinates that strike a rigid end: its element
  Named<Measured> measured_;
  std::vector<Length> lengths_;
  std::unordered_map<std::string, std::vector<Signal>> signals_;  // of elements
};

}  // namespace gamut
