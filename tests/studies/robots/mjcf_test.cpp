// Robots from MJCF: they are the robots that URDF says in other words, geoms weigh what formulas say, orientations are
// those of their five forms, and what cannot be taken is noted or refused by file and line.
#include <gmock/gmock.h>

#include <cmath>

#include "mechanics/assembly.hpp"
#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "studies/robots/robot.hpp"
#include "studies/study.hpp"
#include "tests/studies/robots/same_motion.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace mjcf_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

std::string inWorld(const std::string& bodies, const std::string& before = "") {
  return "<mujoco model=\"m\">\n" + before + "<worldbody>\n" + bodies + "</worldbody></mujoco>\n";
}

std::string complaintAbout(const std::string& text) {
  try {
    readRobotText(text, "r.xml");
  } catch (const StudyError& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    return error.what();
  }
  return "it was read";
}

/// Of a robot's file alone, and what a study says of it.
Mechanism mechanismOf(const std::string& robot, const std::string& rest = "") {
  const TemporaryFolder folder;
  folder.write("r.xml", robot);
  return readMechanismText("[mechanism]\nrobot = \"r.xml\"\n" + rest, folder.path("s.toml"));
}

// ---- The same robot in two formats ----------------------------------------------------------------------------------

/// Classes within classes, a childclass and a class of its own; Euler angles about axes that stay, as rpy are.
constexpr const char* armInMjcf = R"(<mujoco model="arm">
  <compiler angle="radian" eulerseq="XYZ"/>
  <option gravity="0.5 0 -9.81"/>
  <default>
    <joint damping="0.1"/>
    <default class="big">
      <default class="bigger"><joint axis="0 1 0"/></default>
      <joint damping="0.4"/>
    </default>
    <default class="sliding"><joint type="slide" damping="3"/></default>
  </default>
  <worldbody>
    <light pos="0 0 3"/>
    <body name="upper" pos="0 0 1" euler="0.2 -0.3 0.4" childclass="bigger">
      <inertial pos="0.1 0 -0.2" euler="0 0 0.5" mass="2.5" diaginertia="0.04 0.05 0.03"/>
      <joint name="shoulder" range="-2 2"/>
      <body name="lower" pos="0 0 -0.5" euler="1.25 0 0" childclass="main">
        <inertial pos="0 0.02 -0.25" mass="1.5" fullinertia="0.03 0.031 0.02 0.001 -0.0002 0.0003"/>
        <joint name="elbow" axis="0.6 0 0.8" frictionloss="0.05"/>
        <body name="slide" pos="0.1 0 0">
          <inertial pos="0 0 0.1" mass="0.5" diaginertia="0.001 0.001 0.001"/>
          <joint class="sliding" name="ram"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="elbow"/></actuator>
</mujoco>)";

TEST(Mjcf, MovesAsTheSameRobotInUrdf) {
  const Mechanism urdf = mechanismOf(armInUrdf, "gravity = [0.5, 0, -9.81]\n"), mjcf = mechanismOf(armInMjcf);
  expectSameMotion(urdf, mjcf, {0.4, -0.7, 0.05, 0.3, 1.0, -0.6});
  expectSameMotion(urdf, mjcf, {-2.0, 3.0, 0.5, -4.0, 0.25, 2.0});
}

TEST(Mjcf, NotesWhatItLeavesOutByFileAndLine) {
  const Robot robot = readRobotText(armInMjcf, "r.xml");
  EXPECT_THAT(robot.notes,
              ElementsAre("r.xml:13: note: <light>: left out, as they say nothing of how bodies and joints "
                          "move",
                          "r.xml:27: note: <actuator>: left out; what drives and touches is stated by "
                          "elements of the study",
                          "r.xml:16: note: 'range': kept for information; motions may go beyond"));
  EXPECT_EQ(robot.joints[0].limits->upper, 2);
  const Robot other =
      readRobotText(inWorld("<body name=\"a\" zzz=\"1\"><joint/><geom size=\"1\"/><site/></body>\n",
                            "<tendon/>\n<equality><weld body1=\"a\"/></equality>\n<keyframe/>\n<contact/>\n"),
                    "r.xml");
  const std::string all = ::testing::PrintToString(other.notes);
  EXPECT_THAT(all, HasSubstr("r.xml:2: note: <contact>, <tendon>: left out"));
  EXPECT_THAT(all, HasSubstr("r.xml:3: note: <weld> of <equality>: left out"));
  EXPECT_THAT(all, HasSubstr("r.xml:4: note: <keyframe>, <site>: left out"));
  EXPECT_THAT(all, HasSubstr("r.xml:7: note: 'zzz' of <body>: left out, as it is not known here"));
}

/// A joint that stands at p in its body, whose centre is at c, turns as one at the body's origin with its centre at
/// c − p and all that it carries likewise.
TEST(Mjcf, TurnsThroughTheAnchorOfAJoint) {
  const std::string inertia = "mass=\"2\" diaginertia=\"0.1 0.2 0.15\"";
  const auto arm = [&](const std::string& place, const std::string& joint, const std::string& centre,
                       const std::string& next) {
    return inWorld("<body name=\"a\" pos=\"" + place + "\"><joint name=\"j\" axis=\"1 2 2\" " + joint +
                   "/><inertial pos=\"" + centre + "\" " + inertia + "/><body name=\"b\" pos=\"" + next +
                   "\"><joint name=\"k\" axis=\"1 0 0\"/><inertial pos=\"0.25 0 0.5\" " + inertia + "/></body></body>");
  };
  expectSameMotion(mechanismOf(arm("1 2 3", "pos=\"0.5 -0.25 0.125\"", "0.75 0 0", "0 1 0")),
                   mechanismOf(arm("1.5 1.75 3.125", "", "0.25 0.25 -0.125", "-0.5 1.25 -0.125")),
                   {0.4, -0.7, 1.3, 0.8});
}

/// One behind the other, the first one next to what carries the body, each about an axis that those before have turned.
TEST(Mjcf, HasSeveralJointsInABody) {
  const Mechanism mjcf =
      mechanismOf(inWorld("<body name=\"a\" pos=\"0 0 1\"><joint name=\"x\" type=\"slide\" axis=\"1 0 0\"/>"
                          "<joint name=\"j\" axis=\"0 1 0\"/><joint name=\"k\" axis=\"1 0 0\" pos=\"0 0.5 0\"/>"
                          "<inertial pos=\"0.1 0.2 -0.3\" mass=\"2\" diaginertia=\"0.1 0.2 0.15\"/></body>"));
  const auto n = [](const char* decimal) { return Expression(Interval(decimal)); };
  Mechanism made;
  made.add(Link{"up", "inertial", "O", {0.0, 0.0, 1.0}});
  made.add(Prismatic{"x", "O", "X", axisX});
  made.add(Revolute{"j", "X", "J", axisY});
  made.add(Link{"out", "J", "J2", {0.0, 0.5, 0.0}});
  made.add(Revolute{"k", "J2", "K", axisX});
  made.add(Mass{"m", "K", 2.0, {n("0.1"), n("-0.3"), n("-0.3")}, {n("0.1"), n("0.2"), n("0.15"), 0.0, 0.0, 0.0}});
  made.setGravity({0.0, 0.0, n("-9.81")});
  expectSameMotion(mjcf, made, {0.2, 0.7, -0.4, 1.5, 0.5, -2.0});
}

/// q̈ = (−d q̇ − k (q − q₀)) / (I + a); of a slide m + a. Angles of the file are degrees, 'ref' shifts where they count
/// from.
TEST(Mjcf, HasSpringsArmatureAndReferences) {
  const auto acceleration = [](const std::string& joint, double q, double rate, const std::string& rest = "") {
    const Mechanism m = mechanismOf(inWorld("<body name=\"a\"><joint name=\"j\" axis=\"0 0 1\" " + joint +
                                            "/><inertial pos=\"0 0 0\" mass=\"2\" diaginertia=\"1 1 1.5\"/></body>"),
                                    "gravity = [0, 0, 0]\n" + rest);
    Evaluator<double> motion(recordMotion(m));
    return motion(0, {q, rate})[1];
  };
  const double degree = 3.14159265358979323846 / 180;
  const std::string hinge = "stiffness=\"3\" springref=\"30\" damping=\"0.25\" armature=\"0.5\"";
  EXPECT_NEAR(acceleration(hinge, 1, 2), (-0.25 * 2 - 3 * (1 - 30 * degree)) / 2, 1e-14);
  EXPECT_NEAR(acceleration(hinge + " ref=\"20\"", 1, 2), (-0.25 * 2 - 3 * (1 - 10 * degree)) / 2, 1e-14);
  EXPECT_NEAR(acceleration(hinge, 1, 2, "springs = false"), -0.25, 1e-14);
  EXPECT_NEAR(acceleration("type=\"slide\" stiffness=\"3\" springref=\"0.5\" armature=\"0.5\"", 1, 2),
              -3 * (1 - 0.5) / 2.5, 1e-14);
}

TEST(Mjcf, HasBallsFreeBodiesAndItsOwnGravity) {
  const std::string inertial = "<inertial pos=\"0 0 -1\" mass=\"2\" diaginertia=\"1 1 1.5\"/>";
  const Mechanism m =
      mechanismOf(inWorld("<body name=\"top\" pos=\"0 0 1\"><joint type=\"ball\" name=\"b\"/>" + inertial +
                          "</body><body name=\"stone\"><freejoint/>" + inertial + "</body>"));
  EXPECT_EQ(m.degreesOfFreedom(), 9);
  EXPECT_TRUE(isEqual(m.nominal("gravity.z"), Interval("-9.81")));
  EXPECT_TRUE(isEqual(
      mechanismOf(inWorld("<body><joint/>" + inertial + "</body>"), "gravity = [0, 0, -1]\n").nominal("gravity.z"),
      Interval(-1.0)));
  EXPECT_TRUE(isEqual(
      mechanismOf(inWorld("<body><joint/>" + inertial + "</body>", "<option><flag gravity=\"disable\"/></option>"))
          .nominal("gravity.z"),
      Interval(0.0)));
  const std::vector<std::string> names = m.stateNames();
  EXPECT_EQ(std::ranges::count(names, "stone.joint.position.x"), 1) << ::testing::PrintToString(names);
}

TEST(Mjcf, HasJointsThatFollowOthers) {
  const std::string body = "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>";
  const std::string fingers = "<body name=\"a\"><joint name=\"left\"/>" + body +
                              "</body><body name=\"b\"><joint name=\"right\"/>" + body + "</body>";
  const auto withEquality = [&](const std::string& equality) {
    return inWorld(fingers, "<equality>\n<joint " + equality + "/></equality>");
  };
  const Mechanism m = mechanismOf(withEquality("joint1=\"right\" joint2=\"left\" polycoef=\"0.125 -1.5 0 0 0\""),
                                  "[mechanism.initial]\nleft.angle = 0.5\n");
  EXPECT_EQ(m.degreesOfFreedom(), 1);
  EXPECT_DOUBLE_EQ(Assembly<double>(m).output("right.angle"), -1.5 * 0.5 + 0.125);
  EXPECT_EQ(mechanismOf(inWorld(fingers,
                                "<default class=\"all\"><joint damping=\"2\"/><equality active=\"false\"/>"
                                "</default><equality><joint joint1=\"right\" joint2=\"left\"/></equality>"))
                .nominal("right.damping")
                .lower(),
            2)
      << "of the outermost class, whatever its name; and equalities have defaults of their own";
  EXPECT_EQ(mechanismOf(withEquality("joint1=\"right\" joint2=\"left\" active=\"false\"")).degreesOfFreedom(), 2);
  EXPECT_THAT(complaintAbout(withEquality("joint1=\"right\" joint2=\"left\" polycoef=\"0 1 0.5\"")),
              StartsWith("r.xml:3: 'right' follows another joint along a curve"));
  EXPECT_THAT(complaintAbout(withEquality("joint1=\"rihgt\" joint2=\"left\"")),
              StartsWith("r.xml:3: there is no joint 'rihgt'; expected 'right'"));
  EXPECT_THAT(complaintAbout(withEquality("joint1=\"right\" joint2=\"right\"")),
              StartsWith("r.xml:3: 'right' follows joints that follow one another in a circle"));
}

// ---- What geoms weigh -----------------------------------------------------------------------------------------------

/// Whether the enclosure holds this number, and hardly more.
void expectEncloses(const Interval& enclosure, const char* number, const std::string& what) {
  EXPECT_FALSE(isDisjoint(enclosure, Interval(number))) << what << ' ' << enclosure << ' ' << number;
  EXPECT_LE(width(enclosure), 1e-14 * (1 + magnitude(enclosure))) << what;
}

Robot::Inertial inertialOf(const std::string& geoms, const std::string& before = "") {
  const Robot robot = readRobotText(inWorld("<body name=\"a\"><freejoint/>" + geoms + "</body>", before), "r.xml");
  return robot.links.at(1).inertial.value();
}

struct OfOneGeom {
  const char *type, *size, *volume, *across, *other, *along;  // moments of 1 kg
};

/// By integrals over discs, to fifty digits.
TEST(MjcfGeoms, WeighWhatTheirFormulasSay) {
  const OfOneGeom geoms[] = {
      {"sphere", "0.1", "0.004188790204786390984616857844372670512263", "0.004", "0.004", "0.004"},
      {"capsule", "0.1 0.3", "0.02303834612632515041539271814404968781745", "0.04777272727272727272727272727272727",
       "0.04777272727272727272727272727272727", "0.004818181818181818181818181818181818"},
      {"cylinder", "0.1 0.3", "0.01884955592153875943077586029967701730518", "0.0325", "0.0325", "0.005"},
      {"ellipsoid", "0.1 0.2 0.3", "0.02513274122871834590770114706623602307358", "0.026", "0.02", "0.01"},
      {"box", "0.1 0.2 0.3", "0.048", "0.043333333333333333333333333333333", "0.033333333333333333333333333333333",
       "0.016666666666666666666666666666667"}};
  for (const OfOneGeom& geom : geoms) {
    const std::string text = std::string("<geom type=\"") + geom.type + "\" size=\"" + geom.size + "\" ";
    const Robot::Inertial one = inertialOf(text + "mass=\"1\"/>"), dense = inertialOf(text + "density=\"1\"/>"),
                          water = inertialOf(text + "/>");
    expectEncloses(one.inertia[0], geom.across, geom.type);
    expectEncloses(one.inertia[1], geom.other, geom.type);
    expectEncloses(one.inertia[2], geom.along, geom.type);
    for (std::size_t i = 3; i < 6; ++i) EXPECT_TRUE(isEqual(one.inertia[i], Interval(0.0))) << geom.type;
    expectEncloses(dense.mass, geom.volume, geom.type);
    EXPECT_FALSE(isDisjoint(water.mass, Interval(1000.0) * Interval(geom.volume))) << geom.type;
    EXPECT_FALSE(isDisjoint(water.inertia[0], water.mass * Interval(geom.across))) << geom.type;
  }
}

TEST(MjcfGeoms, AddUpAboutTheCommonCentre) {
  const Robot::Inertial whole = inertialOf(
      "<geom type=\"sphere\" size=\"0.1\" pos=\"0.1 0.2 -0.3\" density=\"500\"/>"
      "<geom type=\"box\" size=\"0.1 0.2 0.3\" pos=\"0 -0.1 0.2\" axisangle=\"1 2 2 0.7\" mass=\"3\"/>"
      "<geom type=\"mesh\" mesh=\"skin\" mass=\"0\"/><geom type=\"plane\" size=\"1 1 1\"/>",
      "<compiler angle=\"radian\"/>");
  expectEncloses(whole.mass, "5.094395102393195492308428922186335256131", "mass");
  const char* centre[] = {"0.04111175243179137963409623872756255888503", "0.02333525729537413890228871618268767665509",
                          "-0.00555876215895689817048119363781279442515"};
  for (std::size_t i = 0; i < 3; ++i) expectEncloses(whole.place.xyz[i], centre[i], "centre");
  const char* inertia[] = {"0.5348830343449883198056472131658397263931", "0.4354038557332824751464476318703287915686",
                           "0.1981926522180665232716273153088812416974", "-0.02291445174933789232018604249802997672245",
                           "0.184342485398288088907466605396637847106",  "0.03177648864631655816905062033132206136274"};
  for (std::size_t i = 0; i < 6; ++i) expectEncloses(whole.inertia[i], inertia[i], "inertia");
}

TEST(MjcfGeoms, LieBetweenTwoPoints) {
  const Robot::Inertial rod =
      inertialOf("<geom type=\"capsule\" size=\"0.05\" fromto=\"0.1 0 0 0.3 -0.2 0.1\" mass=\"2\"/>");
  const char* centre[] = {"0.2", "-0.1", "0.05"};
  for (std::size_t i = 0; i < 3; ++i) expectEncloses(rod.place.xyz[i], centre[i], "centre");
  const char* inertia[] = {"0.01434090909090909090909090909090909090909",
                           "0.01434090909090909090909090909090909090909",
                           "0.0215",
                           "0.009545454545454545454545454545454545454545",
                           "0.004772727272727272727272727272727272727273",
                           "-0.004772727272727272727272727272727272727273"};
  // Products of the components: x y is −, y z is −, z x is +, of (−0.2, 0.2, −0.1) times Iz − Ix < 0.
  expectEncloses(rod.inertia[0], inertia[0], "xx");
  expectEncloses(rod.inertia[1], inertia[1], "yy");
  expectEncloses(rod.inertia[2], inertia[2], "zz");
  expectEncloses(rod.inertia[3], inertia[3], "xy");
  expectEncloses(rod.inertia[4], inertia[4], "yz");
  expectEncloses(rod.inertia[5], inertia[5], "zx");
}

TEST(MjcfGeoms, StandInFrames) {
  const std::string geom = "type=\"box\" size=\"0.1 0.2 0.3\" mass=\"3\"";
  const Robot::Inertial plain = inertialOf("<geom " + geom + " pos=\"1 2.25 3\" euler=\"90 0 0\"/>"),
                        framed = inertialOf("<frame pos=\"1 2 3\" euler=\"90 0 0\"><geom " + geom +
                                            " pos=\"0 0 -0.25\"/></frame>");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(isEqual(plain.place.xyz[i], framed.place.xyz[i])) << i;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE(isEqual(plain.inertia[i], framed.inertia[i])) << i;
  const Mechanism body = mechanismOf(inWorld(
      "<frame name=\"f\" pos=\"1 0 0\" euler=\"0 0 90\"><body name=\"b\" pos=\"0 2 0\"><joint name=\"j\"/><geom " +
      geom + "/></body></frame>"));
  EXPECT_DOUBLE_EQ(Assembly<double>(body).output("b.position.x"), -1.0);
  EXPECT_TRUE(isEqual(body.nominal("f.frame.x"), Interval(1.0)));
}

TEST(MjcfGeoms, HaveOneTotalMassIfTheFileSaysSo) {
  const Robot robot = readRobotText(
      inWorld("<body name=\"a\"><joint/><geom type=\"box\" size=\"0.1 0.1 0.1\" mass=\"1\"/><body name=\"b\"><joint/>"
              "<inertial pos=\"0 0 0\" mass=\"3\" diaginertia=\"1 1 1\"/></body></body>",
              "<compiler settotalmass=\"10\"/>"),
      "r.xml");
  EXPECT_TRUE(isEqual(robot.links[1].inertial->mass, Interval(2.5)));
  EXPECT_TRUE(isEqual(robot.links[2].inertial->inertia[0], Interval(2.5)));
  const Robot geoms = readRobotText(
      inWorld("<body><joint/><inertial pos=\"0 0 0\" mass=\"3\"/><geom size=\"1\" mass=\"2\" group=\"1\"/>"
              "<geom size=\"1\" mass=\"5\" group=\"3\"/></body>",
              "<compiler inertiafromgeom=\"true\" inertiagrouprange=\"0 2\"/>"),
      "r.xml");
  EXPECT_TRUE(isEqual(geoms.links[1].inertial->mass, Interval(2.0)));
  EXPECT_EQ(geoms.links[1].name, "body1");
}

TEST(MjcfGeoms, AreShapesIfTheyAreAskedFor) {
  const std::string text = inWorld(
      "<geom type=\"plane\" size=\"1 1 1\"/>\n<body name=\"a\"><freejoint/><geom type=\"capsule\" size=\"0.05\" "
      "fromto=\"0 0 0 0 0.5 0\"/><geom type=\"box\" size=\"1 2 3\"/><geom size=\"1\" contype=\"0\" "
      "conaffinity=\"0\"/>\n<geom type=\"cylinder\" size=\"1 2\"/></body>");
  const Robot robot = readRobotText(text, "r.xml", true);
  ASSERT_EQ(robot.links[1].shapes.size(), 3U);
  EXPECT_EQ(robot.links[1].shapes[0].kind, Robot::Shape::Kind::capsule);
  EXPECT_FALSE(isDisjoint(robot.links[1].shapes[0].length, Interval(0.5)));
  EXPECT_TRUE(isEqual(robot.links[1].shapes[1].size[2], Interval(6.0)));
  EXPECT_THAT(::testing::PrintToString(robot.notes), HasSubstr("r.xml:5: note: <geom> (cylinder): taken as capsules"));
  EXPECT_THAT(::testing::PrintToString(robot.notes), HasSubstr("r.xml:3: note: <geom> (plane): left out of what"));
}

// ---- Places ---------------------------------------------------------------------------------------------------------

/// Where (1, 2, 3) of a body lies.
std::array<double, 3> tipOf(const std::string& orientation, const std::string& compiler) {
  const Mechanism m = mechanismOf(inWorld(
      "<body name=\"a\" " + orientation + "><body name=\"tip\" pos=\"1 2 3\"><joint/><geom size=\"1\"/></body></body>",
      compiler));
  Assembly<Interval> assembly(m);
  std::array<double, 3> tip{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval x = assembly.output(std::string("tip.position.") + components[i]);
    EXPECT_LE(width(x), 1e-13);
    tip[i] = midpoint(x);
  }
  return tip;
}

/// One rotation, by 0.7 rad about (1, 2, 2), in all forms; its numbers to fifty digits.
TEST(MjcfPlaces, HaveOrientationsInFiveForms) {
  const char* radians = "<compiler angle=\"radian\"/>";
  const std::pair<const char*, const char*> forms[] = {
      {"quat=\"0.9393727128473789200350324 0.114299269151817116396545 0.2285985383036342327930899 "
       "0.2285985383036342327930899\"",
       ""},
      {"quat=\"-1.878745425694757840070065 -0.22859853830363423279309 -0.4571970766072684655861798 "
       "-0.4571970766072684655861798\"",
       ""},
      {"axisangle=\"1 2 2 0.7\"", radians},
      {"axisangle=\"-0.5 -1 -1 -40.10704565915762617\"", ""},
      {"xyaxes=\"0.7909708331417674900052089 0.4817357498730188299471073 -0.3772211664439025749497118 "
       "-0.3772211664439025749497118 0.8693567707136046812532556 0.3192538125083466062216003\"",
       ""},
      {"xyaxes=\"1.58194166628353498001 0.9634714997460376598942 -0.7544423328878051498994 0.4137496666978649150555 "
       "1.3510925205866235112004 -0.0579673539355559687281\"",
       ""},
      {"euler=\"0.1261158215611901703652246 0.5026343704019527674505415 0.4450048154191145686076967\"", radians},
      {"euler=\"7.22590430528118540411785 28.79882806224723625056676 25.4968977865134841952174\"", ""},
      {"euler=\"0.3519412001418254577637574 0.3867939552504632268081784 0.5470427077126666203875961\"",
       "<compiler angle=\"radian\" eulerseq=\"XYZ\"/>"}};
  for (const auto& [form, compiler] : forms) {
    SCOPED_TRACE(form);
    const std::array<double, 3> tip = tipOf(form, compiler);
    EXPECT_NEAR(tip[0], 1.481735749873018829947, 1e-14);
    EXPECT_NEAR(tip[1], 1.889775354349885903773, 1e-14);
    EXPECT_NEAR(tip[2], 2.869356770713604681253, 1e-14);
  }
}

/// z goes there by the least turn, about an axis square to both.
TEST(MjcfPlaces, TurnZToAnAxis) {
  for (const auto& [x, y, z] : {std::array{1.0, 2.0, 2.0}, {-0.5, 0.25, -4.0}, {0.0, 3.0, 0.0}, {1e-9, 0.0, -1.0}}) {
    const auto at = [&](const std::string& point) {
      const Mechanism m = mechanismOf(inWorld(
          "<body zaxis=\"" + std::to_string(x * 1e9) + " " + std::to_string(y * 1e9) + " " + std::to_string(z * 1e9) +
          "\"><body name=\"tip\" pos=\"" + point + "\"><joint/><geom size=\"1\"/></body></body>"));
      Assembly<double> assembly(m);
      return std::array{assembly.output("tip.position.x"), assembly.output("tip.position.y"),
                        assembly.output("tip.position.z")};
    };
    const double length = std::sqrt(x * x + y * y + z * z), across = std::hypot(x, y);
    const std::array<double, 3> top = at("0 0 1");
    EXPECT_NEAR(top[0], x / length, 1e-14);
    EXPECT_NEAR(top[1], y / length, 1e-14);
    EXPECT_NEAR(top[2], z / length, 1e-14);
    // What lies on the axis of the turn, z × (x, y, z), stays.
    const std::string axis = std::to_string(-y / across) + " " + std::to_string(x / across) + " 0";
    const std::array<double, 3> still = at(axis);
    EXPECT_NEAR(still[0], std::stod(std::to_string(-y / across)), 1e-6);
    EXPECT_NEAR(still[1], std::stod(std::to_string(x / across)), 1e-6);
    EXPECT_NEAR(still[2], 0, 1e-6);
  }
}

TEST(MjcfPlaces, HaveExactRightAngles) {
  const auto nodes = [](const std::string& orientation) {
    return recordMotion(mechanismOf(inWorld("<body name=\"a\" " + orientation +
                                            "><joint axis=\"1 0 0\"/><inertial pos=\"0 0 1\" mass=\"1\" "
                                            "diaginertia=\"1 1 1\"/></body>")))
        .nodes()
        .size();
  };
  EXPECT_EQ(nodes("euler=\"90 0 0\""), nodes("quat=\"0.7071068 0.7071068 0 0\""));
  EXPECT_EQ(tipOf("euler=\"0 90 0\"", ""), (std::array{3.0, 2.0, -1.0}));
  EXPECT_EQ(tipOf("quat=\"0.707 0 -0.707 0\"", ""), (std::array{-3.0, 2.0, 1.0}));
  EXPECT_EQ(tipOf("quat=\"0 0 0 -2\"", ""), (std::array{-1.0, -2.0, 3.0}));
  EXPECT_EQ(tipOf("quat=\"5 0 0 0\"", ""), (std::array{1.0, 2.0, 3.0}));
}

// ---- Several files --------------------------------------------------------------------------------------------------

TEST(MjcfFiles, IncludeOthersWhichTheResultsHold) {
  const TemporaryFolder folder;
  folder.write("r.xml", inWorld("<include file=\"arm.xml\"/>", "<include file=\"more.xml\"/>\n"));
  folder.write("more.xml", "<mujoco><compiler angle=\"radian\"/>\n<visual/></mujoco>");
  folder.write("arm.xml",
               "<mujocoinclude>\n<body name=\"a\">\n<joint name=\"j\" springref=\"0.5\" stiffness=\"1\"/>"
               "<geom size=\"1\"/></body></mujocoinclude>");
  const std::string text = textOfRobot(folder.path("r.xml"));
  EXPECT_THAT(text, StartsWith("{"));
  const std::string study = "[mechanism]\nrobot = \"r.xml\"\n";
  const Mechanism read = readMechanismText(study, folder.path("s.toml"));
  EXPECT_TRUE(isEqual(read.nominal("j.rest"), Interval(0.5)));
  const Robot robot = readRobotText(text, folder.path("r.xml"));
  EXPECT_EQ(robot.links[1].name, "a");
  EXPECT_THAT(::testing::PrintToString(robot.notes), HasSubstr("more.xml:2: note: <visual>"));

  folder.write("arm.xml", "<mujocoinclude>\n<body name=\"a\">\n<joint type=\"hingge\"/></body></mujocoinclude>");
  EXPECT_THAT(complaintAbout(textOfRobot(folder.path("r.xml"))), StartsWith("arm.xml:3: 'type' of <joint> is"));
  folder.write("arm.xml", "<mujocoinclude><include file=\"r2.xml\"/></mujocoinclude>");
  try {
    textOfRobot(folder.path("r.xml"));
    ADD_FAILURE();
  } catch (const StudyError& error) {
    EXPECT_THAT(error.what(), HasSubstr("arm.xml:1: " + folder.path("r2.xml") + ": does not exist"));
  }
  folder.write("arm.xml", "<mujocoinclude>\n<include file=\"arm.xml\"/></mujocoinclude>");
  EXPECT_THAT(complaintAbout(textOfRobot(folder.path("r.xml"))),
              StartsWith("arm.xml:2: 'arm.xml' is included a second time"));
}

// ---- Hostile files --------------------------------------------------------------------------------------------------

TEST(HostileMjcf, IsRefusedInOneLine) {
  const auto expect = [](const std::string& text, const std::string& what) {
    EXPECT_THAT(complaintAbout(text), StartsWith("r.xml:" + what));
  };
  const auto expectOf = [&](const std::string& inBody, const std::string& what, const std::string& before = "") {
    expect(inWorld("<body name=\"a\">\n" + inBody + "</body>", before), what);
  };
  const std::string geom = "<geom size=\"1\"/>", joint = "<joint name=\"j\"/>";
  expect("<mujoco/>", "1: there is no <body> in <worldbody>; expected one at least");
  expect("<mujoco><worldbody><joint/></worldbody></mujoco>", "1: there is a <joint> in <worldbody>");
  expectOf("<joint type=\"ballz\"/>", "4: 'type' of <joint> is \"ballz\"; expected 'ball'");
  expectOf("<joint axis=\"0 0 0\"/>" + geom, "4: 'axis' of <joint> is the zero vector");
  expectOf("<joint class=\"none\"/>" + geom, "4: there is no default class 'none'");
  expectOf("<joint type=\"ball\" damping=\"1\"/>" + geom, "4: the damping of 'a.joint', a ball joint, is not 0");
  expectOf("<joint springdamper=\"1 1\"/>" + geom, "4: 'springdamper' follows from inertia");
  expectOf("<joint damping=\"-1\"/>" + geom, "4: the damping of 'a.joint' is negative");
  expectOf(joint + joint + geom, "4: there is a joint 'j' already");
  expectOf(joint + "<geom type=\"mesh\" mesh=\"m\"/>", "4: 'a' weighs what a mesh does, which is not read");
  expectOf(joint + "<geom type=\"box\" size=\"1 1\"/>", "4: 'size' of <geom> has 2 numbers; expected 3 decimal");
  expectOf(joint + "<geom size=\"0\"/>", "4: a size of a geom is not positive");
  expectOf(joint + "<geom size=\"1\" shellinertia=\"true\"/>", "4: the mass of a geom lies on its surface");
  expectOf(joint + "<geom type=\"capsule\" size=\"1\" fromto=\"1 1 1 1 1 1\"/>", "4: the ends of a geom are one point");
  expectOf(joint + "<inertial mass=\"1\"/>", "4: <inertial> has no 'pos'");
  expectOf(joint + "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 3\"/>",
           "4: the inertia of 'a' has a principal");
  expectOf(joint + "<inertial pos=\"0 0 0\" mass=\"1\" fullinertia=\"1 1 1 0 0 0\" quat=\"1 0 0 0\"/>",
           "4: 'quat' beside 'fullinertia'");
  expectOf(joint + geom + "<body><freejoint/></body>", "4: 'body2' is free, but stands in a body that moves");
  expectOf(joint + geom + "<composite/>", "4: <composite> makes bodies, which only MuJoCo does");
  expectOf(joint + geom + "<body quat=\"0 0 0 0\"/>", "4: the quaternion is zero");
  expectOf(joint + geom + "<body quat=\"1 0 0 0\" euler=\"0 0 0\"/>", "4: 'euler' beside 'quat'; expected one");
  expectOf(joint + geom + "<body xyaxes=\"1 0 0 2 0 0\"/>", "4: the two axes are on one line");
  expectOf(joint + geom + "<body pos=\"0 0 1e999\"/>", "4: 'pos' of <body> is \"0 0 1e999\"");
  expectOf(joint + geom + "<body pos=\"0 0 1e305\" euler=\"1e305 0 0\"/>", "4: ");
  expectOf(joint + geom + "<body name=\"a\"/>", "4: there is a body 'a' already");
  expectOf(joint + geom, "2: the coordinates are global", "<compiler coordinate=\"global\"/>");
  expectOf(joint + geom, "2: 'eulerseq' is \"xy\"", "<compiler eulerseq=\"xy\"/>");
  expectOf(joint + geom, "2: 'boundmass' is given", "<compiler boundmass=\"1\"/>");
  expectOf(joint + geom, "2: there is a medium, as its density is not 0", "<option density=\"1.2\"/>");
  expectOf(joint + geom, "2: 'x.xml' is included, but not there", "<include file=\"x.xml\"/>");
  EXPECT_THAT(complaintAbout(inWorld("<body gravcomp=\"1\"><joint/><geom size=\"1\"/></body>")),
              StartsWith("r.xml:3: the weight of 'body1' is compensated"));
  std::string many;
  for (int i = 0; i < 1200; ++i) many += "<body/>\n";
  expect(inWorld(many), "1003: there are too many bodies; expected at most 1000");
}

TEST(HostileMjcf, StandsWhereItStands) {
  const TemporaryFolder folder;
  folder.write("r.xml", inWorld("<body><joint/><geom size=\"1\"/></body>"));
  try {
    readMechanismText("[mechanism]\nrobot = \"r.xml\"\nbase = \"free\"", folder.path("s.toml"));
    ADD_FAILURE();
  } catch (const StudyError& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.toml:3:8: mechanism.base is \"free\", but the robot's file says itself"));
  }
  try {
    readMechanismText("[mechanism]\nrobot = \"r.xml\"\nurdf = \"r.xml\"", folder.path("s.toml"));
    ADD_FAILURE();
  } catch (const StudyError& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.toml:3:8: 'urdf' beside 'robot'"));
  }
}

}  // namespace mjcf_test
}  // namespace gamut
