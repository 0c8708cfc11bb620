// A Tape is a Program made ready to be executed: instructions on few slots instead of nodes. A value's slot is taken
// over by another value after its last use, so that long programs stay in the first-level cache; sums of products run
// through an accumulator, so that their parts are never stored; sine and cosine of one angle are one instruction; and
// what depends on parameters alone is a section of its own, executed once for given parameters.
//
// The arithmetic is the Program's, operation for operation: a Tape rounds as often and in the same order, so that every
// evaluator gives what the node-by-node evaluation of the Program gives, to the bit.
#pragma once

#include <cstdint>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// What an instruction does with the accumulator `acc` and the values a, b of its two slots.
enum class TapeOp : std::uint8_t {
  value,         ///< acc = a
  sum,           ///< acc = a + b
  difference,    ///< acc = a - b
  product,       ///< acc = a b
  plus,          ///< acc = acc + a
  minus,         ///< acc = acc - a
  plusProduct,   ///< acc = acc + a b, rounded twice
  minusProduct,  ///< acc = acc - a b, rounded twice
  negative,      ///< acc = -a
  square,        ///< acc = a²
  reciprocal,    ///< acc = 1 / a
  function,      ///< acc = function(a); of twins acc is the first, and the second goes to slot b
  factorise,     ///< the matrix of system number `result`, for the solutions that follow
  solution,      ///< solution number `result`; neither of the two reads or leaves an accumulator
};

struct Instruction {
  TapeOp op;
  bool stores;              ///< the accumulator goes to slot `result` afterwards
  bool isUniform = false;   ///< b is the same whatever the parameters and the state are; it is a for plus and minus
  Op function = Op::state;  ///< which, where op is TapeOp::function
  std::int32_t result = 0;
  std::int32_t a = 0;
  std::int32_t b = 0;  ///< a where the operation has one operand; of half of an angle (angles.hpp) its d
};

/// A matrix, factorised once for all its solutions.
struct TapeSystem {
  MatrixKind kind;
  int size;
  std::vector<std::int32_t> entries;  ///< the slots at the factorisation, row by row
  detail::SolvingOperations operations;

  std::int32_t entry(int i, int j) const { return entries[i * size + j]; }
};

/// A solution of a system that has been factorised.
struct TapeSolution {
  int system;
  bool transposed;
  std::vector<std::int32_t> rightSide;  ///< slots, none of them one of the results'
  std::vector<std::int32_t> results;    ///< slots of the components
};

/// Input number `input` goes to slot `slot` before a section runs.
struct TapeInput {
  std::int32_t input;
  std::int32_t slot;
};

/// y = f(t, x, p) as instructions. First the invariant section: constants and parameters are put into their slots, then
/// `invariants` run; slots 0 … keptSlots()-1 then hold what `instructions` need of it. For each (t, x), states and time
/// are put into their slots, `instructions` run, and the outputs lie in outputSlots().
class Tape {
 public:
  explicit Tape(const Program& program);

  int outputs() const { return static_cast<int>(outputSlots_.size()); }

  /// Slots of both sections together, and those that the invariant section leaves for the other.
  int slots() const { return slots_; }
  int keptSlots() const { return keptSlots_; }
  /// Elementary operations of one evaluation: a sine with its cosine counts as two, what is invariant as none.
  int operations() const;

  const std::vector<Interval>& constants() const { return constants_; }
  const std::vector<TapeInput>& constantInputs() const { return constantInputs_; }
  const std::vector<TapeInput>& parameterInputs() const { return parameterInputs_; }
  const std::vector<TapeInput>& stateInputs() const { return stateInputs_; }
  /// The slot of t, or -1 if nothing depends on time.
  int timeSlot() const { return timeSlot_; }
  const std::vector<Instruction>& invariants() const { return invariants_; }
  const std::vector<Instruction>& instructions() const { return instructions_; }
  const std::vector<int>& outputSlots() const { return outputSlots_; }
  /// What `factorise` and `solution` count, of both sections: what is factorised in the invariant one stays.
  const std::vector<TapeSystem>& systems() const { return systems_; }
  const std::vector<TapeSolution>& solutions() const { return solutions_; }

 private:
  friend class TapeWriter;
  int slots_ = 0;
  int keptSlots_ = 0;
  int timeSlot_ = -1;
  std::vector<Interval> constants_;
  std::vector<TapeInput> constantInputs_, parameterInputs_, stateInputs_;
  std::vector<Instruction> invariants_, instructions_;
  std::vector<int> outputSlots_;
  std::vector<TapeSystem> systems_;
  std::vector<TapeSolution> solutions_;
};

}  // namespace gamut
