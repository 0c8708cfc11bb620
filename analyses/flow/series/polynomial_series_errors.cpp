// The certificate, first part: what the recursion left out and rounded, node by node. Notation as in docs/flow.md:
// ‖a‖ = Σ|c_{iα}|θ^i, ‖a‖_w = Σ (i+1)∏(α_l+1)|c_{iα}|θ^i, T_a[q][i] = Σ_{grade α = q} |c_{iα}|θ^i, u = 2^-53.
// All quantities are nonnegative and computed in round-to-nearest; `bounds::up` then covers the
// roundings of the bound itself.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/kernels.hpp"
#include "analyses/flow/series/operations/all.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/work.hpp"

namespace gamut {

bool PolynomialSeries::tabulate(double theta) {
  atStart_.clear();  // of a step that was tried before, perhaps of another set
  power_[0] = 1;
  for (int i = 1; i < stride_; ++i) power_[at(i)] = i < m_ ? power_[at(i - 1)] * theta : 0.0;
  for (int i = 0; i < stride_; ++i) weights_[at(i)] = (i + 1) * power_[at(i)];
  const double last = power_[at(m_ - 1)] * theta;  // θ^m
  Work::count(Work::coefficient, static_cast<double>((isByGrades_ ? 0 : f_.size()) + t_.size() + s2_.size()));
  Work::count(Work::boundedNode, static_cast<double>(plan_.size()));
  for (std::size_t x = 0; x < plan_.size(); ++x) {
    if (!tabulateNorms(x, last)) return refuse(static_cast<int>(x));
    if (plan_[x].needsTails) tabulateTails(x);
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

/// T, ‖·‖, ‖·‖_w and what an order has in all grades; of a state its last order. `last`: θ^m.
bool PolynomialSeries::tabulateNorms(std::size_t x, double last) {
  const Plan& v = plan_[x];
  double* table = &t_[v.t];
  if (isByGrades_) {
    for (int q = 0; q <= v.degree; ++q)
      for (int i = 0; i < stride_; ++i) table[q * stride_ + i] = sums_[v.t + at(q * stride_ + i)] * power_[at(i)];
    norm_[x] = std::accumulate(table, table + (v.degree + 1) * stride_, 0.0);
    weighted_[x] = kernels::dot(&weightedSums_[x * at(stride_)], weights_.data(), stride_);
  } else {
    kernels::tabulate(*monomials_, v.count, &f_[v.f], power_.data(), weights_.data(), stride_, table, norm_[x],
                      weighted_[x]);
  }
  norm_[x] *= bounds::up;
  weighted_[x] *= bounds::up;
  if (!(norm_[x] < bounds::largest)) return false;  // for NaN too
  double* total = &total_[x * at(stride_)];
  std::fill(total, total + stride_, 0.0);
  for (int q = 0; q <= v.degree; ++q)
    for (int i = 0; i < stride_; ++i) total[i] += table[q * stride_ + i];
  for (int i = 0; i < fine_.orders() && isFine(static_cast<int>(x)); ++i) {
    const FineRecursion::Number& c = fine_.value(static_cast<int>(x), i);
    if (!(std::fabs(c.lo) <= bounds::unit * std::fabs(c.hi))) return false;
  }
  if (v.op != Op::state) return true;
  const double sum = orderNorm(v, m_);
  top_[x] = withFrame_ ? sum * last * bounds::up : 0.0;
  return top_[x] < bounds::largest;
}

/// s1[i] = Σ_{j ≥ m-i} total[j];  s2[q][i] = Σ_{p ≥ q} Σ_{j ≤ m-1-i} T[p][j];  with from[q][j] = Σ_{p ≥ q} T[p][j],
/// beyond[p][i] = Σ_{j ≤ m-1-i} from[G_{i+j} + 1 - p][j].
void PolynomialSeries::tabulateTails(std::size_t x) {
  const Plan& v = plan_[x];
  const double *table = &t_[v.t], *total = &total_[x * at(stride_)];
  double* s1 = &s1_[x * at(stride_)];
  std::fill(s1, s1 + stride_, 0.0);
  for (int i = 1; i < m_; ++i) s1[i] = s1[i - 1] + total[m_ - i];
  if (monomials_->degree() == 0) return;
  double* s2 = &s2_[v.s2];
  std::fill(s2 + (v.degree + 1) * stride_, s2 + (v.degree + 2) * stride_, 0.0);
  for (int q = v.degree; q >= 0; --q) {
    double* row = s2 + q * stride_;
    std::fill(row, row + stride_, 0.0);
    double sum = 0;
    for (int i = m_ - 1; i >= 0; --i) row[i] = (sum += table[q * stride_ + m_ - 1 - i]);
    for (int i = 0; i < m_; ++i) row[i] += row[stride_ + i];
  }
  if (v.beyond == none) return;
  std::vector<double>& from = from_;
  from.assign(at((v.degree + 2) * stride_), 0.0);
  for (int q = v.degree; q >= 0; --q)
    for (int j = 0; j < m_; ++j) from[at(q * stride_ + j)] = from[at((q + 1) * stride_ + j)] + table[q * stride_ + j];
  for (int p = 0; p <= v.degree; ++p)
    for (int i = 0; i < m_; ++i) {
      double sum = 0;
      for (int j = 0; i + j < m_; ++j) sum += from[at(std::max(0, gradeOf(i + j) + 1 - p) * stride_ + j)];
      beyond_[v.beyond + at(p * stride_ + i)] = sum;
    }
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

/// Σ_{i ≥ fromOrder, i+j < m, p+q > degree} T_a[p][i] T_b[q][j]: grades of a product that are not kept; G_{i+j} in
/// place of the degree where that is less.
double PolynomialSeries::tailDegree(int a, int b, int degree, int fromOrder) const {
  const Plan& pa = plan_[at(a)];
  const Plan& pb = plan_[at(b)];
  double sum = 0;
  if (isCut_ && degree == monomials_->degree()) {
    for (int p = 0; p <= pa.degree; ++p)
      for (int i = fromOrder; i < m_; ++i)
        sum += t_[pa.t + at(p * stride_ + i)] * beyond_[pb.beyond + at(p * stride_ + i)];
    return sum;
  }
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

/// Σ_{grade > degree} of a: what a node of lower degree drops; and of a state, what others do not have of that order.
double PolynomialSeries::dropped(int a, int degree) const {
  double sum = 0;
  for (int q = 0; q <= plan_[at(a)].degree; ++q)
    for (int i = 0; i < m_; ++i)
      if (q > degree || q > gradeOf(i)) sum += t_[plan_[at(a)].t + at(q * stride_ + i)];
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

double PolynomialSeries::variation(int node) const {
  const Plan& v = plan_[at(node)];
  double sum = node >= nodes_ ? top_[at(node)] : 0.0;
  for (int q = 1; q <= v.degree; ++q)
    for (int i = 0; i < stride_; ++i) sum += t_[v.t + at(q * stride_ + i)];
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

/// Σ_{i ≥ from} |c_i| θ^i, without symbols.
double PolynomialSeries::coarseNorm(int node, int from) const {
  double sum = 0;
  for (int i = from; i < m_; ++i) sum += t_[plan_[at(node)].t + at(i)];
  return sum;
}

/// Σ_{i ≥ from, i+j ≥ K} (i+1)(j+1) |a_i||b_j| θ^{i+j}, K the orders in double-double; without symbols.
double PolynomialSeries::coarseProduct(int a, int b, int from) const {
  const double *ta = &t_[plan_[at(a)].t], *tb = &t_[plan_[at(b)].t];
  double sum = 0, tail = 0;
  int j = m_;
  for (int i = from; i < m_; ++i) {
    for (; j > std::max(0, fine_.orders() - i); --j) tail += j * tb[j - 1];
    sum += (i + 1) * ta[i] * tail;
  }
  return sum;
}

/// Rounding of a node whose coefficients are sums of the products of a's and b's, those of a from order `from` on. In
/// double-double a coefficient has N ≤ weights terms. From order K on (N ≥ 2) no more than `coarse` N roundings: N + 2
/// in a product, for the second doubles that are not seen (3 N); N + 4 in u'v, with factor and quotient (3 N); N + 6
/// where the product's last term is divided by (4 N).
double PolynomialSeries::productRounding(int node, int a, int b, int from, double coarse) const {
  if (!isFine(node)) return bounds::unit * weighted_[at(a)] * weighted_[at(b)];
  return bounds::fine * weighted_[at(a)] * weighted_[at(b)] + coarse * bounds::unit * coarseProduct(a, b, from);
}

double PolynomialSeries::slopeRounding(int i) const {
  const int f = outputs_[at(i)];
  if (!isFine(f)) return bounds::unit * norm_[at(f)];
  return bounds::fine * norm_[at(f)] + 2 * bounds::unit * coarseNorm(f, fine_.orders() - 1);
}

/// Bounds of the defect of v' = u'·of (for sine, cosine, exponential, tanh), integrated over [0, θ], and of the row σ =
/// 0. Rounding: a coefficient has N terms, one rounding in j·u_j and one in the division: γ_{N+2}, N ≤ weights.
PolynomialSeries::Errors PolynomialSeries::differentialErrors(int u, int of, int degree) const {
  const double norm = rest(u), weighted = weighted_[at(u)] - leading(u) * bounds::down;
  const double e1 = tailTime(u, of);  // the row i = 0 of u meets s1[0] = 0
  if (isFine(of)) return {productRounding(of, u, of, 1, 3), e1};
  double e0 = bounds::unit * (weighted * weighted_[at(of)] + 2 * norm * norm_[at(of)]);
  if (isGraded())
    // The row σ = 0 rounds likewise, with the weights of its own (smaller) terms.
    e0 += tailDegree(u, of, degree, 1) + tailRow(u, of, degree) +
          bounds::unit * (weighted * weighted_[at(of)] + 2 * norm * norm_[at(of)]);
  return {e0, e1};
}

/// Σ term(coefficient, g, i) over the kept coefficients of left·right, or of j·left_j and right.
template <class Term>
double PolynomialSeries::sumOverProducts(int left, int right, bool isSlope, const Term& term) {
  const Plan &l = plan_[at(left)], &r = plan_[at(right)];
  double sum = 0;
  std::vector<double>& out = residual_;
  out.resize(at(count()) * at(stride_));
  for (int q = 0; q <= l.degree; ++q) {
    const int first = monomials_->firstOf(q), last = monomials_->countUpTo(q);
    const int orders = l.invariant ? 1 : ordersOf(q);
    std::fill(out.begin() + first * stride_, out.begin() + last * stride_, 0.0);
    kernels::multiplySeries(*monomials_, q, 0, isSlope ? &d_[l.d] : &f_[l.f], l.invariant ? 1 : m_, &r_[r.r], stride_,
                            orders, out.data());
    for (int g = first; g < last; ++g)
      for (int i = 0; i < orders; ++i) sum += term(out[at(g * stride_ + i)], g, i);
  }
  return sum;
}

/// Σ |target - left·right| over the kept coefficients, with the rounding of this evaluation: γ_{N+1}(|target|+Σ|..|),
/// N + 1 ≤ 2N ≤ 2 weights. target -1 is the constant 1.
double PolynomialSeries::productResidual(int left, int right, int target) {
  if (isFine(left))  // not measured: the recursion makes it vanish but for rounding
    return productRounding(left, left, right, 0, 4) +
           (target >= 0 ? 2 * bounds::fine * norm_[at(target)] + 4 * bounds::unit * coarseNorm(target, fine_.orders())
                        : 0.0);
  const Plan& l = plan_[at(left)];
  double* out = scratch_.data();
  double sum = 0;
  const int orders = l.invariant ? 1 : m_;
  for (int i = 0; i < orders && !isByGrades_; ++i) {
    const int N = countOf(l, i);
    std::fill(out, out + N, 0.0);
    kernels::convolve(monomials_->pairs().data(), monomials_->first().data(), N, &f_[l.f], &r_[plan_[at(right)].r],
                      stride_, i, out);
    for (int g = 0; g < N; ++g) {
      const double wanted =
          target >= 0 ? f_[plan_[at(target)].f + at(g * stride_ + i)] : (g == 0 && i == 0 ? 1.0 : 0.0);
      sum += std::fabs(wanted - out[g]) * power_[at(i)];
    }
  }
  if (isByGrades_)
    sum = sumOverProducts(left, right, false, [&](double product, int g, int i) {
      const double wanted = target >= 0 ? f_[plan_[at(target)].f + at(g * stride_ + i)] : g == 0 && i == 0 ? 1.0 : 0.0;
      return std::fabs(wanted - product) * power_[at(i)];
    });
  return sum +
         2 * bounds::unit * (weighted_[at(left)] * weighted_[at(right)] + (target >= 0 ? weighted_[at(target)] : 1.0));
}

/// Σ |i u_i - Σ_j j l_j w_{i-j}| / i over the kept coefficients of l' w = u', and the row σ = 0 likewise in the grades;
/// rounding γ_{N+2} of (|u| + Σ|l||w|) for each of the two, N + 2 ≤ 3 weights.
double PolynomialSeries::quotientResidual(int node) {
  const Plan& l = plan_[at(node)];
  if (isFine(node))
    return productRounding(node, node, l.b, 1, 4) + 2 * bounds::fine * norm_[at(l.a)] +
           4 * bounds::unit * coarseNorm(l.a, fine_.orders());
  const Plan& u = plan_[at(l.a)];
  const Plan& w = plan_[at(l.b)];
  const int N = l.count;
  double* out = scratch_.data();
  double sum = 0;
  if (isByGrades_)
    sum = sumOverProducts(node, l.b, true, [&](double product, int g, int i) {
      return i == 0 ? 0.0 : std::fabs(i * f_[u.f + at(g * stride_ + i)] - product) / i * power_[at(i)];
    });
  for (int i = 1; i < (l.invariant || isByGrades_ ? 1 : m_); ++i) {
    const int kept = countOf(l, i);
    std::fill(out, out + kept, 0.0);
    kernels::convolve(monomials_->pairs().data(), monomials_->first().data(), kept, &d_[l.d], &r_[w.r], stride_, i,
                      out);
    for (int g = 0; g < kept; ++g) sum += std::fabs(i * f_[u.f + at(g * stride_ + i)] - out[g]) / i * power_[at(i)];
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

/// One rounding a coefficient.
double PolynomialSeries::sumRounding(int node) const {
  const Plan& v = plan_[at(node)];
  return isFine(node)
             ? bounds::fine * (norm_[at(v.a)] + norm_[at(v.b)]) + bounds::unit * coarseNorm(node, fine_.orders())
             : bounds::unit * norm_[at(node)];
}

/// A coefficient is a sum of N ≤ (i+1)∏(α_l+1) products in any order, fused or not: γ_N. A constant factor: one.
void PolynomialSeries::productErrors(int node, int a, int b, double& e0, double& e1) const {
  e0 = plan_[at(a)].constant && !isFine(node) ? bounds::unit * norm_[at(node)] : productRounding(node, a, b, 0, 3);
  if (monomials_->degree() > 0) e0 += tailDegree(a, b, plan_[at(node)].degree, 0);
  e1 = tailTime(a, b);
}

/// What a node adds to the errors of its operands.
void PolynomialSeries::ownErrors(int node) {
  const Plan& v = plan_[at(node)];
  Errors e;
  switch (v.op) {
    case Op::state:
    case Op::parameter:
    case Op::time:
    case Op::constant:
      return;
    case Op::solution:
      if (v.b == 0) solutionOwnErrors(node);
      return;
    case Op::add:
    case Op::sub:
      e.e0 = sumRounding(node) + (isGraded() ? dropped(v.a, v.degree) + dropped(v.b, v.degree) : 0.0);
      break;
    case Op::neg:
      e.e0 = isGraded() ? dropped(v.a, v.degree) : 0.0;
      break;
    case Op::mul:
    case Op::sqr:
      productErrors(node, v.a, v.op == Op::sqr ? v.a : v.b, e.e0, e.e1);
      break;
    default:
      if (isTwin(v.op)) return;
      e = withFunction<FlowFunction>(v.op, [&](auto f) { return f.ownErrors(*this, node); });
  }
  own0_[at(node)] = e.e0 * bounds::up + bounds::tiny;
  own1_[at(node)] = e.e1 * bounds::up;
}

}  // namespace gamut
