// Rates of jumps' arguments as polynomials along a step, against their values in 128 bits.
#include "analyses/flow/step/jump_rates.hpp"

#include <gtest/gtest.h>

#include "analyses/flow/embedding.hpp"
#include "analyses/flow/formulation.hpp"
#include "analyses/flow/step/step.hpp"
#include "scalars/index.hpp"
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

/// Two masses with friction, coupled by what they push: u = x₁ and x₂ - ½ x₁ - p.
Program coupled() {
  return record(2, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    const auto first = sign(x[0]), second = sign(x[1] - 0.5 * x[0] - p[0]);
    const auto mass = 2 + cos(x[0] * x[1] + t);
    dx[0] = (sin(3 * t) + p[0] * x[1] - first + 0.5 * second) / mass;
    dx[1] = (x[0] * x[0] - 0.5 * second - p[0] * first) / mass;
  });
}

/// x̃ of a state.
Precise polynomialAt(const PolynomialSeries& series, int state, int order, const Precise& sigma, const Vector& xi) {
  Precise sum(0.0);
  for (int g = 0; g < series.count(); ++g) {
    Precise product(1.0), ofTime(0.0);
    for (int l = 0; l < series.monomials().symbols(); ++l)
      product *= Precise(pow(xi[detail::at(l)], series.monomials().exponent(g, l)));
    for (int i = order; i >= 0; --i) ofTime = ofTime * sigma + series.series(state)[g * series.stride() + i];
    sum += product * ofTime;
  }
  return sum;
}

TEST(JumpRates, HoldTheRatesOnEitherSideAlongAStep) {
  const Program f = coupled(), differentiated = differentiatedFor(f, {});
  const FlowJumps jumps(differentiated, {});
  ASSERT_EQ(jumps.count(), 2U);
  Evaluator<Precise> exact(jumps.given);
  Points points;
  int changes = 0;  // of sides, within what was asked for
  for (const int symbols : {0, 2}) {
    SCOPED_TRACE(symbols);
    const auto monomials =
        std::make_shared<const Monomials>(std::vector<int>(detail::at(symbols), 1), symbols > 0 ? 4 : 0);
    constexpr int order = 12;
    FlowStepper stepper(differentiated, monomials, symbols > 0 ? 2 : 0, order, 1e-10, FlowInputs(2, order, {}, 0.1));
    const double half = symbols > 0 ? 0.1 : 0;
    const Box box{Interval(0.6 - half, 0.6 + half), Interval(2.0), Interval(0.3 - half, 0.3 + half)};
    const FlowSet set = startOf(Embedding(box, 2, {}), 2, *monomials, symbols > 0 ? 2 : 0);
    ASSERT_EQ(stepper.certify(set, 0.5, 0x1p-54), StepOutcome::stepped);
    JumpRates rates(jumps, monomials, order, 0.5, 0x1p-54, nullptr);
    const std::vector<Interval> signs{Interval(-0.25, 1), Interval(0.5, 0.75)};
    const std::vector<double> tube{1e-3, 2e-3};
    const double theta = stepper.theta();
    ASSERT_TRUE(rates.load(stepper.series(), 0, stepper.scale(), theta, set.parameters, signs, tube));
    for (int trial = 0; trial < 300; ++trial) {
      const double from = points.uniform(0, theta), to = trial % 3 == 0 ? from : points.uniform(from, theta);
      const double sigma = points.uniform(from, to);
      std::vector<Precise> xi, x;
      for (int l = 0; l < symbols; ++l) xi.emplace_back(points.signedUnit());
      for (int i = 0; i < 2; ++i)
        x.push_back(polynomialAt(stepper.series(), i, order, Precise(sigma), xi) +
                    tube[detail::at(i)] * Precise(points.signedUnit()));
      Vector parameters{Precise(0.3) + (symbols > 0 ? half * xi[1] : Precise(0.0))};
      for (const Interval& sign : signs) parameters.emplace_back(points.uniform(sign.lower(), sign.upper()));
      for (std::size_t jump = 0; jump < 2; ++jump)
        for (const double side : {1.0, -1.0}) {
          Vector all = parameters;
          all[1 + jump] = side;
          exact.setParameters(all);
          const Vector y = exact(Precise(sigma) * stepper.scale(), x);
          EXPECT_THAT(rates.over(jump, side, from, to), Encloses(y[4 + jump])) << jump << " " << side;
          EXPECT_THAT(rates.argumentOver(jump, from, to), Encloses(y[2 + jump])) << jump;
          for (const double of : {1.0, -1.0}) {
            const double away = rates.awayUntil(jump, side, of, from, to);
            const double argumentAway = rates.argumentAwayUntil(jump, of, from, to);
            EXPECT_TRUE(sigma >= away || of * y[4 + jump] > 0);
            EXPECT_TRUE(sigma >= argumentAway || of * y[2 + jump] > 0);
            EXPECT_TRUE(from <= away && away <= to && from <= argumentAway && argumentAway <= to);
            const auto isAway = [&](const Interval& number) {
              return of > 0 ? number.lower() > 0 : number.upper() < 0;
            };
            EXPECT_TRUE(away == to || !isAway(rates.over(jump, side, from, to)));
            EXPECT_TRUE(argumentAway == to || !isAway(rates.argumentOver(jump, from, to)));
            changes += (away > from && away < to) || (argumentAway > from && argumentAway < to);
          }
        }
    }
  }
  EXPECT_GT(changes, 0);
}

}  // namespace
}  // namespace gamut::testing
