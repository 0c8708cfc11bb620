// The transformation method: its points against the published scheme, and what they reach of functions whose alpha-cuts
// are known.
#include "analyses/samples/transformation.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <set>

#include "tests/analyses/motions.hpp"

namespace gamut {
namespace {

using namespace testing_motions;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<double> levelsOf(int count) {
  std::vector<double> alpha;
  for (int j = 0; j < count; ++j) alpha.push_back(static_cast<double>(j) / (count - 1));
  return alpha;
}

std::vector<Interval> cutsOf(const Membership& membership, int count) {
  std::vector<Interval> cuts;
  for (const double alpha : levelsOf(count)) cuts.push_back(membership.cut(alpha));
  return cuts;
}

/// The widest first; of every quantity the same.
std::vector<Box> boxesOf(const Membership& membership, std::size_t quantities, int count) {
  std::vector<Box> boxes;
  for (const Interval& cut : cutsOf(membership, count)) boxes.emplace_back(quantities, cut);
  return boxes;
}

std::vector<std::vector<double>> listOf(const TransformationPoints& points, std::size_t quantities) {
  std::vector<std::vector<double>> list;
  for (std::size_t i = 0; i < points.size(); ++i) {
    list.emplace_back(quantities);
    points.point(i, list.back());
  }
  return list;
}

/// c_{l,i}^{(j)} as published (Hanss 2005, section 4.2), with its own numbers of levels and values, from 1.
double published(const std::vector<Interval>& cuts, std::size_t l, std::size_t j) {
  const std::size_t m = cuts.size() - 1;
  if (l == 1) return cuts[j].lower();
  if (l == m - j + 1) return cuts[j].upper();
  return 0.5 * (published(cuts, l - 1, j + 1) + published(cuts, l, j + 1));
}

TEST(Transformation, HasTheValuesOfThePublishedScheme) {
  EXPECT_THAT(generalValues(cutsOf(Membership::triangular(0, 2, 4), 5)),
              ElementsAre(ElementsAre(0, 1, 2, 3, 4), ElementsAre(0.5, 1.5, 2.5, 3.5), ElementsAre(1, 2, 3),
                          ElementsAre(1.5, 2.5), ElementsAre(2)));
  const std::vector<Interval> cuts = cutsOf(Membership::triangular(0, 1, 5), 9);  // all of it exact
  const std::vector<std::vector<double>> values = generalValues(cuts);
  ASSERT_EQ(values.size(), 9u);
  for (std::size_t j = 0; j < 9; ++j) {
    ASSERT_EQ(values[j].size(), 9 - j);
    for (std::size_t l = 1; l <= 9 - j; ++l) EXPECT_EQ(values[j][l - 1], published(cuts, l, j)) << l << ' ' << j;
  }
}

TEST(Transformation, TakesBothEndsOfACoreAndEqualValuesOnce) {
  EXPECT_THAT(generalValues(cutsOf(Membership::trapezoidal(0, 1, 2, 3), 3)),
              ElementsAre(ElementsAre(0, 1.5, 3), ElementsAre(0.5, 2.5), ElementsAre(1, 2)));
  EXPECT_THAT(generalValues(std::vector<Interval>(4, Interval(7))),
              ElementsAre(ElementsAre(7), ElementsAre(7), ElementsAre(7), ElementsAre(7)));
}

TEST(Transformation, HasAsManyPointsByTheGeneralMethodAsPublished) {
  for (const std::size_t n : {1u, 2u, 3u, 10u, 30u}) {
    double expected = 0;
    for (int k = 1; k <= 11; ++k) expected += std::pow(k, static_cast<double>(n));
    EXPECT_DOUBLE_EQ(generalCount(boxesOf(Membership::triangular(0, 1, 2), n, 11)), expected) << n;
  }
  EXPECT_EQ(generalPoints(boxesOf(Membership::triangular(0, 1, 2), 3, 11)).size(), 4356u);
}

TEST(Transformation, PutsEveryCombinationOfValuesIntoItsCutAndNoPointOutside) {
  const std::vector<Box> cuts = boxesOf(Membership::triangular(0.1, 0.3, 0.9), 2, 6);
  const std::vector<std::vector<double>> points = listOf(generalPoints(cuts), 2);
  ASSERT_EQ(points.size(), 91u);
  std::size_t i = 0;
  for (std::size_t level = 0; level < 6; ++level) {
    std::set<std::vector<double>> different;
    for (std::size_t k = (6 - level) * (6 - level); k-- > 0; ++i) {
      for (std::size_t q = 0; q < 2; ++q) EXPECT_TRUE(contains(cuts[level][q], points[i][q]));
      different.insert(points[i]);
    }
    EXPECT_EQ(different.size(), (6 - level) * (6 - level));
  }
}

TEST(Transformation, CombinesValuesOfWhatTurnsWithCornersOfTheOthers) {
  const std::vector<Box> cuts = boxesOf(Membership::triangular(0, 2, 4), 3, 3);
  const std::vector<std::vector<double>> points = listOf(extendedPoints(cuts, {1}, 5000, false), 3);
  ASSERT_EQ(points.size(), (3u + 2u + 1u) * 4u);
  std::set<std::vector<double>> widest(points.begin(), points.begin() + 12);
  EXPECT_EQ(widest.size(), 12u);
  for (const std::vector<double>& point : widest) {
    EXPECT_TRUE(point[0] == 0 || point[0] == 4);
    EXPECT_TRUE(point[1] == 0 || point[1] == 2 || point[1] == 4);
    EXPECT_TRUE(point[2] == 0 || point[2] == 4);
  }
}

TEST(Transformation, NeverHasMorePointsThanItMay) {
  for (const std::size_t n : {1u, 3u, 10u, 30u, 300u})
    for (const int levels : {2, 3, 11, 101})
      for (std::size_t turning = 0; turning <= std::min<std::size_t>(n, 12); ++turning) {
        std::vector<std::size_t> quantities(turning);
        for (std::size_t q = 0; q < turning; ++q) quantities[q] = q;
        const std::vector<Box> cuts = boxesOf(Membership::triangular(0, 1, 2), n, levels);
        EXPECT_LE(extendedPoints(cuts, quantities, 5000, true).size(), 5000u) << n << ' ' << levels << ' ' << turning;
        if (turning == 1 && levels > 2) {
          EXPECT_GT(extendedPoints(cuts, quantities, 5000, false).size(), 0u);
        }
      }
  EXPECT_EQ(extendedPoints(boxesOf(Membership::triangular(0, 1, 2), 9, 9), {}, 5000, true).size(), 9u * 512u);
  EXPECT_EQ(extendedPoints(boxesOf(Membership::triangular(0, 1, 2), 9, 9), {}, 4000, true).size(), 0u);
}

TEST(Transformation, IsKnownByName) {
  for (const Transformation each : {Transformation::reduced, Transformation::general, Transformation::extended})
    EXPECT_EQ(transformationNamed(nameOf(each)), each);
  EXPECT_THAT([] { transformationNamed("full"); },
              ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("reduced, general, extended")));
}

/// y = f(p) without states, p_i in [lower, upper].
template <class F>
UncertainMotion function(std::size_t quantities, double lower, double nominal, double upper, const F& f) {
  UncertainMotion system;
  const int n = static_cast<int>(quantities);
  system.motion.f = record(0, n, [](auto, const auto&, const auto&, auto&) {});
  system.motion.g = record(0, n, 1, [&](auto, const auto&, const auto& p, auto& y) { y[0] = f(p); });
  system.motion.times = {0};
  system.nominal.assign(quantities, nominal);
  system.uncertain.assign(quantities, uniformly("p", lower, nominal, upper));
  for (std::size_t q = 0; q < quantities; ++q) {
    system.uncertain[q].name += std::to_string(q);
    system.slot.push_back(static_cast<int>(q));
  }
  return system;
}

struct Found {
  std::vector<Envelope> cuts;
  std::size_t points = 0;
  std::vector<std::size_t> turning;
  bool isComplete = false;
};

EnsembleOptions optionsOf(Transformation method, int levels = 11) {
  EnsembleOptions options;
  options.samples = 1;
  options.alpha = levelsOf(levels);
  options.transformation = method;
  return options;
}

Found found(const UncertainMotion& system, const EnsembleOptions& options) {
  EnsembleRun run(system, options);
  run.integrateOthers();
  EXPECT_LE(run.sampling().size(), run.mostSamples());
  return {run.innerCuts(), run.sampling().points(), run.turning().value_or(std::vector<std::size_t>()),
          run.isComplete()};
}

void expectNested(const std::vector<Envelope>& cuts) {
  for (std::size_t level = 1; level < cuts.size(); ++level)
    for (std::size_t i = 0; i < cuts[level].lower.data.size(); ++i) {
      EXPECT_GE(cuts[level].lower.data[i], cuts[level - 1].lower.data[i]) << level;
      EXPECT_LE(cuts[level].upper.data[i], cuts[level - 1].upper.data[i]) << level;
    }
}

/// The height of a pendulum, -l cos(angle), is lowest inside: corners of the cuts meet the longest rod at the ends of
/// the angle alone.
TEST(Transformation, ReachesAnExtremeInsideThatCornersMiss) {
  UncertainMotion pendulum = function(3, -0.5, 0, 0.5, [](const auto& p) { return -(p[1] + 2.0) * cos(p[0]) + p[2]; });
  const Found reduced = found(pendulum, optionsOf(Transformation::reduced)),
              general = found(pendulum, optionsOf(Transformation::general)),
              extended = found(pendulum, optionsOf(Transformation::extended));
  EXPECT_EQ(reduced.points, 0u);
  EXPECT_EQ(general.points, 4356u);
  EXPECT_EQ(extended.points, 99u + 4u * 66u);
  EXPECT_THAT(extended.turning, ElementsAre(0));
  for (std::size_t level = 0; level < 11; ++level) {
    const double r = 0.5 * (1 - 0.1 * static_cast<double>(level)), lowest = -(2 + r) - r;
    EXPECT_NEAR(general.cuts[level].upper(0, 0), -(2 - r) * std::cos(r) + r, 1e-12);
    if (level % 2 == 0) {
      EXPECT_NEAR(general.cuts[level].lower(0, 0), lowest, 1e-12);  // has the value 0
    }
    EXPECT_EQ(extended.cuts[level].lower(0, 0), general.cuts[level].lower(0, 0));
    EXPECT_EQ(extended.cuts[level].upper(0, 0), general.cuts[level].upper(0, 0));
    if (level < 9) {
      EXPECT_GT(reduced.cuts[level].lower(0, 0), general.cuts[level].lower(0, 0) + 1e-3) << level;
    }
  }
  for (const Found* each : {&reduced, &general, &extended}) {
    expectNested(each->cuts);
    EXPECT_TRUE(each->isComplete);
  }
}

TEST(Transformation, LooksAlongLinesWhereTheOthersAreNotNominalToo) {
  const Found product = found(function(2, -1, 0, 1, [](const auto& p) { return p[0] * sqr(p[1] - 0.3); }),
                              optionsOf(Transformation::extended));
  EXPECT_THAT(product.turning, ElementsAre(1));
}

TEST(Transformation, NeedsCornersAloneWhereNothingTurns) {
  const Found bilinear = found(function(3, 1, 2, 3, [](const auto& p) { return p[0] * p[1] - p[2]; }),
                               optionsOf(Transformation::extended));
  EXPECT_THAT(bilinear.turning, IsEmpty());
  EXPECT_EQ(bilinear.points, 99u);  // three lines of eleven values for each quantity
  EXPECT_NEAR(bilinear.cuts[0].lower(0, 0), -2, 1e-12);
  EXPECT_NEAR(bilinear.cuts[0].upper(0, 0), 8, 1e-12);
}

/// sum of weight_q (p_q - 0.3)²: all turn, those with the greatest weight take part.
TEST(Transformation, ServesManyQuantitiesWithinItsLimit) {
  for (const std::size_t n : {1u, 3u, 10u, 30u}) {
    const Found many = found(function(n, -1, 0, 1,
                                      [n](const auto& p) {
                                        auto sum = sqr(p[0] - 0.3);
                                        for (std::size_t q = 1; q < n; ++q)
                                          sum += (1.0 + static_cast<double>(q)) * sqr(p[q] - 0.3);
                                        return sum;
                                      }),
                             optionsOf(Transformation::extended));
    EXPECT_TRUE(many.isComplete);
    EXPECT_LE(many.points, mostExtendedPoints);
    EXPECT_FALSE(many.turning.empty());
    if (n > 3) {
      EXPECT_EQ(many.turning.back(), n - 1);
    }
    if (n <= 3) {
      EXPECT_EQ(many.turning.size(), n);
    }
    expectNested(many.cuts);
  }
  const UncertainMotion thirty = function(30, -1, 0, 1, [](const auto& p) { return p[0]; });
  EXPECT_THAT([&] { EnsembleRun(thirty, optionsOf(Transformation::general)); },
              ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("too many points")));
}

/// Trajectories of all numbers, and in which quantities outputs turn.
std::pair<std::map<std::size_t, std::vector<double>>, std::vector<std::size_t>> trajectories(
    const UncertainMotion& system, const EnsembleOptions& options) {
  EnsembleRun run(system, options);
  std::map<std::size_t, std::vector<double>> all;
  run.integrateOthers({}, [&](SampleBlock& block) {
    for (std::size_t i = 0; i < block.size(); ++i) all[block.first() + i] = block.trajectory(i);
  });
  EXPECT_EQ(all.size(), run.sampling().size());
  return {all, *run.turning()};
}

TEST(Transformation, GivesTheSamePointsToAReplayAndToEveryNumberOfJobs) {
  const UncertainMotion system = oscillator();
  EnsembleOptions options = optionsOf(Transformation::extended);
  const auto [all, turning] = trajectories(system, options);
  EXPECT_THAT(turning, ElementsAre(0));  // the frequency
  options.jobs = 3;
  EXPECT_EQ(trajectories(system, options).first, all);
  options.turning = turning;
  EXPECT_EQ(trajectories(system, options).first, all);
  for (std::size_t number = 0; number < all.size(); number += 7) {
    const SampleBlock replayed = replaySample(system, options, number);
    EXPECT_EQ(replayed.trajectory(0), all.at(number)) << number;
    EXPECT_FALSE(number > 0 && replayed.hasWeight());
  }
}

TEST(Transformation, FindsTheSameQuantitiesWhateverTheNumberOfSamples) {
  EnsembleOptions options = optionsOf(Transformation::extended);
  const auto few = trajectories(oscillator(), options);
  options.samples = 512;
  const auto many = trajectories(oscillator(), options);
  EXPECT_EQ(few.second, many.second);
  for (const auto& [number, trajectory] : few.first)
    if (number > 0) {
      EXPECT_EQ(many.first.at(number + 511), trajectory) << number;
    }
}

TEST(Transformation, KeepsWhatCameBeforeItWasCancelled) {
  const UncertainMotion system = oscillator();
  for (const std::size_t most : {1u, 43u, 100u}) {  // after corners, and after what looks for turns
    std::atomic<bool> cancelled = false;
    EnsembleOptions options = optionsOf(Transformation::extended);
    options.cancelled = &cancelled;
    EnsembleRun run(system, options);
    std::size_t seen = 0;
    run.integrateOthers({}, [&](SampleBlock& block) {
      seen += block.size();
      if (seen >= most) cancelled = true;
    });
    EXPECT_FALSE(run.isComplete());
    EXPECT_EQ(run.integrated(), seen);
    expectNested(run.innerCuts());
  }
}

}  // namespace
}  // namespace gamut
