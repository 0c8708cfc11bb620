// The certificate of polynomial series, judged node by node: at random times and random uncertain quantities, every
// node of a program evaluated in 128 bits along the computed polynomials lies as close to its own polynomial as the
// bounds say.
#include "analyses/polynomial_series.hpp"

#include <gtest/gtest.h>

#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

/// All nodes of a program as outputs, numbered as there.
Program allNodes(const Program& program) {
  std::vector<int> outputs;
  for (int i = 0; i < static_cast<int>(program.nodes().size()); ++i) outputs.push_back(i);
  return Recorder(program).finish(outputs);
}

/// Nodes that keep the full degree: inputs, and what the first outputs need (a sine and its cosine alike).
std::vector<char> fullDegree(const Program& program, int outputs) {
  std::vector<char> full(program.nodes().size(), 0);
  for (int i = 0; i < outputs; ++i)
    full[static_cast<std::size_t>(program.outputNodes()[static_cast<std::size_t>(i)])] = 1;
  for (std::size_t i = full.size(); i-- > 0;) {
    const Node& v = program.nodes()[i];
    if (v.op <= Op::constant) {
      full[i] = 1;
      continue;
    }
    if (v.op == Op::cos && full[i]) full[i - 1] = 1;
    if (v.op == Op::sin && full[i]) full[i + 1] = 1;
    if (!full[i]) continue;
    full[static_cast<std::size_t>(v.a)] = 1;
    if (v.b >= 0) full[static_cast<std::size_t>(v.b)] = 1;
  }
  return full;
}

struct Setting {
  int states = 2, parameters = 1;
  std::vector<int> weights{1, 1};
  int degree = 3, frameDegree = 1, order = 6;
  double size = 0.1;    // of the coefficients that are not constant
  double theta = 0.25;  // length of the step
  bool thinStates = false;
  double rounded = 1;  // values as large as this have the reference's own rounding in them
};

/// A program's series with random starting polynomials, and the truth along it.
class Certificate {
 public:
  /// `program`: the derivatives, then what stands for their Jacobian.
  Certificate(const Program& program, const Setting& s, Points& points, const std::vector<double>& nominal)
      : s_(s),
        points_(points),
        program_(program),
        everything_(allNodes(program_)),
        full_(fullDegree(program_, s.states)),
        monomials_(std::make_shared<const Monomials>(s.weights, s.degree)),
        series_(program_, s.states, monomials_, s.frameDegree, s.order, true),
        evaluator_(everything_) {
    const int N = monomials_->count();
    for (int i = 0; i < s.states; ++i) {
      states_.push_back(randomPolynomial(nominal[static_cast<std::size_t>(i)], N));
      if (s.thinStates) std::fill(states_.back().begin() + 1, states_.back().end(), 0.0);
      series_.setState(i, states_.back().data());
    }
    for (int i = 0; i < s.parameters; ++i) {
      parameters_.push_back(randomPolynomial(nominal[static_cast<std::size_t>(s.states + i)], N));
      radius_.push_back(points.integer(0, 1) * s.size * 1e-3);
      series_.setParameter(i, parameters_.back().data(), radius_.back());
    }
    for (int i = 0; i < s.states; ++i)
      for (int j = 0; j < s.states; ++j)
        series_.setFrame(i, j, randomPolynomial(i == j ? 1.0 : 0.2, series_.frameCount()).data(), 1);
    series_.compute(t0_, 1.0);
  }

  PolynomialSeries& series() { return series_; }
  const Program& program() const { return program_; }

  /// Checks every node at random places, for states within E of their polynomials (null: on them).
  void check(const std::vector<double>& E, int places) {
    const int n = s_.states;
    for (int place = 0; place < places; ++place) {
      const double sigma = points_.integer(0, 3) == 0 ? s_.theta : points_.uniform(0, s_.theta);
      const Precise fraction = pow(Precise(sigma) / Precise(s_.theta), s_.order);
      const std::vector<Precise> powers = monomialValues();
      Vector x, p;
      for (int i = 0; i < n; ++i)
        x.push_back(value(series_.series(i), sigma, powers, monomials_->count(), s_.order) +
                    (E.empty() ? 0.0 : E[static_cast<std::size_t>(i)] * points_.signedUnit()));
      for (std::size_t i = 0; i < parameters_.size(); ++i) {
        Precise sum = Precise(radius_[i]) * points_.signedUnit();
        for (std::size_t g = 0; g < powers.size(); ++g) sum += parameters_[i][g] * powers[g];
        p.push_back(sum);
      }
      evaluator_.setParameters(p);
      const Vector truth = evaluator_(Precise(t0_) + Precise(sigma), x);
      for (int node = 0; node < static_cast<int>(truth.size()); ++node) {
        const int count = full_[static_cast<std::size_t>(node)] ? monomials_->count() : series_.frameCount();
        const Precise computed = value(series_.series(node), sigma, powers, count, s_.order - 1);
        const Precise error = beyondRounding(truth[static_cast<std::size_t>(node)] - computed, computed);
        const Precise bound = Precise(series_.rho0(node)) + Precise(series_.rho1(node)) * fraction;
        ASSERT_LE(error, bound) << "node " << node << " at " << sigma << " of\n" << program_;
      }
      checkFrame(truth, sigma, fraction, powers);
    }
  }

 private:
  /// |difference| without what 128 bits themselves may have rounded.
  Precise beyondRounding(const Precise& difference, const Precise& size) const {
    return abs(difference) - (abs(size) + s_.rounded) * Precise(1e-34);
  }

  void checkFrame(const Vector& truth, double sigma, const Precise& fraction, const std::vector<Precise>& powers) {
    const int n = s_.states, count = series_.frameCount();
    const auto jacobian = [&](int i, int k) {
      return truth[static_cast<std::size_t>(program_.outputNodes()[static_cast<std::size_t>(n + i * n + k)])];
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        ASSERT_LE(beyondRounding(jacobian(i, j), jacobian(i, j)), Precise(series_.jacobianBound(i, j)));
        Precise defect(0.0);
        for (int g = 0; g < count; ++g) {
          Precise rate(0.0);
          for (int order = s_.order; order >= 1; --order)
            rate = rate * sigma + Precise(order) * series_.frame(i, j)[g * series_.stride() + order];
          defect += rate * powers[static_cast<std::size_t>(g)];
        }
        for (int k = 0; k < n; ++k)
          defect -= jacobian(i, k) * value(series_.frame(k, j), sigma, powers, count, s_.order);
        double nu0 = 0, nu1 = 0;
        series_.frameDefect(i, j, nu0, nu1);
        ASSERT_LE(beyondRounding(defect, Precise(1.0)), Precise(nu0) + Precise(nu1) * fraction)
            << "frame " << i << ' ' << j;
      }
  }

  std::vector<double> randomPolynomial(double constant, int count) {
    std::vector<double> c{constant};
    while (static_cast<int>(c.size()) < count)
      c.push_back(s_.size * std::ldexp(points_.uniform(-1, 1), -monomials_->grade(static_cast<int>(c.size()))));
    return c;
  }

  std::vector<Precise> monomialValues() {
    std::vector<double> xi;
    const bool corner = points_.integer(0, 2) == 0;
    for (int l = 0; l < monomials_->symbols(); ++l) xi.push_back(corner ? 1.0 : points_.signedUnit());
    std::vector<Precise> powers;
    for (int g = 0; g < monomials_->count(); ++g) {
      Precise product(1.0);
      for (int l = 0; l < monomials_->symbols(); ++l)
        product *= pow(Precise(xi[static_cast<std::size_t>(l)]), monomials_->exponent(g, l));
      powers.push_back(product);
    }
    return powers;
  }

  Precise value(const double* c, double sigma, const std::vector<Precise>& powers, int count, int orders) const {
    Precise sum(0.0);
    for (int g = 0; g < count; ++g) {
      Precise row(0.0);
      for (int i = orders; i >= 0; --i) row = row * sigma + c[g * series_.stride() + i];
      sum += row * powers[static_cast<std::size_t>(g)];
    }
    return sum;
  }

  static constexpr double t0_ = 0.5;
  Setting s_;
  Points& points_;
  Program program_, everything_;
  std::vector<char> full_;
  std::shared_ptr<const Monomials> monomials_;
  PolynomialSeries series_;
  Evaluator<Precise> evaluator_;
  std::vector<std::vector<double>> states_, parameters_;
  std::vector<double> radius_;
};

void expectCertified(const Program& f, const Setting& s, Points& points, const std::vector<double>& nominal,
                     int places) {
  Certificate certificate(f, s, points, nominal);
  ASSERT_TRUE(certificate.series().tabulate(s.theta)) << f;
  ASSERT_TRUE(certificate.series().bound(nullptr, false)) << f;
  certificate.check({}, places);
  const std::vector<double> E(static_cast<std::size_t>(s.states), s.size * 0.1);
  ASSERT_TRUE(certificate.series().bound(E.data(), false)) << f;
  certificate.check(E, places);
}

Setting randomSetting(Points& points) {
  Setting s;
  const int symbols = points.integer(0, 3);
  s.weights.clear();
  for (int l = 0; l < symbols; ++l) s.weights.push_back(points.integer(0, 3) == 0 ? 2 : 1);
  s.degree = symbols == 0 ? 0 : points.integer(1, symbols == 1 ? 8 : 4);
  s.frameDegree = points.integer(0, s.degree);
  s.order = points.integer(0, 3) == 0 ? points.integer(12, 24) : points.integer(4, 9);
  // From coefficients whose truncation swamps rounding to such where there is hardly anything but rounding.
  s.size = std::ldexp(0.2, -points.integer(0, 2) * 12);
  s.theta = std::ldexp(1.0, -points.integer(1, 2) * (1 + points.integer(0, 3)));
  return s;
}

class OfFunction : public ::testing::TestWithParam<std::string> {};

TEST_P(OfFunction, EveryNodeLiesWithinItsBounds) {
  Points points(7);
  for (int round = 0; round < 12; ++round) {
    const Setting s = randomSetting(points);
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    const Program f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
      const Guarded first{x[0], nominal[0]}, second{x[1] + t, nominal[1]};
      dx[0] = 0.5 * apply(GetParam(), first, second).value + p[0];
      dx[1] = 0.25 * apply(GetParam(), second, {p[0], nominal[2]}).value - x[0];
    });
    expectCertified(f.differentiated(), s, points, nominal, 4);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(PolynomialSeries, OfFunction, ::testing::ValuesIn(elementaryNames()),
                         [](const auto& name) { return name.param; });

/// Elementary functions of a state itself: no error of an operand hides what the function's own bound lacks.
const std::vector<std::pair<std::string, Recorded (*)(const Recorded&)>>& bareFunctions() {
  static const std::vector<std::pair<std::string, Recorded (*)(const Recorded&)>> functions = {
      {"square", [](const Recorded& x) { return sqr(x); }},
      {"reciprocal", [](const Recorded& x) { return 1.0 / x; }},
      {"squareRoot", [](const Recorded& x) { return sqrt(x); }},
      {"exponential", [](const Recorded& x) { return exp(x); }},
      {"logarithm", [](const Recorded& x) { return log(x); }},
      {"sine", [](const Recorded& x) { return sin(x); }},
      {"cosine", [](const Recorded& x) { return cos(x); }},
      {"arcTangent", [](const Recorded& x) { return atan(x); }}};
  return functions;
}

class OfBareFunction : public ::testing::TestWithParam<std::pair<std::string, Recorded (*)(const Recorded&)>> {};

/// What dominates a bound: truncation in time, in the uncertain quantities, or nothing but rounding.
enum class Regime { time, quantities, rounding };

Setting settingOf(Regime regime, Points& points) {
  Setting s;
  s.parameters = 1;
  const int symbols = regime == Regime::time ? points.integer(0, 1) : points.integer(0, 2);
  s.weights.assign(static_cast<std::size_t>(symbols), 1);
  s.degree = symbols == 0 ? 0 : regime == Regime::quantities ? points.integer(1, 3) : 4;
  s.frameDegree = points.integer(0, s.degree);
  s.order = regime == Regime::time ? points.integer(4, 7) : 24;
  s.size = regime == Regime::quantities ? 0.06 : 0x1p-20;
  s.theta = regime == Regime::time ? 0.125 : regime == Regime::quantities ? 0.125 : 0x1p-5;
  return s;
}

TEST_P(OfBareFunction, EveryNodeLiesWithinItsBounds) {
  Points points(13);
  for (const Regime regime : {Regime::time, Regime::quantities, Regime::rounding})
    for (int round = 0; round < 25; ++round) {
      const std::vector<double> nominal{points.uniform(0.8, 2), points.uniform(0.8, 2), points.uniform(0.8, 2)};
      // The function of a state, of a parameter, of time; then, with no more than the frame's degree, of each again.
      const Program program = record(2, 1, 6, [&](auto t, const auto& x, const auto& p, auto& y) {
        const auto function = GetParam().second;
        y[0] = function(x[0]);
        y[1] = x[0] * function(p[0]) + function(t);
        y[2] = function(x[1]);
        y[3] = -function(x[0]);
        y[4] = -x[1] * p[0];
        y[5] = x[0] - p[0] * function(x[1]);
      });
      expectCertified(program, settingOf(regime, points), points, nominal, 4);
      if (HasFatalFailure()) return;
    }
}

TEST_P(OfBareFunction, RoundingOfHighOrdersIsBounded) {
  Points points(14);
  Setting s;
  s.weights = {};
  s.degree = s.frameDegree = 0;
  s.order = 30;
  s.size = 0x1p-40;
  s.parameters = 0;
  for (int round = 0; round < 60; ++round) {
    const bool entire = GetParam().first.find("ine") != std::string::npos || GetParam().first == "exponential";
    s.theta = entire ? 0.5 : 0x1p-5;  // the series converge everywhere, or as far as the nearest singularity
    const double speed = points.uniform(3, 4);
    const Program program = record(2, 0, 6, [&](auto, const auto& x, const auto&, auto& y) {
      y[0] = speed;
      y[1] = GetParam().second(x[0]);
      y[2] = y[3] = y[4] = y[5] = 0.0;
    });
    expectCertified(program, s, points, {points.uniform(0.8, 2), 0.5}, 3);
    if (HasFatalFailure()) return;
  }
}

TEST_P(OfBareFunction, TruncationThatComesWithTimeIsBounded) {
  Points points(15);
  Setting s;
  s.weights = {1};
  s.order = 24;
  s.size = 0.5;
  s.theta = 0.125;
  s.thinStates = true;  // only the rate is uncertain
  for (int round = 0; round < 30; ++round) {
    s.degree = s.frameDegree = points.integer(1, 2);
    const Program program = record(2, 1, 6, [&](auto, const auto& x, const auto& p, auto& y) {
      y[0] = p[0];
      y[1] = GetParam().second(x[0]);
      y[2] = y[3] = y[4] = y[5] = 0.0;
    });
    expectCertified(program, s, points, {points.uniform(0.8, 2), 0.5, points.uniform(-0.5, 0.5)}, 4);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(PolynomialSeries, OfBareFunction, ::testing::ValuesIn(bareFunctions()),
                         [](const auto& function) { return function.param.first; });

TEST(PolynomialSeries, ArcTangentsAroundZeroLieWithinTheirBounds) {
  Points points(16);
  for (int round = 0; round < 30; ++round) {
    Setting s;
    s.weights = {1};
    s.degree = s.frameDegree = 1;  // 1 + u² is 1 to this degree
    s.order = 20;
    s.size = 0.1;
    s.theta = 0x1p-6;
    const Program program = record(2, 1, 6, [&](auto, const auto& x, const auto& p, auto& y) {
      y[0] = atan(x[0]);
      y[1] = atan(p[0]);
      y[2] = y[3] = y[4] = y[5] = 0.0;
    });
    expectCertified(program, s, points, {0, 0, 0}, 4);
    if (HasFatalFailure()) return;
  }
}

TEST(PolynomialSeries, UnderflowIsBounded) {
  Points points(18);
  Setting s;
  s.parameters = 0;
  s.order = 6;
  s.size = 1e-310;
  s.rounded = 0;
  for (int round = 0; round < 20; ++round) {
    const Program program = record(2, 0, 6, [&](auto, const auto& x, const auto&, auto& y) {
      y[0] = 0.3 * x[0];
      y[1] = x[0] * x[1];
      y[2] = sqr(x[1]);
      y[3] = y[4] = y[5] = 0.0;
    });
    expectCertified(program, s, points, {points.uniform(1e-310, 9e-310), points.uniform(1e-170, 9e-160)}, 3);
    if (HasFatalFailure()) return;
  }
}

TEST(PolynomialSeries, NodesOfTheFramesDegreeLieWithinTheirBoundsWhateverTheyStandFor) {
  Points points(19);
  for (int round = 0; round < 60; ++round) {
    Setting s = settingOf(static_cast<Regime>(round % 3), points);
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    RandomExpressions expression(points, nominal);
    const Program program = record(2, 1, 6, [&](auto t, const auto& x, const auto& p, auto& y) {
      std::vector<Recorded> rates(2), frame(4);
      expression(t, x, p, rates, 3);
      expression(t, x, p, frame, 6);
      std::copy(rates.begin(), rates.end(), y.begin());
      std::copy(frame.begin(), frame.end(), y.begin() + 2);
    });
    expectCertified(program, s, points, nominal, 3);
    if (HasFatalFailure()) return;
  }
}

TEST(PolynomialSeries, RandomProgramsLieWithinTheirBounds) {
  Points points(11);
  for (int round = 0; round < 60; ++round) {
    const Setting s = randomSetting(points);
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    RandomExpressions expression(points, nominal);
    const Program f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) { expression(t, x, p, dx, 6); });
    expectCertified(f.differentiated(), s, points, nominal, 3);
    if (HasFatalFailure()) return;
  }
}

// With all coefficients positive, at ξ = 1 and σ = θ, what a product drops is exactly what its bound adds up.
TEST(PolynomialSeries, DroppedTermsOfPositiveProductsAreBoundedSharply) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = sqr(x[0]) * x[0]; });
  for (int order : {4, 8})
    for (int degree : {1, 3}) {
      const Program g = f.differentiated();
      const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1}, degree);
      PolynomialSeries series(g, 1, monomials, degree, order, true);
      std::vector<double> c(static_cast<std::size_t>(monomials->count()), 0.25);
      series.setState(0, c.data());
      series.setFrame(0, 0, c.data(), 1);
      series.compute(0, 1);
      ASSERT_TRUE(series.tabulate(0.5) && series.bound(nullptr, false));
      const int node = series.outputNode(0);
      Precise x(0.0), kept(0.0);
      for (int m = 0; m < monomials->count(); ++m)
        for (int i = 0; i <= order; ++i) {
          x += Precise(series.series(0)[m * series.stride() + i]) * pow(Precise(0.5), i);
          if (i < order) kept += Precise(series.series(node)[m * series.stride() + i]) * pow(Precise(0.5), i);
        }
      const Precise error = x * x * x - kept, bound = Precise(series.rho0(node)) + series.rho1(node);
      EXPECT_LE(error, bound);
      EXPECT_LT(bound, error * (1 + 1e-6));
    }
}

TEST(PolynomialSeries, ADivisorThatMayVanishIsNotProved) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = 1.0 / x[0]; });
  const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1}, 4);
  PolynomialSeries series(f.differentiated(), 1, monomials, 1, 6, true);
  const std::vector<double> through{0.5, 0.6, 0, 0, 0}, frame{1.0, 0.0};
  series.setState(0, through.data());
  series.setFrame(0, 0, frame.data(), 1);
  series.compute(0, 1);
  EXPECT_FALSE(series.tabulate(0x1p-20) && series.bound(nullptr, false));
}

TEST(PolynomialSeries, SquareRootsAndLogarithmsOfWhatMayBeNegativeAreNotProved) {
  for (const bool root : {true, false}) {
    const Program f =
        record(1, 0, [&](auto, const auto& x, const auto&, auto& dx) { dx[0] = root ? sqrt(x[0]) : log(x[0]); });
    const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1}, 4);
    PolynomialSeries series(f.differentiated(), 1, monomials, 1, 6, true);
    const std::vector<double> through{0.5, 0.6, 0, 0, 0}, frame{1.0, 0.0};
    series.setState(0, through.data());
    series.setFrame(0, 0, frame.data(), 1);
    series.compute(0, 1);
    EXPECT_FALSE(series.tabulate(0x1p-20) && series.bound(nullptr, false));
  }
}

}  // namespace
}  // namespace gamut::testing
