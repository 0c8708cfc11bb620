// Nothing the flow finds depends on the units in which states are measured against each other: the comparison system
// against its series in 128 bits, and the same motion in units far apart.
#include <cmath>

#include "analyses/flow/step/growth.hpp"
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

/// e^{Bt} of a small Bt, of any signs, then of 2^k times as much.
Matrix exponential(const Matrix& Bt, int k) {
  Matrix part = Bt;
  for (Vector& row : part)
    for (Precise& entry : row) entry = Precise(entry * std::ldexp(1.0, -k));
  Matrix result = series(part, -1, Precise(1.0));
  const std::size_t n = Bt.size();
  for (; k > 0; --k) {
    Matrix square(n, Vector(n, Precise(0.0)));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t l = 0; l < n; ++l) square[i][j] += result[i][l] * result[l][j];
    result = square;
  }
  return result;
}

/// With damping |y|' ≤ B |y| + δ: integrals over the step and every e^{Bt} on the way, by the trapezoidal rule from
/// below: e^{Bt} is no convex function of time, but with 1/512 of a step's time in each part off by less than 1 %.
TEST(FlowGrowth, BoundsWhatIsDampedAtEveryTimeOfTheStep) {
  Points points(6);
  constexpr int parts = 512;
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const int n = points.integer(1, 4), m = points.integer(4, 30);
    const double h = std::pow(2.0, points.integer(-20, 20)), density = points.uniform(0, 1);
    std::vector<int> exponent;
    for (int i = 0; i < n; ++i) exponent.push_back(points.integer(-40, 40));
    FlowGrowth growth(n, m);
    Matrix part(at(n), Vector(at(n), Precise(0.0)));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double entry = points.uniform(0, 1) < density ? 3 * points.uniform(0, 1) : 0.0;
        growth.A(i, j) = std::ldexp(entry / h, exponent[at(i)] - exponent[at(j)]);
        part[at(i)][at(j)] = Precise(growth.A(i, j)) * Precise(h / parts);
      }
    for (int i = 0; i < n; ++i) {
      const double rate = i == 0 ? -points.uniform(1.5, 30) : points.uniform(-30, 2);
      growth.A(i, i) = std::fabs(rate) / h;
      growth.diagonal(i) = rate / h;
      part[at(i)][at(i)] = Precise(rate / h) * Precise(h / parts);
    }
    ASSERT_TRUE(growth.compute(h));
    EXPECT_TRUE(growth.isDamped());
    const Matrix little = exponential(part, 0);
    Matrix now = exponential(part, 60), M1(at(n), Vector(at(n), Precise(0.0))), M2 = M1;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) now[at(i)][at(j)] = i == j ? 1 : 0;
    const double above = 1.06;  // what chords in place of e^{-rate t} cost
    for (int k = 0; k <= parts; ++k) {
      const Precise weight = Precise(h / parts) * (k == 0 || k == parts ? 0.5 : 1.0);
      const Precise left = Precise(pow(Precise(1 - static_cast<double>(k) / parts), m));
      Matrix next(at(n), Vector(at(n), Precise(0.0)));
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const Precise& entry = now[at(i)][at(j)];
          ASSERT_GE(Precise(growth.M0(i, j)), entry) << "at " << k;
          M1[at(i)][at(j)] += weight * entry;
          M2[at(i)][at(j)] += weight * left * entry;
          for (int l = 0; l < n; ++l) next[at(i)][at(j)] += little[at(i)][at(l)] * now[at(l)][at(j)];
        }
      now = next;
    }
    const Precise tiny(1e-180);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        EXPECT_GE(Precise(growth.M1(i, j)), Precise(M1[at(i)][at(j)] * 0.999));
        EXPECT_LE(Precise(growth.M1(i, j)), Precise(M1[at(i)][at(j)] * above + tiny));
        EXPECT_GE(Precise(growth.M2(i, j)), Precise(M2[at(i)][at(j)] * 0.98));
        EXPECT_LE(Precise(growth.M2(i, i)), Precise(M2[at(i)][at(i)] * 2));
      }
    if (HasFailure()) return;
  }
}

/// A fast state that drives a slow one and hardly feels it: with |∂f/∂x| both would grow by e^40.
TEST(FlowGrowth, KnowsWhatDecaysFromWhatGrows) {
  FlowGrowth growth(2, 20);
  const auto compute = [&](bool isDamped) {
    growth.A(0, 0) = 40;
    growth.A(1, 0) = 1;
    growth.A(0, 1) = 1e-3;
    growth.A(1, 1) = 0;
    if (isDamped) growth.diagonal(0) = -40;
    return growth.compute(1);
  };
  ASSERT_TRUE(compute(true));
  EXPECT_TRUE(growth.isDamped());
  EXPECT_LT(growth.growth(), 1e-3);
  EXPECT_LT(growth.M0(1, 1), 1.001);
  EXPECT_LT(growth.M1(0, 0), 1.03 / 40);
  ASSERT_TRUE(compute(false));  // what was said of the sign holds once
  EXPECT_FALSE(growth.isDamped());
  EXPECT_NEAR(growth.growth(), 40, 1e-2);
  EXPECT_GT(growth.M0(0, 0), 1e17);
}

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix product(a.size(), Vector(a.size(), Precise(0.0)));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a.size(); ++j)
      for (std::size_t l = 0; l < a.size(); ++l) product[i][j] += a[i][l] * b[l][j];
  return product;
}

/// y' = J(t) y - δ with J(t) anything within `spread` of a centre, here another matrix in each part of the step, at its
/// ends mostly; what δ of the worst signs does, constant in each part and no more than 1, or (t/h)^m.
TEST(FlowGrowth, BoundsWhatIsAboutACentreForEveryJacobianInTheSpread) {
  Points points(7);
  constexpr int parts = 24;
  int about = 0;
  for (int round = 0; round < 120; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const int n = points.integer(1, 5), m = points.integer(4, 30);
    const double h = std::pow(2.0, points.integer(-20, 20)), size = points.uniform(0.01, 4),
                 density = points.uniform(0.2, 1), share = round % 4 == 0 ? 0 : points.uniform(0, 0.3);
    std::vector<int> exponent;
    for (int i = 0; i < n; ++i) exponent.push_back(points.integer(-20, 20));
    FlowGrowth growth(n, m);
    std::vector<double> centre(at(n * n)), spread(at(n * n));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double entry = points.uniform(0, 1) < density ? size * points.uniform(-1, 1) : 0.0;
        centre[at(i * n + j)] = std::ldexp(entry / h, exponent[at(i)] - exponent[at(j)]);
        spread[at(i * n + j)] = share * std::fabs(centre[at(i * n + j)]);
        growth.A(i, j) = (std::fabs(centre[at(i * n + j)]) + spread[at(i * n + j)]) * (1 + 0x1p-50);
      }
    growth.setCentre(centre, spread);
    ASSERT_TRUE(growth.compute(h));
    about += growth.isAbout() ? 1 : 0;
    // Backwards from the end: K(h, t_k) and the integrals over the parts before.
    std::vector<Matrix> step, integral;
    for (int k = 0; k < parts; ++k) {
      Matrix J(at(n), Vector(at(n), Precise(0.0)));
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const double side = points.integer(0, 3) == 0 ? points.uniform(-1, 1) : points.integer(0, 1) * 2 - 1;
          J[at(i)][at(j)] =
              (Precise(centre[at(i * n + j)]) + Precise(side) * Precise(spread[at(i * n + j)])) * Precise(h / parts);
        }
      step.push_back(series(J, -1, Precise(1.0)));
      integral.push_back(series(J, 0, Precise(h / parts)));
    }
    Matrix now(at(n), Vector(at(n), Precise(0.0)));
    for (int i = 0; i < n; ++i) now[at(i)][at(i)] = 1;
    Matrix left = now, M1(at(n), Vector(at(n), Precise(0.0))), M2 = M1;
    for (int k = 0; k < parts; ++k) {
      now = step[at(k)] * now;
      const Matrix behind = left * integral[at(parts - 1 - k)];
      const Precise least(pow(Precise(static_cast<double>(parts - 1 - k) / parts), m));
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          ASSERT_GE(Precise(growth.M0(i, j)), abs(now[at(i)][at(j)])) << "at " << k;
          M1[at(i)][at(j)] += abs(behind[at(i)][at(j)]);
          M2[at(i)][at(j)] += abs(behind[at(i)][at(j)]) * least;
        }
      left = left * step[at(parts - 1 - k)];
    }
    // One matrix for all of the step, that grows most: what δ = (t/h)^m does is known to the last digit.
    Matrix most(at(n), Vector(at(n), Precise(0.0)));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double entry = centre[at(i * n + j)], side = entry < 0 ? -1 : 1;
        most[at(i)][at(j)] = (Precise(entry) + Precise(side * spread[at(i * n + j)])) * Precise(h);
      }
    const Matrix driven = series(most, m, Precise(h));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        ASSERT_GE(Precise(growth.M1(i, j)), M1[at(i)][at(j)]);
        ASSERT_GE(Precise(growth.M2(i, j)), M2[at(i)][at(j)]);
        ASSERT_GE(Precise(growth.M2(i, j)), Precise(abs(driven[at(i)][at(j)])));
        if (share == 0 && growth.isAbout() && n == 1) {
          EXPECT_LE(Precise(growth.M1(i, j)), Precise(M1[at(i)][at(j)] * 1.02));
        }
      }
  }
  EXPECT_GT(about, 60);
}

/// Of an oscillator |e^{Zt}| stays below 1 where e^{|Z|t} grows by e^4; no bound of it, or of another length of time,
/// is left over for the next.
TEST(FlowGrowth, KnowsWhatTurnsFromWhatGrows) {
  FlowGrowth growth(2, 20);
  const auto compute = [&](double rate, double h) {
    growth.A(0, 1) = growth.A(1, 0) = rate;
    return growth.compute(h);
  };
  growth.setCentre({0, 4, -4, 0}, {0, 0, 0, 0});
  ASSERT_TRUE(compute(4, 1));
  EXPECT_TRUE(growth.isAbout());
  EXPECT_LT(growth.M0(0, 0), 1.02);
  EXPECT_LT(growth.M1(0, 1), 0.75);  // ∫ |sin 4t| over [0, 1] is 0.67
  EXPECT_LT(growth.growth(), 1);
  ASSERT_TRUE(compute(4, 0.25));
  EXPECT_GT(growth.M0(0, 1), 0.84);  // sin 1
  EXPECT_LT(growth.M0(0, 1), 0.87);
  growth.setCentre({0, 8, -8, 0}, {0, 0, 0, 0});
  ASSERT_TRUE(compute(8, 0.25));
  EXPECT_GT(growth.M0(0, 1), 0.99);
  growth.setCentre({0, 8, -8, 0}, {0, 1, 1, 0});
  ASSERT_TRUE(compute(9, 0.25));
  EXPECT_GT(growth.M0(0, 0), 1.1);
  growth.setCentre({}, {});
  ASSERT_TRUE(compute(4, 1));
  EXPECT_FALSE(growth.isAbout());
  EXPECT_GT(growth.M0(0, 0), 27);  // cosh 4
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
