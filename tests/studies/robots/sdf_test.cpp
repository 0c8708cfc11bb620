// Robots from SDFormat: they are the robots that URDF and MJCF say in other words, wherever poses are stated and in
// whichever frame axes are, and what cannot be taken is noted or refused by file and line.
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
namespace sdf_test {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Mechanism mechanismOf(const std::string& robot, const std::string& rest = "") {
  const TemporaryFolder folder;
  folder.write("r.sdf", robot);
  return readMechanismText("[mechanism]\nrobot = \"r.sdf\"\n" + rest, folder.path("s.toml"));
}

std::string axis(const std::string& xyz, const std::string& dynamics = "", const std::string& in = "") {
  return "<axis><xyz" + (in.empty() ? "" : " expressed_in='" + in + "'") + ">" + xyz + "</xyz><dynamics>" + dynamics +
         "</dynamics></axis>";
}
std::string joint(const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& rest) {
  return "<joint name='" + name + "' type='" + type + "'><parent>" + parent + "</parent><child>" + child + "</child>" +
         rest + "</joint>\n";
}
std::string link(const std::string& name, const std::string& pose, const std::string& inertial) {
  return "<link name='" + name + "'>" + pose + "<inertial>" + inertial + "</inertial></link>\n";
}

std::string arm(const std::string& upper, const std::string& lower, const std::string& slide,
                const std::string& elbow = "", const std::string& elbowAxis = "", const std::string& more = "") {
  return "<sdf version='1.9'><world name='w'><gravity>0.5 0 -9.81</gravity><model name='arm'>\n" + more +
         link("upper", upper,
              "<pose>0.1 0 -0.2 0 0 0.5</pose><mass>2.5</mass><inertia><ixx>0.04</ixx><iyy>0.05</iyy><izz>0.03</izz>"
              "</inertia>") +
         link("lower", lower,
              "<pose>0 0.02 -0.25 0 0 0</pose><mass>1.5</mass><inertia><ixx>0.03</ixx><iyy>0.031</iyy><izz>0.02</izz>"
              "<ixy>0.001</ixy><iyz>0.0003</iyz><ixz>-0.0002</ixz></inertia>") +
         link("slide", slide,
              "<pose>0 0 0.1 0 0 0</pose><mass>0.5</mass><inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz>"
              "</inertia>") +
         joint("shoulder", "revolute", "world", "upper", axis("0 1 0", "<damping>0.4</damping>")) +
         joint("elbow", "continuous", "upper", "lower",
               elbow + (elbowAxis.empty() ? axis("0.6 0 0.8", "<damping>0.1</damping><friction>0.05</friction>")
                                          : elbowAxis)) +
         joint("ram", "prismatic", "lower", "slide", axis("0 0 1", "<damping>3</damping>")) + "</model></world></sdf>";
}

const std::vector<std::vector<double>> states = {{0.4, -0.7, 0.05, 0.3, 1.0, -0.6}, {-2.0, 3.0, 0.5, -4.0, 0.25, 2.0}};

TEST(Sdf, MovesAsTheSameRobotInUrdf) {
  const Mechanism urdf = mechanismOf(armInUrdf, "gravity = [0.5, 0, -9.81]\n");
  const std::string upper = "<pose>0 0 1 0.2 -0.3 0.4</pose>";
  const std::string sdfs[] = {
      arm(upper, "<pose relative_to='upper'>0 0 -0.5 1.25 0 0</pose>",
          "<pose relative_to='lower'>0.1 0 0 0 0 0</pose>"),
      // Poses against joints, and frames on the way.
      arm("<pose relative_to='there'/>", "<pose relative_to='hook'>0 0 0 1.25 0 0</pose>",
          "<pose relative_to='elbow'>0.1 0 0 0 0 0</pose>", "", "",
          "<frame name='there'><pose>0 0 1 0.2 -0.3 0.4</pose></frame><frame name='hook' attached_to='upper'><pose "
          "relative_to='upper'>0 0 -0.5 0 0 0</pose></frame>"),
      // An axis that is stated in the axes of the joint's parent: turned by 1.25 rad about x.
      arm(upper, "<pose relative_to='upper'>0 0 -0.5 1.25 0 0</pose>", "<pose relative_to='lower'>0.1 0 0 0 0 0</pose>",
          "<pose>0 0 0 0.5 0.25 0</pose>",
          axis("0.6 0 0.8", "<damping>0.1</damping><friction>0.05</friction>", "lower")),
      arm(upper, "<pose relative_to='upper'>0 0 -0.5 1.25 0 0</pose>", "<pose relative_to='lower'>0.1 0 0 0 0 0</pose>",
          "<pose relative_to='upper'>0 0 -0.5 0 0 0.75</pose>",
          axis("0.6 0 0.8", "<damping>0.1</damping><friction>0.05</friction>", "lower"))};
  for (const std::string& sdf : sdfs)
    for (const std::vector<double>& x : states) expectSameMotion(urdf, mechanismOf(sdf), x);
}

/// All poses are stated in the model, which stands elsewhere in the world; a joint stands in its child.
TEST(Sdf, HasPosesInTheModelAndJointsApartFromLinks) {
  const auto of = [](const std::string& model, const std::string& a, const std::string& b, const std::string& j) {
    const std::string inertial =
        "<pose>0.25 0 0.5 0 0 0</pose><mass>2</mass><inertia><ixx>0.5</ixx><iyy>0.6</iyy>"
        "<izz>0.7</izz></inertia>";
    return "<sdf version='1.7'><model name='m'>" + model + link("a", a, inertial) + link("b", b, inertial) +
           joint("k", "revolute", "a", "b", j + axis("1 0 0")) + joint("i", "revolute", "world", "a", axis("0 1 0")) +
           "</model></sdf>";
  };
  const std::string gravity = "gravity = [0, 0, -9.81]\n";
  const Mechanism one = mechanismOf(of("<pose degrees='true'>1 2 3 0 0 90</pose>", "",
                                       "<pose degrees='true'>0 1 2 0 90 0</pose>", "<pose>0.5 0 0.25 0 0 0</pose>"),
                                    gravity);
  const Mechanism other =
      mechanismOf(of("", "<pose degrees='true'>1 2 3 0 0 90</pose>",
                     "<pose degrees='true' relative_to='a'>0 1 2 0 90 0</pose>", "<pose>0.5 0 0.25 0 0 0</pose>"),
                  gravity);
  expectSameMotion(one, other, {0.3, -0.8, 1.2, 0.7});
  // The joint at (0.5, 0, 0.25) of b, which is turned by 90° about y: at (0.25, 1, 1.5) in a.
  Mechanism made;
  const FixedRotation quarter{axisZ, 1}, about{axisY, 1};
  made.add(Link{"o", "inertial", "O", {1.0, 2.0, 3.0}, {quarter}});
  made.add(Revolute{"i", "O", "a", axisY});
  made.add(Mass{"am", "a", 2.0, {0.25, 0.0, 0.5}, {0.5, Interval("0.6"), Interval("0.7"), 0.0, 0.0, 0.0}});
  made.add(Link{"p", "a", "P", {0.25, 1.0, 1.5}, {about}});
  made.add(Revolute{"k", "P", "K", axisX});
  made.add(Link{"q", "K", "b", {-0.5, 0.0, -0.25}});
  made.add(Mass{"bm", "b", 2.0, {0.25, 0.0, 0.5}, {0.5, Interval("0.6"), Interval("0.7"), 0.0, 0.0, 0.0}});
  made.setGravity({0.0, 0.0, Interval("-9.81")});
  expectSameMotion(one, made, {0.3, -0.8, 1.2, 0.7});
}

TEST(Sdf, HasBallsUniversalsFreeAndStaticModels) {
  const std::string model = "<model name='";
  const std::string text =
      "<sdf version='1.8'><world name='w'>" + model + "stone'><pose>0 0 5 0 0 0</pose><link name='l'/></model>" +
      model + "wall'><static>true</static><link name='l'/></model>" + model + "pair'>" +
      link("a", "", "<mass>1</mass>") + link("b", "", "<pose>0 0 1 0 0 0</pose><mass>1</mass>") +
      joint("ball", "ball", "world", "a", "") +
      joint("u", "universal", "a", "b", axis("1 0 0") + "<axis2><xyz>0 1 0</xyz></axis2>") + "</model></world></sdf>";
  const Robot robot = readRobotText(text, "r.sdf");
  const Mechanism m = mechanismOf(text);
  EXPECT_EQ(m.degreesOfFreedom(), 6 + 3 + 2);
  EXPECT_TRUE(isEqual(m.nominal("gravity.z"), Interval("-9.8")));
  EXPECT_TRUE(isEqual(m.nominal("stone.l.mass"), Interval(1.0)));
  EXPECT_DOUBLE_EQ(Assembly<double>(m).output("stone.l.position.z"), 5.0);
  EXPECT_THAT(::testing::PrintToString(robot.notes),
              HasSubstr("'stone.l', 'wall.l': 1 kg and 1 kg m^2, as SDFormat has it of links without <inertial>"));
}

TEST(Sdf, HasSpringsAndJointsThatFollowOthers) {
  const std::string inertial = "<mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>2</izz></inertia>";
  const std::string text =
      "<sdf version='1.11'><model name='m'>" + link("a", "", inertial) + link("b", "", inertial) +
      joint("j", "revolute", "world", "a",
            axis("0 0 1",
                 "<damping>0.25</damping><spring_stiffness>3</spring_stiffness><spring_reference>0.5"
                 "</spring_reference>")) +
      joint("k", "revolute", "world", "b",
            "<axis><xyz>0 0 1</xyz><mimic joint='j'><multiplier>-1.5</multiplier><offset>0.125</offset>"
            "<reference>0.25</reference></mimic></axis>") +
      "</model></sdf>";
  const Mechanism free = mechanismOf(text, "mimic = false\n");
  Evaluator<double> motion(recordMotion(free));
  EXPECT_DOUBLE_EQ(motion(0, {1.0, 0.0, 2.0, 0.0})[2], (-0.25 * 2 - 3 * (1 - 0.5)) / 2);
  const Mechanism held = mechanismOf(text, "[mechanism.initial]\nj.angle = 0.5\n");
  EXPECT_DOUBLE_EQ(Assembly<double>(held).output("k.angle"), -1.5 * (0.5 - 0.25) + 0.125);
}

TEST(Sdf, HasModelsWithinModels) {
  const std::string hand = "<model name='hand'><pose relative_to='arm'>0 0 1 0 0 0</pose>" +
                           link("palm", "", "<pose>0 0 0.5 0 0 0</pose><mass>1</mass>") + "</model>";
  const std::string text = "<sdf version='1.9'><model name='m'><pose>0 5 0 0 0 0</pose>" +
                           link("arm", "<pose relative_to='__model__'>1 0 0 0 0 0</pose>", "<mass>1</mass>") + hand +
                           "<model name='foot'><link name='l'/></model>" +
                           joint("j", "revolute", "world", "arm", axis("0 1 0")) +
                           joint("wrist", "revolute", "arm", "hand::palm", axis("0 1 0")) + "</model></sdf>";
  const Mechanism m = mechanismOf(text);
  EXPECT_DOUBLE_EQ(Assembly<double>(m).output("hand.palm.position.x"), 1.0);
  EXPECT_DOUBLE_EQ(Assembly<double>(m).output("hand.palm.position.z"), 1.0);
  EXPECT_DOUBLE_EQ(Assembly<double>(m).output("hand.palm.position.y"), 5.0);
  EXPECT_DOUBLE_EQ(Assembly<double>(m).output("foot.l.position.y"), 5.0);
  EXPECT_TRUE(isEqual(m.nominal("m.placement.y"), Interval(5.0)));
  EXPECT_EQ(m.degreesOfFreedom(), 2 + 6);
}

TEST(HostileSdf, IsRefusedInOneLine) {
  const auto expect = [](const std::string& text, const std::string& what) {
    std::string said = "it was read";
    try {
      readRobotText(text, "r.sdf");
    } catch (const StudyError& error) {
      said = error.what();
    }
    EXPECT_THAT(said, StartsWith("r.sdf:" + what)) << text;
    EXPECT_THAT(said, Not(HasSubstr("\n")));
  };
  const auto expectOf = [&](const std::string& inModel, const std::string& what) {
    expect("<sdf version='1.9'><model name='m'>\n<link name='a'/>\n" + inModel + "</model></sdf>", what);
  };
  expect("<sdf version='1.4'><model name='m'/></sdf>", "1: the version of <sdf> is \"1.4\"; expected 1.5 or later");
  expect("<sdf version='1.9'/>", "1: there is no <model>");
  expect("<sdf version='1.9'><model name='m'/></sdf>", "1: 'm' has no <link>");
  expect("<sdf version='1.9'>\n<world name='w'><include><uri>model://x</uri></include></world></sdf>",
         "2: <include> names a model elsewhere");
  expectOf("<link name='a'/>", "3: there is a frame 'a' already");
  expectOf("<link name='b'><pose>0 0 0</pose></link>", "3: <pose> has 3 numbers; expected 6 decimal numbers");
  expectOf("<link name='b'><pose relative_to='c'>0 0 0 0 0 0</pose></link>", "3: there is no frame 'c'");
  expectOf("<link name='b'><gravity>false</gravity></link>", "3: 'b' has no weight, by <gravity>");
  expectOf("<link name='b'><inertial><mass>-1</mass></inertial></link>", "3: the mass of 'b' is negative");
  expectOf("<link name='b'><inertial><inertia><ixx>9</ixx></inertia></inertial></link>", "3: the inertia of 'b' has");
  expectOf(
      "<link name='b'><pose relative_to='f'>0 0 0 0 0 0</pose></link><frame name='f'><pose relative_to='b'/></frame>",
      "3: the pose of 'f' leads back to itself");
  expectOf(joint("j", "revolute", "__model__", "a", ""), "3: the links 'a' and 'a' carry one another in a circle");
  expectOf(joint("j", "hinge", "world", "a", ""), "3: the joint 'j' is of the type \"hinge\"");
  expectOf(joint("j", "revolute", "wrld", "a", ""), "3: there is no frame 'wrld'");
  expectOf(joint("j", "revolute", "a", "world", ""), "3: ");
  expectOf(joint("j", "revolute", "world", "a", axis("0 0 0")), "3: the axis of 'j' is the zero vector");
  expectOf(joint("j", "revolute", "world", "a", "") + joint("k", "revolute", "world", "a", ""),
           "4: the link 'a' is the child of two joints, 'j' and 'k'");
  expectOf(joint("j", "universal", "world", "a", axis("1 0 0")), "3: the joint 'j' has no <axis2>");
}

}  // namespace sdf_test
}  // namespace gamut
