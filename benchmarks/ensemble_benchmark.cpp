// The sampled ensemble of the double pendulum to 3 s, its first angle uniform within ± 1 %, on one thread. Baseline of
// the same run: as many trajectories in plain doubles by the classical Runge-Kutta method with steps of 1 ms.
// items_per_second: trajectories a second, without the ensemble's corners and its measurement of the witness's error,
// though their cost and that of the statistics is in the time.
#include <benchmark/benchmark.h>

#include "benchmarks/sampled_pendulum.hpp"

namespace gamut::benchmarks {
namespace {

void plainRungeKutta(benchmark::State& state) {
  for (auto _ : state)
    for (int sample = 0; sample < state.range(0); ++sample) benchmark::DoNotOptimize(plainTrajectory(sampledHorizon));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(plainRungeKutta)->Arg(1024)->Unit(benchmark::kMillisecond);

void ensemble(benchmark::State& state) {
  const UncertainMotion pendulum =
      sampledPendulum(record(4, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; }));
  EnsembleOptions options;
  options.samples = static_cast<std::size_t>(state.range(0));
  for (auto _ : state) {
    EnsembleRun run(pendulum, options);
    run.integrateFirst();
    run.integrateOthers();
    benchmark::DoNotOptimize(run.statistics());
    if (!run.why().empty()) {
      state.SkipWithError(run.why().c_str());
      return;
    }
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(ensemble)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gamut::benchmarks
