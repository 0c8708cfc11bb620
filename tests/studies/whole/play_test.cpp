// Play in studies: how far a chain reaches that has play in its joints, against closed forms.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

constexpr const char* allDirections = R"([[uncertain]]
quantity = "*.eccentricity"
interval = [0, 1]
distribution = { type = "beta", a = 2, b = 1 }
membership = { type = "triangular", apex = 0 }
[[uncertain]]
quantity = "*.direction"
interval = ["-180 deg", "180 deg"]
membership = { type = "trapezoidal", core = ["-180 deg", "180 deg"] }
)";

/// Arms of 1 m, each behind a play and a hinge about z, the first at `first`, all others in line with it.
std::string chainWithPlay(int arms, const std::string& clearance, const std::string& first,
                          const std::string& uncertain) {
  std::string text = "[study]\ntitle = \"Chain\"\nanalysis = \"kinematics\"\n", from = "inertial";
  const auto element = [&](const std::string& type, const std::string& name, const std::string& to,
                           const std::string& keys) {
    text += "[[mechanism.element]]\ntype = \"" + type + "\"\nname = \"" + name + "\"\nfrom = \"" + from +
            "\"\nto = \"" + to + "\"\n" + keys;
    from = to;
  };
  for (int i = 0; i < arms; ++i) {
    const std::string n = std::to_string(i);
    element("play", "play" + n, "A" + n, "clearance = \"" + clearance + "\"\n");
    element("revolute", "hinge" + n, "B" + n,
            "axis = \"z\"\ninitial = { angle = \"" + (i == 0 ? first : "0 deg") + "\" }\n");
    element("link", "arm" + n, "C" + n, "vector = [1, 0, 0]\n");
  }
  const std::string x = from + ".position.x", y = from + ".position.y";
  text += uncertain;
  for (const std::string& output : {x, y, "sqrt(" + x + "^2 + " + y + "^2)"})
    text += "[[output]]\nquantity = \"" + output + "\"\n";
  return text + "[stochastic]\nsamples = 64\n[limits]\nprobabilities = 0\n";
}

Interval provedRange(const Results& results, std::size_t output) {
  return {results.interval.at.lower(0, output), results.interval.at.upper(0, output)};
}

Interval sampledRange(const Results& results, std::size_t output) {
  return {results.stochastic.envelope.lower(0, output), results.stochastic.envelope.upper(0, output)};
}

/// Discs in a row are a disc of the sum of their radii, whatever the angles between them.
TEST(PlayInStudies, ReachesAsFarAsTheDiscsTogether) {
  for (const auto& [arms, clearance, metres] : {std::tuple(1, "125 mm", 0.125),
                                                {2, "62.5 mm", 0.0625},
                                                {2, "125 mm", 0.125},
                                                {3, "7.8125 mm", 0.0078125},
                                                {10, "0.9765625 mm", 0.0009765625},
                                                {10, "62.5 mm", 0.0625}}) {
    SCOPED_TRACE(std::to_string(arms) + " " + clearance);
    const Results results = run(readStudyText(chainWithPlay(arms, clearance, "0 deg", allDirections), "chain"));
    EXPECT_EQ(results.comparison.verdict, Agreement::inside);
    const double length = arms, radius = arms * metres;  // exact
    for (const auto& [output, middle] : {std::pair(0, length), {1, 0.0}, {2, length}}) {
      SCOPED_TRACE(output);
      const Interval found = provedRange(results, static_cast<std::size_t>(output)),
                     sampled = sampledRange(results, static_cast<std::size_t>(output));
      EXPECT_LE(found.lower(), middle - radius);
      EXPECT_GE(found.upper(), middle + radius);
      EXPECT_LE(width(found), 1.01 * 2 * radius);
      EXPECT_GE(width(sampled), 0.97 * 2 * radius);
    }
  }
}

/// At each level a disc of what its cut leaves of the radius: 1 − α.
TEST(PlayInStudies, IsADiscAtEveryLevel) {
  const Results results = run(readStudyText(chainWithPlay(5, "15.625 mm", "0 deg", allDirections), "chain"));
  const auto& alpha = results.fuzzy.alpha;
  for (std::size_t level = 0; level < alpha.size(); ++level) {
    const double radius = 5 * 0.015625 * (1 - alpha[level]);
    const Bounds &outer = results.fuzzy.outer[level], &inner = results.fuzzy.inner[level];
    EXPECT_LE(outer.lower(0, 1), -radius * (1 - 1e-12));
    EXPECT_LE(outer.upper(0, 1) - outer.lower(0, 1), 1.01 * 2 * radius + 1e-12);
    EXPECT_GE(inner.upper(0, 1) - inner.lower(0, 1), 0.97 * 2 * radius - 1e-12);
  }
}

/// The first angle is known to 0.1 rad: y reaches from below to above as the arm's end does, and the disc with it.
TEST(PlayInStudies, GoesAlongWithOtherTolerances) {
  const std::string angle = "[[uncertain]]\nquantity = \"hinge0.angle\"\ninterval = [-0.125, 0.125]\n";
  const Results results = run(readStudyText(chainWithPlay(3, "31.25 mm", "0 deg", angle + allDirections), "chain"));
  const Interval swung = 3.0 * sin(Interval(0.125)) + 3 * 0.03125, short_ = 3.0 * cos(Interval(0.125)) - 3 * 0.03125;
  const Interval y = provedRange(results, 1), x = provedRange(results, 0), reach = provedRange(results, 2);
  EXPECT_GE(y.upper(), swung.lower());
  EXPECT_LE(y.lower(), -swung.lower());
  EXPECT_LE(width(y), 1.01 * 2 * swung.upper());
  EXPECT_LE(x.lower(), short_.upper());
  EXPECT_GE(x.upper(), 3 + 3 * 0.03125);
  EXPECT_LE(width(x), 1.03 * (3 + 3 * 0.03125 - short_.lower()));
  EXPECT_LE(reach.lower(), 3 - 3 * 0.03125);
  EXPECT_GE(reach.upper(), 3 + 3 * 0.03125);
  EXPECT_LE(width(reach), 1.05 * 6 * 0.03125);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
}

/// A slider whose ends lie off by c at most: its middle by c, and turned by asin(2 c/l).
TEST(PlayInStudies, OfAGuideLeavesItsSliderAskew) {
  const std::string text = R"([study]
title = "Slider"
analysis = "kinematics"
[[mechanism.element]]
type = "guide-play"
name = "guide"
from = "inertial"
to = "K"
clearance = "62.5 mm"
length = "1 m"
[[mechanism.element]]
type = "link"
name = "arm"
from = "K"
to = "tip"
vector = [2, 0, 0]
[[uncertain]]
quantity = ["guide.front", "guide.rear"]
interval = [-1, 1]
[[output]]
quantity = "K.position.y"
[[output]]
quantity = "tip.position.y"
[stochastic]
samples = 64
)";
  const Results results = run(readStudyText(text, "slider"));
  const Interval middle = provedRange(results, 0), tip = provedRange(results, 1);
  EXPECT_LE(middle.lower(), -0.0625);
  EXPECT_LE(width(middle), 0.125 * (1 + 1e-6));
  // y = c (f + r)/2 + 2 (f − r) c/1 m: greatest for f = 1, r = −1.
  EXPECT_GE(tip.upper(), 0.25);
  EXPECT_LE(width(tip), 0.5 * (1 + 1e-4));
}

/// Play that is not known to keep still: any course within the disc, by the guarantee.
TEST(PlayInStudies, MayVaryInTime) {
  const std::string text = R"([study]
title = "Driven arm"
analysis = "inverse-dynamics"
horizon = 1
output_step = 0.25
compare = ["interval", "stochastic"]
[[mechanism.element]]
type = "play"
name = "pin"
from = "inertial"
to = "A"
clearance = "31.25 mm"
eccentricity = "1/2"
[[mechanism.element]]
type = "revolute"
name = "hinge"
from = "A"
to = "B"
axis = "z"
[[mechanism.element]]
type = "link"
name = "arm"
from = "B"
to = "tip"
vector = [1, 0, 0]
[[mechanism.element]]
type = "mass"
name = "bob"
at = "tip"
mass = 1
[[mechanism.element]]
type = "drive"
name = "turn"
joint = "hinge"
position = "1 rad/s * t"
[[uncertain]]
quantity = "pin.eccentricity"
interval = [0, 1]
varies = "freely"
[[output]]
quantity = "tip.position.x"
[stochastic]
samples = 64
)";
  const Results results = run(readStudyText(text, "arm"));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    const Interval exact = cos(Interval(results.time[i])) + Interval(0.0, 0.03125);  // its direction is 0
    EXPECT_LE(results.interval.at.lower(i, 0), exact.lower() + width(cos(Interval(results.time[i]))));
    EXPECT_GE(results.interval.at.upper(i, 0), exact.upper() - width(cos(Interval(results.time[i]))));
    EXPECT_LE(results.interval.at.upper(i, 0) - results.interval.at.lower(i, 0), 1.01 * 0.03125);
  }
}

TEST(PlayInStudies, IsRefusedBeyondItsClearance) {
  const std::string text =
      chainWithPlay(1, "1 mm", "0 deg", "[[uncertain]]\nquantity = \"play0.eccentricity\"\ninterval = [0, 1.5]\n");
  EXPECT_THAT(messageOf(text), ::testing::HasSubstr("the eccentricity of 'play0' is not from 0 to 1"));
}

}  // namespace
}  // namespace gamut
