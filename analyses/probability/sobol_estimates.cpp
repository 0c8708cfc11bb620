#include "analyses/probability/sobol_estimates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>

namespace gamut {
namespace {

/// Σu/Σv and its standard error times 1.96: that of the mean of u - (Σu/Σv) v, divided by the mean of v.
struct Ratio {
  double u = 0, v = 0, uu = 0, uv = 0, vv = 0;

  void include(double a, double b) {
    u += a, v += b;
    uu += a * a, uv += a * b, vv += b * b;
  }
  double value() const { return u / v; }
  double error(double count) const {
    const double r = value(), squares = uu - 2 * r * uv + r * r * vv;
    return 1.96 * std::sqrt(std::max(squares, 0.0) / count) / (v / count) / std::sqrt(count);
  }
};

}  // namespace

SobolEstimates estimateSobolIndices(const SurrogateEvaluator& evaluator, std::size_t times, std::size_t outputs,
                                    const std::vector<const Uncertain*>& uncertain, std::size_t samples,
                                    std::uint64_t seed) {
  const std::size_t n = uncertain.size(), cells = times * outputs;
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> share(0, 1);
  const auto drawn = [&] {
    std::vector<double> values;
    for (std::size_t i = 0; i < samples; ++i)
      for (const Uncertain* of : uncertain) values.push_back(of->distribution.quantile(share(engine)));
    for (std::size_t i = 0; i < samples; ++i) evaluator.settle(std::span(values).subspan(i * n, n));
    return values;
  };
  std::vector<double> errors(samples * cells);
  const auto outputsOf = [&](const std::vector<double>& values) {
    std::vector<double> numbers(samples * cells);
    evaluator.evaluate(values, numbers, errors);
    return numbers;
  };
  const std::vector<double> a = drawn(), b = drawn();
  const std::vector<double> ofA = outputsOf(a), ofB = outputsOf(b);
  std::vector<double> mean(cells, 0.0);
  for (std::size_t i = 0; i < samples * cells; ++i)
    mean[i % cells] += (ofA[i] + ofB[i]) / (2 * static_cast<double>(samples));
  SobolEstimates estimates;
  for (auto* numbers : {&estimates.first, &estimates.firstError, &estimates.total, &estimates.totalError})
    numbers->assign(cells * n, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t q = 0; q < n; ++q) {
    std::vector<double> mixed = a;
    for (std::size_t i = 0; i < samples; ++i) mixed[i * n + q] = b[i * n + q];
    const std::vector<double> ofMixed = outputsOf(mixed);
    for (std::size_t cell = 0; cell < cells; ++cell) {
      Ratio first, total;
      for (std::size_t i = cell; i < samples * cells; i += cells) {
        const double x = ofA[i] - mean[cell], y = ofB[i] - mean[cell], z = ofMixed[i] - mean[cell];
        const double square = 0.5 * (x * x + y * y);
        first.include(y * (z - x), square);
        total.include(0.5 * (x - z) * (x - z), square);
      }
      if (!(first.v > 0) || !std::isfinite(first.v)) continue;
      const double count = static_cast<double>(samples);
      estimates.first[cell * n + q] = first.value();
      estimates.firstError[cell * n + q] = first.error(count);
      estimates.total[cell * n + q] = total.value();
      estimates.totalError[cell * n + q] = total.error(count);
    }
  }
  return estimates;
}

}  // namespace gamut
