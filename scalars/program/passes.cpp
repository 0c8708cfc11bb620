// A pass writes the program down once more with a Recorder that has one group of rules.
#include "scalars/program/passes.hpp"

#include <tuple>
#include <utility>

namespace gamut {
namespace {

Program rewritten(const Program& program, RuleSet rules) {
  Recorder recorder(program.states(), program.parameters(), rules);
  const std::vector<int> here = recorder.append(program);
  std::vector<int> outputs;
  for (int output : program.outputNodes()) outputs.push_back(here[output]);
  return recorder.program(outputs);
}

constexpr Pass table[] = {
    {"foldConstants", foldConstants, true},
    {"simplify", simplify, true},
    {"moveSigns", moveSigns, false},
    {"movePowersOfTwo", movePowersOfTwo, false},
    {"recogniseSquares", recogniseSquares, true},
    {"pairSinCos", pairSinCos, true},
    {"mergeEqual", mergeEqual, true},
    {"dropUnused", dropUnused, true},
};

/// How many times each node is used, as an output included.
std::vector<int> usesOf(const Program& program) {
  std::vector<int> uses(program.nodes().size(), 0);
  for (int i = 0; i < static_cast<int>(uses.size()); ++i)  // denominators too: derivatives need them
    detail::forEachOperand(program.table(), i, [&](int operand) { ++uses[operand]; });
  for (int output : program.outputNodes()) ++uses[output];
  return uses;
}

bool isSum(Op op) { return op == Op::add || op == Op::sub || op == Op::neg; }

}  // namespace

std::span<const Pass> passes() { return table; }

Program foldConstants(const Program& program) { return rewritten(program, RuleGroup::foldConstants); }
Program simplify(const Program& program) { return rewritten(program, RuleGroup::simplify); }
Program moveSigns(const Program& program) { return rewritten(program, RuleGroup::moveSigns); }
Program movePowersOfTwo(const Program& program) { return rewritten(program, RuleGroup::movePowersOfTwo); }
Program recogniseSquares(const Program& program) { return rewritten(program, RuleGroup::recogniseSquares); }
Program pairSinCos(const Program& program) { return rewritten(program, RuleGroup::pairSinCos); }
Program mergeEqual(const Program& program) { return rewritten(program, RuleGroup::mergeEqual); }
Program dropUnused(const Program& program) { return Recorder(program).finish(program.outputNodes()); }

Program optimised(const Program& program) {
  const auto cost = [](const Program& p) {
    const ProgramCounts counts = countsOf(p);
    return std::tuple(counts.operations, counts.invariant, p.nodes().size());
  };
  // Ends, since the cost falls each time; a fixed point, since a round that was in vain is in vain again.
  for (Program best = dropUnused(program);;) {
    Program next = best;
    for (const Pass& pass : passes()) next = pass.apply(next);
    if (cost(next) >= cost(best)) return best;
    best = std::move(next);
  }
}

ProgramCounts countsOf(const Program& program) {
  ProgramCounts counts;
  counts.operations = program.operations();
  for (std::size_t i = 0; i < program.nodes().size(); ++i) {
    const Node& n = program.nodes()[i];
    if (!isOperation(n.op) || (n.op == Op::solution && n.b > 0)) continue;
    if (program.isInvariant(static_cast<int>(i)))
      ++counts.invariant;
    else
      ++counts.of[static_cast<std::size_t>(n.op)];
  }
  for (const ProductSum& sum : sumsOfProducts(program)) {
    ++counts.sums;
    for (const ProductTerm& term : sum.terms) counts.fusedProducts += term.b >= 0;
  }
  return counts;
}

std::vector<ProductSum> sumsOfProducts(const Program& program) {
  const auto& nodes = program.nodes();
  const std::vector<int> uses = usesOf(program);
  // An inner node belongs to the sum above it: used once, varying as that sum does, and itself a sum or a product.
  const auto isInner = [&](int node) { return uses[node] == 1 && !program.isInvariant(node); };
  std::vector<char> belongs(nodes.size(), 0);
  std::vector<ProductSum> result;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const int root = static_cast<int>(i);
    if (!isSum(nodes[i].op) || belongs[i] || program.isInvariant(root)) continue;
    ProductSum sum{root, {}};
    bool hasProduct = false;
    std::vector<std::pair<int, int>> open{{root, 1}};  // node and sign, the leftmost last
    while (!open.empty()) {
      const auto [node, sign] = open.back();
      open.pop_back();
      const Node& n = nodes[node];
      if (isSum(n.op) && (node == root || isInner(node))) {
        belongs[node] = 1;
        if (operandsOf(n.op) == 2) open.emplace_back(n.b, n.op == Op::sub ? -sign : sign);
        open.emplace_back(n.a, n.op == Op::neg ? -sign : sign);
      } else if ((n.op == Op::mul || n.op == Op::sqr) && isInner(node)) {
        sum.terms.push_back({sign, n.a, n.op == Op::sqr ? n.a : n.b});
        hasProduct = true;
      } else {
        sum.terms.push_back({sign, node, -1});
      }
    }
    if (hasProduct && sum.terms.size() > 1) result.push_back(std::move(sum));
  }
  return {result.rbegin(), result.rend()};
}

}  // namespace gamut
