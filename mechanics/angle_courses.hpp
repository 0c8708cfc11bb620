// Which of all angles with the same direction a joint's is.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gamut {

/// What the angle of a joint is never half a turn away from: `middle` [rad] and so many times angles that drives give.
struct AngleCourse {
  double middle = 0;
  std::vector<std::pair<std::string, int>> turns;  ///< coordinates
};
/// By coordinate.
using AngleCourses = std::map<std::string, AngleCourse, std::less<>>;

}  // namespace gamut
