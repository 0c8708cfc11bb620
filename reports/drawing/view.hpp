// From where a machine is looked at, and how large it is drawn: places in space to places on the paper.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "studies/results/picture.hpp"

namespace gamut {

using Place = std::array<double, 3>;

inline double dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double norm(const Place& a) { return std::hypot(a[0], a[1], a[2]); }

/// The place of point k in row i of [time][point][direction]; NaN where it is unknown.
Place placeOf(const std::vector<double>& places, std::size_t row, std::size_t points, std::size_t k);
/// Whether it is there, and as near as a machine can be.
bool isKnown(const Place& place);

struct Sight {
  double x = 0, y = 0;
};

/// A parallel projection onto the plane of two unit vectors.
struct View {
  Place right{0, 1, 0}, up{0, 0, 1};
  Place vertical{0, 0, 1};  ///< against gravity, or z
  Place centre{0, 0, 0};    ///< in the middle of the paper, m
  double scale = 1;         ///< of the paper's units per m
  double width = 0, height = 0;
  bool isSideView = false;  ///< the machine moves in the plane that is seen
  double size = 0;          ///< of the machine: the greatest extent on paper, m
};

/// Onto the plane in which all points move, if there is one, with up against gravity where that lies in it; otherwise
/// from above and aside. All that is shown of the nominal motion and the samples fits in; enclosures as far as they are
/// not much wider.
View viewOf(const PictureResult& machine);

}  // namespace gamut
