// All choices are smooth functions of the number drawn, z in [-1, 1] from end to end of the interval, with waves so
// short that neighbours have nothing in common.
#include "analyses/samples/courses.hpp"

#include <algorithm>
#include <cmath>

#include "scalars/algebra/decompositions.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

namespace {

Recorded course(const VaryingQuantity& of, const Recorded& drawn, const Recorded& t, double slowest, double fastest) {
  const double centre = midpoint(of.range);
  // centre ± radius lies in the interval.
  const double radius = std::min(subDown(centre, of.range.lower()), subDown(of.range.upper(), centre));
  if (!(radius > 0)) return drawn;  // an interval of two numbers
  const Recorded z = (drawn - centre) / radius;
  const Recorded inner = 1.0 - sqr(sqr(sqr(sqr(z))));  // 0 at the ends: those stand still
  const auto choice = [&](double wave) {
    return 0.5 + 0.5 * cos(wave * (1.0 - sqr(z)) + wave * z * inner);
  };  // 1 there
  const Recorded frequency = inner * exp(std::log(slowest) + std::log(fastest / slowest) * choice(91.0));
  const Recorded steepness = exp(std::log(30.0) * choice(57.0));  // of what switches; 1: about a sine
  constexpr double halfPi = 1.5707963267948966;
  const Recorded slow = 0.37 * frequency * t + 171.0 * z;
  const Recorded phase = frequency * t + 401.0 * halfPi * z + 2.0 * inner * choice(23.0) * sin(slow);
  Recorded size(radius), middle(0.0);
  if (std::isfinite(
          of.rate)) {  // |d tanh(k sin θ)/dt| ≤ k |θ̇| ≤ 1.74 k frequency, so that rate·size keeps below `rate`
    size = radius / sqrt(1.0 + sqr(1.75 * radius / of.rate * steepness * frequency));
    middle = (radius - size) * sin(211.0 * z);
  }
  const Recorded swing = centre + middle + size * tanh(steepness * sin(phase));
  // The nominal value chooses itself, and those near it mixtures.
  const Recorded apart = sqr(tanh(50.0 / radius * (drawn - of.nominal)));
  return drawn + apart * (swing - drawn);
}

}  // namespace

Program withCourses(const Program& program, const std::vector<VaryingQuantity>& varying, double slowest,
                    double fastest) {
  Recorder recorder(program.states(), program.parameters());
  const RecordingGuard guard(recorder);
  std::vector<int> parameters;
  for (int i = 0; i < program.parameters(); ++i) parameters.push_back(recorder.parameter(i));
  for (const VaryingQuantity& of : varying)
    parameters[of.parameter] =
        course(of, Recorded::node(recorder.parameter(of.parameter)), Recorded::node(recorder.time()), slowest, fastest)
            .node();
  const std::vector<int> here = recorder.append(program, parameters);
  std::vector<int> outputs;
  for (const int output : program.outputNodes()) outputs.push_back(here[output]);
  return recorder.finish(outputs);
}

double SwitchingCourse::at(double t) const {
  return values[static_cast<std::size_t>(std::ranges::upper_bound(from.begin() + 1, from.end(), t) - from.begin()) - 1];
}

Program withSwitching(const Program& program, const std::vector<std::pair<int, SwitchingCourse>>& courses) {
  Recorder recorder(program.states(), program.parameters());
  const RecordingGuard guard(recorder);
  std::vector<int> parameters;
  for (int i = 0; i < program.parameters(); ++i) parameters.push_back(recorder.parameter(i));
  const Recorded t = Recorded::node(recorder.time());
  for (const auto& [parameter, course] : courses) {
    Recorded value(course.values.front());
    for (std::size_t i = 1; i < course.from.size(); ++i) {
      // The step's value behind it, not that before and a difference, which would be rounded.
      const Recorded behind = 0.5 + 0.5 * sign(t - course.from[i]);
      value = (1.0 - behind) * value + behind * course.values[i];
    }
    parameters[parameter] = value.node();
  }
  const std::vector<int> here = recorder.append(program, parameters);
  std::vector<int> outputs;
  for (const int output : program.outputNodes()) outputs.push_back(here[output]);
  return recorder.finish(outputs);
}

double numberOfSwitching(const Interval& range, std::size_t which) {
  return range.upper() + static_cast<double>(which + 1) * (range.upper() - range.lower());
}

bool canSwitch(const Interval& range) {
  constexpr double narrow = 1e-9;  // of its numbers
  return width(range) > narrow * magnitude(range);
}

double fastestTurn(const Program& f, const std::vector<double>& start) {
  const int n = f.states();
  if (n == 0) return 0;
  Evaluator<double> evaluator(f.differentiated());
  evaluator.setParameters(std::vector<double>(start.begin() + n, start.end()));
  const std::vector<double> values = evaluator(0.0, std::vector<double>(start.begin(), start.begin() + n));
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
      values.data() + n, n, n);
  if (!jacobian.allFinite()) return 0;
  return eigenvaluesOf(jacobian).cwiseAbs().maxCoeff();
}

}  // namespace gamut
