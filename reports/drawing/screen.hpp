// The numbers that a page's interactive plots draw, as JSON inside the page: whole numbers and their differences, so
// that pages stay small.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/drawing/plot.hpp"

namespace gamut {

/// More times than this are thinned, see `thinned`, unless somebody asks for fewer.
inline constexpr std::size_t plottedTimes = 2000;

/// Decimal fractions as whole numbers: a number is whole * 10^scale, rounded once.
class Decimals {
 public:
  explicit Decimals(int scale);
  double value(double whole) const;
  double below(double x) const;  ///< the greatest whole number whose value is not above x
  double above(double x) const;
  double nearest(double x) const;

 private:
  int scale_;
  double power_;  ///< 10^|scale|
};

/// As JSON, which knows no infinity: what is not finite is null.
std::string numberList(const std::vector<double>& numbers, int digits);
std::string jsonList(const std::vector<std::string>& texts);

/// A list of whole numbers by second differences, null where there is none: with value a and slope d, both 0 at first,
/// the first number c that is not null gives a = c, each later one d += c, a += d.
std::string secondDifferences(const std::vector<double>& wholes);

/// {"time": [..]}: of all plots with the same times.
std::string timeData(const Plot& plot, std::size_t times = plottedTimes);

/// {"name", "unit", "middleName", "thin", "scale", "middle": line, "layers": [layer, ..], "around": [layer, ..],
/// "ratios": [layer, ..], "missed": [[from, until], ..]} in s, a layer {"name", "words", "kind": "band" | "line" |
/// "stack", "readout", "filled", "width", "dashed", "spread", "labels", "levels", "bands": [[lower, upper], ..]}, of a
/// line [[values]]. All lines are second differences of whole numbers * 10^scale; those of layers are counted from the
/// middle. Bounds are rounded outward; null where there is no number. "around", counted from the middle itself, is
/// there where times were left out: the spread is then more than the difference of lines. Ratios are plain numbers.
/// Safe inside a <script> element.
std::string plotData(const Plot& plot, std::size_t times = plottedTimes);

}  // namespace gamut
