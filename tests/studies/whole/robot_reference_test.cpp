// Robots against values of another library (../shared/data/reference, which need not be there): forward and inverse
// dynamics, inertia matrix, poses, energies. And against urdfdom, which reads the same trees by other code.
#include <gmock/gmock.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "studies/robots/robot.hpp"
#include "studies/study.hpp"
#include "tests/studies/sample_robots.hpp"

namespace gamut {
namespace {

using Row = std::vector<double>;

std::string data(const std::string& file) { return GAMUT_SOURCE_DIR "/../shared/data/" + file; }

/// What a reference file holds: its joints, and rows by state, quantity and name.
struct Reference {
  std::vector<std::string> joints;
  std::array<double, 3> gravity{};
  std::map<int, std::map<std::string, std::map<std::string, Row>>> rows;

  explicit Reference(const std::string& path) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      std::stringstream rest(line);
      if (const std::size_t at = line.find("gravity=("); at != std::string::npos)
        std::sscanf(line.c_str() + at, "gravity=(%lf %lf %lf)", gravity.data(), &gravity[1], &gravity[2]);
      if (line.starts_with("# joints=")) {
        rest.str(line.substr(line.find(": ") + 2));
        for (std::string joint; rest >> joint;) joints.push_back(joint);
      }
      if (line.starts_with("#")) continue;
      std::vector<std::string> cells;
      for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
      Row& row = rows[std::stoi(cells[0])][cells[1]][cells[2]];
      for (std::size_t i = 3; i < cells.size(); ++i) row.push_back(std::stod(cells[i]));
    }
  }
};

double norm(const Row& x) {
  double sum = 0;
  for (double value : x) sum += value * value;
  return std::sqrt(sum);
}

double error(const Row& found, const Row& expected) {
  Row difference = found;
  for (std::size_t i = 0; i < found.size(); ++i) difference[i] -= expected.at(i);
  return found.size() == expected.size() ? norm(difference) / (1 + norm(expected)) : INFINITY;
}

struct Case {
  std::string robot, reference;
  friend void PrintTo(const Case& robot, std::ostream* out) { *out << robot.robot; }
};

class RobotReference : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const std::string urdf = data("urdf/" + GetParam().robot + ".urdf"),
                      values = data("reference/" + GetParam().reference + ".csv");
    if (!std::filesystem::exists(urdf) || !std::filesystem::exists(values)) GTEST_SKIP() << "there is no " << urdf;
    robot_ = readRobotText(textOfRobot(urdf), urdf);
    reference_ = std::make_unique<Reference>(values);
    // As the reference has it: without damping, friction and mimic; what is fixed to the ground has no energy.
    std::ostringstream study;
    study.precision(17);
    study << "[mechanism]\nurdf = \"" << urdf << "\"\ndamping = false\nfriction = false\nmimic = false\ngravity = ["
          << reference_->gravity[0] << ", " << reference_->gravity[1] << ", " << reference_->gravity[2]
          << "]\n[mechanism.parameters]\n";
    for (std::size_t i = 0; i < reference_->joints.size(); ++i)
      study << "drive_" << i << " = \"0 " << (isPrismatic(reference_->joints[i]) ? "N" : "N m") << "\"\n";
    for (std::size_t i = 0; i < reference_->joints.size(); ++i)
      study << "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"motor_" << i << "\"\njoint = \""
            << reference_->joints[i] << "\"\nforce = \"drive_" << i << "\"\n";
    mechanism_ = readMechanismText(study.str(), "reference.toml");
    free_ = massesAtRest();
    masses_ = free_.size();
    for (std::size_t i = 0; i < reference_->joints.size(); ++i) free_.push_back("drive_" + std::to_string(i));
  }

  bool isPrismatic(const std::string& joint) const {
    return std::ranges::find(robot_.joints, joint, &Robot::Joint::name)->type == Robot::Type::prismatic;
  }

  std::vector<std::string> massesAtRest() const {
    std::map<std::string, bool> rests = {{robot_.root().name, true}};
    std::vector<std::string> masses;
    for (const Robot::Joint& joint : robot_.joints)
      rests[joint.child] = joint.type == Robot::Type::fixed && rests[joint.parent];
    for (const Robot::Link& link : robot_.links)
      if (rests[link.name] && link.inertial) masses.push_back(link.name + ".mass");
    return masses;
  }

  /// x = [q; u] in the mechanism's order from values in the reference's.
  Row stateOf(const Row& q, const Row& v) const {
    Row x;
    for (const std::string& name : mechanism_.stateNames())
      for (std::size_t i = 0; i < reference_->joints.size(); ++i) {
        if (name == reference_->joints[i] + ".rate") x.push_back(v[i]);
        if (name == positionOf(reference_->joints[i])) x.push_back(q[i]);
      }
    return x;
  }
  std::string positionOf(const std::string& joint) const {
    return joint + (isPrismatic(joint) ? ".displacement" : ".angle");
  }
  /// Which number of the mechanism's speeds a joint of the reference has.
  std::size_t speedOf(std::size_t joint) const {
    const std::vector<std::string> names = mechanism_.stateNames();
    const auto found = std::ranges::find(names, reference_->joints[joint] + ".rate");
    return static_cast<std::size_t>(found - names.begin()) - reference_->joints.size();
  }
  Row inOrderOfReference(const Row& speeds) const {
    Row row;
    for (std::size_t i = 0; i < reference_->joints.size(); ++i) row.push_back(speeds[speedOf(i)]);
    return row;
  }

  Robot robot_;
  Mechanism mechanism_;
  std::unique_ptr<Reference> reference_;
  std::vector<std::string> free_;  // masses at rest, then forces that drive the joints
  std::size_t masses_ = 0;
};

TEST_P(RobotReference, GivesTheAccelerations) {
  std::map<Formulation, std::unique_ptr<Evaluator<double>>> recorded;
  for (const Formulation formulation : {Formulation::articulated, Formulation::sparse})
    recorded[formulation] = std::make_unique<Evaluator<double>>(recordMotion(mechanism_, free_, formulation));
  const Reference inMorePrecision(data("reference/" + GetParam().reference + ".qdd80.csv"));
  for (const auto& [state, rows] : reference_->rows) {
    const Row x = stateOf(rows.at("q").at("all"), rows.at("v").at("all"));
    Row p(masses_, 0.0);
    p.insert(p.end(), rows.at("tau").at("all").begin(), rows.at("tau").at("all").end());
    for (const auto& [formulation, motion] : recorded) {
      motion->setParameters(p);
      Row rates = (*motion)(0.0, x);
      rates.erase(rates.begin(), rates.begin() + static_cast<std::ptrdiff_t>(x.size() / 2));
      const Row found = inOrderOfReference(rates);
      EXPECT_LE(error(found, rows.at("qdd").at("all")), 1e-11) << state;
      EXPECT_LE(error(found, inMorePrecision.rows.at(state).at("qdd80").at("all")), 1e-12) << state;
    }
  }
}

TEST_P(RobotReference, GivesInertiaMatrixForcesPosesAndEnergies) {
  const std::size_t n = reference_->joints.size();
  Assembly<double> assembly(mechanism_, free_, Row(free_.size(), 0.0));
  ASSERT_EQ(assembly.system().degreesOfFreedom(), static_cast<int>(n));
  for (const auto& [state, rows] : reference_->rows) {
    assembly.setState(stateOf(rows.at("q").at("all"), rows.at("v").at("all")));
    EXPECT_LE(error({assembly.output("energy.kinetic")}, rows.at("energy").at("kinetic")), 1e-13) << state;
    EXPECT_LE(error({assembly.output("energy.potential")}, rows.at("energy").at("potential")), 1e-13) << state;
    for (const auto& [link, pose] : rows.at("pose_link")) {
      const Frame<double>& frame = assembly.frame(link);
      const Vector3<double> place = frame.positionInInertial();
      Row found = {place[0], place[1], place[2]};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) found.push_back(frame.R(i, j));
      EXPECT_LE(error(found, pose), 1e-13) << state << " " << link;
    }
    const std::vector<double> needed = assembly.system().residual();  // Q at u̇ = 0 is what a drive must outweigh
    Row drives;
    for (std::size_t i = 0; i < n; ++i) drives.push_back(-needed[speedOf(i)]);
    EXPECT_LE(error(drives, rows.at("tau_id").at("all")), 1e-13) << state;
    const auto m = assembly.system().inertiaMatrix();
    for (std::size_t i = 0; i < n; ++i) {
      Row row;
      for (std::size_t j = 0; j < n; ++j) row.push_back(m(static_cast<int>(speedOf(i)), static_cast<int>(speedOf(j))));
      EXPECT_LE(error(row, rows.at("M").at(reference_->joints[i])), 1e-13) << state;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, RobotReference,
                         ::testing::Values(Case{"panda", "panda"}, Case{"iiwa14_drake_limits", "iiwa14_drake_limits"},
                                           Case{"acrobot_drake", "acrobot_drake"},
                                           Case{"double_pendulum_drake", "double_pendulum_drake_gravity_my"}),
                         [](const auto& robot) { return robot.param.robot; });

/// Their trees, numbers to double precision.
void expectAsUrdfdomReads(const std::string& text) {
  const Robot robot = readRobotText(text, "r.urdf");
  const urdf::ModelInterfaceSharedPtr other = urdf::parseURDF(text);
  ASSERT_TRUE(other);
  EXPECT_EQ(robot.name, other->getName());
  EXPECT_EQ(robot.root().name, other->getRoot()->name);
  ASSERT_EQ(robot.links.size(), other->links_.size());
  ASSERT_EQ(robot.joints.size(), other->joints_.size());
  const auto same = [](const Interval& x, double y) {
    return contains(Interval(x.lower() - 0x1p-52 * std::abs(y), x.upper() + 0x1p-52 * std::abs(y)), y);
  };
  const auto expectPlace = [&](const Robot::Place& place, const urdf::Pose& pose) {
    EXPECT_TRUE(same(place.xyz[0], pose.position.x) && same(place.xyz[1], pose.position.y) &&
                same(place.xyz[2], pose.position.z));
    const urdf::Rotation turned = [&] {
      urdf::Rotation rotation;
      rotation.setFromRPY(midpoint(place.rpy[0]), midpoint(place.rpy[1]), midpoint(place.rpy[2]));
      return rotation;
    }();
    EXPECT_NEAR(std::abs(turned.x * pose.rotation.x + turned.y * pose.rotation.y + turned.z * pose.rotation.z +
                         turned.w * pose.rotation.w),
                1, 1e-15);
  };
  for (const Robot::Link& link : robot.links) {
    const auto& inertial = other->getLink(link.name)->inertial;
    ASSERT_EQ(link.inertial.has_value(), inertial != nullptr) << link.name;
    if (!inertial) continue;
    EXPECT_TRUE(same(link.inertial->mass, inertial->mass));
    const double entries[] = {inertial->ixx, inertial->iyy, inertial->izz, inertial->ixy, inertial->iyz, inertial->ixz};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE(same(link.inertial->inertia[i], entries[i])) << link.name << i;
    expectPlace(link.inertial->place, inertial->origin);
  }
  for (const Robot::Joint& joint : robot.joints) {
    const auto& found = other->getJoint(joint.name);
    ASSERT_TRUE(found) << joint.name;
    EXPECT_EQ(joint.parent, found->parent_link_name);
    EXPECT_EQ(joint.child, found->child_link_name);
    expectPlace(joint.origin, found->parent_to_joint_origin_transform);
    const std::map<int, Robot::Type> types = {
        {urdf::Joint::REVOLUTE, Robot::Type::revolute},   {urdf::Joint::CONTINUOUS, Robot::Type::continuous},
        {urdf::Joint::PRISMATIC, Robot::Type::prismatic}, {urdf::Joint::FLOATING, Robot::Type::floating},
        {urdf::Joint::PLANAR, Robot::Type::planar},       {urdf::Joint::FIXED, Robot::Type::fixed}};
    EXPECT_EQ(joint.type, types.at(found->type));
    EXPECT_TRUE(same(joint.damping, found->dynamics ? found->dynamics->damping : 0));
    EXPECT_TRUE(same(joint.friction, found->dynamics ? found->dynamics->friction : 0));
    ASSERT_EQ(joint.mimic.has_value(), found->mimic != nullptr);
    if (found->mimic) {
      EXPECT_EQ(joint.mimic->joint, found->mimic->joint_name);
      EXPECT_TRUE(same(joint.mimic->multiplier, found->mimic->multiplier));
      EXPECT_TRUE(same(joint.mimic->offset, found->mimic->offset));
    }
    if (found->limits) {
      EXPECT_DOUBLE_EQ(joint.limits->lower.value_or(0), found->limits->lower);
      EXPECT_DOUBLE_EQ(joint.limits->effort.value_or(0), found->limits->effort);
    }
  }
}

TEST(RobotReader, ReadsWhatUrdfdomReads) {
  expectAsUrdfdomReads(sampleRobot);
  expectAsUrdfdomReads(humanoid());
  for (const char* robot : {"panda", "iiwa14_drake_limits", "acrobot_drake", "double_pendulum_drake"})
    if (const std::string path = data("urdf/" + std::string(robot) + ".urdf"); std::filesystem::exists(path)) {
      SCOPED_TRACE(robot);
      expectAsUrdfdomReads(textOfRobot(path));
    }
}

}  // namespace
}  // namespace gamut
