// Arguments as states: their rates, and where they start.
#include "analyses/flow/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analyses/flow/error_bounds.hpp"
#include "analyses/flow/outputs.hpp"
#include "scalars/index.hpp"
#include "scalars/program/linear_form.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

namespace {

bool bends(Op op) { return op == Op::sign || op == Op::abs; }

/// Of each node, whether it depends on a state, and whether on a sign or an absolute value.
struct Dependence {
  std::vector<char> moves, bends;
};

Dependence dependenceOf(const Program& f) {
  Dependence result;
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const Op op = f.nodes()[i].op;
    bool moves = op == Op::state, isBent = bends(op);
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) {
      moves = moves || result.moves[at(operand)] != 0;
      isBent = isBent || result.bends[at(operand)] != 0;
    });
    result.moves.push_back(static_cast<char>(moves));
    result.bends.push_back(static_cast<char>(isBent));
  }
  return result;
}

/// Nodes of `all` that are such arguments of signs and absolute values among `nodes`.
std::vector<int> argumentsAmong(const Program& all, const std::vector<int>& nodes) {
  const Dependence on = dependenceOf(all);
  std::vector<int> arguments;
  for (const int node : nodes) {
    if (!bends(all.nodes()[at(node)].op)) continue;
    const int u = all.nodes()[at(node)].a;
    if (on.moves[at(u)] != 0 && on.bends[at(u)] == 0 && std::ranges::find(arguments, u) == arguments.end() &&
        !linearFormOf(all, u))
      arguments.push_back(u);
  }
  return arguments;
}

/// u and its derivatives by states and by time, row by row: a program of one state more, which is time.
Program derivativesOf(const Program& u) {
  Recorder recorder(u.states() + 1, u.parameters());
  std::vector<int> instead(u.nodes().size(), -1), outputs;
  for (std::size_t i = 0; i < instead.size(); ++i)
    if (u.nodes()[i].op == Op::time) instead[i] = recorder.state(u.states());
  const std::vector<int> here = recorder.append(u, {}, instead);
  for (const int output : u.outputNodes()) outputs.push_back(here[at(output)]);
  return recorder.finish(outputs).differentiated();
}

}  // namespace

std::optional<FlowFormulation> withSurfaces(const FlowFormulation& of) {
  constexpr std::size_t most = 4;  // each costs as much as a state does
  const int n = of.motion.states(), k = of.motion.parameters();
  Recorder joint(n, k);
  std::vector<std::vector<int>> results;
  std::vector<int> ofMotion;
  for (const Program* written : {&of.motion, &of.outputs, &of.asides}) {
    const Program program = withBareSigns(withBareKinks(*written));
    const std::vector<int> here = joint.append(program);
    if (ofMotion.empty()) ofMotion = here;
    results.emplace_back();
    for (const int output : program.outputNodes()) results.back().push_back(here[at(output)]);
  }
  std::vector<int> outputs;
  for (const std::vector<int>& nodes : results) outputs.insert(outputs.end(), nodes.begin(), nodes.end());
  const Program all = joint.program(outputs);
  const std::vector<int> arguments = argumentsAmong(all, ofMotion);
  const auto count = static_cast<int>(arguments.size());
  if (count == 0 || arguments.size() > std::max(most, at(n))) return std::nullopt;

  Recorder recorder(n + count, k);
  std::vector<int> instead(all.nodes().size(), -1);
  for (int j = 0; j < count; ++j) instead[at(arguments[at(j)])] = recorder.state(n + j);
  const std::vector<int> here = recorder.append(all, {}, instead);
  const Program u = Recorder(all).finish(arguments), derivatives = derivativesOf(u);
  std::vector<int> insteadOfTime(derivatives.nodes().size(), -1);
  for (std::size_t i = 0; i < insteadOfTime.size(); ++i)
    if (derivatives.nodes()[i].op == Op::state && derivatives.nodes()[i].a == n) insteadOfTime[i] = recorder.time();
  const std::vector<int> slopes = recorder.append(derivatives, {}, insteadOfTime);
  // Outputs that neither jump nor bend are what they are: samples know no u that is zero exactly, as a held one is.
  const std::vector<int> plain = recorder.append(all);
  const std::vector<char> isBent = dependenceOf(all).bends;
  const auto programOf = [&](const std::vector<int>& nodes, const std::vector<int>& more) {
    std::vector<int> selected;
    for (const int node : nodes)
      selected.push_back(isBent[at(node)] != 0 || !more.empty() ? here[at(node)] : plain[at(node)]);
    selected.insert(selected.end(), more.begin(), more.end());
    return recorder.finish(selected);
  };
  std::vector<int> rates;
  for (int j = 0; j < count; ++j) {
    const auto slope = [&](int by) { return slopes[at(derivatives.outputNodes()[at(count + j * (n + 1) + by)])]; };
    int rate = slope(n);
    for (int i = 0; i < n; ++i) rate = recorder.add(rate, recorder.mul(slope(i), here[at(results[0][at(i)])]));
    rates.push_back(rate);
  }
  FlowFormulation result(programOf(results[0], rates), programOf(results[1], {}), of.inputs, programOf(results[2], {}));
  result.states = of.states;
  result.hasClock = of.hasClock;
  Recorder ofAll(n + count, k);
  const std::vector<int> start = ofAll.append(u);
  std::vector<int> starts;
  for (const int output : u.outputNodes()) starts.push_back(start[at(output)]);
  result.starts = ofAll.finish(starts);
  result.jumps = std::ranges::any_of(ofMotion, [&](int node) {
    const Node& jump = all.nodes()[at(node)];
    return jump.op == Op::sign && std::ranges::find(arguments, jump.a) != arguments.end();
  });
  return result;
}

bool placeSurfaces(FlowSet& set, const Program& starts, const std::shared_ptr<const Monomials>& monomials) {
  const std::size_t n = set.R.size(), N = at(monomials->count()), first = n - at(starts.outputs());
  FlowOutputs outputs(starts, monomials, monomials, {});
  FlowPoint point;
  point.p = set.p;
  std::fill(point.p.begin() + static_cast<std::ptrdiff_t>(first * N), point.p.end(), 0.0);
  point.low.assign(n, 0.0);
  point.psi.assign(n * n, 0.0);
  point.psiSum = point.psi;
  point.total = point.ofR = point.beyond = point.known = point.low;
  for (std::size_t i = 0; i < n; ++i) {
    double loose = i < first ? set.W[i] : 0;  // until the first step C is 1, and no generators are there
    if (i < first) loose = (loose + std::fabs(set.C[i * n + i]) * set.R[i]) * bounds::up;
    if (i < first && !set.low.empty()) loose = (loose + std::fabs(set.low[i])) * bounds::up;
    point.loose.push_back(loose);
  }
  point.radius = point.loose;
  outputs.evaluate(0.0, point, std::vector<double>(n, 0.0), set.parameters);
  for (int j = 0; j < starts.outputs(); ++j)
    if (!std::isfinite(outputs.radius(j))) return false;
  for (int j = 0; j < starts.outputs(); ++j) {
    const std::size_t i = first + at(j);
    std::copy_n(outputs.polynomial(j), N, set.p.begin() + static_cast<std::ptrdiff_t>(i * N));
    set.R[i] = outputs.radius(j);
    set.W[i] = 0;
    if (!set.low.empty()) set.low[i] = 0;
  }
  return true;
}

}  // namespace gamut
