// What an output does over the whole motion: its least and its greatest, and when.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "studies/results/results.hpp"

namespace gamut {

/// A bound, and where it comes from: an output time, or what lies between two of them.
struct MotionExtreme {
  double value = std::numeric_limits<double>::quiet_NaN();
  double from = 0, until = 0;  ///< s
};

/// Of the times at which something is known.
struct MotionRange {
  enum class Source { ofProof, ofSamples, ofCuts };

  Source source = Source::ofProof;
  bool isBetween = false;     ///< of all instants, not of the output times alone
  bool isAtAllTimes = false;  ///< of all of the study's output times
  double until = 0;           ///< s: the last time
  MotionExtreme least, greatest;
  double width = 0;         ///< of what is known at an output time, at most
  double widthAtTimes = 0;  ///< from the least to the greatest that is known at output times

  /// The greatest number.
  double size() const { return std::max(std::abs(least.value), std::abs(greatest.value)); }
};

/// What is guaranteed (at every instant), what samples did, or what is held possible; nothing where nothing finite is
/// known.
std::optional<MotionRange> motionRange(const Results& results, std::size_t output, MotionRange::Source source);

/// The first of these of which something is known.
std::optional<MotionRange> bestMotionRange(const Results& results, std::size_t output);

/// The greatest number of an output over the whole motion, as far as it is known; else 0.
double motionSize(const Results& results, std::size_t output);

/// Whether the enclosure of an output is at this output time (s) as good as a number, which nothing uncertain moves.
bool isOneValue(const Results& results, double time, std::size_t output);

/// Of what a table of them all is: "guaranteed from 0 s to 3 s", "sampled at the output times".
std::string rangesCaption(const Results& results);

/// "at 0.3 s", "between 0.3 s and 0.4 s", "throughout"; empty where no time passes.
std::string whenText(const Results& results, const MotionExtreme& extreme);

/// The same of the least and the greatest; empty too of one that is beyond zero by roundings, which chose its time.
std::string whenLeast(const Results& results, const MotionRange& range);
std::string whenGreatest(const Results& results, const MotionRange& range);

}  // namespace gamut
