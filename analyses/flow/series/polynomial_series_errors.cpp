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
  kinks_.forgetAtStart();  // of a step that was tried before, perhaps of another set
  power_[0] = 1;
  for (int i = 1; i < stride(); ++i) power_[i] = i < m_ ? power_[i - 1] * theta : 0.0;
  for (int i = 0; i < stride(); ++i) weights_[i] = (i + 1) * power_[i];
  const double last = power_[m_ - 1] * theta;  // θ^m
  Work::count(Work::coefficient, static_cast<double>((plan_.isByGrades ? 0 : f_.size()) + t_.size() + s2_.size()));
  Work::count(Work::boundedNode, static_cast<double>(plan_.nodes.size()));
  for (int x = 0; x < plan_.size(); ++x) {
    if (!tabulateNorms(x, last)) return refuse(x);
    if (plan_[x].needsTails) tabulateTails(x);
  }
  for (System& system : systems_) {
    goOnUnlessCancelled();
    tabulateSystem(system);
  }
  for (int x = 0; x < plan_.ofProgram; ++x) {
    goOnUnlessCancelled();
    ownErrors(x);
  }
  return true;
}

/// T, ‖·‖, ‖·‖_w and what an order has in all grades; of a state its last order. `last`: θ^m.
bool PolynomialSeries::tabulateNorms(int x, double last) {
  const SeriesNode& v = plan_[x];
  double* table = mass(v);
  if (plan_.isByGrades) {
    for (int q = 0; q <= v.degree; ++q)
      for (int i = 0; i < stride(); ++i) table[q * stride() + i] = grades_.sums[v.t + at(q * stride() + i)] * power_[i];
    norm_[x] = std::accumulate(table, table + (v.degree + 1) * stride(), 0.0);
    weighted_[x] = kernels::dot(&grades_.weighted[x * stride()], weights_.data(), stride());
  } else {
    kernels::tabulate(monomials(), v.count, series(v), power_.data(), weights_.data(), stride(), table, norm_[x],
                      weighted_[x]);
  }
  norm_[x] *= bounds::up;
  weighted_[x] *= bounds::up;
  if (!(norm_[x] < bounds::largest)) return false;  // for NaN too
  double* total = &total_[x * stride()];
  std::fill(total, total + stride(), 0.0);
  for (int q = 0; q <= v.degree; ++q)
    for (int i = 0; i < stride(); ++i) total[i] += table[q * stride() + i];
  for (int i = 0; i < fine_.orders() && isFine(x); ++i) {
    const FineRecursion::Number& c = fine_.value(x, i);
    if (!(std::fabs(c.lo) <= bounds::unit * std::fabs(c.hi))) return false;
  }
  if (v.op != Op::state) return true;
  const double sum = orderNorm(v, m_);
  top_[x] = plan_.withFrame ? sum * last * bounds::up : 0.0;
  return top_[x] < bounds::largest;
}

/// s1[i] = Σ_{j ≥ m-i} total[j];  s2[q][i] = Σ_{p ≥ q} Σ_{j ≤ m-1-i} T[p][j];  with from[q][j] = Σ_{p ≥ q} T[p][j],
/// beyond[p][i] = Σ_{j ≤ m-1-i} from[G_{i+j} + 1 - p][j].
void PolynomialSeries::tabulateTails(int x) {
  const SeriesNode& v = plan_[x];
  const double *table = mass(v), *total = &total_[x * stride()];
  double* s1 = &s1_[x * stride()];
  std::fill(s1, s1 + stride(), 0.0);
  for (int i = 1; i < m_; ++i) s1[i] = s1[i - 1] + total[m_ - i];
  if (monomials().degree() == 0) return;
  double* s2 = &s2_[v.s2];
  std::fill(s2 + (v.degree + 1) * stride(), s2 + (v.degree + 2) * stride(), 0.0);
  for (int q = v.degree; q >= 0; --q) {
    double* row = s2 + q * stride();
    std::fill(row, row + stride(), 0.0);
    double sum = 0;
    for (int i = m_ - 1; i >= 0; --i) row[i] = (sum += table[q * stride() + m_ - 1 - i]);
    for (int i = 0; i < m_; ++i) row[i] += row[stride() + i];
  }
  if (v.beyond == SeriesNode::none) return;
  std::vector<double>& from = from_;
  from.assign((v.degree + 2) * stride(), 0.0);
  for (int q = v.degree; q >= 0; --q)
    for (int j = 0; j < m_; ++j) from[q * stride() + j] = from[(q + 1) * stride() + j] + table[q * stride() + j];
  for (int p = 0; p <= v.degree; ++p)
    for (int i = 0; i < m_; ++i) {
      double sum = 0;
      for (int j = 0; i + j < m_; ++j) sum += from[std::max(0, plan_.gradeOf(i + j) + 1 - p) * stride() + j];
      beyond_[v.beyond + at(p * stride() + i)] = sum;
    }
}

bool PolynomialSeries::reachesHighestGrades(double share) const {
  const int last = monomials().degree();
  for (int x = 0; x < plan_.size(); ++x) {
    const SeriesNode& v = plan_[x];
    double sum = 0;
    for (int q = std::max(last - 1, 1); q <= v.degree; ++q)
      for (int i = 0; i < stride(); ++i) sum += mass(v, q)[i];
    if (sum > share * norm_[x]) return true;
  }
  return false;
}

/// Σ_{i+j ≥ m} T_a[i] T_b[j]: orders of a product that are not kept.
double PolynomialSeries::tailTime(int a, int b) const {
  return kernels::dot(&total_[at(a) * at(stride())], &s1_[at(b) * at(stride())], stride());
}

/// Σ_{i ≥ fromOrder, i+j < m, p+q > degree} T_a[p][i] T_b[q][j]: grades of a product that are not kept; G_{i+j} in
/// place of the degree where that is less.
double PolynomialSeries::tailDegree(int a, int b, int degree, int fromOrder) const {
  const SeriesNode& pa = plan_[a];
  const SeriesNode& pb = plan_[b];
  double sum = 0;
  if (plan_.isCut && degree == monomials().degree()) {
    for (int p = 0; p <= pa.degree; ++p)
      for (int i = fromOrder; i < m_; ++i) sum += mass(pa, p)[i] * beyond_[pb.beyond + at(p * stride() + i)];
    return sum;
  }
  for (int p = 0; p <= pa.degree; ++p) {
    const int q = std::max(0, degree + 1 - p);
    if (q > pb.degree) continue;
    const double* row = mass(pa, p);
    const double* tail = &s2_[pb.s2 + at(q * stride())];
    if (fromOrder == 0)
      sum += kernels::dot(row, tail, stride());
    else
      for (int i = fromOrder; i < m_; ++i) sum += row[i] * tail[i];
  }
  return sum;
}

/// Σ_{p ≥ 1, p+q > degree} T_a[p][0] T_b[q][0]: the same along ξ at σ = 0.
double PolynomialSeries::tailRow(int a, int b, int degree) const {
  const SeriesNode& pa = plan_[a];
  const SeriesNode& pb = plan_[b];
  double sum = 0, tail = 0;
  int q = pb.degree + 1;
  for (int p = 1; p <= pa.degree; ++p) {
    for (; q > std::max(0, degree + 1 - p); --q) tail += mass(pb, q - 1)[0];
    sum += mass(pa, p)[0] * tail;
  }
  return sum;
}

/// Σ_{grade > degree} of a: what a node of lower degree drops; and of a state, what others do not have of that order.
double PolynomialSeries::dropped(int a, int degree) const {
  double sum = 0;
  for (int q = 0; q <= plan_[a].degree; ++q)
    for (int i = 0; i < m_; ++i)
      if (q > degree || q > plan_.gradeOf(i)) sum += mass(plan_[a], q)[i];
  return sum;
}

/// A proved lower bound of |ṽ| when its constant coefficient is positive: |c_00| minus everything else.
double PolynomialSeries::minimum(int node) const {
  const double lead = leadingOf(node);
  return (2 * lead - norm_[node]) * bounds::down - bounds::tiny;
}

/// Σ_{(i,α)≠0} |c_{iα}| θ^i: how far ṽ goes from its constant coefficient, and along the way there: the integral of
/// |ṽ'| from ξ = 0, σ = 0 over ξ at σ = 0 and then over σ.
double PolynomialSeries::rest(int node) const {
  const SeriesNode& v = plan_[node];
  double sum = moved(node);
  for (int q = 1; q <= v.degree; ++q) sum += mass(v, q)[0];
  return sum * bounds::up;
}

double PolynomialSeries::variation(int node) const {
  const SeriesNode& v = plan_[node];
  double sum = node >= plan_.ofProgram ? top_[node] : 0.0;
  for (int q = 1; q <= v.degree; ++q)
    for (int i = 0; i < stride(); ++i) sum += mass(v, q)[i];
  return sum * bounds::up;
}

/// The part of rest() that is over σ.
double PolynomialSeries::moved(int node) const {
  double sum = 0;
  for (int i = 1; i < m_; ++i) sum += total_[at(node) * at(stride()) + at(i)];
  return sum;
}

/// The same as rest() of ‖·‖_w. (A difference of ‖·‖_w and the constant coefficient would be off by what bounds::up
/// adds.)
double PolynomialSeries::weightedRest(int node) const {
  const SeriesNode& v = plan_[node];
  double sum = 0;
  for (int g = 0; g < v.count; ++g)
    for (int i = g == 0 ? 1 : 0; i < m_; ++i)
      sum += weights_[i] * monomials().multiplicity(g) * std::fabs(series(v, g)[i]);
  return sum * bounds::up;
}

/// Σ_{i ≥ from} |c_i| θ^i, without symbols.
double PolynomialSeries::coarseNorm(int node, int from) const {
  double sum = 0;
  for (int i = from; i < m_; ++i) sum += mass(plan_[node])[i];
  return sum;
}

/// Σ_{i ≥ from, i+j ≥ K} (i+1)(j+1) |a_i||b_j| θ^{i+j}, K the orders in double-double; without symbols.
double PolynomialSeries::coarseProduct(int a, int b, int from) const {
  const double *ta = mass(plan_[a]), *tb = mass(plan_[b]);
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
  if (!isFine(node)) return bounds::unit * weighted_[a] * weighted_[b];
  return bounds::fine * weighted_[a] * weighted_[b] + coarse * bounds::unit * coarseProduct(a, b, from);
}

double PolynomialSeries::slopeRounding(int i) const {
  const int f = plan_.outputs[i];
  if (!isFine(f)) return bounds::unit * norm_[f];
  return bounds::fine * norm_[f] + 2 * bounds::unit * coarseNorm(f, fine_.orders() - 1);
}

/// Bounds of the defect of v' = u'·of (for sine, cosine, exponential, tanh), integrated over [0, θ], and of the row σ =
/// 0. Rounding: a coefficient has N terms, one rounding in j·u_j and one in the division: γ_{N+2}, N ≤ weights.
SeriesError PolynomialSeries::differentialErrors(int u, int of, int degree) const {
  const double norm = rest(u), weighted = weighted_[u] - leading(u) * bounds::down;
  const double e1 = tailTime(u, of);  // the row i = 0 of u meets s1[0] = 0
  if (isFine(of)) return {productRounding(of, u, of, 1, 3), e1};
  double e0 = bounds::unit * (weighted * weighted_[of] + 2 * norm * norm_[of]);
  if (isGraded())
    // The row σ = 0 rounds likewise, with the weights of its own (smaller) terms.
    e0 += tailDegree(u, of, degree, 1) + tailRow(u, of, degree) +
          bounds::unit * (weighted * weighted_[of] + 2 * norm * norm_[of]);
  return {e0, e1};
}

/// Σ term(coefficient, g, i) over the kept coefficients of left·right, or of j·left_j and right.
template <class Term>
double PolynomialSeries::sumOverProducts(int left, int right, bool isSlope, const Term& term) {
  const SeriesNode &l = plan_[left], &r = plan_[right];
  const double* factor = isSlope ? slopes(l) : series(l);
  double sum = 0;
  if (!plan_.isByGrades) {
    for (int i = isSlope ? 1 : 0; i < (l.invariant ? 1 : m_); ++i) {
      const double* product = convolved(l, i, factor, r);
      for (int g = 0; g < plan_.countOf(l, i); ++g) sum += term(product[g], g, i);
    }
    return sum;
  }
  std::vector<double>& out = residual_;
  out.resize(at(count()) * at(stride()));
  for (int q = 0; q <= l.degree; ++q) {
    const int first = monomials().firstOf(q), last = monomials().countUpTo(q);
    const int orders = l.invariant ? 1 : ordersOf(q);
    std::fill(out.begin() + first * stride(), out.begin() + last * stride(), 0.0);
    kernels::multiplySeries(monomials(), q, 0, factor, l.invariant ? 1 : m_, &r_[r.r], stride(), orders, out.data());
    for (int g = first; g < last; ++g)
      for (int i = 0; i < orders; ++i) sum += term(out[g * stride() + i], g, i);
  }
  return sum;
}

/// Σ |target - left·right| over the kept coefficients, with the rounding of this evaluation: γ_{N+1}(|target|+Σ|..|),
/// N + 1 ≤ 2N ≤ 2 weights. target -1 is the constant 1.
double PolynomialSeries::productResidual(int left, int right, int target) {
  if (isFine(left))  // not measured: the recursion makes it vanish but for rounding
    return productRounding(left, left, right, 0, 4) +
           (target >= 0 ? 2 * bounds::fine * norm_[target] + 4 * bounds::unit * coarseNorm(target, fine_.orders())
                        : 0.0);
  const double sum = sumOverProducts(left, right, false, [&](double product, int g, int i) {
    const double wanted = target >= 0 ? series(plan_[target], g)[i] : g == 0 && i == 0 ? 1.0 : 0.0;
    return std::fabs(wanted - product) * power_[i];
  });
  return sum + 2 * bounds::unit * (weighted_[left] * weighted_[right] + (target >= 0 ? weighted_[target] : 1.0));
}

/// Σ |i u_i - Σ_j j l_j w_{i-j}| / i over the kept coefficients of l' w = u', and the row σ = 0 likewise in the grades;
/// rounding γ_{N+2} of (|u| + Σ|l||w|) for each of the two, N + 2 ≤ 3 weights.
double PolynomialSeries::quotientResidual(int node) {
  const SeriesNode& l = plan_[node];
  if (isFine(node))
    return productRounding(node, node, l.b, 1, 4) + 2 * bounds::fine * norm_[l.a] +
           4 * bounds::unit * coarseNorm(l.a, fine_.orders());
  const SeriesNode& u = plan_[l.a];
  const SeriesNode& w = plan_[l.b];
  double sum = sumOverProducts(node, l.b, true, [&](double product, int g, int i) {
    return i == 0 ? 0.0 : std::fabs(i * series(u, g)[i] - product) / i * power_[i];
  });
  for (int g = 1; g < l.count; ++g) {
    const double s =
        sumOverPairs(g, [&](int p, int r) { return monomials().grade(p) * series(l, p)[0] * series(w, r)[0]; });
    const int grade = monomials().grade(g);
    sum += std::fabs(grade * series(u, g)[0] - s) / grade;
  }
  return sum + 6 * bounds::unit * (weighted_[l.a] + weighted_[node] * weighted_[l.b]);
}

/// One rounding a coefficient.
double PolynomialSeries::sumRounding(int node) const {
  const SeriesNode& v = plan_[node];
  return isFine(node) ? bounds::fine * (norm_[v.a] + norm_[v.b]) + bounds::unit * coarseNorm(node, fine_.orders())
                      : bounds::unit * norm_[node];
}

/// A coefficient is a sum of N ≤ (i+1)∏(α_l+1) products in any order, fused or not: γ_N. A constant factor: one.
SeriesError PolynomialSeries::productErrors(int node, int a, int b) const {
  double e0 = plan_[a].constant && !isFine(node) ? bounds::unit * norm_[node] : productRounding(node, a, b, 0, 3);
  if (isGraded()) e0 += tailDegree(a, b, plan_[node].degree, 0);
  return {e0, tailTime(a, b)};
}

/// What a node adds to the errors of its operands.
void PolynomialSeries::ownErrors(int node) {
  const SeriesNode& v = plan_[node];
  SeriesError e;
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
      e = productErrors(node, v.a, v.op == Op::sqr ? v.a : v.b);
      break;
    default:
      if (isTwin(v.op)) return;
      e = withFunction<FlowFunction>(v.op, [&](auto f) { return f.ownErrors(*this, node); });
  }
  own_[node] = e.up();
}

}  // namespace gamut
