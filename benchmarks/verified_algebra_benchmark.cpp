// Verified dense linear algebra beside Eigen's unverified inverse by LU, of random matrices of doubles with n rows.
#include <benchmark/benchmark.h>

#include <Eigen/LU>

#include "scalars/algebra/verified_algebra.hpp"

namespace gamut::benchmarks {
namespace {

Eigen::MatrixXd randomMatrix(const benchmark::State& state) {
  std::srand(1);
  return Eigen::MatrixXd::Random(state.range(0), state.range(0));
}

void unverifiedInverse(benchmark::State& state) {
  const Eigen::MatrixXd a = randomMatrix(state);
  for (auto _ : state) {
    const Eigen::MatrixXd inverse = a.partialPivLu().inverse();
    benchmark::DoNotOptimize(inverse.data());
    benchmark::ClobberMemory();
  }
}

template <class Compute>
void verified(benchmark::State& state, const Eigen::MatrixXd& a, Compute compute) {
  if (!compute(a)) return state.SkipWithError("not verified");
  for (auto _ : state) {
    const auto result = compute(a);
    benchmark::DoNotOptimize(&result);
    benchmark::ClobberMemory();
  }
}

void inverse(benchmark::State& state) {
  verified(state, randomMatrix(state), [](const auto& a) { return verifiedInverse(a); });
}
void inverseOfIntervals(benchmark::State& state) {
  const Eigen::Matrix<Interval, Eigen::Dynamic, Eigen::Dynamic> wide =
      randomMatrix(state).unaryExpr([](double x) { return x + Interval(-1e-9, 1e-9); });
  verified(state, randomMatrix(state), [&](const auto&) { return verifiedInverse(wide); });
}
void orthogonalInverse(benchmark::State& state) {
  const Eigen::VectorXd v = randomMatrix(state).col(0);
  const Eigen::MatrixXd reflection =
      Eigen::MatrixXd::Identity(v.size(), v.size()) - 2 / v.squaredNorm() * v * v.transpose();
  verified(state, reflection, [](const auto& a) { return verifiedOrthogonalInverse(a); });
}
void solution(benchmark::State& state) {
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(state.range(0), -1, 1);
  verified(state, randomMatrix(state), [&](const auto& a) { return verifiedSolve(a, b); });
}
void determinant(benchmark::State& state) {
  verified(state, randomMatrix(state), [](const auto& a) { return verifiedDeterminant(a); });
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int n : {3, 6, 12, 30, 60}) benchmark->Arg(n);
}
BENCHMARK(unverifiedInverse)->Apply(sizes);
BENCHMARK(inverse)->Apply(sizes);
BENCHMARK(inverseOfIntervals)->Apply(sizes);
BENCHMARK(orthogonalInverse)->Apply(sizes);
BENCHMARK(solution)->Apply(sizes);
BENCHMARK(determinant)->Apply(sizes);

}  // namespace
}  // namespace gamut::benchmarks
