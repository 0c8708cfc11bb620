// What is settled of a program's series before any of it is computed: how far each node is kept, and where its numbers
// lie.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "analyses/flow/series/monomials.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// A node, or an entry of the frame. It keeps the first `count` monomials, those up to `degree`.
struct SeriesNode {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  Op op;
  int a, b;  ///< of products the factor that does not change in time first
  int degree, count;
  bool primary, invariant, constant;
  bool isZero = false;  ///< known to be
  // Where it begins: its coefficients [monomial][order]; those of a right factor, reversed or padded; j times order j;
  // sizes [grade][order]; tails of these; of a right factor, the coefficients of 1; the inverse of its leading
  // polynomial.
  std::size_t f = 0, r = none, d = none, t = 0, s2 = none, beyond = none, z = none, inverse = none;
  bool needsTails = false;
};

struct SeriesPlan {
  /// As for PolynomialSeries. Throws std::invalid_argument unless the order is 1 to 31.
  SeriesPlan(const Program& program, int primaryOutputs, std::shared_ptr<const Monomials> monomials, int frameDegree,
             int order, bool withFrame);

  const SeriesNode& operator[](int node) const { return nodes[node]; }
  int size() const { return static_cast<int>(nodes.size()); }
  int frameNode(int i, int j) const { return ofProgram + i * states + j; }
  int jacobian(int i, int j) const { return outputs[states + i * states + j]; }  ///< ∂f_i/∂x_j
  /// Of an order in time, no higher grades than these are computed; states have those of an order before, of x' = v of
  /// one before that.
  int gradeOf(int order) const { return grades[order]; }
  int countOf(const SeriesNode& v, int order) const { return std::min(v.count, counts[order]); }

  std::shared_ptr<const Monomials> monomials;
  int states, time;  ///< the node of time is behind states and parameters
  int stride;        ///< numbers of a monomial: orders, and what vectors of eight need
  int ofProgram;     ///< so many nodes; the frame's entries behind them
  int frameDegree, frameCount;
  bool withFrame;
  bool isCut = false;    ///< not all orders have the same grades
  bool isByGrades;       ///< the recursion goes by grades, not by orders
  bool isConvex = true;  ///< bounds are, in those of states and inputs
  bool hasKinks;
  std::vector<SeriesNode> nodes;
  std::vector<int> outputs;
  std::vector<double> constants, radii;  ///< of constants
  struct Sizes {
    std::size_t f = 0, r = 0, d = 0, t = 0, s2 = 0, beyond = 0, z = 0, inverse = 0;
  } sizes;  ///< of the arrays in which nodes have places

 private:
  std::vector<int> grades, counts;  // of orders
  std::vector<char> primaryOf(const Program& program, int primaryOutputs) const;
  void planOrders(int order);
  void planNodes(const Program& program, const std::vector<char>& primary);
  void planFactors();
};

}  // namespace gamut
