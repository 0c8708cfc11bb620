// What is possible.
#include "reports/sections/contribution.hpp"

namespace gamut {
namespace {

/// The most possible: the cut of the highest level.
std::vector<Column> possibleColumns(const Results& results, const Finding&) {
  const FuzzyResult& fuzzy = results.fuzzy;
  if (!fuzzy.present || fuzzy.outer.empty()) return {};
  return {{"most possible", &fuzzy.outer.back(), {}}};
}

void drawPossible(const Results& results, std::size_t output, Plot& plot) {
  const FuzzyResult& fuzzy = results.fuzzy;
  if (!fuzzy.present || fuzzy.outer.empty()) return;
  Layer layer{.name = "possible",
              .words = "possible: alpha-cuts, the narrowest the most possible",
              .style = {colour::orange, 0, 0.8},
              .kind = Layer::Kind::stack,
              .isProved = true,
              .levels = fuzzy.alpha};
  for (const Bounds& cut : fuzzy.outer) layer.bands.push_back(bandOf(cut, output));
  plot.layers.push_back(std::move(layer));
}

}  // namespace

const Contribution possible{possibleColumns, drawPossible};

}  // namespace gamut
