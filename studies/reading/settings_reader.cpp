// Settings as the file has them: what is not there stays as it was.
#include "studies/reading/settings_reader.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "mechanics/description/written_units.hpp"
#include "studies/settings.hpp"

namespace gamut {
namespace {

class SettingsReader final : public Settings {
 public:
  SettingsReader(const TomlSection& section, bool isMotion)
      : source_(section.source()), section_(section), isMotion_(isMotion) {}

  void any(const Key& key) override { find(key); }

  void flag(const Key& key, bool& value, bool allowsAuto) override {
    if (const toml::node* node = find(key); node != nullptr && !(allowsAuto && isAuto(*node)))
      value = source_.asBool(*node, section_.nameOf(key.name));
  }

  void number(const Key& key, const NumberOf& of, double& value) override {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const std::string name = section_.nameOf(key.name);
    const double stated = of.scale * nearest(source_.asAmount(*node, name, dimensionOf(of.unit)));
    if (!of.allows(stated)) source_.fail(*node, fmt::format("{} {}", name, of.fault), of.expected);
    value = stated;
    if (of.written != nullptr) *of.written = unitOf(*node);
  }

  void integer(const Key& key, std::int64_t least, std::int64_t most, bool allowsAuto, std::int64_t& value) override {
    const toml::node* node = find(key);
    if (node == nullptr || (allowsAuto && isAuto(*node))) return;
    const std::string name = section_.nameOf(key.name);
    if (allowsAuto && !node->is_integer())
      source_.fail(*node, fmt::format("{} is neither a whole number nor \"auto\"", name),
                   fmt::format("\"auto\" or a whole number between {} and {}", least, most));
    value = source_.asInteger(*node, name, least, most);
  }

  void choice(const Key& key, const std::vector<std::string>& words,
              const std::function<void(const std::string&)>& take) override {
    if (const toml::node* node = find(key)) take(source_.asChoice(*node, section_.nameOf(key.name), words));
  }

  void text(const Key& key, std::string& value) override {
    if (const toml::node* node = find(key)) value = source_.asText(*node, section_.nameOf(key.name));
  }

  void texts(const Key& key, std::size_t least, std::size_t most, std::vector<std::string>& values) override {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const std::string name = section_.nameOf(key.name);
    values.clear();
    for (const toml::node& entry : source_.asArray(*node, name)) values.push_back(source_.asText(entry, name));
    if (values.size() < least || values.size() > most)
      source_.fail(*node, fmt::format("{} has {} entries", name, values.size()),
                   least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most));
  }

  void ranges(const Key& key, NamedRanges& ranges) override {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const std::string name = section_.nameOf(key.name);
    ranges.clear();
    for (const auto& [word, entry] : source_.asTable(*node, name)) {
      const std::string own = fmt::format("{}.{}", name, word.str());
      const toml::array& pair = source_.asArray(entry, own);
      if (pair.size() != 2) source_.fail(entry, fmt::format("{} has {} entries", own, pair.size()), "[lower, upper]");
      const std::string unit = unitOf(*pair.get(0));
      ranges[std::string(word.str())] = {source_.asAnyAmount(*pair.get(0), own), source_.asAnyAmount(*pair.get(1), own),
                                         unit.empty() ? unitOf(*pair.get(1)) : unit};
    }
  }

  void table(const Key& key, const std::function<void(Settings&)>& describe) override {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const std::string name = section_.nameOf(key.name);
    const TomlSection within(source_, source_.asTable(*node, name), name, keysOf(describe));
    SettingsReader reader(within, isMotion_);
    describe(reader);
  }

 private:
  static std::string unitOf(const toml::node& node) {
    return node.is_string() ? unitBehindNumber(node.as_string()->get()) : std::string();
  }
  static bool isAuto(const toml::node& node) { return node.is_string() && node.as_string()->get() == "auto"; }

  const toml::node* find(const Key& key) const {
    const toml::node* node = section_.find(key.name);
    if (node != nullptr && key.isOfMotion && !isMotion_)
      source_.fail(*node, fmt::format("{} has no meaning where no time passes", section_.nameOf(key.name)),
                   "no such key");
    return node;
  }

  const TomlSource& source_;
  const TomlSection& section_;
  bool isMotion_;
};

}  // namespace

TomlSection readSettings(const TomlSource& source, const toml::table& table, std::string_view name, Study& study) {
  const StudySection words = studySection(study, name);
  TomlSection section(source, table, words.name, keysOf([&](Settings& settings) { words.describe(settings, study); }));
  SettingsReader reader(section, study.moves());
  words.describe(reader, study);
  return section;
}

void readSettings(const TomlSection& section, const std::function<void(Settings&)>& describe) {
  SettingsReader reader(section, true);
  describe(reader);
}

}  // namespace gamut
