// Vectorised sums over orders and monomials, one clone a vector unit.
#include "analyses/flow/series/kernels.hpp"

#include <algorithm>

#include "analyses/flow/series/operations/all.hpp"
#include "analyses/flow/series/thin.hpp"
#include "analyses/flow/series/vector_clones.hpp"
#include "analyses/flow/series/vectors.hpp"
#include "analyses/work.hpp"

namespace gamut::kernels {
namespace {

typedef double Half __attribute__((vector_size(32), aligned(8), may_alias));

GAMUT_INLINE const Half& loadHalf(const double* p) { return *reinterpret_cast<const Half*>(p); }

template <int chunks>
GAMUT_INLINE void convolveChunks(const Monomials::Pair* pairs, const std::int32_t* first, int count, const double* a,
                                 const double* b, int stride, double* out) {
  const int strideR = reversedStride(stride);
  for (int g = 0; g < count; ++g) {
    Vector even = {}, odd = {};
    int q = first[g];
    const int end = first[g + 1];
    for (; q + 1 < end; q += 2) {
      const double* x0 = a + pairs[q].a * stride;
      const double* y0 = b + pairs[q].b * strideR;
      const double* x1 = a + pairs[q + 1].a * stride;
      const double* y1 = b + pairs[q + 1].b * strideR;
      for (int c = 0; c < chunks; ++c) {
        even += load(x0 + 8 * c) * load(y0 + 8 * c);
        odd += load(x1 + 8 * c) * load(y1 + 8 * c);
      }
    }
    if (q < end) {
      const double* x = a + pairs[q].a * stride;
      const double* y = b + pairs[q].b * strideR;
      for (int c = 0; c < chunks; ++c) even += load(x + 8 * c) * load(y + 8 * c);
    }
    even += odd;
    out[g] += sum(even);
  }
}

/// The first four orders alone. (No template: one forgets that its vectors need not be aligned.)
GAMUT_INLINE void convolveHalf(const Monomials::Pair* pairs, const std::int32_t* first, int count, const double* a,
                               const double* b, int stride, double* out) {
  const int strideR = reversedStride(stride);
  for (int g = 0; g < count; ++g) {
    Half even = {}, odd = {};
    int q = first[g];
    const int end = first[g + 1];
    for (; q + 1 < end; q += 2) {
      even += loadHalf(a + pairs[q].a * stride) * loadHalf(b + pairs[q].b * strideR);
      odd += loadHalf(a + pairs[q + 1].a * stride) * loadHalf(b + pairs[q + 1].b * strideR);
    }
    if (q < end) even += loadHalf(a + pairs[q].a * stride) * loadHalf(b + pairs[q].b * strideR);
    even += odd;
    out[g] += (even[0] + even[2]) + (even[1] + even[3]);
  }
}

}  // namespace

GAMUT_CLONES void convolve(const Monomials::Pair* pairs, const std::int32_t* first, int count, const double* a,
                           const double* bReversed, int stride, int i, double* out) {
  const double* b = bReversed + stride - 1 - i;
  const int eights = i / 8 + 1;
  Work::count(Work::convolvedRow, static_cast<double>(first[count]) * eights);
  if (i < 4) return convolveHalf(pairs, first, count, a, b, stride, out);
  switch (i / 8) {
    case 0:
      convolveChunks<1>(pairs, first, count, a, b, stride, out);
      break;
    case 1:
      convolveChunks<2>(pairs, first, count, a, b, stride, out);
      break;
    case 2:
      convolveChunks<3>(pairs, first, count, a, b, stride, out);
      break;
    default:
      convolveChunks<4>(pairs, first, count, a, b, stride, out);
      break;
  }
}

void multiply(const Monomials& monomials, int count, const double* c, const double* x, int stride, double* out) {
  double pairs = 0;
  for (int a = 0; a < count; ++a) {
    const double factor = c[a * stride];
    if (factor == 0) continue;
    const std::uint16_t* product = monomials.products(a);
    const int others = monomials.productCount(a);
    pairs += others;
    for (int b = 0; b < others && product[b] < count; ++b) out[product[b]] += factor * x[b * stride];
  }
  Work::count(Work::multipliedPair, pairs + count);
}

GAMUT_CLONES void tabulate(const Monomials& monomials, int count, const double* f, const double* power,
                           const double* weights, int stride, double* table, double& norm, double& weighted) {
  const int chunks = stride / 8;
  std::fill(table, table + (monomials.grade(count - 1) + 1) * stride, 0.0);
  Vector n = {}, w = {};
  for (int g = 0; g < count; ++g) {
    double* row = table + monomials.grade(g) * stride;
    const double multiplicity = monomials.multiplicity(g);
    Vector wg = {};
    for (int c = 0; c < chunks; ++c) {
      Vector v = load(f + g * stride + 8 * c);
      v = v < 0 ? -v : v;
      const Vector scaled = v * load(power + 8 * c);
      *reinterpret_cast<Vector*>(row + 8 * c) += scaled;
      n += scaled;
      wg += v * load(weights + 8 * c);
    }
    w += multiplicity * wg;
  }
  norm = sum(n);
  weighted = sum(w);
}

GAMUT_CLONES void addRows(const double* from, int stride, int count, double c, int orders, const int* targets,
                          double* to, int rowOfTo) {
  for (int g = 0; g < count; ++g, from += stride) {
    double* out = to + (targets == nullptr ? g : targets[g]) * rowOfTo;
    int i = 0;
    for (; i + 8 <= orders; i += 8) *reinterpret_cast<Vector*>(out + i) += c * load(from + i);
    for (; i < orders; ++i) out[i] += c * from[i];
  }
}

GAMUT_CLONES void addRowSizes(const double* rows, int stride, int count, int orders, double* sums) {
  for (int g = 0; g < count; ++g, rows += stride) {
    int i = 0;
    for (; i + 8 <= orders; i += 8) addSize(sums + i, load(rows + i));
    for (; i < orders; ++i) sums[i] += std::fabs(rows[i]);
  }
}

GAMUT_CLONES double dot(const double* a, const double* b, int stride) {
  if (stride == 1) return a[0] * b[0];
  Vector s = {};
  for (int c = 0; c < stride; c += 8) s += load(a + c) * load(b + c);
  return sum(s);
}

/// Order i of the components from node x on: A₀ x_i = b_i - Σ_{j≥1} A_j x_{i-j}.
GAMUT_INLINE void thinSolution(const ThinNode* v, int x, const ThinSolution& solution, int i, double* cur) {
  const int n = static_cast<int>(solution.rightSide.size());
  const int* entry = solution.matrix.data();
  for (int k = 0; k < n; ++k) {
    double s = cur[solution.rightSide[k]];
    for (int j = 0; j < n; ++j, ++entry)
      if (*entry >= 0) s -= thinDot(v[*entry].forward, v[x + j].reversed, i) + cur[*entry] * v[x + j].forward[0];
    cur[x + k] = s;
  }
  double* residual = solution.residual + i * n;
  std::fill_n(residual, n, 0.0);
  solution.factors->solve(cur + x, residual);
}

/// Order i > 0 of node x.
GAMUT_INLINE void thinOrder(const ThinNode* v, int x, const std::vector<const ThinSolution*>& solutions, int i,
                            double* cur) {
  const ThinNode& n = v[x];
  const ThinNode& a = v[n.a];
  switch (n.op) {
    case Op::add:
      cur[x] = cur[n.a] + cur[n.b];
      break;
    case Op::sub:
      cur[x] = cur[n.a] - cur[n.b];
      break;
    case Op::neg:
      cur[x] = -cur[n.a];
      break;
    case Op::mul:
      cur[x] = n.scaled
                   ? a.forward[0] * cur[n.b]
                   : thinDot(a.forward, v[n.b].reversed, i) + a.forward[0] * cur[n.b] + cur[n.a] * v[n.b].forward[0];
      break;
    case Op::sqr:
      cur[x] = thinDot(a.forward, a.reversed, i) + 2 * (a.forward[0] * cur[n.a]);
      break;
    case Op::solution:
      if (n.b == 0) thinSolution(v, x, *solutions[n.a], i, cur);
      break;
#define GAMUT_CASE(name)                                                              \
  case Op::name:                                                                      \
    if constexpr (!isTwin(Op::name)) FlowFunction<Op::name>::thinOrder(v, x, i, cur); \
    break;
      GAMUT_FUNCTIONS(GAMUT_CASE)
#undef GAMUT_CASE
    default:
      break;
  }
}

/// Order i of all nodes from where it was computed, and a zero behind it.
GAMUT_INLINE void storeThin(const ThinNode* v, int count, int i, const double* cur) {
  for (int x = 0; x < count; ++x) {
    const ThinNode& n = v[x];
    if (n.invariant) continue;
    n.forward[i] = cur[x];
    n.forward[i + 1] = 0;
    if (n.reversed != nullptr) {
      n.reversed[-i] = cur[x];
      n.reversed[-i - 1] = 0;
    }
    if (n.derivative != nullptr) {
      n.derivative[i] = i * cur[x];
      n.derivative[i + 1] = 0;
    }
  }
}

GAMUT_CLONES void thinRecursion(ThinProgram& program, int time, int order, double h0) {
  const auto& [nodes, solutions, states, frame, leading, current, known] = program;
  const int count = static_cast<int>(nodes.size());
  const ThinNode* v = nodes.data();
  double* cur = program.current.data();
  const int blocks = order / 16 + 1;
  Work::count(Work::coefficient, 2.0 * count * order * blocks);
  for (int i = 0; i < order; ++i) {
    if (i == 1)  // what does not change in time has order 0 only
      for (int x = 0; x < count; ++x)
        if (v[x].invariant) cur[x] = 0;
    for (int x = 0; x < time; ++x)
      if (v[x].known != nullptr) cur[x] = v[x].known[i];
    if (i > 0) {
      cur[time] = i == 1 ? h0 : 0.0;
      const bool isLeading = i < leading.orders;
      if (isLeading)
        for (const int x : leading.nodes) cur[x] = leading.values[x * leading.orders + i];
      for (int x = time + 1; x < count; ++x) {
        const ThinNode& n = v[x];
        if (n.invariant || n.op == Op::state || isTwin(n.op) || (isLeading && n.fine)) continue;
        thinOrder(v, x, solutions, i, cur);
      }
    }
    storeThin(v, count, i, cur);
    // The next order of the frame first: it reads this order's values of the states' derivatives' nodes only.
    for (const ThinSum& row : frame) {
      double s = 0;
      for (const auto& [left, right] : row.terms)
        s += v[left].invariant ? v[left].forward[0] * v[right].forward[i]
                               : thinDot(v[left].forward, v[right].reversed, i);
      cur[row.target] = s * h0 / (i + 1);
    }
    for (const auto& [state, slope] : states) cur[state] = v[slope].forward[i] * h0 / (i + 1);
  }
  for (const auto& [state, slope] : states) v[state].forward[order] = cur[state];
  for (const ThinSum& row : frame) v[row.target].forward[order] = cur[row.target];
}

}  // namespace gamut::kernels
