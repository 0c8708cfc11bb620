// The JSON object: what analyses found, each part by its key.
#include "reports/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reports/approaches.hpp"
#include "studies/results/extremes.hpp"
#include "studies/results/instants.hpp"

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

/// A number, a text or a count.
Json valueOf(const FieldValue& value) {
  return std::visit(Visitor{[](double* x) { return number(*x); }, [](std::int64_t* x) { return Json(*x); },
                            [](std::uint64_t* x) { return Json(*x); }, [](bool* x) { return Json(*x); },
                            [](std::string* x) { return textOrNull(*x); }, [](Choice x) { return Json(x.word()); },
                            [](const auto&) { return Json(nullptr); }},
                    value);
}

/// The keys to a field, by its name or that which both ends of bounds have; empty of what is told nowhere.
std::string keysOf(const Group& group, const Field& field) {
  std::string_view name = field.name == "lower" ? "bounds_lower" : field.name == "upper" ? "bounds_upper" : field.name;
  if (const auto found = group.inJson.find(field.name); found != group.inJson.end()) return std::string(found->second);
  if (name == "stopped") return {};  // that is said of the run
  const std::string end = name.ends_with("_lower") ? "/0" : name.ends_with("_upper") ? "/1" : "";
  if (!end.empty()) name.remove_suffix(6);
  const auto found = group.inJson.find(name);
  return std::string(end.empty() || found == group.inJson.end() ? name : found->second) + end;
}

/// Where the keys lead to; '*' is the label.
Json& placeOf(Json& object, std::string_view keys, const std::string& label = "") {
  const std::string key(keys.substr(0, keys.find('/')));
  if (keys.empty()) return object;
  Json& place = key == "0"   ? object[std::size_t{0}]
                : key == "1" ? object[std::size_t{1}]
                             : object[key == "*" ? label : key];
  return placeOf(place, keys.substr(std::min(keys.size(), key.size() + 1)), label);
}

/// Whether its places are told by name: outputs, quantities and times.
bool hasLabels(std::string_view dimension) {
  return dimension == dimension::output || dimension == dimension::quantity || dimension.ends_with("/time");
}

/// An array of arrays, the first dimension outside.
Json arrayOf(std::span<const double> numbers, std::span<const std::size_t> shape) {
  if (shape.empty()) return numbers.empty() ? Json(nullptr) : number(numbers.front());
  Json array = Json::array();
  const std::size_t each = shape.front() == 0 ? 0 : numbers.size() / shape.front();
  for (std::size_t i = 0; each > 0 && i < shape.front(); ++i)
    array.push_back(arrayOf(numbers.subspan(i * each, each), shape.subspan(1)));
  return array;
}

/// What records of the results say, as they describe themselves.
class Teller {
 public:
  /// Whether what is said of an output, at a place in the first dimension, is told.
  using IsTold = std::function<bool(std::size_t, std::size_t)>;

  explicit Teller(const Results& results)
      : results_(results), groups_(describe(results)), extents_(extentsOf(groups_)) {
    for (const Group& group : groups_)
      for (const Field& field : group.isList() || group.size == 0 ? std::vector<Field>() : group.fields(0))
        if (const auto* scale = std::get_if<Numbers>(&field.value); scale && isScale(group, field))
          scales_[pathOf(group, field)] = scale->lists().front();
  }

  /// All that is single, and numbers of outputs: by time where it is said which are told, otherwise at the last one.
  Json record(std::string_view path, const IsTold& isTold = {}, std::size_t i = 0) const {
    const Group& group = *std::ranges::find(groups_, path, &Group::path);
    Json object = Json::object(), outputs = Json::object();
    double reached = 0;
    for (const Field& field : group.fields(i)) {
      if (field.name == "reached") reached = *std::get<double*>(field.value);
      if (const std::string keys = keysOf(group, field); keys.empty())
        continue;
      else if (group.isList() || !isScale(group, field))
        tell(object, outputs, field, keys, reached, isTold);
      else if (const auto scale = scales_.find(pathOf(group, field)); scale != scales_.end() && !isTold)
        object[keys] = scale->second->empty() ? Json(nullptr) : number(scale->second->back());
    }
    if (!group.isList()) object["outputs"] = std::move(outputs);
    return object;
  }

  Json list(std::string_view path) const {
    Json array = Json::array();
    for (std::size_t i = 0; i < std::ranges::find(groups_, path, &Group::path)->size; ++i)
      array.push_back(record(path, {}, i));
    return array;
  }

  /// How many output times lie up to this one (s); the first always.
  std::size_t timesUntil(double reached) const {
    const auto end = std::ranges::upper_bound(results_.time, reached);
    return std::max<std::size_t>(static_cast<std::size_t>(end - results_.time.begin()), 1);
  }

 private:
  void tell(Json& object, Json& outputs, const Field& field, const std::string& keys, double reached,
            const IsTold& isTold) const {
    const std::vector<std::string_view>& dimensions = field.dimensions;
    if (dimensions.empty()) placeOf(object, keys) = valueOf(field.value);
    const std::vector<std::size_t> shape = shapeOf(dimensions, extents_);
    const std::size_t count = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
    const bool hasNoLabels = !dimensions.empty() && std::ranges::none_of(dimensions, hasLabels);
    if (auto* const* whole = std::get_if<std::vector<std::int64_t>*>(&field.value); whole != nullptr && hasNoLabels)
      placeOf(object, keys) = **whole;
    const auto* numbers = std::get_if<Numbers>(&field.value);
    std::vector<double> room;
    for (std::size_t end = 0; numbers != nullptr && end < numbers->ends().size(); ++end) {
      const std::span<const double> all = numbers->all(end, room);
      const std::string last = numbers->ends().size() == 1 ? "" : end == 0 ? "/0" : "/1";
      if (hasNoLabels) {
        placeOf(object, keys + last) = arrayOf(all, shape);
        continue;
      }
      for (std::size_t i = 0; i < count; ++i) {
        std::size_t rest = i, at = 0, output = 0;
        const std::string* quantity = nullptr;
        const double *time = nullptr, *other = nullptr;
        bool isLast = true, isOfOutput = false;
        for (std::size_t d = shape.size(); d-- > 0; rest /= shape[d]) {
          at = rest % shape[d];
          if (dimensions[d] == dimension::output) {
            isOfOutput = true;
            output = at;
          } else if (dimensions[d] == dimension::quantity) {
            quantity = &results_.uncertain[at].name;
          } else if (dimensions[d].ends_with("/time")) {
            isLast = at + 1 == (dimensions[d] == dimension::time ? timesUntil(reached) : shape[d]);
            time = &scales_.find(dimensions[d])->second->at(at);
          } else {
            other = &scales_.find(dimensions[d])->second->at(at);
          }
        }
        if (!(isTold ? isTold(at, output) : isLast)) continue;
        Json* place = isOfOutput ? &outputs[results_.outputs[output].name] : &object;
        if (isTold && time != nullptr) place = &(*place)[fmt::format("{}", *time)];
        const std::string label = quantity != nullptr ? *quantity : other != nullptr ? fmt::format("{}", *other) : "";
        placeOf(*place, keys + last, label) = i < all.size() ? number(all[i]) : Json(nullptr);
      }
    }
  }

  const Results& results_;
  const std::vector<Group> groups_;
  const Extents extents_;
  std::map<std::string, const std::vector<double>*, std::less<>> scales_;
};

Json requirementsArray(const Results& results, const Teller& teller) {
  Json array = teller.list("/requirements");
  for (std::size_t i = 0; i < array.size(); ++i) {
    const RequirementResult& r = results.requirements[i];
    Json &of = array[i], violation = nullptr;
    for (const auto& [quantity, value] : of["violation"].items())
      if (!value.is_null()) violation[quantity] = value;
    of["violation"] = violation;
    if (std::isnan(r.shareLower)) of["confidence"] = nullptr;
    if (r.estimate.samples == 0) of["estimate"] = nullptr;
    if (r.worstSample < 0) of["worst_sample"] = nullptr;
    of["simulated_violation"]["sample"] = r.worstSample;
    if (!r.isViolatedInSimulation) of["simulated_violation"] = nullptr;
  }
  return array;
}

/// Proved bounds of the value below which an output lies with probability p; null where an end is not known.
Json quantileOf(const DistributionResult& d, std::size_t at, std::size_t output, double p) {
  Json bounds = Json::array({nullptr, nullptr});
  for (std::size_t i = 0; const double value : d.values(at, output)) {
    if (d.upper(at, output, i) < p) bounds[0] = value;
    if (d.lower(at, output, i++) >= p && bounds[1].is_null()) bounds[1] = value;
  }
  return bounds;
}

Json distributionObject(const Results& results, const Teller& teller) {
  const DistributionResult& d = results.distribution;
  if (!d.present) return nullptr;
  const auto isKnown = [&](std::size_t at, std::size_t k) { return !d.gaps.empty() && !std::isnan(d.gaps(at, k)); };
  Json object = teller.record("/distribution", isKnown);
  for (std::size_t at = 0; at < d.time.size(); ++at)
    for (std::size_t k = 0; k < results.outputs.size(); ++k)
      for (const double p : {0.01, 0.05, 0.5, 0.95, 0.99})
        if (isKnown(at, k))
          object["outputs"][results.outputs[k].name][fmt::format("{}", d.time[at])]["quantiles"][fmt::format("{}", p)] =
              quantileOf(d, at, k, p);
  if (!(d.band > 0)) object["band"] = nullptr;
  return object;
}

/// What the samples say at the last time that all reached, with 95 % confidence intervals: [lower, upper].
Json statisticsObject(const Results& results, const Teller& teller) {
  const StochasticResult& s = results.stochastic;
  if (!s.present || s.mean.empty()) return nullptr;
  Json outputs = std::move(teller.record("/stochastic")["outputs"]);
  for (Json& of : outputs)
    for (const std::string name : {"mean", "deviation"}) {
      const Json value = of[name], error = of[name + "_error"];
      const bool isKnown = value.is_number() && error.is_number();
      of[name + "_interval"] = isKnown ? Json::array({number(value.get<double>() - error.get<double>()),
                                                      number(value.get<double>() + error.get<double>())})
                                       : Json::array({nullptr, nullptr});
      of.erase(name + "_error");
      of.emplace("quantiles", Json::object());
    }
  return {{"time", results.time[teller.timesUntil(s.reached) - 1]},
          {"covered", s.covered > 0 ? Json(s.covered) : Json(nullptr)},
          {"failures", s.failures},
          {"failed", teller.list("/stochastic/failed")},
          {"outputs", std::move(outputs)}};
}

/// Of the times of distributions alone.
Json sensitivityObject(const Results& results, const Teller& teller) {
  const SensitivityResult& s = results.sensitivity;
  if (!s.present) return nullptr;
  const std::vector<double>& times = results.distribution.time;
  Json outputs = std::move(teller.record("/sensitivity", [&](std::size_t at, std::size_t k) {
    return std::ranges::find(times, s.time[at]) != times.end() && !(std::isnan(s.mean.lower(at, k)) && s.why.empty());
  })["outputs"]);
  for (Json& ofOutput : outputs)
    for (Json& of : ofOutput) {
      of.emplace("indices", Json::object());
      for (Json& ofQuantity : of["indices"])
        for (const char* sampled : {"first_sampled", "total_sampled"})
          if (s.firstSampled.empty()) ofQuantity.erase(sampled);
    }
  return outputs;
}

/// How much of the proved alpha-cuts samples leave.
Json transformationObject(const Results& results, const Teller& teller) {
  const TransformationResult& t = results.fuzzy.transformation;
  if (!t.present) return nullptr;
  Json object = teller.record("/fuzzy/transformation", [&](std::size_t level, std::size_t k) {
    return !t.gap.empty() && !std::isnan(t.gap(level, k));
  });
  object["gaps"] = std::move(object["outputs"]);
  object.erase("outputs");
  object["points"] = results.stochastic.alphaPoints;
  Json& stepped = object["stepped"] = t.stepped.empty() ? Json(nullptr) : Json::array();
  for (std::size_t q = 0; q < t.stepped.size(); ++q)
    if (t.stepped[q] != 0) stepped.push_back(results.uncertain[q].name);
  return object;
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

/// How near two shapes come, when and where; of what is known.
Json approachesArray(const Results& results) {
  const auto range = [](const Approach::Range& r) { return Json::array({number(r.lower), number(r.upper)}); };
  Json array = Json::array();
  for (const Approach& a : approachesOf(results)) {
    Json& one = array.emplace_back();
    one["output"] = results.outputs[a.output].name;
    one["least"] = range(a.least);
    one["until"] = a.until;
    one["times"] = Json::array();
    for (const Approach::Range& span : a.when) one["times"].push_back(range(span));
    for (const auto& [word, place] : {std::pair("from", &a.from), std::pair("to", &a.to)}) {
      one[word] = Json::array();
      for (const std::optional<Approach::Range>& component : *place)
        one[word].push_back(component ? range(*component) : Json(nullptr));
    }
  }
  return array;
}

}  // namespace

std::string jsonSummary(const Results& results, const Finding& finding, const ResultFiles& files) {
  const Teller teller(results);
  Json json;
  json["verdict"] = results.comparison.present ? Json(wordOf(finding.word)) : Json(nullptr);
  json["horizon"] = number(results.horizon);
  json["reached"] = number(reachedTime(results));
  json["why"] = textOrNull(whyIncomplete(results, finding));
  json["stopped"] = textOrNull(results.stopped);
  json["samples"] = results.stochastic.samples;
  json["integrated"] = results.stochastic.integrated;
  json["excursion"] = number(results.comparison.excursion);
  json["overestimation"] = overestimationObject(results);
  json["dependence"] = textOrNull(results.dependence);
  json["assembly"] = textOrNull(results.assembly);
  json["assumptions"] = textOrNull(results.assumptions);
  json["tightness"] = number(results.interval.tightness);
  json["shortfall"] = textOrNull(results.interval.shortfall);
  json["advice"] = textOrNull(results.interval.advice);
  json["outputs"] = rangesObject(results);
  json["approaches"] = approachesArray(results);
  json["requirements"] = requirementsArray(results, teller);
  json["statistics"] = statisticsObject(results, teller);
  json["alpha_cuts"] = transformationObject(results, teller);
  json["distribution"] = distributionObject(results, teller);
  json["sensitivity"] = sensitivityObject(results, teller);
  for (const Boxed<FurtherPart>& part : results.further) {
    const std::string key(part->key());
    json[key] = part->present ? teller.record("/" + key) : Json(nullptr);
  }
  json["enclosure"] = boundsObject(results.interval.at, results);
  json["envelope"] = boundsObject(results.stochastic.envelope, results);
  Json& cost = json["cost"];
  for (const Answer* answer : results.answers()) cost[std::string(answer->word())] = number(answer->cpu);
  for (const char* what : {"equations", "requirements", "advice"}) {
    const auto found = std::ranges::find(results.costs, what, &CostInfo::what);
    cost[what] = found != results.costs.end() ? Json(found->cpu) : results.costs.empty() ? Json(nullptr) : Json(0.0);
  }
  if (results.requirements.present) {
    Json& of = cost["requirements"];
    of = results.requirements.cpu + (of.is_null() ? 0.0 : of.get<double>());
  }
  cost["distribution"] = number(results.distribution.cpu);
  for (const Boxed<FurtherPart>& part : results.further) cost[std::string(part->key())] = number(part->cpu);
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
