// Numbers and expressions, for each scalar. Time derivatives are those of the recorded expression.
#include "mechanics/assembler.hpp"

#include <algorithm>

#include "mechanics/description/names.hpp"
#include "mechanics/description/orientation.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/fuzzy.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/recorded.hpp"
#include "scalars/samples.hpp"

namespace gamut {
namespace {

/// f, f' and f'' of an expression of time, as functions of its other names: time is the program's only state.
Program withDerivatives(const Expression& expression, const std::vector<std::string>& parameters) {
  const Program f = record(1, static_cast<int>(parameters.size()), 1, [&](auto, const auto& t, const auto& p, auto& y) {
    y[0] = expression.evaluate<Recorded>([&](const std::string& name) {
      const auto parameter = std::find(parameters.begin(), parameters.end(), name);
      return parameter == parameters.end() ? t[0] : p[parameter - parameters.begin()];
    });
  });
  return f.differentiated().differentiated();  // f, f', then the derivatives of both
}

}  // namespace

template <class S>
S Assembler<S>::number(const Expression& number) const {
  return number.evaluate<S>(
      [this](const std::string& name) {
        const auto parameter = parameters_.find(name);
        return parameter != parameters_.end() ? parameter->second : initials_.at(name);
      },
      [this](const auto& enclosure, const auto& exact) { return constantOf(enclosure, exact); });
}

template <class S>
std::optional<Interval> Assembler<S>::known(const Expression& number) const {
  for (const std::string& name : number.names())
    if (!known_.contains(name)) return std::nullopt;
  return number.evaluate<Interval>([this](const std::string& name) { return known_.at(name); });
}

template <class S>
S Assembler<S>::constantOf(const Interval& enclosure, const std::optional<Amount>& exact) const {
  if (!exact) return constant<S>(enclosure);
  const auto known = exact_.find({exact->value, exact->piPower});
  if (known != exact_.end()) return known->second;
  return exact_.emplace(std::pair{exact->value, exact->piPower}, constant<S>(enclosure)).first->second;
}

template <class S>
Vector3<S> Assembler<S>::vector(const ExpressionVector& numbers) const {
  return Vector3<S>(number(numbers[0]), number(numbers[1]), number(numbers[2]));
}

template <class S>
Matrix3<S> Assembler<S>::symmetric(const std::array<Expression, 6>& entries) const {
  const S xx = number(entries[0]), yy = number(entries[1]), zz = number(entries[2]);
  const S xy = number(entries[3]), yz = number(entries[4]), zx = number(entries[5]);
  Matrix3<S> matrix;
  matrix << xx, xy, zx, xy, yy, yz, zx, yz, zz;
  return matrix;
}

template <class S>
Rotation<S> Assembler<S>::rotation(const std::vector<FixedRotation>& rotations) const {
  Rotation<S> result;
  for (const FixedRotation& r : rotations) {
    if (r.quaternion) {
      const Quaternion<Expression> e = normalised(*r.quaternion);
      result = result.then(Rotation<S>(Quaternion<S>{number(e[0]), number(e[1]), number(e[2]), number(e[3])}));
      continue;
    }
    const S angle = number(r.angle);
    if (r.quarterTurns % 4 == 0 && isKnownZero(angle)) continue;
    result = result.then(Rotation<S>(r.axis, angle, r.quarterTurns));
  }
  return result;
}

template <class S>
Orientation<S> Assembler<S>::orientation(const std::string& rateKey, RatesIn in) {
  Orientation<S> own;
  own.in = in;
  for (std::size_t i = 0; i < 3; ++i) own.speeds[i] = &speed(rateKey + "." + components[i]);
  const auto key = [](std::size_t i) { return std::string("quaternion.") + quaternionComponents[i]; };
  for (std::size_t i = 0; i < 4; ++i) own.quaternion[i] = &values_.at(element_ + "." + key(i));
  for (std::size_t i = 0; i < 4; ++i) position(key(i), [own, i] { return own.quaternionRate(i); });
  return own;
}

template <class S>
S Assembler<S>::valueOf(const std::string& name) const {
  if (name == "t") return time_;
  const auto parameter = parameters_.find(name);
  if (parameter != parameters_.end()) return parameter->second;
  if (const auto measured = measured_.find(name); measured != measured_.end()) return measured->second();
  std::vector<std::string> known;
  for (const auto& [quantity, value] : measured_) known.push_back(quantity);
  throw UnknownName("output quantity", name, known);
}

template <class S>
Signal<S> Assembler<S>::signal(const Expression& expression) const {
  return [this, expression] {
    return expression.evaluate<S>(
        [this](const std::string& name) { return valueOf(name); },
        [this](const auto& enclosure, const auto& exact) { return constantOf(enclosure, exact); });
  };
}

template <class S>
TimeFunction<S> Assembler<S>::timeFunction(const Expression& expression) const {
  std::vector<std::string> names = expression.names();
  std::erase(names, "t");
  std::vector<S> values;
  for (const std::string& name : names) values.push_back(parameters_.at(name));
  return [this, program = withDerivatives(expression, names), values] {
    const std::vector<S> y = evaluate<S>(program, {time_}, values);
    return std::array<S, 3>{y[0], y[1], y[3]};
  };
}

GAMUT_COMPILED_HERE(Assembler)

}  // namespace gamut
