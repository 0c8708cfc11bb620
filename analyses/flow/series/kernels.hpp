// The flow's inner loops: products of polynomial series, one order in time at a time. They run in the widest vector
// unit that the machine has. Sums may be reassociated and fused: the certificate counts terms, not their order.
#pragma once

#include <utility>
#include <vector>

#include "analyses/flow/series/linear_factors.hpp"
#include "analyses/flow/series/monomials.hpp"
#include "scalars/program/program.hpp"

namespace gamut::kernels {

/// Layout of a series: `stride` doubles a monomial, order i at [i]; reversed copies have `reversedStride(stride)`
/// doubles a monomial, order i at [stride - 1 - i], zeros behind.
constexpr int reversedStride(int stride) { return stride + 8; }

/// out[g] += Σ_{(α,β) of g} Σ_{j≤i} a[α][j] b[β][i-j] for g < count. a forward, b reversed.
void convolve(const Monomials::Pair* pairs, const std::int32_t* first, int count, const double* a,
              const double* bReversed, int stride, int i, double* out);

/// out[g] += Σ_{(α,β) of g} c[α·stride] x[β·stride] for g < count: a product of polynomials at one order each. Terms of
/// c that are 0 cost nothing (a parameter has two).
void multiply(const Monomials& monomials, int count, const double* c, const double* x, int stride, double* out);

/// table[q·stride + i] = Σ_{grade g = q} |f[g][i]| power[i]; returns the sum of all entries in `norm` and
/// Σ (i+1) multiplicity(g) |f[g][i]| power[i] in `weighted`. `weights[i] = (i+1) power[i]`. Orders beyond the last have
/// power 0.
void tabulate(const Monomials& monomials, int count, const double* f, const double* power, const double* weights,
              int stride, double* table, double& norm, double& weighted);

/// Rows of a product: to[target][i] += c from[g][i] for i < orders, g < count; target = targets[g], or g where null.
void addRows(const double* from, int stride, int count, double c, int orders, const int* targets, double* to,
             int rowOfTo);

/// sums[i] += Σ_{g < count} |rows[g][i]| for i < orders.
void addRowSizes(const double* rows, int stride, int count, int orders, double* sums);

/// Σ_i a[i] b[i] over `stride` entries.
double dot(const double* a, const double* b, int stride);

/// A node of a recursion without symbols: its series is one row. Operands are node numbers, `value` pairs as above.
struct ThinNode {
  Op op;
  bool invariant;
  bool scaled;  // a product whose factor a is invariant
  int a, b;     // of a solution, its number and the component
  double* forward;
  double* reversed;               // at order 0, orders to the left; null if nobody convolves with it
  double* derivative;             // i times order i; null if not needed
  const double* slope;            // of abs
  bool fine = false;              // its first orders are known
  const double* known = nullptr;  // a state of which all orders are
};

/// Of the fine nodes: values for orders 1 … orders - 1, [node][order], by whoever has them more precisely.
struct ThinLeading {
  int orders = 0;
  std::vector<int> nodes;
  std::vector<double> values;
};

/// A solution's matrix (nodes, row by row; -1 where it does not change in time) and right-hand side; its components'
/// nodes are numbered one after another.
struct ThinSolution {
  const LinearFactors* factors = nullptr;
  double* residual = nullptr;  // see LinearFactors::solve, [order][component]
  std::vector<int> matrix, rightSide;
};

/// ẋ_s = Σ_k left_k · right_k: one row of the variational equation.
struct ThinSum {
  int target;
  std::vector<std::pair<int, int>> terms;
};

/// A recursion without symbols: `states` pairs a state with the node of its derivative; `current` has one number a
/// node, its order 0 at first.
struct ThinProgram {
  std::vector<ThinNode> nodes;
  std::vector<const ThinSolution*> solutions;
  std::vector<std::pair<int, int>> states;
  std::vector<ThinSum> frame;
  ThinLeading leading;
  std::vector<double> current, known;  ///< known: orders of states that are given, [state][order]
};

/// Orders 1 … m-1 of all nodes and m of the states when order 0 is known. Newest coefficients are kept aside and stored
/// together behind an order: a vector load right behind a scalar store would stall.
void thinRecursion(ThinProgram& program, int time, int order, double h0);

}  // namespace gamut::kernels
