// A pack of a motion's samples as one problem of CVODE.
#include "analyses/samples/pack_witness.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "analyses/samples/cvode.hpp"
#include "analyses/samples/time_cells.hpp"
#include "analyses/work.hpp"
#include "scalars/index.hpp"

namespace gamut {

struct PackWitness::Solver : CvodeProblem {
  Solver(const Motion& m, VectorUnit unit, const std::atomic<bool>* cancelled)
      : motion(m),
        f(m.forSamples(), unit),
        g(m.outputsForSamples(), unit),
        time(packWidth),
        cells(m.forSamples(), m.horizon()),
        cvode(detail::at(m.f.states()), m.times, unit, cancelled) {}

  void differentiate(double t, std::span<const double> x, std::span<double> rates) override {
    std::ranges::fill(time, t);
    f(time, x, rates);
    Work::count(Work::sampledOperation, ofRates);
    Work::count(Work::sampledState, motion.f.states());
  }

  bool observe(std::size_t i, double t, std::span<const double> x) override {
    const std::size_t size = motion.outputs() * packWidth;
    const std::span<double> outputs = trajectories.subspan(i * size, size);
    std::ranges::fill(time, t);
    g(time, x, outputs);
    Work::count(Work::sampledOperation, ofOutputs);
    return std::ranges::all_of(outputs, [](double value) { return std::isfinite(value); });
  }

  const Motion& motion;
  const double ofRates = motion.forSamples().operations();  // in an evaluation
  const double ofOutputs = motion.g.operations() + 2.0 * motion.g.outputs();
  PackEvaluator f, g;
  std::vector<double> time;
  TimeCells cells;
  std::span<double> trajectories;  // while a pack is integrated
  Cvode cvode;
};

PackWitness::PackWitness(const Motion& motion, const std::atomic<bool>* cancelled, VectorUnit unit)
    : solver_(std::make_unique<Solver>(motion, unit, cancelled)) {}
PackWitness::~PackWitness() = default;
PackWitness::PackWitness(PackWitness&&) noexcept = default;
PackWitness& PackWitness::operator=(PackWitness&&) noexcept = default;

Integration PackWitness::integrate(std::span<const double> starts, const Tolerance& tolerance,
                                   std::span<double> trajectories, double seconds) {
  Solver& s = *solver_;
  const Motion& motion = s.motion;
  if (starts.size() != motion.startValues() * packWidth ||
      trajectories.size() != motion.times.size() * motion.outputs() * packWidth)
    throw std::invalid_argument("start values or trajectories do not have the size of a pack of the motion");
  const std::size_t states = detail::at(motion.f.states()) * packWidth;
  s.f.setParameters(starts.subspan(states));
  s.g.setParameters(starts.subspan(states));
  s.trajectories = trajectories;
  std::vector<Interval> ranges;  // of the pack's parameters
  for (std::span<const double> rest = starts.subspan(states); !rest.empty(); rest = rest.subspan(packWidth)) {
    const auto [least, greatest] = std::ranges::minmax(rest.first(packWidth));
    ranges.emplace_back(least, greatest);
  }
  return s.cvode.integrate(s, starts.first(states), tolerance, s.cells.ends(ranges), seconds);
}

}  // namespace gamut
