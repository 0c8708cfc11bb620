// A coordinate frame K of a mechanism and everything that is transmitted through it. All vectors are resolved in the
// LOCAL frame K, as MOBILE stores them (Auer, Rauh, Hofer, Luther, LNCS 5045, 2008, eq. 30).
#pragma once

#include <string>
#include <utility>

#include "mechanics/algebra.hpp"

namespace gamut {

template <class S>
class Transmission;

/// A point with its velocity, both with components in one frame [m, m/s].
template <class S>
struct MovingPoint {
  Vector3<S> position = zeroVector<S>();
  Vector3<S> velocity = zeroVector<S>();
};

/// The axes of a frame, as columns with components in another one, and its angular velocity against that [rad/s].
template <class S>
struct TurningAxes {
  Matrix3<S> axes = unitMatrix<S>();
  Vector3<S> omega = zeroVector<S>();
};

template <class S>
struct Frame {
  Frame() { R << S(1.0), S(0.0), S(0.0), S(0.0), S(1.0), S(0.0), S(0.0), S(0.0), S(1.0); }
  /// `frameName` is used in messages.
  explicit Frame(std::string frameName) : Frame() { name = std::move(frameName); }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  Matrix3<S> R;                           ///< orientation: components in K to components in the inertial frame
  Vector3<S> r = zeroVector<S>();         ///< position of the origin [m]; R r in the inertial frame
  Vector3<S> omega = zeroVector<S>();     ///< angular velocity [rad/s]
  Vector3<S> v = zeroVector<S>();         ///< velocity of the origin [m/s]
  Vector3<S> omegaDot = zeroVector<S>();  ///< angular acceleration [rad/s²]
  Vector3<S> a =
      zeroVector<S>();  ///< acceleration of the origin [m/s²]; while forces are sought, gravity is in it as −g
  Vector3<S> f = zeroVector<S>();           ///< force that acts on the frame [N]
  Vector3<S> tau = zeroVector<S>();         ///< moment about the origin that acts on the frame [N m]
  const Transmission<S>* origin = nullptr;  ///< the element that moves this frame; none for the inertial frame
  std::string name = "frame";

  /// A point that moves with, or in, this frame, as the inertial frame sees it. Carried inwards element by element, it
  /// needs fewer operations, and gives tighter intervals, than R (r + x).
  MovingPoint<S> inInertial(MovingPoint<S> point) const;
  Vector3<S> positionInInertial() const { return inInertial({}).position; }
  Vector3<S> velocityInInertial() const { return inInertial({}).velocity; }

  void clearForces() {
    f = zeroVector<S>();
    tau = zeroVector<S>();
  }
};

}  // namespace gamut
