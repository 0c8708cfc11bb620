// Enclosures that are right, wrong, and wrong by less than the witness's error, of a motion whose range is known:
// x = exp(-p t) for p in [0.5, 1.5]. The first corner has p = 0.5 and is the upper end, the second the lower.
#include "analyses/comparison/comparison.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "tests/analyses/motions.hpp"
#include "tests/analyses/whole_ensemble.hpp"

namespace gamut {
namespace {

using namespace testing_motions;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::DoubleNear;
using testing::Field;
using ::testing::Gt;
using ::testing::Lt;

constexpr std::size_t sampleCount = 64;

/// The gravest finding: "outside", "unresolved", "interrupted", or "inside" where nothing is left of all disputes.
std::string gravest(const Comparison& c) {
  if (std::ranges::any_of(c.disputes, &Dispute::outside)) return "outside";
  for (const char* word : {"unresolved", "interrupted"})
    if (std::ranges::count(c.disputes, word, &Dispute::decided) > 0) return word;
  return "inside";
}

class DecayCompared : public ::testing::Test {
 protected:
  DecayCompared() {
    EnsembleOptions options;
    options.samples = sampleCount;
    ensemble = sampleEnsemble(system, options);
    enclosure.bounds = Envelope(ensemble.times.size(), 1);
    enclosure.reachedTimes = ensemble.times.size();
    for (std::size_t t = 0; t < ensemble.times.size(); ++t) {
      const Interval exact = exp(-Interval(0.5, 1.5) * ensemble.times[t]);
      enclosure.bounds.lower(t, 0) = exact.lower();
      enclosure.bounds.upper(t, 0) = exact.upper();
    }
  }
  void widen(double by) {
    for (double& bound : enclosure.bounds.lower.data) bound -= by;
    for (double& bound : enclosure.bounds.upper.data) bound += by;
  }
  void expectEnvelopeInside(const Envelope& envelope) {
    for (std::size_t t = 0; t < enclosure.reachedTimes; ++t) {
      EXPECT_LE(enclosure.bounds.lower(t, 0), envelope.lower(t, 0)) << t;
      EXPECT_LE(envelope.upper(t, 0), enclosure.bounds.upper(t, 0)) << t;
    }
  }

  UncertainMotion system = decay();
  WholeEnsemble ensemble;
  EnclosureBounds enclosure;
  std::size_t firstCorner = sampleCount, secondCorner = sampleCount + 1;
};

TEST_F(DecayCompared, AWideEnclosureIsInsideWithoutDispute) {
  widen(1e-6);
  const Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "inside");
  EXPECT_TRUE(c.disputes.empty());
  EXPECT_EQ(c.excursion, 0);
  expectEnvelopeInside(ensemble.envelope());
}

TEST_F(DecayCompared, AnEnclosureTighterThanTheWitnessErrorIsFoundInsideBySeriesInDoubles) {
  widen(3e-13);
  const Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "inside");
  ASSERT_FALSE(c.disputes.empty());
  for (const Dispute& d : c.disputes) {
    EXPECT_THAT(d.number, AnyOf(firstCorner, secondCorner));
    EXPECT_EQ(d.decided, "Taylor 53 bits");
    EXPECT_FALSE(d.outside);
    EXPECT_EQ(d.distance, 0);
  }
  expectEnvelopeInside(ensemble.envelope());
}

TEST_F(DecayCompared, TheExactRangeIsFoundInsideByTheArbiter) {
  const Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "inside");
  EXPECT_THAT(c.disputes, Contains(Field(&Dispute::decided, "Taylor 128 bits")));
  EXPECT_EQ(c.excursion, 0);
  expectEnvelopeInside(ensemble.envelope());  // the ensemble keeps what was refined
}

TEST_F(DecayCompared, AnEnclosureCutByMoreThanAnyErrorIsRefutedByTheSampleLeftOutside) {
  enclosure.bounds.upper(25, 0) -= 1e-11;
  const Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "outside");
  ASSERT_FALSE(c.disputes.empty());
  const Dispute& d = c.disputes[0];
  EXPECT_EQ(d.number, firstCorner);
  EXPECT_TRUE(d.outside);
  EXPECT_EQ(d.time, 25u);
  EXPECT_EQ(d.output, 0u);
  EXPECT_EQ(d.decided, "Taylor 128 bits");
  EXPECT_THAT(d.distance, DoubleNear(1e-11, 1e-15));
  EXPECT_EQ(d.upper, enclosure.bounds.upper(25, 0));
  EXPECT_GT(d.value, d.upper);
  EXPECT_GT(d.excursion, 10);
  EXPECT_EQ(c.excursion, d.excursion);
  for (std::size_t other = 1; other < c.disputes.size(); ++other) EXPECT_FALSE(c.disputes[other].outside);
}

/// min(p, ¼) - ¼ and sums that cancel, of p in [0.5, 0.99]: nothing, of which samples make roundings.
class NothingCompared : public ::testing::Test {
 protected:
  static constexpr std::size_t outputs = 2;

  NothingCompared() {
    system.motion.f = record(1, 1, [](auto, const auto&, const auto&, auto& dx) { dx[0] = 0.0; });
    system.motion.g = record(1, 1, outputs, [](auto t, const auto&, const auto& p, auto& y) {
      y[0] = min(p[0] * (1.0 + exp(-100.0 * t - 5.0)), Recorded(0.25)) - 0.25;
      y[1] = 1e6 * ((p[0] + exp(p[0])) - exp(p[0]) - p[0]);
    });
    system.motion.times = {0, 0.5, 1};
    system.nominal = {0.0, 0.75};
    system.uncertain = {uniformly("p", 0.5, 0.75, 0.99)};
    system.slot = {1};
    EnsembleOptions options;
    options.samples = sampleCount;
    ensemble = sampleEnsemble(system, options);
    enclosure.bounds = Envelope(3, outputs);
    enclosure.reachedTimes = 3;
    std::ranges::fill(enclosure.bounds.lower.data, 0.0);
    std::ranges::fill(enclosure.bounds.upper.data, 0.0);
  }

  UncertainMotion system;
  WholeEnsemble ensemble;
  EnclosureBounds enclosure;
};

TEST_F(NothingCompared, AnExactEnclosureIsNotRefutedByRoundings) {
  const Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "inside");
  EXPECT_FALSE(c.disputes.empty());
  EXPECT_THAT(c.disputes, Contains(Field(&Dispute::decided, "rounding")));  // 128 bits need not look at all
  for (const Dispute& d : c.disputes) EXPECT_TRUE(d.decided == "rounding" || d.distance == 0) << d.decided;
}

/// By far less than a double knows.
TEST_F(NothingCompared, OneThatIsWrongByMoreThanRoundingsOf128BitsIs) {
  for (const std::size_t output : {0U, 1U}) {
    EnclosureBounds wrong = enclosure;
    for (std::size_t row = 0; row < 3; ++row) wrong.bounds.lower(row, output) = wrong.bounds.upper(row, output) = 1e-28;
    EXPECT_EQ(gravest(compare(wrong, ensemble, system)), "outside") << output;
  }
}

TEST_F(DecayCompared, AnEnclosureThatManySamplesLeaveIsOutsideThoughTheArbiterSeesOnlySome) {
  for (std::size_t t = 20; t < 41; ++t) enclosure.bounds.upper(t, 0) -= 0.2;  // of a width of 0.38 and more
  ComparisonOptions options;
  options.jobs = 2;
  const Comparison c = compare(enclosure, ensemble, system, options);
  EXPECT_EQ(gravest(c), "outside");
  int outside = 0, arbitrated = 0;
  for (const Dispute& d : c.disputes) {
    outside += d.outside;
    arbitrated += d.decided == "Taylor 128 bits";
  }
  EXPECT_GT(outside, 18);
  EXPECT_EQ(arbitrated, 16);
}

TEST_F(DecayCompared, WhatAnInterruptLeavesOpenIsNeitherOutsideNorUnresolved) {
  for (std::size_t t = 20; t < 41; ++t) enclosure.bounds.upper(t, 0) -= 0.2;
  const std::atomic<bool> cancelled{true};
  ComparisonOptions options;
  options.cancelled = &cancelled;
  const Comparison c = compare(enclosure, ensemble, system, options);
  EXPECT_EQ(gravest(c), "interrupted");
  EXPECT_EQ(c.excursion, 0);
  ASSERT_FALSE(c.disputes.empty());
  for (const Dispute& d : c.disputes) {
    EXPECT_EQ(d.decided, "interrupted");
    EXPECT_FALSE(d.outside);
    ASSERT_EQ(d.farthest.size(), 1u);
    EXPECT_GE(d.farthest[0], d.distance);
    EXPECT_GT(d.distance, 0);
  }
}

TEST_F(DecayCompared, SamplesOfTheSameValuesAreDecidedTogetherHoweverMany) {
  ensemble = {};
  for (double& value : system.nominal) value = value == 1 ? value : 0.5;
  system.uncertain[0].distribution = Distribution::uniform(Interval(0.5));
  EnsembleOptions sampling;
  sampling.samples = 400;
  ensemble = sampleEnsemble(system, sampling);
  const Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "inside");
  EXPECT_GE(c.disputes.size(), 400u);
  for (std::size_t i = 1; i < c.disputes.size(); ++i) EXPECT_LT(c.disputes[i - 1].number, c.disputes[i].number);
  for (const Dispute& d : c.disputes) EXPECT_EQ(d.distance, 0);
  expectEnvelopeInside(ensemble.envelope());
}

/// What is uncertain does not matter, and the enclosure is a unit or two wide: x = exp(-t/2).
TEST_F(DecayCompared, SamplesOutsideByRoundingAreToldByTheWorstOfThem) {
  ensemble = {};
  system.motion.f = record(1, 1, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -0.5 * x[0]; });
  EnsembleOptions sampling;
  sampling.samples = 200;
  ensemble = sampleEnsemble(system, sampling);
  for (std::size_t t = 0; t < ensemble.times.size(); ++t) {
    const Interval exact = exp(-Interval(0.5) * ensemble.times[t]);
    enclosure.bounds.lower(t, 0) = exact.lower();
    enclosure.bounds.upper(t, 0) = exact.upper();
  }
  const Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "inside");
  EXPECT_EQ(std::ranges::count(c.disputes, "Taylor 128 bits", &Dispute::decided), 16);
  EXPECT_GT(std::ranges::count(c.disputes, "rounding", &Dispute::decided), 100);
  for (const Dispute& d : c.disputes) {
    if (d.decided == "rounding") {
      EXPECT_THAT(d.distance, AllOf(Gt(0), Lt(1e-15)));
    }
  }
  // A wrong one is wrong all the same.
  for (std::size_t t = 20; t < 41; ++t)
    for (Table* bound : {&enclosure.bounds.lower, &enclosure.bounds.upper}) bound->data[t] -= 1e-13;
  EXPECT_EQ(gravest(compare(enclosure, ensemble, system)), "outside");
}

TEST_F(DecayCompared, ASampleOutsideByLessThanItsErrorIsUnresolved) {
  double& bound = enclosure.bounds.upper(25, 0);
  for (int i = 0; i < 3; ++i) bound = std::nextafter(bound, 0);
  const Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "unresolved");
  const Dispute& d = c.disputes[0];
  EXPECT_EQ(d.number, firstCorner);
  EXPECT_EQ(d.decided, "unresolved");
  EXPECT_FALSE(d.outside);
  EXPECT_GT(d.distance, 0);
  EXPECT_LE(d.excursion, 10);
}

TEST_F(DecayCompared, AnEnclosureThatEndsEarlyIsComparedUpToThere) {
  widen(1e-6);
  enclosure.reachedTimes = 30;
  enclosure.bounds.upper(35, 0) = -1;  // not claimed
  EXPECT_TRUE(compare(enclosure, ensemble, system).disputes.empty());
  const Overestimation over = measureOverestimation(enclosure, ensemble.envelope(), ensemble.error);
  EXPECT_FALSE(std::isnan(over.excess(29, 0)));
  EXPECT_TRUE(std::isnan(over.excess(30, 0)));
  enclosure.bounds.upper(25, 0) -= 1e-3;
  EXPECT_EQ(gravest(compare(enclosure, ensemble, system)), "outside");
}

TEST_F(DecayCompared, OverestimationIsTheRatioOfWidthsWhereTheEnvelopeIsWideEnough) {
  const Envelope envelope = ensemble.envelope();
  for (std::size_t t = 0; t < ensemble.times.size(); ++t) {
    const double margin = 0.5 * (t == 10 ? 2.0 : 0.5) * (envelope.upper(t, 0) - envelope.lower(t, 0));
    enclosure.bounds.lower(t, 0) = envelope.lower(t, 0) - margin;
    enclosure.bounds.upper(t, 0) = envelope.upper(t, 0) + margin;
  }
  const Overestimation c = measureOverestimation(enclosure, envelope, ensemble.error);
  EXPECT_TRUE(std::isnan(c.ratio(0, 0)));  // all samples start at 1: there is no width to compare with
  EXPECT_EQ(c.excess(0, 0), 0);
  EXPECT_THAT(c.ratio(10, 0), DoubleNear(3, 1e-12));
  EXPECT_THAT(c.ratio(20, 0), DoubleNear(1.5, 1e-12));
  EXPECT_THAT(c.maximum, DoubleNear(3, 1e-12));
  EXPECT_THAT(c.median, DoubleNear(1.5, 1e-12));
  ASSERT_EQ(c.maximumOf.size(), 1u);
  EXPECT_EQ(c.maximumOf[0], c.maximum);
}

TEST_F(DecayCompared, AnEnvelopeOfRoundingAloneTellsNoOverestimation) {
  Envelope envelope = ensemble.envelope();
  envelope.lower(0, 0) = 1;  // as an output may start that is one number, but for rounding: the error there is 0
  envelope.upper(0, 0) = 1 + 0x1p-52;
  enclosure.bounds.lower(0, 0) = 1 - 0x1p-44;
  enclosure.bounds.upper(0, 0) = 1 + 0x1p-44;
  const Overestimation c = measureOverestimation(enclosure, envelope, ensemble.error);
  EXPECT_TRUE(std::isnan(c.ratio(0, 0)));
  EXPECT_LT(c.maximum, 1.001);
}

TEST_F(DecayCompared, AnUnboundedEnclosureHoldsEverything) {
  for (double& bound : enclosure.bounds.upper.data) bound = std::numeric_limits<double>::infinity();
  widen(1e-6);
  EXPECT_EQ(gravest(compare(enclosure, ensemble, system)), "inside");
}

TEST_F(DecayCompared, BoundsThatAreNoNumbersAreRefused) {
  enclosure.bounds.lower(3, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(compare(enclosure, ensemble, system), std::invalid_argument);
  enclosure.bounds = Envelope(3, 1);
  EXPECT_THROW(compare(enclosure, ensemble, system), std::invalid_argument);
}

TEST(Comparison, ASampleOneUlpOutsideIsDisputed) {
  const UncertainMotion system = line();
  EnsembleOptions options;
  options.samples = 8;
  WholeEnsemble ensemble = sampleEnsemble(system, options);
  EnclosureBounds enclosure{Envelope(2, 1), 2};
  for (std::size_t t = 0; t < 2; ++t) {  // y runs from 1 + t to 3 + t, and doubles reach both ends
    enclosure.bounds.lower(t, 0) = 1.0 + static_cast<double>(t);
    enclosure.bounds.upper(t, 0) = 3.0 + static_cast<double>(t);
  }
  EXPECT_EQ(gravest(compare(enclosure, ensemble, system)), "inside");
  enclosure.bounds.upper(0, 0) = std::nextafter(3.0, 0);
  Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "unresolved");
  ASSERT_EQ(c.disputes.size(), 1u);
  EXPECT_EQ(c.disputes[0].number, ensemble.samples + 1);  // the corner p = 1
  EXPECT_EQ(c.disputes[0].distance, 3.0 - std::nextafter(3.0, 0));
  enclosure.bounds.upper(0, 0) = 3;
  enclosure.bounds.lower(0, 0) = std::nextafter(1.0, 2);
  c = compare(enclosure, ensemble, system);
  ASSERT_EQ(c.disputes.size(), 1u);
  EXPECT_EQ(c.disputes[0].number, ensemble.samples);  // the corner p = 0
}

TEST(Comparison, ASampleIsNotDisputedWhereItDidNotArrive) {
  UncertainMotion system = decay(1.0, 10);
  system.motion.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sqr(x[0]); });
  EnsembleOptions options;
  options.samples = 16;
  WholeEnsemble ensemble = sampleEnsemble(system, options);
  EnclosureBounds enclosure{Envelope(11, 1), 11};
  for (double& bound : enclosure.bounds.lower.data) bound = -std::numeric_limits<double>::infinity();
  for (double& bound : enclosure.bounds.upper.data) bound = std::numeric_limits<double>::infinity();
  ASSERT_FALSE(ensemble.failed.empty());
  EXPECT_TRUE(compare(enclosure, ensemble, system).disputes.empty());
}

TEST(Comparison, AMotionWithoutStatesIsDisputedBeforeTheArbiterAtOnce) {
  const UncertainMotion system = line();
  EnsembleOptions options;
  options.samples = 8;
  WholeEnsemble ensemble = sampleEnsemble(system, options);
  EnclosureBounds enclosure{Envelope(2, 1), 2};
  for (std::size_t t = 0; t < 2; ++t) {
    enclosure.bounds.lower(t, 0) = 1.0 + static_cast<double>(t);
    enclosure.bounds.upper(t, 0) = 2.5 + static_cast<double>(t);
  }
  const Comparison c = compare(enclosure, ensemble, system);
  EXPECT_EQ(gravest(c), "outside");
  for (const Dispute& d : c.disputes) {
    EXPECT_TRUE(d.outside);
    EXPECT_EQ(d.decided, "Taylor 128 bits");
    EXPECT_GT(ensemble.valuesOf(d.number)[0], 0.75);
  }
}

}  // namespace
}  // namespace gamut
