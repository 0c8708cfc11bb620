// Samples of the double pendulum without integrating, to 3 s, its first angle uniform within ± 1 %: 4 outputs at 300
// times from the polynomials that a flow kept, on one thread. Baseline of the same run: the ensemble's integration.
// items_per_second: values, one output at one time, a second.
#include <benchmark/benchmark.h>

#include <numeric>

#include "analyses/flow/flow.hpp"
#include "analyses/surrogate/surrogate_evaluator.hpp"
#include "benchmarks/sampled_pendulum.hpp"

namespace gamut::benchmarks {
namespace {

constexpr int outputs = 4;

Program states() {
  return record(4, 0, outputs, [](auto, const auto& x, const auto&, auto& y) {
    for (std::size_t i = 0; i < outputs; ++i) y[i] = x[i];
  });
}

PackedSurrogate surrogate() {
  FlowOptions options;
  std::vector<int> all(outputs);
  std::iota(all.begin(), all.end(), 0);
  options.modelledAt = all;
  const Tube tube = Flow(doublePendulumProgram(), states(), options)
                        .enclose(doublePendulumStart(0.01), sampledHorizon, outputTimes());
  std::vector<std::size_t> rows(tube.reachedTimes());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return pack(surrogateOf(*tube.models(), {0}, 0, outputs), rows, all, outputs);
}

void evaluated(benchmark::State& state) {
  std::vector<std::size_t> rows(301), all(outputs);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::iota(all.begin(), all.end(), std::size_t{0});
  const SurrogateEvaluator evaluator(surrogate(), rows, all);
  const auto samples = static_cast<std::size_t>(state.range(0));
  const Interval first = doublePendulumStart(0.01)[0];
  std::vector<double> values, numbers(samples * rows.size() * outputs), errors(numbers.size());
  for (std::size_t i = 0; i < samples; ++i)
    values.push_back(first.lower() + width(first) * (static_cast<double>(i) + 0.5) / static_cast<double>(samples));
  for (auto _ : state) {
    evaluator.settle(values);
    evaluator.evaluate(values, numbers, errors);
    benchmark::DoNotOptimize(numbers.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(numbers.size()));
}
BENCHMARK(evaluated)->Arg(4096)->Unit(benchmark::kMillisecond);

void integrated(benchmark::State& state) {
  const UncertainMotion pendulum = sampledPendulum(states());
  EnsembleOptions options;
  options.samples = static_cast<std::size_t>(state.range(0));
  for (auto _ : state) {
    EnsembleRun run(pendulum, options);
    run.integrateFirst();
    run.integrateOthers();
    benchmark::DoNotOptimize(run.integrated());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) * sampledTimes * outputs);
}
BENCHMARK(integrated)->Arg(4096)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gamut::benchmarks
