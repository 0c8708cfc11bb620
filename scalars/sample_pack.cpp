// The interpreter of tapes on packs: the accumulator is a block of vector registers.
#include "scalars/sample_pack.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scalars/vector_functions.hpp"

namespace gamut {
namespace {

using namespace detail;

/// The vectors of the accumulator: a pack at once if eight registers hold it, or a part of the pack.
template <class V>
constexpr int block = std::min(8, packWidth / lanes<V>);

/// result = function(a), out of line, so that the accumulator of the other instructions stays in registers.
void callFunction(TapeOp op, std::span<const double> a, std::span<double> result) {
  switch (op) {
    case TapeOp::exponential:
      std::ranges::transform(a, result.begin(), [](double x) { return std::exp(x); });
      break;
    case TapeOp::logarithm:
      std::ranges::transform(a, result.begin(), [](double x) { return std::log(x); });
      break;
    case TapeOp::arcTangent:
      std::ranges::transform(a, result.begin(), [](double x) { return std::atan(x); });
      break;
    default:
      std::ranges::transform(a, result.begin(), [](double x) { return std::sqrt(x); });
      break;
  }
}

// For each vector j of the block; unrolled, so that the accumulator stays in registers.
#define GAMUT_FOR_BLOCK _Pragma("GCC unroll 8") for (int j = 0; j < block<V>; ++j)
// acc = expression(left, right), the values of the operands.
#define GAMUT_ACCUMULATE(expression) \
  GAMUT_FOR_BLOCK {                  \
    [[maybe_unused]] V left, right;  \
    load(left, a + j * lanes<V>);    \
    load(right, b + j * lanes<V>);   \
    acc[j] = expression;             \
  }                                  \
  break

/// Runs the instructions on a block of samples; `slots` is the block's part of slot 0.
template <class V>
GAMUT_INLINE void runBlock(VectorUnit unit, const Instruction* i, const Instruction* end, double* slots) {
  constexpr std::size_t samples = block<V> * lanes<V>;
  const auto span = [](double* row) { return std::span<double>(row, samples); };
  V acc[block<V>];
  GAMUT_FOR_BLOCK acc[j] = V{};
  for (; i != end; ++i) {
    double* const a = slots + static_cast<std::ptrdiff_t>(i->a) * packWidth;
    double* const b = slots + static_cast<std::ptrdiff_t>(i->b) * packWidth;
    double* const result = slots + static_cast<std::ptrdiff_t>(i->result) * packWidth;
    switch (i->op) {
      case TapeOp::value:
        GAMUT_ACCUMULATE(left);
      case TapeOp::sum:
        GAMUT_ACCUMULATE(left + right);
      case TapeOp::difference:
        GAMUT_ACCUMULATE(left - right);
      case TapeOp::product:
        GAMUT_ACCUMULATE(left * right);
      case TapeOp::plus:
        GAMUT_ACCUMULATE(acc[j] + left);
      case TapeOp::minus:
        GAMUT_ACCUMULATE(acc[j] - left);
      case TapeOp::plusProduct:
        GAMUT_ACCUMULATE(acc[j] + left * right);
      case TapeOp::minusProduct:
        GAMUT_ACCUMULATE(acc[j] - left * right);
      case TapeOp::negative:
        GAMUT_ACCUMULATE(-left);
      case TapeOp::square:
        GAMUT_ACCUMULATE(left * left);
      case TapeOp::reciprocal:
        GAMUT_ACCUMULATE(1.0 / left);
      // These store their results themselves and leave no accumulator behind.
      case TapeOp::squareRoot:
      case TapeOp::exponential:
      case TapeOp::logarithm:
      case TapeOp::arcTangent:
        callFunction(i->op, span(a), span(result));
        GAMUT_FOR_BLOCK acc[j] = V{};
        continue;
      case TapeOp::sineCosine:
        sineCosine(unit, span(a), span(result), span(b));
        GAMUT_FOR_BLOCK acc[j] = V{};
        continue;
    }
    if (i->stores) GAMUT_FOR_BLOCK store(result + j * lanes<V>, acc[j]);
  }
}

template <class V>
GAMUT_INLINE void runPack(VectorUnit unit, const std::vector<Instruction>& instructions, double* slots) {
  static_assert(packWidth % (block<V> * lanes<V>) == 0);
  const Instruction* const begin = instructions.data();
  for (int lane = 0; lane < packWidth; lane += block<V> * lanes<V>)
    runBlock<V>(unit, begin, begin + instructions.size(), slots + lane);
}

void runOnBaseline(const std::vector<Instruction>& instructions, double* slots) {
  runPack<Vector2>(VectorUnit::baseline, instructions, slots);
}
GAMUT_AVX2 void runOnAvx2(const std::vector<Instruction>& instructions, double* slots) {
  runPack<Vector4>(VectorUnit::avx2, instructions, slots);
}
GAMUT_AVX512 void runOnAvx512(const std::vector<Instruction>& instructions, double* slots) {
  runPack<Vector8>(VectorUnit::avx512, instructions, slots);
}

}  // namespace

PackEvaluator::PackEvaluator(const Program& program, VectorUnit unit)
    : tape_(program), unit_(unit), slots_(at(std::max(1, tape_.slots()))) {
  if (program.parameters() == 0) setParameters({});
}

void PackEvaluator::fill(int slot, const double* row) { std::copy_n(row, packWidth, slots_[at(slot)].values); }

void PackEvaluator::run(const std::vector<Instruction>& instructions) {
  const auto execute = unit_ == VectorUnit::avx512 ? runOnAvx512
                       : unit_ == VectorUnit::avx2 ? runOnAvx2
                                                   : runOnBaseline;
  execute(instructions, slots_.front().values);
}

void PackEvaluator::setParameters(std::span<const double> p) {
  for (const auto& [input, slot] : tape_.constantInputs())
    std::fill_n(slots_[at(slot)].values, packWidth, midpoint(tape_.constants()[at(input)]));
  for (const auto& [input, slot] : tape_.parameterInputs()) fill(slot, &p[at(input) * packWidth]);
  run(tape_.invariants());
}

void PackEvaluator::operator()(std::span<const double> t, std::span<const double> x, std::span<double> y) {
  for (const auto& [input, slot] : tape_.stateInputs()) fill(slot, &x[at(input) * packWidth]);
  if (tape_.timeSlot() >= 0) fill(tape_.timeSlot(), t.data());
  run(tape_.instructions());
  const auto& outputs = tape_.outputSlots();
  for (std::size_t i = 0; i < outputs.size(); ++i)
    std::copy_n(slots_[at(outputs[i])].values, packWidth, &y[i * packWidth]);
}

void evaluateSamples(const Program& program, std::size_t n, double t, std::span<const double> x,
                     std::span<const double> p, std::span<double> y) {
  if (x.size() != at(program.states()) * n || p.size() != at(program.parameters()) * n ||
      y.size() != at(program.outputs()) * n)
    throw std::invalid_argument("samples of a program need a row for each state, parameter and output");
  PackEvaluator evaluator(program);
  const std::vector<double> time(packWidth, t);
  std::vector<double> states(at(program.states()) * packWidth), parameters(at(program.parameters()) * packWidth),
      outputs(at(program.outputs()) * packWidth);
  for (std::size_t first = 0; first < n; first += packWidth) {
    const std::size_t count = std::min<std::size_t>(packWidth, n - first);
    // The last pack is filled up with its last sample.
    const auto gather = [&](std::span<const double> rows, std::vector<double>& pack) {
      for (std::size_t row = 0; row < pack.size() / packWidth; ++row)
        for (std::size_t lane = 0; lane < packWidth; ++lane)
          pack[row * packWidth + lane] = rows[row * n + first + std::min(lane, count - 1)];
    };
    gather(x, states);
    if (!p.empty()) {
      gather(p, parameters);
      evaluator.setParameters(parameters);
    }
    evaluator(time, states, outputs);
    for (std::size_t row = 0; row < at(program.outputs()); ++row)
      std::copy_n(&outputs[row * packWidth], count, &y[row * n + first]);
  }
}

}  // namespace gamut
