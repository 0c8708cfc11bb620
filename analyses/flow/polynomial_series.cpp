// The recursion: coefficients of every node in plain floating point, order by order; of
// many monomials by grades (polynomial_series_grades.cpp). No bound is computed here.
#include "analyses/flow/polynomial_series.hpp"

#include <algorithm>
#include <cmath>

#include "analyses/flow/kernels.hpp"
#include "analyses/work.hpp"

namespace gamut {

void PolynomialSeries::compute(double t0, double h0) {
  for (System& system : systems_) {
    system.isFactorised = false;
    system.multipliedFor = 0;
  }
  put(plan_[at(time_)], 0, 0, t0);
  if (m_ > 1) put(plan_[at(time_)], 0, 1, h0);
  if (isByGrades_) return computeByGrades(h0);
  if (!thin_.empty()) {
    if (isFine()) computeLeading(t0, h0);
    for (int x = 0; x < n_ && !withFrame_; ++x) std::copy_n(&f_[plan_[at(x)].f], stride_, &known_[at(x * stride_)]);
    for (int node = time_ + 1; node < nodes_; ++node)
      if (!isFine(node)) computeLeadingValue(node);
    for (std::size_t x = 0; x < plan_.size(); ++x) current_[x] = f_[plan_[x].f];
    kernels::thinRecursion(thin_, thinSolutions_, thinStates_, thinFrame_, leading_, time_, m_, h0, current_);
    return;
  }
  Work::count(Work::coefficient, static_cast<double>(f_.size()));
  for (int i = 0; i < m_; ++i) {
    for (int node = time_ + 1; node < nodes_; ++node) {
      goOnUnlessCancelled();
      computeOrder(node, i);
    }
    if (!withFrame_) continue;
    for (int s = 0; s < n_; ++s) {
      const Plan& from = plan_[at(outputs_[at(s)])];
      const double* f = &f_[from.f];
      const int kept = from.op == Op::state ? from.count : countOf(from, i);  // x' = v: all that v has
      for (int g = 0; g < kept; ++g) put(plan_[at(s)], g, i + 1, f[g * stride_ + i] * h0 / (i + 1));
    }
    computeFrameOrder(i, h0);
  }
}

/// The first orders of all primary nodes.
void PolynomialSeries::computeLeading(double t0, double h0) {
  fine_.compute(t0, h0);
  for (System& system : systems_) system.isFactorised = system.isFine;
  for (const int node : leading_.nodes) {
    for (int i = 0; i < leading_.orders; ++i) leading_.values[at(node * leading_.orders + i)] = fine_.value(node, i).hi;
    put(plan_[at(node)], 0, 0, fine_.value(node, 0).hi);
    pointError_[at(node)] = fine_.pointError(node);
  }
}

/// Order 0 of the coefficient of 1.
void PolynomialSeries::computeLeadingValue(int node) {
  const Plan& v = plan_[at(node)];
  const auto value = [&](int of) { return f_[plan_[at(of)].f]; };
  const auto set = [&](double number) { put(v, 0, 0, number); };
  switch (v.op) {
    case Op::add:
      return set(value(v.a) + value(v.b));
    case Op::sub:
      return set(value(v.a) - value(v.b));
    case Op::neg:
      return set(-value(v.a));
    case Op::abs:
      chords_[at(node)] = chordOf(v.a);
      return set(chords_[at(node)].slope * value(v.a) + chords_[at(node)].middle);
    case Op::sign:
      return set(signOf(node));
    case Op::mul:
      return set(value(v.a) * value(v.b));
    case Op::sqr:
      return set(value(v.a) * value(v.a));
    case Op::recip:
      return set(1.0 / value(v.a));
    case Op::sqrt:
      return set(std::sqrt(value(v.a)));
    case Op::exp:
    case Op::log:
    case Op::atan:
    case Op::sin:
    case Op::tanh:
      return pointFunctions(node);
    case Op::solution:
      if (v.b == 0) computeLeadingSolution(node);
      return;
    default:
      return;
  }
}

/// out[g] += order i of a·b.
void PolynomialSeries::product(const Plan& a, const Plan& b, int count, int i, double* out) {
  const auto* pairs = monomials_->pairs().data();
  const auto* first = monomials_->first().data();
  if (a.constant) {
    const double c = f_[a.f];
    for (int g = 0; g < count; ++g) out[g] += c * f_[b.f + at(g * stride_ + i)];
  } else if (a.invariant) {
    kernels::multiply(*monomials_, count, &f_[a.f], &f_[b.f + at(i)], stride_, out);
  } else {
    kernels::convolve(pairs, first, count, &f_[a.f], &r_[b.r], stride_, i, out);
  }
}

/// |a| over [low, high], low < 0 < high, lies between the chord and -2 low high/(high - low) below it.
PolynomialSeries::Chord PolynomialSeries::chordOf(int node) const {
  if (side_[at(node)] != 0) return {side_[at(node)], 0.0};
  if (passed_[at(node)] != 0) return {passed_[at(node)], 0.0};
  const Plan& v = plan_[at(node)];
  const double centre = f_[v.f];
  double half = 0;
  for (int g = 1; g < v.count; ++g) half += std::fabs(f_[v.f + at(g * stride_)]);
  half = std::max(half, crossing_[at(node)]);
  if (std::fabs(centre) >= half) return {centre > 0 ? 1.0 : centre < 0 ? -1.0 : 0.0, 0.0};
  const double low = centre - half, high = centre + half;
  return {(high + low) / (high - low), -low * high / (high - low)};
}

double PolynomialSeries::signOf(int node) const {
  if (given_[at(node)]) return about_[at(node)];
  const Plan& v = plan_[at(node)];
  const double slope = chordOf(v.a).slope;
  return v.primary && std::fabs(slope) < 1 ? 0.0 : slope;
}

void PolynomialSeries::computeOrder(int node, int i) {
  const Plan& v = plan_[at(node)];
  if ((v.invariant && i > 0) || v.op == Op::constant || isTwin(v.op)) return;
  if (v.op == Op::solution) {
    if (v.b == 0) computeSolution(node, i);
    return;
  }
  const Plan& a = plan_[at(v.a)];
  const double* fa = &f_[a.f];
  const int N = countOf(v, i);
  double* out = scratch_.data();
  switch (v.op) {
    case Op::add: {
      const double* fb = &f_[plan_[at(v.b)].f];
      for (int g = 0; g < N; ++g) put(v, g, i, fa[g * stride_ + i] + fb[g * stride_ + i]);
      return;
    }
    case Op::sub: {
      const double* fb = &f_[plan_[at(v.b)].f];
      for (int g = 0; g < N; ++g) put(v, g, i, fa[g * stride_ + i] - fb[g * stride_ + i]);
      return;
    }
    case Op::neg:
      for (int g = 0; g < N; ++g) put(v, g, i, -fa[g * stride_ + i]);
      return;
    case Op::abs:  // the chord over what a reaches at first: ±a where that is on one side
      if (i == 0) chords_[at(node)] = chordOf(v.a);
      for (int g = 0; g < N; ++g)
        put(v, g, i, chords_[at(node)].slope * fa[g * stride_ + i] + (g + i == 0 ? chords_[at(node)].middle : 0.0));
      return;
    case Op::sign:
      for (int g = 0; g < N; ++g) put(v, g, i, g + i == 0 ? signOf(node) : 0.0);
      return;
    case Op::mul:
    case Op::sqr:
      std::fill(out, out + N, 0.0);
      product(a, plan_[at(v.op == Op::sqr ? v.a : v.b)], N, i, out);
      for (int g = 0; g < N; ++g) put(v, g, i, out[g]);
      return;
    case Op::exp:
    case Op::sin:
    case Op::tanh:
      return i == 0 ? initialFunctionRow(node) : computeFunctionOrder(node, i);
    default:
      return i == 0 ? initialRow(node) : computeQuotientOrder(node, i);
  }
}

/// out = Σ_j left_j right_{i-j} over stored orders.
void PolynomialSeries::convolveOrder(const double* left, const Plan& right, int count, int i, double* out) {
  std::fill(out, out + count, 0.0);
  kernels::convolve(monomials_->pairs().data(), monomials_->first().data(), count, left, &r_[right.r], stride_, i, out);
}

/// j·(order j) of a node, that of order i anew.
const double* PolynomialSeries::putSlope(const Plan& v, int i) {
  for (int g = 0; g < countOf(v, i - 1); ++g) d_[v.d + at(g * stride_ + i)] = i * f_[v.f + at(g * stride_ + i)];
  return &d_[v.d];
}

/// Order i > 0 of what is a quotient by a leading polynomial.
void PolynomialSeries::computeQuotientOrder(int node, int i) {
  const Plan& v = plan_[at(node)];
  const double* fa = &f_[plan_[at(v.a)].f];
  const int N = countOf(v, i);
  const bool isOfSlopes = v.op == Op::log || v.op == Op::atan;
  double *out = scratch_.data(), *quotient = scratch2_.data();
  for (int g = 0; g < N; ++g) put(v, g, i, 0.0);  // counts as zero in the sums
  for (int g = 0; g < N && isOfSlopes; ++g) d_[v.d + at(g * stride_ + i)] = 0.0;
  if (v.op == Op::recip) {  // c_i = -(Σ_{j<i} c_j b_{i-j}) / b_0
    convolveOrder(&f_[v.f], plan_[at(v.a)], N, i, out);
  } else if (v.op == Op::sqrt) {  // s_i = (b_i - Σ_{0<j<i} s_j s_{i-j}) / (2 s_0)
    convolveOrder(&f_[v.f], v, N, i, out);
    for (int g = 0; g < N; ++g) out[g] = 0.5 * (fa[g * stride_ + i] - out[g]);
  } else {  // l_i = (u_i - Σ_{1≤j<i} j l_j w_{i-j} / i) / w_0
    convolveOrder(&d_[v.d], plan_[at(v.b)], N, i, out);
    for (int g = 0; g < N; ++g) out[g] = fa[g * stride_ + i] - out[g] / i;
  }
  std::fill(quotient, quotient + N, 0.0);
  kernels::multiply(*monomials_, N, out, &inverse_[inverseAt_[at(node)]], 1, quotient);
  for (int g = 0; g < N; ++g) {
    put(v, g, i, v.op == Op::recip ? -quotient[g] : quotient[g]);
    if (isOfSlopes) d_[v.d + at(g * stride_ + i)] = i * quotient[g];
  }
}

/// Order i > 0 of a function that obeys a differential equation.
void PolynomialSeries::computeFunctionOrder(int node, int i) {
  const Plan& v = plan_[at(node)];
  const Plan& a = plan_[at(v.a)];
  const int N = countOf(v, i);
  double *out = scratch_.data(), *other = scratch2_.data();
  const Plan& twin = plan_[at(v.op == Op::exp ? node : node + 1)];
  for (int g = 0; g < N; ++g) {  // count as zero in the sums
    put(v, g, i, 0.0);
    put(twin, g, i, 0.0);
  }
  convolveOrder(putSlope(a, i), twin, N, i, out);
  switch (v.op) {
    case Op::exp:  // e_i = Σ_{j≥1} j u_j e_{i-j} / i
      for (int g = 0; g < N; ++g) put(v, g, i, out[g] / i);
      return;
    case Op::sin:  // s_i = Σ_{j≥1} j u_j c_{i-j} / i, c_i = -Σ_{j≥1} j u_j s_{i-j} / i
      convolveOrder(&d_[a.d], v, N, i, other);
      for (int g = 0; g < N; ++g) {
        put(v, g, i, out[g] / i);
        put(twin, g, i, -other[g] / i);
      }
      return;
    case Op::tanh:  // t_i = Σ_{j≥1} j u_j s_{i-j} / i, s_i = -Σ t_j t_{i-j}
      for (int g = 0; g < N; ++g) put(v, g, i, out[g] / i);
      convolveOrder(&f_[v.f], v, N, i, out);
      for (int g = 0; g < N; ++g) put(twin, g, i, -out[g]);
      return;
    default:
      return;
  }
}

/// Values at the expansion point, with their errors: f(u) for the constant coefficient u.
void PolynomialSeries::pointFunctions(int node) {
  const Plan& v = plan_[at(node)];
  const double u = f_[plan_[at(v.a)].f];
  const auto set = [&](int which, const Interval& value) {
    const double c = isEmpty(value) ? std::nan("") : midpoint(value);
    put(plan_[at(which)], 0, 0, c);
    // The enclosure's ends are neighbours, and c is one of them: the error is at most its width.
    pointError_[at(which)] = isEmpty(value) ? std::nan("") : width(value);
  };
  if (!std::isfinite(u)) {
    put(v, 0, 0, std::nan(""));
    if (twinOf(v.op) != v.op) put(plan_[at(node + 1)], 0, 0, std::nan(""));
    return;
  }
  switch (v.op) {
    case Op::sin: {
      const SinCos value = sinCos(Interval(u));
      set(node, value.sin);
      set(node + 1, value.cos);
      return;
    }
    case Op::tanh: {
      const double far = std::min(std::fabs(u), 1e300);  // both are 0 there, but for rounding
      const Interval e = exp(Interval(-2 * far));
      set(node, tanh(Interval(u)));
      set(node + 1, 4.0 * e / sqr(1.0 + e));  // not 1 - tanh²: to its own digits, however small
      return;
    }
    case Op::exp:
      set(node, exp(Interval(u)));
      return;
    case Op::log:
      set(node, log(Interval(u)));
      return;
    case Op::atan:
      set(node, atan(Interval(u)));
      return;
    default:
      return;
  }
}

/// Σ term(p, r) over all pairs of monomials with product g, but for p = 1.
template <class Term>
double PolynomialSeries::sumOverPairs(int g, const Term& term) const {
  double sum = 0;
  for (auto q = monomials_->first()[at(g)]; q < monomials_->first()[at(g) + 1]; ++q)
    if (const auto [p, r] = monomials_->pairs()[at(q)]; p != 0) sum += term(p, r);
  return sum;
}

/// 1 / leading polynomial, truncated: inv_0 = 1/b_0, inv_g = -Σ_{α≠0} b_α inv_{g/α} / b_0.
const double* PolynomialSeries::invertLeading(int node, const Plan& b) {
  double* inverse = &inverse_[inverseAt_[at(node)]];
  inverse[0] = 1.0 / f_[b.f];
  for (int g = 1; g < plan_[at(node)].count; ++g)
    inverse[g] = -sumOverPairs(g, [&](int p, int r) { return f_[b.f + at(p * stride_)] * inverse[r]; }) * inverse[0];
  return inverse;
}

/// Order 0 in time: the recursion in the grade of ξ (the path ξ → λ^weight ξ plays the part of time).
void PolynomialSeries::initialRow(int node) {
  const Plan& v = plan_[at(node)];
  const Plan& a = plan_[at(v.a)];
  const auto coefficient = [&](const Plan& of, int g) { return f_[of.f + at(g * stride_)]; };
  if (v.op == Op::recip) {
    const double* inverse = invertLeading(node, a);
    for (int g = 0; g < v.count; ++g) put(v, g, 0, inverse[g]);
  } else if (v.op == Op::sqrt) {
    const double root = std::sqrt(coefficient(a, 0));
    put(v, 0, 0, root);
    for (int g = 1; g < v.count; ++g) {
      const double s =
          sumOverPairs(g, [&](int p, int r) { return r == 0 ? 0.0 : coefficient(v, p) * coefficient(v, r); });
      put(v, g, 0, (coefficient(a, g) - s) / (2 * root));
    }
    invertLeading(node, v);
  } else {  // log, atan
    const Plan& w = plan_[at(v.b)];
    pointFunctions(node);
    const double w0 = coefficient(w, 0);
    for (int g = 1; g < v.count; ++g) {
      const double s = sumOverPairs(
          g, [&](int p, int r) { return r == 0 ? 0.0 : monomials_->grade(p) * coefficient(v, p) * coefficient(w, r); });
      put(v, g, 0, (coefficient(a, g) - s / monomials_->grade(g)) / w0);
    }
    for (int g = 0; g < v.count; ++g) d_[v.d + at(g * stride_)] = 0.0;
    invertLeading(node, w);
  }
}

/// Likewise of exp, and of sin and tanh with their twins.
void PolynomialSeries::initialFunctionRow(int node) {
  const Plan& v = plan_[at(node)];
  const Plan& a = plan_[at(v.a)];
  const Plan& twin = plan_[at(v.op == Op::exp ? node : node + 1)];
  pointFunctions(node);
  for (int g = 0; g < a.count; ++g) d_[a.d + at(g * stride_)] = 0.0;
  for (int g = 1; g < v.count; ++g) {
    const double* f = &f_[0];
    double s = 0, t = 0;
    for (auto q = monomials_->first()[at(g)]; q < monomials_->first()[at(g) + 1]; ++q)
      if (const auto [p, r] = monomials_->pairs()[at(q)]; p != 0) {
        const double slope = monomials_->grade(p) * f[a.f + at(p * stride_)];
        s += slope * f[twin.f + at(r * stride_)];
        if (v.op == Op::sin) t += slope * f[v.f + at(r * stride_)];
      }
    put(v, g, 0, s / monomials_->grade(g));
    if (v.op == Op::sin) put(twin, g, 0, -t / monomials_->grade(g));
    if (v.op != Op::tanh) continue;
    for (auto q = monomials_->first()[at(g)]; q < monomials_->first()[at(g) + 1]; ++q)
      t += f[v.f + at(monomials_->pairs()[at(q)].a * stride_)] * f[v.f + at(monomials_->pairs()[at(q)].b * stride_)];
    put(twin, g, 0, -t);
  }
}

void PolynomialSeries::computeFrameOrder(int i, double h0) {
  double* out = scratch_.data();
  for (int row = 0; row < n_; ++row)
    for (int column = 0; column < n_; ++column) {
      goOnUnlessCancelled();
      std::fill(out, out + frameCount_, 0.0);
      for (int k = 0; k < n_; ++k) {
        const int entry = outputs_[at(n_ + row * n_ + k)];
        if (isKnownZero(entry)) continue;
        product(plan_[at(entry)], plan_[at(frameNode(k, column))], frameCount_, i, out);
      }
      const Plan& psi = plan_[at(frameNode(row, column))];
      for (int g = 0; g < frameCount_; ++g) put(psi, g, i + 1, out[g] * h0 / (i + 1));
    }
}

}  // namespace gamut
