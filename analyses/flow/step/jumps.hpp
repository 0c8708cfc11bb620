// Where f jumps: how fast the arguments of its signs move on either side, and what that leaves of the signs and of the
// arguments over a step. docs/flow.md, section 7.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analyses/flow/series/polynomial_series.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/linear_form.hpp"
#include "scalars/program/program.hpp"
#include "scalars/program/resting.hpp"

namespace gamut {

/// The jumps of a motion, the same for all steps.
struct FlowJumps {
  /// `differentiated` as for FlowStepper; `varying`: parameters that are inputs.
  FlowJumps(const Program& differentiated, const std::vector<int>& varying, std::span<const RestingPair> pairs = {});
  std::size_t count() const { return forms.size(); }
  /// f with some jumps held and the others as they are.
  struct Held {
    Program f;
    std::vector<int> left;       ///< of each jump, which of that f's it is; -1: none
    std::vector<double> factor;  ///< its sign is that one's, or the negative
    /// Changes them to `jumps`, those of f once it is differentiated, which may have them in another order, or take
    /// factors off: those whose arguments are no longer the same, or the negative, are left as none.
    void matchTo(const FlowJumps& jumps);
  };
  /// Throws std::logic_error where these do not decide about themselves, or others become one or zero where they are.
  Held heldProgram(const std::vector<char>& held) const;
  /// g with the signs of states in it that are signs of f's surfaces as parameters behind its own, one a sign of f; of
  /// those held (none: empty) what holds them. Throws as heldProgram.
  Program outputsGiven(const Program& g, const std::vector<char>& held) const;

  Program f;      ///< without derivatives
  Program given;  ///< withSignsGiven(f)
  Program withoutSignsAtRest(const Program& g, const std::vector<char>& held) const;
  /// Of those held, without those that are at rest.
  static std::vector<char> bySigns(std::vector<char> held);

  bool isAffine = true;                          ///< f, in its signs: else nothing is held
  std::vector<std::optional<LinearForm>> forms;  ///< of each argument that is one
  std::vector<RestingJumps> rests;               ///< where solutions come to rest
};

/// What is said of each jump where some are held: 0, it is not; its argument is zero, by a sign that is found; it is
/// one of two at which the motion rests, and its sign is zero.
inline constexpr char byItsSign = 1, atRest = 2;

/// What a sign may be, by where its argument is.
struct SignCases {
  bool above = true, below = true;  ///< 1, -1
  Interval between{-1.0, 1.0};      ///< where it is zero; empty: nowhere
  /// When that may be so, in seconds from where a step begins.
  Interval whileAbove = Interval::entire(), whileBelow = Interval::entire(), whileBetween = Interval::entire();
  bool isHeldBetween = false;  ///< and what is there stays there: its sign is the formula that holds it

  Interval hull() const;
  /// Of the negative argument.
  SignCases mirrored() const { return {below, above, -between, whileBelow, whileAbove, whileBetween, isHeldBetween}; }
  bool isOpen() const { return above + below + !isEmpty(between) > 1 || !(above || below || isThin(between)); }
  /// What of it may be so in this time; all of it if nothing may.
  SignCases during(const Interval& seconds) const;
};

/// Of one jump, over a step.
struct JumpBound {
  Interval start = Interval::entire();  ///< its argument at first; nothing is known of it: entire
  Interval up = Interval::entire(), down = Interval::entire();  ///< the argument's rate above zero, and below
  Interval over = Interval::entire();                           ///< the argument, at all times
  Interval sign{-1.0, 1.0};                                     ///< or a mean of signs
  bool maySlide = true;                                         ///< solutions may stay where the argument is zero
  Interval slid{-1.0, 1.0};                                     ///< the sign of those that stay
  bool holds = false;                                           ///< those there stay there, all of them
  double turned = 0;                                            ///< how much the sign that would hold them varies

  /// Of one that is held all the time, by these signs.
  static JumpBound held(const Interval& sign);
  bool isKnown() const { return isCommon(over); }
  /// Where all solutions pass from one side to the other, or come from one to be held, how many seconds into the step
  /// each of them does.
  struct Crossing {
    double before;  ///< the sign until then
    Interval moment;
    bool arrives = false;  ///< and is held
  };
  std::optional<Crossing> crossing(bool mayArrive = false) const;
  /// Where it holds: bounds, of the argument at any moment t of the step, that bend upwards and downwards with t.
  Interval whileArriving(double seconds) const;
  /// The argument until `seconds` into the step, and then.
  struct Reach {
    Interval ever, then;
  };
  Reach after(double seconds) const;
  /// The sign then, and at all times of the step with its limits from within; where the argument passes through zero,
  /// anything between -1 and 1 there.
  SignCases signAfter(double seconds) const;
  SignCases signOver() const;  ///< and when

 private:
  bool leaves() const;
  SignCases within(SignCases cases) const;
};

/// The rates of a jump's argument over a step, 1/s, where its sign is 1, and -1.
struct SideRates {
  Interval up = Interval::entire(), down = Interval::entire();
};

/// What time, states and signs are together.
struct SignBox {
  Interval time;
  Box states;
  std::vector<Interval> signs;
  std::vector<char> held;  ///< of each sign, whether it holds its argument at zero here
};

/// The signs of a motion where its states are known better than over a step.
class SignsWithin {
 public:
  explicit SignsWithin(const FlowJumps& jumps);
  /// Narrows `signs`, one a sign of f, to the sides on which arguments may be wherever time, states and parameters are
  /// in these intervals.
  void narrow(const Interval& time, std::span<const Interval> states, std::span<const Interval> parameters,
              std::vector<SignCases>& signs);
  /// All cases of a few signs, with what they leave of time and states, and of the others what they may be. `began`:
  /// when the step did.
  std::vector<SignBox> boxes(double began, const Interval& time, const Box& states, const Box& parameters,
                             std::vector<SignCases> signs);
  /// The arguments that were found last.
  const std::vector<Interval>& arguments() const { return arguments_; }

 private:
  const FlowJumps& jumps_;
  Evaluator<Interval> evaluator_;
  std::vector<Interval> arguments_;
};

/// What a step finds about jumps; one a stepper.
class JumpBounder {
 public:
  const FlowJumps& jumps() const { return jumps_; }
  explicit JumpBounder(const FlowJumps& jumps);
  void setParameters(const std::vector<Embedded>& parameters);
  void setParameters(Box parameters) { parameters_ = std::move(parameters); }

  /// While time is within `time` and states within `box`, h seconds long, with arguments that start in `start` (whole
  /// lines where nothing is known of them): narrows `bounds`, one a jump, of which the signs hold already. `known`:
  /// what is known of rates besides, one a jump, or nothing.
  void bound(const Interval& time, const Box& box, const std::vector<Interval>& start, double h,
             std::vector<JumpBound>& bounds, std::span<const SideRates> known = {});
  /// About what signs are from then on where arguments that are zero may stay so or leave: 1 or -1 of those that leave
  /// to that side. `signs`: of the others. None if that is not decided.
  std::vector<double> signsFromRest(double time, const Box& states, std::vector<double> signs,
                                    const std::vector<char>& isZero);
  /// Q of a pair that rests (RestingPair), where others have the signs of `bounds`.
  Interval pressure(const RestingJumps& rest, const Interval& time, const Box& box,
                    const std::vector<JumpBound>& bounds);
  /// Narrows the pivot's state in `box` by what the form is.
  void narrow(const LinearForm& form, const Interval& argument, Box& box) const;

 private:
  Interval slidingSign(std::size_t jump, const Interval& time, const Box& box, const std::vector<JumpBound>& bounds,
                       double& turned);
  void boundOne(std::size_t jump, const Interval& time, const Box& box, const Interval& start, double h,
                std::vector<JumpBound>& bounds);
  Interval rate(std::size_t jump, double sign, const Interval& time, const Box& box,
                const std::vector<JumpBound>& bounds);

  const FlowJumps& jumps_;
  Evaluator<Interval> given_;
  Box parameters_;
  std::vector<Interval> results_;
  std::span<const SideRates> known_;
};

}  // namespace gamut
