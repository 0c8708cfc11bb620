// Solutions stopped where each has just turned, at a time of its own: what follows starts for all of them at once, and
// what they were apart in time is a polynomial beside the set. docs/flow.md, section 7, "Times of their own".
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/step/step.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

/// In units of σ.
BoundedPolynomial FlowStepper::momentOnceTurned() const {
  BoundedPolynomial moment{turn_->when.c};
  moment += {{turn_->lag / h0_}};
  return moment;
}

bool FlowStepper::mayStopOnceTurned(const FlowSet& set) const {
  if (!turn_ || isOpaque() || set.unsettledUntil > set.t || monomials().symbols() == 0) return false;
  if (turn_->soon.empty()) return false;
  return (Interval(turn_->moments.upper()) + Interval(turn_->lag)).upper() <= h_;
}

BoundedPolynomial FlowStepper::frameAt(std::size_t i, std::size_t j, const BoundedPolynomial& moment) const {
  const double* series = series_.frame(static_cast<int>(i), static_cast<int>(j));
  std::vector<BoundedPolynomial> u(at(m_) + 1);
  for (std::size_t order = 0; order < u.size(); ++order)
    for (int g = 0; g < series_.frameCount(); ++g) u[order].c.push_back(series[at(g * series_.stride()) + order]);
  return composed(monomials(), u, moment);
}

namespace {

/// Σ u_k (σ + by)^k, by as many orders of σ as there are u.
std::vector<BoundedPolynomial> moved(const Monomials& monomials, const std::vector<BoundedPolynomial>& u,
                                     const BoundedPolynomial& by) {
  std::vector<BoundedPolynomial> result;
  for (auto term = u.rbegin(); term != u.rend(); ++term) {
    std::vector<BoundedPolynomial> next(result.size() + 1);
    for (std::size_t k = 0; k < result.size(); ++k) {
      next[k] += product(monomials, result[k], by);
      next[k + 1] += result[k];
    }
    next[0] += *term;
    result = std::move(next);
  }
  return result;
}

}  // namespace

/// X of describeSince from X_0 on, which is there: X_{k+1} (k + 1) is the k-th order of f_a along X.
void FlowStepper::followOnceTurned(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn) {
  const std::size_t n = at(n_), N = at(series_.count()), orders = at(m_) + 1;
  AlongStep& following = turn.of->following();
  for (std::size_t order = 0; order + 1 < turn.fromMoment[0].size(); ++order) {
    std::vector<double> states(n * N * orders, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t g = 0; g < N; ++g)
        for (std::size_t k = 0; k <= order; ++k) states[(i * N + g) * orders + k] = turn.fromMoment[i][k].c[g];
    following.compute(states, set.t, h0_, turn.span, set.parameters, signs);
    for (std::size_t i = 0; i < n; ++i) {
      const PolynomialSeries& f = following.series();
      const int node = f.outputNode(static_cast<int>(i));
      for (std::size_t g = 0; g < std::min(N, at(f.count(node))); ++g)
        turn.fromMoment[i][order + 1].c[g] =
            f.series(node)[g * at(f.stride()) + order] * h0_ / static_cast<double>(order + 1);
    }
  }
}

/// What solutions are from m(ξ) on until they are stopped, by orders of s = σ - m(ξ), s no less than -a: X_0 = x̃(m).
/// D is X - x̃, so that |D(m)| is what x̃(m) is truncated by.
bool FlowStepper::describeSince(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn) {
  constexpr std::size_t few = 4;
  const std::size_t n = at(n_), N = at(series_.count()), orders = at(m_) + 1;
  turn.lag = lagOf(turn.away, h_);
  turn.span = (turn.lag + 2 * turn.away) / h0_ * (bounds::up * bounds::up);
  if (!((Interval(turn.moments.upper()) + Interval(h0_) * Interval(turn.span)).upper() <= h_)) return false;
  std::vector<std::vector<BoundedPolynomial>> own(n);  // x̃
  turn.fromMoment.assign(n, std::vector<BoundedPolynomial>(few, {std::vector<double>(N, 0.0)}));
  for (std::size_t i = 0; i < n; ++i) {
    own[i] = ordersOf(series_, static_cast<int>(i), orders);
    const BoundedPolynomial start = composed(monomials(), own[i], turn.when);
    turn.fromMoment[i][0].c = start.c;
    turn.gap.push_back(start.error);
  }
  followOnceTurned(set, signs, turn);
  const double longest = turn.span * h0_ * bounds::up;
  for (std::size_t i = 0; i < n; ++i) {
    const auto differenceOf = [&](const std::vector<BoundedPolynomial>& rates, std::size_t k, double factor) {
      BoundedPolynomial difference = composed(monomials(), rates, turn.when), since = turn.fromMoment[i][k];
      difference *= -1;
      difference += (since *= factor);
      return difference;
    };
    const std::vector<BoundedPolynomial> rates = rateOf(own[i], h0_), seconds = rateOf(rates, h0_),
                                         thirds = rateOf(seconds, h0_);
    turn.slopeOf.push_back(differenceOf(rates, 1, 1 / h0_));
    turn.slope.push_back(turn.slopeOf[i].norm());
    turn.bend.push_back(differenceOf(seconds, 2, 2 / (h0_ * h0_)).norm());  // h0 is a power of two
    double twist = 6 * turn.fromMoment[i][3].norm() / (h0_ * h0_ * h0_), power = 1;
    for (std::size_t order = 0; order < thirds.size(); ++order, power *= theta_) twist += thirds[order].norm() * power;
    turn.twist.push_back(twist * bounds::up);
    turn.most.push_back(turn.within(i, longest));
    turn.extent.push_back(turn.within(i, longest + width(turn.moments)));
    if (!std::isfinite(turn.extent[i])) return false;
  }
  // X - x̃ by orders of σ, for those who look at the step at other times.
  BoundedPolynomial back = turn.when;
  back *= -1;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<BoundedPolynomial> X = moved(monomials(), turn.fromMoment[i], back);
    X.resize(orders);
    for (std::size_t order = 0; order < orders; ++order) {
      BoundedPolynomial off = own[i][order];
      off *= -1;
      X[order] += off;
      X[order].c.resize(N, 0.0);
    }
    turn.D.push_back(std::move(X));
  }
  return true;
}

/// By orders of the time from a before m(ξ) on, as AlongStep takes it: X(s' - a), by synthetic division. That is six
/// steps of two roundings each; a product a c_{k+1} that cancels in order k is less than span c_{k+1}, so all that is
/// off is less than 16 roundings of Σ |c_k| span^k.
std::vector<double> FlowStepper::statesSince(const StepTurn& turn) const {
  const std::size_t N = at(series_.count()), orders = at(m_) + 1;
  const double before = turn.away / h0_;
  std::vector<double> result(at(n_) * N * orders, 0.0);
  for (std::size_t i = 0; i < at(n_); ++i)
    for (std::size_t g = 0; g < N; ++g) {
      double* c = &result[(i * N + g) * orders];
      const std::size_t few = turn.fromMoment[i].size();
      for (std::size_t k = 0; k < few; ++k) c[k] = turn.fromMoment[i][k].c[g];
      for (std::size_t from = 0; from + 1 < few; ++from)
        for (std::size_t k = few - 1; k-- > from;) c[k] -= before * c[k + 1];
    }
  return result;
}

/// GΨ̃ at m(ξ), of the columns that there is something of.
std::vector<BoundedPolynomial> FlowStepper::guardOfFrame(const StepTurn& turn) const {
  const std::size_t n = at(n_);
  std::vector<BoundedPolynomial> result(n, {std::vector<double>(series_.count(), 0.0)});
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t l = 0; l < n && total_[j] > 0; ++l) {
      if (turn.ofGuard[l] == 0) continue;
      BoundedPolynomial psi = frameAt(l, j, turn.when);
      result[j] += (psi *= turn.ofGuard[l]);
    }
  return result;
}

/// Of the turn that has been proved: |z| so soon after m(ξ), and so after a solution's own moment, at most. As in
/// jumpAtMoment, but S is d(ξ) GΨ̃ at m(ξ), polynomials in ξ. `before`: |z| until the moment; `rest`: what z is driven
/// by from then on, with S constant.
void FlowStepper::boundSoon(StepTurn& turn, const std::vector<Interval>& J, const std::vector<double>& before,
                            const std::vector<double>& rest, const std::vector<double>& slack) {
  const std::size_t n = at(n_);
  turn.lag = lagOf(turn.away, h_);
  turn.soon.clear();
  turn.saltationOf.clear();
  std::vector<double> z(n), drive = rest;
  for (std::size_t i = 0; i < n; ++i) z[i] = before[i] + turn.away * turn.turned[i];
  if (turn.ofGuard.empty()) {
    for (std::size_t i = 0; i < n; ++i) z[i] += turn.within(i, turn.away);
  } else {
    double guard = turn.rest + turn.beyond, frame = 0;
    const std::vector<BoundedPolynomial> ofGuard = guardOfFrame(turn);
    for (std::size_t l = 0; l < n; ++l) guard += std::fabs(turn.ofGuard[l]) * before[l];
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t l = 0; l < n && total_[j] > 0; ++l) {
        if (turn.ofGuard[l] == 0) continue;
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

/// p, Ψ and what is loose at that moment of each: of those that have just turned with D and S + K (t - m(ξ)). Where
/// none turn, e1 holds at every time of the step.
void FlowStepper::evaluateAt(const BoundedPolynomial& moment, FlowPoint& point) const {
  const std::size_t n = at(n_), N = at(series_.count()), NJ = at(series_.frameCount()), orders = at(m_) + 1;
  const StepTurn* const turn = turn_ ? &*turn_ : nullptr;
  point.p.assign(n * N, 0.0);
  point.low.assign(n, 0.0);
  point.known.assign(n, 0.0);
  point.psi.assign(NJ * n * n, 0.0);
  point.psiSum.assign(n * n, 0.0);
  point.loose.assign(n, 0.0);
  point.total = total_;
  for (std::size_t i = 0; i < n; ++i) {
    BoundedPolynomial x;
    if (turn == nullptr || turn->fromMoment.empty()) {
      std::vector<BoundedPolynomial> u = ordersOf(series_, static_cast<int>(i), orders);
      for (std::size_t order = 0; turn != nullptr && order < orders; ++order) u[order] += turn->D[i][order];
      x = composed(monomials(), u, moment);
    } else {
      const std::vector<BoundedPolynomial>& u = turn->fromMoment[i];
      for (auto term = u.rbegin(); term != u.rend(); ++term) (x *= turn->lag / h0_) += *term;
    }
    x.c.resize(N, 0.0);
    std::ranges::copy(x.c, point.p.begin() + static_cast<std::ptrdiff_t>(i * N));
    point.loose[i] = x.error + (turn != nullptr ? turn->soon[i] : e1_[i]) + series_.lowNorm(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < n; ++i) {
    double size = 0;
    for (std::size_t j = 0; j < n; ++j) {
      if (total_[j] == 0) continue;
      BoundedPolynomial psi = frameAt(i, j, moment);
      if (turn != nullptr) {
        const double more = turn->K[i * n + j] * turn->lag;
        psi +=
            turn->saltationOf.empty() ? BoundedPolynomial{{turn->saltation[i * n + j]}} : turn->saltationOf[i * n + j];
        psi += {{more}};
        psi.error += 4 * bounds::unit * (std::fabs(more) + std::fabs(turn->K[i * n + j]) * theta_ * h0_);
      }
      double rest = psi.error, sum = 0;
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

void FlowStepper::advanceOnceTurned(FlowSet& set) { advanceTo(momentOnceTurned(), set); }

void FlowStepper::advanceToMeeting(FlowSet& set) { advanceTo(meeting_, set); }

void FlowStepper::advanceTo(const BoundedPolynomial& moment, FlowSet& set) {
  evaluateAt(moment, end_);
  evaluateRemainder(set, h_, end_);
  narrowArguments(set, h_, end_, {}, true);
  carryGenerators(set);
  BoundedPolynomial elapsed = moment;
  elapsed *= h0_;
  set.ahead.c.resize(series_.count(), 0.0);
  set.ahead += elapsed;
  // t moves on to about when the first of them are there: by whole units of time.
  const double first = (Interval(set.ahead.c[0]) - Interval(set.ahead.variation()) - Interval(set.ahead.error)).lower();
  const double passed = std::max(0.0, std::floor(first / resolution_)) * resolution_;
  set.t += passed;
  set.ahead += {{-passed}};
  set.arguments = argumentsBehind(true);
  endStep(set);
}

/// Linear in ξ, by least squares: of each state as a share of what it is at most.
bool FlowStepper::findMeeting(const std::vector<double>& weights) {
  constexpr double ofStep = 0.9, least = 0x1p-3, gain = 0.75;
  if (turn_ || isOpaque() || course_.isSliding || !inputs_.empty()) return false;
  const int symbols = monomials().symbols();
  std::vector<double> rates, beside;  // of each state; [state][symbol]
  double square = 0, before = 0, after = 0, spread = 0;
  for (int i = 0; i < n_; ++i) {
    if (weights[i] == 0) continue;
    const double size = std::max(scale_[i], bounds::tiny) / weights[i];
    const auto at = [&](const double* c, bool rate) {
      double value = 0, slope = 0;
      for (int order = m_; order >= 0; --order) {
        slope = slope * theta_ + value;
        value = value * theta_ + c[order];
      }
      return (rate ? slope : value) / size;
    };
    rates.push_back(at(series_.series(i), true));
    square += rates.back() * rates.back();
    for (int l = 0; l < symbols; ++l) {
      const int g = monomials().linear(l);
      beside.push_back(g < 0 ? 0.0 : at(series_.series(i) + g * series_.stride(), false));
    }
  }
  if (!(square > 0) || !std::isfinite(square)) return false;
  meeting_ = {std::vector<double>(monomials().count(), 0.0)};
  std::vector<double> moments;
  for (int l = 0; l < symbols; ++l) {
    double sum = 0;
    for (std::size_t i = 0; i < rates.size(); ++i) sum += rates[i] * beside[i * detail::at(symbols) + detail::at(l)];
    moments.push_back(monomials().linear(l) < 0 ? 0.0 : -sum / square);
    spread += std::fabs(moments.back());
  }
  const double share = std::min(1.0, 0.5 * ofStep * theta_ / spread);
  if (!(2 * share * spread > least * theta_)) return false;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    double own = 0, left = 0;
    for (int l = 0; l < symbols; ++l) {
      const double of = beside[i * detail::at(symbols) + detail::at(l)];
      own += std::fabs(of);
      left += std::fabs(of + share * moments[l] * rates[i]);
    }
    before += own * own;
    after += left * left;
  }
  if (!(after < gain * gain * before)) return false;
  // Within the step: from (1 - 1/64 - 0.9) θ to (1 - 1/64) θ.
  meeting_.c[0] = theta_ * (1 - 0x1p-6) - share * spread;
  for (int l = 0; l < symbols; ++l)
    if (const int g = monomials().linear(l); g >= 0) meeting_.c[g] = share * moments[l];
  return true;
}

double FlowStepper::radiusOver(int state, bool hasTurned) const {
  const std::size_t i = at(state);
  const double longest = turn_ && isSinceMoment() ? turn_->lag + 2 * turn_->away : h_ + (turn_ ? turn_->away : 0);
  double radius =
      series_.lowNorm(state) + (hasTurned ? crossed_[i] + turn_->leapt[i] + longest * bounds::up * turn_->turned[i]
                                : turn_   ? turn_->before[i]
                                          : e1_[i]);
  for (int j = 0; j < n_; ++j) radius += (series_.frameNorm(state, j) + epsilon_[state * n_ + j]) * total_[j];
  return radius * bounds::up + bounds::tiny;
}

}  // namespace gamut
