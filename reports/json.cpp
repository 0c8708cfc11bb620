// The JSON object: what analyses found, each part by its key.
#include "reports/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "studies/results/extremes.hpp"
#include "studies/results/instants.hpp"
#include "studies/results/verdict.hpp"

namespace gamut {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json textOrNull(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

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

/// The numbers of a field, and which end of bounds they are, 0 or 1; -1: neither.
std::vector<std::pair<std::span<const double>, int>> numbersOf(const Field& field) {
  const int end = field.name.ends_with("lower") ? 0 : field.name.ends_with("upper") ? 1 : -1;
  if (const auto* values = std::get_if<std::vector<double>*>(&field.value)) return {{**values, end}};
  if (const auto* table = std::get_if<Table*>(&field.value)) return {{(*table)->data, end}};
  if (const auto* bounds = std::get_if<Envelope*>(&field.value))
    return {{(*bounds)->lower.data, 0}, {(*bounds)->upper.data, 1}};
  return {};
}

/// So many times of each dimension of times, by its path.
using Reached = std::map<std::string, std::size_t, std::less<>>;

/// Adds what a field says of each output, and of each quantity if it does, at the last of its times: {output name →
/// [quantity →] name → number or [lower, upper]}; what is called "lower" or "upper" alone by the name `ofBounds`.
void addOutputs(Json& outputs, const Results& results, const Field& field, const Reached& reached,
                const std::string& ofBounds) {
  std::vector<std::string_view> dimensions = field.dimensions;
  const auto times = reached.find(dimensions.front());
  if (times != reached.end()) dimensions.erase(dimensions.begin());
  const bool isOfQuantity = dimensions.size() == 2 && dimensions[1] == dimension::quantity;
  if (dimensions.empty() || dimensions[0] != dimension::output || dimensions.size() != (isOfQuantity ? 2 : 1)) return;
  if (times != reached.end() && times->second == 0) return;
  const std::size_t quantities = isOfQuantity ? results.uncertain.size() : 1;
  const std::size_t count = results.outputs.size() * quantities;
  const std::size_t begin = times == reached.end() ? 0 : (times->second - 1) * count;
  for (const auto& [numbers, end] : numbersOf(field)) {
    std::string name(field.name);
    if (name.ends_with("lower") || name.ends_with("upper"))
      name.resize(name.size() - std::min<std::size_t>(6, name.size()));
    if (name.empty()) name = ofBounds;
    for (std::size_t i = 0; i < count && begin + i < numbers.size(); ++i) {
      Json* place = &outputs[results.outputs[i / quantities].name];
      if (isOfQuantity) place = &(*place)[results.uncertain[i % quantities].name];
      if (!name.empty()) place = &(*place)[name];
      if (end >= 0) place = &(*place)[static_cast<std::size_t>(end)];
      *place = number(numbers[begin + i]);
    }
  }
}

/// Everything single that it says of itself, and the numbers of outputs at its last time; the file has all.
Json objectOf(const Results& results, const FurtherPart& part) {
  if (!part.present) return nullptr;
  Json object = Json::object(), outputs = Json::object();
  Reached reached{
      {std::string(dimension::time),
       static_cast<std::size_t>(std::ranges::upper_bound(results.time, part.reached) - results.time.begin())}};
  std::vector<Group> groups;
  const_cast<FurtherPart&>(part).describe(groups);  // resize, which alone changes anything, is not called
  bool areBoundsAlone = true;                       // then they need no name
  for (const Group& group : groups)
    for (const Field& field : group.isList() || group.size == 0 ? std::vector<Field>() : group.fields(0))
      areBoundsAlone = areBoundsAlone && (field.dimensions.empty() || isScale(group, field) || field.name == "lower" ||
                                          field.name == "upper");
  for (const Group& group : groups)
    for (const Field& field : group.isList() || group.size == 0 ? std::vector<Field>() : group.fields(0)) {
      const std::string name(field.name);
      if (field.dimensions.empty()) {
        if (name != "stopped") object[name] = valueOf(field.value);
      } else if (!isScale(group, field)) {
        addOutputs(outputs, results, field, reached, areBoundsAlone ? "" : "bounds");
      } else if (const auto* times = std::get_if<std::vector<double>*>(&field.value)) {
        reached[pathOf(group, field)] = (*times)->size();
        object[name] = (*times)->empty() ? Json(nullptr) : number((*times)->back());
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
      const auto extreme = [](const MotionExtreme& e) {
        return Json{{"value", number(e.value)}, {"from", e.from}, {"until", e.until}};
      };
      of[word] = {{"least", extreme(range->least)}, {"greatest", extreme(range->greatest)}, {"until", range->until}};
    }
  }
  return object;
}

}  // namespace

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

}  // namespace gamut
