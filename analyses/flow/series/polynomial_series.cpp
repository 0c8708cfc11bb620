// The recursion: coefficients of every node in plain floating point, order by order; of
// many monomials by grades (polynomial_series_grades.cpp). No bound is computed here.
#include "analyses/flow/series/polynomial_series.hpp"

#include <algorithm>
#include <cmath>

#include "analyses/flow/series/kernels.hpp"
#include "analyses/flow/series/operations/all.hpp"
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
    case Op::mul:
      return set(value(v.a) * value(v.b));
    case Op::sqr:
      return set(value(v.a) * value(v.a));
    case Op::solution:
      if (v.b == 0) computeLeadingSolution(node);
      return;
    default:
      if (isFunction(v.op) && !isTwin(v.op))
        withFunction<FlowFunction>(v.op, [&](auto f) { f.putLeading(*this, node); });
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
    case Op::mul:
    case Op::sqr:
      std::fill(out, out + N, 0.0);
      product(a, plan_[at(v.op == Op::sqr ? v.a : v.b)], N, i, out);
      for (int g = 0; g < N; ++g) put(v, g, i, out[g]);
      return;
    default:
      return withFunction<FlowFunction>(v.op, [&](auto f) { i == 0 ? f.row(*this, node) : f.order(*this, node, i); });
  }
}

/// Counts as zero in the sums.
void PolynomialSeries::clearOrder(const Plan& v, int i) {
  for (int g = 0; g < countOf(v, i); ++g) put(v, g, i, 0.0);
}

/// Σ_j left_j right_{i-j} over stored orders, of the monomials of v.
const double* PolynomialSeries::convolved(const Plan& v, int i, const double* left, const Plan& right,
                                          std::vector<double>& out) {
  const int count = countOf(v, i);
  std::fill_n(out.begin(), count, 0.0);
  kernels::convolve(monomials_->pairs().data(), monomials_->first().data(), count, left, &r_[right.r], stride_, i,
                    out.data());
  return out.data();
}

/// The numerator of order i by the leading polynomial of its denominator.
const double* PolynomialSeries::divided(int node, int i, const double* numerator) {
  const int count = countOf(plan_[at(node)], i);
  std::fill_n(scratch2_.begin(), count, 0.0);
  kernels::multiply(*monomials_, count, numerator, &inverse_[inverseAt_[at(node)]], 1, scratch2_.data());
  return scratch2_.data();
}

/// j·(order j) of a node, that of order i anew.
const double* PolynomialSeries::putSlope(const Plan& v, int i) {
  for (int g = 0; g < countOf(v, i - 1); ++g) d_[v.d + at(g * stride_ + i)] = i * f_[v.f + at(g * stride_ + i)];
  return &d_[v.d];
}

/// 1 / leading polynomial, truncated: inv_0 = 1/b_0, inv_g = -Σ_{α≠0} b_α inv_{g/α} / b_0.
const double* PolynomialSeries::invertLeading(int node, const Plan& b) {
  double* inverse = &inverse_[inverseAt_[at(node)]];
  inverse[0] = 1.0 / f_[b.f];
  for (int g = 1; g < plan_[at(node)].count; ++g)
    inverse[g] = -sumOverPairs(g, [&](int p, int r) { return f_[b.f + at(p * stride_)] * inverse[r]; }) * inverse[0];
  return inverse;
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
