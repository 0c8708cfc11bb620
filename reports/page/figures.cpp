// Two tables whose columns and rows come from the analyses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/sections/contribution.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"
#include "studies/results/extremes.hpp"

namespace gamut {
namespace {

/// The last output time that every present analysis reached.
std::size_t lastCommonTime(const Results& results) {
  const auto end = std::upper_bound(results.time.begin(), results.time.end(), reachedTime(results));
  return end == results.time.begin() ? 0 : static_cast<std::size_t>(end - results.time.begin()) - 1;
}

/// Digits that show the widest of one row's intervals, so that a narrow one far from zero is not printed as a point.
int rowDigits(const std::vector<Column>& columns, std::size_t time, std::size_t output) {
  double magnitude = 0, width = 0;
  for (const Column& column : columns) {
    if (column.bounds == nullptr || column.bounds->empty()) continue;
    const double lower = column.bounds->lower(time, output), upper = column.bounds->upper(time, output);
    if (!(upper - lower >= width)) continue;
    width = upper - lower;
    magnitude = std::max(std::abs(lower), std::abs(upper));
  }
  return digitsFor(magnitude, width, 4);
}

/// Of an output of this size over the whole motion, a billionth of which has no digits of its own.
std::string cellOf(const Column& column, std::size_t time, std::size_t output, int digits, double size) {
  if (column.bounds == nullptr) return column.texts[output];
  if (column.bounds->empty()) return "none";
  const double lower = column.bounds->lower(time, output), upper = column.bounds->upper(time, output);
  if (const double most = std::max(std::abs(lower), std::abs(upper)); most != 0 && isLittle(most, size)) {
    const auto [least, greatest] = boundsText(lower, upper, size);
    return fmt::format("[{}, {}]", least, greatest);
  }
  return intervalText(lower, upper, digits);
}

std::string figuresTable(const Results& results, const Verdict& verdict, std::size_t rows) {
  if (results.time.empty()) return {};
  const std::size_t time = lastCommonTime(results);
  std::vector<Column> columns;
  for (const Contribution* analysis : analyses)
    for (Column& column : analysis->columns(results, verdict)) columns.push_back(std::move(column));
  std::vector<std::string> heads{"output"};
  for (const Column& column : columns) heads.push_back(column.head);
  TableText table(results.horizon > 0 ? fmt::format("Outputs at {} s", numberText(results.time[time], 6)) : "Outputs",
                  heads);
  for (std::size_t k = 0; k < std::min(rows, results.outputs.size()); ++k) {
    const int digits = rowDigits(columns, time, k);
    const double size = motionSize(results, k);
    std::vector<std::string> cells;
    for (const Column& column : columns) cells.push_back(cellOf(column, time, k, digits, size));
    const std::string& name = results.outputs[k].name;
    table.row(headingOf(isMargin(results, k) ? "margin of " + name : name, results.outputs[k].unit), cells);
  }
  return table.html() + hintOfRows(results.outputs.size(), rows);
}

std::string secondsText(double seconds) { return numberText(seconds, seconds < 1000 ? 3 : 6) + " s"; }

std::string costTable(const Results& results) {
  TableText table("Cost", {"analysis", "CPU time", "amount"});
  for (const Answer* answer : results.answers())
    if (answer->present) table.row(answer->title(), {secondsText(answer->cpu), answer->amount()});
  if (std::isfinite(results.limits.time)) {
    const Limits& limits = results.limits;
    const auto gigabytes = [](double bytes) { return numberText(bytes / 1e9, 3) + " GB"; };
    table.row("all analyses",
              {secondsText(results.cpu),
               fmt::format("at most {} of memory; allowed: {} and {}, to the enclosure {} and {}, to a sample {}",
                           gigabytes(results.memory), secondsText(limits.time), gigabytes(limits.memory),
                           secondsText(limits.enclosureTime), gigabytes(limits.enclosureMemory),
                           secondsText(limits.sampleTime))});
  }
  return table.html();
}

}  // namespace

std::string figuresSection(const Report& report) {
  return "<p class=\"hint\">Guaranteed bounds are printed outward: lower bounds rounded down, upper bounds up.</p>\n" +
         figuresTable(report.results, report.verdict, report.detail.rows) + costTable(report.results);
}

}  // namespace gamut
