// Probability and possibility of one quantity: either made from the other, and whether they agree.
#pragma once

#include "analyses/uncertainty.hpp"

namespace gamut {

/// A membership function that is 1 at `centre` (in the support), with no event less possible than probable (D. Dubois,
/// L. Foulloy, G. Mauris, H. Prade, Reliable Computing 10, 2004): a cut at α leaves out a probability of α at most, of
/// which each side of the centre has its share. By straight lines between 256 levels, so that it is greater by 1/256 at
/// most than the least such one where no value has a probability of its own.
Membership membershipOf(const Distribution& distribution, double centre);

/// A distribution with no event more probable than possible, but for 2^-40 (D. Dubois, H. Prade, S. Sandri, in: Fuzzy
/// Logic, 1993): evenly distributed over a cut at a level that is itself evenly distributed; some 300 levels.
Distribution distributionOf(const Membership& membership);

/// By how much the probability of an event exceeds its possibility at most: a bound on the greatest
/// 1 - α - P(cut at α), 1/256 above it at most where F is known well
/// and no value has a probability of its own.
double inconsistency(const Distribution& distribution, const Membership& membership);

}  // namespace gamut
