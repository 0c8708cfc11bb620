// A schema allows what the reader may: whether names exist and formulas make sense only the reader knows.
#include "studies/schema.hpp"

#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mechanics/description/words.hpp"
#include "studies/settings.hpp"

namespace gamut {
namespace {

using Json = nlohmann::ordered_json;

/// Markdown as an editor shows it.
std::string described(const std::string& meaning, const std::string& otherwise) {
  return otherwise.empty() ? meaning
                           : fmt::format("{}{}Otherwise: {}.", meaning, meaning.empty() ? "" : ". ", otherwise);
}

Json closedTable(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

class SchemaWriter final : public Settings {
 public:
  void any(const Key& key) override { add(key, Json::object()); }

  void flag(const Key& key, bool& /*value*/, bool allowsAuto) override {
    add(key, orAuto({{"type", "boolean"}}, allowsAuto));
  }
  void number(const Key& key, const NumberOf& of, double& /*value*/) override {
    Json bare = {{"type", "number"}};
    if (std::isfinite(of.least)) bare[of.isAbove ? "exclusiveMinimum" : "minimum"] = of.least / of.scale;
    if (of.most < std::numeric_limits<double>::max()) bare["maximum"] = of.most / of.scale;
    add(key, {{"anyOf", Json::array({bare, Json{{"type", "string"}}})}});  // "64 MB", "5 %"
  }
  void integer(const Key& key, std::int64_t least, std::int64_t most, bool allowsAuto,
               std::int64_t& /*value*/) override {
    add(key, orAuto({{"type", "integer"}, {"minimum", least}, {"maximum", most}}, allowsAuto));
  }
  void choice(const Key& key, const std::vector<std::string>& words,
              const std::function<void(const std::string&)>& /*take*/) override {
    add(key, {{"enum", words}});
  }
  void table(const Key& key, const std::function<void(Settings&)>& describe) override {
    SchemaWriter within;
    describe(within);
    add(key, within.schema());
  }
  void own(const Key& key, const char* schema) override { add(key, Json::parse(schema)); }

  Json schema() const {
    Json closed = closedTable(properties_);
    if (!required_.empty()) closed["required"] = required_;
    return closed;
  }

 private:
  static Json orAuto(const Json& schema, bool allowsAuto) {
    return allowsAuto ? Json{{"anyOf", Json::array({schema, Json{{"const", "auto"}}})}} : schema;
  }

  void add(const Key& key, Json schema) {
    const bool isRequired = key.otherwise == "required";
    schema["description"] = described(key.meaning, isRequired ? "" : key.otherwise);
    properties_[key.name] = std::move(schema);
    if (isRequired) required_.push_back(key.name);
  }

  Json properties_ = Json::object(), required_ = Json::array();
};

/// The keys of one type of element, beside those that all have.
Json elementSchema(const Described& type) {
  const ElementWords turning = wordsOf(type), sliding = wordsOf(type, Coordinate::displacement);
  Json properties = {{"type", Json{{"const", type.type()}}},
                     {"name", Json{{"type", "string"}}},
                     {"parameters", Json{{"type", "object"}}}};
  Json initial = Json::object(), required = Json::array({"type", "name"});
  for (std::size_t i = 0; i < turning.keys.size(); ++i) {
    const auto& [word, isInitial, example] = turning.keys[i];
    const std::string other = sliding.keys[i].word.unit;
    const std::string unit = word.unit == other ? word.unit : word.unit + " or " + other;
    const std::string meaning =
        word.meaning + (unit.empty() ? "" : fmt::format("{}[{}]", word.meaning.empty() ? "" : " ", unit));
    (isInitial ? initial : properties)[word.key] = {{"description", meaning}};
    if (word.isRequired && !isInitial) required.push_back(word.key);
  }
  if (!initial.empty()) properties["initial"] = closedTable(std::move(initial));
  Json schema = closedTable(std::move(properties));
  schema["required"] = required;
  return schema;
}

Json mechanismSchema(const std::vector<Described>& types) {
  Json names = Json::array(), each = Json::array();
  for (const Described& type : types) {
    names.push_back(type.type());
    const Json isOfType = {{"properties", {{"type", {{"const", type.type()}}}}}, {"required", {"type"}}};
    each.push_back({{"if", isOfType}, {"then", elementSchema(type)}});
  }
  const Json vector = {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}}, table = {{"type", "object"}},
             flag = {{"type", "boolean"}};
  Json properties = {
      {"gravity", vector},
      {"base_acceleration", vector},
      {"parameters", table},
      {"urdf", {{"type", "string"}, {"description", "a robot's description (URDF), from the study's folder"}}},
      {"base", {{"enum", {"fixed", "free"}}}},
      {"damping", flag},
      {"friction", flag},
      {"mimic", flag},
      {"initial", table},
      {"element",
       {{"type", "array"},
        {"items",
         {{"type", "object"},
          {"properties", {{"type", {{"enum", names}, {"description", "what it is"}}}}},
          {"required", {"type", "name"}},
          {"allOf", each}}}}}};
  return closedTable(std::move(properties));
}

}  // namespace

std::string studySchema(const std::vector<Described>& types) {
  Json properties = {{"mechanism", mechanismSchema(types)}}, required = Json::array({"mechanism"});
  Study study;
  for (const StudySection& section : studySections()) {
    SchemaWriter writer;
    section.describe(writer, study);
    Json schema = section.isList ? Json{{"type", "array"}, {"items", writer.schema()}} : writer.schema();
    schema["description"] = section.meaning;
    properties[section.name] = std::move(schema);
    if (section.isRequired) required.push_back(section.name);
  }
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "A study of Gamut"}};
  schema.update(closedTable(std::move(properties)));
  schema["required"] = std::move(required);
  const Json number = {{"type", {"number", "string"}}};
  schema["definitions"] = {
      {"number", number},
      {"pair", {{"type", "array"}, {"items", {{"$ref", "#/definitions/number"}}}, {"minItems", 2}, {"maxItems", 2}}}};
  return schema.dump(1) + "\n";
}

}  // namespace gamut
