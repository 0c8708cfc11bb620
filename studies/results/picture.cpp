// What the file says of the machine.
#include "studies/results/picture.hpp"

#include <algorithm>

namespace gamut {
namespace {

namespace scale {
constexpr std::string_view direction = "/machine/directions/direction", point = "/machine/points/point",
                           part = "/machine/parts/part", axis = "/machine/axes/axis", time = "/machine/places/time",
                           sample = "/machine/places/sample", step = "/machine/places/step",
                           profile = "/machine/profiles/profile";
}

std::vector<Field> fieldsOf(PictureResult& m) { return m.fieldsAnd({}); }

std::vector<Field> fieldsOfDirection(DirectionInfo& d) {
  return {{"direction", &d.name, unit::none, "of the inertial frame"},
          {"gravity", &d.gravity, "m/s^2", "acceleration of free fall along it, nominal", allowed::finite}};
}

std::vector<Field> fieldsOfPoint(PointInfo& p) {
  return {{"point", &p.name, unit::none, "name of the first frame, centre of mass or end of a spring there"},
          {"fixed", &p.isFixed, unit::none, "1 if no motion moves it"},
          {"ground", &p.isGround, unit::none, "1 if the inertial frame carries it"}};
}

std::vector<Field> fieldsOfPart(PartInfo& p) {
  return {
      {"part", &p.name, unit::none, "name of the element"},
      {"type", &p.type, unit::none, "its type in the study"},
      {"kind", Choice::of(p.kind), unit::none,
       "\"rigid\", \"joint\", \"mass\" (from a frame to its centre), \"spring\", \"shape\", \"play\", \"damper\", "
       "\"wheel\", \"motor\", \"friction\", \"gear\" (between two joints), \"plane\" (through its first point, beneath "
       "its "
       "second) or \"profile\" (beneath its second point)"},
      {"from", &p.from, unit::none, "index of the point where it begins", allowed::count, scale::point},
      {"to", &p.to, unit::none, "index of the point where it ends", allowed::count, scale::point},
      {"turns", &p.turns, unit::none, "of a joint, or of what acts at one: in how many ways it turns", allowed::count},
      {"slides", &p.slides, unit::none, "of a joint, or of what acts at one: in how many ways it slides",
       allowed::count},
      {"mass", &p.mass, "kg", "nominal mass", allowed::finite},
      fresh({"told", &p.told, unit::none, "unit in which the page tells the mass, as the study states it; empty: kg"}),
      fresh({"radius", &p.radius, "m",
             "of a shape, about the line between its points, of play, to either side, or of a wheel, nominal",
             allowed::finite}),
      fresh({"ratio", &p.ratio, unit::none,
             "of a gear: by how much the joint that follows turns [rad], or slides [m], by the other, nominal",
             allowed::finite})};
}

std::vector<Field> fieldsOfAxis(AxisInfo& a) {
  return {{"axis", &a.name, unit::none, "name of a joint's axis, of a wheel's axle or spoke, or of another direction"},
          {"joint", &a.part, unit::none, "index of the part", allowed::count, scale::part}};
}

std::vector<Field> fieldsOfPlaces(Places& p) {
  using namespace scale;
  const auto places = [](std::string_view name, std::vector<double>& values, std::string_view meaning) {
    return noise({name, &values, "m", meaning, {time, point, direction}});
  };
  return {
      {"time", &p.time, unit::second, "output times that are shown", {time}},
      places("nominal", p.nominal, "in the nominal motion; NaN where it did not arrive"),
      {"axes", &p.axes, unit::one, "unit vectors of the axes in the nominal motion", {time, axis, direction}},
      {"sample", &p.sample, unit::none, "numbers of the samples that are shown", {sample}, allowed::count},
      noise({"samples",
             &p.samples,
             "m",
             "in these samples' motions; NaN where one did not arrive",
             {sample, time, point, direction}}),
      places("lower", p.lower, "enclosure at these times, lower bound; NaN where there is none"),
      places("upper", p.upper, "enclosure at these times, upper bound"),
      places("sag", p.sag,
             "how far a point may be, since the time before, from the straight line between its places at both times"),
      {"step", &p.step, unit::one, "where the heights of profiles are told: parts of their reach", {step}}};
}

std::vector<Field> fieldsOfProfile(ProfileInfo& p) {
  return {{"profile", &p.name, unit::none, "name of the element"},
          {"part", &p.part, unit::none, "index of the part", allowed::count, scale::part},
          {"reach", &p.reach, "m", "to either side of the point", allowed::finite},
          noise({"heights",
                 &p.heights,
                 "m",
                 "above the point at that time, nominal; NaN where the profile has none",
                 {scale::time, scale::step}})};
}

}  // namespace

void PictureResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/machine", "the machine as the report draws it", *this, fieldsOf));
  groups.push_back(
      listOf("/machine/directions", "in which places are measured", scale::direction, directions, fieldsOfDirection));
  groups.push_back(listOf("/machine/points", "what has a place of its own", scale::point, points, fieldsOfPoint));
  groups.push_back(listOf("/machine/parts", "elements between two points", scale::part, parts, fieldsOfPart));
  groups.push_back(
      listOf("/machine/axes", "of joints, wheels and what else has a direction", scale::axis, axes, fieldsOfAxis));
  groups.push_back(groupOf("/machine/places",
                           "where the points are, in the inertial frame, at some of the output times", places,
                           fieldsOfPlaces));
  groups.back().makesSense = [this](std::size_t) {
    const std::vector<double>&lower = places.lower, &upper = places.upper;
    for (std::size_t i = 0; i < std::min(lower.size(), upper.size()); ++i)
      if (!isInterval(lower[i], upper[i])) return false;
    return lower.size() == upper.size();
  };
  groups.push_back(listOf("/machine/profiles", "roads and the like, as they lie beneath points", scale::profile,
                          profiles, fieldsOfProfile));
}

}  // namespace gamut
