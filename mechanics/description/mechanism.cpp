// The description of a mechanism: every name is checked when it is added, so that an assembly can rely on it.
#include "mechanics/description/mechanism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "mechanics/description/loop_structure.hpp"
#include "mechanics/description/names.hpp"
#include "mechanics/description/quantities.hpp"
#include "mechanics/description/refusal.hpp"

namespace gamut {
namespace {

/// Stands for an element where its expressions are checked.
constexpr const char* baseAccelerationName = "base_acceleration";

[[noreturn]] void refuse(const std::string& problem, const std::string& expected = "") {
  throw Refusal(problem, expected);
}

/// Elements that move the frames from one to the other.
std::unordered_set<std::string> elementsBetween(const Mechanism& mechanism, const std::string& from,
                                                const std::string& to) {
  const auto inwards = [&](std::string frame) {
    std::vector<std::string> frames;
    for (const auto* moved = mechanism.moved().find(frame); moved != nullptr; moved = mechanism.moved().find(frame)) {
      frames.push_back(frame);
      frame = moved->from;
    }
    return frames;
  };
  std::vector<std::string> one = inwards(to), other = inwards(from);
  while (!one.empty() && !other.empty() && one.back() == other.back()) {
    one.pop_back();
    other.pop_back();
  }
  std::unordered_set<std::string> elements;
  for (const auto* side : {&one, &other})
    for (const std::string& frame : *side) elements.insert(mechanism.moved().find(frame)->element);
  return elements;
}

/// Whether the joint that is described slides along this direction.
bool slidesAlong(Described joint, const Axis& along) {
  class Finder final : public Onlooker {
   public:
    void jointAxis(const Word&, Axis& axis, const std::string&) override { found = axis; }
    std::optional<Axis> found;
  } finder;
  joint.describe(finder);
  return finder.found && finder.found->isParallelTo(along);
}

/// Names of whole quantities, which parts of a mechanism must not have.
bool isQuantity(const std::string& name) {
  return name == "gravity" || name == "t" || name == baseAccelerationName ||
         std::ranges::any_of(wholeQuantities(), [&](const WholeQuantity& whole) {
           return whole.name.substr(0, whole.name.find('.')) == name;
         });
}

/// Whether a formula would take the name for a number.
bool isNumber(const std::string& name) {
  try {
    return Expression::parse(name).isConstant();
  } catch (const UnitError&) {
    return false;
  }
}

bool isReserved(const std::string& name) { return unitNamed(name) != nullptr && !mayBeName(name); }

/// What an unknown name was for; of two units written together, as they should be.
std::string remarkOn(const std::string& name, const std::string& use) {
  if (const std::string apart = unitsApart(name); !apart.empty())
    return "for " + inQuotes(use) + ", or " + inQuotes(apart) +
           (apart.find(' ') == std::string::npos ? "" : " with a blank between units");
  if (const std::string unit = nearestUnit(name); !unit.empty())
    return "for " + inQuotes(use) + ", or the unit " + inQuotes(unit);
  return "for " + inQuotes(use);
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string wordFor(const Axis& axis) {
  const auto [x, y, z] = axis.direction();
  return axis.isAligned() ? components[static_cast<std::size_t>(axis.index())]
                          : fmt::format("[{:.6g}, {:.6g}, {:.6g}]", x, y, z);
}

/// What a closure need not hold.
std::string sentenceOnLeftOut(const std::string& element, const std::string& frame, const HeldRows& wanted,
                              const HeldRows& left) {
  const bool isAlong = wanted.along && !left.along, isAcross = wanted.across && !left.across;
  std::string what;
  if (isAlong || isAcross) what = "its points stay together";
  if (isAlong != isAcross)
    what += fmt::format(" {} {} of '{}'", isAlong ? "along" : "across", wordFor(*left.axis), frame);
  if (wanted.parallel && !left.parallel) what += std::string(what.empty() ? "" : " and ") + "its axes stay parallel";
  const std::string count = left.count() == 0 ? "none" : std::to_string(left.count());
  return fmt::format(
      "'{}' holds {} of its {} rows, as {} whatever the joints between its frames do; it bears nothing there", element,
      count, wanted.count(), what);
}

std::vector<std::string> namesOf(const Named<Mechanism::NamedValue>& values) {
  std::vector<std::string> names;
  for (const auto& value : values) names.push_back(value.name);
  return names;
}

}  // namespace

Mechanism::Mechanism() : isFrame_{inertialFrame}, frames_{inertialFrame} {}

void Mechanism::addParameter(const std::string& name, const Interval& nominal, const std::string& unit) {
  checkParameterName(name);
  if (isEmpty(nominal) || !isBounded(nominal))
    refuse("the quantity " + inQuotes(name) + " needs a finite value, not " + toString(nominal));
  parameters_.add({name, unit, nominal});
}

void Mechanism::addParameter(const std::string& name, const Amount& nominal, const std::string& unit) {
  addParameter(name, enclose(nominal), unit);
  parameters_.find(name)->exact = nominal;
}

void Mechanism::addDerived(const std::string& name, const Expression& formula) {
  checkParameterName(name);
  checkNames(formula, name);
  for (const std::string& open : withoutUnit(formula)) parameters_.find(open)->unit = "1";
  try {
    derived_.add({name, gamut::unitOf(dimensionOf(formula)), formula});
  } catch (const UnitError& error) {
    throw WrongNumber(name, error.problem(), error.expected());
  }
}

void Mechanism::checkParameterName(const std::string& name) const {
  if (name.empty()) refuse("a parameter needs a name");
  if (knows(name) || initials_.find(name) != nullptr)
    refuse("the quantity " + inQuotes(name) + " is defined twice", "another name");
  if (isReserved(name) || isQuantity(name) || name == "pi")
    refuse("a parameter cannot be named " + inQuotes(name) + ": that is a " +
               (isQuantity(name) ? "quantity"
                : name == "pi"   ? "number"
                                 : "unit"),
           "another name");
}

std::vector<std::string> Mechanism::withoutUnit(const Expression& number) const {
  std::vector<std::string> open = number.names();
  std::erase_if(open, [&](const std::string& name) {
    const NamedValue* parameter = parameters_.find(name);
    return parameter == nullptr || !parameter->unit.empty();
  });
  return open;
}

bool Mechanism::dependsOn(const Expression& number, const std::string& parameter) const {
  return std::ranges::any_of(number.names(), [&](const std::string& name) {
    const Derived* derived = derived_.find(name);
    return name == parameter || (derived != nullptr && dependsOn(derived->formula, parameter));
  });
}

std::unordered_set<std::string> Mechanism::needsOf(const Expression& number) const {
  std::unordered_set<std::string> needed;
  std::vector<std::string> open = number.names();
  while (!open.empty()) {
    const std::string name = std::move(open.back());
    open.pop_back();
    if (!needed.insert(name).second) continue;
    if (const Derived* derived = derived_.find(name))
      open.insert(open.end(), derived->formula.names().begin(), derived->formula.names().end());
  }
  return needed;
}

void Mechanism::checkNewName(const std::string& kind, const std::string& name) const {
  if (name.empty()) refuse("a " + kind + " needs a name");
  if (names_.contains(name)) refuse("two elements are named " + inQuotes(name), "a name of its own");
  if (isQuantity(name)) refuse("an element cannot be named " + inQuotes(name) + ": that is a quantity", "another name");
}

void Mechanism::checkFrame(const std::string& frame, const std::string& of) const {
  if (!isFrame_.contains(frame))
    throw UnknownName("frame", frame, frames_, inQuotes(of) + " must come after the element that defines its frame");
}

void Mechanism::addFrame(const std::string& from, const std::string& to, const std::string& of) {
  checkFrame(from, of);
  if (to.empty()) refuse("the element " + inQuotes(of) + " needs the name of the frame that it moves");
  if (isFrame_.contains(to))
    refuse("the frame " + inQuotes(to) + " is defined twice",
           "a new frame for " + inQuotes(of) +
               " (frames form a tree, and a `closure` or a `rod` closes loops between two)");
  if (unitOfMeasured(to + ".position.x") != nullptr)
    refuse("the frame " + inQuotes(to) + " has the name of an element whose position is measured", "another name");
  if (isQuantity(to)) refuse("a frame cannot be named " + inQuotes(to) + ": that is a quantity", "another name");
  frames_.push_back(to);
  isFrame_.insert(to);
}

void Mechanism::use(Expression& number, const std::string& name, const std::string& unit) {
  if (number.isConstant()) {
    check(number, name, unit);
    if (const std::optional<Amount> exact = number.amount())
      addParameter(name, *exact, unit);
    else
      addParameter(name, number.evaluate<Interval>([](const std::string&) { return Interval::entire(); }), unit);
    number = Expression::named(name);
    return;
  }
  checkNames(number, name);
  const Dimension assumed = check(number, name, unit);
  if (const std::vector<std::string> open = withoutUnit(number); open.size() == 1)
    parameters_.find(open[0])->unit = assumed == gamut::dimensionOf(unit) ? unit : gamut::unitOf(assumed);
}

void Mechanism::checkNames(const Expression& number, const std::string& name) const {
  for (const std::string& used : number.names()) {
    if (knows(used)) continue;
    if (used == "t" || unitOfMeasured(used) != nullptr)
      throw WrongNumber(name, inQuotes(used) + " changes in motion", "a formula of parameters alone");
    const std::vector<std::string> known = parameterNames();
    throw UnknownName("parameter", used, known, remarkOn(used, name), name);
  }
}

Dimension Mechanism::check(const Expression& number, const std::string& name, const std::string& unit) const {
  const Dimension expected = gamut::dimensionOf(unit);
  const std::vector<std::string> open = withoutUnit(number);
  const auto dimensionOfNames = [&](const Dimension& assumed) {
    return [&open, assumed, this](const std::string& used) {
      if (used == "t") return gamut::dimensionOf("s");
      return open.size() == 1 && open[0] == used ? assumed : gamut::dimensionOf(unitOf(used));
    };
  };
  const auto fits = [&](const Dimension& assumed) {
    try {
      number.check(dimensionOfNames(assumed), unit);
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
        throw WrongUnit(knows(number.names()[0]) ? "parameter" : "quantity", number.names()[0], gamut::unitOf(own),
                        name, unit);
    number.check(dimensionOfName, unit);
  } catch (const UnitError& error) {
    throw WrongNumber(name, error.problem(), error.expected());
  }
  return {};
}

void Mechanism::addState(Named<State>& states, const std::string& name, const std::string& unit,
                         const Expression& initial) {
  State state{name, unit, initial};
  if (unitOfMeasured(name) != nullptr) refuse("the quantity " + inQuotes(name) + " is defined twice", "another name");
  if (initial.isConstant()) {
    if (knows(name)) refuse("the quantity " + inQuotes(name) + " is defined twice", "another name");
    check(initial, name, unit);
    const Interval value = initial.evaluate<Interval>([](const std::string&) { return Interval::entire(); });
    if (isEmpty(value) || !isBounded(value))
      refuse("the initial value " + inQuotes(name) + " needs a finite value, not " + toString(value));
    initials_.add({name, unit, value});
    state.initial = Expression::named(name);
  } else {
    use(state.initial, name, unit);
  }
  states.add(std::move(state));
}

void Mechanism::addMeasured(const std::string& name, const std::string& unit, const std::string& of, bool isSolved,
                            bool isMotion) {
  if (unitOfMeasured(name) != nullptr || knows(name))
    refuse("the quantity " + inQuotes(name) + " of " + inQuotes(of) + " is defined twice");
  measured_.add({name, unit, of, isSolved, isMotion});
}

void Mechanism::measureModes() {
  for (int mode = 1; mode <= degreesOfFreedom(); ++mode) {
    addMeasured("frequency." + std::to_string(mode), "Hz", "modes", true);
    addMeasured("damping." + std::to_string(mode), "1", "modes", true);
  }
}

std::string Mechanism::accelerationOf(const std::string& speed) {
  for (std::size_t at = speed.rfind("rate"); at != std::string::npos && at > 0; at = speed.rfind("rate", at - 1))
    if (speed[at - 1] == '.' || speed[at - 1] == '_')
      return speed.substr(0, at) + "acceleration" + speed.substr(at + 4);
  return speed + "_acceleration";
}

std::string Mechanism::reactionOf(const std::string& frame) const {
  const std::string& element = moved_.find(frame)->element;
  return element + (firstFrames_.at(element) == frame ? "" : "." + frame) + ".reaction";
}

void Mechanism::addSignal(Signal signal, Expression& expression) {
  if (std::ranges::all_of(expression.names(), [&](const std::string& used) { return knows(used); }))
    use(expression, signal.name, signal.unit);
  else
    signals_[signal.element].push_back(std::move(signal));
}

void Mechanism::drive(const std::string& coordinate, const std::string& by) {
  JointCoordinate* const driven = coordinates_.find(coordinate);
  if (driven->isDriven)
    refuse("the joint " + inQuotes(coordinate) + " is driven twice, the second time by " + inQuotes(by),
           "one drive, coupling or motion a joint");
  if (const auto end = struck_.find(coordinate); end != struck_.end())
    refuse("the joint " + inQuotes(coordinate) + " is driven by " + inQuotes(by) + ", so that it cannot strike " +
               inQuotes(end->second),
           "a joint that moves freely");
  if (driven->isDependent)
    refuse("the joint " + inQuotes(coordinate) + " closes a loop, but is driven by " + inQuotes(by),
           "its drive ahead of the loop, which then is closed by another joint");
  for (const std::string& name : {driven->name, driven->rate})
    requireNoInitial(name, *driven, "is driven by " + inQuotes(by));
  initials_.erase(driven->name);
  initials_.erase(driven->rate);
  positions_.erase(driven->name);
  speeds_.erase(driven->rate);
  driven->isDriven = true;
}

void Mechanism::requireNoInitial(const std::string& number, const JointCoordinate& of, const std::string& by) const {
  const NamedValue* initial = initials_.find(number);
  if (initial == nullptr || !isEqual(initial->nominal, Interval(0.0)))
    refuse("the joint " + inQuotes(of.element) + " has " + (of.isDependent ? "an initial rate" : "initial values") +
               ", but " + by,
           of.isDependent ? "none: it follows from the rates of the others, or other coordinates in `dependent`"
                          : "no initial values: it starts where it is driven");
}

void Mechanism::depend(const std::string& coordinate, const std::string& by) {
  JointCoordinate& dependent = *coordinates_.find(coordinate);
  const std::string use = "the joint " + inQuotes(coordinate) + " cannot close " + inQuotes(by) + ": it ";
  if (dependent.isDriven) refuse(use + "is driven", "a joint that moves freely");
  if (dependent.isDependent) refuse(use + "closes another loop, or is named twice", "another joint");
  if (const auto end = struck_.find(coordinate); end != struck_.end())
    refuse(use + "strikes " + inQuotes(end->second), "another joint");
  dependent.isDependent = true;
  requireNoInitial(dependent.rate, dependent, "closes " + inQuotes(by));
  initials_.erase(dependent.rate);
  speeds_.erase(dependent.rate);
  State& position = *positions_.find(coordinate);
  if (const NamedValue* guess = initials_.find(coordinate)) {
    position.initial = guess->nominal;
    initials_.erase(coordinate);
  }
  dependents_.push_back(coordinate);
}

std::vector<std::string> Mechanism::coordinatesBetween(const std::string& from, const std::string& to,
                                                       std::size_t needed) const {
  const std::unordered_set<std::string> elements = elementsBetween(*this, from, to);
  std::vector<std::string> names;
  for (const JointCoordinate& coordinate : coordinates_)
    if (elements.contains(coordinate.element) && !coordinate.isDriven && !coordinate.isDependent &&
        !isStruck(coordinate.name))
      names.push_back(coordinate.name);
  std::vector<std::string> still = names;
  std::erase_if(still, [this](const std::string& name) { return !startsWithoutRate(*coordinates_.find(name)); });
  return still.size() < needed ? names : still;
}

bool Mechanism::isFreeParameter(const std::string& quantity) const {
  if (positions_.find(quantity) != nullptr) return isClosed();
  if (isSpeed(quantity)) return areLoopsHeld();
  return ownStates_.find(quantity) == nullptr;
}

bool Mechanism::startsWithoutRate(const JointCoordinate& coordinate) const {
  const NamedValue* rate = initials_.find(coordinate.rate);
  return coordinate.isDependent || (rate != nullptr && isEqual(rate->nominal, Interval(0.0)));
}

void Mechanism::holdLoops() {
  for (const std::string& name : dependents_) {
    const JointCoordinate& coordinate = *coordinates_.find(name);
    if (!isSpeed(coordinate.rate))
      speeds_.add({coordinate.rate, std::string(gamut::unitOf(coordinate.kind)) + "/s", 0.0});
  }
}

std::vector<std::string> Mechanism::dependentRates() const {
  std::vector<std::string> names;
  for (const std::string& name : dependents_) names.push_back(coordinates_.find(name)->rate);
  return names;
}

/// Visits an element that is being added.
class Mechanism::Checker final : public Fields {
 public:
  Checker(Mechanism& mechanism, const Described& element)
      : m_(mechanism), type_(element.type()), element_(element.name()) {}

  void frame(const Word& /*word*/, std::string& name) override { m_.checkFrame(name, element_); }
  void otherFrame(const Word& word, std::string& name, const std::string& other) override {
    frame(word, name);
    if (name == other) refuse("the element " + inQuotes(element_) + " joins a frame to itself", "two different frames");
  }
  void carriesMass(const FixedPoint& centre, const Expression& /*mass*/,
                   std::span<const Expression> /*inertia*/) override {
    if (m_.isFrame_.contains(element_))
      refuse("the element " + inQuotes(element_) + " has the name of a frame", "another name");
    m_.massFrames_.push_back(centre.frame);
  }
  void movedFrame(const Word& /*word*/, std::string& name, const std::string& from) override {
    m_.addFrame(from, name, element_);
    m_.moved_.add({name, from, element_, false});
    m_.firstFrames_.emplace(element_, name);
    for (const FrameQuantity& quantity : frameQuantities())
      m_.addMeasured(name + "." + quantity.name, quantity.unit, element_, quantity.isSolved);
    const std::string reaction = m_.reactionOf(name);
    for (const char* component : components) m_.addMeasured(reaction + ".force." + component, "N", element_, true);
    for (const char* component : components) m_.addMeasured(reaction + ".moment." + component, "N m", element_, true);
  }
  void choice(const Word& word, std::string& value, const std::vector<std::string>& choices) override {
    if (!has(choices, value))
      refuse("the " + word.key + " of " + inQuotes(element_) + " is " + inQuotes(value) + ", not " +
             expectedName(value, choices));
  }
  void axis(const Word& /*word*/, Axis& /*axis*/) override {}
  void rotations(const Word& word, std::vector<FixedRotation>& rotations) override {
    for (std::size_t i = 0; i < rotations.size(); ++i) {
      auto& [axis, quarterTurns, angle, key, quaternion] = rotations[i];
      if (quaternion)
        numbers({word.key, "1"}, *quaternion, quaternionComponents, 4);
      else
        m_.use(angle, named(word) + "." + (key.empty() ? std::to_string(i + 1) : key), "rad");
      if (quaternion && std::ranges::all_of(*quaternion, [&](const Expression& component) {
            return isEqual(m_.rangeOf(component), Interval(0.0));
          }))
        refuse("the quaternion of " + inQuotes(element_) + " is zero, which is no orientation",
               "four numbers of which one is not zero");
    }
  }
  void count(const Word& word, std::size_t& number, std::size_t most) override {
    if (number > most)
      refuse("the " + word.key + " of " + inQuotes(element_) + " is " + std::to_string(number),
             "a whole number from 0 to " + std::to_string(most));
  }
  void number(const Word& word, Expression& number) override { m_.use(number, named(word), word.unit); }
  void numbers(const Word& word, std::span<Expression> numbers, std::span<const char* const> names,
               std::size_t /*least*/) override {
    for (std::size_t i = 0; i < numbers.size(); ++i) m_.use(numbers[i], named(word) + "." + names[i], word.unit);
  }

  void coordinate(const Word& position, Expression& initial, Coordinate kind, const Word& rate,
                  Expression& initialRate) override {
    m_.addState(m_.positions_, named(position), gamut::unitOf(kind), initial);
    m_.addState(m_.speeds_, named(rate), std::string(gamut::unitOf(kind)) + "/s", initialRate);
    m_.coordinates_.add({element_, named(position), named(rate), kind});
    m_.coordinateOfRate_.emplace(named(rate), named(position));
    m_.coordinatesOf_[element_].push_back(named(position));
    m_.addMeasured(accelerationOf(named(rate)), std::string(gamut::unitOf(kind)) + "/s^2", element_, true);
    movesByJoint();
  }
  void position(const Word& word, Expression& initial) override {
    m_.addState(m_.positions_, named(word), word.unit, initial);
  }
  void speed(const Word& word, Expression& initial) override {
    m_.addState(m_.speeds_, named(word), word.unit, initial);
    m_.addMeasured(accelerationOf(named(word)), rateUnitOf(word.unit), element_, true);
    movesByJoint();
  }
  std::string state(const Word& word, Expression& initial) override {
    if (isReserved(element_) || element_ == "pi" || isNumber(element_))
      refuse("a state cannot be named " + inQuotes(element_) + ": that is a unit or a number", "another name");
    std::string unit = word.unit;
    if (unit.empty()) unit = gamut::unitOf(m_.dimensionOf(initial));
    m_.addState(m_.ownStates_, element_, unit, initial);
    return unit;
  }

  Coordinate coordinateOf(const Word& /*word*/, std::string& name) override { return found(name).kind; }
  Coordinate drivenCoordinate(const Word& /*word*/, std::string& name) override {
    const Coordinate kind = found(name).kind;
    m_.drive(name, element_);
    return kind;
  }
  /// Of a joint that is no height over the way ahead a profile would not be seen. Where none is asked for, its speed is
  /// 0, by a name of its own.
  void drawsProfile(const std::string& coordinate, const Expression& speed, const Axis& along) override {
    const std::string name = element_ + ".profile_speed";
    if (isEqual(m_.rangeOf(speed), Interval(0.0)) && speed.names() == std::vector{name}) return;
    const JointCoordinate& joint = *m_.coordinates_.find(coordinate);
    const auto refuseAs = [&](const char* what) {
      throw WrongNumber(name, "the motion of the joint " + inQuotes(joint.name) + " is no height of a profile: " + what,
                        "none, or a joint that slides, alone and across `along`");
    };
    if (joint.kind == Coordinate::angle) refuseAs("it turns");
    if (m_.coordinatesOf_.at(joint.element).size() > 1) refuseAs("its element moves in other ways too");
    const auto element = std::ranges::find(m_.elements_, joint.element, &Described::name);
    if (element != m_.elements_.end() && slidesAlong(*element, along)) refuseAs("it slides along the way ahead");
  }
  Coordinate followingCoordinate(const Word& word, std::string& name, const std::string& leader) override {
    found(name);
    if (name == leader)
      refuse("the joint " + inQuotes(name) + " follows itself, as " + inQuotes(element_) + " has it", "another joint");
    for (const Following& following : m_.followings_)
      if (following.leader == name)
        refuse("the joint " + inQuotes(name) + " is driven by " + inQuotes(element_) + " after " +
                   inQuotes(following.follower) + " follows it",
               "its drive ahead of what follows it");
    m_.followings_.push_back({name, leader});
    return drivenCoordinate(word, name);
  }
  Coordinate struckCoordinate(const Word& /*word*/, std::string& name, Start& start) override {
    const JointCoordinate& struck = found(name);
    if (struck.isDependent)
      refuse("the joint " + inQuotes(name) + " closes a loop, so that it cannot strike " + inQuotes(element_),
             "an elastic end, `joint-stop`, or another joint that closes the loop");
    if (struck.isDriven)
      refuse("the joint " + inQuotes(name) + " is driven, so that it cannot strike " + inQuotes(element_),
             "a joint that moves freely");
    if (!m_.struck_.emplace(name, element_).second)
      refuse("the joint " + inQuotes(name) + " has two rigid ends, " + inQuotes(m_.struck_.at(name)) + " and " +
                 inQuotes(element_),
             "an elastic one, `joint-stop`, in place of one of them");
    start.position = m_.positions_.find(struck.name)->initial;
    start.rate = m_.speeds_.find(struck.rate)->initial;
    start.isRising = m_.rangeOf(start.rate).upper() > 0;
    return struck.kind;
  }
  /// Others of them may follow from a loop that is closed already, which may hold the same.
  [[noreturn]] void refuseTooFew(const Loop& loop, const std::string& needed, std::size_t count) const {
    const std::unordered_set<std::string> elements = elementsBetween(m_, loop.from, loop.to);
    std::string others;
    for (const Closed& closed : m_.loops_) {
      std::string names;
      for (const std::string& name : closed.by)
        if (elements.contains(m_.coordinates_.find(name)->element)) names += (names.empty() ? "" : ", ") + name;
      if (!names.empty())
        others += (others.empty() ? ", while " : " and ") + names +
                  (names.find(',') == std::string::npos ? " closes " : " close ") + inQuotes(closed.element);
    }
    refuse("the loop " + inQuotes(element_) + " is closed by " + needed + ", but between its frames " +
               std::to_string(count) + " may follow from others" + others,
           others.empty() ? "a loop with so many joints that move freely, balls and free bodies not counted, or a "
                            "closure that holds less (`pin` in planar loops); where some of what it holds follows from "
                            "the rest for the numbers' sake, `redundant`, how many rows"
                          : "one loop alone where both hold the same, or a closure that holds less (`pin` in planar "
                            "loops)");
  }
  void closesBetween(const FixedPoint& from, const FixedPoint& to, const HeldRows& wanted,
                     std::optional<HeldRows>& left) override {
    left = wanted;
    const HoldsAnyway holds = holdsAnyway(m_, element_, from, to, wanted);
    left->along = wanted.along && !holds.along;
    left->across = wanted.across && !holds.across;
    left->parallel = wanted.parallel && !holds.parallel;
    if (left->count() == wanted.count()) return;
    left->axis = holds.axis;
    m_.leftOut_.push_back({element_, sentenceOnLeftOut(element_, from.frame, wanted, *left), holds.restsOn});
  }
  void dependentCoordinates(const Word& /*word*/, std::vector<std::string>& names, const Loop& loop) override {
    if (loop.rows + loop.redundant == 0 && names.empty()) return;
    const bool isChosen = names.empty();
    if (isChosen) names = m_.coordinatesBetween(loop.from, loop.to, loop.rows);
    const std::string needed = std::to_string(loop.rows) + (loop.rows == 1 ? " coordinate" : " coordinates");
    if (isChosen && names.size() < loop.rows) refuseTooFew(loop, needed, names.size());
    if (!isChosen && names.size() != loop.rows)
      refuse("the loop " + inQuotes(element_) + " is closed by " + needed + ", but " + std::to_string(names.size()) +
                 (names.size() == 1 ? " is named" : " are named"),
             needed);
    names.erase(names.begin(), names.end() - static_cast<std::ptrdiff_t>(loop.rows));
    for (std::string& name : names) {
      found(name);
      m_.depend(name, element_);
    }
    m_.loops_.push_back({element_, names, isChosen, loop.redundant});
  }
  void timeFunction(const Word& word, Expression& number) override {
    if (!number.isSmooth())
      refuse("the " + word.key + " of " + inQuotes(element_) +
                 " has a kink or a jump (abs, sign, min, max, where), where its rate would jump",
             "a smooth formula");
    m_.addSignal({element_, named(word), word.unit, Reach::time, number}, number);
  }
  void table(const Word& /*file*/, const Word& /*column*/, Coordinate /*kind*/, TimeTable& table) override {
    const std::vector<mpq_class>& times = table.times;
    if (times.size() < 2 || table.values.size() != times.size() || times.size() > maxTableRows ||
        std::ranges::adjacent_find(times, std::greater_equal<>()) != times.end())
      refuse("the table of " + inQuotes(element_) + " does not have 2 to " + std::to_string(maxTableRows) +
             " rows whose times rise");
  }
  void signal(const Word& word, Expression& number) override {
    m_.addSignal({element_, named(word), word.unit, Reach::motion, number}, number);
  }
  void stateRate(const Word& word, Expression& number) override {
    m_.addSignal({element_, named(word), word.unit, Reach::solution, number}, number);
  }
  void signals(const Word& word, ExpressionVector& vector) override {
    for (std::size_t i = 0; i < 3; ++i)
      m_.addSignal({element_, named(word) + "." + components[i], word.unit, Reach::motion, vector[i]}, vector[i]);
  }

  void measure(const Word& word) override { m_.addMeasured(named(word), word.unit, element_); }
  void measureSolved(const Word& word) override { m_.addMeasured(named(word), word.unit, element_, true); }
  void measureMotion(const Word& word) override { m_.addMeasured(named(word), word.unit, element_, false, true); }
  void measureLength(const Word& word) override {
    measure(word);
    m_.lengths_.push_back({named(word), type_, element_});
  }

 private:
  std::string named(const Word& word) const { return element_ + "." + word.key; }
  void movesByJoint() {
    // Those of the element that is being added are the last.
    for (auto moved = m_.moved_.rbegin(); moved != m_.moved_.rend() && moved->element == element_; ++moved)
      moved->isByJoint = true;
  }
  /// The coordinate's full name replaces that of a joint with one.
  const JointCoordinate& found(std::string& name) const {
    const JointCoordinate& coordinate = m_.coordinate(name, element_);
    name = coordinate.name;
    return coordinate;
  }

  Mechanism& m_;
  std::string type_, element_;
};

void Mechanism::add(Described element) {
  checkNewName(element.type(), element.name());
  Checker checker(*this, element);
  element.describe(checker);
  names_.insert(element.name());
  elements_.push_back(std::move(element));
}

const Mechanism::JointCoordinate& Mechanism::coordinate(const std::string& name, const std::string& of) const {
  if (const JointCoordinate* found = coordinates_.find(name)) return *found;
  const auto own = coordinatesOf_.find(name);
  if (own != coordinatesOf_.end() && own->second.size() == 1) return *coordinates_.find(own->second.front());
  if (own != coordinatesOf_.end())
    throw UnknownName("joint with one coordinate", name, own->second, "for " + inQuotes(of));
  for (const Moved& moved : moved_)
    if (moved.isByJoint && own == coordinatesOf_.end() && !coordinatesOf_.contains(moved.element) &&
        (name == moved.element || name.starts_with(moved.element + ".")))
      refuse("the joint " + inQuotes(moved.element) + " has no coordinates for " + inQuotes(of) +
                 ", as the turns of a ball are none",
             "hinges one behind the other in its place, or another joint");
  std::vector<std::string> names;
  for (const JointCoordinate& coordinate : coordinates_)
    names.push_back(coordinatesOf_.at(coordinate.element).size() == 1 ? coordinate.element : coordinate.name);
  throw UnknownName("joint", name, names, "for " + inQuotes(of));
}

const Mechanism::JointCoordinate* Mechanism::coordinateWith(const std::string& name) const {
  if (const JointCoordinate* found = coordinates_.find(name)) return found;
  const auto position = coordinateOfRate_.find(name);
  return position == coordinateOfRate_.end() ? nullptr : coordinates_.find(position->second);
}

void Mechanism::setGravity(ExpressionVector gravity) {
  if (gravity_) refuse("gravity is set twice");
  for (std::size_t i = 0; i < 3; ++i) use(gravity[i], std::string("gravity.") + components[i], "m/s^2");
  gravity_ = std::move(gravity);
}

void Mechanism::setBaseAcceleration(ExpressionVector acceleration) {
  if (baseAcceleration_) refuse("the acceleration of the base is set twice");
  for (std::size_t i = 0; i < 3; ++i)
    addSignal({baseAccelerationName, std::string(baseAccelerationName) + "." + components[i], "m/s^2", Reach::time,
               acceleration[i]},
              acceleration[i]);
  baseAcceleration_ = std::move(acceleration);
}

const std::string* Mechanism::unitOfMeasured(const std::string& name) const {
  for (const auto* states : {&positions_, &speeds_, &ownStates_})
    if (const State* state = states->find(name)) return &state->unit;
  static const std::string radian = "rad", metre = "m", radianRate = "rad/s", metreRate = "m/s";
  if (const JointCoordinate* coordinate = coordinateWith(name);
      coordinate != nullptr && (coordinate->isDriven || coordinate->isDependent)) {
    const bool turns = coordinate->kind == Coordinate::angle, isRate = coordinate->rate == name;
    return turns ? (isRate ? &radianRate : &radian) : isRate ? &metreRate : &metre;
  }
  if (const Measured* measured = measured_.find(name)) return &measured->unit;
  const auto whole = std::ranges::find(wholeQuantities(), name, &WholeQuantity::name);
  return whole == wholeQuantities().end() ? nullptr : &whole->unit;
}

Expression Mechanism::parse(std::string_view text) const {
  return Expression::parse(text, [this](std::string_view word) {
    const std::string name(word);
    return knows(name) || unitOfMeasured(name) != nullptr;
  });
}

Dimension Mechanism::dimensionOf(const Expression& signal) const {
  return signal.dimension([this](const std::string& name) {
    return name == "t" ? gamut::dimensionOf("s") : gamut::dimensionOf(unitOf(name));
  });
}

void Mechanism::checkSignal(const Signal& signal) const {
  const auto isSolved = [this](const std::string& name) {
    const Measured* measured = measured_.find(name);
    const auto whole = std::ranges::find(wholeQuantities(), name, &WholeQuantity::name);
    return (measured != nullptr && measured->isSolved) || (whole != wholeQuantities().end() && whole->isSolved);
  };
  for (const std::string& used : signal.expression.names()) {
    if (signal.reach == Reach::motion && isSolved(used))
      throw WrongNumber(signal.name, inQuotes(used) + " follows from all forces, this one among them",
                        "a formula "
                        "of time, positions, velocities and own states");
    if (used == "t" || knows(used) || (signal.reach != Reach::time && unitOfMeasured(used) != nullptr)) continue;
    if (unitOfMeasured(used) != nullptr)
      throw WrongNumber(signal.name, inQuotes(used) + " changes in motion", "a formula of time and parameters alone");
    std::vector<std::string> known;
    if (signal.reach != Reach::time)
      std::ranges::copy_if(outputQuantities(), std::back_inserter(known), [&](const std::string& quantity) {
        return signal.reach != Reach::motion || !isSolved(quantity);
      });
    // Where everything is one of many, what moves and what was declared is seen first.
    std::vector<std::string> parameters = parameterNames();
    parameters.emplace_back("t");
    const auto states = static_cast<std::ptrdiff_t>(std::min(known.size(), stateNames().size()));
    known.insert(known.begin() + states, parameters.begin(), parameters.end());
    throw UnknownName("quantity", used, known, remarkOn(used, signal.name), signal.name);
  }
  if (gamut::dimensionOf(signal.unit) == Dimension{.time = -1} && isWithoutUnits(signal.expression)) return;
  const State* state = signal.reach == Reach::solution ? ownStates_.find(signal.element) : nullptr;
  try {
    check(signal.expression, signal.name, signal.unit);
  } catch (const std::invalid_argument&) {  // a unit that does not fit
    if (state != nullptr && gamut::dimensionOf(state->unit) == Dimension{}) refuseRateWithUnit(signal);
    throw;
  }
}

/// The rate of a state without unit: who gave it none may have meant to.
void Mechanism::refuseRateWithUnit(const Signal& signal) const {
  const std::string remark = "the state " + inQuotes(signal.element) +
                             " has no unit; its unit is that of its initial value, such as initial = \"";
  try {
    Dimension found = dimensionOf(signal.expression);
    if (isAlike(found, {.time = -1})) return;
    const std::string unitOfRate = gamut::unitOf(found);
    ++found.time;
    throw WrongNumber(signal.name,
                      "a quantity in " + unitOfRate + ", but " + remark + "0 " + gamut::unitOf(found) + "\"",
                      "a rate in 1/s, or a state with that unit");
  } catch (const WrongNumber&) {
    throw;
  } catch (const UnitError& error) {
    throw WrongNumber(signal.name, error.problem() + ", and " + remark + "0 rad\"", error.expected());
  }
}

bool Mechanism::isWithoutUnits(const Expression& rate) const {
  try {
    return rate.dimension([this](const std::string& name) {
      return name == "t" ? Dimension{} : gamut::dimensionOf(unitOf(name));
    }) == Dimension{};
  } catch (const UnitError&) {
    return false;
  }
}

void Mechanism::check() const {
  if (positions_.empty() && speeds_.empty() && ownStates_.empty() && coordinates_.empty() && parameters_.empty())
    refuse("the mechanism has no joint, no state and no parameter: there is nothing to ask for");
  checkSignals(baseAccelerationName);
  for (const Described& element : elements_) {
    checkSignals(element.name());
    for (const Fault& fault : faults(element, {})) refuse(fault.sentence);
  }
}

void Mechanism::checkSignals(const std::string& element) const {
  const auto own = signals_.find(element);
  if (own == signals_.end()) return;
  for (const Signal& signal : own->second) {
    checkSignal(signal);
    checkCycle(signal);
  }
}

/// What an element measures may depend on all of its expressions, but for what the motion alone tells.
void Mechanism::checkCycle(const Signal& signal) const {
  std::unordered_set<std::string> reached;
  std::vector<std::string> open = signal.expression.names();
  for (; signal.reach == Reach::motion && !open.empty();) {
    const std::string name = open.back();
    open.pop_back();
    const Measured* measured = measured_.find(name);
    if (measured == nullptr || measured->isMotion || reached.contains(measured->element)) continue;
    if (measured->element == signal.element)
      throw WrongNumber(signal.name, "it depends on " + inQuotes(name) + ", which depends on it",
                        "a formula of "
                        "what is known without it");
    reached.insert(measured->element);
    const auto others = signals_.find(measured->element);
    if (others == signals_.end()) continue;
    for (const Signal& other : others->second)
      if (other.reach == Reach::motion)
        open.insert(open.end(), other.expression.names().begin(), other.expression.names().end());
  }
}

std::vector<Fault> Mechanism::faults(const Described& element, const std::map<std::string, Interval>& ranges) const {
  std::vector<Expression> asked;
  std::vector<Fault> found = element.faults([&](const Expression& number) {
    asked.push_back(number);
    return rangeOf(number);
  });
  std::set<std::string> needed;
  for (const Expression& number : asked)
    for (const std::string& name : needsOf(number))
      if (ranges.contains(name)) needed.insert(name);
  std::vector<std::string> varied(needed.begin(), needed.end());
  if (varied.size() > 12) varied.resize(12);
  // Where what makes sense is convex and each number affine in one parameter, what holds at the corners of the box
  // holds in all of it.
  for (unsigned corner = 0; found.empty() && !varied.empty() && corner < (1U << varied.size()); ++corner) {
    std::map<std::string, Interval> point;
    for (std::size_t i = 0; i < varied.size(); ++i) {
      const Interval& range = ranges.at(varied[i]);
      point[varied[i]] = ((corner >> i) & 1U) != 0 ? range.upper() : range.lower();
    }
    found = element.faults([&](const Expression& number) { return rangeOf(number, point); });
  }
  return found;
}

std::map<std::string, bool> Mechanism::framesThatMoveMass() const {
  std::map<std::string, bool> moves;
  const auto elementOf = [&](const std::string& coordinate) { return coordinates_.find(coordinate)->element; };
  std::unordered_map<std::string, std::vector<std::string>> leaders, movedBy;  // of elements: elements, frames
  for (const Following& following : followings_)
    leaders[elementOf(following.follower)].push_back(elementOf(following.leader));
  for (const Moved& moved : moved_) movedBy[moved.element].push_back(moved.frame);
  std::vector<std::string> open = massFrames_;
  while (!open.empty()) {
    const std::string frame = open.back();
    open.pop_back();
    if (std::exchange(moves[frame], true)) continue;
    const Moved* mover = moved_.find(frame);
    if (mover == nullptr) continue;
    open.push_back(mover->from);
    for (const std::string& leader : leaders[mover->element])
      for (const std::string& led : movedBy[leader]) open.push_back(led);
  }
  return moves;
}

void Mechanism::checkMasses() const {
  std::map<std::string, bool> carries = framesThatMoveMass();
  for (const Moved& moved : moved_) {
    const auto own = coordinatesOf_.find(moved.element);
    const bool follows = own != coordinatesOf_.end() && std::ranges::all_of(own->second, [&](const std::string& name) {
                           const JointCoordinate& coordinate = *coordinates_.find(name);
                           return coordinate.isDriven || coordinate.isDependent;
                         });
    if (moved.isByJoint && !follows && !isClosed() && !carries[moved.frame])
      throw UnfitPart(moved.element, "the joint " + inQuotes(moved.element) + " moves no mass",
                      "a mass at the frame " + inQuotes(moved.frame) + " or at one that it carries");
  }
}

std::vector<std::string> Mechanism::quantities() const {
  std::vector<std::string> names = namesOf(initials_);
  for (const NamedValue& parameter : parameters_) names.push_back(parameter.name);
  return names;
}

std::vector<std::string> Mechanism::parameterNames() const {
  std::vector<std::string> names = namesOf(parameters_);
  for (const Derived& derived : derived_) names.push_back(derived.name);
  return names;
}

Interval Mechanism::nominal(const std::string& quantity) const {
  for (const auto* values : {&initials_, &parameters_})
    if (const NamedValue* value = values->find(quantity)) return value->nominal;
  if (const Derived* derived = derived_.find(quantity)) return rangeOf(derived->formula);
  refuse(unknownName("quantity", quantity, quantities()));
}

Interval Mechanism::rangeOf(const Expression& number, const std::map<std::string, Interval>& ranges) const {
  return number.evaluate<Interval>([&](const std::string& name) {
    if (const auto range = ranges.find(name); range != ranges.end()) return range->second;
    const Derived* derived = derived_.find(name);
    return derived == nullptr ? nominal(name) : rangeOf(derived->formula, ranges);
  });
}

std::vector<std::string> Mechanism::stateNames() const {
  std::vector<std::string> names;
  for (const auto* states : {&positions_, &speeds_, &ownStates_})
    for (const State& state : *states) names.push_back(state.name);
  return names;
}

std::vector<Expression> Mechanism::initialState() const {
  std::vector<Expression> initial;
  for (const auto* states : {&positions_, &speeds_, &ownStates_})
    for (const State& state : *states) initial.push_back(state.initial);
  return initial;
}

std::vector<bool> Mechanism::startsWith(const std::vector<std::string>& freeParameters) const {
  const std::unordered_set<std::string> isFree(freeParameters.begin(), freeParameters.end());
  std::vector<bool> follows;
  for (const Expression& initial : initialState())
    follows.push_back(
        std::ranges::any_of(needsOf(initial), [&](const std::string& name) { return isFree.contains(name); }));
  return follows;
}

std::vector<std::string> Mechanism::outputQuantities() const {
  std::vector<std::string> names = stateNames();
  for (const JointCoordinate& coordinate : coordinates_)
    if (coordinate.isDriven)
      names.insert(names.end(), {coordinate.name, coordinate.rate});
    else if (coordinate.isDependent && !isSpeed(coordinate.rate))
      names.push_back(coordinate.rate);
  for (const Measured& measured : measured_) names.push_back(measured.name);
  const bool hasMass = !massFrames_.empty();
  for (const WholeQuantity& whole : wholeQuantities())  // of what is no machine none, of one without mass its energy
    if (hasMass || (!whole.isOfMass && !moved_.empty())) names.push_back(whole.name);
  return names;
}

std::vector<std::string> Mechanism::namesInFormulas() const {
  std::vector<std::string> names = outputQuantities();
  for (std::string& name : parameterNames()) names.push_back(std::move(name));
  return names;
}

std::string Mechanism::unitOf(const std::string& quantity) const {
  if (const std::string* unit = unitOfMeasured(quantity)) return *unit;
  if (const NamedValue* parameter = parameters_.find(quantity)) return parameter->unit;
  if (const Derived* derived = derived_.find(quantity)) return derived->unit;
  std::vector<std::string> known = quantities();
  for (const std::string& output : outputQuantities()) known.push_back(output);
  throw UnknownName("quantity", quantity, known);
}

}  // namespace gamut
