// What one output's figures draw, taken out of the results: bands and lines over time, if need be relative to a
// reference and thinned so that a page stays small, with guaranteed bands still outside what they replace.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

/// Lower and upper line of one band, a number a time; empty where an analysis is absent.
struct Band {
  std::vector<double> lower, upper;
  bool empty() const { return lower.empty(); }
};

/// One output's curves. All lines are as long as `time`; NaN where there is nothing.
struct Curves {
  std::string name, unit;
  std::vector<double> time;              ///< s
  Band tube;                             ///< guaranteed at every instant, between the times too
  Band guaranteed;                       ///< at the output times
  Band direct;                           ///< kinematics: by plain intervals
  Band sampled;                          ///< least and greatest sample
  Band probable;                         ///< between two quantiles
  double lowest = 0.05, highest = 0.95;  ///< their probabilities
  std::vector<double> median;
  std::vector<double> alpha;   ///< of the alpha-cuts, ascending as stored
  std::vector<Band> possible;  ///< one band a level
  std::vector<double> overestimation;
  int digits = 8;  ///< significant digits that show the bands' widths
};

/// All curves of one output at full resolution.
Curves curvesOf(const Results& results, std::size_t output);

/// The same, minus a reference line (the median, else the middle of a band), so that narrow bands show; without tube,
/// whose rows span times in which the reference moves.
Curves aroundReference(Curves curves);

/// At most `points` times (at least 2). Drawn as straight lines between them, guaranteed and possible bands hold the
/// full-resolution ones: each kept bound is the outermost from the kept time before to the kept time after.
Curves thinned(const Curves& curves, std::size_t points);

}  // namespace gamut
