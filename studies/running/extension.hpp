// More samples for results that are there already: what was proved stays as it is, and is not computed again.
#pragma once

#include <cstddef>
#include <cstdint>

#include "studies/results/results.hpp"
#include "studies/running/run.hpp"

namespace gamut {

struct Extension {
  Results results;
  bool isMore = false;               ///< at least as many samples were followed as before; otherwise it was ended early
  std::size_t met = 0, changed = 0;  ///< kept motions that came again, and those that are not the same bit for bit
};

/// The results `former` with `options.samples` samples in all, the former among them, by plan, seed and number.
/// Statistics need every sample, so these are integrated again too. Limits are those of the extension alone; seeds and
/// time of a sample those of the results. `machine` is that of the results. Throws std::invalid_argument, saying why,
/// where results hold no samples or as many already, by plans that put the first of more samples elsewhere, and for
/// samples that would be others: another version has read the study otherwise, or moves it so. Goes on and is shared
/// out as a run is (RunOptions::checkpoints, communicator).
Extension extend(const Machine& machine, const Results& former, const RunOptions& options);

/// Of all that they hold: whether two are the same.
std::uint64_t digestOf(const Results& results);

}  // namespace gamut
