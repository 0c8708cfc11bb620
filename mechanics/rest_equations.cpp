#include "mechanics/rest_equations.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/rest_rows.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

RestEquations restEquations(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  const RestRows of(mechanism, freeParameters);
  const int n = of.coordinates, loops = of.loops, size = of.size, unknowns = loops > 0 ? size + 1 : n,
            parameters = of.parameters;
  if (of.ownStates > 0)
    throw UnfitPart(of.names.front(), "all positions of rest are looked for where no element has states alone",
                    "no element with a state");

  // Λ makes loads and multipliers alike where the mechanism stands at first.
  double unit = 1;
  const auto rowsAt = [&]<class S>(const std::vector<S>& q, std::span<const S> p, int multiplier) {
    std::vector<S> x(q.begin(), q.begin() + n);
    x.resize(3 * size, S(0.0));
    if (multiplier >= 0) x[n + multiplier] = S(1.0);
    return evaluate<S>(of.rows, x, {p.begin(), p.end()});
  };
  if (loops > 0) {
    std::vector<double> start = Assembly<double>(mechanism).initialState(), nominal;
    for (const std::string& name : freeParameters)
      nominal.push_back(midpoint(mechanism.rangeOf(Expression::named(name))));
    double load = 0, lever = 0;
    const std::vector<double> alone = rowsAt(start, std::span<const double>(nominal), -1);
    for (int j = 0; j < loops; ++j) {
      const std::vector<double> with = rowsAt(start, std::span<const double>(nominal), j);
      for (int i = 0; i < n; ++i) {
        load = std::max(load, std::abs(alone[i]));
        lever = std::max(lever, std::abs(with[i] - alone[i]));
      }
    }
    if (load > 0 && lever > 0 && std::isfinite(load / lever)) unit = std::exp2(std::round(std::log2(load / lever)));
  }

  RestEquations equations;
  equations.roots = record(unknowns, parameters, unknowns, [&](auto, const auto& x, const auto& p, auto& y) {
    const std::span<const Recorded> values(p);
    const std::vector<Recorded> q(x.begin(), x.begin() + n), alone = rowsAt(q, values, -1);
    std::ranges::copy(alone, y.begin());
    if (loops == 0) return;
    for (int i = 0; i < n; ++i) y[i] = x[n] * alone[i];
    Recorded length = sqr(x[n]);
    for (int j = 0; j < loops; ++j) {
      const std::vector<Recorded> with = rowsAt(q, values, j);
      for (int i = 0; i < n; ++i) y[i] = y[i] + unit * x[n + 1 + j] * (with[i] - alone[i]);
      length = length + sqr(x[n + 1 + j]);
    }
    y[size] = length - Recorded(1.0);
  });
  equations.stiffness = record(unknowns, parameters, size * size, [&](auto, const auto& x, const auto& p, auto& y) {
    std::vector<Recorded> v(x.begin(), x.begin() + n);
    for (int j = 0; j < loops; ++j) v.push_back(unit * x[n + 1 + j] / x[n]);
    v.resize(3 * size, Recorded(0.0));
    const std::vector<Recorded> all = evaluate<Recorded>(of.linear, v, {p.begin(), p.end()});
    const auto slope = [&](int i, int j) { return all[size + i * 3 * size + j]; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) y[i * size + j] = -slope(i, j);
    for (int k = n; k < size; ++k)
      for (int j = 0; j < size; ++j) y[k * size + j] = y[j * size + k] = j < n ? slope(k, j) : Recorded(0.0);
  });
  if (loops > 0) {
    equations.multipliers.assign(loops + 1, Interval(-2.0, 2.0));  // with room around those that no load bears on
    equations.multipliers.front() = Interval(0.0, 2.0);
  }
  return equations;
}

std::optional<int> negativeEigenvalues(const std::vector<Interval>& k, int n) {
  using Matrix = Eigen::MatrixXd;
  Matrix middle(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (isEmpty(intersection(k[i * n + j], k[j * n + i])) || !isBounded(k[i * n + j])) return {};  // no potential
      middle(i, j) = midpoint(k[i * n + j]);
    }
  Eigen::VectorXd scale =
      middle.diagonal().cwiseAbs().unaryExpr([](double x) { return x > 0 ? 1 / std::sqrt(x) : 0.0; });
  for (int j = 0; j < n; ++j)
    if (scale[j] == 0) {
      const double most = (middle.col(j).cwiseAbs().array() * scale.array()).maxCoeff();
      scale[j] = most > 0 ? 1 / most : 1.0;
    }
  const Matrix scaled = scale.asDiagonal() * Matrix(0.5 * (middle + middle.transpose())) * scale.asDiagonal();
  const Matrix t = scale.asDiagonal() * Eigen::SelfAdjointEigenSolver<Matrix>(scaled).eigenvectors();
  int negatives = 0;
  for (int a = 0; a < n; ++a) {
    Interval disc(0.0);
    for (int b = 0; b < n; ++b) {
      Interval sum(0.0);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          sum += Interval(t(i, a)) * intersection(k[i * n + j], k[j * n + i]) * Interval(t(j, b));
      disc += a == b ? sum : Interval(-1.0, 1.0) * sum;
    }
    if (contains(disc, 0.0)) return {};
    negatives += disc.upper() < 0 ? 1 : 0;
  }
  return negatives;
}

}  // namespace gamut
