// How possible values are: of each output its membership function at some times, of which one is shown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/drawing/membership.hpp"
#include "reports/page/moments.hpp"
#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

/// Rows of results at which something is known: about so many, equally far from each other, the last among them.
std::vector<std::size_t> shownTimes(const Results& results) {
  constexpr std::size_t most = 13;
  const Bounds& widest = results.fuzzy.outer.front();
  std::size_t known = 0;
  for (std::size_t i = 0; i < widest.lower.times && i < results.time.size(); ++i)
    if (std::ranges::any_of(
            std::vector<double>(
                widest.lower.data.begin() + static_cast<std::ptrdiff_t>(i * widest.lower.outputs),
                widest.lower.data.begin() + static_cast<std::ptrdiff_t>((i + 1) * widest.lower.outputs)),
            [](double x) { return std::isfinite(x); }))
      known = i + 1;
  std::vector<std::size_t> rows;
  const std::size_t count = std::min(known, most);
  for (std::size_t i = 0; i < count; ++i) rows.push_back(count == 1 ? 0 : i * (known - 1) / (count - 1));
  return rows;
}

std::string numbersOf(const Results& results, std::size_t time, std::size_t output) {
  const FuzzyResult& fuzzy = results.fuzzy;
  const std::string& unit = results.outputs[output].unit;
  NumbersText numbers;
  numbers.column("membership", "", fuzzy.alpha);
  const auto add = [&](const std::string& name, const std::vector<Bounds>& cuts, auto down, auto up) {
    if (cuts.empty()) return;
    std::vector<double> lower, upper;
    for (const Bounds& cut : cuts) {
      lower.push_back(cut.lower(time, output));
      upper.push_back(cut.upper(time, output));
    }
    numbers.column(name + " from", unit, lower, down);
    numbers.column(name + " to", unit, upper, up);
  };
  using enum NumbersText::Rounded;
  add("proved cut", fuzzy.outer, down, up);
  add("sampled cut", fuzzy.inner, nearest, nearest);
  return numbers.html();
}

/// ", placed by the extended transformation method after Hanss (2 corners and 77 points inside the cuts); they leave
/// …".
std::string methodText(const Results& results) {
  const TransformationResult& t = results.fuzzy.transformation;
  if (!t.present) return {};
  const std::int64_t points = results.stochastic.alphaPoints;
  std::string text = fmt::format(", placed by the {} transformation method after Hanss ({}{})", t.method,
                                 countText(results.stochastic.corners + results.stochastic.alphaCorners, "corner"),
                                 points > 0 ? " and " + countText(points, "point") + " inside the cuts" : "");
  double gap = -1;
  for (const double each : t.gap.data) gap = std::fmax(gap, each);
  if (gap >= 0)
    text += isLittle(gap, 1)
                ? std::string("; they reach the ends of every proved cut")
                : fmt::format("; they leave {} % of the widest proved cut at most", atMostText(100 * gap, 2));
  return text;
}

}  // namespace

std::string membershipFigures(const Results& results, const Detail& detail) {
  const FuzzyResult& fuzzy = results.fuzzy;
  if (!fuzzy.present || fuzzy.outer.empty() || fuzzy.outer.front().empty()) return {};
  const std::vector<std::size_t> rows = shownTimes(results);
  if (rows.empty()) return {};
  std::vector<double> times;
  for (const std::size_t row : rows) times.push_back(results.time[row]);
  std::string html =
      "<p class=\"hint\">How possible a value is. Solid: proved, the ends of the alpha-cuts joined by lines; the pale "
      "stairs above them hold between the levels, too.";
  if (!fuzzy.inner.empty())
    html += " Dashed: what samples of at least that membership reached" + methodText(results) + ".";
  html +=
      " The membership of several values together is the least of theirs (minimum t-norm), and no quantity restricts "
      "another.";
  html +=
      "</p>\n" + momentsControl("membership", "Time of the membership functions", times) + "<div class=\"cards\">\n";
  std::string cards;
  for (std::size_t output = 0; output < results.outputs.size(); ++output) {
    if (!detail.cards(output)) continue;
    std::vector<std::string> drawings, numbers, captions;
    for (const std::size_t row : rows) {
      const std::string when = results.horizon > 0 ? " at " + timeText(results.time[row]) : std::string();
      drawings.push_back(
          drawMembership(results, row, output,
                         fmt::format("Plot of the membership function of {}{}", results.outputs[output].name, when)));
      captions.push_back(drawings.back().empty() ? "nothing is known" + when : "membership" + when);
      numbers.push_back(numbersOf(results, row, output));
    }
    cards +=
        fmt::format("<section class=\"card\">\n<h3>{}</h3>\n{}</section>\n", escapeHtml(results.outputs[output].name),
                    momentFigures("membership", drawings, captions, numbers));
  }
  return cards.empty() ? "" : html + cards + "</div>\n";
}

}  // namespace gamut
