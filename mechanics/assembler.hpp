// What the description of an element finds when it is assembled for one scalar: frames, numbers, states and places for
// what it makes.
//
//   template <class S>
//   void Drag::assemble(Assembler<S>& a) const {
//     a.template add<DragLoad<S>>(a.frame(at), a.number(coefficient));
//   }
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/element.hpp"
#include "mechanics/rigid_end.hpp"
#include "mechanics/rotation.hpp"

namespace gamut {

/// A value that changes with the motion.
template <class S>
using Signal = std::function<S()>;

/// A function of time with its first and second derivative.
template <class S>
using TimeFunction = std::function<std::array<S, 3>()>;

template <class S>
class Assembly;

template <class S>
class Assembler {
 public:
  /// A frame of the mechanism, and one that has no name.
  Frame<S>& frame(const std::string& name) { return *frames_.at(name); }
  Frame<S>& hiddenFrame() { return hidden_.emplace_back(element_); }

  S number(const Expression& number) const;
  /// The same where no free parameter is in it; else nothing.
  std::optional<Interval> known(const Expression& number) const;
  Vector3<S> vector(const ExpressionVector& numbers) const;
  Matrix3<S> symmetric(const std::array<Expression, 6>& entries) const;
  Rotation<S> rotation(const std::vector<FixedRotation>& rotations) const;

  /// The element's own coordinate or speed that it has described by this key; that of another element by its full name.
  Variable<S>& variable(const std::string& key) { return *variables_.at(element_ + "." + key); }
  Variable<S>& coordinate(const std::string& name) { return *variables_.at(name); }
  Speed<S>& speed(const std::string& key) { return *speeds_.at(element_ + "." + key); }
  /// The element's own position that is no coordinate, with its rate as a function of the present motion.
  S& position(const std::string& key, Signal<S> rate) { return giveRate(element_ + "." + key, std::move(rate)); }
  /// The element's own orientation, with speeds of this key.
  Orientation<S> orientation(const std::string& rateKey, RatesIn in = RatesIn::to);
  /// The element's own state, with its rate.
  S& state(Signal<S> rate) { return giveRate(element_, std::move(rate)); }

  void endTravel(RigidEnd<S> end) { ends_.push_back(std::move(end)); }
  /// The element's loop is held by it.
  void closes(Constraint<S>& by) { closings_[element_] = &by; }

  const S& time() const { return time_; }
  /// The present value of an expression of time, states and whatever can be measured, after positions and velocities
  /// have been moved.
  Signal<S> signal(const Expression& expression) const;
  TimeFunction<S> timeFunction(const Expression& expression) const;

  /// Gives the value of what the element has described as measured by this key.
  void measure(const std::string& key, Signal<S> value) { measured_[element_ + "." + key] = std::move(value); }

  /// The same of what is known once the equations of motion are solved: accelerations of frames (without −g) and of
  /// speeds, forces on frames, generalised forces.
  void measureSolved(const std::string& key, Signal<S> value) {
    measureSolvedAs(element_ + "." + key, std::move(value));
  }

  /// Makes a part and appends it to the chain; to what goes before all that, since it moves joints; or to what goes
  /// before everything, since nothing else moves what it asks for.
  template <class Part, class... Arguments>
  Part& add(Arguments&&... arguments) {
    return make<Part>(parts_, std::forward<Arguments>(arguments)...);
  }
  template <class Part, class... Arguments>
  Part& addFirst(Arguments&&... arguments) {
    return make<Part>(first_, std::forward<Arguments>(arguments)...);
  }
  template <class Part, class... Arguments>
  Part& addGiven(Arguments&&... arguments) {
    return make<Part>(given_, std::forward<Arguments>(arguments)...);
  }

 private:
  friend class Assembly<S>;

  template <class Part, class... Arguments>
  static Part& make(std::vector<std::unique_ptr<Element<S>>>& parts, Arguments&&... arguments) {
    auto part = std::make_unique<Part>(std::forward<Arguments>(arguments)...);
    Part& made = *part;
    parts.push_back(std::move(part));
    return made;
  }
  void measureSolvedAs(const std::string& name, Signal<S> value) {
    measured_[name] = [this, value = std::move(value)] {
      solve_();
      return value();
    };
  }
  S& giveRate(const std::string& state, Signal<S> rate) {
    rates_[state] = std::move(rate);
    return values_.at(state);
  }
  /// Of anything that an expression may name. Throws UnknownName.
  S valueOf(const std::string& name) const;
  /// A number: the same one wherever it is known to be, so that what is recorded knows it too.
  S constantOf(const Interval& enclosure, const std::optional<Amount>& exact) const;

  std::function<void()> solve_;  // makes all that measureSolved may ask for the present motion's
  std::string element_;          // that is being assembled
  S time_ = S(0.0);
  std::map<std::string, S> parameters_, initials_;
  std::map<std::string, Interval> known_;                 // parameters that are not free
  mutable std::map<std::pair<mpq_class, int>, S> exact_;  // numbers met: rationals times powers of pi
  std::map<std::string, std::unique_ptr<Frame<S>>> frames_;
  std::deque<Frame<S>> hidden_;
  std::deque<Variable<S>> storedVariables_;
  std::deque<Speed<S>> storedSpeeds_;
  std::map<std::string, Variable<S>*> variables_;  // by name of the position
  std::map<std::string, Speed<S>*> speeds_;        // by name of the speed, those of variables included
  std::map<std::string, S> values_;                // of positions that are no coordinates, and of own states
  std::map<std::string, Signal<S>> rates_;         // of these
  std::map<std::string, Signal<S>> measured_;      // whatever can be looked at
  std::vector<RigidEnd<S>> ends_;
  std::map<std::string, Constraint<S>*> closings_;  // by element
  std::vector<std::unique_ptr<Element<S>>> given_, first_, parts_;
};

GAMUT_COMPILED_ELSEWHERE(Assembler)

}  // namespace gamut
