// A TOML file with positions: every complaint says file:line:column, and a number is read from the characters that the
// user wrote, so that 9.81 is the decimal and not the double nearest to it.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mechanics/description/expression.hpp"
#include "studies/reading/json_text.hpp"
#include "studies/study.hpp"

namespace gamut {

/// The known name that is meant by a word that is none: what others call so, or the nearest; empty: none.
std::string meantName(const std::string& word, const std::vector<std::string>& known);

/// The text of one TOML file and its parsed tree; or of JSON, as the same in TOML, whose places are those in the JSON.
class TomlSource {
 public:
  /// `name` is what messages call the file, `kind` what it should be. Throws StudyError for text that is neither.
  TomlSource(std::string text, std::string name, const std::string& kind = "a study file (TOML)");

  const toml::table& root() const { return root_; }
  const std::string& name() const { return name_; }
  /// In which files lie that it names.
  std::filesystem::path folder() const { return std::filesystem::path(name_).parent_path(); }

  /// What is named in the file, and meant where it is written in a formula also where a unit is written so (mayBeName):
  /// parameters anywhere, states in expressions of motion.
  struct Names {
    std::set<std::string, std::less<>> parameters, states;
  };
  void setNames(Names names) { names_ = std::move(names); }
  /// The first of these names in an expression of motion; empty if there is none. Throws UnitError.
  std::string nameIn(std::string_view formula) const;

  /// Throws StudyError "file:line:column: what; expected …".
  [[noreturn]] void fail(const toml::source_position& at, const std::string& what, const std::string& expected) const;
  [[noreturn]] void fail(const toml::node& at, const std::string& what, const std::string& expected) const {
    fail(at.source().begin, what, expected);
  }

  /// The text with other values, as TOML has them, in the places of some.
  std::string with(std::vector<std::pair<const toml::node*, std::string>> values) const;

  /// "file:line:column"
  std::string placeOf(const toml::node& at) const { return placeOf(at.source().begin); }

  /// "file:line:column: note: text", for what is no error.
  std::string note(const toml::node& at, const std::string& text) const;

  /// As fail, for a sentence with which another room refused what stands at `at`.
  [[noreturn]] void failWith(const toml::node& at, const std::string& sentence, const std::string& expected) const;

  // What a node holds; `what` names it in messages, e.g. "horizon" or "mechanism.element.name".
  std::string asText(const toml::node& node, const std::string& what) const;
  bool asBool(const toml::node& node, const std::string& what) const;
  std::int64_t asInteger(const toml::node& node, const std::string& what, std::int64_t least, std::int64_t most) const;
  const toml::table& asTable(const toml::node& node, const std::string& what,
                             const std::string& expected = "a table") const;
  const toml::array& asArray(const toml::node& node, const std::string& what) const;
  /// A number in SI units or a string with a unit of the dimension, which messages call `unit` if that is not empty.
  Amount asAmount(const toml::node& node, const std::string& what, const Dimension& dimension,
                  const std::string& unit = "") const;
  /// A number or string whose dimension is not checked.
  Amount asAnyAmount(const toml::node& node, const std::string& what) const;
  /// As asAmount and asAnyAmount, for `text` that was found at `node`.
  Amount readAmount(const toml::node& node, const std::string& what, const std::string& text,
                    const Dimension& dimension, const std::string& unit = "") const;
  Expression asExpression(const toml::node& node, const std::string& what, bool isOfMotion = false) const;
  Amount readAnyAmount(const toml::node& node, const std::string& what, const std::string& text) const;
  /// One of the words; a near miss is named.
  std::string asChoice(const toml::node& node, const std::string& what, const std::vector<std::string>& choices) const;

 private:
  /// Throws StudyError for a key of so many parts that the tables within tables would exhaust the stack.
  void checkKeys() const;
  /// The last character of the text in quotes that begins there.
  std::size_t endOfText(std::size_t begin) const;
  /// From 0.
  std::size_t lineOf(std::size_t place) const;
  /// "file:line:column"
  std::string placeOf(const toml::source_position& at) const;
  std::size_t placeAt(const toml::source_position& at) const;
  std::string tokenAt(const toml::source_position& at) const;
  Amount checked(const toml::node& node, const std::string& what, Amount amount, const Dimension& dimension,
                 const std::string& unit) const;

  std::string text_, name_;
  std::optional<TomlOfJson> json_;  ///< of JSON, where its parts stand
  std::vector<std::size_t> lineStarts_;
  Names names_;
  toml::table root_;
};

/// A table whose keys are known: others are refused, with the nearest known one.
class TomlSection {
 public:
  /// `name` as in messages, e.g. "study" or "mechanism.element"; empty for the file itself.
  TomlSection(const TomlSource& source, const toml::table& table, std::string name, std::vector<std::string> known);

  const TomlSource& source() const { return *source_; }
  const toml::table& table() const { return *table_; }
  const toml::node* find(std::string_view key) const { return table_->get(key); }
  /// Throws StudyError at the table's head if the key is missing.
  const toml::node& require(std::string_view key, const std::string& expected) const;
  /// "study.title" for the key "title".
  std::string nameOf(std::string_view key) const;

  std::string text(std::string_view key) const;
  std::string text(std::string_view key, const std::string& otherwise) const;
  std::int64_t integer(std::string_view key, std::int64_t otherwise, std::int64_t least, std::int64_t most) const;
  /// A dimensionless positive number, nearest double.
  double positive(std::string_view key, double otherwise) const;

 private:
  const TomlSource* source_;
  const toml::table* table_;
  std::string name_;
};

}  // namespace gamut
