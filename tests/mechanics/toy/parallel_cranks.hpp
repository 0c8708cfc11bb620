// A joint that the library does not have: all of it, words and motion, is in this file. Two parallel cranks of one
// length carry a frame along a circle without turning it, as a swing boat's gallows do.
#pragma once

#include <cmath>
#include <string>

#include "mechanics/assembler.hpp"
#include "mechanics/joint.hpp"

namespace gamut::testing {

/// About x, by the angle β of cranks of length l: A = 1, d = l (0, sin β, −cos β), s = (0, l (0, cos β, sin β)).
template <class S>
class ParallelCranksJoint final : public Joint<S> {
 public:
  ParallelCranksJoint(Frame<S>& from, Frame<S>& to, Variable<S>& angle, S length)
      : Joint<S>(from, to, {&angle}), angle_(angle), length_(std::move(length)) {}

 private:
  /// l (0, cos β, sin β), turned by a right angle backwards.
  Vector3<S> across() const {
    using std::cos, std::sin;
    return {S(0.0), length_ * S(sin(angle_.position)), -(length_ * S(cos(angle_.position)))};
  }
  Place<S> place() const override { return {{}, across()}; }
  std::vector<Twist<S>> motions() const override {
    const Vector3<S> d = across();
    return {{zeroVector<S>(), {S(0.0), -d[2], d[1]}}};
  }
  /// s changes with β.
  Twist<S> bias(const Vector3<S>& carried, const Twist<S>& own) const override {
    Twist<S> b = Joint<S>::bias(carried, own);
    b.linear -= across() * S(square(angle_.rate));
    return b;
  }

  Variable<S>& angle_;
  S length_;
};

struct ParallelCranks {
  static constexpr const char* type = "parallel-cranks";
  static constexpr const char* summary = "two parallel cranks about x: `to` moves on a circle, but does not turn";

  std::string name, from, to;
  Expression length = 0.0;             ///< m
  Expression angle = 0.0, rate = 0.0;  ///< initial values [rad, rad/s]

  void describe(Fields& f) {
    f.frame({"from", "", "the frame that carries the cranks"}, from);
    f.movedFrame({"to", "", "the frame that they carry"}, to, from);
    f.number({"length", "m", "of both cranks", true}, length);
    f.coordinate({"angle", "rad", "at the start; 0 where they hang down"}, angle, Coordinate::angle,
                 {"rate", "rad/s", "at the start"}, rate);
  }
  template <class S>
  void assemble(Assembler<S>& a) const {
    a.template add<ParallelCranksJoint<S>>(a.frame(from), a.frame(to), a.variable("angle"), a.number(length));
  }
};

}  // namespace gamut::testing
