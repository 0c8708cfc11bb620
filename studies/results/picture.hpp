// The machine as a picture shows it: points, the parts between them, and where the points are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

/// Of the inertial frame.
struct DirectionInfo {
  std::string name;    ///< "x", "y", "z"
  double gravity = 0;  ///< acceleration of free fall along it, nominal, m/s²
};

struct PointInfo {
  std::string name;       ///< of the first frame, centre of mass or end of a spring there
  bool isFixed = false;   ///< no motion moves it
  bool isGround = false;  ///< the inertial frame carries it
};

/// In the order of Skeleton::Kind.
enum class PartKind : unsigned char {
  rigid,
  joint,
  mass,
  spring,
  shape,
  play,
  damper,
  wheel,
  motor,
  friction,
  gear,
  plane,
  profile
};
template <>
inline constexpr std::array<std::string_view, 13> words<PartKind>{"rigid", "joint",  "mass",   "spring", "shape",
                                                                  "play",  "damper", "wheel",  "motor",  "friction",
                                                                  "gear",  "plane",  "profile"};

/// Between two points, by index.
struct PartInfo {
  std::string name, type;  ///< as in the study
  PartKind kind = PartKind::rigid;
  std::uint64_t from = 0, to = 0;
  std::int64_t turns = 0, slides = 0;  ///< of a joint, or of what acts at one
  double mass = 0;                     ///< nominal, kg
  std::string told = {};               ///< unit in which people are told of it, as the study states it; empty: kg
  double radius = 0;  ///< of a shape, about the line between the points, of play or a wheel, nominal, m
  double ratio = 0;   ///< of a gear: by how much the joint that follows moves by the other, nominal
};

struct AxisInfo {
  std::string name;  ///< "hinge.axis"; of a wheel "rotor.axle", then "rotor.spoke"
  std::uint64_t part = 0;
};

/// A road, or the like, as it lies beneath a point.
struct ProfileInfo {
  std::string name;
  std::uint64_t part = 0;
  double reach = 0;             ///< to either side of the point, m
  std::vector<double> heights;  ///< above the point, [time][step], m; NaN where it has none
};

/// At some of the output times, all in the inertial frame, [time][point][direction] unless said otherwise, m. NaN where
/// a motion did not arrive or nothing is known.
struct Places {
  bool present = false;
  std::vector<double> time;
  std::vector<double> nominal;
  std::vector<double> axes;  ///< unit vectors in the nominal motion, [time][axis][direction]
  std::vector<std::int64_t> sample;
  std::vector<double> samples;       ///< [sample][time][point][direction]
  std::vector<double> lower, upper;  ///< of every point, at these times
  /// How far a point may be, since the time before, from the straight line between its places at both times.
  std::vector<double> sag;
  std::vector<double> step;  ///< where the heights of profiles are told: parts of their reach, from -1 to 1
};

/// Present where there is something to be seen; it is less than was asked for where places are not enclosed to the end.
struct PictureResult final : Part {
  std::vector<DirectionInfo> directions;
  std::vector<PointInfo> points;
  std::vector<PartInfo> parts;
  std::vector<AxisInfo> axes;
  Places places;
  std::vector<ProfileInfo> profiles;

  std::string title() const override { return "picture"; }
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
