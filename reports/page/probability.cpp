// How probable values are, and whose doing the spread is: of each output its distribution function at some times, of
// which one is shown, and the shares of its variance over time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reports/drawing/distribution.hpp"
#include "reports/drawing/paper.hpp"
#include "reports/drawing/style.hpp"
#include "reports/page/moments.hpp"
#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

constexpr std::size_t drawnQuantities = 6;

/// The total indices of an output over time, those of the quantities with the greatest first.
Plot sharesOf(const Results& results, std::size_t output) {
  const SensitivityResult& s = results.sensitivity;
  const std::size_t quantities = results.uncertain.size(), outputs = results.outputs.size(), times = s.time.size();
  struct Share {
    std::size_t quantity;
    Band band;
    double greatest = 0;
  };
  std::vector<Share> shares;
  for (std::size_t q = 0; q < quantities; ++q) {
    Share share{q, {}, 0};
    for (std::size_t at = 0; at < times; ++at) {
      const std::size_t i = (at * outputs + output) * quantities + q;
      const bool isKnown = s.totalUpper[i] - s.totalLower[i] < 0.5;  // else the line would say nothing
      share.band.lower.push_back(isKnown ? s.totalLower[i] : std::nan(""));
      share.band.upper.push_back(isKnown ? s.totalUpper[i] : std::nan(""));
      if (isKnown) share.greatest = std::max(share.greatest, s.totalUpper[i]);
    }
    if (share.greatest > 0.005) shares.push_back(std::move(share));
  }
  std::ranges::stable_sort(shares, std::greater<>(), &Share::greatest);
  if (shares.size() > drawnQuantities) shares.resize(drawnQuantities);
  Plot plot;
  plot.name = results.outputs[output].name;
  plot.unit = "share of the variance";
  plot.time = s.time;
  constexpr std::array colours{colour::blue, colour::orange, colour::violet, colour::green, colour::red, colour::black};
  for (const Share& share : shares)
    plot.layers.push_back({.name = fmt::format("cause{}", share.quantity),
                           .words = results.uncertain[share.quantity].name,
                           .style = {colours[share.quantity % colours.size()], 0.35, 1.4,
                                     share.quantity % (2 * colours.size()) >= colours.size()},
                           .isProved = true,
                           .bands = {share.band}});
  return plot;
}

std::string numbersOf(const Results& results, std::size_t at, std::size_t output) {
  const Stairs stairs = stairsOf(results, at, output);
  NumbersText numbers;
  numbers.column(results.outputs[output].name, results.outputs[output].unit, stairs.value);
  numbers.column("probability of no more, at least", "", stairs.lower, NumbersText::Rounded::down, 5);
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
    const double gap = results.distribution.gaps[at * results.outputs.size() + output];
    captions.push_back(drawings.back().empty() ? "nothing is known" + when
                       : gap == 0              ? "known to some roundings" + when
                                               : fmt::format("bounds {} apart at most{}", atMostText(gap, 2), when));
    numbers.push_back(numbersOf(results, at, output));
  }
  return momentFigures("distribution", drawings, captions, numbers);
}

std::string sharesFigure(const Plot& plot) {
  NumbersText numbers;
  numbers.column("time", "s", plot.time);
  for (const Layer& layer : plot.layers) {
    numbers.column(layer.words + ", total Sobol' index from", "", layer.bands[0].lower, NumbersText::Rounded::down, 5);
    numbers.column("to", "", layer.bands[0].upper, NumbersText::Rounded::up, 5);
  }
  return fmt::format("<figure class=\"kept\">{}<figcaption>total Sobol' indices over time</figcaption>{}</figure>\n",
                     drawShares(plot, "Plot of the shares of the variance of " + plot.name + " over time"),
                     numbers.html());
}

}  // namespace

PlotSection probabilityPlots(const Results& results) {
  PlotSection section;
  const DistributionResult& d = results.distribution;
  if (!d.present || d.time.empty()) return section;
  StyleSheet style;
  section.html =
      "<p class=\"hint\">How probable it is that an output is not above a value: it is proved to lie in the "
      "blue band; the black line is the share of the samples";
  if (d.band > 0) section.html += fmt::format(", the dashed lines their 95 % band (± {})", atMostText(d.band, 2));
  section.html += ".</p>\n";
  if (!d.why.empty())
    section.html += fmt::format("<p class=\"hint\">Not as close everywhere as asked for ({}): {}.</p>\n",
                                numberText(d.wanted, 3), escapeHtml(d.why));
  std::string cards;
  std::vector<Layer> key;
  for (std::size_t output = 0; output < results.outputs.size(); ++output) {
    if (isMargin(results, output)) continue;
    cards +=
        fmt::format("<section class=\"probability\">\n<h3>{}</h3>\n<div class=\"cards\"><div class=\"card\">{}</div>\n",
                    escapeHtml(results.outputs[output].name), distributionsOf(results, output));
    const Plot plot = sharesOf(results, output);
    if (!plot.layers.empty() && plot.isOverTime()) {
      style.add(plot);
      for (const Layer& layer : plot.layers)
        if (std::ranges::find(key, layer.name, &Layer::name) == key.end()) key.push_back(layer);
      cards += "<div class=\"card\">" + sharesFigure(plot) + "</div>\n";
    } else if (!plot.layers.empty()) {
      cards += "<p class=\"hint\">Share of the variance that would stay if all other quantities were known:";
      for (const Layer& layer : plot.layers)
        cards += fmt::format(" {} {};", escapeHtml(layer.words),
                             escapeHtml(intervalText(layer.bands[0].lower[0], layer.bands[0].upper[0], 3)));
      cards.back() = '.';
      cards += "</p>\n";
    }
    cards += "</div>\n</section>\n";
  }
  if (!key.empty()) {
    std::ranges::sort(key, {}, [](const Layer& layer) { return std::pair(layer.name.size(), layer.name); });
    section.html +=
        "<p class=\"hint\">Total Sobol' indices: the share of an output's variance that would stay if all other "
        "quantities were known. It is proved to lie in the band of each quantity. The greatest is what to measure "
        "better first.</p>\n" +
        drawKey(key, "Key to the shares of the variance");
  }
  section.html += momentsControl("distribution", "Time of the distribution functions", d.time) + cards;
  section.style = style.css();
  return section;
}

std::string probabilitySection(const Report& report) { return report.probabilities.html; }

}  // namespace gamut
