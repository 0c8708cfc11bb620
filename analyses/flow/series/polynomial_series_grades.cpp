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
    if (grades_.targets.empty() || grades_.targets.back() != target) grades_.targets.push_back(target);
    if (!plan_[left].constant) grades_.products.push_back({left, right, target, isSlope});
  };
  for (int x = 0; x < plan_.ofProgram; ++x) {
    const SeriesNode& v = plan_[x];
    switch (v.op) {
      case Op::mul:
        if (!plan_[v.a].constant) add(v.a, v.b, x);
        break;
      case Op::sqr:
        add(v.a, v.a, x);
        break;
      case Op::solution: {
        const System& system = systems_[solutions_[v.a].system];
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
  grades_.isKept.assign(plan_.nodes.size(), 0);
  for (int x = 0; x < plan_.size(); ++x) {
    const SeriesNode& v = plan_[x];
    grades_.isKept[x] = static_cast<char>(!isOperation(v.op) || v.r != SeriesNode::none || v.d != SeriesNode::none);
    if (isFunction(v.op) && withFunction<FlowFunction>(v.op, [](auto f) { return f.measuresResidual; }))
      grades_.isKept[v.a] = 1;
  }
  for (const ByGrades::Product& product : grades_.products) grades_.isKept[product.left] = 1;
  for (const int node : plan_.outputs) grades_.isKept[node] = 1;
  for (const System& system : systems_)
    for (const int entry : system.entries) grades_.isKept[entry] = 1;
  grades_.sums.assign(t_.size(), 0.0);
  grades_.weighted.assign(total_.size(), 0.0);
  const std::size_t wide = at(stride()) * at(lanes);
  grades_.lanes.assign(plan_.nodes.size() * wide, 0.0);
  grades_.slopeAt.assign(plan_.nodes.size(), SeriesNode::none);
  std::size_t size = 0;
  for (int x = 0; x < plan_.size(); ++x)
    if (plan_[x].d != SeriesNode::none) {
      grades_.slopeAt[x] = size;
      size += wide;
    }
  grades_.slopes.assign(size, 0.0);
  if (!plan_.withFrame) return;
  const int last = monomials().countUpTo(plan_.frameDegree);
  grades_.frameProducts = ZeroedNumbers(at(plan_.states * plan_.states) * at(last) * at(stride()));
  grades_.frameLanes.assign(at(plan_.states * plan_.states) * wide, 0.0);
}

void PolynomialSeries::computeByGrades(double h0) {
  Work::count(Work::coefficient, static_cast<double>(f_.size()));
  computeLeadingGrade(h0);
  for (int q = 1; q <= monomials().degree(); ++q) {
    multiplyGrade(q);
    const int last = monomials().countUpTo(q);
    for (int g = monomials().firstOf(q); g < last; g += lanes) {
      goOnUnlessCancelled();
      computeLanes(q, g, std::min(lanes, last - g), h0);
    }
  }
}

/// What lies in the coefficients of 1: the recursion without symbols.
void PolynomialSeries::computeLeadingGrade(double h0) {
  for (int x = 0; x < plan_.ofProgram; ++x)
    if (const SeriesNode& v = plan_[x]; v.op == Op::state && !plan_.withFrame) {
      std::copy_n(series(v), stride(), &thin_.known[x * stride()]);
    }
  for (int node = plan_.time + 1; node < plan_.ofProgram; ++node) computeLeadingValue(node);
  for (int x = 0; x < plan_.size(); ++x) thin_.current[x] = leadingOf(x);
  if (m_ > 1) kernels::thinRecursion(thin_, plan_.time, m_, h0);
  std::fill(grades_.sums.begin(), grades_.sums.end(), 0.0);
  for (int x = 0; x < plan_.size(); ++x) {
    const SeriesNode& v = plan_[x];
    if (v.r != SeriesNode::none) std::copy_n(series(v), stride(), &r_[v.r + at(kernels::padding(stride()))]);
    for (int i = 0; i < stride(); ++i)
      grades_.weighted[at(x * stride()) + at(i)] = grades_.sums[v.t + at(i)] = std::fabs(f_[v.f + at(i)]);
  }
}

/// Orders of time that keep grade q.
int PolynomialSeries::ordersOf(int q) const {
  int orders = 0;
  while (orders < m_ && plan_.gradeOf(orders) >= q) ++orders;
  return orders;
}

/// What products of lower grades, none of them 0, make of grade q: into the places of the nodes that they are part of.
void PolynomialSeries::multiplyGrade(int q) {
  const int first = monomials().firstOf(q), last = monomials().countUpTo(q), orders = ordersOf(q);
  const auto clear = [&](double* series) {
    if (stride() == 1) {
      std::fill(series + first, series + last, 0.0);
      return series;
    }
    for (double* row = series + first * stride(); row < series + last * stride(); row += stride())
      for (int i = 0; i < orders; i += 8)
        for (int j = 0; j < 8; ++j) row[i + j] = 0;
    return series;
  };
  const auto multiply = [&](const double* left, const SeriesNode& a, const SeriesNode& b, bool isInvariant,
                            double* out) {
    goOnUnlessCancelled();
    kernels::multiplySeries(monomials(), q, 1, left, a.invariant ? 1 : m_, &r_[b.r], stride(), isInvariant ? 1 : orders,
                            out);
  };
  auto next = grades_.targets.begin();
  const auto clearUpTo = [&](int target) {
    for (; next != grades_.targets.end() && *next <= target; ++next)
      if (plan_[*next].degree >= q) clear(series(plan_[*next]));
  };
  for (const ByGrades::Product& product : grades_.products) {
    clearUpTo(product.target);
    const SeriesNode &v = plan_[product.target], &a = plan_[product.left], &b = plan_[product.right];
    if (v.degree < q) continue;
    double* out = series(v);
    multiply(product.isSlope ? slopes(a) : series(a), a, b, v.invariant, out);
    if (product.isSlope) kernels::multiplyGraded(monomials(), q, series(a), &r_[b.r], stride(), out);
  }
  clearUpTo(plan_.ofProgram);
  if (!plan_.withFrame || q > plan_.frameDegree) return;
  for (int row = 0; row < plan_.states; ++row)
    for (int column = 0; column < plan_.states; ++column) {
      double* out = clear(&grades_.frameProducts[(row * plan_.states + column) * plan_.frameCount * stride()]);
      for (int k = 0; k < plan_.states; ++k) {
        const SeriesNode& a = plan_[plan_.jacobian(row, k)];
        if (!a.constant) multiply(series(a), a, plan_[plan_.frameNode(k, column)], false, out);
      }
    }
}

/// The recursion in time for `count` monomials of grade q, from number `first` on.
void PolynomialSeries::computeLanes(int q, int first, int count, double h0) {
  const bool isFrame = plan_.withFrame && q <= plan_.frameDegree;
  const int orders = ordersOf(q), entries = isFrame ? plan_.states * plan_.states : 0;
  const auto load = [&](const double* series, int from, int to, double* out) {
    kernels::loadLanes(series + first * stride(), stride(), count, from, to, out);
  };
  for (int x = 0; x < plan_.time; ++x) load(series(x), 0, x < plan_.states && !plan_.withFrame ? m_ : 1, lane(x, 0));
  for (const int target : grades_.targets)
    if (const SeriesNode& v = plan_[target]; v.degree >= q)
      load(series(v), 0, v.invariant ? 1 : orders, lane(target, 0));
  for (int e = 0; e < entries; ++e) {
    load(series(plan_.ofProgram + e), 0, 1, lane(plan_.ofProgram + e, 0));
    load(&grades_.frameProducts[e * plan_.frameCount * stride()], 0, orders, &grades_.frameLanes[e * stride() * lanes]);
  }
  for (int i = 0; i < orders; ++i) {
    for (int x = 0; x < plan_.ofProgram; ++x) {
      if (plan_[x].degree < q || (i > 0 && plan_[x].invariant)) continue;
      if (x > plan_.time) computeLane(x, i, q);
      if (grades_.slopeAt[x] == SeriesNode::none) continue;
      const double* from = lane(x, i);
      double* to = &grades_.slopes[grades_.slopeAt[x] + at(i * lanes)];
      for (int l = 0; l < lanes; ++l) to[l] = i * from[l];
    }
    if (!plan_.withFrame) continue;
    for (int s = 0; s < plan_.states; ++s) {
      const double* from = lane(plan_.outputs[s], i);
      double* to = lane(s, i + 1);
      for (int l = 0; l < lanes; ++l) to[l] = from[l] * h0 / (i + 1);
    }
    if (isFrame) computeFrameLanes(i, h0);
  }
  // x' = v keeps what v has.
  for (int i = orders; plan_.withFrame && i < m_; ++i)
    for (int s = 0; s < plan_.states; ++s) {
      const int slope = plan_.outputs[s];
      const double* from = lane(slope, i);
      double* to = lane(s, i + 1);
      for (int l = 0; l < lanes; ++l) to[l] = slope < plan_.states ? from[l] * h0 / (i + 1) : 0.0;
    }
  double multiplicities[lanes] = {};
  for (int l = 0; l < count; ++l) multiplicities[l] = monomials().multiplicity(first + l);
  for (int x = 0; x < plan_.ofProgram + entries; ++x) {
    const SeriesNode& v = plan_[x];
    if (v.degree < q || x == plan_.time || v.constant) continue;
    const int computed = v.invariant && v.op != Op::state ? 1 : orders;
    const int end = v.op != Op::state ? computed : plan_.withFrame ? m_ + 1 : m_;
    kernels::sumLanes(lane(x, 0), end, multiplicities, &grades_.sums[v.t + at(q * stride())],
                      &grades_.weighted[x * stride()]);
    if (!grades_.isKept[x]) continue;
    kernels::storeLanes(lane(x, 0), end, count, series(v, first), stride());
    if (v.r != SeriesNode::none)
      kernels::storeLanes(lane(x, 0), end, count,
                          &r_[v.r + at(first * kernels::paddedStride(stride()) + kernels::padding(stride()))],
                          kernels::paddedStride(stride()));
    if (v.d != SeriesNode::none)
      kernels::storeLanes(&grades_.slopes[grades_.slopeAt[x]], computed, count, slopes(v, first), stride());
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
  const SeriesNode& v = plan_[node];
  if (v.constant || isTwin(v.op)) return;
  if (v.op == Op::solution) {
    if (v.b == 0) computeSolutionLanes(node, i);
    return;
  }
  const SeriesNode& a = plan_[v.a];
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
  Solution& solution = solutions_[plan_[first].a];
  const System& system = systems_[solution.system];
  const int n = system.size;
  double* right = rightSides_.data();
  double terms = 0;
  for (int k = 0; k < n; ++k) {
    double* sum = lane(first + k, i);
    for (int j = 0; j < n; ++j) {
      const int entry = system.entry(k, j);
      const SeriesNode& a = plan_[entry];
      if (a.constant) continue;
      const int orders = a.invariant ? 0 : i;
      ++terms;
      kernels::convolveLanes(series(a), 1, orders, lane(first + j, 0), i, sum);
      kernels::convolveLanes(series(first + j), i - orders, i, lane(entry, 0), i, sum);
    }
    const double* b = lane(solution.rightSide[k], i);
    for (int l = 0; l < lanes; ++l) right[l * n + k] = b[l] - sum[l];
  }
  for (int l = 0; l < lanes; ++l) system.factors.solve(right + l * n, &solution.residual[i * n]);
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < lanes; ++l) lane(first + k, i)[l] = right[l * n + k];
  Work::count(Work::matrixTerm, lanes * (4.0 * n * n + terms * i / 4));
}

/// Order i + 1 of Ψ, of the monomials in lanes.
void PolynomialSeries::computeFrameLanes(int i, double h0) {
  for (int row = 0; row < plan_.states; ++row)
    for (int column = 0; column < plan_.states; ++column) {
      double* sum = &grades_.frameLanes[((row * plan_.states + column) * stride() + i) * lanes];
      for (int k = 0; k < plan_.states; ++k) {
        const int entry = plan_.jacobian(row, k), other = plan_.frameNode(k, column);
        if (plan_[entry].isZero) continue;
        const SeriesNode& a = plan_[entry];
        const int orders = a.invariant ? 0 : i;
        kernels::convolveLanes(series(a), 0, orders, lane(other, 0), i, sum);
        if (!a.constant) kernels::convolveLanes(series(other), i - orders, i, lane(entry, 0), i, sum);
      }
      double* psi = lane(plan_.frameNode(row, column), i + 1);
      for (int l = 0; l < lanes; ++l) psi[l] = sum[l] * h0 / (i + 1);
    }
}

}  // namespace gamut
