#include "analyses/samples/named_corners.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace gamut {
namespace {

/// Times spread over all, the more the farther one goes: the last, the middle, the quarters, ...
std::vector<std::size_t> spreadRows(std::size_t times) {
  constexpr std::size_t most = 64;
  std::vector<std::size_t> rows{times - 1};
  for (std::size_t parts = 2; parts <= most; parts *= 2)
    for (std::size_t i = 1; i < parts; i += 2)
      if (const std::size_t row = i * (times - 1) / parts; std::ranges::find(rows, row) == rows.end())
        rows.push_back(row);
  return rows;
}

}  // namespace

std::vector<std::vector<double>> axisPoints(const Box& range, const std::vector<double>& nominal) {
  std::vector<std::vector<double>> points;
  for (std::size_t q = 0; q < range.size(); ++q)
    for (const double end : {range[q].lower(), range[q].upper()}) {
      points.push_back(nominal);
      points.back()[q] = end;
    }
  return points;
}

TransformationPoints namedCorners(const SampleBlock& alongAxes, const std::vector<Box>& boxes, std::size_t times,
                                  std::size_t outputs) {
  constexpr double noise = 1e-9;  // beside the output: what hardly depends on anything names no corner
  TransformationPoints points;
  const std::size_t quantities = alongAxes.size() / 2;
  if (boxes.empty() || quantities == 0) return points;
  std::set<std::vector<char>> known;
  for (const std::size_t row : spreadRows(times))
    for (std::size_t output = 0; output < outputs; ++output) {
      std::vector<char> isUpper;
      double greatest = 0, size = 0;
      for (std::size_t q = 0; q < quantities; ++q) {
        const double low = alongAxes(2 * q, row, output), high = alongAxes(2 * q + 1, row, output);
        if (!std::isfinite(high - low)) greatest = std::nan("");
        greatest = std::isnan(greatest) ? greatest : std::max(greatest, std::fabs(high - low));
        size = std::max(size, std::fabs(low));
        isUpper.push_back(high >= low ? 1 : 0);
      }
      if (!(greatest > noise * size)) continue;
      for (int side = 0; side < 2; ++side) {
        if ((known.size() + 1) * boxes.size() > mostNamedCorners) return points;
        for (char& upper : isUpper) upper = upper == 0 ? 1 : 0;
        if (!known.insert(isUpper).second) continue;
        for (const Box& box : boxes) {
          std::vector<std::vector<double>> corner;
          for (std::size_t q = 0; q < quantities; ++q)
            corner.push_back({isUpper[q] != 0 ? box[q].upper() : box[q].lower()});
          points.add(std::move(corner), {}, 0);
        }
      }
    }
  return points;
}

}  // namespace gamut
