// What a study file says is what is read; whatever is wrong is said in one line with its place.
#include <gmock/gmock.h>

#include <fstream>
#include <set>
#include <string>

#include "mechanics/assembly.hpp"
#include "mechanics/elements/all.hpp"
#include "studies/printable.hpp"
#include "studies/study.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(StudyReader, ReadsWhatTheFileSays) {
  const Study study = readStudyText(sampleStudy, "s.toml");
  EXPECT_EQ(study.text, sampleStudy);
  EXPECT_EQ(study.title, "Pendulum");
  EXPECT_EQ(study.analysis, Study::Analysis::dynamics);
  EXPECT_EQ(study.horizon, 0.5);
  EXPECT_THAT(study.times, ElementsAre(0, 0.1, 0.2, 0.3, 0.4, 0.5));
  EXPECT_EQ(study.compare, (std::set<std::string, std::less<>>{"fuzzy", "interval", "stochastic"}));
  ASSERT_EQ(study.uncertain.size(), 1U);
  EXPECT_EQ(study.uncertain[0].quantity, "hinge.angle");
  EXPECT_EQ(study.uncertain[0].unit, "rad");
  EXPECT_EQ(study.uncertain[0].uncertain.name, "start");
  ASSERT_EQ(study.outputs.size(), 2U);
  EXPECT_EQ(study.outputs[0].name, "angle");
  EXPECT_EQ(study.outputs[1].name, "tip.position.z");
  EXPECT_EQ(study.outputs[1].unit, "m");
  EXPECT_EQ(study.ensemble.samples, 16U);
  EXPECT_EQ(study.ensemble.seed, 7U);
  EXPECT_EQ(study.levels, 11);
}

TEST(StudyReader, EnclosesDecimalsAsTheyAreWritten) {
  const Study study = readStudyText(sampleStudyWith("length = 0.5", "length = 0.1"), "s.toml");
  const auto expectEnclosed = [&](const std::string& quantity, const Interval& expected) {
    const Interval found = study.mechanism.nominal(quantity);
    EXPECT_TRUE(isEqual(found, expected)) << quantity << ": " << toString(found) << " is not " << toString(expected);
  };
  expectEnclosed("gravity.z", Interval("-9.81"));
  expectEnclosed("rod.length", Interval("0.1"));
  expectEnclosed("bob.mass", Interval(0.25));
  expectEnclosed("hinge.rate", Interval(0.5));
  EXPECT_FALSE(isThin(study.mechanism.nominal("gravity.z")));
  EXPECT_FALSE(isThin(study.mechanism.nominal("hinge.angle")));
}

/// A road beneath what turns would not be seen.
TEST(StudyReader, SaysWhereAProfileIsNone) {
  const auto message = [](const std::string& joint, const std::string& speed) {
    return messageOf(
        "[study]\nanalysis = \"dynamics\"\nhorizon = 1\noutput_step = 0.1\n[[mechanism.element]]\ntype = \"" + joint +
        "\"\nname = \"cam\"\nfrom = \"inertial\"\nto = \"K\"\naxis = \"z\"\n[[mechanism.element]]\ntype = "
        "\"drive\"\nname = \"road\"\njoint = \"cam\"\nposition = \"0.1*sin(t/(1 s))\"\nprofile_speed = " +
        speed + "\n");
  };
  EXPECT_EQ(message("revolute", "\"5 m/s\""),
            "s.toml:16:17: 'road.profile_speed': the motion of the joint 'cam.angle' is no height of a profile: it "
            "turns; expected none, or "
            "a joint that slides, alone and across `along`");
  EXPECT_THAT(message("revolute", "0"), Not(HasSubstr("profile")));
  EXPECT_THAT(message("prismatic", "\"5 m/s\""), Not(HasSubstr("is no height")));
}

TEST(StudyReader, FindsADecimalBehindOtherLetters) {
  const Study study = readStudyText(
      sampleStudyWith("mass = \"250 g\"", "mass = 1\nparameters = { \"größe ±\" = 1e-1, other = +0.3 }"), "s.toml");
  EXPECT_TRUE(isEqual(study.mechanism.nominal("bob.größe ±"), Interval("0.1")));
  EXPECT_TRUE(isEqual(study.mechanism.nominal("bob.other"), Interval("0.3")));
}

TEST(StudyReader, TakesADeviationRelativeToTheNominalValueOrInItsUnit) {
  const auto rangeOf = [](const std::string& interval) {
    return readStudyText(sampleStudyWith("interval = \"± 1 %\"", "interval = " + interval), "s.toml")
        .uncertain[0]
        .uncertain.range;
  };
  const Interval nominal = pi() / 6.0;
  const Interval onePercent = rangeOf("\"± 1 %\"");
  EXPECT_TRUE(isSubset(nominal * Interval("[0.99, 1.01]"), onePercent));
  EXPECT_LT(width(onePercent), 0.0200001 * nominal.upper());
  const Interval twoDegrees = rangeOf("\"± 2 deg\"");
  EXPECT_TRUE(isSubset(pi() * Interval(28.0, 32.0) / 180.0, twoDegrees));
  EXPECT_LT(width(twoDegrees), 4.0001 / 180 * 3.1416);
  for (const char* text : {"+2 / -1 deg", "- 1 / + 2 deg", "+ 2 deg / −1 deg"}) {
    const Interval range = rangeOf("\"" + std::string(text) + "\"");
    EXPECT_TRUE(isSubset(pi() * Interval(29.0, 32.0) / 180.0, range)) << text;
    EXPECT_LT(width(range), 3.0001 / 180 * 3.1416) << text;
  }
  const Interval oneSided = rangeOf("\"+0 / -1e0 %\"");
  EXPECT_TRUE(isSubset(nominal * Interval("[0.99, 1]"), oneSided));
  EXPECT_LT(width(oneSided), 0.0100001 * nominal.upper());
  const Study falling =
      readStudyText(sampleStudyWith("[[uncertain]]",
                                    "[[uncertain]]\nquantity = \"gravity.z\"\ninterval = \"+2 / -1 %\"\n[[uncertain]]"),
                    "s.toml");
  const Interval field = falling.uncertain[0].uncertain.range;  // about -9.81: up is towards zero
  EXPECT_TRUE(isSubset(Interval("9.81") * Interval("[-1.01, -0.98]"), field));
  EXPECT_LT(width(field), 9.81 * 0.030001);
  EXPECT_TRUE(isEqual(rangeOf("[\"20 deg\", 0.6]"), Interval((pi() / 9.0).lower(), Interval("0.6").upper())));
}

TEST(StudyReader, MakesManyQuantitiesUncertainAtOnce) {
  const auto quantitiesOf = [](const std::string& quantity) {
    std::vector<std::string> found;
    for (const UncertainQuantity& q :
         readStudyText(sampleStudyWith("name = \"start\"\nquantity = \"hinge.angle\"", "quantity = " + quantity),
                       "s.toml")
             .uncertain)
      found.push_back(q.uncertain.name);
    return found;
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(quantitiesOf("[\"hinge.angle\", \"bob.mass\"]"), ElementsAre("hinge.angle", "bob.mass"));
  EXPECT_THAT(quantitiesOf("\"hinge.*\""), ElementsAre("hinge.angle", "hinge.rate"));
  EXPECT_THAT(quantitiesOf("[\"*.length\", \"h*e.*t*\"]"), ElementsAre("rod.length", "hinge.rate"));
  const Study study = readStudyText(
      sampleStudyWith("name = \"start\"\nquantity = \"hinge.angle\"", "quantity = \"hinge.*\""), "s.toml");
  EXPECT_TRUE(isSubset(Interval("[0.495, 0.505]"), study.uncertain[1].uncertain.range));
  EXPECT_LT(width(study.uncertain[1].uncertain.range), 0.0100001);
}

/// By backtracking over twelve stars this would not end.
TEST(StudyReader, TakesAnyNumberOfStars) {
  const auto messageOfPattern = [](const std::string& pattern) {
    return messageOf(sampleStudyWith("name = \"start\"\nquantity = \"hinge.angle\"", "quantity = \"" + pattern + "\""));
  };
  const std::string stars(3000, '*');
  for (const std::string& pattern :
       std::vector<std::string>{stars + "q", "*h*i*n*g*e*q*", "hinge*hinge*", "*.angle.*.angle", "a*e"})
    EXPECT_THAT(messageOfPattern(pattern), HasSubstr("no quantity fits '")) << pattern;
  for (const std::string& pattern : std::vector<std::string>{stars + "angle", "hinge.*a*n*g*l*e*", "*ge.ang*", "h*e"})
    EXPECT_THAT(messageOfPattern(pattern), Not(HasSubstr("no quantity fits"))) << pattern;
}

TEST(StudyReader, NamesTheQuantityOfAPatternThatIsAtFault) {
  const auto messageOfPattern = [](const std::string& angle, const std::string& interval) {
    std::string text = sampleStudyWith("name = \"start\"\nquantity = \"hinge.angle\"", "quantity = \"hinge.*\"");
    text.replace(text.find("angle = \"30 deg\""), 16, "angle = " + angle);
    return messageOf(text.replace(text.find("\"± 1 %\""), std::string("\"± 1 %\"").size(), interval));
  };
  EXPECT_EQ(messageOfPattern("0", "\"± 5 %\""),
            "s.toml:30:12: uncertain.interval is a share of the nominal value, which is 0, for 'hinge.angle'; expected "
            "an absolute deviation, such as \"± 0.01 rad\"");
  EXPECT_EQ(
      messageOfPattern("0.5", "\"± 1 deg\""),
      "s.toml:30:12: uncertain.interval is written in a unit of the kind rad, for 'hinge.rate'; expected a number "
      "in rad/s, or with a unit of that kind");
  EXPECT_THAT(messageOfPattern("0.5", "[0.6, 0.7]"), HasSubstr("nominal value 0.5 rad, for 'hinge.angle'; expected "));
}

TEST(StudyReader, TakesNamesAsMessagesQuoteThem) {
  std::string text = sampleStudyWith("quantity = \"hinge.angle\"", "quantity = \"'hinge.angle'\"");
  text.replace(text.find("quantity = \"tip.position.z\""), 27, "quantity = \"'hinge.acceleration'\"");
  const Study study = readStudyText(text, "s.toml");
  EXPECT_EQ(study.uncertain[0].quantity, "hinge.angle");
  EXPECT_EQ(study.outputs[1].unit, "rad/s^2");
}

/// Letters are units only where the study names nothing so.
TEST(StudyReader, TakesParametersStatesAndOutputsNamedLikeSomeUnits) {
  const std::string text =
      "[study]\nanalysis = \"dynamics\"\nhorizon = 1\noutput_step = 0.5\n[mechanism]\n"
      "parameters = { T = \"0.4 s\", R = \"2 Ohm\", L = \"3 mH\" }\n"
      "[[mechanism.element]]\ntype = \"state\"\nname = \"A\"\ninitial = \"0 A\"\n"
      "rate = \"(12 V*(1 - exp(-t/T)) - R*A)/L\"\n"
      "[[output]]\nquantity = \"A\"\n[[output]]\nname = \"K\"\nquantity = \"2 A\"\nunit = \"mA\"\n"
      "[[requirement]]\nalways = \"K < 20\"\n";
  const Study study = readStudyText(text, "s.toml");
  EXPECT_EQ(study.mechanism.unitOf("A"), "A");
  EXPECT_EQ(study.outputs[1].unit, "mA");
  EXPECT_EQ(study.outputs[2].unit, "mA");  // as the output that it compares
  EXPECT_EQ(study.outputs[2].quantity, "20 A - K");
  EXPECT_THAT(messageOf(std::string(text).replace(text.find("unit = \"mA\""), 11, "unit = \"A\"")),
              HasSubstr("output.unit is A, and the study has a number of its own named 'A'; expected "));
}

TEST(StudyReader, SaysHowAStateGetsTheUnitOfItsRate) {
  const auto messageOfRate = [](const std::string& rate) {
    return messageOf(sampleStudyWith(
        "[[uncertain]]",
        "[[mechanism.element]]\ntype = \"state\"\nname = \"z\"\ninitial = 0\nrate = \"" + rate + "\"\n[[uncertain]]"));
  };
  const std::string stated = "the state 'z' has no unit; its unit is that of its initial value, such as initial = ";
  for (const char* rate : {"hinge.angle", "hinge.angle - z", "2 hinge.angle"})
    EXPECT_EQ(messageOfRate(rate), "s.toml:32:8: 'z.rate': a quantity in rad, but " + std::string(stated) +
                                       "\"0 rad s\"; expected a rate in 1/s, or a state with that unit")
        << rate;
  EXPECT_EQ(messageOfRate("hinge.rate - z"),
            "s.toml:32:8: 'z.rate': subtracts a number without unit from rad/s at column 12, and " + stated +
                "\"0 rad\"; expected quantities of one kind");
  EXPECT_EQ(messageOfRate("hinge.rate"), "it was read");
}

TEST(StudyReader, NamesJointsThatMoveAlike) {
  const auto messageOfHinge = [](const std::string& axis) {
    return messageOf(sampleStudyWith("[[mechanism.element]]\ntype = \"link\"\nname = \"rod\"\nfrom = \"K1\"",
                                     "[[mechanism.element]]\ntype = \"revolute\"\nname = \"second\"\nfrom = \"K1\"\nto "
                                     "= \"K2\"\naxis = \"" +
                                         axis +
                                         "\"\n[[mechanism.element]]\ntype = \"link\"\nname = \"rod\"\nfrom = \"K2\""));
  };
  for (const char* axis : {"x", "-x"})
    EXPECT_EQ(messageOfHinge(axis),
              "s.toml:16:1: 'second.rate' moves all masses as 'hinge.rate' does, so that the motion is not determined; "
              "expected joints that move masses in different ways (hinges on one axis turn what is between them, which "
              "needs inertia)");
  EXPECT_EQ(messageOfHinge("y"), "it was read");
}

TEST(StudyReader, QuotesPartsOfWhatIsEndless) {
  const std::string endless(3000000, 'x');
  for (const auto& [old, replacement] : std::vector<std::pair<std::string, std::string>>{
           {"quantity = \"hinge.angle\"", "quantity = \"" + endless + "\""},
           {"axis = \"x\"", "axis = \"" + endless + "\""},
           {"at = \"tip\"", "at = \"" + endless + "\""},
           {"[stochastic]", "[" + endless + "]"},
           {"samples = 16", endless + " = 16"},
           {"horizon = 0.5", "horizon = \"" + endless + "\""},
           {"angle = \"30 deg\"", "angle = \"" + std::string(9000, 'x') + "\""},
           {"\"± 1 %\"", "\"" + endless + "\""},
           {"to = \"tip\"", "to = \"tip\"\n" + endless}}) {
    const std::string message = messageOf(sampleStudyWith(old, replacement));
    EXPECT_LT(message.size(), 3000u) << old;
    EXPECT_THAT(message, HasSubstr("; expected ")) << old;
  }
}

TEST(StudyReader, TakesTheIntervalFromSupports) {
  const auto rangeOf = [](const std::string& shapes) {
    return readStudyText(sampleStudyWith("interval = \"± 1 %\"\ndistribution = { type = \"uniform\" }\n"
                                         "membership = { type = \"triangular\" }",
                                         shapes),
                         "s.toml")
        .uncertain[0]
        .uncertain.range;
  };
  const Interval both = rangeOf(
      "distribution = { type = \"beta\", a = 2, b = 2, support = [0.5, 0.55] }\n"
      "membership = { type = \"table\", points = [[0.45, 0], [0.52, 1], [0.54, 0]] }");
  EXPECT_TRUE(isSubset(Interval("[0.45, 0.55]"), both));
  EXPECT_LT(width(both), 0.1000001);
  EXPECT_TRUE(
      isSubset(Interval("[0.5, 0.6]"), rangeOf("membership = { type = \"triangular\", support = [0.5, 0.6] }")));
}

TEST(StudyReader, TakesParametersByNameWithAFactor) {
  const Study study = readStudyText(sampleStudyWith("vector = [0, 0, \"-rod.length\"]",
                                                    "vector = [\"1/2 rod.length\", \"10 mm\", \"-2*rod.length\"]"),
                                    "s.toml");
  const Link& link = *study.mechanism.elements()[1].as<Link>();
  const auto valueAt = [&](std::size_t i) {
    return link.vector[i].evaluate<Interval>([](const std::string& name) {
      EXPECT_EQ(name, "rod.length");
      return Interval(3.0);
    });
  };
  EXPECT_TRUE(isEqual(valueAt(0), Interval(1.5)));
  EXPECT_TRUE(isEqual(valueAt(2), Interval(-6.0)));
  EXPECT_TRUE(isEqual(study.mechanism.nominal("rod.vector.y"), Interval("0.01")));
}

/// A study of states alone, without any mechanism.
std::string predatorAndPrey(const std::string& name, const std::string& initial, const std::string& output) {
  return "[study]\nanalysis = \"dynamics\"\nhorizon = 1\noutput_step = 0.5\n[mechanism]\n"
         "parameters = { a = \"1.5 /s\" }\n[[mechanism.element]]\ntype = \"state\"\nname = \"" +
         name + "\"\ninitial = " + initial + "\nrate = \"-a*" + name + "\"\n[[output]]\nquantity = \"" + output +
         "\"\n";
}

TEST(StudyReader, TakesStatesWithTheirInitialValuesAndUnits) {
  const Study plain = readStudyText(predatorAndPrey("prey", "2", "prey"), "s.toml");
  EXPECT_TRUE(isEqual(plain.mechanism.nominal("prey"), Interval(2.0)));
  EXPECT_EQ(plain.mechanism.unitOf("prey"), "1");
  const Study moment = readStudyText(predatorAndPrey("lag", "\"3 N m\"", "lag"), "s.toml");
  EXPECT_EQ(moment.mechanism.unitOf("lag"), "N m");
}

TEST(StudyReader, TakesTimeParametersAndExpressionsForOutputs) {
  for (const auto& [output, unit] : {std::pair{"t", "s"}, {"a", "1/s"}, {"a*prey^2", "1/s"}, {"prey", "1"}})
    EXPECT_EQ(readStudyText(predatorAndPrey("prey", "2", output), "s.toml").outputs[0].unit, unit) << output;
}

TEST(StudyReader, TakesMassTimesRadiusTimesSquaredRateForAForce) {
  const auto with = [](const std::string& unit, const std::string& limit) {
    return readStudyText(
        sampleStudy + ("[[output]]\nname = \"pull\"\nquantity = \"bob.mass*rod.length*hinge.rate^2\"\n"
                       "unit = \"" +
                       unit + "\"\n[[requirement]]\nname = \"holds\"\nalways = \"pull < " + limit + "\"\n"),
        "s.toml");
  };
  const Study study = with("N", "5 kN");
  EXPECT_EQ(study.outputs[2].unit, "N");
  EXPECT_EQ(study.outputs[3].unit, "N");  // as the output, not as its limit
  EXPECT_THROW(with("J", "5 kN"), StudyError);
  EXPECT_THROW(with("N", "5 m"), StudyError);
  EXPECT_THROW(readStudyText(sampleStudy + "[[output]]\nquantity = \"hinge.rate\"\nunit = \"Hz\"\n", "s.toml"),
               StudyError);  // rad/s is not turns a second
}

TEST(StudyReader, TakesNoStiffnessForAMoment) {
  const auto with = [](const std::string& limit) {
    return readStudyText(sampleStudy + ("[[output]]\nname = \"weight\"\n"
                                        "quantity = \"bob.mass*(9.81 m/s^2)*rod.length\"\nunit = \"N m\"\n"
                                        "[[requirement]]\nname = \"holds\"\nalways = \"weight < " +
                                        limit + "\"\n"),
                         "s.toml");
  };
  EXPECT_EQ(with("5 N m").outputs[3].unit, "N m");
  EXPECT_THROW(with("5 N m/rad"), StudyError);
  EXPECT_THROW(with("5 N m/deg"), StudyError);
}

TEST(StudyReader, TakesConstantsThatAreNoRationalNumbers) {
  const Mechanism mechanism =
      readStudyText(sampleStudyWith("length = 0.5", "length = \"sqrt(2)*30 cm\", force = \"sqrt((3 N)^2 + (4 N)^2)\""),
                    "s.toml")
          .mechanism;
  EXPECT_EQ(mechanism.unitOf("rod.length"), "m");
  EXPECT_TRUE(contains(sqr(mechanism.nominal("rod.length")), 0.18));
  EXPECT_LT(width(mechanism.nominal("rod.length")), 1e-15);
  EXPECT_EQ(mechanism.unitOf("rod.force"), "N");
  EXPECT_TRUE(contains(mechanism.nominal("rod.force"), 5.0));
}

TEST(StudyReader, RefusesPointsThatCoincideInKinematicsToo) {
  std::string text = sampleStudyWith("dynamics", "kinematics");
  text.erase(text.find("horizon = 0.5\n"), 14);
  text.erase(text.find("output_step = 0.1\n"), 18);
  text.insert(text.find("[[uncertain]]"),
              "[[mechanism.element]]\ntype = \"distance\"\nname = \"d\"\nfrom = \"inertial\"\nto = \"K1\"\n");
  EXPECT_EQ(messageOf(text),
            "s.toml:26:1: the distance 'd' has no length at the start; expected points that lie apart");
}

TEST(StudyReader, RefusesStatesNamedLikeNumbersOrUnits) {
  for (const char* name : {"1e5", "kg", "pi", "t"})
    EXPECT_THROW(readStudyText(predatorAndPrey(name, "2", "energy"), "s.toml"), StudyError) << name;
}

TEST(StudyReader, TakesFormulasForNumbers) {
  std::string text = sampleStudyWith("gravity = [0, 0, -9.81]",
                                     "gravity = [0, 0, \"-fall\"]\nparameters = { fall = \"9.81 m/s^2\", "
                                     "size = \"0.4 m\", half = \"size/2\" }");
  const auto replace = [&](const std::string& old, const std::string& replacement) {
    text.replace(text.find(old), old.size(), replacement);
  };
  replace("\"-rod.length\"", "\"-2 rod.length - half + 3 mm\"");
  replace("length = 0.5", "length = \"sqrt(size^2 + (30 cm)^2)\"");
  replace("\"250 g\"", "\"2.5 kg/m * half + 1/2*250 g\"");
  const Mechanism mechanism = readStudyText(text, "s.toml").mechanism;
  const auto is = [&](const Interval& found, const char* expected) {
    EXPECT_TRUE(contains(found, midpoint(Interval(expected))) && width(found) < 1e-15) << toString(found);
  };
  is(mechanism.nominal("rod.length"), "0.5");
  is(mechanism.rangeOf(mechanism.elements()[1].as<Link>()->vector[2]), "-1.197");
  is(mechanism.rangeOf(mechanism.elements()[2].as<Mass>()->mass), "0.625");
  EXPECT_EQ(mechanism.unitOf("rod.length"), "m");
}

TEST(StudyReader, SaysWhereAFormulaIsWrong) {
  const auto complaint = [](const std::string& number) {
    try {
      readStudyText(sampleStudyWith("\"-rod.length\"", "\"" + number + "\""), "s.toml");
    } catch (const StudyError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(complaint("rod.length + bob"),
            "s.toml:21:17: unknown parameter 'bob'; expected one of: gravity.x, gravity.y, gravity.z, rod.length, "
            "rod.vector.x, rod.vector.y (for 'rod.vector.z')");
  EXPECT_EQ(complaint("rod.length + 1 kg"),
            "s.toml:21:17: 'rod.vector.z': adds kg to m at column 12; expected quantities of one kind");
  EXPECT_EQ(complaint("rod.length^2"), "s.toml:21:17: 'rod.vector.z': a quantity in m^2; expected one in m");
  EXPECT_THAT(complaint("2 mas"), HasSubstr("s.toml:21:17: mechanism.element.vector: unknown unit 'mas' in '2 mas'"));
}

TEST(StudyReader, RefusesAnUncertainQuantityThatFollowsFromOthers) {
  std::string text =
      sampleStudyWith("gravity = [0, 0, -9.81]", "gravity = [0, 0, -9.81]\nparameters = { a = \"1 m\", b = \"2 a\" }");
  text.replace(text.find("quantity = \"hinge.angle\""), 24, "quantity = \"b\"");
  try {
    readStudyText(text, "s.toml");
    FAIL();
  } catch (const StudyError& error) {
    EXPECT_STREQ(error.what(), "s.toml:31:12: 'b' follows from a formula; expected one of the quantities in it: a");
  }
}

TEST(StudyReader, KeepsQuarterTurnsExact) {
  const Study study =
      readStudyText(sampleStudyWith("parameters = { length = 0.5 }",
                                    "parameters = { length = 0.5 }\nrotation = [{ axis = \"z\", angle = \"-90 deg\" }, "
                                    "{ axis = \"y\", angle = \"10 deg\" }]"),
                    "s.toml");
  const Link& link = *study.mechanism.elements()[1].as<Link>();
  EXPECT_EQ(link.rotation[0].quarterTurns, -1);
  EXPECT_EQ(link.rotation[1].quarterTurns, 0);
}

TEST(StudyReader, TakesOrientationsAsUsersHaveThem) {
  const auto ball = [](const std::string& initial) {
    const Study study = readStudyText(
        sampleStudyWith(
            "[[uncertain]]",
            "[[mechanism.element]]\ntype = \"spherical\"\nname = \"ball\"\nfrom = \"tip\"\nto = \"B\"\n" + initial +
                "[[mechanism.element]]\ntype = \"mass\"\nname = \"body\"\nat = \"B\"\nmass = 1\ninertia = [1, "
                "1, 1]\n[[uncertain]]"),
        "s.toml");
    return study.mechanism;
  };
  const auto orientationOf = [](const Mechanism& mechanism) {
    const Assembly<double> assembly(mechanism);
    return Matrix3<double>(assembly.frame("tip").R.transpose() * assembly.frame("B").R);
  };
  const auto degrees = [](const Mechanism& m, const std::string& number) {
    return midpoint(m.nominal(number)) * 180 / M_PI;
  };
  const Mechanism angles =
      ball("initial = { orientation = { pitch = \"30 deg\", yaw = \"90 deg\" }, rate = [1, \"2 deg/s\", 0] }\n");
  EXPECT_NEAR(degrees(angles, "ball.orientation.pitch"), 30, 1e-12);
  EXPECT_EQ(midpoint(angles.nominal("ball.orientation.roll")), 0);
  EXPECT_EQ(midpoint(angles.nominal("ball.rate.x")), 1);
  const Mechanism turns = ball(
      "initial = { orientation = [{ axis = \"z\", angle = \"90 deg\" }, { axis = \"y\", angle = \"30 deg\" }] }\n");
  EXPECT_NEAR(degrees(turns, "ball.orientation.2"), 30, 1e-12);
  EXPECT_LT((orientationOf(angles) - orientationOf(turns)).norm(), 1e-15);
  const Mechanism one = ball("initial = { orientation = { axis = [0, 3, 4], angle = \"120 deg\" } }\n");
  EXPECT_NEAR(degrees(one, "ball.orientation.angle"), 120, 1e-12);
  const Mechanism quaternion =
      ball("initial = { orientation = { quaternion = [1, 0, \"0.6 sqrt(3)\", \"0.8 sqrt(3)\"] } }\n");
  EXPECT_LT((orientationOf(one) - orientationOf(quaternion)).norm(), 1e-15) << "tan 60 deg is the square root of 3";
  EXPECT_TRUE(quaternion.isParameter("ball.orientation.y"));
  const Mechanism none = ball("");
  EXPECT_TRUE(none.isParameter("ball.orientation.yaw")) << "it may be uncertain";
}

TEST(StudyReader, TakesLimitsInSecondsAndGigabytes) {
  const StatedLimits limits =
      readStudyText(sampleStudyWith("[stochastic]",
                                    "[limits]\ntime = \"2 min\"\nmemory = 0.5\nsample_time = 3\n"
                                    "[stochastic]"),
                    "s.toml")
          .limits;
  EXPECT_EQ(limits.time, 120);
  EXPECT_EQ(limits.memory, 5e8);
  EXPECT_EQ(limits.sampleTime, 3);
  EXPECT_FALSE(limits.enclosureTime || limits.enclosureMemory);
  EXPECT_EQ(limits.resolved().enclosureTime, 80);
  EXPECT_EQ(limits.resolved().sampleTime, 3);
  const Limits defaults = readStudyText(sampleStudy, "s.toml").limits.resolved();
  EXPECT_EQ(defaults.time, 1800);
  EXPECT_EQ(defaults.memory, 0.75 * memoryPresent());
  EXPECT_EQ(defaults.sampleTime, 18);
  const StatedLimits all =
      readStudyText(sampleStudyWith("[stochastic]", "[limits]\ntime = 60\nenclosure_time = \"1 min\"\n[stochastic]"),
                    "s.toml")
          .limits;
  EXPECT_EQ(all.resolved().enclosureTime, 60);
}

TEST(StudyReader, TakesStorageInGigabytesOrWithAUnit) {
  const auto storage = [](const std::string& value) {
    return readStudyText(sampleStudyWith("[stochastic]", "[stochastic]\nstorage = " + value), "s.toml").storage;
  };
  EXPECT_EQ(readStudyText(sampleStudy, "s.toml").storage, 4e6);
  EXPECT_EQ(storage("0.25"), 2.5e8);
  EXPECT_EQ(storage("\"64 MB\""), 64e6);
  EXPECT_EQ(storage("0"), 0);
}

TEST(StudyReader, TakesTheHorizonInWhereTheStepDoesNotMeetIt) {
  EXPECT_THAT(readStudyText(sampleStudyWith("output_step = 0.1", "output_step = \"200 ms\""), "s.toml").times,
              ElementsAre(0, 0.2, 0.4, 0.5));
  EXPECT_THAT(readStudyText(sampleStudyWith("output_step = 0.1", "output_times = [0.25, \"300 ms\"]"), "s.toml").times,
              ElementsAre(0, 0.25, 0.3, 0.5));
  EXPECT_THAT(readStudyText(sampleStudyWith("output_step = 0.1", "output_times = [0, 0.5]"), "s.toml").times,
              ElementsAre(0, 0.5));
}

TEST(StudyReader, ReadsEveryKindOfElementDistributionAndMembership) {
  const std::string more = R"([[mechanism.element]]
type = "prismatic"
name = "slider"
from = "tip"
to = "K3"
axis = [0, 1, 1]
initial = { displacement = "5 cm", rate = "1 m/s" }
[[mechanism.element]]
type = "mass"
name = "load"
at = "K3"
mass = 1
centre = [0, 0, "1 cm"]
inertia = [1, 2, 2]
[[mechanism.element]]
type = "spring-damper"
name = "spring"
from = "inertial"
to = "K3"
stiffness = "3 N/mm"
rest_length = 1
damping = 2
from_point = [0, 3, 0]
[[mechanism.element]]
type = "joint-spring"
name = "friction"
joint = "hinge"
damping = "0.1 N m s/rad"
[[uncertain]]
quantity = "load.mass"
interval = [0.9, 1.1]
distribution = { type = "normal", deviation = 0.05, support = [0.92, 1.08] }
membership = { type = "gaussian", deviation = "50 g" }
[[uncertain]]
quantity = "spring.stiffness"
interval = "± 10 %"
distribution = { type = "beta", a = 2, b = 3 }
membership = { type = "trapezoidal", core = [2900, "3.1 N/mm"] }
[[uncertain]]
quantity = "friction.damping"
interval = [0.05, 0.2]
distribution = { type = "lognormal", log_mean = -2.3, log_deviation = 0.2 }
[[uncertain]]
quantity = "gravity.z"
interval = "+- 0.01"
distribution = { type = "triangular", mode = -9.805 }
[[uncertain]])";
  const Study study = readStudyText(sampleStudyWith("[[uncertain]]", more), "s.toml");
  ASSERT_EQ(study.uncertain.size(), 5U);
  EXPECT_EQ(study.uncertain[0].uncertain.distribution.name(), "normal");
  EXPECT_TRUE(isSubset(Interval("[0.92, 1.08]"), study.uncertain[0].uncertain.distribution.support()));
  EXPECT_EQ(study.uncertain[0].uncertain.membership.name(), "gaussian");
  EXPECT_EQ(study.uncertain[1].uncertain.membership.name(), "trapezoidal");
  EXPECT_EQ(study.uncertain[2].uncertain.distribution.name(), "lognormal");
  EXPECT_EQ(study.uncertain[3].unit, "m/s^2");
  EXPECT_TRUE(isEqual(study.mechanism.nominal("spring.stiffness"), Interval(3000.0)));
}

TEST(StudyReader, ReadsAMembershipTableAsItsPointsWithTheSupportRoundedOutward) {
  const std::string table =
      R"(membership = { type = "table", points = [[0.52, 0], ["29.9 deg", 0.5], [0.5236, 1], ["30.1 deg", 1.0], [0.527, 0.25]] })";
  const Study study = readStudyText(sampleStudyWith("membership = { type = \"triangular\" }", table), "s.toml");
  const Membership& membership = study.uncertain[0].uncertain.membership;
  const auto degrees = [](const char* number) { return Interval(number) * pi() / 180; };
  EXPECT_EQ(membership.name(), "table");
  EXPECT_TRUE(isEqual(membership.support(), hull(Interval("0.52"), Interval("0.527"))));
  EXPECT_EQ(membership.core().lower(), 0.5236);
  EXPECT_TRUE(contains(degrees("30.1"), membership.core().upper()));
  EXPECT_TRUE(contains(degrees("29.9"), membership.cut(0.5).lower()));
  EXPECT_EQ(membership.cut(0.25).upper(), membership.support().upper());
}

TEST(StudyReader, ReadsTheAnalysesOptions) {
  const std::string text =
      sampleStudy +
      "method = \"bdf\"\ntolerance = { relative = 1e-9, absolute = 1e-11 }\n[interval]\ntightness = 1.1\ntolerance = "
      "1e-12\norder = 18\ndegree = \"auto\"\nsplit = false\nmax_pieces = 10\n[fuzzy]\nlevels = 5\n";
  const Study study = readStudyText(text, "s.toml");
  EXPECT_EQ(study.flow.tightness, 1.1);
  EXPECT_EQ(study.flow.tolerance, 1e-12);
  EXPECT_EQ(study.flow.order, 18);
  EXPECT_EQ(study.flow.degree, -1);
  EXPECT_FALSE(study.flow.split);
  EXPECT_EQ(study.flow.maxPieces, 10);
  EXPECT_EQ(study.levels, 5);
  EXPECT_EQ(study.ensemble.method, Method::bdf);
  EXPECT_EQ(study.ensemble.tolerance.relative, 1e-9);
  EXPECT_EQ(study.ensemble.tolerance.absolute, 1e-11);
}

TEST(StudyReader, MissesTheStudyInAnEmptyFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("empty.toml", "");
  try {
    readStudy(path);
    ADD_FAILURE() << "was read";
  } catch (const StudyError& error) {
    EXPECT_EQ(std::string(error.what()), path + ":1:1: 'study' is missing; expected a table [study]");
  }
}

TEST(StudyReader, RefusesAValueBesideTheIntervalInNumbersThatShowIt) {
  const auto refusal = [](const std::string& interval, const std::string& membership) {
    std::string text = sampleStudyWith("quantity = \"hinge.angle\"\ninterval = \"± 1 %\"",
                                       "quantity = \"hinge.rate\"\ninterval = " + interval);
    text.replace(text.find("rate = 0.5"), 10, "rate = 0.8");
    const std::string old = "membership = { type = \"triangular\" }";
    return messageOf(text.replace(text.find(old), old.size(), "membership = { type = " + membership + " }"));
  };
  for (const std::string interval : {"[0.795, 0.805]", "\"± 0.005\""}) {
    EXPECT_EQ(refusal(interval, "\"table\", points = [[0.795, 0], [0.8, 1], [0.8050005, 0]]"),
              "s.toml:33:65: uncertain.membership.points has the value 0.8050005 outside the interval; expected values "
              "inside [0.795, 0.805]");
    EXPECT_EQ(
        refusal(interval, "\"triangular\", apex = 0.8050005"),
        "s.toml:33:44: uncertain.membership.apex 0.8050005 leaves the support; expected values inside [0.795, 0.805]");
    EXPECT_EQ(
        refusal(interval, "\"trapezoidal\", core = [0.8050005, 0.8050005]"),
        "s.toml:33:45: uncertain.membership.core 0.8050005 leaves the support; expected values inside [0.795, 0.805]");
    EXPECT_EQ(refusal(interval, "\"triangular\", support = [0.795, 0.8050005]"),
              "s.toml:33:47: uncertain.membership.support [0.795, 0.8050005] leaves the interval; expected a support "
              "inside [0.795, 0.805]");
    EXPECT_EQ(refusal(interval, "\"table\", points = [[0.795, 0.6], [0.8, 0.5], [0.805, 0]]"),
              "s.toml:33:56: point 2, (0.8, 0.5), of uncertain.membership.points falls although the table has not "
              "reached 1; expected memberships from 0 to 1 that rise to 1, stay, and fall");
    EXPECT_EQ(refusal(interval, "\"table\", points = [[0.795, 0], [0.795, 0.3], [0.805, 0.8]]"),
              "s.toml:33:68: point 3, (0.805, 0.8), of uncertain.membership.points ends it although the table has not "
              "reached 1; expected memberships from 0 to 1 that rise to 1, stay, and fall");
  }
  EXPECT_EQ(refusal("[0.795, 0.8049999]", "\"triangular\", apex = 0.80499995"),
            "s.toml:33:44: uncertain.membership.apex 0.80499995 leaves the support; expected values inside "
            "[0.795, 0.8049999]");
  EXPECT_EQ(refusal("[0.795, 0.805]", "\"triangular\", apex = 0.80500000000000016"),
            "s.toml:33:44: uncertain.membership.apex 0.80500000000000016 leaves the support; expected values inside "
            "[0.795, 0.805]");
}

/// `count` times.
std::string repeated(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

TEST(StudyReader, RefusesKeysOfManyPartsBeforeTheyExhaustTheStack) {
  const std::string expected = ": a key of more than 16 parts; expected a key of the study file";
  EXPECT_EQ(messageOf("# a.b\n" + repeated("a.", 40000) + "a = 1\n"), "s.toml:2:32" + expected);
  EXPECT_EQ(messageOf("[" + repeated("a . ", 40000) + "a]\n"), "s.toml:1:64" + expected);
  EXPECT_EQ(messageOf(repeated("\"a\".", 40000) + "a = 1\n"), "s.toml:1:64" + expected);
  EXPECT_EQ(messageOf("[study]\nx = { " + repeated("a.", 17) + "a = 1 }\n"), "s.toml:2:38" + expected);
  EXPECT_THAT(messageOf("x = " + repeated("{ a.a.a.a.a.a.a.a = ", 40000)), HasSubstr("not valid TOML"));
  EXPECT_THAT(messageOf(repeated("{ a.a.a.a.a.a.a.a = ", 40000)), HasSubstr("not valid JSON"));
  EXPECT_THAT(messageOf(repeated("{ \"a\": ", 100000)), HasSubstr("s.toml:1:"));
  EXPECT_THAT(messageOf("x = " + repeated("[", 100000)), HasSubstr("not valid TOML"));
}

TEST(StudyReader, TakesDotsThatAreNoKeys) {
  const std::string dots = repeated(".", 100);
  for (const std::string& title :
       {"\"" + dots + "\"", "'" + dots + "'", "\"\\\"" + dots + "\"", "\"\"\"" + dots + "\"\"\"", "\"x\" # " + dots})
    EXPECT_EQ(messageOf(sampleStudyWith("\"Pendulum\"", title)), "it was read") << title;
}

TEST(StudyReader, NotesALengthThatMayVanishUnlessItIsAnOffset) {
  const auto notes = [](const std::string& vector, const std::string& component, const std::string& interval) {
    std::string text = sampleStudyWith("[0, 0, \"-rod.length\"]", vector);
    const std::string old = "quantity = \"hinge.angle\"\ninterval = \"± 1 %\"";
    text.replace(text.find(old), old.size(), "quantity = \"rod.vector." + component + "\"\ninterval = " + interval);
    text.replace(text.find("dynamics"), 8, "kinematics");
    text.erase(text.find("horizon"), text.find("compare") - text.find("horizon"));
    return readStudyText(text, "s.toml").notes;
  };
  EXPECT_THAT(notes("[0, 0, -0.5]", "z", "[-0.6, 0.1]"),
              ElementsAre(::testing::HasSubstr("note: the interval holds a value with which the link 'rod' has no")));
  EXPECT_THAT(notes("[0, 0, -0.5]", "z", "[-0.6, -0.1]"), ElementsAre());
  EXPECT_THAT(notes("[0, 0, -0.5]", "y", "[-0.1, 0.1]"), ElementsAre());
  EXPECT_THAT(notes("[0, 0, 0]", "z", "[-0.1, 0.1]"), ElementsAre());
}

TEST(StudyReader, ReadsLimitsWithUnits) {
  const Study study = readStudyText(sampleStudyWith("[[uncertain]]",
                                                    "[limits]\ntime = \"2 h\"\nmemory = \"500 MiB\"\n"
                                                    "enclosure_memory = \"0.25 GB\"\nsample_time = 5\n[[uncertain]]"),
                                    "s.toml");
  EXPECT_EQ(study.limits.time, 7200);
  EXPECT_EQ(study.limits.memory, 500.0 * 1024 * 1024);
  EXPECT_EQ(study.limits.enclosureMemory, 0.25e9);
  EXPECT_EQ(study.limits.sampleTime, 5);
}

TEST(StudyReader, SaysWhyAFileCannotBeRead) {
  const TemporaryFolder folder;
  const auto complaint = [](const std::string& path) -> std::string {
    try {
      readStudy(path);
    } catch (const StudyError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(complaint(folder.path("")), folder.path("") + ": is a directory; expected a study file (TOML)");
  EXPECT_EQ(complaint(folder.path("no.toml")),
            folder.path("no.toml") + ": does not exist; expected a study file (TOML)");
  EXPECT_EQ(complaint("/dev/null"), "/dev/null: is no regular file; expected a study file (TOML)");
  folder.write("binary", std::string("\x7f\0ELF", 5));
  EXPECT_EQ(complaint(folder.path("binary")), folder.path("binary") + ": is no text; expected a study file (TOML)");
}

TEST(MechanismReader, ReadsTheMechanismOfAStudyThatIsOnlyBegun) {
  const std::string begun = sampleStudy.substr(0, sampleStudy.find("[[uncertain]]"));
  EXPECT_THROW(readStudyText(begun, "s.toml"), StudyError);
  const Mechanism mechanism = readMechanismText(begun, "s.toml");
  EXPECT_EQ(mechanism.quantities(), readStudyText(sampleStudy, "s.toml").mechanism.quantities());
}

TEST(MechanismReader, SaysWhereAMechanismIsWrongOrMissing) {
  const auto refused = [](const std::string& text) {
    try {
      readMechanismText(text, "s.toml");
    } catch (const StudyError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused("[study]\n"), "s.toml:1:1: 'mechanism' is missing; expected a table [mechanism]");
  EXPECT_EQ(refused("mechanism = 3\n").substr(0, 12), "s.toml:1:13:");
  EXPECT_EQ(refused(sampleStudyWith("axis = \"x\"", "axis = \"w\"")).substr(0, 11), "s.toml:14:8");
  EXPECT_EQ(refused(std::string("[mechanism]\n\0", 13)), "s.toml: is no text; expected a study file (TOML)");
}

TEST(StudyReader, NotesAnInertiaThatIsImpossibleForSomeValuesOnly) {
  const auto notes = [](const std::string& inertia, const std::string& quantity) {
    const std::string uncertain = "\n[[uncertain]]\nquantity = \"" + quantity + "\"\ninterval = \"± 1 %\"\n";
    return readStudyText(
               sampleStudyWith("mass = \"250 g\"", "mass = 1\nparameters = { i = 0.1 }\ninertia = " + inertia) +
                   uncertain,
               "s.toml")
        .notes;
  };
  EXPECT_THAT(notes("[0.1, 0.2, 0.3]", "bob.inertia.zz"),
              ElementsAre("s.toml:48:12: note: for some values in the intervals the inertia of 'bob' has a principal "
                          "moment above the sum of the other two"));
  EXPECT_THAT(notes("[0.1, 0.2, 0.25]", "bob.inertia.zz"), ElementsAre());
  // A thin rod's stays possible, although 0.1 ± 1 % - 0.1 ± 1 % as intervals would not tell.
  EXPECT_THAT(notes("[\"bob.i\", \"bob.i\", 0]", "bob.i"), ElementsAre());
  EXPECT_THAT(notes("[\"bob.i\", 0.1, 0]", "bob.i"), ::testing::SizeIs(1));
}

/// A text of one line with "\\n", "\\\\" and "\\x1b" for what a line cannot hold.
std::string unescaped(const std::string& line) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\') {
      text += line[i];
    } else if (line[++i] == 'x') {
      text += static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      text += line[i] == 'n' ? '\n' : '\\';
    }
  }
  return text;
}

/// One study for every kind of complaint that the fuzzer came to, the shortest it found.
TEST(StudyReader, RefusesInOneLineWhatFuzzingMade) {
  std::ifstream file(GAMUT_SOURCE_DIR "/tests/studies/corpus/fuzzed.txt");
  std::set<std::string> messages;
  for (std::string line; std::getline(file, line);) {
    const std::string message = messageOf(unescaped(line));
    EXPECT_TRUE(message == "it was read" || message.find("; expected ") != message.npos) << line << '\n' << message;
    EXPECT_FALSE(hasControlCharacters(message)) << line;
    messages.insert(message);
  }
  EXPECT_GT(messages.size(), 70U);
}

/// Two quantities of the sample study, and how they depend on each other.
std::string dependentStudy(const std::string& dependence) {
  return sampleStudyWith("[[output]]", R"([[uncertain]]
quantity = "rod.length"
interval = "± 1 mm"
[[uncertain]]
quantity = "bob.mass"
interval = "± 1 g"
[[dependence]]
)" + dependence + "\n[[output]]");
}

TEST(StudyReader, KnowsDependences) {
  const Study one =
      readStudyText(dependentStudy("quantities = [\"start\", \"rod.length\"]\nrank_correlation = 0.5"), "s.toml");
  ASSERT_EQ(one.dependence.copulas.size(), 1U);
  EXPECT_THAT(one.dependence.copulas[0].quantities(), ElementsAre(0U, 1U));
  // r = 2 sin(π/12)
  EXPECT_TRUE(contains(one.dependence.copulas[0].root()[1][0], 0.51763809020504152));
  EXPECT_LT(width(one.dependence.copulas[0].root()[1][0]), 1e-14);
  const Study unknown =
      readStudyText(dependentStudy("quantities = [\"rod.length\", \"bob.mass\"]\nunknown = true"), "s.toml");
  EXPECT_THAT(unknown.dependence.unknown, ElementsAre(ElementsAre(1U, 2U)));
  EXPECT_EQ(messageOf(dependentStudy("quantities = [\"start\", \"rod.length\"]")),
            "s.toml:40:1: a dependence has either dependence.rank_correlation or dependence.unknown; expected "
            "rank_correlation = 0.5, a matrix [[1, 0.5], [0.5, 1]], or unknown = true");
  EXPECT_EQ(messageOf(dependentStudy("quantities = [\"start\", \"rod.length\"]\nrank_correlation = 1.5")),
            "s.toml:42:20: rank correlations lie between -1 and 1, unlike 1.5 (row 2, column 1); expected a symmetric "
            "positive definite matrix with ones in its diagonal");
  for (const char* whole : {"1", "-1"})
    EXPECT_EQ(
        messageOf(dependentStudy(std::string("quantities = [\"start\", \"rod.length\"]\nrank_correlation = ") + whole)),
        std::string("s.toml:42:20: with a dependence.rank_correlation of ") + whole +
            " two quantities are one and the same uncertain number; expected one uncertain quantity and a "
            "formula of it for the other, or a correlation such as 0.999");
  EXPECT_EQ(
      messageOf(dependentStudy("quantities = [\"start\", \"rod.length\", \"bob.mass\"]\nrank_correlation = "
                               "[[1, 0.9, 0.9], [0.9, 1, -0.9], [0.9, -0.9, 1]]")),
      "s.toml:42:20: the rank correlations, as those of normal numbers, are not positive definite: the first 3 "
      "quantities cannot be correlated so; expected a symmetric positive definite matrix with ones in its diagonal");
  EXPECT_EQ(
      messageOf(dependentStudy("quantities = [\"start\", \"rod.length\", \"bob.mass\"]\nrank_correlation = 0.5")),
      "s.toml:42:20: one dependence.rank_correlation is given for 3 quantities; expected a matrix [[1, 0.5, ...], "
      "...]");
}

struct BadStudy {
  const char* old;
  const char* replacement;
  const char* message;
};

class BadStudyFile : public ::testing::TestWithParam<BadStudy> {};

TEST_P(BadStudyFile, IsRefusedInOneLineWithItsPlace) {
  const std::string message = messageOf(sampleStudyWith(GetParam().old, GetParam().replacement));
  EXPECT_EQ(message, GetParam().message);
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  EXPECT_THAT(message, HasSubstr("; expected "));
}

constexpr BadStudy badStudies[] = {
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"spherical\"\nname = \"ball\"\nfrom = \"tip\"\nto = \"B\"\n"
     "[[mechanism.element]]\ntype = \"mass\"\nname = \"body\"\nat = \"B\"\nmass = 1\ninertia = [1, 1, 1]\n"
     "[[uncertain]]\nquantity = \"ball.orientation.roll\"\ninterval = [-0.1, 0.1]\nvaries = \"freely\"\n[[uncertain]]",
     "s.toml:28:1: the initial value 'ball.quaternion.w' follows from 'ball.orientation.roll', which varies in time; "
     "expected an initial value that follows from what does not"},
    {"parameters = { length = 0.5 }", "parameters = { length = 0.5 }\nrotation = \"30 deg\"",
     "s.toml:23:12: mechanism.element.rotation is no rotation; expected [{ axis, angle }, …], { axis, angle }, { roll, "
     "pitch, yaw } or { quaternion = [w, x, y, z] }"},
    {"parameters = { length = 0.5 }",
     "parameters = { length = 0.5 }\nrotation = { roll = 1, quaternion = [1, 0, 0, 0] }",
     "s.toml:23:21: 'roll' beside a quaternion; expected one of the two"},
    {"parameters = { length = 0.5 }", "parameters = { length = 0.5 }\nrotation = { quaternion = [0, 0, 0, 0] }",
     "s.toml:16:1: the quaternion of 'rod' is zero, which is no orientation; expected four numbers of which "
     "one is not zero"},
    {"parameters = { length = 0.5 }", "parameters = { length = 0.5 }\nrotation = { quaternion = [1, 0, 0] }",
     "s.toml:23:27: mechanism.element.rotation.quaternion has 3 numbers; expected [w, x, y, z]"},
    {"quantity = \"tip.position.z\"", "quantity = \"sqrt(-1)\"",
     "s.toml:38:12: 'sqrt(-1)' has no value: square root of a constant that may be negative; expected a "
     "formula "
     "that has a value"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"prismatic\"\nname = \"slide\"\nfrom = \"tip\"\nto = \"K2\"\naxis = \"y\"\n"
     "[[mechanism.element]]\ntype = \"drive\"\nname = \"d\"\njoint = \"slide\"\nposition = "
     "\"hinge.angle*1 m\"\n[[uncertain]]",
     "s.toml:38:12: 'd.position': 'hinge.angle' changes in motion; expected a formula of time and parameters alone"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"force\"\nname = \"f\"\nat = \"tip\"\nforce = [0, \"2 N + 3 m\", "
     "0]\n[[uncertain]]",
     "s.toml:32:13: 'f.force.y': adds m to N at column 5; expected quantities of one kind"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"force\"\nname = \"f\"\nat = \"tip\"\nforce = [0, 0, \"2 N + t*3 "
     "m\"]\n[[uncertain]]",
     "s.toml:32:16: 'f.force.z': adds m s to N at column 5; expected quantities of one kind"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"f\"\njoint = \"hinge\"\nforce = \"-3 "
     "N*hinge.angle\"\n[[uncertain]]",
     "s.toml:32:9: 'f.force': a quantity in N rad; expected one in N m"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"f\"\njoint = \"hinge\"\nforce = "
     "\"hinge.rate\"\n[[uncertain]]",
     "s.toml:32:9: the quantity 'hinge.rate' is in rad/s, but 'f.force' is in N m; expected a quantity in N m"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"state\"\nname = \"z\"\ninitial = \"1 m\"\nrate = \"-1.1 1/s*z\"\n[[uncertain]]",
     "s.toml:32:8: mechanism.element.rate: unexpected '1' at column 6; expected an operator or the end (5/s, not 5 "
     "1/s)"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"distance\"\nname = \"d\"\nfrom = \"inertial\"\nto = \"K1\"\n[[uncertain]]",
     "s.toml:28:1: the distance 'd' has no length at the start; expected points that lie apart"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"spring-damper\"\nname = \"d\"\nfrom = \"inertial\"\nto = \"K1\"\nstiffness = \"3 "
     "N/m\"\n[[uncertain]]",
     "s.toml:28:1: the spring-damper 'd' has no length at the start; expected points that lie apart"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"universal\"\nname = \"u\"\nfrom = \"tip\"\nto = \"K2\"\naxis = [1, 1, "
     "0]\nsecond_axis = [-2, -2, 0]\n[[uncertain]]",
     "s.toml:34:15: the axes of 'u' are parallel; expected two axes that differ in direction"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"universal\"\nname = \"u\"\nfrom = \"tip\"\nto = "
     "\"K2\"\n[[mechanism.element]]\ntype = \"mass\"\nname = \"end\"\nat = \"K2\"\nmass = "
     "1\n[[mechanism.element]]\ntype = \"joint-spring\"\nname = \"s\"\njoint = \"u\"\nstiffness = 1\n[[uncertain]]",
     "s.toml:41:9: unknown joint with one coordinate 'u'; expected one of: u.angle1, u.angle2 (for 's')"},
    {"mass = \"250 g\"", "mass = \"1 kg*t/(1 s)\"",
     "s.toml:27:8: 'bob.mass': 't' changes in motion; expected a formula of parameters alone"},
    {"mass = \"250 g\"", "mass = \"1 kg*hinge.angle\"",
     "s.toml:27:8: 'bob.mass': 'hinge.angle' changes in motion; expected a formula of parameters alone"},
    {"parameters = { length = 0.5 }", "parameters = { length = \"2 rod.half\", half = \"rod.length/2\" }",
     "s.toml:22:25: 'rod.length' follows from 'rod.half', which follows from it, or from others that do; expected "
     "formulas of which none leads back to itself"},
    {"[stochastic]", "[limits]\ntime = 0\n[stochastic]",
     "s.toml:40:8: limits.time is not positive; expected a number above 0"},
    {"[stochastic]", "[limits]\nmemory = \"8 kg\"\n[stochastic]",
     "s.toml:40:10: limits.memory is written in a unit of the kind kg; expected a number in GB, or with a unit of that "
     "kind"},
    {"mass = \"250 g\"", "mass = -1", "s.toml:27:8: the mass of 'bob' is negative; expected a mass of at least 0 kg"},
    {"[stochastic]", "[stochastic]\nstorage = 2",
     "s.toml:40:11: stochastic.storage is not between 0 and 1 GB; expected a size such as \"64 MB\""},
    {"[stochastic]", "[stochastic]\nstorage = -1",
     "s.toml:40:11: stochastic.storage is not between 0 and 1 GB; expected a size such as \"64 MB\""},
    {"parameters = { length = 0.5 }\n[[mechanism.element]]\ntype = \"mass\"\nname = \"bob\"\nat = \"tip\"\nmass = "
     "\"250 g\"",
     "parameters = { length = 0.5, weight = \"250 g\" }\n[[mechanism.element]]\ntype = \"mass\"\nname = \"bob\"\n"
     "at = \"tip\"\nmass = \"-rod.weight\"",
     "s.toml:27:8: the mass of 'bob' is negative; expected a mass of at least 0 kg"},
    {"quantity = \"hinge.angle\"\ninterval = \"± 1 %\"", "quantity = \"bob.mass\"\ninterval = \"± 101 %\"",
     "s.toml:31:12: uncertain.interval reaches down to a negative mass; expected a lower bound of at least 0 kg"},
    {"± 1 %", "± 1 %%", "s.toml:31:12: uncertain.interval: there is more than one '%' at column 5; expected one '%'"},
    {"horizon = 0.5", "horizon = ",
     "s.toml:4:11: not valid TOML: Error while parsing key-value pair: expected value, saw '\\n'; expected a file that "
     "follows https://toml.io, texts and numbers with units in quotes"},
    {"horizon = 0.5", "horizon = 0.5\nhorizon = 1",
     "s.toml:5:11: not valid TOML: Error while parsing key-value pair: cannot redefine existing floating-point "
     "'horizon'; expected a file that follows https://toml.io, texts and numbers with units in quotes"},
    {"title = ", "titel = ",
     "s.toml:2:1: unknown key 'titel' in [study]; expected 'title'? (one of: title, analysis, horizon, output_step, "
     "output_times, compare)"},
    {"[uncertain]]\nname", "[uncertan]]\nname",
     "s.toml:28:3: unknown key 'uncertan'; expected 'uncertain'? (one of: study, mechanism, uncertain, dependence, "
     "output, "
     "requirement, sweep, interval, stochastic, distribution, sensitivity, equilibria, modes, postures, witness, "
     "workspace, fuzzy, "
     "limits)"},
    {"\"hinge.angle\"\ninterval", "\"hinges.*\"\ninterval",
     "s.toml:30:12: no quantity fits 'hinges.*'; expected a pattern that `gamut quantities` shows a quantity of"},
    {"\"hinge.angle\"\ninterval", "[\"hinge.angle\", \"hinge.rate\"]\ninterval",
     "s.toml:29:8: one name is given to 2 quantities; expected no name: each has that of its quantity"},
    {"interval = \"± 1 %\"\ndistribution = { type = \"uniform\" }",
     "distribution = { type = \"uniform\", support = [0.6, 0.7] }",
     "s.toml:28:1: the support of 'hinge.angle' does not hold the nominal value 0.523599 rad; expected an interval "
     "around "
     "the "
     "nominal value"},
    {"title = \"Pendulum\"", "title = 3", "s.toml:2:9: study.title is the number 3; expected text in quotes"},
    {"title = \"Pendulum\"", "title = \"  \"", "s.toml:2:9: study.title is empty; expected text"},
    {"analysis = \"dynamics\"", "analysis = \"dynamic\"",
     "s.toml:3:12: study.analysis is \"dynamic\"; expected 'dynamics'? (one of: dynamics, inverse-dynamics, "
     "kinematics, equilibria)"},
    {"analysis = \"dynamics\"", "",
     "s.toml:1:1: 'study.analysis' is missing; expected \"dynamics\", \"inverse-dynamics\", \"kinematics\" or "
     "\"equilibria\""},
    {"analysis = \"dynamics\"", "analysis = \"kinematics\"",
     "s.toml:4:11: study.horizon has no meaning where no time passes; expected no such key"},
    {"horizon = 0.5", "", "s.toml:1:1: 'study.horizon' is missing; expected the time to be reached, in s"},
    {"horizon = 0.5", "horizon = -1", "s.toml:4:11: study.horizon is not positive; expected a time above 0 s"},
    {"horizon = 0.5", "horizon = \"1 m\"",
     "s.toml:4:11: study.horizon is written in a unit of the kind m; expected a number in s, or with a unit of that "
     "kind"},
    {"horizon = 0.5", "horizon = inf", "s.toml:4:11: study.horizon is not finite; expected a finite number"},
    {"horizon = 0.5", "horizon = nan", "s.toml:4:11: study.horizon is not finite; expected a finite number"},
    {"horizon = 0.5", "horizon = true",
     "s.toml:4:11: study.horizon is true; expected a number, or text with a unit such as \"135 deg\""},
    {"horizon = 0.5", "horizon = 1979-05-27",
     "s.toml:4:11: study.horizon is a date or time; expected a number, or text with a unit such as \"135 deg\""},
    {"output_step = 0.1", "output_step = 0",
     "s.toml:5:15: study.output_step is not positive; expected a time above 0 s"},
    {"output_step = 0.1", "output_step = -0.1",
     "s.toml:5:15: study.output_step is not positive; expected a time above 0 s"},
    {"output_step = 0.1", "output_step = 1e-9",
     "s.toml:5:15: study.output_step gives more than 100000 output times; expected a longer step or a shorter horizon"},
    {"output_step = 0.1", "",
     "s.toml:1:1: 'study.output_step' is missing; expected output_step in s, or a list output_times"},
    {"output_step = 0.1", "output_times = []", "s.toml:5:16: study.output_times is empty; expected at least one time"},
    {"output_step = 0.1", "output_times = [0.2, 0.1]",
     "s.toml:5:22: the output time 0.1 s does not follow 0.2 s; expected times that rise from 0 s"},
    {"output_step = 0.1", "output_times = [0.2, 0.6]",
     "s.toml:5:22: the output time 0.6 s is beyond the horizon; expected at most 0.5 s"},
    {"output_step = 0.1", "output_times = [0.2]\noutput_step = 0.1",
     "s.toml:6:15: study.output_step and study.output_times are both given; expected one of them"},
    {"compare = [\"interval\", \"stochastic\", \"fuzzy\"]", "compare = []",
     "s.toml:6:11: study.compare is empty; expected \"interval\", \"stochastic\", \"fuzzy\" or some of them"},
    {"compare = [\"interval\", \"stochastic\", \"fuzzy\"]", "compare = [\"interval\", \"interval\"]",
     "s.toml:6:24: study.compare names \"interval\" twice; expected every analysis once"},
    {"compare = [\"interval\", \"stochastic\", \"fuzzy\"]", "compare = [\"intervall\"]",
     "s.toml:6:12: study.compare is \"intervall\"; expected 'interval'? (one of: interval, stochastic, fuzzy)"},
    {"compare = [\"interval\", \"stochastic\", \"fuzzy\"]", "compare = \"interval\"",
     "s.toml:6:11: study.compare is \"interval\"; expected a list [ … ]"},
    {"gravity = [0, 0, -9.81]", "gravity = [0, 0]",
     "s.toml:8:11: mechanism.gravity has 2 numbers; expected [x, y, z] in m/s^2"},
    {"gravity = [0, 0, -9.81]", "gravity = [0, 0, \"9.81 m\"]",
     "s.toml:8:18: mechanism.gravity is written in a unit of the kind m; expected a number in m/s^2, or with a unit of "
     "that kind"},
    {"type = \"revolute\"", "type = \"revolut\"",
     "s.toml:10:8: mechanism.element.type is \"revolut\"; expected 'revolute'? (one of: revolute, prismatic, screw, "
     "cylindrical, universal, planar, spherical, skate, rolling-wheel, rolling-ball, free, weld, play, guide-play, "
     "link, closure, rod, mass, spring-damper, joint-spring, bushing, joint-friction, smoothed-joint-friction, "
     "joint-stop, "
     "rigid-stop, plane-contact, "
     "motor, force, joint-force, drive, table-drive, coupling, state, distance, relative-motion, "
     "sphere, capsule, box, hull, separation)"},
    {"type = \"revolute\"", "",
     "s.toml:9:1: 'mechanism.element.type' is missing; expected type = one of: revolute, prismatic, screw, "
     "cylindrical, universal, planar, spherical, skate, rolling-wheel, rolling-ball, free, weld, play, guide-play, "
     "link, closure, rod, mass, spring-damper, joint-spring, bushing, joint-friction, smoothed-joint-friction, "
     "joint-stop, "
     "rigid-stop, plane-contact, "
     "motor, force, joint-force, drive, table-drive, coupling, state, distance, relative-motion, "
     "sphere, capsule, box, hull, separation"},
    {"axis = \"x\"", "axis = \"w\"",
     "s.toml:14:8: mechanism.element.axis is \"w\"; expected 'x'? (one of: x, y, z, -x, -y, -z)"},
    {"axis = \"x\"", "axis = [0, 0, 0]",
     "s.toml:14:8: mechanism.element.axis is the zero vector; expected a direction"},
    {"axis = \"x\"", "axis = [1, 0]",
     "s.toml:14:8: mechanism.element.axis has 2 numbers; expected three numbers [x, y, z]"},
    {"axis = \"x\"\n", "",
     "s.toml:9:1: 'mechanism.element.axis' is missing; expected \"x\", \"y\", \"z\", the same with a minus sign, or "
     "[x, y, z]"},
    {"from = \"inertial\"", "from = \"inertal\"",
     "s.toml:12:8: unknown frame 'inertal'; expected 'inertial' ('hinge' must come after the element that defines its "
     "frame)"},
    {"from = \"inertial\"", "from = \"elsewhere\"",
     "s.toml:12:8: unknown frame 'elsewhere'; expected 'inertial' ('hinge' must come after the element that "
     "defines its frame)"},
    {"to = \"tip\"", "to = \"K1\"",
     "s.toml:16:1: the frame 'K1' is defined twice; expected a new frame for 'rod' (frames form a tree, and a "
     "`closure` or a `rod` closes loops between two)"},
    {"angle = \"30 deg\"", "angle = \"30 grad\"",
     "s.toml:15:21: mechanism.element.initial.angle: unknown unit 'grad' in '30 grad'; "
     "expected one of rad, deg, °, rpm, m, in, ft, kg, g, t, lb, s, min, h, Hz, N, lbf, J, W, Pa, bar, V, A, Ohm, Ω, "
     "H, "
     "F, C, Wb, T, K, GB, MB, GiB, MiB, %, or a part or multiple such as mm, kN, mA"},
    {"angle = \"30 deg\"", "angle = \"30 mm\"",
     "s.toml:15:21: mechanism.element.initial.angle is written in a unit of the kind m; expected a number in rad, or "
     "with a unit of that kind"},
    {"angle = \"30 deg\"", "angel = \"30 deg\"",
     "s.toml:15:13: unknown key 'angel' in [mechanism.element.initial]; expected 'angle'? (one of: angle, rate)"},
    {"angle = \"30 deg\"", "angle = \"10 %\"",
     "s.toml:15:21: mechanism.element.initial.angle is written in percent; expected a number in rad, or with a unit of "
     "that kind"},
    {"quantity = \"hinge.angle\"\ninterval", "quantity = \"bob.centre.x\"\ninterval",
     "s.toml:31:12: uncertain.interval is a share of the nominal value, which is 0; expected an absolute deviation, "
     "such as \"± 0.01 m\""},
    {"\"-rod.length\"", "\"2 Nm\"",
     "s.toml:21:17: mechanism.element.vector: unknown unit 'Nm' in '2 Nm'; expected 'N m', with a blank between units"},
    {"length = 0.5", "length = \"0.5 kg\"",
     "s.toml:22:25: the parameter 'rod.length' is in kg, but 'rod.vector.z' is in m; expected a parameter in m"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"joint-spring\"\nname = \"sp\"\njoint = \"hing\"\nstiffness = \"1 N "
     "m/rad\"\nrest = \"1 mm\"\n[[uncertain]]",
     "s.toml:31:9: unknown joint 'hing'; expected 'hinge' (for 'sp')"},
    {"\"-rod.length\"", "\"-rod.lenght\"",
     "s.toml:21:17: unknown parameter 'rod.lenght'; expected 'rod.length' (for 'rod.vector.z')"},
    {"\"-rod.length\"", "\"1/2 beam.length\"",
     "s.toml:21:17: unknown parameter 'beam.length'; expected 'rod.length' (for 'rod.vector.z')"},
    {"\"-rod.length\"", "\"-2 m rod.length\"",
     "s.toml:21:17: mechanism.element.vector: no operator before 'rod.length' at column 6; expected *, /, + or -, or "
     "single quotes about a name with blanks"},
    {"mass = \"250 g\"", "mass = \"250 x\"",
     "s.toml:27:8: mechanism.element.mass: unknown unit 'x' in '250 x'; expected "
     "one of rad, deg, °, rpm, m, in, ft, kg, g, t, lb, s, min, h, Hz, N, lbf, J, W, Pa, bar, V, A, Ohm, Ω, H, "
     "F, C, Wb, T, K, GB, MB, GiB, MiB, %, or a part or multiple such as mm, kN, mA"},
    {"mass = \"250 g\"", "mass = [1]",
     "s.toml:27:8: mechanism.element.mass is a list; expected a number, or text with a unit such as \"135 deg\""},
    {"mass = \"250 g\"", "",
     "s.toml:23:1: 'mechanism.element.mass' is missing; expected mass in kg: the mass, not negative"},
    {"mass = \"250 g\"", "mass = 1\ninertia = [1, 2]",
     "s.toml:28:11: mechanism.element.inertia has 2 numbers; expected [xx, yy, zz] or [xx, yy, zz, xy, yz, zx] in kg "
     "m^2"},
    {"mass = \"250 g\"", "mass = 1\ninertia = [-1, 1, 1]",
     "s.toml:28:11: the inertia of 'bob' has a negative principal moment; expected an inertia that a body can have, "
     "each "
     "moment no greater than the other two together"},
    {"mass = \"250 g\"", "mass = 1\ninertia = [1, 1, 1, 0, 2, 0]",
     "s.toml:28:11: the inertia of 'bob' has a negative principal moment; expected an inertia that a body can have, "
     "each "
     "moment no greater than the other two together"},
    {"mass = \"250 g\"", "mass = 1\ninertia = [1, 1, 2.1]",
     "s.toml:28:11: the inertia of 'bob' has a principal moment above the sum of the other two; expected an inertia "
     "that a body can have, each moment no greater than the other two together"},
    {"title = \"Pendulum\"", "title = \"a\\u001b[31mb\"",
     "s.toml:2:9: study.title is \"a\\u001b[31mb\"; expected text without control characters"},
    {"name = \"bob\"", "name = \"b\\u009bob\"",
     "s.toml:25:8: mechanism.element.name is \"b\\u009bob\"; expected text without control characters"},
    {"title = ", "\"\\u0007\" = ",
     "s.toml:2:1: unknown key '\\u0007' in [study]; expected one of: title, analysis, horizon, output_step, "
     "output_times, "
     "compare"},
    {"at = \"tip\"", "at = \"K2\"",
     "s.toml:26:6: unknown frame 'K2'; expected 'K1' ('bob' must come after the element that defines its frame)"},
    {"at = \"tip\"", "at = \"inertial\"",
     "s.toml:9:1: the joint 'hinge' moves no mass; expected a mass at the frame 'K1' or at one that it carries"},
    {"name = \"bob\"", "name = \"rod\"", "s.toml:23:1: two elements are named 'rod'; expected a name of its own"},
    {"quantity = \"hinge.angle\"\ninterval", "quantity = \"hinge.angel\"\ninterval",
     "s.toml:30:12: unknown quantity 'hinge.angel'; expected a quantity of the mechanism, such as 'hinge.angle'"},
    {"quantity = \"hinge.angle\"\ninterval", "quantity = \"tip.position.z\"\ninterval",
     "s.toml:30:12: unknown quantity 'tip.position.z'; expected a quantity of the mechanism, one of: hinge.angle, "
     "hinge.rate, gravity.x, gravity.y, gravity.z, rod.length, rod.vector.x, rod.vector.y, bob.mass, bob.centre.x, "
     "bob.centre.y, bob.centre.z and 6 more"},
    {"quantity = \"hinge.angle\"\ninterval", "quantity = \"length\"\ninterval",
     "s.toml:30:12: unknown quantity 'length'; expected a quantity of the mechanism, such as 'rod.length'"},
    {"interval = \"± 1 %\"", "interval = \"1 %\"",
     "s.toml:31:12: uncertain.interval is \"1 %\"; expected \"± 1 %\", \"± 2 deg\", \"+2 / -1 mm\" or [lower, upper]"},
    {"interval = \"± 1 %\"", "interval = \"± 1 mm\"",
     "s.toml:31:12: uncertain.interval is written in a unit of the kind m; expected a number in rad, or with a unit of "
     "that kind"},
    {"interval = \"± 1 %\"", "interval = \"± -1 %\"",
     "s.toml:31:12: uncertain.interval has no positive deviation; expected a deviation above 0"},
    {"distribution = { type = \"uniform\" }\nmembership = { type = \"triangular\" }", "varies = \"freely\"",
     "s.toml:30:12: 'hinge.angle' is an initial value, which cannot vary in time; expected a parameter or a number of "
     "an "
     "element"},
    {"distribution = { type = \"uniform\" }\nmembership = { type = \"triangular\" }", "varies = \"wildly\"",
     "s.toml:32:10: uncertain.varies is \"wildly\"; expected one of: freely"},
    {"quantity = \"hinge.angle\"\ninterval = \"± 1 %\"",
     "quantity = \"rod.length\"\ninterval = \"± 1 %\"\nvaries = \"freely\"",
     "s.toml:33:16: what varies in time has no uncertain.distribution; expected an interval alone"},
    {"quantity = \"hinge.angle\"\ninterval = \"± 1 %\"\ndistribution = { type = \"uniform\" }",
     "quantity = \"rod.length\"\ninterval = \"± 1 %\"\nrate = \"1 m/s\"",
     "s.toml:33:14: what varies in time has no uncertain.membership; expected an interval alone"},
    {"quantity = \"hinge.angle\"\ninterval = \"± 1 %\"\ndistribution = { type = \"uniform\" }\nmembership = { type = "
     "\"triangular\" }",
     "quantity = \"rod.length\"\ninterval = \"± 1 %\"\nrate = \"1 m\"",
     "s.toml:32:8: uncertain.rate is written in a unit of the kind m; expected a number in m/s, or with a unit of that "
     "kind"},
    {"quantity = \"hinge.angle\"\ninterval = \"± 1 %\"\ndistribution = { type = \"uniform\" }\nmembership = { type = "
     "\"triangular\" }",
     "quantity = \"rod.length\"\ninterval = \"± 1 %\"\nrate = 0",
     "s.toml:32:8: uncertain.rate is not positive; expected the most it changes by in a second"},
    {"quantity = \"hinge.angle\"\ninterval = \"± 1 %\"\ndistribution = { type = \"uniform\" }\nmembership = { type = "
     "\"triangular\" }",
     "quantity = \"rod.length\"\ninterval = \"± 1 %\"\nrate = 1\nvaries = \"freely\"",
     "s.toml:32:8: what varies freely has no uncertain.rate; expected one of the two"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"force\"\nname = \"wind\"\nat = \"tip\"\nforce = [0, \"1 N\", 0]\n[[uncertain]]\n"
     "quantity = \"wind.force.y\"\ninterval = \"± 1 N\"\nrate = \"± 2 N\"\n[[uncertain]]",
     "s.toml:36:8: uncertain.rate is written in a unit of the kind N; expected a number in N/s, or with a unit of that "
     "kind"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"force\"\nname = \"gust\"\nat = \"tip\"\nparameters = { wind = \"1 N\" }\n"
     "force = [0, \"gust.wind/0\", 0]\n[[uncertain]]\nquantity = \"gust.wind\"\ninterval = \"± 1 N\"\n[[uncertain]]",
     "s.toml:33:13: 'gust.force.y' has no value: division by a constant that may be zero; expected a formula "
     "that has a value"},
    {"[[uncertain]]",
     "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"motor\"\njoint = \"hinge\"\nparameters = { none = \"1 "
     "rad - 1 rad\", gain = \"3 N m\" }\nforce = \"motor.gain*hinge.angle/motor.none\"\n[[uncertain]]",
     "s.toml:33:9: 'motor.force' has no value: division by a constant that may be zero; expected a formula "
     "that has a value"},
    {"\"-rod.length\"", "\"-rod.length/0\"",
     "s.toml:21:17: 'rod.vector.z' has no value: division by a constant that may be zero; expected a formula "
     "that has a value"},
    {"interval = \"± 1 %\"", "interval = \"± 0 %\"",
     "s.toml:31:12: uncertain.interval has no positive deviation; expected a deviation above 0"},
    {"interval = \"± 1 %\"", "interval = [0.6, 0.4]",
     "s.toml:31:12: uncertain.interval has its lower bound above its upper one; expected [lower, upper]"},
    {"interval = \"± 1 %\"", "interval = [0.6, 0.7]",
     "s.toml:31:12: uncertain.interval does not hold the nominal value 0.523599 rad; expected an interval around the "
     "nominal value"},
    {"interval = \"± 1 %\"", "interval = 0.5",
     "s.toml:31:12: uncertain.interval is neither text nor a list; expected \"± 1 %\", \"± 2 deg\", \"+2 / -1 mm\" or "
     "[lower, upper]"},
    {"interval = \"± 1 %\"", "tolerance = \"± 1 %\"",
     "s.toml:31:1: unknown key 'tolerance' in [uncertain]; expected 'interval'? (one of: quantity, name, interval, "
     "distribution, varies, rate, membership)"},
    {"interval = \"± 1 %\"", "interval = [0.4, 0.6, 0.7]",
     "s.toml:31:12: uncertain.interval has 3 numbers; expected two, [lower, upper]"},
    {"interval = \"± 1 %\"", "interval = \"+1 / +2 mm\"",
     "s.toml:31:12: uncertain.interval is \"+1 / +2 mm\"; expected \"± 1 %\", \"± 2 deg\", \"+2 / -1 mm\" or [lower, "
     "upper]"},
    {"interval = \"± 1 %\"", "interval = \"+0 / -0 deg\"",
     "s.toml:31:12: uncertain.interval has no positive deviation; expected a deviation above 0"},
    {"interval = \"± 1 %\"", "",
     "s.toml:28:1: 'uncertain.interval' is missing; expected \"± 1 %\", \"± 2 deg\", \"+2 / -1 mm\" or [lower, upper], "
     "or "
     "a distribution or membership with a support"},
    {"distribution = { type = \"uniform\" }", "distribution = { type = \"unifrom\" }",
     "s.toml:32:25: uncertain.distribution.type is \"unifrom\"; expected 'uniform'? (one of: uniform, triangular, "
     "normal, beta, lognormal, weibull, gamma, exponential, histogram, empirical, evidence, induced)"},
    {"distribution = { type = \"uniform\" }", "distribution = { }",
     "s.toml:32:16: 'uncertain.distribution.type' is missing; expected { type = \"uniform\" }"},
    {"distribution = { type = \"uniform\" }", "distribution = \"uniform\"",
     "s.toml:32:16: uncertain.distribution is \"uniform\"; expected a table, such as { type = \"uniform\" }"},
    {"distribution = { type = \"uniform\" }", "distribution = \"gauss\"",
     "s.toml:32:16: uncertain.distribution is \"gauss\"; expected a table, such as { type = \"normal\" }"},
    {"membership = { type = \"triangular\" }", "membership = \"triangle\"",
     "s.toml:33:14: uncertain.membership is \"triangle\"; expected a table, such as { type = \"triangular\" }"},
    {"distribution = { type = \"uniform\" }", "distribution = { type = \"uniform\", support = [0, 1] }",
     "s.toml:32:46: uncertain.distribution.support [0, 1] leaves the interval; expected a support inside [0.518363, "
     "0.528835]"},
    {"distribution = { type = \"uniform\" }", "distribution = { type = \"uniform\", mode = 1 }",
     "s.toml:32:36: unknown key 'mode' in [uncertain.distribution]; expected one of: type, support"},
    {"distribution = { type = \"uniform\" }", "distribution = { type = \"normal\" }",
     "s.toml:32:16: 'uncertain.distribution.deviation' is missing; expected a number in rad, or an interval of such "
     "numbers"},
    {"distribution = { type = \"uniform\" }", "distribution = { type = \"normal\", deviation = \"± 0.2 deg\" }",
     "s.toml:32:47: uncertain.distribution.deviation is the deviation \"± 0.2 deg\"; expected a value, such as "
     "\"0.2 deg\", or an interval of values [lower, upper]"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"gaussian\", deviation = \"+/-0.2 deg\" }",
     "s.toml:33:47: uncertain.membership.deviation is the deviation \"+/-0.2 deg\"; expected a value, such as "
     "\"0.2 deg\""},
    {"distribution = { type = \"uniform\" }", "distribution = { type = \"normal\", deviation = [2, 1] }",
     "s.toml:32:47: uncertain.distribution.deviation has its lower bound above its upper one; expected [lower, upper]"},
    {"distribution = { type = \"uniform\" }", "distribution = { type = \"normal\", deviation = [0, 1] }",
     "s.toml:32:47: the deviation of a normal distribution must be positive, not [0, 1]; expected a number above 0"},
    {"distribution = { type = \"uniform\" }", "distribution = { type = \"evidence\" }",
     "s.toml:32:16: 'uncertain.distribution.intervals' is missing; expected [[lower, upper], ...], or a file"},
    {"distribution = { type = \"uniform\" }",
     "distribution = { type = \"evidence\", intervals = [[\"29.9 deg\", \"30 deg\"]], masses = [1, 2] }",
     "s.toml:32:84: 2 masses stand beside 1 intervals; expected one mass an interval"},
    {"distribution = { type = \"uniform\" }",
     "distribution = { type = \"evidence\", intervals = [[0, 1]], masses = [1] }",
     "s.toml:32:50: uncertain.distribution.intervals: [0, 1] leaves the interval; expected intervals inside "
     "[0.518363, 0.528835]"},
    {"distribution = { type = \"uniform\" }",
     "distribution = { type = \"evidence\", intervals = [[\"29.9 deg\", \"30 deg\"]], masses = [0] }",
     "s.toml:32:16: evidence needs a positive mass; expected a distribution inside the interval"},
    {"membership = { type = \"triangular\" }",
     "membership = { type = \"induced\" }\n[[dependence]]\nquantities = [\"start\"]\nunknown = true",
     "s.toml:35:14: dependence.quantities names one quantity; expected two quantities at least"},
    {"membership = { type = \"triangular\" }",
     "membership = { type = \"triangular\" }\n[[dependence]]\nquantities = [\"start\", \"stat\"]\nunknown = true",
     "s.toml:35:24: no uncertain quantity is called 'stat'; expected 'start'"},
    {"membership = { type = \"triangular\" }",
     "membership = { type = \"triangular\" }\n[[dependence]]\nquantities = [\"start\", \"start\"]\nunknown = true",
     "s.toml:35:24: 'start' is in a dependence already; expected every quantity once"},
    {"distribution = { type = \"uniform\" }", "distribution = { type = \"normal\", deviation = -1 }",
     "s.toml:32:47: the deviation of a normal distribution must be positive, not -1; expected a number above 0"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"triangular\", apex = 3 }",
     "s.toml:33:44: uncertain.membership.apex 3 leaves the support; expected values inside [0.518363, 0.528835]"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"triangular\", support = [0.524, 0.525] }",
     "s.toml:33:14: uncertain.membership.apex, the nominal value 0.523598775598299 leaves the support; expected values "
     "inside [0.524, 0.525]"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"gaussian\", centre = 1, deviation = 1 }",
     "s.toml:33:44: uncertain.membership.centre 1 leaves the support; expected values inside [0.518363, 0.528835]"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"gaussian\", deviation = 0 }",
     "s.toml:33:47: uncertain.membership.deviation is not positive; expected a deviation above 0"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"trapezoidal\", core = [0.52, 0.6] }",
     "s.toml:33:45: uncertain.membership.core [0.52, 0.6] leaves the support; expected values inside [0.518363, "
     "0.528835]"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"trapezoidal\" }",
     "s.toml:33:14: 'uncertain.membership.core' is missing; expected [left, right]"},
    {"membership = { type = \"triangular\" }",
     "membership = { type = \"table\", points = [[0.52, 0], [0.521, 0.5], [0.522, 0.25], [0.523, 1]] }",
     "s.toml:33:67: point 3, (0.522, 0.25), of uncertain.membership.points falls although the table has not reached 1; "
     "expected "
     "memberships from 0 to 1 that rise to 1, stay, and fall"},
    {"membership = { type = \"triangular\" }",
     "membership = { type = \"table\", points = [\n  [0.52, 1],\n  [0.521, 0.5],\n  [0.523, 0.75]] }",
     "s.toml:36:3: point 3, (0.523, 0.75), of uncertain.membership.points rises again after the table has fallen; "
     "expected memberships from 0 to 1 that rise to 1, stay, and fall"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"table\", points = [[0.52, 0], [0.523, 0.9]] }",
     "s.toml:33:53: point 2, (0.523, 0.9), of uncertain.membership.points ends it although the table has not reached "
     "1; expected memberships from 0 to 1 that rise to 1, stay, and fall"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"table\", points = [[0.523, 0], [0.521, 1]] }",
     "s.toml:33:55: uncertain.membership.points has the value 0.521 after 0.523; expected values that do not fall"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"table\", points = [[0.523, 0], [0.524, 1.5]] }",
     "s.toml:33:62: uncertain.membership.points has the membership 1.5; expected a membership from 0 to 1"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"table\", points = [] }",
     "s.toml:33:41: uncertain.membership.points is empty; expected at least one point [value, membership]"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"table\", points = [[0.52, 0], [0.521]] }",
     "s.toml:33:53: uncertain.membership.points has a point that is no pair; expected [value, membership]"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"table\" }",
     "s.toml:33:14: 'uncertain.membership.points' is missing; expected [[value, membership], ...] with memberships "
     "from 0 "
     "to 1"},
    {"membership = { type = \"triangular\" }",
     "membership = { type = \"table\", support = [0.52, 0.525], points = [[0.523, 1]] }",
     "s.toml:33:32: unknown key 'support' in [uncertain.membership]; expected one of: type, points"},
    {"membership = { type = \"triangular\" }", "membership = { type = \"table\", points = [[0.523, 1], [0.6, 0]] }",
     "s.toml:33:55: uncertain.membership.points has the value 0.6 outside the interval; expected values inside "
     "[0.518363, 0.528835]"},
    {"name = \"angle\"", "name = \"tip.position.z\"",
     "s.toml:38:12: two outputs are named 'tip.position.z'; expected different names"},
    {"quantity = \"tip.position.z\"", "quantity = \"tip.position.w\"",
     "s.toml:38:12: unknown quantity 'tip.position.w'; expected a quantity of the mechanism, such as 'tip.position.x', "
     "'tip.position.y' or 'tip.position.z'"},
    {"quantity = \"tip.position.z\"", "name = \"tip\"",
     "s.toml:37:1: 'output.quantity' is missing; expected what is wanted, such as \"tip.position.z\" or \"energy\""},
    {"samples = 16", "samples = 0",
     "s.toml:40:11: stochastic.samples is 0; expected a whole number between 1 and 1000000000"},
    {"samples = 16", "samples = 1.5",
     "s.toml:40:11: stochastic.samples is the number 1.5 with point or exponent; expected a whole number between 1 and "
     "1000000000"},
    {"plan = \"sobol\"", "plan = \"sobel\"",
     "s.toml:41:8: stochastic.plan is \"sobel\"; expected 'sobol'? (one of: sobol, random, latin-hypercube, halton, "
     "grid)"},
    {"seed = 7", "seed = -1",
     "s.toml:42:8: stochastic.seed is -1; expected a whole number between 0 and 9223372036854775807"},
    {"seed = 7", "seed = 7\ntolerance = { relative = 0 }",
     "s.toml:43:26: stochastic.tolerance.relative is not positive; expected a number above 0"},
    {"seed = 7", "seed = 7\n[fuzzy]\nlevels = 1",
     "s.toml:44:10: fuzzy.levels is 1; expected a whole number between 2 and 101"},
    {"seed = 7", "seed = 7\n[fuzzy]\nmethod = \"generall\"",
     "s.toml:44:10: fuzzy.method is \"generall\"; expected 'general'? (one of: reduced, general, extended)"},
    {"seed = 7", "seed = 7\n[interval]\norder = \"best\"",
     "s.toml:44:9: interval.order is neither a whole number nor \"auto\"; expected \"auto\" or a whole number between "
     "4 and 30"},
    {"seed = 7", "seed = 7\n[interval]\norder = 99",
     "s.toml:44:9: interval.order is 99; expected a whole number between 4 and 30"},
    {"seed = 7", "seed = 7\n[interval]\nsplit = \"yes\"",
     "s.toml:44:9: interval.split is \"yes\"; expected true or false"},
    {"seed = 7", "seed = 7\n[interval]\ntightness = 1",
     "s.toml:44:13: interval.tightness is not above 1; expected the overestimation that is aimed at, such as 1.02"},
    {"seed = 7", "seed = 7\n[interval]\ntightness = 0",
     "s.toml:44:13: interval.tightness is not above 1; expected the overestimation that is aimed at, such as 1.02"},
    {"seed = 7", "seed = 7\n[interval]\ntightness = -1.5",
     "s.toml:44:13: interval.tightness is not above 1; expected the overestimation that is aimed at, such as 1.02"},
    {"seed = 7", "seed = 7\n[interval]\ntolerance = \"1 s\"",
     "s.toml:44:13: interval.tolerance is written in a unit of the kind s; expected a number without unit"},
    {"[stochastic]", "[limits]\ntime = 60\nenclosure_time = \"2 min\"\n[stochastic]",
     "s.toml:41:18: limits.enclosure_time is 120 s, more than limits.time, which is 60 s; expected at most 60 s, or a "
     "greater limits.time"},
    {"[stochastic]", "[limits]\nenclosure_time = \"1 h\"\n[stochastic]",
     "s.toml:40:18: limits.enclosure_time is 3600 s, more than limits.time, which is 1800 s unless given; expected at "
     "most 1800 s, or a greater limits.time"},
    {"[stochastic]", "[limits]\nenclosure_memory = 2\nmemory = \"500 MB\"\n[stochastic]",
     "s.toml:40:20: limits.enclosure_memory is 2 GB, more than limits.memory, which is 0.5 GB; expected at most 0.5 "
     "GB, "
     "or a greater limits.memory"},
    {"[stochastic]", "[[stochastic]]", "s.toml:39:1: stochastic is a list; expected a table"},
    {"[[output]]", "[output]",
     "s.toml:37:1: not valid TOML: Error while parsing table header: cannot redefine existing table 'output' as "
     "array-of-tables; expected double brackets, as in [[output]], of every such table, the first too"},
    {"\"tip.position.z\"\n", "\"tip.position.z\"\n[output]\n",
     "s.toml:39:1: not valid TOML: Error while parsing table header: cannot redefine existing array 'output' as table; "
     "expected double brackets, as in [[output]], of every such table"},
    {"horizon = 0.5", "horizon = 0,5",
     "s.toml:4:12: not valid TOML: Error while parsing key-value pair: expected a comment or whitespace, saw ','; "
     "expected a point before decimals, and commas in lists alone"},
    {"title = \"Pendulum\"", "title = \"Pendulum",
     "s.toml:2:18: not valid TOML: Error while parsing string: unescaped control characters other than TAB (U+0009) "
     "are "
     "explicitly prohibited; expected texts that end in a quote on their line"},
    {"title = \"Pendulum\"", "title = \"Pen\x01 dulum\"",
     "s.toml:2:13: not valid TOML: Error while parsing string: unescaped control characters other than TAB (U+0009) "
     "are "
     "explicitly prohibited; expected a file that follows https://toml.io, texts and numbers with units in quotes"},
    {"mass = \"250 g\"", "mass = 1\ninertia = [0, \"4e-4 kgm2\", 0]",
     "s.toml:28:15: mechanism.element.inertia: unknown unit 'kgm2' in '4e-4 kgm2'; expected 'kg m^2', with a blank "
     "between units"},
    {"from = \"inertial\"\n", "",
     "s.toml:9:1: 'mechanism.element.from' is missing; expected the frame that carries the joint, by its name in "
     "quotes"},
    {"\"± 1 %\"", "[1]", "s.toml:31:12: uncertain.interval has 1 number; expected two, [lower, upper]"},
    {"quantity = \"tip.position.z\"", "quantity = \"bob.speed.x\"",
     "s.toml:38:12: unknown quantity 'bob.speed.x'; expected what 'bob' gives, one of: bob.position.x, "
     "bob.velocity.x, bob.acceleration.x, bob.position.y, bob.velocity.y, bob.acceleration.y, bob.position.z, "
     "bob.velocity.z, bob.acceleration.z"},
    {"{ angle = \"30 deg\", rate = 0.5 }", "[\"30 deg\", 0.5]",
     "s.toml:15:11: mechanism.element.initial is a list; expected a table, such as { angle = 0, rate = 0 }"},
    {"length = 0.5", "length = \"5 millimetres\"",
     "s.toml:22:25: unknown parameter 'millimetres'; expected one of: gravity.x, gravity.y, gravity.z (for "
     "'rod.length', or the unit 'mm')"},
    {"\"± 1 %\"", "[0, 0.5]",
     "s.toml:31:12: uncertain.interval does not hold the nominal value 0.523599 rad; expected an interval around the "
     "nominal value"},
    {"{ type = \"uniform\" }", "{ type = \"triangular\", mode = 0.6 }",
     "s.toml:32:46: uncertain.distribution.mode 0.6 leaves the support; expected values inside [0.518363, 0.528835]"},
    {"quantity = \"hinge.angle\"\ninterval", "quantity = \"rod.vector.z\"\ninterval",
     "s.toml:30:12: 'rod.vector.z' follows from a formula; expected one of the quantities in it: rod.length"},
    {"[stochastic]", "[[requirement]]\nalways = \"angle > 0\"\nfrom = 0.3\nuntil = 0.2\n[stochastic]",
     "s.toml:39:1: the requirement's time begins at 0.3 s, after its end at 0.2 s; expected from before until"},
};

/// What may stand there: nothing that follows from all forces; and the line is that of the formula.
TEST(StudyReader, SuggestsNamesInFormulasOfForces) {
  const auto wrong = [](const std::string& force) {
    return messageOf(sampleStudyWith("[[uncertain]]",
                                     "[mechanism.parameters]\nstiff = \"3 N m/rad\"\n[[mechanism.element]]\ntype = "
                                     "\"joint-force\"\nname = \"motor\"\njoint = \"hinge\"\nforce = \"" +
                                         force + "\"\n[[uncertain]]"));
  };
  EXPECT_EQ(wrong("-stiff*hinge"),
            "s.toml:34:9: unknown quantity 'hinge'; expected 'hinge.angle' or 'hinge.rate' (for 'motor.force')");
  EXPECT_EQ(wrong("-stif*hinge.angle"), "s.toml:34:9: unknown quantity 'stif'; expected 'stiff' (for 'motor.force')");
  EXPECT_THAT(wrong("-stiff*theta"),
              HasSubstr("unknown quantity 'theta'; expected one of: hinge.angle, hinge.rate, stiff, "));
  EXPECT_THAT(wrong("-bob.weight*(1 m)"),
              HasSubstr("unknown quantity 'bob.weight'; expected one of: bob.mass, bob.centre.x, "));
  EXPECT_EQ(wrong("-stiff*hinge.angle"), "it was read");
  const std::string output = "quantity = \"tip.position.z\"";  // a parameter may be meant there too
  EXPECT_THAT(messageOf(sampleStudyWith(output, "quantity = \"1/rod.lenght\"")),
              EndsWith("unknown quantity 'rod.lenght'; expected a quantity of the mechanism, such as 'rod.length'"));
}

/// Of an element whose name it has, what that gives.
TEST(StudyReader, SuggestsOutputsOfTheElementThatIsNamed) {
  const std::string spring =
                        "[[mechanism.element]]\ntype = \"joint-spring\"\nname = \"coil\"\njoint = \"hinge\"\nstiffness "
                        "= \"1 N m/rad\"\n",
                    damper =
                        "[[mechanism.element]]\ntype = \"spring-damper\"\nname = \"strut\"\nfrom = \"inertial\"\n"
                        "from_point = [0, 5, 0]\nto = \"tip\"\nstiffness = \"1 N/m\"\n";
  const auto wrong = [&](const std::string& quantity, const std::string& elements) {
    std::string text = sampleStudyWith("[[uncertain]]", elements + "[[uncertain]]");
    return messageOf(text + "[[output]]\nname = \"wrong\"\nquantity = \"" + quantity + "\"\n");
  };
  EXPECT_THAT(wrong("coil.force", spring),
              EndsWith("unknown quantity 'coil.force'; expected a quantity that another element gives, or a formula of "
                       "such: the joint-spring 'coil' gives none"));
  EXPECT_THAT(
      wrong("strut.load", damper),
      EndsWith("unknown quantity 'strut.load'; expected what 'strut' gives, one of: strut.length, strut.force"));
  EXPECT_THAT(wrong("strut.forces", damper),
              EndsWith("unknown quantity 'strut.forces'; expected a quantity of the mechanism, such as 'strut.force'"));
  EXPECT_THAT(wrong("hinge.speed", ""), HasSubstr("; expected what 'hinge' gives, one of: hinge.angle, hinge.rate, "));
  EXPECT_EQ(wrong("strut.force", damper), "it was read");
}

TEST(StudyReader, ShowsHowInitialValuesAreWritten) {
  const std::string given = "initial = { angle = \"30 deg\", rate = 0.5 }";
  for (const char* wrong : {"[1, 0]", "1", "\"30 deg\""})
    EXPECT_THAT(messageOf(sampleStudyWith(given, std::string("initial = ") + wrong)),
                HasSubstr("; expected a table, such as { angle = 0, rate = 0 }"));
  // Examples of other joints can be copied too.
  for (const char* type : {"spherical", "free", "planar", "prismatic"}) {
    const std::string axis = type == std::string("prismatic") ? "\naxis = \"x\"\n" : "\n";
    std::string text = sampleStudyWith("[[uncertain]]", std::string("[[mechanism.element]]\ntype = \"") + type +
                                                            "\"\nname = \"joint\"\nfrom = \"tip\"\nto = \"K2\"" + axis +
                                                            "initial = 1\n[[mechanism.element]]\ntype = \"mass\"\nname "
                                                            "= \"end\"\nat = \"K2\"\nmass = 1\ninertia = [1, 1, 1]\n"
                                                            "[[uncertain]]");
    const std::string message = messageOf(text), before = "expected a table, such as ";
    ASSERT_THAT(message, HasSubstr(before)) << type;
    const std::string example = message.substr(message.find(before) + before.size());
    EXPECT_EQ(messageOf(text.replace(text.find("initial = 1"), 11, "initial = " + example)), "it was read") << example;
  }
}

TEST(StudyReader, SaysHowPowerByRateIsAMoment) {
  const std::string drive =
      "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"motor\"\njoint = \"hinge\"\nforce = \"1 N m\"\n"
      "[[uncertain]]";
  const auto with = [&](const std::string& quantity, const std::string& rest) {
    std::string text = sampleStudyWith("[[uncertain]]", drive);
    const std::string old = "quantity = \"tip.position.z\"\n";
    return messageOf(
        text.replace(text.find(old), old.size(), "name = \"moment\"\nquantity = \"" + quantity + "\"\n" + rest));
  };
  const std::string unit = "unit = \"N m\"\n", limit = "[[requirement]]\nalways = \"moment < 3 N m\"\n";
  EXPECT_EQ(with("motor.power/hinge.rate", unit),
            "s.toml:45:8: output.unit is N m, which does not measure what is wanted; expected N m/rad, or another unit "
            "of that kind (or \"(1 rad)\" times the quantity)");
  EXPECT_EQ(with("motor.power/hinge.rate", limit),
            "s.toml:46:10: 'moment < 3 N m' compares N m/rad with N m; expected quantities of one kind (or \"(1 rad)\" "
            "times the quantity)");
  for (const std::string& rest : {unit, limit}) EXPECT_EQ(with("motor.power/hinge.rate*(1 rad)", rest), "it was read");
  EXPECT_THAT(with("motor.power*hinge.rate", unit), Not(HasSubstr("(1 rad)")));
}

/// Beside "30 deg", "± 0.5" is half a radian: it may be meant so, but hardly ever is.
TEST(StudyReader, NotesIntervalsInRadiansBesideDegrees) {
  const auto notes = [](const std::string& interval, const std::string& angle = "\"30 deg\"") {
    std::string text = sampleStudyWith("angle = \"30 deg\"", "angle = " + angle);
    const std::size_t begin = text.find("interval = ") + 11;
    text.replace(begin, text.find('\n', begin) - begin, interval);
    std::vector<std::string> found;
    for (const std::string& note : readStudyText(text, "s.toml").notes)
      if (note.find("read in rad") != std::string::npos) found.push_back(note);
    return found;
  };
  for (const char* bare : {"\"± 0.5\"", "\"+- 1e-2\"", "\"+0.1 / -0.2\"", "[0.4, 0.6]", "[\"29 deg\", 0.6]"})
    EXPECT_THAT(notes(bare), ElementsAre(::testing::HasSubstr("note: the interval of 'hinge.angle' has no unit and is "
                                                              "read in rad, its nominal value is in degrees")))
        << bare;
  for (const char* said : {"\"± 0.5 deg\"", "\"± 0.05 rad\"", "\"± 1 %\"", "[\"29 deg\", \"31 deg\"]"})
    EXPECT_THAT(notes(said), ::testing::IsEmpty()) << said;
  EXPECT_THAT(notes("\"± 0.1\"", "0.5"), ::testing::IsEmpty());
  EXPECT_THAT(notes("\"± 0.1\"", "\"0.5 rad\""), ::testing::IsEmpty());
}

/// "135 deg ± 1 deg" is no 2.3562 rad for who wrote it.
TEST(StudyReader, KeepsTheUnitInWhichAQuantityIsStated) {
  const auto told = [](const std::string& angle, const std::string& interval) {
    std::string text = sampleStudyWith("angle = \"30 deg\"", "angle = " + angle);
    const std::size_t begin = text.find("interval = ") + 11;
    text.replace(begin, text.find('\n', begin) - begin, interval);
    return readStudyText(text, "s.toml").uncertain.at(0).told;
  };
  for (const char* interval : {"\"± 1 deg\"", "\"± 0.01 rad\"", "\"± 1 %\"", "[\"29 deg\", \"31 deg\"]", "\"± 0.1\""})
    EXPECT_EQ(told("\"30 deg\"", interval), "deg") << interval;
  EXPECT_EQ(told("\"-500 mrad\"", "\"± 1 %\""), "mrad");
  EXPECT_EQ(told("\"30°\"", "\"± 1 %\""), "°");
  EXPECT_EQ(told("0.5", "\"± 1 deg\""), "deg");  // a number alone is none of degrees, its deviation is
  EXPECT_EQ(told("0", "\"+ 1 / -2 deg\""), "deg");
  EXPECT_EQ(told("0.5", "[\"28 deg\", 0.6]"), "deg");
  for (const char* angle : {"0.5", "\"0.5\"", "\"3/20 pi rad\"", "\"0.25 + 0.25 rad\""})
    EXPECT_EQ(told(angle, "\"± 1 %\""), "") << angle;
  const auto ofLength = [](const std::string& length, const std::string& interval) {
    std::string text = sampleStudyWith("length = 0.5", "length = " + length);
    text.replace(text.find("\"hinge.angle\""), 13, "\"rod.length\"");
    const std::size_t begin = text.find("interval = ") + 11;
    text.replace(begin, text.find('\n', begin) - begin, interval);
    return readStudyText(text, "s.toml").uncertain.at(0).told;
  };
  EXPECT_EQ(ofLength("\"500 mm\"", "\"± 1 mm\""), "mm");
  EXPECT_EQ(ofLength("\"0.5 m\"", "\"± 1 mm\""), "m");
  EXPECT_EQ(ofLength("0.5", "\"± 1 mm\""), "");
  EXPECT_EQ(told("\"1/2 rad\"", "\"± 1 %\""), "rad");
  EXPECT_EQ(ofLength("\"1/16 in\"", "\"± 1 mm\""), "in");
  EXPECT_EQ(ofLength("\"1 in\"", "[\"0.9 in\", \"30 mm\"]"), "in");
}

/// Radians count as 1 in formulas, so that 25 Hz times t is 25 rad in a second.
TEST(StudyReader, NotesHertzInAngles) {
  const auto notes = [](const std::string& speed, const std::string& force) {
    std::string text = sampleStudyWith("[[mechanism.element]]",
                                       "[mechanism.parameters]\nspeed = " + speed + "\n[[mechanism.element]]");
    text.replace(text.find("[[uncertain]]"), 0,
                 "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"push\"\njoint = \"hinge\"\nforce = \"" +
                     force + "\"\n");
    std::vector<std::string> found;
    for (const std::string& note : readStudyText(text, "s.toml").notes)
      if (note.find("Hz") != std::string::npos) found.push_back(note);
    return found;
  };
  EXPECT_THAT(
      notes("\"25 Hz\"", "1 N m*sin(speed*t)"),
      ElementsAre(::testing::HasSubstr("note: 'speed' in Hz stands beside t in an angle, \"speed*t\", where 1 Hz "
                                       "is 1 rad/s; so many turns a second are 2*pi as much, or in rpm")));
  EXPECT_EQ(notes("\"2 kHz\"", "1 N m*exp(-t/s)*cos(0.5 + (t - 1 s)*speed)*sin(speed*t)").size(), 1U);
  EXPECT_THAT(notes("1", "0*speed*N*m + 1 N m*sin(25 Hz*t)"),
              ElementsAre(::testing::HasSubstr("note: a number in Hz")));
  for (const char* right : {"1 N m*sin(2*pi*speed*t)", "1 N m*sin(2*pi*25 Hz*t) + 0 N m*speed*s",
                            "1 N m*exp(-speed*t)*sin(3 rad/s*t)", "1 N m*speed*t"})
    EXPECT_THAT(notes("\"25 Hz\"", right), ::testing::IsEmpty()) << right;
  EXPECT_THAT(notes("\"25 rad/s\"", "1 N m*sin(speed*t)"), ::testing::IsEmpty());
  EXPECT_THAT(notes("\"1500 rpm\"", "1 N m*sin(speed*t)"), ::testing::IsEmpty());
  const std::string driven = R"([study]
analysis = "kinematics"
[mechanism.parameters]
speed = "25 Hz"
[[mechanism.element]]
type = "revolute"
name = "hinge"
from = "inertial"
to = "arm"
axis = "x"
[[mechanism.element]]
type = "drive"
name = "motor"
joint = "hinge"
position = "speed*t"
[[uncertain]]
quantity = "speed"
interval = "± 1 %"
[[output]]
quantity = "hinge.angle"
)";
  EXPECT_THAT(readStudyText(driven, "s.toml").notes,
              ElementsAre(::testing::StartsWith("s.toml:4:9: note: 'speed' in Hz")));
}

TEST(StudyReader, NotesDegreesWithoutAUnitAndStepsBeyondTheHorizon) {
  const auto notes = [](const std::string& old, const std::string& replacement) {
    return readStudyText(sampleStudyWith(old, replacement), "s.toml").notes;
  };
  EXPECT_THAT(
      notes("angle = \"30 deg\"", "angle = 30"),
      ElementsAre("s.toml:15:21: note: 'hinge.angle' is 30 rad, more than a turn; degrees would be \"30 deg\""));
  EXPECT_THAT(notes("angle = \"30 deg\"", "angle = -6.29"), ::testing::SizeIs(1));
  for (const char* meant : {"angle = 6.28", "angle = \"30 rad\"", "angle = -3"})
    EXPECT_THAT(notes("angle = \"30 deg\"", meant), ::testing::IsEmpty()) << meant;
  EXPECT_THAT(notes("output_step = 0.1", "output_step = 1"),
              ElementsAre("s.toml:5:15: note: study.output_step is longer than the horizon of 0.5 s, so that outputs "
                          "are those at its ends"));
  EXPECT_THAT(notes("output_step = 0.1", "output_step = 0.5"), ::testing::IsEmpty());
}

TEST(StudyReader, NamesAPlanForAnyNumberOfQuantities) {
  std::string names;
  for (int i = 0; i < 1229; ++i) names += "gain" + std::to_string(i) + " = 1, ";
  std::string text =
      sampleStudyWith("[[mechanism.element]]", "parameters = { " + names + "none = 0 }\n[[mechanism.element]]");
  text.insert(text.find("[[uncertain]]"), "[[uncertain]]\nquantity = \"gain*\"\ninterval = \"± 1 %\"\n");
  const auto messageOfPlan = [&](const std::string& plan) {
    std::string other = text;
    return messageOf(other.replace(other.find("\"sobol\""), 7, "\"" + plan + "\""));
  };
  EXPECT_EQ(messageOfPlan("halton"),
            "s.toml:43:1: the plan 'halton' serves at most 1229 uncertain quantities, not 1230; expected plan = "
            "\"random\" or \"latin-hypercube\" in [stochastic], of any number of quantities");
  for (const char* plan : {"sobol", "random", "latin-hypercube"}) EXPECT_EQ(messageOfPlan(plan), "it was read") << plan;
}

/// Combinations grow with the power of the quantities.
TEST(StudyReader, RefusesMorePointsThanTheGeneralMethodMayHave) {
  const auto messageOf = [](int quantities, const std::string& fuzzy) {
    std::string text = sampleStudy, names;
    for (int i = 0; i < quantities; ++i) names += "gain" + std::to_string(i) + " = 1, ";
    text.insert(text.find("[[mechanism.element]]"), "parameters = { " + names + "none = 0 }\n");
    text.insert(text.find("[[uncertain]]"), "[[uncertain]]\nquantity = \"gain*\"\ninterval = \"± 1 %\"\n");
    text += "[fuzzy]\n" + fuzzy;
    try {
      EXPECT_NE(readStudyText(text, "s.toml").ensemble.transformation, Transformation::reduced);
      return std::string();
    } catch (const StudyError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(messageOf(3, "method = \"general\""), "");
  EXPECT_EQ(messageOf(9, ""), "");
  EXPECT_THAT(
      messageOf(9, "method = \"general\""),
      ::testing::HasSubstr("fuzzy.method \"general\" takes 4.08518e+10 points of 10 quantities at 11 levels, and "
                           "65536 are the most; expected \"extended\", \"reduced\", or fuzzy.levels of 3 at "
                           "most"));
  EXPECT_THAT(
      messageOf(29, "method = \"general\""),
      ::testing::HasSubstr("points of 30 quantities at 11 levels, and 65536 are the most; expected \"extended\" "
                           "or \"reduced\""));
}

TEST(StudyReader, RefusesInKinematicsWhatOnlyAMotionHas) {
  std::string text = sampleStudyWith("dynamics", "kinematics");
  text.erase(text.find("horizon"), text.find("compare") - text.find("horizon"));
  for (const char* key : {"tightness = 1.1", "tolerance = 1e-9", "order = 12", "split = true", "max_pieces = 5"}) {
    const std::string name(key, std::string_view(key).find(' '));
    EXPECT_EQ(messageOf(text + "[interval]\n" + key + "\n"),
              "s.toml:42:" + std::to_string(name.size() + 4) + ": interval." + name +
                  " has no meaning where no time passes; expected no such key");
  }
  EXPECT_EQ(messageOf(text + "[interval]\ndegree = 3\n"), "it was read");
  for (const char* times : {"0", "3", "[\"1 s\"]"})
    EXPECT_EQ(messageOf(text + "[distribution]\ntimes = " + times + "\n"),
              "s.toml:42:9: distribution.times has no meaning where no time passes; expected no such key");
  EXPECT_EQ(messageOf(text + "[distribution]\ngap = 0.01\n"), "it was read");
}

INSTANTIATE_TEST_SUITE_P(StudyReader, BadStudyFile, ::testing::ValuesIn(badStudies));

}  // namespace
}  // namespace gamut
