// Each interval holds with 95 % confidence by itself. They are drawn around the mean of the samples, since beside a
// motion they would be hairlines.
#include "reports/page/samples.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "reports/drawing/convergence.hpp"
#include "reports/drawing/paper.hpp"
#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"
#include "studies/results/extremes.hpp"

namespace gamut {
namespace {

/// Rows of results up to which the samples came: about so many, equally far from each other, the last among them.
std::vector<std::size_t> drawnRows(const StochasticResult& s, std::size_t output) {
  constexpr std::size_t most = 121;
  std::size_t known = 0;
  for (std::size_t i = 0; i < s.mean.times; ++i)
    if (std::isfinite(s.mean(i, output))) known = i + 1;
  std::vector<std::size_t> rows;
  const std::size_t count = std::min(known, most);
  for (std::size_t i = 0; i < count; ++i) rows.push_back(count == 1 ? 0 : i * (known - 1) / (count - 1));
  return rows;
}

bool hasStatistics(const StochasticResult& s) { return s.present && !s.mean.empty(); }
bool hasIntervals(const StochasticResult& s) {
  const auto isThere = [&](const std::vector<Table>& tables) {
    return tables.size() == s.quantiles.size() &&
           std::ranges::none_of(tables, [](const Table& table) { return table.empty(); });
  };
  return isThere(s.quantileLower) && isThere(s.quantileUpper);
}
bool isKnown(const Table& table, const std::vector<std::size_t>& rows, std::size_t output) {
  return !table.empty() && std::ranges::any_of(rows, [&](std::size_t i) { return std::isfinite(table(i, output)); });
}

std::string percent(double probability) { return fmt::format("{:g} %", 100 * probability); }

std::string numbersOf(const Results& results, const std::vector<std::size_t>& rows, std::size_t output) {
  const StochasticResult& s = results.stochastic;
  const std::string& unit = results.outputs[output].unit;
  NumbersText numbers;
  const auto add = [&](const std::string& head, const Table& table) {
    if (!isKnown(table, rows, output)) return;
    std::vector<double> column;
    for (const std::size_t row : rows) column.push_back(table(row, output));
    numbers.column(head, unit, column, NumbersText::Rounded::nearest, 6);
  };
  std::vector<double> times;
  for (const std::size_t row : rows) times.push_back(results.time[row]);
  numbers.column("time", "s", times);
  add("mean of the samples", s.mean);
  add("±", s.meanError);
  add("standard deviation", s.deviation);
  add("±", s.deviationError);
  for (std::size_t q = 0; q < s.quantiles.size(); ++q) {
    add(percent(s.probabilities[q]) + " quantile", s.quantiles[q]);
    if (!hasIntervals(s)) continue;
    add("from", s.quantileLower[q]);
    add("to", s.quantileUpper[q]);
  }
  return numbers.html();
}

// ---- What holds of all outputs --------------------------------------------------------------------------------------

/// Who failed, and why.
std::string failedText(const Results& results) {
  const StochasticResult& s = results.stochastic;
  if (s.failures == 0) return {};
  std::string html = fmt::format(
      "<p class=\"failed\">{} of {} sampled {} did not arrive{}; statistics and envelopes end where the first of them "
      "ended.</p>\n",
      s.failures, s.integrated, results.horizon > 0 ? "motions" : "positions",
      results.horizon > 0 ? fmt::format(" at {}", timeText(results.horizon)) : "");
  if (s.failed.empty()) return html;
  constexpr std::size_t most = 20;
  html += "<details><summary>Which, and why</summary><ul class=\"notes\">\n";
  for (std::size_t i = 0; i < std::min(most, s.failed.size()); ++i)
    html += fmt::format("<li>{}{}: {}</li>\n", escapeHtml(s.nameOf(s.failed[i].number)),
                        results.horizon > 0 ? fmt::format(", up to {}", reachedText(s.failed[i].reached)) : "",
                        escapeHtml(s.failed[i].why));
  if (const auto others = s.failures - static_cast<std::int64_t>(std::min(most, s.failed.size())); others > 0)
    html += fmt::format("<li>and {} more; the results name {}, in /stochastic/failed</li>\n", others,
                        s.failures > static_cast<std::int64_t>(s.failed.size()) ? "the first thousand" : "them all");
  return html + "</ul></details>\n";
}

std::string coveredText(const Results& results) {
  const StochasticResult& s = results.stochastic;
  if (!(s.covered > 0)) return {};
  return fmt::format(
      "<p class=\"covered\">With a confidence of 95 %, at least {} of all {} lie between the least and the greatest "
      "sample{} (Wilks).</p>\n",
      numberText(std::floor(10000 * s.covered) / 100, 5) + " %", results.horizon > 0 ? "motions" : "positions",
      results.horizon > 0 ? ", in each output at each time by itself" : ", in each output by itself");
}

/// One number of `convergence`.
struct Convergence {
  const std::vector<double>& numbers;
  const char *axis, *what;
  bool isWorstGreatest;
};

/// A line an output, the worst in front.
std::string convergenceFigure(const Results& results, const Detail& detail, const Convergence& shown) {
  const ConvergenceResult& c = results.stochastic.convergence;
  const std::size_t outputs = results.outputs.size();
  const std::vector<double> samples(c.samples.begin(), c.samples.end());
  NumbersText columns;
  columns.column("samples", "", samples);
  std::vector<Line> lines;
  std::size_t worst = 0, worstOutput = outputs;
  double greatest = -INFINITY;
  for (std::size_t o = 0; o < outputs; ++o) {
    if (!detail.cards(o)) continue;
    Line& line = lines.emplace_back();
    for (std::size_t i = 0; i < samples.size(); ++i)
      line.push_back(i * outputs + o < shown.numbers.size() ? shown.numbers[i * outputs + o] : std::nan(""));
    columns.column(results.outputs[o].name, "", line, NumbersText::Rounded::nearest, 5);
    const double bad = shown.isWorstGreatest ? line.back() : -line.back();
    if (!(bad > greatest)) continue;
    greatest = bad;
    worst = lines.size() - 1;
    worstOutput = o;
  }
  if (worstOutput == outputs) return {};
  const std::string drawing =
      drawConvergence(samples, lines, worst, shown.axis, fmt::format("Plot by the number of samples: {}", shown.what));
  if (drawing.empty()) return {};
  return fmt::format(
      "<div class=\"card\"><figure class=\"kept convergence\">{}<figcaption>{}{}: {} with {:.0f} samples for "
      "\u201c{}\u201d{}</figcaption>{}</figure></div>\n",
      drawing, shown.what, results.horizon > 0 ? ", averaged over time" : "",
      numberText(lines[worst].back(), 2) + (shown.isWorstGreatest ? " standard deviations" : ""), samples.back(),
      escapeHtml(results.outputs[worstOutput].name),
      lines.size() > 1 ? ", the worst of all outputs (others: thin lines)" : "", columns.html());
}

std::string convergenceText(const Results& results, const Detail& detail) {
  const ConvergenceResult& c = results.stochastic.convergence;
  if (!c.present || c.samples.size() < 2) return {};
  const std::string figures =
      convergenceFigure(results, detail,
                        {c.meanError, "± standard deviations", "how well the mean is known (95 %)", true}) +
      convergenceFigure(results, detail,
                        {c.spanned, "share", "share of the whole envelope that the first samples span", false});
  if (figures.empty()) return {};
  return "<h3>Would fewer samples do?</h3>\n<div class=\"cards\">\n" + figures + "</div>\n";
}

/// One row an output: what the samples say at the last time that they reached.
std::string statisticsTable(const Results& results, std::size_t rows) {
  const StochasticResult& s = results.stochastic;
  std::vector<std::string> heads{"output", "mean", "standard deviation"};
  for (const double probability : s.probabilities) heads.push_back(percent(probability) + " quantile");
  std::size_t row = results.time.size();
  const auto isThere = [&](std::size_t i) {
    for (std::size_t o = 0; o < results.outputs.size(); ++o)
      if (std::isfinite(s.mean(i, o))) return true;
    return false;
  };
  while (row > 0 && !isThere(row - 1)) --row;
  if (row-- == 0) return {};
  TableText table(results.horizon > 0 ? fmt::format("At {}, with 95 % confidence", timeText(results.time[row]))
                                      : "With 95 % confidence",
                  heads);
  std::size_t outputs = 0;
  for (std::size_t o = 0; o < results.outputs.size(); ++o) {
    if (isMargin(results, o)) continue;
    if (++outputs > rows) continue;
    const double size = motionSize(results, o);
    const bool isOneValue = isLittle(s.deviation(row, o), size);  // but for rounding
    const auto with = [&](double value, const Table& errors) {
      const double error = errors.empty() ? std::nan("") : errors(row, o);
      if (isOneValue) return value != 0 && isLittle(value, size) ? tellingText(value, size) : numberText(value, 6);
      return std::isfinite(error) ? withErrorText(value, error)
                                  : numberText(value, digitsFor(std::abs(value), s.deviation(row, o), 2));
    };
    std::vector<std::string> cells{with(s.mean(row, o), s.meanError), with(s.deviation(row, o), s.deviationError)};
    for (std::size_t q = 0; q < s.quantiles.size(); ++q) {
      const double lower = hasIntervals(s) ? s.quantileLower[q](row, o) : std::nan(""),
                   upper = hasIntervals(s) ? s.quantileUpper[q](row, o) : std::nan("");
      const auto [from, to] = outwardBounds(lower, upper, size, 2);
      const std::string value = with(s.quantiles[q](row, o), Table());
      cells.push_back(isOneValue                               ? value
                      : std::isnan(lower) || std::isnan(upper) ? "about " + value
                                                               : fmt::format("[{}, {}]", from, to));
    }
    table.row(headingOf(results.outputs[o].name, results.outputs[o].unit), cells);
  }
  return "<details class=\"more\"><summary>Mean, deviation and quantiles of every output, with their "
         "confidence</summary>\n" +
         table.html() + hintOfRows(outputs, rows) + "</details>\n";
}

}  // namespace

std::string statisticsFigure(const Results& results, std::size_t output, StyleSheet& style) {
  const StochasticResult& s = results.stochastic;
  if (!hasStatistics(s)) return {};
  const std::vector<std::size_t> rows = drawnRows(s, output);
  if (rows.size() < 2) return {};
  const std::string& unit = results.outputs[output].unit;
  Plot plot;
  plot.name = results.outputs[output].name;
  plot.unit = headingOf("from the mean", unit);
  for (const std::size_t row : rows) plot.time.push_back(results.time[row]);
  Layer quantiles{.name = "quantiles", .words = "quantiles", .style = {colour::blue, 0.4, 0.7}},
      mean{.name = "mean", .words = "mean", .style = {colour::black, 0.45, 0.7}};
  for (std::size_t q = 0; q < s.quantiles.size(); ++q) {
    Band& band = quantiles.bands.emplace_back();
    for (const std::size_t row : rows) {
      const double middle = s.mean(row, output), value = s.quantiles[q](row, output);
      const double lower = hasIntervals(s) ? s.quantileLower[q](row, output) : value,
                   upper = hasIntervals(s) ? s.quantileUpper[q](row, output) : value;
      band.lower.push_back((std::isnan(lower) ? value : lower) - middle);
      band.upper.push_back((std::isnan(upper) ? value : upper) - middle);
    }
  }
  Band& band = mean.bands.emplace_back();
  for (const std::size_t row : rows) {
    const double error = s.meanError.empty() ? 0 : s.meanError(row, output);
    band.lower.push_back(std::isnan(error) ? 0 : -error);
    band.upper.push_back(std::isnan(error) ? 0 : error);
  }
  if (!quantiles.bands.empty()) plot.layers.push_back(std::move(quantiles));
  plot.layers.push_back(std::move(mean));
  style.add(plot);
  std::vector<std::string> shares;
  for (const double probability : s.probabilities) shares.push_back(fmt::format("{:g}", 100 * probability));
  return fmt::format(
      "<figure class=\"kept statistics\">{}<figcaption>mean and quantiles{} over time</figcaption>{}</figure>\n",
      drawSmall(plot, "Plot of mean and quantiles of " + plot.name + " over time, around the mean"),
      shares.empty() ? "" : fmt::format(" ({} %)", fmt::join(shares, ", ")), numbersOf(results, rows, output));
}

std::string statisticsHint(const Results& results) {
  const StochasticResult& s = results.stochastic;
  if (!hasStatistics(s)) return {};
  const bool isKnown =
      !s.meanError.empty() && std::ranges::any_of(s.meanError.data, [](double x) { return std::isfinite(x); });
  if (!isKnown)
    return "Mean (in the middle) and quantiles of the samples, as deviations from the mean; how far those of all "
           "motions lie from them is not known.";
  return fmt::format(
      "Mean (in the middle) and quantiles, as deviations from the mean of the samples: those of all motions, "
      "distributed as the samples are, lie in the bands with 95 % confidence, each number by itself (from 16 "
      "independent batches{}).",
      s.plan == Placement::random ? "; quantiles from the samples' order" : "");
}

std::string samplesSection(const Report& report) {
  const Results& results = report.results;
  if (!hasStatistics(results.stochastic)) return {};
  return failedText(results) + coveredText(results) + convergenceText(results, report.detail) +
         statisticsTable(results, report.detail.rows);
}

}  // namespace gamut
