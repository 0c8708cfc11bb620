// The numbers that a page's interactive plots draw, as JSON inside the page.
#pragma once

#include <cstddef>
#include <string>

#include "reports/drawing/plot.hpp"

namespace gamut {

/// More times than this are thinned, see `thinned`.
inline constexpr std::size_t plottedTimes = 2000;

class PlotData {
 public:
  void add(const Plot& plot);

  /// {"time": [..], "outputs": [{"name", "unit", "middleName", "middle": [..], "layers": [layer, ..], "ratios": [layer,
  /// ..]}, ..]}, a layer {"name", "kind": "band" | "line" | "stack", "readout", "filled", "width", "dashed", "spread",
  /// "bands": [[lower, upper], ..]}, of a line [[values]]. Bounds' decimals are rounded outward; null where there is no
  /// number. Safe inside a <script> element.
  std::string json() const;

 private:
  std::string time_ = "[]", outputs_;
};

}  // namespace gamut
