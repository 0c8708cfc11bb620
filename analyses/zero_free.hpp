// Up to when values are above zero, as those on which a motion that is given goes on: proved by plain intervals on
// parts of time and box.
#pragma once

#include <atomic>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

struct ZeroFree {
  double until = -1;  ///< s: at all times from 0 to here, both included; negative: not even at the start
  int first = -1;     ///< the output that may not be above zero behind; -1: all are, to the end
};

/// Of all outputs y = g(t, x, p) at once, over a box (states, then parameters) and the times from 0 to `horizon` [s].
/// An output may have no value where another one is zero or less, and nowhere else. The more parts it takes, the
/// closer; it halves a thousand. What is known until then, once `cancelled` was set.
ZeroFree zeroFree(const Program& g, const Box& box, double horizon, const std::atomic<bool>* cancelled = nullptr);

}  // namespace gamut
