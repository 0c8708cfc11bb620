// Found again in what Recorded and the rules of the recorder leave of the formula.
#include "scalars/program/extremes.hpp"

#include <optional>

namespace gamut {

namespace {

/// a and b of which `sum` is the sum and `difference` the difference, either way round.
std::optional<Extreme> partsOf(const Program& program, int sum, int difference) {
  if (sum == difference) return Extreme{.a = sum, .b = sum, .byA = 1, .byB = 0};  // b is zero
  const Node &s = program.nodes()[sum], &d = program.nodes()[difference];
  const bool isSame = (s.a == d.a && s.b == d.b) || (s.a == d.b && s.b == d.a);
  if (s.op == Op::add && d.op == Op::sub && isSame) return Extreme{.a = s.a, .b = s.b};
  if (s.op == Op::sub && d.op == Op::add && isSame) return Extreme{.a = s.a, .b = s.b, .byA = 1, .byB = -1};
  return std::nullopt;
}

}  // namespace

std::vector<Extreme> extremesOf(const Program& program) {
  std::vector<Extreme> found;
  for (std::size_t i = 0; i < program.nodes().size(); ++i) {
    const Node& twice = program.nodes()[i];
    const auto isAbs = [&](int operand) { return program.nodes()[operand].op == Op::abs; };
    std::optional<Extreme> extreme;
    const auto consider = [&](int sum, int absolute, bool isMax) {
      if (extreme || !isAbs(absolute)) return;
      extreme = partsOf(program, sum, program.nodes()[absolute].a);
      if (extreme) extreme->isMax = isMax;
    };
    if (twice.op == Op::add) {
      consider(twice.a, twice.b, true);
      consider(twice.b, twice.a, true);
    }
    if (twice.op == Op::sub) consider(twice.a, twice.b, false);
    if (!extreme) continue;
    extreme->node = static_cast<int>(i);
    found.push_back(*extreme);
  }
  return found;
}

}  // namespace gamut
