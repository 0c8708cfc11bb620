// Few points, since it is an inch wide.
#include "reports/drawing/spark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "reports/drawing/axes.hpp"

namespace gamut {
namespace {

constexpr double sparkWidth = 96, sparkHeight = 22, sparkMargin = 2;
constexpr std::size_t sparkPoints = 96;

/// The first of these that is there.
const Layer* layerOf(const Plot& plot, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const auto layer = std::ranges::find(plot.layers, name, &Layer::name);
        layer != plot.layers.end() && !layer->bands.empty())
      return &*layer;
  return nullptr;
}

class Spark {
 public:
  /// `drawn`: its bands as lines, two of each.
  Spark(Plot drawn, const Plot& whole)
      : plot_(std::move(drawn)),
        best_(layerOf(plot_, {"guaranteed", "sampled", "possible"})),
        middle_(middleOf(whole)) {
    if (best_ != nullptr)
      for (const Band& band : best_->bands) values_.hold(band);
    values_.hold(middle_);
    time_.hold(plot_.time);
  }

  std::string svg() {
    if (!(values_.low <= values_.high)) return {};
    values_ = values_.padded(0);
    std::string svg =
        fmt::format("<svg class=\"spark\" viewBox=\"0 0 {} {}\" aria-hidden=\"true\">", sparkWidth, sparkHeight);
    if (plot_.isOverTime())
      overTime(svg);
    else
      atOnce(svg);
    return svg + "</svg>";
  }

 private:
  /// As plotted.
  Line middleOf(const Plot& whole) const {
    Plot one = whole;
    one.layers = {{.name = "middle", .kind = Layer::Kind::line, .bands = {{whole.middle(), {}}}}};
    one.ratios.clear();
    return thinned(one, sparkPoints).layers[0].bands[0].lower;
  }

  double across(double value, const Range& range) const {
    return sparkMargin + (sparkWidth - 2 * sparkMargin) * (value - range.low) / (range.high - range.low);
  }
  double down(double value) const {
    const double y = sparkHeight - sparkMargin -
                     (sparkHeight - 2 * sparkMargin) * (value - values_.low) / (values_.high - values_.low);
    return std::clamp(y, 0.5, sparkHeight - 0.5);
  }

  void line(std::string_view kind, const Line& numbers, std::string& svg) {
    for (std::size_t i = 0; i < std::min(numbers.size(), plot_.time.size()); ++i)
      pen_.go(across(plot_.time[i], time_), isDrawn(numbers[i]) ? down(numbers[i]) : NAN);
    path(kind, svg);
  }

  void path(std::string_view kind, std::string& svg) {
    if (!pen_.isEmpty()) svg += fmt::format("<path class=\"{}\" d=\"{}\"/>", kind, pen_.take());
  }

  void overTime(std::string& svg) {
    if (best_ != nullptr) {
      for (const Band& band : best_->bands) line("ends", band.lower, svg);
    }
    line("middle", middle_, svg);
    for (const Span& span : plot_.missed) {
      const double from = across(std::max(span.from, time_.low), time_), until = across(span.until, time_);
      svg += fmt::format("<rect class=\"missed\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"3\"/>",
                         std::min(from, sparkWidth - 3), sparkHeight - 3, std::max(until - from, 3.0));
    }
  }

  /// From left to right.
  void atOnce(std::string& svg) {
    for (const auto& [name, half] : {std::pair("guaranteed", 8.0), {"sampled", 8.0}, {"probable", 5.0}}) {
      const Layer* layer = layerOf(plot_, {name});
      if (layer == nullptr || layer->bands.front().lower.empty()) continue;
      const double lower = layer->bands.front().lower[0], upper = layer->bands.front().upper[0];
      if (!isDrawn(lower) || !isDrawn(upper) || (layer != best_ && half > 5)) continue;
      const double from = across(std::max(lower, values_.low), values_),
                   to = across(std::min(upper, values_.high), values_);
      svg += fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"/>",
                         layer == best_ ? "ends" : "likely", from, sparkHeight / 2 - half, std::max(to - from, 1.0),
                         2 * half);
    }
  }

  Plot plot_;
  const Layer* best_;
  Line middle_;
  Range values_, time_;
  Pen pen_;
};

/// A density, but for a factor, or a membership, as its numbers say.
class ShapeCurve {
 public:
  ShapeCurve(const Results& results, const UncertainInfo& quantity, ShapeKind kind) : name_(quantity.shape(kind)) {
    for (const ShapeInfo& number : results.shapes) {
      if (number.quantity != quantity.name || number.shape != kind) continue;
      isOne_ = isOne_ && !number.name.ends_with(", at most");
      numbers_[number.name] = number.value;
    }
  }

  bool isKnown() const {
    constexpr std::array known{"uniform", "triangular", "trapezoidal", "normal", "gaussian", "exponential"};
    return isOne_ && numbers_.contains("lower") && numbers_.contains("upper") &&
           std::ranges::find(known, name_) != known.end();
  }

  double at(double x) const {
    const double lower = of("lower"), upper = of("upper");
    if (x < lower || x > upper) return 0;
    if (name_ == "normal") return bell((x - of("mean")) / of("deviation"));
    if (name_ == "gaussian") return bell((x - of("centre")) / of("deviation"));
    if (name_ == "exponential") return std::exp((lower - x) / of("mean"));
    if (name_ == "trapezoidal") return between(x, lower, of("left"), of("right"), upper);
    if (name_ == "triangular") return between(x, lower, top(), top(), upper);
    return 1;
  }

 private:
  double of(const std::string& name) const {
    const auto found = numbers_.find(name);
    return found == numbers_.end() ? NAN : found->second;
  }
  double top() const { return of(numbers_.contains("mode") ? "mode" : "apex"); }
  static double bell(double x) { return std::exp(-0.5 * x * x); }
  static double between(double x, double lower, double left, double right, double upper) {
    return x < left ? (x - lower) / (left - lower) : x > right ? (upper - x) / (upper - right) : 1;
  }

  std::string name_;
  bool isOne_ = true;
  std::map<std::string, double> numbers_;
};

}  // namespace

std::string drawShape(const Results& results, const UncertainInfo& quantity, ShapeKind kind) {
  const ShapeCurve curve(results, quantity, kind);
  if (!curve.isKnown() || !(quantity.lower < quantity.upper)) return {};
  constexpr int points = 96;
  std::vector<double> heights;
  for (int i = 0; i <= points; ++i)
    heights.push_back(curve.at(quantity.lower + (quantity.upper - quantity.lower) * i / points));
  const double most = *std::ranges::max_element(heights), foot = sparkHeight - sparkMargin;
  if (!(most > 0) || !std::isfinite(most)) return {};
  std::string path = fmt::format("M{} {}", sparkMargin, foot);
  for (int i = 0; i <= points; ++i)
    path += fmt::format("L{:.1f} {:.1f}", sparkMargin + (sparkWidth - 2 * sparkMargin) * i / points,
                        foot - (foot - sparkMargin) * heights[static_cast<std::size_t>(i)] / most);
  return fmt::format(
      "<svg class=\"spark\" viewBox=\"0 0 {} {}\" aria-hidden=\"true\"><path class=\"shape-{}\" d=\"{}L{:.1f} "
      "{}\"/></svg>",
      sparkWidth, sparkHeight, kind == ShapeKind::distribution ? "distribution" : "membership", path,
      sparkWidth - sparkMargin, foot);
}

/// What is best known as two lines, of which extremes are kept: bounds that prove nothing need not lie outside.
std::string drawSpark(const Plot& plot) {
  Plot lines = plot;
  for (Layer& layer : lines.layers) {
    if (!plot.isOverTime() || layer.kind == Layer::Kind::line || layer.bands.empty()) continue;
    const Band band = layer.bands.front();
    layer.kind = Layer::Kind::line;
    layer.bands = {{band.lower, {}}, {band.upper, {}}};
  }
  return Spark(thinned(lines, sparkPoints), plot).svg();
}

}  // namespace gamut
