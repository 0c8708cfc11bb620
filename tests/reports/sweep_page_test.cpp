// The page of a sweep: what it says, shows and how large it becomes.
#include "reports/sweep_page.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/reports/in_chromium.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut::sweep_page_test {

using ::testing::HasSubstr;
using ::testing::Not;

/// Of a requirement that is met where the number of the point is odd, of probability and possibility that rise with it.
SweepResults swept(const SweepPlan& plan) {
  SweepResults sweep;
  sweep.plan = plan;
  sweep.title = "A <sweep> & more";
  sweep.outputs = {{"height", "tip.position.z", "m"}};
  sweep.requirements = {{"slow", "always abs(hinge.rate) < 1"}};
  prepare(sweep);
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    const double share = static_cast<double>(p) / static_cast<double>(sweep.points.size());
    std::vector<double> numbers(requirementColumns().size() + outputColumns().size(), share);
    numbers[static_cast<std::size_t>(OfRequirement::word)] =
        static_cast<double>(p % 2 == 1 ? Decision::met : Decision::partly);
    SweepPoint point;
    point.number = static_cast<std::int64_t>(p);
    point.state = PointState::done;
    put(sweep, point, numbers);
  }
  return sweep;
}

SweepAxis axis(const std::string& name, std::size_t count) {
  SweepAxis made{name, "mm", {}};
  for (std::size_t i = 0; i < count; ++i) made.values.push_back(1.5 * static_cast<double>(i));
  return made;
}

std::size_t countOf(const std::string& page, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = page.find(text); at != std::string::npos; at = page.find(text, at + 1)) ++count;
  return count;
}

TEST(SweepPage, DrawsCurvesOfOneNumber) {
  const std::string page = renderSweep(swept({true, {axis("length", 7)}}));
  EXPECT_THAT(page, HasSubstr("<h1>A &lt;sweep&gt; &amp; more</h1>"));
  EXPECT_THAT(page, HasSubstr("Over length from 0 to 9 mm"));
  EXPECT_THAT(page, HasSubstr("The requirement is guaranteed at 3 of 7 points."));
  EXPECT_THAT(page, HasSubstr("7 points: met at 3, violated at 0, for some values at 4, open at 0"));
  EXPECT_EQ(countOf(page, "<rect class=\"met\""), 3U);
  EXPECT_EQ(countOf(page, "<rect class=\"partly\""), 4U);
  EXPECT_EQ(countOf(page, "<path class=\"share\""), 1U);
  EXPECT_EQ(countOf(page, "<path class=\"necessity\""), 1U);
  EXPECT_THAT(page, HasSubstr("length (mm)"));
  EXPECT_THAT(page, Not(HasSubstr(">nan")));
  EXPECT_THAT(page, Not(HasSubstr("\"nan\"")));
}

TEST(SweepPage, DrawsMapsOfTwo) {
  const std::string page = renderSweep(swept({true, {axis("length", 5), axis("mass", 4)}}));
  EXPECT_EQ(countOf(page, "<rect class=\"met\"") + countOf(page, "<rect class=\"partly\""), 20U);
  EXPECT_EQ(countOf(page, "<rect class=\"share\""), 20U);
  EXPECT_EQ(countOf(page, "<rect class=\"necessity\""), 20U);
  EXPECT_EQ(countOf(page, "<rect class=\"value\""), 40U);
  EXPECT_THAT(page, HasSubstr("<title>length = 1.5 mm, mass = 3 mm: met with a probability of "));
}

TEST(SweepPage, DrawsSlicesOfMore) {
  const std::string page = renderSweep(swept({true, {axis("a", 2), axis("b", 2), axis("c", 3), axis("d", 20)}}));
  EXPECT_EQ(countOf(page, "<h4>"), 48U);  // of the requirement and of the output
  EXPECT_THAT(page, HasSubstr("<h4>c = 1.5 mm, d = 4.5 mm</h4>"));
  EXPECT_THAT(page, HasSubstr("And 36 more; the results hold them."));
}

TEST(SweepPage, ListsPointsThatAreNoGrid) {
  const std::string page = renderSweep(swept({false, {axis("a", 3), axis("b", 3)}}));
  EXPECT_THAT(page, HasSubstr("a = 3 mm, b = 3 mm"));
  EXPECT_THAT(page, HasSubstr("<h2>Points</h2>"));
  EXPECT_EQ(countOf(page, "<svg"), 0U);
}

TEST(SweepPage, SaysWhatIsMissing) {
  SweepResults sweep = swept({true, {axis("a", 3)}});
  SweepPoint refused;
  refused.number = 1;
  refused.state = PointState::refused;
  refused.why = "the loop <C> does not close";
  put(sweep, refused, {});
  sweep.points[2].state = PointState::open;
  SweepPoint open;
  open.number = 2;
  put(sweep, open, {});
  const std::string page = renderSweep(sweep);
  EXPECT_THAT(page, HasSubstr("1 not run yet, 1 done, 1 cannot be run."));
  EXPECT_THAT(page, HasSubstr("<html lang=\"en\" data-run=\"partial\">"));
  EXPECT_EQ(countOf(page, "<rect class=\"none\""), 2U);
  EXPECT_THAT(page, HasSubstr("the loop &lt;C&gt; does not close"));
  EXPECT_THAT(page, HasSubstr("a = 1.5 mm: the loop"));
}

TEST(SweepPage, StaysSmallHoweverManyPoints) {
  EXPECT_LT(renderSweep(swept({true, {axis("a", 21), axis("b", 21)}})).size(), 700'000U);
  EXPECT_LT(renderSweep(swept({true, {axis("a", 300), axis("b", 300)}})).size(), 20'000'000U);
}

using SweepPageInBrowser = InChromium;

/// Of four outputs and three requirements over 21 x 21 points.
TEST_F(SweepPageInBrowser, OpensInTwoSeconds) {
  SweepResults sweep;
  sweep.plan = {true, {axis("a", 21), axis("b", 21)}};
  sweep.outputs.resize(4, {"height", "tip.position.z", "m"});
  sweep.requirements.resize(3, {"slow", "always abs(hinge.rate) < 1"});
  prepare(sweep);
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    std::vector<double> numbers(3 * requirementColumns().size() + 4 * outputColumns().size());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>((7 * p + i) % 441) / 441;
    SweepPoint point;
    point.number = static_cast<std::int64_t>(p);
    point.state = PointState::done;
    put(sweep, point, numbers);
  }
  const TemporaryFolder folder;
  folder.write("empty.html", "<!doctype html><title>Nothing</title>");
  folder.write("sweep.html", renderSweep(sweep));
  const double nothing = chromium->cpuToOpen(folder.path("empty.html"), {}),
               page = chromium->cpuToOpen(folder.path("sweep.html"), {});
  EXPECT_GT(page, nothing);
  EXPECT_LT(page, 2) << "an empty page takes " << nothing << " s";
  RecordProperty("milliseconds_of_cpu", static_cast<int>(1000 * page));
}

}  // namespace gamut::sweep_page_test
