// Requirements whose answers are known in closed form, and, on random systems, against samples.
#include "analyses/requirements/requirement.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "analyses/flow/flow.hpp"
#include "analyses/flow/image.hpp"
#include "analyses/requirements/decided_cells.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

using When = CellQuestion::When;

Uncertain quantity(const Interval& range, double nominal) {
  Uncertain u;
  u.name = "q";
  u.range = range;
  u.nominal = nominal;
  u.distribution = Distribution::uniform(range);
  u.membership = Membership::triangular(range.lower(), nominal, range.upper());
  return u;
}

/// A study of programs: margins are the outputs of g, quantities all that is wide.
struct Question {
  Program f, g;
  Box box;
  double horizon = 1;
  std::vector<double> times = {};
  When when = When::always;
  std::vector<Uncertain> uncertain = {};
  std::size_t from = 0, until = 0;  // 0: the last
  RequirementOptions options = {};

  template <class Ask>
  auto asked(const Ask& ask) {
    FlowOptions flow;
    for (int i = 0; i < g.outputs(); ++i) flow.modelled.push_back(i);
    const Tube tube = Flow(f, g, flow).enclose(box, horizon, times);
    EXPECT_EQ(tube.why(), "");
    std::vector<CellQuantity> quantities;
    const bool isGiven = !uncertain.empty();
    if (!isGiven)
      for (const Interval& value : box)
        if (!isThin(value)) uncertain.push_back(quantity(value, midpoint(value)));
    std::size_t next = 0;
    for (std::size_t i = 0; i < box.size(); ++i)
      if (!isThin(box[i])) quantities.push_back({static_cast<int>(i), &uncertain[next++]});
    CellQuestion question{when, {}, {}, from, until > 0 ? until : tube.reachedTimes() - 1};
    for (int i = 0; i < g.outputs(); ++i) {
      question.margins.push_back(i);
      question.isStrict.push_back(1);
    }
    return ask(*tube.models(), question, quantities);
  }

  RequirementFinding examine() {
    return asked([&](const auto& models, const auto& question, const auto& quantities) {
      return gamut::examine(models, question, quantities, options);
    });
  }
  std::vector<DecidedCell> cells() {
    return asked([&](const auto& models, const auto& question, const auto& quantities) {
      return decidedCells(models, question, quantities, options);
    });
  }
};

/// x' = rate p[0], outputs of x.
template <class Output>
Question falling(const Interval& start, const Interval& rate, const Output& output) {
  Question q;
  q.f = record(1, 1, [](auto, const auto&, const auto& p, auto& dx) { dx[0] = p[0]; });
  q.g = record(1, 1, 1, [&](auto, const auto& x, const auto&, auto& y) { y[0] = output(x[0]); });
  q.box = {start, rate};
  for (int i = 1; i < 10; ++i) q.times.push_back(0.1 * i);
  return q;
}

TEST(Requirement, IsMetEverywhereOrNowhere) {
  const auto above = [](double limit) { return [limit](const auto& x) { return x - limit; }; };
  RequirementFinding found = falling({2.0, 3.0}, {-1.0, -0.5}, above(0.99)).examine();
  EXPECT_TRUE(found.isAlwaysMet);
  EXPECT_TRUE(isEqual(found.probability, Interval(1.0)));
  EXPECT_EQ(found.factor, 1);
  EXPECT_TRUE(isEqual(found.violationPossibility, Interval(0.0)));
  EXPECT_TRUE(found.violating.empty());
  found = falling({2.0, 3.0}, {-1.0, -0.5}, above(3.01)).examine();
  EXPECT_TRUE(found.isNeverMet);
  EXPECT_FALSE(found.isAlwaysMet);
  EXPECT_TRUE(isEqual(found.probability, Interval(0.0)));
  EXPECT_EQ(found.factor, 0);
  EXPECT_TRUE(isEqual(found.violationPossibility, Interval(1.0)));
}

/// x(1) = a + b > limit, a and b uniform: the probability of a triangle.
TEST(Requirement, HasItsProbabilityItsFactorAndItsPossibility) {
  const auto above = [](const auto& x) { return x - 1.25; };
  const RequirementFinding found = falling({2.0, 3.0}, {-1.0, 0.0}, above).examine();  // violated: a + b < 1.25
  EXPECT_FALSE(found.isAlwaysMet || found.isNeverMet);
  EXPECT_TRUE(contains(found.probability, 1 - 0.5 * 0.25 * 0.25));
  EXPECT_LT(width(found.probability), 0.003);
  EXPECT_LE(found.met, 1 - 0.5 * 0.25 * 0.25);
  EXPECT_GT(found.met, 0.96);
  EXPECT_LE(found.violated, 0.5 * 0.25 * 0.25);
  // Nominal 2.5 and -0.5: both deviate by 0.75 of their half-widths where the sum is 1.25.
  EXPECT_LE(found.factor, 0.75);
  EXPECT_GT(found.factor, 0.747);
  // Triangular: membership 0.25 there.
  EXPECT_LE(found.violationPossibility.lower(), 0.25);
  EXPECT_GE(found.violationPossibility.upper(), 0.25);
  EXPECT_LT(width(found.violationPossibility), 0.01);
  ASSERT_EQ(found.violating.size(), 2U);
  EXPECT_LT(found.violating[0] + found.violating[1], 1.25);
}

/// Cells are the whole box, and each says what holds at all of its points: x ends at a + b, a in [2, 3], b in [-1, 0].
TEST(Requirement, IsDecidedInCellsThatAreTheWholeBox) {
  for (const double limit : {0.9, 1.001, 1.25, 1.5, 1.6180339887, 2.999, 3.1})
    for (const When when : {When::always, When::eventually})
      for (const std::size_t most : {std::size_t{1}, std::size_t{10}, std::size_t{301}}) {
        Question all = falling({2.0, 3.0}, {-1.0, 0.0}, [&](const auto& x) { return x - limit; });
        all.when = when;
        all.options.mostCells = most;
        const std::vector<DecidedCell> cells = all.cells();
        EXPECT_LE(cells.size(), most);
        double volume = 0, decided = 0;
        for (const auto& [part, verdict] : cells) {
          ASSERT_EQ(part.half.size(), 2u);
          volume += part.half[0] * part.half[1];
          if (verdict == Cell::Verdict::open) continue;
          decided += part.half[0] * part.half[1];
          for (const double x : {-1, 1})
            for (const double y : {-1, 1}) {
              const double a = 2.5 + 0.5 * (part.centre[0] + x * part.half[0]),
                           b = -0.5 + 0.5 * (part.centre[1] + y * part.half[1]);
              const double least = when == When::always ? a + b : a;
              EXPECT_EQ(verdict == Cell::Verdict::met, least > limit) << limit << " " << a << " " << b;
            }
        }
        EXPECT_EQ(volume, 1) << "sides are halved";
        if (most > 300) {
          EXPECT_GT(decided, 0.9) << limit;
        }
        for (std::size_t i = 0; i < cells.size(); ++i)
          for (std::size_t j = 0; j < i; ++j) {
            const auto apart = [&](std::size_t l) {
              return std::fabs(cells[i].part.centre[l] - cells[j].part.centre[l]) >=
                     cells[i].part.half[l] + cells[j].part.half[l];
            };
            EXPECT_TRUE(apart(0) || apart(1));
          }
      }
}

TEST(Requirement, KeepsFewCellsWhereLittleWorkIsAllowed) {
  Question all = falling({2.0, 3.0}, {-1.0, 0.0}, [&](const auto& x) { return x - 1.25; });
  all.options.mostWork = 0;
  EXPECT_EQ(all.cells().size(), 1u);
  std::atomic<bool> cancelled = true;
  all.options = {};
  all.options.cancelled = &cancelled;
  EXPECT_EQ(all.cells().size(), 1u);
}

TEST(Requirement, IsViolatedInACornerThatSamplesMiss) {
  const auto above = [](const auto& x) { return x - 1.0015; };
  const RequirementFinding found = falling({2.0, 3.0}, {-1.0, 0.0}, above).examine();  // probability 1.1e-6
  EXPECT_FALSE(found.isAlwaysMet);
  ASSERT_EQ(found.violating.size(), 2U);
  EXPECT_LT(found.violating[0] + found.violating[1], 1.0015);
  EXPECT_TRUE(contains(found.probability, 1 - 0.5 * 0.0015 * 0.0015));
}

TEST(Requirement, MayBeMetOnce) {
  // x = a - t with a in [0.2, 0.9] comes to zero in the first second, with a in [0.5, 1.5] for half of them.
  const auto below = [](const auto& x) { return -x; };
  Question all = falling({0.2, 0.9}, -1.0, below);
  all.when = When::eventually;
  EXPECT_TRUE(all.examine().isAlwaysMet);
  Question half = falling({0.5, 1.5}, -1.0, below);
  half.when = When::eventually;
  const RequirementFinding found = half.examine();
  EXPECT_TRUE(contains(found.probability, 0.5));
  EXPECT_LT(width(found.probability), 0.003);
  ASSERT_FALSE(found.violating.empty());
  EXPECT_GT(found.violating[0], 1.0);
  Question none = falling({1.01, 1.5}, -1.0, below);
  none.when = When::eventually;
  EXPECT_TRUE(none.examine().isNeverMet);
}

/// Between two output times x leaves the limit and comes back.
TEST(Requirement, LooksBetweenOutputTimes) {
  Question q;
  q.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = constant<Recorded>(-1.0);
  });
  q.g = record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = 0.1 - x[0]; });
  q.box = {0.0, Interval(0.5, 0.6)};  // x = v t - t²/2: at most v²/2 = 0.125 … 0.18 at v s
  q.horizon = 1.2;
  q.times = {0.1};
  EXPECT_FALSE(q.examine().isAlwaysMet);
  q.g = record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = 0.181 - x[0]; });
  EXPECT_TRUE(q.examine().isAlwaysMet);
  q.from = 1;  // from 0.1 s on
  q.g = record(2, 0, 1, [](auto t, const auto& x, const auto&, auto& y) { y[0] = 0.181 - x[0] + 0.0 * t; });
  EXPECT_TRUE(q.examine().isAlwaysMet);
}

TEST(Requirement, HoldsInItsWindowOnly) {
  Question q = falling({2.0, 3.0}, -1.0, [](const auto& x) { return x - 1.65; });
  EXPECT_FALSE(q.examine().isAlwaysMet);
  q.until = 3;  // 0.3 s
  EXPECT_TRUE(q.examine().isAlwaysMet);
  q.from = 3;
  EXPECT_TRUE(q.examine().isAlwaysMet);
  q.from = q.until = 4;
  EXPECT_FALSE(q.examine().isAlwaysMet);
  EXPECT_FALSE(q.examine().isNeverMet);
}

TEST(Requirement, NeedsAllOfItsMargins) {
  Question q;
  q.f = record(1, 0, [](auto, const auto&, const auto&, auto& dx) { dx[0] = constant<Recorded>(1.0); });
  q.g = record(1, 0, 2, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0] + 0.5;
    y[1] = 1.5 - x[0];
  });
  q.box = {Interval(-1.0, 1.0)};  // always: -0.5 < x(0), x(0) + 1 < 1.5
  const RequirementFinding found = q.examine();
  EXPECT_TRUE(contains(found.probability, 0.5));
  EXPECT_LT(width(found.probability), 0.003);
  EXPECT_NEAR(found.factor, 0.5, 0.003);
  EXPECT_LE(found.factor, 0.5);
}

/// Trajectories of random nonlinear systems agree with every answer, whatever their quantities are distributed like.
TEST(Requirement, AgreesWithTrajectories) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Points points(seed);
    Question q;
    const double a = 0.5 + 0.1 * seed, limit = 0.9 + 0.05 * (seed % 4);
    q.f = record(2, 1, [a](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = x[1];
      dx[1] = -p[0] * sin(x[0]) - a * x[1];
    });
    q.g = record(2, 1, 1, [limit](auto, const auto& x, const auto&, auto& y) { y[0] = limit - x[0] - 0.3 * x[1]; });
    q.box = {Interval(0.4, 1.0), Interval(-0.2, 1.0), Interval(3.0, 5.0)};
    for (int i = 1; i < 10; ++i) q.times.push_back(0.1 * i);
    q.when = seed % 3 == 0 ? When::eventually : When::always;
    q.options.mostCells = 4000;
    const RequirementFinding found = q.examine();
    Reference reference(q.f);
    std::vector<double> times = q.times;
    times.push_back(q.horizon);
    int met = 0;
    constexpr int count = 60;
    for (int i = 0; i < count; ++i) {
      const Vector start = points.inside(q.box);
      bool always = true, once = false;
      std::vector<double> all{0.0};
      all.insert(all.end(), times.begin(), times.end());
      for (const Vector& x : reference(start, all)) {
        const bool holds = Precise(limit) - x[0] - Precise(0.3) * x[1] > 0;
        always = always && holds;
        once = once || holds;
      }
      const bool isMet = q.when == When::always ? always : once;
      met += isMet;
      if (found.isAlwaysMet) {
        EXPECT_TRUE(isMet);
      }
      if (found.isNeverMet) {
        EXPECT_FALSE(isMet);
      }
      double deviation = 0;
      for (std::size_t l = 0; l < start.size(); ++l)
        deviation =
            std::max(deviation, std::fabs((static_cast<double>(start[l]) - midpoint(q.box[l])) / radius(q.box[l])));
      // Violations between output times are not seen here, so a sample that is met says nothing.
      if (deviation < found.factor && q.when == When::always) {
        EXPECT_TRUE(isMet) << seed;
      }
    }
    EXPECT_LT(width(found.probability), 0.1) << seed;
    const double share = static_cast<double>(met) / count, slack = 0.35;
    EXPECT_GT(share, found.probability.lower() - slack) << seed;
    EXPECT_LT(share, found.probability.upper() + slack) << seed;
    if (!found.violating.empty()) {
      const Vector start(found.violating.begin(), found.violating.end());
      bool isViolated = q.when == When::eventually;
      std::vector<double> all{0.0};
      for (int i = 1; i <= 200; ++i) all.push_back(i * 0.005);
      for (const Vector& x : reference(start, all)) {
        const bool holds = Precise(limit) - x[0] - Precise(0.3) * x[1] > 0;
        isViolated = q.when == When::always ? isViolated || !holds : isViolated && !holds;
      }
      EXPECT_TRUE(isViolated) << seed;
    }
  }
}

/// x(1) = a + b > limit, a of 2.5 ± 0.5, b of -0.5 ± 0.5.
struct SumOfTwo {
  explicit SumOfTwo(double limit)
      : q(falling({2.0, 3.0}, {-1.0, 0.0}, [limit](const auto& x) { return x - limit; })),
        uncertain{quantity(q.box[0], 2.5), quantity(q.box[1], -0.5)} {}

  Question q;
  std::vector<Uncertain> uncertain;
  Tube tube = [&] {
    FlowOptions flow;
    flow.modelled = {0};
    return Flow(q.f, q.g, flow).enclose(q.box, q.horizon, q.times);
  }();
  std::vector<CellQuantity> quantities{{0, &uncertain[0]}, {1, &uncertain[1]}};
  CellQuestion question{When::always, {0}, {0}, 0, tube.reachedTimes() - 1};
};

/// One quantity deviates less, the other as much as it may.
TEST(Requirement, KnowsHowMuchASingleQuantityMayDeviate) {
  const SumOfTwo sum(1.25);
  // 2.5 - 0.5 f + (-1) > 1.25: f = 0.5; both: 2 - f > 1.25.
  EXPECT_NEAR(guaranteedFactor(*sum.tube.models(), sum.question, sum.quantities, {1, 0}), 0.5, 0.003);
  EXPECT_NEAR(guaranteedFactor(*sum.tube.models(), sum.question, sum.quantities, {0, 1}), 0.5, 0.003);
  EXPECT_NEAR(guaranteedFactor(*sum.tube.models(), sum.question, sum.quantities, {1, 1}), 0.75, 0.003);
  EXPECT_EQ(guaranteedFactor(*sum.tube.models(), sum.question, sum.quantities, {0, 0}), 0);
}

/// With b = -1, a may fall to 1 + limit; and the other way round.
TEST(Requirement, EnclosesHowMuchOneQuantityMustDeviateLessAlone) {
  for (const double limit : {1.0625, 1.125, 1.25, 1.375, 1.484375, 1.5, 1.5625, 1.75, 2.25}) {
    SCOPED_TRACE(limit);
    const SumOfTwo sum(limit);
    const double exact = std::max(0.0, 3 - 2 * limit);  // all of these are doubles
    for (const std::size_t alone : {0, 1}) {
      const Interval found = factorAlone(*sum.tube.models(), sum.question, sum.quantities, alone);
      EXPECT_LE(found.lower(), exact);
      EXPECT_GE(found.upper(), exact);
      EXPECT_LT(width(found), 0.01);
      EXPECT_TRUE(limit <= 1.5 || isEqual(found, Interval(0.0)));
    }
  }
}

/// c + Σ a_i η_i + Σ b_ij η_i η_j of two to four quantities, nominal anywhere, is least at corners, and along one
/// quantity it is a line: on each the greatest part of its way to either side that stays above zero is a quotient.
TEST(Requirement, EnclosesHowMuchOneMustDeviateLessOfManyProducts) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> any(-1, 1);
  int enough = 0, never = 0, all = 0;
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    const std::size_t count = 2 + trial % 3;
    std::vector<double> slope(count), product(count * count);
    for (double& a : slope) a = any(engine);
    for (double& b : product) b = 0.3 * any(engine);
    const double least = 0.4 + 0.9 * count * std::abs(any(engine));
    const auto value = [&](const auto& eta) {
      std::decay_t<decltype(eta[0])> sum = least + slope[0] * eta[0];
      for (std::size_t i = 1; i < count; ++i) sum = sum + slope[i] * eta[i];
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < i; ++j) sum = sum + product[i * count + j] * eta[i] * eta[j];
      return sum;
    };
    Box box(count, Interval(-1.0, 1.0));
    std::vector<Uncertain> uncertain;
    for (std::size_t q = 0; q < count; ++q) uncertain.push_back(quantity(box[q], 0.9 * any(engine)));
    std::vector<CellQuantity> quantities;
    for (std::size_t q = 0; q < count; ++q) quantities.push_back({static_cast<int>(q), &uncertain[q]});
    const Program g =
        record(0, static_cast<int>(count), 1, [&](auto, const auto&, const auto& p, auto& y) { y[0] = value(p); });
    const auto models = findImage(g, 0.0, box, {}, {0}, -1, nullptr).models;
    ASSERT_TRUE(models);
    for (std::size_t alone = 0; alone < count; ++alone) {
      Precise exact = 1;
      for (unsigned corner = 0; corner < 1U << count; ++corner) {
        Vector eta(count);
        for (std::size_t q = 0; q < count; ++q) eta[q] = (corner >> q & 1U) != 0 ? 1 : -1;
        const Precise nominal = uncertain[alone].nominal, end = value(eta);
        eta[alone] = nominal;
        const Precise begin = value(eta);
        if (begin <= 0)
          exact = 0;
        else if (end < 0)
          exact = std::min<Precise>(exact, begin / (begin - end));
      }
      const Interval found = factorAlone(*models, {When::always, {0}, {0}, 0, 0}, quantities, alone);
      EXPECT_LE(Precise(found.lower()), exact);
      EXPECT_GE(Precise(found.upper()), exact);
      EXPECT_LT(width(found), 0.02);
      (exact == 0 ? never : exact == 1 ? all : enough) += 1;
    }
  }
  EXPECT_GT(enough, 10);
  EXPECT_GT(never, 10);
  EXPECT_GT(all, 10);
}

/// Whatever the quantities are distributed like: as many of a million values as the bounds say.
TEST(Requirement, AgreesWithManyDraws) {
  const Interval first(2.0, 3.0), second(-1.0, 0.5);
  const std::vector<Distribution> shapes{Distribution::triangular(first, 2.2), Distribution::normal(first, 2.6, 0.2),
                                         Distribution::beta(first, 2, 5), Distribution::weibull(first, 3, 2.5),
                                         Distribution::uniform(Interval(2.1, 2.9))};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    Question q = falling(first, second, [](const auto& x) { return sqr(x) - 2.6; });
    q.when = i % 2 == 0 ? When::always : When::eventually;
    q.uncertain = {quantity(first, 2.5), quantity(second, 0.0)};
    q.uncertain[0].distribution = shapes[i];
    q.uncertain[1].distribution = Distribution::triangular(second, 0.1);
    const RequirementFinding found = q.examine();
    std::mt19937_64 engine(i);
    std::uniform_real_distribution<double> any(0, 1);
    int met = 0;
    constexpr int count = 200000;
    for (int k = 0; k < count; ++k) {
      const double x = q.uncertain[0].distribution.quantile(any(engine)),
                   v = q.uncertain[1].distribution.quantile(any(engine));
      const bool start = x * x > 2.6, end = (x + v) * (x + v) > 2.6;  // monotone between
      met += q.when == When::always ? start && end : start || end;
    }
    const double share = static_cast<double>(met) / count, slack = 5 * 0.5 / std::sqrt(count);
    EXPECT_GT(share, found.probability.lower() - slack) << i;
    EXPECT_LT(share, found.probability.upper() + slack) << i;
    EXPECT_LT(width(found.probability), 0.01) << i;
  }
}

TEST(Requirement, RefusesAWindowWithoutModels) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -x[0]; });
  FlowOptions options;
  options.modelled = {0};
  const Tube tube = Flow(f, f, options).enclose({Interval(1.0, 2.0)}, 1.0, {0.5});
  const CellQuestion beyond{When::always, {0}, {0}, 0, 3}, backwards{When::always, {0}, {0}, 2, 1};
  EXPECT_THROW(examine(*tube.models(), beyond, {}), std::invalid_argument);
  EXPECT_THROW(examine(*tube.models(), backwards, {}), std::invalid_argument);
}

}  // namespace
}  // namespace gamut::testing
