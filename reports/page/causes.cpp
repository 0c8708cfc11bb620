// What to do about a requirement that can fail: what each quantity alone does to what it limits, at its worst instant.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "reports/drawing/axes.hpp"
#include "reports/page/page.hpp"
#include "reports/requirements.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"
#include "studies/told.hpp"
#include "studies/varied_alone.hpp"

namespace gamut {
namespace {

constexpr double barsWide = 320, barHigh = 20, rulerHigh = 30;

double middleOf(const ProvedValue& value) { return 0.5 * value.lower + 0.5 * value.upper; }

/// The bars of all quantities on one scale.
class Tornado {
 public:
  Tornado(const AllVariedAlone& all, const Limit& limit, bool isAbove) : all_(all), limit_(limit), isAbove_(isAbove) {
    Range range;
    range.hold(limit.value);
    for (const VariedAlone& one : all.quantities) {
      range.hold(one.low());
      range.hold(one.high());
    }
    range_ = range.padded(0.06);
  }

  /// From the value at the quantity's least to that at its greatest, which is filled.
  std::string bar(const VariedAlone& one, const std::string& label) const {
    std::string svg = opened(barHigh, label);
    const double nominal = across(middleOf(all_.nominal));
    const auto half = [&](const ProvedValue& end, const char* kind) {
      const double to = across(middleOf(end));
      svg += fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"4\" width=\"{:.1f}\" height=\"{}\"/>\n", kind,
                         std::min(nominal, to), std::abs(to - nominal), barHigh - 8);
    };
    half(one.atLeast, "at-least");
    half(one.atGreatest, "at-greatest");
    return svg + fmt::format(
                     "<path class=\"nominal\" d=\"M{0:.1f} 0V{1}\"/>\n<path class=\"zero\" d=\"M{2:.1f} 0V{1}\"/>\n"
                     "</svg>",
                     nominal, barHigh, across(limit_.value));
  }

  std::string ruler(const std::string& unit) const {
    std::string svg =
        fmt::format("<svg class=\"drawing margin\" viewBox=\"0 0 {} {}\" aria-hidden=\"true\">\n", barsWide, rulerHigh);
    const Ticks ticks = ticksOf(range_, 5);
    for (std::size_t i = 0; i < ticks.at.size(); ++i) {
      const double half = 3.2 * static_cast<double>(ticks.text[i].size());
      drawText("tick middle", std::clamp(across(ticks.at[i]), half, barsWide - half), 12, ticks.text[i], svg);
    }
    drawText("axis end", barsWide, rulerHigh - 4, axisName(unit, ticks), svg);
    return svg + "</svg>";
  }

 private:
  double across(double value) const { return barsWide * (value - range_.low) / (range_.high - range_.low); }

  /// With a ground where the limit is missed.
  std::string opened(double height, const std::string& label) const {
    const double limit = across(limit_.value);
    return fmt::format(
        "<svg class=\"drawing margin\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"{2}\">\n"
        "<rect class=\"missed\" x=\"{3:.1f}\" y=\"0\" width=\"{4:.1f}\" height=\"{1}\"/>\n",
        barsWide, height, escapeHtml(label), isAbove_ ? 0.0 : limit, isAbove_ ? limit : barsWide - limit);
  }

  const AllVariedAlone& all_;
  const Limit& limit_;
  bool isAbove_;
  Range range_;
};

std::string textOf(const ProvedValue& value, double widest) {
  const auto [lower, upper] = boundsText(value.lower, value.upper, 0, 3, widest);
  return lower == upper ? lower : lower + " to " + upper;
}

/// "is 1.234 m", one number, where hardly anything is open; else between which it lies, and whose doing that is.
std::string nominalText(const Results& results, const ProvedValue& nominal, double effect, const std::string& unit) {
  constexpr double little = 0.05;  // of what quantities do
  if (nominal.upper - nominal.lower <= little * effect) return "is " + inUnit(numberText(middleOf(nominal), 5), unit);
  std::vector<std::string> varying;
  for (const UncertainInfo& quantity : results.uncertain)
    if (variesInTime(quantity)) varying.push_back(quantity.name);
  const auto [lower, upper] = outwardText(nominal.lower, nominal.upper, 4);
  return fmt::format("lies between {} and {}, as {},", lower, inUnit(upper, unit),
                     varying.empty() ? "closely as its bounds are proved"
                                     : fmt::format("{} may vary in time", fmt::join(varying, ", ")));
}

/// "± 1.2 % would do", "not alone"; empty where neither is proved.
std::string doingAlone(const UncertainInfo& quantity, const RequirementResult& requirement, std::size_t number) {
  if (number >= requirement.aloneLower.size()) return {};
  if (const double factor = requirement.aloneLower[number]; factor > 0)
    return narrowedText(quantity, factor) + " would do";
  return requirement.aloneUpper[number] == 0 ? "not alone" : "";
}

}  // namespace

std::string whatToDo(const Results& results, const RequirementResult& requirement, std::size_t margin, std::size_t row,
                     bool isOpen) {
  const std::vector<Limit> limits = limitsOf(results);
  const auto limit = std::ranges::find(limits, margin, &Limit::margin);
  if (limit == limits.end() || results.uncertain.size() < 2) return {};
  AllVariedAlone all = variedAlone(results, limit->output, row);
  const auto effect = [&](const VariedAlone& one) {
    const double nominal = middleOf(all.nominal);
    return std::max(std::abs(middleOf(one.atLeast) - nominal), std::abs(middleOf(one.atGreatest) - nominal));
  };
  std::ranges::stable_sort(all.quantities, std::greater<>(), effect);
  constexpr std::size_t most = 8;
  constexpr double visible = 0.005;  // of the greatest
  const double greatest = all.quantities.empty() ? 0 : effect(all.quantities.front());
  if (!(greatest > 0) || !isDrawn(greatest) || !isDrawn(limit->value)) return {};
  std::erase_if(all.quantities, [&](const VariedAlone& one) { return effect(one) < visible * greatest; });
  const std::size_t left = all.quantities.size() - std::min(most, all.quantities.size());
  all.quantities.resize(all.quantities.size() - left);
  const MarginInfo& info = *std::ranges::find(results.margins, margin, &MarginInfo::output);
  const OutputInfo& output = results.outputs[limit->output];
  const Tornado tornado(all, *limit, info.isAbove);
  const std::string when = results.horizon > 0 ? " at " + timeText(results.time[all.row]) : std::string();
  std::string rows;
  for (const VariedAlone& one : all.quantities) {
    const UncertainInfo& quantity = results.uncertain[one.quantity];
    const Told told(quantity);
    const auto [from, to] = told.of(quantity.lower, quantity.upper);
    const std::string least = textOf(one.atLeast, greatest), most0 = textOf(one.atGreatest, greatest),
                      values = inUnit(fmt::format("{} to {}", numberText(from, 5), numberText(to, 5)), told.unit()),
                      label = fmt::format("Plot of {}{} where {} alone goes from {}: {} to {}", output.name, when,
                                          quantity.name, values, least, most0);
    rows +=
        fmt::format("<li><span>{}<small>{}</small></span><div>{}<small>{}, {}</small></div><b>{}</b><b>{}</b></li>\n",
                    escapeHtml(quantity.name), escapeHtml(values), tornado.bar(one, label), least, most0,
                    shareOfSpread(results, limit->output, one.quantity, results.time[all.row]),
                    escapeHtml(doingAlone(quantity, requirement, one.quantity)));
  }
  return fmt::format(
      "<details class=\"causes\"{}><summary>What to do: whose tolerance matters</summary>\n"
      "<p class=\"hint\">\u201c{}\u201d{} {} with nominal values. Each bar: one quantity alone goes from the least "
      "(outline) "
      "to the greatest (filled) of its values; numbers below are proved. Right: its share in the spread{}.</p>\n"
      "<ol class=\"tornado\">\n{}<li "
      "class=\"ruler\"><span></span><div>{}</div><b></b><b></b></li>\n</ol>{}</details>\n",
      isOpen ? " open" : "", escapeHtml(output.name), when,
      escapeHtml(nominalText(results, all.nominal, greatest, output.unit)),
      requirement.aloneLower.empty() ? ""
                                     : ", and the tolerance with which the requirement is proved to be met though all "
                                       "others stay as they are (\u201cnot alone\u201d: no tolerance does that)",
      rows, tornado.ruler(output.unit == "1" ? "" : output.unit),
      left == 0 ? "" : fmt::format("<p class=\"hint\">{} more matter less.</p>", left));
}

}  // namespace gamut
