// Elementary joints, of which elements are made: where each puts K' in K, and what its speed moves K' by (joint.hpp).
//
//   revolute (axis u, angle β)          A(u, β)   d = 0     s = (u, 0)
//   prismatic (axis u, path p)          A = 1     d = u p   s = (0, u)
//   spherical (quaternion e, rates u)   A(e)      d = 0     s_i = (e_i, 0), e_i the axes of K'
//
// Axes u have the same components in K and K'.
#pragma once

#include <optional>
#include <utility>

#include "mechanics/joint.hpp"

namespace gamut {

/// Turns frame `to` about an axis fixed in both frames: revolute joint, hinge, pin.
template <class S>
class RevoluteJoint final : public Joint<S> {
 public:
  RevoluteJoint(Frame<S>& from, Frame<S>& to, Variable<S>& angle, const Axis& axis)
      : Joint<S>(from, to, {&angle}), angle_(angle), axis_(axis) {}

  Variable<S>& angle() const { return angle_; }
  const Axis& axis() const { return axis_; }

  /// From now on it is turned by an angle of this cosine and sine, so that frame `to` has this orientation, whatever
  /// the variable's position is.
  void standBy(S cosine, S sine, Matrix3<S> orientation) {
    turned_ = Rotation<S>(axis_, std::move(cosine), std::move(sine));
    this->standing_ = std::move(orientation);
  }
  void standByAngle() {
    turned_.reset();
    this->standing_.reset();
  }

 private:
  Place<S> place() const override { return {turned_ ? *turned_ : Rotation<S>(axis_, angle_.position)}; }
  std::vector<Twist<S>> motions() const override { return {{axis_.template unit<S>()}}; }

  Variable<S>& angle_;
  Axis axis_;
  std::optional<Rotation<S>> turned_;
};

/// Slides frame `to` along an axis: prismatic joint, slider.
template <class S>
class PrismaticJoint final : public Joint<S> {
 public:
  PrismaticJoint(Frame<S>& from, Frame<S>& to, Variable<S>& displacement, const Axis& axis)
      : Joint<S>(from, to, {&displacement}), path_(displacement), axis_(axis) {}

  Variable<S>& path() const { return path_; }
  const Axis& axis() const { return axis_; }

 private:
  Place<S> place() const override { return {{}, axis_.template unit<S>() * path_.position}; }
  std::vector<Twist<S>> motions() const override { return {{zeroVector<S>(), axis_.template unit<S>()}}; }

  Variable<S>& path_;
  Axis axis_;
};

/// Turns frame `to` as it likes: spherical joint, ball and socket.
template <class S>
class SphericalJoint final : public Joint<S> {
 public:
  SphericalJoint(Frame<S>& from, Frame<S>& to, Orientation<S> orientation)
      : Joint<S>(from, to, {orientation.speeds.begin(), orientation.speeds.end()}),
        orientation_(std::move(orientation)) {}

 private:
  Place<S> place() const override { return {Rotation<S>(orientation_.value())}; }
  std::vector<Twist<S>> motions() const override { return {{axisX.unit<S>()}, {axisY.unit<S>()}, {axisZ.unit<S>()}}; }

  Orientation<S> orientation_;
};

/// Turns the axes of what moves already, as a ball that rolls does in axes that do not turn with it: by A(e) alone.
template <class S>
class BallAxes final : public Joint<S> {
 public:
  BallAxes(Frame<S>& from, Frame<S>& to, Orientation<S> orientation)
      : Joint<S>(from, to), orientation_(std::move(orientation)) {}

  Rotation<S> rotation() const { return Rotation<S>(orientation_.value()); }

 private:
  Place<S> place() const override { return {rotation()}; }

  Orientation<S> orientation_;
};

GAMUT_COMPILED_ELSEWHERE(RevoluteJoint)
GAMUT_COMPILED_ELSEWHERE(PrismaticJoint)
GAMUT_COMPILED_ELSEWHERE(SphericalJoint)
GAMUT_COMPILED_ELSEWHERE(BallAxes)

}  // namespace gamut
