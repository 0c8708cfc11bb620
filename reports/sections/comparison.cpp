// How the answers agree.
#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/sections/contribution.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

double greatestOverestimation(const ComparisonResult& comparison, std::size_t output) {
  if (comparison.overestimation.empty() && output < comparison.maximumOf.size()) return comparison.maximumOf[output];
  double greatest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < comparison.overestimation.times; ++i)
    greatest = std::fmax(greatest, comparison.overestimation(i, output));
  return greatest;
}

std::vector<Column> comparedColumns(const Results& results, const Finding& finding) {
  if (std::isnan(finding.overestimation)) return {};
  Column column{"overestimation, at most", nullptr, {}};
  for (std::size_t k = 0; k < results.outputs.size(); ++k)
    column.texts.push_back(timesText(greatestOverestimation(results.comparison, k)));
  return {column};
}

void drawCompared(const Results& results, std::size_t output, Plot& plot) {
  const Line ratio = lineOf(results.comparison.overestimation, output);
  if (std::ranges::none_of(ratio, [](double x) { return std::isfinite(x); })) return;
  plot.ratios.push_back({.name = "overestimation",
                         .words = "overestimation (width guaranteed / width sampled)",
                         .readout = "overestimation",
                         .style = {colour::blue, 0, 1.4},
                         .kind = Layer::Kind::line,
                         .bands = {{ratio, {}}}});
}

}  // namespace

const Contribution compared{comparedColumns, drawCompared};

}  // namespace gamut
