#include "analyses/flow/needed_states.hpp"

#include <algorithm>
#include <utility>

#include "scalars/operations/op.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

namespace {

/// States that this node of f depends on are needed; those that were not yet are appended. `isSeen`: nodes that were
/// looked at before.
void need(const Program& f, int node, std::vector<char>& isSeen, std::vector<char>& isNeeded,
          std::vector<int>& appended) {
  std::vector<int> open{node};
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    if (std::exchange(isSeen[i], 1) != 0) continue;
    const Node& here = f.nodes()[i];
    if (here.op == Op::state && std::exchange(isNeeded[here.a], 1) == 0) appended.push_back(here.a);
    detail::forEachOperand(f.table(), i, [&](int operand) { open.push_back(operand); });
  }
}

std::vector<char> noneSeen(const Program& program) { return std::vector<char>(program.nodes().size(), 0); }

/// Whether these nodes, but for those that were seen, depend on an operation that some numbers have no value by.
bool dependOnPartial(const Program& program, std::vector<int> open, std::vector<char> isSeen, bool rootsAlone) {
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    if (std::exchange(isSeen[i], 1) != 0) continue;
    const Op op = program.nodes()[i].op;
    if (isFunction(op) && isOneSided(domainOf(op))) return true;
    if (!rootsAlone && (op == Op::solution || (isFunction(op) && domainOf(op) != Domain::everywhere))) return true;
    detail::forEachOperand(program.table(), i, [&](int operand) { open.push_back(operand); });
  }
  return false;
}

}  // namespace

std::vector<char> neededStates(const Program& f, std::span<const Program> readers, bool rootsAlone) {
  std::vector<char> isNeeded(f.states(), 0), isSeen = noneSeen(f);
  std::vector<int> open;
  for (const Program& reader : readers) {
    std::vector<char> isSeenThere = noneSeen(reader);
    for (const int node : reader.outputNodes()) need(reader, node, isSeenThere, isNeeded, open);
  }
  const auto needAll = [&] {
    while (!open.empty()) {
      const int state = open.back();
      open.pop_back();
      need(f, f.outputNodes()[state], isSeen, isNeeded, open);
    }
  };
  needAll();
  for (int state = 0; state < f.states(); ++state) {
    if (isNeeded[state] != 0 || !dependOnPartial(f, {f.outputNodes()[state]}, isSeen, rootsAlone)) continue;
    isNeeded[state] = 1;
    open.push_back(state);
    needAll();
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
