// What solids of one density weigh, and how they resist turning: enclosures of the formulas.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "studies/robots/robot.hpp"

namespace gamut {

struct Solid {
  enum class Form { sphere, capsule, cylinder, ellipsoid, box };
  Form form = Form::sphere;
  /// m: half sizes; of a sphere its radius; of a capsule (without its ends) and a cylinder, which lie along z, radius
  /// and half length.
  std::array<Interval, 3> size = {0.0, 0.0, 0.0};
};

/// m³
Interval volumeOf(const Solid& solid);
/// About axes x, y, z through its centre, of 1 kg: m².
std::array<Interval, 3> momentsOf(const Solid& solid);

/// Of one body, made of such parts.
class Composed {
 public:
  /// `places`: the centre and axes of a solid in the body, one place behind the other.
  void add(const Interval& mass, const Solid& solid, const std::vector<Robot::Place>& places);
  /// The same of one that lies along a line, and is alike about it.
  void add(const Interval& mass, const Solid& solid, const std::array<Interval, 3>& centre,
           const std::array<Interval, 3>& along, const std::vector<Robot::Place>& places);
  /// Centre and inertia in axes of the body; none of what weighs nothing.
  std::optional<Robot::Inertial> inertial() const;

 private:
  struct Part {
    Interval mass;
    std::array<Interval, 3> centre;
    std::array<Interval, 6> inertia;  ///< about it, xx, yy, zz, xy, yz, zx, in axes of the body
  };
  void add(const Interval& mass, std::array<Interval, 3> centre, std::array<Interval, 6> inertia,
           const std::vector<Robot::Place>& places);

  std::vector<Part> parts_;
};

}  // namespace gamut
