// Cells are halved, all of one length before the next, until each is calm. A function's change is bounded by the width
// of its range (which serves at kinks) and by its greatest derivative times the cell's length (which serves where
// parameters are uncertain). Sums need no bound: they change as their terms do.
#include "analyses/samples/time_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scalars/index.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {
namespace {

using detail::at;

constexpr double calm = 0.25;            // change against greatest magnitude
constexpr double shortest = 0x1p-30;     // cell, of the horizon
constexpr std::size_t mostCells = 4096;  // an integrator takes at least a step in each
constexpr double beyond = 1e150;         // nothing is integrated with such numbers
constexpr double unbounded = std::numeric_limits<double>::infinity();

struct NodeInputs {
  bool time = false, state = false;
};

/// A component of a linear system's solution counts as one that depends on states.
std::vector<NodeInputs> dependences(const Program& program) {
  std::vector<NodeInputs> result;
  for (const Node& n : program.nodes()) {
    NodeInputs own{n.op == Op::time, n.op == Op::state || n.op == Op::solution};
    const auto take = [&](int operand) {
      own.time = own.time || result[operand].time;
      own.state = own.state || result[operand].state;
    };
    if (operandsOf(n.op) > 0) take(n.a);
    if (operandsOf(n.op) > 1) take(n.b);
    result.push_back(own);
  }
  return result;
}

/// Products of functions of time, and elementary functions of them.
std::vector<int> functionsOfTime(const Program& program) {
  const std::vector<NodeInputs> of = dependences(program);
  std::vector<int> functions;
  for (std::size_t i = 0; i < of.size(); ++i) {
    const Node& n = program.nodes()[i];
    const bool isLinear = n.op == Op::add || n.op == Op::sub || n.op == Op::neg || n.op == Op::time ||
                          (n.op == Op::mul && !(of[n.a].time && of[n.b].time));
    if (of[i].time && !of[i].state && !isLinear) functions.push_back(static_cast<int>(i));
  }
  return functions;
}

Program withDerivatives(const Program& f) {
  Recorder recorder(f);
  std::vector<int> outputs = functionsOfTime(f);
  const std::vector<int> derivatives = tangents(recorder, outputs, {{recorder.time(), recorder.constant(1.0)}});
  outputs.insert(outputs.end(), derivatives.begin(), derivatives.end());
  return recorder.finish(outputs);
}

bool usesParameters(const Program& program) {
  return std::ranges::any_of(program.nodes(), [&](const Node& n) {
    const auto isParameter = [&](int operand) { return program.nodes()[operand].op == Op::parameter; };
    return (operandsOf(n.op) > 0 && isParameter(n.a)) || (operandsOf(n.op) > 1 && isParameter(n.b));
  });
}

}  // namespace

TimeCells::TimeCells(const Program& f, double horizon)
    : horizon_(horizon),
      functions_(withDerivatives(f)),
      dependsOnParameters_(usesParameters(functions_)),
      evaluator_(functions_),
      noStates_(at(f.states())),
      values_(at(functions_.outputs())) {}

const std::vector<double>& TimeCells::ends(std::span<const Interval> parameters) {
  if (values_.empty() || !(horizon_ > 0) || (isKnown_ && !dependsOnParameters_)) return ends_;
  evaluator_.setParameters(parameters);
  ends_.clear();
  for (const Cell& cell : refined()) ends_.push_back(cell.end);
  isKnown_ = true;
  return ends_;
}

TimeCells::Cell TimeCells::evaluated(double begin, double end) {
  const Interval time(begin, end);
  evaluator_(time, noStates_, values_);
  Cell cell{begin, end, {}, {}};
  const std::size_t functions = values_.size() / 2;
  for (std::size_t k = 0; k < functions; ++k) {
    const Interval &value = values_[k], &derivative = values_[functions + k];
    const bool isNowhere = isEmpty(value) || mignitude(value) > beyond;
    const double steepness = isEmpty(derivative) ? unbounded : magnitude(derivative);
    const double change = std::min(width(value), steepness * width(time));
    cell.sizes.push_back(isNowhere ? 0 : magnitude(value));
    cell.changes.push_back(isNowhere ? 0 : std::isnan(change) ? unbounded : change);
  }
  return cell;
}

std::vector<double> TimeCells::scales(const std::vector<Cell>& cells) const {
  std::vector<double> greatest(values_.size() / 2, 0.0);
  for (const Cell& cell : cells)
    for (std::size_t k = 0; k < greatest.size(); ++k)
      if (std::isfinite(cell.sizes[k])) greatest[k] = std::max(greatest[k], cell.sizes[k]);
  return greatest;
}

std::vector<TimeCells::Cell> TimeCells::refined() {
  std::vector<Cell> cells{evaluated(0, horizon_)};
  for (;;) {
    const std::vector<double> scale = scales(cells);
    const auto isCalm = [&](const Cell& cell) {
      for (std::size_t k = 0; k < scale.size(); ++k)
        if (!(cell.changes[k] <= calm * scale[k])) return false;
      return true;
    };
    std::vector<char> isWild;
    for (const Cell& cell : cells) isWild.push_back(!isCalm(cell) && cell.end - cell.begin > shortest * horizon_);
    const auto wild = static_cast<std::size_t>(std::ranges::count(isWild, 1));
    if (wild == 0 || cells.size() + wild > mostCells) return cells;
    std::vector<Cell> next;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (isWild[i] == 0) {
        next.push_back(std::move(cells[i]));
        continue;
      }
      const double middle = std::midpoint(cells[i].begin, cells[i].end);
      next.push_back(evaluated(cells[i].begin, middle));
      next.push_back(evaluated(middle, cells[i].end));
    }
    cells = std::move(next);
  }
}

}  // namespace gamut
