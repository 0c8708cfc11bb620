// Tokens, then a parser by recursive descent; decorations are read and dropped.
#include "tests/scalars/conformance/itf1788.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <stdexcept>

namespace gamut::testing {
namespace {

struct Token {
  enum class Kind { text, number, name, sign } kind;
  std::string source;
  int line;
};

/// The end of the blanks and comments that start here.
std::size_t skipped(const std::string& source, std::size_t at) {
  for (;;) {
    at = std::min(source.find_first_not_of(" \t\r\n", at), source.size());
    if (source.compare(at, 2, "//") == 0) {
      at = source.find('\n', at);
    } else if (source.compare(at, 2, "/*") == 0) {
      const auto end = source.find("*/", at);
      at = end == std::string::npos ? end : end + 2;
    } else {
      return at;
    }
    at = std::min(at, source.size());
  }
}

/// Splits a file into tokens; comments vanish.
std::vector<Token> tokensOf(const std::string& source, const std::string& file) {
  static const std::regex form(R"(("[^"]*"))"  // 1: text
                               R"(|([+-]?(?:infinity\b|0[xX][0-9a-fA-F]*\.?[0-9a-fA-F]*(?:[pP][+-]?\d+)?)"
                               R"(|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)))"  // 2: number
                               R"(|([A-Za-z][A-Za-z0-9_-]*))"                // 3: name
                               R"(|([{}\[\];=_.,]))",                        // 4: sign
                               std::regex::optimize);
  constexpr Token::Kind kinds[] = {Token::Kind::text, Token::Kind::number, Token::Kind::name, Token::Kind::sign};
  std::vector<Token> tokens;
  int line = 1;
  for (std::size_t at = 0;;) {
    const std::size_t begin = skipped(source, at);
    line += static_cast<int>(std::count(source.begin() + static_cast<std::ptrdiff_t>(at),
                                        source.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    if (begin == source.size()) return tokens;
    std::smatch match;
    if (!std::regex_search(source.begin() + static_cast<std::ptrdiff_t>(begin), source.end(), match, form,
                           std::regex_constants::match_continuous))
      throw std::runtime_error(file + ":" + std::to_string(line) + ": unreadable: " + source.substr(begin, 20));
    for (std::size_t group = 1; group <= 4; ++group)
      if (match[group].matched) tokens.push_back({kinds[group - 1], match[group], line});
    at = begin + static_cast<std::size_t>(match.length());
  }
}

double nearest(const std::string& number) { return std::strtod(number.c_str(), nullptr); }

class Parser {
 public:
  Parser(std::vector<Token> tokens, std::string file) : tokens_(std::move(tokens)), file_(std::move(file)) {}

  std::vector<ItfRow> rows() {
    while (at_ < tokens_.size()) {
      expect("testcase");
      while (!peek("{")) next();
      expect("{");
      while (!take("}")) rows_.push_back(row());
    }
    return std::move(rows_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const Token& token = tokens_[std::min(at_, tokens_.size() - 1)];
    throw std::runtime_error(file_ + ":" + std::to_string(token.line) + ": " + what + " at '" + token.source + "'");
  }
  const Token& next() {
    if (at_ >= tokens_.size()) fail("the file ends too early");
    return tokens_[at_++];
  }
  bool peek(const char* source) const {
    return at_ < tokens_.size() && tokens_[at_].kind != Token::Kind::text && tokens_[at_].source == source;
  }
  bool take(const char* source) {
    const bool found = peek(source);
    at_ += found;
    return found;
  }
  void expect(const char* source) {
    if (!take(source)) fail(std::string("expected ") + source);
  }

  ItfRow row() {
    ItfRow row;
    const std::size_t first = at_;
    if (next().kind != Token::Kind::name) fail("expected an operation");
    row.operation = tokens_[first].source;
    while (!take("=")) row.operands.push_back(value());
    while (!peek(";") && !peek("signal")) {
      row.results.push_back(value());
      take(",");
    }
    if (take("signal")) row.signal = next().source;
    row.where = file_ + ":" + std::to_string(tokens_[first].line) + ":";
    for (std::size_t i = first; i < at_; ++i) row.where += " " + tokens_[i].source;
    expect(";");
    return row;
  }

  ItfValue value() {
    if (take("[")) return interval();
    if (take("{")) return list();
    const Token& token = next();
    ItfValue v;
    v.text = token.source;
    if (token.kind == Token::Kind::text) {
      v.kind = ItfValue::Kind::text;
      v.text = token.source.substr(1, token.source.size() - 2);
    } else if (token.kind == Token::Kind::number || token.source == "NaN") {
      v.kind = ItfValue::Kind::number;
      v.number = nearest(token.source);
    } else if (token.source == "true" || token.source == "false") {
      v.kind = ItfValue::Kind::truth;
      v.truth = token.source == "true";
    } else if (token.kind != Token::Kind::name) {
      fail("expected a value");
    }
    return v;
  }

  /// After '[': "nai]", "empty]", "entire]" or "number, number]", with or without a decoration.
  ItfValue interval() {
    ItfValue v;
    v.kind = ItfValue::Kind::interval;
    const Token first = next();
    v.text = first.source;
    if (first.source == "nai") {
      v.kind = ItfValue::Kind::notAnInterval;
    } else if (first.source == "empty") {
      v.interval = Interval::empty();
    } else if (first.source == "entire") {
      v.interval = Interval::entire();
    } else {
      expect(",");
      const Token second = next();
      if (first.kind != Token::Kind::number || second.kind != Token::Kind::number) fail("expected two numbers before");
      v.interval = Interval(nearest(first.source), nearest(second.source));
    }
    expect("]");
    if (take("_") && next().kind != Token::Kind::name) fail("expected a decoration before");
    return v;
  }

  /// After '{': numbers with commas, whose values only the reductions use, which Interval has not.
  ItfValue list() {
    ItfValue v;
    v.kind = ItfValue::Kind::list;
    while (!take("}")) v.text += next().source;
    return v;
  }

  std::vector<Token> tokens_;
  std::string file_;
  std::size_t at_ = 0;
  std::vector<ItfRow> rows_;
};

}  // namespace

bool ItfRow::isAboutNaI() const {
  const auto isNaI = [](const ItfValue& v) { return v.kind == ItfValue::Kind::notAnInterval; };
  return std::any_of(operands.begin(), operands.end(), isNaI) || std::any_of(results.begin(), results.end(), isNaI);
}

std::vector<ItfRow> readItf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file.filename().string());
  const std::string source{std::istreambuf_iterator<char>(stream), {}};
  const std::string name = file.filename().string();
  return Parser(tokensOf(source, name), name).rows();
}

}  // namespace gamut::testing
