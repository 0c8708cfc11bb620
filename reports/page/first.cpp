// What a reader sees first: what holds in every case, whether the answers agree, the one plot that matters and whose
// doing its spread is.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "reports/approaches.hpp"
#include "reports/drawing/paper.hpp"
#include "reports/page/glossary.hpp"
#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/plain.hpp"
#include "reports/requirements.hpp"
#include "reports/sections/contribution.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"
#include "studies/results/extremes.hpp"

namespace gamut {
namespace {

struct Foremost {
  std::size_t output = 0;
  std::optional<Limit> limit;
};

/// At how many times nothing finite is known.
std::size_t gapsIn(const Bounds& bounds, std::size_t output) {
  std::size_t gaps = 0;
  for (std::size_t i = 0; i < bounds.lower.times; ++i)
    gaps += std::isfinite(bounds.lower(i, output)) && std::isfinite(bounds.upper(i, output)) ? 0 : 1;
  return gaps;
}

/// The output with the widest bounds in shares of how far it varies, of those that are known at most times; what comes
/// as far throughout the motion, as what is conserved does, only where all do.
std::size_t widestOutput(const Results& results) {
  const Bounds* bounds = bestKnown(results);
  std::size_t widest = 0, fewest = std::numeric_limits<std::size_t>::max();
  double greatest = -1;
  bool isOneThroughout = true;  // of the widest
  for (std::size_t o = 0; bounds != nullptr && o < results.outputs.size(); ++o)
    if (!isMargin(results, o)) fewest = std::min(fewest, gapsIn(*bounds, o));
  for (std::size_t o = 0; bounds != nullptr && o < results.outputs.size(); ++o) {
    double low = INFINITY, high = -INFINITY, width = 0;
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      const double lower = bounds->lower(i, o), upper = bounds->upper(i, o);
      if (!std::isfinite(lower) || !std::isfinite(upper)) continue;
      low = std::min(low, lower);
      high = std::max(high, upper);
      width = std::max(width, upper - lower);
    }
    constexpr double hardly = 0.1;  // of its greatest: what moves by less than that varies little
    const double most = std::max(std::abs(low), std::abs(high)),
                 size = results.time.size() > 1 ? std::max(high - low, hardly * most) : most;
    const double share = size > 0 ? width / size : 0;
    const std::optional<MotionRange> range = bestMotionRange(results, o);
    const bool isThroughout =
        range && whenText(results, range->least) == "throughout" && whenText(results, range->greatest) == "throughout";
    constexpr double telling = 1e-3;  // what varies by less than that leads before nothing
    if (isMargin(results, o) || gapsIn(*bounds, o) > fewest || (isThroughout && !isOneThroughout)) continue;
    const bool displaces = isOneThroughout && !isThroughout && share > telling;
    if (!displaces && share <= greatest) continue;
    greatest = share, widest = o, isOneThroughout = isThroughout || share <= telling;
  }
  return widest;
}

Foremost foremostOf(const Results& results) {
  if (std::optional<Limit> limit = nearestLimit(results)) return {limit->output, limit};
  return {widestOutput(results), {}};
}

// ---- Words ----------------------------------------------------------------------------------------------------------

/// A check of the answers by each other: of the mechanism it says nothing.
std::string verdictCard(const Verdict& verdict) {
  const std::string_view word = wordOf(verdict.word), shown = verdict.gap == Finding::Gap::noAnswers ? "not compared"
                                                              : verdict.word == Agreement::inside ? "self-check passed"
                                                                                                  : word;
  return fmt::format(
      "<section id=\"verdict\" class=\"verdict {}\" aria-label=\"Verdict\">\n<p class=\"sentence\"><b "
      "class=\"word\">{}</b> {}</p>\n"
      "{}</section>\n",
      word, shown, escapeHtml(verdict.sentence), notesList(verdict));
}

/// How near shapes come to each other, when and where.
std::string approachesList(const Results& results) {
  const std::vector<std::string> lines = approachLines(results, approachesOf(results));
  if (lines.empty()) return {};
  std::string list = "<section class=\"ranges\">\n<p>Closest approaches, guaranteed:</p>\n<ul class=\"approaches\">\n";
  for (const std::string& line : lines) list += fmt::format("<li>{}</li>\n", escapeHtml(line));
  return list + "</ul>\n</section>\n";
}

// ---- The plot -------------------------------------------------------------------------------------------------------

/// Numbers of the limits in the plot of an output that are those of one requirement.
std::vector<std::size_t> limitsShown(const Results& results, std::size_t output,
                                     std::optional<std::size_t> requirement) {
  std::vector<std::size_t> numbers;
  std::size_t number = 0;
  for (const Limit& limit : limitsOf(results)) {
    if (limit.output != output) continue;
    if (limit.requirement == requirement) numbers.push_back(number);
    ++number;
  }
  return numbers;
}

/// A layer that the first figure shows, and what its caption says of it.
struct Essential {
  std::string_view layer;
  enum class Of : unsigned char { all, proof, samples, cuts } of;
  std::string_view words = "";
};

constexpr Essential essential[] = {
    {"guaranteed", Essential::Of::proof,
     "grey: the ends between which it lies in every case that the stated tolerances allow"},
    {"tube", Essential::Of::proof, "thin grey: likewise between output times"},
    {"estimated", Essential::Of::all,
     "pink, dashed: behind the end of the proof, where simulated cases lie, which is not proved of all"},
    {"sampled", Essential::Of::samples, "blue, dashed: the least and the greatest of all simulated cases"},
    {"probable", Essential::Of::samples, "blue band: where most of them lie"},
    {"possible", Essential::Of::cuts, "orange: where it can lie, the narrower the more possible"},
    {"median", Essential::Of::all, "blue line: half of the simulated cases lie below"},
    {"limit", Essential::Of::all, "dashed red: the limit"}};

bool has(const Plot& plot, std::string_view layer) {
  return std::ranges::find(plot.layers, layer, &Layer::name) != plot.layers.end();
}

/// Of what is known the best, a middle, and these limits.
Plot essentials(Plot plot, const std::vector<std::size_t>& limits) {
  const bool isProved = has(plot, "guaranteed"), isSampled = has(plot, "sampled");
  std::erase_if(plot.layers, [&](const Layer& layer) {
    const auto* found = std::ranges::find(essential, layer.name, &Essential::layer);
    return found == std::end(essential) || (found->of == Essential::Of::proof && !isProved) ||
           (found->of == Essential::Of::samples && isProved) ||
           (found->of == Essential::Of::cuts && (isProved || isSampled));
  });
  const auto layer = std::ranges::find(plot.layers, "limit", &Layer::name);
  if (layer == plot.layers.end()) return plot;
  const Layer all = *layer;
  layer->bands.clear();
  layer->labels.clear();
  for (const std::size_t i : limits) {
    layer->bands.push_back(all.bands[i]);
    layer->labels.push_back(all.labels[i]);
  }
  return plot;
}

std::string titleOfPlot(const Results& results, const Foremost& foremost) {
  const std::string& name = results.outputs[foremost.output].name;
  if (!foremost.limit) return name;
  const std::string& requirement = results.requirements[foremost.limit->requirement].name;
  return foremost.limit->output == foremost.limit->margin
             ? fmt::format("{}: above zero the requirement \u201c{}\u201d is met", name, requirement)
             : fmt::format("{}, and the limit of \u201c{}\u201d", name, requirement);
}

std::string plotOfForemost(const Results& results, const Foremost& foremost) {
  const auto requirement = foremost.limit ? std::optional(foremost.limit->requirement) : std::nullopt;
  const std::vector<std::size_t> limits = limitsShown(results, foremost.output, requirement);
  const Plot plot = essentialPlot(results, foremost.output, requirement);
  if (plot.layers.empty()) return {};
  const std::string title = titleOfPlot(results, foremost), label = "Plot of " + title;
  if (!plot.isOverTime())
    return fmt::format(
        "<section class=\"foremost\">\n<h3>{}</h3>\n<figure class=\"kept\">{}</figure>\n<p class=\"hint\">{}</p>\n"
        "</section>\n",
        escapeHtml(title), drawBars(plot, label), escapeHtml(essentialsInWords(plot)));
  constexpr std::size_t drawnTimes = 200;
  const bool isSpread = !foremost.limit && plot.isThin();
  Plot shown = thinned(isSpread ? aroundMiddle(plot) : plot, drawnTimes);
  if (isSpread) shown.unit = plot.unit.empty() ? "deviation" : fmt::format("deviation ({})", plot.unit);
  std::string layers;
  for (const Layer& layer : plot.layers) layers += (layers.empty() ? "" : " ") + layer.name;
  const char* view = isSpread ? "spread" : "absolute";
  return fmt::format(
      "<section class=\"output foremost\" data-output=\"{0}\" data-view=\"{1}\" data-layers=\"{2}\" "
      "data-limits=\"{8}\">\n<h3>{3}{4}</h3>\n"
      "<div class=\"live\" role=\"group\" aria-label=\"{5}\"></div>\n<div class=\"static\">\n"
      "<figure data-view=\"{1}\">{6}</figure>\n</div>\n<p class=\"hint\">{7}</p>\n</section>\n",
      foremost.output, view, layers, escapeHtml(title),
      isSpread ? escapeHtml(": spread around " + plot.middleName()) : std::string(),
      escapeHtml("Interactive plot of " + title), drawPlot(shown, label), escapeHtml(essentialsInWords(plot)),
      fmt::join(limits, " "));
}

// ---- Whose doing it is ----------------------------------------------------------------------------------------------

struct LeadingCause {
  std::string name, share;
  double size = 0;
};

/// The greatest first; empty where too little is known.
std::vector<LeadingCause> causesOf(const Results& results, std::size_t output, std::size_t at) {
  const SensitivityResult& s = results.sensitivity;
  const std::size_t quantities = results.uncertain.size();
  std::vector<LeadingCause> causes;
  for (std::size_t q = 0; q < quantities; ++q) {
    const double low = s.total.lower(at, output, q), high = s.total.upper(at, output, q);
    constexpr double tight = 0.02, telling = 0.2;
    LeadingCause cause{results.uncertain[q].name, "", 0.5 * (low + high)};
    const auto percent = [](double x) { return fmt::format("{:.0f}", 100 * std::clamp(x, 0.0, 1.0)); };
    if (high - low <= tight) {
      cause.share = percent(cause.size) + " %";
    } else if (!s.totalSampled.empty() && std::isfinite(s.totalSampled(at, output, q))) {
      cause.size = s.totalSampled(at, output, q);
      cause.share = "about " + percent(cause.size) + " %";
    } else if (high - low <= telling) {
      cause.share = fmt::format("{} to {} %", percent(low), percent(high));
    } else {
      continue;
    }
    causes.push_back(std::move(cause));
  }
  std::ranges::stable_sort(causes, std::greater<>(), &LeadingCause::size);
  return causes;
}

std::string ranking(const Results& results, std::size_t output) {
  const SensitivityResult& s = results.sensitivity;
  if (!s.present || results.uncertain.size() < 2 || s.total.lower.empty()) return {};
  const double instant = instantOf(results, output);
  std::vector<LeadingCause> causes;
  std::size_t at = 0;
  for (std::size_t i = 0; i < s.time.size(); ++i) {  // the nearest at which something is known
    if (!causes.empty() && !(std::abs(s.time[i] - instant) <= std::abs(s.time[at] - instant))) continue;
    if (std::vector<LeadingCause> found = causesOf(results, output, i); !found.empty())
      causes = std::move(found), at = i;
  }
  constexpr std::size_t most = 5;
  constexpr double least = 0.005;
  std::erase_if(causes, [](const LeadingCause& cause) { return cause.size < least; });
  if (causes.empty()) return {};
  if (causes.size() > most) causes.resize(most);
  std::vector<std::string> courses;
  for (const UncertainInfo& quantity : results.uncertain)
    if (variesInTime(quantity)) courses.push_back(escapeHtml(quantity.name));
  std::string html = fmt::format(
      "<section class=\"ranking\">\n<h3>What to measure better first</h3>\n<p class=\"hint\">Share of each quantity in "
      "the "
      "spread of \u201c{}\u201d{}{}.</p>\n<ol>\n",
      escapeHtml(results.outputs[output].name),
      results.horizon > 0 ? fmt::format(" at {} s", numberText(s.time[at], 6)) : "",
      courses.empty()
          ? ""
          : fmt::format(", of those that do not vary in time; {} may matter more", fmt::join(courses, ", ")));
  for (const LeadingCause& cause : causes)
    html += fmt::format("<li><span>{}</span><i style=\"--share:{:.3f}\"></i><b>{}</b></li>\n", escapeHtml(cause.name),
                        std::clamp(cause.size, 0.0, 1.0), cause.share);
  return html + "</ol>\n</section>\n";
}

/// All quantities, where they are few and their shares are not known.
std::string namesUntold(const Results& results) {
  constexpr std::size_t few = 5;
  if (results.uncertain.size() > few) return {};
  std::vector<std::string> names;
  for (const UncertainInfo& quantity : results.uncertain)
    names.push_back(quantity.name + (variesInTime(quantity) ? " (varies in time)" : ""));
  return fmt::format("{}: their shares are not told apart", fmt::join(names, ", "));
}

std::string tone(const Results& results, const Verdict& verdict) {
  if (verdict.word == Agreement::outside || verdict.word == Agreement::unresolved)
    return std::string(wordOf(verdict.word));
  return results.requirements.empty() ? "plain" : std::string(wordOf(wordOfRequirements(results)));
}

}  // namespace

std::string shareOfSpread(const Results& results, std::size_t output, std::size_t quantity, double time) {
  const SensitivityResult& s = results.sensitivity;
  if (!s.present || s.total.lower.empty()) return {};
  std::string share;
  double nearest = INFINITY;
  for (std::size_t i = 0; i < s.time.size(); ++i) {
    if (!(std::abs(s.time[i] - time) < nearest)) continue;
    const std::vector<LeadingCause> causes = causesOf(results, output, i);
    const auto cause = std::ranges::find(causes, results.uncertain[quantity].name, &LeadingCause::name);
    if (cause == causes.end()) continue;
    share = cause->share;
    nearest = std::abs(s.time[i] - time);
  }
  return share;
}

std::string leadingCauses(const Results& results, std::size_t output, double time) {
  if (results.uncertain.size() == 1) return results.uncertain.front().name + ", all that is uncertain";
  const SensitivityResult& s = results.sensitivity;
  if (!s.present || s.total.lower.empty()) return namesUntold(results);
  std::vector<LeadingCause> leading;
  double nearest = INFINITY;
  for (std::size_t i = 0; i < s.time.size(); ++i) {
    if (!(std::abs(s.time[i] - time) < nearest)) continue;
    std::vector<LeadingCause> found = causesOf(results, output, i);
    if (found.empty()) continue;
    leading = std::move(found);
    nearest = std::abs(s.time[i] - time);
  }
  constexpr std::size_t most = 3;
  constexpr double least = 0.05;
  std::erase_if(leading, [](const LeadingCause& cause) { return cause.size < least; });
  leading.resize(std::min(most, leading.size()));
  std::vector<std::string> parts;
  for (const LeadingCause& cause : leading)
    parts.push_back(fmt::format("{} ({}{})", cause.name, cause.share, parts.empty() ? " of the spread" : ""));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string essentialsInWords(const Plot& plot) {
  std::vector<std::string_view> said;
  for (const Essential& one : essential)
    if (!one.words.empty() && has(plot, one.layer)) said.push_back(one.words);
  std::string words = fmt::format("{}", fmt::join(said, "; "));
  if (!words.empty()) words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words + (words.empty() ? "" : ".");
}

Plot essentialPlot(const Results& results, std::size_t output, std::optional<std::size_t> requirement) {
  return essentials(plotOf(results, output), limitsShown(results, output, requirement));
}

std::size_t foremostOutput(const Results& results) { return foremostOf(results).output; }

std::string firstSection(const Report& report) {
  const Results& results = report.results;
  const Foremost foremost = foremostOf(results);
  const bool isThere = foremost.output < results.outputs.size() && !results.time.empty();
  const std::string cards = requirementCards(report);
  return fmt::format(
             "<section id=\"found\" class=\"first {}\" aria-label=\"What was found\">\n<h2 class=\"lead\">{}</h2>\n",
             tone(results, report.verdict), escapeHtml(plainSummary(results, report.verdict, foremost.output))) +
         cards + verdictCard(report.verdict) + termsOf("found", cards) +
         (report.verdict.word == Agreement::outside ? "" : approachesList(results)) +
         (isThere ? plotOfForemost(results, foremost) + ranking(results, foremost.output) : "") + "</section>\n";
}

}  // namespace gamut
