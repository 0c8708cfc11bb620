// One evaluation of the double pendulum's right-hand side: the same formula in plain C++ (the baseline), then the
// recorded program with doubles and with intervals. Then the time that a
// saved program of that many nodes takes to load, which is to grow as they do.
#include <benchmark/benchmark.h>

#include <array>
#include <span>
#include <sstream>

#include "benchmarks/double_pendulum.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/program/program_text.hpp"

namespace gamut::benchmarks {
namespace {

void plainDoubles(benchmark::State& state) {
  std::array<double, 4> x{2.356, -1.728, 0.43, 0.67}, dx{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    doublePendulum(9.81, x, dx);
    benchmark::DoNotOptimize(dx);
  }
}
BENCHMARK(plainDoubles);

void plainIntervals(benchmark::State& state) {
  const Box start = doublePendulumStart(0.01);
  const Interval g("9.81");
  Box x = start, dx(4);
  for (auto _ : state) {
    benchmark::DoNotOptimize(x.data());
    doublePendulum(g, x, dx);
    benchmark::DoNotOptimize(dx.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(plainIntervals);

template <class S>
void recorded(benchmark::State& state) {
  const Program program = doublePendulumProgram();
  Evaluator<S> f(program);
  std::vector<S> x, dx(4, S(0.0));
  for (const Interval& start : doublePendulumStart(0.01)) {
    if constexpr (std::is_same_v<S, double>)
      x.push_back(midpoint(start));
    else
      x.push_back(start);
  }
  for (auto _ : state) {
    f(S(0.0), std::span<const S>(x), std::span<S>(dx));
    benchmark::DoNotOptimize(dx.data());
    benchmark::ClobberMemory();
  }
  state.counters["operations"] = program.operations();
}
BENCHMARK(recorded<double>)->Name("recordedDoubles");
BENCHMARK(recorded<Interval>)->Name("recordedIntervals");

/// A chain of signs, and functions that all divide by its square.
void loaded(benchmark::State& state) {
  const auto signs = static_cast<int>(state.range(0));
  Recorder recorder(1, 0, RuleSet::none());
  int x = 0;
  for (int i = 0; i < signs; ++i) x = recorder.neg(x);
  const int square = recorder.sqr(x), denominator = recorder.add(recorder.constant(1.0), square);
  for (int i = 0; i < signs; ++i) recorder.emit(Op::atan, x, denominator);
  std::ostringstream text;
  saveProgram(text, recorder.program({recorder.size() - 1}));
  for (auto _ : state) {
    std::istringstream in(text.str());
    benchmark::DoNotOptimize(loadProgram(in));
  }
  state.SetComplexityN(signs);
}
BENCHMARK(loaded)->RangeMultiplier(4)->Range(1000, 64000)->Unit(benchmark::kMillisecond)->Complexity();

}  // namespace
}  // namespace gamut::benchmarks
