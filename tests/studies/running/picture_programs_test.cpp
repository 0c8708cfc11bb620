// What the results hold for the picture: where the assembly is, samples inside the enclosures at shown times and
// between them, limits of how much is shown.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "mechanics/assembly.hpp"
#include "studies/running/picture_programs.hpp"
#include "studies/running/run.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Results seenResults(const std::string& text) { return run(readStudyText(text, "sample.toml")); }

std::string fine(const std::string& step) { return sampleStudyWith("output_step = 0.1", "output_step = " + step); }

std::size_t pointNamed(const PictureResult& machine, const std::string& name) {
  const auto found = std::ranges::find(machine.points, name, &PointInfo::name);
  EXPECT_NE(found, machine.points.end()) << name;
  return static_cast<std::size_t>(found - machine.points.begin());
}

TEST(SeenMachine, NamesPointsAndParts) {
  const PictureResult machine = seenResults(sampleStudy).picture;
  ASSERT_TRUE(machine.present);
  ASSERT_EQ(machine.points.size(), 2u);
  EXPECT_EQ(machine.points[0].name, "inertial");
  EXPECT_TRUE(machine.points[0].isFixed);
  EXPECT_EQ(machine.points[1].name, "tip");
  ASSERT_EQ(machine.parts.size(), 3u);
  EXPECT_EQ(machine.parts[0].kind, PartKind::joint);
  EXPECT_EQ(machine.parts[1].kind, PartKind::rigid);
  EXPECT_EQ(machine.parts[2].kind, PartKind::mass);
  EXPECT_EQ(machine.parts[2].mass, 0.25);
  EXPECT_EQ(machine.parts[2].told, "g");
  ASSERT_EQ(machine.axes.size(), 1u);
  EXPECT_EQ(machine.axes[0].part, 0u);
  ASSERT_EQ(machine.directions.size(), 3u);
  EXPECT_DOUBLE_EQ(machine.directions[2].gravity, -9.81);
  EXPECT_THAT(machine.why, IsEmpty());
}

TEST(SeenMachine, IsWhereTheAssemblyIsInTheNominalMotion) {
  const Study study = readStudyText(sampleStudy, "sample.toml");
  const Results results = run(study);
  const Places& places = results.picture.places;
  ASSERT_EQ(places.time, results.time);
  const KeptSamples& kept = results.stochastic.kept;
  const std::size_t centre = kept.motionNumber.size() - 1, times = results.time.size();  // the nominal motion
  Assembly<double> assembly(study.mechanism);
  for (std::size_t i = 0; i < times; ++i) {
    const double angle = kept.motions[(centre * times + i) * 2];
    assembly.setState(std::vector<double>{angle, 0.0});
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(places.nominal[(2 * i + 1) * 3 + d], assembly.output(std::string("tip.position.") + components[d]),
                  1e-9);
    EXPECT_EQ(places.axes[3 * i], 1.0);
  }
}

/// Of every sample and every output time between two shown times: the point lies within the boxes' convex combination,
/// wider by the sag, in every direction. No tolerance.
void expectSamplesInside(const Results& results) {
  const Places& places = results.picture.places;
  const std::size_t points = results.picture.points.size(), tip = pointNamed(results.picture, "tip"), outputs = 2;
  const KeptSamples& kept = results.stochastic.kept;
  ASSERT_GT(kept.motionNumber.size(), 1u);
  const auto at = [&](std::size_t row, std::size_t d) { return 3 * (row * points + tip) + d; };
  for (std::size_t s = 0; s < kept.motionNumber.size(); ++s)
    for (std::size_t row = 1; row < places.time.size(); ++row)
      for (std::size_t i = 0; i < results.time.size(); ++i) {
        const double t = results.time[i], from = places.time[row - 1], to = places.time[row];
        if (t < from || t > to) continue;
        const double share = (t - from) / (to - from);
        for (std::size_t d = 1; d < 3; ++d) {
          const double x = kept.motions[(s * results.time.size() + i) * outputs + d - 1];
          const double sag = places.sag[at(row, d)];
          EXPECT_GE(x, (1 - share) * places.lower[at(row - 1, d)] + share * places.lower[at(row, d)] - sag) << s << t;
          EXPECT_LE(x, (1 - share) * places.upper[at(row - 1, d)] + share * places.upper[at(row, d)] + sag) << s << t;
        }
      }
  for (std::size_t s = 0; s < places.sample.size(); ++s)
    for (std::size_t row = 0; row < places.time.size(); ++row)
      for (std::size_t d = 1; d < 3; ++d) {
        const double x = places.samples[s * places.time.size() * points * 3 + at(row, d)];
        EXPECT_GE(x, places.lower[at(row, d)]);
        EXPECT_LE(x, places.upper[at(row, d)]);
      }
}

/// With both coordinates of the tip for outputs.
std::string withTip(std::string text) {
  const std::string angle = "name = \"angle\"\nquantity = \"hinge.angle\"";
  return text.replace(text.find(angle), angle.size(), "quantity = \"tip.position.y\"");
}

TEST(SeenMachine, HoldsSamplesAtShownTimesAndBetween) {
  const Results results = seenResults(withTip(fine("0.0005")));
  ASSERT_EQ(results.outputs[0].quantity, "tip.position.y");
  ASSERT_EQ(results.outputs[1].quantity, "tip.position.z");
  EXPECT_LE(results.picture.places.time.size(), mostSeenTimes);
  EXPECT_LT(results.picture.places.time.size(), results.time.size());
  EXPECT_EQ(results.picture.places.time.back(), 0.5);
  EXPECT_EQ(results.picture.places.sample.size(), seenSamples);
  expectSamplesInside(results);
}

TEST(SeenMachine, HoldsSamplesOfARodWhoseLengthVariesInTime) {
  std::string text = withTip(fine("0.001"));
  text += "[[uncertain]]\nquantity = \"rod.length\"\ninterval = \"± 1 %\"\nvaries = \"freely\"\n";
  expectSamplesInside(seenResults(text));
}

TEST(SeenMachine, IsTightlyEnclosed) {
  const Results results = seenResults(sampleStudy);
  const Places& places = results.picture.places;
  const std::size_t tip = pointNamed(results.picture, "tip"), points = results.picture.points.size();
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    const std::size_t z = 3 * (i * points + tip) + 2;
    EXPECT_LE(places.upper[z] - places.lower[z],
              1.02 * (results.interval.at.upper(i, 1) - results.interval.at.lower(i, 1)) + 1e-12);
  }
}

TEST(SeenMachine, ShowsWhatWasAskedForAlone) {
  const auto compared = [](const std::string& words) {
    return seenResults(sampleStudyWith("\"interval\", \"stochastic\", \"fuzzy\"", words)).picture;
  };
  const PictureResult samples = compared("\"stochastic\"");
  EXPECT_TRUE(samples.places.lower.empty());
  EXPECT_FALSE(samples.places.samples.empty());
  EXPECT_THAT(samples.why, IsEmpty());
  const PictureResult enclosure = compared("\"interval\"");
  EXPECT_FALSE(enclosure.places.lower.empty());
  EXPECT_TRUE(enclosure.places.samples.empty());
  EXPECT_TRUE(compared("\"fuzzy\"").places.lower.empty());
}

TEST(SeenMachine, StandsAtItsStartWhereTheRunWasInterrupted) {
  const std::atomic<bool> cancelled{true};
  RunOptions options;
  options.cancelled = &cancelled;
  const PictureResult machine = run(readStudyText(sampleStudy, "sample.toml"), options).picture;
  ASSERT_TRUE(machine.present);
  EXPECT_NEAR(machine.places.nominal[4], 0.25, 1e-15);  // sin 30° / 2
  EXPECT_NE(machine.why, "");
}

TEST(SeenMachine, OfKinematicsIsEnclosedWhereItStands) {
  std::string text = sampleStudyWith("\"dynamics\"", "\"kinematics\"");
  for (const std::string line : {"horizon = 0.5\n", "output_step = 0.1\n"}) text.erase(text.find(line), line.size());
  const PictureResult machine = seenResults(text).picture;
  ASSERT_EQ(machine.places.time, std::vector<double>{0});
  const std::size_t y = 3 * pointNamed(machine, "tip") + 1;
  for (std::size_t s = 0; s < machine.places.sample.size(); ++s) {
    EXPECT_GE(machine.places.samples[6 * s + y], machine.places.lower[y]);
    EXPECT_LE(machine.places.samples[6 * s + y], machine.places.upper[y]);
  }
  EXPECT_LT(machine.places.upper[y] - machine.places.lower[y], 0.006);
}

TEST(SeenMachine, OfPlainDifferentialEquationsIsNotThere) {
  const PictureResult machine = seenResults(R"([study]
analysis = "dynamics"
horizon = 0.5
output_step = 0.1
[[mechanism.element]]
type = "state"
name = "prey"
initial = 1
rate = "-prey"
[[uncertain]]
quantity = "prey"
interval = "± 1 %"
[[output]]
quantity = "prey"
[stochastic]
samples = 8
)")
                                    .picture;
  EXPECT_FALSE(machine.present);
  EXPECT_FALSE(machine.places.present);
  EXPECT_THAT(machine.points, IsEmpty());
}

const char* const roadStudy = R"toml([study]
analysis = "dynamics"
horizon = 0.5
output_step = 0.1
[[mechanism.element]]
type = "prismatic"
name = "lift"
from = "inertial"
to = "ground"
axis = "-z"
[[mechanism.element]]
type = "drive"
name = "road"
joint = "lift"
position = "0.1 m*sin(3 rad/s*t)"
profile_speed = "18 km/h"
along = "y"
[[mechanism.element]]
type = "link"
name = "wheel"
from = "ground"
to = "rest"
vector = [0, 0, 0.5]
[[mechanism.element]]
type = "prismatic"
name = "tyre"
from = "rest"
to = "axle"
axis = "z"
[[mechanism.element]]
type = "mass"
name = "body"
at = "axle"
mass = 20
[[mechanism.element]]
type = "joint-spring"
name = "rubber"
joint = "tyre"
stiffness = 2e3
[[uncertain]]
quantity = "body.mass"
interval = "± 1 %"
[[output]]
quantity = "tyre.displacement"
[stochastic]
samples = 8
)toml";

/// What lies ahead by s is what the drive comes to s/v later, also behind the end of the motion, and ahead of its
/// start.
TEST(SeenMachine, TellsTheRoadAheadAndBehind) {
  const Results results = seenResults(roadStudy);
  const PictureResult& machine = results.picture;
  ASSERT_EQ(machine.profiles.size(), 1u);
  const ProfileInfo& road = machine.profiles[0];
  EXPECT_EQ(machine.parts[road.part].kind, PartKind::profile);
  EXPECT_EQ(road.name, "road");
  EXPECT_DOUBLE_EQ(road.reach, 0.5) << "as far as the machine is large";
  const Places& places = machine.places;
  ASSERT_EQ(places.step.size(), 2 * seenSteps + 1);
  ASSERT_EQ(road.heights.size(), places.time.size() * places.step.size());
  for (std::size_t row = 0; row < places.time.size(); ++row)
    for (std::size_t k = 0; k < places.step.size(); ++k) {
      const double now = places.time[row], then = now + 0.5 * places.step[k] / 5.0;
      EXPECT_NEAR(road.heights[row * places.step.size() + k], 0.1 * (std::sin(3 * then) - std::sin(3 * now)), 1e-15);
    }
}

/// Of a speed that is 0 in the middle of its range: the road that it meets at the greatest, which stays where it is.
TEST(SeenMachine, TellsTheRoadOfAMachineThatStands) {
  std::string text = roadStudy;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("[[mechanism.element]]", "[mechanism.parameters]\nspeed = \"0 km/h\"\n[[mechanism.element]]");
  replace("0.1 m*sin(3 rad/s*t)", "0.1 m*sin(0.6 rad/m*speed*t)");
  replace("profile_speed = \"18 km/h\"", "profile_speed = \"speed\"");
  replace("[[output]]", "[[uncertain]]\nquantity = \"speed\"\ninterval = \"± 18 km/h\"\n[[output]]");
  const PictureResult machine = seenResults(text).picture;
  ASSERT_EQ(machine.profiles.size(), 1u);
  const ProfileInfo& road = machine.profiles[0];
  const std::vector<double>& step = machine.places.step;
  ASSERT_EQ(road.heights.size(), machine.places.time.size() * step.size());
  for (std::size_t i = 0; i < road.heights.size(); ++i)
    EXPECT_NEAR(road.heights[i], 0.1 * std::sin(0.6 * 0.5 * step[i % step.size()]), 1e-15);
}

TEST(SeenMachine, OfManyPointsShowsFewerTimesAndEnclosesNone) {
  std::string text = sampleStudyWith("horizon = 0.5\noutput_step = 0.1", "horizon = 0.01\noutput_step = 0.0001");
  std::string more;
  for (std::size_t i = 0; i <= mostEnclosedPoints; ++i)
    more += "[[mechanism.element]]\ntype = \"link\"\nname = \"l" + std::to_string(i) + "\"\nfrom = \"tip\"\nto = \"e" +
            std::to_string(i) + "\"\nvector = [0, 0.01, " + std::to_string(0.001 * static_cast<double>(i)) + "]\n";
  text.insert(text.find("[[uncertain]]"), more);
  const PictureResult machine = seenResults(text).picture;
  EXPECT_EQ(machine.places.time.size(), leastSeenTimes - 5u);
  EXPECT_TRUE(machine.places.lower.empty());
  EXPECT_NE(machine.why.find("moving points"), std::string::npos);
}

}  // namespace
}  // namespace gamut
