// The requirements, a card each: what is known in a sentence, the margin and the motion where that is least, and the
// three answers side by side.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "reports/drawing/axes.hpp"
#include "reports/drawing/paper.hpp"
#include "reports/page/page.hpp"
#include "reports/plain.hpp"
#include "reports/requirements.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"
#include "studies/told.hpp"

namespace gamut {
namespace {

/// Where a margin is least.
struct Worst {
  std::size_t row = 0, margin = 0;  ///< the output time nearest to that instant; the output that is the margin
};

std::optional<Worst> worstOf(const Results& results, const RequirementResult& requirement) {
  const Bounds* known = bestKnown(results);
  const double instant = decisiveTime(results, requirement);
  if (known == nullptr || results.time.empty() || std::isnan(instant)) return {};
  const auto nearest = std::ranges::min_element(results.time, {}, [&](double t) { return std::abs(t - instant); });
  Worst worst{static_cast<std::size_t>(nearest - results.time.begin()), 0};
  double least = INFINITY;
  for (const MarginInfo& margin : marginsOf(results, requirement))
    if (const double lower = known->lower(worst.row, margin.output); lower < least)
      least = lower, worst.margin = margin.output;
  return std::isfinite(least) ? std::optional(worst) : std::nullopt;
}

/// A view's share in the drawing of a margin.
struct Mark {
  const char *name, *words;
  double lower = 0, upper = 0;
};

/// What is guaranteed, probable and most possible there, as far as it is known, from back to front.
std::vector<Mark> marksOf(const Results& results, const Worst& at) {
  std::vector<Mark> marks;
  const auto add = [&](const char* name, const char* words, const auto& lower, const auto& upper) {
    if (at.row >= results.time.size() || lower.empty()) return;
    const double low = lower(at.row, at.margin), high = upper(at.row, at.margin);
    if (isDrawn(low) && isDrawn(high) && low <= high) marks.push_back({name, words, low, high});
  };
  add("mark-guaranteed", "guaranteed (outline)", results.interval.at.lower, results.interval.at.upper);
  const std::vector<double>& probabilities = results.stochastic.probabilities;
  const auto low = std::ranges::find(probabilities, 0.05), high = std::ranges::find(probabilities, 0.95);
  const bool areQuantilesThere = results.stochastic.quantiles.size() == probabilities.size();
  if (low != probabilities.end() && high != probabilities.end() && areQuantilesThere)
    add("mark-probable", "5 to 95 % of the samples (filled)", results.stochastic.quantiles[low - probabilities.begin()],
        results.stochastic.quantiles[high - probabilities.begin()]);
  if (results.fuzzy.present && !results.fuzzy.outer.empty())
    add("mark-core", "most possible (inner outline)", results.fuzzy.outer.back().lower,
        results.fuzzy.outer.back().upper);
  return marks;
}

/// Whether a margin is above a limit; below it, it is drawn as its output lies: beyond an upper limit to the right.
bool isAboveLimit(const Results& results, std::size_t margin) {
  const auto info = std::ranges::find(results.margins, margin, &MarginInfo::output);
  return info == results.margins.end() || info->isAbove;
}

/// The views nested about one line, and a red one at the limit, beyond which the requirement is violated.
std::string marginBar(const Results& results, const RequirementResult& requirement, const Worst& at) {
  constexpr double width = 320, height = 44, middle = 18, least = 2;
  const std::vector<Mark> marks = marksOf(results, at);
  if (marks.empty()) return {};
  const Mark& widest = marks.front();
  Range range;
  range.hold(0);
  std::vector<std::string> words;
  const auto info = std::ranges::find(results.margins, at.margin, &MarginInfo::output);
  const Told told(results.outputs[at.margin].unit, info == results.margins.end() ? "" : info->unit);
  for (const Mark& mark : marks) {
    range.hold(mark.lower);
    range.hold(mark.upper);
    const auto [low, high] = told.of(mark.lower, mark.upper);
    const auto [lower, upper] = boundsText(low, high, 0, 3, told.of(widest.upper - widest.lower));
    words.push_back(fmt::format("{} {}", mark.words,
                                inUnit(lower == upper ? lower : fmt::format("{} to {}", lower, upper), told.unit())));
  }
  const Range padded = range.padded(0.06);
  const bool isAbove = isAboveLimit(results, at.margin);
  const auto across = [&](double value) {
    const double share = (value - padded.low) / (padded.high - padded.low);
    return width * (isAbove ? share : 1 - share);
  };
  const std::string when =
      results.horizon > 0 ? fmt::format(" at {} s", numberText(results.time[at.row], 6)) : std::string();
  const std::string label = fmt::format("Margin of {}{}: {}", requirement.name, when, fmt::join(words, "; "));
  std::string svg = fmt::format(
      "<svg class=\"drawing margin\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n"
      "<rect class=\"missed\" x=\"{:.1f}\" y=\"4\" width=\"{:.1f}\" height=\"{}\"/>\n",
      width, height, escapeHtml(label), isAbove ? 0.0 : across(0), isAbove ? across(0) : width - across(0),
      2 * (middle - 4));
  double half = 10;
  for (const Mark& mark : marks) {
    const auto [left, right] = std::minmax({across(mark.lower), across(mark.upper)});
    const double wide = std::max(right - left, least);
    svg += fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"1.5\"/>\n",
                       mark.name, left, middle - half, wide, 2 * half);
    half -= 3.5;
  }
  svg += fmt::format("<path class=\"zero\" d=\"M{0:.1f} 2V34\"/>\n", across(0));
  drawText("middle", std::clamp(across(0), 14.0, width - 14), height - 1, "limit", svg);
  if (requirement.isViolatedBetween) words.emplace_back("the violation lies between output times");
  const std::string to = info == results.margins.end() ? "" : " to the limit of " + info->limitText;
  return fmt::format("<figure class=\"margin\">{}</svg>\n<figcaption>Margin{}</figcaption></figure>\n", svg,
                     escapeHtml(fmt::format("{}{}: {}", to, when, fmt::join(words, "; "))));
}

/// The same between these rows.
Plot cropped(Plot plot, std::size_t from, std::size_t until) {
  const auto cut = [&](Line& line) {
    if (line.size() <= from) return line.clear();
    line.resize(std::min(line.size(), until));
    line.erase(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(from));
  };
  cut(plot.time);
  for (Layer& layer : plot.layers)
    for (Band& band : layer.bands) cut(band.lower), cut(band.upper);
  plot.ratios.clear();
  return plot;
}

/// The motion about that instant, with the limits: a sixteenth of the time to either side, or six output times.
std::string closeUp(const Report& report, std::size_t requirement, const Worst& at) {
  const Results& results = report.results;
  const std::size_t rows = results.time.size();
  if (results.horizon == 0 || rows < 3) return {};
  const std::vector<Limit> limits = limitsOf(results);
  const auto limit = std::ranges::find(limits, at.margin, &Limit::margin);
  if (limit == limits.end()) return {};
  const std::size_t beside = std::max<std::size_t>(6, rows / 16), from = at.row - std::min(at.row, beside),
                    until = std::min(rows, at.row + beside + 1);
  const Plot plot = cropped(essentialPlot(results, limit->output, requirement), from, until);
  if (plot.layers.empty()) return {};
  const char* meaning = limit->output == limit->margin ? " (above zero it is met)" : "";
  const std::string label = fmt::format("{}{} from {} s to {} s", plot.name, meaning, numberText(plot.time.front(), 6),
                                        numberText(plot.time.back(), 6));
  constexpr std::size_t drawn = 60;
  const std::string figure = fmt::format("<figure class=\"close\">{}<figcaption>{}</figcaption></figure>",
                                         drawSmall(thinned(plot, drawn), "Plot of " + label), escapeHtml(label));
  return report.detail.plots(limit->output) ? fmt::format("<a href=\"#output-{}\">{}</a>\n", limit->output, figure)
                                            : figure + "\n";
}

std::string answer(const char* title, const std::string& text) {
  return text.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", title, escapeHtml(text));
}

std::string threeAnswers(const RequirementWords& words) {
  return fmt::format(
      "<details><summary>Guaranteed, probable, possible</summary>\n<article class=\"requirement {}\">\n"
      "<p class=\"demand\">{}</p>\n<dl>\n{}{}{}{}</dl>\n</article></details>\n",
      words.word, escapeHtml(words.demand), answer("guaranteed", words.guaranteed), answer("probable", words.probable),
      words.estimated.empty() ? ""
                              : fmt::format("<dt class=\"estimated\">estimated</dt><dd class=\"estimated\">{}</dd>\n",
                                            escapeHtml(words.estimated)),
      answer("possible", words.possible));
}

/// How it stands, in a word or two.
std::string shownState(const RequirementResult& requirement) {
  return requirement.word == Decision::partly     ? "can fail"
         : requirement.word == Decision::violated ? "fails"
         : requirement.word == Decision::met      ? "met"
         : requirement.isViolatedInSimulation     ? "fails in simulation"
                                                  : "not decided";
}

/// A sign and its number, and a number and its unit, on one line.
std::string unbroken(std::string text) {
  for (const auto& [loose, firm] : {std::pair<std::string_view, std::string_view>("± ", "±&nbsp;"), {" %", "&nbsp;%"}})
    for (std::size_t at = 0; (at = text.find(loose, at)) != std::string::npos; at += firm.size())
      text.replace(at, loose.size(), firm);
  return text;
}

/// How likely, how far and when, because of what, and with which tolerances it holds.
std::string factsList(const Results& results, const RequirementResult& requirement, const ViolationFacts& facts,
                      const std::optional<Worst>& at) {
  std::string list;
  const auto add = [&](const char* head, const std::string& text) {
    if (!text.empty()) list += fmt::format("<dt>{}</dt><dd>{}</dd>\n", head, unbroken(escapeHtml(text)));
  };
  const std::vector<Limit> limits = limitsOf(results);
  const auto limit = at ? std::ranges::find(limits, at->margin, &Limit::margin) : limits.end();
  add("How likely", facts.likely);
  add("It misses", facts.missed);
  if (limit != limits.end()) add("Because of", leadingCauses(results, limit->output, results.time[at->row]));
  add("It holds", holdsText(results, requirement));
  return fmt::format("{}.\n<dl class=\"facts\">\n{}</dl>", escapeHtml(facts.what), list);
}

}  // namespace

std::optional<OutputState> stateOfOutput(const Results& results, std::size_t output) {
  std::optional<OutputState> worst;
  if (results.comparison.verdict == Agreement::outside) return worst;  // nothing is known then
  for (const Limit& limit : limitsOf(results)) {
    if (limit.output != output) continue;
    const RequirementResult& requirement = results.requirements[limit.requirement];
    const int severity = severityOf(requirement);
    if (worst && worst->severity <= severity) continue;
    constexpr std::array tones{"violated", "violated", "simulated", "open", "met"};
    worst = {severity, tones[static_cast<std::size_t>(std::clamp(severity, 0, 4))], shownState(requirement)};
  }
  return worst;
}

std::string requirementCards(const Report& report) {
  const Results& results = report.results;
  if (results.requirements.empty()) return {};
  const std::vector<RequirementWords> words = wordsOfRequirements(results);
  const std::vector<std::string> sentences = plainRequirements(results);
  const std::vector<std::optional<ViolationFacts>> facts = violationFacts(results);
  constexpr std::size_t drawn = 24;  // with pictures
  std::size_t shown = 0;
  std::string html = "<ul class=\"requirements\" aria-label=\"Requirements, the worst first\">\n";
  for (const std::size_t r : worstFirst(results)) {
    const RequirementResult& requirement = results.requirements[r];
    if (report.verdict.word == Agreement::outside) {
      html += fmt::format("<li class=\"open\"><b class=\"marked\">contradicted</b> <span>{}</span></li>\n",
                          escapeHtml(words[r].name));
      continue;
    }
    const std::optional<Worst> at = worstOf(results, requirement);
    const std::string said = fmt::format(
        "<b class=\"marked\">{}</b> <span>{}</span> {}\n", shownState(requirement), escapeHtml(words[r].name),
        facts[r] ? factsList(results, requirement, *facts[r], at)
                 : escapeHtml(sentences[r] + shrinkSentence(requirement) + aloneSentence(results, requirement)));
    html += fmt::format("<li class=\"{}\" id=\"requirement-{}\"{}>", words[r].word, r + 1,
                        at && results.horizon > 0
                            ? fmt::format(" data-instant=\"{}\"", numberText(results.time[at->row], 12))
                            : std::string());
    if (!at || ++shown > drawn) {
      html += said;
    } else {
      html += fmt::format("<div class=\"seen\"><div class=\"said\">{}{}</div>{}</div>\n", said,
                          marginBar(results, requirement, *at), closeUp(report, r, *at));
      if (requirement.word != Decision::met) html += whatToDo(results, requirement, at->margin, at->row, shown == 1);
    }
    html += threeAnswers(words[r]) + "</li>\n";
  }
  const std::string more = unshownRequirements(results);
  return html + "</ul>\n" + (more.empty() ? "" : fmt::format("<p class=\"hint\">{}</p>\n", more));
}

}  // namespace gamut
