// Where an enclosure ended early, what would have let it come to the horizon.
#include <gmock/gmock.h>

#include <string>

#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/far_pendulum.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Results enclosed(const std::string& text) { return run(readStudyText(text, "s.toml")); }

// What the advice says is done then, word for word, and does.
TEST(Advice, IsOfWhatWasTried) {
  const Results results = enclosed(farPendulum("± 15 %"));
  EXPECT_EQ(results.interval.advice, "± 7.5 % instead of ± 15 % of start, by which it reaches 3 s (tried)");
  EXPECT_EQ(results.requirements[0].advice, results.interval.advice);
  const Results followed = enclosed(farPendulum("± 7.5 %"));
  EXPECT_EQ(followed.interval.reached, 3) << followed.interval.why;
  EXPECT_EQ(enclosed(farPendulum("± 15 %")).interval.advice, results.interval.advice);
}

TEST(Advice, IsTheSettingThatEndedIt) {
  std::string text = farPendulum("± 15 %");
  const std::string pieces = "max_pieces = 1";
  text.replace(text.find(pieces), pieces.size(), "split = false");
  const Results results = enclosed(text);
  ASSERT_LT(results.interval.reached, 3);
  EXPECT_EQ(results.interval.advice, "interval.split = true, by which it reaches 3 s (tried)");
}

TEST(Advice, IsNotGuessed) {
  const Results results = enclosed(farPendulum("± 15 %", "[limits]\nadvice = 0\n"));
  ASSERT_LT(results.interval.reached, 3);
  EXPECT_THAT(results.interval.advice, Not(HasSubstr("tried")));
  EXPECT_THAT(results.interval.advice, Not(HasSubstr("start")));
}

TEST(Advice, DependsOnNoThreads) {
  const Study study = readStudyText(farPendulum("± 15 %"), "s.toml");
  RunOptions options;
  options.jobs = 3;
  const Results three = run(study, options), one = run(study, {});
  EXPECT_EQ(three.interval.advice, one.interval.advice);
}

}  // namespace
}  // namespace gamut
