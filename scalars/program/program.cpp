// What a Program says of itself.
#include "scalars/program/program.hpp"

#include <algorithm>
#include <array>

#include "scalars/operations/all.hpp"
#include "scalars/program/differentiation.hpp"

namespace gamut {

std::string_view nameOf(Op op) {
#define GAMUT_NAME(name) #name,
  static constexpr std::array<std::string_view, opCount> names{
      "state", "parameter", "time", "constant", "add",
      "sub",   "neg",       "mul",  "sqr",      GAMUT_FUNCTIONS(GAMUT_NAME) "solution"};
#undef GAMUT_NAME
  return names[static_cast<std::size_t>(op)];
}

Domain domainOf(Op op) {
  return isFunction(op) ? withFunction(op, [](auto f) { return f.domain; }) : Domain::everywhere;
}

bool isSmooth(Op op) {
  return !isFunction(op) || withFunction(op, [](auto f) { return f.isSmooth; });
}

namespace detail {

/// Elimination of what may be no zero. Of LDLᵀ: column k of L has the rows that are there below k, and fills in where
/// two of them meet. Of LU any row that has an entry in column k may be the pivot: all of them become what they have
/// together (the row merge of A. George and E. Ng, 1987), and one of them goes.
SolvingOperations solvingOperations(const NodeTable& table, const LinearMatrix& matrix) {
  const int n = matrix.size;
  std::vector<char> isThere;
  for (int entry : matrix.entries) {
    const Node& node = table.nodes[entry];
    const bool isZero = node.op == Op::constant && isEqual(table.constants[node.a], 0.0);
    isThere.push_back(!isZero);
  }
  const auto there = [&](int i, int j) -> char& { return isThere[i * n + j]; };
  const bool isGeneral = matrix.kind == MatrixKind::general;
  const int entries = static_cast<int>(std::count(isThere.begin(), isThere.end(), 1));
  std::vector<char> isOpen(n, 1);  // rows that have not been pivots
  SolvingOperations count;
  for (int k = 0; k < n; ++k) {
    std::vector<int> rows, columns;  // of the entries below the pivot, and right of it
    for (int i = isGeneral ? 0 : k + 1; i < n; ++i)
      if (isOpen[i] != 0 && there(i, k) != 0) rows.push_back(i);
    const auto isInRow = [&](int j) {
      return std::any_of(rows.begin(), rows.end(), [&](int i) { return there(i, j) != 0; });
    };
    for (int j = k + 1; j < n && isGeneral; ++j)
      if (isInRow(j)) columns.push_back(j);
    if (!isGeneral) columns = rows;
    for (int i : rows)
      for (int j : columns) there(i, j) = 1;
    if (isGeneral && !rows.empty()) isOpen[rows.back()] = 0, rows.pop_back();
    const int below = static_cast<int>(rows.size()), right = static_cast<int>(columns.size());
    // The inverse of the pivot, its column times that, then the rest updated: a triangle of it if it is symmetric.
    count.factorisation += 1 + below + (isGeneral ? 2 * below * right : below * (below + 1));
    count.solution += 2 * below + 2 * right + 1;  // a multiplication and a subtraction an entry, and the diagonal
  }
  if (isGeneral) count.solution = 2 * count.solution + 2 * entries + n;  // residual and correction
  return count;
}

}  // namespace detail

bool Program::isInvariantMatrix(int m) const {
  return std::ranges::all_of(matrices()[m].entries, [this](int entry) { return isInvariant(entry); });
}

int Program::operations() const {
  int count = 0;
  std::vector<char> isFactorised(matrices().size(), 0);
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    const Node& n = nodes()[i];
    if (n.op != Op::solution) {
      count += isOperation(n.op) && invariant_[i] == 0;
    } else if (n.b == 0 && invariant_[i] == 0) {
      const int m = solutions()[n.a].matrix;
      const detail::SolvingOperations solving = detail::solvingOperations(table(), matrices()[m]);
      if (!isInvariantMatrix(m) && isFactorised[m] == 0) count += solving.factorisation;
      isFactorised[m] = 1;
      count += solving.solution;
    }
  }
  return count;
}

Program Program::differentiated(bool withParameters) const { return forwardDifferentiated(*this, withParameters); }

bool isIdentical(const Program& a, const Program& b) {
  return a.states() == b.states() && a.parameters() == b.parameters() && a.nodes() == b.nodes() &&
         a.matrices() == b.matrices() && a.solutions() == b.solutions() && a.outputNodes() == b.outputNodes() &&
         std::equal(a.constants().begin(), a.constants().end(), b.constants().begin(), b.constants().end(), isEqual);
}

}  // namespace gamut
