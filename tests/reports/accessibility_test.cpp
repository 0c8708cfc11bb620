// Pages of shipped studies by the rules of WCAG 2.2 AA and what is held to be good practice, as axe-core knows them: in
// light and dark, on a desktop and on a phone, with all that is folded away unfolded.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "reports/report.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/reports/in_chromium.hpp"
#include "tests/studies/temporary_folder.hpp"

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

class Accessibility : public InChromium {
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
    writeReport(run(readStudy(GAMUT_SOURCE_DIR "/studies/examples/" + study + "/study.toml"), options), path);
    return path;
  }

 private:
  TemporaryFolder folder_;
};

class PageOfStudy : public Accessibility, public ::testing::WithParamInterface<const char*> {};

constexpr Chromium::Screen desktop{1400, 900}, desktopInTheDark{1400, 900, true}, phone{390, 844},
    phoneInTheDark{390, 844, true};

TEST_P(PageOfStudy, KeepsTheRulesOnEveryScreen) {
  const std::string page = pageOf(GetParam(), 200);
  for (const Chromium::Screen& screen : {desktop, desktopInTheDark, phone, phoneInTheDark})
    EXPECT_THAT(broken(page, screen), ::testing::MatchesRegex("[1-9][0-9]+ rules passed"))
        << screen.width << " pixels, " << (screen.isDark ? "dark" : "light");
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
