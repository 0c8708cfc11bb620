// The sampled ensemble against known solutions; the same numbers whatever the number of jobs, the vector unit, and
// whether a sample's pack is integrated with the others or alone.
#include "analyses/samples/ensemble.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>
#include <span>
#include <stdexcept>

#include "analyses/samples/pack_witness.hpp"
#include "tests/analyses/motions.hpp"
#include "tests/analyses/whole_ensemble.hpp"

namespace gamut {
namespace {

using namespace testing_motions;
using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

EnsembleOptions samples(std::size_t count, int jobs = 1) {
  EnsembleOptions options;
  options.samples = count;
  options.jobs = jobs;
  return options;
}

/// Greatest distance of the oscillator's samples from the known solution.
double oscillatorError(const WholeEnsemble& e) {
  double error = 0;
  for (std::size_t i = 0; i < e.size(); ++i)
    for (std::size_t t = 0; t < e.times.size(); ++t) {
      const double w = e.valuesOf(i)[0], a = e.valuesOf(i)[1];
      error = std::max(error, std::abs(e(i, t, 0) - a * std::cos(w * e.times[t])));
      error = std::max(error, std::abs(e(i, t, 1) + a * w * std::sin(w * e.times[t])));
    }
  return error;
}

/// x = 1 / (1 - p t) ends at 1/p.
UncertainMotion singularMotion() {
  UncertainMotion system = decay(1.0, 10);
  system.motion.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sqr(x[0]); });
  return system;
}

bool sameBits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(Ensemble, FollowsTheHarmonicOscillatorInEverySampleCornerAndTheCentre) {
  for (Method method : {Method::adams, Method::bdf}) {
    EnsembleOptions options = samples(40);
    options.method = method;
    const WholeEnsemble e = sampleEnsemble(oscillator(), options);
    EXPECT_EQ(e.size(), 48u + 4u + 1u);  // a multiple of 16
    EXPECT_LT(oscillatorError(e), method == Method::adams ? 3e-8 : 3e-7);
    EXPECT_TRUE(e.complete);
    EXPECT_EQ(e.reached, 3);
    EXPECT_EQ(e.why, "");
    EXPECT_EQ(e(e.centre(), 0, 0), 1);
  }
}

TEST(Ensemble, IsTheSameBitByBitWhateverTheNumberOfJobs) {
  const WholeEnsemble one = sampleEnsemble(oscillator(), samples(1000, 1));
  const WholeEnsemble three = sampleEnsemble(oscillator(), samples(1000, 3));
  EXPECT_TRUE(sameBits(one.data, three.data));
  EXPECT_TRUE(sameBits(one.values, three.values));
  EXPECT_TRUE(sameBits(one.error.data, three.error.data));
  EXPECT_TRUE(sameBits(one.summary.upper.data, three.summary.upper.data));
  EXPECT_TRUE(sameBits(one.statistics.mean.data, three.statistics.mean.data));
  EXPECT_TRUE(sameBits(one.statistics.deviation.data, three.statistics.deviation.data));
  for (std::size_t q = 0; q < 5; ++q)
    EXPECT_TRUE(sameBits(one.statistics.quantiles[q].data, three.statistics.quantiles[q].data));
}

/// The samples number 0 … packWidth-1 of an ensemble as a pack.
std::vector<double> packOf(const UncertainMotion& system, const Ensemble& e) {
  std::vector<double> starts(system.nominal.size() * packWidth);
  for (std::size_t lane = 0; lane < packWidth; ++lane) {
    const std::vector<double> start = system.start(e.valuesOf(lane));
    for (std::size_t row = 0; row < start.size(); ++row) starts[row * packWidth + lane] = start[row];
  }
  return starts;
}

TEST(ReplaySample, GivesEverySampleOfFullAndPartPacksAgainBitByBit) {
  // 100 samples: a full pack and one of 36. 68: a full pack and 4 alone. 4 corners and the centre: alone.
  for (std::size_t count : {100u, 68u}) {
    const WholeEnsemble e = sampleEnsemble(oscillator(), samples(count));
    for (std::size_t i = 0; i < e.size(); ++i)
      ASSERT_TRUE(sameBits(replaySample(oscillator(), samples(count), i).trajectory(0), e.trajectory(i))) << i;
  }
}

TEST(ReplaySample, HoldsForBdfForFailedSamplesAndForMotionsWithoutStates) {
  EnsembleOptions bdf = samples(20);
  bdf.method = Method::bdf;
  const WholeEnsemble stiff = sampleEnsemble(oscillator(), bdf);
  EXPECT_TRUE(sameBits(replaySample(oscillator(), bdf, 17).trajectory(0), stiff.trajectory(17)));
  const UncertainMotion singular = singularMotion();
  const WholeEnsemble failed = sampleEnsemble(singular, samples(64));
  ASSERT_FALSE(failed.failed.empty());
  for (std::size_t i : {failed.failed.front().number, std::size_t{0}, failed.centre()})
    EXPECT_TRUE(sameBits(replaySample(singular, samples(64), i).trajectory(0), failed.trajectory(i))) << i;
  const WholeEnsemble still = sampleEnsemble(line(), samples(100));
  EXPECT_TRUE(sameBits(replaySample(line(), samples(100), 99).trajectory(0), still.trajectory(99)));
}

TEST(ReplaySample, RefusesANumberThatNoSampleHas) {
  EXPECT_NO_THROW(replaySample(decay(), samples(16), 18));
  EXPECT_THAT([] { replaySample(decay(), samples(16), 19); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no sample has the number 19")));
}

TEST(Ensemble, TakesAsManyBytesAsTheFirstSamplesOrABlockAndTheStatistics) {
  EXPECT_LT(ensembleBytes({1, 2, 1}), 1e7);                // 8192 samples of two numbers
  EXPECT_LT(ensembleBytes({301, 7, 1, 4096, 11}), 1.2e8);  // 64 MiB of samples
  EXPECT_GT(ensembleBytes({301, 7, 1, 4096, 11}), 6.7e7);
  EXPECT_LT(ensembleBytes({2001, 310, 2, 4096, 11}), 1.3e9);
  EXPECT_LT(ensembleBytes({2001, 310, 12, 4096, 11}), 1.3e9);  // 2049 corners make no difference
  EXPECT_GT(ensembleBytes({50001, 2000, 1}), 5e10);            // a pack alone
}

TEST(Ensemble, SaysHowManySamplesAreIntegratedTogether) {
  EnsembleOptions options = samples(20);
  EXPECT_EQ(sampleEnsemble(decay(), options).packWidth, 64u);
  options.method = Method::bdf;
  EXPECT_EQ(sampleEnsemble(decay(), options).packWidth, 1u);
}

TEST(Ensemble, APackHoldsThePlansSamplesOfItsNumbersWhateverFollows) {
  const WholeEnsemble shorter = sampleEnsemble(oscillator(), samples(128)),
                      longer = sampleEnsemble(oscillator(), samples(256));
  for (std::size_t i = 0; i < 128; ++i) ASSERT_TRUE(sameBits(shorter.trajectory(i), longer.trajectory(i))) << i;
}

TEST(Ensemble, FewSamplesAreIntegratedOneByOne) {
  const UncertainMotion system = oscillator();
  const WholeEnsemble e = sampleEnsemble(system, samples(5));
  std::vector<double> alone(31 * 2);
  for (std::size_t i = 0; i < e.size(); ++i) {
    Witness(system.motion).integrate(system.start(e.valuesOf(i)), {}, alone);
    EXPECT_TRUE(sameBits(alone, e.trajectory(i))) << i;
  }
}

TEST(Ensemble, APackWithASampleThatFailsIsIntegratedOneByOne) {
  UncertainMotion system = decay(1.0, 10);
  system.motion.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sqr(x[0]); });
  const WholeEnsemble e = sampleEnsemble(system, samples(64));
  std::vector<double> alone(11);
  auto failure = e.failed.begin();
  std::size_t failures = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const Integration run = Witness(system.motion).integrate(system.start(e.valuesOf(i)), {}, alone);
    EXPECT_TRUE(sameBits(alone, e.trajectory(i))) << i;
    if (run.times == 11) continue;
    ++failures;
    if (failure == e.failed.end()) continue;  // only the first are named
    EXPECT_EQ(failure->number, i);
    EXPECT_EQ(failure->times, run.times);
    EXPECT_EQ(failure->reached, run.reached);
    EXPECT_EQ(failure->why, run.why);
    ++failure;
  }
  EXPECT_EQ(failure, e.failed.end());
  EXPECT_EQ(e.failures, failures);
  EXPECT_GT(e.failures, 20u);
}

TEST(PackWitness, GivesTheSameBitsOnEveryVectorUnit) {
  const UncertainMotion system = oscillator();
  const std::vector<double> starts = packOf(system, sampleEnsemble(system, samples(64)));
  std::vector<double> baseline(31 * 2 * packWidth), other(baseline.size());
  PackWitness(system.motion, nullptr, VectorUnit::baseline).integrate(starts, {}, baseline);
  for (VectorUnit unit : usableUnits()) {
    EXPECT_EQ(PackWitness(system.motion, nullptr, unit).integrate(starts, {}, other).times, 31u);
    EXPECT_TRUE(sameBits(baseline, other)) << nameOf(unit);
  }
}

TEST(PackWitness, ForgetsWhatItIntegratedBefore) {
  const UncertainMotion system = oscillator();
  const std::vector<double> starts = packOf(system, sampleEnsemble(system, samples(64)));
  std::vector<double> fresh(31 * 2 * packWidth), used(fresh.size()), twice = starts;
  for (double& value : twice) value *= 2;
  PackWitness(system.motion).integrate(starts, {}, fresh);
  PackWitness witness(system.motion);
  witness.integrate(twice, {1e-6, 1e-8}, used);
  witness.integrate(starts, {}, used);
  EXPECT_TRUE(sameBits(fresh, used));
}

/// The one sample that moves fast decides on the steps: as accurate as alone, though 63 others hardly move.
TEST(PackWitness, EverySampleIsAsAccurateAsAloneWhereverItIsInThePack) {
  const UncertainMotion system = oscillator();
  std::vector<double> starts(3 * packWidth), trajectories(31 * 2 * packWidth), alone(31 * 2);
  Witness(system.motion).integrate(std::vector{1.0, 0.0, 20.0}, {}, alone);
  const auto errorOf = [](std::size_t t, double value) {
    return std::abs(value - std::cos(20.0 * 3.0 * static_cast<double>(t) / 30.0));
  };
  double aloneError = 0;
  for (std::size_t t = 0; t < 31; ++t) aloneError = std::max(aloneError, errorOf(t, alone[2 * t]));
  for (std::size_t fast = 0; fast < packWidth; fast += 9) {
    for (std::size_t lane = 0; lane < packWidth; ++lane) {
      starts[lane] = 1;
      starts[2 * packWidth + lane] = lane == fast ? 20 : 0.01;
    }
    ASSERT_EQ(PackWitness(system.motion).integrate(starts, {}, trajectories).times, 31u);
    for (std::size_t t = 0; t < 31; ++t)
      ASSERT_LE(errorOf(t, trajectories[2 * t * packWidth + fast]), 2 * aloneError) << fast << ' ' << t;
  }
}

TEST(PackWitness, EndsWithTheFirstSampleThatCannotGoOn) {
  UncertainMotion system = decay(1.0, 10);
  system.motion.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sqr(x[0]); });
  std::vector<double> starts(2 * packWidth, 1.0), trajectories(11 * packWidth);
  std::fill_n(starts.begin() + packWidth, packWidth, 0.5);  // x = 1 / (1 - p t)
  EXPECT_EQ(PackWitness(system.motion).integrate(starts, {}, trajectories).times, 11u);
  starts[packWidth + 37] = 2;
  const Integration run = PackWitness(system.motion).integrate(starts, {}, trajectories);
  EXPECT_EQ(run.times, 5u);  // 0 … 0.4
  EXPECT_THAT(run.reached, DoubleNear(0.5, 1e-3));
  EXPECT_NE(run.why, "");
}

TEST(PackWitness, RefusesAPackOfAnotherSize) {
  const UncertainMotion system = decay();
  std::vector<double> starts(2 * packWidth, 1.0), trajectories(41 * packWidth - 1);
  EXPECT_THROW(PackWitness(system.motion).integrate(starts, {}, trajectories), std::invalid_argument);
}

TEST(Witness, ForgetsWhatItIntegratedBefore) {
  const UncertainMotion system = oscillator();
  std::vector<double> fresh(31 * 2), used(31 * 2), other(31 * 2);
  Witness(system.motion).integrate(std::vector{1.0, 0.0, 2.0}, {}, fresh);
  Witness witness(system.motion);
  witness.integrate(std::vector{0.3, 5.0, 9.0}, {1e-6, 1e-8}, other);
  witness.integrate(std::vector{1.0, 0.0, 2.0}, {}, used);
  EXPECT_TRUE(sameBits(fresh, used));
}

TEST(Tolerance, IsTightenedInBothPartsButNotBeyondWhatDoublesCanDo) {
  const Tolerance usual = Tolerance{1e-10, 1e-12}.tightened(100);
  EXPECT_DOUBLE_EQ(usual.relative, 1e-12);
  EXPECT_DOUBLE_EQ(usual.absolute, 1e-14);
  EXPECT_EQ((Tolerance{1e-13, 1e-15}.tightened(100).relative), 1e-14);
  EXPECT_EQ((Tolerance{5e-15, 1e-15}.tightened(100).relative), 5e-15);
}

TEST(Witness, TighterTolerancesComeCloserToTheSolution) {
  const UncertainMotion system = oscillator();
  std::vector<double> y(31 * 2);
  double before = 1;
  for (double relative : {1e-6, 1e-8, 1e-10, 1e-12}) {
    Witness(system.motion).integrate(std::vector{1.0, 0.0, 2.0}, {relative, relative * 1e-2}, y);
    double error = 0;
    for (std::size_t t = 0; t < 31; ++t)
      error = std::max(error, std::abs(y[2 * t] - std::cos(0.2 * static_cast<double>(t))));
    EXPECT_LT(error, 0.2 * before);
    EXPECT_LT(error, 200 * relative);  // between the solver's own steps too
    before = error;
  }
}

TEST(Ensemble, TheMeasuredWitnessErrorIsTheActualOne) {
  const WholeEnsemble e = sampleEnsemble(oscillator(), samples(400));
  double measured = 0;
  for (double error : e.error.data) measured = std::max(measured, error);
  const double actual = oscillatorError(e);
  EXPECT_GT(measured, 0.5 * actual);   // of some samples, which need not be the worst
  EXPECT_LT(measured, 1.01 * actual);  // against integrations of a hundredth of the error
}

TEST(Ensemble, TheEnvelopeOfAMonotoneMotionHasItsEndsAtTheCorners) {
  const WholeEnsemble e = sampleEnsemble(decay(), samples(20));
  const Envelope envelope = e.envelope();
  for (std::size_t t = 0; t < e.times.size(); ++t) {
    EXPECT_THAT(envelope.lower(t, 0), DoubleNear(std::exp(-1.5 * e.times[t]), 1e-8));
    EXPECT_THAT(envelope.upper(t, 0), DoubleNear(std::exp(-0.5 * e.times[t]), 1e-8));
  }
}

TEST(Statistics, OfALinearMapAreTheMapOfTheDistributions) {
  EnsembleOptions options = samples(101);
  options.plan = Plan::grid;  // p = 0, 0.01 … 1
  const WholeEnsemble e = sampleEnsemble(line(), options);
  const Statistics& s = e.statistics;
  ASSERT_EQ(s.quantiles.size(), 5u);
  const double expected[] = {0.01, 0.05, 0.5, 0.95, 0.99};
  EXPECT_LT(s.resolution(0, 0), 3.0 / 4000);  // 4096 bins over half again as much as the width of 2
  for (std::size_t q = 0; q < 5; ++q) {
    EXPECT_THAT(s.quantiles[q](0, 0), DoubleNear(1 + 2 * expected[q], s.resolution(0, 0)));
    EXPECT_THAT(s.quantiles[q](1, 0), DoubleNear(2 + 2 * expected[q], s.resolution(1, 0)));
  }
  EXPECT_THAT(s.mean(0, 0), DoubleNear(2, 1e-14));
  // Σ (i-50)² 1e-4 · 4 / 100 over i = 0 … 100, Σ (i-50)² = 85850
  EXPECT_THAT(s.deviation(0, 0), DoubleNear(std::sqrt(85850 * 1e-4 * 4 / 100), 1e-14));
}

TEST(Statistics, QuantilesBetweenSamplesAreInterpolated) {
  EnsembleOptions options = samples(3);
  options.plan = Plan::grid;  // y = 1, 2, 3
  const Statistics s = sampleEnsemble(line(), options, {0, 0.125, 0.25, 0.9, 1}).statistics;
  const double expected[] = {1, 1.25, 1.5, 2.8, 3};
  for (std::size_t q = 0; q < 5; ++q) EXPECT_THAT(s.quantiles[q](0, 0), DoubleNear(expected[q], s.resolution(0, 0)));
}

TEST(Statistics, CornersAndCentreHaveNoWeight) {
  const WholeEnsemble e = sampleEnsemble(decay(), samples(16));
  double sum = 0;
  for (std::size_t i = 0; i < 16; ++i) sum += e(i, 40, 0);
  EXPECT_THAT(e.statistics.mean(40, 0), DoubleNear(sum / 16, 1e-15));
}

TEST(Ensemble, NamesTheSamplesThatFailAndKeepsTheOthers) {
  const UncertainMotion system = singularMotion();
  EnsembleOptions options = samples(32, 2);
  options.alpha = {0, 0.5};
  const WholeEnsemble e = sampleEnsemble(system, options);
  ASSERT_EQ(e.failed.size(), e.failures);
  ASSERT_GT(e.failures, 10u);
  EXPECT_TRUE(std::ranges::is_sorted(e.failed, {}, &FailedSample::number));
  for (const FailedSample& failure : e.failed) {
    const double p = e.valuesOf(failure.number)[0];
    EXPECT_GE(p, 1 - 1e-6);
    EXPECT_THAT(failure.reached, DoubleNear(1 / p, 1e-3));
    EXPECT_NE(failure.why, "");
  }
  std::size_t arrived = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double p = e.valuesOf(i)[0];
    if (p > 0.99) continue;
    ++arrived;
    EXPECT_THAT(e(i, 10, 0) * (1 - p), DoubleNear(1, 1e-6));
  }
  EXPECT_GT(arrived, 10u);
  EXPECT_THAT(e.reached, DoubleNear(0.6, 1e-15));  // the corner p = 1.5 ends at 2/3
  EXPECT_THAT(e.why, HasSubstr("sample " + std::to_string(e.failed.front().number) + " failed"));
  EXPECT_THAT(e.why, HasSubstr(" s: its steps became too short, as where the motion runs into a singularity"));
  EXPECT_THAT(e.why, HasSubstr("; beyond, nothing is shown of the samples"));
  EXPECT_EQ(e.reachedTimes, 7u);
  for (std::size_t t = 0; t < 11; ++t)  // no envelope and no statistics of the survivors
    for (const double value :
         {e.summary.lower(t, 0), e.summary.upper(t, 0), e.statistics.mean(t, 0), e.statistics.deviation(t, 0),
          e.statistics.quantiles[2](t, 0), e.statistics.resolution(t, 0), e.innerCuts[1].upper(t, 0)})
      EXPECT_EQ(std::isnan(value), t > 6) << t;
  EXPECT_TRUE(e.complete);
}

TEST(Ensemble, AMotionWithoutStatesIsEvaluatedDirectly) {
  const WholeEnsemble e = sampleEnsemble(line(), samples(10));
  for (std::size_t i = 0; i < e.size(); ++i) EXPECT_EQ(e(i, 1, 0), 2.0 * e.valuesOf(i)[0] + 1.0 + 1.0);
  EXPECT_LE(e.error(1, 0), 2e-15);
}

TEST(Ensemble, KeepsWhatHasEndedWhenCancelledAndSaysSo) {
  std::atomic<bool> cancelled = false;
  EnsembleOptions options = samples(500000);  // of one output at two times: 8192 a block
  options.cancelled = &cancelled;
  options.progress = [&](double done) { cancelled = done > 0.1; };
  const UncertainMotion system = line();
  EnsembleRun run(system, options);
  run.integrateFirst();
  run.integrateOthers();
  EXPECT_FALSE(run.isComplete());
  EXPECT_EQ(run.why(), "");
  EXPECT_GE(run.counted(), 256u + 8192u);
  EXPECT_LT(run.counted(), 100000u);
  EXPECT_EQ(run.counted() % 64, 0u);
  EXPECT_EQ(run.reached(), 1);
  EXPECT_THAT(run.statistics().mean(0, 0), DoubleNear(2, 1e-3));
}

TEST(Ensemble, TheFirstSamplesAndCornersCountWhenTheOthersAreCancelled) {
  std::atomic<bool> cancelled = false;
  EnsembleOptions options = samples(5000);
  options.cancelled = &cancelled;
  const UncertainMotion system = oscillator();
  EnsembleRun run(system, options);
  run.integrateFirst();
  cancelled = true;
  std::size_t looked = 0;
  run.integrateOthers({}, [&](SampleBlock& block) { looked += block.size(); });
  EXPECT_EQ(looked, 256u + 4u + 1u);
  EXPECT_EQ(run.counted(), 256u);
  EXPECT_EQ(run.integrated(), 256u + 5u);
  EXPECT_FALSE(run.isComplete());
  EXPECT_EQ(run.reached(), 3);
  EXPECT_EQ(run.envelope().upper(0, 0), 1.5);  // a corner
}

TEST(Ensemble, IsNotCompleteWhenCancelledBeforeItsErrorIsMeasuredToTheEnd) {
  std::atomic<bool> cancelled = false;
  EnsembleOptions options = samples(1008);
  options.cancelled = &cancelled;
  options.progress = [&](double done) { cancelled = done >= 0.99; };  // the last of 1033 are second integrations
  const UncertainMotion system = oscillator();
  EnsembleRun run(system, options);
  run.integrateFirst();
  run.integrateOthers();
  EXPECT_EQ(run.counted(), 1008u);
  EXPECT_FALSE(run.isComplete());
}

TEST(Ensemble, APackThatIsNotFinishedWhenCancelledCountsAsNotIntegrated) {
  std::atomic<bool> cancelled = true;
  const UncertainMotion system = oscillator();
  const std::vector<double> starts = packOf(system, sampleEnsemble(system, samples(64)));
  std::vector<double> trajectories(31 * 2 * packWidth);
  const Integration run = PackWitness(system.motion, &cancelled).integrate(starts, {}, trajectories);
  EXPECT_EQ(run.why, "cancelled");
  EXPECT_EQ(run.times, 1u);
  EnsembleOptions options = samples(640);
  options.cancelled = &cancelled;
  const WholeEnsemble e = sampleEnsemble(system, options);
  EXPECT_FALSE(e.complete);
  EXPECT_EQ(e.counted, 0u);
  EXPECT_EQ(e.reached, 0);
  EXPECT_TRUE(e.failed.empty());
  for (const Table* table : {&e.summary.lower, &e.statistics.mean, &e.statistics.quantiles[2]})
    for (const double value : table->data) ASSERT_TRUE(std::isnan(value));
}

/// The trajectories by number when the first samples are cancelled as soon as `after` of all have ended, how many there
/// are then, and the numbers of the whole run.
struct Resumed {
  std::map<std::size_t, std::vector<double>> trajectories;
  std::size_t atFirst = 0;
  bool isComplete = false;
  Table mean, error;
};

Resumed sampleInTwoGoes(const UncertainMotion& system, EnsembleOptions options, double after) {
  std::atomic<bool> cancelled = false;
  options.cancelled = &cancelled;
  options.progress = [&](double done) { cancelled = cancelled || (after > 0 && done >= after); };
  EnsembleRun first(system, options);
  first.integrateFirst();
  first.integrateOthers();
  Resumed result;
  result.atFirst = first.integrated();
  cancelled = false;
  EnsembleRun run(system, options);
  run.integrateFirst();
  cancelled = false;
  after = 0;
  run.integrateOthers({}, [&](const SampleBlock& block) {
    for (std::size_t i = 0; i < block.size(); ++i) result.trajectories[block.first() + i] = block.trajectory(i);
  });
  result.isComplete = run.isComplete();
  result.mean = run.statistics().mean;
  result.error = run.error();
  return result;
}

TEST(Ensemble, KeepsTheFirstSamplesThatEndedBeforeAnInterruptAndGoesOnBehindThem) {
  EnsembleOptions stiff = samples(100);
  stiff.method = Method::bdf;
  for (const EnsembleOptions& options : {samples(300), stiff}) {
    const UncertainMotion system = oscillator();
    const Resumed whole = sampleInTwoGoes(system, options, 0), cut = sampleInTwoGoes(system, options, 0.4);
    EXPECT_GE(cut.atFirst, 40u);
    EXPECT_LT(cut.atFirst, whole.trajectories.size());
    EXPECT_TRUE(cut.isComplete);
    ASSERT_EQ(cut.trajectories.size(), whole.trajectories.size());
    for (const auto& [number, trajectory] : whole.trajectories)
      ASSERT_TRUE(sameBits(cut.trajectories.at(number), trajectory)) << number;
    EXPECT_TRUE(sameBits(cut.error.data, whole.error.data));
    for (std::size_t i = 0; i < whole.mean.data.size(); ++i)
      EXPECT_NEAR(cut.mean.data[i], whole.mean.data[i], 1e-12) << i;
  }
}

TEST(Ensemble, GoesOnOneByOneInsideAPackThatWasGivenUp) {
  const UncertainMotion system = singularMotion();
  const Resumed whole = sampleInTwoGoes(system, samples(64), 0), cut = sampleInTwoGoes(system, samples(64), 0.3);
  EXPECT_GT(cut.atFirst, 0u);
  EXPECT_LT(cut.atFirst, 64u);
  EXPECT_TRUE(cut.isComplete);
  for (const auto& [number, trajectory] : whole.trajectories)
    ASSERT_TRUE(sameBits(cut.trajectories.at(number), trajectory)) << number;
}

TEST(Ensemble, ReportsProgressUpToOne) {
  std::mutex mutex;
  std::vector<double> reports;
  EnsembleOptions options = samples(50, 2);
  options.progress = [&](double done) {
    const std::lock_guard lock(mutex);
    reports.push_back(done);
  };
  sampleEnsemble(decay(), options);
  EXPECT_THAT(reports, ::testing::Contains(1.0));
  EXPECT_GT(reports.size(), 20u);
}

TEST(Ensemble, RefusesASystemThatDoesNotFitTogether) {
  UncertainMotion system = decay();
  system.slot = {2};
  EXPECT_THAT([&] { sampleEnsemble(system); }, ThrowsMessage<std::invalid_argument>(HasSubstr("'rate' has no place")));
  system.slot = {1, 1};
  system.uncertain.push_back(system.uncertain[0]);
  EXPECT_THAT([&] { sampleEnsemble(system); }, ThrowsMessage<std::invalid_argument>(HasSubstr("stated twice")));
  system = decay();
  system.nominal.pop_back();
  EXPECT_THROW(sampleEnsemble(system), std::invalid_argument);
  system = decay();
  system.motion.times = {0, 1, 1};
  EXPECT_THROW(sampleEnsemble(system), std::invalid_argument);
}

TEST(InnerCuts, AreNestedAndHoldTheSamplesOfTheirLevel) {
  const UncertainMotion system = oscillator();
  EnsembleOptions options = samples(300);
  options.alpha = {0, 0.25, 0.5, 0.75, 1};
  const WholeEnsemble e = sampleEnsemble(system, options);
  EXPECT_EQ(e.boxCorners, 3u * 4u);  // those of 0 are the corners, that of 1 is the centre
  std::vector<Envelope> expected(5, Envelope(31, 2));
  for (std::size_t i = 0; i < e.size(); ++i)
    for (std::size_t level = 0; level < 5; ++level) {
      const auto belongs = [&](std::size_t j) {
        return contains(system.uncertain[j].membership.cut(options.alpha[level]), e.valuesOf(i)[j]);
      };
      if (!belongs(0) || !belongs(1)) continue;
      for (std::size_t t = 0; t < 31; ++t)
        for (std::size_t o = 0; o < 2; ++o) expected[level].include(t, o, e(i, t, o));
    }
  ASSERT_EQ(e.innerCuts.size(), 5u);
  for (std::size_t level = 0; level < 5; ++level) {
    EXPECT_TRUE(sameBits(e.innerCuts[level].lower.data, expected[level].lower.data)) << level;
    EXPECT_TRUE(sameBits(e.innerCuts[level].upper.data, expected[level].upper.data)) << level;
  }
  for (std::size_t t = 0; t < 31; ++t) {  // only the centre has membership 1 in everything
    EXPECT_EQ(e.innerCuts[4].lower(t, 0), e(e.centre(), t, 0));
    EXPECT_EQ(e.innerCuts[4].upper(t, 0), e(e.centre(), t, 0));
  }
}

TEST(InnerCuts, LeaveOutWhatLiesOutsideTheMembershipsSupport) {
  UncertainMotion system = line();
  system.uncertain[0].membership = Membership::triangular(0.25, 0.5, 0.75);
  EnsembleOptions options = samples(64);
  options.alpha = {0};
  const std::vector<Envelope> cuts = sampleEnsemble(system, options).innerCuts;
  EXPECT_EQ(cuts[0].lower(0, 0), 1.5);
  EXPECT_EQ(cuts[0].upper(0, 0), 2.5);
}

/// No states: y = p0 + … + p(k-1), each in [0, 1].
UncertainMotion sumOf(int quantities) {
  UncertainMotion system = line();
  system.motion.f = record(0, quantities, [](auto, const auto&, const auto&, auto&) {});
  system.motion.g = record(0, quantities, 1, [&](auto, const auto&, const auto& p, auto& y) {
    y[0] = p[0];
    for (int j = 1; j < quantities; ++j) y[0] = y[0] + p[static_cast<std::size_t>(j)];
  });
  system.nominal.assign(static_cast<std::size_t>(quantities), 0.5);
  system.uncertain.assign(static_cast<std::size_t>(quantities), uniformly("p", 0, 0.5, 1));
  system.slot.clear();
  for (int j = 0; j < quantities; ++j) system.slot.push_back(j);
  return system;
}

/// A sample with all of six quantities in the cut of 0.9 comes up once in a million.
TEST(InnerCuts, OfManyQuantitiesReachTheCornersOfTheAlphaCuts) {
  EnsembleOptions options = samples(64);
  for (int level = 0; level < 11; ++level) options.alpha.push_back(level / 10.0);
  for (int quantities : {6, 7, 30}) {
    const WholeEnsemble e = sampleEnsemble(sumOf(quantities), options);
    for (std::size_t level = 0; level < 11; ++level) {
      EXPECT_THAT(e.innerCuts[level].lower(0, 0), DoubleNear(0.5 * quantities * options.alpha[level], 1e-12));
      if (quantities > 6) continue;  // all corners; of more quantities, some
      EXPECT_THAT(e.innerCuts[level].upper(0, 0),
                  DoubleNear(quantities - 0.5 * quantities * options.alpha[level], 1e-12));
    }
  }
}

TEST(InnerCuts, CornersOfAlphaCutsAreReplayedBitByBit) {
  EnsembleOptions options = samples(80);
  for (int level = 0; level < 11; ++level) options.alpha.push_back(level / 10.0);
  const WholeEnsemble e = sampleEnsemble(oscillator(), options);
  ASSERT_EQ(e.size(), 80u + 4u + 36u + 1u);
  for (std::size_t i : {78u, 80u, 84u, 100u, 119u, 120u})
    EXPECT_TRUE(sameBits(replaySample(oscillator(), options, i).trajectory(0), e.trajectory(i))) << i;
}

}  // namespace
}  // namespace gamut
