// What is drawn of one output: layers over time, if need be relative to a middle and thinned so that a page stays
// small.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "reports/drawing/layer.hpp"

namespace gamut {

/// A stretch of time, s.
struct Span {
  double from = 0, until = 0;
};

/// All lines are as long as `time`.
struct Plot {
  std::string name, unit;
  std::vector<double> time;       ///< s
  std::vector<Layer> layers;      ///< from back to front
  std::vector<Layer> ratios;      ///< pure numbers, drawn below on an axis of their own
  std::vector<Span> missed = {};  ///< where a requirement may be violated, one behind the other

  /// Otherwise every layer has one number, and is drawn as a bar.
  bool isOverTime() const { return time.size() > 1; }
  /// The line around which narrow bands show their spread: the front-most line of the layers, else the middle of the
  /// front-most band; empty without either.
  Line middle() const;
  /// What that is: the line's words, or "the middle".
  std::string middleName() const;
  /// What is guaranteed, or else known best, is a hairline in the plot of the motion: its spread says more.
  bool isThin() const;
  /// Significant digits that show the widths of what stands in the spread.
  int digits() const;
};

/// The layers that have a meaning around the middle, minus it.
Plot aroundMiddle(const Plot& plot);

/// At most `points` times (at least 2). Drawn as straight lines between them, proved bands hold the full-resolution
/// ones: each kept bound is the outermost from the kept time before to the kept time after. Other bands keep their
/// extremes, and so do lines, at a time that is kept nearby.
Plot thinned(const Plot& plot, std::size_t points);

}  // namespace gamut
