// Of outputs and requirements that both have; what only one has is said.
#include "reports/comparison_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "reports/comparison_lines.hpp"
#include "reports/drawing/paper.hpp"
#include "reports/drawing/style.hpp"
#include "reports/page/page.hpp"
#include "reports/page/parts.hpp"
#include "reports/page/skeleton.hpp"
#include "reports/page/table.hpp"
#include "reports/plain.hpp"
#include "reports/requirements.hpp"
#include "reports/summary.hpp"
#include "reports/words.hpp"
#include "studies/comparing/common_units.hpp"
#include "studies/results/extremes.hpp"
#include "studies/told.hpp"

namespace gamut {
namespace {

constexpr double hardlyOther = 1.01;  // times as wide: what `gamut compare` tolerates too
constexpr std::size_t mostOutputsBeside = 60;

enum class Trend : unsigned char { better, same, worse, unknown };

struct Verdicts {
  Trend trend = Trend::unknown;
  std::string why;  ///< "likelier", "proved now"
};

constexpr const char* wordOfTrend(Trend trend) {
  return trend == Trend::better ? "better" : trend == Trend::worse ? "worse" : trend == Trend::same ? "as it was" : "";
}

// ---- Requirements ---------------------------------------------------------------------------------------------------

bool isBoundedProbability(const RequirementResult& r) { return r.probabilityUpper - r.probabilityLower < 0.5; }

/// Of two that some values violate: by how probable that is, as far as proved bounds tell, else by what part of all
/// tolerances it would bear.
Verdicts trendOfPartly(const RequirementResult& a, const RequirementResult& b) {
  if (isBoundedProbability(a) && isBoundedProbability(b)) {
    if (b.probabilityUpper < a.probabilityLower) return {Trend::worse, "likelier to be violated"};
    if (b.probabilityLower > a.probabilityUpper) return {Trend::better, "less likely to be violated"};
  }
  if (a.factor > 0 && b.factor > hardlyOther * a.factor) return {Trend::better, "holds with wider tolerances"};
  if (b.factor > 0 && a.factor > hardlyOther * b.factor) return {Trend::worse, "holds with narrower tolerances only"};
  return {Trend::same, ""};
}

Verdicts trendOf(const RequirementResult& a, const RequirementResult& b, bool isSameDemand) {
  if (!isSameDemand) return {Trend::unknown, "another demand"};
  const int before = severityOf(a), now = severityOf(b);
  if (now > before) return {Trend::better, ""};
  if (now < before) return {Trend::worse, ""};
  return a.word == Decision::partly ? trendOfPartly(a, b) : Verdicts{Trend::same, ""};
}

// ---- Outputs --------------------------------------------------------------------------------------------------------

/// The widest that 90 % of the samples are at an output time; NaN where nothing is known.
double probableSpread(const Results& results, std::size_t output) {
  const std::vector<double>& probabilities = results.stochastic.probabilities;
  const auto low = std::ranges::find(probabilities, 0.05), high = std::ranges::find(probabilities, 0.95);
  double widest = NAN;
  if (low == probabilities.end() || high == probabilities.end()) return widest;
  const Table &lower = results.stochastic.quantiles[static_cast<std::size_t>(low - probabilities.begin())],
              &upper = results.stochastic.quantiles[static_cast<std::size_t>(high - probabilities.begin())];
  for (std::size_t i = 0; i < std::min(lower.times, upper.times); ++i)
    widest = std::fmax(widest, upper(i, output) - lower(i, output));
  return widest;
}

std::string numberOrDash(double x) { return std::isfinite(x) ? numberText(x, 4) : "-"; }

/// Of what is as good as nothing no ratio is told.
double ratioOf(double a, double b, double size) {
  constexpr double negligibleShare = 1e-9;
  return a > negligibleShare * size && b > negligibleShare * size ? b / a : NAN;
}

std::string peakText(const std::string& value, const std::string& when) {
  return when.empty() ? value : fmt::format("{} {}", value, when);
}

/// What both know of one output, in numbers.
struct OutputBeside {
  std::string name, unit;
  Both<std::optional<MotionRange>> range;
  Both<double> spread{NAN, NAN};
  double wider = NAN, likelier = NAN;  ///< times as wide: what is guaranteed, what is probable
};

// ---- The page -------------------------------------------------------------------------------------------------------

class ComparisonPage {
 public:
  ComparisonPage(const Difference& difference, const Results& first, const Results& second,
                 const Both<std::string>& files)
      : difference_(difference),
        converted_(inUnitsOf(first, second)),
        a_(first),
        b_(converted_ ? *converted_ : second),
        files_(files) {
    for (const Match& match : difference.shared.outputs)
      if (!isMargin(a_, match.first) && !isMargin(b_, match.second)) outputs_.push_back(beside(match));
  }

  std::string html() const {
    const std::string figures = figuresHtml();
    const std::string title = titleOf(a_) == titleOf(b_) ? titleOf(a_) : titleOf(a_) + " / " + titleOf(b_);
    return filledPage(
        {{"run", a_.stopped.empty() && b_.stopped.empty() ? "whole" : "partial"},
         {"title", escapeHtml(title)},
         {"summary", fmt::format("A: {} ({})<br>B: {} ({})", escapeHtml(files_.first), escapeHtml(summaryLine(a_)),
                                 escapeHtml(files_.second), escapeHtml(summaryLine(b_)))},
         {"style", std::string(page::style)},
         {"layers", styleOf()},
         {"plottingStyle", ""},
         {"first", firstHtml()},
         {"chips", ""},
         {"links", links()},
         {"clock", ""},
         {"sections", section("requirements-beside", "Requirements", requirementsHtml()) +
                          section("outputs-beside", "Outputs", outputsHtml()) +
                          section("figures-beside", "Motions", figures) +
                          section("asked-beside", "What was asked otherwise", askedHtml())},
         {"scripts", ""}});
  }

 private:
  static std::string section(const char* id, const char* title, const std::string& html) {
    return html.empty() ? "" : fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, title, html);
  }
  std::string links() const {
    std::string html = "<a href=\"#found\">Summary</a>";
    const auto add = [&](const char* id, const char* title, bool isThere) {
      if (isThere) html += fmt::format("<a href=\"#{}\">{}</a>", id, title);
    };
    add("requirements-beside", "Requirements", !difference_.changes.requirements.empty());
    add("outputs-beside", "Outputs", !outputs_.empty());
    add("figures-beside", "Motions", !outputs_.empty());
    add("asked-beside", "What was asked otherwise", !askedHtml().empty());
    return html;
  }

  /// Widths of motions that are known for other spans are no match. What only one of them has is not compared.
  bool isOfOneSpan() const {
    const auto areOne = [](const Answer& a, const Answer& b) {
      return !a.present || !b.present || a.reached == b.reached;
    };
    return a_.horizon == b_.horizon && areOne(a_.interval, b_.interval) && areOne(a_.stochastic, b_.stochastic);
  }
  static std::string spanOf(const Results& results) {
    if (!results.interval.present) return fmt::format("samples until {}", timeText(results.stochastic.reached));
    return fmt::format("guaranteed until {}", timeText(results.interval.reached));
  }

  OutputBeside beside(const Match& match) const {
    OutputBeside output{a_.outputs[match.first].name,
                        a_.outputs[match.first].unit,
                        {bestMotionRange(a_, match.first), bestMotionRange(b_, match.second)},
                        {probableSpread(a_, match.first), probableSpread(b_, match.second)}};
    if (!isOfOneSpan()) return output;
    const double size = std::fmax(motionSize(a_, match.first), motionSize(b_, match.second));
    if (output.range.first && output.range.second && output.range.first->source == output.range.second->source)
      output.wider = ratioOf(output.range.first->width, output.range.second->width, size);
    output.likelier = ratioOf(output.spread.first, output.spread.second, size);
    return output;
  }

  // ---- What leads

  Verdicts trendOfRequirement(std::size_t k) const {
    const Match& match = difference_.shared.requirements[k];
    return trendOf(a_.requirements[match.first], b_.requirements[match.second],
                   difference_.changes.requirements[k].isSameDemand);
  }

  std::vector<std::string> requirementsOf(Trend trend) const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < difference_.shared.requirements.size(); ++k)
      if (trendOfRequirement(k).trend == trend)
        names.push_back(a_.requirements[difference_.shared.requirements[k].first].name);
    return names;
  }

  /// "angle (1.3 times), tip (2 times)": whose width changed like that, the most first.
  template <class Ratio>
  std::string changed(const Ratio& ratio, bool isUp) const {
    std::vector<std::pair<double, std::string>> found;
    for (const OutputBeside& output : outputs_)
      if (const double times = isUp ? ratio(output) : 1 / ratio(output); times > hardlyOther)
        found.emplace_back(times, output.name);
    std::ranges::stable_sort(found, std::greater<>(), &std::pair<double, std::string>::first);
    constexpr std::size_t most = 6;
    std::vector<std::string> words;
    for (const auto& [times, name] : found)
      if (words.size() < most)
        words.push_back(fmt::format("{} ({} times)", name, numberText(isUp ? times : 1 / times, 3)));
    if (found.size() > most) words.push_back(fmt::format("{} more", found.size() - most));
    return fmt::format("{}", fmt::join(words, ", "));
  }

  std::string leadText() const {
    const auto other = requirementsOf(Trend::unknown).size(), all = difference_.shared.requirements.size() - other;
    if (difference_.word == Difference::Word::error) return comparisonSentence(difference_);
    if (all == 0 && other == 0) return "Neither has requirements in common with the other; their outputs are compared.";
    if (other == 0) return leadOf(all);
    const std::string names = other == 1 ? "One requirement asks" : fmt::format("{} requirements ask", other);
    return (all == 0 ? "" : leadOf(all) + " ") + names + " something else in B, which is not compared.";
  }

  /// Of so many requirements that ask the same.
  std::string leadOf(std::size_t all) const {
    const auto better = requirementsOf(Trend::better).size(), worse = requirementsOf(Trend::worse).size();
    const bool isAnyBetter = better > 0, isAnyWorse = worse > 0;
    const char* how = isAnyBetter ? "better" : isAnyWorse ? "worse" : "neither better nor worse";
    if (all == 1) return fmt::format("The requirement that both have is {} in B.", how);
    const auto are = [](std::size_t count) { return fmt::format("{} {}", count, count == 1 ? "is" : "are"); };
    const std::string both = fmt::format("Of {} requirements in common", all);
    if (!isAnyBetter && !isAnyWorse) return both + " none is better or worse in B.";
    if (isAnyBetter && isAnyWorse) return fmt::format("{} {} better and {} worse in B.", both, are(better), are(worse));
    return fmt::format("{} {} {} in B.", both, are(better + worse), how);
  }

  std::string changesList() const {
    std::string html;
    const auto add = [&](const char* tone, const std::string& what, const std::string& who) {
      if (!who.empty()) html += fmt::format("<li class=\"{}\"><b>{}</b> {}</li>\n", tone, what, escapeHtml(who));
    };
    const auto wider = [](const OutputBeside& output) { return output.wider; };
    const auto likelier = [](const OutputBeside& output) { return output.likelier; };
    add("violated", "requirements, worse:", fmt::format("{}", fmt::join(requirementsOf(Trend::worse), ", ")));
    add("met", "requirements, better:", fmt::format("{}", fmt::join(requirementsOf(Trend::better), ", ")));
    add("violated", "guaranteed, wider:", changed(wider, true));
    add("met", "guaranteed, narrower:", changed(wider, false));
    add("violated", "probable (5 to 95 %), wider:", changed(likelier, true));
    add("met", "probable (5 to 95 %), narrower:", changed(likelier, false));
    if (!isOfOneSpan()) {
      add("open", "known for other spans:",
          fmt::format("{} in A, {} in B; neither widths nor costs are compared", spanOf(a_), spanOf(b_)));
      return changesHtml(html);
    }
    const double cpu = difference_.changes.cpu.second / difference_.changes.cpu.first;
    constexpr double telling = 1.2;
    if (cpu > telling || cpu < 1 / telling)
      add("open", cpu > 1 ? "slower to compute:" : "faster to compute:",
          fmt::format("{} instead of {}", cpuText(difference_.changes.cpu.second),
                      cpuText(difference_.changes.cpu.first)));
    return changesHtml(html);
  }
  static std::string changesHtml(const std::string& items) {
    constexpr const char* widths =
        "<p class=\"hint\">Times here: the widest that B is, by the widest that A is, whenever that is. What "
        "is called worse below compares both at one time.</p>\n";
    if (items.empty()) return {};
    return "<ul class=\"changes\" aria-label=\"What changed from A to B\">\n" + items + "</ul>\n" +
           (items.find(" times)") == std::string::npos ? "" : widths);
  }

  std::string firstHtml() const {
    std::string notes;
    const std::string lines = comparisonNotes(difference_, a_, b_);
    for (std::size_t begin = 0; begin < lines.size();) {
      const std::size_t end = std::min(lines.find('\n', begin), lines.size());
      notes += fmt::format("<li>{}</li>\n", escapeHtml(lines.substr(begin + 2, end - begin - 2)));
      begin = end + 1;
    }
    return fmt::format(
        "<section id=\"found\" class=\"first\" aria-label=\"What changed\">\n<h2 class=\"lead\">{}</h2>\n{}"
        "<p>{}</p>\n<p>{}</p>\n{}</section>\n",
        escapeHtml(leadText()), changesList(), escapeHtml(comparisonQuestion(difference_)),
        escapeHtml(comparisonSentence(difference_)), notes.empty() ? "" : "<ul class=\"notes\">\n" + notes + "</ul>\n");
  }

  // ---- Tables

  static std::string answerOf(const RequirementResult& requirement, const std::string& sentence) {
    return fmt::format("{}. {}{}", stateOf(requirement), sentence, shrinkSentence(requirement));
  }

  std::string requirementsHtml() const {
    if (difference_.shared.requirements.empty()) return {};
    const Both<std::vector<std::string>> sentences{plainRequirements(a_), plainRequirements(b_)};
    TableText table("", {"requirement", "B is", "A", "B"});
    for (const Trend trend : {Trend::worse, Trend::better, Trend::unknown, Trend::same})
      for (std::size_t k = 0; k < difference_.shared.requirements.size(); ++k) {
        const Verdicts found = trendOfRequirement(k);
        if (found.trend != trend) continue;
        const auto& [a, b] = difference_.shared.requirements[k];
        const std::string word = wordOfTrend(trend);
        table.row(a_.requirements[a].name, {word + (word.empty() || found.why.empty() ? "" : ": ") + found.why,
                                            answerOf(a_.requirements[a], sentences.first[a]),
                                            answerOf(b_.requirements[b], sentences.second[b])});
      }
    return table.html();
  }

  static Both<std::string> peaksOf(const Results& results, const std::optional<MotionRange>& range) {
    if (!range) return {"-", "-"};
    const auto [least, greatest] = peaksText(range->least.value, range->greatest.value);
    return {peakText(least, whenLeast(results, *range)), peakText(greatest, whenGreatest(results, *range))};
  }

  std::string outputsHtml() const {
    if (outputs_.empty()) return {};
    const bool moves = a_.horizon > 0 || b_.horizon > 0;
    TableText table("", {"output", moves ? "widest in A" : "width in A", "in B", "B / A", "5 to 95 % in A", "in B",
                         "B / A", "least in A", "in B", "greatest in A", "in B"});
    for (std::size_t k = 0; k < std::min(outputs_.size(), mostOutputsBeside); ++k) {
      const OutputBeside& o = outputs_[k];
      const Both<std::string> a = peaksOf(a_, o.range.first), b = peaksOf(b_, o.range.second);
      const auto widthOf = [](const std::optional<MotionRange>& range) {
        return range ? atMostText(range->width, 4) : "-";
      };
      table.row(headingOf(o.name, o.unit),
                {widthOf(o.range.first), widthOf(o.range.second), numberOrDash(o.wider), numberOrDash(o.spread.first),
                 numberOrDash(o.spread.second), numberOrDash(o.likelier), a.first, b.first, a.second, b.second});
    }
    return fmt::format("<p class=\"hint\">Widths, least and greatest: {} in A, {} in B.{}</p>\n",
                       escapeHtml(rangesCaption(a_)), escapeHtml(rangesCaption(b_)),
                       moves ? " Widths are the widest at one time." : "") +
           table.html() + hintOfRows(outputs_.size(), std::min(outputs_.size(), mostOutputsBeside));
  }

  /// The quantities and settings in which both differ.
  std::string askedHtml() const {
    TableText table("", {"what", "A", "B"});
    bool isAny = false;
    const auto add = [&](const std::string& what, const std::string& a, const std::string& b) {
      if (a == b) return;
      table.row(what, {a.empty() ? "-" : a, b.empty() ? "-" : b});
      isAny = true;
    };
    for (const UncertainInfo& u : a_.uncertain)
      add("uncertain: " + u.name, quantityText(a_, u.name), quantityText(b_, u.name));
    for (const UncertainInfo& u : b_.uncertain)
      if (quantityText(a_, u.name).empty()) add("uncertain: " + u.name, "", quantityText(b_, u.name));
    for (const Match& match : difference_.shared.outputs)
      if (!isMargin(a_, match.first) && !isMargin(b_, match.second))
        add("output: " + a_.outputs[match.first].name, a_.outputs[match.first].quantity,
            b_.outputs[match.second].quantity);
    for (const Match& match : difference_.shared.requirements)
      add("requirement: " + a_.requirements[match.first].name, demandOf(a_, match.first), demandOf(b_, match.second));
    add("dependence", a_.dependence, b_.dependence);
    add("analysis", a_.analysis, b_.analysis);
    add("horizon", timeText(a_.horizon), timeText(b_.horizon));
    add("output times", fmt::format("{}", a_.time.size()), fmt::format("{}", b_.time.size()));
    const auto answersOf = [](const Results& results) {
      std::vector<std::string_view> names;
      for (const Answer* answer : results.answers())
        if (answer->present)
          names.push_back(answer == &results.stochastic ? "samples"
                          : answer == &results.interval ? "enclosure"
                                                        : "alpha-cuts");
      return fmt::format("{}", fmt::join(names, ", "));
    };
    add("answers", answersOf(a_), answersOf(b_));
    add("samples", fmt::format("{}, plan {}, seed {}", a_.stochastic.samples, wordOf(a_.stochastic.plan), a_.seed),
        fmt::format("{}, plan {}, seed {}", b_.stochastic.samples, wordOf(b_.stochastic.plan), b_.seed));
    add("tightness asked for", numberText(a_.interval.tightness, 4), numberText(b_.interval.tightness, 4));
    add("alpha-cuts", fmt::format("{}", a_.fuzzy.alpha.size()), fmt::format("{}", b_.fuzzy.alpha.size()));
    add("time limit", timeText(a_.limits.time), timeText(b_.limits.time));
    add("Gamut", a_.version, b_.version);
    add("computer", a_.host, b_.host);
    add("study file", a_.studyFile, b_.studyFile);
    std::string html;
    for (const std::string& difference : difference_.relation.differences)
      html += fmt::format("<li>{}</li>\n", escapeHtml(difference));
    if (!html.empty()) html = "<p>Numbers of the mechanism:</p>\n<ul>\n" + html + "</ul>\n";
    return html + (isAny ? table.html() : "");
  }

  /// "always angle < 3.6 rad, 0 to 2 s".
  static std::string demandOf(const Results& results, std::size_t number) {
    const RequirementResult& r = results.requirements[number];
    return fmt::format("{}, {} to {}", r.statement, numberText(r.from, 8), timeText(r.until));
  }

  /// "19.6 to 20.4 kN/m, nominal 20; normal (mean 20); triangular"; empty where it is not uncertain.
  static std::string quantityText(const Results& results, const std::string& name) {
    const auto found = std::ranges::find(results.uncertain, name, &UncertainInfo::name);
    if (found == results.uncertain.end()) return {};
    const Told told(*found);
    const auto [lower, upper] = told.of(found->lower, found->upper);
    return fmt::format("{}, nominal {}; {}; {}", inUnit(rangeText(lower, upper, 8), told.unit()),
                       numberText(told.of(found->nominal), 8), shapeText(results, *found, ShapeKind::distribution),
                       shapeText(results, *found, ShapeKind::membership));
  }

  // ---- Figures

  struct Outline {
    const Bounds* bounds = nullptr;
    const char* what = "nothing is known";
  };
  static Outline outlineOf(const Results& results) {
    if (!results.interval.at.empty()) return {&results.interval.at, "guaranteed"};
    if (!results.stochastic.envelope.empty())
      return {&results.stochastic.envelope, "least and greatest of the samples"};
    if (!results.fuzzy.outer.empty()) return {&results.fuzzy.outer.front(), "possible"};
    return {};
  }

  /// At these times, along the straight lines between its own.
  static Line resampled(const Results& results, const Line& line, const std::vector<double>& times) {
    Line found(times.size(), NAN);
    for (std::size_t i = 0, k = 0; i < times.size(); ++i) {
      while (k < results.time.size() && results.time[k] < times[i]) ++k;
      if (k == results.time.size() || k >= line.size()) break;
      if (results.time[k] == times[i])
        found[i] = line[k];
      else if (k > 0)
        found[i] = line[k - 1] +
                   (line[k] - line[k - 1]) * (times[i] - results.time[k - 1]) / (results.time[k] - results.time[k - 1]);
    }
    return found;
  }

  std::vector<double> allTimes() const {
    std::vector<double> times;
    std::ranges::set_union(a_.time, b_.time, std::back_inserter(times));
    return times;
  }

  static Layer layerOf(const char* name, const char* letter, const Results& results, std::size_t output,
                       const std::vector<double>& times, const Style& style) {
    const auto [bounds, what] = outlineOf(results);
    Layer layer;
    layer.name = name;
    layer.words = fmt::format("{}: {}", letter, what);
    layer.style = style;
    layer.isProved = results.interval.present;
    if (bounds == nullptr) return layer;
    const Band band = bandOf(*bounds, output);
    layer.bands = {{resampled(results, band.lower, times), resampled(results, band.upper, times)}};
    return layer;
  }

  Plot plotBeside(const Match& match) const {
    const std::vector<double> times = allTimes();
    Plot plot{a_.outputs[match.first].name, a_.outputs[match.first].unit, times, {}, {}};
    plot.layers.push_back(layerOf("of-a", "A", a_, match.first, times, {colour::blue, 0, 1.6, false}));
    plot.layers.push_back(layerOf("of-b", "B", b_, match.second, times, {colour::orange, 0, 1.6, true}));
    std::erase_if(plot.layers, [](const Layer& layer) { return layer.bands.empty(); });
    return plot;
  }

  std::string styleOf() const {
    StyleSheet sheet;
    for (const Match& match : difference_.shared.outputs) sheet.add(plotBeside(match));
    return sheet.css();
  }

  std::string figuresHtml() const {
    constexpr std::size_t drawnTimes = 300;
    std::string html;
    std::size_t shown = 0;
    for (const Match& match : difference_.shared.outputs) {
      const Plot plot = plotBeside(match);
      if (isMargin(a_, match.first) || isMargin(b_, match.second) || plot.layers.empty() || ++shown > mostOutputsBeside)
        continue;
      if (html.empty()) html = drawKey(plot.layers, "What is drawn");
      const std::string label = fmt::format("{} of A and of B", plot.name);
      html += fmt::format("<section class=\"output\">\n<h3>{}</h3>\n<figure class=\"kept\">{}</figure>\n</section>\n",
                          escapeHtml(headingOf(plot.name, plot.unit)),
                          plot.isOverTime() ? drawPlot(thinned(plot, drawnTimes), label) : drawBars(plot, label));
    }
    return html;
  }

  const Difference& difference_;
  const std::optional<Results> converted_;  // the second, in units of the first
  const Results &a_, &b_;
  const Both<std::string>& files_;
  std::vector<OutputBeside> outputs_;
};

}  // namespace

std::string renderComparison(const Difference& difference, const Results& first, const Results& second,
                             const Both<std::string>& files) {
  return ComparisonPage(difference, first, second, files).html();
}

}  // namespace gamut
