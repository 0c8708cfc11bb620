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
#include "studies/results/instants.hpp"

namespace gamut {
namespace {

/// The last output time that every present analysis reached.
std::size_t lastCommonTime(const Results& results) {
  const auto end = std::upper_bound(results.time.begin(), results.time.end(), reachedTime(results));
  return end == results.time.begin() ? 0 : static_cast<std::size_t>(end - results.time.begin()) - 1;
}

/// The widest of one row's intervals, so that a narrow one beside it has as many decimals.
double widestOf(const std::vector<Column>& columns, std::size_t time, std::size_t output) {
  double widest = 0;
  for (const Column& column : columns)
    if (column.bounds != nullptr && !column.bounds->empty())
      widest = std::fmax(widest, column.bounds->upper(time, output) - column.bounds->lower(time, output));
  return widest;
}

/// Of an output of this size over the whole motion, a billionth of which has no digits of its own.
std::string cellOf(const Column& column, std::size_t time, std::size_t output, double widest, double size) {
  if (column.bounds == nullptr) return column.texts[output];
  if (column.bounds->empty()) return "none";
  const auto [least, greatest] =
      boundsText(column.bounds->lower(time, output), column.bounds->upper(time, output), size, 4, widest);
  return least == "none" ? least : fmt::format("[{}, {}]", least, greatest);
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
    const std::string name = toldName(results, k, time);
    if (name.empty()) continue;
    const double widest = widestOf(columns, time, k);
    const double size = motionSize(results, k);
    std::vector<std::string> cells;
    for (const Column& column : columns) cells.push_back(cellOf(column, time, k, widest, size));
    table.row(headingOf(name, results.outputs[k].unit), cells);
  }
  return table.html() + hintOfRows(results.outputs.size(), rows);
}

std::string costTable(const Results& results) {
  TableText table("Cost", {"analysis", "CPU time", "amount"});
  for (const Part* part : results.parts())
    if (part->present && (part->spent() > 0 || !part->amount().empty()))
      table.row(part->title(), {cpuText(part->spent()), part->amount()});
  for (const CostInfo& cost : results.costs)
    if (cost.cpu >= leastCpuTold) table.row(cost.what, {cpuText(cost.cpu), ""});
  if (std::isfinite(results.limits.time)) {
    const Limits& limits = results.limits;
    const auto gigabytes = [](double bytes) { return numberText(bytes / 1e9, 3) + " GB"; };
    table.row(
        "all analyses",
        {cpuText(results.cpu),
         fmt::format("at most {} of memory; allowed: {} and {}, to the enclosure {} and {}, to a sample {}",
                     gigabytes(results.memory), timeText(limits.time), gigabytes(limits.memory),
                     timeText(limits.enclosureTime), gigabytes(limits.enclosureMemory), timeText(limits.sampleTime))});
  }
  return table.html();
}

}  // namespace

std::string figuresSection(const Report& report) {
  return "<p class=\"hint\">Guaranteed bounds are printed outward: lower bounds rounded down, upper bounds up; "
         "\u201cabout\u201d 0.2 is a bound that lies beyond 0.2 by no more than a billionth of what is shown.</p>\n" +
         figuresTable(report.results, report.verdict, report.detail.rows) + costTable(report.results);
}

}  // namespace gamut
