// Numbers that are infinite, missing, huge or tiny, anywhere in the results: the page is drawn all the same, and no
// drawing holds what is no number.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reports/drawing/axes.hpp"
#include "reports/drawing/paper.hpp"
#include "reports/json.hpp"
#include "reports/report.hpp"
#include "reports/requirements.hpp"
#include "reports/summary.hpp"
#include "tests/reports/example_results.hpp"

namespace gamut {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), greatest = std::numeric_limits<double>::max(),
                 least = std::numeric_limits<double>::denorm_min();

/// What stands in the drawings' attributes that should be a number and is none; empty if all are.
std::string wrongNumber(const std::string& page) {
  static const std::regex attribute(
      R"re( (?:d|x|y|dy|r|cx|cy|width|height|transform|viewBox)="[^"]*(?:nan|inf|e\+|NaN)[^"]*")re");
  for (std::size_t svg = page.find("<svg"); svg != std::string::npos; svg = page.find("<svg", svg + 1)) {
    const std::string drawing = page.substr(svg, page.find("</svg>", svg) - svg);
    std::smatch found;
    if (std::regex_search(drawing, found, attribute)) return found.str().substr(0, 200);
  }
  return "";
}

/// The first script of numbers that is no JSON; empty if all are.
std::string wrongScript(const std::string& page) {
  const std::string open = "<script type=\"application/json\"";
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at + 1)) {
    const std::size_t begin = page.find('>', at) + 1, end = page.find("</script>", begin);
    if (!nlohmann::json::accept(page.substr(begin, end - begin))) return page.substr(begin, end - begin);
  }
  return "";
}

void expectDrawn(const Results& results) {
  const std::string page = renderReport(results);
  EXPECT_EQ(wrongNumber(page), "");
  EXPECT_EQ(wrongScript(page), "");
  EXPECT_NE(textSummary(results), "");
  EXPECT_TRUE(nlohmann::json::accept(jsonSummary(results, findVerdict(results))));
  wordsOfRequirements(results);
}

/// Calls `change` with every number that the results describe.
void forEachNumber(Results& results, const std::function<void(const Field&, std::vector<double>&)>& change) {
  for (const Group& group : describe(results))
    for (std::size_t i = 0; i < group.size; ++i)
      for (const Field& field : group.fields(i)) {
        if (!field.indexOf.empty()) continue;
        std::visit(Visitor{[&](double* number) {
                             std::vector<double> one{*number};
                             change(field, one);
                             *number = one[0];
                           },
                           [&](const Numbers& numbers) {
                             for (std::size_t end = 0; end < numbers.ends().size(); ++end)
                               for (std::vector<double>* list : numbers.lists(end)) change(field, *list);
                           },
                           [](auto) {}},
                   field.value);
      }
}

/// Those of the axes, which rise.
bool isTime(const Field& field) { return field.name == "time" || field.name == "samples"; }

std::vector<std::pair<const char*, Results>> examples() {
  return {{"pendulum", example::pendulum(31, 2, 4)},    {"two times", example::pendulum(2, 1, 2)},
          {"kinematics", example::kinematics()},        {"machine", example::machine()},
          {"machine in space", example::machine(true)}, {"sensitive", example::sensitive()}};
}

TEST(Unbounded, BoundsAreDrawnWhateverTheyAre) {
  for (const double lower : {-inf, -greatest, -1e300, 0.0, 1e300, greatest})
    for (const double upper : {least, 1e300, greatest, inf}) {
      if (lower > upper) continue;
      SCOPED_TRACE(::testing::Message() << lower << " to " << upper);
      for (auto& [name, results] : examples()) {
        SCOPED_TRACE(name);
        for (Bounds* bounds : {&results.interval.at, &results.interval.over, &results.interval.direct}) {
          bounds->lower.data.assign(bounds->lower.data.size(), lower);
          bounds->upper.data.assign(bounds->upper.data.size(), upper);
        }
        expectDrawn(results);
      }
    }
}

TEST(Unbounded, AnyFieldOfAnyPartMayHoldAnything) {
  constexpr double values[] = {inf,      -inf,      std::numeric_limits<double>::quiet_NaN(),
                               greatest, -greatest, least,
                               -least,   1e300,     -1e300,
                               1e-300,   1e54,      -1e54,
                               0,        1,         -1};
  std::mt19937_64 random(1);
  for (auto& [name, whole] : examples())
    for (int round = 0; round < 60; ++round) {
      SCOPED_TRACE(::testing::Message() << name << ", round " << round);
      Results results = whole;
      const std::uint64_t share = 1 + random() % 8;
      forEachNumber(results, [&](const Field& field, std::vector<double>& numbers) {
        if (random() % share != 0 || isTime(field)) return;
        const bool isAll = random() % 2 == 0;
        const double common = values[random() % std::size(values)];
        for (double& number : numbers) {
          const double value = isAll ? common : values[random() % std::size(values)];
          const bool isAllowed = std::isnan(value) || (value >= field.allowed.least && value <= field.allowed.greatest);
          if (isAllowed && (isAll || random() % 4 == 0)) number = value;
        }
      });
      expectDrawn(results);
    }
}

TEST(Unbounded, AxesHaveFiniteEnds) {
  for (const auto& [low, high] : {std::pair(-greatest, greatest),
                                  {greatest, inf},
                                  {-inf, inf},
                                  {least, 2 * least},
                                  {-1e300, 1e300},
                                  {1e299, 1e300},
                                  {0.0, 1e-305}}) {
    Range range;
    range.hold(low);
    range.hold(high);
    const Range room = range.padded(0.04);
    EXPECT_LT(room.low, room.high);
    EXPECT_TRUE(std::isfinite(room.high - room.low));
    const Ticks ticks = ticksOf(room, 5);
    EXPECT_GE(ticks.at.size(), 2U) << low << " to " << high;
    for (const std::string& text : ticks.text) EXPECT_THAT(text, ::testing::Not(::testing::ContainsRegex("nan|inf")));
  }
}

TEST(Unbounded, APenLeavesOutWhatIsNoPlace) {
  Pen pen;
  pen.go(std::nan(""), 1);
  pen.close();
  EXPECT_TRUE(pen.isEmpty());
  pen.go(1, 2);
  pen.go(3, std::nan(""));
  pen.go(inf, -inf);
  EXPECT_EQ(pen.take(), "M1 2M1000000-1000000");
}

}  // namespace
}  // namespace gamut
