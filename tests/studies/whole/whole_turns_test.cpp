// Play in loops that are driven: over a sweep, enclosures hold what closed forms say, and little more.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "analyses/zero_free.hpp"
#include "studies/machine.hpp"
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

/// A crank, a coupler and a rocker [mm] on a pivot so far away, from where the nominal linkage is assembled about
/// there.
Sweep linkage(const std::string& drive, const std::array<std::string, 4>& lengths, const std::string& coupler,
              const std::string& rocker, const std::string& radius, int plays) {
  Sweep sweep(drive, radius, plays);
  sweep.arm("crank_arm", "crank_frame", lengths[0]);
  sweep.hinge("coupler", "crank_arm_end", coupler);
  sweep.arm("coupler_arm", "coupler_frame", lengths[1]);
  sweep.arm("ground", "inertial", lengths[3]);
  sweep.hinge("rocker", "ground_end", rocker);
  sweep.arm("rocker_arm", "rocker_frame", lengths[2]);
  sweep.text += element("closure", "pin",
                        "as = \"pin\"\n" + between(sweep.behindPlay("rocker_arm_end"), "coupler_arm_end") +
                            "axis = \"z\"\ndependent = [\"coupler\", \"rocker\"]");
  return sweep;
}

/// A drag link, whose shortest link is the frame, so that all others turn wholly: the rocker's angle, which goes round
/// as the crank's does.
Interval dragAngle(const Interval& crank, const Interval& coupler) {
  const Interval x = metres(300) * cos(crank) - metres(100), y = metres(300) * sin(crank), angle = atan2(y, x);
  const Interval r = sqrt(square(x) + square(y)), turn = 2.0 * acos(Interval(-1.0));
  return angle + std::round((midpoint(crank) - midpoint(angle)) / (2 * std::numbers::pi)) * turn +
         acos((square(r) + square(metres(280)) - square(coupler)) / (2.0 * metres(280) * r));
}

/// Through twenty turns by a drive that is off by so many degrees, or a coupler by so many percent, at any time: at
/// each time no wider than what a constant deviation does, and between these finite.
TEST(VaryingLoops, AreTightThroughManyTurnsOfADragLink) {
  const std::array<std::string, 4> lengths = {"300 mm", "250 mm", "280 mm", "100 mm"};
  constexpr double inside = 1 - 0x1p-40;
  constexpr double off = 5;
  for (const bool isLength : {false, true}) {
    SCOPED_TRACE(isLength ? "coupler" : "drive");
    Sweep sweep = linkage(isLength ? "0.75 rad + 13 rad/s*t" : "0.75 rad + 13 rad/s*t + phase", lengths, "60 deg",
                          "110 deg", "", 0);
    sweep.text.replace(sweep.text.find("\"1 s\""), 5, "\"10 s\"");
    sweep.text.replace(sweep.text.find("samples = 64"), 12, "samples = 8");
    sweep.text.insert(sweep.text.find("[[mechanism.element]]"), "[mechanism]\nparameters = { phase = \"0 deg\" }\n");
    sweep.text += "[[uncertain]]\nquantity = \"" + std::string(isLength ? "coupler_arm.length" : "phase") +
                  "\"\ninterval = \"± " + std::to_string(off) + (isLength ? " %" : " deg") +
                  "\"\nvaries = \"freely\"\n[[output]]\nquantity = \"rocker.angle\"\n";
    const Results results = run(readStudyText(sweep.text, "s"));
    ASSERT_EQ(results.interval.reached, 10) << results.interval.why;
    EXPECT_EQ(results.comparison.verdict, Agreement::inside);
    for (int i = 0; i <= 80; ++i) {
      Interval truth = Interval::empty();
      for (const double end : {-inside, inside})
        truth = hull(
            truth, isLength ? dragAngle(Interval(0.75 + 1.625 * i), metres(250) * (1 + end * off / 100))
                            : dragAngle(Interval(0.75 + 1.625 * i + end * off * std::numbers::pi / 180), metres(250)));
      const double lower = results.interval.at.lower(i, 0), upper = results.interval.at.upper(i, 0);
      EXPECT_LE(lower, truth.lower()) << i;
      EXPECT_GE(upper, truth.upper()) << i;
      EXPECT_LE(upper - lower, 1.01 * width(truth)) << i;
      EXPECT_LE(results.interval.over.upper(i, 0) - results.interval.over.lower(i, 0), 6) << i;
    }
  }
}

/// Samples say what is singular where they end, and of which loop.
TEST(VaryingLoops, TellTheDeadPointThatSamplesComeTo) {
  const Results results = run(readStudyText(
      linkage("0.9 rad + 2 rad/s*t", {"300 mm", "400 mm", "250 mm", "350 mm"}, "-60 deg", "100 deg", "", 0).text +
          "[[uncertain]]\nquantity = \"coupler_arm.length\"\ninterval = \"± 5 %\"\nvaries = \"freely\"\n"
          "[[output]]\nquantity = \"rocker.angle\"\n",
      "s"));
  EXPECT_LT(results.stochastic.reached, 1);
  const std::string dead = "the loop 'pin' comes to a dead point of coupler.angle, rocker.angle";
  EXPECT_THAT(results.stochastic.why, ::testing::HasSubstr(dead));
  ASSERT_FALSE(results.stochastic.failed.empty());
  EXPECT_THAT(results.stochastic.failed[0].why, ::testing::HasSubstr(dead));
}

Sweep parallelogram(const std::string& drive, const std::string& radius) {
  return linkage(drive, {"200 mm", "500 mm", "200 mm", "500 mm"}, "-0.29 rad", "0.31 rad", radius, 1);
}

std::string demanding(const std::string& study, const std::string& what, const std::string& window) {
  return study + "[[requirement]]\nname = \"demanded\"\nalways = \"" + what + "\"\n" + window + "\n";
}

/// The enclosure ends between these times, of a loop's dead point, and says nothing of what comes behind.
void expectEnd(const Results& results, double earliest, double latest, const std::string& why = "dead point of") {
  const IntervalResult& interval = results.interval;
  EXPECT_GE(interval.reached, earliest) << interval.why;
  EXPECT_LE(interval.reached, latest);
  EXPECT_THAT(interval.why, ::testing::HasSubstr(why));
  for (std::size_t i = 0; i < results.time.size(); ++i)
    EXPECT_EQ(std::isnan(interval.at.lower(i, 0)) && std::isnan(interval.over.lower(i, 0)),
              results.time[i] > interval.reached)
        << results.time[i];
}

/// The same, of what is demanded behind: some values may be proved to violate it, which do not come there.
void expectUndecidedBehind(const Results& results, double earliest, double latest) {
  expectEnd(results, earliest, latest);
  ASSERT_EQ(results.requirements.size(), 1u);
  EXPECT_NE(results.requirements[0].word, Decision::met);
  EXPECT_NE(results.requirements[0].word, Decision::violated);
}

Results enclosed(std::string study) {
  const std::string samples = ", \"stochastic\"";
  study.erase(study.find(samples), samples.size());
  return run(readStudyText(study, "s"));
}

/// Where all links of a parallelogram lie in line it may go on with its cranks crossed: which of both ways is taken,
/// nobody knows.
TEST(PlayInLoops, EndsWhereAParallelogramMayCross) {
  const double inLine = (std::numbers::pi - 0.3) / 5;
  for (const std::string varies : {"", "varies = \"freely\"\n"})
    for (const std::string demand :
         {"rocker.angle - crank.angle < -0.5 rad", "rocker.angle - crank.angle > -0.5 rad"}) {
      SCOPED_TRACE(varies + demand);
      const std::string study = parallelogram("0.3 rad + 5 rad/s*t", "1 um").with(varies, {"rocker.angle"});
      expectUndecidedBehind(enclosed(demanding(study, demand, "from = \"0.75 s\"")), 0.95 * inLine, inLine);
    }
}

/// The same by a rod whose length alone varies, from where the cranks are crossed.
TEST(PlayInLoops, EndsWhereARodMayUncross) {
  const double inLine = (std::numbers::pi - 0.3) / 5;
  Sweep sweep("0.3 rad + 5 rad/s*t", "1 um", 0);
  sweep.arm("crank_arm", "crank_frame", "200 mm");
  sweep.arm("ground", "inertial", "500 mm");
  sweep.hinge("rocker", "ground_end", "5.615 rad");
  sweep.arm("rocker_arm", "rocker_frame", "200 mm");
  sweep.text +=
      element("rod", "rod",
              between("crank_arm_end", "rocker_arm_end") + "length = \"rod.size\"\nparameters = { size = \"500 mm\" }");
  const std::string study = sweep.text + "[[uncertain]]\nquantity = \"rod.size\"\ninterval = \"± 0.0001 %\"\n" +
                            "varies = \"freely\"\n[[output]]\nquantity = \"rocker.angle\"\n";
  expectUndecidedBehind(enclosed(demanding(study, "rocker.angle - crank.angle < -0.5 rad", "from = \"0.75 s\"")),
                        0.95 * inLine, inLine);
}

/// Two links stretched all but as long as both others together, by less than the play there is: between two output
/// times the linkage may come to where it turns over, though it cannot be there at either.
TEST(PlayInLoops, EndsWhereALinkageMayTurnOverBetweenOutputTimes) {
  const double inLine = (std::numbers::pi - 1.8) / 3;
  for (const std::string varies : {"", "varies = \"freely\"\n"}) {
    SCOPED_TRACE(varies);
    std::string study = linkage("1.8 rad + 3 rad/s*t", {"100 mm", "350 mm", "250 mm", "499.9 mm"}, "-1.573 rad",
                                "2.389 rad", "0.2 mm", 1)
                            .with(varies, {"rocker.angle"});
    study.replace(study.find("0.125 s"), 7, "0.9 s");
    expectUndecidedBehind(enclosed(demanding(study, "rocker.angle < 2.9 rad", "from = \"0.9 s\"")), 0.9 * inLine,
                          inLine);
  }
}

/// A slider whose rod is hardly longer than the crank: with the crank across, it may go through to the other side.
TEST(PlayInLoops, EndsWhereASliderMayGoThrough) {
  const double across = (std::numbers::pi / 2 - 0.2) / 3;
  for (const std::string varies : {"", "varies = \"freely\"\n"}) {
    SCOPED_TRACE(varies);
    Sweep sweep("0.2 rad + 3 rad/s*t", "0.2 mm", 2);
    sweep.arm("crank_arm", "crank_frame", "100 mm");
    sweep.hinge("coupler", "crank_arm_end", "-0.3896 rad");
    sweep.arm("coupler_arm", "coupler_frame", "100.2 mm");
    sweep.text += element("prismatic", "slide",
                          between("inertial", "slider") + "axis = \"x\"\ninitial = { displacement = \"197 mm\" }");
    sweep.text += element("closure", "pin",
                          "as = \"pin\"\n" + between(sweep.behindPlay("slider"), "coupler_arm_end") +
                              "axis = \"z\"\ndependent = [\"coupler\", \"slide\"]");
    const std::string study = sweep.with(varies, {"slide.displacement"});
    expectUndecidedBehind(enclosed(demanding(study, "slide.displacement > -20 mm", "from = \"0.75 s\"")), 0.8 * across,
                          across);
  }
}

/// Where a study's loops are proved to be what they were at the start, and what may be behind.
std::pair<double, std::string> regularUntil(const std::string& study) {
  const Machine machine(readStudyText(study, "s"));
  const ZeroFree known = zeroFree(machine.regular.values, machine.box, machine.study.horizon);
  return {known.until, known.first < 0 ? "" : machine.regular.otherwise[static_cast<std::size_t>(known.first)]};
}

/// A side of no length has no direction: behind where the crank's end may meet the rocker's pivot, of a kite, the
/// linkage hangs on the other side, though it was nowhere stretched.
TEST(PlayInLoops, EndsWhereASideMayVanish) {
  const double met = (2 * std::numbers::pi - 1) / 7;
  const auto until = [](const std::string& least) {
    return regularUntil(
        linkage("1 rad + 7 rad/s*t", {"100 mm", "300 mm", "300 mm", "110 mm"}, "0.2 rad", "1.3 rad", "1 um", 1)
            .with("", {"rocker.angle"}) +
        "[[uncertain]]\nquantity = \"ground.length\"\ninterval = [\"" + least + " mm\", \"110 mm\"]\n");
  };
  EXPECT_GE(until("99").first, 0.9 * met);
  EXPECT_LE(until("99").first, met);
  EXPECT_THAT(until("99").second, ::testing::HasSubstr("the loop 'pin' comes to"));
  EXPECT_EQ(until("101"), (std::pair<double, std::string>(1, "")));
}

/// A crank that is driven on to where coupler and rocker stretch, of the nominal machine too: the run ends before it,
/// and says where that is and what it is, instead of refusing what varies.
TEST(PlayInLoops, EndsWhereTheNominalMachineComesToADeadPoint) {
  const double stretched = (std::acos((0.09 + 0.1225 - 0.25) / 0.21) - 80 * std::numbers::pi / 180) / 1.5;
  for (const std::string varies : {"", "varies = \"freely\"\n"}) {
    SCOPED_TRACE(varies);
    const Results results = enclosed(
        linkage("80 deg + 1.5 rad/s*t", {"300 mm", "400 mm", "100 mm", "350 mm"}, "-110 deg", "150 deg", "0.5 mm", 1)
            .with(varies, {"rocker.angle"}));
    expectEnd(results, 0.95 * stretched, stretched,
              "the loop 'pin' comes to a dead point of coupler.angle, rocker.angle for some values, at 0.2");
    EXPECT_THAT(results.interval.why, ::testing::HasSubstr("the nominal motion comes to a dead point of"));
    EXPECT_THAT(results.interval.advice, ::testing::HasSubstr("a drive of another joint"));
    EXPECT_LT(results.interval.at.upper(1, 0) - results.interval.at.lower(1, 0), 0.05);
  }
}

/// A drive that ends, as a root does, is no dead point of the loop.
TEST(PlayInLoops, NamesNoDeadPointWhereADriveHasNoPosition) {
  const Results results = enclosed(fourBar("0.75 rad + 0.3*sqrt(1 - 2*t/(1 s))", "1 mm", 1).with("", {"rocker.angle"}));
  expectEnd(results, 0.48, 0.52, "it could not be excluded that");
}

/// From where coupler and rocker are stretched it may go on in two ways.
TEST(PlayInLoops, SaysWhichLoopStartsAtADeadPoint) {
  const std::string study =
      linkage("100.2 deg - 0.5 rad/s*t", {"300 mm", "400 mm", "100 mm", "350 mm"}, "-136.4 deg", "140 deg", "1 mm", 1)
          .with("varies = \"freely\"\n", {"rocker.angle"});
  try {
    run(readStudyText(study, "s"));
    ADD_FAILURE() << "not refused";
  } catch (const StudyError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("the loop 'pin' comes to a dead point of coupler.angle"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("expected another start, or narrower intervals"));
  }
}

/// A drag link has no dead point, however far the crank may be from where it nominally is; no limit of time is one.
TEST(PlayInLoops, NamesNoDeadPointWhereThereIsNone) {
  const auto drag = [](const std::string& most) {
    return linkage("start + 6.5 rad/s*t", {"300 mm", "250 mm", "350 mm", "100 mm"}, "-0.3 rad", "1.5 rad", "1 mm", 1)
               .with("", {"rocker_arm_end.position.x"}) +
           "[mechanism.parameters]\nstart = \"0.5 rad\"\n[[uncertain]]\nquantity = \"start\"\ninterval = \"± " + most +
           " deg\"\n";
  };
  for (const char* most : {"5", "30", "60"})
    EXPECT_EQ(regularUntil(drag(most)), (std::pair<double, std::string>(1, "")));
  const std::atomic<bool> cancelled = true;
  const Machine machine(readStudyText(drag("60"), "s"));
  EXPECT_EQ(zeroFree(machine.regular.values, machine.box, 1, &cancelled).end, ZeroFree::End::cancelled);
}

/// Nothing is known of a motion that starts where it may go either way.
TEST(PlayInLoops, IsRefusedAtADeadPoint) {
  for (const std::string start : {"3.1415 rad", "3.14159265358979323846 rad"})
    EXPECT_THROW(run(readStudyText(parallelogram(start + " + 5 rad/s*t", "1 mm").with("", {"rocker.angle"}), "s")),
                 StudyError)
        << start;
}

/// How far the crank goes is uncertain: so is how far the coupler's angle, which changes little in the nominal machine,
/// comes from there, and half a turn away whole turns would be counted otherwise.
TEST(PlayInLoops, EndsWhereAnAngleMayBeHalfATurnFromItsCourse) {
  const auto until = [](const std::string& most) {
    return regularUntil(fourBar("0.75 rad + sweep*t", "1 mm", 1).with("", {"coupler.angle"}) +
                        "[mechanism.parameters]\nsweep = \"0.5 rad/s\"\n[[uncertain]]\nquantity = \"sweep\"\n" +
                        "interval = [\"0.5 rad/s\", \"" + most + " rad/s\"]\n");
  };
  EXPECT_THAT(until("6").second, ::testing::HasSubstr("coupler.angle of the loop 'pin' comes to half a turn"));
  EXPECT_GT(until("6").first, 0.3);
  EXPECT_LT(until("6").first, 0.9);
  EXPECT_EQ(until("2"), (std::pair<double, std::string>(1, "")));
}

/// Samples end where their own motion does, and are no other's behind.
TEST(PlayInLoops, EndsSamplesAtTheirOwnDeadPoints) {
  const Results results = run(readStudyText(
      linkage("0.3 rad + 5 rad/s*t", {"200 mm", "500 mm", "200.1 mm", "500 mm"}, "-0.29 rad", "0.31 rad", "1 mm", 1)
          .with("", {"rocker.angle"}),
      "s"));
  const double inLine = (std::numbers::pi - 0.3) / 5;
  const StochasticResult& samples = results.stochastic;
  EXPECT_GT(samples.failures, 0);
  EXPECT_LT(samples.failures, samples.integrated);
  for (const auto& failed : samples.failed) EXPECT_NEAR(failed.reached, inLine, 0.2 * inLine) << failed.why;
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
}

}  // namespace
}  // namespace whole_turns
}  // namespace gamut
