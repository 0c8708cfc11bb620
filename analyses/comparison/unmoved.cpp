// An output depends on a quantity only if its program, or those of the rates of states that it depends on, hold it:
// along the nodes, and through a linear system only within the block of its matrix.
#include "analyses/comparison/unmoved.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "analyses/samples/arbiter.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {
namespace {

using detail::at;

/// The blocks of a matrix that no entry connects: of each row, its number. Entries that are 0 connect nothing.
std::vector<int> blocksOf(const Program& program, const LinearMatrix& matrix) {
  std::vector<int> block(matrix.size);
  for (int i = 0; i < matrix.size; ++i) block[i] = i;
  const auto isZero = [&](int node) {
    const Node& n = program.nodes()[node];
    return n.op == Op::constant && magnitude(program.constants()[n.a]) == 0;
  };
  for (int i = 0; i < matrix.size; ++i)
    for (int j = 0; j < matrix.size; ++j)
      if (const int from = block[i], to = block[j]; from != to && !isZero(matrix.entry(i, j)))
        std::ranges::replace(block, from, to);
  return block;
}

/// Of the components of a solution, which depend on what is moved: x in A x = r is made, block by block, of the
/// entries of A and r in that block.
std::vector<char> movedComponents(const Program& program, const LinearSolution& solution,
                                  const std::vector<char>& moved) {
  const LinearMatrix& matrix = program.matrices()[solution.matrix];
  const std::vector<int> block = blocksOf(program, matrix);
  std::vector<char> isMoved(block.size(), 0);  // by the number of the block
  for (int i = 0; i < matrix.size; ++i) {
    isMoved[block[i]] |= moved[solution.rightSide[i]];
    for (int j = 0; j < matrix.size; ++j) isMoved[block[i]] |= moved[matrix.entry(i, j)];
  }
  std::vector<char> components;
  for (const int of : block) components.push_back(isMoved[of]);
  return components;
}

/// Which outputs of a program depend on these of its states and parameters.
std::vector<char> movedBy(const Program& program, const std::vector<char>& states,
                          const std::vector<char>& parameters) {
  std::vector<char> moved(program.nodes().size(), 0), components;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Node& n = program.nodes()[i];
    if (n.op == Op::state) moved[i] = states[n.a];
    if (n.op == Op::parameter) moved[i] = parameters[n.a];
    if (n.op == Op::solution) {
      if (n.b == 0) components = movedComponents(program, program.solutions()[n.a], moved);
      moved[i] = components[n.b];
    } else {
      detail::forEachOperand(program.table(), static_cast<int>(i), [&](int node) { moved[i] |= moved[node]; });
    }
  }
  std::vector<char> outputs;
  for (const int node : program.outputNodes()) outputs.push_back(moved[node]);
  return outputs;
}

}  // namespace

std::vector<char> movedOutputs(const UncertainMotion& system) {
  const Motion& motion = system.motion;
  const std::size_t n = at(motion.f.states());
  std::vector<char> states(n, 0), parameters(at(motion.f.parameters()), 0);
  for (const int slot : system.slot) (at(slot) < n ? states[slot] : parameters[at(slot) - n]) = 1;
  for (bool isMore = true; isMore;) {  // until no rate depends on more
    // Both forms are of the same equations: what one of them shows not to depend does not.
    const std::vector<char> rates = movedBy(motion.f, states, parameters);
    const std::vector<char> again = movedBy(motion.forSamples(), states, parameters);
    isMore = false;
    for (std::size_t i = 0; i < n; ++i)
      if (states[i] == 0 && rates[i] != 0 && again[i] != 0) states[i] = 1, isMore = true;
  }
  return movedBy(motion.g, states, parameters);
}

KnownOutputs settleUnmoved(const UncertainMotion& system, const std::vector<char>& moved, std::size_t times,
                           const std::atomic<bool>* cancelled) {
  Motion part = system.motion;
  part.times.resize(times);
  std::vector<std::size_t> outputs;
  std::vector<int> nodes;
  std::vector<std::string> names;
  for (std::size_t o = 0; o < moved.size(); ++o) {
    if (moved[o] != 0) continue;
    outputs.push_back(o);
    nodes.push_back(part.g.outputNodes()[o]);
    if (o < part.outputNames.size()) names.push_back(part.outputNames[o]);
  }
  part.g = Recorder(part.g).finish(nodes);
  part.outputNames = std::move(names);
  const PreciseTrajectory precise = arbitrate(part, system.nominal, {}, cancelled);
  if (cancelled != nullptr && *cancelled) return {};
  KnownOutputs known;
  known.outputs = moved.size();
  known.values.assign(times * moved.size(), std::numeric_limits<double>::quiet_NaN());
  known.error = known.rounding = known.values;
  const std::vector<double> values = roundedToDoubles(precise, precise.times * outputs.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t cell = i / outputs.size() * moved.size() + outputs[i % outputs.size()];
    known.values[cell] = values[i];
    known.error[cell] = precise.error[i];
    known.rounding[cell] = precise.rounding[i];
  }
  return known;
}

}  // namespace gamut
