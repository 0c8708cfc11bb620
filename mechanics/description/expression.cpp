// Dimensions follow the terms, as values do.
#include "mechanics/description/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gamut {

Expression::Expression(const Interval& value) : terms_{{Operation::constant}}, constants_{{value}} {}

Expression::Expression(const Amount& value) : terms_{{Operation::constant}}, constants_{{enclose(value), value}} {}

Expression Expression::named(const std::string& name, const Interval& factor) {
  Expression result;
  result.names_.push_back(name);
  result.terms_.push_back({Operation::name});
  return Expression(factor) * result;
}

Expression& Expression::append(const Expression& other) {
  const int shift = static_cast<int>(constants_.size());
  for (Term term : other.terms_) {
    if (term.operation == Operation::constant) term.index += shift;
    if (term.operation == Operation::name) {
      const std::string& name = other.names_[term.index];
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

Expression operator-(const Expression& a) {
  if (const std::optional<Amount> amount = a.amount()) return Expression(negative(*amount));
  return Expression(a).append(Expression::Operation::negate);
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
  throw UnitError(fmt::format("{} at column {}", what, column), expected);
}

/// As what is added to something: a 1 would be taken for the number.
std::string inWords(const Dimension& d) { return d == Dimension{} ? "a number without unit" : unitOf(d); }

Dimension scaled(const Dimension& d, int times) {
  return {d.mass * times,   d.length * times,  d.time * times,        d.angle * times,
          d.memory * times, d.current * times, d.temperature * times, d.isOfMoment && times > 0};
}

}  // namespace

/// Long, since it is a list: what each operation asks of its operands' dimensions.
Dimension Expression::dimension(const DimensionOf& dimensionOf) const {
  struct Operand {
    Dimension dimension;
    bool isNothing = false;  // a plain 0, which is of any kind
  };
  std::vector<Operand> stack;
  for (const Term& term : terms_) {
    if (term.operation == Operation::constant) {
      const std::optional<Amount>& exact = constants_[term.index].exact;
      stack.push_back({exact ? exact->dimension : Dimension{}, exact && exact->value == 0 && !exact->hasUnit});
      continue;
    }
    if (term.operation == Operation::name) {
      stack.push_back({dimensionOf(names_[term.index])});
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
    throw UnitError(fmt::format("a quantity in {}", unitOf(found)), fmt::format("one in {}", unit));
}

bool Expression::isSmooth() const {
  using enum Operation;
  return std::ranges::none_of(terms_, [](const Term& term) {
    return term.operation == abs || term.operation == sign || term.operation == min || term.operation == max ||
           term.operation == where || (term.operation == function && !gamut::isSmooth(static_cast<Op>(term.index)));
  });
}

std::optional<Amount> Expression::amount() const {
  return terms_.size() == 1 && terms_[0].operation == Operation::constant ? constants_[0].exact : std::nullopt;
}

std::optional<Expression> Expression::insideOfAbs() const {
  if (terms_.back().operation != Operation::abs) return std::nullopt;
  Expression inside = *this;
  inside.terms_.pop_back();
  return inside;
}

Expression Expression::with(const std::function<const Expression*(const std::string& name)>& instead) const {
  Expression result;
  for (const Term& term : terms_) {
    if (term.operation == Operation::name) {
      const std::string& name = names_[term.index];
      const Expression* other = instead(name);
      result.append(other != nullptr ? *other : named(name));
    } else if (term.operation == Operation::constant) {
      result.terms_.push_back({term.operation, static_cast<int>(result.constants_.size()), term.column});
      result.constants_.push_back(constants_[term.index]);
    } else {
      result.terms_.push_back(term);
    }
  }
  return result;
}

bool Expression::holdsAt(std::size_t begin, std::size_t end, const Expression& formula) const {
  if (end - begin != formula.terms_.size()) return false;
  return std::equal(formula.terms_.begin(), formula.terms_.end(), terms_.begin() + static_cast<std::ptrdiff_t>(begin),
                    [&](const Term& theirs, const Term& own) {
                      if (theirs.operation != own.operation) return false;
                      const auto i = static_cast<std::size_t>(own.index), j = static_cast<std::size_t>(theirs.index);
                      if (own.operation == Operation::name) return names_[i] == formula.names_[j];
                      if (own.operation == Operation::constant)
                        return isEqual(constants_[i].enclosure, formula.constants_[j].enclosure);
                      return (own.operation != Operation::power && own.operation != Operation::function) || i == j;
                    });
}

std::vector<Expression> Expression::parts() const {
  std::vector<Expression> found;
  std::vector<std::size_t> begins;  // of the operands at hand
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Operation operation = terms_[i].operation;
    const bool isLeaf = operation == Operation::constant || operation == Operation::name;
    begins.resize(begins.size() - static_cast<std::size_t>(isLeaf ? 0 : operands(operation) - 1));
    if (isLeaf) begins.push_back(i);
    const auto first = terms_.begin() + static_cast<std::ptrdiff_t>(begins.back());
    Expression part;
    part.constants_ = constants_;
    part.names_ = names_;
    part.terms_.assign(first, terms_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    const auto isName = [](const Term& term) { return term.operation == Operation::name; };
    if (std::ranges::any_of(part.terms_, isName)) found.push_back(std::move(part));
  }
  std::ranges::stable_sort(found, std::greater(), [](const Expression& part) { return part.terms_.size(); });
  return found;
}

std::optional<Expression::Affine> Expression::affineIn(const Expression& part) const {
  struct Operand {
    std::size_t begin;
    std::optional<Affine> form;
  };
  const Interval zero(0.0);
  const auto isNumber = [&](const std::optional<Affine>& form) { return form && isEqual(form->factor, zero); };
  const auto combined = [&](Operation operation, const std::optional<Affine>& a,
                            const std::optional<Affine>& b) -> std::optional<Affine> {
    if (!a || !b) return std::nullopt;
    switch (operation) {
      case Operation::add:
        return Affine{a->factor + b->factor, a->offset + b->offset};
      case Operation::subtract:
        return Affine{a->factor - b->factor, a->offset - b->offset};
      case Operation::multiply:
        if (isNumber(a)) return Affine{a->offset * b->factor, a->offset * b->offset};
        if (isNumber(b)) return Affine{a->factor * b->offset, a->offset * b->offset};
        return std::nullopt;
      case Operation::divide:
        if (!isNumber(b) || contains(b->offset, 0.0)) return std::nullopt;
        return Affine{a->factor / b->offset, a->offset / b->offset};
      default:
        return std::nullopt;
    }
  };
  std::vector<Operand> stack;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Operation operation = terms_[i].operation;
    Operand whole{i, std::nullopt};
    if (operation == Operation::constant) {
      whole.form = Affine{zero, constants_[terms_[i].index].enclosure};
    } else if (operation != Operation::name) {
      const auto first = stack.end() - operands(operation);
      whole.begin = first->begin;
      whole.form = operation == Operation::negate ? combined(Operation::subtract, Affine{zero, zero}, first->form)
                   : operands(operation) == 2     ? combined(operation, first->form, stack.back().form)
                                                  : std::nullopt;
      stack.erase(first, stack.end());
    }
    if (holdsAt(whole.begin, i + 1, part)) whole.form = Affine{Interval(1.0), zero};
    stack.push_back(whole);
  }
  const std::optional<Affine>& form = stack.back().form;
  return form && !contains(form->factor, 0.0) ? form : std::nullopt;
}

Amount parseAmount(std::string_view text) {
  const Expression expression = Expression::parse(text, [](std::string_view) { return false; });
  if (!expression.isConstant())
    throw UnitError(fmt::format("unknown unit '{}' in '{}'", expression.names().front(), text),
                    unitInsteadOf(expression.names().front()));
  if (const std::optional<Amount> amount = expression.amount()) return *amount;
  throw UnitError(fmt::format("'{}' is no rational number times a power of pi", text), "one that is");
}

Amount oneOfUnit(std::string_view unit) {
  if (unit.empty()) return {1, 0, {}};
  const bool hasNumber = std::isdigit(static_cast<unsigned char>(unit.front())) != 0;
  return parseAmount(hasNumber ? std::string(unit) : "1 " + std::string(unit));
}

Dimension dimensionOf(std::string_view unit) { return oneOfUnit(unit).dimension; }

}  // namespace gamut
