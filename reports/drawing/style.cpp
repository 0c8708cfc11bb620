// A layer's colours are variables, NAME and NAME-fill, which the script reads too; light and dark in turn.
#include "reports/drawing/style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gamut {
namespace {

std::string variables(const Layer& layer, std::string_view colour) {
  const auto opacity = static_cast<int>(std::lround(255 * layer.style.fill));
  return fmt::format("--{0}:{1};--{0}-fill:{1}{2:02x};", layer.name, colour, opacity);
}

/// In the key: a patch of the band, an outline, a line, or for a stack outlines one in the other.
std::string swatch(const Layer& layer) {
  const std::string line = fmt::format("{}px {} var(--{})", layer.style.fill > 0 ? 1.5 : 2,
                                       layer.style.isDashed ? "dashed" : "solid", layer.name);
  if (layer.kind == Layer::Kind::stack)  // lines in lines
    return fmt::format("border:1px solid var(--{0});box-shadow:inset 0 0 0 2px var(--paper),inset 0 0 0 3px var(--{0})",
                       layer.name);
  if (layer.style.fill == 0 && layer.kind == Layer::Kind::band && !layer.style.isDashed)
    return fmt::format("border:{}px solid var(--{})", layer.style.width > 1 ? 2 : 1, layer.name);
  if (layer.style.fill == 0) return "height:0;border-radius:0;border-top:" + line;
  return fmt::format("background:var(--{}-fill)", layer.name) + (layer.style.width > 0 ? ";border:" + line : "");
}

}  // namespace

void StyleSheet::add(const Plot& plot) {
  for (const auto* layers : {&plot.layers, &plot.ratios})
    for (const Layer& layer : *layers) {
      if (!names_.insert(layer.name).second) continue;
      light_ += variables(layer, layer.style.colour.light);
      dark_ += variables(layer, layer.style.colour.dark);
      if (layer.style.fill > 0) rules_ += fmt::format(".drawing .{0}{{fill:var(--{0}-fill)}}\n", layer.name);
      if (layer.style.width > 0)
        rules_ += fmt::format(".drawing .{0}{{stroke:var(--{0});stroke-width:{1}{2}}}\n", layer.name, layer.style.width,
                              layer.style.isDashed ? ";stroke-dasharray:5 3" : "");
      rules_ += layer.style.fill > 0
                    ? fmt::format(".drawing rect.{0}{{fill:var(--{0});opacity:.6;stroke:none}}\n", layer.name)
                    : fmt::format(".drawing rect.{0}{{fill:none}}\n", layer.name);
      rules_ += fmt::format(".swatch.{}{{{}}}\n", layer.name, swatch(layer));
    }
}

std::string StyleSheet::css() const {
  return fmt::format(":root{{{}}}\n@media screen and (prefers-color-scheme: dark){{:root:not([data-paper]){{{}}}}}\n{}",
                     light_, dark_, rules_);
}

}  // namespace gamut
