// Balancing and the series of the comparison system. Everything is nonnegative. Derivations: docs/flow.md, section 2.
#include "analyses/flow/step/growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/interval.hpp"

namespace gamut {

namespace {

constexpr int farthestUnit = 100;  // |unit|: entries of A stay far from underflow and overflow
constexpr int mostTerms = 1000;    // of a series; the norm is below 60, so that fewer do unless paths are very long
constexpr double negligible = 0x1p-40;  // a term, against the sum before it

/// Underflow: n products a term, each off by 2^-1075, carried on by at most e^60, with fewer than 2^10 states and
/// terms.
constexpr double underflow = 0x1p-960;

/// So much of h is the time in which a state that decays by itself does so, at most, where the sign of its rate counts:
/// of slower ones it wins little.
constexpr double hardlyDamped = 1;
constexpr double undamped = std::numeric_limits<double>::infinity();

}  // namespace

FlowGrowth::FlowGrowth(int n, int m) : n_(n), m_(m), unit_(static_cast<std::size_t>(n), 0) {
  for (auto* v : {&A_, &M0_, &M1_, &M2_, &X_, &power_, &next_}) v->assign(static_cast<std::size_t>(n * n), 0.0);
  for (auto* v : {&v_, &w_}) v->assign(static_cast<std::size_t>(n), 0.0);
  diagonal_.assign(static_cast<std::size_t>(n), undamped);
}

void FlowGrowth::setUnits(const std::vector<int>& units) {
  unit_ = units;
  unit_.resize(static_cast<std::size_t>(n_), 0);
  followed_ = 0;  // that of another set, in other units perhaps: nothing may depend on which sets a thread has met
}

/// X = D⁻¹ (Ah) D with D = diag 2^unit, exact but for the rounding of A h, such that the row and the column of a state
/// have sums alike up to a factor of 16 (Osborne; a change is made only if it lowers their sum, so it ends). Sums far
/// below one need no balance: `idle` is added to both, so that a state that nothing depends on does not run away.
/// Returns the largest row sum.
double FlowGrowth::balance(double h) {
  constexpr double idle = 0x1p-10;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) X_[at(i, j)] = std::ldexp(A_[at(i, j)] * h, unit_[j] - unit_[i]);
  for (int sweep = 0, changed = 1; changed != 0 && sweep < 40; ++sweep) {
    changed = 0;
    for (int i = 0; i < n_; ++i) {
      double row = idle, column = idle;
      for (int j = 0; j < n_; ++j)
        if (j != i) row += X_[at(i, j)], column += X_[at(j, i)];
      if (!std::isfinite(row + column)) return row + column;
      int& unit = unit_[i];
      const int tilt = std::ilogb(row) - std::ilogb(column);
      const int wanted = unit + (std::abs(tilt) < 4 ? 0 : tilt / 2);
      const int shift = std::clamp(wanted, -farthestUnit, farthestUnit) - unit;
      if (shift == 0) continue;
      unit += shift;
      changed = 1;
      const double larger = std::ldexp(1.0, shift), smaller = std::ldexp(1.0, -shift);
      for (int j = 0; j < n_; ++j)
        if (j != i) X_[at(i, j)] *= smaller, X_[at(j, i)] *= larger;
    }
  }
  double largest = 0;
  for (int i = 0; i < n_; ++i) {
    double row = 0;
    for (int j = 0; j < n_; ++j) row += X_[at(i, j)];
    if (!std::isfinite(row)) return row;
    largest = std::max(largest, row);
  }
  return largest;
}

void FlowGrowth::setCentre(const std::vector<double>& centre, const std::vector<double>& spread) {
  if (centre != centre_) centre_ = centre, followed_ = 0;
  spread_ = spread;
}

bool FlowGrowth::compute(double h) {
  const bool isBalanced = balance(h) * bounds::up < 60;
  double fastest = 0;
  for (const double rate : diagonal_) fastest = std::max(fastest, -rate * h);
  isDamped_ = isBalanced && fastest > hardlyDamped;
  const bool isComputed = isBalanced && (isDamped_ ? computeDamped(h) : computePlain(h));
  std::fill(diagonal_.begin(), diagonal_.end(), undamped);
  isAbout_ = false;
  if (centre_.empty() || isDamped_ || !(followed_ == h || follow(h))) return isComputed;
  const double plain = growth_;
  const std::vector<double> M0 = M0_, M1 = M1_, M2 = M2_;
  isAbout_ = computeAbout(h);
  if (!isComputed) return isAbout_;
  const auto meet = [&](std::vector<double>& into, const std::vector<double>& other) {
    for (std::size_t e = 0; e < into.size(); ++e) into[e] = isAbout_ ? std::min(into[e], other[e]) : other[e];
  };
  meet(M0_, M0);  // entry by entry: both bound one and the same linear system
  meet(M1_, M1);
  meet(M2_, M2);
  growth_ = isAbout_ ? std::min(growth_, plain) : plain;
  return true;
}

/// A few power iterations.
void FlowGrowth::estimateGrowth() {
  std::fill(v_.begin(), v_.end(), 1.0);
  for (int iteration = 0; iteration < 6; ++iteration) {
    growth_ = 0;
    for (int i = 0; i < n_; ++i) {
      double row = 0;
      for (int j = 0; j < n_; ++j) row += X_[at(i, j)] * v_[j];
      w_[i] = row;
      growth_ = std::max(growth_, row);
    }
    if (!(growth_ > 0)) break;
    for (std::size_t i = 0; i < v_.size(); ++i) v_[i] = w_[i] / growth_;
  }
}

bool FlowGrowth::computePlain(double h) {
  estimateGrowth();
  if (!sumSeries()) return false;
  for (int i = 0; i < n_; ++i) M0_[at(i, i)] += 1;
  toUnits(h);
  return true;
}

/// From balanced units, in which h is 1.
void FlowGrowth::toUnits(double h) {
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      const std::size_t e = at(i, j);
      const double back = std::ldexp(bounds::up, unit_[i] - unit_[j]);
      M2_[e] *= h * back;
      M1_[e] *= h * back;
      M0_[e] *= back;
    }
}

/// e^X - I, and the two integrals, in M0, M1 and M2.
bool FlowGrowth::sumSeries() {
  // P_k = X^k/(k+1)!; S0 = Σ_{k≥1} X^k/k!, S1 = Σ P_k, S2 = Σ c_k P_k with c_k = m!(k+1)!/(m+k+1)!, in M0, M1, M2.
  // Once P_k ≤ ε S1 and X S1 = S0 ≤ (k+1)/2 S1, entry by entry (S1 up to k-1, S0 up to k), P_{k+1} = X P_k/(k+2)
  // ≤ ε/2 S1 and so on: the terms beyond k add at most ε S1 to S1, 2ε S0 to S0, c_k ε S1 to S2.
  std::fill(M0_.begin(), M0_.end(), 0.0);
  std::fill(M1_.begin(), M1_.end(), 0.0);
  for (int i = 0; i < n_; ++i) M1_[at(i, i)] = 1;
  power_ = M2_ = M1_;
  double c = 1.0 / (m_ + 1);
  for (double& entry : M2_) entry *= c;
  for (int k = 1; k <= mostTerms; ++k) {
    c *= (k + 1.0) / (m_ + k + 1);
    std::fill(next_.begin(), next_.end(), 0.0);
    for (int i = 0; i < n_; ++i)
      for (int l = 0; l < n_; ++l) {
        const double x = X_[at(i, l)] / (k + 1);
        if (x == 0) continue;
        for (int j = 0; j < n_; ++j) next_[at(i, j)] += x * power_[at(l, j)];
      }
    power_.swap(next_);
    Work::count(Work::matrixTerm, static_cast<double>(n_) * n_ * (n_ + 4));
    bool small = true;
    for (std::size_t e = 0; e < power_.size(); ++e) {
      M0_[e] += (k + 1) * power_[e];
      small = small && power_[e] <= negligible * M1_[e] && 2 * M0_[e] <= (k + 1) * M1_[e];
      M1_[e] += power_[e];
      M2_[e] += c * power_[e];
    }
    if (!small) continue;
    constexpr double rest = 1 + 4 * negligible;
    for (std::size_t e = 0; e < power_.size(); ++e) {
      M2_[e] = (M2_[e] + c * 2 * negligible * M1_[e] + underflow) * bounds::up;
      M1_[e] = (M1_[e] * rest + underflow) * bounds::up;
      M0_[e] = (M0_[e] * rest + underflow) * bounds::up;
    }
    return true;
  }
  return false;
}

/// By powers of it.
double FlowGrowth::exponentOf(const std::vector<double>& matrix) {
  v_.assign(v_.size(), 1.0);
  double exponent = 0;
  for (int iteration = 0; iteration < 4; ++iteration) {
    double most = 0;
    for (int i = 0; i < n_; ++i) {
      double row = 0;
      for (int j = 0; j < n_; ++j) row += matrix[at(i, j)] * v_[j];
      w_[i] = row;
      most = std::max(most, row);
    }
    exponent = std::max(0.0, std::log(most));
    for (std::size_t i = 0; i < v_.size(); ++i) v_[i] = w_[i] / most;
  }
  return exponent;
}

/// The greatest sum of a row.
double FlowGrowth::normOf(const std::vector<double>& a) const {
  double most = 0;
  for (int i = 0; i < n_; ++i) {
    double row = 0;
    for (int j = 0; j < n_; ++j) row += std::fabs(a[at(i, j)]);
    most = std::isfinite(row) ? std::max(most, row) : row;
  }
  return most * bounds::up;
}

/// e^{Z/K} by the series to order 12: with ‖Z/K‖ ≤ 1/4 what is left is below (1/4)^13/13!/(1 - 1/4), 3e-18.
std::vector<double> FlowGrowth::exponentialOf(const std::vector<double>& Z, int K) {
  std::vector<double> E(Z.size(), 0.0);
  for (int i = 0; i < n_; ++i) E[at(i, i)] = 1;
  power_ = E;
  constexpr int orders = 12;
  for (int i = 1; i <= orders; ++i) {
    multiply(Z, power_, next_);
    for (std::size_t e = 0; e < E.size(); ++e) {
      power_[e] = next_[e] / (i * static_cast<double>(K));
      E[e] += power_[e];
    }
  }
  return E;
}

/// About Z = centre h: P ≥ |e^{Zt}| at every time t of [0, 1], Q1 ≥ ∫ |e^{Zt}|, Q2 ≥ ∫ |e^{Zt}| (1 - t)^m. F_j,
/// computed powers of a series over 1/K, are off by no more than `off` in any row; between two of them an entry g of
/// e^{Zt} leaves its chord by 1/(8K²) max|g''|, and g'' = Z² F_j e^{Zs} with |e^{Zs} - I| ≤ e^{‖Z‖/K} - 1 in any row.
bool FlowGrowth::follow(double h) {
  const double u = 3 * (n_ + 4) * bounds::unit;  // of a product, and sums of its size
  std::vector<double> Z(centre_.size());
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) Z[at(i, j)] = std::ldexp(centre_[at(i, j)] * h, unit_[j] - unit_[i]);
  const double size = normOf(Z);
  constexpr double farthest = 16, piece = 0.25;
  if (!(size < farthest)) return false;
  const int K = 1 << std::max(3, std::ilogb(size / piece) + 1);
  const std::vector<double> E = exponentialOf(Z, K);
  std::vector<double> F(Z.size(), 0.0), square, turned;
  for (int i = 0; i < n_; ++i) F[at(i, i)] = 1;
  // Term i has i products of n terms, with as many roundings more: (n + 2) u i ‖Z/K‖^i/i!, together below (n + 2) u;
  // the rounding of Z itself u ‖Z/K‖ e^{‖Z/K‖}, those of the sum 12 u e^{‖Z/K‖}.
  const double first = u + 16 * bounds::unit + 4e-18, step = normOf(E);
  const double turn = std::exp(size / K) * bounds::up - 1 + 0x1p-40;
  multiply(Z, Z, square);
  const double bend = 1.0 / (8.0 * K * K);
  P_ = F;
  Q1_.assign(F.size(), 0.0);
  Q2_ = Q1_;
  double off = 0, before = 1;  // (1 - t)^{m+1}
  followed_ = 0;
  for (int k = 1; k <= K; ++k) {
    multiply(square, F, turned);
    const double after = k == K ? 0.0 : std::pow(1 - static_cast<double>(k) / K, m_ + 1);
    const double weight = ((before - after) / (m_ + 1)) * bounds::up + 0x1p-50 * before;
    before = after;
    const double now = normOf(F), behindOff = (step * (off + u * now) + first * (now + off)) * bounds::up;
    multiply(E, F, next_);
    for (int i = 0; i < n_; ++i) {
      double row = 0;
      for (int j = 0; j < n_; ++j) row += std::fabs(turned[at(i, j)]);
      for (int j = 0; j < n_; ++j) {
        const std::size_t e = at(i, j);
        // Z² F_j: two products, and F_j's own error.
        const double second = std::fabs(turned[e]) + turn * row + size * size * (2 * u * now + off) * (1 + turn);
        const double leaves = bend * second + std::max(off, behindOff);
        const double a = std::fabs(F[e]), b = std::fabs(next_[e]), most = (std::max(a, b) + leaves) * bounds::up;
        P_[e] = std::max(P_[e], most);
        Q1_[e] += (0.5 * (a + b) + leaves) / K * bounds::up;
        Q2_[e] += most * weight;
      }
    }
    off = behindOff;
    F.swap(next_);
  }
  for (const double entry : P_)
    if (!(entry < bounds::largest)) return false;
  followed_ = h;
  followedUnit_ = unit_;
  return true;
}

/// y' = J y - δ about a centre Z, |J - Z| ≤ N: y = e^{Zt} y(0) + ∫ e^{Z(t-s)} ((J - Z) y - δ), so |y| stays below w
/// with w = P |y(0)| + ∫ |e^{Z(t-s)}| |δ| + G ∫ w, G = P N. By Picard's iteration, ∫_0^t |e^{Zs}| ds ≤ P t and so on,
///     M0 = e^G P,   M1 = Q1 + Σ_{k≥1} G^k/(k+1)! P,   M2 = Q2 + Σ_{k≥1} G^k m!/(m+k+1)! P .
bool FlowGrowth::computeAbout(double h) {
  const auto inUnits = [&](const std::vector<double>& a, std::vector<double>& to) {
    to.resize(a.size());
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) {
        const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
        to[at(i, j)] = std::ldexp(a[at(i, j)], followedUnit_[row] - unit_[row] + unit_[column] - followedUnit_[column]);
      }
  };
  std::vector<double> P, Q1, Q2, N(spread_.size());
  inUnits(P_, P);
  inUnits(Q1_, Q1);
  inUnits(Q2_, Q2);
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) N[at(i, j)] = std::ldexp(spread_[at(i, j)] * h, unit_[j] - unit_[i]);
  multiply(P, N, X_);
  for (int i = 0; i < n_; ++i) {
    double row = 0;
    for (int j = 0; j < n_; ++j) row += X_[at(i, j)] *= bounds::up;
    if (!(row < 60)) return false;
  }
  if (!sumSeries()) return false;
  std::vector<double> more;
  for (int i = 0; i < n_; ++i) {
    M0_[at(i, i)] += 1;
    M1_[at(i, i)] = std::max(0.0, M1_[at(i, i)] - 1 + 0x1p-52);
    M2_[at(i, i)] = std::max(0.0, M2_[at(i, i)] - 1.0 / (m_ + 1) + 0x1p-52);
  }
  multiply(M0_, P, more);
  growth_ = exponentOf(more);
  for (std::size_t e = 0; e < more.size(); ++e) M0_[e] = more[e] * bounds::up + underflow;
  multiply(M1_, P, more);
  for (std::size_t e = 0; e < more.size(); ++e) M1_[e] = (Q1[e] + more[e]) * bounds::up + underflow;
  multiply(M2_, P, more);
  for (std::size_t e = 0; e < more.size(); ++e) M2_[e] = (Q2[e] + more[e]) * bounds::up + underflow;
  toUnits(h);
  return true;
}

void FlowGrowth::multiply(const std::vector<double>& a, const std::vector<double>& b,
                          std::vector<double>& product) const {
  product.assign(a.size(), 0.0);
  for (int i = 0; i < n_; ++i)
    for (int l = 0; l < n_; ++l) {
      const double x = a[at(i, l)];
      if (x == 0) continue;
      for (int j = 0; j < n_; ++j) product[at(i, j)] += x * b[at(l, j)];
    }
  Work::count(Work::matrixTerm, static_cast<double>(n_) * n_ * n_);
}

/// B = X - rate, in units of h, whose off-diagonal entries are not negative: |y_i|' ≤ B_ii |y_i| + Σ_{j≠i} B_ij |y_j| +
/// δ_i is all that is asked for. e^{Bt} ≥ 0, so ∫_0^t e^{Bs} grows with t, and at every time e^{Bt} = I + B ∫_0^t
/// e^{Bs} is no more than I + B⁺ ∫_0^1 e^{Bs}, B⁺ without what is negative in the diagonal. (1 - t)^m ≤ e^{-mt} for the
/// last of them.
bool FlowGrowth::computeDamped(double h) {
  std::vector<double> own(static_cast<std::size_t>(n_));  // B_ii h
  double rate = 0;
  for (int i = 0; i < n_; ++i) {
    own[i] = std::min(diagonal_[i] * h, X_[at(i, i)]);
    rate = std::max(rate, -own[i]);
  }
  if (!(rate < 1000)) return false;
  for (int i = 0; i < n_; ++i) {
    const double b = own[i];
    X_[at(i, i)] = std::max(0.0, b + rate) + (std::fabs(b) + rate) * 0x1p-50;
  }
  integrate(rate, M0_, M1_);
  growth_ = exponentOf(M0_);
  integrate(rate + m_, power_, M2_);
  for (int i = 0; i < n_; ++i) X_[at(i, i)] = std::max(0.0, own[i]) * bounds::up;
  multiply(X_, M1_, M0_);
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      const std::size_t e = at(i, j);
      const double back = std::ldexp(bounds::up, unit_[i] - unit_[j]);
      if (!std::isfinite(M0_[e] + M1_[e] + M2_[e])) return false;
      M2_[e] = (M2_[e] + underflow) * bounds::up * h * back;
      M1_[e] = (M1_[e] + underflow) * bounds::up * h * back;
      M0_[e] = (M0_[e] + underflow + (i == j ? 1.0 : 0.0)) * bounds::up * back;
    }
  return true;
}

/// e^{X - rate} and ∫ e^{(X - rate)t} over t in [0, 1], X ≥ 0, rate ≥ 0. First over s = 2^-k, with both X s and rate s
/// small. e^{-rate t} ≤ 1 - (1 - e^{-rate s}) t/s, its chord, so
///     ∫ t^i/i! e^{-rate t} ≤ s^{i+1}/(i+1)! (1 - (1 - e^{-rate s}) (i+1)/(i+2)) ,
/// and what is left of the series adds at most a share of `negligible`, as in sumSeries. Then over twice as long, k
/// times: E ← E², I ← I + E I. All of it is nonnegative; relative errors are doubled and n + 2 roundings added: with
/// k ≤ 11 these are fewer than 2^22 in all for a thousand states.
void FlowGrowth::integrate(double rate, std::vector<double>& exponential, std::vector<double>& integral) {
  double largest = rate;
  for (int i = 0; i < n_; ++i) {
    double row = 0;
    for (int j = 0; j < n_; ++j) row += X_[at(i, j)];
    largest = std::max(largest, row);
  }
  constexpr int fewest = 2;  // X s and rate s below 2^-fewest
  const int doublings = std::max(0, std::ilogb(std::max(largest, 0x1p-20)) + 1 + fewest);
  const double s = std::ldexp(1.0, -doublings);
  const double decay = exp(Interval(-rate * s)).upper(), lost = std::max(0.0, 1 - decay) * bounds::down;
  std::vector<double> power(X_.size(), 0.0), next;  // (X s)^i/i!
  for (int i = 0; i < n_; ++i) power[at(i, i)] = 1;
  exponential = power;
  integral.assign(X_.size(), 0.0);
  for (std::size_t e = 0; e < power.size(); ++e) integral[e] = power[e] * (1 - lost / 2);
  std::vector<double> times(X_.size(), 0.0);  // X s E = Σ i P_i
  bool isSmall = false;
  for (int i = 1; !isSmall; ++i) {
    multiply(X_, power, next);
    const double kept = 1 - lost * (i + 1) / (i + 2);
    isSmall = true;
    for (std::size_t e = 0; e < power.size(); ++e) {
      power[e] = next[e] * s / i;
      times[e] += i * power[e];
      isSmall = isSmall && power[e] <= negligible * exponential[e] && 2 * times[e] <= (i + 1) * exponential[e];
      exponential[e] += power[e];
      integral[e] += power[e] * kept / (i + 1);
    }
    if (i > mostTerms) isSmall = true, exponential[0] = std::nan("");
  }
  constexpr double rest = 1 + 4 * negligible;
  for (std::size_t e = 0; e < power.size(); ++e) {
    exponential[e] = exponential[e] * decay * rest + underflow;
    integral[e] = integral[e] * s * rest + underflow;
  }
  for (int k = 0; k < doublings; ++k) {
    multiply(exponential, integral, next);
    for (std::size_t e = 0; e < next.size(); ++e) integral[e] += next[e];
    multiply(exponential, exponential, next);
    exponential.swap(next);
  }
}

}  // namespace gamut
