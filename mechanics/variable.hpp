// What moves a joint: speeds, with the generalised forces that work on them, positions and orientations.
#pragma once

#include <array>
#include <string>
#include <utility>

#include "mechanics/algebra.hpp"
#include "mechanics/quaternion.hpp"

namespace gamut {

/// A generalised speed u with its acceleration u̇ and its generalised force Q (power Q u): what equations of motion are
/// about.
template <class S>
struct Speed {
  Speed() = default;
  /// `speedName` is used in messages.
  explicit Speed(std::string speedName) : name(std::move(speedName)) {}
  Speed(const Speed&) = delete;
  Speed& operator=(const Speed&) = delete;

  /// The sign of the rate. A multiple of another speed has that one's, and the multiple's own: so all friction of a
  /// linkage with one freedom jumps with one sign.
  S direction() const { return leader == nullptr ? signOf(rate) : S(signOf(ratio) * signOf(leader->rate)); }

  S rate = S(0.0);
  S acceleration = S(0.0);
  S force = S(0.0);
  std::string name;
  /// Where the rate is known to be a multiple of that of an independent speed: rate = ratio · leader->rate.
  const Speed* leader = nullptr;
  S ratio = S(1.0);
};

/// A coordinate q whose rate is its speed, q̇ = u: an angle [rad, rad/s, rad/s², N m] or a displacement [m, m/s, m/s²,
/// N].
template <class S>
struct Variable : Speed<S> {
  using Speed<S>::Speed;

  S position = S(0.0);
};

/// In whose axes an angular velocity has its components: of the frame that turns, or of that which it turns against.
enum class RatesIn { to, from };

/// An orientation by a unit quaternion e with three speeds u, the angular velocity: ė = ½ e ∘ (0, u) of those in the
/// axes of the frame that turns, ½ (0, u) ∘ e of those in the other's. No position of it is singular; |e| does not
/// change, whatever u is.
template <class S>
struct Orientation {
  Quaternion<S*> quaternion;
  std::array<Speed<S>*, 3> speeds;
  RatesIn in = RatesIn::to;

  Vector3<S> rate() const { return {speeds[0]->rate, speeds[1]->rate, speeds[2]->rate}; }
  Vector3<S> acceleration() const {
    return {speeds[0]->acceleration, speeds[1]->acceleration, speeds[2]->acceleration};
  }
  Quaternion<S> value() const { return {*quaternion[0], *quaternion[1], *quaternion[2], *quaternion[3]}; }
  S quaternionRate(std::size_t i) const {
    const Vector3<S> u = rate();
    const Quaternion<S> turning{S(0.0), u[0], u[1], u[2]};
    return S(0.5) * (in == RatesIn::to ? product(value(), turning) : product(turning, value()))[i];
  }
};

}  // namespace gamut
