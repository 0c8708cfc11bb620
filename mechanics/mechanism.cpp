// The description of a mechanism: every name is checked when it is added, so that an assembly can rely on it.
#include "mechanics/mechanism.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <type_traits>

#include "mechanics/inertia.hpp"
#include "mechanics/names.hpp"

namespace gamut {
namespace {

constexpr std::array<const char*, 3> components = {".x", ".y", ".z"};

std::string quoted(const std::string& name) { return "'" + name + "'"; }

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> namesOf(const std::vector<Mechanism::NamedValue>& values) {
  std::vector<std::string> names;
  for (const auto& value : values) names.push_back(value.name);
  return names;
}

}  // namespace

Mechanism::Mechanism() : frames_{inertialFrame} {}

const Mechanism::NamedValue* Mechanism::find(const std::vector<NamedValue>& values, const std::string& name) {
  const auto found = std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.name == name; });
  return found == values.end() ? nullptr : &*found;
}

void Mechanism::addParameter(const std::string& name, const Interval& nominal, const std::string& unit) {
  checkParameterName(name);
  if (isEmpty(nominal) || !isBounded(nominal))
    refuse("the quantity " + quoted(name) + " needs a finite value, not " + toString(nominal));
  parameters_.push_back({name, unit, nominal});
}

void Mechanism::addDerived(const std::string& name, const Expression& formula) {
  checkParameterName(name);
  checkNames(formula, name);
  if (const std::vector<std::string> open = withoutUnit(formula); !open.empty())
    refuse("the parameter " + quoted(open[0]) + " has no unit, which the formula of " + quoted(name) + " needs");
  const Dimension dimension = formula.dimension([this](const std::string& used) { return dimensionOf(unitOf(used)); });
  derived_.push_back({name, gamut::unitOf(dimension), formula});
}

void Mechanism::checkParameterName(const std::string& name) const {
  if (name.empty()) refuse("a parameter needs a name");
  if (knows(name) || find(initials_, name) != nullptr) refuse("the quantity " + quoted(name) + " is defined twice");
  const bool isQuantity = name == "energy" || name == "gravity" || name == "t";
  if (unitNamed(name) != nullptr || isQuantity || name == "pi")
    refuse("a parameter cannot be named " + quoted(name) + ": that is a " +
           (isQuantity     ? "quantity"
            : name == "pi" ? "number"
                           : "unit"));
}

const Mechanism::Derived* Mechanism::findDerived(const std::string& name) const {
  const auto found = std::ranges::find(derived_, name, &Derived::name);
  return found == derived_.end() ? nullptr : &*found;
}

std::vector<std::string> Mechanism::withoutUnit(const Expression& number) const {
  std::vector<std::string> open = number.names();
  std::erase_if(open, [&](const std::string& name) {
    const NamedValue* parameter = find(parameters_, name);
    return parameter == nullptr || !parameter->unit.empty();
  });
  return open;
}

bool Mechanism::dependsOn(const Expression& number, const std::string& parameter) const {
  return std::ranges::any_of(number.names(), [&](const std::string& name) {
    const Derived* derived = findDerived(name);
    return name == parameter || (derived != nullptr && dependsOn(derived->formula, parameter));
  });
}

void Mechanism::checkNewName(const std::string& kind, const std::string& name) const {
  if (name.empty()) refuse("a " + kind + " needs a name");
  if (has(names_, name)) refuse("two elements are named " + quoted(name) + "; every element needs a name of its own");
  if (name == "energy" || name == "gravity")
    refuse("an element cannot be named " + quoted(name) + ": that is a quantity");
}

void Mechanism::checkFrame(const std::string& frame, const std::string& of) const {
  if (!has(frames_, frame))
    throw UnknownName("frame", frame, frames_, quoted(of) + " must come after the element that defines its frame");
}

void Mechanism::addFrame(const std::string& from, const std::string& to, const std::string& of) {
  checkFrame(from, of);
  if (to.empty()) refuse("the element " + quoted(of) + " needs the name of the frame that it moves");
  if (has(frames_, to)) refuse("the frame " + quoted(to) + " is defined twice; " + quoted(of) + " needs a new frame");
  if (has(masses(), to)) refuse("the frame " + quoted(to) + " is named like a mass");
  if (to == "energy" || to == "gravity") refuse("a frame cannot be named " + quoted(to) + ": that is a quantity");
  frames_.push_back(to);
}

void Mechanism::use(Expression& number, const std::string& name, const std::string& unit) {
  const Dimension expected = dimensionOf(unit);
  if (number.isConstant()) {
    check(number, name, expected);
    addParameter(name, number.evaluate<Interval>([](const std::string&) { return Interval::entire(); }), unit);
    number = Expression::named(name);
    return;
  }
  const Dimension assumed = check(number, name, expected);
  if (const std::vector<std::string> open = withoutUnit(number); open.size() == 1)
    std::ranges::find(parameters_, open[0], &NamedValue::name)->unit =
        assumed == expected ? unit : gamut::unitOf(assumed);
}

void Mechanism::checkNames(const Expression& number, const std::string& name) const {
  for (const std::string& used : number.names()) {
    if (knows(used)) continue;
    std::vector<std::string> known = namesOf(parameters_);
    for (const Derived& derived : derived_) known.push_back(derived.name);
    throw UnknownName("parameter", used, known, "for " + quoted(name));
  }
}

Dimension Mechanism::check(const Expression& number, const std::string& name, const Dimension& expected) const {
  checkNames(number, name);
  const std::vector<std::string> open = withoutUnit(number);
  const auto dimensionOfNames = [&](const Dimension& assumed) {
    return [&open, assumed, this](const std::string& used) {
      return open.size() == 1 && open[0] == used ? assumed : dimensionOf(unitOf(used));
    };
  };
  const auto fits = [&](const Dimension& assumed) {
    try {
      number.check(dimensionOfNames(assumed), expected);
      return true;
    } catch (const UnitError&) {
      return false;
    }
  };
  for (const Dimension& assumed : {expected, Dimension{}})
    if (fits(assumed)) return assumed;
  const Expression::DimensionOf dimensionOfName = dimensionOfNames(expected);
  try {
    if (number.names().size() == 1)
      if (const Dimension own = dimensionOfName(number.names()[0]); number.dimension(dimensionOfName) == own)
        throw WrongUnit(number.names()[0], gamut::unitOf(own), name, gamut::unitOf(expected));
    number.check(dimensionOfName, expected);
  } catch (const UnitError& error) {
    throw UnitError(quoted(name) + ": " + error.what());
  }
  return {};
}

void Mechanism::use(ExpressionVector& vector, const std::string& name, const std::string& unit) {
  for (std::size_t i = 0; i < 3; ++i) use(vector[i], name + components[i], unit);
}

void Mechanism::addState(std::vector<State>& states, const std::string& name, const std::string& unit,
                         const Expression& initial) {
  State state{name, unit, initial};
  if (initial.isConstant()) {
    if (isParameter(name)) refuse("the quantity " + quoted(name) + " is defined twice");
    check(initial, name, dimensionOf(unit));
    const Interval value = initial.evaluate<Interval>([](const std::string&) { return Interval::entire(); });
    if (isEmpty(value) || !isBounded(value))
      refuse("the initial value " + quoted(name) + " needs a finite value, not " + toString(value));
    initials_.push_back({name, unit, value});
    state.initial = Expression::named(name);
  } else {
    use(state.initial, name, unit);
  }
  states.push_back(state);
}

template <class Description>
void Mechanism::keep(Description element) {
  names_.push_back(element.name);
  elements_.emplace_back(std::move(element));
}

void Mechanism::add(Revolute joint) {
  checkNewName("revolute joint", joint.name);
  addFrame(joint.from, joint.to, joint.name);
  addState(positions_, joint.name + ".angle", "rad", joint.angle);
  addState(rates_, joint.name + ".rate", "rad/s", joint.rate);
  keep(std::move(joint));
}

void Mechanism::add(Prismatic joint) {
  checkNewName("prismatic joint", joint.name);
  addFrame(joint.from, joint.to, joint.name);
  addState(positions_, joint.name + ".displacement", "m", joint.displacement);
  addState(rates_, joint.name + ".rate", "m/s", joint.rate);
  keep(std::move(joint));
}

void Mechanism::add(Link link) {
  checkNewName("link", link.name);
  addFrame(link.from, link.to, link.name);
  use(link.vector, link.name + ".vector", "m");
  for (std::size_t i = 0; i < link.rotation.size(); ++i)
    use(link.rotation[i].angle, link.name + ".rotation." + std::to_string(i + 1), "rad");
  keep(std::move(link));
}

void Mechanism::add(Mass mass) {
  checkNewName("mass", mass.name);
  checkFrame(mass.at, mass.name);
  if (has(frames_, mass.name)) refuse("the mass " + quoted(mass.name) + " is named like a frame");
  use(mass.mass, mass.name + ".mass", "kg");
  use(mass.centre, mass.name + ".centre", "m");
  constexpr std::array<const char*, 6> entries = {"xx", "yy", "zz", "xy", "yz", "zx"};
  for (std::size_t i = 0; i < 6; ++i) use(mass.inertia[i], mass.name + ".inertia." + entries[i], "kg m^2");
  keep(std::move(mass));
}

void Mechanism::add(Spring spring) {
  checkNewName("spring", spring.name);
  checkFrame(spring.from, spring.name);
  checkFrame(spring.to, spring.name);
  if (spring.from == spring.to) refuse("the spring " + quoted(spring.name) + " needs two different frames");
  use(spring.stiffness, spring.name + ".stiffness", "N/m");
  use(spring.restLength, spring.name + ".rest_length", "m");
  use(spring.damping, spring.name + ".damping", "N s/m");
  use(spring.fromPoint, spring.name + ".from_point", "m");
  use(spring.toPoint, spring.name + ".to_point", "m");
  keep(std::move(spring));
}

void Mechanism::add(JointSpring spring) {
  checkNewName("joint spring", spring.name);
  const auto joint = std::find_if(positions_.begin(), positions_.end(), [&](const State& state) {
    return state.name == spring.joint + ".angle" || state.name == spring.joint + ".displacement";
  });
  if (joint == positions_.end()) throw UnknownName("joint", spring.joint, joints(), "for " + quoted(spring.name));
  const bool angular = joint->unit == "rad";
  use(spring.stiffness, spring.name + ".stiffness", angular ? "N m/rad" : "N/m");
  use(spring.rest, spring.name + ".rest", joint->unit);
  use(spring.damping, spring.name + ".damping", angular ? "N m s/rad" : "N s/m");
  keep(std::move(spring));
}

void Mechanism::setGravity(ExpressionVector gravity) {
  if (gravity_) refuse("gravity is set twice");
  use(gravity, "gravity", "m/s^2");
  gravity_ = std::move(gravity);
}

void Mechanism::check() const {
  if (positions_.empty()) refuse("the mechanism has no joint: nothing can move");
  for (const ElementDescription& element : elements_)
    if (const Mass* mass = std::get_if<Mass>(&element))
      if (const std::string fault = inertiaFault(*mass, {}); !fault.empty()) refuse(fault);
}

std::string Mechanism::inertiaFault(const Mass& mass, const std::map<std::string, Interval>& ranges) const {
  std::vector<std::string> varied;  // of the parameters that have a range, those of the entries
  for (const auto& [name, range] : ranges)
    if (varied.size() < 12 &&
        std::ranges::any_of(mass.inertia, [&](const auto& entry) { return dependsOn(entry, name); }))
      varied.push_back(name);
  // The tensors that a body can have are a convex cone: where each entry is affine in one parameter, what holds at the
  // corners of the box holds in all of it.
  for (unsigned corner = 0; corner < (1U << varied.size()); ++corner) {
    std::map<std::string, Interval> point;
    for (std::size_t i = 0; i < varied.size(); ++i) {
      const Interval& range = ranges.at(varied[i]);
      point[varied[i]] = ((corner >> i) & 1U) != 0 ? range.upper() : range.lower();
    }
    std::array<Interval, 6> tensor;
    std::transform(mass.inertia.begin(), mass.inertia.end(), tensor.begin(),
                   [&](const Expression& entry) { return rangeOf(entry, point); });
    const std::string fault = impossibilityOf(tensor);
    if (!fault.empty()) return "the inertia of " + quoted(mass.name) + " " + fault;
  }
  return "";
}

void Mechanism::checkMasses() const {
  std::map<std::string, std::string> before;  // frame -> the frame that moves it
  std::map<std::string, std::string> joint;   // frame -> the joint that moves it
  std::map<std::string, bool> carries;        // frame -> whether a mass hangs on it
  for (const ElementDescription& element : elements_) {
    std::visit(
        [&]<class Description>(const Description& e) {
          if constexpr (requires { e.from, e.to, e.axis; } || std::is_same_v<Description, Link>) before[e.to] = e.from;
          if constexpr (requires { e.axis; }) joint[e.to] = e.name;
          if constexpr (std::is_same_v<Description, Mass>)
            for (std::string at = e.at; !carries[at] && !at.empty(); at = before[at]) carries[at] = true;
        },
        element);
  }
  for (const auto& [frame, name] : joint)
    if (!carries[frame])
      refuse("the joint " + quoted(name) + " moves no mass; add a mass at the frame " + quoted(frame) +
             " or at one that it carries");
}

std::vector<std::string> Mechanism::masses() const {
  std::vector<std::string> names;
  for (const ElementDescription& element : elements_)
    if (const Mass* mass = std::get_if<Mass>(&element)) names.push_back(mass->name);
  return names;
}

std::vector<std::string> Mechanism::joints() const {
  std::vector<std::string> names;
  for (const ElementDescription& element : elements_)
    std::visit(
        [&](const auto& e) {
          if constexpr (requires { e.axis; }) names.push_back(e.name);
        },
        element);
  return names;
}

std::vector<std::string> Mechanism::quantities() const {
  std::vector<std::string> names = namesOf(initials_);
  for (const NamedValue& parameter : parameters_) names.push_back(parameter.name);
  return names;
}

Interval Mechanism::nominal(const std::string& quantity) const {
  for (const auto* values : {&initials_, &parameters_})
    if (const NamedValue* value = find(*values, quantity)) return value->nominal;
  if (const Derived* derived = findDerived(quantity)) return rangeOf(derived->formula);
  refuse(unknownName("quantity", quantity, quantities()));
}

Interval Mechanism::rangeOf(const Expression& number, const std::map<std::string, Interval>& ranges) const {
  return number.evaluate<Interval>([&](const std::string& name) {
    if (const auto range = ranges.find(name); range != ranges.end()) return range->second;
    const Derived* derived = findDerived(name);
    return derived == nullptr ? nominal(name) : rangeOf(derived->formula, ranges);
  });
}

std::vector<std::string> Mechanism::stateNames() const {
  std::vector<std::string> names;
  for (const auto* states : {&positions_, &rates_})
    for (const State& state : *states) names.push_back(state.name);
  return names;
}

std::vector<Expression> Mechanism::initialState() const {
  std::vector<Expression> initial;
  for (const auto* states : {&positions_, &rates_})
    for (const State& state : *states) initial.push_back(state.initial);
  return initial;
}

std::vector<std::string> Mechanism::outputQuantities() const {
  std::vector<std::string> names = stateNames(), places(frames_.begin() + 1, frames_.end());
  for (const std::string& mass : masses()) places.push_back(mass);
  for (const std::string& place : places)
    for (const char* what : {".position", ".velocity"})
      for (const char* component : components) names.push_back(place + what + component);
  for (const char* energy : {"energy", "energy.kinetic", "energy.potential"}) names.emplace_back(energy);
  return names;
}

std::string Mechanism::unitOf(const std::string& quantity) const {
  for (const auto* states : {&positions_, &rates_})
    for (const State& state : *states)
      if (state.name == quantity) return state.unit;
  if (const NamedValue* parameter = find(parameters_, quantity)) return parameter->unit;
  if (const Derived* derived = findDerived(quantity)) return derived->unit;
  const std::vector<std::string> outputs = outputQuantities();
  if (has(outputs, quantity)) {
    if (quantity.starts_with("energy")) return "J";
    // The last two parts say what it is; a frame's own name may hold dots.
    return quantity.substr(0, quantity.size() - 2).ends_with(".velocity") ? "m/s" : "m";
  }
  std::vector<std::string> known = quantities();
  known.insert(known.end(), outputs.begin(), outputs.end());
  refuse(unknownName("quantity", quantity, known));
}

}  // namespace gamut
