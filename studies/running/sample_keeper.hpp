// Samples that are kept one by one, out of the many that go by: as many as a stated amount of storage holds.
#pragma once

#include <cstddef>

#include "analyses/samples/sample_block.hpp"
#include "studies/results/stochastic.hpp"

namespace gamut {

class Archive;

class SampleKeeper {
 public:
  /// Of `samples` numbers, the last of which is the centre, with so many uncertain quantities and so many numbers in a
  /// motion. Values take half of `storage` (bytes) at most: of all samples, or of every so manyth; motions take what is
  /// left, and are of samples whose values are kept. The centre, the nominal motion, is kept with each of them.
  SampleKeeper(std::size_t samples, std::size_t quantities, std::size_t cells, double storage);

  /// Keeps what is to be kept of a block. Blocks may come in any order in which the numbers of samples with weight
  /// rise, and those of samples without.
  void keep(SampleBlock& block);

  /// All that was kept, by rising number.
  KeptSamples take();
  void archive(Archive& all);

 private:
  std::size_t centre_;
  KeptSamples samples_, beside_;  // of the plan; corners and centre
};

}  // namespace gamut
