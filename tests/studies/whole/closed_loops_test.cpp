// Studies of machines that close on themselves: enclosures against trajectories of the same machine by hand in 128
// bits, and what is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "studies/machine.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/analyses/reference.hpp"
#include "tests/mechanics/four_bar.hpp"
#include "tests/studies/four_bar_text.hpp"
#include "tests/studies/replaced.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;

using testing::byHand, testing::fourBarText, testing::uncertain;

Machine machineOf(const std::string& text) { return Machine(readStudyText(text, "s.toml")); }

/// The crank and the closing point, at the times of the tube, of every trajectory that starts from `angles` with
/// lengths of the box.
void expectEnclosed(const Tube& tube, const Box& lengths, const Interval& angles, int trajectories) {
  testing::Points points;
  testing::Reference reference(byHand());
  for (int k = 0; k < trajectories; ++k) {
    const testing::Vector p = k % 2 == 0 ? points.corner(lengths) : points.inside(lengths);
    testing::Vector start{points.inside({angles})[0], Precise(4)};
    start.insert(start.end(), p.begin(), p.end());
    const std::vector<testing::Vector> truth = reference(start, tube.times());
    for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
      const Precise angle = truth[i][0];
      const auto motion = testing::fourBarByHand<Precise>(angle, truth[i][1], {p[0], p[1], p[2], p[3]},
                                                          [](const char* number) { return Precise(number); });
      EXPECT_THAT(tube.outputs(i)[0], testing::Encloses(angle)) << tube.times()[i];
      EXPECT_THAT(tube.outputs(i)[1], testing::Encloses(truth[i][1])) << tube.times()[i];
      EXPECT_THAT(tube.outputs(i)[2], testing::Encloses(motion.closing[0])) << tube.times()[i];
      EXPECT_THAT(tube.outputs(i)[3], testing::Encloses(motion.closing[1])) << tube.times()[i];
    }
  }
}

Tube enclosed(const Machine& machine, double tightness = 1.02) {
  FlowOptions options;
  options.tightness = tightness;
  options.remainders = machine.remainders;
  const Study& study = machine.study;
  return Flow(machine.equations().f, machine.equations().g, options)
      .enclose(machine.box, study.horizon, {study.horizon / 4, study.horizon});
}

Box lengthsWithin(double share) {
  Box lengths;
  for (const char* length : {"0.3", "0.8", "0.6", "0.9"}) {
    const Interval whole = Interval(length) * Interval(1 - share, 1 + share);
    lengths.push_back(whole);
  }
  return lengths;
}

TEST(ClosedLoopStudy, EnclosesAFourBarOfOneSetOfLengths) {
  const Machine machine = machineOf(fourBarText("2", ""));
  const Tube tube = enclosed(machine);
  ASSERT_EQ(tube.reached(), 2);
  EXPECT_LE(width(tube.outputs(tube.reachedTimes() - 1)[0]), 1e-10);
  // A double of 0.3 is not 0.3, but near enough for what rounding leaves open.
  Box lengths;
  for (const Interval& length : lengthsWithin(0)) lengths.emplace_back(midpoint(length));
  testing::Reference reference(byHand());
  const testing::Vector truth =
      reference({1, 4, Precise("0.3"), Precise("0.8"), Precise("0.6"), Precise("0.9")}, {2})[0];
  EXPECT_THAT(tube.outputs(tube.reachedTimes() - 1)[0], testing::Encloses(truth[0]));
  EXPECT_THAT(tube.outputs(tube.reachedTimes() - 1)[1], testing::Encloses(truth[1]));
}

/// The four-bar at the end of an arm of so many links, which turn about these axes in turn.
std::string onAnArm(int links, const std::vector<std::string>& axes) {
  std::string text = fourBarText("1", ""), arm, before = "inertial";
  for (int i = 0; i < links; ++i) {
    const std::string number = std::to_string(i);
    arm += fmt::format(
        "[[mechanism.element]]\ntype = \"revolute\"\nname = \"J{0}\"\nfrom = \"{1}\"\nto = \"F{0}\"\naxis = \"{2}\"\n"
        "initial = {{ angle = \"{3} deg\" }}\n[[mechanism.element]]\ntype = \"mass\"\nname = \"M{0}\"\nat = \"F{0}\"\n"
        "mass = 1\ncentre = [0, \"-0.15\", \"0.02\"]\ninertia = [\"0.01\", \"0.01\", \"0.01\"]\n"
        "[[mechanism.element]]\ntype = \"link\"\nname = \"L{0}\"\nfrom = \"F{0}\"\nto = \"E{0}\"\nvector = [0, "
        "\"-0.3\", "
        "0]\n",
        number, before, axes[i % axes.size()], i == 0 ? 30 : 5);
    before = "E" + number;
  }
  for (auto at = text.find("\"inertial\""); at != std::string::npos; at = text.find("\"inertial\"", at))
    text.replace(at, 10, "\"" + before + "\"");
  return text.insert(text.find("[[mechanism.element]]"), arm);
}

/// With multipliers beside the inertia matrix enclosures of five and of six links ended before half a second.
TEST(ClosedLoopStudy, IsThinAtTheEndOfAnArm) {
  for (const auto& [links, axes] : {std::pair<int, std::vector<std::string>>{3, {"z"}}, {10, {"z"}}, {6, {"z", "x"}}}) {
    const Results results = run(machineOf(onAnArm(links, axes)), {});
    EXPECT_EQ(results.interval.reached, 1) << links << " " << results.interval.why;
    EXPECT_LE(results.interval.at.upper(1, 0) - results.interval.at.lower(1, 0), links < 10 ? 1e-8 : 1e-6) << links;
    EXPECT_EQ(results.comparison.verdict, Agreement::inside) << links;
  }
}

TEST(ClosedLoopStudy, EnclosesAFourBarOfAnyLengthsWithinTheirTolerances) {
  const Machine machine = machineOf(fourBarText("1", uncertain({"a", "b", "c", "d"}, "± 0.1 %")));
  const Tube tube = enclosed(machine);
  ASSERT_EQ(tube.reached(), 1) << tube.why();
  EXPECT_LE(tube.tightness(), 1.02);
  Box lengths(machine.box.begin() + 4, machine.box.end());
  expectEnclosed(tube, lengths, Interval(1.0), 8);
}

/// Coordinates that nothing asks for rest, but for one by which a frame stands that is drawn: a mark on a wheel that a
/// gear turns.
TEST(ClosedLoopStudy, FollowsOnlyTheCoordinatesThatSomethingStandsBy) {
  const auto isFollowed = [](const std::string& text) {
    const Machine machine = machineOf(text);
    std::vector<bool> followed;
    for (const int rate : machine.equations().f.outputNodes())
      followed.push_back(machine.equations().f.nodes()[rate].op != Op::constant);
    return followed;
  };
  EXPECT_EQ(isFollowed(fourBarText("1", "")), (std::vector<bool>{true, false, false, true}));
  const std::string marked =
      "[[mechanism.element]]\ntype = \"revolute\"\nname = \"W\"\nfrom = \"PD\"\nto = \"KW\"\naxis = \"z\"\n"
      "[[mechanism.element]]\ntype = \"mass\"\nname = \"wheel\"\nat = \"KW\"\nmass = 1\n"
      "inertia = [0.01, 0.01, 0.02]\n"
      "[[mechanism.element]]\ntype = \"link\"\nname = \"mark\"\nfrom = \"KW\"\nto = \"KM\"\nvector = [0.2, 0, 0]\n"
      "[[mechanism.element]]\ntype = \"coupling\"\nname = \"gear\"\nto = \"D\"\njoint = \"W\"\nratio = 2\n";
  EXPECT_EQ(isFollowed(fourBarText("1", "", marked)), (std::vector<bool>{true, false, true, true}));
}

/// As practice has them: the start alone is the point.
TEST(ClosedLoopStudy, StartsFromEveryClosedPositionOfWideTolerances) {
  for (const char* tolerance : {"± 1 %", "± 5 %"}) {
    const Machine machine =
        machineOf(fourBarText("0.05", uncertain({"a", "b", "c", "d"}, tolerance) + uncertain({"A.angle"}, "± 5 %")));
    ASSERT_EQ(machine.freeParameters, (std::vector<std::string>{"a", "b", "c", "d", "A.angle"}));
    const Tube tube = enclosed(machine, 3);
    ASSERT_EQ(tube.reached(), 0.05) << tolerance << tube.why();
    expectEnclosed(tube, Box(machine.box.begin() + 4, machine.box.begin() + 8), machine.box[8], 12);
  }
}

TEST(ClosedLoopStudy, HasAllSamplesInItsEnclosure) {
  const Study study = readStudyText(fourBarText("0.5", uncertain({"a", "c"}, "± 1 %")), "s.toml");
  const Results results = run(study, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
}

/// All at one position: by the assembly itself and by programs.
TEST(ClosedLoopStudy, PlacesALinkageInKinematics) {
  std::string text = fourBarText("1", uncertain({"a", "d"}, "± 2 %") + uncertain({"A.angle"}, "± 3 %"));
  text.replace(text.find("\"dynamics\"\nhorizon = 1\noutput_step = 1"), 38, "\"kinematics\"");
  const Machine machine = machineOf(text);
  const Results results = run(machine, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LE(results.comparison.maximum, 1.02);
  testing::Points points;
  for (int k = 0; k < 40; ++k) {
    const Box& box = machine.box;
    const std::size_t first = machine.states;
    const testing::Vector p = k % 2 == 0 ? points.corner({box[first], box[first + 1], box[first + 2]})
                                         : points.inside({box[first], box[first + 1], box[first + 2]});
    const auto motion = testing::fourBarByHand<Precise>(p[2], Precise(4), {p[0], Precise("0.8"), Precise("0.6"), p[1]},
                                                        [](const char* number) { return Precise(number); });
    const std::array<Precise, 4> truth{p[2], Precise(4), motion.closing[0], motion.closing[1]};
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_THAT(Interval(results.interval.at.lower(0, j), results.interval.at.upper(0, j)),
                  testing::Encloses(truth[j]));
  }
}

std::string refusalOf(const std::string& text) {
  try {
    machineOf(text);
  } catch (const StudyError& error) {
    return error.what();
  }
  return "";
}

TEST(ClosedLoopStudy, SaysWhatCannotClose) {
  EXPECT_THAT(refusalOf(fourBarText("1", uncertain({"d"}, "± 70 %"))), HasSubstr("is not proved to close for 'd' in"));
  EXPECT_THAT(refusalOf(fourBarText("1", "", "dependent = [\"B\"]")),
              HasSubstr("the loop 'C' is closed by 2 coordinates, but 1 is named; expected 2 coordinates"));
  EXPECT_THAT(refusalOf(fourBarText("1", "", "dependent = [\"B\", \"X\"]")), HasSubstr("unknown joint 'X'"));
  EXPECT_THAT(refusalOf(fourBarText("1", "", "dependent = [\"B\", \"B\"]")),
              HasSubstr("closes another loop, or is named twice"));
  EXPECT_THAT(refusalOf(fourBarText("1", "", "dependent = []")), HasSubstr("is empty"));
  EXPECT_THAT(refusalOf(fourBarText("1", "", "dependent = \"B\"")), HasSubstr("is no list"));
  EXPECT_THAT(refusalOf(fourBarText("1", "", "", "angle = -0.5, rate = 1")),
              HasSubstr("has an initial rate, but closes 'C'"));
  EXPECT_THAT(refusalOf(fourBarText("1", uncertain({"B.angle"}, "± 1 %"))),
              HasSubstr("the joint 'B' closes a loop, so that 'B.angle' follows from the other joints"));
  EXPECT_THAT(refusalOf(fourBarText("1", uncertain({"a"}, "± 1 %") + "varies = \"freely\"\n")),
              HasSubstr("'a' varies in time, but where a loop is closed follows from it"));
  // One that no row follows from at the start, where its lever is exactly 0.
  std::string lever = fourBarText("1", uncertain({"arm"}, "± 1 %") + "varies = \"freely\"\n");
  lever.replace(lever.find("d = \"0.9 m\""), 11, "d = \"0.9 m\", arm = \"0.1 m\"");
  lever.replace(lever.find("angle = 1, rate = 4"), 19, "angle = 0, rate = 4");
  lever.replace(lever.find("[[mechanism.element]]\ntype = \"closure\""), 22,
                "[[mechanism.element]]\ntype = \"revolute\"\nname = \"E\"\nfrom = \"inertial\"\nto = \"K4\"\n"
                "axis = \"z\"\n[[mechanism.element]]\ntype = \"mass\"\nname = \"e\"\nat = \"K4\"\nmass = 1\n"
                "inertia = [1, 1, 1]\n[[mechanism.element]]\ntype = \"closure\"\nname = \"P\"\nas = \"plane\"\n"
                "axis = \"y\"\nfrom = \"inertial\"\nto = \"K4\"\nto_point = [\"arm\", 0, 0]\ndependent = [\"E\"]\n"
                "[[mechanism.element]]\n");
  EXPECT_THAT(refusalOf(lever), HasSubstr("'arm' varies in time, but where a loop is closed follows from it"));
  std::string inverse = fourBarText("1", "");
  inverse.replace(inverse.find("\"dynamics\""), 10, "\"inverse-dynamics\"");
  EXPECT_THAT(refusalOf(inverse), HasSubstr("nothing drives 'A.angle'"));
  std::string far = fourBarText("1", "");
  far.replace(far.find("d = \"0.9 m\""), 11, "d = \"3.9 m\"");
  EXPECT_THAT(refusalOf(far), HasSubstr("the loop 'C' cannot be closed by B.angle, D.angle near their initial values"));
}

/// What turns the crank as it is said to, through more than a turn: θ = 1 + 4 t − t², within 1 % of all lengths.
TEST(ClosedLoopStudy, TellsWhatADrivenFourBarNeeds) {
  std::string text = fourBarText("2", uncertain({"a", "b", "c", "d"}, "± 1 %"));
  text.replace(text.find("\"dynamics\""), 10, "\"inverse-dynamics\"");
  text.replace(text.find("initial = { angle = 1, rate = 4 }\n"), 34, "");
  text.insert(text.find("[[mechanism.element]]\ntype = \"closure\""),
              "[[mechanism.element]]\ntype = \"drive\"\nname = \"motor\"\njoint = \"A\"\n"
              "position = \"1 rad + 4 rad/s*t - 1 rad/s^2*t^2\"\n");
  const Tube tube = enclosed(machineOf(text + "[[output]]\nquantity = \"motor.force\"\n"));
  ASSERT_EQ(tube.reached(), 2) << tube.why();
  testing::Points points;
  for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
    const Precise t = tube.times()[i];
    Precise least = 1e9, greatest = -1e9;
    for (int k = 0; k < 400; ++k) {
      const Box lengths = lengthsWithin(0.01);
      const testing::Vector p = k % 2 == 0 ? points.corner(lengths) : points.inside(lengths);
      const auto motion = testing::fourBarByHand<Precise>(1 + 4 * t - t * t, 4 - 2 * t, {p[0], p[1], p[2], p[3]},
                                                          [](const char* number) { return Precise(number); });
      const Precise moment = motion.inertia * (-2 - motion.acceleration);
      EXPECT_THAT(tube.outputs(i)[4], testing::Encloses(moment)) << t;
      least = std::min(least, moment);
      greatest = std::max(greatest, moment);
    }
    EXPECT_LE(width(tube.outputs(i)[4]), 1.02 * static_cast<double>(greatest - least)) << t;
  }
}

/// Cranks of the same length on pivots as far apart as the coupler is long: where all lie in one line, the loop may
/// open either way, and no motion is the only one from there.
std::string parallelCranks(const std::string& outputs) {
  return "[study]\nanalysis = \"dynamics\"\nhorizon = 1\noutput_step = 0.04\n"
         "compare = [\"interval\", \"stochastic\"]\n[stochastic]\nsamples = 32\n[distribution]\ntimes = "
         "0\n[mechanism]\n"
         "parameters = { arm = \"350 mm\", post = \"200 mm\", w = \"1 rad/s\" }\nelement = [\n"
         "{ type = \"revolute\", name = \"lower\", from = \"inertial\", to = \"A\", axis = \"z\" },\n"
         "{ type = \"drive\", name = \"motor\", joint = \"lower\", position = \"20 deg + 6.5*w*t\" },\n"
         "{ type = \"link\", name = \"la\", from = \"A\", to = \"Ae\", vector = [\"arm\", 0, 0] },\n"
         "{ type = \"revolute\", name = \"knee\", from = \"Ae\", to = \"H\", axis = \"z\", "
         "initial = { angle = \"-20 deg\" } },\n"
         "{ type = \"mass\", name = \"mh\", at = \"H\", mass = \"600 g\", centre = [0, \"20 mm\", 0] },\n"
         "{ type = \"link\", name = \"hp\", from = \"H\", to = \"He\", vector = [\"post\", 0, 0] },\n"
         "{ type = \"link\", name = \"pp\", from = \"inertial\", to = \"U\", vector = [\"post\", 0, 0] },\n"
         "{ type = \"revolute\", name = \"upper\", from = \"U\", to = \"B\", axis = \"z\", "
         "initial = { angle = \"20 deg\" } },\n"
         "{ type = \"mass\", name = \"mb\", at = \"B\", mass = \"600 g\", centre = [\"100 mm\", \"20 mm\", 0] },\n"
         "{ type = \"link\", name = \"lb\", from = \"B\", to = \"Be\", vector = [\"arm\", 0, 0] },\n"
         "{ type = \"closure\", name = \"pin\", as = \"pin\", from = \"Be\", to = \"He\" },\n]\n" +
         uncertain({"w"}, "± 5 %") + outputs;
}

/// Nothing is proved of the times behind: neither by what is integrated nor by a closed form, nor by requirements
/// alone.
TEST(ClosedLoopStudy, EndsWhereItMayGoOnInMoreWaysThanOne) {
  const std::string moment = "[[output]]\nquantity = \"motor.force\"\n",
                    angle = "[[output]]\nquantity = \"upper.angle\"\n",
                    limit = "[[requirement]]\nname = \"weak\"\nalways = \"motor.force < 1 N m\"\n";
  constexpr double line = 0.45;  // s, at the latest
  for (const std::string& outputs : {moment, angle + moment, moment + limit, angle + limit}) {
    const Results results = run(machineOf(parallelCranks(outputs)), {});
    EXPECT_LT(results.interval.reached, line) << outputs;
    EXPECT_LT(results.stochastic.reached, line) << outputs;
    EXPECT_GT(2 * results.stochastic.failures, results.stochastic.integrated) << outputs;  // some cross their links
    for (const RequirementResult& requirement : results.requirements) EXPECT_EQ(requirement.word, Decision::open);
  }
}

/// A drive that a rod holds from 0.2145 s on: what the driven joint alone tells has no values behind either.
TEST(ClosedLoopStudy, EndsWhereADriveCannotGoOn) {
  const Results results = run(
      machineOf("[study]\nanalysis = \"inverse-dynamics\"\nhorizon = 1\noutput_step = 0.05\ncompare = [\"interval\"]\n"
                "[mechanism]\nelement = [\n"
                "{ type = \"revolute\", name = \"crank\", from = \"inertial\", to = \"K\", axis = \"z\" },\n"
                "{ type = \"drive\", name = \"motor\", joint = \"crank\", position = \"3*t/(1 s)\" },\n"
                "{ type = \"link\", name = \"arm\", from = \"K\", to = \"tip\", vector = [\"0.5 m\", 0, 0] },\n"
                "{ type = \"prismatic\", name = \"slide\", from = \"inertial\", to = \"S\", axis = \"x\", "
                "initial = { displacement = \"0.8 m\" } },\n"
                "{ type = \"mass\", name = \"m\", at = \"S\", mass = 1 },\n"
                "{ type = \"rod\", name = \"rod\", from = \"tip\", to = \"S\", length = \"0.3 m\" },\n]\n"
                "[[output]]\nquantity = \"tip.position.y\"\n"
                "[[requirement]]\nname = \"up\"\neventually = \"tip.position.y > 0.49 m\"\n"));
  EXPECT_NEAR(results.interval.reached, 0.2145, 1e-3);  // asin(0.3/0.5)/3
  ASSERT_EQ(results.requirements.size(), 1U);
  EXPECT_EQ(results.requirements[0].word, Decision::open);
}

/// `text` with another element ahead of the closure.
std::string withElement(std::string text, const std::string& element) {
  return text.insert(text.find("[[mechanism.element]]\ntype = \"closure\""), "[[mechanism.element]]\n" + element);
}

TEST(ClosedLoopStudy, SaysWhatDoesNotFitALoop) {
  EXPECT_THAT(refusalOf(fourBarText("1", "", "to_axis = \"x\"")),
              HasSubstr("'C' is a pin, which holds no axis of `to`"));
  EXPECT_THAT(refusalOf(withElement(fourBarText("1", "", "dependent = [\"D\", \"S\"]"),
                                    "type = \"spherical\"\nname = \"S\"\nfrom = \"inertial\"\nto = \"K4\"\n")),
              HasSubstr("the joint 'S' has no coordinates for 'C', as the turns of a ball are none"));
  EXPECT_THAT(
      refusalOf(withElement(fourBarText("1", ""),
                            "type = \"revolute\"\nname = \"E\"\nfrom = \"inertial\"\nto = \"K4\"\naxis = \"z\"\n")),
      HasSubstr("'E.rate' moves no mass, nor does what closes loops with it"));
}

/// Coupler and rocker lie in line, 0.3 m and 0.2 m over the long side of a triangle of 3, 4 and 5.
TEST(ClosedLoopStudy, SaysThatItStartsAtADeadPoint) {
  std::string dead = replaced(fourBarText("1", "", "", "angle = -2.2"), "b = \"0.8 m\", c = \"0.6 m\", d = \"0.9 m\"",
                              "b = \"0.3 m\", c = \"0.2 m\", d = \"0.4 m\"");
  dead = replaced(replaced(dead, "angle = 1, rate = 4", "angle = \"90 deg\", rate = 4"), "angle = 1.6", "angle = 2.5");
  EXPECT_THAT(refusalOf(dead), HasSubstr("the loop 'C' starts at a dead point of B.angle, D.angle"));
  EXPECT_THAT(refusalOf(dead), HasSubstr("\"A.angle\""));
}

/// The same at rest: others than those that stand last follow, unless they are uncertain.
TEST(ClosedLoopStudy, ChoosesCoordinatesThatHoldFirmlyWhereItStarts) {
  std::string dead = replaced(fourBarText("1", "", "", "angle = -2.2"), "b = \"0.8 m\", c = \"0.6 m\", d = \"0.9 m\"",
                              "b = \"0.3 m\", c = \"0.2 m\", d = \"0.4 m\"");
  dead = replaced(replaced(dead, "angle = 1, rate = 4", "angle = \"90 deg\""), "angle = 1.6", "angle = 2.5");
  const Study study = readStudyText(dead, "s.toml");
  EXPECT_EQ(study.mechanism.dependents(), (std::vector<std::string>{"A.angle", "D.angle"}));
  ASSERT_EQ(study.notes.size(), 1U);
  EXPECT_THAT(study.notes[0],
              HasSubstr("note: the loop 'C' is closed by A.angle, D.angle, as B.angle, D.angle, which"));
  EXPECT_EQ(readStudyText(fourBarText("1", ""), "s.toml").mechanism.dependents(),
            (std::vector<std::string>{"B.angle", "D.angle"}));
  const std::string moving = replaced(replaced(fourBarText("1", ""), "angle = 1, rate = 4", "angle = 1"), "angle = 1.6",
                                      "angle = 1.6, rate = 0.5");
  EXPECT_EQ(readStudyText(moving, "s.toml").mechanism.dependents(), (std::vector<std::string>{"A.angle", "B.angle"}));
  EXPECT_THAT(refusalOf(replaced(dead, "[[output]]", uncertain({"A.angle"}, "± 1 %") + "[[output]]")),
              HasSubstr("the loop 'C' starts at a dead point of B.angle, D.angle"));
}

/// What a ball or a hinge holds beyond a pin follows from how the loop is built: it is left out, told, and enclosures
/// are those of the pin.
TEST(ClosedLoopStudy, LeavesOutWhatHoldsAnyway) {
  const std::string pinned = fourBarText("1", uncertain({"a", "c"}, "± 0.1 %"));
  EXPECT_THAT(readStudyText(pinned, "s.toml").notes, ::testing::IsEmpty());
  const Tube byPin = enclosed(machineOf(pinned));
  for (const char* as : {"ball", "hinge", "cylinder"}) {
    const std::string text = replaced(pinned, "as = \"pin\"", std::string("as = \"") + as + "\"");
    const Machine machine = machineOf(text);
    ASSERT_EQ(machine.study.notes.size(), 1U);
    EXPECT_THAT(machine.study.notes[0], HasSubstr("note: 'C' holds 2 of its "));
    const Tube tube = enclosed(machine);
    ASSERT_EQ(tube.reached(), 1) << tube.why();
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_TRUE(isEqual(tube.outputs(tube.reachedTimes() - 1)[j], byPin.outputs(byPin.reachedTimes() - 1)[j]));
    Box lengths = lengthsWithin(0);
    lengths[0] = machine.box[4];
    lengths[2] = machine.box[5];
    for (const std::size_t i : {1U, 3U}) lengths[i] = Interval(midpoint(lengths[i]));
    expectEnclosed(tube, lengths, Interval(1.0), 4);
    // A cylinder holds nothing along its axis.
    const std::string besides =
        refusalOf(replaced(text, "[[output]]", uncertain({"bc.vector.z"}, "± 1 mm") + "[[output]]"));
    const std::string expected =
        "'bc.vector.z' is uncertain, but the loop 'C' can be closed for its nominal value alone";
    EXPECT_THAT(besides, std::string(as) == "cylinder" ? ::testing::Matcher<std::string>("") : HasSubstr(expected));
  }
}

/// All bars lie in line, where the linkage may go on in two ways.
TEST(ClosedLoopStudy, SaysThatItsRowsDependOnEachOther) {
  std::string flat = replaced(fourBarText("1", "", "", "angle = -3.1"), "d = \"0.9 m\"", "d = \"1.1 m\"");
  flat = replaced(replaced(flat, "angle = 1, rate = 4", "angle = \"180 deg\", rate = 4"), "angle = 1.6", "angle = 3.1");
  EXPECT_THAT(refusalOf(flat), HasSubstr("the loop 'C' starts where its rows depend on each other"));
}

/// A ground of 3.9 m: the crank's end is √(3.738…² + 0.252…²) m from the other hinge, which 0.8 m and 0.6 m do not
/// span.
TEST(ClosedLoopStudy, SaysByHowMuchALoopStaysOpen) {
  const double gap = std::hypot(3.9 - 0.3 * std::cos(1.0), 0.3 * std::sin(1.0)) - 1.4;
  const auto told = [](double value) { return fmt::format("{:.4g}", value); };
  const std::string far = replaced(fourBarText("1", ""), "d = \"0.9 m\"", "d = \"3.9 m\"");
  EXPECT_THAT(refusalOf(far), HasSubstr("near their initial values: 'C' was found to stay open by " + told(gap) +
                                        " m at least, at B.angle = "));
  const std::string small = replaced(replaced(far, "a = \"0.3 m\", b = \"0.8 m\", c = \"0.6 m\", d = \"3.9 m\"",
                                              "a = \"300 mm\", b = \"800 mm\", c = \"600 mm\", d = \"3900 mm\""),
                                     "angle = 1.6", "angle = \"90 deg\"");
  // In line with what is between both hinges.
  const double line = std::atan2(-0.3 * std::sin(1.0), 3.9 - 0.3 * std::cos(1.0)) * 180 / 3.14159265358979;
  EXPECT_THAT(refusalOf(small), HasSubstr("stay open by " + told(1000 * gap) + " mm at least, at B.angle = "));
  EXPECT_THAT(refusalOf(small), HasSubstr(" deg, D.angle = " + told(180 + line) + " deg; expected numbers that fit"));
}

/// What starts in line with itself is no least.
TEST(ClosedLoopStudy, SaysByHowMuchALoopStaysOpenThatStartsInLine) {
  std::string line = replaced(fourBarText("1", "", "", "angle = 0"), "d = \"0.9 m\"", "d = \"3.9 m\"");
  line = replaced(replaced(line, "angle = 1, rate = 4", "angle = 0, rate = 4"), "angle = 1.6", "angle = 0");
  EXPECT_THAT(refusalOf(line), HasSubstr("stay open by 2.2 m at least, at B.angle = "));
}

/// Two rods between the same points.
TEST(ClosedLoopStudy, NamesBothLoopsThatHoldTheSame) {
  const auto closure = [](const std::string& name, const std::string& by) {
    return "[[mechanism.element]]\ntype = \"closure\"\nname = \"" + name +
           "\"\nas = \"pin\"\nfrom = \"C2\"\nto = \"C1\"\n" + by;
  };
  const std::string twice = replaced(fourBarText("1", ""), "[[output]]", closure("E", "") + "[[output]]");
  EXPECT_THAT(refusalOf(twice),
              HasSubstr("the loop 'E' is closed by 2 coordinates, but between its frames 1 may follow "
                        "from others, while B.angle, D.angle close 'C'; expected one loop alone"));
  const auto rod = [](const std::string& name, const std::string& by) {
    return "[[mechanism.element]]\ntype = \"rod\"\nname = \"" + name +
           "\"\nfrom = \"PB\"\nto = \"C2\"\nlength = \"b\"\ndependent = [\"" + by + "\"]\n";
  };
  std::string rods = fourBarText("1", "");
  const std::size_t coupler = rods.find("[[mechanism.element]]\ntype = \"revolute\"\nname = \"B\""),
                    ground = rods.find("[[mechanism.element]]\ntype = \"link\"\nname = \"ground\"");
  rods.erase(coupler, ground - coupler);
  const std::size_t pin = rods.find("[[mechanism.element]]\ntype = \"closure\""), outputs = rods.find("[[output]]");
  rods.replace(pin, outputs - pin, rod("one", "D") + rod("other", "A"));
  rods = replaced(replaced(rods, "C1.position.x", "C2.position.x"), "angle = 1, rate = 4", "angle = 1");
  EXPECT_THAT(refusalOf(rods),
              HasSubstr("the loops 'one', 'other' start where rows of one and the other say the same"));
}

TEST(ClosedLoopStudy, RefusesRigidStopsInTheirPlace) {
  const std::string text =
      replaced(fourBarText("1", ""), "[[output]]",
               "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"stop\"\njoint = \"A\"\nat = 0.5\n"
               "restitution = 0.8\nend = \"lower\"\n[[output]]");
  EXPECT_THAT(refusalOf(text),
              ::testing::MatchesRegex("s.toml:[0-9]+:[0-9]+: .*'A.angle' strikes a rigid end in a machine "
                                      "with constraints; expected an elastic end.*"));
}

/// In the units in which numbers are stated, a few digits.
TEST(ClosedLoopStudy, SaysForWhichNumbersALoopIsNotProvedToClose) {
  const std::string text =
      replaced(fourBarText("1", uncertain({"c", "d"}, "± 45 %")), "d = \"0.9 m\"", "d = \"900 mm\"");
  const std::string refusal = refusalOf(text);
  EXPECT_THAT(refusal, ::testing::ContainsRegex("not proved to close for 'c' in \\[[0-9.]+, [0-9.]+\\] m, "
                                                "'d' in \\[[0-9.]+, [0-9.]+\\] mm; expected"));
  EXPECT_THAT(refusal,
              ::testing::Not(::testing::ContainsRegex("[0-9.][0-9.][0-9.][0-9.][0-9.][0-9.][0-9.][0-9.][0-9.][0-9.]")));
}

}  // namespace
}  // namespace gamut
