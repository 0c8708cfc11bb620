// Rows that close loops between two frames: a point that stays where another is along some directions, axes that stay
// at right angles, a distance that stays. With d what the point of `to` is from that of `from`, all as the inertial
// frame sees it, e a direction fixed in `from`, a and b axes fixed in one of both:
//
//   g = e·d        ġ = e·ḋ + ė·d         g̈ = e·d̈ + 2 ė·ḋ + ë·d      (ė = ω × e, ë = ω̇ × e + ω × ė)
//   g = a·b        ġ = (ω_a − ω_b)·(a × b)
//   g = (d·d − l²)/2l                    (a rod without mass)
//
// Source: E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989, section 9.4.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "mechanics/axis.hpp"
#include "mechanics/element.hpp"
#include "mechanics/rotation.hpp"
#include "mechanics/seen.hpp"

namespace gamut {

/// A point fixed to a frame [m, axes of the frame], with its motion as the inertial frame sees it.
template <class S>
struct CarriedPoint {
  Frame<S>* frame;
  Vector3<S> place;

  MovingPoint<S> inInertial() const { return frame->inInertial({place, zeroVector<S>()}); }
  /// Beyond the origin of a frame that it hangs on; at MotionLevel::acceleration, without what velocities add.
  Vector3<S> acceleration(const Frame<S>* base, MotionLevel level) const {
    const Frame<S>* at = frame;
    Vector3<S> sum =
        at->R * (level == MotionLevel::all ? Vector3<S>(offsetAcceleration(at->omega, at->omegaDot) * place)
                                           : Vector3<S>(at->omegaDot.cross(place)));
    for (; at != base; at = &at->origin->from()) sum += at->origin->from().R * at->origin->accelerationBeyond(level);
    return sum;
  }
  /// A force [N, inertial axes] that acts there, or `beyond` it [m, inertial axes].
  void push(const Vector3<S>& force, const Vector3<S>& beyond = zeroVector<S>()) const {
    const Vector3<S> own = frame->R.transpose() * force;
    frame->f += own;
    frame->tau += place.cross(own) + frame->R.transpose() * Vector3<S>(beyond.cross(force));
  }
};

/// By how much the second of two points is accelerated beyond the first, in inertial axes: with nothing of what both
/// hang on.
template <class S>
Vector3<S> accelerationBetween(const CarriedPoint<S>& from, const CarriedPoint<S>& to, MotionLevel level) {
  const Frame<S>* base = commonBase<S>(from.frame, to.frame);
  return to.acceleration(base, level) - from.acceleration(base, level);
}

/// A direction that moves with a frame, with its first and second derivative in time, in inertial axes.
template <class S>
struct CarriedAxis {
  Vector3<S> value, rate, acceleration;

  CarriedAxis(const Frame<S>& frame, const Vector3<S>& axis, MotionLevel level) {
    value = frame.R * axis;
    const Vector3<S> turned = frame.omega.cross(axis);
    rate = frame.R * turned;
    Vector3<S> second = frame.omegaDot.cross(axis);
    if (level == MotionLevel::all) second += frame.omega.cross(turned);
    acceleration = frame.R * second;
  }
};

template <class S>
class Closing final : public Constraint<S> {
 public:
  /// Axes given in `from` and in `to` that stay at right angles.
  using RightAngle = std::pair<Vector3<S>, Vector3<S>>;

  /// `directions`: given in `from`, unit vectors along which both points stay together: along `axis`, across it, or
  /// both.
  Closing(CarriedPoint<S> from, CarriedPoint<S> to, std::vector<Vector3<S>> directions,
          std::vector<RightAngle> rightAngles, Axis axis)
      : from_(std::move(from)),
        to_(std::move(to)),
        directions_(std::move(directions)),
        rightAngles_(std::move(rightAngles)),
        axis_(axis) {}

  std::vector<S> allResiduals() const override {
    std::vector<S> rows;
    const Vector3<S> d = motion().position;
    for (const Vector3<S>& e : directions_) rows.push_back(turned(e).dot(d));
    for (const auto& [a, b] : rightAngles_)
      rows.push_back(Vector3<S>(from_.frame->R * a).dot(Vector3<S>(to_.frame->R * b)));
    return rows;
  }

  /// So many rows that are not left out, the first, are lengths [m]; others are sines of how far angles are off.
  std::size_t lengths() const {
    const std::size_t all = directions_.size();
    return all - static_cast<std::size_t>(
                     std::ranges::count_if(this->leftOut(), [all](std::size_t row) { return row < all; }));
  }

  std::vector<S> allRates() const override {
    std::vector<S> rows;
    const auto [d, rate] = motion();
    for (const Vector3<S>& e : directions_) {
      S row = turned(e).dot(rate);
      if (!isInertial()) row += CarriedAxis<S>(*from_.frame, e, MotionLevel::position).rate.dot(d);
      rows.push_back(std::move(row));
    }
    for (const auto& [a, b] : rightAngles_) {
      const CarriedAxis<S> first(*from_.frame, a, MotionLevel::position), second(*to_.frame, b, MotionLevel::position);
      rows.push_back(first.rate.dot(second.value) + first.value.dot(second.rate));
    }
    return rows;
  }

  std::vector<S> allAccelerations(MotionLevel level) const override {
    std::vector<S> rows;
    const bool isWhole = level == MotionLevel::all;
    const Vector3<S> second = accelerationBetween(from_, to_, level);
    const auto [d, rate] = motion();
    for (const Vector3<S>& e : directions_) {
      S row = turned(e).dot(second);
      if (!isInertial()) {
        const CarriedAxis<S> moving(*from_.frame, e, level);
        row += moving.acceleration.dot(d);
        if (isWhole) row += S(2.0) * S(moving.rate.dot(rate));
      }
      rows.push_back(std::move(row));
    }
    for (const auto& [a, b] : rightAngles_) {
      const CarriedAxis<S> first(*from_.frame, a, level), other(*to_.frame, b, level);
      S row = first.acceleration.dot(other.value) + first.value.dot(other.acceleration);
      if (isWhole) row += S(2.0) * S(first.rate.dot(other.rate));
      rows.push_back(std::move(row));
    }
    return rows;
  }

  std::vector<std::string> rowNames() const override {
    std::vector<std::string> names;
    const std::array<std::string, 3> letters = {"x", "y", "z"};
    const auto named = [&](std::size_t after) {
      return axis_.isAligned() ? letters[(static_cast<std::size_t>(axis_.index()) + after) % 3]
             : after == 0      ? std::string("the axis")
                               : "the " + std::string(after == 1 ? "first" : "second") + " direction across the axis";
    };
    const bool hasAlong = directions_.size() != 2;
    for (std::size_t i = 0; i < directions_.size(); ++i)
      names.push_back("places along " + named(i + (hasAlong ? 0 : 1)));
    for (std::size_t i = 0; i < rightAngles_.size(); ++i) names.push_back("the axis across " + named(i + 1));
    return names;
  }

  /// Whether it keeps both points together across its axis, and nothing else.
  bool isPin() const { return directions_.size() == 2 && rightAngles_.empty(); }
  const Axis& axis() const { return axis_; }
  std::array<CarriedPoint<S>, 2> ends() const { return {from_, to_}; }

  /// Force [N] and moment [N m] on `to`, about its point, in inertial axes, of the last motion that was solved for.
  Vector3<S> force() const {
    Vector3<S> sum = zeroVector<S>();
    for (std::size_t i = 0; i < directions_.size(); ++i) sum += turned(directions_[i]) * this->multipliers()[i];
    return sum;
  }
  Vector3<S> moment() const {
    Vector3<S> sum = zeroVector<S>();
    for (std::size_t i = 0; i < rightAngles_.size(); ++i) {
      const Vector3<S> a = from_.frame->R * rightAngles_[i].first, b = to_.frame->R * rightAngles_[i].second;
      sum += b.cross(a) * this->multipliers()[directions_.size() + i];
    }
    return sum;
  }

 private:
  MovingPoint<S> motion() const {
    const MovingPoint<S> one = from_.inInertial(), other = to_.inInertial();
    return {other.position - one.position, other.velocity - one.velocity};
  }
  Vector3<S> turned(const Vector3<S>& e) const { return isInertial() ? e : Vector3<S>(from_.frame->R * e); }

  /// Whether directions may be those of the inertial frame, which say the same: where they are all three, and where
  /// `from` is known to turn about the axis alone, as in planar loops.
  bool isInertial() const {
    if (directions_.size() == 3) return true;
    if (!this->leftOut().empty()) return false;  // so that a row is the same one for every scalar
    if constexpr (std::is_same_v<S, Recorded>) {
      const Matrix3<S>& r = from_.frame->R;
      const auto isKnown = [&](int i) {
        return Recorder::current()->isExactly(r(i, axis_.index()).node(), i == axis_.index() ? 1.0 : 0.0);
      };
      return axis_.isAligned() && isKnown(0) && isKnown(1) && isKnown(2);
    }
    return false;
  }

  void applyForce() override {
    const Vector3<S> push = force();
    to_.push(push);
    // Directions that move with `from` work on it where the point of `to` is.
    from_.push(-push, isInertial() ? zeroVector<S>() : motion().position);
    if (rightAngles_.empty()) return;
    const Vector3<S> turn = moment();
    to_.frame->tau += to_.frame->R.transpose() * turn;
    from_.frame->tau -= from_.frame->R.transpose() * turn;
  }

  CarriedPoint<S> from_, to_;
  std::vector<Vector3<S>> directions_;
  std::vector<RightAngle> rightAngles_;
  Axis axis_;
};

/// A rod without mass between two points.
template <class S>
class Rod final : public Constraint<S> {
 public:
  Rod(CarriedPoint<S> from, CarriedPoint<S> to, S length)
      : from_(std::move(from)), to_(std::move(to)), length_(std::move(length)) {}

  std::vector<S> allResiduals() const override {
    const Vector3<S> d = motion().position;
    return {(d.dot(d) - square(length_)) / (S(2.0) * length_)};
  }
  std::vector<S> allRates() const override {
    const MovingPoint<S> d = motion();
    return {d.position.dot(d.velocity) / length_};
  }
  std::vector<S> allAccelerations(MotionLevel level) const override {
    const MovingPoint<S> d = motion();
    S row = d.position.dot(accelerationBetween(from_, to_, level));
    if (level == MotionLevel::all) row += d.velocity.dot(d.velocity);
    return {row / length_};
  }
  std::vector<std::string> rowNames() const override { return {"its length"}; }
  std::array<CarriedPoint<S>, 2> ends() const { return {from_, to_}; }
  const S& length() const { return length_; }
  /// By which the rod pushes its ends apart [N], of the last motion that was solved for.
  S push() const { return this->multipliers().front(); }

 private:
  MovingPoint<S> motion() const {
    const MovingPoint<S> one = from_.inInertial(), other = to_.inInertial();
    return {other.position - one.position, other.velocity - one.velocity};
  }
  void applyForce() override {
    const Vector3<S> force = motion().position * S(push() / length_);
    to_.push(force);
    from_.push(-force);
  }

  CarriedPoint<S> from_, to_;
  S length_;
};

}  // namespace gamut
