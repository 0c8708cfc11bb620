// Every word that a section explains is in it, and has its meaning on the page.
#include "reports/page/glossary.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <string>

#include "reports/report.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/page_text.hpp"

namespace gamut::glossary {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Glossary, ExplainsTheWordsThatASectionUses) {
  const std::string told = termsOf("outputs", "guaranteed bounds, and the median");
  EXPECT_THAT(told, HasSubstr("popovertarget=\"term-guaranteed\">guaranteed</button>"));
  EXPECT_THAT(told, HasSubstr("popovertarget=\"term-median\">median</button>"));
  EXPECT_THAT(told, Not(HasSubstr("term-alpha-cut")));
  EXPECT_EQ(termsOf("outputs", "nothing of all this"), "");
  EXPECT_EQ(termsOf("elsewhere", "guaranteed"), "");
}

/// What the cards of requirements say is explained beside them.
TEST(Glossary, ExplainsTheWordsOfTheFirstCards) {
  Results results = example::pendulum(61, 2);
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = "floor";
  requirement.statement = "always a > 0.75";
  requirement.word = Decision::partly;
  requirement.margin = 1;
  requirement.until = results.horizon;
  requirement.factor = 0.5;
  requirement.violation.assign(results.uncertain.size(), std::nan(""));
  results.margins.push_back({1, "a", true, "0.75 rad", "rad", true, 0, 0.75, true});
  const std::string page = renderReport(results);
  const auto cards = page.find("<ul class=\"requirements\""), terms = page.find("<p class=\"terms\">", cards);
  ASSERT_NE(terms, std::string::npos);
  EXPECT_LT(terms, page.find("class=\"output foremost\""));
  const std::string told = page.substr(terms, page.find("</p>", terms) - terms);
  for (const char* id : {"shrink", "guaranteed", "probable", "possible"})
    EXPECT_THAT(told, HasSubstr("popovertarget=\"term-" + std::string(id) + "\"")) << id;
  EXPECT_THAT(told, Not(HasSubstr("term-quantile")));
  EXPECT_THAT(termsOf("found", "66 of 1024 simulated cases"),
              ::testing::AllOf(HasSubstr("term-case\">case<"), HasSubstr("term-simulated\">simulated<")));
}

TEST(Glossary, HasOneMeaningOfEachWordThatThePageExplains) {
  for (const Results& results : {example::pendulum(), example::sensitive(), example::kinematics()}) {
    const std::string page = renderReport(results), button = "popovertarget=\"";
    std::set<std::string> ids;
    for (auto at = page.find(button); at != std::string::npos; at = page.find(button, at + 1)) {
      const auto from = at + button.size();
      ids.insert(page.substr(from, page.find('"', from) - from));
    }
    EXPECT_GT(ids.size(), 4u);
    for (const std::string& id : ids) EXPECT_EQ(count(page, "popover id=\"" + id + "\""), 1u) << id;
    EXPECT_EQ(count(page, " popover id=\""), ids.size());
  }
}

/// What only some readers look for is folded, and opens without a script.
TEST(Glossary, FoldsMethodAndData) {
  const std::string page = renderReport(example::sensitive());
  for (const char* name : {"numbers", "samples", "origin"}) {
    const auto section = page.find("<section class=\"" + std::string(name) + "\" id=\"" + name + "\">");
    ASSERT_NE(section, std::string::npos) << name;
    EXPECT_LT(page.find("<details class=\"method\"><summary>", section), page.find("<table", section)) << name;
  }
}

}  // namespace
}  // namespace gamut::glossary
