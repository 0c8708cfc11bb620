// Positions, messages and numbers of a TOML file.
#include "studies/reading/toml_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "mechanics/description/names.hpp"
#include "studies/printable.hpp"

namespace gamut {
namespace {

/// In the user's words.
std::string describe(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return fmt::format("\"{}\"", node.as_string()->get());
    case toml::node_type::integer:
      return fmt::format("the number {}", node.as_integer()->get());
    case toml::node_type::floating_point:
      return fmt::format("the number {}", node.as_floating_point()->get());
    case toml::node_type::boolean:
      return node.as_boolean()->get() ? "true" : "false";
    default:
      return "a date or time";
  }
}

/// One line: what a parser says may hold line breaks.
std::string oneLine(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return line;
}

/// What a file may be meant to hold of which the parser says this, with this text from there on.
std::string validInstead(const std::string& what, std::string_view rest) {
  const auto says = [&](std::string_view words) { return what.find(words) != std::string::npos; };
  if (says("cannot redefine existing") && says("as array-of-tables"))
    return "double brackets, as in [[output]], of every such table, the first too";
  if (says("cannot redefine existing array")) return "double brackets, as in [[output]], of every such table";
  if (says("unescaped control characters") && (rest.starts_with('\n') || rest.starts_with("\r\n")))
    return "texts that end in a quote on their line";
  if (says("saw ','")) return "a point before decimals, and commas in lists alone";
  return "a file that follows https://toml.io, texts and numbers with units in quotes";
}

/// What others call things, and what they are called here.
constexpr std::pair<std::string_view, std::string_view> otherWords[] = {{"tolerance", "interval"},
                                                                        {"range", "interval"},
                                                                        {"duration", "horizon"},
                                                                        {"end", "horizon"},
                                                                        {"sigma", "deviation"},
                                                                        {"std", "deviation"},
                                                                        {"stddev", "deviation"},
                                                                        {"standard_deviation", "deviation"},
                                                                        {"mu", "mean"},
                                                                        {"gauss", "normal"},
                                                                        {"gauss", "gaussian"},
                                                                        {"gaussian", "normal"},
                                                                        {"rectangular", "uniform"},
                                                                        {"triangle", "triangular"},
                                                                        {"limit", "always"},
                                                                        {"max", "always"},
                                                                        {"slider", "prismatic"},
                                                                        {"hinge", "revolute"},
                                                                        {"pin", "revolute"},
                                                                        {"ball", "spherical"},
                                                                        {"spring", "spring-damper"},
                                                                        {"damper", "spring-damper"},
                                                                        {"contact", "plane-contact"},
                                                                        {"ground", "plane-contact"},
                                                                        {"mu", "friction"},
                                                                        {"rod", "link"},
                                                                        {"body", "mass"},
                                                                        {"k", "stiffness"},
                                                                        {"c", "damping"},
                                                                        {"d", "damping"},
                                                                        {"position", "displacement"},
                                                                        {"velocity", "rate"},
                                                                        {"speed", "rate"}};

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string nearest = meantName(word, known);
  return nearest.empty() ? fmt::format("one of: {}", fmt::join(known, ", "))
                         : fmt::format("'{}'? (one of: {})", nearest, fmt::join(known, ", "));
}

}  // namespace

std::string meantName(const std::string& word, const std::vector<std::string>& known) {
  for (const auto& [other, own] : otherWords)
    if (other == word && std::ranges::find(known, own) != known.end()) return std::string(own);
  return nearestName(word, known);
}

TomlSource::TomlSource(std::string text, std::string name, const std::string& kind)
    : text_(std::move(text)), name_(std::move(name)), lineStarts_{0} {
  if (text_.find('\0') != std::string::npos) throw StudyError(name_, "is no text", kind);
  if (looksLikeJson(text_)) {
    json_ = tomlOfJson(text_);
    const auto& [line, column] = json_->faultAt;
    if (!json_->fault.empty())
      throw StudyError(fmt::format("{}:{}:{}", name_, line, column), json_->fault, json_->expected);
    text_ = std::exchange(json_->text, {});
  }
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') lineStarts_.push_back(i + 1);
  checkKeys();
  try {
    root_ = toml::parse(std::string_view(text_));
  } catch (const toml::parse_error& error) {
    const std::string what = oneLine(error.description());
    const toml::source_position at = error.source().begin;
    const std::string rest = at.line > 0 && at.line <= lineStarts_.size() ? text_.substr(placeAt(at)) : "";
    fail(at, (json_ ? "no study: " : "not valid TOML: ") + what, validInstead(what, rest));
  }
}

void TomlSource::checkKeys() const {
  constexpr int mostParts = 16;
  int parts = 0;
  for (std::size_t i = 0; i < text_.size(); ++i) {
    const char c = text_[i];
    if (c == '#') {
      i = std::min(text_.find('\n', i), text_.size()) - 1;
    } else if (c == '"' || c == '\'') {
      i = endOfText(i);
    } else if (c == '.') {
      if (++parts < mostParts) continue;
      const std::size_t line = lineOf(i);
      fail({static_cast<toml::source_index>(line + 1), static_cast<toml::source_index>(i - lineStarts_[line] + 1)},
           fmt::format("a key of more than {} parts", mostParts), "a key of the study file");
    } else if (std::string_view("=,{}[]\n").find(c) != std::string_view::npos) {
      parts = 0;
    }
  }
}

std::size_t TomlSource::endOfText(std::size_t begin) const {
  const std::string mark(text_.compare(begin, 3, std::string(3, text_[begin])) == 0 ? 3 : 1, text_[begin]);
  for (std::size_t i = begin + mark.size(); i < text_.size(); ++i) {
    if (text_[i] == '\\' && mark[0] == '"') {
      ++i;
    } else if (text_.compare(i, mark.size(), mark) == 0) {
      return i + mark.size() - 1;
    } else if (text_[i] == '\n' && mark.size() == 1) {
      return i - 1;  // unfinished: the parser will say so
    }
  }
  return text_.size();
}

std::size_t TomlSource::lineOf(std::size_t place) const {
  return static_cast<std::size_t>(std::upper_bound(lineStarts_.begin(), lineStarts_.end(), place) -
                                  lineStarts_.begin()) -
         1;
}

std::string TomlSource::placeOf(const toml::source_position& at) const {
  TextPlace place{std::max<unsigned>(at.line, 1), std::max<unsigned>(at.column, 1)};
  if (json_) place = json_->inJson(place);
  return fmt::format("{}:{}:{}", name_, place.line, place.column);
}

void TomlSource::fail(const toml::source_position& at, const std::string& what, const std::string& expected) const {
  throw StudyError(placeOf(at), what, expected);
}

std::string TomlSource::note(const toml::node& at, const std::string& text) const {
  return printable(fmt::format("{}: note: {}", placeOf(at.source().begin), shortened(text, 1000)));
}

void TomlSource::failWith(const toml::node& at, const std::string& sentence, const std::string& expected) const {
  fail(at, withoutSemicolons(sentence), expected);
}

std::string TomlSource::asText(const toml::node& node, const std::string& what) const {
  if (!node.is_string()) fail(node, fmt::format("{} is {}", what, describe(node)), "text in quotes");
  const std::string& text = node.as_string()->get();
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) fail(node, what + " is empty", "text");
  if (hasControlCharacters(text))
    fail(node, fmt::format("{} is {}", what, describe(node)), "text without control characters");
  return text;
}

bool TomlSource::asBool(const toml::node& node, const std::string& what) const {
  if (!node.is_boolean()) fail(node, fmt::format("{} is {}", what, describe(node)), "true or false");
  return node.as_boolean()->get();
}

std::int64_t TomlSource::asInteger(const toml::node& node, const std::string& what, std::int64_t least,
                                   std::int64_t most) const {
  const std::string expected = fmt::format("a whole number between {} and {}", least, most);
  if (!node.is_integer())
    fail(node,
         fmt::format("{} is {}{}", what, describe(node), node.is_floating_point() ? " with point or exponent" : ""),
         expected);
  const std::int64_t value = node.as_integer()->get();
  if (value < least || value > most) fail(node, fmt::format("{} is {}", what, value), expected);
  return value;
}

const toml::table& TomlSource::asTable(const toml::node& node, const std::string& what,
                                       const std::string& expected) const {
  if (!node.is_table()) fail(node, fmt::format("{} is {}", what, describe(node)), expected);
  return *node.as_table();
}

const toml::array& TomlSource::asArray(const toml::node& node, const std::string& what) const {
  if (!node.is_array()) fail(node, fmt::format("{} is {}", what, describe(node)), "a list [ … ]");
  return *node.as_array();
}

Amount TomlSource::asAnyAmount(const toml::node& node, const std::string& what) const {
  if (node.is_floating_point() && !std::isfinite(node.as_floating_point()->get()))
    fail(node, what + " is not finite", "a finite number");
  if (node.is_string()) return readAnyAmount(node, what, node.as_string()->get());
  if (node.is_integer()) return readAnyAmount(node, what, std::to_string(node.as_integer()->get()));
  if (node.is_floating_point()) return readAnyAmount(node, what, tokenAt(node.source().begin));
  fail(node, fmt::format("{} is {}", what, describe(node)), "a number, or text with a unit such as \"135 deg\"");
}

Amount TomlSource::readAnyAmount(const toml::node& node, const std::string& what, const std::string& text) const {
  try {
    return parseAmount(text);
  } catch (const UnitError& error) {
    fail(node, fmt::format("{}: {}", what, error.problem()), error.expected());
  }
}

std::string TomlSource::nameIn(std::string_view formula) const {
  const auto isName = [this](std::string_view word) {
    return names_.parameters.contains(word) || names_.states.contains(word);
  };
  const Expression found = Expression::parse(formula, isName);
  return found.isConstant() || !isName(found.names().front()) ? "" : found.names().front();
}

Expression TomlSource::asExpression(const toml::node& node, const std::string& what, bool isOfMotion) const {
  try {
    return Expression::parse(asText(node, what), [&](std::string_view word) {
      return names_.parameters.contains(word) || (isOfMotion && names_.states.contains(word));
    });
  } catch (const UnitError& error) {
    fail(node, fmt::format("{}: {}", what, error.problem()), error.expected());
  }
}

Amount TomlSource::asAmount(const toml::node& node, const std::string& what, const Dimension& dimension,
                            const std::string& unit) const {
  return checked(node, what, asAnyAmount(node, what), dimension, unit);
}

Amount TomlSource::readAmount(const toml::node& node, const std::string& what, const std::string& text,
                              const Dimension& dimension, const std::string& unit) const {
  return checked(node, what, readAnyAmount(node, what, text), dimension, unit);
}

Amount TomlSource::checked(const toml::node& node, const std::string& what, Amount amount, const Dimension& dimension,
                           const std::string& unit) const {
  const std::string wanted = unit.empty() ? unitOf(dimension) : unit;
  const std::string expected =
      wanted == "1" ? "a number without unit" : fmt::format("a number in {}, or with a unit of that kind", wanted);
  if (amount.isRelative && !(dimension == Dimension{})) fail(node, what + " is written in percent", expected);
  if (amount.hasUnit && !isCompatible(amount.dimension, dimension))
    fail(node, fmt::format("{} is written in a unit of the kind {}", what, unitOf(amount.dimension)), expected);
  amount.dimension = dimension;
  return amount;
}

std::string TomlSource::asChoice(const toml::node& node, const std::string& what,
                                 const std::vector<std::string>& choices) const {
  const std::string word = asText(node, what);
  if (std::find(choices.begin(), choices.end(), word) == choices.end())
    fail(node, fmt::format("{} is \"{}\"", what, word), suggestion(word, choices));
  return word;
}

/// Columns count code points, so continuation bytes (10xxxxxx) are skipped.
std::size_t TomlSource::placeAt(const toml::source_position& at) const {
  std::size_t i = lineStarts_.at(at.line - 1);
  for (unsigned column = 1; i < text_.size(); ++i) {
    if ((static_cast<unsigned char>(text_[i]) & 0xC0U) == 0x80U) continue;
    if (column++ == at.column) break;
  }
  return i;
}

std::string TomlSource::with(std::vector<std::pair<const toml::node*, std::string>> values) const {
  std::ranges::sort(values,
                    [](const auto& a, const auto& b) { return b.first->source().begin < a.first->source().begin; });
  std::string text = text_;
  for (const auto& [node, value] : values) {
    const std::size_t begin = placeAt(node->source().begin);
    text.replace(begin, placeAt(node->source().end) - begin, value);
  }
  return text;
}

/// The number's characters.
std::string TomlSource::tokenAt(const toml::source_position& at) const {
  const std::size_t i = placeAt(at);
  const std::size_t end = text_.find_first_not_of("0123456789+-._eE", i);
  return text_.substr(i, end == std::string::npos ? end : end - i);
}

TomlSection::TomlSection(const TomlSource& source, const toml::table& table, std::string name,
                         std::vector<std::string> known)
    : source_(&source), table_(&table), name_(std::move(name)) {
  for (const auto& [key, value] : table) {
    const std::string word(key.str());
    if (std::find(known.begin(), known.end(), word) != known.end()) continue;
    const std::string place = name_.empty() ? "" : fmt::format(" in [{}]", name_);
    source.fail(key.source().begin, fmt::format("unknown key '{}'{}", word, place), suggestion(word, known));
  }
}

const toml::node& TomlSection::require(std::string_view key, const std::string& expected) const {
  const toml::node* node = find(key);
  if (node == nullptr) source_->fail(*table_, fmt::format("'{}' is missing", nameOf(key)), expected);
  return *node;
}

std::string TomlSection::nameOf(std::string_view key) const {
  return name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
}

std::string TomlSection::text(std::string_view key) const {
  return source_->asText(require(key, "text in quotes"), nameOf(key));
}

std::string TomlSection::text(std::string_view key, const std::string& otherwise) const {
  return find(key) != nullptr ? text(key) : otherwise;
}

std::int64_t TomlSection::integer(std::string_view key, std::int64_t otherwise, std::int64_t least,
                                  std::int64_t most) const {
  const toml::node* node = find(key);
  return node == nullptr ? otherwise : source_->asInteger(*node, nameOf(key), least, most);
}

double TomlSection::positive(std::string_view key, double otherwise) const {
  const toml::node* node = find(key);
  if (node == nullptr) return otherwise;
  const double value = nearest(source_->asAmount(*node, nameOf(key), Dimension{}));
  if (!(value > 0)) source_->fail(*node, fmt::format("{} is not positive", nameOf(key)), "a number above 0");
  return value;
}

}  // namespace gamut
