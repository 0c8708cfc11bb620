// What of a mechanism is seen: which points there are, what lies between them, and where they are.
#include "mechanics/skeleton.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "mechanics/assembly.hpp"
#include "tests/mechanics/machines.hpp"

namespace gamut::testing {
namespace {

using ::testing::ElementsAre;
using Kind = Skeleton::Kind;

std::vector<std::string> namesOf(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Skeleton::Point& point : skeleton.points) names.push_back(point.name);
  return names;
}

TEST(Skeleton, JoinsWhatStandsTogether) {
  const Skeleton skeleton = skeletonOf(doublePendulum());
  EXPECT_THAT(namesOf(skeleton), ElementsAre("inertial", "K2", "K4"));
  EXPECT_TRUE(skeleton.points[0].isFixed);
  EXPECT_FALSE(skeleton.points[1].isFixed);
  ASSERT_EQ(skeleton.parts.size(), 6u);
  const Skeleton::Part &shoulder = skeleton.parts[0], &upper = skeleton.parts[1], &tip = skeleton.parts[5];
  EXPECT_EQ(shoulder.kind, Kind::joint);
  EXPECT_EQ(shoulder.type, "revolute");
  EXPECT_EQ(shoulder.turns, 1);
  EXPECT_EQ(shoulder.slides, 0);
  EXPECT_EQ(shoulder.from, shoulder.to);
  EXPECT_EQ(upper.kind, Kind::rigid);
  EXPECT_EQ(upper.to, 1u);
  EXPECT_EQ(tip.kind, Kind::mass);
  EXPECT_EQ(tip.to, 2u);
  ASSERT_EQ(skeleton.axes.size(), 2u);
  EXPECT_EQ(skeleton.axes[1].name, "elbow.axis");
  EXPECT_EQ(skeleton.axes[1].part, 3u);
}

TEST(Skeleton, ShowsPlayWhereItIs) {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "K", axisZ});
  m.add(Link{"rod", "K", "hole", {1.0, 0.0, 0.0}});
  m.add(Play{.name = "slack", .from = "hole", .to = "pin", .clearance = 0.002, .eccentricity = 0.5});
  m.add(GuidePlay{.name = "guide", .from = "pin", .to = "slider", .length = 0.1, .clearance = 0.001});
  const Skeleton skeleton = skeletonOf(m, {"slack.direction", "guide.front"});
  ASSERT_EQ(skeleton.parts.size(), 4u);
  const Skeleton::Part &slack = skeleton.parts[2], &guide = skeleton.parts[3];
  EXPECT_EQ(slack.kind, Kind::play);
  EXPECT_EQ(skeleton.points[slack.from].name, "hole");
  EXPECT_EQ(skeleton.points[slack.to].name, "pin");
  EXPECT_TRUE(isEqual(m.rangeOf(slack.radius), Interval(0.002)));
  EXPECT_EQ(guide.kind, Kind::play);
  EXPECT_TRUE(isEqual(m.rangeOf(guide.radius), Interval(0.001)));
  EXPECT_EQ(skeleton.parts[1].kind, Kind::rigid);
}

TEST(Skeleton, KeepsApartWhatMayComeApart) {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "K", axisX});
  m.add(Link{"rod", "K", "end", {0.0, 0.0, 0.0}});
  m.add(Mass{"bob", "end", 1.0});
  EXPECT_THAT(namesOf(skeletonOf(m)), ElementsAre("inertial"));
  EXPECT_THAT(namesOf(skeletonOf(m, {"rod.vector.z"})), ElementsAre("inertial", "end"));
}

TEST(Skeleton, TellsGroundFromWhatOnlyStaysInItsPlace) {
  Mechanism m;
  m.add(Link{"base", "inertial", "B", {1.0, 0.0, 0.0}});
  m.add(Revolute{"turn", "B", "K", axisZ});
  m.add(Link{"column", "K", "top", {0.0, 0.0, 0.5}});
  m.add(Link{"arm", "top", "end", {0.3, 0.0, 0.0}});
  m.add(Mass{"body", "end", 1.0});
  const Skeleton skeleton = skeletonOf(m);
  ASSERT_THAT(namesOf(skeleton), ElementsAre("inertial", "B", "top", "end"));
  EXPECT_TRUE(skeleton.points[1].isGround);
  EXPECT_TRUE(skeleton.points[2].isFixed);
  EXPECT_FALSE(skeleton.points[2].isGround);
}

/// A sphere at its centre, a capsule by its segment, a box by its edges; none by a link to what carries it.
TEST(Skeleton, ShowsShapesAsLinesOfSomeWidth) {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "K", axisX});
  m.add(Mass{"bob", "K", 1.0, {0.0, 0.0, -1.0}});
  m.add(Sphere{"ball", "K", 0.25, {0.0, 0.0, -2.0}});
  m.add(Capsule{"rod", "K", 0.125, 3.0, Axis(0, -1, 0), {0.0, 0.0, -1.0}});
  m.add(Cuboid{"block", "inertial", {2.0, 4.0, 6.0}, {10.0, 0.0, 0.0}});
  const Skeleton skeleton = skeletonOf(m);
  ASSERT_EQ(skeleton.parts.size(), 2u + 1 + 1 + 12);
  const Skeleton::Part &ball = skeleton.parts[2], &rod = skeleton.parts[3], &edge = skeleton.parts[4];
  for (const Skeleton::Part* part : {&ball, &rod, &edge}) EXPECT_EQ(part->kind, Kind::shape);
  const Assembly<double> assembly(m);
  const std::vector<double> places = positionsOf(assembly, skeleton);
  const auto placeOf = [&](std::size_t point) {
    return std::vector<double>(places.begin() + static_cast<std::ptrdiff_t>(3 * point),
                               places.begin() + static_cast<std::ptrdiff_t>(3 * point + 3));
  };
  EXPECT_EQ(ball.from, ball.to);
  EXPECT_THAT(placeOf(ball.from), ElementsAre(0, 0, -2));
  EXPECT_EQ(assembly.number(ball.radius), 0.25);
  EXPECT_EQ(assembly.number(rod.radius), 0.125);
  EXPECT_THAT(placeOf(rod.from), ElementsAre(0, 1.5, -1));
  EXPECT_THAT(placeOf(rod.to), ElementsAre(0, -1.5, -1));
  EXPECT_THAT(placeOf(edge.from), ElementsAre(9, -2, -3));
  EXPECT_THAT(placeOf(edge.to), ElementsAre(11, -2, -3));
  EXPECT_TRUE(skeleton.points[edge.from].isGround);
}

TEST(Skeleton, SaysWhatEachPartIs) {
  Mechanism m;
  m.add(Prismatic{"rail", "inertial", "cart", axisY, 0.1});
  m.add(Cylindrical{"sleeve", "cart", "S", axisZ, 0.1});
  m.add(Universal{"cross", "S", "U"});
  m.add(Weld{"weld", "U", "W"});
  m.add(Mass{"body", "W", 2.0, {0.0, 0.1, 0.0}});
  m.add(Spring{"buffer", "inertial", "cart", 10.0, 1.0, 0.0, {0.0, -1.0, 0.0}});
  m.add(Distance{"gauge", "inertial", "cart", {1.0, 0.0, 0.0}});
  const Skeleton skeleton = skeletonOf(m);
  std::vector<std::string> parts;
  for (const Skeleton::Part& part : skeleton.parts) parts.push_back(part.name);
  EXPECT_THAT(parts, ElementsAre("rail", "sleeve", "cross", "weld", "body", "buffer"));
  EXPECT_EQ(skeleton.parts[0].slides, 1);
  EXPECT_EQ(skeleton.parts[1].turns + skeleton.parts[1].slides, 2);
  EXPECT_EQ(skeleton.parts[2].turns, 2);
  EXPECT_EQ(skeleton.parts[5].kind, Kind::spring);
  EXPECT_THAT(namesOf(skeleton), ElementsAre("inertial", "cart", "S", "body.centre", "buffer.from"));
  ASSERT_EQ(skeleton.axes.size(), 4u);
  EXPECT_EQ(skeleton.axes[2].frame, "S");
  EXPECT_EQ(skeleton.axes[3].frame, "U");
}

TEST(Skeleton, ShowsWhatActsAtJoints) {
  Mechanism m;
  m.add(Prismatic{"slide", "inertial", "cart", axisY, 0.1});
  m.add(Revolute{"hinge", "cart", "arm", axisX});
  m.add(Cylindrical{"sleeve", "arm", "S", axisZ, 0.1});
  m.add(JointSpring{"strut", "slide", 10.0, 0.0, 2.0});
  m.add(JointSpring{"brake", "hinge", 0.0, 0.0, 2.0});
  m.add(JointSpring{"wound", "hinge.angle", 3.0});
  m.add(JointSpring{"either", "sleeve.displacement", 3.0});
  m.add(Motor{.name = "motor", .joint = "hinge", .moment = 1.0});
  const Skeleton skeleton = skeletonOf(m);
  std::vector<std::string> parts;
  std::vector<Kind> kinds;
  for (std::size_t i = 3; i < skeleton.parts.size(); ++i) {
    parts.push_back(skeleton.parts[i].name);
    kinds.push_back(skeleton.parts[i].kind);
  }
  EXPECT_THAT(parts, ElementsAre("strut", "strut", "brake", "wound", "motor"));
  EXPECT_THAT(kinds, ElementsAre(Kind::spring, Kind::damper, Kind::damper, Kind::spring, Kind::motor));
  for (const std::size_t i : {3, 4}) {
    EXPECT_EQ(skeleton.points[skeleton.parts[i].from].name, "inertial");
    EXPECT_EQ(skeleton.points[skeleton.parts[i].to].name, "cart");
    EXPECT_EQ(skeleton.parts[i].slides, 1);
  }
  EXPECT_EQ(skeleton.parts[5].turns, 1);
  EXPECT_EQ(skeleton.points[skeleton.parts[7].to].name, "cart");
}

/// What turns about its own axis, and has a moment of inertia about it, is a disc of that moment; nothing else is.
TEST(Skeleton, ShowsWhatTurnsAboutItselfAsAWheel) {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "arm", Axis(0, 0, -1)});
  m.add(Link{"rod", "arm", "end", {1.0, 0.0, 0.0}});
  m.add(Revolute{"axle", "end", "rim", axisY});
  m.add(Mass{"rotor", "rim", 2.0, {0.0, 0.0, 0.0}, {0.02, 0.04, 0.02, 0.0, 0.0, 0.0}});
  m.add(Mass{"point", "arm", 2.0});
  m.add(Mass{"aside", "arm", 2.0, {0.1, 0.0, 0.0}, {0.02, 0.04, 0.02, 0.0, 0.0, 0.0}});
  m.add(Mass{"bob", "end", 2.0, {0.0, 0.0, 0.0}, {0.02, 0.04, 0.02, 0.0, 0.0, 0.0}});
  m.add(Mass{"drum", "arm", 0.5, {0.0, 0.0, 0.0}, {0.005, 0.005, 0.01, 0.0, 0.0, 0.0}});
  m.add(Motor{.name = "motor", .joint = "axle", .moment = 1.0});
  m.add(JointForce{"torque", "hinge", 2.0});
  const Skeleton skeleton = skeletonOf(m);
  std::vector<const Skeleton::Part*> wheels;
  for (const Skeleton::Part& part : skeleton.parts)
    if (part.kind == Kind::wheel) wheels.push_back(&part);
  ASSERT_EQ(wheels.size(), 2u);
  EXPECT_EQ(wheels[0]->name, "rotor");
  EXPECT_TRUE(contains(m.rangeOf(wheels[0]->radius), 0.2));  // m r²/2 = 0.04 kg m²
  EXPECT_LT(width(m.rangeOf(wheels[0]->radius)), 1e-15);
  EXPECT_EQ(wheels[1]->name, "drum");
  EXPECT_TRUE(contains(m.rangeOf(wheels[1]->radius), 0.2));
  std::vector<std::string> axes;
  for (const Skeleton::JointAxis& axis : skeleton.axes) axes.push_back(axis.name);
  EXPECT_THAT(axes, ElementsAre("hinge.axis", "axle.axis", "rotor.axle", "rotor.spoke", "drum.axle", "drum.spoke"));
  EXPECT_EQ(skeleton.axes[2].axis.index(), 1);
  EXPECT_EQ(skeleton.axes[3].axis.index(), 2);
  EXPECT_EQ(&skeleton.parts[skeleton.axes[4].part], wheels[1]);
}

/// A bar that is turned is not the same all around its axis; a frame that swings is not meant to turn.
TEST(Skeleton, ShowsBarsAndWhatSwingsAsNoWheels) {
  const auto wheels = [](const std::vector<Expression>& inertia, const std::vector<Described>& more) {
    Mechanism m;
    m.add(Revolute{"first", "inertial", "A", axisX});
    m.add(Link{"shaft", "A", "E", {0.5, 0.0, 0.0}});
    m.add(Revolute{"second", "E", "B", axisX});
    m.add(Revolute{"across", "B", "C", axisY});
    for (const char* frame : {"A", "B", "C"})
      m.add(Mass{
          std::string("of") + frame, frame, 1.0, {0.0, 0.0, 0.0}, {inertia[0], inertia[1], inertia[2], 0.0, 0.0, 0.0}});
    for (const Described& element : more) m.add(element);
    std::string names;
    for (const Skeleton::Part& part : skeletonOf(m).parts)
      if (part.kind == Kind::wheel) names += part.name + " ";
    return names;
  };
  const std::vector<Expression> ball{0.1, 0.1, 0.1}, bar{0.1, 0.1, 0.0}, disc{0.1, 0.05, 0.05};
  const Described spring = JointSpring{"spring", "first", 3.0, 0.0, 0.1}, motor = Motor{"motor", "first", 1.0},
                  drive = Drive{"drive", "first", Expression::parse("3 rad/s*t")},
                  gear = Coupling{"gear", "second", "across", 2.0};
  for (const std::vector<Expression>& inertia : {ball, disc}) EXPECT_EQ(wheels(inertia, {spring}), "");
  EXPECT_EQ(wheels(disc, {motor}), "ofA ofB ") << "what hangs on a shaft turns with it";
  EXPECT_EQ(wheels(disc, {drive}), "ofA ofB ");
  EXPECT_EQ(wheels(bar, {motor}), "");
  EXPECT_EQ(wheels(ball, {gear}), "ofB ofC ");
}

std::vector<Skeleton::Part> partsOfKind(const Skeleton& skeleton, Kind kind) {
  std::vector<Skeleton::Part> parts;
  for (const Skeleton::Part& part : skeleton.parts)
    if (part.kind == kind) parts.push_back(part);
  return parts;
}

std::vector<std::string> axesOfPart(const Skeleton& skeleton, const std::string& name) {
  std::vector<std::string> axes;
  for (const Skeleton::JointAxis& axis : skeleton.axes)
    if (skeleton.parts[axis.part].name == name) axes.push_back(axis.name);
  return axes;
}

TEST(Skeleton, ShowsFrictionThatIsThere) {
  Mechanism m;
  m.add(Prismatic{"slide", "inertial", "cart", axisY});
  m.add(Revolute{"hinge", "cart", "arm", axisX});
  m.add(JointFriction{"rubbing", "slide", 3.0});
  m.add(JointFriction{"oil", "hinge", 0.0, 0.1});
  m.add(SmoothedJointFriction{"brake", "hinge.angle", 2.0, 0.0, 0.01});
  m.add(JointFriction{"none", "hinge", 0.0, 0.0});
  const auto frictions = partsOfKind(skeletonOf(m), Kind::friction);
  ASSERT_EQ(frictions.size(), 3u);
  EXPECT_EQ(frictions[0].name, "rubbing");
  EXPECT_EQ(frictions[0].slides, 1);
  EXPECT_EQ(frictions[1].name, "oil");
  EXPECT_EQ(frictions[2].name, "brake");
  EXPECT_EQ(frictions[2].turns, 1);
}

/// Wheels tell of a gear where one body carries both joints, or where one turns and the other slides.
TEST(Skeleton, ShowsGearsAsWheelsWhereThoseTellWhatTheyDo) {
  Mechanism m;
  m.add(Revolute{"motor", "inertial", "M", axisX});
  m.add(Link{"housing", "inertial", "H", {0.0, 0.3, 0.0}});
  m.add(Revolute{"output", "H", "O", axisX});
  m.add(Revolute{"wrist", "O", "W", axisX});
  m.add(Prismatic{"rack", "inertial", "R", axisY});
  m.add(Prismatic{"follower", "inertial", "F", axisZ});
  m.add(Coupling{"pair", "output", "motor", -0.5});
  m.add(Coupling{"mimic", "wrist", "motor", 2.0});
  m.add(Coupling{"pinion", "rack", "motor", -0.04});
  m.add(Coupling{"lever", "follower", "rack", 3.0});
  const Skeleton skeleton = skeletonOf(m);
  const auto gears = partsOfKind(skeleton, Kind::gear);
  ASSERT_EQ(gears.size(), 4u);
  EXPECT_EQ(gears[0].turns, 2);
  EXPECT_EQ(skeleton.points[gears[0].from].name, "inertial");
  EXPECT_EQ(skeleton.points[gears[0].to].name, "H");
  EXPECT_TRUE(isEqual(m.rangeOf(gears[0].ratio), Interval(-0.5)));
  EXPECT_THAT(axesOfPart(skeleton, "pair"),
              ElementsAre("pair.motor.axle", "pair.motor.spoke", "pair.output.axle", "pair.output.spoke"));
  EXPECT_THAT(axesOfPart(skeleton, "mimic"), ElementsAre()) << "the wrist hangs on what the motor turns";
  EXPECT_THAT(axesOfPart(skeleton, "pinion"),
              ElementsAre("pinion.rack.axis", "pinion.motor.axle", "pinion.motor.spoke"));
  EXPECT_TRUE(isEqual(m.rangeOf(gears[2].radius), Interval(-0.04)));
  EXPECT_EQ(skeleton.points[gears[2].from].name, "R");
  EXPECT_EQ(skeleton.points[gears[2].to].name, "inertial");
  EXPECT_THAT(axesOfPart(skeleton, "lever"), ElementsAre());
}

TEST(Skeleton, ShowsThePlanesThatAreTouched) {
  Mechanism m;
  m.add(Prismatic{"slope", "inertial", "S", axisX});
  m.add(Free{.name = "flight", .from = "inertial", .to = "ball"});
  PlaneContact contact;
  contact.name = "floor";
  contact.from = "S";
  contact.to = "ball";
  contact.normal = Axis(0, 3, 4);
  contact.radius = 0.1;
  contact.stiffness = 100.0;
  contact.fromPoint = {0.0, 0.0, -1.0};
  m.add(contact);
  RollingWheel coin;
  coin.name = "coin";
  coin.from = "inertial";
  coin.to = "rim";
  coin.radius = 0.2;
  m.add(coin);
  const Skeleton skeleton = skeletonOf(m);
  const auto planes = partsOfKind(skeleton, Kind::plane), shapes = partsOfKind(skeleton, Kind::shape);
  ASSERT_EQ(planes.size(), 2u);
  EXPECT_EQ(skeleton.points[planes[0].from].name, "floor.from_point");
  EXPECT_EQ(skeleton.points[planes[0].to].name, "ball");
  EXPECT_THAT(axesOfPart(skeleton, "floor"), ElementsAre("floor.normal"));
  EXPECT_EQ(skeleton.points[planes[1].to].name, "rim");
  ASSERT_EQ(shapes.size(), 1u) << "a wheel is seen as that";
  EXPECT_EQ(shapes[0].name, "floor");
  EXPECT_EQ(shapes[0].from, planes[0].to);
}

/// Where a slide is driven and a speed is given: what stands still is no road, unless it may go.
TEST(Skeleton, ShowsARoadWhereADriveSaysSo) {
  Mechanism m;
  m.add(Prismatic{"lift", "inertial", "ground", axisZ});
  m.add(Prismatic{"slide", "ground", "cart", axisX});
  m.add(Revolute{"cam", "cart", "K", axisY});
  m.add(Drive{"road", "lift", Expression::parse("0.1 m*sin(3 rad/s*t)"), {5.0, Axis(-1, 0, 0)}});
  m.add(Drive{"shaker", "slide", Expression::parse("0.1 m*sin(3 rad/s*t)")});
  m.add(Drive{"turning", "cam", Expression::parse("3 rad/s*t")});
  m.addParameter("speed", Interval(0.0), "m/s");
  m.add(Prismatic{"post", "inertial", "top", Axis(0, 0, -2)});
  m.add(Drive{"standing", "post", Expression::parse("0.1 m*sin(3 rad/s*t)"), {Expression::parse("2*speed"), axisX}});
  const Skeleton skeleton = skeletonOf(m);
  const auto roads = partsOfKind(skeleton, Kind::profile);
  ASSERT_EQ(roads.size(), 1u);
  EXPECT_EQ(roads[0].name, "road");
  EXPECT_EQ(roads[0].height, "lift.displacement");
  EXPECT_EQ(skeleton.points[roads[0].to].name, "ground");
  EXPECT_TRUE(isEqual(m.rangeOf(roads[0].speed), Interval(5.0)));
  EXPECT_THAT(axesOfPart(skeleton, "road"), ElementsAre("road.up", "road.along"));
  const auto along = std::ranges::find(skeleton.axes, std::string("road.along"), &Skeleton::JointAxis::name);
  EXPECT_EQ(along->axis.direction()[0], -1);
  const auto uncertain = partsOfKind(skeletonOf(m, {"speed"}), Kind::profile);
  ASSERT_EQ(uncertain.size(), 2u);
  EXPECT_EQ(uncertain[1].name, "standing");
}

/// Two arms that a pin holds together at a point of one of them, and a rod from there to the ground.
TEST(Skeleton, ShowsWhereLoopsClose) {
  Mechanism m;
  m.add(Revolute{"left", "inertial", "L", axisZ, 0.5});
  m.add(Mass{"a", "L", 1.0, {1.0, 0.0, 0.0}});
  m.add(Link{"ground", "inertial", "G", {1.0, 0.0, 0.0}});
  m.add(Revolute{"right", "G", "R", axisZ, 2.0});
  m.add(Prismatic{"slide", "R", "S", axisX, 0.7});
  Closure pin;
  pin.name = "pin";
  pin.from = "S";
  pin.to = "L";
  pin.as = "pin";
  pin.toPoint = {0.8, 0.0, 0.0};
  m.add(pin);
  RodClosure rod;
  rod.name = "rod";
  rod.from = "L";
  rod.fromPoint = {0.8, 0.0, 0.0};
  rod.to = "inertial";
  rod.toPoint = {0.0, 1.0, 0.0};
  rod.dependent = {"left"};
  m.add(rod);
  const Skeleton skeleton = skeletonOf(m);
  const auto partsOf = [&](const std::string& name, Kind kind) {
    std::vector<Skeleton::Part> parts;
    for (const Skeleton::Part& part : skeleton.parts)
      if (part.name == name && part.kind == kind) parts.push_back(part);
    return parts;
  };
  EXPECT_THAT(namesOf(skeleton), ElementsAre("inertial", "a.centre", "G", "S", "pin.to", "rod.to"));
  const auto arms = partsOf("pin", Kind::rigid), pins = partsOf("pin", Kind::joint), rods = partsOf("rod", Kind::rigid),
             balls = partsOf("rod", Kind::joint);
  ASSERT_EQ(arms.size(), 2U);
  EXPECT_EQ(arms[0].from, arms[0].to);
  EXPECT_EQ(arms[1].to, 4U);
  ASSERT_EQ(pins.size(), 1U);
  EXPECT_EQ(pins[0].from, 4U);
  EXPECT_EQ(pins[0].turns, 1);
  EXPECT_EQ(std::ranges::count(skeleton.axes, std::string("pin.axis"), &Skeleton::JointAxis::name), 1);
  ASSERT_EQ(rods.size(), 3U);
  EXPECT_EQ(rods[2].from, 4U);
  EXPECT_EQ(rods[2].to, 5U);
  ASSERT_EQ(balls.size(), 2U);
  EXPECT_EQ(balls[1].from, 5U);
}

TEST(Skeleton, IsWhereTheAssemblyIs) {
  const Mechanism arm = spatialArm();
  const Skeleton skeleton = skeletonOf(arm);
  Assembly<double> assembly(arm);
  const std::vector<double> places = positionsOf(assembly, skeleton), velocities = velocitiesOf(assembly, skeleton),
                            axes = axesOf(assembly, skeleton);
  const auto expectAt = [&](const std::string& point, const std::string& quantity) {
    const auto names = namesOf(skeleton);
    const auto found = std::ranges::find(names, point);
    ASSERT_NE(found, names.end()) << point;
    const auto k = 3 * static_cast<std::size_t>(found - names.begin());
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_DOUBLE_EQ(places[k + i], assembly.output(quantity + ".position." + components[i])) << point;
      EXPECT_DOUBLE_EQ(velocities[k + i], assembly.output(quantity + ".velocity." + components[i])) << point;
    }
  };
  expectAt("E", "E");
  expectAt("column.centre", "column");
  expectAt("hand.centre", "hand");
  for (std::size_t a = 0; a + 3 <= axes.size(); a += 3)
    EXPECT_NEAR(std::hypot(axes[a], axes[a + 1], axes[a + 2]), 1, 1e-14);
}

TEST(Skeleton, OfStatesAloneIsEmpty) {
  Mechanism m;
  m.add(State{"prey", 1.0, Expression::parse("prey")});
  const Skeleton skeleton = skeletonOf(m);
  EXPECT_TRUE(skeleton.points.empty());
  EXPECT_TRUE(skeleton.parts.empty());
}

}  // namespace
}  // namespace gamut::testing
