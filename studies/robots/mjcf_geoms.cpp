#include "studies/robots/mjcf_geoms.hpp"

#include <algorithm>
#include <utility>

namespace gamut {
namespace {

constexpr std::pair<std::string_view, Solid::Form> solids[] = {{"sphere", Solid::Form::sphere},
                                                               {"capsule", Solid::Form::capsule},
                                                               {"cylinder", Solid::Form::cylinder},
                                                               {"ellipsoid", Solid::Form::ellipsoid},
                                                               {"box", Solid::Form::box}};

const auto* solidNamed(const std::string& type) {
  return std::ranges::find(solids, std::string_view(type), &std::pair<std::string_view, Solid::Form>::first);
}

}  // namespace

MjcfGeom::MjcfGeom(const MjcfAttributes& attributes, const MjcfAngles& angles)
    : attributes_(attributes),
      angles_(angles),
      type_(attributes.choice("type", "sphere",
                              {"plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"})),
      isSolid_(solidNamed(type_) != std::end(solids) && !attributes.has("mesh")) {}

bool MjcfGeom::isWeightless() const {
  if (type_ == "plane" || type_ == "hfield") return true;
  return isExactlyZero(attributes_.has("mass") ? attributes_.number("mass", 0.0) : attributes_.number("density", 1.0));
}

bool MjcfGeom::isInGroups(const std::pair<double, double>& groups) const {
  const double group = midpoint(attributes_.number("group", 0.0));
  return groups.first <= group && group <= groups.second;
}

bool MjcfGeom::touches() const {
  return !isExactlyZero(attributes_.number("contype", 1.0)) || !isExactlyZero(attributes_.number("conaffinity", 1.0));
}

MjcfGeom::Line MjcfGeom::line() const {
  const std::vector<Interval> n = attributes_.numbers("fromto", 6, 6);
  Line line;
  for (std::size_t i = 0; i < 3; ++i) {
    line.centre[i] = (n[i] + n[i + 3]) / Interval(2.0);
    line.along[i] = n[i] - n[i + 3];
  }
  if (!(squareOf(line.along).lower() > 0)) attributes_.fail("fromto", "the ends of a geom are one point", "two points");
  return line;
}

Solid MjcfGeom::solid() const {
  Solid solid;
  solid.form = solidNamed(type_)->second;
  const bool isRound = solid.form == Solid::Form::capsule || solid.form == Solid::Form::cylinder;
  const bool isSphere = solid.form == Solid::Form::sphere, isBetween = attributes_.has("fromto");
  const std::size_t least = isSphere || isBetween ? 1 : isRound ? 2 : 3;
  const std::vector<Interval> size = attributes_.numbers("size", least, 3);
  for (std::size_t i = 0; i < least; ++i)
    if (!(size[i].lower() > 0)) attributes_.fail("size", "a size of a geom is not positive", "sizes above 0 m");
  std::ranges::copy(size, solid.size.begin());
  if (!isBetween) return solid;
  if (isSphere) attributes_.fail("fromto", "a sphere has no two ends", "'pos'");
  if (!isRound) solid.size[1] = solid.size[0];
  solid.size[isRound ? 1 : 2] = sqrt(squareOf(line().along)) / Interval(2.0);
  return solid;
}

void MjcfGeom::addTo(Composed& body, std::vector<Robot::Place> frames) const {
  if (attributes_.flag("shellinertia", false))
    attributes_.fail("shellinertia", "the mass of a geom lies on its surface", "a solid, or an <inertial> of the body");
  const Solid solid = this->solid();
  const std::string what = "a geom";
  const Interval mass = attributes_.has("mass") ? attributes_.size("mass", 0.0, what)
                                                : attributes_.size("density", 1000.0, what) * volumeOf(solid);
  if (attributes_.has("fromto")) {
    const Line line = this->line();
    body.add(mass, solid, line.centre, line.along, frames);
  } else {
    frames.push_back(placeOf(attributes_, angles_));
    body.add(mass, solid, frames);
  }
}

std::optional<Robot::Shape> MjcfGeom::shape() const {
  const Solid solid = this->solid();
  if (solid.form == Solid::Form::ellipsoid) return std::nullopt;
  Robot::Shape shape;
  if (attributes_.has("fromto")) {
    const Line line = this->line();
    shape.place.xyz = line.centre;
    shape.place.turns = {turnOfZ(line.along)};
  } else {
    shape.place = placeOf(attributes_, angles_);
  }
  shape.kind = solid.form == Solid::Form::sphere    ? Robot::Shape::Kind::sphere
               : solid.form == Solid::Form::capsule ? Robot::Shape::Kind::capsule
               : solid.form == Solid::Form::box     ? Robot::Shape::Kind::box
                                                    : Robot::Shape::Kind::cylinder;
  for (std::size_t i = 0; i < 3; ++i) shape.size[i] = Interval(2.0) * solid.size[i];
  shape.radius = solid.size[0];
  shape.length = Interval(2.0) * solid.size[1];
  return shape;
}

}  // namespace gamut
