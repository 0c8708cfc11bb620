// Samples against all that is proved, block by block as they arrive: those that leave the enclosure, or an alpha-cut
// whose values are theirs, are looked at again, and what they become counts in their place.
#pragma once

#include <functional>
#include <vector>

#include "analyses/comparison/comparison.hpp"
#include "analyses/comparison/unmoved.hpp"
#include "analyses/samples/ensemble.hpp"

namespace gamut {

class Archive;

/// What is proved at the first `reachedTimes` output times; what it is made of must outlive it.
struct Proved {
  const Envelope& enclosure;          ///< for all samples; empty if there is none
  const std::vector<Envelope>& cuts;  ///< one a level of alpha, rising
  std::size_t reachedTimes = 0;
};

class Settlement {
 public:
  /// All that is referred to must outlive it, and what is proved must stay.
  Settlement(const Proved& proved, const UncertainMotion& system, const ComparisonOptions& options);

  /// Gets what one comparison found, with the numbers of the samples, and the level of its cut; -1: the enclosure.
  using Take = std::function<void(const Comparison&, int level)>;

  /// Settles what is disputed of a block, outputs that nothing uncertain moves once for all blocks, the rest against
  /// the enclosure, then from the narrowest cut to the widest. Once a block has refuted one of them, no more samples go
  /// to the arbiter for its sake.
  void settle(SampleBlock& block, const Take& take);

  /// Those of all samples; NaN beyond what is reached, and where there are none.
  const Envelope& bounds() const { return bounds_; }
  /// What blocks have shown so far.
  void archive(Archive& all);

 private:
  void boundLevels(std::size_t cell, std::vector<double>& lower, std::vector<double>& upper) const;
  std::vector<std::size_t> leavers(SampleBlock& block) const;
  bool leaves(const SampleBlock& block, std::size_t sample, std::size_t cell, const Envelope& bounds) const;
  void settleOnce(SampleBlock& block, const std::vector<std::size_t>& disputed, const Take& take);
  void tellOf(const SampleBlock& block, std::size_t sample, std::size_t cell, const Take& take) const;
  void compareSome(const Envelope& bounds, int level, SampleBlock& block, const std::vector<std::size_t>& disputed,
                   const Take& take);

  Proved proved_;
  const UncertainMotion& system_;
  ComparisonOptions options_;
  Envelope bounds_;
  std::vector<char> refuted_;  // the enclosure, then each cut
  std::vector<char> moved_;    // of the outputs; empty until that is asked
  KnownOutputs known_;         // of those that are not, once one of them was disputed
};

}  // namespace gamut
