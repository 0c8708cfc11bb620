// Layers in the order of the analyses.
#include "reports/sections/contribution.hpp"

#include <array>
#include <string>
#include <utility>
#include <variant>

namespace gamut {
namespace {

/// Of a part that describes itself: what it holds of the output at all times, bounds as a band, numbers as a line.
void drawFurther(const FurtherPart& part, std::size_t output, Plot& plot) {
  constexpr std::array colours{colour::green, colour::pink, colour::red};
  std::size_t drawn = 0;
  std::vector<Group> groups;
  const_cast<FurtherPart&>(part).describe(groups);  // resize, which alone changes anything, is not called
  for (const Group& group : groups)
    for (const Field& field : group.isList() || group.size == 0 ? std::vector<Field>() : group.fields(0)) {
      if (field.dimensions != std::vector{dimension::time, dimension::output}) continue;
      Layer layer{.name = std::string(part.key()) + std::string(field.name),
                  .words = std::string(field.meaning),
                  .style = {colours[drawn++ % colours.size()], 0.2, 1.2}};
      if (const auto* bounds = std::get_if<Envelope*>(&field.value); bounds != nullptr && !(*bounds)->empty()) {
        layer.bands.push_back(bandOf(**bounds, output));
      } else if (const auto* line = std::get_if<Table*>(&field.value); line != nullptr && !(*line)->empty()) {
        layer.kind = Layer::Kind::line;
        layer.bands.push_back({lineOf(**line, output), {}});
      } else {
        continue;
      }
      plot.layers.push_back(std::move(layer));
    }
}

}  // namespace

Plot plotOf(const Results& results, std::size_t output) {
  const std::string& unit = results.outputs[output].unit;
  Plot plot{results.outputs[output].name, unit == "1" ? "" : unit, results.time, {}, {}};
  for (const Contribution* analysis : analyses) analysis->draw(results, output, plot);
  for (const Boxed<FurtherPart>& part : results.further)
    if (part->present) drawFurther(*part, output, plot);
  return plot;
}

}  // namespace gamut
