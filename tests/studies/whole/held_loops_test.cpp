// Loops that are held by multipliers, through dead points of the coordinates that follow at the start: against the same
// linkages by hand, in the crank's angle, which has none.
#include <gmock/gmock.h>

#include <array>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "studies/machine.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/analyses/reference.hpp"
#include "tests/studies/four_bar_text.hpp"

namespace gamut {
namespace held_loops {
namespace {

using testing::byHand, testing::fourBarText, testing::uncertain;
using ::testing::HasSubstr;
using testing::Vector;

Machine machineOf(const std::string& text) { return Machine(readStudyText(text, "s.toml")); }

std::string everywhere(std::string text, const std::string& old, const std::string& by) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
  return text;
}

std::string held(const std::string& text) {
  return everywhere(text, "[mechanism]\n", "[mechanism]\nloops = \"multipliers\"\n");
}

/// The rocker moves by itself, crank and coupler follow: twice a turn of the crank they lie in line, where they cannot.
std::string byRocker(const std::string& horizon, const std::string& uncertain, const std::string& rocker) {
  const std::string text =
      everywhere(fourBarText(horizon, uncertain, "dependent = [\"A\", \"B\"]"), "angle = 1, rate = 4", "angle = 1");
  return everywhere(text, "initial = { angle = 1.6 }", "initial = { " + rocker + " }");
}

Tube enclosed(const Machine& machine, const std::vector<double>& times) {
  FlowOptions options;
  options.remainders = machine.remainders;
  return Flow(machine.equations().f, machine.equations().g, options).enclose(machine.box, times.back(), times);
}

Precise exact(const char* number) { return Precise(number); }

using Lengths = std::array<Precise, 4>;

/// Angle and rate of the crank where the rocker has these: the crank's pin is to the left of the line from its pivot to
/// the closing point.
Vector crankOf(const Precise& rocker, const Precise& rate, const Lengths& lengths) {
  const auto& [a, b, c, d] = lengths;
  const Precise x = d + c * cos(rocker), y = c * sin(rocker), squared = x * x + y * y;
  const Precise t = (a * a - b * b + squared) / (2 * squared), h = sqrt(Precise(a * a / squared - t * t));
  const Precise angle = atan2(Precise(t * y + h * x), Precise(t * x - h * y));
  return {angle, rate / testing::fourBarByHand<Precise>(angle, Precise(1), lengths, exact).rocker};
}

/// The crank's angle and rate and where the closing point is, at the times of the tube; `first`: of four outputs.
void expectEnclosed(const Tube& tube, const Precise& rocker, const Precise& rate, const Lengths& lengths,
                    std::size_t first = 0) {
  testing::Reference reference(byHand());
  Vector start = crankOf(rocker, rate, lengths);
  start.insert(start.end(), lengths.begin(), lengths.end());
  const std::vector<Vector> truth = reference(start, tube.times());
  for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
    const auto motion = testing::fourBarByHand<Precise>(truth[i][0], truth[i][1], lengths, exact);
    const std::array<Precise, 4> values{truth[i][0], truth[i][1], motion.closing[0], motion.closing[1]};
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_THAT(tube.outputs(i)[first + j], testing::Encloses(values[j])) << tube.times()[i] << " " << j;
  }
}

double widest(const Tube& tube) {
  double widest = 0;
  for (const Interval& output : tube.outputs(tube.reachedTimes() - 1)) widest = std::max(widest, width(output));
  return widest;
}

const Lengths nominal{Precise("0.3"), Precise("0.8"), Precise("0.6"), Precise("0.9")};

TEST(HeldLoop, PassesDeadPointsOfWhatFollowedAtTheStart) {
  const Machine machine = machineOf(held(byRocker("2", "", "angle = 2.06, rate = 1")));
  EXPECT_EQ(machine.study.mechanism.stateNames(),
            (std::vector<std::string>{"A.angle", "B.angle", "D.angle", "D.rate", "A.rate", "B.rate"}));
  const Tube tube = enclosed(machine, {0.25, 0.5, 1, 1.5, 2});
  ASSERT_EQ(tube.reached(), 2) << tube.why();
  EXPECT_LE(widest(tube), 1e-8);
  expectEnclosed(tube, Precise("2.06"), 1, nominal);
}

/// By coordinates that follow it ends there.
TEST(HeldLoop, EndsAtADeadPointOtherwise) {
  const Tube tube = enclosed(machineOf(byRocker("2", "", "angle = 2.06, rate = 1")), {2});
  EXPECT_LT(tube.reached(), 0.5);
}

TEST(HeldLoop, IsOneOfTwo) {
  const std::string one = held(byRocker("2", "", "angle = 2.06, rate = 1"));
  const std::size_t begin = one.find("[[mechanism.element]]"), end = one.find("[[output]]");
  std::string other = one.substr(begin, end - begin), outputs = one.substr(end);
  for (const char* name : {"A", "B", "D", "K1", "K2", "K3", "PB", "PD", "C1", "C2", "C", "ab", "bc", "dc", "ground",
                           "crank", "coupler", "rocker"})
    other = everywhere(other, std::string("\"") + name + "\"", std::string("\"other_") + name + "\"");
  other = everywhere(other, "angle = 2.06, rate = 1", "angle = 1.8, rate = -0.5");
  outputs = everywhere(outputs, "quantity = \"", "quantity = \"other_");
  const Machine machine = machineOf(one.substr(0, end) + other + one.substr(end) + outputs);
  const Tube tube = enclosed(machine, {0.5, 1, 2});
  ASSERT_EQ(tube.reached(), 2) << tube.why();
  EXPECT_LE(widest(tube), 1e-7);
  expectEnclosed(tube, Precise("2.06"), 1, nominal);
  expectEnclosed(tube, Precise("1.8"), Precise("-0.5"), nominal, 4);
}

/// Lengths, and how the rocker starts: rates that follow from it start as those that it has.
TEST(HeldLoop, HoldsAllMotionsOfItsTolerances) {
  const std::string tolerances =
      uncertain({"a", "c"}, "± 0.1 %") + uncertain({"D.angle"}, "± 0.05 %") + uncertain({"D.rate"}, "± 1 %");
  const Machine machine = machineOf(held(byRocker("0.5", tolerances, "angle = 2.06, rate = 1")));
  ASSERT_EQ(machine.states, 6U);
  ASSERT_EQ(machine.freeParameters, (std::vector<std::string>{"a", "c", "D.angle", "D.rate"}));
  const Tube tube = enclosed(machine, {0.125, 0.25, 0.5});
  ASSERT_EQ(tube.reached(), 0.5) << tube.why();
  EXPECT_LE(tube.tightness(), 1.02);
  testing::Points points;
  const Box box(machine.box.begin() + 6, machine.box.end());
  for (int k = 0; k < 8; ++k) {
    const Vector p = k % 2 == 0 ? points.corner(box) : points.inside(box);
    expectEnclosed(tube, p[2], p[3], {p[0], Precise("0.8"), p[1], Precise("0.9")});
  }
}

TEST(HeldLoop, HasAllSamplesInItsEnclosure) {
  const Study study =
      readStudyText(held(byRocker("1", uncertain({"a", "c"}, "± 0.5 %"), "angle = 2.06, rate = 1")), "s.toml");
  const Results results = run(study, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.interval.reached, 1);
}

/// Forces in the joints are those of the same linkage whose coordinates follow, by other equations.
TEST(HeldLoop, BearsTheSameForces) {
  const std::string asked =
      "[[output]]\nquantity = \"C.force.x\"\n[[output]]\nquantity = \"B.reaction.force.y\"\n"
      "[[output]]\nquantity = \"D.acceleration\"\n[[output]]\nquantity = \"B.rate\"\n";
  const Tube one = enclosed(machineOf(fourBarText("1", "") + asked), {0.25, 1});
  const Tube other = enclosed(machineOf(held(fourBarText("1", "") + asked)), {0.25, 1});
  ASSERT_EQ(one.reached(), 1);
  ASSERT_EQ(other.reached(), 1);
  EXPECT_LE(widest(one), 1e-7);
  EXPECT_LE(widest(other), 1e-7);
  for (std::size_t i = 0; i < one.reachedTimes(); ++i)
    for (std::size_t j = 0; j < one.outputs(i).size(); ++j)
      EXPECT_FALSE(isEmpty(intersection(one.outputs(i)[j], other.outputs(i)[j]))) << i << " " << j;
}

/// A slide that moves by itself pushes a crank by a rod without mass through both dead centres: (J + m x′²) θ̈ = − m x′
/// x″ θ̇² with the slide's place x(θ).
TEST(HeldLoop, TurnsACrankThroughItsDeadCentres) {
  const std::string text =
      "[study]\nanalysis = \"dynamics\"\nhorizon = 4\noutput_step = 4\ncompare = [\"interval\"]\n"
      "[mechanism]\nloops = \"multipliers\"\nparameters = { r = \"0.2 m\", l = \"0.5 m\" }\n"
      "[[mechanism.element]]\ntype = \"revolute\"\nname = \"crank\"\nfrom = \"inertial\"\nto = \"K\"\naxis = \"z\"\n"
      "initial = { angle = 0.6 }\n"
      "[[mechanism.element]]\ntype = \"mass\"\nname = \"disc\"\nat = \"K\"\nmass = 1\n"
      "inertia = [\"0.03\", \"0.03\", \"0.06\"]\n"
      "[[mechanism.element]]\ntype = \"prismatic\"\nname = \"slide\"\nfrom = \"inertial\"\nto = \"S\"\naxis = \"x\"\n"
      "initial = { displacement = \"r*cos(0.7) + sqrt(l^2 - (r*sin(0.7))^2)\", rate = \"-0.8 m/s\" }\n"
      "[[mechanism.element]]\ntype = \"mass\"\nname = \"piston\"\nat = \"S\"\nmass = 2\n"
      "[[mechanism.element]]\ntype = \"rod\"\nname = \"rod\"\nfrom = \"K\"\nfrom_point = [\"r\", 0, 0]\nto = \"S\"\n"
      "length = \"l\"\ndependent = [\"crank\"]\n" +
      uncertain({"r"}, "± 0.1 %") +
      "[[output]]\nquantity = \"crank.angle\"\n[[output]]\nquantity = \"slide.displacement\"\n";
  const Machine machine = machineOf(text);
  const Tube tube = enclosed(machine, {0.5, 1, 2, 4});
  ASSERT_EQ(tube.reached(), 4) << tube.why();
  EXPECT_LE(tube.tightness(), 1.02);
  const auto place = [](const auto& angle, const auto& r, const auto& l) {
    const auto s = sin(angle), c = cos(angle);
    using T = std::decay_t<decltype(r)>;
    const T root = sqrt(T(l * l - r * r * s * s));
    return std::array<T, 3>{
        T(r * c + root), T(-r * s - r * r * s * c / root),
        T(-r * c - r * r * (c * c - s * s) / root - r * r * r * r * s * s * c * c / (root * root * root))};
  };
  testing::Reference reference(record(2, 1, [&](auto, const auto& x, const auto& p, auto& dx) {
    const std::array<Recorded, 3> at = place(x[0], p[0], testing::decimal("0.5"));
    dx[0] = x[1];
    dx[1] = -2.0 * at[1] * at[2] * sqr(x[1]) / (testing::decimal("0.06") + 2.0 * sqr(at[1]));
  }));
  testing::Points points;
  const Box box(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end());
  double turns = 0;
  for (int k = 0; k < 4; ++k) {
    const Vector p = k % 2 == 0 ? points.corner(box) : points.inside(box);
    const Precise angle("0.7"), rate = Precise("-0.8") / place(angle, p[0], Precise("0.5"))[1];
    const std::vector<Vector> truth = reference({angle, rate, p[0]}, tube.times());
    for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
      EXPECT_THAT(tube.outputs(i)[0], testing::Encloses(truth[i][0])) << tube.times()[i];
      EXPECT_THAT(tube.outputs(i)[1], testing::Encloses(place(truth[i][0], p[0], Precise("0.5"))[0]))
          << tube.times()[i];
    }
    turns = std::max(turns, static_cast<double>(truth.back()[0]) / 6.3);
  }
  EXPECT_GT(turns, 2);
}

/// What loads the loop may vary in time, as it closes whatever that is.
TEST(HeldLoop, BearsAForceThatVaries) {
  const std::string force =
      "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"load\"\njoint = \"A\"\n"
      "parameters = { moment = \"0.5 N m\" }\nforce = \"load.moment\"\n[[mechanism.element]]\ntype = \"closure\"";
  const std::string varying = uncertain({"load.moment"}, "± 5 %") + "varies = \"freely\"\n";
  for (const std::string& text :
       {fourBarText("0.2", varying), held(byRocker("0.1", varying, "angle = 2.06, rate = 1"))}) {
    const Study study = readStudyText(everywhere(text, "[[mechanism.element]]\ntype = \"closure\"", force), "s.toml");
    const Results results = run(study, {});
    EXPECT_EQ(results.comparison.verdict, Agreement::inside);
    EXPECT_EQ(results.interval.reached, study.horizon);
    EXPECT_GT(results.interval.at.upper(1, 1) - results.interval.at.lower(1, 1), 1e-3);
  }
}

TEST(HeldLoop, IsRefusedWhereNothingMovesOrCloses) {
  const auto refusalOf = [](const std::string& text) {
    try {
      machineOf(text);
    } catch (const StudyError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string text = held(fourBarText("1", ""));
  EXPECT_THAT(refusalOf(everywhere(text, "\"dynamics\"\nhorizon = 1\noutput_step = 1", "\"kinematics\"")),
              HasSubstr("mechanism.loops has no meaning in kinematics"));
  EXPECT_THAT(refusalOf(everywhere(text, "\"multipliers\"", "\"springs\"")), HasSubstr("mechanism.loops"));
  const std::size_t closure = text.find("[[mechanism.element]]\ntype = \"closure\"");
  EXPECT_THAT(refusalOf(text.substr(0, closure) + "[[output]]\nquantity = \"A.angle\"\n"),
              HasSubstr("mechanism.loops is given, but nothing closes a loop"));
}

}  // namespace
}  // namespace held_loops
}  // namespace gamut
