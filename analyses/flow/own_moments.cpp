// Solutions stopped where each has just turned, at a time of its own: what follows starts for all of them at once, and
// what they were apart in time is a polynomial beside the set. docs/flow.md, section 7, "Times of their own".
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analyses/flow/error_bounds.hpp"
#include "analyses/flow/step.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

/// In units of σ.
BoundedPolynomial FlowStepper::momentOnceTurned() const {
  BoundedPolynomial moment{turn_->when.c};
  moment.c[0] += turn_->lag / h0_;
  return moment;
}

bool FlowStepper::mayStopOnceTurned(const FlowSet& set) const {
  if (!turn_ || isOpaque() || set.unsettledUntil > set.t || monomials().symbols() == 0) return false;
  if (turn_->soon.empty()) return false;
  const BoundedPolynomial moment = momentOnceTurned();
  return moment.c[0] >= moment.variation() && (moment.c[0] + moment.variation()) * bounds::up <= theta_;
}

BoundedPolynomial FlowStepper::frameAt(std::size_t i, std::size_t j, const BoundedPolynomial& moment) const {
  const double* series = series_.frame(static_cast<int>(i), static_cast<int>(j));
  std::vector<BoundedPolynomial> u(at(m_) + 1);
  for (std::size_t order = 0; order < u.size(); ++order)
    for (int g = 0; g < series_.frameCount(); ++g) u[order].c.push_back(series[at(g * series_.stride()) + order]);
  return composed(monomials(), u, moment);
}

/// Of the turn that has been proved: |z| so soon after m(ξ), and so after a solution's own moment, at most. As in
/// jumpAtMoment, but S is d(ξ) GΨ̃ at m(ξ), polynomials in ξ. `before`: |z| until the moment; `rest`: what z is driven
/// by from then on, with S constant.
void FlowStepper::boundSoon(Turn& turn, const std::vector<Interval>& J, const std::vector<double>& before,
                            const std::vector<double>& rest, const std::vector<double>& slack) {
  constexpr double ofStep = 0x1p-8;
  const std::size_t n = at(n_);
  turn.lag = std::max(2 * turn.away, ofStep * h_);
  turn.soon.clear();
  turn.saltationOf.clear();
  std::vector<double> z(n), drive = rest;
  for (std::size_t i = 0; i < n; ++i) z[i] = before[i] + turn.away * turn.turned[i];
  if (turn.ofGuard.empty()) {
    for (std::size_t i = 0; i < n; ++i) z[i] += turn.within(i, turn.away);
  } else {
    double guard = turn.rest + turn.beyond, frame = 0;
    std::vector<BoundedPolynomial> ofGuard(n);  // GΨ̃ at m(ξ)
    for (std::size_t l = 0; l < n; ++l) guard += std::fabs(turn.ofGuard[l]) * before[l];
    for (std::size_t j = 0; j < n; ++j) {
      ofGuard[j].c.assign(at(series_.count()), 0.0);
      for (std::size_t l = 0; l < n && total_[j] > 0; ++l) {
        if (turn.ofGuard[l] == 0) continue;
        BoundedPolynomial psi = frameAt(l, j, turn.when);
        ofGuard[j] += (psi *= turn.ofGuard[l]);
        const double moves = series_.frameDerivativeNorm(static_cast<int>(l), static_cast<int>(j), 1, theta_) / h0_;
        guard += std::fabs(turn.ofGuard[l]) * turn.away * moves * total_[j];
      }
      guard += ofGuard[j].error * total_[j];
      frame += ofGuard[j].norm() * total_[j];
    }
    std::vector<double> varies(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      const double curved = 0.5 * turn.bend[i] + turn.away * turn.twist[i] / 6;
      z[i] += turn.gap[i] + turn.away * turn.away * curved + turn.slope[i] / turn.steepness * guard * bounds::up +
              turn.besideLeapOf[i] * frame;
      for (std::size_t j = 0; j < n; ++j) {
        BoundedPolynomial saltation = product(monomials(), turn.leapOf[i], {ofGuard[j].c});
        z[i] += saltation.error * total_[j];
        saltation.error = 0;
        varies[i] +=
            (saltation.variation() + std::fabs(saltation.c[0] - turn.saltation[i * n + j]) * bounds::up) * total_[j];
        turn.saltationOf.push_back(std::move(saltation));
      }
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t l = 0; l < n; ++l) drive[i] += magnitude(J[i * n + l]) * varies[l] * bounds::up;
  }
  constexpr double nearly = 0x1p-20;
  if (!following_.compute((1 + nearly) * (turn.lag + turn.away))) return;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = slack[i] + bounds::tiny;
    for (std::size_t j = 0; j < n; ++j)
      sum += (following_.M0(static_cast<int>(i), static_cast<int>(j)) * z[j] +
              following_.M1(static_cast<int>(i), static_cast<int>(j)) * drive[j]) *
             bounds::up;
    turn.soon.push_back(sum * bounds::up);
  }
}

/// p, Ψ and what is loose at that moment of each: with D and S + K (t - m(ξ)).
void FlowStepper::evaluateOnceTurned(const BoundedPolynomial& moment, FlowPoint& point) const {
  const std::size_t n = at(n_), N = at(series_.count()), NJ = at(series_.frameCount()), orders = at(m_) + 1;
  const Turn& turn = *turn_;
  point.p.assign(n * N, 0.0);
  point.low.assign(n, 0.0);
  point.known.assign(n, 0.0);
  point.psi.assign(NJ * n * n, 0.0);
  point.psiSum.assign(n * n, 0.0);
  point.loose.assign(n, 0.0);
  point.total = total_;
  for (std::size_t i = 0; i < n; ++i) {
    const double* series = series_.series(static_cast<int>(i));
    std::vector<BoundedPolynomial> u(orders);
    for (std::size_t order = 0; order < orders; ++order) {
      for (std::size_t g = 0; g < N; ++g) u[order].c.push_back(series[g * at(series_.stride()) + order]);
      u[order] += turn.D[i][order];
    }
    const BoundedPolynomial x = composed(monomials(), u, moment);
    std::ranges::copy(x.c, point.p.begin() + static_cast<std::ptrdiff_t>(i * N));
    point.loose[i] = x.error + turn.soon[i] + series_.lowNorm(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < n; ++i) {
    double size = 0;
    for (std::size_t j = 0; j < n; ++j) {
      if (total_[j] == 0) continue;
      BoundedPolynomial psi = frameAt(i, j, moment);
      const double more = turn.K[i * n + j] * turn.lag;
      psi += turn.saltationOf.empty() ? BoundedPolynomial{{turn.saltation[i * n + j]}} : turn.saltationOf[i * n + j];
      psi += {{more}};
      double rest = psi.error + 4 * bounds::unit * (std::fabs(more) + std::fabs(turn.K[i * n + j]) * theta_ * h0_),
             sum = 0;
      for (std::size_t g = 0; g < psi.c.size(); ++g)
        if (g < NJ)
          point.psi[(g * n + i) * n + j] = psi.c[g], sum += std::fabs(psi.c[g]);
        else
          rest += std::fabs(psi.c[g]);
      point.psiSum[i * n + j] = sum * bounds::up;
      point.loose[i] += (rest + epsilon_[i * n + j]) * total_[j];
      size += sum * bounds::up * total_[j];
    }
    point.loose[i] = (point.loose[i] + static_cast<double>(2 * n + 8) * bounds::unit * size) * bounds::up;
  }
}

void FlowStepper::advanceOnceTurned(FlowSet& set) {
  BoundedPolynomial elapsed = momentOnceTurned();
  evaluateOnceTurned(elapsed, end_);
  evaluateRemainder(set, h_, end_);
  narrowArguments(set, h_, end_, {}, true);
  carryGenerators(set);
  elapsed *= h0_;
  set.ahead.c.resize(at(series_.count()), 0.0);
  set.ahead += elapsed;
  // t moves on to about when the first of them are there: by whole units of time.
  const double first = (Interval(set.ahead.c[0]) - Interval(set.ahead.variation()) - Interval(set.ahead.error)).lower();
  const double passed = std::max(0.0, std::floor(first / resolution_)) * resolution_;
  set.t += passed;
  set.ahead += {{-passed}};
  set.arguments = argumentsBehind(true);
  endStep(set);
}

double FlowStepper::radiusOver(int state, bool hasTurned) const {
  const std::size_t i = at(state);
  double radius = series_.lowNorm(state) +
                  (hasTurned ? crossed_[i] + turn_->leapt[i] + (h_ + turn_->away) * bounds::up * turn_->turned[i]
                   : turn_   ? turn_->before[i]
                             : e1_[i]);
  for (int j = 0; j < n_; ++j) radius += (series_.frameNorm(state, j) + epsilon_[at(state * n_ + j)]) * total_[at(j)];
  return radius * bounds::up + bounds::tiny;
}

}  // namespace gamut
