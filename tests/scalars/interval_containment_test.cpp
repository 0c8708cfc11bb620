// Every function of Interval holds MPFR's value at random points of random intervals, on all the ranges that are
// special to it, and is tight. The same cases by the million: tests/campaigns/scalar_campaign.cpp.
#include <algorithm>
#include <cctype>
#include <set>

#include "tests/scalars/containment.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::interval_containment_test {
namespace {

using namespace gamut::testing;

class IntervalContainment : public ::testing::TestWithParam<std::string> {};

TEST_P(IntervalContainment, HoldsTheExactValueOfEveryElementAndIsTight) {
  const auto& trials = containmentTrials();
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].function != GetParam()) continue;
    const ContainmentOutcome outcome = trials[i].run(cases, i + 1);
    EXPECT_EQ(outcome.outside, 0) << trials[i].range << ", " << outcome.first;
    EXPECT_EQ(outcome.loose, 0) << trials[i].range << ", " << outcome.first;
    EXPECT_EQ(outcome.cases, cases);
    EXPECT_LT(outcome.undefined, cases * 9 / 10) << "next to nothing was judged on " << trials[i].range;
  }
}

std::set<std::string> functionNames() {
  std::set<std::string> names;
  for (const ContainmentTrial& trial : containmentTrials()) names.insert(trial.function);
  return names;
}

std::string testName(const ::testing::TestParamInfo<std::string>& info) {
  if (info.param == "+") return "sum";
  if (info.param == "-") return "difference";
  if (info.param == "*") return "product";
  if (info.param == "/") return "quotient";
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', 'm');
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Interval, IntervalContainment, ::testing::ValuesIn(functionNames()), testName);

}  // namespace
}  // namespace gamut::interval_containment_test
