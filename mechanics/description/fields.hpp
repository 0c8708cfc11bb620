// The words of an element: what its description consists of, said once by its describe(Fields&) and visited by the
// mechanism, which checks them, by readers of files, which fill them in, and by the documentation.
//
//   void describe(Fields& f) {
//     f.frame({"at", "", "where it acts"}, at);
//     f.number({"coefficient", "N s^2/m^2", "of the drag"}, coefficient);
//   }
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mechanics/axis.hpp"
#include "mechanics/description/expression.hpp"
#include "mechanics/description/time_table.hpp"
#include "mechanics/quaternion.hpp"

namespace gamut {

using ExpressionVector = std::array<Expression, 3>;

/// A fixed rotation: exact right angles plus an angle [rad] about an axis, or that of a quaternion of any length.
struct FixedRotation {
  Axis axis = axisX;
  int quarterTurns = 0;
  Expression angle = 0.0;
  std::string key = {};  ///< of the angle, after the rotation's own; empty: its number, from 1
  std::optional<Quaternion<Expression>> quaternion = std::nullopt;  ///< instead of axis and angle
};

/// How a number's name is written: as ELEMENT.KEY, in SI units.
struct Word {
  std::string key;
  std::string unit = {};     ///< empty for what is no number
  std::string meaning = {};  ///< half a sentence
  bool isRequired = false;
};

/// Names of the components of vectors, quaternions and angles, and of the entries of a symmetric matrix.
inline constexpr std::array<const char*, 3> components = {"x", "y", "z"};
inline constexpr std::array<const char*, 4> quaternionComponents = {"w", "x", "y", "z"};
inline constexpr std::array<const char*, 3> rollPitchYawNames = {"roll", "pitch", "yaw"};
inline constexpr std::array<const char*, 6> symmetricEntries = {"xx", "yy", "zz", "xy", "yz", "zx"};

/// Whether a coordinate turns [rad] or slides [m].
enum class Coordinate { angle, displacement };

/// "rad", "m"
constexpr const char* unitOf(Coordinate kind) { return kind == Coordinate::angle ? "rad" : "m"; }
/// Of the generalised force: "N m", "N".
constexpr const char* forceUnitOf(Coordinate kind) { return kind == Coordinate::angle ? "N m" : "N"; }

/// How a coordinate's motion starts.
struct Start {
  Expression position = 0.0, rate = 0.0;
  bool isRising = false;  ///< its rate is above 0, where everything is nominal
};

/// A point that is fixed to a frame.
struct FixedPoint {
  std::string frame;
  ExpressionVector place = {0.0, 0.0, 0.0};  ///< in that frame [m]
};

/// How an element moves a frame, where that is said by turns and slides: fixed at a place, by rotations, then turned
/// about axes and slid along directions that are fixed in both, one after the other.
struct KnownMotion {
  struct Step {
    bool turns = false, slides = false;
    Axis axis = axisZ;
  };
  ExpressionVector place = {0.0, 0.0, 0.0};  ///< m
  std::vector<FixedRotation> rotation = {};
  std::vector<Step> steps = {};
};

/// What closes on itself: two frames, and by how many equations.
struct Loop {
  std::string from, to;
  std::size_t rows = 0;
  std::size_t redundant = 0;  ///< equations besides, which follow from all others
};

/// What a closure holds: points together along its axis and across it, axes parallel. Without an axis of its own, any.
struct HeldRows {
  bool along = false, across = false, parallel = false;
  std::optional<Axis> axis = std::nullopt;  ///< in the frame of the first point
  Axis toAxis = axisZ;                      ///< that stays parallel to it

  std::size_t count() const { return (along ? 1U : 0U) + (across ? 2U : 0U) + (parallel ? 2U : 0U); }
};

/// How a shape is seen in its own frame: all within `radius` of the middle, of a segment along `axis`, of a box or of a
/// polyhedron.
struct SeenShape {
  Expression radius = 0.0, length = 0.0;  ///< m; the latter of the segment
  Axis axis = axisZ;
  std::optional<ExpressionVector> size = std::nullopt;  ///< of the box, along its edges [m]
  std::vector<ExpressionVector> points = {};            ///< whose hull is the polyhedron [m]
};

/// What of a spring is seen: what is exactly 0 is not.
struct SeenSpring {
  Expression stiffness, damping;
};
struct SeenFriction {
  Expression dry, viscous;
};

class Fields {
 public:
  Fields() = default;
  Fields(const Fields&) = delete;
  Fields& operator=(const Fields&) = delete;
  virtual ~Fields() = default;

  /// A frame that an element before has defined.
  virtual void frame(const Word& word, std::string& name) = 0;
  /// The same; it is not `other`.
  virtual void otherFrame(const Word& word, std::string& name, const std::string& /*other*/) { frame(word, name); }
  /// A frame that this element moves by another.
  virtual void movedFrame(const Word& word, std::string& name, const std::string& from) = 0;
  /// The element moves the frame that it has named like this.
  virtual void movesAs(const KnownMotion& /*motion*/) {}
  /// The element fixes a mass [kg] to a frame, which one of its words has named, with its centre there. `inertia`: its
  /// moments about x, y, z of the frame [kg m²]; empty where they are not told in the frame's axes.
  virtual void carriesMass(const FixedPoint& /*centre*/, const Expression& /*mass*/,
                           std::span<const Expression> /*inertia*/) {}
  /// It is seen as a spring, a damper or both between these ends. What moves a frame and what carries mass is seen as
  /// that.
  virtual void drawsSpring(const FixedPoint& /*from*/, const FixedPoint& /*to*/, const SeenSpring& /*spring*/) {}
  /// The same at a joint, or a motor; `coordinate`: as coordinateOf has it.
  virtual void drawsJointSpring(const std::string& /*coordinate*/, const SeenSpring& /*spring*/) {}
  virtual void drawsMotor(const std::string& /*coordinate*/) {}
  /// Dry and viscous friction at a joint: what is exactly 0 is not seen.
  virtual void drawsFriction(const std::string& /*coordinate*/, const SeenFriction& /*friction*/) {}
  /// A gear between two joints: `follower` moves `ratio` times as `leader`; both as coordinateOf has it.
  virtual void drawsGear(const std::string& /*leader*/, const std::string& /*follower*/, const Expression& /*ratio*/) {}
  /// A plane through a point, and what touches it: a sphere about another point, of radius 0 where it is seen as
  /// something else.
  virtual void drawsPlane(const FixedPoint& /*plane*/, const Axis& /*normal*/, const FixedPoint& /*over*/,
                          const Expression& /*radius*/) {}
  /// The joint as the height of a profile, such as a road, over which the machine goes at this speed [m/s] along a
  /// direction of the frame that carries the joint: what the joint is at a later time lies ahead. A speed of exactly 0
  /// shows none.
  virtual void drawsProfile(const std::string& /*coordinate*/, const Expression& /*speed*/, const Axis& /*along*/) {}
  /// The frame that it moves as a wheel about this axis [m].
  virtual void drawsWheel(const Axis& /*axle*/, const Expression& /*radius*/) {}
  /// As rigid between these points, or as a joint at one of them, of so many freedoms, about or along its jointAxis.
  virtual void drawsLink(const FixedPoint& /*from*/, const FixedPoint& /*to*/) {}
  virtual void drawsJoint(const FixedPoint& /*at*/, int /*turns*/, int /*slides*/) {}
  /// The frame that it moves as a shape, or as what lies off the other within this clearance [m].
  virtual void drawsShape(const SeenShape& /*shape*/) {}
  virtual void drawsPlay(const Expression& /*clearance*/) {}
  /// One of the words.
  virtual void choice(const Word& word, std::string& value, const std::vector<std::string>& choices) = 0;
  /// A direction fixed in the frames.
  virtual void axis(const Word& word, Axis& axis) = 0;
  /// The same; the joint is seen to turn about it, or to slide along it, fixed in this frame.
  virtual void jointAxis(const Word& word, Axis& axis, const std::string& /*frame*/) { this->axis(word, axis); }
  /// Fixed rotations, one after the other; their numbers are KEY.1, KEY.2, … or KEY.roll, KEY.w and the like.
  virtual void rotations(const Word& word, std::vector<FixedRotation>& rotations) = 0;

  /// A whole number from 0 to `most`, which is no quantity.
  virtual void count(const Word& /*word*/, std::size_t& /*number*/, std::size_t /*most*/) {}

  // Numbers that do not change in a motion.
  virtual void number(const Word& word, Expression& number) = 0;
  /// Several of one kind, a list in files: KEY.x …; `least` of them are given.
  virtual void numbers(const Word& word, std::span<Expression> numbers, std::span<const char* const> names,
                       std::size_t least) = 0;
  void vector(const Word& word, ExpressionVector& vector) { numbers(word, vector, components, 3); }

  // States, with their initial values. Positions and speeds of a joint, own states.
  /// A coordinate and, by another key, its rate.
  virtual void coordinate(const Word& position, Expression& initial, Coordinate kind, const Word& rate,
                          Expression& initialRate) = 0;
  /// Three of one kind, a list in files: KEY.x …, and by another key their rates.
  virtual void coordinates(const Word& position, ExpressionVector& initial, Coordinate kind, const Word& rate,
                           ExpressionVector& initialRates);
  /// An orientation at the start, from which positions that are no coordinates begin: `quaternion.w` … `z`, a unit
  /// quaternion; and by another key three speeds, the angular velocity in the axes of the frame that turns.
  virtual void orientation(const Word& word, std::vector<FixedRotation>& initial, const Word& rate,
                           ExpressionVector& initialRates);
  /// A position that is no coordinate (its rate is given by the assembled element), and a speed.
  virtual void position(const Word& word, Expression& initial) = 0;
  virtual void speed(const Word& word, Expression& initial) = 0;
  /// The one state of an element, named like the element; its unit is the word's, or, if that is empty, that of the
  /// initial value. Returns the unit.
  virtual std::string state(const Word& word, Expression& initial) = 0;

  // What refers to motion.
  /// A coordinate of an element before: JOINT, if the joint has just one, or JOINT.KEY. Returns its kind.
  virtual Coordinate coordinateOf(const Word& word, std::string& name) = 0;
  /// The same; from now on it is no state but follows what this element says. Its initial values must not be given.
  virtual Coordinate drivenCoordinate(const Word& word, std::string& name) { return coordinateOf(word, name); }
  /// The same; what it follows is another coordinate, `leader`, and no other coordinate follows it yet.
  virtual Coordinate followingCoordinate(const Word& word, std::string& name, const std::string& /*leader*/) {
    return coordinateOf(word, name);
  }
  /// The same, of one that is a state, with how it starts.
  virtual Coordinate struckCoordinate(const Word& word, std::string& name, Start& /*start*/) {
    return coordinateOf(word, name);
  }
  /// What a closure holds between two points, and, of the mechanism, what of it does not hold anyway.
  virtual void closesBetween(const FixedPoint& /*from*/, const FixedPoint& /*to*/, const HeldRows& /*wanted*/,
                             std::optional<HeldRows>& /*left*/) {}
  /// Coordinates that close a loop between two frames, so many: they follow from the others, and their initial
  /// positions are where the closed position is looked for. Without names
  /// they are those of the loop that stand last, of those without an initial rate where these are enough.
  virtual void dependentCoordinates(const Word& /*word*/, std::vector<std::string>& /*names*/, const Loop& /*loop*/) {}
  /// An expression of time alone and parameters.
  virtual void timeFunction(const Word& word, Expression& number) = 0;
  /// A column of a CSV file over its first, which is time: the words of the file and of the column.
  virtual void table(const Word& /*file*/, const Word& /*column*/, Coordinate /*kind*/, TimeTable& /*table*/) {}
  /// An expression of time, of any states and of all that can be measured; names may be defined by elements behind.
  virtual void signal(const Word& word, Expression& number) = 0;
  virtual void signals(const Word& word, ExpressionVector& vector) = 0;
  /// The same for the rate of an own state, which no force waits for: accelerations and reactions may enter.
  virtual void stateRate(const Word& word, Expression& number) { signal(word, number); }

  /// What can be measured, as NAME.KEY; the assembled element gives the value (Assembler::measure).
  virtual void measure(const Word& word) = 0;
  /// The same of what is known once the equations of motion are solved, an acceleration or a reaction
  /// (Assembler::measureSolved); no load may depend on it.
  virtual void measureSolved(const Word& word) { measure(word); }
  /// The same of what positions and speeds alone tell, and none of the element's expressions, which may name it.
  virtual void measureMotion(const Word& word) { measure(word); }
  /// The same of the length between two points, which lie apart at the start, or its direction is not determined.
  virtual void measureLength(const Word& word) { measure(word); }

  /// Points that are exact, so that nothing about them is uncertain: a list of [x, y, z] in files.
  virtual void points(const Word& /*word*/, std::vector<ExpressionVector>& /*points*/) {}
};

/// A visitor that overlooks what it does not ask for.
class Onlooker : public Fields {
 public:
  void frame(const Word& /*word*/, std::string& /*name*/) override {}
  void movedFrame(const Word& /*word*/, std::string& /*name*/, const std::string& /*from*/) override {}
  void choice(const Word& /*word*/, std::string& /*value*/, const std::vector<std::string>& /*choices*/) override {}
  void axis(const Word& /*word*/, Axis& /*axis*/) override {}
  void rotations(const Word& /*word*/, std::vector<FixedRotation>& /*rotations*/) override {}
  void number(const Word& /*word*/, Expression& /*number*/) override {}
  void numbers(const Word& /*word*/, std::span<Expression> /*numbers*/, std::span<const char* const> /*names*/,
               std::size_t /*least*/) override {}
  void coordinate(const Word& /*position*/, Expression& /*initial*/, Coordinate /*kind*/, const Word& /*rate*/,
                  Expression& /*initialRate*/) override {}
  void position(const Word& /*word*/, Expression& /*initial*/) override {}
  void speed(const Word& /*word*/, Expression& /*initial*/) override {}
  std::string state(const Word& word, Expression& /*initial*/) override { return word.unit; }
  Coordinate coordinateOf(const Word& /*word*/, std::string& /*name*/) override { return Coordinate::angle; }
  void timeFunction(const Word& /*word*/, Expression& /*number*/) override {}
  void signal(const Word& /*word*/, Expression& /*number*/) override {}
  void signals(const Word& /*word*/, ExpressionVector& /*vector*/) override {}
  void measure(const Word& /*word*/) override {}
};

}  // namespace gamut
