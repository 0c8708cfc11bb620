// What paper and screen both compute comes out alike: page/vectors.json, which the tests of the page's scripts read
// too.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "reports/drawing/axes.hpp"
#include "reports/drawing/screen.hpp"

namespace gamut {
namespace {

using nlohmann::json;

json vectors(const char* of) {
  std::ifstream file(GAMUT_SOURCE_DIR "/tests/reports/page/vectors.json");
  return json::parse(file).at(of);
}

TEST(Vectors, TicksOfPaperAreThoseOfTheScreen) {
  for (const json& v : vectors("ticks")) {
    const Ticks ticks = ticksOf({v["low"], v["high"]}, v["wanted"]);
    EXPECT_EQ(v["at"], json(ticks.at)) << v["low"] << " to " << v["high"];
    EXPECT_EQ(v["text"], json(ticks.text));
    EXPECT_EQ(v["aside"], json(ticks.aside));
  }
  for (const json& v : vectors("padded")) {
    const Range room = Range{v["low"], v["high"]}.padded(v["share"]);
    EXPECT_EQ(json({room.low, room.high}), v["room"]);
  }
  for (const json& v : vectors("axisNames"))
    EXPECT_EQ(axisName(v["name"], {{}, {}, v["aside"]}), v["whole"].get<std::string>());
}

TEST(Vectors, NumbersAreWrittenAsTheScreenReadsThem) {
  for (const json& v : vectors("differences")) {
    std::vector<double> numbers;
    for (const json& number : v["numbers"]) numbers.push_back(number.is_null() ? NAN : number.get<double>());
    EXPECT_EQ(json::parse(secondDifferences(numbers)), v["differences"]);
  }
  for (const json& v : vectors("decimals")) EXPECT_EQ(Decimals(v["scale"]).value(v["whole"]), v["value"].get<double>());
}

}  // namespace
}  // namespace gamut
