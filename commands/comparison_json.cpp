// Numbers are the shortest decimals that give the same double back; what is not finite, or not known, is null.
#include "commands/comparison_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace gamut {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json textOrNull(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }
Json numbers(const Both<double>& both) { return Json::array({number(both.first), number(both.second)}); }
template <class T>
Json list(const Both<T>& both) {
  return Json::array({Json(both.first), Json(both.second)});
}

Json ratioObject(const WidthRatio& ratio) {
  if (std::isnan(ratio.greatest)) return nullptr;
  return {{"least", number(ratio.least)},
          {"least_time", ratio.leastTime},
          {"greatest", number(ratio.greatest)},
          {"greatest_time", ratio.greatestTime}};
}

Json questionObject(const Relation& relation) {
  return {{"same", relation.isSameQuestion()},
          {"same_text", relation.isSameText},
          {"same_motion", relation.isSameMotion},
          {"first_in_second", relation.isFirstInSecond},
          {"second_in_first", relation.isSecondInFirst},
          {"same_distributions", relation.hasSameDistributions},
          {"same_memberships", relation.hasSameMemberships},
          {"differences", relation.differences},
          {"why", textOrNull(relation.why)}};
}

Json contradictionObject(const Contradiction& c) {
  const bool isOfRequirement = c.of == Contradiction::Of::requirement;
  Json object{{"of", wordOf(c.of)}, {isOfRequirement ? "requirement" : "output", c.name}};
  object["proof"] = c.isProof;
  if (!c.detail.empty()) object[isOfRequirement ? "words" : "quantity"] = c.detail;
  if (isOfRequirement) return object;
  if (!std::isnan(c.at)) object[c.of == Contradiction::Of::alphaCut ? "alpha" : "value"] = c.at;
  object["times"] = c.times.size();
  object["time"] = c.time;
  object["distance"] = number(c.distance);
  object["first"] = Json::array({number(c.lower), number(c.upper)});
  object["second"] = Json::array({number(c.otherLower), number(c.otherUpper)});
  if (c.of == Contradiction::Of::sample) object["sampled"] = c.isSampleOfFirst ? "first" : "second";
  return object;
}

Json contradictionsArray(const std::vector<Contradiction>& found) {
  Json array = Json::array();
  for (const Contradiction& c : found) array.push_back(contradictionObject(c));
  return array;
}

Json excessObject(const Excess& excess) {
  Json object{{"of", wordOf(excess.of)}, {"name", textOrNull(excess.name)}};
  if (!excess.words.first.empty()) {
    object["words"] = list(excess.words);
    return object;
  }
  object["is"] = number(excess.is);
  object["allowed"] = excess.allowed;
  if (excess.of == Excess::Of::enclosure || excess.of == Excess::Of::alphaCuts || excess.of == Excess::Of::reached)
    object["time"] = excess.time;
  return object;
}

Json outputsObject(const Difference& difference) {
  Json object = Json::object();
  for (std::size_t k = 0; k < difference.changes.outputs.size(); ++k) {
    const OutputChange& output = difference.changes.outputs[k];
    object[output.name] = {{"unit", output.unit},
                           {"same", difference.relation.isSameOutput[k] != 0},
                           {"enclosure", ratioObject(output.enclosure)},
                           {"alpha_cuts", ratioObject(output.alphaCuts)},
                           {"overestimation", numbers(output.overestimation)},
                           {"gap", numbers(output.gap)}};
  }
  return object;
}

Json requirementsArray(const Changes& changes) {
  Json array = Json::array();
  for (const RequirementChange& r : changes.requirements)
    array.push_back({{"name", r.name},
                     {"same", r.isSameDemand},
                     {"guaranteed", list(r.word)},
                     {"met", list(r.met)},
                     {"factor", list(r.factor)},
                     {"lost", r.isLost}});
  return array;
}

}  // namespace

std::string comparisonJson(const Difference& difference, const Results& first, const Results& second,
                           const Both<std::string>& files) {
  const auto& [shared, relation, contradictions, changes, excesses, word] = difference;
  Json json;
  json["verdict"] = wordOf(word);
  json["files"] = list(files);
  json["versions"] = list(Both<std::string>{first.version, second.version});
  json["question"] = questionObject(relation);
  json["contradictions"] = contradictionsArray(contradictions.found);
  json["undecided"] = contradictionsArray(contradictions.undecided);
  json["worse"] = Json::array();
  for (const Excess& excess : excesses) json["worse"].push_back(excessObject(excess));
  json["times"] = shared.times.size();
  json["outputs"] = outputsObject(difference);
  json["requirements"] = requirementsArray(changes);
  json["verdicts"] = Json::array({textOrNull(changes.verdict.first), textOrNull(changes.verdict.second)});
  json["reached"] = Json::object();
  for (const AnswerChange& answer : changes.answers) json["reached"][answer.name] = list(answer.reached);
  json["gap"] = numbers(changes.gap);
  json["samples"] = list(changes.samples);
  json["cpu"] = numbers(changes.cpu);
  json["memory"] = numbers(changes.memory);
  json["only"] = {{"outputs", list(shared.otherOutputs)},
                  {"times", list(shared.otherTimes)},
                  {"answers", list(shared.otherAnswers)},
                  {"requirements", list(shared.otherRequirements)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace gamut
