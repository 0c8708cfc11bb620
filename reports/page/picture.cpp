// The picture of the machine with its key, and what it shows in words.
#include <fmt/format.h>

#include <algorithm>

#include "reports/drawing/picture.hpp"
#include "reports/page/page.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

std::string key(std::string_view name, const std::string& words) {
  return fmt::format("<li data-layer=\"{0}\"><span class=\"swatch machine-{0}\"></span>{1}</li>\n", name,
                     escapeHtml(words));
}

std::string keysOf(const Results& results) {
  const PictureResult& machine = results.picture;
  const bool moves = machine.places.time.size() > 1;
  std::string keys = "<ul class=\"keys\" aria-label=\"Key to the picture\">\n";
  keys += key("nominal", moves ? "nominal motion" : "nominal");
  const auto samples = static_cast<long long>(machine.places.sample.size());
  if (samples > 0) keys += key("sample", countText(samples, "sample"));
  if (isEnclosed(machine)) {
    keys += key("now", moves ? "guaranteed place of each point now" : "guaranteed place of each point");
    if (moves)
      keys += key("swept", fmt::format("guaranteed region from 0 s to {}",
                                       reachedText(std::min(results.interval.reached, results.horizon))));
  }
  return keys + "</ul>\n";
}

/// What is shown, and what is not.
std::string caption(const PictureResult& machine, const Scene& scene) {
  std::string words = scene.view.isSideView ? "Side view" : "View from above and aside";
  words += ", at the start";
  if (scene.magnification > 1)
    words += fmt::format(
        "; ways from there are drawn {:g} times as long as they are, and what encloses points so many "
        "times as wide",
        scene.magnification);
  if (!machine.why.empty()) words += "; " + machine.why;
  return words + ".";
}

/// On paper, where nothing moves: six times, evenly from the start to the end.
std::string posesOf(const Scene& scene) {
  constexpr std::size_t poses = 6;
  if (scene.time.size() < 2) return {};
  std::string html = "<div class=\"poses\">\n";
  std::size_t last = scene.time.size();
  for (std::size_t i = 0; i < poses; ++i) {
    const std::size_t row = i * (scene.time.size() - 1) / (poses - 1);
    if (row == last) continue;
    last = row;
    const std::string when = timeText(scene.time[row], 4);
    html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                        drawPose(scene, row, "The machine at " + when), when);
  }
  return html + "</div>\n";
}

}  // namespace

std::string machineSection(const Report& report) {
  const PictureResult& machine = report.results.picture;
  if (!machine.present || machine.points.empty() || machine.places.nominal.empty()) return {};
  const Places& places = machine.places;
  const std::size_t numbers = places.nominal.size() + places.samples.size() + places.lower.size() + places.upper.size();
  if (numbers > report.detail.machineNumbers)
    return fmt::format(
        "<p class=\"hint\">The machine of {} is not drawn here, so that the page stays small; the "
        "results hold its places.</p>\n",
        countText(static_cast<long long>(machine.points.size()), "point"));
  const Scene scene = sceneOf(machine);
  const std::string label =
      fmt::format("The machine at the start: {}, {}", countText(static_cast<long long>(machine.points.size()), "point"),
                  countText(static_cast<long long>(machine.parts.size()), "part"));
  return "<div class=\"picture\">\n" + keysOf(report.results) + "<figure>" + drawScene(scene, label) + "<figcaption>" +
         escapeHtml(caption(machine, scene)) + "</figcaption></figure>\n</div>\n" + posesOf(scene) +
         fmt::format("<script type=\"application/json\" id=\"machine\">{}</script>\n", sceneData(scene));
}

}  // namespace gamut
