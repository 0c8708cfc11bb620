// Two results beside each other: what changed is said, of what both have and of what only one has.
#include "reports/comparison_page.hpp"

#include <gmock/gmock.h>

#include <string>

#include "tests/reports/example_results.hpp"
#include "tests/studies/sample_results.hpp"

namespace gamut::comparison_page_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string pageOf(const Results& a, const Results& b) {
  return renderComparison(compareResults(a, b), a, b, {"a <1>.h5", "b.h5"});
}

/// All bounds of one output, so many times as wide about their middle.
void widen(Bounds& bounds, std::size_t output, double times) {
  for (std::size_t i = 0; i < bounds.lower.times; ++i) {
    const double middle = 0.5 * (bounds.lower(i, output) + bounds.upper(i, output)),
                 half = 0.5 * times * (bounds.upper(i, output) - bounds.lower(i, output));
    bounds.lower(i, output) = middle - half;
    bounds.upper(i, output) = middle + half;
  }
}

TEST(ComparisonPage, IsOnePageOfBoth) {
  const Results results = example::pendulum();
  const std::string page = pageOf(results, results);
  EXPECT_THAT(page,
              AllOf(HasSubstr("A: a &lt;1&gt;.h5 ("), HasSubstr("B: b.h5 ("), HasSubstr("class=\"of-a"),
                    HasSubstr("class=\"of-b"), HasSubstr(".of-b{stroke:var(--of-b);stroke-width:1.6;stroke-dasharray"),
                    HasSubstr("A: guaranteed"), HasSubstr("B: guaranteed"), ::testing::EndsWith("</html>\n")));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("a <1>")), Not(HasSubstr("wider:")), Not(HasSubstr("narrower:")),
                          Not(HasSubstr("slower")), Not(HasSubstr("nan"))));
}

TEST(ComparisonPage, SaysWhatBecameWiderAndNarrower) {
  const Results a = example::pendulum();
  Results b = a;
  widen(b.interval.at, 0, 1.5);
  b.interval.over = {};
  Results narrower = a;
  widen(narrower.interval.at, 1, 0.5);
  narrower.interval.over = {};
  EXPECT_THAT(pageOf(a, b), HasSubstr("<b>guaranteed, wider:</b> " + a.outputs[0].name + " (1.5 times)</li>"));
  EXPECT_THAT(pageOf(b, a), HasSubstr("<b>guaranteed, narrower:</b> " + a.outputs[0].name + " (0.667 times)</li>"));
  EXPECT_THAT(pageOf(a, narrower),
              HasSubstr("<b>guaranteed, narrower:</b> " + a.outputs[1].name + " (0.5 times)</li>"));
}

TEST(ComparisonPage, SaysWhichRequirementsAreBetterOrWorse) {
  Results a = sampleResults();
  ASSERT_FALSE(a.requirements.empty());
  RequirementResult& before = a.requirements.front();
  before.word = Decision::partly;
  before.isViolatedInSimulation = false;
  before.probabilityLower = 0.4;
  before.probabilityUpper = 0.5;
  Results b = a;
  RequirementResult& now = b.requirements.front();
  now.word = Decision::met;
  EXPECT_THAT(pageOf(a, b), HasSubstr("<b>requirements, better:</b> " + before.name));
  EXPECT_THAT(pageOf(b, a), HasSubstr("<b>requirements, worse:</b> " + before.name));
  now.word = Decision::partly;
  now.probabilityLower = 0.1;  // that it is met
  now.probabilityUpper = 0.2;
  EXPECT_THAT(pageOf(a, b), AllOf(HasSubstr("<b>requirements, worse:</b> " + before.name),
                                  HasSubstr("worse: likelier to be violated")));
  EXPECT_THAT(pageOf(b, a), HasSubstr("better: less likely to be violated"));
  now.probabilityUpper = 0.45;  // both may be the same
  EXPECT_THAT(pageOf(a, b), AllOf(Not(HasSubstr("likelier")), HasSubstr("as it was")));
}

TEST(ComparisonPage, BeginsWithHowManyRequirementsAreBetterOrWorse) {
  Results a = sampleResults();
  ASSERT_FALSE(a.requirements.empty());
  a.requirements.resize(1, a.requirements.front());
  a.requirements.front().word = Decision::met;
  const auto leadOf = [](const Results& from, const Results& to) {
    const std::string page = pageOf(from, to), mark = "<h2 class=\"lead\">";
    const std::size_t begin = page.find(mark) + mark.size();
    return page.substr(begin, page.find('<', begin) - begin);
  };
  Results b = a;
  EXPECT_EQ(leadOf(a, b), "The requirement that both have is neither better nor worse in B.");
  b.requirements.front().word = Decision::open;
  EXPECT_EQ(leadOf(a, b), "The requirement that both have is worse in B.");
  EXPECT_EQ(leadOf(b, a), "The requirement that both have is better in B.");
  for (Results* results : {&a, &b})
    for (const char* name : {"second", "third"}) {
      results->requirements.push_back(a.requirements.front());
      results->requirements.back().name = name;
    }
  EXPECT_EQ(leadOf(a, b), "Of 3 requirements in common 1 is worse in B.");
  EXPECT_EQ(leadOf(b, a), "Of 3 requirements in common 1 is better in B.");
  a.requirements.back().word = Decision::open;
  EXPECT_EQ(leadOf(a, b), "Of 3 requirements in common 1 is better and 1 is worse in B.");
  b = a;
  EXPECT_EQ(leadOf(a, b), "Of 3 requirements in common none is better or worse in B.");
  b.requirements.back().from += 0.25;
  EXPECT_EQ(leadOf(a, b),
            "Of 2 requirements in common none is better or worse in B. One requirement asks something else in B, which "
            "is not compared.");
  for (RequirementResult& requirement : b.requirements) requirement.from = a.requirements.back().from + 0.25;
  EXPECT_EQ(leadOf(a, b), "3 requirements ask something else in B, which is not compared.");
  EXPECT_THAT(pageOf(a, b), HasSubstr("requirement: third"));
}

/// What one of them knows for a part of the motion only is neither narrower nor cheaper.
TEST(ComparisonPage, ComparesNoWidthsOfOtherSpans) {
  const Results a = example::pendulum();
  Results b = a;
  widen(b.interval.at, 0, 1.5);
  b.interval.over = {};
  b.interval.reached = 0.5 * a.interval.reached;
  EXPECT_THAT(pageOf(a, b), AllOf(HasSubstr("known for other spans:"), Not(HasSubstr("wider:"))));
  EXPECT_THAT(pageOf(b, a), AllOf(HasSubstr("known for other spans:"), Not(HasSubstr("narrower:"))));
  b.interval = {};  // nothing is guaranteed; samples are of one span
  EXPECT_THAT(pageOf(a, b), Not(HasSubstr("known for other spans:")));
}

TEST(ComparisonPage, SaysWhatOnlyOneHasAndWhatWasAskedOtherwise) {
  const Results a = example::pendulum();
  Results b = a;
  b.outputs[1].name = "another";
  b.outputs[0].quantity = "another.angle";
  b.uncertain[0].upper += 0.5;
  b.seed = a.seed + 1;
  const std::string page = pageOf(a, b);
  EXPECT_THAT(page, AllOf(HasSubstr("only in A: output " + a.outputs[1].name), HasSubstr("only in B: output another"),
                          HasSubstr("uncertain: " + a.uncertain[0].name), HasSubstr("seed "),
                          HasSubstr("output: " + a.outputs[0].name), HasSubstr("another.angle")));
  EXPECT_THAT(page, Not(HasSubstr("<h3>another")));
}

TEST(ComparisonPage, DrawsBothWhereTheirTimesDiffer) {
  const Results a = example::pendulum(61), b = example::pendulum(31);
  const std::string page = pageOf(a, b);
  EXPECT_THAT(page, AllOf(HasSubstr("class=\"of-a"), HasSubstr("class=\"of-b"), Not(HasSubstr("nan"))));
}

TEST(ComparisonPage, ComparesWhereNoTimePasses) {
  const Results results = example::kinematics();
  EXPECT_THAT(pageOf(results, results),
              AllOf(HasSubstr("class=\"of-a"), HasSubstr("width in A"), Not(HasSubstr("at 0 s"))));
}

TEST(ComparisonPage, NeedsSomethingInCommon) {
  const Results a = example::pendulum();
  Results b = a;
  for (OutputInfo& output : b.outputs) output.name += "'";
  EXPECT_THROW(pageOf(a, b), NotComparable);
}

}  // namespace
}  // namespace gamut::comparison_page_test
