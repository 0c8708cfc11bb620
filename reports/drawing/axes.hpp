// The frame of a drawing: where numbers lie on the paper, and axes with round ticks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/drawing/layer.hpp"

namespace gamut {

/// Units of a drawing's paper: its width, and what its axes take on each side.
constexpr double paperWidth = 720, marginLeft = 66, marginRight = 10, marginTop = 20, marginBottom = 34;
/// The paper of drawings that stand side by side.
constexpr double smallWidth = 440, smallHeight = 230;

/// Least and greatest number seen that has a place in a drawing.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void hold(double x);
  void hold(const Line& line);
  void hold(const Band& band);
  /// With room around it, finite, and never without width.
  Range padded(double share) const;
};

/// Round numbers on an axis, all with the same decimals: any two differ as they are written. Where that would take too
/// many digits, `aside` says what they are counted from, or in which power of ten.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> text;
  std::string aside;  ///< "× 10⁻⁹", "1.234567 + …"; empty where the texts are the numbers
};

/// About `wanted` of them. The screen finds ticks, names and rooms of what is zoomed to alike (reports/page/axes.js):
/// tests/reports/page/vectors.json holds both to it.
Ticks ticksOf(const Range& range, int wanted);
/// "rad", "rad, × 10⁻⁹".
std::string axisName(const std::string& name, const Ticks& ticks);

/// Where numbers lie on paper of this size.
struct Frame {
  Range x, y;
  double height = 0;
  double width = paperWidth;

  double across(double value) const {
    return marginLeft + (value - x.low) / (x.high - x.low) * (width - marginLeft - marginRight);
  }
  double down(double value) const {
    return height - marginBottom - (value - y.low) / (y.high - y.low) * (height - marginTop - marginBottom);
  }
};

/// Infinite bounds end at the frame's edge; NaN stays NaN.
double clipped(double value, const Range& range);

/// The element that holds a drawing, to be closed with "</svg>".
std::string openedDrawing(double height, const std::string& label, double width = paperWidth);

/// About `wanted` ticks with their lines.
void drawHorizontalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg);
void drawVerticalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg);

/// The path that joins points, in tenths of a unit: the first as it is, all others from the one before, so that pages
/// stay small.
class Pen {
 public:
  /// A line to this point, or the beginning of a line. Where a coordinate is NaN the line ends.
  void go(double x, double y);
  /// The next point begins a line of its own.
  void lift() { isDown_ = false; }
  /// A line of its own.
  void stroke(double fromX, double fromY, double toX, double toY);
  /// Closes what was begun, if anything was.
  void close();
  bool isEmpty() const { return path_.empty(); }
  std::string take();

 private:
  std::string path_;
  bool isDown_ = false;
  long long x_ = 0, y_ = 0;
};

/// What the pen holds, if anything, as a path whose class is `kind`.
void drawPath(std::string_view kind, Pen& pen, std::string& svg);

/// A text whose class is `kind`.
void drawText(std::string_view kind, double x, double y, const std::string& text, std::string& svg);

}  // namespace gamut
