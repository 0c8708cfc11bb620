// Order by order, node by node. Sums of products: a product errs by less than 8u², a sum by 3u² of both, a factor j by
// 5u², u = 2^-53; N of them by less than 17 N u² of Σ|products|; what follows, at most three times 2^-98. All of it is
// below N bounds::fine. (Underflow of second doubles is within bounds::tiny a node, beyond 2^996 they are no numbers,
// which is refused.)
#include "analyses/flow/series/fine_recursion.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "scalars/elementary/rounding.hpp"
#include "scalars/elementary/vector_unit.hpp"
#include "scalars/operations/all.hpp"

#ifdef __x86_64__
#define GAMUT_FUSED [[gnu::target("fma")]]
#else
#define GAMUT_FUSED
#endif

namespace gamut {

using detail::at;
using Number = FineRecursion::Number;

namespace {

template <bool fused>
GAMUT_INLINE Number product(const Number& a, const Number& b) {
  Number p = detail::exactProduct<fused>(a.hi, b.hi);
  p.lo += a.hi * b.lo + a.lo * b.hi;
  return detail::exactSum(p.hi, p.lo);
}

GAMUT_INLINE Number sum(const Number& a, const Number& b) {
  const Number s = detail::exactSum(a.hi, b.hi);
  return detail::exactSum(s.hi, s.lo + (a.lo + b.lo));
}

template <bool fused>
GAMUT_INLINE void addProduct(Number& s, const Number& a, const Number& b) {
  Number p = detail::exactProduct<fused>(a.hi, b.hi);
  p.lo += a.hi * b.lo + a.lo * b.hi;
  s = sum(s, p);
}

template <bool fused>
GAMUT_INLINE Number times(const Number& a, double factor) {
  Number p = detail::exactProduct<fused>(a.hi, factor);
  p.lo += a.lo * factor;
  return detail::exactSum(p.hi, p.lo);
}

template <class F>
constexpr bool hasFineForm = requires(const Number& u, detail::FineValue& point) {
  F::fine(u, std::true_type());
}
|| requires(const Number& u, detail::FineValue& point) { F::fine(u, point, point); };

}  // namespace

/// As operations/function.hpp asks for it.
template <bool fused>
struct FineRecursion::Orders {
  FineRecursion& of;

  Number& at(int node, int i) const { return of.values_[of.first(node) + detail::at(i)]; }
  /// Σ a_j b_{i-j} for from ≤ j ≤ to.
  GAMUT_INLINE Number convolution(int a, int b, int i, int from, int to) const {
    Number s{0, 0};
    for (int j = from; j <= to; ++j) addProduct<fused>(s, at(a, j), at(b, i - j));
    return s;
  }
  /// Σ j a_j b_{i-j} / i for 1 ≤ j ≤ to.
  GAMUT_INLINE Number slopes(int a, int b, int i, int to) const {
    Number s{0, 0};
    for (int j = 1; j <= to; ++j) addProduct<fused>(s, times<fused>(at(a, j), j), at(b, i - j));
    return quotient(s, {static_cast<double>(i), 0});
  }
  GAMUT_INLINE Number difference(const Number& x, const Number& y) const { return sum(x, -y); }
  GAMUT_INLINE Number quotient(const Number& x, const Number& y) const { return detail::quotient<fused>(x, y); }
  GAMUT_INLINE Number half(const Number& x) const { return {0.5 * x.hi, 0.5 * x.lo}; }

  GAMUT_INLINE void begin(auto f, int node, int a) const {
    detail::FineValue first{}, second{};
    if constexpr (requires { f.fine(at(a, 0), first, second); }) {
      f.fine(at(a, 0), first, second);
      put(node + 1, second);
    } else {
      first = f.fine(at(a, 0), std::bool_constant<fused>());
    }
    put(node, first);
  }

 private:
  void put(int node, const detail::FineValue& point) const {
    at(node, 0) = point.value;
    of.pointError_[node] = point.error;
  }
};

bool FineRecursion::isPossible(const std::vector<gamut::Node>& nodes) {
  return std::ranges::all_of(nodes, [](const gamut::Node& v) {
    return !isFunction(v.op) || isTwin(v.op) || withFunction(v.op, [](auto f) { return hasFineForm<decltype(f)>; });
  });
}

void FineRecursion::plan(int orders, std::vector<Node> nodes, std::vector<int> computed,
                         std::vector<Solution> solutions, std::vector<std::pair<int, int>> states, int time) {
  orders_ = orders;
  nodes_ = std::move(nodes);
  computed_ = std::move(computed);
  solutions_ = std::move(solutions);
  states_ = std::move(states);
  time_ = time;
  values_.assign(nodes_.size() * at(orders), {0, 0});
  pointError_.assign(nodes_.size(), 0.0);
  std::size_t largest = 0;
  for (Solution& solution : solutions_) {
    solution.residual.assign(solution.rightSide.size() * at(orders), 0.0);
    largest = std::max(largest, solution.rightSide.size());
  }
  rightSide_.assign(largest, {0, 0});
  correction_.assign(largest, 0.0);
  unused_.assign(largest, 0.0);
}

double FineRecursion::residual(int solution, int component, int order) const {
  const Solution& s = solutions_[solution];
  return s.residual[at(order) * s.rightSide.size() + at(component)];
}

void FineRecursion::compute(double t0, double h0) {
  if (detail::hasFusedMultiplyAdd)
    runFused(t0, h0);
  else
    run<false>(t0, h0);
}

GAMUT_FUSED void FineRecursion::runFused(double t0, double h0) { run<true>(t0, h0); }

template <bool fused>
GAMUT_INLINE void FineRecursion::run(double t0, double h0) {
  values_[first(time_)] = {t0, 0};
  values_[first(time_) + 1] = {h0, 0};
  for (int i = 0; i < orders_; ++i) {
    for (const int node : computed_) computeOrder<fused>(node, i);
    if (i + 1 == orders_) break;
    for (const auto& [state, slope] : states_) {
      const Number& f = value(slope, i);
      values_[first(state) + at(i + 1)] =
          detail::quotient<fused>({f.hi * h0, f.lo * h0}, {static_cast<double>(i + 1), 0});  // h0 a power of two
    }
  }
}

template <bool fused>
GAMUT_INLINE void FineRecursion::computeOrder(int node, int i) {
  const Node& v = nodes_[node];
  if ((v.invariant && i > 0) || isTwin(v.op)) return;
  if (v.op == Op::solution) {
    if (v.b == 0) solve<fused>(node, i);
    return;
  }
  Number* out = &values_[first(node)];
  const Number* a = &values_[first(v.a)];
  const Number* b = v.b >= 0 ? &values_[first(v.b)] : nullptr;
  switch (v.op) {
    case Op::add:
      out[i] = sum(a[i], b[i]);
      return;
    case Op::sub:
      out[i] = sum(a[i], -b[i]);
      return;
    case Op::neg:
      out[i] = -a[i];
      return;
    case Op::mul:
      out[i] = nodes_[v.a].invariant ? product<fused>(a[0], b[i]) : Orders<fused>{*this}.convolution(v.a, v.b, i, 0, i);
      return;
    case Op::sqr:
      out[i] = Orders<fused>{*this}.convolution(v.a, v.a, i, 0, i);
      return;
    default:
      return withFunction(
          v.op, [&](auto f) __attribute__((always_inline)) {
            if constexpr (hasFineForm<decltype(f)>) {
              Orders<fused> orders{*this};
              i == 0 ? orders.begin(f, node, v.a) : f.order(orders, node, v.a, v.b, i);
            }
          });
  }
}

/// A₀ x_i = b_i - Σ_{j≥1} A_j x_{i-j}, refined with residuals in double-double.
template <bool fused>
GAMUT_INLINE void FineRecursion::solve(int node, int i) {
  Solution& solution = solutions_[nodes_[node].a];
  const int n = static_cast<int>(solution.rightSide.size());
  if (i == 0 && solution.factorises) {
    std::vector<double> leading;
    for (const int entry : solution.matrix) leading.push_back(value(entry, 0).hi);
    solution.factors->factorise(leading.data());
  }
  const auto x = [&](int k) { return &values_[first(node + k)]; };
  for (int k = 0; k < n; ++k) {
    Number s = value(solution.rightSide[k], i);
    for (int j = 0; j < n; ++j) {
      const int entry = solution.matrix[k * n + j];
      if (!nodes_[entry].invariant) s = sum(s, -Orders<fused>{*this}.convolution(entry, node + j, i, 1, i));
    }
    rightSide_[k] = s;
    x(k)[i] = {0, 0};
  }
  constexpr int refinements = 3;  // 16 digits, but for the condition, each
  for (int round = 0; round <= refinements; ++round) {
    for (int k = 0; k < n; ++k) {
      Number s = rightSide_[k];
      for (int j = 0; j < n; ++j) addProduct<fused>(s, -value(solution.matrix[k * n + j], 0), x(j)[i]);
      correction_[k] = s.hi;
      solution.residual[i * n + k] = std::fabs(s.hi);
    }
    if (round == refinements) return;
    solution.factors->solve(correction_.data(), unused_.data());
    for (int k = 0; k < n; ++k) x(k)[i] = sum(x(k)[i], {correction_[k], 0});
  }
}

}  // namespace gamut
