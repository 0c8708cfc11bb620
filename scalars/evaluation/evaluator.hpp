// Evaluates a Program with any scalar: doubles for samples, intervals for ranges, high precision for references.
// What depends on parameters alone is computed once, by setParameters. Packs of samples: sample_pack.hpp.
#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/evaluation/tape.hpp"
#include "scalars/index.hpp"
#include "scalars/operations/all.hpp"
#include "scalars/program/angles.hpp"
#include "scalars/program/program.hpp"
#include "scalars/traits.hpp"

namespace gamut {

/// Values of a Program for scalar S, by its Tape. One evaluator a thread. Doubles have the sine and cosine of
/// vector_functions.hpp and the other functions of <cmath>: a sample's value is the same here and in a pack.
template <class S>
class Evaluator {
 public:
  explicit Evaluator(const Program& program)
      : tape_(program), slot_(detail::at(tape_.slots()), S(0.0)), systems_(tape_.systems().size()) {
    if (program.parameters() == 0) setParameters({});
  }

  /// p: one value a parameter. Needed once before the first call if there are parameters.
  void setParameters(std::span<const S> p) {
    for (const auto& [input, slot] : tape_.constantInputs()) slot_[slot] = constant<S>(tape_.constants()[input]);
    for (const auto& [input, slot] : tape_.parameterInputs()) slot_[slot] = p[input];
    run(tape_.invariants());
  }

  /// y = f(t, x): x has one value a state, y one an output; y may be x.
  void operator()(const S& t, std::span<const S> x, std::span<S> y) {
    for (const auto& [input, slot] : tape_.stateInputs()) slot_[slot] = x[input];
    if (tape_.timeSlot() >= 0) slot_[tape_.timeSlot()] = t;
    run(tape_.instructions());
    const auto& outputs = tape_.outputSlots();
    for (std::size_t i = 0; i < outputs.size(); ++i) y[i] = slot_[outputs[i]];
  }

  /// The outputs as a vector.
  std::vector<S> operator()(const S& t, const std::vector<S>& x) {
    std::vector<S> y(tape_.outputs(), S(0.0));
    (*this)(t, std::span<const S>(x), std::span<S>(y));
    return y;
  }

  const Tape& tape() const { return tape_; }

 private:
  void run(const std::vector<Instruction>& instructions) {  // long: a case an operation, in one loop that keeps `acc`
    S* const slots = slot_.data();
    S acc(0.0);
    for (const Instruction& i : instructions) {
      const S& a = slots[i.a];
      const S& b = slots[i.b];
      switch (i.op) {
        case TapeOp::value:
          acc = a;
          break;
        case TapeOp::sum:
          acc = a + b;
          break;
        case TapeOp::difference:
          acc = a - b;
          break;
        case TapeOp::product:
          acc = a * b;
          break;
        case TapeOp::plus:
          acc = acc + a;
          break;
        case TapeOp::minus:
          acc = acc - a;
          break;
        case TapeOp::plusProduct:
          acc = acc + a * b;
          break;
        case TapeOp::minusProduct:
          acc = acc - a * b;
          break;
        case TapeOp::negative:
          acc = -a;
          break;
        case TapeOp::square:
          acc = square(a);
          break;
        case TapeOp::reciprocal:
          acc = S(1.0) / a;
          break;
        case TapeOp::function:
          apply(i, a, slots[i.b], acc);
          break;
        case TapeOp::factorise:
          factorise(detail::at(i.result));
          break;
        case TapeOp::solution:
          solve(tape_.solutions()[i.result]);
          break;
      }
      if (i.stores) slots[i.result] = acc;
    }
  }

  GAMUT_INLINE static void apply(const Instruction& i, const S& a, S& b, S& result) {
    if constexpr (std::is_same_v<S, Interval>)
      if (i.function == Op::atan && i.b != i.a) {
        result = halfAngle(a, b);
        return;
      }
    withFunction(i.function, [&](auto f) {
      if constexpr (requires { f.ofSample(a, result, b); })
        f.ofSample(a, result, b);
      else
        evaluate(f, a, result, b);
    });
  }

  void factorise(std::size_t number) {
    const TapeSystem& system = tape_.systems()[number];
    systems_[number].assign(system.kind, system.size,
                            [&](int i, int j) -> const S& { return slot_[system.entry(i, j)]; });
  }

  void solve(const TapeSolution& solution) {
    x_.clear();
    for (std::int32_t slot : solution.rightSide) x_.push_back(slot_[slot]);
    systems_[solution.system].solve(x_, solution.transposed);
    for (std::size_t k = 0; k < x_.size(); ++k) slot_[solution.results[k]] = x_[k];
  }

  Tape tape_;
  std::vector<S> slot_, x_;
  std::vector<LinearSystem<S>> systems_;
};

}  // namespace gamut
