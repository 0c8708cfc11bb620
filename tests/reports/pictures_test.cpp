// How the page looks: pictures of results that are made from formulas, compared with those in pictures/; those of
// shipped studies, with theirs in study_pictures/, in accessibility_test.cpp. Who has changed the page looks at what
// the tests have drawn, in tests/reports/pictures of the build folder, and keeps it:
//   GAMUT_KEEP_PICTURES=1 build/release/tests/test_reports --gtest_filter='Pictures.*:*PageOfStudy*'
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/report.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/kept_pictures.hpp"

namespace gamut::pictures {
namespace {

/// Of an output what is known of another one: times `factor`, and moved.
void copyOutput(Results& results, std::size_t from, std::size_t to, double factor, double offset) {
  const auto line = [&](Table& table) {
    for (std::size_t i = 0; i < table.times; ++i) table(i, to) = factor * table(i, from) + offset;
  };
  const auto band = [&](Bounds& bounds) {
    line(bounds.lower);
    line(bounds.upper);
    for (std::size_t i = 0; factor < 0 && i < bounds.lower.times; ++i)
      std::swap(bounds.lower(i, to), bounds.upper(i, to));
  };
  for (Bounds* bounds : {&results.interval.at, &results.interval.over, &results.stochastic.envelope}) band(*bounds);
  for (std::vector<Bounds>* cuts : {&results.fuzzy.outer, &results.fuzzy.inner})
    for (Bounds& cut : *cuts) band(cut);
  line(results.stochastic.mean);
  std::vector<Table>& quantiles = results.stochastic.quantiles;
  for (Table& quantile : quantiles) line(quantile);
  for (std::size_t q = 0; factor < 0 && q < quantiles.size() / 2; ++q)
    for (std::size_t i = 0; i < quantiles[q].times; ++i)
      std::swap(quantiles[q](i, to), quantiles[quantiles.size() - 1 - q](i, to));
}

/// The polynomial 1 + η/2 - ζ/4 times `size` of the first output, at an output time.
void describeCauses(SurrogateResult& s, std::size_t row, double nominal, double size) {
  s.present = true;
  s.part = {0};
  s.term = s.number = {0, 1, 2};
  s.centre = {2.3, 1, 0};
  s.half = {0.0223, 0.1, 0};
  s.row = {static_cast<double>(row)};
  s.firstTerm = {0};
  s.partCentre = {0, 0, 0};
  s.partHalf = {1, 1, 1};
  s.exponent = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  s.first = {0, 0, 0, 0};
  s.count = {3, 0, 0, 0};
  s.radius = {1e-4, std::nan(""), std::nan(""), std::nan("")};
  s.coefficient = {nominal, 0.6 * size, -0.35 * size};
}

/// A pendulum of three quantities, two outputs and a requirement on each, of which one can fail at 1.5 s.
Results judged() {
  constexpr std::size_t row = 30;
  constexpr double floor = -2.01, ceiling = 2.5;
  Results results = example::pendulum(61, 4);
  results.picture = example::machine().picture;
  results.date.clear();
  results.uncertain = {{"first angle", "shoulder.angle", "rad", 2.2777, 2.3, 2.3223, "uniform", "triangular"},
                       {"mass", "tip.mass", "kg", 0.9, 1, 1.1, "normal", "triangular"},
                       {"length", "rod.length", "m", 0.495, 0.5, 0.505, "triangular", "triangular"}};
  results.outputs[2] = {"not too far", "", "rad"};
  results.outputs[3] = {"arm clears the frame", "", "rad"};
  copyOutput(results, 0, 2, 1, -floor);
  copyOutput(results, 1, 3, -1, ceiling);
  results.margins = {{2, "'shoulder angle'", true, "-2.01 rad", "rad", true, 0, floor, true},
                     {3, "'elbow angle'", false, "2.5 rad", "rad", true, 1, ceiling, true}};
  results.requirements.present = true;
  results.requirements.resize(2);
  RequirementResult& fails = results.requirements[0];
  fails.name = "not too far";
  fails.statement = "always 'shoulder angle' > -2.01 rad";
  fails.word = Decision::partly;
  fails.margin = 2;
  fails.violation = {2.3223, 0.9, 0.505};
  fails.violationSample = 17;
  fails.violationTime = results.time[row];
  fails.violationLower = fails.violationUpper = -0.0513;
  fails.probabilityLower = 0.9214;
  fails.probabilityUpper = 0.9306;
  fails.met = 0.9;
  fails.violated = 0.06;
  fails.factor = 0.58;
  fails.aloneLower = {0.25, 0, 0};
  fails.aloneUpper = {0.26, 0, 0};
  fails.samples = 4096;
  fails.violating = 307;
  fails.violationLeast = 0.41;
  fails.violationMost = 0.43;
  RequirementResult& holds = results.requirements[1];
  holds.name = "arm clears the frame";
  holds.statement = "always 'elbow angle' < 2.5 rad";
  holds.word = Decision::met;
  holds.margin = 3;
  holds.met = holds.factor = holds.probabilityLower = 1;
  holds.violation.assign(3, std::nan(""));
  holds.aloneLower = holds.aloneUpper = {1, 1, 1};
  holds.samples = 4096;
  holds.violationMost = 0;
  for (RequirementResult& requirement : results.requirements) requirement.until = results.horizon;
  describeCauses(results.surrogate, row, 0.5 * (results.interval.at.lower(row, 0) + results.interval.at.upper(row, 0)),
                 0.5 * (results.interval.at.upper(row, 0) - results.interval.at.lower(row, 0)));
  return results;
}

constexpr const char* atOutputs =
    "document.querySelector('.listed details.panel').open = true; await drawn();"
    "seen('#outputs');";

class Pictures : public KeptPictures {
 protected:
  static inline const Place kept{"pictures"};
  static inline const std::vector<Picture> all = {{"desktop", {1200, 860}},
                                                  {"phone", {390, 1600}},
                                                  {"dark", {1200, 860, true}},
                                                  {"paper", {720, 980, false, true}},
                                                  {"outputs", {1200, 860}, atOutputs},
                                                  {"outputs_deuteranopia", {1200, 860, false, false, true}, atOutputs},
                                                  {"desktop_deuteranopia", {1200, 860, false, false, true}},
                                                  {"machine", {1200, 860}, "seen('#moving');"}};

  void SetUp() override {
    KeptPictures::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    writeReport(judged(), page_);
    if (const std::string other = differenceOfSample(); !other.empty())
      GTEST_SKIP() << "letters and lines are drawn otherwise here than in what is kept: " << other;
  }

  /// `before`: done to the page besides.
  std::string differenceOf(const std::string& name, const std::string& before) {
    Picture picture = *std::ranges::find(all, name, &Picture::name);
    picture.doing = before + ";" + picture.doing;
    return difference(page_, {picture}, kept);
  }

  const std::string page_ = folder_.path("report.html");
};

TEST_F(Pictures, AreThoseThatAreKept) { EXPECT_EQ(difference(page_, all, kept), "") << "drawn in " << GAMUT_PICTURES; }

TEST_F(Pictures, AreSmall) {
  std::uintmax_t sum = 0;
  for (const auto& file : std::filesystem::directory_iterator(GAMUT_SOURCE_DIR "/tests/reports/pictures")) {
    EXPECT_LE(file.file_size(), 75'000u) << file.path();
    sum += file.file_size();
  }
  EXPECT_LE(sum, 600'000u);
  EXPECT_GT(sum, 0u);
}

/// Planted: another red, a card that is moved by some pixels, a word, a band that is gone.
TEST_F(Pictures, TellWhatHasChanged) {
  if (isKeeping()) return;
  const auto changed = [&](const char* name, const std::string& style) {
    return differenceOf(name, "document.head.insertAdjacentHTML('beforeend', '<style>" + style + "</style>');");
  };
  EXPECT_EQ(changed("desktop", ""), "");
  EXPECT_THAT(changed("desktop", ":root { --outside: #801a1a; }"), ::testing::HasSubstr("differ"));
  EXPECT_THAT(changed("desktop", ".requirements li { margin-left: 3px; }"), ::testing::HasSubstr("differ"));
  EXPECT_THAT(changed("phone", ".chips { display: none; }"), ::testing::HasSubstr("differ"));
  EXPECT_THAT(changed("outputs", ".moment .beside-possible { display: none; }"), ::testing::HasSubstr("differ"));
  EXPECT_THAT(differenceOf("desktop", "document.querySelector('.requirements b').textContent = 'kept';"),
              ::testing::HasSubstr("differ"));
}

}  // namespace
}  // namespace gamut::pictures
