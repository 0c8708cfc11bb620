// Studies in JSON: the same study as in TOML, numbers as they are written, and mistakes by line and column of the JSON.
#include <gmock/gmock.h>
#include <toml++/toml.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "studies/reading/json_text.hpp"
#include "studies/study.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace json_study_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using Json = nlohmann::ordered_json;

/// In the order of the file; numbers as the shortest decimals.
Json jsonOf(const toml::node& node) {
  if (const toml::table* table = node.as_table()) {
    std::vector<std::pair<toml::source_position, std::string>> keys;
    for (const auto& [key, value] : *table) keys.emplace_back(key.source().begin, std::string(key.str()));
    std::sort(keys.begin(), keys.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    Json object = Json::object();
    for (const auto& [place, key] : keys) object[key] = jsonOf(*table->get(key));
    return object;
  }
  if (const toml::array* list = node.as_array()) {
    Json array = Json::array();
    for (const toml::node& each : *list) array.push_back(jsonOf(each));
    return array;
  }
  if (node.is_string()) return node.as_string()->get();
  if (node.is_integer()) return node.as_integer()->get();
  if (node.is_boolean()) return node.as_boolean()->get();
  return node.as_floating_point()->get();
}

std::string inJson(const std::string& toml) { return jsonOf(toml::parse(std::string_view(toml))).dump(2); }

/// What tells two studies apart.
std::string sumOf(const Study& study) {
  std::ostringstream sum;
  sum.precision(17);
  sum << study.title << ' ' << study.horizon << ' ' << study.times.size() << ' ' << study.levels << '\n';
  for (const std::string& name : study.mechanism.quantities()) {
    const Interval x = study.mechanism.nominal(name);
    sum << name << ' ' << x.lower() << ' ' << x.upper() << '\n';
  }
  for (const UncertainQuantity& u : study.uncertain)
    sum << u.quantity << ' ' << u.uncertain.range.lower() << ' ' << u.uncertain.range.upper() << '\n';
  for (const WantedOutput& output : study.outputs) sum << output.name << ' ' << output.quantity << '\n';
  return sum.str();
}

TEST(JsonStudy, SaysWhatTheSameInTomlSays) {
  EXPECT_EQ(sumOf(readStudyText(inJson(sampleStudy), "s.json")), sumOf(readStudyText(sampleStudy, "s.toml")));
  for (const std::string name : {"four_bar", "quarter_car", "triple_pendulum", "tolerance_stack", "cart_and_pole"}) {
    const std::string path = GAMUT_SOURCE_DIR "/studies/examples/" + name + "/study.toml", toml = textOfStudy(path);
    EXPECT_EQ(sumOf(readStudyText(inJson(toml), path)), sumOf(readStudyText(toml, path))) << name;
  }
}

TEST(JsonStudy, KeepsDecimalsAndEscapes) {
  const std::string json = inJson(sampleStudyWith("\"Pendulum\"", R"("A \"quoted\" \\ tab\u00e4 😀")"));
  EXPECT_EQ(readStudyText(json, "s.json").title, "A \"quoted\" \\ tab\u00e4 😀");
  const TomlOfJson toml =
      tomlOfJson("{\"a\": {\"b.c\": [0.1000000000000000000001, -1E+5, true], \"d\": \"\\ud83d\\ude00\\/\"}, \"e\": 1}");
  EXPECT_EQ(toml.text, "\"a\" = { \"b.c\" = [0.1000000000000000000001, -1E+5, true], \"d\" = \"😀/\" }\n\"e\" = 1\n");
  EXPECT_EQ(toml.fault, "");
}

TEST(JsonStudy, TellsWhereAMistakeIsInTheJson) {
  const std::string head = "{\n  \"study\": {\n    \"title\": \"ä\", \"horizn\": 1\n  }\n}\n";
  EXPECT_THAT(messageOf(head, "s.json"),
              StartsWith("s.json:3:19: unknown key 'horizn' in [study]; expected 'horizon'"));
  const std::string json = R"({
  "study": {"title": "P", "analysis": "dynamics", "horizon": 0.5, "output_step": 0.1},
  "mechanism": {"gravity": [0, 0, -9.81], "element": [
    {"type": "revolute", "name": "hinge", "from": "inertial", "to": "K", "axis": "x",
     "initial": {"angle": "30 deg"}},
    {"type": "mass", "name": "bob", "at": "K",
     "mass": "1 kgg", "centre": [0, 0, -1]}
  ]},
  "output": [{"quantity": "hinge.angle"}]
})";
  EXPECT_THAT(messageOf(json, "s.json"), StartsWith("s.json:7:14: mechanism.element.mass: "));
  EXPECT_EQ(messageOf("{}", "s.json").substr(0, 10), "s.json:1:1");
  EXPECT_EQ(messageOf("\n {\"study\": 7}", "s.json"), "s.json:2:12: study is the number 7; expected a table");
}

TEST(JsonStudy, RefusesWhatIsNoJsonInOneLine) {
  const auto expect = [](const std::string& json, const std::string& what) {
    const std::string said = messageOf(json, "s.json");
    EXPECT_THAT(said, StartsWith("s.json:" + what)) << json;
    EXPECT_EQ(said.find('\n'), std::string::npos);
    EXPECT_EQ(std::count(said.begin(), said.end(), ';'), 1) << said;
  };
  expect("{\n\"study\": {]}\n}", "2:11: not valid JSON: ");
  expect("{\"study\": {", "1:12: not valid JSON: ");
  expect("{\n\"a\": 1,\n\"a\": 2}", "3:1: 'a' is given twice; expected one value for each key");
  expect("{\"study\": null}", "1:11: null says nothing in a study; expected a value, or no such key");
  expect("{\"study\": 1} x", "1:14: not valid JSON: ");
  expect("{\"a\": 1e999}", "1:1: a number is too large");
  std::string deep = "{\"a\": ";
  for (int i = 0; i < 100'000; ++i) deep += "[";
  expect(deep, "1:1: lists and tables are nested too deeply");
  expect("{'a': 1}", "1:2: not valid JSON: ");
}

}  // namespace json_study_test
}  // namespace gamut
