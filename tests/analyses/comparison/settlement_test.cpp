// Samples of a motion whose range is known, x = exp(-p t), against its exact enclosure and alpha-cuts as they arrive.
#include "analyses/comparison/settlement.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <vector>

#include "tests/analyses/motions.hpp"

namespace gamut {
namespace {

using namespace testing_motions;
using testing::Each;
using testing::Field;
using testing::IsEmpty;
using testing::Not;

class DecaySettled : public testing::Test {
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
    Settlement settlement(proved, system, {});
    ensemble.integrateFirst();
    ensemble.integrateOthers(settlement.boundsOf(0), [&](SampleBlock& block) {
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
  Proved proved;
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
  EXPECT_THAT(numbers, testing::ElementsAre(1010));  // the corner at which alpha is 0.5 first
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
  EXPECT_THROW(Settlement(proved, system, {}), std::invalid_argument);
}

}  // namespace
}  // namespace gamut
