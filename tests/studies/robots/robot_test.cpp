// Robots from URDF: what is read is what the file says, it moves as the same machine of elements, and whatever is wrong
// is said in one line.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/assembly.hpp"
#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "studies/robots/robot.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/replaced.hpp"
#include "tests/studies/sample_robots.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string complaintAbout(const std::string& urdf) {
  try {
    readRobotText(urdf, "r.urdf");
  } catch (const StudyError& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    EXPECT_LE(std::string(error.what()).size(), 1000U);
    return error.what();
  }
  return "it was read";
}

std::string robotWith(const std::string& what, const std::string& other) { return replaced(sampleRobot, what, other); }

// ---- What is read ---------------------------------------------------------------------------------------------------

TEST(RobotReader, ReadsLinksAndJointsFromTheRootOutwards) {
  const Robot robot = readRobotText(sampleRobot, "r.urdf");
  EXPECT_EQ(robot.name, "sample");
  std::vector<std::string> links, joints;
  for (const Robot::Link& link : robot.links) links.push_back(link.name);
  for (const Robot::Joint& joint : robot.joints) joints.push_back(joint.name + std::to_string(joint.depth));
  EXPECT_THAT(links, ElementsAre("ground", "upper", "slide", "hand-frame", "left", "right"));
  EXPECT_THAT(joints, ElementsAre("hinge0", "slider1", "weld2", "left-finger3", "right-finger3"));
  EXPECT_TRUE(robot.joints[1].axis.isParallelTo(Axis(3, 0, 4)));
  EXPECT_EQ(robot.joints[0].axis.sign(), -1);
  EXPECT_EQ(robot.joints[1].limits->upper, 0.75);
  EXPECT_EQ(robot.joints[4].mimic->joint, "left-finger");
}

TEST(RobotReader, EnclosesTheDecimalsThatStandThere) {
  const Robot robot = readRobotText(sampleRobot, "r.urdf");
  const Robot::Inertial& inertial = *robot.links[1].inertial;
  EXPECT_TRUE(isEqual(inertial.place.xyz[0], Interval("0.1")));
  EXPECT_TRUE(isEqual(inertial.place.xyz[1], Interval("-0.2")));
  EXPECT_TRUE(isEqual(inertial.place.xyz[2], Interval("0.3")));
  EXPECT_TRUE(isEqual(inertial.mass, Interval(2.5)));
  EXPECT_TRUE(isEqual(inertial.inertia[5], Interval("-0.01"))) << "ixz is zx";
  EXPECT_TRUE(isEqual(robot.joints[0].origin.rpy[0], Interval("1.5707963267948966"))) << "no quarter turn";
  EXPECT_TRUE(isEqual(robot.links[2].inertial->mass, Interval(1.25)));
}

TEST(RobotReader, NotesWhatItLeavesOut) {
  const Robot robot = readRobotText(robotWith("<mass value=\"2.5\"/>", "<mass value=\"2.5\" unit=\"kg\"/>"), "r.urdf");
  EXPECT_THAT(robot.notes, ElementsAre("r.urdf:10: note: <visual>: shapes and meshes are left out",
                                       "r.urdf:39: note: <transmission>: left out, as they say nothing of how bodies "
                                       "and joints move",
                                       "r.urdf:7: note: 'unit' of <mass>: left out, as URDF knows no such attribute",
                                       "r.urdf:25: note: <limit> (2): kept for information; motions may go beyond"));
}

// ---- Shapes ---------------------------------------------------------------------------------------------------------

std::string shapedRobot(const std::string& ofArm, const std::string& ofGround = "<sphere radius=\"0.125\"/>") {
  return "<robot name=\"shaped\">\n<link name=\"ground\"><collision><geometry>" + ofGround +
         "</geometry></collision></link>\n<link name=\"arm\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" "
         "ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>\n" +
         ofArm +
         "</link>\n<joint name=\"hinge\" type=\"revolute\"><parent link=\"ground\"/><child link=\"arm\"/><origin "
         "xyz=\"0 0 2\"/><axis xyz=\"0 1 0\"/></joint></robot>";
}
constexpr const char* armsShapes =
    "<collision><origin xyz=\"0 0 -1\" rpy=\"0 0 0.5\"/><geometry><box size=\"0.5 0.25 1\"/></geometry></collision>\n"
    "<collision name=\"tip\"><origin xyz=\"0.5 0 0\" rpy=\"0 1.5 0\"/><geometry><cylinder radius=\"0.25\" "
    "length=\"1\"/></geometry></collision>\n<collision><geometry><mesh filename=\"a.stl\"/></geometry></collision>\n";

TEST(RobotShapes, AreTakenIfTheyAreAskedFor) {
  const Robot without = readRobotText(shapedRobot(armsShapes), "r.urdf");
  EXPECT_TRUE(without.links[1].shapes.empty());
  EXPECT_THAT(without.notes, ElementsAre("r.urdf:2: note: <collision> (4): shapes and meshes are left out"));
  const Robot robot = readRobotText(shapedRobot(armsShapes), "r.urdf", true);
  ASSERT_EQ(robot.links[1].shapes.size(), 2U);
  EXPECT_THAT(robot.notes,
              ElementsAre("r.urdf:6: note: <mesh>: left out of <collision>, of which boxes, spheres, cylinders and "
                          "meshes of STL and OBJ files at hand are taken",
                          "r.urdf:5: note: <cylinder>: taken as capsules that hold them, with half a sphere more at "
                          "either end"));

  TemporaryFolder folder;
  folder.write("r.urdf", shapedRobot(armsShapes));
  const std::string study =
      "[mechanism]\nurdf = \"r.urdf\"\ncollision = true\n[mechanism.initial]\nhinge.angle = 0.75\n"
      "[[mechanism.element]]\ntype = \"separation\"\nname = \"box\"\nfrom = \"ground.collision\"\n"
      "to = \"arm.collision.1\"\n[[mechanism.element]]\ntype = \"separation\"\nname = \"tip\"\n"
      "from = \"ground.collision\"\nto = \"arm.collision.2\"\n";
  const Mechanism read = readMechanismText(study, folder.path("s.toml"));
  Mechanism made;
  made.add(Sphere{"ball", "inertial", 0.125});
  made.add(Link{"up", "inertial", "top", {0.0, 0.0, 2.0}});
  made.add(Revolute{"hinge", "top", "arm", axisY, 0.75});
  made.add(Mass{"body", "arm", 1.0});
  made.add(Link{"first", "arm", "first_place", {0.0, 0.0, -1.0}, {{axisZ, 0, 0.5}}});
  made.add(Cuboid{"first_box", "first_place", {0.5, 0.25, 1.0}});
  made.add(Link{"second", "arm", "second_place", {0.5, 0.0, 0.0}, {{axisY, 0, 1.5}}});
  made.add(Capsule{"second_rod", "second_place", 0.25, 1.0});
  made.add(Separation{"box", "ball", "first_box"});
  made.add(Separation{"tip", "ball", "second_rod"});
  for (const std::string output : {"box.distance", "tip.distance"})
    EXPECT_DOUBLE_EQ(Assembly<double>(read).output(output), Assembly<double>(made).output(output)) << output;
  EXPECT_TRUE(isEqual(read.nominal("arm.collision.2.radius"), Interval(0.25)));
  EXPECT_TRUE(isEqual(read.nominal("arm.collision.1.origin.z"), Interval(-1.0)));
  EXPECT_TRUE(isEqual(read.nominal("ground.collision.radius"), Interval(0.125)));
}

/// A robot with this mesh, as it is read.
Robot robotWithMesh(const std::string& name, const std::string& content, const std::string& further = "") {
  const TemporaryFolder folder;
  folder.write(name, content);
  const std::string file = folder.write("r.urdf", shapedRobot("<collision><geometry><mesh filename=\"package://arms/" +
                                                              name + "\"" + further + "/></geometry></collision>"));
  return readRobotText(textOfRobot(file), "r.urdf", true);
}

using ExactPoint = std::array<mpq_class, 3>;

/// Whether nothing of the mesh lies beyond the hull and its radius in any of many directions, in rationals.
void expectHolds(const Robot::Shape& hull, const std::vector<ExactPoint>& mesh) {
  const auto along = [](const ExactPoint& n, const auto& p) {
    return mpq_class(n[0] * mpq_class(p[0]) + n[1] * mpq_class(p[1]) + n[2] * mpq_class(p[2]));
  };
  const mpq_class radius(hull.radius.lower());
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z) {
        const ExactPoint n = {x, y, z};
        mpq_class own = along(n, hull.points[0]), others = along(n, mesh[0]);
        for (const auto& point : hull.points) own = std::max(own, along(n, point));
        for (const ExactPoint& point : mesh) others = std::max(others, along(n, point));
        const mpq_class beyond = others - own;
        EXPECT_TRUE(beyond <= 0 || beyond * beyond <= radius * radius * (x * x + y * y + z * z))
            << x << ' ' << y << ' ' << z;
      }
}

TEST(RobotShapes, HoldMeshesByHullsOfSomeOfTheirPoints) {
  // Half sines, so that a bent sheet and a closed one come of it, in thousandths: decimals that no doubles are.
  std::string text = "# sheet\n";
  std::vector<ExactPoint> mesh;
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k < 40; ++k) {
      const auto thousandths = [](double x) { return static_cast<int>(std::lround(1000 * x)); };
      const int x = thousandths(std::sin(0.08 * i) * std::cos(0.16 * k)), y = thousandths(std::sin(0.08 * i + 1)),
                z = thousandths(std::sin(0.08 * i) * std::sin(0.16 * k));
      text += "v " + std::to_string(x) + "e-3 " + std::to_string(y) + "e-3 +" + std::to_string(std::abs(z)) + "e-3\n";
      mesh.push_back({mpq_class(x, 1000) * mpq_class(1, 10), mpq_class(y, 1000) * mpq_class(-3, 10),
                      mpq_class(std::abs(z), 1000) * 2});
      for (mpq_class& coordinate : mesh.back()) coordinate.canonicalize();
    }
  const Robot robot = robotWithMesh("sheet.OBJ", text, " scale=\"0.1 -0.3 2\"");
  ASSERT_EQ(robot.links[1].shapes.size(), 1U);
  const Robot::Shape& hull = robot.links[1].shapes[0];
  EXPECT_EQ(hull.points.size(), 40U);
  EXPECT_LT(hull.radius.upper(), 0.2);
  expectHolds(hull, mesh);
  EXPECT_THAT(robot.notes.front(), StartsWith("r.urdf:4: note: <mesh>: taken as convex hulls of 40 points at most"));
}

TEST(RobotShapes, HoldMeshesOfFewPointsByTheseAlone) {
  std::string facets = "solid cube\n";
  for (const char* corner : {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 1 0", "1 0 1", "0 1 1", "1 1 1", "0.5 0.5 0.5"})
    facets += std::string("vertex ") + corner + "\n";
  const Robot robot = robotWithMesh("cube.stl", facets);
  EXPECT_EQ(robot.links[1].shapes.at(0).points.size(), 9U);
  EXPECT_LT(robot.links[1].shapes[0].radius.upper(), 1e-15);
}

TEST(RobotShapes, RefuseBrokenMeshesInOneLine) {
  const auto complaint = [](const std::string& name, const std::string& content, const std::string& further = "") {
    try {
      robotWithMesh(name, content, further);
    } catch (const StudyError& error) {
      return std::string(error.what());
    }
    return std::string("it was read");
  };
  const std::string mesh = "r.urdf:4: the mesh 'package://arms/", corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  EXPECT_THAT(complaint("m.stl", "abc"), StartsWith(mesh + "m.stl' is too short for STL; expected a mesh with points"));
  EXPECT_THAT(complaint("m.stl", std::string(100, 'x')), StartsWith(mesh + "m.stl' says to have "));
  EXPECT_THAT(complaint("m.obj", "v 0 0 nothing\n"), StartsWith(mesh + "m.obj' has 'nothing' for a coordinate"));
  EXPECT_THAT(complaint("m.obj", "v 0 0\n"), StartsWith(mesh + "m.obj' has a point of less than three coordinates"));
  EXPECT_THAT(complaint("m.obj", "f 1 2 3\n"), StartsWith(mesh + "m.obj' has no points"));
  EXPECT_THAT(complaint("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"),
              StartsWith(mesh + "m.obj' has points that lie in one plane"));
  EXPECT_THAT(complaint("m.obj", corners, " scale=\"1 0 1\""), StartsWith("r.urdf:4: the scale of the mesh "));
  EXPECT_EQ(complaint("m.obj", corners), "it was read");
}

TEST(RobotShapes, SayWhatIsWrongInOneLine) {
  const auto complaint = [](const std::string& shape) -> std::string {
    try {
      readRobotText(shapedRobot("", shape), "r.urdf", true);
    } catch (const StudyError& error) {
      return error.what();
    }
    return "it was read";
  };
  EXPECT_THAT(complaint(""), StartsWith("r.urdf:2: a shape of 'ground' is nothing; expected <geometry> with a <box>"));
  EXPECT_THAT(complaint("<sphere radius=\"1\"/><box size=\"1 1 1\"/>"),
              StartsWith("r.urdf:2: a shape of 'ground' is more than one"));
  EXPECT_THAT(complaint("<sphere radius=\"-1\"/>"),
              StartsWith("r.urdf:2: the radius of a shape of 'ground' is negative; expected a length of at least 0 m"));
  EXPECT_THAT(complaint("<box size=\"1 1\"/>"), StartsWith("r.urdf:2: "));
  EXPECT_THAT(complaint("<cylinder radius=\"1\"/>"), StartsWith("r.urdf:2: "));
}

// ---- What it moves like ---------------------------------------------------------------------------------------------

struct Files {
  Files() { folder.write("r.urdf", sampleRobot); }
  Mechanism read(const std::string& mechanism) const {
    return readMechanismText("[mechanism]\nurdf = \"r.urdf\"\n" + mechanism, folder.path("s.toml"));
  }
  std::string complaint(const std::string& mechanism) const {
    try {
      read(mechanism);
    } catch (const StudyError& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      const std::string what = error.what(), place = folder.path("");
      return what.starts_with(place) ? what.substr(place.size()) : what;
    }
    return "it was read";
  }
  TemporaryFolder folder;
};

/// Rotation about fixed axes x, y, z.
std::vector<FixedRotation> turned(const char* roll, const char* pitch, const char* yaw) {
  return {{axisZ, 0, Interval(yaw)}, {axisY, 0, Interval(pitch)}, {axisX, 0, Interval(roll)}};
}

/// The sample robot, of elements; inertias are turned by frames of their own.
Mechanism sampleOfElements() {
  const auto n = [](const char* decimal) { return Expression(Interval(decimal)); };
  Mechanism m;
  m.add(Link{"o1", "inertial", "O1", {0.0, 0.0, 0.5}, turned("1.5707963267948966", "0", "0.7")});
  m.add(Revolute{"hinge", "O1", "upper", Axis(0, 0, -1)});
  m.add(Link{"c", "upper", "C", {n("0.1"), n("-0.2"), n("0.3")}, turned("0.3", "-0.2", "0.5")});
  m.add(Mass{"m1", "C", 2.5, {0.0, 0.0, 0.0}, {n("0.4"), n("0.5"), n("0.3"), n("0.02"), n("0.03"), n("-0.01")}});
  m.add(Link{"o2", "upper", "O2", {n("0.2"), 0.0, n("0.4")}, turned("0", "0.5", "0")});
  m.add(Prismatic{"slider", "O2", "slide", Axis(3, 0, 4)});
  m.add(Mass{"m2", "slide", 1.25, {0.0, 0.0, 0.0}, {n("0.1"), n("0.2"), n("0.15"), 0.0, 0.0, 0.0}});
  m.add(Link{"o3", "slide", "hand", {0.0, 0.0, n("0.1")}, turned("0", "0", "-0.25")});
  for (const char* side : {"left", "right"}) {
    const std::string name = side;
    m.add(Revolute{name + "-finger", "hand", name, axisX});
    m.add(Mass{"m" + name,
               name,
               n("0.2"),
               {0.0, n(name == "left" ? "0.02" : "-0.02"), n("0.05")},
               {n("0.001"), n("0.001"), n("0.0005"), 0.0, 0.0, 0.0}});
  }
  m.add(JointSpring{"d1", "slider", 0.0, 0.0, 3.0});
  m.setGravity({0.0, 0.0, n("-9.81")});
  return m;
}

TEST(RobotMechanism, MovesAsTheSameMachineOfElements) {
  const Files files;
  const Mechanism robot = files.read(
                      "mimic = false\nfriction = false\ngravity = [0, 0, -9.81]\n[[mechanism.element]]\n"
                      "type = \"joint-spring\"\nname = \"less\"\njoint = \"hinge\"\ndamping = -0.5\n"),
                  machine = sampleOfElements();
  ASSERT_EQ(robot.stateNames(), machine.stateNames());
  const std::vector<double> x = {0.4, -0.3, 0.7, -0.9, 1.1, 0.6, -2.0, 3.0};
  for (const Formulation formulation : {Formulation::articulated, Formulation::sparse}) {
    Evaluator<Interval> one(recordMotion(robot, {}, formulation)), other(recordMotion(machine, {}, formulation));
    const std::vector<Interval> box(x.begin(), x.end()), a = one(0.0, box), b = other(0.0, box);
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_FALSE(isDisjoint(a[i], b[i])) << robot.stateNames()[i];
      EXPECT_LE(width(a[i]), 1e-9) << robot.stateNames()[i];
    }
  }
}

/// Q = -F sign(q̇) and -d q̇ in the file's numbers, alone in a robot of one hinge with inertia 1.
TEST(RobotMechanism, HasTheDampingAndFrictionOfItsJointsUnlessSwitchedOff) {
  TemporaryFolder folder;
  folder.write("r.urdf", R"(<robot name="r"><link name="a"/><link name="b"><inertial><mass value="0"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><joint name="j" type="continuous">
    <parent link="a"/><child link="b"/><dynamics damping="0.5" friction="0.25"/></joint></robot>)");
  const auto acceleration = [&](const std::string& switches) {
    const Mechanism m = readMechanismText("[mechanism]\nurdf = \"r.urdf\"\n" + switches, folder.path("s.toml"));
    Evaluator<double> motion(recordMotion(m));
    return motion(0, {0.0, -3.0})[1];
  };
  EXPECT_DOUBLE_EQ(acceleration(""), 1.75);
  EXPECT_DOUBLE_EQ(acceleration("damping = false"), 0.25);
  EXPECT_DOUBLE_EQ(acceleration("friction = false"), 1.5);
  EXPECT_DOUBLE_EQ(acceleration("damping = false\nfriction = false"), 0.0);
}

TEST(RobotMechanism, HasJointsThatFollowOthers) {
  const Files files;
  const Mechanism m = files.read("[mechanism.initial]\nleft-finger.angle = \"0.5 rad\"\nleft-finger.rate = 2\n");
  EXPECT_EQ(m.degreesOfFreedom(), 3);
  Assembly<double> assembly(m);
  EXPECT_DOUBLE_EQ(assembly.output("'right-finger.angle'"), -1.5 * 0.5 + 0.125);
  EXPECT_DOUBLE_EQ(assembly.output("right-finger.rate"), -3.0);
  EXPECT_EQ(files.read("mimic = false").degreesOfFreedom(), 4);
}

/// Of a double pendulum its URDF and the published equations: M q̈ + C = -G with
/// M11 = I1 + I2 + m1 r1² + m2 (l1² + r2² + 2 l1 r2 cos b), M12 = I2 + m2 (r2² + l1 r2 cos b), M22 = I2 + m2 r2².
TEST(RobotMechanism, HasTheInertiaMatrixOfTheTextbook) {
  TemporaryFolder folder;
  folder.write("r.urdf", R"(<robot name="r"><link name="a"/>
    <link name="b"><inertial><origin xyz="0 0 -0.5" rpy="0 0 1.5707963267948966"/><mass value="2"/>
      <inertia ixx="0.25" ixy="0" ixz="0" iyy="0.125" iyz="0" izz="0.25"/></inertial></link>
    <link name="c"><inertial><origin xyz="0 0 -0.25"/><mass value="3"/>
      <inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.5"/></inertial></link>
    <joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/></joint>
    <joint name="k" type="continuous"><parent link="b"/><child link="c"/><origin xyz="0 0 -1"/><axis xyz="0 1 0"/></joint>
    </robot>)");
  const Mechanism m =
      readMechanismText("[mechanism]\nurdf = \"r.urdf\"\ngravity = [0, 0, -10]\n", folder.path("s.toml"));
  Assembly<double> assembly(m);
  const double b = 0.75;
  assembly.setState(std::vector<double>{0.3, b, 0, 0});
  const auto found = assembly.system().inertiaMatrix();
  EXPECT_NEAR(found(0, 0), 0.25 + 0.5 + 2 * 0.25 + 3 * (1 + 0.0625 + 0.5 * std::cos(b)), 1e-14)
      << "ixx of a turned inertia is about y";
  EXPECT_NEAR(found(0, 1), 0.5 + 3 * (0.0625 + 0.25 * std::cos(b)), 1e-14);
  EXPECT_NEAR(found(1, 1), 0.5 + 3 * 0.0625, 1e-14);
  EXPECT_NEAR(assembly.system().residual()[1], -3 * 10 * 0.25 * std::sin(0.3 + b), 1e-13);
}

TEST(RobotMechanism, WithoutTurnsRecordsNoRotations) {
  const auto nodes = [](const std::string& rpy) {
    TemporaryFolder folder;
    folder.write("r.urdf", replaced(R"(<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><joint name="j" type="continuous">
      <parent link="a"/><child link="b"/><origin xyz="0 0 1" RPY/></joint></robot>)",
                                    "RPY", rpy));
    return recordMotion(readMechanismText("[mechanism]\nurdf = \"r.urdf\"\n", folder.path("s.toml"))).nodes().size();
  };
  EXPECT_EQ(nodes(""), nodes("rpy=\"0 0 0\""));
  TemporaryFolder folder;
  folder.write("r.urdf", humanoid());
  const Mechanism m = readMechanismText("[mechanism]\nurdf = \"r.urdf\"\ngravity = [0, 0, -9.81]\n", folder.path("s"));
  EXPECT_EQ(m.degreesOfFreedom(), 30);
  const std::size_t articulated = recordMotion(m, {}, Formulation::articulated).nodes().size();
  RecordProperty("nodes", static_cast<int>(articulated));
  EXPECT_LE(articulated, 30U * 500);
}

// ---- In a study -----------------------------------------------------------------------------------------------------

constexpr const char* rest = R"(
[[mechanism.element]]
type = "mass"
name = "load"
at = "hand-frame"
mass = "1 kg"
[[mechanism.element]]
type = "joint-force"
name = "motor"
joint = "hinge"
force = "-2 N m s/rad * hinge.rate"
[[uncertain]]
quantity = "upper.mass"
interval = "± 1 %"
[[uncertain]]
quantity = "upper.centre.z"
interval = "± 1 mm"
[[uncertain]]
quantity = "upper.inertia.xx"
interval = "± 1 %"
[[uncertain]]
quantity = "slider.origin.z"
interval = "± 1 mm"
[[uncertain]]
quantity = "slider.origin.roll"
interval = "± 0.1 deg"
[[uncertain]]
quantity = "hinge.angle"
interval = "± 0.1 deg"
[[uncertain]]
quantity = "left-finger.rate"
interval = "± 0.1 rad/s"
[[output]]
quantity = "hinge.angle"
[[output]]
quantity = "load.position.z"
[[output]]
quantity = "left-finger.angle"
[stochastic]
samples = 16
)";

std::string studyOf(const std::string& mechanism) {
  return "[study]\nanalysis = \"dynamics\"\nhorizon = 0.1\noutput_step = 0.05\ncompare = [\"interval\", "
         "\"stochastic\"]\n[mechanism]\nurdf = \"r.urdf\"\nfriction = false\ngravity = [0, 0, -9.81]\n" +
         mechanism + rest;
}

TEST(RobotStudy, RunsWithUncertainNumbersByNameAndElementsOfItsOwn) {
  const Files files;
  const Study study =
      readStudyText(studyOf("[mechanism.initial]\nhinge = { angle = \"60 deg\", rate = 0.5 }\nslider.displacement = "
                            "\"2 cm\"\n"),
                    files.folder.path("s.toml"));
  EXPECT_EQ(study.robot, sampleRobot);
  EXPECT_EQ(study.notes.size(), 3U);
  EXPECT_THAT(study.notes[0], HasSubstr("r.urdf:10: note: "));
  EXPECT_TRUE(isEqual(study.mechanism.nominal("slider.displacement"), Interval("0.02")));
  EXPECT_TRUE(contains(study.mechanism.nominal("hinge.angle"), 1.0471975511965976));
  const Results results = run(study);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.robotText, sampleRobot);
  EXPECT_EQ(
      readStudyText(results.studyText, "elsewhere/s.toml", elementTypes(), FilesAtHand{results.robotText, {}}).robot,
      sampleRobot)
      << "the results hold all that the study is made of";
}

TEST(RobotStudy, FloatsFromWhereItIsSaidToBe) {
  const Files files;
  const auto assembled = [&](const std::string& initial) {
    return readStudyText(studyOf("base = \"free\"\n[mechanism.initial]\n" + initial), files.folder.path("s.toml"))
        .mechanism;
  };
  const Mechanism rolled = assembled(
      "ground.base.position = [1, \"20 cm\", 3]\nground.base.velocity.z = 2\nground.base.orientation = { roll = "
      "\"90 deg\" }\nground.base.rate = [0, 0, 0.5]");
  EXPECT_TRUE(contains(rolled.nominal("ground.base.position.y"), 0.2));
  EXPECT_TRUE(isEqual(rolled.nominal("ground.base.velocity.z"), Interval(2.0)));
  EXPECT_TRUE(isEqual(rolled.nominal("ground.base.rate.z"), Interval(0.5)));
  const Mechanism turned = assembled("ground.base.position = [1, 0.2, 3]\nground.base.orientation = { w = 2, x = 2 }");
  EXPECT_LT((Assembly<double>(rolled).frame("ground").R - Assembly<double>(turned).frame("ground").R).norm(), 1e-15);
}

TEST(RobotStudy, SaysWhatIsWrongInOneLine) {
  const Files files;
  EXPECT_THAT(files.complaint("base = \"fixt\""), HasSubstr("s.toml:3:8: mechanism.base is \"fixt\""));
  EXPECT_THAT(files.complaint("base = \"free\"\n[mechanism.initial]\nground.base.orientation.rol = 1"),
              StartsWith("s.toml:5:31: the robot has no initial value 'ground.base.orientation.rol'; expected "
                         "'ground.base.orientation.roll'"));
  EXPECT_THAT(files.complaint("[mechanism.initial]\nhinge.angel = 1"),
              StartsWith("s.toml:4:15: the robot has no initial value 'hinge.angel'; expected 'hinge.angle'"));
  EXPECT_THAT(files.complaint("[mechanism.initial]\nhinge.angle = \"1 m\""),
              StartsWith("s.toml:4:15: mechanism.initial.hinge.angle is written in a unit of the kind m; expected"));
  EXPECT_THAT(files.complaint("[mechanism.initial]\nright-finger.angle = 1"),
              HasSubstr("the joint 'right-finger' has initial values, but is driven by 'right-finger.mimic'"));
  EXPECT_THAT(files.complaint("[mechanism.parameters]\nslider.mass = 1\n"), HasSubstr("s.toml:4:"));
  EXPECT_THAT(files.complaint("parameters = { 'upper.mass' = 1 }\n"),
              HasSubstr("the quantity 'upper.mass' is defined twice"));
  EXPECT_THAT(files.complaint("[[mechanism.element]]\ntype = \"mass\"\nname = \"m\"\nat = \"hand\"\nmass = 1"),
              HasSubstr("unknown frame 'hand'"));
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      readMechanismText(text, "s.toml");
    } catch (const StudyError& error) {
      return error.what();
    }
    return "it was read";
  };
  EXPECT_THAT(
      complaint("[mechanism]\nurdf = \"none.urdf\""),
      StartsWith("s.toml:2:8: none.urdf: does not exist; expected a robot's description (URDF, MJCF or SDFormat)"));
  EXPECT_THAT(complaint("[mechanism]\nbase = \"fixed\""), StartsWith("s.toml:2:1: unknown key 'base'"));
}

TEST(RobotStudy, NamesTheJointThatMovesNoMass) {
  TemporaryFolder folder;
  folder.write("r.urdf",
               robotWith("<link name=\"left\"><inertial><origin xyz=\"0 0.02 0.05\"/><mass value=\"0.2\"/><inertia "
                         "ixx=\"1e-3\" ixy=\"0\" ixz=\"0\" iyy=\"1e-3\" iyz=\"0\" izz=\"5e-4\"/></inertial></link>",
                         "<link name=\"left\"/>"));
  EXPECT_NO_THROW(readStudyText(studyOf(""), folder.path("s.toml"))) << "the other finger has a mass";
  try {
    Machine(readStudyText(studyOf("mimic = false\n"), folder.path("s.toml")));
    ADD_FAILURE();
  } catch (const StudyError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the joint 'left-finger' moves no mass"));
  }
}

// ---- Hostile files --------------------------------------------------------------------------------------------------

TEST(HostileRobot, IsRefusedInOneLine) {
  const std::string link = "<link name=\"slide\">";
  const auto expect = [](const std::string& text, const std::string& what) {
    EXPECT_THAT(complaintAbout(text), StartsWith("r.urdf:" + what));
  };
  expect("", "1: not valid XML: there is nothing in it; expected elements such as <robot> … </robot>");
  expect("this is no XML", "1: ");
  expect("<robot>", "1: not valid XML: ");
  expect("<robot/>", "1: <robot> has no <link>; expected one at least");
  expect("<svg/>", "1: the outermost element is <svg>; expected <robot> (URDF), <mujoco> (MJCF) or <sdf> (SDFormat)");
  expect(std::string("<robot>\0</robot>", 16), "1: is no text in UTF-8; expected XML");
  expect("<robot><link name=\"\xC3(\"/></robot>", "1: is no text in UTF-8");
  expect("<robot><link/></robot>", "1: <link> has no 'name'; expected the name of the link");
  expect("<robot>\n<link name=\"\"/></robot>", "2: 'name' of <link> is empty");
  expect("<robot><link name=\"it's\"/></robot>", "1: 'name' of <link> is \"it's\"; expected a name without '");
  expect("<robot><link name=\"a&#10;b\"/></robot>", "1: 'name' of <link> is \"a\\nb\"");
  expect("<robot><link name=\"a\"/>\n<link name=\"a\"/></robot>", "2: there is a link 'a' in line 1 already");
  expect("<robot><link name=\"a\"/>\n<link name=\"b\"/></robot>",
         "2: 'b' has no parent, and 'a' of line 1 has none either; expected one root");
  expect(robotWith(link, "<link name=\"left\">"), "19: there is a link 'left' in line 13 already");
  expect(robotWith("<parent link=\"upper\"/>", "<parent link=\"uper\"/>"),
         "22: there is no link 'uper'; expected 'upper'");
  expect(robotWith("<parent link=\"upper\"/>", ""), "21: <joint> has no <parent>; expected <parent link=\"…\"/>");
  expect(
      robotWith("<parent link=\"upper\"/><child link=\"slide\"/>", "<parent link=\"upper\"/><child link=\"upper\"/>"),
      "28: the link 'upper' is the child of two joints, 'slider' and 'hinge'");
  expect(robotWith("<parent link=\"ground\"/>", "<parent link=\"right\"/>"),
         "21: the links 'upper' and 'slide' carry one another in a circle");
  expect(robotWith("type=\"prismatic\"", "type=\"prismatik\""),
         "21: the joint is of the type \"prismatik\", which URDF does not have; expected 'prismatic'");
  expect(robotWith("name=\"slider\"", "name=\"hinge\""), "28: there is a joint 'hinge' in line 21 already");
  expect(robotWith("xyz=\"0.6 0 0.8\"", "xyz=\"0 0 0\""),
         "24: the axis of 'slider' is the zero vector; expected a direction");
  for (const char* text : {"nan 0 1", "0 inf 1", "0 0", "0 0 1 0", "0 0 1,5", "0 0 1e999", "0x1 0 0", "0 0 1m", ""})
    expect(robotWith("xyz=\"0.6 0 0.8\"", std::string("xyz=\"") + text + "\""), "24: 'xyz' of <axis> ");
  expect(robotWith("<mass value=\"2.5\"/>", "<mass value=\"-2.5\"/>"), "7: the mass of 'upper' is negative");
  expect(robotWith("<mass value=\"2.5\"/>", "<mass value=\"${m}\"/>"),
         "7: 'value' of <mass> is \"${m}\", which only xacro can read");
  expect(robotWith("<mass value=\"2.5\"/>", "<mass/>"), "7: <mass> has no 'value'");
  expect(robotWith("<mass value=\"2.5\"/>", ""), "5: <inertial> has no <mass>");
  expect(robotWith("<mass value=\"2.5\"/>", "<mass value=\"1\"/><mass value=\"2\"/>"),
         "7: <inertial> has two <mass>; expected one");
  expect(robotWith("ixx=\"0.4\"", "ixx=\"-0.4\""), "8: the inertia of 'upper' has a negative principal moment");
  expect(robotWith("ixx=\"0.4\"", "ixx=\"0.9\""),
         "8: the inertia of 'upper' has a principal moment above the sum of the other two");
  expect(robotWith("damping=\"3\"", "damping=\"-3\""), "26: the damping of 'slider' is negative");
  expect(robotWith("mimic joint=\"left-finger\"", "mimic joint=\"left\""), "38: there is no joint 'left' to follow");
  expect(robotWith("mimic joint=\"left-finger\"", "mimic joint=\"right-finger\""),
         "38: 'right-finger' follows joints that follow one another in a circle");
  expect("<robot xmlns:xacro=\"x\">\n<xacro:macro name=\"m\"/></robot>", "2: <xacro:macro> is of xacro");
}

TEST(HostileRobot, CostsLittle) {
  const std::string entities =
      "<!DOCTYPE robot [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\">]>\n"
      "<robot name=\"&b;\"><link name=\"a\"/></robot>";
  EXPECT_THAT(complaintAbout(entities), StartsWith("r.urdf:1: "));
  std::string deep;
  for (int i = 0; i < 400'000; ++i) deep += "<a>";
  EXPECT_THAT(complaintAbout("<robot>" + deep), StartsWith("r.urdf:1: not valid XML: elements are nested too deeply"));
  std::string many = "<robot>\n";
  for (int i = 0; i < 40'000; ++i) many += "<link name=\"l" + std::to_string(i) + "\"/>\n";
  EXPECT_THAT(complaintAbout(many + "</robot>"),
              StartsWith("r.urdf:1002: there are too many links; expected at most 1000"));
  const TemporaryFolder folder;
  const std::string path = folder.write("large.urdf", std::string(20'000'000, ' '));
  try {
    textOfRobot(path);
    ADD_FAILURE();
  } catch (const StudyError& error) {
    EXPECT_THAT(
        error.what(),
        HasSubstr("has more than 4 MB; expected a robot's description (URDF, MJCF or SDFormat) without meshes"));
  }
}

}  // namespace
}  // namespace gamut
