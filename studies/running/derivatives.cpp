// How outputs change with the uncertain quantities: by a flow of its own, along the derivatives.
#include "analyses/flow/derivatives.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>

#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// At some output times, as far as the tube reaches.
void describe(const Study& study, const DerivativeFlow& flow, const std::vector<std::size_t>& quantities,
              const Tube& tube, DerivativeResult& result) {
  constexpr std::size_t most = 64;
  const std::size_t last = study.times.size() - 1, count = std::min(last, most);
  for (std::size_t i = 0; i <= count; ++i) {
    const std::size_t row = i * last / count;
    if (row >= tube.reachedTimes()) break;
    result.time.push_back(study.times[row]);
    const std::vector<Interval>& values = tube.outputs(row);
    for (std::size_t output = 0; output < study.outputs.size(); ++output)
      for (std::size_t q = 0; q < study.uncertain.size(); ++q) {
        const auto which = std::ranges::find(quantities, q) - quantities.begin();
        const bool isKnown = which < std::ssize(quantities);
        const Interval bounds = isKnown
                                    ? values[flow.outputDerivative(static_cast<int>(output), static_cast<int>(which))]
                                    : Interval::empty();
        result.lower.push_back(isKnown ? bounds.lower() : std::numeric_limits<double>::quiet_NaN());
        result.upper.push_back(isKnown ? bounds.upper() : std::numeric_limits<double>::quiet_NaN());
      }
  }
}

}  // namespace

void encloseDerivatives(Run& run) {
  if (!run.study.derivatives) return;
  run.watch.begin(Watch::Stage::rest);
  const double start = processCpuSeconds();
  DerivativeResult& result = run.results.derivatives;
  result.present = true;
  std::vector<std::size_t> quantities;
  std::vector<int> by;
  for (const auto [number, slot] : run.machine.constants) {
    quantities.push_back(number);
    by.push_back(slot);
  }
  FlowOptions options = flowOptions(run.machine, run.options.jobs, run.watch.stop());
  options.progress = run.progressOf("derivatives");
  options.budget = run.study.shares.derivatives * std::max(run.spent.enclosure / Work::perSecond, 1.0);
  try {
    if (!(options.budget > 0)) throw std::invalid_argument("limits.derivatives leaves them nothing");
    const DerivativeFlow flow(run.machine.equations().f, run.machine.equations().g, by, std::move(options));
    const Tube tube = flow.enclose(run.machine.box, run.study.horizon, run.study.times);
    result.reached = tube.reached();
    if (tube.why() == Tube::outOfMemory) run.watch.memoryFailed();
    result.why = tube.why() == Tube::overBudget ? "the work that limits.derivatives allows is done"
                 : tube.wasStopped()            ? run.watch.why()
                                                : tube.why();
    describe(run.study, flow, quantities, tube, result);
  } catch (const std::invalid_argument& error) {  // of what jumps there is none
    result.why = error.what();
  } catch (const std::bad_alloc&) {
    run.watch.memoryFailed();
    result.why = run.watch.why();
  }
  if (*run.watch.stop()) result.stopped = run.watch.why();
  result.cpu = processCpuSeconds() - start;
}

}  // namespace gamut
