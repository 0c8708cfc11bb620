// A schema allows what the reader may: whether names exist and formulas make sense only the reader knows.
#include "studies/schema.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analyses/distribution.hpp"
#include "mechanics/description/fields.hpp"
#include "mechanics/description/words.hpp"
#include "scalars/membership.hpp"
#include "studies/settings.hpp"

namespace gamut {
namespace {

using Json = nlohmann::ordered_json;

/// Markdown as an editor shows it, where links of the guide lead nowhere.
std::string described(const std::string& guide, const std::string& otherwise) {
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
  const std::string meaning = std::regex_replace(guide, link, "$1");
  if (otherwise.empty()) return meaning;
  const bool isCondition = otherwise.find("required") != otherwise.npos || otherwise.starts_with("this or");
  return fmt::format("{}{}{}.", meaning, isCondition ? "; " : ". Otherwise: ", otherwise);
}

Json closedTable(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

/// A number, or a text with one and a unit.
Json numberSchema() { return {{"type", {"number", "string"}}}; }
Json pairSchema() { return {{"type", "array"}, {"items", numberSchema()}, {"minItems", 2}, {"maxItems", 2}}; }

class ShapeWriter final : public ShapeFields {
 public:
  explicit ShapeWriter(std::string_view type) : properties_{{"type", Json{{"const", type}}}} {}

  void support(Interval& /*support*/) override {
    properties_["support"] = pairSchema();
    properties_["support"]["description"] = "[lower, upper], inside the interval. Otherwise: the interval.";
  }
  void number(const ShapeWord& word, double& /*number*/) override { add(word, numberSchema(), !word.isNominal); }
  void parameter(const ShapeWord& word, Trend /*trend*/, Interval& /*number*/) override {
    add(word, {{"type", {"number", "string", "array"}}}, !word.isNominal);
  }
  void pair(const ShapeWord& word, const std::array<std::string, 2>& /*names*/, Interval& /*pair*/) override {
    array(word);
  }
  void points(const ShapeWord& word, std::vector<Point>& /*points*/) override { array(word); }
  void list(const ShapeWord& word, const std::string& /*expected*/, StatedNumbers& /*numbers*/,
            bool /*mayBeEmpty*/) override {
    array(word);
  }
  void intervals(const ShapeWord& word, const std::string& /*expected*/, StatedNumbers& /*intervals*/) override {
    array(word);
  }
  bool file(const std::vector<Column>& wanted, std::vector<StatedNumbers>& /*columns*/) override {
    properties_["file"] = {{"type", "string"}, {"description", "a CSV file instead"}};
    for (const Column& column : wanted)
      if (column.isNamedByKey)
        properties_[column.name] = {{"type", "string"}, {"description", "the name of its column"}};
    return false;
  }

  Json schema() const {
    Json closed = closedTable(properties_);
    closed["required"] = required_;
    return closed;
  }

 private:
  /// A file may stand for lists.
  void array(const ShapeWord& word) { add(word, {{"type", "array"}}, false); }
  void add(const ShapeWord& word, Json schema, bool isRequired) {
    schema["description"] = word.meaning + (word.isOfQuantity ? "" : ", without unit");
    properties_[word.key] = std::move(schema);
    if (isRequired) required_.push_back(word.key);
  }

  Json properties_, required_ = Json::array({"type"});
};

/// Tables whose type says what else they hold.
Json byType(const std::vector<std::pair<std::string, Json>>& types, const Json& required) {
  Json names = Json::array(), each = Json::array();
  for (const auto& [name, schema] : types) {
    names.push_back(name);
    each.push_back({{"if", {{"properties", {{"type", {{"const", name}}}}}, {"required", {"type"}}}}, {"then", schema}});
  }
  return {{"type", "object"},
          {"properties", {{"type", {{"enum", names}, {"description", "what it is"}}}}},
          {"required", required},
          {"allOf", each}};
}

/// Of distributions, or of memberships.
template <class Types>
Json shapeSchema(const Types& types) {
  std::vector<std::pair<std::string, Json>> all;
  for (const auto& make : types) {
    const auto law = make();
    ShapeWriter writer(law->name());
    law->describe(writer);
    all.emplace_back(law->name(), writer.schema());
  }
  all.emplace_back("induced", closedTable({{"type", Json::object()}}));
  return byType(all, Json::array({"type"}));
}

/// Plain types only: editors find neither keys nor meanings behind references and alternatives.
class SchemaWriter final : public Settings {
 public:
  /// `longer`: schemas by their words.
  explicit SchemaWriter(const Json& longer) : longer_(longer) {}

  void any(const Key& key) override { add(key, Json::object()); }

  void flag(const Key& key, bool& /*value*/, bool allowsAuto) override { add(key, orAuto("boolean", allowsAuto)); }
  void number(const Key& key, const NumberOf& of, double& /*value*/) override {
    Json schema = numberSchema();  // whose limits are those of numbers alone
    if (std::isfinite(of.least)) schema[of.isAbove ? "exclusiveMinimum" : "minimum"] = of.least / of.scale;
    if (of.most < std::numeric_limits<double>::max()) schema["maximum"] = of.most / of.scale;
    add(key, std::move(schema));
  }
  void integer(const Key& key, std::int64_t least, std::int64_t most, bool allowsAuto,
               std::int64_t& /*value*/) override {
    Json schema = orAuto("integer", allowsAuto);
    schema["minimum"] = least;
    schema["maximum"] = most;
    add(key, std::move(schema));
  }
  void choice(const Key& key, const std::vector<std::string>& words,
              const std::function<void(const std::string&)>& /*take*/) override {
    add(key, {{"enum", words}});
  }
  void text(const Key& key, std::string& /*value*/) override { add(key, {{"type", "string"}}); }
  void texts(const Key& key, std::size_t least, std::size_t most, std::vector<std::string>& /*values*/) override {
    add(key, {{"type", "array"}, {"items", {{"type", "string"}}}, {"minItems", least}, {"maxItems", most}});
  }
  void ranges(const Key& key, NamedRanges& /*ranges*/) override {
    add(key, {{"type", "object"}, {"additionalProperties", pairSchema()}});
  }
  void table(const Key& key, const std::function<void(Settings&)>& describe) override {
    SchemaWriter within(longer_);
    describe(within);
    add(key, within.schema());
  }
  void own(const Key& key, const char* schema) override {
    add(key, longer_.contains(schema) ? longer_[schema] : Json::parse(schema));
  }

  Json schema() const {
    Json closed = closedTable(properties_);
    if (!required_.empty()) closed["required"] = required_;
    return closed;
  }

 private:
  static Json orAuto(const char* type, bool allowsAuto) {
    return allowsAuto ? Json{{"type", {type, "string"}}, {"pattern", "^auto$"}} : Json{{"type", type}};
  }

  void add(const Key& key, Json schema) {
    const bool isRequired = key.otherwise == "required";
    if (!key.meaning.empty()) schema["description"] = described(key.meaning, isRequired ? "" : key.otherwise);
    properties_[key.name] = std::move(schema);
    if (isRequired) required_.push_back(key.name);
  }

  const Json& longer_;
  Json properties_ = Json::object(), required_ = Json::array();
};

Json listSchema(Json items, std::size_t least, std::size_t most) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", least}, {"maxItems", most}};
}

/// { axis, angle }, a list of these, { roll, pitch, yaw } or { quaternion }.
Json rotationSchema(const Json& direction) {
  const Json about = {{"axis", direction}, {"angle", numberSchema()}};
  Json items = closedTable(about), one = about;
  items["required"] = {"axis", "angle"};
  for (const char* name : rollPitchYawNames) one[name] = numberSchema();
  one["quaternion"] = listSchema(numberSchema(), 4, 4);
  Json schema = closedTable(std::move(one));
  schema["type"] = {"array", "object"};
  schema["items"] = std::move(items);
  return schema;
}

Json writtenSchema(const Written& written) {
  const Json name = {{"type", "string"}};
  const Json direction = {{"type", {"string", "array"}},
                          {"pattern", "^-?[xyz]$"},
                          {"items", numberSchema()},
                          {"minItems", 3},
                          {"maxItems", 3}};
  switch (written.kind) {
    case Written::Kind::name:
      return name;
    case Written::Kind::word:
      return {{"enum", written.words}};
    case Written::Kind::direction:
      return direction;
    case Written::Kind::rotation:
      return rotationSchema(direction);
    case Written::Kind::whole:
      return {{"type", "integer"}, {"minimum", written.least}, {"maximum", written.most}};
    case Written::Kind::number:
      return numberSchema();
    case Written::Kind::numbers:
      return listSchema(numberSchema(), written.least, written.most);
    case Written::Kind::points:
      return {{"type", "array"}, {"items", listSchema(numberSchema(), 3, 3)}, {"minItems", 1}};
    case Written::Kind::names:
      return {{"type", "array"}, {"items", name}, {"minItems", 1}};
  }
  return Json::object();
}

/// The keys of one type of element, beside those that all have.
Json elementSchema(const Described& type) {
  const ElementWords turning = wordsOf(type), sliding = wordsOf(type, Coordinate::displacement);
  Json properties = {{"type", Json{{"const", type.type()}}},
                     {"name", Json{{"type", "string"}}},
                     {"parameters", Json{{"type", "object"}}}};
  Json initial = Json::object(), required = Json::array({"type", "name"});
  for (std::size_t i = 0; i < turning.keys.size(); ++i) {
    const auto& [word, written, isInitial, example] = turning.keys[i];
    const std::string other = sliding.keys[i].word.unit;
    const std::string unit = word.unit == other ? word.unit : word.unit + " or " + other;
    const std::string meaning =
        word.meaning + (unit.empty() ? "" : fmt::format("{}[{}]", word.meaning.empty() ? "" : " ", unit));
    Json& schema = (isInitial ? initial : properties)[word.key] = writtenSchema(written);
    schema["description"] = meaning;
    if (word.isRequired && !isInitial) required.push_back(word.key);
  }
  if (!initial.empty()) properties["initial"] = closedTable(std::move(initial));
  Json schema = closedTable(std::move(properties));
  schema["required"] = required;
  return schema;
}

Json elementsSchema(const std::vector<Described>& types) {
  std::vector<std::pair<std::string, Json>> elements;
  for (const Described& type : types) elements.emplace_back(type.type(), elementSchema(type));
  return {{"type", "array"}, {"items", byType(elements, Json::array({"type", "name"}))}};
}

}  // namespace

std::string studySchema(const std::vector<Described>& types) {
  const Json longer = {{"distribution", shapeSchema(distributionTypes())},
                       {"membership", shapeSchema(membershipTypes())},
                       {"elements", elementsSchema(types)}};
  SchemaWriter mechanism(longer);
  RobotChoices robot;
  describeMechanism(mechanism, true, robot);
  Json properties = {{"mechanism", mechanism.schema()}}, required = Json::array({"mechanism"});
  properties["mechanism"]["description"] = "what moves: elements, in the order of their assembly";
  Study study;
  for (const StudySection& section : studySections(study)) {
    SchemaWriter writer(longer);
    section.describe(writer, study);
    Json schema = section.isList ? Json{{"type", "array"}, {"items", writer.schema()}} : writer.schema();
    schema["description"] = section.meaning;
    properties[section.name] = std::move(schema);
    if (section.isRequired) required.push_back(section.name);
  }
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "A study of Gamut"}};
  schema.update(closedTable(std::move(properties)));
  schema["required"] = std::move(required);
  return schema.dump(1) + "\n";
}

}  // namespace gamut
