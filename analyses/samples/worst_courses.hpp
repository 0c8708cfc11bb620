// Courses that are worst: of what varies freely, an output is greatest at a time along a course that switches from end
// to end where the output's adjoint changes its sign (Pontryagin), and of affine motions there is no other. Where a
// motion is not affine, forward and backward sweeps seek one, each linear about the one before: the best is a witness
// as any other, and may not be the worst of all. Quantities that are constant, or bounded in rate, are at an end of
// their interval meanwhile, by the sign of the output's derivative.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "analyses/samples/ensemble.hpp"

namespace gamut {

struct WorstCourseOptions {
  std::vector<std::size_t> outputs;  ///< that are to be greatest, and least
  std::size_t most = 256;            ///< courses
  double budget = 1024;              ///< in works (analyses/work.hpp) of one motion: for these and their samples
  double fastest = 0;                ///< as of withCourses, rad/s
  Method method = Method::adams;
  int jobs = 1;                                  ///< threads
  const std::atomic<bool>* cancelled = nullptr;  ///< set from outside to end early, with none
};

/// Values of the quantities, of those that vary numberOfSwitching, and their courses.
struct WorstCourse {
  std::vector<double> values;
  std::vector<SwitchingCourse> courses;  ///< of system.switching.quantities
};

/// Of output times that are spread over the motion, the last first; of all of them if `most` and `budget` allow that.
/// What `system.switching` says of courses plays no part. None where equations jump, or nothing varies freely.
std::vector<WorstCourse> worstCourses(const UncertainMotion& system, const WorstCourseOptions& options);

}  // namespace gamut
