// The recursion: coefficients of every node in plain floating point, order by order; of
// many monomials by grades (polynomial_series_grades.cpp). No bound is computed here.
#include "analyses/flow/series/polynomial_series.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "analyses/flow/series/kernels.hpp"
#include "analyses/flow/series/operations/all.hpp"
#include "analyses/work.hpp"

namespace gamut {

PolynomialSeries::PolynomialSeries(const Program& program, int primaryOutputs,
                                   std::shared_ptr<const Monomials> monomials, int frameDegree, int order,
                                   bool withFrame, const std::atomic<bool>* cancelled)
    : plan_(program, primaryOutputs, std::move(monomials), frameDegree, order, withFrame),
      m_(order),
      cancelled_(cancelled),
      kinks_(plan_.nodes),
      f_(plan_.sizes.f),
      r_(plan_.sizes.r),
      d_(plan_.sizes.d),
      t_(plan_.sizes.t),
      s2_(plan_.sizes.s2),
      beyond_(plan_.sizes.beyond),
      inverse_(plan_.sizes.inverse),
      z_(plan_.sizes.z) {
  radius_ = plan_.radii;
  varies_.assign(program.parameters(), 0);
  planSystems(program);
  for (auto* v : {&pointError_, &norm_, &weighted_, &top_}) v->assign(plan_.nodes.size(), 0.0);
  for (auto* v : {&own_, &rho_}) v->assign(plan_.nodes.size(), {});
  for (auto* v : {&total_, &s1_}) v->assign(plan_.nodes.size() * at(stride()), 0.0);
  scratch_.assign(count(), 0.0);
  scratch2_.assign(std::max(count(), largestSystem_), 0.0);
  rightSides_.assign(largestSystem_ * count(), 0.0);
  combination_.assign(systems_.empty() ? 0 : at(count() * kernels::reversedStride(stride())), 0.0);
  for (auto* v : {&vector_, &vector2_}) v->assign(at(largestSystem_), 0.0);
  power_.assign(std::max(stride(), 2), 0.0);
  weights_.assign(stride(), 0.0);
  putConstants();
  if (plan_.isByGrades || count() == 1) prepareThin();
  if (plan_.isByGrades) planGrades();
}

void PolynomialSeries::prepareThin() {
  for (const SeriesNode& v : plan_.nodes)
    thin_.nodes.push_back({v.op, v.invariant, v.op == Op::mul && plan_[v.a].invariant, v.a, v.b, series(v),
                           v.r == SeriesNode::none ? nullptr
                           : plan_.isByGrades      ? &z_[v.z + at(stride() - 1)]
                                                   : &r_[v.r + at(stride() - 1)],
                           v.d == SeriesNode::none ? nullptr : slopes(v),
                           &kinks_[static_cast<int>(thin_.nodes.size())].chord.slope});
  thin_.current.assign(plan_.nodes.size(), 0.0);
  if (!plan_.withFrame) {
    thin_.known.assign(plan_.states * stride(), 0.0);
    for (int s = 0; s < plan_.states; ++s) thin_.nodes[s].known = &thin_.known[s * stride()];
  }
  for (int s = 0; s < plan_.states && plan_.withFrame; ++s) thin_.states.emplace_back(s, plan_.outputs[s]);
  for (int i = 0; i < plan_.states && plan_.withFrame; ++i)
    for (int j = 0; j < plan_.states; ++j) {
      kernels::ThinSum row{plan_.frameNode(i, j), {}};
      for (int k = 0; k < plan_.states; ++k)
        if (const int a = plan_.jacobian(i, k); !plan_[a].isZero) row.terms.emplace_back(a, plan_.frameNode(k, j));
      thin_.frame.push_back(std::move(row));
    }
  for (Solution& solution : solutions_) {
    const System& system = systems_[solution.system];
    solution.thin = {&system.factors, solution.residual.data(), system.entries, solution.rightSide};
    for (int& entry : solution.thin.matrix)
      if (plan_[entry].invariant) entry = -1;
    thin_.solutions.push_back(&solution.thin);
  }
}

void PolynomialSeries::setFineOrders(int orders) {
  if (count() > 1 || !plan_.withFrame || isFine() || orders < 2)
    throw std::invalid_argument("double-double orders, two at least, are for series without symbols, said once");
  orders = std::min(orders, m_);
  std::vector<FineRecursion::Node> nodes;
  std::vector<FineRecursion::Solution> solutions(solutions_.size());
  std::vector<std::pair<int, int>> states;
  std::vector<int> computed;
  for (int x = 0; x < plan_.ofProgram; ++x) {
    const SeriesNode& v = plan_[x];
    nodes.push_back({v.op, v.a, v.b, v.invariant});
    if (!v.primary) continue;
    thin_.nodes[x].fine = true;
    if (isOperation(v.op)) computed.push_back(x);
    if (v.op != Op::solution || v.b > 0) continue;
    System& system = systems_[solutions_[v.a].system];
    solutions[v.a] = {&system.factors, !system.isFine, system.entries, solutions_[v.a].rightSide, {}};
    system.isFine = true;
  }
  for (int s = 0; s < plan_.states; ++s) states.emplace_back(s, plan_.outputs[s]);
  thin_.leading = {orders, computed, std::vector<double>(plan_.ofProgram * orders)};
  for (int s = 0; s < plan_.states; ++s) thin_.leading.nodes.push_back(s);
  fine_.plan(orders, std::move(nodes), std::move(computed), std::move(solutions), std::move(states), plan_.time);
  for (int x = 0; x < plan_.ofProgram; ++x)
    if (plan_[x].constant) fine_.set(x, {plan_.constants[x], 0});
}

void PolynomialSeries::clear() {
  for (ZeroedNumbers* v : {&f_, &r_, &d_}) std::fill(v->begin(), v->end(), 0.0);
  std::fill(z_.begin(), z_.end(), 0.0);
  putConstants();
}

void PolynomialSeries::putConstants() {
  for (int i = 0; i < plan_.ofProgram; ++i)
    if (plan_[i].constant) put(plan_[i], 0, 0, plan_.constants[i]);
}

void PolynomialSeries::setState(int i, const double* coefficients) {
  for (int g = 0; g < count(); ++g) put(plan_[i], g, 0, coefficients[g]);
  if (isFine()) setStateLow(i, 0);
}

void PolynomialSeries::setOrder(int order) {
  if (order == m_) return;
  m_ = order;
  clear();
}

void PolynomialSeries::setStateSeries(int i, const double* series, int spacing) {
  for (int g = 0; g < count(); ++g)
    for (int order = 0; order < m_; ++order) put(plan_[i], g, order, series[g * spacing + order]);
}

void PolynomialSeries::setParameter(int i, const double* coefficients, double radius) {
  for (int g = 0; g < count(); ++g) put(plan_[plan_.states + i], g, 0, coefficients[g]);
  radius_[plan_.states + i] = radius;
  if (isFine()) fine_.set(plan_.states + i, {coefficients[0], 0});
}

void PolynomialSeries::setParameter(int i, const Embedded& value) {
  std::vector<double>& coefficients = scratch_;
  std::fill(coefficients.begin(), coefficients.end(), 0.0);
  coefficients[0] = value.centre;
  if (value.symbol >= 0) coefficients[monomials().linear(value.symbol)] = value.half;
  setParameter(i, coefficients.data(), isFine() ? value.radius : value.coarseRadius());
  if (isFine()) fine_.set(plan_.states + i, {value.centre, value.low});
}

void PolynomialSeries::setVarying(const std::vector<int>& parameters) {
  for (const int parameter : parameters) varies_[parameter] = 1;
}

void PolynomialSeries::setFrame(int i, int j, const double* coefficients, int spacing) {
  const SeriesNode& v = plan_[plan_.frameNode(i, j)];
  for (int g = 0; g < plan_.frameCount; ++g) put(v, g, 0, coefficients[g * spacing]);
}

void PolynomialSeries::compute(double t0, double h0) {
  for (System& system : systems_) {
    system.isFactorised = false;
    system.multipliedFor = 0;
  }
  put(plan_[plan_.time], 0, 0, t0);
  if (m_ > 1) put(plan_[plan_.time], 0, 1, h0);
  if (plan_.isByGrades) return computeByGrades(h0);
  if (!thin_.nodes.empty()) {
    if (isFine()) computeLeading(t0, h0);
    for (int x = 0; x < plan_.states && !plan_.withFrame; ++x)
      std::copy_n(series(x), stride(), &thin_.known[x * stride()]);
    for (int node = plan_.time + 1; node < plan_.ofProgram; ++node)
      if (!isFine(node)) computeLeadingValue(node);
    for (int x = 0; x < plan_.size(); ++x) thin_.current[x] = leadingOf(x);
    kernels::thinRecursion(thin_, plan_.time, m_, h0);
    return;
  }
  Work::count(Work::coefficient, static_cast<double>(f_.size()));
  for (int i = 0; i < m_; ++i) {
    for (int node = plan_.time + 1; node < plan_.ofProgram; ++node) {
      goOnUnlessCancelled();
      computeOrder(node, i);
    }
    if (!plan_.withFrame) continue;
    for (int s = 0; s < plan_.states; ++s) {
      const SeriesNode& from = plan_[plan_.outputs[s]];
      const double* f = series(from);
      const int kept = from.op == Op::state ? from.count : plan_.countOf(from, i);  // x' = v: all that v has
      for (int g = 0; g < kept; ++g) put(plan_[s], g, i + 1, f[g * stride() + i] * h0 / (i + 1));
    }
    computeFrameOrder(i, h0);
  }
}

/// The first orders of all primary nodes.
void PolynomialSeries::computeLeading(double t0, double h0) {
  fine_.compute(t0, h0);
  for (System& system : systems_) system.isFactorised = system.isFine;
  for (const int node : thin_.leading.nodes) {
    for (int i = 0; i < thin_.leading.orders; ++i)
      thin_.leading.values[node * thin_.leading.orders + i] = fine_.value(node, i).hi;
    put(plan_[node], 0, 0, fine_.value(node, 0).hi);
    pointError_[node] = fine_.pointError(node);
  }
}

/// Order 0 of the coefficient of 1.
void PolynomialSeries::computeLeadingValue(int node) {
  const SeriesNode& v = plan_[node];
  const auto value = [&](int of) { return leadingOf(of); };
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
void PolynomialSeries::product(const SeriesNode& a, const SeriesNode& b, int count, int i, double* out) {
  if (a.constant) {
    const double c = series(a)[0];
    for (int g = 0; g < count; ++g) out[g] += c * series(b, g)[i];
  } else if (a.invariant) {
    kernels::multiply(monomials(), count, series(a), &f_[b.f + at(i)], stride(), out);
  } else {
    convolve(count, series(a), b, i, out);
  }
}

/// |a| over [low, high], low < 0 < high, lies between the chord and -2 low high/(high - low) below it.
SeriesKinks::Chord PolynomialSeries::chordOf(int node) const {
  const SeriesKinks::Argument& u = kinks_.argument(node);
  if (u.side != 0) return {u.side, 0.0};
  if (u.passed != 0) return {u.passed, 0.0};
  const SeriesNode& v = plan_[node];
  const double centre = series(v)[0];
  double half = 0;
  for (int g = 1; g < v.count; ++g) half += std::fabs(series(v, g)[0]);
  half = std::max(half, u.crossing);
  if (std::fabs(centre) >= half) return {centre > 0 ? 1.0 : centre < 0 ? -1.0 : 0.0, 0.0};
  const double low = centre - half, high = centre + half;
  return {(high + low) / (high - low), -low * high / (high - low)};
}

double PolynomialSeries::signOf(int node) const {
  if (kinks_[node].given) return kinks_[node].about;
  const SeriesNode& v = plan_[node];
  const double slope = chordOf(v.a).slope;
  return v.primary && std::fabs(slope) < 1 ? 0.0 : slope;
}

void PolynomialSeries::computeOrder(int node, int i) {
  const SeriesNode& v = plan_[node];
  if ((v.invariant && i > 0) || v.op == Op::constant || isTwin(v.op)) return;
  if (v.op == Op::solution) {
    if (v.b == 0) computeSolution(node, i);
    return;
  }
  const SeriesNode& a = plan_[v.a];
  const double* fa = series(a);
  const int N = plan_.countOf(v, i);
  double* out = scratch_.data();
  switch (v.op) {
    case Op::add: {
      const double* fb = series(v.b);
      for (int g = 0; g < N; ++g) put(v, g, i, fa[g * stride() + i] + fb[g * stride() + i]);
      return;
    }
    case Op::sub: {
      const double* fb = series(v.b);
      for (int g = 0; g < N; ++g) put(v, g, i, fa[g * stride() + i] - fb[g * stride() + i]);
      return;
    }
    case Op::neg:
      for (int g = 0; g < N; ++g) put(v, g, i, -fa[g * stride() + i]);
      return;
    case Op::mul:
    case Op::sqr:
      std::fill(out, out + N, 0.0);
      product(a, plan_[v.op == Op::sqr ? v.a : v.b], N, i, out);
      for (int g = 0; g < N; ++g) put(v, g, i, out[g]);
      return;
    default:
      return withFunction<FlowFunction>(v.op,
                                        [&](auto f) { i == 0 ? f.series(*this, node) : f.order(*this, node, i); });
  }
}

/// Counts as zero in the sums.
void PolynomialSeries::clearOrder(const SeriesNode& v, int i) {
  for (int g = 0; g < plan_.countOf(v, i); ++g) put(v, g, i, 0.0);
}

/// Σ_j left_j right_{i-j} over stored orders, of the monomials of v; until the next.
double* PolynomialSeries::convolved(const SeriesNode& v, int i, const double* left, const SeriesNode& right) {
  const int count = plan_.countOf(v, i);
  std::fill_n(scratch_.begin(), count, 0.0);
  convolve(count, left, right, i, scratch_.data());
  return scratch_.data();
}

/// The numerator of order i by the leading polynomial of its denominator.
const double* PolynomialSeries::divided(int node, int i, const double* numerator) {
  const int count = plan_.countOf(plan_[node], i);
  std::fill_n(scratch2_.begin(), count, 0.0);
  kernels::multiply(monomials(), count, numerator, &inverse_[plan_[node].inverse], 1, scratch2_.data());
  return scratch2_.data();
}

/// j·(order j) of a node, that of order i anew.
const double* PolynomialSeries::putSlope(const SeriesNode& v, int i) {
  for (int g = 0; g < plan_.countOf(v, i - 1); ++g) slopes(v, g)[i] = i * series(v, g)[i];
  return slopes(v);
}

/// 1 / leading polynomial, truncated: inv_0 = 1/b_0, inv_g = -Σ_{α≠0} b_α inv_{g/α} / b_0.
const double* PolynomialSeries::invertLeading(int node, const SeriesNode& b) {
  double* inverse = &inverse_[plan_[node].inverse];
  inverse[0] = 1.0 / series(b)[0];
  for (int g = 1; g < plan_[node].count; ++g)
    inverse[g] = -sumOverPairs(g, [&](int p, int r) { return series(b, p)[0] * inverse[r]; }) * inverse[0];
  return inverse;
}

void PolynomialSeries::computeFrameOrder(int i, double h0) {
  double* out = scratch_.data();
  for (int row = 0; row < plan_.states; ++row)
    for (int column = 0; column < plan_.states; ++column) {
      goOnUnlessCancelled();
      std::fill(out, out + plan_.frameCount, 0.0);
      for (int k = 0; k < plan_.states; ++k) {
        const int entry = plan_.jacobian(row, k);
        if (plan_[entry].isZero) continue;
        product(plan_[entry], plan_[plan_.frameNode(k, column)], plan_.frameCount, i, out);
      }
      const SeriesNode& psi = plan_[plan_.frameNode(row, column)];
      for (int g = 0; g < plan_.frameCount; ++g) put(psi, g, i + 1, out[g] * h0 / (i + 1));
    }
}

}  // namespace gamut
