// A motion of one sample as a problem of CVODE.
#include "analyses/samples/witness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analyses/samples/sides_of_motion.hpp"
#include "analyses/samples/time_cells.hpp"
#include "analyses/work.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "scalars/program/angles.hpp"

namespace gamut {

void Motion::check() const {
  if (f.outputs() != f.states()) throw std::invalid_argument("a motion needs one derivative for each state");
  if (g.states() != f.states() || g.parameters() != f.parameters())
    throw std::invalid_argument("the outputs of a motion need the states and parameters of its derivatives");
  if (sampled.outputs() > 0 &&
      (sampled.outputs() != f.outputs() || sampled.states() != f.states() || sampled.parameters() != f.parameters()))
    throw std::invalid_argument("a motion has the same states and parameters for samples as for enclosures");
  if (g.outputs() == 0) throw std::invalid_argument("a motion without outputs shows nothing");
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!(times[i] >= 0) || !std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1]))
      throw std::invalid_argument("output times must rise from 0 or later");
}

Program Motion::outputsForSamples() const { return withHalfTurns(g); }

std::string Motion::whatIsNotFinite(std::span<const double> values) const {
  const auto first = std::ranges::find_if(values, [](double value) { return !std::isfinite(value); });
  const auto place = static_cast<std::size_t>(first - values.begin());
  return (place < outputNames.size() ? "'" + outputNames[place] + "'" : std::string("an output")) + " is not finite";
}

namespace {

/// In parts of the horizon: turns are then some ten thousand times as high as CVODE's absolute tolerance allows a
/// position to be off (tolerances of a study unless given); and a part of that, for where it begins anew.
constexpr double soonAtRest = 1e-5, offAtBegin = 1e-14;

}  // namespace

struct Witness::Solver : CvodeProblem {
  Solver(const Motion& m, Method method, const std::atomic<bool>* cancelled)
      : motion(m),
        seen(m.outputsForSamples()),
        f(m.forSamples()),
        g(seen),
        sides(m.forSamples(), m.g, m.horizon(), m.rests, soonAtRest, offAtBegin),
        cells(m.forSamples(), m.horizon()),
        cvode(detail::at(m.f.states()), m.times, method, cancelled) {}

  void differentiate(double t, std::span<const double> x, std::span<double> rates) override {
    if (sides.count() > 0)
      sides.piece().rates(t, x, rates);
    else
      f(t, x, rates);
    Work::count(Work::aloneOperation, ofRates);
    Work::count(Work::aloneState, motion.f.states());
  }

  std::size_t watched() const override { return isChanging ? 1 : sides.count(); }
  void watch(double t, std::span<const double> x, std::span<double> values) override {
    if (isChanging)
      values[0] = changes.empty() ? 1.0 : changes.front().time - t;
    else
      sides.watch(t, x, values);
  }
  std::string turn(double t, std::span<double> x, double later, std::span<const double> xLater,
                   std::span<const char> fallen) override {
    if (isChanging) {
      f.setParameters(changes.front().parameters);
      g.setParameters(changes.front().parameters);
      changes = changes.subspan(1);
      return "";
    }
    if (!sides.turn(t, x, later, xLater, fallen)) return noSidesAgree;
    sides.rest(x);
    return "";
  }

  bool observe(std::size_t i, double t, std::span<const double> x) override {
    const std::span<double> outputs = trajectory.subspan(i * motion.outputs(), motion.outputs());
    Work::count(Work::aloneOperation, ofOutputs);
    (sides.count() > 0 ? sides.piece().outputs : g)(t, x, outputs);
    if (std::ranges::all_of(outputs, [](double value) { return std::isfinite(value); })) return true;
    notFinite = motion.whatIsNotFinite(outputs);
    std::ranges::fill(outputs, std::numeric_limits<double>::quiet_NaN());
    return false;
  }

  std::string whatIsNotFinite() const override { return notFinite; }

  const Motion& motion;
  const double ofRates = motion.forSamples().operations();  // in an evaluation
  const double ofOutputs = motion.g.operations() + 2.0 * motion.g.outputs();
  std::string notFinite;
  const Program seen;
  Evaluator<double> f, g;
  SidesOfMotion<double> sides;
  TimeCells cells;
  bool isChanging = false;                   // its parameters
  std::span<const ParameterChange> changes;  // that are still to come
  std::span<double> trajectory;              // while a motion is integrated
  Cvode cvode;
};

Witness::Witness(const Motion& motion, Method method, const std::atomic<bool>* cancelled)
    : solver_(std::make_unique<Solver>(motion, method, cancelled)) {}
Witness::~Witness() = default;
Witness::Witness(Witness&&) noexcept = default;
Witness& Witness::operator=(Witness&&) noexcept = default;

Integration Witness::integrate(std::span<const double> start, const Tolerance& tolerance, std::span<double> trajectory,
                               double seconds) {
  Solver& s = *solver_;
  const Motion& motion = s.motion;
  if (start.size() != motion.startValues() || trajectory.size() != motion.times.size() * motion.outputs())
    throw std::invalid_argument("start values or trajectory do not have the motion's size");
  std::ranges::fill(trajectory, std::numeric_limits<double>::quiet_NaN());
  const std::size_t states = detail::at(motion.f.states());
  s.f.setParameters(start.subspan(states));
  s.g.setParameters(start.subspan(states));
  s.trajectory = trajectory;
  s.sides.setParameters(start.subspan(states));
  if (s.sides.count() > 0 && !s.sides.begin(0, start.first(states))) return {0, 0, noSidesAgree};
  const std::vector<Interval> parameters(start.begin() + static_cast<std::ptrdiff_t>(states), start.end());
  return s.cvode.integrate(s, start.first(states), tolerance, s.cells.ends(parameters), seconds);
}

Integration Witness::integrate(std::span<const double> start, std::span<const ParameterChange> changes,
                               const Tolerance& tolerance, std::span<double> trajectory, double seconds) {
  Solver& s = *solver_;
  const Motion& motion = s.motion;
  if (start.size() != motion.startValues() || trajectory.size() != motion.times.size() * motion.outputs())
    throw std::invalid_argument("start values or trajectory do not have the motion's size");
  if (s.sides.count() > 0) throw std::invalid_argument("equations that jump have no parameters that change");
  std::ranges::fill(trajectory, std::numeric_limits<double>::quiet_NaN());
  const std::size_t states = detail::at(motion.f.states());
  std::vector<Interval> parameters(start.begin() + static_cast<std::ptrdiff_t>(states), start.end());
  for (const ParameterChange& change : changes)
    for (std::size_t i = 0; i < parameters.size(); ++i)
      parameters[i] = hull(parameters[i], Interval(change.parameters.at(i)));
  s.f.setParameters(start.subspan(states));
  s.g.setParameters(start.subspan(states));
  s.trajectory = trajectory;
  s.isChanging = true;
  s.changes = changes;
  return s.cvode.integrate(s, start.first(states), tolerance, s.cells.ends(parameters), seconds);
}

}  // namespace gamut
