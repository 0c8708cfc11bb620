// The map of what outputs can reach: cells of their values, drawn in runs of one kind.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reports/drawing/axes.hpp"
#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/words.hpp"
#include "studies/analyses/workspace.hpp"

namespace gamut {
namespace {

/// Cells beside each other along the first output, of one kind.
struct CellRun {
  double from, to, besideFrom, besideTo, reached;
};

std::vector<CellRun> runsOf(const WorkspaceResult& workspace) {
  std::vector<CellRun> runs;
  for (std::size_t j = 0; j < workspace.besideFrom.size(); ++j)
    for (std::size_t i = 0; i < workspace.from.size(); ++i) {
      const double reached = workspace.reached(i, j);
      if (i > 0 && runs.back().reached == reached)
        runs.back().to = workspace.to[i];
      else
        runs.push_back({workspace.from[i], workspace.to[i], workspace.besideFrom[j], workspace.besideTo[j], reached});
    }
  return runs;
}

/// A range of this width about the same middle.
Range widened(const Range& range, double width) {
  const double middle = 0.5 * (range.low + range.high);
  return {middle - 0.5 * width, middle + 0.5 * width};
}

/// What is in one unit has one scale.
Frame frameOf(const WorkspaceResult& workspace) {
  constexpr double usual = 420, flat = 90, least = 180, most = 560;
  Range x, y;
  x.hold(Line{workspace.from.front(), workspace.to.back()});
  y.hold(Line{workspace.besideFrom.front(), workspace.besideTo.back()});
  if (workspace.second.empty()) return {x.padded(0.02), {0, 1}, flat};
  Frame frame{x.padded(0.02), y.padded(0.02), usual};
  if (workspace.firstUnit != workspace.secondUnit) return frame;
  const double across = frame.width - marginLeft - marginRight;
  const double wide = frame.x.high - frame.x.low, high = frame.y.high - frame.y.low;
  const double down = std::clamp(across * high / wide, least, most);
  frame.height = down + marginTop + marginBottom;
  if (across * high > most * wide) frame.x = widened(frame.x, high * across / down);
  if (across * high < least * wide) frame.y = widened(frame.y, wide * down / across);
  return frame;
}

std::string drawn(const WorkspaceResult& workspace, const std::vector<CellRun>& runs, const std::string& label) {
  const Frame frame = frameOf(workspace);
  std::string svg = openedDrawing(frame.height, label, frame.width);
  drawHorizontalAxis(frame, headingOf(workspace.first, workspace.firstUnit), 8, svg);
  if (!workspace.second.empty()) drawVerticalAxis(frame, headingOf(workspace.second, workspace.secondUnit), 8, svg);
  for (const auto& [kind, name] : {std::pair{1.0, "reach-always"}, {0.0, "reach-open"}}) {
    Pen pen;
    for (const CellRun& run : runs) {
      if (run.reached != kind) continue;
      pen.lift();
      pen.go(frame.across(run.from), frame.down(run.besideFrom));
      pen.go(frame.across(run.to), frame.down(run.besideFrom));
      pen.go(frame.across(run.to), frame.down(run.besideTo));
      pen.go(frame.across(run.from), frame.down(run.besideTo));
      pen.close();
    }
    drawPath(name, pen, svg);
  }
  return svg + "</svg>\n";
}

std::string numbersOf(const WorkspaceResult& workspace, const std::vector<CellRun>& runs) {
  NumbersText numbers;
  const auto column = [&](const std::string& head, const std::string& unit, double CellRun::*of) {
    std::vector<double> values;
    for (const CellRun& run : runs) values.push_back(run.*of);
    numbers.column(head, unit, values);
  };
  column(workspace.first + " from", workspace.firstUnit, &CellRun::from);
  column(workspace.first + " to", workspace.firstUnit, &CellRun::to);
  if (!workspace.second.empty()) {
    column(workspace.second + " from", workspace.secondUnit, &CellRun::besideFrom);
    column(workspace.second + " to", workspace.secondUnit, &CellRun::besideTo);
  }
  column("reached (1 always, -1 never, 0 not known)", "", &CellRun::reached);
  return numbers.html();
}

std::string entry(std::string_view name, std::string_view words) {
  return fmt::format("<li><span class=\"swatch {}\"></span>{}</li>\n", name, words);
}

}  // namespace

std::string workspaceSection(const Report& report) {
  const WorkspaceResult& workspace = report.results.of<WorkspaceResult>();
  if (!workspace.present || workspace.reached.data.empty()) return {};
  const std::vector<CellRun> runs = runsOf(workspace);
  const std::string what = workspace.second.empty() ? workspace.first : workspace.first + " and " + workspace.second;
  std::string words;
  for (const std::string& line : workspace.told()) words += fmt::format("<p>{}</p>\n", escapeHtml(line));
  return words + "<ul class=\"keys\" aria-label=\"Key to the map\">\n" +
         entry("reach-always", "reached, for all values of the uncertain quantities") +
         entry("reach-open", "reached for some of them, or not settled") + entry("reach-never", "never reached") +
         "</ul>\n<figure class=\"kept\">" + drawn(workspace, runs, "Map of what " + what + " can reach") +
         "<figcaption>" + escapeHtml("what " + what + " can reach, proved cell by cell") + "</figcaption>" +
         numbersOf(workspace, runs) + "</figure>\n";
}

}  // namespace gamut
