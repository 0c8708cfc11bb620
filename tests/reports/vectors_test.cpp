// What paper and screen both compute comes out alike: page/vectors.json, which the tests of the page's scripts read
// too.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "reports/drawing/axes.hpp"
#include "reports/drawing/picture.hpp"
#include "reports/drawing/screen.hpp"
#include "tests/reports/example_results.hpp"

namespace gamut {
namespace {

using nlohmann::json;

json vectors(const char* of) {
  std::ifstream file(GAMUT_SOURCE_DIR "/tests/reports/page/vectors.json");
  return json::parse(file).at(of);
}

TEST(Vectors, TicksOfPaperAreThoseOfTheScreen) {
  for (const json& v : vectors("ticks")) {
    const Ticks ticks = ticksOf({v["low"], v["high"]}, v["wanted"]);
    EXPECT_EQ(v["at"], json(ticks.at)) << v["low"] << " to " << v["high"];
    EXPECT_EQ(v["text"], json(ticks.text));
    EXPECT_EQ(v["aside"], json(ticks.aside));
  }
  for (const json& v : vectors("padded")) {
    const Range room = Range{v["low"], v["high"]}.padded(v["share"]);
    EXPECT_EQ(json({room.low, room.high}), v["room"]);
  }
  for (const json& v : vectors("axisNames"))
    EXPECT_EQ(axisName(v["name"], {{}, {}, v["aside"]}), v["whole"].get<std::string>());
}

TEST(Vectors, NumbersAreWrittenAsTheScreenReadsThem) {
  for (const json& v : vectors("differences")) {
    std::vector<double> numbers;
    for (const json& number : v["numbers"]) numbers.push_back(number.is_null() ? NAN : number.get<double>());
    EXPECT_EQ(json::parse(secondDifferences(numbers)), v["differences"]);
  }
  for (const json& v : vectors("decimals")) EXPECT_EQ(Decimals(v["scale"]).value(v["whole"]), v["value"].get<double>());
}

/// A machine in space whose tip is unknown at the second time, as is a sample at the third, and a pin's axis. A wheel
/// turns at its elbow, a damper stands beside its spring, a motor and a spring at its shoulder. A belt leads from there
/// to the wall; a road, one place of which is unknown, and a plane lie beneath its tip.
Scene scene() {
  PictureResult machine = example::machine(true, 3).picture;
  Places& p = machine.places;
  const std::uint64_t wheel = machine.parts.size();
  machine.parts.push_back({"rotor", "mass", PartKind::wheel, 1, 1, 0, 0, 0, "", 0.3});
  machine.parts.push_back({"rubber", "spring-damper", PartKind::damper, 3, 2});
  machine.parts.push_back({"motor", "motor", PartKind::motor, 0, 0, 1});
  machine.parts.push_back({"return", "joint-spring", PartKind::spring, 0, 0, 1});
  for (const char* name : {"rotor.axle", "rotor.spoke"}) machine.axes.push_back({name, wheel});
  for (const PartInfo& part :
       {PartInfo{"belt", "coupling", PartKind::gear, 0, 3, 2},
        PartInfo{"floor", "plane-contact", PartKind::plane, 3, 2}, PartInfo{"road", "drive", PartKind::profile, 3, 2}})
    machine.parts.push_back(part);
  machine.parts[wheel + 4].ratio = 2;
  for (const char* name : {"belt.first.axle", "belt.first.spoke", "belt.second.axle", "belt.second.spoke"})
    machine.axes.push_back({name, wheel + 4});
  machine.axes.push_back({"floor.normal", wheel + 5});
  for (const char* name : {"road.up", "road.along"}) machine.axes.push_back({name, wheel + 6});
  p.step = {-1, 0, 1};
  machine.profiles = {{"road", wheel + 6, 0.5, {0.1, 0, -0.1, 0.05, 0, NAN, 0, 0, 0.2}}};
  for (const std::size_t row : {2, 1, 0}) {
    const double turn = 0.5 + static_cast<double>(row);
    const std::vector<double> directions{
        1, 0, 0, 0, std::cos(turn), std::sin(turn), 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0.6, 0.8, 0, 0, 1, 0, 1, 0};
    p.axes.insert(p.axes.begin() + static_cast<std::ptrdiff_t>(6 * row + 6), directions.begin(), directions.end());
  }
  const std::size_t row = 3 * machine.points.size();
  p.nominal[row + 6] = p.lower[row + 7] = p.samples[2 * row + 4] = p.axes[3 * machine.axes.size()] = NAN;
  return sceneOf(machine);
}

TEST(Vectors, ASceneIsHandedOnAsTheScreenReadsIt) {
  EXPECT_EQ(json::parse(sceneData(scene())), vectors("picture")["scene"]);
}

TEST(Vectors, ShapesOfPaperAreThoseOfTheScreen) {
  const json picture = vectors("picture");
  const Scene shown = scene();
  for (const json& v : picture["stances"]) {
    const Stance stance{v["row"], v["right"], v["up"]};
    ASSERT_EQ(v["shapes"].size(), shown.shapes.size());
    for (std::size_t i = 0; i < shown.shapes.size(); ++i) {
      json attributes;  // null where it is not seen
      for (const auto& [name, text] : attributesOf(shown, shown.shapes[i], stance))
        attributes[std::string(name)] = text;
      EXPECT_EQ(attributes, v["shapes"][i]) << "shape " << i << " at row " << stance.row;
    }
  }
}

}  // namespace
}  // namespace gamut
