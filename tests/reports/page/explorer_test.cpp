// Samples that were kept: which violate a requirement, where that decides, and what a reader chooses among them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <string>

#include "reports/page/decided_map.hpp"
#include "reports/report.hpp"
#include "tests/reports/chromium.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/page_text.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut::explorer {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t decisive = 10;

/// So many samples of two quantities, of which sample i has a margin of `margin(i)` at one output time and more at all
/// others; the limited output is i more than the time. The last did not arrive.
template <class MarginOf>
Results kept(std::size_t samples, const MarginOf& margin) {
  Results results = example::sensitive();
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = "ceiling";
  requirement.statement = "always a < 5 rad";
  requirement.word = Decision::partly;
  requirement.margin = requirement.margins = 1;
  requirement.until = results.horizon;
  requirement.factor = 0.5;
  requirement.violation = {results.uncertain[0].upper, results.uncertain[1].lower};
  results.margins.push_back({1, "a", false, "5 rad", "rad", true, 0, 5, true});
  KeptSamples& all = results.stochastic.kept;
  all.present = true;
  for (std::size_t i = 0; i < samples; ++i) {
    all.number.push_back(static_cast<std::int64_t>(i));
    all.motionNumber.push_back(static_cast<std::int64_t>(i));
    for (const UncertainInfo& quantity : results.uncertain)
      all.values.push_back(
          std::lerp(quantity.lower, quantity.upper, static_cast<double>(i) / static_cast<double>(samples - 1)));
    for (std::size_t row = 0; row < results.time.size(); ++row) {
      const bool isThere = i + 1 < samples || row < 5;
      all.motions.push_back(isThere ? static_cast<double>(i) + results.time[row] : std::nan(""));
      all.motions.push_back(!isThere ? std::nan("") : row == decisive ? margin(i) : 100.0);
    }
  }
  return results;
}

Results ten() {
  return kept(10, [](std::size_t i) { return 4.5 - static_cast<double>(i); });
}

std::string sectionOf(const Results& results) {
  const std::string page = renderReport(results);
  const auto begin = page.find("<section class=\"explorer\"");
  return begin == std::string::npos ? "" : page.substr(begin, page.find("</section>", begin) - begin);
}

TEST(Explorer, TellsWhichSamplesViolateARequirement) {
  const std::string section = sectionOf(ten());
  EXPECT_THAT(section, AllOf(HasSubstr("\"states\":\"+++++----?\""),
                             HasSubstr("The 10 samples whose motions are kept; 4 of them"),
                             HasSubstr("\"samples\":[\"sample 0\",\"sample 1\""), Not(HasSubstr("nan"))));
}

/// At the time at which the margin is least; of a sample that did not arrive nothing is told.
TEST(Explorer, TellsWhereOutputsAreAtTheirWorst) {
  const Results results = ten();
  std::string values;
  for (std::size_t i = 0; i < 9; ++i) values += fmt::format("{:.6g},", static_cast<double>(i) + results.time[decisive]);
  EXPECT_THAT(sectionOf(results), HasSubstr("\"isQuantity\":false,\"limits\":[5],\"values\":[" + values + "null]"));
}

/// At the limit itself a requirement is met unless it is to be strictly below it.
TEST(Explorer, KnowsStrictLimits) {
  Results results = kept(10, [](std::size_t i) { return 4.0 - static_cast<double>(i); });
  EXPECT_THAT(sectionOf(results), HasSubstr("\"states\":\"++++-----?\""));
  results.margins[0].isStrict = false;
  EXPECT_THAT(sectionOf(results), HasSubstr("\"states\":\"+++++----?\""));
}

/// Once is enough: where the margin is greatest.
TEST(Explorer, KnowsWhatIsToBeMetOnce) {
  Results results = ten();
  results.requirements[0].isAlways = false;
  EXPECT_THAT(sectionOf(results), HasSubstr("\"states\":\"+++++++++?\""));
  results.requirements[0].from = results.requirements[0].until = results.time[decisive];
  EXPECT_THAT(sectionOf(results), HasSubstr("\"states\":\"+++++----?\""));
}

TEST(Explorer, ShowsWhatIsProvedOfTheBox) {
  const Results results = ten();
  std::string met;
  for (const UncertainInfo& q : results.uncertain)
    met += fmt::format("{}[{:.6g},{:.6g}]", met.empty() ? "" : ",", 0.5 * (q.nominal + q.lower),
                       0.5 * (q.nominal + q.upper));
  EXPECT_THAT(sectionOf(results), HasSubstr("\"met\":[" + met + "]"));
  Results unproved = results;
  unproved.requirements[0].factor = 0;
  EXPECT_THAT(sectionOf(unproved), HasSubstr("\"met\":null"));
}

/// The box of three quantities, bisected at random, as that of requirement 0.
std::vector<RequirementCell> bisected(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::vector<RequirementCell> cells{{0, 0, Decision::open, {-1, -1, -1}, {1, 1, 1}}};
  while (cells.size() < count) {
    RequirementCell& cell = cells[random() % cells.size()];
    const std::size_t q = random() % 3;
    RequirementCell other = cell;
    cell.upper[q] = other.lower[q] = 0.5 * (cell.lower[q] + cell.upper[q]);
    for (RequirementCell* half : {&cell, &other})
      half->word = std::array{Decision::met, Decision::met, Decision::violated, Decision::open}[random() % 4];
    cells.push_back(other);
  }
  return cells;
}

/// A place is met where all cells over it are; those that are finer than places leave these undecided.
TEST(DecidedMap, SaysWhatHoldsWhateverTheOtherQuantitiesAre) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const int size = std::array{4, 16, 64}[seed % 3];
    const std::vector<RequirementCell> cells = bisected(seed, 1 + seed * seed / 9);
    std::vector<const RequirementCell*> pointers;
    for (const RequirementCell& cell : cells) pointers.push_back(&cell);
    const std::size_t across = seed % 3, upward = (seed / 3 % 2 + 1 + across) % 3;
    const DecidedMap map = decidedMap(pointers, across, upward, size);
    for (int x = 0; x < size; ++x)
      for (int y = 0; y < size; ++y) {
        const auto end = [&](int place) { return 2.0 * place / size - 1; };
        int met = 0, violated = 0, open = 0;
        for (const RequirementCell& cell : cells)
          if (cell.lower[across] < end(x + 1) && cell.upper[across] > end(x) && cell.lower[upward] < end(y + 1) &&
              cell.upper[upward] > end(y))
            ++(cell.word == Decision::met ? met : cell.word == Decision::violated ? violated : open);
        const auto isIn = [&](const std::vector<DecidedMap::Rectangle>& all) {
          return std::ranges::count_if(all, [&](const DecidedMap::Rectangle& r) {
            return r[0] <= x && x < r[0] + r[2] && r[1] <= y && y < r[1] + r[3];
          });
        };
        EXPECT_EQ(isIn(map.met), met > 0 && violated + open == 0 ? 1 : 0) << seed << " " << x << " " << y;
        EXPECT_EQ(isIn(map.violated), violated > 0 && met + open == 0 ? 1 : 0) << seed << " " << x << " " << y;
      }
  }
  EXPECT_TRUE(decidedMap({}, 0, 1, 4).met.empty());
}

/// The left half is met, of the right one what lies above; the rest is violated or open.
Results withCells() {
  Results results = ten();
  results.requirements.cells = {{0, 0, Decision::met, {-1, -1}, {0, 1}},
                                {1, 0, Decision::met, {0, 0}, {1, 1}},
                                {2, 0, Decision::violated, {0, -1}, {0.5, 0}},
                                {3, 0, Decision::open, {0.5, -1}, {1, 0}}};
  return results;
}

TEST(Explorer, TellsWhatIsProvedOfSinglePlaces) {
  EXPECT_THAT(sectionOf(ten()), HasSubstr("\"cells\":null"));
  EXPECT_THAT(sectionOf(withCells()),
              HasSubstr("\"cells\":{\"size\":64,\"count\":4,\"open\":1,\"maps\":{\"0 1\":[[0,0,32,32,0,32,64,32],"
                        "[32,0,16,32]]}}"));
}

/// Hatched, with words; turned with the axes.
TEST(Explorer, DrawsWhatIsProvedOfSinglePlaces) {
  if (!Chromium::isInstalled()) GTEST_SKIP() << "chromium is not installed";
  const TemporaryFolder folder;
  const std::string page = folder.path("report.html");
  writeReport(withCells(), page);
  Chromium chromium;
  const std::string found = chromium.found(
      page,
      "const root = document.documentElement, frame = () => new Promise(then => requestAnimationFrame(then));"
      "while (root.dataset.page !== 'ready') await frame();"
      "document.querySelector('.explorer details').open = true; await frame(); await frame();"
      "const share = kind => { const box = document.querySelector('.map .cells.' + kind).getBBox(),"
      "  frame = document.querySelector('.map .frame').getBBox(); return [(box.x - frame.x) / frame.width,"
      "  (box.y - frame.y) / frame.height, box.width / frame.width, box.height / frame.height].map(x => x.toFixed(2)); "
      "};"
      "const said = () => [...document.querySelectorAll('.map .keys li, .map .hint')].map(x => "
      "x.textContent).join('|');"
      "const fill = getComputedStyle(document.querySelector('.map .cells.met')).fill;"
      "const found = [share('violated').join(' '), said(), fill];"
      "const [across, upward] = document.querySelectorAll('.map select');"
      "across.value = '1'; upward.value = '0'; upward.dispatchEvent(new Event('change'));"
      "across.dispatchEvent(new Event('change')); found.push(share('violated').join(' '));"
      "across.value = '0'; document.querySelectorAll('.map select')[0].value = '0';"
      "document.querySelectorAll('.map select')[0].dispatchEvent(new Event('change'));"
      "found.push(document.querySelector('.map .cells.met').getAttribute('d') + '.');"
      "return found.join('\\n') + '\\n' + (root.dataset.error ?? 'no error');",
      {1400, 900});
  EXPECT_THAT(found, ::testing::StartsWith("0.50 0.50 0.25 0.50\n"));
  EXPECT_THAT(found,
              AllOf(HasSubstr("proved to be met: 75 % of the map|proved to be violated: 13 % of the map|undecided"),
                    HasSubstr("Of 4 parts of the box that were looked at, 1 is undecided."),
                    Not(HasSubstr("no proof for single places")), HasSubstr("\n0.00 0.25 0.50 0.25\n"),
                    ::testing::EndsWith("\n.\nno error")));
}

/// Without a script: by how far they miss the limit, the worst first.
TEST(Explorer, ListsTheMostTellingSamples) {
  const std::string section = sectionOf(ten());
  EXPECT_LT(section.find("<th scope=\"row\">sample 8</th>"), section.find("<th scope=\"row\">sample 7</th>"));
  EXPECT_EQ(count(section, "<td>violated</td>"), 4u);
  EXPECT_EQ(count(section, "<td>met</td>"), 5u);
}

/// Of too many all that violate a requirement are shown, if they are few.
TEST(Explorer, ShowsSomeOfManySamples) {
  const std::string section = sectionOf(kept(900, [](std::size_t i) { return i % 300 == 7 ? -1.0 : 1.0; }));
  EXPECT_THAT(section, HasSubstr("200 of the 900 samples whose motions are kept; 3 of them violate"));
  EXPECT_THAT(section, AllOf(HasSubstr("\"sample 7\""), HasSubstr("\"sample 307\""), HasSubstr("\"sample 607\"")));
}

TEST(Explorer, IsLeftOutWithoutKeptSamples) {
  Results results = ten();
  results.stochastic.kept = {};
  EXPECT_EQ(sectionOf(results), "");
}

/// Keys choose a third of the first axis and move it; the curves of what is chosen are drawn into an output that is
/// unfolded, dashed where they violate the requirement; Escape lets go.
TEST(Explorer, ChoosesSamplesByKeys) {
  if (!Chromium::isInstalled()) GTEST_SKIP() << "chromium is not installed";
  const TemporaryFolder folder;
  const std::string page = folder.path("report.html");
  writeReport(kept(11, [](std::size_t i) { return 4.5 - static_cast<double>(i); }), page);
  Chromium chromium;
  const std::string found = chromium.found(
      page,
      "const root = document.documentElement, frame = () => new Promise(then => requestAnimationFrame(then));"
      "while (root.dataset.page !== 'ready' || root.dataset.plots === 'waiting') await frame();"
      "let dashes = 0; const dash = CanvasRenderingContext2D.prototype.setLineDash;"
      "CanvasRenderingContext2D.prototype.setLineDash = function (list) {"
      "  if (list.length === 2 && list[0] === 5) ++dashes; dash.call(this, list); };"
      "document.querySelector('.explorer details').open = true;"
      "document.querySelector('.listed details').open = true; await frame(); await frame(); await frame();"
      "const axis = () => document.querySelector('.explored .axis'), found = [];"
      "const press = (key, shiftKey) => axis().dispatchEvent(new KeyboardEvent('keydown', { key, shiftKey }));"
      "const said = async () => { dashes = 0; await frame(); await frame();"
      "  found.push(document.querySelector('.explorer output').textContent + ', ' +"
      "    document.querySelectorAll('.explored .sample.faded').length + ' faded'); };"
      "await said(); press('ArrowUp'); await said(); for (let i = 0; i < 20; ++i) press('ArrowUp');"
      "found.push(dashes > 0); await said(); press('Escape'); await said();"
      "return found.join('; ') + '; ' + (root.dataset.error ?? 'no error');",
      {1400, 900});
  EXPECT_EQ(found,
            "11 of 11 chosen, 5 violate it, 0 faded; 3 of 11 chosen, 2 violate it, 8 faded; true; 4 of 11 chosen, 3 "
            "violate it, 7 faded; 11 of 11 chosen, 5 violate it, 0 faded; no error");
}

}  // namespace
}  // namespace gamut::explorer
