// Play in loops that are driven: over a sweep, enclosures hold what closed forms say, and little more.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace whole_turns {
namespace {

std::string element(const std::string& type, const std::string& name, const std::string& keys) {
  return "[[mechanism.element]]\ntype = \"" + type + "\"\nname = \"" + name + "\"\n" + keys + "\n";
}

std::string between(const std::string& from, const std::string& to) {
  return "from = \"" + from + "\"\nto = \"" + to + "\"\n";
}

/// A sweep whose joints get play one after the other, as long as there is some left.
struct Sweep {
  std::string text, clearance;
  int plays;
  int added = 0;

  Sweep(const std::string& drive, std::string radius, int count)
      : text(
            "[study]\nanalysis = \"inverse-dynamics\"\nhorizon = \"1 s\"\noutput_step = \"0.125 s\"\n"
            "compare = [\"interval\", \"stochastic\"]\n[distribution]\ntimes = 0\n[stochastic]\nsamples = 64\n"),
        clearance(std::move(radius)),
        plays(count) {
    hinge("crank", "inertial", "");
    text += element("drive", "input", "joint = \"crank\"\nposition = \"" + drive + "\"");
  }

  std::string behindPlay(const std::string& frame) {
    if (added == plays) return frame;
    const std::string bore = "bore" + std::to_string(added);
    text +=
        element("play", "play" + std::to_string(added++), between(frame, bore) + "clearance = \"" + clearance + '"');
    return bore;
  }
  void hinge(const std::string& name, const std::string& from, const std::string& angle) {
    text += element("revolute", name,
                    between(behindPlay(from), name + "_frame") + "axis = \"z\"" +
                        (angle.empty() ? "" : "\ninitial = { angle = \"" + angle + "\" }"));
  }
  void arm(const std::string& name, const std::string& from, const std::string& length) {
    text += element("link", name,
                    between(from, name + "_end") + "vector = [\"" + name +
                        ".length\", 0, 0]\nparameters = { length = \"" + length + "\" }");
  }
  std::string with(const std::string& varies, const std::vector<std::string>& outputs) const {
    std::string all = text;
    for (const char* const interval :
         {"eccentricity\"\ninterval = [0, 1]", "direction\"\ninterval = [\"-180 deg\", \"180 deg\"]"})
      all += std::string("[[uncertain]]\nquantity = \"play*.") + interval + "\n" + varies;
    for (const std::string& output : outputs) all += "[[output]]\nquantity = \"" + output + "\"\n";
    return all;
  }
};

/// A crank of 0.1 m that goes round, a coupler of 0.4 m and a rocker of 0.3 m on a pivot 0.35 m away.
Sweep fourBar(const std::string& drive, const std::string& radius, int plays) {
  Sweep sweep(drive, radius, plays);
  sweep.arm("crank_arm", "crank_frame", "100 mm");
  sweep.hinge("coupler", "crank_arm_end", "0 deg");
  sweep.arm("coupler_arm", "coupler_frame", "400 mm");
  sweep.arm("ground", "inertial", "350 mm");
  sweep.hinge("rocker", "ground_end", "80 deg");
  sweep.arm("rocker_arm", "rocker_frame", "300 mm");
  sweep.text +=
      element("closure", "pin", "as = \"pin\"\n" + between(sweep.behindPlay("rocker_arm_end"), "coupler_arm_end"));
  return sweep;
}

/// A crank of 0.1 m, a rod of 0.3 m and a slider in line with it.
Sweep sliderCrank(const std::string& drive, const std::string& radius, int plays) {
  Sweep sweep(drive, radius, plays);
  sweep.arm("crank_arm", "crank_frame", "100 mm");
  sweep.hinge("coupler", "crank_arm_end", "-40 deg");
  sweep.arm("coupler_arm", "coupler_frame", "300 mm");
  sweep.text += element("prismatic", "slide",
                        between("inertial", "slider") + "axis = \"x\"\ninitial = { displacement = \"350 mm\" }");
  sweep.text += element("closure", "pin", "as = \"pin\"\n" + between(sweep.behindPlay("slider"), "coupler_arm_end"));
  return sweep;
}

Interval metres(int millimetres) { return Interval(millimetres) / Interval(1000.0); }

/// Between values that the output is known to have as the crank's end is moved by all discs together, a disc of the sum
/// of their radii: it is extreme on the rim.
template <class Output>
Interval reach(double angle, double radius, const Output& output) {
  constexpr int points = 10000;
  constexpr double inside = 1 - 0x1p-40;  // so that points of doubles are
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (int k = 0; k < points; ++k) {
    const double at = 2 * std::numbers::pi * k / points;
    const Interval value = output(metres(100) * cos(Interval(angle)) + radius * inside * std::cos(at),
                                  metres(100) * sin(Interval(angle)) + radius * inside * std::sin(at));
    least = std::min(least, value.upper());
    greatest = std::max(greatest, value.lower());
  }
  return {least, greatest};
}

/// With the crank's end there, to the left of the rocker's pivot.
Interval rockerAngle(const Interval& x, const Interval& y) {
  const Interval away = metres(350) - x, r = sqrt(square(away) + square(y));
  return acos(Interval(-1.0)) - atan2(y, away) -
         acos((square(r) + square(metres(300)) - square(metres(400))) / (2.0 * metres(300) * r));
}

Interval sliderPlace(const Interval& x, const Interval& y) { return x + sqrt(square(metres(300)) - square(y)); }

/// Against the crank, which is at this angle.
auto couplerAngle(double crank) {
  return [crank](const Interval& x, const Interval& y) {
    const Interval away = metres(350) - x, r = sqrt(square(away) + square(y));
    return acos((square(r) + square(metres(400)) - square(metres(300))) / (2.0 * metres(400) * r)) - atan2(y, away) -
           Interval(crank);
  };
}

void expectTight(const Results& results, const std::vector<Interval>& truth, double most) {
  ASSERT_EQ(results.interval.reached, 1) << results.interval.why;
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double lower = results.interval.at.lower(i, 0), upper = results.interval.at.upper(i, 0);
    EXPECT_LE(lower, truth[i].lower()) << i;
    EXPECT_GE(upper, truth[i].upper()) << i;
    EXPECT_LE(upper - lower, most * width(truth[i])) << i;
  }
}

TEST(PlayInLoops, IsTightOverASweepOfAFourBar) {
  for (const auto& [radius, metres] : {std::pair("50 um", 5e-5), {"0.5 mm", 5e-4}, {"1 mm", 1e-3}, {"2 mm", 2e-3}})
    for (const int plays : {1, 2, 4}) {
      SCOPED_TRACE(std::string(radius) + " " + std::to_string(plays));
      const Results results = run(readStudyText(
          fourBar("0.75 rad + 1 rad/s*t", radius, plays).with("", {"rocker.angle", "coupler_arm_end.position.y"}),
          "s"));
      std::vector<Interval> truth;
      for (int i = 0; i <= 8; ++i) truth.push_back(reach(0.75 + 0.125 * i, plays * metres, rockerAngle));
      expectTight(results, truth, 1.05);
    }
}

/// The crank goes round: so does the coupler's angle against it, the other way, and the rocker swings to and fro.
TEST(PlayInLoops, IsTightWhereTheCrankGoesRound) {
  for (const int plays : {1, 4})
    for (const std::string output : {"rocker.angle", "coupler.angle"}) {
      SCOPED_TRACE(output + " " + std::to_string(plays));
      const Results results =
          run(readStudyText(fourBar("0.75 rad + 13 rad/s*t", "1 mm", plays).with("", {output}), "s"));
      std::vector<Interval> truth;
      for (int i = 0; i <= 8; ++i) {
        const double angle = 0.75 + 1.625 * i;
        truth.push_back(output[0] == 'r' ? reach(angle, plays * 1e-3, rockerAngle)
                                         : reach(angle, plays * 1e-3, couplerAngle(angle)));
      }
      expectTight(results, truth, 1.05);
    }
}

TEST(PlayInLoops, IsTightOfASliderThroughBothDeadCentres) {
  for (const int plays : {1, 3}) {
    SCOPED_TRACE(plays);
    const Results results =
        run(readStudyText(sliderCrank("-0.5 rad + 4 rad/s*t", "0.5 mm", plays).with("", {"slide.displacement"}), "s"));
    std::vector<Interval> truth;
    for (int i = 0; i <= 8; ++i) truth.push_back(reach(-0.5 + 0.5 * i, plays * 5e-4, sliderPlace));
    expectTight(results, truth, 1.05);
  }
}

/// What varies is anything at each moment.
TEST(PlayInLoops, MayVaryInTime) {
  const Results results = run(
      readStudyText(fourBar("0.75 rad + 1 rad/s*t", "1 mm", 2).with("varies = \"freely\"\n", {"rocker.angle"}), "s"));
  std::vector<Interval> truth;
  for (int i = 0; i <= 8; ++i) truth.push_back(reach(0.75 + 0.125 * i, 2e-3, rockerAngle));
  expectTight(results, truth, 1.05);
}

}  // namespace
}  // namespace whole_turns
}  // namespace gamut
