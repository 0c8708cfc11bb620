// Outputs that nothing uncertain moves: what they are of one sample they are of all, so that it is settled once.
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

#include "analyses/samples/ensemble.hpp"

namespace gamut {

/// One an output: whether it may depend on the uncertain quantities, by itself or by what they do to the states.
std::vector<char> movedOutputs(const UncertainMotion& system);

/// What is known of outputs for all samples at once.
struct KnownOutputs {
  std::size_t outputs = 0;
  std::vector<double> values;    ///< [time][output]; NaN where nothing is known, or beyond all
  std::vector<double> error;     ///< likewise
  std::vector<double> rounding;  ///< likewise, PreciseTrajectory::rounding

  bool holds(std::size_t cell) const { return cell < values.size() && !std::isnan(values[cell]); }
};

/// Those that are not `moved`, by the arbiter's series in 128 bits, at the first `times` output times. They do not
/// depend on the uncertain values, so any will do: the nominal ones. Empty if it was cancelled.
KnownOutputs settleUnmoved(const UncertainMotion& system, const std::vector<char>& moved, std::size_t times,
                           const std::atomic<bool>* cancelled);

}  // namespace gamut
