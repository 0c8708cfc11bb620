// Samples that were kept, one by one: what their quantities are, how their outputs stand where limits are nearest, and
// which of them violate a requirement. A script makes a picture of it, in which axes are brushed; without it there is a
// table of the most telling samples.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "reports/page/decided_map.hpp"
#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/requirements.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"
#include "studies/results/extremes.hpp"
#include "studies/told.hpp"

namespace gamut {
namespace {

constexpr double unknownNumber = std::numeric_limits<double>::quiet_NaN();

/// A number a sample; of an output also where its limits are.
struct ExplorerAxis {
  std::string name, unit;
  std::vector<double> values = {}, limits = {};
  std::optional<std::size_t> quantity = {};
};

/// A sample whose values and motion are kept.
struct ExploredSample {
  std::size_t values = 0, motion = 0;  ///< rows of what is kept
  std::int64_t number = 0;
  std::vector<double> margins = {};  ///< of each shown requirement where it decides; NaN where it did not arrive
};

std::string numberOrNull(double x) { return std::isfinite(x) ? fmt::format("{:.6g}", x) : "null"; }

std::string numbersList(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double x : numbers) texts.push_back(numberOrNull(x));
  return fmt::format("[{}]", fmt::join(texts, ","));
}

class SampleExplorer {
 public:
  explicit SampleExplorer(const Report& report)
      : report_(report), results_(report.results), kept_(report.results.stochastic.kept) {
    for (const std::size_t r : shownRequirements(results_)) {
      if (shown_.size() == mostRequirements) break;
      shown_.push_back(r);
    }
    gather();
    choose();
    addQuantities();
    addOutputs();
  }

  bool isEmpty() const { return samples_.size() < 3 || axes_.size() < 2; }

  std::string html() const {
    return fmt::format(
        "<p class=\"hint\">{}</p>\n<div class=\"explorer-live\"></div>\n<script type=\"application/json\" "
        "class=\"explored\">{}</script>\n{}",
        escapeHtml(amountText()), data(), table());
  }

 private:
  static constexpr std::size_t mostSamples = 200, mostRequirements = 12, mostQuantities = 9, mostOutputs = 6,
                               mostRows = 12, mostCurveNumbers = 200'000;

  std::size_t times() const { return results_.time.size(); }
  std::size_t outputs() const { return results_.outputs.size(); }
  double at(const ExploredSample& sample, std::size_t row, std::size_t output) const {
    return kept_.motions[(sample.motion * times() + row) * outputs() + output];
  }

  /// The least of its margins at an output time.
  double marginAt(const ExploredSample& sample, std::size_t row, const RequirementResult& requirement) const {
    double least = INFINITY;
    for (std::uint64_t m = 0; m < static_cast<std::uint64_t>(requirement.margins); ++m) {
      const double margin = at(sample, row, requirement.margin + m);
      if (std::isnan(margin)) return unknownNumber;
      least = std::min(least, margin);
    }
    return least;
  }

  /// The output time of its window at which it decides: where it is always to be met that of the least margin, where
  /// once that of the greatest. Nothing where the sample did not arrive.
  std::optional<std::size_t> decisiveRow(const ExploredSample& sample, const RequirementResult& requirement) const {
    std::optional<std::size_t> decisive;
    double decided = 0;
    for (std::size_t i = 0; i < times(); ++i) {
      if (results_.horizon > 0 && (results_.time[i] < requirement.from || results_.time[i] > requirement.until))
        continue;
      const double margin = marginAt(sample, i, requirement);
      if (std::isnan(margin)) return {};
      if (decisive && !(requirement.isAlways ? margin < decided : margin > decided)) continue;
      decisive = i;
      decided = margin;
    }
    return decisive;
  }

  bool isMissed(const RequirementResult& requirement, double margin) const {
    const auto margins = marginsOf(results_, requirement);
    const bool isStrict = std::ranges::any_of(margins, &MarginInfo::isStrict);
    return isStrict ? margin <= 0 : margin < 0;
  }
  bool isMissed(const ExploredSample& sample) const {
    for (std::size_t k = 0; k < shown_.size(); ++k)
      if (isMissed(results_.requirements[shown_[k]], sample.margins[k])) return true;
    return false;
  }

  /// All samples of which values and motion are kept.
  void gather() {
    const std::size_t quantities = results_.uncertain.size(), cells = times() * outputs();
    if (!kept_.present || cells == 0 || kept_.motions.size() < kept_.motionNumber.size() * cells ||
        kept_.values.size() < kept_.number.size() * quantities)
      return;
    std::unordered_map<std::int64_t, std::size_t> places;
    for (std::size_t place = 0; place < kept_.number.size(); ++place) places.emplace(kept_.number[place], place);
    for (std::size_t i = 0; i < kept_.motionNumber.size(); ++i) {
      const auto found = places.find(kept_.motionNumber[i]);
      if (found == places.end()) continue;
      ExploredSample sample{found->second, i, kept_.motionNumber[i]};
      for (const std::size_t r : shown_) {
        const RequirementResult& requirement = results_.requirements[r];
        const std::optional<std::size_t> row = decisiveRow(sample, requirement);
        sample.margins.push_back(row ? marginAt(sample, *row, requirement) : unknownNumber);
      }
      samples_.push_back(std::move(sample));
    }
    all_ = samples_.size();
  }

  /// Of too many those that violate a requirement, to one half, and others equally far from each other.
  void choose() {
    const std::size_t most = std::min(mostSamples, std::max<std::size_t>(report_.detail.rows / 10, 10));
    if (samples_.size() <= most) return;
    const auto met = std::ranges::stable_partition(samples_, [&](const auto& sample) { return isMissed(sample); });
    const std::vector<ExploredSample> missed(samples_.begin(), met.begin()), others(met.begin(), met.end());
    const std::size_t ofMissed = std::min(missed.size(), std::max(most / 2, most - std::min(most, others.size())));
    samples_.clear();
    for (const auto& [from, count] : {std::pair(&missed, ofMissed), std::pair(&others, most - ofMissed)})
      for (std::size_t i = 0; i < std::min(count, from->size()); ++i)
        samples_.push_back((*from)[i * from->size() / std::min(count, from->size())]);
  }

  void addQuantities() {
    const std::size_t quantities = results_.uncertain.size();
    for (std::size_t q = 0; q < quantities && axes_.size() < mostQuantities; ++q) {
      const UncertainInfo& quantity = results_.uncertain[q];
      if (variesInTime(quantity)) continue;
      const Told told(quantity);
      ExplorerAxis axis{quantity.name, told.unit() == "1" ? "" : told.unit()};
      axis.quantity = q;
      for (const ExploredSample& sample : samples_)
        axis.values.push_back(told.of(kept_.values[sample.values * quantities + q]));
      axes_.push_back(std::move(axis));
    }
  }

  /// Of those that are limited where that decides, of others at the end.
  void addOutputs() {
    std::vector<std::size_t> there;
    const std::vector<Limit> limits = limitsOf(results_);
    for (const std::size_t r : shown_)
      for (const Limit& limit : limits)
        if (limit.requirement == r && std::ranges::find(there, limit.output) == there.end() &&
            there.size() < mostOutputs) {
          there.push_back(limit.output);
          axes_.push_back(limitedAxis(limit, limits));
        }
    for (std::size_t o = 0; o < outputs() && there.size() < mostOutputs; ++o) {
      if (isMargin(results_, o) || !report_.detail.plots(o) || std::ranges::find(there, o) != there.end()) continue;
      ExplorerAxis axis = axisOf(o, results_.horizon > 0 ? " at the end" : "",
                                 [&](const ExploredSample&) { return std::optional(times() - 1); });
      if (isOneValue(axis, o)) continue;
      there.push_back(o);
      axes_.push_back(std::move(axis));
    }
  }

  /// But for roundings.
  bool isOneValue(const ExplorerAxis& axis, std::size_t output) const {
    double low = INFINITY, high = -INFINITY;
    for (const double x : axis.values) low = std::fmin(low, x), high = std::fmax(high, x);
    return !(high > low) || isLittle(high - low, motionSize(results_, output));
  }

  template <class RowOf>
  ExplorerAxis axisOf(std::size_t output, const char* when, const RowOf& rowOf) const {
    const OutputInfo& info = results_.outputs[output];
    ExplorerAxis axis{info.name + when, info.unit == "1" ? "" : info.unit};
    for (const ExploredSample& sample : samples_) {
      const std::optional<std::size_t> row = rowOf(sample);
      axis.values.push_back(row ? at(sample, *row, output) : unknownNumber);
    }
    return axis;
  }

  ExplorerAxis limitedAxis(const Limit& limit, const std::vector<Limit>& limits) const {
    const RequirementResult& requirement = results_.requirements[limit.requirement];
    ExplorerAxis axis = axisOf(limit.output, results_.horizon > 0 ? " at its worst" : "",
                               [&](const ExploredSample& sample) { return decisiveRow(sample, requirement); });
    for (const Limit& other : limits)
      if (other.output == limit.output && other.requirement == limit.requirement && isDrawn(other.value))
        axis.limits.push_back(other.value);
    return axis;
  }

  // ---- Words and data

  std::string amountText() const {
    const auto missed = static_cast<std::size_t>(
        std::ranges::count_if(samples_, [&](const ExploredSample& sample) { return isMissed(sample); }));
    std::string text = samples_.size() < all_
                           ? fmt::format("{} of the {} samples whose motions are kept", samples_.size(), all_)
                           : fmt::format("The {} samples whose motions are kept", all_);
    if (results_.requirements.empty()) return text + ".";
    text += fmt::format("; {} of them {} a requirement at an output time.",
                        missed == 0 ? "none" : fmt::format("{}", missed),
                        missed == 1 || missed == 0 ? "violates" : "violate");
    if (samples_.size() < all_ && missed > 0) text += " Those that violate one were chosen first, up to one half.";
    return text;
  }

  std::string axesData() const {
    std::vector<std::string> texts;
    for (const ExplorerAxis& axis : axes_)
      texts.push_back(
          fmt::format("{{\"name\":{},\"unit\":{},\"ends\":{},\"isQuantity\":{},\"limits\":{},\"values\":{}}}",
                      jsonText(axis.name), jsonText(axis.unit), numbersList(endsOf(axis)),
                      axis.quantity ? "true" : "false", numbersList(axis.limits), numbersList(axis.values)));
    return fmt::format("[{}]", fmt::join(texts, ",\n"));
  }

  /// Of the interval of a quantity, told.
  std::vector<double> endsOf(const ExplorerAxis& axis) const {
    if (!axis.quantity) return {};
    const UncertainInfo& q = results_.uncertain[*axis.quantity];
    return {Told(q).of(q.lower), Told(q).of(q.upper)};
  }

  /// Maps of each pair of quantities' axes, the former to the right: rectangles that are met, and that are violated.
  std::string cellsData(std::size_t requirement) const {
    constexpr int finest = 64, coarse = 32;  // the latter where there are many maps
    constexpr std::size_t few = 5;
    std::vector<const RequirementCell*> cells;
    for (const RequirementCell& cell : results_.requirements.cells)
      if (cell.requirement == requirement) cells.push_back(&cell);
    if (cells.empty()) return "null";
    std::vector<std::size_t> quantities;
    for (const ExplorerAxis& axis : axes_)
      if (axis.quantity) quantities.push_back(*axis.quantity);
    const int size = quantities.size() <= few ? finest : coarse;
    std::vector<std::string> maps;
    for (std::size_t i = 0; i < quantities.size(); ++i)
      for (std::size_t j = i + 1; j < quantities.size(); ++j) {
        const DecidedMap map = decidedMap(cells, quantities[i], quantities[j], size);
        maps.push_back(fmt::format("\"{} {}\":[{},{}]", i, j, rectanglesList(map.met), rectanglesList(map.violated)));
      }
    const auto open = std::ranges::count(cells, Decision::open, [](const RequirementCell* cell) { return cell->word; });
    return fmt::format("{{\"size\":{},\"count\":{},\"open\":{},\"maps\":{{{}}}}}", size, cells.size(), open,
                       fmt::join(maps, ","));
  }
  static std::string rectanglesList(const std::vector<DecidedMap::Rectangle>& all) {
    std::vector<int> numbers;
    for (const DecidedMap::Rectangle& one : all) numbers.insert(numbers.end(), one.begin(), one.end());
    return fmt::format("[{}]", fmt::join(numbers, ","));
  }

  /// Of each quantity's axis, told: where a requirement is proved to be met while no quantity deviates by more, and
  /// where it is proved to be violated.
  std::string provedData(const RequirementResult& requirement) const {
    std::vector<std::string> met;
    std::vector<double> violated;
    for (const ExplorerAxis& axis : axes_) {
      if (!axis.quantity) continue;
      const UncertainInfo& q = results_.uncertain[*axis.quantity];
      const Told told(q);
      const double share = std::min(requirement.factor, 1.0), low = q.nominal - share * (q.nominal - q.lower),
                   high = q.nominal + share * (q.upper - q.nominal);
      met.push_back(numbersList({told.of(low), told.of(high)}));
      const bool isKnown = *axis.quantity < requirement.violation.size();
      violated.push_back(isKnown ? told.of(requirement.violation[*axis.quantity]) : unknownNumber);
    }
    const bool isShown = requirement.factor > 0 && std::isfinite(requirement.factor);
    return fmt::format("\"met\":{},\"violated\":{}", isShown ? fmt::format("[{}]", fmt::join(met, ",")) : "null",
                       numbersList(violated));
  }

  std::string requirementsData() const {
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < shown_.size(); ++k) {
      const RequirementResult& requirement = results_.requirements[shown_[k]];
      std::string states;
      for (const ExploredSample& sample : samples_)
        states += std::isnan(sample.margins[k]) ? '?' : isMissed(requirement, sample.margins[k]) ? '-' : '+';
      texts.push_back(fmt::format("{{\"name\":{},\"states\":\"{}\",{},\"cells\":{}}}", jsonText(requirement.name),
                                  states, provedData(requirement), cellsData(shown_[k])));
    }
    return fmt::format("[{}]", fmt::join(texts, ",\n"));
  }

  /// Motions of some outputs at some times, in thousandths between least and greatest.
  std::string curvesData() const {
    std::vector<std::size_t> plotted;
    for (std::size_t o = 0; o < outputs(); ++o)
      if (report_.detail.plots(o)) plotted.push_back(o);
    if (results_.horizon == 0 || plotted.empty() || times() < 2) return "{\"time\":[]}";
    constexpr std::size_t fewest = 40, finest = 160;
    const std::size_t each = samples_.size() * fewest;
    plotted.resize(std::min(plotted.size(), std::max<std::size_t>(mostCurveNumbers / each, 1)));
    const std::size_t rows =
        std::min({times(), finest, std::max(fewest, mostCurveNumbers / (samples_.size() * plotted.size()))});
    std::vector<std::size_t> chosen;
    std::vector<double> time;
    for (std::size_t i = 0; i < rows; ++i) {
      chosen.push_back(i * (times() - 1) / (rows - 1));
      time.push_back(results_.time[chosen.back()]);
    }
    std::string text = "{\"time\":" + numbersList(time);
    for (const std::size_t o : plotted) text += ",\n" + curvesOf(o, chosen);
    return text + "}";
  }

  std::string curvesOf(std::size_t output, const std::vector<std::size_t>& rows) const {
    double low = INFINITY, high = -INFINITY;
    for (const ExploredSample& sample : samples_)
      for (const std::size_t row : rows)
        if (const double x = at(sample, row, output); isDrawn(x)) low = std::min(low, x), high = std::max(high, x);
    const double step = high > low ? (high - low) / 1000 : 1;
    std::string text =
        fmt::format("\"{}\":{{\"low\":{},\"step\":{},\"lines\":[", output, numberOrNull(low), numberOrNull(step));
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      text += k == 0 ? "[" : ",[";
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double x = at(samples_[k], rows[i], output);
        text += i == 0 ? "" : ",";
        text += isDrawn(x) && isDrawn(low) ? fmt::format("{:.0f}", (x - low) / step) : "null";
      }
      text += "]";
    }
    return text + "]}";
  }

  std::string data() const {
    std::vector<std::string> names;
    for (const ExploredSample& sample : samples_) names.push_back(jsonText(results_.stochastic.nameOf(sample.number)));
    return fmt::format("{{\"samples\":[{}],\n\"axes\":{},\n\"requirements\":{},\n\"curves\":{}}}",
                       fmt::join(names, ","), axesData(), requirementsData(), curvesData());
  }

  /// Those that violate a requirement by most, or come nearest to it; without requirements the extremes of outputs.
  std::vector<std::size_t> telling() const {
    std::vector<std::size_t> order(samples_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const ExplorerAxis& last = axes_.back();
    std::ranges::stable_sort(order, std::less<>(), [&](std::size_t i) {
      const double key = shown_.empty() ? -std::abs(last.values[i]) : samples_[i].margins.front();
      return std::isnan(key) ? INFINITY : key;
    });
    order.resize(std::min(order.size(), mostRows));
    return order;
  }

  std::string table() const {
    std::vector<std::string> heads{"sample"};
    for (const ExplorerAxis& axis : axes_) heads.push_back(headingOf(axis.name, axis.unit));
    if (!shown_.empty()) heads.push_back(results_.requirements[shown_.front()].name);
    TableText rows(shown_.empty() ? "The farthest at the last of these" : "The nearest to the limit, or beyond it",
                   heads);
    for (const std::size_t i : telling()) {
      std::vector<std::string> cells;
      for (const ExplorerAxis& axis : axes_)
        cells.push_back(std::isfinite(axis.values[i]) ? numberText(axis.values[i], 5) : "did not arrive");
      if (!shown_.empty()) {
        const double margin = samples_[i].margins.front();
        cells.emplace_back(std::isnan(margin)                                        ? "did not arrive"
                           : isMissed(results_.requirements[shown_.front()], margin) ? "violated"
                                                                                     : "met");
      }
      rows.row(results_.stochastic.nameOf(samples_[i].number), cells);
    }
    return "<details class=\"more\"><summary>The most telling samples, in numbers</summary>\n" + rows.html() +
           "</details>\n";
  }

  const Report& report_;
  const Results& results_;
  const KeptSamples& kept_;
  std::vector<std::size_t> shown_;  ///< numbers of requirements, the worst first
  std::vector<ExploredSample> samples_;
  std::vector<ExplorerAxis> axes_;
  std::size_t all_ = 0;  ///< samples that could be shown
};

}  // namespace

std::string explorerSection(const Report& report) {
  const SampleExplorer explorer(report);
  return explorer.isEmpty() ? std::string() : explorer.html();
}

}  // namespace gamut
