// Requirements from the study's text to what the results say of them.
#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>

#include "studies/results/results_file.hpp"
#include "studies/running/replay.hpp"
#include "studies/running/run.hpp"
#include "studies/running/tolerance.hpp"
#include "tests/studies/pendulum_text.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// The pendulum of sampleStudy, let go at 30 degrees ± 1 % with 0.5 rad/s, with these requirements.
std::string withRequirements(const std::string& text) {
  return sampleStudyWith("[stochastic]", text + "\n[stochastic]");
}

Study read(const std::string& text) { return readStudyText(text, "s.toml"); }

RequirementResult named(const Results& results, const std::string& name) {
  for (const RequirementResult& requirement : results.requirements)
    if (requirement.name == name) return requirement;
  throw std::logic_error("no requirement " + name);
}

TEST(Requirements, AreReadWithTheirMargins) {
  const Study study = read(withRequirements(R"(
[[requirement]]
name = "clearance"
always = "tip.position.z > -0.5 m"
from = "100 ms"
until = 0.25
[[requirement]]
eventually = "-20 deg <= angle < 20 deg"
[[requirement]]
name = "slow"
always = "abs(hinge.rate) <= 3 rad/s"
[[requirement]]
name = "sign"
always = "hinge.angle^2 >= 0"
)"));
  ASSERT_EQ(study.requirements.size(), 4U);
  const Requirement& clearance = study.requirements[0];
  EXPECT_EQ(clearance.statement, "always tip.position.z > -0.5 m");
  EXPECT_TRUE(clearance.demand.isAlways);
  EXPECT_EQ(clearance.demand.from, 0.1);
  EXPECT_EQ(clearance.demand.until, 0.25);
  EXPECT_THAT(study.times, ::testing::ElementsAre(0, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5));
  ASSERT_EQ(study.outputs.size(), 8U);
  EXPECT_EQ(study.outputs[2].name, "clearance");
  EXPECT_EQ(study.outputs[2].unit, "m");
  EXPECT_EQ(study.outputs[3].quantity, "angle - (-20 deg)");
  EXPECT_EQ(study.outputs[4].quantity, "20 deg - angle");
  EXPECT_EQ(study.requirements[1].name, "-20 deg <= angle < 20 deg");
  EXPECT_FALSE(study.requirements[1].demand.isAlways);
  EXPECT_FALSE(study.requirements[1].demand.terms[0].isStrict);
  EXPECT_TRUE(study.requirements[1].demand.terms[1].isStrict);
  EXPECT_EQ(study.outputs[5].name, "slow, from above");
  EXPECT_EQ(study.outputs[6].quantity, "hinge.rate - (-3 rad/s)");
  EXPECT_EQ(study.outputs[7].quantity, "hinge.angle^2");
}

/// Of two uncertain quantities, with a requirement at the end that about half of the box meets, one that all of it
/// meets and one that none does.
Results withHalfMet() {
  const auto text = [](double limit) {
    return withRequirements(
        "[[uncertain]]\nquantity = \"rod.length\"\ninterval = \"± 2 %\"\ndistribution = { type = \"uniform\" }\n"
        "[[requirement]]\nname = \"partly\"\nfrom = 0.5\nalways = \"angle > " +
        std::to_string(limit) +
        " rad\"\n[[requirement]]\nname = \"met\"\nalways = \"hinge.rate > -9 rad/s\"\n"
        "[[requirement]]\nname = \"violated\"\nalways = \"hinge.rate > 1 rad/s\"\n");
  };
  RunOptions options;
  options.samples = 8;
  const Bounds& angle = run(read(text(0)), options).interval.at;
  options.samples = 400;
  const std::size_t last = angle.lower.times - 1;
  return run(read(text(0.5 * (angle.lower(last, 0) + angle.upper(last, 0)))), options);
}

/// No sample that violates a requirement lies in a cell that is met, and none that meets it in one that is violated.
TEST(Requirements, KnowWhatIsProvedOfPartsOfTheBox) {
  const Results results = withHalfMet();
  const std::vector<RequirementCell>& cells = results.requirements.cells;
  ASSERT_EQ(results.requirements[0].word, Decision::partly);
  const KeptSamples& kept = results.stochastic.kept;
  const std::size_t quantities = results.uncertain.size(), outputs = results.outputs.size(),
                    times = results.time.size();
  std::size_t met = 0, violated = 0;
  for (std::size_t i = 0; i < kept.motionNumber.size(); ++i) {
    const auto at =
        static_cast<std::size_t>(std::ranges::find(kept.number, kept.motionNumber[i]) - kept.number.begin());
    ASSERT_LT(at, kept.number.size());
    const double margin = kept.motions[((i + 1) * times - 1) * outputs + results.requirements[0].margin];
    for (const RequirementCell& cell : cells) {
      bool isInside = cell.requirement == 0 && cell.word != Decision::open;
      for (std::size_t q = 0; q < quantities && isInside; ++q) {
        const UncertainInfo& of = results.uncertain[q];
        const double x = (2 * kept.values[at * quantities + q] - of.lower - of.upper) / (of.upper - of.lower);
        isInside = cell.lower[q] < x && x < cell.upper[q];
      }
      if (!isInside) continue;
      ++(cell.word == Decision::met ? met : violated);
      EXPECT_EQ(cell.word == Decision::met, margin > 0) << "sample " << kept.motionNumber[i];
    }
  }
  EXPECT_GT(met, 100u);
  EXPECT_GT(violated, 100u);
  for (const auto& [number, word] : {std::pair(1u, Decision::met), {2u, Decision::violated}}) {
    const auto cell = std::ranges::find(cells, number, &RequirementCell::requirement);
    ASSERT_NE(cell, cells.end());
    EXPECT_EQ(cell->word, word);
    EXPECT_EQ(std::ranges::count(cells, number, &RequirementCell::requirement), 1);
  }
}

/// As they were, and none where there are none, as in older files.
TEST(Requirements, KeepWhatIsProvedOfPartsOfTheBox) {
  Results results = withHalfMet();
  const TemporaryFolder folder;
  writeResults(results, folder.path("r.h5"));
  EXPECT_THAT(differences(readResults(folder.path("r.h5")), results), ::testing::IsEmpty());
  results.requirements.cells.clear();
  writeResults(results, folder.path("older.h5"));
  const Results older = readResults(folder.path("older.h5"));
  EXPECT_TRUE(older.requirements.cells.empty());
  EXPECT_THAT(differences(older, results), ::testing::IsEmpty());
}

/// "what > limit unit", with >= or <= where the limit is allowed; behind each other.
std::string termsOf(const std::string& comparison) {
  const Study study =
      read(withRequirements("[[output]]\nname = \"tip height\"\nquantity = \"tip.position.z\"\n"
                            "[[output]]\nname = \"swing\"\nquantity = \"abs(hinge.rate)\"\n" +
                            std::string("[[requirement]]\nalways = \"") + comparison + "\"\n"));
  std::string text;
  for (const DemandTerm& term : study.requirements.front().demand.terms)
    text += std::string(text.empty() ? "" : ", ") + term.what + (term.side == DemandTerm::Side::above ? " >" : " <") +
            (term.isStrict ? " " : "= ") + term.limitText + " [" + term.unit + "]";
  return text;
}

TEST(Requirements, SayWhatLiesAboveOrBelowWhat) {
  for (const auto& [comparison, terms] :
       {std::pair("angle > 0.2", "angle > 0.2 rad []"),
        {"0.2 m >= 'tip height'", "'tip height' <= 0.2 m [m]"},
        {"-5 deg < angle <= 6 deg", "angle > -5 deg [deg], angle <= 6 deg [deg]"},
        {"6° >= angle > -5°", "angle <= 6° [°], angle > -5° [°]"},
        {"abs('tip height') < 60 mm", "'tip height' < 60 mm [mm], 'tip height' > -60 mm [mm]"},
        {"250mrad>=abs(angle - 1/2)", "angle - 1/2 <= 250mrad [mrad], angle - 1/2 >= -250mrad [mrad]"},
        {"abs(angle) > 6 deg", "abs(angle) > 6 deg [deg]"},
        {"0 < abs(angle) < 1 rad", "abs(angle) > 0 [], abs(angle) < 1 rad [rad]"},
        {"hinge.rate^2/2 < 1 rad/s*hinge.rate", "hinge.rate^2/2 < 1 rad/s*hinge.rate []"},
        {"hinge.angle > abs(angle) - 1", "hinge.angle > abs(angle) - 1 []"},
        {"rod.length > abs('tip height')", "'tip height' < rod.length [], 'tip height' > -rod.length []"},
        {"swing < 3 rad/s", "swing < 3 rad/s [rad/s]"},
        {"abs(swing) < 3", "swing < 3 rad/s [], swing > -3 rad/s []"},
        {"2 rad/2 > angle", "angle < 2 rad/2 []"}})
    EXPECT_EQ(termsOf(comparison), terms) << comparison;
}

/// Lines of limits are bounds of outputs, in their units, wherever the form says so.
TEST(Requirements, LimitTheOutputsWhoseMultiplesTheyCompare) {
  const auto limitOf = [](const std::string& comparison, std::size_t margin = 0) {
    const MarginInfo found =
        run(read(withRequirements("[[output]]\nname = \"height in mm\"\nquantity = \"tip.position.z\"\nunit = \"mm\"\n"
                                  "[[output]]\nname = \"degrees\"\nquantity = \"hinge.rate/(1 deg/s)\"\n"
                                  "[[requirement]]\nname = \"r\"\nalways = \"" +
                                  comparison + "\"\n")))
            .margins[margin];
    return std::pair(found.limited, found.limit);
  };
  // Outputs: angle, tip.position.z, height in mm, degrees; the margin.
  EXPECT_EQ(limitOf("angle > 0.25"), std::pair(std::uint64_t{0}, 0.25));
  EXPECT_EQ(limitOf("0.5 > 2*angle"), std::pair(std::uint64_t{0}, 0.25));
  EXPECT_EQ(limitOf("abs(angle) < 0.25", 1), std::pair(std::uint64_t{0}, -0.25));
  EXPECT_EQ(limitOf("tip.position.z - 0.5 m < 0.25 m"), std::pair(std::uint64_t{1}, 0.75));
  EXPECT_EQ(limitOf("hinge.rate < 45 deg/s"), std::pair(std::uint64_t{3}, 45.0));
  EXPECT_EQ(limitOf("tip.position.z > -rod.length/4").first, 1U);  // a number that is not uncertain
  EXPECT_EQ(limitOf("angle > hinge.rate*(1 s)").first, 4U);
  EXPECT_EQ(limitOf("angle < 0.1 rad/s*t + 1 rad").first, 4U);
  EXPECT_EQ(limitOf("angle^2 < 0.25").first, 4U);
}

TEST(Requirements, ThatMakeNoSenseAreRefusedInOneLine) {
  const auto refusal = [](const std::string& text) {
    return [text] { read(withRequirements("[[requirement]]\n" + text)); };
  };
  const auto says = [](const char* what) { return ThrowsMessage<StudyError>(HasSubstr(what)); };
  EXPECT_THAT(refusal("name = \"x\""), says("'requirement.always' is missing; expected always or eventually"));
  EXPECT_THAT(refusal("always = \"angle > 0\"\neventually = \"angle > 0\""), says("are both given; expected one of"));
  EXPECT_THAT(refusal("always = \"h < 1 m\"\n\n[[output]]\nname = \"h\"\nquantity = \"tip.position.z\""),
              says("'h' is a unit as well as an output; expected the output in single quotes, 'h'"));
  EXPECT_THAT(refusal("always = \"angle\""), says("'angle' compares nothing; expected a comparison with <"));
  EXPECT_THAT(refusal("always = \"angle == 0\""), says("no comparison that a margin could be found of"));
  EXPECT_THAT(refusal("always = \"angle > \""), says("nothing on one side"));
  EXPECT_THAT(refusal("always = \"0 < angle > 1\""), says("comparisons that do not belong together"));
  for (const char* limits : {"0.3 m < tip.position.z < 200 mm", "0.2 m < tip.position.z <= 0.2 m", "1 < angle < -1"})
    EXPECT_THAT(refusal("always = \"" + std::string(limits) + "\""),
                says("' is met by nothing: its limits leave nothing between them; expected the lesser limit first"));
  EXPECT_THAT(refusal("always = \"0.2 m > tip.position.z > 0.3 m\""), says("expected the greater limit first"));
  EXPECT_NO_THROW(refusal("always = \"0.2 m <= tip.position.z <= 0.2 m\"")());
  for (const char* numbers : {"3 < 2", "5 > 3 rad", "angle > 5 deg > 3 deg", "2 rad < 3"})
    EXPECT_THAT(refusal("always = \"" + std::string(numbers) + "\""), says("' compares numbers with each other"));
  for (const char* magnitude : {"abs(angle) < -1 rad", "abs(angle) < 0", "-3 > abs(angle)"})
    EXPECT_THAT(refusal("always = \"" + std::string(magnitude) + "\""),
                says("' is met by nothing: no magnitude is below 0; expected a limit above 0"));
  for (const char* name : {"hinge.angle", "t"}) {
    const std::string other = "[[output]]\nname = \"" + std::string(name) + "\"\nquantity = \"2*hinge.angle\"";
    EXPECT_THAT(
        refusal("always = \"" + std::string(name) + " < 1\"\n\n" + other),
        says("' is a quantity as well as an output, which is another one, '2*hinge.angle'; expected another name"));
  }
  for (const char* same : {" hinge.angle ", "'hinge.angle'"})
    EXPECT_NO_THROW(refusal("always = \"hinge.angle < 1\"\n\n[[output]]\nname = \"hinge.angle\"\nquantity = \"" +
                            std::string(same) + "\"")());
  const std::string named = "\n\n[[output]]\nname = \"pi\"\nquantity = \"hinge.angle\"";
  EXPECT_THAT(refusal("always = \"2*pi < 1\"" + named), says("'pi' is a number as well as an output; expected the"));
  EXPECT_NO_THROW(refusal("always = \"'pi' < 1\"" + named)());
  EXPECT_THAT(refusal("always = \"angel > 0\""), says("unknown quantity 'angel'; expected"));
  EXPECT_THAT(refusal("always = \"tip.position.z > 2 s\""), says("s.toml:"));
  EXPECT_THAT(refusal("always = \"angle > 0\"\nfrom = 0.6"),
              says("outside the study's time; expected a time from 0 s"));
  EXPECT_THAT(refusal("always = \"angle > 0\"\nfrom = 0.4\nuntil = 0.3"), says("expected from before until"));
  EXPECT_THAT(refusal("always = \"angle > 0\"\n[[requirement]]\nalways = \"angle > 0\""),
              says("are named 'angle > 0'"));
  EXPECT_THAT(refusal("name = \"angle\"\nalways = \"angle > 0\""), says("both named 'angle'"));
  EXPECT_THAT(refusal("alwys = \"angle > 0\""), says("unknown key 'alwys'"));
}

/// The angle falls from 0.5236 ± 1 % to below -0.3 within half a second; its peak is early.
const std::string four = R"(
[[requirement]]
name = "met"
always = "angle < 0.6"
[[requirement]]
name = "violated"
always = "angle > 0.2"
[[requirement]]
name = "partly"
always = "angle < 0.527"
until = 0
[[requirement]]
name = "passes"
eventually = "angle < 0"
)";

TEST(Requirements, HaveThreeAnswersEach) {
  const Results results = run(read(withRequirements(four)));
  ASSERT_EQ(results.requirements.size(), 4U);
  const RequirementResult met = named(results, "met");
  EXPECT_EQ(met.word, Decision::met);
  EXPECT_EQ(met.factor, 1);
  EXPECT_EQ(met.probabilityLower, 1);
  EXPECT_EQ(met.violationMost, 0);
  EXPECT_EQ(met.samples, 16);
  EXPECT_EQ(met.violating, 0);
  EXPECT_TRUE(std::isnan(met.shareLower));  // the samples are not independent
  const RequirementResult violated = named(results, "violated");
  EXPECT_EQ(violated.word, Decision::violated);
  EXPECT_EQ(violated.probabilityUpper, 0);
  EXPECT_EQ(violated.violationLeast, 1);
  EXPECT_EQ(violated.violating, 16);
  // Uniform on π/6 (1 ± 0.01): below 0.527 with probability (0.527 / (π/6) - 0.99) / 0.02.
  const RequirementResult partly = named(results, "partly");
  const double share = (0.527 * 6 / 3.141592653589793 - 0.99) / 0.02;
  EXPECT_EQ(partly.word, Decision::partly);
  EXPECT_LE(partly.probabilityLower, share + 1e-9);  // the share is rounded, as the nominal value is
  EXPECT_GE(partly.probabilityUpper, share - 1e-9);
  EXPECT_LT(partly.probabilityUpper - partly.probabilityLower, 1e-6);
  EXPECT_NEAR(partly.factor, 2 * share - 1, 2.5e-3);
  EXPECT_LE(partly.violationLeast, 2 - 2 * share + 1e-9);
  EXPECT_GE(partly.violationMost, 2 - 2 * share - 1e-9);
  EXPECT_NEAR(partly.violationMost - partly.violationLeast, 0, 0.01);
  EXPECT_GT(partly.violation[0], 0.527);
  EXPECT_LE(partly.violationUpper, 0);
  EXPECT_EQ(partly.violationTime, 0);
  EXPECT_EQ(named(results, "passes").word, Decision::met);
}

TEST(Requirements, AreKeptInTheFile) {
  const TemporaryFolder folder;
  const Results results = run(read(withRequirements(four)));
  writeResults(results, folder.path("r.h5"));
  EXPECT_THAT(differences(results, readResults(folder.path("r.h5"))), ::testing::IsEmpty());
}

TEST(Requirements, OfIndependentSamplesHaveAConfidence) {
  std::string text = withRequirements(four);
  text.replace(text.find("\"sobol\""), 7, "\"random\"");
  const RequirementResult partly = named(run(read(text)), "partly");
  EXPECT_LT(partly.shareLower, partly.probabilityLower);
  EXPECT_GT(partly.shareUpper, partly.probabilityUpper);
}

/// Violated in one corner of three quantities, with a probability of 1e-6.
TEST(Requirements, AreRefutedByACornerThatSamplesMiss) {
  std::string text = withRequirements(R"(
[[requirement]]
name = "corner"
always = "angle + 4*bob.mass/(1 kg) + 2*rod.length/(1 m) < 2.61308"
until = 0
)");
  text.replace(text.find("[[output]]"), 10, R"([[uncertain]]
quantity = "bob.mass"
interval = "± 5 %"
[[uncertain]]
quantity = "rod.length"
interval = "± 3.5 %"
[[output]])");
  const Results results = run(read(text));
  const RequirementResult corner = named(results, "corner");
  EXPECT_EQ(corner.word, Decision::partly);
  EXPECT_EQ(corner.violating, 0);
  EXPECT_EQ(results.stochastic.nameOf(corner.violationSample), "corner 7");
  EXPECT_LE(corner.violationUpper, 0);
  EXPECT_GT(corner.probabilityLower, 0.99);
  EXPECT_GT(corner.factor, 0.98);
}

/// The ends of ± 10 % of 0.3 are 0.27 and 0.33: what the box is wider by than that violates nothing.
TEST(Requirements, AreNotRefutedByRoundings) {
  for (const char* statement : {"always = \"angle <= 0.33\"", "always = \"angle >= 0.27\"",
                                "eventually = \"angle <= 0.33\"", "always = \"where(angle > 0.33, 1, -1) <= 0\""}) {
    std::string text = withRequirements("[[requirement]]\nname = \"end\"\nuntil = 0\n" + std::string(statement) + "\n");
    text.replace(text.find("\"30 deg\""), 8, "0.3");
    text.replace(text.find("± 1 %"), 6, "± 10 %");
    const RequirementResult end = named(run(read(text)), "end");
    EXPECT_TRUE(end.word == Decision::open || end.word == Decision::met) << statement << ": " << wordOf(end.word);
    EXPECT_TRUE(std::isnan(end.violation[0])) << statement;
  }
}

/// Both ends of [0.25, 0.75], and of what is compared with them, are doubles.
TEST(Requirements, AreMetWhereALimitIsReachedExactly) {
  for (const char* analysis : {"\"dynamics\"", "\"kinematics\""})
    for (const auto& [statement, isMet] : {std::pair("angle <= 0.75", true),
                                           {"angle >= 0.25", true},
                                           {"0.25 <= angle <= 0.75", true},
                                           {"angle < 0.75", false},
                                           {"angle > 0.25", false},
                                           {"angle <= 0.7499999999999999", false}}) {
      std::string text = withRequirements("[[requirement]]\nname = \"end\"\nalways = \"" + std::string(statement) +
                                          "\"\n" + (analysis[1] == 'd' ? "until = 0\n" : ""));
      text.replace(text.find("\"30 deg\""), 8, "0.5");
      text.replace(text.find("\"± 1 %\""), 8, "[0.25, 0.75]");
      text.replace(text.find("\"dynamics\""), 10, analysis);
      if (analysis[1] == 'k') text.replace(text.find("horizon"), text.find("compare") - text.find("horizon"), "");
      const RequirementResult end = named(run(read(text)), "end");
      EXPECT_EQ(end.word == Decision::met, isMet) << analysis << " " << statement << ": " << wordOf(end.word);
    }
}

TEST(Requirements, ComparePlainNumbersInSiUnits) {
  const Study study =
      read(withRequirements("[[requirement]]\nname = \"plain\"\nalways = \"-3 < tip.position.z < 4\"\n"));
  EXPECT_EQ(study.outputs[2].quantity, "tip.position.z - (-3 m)");
  EXPECT_EQ(study.outputs[3].unit, "m");
}

/// Normal on a narrow interval: as tight as a uniform one.
TEST(Requirements, OfPeakedDistributionsAreAsTight) {
  std::string text = withRequirements("[[requirement]]\nname = \"peak\"\nalways = \"angle < 0.525\"\nuntil = 0\n");
  text.replace(text.find("\"uniform\""), 9, "\"normal\", deviation = 0.002");
  const RequirementResult peak = named(run(read(text)), "peak");
  EXPECT_LT(peak.probabilityUpper - peak.probabilityLower, 0.005);
  EXPECT_GT(peak.probabilityLower, 0.7);  // Φ(0.7) and some
  EXPECT_LT(peak.probabilityUpper, 0.8);
}

TEST(Requirements, KeepWhatWasProvedWhereTheEnclosureEnds) {
  std::string text = withRequirements(four);
  text.replace(text.find("[stochastic]"), 12, "[interval]\nmax_pieces = 1\n[stochastic]");
  Study study = read(text);
  study.flow.maxWidth = 1e-3;  // ends at once
  const Results results = run(study);
  EXPECT_LT(results.interval.reached, 0.5);
  const RequirementResult met = named(results, "met");
  EXPECT_EQ(met.word, Decision::open);
  EXPECT_NE(met.why, "");
  EXPECT_EQ(met.probabilityLower, 0);
  EXPECT_EQ(met.factor, 0);
}

TEST(Requirements, AreSampledWithoutAGuarantee) {
  std::string text = withRequirements(four);
  text.replace(text.find("[\"interval\", \"stochastic\", \"fuzzy\"]"), 35, "[\"stochastic\"]");
  const Results results = run(read(text));
  EXPECT_EQ(named(results, "met").word, Decision::open);
  EXPECT_EQ(named(results, "met").why, "no enclosure was asked for");
  EXPECT_EQ(named(results, "partly").word, Decision::partly);  // a flow of that sample's values proves it
  EXPECT_EQ(named(results, "met").violating, 0);
}

/// An output is one of this unit everywhere, that of its limit or not; only what is no output takes that of its limit.
TEST(Requirements, AreToldInTheUnitOfTheOutputElseOfTheLimit) {
  const std::string outputs =
      "[[output]]\nname = \"height\"\nquantity = \"tip.position.z\"\nunit = \"mm\"\n"
      "[[output]]\nname = \"pull\"\nquantity = \"hinge.reaction.force.z\"\n";
  const Study study = read(withRequirements(outputs + R"(
[[requirement]]
name = "a"
always = "'height' < 0.2 m"
[[requirement]]
name = "b"
always = "hinge.angle < 40 deg"
[[requirement]]
name = "c"
always = "abs(hinge.angle) < 1"
[[requirement]]
name = "d"
always = "hinge.rate > -400 rpm"
[[requirement]]
name = "e"
always = "tip.position.z - 1 mm < tip.position.y + 2 m"
[[requirement]]
name = "f"
always = "pull < 2 kN"
[[requirement]]
name = "g"
always = "hinge.reaction.force.z < 2 kN"
[[requirement]]
name = "h"
always = "hinge.reaction.force.y < 2 kN"
[[requirement]]
name = "i"
always = "pull*height < 2 kJ"
)"));
  std::vector<std::string> units;
  for (const Requirement& requirement : study.requirements)
    units.push_back(study.outputs[requirement.firstMargin].unit);
  EXPECT_THAT(units, ::testing::ElementsAre("mm", "rad", "rad", "rpm", "m", "N", "N", "kN", "kJ"));
  const Results results = run(study, {});
  const std::size_t height = 2, margin = study.requirements[0].firstMargin;
  for (std::size_t i = 0; i < results.time.size(); ++i)
    EXPECT_NEAR(results.interval.at.lower(i, margin), 200 - results.interval.at.upper(i, height), 1e-9);
  EXPECT_EQ(named(results, "a").word, Decision::met);
  EXPECT_EQ(named(results, "d").word, Decision::met);
}

/// A hinge that is driven at 2 rad/s beside one that turns at 1 rad/s: in one step, of angles that are kinks at first.
TEST(Requirements, AreProvedOfAnglesBetweenOutputTimes) {
  const std::string study = R"([study]
analysis = "dynamics"
horizon = 3.6
output_times = [0.5, 1, 2, 3]
compare = ["interval", "stochastic"]
[mechanism]
[[mechanism.element]]
type = "revolute"
name = "driven"
from = "inertial"
to = "P"
axis = "z"
[[mechanism.element]]
type = "drive"
name = "drive"
joint = "driven"
position = "2 rad/s*t"
[[mechanism.element]]
type = "revolute"
name = "free"
from = "inertial"
to = "B"
axis = "z"
initial = { rate = 1.0 }
[[mechanism.element]]
type = "mass"
name = "body"
at = "B"
mass = 1
inertia = [1, 1, 1]
[[mechanism.element]]
type = "relative-motion"
name = "seen"
from = "P"
to = "B"
axis = "x"
[[output]]
quantity = "seen.rotation_vector.z"
[[requirement]]
name = "turned"
always = "abs(seen.rotation_vector.z) < 2.05 rad"
until = 2
[[requirement]]
name = "apart"
always = "seen.angle < 2.05 rad"
until = 2
[[requirement]]
name = "no farther than that"
always = "abs(seen.rotation_vector.z) < 3.1416 rad"
[stochastic]
samples = 16
[distribution]
times = 0
)";
  const Results results = run(read(study), {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  for (const RequirementResult& requirement : results.requirements) EXPECT_EQ(requirement.word, Decision::met);
  TemporaryFolder folder;  // of nothing that is uncertain there are no values that violate it
  writeResults(results, folder.path("r.h5"));
  EXPECT_EQ(differences(readResults(folder.path("r.h5")), results), std::vector<std::string>{});
}

TEST(Requirements, HoldWithoutMotion) {
  const Results results = run(read(R"([study]
analysis = "kinematics"
[mechanism]
)" + hingeAndRod("initial = { angle = 0.5 }\n", "vector = [0, 0, \"-1 m\"]\n") +
                                   R"([[uncertain]]
quantity = "hinge.angle"
interval = [0, 1]
[[output]]
quantity = "tip.position.z"
[[requirement]]
name = "low"
always = "tip.position.z < -0.54 m"
[[requirement]]
name = "lower"
always = "tip.position.z < -0.8 m"
)"));
  EXPECT_EQ(named(results, "low").word, Decision::met);
  const RequirementResult lower = named(results, "lower");
  EXPECT_EQ(lower.word, Decision::partly);
  EXPECT_LE(lower.probabilityLower, std::acos(0.8));
  EXPECT_GE(lower.probabilityUpper, std::acos(0.8));
  EXPECT_LT(lower.probabilityUpper - lower.probabilityLower, 0.01);
}

TEST(Requirements, ThatAreViolatedCanBeReplayed) {
  const Study study = read(withRequirements(four));
  const Results results = run(study);
  RequirementResult partly = named(results, "partly");
  const ReplayedSample sample = replayViolation(Machine(study), results, partly);
  EXPECT_EQ(sample.values[0], partly.violation[0]);
  EXPECT_LT(sample.trajectory(0, partly.margin), 0);
  partly.violationSample = -1;  // as of values that no sample has
  EXPECT_EQ(replayViolation(Machine(study), results, partly).values[0], partly.violation[0]);
  EXPECT_THROW(replayViolation(Machine(study), results, named(results, "met")), std::invalid_argument);
}

// ---- What varies in time --------------------------------------------------------------------------------------------

/// A lag that follows an input of no known course: x may come to 1 - e^-4 at most.
std::string lagWith(const std::string& requirements, const std::string& varies = "varies = \"freely\"") {
  return R"([study]
analysis = "dynamics"
horizon = 4
output_step = 0.5
compare = ["interval", "stochastic"]
[mechanism.parameters]
u = 0
[[mechanism.element]]
type = "state"
name = "x"
initial = 0
rate = "u - x"
[[uncertain]]
quantity = "u"
interval = [-1, 1]
)" + varies +
         R"(
[[output]]
quantity = "x"
)" + requirements +
         R"(
[stochastic]
samples = 64
[distribution]
times = 0
)";
}

/// What is printed as a violation must be one.
void expectViolation(const Study& study, const Results& results, const RequirementResult& requirement) {
  const ReplayedSample sample = replayViolation(Machine(study), results, requirement);
  double least = 1;
  for (std::size_t i = 0; i < sample.times; ++i) least = std::min(least, sample.trajectory(i, requirement.margin));
  EXPECT_LT(least, 0) << requirement.name;
}

TEST(Requirements, AreRefutedByACourse) {
  const Study study = read(lagWith(R"(
[[requirement]]
name = "small"
always = "x < 0.5"
[[requirement]]
name = "smallest"
always = "x < 0.9815"
[[requirement]]
name = "held"
always = "x < 1.5"
)"));
  const Results results = run(study);
  for (const char* name : {"small", "smallest"}) {
    const RequirementResult violated = named(results, name);
    EXPECT_EQ(violated.word, Decision::partly) << name;
    EXPECT_GE(violated.violationSample, 0) << name;
    EXPECT_LT(violated.violationUpper, 0) << name;
    EXPECT_EQ(violated.probabilityLower, 0) << name;  // of some courses it is met
    EXPECT_EQ(violated.probabilityUpper, 1) << name;
    expectViolation(study, results, violated);
  }
  EXPECT_EQ(named(results, "held").word, Decision::met);
  EXPECT_THROW(replayViolation(Machine(study), results, named(results, "held")), std::invalid_argument);
}

/// With a bounded rate no course may jump; what swings is a counterexample all the same.
TEST(Requirements, AreRefutedByACourseOfBoundedRate) {
  const Study study =
      read(lagWith("[[requirement]]\nname = \"still\"\nalways = \"x - 0.9*u > -0.3\"\n", "rate = \"± 2/s\""));
  const Results results = run(study);
  const RequirementResult still = named(results, "still");
  EXPECT_EQ(still.word, Decision::partly);
  expectViolation(study, results, still);
}

/// Where no flow comes far enough to prove it, the sample is told, and is what is printed.
TEST(Requirements, AreViolatedInSimulationWhereNothingIsProved) {
  Study study = read(lagWith("[[requirement]]\nname = \"small\"\nalways = \"x < 0.5\"\n"));
  study.flow.maxWidth = 1e-300;  // flows end at once
  const Results results = run(study);
  const RequirementResult small = named(results, "small");
  EXPECT_EQ(small.word, Decision::open);
  EXPECT_TRUE(small.isViolatedInSimulation);
  EXPECT_THAT(small.why, HasSubstr("a flow of its values alone ends"));
  expectViolation(study, results, small);
  const TemporaryFolder folder;
  writeResults(results, folder.path("r.h5"));
  EXPECT_THAT(differences(results, readResults(folder.path("r.h5"))), ::testing::IsEmpty());
}

// ---- Decided though hard to see -------------------------------------------------------------------------------------

/// A state with this rate and output, from 0 s to 1 s.
std::string stateWith(const std::string& rate, const std::string& interval, const std::string& requirements) {
  return R"([study]
analysis = "dynamics"
horizon = 1
output_step = 0.1
compare = ["interval", "stochastic"]
[mechanism.parameters]
v = 1
[[mechanism.element]]
type = "state"
name = "x"
initial = 0
rate = ")" +
         rate + R"("
[[uncertain]]
quantity = "v"
interval = )" +
         interval + R"(
[[output]]
quantity = "x"
)" + requirements +
         R"(
[stochastic]
samples = 32
[distribution]
times = 0
)";
}

/// x passes 0.53 for sure, between two output times and in some 5 ms.
TEST(Requirements, AreRefutedByAPeakBetweenOutputTimes) {
  const Results results = run(read(stateWith(
      "v", "[0.99, 1.01]", "[[requirement]]\nname = \"peak\"\nalways = \"exp(-((x - 0.53)/0.002)^2) < 0.9\"\n")));
  const RequirementResult peak = named(results, "peak");
  EXPECT_EQ(peak.violating, 0);
  EXPECT_THAT(peak.word, ::testing::AnyOf(Decision::partly, Decision::violated));
  EXPECT_TRUE(peak.isViolatedBetween);
  EXPECT_NEAR(peak.violationTime * peak.violation[0], 0.53, 1e-3);
  EXPECT_LT(peak.violationUpper, 0);
}

/// At rest on the limit, and away from it with the time, its square, its third power.
TEST(Requirements, ThatStartAtTheirLimitAreMet) {
  for (const char* rate : {"v", "v*t/(1 s)", "v*(t/(1 s))^2", "v*cos(x)", "v - x"}) {
    const Results results =
        run(read(stateWith(rate, "\"± 10 %\"", "[[requirement]]\nname = \"above\"\nalways = \"x >= 0\"\n")));
    EXPECT_EQ(named(results, "above").word, Decision::met) << rate;
  }
  for (const char* rate : {"-v", "v*(t/(1 s) - 0.001)", "v*sin(6.2832*t/(1 s) - 0.0001)"}) {
    const Results results =
        run(read(stateWith(rate, "\"± 10 %\"", "[[requirement]]\nname = \"above\"\nalways = \"x >= 0\"\n")));
    EXPECT_NE(named(results, "above").word, Decision::met) << rate;
  }
}

/// At the moment itself where() is the mean of both sides.
TEST(Requirements, AreMetAtTheMomentOfAJump) {
  for (const char* moment : {"0.5 s", "0.55 s"}) {
    const std::string at = moment;
    const std::string text = "[[requirement]]\nname = \"once\"\neventually = \"where(t > " + at +
                             ", 1, 0) > 0.4\"\nuntil = \"" + at +
                             "\"\n[[requirement]]\nname = \"more\"\neventually = \"where(t > " + at +
                             ", 1, 0) > 0.6\"\nuntil = \"" + at + "\"\n";
    const Results results = run(read(stateWith("v", "\"± 10 %\"", text)));
    EXPECT_EQ(named(results, "once").word, Decision::met) << moment;
    EXPECT_NE(named(results, "more").word, Decision::met) << moment;
  }
}

// ---- Reasons --------------------------------------------------------------------------------------------------------

TEST(Requirements, SayHowFarTheyAreProved) {
  std::string text = withRequirements("[[requirement]]\nname = \"most\"\nalways = \"tip.position.z < 10 m\"\n");
  Study study = read(text);
  study.flow.maxWidth = 0.0118;  // of the angle, which is 0.0105 wide at first and grows
  const Results results = run(study);
  const RequirementResult most = named(results, "most");
  ASSERT_LT(results.interval.reached, 0.5);
  EXPECT_EQ(most.word, Decision::open);
  EXPECT_EQ(most.why, results.interval.why);
  EXPECT_LE(most.metUntil, results.interval.reached);
  EXPECT_GE(most.metUntil, results.interval.reached - 0.1);
}

TEST(Requirements, NameOneCauseAndWhatMayHelp) {
  std::string text = withRequirements(four);
  text.replace(text.find("[\"interval\", \"stochastic\", \"fuzzy\"]"), 35, "[\"stochastic\"]");
  const Results results = run(read(text));
  EXPECT_EQ(named(results, "met").advice, "study.compare with \"interval\"");
}

/// a + b < limit at rest, a of 1 m ± 10 %, b of 2 m ± 0.1 m: 3.2 m is met where both, or one of them alone, shrink.
TEST(Requirements, SayWhichToleranceWouldDoAlone) {
  const Results results = run(read(R"([study]
analysis = "kinematics"
[mechanism]
parameters = { a = "1 m", b = "2 m", c = "1 kg" }
[[uncertain]]
quantity = "a"
interval = "± 10 %"
[[uncertain]]
quantity = "b"
interval = ["1.9 m", 2.1]
[[uncertain]]
quantity = "c"
interval = "+1/-2 %"
[[output]]
name = "sum"
quantity = "a + b"
[[output]]
name = "c"
quantity = "c"
[[requirement]]
name = "half"
always = "sum < 3.15 m"
[[requirement]]
name = "neither"
always = "sum < 3.09375 m"
[[requirement]]
name = "nominal"
always = "sum < 2.95 m"
[[requirement]]
name = "met"
always = "sum < 3.3 m"
[[requirement]]
name = "violated"
always = "sum < 2.7 m"
[stochastic]
samples = 64
)"));
  EXPECT_EQ(results.uncertain[0].stated, "± 10 %");
  EXPECT_EQ(results.uncertain[1].stated, "[1.9 m, 2.1]");
  EXPECT_EQ(results.uncertain[2].stated, "+1/-2 %");
  const RequirementResult half = named(results, "half");
  EXPECT_EQ(half.word, Decision::partly);
  for (const std::size_t q : {0, 1}) {  // 3.15 = 3 + 0.1 + 0.05, but for roundings of the numbers
    EXPECT_LE(half.aloneLower[q], 0.5 + 1e-12);
    EXPECT_GE(half.aloneUpper[q], 0.5 - 1e-12);
    EXPECT_LT(half.aloneUpper[q] - half.aloneLower[q], 0.005);
  }
  EXPECT_EQ(half.aloneLower[2], 0);  // what does not matter does not help
  EXPECT_EQ(half.aloneUpper[2], 0);
  for (const std::string name : {"neither", "nominal", "violated"}) {
    EXPECT_EQ(named(results, name).aloneLower, std::vector<double>(3, 0)) << name;
    EXPECT_EQ(named(results, name).aloneUpper, std::vector<double>(3, 0)) << name;
  }
  EXPECT_EQ(named(results, "met").aloneLower, std::vector<double>(3, 1));
  EXPECT_EQ(named(results, "met").aloneUpper, std::vector<double>(3, 1));
  TemporaryFolder folder;
  writeResults(results, folder.path("r.h5"));
  EXPECT_EQ(differences(readResults(folder.path("r.h5")), results), std::vector<std::string>{});
}

/// Of a motion, at every instant: an oscillator's swing x0 cos(w t) is x0 at the start.
TEST(Requirements, SayWhichToleranceWouldDoAloneAtEveryInstant) {
  std::string text =
      withRequirements("[[requirement]]\nname = \"limit\"\nalways = \"angle < 30.15 deg\"\nuntil = 0.2\n");
  text.replace(text.find("[[output]]"), 10,
               "[[uncertain]]\nquantity = \"rod.length\"\ninterval = \"± 1 %\"\n[[output]]");
  text.replace(text.find("rate = 0.5"), 10, "rate = -0.5");
  const Results results = run(read(text));
  const RequirementResult limit = named(results, "limit");
  EXPECT_EQ(limit.word, Decision::partly);
  EXPECT_LE(limit.aloneLower[0], 0.5 + 1e-12);
  EXPECT_GE(limit.aloneUpper[0], 0.5 - 1e-12);
  EXPECT_LT(limit.aloneUpper[0] - limit.aloneLower[0], 0.01);
  EXPECT_EQ(limit.aloneUpper[1], 0);
}

// ---- Tolerances -----------------------------------------------------------------------------------------------------

TEST(Tolerances, AreAsLargeAsRequirementsAllow) {
  // 30° (1 + d) < 32°: d = 0.0667, 6.67 times 1 %.
  const std::string text =
      withRequirements("[[requirement]]\nname = \"limit\"\nalways = \"angle < 32 deg\"\nuntil = 0\n");
  const AllowedDeviations found = findTolerances(Machine(read(text)));
  EXPECT_LE(found.together.factor, 20.0 / 3);
  EXPECT_GT(found.together.factor, 0.97 * 20 / 3);
  EXPECT_EQ(found.together.limit, "limit");
  ASSERT_EQ(found.alone.size(), 1U);
  EXPECT_EQ(found.alone[0].name, "start");
  EXPECT_LE(found.alone[0].interval.upper(), 32.0 * 3.1415927 / 180);
}

TEST(Tolerances, ShrinkOneByOne) {
  std::string text = withRequirements(
      "[[requirement]]\nname = \"limit\"\nalways = \"angle + 0*rod.length/m < 30.15 deg\"\nuntil = 0\n");
  text.replace(text.find("[[output]]"), 10,
               "[[uncertain]]\nquantity = \"rod.length\"\ninterval = \"± 1 %\"\n[[output]]");
  const AllowedDeviations found = findTolerances(Machine(read(text)));
  EXPECT_NEAR(found.together.factor, 0.5, 0.01);
  EXPECT_LE(found.together.factor, 0.5);
  EXPECT_NEAR(found.alone[0].factor, 0.5, 0.01);
  EXPECT_EQ(found.alone[1].factor, 0);  // it does not help
}

TEST(Tolerances, SayWhatNominalValuesViolate) {
  const AllowedDeviations found = findTolerances(
      Machine(read(withRequirements("[[requirement]]\nname = \"limit\"\nalways = \"angle < 29 deg\"\n"))));
  EXPECT_EQ(found.nominal, "limit");
  EXPECT_EQ(found.together.factor, 0);
}

TEST(Tolerances, NeedSomethingToBeRequired) {
  EXPECT_THAT([] { findTolerances(Machine(read(sampleStudy))); },
              ThrowsMessage<std::invalid_argument>("the study has no [[requirement]]"));
}

/// An interval no wider than roundings has no number that is surely meant: its rounded ends are none.
TEST(Requirements, AreNotViolatedByRoundedEndsAlone) {
  const Results results = run(read(R"([study]
analysis = "kinematics"
[mechanism]
parameters = { a = "0.1", b = "1" }
[[uncertain]]
quantity = "a"
interval = "± 1e-19"
[[uncertain]]
quantity = "b"
interval = "± 0.1"
[[output]]
name = "out"
quantity = "1e17*(10*a-1)+b"
[[requirement]]
name = "fits"
always = "out > -5"
[[requirement]]
name = "not so"
always = "b < 1.05"
[stochastic]
samples = 64
)"));
  EXPECT_EQ(named(results, "fits").word, Decision::open);
  EXPECT_EQ(named(results, "not so").word, Decision::partly);
}

}  // namespace
}  // namespace gamut
