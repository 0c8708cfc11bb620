// Loads of a motion that is given, from the study file to the verdict: closed formulas, all corners of the box, tables.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "mechanics/assembly.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/pendulum_text.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;

/// A pendulum that is driven to and fro.
std::string drivenPendulum(const std::string& drive) {
  return R"([study]
analysis = "inverse-dynamics"
horizon = 1
output_step = 0.25
)" + pendulumMechanism("", "vector = [0, 0, -0.5]\n", "\"250 g\"") +
         drive +
         R"(
[[uncertain]]
quantity = "bob.mass"
interval = "± 5 %"
[[output]]
quantity = "servo.force"
[[output]]
quantity = "hinge.reaction.force.z"
[[output]]
quantity = "servo.power"
[stochastic]
samples = 32
)";
}

const std::string servo = R"toml([[mechanism.element]]
type = "drive"
name = "servo"
joint = "hinge"
position = "0.4 rad * sin(3*t/(1 s))")toml";

/// m l² q̈ + m g l sin q; m (g cos q + l q̇²).
TEST(InverseDynamics, OfAPendulumIsItsEquation) {
  const Study study = readStudyText(drivenPendulum(servo), "s.toml");
  EXPECT_EQ(study.analysisName(), "inverse-dynamics");
  const Results results = run(study);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.interval.reached, 1.0);
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    const double t = results.time[i], q = 0.4 * std::sin(3 * t), rate = 1.2 * std::cos(3 * t), second = -9 * q;
    const double moment = 0.25 * second + 0.5 * 9.81 * std::sin(q),  // of a mass of 1 kg
        force = 9.81 * std::cos(q) + 0.5 * rate * rate;
    const std::array<double, 3> ofOneKilogram = {moment, force, moment * rate};
    for (std::size_t j = 0; j < 3; ++j) {
      const auto [least, most] = std::minmax({0.2375 * ofOneKilogram[j], 0.2625 * ofOneKilogram[j]});
      const double lower = results.interval.at.lower(i, j), upper = results.interval.at.upper(i, j);
      EXPECT_LE(lower, least + 1e-15) << t;
      EXPECT_GE(upper, most - 1e-15) << t;
      EXPECT_LE(upper - lower, 1.000001 * (most - least) + 1e-13) << t;
      EXPECT_NEAR(results.fuzzy.outer.back().lower(i, j), 0.25 * ofOneKilogram[j], 1e-12) << "the nominal mass";
    }
  }
}

/// Between output times loads go from one to the other, in a rest-to-rest motion as in any.
TEST(InverseDynamics, IsTightBetweenOutputTimes) {
  std::string text = drivenPendulum(
      "[[mechanism.element]]\ntype = \"drive\"\nname = \"servo\"\njoint = \"hinge\"\nposition = \"60 deg * (10*(t/(1 "
      "s))^3 - 15*(t/(1 s))^4 + 6*(t/(1 s))^5)\"\n");
  text.replace(text.find("output_step = 0.25"), 18, "output_step = 0.01");
  const Results results = run(readStudyText(text, "s.toml"));
  const IntervalResult& proved = results.interval;
  ASSERT_EQ(proved.reached, 1.0);
  double widest = 0;
  for (std::size_t i = 1; i <= 100; ++i) widest = std::max(widest, proved.at.upper(i, 0) - proved.at.lower(i, 0));
  for (std::size_t i = 1; i <= 100; ++i) {
    const double lower = std::min(proved.at.lower(i, 0), proved.at.lower(i - 1, 0)),
                 upper = std::max(proved.at.upper(i, 0), proved.at.upper(i - 1, 0));
    EXPECT_LE(proved.over.lower(i, 0), lower);
    EXPECT_GE(proved.over.upper(i, 0), upper);
    EXPECT_LE(proved.over.upper(i, 0) - proved.over.lower(i, 0), upper - lower + 0.05 * widest) << i;
  }
}

TEST(InverseDynamics, NeedsADriveForEveryJoint) {
  EXPECT_EQ(
      messageOf(drivenPendulum("")),
      "s.toml:7:1: nothing drives 'hinge.angle'; expected a drive for every coordinate, or analysis = \"dynamics\", "
      "which tells what drives need as well");
  std::string text = drivenPendulum(servo);
  text.replace(text.find("inverse-dynamics"), 16, "dynamics");
  EXPECT_THAT(messageOf(text), HasSubstr("every joint is driven, so that nothing is left to move by itself; expected a "
                                         "joint without a drive, or analysis = \"inverse-dynamics\""));
}

/// Held still: m g l sin q.
TEST(InverseDynamics, OfJointsAtRestIsStatics) {
  std::string still = servo;
  still.replace(still.find("\"0.4"), std::string::npos, "\"30 deg\"");
  const Results results = run(readStudyText(drivenPendulum(still), "s.toml"));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    EXPECT_NEAR(results.interval.at.lower(i, 0), 0.2375 * 9.81 * 0.25, 1e-12);
    EXPECT_NEAR(results.interval.at.upper(i, 0), 0.2625 * 9.81 * 0.25, 1e-12);
  }
}

// ---- The seven-joint arm --------------------------------------------------------------------------------------------

std::string arm(const std::string& analysis, const std::string& tolerance, bool isDriven) {
  const std::array<double, 7> q = {0.3, 0.7, -0.4, -1.2, 0.5, 0.9, 0.2};
  std::string text = "[study]\nanalysis = \"" + analysis + "\"\ncompare = [\"interval\"]\n";
  if (isDriven) text += "horizon = 0.6\noutput_step = 0.2\n";
  text += "[mechanism]\ngravity = [0, 0, -9.81]\n";
  std::string from = "inertial", rest;
  for (int i = 0; i < 7; ++i) {
    const std::string n = std::to_string(i), at = std::to_string(q[static_cast<std::size_t>(i)]);
    text += "[[mechanism.element]]\ntype = \"revolute\"\nname = \"j" + n + "\"\nfrom = \"" + from + "\"\nto = \"K" + n +
            "\"\naxis = \"" + (i % 2 == 0 ? "z" : "y") + "\"\n";
    if (!isDriven) text += "initial = { angle = " + at + ", rate = 0." + n + " }\n";
    text += "[[mechanism.element]]\ntype = \"mass\"\nname = \"b" + n + "\"\nat = \"K" + n +
            "\"\nmass = " + std::to_string(4.0 - 0.4 * i) +
            "\ncentre = [0.01, -0.03, 0.12]\ninertia = [0.05, 0.04, 0.02, 0.001, -0.002, 0.001]\n" +
            "[[mechanism.element]]\ntype = \"link\"\nname = \"l" + n + "\"\nfrom = \"K" + n + "\"\nto = \"E" + n +
            "\"\nvector = [0.05, 0, 0.25]\n";
    if (isDriven)
      text += "[[mechanism.element]]\ntype = \"drive\"\nname = \"d" + n + "\"\njoint = \"j" + n + "\"\nposition = \"" +
              at + " rad + 0.5 rad*sin((1 + 0.3*" + n + ")*t/(1 s))\"\n";
    rest += "[[uncertain]]\nquantity = \"b" + n + ".mass\"\ninterval = \"± " + tolerance + " %\"\n";
    from = "E" + n;
  }
  for (int i = 0; i < 7; ++i)
    rest += "[[output]]\nquantity = \"" +
            (isDriven ? "d" + std::to_string(i) + ".force" : "j" + std::to_string(i) + ".acceleration") + "\"\n";
  return text + rest;
}

/// How many times wider the enclosure is at most than what the 2⁷ corners span, which it must hold.
double overestimation(const Study& study) {
  const Results results = run(study);
  std::vector<std::string> masses;
  std::vector<Interval> ranges;
  for (const UncertainQuantity& uncertain : study.uncertain) {
    masses.push_back(uncertain.quantity);
    ranges.push_back(uncertain.uncertain.range);
  }
  double worst = 0;
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    std::vector<double> least(study.outputs.size(), 1e300), most(study.outputs.size(), -1e300);
    for (unsigned corner = 0; corner < 128; ++corner) {
      std::vector<double> values;
      for (std::size_t k = 0; k < 7; ++k)
        values.push_back(((corner >> k) & 1U) != 0 ? ranges[k].upper() : ranges[k].lower());
      Assembly<double> machine(study.mechanism, masses, values);
      const std::vector<double> start = machine.initialState();
      machine.setState(start, results.time[i]);
      for (std::size_t j = 0; j < least.size(); ++j) {
        const double y = machine.output(study.outputs[j].quantity);
        least[j] = std::min(least[j], y);
        most[j] = std::max(most[j], y);
      }
    }
    for (std::size_t j = 0; j < least.size(); ++j) {
      const double lower = results.interval.at.lower(i, j), upper = results.interval.at.upper(i, j);
      const double rounding = 1e-12 * (1 + std::abs(least[j]) + std::abs(most[j]));  // of the corners
      EXPECT_LE(lower, least[j] + rounding);
      EXPECT_GE(upper, most[j] - rounding);
      if (most[j] - least[j] > 1e-9) worst = std::max(worst, (upper - lower) / (most[j] - least[j]));
    }
  }
  return worst;
}

/// Masses enter loads linearly: the enclosure is the corners' hull.
TEST(InverseDynamics, OfASevenJointArmIsTightForAllMassesTogether) {
  for (const char* tolerance : {"0.1", "1", "5"})
    EXPECT_LE(overestimation(readStudyText(arm("inverse-dynamics", tolerance, true), "s.toml")), 1.001) << tolerance;
}

TEST(ForwardDynamics, OfASevenJointArmAtAStateIsTightForAllMassesTogether) {
  const std::vector<std::pair<std::string, double>> bars = {{"0.1", 1.02}, {"1", 1.10}, {"5", 1.30}};
  for (const auto& [tolerance, bar] : bars)
    EXPECT_LE(overestimation(readStudyText(arm("kinematics", tolerance, false), "s.toml")), bar) << tolerance;
}

// ---- Tables ---------------------------------------------------------------------------------------------------------

const std::string byTable = R"([[mechanism.element]]
type = "table-drive"
name = "servo"
joint = "hinge"
file = "motion.csv"
column = "hip")";

/// Two rows are a motion at a steady rate.
TEST(InverseDynamics, FollowsATable) {
  const TemporaryFolder folder;
  const std::string path = folder.path("s.toml");
  std::ofstream(path) << drivenPendulum(byTable);
  std::ofstream(folder.path("motion.csv"))
      << "# measured\ntime [ms], knee, hip [deg]\n0, 1, 0\n\n500, 2, 15\n2000, 3, 60\n";
  const Results results = run(readStudy(path));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    const double moment = 0.5 * 9.81 * std::sin(results.time[i] * 30 * M_PI / 180);
    EXPECT_NEAR(results.interval.at.lower(i, 0), 0.2375 * moment, 1e-11);
    EXPECT_NEAR(results.interval.at.upper(i, 0), 0.2625 * moment, 1e-11);
  }
}

/// In a folder with a name as good as any; then without the file.
TEST(InverseDynamics, KeepsItsTables) {
  const TemporaryFolder folder;
  const std::string lab = folder.path("robots in lab"), path = lab + "/s.toml";
  std::filesystem::create_directory(lab);
  std::ofstream(path) << drivenPendulum(byTable);
  const std::string table = "# measured\ntime, hip [deg]\n0, 30\n0.5, 40\n1, 20\n";
  std::ofstream(lab + "/motion.csv") << table;
  const Results results = run(readStudy(path));
  std::filesystem::remove(lab + "/motion.csv");
  EXPECT_THROW(readStudy(path), StudyError);
  const FilesAtHand files{"", namedTextsIn(results.tablesText)};
  EXPECT_EQ(files.tables, (NamedTexts{{"motion.csv", table}}));
  const Study again = readStudyText(results.studyText, "s.toml in results.h5", elementTypes(), files);
  EXPECT_EQ(run(again).interval.at.upper.data, results.interval.at.upper.data);
  EXPECT_THROW(readStudyText(results.studyText, "s.toml", elementTypes(), FilesAtHand{}), StudyError);
}

/// 30 degrees are π/6, which lies between these two doubles.
TEST(InverseDynamics, EnclosesDegreesOfATable) {
  const TemporaryFolder folder;
  const std::string path = folder.path("s.toml");
  std::string text = drivenPendulum(byTable);
  text.replace(text.find("\"servo.force\""), 13, "\"hinge.angle\"");
  std::ofstream(path) << text;
  std::ofstream(folder.path("motion.csv")) << "time, hip [deg]\n0, 30\n1, 30\n";
  const Results results = run(readStudy(path));
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    EXPECT_LE(results.interval.at.lower(i, 0), 0x1.0c152382d7365p-1);
    EXPECT_GE(results.interval.at.upper(i, 0), 0x1.0c152382d7366p-1);
    EXPECT_LE(results.interval.at.upper(i, 0) - results.interval.at.lower(i, 0), 1e-14);
  }
}

TEST(InverseDynamics, IsTightBetweenRowsOfATable) {
  const TemporaryFolder folder;
  const std::string path = folder.path("s.toml");
  std::ofstream(path) << drivenPendulum(byTable);
  std::ofstream table(folder.path("motion.csv"));
  table << "t,hip\n";
  for (int i = 0; i <= 30; ++i) table << i / 20.0 << "," << 0.4 * std::sin(3 * i / 20.0) << "\n";
  table.close();
  const Results results = run(readStudy(path));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.interval.reached, 1.0);
  for (std::size_t i = 1; i < results.time.size(); ++i) {
    const double q = 0.4 * std::sin(3 * results.time[i]), moment = -0.25 * 9 * q + 0.5 * 9.81 * std::sin(q);
    const double sum = results.interval.at.lower(i, 0) + results.interval.at.upper(i, 0);
    EXPECT_NEAR(sum, 0.5 * moment, 1e-3);  // a spline's second derivative errs by h^2/12 of the fourth: 0.0068 rad/s^2
    EXPECT_NEAR(results.interval.at.upper(i, 0) - results.interval.at.lower(i, 0), 0.05 * std::abs(sum), 1e-12);
  }
  EXPECT_LE(results.interval.tightness, 1.02);
}

TEST(InverseDynamics, SaysWhatIsWrongWithATable) {
  const TemporaryFolder folder;
  const std::string study = folder.path("s.toml"), path = folder.path("motion.csv"), text = drivenPendulum(byTable);
  EXPECT_THAT(messageOf(text, study), HasSubstr("s.toml:28:8: the table '" + path + "' cannot be read"));
  const auto with = [&](const std::string& table) {
    std::ofstream(path, std::ios::binary) << table;
    return messageOf(text, study);
  };
  EXPECT_EQ(with("t,hip\n0,1\n1,2\n"), "it was read");
  EXPECT_EQ(with("\xEF\xBB\xBFt,hip\r\n0,1\r\n1,2\r\n"), "it was read");
  EXPECT_THAT(with(""), HasSubstr("it is empty"));
  EXPECT_THAT(with("t,hip\n"), HasSubstr("it has fewer than two rows of numbers"));
  EXPECT_THAT(with("t,hap\n0,1\n1,2\n"), HasSubstr("s.toml:29:10: unknown column 'hip'; expected 'hap'"));
  EXPECT_EQ(with("t,hip\n0,1\n0,2\n"),
            path + ":3:1: the time 0 does not follow the one before; expected times that rise");
  EXPECT_EQ(with("t,hip\n0,1\n1,nan\n"), path + ":3:3: 'nan' is no number; expected a decimal such as -1.5 or 2e-3");
  EXPECT_EQ(with("t,hip\n0,1\n1\n"), path + ":3:1: the row has 1 cells; expected 2 as in the first row");
  EXPECT_EQ(with("t,hip [kg]\n0,1\n1,2\n"), path + ":1:3: the column is in kg; expected a column in rad");
  EXPECT_THAT(with("t,hip\n0,1\n1,1e400\n"), HasSubstr(path + ":3:3: "));
  std::string many = "t,hip\n";
  for (int i = 0; i < 1001; ++i) many += std::to_string(i) + ",0\n";
  EXPECT_EQ(with(many), path + ":1002:1: the table has more than 1000 rows; expected fewer rows");
}

std::string element(const std::string& type, const std::string& name, const std::string& keys) {
  return "[[mechanism.element]]\ntype = \"" + type + "\"\nname = \"" + name + "\"\n" + keys + "\n";
}

/// Both cranks are driven, and turn as often as the horizon lets them.
std::string fiveBar(const std::string& step) {
  const auto hinge = [](const std::string& name, const std::string& from, const std::string& to,
                        const std::string& initial) {
    return element("revolute", name, "from = \"" + from + "\"\nto = \"" + to + "\"\naxis = \"z\"\n" + initial);
  };
  const auto link = [](const std::string& from, const std::string& to, const std::string& length) {
    return element("link", from + to,
                   "from = \"" + from + "\"\nto = \"" + to + "\"\nvector = [\"" + length + "\", 0, 0]");
  };
  const auto bar = [&](const std::string& name, const std::string& joint, const std::string& tip,
                       const std::string& length) {
    return element("mass", name,
                   "at = \"" + joint + "\"\nmass = 0.7\ncentre = [\"" + length +
                       "/2\", 0, 0]\ninertia = "
                       "[\"0.002\", \"0.002\", \"0.002\"]") +
           link(joint, tip, length);
  };
  const auto drive = [](const std::string& name, const std::string& joint, const std::string& position) {
    return element("drive", name, "joint = \"" + joint + "\"\nposition = \"" + position + "\"");
  };
  std::string text =
      "[study]\nanalysis = \"inverse-dynamics\"\nhorizon = 1\noutput_step = " + step +
      "\ncompare = [\"interval\"]\n[mechanism]\ngravity = [0, \"-9.81\", 0]\nparameters = { a = \"0.1 m\", "
      "b = \"0.5 m\", c = \"0.5 m\", d = \"0.12 m\", e = \"0.3 m\" }\n" +
      hinge("A", "inertial", "K1", "") + bar("left crank", "K1", "P1", "a") +
      hinge("B", "P1", "K2", "initial = { angle = \"-60 deg\" }") + bar("left rod", "K2", "T1", "b") +
      link("inertial", "Q", "e") + hinge("D", "Q", "K3", "") + bar("right crank", "K3", "P2", "d") +
      hinge("C", "P2", "K4", "initial = { angle = \"60 deg\" }") + bar("right rod", "K4", "T2", "c") +
      drive("left", "A", "1 rad + 6.283 rad/s*t") + drive("right", "D", "1.1 rad + 9 rad/s*t") +
      element("closure", "tool", "as = \"pin\"\nfrom = \"T1\"\nto = \"T2\"");
  for (const char* length : {"a", "b", "c", "d", "e"})
    text += std::string("[[uncertain]]\nquantity = \"") + length + "\"\ninterval = \"± 1 %\"\n";
  for (const char* output : {"left.force", "right.force", "tool.force.x", "A.reaction.force.y"})
    text += std::string("[[output]]\nquantity = \"") + output + "\"\n";
  return text;
}

/// Between output times that are far apart, against bounds between close ones.
TEST(InverseDynamics, OfAFiveBarIsBoundedTightlyBetweenOutputTimes) {
  const Results far = run(readStudyText(fiveBar("1"), "s.toml"), {}),
                near = run(readStudyText(fiveBar("0.05"), "s.toml"), {});
  ASSERT_EQ(far.interval.reached, 1);
  ASSERT_EQ(near.interval.reached, 1);
  const Bounds &whole = far.interval.over, &parts = near.interval.over;
  for (std::size_t k = 0; k < far.outputs.size(); ++k) {
    double lower = parts.lower(1, k), upper = parts.upper(1, k);
    for (std::size_t i = 2; i < near.time.size(); ++i) {
      lower = std::min(lower, parts.lower(i, k));
      upper = std::max(upper, parts.upper(i, k));
    }
    EXPECT_LE(whole.upper(1, k) - whole.lower(1, k), 1.1 * (upper - lower)) << far.outputs[k].name;
    EXPECT_LE(lower, near.interval.at.lower(10, k)) << far.outputs[k].name;
    EXPECT_LE(near.interval.at.upper(10, k), upper) << far.outputs[k].name;
  }
}

}  // namespace
}  // namespace gamut
