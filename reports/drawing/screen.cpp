// Written number by number, since each bound is rounded in its own direction and to no more digits than a plot shows.
#include "reports/drawing/screen.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/words.hpp"

namespace gamut {
namespace {

/// JSON knows no infinity, so what is not finite is null.
void append(std::string& array, double number, const std::string& text) {
  array += array.empty() ? "" : ",";
  array += std::isfinite(number) ? text : "null";
}

std::string lineText(const Line& line, int digits) {
  std::string array;
  for (const double number : line) append(array, number, numberText(number, digits));
  return "[" + array + "]";
}

std::string bandText(const Band& band, int digits) {
  std::string lower, upper;
  for (std::size_t i = 0; i < band.lower.size(); ++i) {
    const double least = band.lower[i], greatest = band.upper[i];
    if (std::isfinite(least) && std::isfinite(greatest) && least <= greatest) {
      const auto [below, above] = outwardText(least, greatest, digits);
      append(lower, least, below);
      append(upper, greatest, above);
    } else {
      append(lower, least, outwardText(least, least, digits).first);
      append(upper, greatest, outwardText(greatest, greatest, digits).second);
    }
  }
  return "[[" + lower + "],[" + upper + "]]";
}

std::string layerText(const Layer& layer, int digits) {
  using enum Layer::Kind;
  const std::string_view kind = layer.kind == band ? "band" : layer.kind == line ? "line" : "stack";
  std::string bands;
  for (const Band& one : layer.bands) {
    bands += bands.empty() ? "" : ",";
    bands += layer.kind == line ? "[" + lineText(one.lower, digits) + "]" : bandText(one, digits);
  }
  return fmt::format(
      R"({{"name":{},"kind":"{}","readout":{},"filled":{},"width":{},"dashed":{},"spread":{},"bands":[{}]}})",
      jsonText(layer.name), kind, jsonText(layer.readout), layer.style.fill > 0, layer.style.width,
      layer.style.isDashed, layer.isInSpread, bands);
}

std::string layersText(const std::vector<Layer>& layers, int digits) {
  std::string text;
  for (const Layer& layer : layers) text += (text.empty() ? "\n" : ",\n") + layerText(layer, digits);
  return "[" + text + "]";
}

std::string outputText(const Plot& plot) {
  const int digits = plot.digits();
  return fmt::format(R"({{"name":{},"unit":{},"middleName":{},"middle":{},"layers":{},"ratios":{}}})",
                     jsonText(plot.name), jsonText(plot.unit), jsonText(plot.middleName()),
                     lineText(plot.middle(), digits), layersText(plot.layers, digits), layersText(plot.ratios, 6));
}

}  // namespace

void PlotData::add(const Plot& whole) {
  const Plot plot = thinned(whole, plottedTimes);
  time_ = lineText(plot.time, 17);
  outputs_ += (outputs_.empty() ? "\n" : ",\n") + outputText(plot);
}

std::string PlotData::json() const { return "{\"time\":" + time_ + ",\"outputs\":[" + outputs_ + "]}"; }

}  // namespace gamut
