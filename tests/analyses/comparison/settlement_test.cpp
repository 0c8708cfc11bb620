// Samples of a motion whose range is known, x = exp(-p t), against its exact enclosure and alpha-cuts as they arrive.
#include "analyses/comparison/settlement.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <vector>

#include "analyses/comparison/unmoved.hpp"
#include "scalars/program/recorder.hpp"
#include "tests/analyses/motions.hpp"

namespace gamut {
namespace {

using namespace testing_motions;
using ::testing::Each;
using testing::Field;
using ::testing::IsEmpty;
using ::testing::Not;

struct KnownBounds {
  Envelope enclosure;
  std::vector<Envelope> cuts;
  std::size_t reachedTimes = 0;

  Proved view() const { return {enclosure, cuts, reachedTimes}; }
};

class DecaySettled : public ::testing::Test {
 protected:
  DecaySettled() {
    sampled.samples = 1008;
    sampled.alpha = {0, 0.5, 0.75};
    proved.enclosure = exactRange(Interval(0.5, 1.5));
    for (const double alpha : sampled.alpha)
      proved.cuts.push_back(exactRange(system.uncertain[0].membership.cut(alpha)));
    proved.reachedTimes = system.motion.times.size();
  }

  Envelope exactRange(const Interval& p) const {
    Envelope range(system.motion.times.size(), 1);
    for (std::size_t t = 0; t < system.motion.times.size(); ++t) {
      const Interval exact = exp(-p * system.motion.times[t]);
      range.lower(t, 0) = exact.lower();
      range.upper(t, 0) = exact.upper();
    }
    return range;
  }

  void run() {
    EnsembleRun ensemble(system, sampled);
    Settlement settlement(proved.view(), system, {});
    ensemble.integrateFirst();
    ensemble.integrateOthers(settlement.bounds(), [&](SampleBlock& block) {
      settlement.settle(block, [&](const Comparison& found, int level) {
        disputes.insert(disputes.end(), found.disputes.begin(), found.disputes.end());
        for (const Dispute& d : found.disputes) {
          arbitrated[level] += d.decided == "Taylor 128 bits";
          outside = outside || d.outside;
        }
      });
    });
    envelope = ensemble.envelope();
    innerCuts = ensemble.innerCuts();
  }

  static void expectInside(const Envelope& inner, const Envelope& outer) {
    for (std::size_t i = 0; i < outer.lower.data.size(); ++i) {
      EXPECT_LE(outer.lower.data[i], inner.lower.data[i]) << i;
      EXPECT_GE(outer.upper.data[i], inner.upper.data[i]) << i;
    }
  }

  UncertainMotion system = decay();
  EnsembleOptions sampled;
  KnownBounds proved;
  std::vector<Dispute> disputes;
  std::map<int, int> arbitrated;  // how many, by level
  bool outside = false;
  Envelope envelope;
  std::vector<Envelope> innerCuts;
};

TEST_F(DecaySettled, WhatIsSettledInsideCountsInPlaceOfWhatSeemedOutside) {
  run();
  EXPECT_FALSE(outside);
  EXPECT_THAT(disputes, Not(IsEmpty()));
  EXPECT_THAT(disputes, Each(Field(&Dispute::distance, 0)));
  for (const Dispute& d : disputes) EXPECT_GE(d.number, 1008u);  // corners, of the range and of the cuts
  expectInside(envelope, proved.enclosure);
  for (std::size_t level = 0; level < 3; ++level) expectInside(innerCuts[level], proved.cuts[level]);
}

TEST_F(DecaySettled, AWrongCutIsRefutedByTheSamplesOfItsLevelAlone) {
  proved.cuts[1].upper(25, 0) -= 1e-6;
  run();
  EXPECT_TRUE(outside);
  std::vector<std::size_t> numbers;
  for (const Dispute& d : disputes)
    if (d.outside) numbers.push_back(d.number);
  EXPECT_THAT(numbers, ::testing::ElementsAre(1010));  // the corner at which alpha is 0.5 first
}

TEST_F(DecaySettled, AWrongEnclosureIsRefutedBySamplesInTheirBlocks) {
  for (std::size_t t = 20; t < 41; ++t) proved.enclosure.upper(t, 0) -= 0.2;  // of a width of 0.38 and more
  run();
  EXPECT_TRUE(outside);
  ASSERT_THAT(disputes, Not(IsEmpty()));
  EnsembleRun ensemble(system, sampled);
  for (const Dispute& d : disputes) {
    if (!d.outside) continue;
    const std::vector<double> trajectory = replaySample(system, sampled, d.number).trajectory(0);
    EXPECT_NEAR(trajectory[d.time], d.value, 1e-8) << d.number;
  }
}

TEST_F(DecaySettled, WhatOneBlockRefutesIsNotPutBeforeTheArbiterByTheNext) {
  for (std::size_t t = 20; t < 41; ++t) proved.enclosure.upper(t, 0) -= 0.2;
  run();
  EXPECT_EQ(arbitrated[-1], 16);  // one batch, of the first block
  std::size_t late = 0;
  for (const Dispute& d : disputes) late += d.number >= 256 && d.number < 1008 && d.outside;
  EXPECT_GT(late, 16u);
}

TEST_F(DecaySettled, NothingIsDisputedBeyondWhatIsReached) {
  proved.reachedTimes = 1;
  proved.enclosure.upper(30, 0) = -1;
  run();
  EXPECT_THAT(disputes, IsEmpty());
}

TEST_F(DecaySettled, BoundsOfAnotherShapeAreRefused) {
  proved.enclosure = Envelope(3, 1);
  EXPECT_THROW(Settlement(proved.view(), system, {}), std::invalid_argument);
}

/// x' = -p x beside what nothing uncertain moves: u' = -u, and a constant; of the outputs 1 to 3 hold only these.
UncertainMotion decayBesideOthers() {
  UncertainMotion system = decay();
  system.motion.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = -p[0] * x[0];
    dx[1] = -x[1];
  });
  system.motion.g = record(2, 1, 5, [](auto t, const auto& x, const auto&, auto& y) {
    y[0] = x[0];
    y[1] = x[1];
    y[2] = 2.0 * x[1] + t;
    y[3] = 0.1 + 0.0 * t;
    y[4] = x[0] * x[1];
  });
  system.nominal = {1.0, 1.0, 1.0};
  system.slot = {2};
  return system;
}

TEST(MovedOutputs, AreThoseThatSomethingUncertainReaches) {
  EXPECT_THAT(movedOutputs(decayBesideOthers()), ::testing::ElementsAre(1, 0, 0, 0, 1));
  EXPECT_THAT(movedOutputs(oscillator()), ::testing::ElementsAre(1, 1));
  EXPECT_THAT(movedOutputs(line()), ::testing::ElementsAre(1));
  UncertainMotion still = oscillator();
  still.slot = {};
  still.uncertain = {};
  EXPECT_THAT(movedOutputs(still), ::testing::ElementsAre(0, 0));
}

/// Through a state: x'' = -p, of which the output sees x alone. Through a linear system, by its blocks.
TEST(MovedOutputs, AreReachedThroughStatesAndBlocksOfSystems) {
  UncertainMotion system;
  system.motion.f = record(3, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0];
    dx[2] = -x[2];
  });
  system.motion.g = record(3, 1, 2, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0];
    y[1] = x[2];
  });
  system.motion.times = timesTo(1, 2);
  system.nominal = {0.0, 0.0, 1.0, 1.0};
  system.uncertain = {uniformly("p", 0, 0.5, 1)};
  system.slot = {3};
  EXPECT_THAT(movedOutputs(system), ::testing::ElementsAre(1, 0));

  Recorder recorder(0, 2);
  const int zero = recorder.constant(0.0), one = recorder.constant(1.0), p = recorder.parameter(0),
            q = recorder.parameter(1);
  const std::vector<int> apart =
      recorder.solve(recorder.matrix({MatrixKind::general, 2, {p, zero, zero, q}}), false, {one, one});
  const std::vector<int> together =
      recorder.solve(recorder.matrix({MatrixKind::general, 2, {p, one, zero, q}}), false, {one, one});
  system.motion.f = record(0, 2, [](auto, const auto&, const auto&, auto&) {});
  system.motion.g = recorder.finish({apart[0], apart[1], together[0], together[1]});
  system.nominal = {2.0, 2.0};
  system.slot = {0};
  EXPECT_THAT(movedOutputs(system), ::testing::ElementsAre(1, 0, 1, 1));
}

/// Of bounds as narrow as they can be, the outputs of doubles that nothing moves leave theirs in every sample.
TEST(Settlement, SettlesOnceWhatIsTheSameOfAllSamples) {
  const UncertainMotion system = decayBesideOthers();
  KnownBounds proved;
  proved.reachedTimes = system.motion.times.size();
  proved.enclosure = Envelope(proved.reachedTimes, 5);
  for (std::size_t t = 0; t < proved.reachedTimes; ++t) {
    const Interval time(system.motion.times[t]), u = exp(-time), x = exp(-Interval(0.5, 1.5) * time);
    const Interval wide(-1e-6, 1e-6);
    std::size_t output = 0;
    for (const Interval& bound : {x + wide, u, 2.0 * u + time, Interval(0.1), x * u + wide}) {
      proved.enclosure.lower(t, output) = bound.lower();
      proved.enclosure.upper(t, output++) = bound.upper();
    }
  }
  EnsembleOptions options;
  options.samples = 512;
  EnsembleRun ensemble(system, options);
  Settlement settlement(proved.view(), system, {});
  std::vector<Dispute> disputes;
  ensemble.integrateFirst();
  ensemble.integrateOthers(settlement.bounds(), [&](SampleBlock& block) {
    settlement.settle(block, [&](const Comparison& found, int level) {
      EXPECT_EQ(level, -1);
      disputes.insert(disputes.end(), found.disputes.begin(), found.disputes.end());
    });
  });
  ASSERT_EQ(disputes.size(), 1U);  // of more than 512 samples
  EXPECT_EQ(disputes[0].decided, "Taylor 128 bits");
  EXPECT_FALSE(disputes[0].outside);
  EXPECT_NE(disputes[0].output, 0U);
  for (std::size_t t = 0; t < proved.reachedTimes; ++t)
    for (const std::size_t output : {1U, 2U, 3U}) {
      EXPECT_GE(ensemble.envelope().lower(t, output), proved.enclosure.lower(t, output)) << t;
      EXPECT_LE(ensemble.envelope().upper(t, output), proved.enclosure.upper(t, output)) << t;
    }
}

/// A wrong enclosure of such an output is refuted all the same.
TEST(Settlement, RefutesAWrongEnclosureOfWhatIsTheSameOfAllSamples) {
  const UncertainMotion system = decayBesideOthers();
  KnownBounds proved;
  proved.reachedTimes = system.motion.times.size();
  proved.enclosure = Envelope(proved.reachedTimes, 5);
  for (std::size_t t = 0; t < proved.reachedTimes; ++t)
    for (std::size_t output = 0; output < 5; ++output) {
      proved.enclosure.lower(t, output) = output == 1 ? (exp(-Interval(system.motion.times[t])) + 1e-9).lower() : -9;
      proved.enclosure.upper(t, output) = 9;
    }
  EnsembleOptions options;
  options.samples = 64;
  EnsembleRun ensemble(system, options);
  Settlement settlement(proved.view(), system, {});
  bool isOutside = false;
  ensemble.integrateFirst();
  ensemble.integrateOthers(settlement.bounds(), [&](SampleBlock& block) {
    settlement.settle(block, [&](const Comparison& found, int) {
      for (const Dispute& dispute : found.disputes) isOutside = isOutside || dispute.outside;
    });
  });
  EXPECT_TRUE(isOutside);
}

}  // namespace
}  // namespace gamut
