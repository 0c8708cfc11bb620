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
std::vector<Mark> marksOf(const Results& results, std::size_t row, std::size_t output) {
  std::vector<Mark> marks;
  const auto add = [&](const char* name, const char* words, const auto& lower, const auto& upper) {
    if (row >= results.time.size() || lower.empty()) return;
    const double low = lower(row, output), high = upper(row, output);
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
    add("mark-core", "most possible (orange)", results.fuzzy.outer.back().lower, results.fuzzy.outer.back().upper);
  return marks;
}

/// What a bar is of: the output that a requirement sets a limit to, or, where no output is that, the margin, of which
/// the limit is zero.
struct Measured {
  struct Side {
    double limit = 0;
    bool isAbove = true;  ///< the limit is a lower one
    std::string text;
  };
  std::size_t output = 0;
  std::string_view unit;
  std::vector<Side> sides;  ///< that of the margin first

  Measured(const Results& results, std::size_t margin) : output(margin) {
    const std::vector<Limit> limits = limitsOf(results);
    const auto found = std::ranges::find(limits, margin, &Limit::margin);
    const auto infoOf = [&](std::size_t number) {
      return std::ranges::find(results.margins, number, &MarginInfo::output);
    };
    const auto info = infoOf(margin);
    if (info != results.margins.end()) unit = info->unit;
    if (found == limits.end() || found->output == margin || !isDrawn(found->value)) {
      sides.push_back({0, true, info == results.margins.end() ? "" : info->limitText});
      return;
    }
    output = found->output;
    const auto add = [&](const Limit& limit) {
      sides.push_back({limit.value, infoOf(limit.margin)->isAbove, infoOf(limit.margin)->limitText});
    };
    add(*found);
    for (const Limit& limit : limits)
      if (limit.requirement == found->requirement && limit.output == output && limit.margin != margin &&
          isDrawn(limit.value))
        add(limit);
  }
  bool isMargin(std::size_t margin) const { return output == margin; }
};

/// From left to right, with a ground where the limit is missed.
class MarginBar {
 public:
  MarginBar(const Measured& of, const std::vector<Mark>& marks) : marks_(marks) {
    Range range;
    range.hold(of.sides.front().limit);
    for (const Mark& mark : marks) {
      range.hold(mark.lower);
      range.hold(mark.upper);
    }
    const Range around = range.padded(1);
    for (const Measured::Side& side : of.sides) {
      if (side.limit < around.low || side.limit > around.high) continue;
      range.hold(side.limit);
      sides_.push_back(side);
    }
    range_ = range.padded(0.06);
  }

  /// `ends`: what stands below those of the widest.
  std::string svg(const std::string& label, const std::pair<std::string, std::string>& ends) const {
    std::string svg =
        fmt::format("<svg class=\"drawing margin\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", width,
                    height, escapeHtml(label));
    for (const Measured::Side& side : sides_) {
      const double limit = across(side.limit);
      svg += fmt::format("<rect class=\"missed\" x=\"{:.1f}\" y=\"4\" width=\"{:.1f}\" height=\"{}\"/>\n",
                         side.isAbove ? 0.0 : limit, side.isAbove ? limit : width - limit, 2 * (middle - 4));
    }
    double half = 10;
    for (const Mark& mark : marks_) {
      const double wide = std::max(across(mark.upper) - across(mark.lower), least);
      svg +=
          fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"1.5\"/>\n",
                      mark.name, across(mark.lower), middle - half, wide, 2 * half);
      half -= 3.5;
    }
    std::vector<double> taken;
    const auto write = [&](const std::string& text, double at, const char* kind) {
      if (text.empty()) return;
      constexpr double letter = 6.5, gap = 6;
      const double wide = 0.5 * letter * static_cast<double>(text.size()), place = std::clamp(at, wide, width - wide);
      if (std::ranges::any_of(taken, [&](double other) { return std::abs(place - other) < wide + word + gap; })) return;
      drawText(kind, place, height - 1, text, svg);
      taken.push_back(place);
    };
    for (const Measured::Side& side : sides_) {
      svg += fmt::format("<path class=\"zero\" d=\"M{0:.1f} 2V34\"/>\n", across(side.limit));
      write("limit", across(side.limit), "middle");
    }
    write(ends.first, across(marks_.front().lower), "tick middle");
    write(ends.second, across(marks_.front().upper), "tick middle");
    return svg + "</svg>";
  }

 private:
  static constexpr double width = 320, height = 44, middle = 18, least = 2, word = 20;

  double across(double value) const { return width * (value - range_.low) / (range_.high - range_.low); }

  const std::vector<Mark>& marks_;
  std::vector<Measured::Side> sides_;  ///< without those that are so far off that nothing else would be seen
  Range range_;
};

/// The views nested about one line, and red ones at the limits, beyond which the requirement is violated.
std::string marginBar(const Results& results, const RequirementResult& requirement, const Worst& at) {
  const Measured of(results, at.margin);
  const std::vector<Mark> marks = marksOf(results, at.row, of.output);
  if (marks.empty()) return {};
  const Mark& widest = marks.front();
  std::vector<std::string> words;
  std::pair<std::string, std::string> ends;
  const Told told(results.outputs[of.output].unit, std::string(of.unit));
  for (const Mark& mark : marks) {
    const auto [low, high] = told.of(mark.lower, mark.upper);
    const auto [lower, upper] = boundsText(low, high, 0, 3, told.of(widest.upper - widest.lower));
    words.push_back(fmt::format("{} {}", mark.words,
                                inUnit(lower == upper ? lower : fmt::format("{} to {}", lower, upper), told.unit())));
    if (&mark == &widest && lower != upper) ends = {lower, upper};
  }
  const std::string when =
      results.horizon > 0 ? fmt::format(" at {} s", numberText(results.time[at.row], 6)) : std::string();
  if (requirement.isViolatedBetween) words.emplace_back("the violation lies between output times");
  std::string head = results.outputs[of.output].name;
  std::vector<std::string> limits;
  std::vector<Measured::Side> sides = of.sides;
  std::ranges::sort(sides, {}, &Measured::Side::limit);
  for (const Measured::Side& side : sides)
    if (!side.text.empty()) limits.push_back(side.text);
  const std::string limit = fmt::format("{}", fmt::join(limits, " and "));
  if (of.isMargin(at.margin))
    head = "Margin" + (limit.empty() ? "" : " to the limit of " + limit);
  else if (!limit.empty())
    words.push_back((limits.size() > 1 ? "limits " : "limit ") + limit);
  const std::string label = fmt::format("Bar of {}{}: {}", requirement.name, when, fmt::join(words, "; "));
  return fmt::format("<figure class=\"margin\">{}\n<figcaption>{}</figcaption></figure>\n",
                     MarginBar(of, marks).svg(label, ends),
                     escapeHtml(fmt::format("{}{}: {}", head, when, fmt::join(words, "; "))));
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

/// Without limits that are so far off that nothing else would be seen, but for the nearest.
Plot withNearLimits(Plot plot) {
  const auto limits = std::ranges::find(plot.layers, "limit", &Layer::name);
  if (limits == plot.layers.end()) return plot;
  Range range;
  for (const Layer& layer : plot.layers)
    if (&layer != &*limits)
      for (const Band& band : layer.bands) range.hold(band);
  std::vector<double> away;
  for (const Band& band : limits->bands) {
    Range of;
    of.hold(band);
    away.push_back(std::max({of.low - range.high, range.low - of.high, 0.0}));
  }
  const double nearest = away.empty() ? 0 : std::ranges::min(away), most = std::max(nearest, range.high - range.low);
  for (std::size_t i = away.size(); i-- > 0;) {
    if (away[i] <= most) continue;
    limits->bands.erase(limits->bands.begin() + static_cast<std::ptrdiff_t>(i));
    if (i < limits->labels.size()) limits->labels.erase(limits->labels.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return plot;
}

/// The motion about that instant, with the limits: a sixteenth of the time to either side, or six output times. What is
/// drawn how is said at the first.
std::string closeUp(const Report& report, std::size_t requirement, const Worst& at, bool isFirst) {
  const Results& results = report.results;
  const std::size_t rows = results.time.size();
  if (results.horizon == 0 || rows < 3) return {};
  const std::vector<Limit> limits = limitsOf(results);
  const auto limit = std::ranges::find(limits, at.margin, &Limit::margin);
  if (limit == limits.end()) return {};
  const std::size_t beside = std::max<std::size_t>(6, rows / 16), from = at.row - std::min(at.row, beside),
                    until = std::min(rows, at.row + beside + 1);
  const Plot plot = withNearLimits(cropped(essentialPlot(results, limit->output, requirement), from, until));
  if (plot.layers.empty()) return {};
  const char* meaning = limit->output == limit->margin ? " (above zero it is met)" : "";
  const std::string label = fmt::format("{}{} from {} s to {} s", plot.name, meaning, numberText(plot.time.front(), 6),
                                        numberText(plot.time.back(), 6));
  constexpr std::size_t drawn = 60;
  const std::string figure = fmt::format("<figure class=\"close\">{}<figcaption>{}{}</figcaption></figure>",
                                         drawSmall(thinned(plot, drawn), "Plot of " + label), escapeHtml(label),
                                         isFirst ? ". " + escapeHtml(essentialsInWords(plot)) : "");
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
                          marginBar(results, requirement, *at), closeUp(report, r, *at, shown == 1));
      if (requirement.word != Decision::met) html += whatToDo(results, requirement, at->margin, at->row, shown == 1);
    }
    html += threeAnswers(words[r]) + "</li>\n";
  }
  const std::string more = unshownRequirements(results);
  return html + "</ul>\n" + (more.empty() ? "" : fmt::format("<p class=\"hint\">{}</p>\n", more));
}

}  // namespace gamut
