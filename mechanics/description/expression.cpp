// Dimensions follow the terms, as values do.
#include "mechanics/description/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <vector>

namespace gamut {

Expression::Expression(const Interval& value) : terms_{{Operation::constant}}, constants_{{value}} {}

Expression::Expression(const Amount& value) : terms_{{Operation::constant}}, constants_{{enclose(value), value}} {}

Expression Expression::named(const std::string& name, const Interval& factor) {
  Expression result(factor);
  result.names_.push_back(name);
  result.terms_.push_back({Operation::name});
  result.terms_.push_back({Operation::multiply});
  return result;
}

Expression& Expression::append(const Expression& other) {
  const int shift = static_cast<int>(constants_.size());
  for (Term term : other.terms_) {
    if (term.operation == Operation::constant) term.index += shift;
    if (term.operation == Operation::name) {
      const std::string& name = other.names_[static_cast<std::size_t>(term.index)];
      const auto found = std::ranges::find(names_, name);
      term.index = static_cast<int>(found - names_.begin());
      if (found == names_.end()) names_.push_back(name);
    }
    terms_.push_back(term);
  }
  constants_.insert(constants_.end(), other.constants_.begin(), other.constants_.end());
  return *this;
}

Expression& Expression::append(Operation operation) {
  terms_.push_back({operation});
  return *this;
}

bool Expression::isExactly(double value) const {
  return terms_.size() == 1 && isConstant() && isEqual(constants_[0].enclosure, Interval(value));
}

Expression operator+(const Expression& a, const Expression& b) {
  if (a.isExactly(0)) return b;
  return b.isExactly(0) ? a : Expression(a).append(b).append(Expression::Operation::add);
}

Expression operator-(const Expression& a, const Expression& b) {
  return b.isExactly(0) ? a : Expression(a).append(b).append(Expression::Operation::subtract);
}

Expression operator*(const Expression& a, const Expression& b) {
  if (a.isExactly(0) || b.isExactly(1)) return a;
  if (b.isExactly(0) || a.isExactly(1)) return b;
  return Expression(a).append(b).append(Expression::Operation::multiply);
}

Expression operator/(const Expression& a, const Expression& b) {
  return Expression(a).append(b).append(Expression::Operation::divide);
}

Expression sqrt(const Expression& a) { return Expression(a).append(Expression::Operation::sqrt); }
Expression sin(const Expression& a) { return Expression(a).append(Expression::Operation::sin); }
Expression cos(const Expression& a) { return Expression(a).append(Expression::Operation::cos); }

namespace {

[[noreturn]] void refuse(const std::string& what, int column, const std::string& expected) {
  throw UnitError(fmt::format("{} at column {}; expected {}", what, column, expected));
}

/// As what is added to something: a 1 would be taken for the number.
std::string inWords(const Dimension& d) { return d == Dimension{} ? "a number without unit" : unitOf(d); }

Dimension scaled(const Dimension& d, int times) {
  return {d.mass * times,   d.length * times,  d.time * times,        d.angle * times,
          d.memory * times, d.current * times, d.temperature * times, d.isOfMoment && times > 0};
}

}  // namespace

Dimension Expression::dimension(const DimensionOf& dimensionOf) const {
  struct Operand {
    Dimension dimension;
    bool isNothing = false;  // a plain 0, which is of any kind
  };
  std::vector<Operand> stack;
  for (const Term& term : terms_) {
    if (term.operation == Operation::constant) {
      const std::optional<Amount>& exact = constants_[static_cast<std::size_t>(term.index)].exact;
      stack.push_back({exact ? exact->dimension : Dimension{}, exact && exact->value == 0 && !exact->hasUnit});
      continue;
    }
    if (term.operation == Operation::name) {
      stack.push_back({dimensionOf(names_[static_cast<std::size_t>(term.index)])});
      continue;
    }
    const auto [b, isSecondNothing] = stack.back();
    if (operands(term.operation) > 1) stack.pop_back();
    Dimension& a = stack.back().dimension;
    const bool isFirstNothing = stack.back().isNothing;
    stack.back().isNothing = false;
    const auto mustBeAlike = [&, &b = b, &isSecondNothing = isSecondNothing](const char* does, const char* joins) {
      stack.back().isNothing = isFirstNothing && isSecondNothing;
      if (isSecondNothing) return;
      if (isFirstNothing)
        a = b;
      else if (!isAlike(a, b))
        refuse(fmt::format("{} {} {} {}", does, inWords(b), joins, inWords(a)), term.column, "quantities of one kind");
      if (a.mass != 0)
        a.angle = std::min(a.angle, b.angle);  // N m + N m rad is N m, N m/rad + N m is N m/rad
      else if (a.angle == 0)
        a.angle = b.angle;
      a.isOfMoment = a.isOfMoment || b.isOfMoment;
    };
    const auto mustBePlain = [&](const Dimension& d, const char* what) {
      if (!isAlike(d, {}))
        refuse(fmt::format("{} {}", what, unitOf(d)), term.column, "a number without unit, or an angle");
    };
    switch (term.operation) {
      case Operation::add:
        mustBeAlike("adds", "to");
        break;
      case Operation::subtract:
        mustBeAlike(term.index == 0 ? "subtracts" : "compares", term.index == 0 ? "from" : "with");
        break;
      case Operation::min:
      case Operation::max:
      case Operation::hypot:
        mustBeAlike("compares", "with");
        break;
      case Operation::atan2:
        mustBeAlike("compares", "with");
        a = {0, 0, 0, 1};
        break;
      case Operation::multiply:
        a = joined(a, b, 1);
        break;
      case Operation::divide:
        a = joined(a, b, -1);
        break;
      case Operation::power:
        a = scaled(b, term.index);
        break;
      case Operation::sqrt:
        if (b.mass % 2 != 0 || b.length % 2 != 0 || b.time % 2 != 0 || b.memory % 2 != 0 || b.current % 2 != 0 ||
            b.temperature % 2 != 0)
          refuse(fmt::format("the square root of {}", unitOf(b)), term.column, "a unit that is a square, such as m^2");
        a = {b.mass / 2,   b.length / 2,  b.time / 2,        b.angle / 2,
             b.memory / 2, b.current / 2, b.temperature / 2, b.isOfMoment};
        break;
      case Operation::pow:
        mustBePlain(a, "a power of");
        mustBePlain(b, "an exponent in");
        a = {};
        break;
      case Operation::asin:
      case Operation::acos:
      case Operation::atan:
        mustBePlain(b, "a function of");
        a = {0, 0, 0, 1};
        break;
      case Operation::where: {
        mustBeAlike("compares", "with");
        const Operand either = stack.back();
        stack.pop_back();
        stack.back() = either;
        break;
      }
      case Operation::sign:
        a = {};
        break;
      case Operation::negate:
      case Operation::abs:
        break;
      default:
        mustBePlain(b, "a function of");
        a = {};
    }
  }
  return stack.back().dimension;
}

void Expression::check(const DimensionOf& dimensionOf, const std::string& unit) const {
  const Dimension found = dimension(dimensionOf);
  const bool isPlain = isConstant() && std::ranges::none_of(constants_, [](const Constant& c) {
                         return c.exact && (c.exact->hasUnit || c.exact->isRelative);
                       });
  if (!isPlain && !isAlike(found, gamut::dimensionOf(unit)))
    throw UnitError(fmt::format("a quantity in {}; expected one in {}", unitOf(found), unit));
}

bool Expression::isSmooth() const {
  using enum Operation;
  return std::ranges::none_of(terms_, [](const Term& term) {
    return term.operation == abs || term.operation == sign || term.operation == min || term.operation == max ||
           term.operation == where;
  });
}

std::optional<Amount> Expression::amount() const {
  return terms_.size() == 1 && terms_[0].operation == Operation::constant ? constants_[0].exact : std::nullopt;
}

Amount parseAmount(std::string_view text) {
  const Expression expression = Expression::parse(text, [](std::string_view) { return false; });
  if (!expression.isConstant())
    throw UnitError(fmt::format("unknown unit '{}' in '{}'; expected {}", expression.names().front(), text,
                                unitInsteadOf(expression.names().front())));
  if (const std::optional<Amount> amount = expression.amount()) return *amount;
  throw UnitError(fmt::format("'{}' is no rational number times a power of pi; expected one that is", text));
}

Dimension dimensionOf(std::string_view unit) {
  if (unit.empty()) return {};
  const bool hasNumber = std::isdigit(static_cast<unsigned char>(unit.front())) != 0;
  return parseAmount(hasNumber ? std::string(unit) : "1 " + std::string(unit)).dimension;
}

}  // namespace gamut
