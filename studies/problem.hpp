// The numbers of a study in the order in which the recorded programs take them: states, then free parameters.
#pragma once

#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/samples/courses.hpp"
#include "analyses/samples/ensemble.hpp"
#include "scalars/interval.hpp"
#include "studies/study.hpp"

namespace gamut {

/// A study's initial values and free parameters as boxes and as start values. The free parameters are the uncertain
/// ones; all others are constants of the programs.
struct Problem {
  std::size_t states = 0;
  std::vector<std::string> freeParameters;
  Box box;                                ///< initial values, then free parameters; uncertain ones have their ranges
  std::vector<double> alpha;              ///< membership levels, 0 first; empty unless alpha-cuts are asked for
  std::vector<Box> levels;                ///< the box with the alpha-cuts of the uncertain quantities, one a level
  std::vector<VaryingParameter> varying;  ///< free parameters that vary in time
  std::vector<VaryingQuantity> courses;   ///< what of them the samples take, turning no slower and no faster than so
  double slowest = 0, fastest = 0;        ///< rad/s
  UncertainMotion motion;  ///< its programs, as samples follow them: dynamics f, g of the states; kinematics g of
                           ///< parameters alone. What varies in time takes the course that its number chooses.
};

/// Fills `study.motion` but for its times. Throws std::invalid_argument for a mechanism whose motion is not determined,
/// and std::length_error for one whose equations find no room: those of n joints in a chain have some 1100 n² bytes.
void recordPrograms(Study& study);

Problem makeProblem(const Study& study);

/// What is looked at, each in its unit.
std::vector<Expression> outputExpressions(const Study& study);

/// A program of states and free parameters as samples follow it: what varies in time takes its course.
Program alongCourses(const Problem& problem, const Program& program);

}  // namespace gamut
