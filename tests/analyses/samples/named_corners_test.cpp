// Corners of boxes of more quantities than corners can be sampled of.
#include "analyses/samples/named_corners.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "analyses/samples/ensemble.hpp"
#include "tests/analyses/motions.hpp"

namespace gamut {
namespace {

using namespace testing_motions;

/// y = Σ c_i p_i and its like with other signs, at rest, of p_i in [9, 12].
UncertainMotion sumOf(std::size_t quantities) {
  UncertainMotion system;
  const int n = static_cast<int>(quantities);
  system.motion.f = record(0, n, [](auto, const auto&, const auto&, auto&) {});
  system.motion.g = record(0, n, 2, [&](auto, const auto&, const auto& p, auto& y) {
    y[0] = p[0], y[1] = p[0];
    for (std::size_t i = 1; i < quantities; ++i) {
      const double c = std::cos(7.0 * static_cast<double>(i)), d = std::sin(5.0 * static_cast<double>(i));
      y[0] = y[0] + c * p[i];
      y[1] = y[1] + d * p[i];
    }
  });
  system.motion.times = {0};
  system.nominal.assign(quantities, 10.0);
  system.uncertain.assign(quantities, uniformly("p", 9, 10, 12));
  for (std::size_t q = 0; q < quantities; ++q) {
    system.uncertain[q].name += std::to_string(q);
    system.slot.push_back(static_cast<int>(q));
  }
  return system;
}

TEST(NamedCorners, ReachTheEndsOfSumsWhateverTheNumberOfQuantities) {
  for (const std::size_t quantities : {std::size_t{9}, std::size_t{10}, std::size_t{11}, std::size_t{30}})
    for (const bool hasCuts : {false, true}) {
      const UncertainMotion system = sumOf(quantities);
      EnsembleOptions options;
      options.samples = 64;
      if (hasCuts) options.alpha = {0, 0.25, 0.5, 0.75, 1};
      options.transformation = Transformation::extended;
      EnsembleRun run(system, options);
      run.integrateOthers();
      EXPECT_TRUE(run.isComplete());
      EXPECT_LE(run.sampling().size(), run.mostSamples());
      const auto reached = [&](const Envelope& envelope, double lower, double upper) {
        for (std::size_t output = 0; output < 2; ++output) {
          double least = lower, greatest = upper;
          for (std::size_t i = 1; i < quantities; ++i) {
            const double x = (output == 0 ? 7.0 : 5.0) * static_cast<double>(i);
            const double c = output == 0 ? std::cos(x) : std::sin(x);
            least += c > 0 ? c * lower : c * upper;
            greatest += c > 0 ? c * upper : c * lower;
          }
          EXPECT_NEAR(envelope.lower(0, output), least, 1e-9) << quantities;
          EXPECT_NEAR(envelope.upper(0, output), greatest, 1e-9) << quantities;
        }
      };
      reached(run.envelope(), 9, 12);
      if (!hasCuts) continue;
      const std::vector<Envelope> cuts = run.innerCuts();
      ASSERT_EQ(cuts.size(), 5U);
      reached(cuts[2], 9.5, 11);
      // A sample of theirs comes again.
      EnsembleOptions known = options;
      known.turning = run.turning();
      const std::size_t last = run.sampling().size() - 1, first = run.sampling().centre() + 1;
      for (const std::size_t number : {first, (first + last) / 2, last}) {
        const SampleBlock replayed = replaySample(system, known, number);
        std::vector<double> values(quantities);
        run.sampling().toValues(number, system.uncertain, values);
        EXPECT_EQ(std::memcmp(replayed.values(0).data(), values.data(), quantities * sizeof(double)), 0);
      }
    }
}

TEST(NamedCorners, AreNotMoreThanMayBe) {
  constexpr std::size_t quantities = 12, times = 200, outputs = 40;
  SampleBlock block(0, 2 * quantities, false, quantities, times, outputs);
  for (std::size_t i = 0; i < block.size(); ++i)
    for (std::size_t t = 0; t < times; ++t)
      for (std::size_t o = 0; o < outputs; ++o)
        block(i, t, o) = std::sin(static_cast<double>(1 + i) * static_cast<double>(t + 3) + static_cast<double>(o * o));
  const std::vector<Box> boxes(5, Box(quantities, Interval(0.0, 1.0)));
  const TransformationPoints points = namedCorners(block, boxes, times, outputs);
  EXPECT_LE(points.size(), mostNamedCorners);
  EXPECT_GT(points.size(), mostNamedCorners / 2);
  for (std::size_t i = 0; i < block.size(); ++i)
    for (std::size_t t = 0; t < times; ++t)
      for (std::size_t o = 0; o < outputs; ++o) block(i, t, o) = 3;  // nothing depends on anything
  EXPECT_EQ(namedCorners(block, boxes, times, outputs).size(), 0U);
}

}  // namespace
}  // namespace gamut
