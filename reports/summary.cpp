// The JSON object and the table.
#include "reports/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/text_table.hpp"
#include "scalars/interval.hpp"
#include "studies/results/extremes.hpp"
#include "studies/results/instants.hpp"
#include "studies/results/verdict.hpp"
#include "studies/told.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// {output name → {time → [lower, upper]}}; times without bounds are left out.
Json boundsObject(const Bounds& bounds, const Results& results) {
  Json object = Json::object();
  for (std::size_t j = 0; j < results.outputs.size(); ++j) {
    Json& ofOutput = object[results.outputs[j].name] = Json::object();
    if (bounds.empty()) continue;
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      const double lower = bounds.lower(i, j), upper = bounds.upper(i, j);
      if (!std::isnan(lower) && !std::isnan(upper))
        ofOutput[fmt::format("{}", results.time[i])] = Json::array({number(lower), number(upper)});
    }
  }
  return object;
}

Json overestimationObject(const Results& results) {
  const ComparisonResult& comparison = results.comparison;
  Json outputs = Json::object();
  for (std::size_t j = 0; j < results.outputs.size(); ++j)
    outputs[results.outputs[j].name] =
        j < comparison.maximumOf.size() ? number(comparison.maximumOf[j]) : Json(nullptr);
  return {{"max", number(comparison.maximum)}, {"median", number(comparison.median)}, {"outputs", outputs}};
}

Json textOrNull(const std::string& text);

/// Of what is only sampled; null where nothing needs it.
Json estimateObject(const RequirementEstimate& estimate) {
  if (estimate.samples == 0) return nullptr;
  return {{"samples", estimate.samples},
          {"met", estimate.met},
          {"violated", estimate.violated},
          {"confidence", Json::array({number(estimate.lower), number(estimate.upper)})},
          {"first_order", number(estimate.firstOrder)}};
}

Json requirementsArray(const Results& results) {
  Json array = Json::array();
  for (const RequirementResult& r : results.requirements) {
    Json violation = nullptr;
    for (std::size_t q = 0; q < r.violation.size(); ++q)
      if (!std::isnan(r.violation[q])) violation[results.uncertain[q].name] = r.violation[q];
    Json simulated = nullptr;
    if (r.isViolatedInSimulation)
      simulated = {{"sample", r.worstSample}, {"margin", r.worstMargin}, {"time", number(r.worstTime)}};
    array.push_back(
        {{"name", r.name},
         {"statement", r.statement},
         {"from", r.from},
         {"until", r.until},
         {"guaranteed", wordOf(r.word)},
         {"why", textOrNull(r.why)},
         {"advice", textOrNull(r.advice)},
         {"met_until", number(r.metUntil)},
         {"met", r.met},
         {"violated", r.violated},
         {"factor", r.factor},
         {"violation", violation},
         {"probability", Json::array({r.probabilityLower, r.probabilityUpper})},
         {"samples", r.samples},
         {"violating", r.violating},
         {"confidence", std::isnan(r.shareLower) ? Json(nullptr) : Json::array({r.shareLower, r.shareUpper})},
         {"estimate", estimateObject(r.estimate)},
         {"simulated_violation", simulated},
         {"worst_sample", r.worstSample < 0 ? Json(nullptr) : Json(r.worstSample)},
         {"violation_possibility", Json::array({r.violationLeast, r.violationMost})}});
  }
  return array;
}

/// Proved bounds of the value below which an output lies with probability p; null where an end is not known.
Json quantileOf(const DistributionResult& d, std::size_t begin, double p) {
  Json bounds = Json::array({nullptr, nullptr});
  for (std::size_t i = begin; i < begin + d.point.size() && !std::isnan(d.value[i]); ++i) {
    if (d.upper[i] < p) bounds[0] = d.value[i];
    if (d.lower[i] >= p && bounds[1].is_null()) bounds[1] = d.value[i];
  }
  return bounds;
}

Json distributionObject(const Results& results) {
  const DistributionResult& d = results.distribution;
  if (!d.present) return nullptr;
  Json outputs = Json::object();
  for (std::size_t k = 0; k < results.outputs.size(); ++k)
    for (std::size_t at = 0; at < d.time.size(); ++at) {
      const std::size_t cell = at * results.outputs.size() + k;
      if (d.gaps.empty() || std::isnan(d.gaps[cell])) continue;
      Json quantiles = Json::object();
      for (const double p : {0.01, 0.05, 0.5, 0.95, 0.99})
        quantiles[fmt::format("{}", p)] = quantileOf(d, d.begin(at, k, results.outputs.size()), p);
      outputs[results.outputs[k].name][fmt::format("{}", d.time[at])] = {
          {"gap", d.gaps[cell]}, {"excess", number(d.excess[cell])}, {"quantiles", quantiles}};
    }
  return {{"wanted", d.wanted},
          {"gap", d.gap},
          {"why", textOrNull(d.why)},
          {"band", d.band > 0 ? Json(d.band) : Json(nullptr)},
          {"cpu", d.cpu},
          {"outputs", outputs}};
}

/// A number, a text or a count.
Json valueOf(const FieldValue& value) {
  return std::visit(Visitor{[](double* x) { return number(*x); }, [](std::int64_t* x) { return Json(*x); },
                            [](std::uint64_t* x) { return Json(*x); }, [](bool* x) { return Json(*x); },
                            [](std::string* x) { return textOrNull(*x); }, [](Choice x) { return Json(x.word()); },
                            [](const auto&) { return Json(nullptr); }},
                    value);
}

/// What a part that describes itself says of each output, and of each quantity if it does, at the last time: of the
/// field's own times or of those up to which the part came.
class OutputNumbers {
 public:
  OutputNumbers(const Results& results, const FurtherPart& part) : results_(results), part_(part) {}

  /// Into {output name → [quantity →] `name` → number}, as entry `end` of two if it is one end of bounds; without a
  /// name into its place.
  void add(Json& outputs, const std::string& name, const Field& field, std::size_t times, int end = -1) const {
    const auto* values = std::get_if<std::vector<double>*>(&field.value);
    if (values != nullptr) add(outputs, name, field.dimensions, **values, times, end);
    if (const auto* table = std::get_if<Table*>(&field.value))
      add(outputs, name, field.dimensions, (*table)->data, times, end);
    if (const auto* bounds = std::get_if<Envelope*>(&field.value)) {
      add(outputs, name, field.dimensions, (*bounds)->lower.data, times, 0);
      add(outputs, name, field.dimensions, (*bounds)->upper.data, times, 1);
    }
  }

  /// How many of the study's times the part has reached.
  std::size_t reachedTimes() const {
    return static_cast<std::size_t>(std::ranges::upper_bound(results_.time, part_.reached) - results_.time.begin());
  }

 private:
  void add(Json& outputs, const std::string& name, const std::vector<std::string_view>& dimensions,
           const std::vector<double>& values, std::size_t times, int end) const {
    const bool isOfTime = dimensions.front() != dimension::output;
    const std::size_t k = isOfTime ? 1 : 0;
    if (dimensions.size() <= k || dimensions[k] != dimension::output || (isOfTime && times == 0)) return;
    const bool isOfQuantity = dimensions.size() == k + 2 && dimensions[k + 1] == dimension::quantity;
    if (dimensions.size() > k + (isOfQuantity ? 2 : 1)) return;
    const std::size_t quantities = isOfQuantity ? results_.uncertain.size() : 1, count = results_.outputs.size();
    for (std::size_t o = 0; o < count; ++o)
      for (std::size_t q = 0; q < quantities; ++q) {
        const std::size_t i = ((isOfTime ? times - 1 : 0) * count + o) * quantities + q;
        if (i >= values.size()) continue;
        Json* place = &outputs[results_.outputs[o].name];
        if (isOfQuantity) place = &(*place)[results_.uncertain[q].name];
        if (!name.empty()) place = &(*place)[name];
        if (end >= 0) place = &(*place)[static_cast<std::size_t>(end)];
        *place = number(values[i]);
      }
  }

  const Results& results_;
  const FurtherPart& part_;
};

/// Everything single that it says of itself, and the numbers of outputs at its last time; the file has all.
Json objectOf(const Results& results, const FurtherPart& part) {
  if (!part.present) return nullptr;
  Json object = Json::object(), outputs = Json::object();
  const OutputNumbers numbers(results, part);
  std::vector<Group> groups;
  const_cast<FurtherPart&>(part).describe(groups);  // resize, which alone changes anything, is not called
  for (const Group& group : groups) {
    if (group.isList() || group.size == 0) continue;
    std::size_t times = numbers.reachedTimes();
    for (const Field& field : group.fields(0)) {
      const std::string name(field.name);
      if (field.dimensions.empty()) {
        if (name != "stopped") object[name] = valueOf(field.value);
      } else if (isScale(group, field)) {
        const auto* own = std::get_if<std::vector<double>*>(&field.value);
        if (own == nullptr) continue;
        times = (*own)->size();
        object[name] = times == 0 ? Json(nullptr) : number((*own)->back());
      } else {
        const int end = name.ends_with("lower") ? 0 : name.ends_with("upper") ? 1 : -1;
        const std::size_t stem = end < 0 ? name.size() : name.size() - std::min<std::size_t>(name.size(), 6);
        numbers.add(outputs, name.substr(0, stem), field, times, end);
      }
    }
  }
  object["outputs"] = std::move(outputs);
  return object;
}

/// What the samples say at the last time that all reached, with 95 % confidence intervals: [lower, upper].
Json statisticsObject(const Results& results) {
  const StochasticResult& s = results.stochastic;
  if (!s.present || s.mean.empty()) return nullptr;
  const auto reached = std::ranges::upper_bound(results.time, s.reached) - results.time.begin();
  const auto row = static_cast<std::size_t>(std::max<std::ptrdiff_t>(reached, 1) - 1);
  const auto at = [&](const Table& table, std::size_t output) {
    return table.empty() ? std::numeric_limits<double>::quiet_NaN() : table(row, output);
  };
  const auto atLevel = [&](const std::vector<Table>& tables, std::size_t q, std::size_t output) {
    return at(tables.empty() ? Table() : tables[q], output);
  };
  Json outputs = Json::object();
  for (std::size_t k = 0; k < results.outputs.size(); ++k) {
    const auto put = [&](Json& object, const char* name, const Table& values, const Table& errors) {
      const double value = at(values, k), error = at(errors, k);
      object[name] = number(value);
      object[fmt::format("{}_interval", name)] = Json::array({number(value - error), number(value + error)});
    };
    Json& of = outputs[results.outputs[k].name];
    put(of, "mean", s.mean, s.meanError);
    put(of, "deviation", s.deviation, s.deviationError);
    of["quantiles"] = Json::object();
    for (std::size_t q = 0; q < s.probabilities.size(); ++q)
      of["quantiles"][fmt::format("{}", s.probabilities[q])] = {
          {"value", number(atLevel(s.quantiles, q, k))},
          {"interval", Json::array({number(atLevel(s.quantileLower, q, k)), number(atLevel(s.quantileUpper, q, k))})}};
  }
  Json failed = Json::array();
  for (const FailedSampleResult& f : s.failed)
    failed.push_back({{"number", f.number}, {"reached", f.reached}, {"why", f.why}});
  return {{"time", results.time[row]},
          {"covered", s.covered > 0 ? Json(s.covered) : Json(nullptr)},
          {"failures", s.failures},
          {"failed", failed},
          {"outputs", outputs}};
}

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

/// Of the times of distributions alone.
Json sensitivityObject(const Results& results) {
  const SensitivityResult& s = results.sensitivity;
  if (!s.present) return nullptr;
  Json outputs = Json::object();
  const std::size_t quantities = results.uncertain.size();
  for (std::size_t k = 0; k < results.outputs.size(); ++k)
    for (std::size_t at = 0; at < s.time.size(); ++at) {
      const std::size_t cell = at * results.outputs.size() + k;
      if (std::ranges::find(results.distribution.time, s.time[at]) == results.distribution.time.end() ||
          (std::isnan(s.meanLower[cell]) && s.why.empty()))
        continue;
      Json shares = Json::object();
      for (std::size_t q = 0; q < quantities; ++q) {
        const std::size_t i = cell * quantities + q;
        shares[results.uncertain[q].name] = {{"first", Json::array({number(s.firstLower[i]), number(s.firstUpper[i])})},
                                             {"total", Json::array({number(s.totalLower[i]), number(s.totalUpper[i])})},
                                             {"pinched", s.pinched.empty() ? Json(nullptr) : number(s.pinched[i])}};
        if (s.firstSampled.empty()) continue;
        Json& of = shares[results.uncertain[q].name];
        of["first_sampled"] = Json::array({number(s.firstSampled[i]), number(s.firstError[i])});
        of["total_sampled"] = Json::array({number(s.totalSampled[i]), number(s.totalError[i])});
      }
      outputs[results.outputs[k].name][fmt::format("{}", s.time[at])] = {
          {"mean", Json::array({number(s.meanLower[cell]), number(s.meanUpper[cell])})},
          {"deviation", Json::array({number(s.deviationLower[cell]), number(s.deviationUpper[cell])})},
          {"indices", shares}};
    }
  return outputs;
}

/// How much of the proved alpha-cuts samples leave.
Json transformationObject(const Results& results) {
  const TransformationResult& t = results.fuzzy.transformation;
  if (!t.present) return nullptr;
  Json stepped = t.stepped.empty() ? Json(nullptr) : Json::array(), gaps = Json::object();
  for (std::size_t q = 0; q < t.stepped.size(); ++q)
    if (t.stepped[q] != 0) stepped.push_back(results.uncertain[q].name);
  for (std::size_t k = 0; k < results.outputs.size(); ++k)
    for (std::size_t level = 0; level < results.fuzzy.alpha.size() && !t.gap.empty(); ++level)
      if (const std::size_t i = level * results.outputs.size() + k; !std::isnan(t.gap[i]))
        gaps[results.outputs[k].name][fmt::format("{}", results.fuzzy.alpha[level])] = {{"gap", t.gap[i]},
                                                                                        {"time", t.gapTime[i]}};
  return {{"method", t.method},
          {"points", results.stochastic.alphaPoints},
          {"stepped", std::move(stepped)},
          {"gaps", std::move(gaps)}};
}

/// The method, and the greatest gap of all outputs at all levels.
std::string transformationText(const Results& results) {
  const TransformationResult& t = results.fuzzy.transformation;
  if (!t.present) return {};
  std::size_t worst = t.gap.size();
  for (std::size_t i = 0; i < t.gap.size(); ++i)
    if (!std::isnan(t.gap[i]) && (worst == t.gap.size() || t.gap[i] > t.gap[worst])) worst = i;
  std::string text = fmt::format(
      "  alpha-cuts: samples by the {} transformation method{}", t.method,
      results.stochastic.alphaPoints > 0 ? ", " + countText(results.stochastic.alphaPoints, "point") + " inside" : "");
  if (worst == t.gap.size()) return text + "\n";
  const std::size_t outputs = results.outputs.size();
  if (isLittle(t.gap[worst], 1)) return text + "; they reach the ends of every proved cut\n";
  const std::string when = results.horizon > 0 ? fmt::format(", at {}", timeText(t.gapTime[worst])) : std::string();
  return text + fmt::format("; they leave {} % of the widest proved cut at most ({}, membership {}{})\n",
                            atMostText(100 * t.gap[worst], 2), results.outputs[worst % outputs].name,
                            numberText(results.fuzzy.alpha[worst / outputs], 3), when);
}

Json textOrNull(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

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

/// {output name → its unit, least and greatest, and when}.
Json rangesObject(const Results& results) {
  Json object = Json::object();
  for (std::size_t j = 0; j < results.outputs.size(); ++j) {
    Json& of = object[results.outputs[j].name] = {{"unit", results.outputs[j].unit}};
    for (const auto& [word, source] : {std::pair("guaranteed", MotionRange::Source::ofProof),
                                       std::pair("sampled", MotionRange::Source::ofSamples)}) {
      const std::optional<MotionRange> range = motionRange(results, j, source);
      of[word] = nullptr;
      if (!range) continue;
      const auto extreme = [](const Extreme& e) {
        return Json{{"value", number(e.value)}, {"from", e.from}, {"until", e.until}};
      };
      of[word] = {{"least", extreme(range->least)}, {"greatest", extreme(range->greatest)}, {"until", range->until}};
    }
  }
  return object;
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
                            [&](auto* values) {
                              if constexpr (requires { values->empty(); })
                                return values->empty() ? std::string() : shape;
                              return std::string();
                            }},
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
  const std::string distribution = shapeText(results, uncertain, "distribution"),
                    membership = shapeText(results, uncertain, "membership");
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
  for (std::size_t i = 0; i < d.gaps.size(); ++i) {
    if (isMargin(results, i % outputs) || !(d.gaps[i] < 1)) continue;
    gaps.push_back(d.gaps[i]);
    if (d.gaps[i] > greatest) widest = i, greatest = d.gaps[i];
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
  for (std::size_t i = 0; i < d.gaps.size(); ++i) {
    if (isMargin(results, i % outputs)) continue;
    if (d.gaps[i] < 1)
      ++known, gap = std::max(gap, d.gaps[i]);
    else if (!std::isnan(d.gaps[i]) || !isOneValue(results, d.time[i / outputs], i % outputs))
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

}  // namespace

std::string shapeText(const Results& results, const UncertainInfo& uncertain, const std::string& shape) {
  const std::string& name = shape == "distribution" ? uncertain.distribution : uncertain.membership;
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
      shape == "membership" && uncertain.inconsistency > least
          ? fmt::format("; events are more probable than possible by up to {}", atMostText(uncertain.inconsistency, 2))
          : "";
  return (numbers.empty() ? name : fmt::format("{} ({})", name, fmt::join(numbers, ", "))) + doubt;
}

std::string jsonSummary(const Results& results, const std::string& verdict, const ResultFiles& files) {
  Json json;
  json["verdict"] = textOrNull(verdict);
  json["horizon"] = number(results.horizon);
  json["reached"] = number(reachedTime(results));
  json["why"] = textOrNull(whyIncomplete(results, findVerdict(results)));
  json["stopped"] = textOrNull(results.stopped);
  json["samples"] = results.stochastic.samples;
  json["integrated"] = results.stochastic.integrated;
  json["excursion"] = number(results.comparison.excursion);
  json["overestimation"] = overestimationObject(results);
  json["dependence"] = textOrNull(results.dependence);
  json["tightness"] = number(results.interval.tightness);
  json["shortfall"] = textOrNull(results.interval.shortfall);
  json["advice"] = textOrNull(results.interval.advice);
  json["outputs"] = rangesObject(results);
  json["requirements"] = requirementsArray(results);
  json["statistics"] = statisticsObject(results);
  json["alpha_cuts"] = transformationObject(results);
  json["distribution"] = distributionObject(results);
  json["sensitivity"] = sensitivityObject(results);
  for (const Boxed<FurtherPart>& part : results.further) json[std::string(part->key())] = objectOf(results, *part);
  json["enclosure"] = boundsObject(results.interval.at, results);
  json["envelope"] = boundsObject(results.stochastic.envelope, results);
  Json& cost = json["cost"];
  for (const Answer* answer : results.answers()) cost[std::string(answer->word())] = number(answer->cpu);
  for (const char* what : {"equations", "requirements", "advice"}) {
    const auto found = std::ranges::find(results.costs, what, &CostInfo::what);
    if (found != results.costs.end())
      cost[what] = found->cpu;
    else
      cost[what] = results.costs.empty() ? Json(nullptr) : Json(0.0);
  }
  cost["report"] = number(files.reportCpu);
  cost["total"] = number(results.cpu);
  cost["memory"] = number(results.memory);
  const Limits& limits = results.limits;
  json["limits"] = {{"time", number(limits.time)},
                    {"memory", number(limits.memory)},
                    {"enclosure_time", number(limits.enclosureTime)},
                    {"enclosure_memory", number(limits.enclosureMemory)},
                    {"sample_time", number(limits.sampleTime)}};
  json["files"] = {{"results", textOrNull(files.results)}, {"report", textOrNull(files.report)}};
  json["version"] = results.version;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string textSummary(const Results& results) {
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
  std::string text = rangesText(results) + textTable(rows);
  std::vector<std::string> costs;
  bool isAnything = false;
  const auto spend = [&](const std::string& what, double cpu) {
    isAnything = true;
    if (cpu >= leastCpuTold) costs.push_back(fmt::format("{} {}", what, cpuText(cpu)));
  };
  for (const Part* part : results.parts())
    if (part->present) spend(part->title(), part->spent());
  for (const CostInfo& cost : results.costs) spend(cost.what, cost.cpu);
  if (!results.dependence.empty()) text += fmt::format("  quantities: {}\n", results.dependence);
  text += statisticsText(results);
  text += transformationText(results);
  if (results.distribution.present) text += probabilitiesText(results);
  for (const Boxed<FurtherPart>& part : results.further)
    if (part->present)
      text += fmt::format("  {}: {}{}{}\n", part->title(), part->verb(),
                          results.horizon > 0 ? " up to " + reachedText(part->reached) : "",
                          part->why.empty() ? "" : ": " + part->why);
  const std::string spent = spentText(results);
  if (!isAnything || (costs.empty() && spent.empty())) return text;
  return text +
         fmt::format("  CPU: {}{}{}\n", fmt::join(costs, ", "), costs.empty() || spent.empty() ? "" : "; ", spent);
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
