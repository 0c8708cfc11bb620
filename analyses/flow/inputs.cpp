// With u = w - centre, |u| ≤ radius, V' = ĝ u and ĝ constant on every part of the step,
//     y = x - x̃ - Ψ̃(r + Γs + V)   obeys   y' = J̄y - δ - ν(r + Γs + V) + (B̄ - Ψ̃ĝ) u ,
// J̄ and B̄ means of the derivatives between (x̃, centre) and (x, w). ĝ makes B̃ - Ψ̃ĝ vanish in the middle of its part.
#include "analyses/flow/inputs.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "analyses/flow/error_bounds.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double fewParts = 16, mostParts = 64;  // of a step

}  // namespace

void FlowInputs::load(const std::vector<Embedded>& parameters) {
  radius_.clear();
  for (const int parameter : parameters_) radius_.push_back(parameters[at(parameter)].radius);
}

double FlowInputs::push(const PolynomialSeries& series, int i) const {
  double sum = 0;
  for (int k = 0; k < count(); ++k) {
    const int B = node(series, i, k);
    sum += (series.norm(B) + series.rho0(B) + series.rho1(B)) * radius_[at(k)];
  }
  return sum * bounds::up;
}

void FlowInputs::resolve(const PolynomialSeries& series, const FlowGrowth& growth, double theta, double h) {
  const int m = count();
  generators_.clear();
  total_.assign(at(n_), 0.0);
  rest_.assign(at(n_), 0.0);
  haste_ = 0;
  if (m == 0) return;
  const auto horner = [&](const double* c, int order, double sigma) {
    double sum = 0;
    for (int i = order; i >= 0; --i) sum = sum * sigma + c[i];
    return sum;
  };
  Eigen::MatrixXd psi(n_, n_), B(n_, m);
  const auto evaluate = [&](double sigma) {
    for (int i = 0; i < n_; ++i) {
      for (int l = 0; l < n_; ++l) psi(i, l) = horner(series.frame(i, l), order_, sigma);
      for (int k = 0; k < m; ++k) B(i, k) = horner(series.series(node(series, i, k)), order_ - 1, sigma);
    }
  };
  // Of B̃ - Ψ̃ĝ over the step: how fast it moves, and what neither time nor a constant ĝ can cancel.
  Eigen::MatrixXd ofFrame(n_, n_), xiOfFrame(n_, n_), sizeOfFrame(n_, n_);
  for (int i = 0; i < n_; ++i)
    for (int l = 0; l < n_; ++l) {
      ofFrame(i, l) = series.frameDerivativeNorm(i, l, 1, theta);
      xiOfFrame(i, l) = series.frameVariation(i, l);
      sizeOfFrame(i, l) = series.frameNorm(i, l);
    }
  const auto speed = [&](int i, int k, const Eigen::VectorXd& g) {
    return series.derivativeNorm(node(series, i, k), 1, theta) + ofFrame.row(i).dot(g);
  };
  // As many parts as keep the rest small: on the average a quarter of a part's length away from its middle. All states
  // together must be so well known; each by itself, against what may come of B in the step through others, where a few
  // parts do it (no shorter step would).
  evaluate(0.5 * theta);
  Eigen::MatrixXd g = psi.partialPivLu().solve(B);
  Eigen::VectorXd moving = Eigen::VectorXd::Zero(n_), driving = moving;
  for (int i = 0; i < n_; ++i)
    for (int k = 0; k < m; ++k) {
      moving(i) += radius_[at(k)] * speed(i, k, g.col(k).cwiseAbs()) * theta / 4;
      const int b = node(series, i, k);  // its value may pass through zero
      driving(i) += radius_[at(k)] * (series.norm(b) + series.rho0(b) + series.rho1(b));
    }
  double mostMoved = 0, mostDone = 0, each = 1;
  for (int i = 0; i < n_; ++i) {
    double moved = 0, done = 0;
    for (int l = 0; l < n_; ++l) {
      moved += growth.M0(i, l) * moving(l) * h;
      done += growth.M1(i, l) * driving(l);
    }
    if (done > 0) each = std::max(each, moved / (share_ * done));
    const double unit = std::ldexp(1.0, -growth.units()[at(i)]);
    mostMoved = std::max(mostMoved, unit * moved);
    mostDone = std::max(mostDone, unit * driving(i) * h);
  }
  double wanted = mostDone > 0 ? mostMoved / (share_ * mostDone) : 1.0;
  if (!std::isfinite(wanted)) wanted = mostParts;  // a frame that cannot be solved for: the next step fails
  const double least = each < fewParts ? each : fewParts;
  parts_ = static_cast<int>(std::ceil(std::clamp(wanted, least, mostParts)));
  haste_ = wanted / mostParts;

  std::vector<double> turning(at(n_), 0.0), constant(at(n_), 0.0);
  const double length = h / parts_, half = theta / (2 * parts_) * bounds::up;
  for (int part = 0; part < parts_; ++part) {
    evaluate(theta * (part + 0.5) / parts_);
    g = psi.partialPivLu().solve(B);
    const Eigen::MatrixXd off = (B - psi * g).cwiseAbs();
    std::vector<double> turningNow(at(n_), 0.0), constantNow(at(n_), 0.0);
    for (int k = 0; k < m; ++k) {
      const Eigen::VectorXd size = g.col(k).cwiseAbs();
      for (int i = 0; i < n_; ++i) {
        const int b = node(series, i, k);
        // Horner's scheme 2·order roundings, the product n; the difference, the middle's place, ĝ c below: one each.
        const double rounding = (2 * order_ + n_ + 6) * bounds::unit * (series.norm(b) + sizeOfFrame.row(i).dot(size));
        turningNow[at(i)] += radius_[at(k)] * speed(i, k, size) * half;
        constantNow[at(i)] += radius_[at(k)] * (off(i, k) + rounding + series.variation(b) +
                                                xiOfFrame.row(i).dot(size) + series.meanRho0(b) + series.meanRho1(b));
      }
      const double reach = radius_[at(k)] * length * bounds::up;  // ≥ |∫u| over the part
      for (int i = 0; i < n_; ++i) {
        generators_.push_back(g(i, k) * reach);
        total_[at(i)] += std::fabs(generators_.back()) * bounds::up;
      }
    }
    for (int i = 0; i < n_; ++i) {
      turning[at(i)] = std::max(turning[at(i)], turningNow[at(i)]);
      constant[at(i)] = std::max(constant[at(i)], constantNow[at(i)]);
    }
  }
  // y' = Ay + d: M1 d for a constant d; e^{Ah} ∫d for one that falls to zero in the middle of every part.
  for (int i = 0; i < n_; ++i) {
    double sum = 0;
    for (int l = 0; l < n_; ++l) sum += growth.M1(i, l) * constant[at(l)] + growth.M0(i, l) * 0.5 * h * turning[at(l)];
    rest_[at(i)] = sum * bounds::up + bounds::tiny;
  }
}

std::size_t FlowInputs::begunBefore(double share) const {
  const int begun =
      static_cast<int>(std::clamp(std::ceil(share * parts_ * bounds::up), 0.0, static_cast<double>(parts_)));
  return at(begun * count() * n_);
}

}  // namespace gamut
