// The picture of a machine as data: its elements, and where all points are at each time. What an element looks like
// from somewhere at some time is found alike here, for paper, and by reports/page/scene.js as the picture moves;
// tests/reports/page/vectors.json holds both to the same texts.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/drawing/view.hpp"

namespace gamut {

/// One element of the drawing.
struct Shape {
  enum class Form {
    line,     ///< between two points
    zigzag,   ///< the same, as a spring,
    dashpot,  ///< or as a damper, both beside the line by `size`
    circle,   ///< these at the second point: about it,
    name,     ///< beside it,
    sign,     ///< a drawing that does not turn,
    pin,      ///< along an axis, which stands for the first point
    wheel,    ///< about an axis, with a spoke along the axis behind it, of the radius `size`
    belt,     ///< about wheels at both points, of the radii `size` and `other`, the first about `axis`
    plane,    ///< through the first point, across `axis`: what lies beneath the second of it, `size` to either side
    road,     ///< the profile `from` beneath the second point, `size` to either side; up is `axis`, then comes ahead
    sample,   ///< all links of a sample
    now,      ///< the boxes of all moving points
    swept,    ///< what these sweep
    arrow,    ///< of a direction
    letter    ///< at its end
  };

  Form form = Form::line;
  std::size_t from = 0, to = 0;  ///< two points; or the axis, the sample, the direction or the profile
  double size = 0;               ///< in units of the paper, to a tenth

  // Only on paper.
  std::string look = {};     ///< attributes that stay
  std::string content = {};  ///< of the element
  std::string layer = {};    ///< the entry of the key that shows and hides it

  std::size_t axis = 0;
  double other = 0;  ///< as `size`
};

/// Places are [row][point][direction], from the middle of the paper, whole numbers of a unit so small that nobody sees
/// it; NaN where unknown.
struct Scene {
  static constexpr double unit = 0.02;  ///< of the paper's
  View view;
  std::size_t points = 0;
  std::vector<double> time;
  std::vector<Shape> shapes;                               ///< from back to front
  std::vector<std::pair<std::size_t, std::size_t>> links;  ///< that a sample is drawn by
  std::vector<std::size_t> moving;                         ///< points whose enclosures may be seen
  bool isDense = false;                                    ///< joints are drawn small, on paper and on the screen
  double magnification = 1;                                ///< how many times as large motions are drawn
  std::vector<double> nominal, axes;
  std::vector<double> samples;             ///< row after row of sample after sample
  std::vector<double> lower, upper, sag;   ///< rounded outward
  std::vector<std::vector<double>> roads;  ///< heights above the point, [row][step], steps evenly from behind to ahead

  Place at(const std::vector<double>& places, std::size_t row, std::size_t k) const {
    return placeOf(places, row, points, k);
  }
};

/// A time and from where the scene is looked at.
struct Stance {
  std::size_t row = 0;
  Place right{}, up{};
};

/// What moves of an element; empty where it is not seen.
std::vector<std::pair<std::string_view, std::string>> attributesOf(const Scene& scene, const Shape& shape,
                                                                   const Stance& stance);

/// The place on paper; NaN where unknown.
Sight sightOf(const Scene& scene, const Place& place, const Stance& stance);

/// The path around the least convex polygon that holds all of these.
std::string hullPath(std::vector<Sight> sights);

/// For the script, as JSON.
std::string sceneData(const Scene& scene);

}  // namespace gamut
