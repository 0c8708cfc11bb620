// The arbiter decides where a sample lies when CVODE's doubles cannot: it integrates the recorded Program by Taylor
// series in 128-bit arithmetic (MPFR), twice, and says how far the two results differ. Starting values and constants
// are the very doubles that the sample's CVODE run used. The equations are checked at sixteen points of each of at
// least thirty-two steps and in every cell of time (TimeCells), since a series may say nothing of what comes; a narrow
// change that hangs on the states may be missed by both. Kinks and jumps (abs, sign) end a step where one of these
// points shows that they were passed; where a motion is held at a jump, the equations are those that hold it.
// Step size from the last coefficients: À. Jorba & M. Zou, Experimental Mathematics 14 (2005), section 3.2.
#pragma once

#include <atomic>
#include <boost/multiprecision/mpfr.hpp>
#include <span>
#include <string>
#include <vector>

#include "analyses/samples/witness.hpp"
#include "scalars/traits.hpp"

namespace gamut {

/// A floating-point number of 128 bits.
using Precise =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<38, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

template <>
struct ScalarTraits<Precise> {
  static Precise constant(const Interval& enclosure) { return Precise(midpoint(enclosure)); }
};

struct ArbiterOptions {
  int order = 30;            ///< of the Taylor series (at least 8)
  double tolerance = 1e-34;  ///< of a step's truncation, relative to the greatest state
};

/// What the arbiter found: row by row one output time, one column an output.
struct PreciseTrajectory {
  std::size_t times = 0;         ///< number of output times reached
  double reached = 0;            ///< s
  std::string why;               ///< why it ended early; empty if it did not
  std::vector<Precise> values;   ///< of the reached times
  std::vector<double> error;     ///< difference from a second integration with another order and a looser tolerance,
                                 ///< and an allowance for rounding
  std::vector<double> rounding;  ///< of that what evaluating outputs makes of its roundings, and of those of states
};

/// Before it is asked: the same series once, in doubles, of order 24. Row by row one output time, one column an output;
/// NaN from where it ends early. Where a motion decays, its errors decay with it, unlike those of an absolute
/// tolerance. `rounding`: as of PreciseTrajectory, if it is asked for. Throws as `arbitrate`.
std::vector<double> integrateByTaylor(const Motion& motion, std::span<const double> start,
                                      const std::atomic<bool>* cancelled = nullptr,
                                      std::vector<double>* rounding = nullptr);

/// The values as the nearest doubles, filled up with NaN to `count`.
std::vector<double> roundedToDoubles(const PreciseTrajectory& trajectory, std::size_t count);

/// Integrates `motion` from `start` (the initial values, then the parameters).
/// Throws std::invalid_argument if sizes or options make no sense.
PreciseTrajectory arbitrate(const Motion& motion, std::span<const double> start, const ArbiterOptions& options = {},
                            const std::atomic<bool>* cancelled = nullptr);

}  // namespace gamut
