// How probable values are, and whose doing the spread is: of each output its distribution function at some times, of
// which one is shown, and the shares of its variance over time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/drawing/distribution.hpp"
#include "reports/drawing/paper.hpp"
#include "reports/drawing/style.hpp"
#include "reports/page/page.hpp"
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
  constexpr std::array colours{colour::blue, colour::orange, colour::violet, colour::black, colour::grey, colour::blue};
  for (const Share& share : shares)
    plot.layers.push_back({.name = fmt::format("cause{}", share.quantity),
                           .words = results.uncertain[share.quantity].name,
                           .style = {colours[share.quantity % colours.size()], 0, 1.8,
                                     share.quantity % colours.size() == colours.size() - 1},
                           .isProved = true,
                           .bands = {share.band}});
  return plot;
}

std::string timeText(double time) { return numberText(time, 6) + " s"; }

/// Of all times but the last hidden, until somebody moves the slider.
std::string distributionsOf(const Results& results, std::size_t output) {
  const std::vector<double>& times = results.distribution.time;
  std::string html;
  for (std::size_t at = 0; at < times.size(); ++at) {
    const std::string when = results.horizon > 0 ? " at " + timeText(times[at]) : std::string();
    const std::string drawing = drawDistribution(
        results, at, output, fmt::format("Distribution function of {}{}", results.outputs[output].name, when));
    const double gap = results.distribution.gaps[at * results.outputs.size() + output];
    const std::string caption = drawing.empty() ? "nothing is known" + when
                                : gap == 0      ? "known to some roundings" + when
                                                : fmt::format("bounds {} apart at most{}", atMostText(gap, 2), when);
    html += fmt::format("<figure class=\"distribution\" data-at=\"{}\"{}>{}<figcaption>{}</figcaption></figure>\n", at,
                        at + 1 == times.size() ? "" : " hidden", drawing, escapeHtml(caption));
  }
  return html;
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
  if (d.time.size() > 1) {
    std::string times;
    for (const double time : d.time) times += (times.empty() ? "" : ",") + jsonText(timeText(time));
    section.html +=
        fmt::format("<div class=\"controls moments\" data-times=\"{}\"></div>\n", escapeHtml("[" + times + "]"));
  }
  for (std::size_t output = 0; output < results.outputs.size(); ++output) {
    const bool isThere = std::ranges::any_of(results.requirements, [&](const RequirementResult& r) {
      return output >= r.margin && output < r.margin + static_cast<std::uint64_t>(r.margins);
    });
    if (isThere) continue;  // a margin
    section.html += fmt::format("<section class=\"probability\">\n<h3>{}</h3>\n{}",
                                escapeHtml(results.outputs[output].name), distributionsOf(results, output));
    if (const Plot plot = sharesOf(results, output); !plot.layers.empty() && plot.isOverTime()) {
      style.add(plot);
      section.html += fmt::format(
          "{}<figure>{}<figcaption>Total Sobol' indices: the share of the variance that would stay if all other "
          "quantities were known, proved</figcaption></figure>\n",
          drawKey(plot), drawPlot(plot, "Shares of the variance of " + plot.name + " over time"));
    } else if (!plot.layers.empty()) {
      section.html += "<p class=\"hint\">Share of the variance that would stay if all other quantities were known:";
      for (const Layer& layer : plot.layers)
        section.html += fmt::format(" {} {};", escapeHtml(layer.words),
                                    escapeHtml(intervalText(layer.bands[0].lower[0], layer.bands[0].upper[0], 3)));
      section.html.back() = '.';
      section.html += "</p>\n";
    }
    section.html += "</section>\n";
  }
  section.style = style.css();
  return section;
}

std::string probabilitySection(const Report& report) { return report.probabilities.html; }

}  // namespace gamut
