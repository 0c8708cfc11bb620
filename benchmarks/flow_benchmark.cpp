// The validated flow of the double pendulum: from a thin start, from a first angle known to ± 1 % without and with
// splitting. Baseline of the same run: one trajectory in plain doubles by the classical Runge-Kutta method.
// Counters: CPU milliseconds of the flow itself per simulated second, steps, pieces, width of ψ1 at the horizon (rad).
#include <benchmark/benchmark.h>

#include "analyses/flow/flow.hpp"
#include "benchmarks/double_pendulum.hpp"

namespace gamut::benchmarks {
namespace {

/// One simulated second.
void plainRungeKutta(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(plainTrajectory(1));
}
BENCHMARK(plainRungeKutta)->Unit(benchmark::kMillisecond);

void flow(benchmark::State& state, double relativeRadius, double horizon, bool split) {
  FlowOptions options;
  options.split = split;
  const Flow flow(doublePendulumProgram(), options);
  const Box start = doublePendulumStart(relativeRadius);
  double cpu = 0;
  Tube tube;
  for (auto _ : state) {
    tube = flow.enclose(start, horizon);
    cpu += tube.cpuSeconds();
  }
  if (!tube.why().empty()) {
    state.SkipWithError(tube.why().c_str());
    return;
  }
  state.counters["ms/s"] = benchmark::Counter(1e3 * cpu / horizon, benchmark::Counter::kAvgIterations);
  state.counters["steps"] = static_cast<double>(tube.steps());
  state.counters["pieces"] = tube.pieces();
  state.counters["width"] = width(tube.at(horizon)[0]);
}
BENCHMARK_CAPTURE(flow, thinTo10s, 0.0, 10.0, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(flow, onePercentTo3s, 0.01, 3.0, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(flow, onePercentSplitTo5s, 0.01, 5.0, true)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gamut::benchmarks
