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

struct Estimated {
  Ratio first, total;
};

/// [cell][quantity], of the so many cells of a slice. Samples are evaluated block by block, those of both sets twice,
/// since their mean comes first: all outputs of all samples at once would be gigabytes of many outputs. Empty where it
/// was cancelled: half of the samples would be no estimate of what is asked.
std::vector<Estimated> estimated(const SampledOutputs& sampled, std::size_t slice, std::size_t cells,
                                 const std::vector<double>& a, const std::vector<double>& b, std::size_t n,
                                 const std::atomic<bool>* cancelled) {
  const auto isCancelled = [&] { return cancelled != nullptr && *cancelled; };
  const std::size_t samples = a.size() / n;
  std::vector<double> ofA, ofB, ofMixed, mixed;
  const auto forBlocks = [&](const auto& use) {
    for (std::size_t begin = 0; begin < samples && !isCancelled(); begin += SurrogateEvaluator::together) {
      const std::size_t count = std::min(SurrogateEvaluator::together, samples - begin);
      const auto own = [&](const std::vector<double>& values) {
        return std::span(values).subspan(begin * n, count * n);
      };
      for (std::vector<double>* numbers : {&ofA, &ofB}) numbers->resize(count * cells);
      sampled.evaluate(slice, own(a), ofA);
      sampled.evaluate(slice, own(b), ofB);
      use(own(a), own(b), count);
    }
  };
  std::vector<double> mean(cells, 0.0);
  forBlocks([&](auto, auto, std::size_t count) {
    for (std::size_t i = 0; i < count * cells; ++i)
      mean[i % cells] += (ofA[i] + ofB[i]) / (2 * static_cast<double>(samples));
  });
  std::vector<Estimated> found(cells * n);
  forBlocks([&](auto ownA, auto ownB, std::size_t count) {
    ofMixed.resize(count * cells);
    for (std::size_t q = 0; q < n; ++q) {
      mixed.assign(ownA.begin(), ownA.end());
      for (std::size_t i = 0; i < count; ++i) mixed[i * n + q] = ownB[i * n + q];
      sampled.evaluate(slice, mixed, ofMixed);
      for (std::size_t i = 0; i < count * cells; ++i) {
        const std::size_t cell = i % cells;
        const double x = ofA[i] - mean[cell], y = ofB[i] - mean[cell], z = ofMixed[i] - mean[cell];
        const double square = 0.5 * (x * x + y * y);
        auto& [first, total] = found[cell * n + q];
        first.include(y * (z - x), square);
        total.include(0.5 * (x - z) * (x - z), square);
      }
    }
  });
  return isCancelled() ? std::vector<Estimated>{} : found;
}

}  // namespace

SobolEstimates estimateSobolIndices(const SampledOutputs& sampled, std::size_t times, std::size_t outputs,
                                    const std::vector<const Uncertain*>& uncertain, std::size_t samples,
                                    std::uint64_t seed, const std::atomic<bool>* cancelled) {
  const std::size_t n = uncertain.size();
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> share(0, 1);
  const auto drawn = [&] {
    std::vector<double> values;
    for (std::size_t i = 0; i < samples; ++i)
      for (const Uncertain* of : uncertain) values.push_back(of->distribution.quantile(share(engine)));
    for (std::size_t i = 0; i < samples; ++i) sampled.settle(std::span(values).subspan(i * n, n));
    return values;
  };
  const std::vector<double> a = drawn(), b = drawn();
  SobolEstimates estimates;
  for (auto* numbers : {&estimates.first, &estimates.firstError, &estimates.total, &estimates.totalError})
    numbers->assign(times * outputs * n, std::numeric_limits<double>::quiet_NaN());
  const std::vector<SurrogateEvaluator::Slice>& slices = sampled.slices;
  for (std::size_t s = 0; s < slices.size() && n > 0; ++s) {
    const std::size_t from = slices[s].first * outputs * n;
    const std::vector<Estimated> found = estimated(sampled, s, slices[s].count * outputs, a, b, n, cancelled);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto& [first, total] = found[i];
      if (!(first.v > 0) || !std::isfinite(first.v)) continue;
      const double count = static_cast<double>(samples);
      estimates.first[from + i] = first.value();
      estimates.firstError[from + i] = first.error(count);
      estimates.total[from + i] = total.value();
      estimates.totalError[from + i] = total.error(count);
    }
  }
  return estimates;
}

SobolEstimates estimateSobolIndices(const SurrogateEvaluator& evaluator, std::size_t times, std::size_t outputs,
                                    const std::vector<const Uncertain*>& uncertain, std::size_t samples,
                                    std::uint64_t seed, const std::atomic<bool>* cancelled) {
  const SampledOutputs sampled{evaluator.slices(), [&](std::span<double> values) { evaluator.settle(values); },
                               [&](std::size_t slice, std::span<const double> values, std::span<double> found) {
                                 evaluator.evaluate(slice, values, found);
                               }};
  return estimateSobolIndices(sampled, times, outputs, uncertain, samples, seed, cancelled);
}

}  // namespace gamut
