// The page in a real browser: every plot is drawn, nothing goes wrong, and without a script the drawings are there.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "reports/report.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/in_chromium.hpp"
#include "tests/reports/page_text.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Browser : public InChromium {
 protected:
  /// What becomes of the page of these results once its scripts have run and its plots are drawn.
  /// `doing`: what a reader does then, as the body of an asynchronous function. What it notes is waited for; after
  /// `await laidOut()` plots have followed what it changed.
  std::string opened(const Results& results, const std::string& doing = "", const Chromium::Screen& screen = {}) {
    const std::string page = folder_.path("report.html");
    writeReport(results, page);
    // Frames are drawn after callbacks, and observers of sizes are told before the next one begins.
    return chromium->found(
        page,
        "const root = document.documentElement, frame = () => new Promise(then => requestAnimationFrame(then));"
        "const laidOut = async () => { await frame(); await frame(); };"
        "const isDone = () => root.dataset.page === 'ready' && root.dataset.plots !== 'waiting';"
        "while (!isDone() && root.dataset.error == null) await frame();"
        "let isNoted = false; const note = text => { const place = document.createElement('pre');"
        "  place.id = 'noted'; place.textContent = text; document.body.append(place); isNoted = true; };" +
            doing + ";await laidOut();" +
            (doing.find("note") == std::string::npos
                 ? ""
                 : "while (!isNoted && root.dataset.error == null) await frame();") +
            "return root.outerHTML;",
        screen);
  }

 private:
  TemporaryFolder folder_;
};

/// The opening tag of the whole page, where the script says how it went.
std::string rootOf(const std::string& page) {
  const auto from = page.find("<html"), to = page.find('>', from);
  return from == std::string::npos ? "" : page.substr(from, to - from);
}

/// Text that a reader's script leaves in the page.
std::string noted(const std::string& page) {
  const std::string begin = "<pre id=\"noted\">";
  const auto from = page.find(begin);
  return from == std::string::npos ? ""
                                   : page.substr(from + begin.size(), page.find("</pre>", from) - from - begin.size());
}

/// What a reader's script has joined by "|next|".
std::vector<std::string> parted(const std::string& text) {
  const std::string between = "|next|";
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t to = text.find(between); to != std::string::npos; to = text.find(between, from)) {
    parts.push_back(text.substr(from, to - from));
    from = to + between.size();
  }
  parts.push_back(text.substr(from));
  return parts;
}

/// What a reader does who unfolds all outputs.
const char* const unfolded =
    "for (const panel of document.querySelectorAll('details.panel')) panel.open = true; await laidOut(); await "
    "laidOut();";

/// What is folded away is not drawn before somebody unfolds it.
TEST_F(Browser, DrawsTheForemostOutputAndWhatIsUnfolded) {
  const Results results = example::pendulum(301, 3);
  const std::string page = opened(results);
  EXPECT_THAT(rootOf(page), AllOf(HasSubstr("data-page=\"ready\""), Not(HasSubstr("data-error"))));
  EXPECT_EQ(count(page, "<canvas"), 1u);
  EXPECT_EQ(count(page, "class=\"output plotted\""), 0u);
  EXPECT_EQ(count(page, "class=\"output foremost plotted\""), 1u);
  EXPECT_EQ(count(opened(results, unfolded), "class=\"output plotted\""), 3u);
  EXPECT_EQ(count(opened(results,
                         "document.querySelectorAll('details.panel')[1].open = true; await laidOut();"
                         "await laidOut();"),
                  "<canvas"),
            2u);
  EXPECT_EQ(count(opened(results, unfolded), "<canvas"), 4u);
}

/// Above their lines, which would go through them: what draws the axes leaves another baseline behind.
TEST_F(Browser, WritesLimitsOnTheirBaselines) {
  Results results = example::pendulum();
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = "clearance";
  requirement.statement = "always a > 0";
  requirement.word = Decision::met;
  requirement.isAlways = true;
  requirement.margin = 1;
  requirement.margins = 1;
  results.margins.push_back({1, "a", true, "0 rad", "rad", true, 1, 0, true});
  requirement.until = results.horizon;
  requirement.violation.assign(results.uncertain.size(), std::numeric_limits<double>::quiet_NaN());
  const std::string page = opened(
      results, std::string(unfolded) +
                   "const seen = new Set(), write = CanvasRenderingContext2D.prototype.fillText;"
                   "CanvasRenderingContext2D.prototype.fillText = function (text, ...where) {"
                   "  if (text.startsWith('limit')) seen.add(this.textBaseline); write.call(this, text, ...where); };"
                   "document.body.style.width = '700px'; await laidOut(); note([...seen].join(' '));");
  EXPECT_THAT(page, HasSubstr("<pre id=\"noted\">alphabetic</pre>"));
}

TEST_F(Browser, MakesASwitchOfEveryKeyAndView) {
  const std::string page = opened(example::pendulum(61, 2), unfolded);
  EXPECT_EQ(count(page, "<button type=\"button\" aria-pressed="), 6u + 2u * 3u);  // layers once, three views an output
  EXPECT_THAT(page, HasSubstr("Spread around the median"));
}

/// Of fifty outputs at two thousand times a page stays small, and one plot is drawn as it opens.
TEST_F(Browser, OpensFiftyOutputsFoldedAway) {
  Results results = example::pendulum(2000, 50, 11);
  results.uncertain.resize(10, results.uncertain[0]);
  EXPECT_LT(renderReport(results).size(), 8'000'000u);
  int elements = 0, milliseconds = 0;
  const std::string page =
      opened(results,
             "note([document.querySelectorAll('canvas').length, document.querySelectorAll('.row').length,"
             "  document.querySelectorAll('*').length, "
             "Math.round(performance.getEntriesByType('navigation')[0].loadEventEnd)].join(' '));");
  EXPECT_THAT(noted(page), ::testing::StartsWith("1 50 "));
  std::istringstream(noted(page).substr(5)) >> elements >> milliseconds;
  EXPECT_LT(elements, 10'000) << "14 812 with all drawings for paper";
  RecordProperty("milliseconds_to_load", milliseconds);
}

/// A page of many outputs would take long to read else: until an output is unfolded, or all are printed, its drawings
/// for paper are text.
TEST_F(Browser, ReadsDrawingsOnceTheyAreSeen) {
  const std::string page = opened(
      example::pendulum(61, 5),
      "const found = [], count = () => found.push(document.querySelectorAll('.listed .static svg').length);"
      "found.push(document.querySelectorAll('.foremost .static svg').length); count();"
      "document.querySelectorAll('.listed details.panel')[2].open = true; await laidOut(); await laidOut(); count();"
      "found.push(document.querySelectorAll('.listed .static')[2].querySelectorAll('svg').length);"
      "window.dispatchEvent(new Event('beforeprint')); count(); note(found.join(' '));");
  EXPECT_EQ(noted(page), "1 0 3 3 15");
}

/// Whatever else goes wrong.
TEST_F(Browser, ReadsDrawingsWhereAScriptFails) {
  const std::string page =
      opened(example::pendulum(61, 3),
             "setTimeout(() => { throw new Error('planted'); }); while (root.dataset.error == null) await frame();"
             "document.body.dataset.drawings = document.querySelectorAll('.listed .static svg').length;");
  EXPECT_THAT(page, HasSubstr("data-drawings=\"9\""));
}

/// All outputs begin with their motions; whoever asks sees a spread, with a limit where that comes near to it.
TEST_F(Browser, ShowsTheMotionFirst) {
  const std::string page = opened(example::pendulum(61, 2), unfolded);
  EXPECT_EQ(count(page, "<button type=\"button\" aria-pressed=\"true\">Motion</button>"), 2u);
  EXPECT_THAT(page, HasSubstr("<section class=\"output plotted\" data-output=\"0\" data-view=\"absolute\""));
  const std::string other = opened(
      example::pendulum(61, 2), std::string(unfolded) + "document.querySelectorAll('.views')[0].children[1].click();");
  EXPECT_THAT(other, HasSubstr("data-output=\"0\" data-view=\"spread\""));
}

/// Two outputs of three times, of which the second is limited: at 5 from below, far above where it ever is.
Results limited() {
  Results results = example::pendulum(61, 2);
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = "ceiling";
  requirement.statement = "always b < 5";
  requirement.word = Decision::met;
  requirement.margin = requirement.margins = 1;
  requirement.until = results.horizon;
  requirement.violation.assign(results.uncertain.size(), std::numeric_limits<double>::quiet_NaN());
  results.margins.push_back({1, "b", false, "5 rad", "rad", true, 1, 5, true});
  return results;
}

/// The shapes beside a plot lie on its axis: where the guaranteed ends are drawn, the plot has these values; and so
/// they do of a spread and after a zoom. Limits are seen, however far away.
TEST_F(Browser, SetsWhatIsKnownAtATimeBesideThePlotOnTheSameAxis) {
  const std::string measure =
      "const found = [], shown = () => {"
      "  const svg = document.querySelectorAll('.listed svg.beside')[1], moment = "
      "svg.querySelector('g.moment:not([hidden])');"
      "  const ends = moment.querySelector('.beside-guaranteed').getBoundingClientRect();"
      "  const plot = document.querySelectorAll('.listed .u-over')[1].getBoundingClientRect();"
      "  found.push([moment.dataset.at, (plot.bottom - ends.bottom).toFixed(0), (plot.bottom - ends.top).toFixed(0),"
      "    plot.height.toFixed(0), moment.dataset.low, moment.dataset.high].join(' ')); };";
  const std::string page =
      opened(limited(), std::string(unfolded) + measure +
                            "shown(); document.querySelectorAll('.listed .views')[1].children[1].click();"
                            "await laidOut(); shown(); note(found.join('|next|'));");
  const std::vector<std::string> found = parted(noted(page));
  ASSERT_EQ(found.size(), 2u);
  struct Shown {
    double at = 0, bottom = 0, top = 0, height = 0, low = 0, high = 0;
  } motion, spread;
  std::istringstream(found[0]) >> motion.at >> motion.bottom >> motion.top >> motion.height >> motion.low >>
      motion.high;
  std::istringstream(found[1]) >> spread.at >> spread.bottom >> spread.top >> spread.height >> spread.low >>
      spread.high;
  EXPECT_NEAR(motion.at, 1.3, 1e-9);  // where the margin is least
  // The axis comes from the least that is guaranteed of the motion to the limit, with four percent of room.
  const Results results = limited();
  double low = INFINITY;
  for (std::size_t i = 0; i < 61; ++i) low = std::min(low, results.interval.over.lower(i, 1));
  const double width = (5 - low) * 1.08, from = low - 0.04 * (5 - low);
  EXPECT_NEAR(motion.bottom, (motion.low - from) / width * motion.height, 2);
  EXPECT_NEAR(motion.top, (motion.high - from) / width * motion.height, 2);
  const Table& median = results.stochastic.quantiles[2];
  double below = 0, above = 0;
  for (std::size_t i = 0; i < 61; ++i) {
    below = std::min(below, results.interval.at.lower(i, 1) - median(i, 1));
    above = std::max(above, results.interval.at.upper(i, 1) - median(i, 1));
  }
  const double high = (above - below) * 1.08, foot = below - 0.04 * (above - below);
  EXPECT_NEAR(spread.bottom, (spread.low - median(26, 1) - foot) / high * spread.height, 2);
  EXPECT_NEAR(spread.top, (spread.high - median(26, 1) - foot) / high * spread.height, 2);
}

/// On a phone the parts are a list: what is chosen is led to, and what is read is told. On a desktop there are links.
TEST_F(Browser, LeadsToPartsByAListOnAPhone) {
  const std::string doing =
      "const choice = document.querySelector('.choice select'), seen = name =>"
      "  document.querySelector(name).getClientRects().length;"
      "const found = [seen('.choice'), seen('.parts')]; choice.value = '#origin';"
      "choice.dispatchEvent(new Event('change')); await laidOut(); found.push(location.hash,"
      "  document.querySelector('#origin details').open, Math.round(document.querySelector('#origin')."
      "getBoundingClientRect().top) < innerHeight); scrollTo(0, 0); await laidOut(); await laidOut();"
      "found.push(choice.value); note(found.join(' '));";
  EXPECT_EQ(noted(opened(example::pendulum(61, 2), doing, {390, 844})), "1 0 #origin true true #found");
  EXPECT_THAT(noted(opened(example::pendulum(61, 2), doing, {1400, 900})), ::testing::StartsWith("0 1 "));
}

/// By their peaks, falling at the second click; by name; and what is searched for alone.
TEST_F(Browser, OrdersAndSearchesTheOutputs) {
  const std::string press =
      "const names = () => [...document.querySelectorAll('.listed .output:not([hidden]) h3')].map("
      "  name => name.textContent).join(',');"
      "const press = key => document.querySelector('.heads [data-key=' + key + '] button').click();";
  Results results = example::pendulum(61, 7);
  for (std::size_t k = 0; k < 7; ++k)
    for (std::size_t i = 0; i < 61; ++i)
      results.interval.over.upper(i, k) = results.interval.at.upper(i, k) = 10.0 + (k * 3 % 7);
  const std::string page = opened(
      results, press +
                   "const found = []; press('greatest'); found.push(names()); press('greatest'); found.push(names());"
                   "press('name'); found.push(names()); const field = document.querySelector('.find input');"
                   "field.value = 'SHOULDER'; field.dispatchEvent(new Event('input')); found.push(names());"
                   "found.push(document.querySelector('.find output').textContent); note(found.join('|next|'));");
  const std::vector<std::string> found = parted(noted(page));
  ASSERT_EQ(found.size(), 5u);
  EXPECT_EQ(found[0], "shoulder angle,load,tip speed,elbow angle,shoulder rate,energy,tip height");
  EXPECT_EQ(found[1], "tip height,energy,shoulder rate,elbow angle,tip speed,load,shoulder angle");
  EXPECT_EQ(found[2], "elbow angle,energy,load,shoulder angle,shoulder rate,tip height,tip speed");
  EXPECT_EQ(found[3], "shoulder angle,shoulder rate");
  EXPECT_EQ(found[4], "2 of 7");
}

/// Numbers of any size, some of them constant: nothing goes wrong, and every output is drawn.
TEST_F(Browser, DrawsNumbersOfAllSizes) {
  Results results = example::pendulum(61, 5);
  const double factor[] = {1e-9, 1e9, 0, 1e-300, 1e300};
  std::vector<Table*> tables{&results.interval.at.lower,         &results.interval.at.upper,
                             &results.interval.over.lower,       &results.interval.over.upper,
                             &results.stochastic.envelope.lower, &results.stochastic.envelope.upper,
                             &results.stochastic.mean,           &results.stochastic.deviation};
  for (Table& quantile : results.stochastic.quantiles) tables.push_back(&quantile);
  for (std::vector<Bounds>* cuts : {&results.fuzzy.outer, &results.fuzzy.inner})
    for (Bounds& cut : *cuts) tables.insert(tables.end(), {&cut.lower, &cut.upper});
  for (Table* table : tables)
    for (std::size_t i = 0; i < table->times; ++i)
      for (std::size_t k = 0; k < 5; ++k) (*table)(i, k) *= factor[k];
  const std::string page = opened(results, unfolded);
  EXPECT_THAT(rootOf(page), AllOf(HasSubstr("data-page=\"ready\""), Not(HasSubstr("data-error"))));
  EXPECT_EQ(count(page, "<canvas"), 6u);
}

TEST_F(Browser, CopiesTheNumbersOfAFigure) {
  const std::string page =
      opened(example::pendulum(61, 1),
             std::string(unfolded) +
                 "Object.defineProperty(navigator, 'clipboard', { value: { writeText: async text => note(text) } });"
                 "[...document.querySelectorAll('.outputs .keep button')][0].click();");
  const std::string csv = noted(page);
  EXPECT_EQ(count(csv, "\n"), 62u);
  EXPECT_THAT(csv, ::testing::StartsWith("time (s),\"shoulder angle, guaranteed at every instant, from (rad)\","));
  EXPECT_THAT(csv, HasSubstr("\"shoulder angle, median (rad)\""));
}

/// The file that would be saved: colours of paper, also of a page in the dark, and nothing that it would have to load.
TEST_F(Browser, SavesAFigureThatNeedsNothingBesideIt) {
  const std::string page = opened(
      example::machine(),
      std::string(unfolded) +
          "HTMLAnchorElement.prototype.click = () => {};"
          "const saved = place => new Promise(then => {"
          "  URL.createObjectURL = blob => { blob.text().then(then); return 'blob:none'; };"
          "  document.querySelector(place + ' button:last-child').click(); });"
          "note([await saved('.outputs .keep'), await saved('.memberships .keep'), await saved('.picture .keep')]"
          "  .join('|next|'));");
  EXPECT_THAT(rootOf(page), Not(HasSubstr("data-error")));
  const std::vector<std::string> figures = parted(noted(page));
  ASSERT_EQ(figures.size(), 3u);
  for (const std::string& svg : figures) {
    EXPECT_THAT(svg, ::testing::StartsWith("&lt;svg xmlns=\"http://www.w3.org/2000/svg\""));
    EXPECT_THAT(svg, AllOf(HasSubstr("fill=\"#ffffff\""), HasSubstr("stroke:"), Not(HasSubstr("class=")),
                           Not(HasSubstr("var("))));
    EXPECT_THAT(svg, ::testing::EndsWith("&lt;/svg&gt;"));
  }
}

TEST_F(Browser, DrawsWhatThereIsWhereAnalysesAreMissing) {
  Results results = example::pendulum(61, 1);
  results.interval = {};
  results.fuzzy = {};
  results.comparison = {};
  const std::string page = opened(results, unfolded);
  EXPECT_THAT(rootOf(page), AllOf(HasSubstr("data-page=\"ready\""), Not(HasSubstr("data-error"))));
  EXPECT_EQ(count(page, "<canvas"), 2u);
}

TEST_F(Browser, ShowsTextFromAStudyAsText) {
  Results results = example::pendulum(61, 1);
  results.title = results.outputs[0].name = results.outputs[0].unit =
      "</script><script>document.body.remove()</script>";
  const std::string page = opened(results, unfolded);
  EXPECT_THAT(rootOf(page), AllOf(HasSubstr("data-page=\"ready\""), Not(HasSubstr("data-error"))));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;document.body.remove()"));
  EXPECT_EQ(count(page, "<canvas"), 2u);
}

/// What an attribute of the first element of this class is, in the picture of the machine.
std::string attributeOf(const std::string& page, const std::string& element, const std::string& name) {
  const auto begin = page.find("class=\"" + element, page.find("<section class=\"moving\"")),
             from = page.find(" " + name + "=\"", begin) + name.size() + 3;
  return begin == std::string::npos ? "" : page.substr(from, page.find('"', from) - from);
}

/// Of a path.
std::vector<double> numbersOf(std::string path) {
  for (char& c : path)
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) c = ' ';
  std::istringstream text(path);
  return {std::istream_iterator<double>(text), {}};
}

/// Moves the slider in `place` there.
std::string slid(const std::string& place, int value) {
  return "{ const slider = document.querySelector('" + place + " input'); slider.value = " + std::to_string(value) +
         "; slider.dispatchEvent(new Event('input')); }";
}

TEST_F(Browser, MovesTheMachineThroughTime) {
  const Results results = example::machine();
  const std::string start = opened(results, slid(".picture .controls", 0)),
                    later = opened(results, slid(".picture .controls", 3)), still = renderReport(results);
  EXPECT_THAT(rootOf(start), AllOf(HasSubstr("data-page=\"ready\""), Not(HasSubstr("data-error"))));
  EXPECT_THAT(start, HasSubstr("t = 0 s"));
  EXPECT_THAT(later, HasSubstr("t = 1.5 s"));
  for (const char* element : {"link", "sample", "now", "spring", "pin edge"}) {
    EXPECT_NE(attributeOf(start, element, "d"), "") << element;
    if (std::string(element) != "pin edge") {
      EXPECT_NE(attributeOf(later, element, "d"), attributeOf(start, element, "d"));
    }
  }
  EXPECT_NE(attributeOf(later, "mass", "cx"), attributeOf(start, "mass", "cx"));
  for (const char* element : {"link", "sample", "spring", "pin edge"})  // the script draws what was drawn without it
    EXPECT_THAT(numbersOf(attributeOf(start, element, "d")),
                ::testing::Pointwise(::testing::DoubleNear(0.15), numbersOf(attributeOf(still, element, "d"))))
        << element;
}

/// It begins where the outputs are widest, and whoever is moved moves all.
TEST_F(Browser, HasOneTime) {
  const Results results = example::machine();  // seen every half second, memberships at every quarter of one
  const std::string begun = opened(results);
  EXPECT_EQ(count(begun, "<output>t = 3 s</output>"), 2u);
  EXPECT_THAT(begun, HasSubstr("<output>3 s</output>"));
  const std::string byClock = opened(results, slid(".clock", 350));
  EXPECT_THAT(byClock, AllOf(HasSubstr("<output>t = 1.05 s</output>"), HasSubstr("<output>t = 1 s</output>"),
                             HasSubstr("<output>1 s</output>")));
  const std::string byMachine = opened(results, slid(".picture .controls", 3));
  EXPECT_EQ(count(byMachine, "<output>t = 1.5 s</output>"), 2u);
  EXPECT_THAT(byMachine, HasSubstr("<output>1.5 s</output>"));
  const std::string byMoments = opened(results, slid(".memberships .moments", 2));
  EXPECT_EQ(count(byMoments, "<output>t = 0.5 s</output>"), 2u);
  EXPECT_THAT(byMoments, HasSubstr("<output>0.5 s</output>"));
}

/// Its button, by keyboard too, or a click anywhere on it; what it folds away is for its own ends.
TEST_F(Browser, ChoosesTheInstantOfARequirementsCard) {
  const std::string page =
      opened(limited(), slid(".clock", 0) +
                            "const card = document.querySelector('.requirements > li'), found = [];"
                            "const said = () => document.querySelector('.clock output').textContent;"
                            "const shown = () => document.querySelector('.listed .beside g.moment:not([hidden])');"
                            "card.querySelector('details summary').click(); found.push(said());"
                            "card.click(); found.push(said());" +
                            slid(".clock", 0) +
                            "const button = card.querySelector('button'); button.click();"
                            "found.push(said(), button.textContent); note(found.join('|next|'));");
  EXPECT_THAT(parted(noted(page)), ::testing::ElementsAre("t = 0 s", "t = 1.3 s", "t = 1.3 s", "Go to 1.3 s"));
}

/// The slider moves a mark over each plot, and what is beside it, but draws no plot again: so it is quick.
TEST_F(Browser, MovesTheTimeWithoutDrawingPlotsAgain) {
  const std::string page = opened(
      example::pendulum(301, 3),
      std::string(unfolded) +
          "let drawn = 0; const clear = CanvasRenderingContext2D.prototype.clearRect;"
          "CanvasRenderingContext2D.prototype.clearRect = function (...where) { ++drawn; clear.call(this, ...where); };"
          "const seen = () => [...document.querySelectorAll('.live .mark')].map(mark => Math.round("
          "  mark.getBoundingClientRect().left - mark.parentElement.getBoundingClientRect().left)).join(' ');" +
          slid(".clock", 500) +
          "await laidOut(); const middle = seen(), wide = document.querySelector('.listed .u-over').clientWidth;" +
          slid(".clock", 250) + "await laidOut(); note([middle, seen(), wide, drawn].join('|next|'));");
  const std::vector<std::string> found = parted(noted(page));
  ASSERT_EQ(found.size(), 4u);
  const double wide = std::stod(found[2]);
  const auto last = [](const std::string& places) { return std::stod(places.substr(places.rfind(' '))); };
  EXPECT_NEAR(last(found[0]), wide / 2, 1.5);
  EXPECT_NEAR(last(found[1]), wide / 4, 1.5);
  EXPECT_EQ(count(found[0], " "), 3u);
  EXPECT_EQ(found[3], "0");
}

TEST_F(Browser, ShowsNoNameOverAnother) {
  Results results = example::machine();
  PictureResult& m = results.picture;
  const auto mass = std::ranges::find(m.parts, PartKind::mass, &PartInfo::kind);
  PartInfo other = *mass;
  other.name = "beside it";
  other.mass = mass->mass / 2;
  const std::string first = mass->name;
  m.points.push_back(m.points[mass->to]);  // a hair's breadth away at all times
  Places& p = m.places;
  const std::size_t points = m.points.size();
  for (std::vector<double>* all : {&p.nominal, &p.samples, &p.lower, &p.upper, &p.sag}) {
    std::vector<double> wider;
    for (std::size_t row = 0; row < all->size() / (3 * (points - 1)); ++row) {
      const auto begin = all->begin() + static_cast<std::ptrdiff_t>(row * 3 * (points - 1));
      wider.insert(wider.end(), begin, begin + static_cast<std::ptrdiff_t>(3 * (points - 1)));
      wider.insert(wider.end(), begin + static_cast<std::ptrdiff_t>(3 * mass->to),
                   begin + static_cast<std::ptrdiff_t>(3 * mass->to + 3));
    }
    *all = std::move(wider);
  }
  other.from = other.to = mass->to;
  m.parts.push_back(other);  // at the same place: one above the other
  other.name = "hidden by both";
  other.from = other.to = points - 1;
  other.mass /= 2;
  m.parts.push_back(other);
  const std::string shown = opened(results);
  EXPECT_THAT(rootOf(shown), Not(HasSubstr("data-error")));
  const auto seen = [&](const std::string& name) {
    const auto end = shown.find(">" + name + "</text>"), begin = shown.rfind("<text", end);
    return shown.substr(begin, end - begin).find("visibility=\"hidden\"") == std::string::npos;
  };
  EXPECT_TRUE(seen(first));
  EXPECT_TRUE(seen("beside it"));
  EXPECT_FALSE(seen("hidden by both"));
}

TEST_F(Browser, TurnsTheMachine) {
  const std::string turned =
      opened(example::machine(true), "document.querySelectorAll('.moving .views button')[3].click();");
  EXPECT_THAT(rootOf(turned), Not(HasSubstr("data-error")));
  EXPECT_THAT(turned, HasSubstr("<button type=\"button\" aria-pressed=\"true\">x\u2013y</button>"));
  const std::string start = opened(example::machine(true));
  EXPECT_NE(attributeOf(turned, "swept", "d"), attributeOf(start, "swept", "d"));
}

TEST_F(Browser, PrintsTheMachineAtItsStart) {
  const Results results = example::machine();
  const std::string printed =
      opened(results, slid(".picture .controls", 3) + "window.dispatchEvent(new Event('beforeprint'));");
  EXPECT_THAT(
      numbersOf(attributeOf(printed, "link", "d")),
      ::testing::Pointwise(::testing::DoubleNear(0.15), numbersOf(attributeOf(renderReport(results), "link", "d"))));
  EXPECT_THAT(printed, HasSubstr("Side view, at the start."));
}

/// Two outputs at three times, of which the slider shows one; nothing is known of the second output at the second.
TEST_F(Browser, ChoosesTheTimeOfDistributions) {
  Results results = example::pendulum(61, 2);
  DistributionResult& d = results.distribution;
  d.present = true;
  d.time = {results.time[20], results.time[40], results.time[60]};
  d.point = {0, 1, 2};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  d.value = d.lower = d.upper = Grid({3, 2, 3});
  for (int i = 0; i < 6; ++i) {
    if (i == 3) continue;
    std::ranges::copy(std::array{1.0 * i, 1.5 * i + 1, 2.0 * i + 2}, d.value.row(i / 2, i % 2).begin());
    std::ranges::copy(std::array{0.0, 0.5, 1.0}, d.lower.row(i / 2, i % 2).begin());
    std::ranges::copy(std::array{0.0, 0.75, 1.0}, d.upper.row(i / 2, i % 2).begin());
  }
  d.sampled = d.lower;
  d.gaps = Grid({3, 2}, {0.75, 0.75, 0.75, nan, 0.75, 0.75});
  d.excess = Grid({3, 2}, {0, 0, 0, nan, 0, 0});
  const std::string last = opened(results);
  EXPECT_THAT(rootOf(last), Not(HasSubstr("data-error")));
  const std::string kind = "<figure class=\"distribution kept\"";
  EXPECT_EQ(count(last, "<figure class=\"distribution"), 6u);
  EXPECT_EQ(count(last, kind + " data-at=\"2\" hidden"), 0u);
  EXPECT_EQ(count(last, kind + " data-at=\"1\" hidden"), 1u);
  EXPECT_THAT(last, HasSubstr("<output>3 s</output>"));
  const std::string middle = opened(results, slid(".probabilities .moments", 1));
  EXPECT_EQ(count(middle, kind + " data-at=\"2\" hidden"), 2u);
  EXPECT_EQ(count(middle, kind + " data-at=\"1\" hidden"), 0u);
  EXPECT_THAT(middle, HasSubstr("<output>2 s</output>"));
  EXPECT_THAT(middle, HasSubstr("nothing is known at 2 s"));
}

TEST_F(Browser, ChoosesTheTimeOfMembershipFunctions) {
  const std::string page = opened(example::pendulum(61, 2), slid(".memberships .moments", 4));
  EXPECT_THAT(rootOf(page), Not(HasSubstr("data-error")));
  EXPECT_EQ(count(page, "<figure class=\"membership kept\""), 26u);
  EXPECT_EQ(count(page, "<figure class=\"membership kept\" data-at=\"4\">"), 2u);
  EXPECT_EQ(count(page, "<figure class=\"membership kept\" data-at=\"12\" hidden"), 2u);
  EXPECT_THAT(page, HasSubstr("<output>1 s</output>"));
  EXPECT_EQ(count(page, "class=\"outer\""), 26u);
  EXPECT_EQ(count(page, "class=\"inner\""), 26u);
}

/// What is folded away has its numbers and its drawing for those who unfold it.
TEST_F(Browser, KeepsFiguresThatAreFoldedAway) {
  const std::string page =
      opened(example::sensitive(),
             "const button = (figure, which) => document.querySelector(figure + ' .keep button' + which);"
             "const copied = figure => new Promise(then => {"
             "  const clipboard = { writeText: async text => then(text) };"
             "  Object.defineProperty(navigator, 'clipboard', { value: clipboard, configurable: true });"
             "  button(figure, '').click(); });"
             "const saved = figure => new Promise(then => {"
             "  URL.createObjectURL = blob => { blob.text().then(then); return 'blob:none'; };"
             "  HTMLAnchorElement.prototype.click = () => {};"
             "  button(figure, ':last-child').click(); });"
             "note([await copied('.derivative'), await copied('.statistics'), await copied('.convergence'),"
             "  await saved('.sensitivities')].join('|next|'));");
  EXPECT_THAT(rootOf(page), AllOf(HasSubstr("data-page=\"ready\""), Not(HasSubstr("data-error"))));
  const std::vector<std::string> texts = parted(noted(page));
  ASSERT_EQ(texts.size(), 4u);
  EXPECT_THAT(texts[0], ::testing::StartsWith("time (s),\"derivative by &lt;mass&gt; (rad per kg), from\",to,"));
  EXPECT_THAT(texts[1], ::testing::StartsWith("time (s),mean of the samples (rad),\u00b1 (rad),"));
  EXPECT_THAT(texts[2], ::testing::StartsWith("samples,shoulder angle,elbow angle\n1024,0.04,0.05\n"));
  EXPECT_THAT(texts[3], AllOf(HasSubstr("mass"), HasSubstr("first angle"), Not(HasSubstr("var("))));
}

/// Lines and strokes of a quantity whose bands are filled are not; nothing is wider than a phone; and on paper there is
/// what a reader unfolded.
TEST_F(Browser, DrawsQuantitiesOnceFilledAndOnceNot) {
  const std::string page =
      opened(example::sensitive(),
             "const fillOf = name => getComputedStyle(document.querySelector('.sensitivities ' + name)).fill;"
             "window.dispatchEvent(new Event('beforeprint'));"
             "note([fillOf('.total path.cause0') !== 'none', fillOf('path.estimate'), fillOf('.influence path.cause0'),"
             "document.querySelectorAll('.more[open]').length, document.querySelectorAll('.origin > "
             "details[open]').length,"
             "document.body.scrollWidth <= innerWidth].join(' '));");
  EXPECT_EQ(noted(page), "true none none 0 1 true");
}

/// On a phone text of drawings is 9 pixels high at least, and names at the picture's edge stay in it.
TEST_F(Browser, KeepsTextReadableOnAPhone) {
  Results machine = example::machine();
  for (PartInfo& part : machine.picture.parts) part.name += " of a machine with long names";
  for (const Results& results : {machine, example::kinematics(), example::sensitive()}) {
    const std::string page = opened(
        results,
        "await laidOut();"
        "const seen = [...document.querySelectorAll('svg text')].filter(text => text.getClientRects().length > 0);"
        "const small = seen.filter(text => parseFloat(getComputedStyle(text).fontSize)*text.getScreenCTM().a < 9);"
        "const outside = [...document.querySelectorAll('.machine .name')].filter("
        "  text => text.getBBox().x + text.getBBox().width > 720);"
        "note([seen.length > 0, small.length, outside.length, document.body.scrollWidth <= 375, innerWidth].join(' "
        "'));",
        {375, 3000});
    EXPECT_EQ(noted(page), "true 0 0 true 375") << results.title;
  }
}

/// Keys, sliders and buttons are made for hands; on paper they would be noise.
TEST_F(Browser, HidesOnPaperWhatOnlyHandsCanUse) {
  const std::string page =
      opened(example::pendulum(61, 1),
             "let rules = []; for (const sheet of document.styleSheets) for (const rule of sheet.cssRules)"
             "  if (rule.media?.mediaText === 'print') rules.push(...[...rule.cssRules].map(inner => inner.cssText));"
             "const none = rules.filter(rule => rule.includes('display: none')).join(' ');"
             "note(['.live', '.views', '.controls', '.keep'].every(name => none.includes(name)));");
  EXPECT_EQ(noted(page), "true");
}

TEST_F(Browser, OpensAPageOfKinematicsWithoutPlots) {
  const std::string page = opened(example::kinematics());
  EXPECT_THAT(rootOf(page), AllOf(HasSubstr("data-page=\"ready\""), Not(HasSubstr("data-error"))));
  EXPECT_EQ(count(page, "<canvas"), 0u);
}

}  // namespace
}  // namespace gamut
