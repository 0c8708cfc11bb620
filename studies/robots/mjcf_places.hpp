// How MJCF says where things stand: by one of five ways to say an orientation.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "studies/robots/mjcf_attributes.hpp"
#include "studies/robots/robot.hpp"

namespace gamut {

/// What <compiler> says of angles.
struct MjcfAngles {
  bool inDegrees = true;
  std::string order = "xyz";  ///< of Euler angles, about axes that turn along; in capitals about axes that stay

  const char* unit() const { return inDegrees ? "deg" : ""; }
};

bool isExactlyZero(const Interval& x);
/// |v|²
Interval squareOf(const std::array<Interval, 3>& v);

/// By 'pos', 'quat', 'axisangle', 'xyaxes', 'zaxis' and 'euler'. Throws StudyError.
Robot::Place placeOf(const MjcfAttributes& attributes, const MjcfAngles& angles);

/// Of the attribute of this name. Throws StudyError for the zero vector.
Axis directionIn(const MjcfAttributes& attributes, const std::string& name, const std::vector<std::string>& decimals);

/// The least turn of z to a direction of any length above 0.
Robot::Turn turnOfZ(const std::array<Interval, 3>& direction);

}  // namespace gamut
