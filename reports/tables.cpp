// Tables of escaped text; every cell goes through `cell`.
#include "reports/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "reports/words.hpp"
#include "studies/summary.hpp"

namespace gamut {
namespace {

/// A table that is built row by row; on narrow screens it scrolls by itself.
class TableText {
 public:
  TableText(std::string_view caption, const std::vector<std::string>& heads) : html_("<div class=\"table\"><table>\n") {
    html_ += fmt::format("<caption>{}</caption>\n<thead><tr>", escapeHtml(caption));
    for (const std::string& head : heads) html_ += fmt::format("<th scope=\"col\">{}</th>", escapeHtml(head));
    html_ += "</tr></thead>\n<tbody>\n";
  }

  void row(std::string_view name, const std::vector<std::string>& cells) {
    html_ += fmt::format("<tr><th scope=\"row\">{}</th>", escapeHtml(name));
    for (const std::string& cell : cells) html_ += fmt::format("<td>{}</td>", escapeHtml(cell));
    html_ += "</tr>\n";
  }

  std::string html() const { return html_ + "</tbody></table></div>\n"; }

 private:
  std::string html_;
};

std::string withUnit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " (" + unit + ")";
}

/// Digits that show a width of one row's intervals, so that a narrow interval far from zero is not printed as a point.
int rowDigits(const Bounds& widest, std::size_t time, std::size_t output) {
  if (widest.empty()) return 6;
  const double lower = widest.lower(time, output), upper = widest.upper(time, output);
  return digitsFor(std::max(std::abs(lower), std::abs(upper)), upper - lower, 4);
}

std::string intervalAt(const Bounds& bounds, std::size_t time, std::size_t output, int digits) {
  return bounds.empty() ? "none" : intervalText(bounds.lower(time, output), bounds.upper(time, output), digits);
}

/// The most possible: the cut of the highest level.
const Bounds* coreOf(const FuzzyResult& fuzzy) {
  const auto highest = std::max_element(fuzzy.alpha.begin(), fuzzy.alpha.end());
  const auto level = static_cast<std::size_t>(highest - fuzzy.alpha.begin());
  return fuzzy.present && level < fuzzy.outer.size() && !fuzzy.outer[level].empty() ? &fuzzy.outer[level] : nullptr;
}

double greatestOverestimation(const ComparisonResult& comparison, std::size_t output) {
  if (comparison.overestimation.empty() && output < comparison.maximumOf.size()) return comparison.maximumOf[output];
  double greatest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < comparison.overestimation.times; ++i) {
    greatest = std::fmax(greatest, comparison.overestimation(i, output));
  }
  return greatest;
}

/// The last output time that every present analysis reached.
std::size_t lastCommonTime(const Results& results) {
  const auto end = std::upper_bound(results.time.begin(), results.time.end(), reachedTime(results));
  return end == results.time.begin() ? 0 : static_cast<std::size_t>(end - results.time.begin()) - 1;
}

std::string secondsText(double seconds) { return numberText(seconds, seconds < 1000 ? 3 : 6) + " s"; }

}  // namespace

std::string uncertainTable(const Results& results) {
  TableText table("Uncertain quantities", {"name", "quantity", "interval", "nominal", "probable", "possible"});
  for (const UncertainInfo& info : results.uncertain) {
    const int digits =
        std::max(6, digitsFor(std::max(std::abs(info.lower), std::abs(info.upper)), info.upper - info.lower, 4));
    table.row(info.name, {withUnit(info.quantity, info.unit),
                          fmt::format("[{}, {}]", numberText(info.lower, digits), numberText(info.upper, digits)),
                          numberText(info.nominal, digits), info.distribution, info.membership});
  }
  return table.html();
}

std::string figuresTable(const Results& results, const Verdict& verdict) {
  if (results.time.empty()) return {};
  const std::size_t time = lastCommonTime(results);
  const bool compared = !std::isnan(verdict.overestimation);
  const Bounds* core = coreOf(results.fuzzy);
  const bool guaranteed = results.interval.present, sampled = results.stochastic.present;

  std::vector<std::string> heads{"output"};
  if (guaranteed) heads.push_back("guaranteed");
  if (sampled) heads.push_back("sampled");
  if (core != nullptr) heads.push_back("most possible");
  if (compared) heads.push_back("overestimation, at most");
  TableText table(results.horizon > 0 ? fmt::format("Outputs at {} s", numberText(results.time[time], 6)) : "Outputs",
                  heads);
  for (std::size_t k = 0; k < results.outputs.size(); ++k) {
    const Bounds& widest = guaranteed        ? results.interval.at
                           : sampled         ? results.stochastic.envelope
                           : core != nullptr ? *core
                                             : results.interval.at;
    const int digits = rowDigits(widest, time, k);
    std::vector<std::string> cells;
    if (guaranteed) cells.push_back(intervalAt(results.interval.at, time, k, digits));
    if (sampled) cells.push_back(intervalAt(results.stochastic.envelope, time, k, digits));
    if (core != nullptr) cells.push_back(intervalAt(*core, time, k, digits));
    if (compared) cells.push_back(atMostText(greatestOverestimation(results.comparison, k), 4));
    table.row(withUnit(results.outputs[k].name, results.outputs[k].unit), cells);
  }
  return table.html();
}

std::string costTable(const Results& results) {
  TableText table("Cost", {"analysis", "CPU time", "amount"});
  const IntervalResult& interval = results.interval;
  const StochasticResult& stochastic = results.stochastic;
  if (interval.present) {
    table.row("guaranteed", {secondsText(interval.cpu),
                             countText(interval.pieces, "piece") + ", " + countText(interval.steps, "step")});
  }
  if (stochastic.present) {
    table.row("probable",
              {secondsText(stochastic.cpu),
               fmt::format("{} ({}), {}, tolerances {} relative, {} absolute", countText(stochastic.samples, "sample"),
                           stochastic.plan, countText(stochastic.corners + stochastic.alphaCorners, "corner"),
                           numberText(stochastic.relativeTolerance), numberText(stochastic.absoluteTolerance))});
  }
  if (results.fuzzy.present) {
    table.row("possible", {secondsText(results.fuzzy.cpu),
                           countText(static_cast<long long>(results.fuzzy.alpha.size()), "alpha-cut")});
  }
  if (results.reportCpu > 0) table.row("report", {secondsText(results.reportCpu), ""});
  if (std::isfinite(results.limits.time)) {
    const Limits& limits = results.limits;
    const auto gigabytes = [](double bytes) { return numberText(bytes / 1e9, 3) + " GB"; };
    table.row("all analyses", {secondsText(results.cpu),
                               fmt::format("at most {} of memory; allowed: {} and {}, to the enclosure {} and "
                                           "{}, to a sample {}",
                                           gigabytes(results.memory), secondsText(limits.time),
                                           gigabytes(limits.memory), secondsText(limits.enclosureTime),
                                           gigabytes(limits.enclosureMemory), secondsText(limits.sampleTime))});
  }
  return table.html();
}

std::string provenanceTable(const Results& results) {
  TableText table("Origin of the numbers", {"what", "value"});
  table.row("Gamut", {results.version});
  table.row("study file", {results.studyFile});
  table.row("computed", {results.date});
  table.row("machine", {results.host});
  table.row("seed", {fmt::format("{}", results.seed)});
  std::string libraries;
  for (const auto& [name, version] : results.libraries) {
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  }
  table.row("libraries", {libraries});
  return table.html();
}

}  // namespace gamut
