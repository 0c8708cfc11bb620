// With u = w - centre, |u| ≤ radius, V' = ĝ u and ĝ constant on every part of the step,
//     y = x - x̃ - Ψ̃(r + Γs + V)   obeys   y' = J̄y - δ - ν(r + Γs + V) + (B̄ - Ψ̃ĝ) u ,
// J̄ and B̄ means of the derivatives between (x̃, centre) and (x, w). ĝ makes B̃ - Ψ̃ĝ vanish in the middle of its part.
#include "analyses/flow/step/inputs.hpp"

#include <algorithm>
#include <cmath>

#include "analyses/flow/series/error_bounds.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double fewParts = 16, mostParts = 64;  // of a step

}  // namespace

void FlowInputs::load(const std::vector<Embedded>& parameters) {
  radius_.clear();
  for (const int parameter : parameters_) radius_.push_back(parameters[parameter].radius);
}

double FlowInputs::push(const PolynomialSeries& series, int i) const {
  double sum = 0;
  for (int k = 0; k < count(); ++k) {
    const int B = node(series, i, k);
    sum += (series.norm(B) + series.rho0(B) + series.rho1(B)) * radius_[k];
  }
  return sum * bounds::up;
}

/// Of a step: Ψ̃ and B̃ at one time; of B̃ - Ψ̃ĝ over the step, how fast Ψ̃ moves, and what neither time nor a constant ĝ
/// can cancel.
struct FlowInputs::Course {
  const PolynomialSeries& series;
  double theta;
  Eigen::MatrixXd psi, B;
  Eigen::MatrixXd speed, variation, size;  // of Ψ̃
};

FlowInputs::Course FlowInputs::courseOf(const PolynomialSeries& series, double theta) const {
  const Eigen::MatrixXd square(n_, n_);
  Course course{series, theta, square, Eigen::MatrixXd(n_, count()), square, square, square};
  for (int i = 0; i < n_; ++i)
    for (int l = 0; l < n_; ++l) {
      course.speed(i, l) = series.frameDerivativeNorm(i, l, 1, theta);
      course.variation(i, l) = series.frameVariation(i, l);
      course.size(i, l) = series.frameNorm(i, l);
    }
  return course;
}

/// ĝ at σ.
Eigen::MatrixXd FlowInputs::solve(Course& course, double sigma) const {
  const auto horner = [&](const double* c, int order) {
    double sum = 0;
    for (int i = order; i >= 0; --i) sum = sum * sigma + c[i];
    return sum;
  };
  for (int i = 0; i < n_; ++i) {
    for (int l = 0; l < n_; ++l) course.psi(i, l) = horner(course.series.frame(i, l), order_);
    for (int k = 0; k < count(); ++k)
      course.B(i, k) = horner(course.series.series(node(course.series, i, k)), order_ - 1);
  }
  return solved(course.psi, course.B);
}

/// How fast B̃ - Ψ̃ĝ moves, |ĝ| = g.
double FlowInputs::speedOf(const Course& course, int i, int k, const Eigen::VectorXd& g) const {
  return course.series.derivativeNorm(node(course.series, i, k), 1, course.theta) + course.speed.row(i).dot(g);
}

/// As many parts as keep the rest small: on the average a quarter of a part's length away from its middle. All states
/// together must be so well known; each by itself, against what may come of B in the step through others, where a few
/// parts do it (no shorter step would).
void FlowInputs::choosePartsOf(Course& course, const FlowGrowth& growth, double h) {
  const PolynomialSeries& series = course.series;
  const Eigen::MatrixXd g = solve(course, 0.5 * course.theta);
  Eigen::VectorXd moving = Eigen::VectorXd::Zero(n_), driving = moving;
  for (int i = 0; i < n_; ++i)
    for (int k = 0; k < count(); ++k) {
      moving(i) += radius_[k] * speedOf(course, i, k, g.col(k).cwiseAbs()) * course.theta / 4;
      const int b = node(series, i, k);  // its value may pass through zero
      driving(i) += radius_[k] * (series.norm(b) + series.rho0(b) + series.rho1(b));
    }
  double mostMoved = 0, mostDone = 0, each = 1;
  for (int i = 0; i < n_; ++i) {
    double moved = 0, done = 0;
    for (int l = 0; l < n_; ++l) {
      moved += growth.M0(i, l) * moving(l) * h;
      done += growth.M1(i, l) * driving(l);
    }
    if (done > 0) each = std::max(each, moved / (share_ * done));
    const double unit = std::ldexp(1.0, -growth.units()[i]);
    mostMoved = std::max(mostMoved, unit * moved);
    mostDone = std::max(mostDone, unit * driving(i) * h);
  }
  double wanted = mostDone > 0 ? mostMoved / (share_ * mostDone) : 1.0;
  if (!std::isfinite(wanted)) wanted = mostParts;  // a frame that cannot be solved for: the next step fails
  const double least = each < fewParts ? each : fewParts;
  parts_ = static_cast<int>(std::ceil(std::clamp(wanted, least, mostParts)));
  haste_ = wanted / mostParts;
}

/// The generators of a part of h seconds in all; raises, of each state, what is left at its ends and in its middle.
void FlowInputs::addPart(Course& course, double h, int part, std::vector<double>& turning,
                         std::vector<double>& constant) {
  const PolynomialSeries& series = course.series;
  const double length = h / parts_, half = course.theta / (2 * parts_) * bounds::up;
  const Eigen::MatrixXd g = solve(course, course.theta * (part + 0.5) / parts_);
  const Eigen::MatrixXd off = (course.B - course.psi * g).cwiseAbs();
  std::vector<double> turningNow(n_, 0.0), constantNow(at(n_), 0.0);
  for (int k = 0; k < count(); ++k) {
    const Eigen::VectorXd size = g.col(k).cwiseAbs();
    for (int i = 0; i < n_; ++i) {
      const int b = node(series, i, k);
      // Horner's scheme 2·order roundings, the product n; the difference, the middle's place, ĝ c below: one each.
      const double rounding = (2 * order_ + n_ + 6) * bounds::unit * (series.norm(b) + course.size.row(i).dot(size));
      turningNow[i] += radius_[k] * speedOf(course, i, k, size) * half;
      constantNow[i] += radius_[k] * (off(i, k) + rounding + series.variation(b) + course.variation.row(i).dot(size) +
                                      series.meanRho(b).e0 + series.meanRho(b).e1);
    }
    const double reach = radius_[k] * length * bounds::up;  // ≥ |∫u| over the part
    for (int i = 0; i < n_; ++i) {
      generators_.push_back(g(i, k) * reach);
      total_[i] += std::fabs(generators_.back()) * bounds::up;
    }
  }
  for (int i = 0; i < n_; ++i) {
    turning[i] = std::max(turning[i], turningNow[i]);
    constant[i] = std::max(constant[i], constantNow[i]);
  }
}

void FlowInputs::resolve(const PolynomialSeries& series, const FlowGrowth& growth, double theta, double h) {
  generators_.clear();
  total_.assign(n_, 0.0);
  rest_.assign(n_, 0.0);
  haste_ = 0;
  if (empty()) return;
  Course course = courseOf(series, theta);
  choosePartsOf(course, growth, h);
  std::vector<double> turning(n_, 0.0), constant(at(n_), 0.0);
  for (int part = 0; part < parts_; ++part) addPart(course, h, part, turning, constant);
  // y' = Ay + d: M1 d for a constant d; e^{Ah} ∫d for one that falls to zero in the middle of every part.
  for (int i = 0; i < n_; ++i) {
    double sum = 0;
    for (int l = 0; l < n_; ++l) sum += growth.M1(i, l) * constant[l] + growth.M0(i, l) * 0.5 * h * turning[l];
    rest_[i] = sum * bounds::up + bounds::tiny;
  }
}

std::size_t FlowInputs::begunBefore(double share) const {
  const int begun =
      static_cast<int>(std::clamp(std::ceil(share * parts_ * bounds::up), 0.0, static_cast<double>(parts_)));
  return at(begun * count() * n_);
}

}  // namespace gamut
