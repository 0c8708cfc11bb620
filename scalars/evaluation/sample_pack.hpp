// Evaluates a Program on many samples at once: packs of a fixed width, one vector instruction for several samples.
// The value of a sample is the same bits as Evaluator<double>'s, whatever the machine, the unit and the place in a
// pack, so that a sample can be replayed alone. (exp, log and atan are those of <cmath> for both; a NaN is one for
// both, but its sign and payload may differ.)
//
//     evaluateSamples(program, n, t, x, p, y);  // rows of n samples: state s of sample i is x[s * n + i]
#pragma once

#include <span>
#include <vector>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/elementary/vector_unit.hpp"
#include "scalars/evaluation/tape.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// Samples in a pack: many enough to share the cost of reading an instruction, few enough for some hundred slots of
/// 512 bytes to stay in the second-level cache. Measured on a Zen 4 core, seven-joint arm: with AVX-512 packs of 16, 32
/// and 64 take 203, 125 and 115 ns a sample, with AVX2 220, 142 and 147 (chain_benchmark).
inline constexpr int packWidth = 64;

/// A Program's values for the samples of one pack. A row is the packWidth values of one quantity; of a pack that is not
/// full, fill the rest with copies of a sample. One evaluator a thread.
class PackEvaluator {
 public:
  /// The unit changes the speed, not the values.
  explicit PackEvaluator(const Program& program, VectorUnit unit = usableUnits().back());

  /// p: one row a parameter. Needed once before the first call if there are parameters.
  void setParameters(std::span<const double> p);

  /// y = f(t, x): t is one row, x has one row a state, y one an output; y may be x.
  void operator()(std::span<const double> t, std::span<const double> x, std::span<double> y);

  const Tape& tape() const { return tape_; }

 private:
  friend struct PackRun;
  struct alignas(64) Row {
    double values[packWidth];
  };
  /// A matrix: the rows of L and D below and on the diagonal if it is positive definite, or systems sample by sample.
  struct Factors {
    std::vector<Row> rows;
    std::vector<LinearSystem<double>> samples;
  };
  void fill(int slot, const double* row);
  void run(const std::vector<Instruction>& instructions);

  Tape tape_;
  VectorUnit unit_;
  std::vector<Row> slots_;
  std::vector<Factors> factors_;  // of the tape's systems
};

/// y = f(t, x, p) for n samples in rows of n: x has one row a state, p one a parameter, y one an output. Throws
/// std::invalid_argument for spans of other sizes.
void evaluateSamples(const Program& program, std::size_t n, double t, std::span<const double> x,
                     std::span<const double> p, std::span<double> y);

}  // namespace gamut
