// Results as tables: every number that results describe stands in one of them, gives the same double back, and bounds
// stay bounds.
#include "reports/tables.hpp"

#include <gmock/gmock.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <sstream>

#include "scalars/interval.hpp"
#include "tests/studies/sample_results.hpp"

namespace gamut {
namespace tables_test {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

double backFrom(const std::string& text) {
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

TEST(ExactDecimal, GivesTheSameDoubleBackAndStaysABound) {
  std::mt19937_64 random(17);
  int longer = 0;
  for (int i = 0; i < 20000; ++i) {
    double x = 0;
    const std::uint64_t bits = i < 10000 ? random() : 0;
    std::memcpy(&x, &bits, sizeof x);
    if (i >= 10000) x = std::ldexp(static_cast<double>(random() >> 11U), static_cast<int>(random() % 80) - 90);
    if (!std::isfinite(x)) continue;
    const std::string nearest = exactDecimal(x), below = exactDecimal(x, RoundedTo::below),
                      above = exactDecimal(x, RoundedTo::above);
    EXPECT_EQ(backFrom(nearest), x);
    EXPECT_EQ(backFrom(below), x) << below;
    EXPECT_EQ(backFrom(above), x) << above;
    // The decimal's own tightest enclosure tells where it lies.
    EXPECT_LE(Interval(below).upper(), x) << below;
    EXPECT_GE(Interval(above).lower(), x) << above;
    EXPECT_LE(std::max(below.size(), above.size()), 26U) << below << ' ' << above;
    longer += below != nearest;
  }
  EXPECT_GT(longer, 5000) << "half of all shortest decimals lie above";
  EXPECT_EQ(exactDecimal(0.1), "0.1");
  EXPECT_EQ(exactDecimal(0.1, RoundedTo::below), "0.1");
  EXPECT_EQ(exactDecimal(0.1, RoundedTo::above), "1.0000000000000001e-01");
  EXPECT_EQ(exactDecimal(std::numeric_limits<double>::quiet_NaN(), RoundedTo::above), "");
  EXPECT_EQ(exactDecimal(-std::numeric_limits<double>::infinity(), RoundedTo::below), "-inf");
}

/// Cells of lines; no cell of the sample holds a line break but those in quotes.
std::vector<std::vector<std::string>> cellsOf(const std::string& csv) {
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
  bool isQuoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    const bool isDoubled = c == '"' && isQuoted && i + 1 < csv.size() && csv[i + 1] == '"';
    if (c == '"' && !isDoubled)
      isQuoted = !isQuoted;
    else if (c == ',' && !isQuoted)
      rows.back().emplace_back();
    else if (c == '\n' && !isQuoted)
      rows.emplace_back(1);
    else
      rows.back().back() += c;
    if (isDoubled) ++i;
  }
  EXPECT_EQ(rows.back(), std::vector<std::string>(1)) << "the last line is ended";
  rows.pop_back();
  return rows;
}

std::string tableOf(const std::vector<ResultTable>& tables, const std::string& name) {
  for (const ResultTable& table : tables)
    if (table.name == name) return table.csv();
  ADD_FAILURE() << "there is no table " << name;
  return "";
}

TEST(ResultTables, HaveRowsOfTimesAndColumnsOfOutputsWithUnits) {
  const Results results = sampleResults();
  const std::vector<ResultTable> tables = tablesOf(results);
  const auto bounds = cellsOf(tableOf(tables, "interval.time"));
  ASSERT_EQ(bounds.size(), 4U);
  EXPECT_EQ(bounds[0][0], "time (s)");
  const auto column = [&](const std::string& name) {
    const auto found = std::ranges::find(bounds[0], name);
    EXPECT_NE(found, bounds[0].end()) << name << ' ' << ::testing::PrintToString(bounds[0]);
    return static_cast<std::size_t>(found - bounds[0].begin());
  };
  std::string lower;
  for (const std::string& name : bounds[0])
    if (name.starts_with("tip height: ") && name.find("lower") != std::string::npos &&
        name.find("over") == std::string::npos)
      lower = name;
  ASSERT_THAT(lower, ::testing::EndsWith(" (m)"));
  EXPECT_EQ(backFrom(bounds[1][column(lower)]), results.interval.at.lower(0, 0));
  EXPECT_EQ(backFrom(bounds[2][column(lower)]), results.interval.at.lower(1, 0));
  EXPECT_EQ(bounds[3][column(lower)], "") << "there is none";
}

TEST(ResultTables, HaveOneOfSingleNumbersAndOneOfEachList) {
  const Results results = sampleResults();
  const std::vector<ResultTable> tables = tablesOf(results);
  const std::string values = tableOf(tables, "values");
  EXPECT_THAT(values, StartsWith("path,value,unit,meaning\n"));
  EXPECT_THAT(values, HasSubstr("/study/seed,18446744073709551615,"));
  EXPECT_THAT(cellsOf(values), Contains(std::vector<std::string>{"/study/text", results.studyText, "",
                                                                 "the study file, word for word"}));
  const auto outputs = cellsOf(tableOf(tables, "study.outputs"));
  ASSERT_EQ(outputs.size(), 3U);
  EXPECT_EQ(outputs[1][0], "tip height");
  EXPECT_EQ(outputs[2][2], "J");
  EXPECT_EQ(cellsOf(tableOf(tables, "requirements")).size(), results.requirements.size() + 1);
}

/// Every row is as long as the head, as many as are told; and all that is described is somewhere.
TEST(ResultTables, HoldAllThatResultsDescribe) {
  Results results = sampleResults();
  const std::vector<ResultTable> tables = tablesOf(results);
  std::set<std::string> names;
  std::size_t cells = 0;
  for (const ResultTable& table : tables) {
    EXPECT_TRUE(names.insert(table.name).second) << table.name;
    const auto rows = cellsOf(table.csv());
    EXPECT_EQ(rows.size(), table.rows + 1) << table.name;
    for (const auto& row : rows) EXPECT_EQ(row.size(), table.columns) << table.name;
    EXPECT_EQ(std::set<std::string>(rows[0].begin(), rows[0].end()).size(), rows[0].size())
        << table.name << ' ' << ::testing::PrintToString(rows[0]);
    cells += table.rows * table.columns;
  }
  std::size_t numbers = 0;
  for (const Group& group : describe(results))
    for (std::size_t i = 0; i < group.size; ++i)
      for (const Field& field : group.fields(i)) {
        if (isScale(group, field)) continue;
        if (const auto* several = std::get_if<Numbers>(&field.value))
          for (std::size_t end = 0; end < several->ends().size(); ++end)
            for (const auto* list : several->lists(end)) numbers += list->size();
        else
          ++numbers;
      }
  EXPECT_GE(cells, numbers);
}

}  // namespace tables_test
}  // namespace gamut
