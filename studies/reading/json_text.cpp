// The library parses, so that what follows walks over text that is JSON.
#include "studies/reading/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

namespace gamut {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr int mostNested = 60;

bool isContinued(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

TextPlace placeIn(std::string_view text, std::size_t at) {
  TextPlace place;
  for (std::size_t i = 0; i < std::min(at, text.size()); ++i) {
    if (text[i] == '\n')
      place = {place.line + 1, 1};
    else if (!isContinued(text[i]))
      ++place.column;
  }
  return place;
}

/// A text in quotes, as TOML has it.
std::string quotedInToml(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += std::string("\\") + c;
    else if (byte < 0x20 || byte == 0x7F)
      quoted += fmt::format("\\u{:04X}", byte);
    else
      quoted += c;
  }
  return quoted + '"';
}

struct JsonFault {
  std::string what, expected;
  std::size_t at;
};

/// Walks over JSON that is valid.
class Transcriber {
 public:
  explicit Transcriber(std::string_view json) : json_(json) {}

  TomlOfJson transcribe() {
    skipBlanks();
    note();
    takeMembers([this](const std::string& key) {
      writeKey(key);
      takeValue(1);
      write("\n");
    });
    return std::move(toml_);
  }

 private:
  /// What is written next stands here in the JSON.
  void note() { toml_.places.push_back({written_, read_}); }

  void write(const std::string& text) {
    for (const char c : text) {
      if (c == '\n')
        written_ = {written_.line + 1, 1};
      else if (!isContinued(c))
        ++written_.column;
    }
    toml_.text += text;
  }

  void skip() {
    const char c = json_[at_++];
    if (c == '\n')
      read_ = {read_.line + 1, 1};
    else if (!isContinued(c))
      ++read_.column;
  }
  void skipBlanks() {
    while (at_ < json_.size() && blanks.find(json_[at_]) != std::string_view::npos) skip();
  }
  /// A text's or a number's characters, or those of a word.
  std::string token() {
    const std::size_t begin = at_;
    if (json_[at_] == '"') {
      for (skip(); json_[at_] != '"'; skip())
        if (json_[at_] == '\\') skip();
      skip();
    } else {
      while (at_ < json_.size() && (blanks.find(json_[at_]) == std::string_view::npos) &&
             std::string_view(",:]}").find(json_[at_]) == std::string_view::npos)
        skip();
    }
    return std::string(json_.substr(begin, at_ - begin));
  }

  /// From { to }: for each key, noted, as it is to be written.
  template <class Action>
  void takeMembers(const Action& action) {
    std::set<std::string> keys;
    skip();
    for (skipBlanks(); json_[at_] != '}'; skipBlanks()) {
      const std::size_t begin = at_;
      const TextPlace place = read_;
      const std::string key = nlohmann::json::parse(token()).get<std::string>();
      if (!keys.insert(key).second)
        throw JsonFault{fmt::format("'{}' is given twice", key), "one value for each key", begin};
      skipBlanks();
      skip();  // the colon
      pending_ = place;
      action(quotedInToml(key));
      skipBlanks();
      if (json_[at_] == ',') skip();
    }
    skip();
  }

  void takeValue(int depth) {
    skipBlanks();
    if (depth > mostNested) throw JsonFault{"lists and tables are nested too deeply", "a study", at_};
    note();
    const char c = json_[at_];
    if (c == '{')
      takeTable(depth);
    else if (c == '[')
      takeList(depth);
    else if (c == '"')
      write(quotedInToml(nlohmann::json::parse(token()).get<std::string>()));
    else if (c == 'n')
      throw JsonFault{"null says nothing in a study", "a value, or no such key", at_};
    else
      write(token());
  }

  void takeTable(int depth) {
    write("{");
    bool isFirst = true;
    takeMembers([&](const std::string& key) {
      write(isFirst ? " " : ", ");
      isFirst = false;
      writeKey(key);
      takeValue(depth + 1);
    });
    write(" }");
  }

  void takeList(int depth) {
    write("[");
    skip();
    for (skipBlanks(); json_[at_] != ']'; skipBlanks()) {
      takeValue(depth + 1);
      skipBlanks();
      if (json_[at_] != ',') continue;
      write(", ");
      skip();
    }
    skip();
    write("]");
  }

  void writeKey(const std::string& key) {
    toml_.places.push_back({written_, pending_});
    write(key + " = ");
  }

  std::string_view json_;
  std::size_t at_ = 0;
  TextPlace read_, written_, pending_;  ///< pending_: of the key that is taken
  TomlOfJson toml_;
};

/// What the parser expected, without its own words in front; one line.
std::string saidBy(const nlohmann::json::parse_error& error) {
  std::string what = error.what();
  for (const std::string_view before : {"column ", ": "})
    if (const auto found = what.find(before); found != std::string::npos) what = what.substr(found + before.size());
  std::ranges::replace(what, ';', ',');
  return what;
}

}  // namespace

TextPlace TomlOfJson::inJson(const TextPlace& toml) const {
  const auto behind = std::ranges::upper_bound(places, toml, {}, &Pair::toml);
  return behind == places.begin() ? TextPlace() : std::prev(behind)->json;
}

bool looksLikeJson(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  return first != std::string_view::npos && text[first] == '{';
}

TomlOfJson tomlOfJson(const std::string& text) {
  const auto faulty = [&](std::string what, std::string expected, std::size_t at) {
    TomlOfJson toml;
    toml.fault = std::move(what);
    toml.expected = std::move(expected);
    toml.faultAt = placeIn(text, at);
    return toml;
  };
  try {
    const auto isShallow = [](int depth, auto, auto&) {
      if (depth > mostNested) throw std::length_error("deep");
      return true;
    };
    [[maybe_unused]] const auto valid = nlohmann::json::parse(text, isShallow);
    return Transcriber(text).transcribe();
  } catch (const nlohmann::json::parse_error& error) {
    return faulty("not valid JSON: " + saidBy(error), "a file that follows https://json.org", error.byte - 1);
  } catch (const nlohmann::json::exception&) {
    return faulty("a number is too large", "numbers below 1e308", 0);
  } catch (const std::length_error&) {
    return faulty("lists and tables are nested too deeply", "a study", 0);
  } catch (const JsonFault& fault) {
    return faulty(fault.what, fault.expected, fault.at);
  }
}

}  // namespace gamut
