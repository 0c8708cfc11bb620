// Nothing the flow finds depends on the units in which states are measured against each other: the comparison system
// against its series in 128 bits, and the same motion in units far apart.
#include <cmath>

#include "analyses/flow/growth.hpp"
#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

using Matrix = std::vector<std::vector<Precise>>;

/// factor Σ_{k<200} (Ah)^k m!/(m+k+1)! (m = -1: (Ah)^k/k!).
Matrix series(const Matrix& Ah, int m, const Precise& factor) {
  const int n = static_cast<int>(Ah.size());
  Matrix term(at(n), Vector(at(n), Precise(0.0))), sum = term;
  for (int i = 0; i < n; ++i) term[at(i)][at(i)] = m < 0 ? factor : Precise(factor / (m + 1));
  for (int k = 1; k <= 200; ++k) {
    Matrix next(at(n), Vector(at(n), Precise(0.0)));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        sum[at(i)][at(j)] += term[at(i)][at(j)];
        for (int l = 0; l < n; ++l) next[at(i)][at(j)] += Ah[at(i)][at(l)] * term[at(l)][at(j)] / (m + 1 + k);
      }
    term = next;
  }
  return sum;
}

void expectBounds(double bound, const Precise& exact) {
  EXPECT_GE(Precise(bound), exact);
  EXPECT_LE(Precise(bound), Precise(exact * 1.00001 + 1e-180));
}

TEST(FlowGrowth, BoundsItsSeriesEntryByEntryInEveryUnits) {
  Points points(5);
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const int n = points.integer(1, 5), m = points.integer(4, 30);
    const double h = std::pow(2.0, points.integer(-20, 20)), size = points.uniform(0.01, 4),
                 density = points.uniform(0, 1);
    std::vector<int> exponent;
    for (int i = 0; i < n; ++i) exponent.push_back(points.integer(-40, 40));
    FlowGrowth growth(n, m);
    Matrix Ah(at(n), Vector(at(n), Precise(0.0)));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double entry = points.uniform(0, 1) < density ? size * points.uniform(0, 1) : 0.0;
        growth.A(i, j) = std::ldexp(entry / h, exponent[at(i)] - exponent[at(j)]);
        Ah[at(i)][at(j)] = Precise(growth.A(i, j)) * Precise(h);
      }
    ASSERT_TRUE(growth.compute(h));
    const Matrix M0 = series(Ah, -1, Precise(1.0)), M1 = series(Ah, 0, Precise(h)), M2 = series(Ah, m, Precise(h));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        expectBounds(growth.M0(i, j), M0[at(i)][at(j)]);
        expectBounds(growth.M1(i, j), M1[at(i)][at(j)]);
        expectBounds(growth.M2(i, j), M2[at(i)][at(j)]);
      }
    if (HasFailure()) return;
  }
}

TEST(FlowGrowth, RefusesWhatGrowsTooMuch) {
  FlowGrowth growth(2, 20);
  growth.A(0, 0) = growth.A(0, 1) = growth.A(1, 0) = growth.A(1, 1) = 40;
  EXPECT_TRUE(growth.compute(0.5));
  EXPECT_NEAR(growth.growth(), 40, 1e-9);
  EXPECT_FALSE(growth.compute(1));
}

/// Two coupled oscillators, every state x = 2^{exponent} z.
Containment oscillators(const std::vector<int>& exponent, double radius) {
  Containment c;
  const auto size = [=](int i) { return std::ldexp(1.0, exponent[at(i)]); };
  c.f = record(4, 0, [&](auto, const auto& x, const auto&, auto& dx) {
    std::vector<Recorded> z, rate(4);
    for (int i = 0; i < 4; ++i) z.push_back(x[at(i)] * (1 / size(i)));
    rate[0] = z[1];
    rate[1] = -9.0 * sin(z[0]) + z[2];
    rate[2] = z[3] / (2.0 + z[0]);
    rate[3] = -4.0 * z[2] + 0.5 * z[0] * z[1];
    for (int i = 0; i < 4; ++i) dx[at(i)] = size(i) * rate[at(i)];
  });
  c.g = standardOutputs(4, 0);
  c.box = {size(0) * Interval(1 - radius, 1 + radius), 0.0, size(2) * 0.5, size(3) * Interval(-0.25, -0.25)};
  c.horizon = 6;
  c.times = {1, 2.5};
  return c;
}

TEST(Flow, IsAsTightAndAsQuickInUnitsFarApart) {
  for (double radius : {0.0, 0.01})
    for (const std::vector<int>& exponent : {std::vector<int>{0, 20, -20, 5}, {30, -10, 0, 33}, {-40, -40, 40, 40}}) {
      const Tube natural = oscillators({0, 0, 0, 0}, radius).tube();
      Containment c = oscillators(exponent, radius);
      Judge judge(c);
      ASSERT_EQ(judge.tube().why(), "");
      judge.judge(3);
      EXPECT_LE(judge.tube().steps(), 1.1 * static_cast<double>(natural.steps()));
      for (std::size_t row = 1; row < natural.reachedTimes(); ++row)
        for (int i = 0; i < 4; ++i)
          EXPECT_LE(std::ldexp(width(judge.tube().states(row)[at(i)]), -exponent[at(i)]),
                    2 * width(natural.states(row)[at(i)]))
              << "row " << row << ", state " << i;
    }
}

}  // namespace
}  // namespace gamut::testing
