// Numbers of a mechanism as formulas over names, with units: "2 rod.length + 3 mm", "-k*angle - c*rate^3",
// "0.3 rad * sin(2*pi*t/period)". One formula serves every scalar; its dimensions are checked before it is computed.
//
// clang-format off
//   sum      = product { ("+" | "-") product }
//   product  = signed { ("*" | "·" | "/" | blank) signed }      from left to right; "/" divides by the next factor alone
//   signed   = { "-" | "+" } power
//   power    = primary [ "^" signed | "²" | "³" ]                -x^2 is -(x^2), 2^3^2 is 2^(3^2)
//   primary  = decimal | "pi" | unit | name | function "(" sum { "," sum } ")" | "(" sum ")"
// clang-format on
//
// A blank (or nothing, as in 90° and 0.75pi) joins a number to a unit, to pi or to a name, never two names. What is
// written without names is computed exactly as far as it is rational · πᵏ. A name is a word of letters, digits, "_" and
// "."; any other is put in single quotes. "t" is the time; right behind a number and a blank it is a tonne. Some units,
// as A and T, are what has that name where something has.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mechanics/description/units.hpp"
#include "scalars/interval.hpp"
#include "scalars/operations/all.hpp"
#include "scalars/traits.hpp"

namespace gamut {

class Expression {
 public:
  /// A number in the SI unit that is expected where it stands.
  Expression(double value) : Expression(Interval(value)) {}  // NOLINT(google-explicit-*): implicit, as numbers are
  Expression(const Interval& value);                         // NOLINT(google-explicit-*): implicit, as numbers are
  explicit Expression(const Amount& value);
  /// `factor` times what has this name.
  static Expression named(const std::string& name, const Interval& factor = 1.0);
  /// Whether a word is a name where it could be a unit as well (mayBeName); all such are if nothing is said.
  using IsName = std::function<bool(std::string_view word)>;
  /// Throws UnitError: what is wrong, at which column (from 1, in characters), and what was expected.
  static Expression parse(std::string_view text, const IsName& isName = nullptr);

  // Formulas of formulas; what is known to be zero or one is left out.
  friend Expression operator+(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a);
  friend Expression operator*(const Expression& a, const Expression& b);
  friend Expression operator/(const Expression& a, const Expression& b);
  friend Expression sqrt(const Expression& a);
  friend Expression sin(const Expression& a);
  friend Expression cos(const Expression& a);

  /// Each once, in the order of first use.
  const std::vector<std::string>& names() const { return names_; }
  bool isConstant() const { return names_.empty(); }
  /// Without abs, sign, min, max, where: it has derivatives wherever it has values.
  bool isSmooth() const;

  /// The whole as an exact number, if it is one.
  std::optional<Amount> amount() const;
  /// x, if the whole is abs(x).
  std::optional<Expression> insideOfAbs() const;
  /// With formulas in the place of names; null: the name stays.
  Expression with(const std::function<const Expression*(const std::string& name)>& instead) const;

  struct Affine {
    Interval factor, offset;
  };
  /// factor and offset of *this = factor part + offset, in SI units, if its form says so: wherever names are within
  /// `part` alone, and the factor is not 0.
  std::optional<Affine> affineIn(const Expression& part) const;
  /// The formulas within it that are no numbers, itself among them, the longest first.
  std::vector<Expression> parts() const;

  using DimensionOf = std::function<Dimension(const std::string& name)>;
  /// The dimension of the whole. Radians count as 1 and are kept for display. Throws UnitError where terms do not fit
  /// together.
  Dimension dimension(const DimensionOf& dimensionOf) const;
  /// Throws UnitError too if the whole is not of the kind of this unit; without names and units it always is.
  void check(const DimensionOf& dimensionOf, const std::string& unit) const;

  /// In SI units; `valueOf(name)` gives an S, and so does `constantOf(enclosure, exact)`: of a number, with the number
  /// itself where it is known.
  template <class S, class ValueOf, class ConstantOf>
  S evaluate(const ValueOf& valueOf, const ConstantOf& constantOf) const;
  template <class S, class ValueOf>
  S evaluate(const ValueOf& valueOf) const {
    return evaluate<S>(valueOf, [](const Interval& enclosure, const std::optional<Amount>& /*exact*/) {
      return constant<S>(enclosure);
    });
  }

 private:
  friend class ExpressionParser;

  enum class Operation : std::uint8_t {
    constant,
    name,  // index: which
    add,
    subtract,
    multiply,
    divide,
    negate,
    power,     // index: the exponent
    function,  // index: an Op
    sqrt,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    sinh,
    cosh,
    abs,
    sign,
    atan2,
    hypot,
    min,
    max,
    pow,
    where  // a condition, above 0 or not, and what is meant then and else
  };
  /// Postfix: operands come before what takes them.
  struct Term {
    Operation operation;
    int index = 0,
        column = 0;  // index: of a constant, a name; an Op; an exponent; 1 for the subtraction of a comparison
  };
  struct Constant {
    Interval enclosure;
    std::optional<Amount> exact = std::nullopt;
  };

  Expression() = default;
  Expression& append(const Expression& other);
  Expression& append(Operation operation);
  bool isExactly(double value) const;
  /// Whether these of its terms are the formula.
  bool holdsAt(std::size_t begin, std::size_t end, const Expression& formula) const;
  static int operands(Operation operation) {
    if (operation == Operation::where) return 3;
    return (operation >= Operation::add && operation <= Operation::divide) || operation >= Operation::atan2 ? 2 : 1;
  }

  std::vector<Term> terms_;
  std::vector<Constant> constants_;
  std::vector<std::string> names_;
};

/// Long, since it is a list: a line or two for each operation.
template <class S, class ValueOf, class ConstantOf>
S Expression::evaluate(const ValueOf& valueOf, const ConstantOf& constantOf) const {
  using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::hypot, std::max, std::min,
      std::pow, std::sin, std::sinh, std::sqrt, std::tan;
  std::vector<S> values;
  for (const Term& term : terms_) {
    if (term.operation == Operation::constant) {
      const Constant& number = constants_[term.index];
      values.push_back(constantOf(number.enclosure, number.exact));
      continue;
    }
    if (term.operation == Operation::name) {
      values.push_back(valueOf(names_[term.index]));
      continue;
    }
    const S y = values.back();
    if (operands(term.operation) > 1) values.pop_back();
    if (term.operation == Operation::where) {
      const S x = values.back();
      values.pop_back();
      values.back() = y + S(0.5) * (S(1.0) + signOf(values.back())) * (x - y);
      continue;
    }
    S& x = values.back();
    switch (term.operation) {
      case Operation::add:
        x = x + y;
        break;
      case Operation::subtract:
        x = x - y;
        break;
      case Operation::multiply:
        x = x * y;
        break;
      case Operation::divide:
        x = x / y;
        break;
      case Operation::negate:
        x = -y;
        break;
      case Operation::power:
        x = term.index == 2 ? square(y) : S(pow(y, term.index));
        break;
      case Operation::function:
        withFunction(static_cast<Op>(term.index), [&](auto f) {
          if constexpr (requires { f.of(y); }) x = f.of(y);
        });
        break;
      case Operation::sqrt:
        x = sqrt(y);
        break;
      case Operation::sin:
        x = sin(y);
        break;
      case Operation::cos:
        x = cos(y);
        break;
      case Operation::tan:
        x = tan(y);
        break;
      case Operation::asin:
        x = asin(y);
        break;
      case Operation::acos:
        x = acos(y);
        break;
      case Operation::atan:
        x = atan(y);
        break;
      case Operation::sinh:
        x = sinh(y);
        break;
      case Operation::cosh:
        x = cosh(y);
        break;
      case Operation::abs:
        x = abs(y);
        break;
      case Operation::sign:
        x = signOf(y);
        break;
      case Operation::atan2:
        x = atan2(S(x + S(0.0)), y);  // no zero has a sign
        break;
      case Operation::hypot:
        x = hypot(S(x), y);
        break;
      case Operation::min:
        x = min(S(x), y);
        break;
      case Operation::max:
        x = max(S(x), y);
        break;
      case Operation::pow:
        x = pow(S(x), y);
        break;
      case Operation::where:
      case Operation::constant:
      case Operation::name:
        break;
    }
  }
  return values.back();
}

}  // namespace gamut
