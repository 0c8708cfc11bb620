// Whose doing the spread of an output is, over time, asked in five ways: total and first-order Sobol' indices,
// derivatives, how much narrower the enclosure gets where a quantity is known, and measures of influence. The first
// that is known is shown, the others are folded away.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/drawing/paper.hpp"
#include "reports/drawing/style.hpp"
#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"
#include "studies/analyses/derivatives.hpp"
#include "studies/told.hpp"

namespace gamut {

/// In the order in which they are shown.
enum class Measure : unsigned char { total, first, derivative, pinching, influence };
template <>
inline constexpr std::array<std::string_view, 5> words<Measure>{"total", "first", "derivative", "pinching",
                                                                "influence"};

namespace {

constexpr std::size_t drawnQuantities = 6;
constexpr double visible = 0.005;     // of what is 1 in all
constexpr double tellingShare = 0.5;  // wider bounds of a share would say nothing

/// Numbers over time, one of each quantity, as the results hold them: time, output, quantity.
struct Course {
  const std::vector<double>& time;
  const Grid& numbers;
};

/// Those of an output by a quantity; NaN where there are none.
Line lineOf(const Course& course, std::size_t output, std::size_t quantity) {
  Line line;
  for (std::size_t at = 0; at < course.time.size(); ++at)
    line.push_back(course.numbers.empty() ? std::nan("") : course.numbers(at, output, quantity));
  return line;
}

bool isSomewhere(const Line& line) {
  return std::ranges::any_of(line, [](double x) { return std::isfinite(x); });
}

/// What is known of a quantity: proved bounds, an estimate with half its interval, or a number alone.
struct Cause {
  std::size_t quantity = 0;
  Band proved = {};
  Line estimate = {}, error = {};
  Line number = {};
  double unit = 1;  ///< of the drawing
  double greatest = 0;

  std::array<Line*, 5> lines() { return {&proved.lower, &proved.upper, &estimate, &error, &number}; }

  /// As drawn, at a time; NaN where nothing is known.
  double size(std::size_t i) const {
    if (i < number.size()) return std::abs(number[i]);
    if (i < proved.lower.size() && std::isfinite(proved.lower[i]) && std::isfinite(proved.upper[i]))
      return unit * std::max(std::abs(proved.lower[i]), std::abs(proved.upper[i]));
    return i < estimate.size() ? std::abs(estimate[i]) : std::nan("");
  }

  void rank(std::size_t times) {
    for (std::size_t i = 0; i < times; ++i) greatest = std::fmax(greatest, size(i));
  }
};

/// The greatest first, without those that nobody would see.
std::vector<Cause> ranked(std::vector<Cause> causes, std::size_t times, bool isShare) {
  double least = 0;
  for (Cause& cause : causes) {
    cause.rank(times);
    least = std::max(least, visible * cause.greatest);
  }
  if (isShare) least = visible;
  std::erase_if(causes, [&](const Cause& cause) { return cause.greatest <= least; });
  std::ranges::stable_sort(causes, std::greater<>(), &Cause::greatest);
  return causes;
}

/// One of the five, of one output.
struct Answered {
  Measure measure = Measure::total;
  std::string head = {};                 ///< of a column of the table
  std::string axis = {}, what = {};      ///< at the axis; in the caption
  std::vector<double> time = {};         ///< s
  std::vector<Cause> causes = {};        ///< the greatest first
  std::string bounds = {}, number = {};  ///< what columns of numbers are called
  bool isShare = true;                   ///< from 0 to 1, without a unit
};

// ---- The five -------------------------------------------------------------------------------------------------------

Answered indices(const Results& results, std::size_t output, bool isTotal) {
  const SensitivityResult& s = results.sensitivity;
  const auto& bounds = isTotal ? s.total : s.first;
  const auto& sampled = isTotal ? s.totalSampled : s.firstSampled;
  const auto& error = isTotal ? s.totalError : s.firstError;
  Answered answer{.measure = isTotal ? Measure::total : Measure::first,
                  .head = isTotal ? "total Sobol\u2019 index" : "first-order Sobol\u2019 index",
                  .axis = "share of the variance",
                  .what = isTotal ? "total Sobol\u2019 indices" : "first-order Sobol\u2019 indices",
                  .time = s.time,
                  .bounds = isTotal ? "total Sobol\u2019 index" : "first-order Sobol\u2019 index",
                  .number = "estimate"};
  std::vector<Cause> causes;
  for (std::size_t q = 0; s.present && q < results.uncertain.size(); ++q) {
    Cause cause{.quantity = q};
    cause.proved = {lineOf({s.time, bounds.lower}, output, q), lineOf({s.time, bounds.upper}, output, q)};
    for (std::size_t i = 0; i < s.time.size(); ++i)
      if (!(cause.proved.upper[i] - cause.proved.lower[i] < tellingShare))
        cause.proved.lower[i] = cause.proved.upper[i] = std::nan("");
    cause.estimate = lineOf({s.time, sampled}, output, q);
    cause.error = lineOf({s.time, error}, output, q);
    causes.push_back(std::move(cause));
  }
  answer.causes = ranked(std::move(causes), answer.time.size(), true);
  return answer;
}

/// Of a share.
Answered shares(const Results& results, std::size_t output, const Course& course, Answered answer) {
  answer.time = course.time;
  answer.number = answer.head;
  std::vector<Cause> causes;
  for (std::size_t q = 0; q < results.uncertain.size(); ++q)
    causes.push_back({.quantity = q, .number = lineOf(course, output, q)});
  answer.causes = ranked(std::move(causes), answer.time.size(), true);
  return answer;
}

/// Drawn times half the width of the quantity's interval, so that all are in the output's unit: by the mean value
/// theorem the output changes by no more where the quantity alone moves from the middle of its interval to an end.
Answered derivatives(const Results& results, std::size_t output) {
  const auto& d = results.of<DerivativeResult>();
  Answered answer{.measure = Measure::derivative,
                  .head = "derivative",
                  .axis = headingOf("change", results.outputs[output].unit),
                  .what = "derivatives times half the width of each interval",
                  .time = d.time,
                  .bounds = "derivative",
                  .number = "",
                  .isShare = false};
  std::vector<Cause> causes;
  for (std::size_t q = 0; d.present && q < results.uncertain.size(); ++q) {
    const UncertainInfo& quantity = results.uncertain[q];
    Cause cause{.quantity = q};
    cause.proved = {lineOf({d.time, d.lower}, output, q), lineOf({d.time, d.upper}, output, q)};
    const Told told(quantity);
    for (std::size_t i = 0; i < d.time.size(); ++i) {
      double &lower = cause.proved.lower[i], &upper = cause.proved.upper[i];
      std::tie(lower, upper) =
          std::isfinite(upper - lower) ? told.perOne(lower, upper) : Told::Bounds(std::nan(""), std::nan(""));
    }
    cause.unit = told.of(0.5 * (quantity.upper - quantity.lower));
    causes.push_back(std::move(cause));
  }
  answer.causes = ranked(std::move(causes), answer.time.size(), false);
  return answer;
}

// ---- Figures --------------------------------------------------------------------------------------------------------

/// About so many times, equally far from each other, the last among them.
std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> picked;
  const std::size_t number = std::min(count, most);
  for (std::size_t i = 0; i < number; ++i) picked.push_back(number == 1 ? 0 : i * (count - 1) / (number - 1));
  return picked;
}

/// At no more times than that, of those at which something is known.
Answered thinned(Answered answer, std::size_t most) {
  std::vector<std::size_t> known, rows;
  for (std::size_t i = 0; i < answer.time.size(); ++i)
    if (std::ranges::any_of(answer.causes, [&](const Cause& cause) { return std::isfinite(cause.size(i)); }))
      known.push_back(i);
  for (const std::size_t i : spread(known.size(), most)) rows.push_back(known[i]);
  const auto pick = [&](std::vector<double>& line) {
    std::vector<double> some;
    for (const std::size_t i : rows)
      if (i < line.size()) some.push_back(line[i]);
    line = std::move(some);
  };
  pick(answer.time);
  for (Cause& cause : answer.causes)
    for (Line* line : cause.lines()) pick(*line);
  return answer;
}

std::string derivativeUnit(const Results& results, std::size_t output, std::size_t quantity) {
  const auto named = [](const std::string& unit) { return unit.empty() ? "1" : unit; };
  return named(results.outputs[output].unit) + " per " + named(Told(results.uncertain[quantity]).unit());
}

/// Colours say which quantity it is, the same in all figures. The first three look different to everybody; violet,
/// green and red, which are blue, black and orange to some, are dashed where these are solid.
Layer layerOf(const Results& results, std::size_t quantity) {
  constexpr std::array colours{colour::blue, colour::orange, colour::black, colour::violet, colour::red, colour::green};
  const bool isLikeAnother = quantity % colours.size() >= colours.size() / 2,
             isSecondRound = quantity / colours.size() % 2 == 1;
  return {.name = fmt::format("cause{}", quantity),
          .words = results.uncertain[quantity].name,
          .style = {colours[quantity % colours.size()], 0.35, 1.4, isLikeAnother != isSecondRound},
          .isProved = true};
}

Plot plotOf(const Results& results, std::size_t output, const Answered& answer) {
  constexpr std::size_t estimates = 11;
  Plot plot;
  plot.name = results.outputs[output].name;
  plot.unit = answer.axis;
  plot.time = answer.time;
  for (const Cause& cause : answer.causes) {
    Layer layer = layerOf(results, cause.quantity);
    if (isSomewhere(cause.number)) {
      layer.kind = Layer::Kind::line;
      layer.bands = {{cause.number, {}}};
    } else {
      layer.bands = {cause.proved};
      for (Line* line : {&layer.bands[0].lower, &layer.bands[0].upper})
        for (double& x : *line) x *= cause.unit;
    }
    plot.layers.push_back(std::move(layer));
  }
  const std::vector<std::size_t> rows = spread(answer.time.size(), estimates);
  for (const Cause& cause : answer.causes) {
    if (!isSomewhere(cause.estimate)) continue;
    Layer layer = layerOf(results, cause.quantity);
    layer.kind = Layer::Kind::whisker;
    Band& band =
        layer.bands.emplace_back(Band{Line(answer.time.size(), std::nan("")), Line(answer.time.size(), std::nan(""))});
    for (const std::size_t i : rows) {
      band.lower[i] = cause.estimate[i] - cause.error[i];
      band.upper[i] = cause.estimate[i] + cause.error[i];
    }
    plot.layers.push_back(std::move(layer));
  }
  return plot;
}

/// As the tables of shares and derivatives, but at all times.
std::string numbersOf(const Results& results, std::size_t output, const Answered& answer) {
  NumbersText numbers;
  numbers.column("time", "s", answer.time);
  const auto add = [&](const std::string& head, const Line& line, NumbersText::Rounded rounded, int digits) {
    if (isSomewhere(line)) numbers.column(head, "", line, rounded, digits);
  };
  for (const Cause& cause : answer.causes) {
    const UncertainInfo& quantity = results.uncertain[cause.quantity];
    using enum NumbersText::Rounded;
    const int digits = answer.isShare ? 4 : 6;
    add(fmt::format("{} by {}{}, from", answer.bounds, quantity.name,
                    answer.isShare ? "" : " (" + derivativeUnit(results, output, cause.quantity) + ")"),
        cause.proved.lower, down, digits);
    add("to", cause.proved.upper, up, digits);
    add(fmt::format("{} of {}", answer.number, quantity.name), cause.estimate, nearest, 4);
    add("±", cause.error, nearest, 2);
    add(fmt::format("{} of {}", answer.number, quantity.name), cause.number, nearest, 4);
  }
  return numbers.html();
}

/// Who has the greatest share, at how many of the times.
std::string leadersOf(const Results& results, const Answered& answer) {
  std::vector<std::pair<std::size_t, std::string>> leaders;
  for (const Cause& cause : answer.causes) leaders.emplace_back(0, results.uncertain[cause.quantity].name);
  std::size_t known = 0;
  for (std::size_t i = 0; i < answer.time.size(); ++i) {
    std::size_t first = leaders.size();
    double greatest = 0;
    for (std::size_t c = 0; c < leaders.size(); ++c)
      if (const double size = answer.causes[c].size(i); size > greatest) first = c, greatest = size;
    if (first == leaders.size()) continue;
    ++leaders[first].first;
    ++known;
  }
  std::erase_if(leaders, [](const auto& leader) { return leader.first == 0; });
  std::ranges::stable_sort(leaders, std::greater<>(), [](const auto& leader) { return leader.first; });
  if (leaders.empty() || answer.causes.size() < 2) return {};
  if (leaders.size() == 1) return fmt::format("; the greatest throughout: {}", leaders[0].second);
  std::string text;
  constexpr std::size_t most = 3;
  for (std::size_t i = 0; i < std::min(most, leaders.size()); ++i)
    text += fmt::format("{}{} at {:.0f} %", text.empty() ? "; the greatest: " : ", ", leaders[i].second,
                        100.0 * static_cast<double>(leaders[i].first) / static_cast<double>(known));
  return text + " of the times";
}

/// The layers go to the style sheet and to the key.
std::string figureOf(const Results& results, std::size_t output, const Answered& whole, std::size_t times,
                     StyleSheet& style, std::vector<Layer>& key) {
  Answered answer = thinned(whole, times);
  const std::string leaders = leadersOf(results, whole);
  if (answer.causes.size() > drawnQuantities) answer.causes.resize(drawnQuantities);
  const Plot plot = plotOf(results, output, answer);
  style.add(plot);
  for (const Layer& layer : plot.layers)
    if (std::ranges::find(key, layer.name, &Layer::name) == key.end()) key.push_back(layer);
  const std::string label = fmt::format("Plot of {} of {} over time", answer.what, plot.name);
  return fmt::format(
      "<figure class=\"kept {}\">{}<figcaption>{} at {} times, joined by lines{}</figcaption>{}</figure>\n",
      wordOf(answer.measure), drawSmall(plot, label, answer.isShare), answer.what, answer.time.size(),
      escapeHtml(leaders), numbersOf(results, output, answer));
}

// ---- The table ------------------------------------------------------------------------------------------------------

/// Of the times at which something is known of any quantity, the nearest to an instant.
std::size_t nearestRow(const Answered& answer, double instant) {
  std::size_t nearest = answer.time.size();
  for (std::size_t i = 0; i < answer.time.size(); ++i) {
    if (nearest < i && !(std::abs(answer.time[i] - instant) <= std::abs(answer.time[nearest] - instant))) continue;
    if (std::ranges::any_of(answer.causes, [&](const Cause& cause) { return std::isfinite(cause.size(i)); }))
      nearest = i;
  }
  return nearest;
}

/// "0.6942 to 0.6951 (0.701 ± 0.018)": what is proved, and what is estimated; no digits of hardly any share.
std::string cellOf(const Cause& cause, std::size_t i, bool isShare) {
  constexpr int digits = 3;
  constexpr double least = 1e-4;  // that is told of a share
  if (i < cause.number.size())
    return !isShare                       ? numberText(cause.number[i], digits)
           : isLittle(cause.number[i], 1) ? "0"
                                          : fmt::format("{:.{}f}", cause.number[i], digits);
  std::string text, estimate;
  if (i < cause.proved.lower.size() && std::isfinite(cause.proved.lower[i])) {
    constexpr double finest = 1e-3;  // width of a share
    const double lower = cause.proved.lower[i], upper = cause.proved.upper[i];
    const auto [from, to] = isShare ? outwardBounds(lower, upper, 1, 2, finest) : outwardText(lower, upper, digits);
    if (!isShare || lower > 0 || upper < 1)  // else nothing is known
      text = isShare && upper < least ? "less than 0.0001" : from == to ? from : from + " to " + to;
  }
  if (i < cause.estimate.size() && std::isfinite(cause.estimate[i]))
    estimate = isShare && cause.error[i] < 10 * least
                   ? fmt::format("{:.4f} ± {:.4f}", std::round(cause.estimate[i] / least) * least + 0.0,
                                 std::ceil(cause.error[i] / least) * least)
                   : withErrorText(cause.estimate[i], cause.error[i]);
  if (text.empty() && estimate.empty()) return isShare ? "not known" : "";
  return estimate.empty() ? text : text.empty() ? "about " + estimate : fmt::format("{} ({})", text, estimate);
}

/// One row a quantity, the greatest first; a column for each that is known, at the instant that matters, or next to it.
std::string tableOf(const Results& results, std::size_t output, const std::vector<Answered>& answers,
                    const Answered& leading) {
  std::vector<std::string> heads{"quantity"};
  std::vector<const Answered*> columns;
  const double instant = instantOf(results, output);
  const std::size_t row = nearestRow(leading, instant);
  for (const Answered& answer : answers) {
    if (answer.causes.empty()) continue;
    columns.push_back(&answer);
    const double time = answer.time[nearestRow(answer, instant)];
    heads.push_back(answer.head + (time != leading.time[row] ? " (at " + timeText(time) + ")" : ""));
  }
  std::vector<const Cause*> order;
  for (const Cause& cause : leading.causes) order.push_back(&cause);
  const auto size = [&](const Cause* cause) { return std::fmax(cause->size(row), 0.0); };
  std::ranges::stable_sort(order, std::greater<>(), size);
  TableText table(results.horizon > 0 ? "At " + timeText(leading.time[row]) : "All that is known", heads);
  for (const Cause* ranked : order) {
    std::vector<std::string> cells;
    for (const Answered* answer : columns) {
      const auto cause = std::ranges::find(answer->causes, ranked->quantity, &Cause::quantity);
      const std::size_t i = nearestRow(*answer, instant);
      cells.push_back(cause == answer->causes.end() || std::isnan(cause->size(i)) ? ""
                                                                                  : cellOf(*cause, i, answer->isShare));
      if (!answer->isShare && !cells.back().empty())
        cells.back() += " " + derivativeUnit(results, output, ranked->quantity);
    }
    table.row(results.uncertain[ranked->quantity].name, cells);
  }
  return table.html();
}

/// Among several quantities; of a single one there are derivatives alone.
std::vector<Answered> answersOf(const Results& results, std::size_t output) {
  const SensitivityResult& s = results.sensitivity;
  const InfluenceResult& influence = results.fuzzy.influence;
  if (results.uncertain.size() < 2) return {derivatives(results, output)};
  std::vector<Answered> answers{indices(results, output, true), indices(results, output, false),
                                derivatives(results, output)};
  if (s.present)
    answers.push_back(shares(results, output, {s.time, s.pinched},
                             {.measure = Measure::pinching,
                              .head = "narrowing",
                              .axis = "narrower by",
                              .what = "narrowing of the enclosure where a quantity is known"}));
  if (influence.present)
    answers.push_back(shares(results, output, {influence.time, influence.share},
                             {.measure = Measure::influence,
                              .head = "influence",
                              .axis = "influence",
                              .what = "measures of influence (Hanss)"}));
  return answers;
}

/// What the figures of these say; the first of them is said to everybody.
std::string hintsOf(const std::set<Measure>& measures, const Results& results) {
  const SensitivityResult& s = results.sensitivity;
  const auto& d = results.of<DerivativeResult>();
  constexpr std::array meanings = {
      "Total Sobol\u2019 index: the share of an output\u2019s variance that would stay if all other quantities were "
      "known. It is proved to lie in the band of each quantity. The greatest is what to measure better first.",
      "First-order Sobol\u2019 index: the share of the variance that would vanish on average if the quantity were "
      "known.",
      "Derivatives: proved, for all values in the intervals. Drawn times half the width of the quantity\u2019s "
      "interval: the output changes by no more where that quantity alone moves from the middle of it to an end.",
      "Narrowing: the share by which the enclosure of the output narrows where the quantity has its nominal value "
      "alone.",
      "Measure of influence (Hanss): the quantity\u2019s share in what deviations by equal shares of the "
      "quantities\u2019 values do to the output. Of one whose values lie about zero it says nothing."};
  std::string first, others;
  for (const Measure measure : measures) {
    std::string text = meanings[static_cast<std::size_t>(measure)];
    if (measure == Measure::total && s.samples > 0 && !s.totalSampled.empty())
      text += fmt::format(" Strokes: estimates with their intervals of 95 % confidence, from {} independent samples.",
                          s.samples);
    if (measure == Measure::derivative && !d.why.empty())
      text += fmt::format(" They are known up to {}: {}.", reachedText(d.reached), escapeHtml(d.why));
    if (first.empty())
      first = fmt::format("<p class=\"hint\">{}</p>\n", text);
    else
      others += fmt::format("<li>{}</li>\n", text);
  }
  if (others.empty()) return first;
  return first + "<details class=\"more\"><summary>What the other measures say</summary><ul class=\"notes\">\n" +
         others + "</ul></details>\n";
}

}  // namespace

PlotSection sensitivityPlots(const Results& results, const Detail& detail) {
  PlotSection section;
  constexpr std::size_t shownTimes = 1001, foldedTimes = 65;
  StyleSheet style;
  std::vector<Layer> key;
  std::set<Measure> measures;
  std::string cards;
  for (std::size_t output = 0; output < results.outputs.size(); ++output) {
    if (!detail.cards(output)) continue;
    const std::vector<Answered> answers = answersOf(results, output);
    const auto leading = std::ranges::find_if(answers, [](const Answered& answer) { return !answer.causes.empty(); });
    if (leading == answers.end()) continue;
    std::string first, others;
    for (const Answered& answer : answers) {
      if (answer.causes.empty()) continue;
      measures.insert(answer.measure);
      if (thinned(answer, 2).time.size() < 2) continue;
      std::string& place = first.empty() ? first : others;
      place += figureOf(results, output, answer, first.empty() ? shownTimes : foldedTimes, style, key);
    }
    const std::string table = tableOf(results, output, answers, *leading);
    if (!first.empty())
      others =
          "<details class=\"more wide\"><summary>Other measures, and the ranking in numbers</summary>\n<div "
          "class=\"cards\">\n" +
          others + "</div>\n" + table + "</details>\n";
    cards += fmt::format("<section class=\"card\">\n<h3>{}</h3>\n{}{}</section>\n",
                         escapeHtml(results.outputs[output].name), first, first.empty() ? table : others);
  }
  if (cards.empty()) return section;
  section.html = hintsOf(measures, results);
  if (const std::string& why = results.sensitivity.why; !why.empty())
    section.html += fmt::format("<p class=\"hint\">There are no Sobol’ indices: {}.</p>\n", escapeHtml(why));
  if (!key.empty()) {
    std::ranges::sort(key, {}, [](const Layer& layer) { return std::pair(layer.name.size(), layer.name); });
    section.html += drawKey(key, "Key to the quantities");
  }
  section.html += "<div class=\"cards\">\n" + cards + "</div>\n";
  section.style = style.css();
  return section;
}

std::string sensitivitySection(const Report& report) { return report.sensitivities.html; }

}  // namespace gamut
