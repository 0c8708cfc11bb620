// Forward dynamics of the seven-joint arm: the same generic code with doubles (the baseline), recorded and evaluated
// with doubles, and recorded and evaluated on packs of samples; then sines and cosines of arrays. Times of the packs
// are for one sample.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "benchmarks/revolute_chain.hpp"
#include "scalars/elementary/vector_functions.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/evaluation/sample_pack.hpp"
#include "scalars/recorded.hpp"

namespace gamut::benchmarks {
namespace {

constexpr std::size_t motions = 256;  // different arguments, so that no branch and no result can be remembered
constexpr std::size_t states = 3 * joints;

struct Arguments {
  JointValues<double> q, v, torque;
};

std::vector<Arguments> randomArguments() {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<> part(-1, 1);
  std::vector<Arguments> all(motions);
  for (Arguments& one : all)
    for (std::size_t i = 0; i < joints; ++i)
      one.q[i] = 1.5 * part(engine), one.v[i] = part(engine), one.torque[i] = part(engine);
  return all;
}

/// States q, v and torques; parameters the masses.
Program chainProgram() {
  return record(states, joints, joints, [](auto, const auto& x, const auto& p, auto& y) {
    JointValues<Recorded> q, v, torque, masses;
    for (std::size_t i = 0; i < joints; ++i)
      q[i] = x[i], v[i] = x[joints + i], torque[i] = x[2 * joints + i], masses[i] = p[i];
    const JointValues<Recorded> result = ForwardDynamics<Recorded>::of(armOf(masses), q, v, torque);
    std::ranges::copy(result, y.begin());
  });
}

void chainInDoubles(benchmark::State& state) {
  const std::vector<Arguments> arguments = randomArguments();
  Arm<double> arm = armOf(usualMasses);
  benchmark::DoNotOptimize(arm);
  std::size_t i = 0;
  for (auto _ : state) {
    const Arguments& one = arguments[i++ % motions];
    benchmark::DoNotOptimize(ForwardDynamics<double>::of(arm, one.q, one.v, one.torque));
  }
}
BENCHMARK(chainInDoubles);

void chainRecorded(benchmark::State& state) {
  const Program program = chainProgram();
  Evaluator<double> f(program);
  f.setParameters(usualMasses);
  std::vector<std::vector<double>> x;
  for (const Arguments& one : randomArguments()) {
    std::vector<double>& row = x.emplace_back();
    for (const auto* part : {&one.q, &one.v, &one.torque}) row.insert(row.end(), part->begin(), part->end());
  }
  std::vector<double> y(joints);
  std::size_t i = 0;
  for (auto _ : state) {
    f(0.0, std::span<const double>(x[i++ % motions]), y);
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
  state.counters["operations"] = f.tape().operations();
  state.counters["slots"] = f.tape().slots();
}
BENCHMARK(chainRecorded);

void chainOnPacks(benchmark::State& state, VectorUnit unit) {
  const Program program = chainProgram();
  PackEvaluator f(program, unit);
  constexpr std::size_t width = packWidth;
  std::vector<double> masses, y(joints * width);
  const std::vector<double> t(width, 0.0);
  for (double mass : usualMasses)
    for (std::size_t lane = 0; lane < width; ++lane) masses.push_back(mass * (1 + 0.001 * static_cast<double>(lane)));
  f.setParameters(masses);
  const std::vector<Arguments> arguments = randomArguments();
  std::vector<std::vector<double>> packs;
  for (std::size_t first = 0; first < motions; first += width) {
    std::vector<double>& x = packs.emplace_back(states * width);
    for (std::size_t lane = 0; lane < width; ++lane)
      for (std::size_t i = 0; i < joints; ++i) {
        const Arguments& one = arguments[first + lane];
        x[i * width + lane] = one.q[i];
        x[(joints + i) * width + lane] = one.v[i];
        x[(2 * joints + i) * width + lane] = one.torque[i];
      }
  }
  std::size_t i = 0;
  while (state.KeepRunningBatch(packWidth)) {
    f(t, packs[i++ % packs.size()], y);
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
  state.counters["slots"] = f.tape().slots();
}

std::vector<double> angles() {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<> part(-10, 10);
  std::vector<double> x(1024);
  for (double& value : x) value = part(engine);
  return x;
}

void standardSinesAndCosines(benchmark::State& state) {
  const std::vector<double> x = angles();
  std::vector<double> s(x.size()), c(x.size());
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(x.size()))) {
    for (std::size_t i = 0; i < x.size(); ++i) s[i] = std::sin(x[i]), c[i] = std::cos(x[i]);
    benchmark::DoNotOptimize(s.data());
    benchmark::DoNotOptimize(c.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(standardSinesAndCosines);

void vectorSinesAndCosines(benchmark::State& state, VectorUnit unit) {
  const std::vector<double> x = angles();
  std::vector<double> s(x.size()), c(x.size());
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(x.size()))) {
    sineCosine(unit, x, s, c);
    benchmark::DoNotOptimize(s.data());
    benchmark::ClobberMemory();
  }
}

const bool registered = [] {
  for (VectorUnit unit : usableUnits()) {
    benchmark::RegisterBenchmark((std::string("chainOnPacks/") + nameOf(unit)).c_str(), chainOnPacks, unit);
    benchmark::RegisterBenchmark((std::string("vectorSinesAndCosines/") + nameOf(unit)).c_str(), vectorSinesAndCosines,
                                 unit);
  }
  return true;
}();

}  // namespace
}  // namespace gamut::benchmarks
