// Courses of what varies in time that switch, and the motions along them.
#pragma once

#include <vector>

#include "analyses/flow/flow.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {

/// One course of the inputs: constant from each time on to the next.
struct Course {
  std::vector<double> from{0.0};
  std::vector<Vector> values;  // of all parameters

  const Vector& at(double time) const {
    std::size_t i = 0;
    while (i + 1 < from.size() && from[i + 1] <= time) ++i;
    return values[i];
  }
};

/// States at `times` of an autonomous program along a course.
inline std::vector<Vector> follow(const Program& f, Vector x, const Course& course, const std::vector<double>& times) {
  Reference reference(f);
  std::vector<Vector> result;
  for (std::size_t i = 0; i < course.from.size() && result.size() < times.size(); ++i) {
    const bool isLast = i + 1 == course.from.size();
    std::vector<double> here;
    while (result.size() + here.size() < times.size() &&
           (isLast || times[result.size() + here.size()] < course.from[i + 1]))
      here.push_back(times[result.size() + here.size()] - course.from[i]);
    if (!isLast) here.push_back(course.from[i + 1] - course.from[i]);
    Vector start = x;
    start.insert(start.end(), course.values[i].begin(), course.values[i].end());
    std::vector<Vector> ends = reference(start, here);
    if (!isLast) {
      x = ends.back();
      ends.pop_back();
    }
    result.insert(result.end(), ends.begin(), ends.end());
  }
  return result;
}

/// Random switching: inputs at an end or anywhere in their interval, other parameters constant. Times are dyadic, so
/// that differences of them are exact.
inline Course switching(const Box& box, int states, const std::vector<VaryingParameter>& inputs, double horizon,
                        int switches, Points& points) {
  Course course;
  const Vector start = points.inside(box);
  Vector parameters(start.begin() + states, start.end());
  for (int i = 0; i <= switches; ++i) {
    if (i > 0) course.from.push_back(horizon * i / 1024 * (1024 / (switches + 1)));
    const Vector other = points.integer(0, 3) == 0 ? points.inside(box) : points.corner(box);
    for (const VaryingParameter& input : inputs)
      parameters[static_cast<std::size_t>(input.parameter)] = other[static_cast<std::size_t>(states + input.parameter)];
    course.values.push_back(parameters);
  }
  return course;
}

}  // namespace gamut::testing
