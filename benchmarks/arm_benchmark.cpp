// Forward dynamics of a described seven-joint arm, as samples are integrated: one sample at a time (the baseline), and
// in packs with each vector unit. Times are for one sample; the label says how many operations the program has.
#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/evaluation/sample_pack.hpp"

namespace gamut::benchmarks {
namespace {

/// Alternating vertical and horizontal hinges, every body off its axes with a full inertia tensor.
Program armProgram() {
  Mechanism m;
  std::string before = Mechanism::inertialFrame;
  for (int i = 0; i < 7; ++i) {
    const std::string n = std::to_string(i);
    m.add(Link{"link" + n, before, "seat" + n, {0.0, 0.01, 0.2}, {{axisX, i % 2 == 0 ? -1 : 1, 0.0}}});
    m.add(Revolute{"joint" + n, "seat" + n, "body" + n, axisZ});
    m.add(Mass{"mass" + n, "body" + n, 5.0 - 0.5 * i, {0.01, 0.03, 0.1}, {0.06, 0.05, 0.02, 1e-3, 2e-3, -1e-3}});
    before = "body" + n;
  }
  m.setGravity({0.0, 0.0, -9.81});
  return recordMotion(m, {}, Formulation::articulated);
}

std::vector<double> randomStates(std::size_t n) {
  std::mt19937_64 engine(7);
  std::vector<double> x(n);
  for (double& value : x) value = std::uniform_real_distribution<>(-1.5, 1.5)(engine);
  return x;
}

void one(benchmark::State& state) {
  const Program program = armProgram();
  Evaluator<double> evaluate(program);
  const std::size_t n = static_cast<std::size_t>(program.states());
  const std::vector<double> x = randomStates(n * 256);
  std::vector<double> y(n);
  std::size_t i = 0;
  for (auto _ : state) {
    evaluate(0.0, std::span<const double>(x).subspan(n * (i++ % 256), n), std::span<double>(y));
    benchmark::DoNotOptimize(y.data());
  }
  state.SetLabel(std::to_string(program.operations()) + " operations");
}

void packs(benchmark::State& state, VectorUnit unit) {
  const Program program = armProgram();
  PackEvaluator evaluate(program, unit);
  const std::vector<double> x = randomStates(static_cast<std::size_t>(program.states() * packWidth));
  const std::vector<double> t(packWidth, 0.0);
  std::vector<double> y(x.size());
  for (auto _ : state) {
    evaluate(t, x, y);
    benchmark::DoNotOptimize(y.data());
  }
  state.counters["sample"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * packWidth,
      static_cast<benchmark::Counter::Flags>(benchmark::Counter::kIsRate | benchmark::Counter::kInvert));
  state.SetLabel(nameOf(unit));
}

BENCHMARK(one);
[[maybe_unused]] const bool registered = [] {
  for (VectorUnit unit : usableUnits())
    benchmark::RegisterBenchmark("packs", [unit](benchmark::State& state) { packs(state, unit); });
  return true;
}();

}  // namespace
}  // namespace gamut::benchmarks
