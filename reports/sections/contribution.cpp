// Layers in the order of the analyses.
#include "reports/sections/contribution.hpp"

#include <array>
#include <span>
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
      const auto* numbers = std::get_if<Numbers>(&field.value);
      if (numbers == nullptr || numbers->empty()) continue;
      std::vector<double> room;
      Band& band = layer.bands.emplace_back();
      if (numbers->ends().size() == 1) layer.kind = Layer::Kind::line;
      for (std::size_t end = 0; end < numbers->ends().size(); ++end) {
        const std::span<const double> all = numbers->all(end, room);
        for (std::size_t i = output; i < all.size(); i += all.size() / plot.time.size())
          (end == 0 ? band.lower : band.upper).push_back(all[i]);
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
