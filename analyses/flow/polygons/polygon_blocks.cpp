// Which states depend on each other, and the turns of their polygons.
#include "analyses/flow/polygons/polygon_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "analyses/flow/polygons/polygon_range.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

namespace {

constexpr int sidesOfTwo = 64, sidesOfOne = 8;

/// [i][j]: whether ẋ_i depends on x_j.
std::vector<std::vector<char>> dependencesOf(const Program& f) {
  std::vector<std::vector<char>> of(f.nodes().size(), std::vector<char>(f.states(), 0)), result;
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (f.nodes()[i].op == Op::state) of[i][f.nodes()[i].a] = 1;
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) {
      for (std::size_t j = 0; j < of[i].size(); ++j) of[i][j] = static_cast<char>(of[i][j] | of[operand][j]);
    });
  }
  for (int i = 0; i < f.states(); ++i) result.push_back(of[f.outputNodes()[i]]);
  return result;
}

/// States of each block, in order; none if some block has more than two.
std::vector<std::array<int, 2>> blocksOf(const Program& f) {
  const std::vector<std::vector<char>> direct = dependencesOf(f);
  std::vector<std::vector<char>> any = direct;  // through others as well
  const std::size_t n = direct.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) any[i][j] = static_cast<char>(any[i][j] | (any[i][k] & any[k][j]));
  std::vector<char> isDone(n, 0);
  std::vector<std::array<int, 2>> blocks;
  const auto mayFollow = [&](std::size_t i, std::size_t other) {  // all that it depends on is done, or these two
    for (std::size_t j = 0; j < n; ++j)
      if (direct[i][j] != 0 && isDone[j] == 0 && j != i && j != other) return false;
    return true;
  };
  for (std::size_t count = 0; count < n;) {
    const std::size_t before = count;
    for (std::size_t i = 0; i < n && count == before; ++i) {
      if (isDone[i] != 0) continue;
      std::size_t other = i;
      for (std::size_t j = 0; j < n; ++j)
        if (j != i && any[i][j] != 0 && any[j][i] != 0) other = j;
      if (!mayFollow(i, other) || !mayFollow(other, i)) continue;
      // One by itself goes together with one that follows it.
      for (std::size_t j = 0; j < n && other == i; ++j)
        if (j != i && isDone[j] == 0 && direct[j][i] != 0 && mayFollow(j, i)) other = j;
      isDone[i] = isDone[other] = 1;
      count += other == i ? 1 : 2;
      blocks.push_back({static_cast<int>(std::min(i, other)), other == i ? -1 : static_cast<int>(std::max(i, other))});
    }
    if (count == before) return {};
  }
  return blocks;
}

/// These states' f with `drivers` as parameters behind its own.
Program blockOf(const Program& f, const std::array<int, 2>& states, const std::vector<int>& drivers) {
  std::vector<int> needed;
  for (const int state : states)
    if (state >= 0) needed.push_back(f.outputNodes()[state]);
  const Program own = Recorder(f).finish(needed);
  Recorder recorder(2, f.parameters() + static_cast<int>(drivers.size()));
  const int nothing = recorder.constant(0.0);
  std::vector<int> instead(own.nodes().size(), -1), parameters, outputs;
  for (int i = 0; i < f.states(); ++i) instead[i] = nothing;  // of those that it does not depend on
  for (std::size_t k : {0U, 1U})
    if (states[k] >= 0) instead[states[k]] = recorder.state(static_cast<int>(k));
  for (std::size_t d = 0; d < drivers.size(); ++d)
    instead[drivers[d]] = recorder.parameter(f.parameters() + static_cast<int>(d));
  for (int p = 0; p < f.parameters(); ++p) parameters.push_back(recorder.parameter(p));
  const std::vector<int> here = recorder.append(own, parameters, instead);
  for (const int node : own.outputNodes()) outputs.push_back(here[node]);
  outputs.resize(2, nothing);
  return recorder.finish(outputs);
}

}  // namespace

bool PolygonBlocks::suits(const Program& f) {
  return std::ranges::none_of(f.nodes(),
                              [](const Node& node) {
                                return !isSmooth(node.op) || isOneSided(domainOf(node.op)) || node.op == Op::solution;
                              }) &&
         !blocksOf(f).empty();
}

PolygonBlocks::PolygonBlocks(const Program& f, const Box& box, double horizon) {
  const std::vector<std::vector<char>> direct = dependencesOf(f);
  for (const std::array<int, 2>& states : blocksOf(f)) {
    std::vector<int> drivers;
    for (int j = 0; j < f.states(); ++j)
      if (j != states[0] && j != states[1] &&
          std::ranges::any_of(states, [&](int i) { return i >= 0 && direct[i][j] != 0; }))
        drivers.push_back(j);
    Box parameters(box.begin() + f.states(), box.end());
    std::vector<char> isWide = widthsOf(parameters);
    for (const int driver : drivers) parameters.push_back(box[driver]);
    isWide.resize(parameters.size(), 1);
    const Box starts{box[states[0]], states[1] >= 0 ? box[states[1]] : Interval(0.0)};
    blocks_.push_back({states,
                       PolygonMotion(blockOf(f, states, drivers), starts, parameters, isWide, horizon,
                                     states[1] >= 0 ? sidesOfTwo : sidesOfOne),
                       drivers, parameters});
  }
  over_.assign(f.states(), Interval::empty());
  reachOver_.resize(blocks_.size());
  forget();
}

PlaneVector PolygonBlocks::direction(std::size_t i) {
  const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(directions);
  return {std::cos(angle), std::sin(angle)};
}

double PolygonBlocks::longestStep() const {
  double longest = std::numeric_limits<double>::infinity();
  for (const Block& block : blocks_) longest = std::min(longest, block.motion.longestStep());
  return longest;
}

void PolygonBlocks::forget() {
  for (std::vector<double>& reach : reachOver_) reach.assign(directions, -std::numeric_limits<double>::infinity());
}

bool PolygonBlocks::step(double end) {
  double until = time_ + longestStep();
  if (until > end - 1e-3 * longestStep()) until = end;
  if (!(until > time_)) return false;
  std::ranges::fill(over_, Interval::empty());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block& block = blocks_[b];
    const std::size_t own = block.parameters.size() - block.drivers.size();
    for (std::size_t d = 0; d < block.drivers.size(); ++d) block.parameters[own + d] = over_[block.drivers[d]];
    if (!block.drivers.empty()) block.motion.setParameters(block.parameters);
    while (block.motion.time() < until) {
      if (!block.motion.step(until)) return false;
      for (std::size_t i = 0; i < directions; ++i)
        reachOver_[b][i] = std::max(reachOver_[b][i], block.motion.reachOver(direction(i)));
      for (std::size_t k : {0U, 1U}) {
        if (block.states[k] < 0) continue;
        PlaneVector axis{};
        axis[k] = 1;
        const double most = block.motion.reachOver(axis);
        axis[k] = -1;
        const Interval over = Interval(-block.motion.reachOver(axis), most) * Interval(block.motion.units()[k]);
        over_[block.states[k]] = hull(over_[block.states[k]], over);
      }
    }
  }
  time_ = until;
  return true;
}

std::vector<Interval> PolygonBlocks::states() const {
  std::vector<Interval> result(over_.size());
  for (const Block& block : blocks_)
    for (std::size_t k : {0U, 1U})
      if (block.states[k] >= 0)
        result[block.states[k]] = block.motion.polygon().box()[k] * Interval(block.motion.units()[k]);
  return result;
}

}  // namespace gamut
