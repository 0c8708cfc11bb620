// Lines join the ends of the cuts. Between levels they prove nothing: there stairs do, since a value outside a level's
// cut has a lower membership.
#include "reports/drawing/membership.hpp"

#include <cmath>
#include <vector>

#include "reports/drawing/axes.hpp"
#include "reports/words.hpp"

namespace gamut {
std::vector<Cut> cutsOf(const std::vector<double>& alpha, const std::vector<Envelope>& bounds, std::size_t time,
                        std::size_t output) {
  std::vector<Cut> cuts;
  for (std::size_t level = 0; level < bounds.size() && level < alpha.size(); ++level) {
    if (bounds[level].empty() || time >= bounds[level].lower.times) continue;
    const Cut cut{alpha[level], bounds[level].lower(time, output), bounds[level].upper(time, output)};
    if (std::isfinite(cut.lower) && std::isfinite(cut.upper) && cut.lower <= cut.upper) cuts.push_back(cut);
  }
  return cuts;
}

std::string drawMembership(const Results& results, std::size_t time, std::size_t output, const std::string& label) {
  const FuzzyResult& fuzzy = results.fuzzy;
  const std::vector<Cut> outer = cutsOf(fuzzy.alpha, fuzzy.outer, time, output),
                         inner = cutsOf(fuzzy.alpha, fuzzy.inner, time, output);
  if (outer.empty()) return {};
  Range values;
  for (const Cut& cut : outer) values.hold(Line{cut.lower, cut.upper});
  const Frame frame{values.padded(0.04), {0, 1.04}, smallHeight, smallWidth};
  std::string svg = openedDrawing(frame.height, label, frame.width);
  drawHorizontalAxis(frame, headingOf(results.outputs[output].name, results.outputs[output].unit), 4, svg);
  drawVerticalAxis(frame, "membership", 5, svg);
  Pen pen;
  const auto go = [&](double value, double alpha) { pen.go(frame.across(clipped(value, frame.x)), frame.down(alpha)); };
  const auto levelAfter = [&](std::size_t i) { return i + 1 < outer.size() ? outer[i + 1].alpha : 1; };
  go(outer.front().lower, 0);
  for (std::size_t i = 0; i < outer.size(); ++i) {
    if (i > 0) go(outer[i].lower, outer[i].alpha);
    go(outer[i].lower, levelAfter(i));
  }
  for (std::size_t i = outer.size(); i-- > 0;) {
    go(outer[i].upper, levelAfter(i));
    if (i > 0) go(outer[i].upper, outer[i].alpha);
  }
  go(outer.front().upper, 0);
  pen.close();
  drawPath("above", pen, svg);
  for (const auto* cuts : {&outer, &inner}) {
    for (const Cut& cut : *cuts) go(cut.lower, cut.alpha);
    for (std::size_t i = cuts->size(); i-- > 0;) go((*cuts)[i].upper, (*cuts)[i].alpha);
    drawPath(cuts == &outer ? "outer" : "inner", pen, svg);
  }
  return svg + "</svg>\n";
}

}  // namespace gamut
