// The grammar, read by recursive descent; what holds no names is computed, exactly, while it is read.
#include "mechanics/description/expression.hpp"

#include "mechanics/description/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace gamut {

namespace {

constexpr int deepest = 100;             // parentheses within each other
constexpr std::size_t longest = 10'000;  // characters: places of terms are found by counting

bool isWordBegin(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// What a blank may join.
enum class Piece { number, unit, other };

}  // namespace

class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, const Expression::IsName& isName) : text_(text), isName_(isName) {}

  Expression read() {
    if (text_.size() > longest)
      throw UnitError(fmt::format("a number of {} characters", text_.size()), fmt::format("at most {}", longest));
    skipBlanks();
    if (atEnd()) fail(fmt::format("'{}' holds no number", text_));
    readSum();
    refuseComparison();
    if (!atEnd())
      fail(fmt::format("unexpected '{}'", character()),
           here() == ',' ? "a point before decimals, and no mark between thousands"
                         : std::string("an operator or the end") + (isDigit(here()) ? " (5/s, not 5 1/s)" : ""));
    if (expression_.isConstant() && !hasNumber_) fail(fmt::format("'{}' holds a unit but no number", text_));
    return std::move(expression_);
  }

 private:
  using Operation = Expression::Operation;
  struct Called {
    std::string_view name;
    Operation operation;
    int index = 0;  // Operation::function: an Op
  };
  /// In the order in which messages list them; behind them the functions of programs that have no place here.
  static const std::vector<Called>& functions() {
    static constexpr Called listed[] = {
        {"sqrt", Operation::sqrt},   {"exp", Operation::function}, {"log", Operation::function},
        {"sin", Operation::sin},     {"cos", Operation::cos},      {"tan", Operation::tan},
        {"asin", Operation::asin},   {"acos", Operation::acos},    {"atan", Operation::atan},
        {"sinh", Operation::sinh},   {"cosh", Operation::cosh},    {"tanh", Operation::function},
        {"abs", Operation::abs},     {"sign", Operation::sign},    {"where", Operation::where},
        {"atan2", Operation::atan2}, {"hypot", Operation::hypot},  {"min", Operation::min},
        {"max", Operation::max}};
    static const std::vector<Called> all = [] {
      std::vector<Called> known(std::begin(listed), std::end(listed));
      for (int i = 0; i < opCount; ++i) {
        const Op op = static_cast<Op>(i);
        if (!isFunction(op) || !withFunction(op, [](auto f) { return f.isInFormulas; })) continue;
        const auto own = std::ranges::find(known, nameOf(op), &Called::name);
        if (own == known.end())
          known.push_back({nameOf(op), Operation::function, i});
        else if (own->operation == Operation::function)
          own->index = i;
      }
      return known;
    }();
    return all;
  }
  /// As other languages call them.
  using OtherFunction = std::pair<std::string_view, std::string_view>;
  static constexpr OtherFunction otherFunctions[] = {{"if", "where"},    {"ln", "log"},      {"sgn", "sign"},
                                                     {"signum", "sign"}, {"fabs", "abs"},    {"arcsin", "asin"},
                                                     {"arccos", "acos"}, {"arctan", "atan"}, {"arctan2", "atan2"}};
  static constexpr const char* example =
      "a number with an optional unit, such as 0.5, \"135 deg\" or \"3/4 pi\", or a formula such as \"2 rod.length + 3 "
      "mm\"";

  bool atEnd() const { return position_ == text_.size(); }
  char here() const { return atEnd() ? '\0' : text_[position_]; }
  void skipBlanks() {
    while (here() == ' ' || here() == '\t') ++position_;
  }
  bool take(std::string_view token) {
    if (!text_.substr(position_).starts_with(token)) return false;
    position_ += token.size();
    return true;
  }
  /// From 1, in characters.
  int columnAt(std::size_t position) const {
    return 1 + static_cast<int>(std::count_if(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(position),
                                              [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
  }
  int column() const { return columnAt(position_); }
  /// The one here, whole.
  std::string_view character() const {
    std::size_t end = position_ + 1;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
    return text_.substr(position_, end - position_);
  }
  [[noreturn]] void fail(const std::string& what, const std::string& expected = example) const {
    throw UnitError(fmt::format("{} at column {}", what, column()), expected);
  }
  /// What exact arithmetic refuses is said with its place.
  template <class Action>
  auto located(int column, Action action) const {
    try {
      return action();
    } catch (const UnitError& error) {
      throw UnitError(fmt::format("{} at column {}", error.problem(), column), error.expected());
    }
  }

  /// Terms, and their exact values where they have one; an operation on exact operands leaves an exact result.
  void push(Operation operation, int index, int column, std::optional<Amount> exact = std::nullopt) {
    expression_.terms_.push_back({operation, index, column});
    exact_.push_back(std::move(exact));
  }
  void pushConstant(const Amount& amount, int column) {
    push(Operation::constant, static_cast<int>(expression_.constants_.size()), column, amount);
    expression_.constants_.push_back({enclose(amount), amount});
  }
  void pop() {
    if (expression_.terms_.back().operation == Operation::constant) expression_.constants_.pop_back();
    expression_.terms_.pop_back();
    exact_.pop_back();
  }
  void apply(Operation operation, int column) {
    const std::size_t n = exact_.size();
    if (exact_[n - 1] && exact_[n - 2]) {
      const Amount a = *exact_[n - 2], b = *exact_[n - 1];
      const std::optional<Amount> result = located(column, [&]() -> std::optional<Amount> {
        switch (operation) {
          case Operation::add:
            return sum(a, b);
          case Operation::subtract:
            return sum(a, negative(b));
          case Operation::multiply:
            return product(a, b);
          case Operation::divide:
            return quotient(a, b);
          default:
            return std::nullopt;
        }
      });
      if (result) {
        pop();
        pop();
        pushConstant(*result, column);
        return;
      }
    }
    push(operation, 0, column);
  }
  void applyPower(int exponent, int column) {
    if (!exact_.back()) return push(Operation::power, exponent, column);
    const Amount result = located(column, [&] { return power(*exact_.back(), exponent); });
    pop();
    pushConstant(result, column);
  }

  void readSum() {
    const int before = depth_++;
    if (depth_ > deepest) fail("too many parentheses", fmt::format("at most {} within each other", deepest));
    readProduct();
    for (;;) {
      const int at = column();
      const bool subtracts = take("-") || take("−");
      if (!subtracts && !take("+")) break;
      skipBlanks();
      if (atEnd()) fail("the end after an operator");
      readProduct();
      apply(subtracts ? Operation::subtract : Operation::add, at);
    }
    depth_ = before;
  }

  void readProduct() {
    readSigned(false);
    for (;;) {
      skipBlanks();
      const int at = column();
      const bool divides = take("/");
      if (divides || take("*") || take("·")) {
        if (here() == '*') fail("a second '*'", "'^' for a power");
        skipBlanks();
        if (atEnd()) fail("the end after an operator");
        readSigned(false);
      } else if (isWordHere()) {
        if (last_ == Piece::other || (last_ == Piece::unit && !isUnitHere())) failBeforeWord();
        readPower(last_ == Piece::number);
      } else {
        break;
      }
      apply(divides ? Operation::divide : Operation::multiply, at);
    }
  }

  /// Behind a unit a unit is meant, m^2 by m2; behind a name it may be the rest of it.
  [[noreturn]] void failBeforeWord() const {
    const std::string word(text_.substr(position_, wordLength()));
    const std::string unit = last_ == Piece::unit && (!isName_ || !isName_(word)) ? unitsApart(word) : "";
    fail(fmt::format("no operator before '{}'", word),
         unit.empty() ? "*, /, + or -, or single quotes about a name with blanks" : "'" + unit + "'");
  }

  void readSigned(bool followsNumber) {
    const int at = column();
    bool isNegative = false;
    for (;; skipBlanks()) {
      if (take("-") || take("−"))
        isNegative = !isNegative;
      else if (!take("+"))
        break;
    }
    readPower(followsNumber);
    if (!isNegative) return;
    if (!exact_.back()) return push(Operation::negate, 0, at);
    const Amount result = negative(*exact_.back());
    pop();
    pushConstant(result, at);
  }

  void readPower(bool followsNumber) {
    readPrimary(followsNumber);
    const int at = column();
    if (take("²")) return applyPower(2, at);
    if (take("³")) return applyPower(3, at);
    if (!take("^")) return;
    const Piece piece = last_;
    if (++depth_ > deepest) fail("too many powers", fmt::format("at most {} within each other", deepest));
    readSigned(false);
    --depth_;
    const std::optional<Amount>& exponent = exact_.back();
    const bool isWhole = exponent && exponent->piPower == 0 && !exponent->hasUnit && !exponent->isRelative &&
                         exponent->value.get_den() == 1 && abs(exponent->value) < 1024;
    last_ = piece;
    if (!isWhole) return push(Operation::pow, 0, at);
    const int whole = static_cast<int>(exponent->value.get_num().get_si());
    pop();
    applyPower(whole, at);
  }

  bool isWordHere() const {
    const char c = here();
    return isWordBegin(c) || c == '\'' || c == '%' || isOther(position_);
  }
  const Amount* unitOf(std::string_view word) const {
    return mayBeName(word) && (!isName_ || isName_(word)) ? nullptr : unitNamed(word);
  }
  bool isUnitHere() const { return unitOf(text_.substr(position_, wordLength())) != nullptr; }
  /// A character beyond ASCII that units or pi may begin with.
  bool isOther(std::size_t position) const {
    const std::string_view rest = text_.substr(position);
    return !rest.empty() && static_cast<unsigned char>(rest[0]) >= 0x80 && !rest.starts_with("²") &&
           !rest.starts_with("³") && !rest.starts_with("·") && !rest.starts_with("−");
  }
  std::size_t wordLength() const {
    std::size_t end = position_;
    if (here() == '%') return 1;
    if (startsWith("π")) return std::string_view("π").size();
    while (end < text_.size() &&
           (isWordBegin(text_[end]) || ((isDigit(text_[end]) || text_[end] == '.') && end > position_) || isOther(end)))
      ++end;
    return end - position_;
  }
  bool startsWith(std::string_view token) const { return text_.substr(position_).starts_with(token); }

  void readPrimary(bool followsNumber) {
    const int at = column();
    if (isDigit(here()) || here() == '.') {
      const Amount number{readDecimal(), 0, {}};
      hasNumber_ = true;
      pushConstant(located(at, [&] { return product(number, Amount{1, 0, {}}); }), at);
      last_ = Piece::number;
    } else if (take("(")) {
      skipBlanks();
      readSum();
      refuseComparison();
      if (!take(")")) fail(atEnd() ? "the end" : fmt::format("'{}'", character()), "')'");
      last_ = Piece::other;
      hasNumber_ = true;
    } else if (take("'")) {
      const std::size_t end = text_.find('\'', position_);
      if (end == std::string_view::npos || end == position_) fail("a quotation mark without a name", "'name'");
      pushName(std::string(text_.substr(position_, end - position_)), at);
      position_ = end + 1;
    } else if (isWordHere()) {
      readWord(followsNumber);
    } else {
      fail(atEnd() ? "the end" : fmt::format("unexpected '{}'", character()));
    }
  }

  void readWord(bool followsNumber) {
    const int at = column();
    const std::string word(text_.substr(position_, wordLength()));
    position_ += word.size();
    const Amount* unit = unitOf(word);
    const auto function = std::ranges::find(functions(), word, &Called::name);
    if (word == "pi" || word == "π") {
      hasNumber_ = true;
      pushConstant({1, 1, {}}, at);
      last_ = Piece::number;
    } else if (here() == '(' && (function != functions().end() || unit == nullptr)) {
      if (function == functions().end()) refuseFunction(word, at);
      readCall(*function, at);
    } else if (unit != nullptr && (word != "t" || followsNumber)) {
      pushConstant(*unit, at);
      last_ = Piece::unit;
    } else {
      pushName(word, at);
    }
  }

  void pushName(const std::string& name, int at) {
    std::vector<std::string>& names = expression_.names_;
    const auto found = std::find(names.begin(), names.end(), name);
    push(Operation::name, static_cast<int>(found - names.begin()), at);
    if (found == names.end()) names.push_back(name);
    last_ = Piece::other;
  }

  [[noreturn]] static void refuseFunction(const std::string& word, int at) {
    std::vector<std::string> known;
    for (const Called& f : functions()) known.emplace_back(f.name);
    const auto other = std::ranges::find(otherFunctions, word, &OtherFunction::first);
    const std::string nearest =
        other != std::end(otherFunctions) ? std::string(other->second) : nearestName(word, known);
    const std::string all = fmt::format("one of: {}", fmt::join(known, ", "));
    throw UnitError(fmt::format("unknown function '{}' at column {}", word, at),
                    nearest.empty() ? all : fmt::format("'{}'? ({})", nearest, all));
  }

  void readCall(const Called& function, int at) {
    const int wanted = Expression::operands(function.operation);
    take("(");
    for (int i = 0; i < wanted; ++i) {
      skipBlanks();
      readSum();
      if (i == 0 && function.operation == Operation::where) readComparison();
      if (!take(i + 1 < wanted ? "," : ")"))
        fail(atEnd() ? "the end" : fmt::format("'{}'", character()),
             fmt::format("'{}': {} takes {}", i + 1 < wanted ? "," : ")", function.name,
                         wanted == 1   ? "one number"
                         : wanted == 2 ? "two numbers"
                                       : "a condition and two numbers"));
    }
    push(function.operation, function.index, at);
    last_ = Piece::other;
    hasNumber_ = true;
  }

  /// The rest of `x > y` or `x < y`, if it is one: x - y, or y - x. `>=` is `>` and `<=` is `<`: at x = y no case holds
  /// alone, and the value is halfway between both.
  void readComparison() {
    const int at = column();
    if (here() == '=' || here() == '!') fail(fmt::format("'{}'", character()), "a comparison by >, >=, < or <=");
    const bool isLess = take("<");
    if (!isLess && !take(">")) return;
    take("=");
    skipBlanks();
    readSum();
    push(Operation::subtract, 1, at);
    if (isLess) push(Operation::negate, 0, at);
    if (here() == '&' || here() == '|' || here() == '<' || here() == '>')
      fail("a second condition", "one; where(a, where(b, x, y), y) is x where both a and b hold");
  }

  /// A condition is no number.
  void refuseComparison() const {
    if (here() == '<' || here() == '>' || here() == '=')
      fail(fmt::format("a comparison by '{}'", character()), "one as the first of where(condition, a, b)");
  }

  std::string readDigits() {
    std::string digits;
    for (; isDigit(here()) || here() == '_'; ++position_)
      if (here() != '_') digits += here();
    return digits;
  }

  /// digits [. digits] [e[+-]digits] as the rational it stands for.
  mpq_class readDecimal() {
    std::string digits = readDigits();
    long exponent = 0;
    if (take(".")) {
      const std::string fraction = readDigits();
      exponent = -static_cast<long>(fraction.size());
      digits += fraction;
    }
    if (digits.empty()) fail("a point without digits");
    exponent += readExponent();
    if (digits.size() > 400 || exponent > 700 || exponent < -700)
      fail("a number is too large or too small", "a magnitude between 1e-300 and 1e300, or 0");
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 10, static_cast<unsigned long>(std::labs(exponent)));
    mpq_class result(mpz_class(digits, 10));
    if (exponent > 0) result *= scale;
    if (exponent < 0) result /= scale;
    return result;
  }

  long readExponent() {
    const std::size_t begin = position_;
    if (!take("e") && !take("E")) return 0;
    const bool isNegative = take("-");
    if (!isNegative) take("+");
    const std::string digits = readDigits();
    if (digits.empty()) {  // no exponent after all: a word follows
      position_ = begin;
      return 0;
    }
    return (isNegative ? -1 : 1) * std::stol(digits.substr(0, 6));
  }

  std::string_view text_;
  const Expression::IsName& isName_;
  std::size_t position_ = 0;
  Expression expression_;
  std::vector<std::optional<Amount>> exact_;  // of the terms that stand for a constant
  Piece last_ = Piece::other;
  bool hasNumber_ = false;
  int depth_ = 0;
};

Expression Expression::parse(std::string_view text, const IsName& isName) {
  return ExpressionParser(text, isName).read();
}

}  // namespace gamut
