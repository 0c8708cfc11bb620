// Solutions of positive definite systems, factorised each time: samples in packs on each vector unit, beside the same
// program sample by sample. Each sample of every pack has another matrix.
#include "scalars/algebra/linear_system.hpp"

#include <benchmark/benchmark.h>

#include <random>
#include <string>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/evaluation/sample_pack.hpp"

namespace gamut::benchmarks {
namespace {

/// The states are the entries on and below the diagonal, then the right-hand side.
Program systemProgram(MatrixKind kind, int n) {
  const int entries = n * (n + 1) / 2;
  return record(entries + n, 0, n, [=](auto, const auto& x, const auto&, auto& y) {
    std::vector<Recorded> matrix(static_cast<std::size_t>(n * n)), solution;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int row = std::max(i, j), column = std::min(i, j);
        matrix[i * n + j] = x[row * (row + 1) / 2 + column];
      }
    for (int i = 0; i < n; ++i) solution.push_back(x[entries + i]);
    LinearSystem<Recorded>(kind, n, matrix).solve(solution);
    for (std::size_t i = 0; i < solution.size(); ++i) y[i] = solution[i];
  });
}

/// A state of sample i: diagonals dominate.
std::vector<double> randomState(int n, std::mt19937_64& engine) {
  std::uniform_real_distribution<> part(-1, 1);
  std::vector<double> x;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) x.push_back(i == j ? n + part(engine) : part(engine));
  for (int i = 0; i < n; ++i) x.push_back(part(engine));
  return x;
}

void solutionsOneByOne(benchmark::State& state, MatrixKind kind, int n) {
  Evaluator<double> f(systemProgram(kind, n));
  std::mt19937_64 engine(1);
  const std::vector<double> x = randomState(n, engine);
  std::vector<double> y(static_cast<std::size_t>(n));
  for (auto _ : state) {
    f(0.0, std::span<const double>(x), y);
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
  state.counters["operations"] = f.tape().operations();
}

void solutionsOnPacks(benchmark::State& state, MatrixKind kind, int n, VectorUnit unit) {
  const Program program = systemProgram(kind, n);
  PackEvaluator f(program, unit);
  std::mt19937_64 engine(1);
  constexpr std::size_t width = packWidth;
  std::vector<double> x(static_cast<std::size_t>(program.states()) * width), y(static_cast<std::size_t>(n) * width);
  for (std::size_t lane = 0; lane < width; ++lane) {
    const std::vector<double> one = randomState(n, engine);
    for (std::size_t i = 0; i < one.size(); ++i) x[i * width + lane] = one[i];
  }
  const std::vector<double> t(width);
  while (state.KeepRunningBatch(packWidth)) {
    f(t, x, y);
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
}

const bool registered = [] {
  for (int n : {3, 7, 12}) {
    const std::string size = std::to_string(n);
    const auto registerOne = [&](const std::string& name, auto... arguments) {
      benchmark::RegisterBenchmark((name + size).c_str(), arguments...);
    };
    for (MatrixKind kind : {MatrixKind::positiveDefinite, MatrixKind::general}) {
      const std::string name = kind == MatrixKind::general ? "general/" : "positiveDefinite/";
      registerOne(name + "oneByOne/", solutionsOneByOne, kind, n);
      for (VectorUnit unit : usableUnits())
        registerOne(name + "packs/" + nameOf(unit) + '/', solutionsOnPacks, kind, n, unit);
    }
  }
  return true;
}();

}  // namespace
}  // namespace gamut::benchmarks
