// The certificate: bounds for what the recursion left out and rounded, node by node. Notation as in docs/flow.md:
// ‖a‖ = Σ|c_{iα}|θ^i, ‖a‖_w = Σ (i+1)∏(α_l+1)|c_{iα}|θ^i, T_a[q][i] = Σ_{grade α = q} |c_{iα}|θ^i, u = 2^-53.
// All quantities are nonnegative and computed in round-to-nearest; `bounds::up` then covers the
// roundings of the bound itself.
#include <algorithm>
#include <cmath>

#include "analyses/flow/error_bounds.hpp"
#include "analyses/flow/kernels.hpp"
#include "analyses/flow/polynomial_series.hpp"

namespace gamut {

bool PolynomialSeries::tabulate(double theta) {
  power_[0] = 1;
  for (int i = 1; i < stride_; ++i) power_[at(i)] = i < m_ ? power_[at(i - 1)] * theta : 0.0;
  for (int i = 0; i < stride_; ++i) weights_[at(i)] = (i + 1) * power_[at(i)];
  const double last = power_[at(m_ - 1)] * theta;  // θ^m
  for (std::size_t x = 0; x < plan_.size(); ++x) {
    const Plan& v = plan_[x];
    double* table = &t_[v.t];
    kernels::tabulate(*monomials_, v.count, &f_[v.f], power_.data(), weights_.data(), stride_, table, norm_[x],
                      weighted_[x]);
    norm_[x] *= bounds::up;
    weighted_[x] *= bounds::up;
    if (!(norm_[x] < bounds::largest)) return refuse(static_cast<int>(x));  // for NaN too
    double* total = &total_[x * at(stride_)];
    std::fill(total, total + stride_, 0.0);
    for (int q = 0; q <= v.degree; ++q)
      for (int i = 0; i < stride_; ++i) total[i] += table[q * stride_ + i];
    if (v.op == Op::state) {
      double sum = 0;
      for (int g = 0; g < v.count; ++g) sum += std::fabs(f_[v.f + at(g * stride_ + m_)]);
      top_[x] = withFrame_ ? sum * last * bounds::up : 0.0;
      if (!(top_[x] < bounds::largest)) return refuse(static_cast<int>(x));
    }
    if (!v.needsTails) continue;
    // s1[i] = Σ_{j ≥ m-i} total[j];  s2[q][i] = Σ_{p ≥ q} Σ_{j ≤ m-1-i} T[p][j].
    double* s1 = &s1_[x * at(stride_)];
    std::fill(s1, s1 + stride_, 0.0);
    for (int i = 1; i < m_; ++i) s1[i] = s1[i - 1] + total[m_ - i];
    if (monomials_->degree() == 0) continue;
    double* s2 = &s2_[v.s2];
    std::fill(s2 + (v.degree + 1) * stride_, s2 + (v.degree + 2) * stride_, 0.0);
    for (int q = v.degree; q >= 0; --q) {
      double* row = s2 + q * stride_;
      std::fill(row, row + stride_, 0.0);
      double sum = 0;
      for (int i = m_ - 1; i >= 0; --i) row[i] = (sum += table[q * stride_ + m_ - 1 - i]);
      for (int i = 0; i < m_; ++i) row[i] += row[stride_ + i];
    }
  }
  for (System& system : systems_) {
    goOnUnlessCancelled();
    tabulateSystem(system);
  }
  for (int x = 0; x < nodes_; ++x) {
    goOnUnlessCancelled();
    ownErrors(x);
  }
  return true;
}

bool PolynomialSeries::reachesHighestGrades(double share) const {
  const int last = monomials_->degree();
  for (std::size_t x = 0; x < plan_.size(); ++x) {
    const Plan& v = plan_[x];
    double mass = 0;
    for (int q = std::max(last - 1, 1); q <= v.degree; ++q)
      for (int i = 0; i < stride_; ++i) mass += t_[v.t + at(q * stride_ + i)];
    if (mass > share * norm_[x]) return true;
  }
  return false;
}

/// Σ_{i+j ≥ m} T_a[i] T_b[j]: orders of a product that are not kept.
double PolynomialSeries::tailTime(int a, int b) const {
  return kernels::dot(&total_[at(a) * at(stride_)], &s1_[at(b) * at(stride_)], stride_);
}

/// Σ_{i ≥ fromOrder, i+j < m, p+q > degree} T_a[p][i] T_b[q][j]: grades of a product that are not kept.
double PolynomialSeries::tailDegree(int a, int b, int degree, int fromOrder) const {
  const Plan& pa = plan_[at(a)];
  const Plan& pb = plan_[at(b)];
  double sum = 0;
  for (int p = 0; p <= pa.degree; ++p) {
    const int q = std::max(0, degree + 1 - p);
    if (q > pb.degree) continue;
    const double* row = &t_[pa.t + at(p * stride_)];
    const double* tail = &s2_[pb.s2 + at(q * stride_)];
    if (fromOrder == 0)
      sum += kernels::dot(row, tail, stride_);
    else
      for (int i = fromOrder; i < m_; ++i) sum += row[i] * tail[i];
  }
  return sum;
}

/// Σ_{p ≥ 1, p+q > degree} T_a[p][0] T_b[q][0]: the same along ξ at σ = 0.
double PolynomialSeries::tailRow(int a, int b, int degree) const {
  const Plan& pa = plan_[at(a)];
  const Plan& pb = plan_[at(b)];
  double sum = 0, tail = 0;
  int q = pb.degree + 1;
  for (int p = 1; p <= pa.degree; ++p) {
    for (; q > std::max(0, degree + 1 - p); --q) tail += t_[pb.t + at((q - 1) * stride_)];
    sum += t_[pa.t + at(p * stride_)] * tail;
  }
  return sum;
}

/// Σ_{grade > degree} of a: what a node of lower degree drops.
double PolynomialSeries::dropped(int a, int degree) const {
  double sum = 0;
  for (int q = degree + 1; q <= plan_[at(a)].degree; ++q)
    for (int i = 0; i < m_; ++i) sum += t_[plan_[at(a)].t + at(q * stride_ + i)];
  return sum;
}

/// A proved lower bound of |ṽ| when its constant coefficient is positive: |c_00| minus everything else.
double PolynomialSeries::minimum(int node) const {
  const double lead = f_[plan_[at(node)].f];
  return (2 * lead - norm_[at(node)]) * bounds::down - bounds::tiny;
}

/// Σ_{(i,α)≠0} |c_{iα}| θ^i: how far ṽ goes from its constant coefficient, and along the way there: the integral of
/// |ṽ'| from ξ = 0, σ = 0 over ξ at σ = 0 and then over σ.
double PolynomialSeries::rest(int node) const {
  const Plan& v = plan_[at(node)];
  double sum = moved(node);
  for (int q = 1; q <= v.degree; ++q) sum += t_[v.t + at(q * stride_)];
  return sum * bounds::up;
}

/// The part of rest() that is over σ.
double PolynomialSeries::moved(int node) const {
  double sum = 0;
  for (int i = 1; i < m_; ++i) sum += total_[at(node) * at(stride_) + at(i)];
  return sum;
}

/// The same as rest() of ‖·‖_w. (A difference of ‖·‖_w and the constant coefficient would be off by what bounds::up
/// adds.)
double PolynomialSeries::weightedRest(int node) const {
  const Plan& v = plan_[at(node)];
  double sum = 0;
  for (int g = 0; g < v.count; ++g)
    for (int i = g == 0 ? 1 : 0; i < m_; ++i)
      sum += weights_[at(i)] * monomials_->multiplicity(g) * std::fabs(f_[v.f + at(g * stride_ + i)]);
  return sum * bounds::up;
}

/// Bounds of the defect of v' = u'·of (for sine, cosine, exponential, tanh), integrated over [0, θ], and of the row σ =
/// 0. Rounding: a coefficient has N terms, one rounding in j·u_j and one in the division: γ_{N+2}, N ≤ weights.
void PolynomialSeries::differentialErrors(int u, int of, int degree, double& e0, double& e1) const {
  const double norm = rest(u), weighted = weighted_[at(u)] - leading(u) * bounds::down;
  e1 = tailTime(u, of);  // the row i = 0 of u meets s1[0] = 0
  e0 = bounds::unit * (weighted * weighted_[at(of)] + 2 * norm * norm_[at(of)]);
  if (monomials_->degree() > 0)
    // The row σ = 0 rounds likewise, with the weights of its own (smaller) terms.
    e0 += tailDegree(u, of, degree, 1) + tailRow(u, of, degree) +
          bounds::unit * (weighted * weighted_[at(of)] + 2 * norm * norm_[at(of)]);
}

/// Σ |target - left·right| over the kept coefficients, with the rounding of this evaluation: γ_{N+1}(|target|+Σ|..|),
/// N + 1 ≤ 2N ≤ 2 weights. target -1 is the constant 1.
double PolynomialSeries::productResidual(int left, int right, int target) {
  const Plan& l = plan_[at(left)];
  const int N = l.count;
  double* out = scratch_.data();
  double sum = 0;
  const int orders = l.invariant ? 1 : m_;
  for (int i = 0; i < orders; ++i) {
    std::fill(out, out + N, 0.0);
    kernels::convolve(monomials_->pairs().data(), monomials_->first().data(), N, &f_[l.f], &r_[plan_[at(right)].r],
                      stride_, i, out);
    for (int g = 0; g < N; ++g) {
      const double wanted =
          target >= 0 ? f_[plan_[at(target)].f + at(g * stride_ + i)] : (g == 0 && i == 0 ? 1.0 : 0.0);
      sum += std::fabs(wanted - out[g]) * power_[at(i)];
    }
  }
  return sum +
         2 * bounds::unit * (weighted_[at(left)] * weighted_[at(right)] + (target >= 0 ? weighted_[at(target)] : 1.0));
}

/// Σ |i u_i - Σ_j j l_j w_{i-j}| / i over the kept coefficients of l' w = u', and the row σ = 0 likewise in the grades;
/// rounding γ_{N+2} of (|u| + Σ|l||w|) for each of the two, N + 2 ≤ 3 weights.
double PolynomialSeries::quotientResidual(int node) {
  const Plan& l = plan_[at(node)];
  const Plan& u = plan_[at(l.a)];
  const Plan& w = plan_[at(l.b)];
  const int N = l.count;
  double* out = scratch_.data();
  double sum = 0;
  for (int i = 1; i < (l.invariant ? 1 : m_); ++i) {
    std::fill(out, out + N, 0.0);
    kernels::convolve(monomials_->pairs().data(), monomials_->first().data(), N, &d_[l.d], &r_[w.r], stride_, i, out);
    for (int g = 0; g < N; ++g) sum += std::fabs(i * f_[u.f + at(g * stride_ + i)] - out[g]) / i * power_[at(i)];
  }
  for (int g = 1; g < N; ++g) {
    double s = 0;
    for (auto q = monomials_->first()[at(g)]; q < monomials_->first()[at(g) + 1]; ++q)
      if (const auto [p, r] = monomials_->pairs()[at(q)]; p != 0)
        s += monomials_->grade(p) * f_[l.f + at(p * stride_)] * f_[w.f + at(r * stride_)];
    const int grade = monomials_->grade(g);
    sum += std::fabs(grade * f_[u.f + at(g * stride_)] - s) / grade;
  }
  return sum + 6 * bounds::unit * (weighted_[at(l.a)] + weighted_[at(node)] * weighted_[at(l.b)]);
}

/// What a node adds to the errors of its operands.
void PolynomialSeries::ownErrors(int node) {
  const Plan& v = plan_[at(node)];
  double e0 = 0, e1 = 0;
  const bool graded = monomials_->degree() > 0;
  switch (v.op) {
    case Op::state:
    case Op::parameter:
    case Op::time:
    case Op::constant:
    case Op::cos:
    case Op::sech2:
      return;
    case Op::solution:
      if (v.b == 0) solutionOwnErrors(node);
      return;
    case Op::add:
    case Op::sub:  // one rounding a coefficient; lower degree: what is dropped
      e0 = bounds::unit * norm_[at(node)] + (graded ? dropped(v.a, v.degree) + dropped(v.b, v.degree) : 0.0);
      break;
    case Op::neg:
      e0 = graded ? dropped(v.a, v.degree) : 0.0;
      break;
    case Op::mul:
    case Op::sqr: {
      const int b = v.op == Op::sqr ? v.a : v.b;
      // A coefficient is a sum of N ≤ (i+1)∏(α_l+1) products in any order, fused or not: γ_N. A constant factor: one.
      e0 = plan_[at(v.a)].constant ? bounds::unit * norm_[at(node)]
                                   : bounds::unit * weighted_[at(v.a)] * weighted_[at(b)];
      if (graded) e0 += tailDegree(v.a, b, v.degree, 0);
      e1 = tailTime(v.a, b);
      break;
    }
    case Op::recip:
      e0 = productResidual(node, v.a, -1) + (graded ? tailDegree(node, v.a, v.degree, 0) : 0.0);
      e1 = tailTime(node, v.a);
      break;
    case Op::sqrt:
      e0 = productResidual(node, node, v.a) +
           (graded ? tailDegree(node, node, v.degree, 0) + dropped(v.a, v.degree) : 0.0);
      e1 = tailTime(node, node);
      break;
    case Op::exp:
      differentialErrors(v.a, node, v.degree, e0, e1);
      e0 += pointError_[at(node)];
      break;
    case Op::log:
    case Op::atan:
      e0 = quotientResidual(node);
      if (graded) e0 += tailDegree(node, v.b, v.degree, 1) + tailRow(node, v.b, v.degree) + dropped(v.a, v.degree);
      e1 = tailTime(node, v.b);
      break;
    case Op::sin: {  // both from one skew system: the error's Euclidean norm grows by no more than both defects
      double c0 = 0, c1 = 0;
      differentialErrors(v.a, node + 1, v.degree, e0, e1);
      differentialErrors(v.a, node, v.degree, c0, c1);
      e0 += c0 + pointError_[at(node)] + pointError_[at(node + 1)];
      e1 += c1;
      own0_[at(node + 1)] = e0 * bounds::up + bounds::tiny;
      own1_[at(node + 1)] = e1 * bounds::up;
      break;
    }
    case Op::tanh: {
      // κ = |s̃ - (1 - t̂²)|, t̂ = t̃ + tanh u_00 - t_00: the constants of both cancel but for their own errors, and the
      // others are sums of N ≤ weights products, in which t_00 meets only what is not constant.
      const double weighted = weightedRest(node);
      const double kappa0 = pointError_[at(node + 1)] + 2 * pointError_[at(node)] * rest(node) +
                            bounds::unit * weighted * (2 * leading(node) + weighted) +
                            (graded ? tailDegree(node, node, v.degree, 0) : 0.0);
      const double kappa1 = tailTime(node, node);
      own0_[at(node + 1)] = kappa0 * bounds::up + bounds::tiny;
      own1_[at(node + 1)] = kappa1 * bounds::up;
      differentialErrors(v.a, node + 1, v.degree, e0, e1);
      e0 += rest(v.a) * own0_[at(node + 1)];
      e1 += rest(v.a) * own1_[at(node + 1)];
      break;
    }
  }
  own0_[at(node)] = e0 * bounds::up + bounds::tiny;
  own1_[at(node)] = e1 * bounds::up;
}

bool PolynomialSeries::boundNode(int node) {
  const Plan& v = plan_[at(node)];
  const auto r0 = [&](int i) { return rho0_[at(i)]; };
  const auto r1 = [&](int i) { return rho1_[at(i)]; };
  const auto r = [&](int i) { return rho0_[at(i)] + rho1_[at(i)]; };
  const double own0 = own0_[at(node)], own1 = own1_[at(node)];
  double z0 = 0, z1 = 0;
  switch (v.op) {
    case Op::state:
    case Op::parameter:
    case Op::time:
    case Op::constant:
      return true;
    case Op::sech2:  // with its tanh
      return rho0_[at(node)] + rho1_[at(node)] < bounds::largest;
    case Op::solution:
      return v.b > 0 || boundSolution(node);
    case Op::add:
    case Op::sub:
      z0 = r0(v.a) + r0(v.b) + own0;
      z1 = r1(v.a) + r1(v.b);
      break;
    case Op::neg:
      z0 = r0(v.a) + own0;
      z1 = r1(v.a);
      break;
    case Op::mul:
    case Op::sqr: {  // ab - ãb̃ = ã δb + b̃ δa + δa δb
      const int b = v.op == Op::sqr ? v.a : v.b;
      z0 = norm_[at(v.a)] * r0(b) + norm_[at(b)] * r0(v.a) + r(v.a) * r(b) + own0;
      z1 = norm_[at(v.a)] * r1(b) + norm_[at(b)] * r1(v.a) + own1;
      break;
    }
    case Op::recip: {  // |1 - c̃b| ≤ η < 1 proves b ≠ 0, and |1/b - c̃| = |1 - c̃b|/|b| ≤ η‖c̃‖/(1-η)
      const double eta0 = own0 + norm_[at(node)] * r0(v.a), eta1 = own1 + norm_[at(node)] * r1(v.a);
      const double eta = (eta0 + eta1) * bounds::up;
      if (!(eta < 0.99)) return false;
      const double factor = norm_[at(node)] / (1 - eta);
      z0 = eta0 * factor;
      z1 = eta1 * factor;
      break;
    }
    case Op::sqrt: {  // |√b - s̃| = |b - s̃²|/(√b + s̃)
      const double bMin = minimum(v.a) - r(v.a) * bounds::up, sMin = minimum(node);
      if (!(bMin > 0 && sMin > 0)) return false;
      const double below = (sMin + std::sqrt(bMin)) * bounds::down;
      z0 = (own0 + r0(v.a)) / below;
      z1 = (own1 + r1(v.a)) / below;
      break;
    }
    case Op::exp: {
      // ẽ' = ũ'ẽ + defect grows by at most e^{osc}, osc ≤ 2 Σ_{(i,α)≠0}|u_{iα}|θ^i; e^{u} - e^{ũ}: (e^ρ-1) ≤ e^ρ ρ.
      const double way = rest(v.a);
      if (!(way < 300 && r(v.a) < 300)) return false;
      const double growth = exp(Interval(2 * way * bounds::up)).upper();
      const double tilt = (norm_[at(node)] + (own0 + own1) * growth) * exp(Interval(r(v.a) * bounds::up)).upper();
      z0 = own0 * growth + tilt * r0(v.a);
      z1 = own1 * growth + tilt * r1(v.a);
      break;
    }
    case Op::log: {  // defect over min|ũ|, and |log u - log ũ| ≤ ρ_u / min|u|
      const double below = (minimum(v.a) - r(v.a) * bounds::up) * bounds::down;
      if (!(below > 0)) return false;
      z0 = pointError_[at(node)] + (own0 + r0(v.a)) / below;
      z1 = (own1 + r1(v.a)) / below;
      break;
    }
    case Op::atan: {  // 1 + ũ² ≥ 1; w̃ is off 1 + ũ² by its own bound and by u² - ũ²; |atan u - atan ũ| ≤ ρ_u
      const double offW = r(v.b) + (2 * norm_[at(v.a)] + r(v.a)) * r(v.a);
      z0 = pointError_[at(node)] + own0 + norm_[at(node)] * offW + r0(v.a);
      z1 = own1 + r1(v.a);
      break;
    }
    case Op::sin:
    case Op::cos:
      z0 = own0 + r0(v.a);
      z1 = own1 + r1(v.a);
      break;
    case Op::tanh:
      boundTanh(node);
      return rho0_[at(node)] + rho1_[at(node)] < bounds::largest;
  }
  rho0_[at(node)] = z0 * bounds::up + bounds::tiny;
  rho1_[at(node)] = z1 * bounds::up;
  return rho0_[at(node)] + rho1_[at(node)] < bounds::largest;
}

/// tanh and sech² of u. T = tanh ũ and t̂ = t̃ + tanh u_00 - t_00 are equal where the path of rest() begins; from there
/// on e = t̂ - T obeys e' = defect + ũ'(s̃ - (1 - t̂²)) - ũ'(t̂ + T) e, the first two of which are own, and |t̂ + T| ≤ 2|T|
/// + |e|. With V = rest(u), |T| ≤ |ũ| ≤ |u_00| + V and Δ = own·e^{2V|T|}: |e| ≤ Δ e^{2VΔ} as long as that is below 2Δ.
/// Besides, tanh u and tanh u_00 are less than 2e^{-2a} apart, if |u| ≥ a for all u and they have one sign (a = 0: or
/// not), and 0 < sech² u ≤ 4e^{-2a}: bounds that hold whatever the polynomials are.
void PolynomialSeries::boundTanh(int node) {
  const int u = plan_[at(node)].a, slope = node + 1;
  const auto upperExp = [](double x) { return exp(Interval(x)).upper(); };
  const double V = rest(u) * bounds::up, rho = (rho0_[at(u)] + rho1_[at(u)]) * bounds::up;
  const double least = std::max(0.0, (leading(u) - V - rho) * bounds::down - bounds::unit * leading(u));
  const double decay = upperExp(-2 * least), steepest = std::min(1.0, 4 * decay);
  const auto set = [&](int which, double z0, double z1, double whatever) {
    const bool isProved = z0 + z1 <= whatever;
    rho0_[at(which)] = (isProved ? z0 : whatever) * bounds::up + bounds::tiny;
    rho1_[at(which)] = isProved ? z1 * bounds::up : 0.0;
    return isProved;
  };
  double growth = upperExp(2 * V * std::min(1.0, leading(u) + V) * bounds::up);
  const double delta = (own0_[at(node)] + own1_[at(node)]) * growth * bounds::up;
  growth *= 2 * V * delta <= 0.69 ? upperExp(2 * V * delta * bounds::up) : HUGE_VAL;
  const double e0 = own0_[at(node)] * growth, e1 = own1_[at(node)] * growth;
  const double range = rest(node) + 2 * decay;
  const bool isFollowed = set(node, pointError_[at(node)] + e0 + steepest * rho0_[at(u)], e1 + steepest * rho1_[at(u)],
                              pointError_[at(node)] + range);
  if ((isFollowed ? e0 : range) > bounds::unit) {
    // A shorter step helps: u may go where tanh is ±1 to the last digit, or about as far as the pole at ±iπ/2 lets it.
    constexpr double saturated = 19;  // 2e^{-2·19} < 2^-53
    const double most = std::max(isFollowed ? 2.0 : 0.5, leading(u) - (V - moved(u)) - rho - saturated);
    haste_ = std::max(haste_, moved(u) / most);
  }
  // 1 - t̂² - (1 - T²) = -e(2T + e), |(sech²)'| = 2|tanh| sech² < 0.77; sech² u and sech² u_00 lie in [0, steepest].
  const double twice = 2 + (e0 + e1), tilt = std::min(0.77, 2 * steepest);
  set(slope, own0_[at(slope)] + twice * e0 + tilt * rho0_[at(u)], own1_[at(slope)] + twice * e1 + tilt * rho1_[at(u)],
      pointError_[at(slope)] + rest(slope) + steepest);
}

bool PolynomialSeries::bound(const double* E, bool primaryOnly) {
  for (System& system : systems_) system.isBounded = false;
  haste_ = 0;
  for (int i = 0; i < time_; ++i) {
    const bool state = i < n_;
    rho0_[at(i)] = !state ? radius_[at(i)] : E != nullptr ? E[i] : 0.0;
    rho1_[at(i)] = state ? top_[at(i)] : 0.0;  // the order that x keeps and nodes do not
  }
  for (int node = time_ + 1; node < nodes_; ++node) {
    if (plan_[at(node)].constant) rho0_[at(node)] = radius_[at(node)];
    if (primaryOnly && !plan_[at(node)].primary) continue;
    if (!boundNode(node)) return refuse(node);
  }
  return true;
}

bool PolynomialSeries::refuse(int node) {
  obstacle_ = node;
  return false;
}

std::string PolynomialSeries::nearestEdge(double within) const {
  int nearest = -1;
  for (int i = 0; i < nodes_; ++i) {
    const Plan& v = plan_[at(i)];
    if (v.op != Op::recip && v.op != Op::sqrt && v.op != Op::log) continue;
    const double* argument = series(v.a);
    if (const double edge = -argument[0] / argument[1]; edge > 0 && edge < within) nearest = i, within = edge;
  }
  return nearest < 0 ? "" : edgeOf(nearest);
}

std::string PolynomialSeries::edgeOf(int node) const {
  switch (plan_[at(node)].op) {
    case Op::recip:
      return "a division by what may be zero";
    case Op::sqrt:
      return "the square root of what may be zero or negative";
    case Op::log:
      return "the logarithm of what may be zero or negative";
    case Op::exp:
      return "an exponential that may become too large";
    case Op::solution:
      return "a linear system that may be singular";
    default:
      return "a number that may become too large";
  }
}

double PolynomialSeries::derivativeNorm(const Plan& v, int k, double theta) const {
  double sum = 0, power = 1;
  for (int i = k; i <= last(); ++i, power *= theta) {
    double order = 0, factor = 1;
    for (int g = 0; g < v.count; ++g) order += std::fabs(f_[v.f + at(g * stride_ + i)]);
    for (int j = 0; j < k; ++j) factor *= i - j;
    sum += factor * order * power;
  }
  return sum * bounds::up + bounds::tiny;
}

/// y = chord - ½ (σ - from)(to - σ) ÿ(somewhere), so y leaves it by -share²/8 times a value of ÿ or of zero. About the
/// middle ÿ = Σ_α ÿ_α(middle) ξ^α + at most half times the third derivative; Horner's scheme for ÿ_α has 2m roundings,
/// and one more in i(i-1)c.
Interval PolynomialSeries::sag(int node, double from, double to, double second, double third, double more) const {
  const Plan& v = plan_[at(node)];
  const double middle = 0.5 * (from + to), half = std::max(to - middle, middle - from) * bounds::up;
  double leading = 0, others = 0;
  for (int g = 0; g < v.count; ++g) {
    const double* c = &f_[v.f + at(g * stride_)];
    double sum = 0;
    for (int i = last(); i >= 2; --i) sum = sum * middle + i * (i - 1) * c[i];
    if (g == 0)
      leading = sum;
    else
      others += std::fabs(sum);
  }
  others = (others + half * third + (2 * m_ + 2) * bounds::unit * second + more) * bounds::up;
  const double share = to - from, eighth = share * share / 8, most = (second + more) * bounds::up;
  const auto bound = [&](double slope) {
    const double curvature = std::min(most, slope + others + bounds::unit * std::fabs(slope));
    return std::max(0.0, curvature) * eighth * bounds::up + bounds::tiny;
  };
  return Interval(-bound(leading), bound(-leading));
}

double PolynomialSeries::jacobianBound(int i, int j) const {
  const int node = outputs_[at(n_ + i * n_ + j)];
  const double bound = (norm_[at(node)] + rho0_[at(node)] + rho1_[at(node)]) * bounds::up;
  return bound > 0 ? bound + bounds::tiny : 0.0;  // never so small that balancing it would underflow
}

void PolynomialSeries::frameDefect(int i, int j, double& nu0, double& nu1) const {
  double z0 = 0, z1 = 0, rounding = 0;
  int terms = 0;
  for (int k = 0; k < n_; ++k) {
    const int a = outputs_[at(n_ + i * n_ + k)], b = frameNode(k, j);
    if (isKnownZero(a)) continue;
    ++terms;
    const double ra0 = rho0_[at(a)], ra1 = rho1_[at(a)], top = top_[at(b)];
    z0 += norm_[at(b)] * ra0 + (ra0 + ra1) * top;
    z1 += norm_[at(b)] * ra1 + norm_[at(a)] * top + tailTime(a, b);
    if (monomials_->degree() > 0) z0 += tailDegree(a, b, frameDegree_, 0);
    rounding += plan_[at(a)].constant ? norm_[at(a)] * norm_[at(b)] : weighted_[at(a)] * weighted_[at(b)];
  }
  // A sum of `terms` products has at most terms·N roundings a term, and one more in the division by i+1.
  nu0 = (z0 + (terms + 1) * bounds::unit * rounding) * bounds::up + bounds::tiny;
  nu1 = z1 * bounds::up;
}

}  // namespace gamut
