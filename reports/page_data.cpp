// Written number by number, since each bound is rounded in its own direction and to no more digits than a plot shows.
#include "reports/page_data.hpp"

#include <cmath>
#include <string_view>
#include <vector>

#include "reports/curves.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

/// [a,b,..] of `count` texts; JSON knows no infinity, so what is not finite is null.
template <class Text>
std::string arrayOf(const std::vector<double>& numbers, Text text) {
  std::string array = "[";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) array += ',';
    array += std::isfinite(numbers[i]) ? text(numbers[i]) : "null";
  }
  return array + "]";
}

std::string lineText(const std::vector<double>& line, int digits) {
  return arrayOf(line, [=](double x) { return numberText(x, digits); });
}

std::string bandText(const Band& band, int digits) {
  return "[" + arrayOf(band.lower, [=](double x) { return outwardText(x, x, digits).first; }) + "," +
         arrayOf(band.upper, [=](double x) { return outwardText(x, x, digits).second; }) + "]";
}

std::string outputText(const Curves& curves) {
  std::string text = "{\"name\":" + jsonText(curves.name) + ",\"unit\":" + jsonText(curves.unit);
  const auto add = [&](std::string_view name, const Band& band) {
    if (!band.empty()) text += ",\"" + std::string(name) + "\":" + bandText(band, curves.digits);
  };
  add("tube", curves.tube);
  add("guaranteed", curves.guaranteed);
  add("sampled", curves.sampled);
  add("probable", curves.probable);
  text += ",\"share\":" + lineText({curves.lowest, curves.highest}, 8);
  if (!curves.median.empty()) text += ",\"median\":" + lineText(curves.median, curves.digits);
  if (!curves.possible.empty()) {
    text += ",\"alpha\":" + lineText(curves.alpha, 8) + ",\"possible\":[";
    for (std::size_t level = 0; level < curves.possible.size(); ++level) {
      text += (level > 0 ? "," : "") + bandText(curves.possible[level], curves.digits);
    }
    text += "]";
  }
  if (!curves.overestimation.empty()) text += ",\"overestimation\":" + lineText(curves.overestimation, 6);
  return text + "}";
}

}  // namespace

std::string pageData(const Results& results) {
  std::string outputs;
  std::vector<double> time = results.time;
  for (std::size_t k = 0; k < results.outputs.size(); ++k) {
    const Curves curves = thinned(curvesOf(results, k), plottedTimes);
    time = curves.time;
    outputs += (k > 0 ? ",\n" : "\n") + outputText(curves);
  }
  return "{\"time\":" + lineText(time, 17) + ",\"outputs\":[" + outputs + "]}";
}

}  // namespace gamut
