// Geoms of MJCF: what they weigh, and what they touch with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/robots/mjcf_attributes.hpp"
#include "studies/robots/mjcf_places.hpp"
#include "studies/robots/robot.hpp"
#include "studies/robots/solids.hpp"

namespace gamut {

class MjcfGeom {
 public:
  /// Throws StudyError.
  MjcfGeom(const MjcfAttributes& attributes, const MjcfAngles& angles);

  const std::string& type() const { return type_; }
  /// A sphere, a capsule, a cylinder, an ellipsoid or a box.
  bool isSolid() const { return isSolid_; }
  bool isWeightless() const;
  /// Of those within this range.
  bool isInGroups(const std::pair<double, double>& groups) const;
  bool touches() const;

  /// `frames`: places of the frames in which it stands, from the body inwards. Throws StudyError.
  void addTo(Composed& body, std::vector<Robot::Place> frames) const;
  /// Of a solid; none of an ellipsoid. Throws StudyError.
  std::optional<Robot::Shape> shape() const;

 private:
  struct Line {
    std::array<Interval, 3> centre, along;
  };
  /// Of a geom between two points.
  Line line() const;
  Solid solid() const;

  const MjcfAttributes& attributes_;
  const MjcfAngles& angles_;
  std::string type_;
  bool isSolid_;
};

}  // namespace gamut
