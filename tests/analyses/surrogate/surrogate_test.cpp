// Surrogates of motions whose truth is known: in whatever order quantities are named, with others beside them, on all
// parts that a flow has bisected the box into.
#include "analyses/surrogate/surrogate.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "analyses/flow/flow.hpp"
#include "analyses/surrogate/surrogate_evaluator.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

/// x' = -b x², y' = c: x = a / (1 + a b t), y = d + c t.
struct Decay {
  Program f = record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = -p[0] * sqr(x[0]);
    dx[1] = p[1];
  });
  Program g = record(2, 2, 3, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = 2.0 * x[0];
    y[1] = x[0] * x[1];
    y[2] = x[1];
  });
  Box box{{1.0, 3.0}, {0.5, 0.6}, {0.5, 2.0}, {-1.0, 1.0}};
  std::vector<double> times{0.5, 1.5, 2.0};

  Tube tube(FlowOptions options) const { return Flow(f, g, std::move(options)).enclose(box, 2.0, times); }

  static double output(int number, double time, const std::vector<double>& of) {
    const double x = of[0] / (1 + of[0] * of[2] * time), y = of[1] + of[3] * time;
    return number == 0 ? 2 * x : number == 1 ? x * y : y;
  }
};

/// What a surrogate says of values; the rest of the whole box is `others`.
void expectHolds(const Decay& decay, const std::vector<double>& times, const Surrogate& surrogate,
                 const std::vector<int>& components, const std::vector<int>& outputs) {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> values, xi(components.size());
    for (const Interval& range : decay.box) values.push_back(midpoint(range) + 0.5 * width(range) * anywhere(engine));
    for (std::size_t q = 0; q < components.size(); ++q) {
      const FlowSymbol& of = surrogate.quantities[q];
      ASSERT_GE(of.symbol, 0);
      xi[static_cast<std::size_t>(of.symbol)] = (values[static_cast<std::size_t>(components[q])] - of.centre) / of.half;
    }
    for (std::size_t r = 0; r < surrogate.rows.size(); ++r)
      for (const SurrogatePart& part : surrogate.at[r]) {
        std::vector<double> eta;
        bool isHere = true;
        for (std::size_t l = 0; l < xi.size(); ++l) {
          eta.push_back((xi[l] - part.part.centre[l]) / part.part.half[l]);
          isHere = isHere && std::fabs(eta.back()) <= 1;
        }
        if (!isHere) continue;
        ++found;
        for (std::size_t o = 0; o < outputs.size(); ++o) {
          const OutputModel& model = part.outputs[o];
          ASSERT_FALSE(model.c.empty());
          double sum = 0;
          for (std::size_t g = 0; g < model.c.size(); ++g) {
            double term = model.c[g];
            for (std::size_t l = 0; l < eta.size(); ++l)
              term *= std::pow(eta[l], part.monomials->exponent(static_cast<int>(g), static_cast<int>(l)));
            sum += term;
          }
          const double truth = Decay::output(outputs[o], times[surrogate.rows[r]], values);
          EXPECT_LE(std::fabs(sum - truth), model.radius + 1e-14) << outputs[o] << " at " << times[surrogate.rows[r]];
        }
      }
  }
  EXPECT_GE(found, 300 * static_cast<int>(surrogate.rows.size()));
}

TEST(Surrogate, IsOfAllPartsInAnyOrderOfQuantities) {
  const Decay decay;
  FlowOptions options;
  options.modelled = {2};
  options.modelledAt = {0, 1};
  const Tube tube = decay.tube(options);
  ASSERT_EQ(tube.why(), "");
  ASSERT_EQ(tube.models()->modelled, 3U);
  for (const std::vector<int>& components : {std::vector<int>{0, 1, 2, 3}, {3, 0, 2, 1}, {2, 3, 1, 0}}) {
    expectHolds(decay, tube.times(), surrogateOf(*tube.models(), components, 1, 3), components, {0, 1});
    expectHolds(decay, tube.times(), surrogateOf(*tube.models(), components, 0, 1), components, {2});
  }
  // What is not named may be anything.
  const Surrogate part = surrogateOf(*tube.models(), {2, 0}, 0, 3);
  EXPECT_EQ(part.symbols, 2);
  expectHolds(decay, tube.times(), part, {2, 0}, {2, 0, 1});
  // A remainder was bisected, or so it is said.
  FlowModels doubtful = *tube.models();
  doubtful.areAlternatives = true;
  expectHolds(decay, tube.times(), surrogateOf(doubtful, {3, 0, 2, 1}, 0, 3), {3, 0, 2, 1}, {2, 0, 1});
}

/// Strips across one symbol, across another, across a third: cells that lie in one of each would be 2 million.
TEST(Surrogate, IsOfFewCellsWhereAlternativesAreCutInDifferentSymbols) {
  constexpr int strips = 128, symbols = 3;
  FlowModels models;
  const auto monomials = std::make_shared<const Monomials>(std::vector<int>(symbols, 1), 1);
  for (int q = 0; q < symbols; ++q) models.components.push_back({0, 1, q});
  models.symbols = symbols;
  models.modelled = 1;
  models.areAlternatives = true;
  models.at.resize(1);
  // The first symbol's strips say ξ_0 + ξ_1 + ξ_2, others as much and 1, or 2.
  for (int across = 0; across < symbols; ++across)
    for (int i = 0; i < strips; ++i) {
      FlowSnapshot snapshot{0, {{0, 0, 0}, {1, 1, 1}}, monomials, {}, ""};
      const auto l = static_cast<std::size_t>(across);
      snapshot.part.half[l] = 1.0 / strips;
      snapshot.part.centre[l] = (2 * i + 1.0) / strips - 1;
      OutputModel model{{snapshot.part.centre[l] + across, 0, 0, 0}, 0, {}};
      for (int g = 1; g < monomials->count(); ++g)
        for (int m = 0; m < symbols; ++m)
          if (monomials->exponent(g, m) == 1)
            model.c[static_cast<std::size_t>(g)] = snapshot.part.half[static_cast<std::size_t>(m)];
      const double reach = 2 + 1.0 / strips;
      model.bound = Interval(model.c[0] - reach, model.c[0] + reach);
      snapshot.outputs = {model};
      models.at[0].push_back(std::make_shared<const FlowSnapshot>(snapshot));
    }
  const Surrogate surrogate = surrogateOf(models, {0, 1, 2}, 0, 1);
  ASSERT_EQ(surrogate.at.size(), 1U);
  EXPECT_LT(surrogate.at[0].size(), 20000U);
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<double> xi{anywhere(engine), anywhere(engine), anywhere(engine)};
    int found = 0;
    for (const SurrogatePart& tile : surrogate.at[0]) {
      bool isHere = true;
      for (std::size_t l = 0; l < xi.size(); ++l)
        isHere = isHere && std::fabs(xi[l] - tile.part.centre[l]) <= tile.part.half[l];
      if (!isHere) continue;
      ++found;
      const OutputModel& model = tile.outputs[0];
      const double sum = xi[0] + xi[1] + xi[2];
      EXPECT_TRUE(contains(model.bound, sum) && contains(model.bound, sum + 2));
      EXPECT_LT(width(model.bound), 9);
    }
    EXPECT_GE(found, 1);
  }
}

/// Parts that meet where the value is 0: |x|, of x that is 0 too.
TEST(SurrogateEvaluator, SettlesValuesWherePartsMeet) {
  PackedSurrogate packed;
  packed.centre = {0};
  packed.half = {1};
  packed.row = packed.firstTerm = {0, 0};
  packed.partCentre = {-0.5, 0.5};
  packed.partHalf = {0.5, 0.5};
  packed.exponent = {0, 1};
  packed.first = {0, 2};
  packed.count = {2, 2};
  packed.radius = {0, 0};
  packed.coefficient = {0.5, -0.5, 0.5, 0.5};
  const SurrogateEvaluator evaluator(packed, {0}, {0});
  for (double value : {0.0, -0.0, 1e-300, -1e-17, 0.25, -1.0, 1.0}) {
    const double before = value;
    evaluator.settle({&value, 1});
    EXPECT_NEAR(value, before, 1e-14);
    double output = 0, error = 0;
    evaluator.evaluate({&value, 1}, {&output, 1}, {&error, 1});
    EXPECT_LE(std::fabs(output - std::fabs(value)), error);
    EXPECT_LT(error, 1e-13);
  }
}

/// The same part at two times, with terms in another order: x + 2 y, then x + 2 y again.
TEST(SurrogateEvaluator, KnowsTheTermsOfEachTime) {
  PackedSurrogate packed;
  packed.centre = {0, 0};
  packed.half = {1, 1};
  packed.row = {0, 1};
  packed.firstTerm = {0, 3};
  packed.partCentre = {0, 0, 0, 0};
  packed.partHalf = {1, 1, 1, 1};
  packed.exponent = {0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0};
  packed.first = {0, 3};
  packed.count = {3, 3};
  packed.radius = {0, 0};
  packed.coefficient = {0, 1, 2, 0, 2, 1};
  const SurrogateEvaluator evaluator(packed, {0, 1}, {0});
  const std::vector<double> values{0.25, 0.5};
  std::vector<double> outputs(2), errors(2);
  evaluator.evaluate(values, outputs, errors);
  EXPECT_NEAR(outputs[0], 1.25, 1e-14);
  EXPECT_NEAR(outputs[1], 1.25, 1e-14);
}

/// With margins beside them, which are wanted at all times, and without; on one thread and on three.
TEST(Surrogate, IsOfFewerTimesWhereModelsOfAllFindNoRoom) {
  Decay decay;
  decay.times.clear();
  for (int i = 0; i <= 64; ++i) decay.times.push_back(i / 32.0);
  for (const bool hasMargins : {true, false}) {
    FlowOptions options;
    if (hasMargins) options.modelled = {2};
    options.modelledAt = {0, 1};
    const std::size_t from = hasMargins ? 1 : 0;
    const Surrogate whole = surrogateOf(*decay.tube(options).models(), {0, 1, 2, 3}, from, from + 2);
    ASSERT_EQ(whole.rows.size(), decay.times.size());
    double bytes = 0;
    for (const std::vector<SurrogatePart>& parts : whole.at)
      for (const SurrogatePart& part : parts)
        for (const OutputModel& model : part.outputs)
          bytes += static_cast<double>(sizeof(OutputModel) + sizeof(double) * model.c.size());
    options.thinAtBytes = bytes / 6;  // every eighth
    options.firstAt = {3, 5};
    for (const int jobs : {1, 3}) {
      options.jobs = jobs;
      const Tube tube = decay.tube(options);
      EXPECT_EQ(tube.models()->modelled, from + 2);
      const Surrogate thin = surrogateOf(*tube.models(), {0, 1, 2, 3}, from, from + 2);
      EXPECT_EQ(thin.rows, (std::vector<std::size_t>{0, 3, 5, 8, 16, 24, 32, 40, 48, 56, 64}));
      for (std::size_t r = 0; r < thin.rows.size(); ++r) {
        const std::vector<SurrogatePart>& parts = whole.at[thin.rows[r]];
        ASSERT_EQ(thin.at[r].size(), parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i)
          for (std::size_t o = 0; o < 2; ++o) EXPECT_EQ(thin.at[r][i].outputs[o].c, parts[i].outputs[o].c);
      }
      if (hasMargins) {
        EXPECT_EQ(surrogateOf(*tube.models(), {0, 1, 2, 3}, 0, 1).rows.size(), decay.times.size());
      }
    }
    options.thinAtBytes = options.modelAtBytes = 100;  // not even those
    const Tube none = decay.tube(options);
    EXPECT_EQ(none.models()->modelled, from);
    EXPECT_TRUE(surrogateOf(*none.models(), {0, 1, 2, 3}, from, from + 2).rows.empty());
  }
}

TEST(Surrogate, IsEmptyWhereModelsFoundNoRoom) {
  const Decay decay;
  FlowOptions options;
  options.modelled = {2};
  options.modelledAt = {0, 1};
  options.modelAtBytes = 100;
  const Tube tube = decay.tube(options);
  ASSERT_TRUE(tube.models());
  EXPECT_EQ(tube.models()->modelled, 1U);
  EXPECT_TRUE(surrogateOf(*tube.models(), {0, 1, 2, 3}, 1, 3).rows.empty());
  EXPECT_EQ(surrogateOf(*tube.models(), {0, 1, 2, 3}, 0, 1).rows.size(), tube.reachedTimes());
}

}  // namespace
}  // namespace gamut::testing
