// Courses of what varies in time, for samples: the one number that is drawn of such a quantity chooses one of many
// courses within its interval, from a steady push over swinging to and fro (band-limited, of slowly turning phase) to
// switching from end to end. A witness of what may happen, not a bound.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

struct VaryingQuantity {
  int parameter = 0;  ///< of the programs: where the number that is drawn stands
  Interval range;
  double nominal = 0;                                     ///< chooses the constant course of this value
  double rate = std::numeric_limits<double>::infinity();  ///< bound of |ẇ|, per s
};

/// The program with the courses in place of these parameters. Every course stays in its interval and below its rate; a
/// number at an end of the interval chooses the constant course of that value. Frequencies between `slowest` and
/// `fastest`, rad/s.
Program withCourses(const Program& program, const std::vector<VaryingQuantity>& varying, double slowest,
                    double fastest);

/// A course that is constant from each of these times [s] on until the next; the first is 0.
struct SwitchingCourse {
  std::vector<double> from, values;

  double at(double t) const;
};

/// The program with switching courses in place of these parameters.
Program withSwitching(const Program& program, const std::vector<std::pair<int, SwitchingCourse>>& courses);

/// Numbers beyond the interval choose switching courses, this one the course `which`.
double numberOfSwitching(const Interval& range, std::size_t which);
/// Whether these are distinct: not where an interval is hardly more than a number.
bool canSwitch(const Interval& range);

/// The greatest |eigenvalue| of ∂f/∂x at t = 0, x and p, rad/s: how fast the motion itself turns.
double fastestTurn(const Program& f, const std::vector<double>& start);

}  // namespace gamut
