// How probable values are: of each output its distribution function at some times, of which one is shown, and what the
// samples say of it over time.
#include <fmt/format.h>

#include <algorithm>

#include "reports/drawing/distribution.hpp"
#include "reports/drawing/style.hpp"
#include "reports/page/moments.hpp"
#include "reports/page/page.hpp"
#include "reports/page/samples.hpp"
#include "reports/page/table.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"
#include "studies/results/extremes.hpp"

namespace gamut {
namespace {

std::string distributionNumbers(const Results& results, std::size_t at, std::size_t output) {
  const Stairs stairs = stairsOf(results, at, output);
  NumbersText numbers;
  numbers.column(results.outputs[output].name, results.outputs[output].unit, stairs.value);
  numbers.column("cumulative probability, at least", "", stairs.lower, NumbersText::Rounded::down, 5);
  numbers.column("at most", "", stairs.upper, NumbersText::Rounded::up, 5);
  numbers.column("share of the samples", "", stairs.sampled, NumbersText::Rounded::nearest, 5);
  return numbers.html();
}

std::string distributionsOf(const Results& results, std::size_t output) {
  const std::vector<double>& times = results.distribution.time;
  std::vector<std::string> drawings, captions, numbers;
  for (std::size_t at = 0; at < times.size(); ++at) {
    const std::string when = results.horizon > 0 ? " at " + timeText(times[at]) : std::string();
    drawings.push_back(
        drawDistribution(results, at, output,
                         fmt::format("Plot of the distribution function of {}{}", results.outputs[output].name, when)));
    const double gap = results.distribution.gaps(at, output);
    const bool isKnownAlone = gap == 0 && !drawings.back().empty();  // its ends, between which nothing is told
    if (isKnownAlone) drawings.back().clear();
    const bool isOne = drawings.back().empty() && (isKnownAlone || isOneValue(results, times[at], output));
    captions.push_back(isOne ? "one value, to a billionth of the greatest" + (when.empty() ? "" : "," + when)
                       : drawings.back().empty() ? "nothing is known" + when
                       : gap >= 1                ? "nothing is known but the range" + when
                                                 : fmt::format("bounds {} apart at most{}", atMostText(gap, 2), when));
    numbers.push_back(distributionNumbers(results, at, output));
  }
  return momentFigures("distribution", drawings, captions, numbers);
}

}  // namespace

PlotSection probabilityPlots(const Results& results, const Detail& detail) {
  PlotSection section;
  const DistributionResult& d = results.distribution;
  const bool isBounded = d.present && !d.time.empty();
  StyleSheet style;
  std::string cards;
  bool isSampled = false;
  for (std::size_t output = 0; output < results.outputs.size(); ++output) {
    if (!detail.cards(output)) continue;
    const std::string statistics = statisticsFigure(results, output, style);
    isSampled = isSampled || !statistics.empty();
    if (!isBounded && statistics.empty()) continue;
    cards +=
        fmt::format("<section class=\"card\">\n<h3>{}</h3>\n{}</section>\n", escapeHtml(results.outputs[output].name),
                    !isBounded           ? statistics
                    : statistics.empty() ? distributionsOf(results, output)
                                         : distributionsOf(results, output) +
                                               "<details class=\"more\"><summary>Mean and quantiles over "
                                               "time</summary>\n" +
                                               statistics + "</details>\n");
  }
  if (cards.empty()) return section;
  if (isBounded) {
    section.html =
        "<p class=\"hint\">How probable it is that an output is not above a value: it is proved to lie in the "
        "band; the thin line is the share of the samples";
    if (d.band > 0) section.html += fmt::format(", the dashed lines their 95 % band (± {})", atMostText(d.band, 2));
    section.html += ".</p>\n";
    if (!d.why.empty())
      section.html += fmt::format("<p class=\"hint\">Not as close everywhere as aimed at ({}): {}.</p>\n",
                                  numberText(d.wanted, 3), escapeHtml(d.why));
  }
  if (isSampled) {
    const std::string hint = escapeHtml(statisticsHint(results));
    const std::string text = fmt::format("<p class=\"hint\">{}</p>\n", hint);
    section.html +=
        isBounded ? "<details class=\"more\"><summary>What the folded figures say</summary>" + text + "</details>\n"
                  : text;
  }
  if (isBounded) section.html += momentsControl("distribution", "Time of the distribution functions", d.time);
  section.html += "<div class=\"cards\">\n" + cards + "</div>\n";
  section.style = style.css();
  return section;
}

std::string probabilitySection(const Report& report) { return report.probabilities.html; }

}  // namespace gamut
