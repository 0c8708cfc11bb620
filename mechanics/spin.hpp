// Bodies that spin about their own axis of symmetry, stated ahead of their spin.
//
// A joint turns frame K into K' about u by β. Let K° move as K' does, in the axes that K has:
//
//   ω° = ω + u β̇   v° = v   ω̇° = ω̇ + ω × u β̇ + u β̈   a° = a      f += f°   τ += τ°   Q += u·τ°
//
// These are the joint's equations with A = 1 (joint.hpp). A body that is the same however it is turned about u has the
// same centre and the same inertia in K° as in K': fixed to K° it moves as it did, and β is in none of its equations.
// In K' it is there twice, as A and Aᵀ, which only cos² + sin² = 1 takes out again: bounds do not see that.
//
// So it is done wherever every body behind a joint is such a body, through links along the axis and further joints
// about it, as rotors, shafts, wheels and planets of gears are; and of balls that roll (elements/rolling_ball.hpp),
// about all axes. A load on that axis may come along (load_on_axis.hpp); what else is behind, loads and frames that are
// looked at, keeps its frames, which move as before.
#pragma once

#include <deque>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mechanics/element.hpp"
#include "mechanics/joints.hpp"
#include "mechanics/rotation.hpp"

namespace gamut {

/// Spins frame `to` about an axis, but for its axes, which stay parallel to those of `from`.
template <class S>
class SpinningJoint final : public Joint<S> {
 public:
  SpinningJoint(Frame<S>& from, Frame<S>& to, Variable<S>& angle, const Axis& axis)
      : Joint<S>(from, to, {&angle}), axis_(axis) {}

 private:
  Place<S> place() const override { return {}; }
  std::vector<Twist<S>> motions() const override { return {{axis_.template unit<S>()}}; }

  Axis axis_;
};

/// K° of a frame K' that spins: its axes become those of K' by turns about `axis`, by these variables and signs; or, of
/// a ball that rolls, by those of the ball.
template <class S>
struct Unturned {
  Frame<S>* frame;
  Axis axis;
  std::vector<std::pair<const Variable<S>*, double>> turns;
  const BallAxes<S>* ball = nullptr;

  /// A vector of K° in the axes of K'.
  Vector3<S> turned(const Vector3<S>& x) const {
    if (ball != nullptr) return ball->rotation().toChild(x);
    S angle(0.0);
    for (const auto& [variable, sign] : turns) angle = angle + S(sign) * variable->position;
    return Rotation<S>(axis, angle).toChild(x);
  }
};

/// States bodies ahead of their spin, where it is known that they are symmetric: adds parts and frames, and gives each
/// frame that bodies were taken from its K°. What acts on K° acts on K' too.
std::unordered_map<const Frame<Recorded>*, Unturned<Recorded>> stateAheadOfSpin(
    std::vector<std::unique_ptr<Element<Recorded>>>& parts, std::deque<Frame<Recorded>>& frames);

}  // namespace gamut
