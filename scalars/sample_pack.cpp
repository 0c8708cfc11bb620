// The interpreter of tapes on packs: the accumulator is a block of vector registers.
#include "scalars/sample_pack.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scalars/vector_functions.hpp"

namespace gamut {

/// What instructions on systems work on: a block of samples, from one sample on.
struct PackRun {
  const Tape& tape;
  VectorUnit unit;
  double* slots;  // of the pack's first sample
  std::vector<PackEvaluator::Factors>& factors;

  double* slot(std::int32_t number) const { return slots + static_cast<std::ptrdiff_t>(number) * packWidth; }
  void factorise(std::int32_t number, int sample, int count) const;
  void solve(std::int32_t number, int sample, int count) const;
};

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

/// Rows of packs as vectors: row(i) is what lies in row i from one sample on.
template <class V, class Start>
struct VectorRows {
  using InArray = typename Layout<V>::InArray;
  Start start;
  int sample;

  template <class... I>
  GAMUT_INLINE InArray& operator()(I... i) const {
    return *reinterpret_cast<InArray*>(start(i...) + sample);
  }
};

constexpr int triangular(int i, int j) { return i * (i + 1) / 2 + j; }

template <class V>
GAMUT_INLINE void factoriseBlock(const TapeSystem& system, double* slots, double* factors, int sample, int count) {
  const std::int32_t* const entries = system.entries.data();
  const int n = system.size;
  const auto entry = [=](int i, int j) __attribute__((always_inline)) {
    return slots + static_cast<std::ptrdiff_t>(entries[i * n + j]) * packWidth;
  };
  const auto factor = [=](int i, int j) __attribute__((always_inline)) {
    return factors + triangular(i, j) * packWidth;
  };
  for (int end = sample + count; sample < end; sample += lanes<V>)
    factoriseLDLt<V>(n, VectorRows<V, decltype(entry)>{entry, sample}, VectorRows<V, decltype(factor)>{factor, sample});
}

template <class V>
GAMUT_INLINE void solveBlock(const TapeSolution& solution, double* slots, double* factors, int sample, int count) {
  const std::int32_t *const r = solution.rightSide.data(), *const x = solution.results.data();
  const int n = static_cast<int>(solution.results.size());
  const auto factor = [=](int i, int j) __attribute__((always_inline)) {
    return factors + triangular(i, j) * packWidth;
  };
  const auto right = [=](int i) __attribute__((always_inline)) {
    return slots + static_cast<std::ptrdiff_t>(r[i]) * packWidth;
  };
  const auto result = [=](int i) __attribute__((always_inline)) {
    return slots + static_cast<std::ptrdiff_t>(x[i]) * packWidth;
  };
  for (int end = sample + count; sample < end; sample += lanes<V>)
    solveLDLt<V>(n, VectorRows<V, decltype(factor)>{factor, sample}, VectorRows<V, decltype(right)>{right, sample},
                 VectorRows<V, decltype(result)>{result, sample});
}

void factoriseOnBaseline(const TapeSystem& system, double* slots, double* factors, int sample, int count) {
  factoriseBlock<Vector2>(system, slots, factors, sample, count);
}
GAMUT_AVX2 void factoriseOnAvx2(const TapeSystem& system, double* slots, double* factors, int sample, int count) {
  factoriseBlock<Vector4>(system, slots, factors, sample, count);
}
GAMUT_AVX512 void factoriseOnAvx512(const TapeSystem& system, double* slots, double* factors, int sample, int count) {
  factoriseBlock<Vector8>(system, slots, factors, sample, count);
}

void solveOnBaseline(const TapeSolution& solution, double* slots, double* factors, int sample, int count) {
  solveBlock<Vector2>(solution, slots, factors, sample, count);
}
GAMUT_AVX2 void solveOnAvx2(const TapeSolution& solution, double* slots, double* factors, int sample, int count) {
  solveBlock<Vector4>(solution, slots, factors, sample, count);
}
GAMUT_AVX512 void solveOnAvx512(const TapeSolution& solution, double* slots, double* factors, int sample, int count) {
  solveBlock<Vector8>(solution, slots, factors, sample, count);
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

/// Runs the instructions on the block of samples from `sample` on.
template <class V>
GAMUT_INLINE void runBlock(const PackRun& pack, const Instruction* i, const Instruction* end, int sample) {
  constexpr std::size_t samples = block<V> * lanes<V>;
  double* const slots = pack.slots + sample;
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
        sineCosine(pack.unit, span(a), span(result), span(b));
        GAMUT_FOR_BLOCK acc[j] = V{};
        continue;
      case TapeOp::factorise:
        pack.factorise(i->result, sample, samples);
        GAMUT_FOR_BLOCK acc[j] = V{};
        continue;
      case TapeOp::solution:
        pack.solve(i->result, sample, samples);
        GAMUT_FOR_BLOCK acc[j] = V{};
        continue;
    }
    if (i->stores) GAMUT_FOR_BLOCK store(result + j * lanes<V>, acc[j]);
  }
}

template <class V>
GAMUT_INLINE void runPack(const PackRun& pack, const std::vector<Instruction>& instructions) {
  static_assert(packWidth % (block<V> * lanes<V>) == 0);
  const Instruction* const begin = instructions.data();
  for (int sample = 0; sample < packWidth; sample += block<V> * lanes<V>)
    runBlock<V>(pack, begin, begin + instructions.size(), sample);
}

void runOnBaseline(const PackRun& pack, const std::vector<Instruction>& instructions) {
  runPack<Vector2>(pack, instructions);
}
GAMUT_AVX2 void runOnAvx2(const PackRun& pack, const std::vector<Instruction>& instructions) {
  runPack<Vector4>(pack, instructions);
}
GAMUT_AVX512 void runOnAvx512(const PackRun& pack, const std::vector<Instruction>& instructions) {
  runPack<Vector8>(pack, instructions);
}

}  // namespace

void PackRun::factorise(std::int32_t number, int sample, int count) const {
  const TapeSystem& system = tape.systems()[at(number)];
  PackEvaluator::Factors& to = factors[at(number)];
  if (system.kind == MatrixKind::positiveDefinite) {
    const auto execute = unit == VectorUnit::avx512 ? factoriseOnAvx512
                         : unit == VectorUnit::avx2 ? factoriseOnAvx2
                                                    : factoriseOnBaseline;
    return execute(system, slots, to.rows.front().values, sample, count);
  }
  for (int i = sample; i < sample + count; ++i)
    to.samples[at(i)].assign(system.kind, system.size,
                             [&](int row, int column) { return slot(system.entry(row, column))[i]; });
}

void PackRun::solve(std::int32_t number, int sample, int count) const {
  const TapeSolution& solution = tape.solutions()[at(number)];
  PackEvaluator::Factors& by = factors[at(solution.system)];
  if (!by.rows.empty()) {
    const auto execute = unit == VectorUnit::avx512 ? solveOnAvx512
                         : unit == VectorUnit::avx2 ? solveOnAvx2
                                                    : solveOnBaseline;
    return execute(solution, slots, by.rows.front().values, sample, count);
  }
  std::vector<double> x(solution.results.size());
  for (int i = sample; i < sample + count; ++i) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = slot(solution.rightSide[k])[i];
    by.samples[at(i)].solve(x, solution.transposed);
    for (std::size_t k = 0; k < x.size(); ++k) slot(solution.results[k])[i] = x[k];
  }
}

PackEvaluator::PackEvaluator(const Program& program, VectorUnit unit)
    : tape_(program), unit_(unit), slots_(at(std::max(1, tape_.slots()))), factors_(tape_.systems().size()) {
  for (std::size_t k = 0; k < factors_.size(); ++k) {
    const TapeSystem& system = tape_.systems()[k];
    if (system.kind == MatrixKind::positiveDefinite)
      factors_[k].rows.resize(at(triangular(system.size, 0)));
    else
      factors_[k].samples.resize(packWidth);
  }
  if (program.parameters() == 0) setParameters({});
}

void PackEvaluator::fill(int slot, const double* row) { std::copy_n(row, packWidth, slots_[at(slot)].values); }

void PackEvaluator::run(const std::vector<Instruction>& instructions) {
  const auto execute = unit_ == VectorUnit::avx512 ? runOnAvx512
                       : unit_ == VectorUnit::avx2 ? runOnAvx2
                                                   : runOnBaseline;
  execute({tape_, unit_, slots_.front().values, factors_}, instructions);
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
