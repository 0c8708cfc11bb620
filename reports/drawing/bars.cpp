// Kinematics: bars below each other, name and numbers above each; of a stack thin ones, from the narrowest on top down
// to the widest.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reports/drawing/axes.hpp"
#include "reports/drawing/paper.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

constexpr double barHeight = 14, rowHeight = 40, stackHeight = 12, stackHead = 24, labelHeight = 20;

bool isThere(const Band& band) { return !band.lower.empty() && band.lower[0] <= band.upper[0]; }

class BarChart {
 public:
  BarChart(const Plot& plot, const std::string& label) : plot_(plot) {
    Range values;
    double height = marginTop + marginBottom + 6;
    for (const Layer& layer : plot.layers) {
      if (!layer.labels.empty()) {
        for (const Band& band : layer.bands) values.hold(band);
        height += labelHeight * static_cast<double>(layer.bands.size());
      }
      if (layer.kind == Layer::Kind::line) continue;
      if (layer.kind == Layer::Kind::stack) height += stackHead;
      for (const Band& band : layer.bands) {
        if (!isThere(band)) continue;
        values.hold(band);
        widest_ = std::max(widest_, band.upper[0] - band.lower[0]);
        height += layer.kind == Layer::Kind::stack ? stackHeight : rowHeight;
      }
    }
    frame_ = {values.padded(0.04), {0, 1}, height};
    svg_ = openedDrawing(height, label);
  }

  /// Stacks last, below all bars.
  std::string draw() {
    drawHorizontalAxis(frame_, plot_.unit, 7, svg_);
    for (std::size_t i = 0; i < plot_.layers.size(); ++i)
      if (plot_.layers[i].kind == Layer::Kind::band && isThere(plot_.layers[i].bands.front())) drawBar(i);
    for (const Layer& layer : plot_.layers)
      if (layer.kind == Layer::Kind::stack) drawStack(layer);
    for (const Layer& layer : plot_.layers)
      if (!layer.labels.empty()) drawAcross(layer);
    return svg_ + texts_ + "</svg>\n";
  }

 private:
  std::string numbersOf(const Band& band) const {
    const auto [lower, upper] = boundsText(band.lower[0], band.upper[0], 0, 4, widest_);
    return inUnit(fmt::format("[{}, {}]", lower, upper), plot_.unit);
  }

  /// Thin ones stay visible: at least one unit wide.
  void drawRectangle(const Layer& layer, const Band& band, double y, double thickness, const std::string& title) {
    const double from = frame_.across(clipped(band.lower[0], frame_.x)),
                 to = frame_.across(clipped(band.upper[0], frame_.x));
    fmt::format_to(
        std::back_inserter(svg_),
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{}</title></rect>\n",
        layer.name, from, y, std::max(to - from, 1.0), thickness, escapeHtml(title));
  }

  /// Where words of this length begin: at the margin, or to the right of the lines across that would go through them.
  double beginOf(const std::string& words) const {
    constexpr double letter = 10, room = 8;  // as wide as on a phone
    const double width = letter * static_cast<double>(words.size());
    double begin = marginLeft;
    for (bool isMoved = true; isMoved;) {
      isMoved = false;
      for (const Layer& layer : plot_.layers)
        for (const Band& band : layer.bands) {
          if (layer.labels.empty() || !isDrawn(band.lower[0])) continue;
          const double x = frame_.across(band.lower[0]);
          if (!(x > begin - room && x < begin + width) || x + room + width > paperWidth) continue;
          begin = x + room;
          isMoved = true;
        }
    }
    return begin;
  }

  /// With the lines that are drawn on it, which follow it.
  void drawBar(std::size_t i) {
    const Layer& layer = plot_.layers[i];
    const std::string text = layer.words + "  " + numbersOf(layer.bands.front());
    drawText("bar", beginOf(text), y_ + 8, text, texts_);
    drawRectangle(layer, layer.bands.front(), y_ + 13, barHeight, text);
    for (++i; i < plot_.layers.size() && plot_.layers[i].kind == Layer::Kind::line; ++i)
      if (const double value = plot_.layers[i].bands.front().lower[0]; isDrawn(value) && plot_.layers[i].labels.empty())
        fmt::format_to(std::back_inserter(svg_), "<path class=\"{}\" d=\"M{:.1f} {:.1f}v{}\"/>\n", plot_.layers[i].name,
                       frame_.across(clipped(value, frame_.x)), y_ + 11, barHeight + 4);
    y_ += rowHeight;
  }

  /// Numbers that all bars are held against, and what they are called, below each other.
  void drawAcross(const Layer& layer) {
    for (std::size_t i = 0; i < layer.bands.size(); ++i) {
      if (!isDrawn(layer.bands[i].lower[0])) continue;
      const double x = frame_.across(layer.bands[i].lower[0]);
      fmt::format_to(std::back_inserter(svg_), "<path class=\"{}\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n", layer.name, x,
                     marginTop, frame_.height - marginBottom);
      const bool isRight = x > 0.6 * paperWidth;
      drawText(isRight ? "end label" : "label", x + (isRight ? -5 : 5),
               frame_.height - marginBottom - 5 - labelHeight * static_cast<double>(labelled_++), layer.labels[i],
               texts_);
    }
  }

  void drawStack(const Layer& layer) {
    drawText("bar", marginLeft, y_ + 8, layer.words, texts_);
    y_ += 13;
    for (std::size_t i = layer.bands.size(); i-- > 0;) {
      if (!isThere(layer.bands[i])) continue;
      const std::string level = fmt::format("{:g}", layer.levels[i]);
      drawRectangle(layer, layer.bands[i], y_, stackHeight - 1.5, level + ": " + numbersOf(layer.bands[i]));
      drawText("tick end", marginLeft - 6, y_ + 9, level, svg_);
      y_ += stackHeight;
    }
    y_ += stackHead - 13;
  }

  const Plot& plot_;
  double widest_ = 0;  // of all bars
  Frame frame_{};
  double y_ = marginTop + 6;
  std::size_t labelled_ = 0;
  std::string svg_, texts_;  // what is said stands in front of all lines
};

}  // namespace

std::string drawBars(const Plot& plot, const std::string& label) { return BarChart(plot, label).draw(); }

}  // namespace gamut
