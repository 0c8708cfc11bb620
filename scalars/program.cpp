// What a Program says of itself.
#include "scalars/program.hpp"

#include <algorithm>
#include <array>

#include "scalars/differentiation.hpp"

namespace gamut {

std::string_view nameOf(Op op) {
  static constexpr std::array<std::string_view, opCount> names{
      "state", "parameter", "time", "constant", "add", "sub", "neg",  "mul",   "sqr",     "recip",
      "sqrt",  "exp",       "log",  "atan",     "sin", "cos", "tanh", "sech2", "solution"};
  return names[static_cast<std::size_t>(op)];
}

int factorisationOperations(MatrixKind kind, int size) {
  int count = 0;
  // The inverse of a pivot, its column times that, then the rest updated: a triangle of it if it is symmetric.
  for (int rest = size - 1; rest >= 0; --rest)
    count += 1 + rest + (kind == MatrixKind::positiveDefinite ? rest * (rest + 1) : 2 * rest * rest);
  return count;
}

int solutionOperations(MatrixKind kind, int size) {
  const int once =
      size * (2 * size - 1);  // two triangles, a multiplication and a subtraction an entry, and the diagonal
  return kind == MatrixKind::positiveDefinite ? once : 2 * once + 2 * size * size + size;  // residual and correction
}

int Program::operations() const {
  int count = 0;
  std::vector<char> isFactorised(matrices().size(), 0);
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    const Node& n = nodes()[i];
    if (n.op != Op::solution) {
      count += isOperation(n.op) && invariant_[i] == 0;
    } else if (n.b == 0 && invariant_[i] == 0) {
      const auto m = detail::at(solutions()[detail::at(n.a)].matrix);
      const LinearMatrix& matrix = matrices()[m];
      const bool varies =
          std::any_of(matrix.entries.begin(), matrix.entries.end(), [&](int entry) { return !isInvariant(entry); });
      if (varies && isFactorised[m] == 0) count += factorisationOperations(matrix.kind, matrix.size);
      isFactorised[m] = 1;
      count += solutionOperations(matrix.kind, matrix.size);
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
