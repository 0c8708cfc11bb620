// The axes of joints and rotations. Without Eigen, which a description does not need.
#pragma once

#include <array>

#include "scalars/interval.hpp"

namespace gamut {

/// A direction fixed in a frame: a coordinate axis with a sign, or any other direction, normalised when it is used.
class Axis {
 public:
  /// The direction of (x, y, z), of any length. Throws std::invalid_argument for the zero vector and for components
  /// that are not finite.
  Axis(double x, double y, double z);

  /// True for ±x, ±y, ±z.
  bool isAligned() const { return index_ >= 0; }
  /// 0, 1, 2 for an aligned axis.
  int index() const { return index_; }
  /// 1 or -1: the side of the coordinate axis to which an aligned axis points; 1 for any other.
  double sign() const { return sign_; }

  /// Whether both are on one line: exactly, but for products that leave the range of doubles.
  bool isParallelTo(const Axis& other) const;

  /// As it was given, a direction of any length; of an aligned axis the unit vector.
  std::array<double, 3> direction() const;
  /// Of `direction()`.
  Interval length() const;
  /// The unit vector, its components exact if aligned, enclosed otherwise.
  std::array<Interval, 3> enclosure() const;
  /// The same as a Vector3<S>. Defined in rotation.hpp.
  template <class S>
  auto unit() const;

 private:
  std::array<double, 3> direction_;
  int index_ = -1;
  double sign_ = 1;
};

inline const Axis axisX(1, 0, 0);
inline const Axis axisY(0, 1, 0);
inline const Axis axisZ(0, 0, 1);

}  // namespace gamut
