// Probabilities and sensitivities of a study: what is asked, what the samples say of it, what the file keeps.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "analyses/samples/ensemble.hpp"
#include "studies/analyses/derivatives.hpp"
#include "studies/machine.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

/// The pendulum of sampleStudy with a length and a mass that are uncertain too, named before the state's uncertainty or
/// behind it, and independent samples.
Study asked(const std::string& plan, bool isAngleLast = false) {
  const std::string others = R"([[uncertain]]
name = "length"
quantity = "rod.length"
interval = "± 2 %"
distribution = { type = "triangular" }
[[uncertain]]
name = "mass"
quantity = "bob.mass"
interval = "± 5 %"
)";
  const std::string anchor = isAngleLast ? "[[uncertain]]\nname = \"start\"" : "[[output]]\nname = \"angle\"";
  std::string text = sampleStudyWith(anchor, others + anchor);
  text.replace(text.find("[stochastic]"), std::string::npos,
               plan + "\n[stochastic]\nsamples = 4096\nplan = \"random\"\nseed = 7\n");
  return readStudyText(text, "s.toml");
}

TEST(Probabilities, AreAskedForAtSomeTimes) {
  EXPECT_EQ(asked("").distribution.count, 10U);
  EXPECT_EQ(asked("[distribution]\ntimes = 3\n").distribution.count, 3U);
  const Study study = asked("[distribution]\ntimes = [\"250 ms\", 0.5, 0.25]\ngap = \"1 %\"\n");
  EXPECT_THAT(study.distribution.times, ElementsAre(0.25, 0.5));
  EXPECT_EQ(study.distribution.gap, 0.01);
  EXPECT_THAT(study.times, ElementsAre(0, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5));
  const auto refusal = [](const std::string& text) { return [text] { asked("[distribution]\n" + text + "\n"); }; };
  EXPECT_THAT(refusal("times = [0.6]"),
              ThrowsMessage<StudyError>(HasSubstr("distribution.times has 0.6 s, outside the study's time; expected "
                                                  "times from 0 s to 0.5 s")));
  EXPECT_THAT(refusal("gap = 0"), ThrowsMessage<StudyError>(HasSubstr("distribution.gap is not between 0.001 and 1")));
  EXPECT_THAT(refusal("time = 3"), ThrowsMessage<StudyError>(HasSubstr("expected 'times'?")));
}

/// Quantities in either order: bounds hold the shares of samples but for the band that their number leaves.
TEST(Probabilities, HoldTheSharesOfSamples) {
  for (const bool isAngleLast : {false, true}) {
    const Results results = run(asked("[distribution]\ntimes = [0.1, 0.3, 0.5]\n", isAngleLast));
    const DistributionResult& distribution = results.distribution;
    ASSERT_TRUE(distribution.present);
    EXPECT_EQ(distribution.why, "");
    EXPECT_LE(distribution.gap, 0.005);
    EXPECT_THAT(distribution.time, ElementsAre(0.1, 0.3, 0.5));
    const double surely = std::sqrt(std::log(2 / 1e-9) / (2.0 * 4096));
    EXPECT_LT(distribution.band, surely);
    EXPECT_GT(distribution.band, 0.5 * surely / 3);
    ASSERT_EQ(distribution.excess.data.size(), 6U);
    for (const double excess : distribution.excess.data) {
      EXPECT_GE(excess, 0);
      EXPECT_LE(excess, surely);
    }
    for (std::size_t i = 0; i < distribution.value.data.size(); ++i)
      if (!std::isnan(distribution.value.data[i])) {
        EXPECT_LE(distribution.lower.data[i], distribution.sampled.data[i] + surely);
        EXPECT_GE(distribution.upper.data[i], distribution.sampled.data[i] - surely);
      }
    // The motion does not depend on the mass; all of the variance is the others'.
    const SensitivityResult& sensitivity = results.sensitivity;
    EXPECT_THAT(sensitivity.time, ElementsAre(0, 0.1, 0.2, 0.3, 0.4, 0.5));
    const std::size_t mass = isAngleLast ? 1 : 2;
    for (std::size_t cell = 0; cell < 12; ++cell) {
      if (cell == 0) continue;  // the angle at the start is the uncertain one itself
      EXPECT_LT(sensitivity.total.upper.data[cell * 3 + mass], 1e-4);
      double least = 0;
      for (std::size_t q = 0; q < 3; ++q) least += sensitivity.total.lower.data[cell * 3 + q];
      EXPECT_GT(least, 0.999);
      EXPECT_NEAR(results.stochastic.mean.data[cell],
                  0.5 * (sensitivity.mean.lower.data[cell] + sensitivity.mean.upper.data[cell]),
                  6 * sensitivity.deviation.upper.data[cell] / 64);
    }
  }
}

/// Samples are of one of the joint distributions that bounds hold for: of a copula, or independent where nothing is
/// known.
TEST(Probabilities, HoldForDependentQuantities) {
  double gap = 0;
  for (const char* how : {"rank_correlation = -0.8", "unknown = true"}) {
    const Results results = run(asked("[[dependence]]\nquantities = [\"start\", \"length\"]\n" + std::string(how) +
                                      "\n[distribution]\ntimes = [0.3, 0.5]\n"));
    EXPECT_EQ(results.comparison.verdict, Agreement::inside);
    const DistributionResult& distribution = results.distribution;
    ASSERT_TRUE(distribution.present);
    EXPECT_GT(distribution.gap, gap);  // less is known of them
    gap = distribution.gap;
    const double surely = std::sqrt(std::log(2 / 1e-9) / (2.0 * 4096));
    for (const double excess : distribution.excess.data) EXPECT_LE(excess, surely);
    EXPECT_NE(results.sensitivity.why, "");
    EXPECT_THAT(results.sensitivity.first.lower.data, Each(::testing::IsNan()));
    EXPECT_GT(
        *std::ranges::max_element(results.sensitivity.pinched.data, {}, [](double x) { return std::isnan(x) ? 0 : x; }),
        0.5);
    const KeptSamples& kept = results.stochastic.kept;
    ASSERT_GE(kept.number.size(), 4096U);
    double both = 0, one = 0, other = 0;
    for (std::size_t i = 0; i < 4096; ++i) {
      const double x = kept.values[3 * i] - results.uncertain[0].nominal,
                   y = kept.values[3 * i + 1] - results.uncertain[1].nominal;
      both += x * y, one += x * x, other += y * y;
    }
    // The picture's samples are among these: the bob hangs as far from the hinge, at the angle, that theirs say.
    const Places& places = results.picture.places;
    ASSERT_GE(places.sample.size(), 2U);
    const std::size_t points = results.picture.points.size(), times = places.time.size();
    for (std::size_t i = 0; i < places.sample.size(); ++i) {
      const auto of = std::ranges::find(kept.number, places.sample[i]) - kept.number.begin();
      const double* values = &kept.values[3 * static_cast<std::size_t>(of)];
      double nearest = 1;
      for (std::size_t p = 0; p < points; ++p) {
        const double* at = &places.samples[(i * times * points + p) * 3];
        nearest = std::min(
            nearest, std::hypot(at[1] - values[1] * std::sin(values[0]), at[2] + values[1] * std::cos(values[0])));
      }
      EXPECT_LT(nearest, 1e-9) << how << ", sample " << places.sample[i];
    }
    const bool isKnown = std::string(how) != "unknown = true";
    EXPECT_NEAR(both / std::sqrt(one * other), isKnown ? -0.8 : 0.0, 0.05);
    EXPECT_EQ(results.dependence,
              isKnown ? "start, length: Gaussian copula, rank correlation -0.8"
                      : "start, length: unknown; samples are of one of the joint distributions that are possible");
  }
  EXPECT_GT(gap, 0.1);
}

TEST(Probabilities, AreNotBoundedWhereNobodyAsks) {
  EXPECT_FALSE(run(asked("[distribution]\ntimes = 0\n")).distribution.present);
}

TEST(Probabilities, AreNotKnownWhereTheEnclosureEndsAtOnce) {
  TemporaryFolder folder;
  Study study = asked("[distribution]\ntimes = 2\n");
  study.flow.split = false;
  study.flow.maxWidth = 1e-3;
  const Results results = run(study);
  EXPECT_LT(results.interval.reached, 0.1);
  EXPECT_TRUE(results.distribution.present);
  EXPECT_EQ(results.distribution.gap, 1);
  EXPECT_THAT(results.distribution.why, HasSubstr("wider than the limit"));
  for (const double time : results.sensitivity.time) EXPECT_EQ(time, 0);  // where the start says it
  writeResults(results, folder.path("r.h5"));
  EXPECT_THAT(differences(results, readResults(folder.path("r.h5"))), IsEmpty());
}

TEST(Probabilities, AreKeptInTheFile) {
  TemporaryFolder folder;
  Results results = run(asked("[distribution]\ntimes = 2\n"));
  writeResults(results, folder.path("r.h5"));
  EXPECT_THAT(differences(results, readResults(folder.path("r.h5"))), IsEmpty());
  results.distribution.lower.data[1] = 2;
  writeResults(results, folder.path("wrong.h5"));
  EXPECT_ANY_THROW(readResults(folder.path("wrong.h5")));
}

TEST(Derivatives, AreAskedForInDynamicsAlone) {
  EXPECT_FALSE(asked("").analyses.front()->isAsked());
  EXPECT_TRUE(asked("[sensitivity]\nderivatives = true\n").analyses.front()->isAsked());
  EXPECT_THAT([] { asked("[sensitivity]\nderivative = true\n"); },
              ThrowsMessage<StudyError>(HasSubstr("expected 'derivatives'?")));
}

/// The mean value theorem: between two values of one quantity an output changes by one of the derivatives in between
/// times their distance.
TEST(Derivatives, HoldWhatOutputsChangeBy) {
  const Study study = asked("[sensitivity]\nderivatives = true\n[distribution]\ntimes = 0\n");
  const Results results = run(study);
  const DerivativeResult& derivatives = results.of<DerivativeResult>();
  ASSERT_TRUE(derivatives.present);
  EXPECT_EQ(derivatives.why, "");
  EXPECT_EQ(derivatives.reached, 0.5);
  ASSERT_EQ(derivatives.time, study.times);
  const Machine machine(study);
  std::vector<double> nominal;
  for (const UncertainQuantity& q : study.uncertain) nominal.push_back(q.uncertain.nominal);
  for (std::size_t q = 0; q < nominal.size(); ++q) {
    const auto outputsAt = [&](double value) {
      std::vector<double> values = nominal;
      values[q] = value;
      return integrateValues(machine.motion, study.ensemble, values).trajectory(0);
    };
    const Interval& range = study.uncertain[q].uncertain.range;
    const std::vector<double> below = outputsAt(range.lower()), above = outputsAt(range.upper());
    for (std::size_t row = 0; row < derivatives.time.size(); ++row)
      for (std::size_t k = 0; k < 2; ++k) {
        const double change = (above[row * 2 + k] - below[row * 2 + k]) / width(range), error = 1e-8 / width(range);
        const double lower = derivatives.lower(row, k, q), upper = derivatives.upper(row, k, q);
        EXPECT_LE(lower, change + error) << row << ' ' << k << ' ' << q;
        EXPECT_GE(upper, change - error) << row << ' ' << k << ' ' << q;
        EXPECT_LE(upper - lower, 0.2 * (1 + std::fabs(change)));
      }
  }
}

/// The angle's start drives the angle; a pendulum does not depend on its mass.
TEST(Sensitivities, RankByPinchingAndByInfluence) {
  const Results results = run(asked("[distribution]\ntimes = [0.5]\n"));
  const SensitivityResult& s = results.sensitivity;
  const std::size_t at = s.time.size() - 1;
  ASSERT_EQ(s.time.back(), 0.5);
  const auto pinched = [&](std::size_t q) { return s.pinched(at, 0, q); };
  std::vector<std::size_t> of(3);
  for (std::size_t q = 0; q < 3; ++q)
    of[results.uncertain[q].name == "start" ? 0 : results.uncertain[q].name == "length" ? 1 : 2] = q;
  EXPECT_GT(pinched(of[0]), 0.05);
  EXPECT_GT(pinched(of[1]), 0.05);
  EXPECT_NEAR(pinched(of[2]), 0, 1e-6);
  EXPECT_NEAR(pinched(of[0]) + pinched(of[1]), 1, 0.1);  // nearly a sum
  const InfluenceResult& influence = results.fuzzy.influence;
  ASSERT_TRUE(influence.present);
  const std::span<const double> last = influence.share.row(influence.time.size() - 1, 0);
  EXPECT_NEAR(last[of[0]] + last[of[1]], 1, 1e-6);
  EXPECT_NEAR(last[of[2]], 0, 1e-6);
}

}  // namespace
}  // namespace gamut
