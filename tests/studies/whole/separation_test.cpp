// Distances of shapes as outputs of studies: as tight as any other output, also where arms pass through parallel
// positions and the nearest points change, and proved never to be less than a limit.
#include <gmock/gmock.h>

#include <array>
#include <string>

#include "mechanics/assembly.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

using ::testing::StartsWith;

/// A pendulum with a rod about it; lengths in m, angles in degrees.
std::string armText(const std::string& name, const std::string& from, const std::string& axis, const std::string& angle,
                    const std::string& length, const std::string& shape) {
  const std::string sizes = shape == "box" ? R"(size = ["80 mm", "100 mm", ")" + length + "\"]"
                            : shape == "hull"
                                ? R"(points = [["-4 cm", 0, 0], ["4 cm", "-5 cm", 0], ["4 cm", "5 cm", 0],
                                  [0, 0, "-40 cm"], [0, 0, "40 cm"]])"
                                : R"(radius = "50 mm")" + (shape == "sphere" ? "" : "\nlength = \"" + length + "\"");
  return R"([[mechanism.element]]
    type = "revolute"
    name = ")" +
         name + R"("
    from = ")" +
         from + R"("
    to = ")" +
         name + R"(_frame"
    axis = )" +
         axis + R"(
    initial = { angle = ")" +
         angle + R"(" }
    [[mechanism.element]]
    type = "mass"
    name = ")" +
         name + R"(_body"
    at = ")" +
         name + R"(_frame"
    mass = 1
    centre = [0, 0, "-0.5 )" +
         length + R"("]
    inertia = [0.1, 0.1, 0.1]
    [[mechanism.element]]
    type = ")" +
         shape + R"("
    name = ")" +
         name + R"(_rod"
    at = ")" +
         name + R"(_frame"
    )" + sizes +
         R"(
    centre = [0, 0, "-0.5 )" +
         length + R"("]
    )";
}

/// Two such arms, their pivots `apart`, all but the pivots known to a tolerance.
Study twoArms(const std::string& apart, const std::string& axis, const std::string& angle,
              const std::string& further = "", const std::array<std::string, 2>& shapes = {"capsule", "capsule"},
              const std::string& tolerance = "± 1 %") {
  return readStudyText(R"(
    [study]
    title = "Two arms"
    analysis = "dynamics"
    horizon = 0.8
    output_step = 0.05
    compare = ["interval", "stochastic"]
    [mechanism]
    gravity = [0, 0, -9.81]
    [mechanism.parameters]
    one = "1 m"
    other = "80 cm"
    one_angle = "20 deg"
    other_angle = ")" + angle +
                           R"("
    )" + armText("left", "inertial", "\"y\"", "one_angle", "one", shapes[0]) +
                           R"([[mechanism.element]]
    type = "link"
    name = "apart"
    from = "inertial"
    to = "base"
    vector = )" + apart + "\n" +
                           armText("right", "base", axis, "other_angle", "other", shapes[1]) + R"([[mechanism.element]]
    type = "separation"
    name = "gap"
    from = "left_rod"
    to = "right_rod"
    [[uncertain]]
    quantity = "one*"
    interval = ")" + tolerance +
                           R"("
    [[uncertain]]
    quantity = "other*"
    interval = ")" + tolerance +
                           R"("
    [[output]]
    quantity = "gap.distance"
    [stochastic]
    samples = 256
    )" + further,
                       "arms");
}

class TwoArms : public ::testing::Test {
 protected:
  static Results runOf(const Study& study) {
    RunOptions options;
    options.jobs = 2;
    return run(study, options);
  }
};

TEST_F(TwoArms, AreHeldApartTightly) {
  const struct {
    const char* what;
    Study study;
  } cases[] = {{"in one plane", twoArms("[0.5, 0, 0]", "\"y\"", "-5 deg")},
               {"in two planes, crossing", twoArms("[0, 0.3, 0]", "\"y\"", "-20 deg")},
               {"at right angles", twoArms("[0.3, 0.4, 0]", "\"x\"", "10 deg")},
               {"near each other", twoArms("[0.2, 0.1, 0.1]", "\"x\"", "30 deg")}};
  for (const auto& [what, study] : cases) {
    const Results results = runOf(study);
    EXPECT_EQ(results.comparison.verdict, Agreement::inside) << what;
    EXPECT_FALSE(results.comparison.maximum > 1.05) << what;  // NaN: there is one distance in two parallel planes
  }
}

/// Over the whole box neither the nearest points nor a root of their distance can be told: over parts of it they can.
TEST_F(TwoArms, AreHeldApartTightlyWithTolerancesOfFivePercent) {
  const Results results = runOf(
      twoArms("[0.3, 0.4, 0]", "\"x\"", "10 deg", "[distribution]\ntimes = 0\n", {"capsule", "capsule"}, "± 5 %"));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LE(results.comparison.maximum, 1.05);
  EXPECT_EQ(results.interval.shortfall, "");
}

TEST_F(TwoArms, OfBoxesAreHeldApartTightly) {
  const std::string plane = "[0.5, 0, 0]";
  for (const std::array<std::string, 2>& shapes :
       {std::array<std::string, 2>{"box", "box"}, {"box", "capsule"}, {"capsule", "box"}}) {
    const Results results = runOf(twoArms(plane, "\"y\"", "-5 deg", "", shapes));
    EXPECT_EQ(results.comparison.verdict, Agreement::inside) << shapes[0] << ", " << shapes[1];
    EXPECT_LE(results.comparison.maximum, 1.05) << shapes[0] << ", " << shapes[1];
  }
  const auto judged = [&](const std::string& limit) {
    const std::string demand = "[[requirement]]\nname = \"apart\"\nalways = \"gap.distance > " + limit + "\"\n";
    return runOf(twoArms(plane, "\"y\"", "-5 deg", demand, {"box", "box"})).requirements[0].word;
  };
  EXPECT_EQ(judged("50 mm"), Decision::met);
  EXPECT_EQ(judged("70 mm"), Decision::violated);
}

TEST_F(TwoArms, AreProvedNeverToComeCloser) {
  const auto judged = [](const std::string& limit) {
    return runOf(twoArms("[0.5, 0, 0]", "\"y\"", "-5 deg",
                         "[[requirement]]\nname = \"apart\"\nalways = \"gap.distance > " + limit + "\"\n"));
  };
  const Results met = judged("20 mm"), violated = judged("60 mm");
  EXPECT_EQ(met.requirements[0].word, Decision::met);
  EXPECT_EQ(violated.requirements[0].word, Decision::violated);
}

// ---- Hulls ----------------------------------------------------------------------------------------------------------

std::string hullText(const std::string& points) {
  return "[mechanism]\n[[mechanism.element]]\ntype = \"state\"\nname = \"x\"\nrate = 0\n"
         "[[mechanism.element]]\ntype = \"hull\"\nname = \"wedge\"\nat = \"inertial\"\npoints = " +
         points +
         "\n[[mechanism.element]]\ntype = \"sphere\"\nname = \"ball\"\nat = \"inertial\"\nradius = \"5 cm\"\n"
         "centre = [0, 0, 3]\n[[mechanism.element]]\ntype = \"separation\"\nname = \"gap\"\nfrom = \"wedge\"\n"
         "to = \"ball\"\n";
}

TEST(HullText, IsAListOfPoints) {
  const Mechanism m =
      readMechanismText(hullText("[[0, 0, \"100 cm\"], [1, 0, 0], [0, \"1 m\", 0], [-1, -1, 0]]"), "s.toml");
  EXPECT_DOUBLE_EQ(Assembly<double>(m).output("gap.distance"), 1.95);
  const auto complaint = [](const std::string& points) -> std::string {
    try {
      readMechanismText(hullText(points), "s.toml");
    } catch (const StudyError& error) {
      return error.what();
    }
    return "it was read";
  };
  EXPECT_THAT(complaint("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 1, 0]]"),
              StartsWith("s.toml:10:10: the points of 'wedge' lie in one plane; expected 4 at least that do not"));
  EXPECT_THAT(complaint("[[0, 0, 0], [1, 0, 0], [0, 1, 0]]"),
              StartsWith("s.toml:10:10: the points of 'wedge' lie in one plane"));
  EXPECT_THAT(complaint("[[0, 0, 0], [1, 0], [0, 1, 0], [0, 0, 1]]"),
              StartsWith("s.toml:10:22: mechanism.element.points has 2 numbers"));
  EXPECT_THAT(complaint("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, \"1 s\"]]"), StartsWith("s.toml:10:"));
  EXPECT_THAT(complaint("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, \"height\"]]"), StartsWith("s.toml:10:"));
  EXPECT_THAT(complaint("[]"), StartsWith("s.toml:10:10: 'mechanism.element.points' is no list; expected a list of"));
  EXPECT_THAT(complaint("3"), StartsWith("s.toml:10:10: 'mechanism.element.points' is no list; expected a list of"));
  std::string many = "[";
  for (int i = 0; i < 41; ++i) many += "[" + std::to_string(i) + ", " + std::to_string(i * i) + ", 1], ";
  EXPECT_THAT(complaint(many + "[0, 0, 0]]"), StartsWith("s.toml:10:10: 'wedge' has 42 points; expected 40 at most"));
}

TEST_F(TwoArms, OfHullsAreHeldApart) {
  const Study study = twoArms("[0.3, 0.4, 0]", "\"x\"", "10 deg", "", {"hull", "sphere"});
  const Results results = runOf(study);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LE(results.comparison.maximum, 1.2);  // where an edge, and then a face, is nearest
}

/// Four prisms that a swinging rod passes, each of which is never to come near it: tens of thousands of operations.
std::string manyPairs() {
  std::string text = R"(
    [study]
    analysis = "dynamics"
    horizon = 0.8
    output_step = 0.05
    compare = ["interval", "stochastic", "fuzzy"]
    [mechanism]
    gravity = [0, 0, -9.81]
    [mechanism.parameters]
    one = "1 m"
    one_angle = "20 deg"
    )" + armText("left", "inertial", "\"y\"", "one_angle", "one", "box");
  std::string outputs, requirements;
  for (int i = 0; i < 4; ++i) {
    const std::string number = std::to_string(i);
    text += "[[mechanism.element]]\ntype = \"hull\"\nname = \"post" + number + "\"\nat = \"inertial\"\ncentre = [\"" +
            number + "00 mm\", \"0." + number + "1 m\", \"-1.5 m\"]\npoints = [";
    for (const char* corner : {"4, 0", "-2, 3", "-2, -3"})
      for (const char* end : {"-10 cm", "10 cm"}) {
        const std::string across = corner;
        const std::size_t comma = across.find(',');
        text += "[\"" + across.substr(0, comma) + " cm\", \"" + across.substr(comma + 2) + " cm\", \"" + end + "\"], ";
      }
    text += "]\n[[mechanism.element]]\ntype = \"separation\"\nname = \"gap" + number +
            "\"\nfrom = \"left_rod\"\nto = \"post" + number + "\"\n";
    outputs += "[[output]]\nquantity = \"gap" + number + ".distance\"\n";
    requirements +=
        "[[requirement]]\nname = \"apart " + number + "\"\nalways = \"gap" + number + ".distance > 1 cm\"\n";
  }
  return text + "[[uncertain]]\nquantity = \"one\"\ninterval = \"± 1 %\"\n" + outputs + requirements;
}

/// Whatever is at work when it is reached ends soon, and all is told that was found.
TEST(ManyPairs, KeepToALimitOfTime) {
  const Machine machine(readStudyText(manyPairs(), "s.toml"));
  constexpr double limit = 5;
  RunOptions options;
  options.timeLimit = machine.cpu + limit;
  const Results results = run(machine, options);
  EXPECT_LT(results.cpu, machine.cpu + 1.1 * limit + 0.5);
  EXPECT_EQ(results.requirements.size(), 4u);
  for (const RequirementResult& each : results.requirements)
    EXPECT_TRUE(each.word != Decision::open || !each.why.empty()) << each.name;
}

}  // namespace
}  // namespace gamut
