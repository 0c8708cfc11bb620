// Interval against the ITF1788 vectors (IEEE 1788 conformance, collected from libieeep1788, MPFI, FI_LIB and C-XSC),
// where that collection lies beside the source tree; skipped, and said so, where it does not.
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include "tests/scalars/reference.hpp"

namespace gamut {
namespace {

using namespace gamut::testing;
using Unary = Interval (*)(const Interval&);
using Binary = Interval (*)(const Interval&, const Interval&);
using Measure = double (*)(const Interval&);
using Predicate = bool (*)(const Interval&, const Interval&);

const std::map<std::string, Unary> unaryFunctions = {{"neg", [](const Interval& x) { return -x; }},
                                                     {"recip", [](const Interval& x) { return 1 / x; }},
                                                     {"sqr", sqr},
                                                     {"sqrt", sqrt},
                                                     {"abs", abs},
                                                     {"exp", exp},
                                                     {"log", log},
                                                     {"sin", sin},
                                                     {"cos", cos},
                                                     {"tan", tan},
                                                     {"asin", asin},
                                                     {"acos", acos},
                                                     {"atan", atan},
                                                     {"sinh", sinh},
                                                     {"cosh", cosh},
                                                     {"tanh", tanh}};
const std::map<std::string, Binary> binaryFunctions = {
    {"add", [](const Interval& x, const Interval& y) { return x + y; }},
    {"sub", [](const Interval& x, const Interval& y) { return x - y; }},
    {"mul", [](const Interval& x, const Interval& y) { return x * y; }},
    {"div", [](const Interval& x, const Interval& y) { return x / y; }},
    {"pow", pow},
    {"min", min},
    {"max", max},
    {"convexHull", hull},
    {"intersection", intersection}};
const std::map<std::string, Measure> measures = {
    {"mid", midpoint}, {"rad", radius}, {"wid", width}, {"mag", magnitude}, {"mig", mignitude}};
const std::map<std::string, Predicate> predicates = {
    {"equal", isEqual}, {"subset", isSubset}, {"interior", isInterior}, {"disjoint", isDisjoint}};

/// A number to nearest, as the vectors mean it; NaN for anything else.
double readNumber(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end == text.c_str() ? std::nan("") : value;
}

/// "[a,b]", "[empty]", "[entire]" or a number as a thin interval; nothing for NaI and other things.
std::optional<Interval> readInterval(std::string text) {
  if (text.find("empty") != std::string::npos) return Interval::empty();
  if (text.find("entire") != std::string::npos) return Interval::entire();
  if (text.front() == '[') text = text.substr(1, text.size() - 2);
  const auto comma = text.find(',');
  const double lower = readNumber(text),
               upper = comma == std::string::npos ? lower : readNumber(text.substr(comma + 1));
  if (!(lower <= upper && lower < infinity && upper > -infinity)) return {};
  return Interval(lower, upper);
}

struct Row {
  std::string operation, expected, where;
  std::vector<std::string> arguments;
};

/// "    op [a,b] [c,d] = [e,f];", comments and decorations dropped.
std::vector<Row> readRows(const std::filesystem::path& file) {
  static const std::regex form(R"(^\s*(\w+)((?:\s+(?:\[[^\]]*\]|[-+\w.]+))+)\s*=\s*(\[[^\]]*\]|[-+\w.]+)\s*;.*)");
  static const std::regex operand(R"(\[[^\]]*\]|[-+\w.]+)"), decoration(R"(\]_\w+)"), comment(R"(/\*.*?\*/|//.*)");
  std::vector<Row> rows;
  std::ifstream stream(file);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    line = std::regex_replace(std::regex_replace(line, comment, ""), decoration, "]");
    std::smatch match;
    if (!std::regex_match(line, match, form)) continue;
    const std::string operands = match[2];
    Row row{match[1], match[3], file.filename().string() + ":" + std::to_string(number) + ": " + line, {}};
    for (std::sregex_iterator i(operands.begin(), operands.end(), operand), end; i != end; ++i) {
      row.arguments.push_back(i->str());
    }
    rows.push_back(row);
  }
  return rows;
}

/// Checks one row and says whether it is about something that Interval has.
bool check(const Row& row) {
  std::vector<Interval> x;
  for (const std::string& argument : row.arguments) {
    const auto value = readInterval(argument);
    if (!value) return false;
    x.push_back(*value);
  }
  if (row.expected.find("nai") != std::string::npos) return false;
  if (const auto f = unaryFunctions.find(row.operation); f != unaryFunctions.end() && x.size() == 1) {
    EXPECT_PRED2(isEqual, f->second(x[0]), readInterval(row.expected).value()) << row.where;
  } else if (const auto g = binaryFunctions.find(row.operation); g != binaryFunctions.end() && x.size() == 2) {
    EXPECT_PRED2(isEqual, g->second(x[0], x[1]), readInterval(row.expected).value()) << row.where;
  } else if (row.operation == "pown") {
    EXPECT_PRED2(isEqual, pow(x[0], std::stoi(row.arguments[1])), readInterval(row.expected).value()) << row.where;
  } else if (const auto m = measures.find(row.operation); m != measures.end() && x.size() == 1) {
    const double expected = readNumber(row.expected), actual = m->second(x[0]);
    EXPECT_TRUE(actual == expected || (std::isnan(actual) && std::isnan(expected))) << row.where << " is " << actual;
  } else if (const auto p = predicates.find(row.operation); p != predicates.end() && x.size() == 2) {
    EXPECT_EQ(p->second(x[0], x[1]), row.expected == "true") << row.where;
  } else {
    return false;
  }
  return true;
}

TEST(Interval, GivesTheTightestResultOnEveryItf1788Vector) {
  const auto folder = std::filesystem::path(GAMUT_SOURCE_DIR).parent_path() / "shared" / "data" / "itf1788";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the ITF1788 vectors are not beside the source tree";
  int checked = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".itl") continue;
    for (const Row& row : readRows(entry.path())) checked += check(row);
  }
  RecordProperty("vectors", checked);
  EXPECT_GT(checked, 2000);
}

}  // namespace
}  // namespace gamut
