// Each bound is rounded in its own direction and to no more digits than a plot shows.
#include "reports/drawing/screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "reports/words.hpp"

namespace gamut {
namespace {

class Writer {
 public:
  explicit Writer(const Plot& plot) : scale_(scaleOf(plot)), decimals_(scale_) {}

  int scale() const { return scale_; }
  std::vector<double> wholes(const Line& line) const {
    std::vector<double> numbers;
    for (const double x : line) numbers.push_back(decimals_.nearest(x));
    return numbers;
  }

  /// Counted from these whole numbers, of which none may be there.
  std::string layers(const std::vector<Layer>& layers, const std::vector<double>& middle) const {
    std::vector<std::string> texts;
    for (const Layer& layer : layers) {
      std::vector<std::string> bands;
      for (const std::size_t i : layer.shown()) {
        const Band& band = layer.bands[i];
        const bool isLine = layer.kind == Layer::Kind::line;
        bands.push_back(isLine ? "[" + from(band.lower, middle, &Decimals::nearest) + "]"
                               : "[" + from(band.lower, middle, &Decimals::below) + "," +
                                     from(band.upper, middle, &Decimals::above) + "]");
      }
      texts.push_back("\n" + layerText(layer, jsonList(bands)));
    }
    return jsonList(texts);
  }

  static std::string ratios(const std::vector<Layer>& layers) {
    std::vector<std::string> texts;
    for (const Layer& layer : layers)
      texts.push_back("\n" + layerText(layer, "[[" + numberList(layer.bands.front().lower, 6) + "]]"));
    return jsonList(texts);
  }

 private:
  static int scaleOf(const Plot& plot) {
    double size = 0;
    for (const Layer& layer : plot.layers)
      for (const Band& band : layer.bands)
        for (const Line* line : {&band.lower, &band.upper})
          for (const double x : *line)
            if (isDrawn(x)) size = std::max(size, std::abs(x));
    constexpr int mostDigits = 15, least = -300;  // so that whole numbers are exact, and powers of ten finite
    return size > 0 ? std::max(least,
                               static_cast<int>(std::floor(std::log10(size))) + 1 - std::min(plot.digits(), mostDigits))
                    : 0;
  }

  std::string from(const Line& line, const std::vector<double>& middle,
                   double (Decimals::*rounded)(double) const) const {
    std::vector<double> wholes;
    for (std::size_t i = 0; i < line.size(); ++i)
      wholes.push_back((decimals_.*rounded)(line[i]) - (i < middle.size() && std::isfinite(middle[i]) ? middle[i] : 0));
    return secondDifferences(wholes);
  }

  static std::string layerText(const Layer& layer, const std::string& bands) {
    using enum Layer::Kind;
    std::vector<std::string> labels, levels;
    for (const std::string& label : layer.labels) labels.push_back(jsonText(label));
    for (const std::size_t i : layer.shown())
      if (i < layer.levels.size())
        levels.push_back(std::isfinite(layer.levels[i]) ? numberText(layer.levels[i], 6) : "null");
    return fmt::format(
        R"({{"name":{},"words":{},"kind":"{}","readout":{},"filled":{},"width":{},"dashed":{},"spread":{},)"
        R"("labels":{},"levels":{},"bands":{}}})",
        jsonText(layer.name), jsonText(layer.words),
        layer.kind == band   ? "band"
        : layer.kind == line ? "line"
                             : "stack",
        jsonText(layer.readout), layer.style.fill > 0, layer.style.width, layer.style.isDashed, layer.isInSpread,
        jsonList(labels), jsonList(levels), bands);
  }

  int scale_;
  Decimals decimals_;
};

}  // namespace

Decimals::Decimals(int scale)
    : scale_(scale), power_(std::strtod(fmt::format("1e{}", std::abs(scale)).c_str(), nullptr)) {}

double Decimals::value(double whole) const { return scale_ < 0 ? whole / power_ : whole * power_; }

double Decimals::nearest(double x) const { return isDrawn(x) ? std::round(scale_ < 0 ? x * power_ : x / power_) : NAN; }

double Decimals::below(double x) const {
  double whole = nearest(x);
  while (value(whole) > x) --whole;
  return whole;
}

double Decimals::above(double x) const {
  double whole = nearest(x);
  while (value(whole) < x) ++whole;
  return whole;
}

std::string jsonList(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ",") + text;
  return "[" + list + "]";
}

std::string numberList(const std::vector<double>& numbers, int digits) {
  std::vector<std::string> texts;
  for (const double x : numbers) texts.push_back(std::isfinite(x) ? numberText(x, digits) : "null");
  return jsonList(texts);
}

std::string secondDifferences(const std::vector<double>& wholes) {
  std::string text;
  bool isFirst = true;
  double value = 0, slope = 0;
  for (const double whole : wholes) {
    text += text.empty() ? "" : ",";
    if (!std::isfinite(whole)) {
      text += "null";
      continue;
    }
    const double change = isFirst ? whole : whole - value - slope;
    slope = isFirst ? 0 : whole - value;
    value = whole;
    isFirst = false;
    text += fmt::format("{:.0f}", change + 0.0);
  }
  return "[" + text + "]";
}

std::string timeData(const Plot& plot, std::size_t times) {
  return "{\"time\":" + numberList(thinned(plot, times).time, 17) + "}";
}

std::string plotData(const Plot& whole, std::size_t times) {
  const Plot plot = thinned(whole, times);
  const Writer writer(whole);
  const std::vector<double> middle = writer.wholes(plot.middle());
  const bool isThinned = plot.time.size() < whole.time.size();
  std::vector<std::string> missed;
  for (const Span& span : plot.missed) missed.push_back(numberList({span.from, span.until}, 12));
  return fmt::format(
      R"({{"name":{},"unit":{},"middleName":{},"thin":{},"scale":{},"middle":{},"layers":{},"around":{},"ratios":{},)"
      R"("missed":{}}})",
      jsonText(plot.name), jsonText(plot.unit), jsonText(plot.middleName()), whole.isThin(), writer.scale(),
      secondDifferences(middle), writer.layers(plot.layers, middle),
      isThinned ? writer.layers(thinned(aroundMiddle(whole), times).layers, {}) : "null", Writer::ratios(plot.ratios),
      jsonList(missed));
}

}  // namespace gamut
