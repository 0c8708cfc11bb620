// Interval against conformance vectors, whose every row says which interval IEEE 1788 has as the tightest: our own in
// vectors/, always; and the collection ITF1788 (from libieeep1788, MPFI, FI_LIB and C-XSC), where it lies beside the
// source tree, skipped, and said so, where it does not. The table that the collection's test prints:
//   test_scalars --gtest_filter='*Itf1788*'
#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>

#include "tests/scalars/conformance/itf1788.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::interval_itf1788_test {
namespace {

using namespace gamut::testing;
using Kind = ItfValue::Kind;

// ---- IEEE 1788's names and ours -------------------------------------------------------------------------------------

/// tight: what the row says, exactly. valid: an interval around it. failed: anything else.
enum class Grade { tight, valid, failed };
/// Nothing where the row is not of the form that the operation has.
using Operation = std::function<std::optional<Grade>(const ItfRow&)>;

bool isOfForm(const ItfRow& row, std::initializer_list<Kind> operands, std::initializer_list<Kind> results) {
  const auto same = [](const ItfValue& value, Kind kind) { return value.kind == kind; };
  return std::equal(row.operands.begin(), row.operands.end(), operands.begin(), operands.end(), same) &&
         std::equal(row.results.begin(), row.results.end(), results.begin(), results.end(), same);
}

Grade grade(const Interval& result, const Interval& expected) {
  if (isEqual(result, expected)) return Grade::tight;
  return isSubset(expected, result) ? Grade::valid : Grade::failed;
}
Grade grade(double result, double expected) {
  return result == expected || (std::isnan(result) && std::isnan(expected)) ? Grade::tight : Grade::failed;
}

using X = const Interval&;

Operation unary(Interval (*f)(X)) {
  return [f](const ItfRow& row) -> std::optional<Grade> {
    if (!isOfForm(row, {Kind::interval}, {Kind::interval})) return {};
    return grade(f(row.operands[0].interval), row.results[0].interval);
  };
}
Operation binary(Interval (*f)(X, X)) {
  return [f](const ItfRow& row) -> std::optional<Grade> {
    if (!isOfForm(row, {Kind::interval, Kind::interval}, {Kind::interval})) return {};
    return grade(f(row.operands[0].interval, row.operands[1].interval), row.results[0].interval);
  };
}
Operation withInteger(Interval (*f)(X, int)) {
  return [f](const ItfRow& row) -> std::optional<Grade> {
    if (!isOfForm(row, {Kind::interval, Kind::number}, {Kind::interval})) return {};
    return grade(f(row.operands[0].interval, static_cast<int>(row.operands[1].number)), row.results[0].interval);
  };
}
Operation measure(double (*f)(X)) {
  return [f](const ItfRow& row) -> std::optional<Grade> {
    if (!isOfForm(row, {Kind::interval}, {Kind::number})) return {};
    return grade(f(row.operands[0].interval), row.results[0].number);
  };
}
Operation property(bool (*f)(X)) {
  return [f](const ItfRow& row) -> std::optional<Grade> {
    if (!isOfForm(row, {Kind::interval}, {Kind::truth})) return {};
    return f(row.operands[0].interval) == row.results[0].truth ? Grade::tight : Grade::failed;
  };
}
Operation relation(bool (*f)(X, X)) {
  return [f](const ItfRow& row) -> std::optional<Grade> {
    if (!isOfForm(row, {Kind::interval, Kind::interval}, {Kind::truth})) return {};
    return f(row.operands[0].interval, row.operands[1].interval) == row.results[0].truth ? Grade::tight : Grade::failed;
  };
}

/// Of what is no interval the vectors say "[empty] signal UndefinedOperation", where Gamut throws. Where they say
/// "PossiblyUndefinedOperation" an implementation that cannot decide about lower <= upper gives the enclosure instead:
/// Gamut decides, so it may do either.
Grade gradeConstruction(const ItfRow& row, const std::function<Interval()>& construct) {
  try {
    const Interval x = construct();
    return row.signal == "UndefinedOperation" ? Grade::failed : grade(x, row.results[0].interval);
  } catch (const std::invalid_argument&) {
    return row.signal.empty() ? Grade::failed : Grade::tight;
  }
}
std::optional<Grade> fromText(const ItfRow& row) {
  if (!isOfForm(row, {Kind::text}, {Kind::interval})) return {};
  return gradeConstruction(row, [&] { return Interval::parse(row.operands[0].text); });
}
/// The same without the decoration that the text ends in.
std::optional<Grade> fromDecoratedText(ItfRow row) {
  if (row.operands.size() == 1) row.operands[0].text = row.operands[0].text.substr(0, row.operands[0].text.find('_'));
  return fromText(row);
}
std::optional<Grade> fromNumbers(const ItfRow& row) {
  if (!isOfForm(row, {Kind::number, Kind::number}, {Kind::interval})) return {};
  return gradeConstruction(row, [&] { return Interval(row.operands[0].number, row.operands[1].number); });
}
std::optional<Grade> isMember(const ItfRow& row) {
  if (!isOfForm(row, {Kind::number, Kind::interval}, {Kind::truth})) return {};
  const bool is = contains(row.operands[1].interval, row.operands[0].number);
  return is == row.results[0].truth ? Grade::tight : Grade::failed;
}
std::optional<Grade> midpointAndRadius(const ItfRow& row) {
  if (!isOfForm(row, {Kind::interval}, {Kind::number, Kind::number})) return {};
  const Interval x = row.operands[0].interval;
  return std::max(grade(midpoint(x), row.results[0].number), grade(radius(x), row.results[1].number));
}

const std::map<std::string, Operation> operations = {
    {"pos", unary([](X x) { return +x; })},
    {"neg", unary([](X x) { return -x; })},
    {"add", binary([](X x, X y) { return x + y; })},
    {"sub", binary([](X x, X y) { return x - y; })},
    {"mul", binary([](X x, X y) { return x * y; })},
    {"div", binary([](X x, X y) { return x / y; })},
    {"recip", unary([](X x) { return 1 / x; })},
    {"sqr", unary(sqr)},
    {"sqrt", unary(sqrt)},
    {"cbrt", unary(cbrt)},
    {"rootn", withInteger(rootn)},
    {"hypot", binary(hypot)},
    {"pown", withInteger(pow)},
    {"pow", binary(pow)},
    {"exp", unary(exp)},
    {"exp2", unary(exp2)},
    {"exp10", unary(exp10)},
    {"expm1", unary(expm1)},
    {"log", unary(log)},
    {"log2", unary(log2)},
    {"log10", unary(log10)},
    {"logp1", unary(log1p)},
    {"sin", unary(sin)},
    {"cos", unary(cos)},
    {"tan", unary(tan)},
    {"asin", unary(asin)},
    {"acos", unary(acos)},
    {"atan", unary(atan)},
    {"atan2", binary(atan2)},
    {"sinh", unary(sinh)},
    {"cosh", unary(cosh)},
    {"tanh", unary(tanh)},
    {"asinh", unary(asinh)},
    {"acosh", unary(acosh)},
    {"atanh", unary(atanh)},
    {"abs", unary(abs)},
    {"min", binary(min)},
    {"max", binary(max)},
    {"sign", unary(sign)},
    {"floor", unary(floor)},
    {"ceil", unary(ceil)},
    {"trunc", unary(trunc)},
    {"roundTiesToAway", unary(round)},
    {"roundTiesToEven", unary(roundEven)},
    {"convexHull", binary(hull)},
    {"intersection", binary(intersection)},
    // Of the empty interval IEEE 1788 has inf = +inf and sup = -inf, Gamut NaN.
    {"inf", measure([](X x) { return isEmpty(x) ? infinity : x.lower(); })},
    {"sup", measure([](X x) { return isEmpty(x) ? -infinity : x.upper(); })},
    {"mid", measure(midpoint)},
    {"rad", measure(radius)},
    {"midRad", midpointAndRadius},
    {"wid", measure(width)},
    {"mag", measure(magnitude)},
    {"mig", measure(mignitude)},
    {"isEmpty", property(isEmpty)},
    {"isEntire", property(isEntire)},
    {"isSingleton", property(isThin)},
    {"isCommonInterval", property(isCommon)},
    {"isMember", isMember},
    {"equal", relation(isEqual)},
    {"subset", relation(isSubset)},
    {"interior", relation(isInterior)},
    {"disjoint", relation(isDisjoint)},
    // IEEE 1788 claims these of empty intervals, Gamut's 'certainly' never does.
    {"precedes", relation([](X x, X y) { return isEmpty(x) || isEmpty(y) || certainlyLessOrEqual(x, y); })},
    {"strictPrecedes", relation([](X x, X y) { return isEmpty(x) || isEmpty(y) || certainlyLess(x, y); })},
    {"b-textToInterval", fromText},
    {"d-textToInterval", fromDecoratedText},
    {"b-numsToInterval", fromNumbers},
    {"d-numsToInterval", fromNumbers}};

// ---- The run --------------------------------------------------------------------------------------------------------

struct Count {
  int rows = 0, tight = 0, valid = 0, failed = 0, aboutNaI = 0;
};

struct Outcome {
  std::map<std::string, Count> counts, leftOut;  // by operation; of those that Interval has not, the rows alone
  int rows = 0;
  Count all;  // of the operations that Interval has
};

/// Every row of the vectors in a folder. A row that fails, or is not tight, is a failure of the test.
Outcome runVectors(const std::filesystem::path& folder) {
  Outcome run;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".itl") continue;
    for (const ItfRow& row : readItf(entry.path())) {
      ++run.rows;
      const auto operation = operations.find(row.operation);
      if (operation == operations.end()) {
        ++run.leftOut[row.operation].rows;
        continue;
      }
      Count& count = run.counts[row.operation];
      if (row.isAboutNaI()) {
        ++count.aboutNaI;
        continue;
      }
      const std::optional<Grade> result = operation->second(row);
      if (!result) ADD_FAILURE() << "not of the operation's form: " << row.where;
      if (result == Grade::failed) ADD_FAILURE() << "failed: " << row.where;
      if (result == Grade::valid) ADD_FAILURE() << "valid, not tight: " << row.where;
      ++count.rows;
      count.tight += result == Grade::tight;
      count.valid += result == Grade::valid;
      count.failed += !result || result == Grade::failed;
    }
  }
  for (const auto& [name, count] : run.counts) {
    run.all.rows += count.rows;
    run.all.tight += count.tight;
    run.all.valid += count.valid;
    run.all.failed += count.failed;
    run.all.aboutNaI += count.aboutNaI;
  }
  EXPECT_EQ(run.counts.size(), operations.size()) << "an operation has no rows";
  return run;
}

TEST(Interval, IsTheTightestOnOurVectorsOfEveryOperation) {
  const Outcome run = runVectors(std::filesystem::path(GAMUT_SOURCE_DIR) / "tests/scalars/conformance/vectors");
  EXPECT_EQ(run.rows, 1423);  // the lines that end in ;
  EXPECT_EQ(run.all.tight, run.rows);
  for (const auto& [name, count] : run.counts) EXPECT_GE(count.tight, 6) << name;
}

TEST(Interval, IsTheTightestOnTheItf1788VectorsOfEveryOperation) {
  const auto folder = std::filesystem::path(GAMUT_SOURCE_DIR).parent_path() / "shared" / "data" / "itf1788";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "the collection ITF1788 is not beside the source tree; our own vectors are run without it";

  const Outcome run = runVectors(folder);
  std::printf("%-18s %5s %5s %5s %6s %14s\n", "operation", "rows", "tight", "valid", "failed", "NaI, not run");
  const auto print = [](const char* name, const Count& c) {
    std::printf("%-18s %5d %5d %5d %6d %14d\n", name, c.rows, c.tight, c.valid, c.failed, c.aboutNaI);
  };
  for (const auto& [name, count] : run.counts) print(name.c_str(), count);
  print("all", run.all);
  int rowsLeftOut = 0;
  std::printf("operations that Interval has not:");
  for (const auto& [name, count] : run.leftOut) {
    std::printf("%s %s %d", rowsLeftOut == 0 ? "" : ",", name.c_str(), count.rows);
    rowsLeftOut += count.rows;
  }
  std::printf("; together %d of %d rows\n", rowsLeftOut, run.rows);

  EXPECT_EQ(run.rows, 9542);  // counted by an independent reader of the same files
  EXPECT_EQ(run.all.rows, 6018);
  EXPECT_EQ(run.all.aboutNaI, 73);
}

TEST(Itf1788Reader, RefusesWhatItCannotReadInsteadOfDroppingIt) {
  const auto file = std::filesystem::temp_directory_path() / "gamut_unreadable.itl";
  for (const char* text : {"testcase a { sqr [1,2 = [1,4]; }", "testcase a { sqr [1,2] [1,4]; }", "sqr [1,2] = [1,4];",
                           "testcase a { sqr [1,2] = [1,4] }", "testcase a { sqr ?? = [1,4]; }",
                           "testcase a { sqr [x,2] = [1,4]; }", "testcase a { sqr [1,2] = [1,4];"}) {
    std::FILE* stream = std::fopen(file.c_str(), "w");
    ASSERT_NE(stream, nullptr);
    std::fputs(text, stream);
    std::fclose(stream);
    try {
      readItf(file);
      ADD_FAILURE() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("gamut_unreadable.itl:1: "));
    }
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace gamut::interval_itf1788_test
