// Courses of what varies in time against a tube: motions along them must lie inside, exactly.
#pragma once

#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/switching_courses.hpp"

namespace gamut::testing {

/// The motion along one course, at output times and between them; false once one is outside.
inline bool expectCourse(const Containment& c, const Tube& tube, const Vector& start, const Course& course,
                         const std::vector<double>& times) {
  const std::vector<Vector> motion = follow(c.f, Vector(start.begin(), start.begin() + c.f.states()), course, times);
  std::optional<Evaluator<Precise>> outputs;
  if (c.g) outputs.emplace(*c.g);
  for (std::size_t i = 0; i < times.size(); ++i) {
    Vector y = motion[i];
    if (outputs) {
      outputs->setParameters(course.at(times[i]));
      y = (*outputs)(Precise(times[i]), motion[i]);
    }
    for (std::size_t row = 1; row < tube.reachedTimes(); ++row) {
      const bool isAt = tube.times()[row] == times[i];
      if (!isAt && !(tube.times()[row - 1] < times[i] && times[i] < tube.times()[row])) continue;
      for (std::size_t s = 0; s < motion[i].size(); ++s)
        EXPECT_THAT(isAt ? tube.states(row)[s] : tube.statesOver(row)[s], Encloses(motion[i][s]));
      for (std::size_t o = 0; outputs && o < y.size(); ++o)
        EXPECT_THAT(isAt ? tube.outputs(row)[o] : tube.outputsOver(row)[o], Encloses(y[o])) << o;
      if (::testing::Test::HasFailure()) return false;
    }
  }
  return true;
}

/// The tube holds random courses.
inline Tube expectCourses(const Containment& c, int courses, unsigned seed = 9) {
  Tube tube = c.tube();
  EXPECT_EQ(tube.why(), "");
  if (tube.reachedTimes() < tube.times().size()) return tube;
  Points points(seed);
  std::vector<double> times;
  for (int i = 1; i <= 64; ++i) times.push_back(c.horizon * i / 64);
  for (int trial = 0; trial < courses; ++trial) {
    SCOPED_TRACE(trial);
    const Vector start = trial % 2 == 0 ? points.corner(c.box) : points.inside(c.box);
    const Course course = switching(c.box, c.f.states(), c.options.varying, c.horizon, points.integer(0, 30), points);
    if (!expectCourse(c, tube, start, course, times)) return tube;
  }
  return tube;
}

}  // namespace gamut::testing
