// Solutions of linear systems in polynomial series, judged by their certificates.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "scalars/algebra/linear_system.hpp"
#include "tests/analyses/flow/series/certificate.hpp"

namespace gamut::testing {
namespace {

enum class Kind { general, transposed, positiveDefinite };

/// A system that varies with everything: entries about those of a dominant diagonal, rows and columns in units of their
/// own, some known zeros, an entry that is a number and one that is a parameter.
struct RandomSystem {
  RandomSystem(Points& points, Kind kindOf) : kind(kindOf), size(points.integer(3, 6)) {
    for (int i = 0; i < size; ++i) {
      row.push_back(i == 0 ? 1.0 : std::ldexp(1.0, points.integer(-6, 6)));
      column.push_back(kind == Kind::positiveDefinite || i == 0 ? row.back() : std::ldexp(1.0, points.integer(-6, 6)));
      right.push_back(points.uniform(-1, 1));
    }
    for (int i = 0; i < size * size; ++i) {
      entry.push_back(points.uniform(-0.2, 0.2));
      use.push_back(points.integer(0, 4));
    }
  }

  /// The solution's components, in units of one, for entries and right-hand sides that depend on a, b and c.
  std::vector<Recorded> operator()(const Recorded& a, const Recorded& b, const Recorded& c) const {
    std::vector<int> nodes;
    const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * size + j); };
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) {
        if (kind == Kind::positiveDefinite && j < i) {
          nodes.push_back(nodes[at(j, i)]);
          continue;
        }
        const double e = entry[at(i, j)];
        const Recorded varying[] = {Recorded(0.0), Recorded(e), e * a, e * sin(b), e * (a * c)};
        const Recorded value = i == j ? 3.0 + e * b : varying[use[at(i, j)]];
        nodes.push_back((row[static_cast<std::size_t>(i)] * column[static_cast<std::size_t>(j)] * value).node());
      }
    std::vector<int> r;
    for (int i = 0; i < size; ++i) {
      if (i == 0) {  // as it is: the right-hand side keeps more than the solution does
        r.push_back(c.node());
        continue;
      }
      const double e = right[static_cast<std::size_t>(i)];
      r.push_back((left()[static_cast<std::size_t>(i)] * (i % 2 == 0 ? e * c : e + sqr(a))).node());
    }
    Recorder& recorder = *Recorder::current();
    const int matrix = recorder.matrix(
        {kind == Kind::positiveDefinite ? MatrixKind::positiveDefinite : MatrixKind::general, size, std::move(nodes)});
    std::vector<Recorded> x;
    for (int node : recorder.solve(matrix, kind == Kind::transposed, r))
      x.push_back(above()[x.size()] * Recorded::node(node));
    return x;
  }

  /// The units of equations, and the inverse ones of unknowns.
  const std::vector<double>& left() const { return kind == Kind::transposed ? column : row; }
  const std::vector<double>& above() const { return kind == Kind::transposed ? row : column; }

  Kind kind;
  int size;
  std::vector<double> row, column, right, entry;
  std::vector<int> use;
};

class OfSystem : public ::testing::TestWithParam<Kind> {};

TEST_P(OfSystem, EveryNodeLiesWithinItsBounds) {
  Points points(21);
  for (const Regime regime : {Regime::time, Regime::quantities, Regime::rounding, Regime::fine})
    for (int round = 0; round < 12; ++round) {
      const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
      const RandomSystem system(points, GetParam()), other(points, GetParam());
      const Program program = record(2, 1, 6, [&](auto t, const auto& x, const auto& p, auto& y) {
        const auto full = system(x[0], x[1] + t, p[0]), low = other(x[1], p[0], x[0]);
        y[0] = full[0];
        y[1] = full[1] + full[2];
        for (std::size_t i = 0; i < 3; ++i) y[2 + i] = low[i];
        y[5] = -full[0];
      });
      Setting s = settingOf(regime, points);
      s.rounded = 1e4;  // units: components and residuals of the reference's elimination
      expectCertified(program, s, points, nominal, 4);
      if (HasFatalFailure()) return;
    }
}

/// A motion along the solution of a random system.
void expectJacobianCertified(Kind kind, Points& points, Setting s, int places) {
  const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
  const RandomSystem system(points, kind);
  const Program f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
    const auto solution = system(x[0], x[1] + t, p[0]);
    dx[0] = solution[0];
    dx[1] = solution[1] - x[0];
  });
  s.theta = std::min(s.theta, 0.125);
  s.rounded = 1e4;
  expectCertified(f.differentiated(), s, points, nominal, places);
}

TEST_P(OfSystem, ItsJacobianLiesWithinItsBounds) {
  Points points(22);
  for (int round = 0; round < 12 && !HasFatalFailure(); ++round) {
    Setting s = randomSetting(points);
    s.size = std::min(s.size, 0.05);
    expectJacobianCertified(GetParam(), points, s, 4);
  }
}

TEST_P(OfSystem, ManySymbolsAreBounded) {
  Points points(23);
  for (int round = 0; round < 3 && !HasFatalFailure(); ++round) {
    Setting s = settingOfMany(points);
    s.size = std::min(s.size, 0.02);
    expectJacobianCertified(GetParam(), points, s, 3);
  }
}

TEST_P(OfSystem, ManySymbolsAtOneTimeAreBounded) {
  Points points(25);
  for (int round = 0; round < 6 && !HasFatalFailure(); ++round) {
    Setting s = settingAtOneTime(points);
    s.size = std::min(s.size, 0.02);
    expectJacobianCertified(GetParam(), points, s, 3);
  }
}

INSTANTIATE_TEST_SUITE_P(PolynomialSeries, OfSystem,
                         ::testing::Values(Kind::general, Kind::transposed, Kind::positiveDefinite),
                         [](const auto& kind) {
                           return kind.param == Kind::general      ? "general"
                                  : kind.param == Kind::transposed ? "transposed"
                                                                   : "positiveDefinite";
                         });

/// x0 on the diagonal: singular where it is zero.
PolynomialSeries diagonal(double centre, double half) {
  const Program program = record(1, 0, 2, [](auto, const auto& x, const auto&, auto& y) {
    std::vector<Recorded> entries(9), r{1.0, 2.0, 3.0};
    for (std::size_t i = 0; i < 9; ++i) entries[i] = i % 4 == 0 ? x[0] : 0.125 * x[0];
    std::vector<int> nodes, right;
    for (const Recorded& e : entries) nodes.push_back(e.node());
    for (const Recorded& e : r) right.push_back(e.node());
    Recorder& recorder = *Recorder::current();
    const auto solution = recorder.solve(recorder.matrix({MatrixKind::general, 3, nodes}), false, right);
    y[0] = Recorded::node(solution[0]);
    y[1] = 0.0;
  });
  PolynomialSeries series(program, 1, std::make_shared<const Monomials>(std::vector<int>{1}, 2), 1, 4, true);
  const std::vector<double> state{centre, half, 0}, frame{1, 0};
  series.setState(0, state.data());
  series.setFrame(0, 0, frame.data(), 1);
  series.compute(0, 0x1p-10);
  return series;
}

TEST(PolynomialSystems, AreProvedRegularUpToWhereTheyMayBeSingular) {
  for (const auto& [half, isProved] : {std::pair(0.3, true), {0.6, true}, {1.0, false}, {2.0, false}}) {
    PolynomialSeries series = diagonal(1, half);
    EXPECT_EQ(series.tabulate(0x1p-10) && series.bound(nullptr, false), isProved) << half;
  }
  PolynomialSeries singular = diagonal(0, 0);
  EXPECT_FALSE(singular.tabulate(0x1p-10) && singular.bound(nullptr, false));
}

/// (1 + q(ξ)) x = 1 with a polynomial q of degree 4.
PolynomialSeries reciprocalOf(const std::vector<double>& q) {
  const Program program = record(1, 1, 2, [](auto, const auto& x, const auto& p, auto& y) {
    const Recorded entry = 1.0 + p[0], one = 1.0 + 0.0 * x[0];
    Recorder& recorder = *Recorder::current();
    const int matrix = recorder.matrix({MatrixKind::general, 1, {entry.node()}});
    y[0] = Recorded::node(recorder.solve(matrix, false, {one.node()})[0]);
    y[1] = 0.0;
  });
  PolynomialSeries series(program, 1, std::make_shared<const Monomials>(std::vector<int>{1}, 4), 1, 4, true);
  const std::vector<double> state{1, 0, 0, 0, 0}, frame{1, 0};
  series.setState(0, state.data());
  series.setParameter(0, q.data(), 0.0);
  series.setFrame(0, 0, frame.data(), 1);
  series.compute(0, 0x1p-4);
  return series;
}

// (1 + c ξ⁴) x = 1: the fourth grade is not multiplied by the inverse, and counts all the same. The series is 1 - c ξ⁴;
// for c < 0 it is off by c²/(1 + c) at ξ = 1, more than the c² that its residual is.
TEST(PolynomialSystems, GradesThatAreNotMultipliedCount) {
  const double c = -0x1p-14;
  PolynomialSeries series = reciprocalOf({0, 0, 0, 0, c});
  for (const double theta : {0x1p-4, 1.0}) {
    ASSERT_TRUE(series.tabulate(theta) && series.bound(nullptr, false));
    const double* x = series.series(series.outputNode(0));
    EXPECT_EQ(x[4 * series.stride()], -c);
    const Interval truth = 1.0 / (1.0 + Interval(c)), bound(series.rho0(series.outputNode(0)));
    EXPECT_GE(bound.upper(), (truth - (1.0 - Interval(c))).upper());
  }
}

// (1 - a ξ - c ξᵏ) x = 1 with a, c > 0: what the term of the inverse that is linear in ξ makes of ξᵏ counts whether it
// is multiplied, is negligible or leaves the monomials. All that bounds add up is positive at ξ = 1, so that they are
// no more than the error there.
TEST(PolynomialSystems, GradesThatALinearTermIsNotMultipliedWithCount) {
  constexpr double a = 0.125;
  for (const std::size_t k : {2, 3, 4})
    for (const double c : {0x1p-4, 0x1p-9, 0x1p-14}) {
      SCOPED_TRACE(::testing::Message() << c << " of power " << k);
      std::vector<double> q{0, -a, 0, 0, 0};
      q[k] = -c;
      PolynomialSeries series = reciprocalOf(q);
      ASSERT_TRUE(series.tabulate(0x1p-4) && series.bound(nullptr, false));
      const int x = series.outputNode(0);
      Interval error = 1.0 / (1.0 - Interval(a) - Interval(c));
      for (int g = 0; g <= 4; ++g) error -= Interval(series.series(x)[g * series.stride()]);
      EXPECT_GE(series.rho0(x), error.upper());
      EXPECT_LE(series.rho0(x), (1 + 1e-7) * error.upper());
    }
}

// (1 + 0.9 sin 3t) x = 1: powers of time that are negligible in a short step are not in a longer one of the same
// series.
TEST(PolynomialSystems, AreProvedInALongStepAfterAShortOne) {
  const Program program = record(1, 0, 2, [](auto t, const auto&, const auto&, auto& y) {
    const Recorded entry = 1.0 + 0.9 * sin(3.0 * t), one = 1.0;
    Recorder& recorder = *Recorder::current();
    y[0] = Recorded::node(
        recorder.solve(recorder.matrix({MatrixKind::general, 1, {entry.node()}}), false, {one.node()})[0]);
    y[1] = 0.0;
  });
  const auto errorOf = [&](const std::vector<double>& lengths) {
    PolynomialSeries series(program, 1, std::make_shared<const Monomials>(std::vector<int>{1}, 1), 1, 12, true);
    const std::vector<double> state{0, 0}, frame{1, 0};
    series.setState(0, state.data());
    series.setFrame(0, 0, frame.data(), 1);
    series.compute(0, 1);
    for (const double theta : lengths) EXPECT_TRUE(series.tabulate(theta) && series.bound(nullptr, false)) << theta;
    return series.rho0(series.outputNode(0)) + series.rho1(series.outputNode(0));
  };
  EXPECT_LE(errorOf({0x1p-20, 0.25}), 1.01 * errorOf({0.25}));
}

}  // namespace
}  // namespace gamut::testing
