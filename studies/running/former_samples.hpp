// Samples that results hold already, when they come again among more of them: they must be the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "analyses/samples/sample_block.hpp"
#include "analyses/table.hpp"
#include "scalars/archive.hpp"
#include "studies/results/comparison.hpp"
#include "studies/results/results.hpp"

namespace gamut {

class FormerSamples {
 public:
  /// Those of `results`, when the plan has `samples` samples.
  FormerSamples(const Results& results, std::size_t samples);

  /// Looks at those of a block whose motions are kept, once what was disputed of it is settled: bit for bit they are
  /// the same, but those that were settled, then or now, and those that share their pack's steps with other samples
  /// now. Throws std::invalid_argument, of ranks on all of them, for one that is farther from the former than errors of
  /// integration explain.
  void meet(const SampleBlock& block, const std::vector<DisputedSample>& disputed);

  std::size_t met() const { return met_; }          ///< motions that had to be the same
  std::size_t changed() const { return changed_; }  ///< of these, are not
  /// What it has met.
  void archive(Archive& all) { all(met_, changed_); }

 private:
  struct Met {
    std::size_t met = 0, changed = 0;
    std::string fault;
  };

  bool hasSamePack(std::size_t number) const;
  void meet(const SampleBlock& block, std::size_t i, const std::vector<DisputedSample>& disputed, Met& met) const;

  std::size_t before_, samples_, packWidth_;  // of the plan, then and now
  KeptSamples kept_;
  Table error_;
  std::set<std::int64_t> settled_;
  std::size_t met_ = 0, changed_ = 0;
};

}  // namespace gamut
