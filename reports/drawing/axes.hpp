// The frame of a drawing: where numbers lie on the paper, and axes with round ticks.
#pragma once

#include <string>
#include <string_view>

#include "reports/drawing/layer.hpp"

namespace gamut {

/// Units of a drawing's paper: its width, and what its axes take on each side.
constexpr double paperWidth = 720, marginLeft = 66, marginRight = 10, marginTop = 20, marginBottom = 34;

/// Least and greatest finite number seen.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void hold(double x);
  void hold(const Line& line);
  void hold(const Band& band);
  /// With room around it, and never without width.
  Range padded(double share) const;
};

/// Where numbers lie on paper of this height.
struct Frame {
  Range x, y;
  double height = 0;

  double across(double value) const {
    return marginLeft + (value - x.low) / (x.high - x.low) * (paperWidth - marginLeft - marginRight);
  }
  double down(double value) const {
    return height - marginBottom - (value - y.low) / (y.high - y.low) * (height - marginTop - marginBottom);
  }
};

/// Infinite bounds end at the frame's edge; NaN stays NaN.
double clipped(double value, const Range& range);

/// The element that holds a drawing, to be closed with "</svg>".
std::string openedDrawing(double height, const std::string& label);

/// About `wanted` ticks with their lines.
void drawHorizontalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg);
void drawVerticalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg);

/// A text whose class is `kind`.
void drawText(std::string_view kind, double x, double y, const std::string& text, std::string& svg);

}  // namespace gamut
