// Steps in which all solutions pass through the surface of a jump. What the sign pushes them by is linear in when each
// of them does, and that in its start: it is kept so. Derivations: docs/flow.md, section 7.
#include <algorithm>
#include <cmath>
#include <vector>

#include "analyses/flow/error_bounds.hpp"
#include "analyses/flow/step.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// ∫(s - centre) up to τ, for all solutions: perUnit u(0) + constant.
struct Impulse {
  Interval perUnit, constant;
};

/// s is `before` until t* and the opposite from then on: before (2 min(t*, τ) - τ) - centre τ. min(t*, τ) is the chord
/// over what t* may be, and as much as the corner rises above that.
Impulse impulseUntil(double tau, const JumpBound::Crossing& at, double centre) {
  const double first = at.moment.lower(), last = at.moment.upper();
  const double slope = tau <= first ? 0 : tau >= last ? 1 : (tau - first) / (last - first);
  Interval rest(tau);
  if (tau >= last)
    rest = Interval(0.0);
  else if (tau > first)
    rest = hull(hull(Interval(first) - Interval(slope) * Interval(first),
                     Interval(tau) - Interval(slope) * Interval(tau)),
                Interval(tau) - Interval(slope) * Interval(last));
  const Interval twice(2 * at.before);
  return {twice * Interval(slope) * at.perUnit,
          twice * rest - Interval(at.before) * Interval(tau) - Interval(centre) * Interval(tau)};
}

}  // namespace

/// With y = x - x̃ - Ψ̃(r + Γs) and b about ∂f/∂s, z = y - b ∫(s - s̃) obeys
///     z' = J̄z - δ - ν(r + Γs) + J̄ b ∫(s - s̃) + (∂f/∂s - b)(s - s̃) ,   δ without what the sign does.
void FlowStepper::boundCrossings(const FlowSet& set) {
  if (crossings_.empty()) return;
  const std::vector<int>& signs = series_.jumps();
  for (const Crossing& crossing : crossings_) series_.setApart(signs[crossing.jump], true);
  bool isBounded = series_.bound(nullptr, false);
  std::vector<double> rest(at(n_), 0.0), last(at(n_), 0.0);
  for (int i = 0; i < n_ && isBounded; ++i) {
    const int f = series_.outputNode(i);
    rest[at(i)] = (series_.rho0(f) + series_.slopeRounding(i)) * bounds::up + bounds::tiny;
    last[at(i)] = series_.rho1(f);
  }
  for (const Crossing& crossing : crossings_) series_.setApart(signs[crossing.jump], false);
  isBounded = series_.bound(E_.data(), false) && isBounded;
  Box box;
  for (int i = 0; i < n_; ++i) box.push_back(series_.rangeOf(i, E_[at(i)]));
  const Interval time = Interval(set.t) + Interval(0.0, h_);
  std::vector<JumpBound> bounds = ownBounds_;  // the polynomial's signs too
  for (std::size_t j = 0; j < bounds.size(); ++j)
    bounds[j].sign = hull(bounds[j].sign, Interval(series_.series(signs[j])[0]));
  for (Crossing& crossing : crossings_) {
    const double centre = series_.series(signs[crossing.jump])[0];
    const Interval before(crossing.at.before - centre);
    crossing.impulse = std::max(magnitude(before * crossing.at.moment),
                                magnitude(before * crossing.at.moment -
                                          Interval(crossing.at.before + centre) * (Interval(h_) - crossing.at.moment)));
    for (const Interval& push : own_->pushOf(crossing.jump, time, box, bounds)) {
      isBounded = isBounded && isCommon(push);
      crossing.push.push_back(midpoint(push));
      crossing.spread.push_back(magnitude(push - Interval(crossing.push.back())) * (1 + std::fabs(centre)));
    }
    for (std::size_t i = 0; i < at(n_) && isBounded; ++i) {
      rest[i] += crossing.spread[i];
      for (std::size_t j = 0; j < at(n_); ++j)
        rest[i] += series_.jacobianBound(static_cast<int>(i), static_cast<int>(j)) * std::fabs(crossing.push[j]) *
                   crossing.impulse;
    }
  }
  if (!isBounded) {
    crossings_.clear();
    return;
  }
  crossed_.assign(at(n_), 0.0);
  for (int i = 0; i < n_; ++i) {
    double sum = inputs_.rest(i);
    for (int j = 0; j < n_; ++j)
      sum += growth_.M1(i, j) * rest[at(j)] + growth_.M2(i, j) * last[at(j)] + growth_.M0(i, j) * set.W[at(j)];
    crossed_[at(i)] = sum * bounds::up + bounds::tiny;
  }
}

/// x += b ∫(s - s̃), u(0) as what the set says it is: Σ_g u_g ξ^g + Σ_i c_i C_i (r + Γs) ± the rest.
void FlowStepper::addCrossings(const FlowSet& set, double tau, FlowPoint& point) const {
  const std::size_t n = at(n_), N = at(series_.count()), frames = at(series_.frameCount());
  for (const Crossing& crossing : crossings_) {
    const LinearForm& form = *own_->jumps().forms[crossing.jump];
    const double centre = series_.series(series_.jumps()[crossing.jump])[0];
    const Impulse impulse = impulseUntil(tau, crossing.at, centre);
    const double a = midpoint(impulse.perUnit), b = midpoint(impulse.constant);
    double rest = magnitude(impulse.constant - Interval(b)) +
                  magnitude(impulse.perUnit - Interval(a)) * magnitude(ownBounds_[crossing.jump].start);
    std::vector<double> u(N, 0.0), ofFrame(frames * n, 0.0);
    u[0] = midpoint(form.constant);
    double size = std::fabs(u[0]), ofW = radius(form.constant);
    for (std::size_t q = 0; q < form.parameters.size(); ++q) {
      const double d = form.parameters[q];
      const Embedded& e = set.parameters[q];
      if (d == 0) continue;
      u[0] += d * e.centre;
      if (e.symbol >= 0) u[at(monomials().linear(e.symbol))] += d * e.half;
      size += std::fabs(d) * (std::fabs(e.centre) + std::fabs(e.half));
      ofW += std::fabs(d) * e.coarseRadius();
    }
    std::vector<double> sizeOfFrame(n, 0.0), sum(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      const double c = form.states[i];
      if (c == 0) continue;
      ofW += std::fabs(c) * set.W[i];
      for (std::size_t g = 0; g < N; ++g) {
        u[g] += c * set.p[i * N + g];
        size += std::fabs(c * set.p[i * N + g]);
      }
      for (std::size_t g = 0; g < frames; ++g)
        for (std::size_t j = 0; j < n; ++j) {
          const double part = c * set.C[(g * n + i) * n + j];
          ofFrame[g * n + j] += part;
          sizeOfFrame[j] += std::fabs(part);
        }
    }
    for (std::size_t g = 0; g < frames; ++g)
      for (std::size_t j = 0; j < n; ++j) sum[j] += std::fabs(ofFrame[g * n + j]);
    rest += std::fabs(a) * ofW;
    // No sum has more than n + parameters + 1 terms of two roundings; three more in what is added of it.
    const double roundings = (2.0 * static_cast<double>(n + form.parameters.size()) + 8) * bounds::unit;
    for (std::size_t i = 0; i < n; ++i) {
      const double push = crossing.push[i], by = push * a;
      if (push == 0) continue;
      double loose = std::fabs(push) * (rest + roundings * (std::fabs(a) * size + std::fabs(b)));
      for (std::size_t g = 0; g < N; ++g) {
        double& p = point.p[i * N + g];
        loose += roundings * std::fabs(p);
        p += by * u[g];
      }
      point.p[i * N] += push * b;
      for (std::size_t j = 0; j < n; ++j) {
        // What inputs do in the step itself is not in u(0).
        loose += std::fabs(by) * (roundings * sizeOfFrame[j] * point.total[j] + sum[j] * inputs_.total(static_cast<int>(j)));
        for (std::size_t g = 0; g < frames; ++g) {
          double& psi = point.psi[(g * n + i) * n + j];
          loose += roundings * std::fabs(psi) * point.total[j];
          psi += by * ofFrame[g * n + j];
        }
      }
      point.loose[i] += loose * bounds::up + bounds::tiny;
    }
  }
}

}  // namespace gamut
