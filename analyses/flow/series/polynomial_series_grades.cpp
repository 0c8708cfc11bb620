// The recursion grade by grade in ξ, for many monomials. Of a grade q, everything that was computed before enters as a
// sum of products of whole series in time; what is left is linear in the coefficients of grade q, with series of grade
// 0 as factors, and is a recursion in time for each monomial by itself. So each pair of monomials is met once, and not
// once an order. No bound is computed here.
#include <algorithm>

#include "analyses/flow/series/grade_kernels.hpp"
#include "analyses/flow/series/kernels.hpp"
#include "analyses/flow/series/operations/all.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/work.hpp"

namespace gamut {

using kernels::lanes;

/// Which products a node is made of.
void PolynomialSeries::planProducts() {
  const auto add = [&](int left, int right, int target, bool isSlope = false) {
    if (targets_.empty() || targets_.back() != target) targets_.push_back(target);
    if (!plan_[at(left)].constant) products_.push_back({left, right, target, isSlope});
  };
  for (int x = 0; x < nodes_; ++x) {
    const Plan& v = plan_[at(x)];
    switch (v.op) {
      case Op::mul:
        if (!plan_[at(v.a)].constant) add(v.a, v.b, x);
        break;
      case Op::sqr:
        add(v.a, v.a, x);
        break;
      case Op::solution: {
        const System& system = systems_[at(solutions_[at(v.a)].system)];
        for (int j = 0; j < system.size; ++j) add(system.entry(v.b, j), x - v.b + j, x);
        break;
      }
      default:
        if (isFunction(v.op) && !isTwin(v.op))
          withFunction<FlowFunction>(v.op, [&](auto f) { f.products(x, v.a, v.b, add); });
    }
  }
}

/// Which nodes are computed in each grade, and where they lie.
void PolynomialSeries::planGrades() {
  planProducts();
  // What others read than a node's own sums.
  isKept_.assign(plan_.size(), 0);
  for (std::size_t x = 0; x < plan_.size(); ++x) {
    const Plan& v = plan_[x];
    isKept_[x] = static_cast<char>(!isOperation(v.op) || v.r != none || v.d != none);
    if (isFunction(v.op) && withFunction<FlowFunction>(v.op, [](auto f) { return f.measuresResidual; }))
      isKept_[at(v.a)] = 1;
  }
  for (const Product& product : products_) isKept_[at(product.left)] = 1;
  for (const int node : outputs_) isKept_[at(node)] = 1;
  for (const System& system : systems_)
    for (const int entry : system.entries) isKept_[at(entry)] = 1;
  sums_.assign(t_.size(), 0.0);
  weightedSums_.assign(total_.size(), 0.0);
  const std::size_t wide = at(stride_) * at(lanes);
  lanes_.assign(plan_.size() * wide, 0.0);
  slopeAt_.assign(plan_.size(), none);
  std::size_t size = 0;
  for (std::size_t x = 0; x < plan_.size(); ++x)
    if (plan_[x].d != none) {
      slopeAt_[x] = size;
      size += wide;
    }
  slopes_.assign(size, 0.0);
  if (!withFrame_) return;
  const int last = monomials_->countUpTo(frameDegree_);
  frameProducts_ = ZeroedNumbers(at(n_ * n_) * at(last) * at(stride_));
  frameLanes_.assign(at(n_ * n_) * wide, 0.0);
}

void PolynomialSeries::computeByGrades(double h0) {
  Work::count(Work::coefficient, static_cast<double>(f_.size()));
  computeLeadingGrade(h0);
  for (int q = 1; q <= monomials_->degree(); ++q) {
    multiplyGrade(q);
    const int last = monomials_->countUpTo(q);
    for (int g = monomials_->firstOf(q); g < last; g += lanes) {
      goOnUnlessCancelled();
      computeLanes(q, g, std::min(lanes, last - g), h0);
    }
  }
}

/// What lies in the coefficients of 1: the recursion without symbols.
void PolynomialSeries::computeLeadingGrade(double h0) {
  for (int x = 0; x < nodes_; ++x)
    if (const Plan& v = plan_[at(x)]; v.op == Op::state && !withFrame_) {
      std::copy_n(&f_[v.f], stride_, &known_[at(x * stride_)]);
    }
  for (int node = time_ + 1; node < nodes_; ++node) computeLeadingValue(node);
  for (std::size_t x = 0; x < plan_.size(); ++x) current_[x] = f_[plan_[x].f];
  if (m_ > 1) kernels::thinRecursion(thin_, thinSolutions_, thinStates_, thinFrame_, leading_, time_, m_, h0, current_);
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (std::size_t x = 0; x < plan_.size(); ++x) {
    const Plan& v = plan_[x];
    if (v.r != none) std::copy_n(&f_[v.f], stride_, &r_[v.r + at(kernels::padding(stride_))]);
    for (int i = 0; i < stride_; ++i)
      weightedSums_[x * at(stride_) + at(i)] = sums_[v.t + at(i)] = std::fabs(f_[v.f + at(i)]);
  }
}

/// Orders of time that keep grade q.
int PolynomialSeries::ordersOf(int q) const {
  int orders = 0;
  while (orders < m_ && gradeOf(orders) >= q) ++orders;
  return orders;
}

/// What products of lower grades, none of them 0, make of grade q: into the places of the nodes that they are part of.
void PolynomialSeries::multiplyGrade(int q) {
  const int first = monomials_->firstOf(q), last = monomials_->countUpTo(q), orders = ordersOf(q);
  const auto clear = [&](double* series) {
    if (stride_ == 1) {
      std::fill(series + first, series + last, 0.0);
      return series;
    }
    for (double* row = series + first * stride_; row < series + last * stride_; row += stride_)
      for (int i = 0; i < orders; i += 8)
        for (int j = 0; j < 8; ++j) row[i + j] = 0;
    return series;
  };
  const auto multiply = [&](const double* left, const Plan& a, const Plan& b, bool isInvariant, double* out) {
    goOnUnlessCancelled();
    kernels::multiplySeries(*monomials_, q, 1, left, a.invariant ? 1 : m_, &r_[b.r], stride_, isInvariant ? 1 : orders,
                            out);
  };
  auto next = targets_.begin();
  const auto clearUpTo = [&](int target) {
    for (; next != targets_.end() && *next <= target; ++next)
      if (plan_[at(*next)].degree >= q) clear(&f_[plan_[at(*next)].f]);
  };
  for (const Product& product : products_) {
    clearUpTo(product.target);
    const Plan &v = plan_[at(product.target)], &a = plan_[at(product.left)], &b = plan_[at(product.right)];
    if (v.degree < q) continue;
    double* out = &f_[v.f];
    multiply(product.isSlope ? &d_[a.d] : &f_[a.f], a, b, v.invariant, out);
    if (product.isSlope) kernels::multiplyGraded(*monomials_, q, &f_[a.f], &r_[b.r], stride_, out);
  }
  clearUpTo(nodes_);
  if (!withFrame_ || q > frameDegree_) return;
  for (int row = 0; row < n_; ++row)
    for (int column = 0; column < n_; ++column) {
      double* out = clear(&frameProducts_[at((row * n_ + column) * frameCount_ * stride_)]);
      for (int k = 0; k < n_; ++k) {
        const Plan& a = plan_[at(outputs_[at(n_ + row * n_ + k)])];
        if (!a.constant) multiply(&f_[a.f], a, plan_[at(frameNode(k, column))], false, out);
      }
    }
}

/// The recursion in time for `count` monomials of grade q, from number `first` on.
void PolynomialSeries::computeLanes(int q, int first, int count, double h0) {
  const int orders = ordersOf(q);
  const bool isFrame = withFrame_ && q <= frameDegree_;
  const auto load = [&](const double* series, int from, int to, double* out) {
    kernels::loadLanes(series + first * stride_, stride_, count, from, to, out);
  };
  for (int x = 0; x < time_; ++x) load(&f_[plan_[at(x)].f], 0, x < n_ && !withFrame_ ? m_ : 1, lane(x, 0));
  for (const int target : targets_)
    if (const Plan& v = plan_[at(target)]; v.degree >= q) load(&f_[v.f], 0, v.invariant ? 1 : orders, lane(target, 0));
  if (isFrame)
    for (int e = 0; e < n_ * n_; ++e) {
      load(&f_[plan_[at(nodes_ + e)].f], 0, 1, lane(nodes_ + e, 0));
      load(&frameProducts_[at(e * frameCount_ * stride_)], 0, orders, &frameLanes_[at(e * stride_ * lanes)]);
    }
  for (int i = 0; i < orders; ++i) {
    for (int x = 0; x < nodes_; ++x) {
      if (plan_[at(x)].degree < q || (i > 0 && plan_[at(x)].invariant)) continue;
      if (x > time_) computeLane(x, i, q);
      if (slopeAt_[at(x)] == none) continue;
      const double* from = lane(x, i);
      double* to = &slopes_[slopeAt_[at(x)] + at(i * lanes)];
      for (int l = 0; l < lanes; ++l) to[l] = i * from[l];
    }
    if (!withFrame_) continue;
    for (int s = 0; s < n_; ++s) {
      const double* from = lane(outputs_[at(s)], i);
      double* to = lane(s, i + 1);
      for (int l = 0; l < lanes; ++l) to[l] = from[l] * h0 / (i + 1);
    }
    if (isFrame) computeFrameLanes(i, h0);
  }
  // x' = v keeps what v has.
  for (int i = orders; withFrame_ && i < m_; ++i)
    for (int s = 0; s < n_; ++s) {
      const int slope = outputs_[at(s)];
      const double* from = lane(slope, i);
      double* to = lane(s, i + 1);
      for (int l = 0; l < lanes; ++l) to[l] = slope < n_ ? from[l] * h0 / (i + 1) : 0.0;
    }
  double multiplicities[lanes] = {};
  for (int l = 0; l < count; ++l) multiplicities[l] = monomials_->multiplicity(first + l);
  for (int x = 0; x < nodes_ + (isFrame ? n_ * n_ : 0); ++x) {
    const Plan& v = plan_[at(x)];
    if (v.degree < q || x == time_ || v.constant) continue;
    const int computed = v.invariant && v.op != Op::state ? 1 : orders;
    const int end = v.op != Op::state ? computed : withFrame_ ? m_ + 1 : m_;
    kernels::sumLanes(lane(x, 0), end, multiplicities, &sums_[v.t + at(q * stride_)], &weightedSums_[at(x * stride_)]);
    if (!isKept_[at(x)]) continue;
    kernels::storeLanes(lane(x, 0), end, count, &f_[v.f + at(first * stride_)], stride_);
    if (v.r != none)
      kernels::storeLanes(lane(x, 0), end, count,
                          &r_[v.r + at(first * kernels::paddedStride(stride_) + kernels::padding(stride_))],
                          kernels::paddedStride(stride_));
    if (v.d != none)
      kernels::storeLanes(&slopes_[slopeAt_[at(x)]], computed, count, &d_[v.d + at(first * stride_)], stride_);
  }
}

namespace {

template <class Value>
void setLanes(double* to, const Value& value) {
  for (int l = 0; l < lanes; ++l) to[l] = value(l);
}

}  // namespace

/// Order i of a node, of the monomials in lanes: its place holds what products of lower grades make.
void PolynomialSeries::computeLane(int node, int i, int q) {
  const Plan& v = plan_[at(node)];
  if (v.constant || isTwin(v.op)) return;
  if (v.op == Op::solution) {
    if (v.b == 0) computeSolutionLanes(node, i);
    return;
  }
  const auto series = [&](int x) { return &f_[plan_[at(x)].f]; };  // of grade 0
  const Plan& a = plan_[at(v.a)];
  double* out = lane(node, i);
  const double* of = lane(v.a, i);
  double sum[lanes] = {};
  switch (v.op) {
    case Op::add: {
      const double* other = lane(v.b, i);
      return setLanes(out, [&](int l) { return of[l] + other[l]; });
    }
    case Op::sub: {
      const double* other = lane(v.b, i);
      return setLanes(out, [&](int l) { return of[l] - other[l]; });
    }
    case Op::neg:
      return setLanes(out, [&](int l) { return -of[l]; });
    case Op::mul: {
      const double *left = series(v.a), *right = series(v.b), *other = lane(v.b, i);
      if (a.constant) return setLanes(out, [&](int l) { return left[0] * other[l]; });
      const int orders = a.invariant ? 0 : i;
      kernels::convolveLanes(left, 0, orders, lane(v.b, 0), i, out);
      return kernels::convolveLanes(right, i - orders, i, lane(v.a, 0), i, out);
    }
    case Op::sqr:
      kernels::convolveLanes(series(v.a), 0, i, lane(v.a, 0), i, sum);
      return setLanes(out, [&](int l) { return out[l] + 2 * sum[l]; });
    default:
      return withFunction<FlowFunction>(v.op, [&](auto f) { f.lane(*this, node, i, q); });
  }
}

/// A₀₀ x_{iα} = b_{iα} - what products of lower grades make - Σ (A_{j0} x_{i-j,α} + A_{jα} x_{i-j,0}), but for A₀₀.
void PolynomialSeries::computeSolutionLanes(int first, int i) {
  Solution& solution = solutions_[at(plan_[at(first)].a)];
  const System& system = systems_[at(solution.system)];
  const int n = system.size;
  double* right = rightSides_.data();
  double terms = 0;
  for (int k = 0; k < n; ++k) {
    double* sum = lane(first + k, i);
    for (int j = 0; j < n; ++j) {
      const int entry = system.entry(k, j);
      const Plan& a = plan_[at(entry)];
      if (a.constant) continue;
      const int orders = a.invariant ? 0 : i;
      ++terms;
      kernels::convolveLanes(&f_[a.f], 1, orders, lane(first + j, 0), i, sum);
      kernels::convolveLanes(&f_[plan_[at(first + j)].f], i - orders, i, lane(entry, 0), i, sum);
    }
    const double* b = lane(solution.rightSide[at(k)], i);
    for (int l = 0; l < lanes; ++l) right[l * n + k] = b[l] - sum[l];
  }
  for (int l = 0; l < lanes; ++l) system.factors.solve(right + l * n, &solution.residual[at(i * n)]);
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < lanes; ++l) lane(first + k, i)[l] = right[l * n + k];
  Work::count(Work::matrixTerm, lanes * (4.0 * n * n + terms * i / 4));
}

/// Order i + 1 of Ψ, of the monomials in lanes.
void PolynomialSeries::computeFrameLanes(int i, double h0) {
  for (int row = 0; row < n_; ++row)
    for (int column = 0; column < n_; ++column) {
      double* sum = &frameLanes_[at(((row * n_ + column) * stride_ + i) * lanes)];
      for (int k = 0; k < n_; ++k) {
        const int entry = outputs_[at(n_ + row * n_ + k)], other = frameNode(k, column);
        if (isKnownZero(entry)) continue;
        const Plan& a = plan_[at(entry)];
        const int orders = a.invariant ? 0 : i;
        kernels::convolveLanes(&f_[a.f], 0, orders, lane(other, 0), i, sum);
        if (!a.constant) kernels::convolveLanes(&f_[plan_[at(other)].f], i - orders, i, lane(entry, 0), i, sum);
      }
      double* psi = lane(frameNode(row, column), i + 1);
      for (int l = 0; l < lanes; ++l) psi[l] = sum[l] * h0 / (i + 1);
    }
}

}  // namespace gamut
