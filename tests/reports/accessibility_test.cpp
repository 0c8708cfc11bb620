// Pages of shipped studies by the rules of WCAG 2.2 AA and what is held to be good practice, as axe-core knows them: in
// light and dark, on a desktop and on a phone, with all that is folded away unfolded. Their first screens besides, as
// pictures: pictures_test.cpp says how they are kept. A study is run once for both.
#include <gmock/gmock.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "reports/report.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/reports/kept_pictures.hpp"

namespace gamut::accessibility {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class Accessibility : public KeptPictures {
 protected:
  /// A line for each rule that the page breaks, with the first element that does; last, how many rules were passed.
  /// `before`: what a script does to the page first.
  static std::string broken(const std::string& page, const Chromium::Screen& screen, const std::string& before = "") {
    static const std::string axe = textOf(GAMUT_AXE);
    EXPECT_GT(axe.size(), 100'000u);
    return chromium->found(
        page,
        axe +
            ";const root = document.documentElement, frame = () => new Promise(then => requestAnimationFrame(then));"
            "while (root.dataset.page !== 'ready' || root.dataset.plots === 'waiting') await frame();"
            "for (const details of document.querySelectorAll('details')) details.open = true;"
            // As if all of it had been in sight: what has not takes up another room than it will.
            "document.head.insertAdjacentHTML('beforeend', '<style>section { content-visibility: visible !important; "
            "}</style>');"
            "await frame(); await frame(); await frame();" +
            before +
            ";const tags = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];"
            "const said = await axe.run(document, { runOnly: { type: 'tag', values: tags }, "
            "  resultTypes: ['violations'] });"
            "return said.violations.map(({ id, nodes }) => id + ' of ' + nodes.length + ': ' + nodes[0].html + '; ' +"
            "  nodes[0].failureSummary + '\\n').join('') + said.passes.length + ' rules passed';",
        screen);
  }

  /// The page of a shipped study, of so many samples.
  std::string pageOf(const std::string& study, std::size_t samples) const {
    RunOptions options;
    options.samples = samples;
    const std::string path = folder_.path(study + ".html");
    Results results = run(readStudy(GAMUT_SOURCE_DIR "/studies/examples/" + study + "/study.toml"), options);
    results.date.clear();  // nothing that is seen of it is another one tomorrow
    writeReport(results, path);
    return path;
  }
};

class PageOfStudy : public Accessibility, public ::testing::WithParamInterface<const char*> {
 protected:
  static inline const Place studyPictures{"study_pictures", 2};

  static std::vector<Picture> firstScreensOf(const std::string& study) {
    return {{study + "_desktop", {1200, 860}},
            {study + "_phone", {390, 844}},
            {study + "_dark", {1200, 860, true}},
            {study + "_paper", {720, 980, false, true}},
            {study + "_deuteranopia", {1200, 860, false, false, true}}};
  }
};

constexpr Chromium::Screen desktop{1400, 900}, desktopInTheDark{1400, 900, true}, phone{390, 844},
    phoneInTheDark{390, 844, true};

TEST_P(PageOfStudy, KeepsTheRulesOnEveryScreen) {
  const std::string page = pageOf(GetParam(), 200);
  for (const Chromium::Screen& screen : {desktop, desktopInTheDark, phone, phoneInTheDark})
    EXPECT_THAT(broken(page, screen), ::testing::MatchesRegex("[1-9][0-9]+ rules passed"))
        << screen.width << " pixels, " << (screen.isDark ? "dark" : "light");
  if (const std::string other = differenceOfSample(); !other.empty())
    std::cout << "no pictures are compared, letters and lines are drawn otherwise here: " << other;
  else
    EXPECT_EQ(difference(page, firstScreensOf(GetParam()), studyPictures), "") << "drawn in " << GAMUT_PICTURES;
}

TEST(StudyPictures, AreSmall) {
  std::uintmax_t sum = 0, count = 0;
  for (const auto& file : std::filesystem::directory_iterator(GAMUT_SOURCE_DIR "/tests/reports/study_pictures")) {
    sum += file.file_size();
    ++count;
  }
  EXPECT_EQ(count, 30u);
  EXPECT_LE(sum, 700'000u);
}

INSTANTIATE_TEST_SUITE_P(Accessibility, PageOfStudy,
                         ::testing::Values("quarter_car", "simple_pendulum", "tip_position", "tolerance_stack",
                                           "toggle_switch", "robot_arm_reach"));

/// One of each kind, planted: a faint word, a button and a picture without names, tables that keys cannot scroll.
TEST_F(Accessibility, IsToldOfRulesThatAreBroken) {
  const std::string page = pageOf("tip_position", 50);
  EXPECT_THAT(broken(page, phone,
                     "document.querySelector('main').insertAdjacentHTML('beforeend', '<p style=\"color: #999; "
                     "background: #fff\">faint</p><button></button><img src=\"data:,\">');"
                     "for (const table of document.querySelectorAll('.table')) table.removeAttribute('tabindex');"),
              AllOf(HasSubstr("color-contrast of 1"), HasSubstr("button-name of 1"), HasSubstr("image-alt of 1"),
                    HasSubstr("scrollable-region-focusable of ")));
}

}  // namespace
}  // namespace gamut::accessibility
