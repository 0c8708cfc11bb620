// Arguments as states: their rates, and where they start.
#include "analyses/flow/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analyses/flow/outputs/outputs.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "scalars/index.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/linear_form.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

namespace {

/// Of each node, whether it depends on a state, and whether on a sign or an absolute value.
struct Dependence {
  std::vector<char> moves, bends;
};

Dependence dependenceOf(const Program& f) {
  Dependence result;
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const Op op = f.nodes()[i].op;
    bool moves = op == Op::state, isBent = !isSmooth(op);
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) {
      moves = moves || result.moves[operand] != 0;
      isBent = isBent || result.bends[operand] != 0;
    });
    result.moves.push_back(static_cast<char>(moves));
    result.bends.push_back(static_cast<char>(isBent));
  }
  return result;
}

/// Nodes of `all` that are such arguments of signs among `nodes`.
std::vector<int> argumentsAmong(const Program& all, const std::vector<int>& nodes) {
  const Dependence on = dependenceOf(all);
  std::vector<int> arguments;
  for (const int node : nodes) {
    if (all.nodes()[node].op != Op::sign) continue;
    const int u = all.nodes()[node].a;
    if (on.moves[u] != 0 && on.bends[u] == 0 && std::ranges::find(arguments, u) == arguments.end() &&
        !linearFormOf(all, u))
      arguments.push_back(u);
  }
  return arguments;
}

}  // namespace

std::optional<FlowFormulation> withSurfaces(const FlowFormulation& of) {
  constexpr std::size_t most = 4;  // each costs as much as a state does
  if (std::ranges::none_of(of.motion.nodes(), [](const Node& node) { return node.op == Op::sign; }))
    return std::nullopt;
  const int n = of.motion.states(), k = of.motion.parameters();
  Recorder joint(n, k);
  std::vector<std::vector<int>> results;
  std::vector<int> ofMotion;
  for (const Program* written : {&of.motion, &of.outputs, &of.asides}) {
    const Program program = withBareSigns(withBareKinks(*written));
    const std::vector<int> here = joint.append(program);
    if (ofMotion.empty()) ofMotion = here;
    results.emplace_back();
    for (const int output : program.outputNodes()) results.back().push_back(here[output]);
  }
  std::vector<int> outputs;
  for (const std::vector<int>& nodes : results) outputs.insert(outputs.end(), nodes.begin(), nodes.end());
  const Program all = joint.program(outputs);
  const std::vector<int> arguments = argumentsAmong(all, ofMotion);
  const auto count = static_cast<int>(arguments.size());
  if (count == 0 || arguments.size() > std::max(most, at(n))) return std::nullopt;

  Recorder recorder(n + count, k);
  std::vector<int> instead(all.nodes().size(), -1);
  for (int j = 0; j < count; ++j) instead[arguments[j]] = recorder.state(n + j);
  const std::vector<int> here = recorder.append(all, {}, instead);
  const std::vector<int> plain = recorder.append(all);
  const auto chosen = [](const std::vector<int>& from, const std::vector<int>& nodes) {
    std::vector<int> result;
    for (const int node : nodes) result.push_back(from[node]);
    return result;
  };
  std::vector<int> motion = chosen(here, results[0]);
  std::vector<std::pair<int, int>> seeds{{recorder.time(), recorder.constant(1.0)}};
  for (int i = 0; i < n; ++i) seeds.emplace_back(recorder.state(i), motion[i]);
  const std::vector<int> rates = tangents(recorder, chosen(plain, arguments), seeds);
  motion.insert(motion.end(), rates.begin(), rates.end());
  // Outputs that neither jump nor bend are what they are: samples know no u that is zero exactly, as a held one is.
  const std::vector<char> isBent = dependenceOf(all).bends;
  const auto seen = [&](const std::vector<int>& nodes) {
    std::vector<int> result;
    for (const int node : nodes) result.push_back((isBent[node] != 0 ? here : plain)[node]);
    return recorder.finish(result);
  };
  FlowFormulation result(recorder.finish(motion), seen(results[1]), of.inputs, seen(results[2]));
  result.states = of.states;
  result.hasClock = of.hasClock;
  result.starts = recorder.finish(chosen(plain, arguments));
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
    // Until the first step C is the identity, and there are no generators: |x - p| ≤ W + R + |low|, rounded twice.
    const double low = set.low.empty() ? 0 : std::fabs(set.low[i]);
    point.loose.push_back(i < first ? (set.W[i] + set.R[i] + low) * bounds::up : 0);
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
