// Sobol' indices as samples tell them, of sums whose indices are known: each output at each time has its own.
#include "analyses/probability/sobol_estimates.hpp"

#include <gmock/gmock.h>

#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <random>
#include <span>

#include "tests/analyses/probability/images.hpp"

namespace gamut::testing {
namespace {

/// Output o at time t is x + (1 + t + 4 o / outputs) y, on two halves of the box alike.
PackedSurrogate sums(std::size_t times, std::size_t outputs) {
  PackedSurrogate packed;
  packed.centre = {0, 0};
  packed.half = {1, 1};
  packed.exponent = {0, 0, 1, 0, 0, 1};
  for (std::size_t t = 0; t < times; ++t)
    for (const double side : {-0.5, 0.5}) {
      packed.row.push_back(static_cast<double>(t));
      packed.firstTerm.push_back(0);
      packed.partCentre.insert(packed.partCentre.end(), {side, 0});
      // Parts of another width make another slice.
      packed.partHalf.insert(packed.partHalf.end(), {t == 1 ? 0.625 : 0.5, 1});
      for (std::size_t o = 0; o < outputs; ++o) {
        const double weight = 1 + static_cast<double>(t) + 4 * static_cast<double>(o) / static_cast<double>(outputs);
        packed.first.push_back(static_cast<double>(packed.coefficient.size()));
        packed.count.push_back(3);
        packed.radius.push_back(0);
        packed.coefficient.insert(packed.coefficient.end(),
                                  {side, packed.partHalf[packed.partHalf.size() - 2], weight});
      }
    }
  return packed;
}

std::vector<std::size_t> numbered(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

TEST(SobolEstimates, AreOfEachOutputAtEachTime) {
  const std::vector<Uncertain> quantities{uniform(-1, 1), uniform(-1, 1)};
  for (const auto& [times, outputs, samples] : {std::array<std::size_t, 3>{3, 5, 4000}, {4, 300, 700}, {1, 1, 256}}) {
    const SurrogateEvaluator evaluator(sums(times, outputs), numbered(times), numbered(outputs));
    const SobolEstimates found =
        estimateSobolIndices(evaluator, times, outputs, {&quantities[0], &quantities[1]}, samples, 3);
    ASSERT_EQ(found.first.size(), times * outputs * 2);
    for (std::size_t t = 0; t < times; ++t)
      for (std::size_t o = 0; o < outputs; ++o) {
        const double weight = 1 + static_cast<double>(t) + 4 * static_cast<double>(o) / static_cast<double>(outputs);
        const double share = 1 / (1 + weight * weight);
        for (const std::size_t q : {0U, 1U}) {
          const std::size_t i = (t * outputs + o) * 2 + q;
          const double truth = q == 0 ? share : 1 - share;
          EXPECT_NEAR(found.first[i], truth, 2.5 * found.firstError[i]) << t << " " << o << " " << q;
          EXPECT_NEAR(found.total[i], truth, 2.5 * found.totalError[i]) << t << " " << o << " " << q;
          EXPECT_LT(found.totalError[i], 4 / std::sqrt(static_cast<double>(samples)));
        }
      }
  }
}

TEST(SobolEstimates, AreOfNothingWithoutQuantities) {
  PackedSurrogate packed;
  packed.row = packed.firstTerm = packed.first = packed.radius = {0};
  packed.count = {1};
  packed.coefficient = {2};
  const SurrogateEvaluator evaluator(packed, {0}, {0});
  EXPECT_TRUE(estimateSobolIndices(evaluator, 1, 1, {}, 300, 1).first.empty());
}

TEST(SobolEstimates, EndWhenTheyAreCancelled) {
  const std::vector<Uncertain> quantities{uniform(-1, 1), uniform(-1, 1)};
  const SurrogateEvaluator evaluator(sums(3, 5), numbered(3), numbered(5));
  const std::atomic<bool> cancelled{true};
  const SobolEstimates found =
      estimateSobolIndices(evaluator, 3, 5, {&quantities[0], &quantities[1]}, 4000, 3, &cancelled);
  for (const std::vector<double>* numbers : {&found.first, &found.firstError, &found.total, &found.totalError}) {
    ASSERT_EQ(numbers->size(), 30U);
    for (const double number : *numbers) EXPECT_TRUE(std::isnan(number));
  }
}

/// Whatever is evaluated with it: the last bit decides nothing that is told, but replays of a run are compared by it.
TEST(SurrogateEvaluator, GivesTheSameSliceBySlice) {
  const std::size_t times = 4, outputs = 200, samples = 2 * SurrogateEvaluator::together + 77;
  const SurrogateEvaluator evaluator(sums(times, outputs), numbered(times), numbered(outputs));
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  std::vector<double> values(samples * 2);
  for (double& value : values) value = anywhere(engine);
  std::vector<double> all(samples * times * outputs), errors(all.size());
  evaluator.evaluate(values, all, errors);
  const std::vector<SurrogateEvaluator::Slice> slices = evaluator.slices();
  ASSERT_GE(slices.size(), 3U);  // since parts at time 1 are others
  std::size_t next = 0;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    EXPECT_EQ(slices[s].first, next);
    next += slices[s].count;
    const std::size_t cells = slices[s].count * outputs;
    std::vector<double> own(samples * cells);
    for (std::size_t from = 0; from < samples; from += SurrogateEvaluator::together) {
      const std::size_t count = std::min(SurrogateEvaluator::together, samples - from);
      evaluator.evaluate(s, std::span(values).subspan(2 * from, 2 * count),
                         std::span(own).subspan(from * cells, count * cells));
    }
    for (std::size_t i = 0; i < samples; ++i)
      for (std::size_t c = 0; c < cells; ++c)
        ASSERT_EQ(own[i * cells + c], all[(i * times + slices[s].first) * outputs + c]) << i << " " << c;
  }
  EXPECT_EQ(next, times);
}

}  // namespace
}  // namespace gamut::testing
