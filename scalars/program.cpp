// What a Program says of itself.
#include "scalars/program.hpp"

#include <algorithm>
#include <array>

#include "scalars/differentiation.hpp"

namespace gamut {

std::string_view nameOf(Op op) {
  static constexpr std::array<std::string_view, opCount> names{"state", "parameter", "time", "constant", "add",  "sub",
                                                               "neg",   "mul",       "sqr",  "recip",    "sqrt", "exp",
                                                               "log",   "atan",      "sin",  "cos"};
  return names[static_cast<std::size_t>(op)];
}

int Program::operations() const {
  int count = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) count += isOperation(nodes_[i].op) && invariant_[i] == 0;
  return count;
}

Program Program::differentiated(bool withParameters) const { return forwardDifferentiated(*this, withParameters); }

bool isIdentical(const Program& a, const Program& b) {
  return a.states() == b.states() && a.parameters() == b.parameters() && a.nodes() == b.nodes() &&
         a.outputNodes() == b.outputNodes() &&
         std::equal(a.constants().begin(), a.constants().end(), b.constants().begin(), b.constants().end(), isEqual);
}

}  // namespace gamut
