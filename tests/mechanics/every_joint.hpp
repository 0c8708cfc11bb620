// Machines with one joint of any type, whatever its words are: what the laws of joints (joint_laws_test.cpp) are stated
// of. A new type of joint needs nothing here.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/elements/all.hpp"

namespace gamut::testing {

/// Fills in the words of an element that joins the frames "seat" and "moved": numbers that shrink, so that later
/// radii fit into earlier ones, and these axes, one after the other.
class FilledIn final : public Onlooker {
 public:
  explicit FilledIn(std::vector<Axis> axes) : axes_(std::move(axes)) {}

  bool movesFrame = false, refersToOthers = false;

  void frame(const Word&, std::string& name) override { name = "seat"; }
  /// A shape's own frame, which has its name, is fixed and for measurements.
  void movedFrame(const Word& word, std::string& name, const std::string&) override {
    if (word.key == "name") return;
    name = "moved";
    movesFrame = true;
  }
  void choice(const Word&, std::string& value, const std::vector<std::string>& choices) override { value = choices[0]; }
  void axis(const Word&, Axis& axis) override { axis = axes_[used_++ % axes_.size()]; }
  void rotations(const Word&, std::vector<FixedRotation>& rotations) override {
    rotations = {{Axis(1, 2, -2), 0, 0.4}, {axisX, 1, 0.3}};
  }
  void number(const Word&, Expression& number) override { number = next(); }
  void numbers(const Word&, std::span<Expression> numbers, std::span<const char* const>, std::size_t) override {
    for (Expression& number : numbers) number = next();
  }
  Coordinate coordinateOf(const Word&, std::string&) override {
    refersToOthers = true;
    return Coordinate::angle;
  }

 private:
  double next() { return size_ /= 2; }

  std::vector<Axis> axes_;
  std::size_t used_ = 0;
  double size_ = 1.25;
};

/// What such a machine has besides its joint.
enum class Around {
  fixed,      ///< `seat` is turned against the inertial frame; the body is of any shape
  free,       ///< `seat` is on a body that moves as it likes
  symmetric,  ///< as `free`; the body behind the joint is the same about all axes, and stated ahead of its spin
};
inline constexpr Around everySurrounding[] = {Around::fixed, Around::free, Around::symmetric};

inline const char* nameOf(Around around) {
  return around == Around::fixed ? "Fixed" : around == Around::free ? "Free" : "Symmetric";
}

/// Whether the type moves a frame by another: joints, links and welds.
inline bool isJoint(Described type) {
  FilledIn words({axisX});
  type.describe(words);
  return words.movesFrame && !words.refersToOthers;
}

inline std::vector<Described> jointTypes(const std::vector<Described>& types = elementTypes()) {
  std::vector<Described> joints;
  std::ranges::copy_if(types, std::back_inserter(joints), isJoint);
  return joints;
}

/// A joint of this type, its axes as oblique as it takes them.
inline Described filledIn(const Described& type, const Mechanism& mechanism) {
  for (const std::vector<Axis>& axes :
       {std::vector{Axis(1, 2, -2), Axis(2, -1, 2)}, std::vector{Axis(0, -1, 0), axisX}}) {
    Described joint = type;
    FilledIn words(axes);
    joint.describe(words);
    joint.setName("joint");
    Mechanism trial = mechanism;
    trial.add(joint);
    if (trial.faults(trial.elements().back(), {}).empty()) return joint;
  }
  throw std::logic_error("no axes fit the joint " + type.type());
}

/// The joint in its surroundings; behind it are a body, a link and a hinge with another one.
inline Mechanism machineWith(const Described& type, Around around) {
  const std::array<Expression, 6> inertia{0.1, 0.2, 0.25, 0.01, -0.02, 0.03};
  Mechanism m;
  std::string trunk = Mechanism::inertialFrame;
  if (around != Around::fixed) {
    m.add(Free{"trunk", Mechanism::inertialFrame, "T"});
    m.add(Mass{"trunkBody", "T", 2.0, {0.1, -0.2, 0.3}, inertia});
    trunk = "T";
  }
  m.add(Link{"base", trunk, "seat", {0.2, -0.1, 0.4}, {{Axis(1, 2, -2), 0, 0.4}}});
  m.add(filledIn(type, m));
  if (around == Around::symmetric) {
    m.add(Mass{"body", "moved", 1.5, {0.0, 0.0, 0.0}, {0.25, 0.25, 0.25, 0.0, 0.0, 0.0}});
  } else {
    m.add(Mass{"body", "moved", 1.5, {0.05, -0.1, 0.2}, inertia});
    m.add(Link{"rod", "moved", "end", {0.3, 0.1, -0.4}, {{axisY, 0, 0.7}}});
    m.add(Revolute{"hinge", "end", "tip", axisZ});
    m.add(Mass{"tipBody", "tip", 0.5, {0.1, 0.0, 0.2}, inertia});
  }
  m.setGravity({0.5, -1.0, -9.0});
  return m;
}

}  // namespace gamut::testing
