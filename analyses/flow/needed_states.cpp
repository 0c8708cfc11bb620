#include "analyses/flow/needed_states.hpp"

#include <utility>

#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

namespace {

/// The states that this node of f depends on, but for those that are needed already, are needed now, and appended.
void need(const Program& f, int node, std::vector<char>& isNeeded, std::vector<int>& appended) {
  std::vector<char> isSeen(f.nodes().size(), 0);
  std::vector<int> open{node};
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    if (std::exchange(isSeen[at(i)], 1) != 0) continue;
    const Node& here = f.nodes()[at(i)];
    if (here.op == Op::state && std::exchange(isNeeded[at(here.a)], 1) == 0) appended.push_back(here.a);
    detail::forEachOperand(f.table(), i, [&](int operand) { open.push_back(operand); });
  }
}

}  // namespace

std::vector<char> neededStates(const Program& f, std::span<const Program> readers) {
  std::vector<char> isNeeded(at(f.states()), 0);
  std::vector<int> open;
  for (const Program& reader : readers)
    for (const int node : reader.outputNodes()) need(reader, node, isNeeded, open);
  while (!open.empty()) {
    const int state = open.back();
    open.pop_back();
    need(f, f.outputNodes()[at(state)], isNeeded, open);
  }
  return isNeeded;
}

Program withOthersAtRest(const Program& f, const std::vector<char>& isNeeded) {
  Recorder recorder(f);
  std::vector<int> rates = f.outputNodes();
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (isNeeded[i] == 0) rates[i] = recorder.constant(0.0);
  return recorder.finish(rates);
}

}  // namespace gamut
