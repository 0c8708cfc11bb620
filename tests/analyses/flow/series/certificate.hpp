// The certificate of polynomial series, judged node by node: at random times and random uncertain quantities, every
// node of a program evaluated in 128 bits along the computed polynomials lies as close to its own polynomial as the
// bounds say.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "analyses/flow/series/polynomial_series.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {

/// All nodes of a program as outputs, numbered as there.
inline Program allNodes(const Program& program) {
  std::vector<int> outputs;
  for (int i = 0; i < static_cast<int>(program.nodes().size()); ++i) outputs.push_back(i);
  return Recorder(program).finish(outputs);
}

/// Nodes that keep the full degree: inputs, and what the first outputs need (twins alike).
inline std::vector<char> fullDegree(const Program& program, int outputs) {
  std::vector<char> full(program.nodes().size(), 0);
  for (int i = 0; i < outputs; ++i)
    full[static_cast<std::size_t>(program.outputNodes()[static_cast<std::size_t>(i)])] = 1;
  for (int i = static_cast<int>(full.size()) - 1; i >= 0; --i) {
    const auto mark = [&](int node) { full[static_cast<std::size_t>(node)] = 1; };
    if (program.nodes()[static_cast<std::size_t>(i)].op <= Op::constant) mark(i);
    if (full[static_cast<std::size_t>(i)] == 0) continue;
    detail::forEachTwin(program.table(), i, mark);
    detail::forEachOperand(program.table(), i, mark);
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
  bool isAtOneTime = false;  // order 1, no frame
  int fineOrders = 0;        // in double-double
  double rounded = 1;        // values as large as this have the reference's own rounding in them
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
        series_(program_, s.states, monomials_, s.frameDegree, s.order, !s.isAtOneTime),
        evaluator_(everything_) {
    const int N = monomials_->count();
    series_.keepEveryNode();
    if (s.fineOrders > 0 && FineRecursion::isPossible(program_.nodes())) series_.setFineOrders(s.fineOrders);
    for (int i = 0; i < s.states; ++i) {
      states_.push_back(randomPolynomial(nominal[static_cast<std::size_t>(i)], N));
      if (s.thinStates) std::fill(states_.back().begin() + 1, states_.back().end(), 0.0);
      series_.setState(i, states_.back().data());
      if (series_.isFine()) series_.setStateLow(i, states_.back()[0] * points_.uniform(-0x1p-54, 0x1p-54));
    }
    for (int i = 0; i < s.parameters; ++i) {
      parameters_.push_back(randomPolynomial(nominal[static_cast<std::size_t>(s.states + i)], N));
      radius_.push_back(points.integer(0, 1) * s.size * 1e-3);
      series_.setParameter(i, parameters_.back().data(), radius_.back());
      if (series_.isFine()) {
        const double low = parameters_.back()[0] * points_.uniform(-0x1p-54, 0x1p-54);
        const Embedded known{parameters_.back()[0], 0, radius_.back(), -1, low};
        parameterLow_.push_back(known.low);
        series_.setParameter(i, known);
      }
    }
    for (int i = 0; i < s.states && !s.isAtOneTime; ++i)
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
      const double sigma = s_.isAtOneTime ? 0.0 : points_.integer(0, 3) == 0 ? s_.theta : points_.uniform(0, s_.theta);
      const int ofStates = s_.isAtOneTime ? 0 : s_.order;
      const Precise fraction = pow(Precise(sigma) / Precise(s_.theta), s_.order);
      const std::vector<Precise> powers = monomialValues();
      Vector x, p;
      for (int i = 0; i < n; ++i)
        x.push_back(value(series_.series(i), sigma, powers, monomials_->count(), ofStates) + low(i, sigma) +
                    (E.empty() ? 0.0 : E[static_cast<std::size_t>(i)] * points_.signedUnit()));
      for (std::size_t i = 0; i < parameters_.size(); ++i) {
        Precise sum = Precise(radius_[i]) * points_.signedUnit();
        for (std::size_t g = 0; g < powers.size(); ++g) sum += parameters_[i][g] * powers[g];
        if (series_.isFine()) sum += parameterLow_[i];
        p.push_back(sum);
      }
      evaluator_.setParameters(p);
      const Vector truth = evaluator_(Precise(t0_) + Precise(sigma), x);
      for (int node = 0; node < static_cast<int>(truth.size()); ++node) {
        const int count = full_[static_cast<std::size_t>(node)] ? monomials_->count() : series_.frameCount();
        Precise computed = value(series_.series(node), sigma, powers, count, s_.order - 1);
        if (full_[static_cast<std::size_t>(node)]) computed += low(node, sigma);
        const Precise error = beyondRounding(truth[static_cast<std::size_t>(node)] - computed, computed);
        const Precise bound = Precise(series_.rho0(node)) + Precise(series_.rho1(node)) * fraction;
        ASSERT_LE(error, bound) << "node " << node << " at " << sigma << " of\n" << program_;
      }
      if (s_.isAtOneTime) continue;
      if (E.empty()) checkSlopes(truth, sigma, fraction, powers);
      checkFrame(truth, sigma, fraction, powers);
    }
  }

 private:
  /// |difference| without what 128 bits themselves may have rounded.
  Precise beyondRounding(const Precise& difference, const Precise& size) const {
    return abs(difference) - (abs(size) + s_.rounded) * Precise(1e-34);
  }

  /// The polynomials of states move as f says, but for the bound of f's node and a rounding.
  void checkSlopes(const Vector& truth, double sigma, const Precise& fraction, const std::vector<Precise>& powers) {
    for (int s = 0; s < s_.states; ++s) {
      const int f = program_.outputNodes()[static_cast<std::size_t>(s)];
      Precise slope(0.0);
      for (std::size_t g = 0; g < powers.size(); ++g) {
        Precise rate(0.0);
        for (int i = s_.order; i >= 1; --i)
          rate = rate * sigma + Precise(i) * (series_.series(s)[static_cast<int>(g) * series_.stride() + i] +
                                              (g == 0 ? Precise(series_.low(s, i)) : Precise(0.0)));
        slope += rate * powers[g];
      }
      const Precise& wanted = truth[static_cast<std::size_t>(f)];
      const Precise bound = Precise(series_.rho0(f)) + series_.slopeRounding(s) + Precise(series_.rho1(f)) * fraction;
      ASSERT_LE(beyondRounding(slope - wanted, wanted), bound) << "slope of state " << s << " of\n" << program_;
    }
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
        const SeriesError nu = series_.frameDefect(i, j);
        ASSERT_LE(beyondRounding(defect, Precise(1.0)), Precise(nu.e0) + Precise(nu.e1) * fraction)
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

  /// What second doubles hold.
  Precise low(int node, double sigma) const {
    Precise sum(0.0);
    for (int i = s_.fineOrders - 1; i >= 0 && series_.isFine(); --i) sum = sum * sigma + series_.low(node, i);
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
  std::vector<double> radius_, parameterLow_;
};

inline void expectCertified(const Program& f, const Setting& s, Points& points, const std::vector<double>& nominal,
                            int places) {
  Certificate certificate(f, s, points, nominal);
  ASSERT_TRUE(certificate.series().tabulate(s.theta)) << f;
  ASSERT_TRUE(certificate.series().bound(nullptr, false)) << f;
  certificate.check({}, places);
  const std::vector<double> E(static_cast<std::size_t>(s.states), s.size * 0.1);
  ASSERT_TRUE(certificate.series().bound(E.data(), false)) << f;
  certificate.check(E, places);
}

inline Setting randomSetting(Points& points) {
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

/// So many monomials that later orders keep fewer grades than the first ones.
inline Setting settingOfMany(Points& points) {
  Setting s;
  s.weights = {1, 1, points.integer(1, 2), 1};
  s.degree = 5;
  s.frameDegree = points.integer(0, 2);
  s.order = points.integer(7, 12);
  s.size = std::ldexp(0.04, -points.integer(0, 2) * 6);
  s.theta = std::ldexp(1.0, -points.integer(1, 2));
  return s;
}

/// As outputs are computed at a time that is asked for.
inline Setting settingAtOneTime(Points& points) {
  Setting s = settingOfMany(points);
  s.frameDegree = 0;
  s.order = 1;
  s.isAtOneTime = true;
  return s;
}

/// What dominates a bound: truncation in time, in the uncertain quantities, or nothing but rounding, of doubles or of
/// double-doubles.
enum class Regime { time, quantities, rounding, fine };

inline Setting settingOf(Regime regime, Points& points) {
  Setting s;
  s.parameters = 1;
  if (regime == Regime::fine) {  // where second doubles end, and where nothing else is left
    s.weights.clear();
    s.degree = s.frameDegree = 0;
    s.order = 24;
    s.size = 0x1p-90;
    s.theta = std::ldexp(1.0, -points.integer(3, 7));
    s.fineOrders = points.integer(2, 24);
    return s;
  }
  const int symbols = regime == Regime::time ? points.integer(0, 1) : points.integer(0, 2);
  s.weights.assign(static_cast<std::size_t>(symbols), 1);
  s.degree = symbols == 0 ? 0 : regime == Regime::quantities ? points.integer(1, 3) : 4;
  s.frameDegree = points.integer(0, s.degree);
  s.order = regime == Regime::time ? points.integer(4, 7) : 24;
  s.size = regime == Regime::quantities ? 0.06 : 0x1p-20;
  s.theta = regime == Regime::time ? 0.125 : regime == Regime::quantities ? 0.125 : 0x1p-5;
  return s;
}

}  // namespace gamut::testing
