// A tube of what all pieces gave.
#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

#include "analyses/flow/run.hpp"
#include "analyses/flow/start_outputs.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// Both hold; where nothing is left (no value is defined), `into` stays.
void narrow(std::vector<Interval>& into, const std::vector<Interval>& other) {
  for (std::size_t i = 0; i < into.size(); ++i)
    if (const Interval both = intersection(into[i], other[i]); !isEmpty(both)) into[i] = both;
}

}  // namespace

void FlowCollected::join(FlowCollected&& other) {
  const auto hulls = [](std::vector<std::vector<Interval>>& into, const std::vector<std::vector<Interval>>& from) {
    for (std::size_t row = 0; row < into.size(); ++row)
      if (!from[row].empty()) joinHulls(into[row], from[row]);
  };
  hulls(states, other.states);
  hulls(statesOver, other.statesOver);
  hulls(outputs, other.outputs);
  hulls(outputsOver, other.outputsOver);
  hulls(outputsOfWhole, other.outputsOfWhole);
  hulls(reached, other.reached);
  hulls(asides, other.asides);
  hulls(stateCore, other.stateCore);
  hulls(outputCore, other.outputCore);
  for (std::size_t level = 0; level < cuts.size(); ++level) hulls(cuts[level], other.cuts[level]);
  for (std::size_t row = 0; row < extremes.size(); ++row) {
    extremes[row].resize(std::max(extremes[row].size(), other.extremes[row].size()));
    for (std::size_t o = 0; o < other.extremes[row].size(); ++o) extremes[row][o].join(other.extremes[row][o]);
    std::ranges::move(other.models[row], std::back_inserter(models[row]));
    std::ranges::move(other.chords[row], std::back_inserter(chords[row]));
  }
  influence.resize(std::max(influence.size(), other.influence.size()));
  for (std::size_t l = 0; l < other.influence.size(); ++l) {
    influence[l].any = std::max(influence[l].any, other.influence[l].any);
    influence[l].nonlinear = std::max(influence[l].nonlinear, other.influence[l].nonlinear);
  }
  for (std::size_t row = 0; row < unproved.size(); ++row) {
    unproved[row].resize(std::max(unproved[row].size(), other.unproved[row].size()));
    for (std::size_t o = 0; o < other.unproved[row].size(); ++o) unproved[row][o] |= other.unproved[row][o];
  }
  narrowing.resize(std::max(narrowing.size(), other.narrowing.size()));
  for (std::size_t l = 0; l < other.narrowing.size(); ++l) narrowing[l] += other.narrowing[l];
  metThreshold = metThreshold || other.metThreshold;
  slideLoss = std::max(slideLoss, other.slideLoss);
  steps += other.steps;
  cpu += other.cpu;
  cutCpu += other.cutCpu;
}

/// How far all came, and why no farther.
void FlowRun::explainEnd(Tube& tube) const {
  tube.reached_ = std::min(task_.horizon, failedAt_);
  if (!cause_.isNone() && failedAt_ < task_.horizon) {  // at its end nothing fails: a stricter run is worth trying
    // Where not even one start comes much farther, it is no matter of what the set has become.
    constexpr double nearly = 0.9;
    const bool isOfMotion = cause_.kind == FlowCause::Kind::escape || cause_.kind == FlowCause::Kind::edge;
    const bool isOfStart = !ended_.isNone() && !isOfMotion && failedAt_ >= nearly * endedAt_;
    tube.cause_ = isOfStart ? ended_ : cause_;
    if (tube.cause_.kind == FlowCause::Kind::remainder && task_.embedding.symbols > 0)
      tube.cause_.number = !task_.options.split ? -1 : task_.options.degree >= 0 ? task_.options.degree + 2 : 0;
    tube.why_ = "at " + toString(failedAt_) + " s " + tube.cause_.sentence();
  }
  double earliest = unfinished_;
  for (const Traveller& traveller : all_) earliest = std::min(earliest, traveller.piece.set.t);
  if (stop_ && earliest < tube.reached_) {
    tube.reached_ = earliest;
    using enum FlowCause::Kind;
    tube.cause_ = {outOfMemory_ ? outOfMemory : overBudget_ ? overBudget : interrupted};
    tube.why_ = tube.cause_.sentence();
  }
}

void FlowRun::gatherBounds(Tube& tube, std::size_t rows) const {
  const auto merge = [&](Rows FlowCollected::*member, Rows& into) {
    into.resize(rows);
    for (std::size_t row = 0; row < rows; ++row)
      for (const FlowCollected& part : collected_)
        if (!(part.*member)[row].empty()) joinHulls(into[row], (part.*member)[row]);
  };
  merge(&FlowCollected::states, tube.states_);
  merge(&FlowCollected::statesOver, tube.statesOver_);
  merge(&FlowCollected::outputs, tube.outputs_);
  merge(&FlowCollected::outputsOver, tube.outputsOver_);
  merge(&FlowCollected::asides, tube.asides_);
  tube.extremes_.resize(rows);
  for (const FlowCollected& part : collected_)
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<OutputExtremes>& all = tube.extremes_[row];
      all.resize(std::max(all.size(), part.extremes[row].size()));
      for (std::size_t o = 0; o < part.extremes[row].size(); ++o) all[o].join(part.extremes[row][o]);
    }
}

/// Not even one step was done: the start itself is known.
void FlowRun::takeStart(Tube& tube) {
  tube.states_ =
      tube.statesOver_ = {std::vector<Interval>(task_.box.begin(), task_.box.begin() + task_.motion.states())};
  tube.outputs_ = tube.outputsOver_ = {std::vector<Interval>(task_.outputs.outputs(), Interval::entire())};
  tube.asides_ = {std::vector<Interval>(task_.looksAside[0] == 0 ? 0 : at(task_.options.aside.values.outputs()),
                                        Interval::entire())};
  for (auto& part : collected_)
    for (auto& level : part.cuts) level[0] = tube.outputs_[0].empty() ? tube.states_[0] : tube.outputs_[0];
}

void FlowRun::gatherCuts(Tube& tube) const {
  const std::size_t rows = tube.states_.size();
  StartOutputs atStart(task_, task_.outputs);
  tube.cuts_.assign(task_.levels.size(), Rows(rows));
  for (std::size_t level = 0; level < task_.levels.size(); ++level)
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<Interval>& cut = tube.cuts_[level][row];
      for (const FlowCollected& part : collected_)
        if (!part.cuts[level][row].empty()) joinHulls(cut, part.cuts[level][row]);
      // Nested boxes have nested ranges, so the bound of the level outside holds here too.
      const std::vector<Interval>& outside = level > 0                     ? tube.cuts_[level - 1][row]
                                             : task_.outputs.outputs() > 0 ? tube.outputs_[row]
                                                                           : tube.states_[row];
      for (std::size_t i = 0; i < cut.size(); ++i) cut[i] = intersection(cut[i], outside[i]);
      if (row == 0) narrow(cut, task_.outputs.outputs() > 0 ? atStart.over(task_.levels[level]) : task_.levels[level]);
    }
}

/// By how much bounds are wider than the cores that are known to be reached, in shares of these; 0 where that is
/// nothing to speak of.
std::vector<std::vector<double>> FlowRun::excessOf(const Rows& bounds, Rows FlowCollected::*cores,
                                                   const std::vector<double>& floors) const {
  constexpr double unheard = 1e-6;                               // of what it will be
  const double widest = std::max(task_.embedding.widest, 1e-8);  // inputs apart
  const double aim = task_.aim(),
               wellKnown = 5e-5 * aim;  // nor are bounds measured that are so much tighter than the box
  const double rounding = std::min(0x1p-44, wellKnown * widest);  // of its greatest size: where it passes through zero
  const double hardlyVaries =
      3 * aim * aim;  // what hardly varies at all, but for what is left over, is no width to keep
  const std::size_t rows = bounds.size(), count = bounds[0].size();
  std::vector<std::vector<double>> shares(rows);
  Rows core(rows);
  std::vector<double> greatest(count, 0.0);  // width over all times
  std::vector<double> largest(count, 0.0);   // magnitude
  std::vector<char> isZero(count, 1);        // at all times, as symmetry keeps it
  for (std::size_t row = 0; row < rows; ++row) {
    for (const FlowCollected& part : collected_)
      if (!(part.*cores)[row].empty()) joinHulls(core[row], (part.*cores)[row]);
    for (std::size_t i = 0; i < bounds[row].size(); ++i) {
      const Interval& bound = bounds[row][i];
      const bool isStart = row == 0;  // hardly anything is left over there, but how large an output was counts
      if (isStart && !isBounded(bound)) continue;
      greatest[i] = std::max(greatest[i], width(bound));
      largest[i] = std::max(largest[i], magnitude(bound));
      if (!isStart && !(contains(bound, 0.0) && magnitude(core[row][i]) <= 1e-6 * width(bound))) isZero[i] = 0;
    }
  }
  for (std::size_t row = 0; row < rows; ++row) {
    shares[row].resize(bounds[row].size(), 0.0);
    for (std::size_t i = 0; i < core[row].size(); ++i) {
      const Interval& bound = bounds[row][i];
      const double rest = width(core[row][i]), remainder = width(bound) - rest;
      const bool isInvariant = rest < 0.5 * remainder && remainder < hardlyVaries * widest * magnitude(bound);
      if (isZero[i] == 0 && !isInvariant && remainder > wellKnown * widest * magnitude(bound) &&
          remainder > unheard * greatest[i] && remainder > rounding * largest[i] &&
          (floors.empty() || remainder > floors[i]))
        shares[row][i] = rest > 0 ? remainder / rest : std::numeric_limits<double>::infinity();
    }
  }
  return shares;
}

/// How loose outputs are without what parts of pieces tell at output times: between these nothing else is known.
void FlowRun::measureWhole(Tube& tube, double ofStates) {
  if (task_.outputs.outputs() == 0) return;
  Rows whole = tube.outputs_;
  reachedByOutputs_.assign(whole.size(), Box(at(task_.outputs.outputs()), Interval::empty()));
  for (const FlowCollected& part : collected_)
    for (std::size_t row = 0; row < whole.size(); ++row)
      if (!part.reached[row].empty()) joinHulls(reachedByOutputs_[row], part.reached[row]);
  for (const FlowCollected& part : collected_)
    for (std::size_t row = 0; row < whole.size(); ++row)
      if (!part.outputsOfWhole[row].empty()) joinHulls(whole[row], part.outputsOfWhole[row]);
  std::vector<std::vector<double>> excess = excessOf(whole, &FlowCollected::outputCore, task_.options.floors);
  double sum = 0, count = 0;
  for (std::vector<double>& row : excess) {
    for (const int output : task_.options.uncounted) row[output] = 0;
    for (const double share : row) sum += std::isfinite(share) ? share / (1 + share) : 1;
    count += static_cast<double>(row.size());
  }
  ofWhole_ = count > 0 ? sum / count : 0;
  std::swap(excess, tube.excess_);
  // Pieces of a degree that is given are as tight as that allows.
  constexpr double muchTighter = 0.25;
  const double looseness = loosenessOf(tube, task_.options);
  const double tight = task_.mayBisect ? task_.aim() : std::max(task_.aim(), muchTighter * looseness);
  isOfOutputs_ = looseness > task_.aim() && ofStates <= tight;
  std::swap(excess, tube.excess_);
}

/// And whether a higher degree of outputs is wanted.
void FlowRun::measureExcess(Tube& tube) {
  tube.excess_ = excessOf(tube.states_, &FlowCollected::stateCore, {});
  const double ofStates = tube.tightness() - 1;
  if (task_.outputs.outputs() > 0)
    tube.excess_ = excessOf(tube.outputs_, &FlowCollected::outputCore, task_.options.floors);
  for (const int output : task_.options.uncounted)
    for (std::vector<double>& row : tube.excess_) row[output] = 0;
  const auto isWide = [&](int input) { return !isThin(task_.box[task_.motion.states() + input]); };
  if (task_.embedding.symbols == 0 && std::ranges::none_of(task_.varying, isWide)) tube.excess_.clear();
  looseness_ = loosenessOf(tube, task_.options);
  const std::vector<std::vector<double>> all = tube.excess_;
  for (const FlowCollected& part : collected_)
    for (std::size_t row = 0; row < tube.excess_.size(); ++row)
      for (std::size_t o = 0; o < part.unproved[row].size(); ++o)
        if (part.unproved[row][o] != 0) tube.excess_[row][o] = 0;
  ofPolynomials_ = loosenessOf(tube, task_.options);
  tube.excess_ = all;
  measureWhole(tube, ofStates);
  needsDegree_ = ofPolynomials_ > task_.aim() && ofStates <= task_.aim();
}

void FlowRun::gatherCounts(Tube& tube) {
  for (const Traveller& traveller : all_) count(traveller.piece);
  for (const FlowCollected& part : collected_) {
    metThreshold_ = metThreshold_ || part.metThreshold;
    slideLoss_ = std::max(slideLoss_, part.slideLoss);
  }
  timeShare_ = timeError_ > 0 ? timeError_ / (timeError_ + truncation_) : 0;
  for (const FlowCollected& part : collected_)
    for (std::size_t l = 0; l < part.influence.size(); ++l) {
      influence_[l].any = std::max(influence_[l].any, part.influence[l].any);
      influence_[l].nonlinear = std::max(influence_[l].nonlinear, part.influence[l].nonlinear);
    }
  narrowing_.resize(influence_.size());
  for (const FlowCollected& part : collected_)
    for (std::size_t l = 0; l < part.narrowing.size(); ++l) narrowing_[l] += part.narrowing[l];
  for (const Embedded& e : task_.embedding.components)
    tube.nonlinear_.push_back(e.symbol >= 0 ? influence_[e.symbol].nonlinear : 0);
  tube.pieces_ = pieces_;
  for (const FlowCollected& part : collected_) {
    tube.steps_ += part.steps;
    tube.cpu_ += part.cpu - part.cutCpu;
    tube.cutCpu_ += part.cutCpu;
  }
}

Tube FlowRun::gather() {
  Tube tube;
  tube.times_ = task_.times;
  explainEnd(tube);
  std::size_t rows = 0;
  while (rows < task_.times.size() && task_.times[rows] <= tube.reached_ && (rows > 0 || tube.reached_ > 0)) ++rows;
  gatherBounds(tube, rows);
  if (rows == 0)
    takeStart(tube);
  else
    tube.models_ = modelsOf(rows);
  // g over start values in plain intervals: exactly what is known exactly.
  narrow(tube.outputs_[0], StartOutputs(task_, task_.outputs).over(task_.box));
  tube.outputsOver_[0] = tube.outputs_[0];
  if (!tube.asides_[0].empty())
    narrow(tube.asides_[0], StartOutputs(task_, task_.options.aside.values).over(task_.box));
  gatherCuts(tube);
  measureExcess(tube);
  gatherCounts(tube);
  return tube;
}

}  // namespace gamut
