#include "studies/reading/sweep_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "mechanics/description/names.hpp"
#include "studies/reading/settings_reader.hpp"
#include "studies/settings.hpp"

namespace gamut {
namespace {

/// Settings that are numbers, with their units.
class NumberSettings final : public Settings {
 public:
  struct Found {
    std::string name;
    std::optional<std::string> unit;  ///< none where only its reader knows it
  };

  explicit NumberSettings(const Study& study) {
    for (const StudySection& section : studySections(study)) {
      if (section.isList) continue;
      Study empty;
      prefix_ = section.name + ".";
      section.describe(*this, empty);
    }
  }

  void number(const Key& key, const NumberOf& of, double& /*value*/) override { add(key, of.unit); }
  void integer(const Key& key, std::int64_t /*least*/, std::int64_t /*most*/, bool /*allowsAuto*/,
               std::int64_t& /*value*/) override {
    add(key, "");
  }
  void table(const Key& key, const std::function<void(Settings&)>& describe) override {
    const std::string outer = prefix_;
    prefix_ += key.name + ".";
    describe(*this);
    prefix_ = outer;
  }
  void own(const Key& key, const char* schema) override {
    if (std::string_view(schema).starts_with(R"({"type": ["number", "string"])")) add(key, {});
  }

  const Found* find(const std::string& name) const {
    const auto found = std::ranges::find(all_, name, &Found::name);
    return found == all_.end() ? nullptr : &*found;
  }
  const std::vector<Found>& all() const { return all_; }

 private:
  void add(const Key& key, const std::optional<std::string>& unit) { all_.push_back({prefix_ + key.name, unit}); }

  std::string prefix_;
  std::vector<Found> all_;
};

const NumberSettings& numberSettings() {
  static const NumberSettings settings{Study()};
  return settings;
}

/// That of an uncertain quantity that is called so; else the name itself.
std::string quantityCalled(const TomlSource& source, const std::string& name) {
  if (const toml::array* tables = source.root()["uncertain"].as_array())
    for (const toml::node& each : *tables)
      if (const toml::table* table = each.as_table())
        if ((*table)["name"].value<std::string>() == name)
          return (*table)["quantity"].value<std::string>().value_or(name);
  return name;
}

const toml::node* nodeAt(const TomlSource& source, std::string_view path) {
  const toml::node* node = &source.root();
  while (node != nullptr && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const toml::table* table = node->as_table();
    node = table == nullptr ? nullptr : table->get(path.substr(0, dot));
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return node;
}

bool isNumberNode(const toml::node& node) { return node.is_number() || node.is_string(); }

std::string settingCalled(const std::string& name) {
  return numberSettings().find("study." + name) != nullptr ? "study." + name : name;
}

std::vector<std::string> namesThatAreStated(const StatedPlaces& stated) {
  std::vector<std::string> names;
  for (const auto& [name, node] : stated.places)
    if (isNumberNode(*node) && stated.mechanism.mayBeUncertain(name)) names.push_back(name);
  for (const NumberSettings::Found& setting : numberSettings().all())
    if (nodeAt(stated.source, setting.name) != nullptr) names.push_back(setting.name);
  return names;
}

}  // namespace

const toml::node& StatedPlaces::of(const std::string& name) const {
  const std::string quantity = quantityCalled(source, name);
  if (const auto place = places.find(quantity); place != places.end() && isNumberNode(*place->second)) {
    const toml::node& node = *place->second;
    if (node.is_string())
      if (const Expression formula = source.asExpression(node, quantity, true); !formula.isConstant())
        throw Refusal(fmt::format("'{}' follows from a formula", quantity),
                      fmt::format("one of the quantities in it: {}", fmt::join(formula.names(), ", ")));
    return node;
  }
  if (mechanism.mayBeUncertain(quantity))
    throw Refusal(fmt::format("the study does not state the number '{}'", quantity),
                  "a number that stands in the study file, in whose place others can be put");
  const std::string setting = settingCalled(name);
  if (numberSettings().find(setting) != nullptr) {
    const toml::node* node = nodeAt(source, setting);
    if (node != nullptr && isNumberNode(*node)) return *node;
    const std::size_t dot = setting.rfind('.');
    throw Refusal(fmt::format("the study does not state the number '{}'", setting),
                  fmt::format("a line '{} = ...' in [{}], in whose place others can be put", setting.substr(dot + 1),
                              setting.substr(0, dot)));
  }
  const UnknownName unknown("number", name, namesThatAreStated(*this));
  throw Refusal(unknown.problem(), unknown.expected());
}

std::optional<std::string> StatedPlaces::unitOf(const std::string& name) const {
  const std::string quantity = quantityCalled(source, name), setting = settingCalled(name);
  if (mechanism.mayBeUncertain(quantity)) return mechanism.unitOf(quantity);
  if (const NumberSettings::Found* found = numberSettings().find(setting))
    if (found->unit) return found->unit;
  if (setting == "study.horizon" || setting == "study.output_step") return "s";
  return {};
}

void StatedPlaces::check(const SweepAxis& axis) const {
  of(axis.name);
  const std::optional<std::string> unit = unitOf(axis.name);
  if (!unit || axis.unit.empty() || isCompatible(dimensionOf(axis.unit), dimensionOf(*unit))) return;
  const bool hasNone = unit->empty() || *unit == "1";
  throw Refusal(fmt::format("'{}' is in {}, not in {}", axis.name, hasNone ? "1" : *unit, axis.unit),
                hasNone ? "numbers without a unit" : "numbers in " + *unit);
}

namespace {

/// As parseAmount takes it.
std::string amountText(const TomlSource& source, const toml::node& node, const std::string& what) {
  return node.is_string() ? source.asText(node, what) : fmt::format("{}", nearest(source.asAnyAmount(node, what)));
}

SweepAxis axisIn(const TomlSection& section, const std::string& name) {
  const TomlSource& source = section.source();
  const toml::node *values = section.find("values"), *from = section.find("from"), *to = section.find("to");
  if ((values == nullptr) == (from == nullptr && to == nullptr && section.find("count") == nullptr))
    source.fail(section.table(), "a sweep has either sweep.values or sweep.from, sweep.to and sweep.count",
                "values = [0.9, 1, 1.1], or from = 0.9, to = 1.1 and count = 21");
  if (values != nullptr) {
    std::vector<std::string> texts;
    for (const toml::node& each : source.asArray(*values, "sweep.values"))
      texts.push_back(amountText(source, each, "sweep.values"));
    return sweepAxis(name, texts, false);
  }
  const std::int64_t count =
      source.asInteger(section.require("count", "how many values"), "sweep.count", 1, mostSweepPoints);
  return evenSweepAxis(name, amountText(source, section.require("from", "the first value"), "sweep.from"),
                       amountText(source, section.require("to", "the last value"), "sweep.to"),
                       static_cast<std::size_t>(count), false);
}

}  // namespace

SweepPlan readSweep(const StatedPlaces& stated, const std::vector<const toml::table*>& tables) {
  const TomlSource& source = stated.source;
  SweepPlan plan;
  for (const toml::table* table : tables) {
    Study study;
    const TomlSection section = readSettings(source, *table, "sweep", study);
    const toml::node& quantity = section.require("quantity", "the number that is varied, such as \"rod.length\"");
    try {
      plan.axes.push_back(axisIn(section, source.asText(quantity, "sweep.quantity")));
      stated.check(plan.axes.back());
      check(plan);
    } catch (const Refusal& refused) {
      source.fail(quantity, refused.problem(), refused.expected());
    }
  }
  return plan;
}

std::vector<const toml::table*> tablesIn(const TomlSource& source, std::string_view name) {
  std::vector<const toml::table*> result;
  const toml::node* node = source.root().get(name);
  if (node == nullptr) return result;
  const std::string word(name);
  if (!node->is_array()) source.fail(*node, fmt::format("{} is no list of tables", word), fmt::format("[[{}]]", word));
  for (const toml::node& entry : *node->as_array()) result.push_back(&source.asTable(entry, word));
  if (result.empty()) source.fail(*node, word + " is empty", fmt::format("a table [[{}]]", word));
  return result;
}

}  // namespace gamut
