// All formulas of a study are looked through as they are written.
#include "studies/reading/frequency_notes.hpp"

#include <fmt/format.h>

#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <string_view>

#include "mechanics/description/written_units.hpp"

namespace gamut {
namespace {

class Frequencies {
 public:
  Frequencies(const TomlSource& source, const Mechanism& mechanism) : source_(source), mechanism_(mechanism) {}

  std::vector<std::string> notes() {
    const auto isInHertz = [](const std::string& text) {
      const std::string unit = unitBehindNumber(text);
      return unit.ends_with("Hz") && unitNamed(unit) != nullptr;
    };
    if (const toml::table* parameters = source_.root()["mechanism"]["parameters"].as_table())
      for (const auto& [key, value] : *parameters)
        if (value.is_string() && isInHertz(**value.as_string())) stated_[std::string(key.str())] = &value;
    for (const char* key : {"mechanism", "output", "requirement"})
      if (const toml::node* node = source_.root().get(key)) look(*node);
    return std::move(notes_);
  }

 private:
  void look(const toml::node& node) {
    if (const toml::table* table = node.as_table()) {
      if (const toml::node* position = table->get("position");
          position != nullptr && position->is_string() && isOfAngle(*table))
        lookAt(*position, **position->as_string());
      for (const auto& [key, value] : *table) look(value);
    } else if (const toml::array* array = node.as_array()) {
      for (const toml::node& entry : *array) look(entry);
    } else if (node.is_string()) {
      for (const std::string& angle : argumentsIn(**node.as_string())) lookAt(node, angle);
    }
  }

  bool isOfAngle(const toml::table& element) const {
    const auto joint = element["joint"].value<std::string>();
    return joint && mechanism_.coordinateWith(*joint + ".angle") != nullptr;
  }

  /// Of sine, cosine and tangent.
  static std::vector<std::string> argumentsIn(const std::string& formula) {
    static const std::regex call(R"(\b(sin|cos|tan)\s*\()");
    std::vector<std::string> arguments;
    for (std::sregex_iterator found(formula.begin(), formula.end(), call), none; found != none; ++found) {
      const auto begin = static_cast<std::size_t>(found->position() + found->length());
      std::size_t end = begin;
      for (int depth = 1; end < formula.size(); ++end)
        if ((depth += formula[end] == '(' ? 1 : formula[end] == ')' ? -1 : 0) == 0) break;
      arguments.push_back(formula.substr(begin, end - begin));
    }
    return arguments;
  }

  static bool holds(const std::string& text, std::string_view name) {
    const auto isOfWord = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '\'';
    };
    for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      if ((at == 0 || !isOfWord(text[at - 1])) && (end == text.size() || !isOfWord(text[end]))) return true;
    }
    return false;
  }

  void lookAt(const toml::node& node, const std::string& angle) {
    static const std::regex number(R"([0-9]\.?\s*[kMG]?Hz\b)");
    if (!holds(angle, "t") || holds(angle, "pi")) return;
    if (std::regex_search(angle, number)) note(node, "a number", angle);
    for (const auto& [name, place] : stated_)
      if (holds(angle, name) && said_.insert(name).second) note(*place, "'" + name + "'", angle);
  }

  void note(const toml::node& place, const std::string& what, const std::string& angle) {
    notes_.push_back(
        source_.note(place, fmt::format("{} in Hz stands beside t in an angle, \"{}\", where 1 Hz is 1 rad/s; "
                                        "so many turns a second are 2*pi as much, or in rpm",
                                        what, angle)));
  }

  const TomlSource& source_;
  const Mechanism& mechanism_;
  std::map<std::string, const toml::node*> stated_;  // parameters in Hz
  std::set<std::string> said_;
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> notesOnFrequencies(const TomlSource& source, const Mechanism& mechanism) {
  return Frequencies(source, mechanism).notes();
}

}  // namespace gamut
