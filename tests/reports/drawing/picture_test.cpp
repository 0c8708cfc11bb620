// The picture of the machine as text: an element for each part, a view that suits it, enclosures outward.
#include "reports/drawing/picture.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/report.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/page_text.hpp"

namespace gamut {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string drawn(const PictureResult& machine) { return drawScene(sceneOf(machine), "machine"); }

/// A machine of one point that is at these places in turn.
PictureResult moving(const std::vector<Place>& places) {
  PictureResult m;
  m.present = m.places.present = true;
  m.directions = {{"x", 0}, {"y", 0}, {"z", -9.81}};
  m.points = {{"bob", false, false}};
  m.parts = {{"weight", "mass", PartKind::mass, 0, 0, 0, 0, 1}};
  for (const Place& place : places) {
    m.places.time.push_back(static_cast<double>(m.places.time.size()));
    m.places.nominal.insert(m.places.nominal.end(), place.begin(), place.end());
  }
  return m;
}

TEST(MachinePicture, HasAnElementForEachPart) {
  const std::string svg = drawn(example::machine().picture);
  EXPECT_EQ(count(svg, "class=\"link\""), 2u);
  EXPECT_EQ(count(svg, "class=\"mass\""), 2u);
  EXPECT_EQ(count(svg, "class=\"spring\""), 1u);
  EXPECT_EQ(count(svg, "class=\"pin face hinge\""), 2u);
  EXPECT_EQ(count(svg, "class=\"sample\""), 2u);
  EXPECT_EQ(count(svg, "class=\"ground\""), 2u);
  EXPECT_EQ(count(svg, "class=\"swept\""), 1u);
  EXPECT_EQ(count(svg, "class=\"now\""), 1u);
  EXPECT_THAT(svg, AllOf(HasSubstr(">heavy</text>"), HasSubstr("light (mass, 0.5 kg)"), HasSubstr("500 mm</text>")));
}

/// Of its width on paper, and of a hair's where it has none.
TEST(MachinePicture, ShowsShapesInTheirWidth) {
  PictureResult m = example::machine().picture;
  m.parts.push_back({"hand", "sphere", PartKind::shape, 2, 2, 0, 0, 0, "", 0.25});
  m.parts.push_back({"edge", "box", PartKind::shape, 0, 1, 0, 0, 0});
  const std::string svg = drawn(m);
  EXPECT_EQ(count(svg, "class=\"shape\""), 2u);
  std::ostringstream width;
  width << std::fixed << std::setprecision(1) << 0.5 * sceneOf(m).view.scale;
  EXPECT_THAT(svg, HasSubstr("class=\"shape\" stroke-width=\"" + width.str() + "\""));
  EXPECT_THAT(svg, AllOf(HasSubstr("class=\"shape\" stroke-width=\"1.2\""), HasSubstr("hand (sphere)")));
}

/// A ring that can be seen however small it is, and as large as it is where that is more.
TEST(MachinePicture, ShowsPlay) {
  PictureResult m = example::machine().picture;
  m.parts.push_back({"pin", "play", PartKind::play, 1, 2, 0, 0, 0, "", 0.0042});
  m.parts.push_back({"slot", "guide-play", PartKind::play, 0, 1, 0, 0, 0, "", 0.25});
  const std::string svg = drawn(m);
  EXPECT_EQ(count(svg, "class=\"play\""), 2u);
  EXPECT_EQ(count(svg, "class=\"link\""), 2u);  // and no lines
  std::ostringstream radius;
  radius << std::fixed << std::setprecision(1) << 0.25 * sceneOf(m).view.scale;
  EXPECT_THAT(svg, AllOf(HasSubstr("class=\"play\" r=\"10.0\""), HasSubstr("pin (play, 0.0042 m to either side)"),
                         HasSubstr("class=\"play\" r=\"" + radius.str() + "\"")));
}

/// A strut, and what slides at its end on a spring and a damper: these reach from its foot, unless it carries
/// something.
TEST(MachinePicture, ShowsSpringsAtTheirLength) {
  PictureResult m;
  m.present = m.places.present = true;
  m.directions = {{"x", 0}, {"y", 0}, {"z", -9.81}};
  m.points = {{"ground", true, true}, {"top", true, false}, {"seat", false, false}};
  m.parts = {{"strut", "link", PartKind::rigid, 0, 1},
             {"slide", "prismatic", PartKind::joint, 1, 2, 0, 1},
             {"leg", "joint-spring", PartKind::spring, 1, 2, 0, 1},
             {"leg", "joint-spring", PartKind::damper, 1, 2, 0, 1}};
  m.axes = {{"slide.axis", 1}};
  m.places.time = {0, 1};
  m.places.nominal = {0, 0, 0, 0, 0, 0.4, 0, 0, 0.5, 0, 0, 0, 0, 0, 0.4, 0, 0, 0.3};
  m.places.axes = {0, 0, 1, 0, 0, 1};
  const auto shapeOf = [&](Shape::Form form) {
    const Scene scene = sceneOf(m);
    const auto found = std::ranges::find(scene.shapes, form, &Shape::form);
    return found == scene.shapes.end() ? Shape{} : *found;
  };
  using enum Shape::Form;
  EXPECT_EQ(shapeOf(zigzag).from, 0u);
  EXPECT_EQ(shapeOf(zigzag).to, 2u);
  EXPECT_LT(shapeOf(zigzag).size, 0);
  EXPECT_EQ(shapeOf(dashpot).from, 0u);
  EXPECT_GT(shapeOf(dashpot).size, 0);
  EXPECT_EQ(count(drawn(m), "class=\"link\""), 0u);
  m.places.axes = {0, 1, 0, 0, 1, 0};  // across the strut
  EXPECT_EQ(shapeOf(zigzag).from, 1u);
  m.places.axes = {0, 0, 1, 0, 0, 1};
  m.parts.push_back({"sensor", "mass", PartKind::mass, 1, 1, 0, 0, 1});
  EXPECT_EQ(shapeOf(zigzag).from, 1u);
  EXPECT_EQ(count(drawn(m), "class=\"link\""), 1u);
  m.parts.erase(m.parts.begin() + 3);
  EXPECT_EQ(shapeOf(zigzag).size, 0);
  EXPECT_EQ(shapeOf(dashpot).form, line) << "there is none";
}

/// On paper as large as it is; one whose size is unknown is not drawn.
TEST(MachinePicture, ShowsWheelsAndWhatTurnsThem) {
  PictureResult m = moving({{0, 0, 0}, {0, 0, 0}});
  m.parts.push_back({"weight", "mass", PartKind::wheel, 0, 0, 0, 0, 0, "", 0.2});
  m.parts.push_back({"drive", "motor", PartKind::motor, 0, 0, 1});
  m.parts.push_back({"return", "joint-spring", PartKind::spring, 0, 0, 1});
  m.axes = {{"weight.axle", 1}, {"weight.spoke", 1}};
  m.places.axes = {1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1};
  const Scene scene = sceneOf(m);
  const auto wheel = std::ranges::find(scene.shapes, Shape::Form::wheel, &Shape::form);
  ASSERT_NE(wheel, scene.shapes.end());
  EXPECT_NEAR(wheel->size, 0.2 * scene.view.scale, 0.05);
  EXPECT_GT(scene.view.scale, 0) << "a wheel alone has a size";
  EXPECT_GT(scene.view.height, 2 * wheel->size);
  const std::string svg = drawn(m);
  EXPECT_EQ(count(svg, "class=\"motor\""), 1u);
  EXPECT_EQ(count(svg, "class=\"coil\""), 1u);
  EXPECT_THAT(svg, HasSubstr("class=\"mass\" r=\"2.5\""));
  m.parts[1].radius = 0;
  EXPECT_EQ(count(drawn(m), "class=\"wheel\""), 0u);
  EXPECT_THAT(drawn(m), Not(HasSubstr("r=\"2.5\"")));
}

/// Two joints of one body, 0.6 m apart, about x.
PictureResult geared(double ratio) {
  PictureResult m = moving({{0, 0, 0}, {0, 0, 0}});
  m.points = {{"inertial", true, true}, {"H", true, true}};
  m.places.nominal = {0, 0, 0, 0.2, 0.6, 0, 0, 0, 0, 0.2, 0.6, 0};
  m.parts = {{"motor", "revolute", PartKind::joint, 0, 0, 1}, {"output", "revolute", PartKind::joint, 1, 1, 1}};
  m.parts.push_back({"pair", "coupling", PartKind::gear, 0, 1, 2});
  m.parts.back().ratio = ratio;
  m.axes = {{"motor.axis", 0},       {"output.axis", 1},      {"pair.motor.axle", 2},
            {"pair.motor.spoke", 2}, {"pair.output.axle", 2}, {"pair.output.spoke", 2}};
  for (int row = 0; row < 2; ++row)
    for (const double e : {1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0}) m.places.axes.push_back(e);
  return m;
}

/// Radii are those of pitch circles: they touch where joints turn against each other, and have the ratio.
TEST(MachinePicture, ShowsGearsAsWheelsOfTheirRatio) {
  const auto sizes = [](const Scene& scene) {
    std::vector<double> radii;
    for (const Shape& shape : scene.shapes)
      if (shape.form == Shape::Form::wheel) radii.push_back(shape.size / scene.view.scale);
    return radii;
  };
  const Scene meshing = sceneOf(geared(-2));
  ASSERT_EQ(sizes(meshing).size(), 2u);
  EXPECT_NEAR(sizes(meshing)[0], 0.4, 1e-3);
  EXPECT_NEAR(sizes(meshing)[1], 0.2, 1e-3);
  EXPECT_EQ(count(drawn(geared(-2)), "class=\"belt\""), 0u);
  EXPECT_EQ(count(drawn(geared(-2)), "class=\"load\""), 0u);
  const Scene belt = sceneOf(geared(0.5));
  ASSERT_EQ(sizes(belt).size(), 2u);
  EXPECT_NEAR(2 * sizes(belt)[0], sizes(belt)[1], 2e-3);
  EXPECT_LT(sizes(belt)[0] + sizes(belt)[1], 0.6) << "they do not touch";
  EXPECT_EQ(count(drawn(geared(0.5)), "class=\"belt\""), 1u);
  PictureResult against = geared(0.5);  // about opposite axes
  for (const std::size_t row : {0, 1}) against.places.axes[18 * row + 12] = -1;
  EXPECT_EQ(count(drawn(against), "class=\"belt\""), 0u);
}

/// A line and a sign where axes are not parallel, where joints stand on one axis, or where nothing is known of them.
TEST(MachinePicture, ShowsOtherGearsBySigns) {
  PictureResult bevel = geared(2), coaxial = geared(2), mimic = geared(2);
  for (const std::size_t row : {0, 1}) bevel.places.axes[18 * row + 12] = 0, bevel.places.axes[18 * row + 14] = 1;
  for (const std::size_t row : {0, 1}) coaxial.places.nominal[6 * row + 4] = 0;
  mimic.axes.resize(2);
  mimic.places.axes.resize(12);
  for (const PictureResult& m : {bevel, coaxial, mimic}) {
    EXPECT_EQ(count(drawn(m), "class=\"wheel gear\""), 0u);
    EXPECT_EQ(count(drawn(m), "class=\"load\""), 1u);
    EXPECT_EQ(count(drawn(m), "class=\"belt\""), 1u);
    EXPECT_THAT(drawn(m), HasSubstr("pair (coupling)"));
  }
}

TEST(MachinePicture, ShowsThePinionOfARack) {
  PictureResult m = geared(-0.1);
  m.parts[0] = {"rack", "prismatic", PartKind::joint, 0, 0, 0, 1};
  m.parts[2].turns = 1;
  m.parts[2].radius = 0.1;
  m.axes = {
      {"rack.axis", 0}, {"output.axis", 1}, {"pair.rack.axis", 2}, {"pair.output.axle", 2}, {"pair.output.spoke", 2}};
  m.places.axes.clear();
  for (int row = 0; row < 2; ++row)
    for (const double e : {0, 1, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1}) m.places.axes.push_back(e);
  const Scene scene = sceneOf(m);
  const auto wheel = std::ranges::find(scene.shapes, Shape::Form::wheel, &Shape::form);
  ASSERT_NE(wheel, scene.shapes.end());
  EXPECT_EQ(wheel->to, 1u);
  EXPECT_NEAR(wheel->size, 0.1 * scene.view.scale, 0.06);
  for (const std::size_t row : {0, 1}) m.places.axes[15 * row + 6] = 1, m.places.axes[15 * row + 7] = 0;  // a screw
  EXPECT_EQ(count(drawn(m), "class=\"wheel gear\""), 0u);
}

/// A motor, friction and a damper at one joint stand beside each other, whatever their order.
TEST(MachinePicture, ShowsSignsBesideEachOther) {
  PictureResult m = moving({{0, 0, 0}, {0, 0, 0}});
  m.parts.push_back({"hinge", "revolute", PartKind::joint, 0, 0, 1});
  m.parts.push_back({"drive", "motor", PartKind::motor, 0, 0, 1});
  m.parts.push_back({"brake", "joint-friction", PartKind::friction, 0, 0, 1});
  m.parts.push_back({"oil", "joint-spring", PartKind::damper, 0, 0, 1});
  m.parts.push_back({"guide", "joint-friction", PartKind::friction, 0, 0, 0, 1});
  const std::string svg = drawn(m);
  for (const char* room : {"translate(-17 17)", "translate(17 17)", "translate(-17 -17)", "translate(0 27)"})
    EXPECT_EQ(count(svg, room), 1u) << room;
  EXPECT_EQ(count(svg, "class=\"load\""), 3u);
  EXPECT_THAT(svg, AllOf(HasSubstr("brake (joint-friction)"), HasSubstr("oil (joint-spring)")));
}

/// The line of the road leads through the point that rides on it; no rail and no fixed ground are shown instead.
TEST(MachinePicture, ShowsTheRoadBeneathAPoint) {
  PictureResult m = moving({{0, 0, 1}, {0, 0, 1}});
  m.points = {{"inertial", true, true}, {"ground", false, false}, {"body", false, false}};
  m.places.nominal = {0, 0, 0, 0, 0, 0.1, 0, 0, 1.1, 0, 0, 0, 0, 0, 0.2, 0, 0, 1.2};
  m.parts = {{"lift", "prismatic", PartKind::joint, 0, 1, 0, 1}, {"weight", "mass", PartKind::mass, 1, 2, 0, 0, 1}};
  m.parts.push_back({"road", "drive", PartKind::profile, 0, 1});
  m.axes = {{"lift.axis", 0}, {"road.up", 2}, {"road.along", 2}};
  for (int row = 0; row < 2; ++row)
    for (const double e : {0, 0, 1, 0, 0, 1, 1, 0, 0}) m.places.axes.push_back(e);
  m.places.step = {-1, 0, 1};
  m.profiles = {{"road", 2, 1, {-0.1, 0, 0.1, -0.2, 0, infinity}}};
  const Scene scene = sceneOf(m);
  const auto road = std::ranges::find(scene.shapes, Shape::Form::road, &Shape::form);
  ASSERT_NE(road, scene.shapes.end());
  const Sight at = sightOf(scene, scene.at(scene.nominal, 0, 1), {0, scene.view.right, scene.view.up});
  std::ostringstream path;
  const double way = road->size, up = 0.1 * scene.view.scale;
  path << std::fixed << std::setprecision(0) << "M" << at.x - way;
  const std::string d = attributesOf(scene, *road, {0, scene.view.right, scene.view.up})[0].second;
  EXPECT_TRUE(d.starts_with(path.str())) << d;
  double first = 0, second = 0, x = 0;
  ASSERT_EQ(std::sscanf(d.c_str(), "M%lf %lfL%lf %lf", &x, &first, &x, &second), 4);
  EXPECT_NEAR(x, at.x, 0.1);
  EXPECT_NEAR(second, at.y, 0.1);
  EXPECT_NEAR(first, at.y + up, 0.2);
  const std::string later = attributesOf(scene, *road, {1, scene.view.right, scene.view.up})[0].second;
  EXPECT_EQ(count(later, "L"), 1u) << "what is not known is not drawn: " << later;
  const std::string svg = drawn(m);
  EXPECT_EQ(count(svg, "class=\"ground\""), 0u);
  EXPECT_EQ(count(svg, "class=\"rail\""), 0u);
  EXPECT_EQ(count(svg, "slider"), 0u);
}

/// Each as far as halfway to the next: two that differ do not lie upon each other.
TEST(MachinePicture, ShowsRoadsBesideEachOther) {
  PictureResult m = moving({{0, 0, 1}});
  m.points = {{"inertial", true, true}, {"rear", false, false}, {"front", false, false}};
  m.places.nominal = {0, 0, 0, -1, 0, 0, 1, 0, 0};
  m.parts = {{"rear road", "drive", PartKind::profile, 0, 1}, {"front road", "drive", PartKind::profile, 0, 2}};
  m.axes = {{"rear.up", 0}, {"rear.along", 0}, {"front.up", 1}, {"front.along", 1}};
  m.places.axes = {0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0};
  m.places.step = {-1, -0.5, 0, 0.5, 1};
  m.profiles = {{"rear road", 0, 2, {1, 2, 0, 3, 4}}, {"front road", 1, 2, {1, 2, 0, 3, 4}}};
  const Scene scene = sceneOf(m);
  ASSERT_EQ(scene.roads.size(), 2u);
  const auto known = [](const std::vector<double>& heights) {
    std::vector<int> which;
    for (const double height : heights) which.push_back(std::isfinite(height) ? 1 : 0);
    return which;
  };
  EXPECT_THAT(known(scene.roads[0]), ElementsAre(1, 1, 1, 1, 0));
  EXPECT_THAT(known(scene.roads[1]), ElementsAre(0, 1, 1, 1, 1));
}

/// A line under a ball where it is seen from the edge, hatched below, a field where it is seen from above.
TEST(MachinePicture, ShowsThePlaneBeneathAPoint) {
  PictureResult m = moving({{0, 0.5, 1}, {0, 0.7, 1}});
  m.points = {{"inertial", true, true}, {"ball", false, false}};
  m.places.nominal = {0, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 0.7, 1};
  m.parts = {{"flight", "free", PartKind::joint, 0, 1, 3, 3}, {"floor", "plane-contact", PartKind::plane, 0, 1}};
  m.axes = {{"floor.normal", 1}};
  m.places.axes = {0, 0, 1, 0, 0, 1};
  const Scene scene = sceneOf(m);
  ASSERT_TRUE(scene.view.isSideView);
  const auto plane = std::ranges::find(scene.shapes, Shape::Form::plane, &Shape::form);
  ASSERT_NE(plane, scene.shapes.end());
  Stance stance{1, scene.view.right, scene.view.up};
  const Sight floor = sightOf(scene, scene.at(scene.nominal, 1, 0), stance),
              ball = sightOf(scene, scene.at(scene.nominal, 1, 1), stance);
  double x = 0, y = 0;
  const std::string edge = attributesOf(scene, *plane, stance)[0].second;
  ASSERT_EQ(std::sscanf(edge.c_str(), "M%lf %lf", &x, &y), 2);
  EXPECT_NEAR(x, ball.x - plane->size, 0.1);
  EXPECT_NEAR(y, floor.y, 0.1);
  EXPECT_EQ(count(edge, "M"), 1u + 6);
  stance.right = {0, 1, 0};
  stance.up = {-1, 0, 0};
  const std::string above = attributesOf(scene, *plane, stance)[0].second;
  EXPECT_EQ(count(above, "M"), 1u);
  EXPECT_TRUE(above.ends_with("Z"));
}

TEST(MachinePicture, HoldsNothingThatIsFree) {
  PictureResult m = moving({{0, 0, 0}});
  m.points.insert(m.points.begin(), {"inertial", true, true});
  m.parts = {{"flight", "free", PartKind::joint, 0, 1, 3, 3, 0}, {"weight", "mass", PartKind::mass, 1, 1, 0, 0, 1}};
  m.places.nominal.insert(m.places.nominal.begin(), 3, 0.0);
  EXPECT_EQ(count(drawn(m), "class=\"ground\""), 0u);
  m.parts.front().slides = 0;  // a ball joint
  EXPECT_EQ(count(drawn(m), "class=\"ground\""), 1u);
}

/// Many bodies in a wrist: the name of the heaviest is seen, and none lies over it.
TEST(MachinePicture, ShowsNoNameOverAnother) {
  PictureResult m = moving({{0, 0, 0}, {0, 1, 0}});
  m.points.resize(3, m.points.front());
  m.parts.push_back({"heavier", "mass", PartKind::mass, 1, 1, 0, 0, 5});
  m.parts.push_back({"elsewhere", "mass", PartKind::mass, 2, 2, 0, 0, 2});
  m.places.nominal = {0, 0, 0, 0, 0.001, 0, 0, 2, 2, 0, 1, 0, 0, 1.001, 0, 0, 3, 2};
  const std::string svg = drawn(m);
  EXPECT_THAT(svg, ContainsRegex("class=\"name\" dy=\"0.0em\" data-shape[^>]*>heavier<"));
  EXPECT_THAT(svg, ContainsRegex("class=\"name\" dy=\"0.0em\" data-shape[^>]*>elsewhere<"));
  EXPECT_THAT(svg, ContainsRegex("class=\"name\" dy=\"0.0em\" visibility=\"hidden\" data-shape[^>]*>weight<"));
}

TEST(MachinePicture, TellsMassesInTheUnitsThatTheStudyStates) {
  PictureResult machine = moving({{0, 0, 0}});
  machine.parts[0].mass = 0.25;
  machine.parts[0].told = "g";
  EXPECT_THAT(drawn(machine), HasSubstr("weight (mass, 250 g)"));
  machine.parts[0].told = "no unit";  // of a file that another build wrote
  EXPECT_THAT(drawn(machine), HasSubstr("weight (mass, 0.25 kg)"));
}

TEST(MachinePicture, StandsOnThePageBeforeAnyScript) {
  const std::string page = renderReport(example::machine());
  EXPECT_EQ(count(page, "<svg class=\"drawing machine\""), 1u + 6u);  // and six for paper
  EXPECT_THAT(page, AllOf(HasSubstr("<h2>The machine</h2>"), HasSubstr("Side view, at the start."),
                          HasSubstr("guaranteed region from 0 s to 3 s"), HasSubstr("2 samples")));
}

/// Of a machine of 1 m a way of 2 mm is seen 50 times as long, and so is what encloses it; of 50 mm it is as it is.
TEST(MachinePicture, MagnifiesWhatWouldHardlyBeSeen) {
  const auto swung = [](double way) {
    PictureResult m = moving({{0, 0, 0}, {0, way, 0}});
    m.points.push_back({"far", false, false});
    Places& p = m.places;
    p.nominal = {0, 0, 0, 0, 0, 1, 0, way, 0, 0, 0, 1};
    p.lower = {0, 0, 0, 0, 0, 1, 0, 0.75 * way, 0, 0, 0, 1};
    p.upper = {0, 0, 0, 0, 0, 1, 0, 1.25 * way, 0, 0, 0, 1};
    p.sag.assign(12, 0.25 * way);
    return sceneOf(m);
  };
  for (const auto& [way, factor] : {std::pair(0.002, 50.0),
                                    {0.0019, 50.0},
                                    {0.0011, 50.0},
                                    {0.0009, 100.0},
                                    {2e-6, 50000.0},
                                    {0.029, 2.0},
                                    {0.05, 1.0},
                                    {1.0, 1.0},
                                    {1e-9, 1.0},
                                    {0.0, 1.0}}) {
    SCOPED_TRACE(way);
    const Scene scene = swung(way);
    EXPECT_EQ(scene.magnification, factor);
    const double unit = scene.view.scale / Scene::unit,
                 moved = scene.at(scene.nominal, 1, 0)[1] - scene.at(scene.nominal, 0, 0)[1];
    EXPECT_NEAR(moved, factor * way * unit, 1);
    EXPECT_LE(scene.at(scene.lower, 1, 0)[1] - scene.at(scene.nominal, 0, 0)[1], 0.75 * factor * way * unit + 0.5);
    EXPECT_GE(scene.at(scene.upper, 1, 0)[1] - scene.at(scene.nominal, 0, 0)[1], 1.25 * factor * way * unit - 0.5);
    EXPECT_GE(scene.at(scene.sag, 1, 0)[1], 0.25 * factor * way * unit - 1e-9);
    EXPECT_EQ(scene.at(scene.nominal, 1, 1), scene.at(scene.nominal, 0, 1));  // what stands still, does
  }
}

TEST(MachinePicture, SaysThatItMagnifies) {
  Results results = example::machine();
  EXPECT_THAT(renderReport(results), Not(HasSubstr("times as long as they are")));
  std::vector<double>& places = results.picture.places.nominal;
  for (std::size_t i = 12; i < places.size(); ++i) places[i] = places[i % 12] + 1e-3 * (places[i] - places[i % 12]);
  results.picture.places.samples = places;
  results.picture.places.sample = {0};
  EXPECT_THAT(renderReport(results), ContainsRegex("; ways from there are drawn [1-9]0+ times as long as they are"));
}

/// On paper nothing moves: six times, each with the machine where it is then.
TEST(MachinePicture, StandsAtSixTimesOnPaper) {
  const std::string page = renderReport(example::machine(false, 11));
  const auto from = page.find("<div class=\"poses\">"), to = page.find("</div>", from);
  ASSERT_NE(from, std::string::npos);
  const std::string poses = page.substr(from, to - from);
  EXPECT_EQ(count(poses, "<svg"), 6u);
  for (const char* when : {"0 s", "0.6 s", "1.2 s", "1.8 s", "2.4 s", "3 s"})
    EXPECT_THAT(poses, HasSubstr(std::string("<figcaption>") + when + "</figcaption>"));
  EXPECT_EQ(count(poses, "class=\"swept\""), 0u);
  EXPECT_EQ(count(poses, "class=\"mass\""), 12u);
  EXPECT_EQ(count(renderReport(example::machine(false, 3)), "<figcaption>1.5 s</figcaption>"), 1u);
}

TEST(MachinePicture, IsLeftOutWhereThereIsNoMachine) {
  const std::string page = renderReport(example::pendulum());
  EXPECT_THAT(page, AllOf(Not(HasSubstr("The machine")), Not(HasSubstr("id=\"machine\""))));
}

TEST(MachinePicture, SaysWhatIsMissing) {
  Results results = example::machine();
  results.picture.why = "the run was interrupted";
  results.picture.places.lower = results.picture.places.upper = results.picture.places.sag = {};
  results.picture.places.sample = {};
  results.picture.places.samples = {};
  const std::string page = renderReport(results);
  EXPECT_THAT(page, AllOf(HasSubstr("at the start; the run was interrupted."), Not(HasSubstr("class=\"swept\"")),
                          Not(HasSubstr("guaranteed region"))));
}

TEST(MachinePicture, EscapesNames) {
  Results results = example::machine();
  const std::string attack = "</script></svg><script>alert(1)</script>";
  results.picture.why = attack;
  for (PointInfo& point : results.picture.points) point.name = attack;
  for (PartInfo& part : results.picture.parts) part.name = part.type = attack;
  for (DirectionInfo& direction : results.picture.directions) direction.name = attack;
  const std::string page = renderReport(results);
  EXPECT_EQ(count(page, "<script"), count(renderReport(example::machine()), "<script"));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
}

TEST(MachinePicture, IsASideViewOfThePlaneOfMotion) {
  struct Case {
    std::vector<Place> places;
    Place right, up;
  };
  for (const auto& [places, right, up] : std::vector<Case>{{{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}}, {0, 1, 0}, {0, 0, 1}},
                                                           {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}, {1, 0, 0}, {0, 0, 1}},
                                                           {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {1, 0, 0}, {0, 1, 0}},
                                                           {{{0, 0, 0}, {2, 0, 0}}, {1, 0, 0}, {0, 0, 1}},
                                                           {{{0, 0, 0}, {0, 2, 0}}, {0, 1, 0}, {0, 0, 1}}}) {
    const View view = viewOf(moving(places));
    EXPECT_TRUE(view.isSideView);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(view.right[i], right[i], 1e-12);
      EXPECT_NEAR(view.up[i], up[i], 1e-12);
    }
  }
  EXPECT_TRUE(viewOf(example::machine().picture).isSideView);
  EXPECT_FALSE(viewOf(example::machine(true).picture).isSideView);
}

TEST(MachinePicture, OfAMachineAtRestIsSeenAlongItsAxes) {
  for (std::size_t i : {0, 1}) {
    PictureResult machine = moving({{0, 0, 0}, {0, 0, -1}});
    machine.parts.push_back({"hinge", "revolute", PartKind::joint, 0, 0, 1, 0, 0});
    machine.axes = {{"hinge.axis", 1}};
    machine.places.axes = {0, 0, 0, 0, 0, 0};
    machine.places.axes[i] = 1;
    const View view = viewOf(machine);
    EXPECT_TRUE(view.isSideView);
    EXPECT_NEAR(view.right[1 - i], 1, 1e-12);
  }
}

TEST(MachinePicture, HasUpAgainstGravity) {
  PictureResult machine = moving({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  machine.directions = {{"x", 9.81}, {"y", 0}, {"z", 0}};
  const View view = viewOf(machine);
  EXPECT_NEAR(view.up[0], -1, 1e-12);
  EXPECT_NEAR(view.right[1], 1, 1e-12);
}

TEST(MachinePicture, FitsOnThePaperWhateverTheSize) {
  for (const double size : {1e-6, 1e-3, 1.0, 100.0, 1e5})
    for (const bool isSpatial : {false, true}) {
      PictureResult machine = example::machine(isSpatial).picture;
      for (auto* of : {&machine.places.nominal, &machine.places.samples, &machine.places.lower, &machine.places.upper})
        for (double& x : *of) x *= size;
      const Scene scene = sceneOf(machine);
      const View& view = scene.view;
      for (std::size_t k = 0; k < scene.points * scene.time.size(); ++k) {
        const Sight at = sightOf(scene, scene.at(scene.nominal, 0, k), {0, view.right, view.up});
        EXPECT_GT(at.x, 0) << size;
        EXPECT_LT(at.x, view.width) << size;
        EXPECT_GT(at.y, 0) << size;
        EXPECT_LT(at.y, view.height) << size;
      }
    }
}

/// A wheel is seen as a whole wherever it rolls, however large it is against its way.
TEST(MachinePicture, FollowsWheelsThatRoll) {
  for (const double radius : {0.01, 0.3, 1.0, 3.0, 30.0})
    for (const double lean : {0.0, 0.5}) {
      PictureResult m = moving({});
      m.parts.push_back({"coin", "rolling-wheel", PartKind::wheel, 0, 0, 0, 0, 0, "", radius});
      m.axes = {{"coin.axle", 1}, {"coin.spoke", 1}};
      for (int row = 0; row <= 20; ++row) {
        const double x = 0.1 * row, turn = x / radius, c = std::cos(turn), s = std::sin(turn);
        m.places.time.push_back(row);
        m.places.nominal.insert(m.places.nominal.end(), {x, 0, radius * std::cos(lean)});
        for (const double e : {0.0, std::cos(lean), std::sin(lean), c, s * std::sin(lean), -s * std::cos(lean)})
          m.places.axes.push_back(e);
      }
      const Scene scene = sceneOf(m);
      const auto wheel = std::ranges::find(scene.shapes, Shape::Form::wheel, &Shape::form);
      ASSERT_NE(wheel, scene.shapes.end());
      for (std::size_t row = 0; row < scene.time.size(); ++row) {
        std::istringstream path(attributesOf(scene, *wheel, {row, scene.view.right, scene.view.up})[0].second);
        for (char letter = 0; path >> letter && letter != 'Z';) {
          double x = 0, y = 0;
          path >> x >> y;
          EXPECT_TRUE(x > 0 && x < scene.view.width && y > 0 && y < scene.view.height)
              << radius << " " << lean << " " << row << ": " << x << " " << y;
        }
      }
    }
}

TEST(MachinePicture, OfOnePlaceIsThereToo) {
  const std::string svg = drawn(moving({{1, 2, 3}, {1, 2, 3}}));
  EXPECT_THAT(svg, AllOf(HasSubstr("class=\"mass\""), Not(HasSubstr("nan")), Not(HasSubstr("class=\"scale\""))));
}

TEST(MachinePicture, SurvivesNumbersThatAreNone) {
  for (const double odd : {std::nan(""), infinity, -infinity, 1e308, -1e308}) {
    PictureResult machine = example::machine(true).picture;
    for (auto* of : {&machine.places.nominal, &machine.places.samples, &machine.places.lower, &machine.places.upper,
                     &machine.places.sag, &machine.places.axes})
      for (std::size_t i = 7; i < of->size(); i += 7) (*of)[i] = odd;
    EXPECT_THAT(drawn(machine), HasSubstr("</svg>"));
    EXPECT_TRUE(json::accept(sceneData(sceneOf(machine)))) << odd;
  }
}

TEST(MachinePicture, HandsOnEnclosuresOutward) {
  const PictureResult machine = example::machine().picture;
  const View view = viewOf(machine);
  const json data = json::parse(sceneData(sceneOf(machine)));
  const double unit = data["unit"].get<double>() / view.scale;
  for (std::size_t i = 0; i < machine.places.lower.size(); ++i) {
    EXPECT_LE(view.centre[i % 3] + data["lower"][i].get<double>() * unit, machine.places.lower[i] + 1e-12);
    EXPECT_GE(view.centre[i % 3] + data["upper"][i].get<double>() * unit, machine.places.upper[i] - 1e-12);
    EXPECT_GE(data["sag"][i].get<double>() * unit, machine.places.sag[i] - 1e-12);
  }
}

TEST(Hull, HoldsAllAndIsConvex) {
  std::vector<Sight> sights, hull;
  for (int i = 0; i < 60; ++i) sights.push_back({std::sin(7.3 * i) + 0.3 * std::cos(i), std::cos(3.1 * i * i)});
  for (Sight& p : sights) p = {std::round(1000 * p.x), std::round(1000 * p.y)};
  std::string path = hullPath(sights);
  std::ranges::replace_if(
      path, [](char c) { return c == 'M' || c == 'L' || c == 'Z'; }, ' ');
  std::istringstream numbers(path);
  for (Sight p; numbers >> p.x >> p.y;) hull.push_back(p);
  ASSERT_GE(hull.size(), 3u);
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Sight &a = hull[k], &b = hull[(k + 1) % hull.size()];
    for (const Sight& p : sights) EXPECT_GE((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x), 0);
  }
  EXPECT_EQ(hullPath({}), "");
}

}  // namespace
}  // namespace gamut
