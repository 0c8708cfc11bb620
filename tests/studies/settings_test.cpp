// Sections of study files as they describe themselves: in the guide, in the schema, as the reader takes them.
#include <gmock/gmock.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "studies/results/results.hpp"
#include "studies/schema.hpp"
#include "studies/settings.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;

std::string textIn(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(StudySections, AreWhatTheGuideShows) {
  const std::string guide = textIn(GAMUT_SOURCE_DIR "/docs/study-file.md");
  for (const StudySection& section : studySections(Study())) {
    const std::string& name = section.name;
    const bool isOfSeveral = !section.isList && !section.isRequired && name != "limits";  // in one table
    const std::string rows = guideTo(name, isOfSeveral ? name + "." : "");
    EXPECT_NE(guide.find(rows), std::string::npos) << "docs/study-file.md needs\n" << rows;
  }
}

/// Whether a validator of JSON Schema that is not ours finds nothing wrong.
bool isValid(const std::string& study) {
  static const valijson::Schema* const schema = [] {
    auto* parsed = new valijson::Schema;  // lives as long as the program
    static const nlohmann::json text = nlohmann::json::parse(studySchema());
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(text), *parsed);
    return parsed;
  }();
  std::ostringstream text;
  text << toml::json_formatter(toml::parse(study));
  const nlohmann::json json = nlohmann::json::parse(text.str());
  return valijson::Validator().validate(*schema, valijson::adapters::NlohmannJsonAdapter(json), nullptr);
}

TEST(StudySchema, AllowsAllThatIsShipped) {
  for (const auto& folder : std::filesystem::directory_iterator(GAMUT_SOURCE_DIR "/studies/examples"))
    EXPECT_TRUE(isValid(textIn(folder.path() / "study.toml"))) << folder.path();
  EXPECT_TRUE(isValid(sampleStudy));
}

/// Words that stand in the schema and in what the reader makes of them.
TEST(StudySchema, HasTheWordsThatTheReaderKnows) {
  const nlohmann::json properties = nlohmann::json::parse(studySchema())["properties"];
  std::string answers, keys;
  const Results results;
  for (const Answer* answer : results.answers()) answers += (answers.empty() ? "" : ", ") + std::string(answer->word());
  EXPECT_THAT(messageOf(sampleStudyWith("\"fuzzy\"]", "\"fuzy\"]")), HasSubstr("(one of: " + answers + ")"));
  const nlohmann::json& words = properties["study"]["properties"]["compare"]["items"]["enum"];
  EXPECT_EQ(words.size(), results.answers().size());
  for (const auto& word : words) EXPECT_THAT(answers, HasSubstr(word.get<std::string>()));
  const std::string message = messageOf(sampleStudyWith("[mechanism]", "[mechanism]\nurdf = \"r.urdf\"\nzzz = 1"));
  const std::string known = message.substr(message.find("one of: ") + 8);
  for (const auto& [key, schema] : properties["mechanism"]["properties"].items()) {
    EXPECT_THAT(known, HasSubstr(key));
    keys += (keys.empty() ? "" : ", ") + key;
  }
  EXPECT_EQ(std::ranges::count(known, ','), std::ranges::count(keys, ',')) << known;
}

struct FaultyStudy {
  std::string what, old, instead;
};

class StudySchemaRefuses : public ::testing::TestWithParam<FaultyStudy> {};

TEST_P(StudySchemaRefuses, WhatTheReaderRefuses) {
  const std::string changed = sampleStudyWith(GetParam().old, GetParam().instead);
  EXPECT_FALSE(isValid(changed));
  EXPECT_NE(messageOf(changed), "it was read");
}

INSTANTIATE_TEST_SUITE_P(
    Faults, StudySchemaRefuses,
    ::testing::Values(
        FaultyStudy{"unknownSection", "[stochastic]", "[stochastics]"},
        FaultyStudy{"unknownKey", "seed = 7", "sede = 7"},
        FaultyStudy{"unknownKeyOfAnOutput", "name = \"angle\"", "nmae = \"angle\""},
        FaultyStudy{"numberOutsideItsRange", "samples = 16", "samples = 0"},
        FaultyStudy{"textForAWholeNumber", "samples = 16", "samples = \"many\""},
        FaultyStudy{"unknownWord", "plan = \"sobol\"", "plan = \"sobel\""},
        FaultyStudy{"numberNotAbove", "[stochastic]", "[interval]\ntightness = 1\n[stochastic]"},
        FaultyStudy{"limitOfZero", "[stochastic]", "[limits]\ntime = 0\n[stochastic]"},
        FaultyStudy{"listTwice", "[\"interval\", \"stochastic\", \"fuzzy\"]", "[\"interval\", \"interval\"]"},
        FaultyStudy{"missing", "analysis = \"dynamics\"\n", ""},
        FaultyStudy{"unknownElement", "type = \"revolute\"", "type = \"revolut\""},
        FaultyStudy{"timeThatHasPassed", "horizon = 0.5", "horizon = -0.5"},
        FaultyStudy{"stepOfZero", "output_step = 0.1", "output_step = 0"},
        FaultyStudy{"directionThatIsNone", "axis = \"x\"", "axis = \"diagonal\""},
        FaultyStudy{"directionOfTwo", "axis = \"x\"", "axis = [1, 0]"},
        FaultyStudy{"unknownKeyOfAnElement", "axis = \"x\"", "aksis = \"x\""},
        FaultyStudy{"unknownMembership", "type = \"triangular\"", "type = \"triangel\""},
        FaultyStudy{"missingDeviation", "type = \"triangular\"", "type = \"gaussian\""},
        FaultyStudy{"keyOfAnotherMembership", "type = \"triangular\"", "type = \"triangular\", centre = 0.5"},
        FaultyStudy{"unknownInitialValue", "initial = { angle", "initial = { angel"}),
    [](const auto& test) { return test.param.what; });

/// What the schema cannot know is left to the reader.
TEST(StudySchema, AllowsAutoAndTextsWithUnits) {
  EXPECT_TRUE(isValid(sampleStudyWith("[stochastic]", "[interval]\norder = \"auto\"\nsplit = \"auto\"\n[stochastic]")));
  EXPECT_TRUE(isValid(sampleStudyWith("[stochastic]", "[limits]\nmemory = \"500 MB\"\n[stochastic]")));
  EXPECT_TRUE(isValid(sampleStudyWith("horizon = 0.5", "horizon = \"500 ms\"")));
}

}  // namespace
}  // namespace gamut
