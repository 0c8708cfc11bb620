// Lines and tables.
#include "reports/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "reports/approaches.hpp"
#include "reports/plain.hpp"
#include "reports/requirements.hpp"
#include "reports/text_table.hpp"
#include "scalars/interval.hpp"
#include "studies/results/extremes.hpp"
#include "studies/results/instants.hpp"
#include "studies/results/verdict.hpp"
#include "studies/told.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// How far off the samples' statistics are, the worst of all outputs at all times.
std::string statisticsText(const Results& results) {
  const StochasticResult& s = results.stochastic;
  std::vector<std::string> parts;
  double worst = 0;
  for (std::size_t i = 0; i < std::min(s.meanError.data.size(), s.deviation.data.size()); ++i)
    if (s.deviation.data[i] > 0) worst = std::fmax(worst, s.meanError.data[i] / s.deviation.data[i]);
  if (worst > 0) parts.push_back(fmt::format("means are known to {} standard deviations (95 %)", numberText(worst, 2)));
  if (s.covered > 0)
    parts.push_back(fmt::format("{} % of all motions lie in the envelope of each output at each time (95 %)",
                                outwardText(100 * s.covered, 100 * s.covered, 4).first));
  if (s.failures > 0)
    parts.push_back(fmt::format("{} did not arrive", countText(static_cast<long long>(s.failures), "sample")));
  return parts.empty() ? "" : fmt::format("  samples: {}\n", fmt::join(parts, "; "));
}

/// The method, and the greatest gap of all outputs at all levels.
std::string transformationText(const Results& results) {
  const TransformationResult& t = results.fuzzy.transformation;
  if (!t.present) return {};
  std::size_t worst = t.gap.data.size();
  for (std::size_t i = 0; i < t.gap.data.size(); ++i)
    if (!std::isnan(t.gap.data[i]) && (worst == t.gap.data.size() || t.gap.data[i] > t.gap.data[worst])) worst = i;
  std::string text = fmt::format(
      "  alpha-cuts: samples by the {} transformation method{}", t.method,
      results.stochastic.alphaPoints > 0 ? ", " + countText(results.stochastic.alphaPoints, "point") + " inside" : "");
  if (worst == t.gap.data.size()) return text + "\n";
  const std::size_t outputs = results.outputs.size();
  if (isLittle(t.gap.data[worst], 1)) return text + "; they reach the ends of every proved cut\n";
  const std::string when =
      results.horizon > 0 ? fmt::format(", at {}", timeText(t.gapTime.data[worst])) : std::string();
  return text + fmt::format("; they leave {} % of the widest proved cut at most ({}, membership {}{})\n",
                            atMostText(100 * t.gap.data[worst], 2), results.outputs[worst % outputs].name,
                            numberText(results.fuzzy.alpha[worst / outputs], 3), when);
}

/// "[1.2345, 1.3456]", bounds rounded outward, with the digits that they justify.
std::string shortBounds(const Results& results, const Bounds& bounds, std::size_t time, std::size_t output) {
  if (bounds.empty()) return "-";
  const double lower = bounds.lower(time, output), upper = bounds.upper(time, output);
  if (!(lower <= upper)) return "-";
  const auto [below, above] = boundsText(lower, upper, motionSize(results, output));
  return fmt::format("[{}, {}]", below, above);
}

/// Every output's least and greatest over the whole motion, and when; empty where no time passes.
std::string rangesText(const Results& results) {
  if (results.horizon == 0) return {};
  std::vector<std::vector<std::string>> rows{{rangesCaption(results), "least", "", "greatest", ""}};
  for (std::size_t j = 0; j < results.outputs.size(); ++j) {
    const std::optional<MotionRange> range = bestMotionRange(results, j);
    if (isMargin(results, j) || !range) continue;
    const auto [least, greatest] = peaksText(range->least.value, range->greatest.value);
    rows.push_back({headingOf(results.outputs[j].name, results.outputs[j].unit), least, whenLeast(results, *range),
                    greatest, whenGreatest(results, *range)});
  }
  return rows.size() > 1 ? textTable(rows) : "";
}

/// What is proved: the enclosure, or, in a study without, the alpha-cut that holds all others.
const Bounds& provedBounds(const Results& results) {
  return results.interval.at.empty() && !results.fuzzy.outer.empty() ? results.fuzzy.outer.front()
                                                                     : results.interval.at;
}

/// The last row in which some output is enclosed and sampled, or, if there is none, one of the two.
std::size_t lastRow(const Results& results) {
  const Bounds& proved = provedBounds(results);
  const Bounds& sampled = results.stochastic.envelope;
  const auto isThere = [&](const Bounds& bounds, std::size_t i) {
    for (std::size_t j = 0; j < results.outputs.size(); ++j)
      if (!std::isnan(bounds.lower(i, j))) return true;
    return false;
  };
  const auto lastOf = [&](const auto& holds) {
    std::size_t i = results.time.size();
    while (i > 0 && !holds(i - 1)) --i;
    return i;
  };
  const std::size_t both = lastOf(
      [&](std::size_t i) { return !proved.empty() && !sampled.empty() && isThere(proved, i) && isThere(sampled, i); });
  const Bounds& either = proved.empty() ? sampled : proved;
  const std::size_t row =
      both > 0 ? both : lastOf([&](std::size_t i) { return !either.empty() && isThere(either, i); });
  return row > 0 ? row - 1 : 0;
}

/// A number or word itself, or "301 x 7" for what has dimensions; empty for what is not there.
std::string contentOf(const Field& field, const Extents& extents) {
  const std::string shape = fmt::format("{}", fmt::join(shapeOf(field.dimensions, extents), " x "));
  return std::visit(Visitor{[](double* x) { return std::isnan(*x) ? std::string() : fmt::format("{:.12g}", *x); },
                            [](std::int64_t* x) { return fmt::format("{}", *x); },
                            [](std::uint64_t* x) { return fmt::format("{}", *x); }, [](std::string* x) { return *x; },
                            [](Choice x) { return x.word(); },
                            [](WholeText x) { return countText(static_cast<long long>(x.text->size()), "byte"); },
                            [](bool*) { return std::string(); },
                            [&](std::vector<std::int64_t>* v) { return v->empty() ? std::string() : shape; },
                            [&](const Numbers& n) { return n.empty() ? std::string() : shape; }},
                    field.value);
}

/// One row a field, as far as it is there.
std::string recordText(const Group& group, const Extents& extents) {
  std::vector<std::vector<std::string>> rows;
  for (const Field& field : group.fields(0)) {
    const std::string content = contentOf(field, extents);
    if (content.empty()) continue;
    const bool hasUnit = field.dimensions.empty() && !field.unit.empty() && field.unit != unit::one;
    rows.push_back({"  " + std::string(field.name), content + (hasUnit ? " " + std::string(field.unit) : ""),
                    std::string(field.meaning)});
  }
  return textTable(rows, 3);
}

std::string listText(const Group& group) {
  std::vector<std::string_view> names;
  for (const Field& field : group.fields(0)) names.push_back(field.name);
  return fmt::format("    {} of {}\n", group.size, fmt::join(names, ", "));
}

/// Distribution and membership, or what stands in the place of both.
std::string shapesText(const Results& results, const UncertainInfo& uncertain) {
  const std::string distribution = shapeText(results, uncertain, ShapeKind::distribution),
                    membership = shapeText(results, uncertain, ShapeKind::membership);
  return distribution == membership ? distribution : distribution + ", " + membership;
}

/// " (tip y at 0.5 s; half of them within 0.009)": where bounds of probabilities are farthest apart, and how far
/// others.
std::string widestGapText(const Results& results) {
  const DistributionResult& d = results.distribution;
  const std::size_t outputs = results.outputs.size();
  std::vector<double> gaps;
  std::size_t widest = 0;
  double greatest = 0;
  for (std::size_t i = 0; i < d.gaps.data.size(); ++i) {
    if (isMargin(results, i % outputs) || !(d.gaps.data[i] < 1)) continue;
    gaps.push_back(d.gaps.data[i]);
    if (d.gaps.data[i] > greatest) widest = i, greatest = d.gaps.data[i];
  }
  if (gaps.size() < 2) return {};
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
  std::ranges::nth_element(gaps, middle);
  return fmt::format(" ({}{}; half of them within {})", results.outputs[widest % outputs].name,
                     results.horizon > 0 ? " at " + timeText(d.time[widest / outputs]) : std::string(),
                     atMostText(*middle, 2));
}

/// How closely distribution functions are bounded, and of how many of them nothing is known.
std::string probabilitiesText(const Results& results) {
  const DistributionResult& d = results.distribution;
  const std::size_t outputs = results.outputs.size();
  long long known = 0, unknown = 0;
  double gap = 0;
  for (std::size_t i = 0; i < d.gaps.data.size(); ++i) {
    if (isMargin(results, i % outputs)) continue;
    if (d.gaps.data[i] < 1)
      ++known, gap = std::max(gap, d.gaps.data[i]);
    else if (!std::isnan(d.gaps.data[i]) || !isOneValue(results, d.time[i / outputs], i % outputs))
      ++unknown;
  }
  const std::string& why = d.stopped.empty() ? d.why : d.stopped;
  if (known == 0)
    return unknown == 0 && d.stopped.empty()
               ? ""
               : fmt::format("  probabilities: nothing is known of them{}\n", why.empty() ? "" : ": " + why);
  return fmt::format("  probabilities: {}bounds {} apart at most{}, at {}{}\n",
                     unknown == 0 ? ""
                                  : fmt::format("nothing is known of {} of {} distributions; of the others ", unknown,
                                                known + unknown),
                     atMostText(gap, 2), why.empty() ? "" : widestGapText(results),
                     countText(static_cast<long long>(d.time.size()), "time"),
                     why.empty() ? "" : fmt::format(" ({} is aimed at: {})", numberText(d.wanted, 3), why));
}

/// What was spent in all, and of how much.
std::string spentText(const Results& results) {
  if (!std::isfinite(results.limits.time)) return {};
  return fmt::format("in all {:.2f} of {:.6g} s, {:.2f} of {:.3g} GB", results.cpu, results.limits.time,
                     results.memory / 1e9, results.limits.memory / 1e9);
}

/// Every output at the last time reached, and how much wider than the samples the enclosure is at most.
std::string lastText(const Results& results) {
  const std::size_t row = lastRow(results);
  std::vector<std::vector<std::string>> rows{
      {results.horizon > 0 ? fmt::format("at {} s", results.time[row]) : "output",
       results.interval.at.empty() && !results.fuzzy.outer.empty() ? "widest alpha-cut" : "enclosure", "envelope",
       "overestimation (max)"}};
  for (std::size_t j = 0; j < results.outputs.size(); ++j) {
    const std::string name = toldName(results, j, row);
    if (name.empty()) continue;
    const bool known = j < results.comparison.maximumOf.size() && std::isfinite(results.comparison.maximumOf[j]);
    rows.push_back({headingOf(name, results.outputs[j].unit), shortBounds(results, provedBounds(results), row, j),
                    shortBounds(results, results.stochastic.envelope, row, j),
                    known ? timesText(results.comparison.maximumOf[j]) : "-"});
  }
  return textTable(rows);
}

std::string approachesText(const Results& results) {
  std::string text;
  for (const std::string& line : approachLines(results, approachesOf(results)))
    text += fmt::format("  closest approach: {}\n", line);
  return text;
}

/// How the quantities hang together, and the machine.
std::string assemblyText(const Results& results) {
  std::string text;
  if (!results.dependence.empty()) text += fmt::format("  quantities: {}\n", results.dependence);
  if (!results.assembly.empty()) text += fmt::format("  assembled at the nominal start: {}\n", results.assembly);
  return text;
}

std::string assumptionsText(const Results& results) {
  return results.assumptions.empty() ? "" : fmt::format("  assumed, not proved: {}\n", results.assumptions);
}

/// How closely the answers are known.
std::string doubtsText(const Results& results) {
  return statisticsText(results) + transformationText(results) +
         (results.distribution.present ? probabilitiesText(results) : "");
}

/// What analyses beside the answers have found.
std::string furtherText(const Results& results) {
  std::string text;
  for (const Boxed<FurtherPart>& part : results.further) {
    if (!part->present) continue;
    text += fmt::format("  {}: {}{}{}\n", part->title(), part->verb(),
                        results.horizon > 0 ? " up to " + reachedText(part->reached) : "",
                        part->why.empty() ? "" : ": " + part->why);
    for (const std::string& line : part->told()) text += fmt::format("    {}\n", line);
  }
  return text;
}

/// What each analysis took; empty where none was done.
std::string costsText(const Results& results) {
  std::vector<std::string> costs;
  bool isAnything = false;
  const auto spend = [&](const std::string& what, double cpu) {
    isAnything = true;
    if (cpu >= leastCpuTold) costs.push_back(fmt::format("{} {}", what, cpuText(cpu)));
  };
  for (const Part* part : results.parts())
    if (part->present) spend(part->title(), part->spent());
  for (const CostInfo& cost : results.costs) spend(cost.what, cost.cpu);
  const std::string spent = spentText(results);
  if (!isAnything || (costs.empty() && spent.empty())) return {};
  return fmt::format("  CPU: {}{}{}\n", fmt::join(costs, ", "), costs.empty() || spent.empty() ? "" : "; ", spent);
}

// ---- The summary of a run -------------------------------------------------------------------------------------------

/// Rows that are shown together or not at all.
using Item = std::vector<std::string>;

/// What belongs together, the most important items first.
struct SummaryPart {
  std::vector<Item> items;
  std::size_t least = 0;  ///< rows of it that come before the rest of other parts
};

class SummaryParts {
 public:
  /// `reason`: why the run stopped. Where what leads says it, nothing else says it again.
  SummaryParts(std::size_t columns, std::string reason) : columns_(columns), reason_(": " + reason) {}

  /// A sentence, or several; nothing of an empty one.
  void add(const std::string& sentence, std::size_t indent = 0) {
    if (sentence.empty()) return;
    const bool leads = all.size() == 1 && all.front().items.empty();
    if (leads) isReasonSaid_ = reason_.size() > 2 && sentence.find(reason_) != std::string::npos;
    all.back().items.push_back(wrapped(leads ? sentence : withoutReason(sentence), indent, columns_));
  }
  /// What is told only where all is.
  void addBesides(const std::string& sentence, std::size_t indent, bool isAllTold) {
    if (isAllTold) return add(sentence, indent);
    if (!sentence.empty()) untold += wrapped(sentence, indent, columns_).size();
  }
  /// Each line an item.
  void addLines(std::string_view text) {
    for (const std::string& line : linesOf(text)) {
      const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
      add(line.substr(indent), indent);
    }
  }
  /// Each row an item; the heading stands by none alone.
  void addTable(std::string_view text) {
    std::vector<std::string> rows = linesOf(text);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (i == 1)
        all.back().items.back().push_back(std::move(rows[i]));
      else
        all.back().items.push_back({std::move(rows[i])});
  }
  void begin(std::size_t least) { all.push_back({{}, least}); }

  std::vector<SummaryPart> all;
  std::size_t untold = 0;  ///< rows of what is told only where all is

 private:
  std::string withoutReason(std::string sentence) const {
    for (std::size_t at = 0; isReasonSaid_ && (at = sentence.find(reason_, at)) != std::string::npos;)
      sentence.erase(at, reason_.size());
    return sentence;
  }
  static std::vector<std::string> linesOf(std::string_view text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
      end = std::min(text.find('\n', begin), text.size());
      lines.emplace_back(text.substr(begin, end - begin));
    }
    return lines;
  }

  const std::size_t columns_;
  const std::string reason_;
  bool isReasonSaid_ = false;
};

/// How many items of each part are shown in so many rows: first of each part what it keeps in any case, then what room
/// is left for, both in order.
std::vector<std::size_t> itemsShown(const std::vector<SummaryPart>& parts, std::size_t rows) {
  std::vector<std::size_t> shown(parts.size(), 0);
  std::size_t used = 0;
  for (const bool isFirst : {true, false})
    for (std::size_t p = 0; p < parts.size(); ++p) {
      std::size_t ofPart = 0;
      for (std::size_t i = 0; i < shown[p]; ++i) ofPart += parts[p].items[i].size();
      for (; shown[p] < parts[p].items.size(); ++shown[p]) {
        const std::size_t more = parts[p].items[shown[p]].size();
        const bool isEnough = isFirst && ofPart >= parts[p].least, isLead = p == 0 && shown[p] == 0;
        if (isEnough || (used + more > rows && !isLead)) break;
        used += more;
        ofPart += more;
      }
    }
  return shown;
}

std::size_t rowsOf(const std::vector<SummaryPart>& parts) {
  std::size_t rows = 0;
  for (const SummaryPart& part : parts)
    for (const Item& item : part.items) rows += item.size();
  return rows;
}

std::string textOf(const std::vector<SummaryPart>& parts, const std::vector<std::size_t>& shown) {
  std::string text;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t i = 0; i < shown[p]; ++i)
      for (const std::string& row : parts[p].items[i]) text += row + "\n";
  return text;
}

/// All of it, or in `style.rows` rows at most what is most important, and how much more there is.
std::string fitted(const SummaryParts& parts, const SummaryStyle& style) {
  const std::size_t all = rowsOf(parts.all);
  const bool isWhole = style.isVerbose || all <= style.rows;
  const std::vector<std::size_t> shown = itemsShown(parts.all, isWhole ? all : style.rows - 1);
  std::string text = textOf(parts.all, shown);
  if (isWhole) return text;
  const auto left = static_cast<long long>(all + parts.untold) - std::ranges::count(text, '\n');
  return text + fmt::format("  {}: --verbose\n", countText(left, "more line"));
}

/// Each requirement in the sentence of its card on the page, the worst first; where much is told its answers below it.
void addRequirements(const Results& results, const Verdict& verdict, const SummaryStyle& style, SummaryParts& parts) {
  const std::vector<RequirementWords> words = wordsOfRequirements(results);
  const std::vector<std::string> sentences = plainRequirements(results);
  for (const std::size_t r : shownRequirements(results)) {
    const RequirementWords& of = words[r];
    const bool isNamed = !of.demand.ends_with(of.name);  // else by itself
    if (verdict.word == Agreement::outside) {
      parts.add("contradicted  " + of.name, 2);
      continue;
    }
    parts.add(fmt::format("{:<8}  {}{}{}", stateOf(results.requirements[r]), isNamed ? of.name + ": " : "",
                          sentences[r], shrinkSentence(results.requirements[r])),
              2);
    const auto addAnswer = [&](const char* title, const std::string& text) {
      if (!text.empty()) parts.addBesides(fmt::format("{:<11} {}", title, text), 4, style.isVerbose);
    };
    addAnswer("demanded", of.demand);
    addAnswer("guaranteed", of.guaranteed);
    addAnswer("probable", of.probable);
    addAnswer("estimated", of.estimated);
    addAnswer("possible", of.possible);
  }
  parts.add(unshownRequirements(results), 2);
}

/// What leads, the requirements, and the verdict with its notes.
void addAnswers(const Results& results, const Verdict& verdict, const std::string& lead, const SummaryStyle& style,
                SummaryParts& parts) {
  parts.begin(1);
  parts.add(lead);
  parts.begin(7);
  addRequirements(results, verdict, style, parts);
  parts.begin(1);
  parts.add(verdict.sentence);
  parts.begin(2);
  for (const std::string& note : verdict.notes) parts.add(note, 2);
}

}  // namespace

std::string shapeText(const Results& results, const UncertainInfo& uncertain, ShapeKind shape) {
  std::vector<std::string> numbers;
  double lower = uncertain.lower, upper = uncertain.upper;
  const Told told(uncertain);
  bool areIntervals = false;
  const auto isListed = [](const std::string& number) {  // among many
    return number.starts_with("value ") || number.starts_with("weight ") || number.starts_with("membership ");
  };
  for (const ShapeInfo& number : results.shapes) {
    if (number.quantity != uncertain.name || number.shape != shape) continue;
    const bool isOfQuantity = number.unit == uncertain.unit && number.unit != unit::one;
    const std::string value = numberText(isOfQuantity ? told.of(number.value) : number.value, 6);
    if (number.name == "lower") {
      lower = number.value;
    } else if (number.name == "upper") {
      upper = number.value;
    } else if (number.name.ends_with(", at most") && !numbers.empty()) {
      numbers.back() += " to " + value;
    } else if (number.name == "left") {
      numbers.push_back("core " + value);  // as the study states it
    } else if (number.name == "right" && !numbers.empty()) {
      numbers.back() += " to " + value;
    } else if (number.name.starts_with("lower ")) {
      numbers.push_back("[" + value);
    } else if (number.name.starts_with("upper ") && !numbers.empty()) {
      numbers.back() += fmt::format(", {}]", value);
    } else if (number.name.starts_with("mass ") && !numbers.empty()) {
      numbers.back() += " mass " + value;
      areIntervals = true;
    } else if (number.name == "cut_off") {
      numbers.push_back(numberText(100 * number.value, 3) + " % cut off");
    } else if (!isListed(number.name)) {
      const bool isOfLogarithm = number.name.starts_with("log_mean") && told.unit() != uncertain.unit;
      numbers.push_back(fmt::format("{}{} {}", number.name,
                                    isOfLogarithm ? fmt::format(" (of the number in {})", uncertain.unit) : "", value));
    }
  }
  constexpr std::size_t most = 6;  // of evidence
  if (areIntervals && numbers.size() > most) {
    const std::string others = countText(static_cast<long long>(numbers.size() - most), "more interval");
    numbers.resize(most);
    numbers.push_back(others);
  }
  const auto text = [&](double from, double to) {
    const auto [below, above] = told.of(from, to);
    return rangeText(below, above, 6);
  };
  if (const std::string on = text(lower, upper); on != text(uncertain.lower, uncertain.upper))
    numbers.insert(numbers.begin(), "on " + on);
  constexpr double least = 1.001 / 256;  // of what was looked at
  const std::string doubt =
      shape == ShapeKind::membership && uncertain.inconsistency > least
          ? fmt::format("; events are more probable than possible by up to {}", atMostText(uncertain.inconsistency, 2))
          : "";
  const std::string& name = uncertain.shape(shape);
  return (numbers.empty() ? name : fmt::format("{} ({})", name, fmt::join(numbers, ", "))) + doubt;
}

std::string textSummary(const Results& results) {
  return rangesText(results) + lastText(results) + approachesText(results) + assemblyText(results) +
         assumptionsText(results) + doubtsText(results) + furtherText(results) + costsText(results);
}

std::string runSummary(const Results& results, const Verdict& verdict, const std::string& lead,
                       const SummaryStyle& style) {
  SummaryParts parts(style.columns, results.stopped);
  addAnswers(results, verdict, lead, style, parts);
  const auto addLines = [&](std::size_t least, const std::string& text) {
    parts.begin(least);
    parts.addLines(text);
  };
  const auto addTable = [&](std::size_t least, const std::string& text) {
    parts.begin(least);
    parts.addTable(text);
  };
  addLines(1, assumptionsText(results));
  addTable(5, rangesText(results));
  addLines(2, approachesText(results));
  addLines(3, furtherText(results));
  addTable(results.horizon > 0 ? 0 : 5, lastText(results));
  addLines(0, assemblyText(results) + doubtsText(results));
  addLines(0, costsText(results));
  return fitted(parts, style);
}

std::string verdictSummary(const Results& results, const Verdict& verdict, const std::string& lead,
                           const SummaryStyle& style) {
  SummaryParts parts(style.columns, results.stopped);
  addAnswers(results, verdict, lead, style, parts);
  return fitted(parts, style);
}

std::string infoText(const Results& results) {
  std::string text =
      fmt::format("{}\n  {}, from {}\n  by Gamut {} on {}, {}, seed {}\n", results.title, results.analysis,
                  results.studyFile, results.version, results.host, results.date, results.seed);
  for (const ExtensionInfo& e : results.extensions)
    text += fmt::format("  extended from {} by Gamut {} on {}, {}\n", countText(e.before, "sample"), e.version, e.host,
                        e.date);
  if (results.horizon > 0)
    text += fmt::format("  {} output times from {} s to {} s\n", results.time.size(), results.time.front(),
                        results.time.back());
  for (const UncertainInfo& u : results.uncertain) {
    const Told told(u);
    const auto [lower, upper] = told.of(u.lower, u.upper);
    text += fmt::format("  uncertain: {} ({}) in {}, nominal {:.12g}, {}\n", u.name, u.quantity,
                        inUnit(rangeText(lower, upper, 12), told.unit()), told.of(u.nominal), shapesText(results, u));
  }
  for (std::size_t j = 0; j < results.outputs.size(); ++j) {
    const OutputInfo& o = results.outputs[j];
    text += fmt::format("  {}: {} ({}){}\n", isMargin(results, j) ? "margin of a requirement" : "output", o.name,
                        o.quantity, o.unit.empty() || o.unit == "1" ? "" : ", " + o.unit);
  }
  for (const Answer* answer : results.answers()) {
    if (!answer->present) continue;
    text += fmt::format("  {}: ", answer->title());
    if (results.horizon > 0)
      text += fmt::format("up to {}{}; ", reachedText(answer->reached), answer->why.empty() ? "" : ": " + answer->why);
    text += fmt::format("{} CPU; {}\n", cpuText(answer->cpu), answer->amount());
  }
  return text;
}

std::string shortInfo(const Results& results, const std::string& verdict, const SummaryStyle& style) {
  SummaryParts parts(style.columns, "");
  parts.begin(1);
  parts.addLines(infoText(results));
  parts.begin(2);
  parts.add(verdict, 2);
  parts.begin(0);
  parts.addLines(contentText(results));
  return fitted(parts, style);
}

std::string contentText(const Results& results) {
  const std::vector<Group> groups = describe(results);
  const Extents extents = extentsOf(groups);
  std::string text;
  for (const Group& group : groups) {
    if (group.size == 0) continue;
    text += fmt::format("  {}{}{}\n", group.path, group.meaning.empty() ? "" : ": ", group.meaning);
    text += group.isList() ? listText(group) : recordText(group, extents);
  }
  return text;
}

}  // namespace gamut
