// Samples on courses that are worst for some output at some time, of what varies freely: drawn ones hardly come near.
// How many there are does not depend on how many are drawn, so that an extension has the same.
#include "analyses/samples/worst_courses.hpp"

#include <utility>

#include "studies/running/units.hpp"

namespace gamut {

std::vector<std::vector<double>> takeWorstCourses(const Run& run, const OutputScales& scales, UncertainMotion& motion,
                                                  SwitchingResult& found) {
  if (motion.switching.quantities.empty() || run.machine.isMotionGiven()) return {};
  WorstCourseOptions options;
  for (std::size_t output = 0; output < run.study.outputs.size(); ++output)
    if (scales.empty() || !scales[output].isNothing()) options.outputs.push_back(output);
  options.fastest = run.machine.fastest;
  options.method = run.study.ensemble.method;
  options.jobs = run.options.jobs;
  options.cancelled = run.watch.stop();
  std::vector<std::vector<double>> points;
  for (WorstCourse& course : worstCourses(motion, options)) {
    const std::size_t which = points.size();
    for (std::size_t i = 0; i < course.courses.size(); ++i) {
      const std::size_t q = motion.switching.quantities[i];
      course.values[q] = numberOfSwitching(motion.uncertain[q].range, which);
      for (std::size_t k = 0; k < course.courses[i].from.size(); ++k) {
        found.entry.push_back(static_cast<std::int64_t>(found.entry.size()));
        found.number.push_back(static_cast<std::int64_t>(which));  // until all have their numbers
        found.quantity.push_back(static_cast<std::int64_t>(q));
        found.from.push_back(course.courses[i].from[k]);
        found.value.push_back(course.courses[i].values[k]);
      }
    }
    motion.switching.courses.push_back(std::move(course.courses));
    points.push_back(std::move(course.values));
  }
  found.present = !points.empty();
  return points;
}

}  // namespace gamut
