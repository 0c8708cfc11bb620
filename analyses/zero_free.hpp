// Up to when values are above zero, as those on which a motion that is given goes on: proved by intervals on parts of
// time and box, plain ones and the mean value form.
#pragma once

#include <atomic>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

struct ZeroFree {
  enum class End : unsigned char {
    horizon,   ///< all are above zero, to the end
    zero,      ///< output `first` is proved to be zero, for some values, by the time `zeroBy`
    open,      ///< as closely as it looked one may be or not
    cancelled  ///< it was told to stop
  };
  double until = -1;  ///< s: at all times from 0 to here, both included; negative: not even at the start
  int first = -1;     ///< the output that is not known to be above zero behind; -1: all are, to the end
  End end = End::open;
  double zeroBy = -1;  ///< s
};

/// Of all outputs y = g(t, x, p) at once, over a box (states, then parameters) and the times from 0 to `horizon` [s].
/// An output may have no value where another one is zero or less; where there is none for another reason nothing is
/// said, and no zero is seen in that. The more parts it takes, the closer; it halves a thousand. What is known until
/// then, once `cancelled` was set.
ZeroFree zeroFree(const Program& g, const Box& box, double horizon, const std::atomic<bool>* cancelled = nullptr);

}  // namespace gamut
