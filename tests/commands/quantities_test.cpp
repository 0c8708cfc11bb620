// gamut quantities: all that a study may name, of a study that is only begun too.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/study.hpp"
#include "tests/commands/program.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::ContainsRegex;
using ::testing::StartsWith;
using Json = nlohmann::json;

class QuantitiesCommand : public FromOutside {
 protected:
  QuantitiesCommand() { folder_.write("s.toml", sampleStudy); }
};

TEST_F(QuantitiesCommand, ListsNumbersAndOutputsWithUnitsAndValues) {
  const Outcome list = gamut("quantities s.toml");
  EXPECT_EQ(list.exitCode, 0);
  EXPECT_EQ(list.error, "");
  EXPECT_THAT(list.out, StartsWith("What can be uncertain, with its nominal value:\n  hinge.angle"));
  for (const char* line : {"  hinge.rate +0.5 rad/s\n", "  rod.length +0.5 m\n", "  bob.mass +0.25 kg\n",
                           "  gravity.z +-9.81 m/s\\^2\n", "\n\nWhat can be an output, with its value at the start:\n"})
    EXPECT_THAT(list.out, ContainsRegex(line));
}

TEST_F(QuantitiesCommand, TellsProgramsTheSame) {
  const Json json = Json::parse(gamut("quantities s.toml --json").out);
  const Mechanism mechanism = readStudyText(sampleStudy, "s.toml").mechanism;
  const std::vector<std::string> numbers = mechanism.quantities(), outputs = mechanism.outputQuantities();
  ASSERT_EQ(json["uncertain"].size(), numbers.size());
  ASSERT_EQ(json["output"].size(), outputs.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(json["uncertain"][i]["quantity"], numbers[i]);
    EXPECT_EQ(json["uncertain"][i]["unit"], mechanism.unitOf(numbers[i]));
    EXPECT_TRUE(contains(mechanism.nominal(numbers[i]), json["uncertain"][i]["nominal"].get<double>()));
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) EXPECT_EQ(json["output"][i]["quantity"], outputs[i]);
}

/// Of a chain of tolerances there is no energy, and no centre of mass.
TEST_F(QuantitiesCommand, ListsNoMachineThatIsNotThere) {
  folder_.write(
      "chain.toml",
      "[study]\ntitle = \"c\"\nanalysis = \"kinematics\"\n[mechanism.parameters]\nhousing = \"50 mm\"\nshaft = "
      "\"30 mm\"\n");
  EXPECT_EQ(
      gamut("quantities chain.toml").out,
      "What can be uncertain, with its nominal value:\n  housing  0.05 m\n  shaft    0.03 m\n\n"
      "What can be an output, with its value at the start:\n  nothing moves: any formula of the numbers above, such "
      "as \"a - 2*b\"\n");
  EXPECT_EQ(Json::parse(gamut("quantities chain.toml --json").out)["output"], Json::array());
  folder_.write("prey.toml",
                "[study]\ntitle = \"p\"\nanalysis = \"dynamics\"\n[mechanism]\n[[mechanism.element]]\ntype = "
                "\"state\"\nname = \"prey\"\ninitial = 2\nrate = \"-prey\"\n");
  const Json prey = Json::parse(gamut("quantities prey.toml --json").out)["output"];
  ASSERT_EQ(prey.size(), 1u);
  EXPECT_EQ(prey[0]["quantity"], "prey");
}

/// Half a metre below the hinge, turned by 30 degrees, at 0.5 rad/s.
TEST_F(QuantitiesCommand, GivesOutputsAtTheStart) {
  const Json json = Json::parse(gamut("quantities s.toml --json").out);
  const auto nominal = [&](const std::string& name) {
    for (const Json& output : json["output"])
      if (output["quantity"] == name) return output["nominal"].get<double>();
    throw std::logic_error("no output " + name);
  };
  EXPECT_NEAR(nominal("tip.position.z"), -0.5 * std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(nominal("tip.position.y"), 0.25, 1e-15);
  EXPECT_NEAR(nominal("energy.kinetic"), 0.5 * 0.25 * 0.25 * 0.25, 1e-15);
  EXPECT_NEAR(nominal("energy.potential"), -0.25 * 9.81 * 0.5 * std::sqrt(0.75), 1e-14);
}

TEST_F(QuantitiesCommand, EveryNameThatItListsIsTakenByAStudy) {
  const Json json = Json::parse(gamut("quantities s.toml --json").out);
  std::string study = sampleStudy.substr(0, sampleStudy.find("[[uncertain]]"));
  for (const Json& number : json["uncertain"])
    study += "[[uncertain]]\nquantity = " + number["quantity"].dump() + "\ninterval = \"± 1e-3\"\n";
  for (const Json& output : json["output"]) study += "[[output]]\nquantity = " + output["quantity"].dump() + "\n";
  EXPECT_NO_THROW(readStudyText(study, "all.toml"));
}

TEST_F(QuantitiesCommand, ServesAStudyThatIsOnlyBegun) {
  folder_.write("begun.toml", sampleStudy.substr(sampleStudy.find("[mechanism]"),
                                                 sampleStudy.find("[[uncertain]]") - sampleStudy.find("[mechanism]")));
  EXPECT_EQ(gamut("validate begun.toml").exitCode, 2);
  EXPECT_EQ(gamut("quantities begun.toml").out, gamut("quantities s.toml").out);
}

TEST_F(QuantitiesCommand, ListsAccelerationsOfWhatMovesNoMass) {
  std::string text = sampleStudyWith("analysis = \"dynamics\"", "analysis = \"kinematics\"");
  text.erase(text.find("[[mechanism.element]]\ntype = \"mass\""),
             text.find("[[uncertain]]") - text.find("[[mechanism.element]]\ntype = \"mass\""));
  folder_.write("light.toml", text);
  const Outcome listed = gamut("quantities light.toml");
  EXPECT_EQ(listed.exitCode, 0);
  EXPECT_THAT(listed.out, ::testing::HasSubstr("hinge.acceleration"));
  EXPECT_THAT(listed.out, ::testing::HasSubstr("has no value at the start"));
}

TEST_F(QuantitiesCommand, ReadsStandardInput) {
  EXPECT_EQ(gamut("quantities - < s.toml").out, gamut("quantities s.toml").out);
}

TEST_F(QuantitiesCommand, RefusesInOneLineWhatIsNoMechanism) {
  folder_.write("empty.toml", "");
  folder_.write("still.toml", "[mechanism]\ngravity = [0, 0, -9.81]\n");
  folder_.write("wrong.toml", sampleStudyWith("axis = \"x\"", "axis = \"w\""));
  for (const char* arguments : {"", "''", ".", "none.toml", "empty.toml", "still.toml", "wrong.toml", "s.toml more"}) {
    SCOPED_TRACE(arguments);
    const Outcome refused = gamut("quantities " + std::string(arguments));
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(refused.error.find('\n'), refused.error.size() - 1);
  }
  EXPECT_EQ(gamut("quantities empty.toml").error,
            "empty.toml:1:1: 'mechanism' is missing; expected a table [mechanism]\n");
}

}  // namespace
}  // namespace gamut
