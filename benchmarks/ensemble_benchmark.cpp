// The sampled ensemble of the double pendulum to 3 s, its first angle uniform within ± 1 %, on one thread. Baseline of
// the same run: as many trajectories in plain doubles by the classical Runge-Kutta method with steps of 1 ms.
// items_per_second: trajectories a second, without the ensemble's corners and its measurement of the witness's error,
// though their cost and that of the statistics is in the time.
#include <benchmark/benchmark.h>

#include "analyses/samples/ensemble.hpp"
#include "benchmarks/double_pendulum.hpp"

namespace gamut::benchmarks {
namespace {

constexpr double horizon = 3;

void plainRungeKutta(benchmark::State& state) {
  for (auto _ : state)
    for (int sample = 0; sample < state.range(0); ++sample) benchmark::DoNotOptimize(plainTrajectory(horizon));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(plainRungeKutta)->Arg(1024)->Unit(benchmark::kMillisecond);

void ensemble(benchmark::State& state) {
  const Box start = doublePendulumStart(0.01);
  UncertainMotion pendulum;
  pendulum.motion.f = doublePendulumProgram();
  pendulum.motion.g = record(4, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  for (int i = 1; i <= 300; ++i) pendulum.motion.times.push_back(horizon * i / 300);
  for (const Interval& value : start) pendulum.nominal.push_back(midpoint(value));
  const double nominal = pendulum.nominal[0];
  pendulum.uncertain.push_back({"first angle", start[0], nominal, Distribution::uniform(start[0]),
                                Membership::triangular(start[0].lower(), nominal, start[0].upper())});
  pendulum.slot = {0};

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
