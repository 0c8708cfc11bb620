// One scan of a block against the tightest bounds of each sample, then small comparisons of those that leave them.
#include "analyses/comparison/settlement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "analyses/workers.hpp"
#include "scalars/archive.hpp"

namespace gamut {
namespace {

class SomeOfBlock final : public ComparedSamples {
 public:
  SomeOfBlock(SampleBlock& block, const std::vector<std::size_t>& places) : block_(block), places_(places) {}
  std::size_t size() const override { return places_.size(); }
  std::span<const double> valuesOf(std::size_t sample) const override {
    return std::as_const(block_).values(places_[sample]);
  }
  std::vector<double> trajectory(std::size_t sample) const override { return block_.trajectory(places_[sample]); }
  void setTrajectory(std::size_t sample, std::span<const double> trajectory) override {
    block_.setTrajectory(places_[sample], trajectory);
  }

 private:
  SampleBlock& block_;
  const std::vector<std::size_t>& places_;
};

}  // namespace

Settlement::Settlement(const Proved& proved, const UncertainMotion& system, const ComparisonOptions& options)
    : proved_(proved),
      system_(system),
      options_(options),
      bounds_(system.motion.times.size(), system.motion.outputs()),
      refuted_(1 + proved.cuts.size(), 0) {
  const std::size_t times = system.motion.times.size(), all = bounds_.lower.data.size();
  const auto check = [&](const Envelope& bounds) {
    if (bounds.lower.data.size() != all || bounds.upper.data.size() != all || proved.reachedTimes > times)
      throw std::invalid_argument("proved bounds do not have the motion's times and outputs");
  };
  std::ranges::for_each(proved.cuts, check);
  if (proved.enclosure.empty()) return;
  check(proved.enclosure);
  const std::size_t size = proved.reachedTimes * system.motion.outputs();
  std::copy_n(proved.enclosure.lower.data.begin(), size, bounds_.lower.data.begin());
  std::copy_n(proved.enclosure.upper.data.begin(), size, bounds_.upper.data.begin());
}

void Settlement::archive(Archive& all) {
  all(refuted_, moved_, known_.outputs, known_.values, known_.error, known_.rounding);
}

/// Of samples in no cut, in the first, in the first two … at one output and time. fmax, fmin: NaN is no bound.
void Settlement::boundLevels(std::size_t cell, std::vector<double>& lower, std::vector<double>& upper) const {
  lower[0] = bounds_.lower.data[cell];
  upper[0] = bounds_.upper.data[cell];
  for (std::size_t level = 0; level < proved_.cuts.size(); ++level) {
    lower[level + 1] = std::fmax(lower[level], proved_.cuts[level].lower.data[cell]);
    upper[level + 1] = std::fmin(upper[level], proved_.cuts[level].upper.data[cell]);
  }
}

/// The samples that leave their tightest bounds, by rising number.
std::vector<std::size_t> Settlement::leavers(SampleBlock& block) const {
  std::vector<char> leaves(block.size(), 0);
  const std::size_t size = proved_.reachedTimes * system_.motion.outputs();
  forEachIndex(options_.jobs, block.packs(), nullptr, [&] {
    return [&](std::size_t pack) {
      if (!block.isHere(pack)) return;
      const std::size_t first = pack * packWidth, count = std::min<std::size_t>(packWidth, block.size() - first);
      const double* row = block.pack(pack).data();
      std::vector<double> lower(1 + proved_.cuts.size()), upper(lower.size());
      for (std::size_t i = 0; i < size; ++i, row += packWidth) {
        boundLevels(i, lower, upper);
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
  block.fetch(numbers);
  return numbers;
}

/// Of the disputed samples those that lie in the cut of this level, or, level -1, all, and leave the bounds.
void Settlement::compareSome(const Envelope& bounds, int level, SampleBlock& block,
                             const std::vector<std::size_t>& disputed, const Take& take) {
  const std::size_t cells = proved_.reachedTimes * system_.motion.outputs();
  std::vector<std::size_t> places;
  for (const std::size_t i : disputed) {
    if (static_cast<int>(block.levels[i]) <= level) continue;
    bool isOutside = false;
    for (std::size_t cell = 0; cell < cells && !isOutside; ++cell) isOutside = leaves(block, i, cell, bounds);
    if (isOutside) places.push_back(i);
  }
  if (places.empty()) return;
  ComparisonOptions options = options_;
  char& refuted = refuted_[level + 1];
  options.asksArbiter = options.asksArbiter && refuted == 0;
  options.known = &known_;
  SomeOfBlock some(block, places);
  Comparison found = compare({bounds, proved_.reachedTimes}, some, system_, options);
  for (Dispute& d : found.disputes) {
    refuted |= static_cast<char>(d.outside);
    d.number = block.first() + places[d.number];
  }
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
  const auto boundsOf = [&] { return &(level < 0 ? proved_.enclosure : proved_.cuts[level]); };
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
  std::vector<double> lower(1 + proved_.cuts.size()), upper(lower.size());
  for (std::size_t i = 0; i < disputed.size() && known_.values.empty(); ++i)
    for (std::size_t cell = 0; cell < cells && known_.values.empty(); ++cell) {
      if (moved_[cell % outputs] != 0) continue;
      boundLevels(cell, lower, upper);
      const std::size_t level = block.levels[disputed[i]];
      const double value = block(disputed[i], 0, cell);
      if (!(value < lower[level] || value > upper[level])) continue;
      known_ = settleUnmoved(system_, moved_, proved_.reachedTimes, options_.cancelled);
      if (known_.values.empty()) return;  // it was cancelled
      const double settled = known_.values[cell], own = known_.rounding[cell], rounding = std::isfinite(own) ? own : 0;
      if (settled >= lower[level] - rounding && settled <= upper[level] + rounding)
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
