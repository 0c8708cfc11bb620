// One scan of a block against the tightest bounds of each sample, then small comparisons of those that leave them.
#include "analyses/comparison/settlement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analyses/workers.hpp"

namespace gamut {

Settlement::Settlement(const Proved& proved, const UncertainMotion& system, const ComparisonOptions& options)
    : proved_(proved), system_(system), options_(options), refuted_(1 + proved.cuts.size(), 0) {
  const std::size_t times = system.motion.times.size(), outputs = system.motion.outputs();
  const std::size_t size = proved.reachedTimes * outputs;
  Envelope bounds(times, outputs);
  const auto narrow = [&](const Envelope& by) {
    if (by.lower.data.size() != bounds.lower.data.size() || by.upper.data.size() != bounds.upper.data.size() ||
        proved.reachedTimes > times)
      throw std::invalid_argument("proved bounds do not have the motion's times and outputs");
    for (std::size_t i = 0; i < size; ++i) {
      bounds.lower.data[i] = std::fmax(bounds.lower.data[i], by.lower.data[i]);  // fmax, fmin: NaN is no bound
      bounds.upper.data[i] = std::fmin(bounds.upper.data[i], by.upper.data[i]);
    }
  };
  if (!proved.enclosure.empty()) narrow(proved.enclosure);
  tightest_.push_back(bounds);
  for (const Envelope& cut : proved.cuts) {
    narrow(cut);
    tightest_.push_back(bounds);
  }
}

/// The samples that leave their tightest bounds, by rising number.
std::vector<std::size_t> Settlement::leavers(const SampleBlock& block) const {
  std::vector<char> leaves(block.size(), 0);
  const std::size_t size = proved_.reachedTimes * system_.motion.outputs();
  forEachIndex(options_.jobs, block.packs(), nullptr, [&] {
    return [&](std::size_t pack) {
      const std::size_t first = pack * packWidth, count = std::min<std::size_t>(packWidth, block.size() - first);
      const double* row = block.pack(pack).data();
      std::vector<double> lower(tightest_.size()), upper(tightest_.size());
      for (std::size_t i = 0; i < size; ++i, row += packWidth) {
        for (std::size_t level = 0; level < tightest_.size(); ++level) {
          lower[level] = tightest_[level].lower.data[i];
          upper[level] = tightest_[level].upper.data[i];
        }
        for (std::size_t lane = 0; lane < count; ++lane) {
          const std::size_t level = block.levels[first + lane];
          leaves[first + lane] |= static_cast<char>((row[lane] < lower[level]) | (row[lane] > upper[level]));
        }
      }
    };
  });
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < block.size(); ++i)
    if (leaves[i] != 0) numbers.push_back(i);
  return numbers;
}

/// Of the disputed samples those that lie in the cut of this level, or, level -1, all, and leave the bounds, as a small
/// ensemble.
void Settlement::compareSome(const Envelope& bounds, int level, SampleBlock& block,
                             const std::vector<std::size_t>& disputed, const Take& take) {
  Ensemble some;
  some.times = system_.motion.times;
  some.outputs = system_.motion.outputs();
  some.quantities = system_.uncertain.size();
  std::vector<std::size_t> places;
  for (const std::size_t i : disputed) {
    if (static_cast<int>(block.levels[i]) <= level) continue;
    const std::vector<double> trajectory = block.trajectory(i);
    bool leaves = false;
    for (std::size_t cell = 0; cell < proved_.reachedTimes * some.outputs; ++cell)
      leaves = leaves || trajectory[cell] < bounds.lower.data[cell] || trajectory[cell] > bounds.upper.data[cell];
    if (!leaves) continue;
    places.push_back(i);
    const std::span<const double> values = std::as_const(block).values(i);
    some.values.insert(some.values.end(), values.begin(), values.end());
    some.data.insert(some.data.end(), trajectory.begin(), trajectory.end());
  }
  if (places.empty()) return;
  ComparisonOptions options = options_;
  char& refuted = refuted_[static_cast<std::size_t>(level + 1)];
  options.asksArbiter = options.asksArbiter && refuted == 0;
  options.known = &known_;
  Comparison found = compare({bounds, proved_.reachedTimes}, some, system_, options);
  for (Dispute& d : found.disputes) {
    refuted |= static_cast<char>(d.outside);
    d.number = block.first() + places[d.number];
  }
  for (std::size_t i = 0; i < places.size(); ++i) block.setTrajectory(places[i], std::as_const(some).trajectory(i));
  take(found, level);
}

bool Settlement::leaves(const SampleBlock& block, std::size_t sample, std::size_t cell, const Envelope& bounds) const {
  const double value = block(sample, 0, cell);
  return value < bounds.lower.data[cell] || value > bounds.upper.data[cell];
}

/// One dispute stands for all: of the first sample that left its bounds by an output that is the same of all.
void Settlement::tellOf(const SampleBlock& block, std::size_t sample, std::size_t cell, const Take& take) const {
  const std::size_t outputs = known_.outputs;
  int level = proved_.enclosure.empty() ? 0 : -1;
  const auto boundsOf = [&] {
    return &(level < 0 ? proved_.enclosure : proved_.cuts[static_cast<std::size_t>(level)]);
  };
  while (level + 1 < static_cast<int>(block.levels[sample]) && !leaves(block, sample, cell, *boundsOf())) ++level;
  const Envelope& bounds = *boundsOf();
  Dispute d;
  d.number = block.first() + sample;
  d.time = cell / outputs;
  d.output = cell % outputs;
  d.value = known_.values[cell];
  d.lower = bounds.lower.data[cell];
  d.upper = bounds.upper.data[cell];
  d.error = known_.error[cell];
  d.decided = "Taylor 128 bits";
  d.farthest.assign(outputs, 0.0);
  take({0, {std::move(d)}}, level);
}

/// Where an output leaves its bounds that is the same of all samples, it is settled for all that follow; what refutes
/// the bounds stays a matter of every sample.
void Settlement::settleOnce(SampleBlock& block, const std::vector<std::size_t>& disputed, const Take& take) {
  if (moved_.empty()) moved_ = movedOutputs(system_);
  const std::size_t outputs = moved_.size(), cells = proved_.reachedTimes * outputs;
  if (std::ranges::find(moved_, 0) == moved_.end()) return;
  for (std::size_t i = 0; i < disputed.size() && known_.values.empty(); ++i)
    for (std::size_t cell = 0; cell < cells && known_.values.empty(); ++cell) {
      const Envelope& bounds = tightest_[block.levels[disputed[i]]];
      if (moved_[cell % outputs] != 0 || !leaves(block, disputed[i], cell, bounds)) continue;
      known_ = settleUnmoved(system_, moved_, proved_.reachedTimes, options_.cancelled);
      if (known_.values.empty()) return;  // it was cancelled
      const double settled = known_.values[cell];
      if (settled >= bounds.lower.data[cell] && settled <= bounds.upper.data[cell])
        tellOf(block, disputed[i], cell, take);
    }
  for (const std::size_t i : disputed)
    for (std::size_t cell = 0; cell < known_.values.size(); ++cell)
      if (known_.holds(cell) && !std::isnan(block(i, 0, cell))) block(i, 0, cell) = known_.values[cell];
}

void Settlement::settle(SampleBlock& block, const Take& take) {
  const std::vector<std::size_t> disputed = leavers(block);
  if (disputed.empty()) return;
  settleOnce(block, disputed, take);
  if (!proved_.enclosure.empty()) compareSome(proved_.enclosure, -1, block, disputed, take);
  for (std::size_t level = proved_.cuts.size(); level-- > 0;)
    compareSome(proved_.cuts[level], static_cast<int>(level), block, disputed, take);
}

}  // namespace gamut
