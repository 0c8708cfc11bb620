// The interpreter of tapes on packs: the accumulator is a block of vector registers.
#include "scalars/evaluation/sample_pack.hpp"

#include <algorithm>
#include <stdexcept>

#include "scalars/operations/all.hpp"

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
  void runPositiveDefinite(int system, const TapeSolution* solution, int sample, int count) const;
};

namespace {

using namespace detail;

/// The vectors of the accumulator: a pack at once if eight registers hold it, or a part of the pack.
template <class V>
constexpr int block = std::min(8, packWidth / lanes<V>);

/// result = function(a), and where it has a twin that in `second`, which may be a: out of line, so that the accumulator
/// of the other instructions stays in registers.
void callFunction(Op op, VectorUnit unit, std::span<const double> a, std::span<double> result,
                  std::span<double> second) {
  withFunction(op, [&](auto f) {
    if constexpr (requires { f.ofPack(unit, a, result, second); }) {
      f.ofPack(unit, a, result, second);
    } else {
      for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = a[i];  // which may lie where the result goes
        evaluate(f, x, result[i], second[i]);
      }
    }
  });
}

constexpr int triangular(int i, int j) { return i * (i + 1) / 2 + j; }

#define GAMUT_FOR_GROUP _Pragma("GCC unroll 4") for (int j = 0; j < Group<V>::size; ++j)

/// Vectors side by side, whose operations the processor overlaps: those of one wait for one another.
template <class V>
struct __attribute__((may_alias)) Group {
  static constexpr int size = 4, samples = size * lanes<V>;
  V part[size];

  // As a whole it would be copied in pieces of 16 bytes: see load().
  GAMUT_INLINE Group(const Group& other) { *this = other; }
  GAMUT_INLINE Group& operator=(const Group& other) {  // NOLINT(bugprone-unhandled-self-assignment): numbers alone
    GAMUT_FOR_GROUP part[j] = other.part[j];
    return *this;
  }
};

template <class V>
GAMUT_INLINE void subtractProduct(Group<V>& x, const Group<V>& a, const Group<V>& b) {
  GAMUT_FOR_GROUP detail::subtractProduct(x.part[j], a.part[j], b.part[j]);
}
template <class V>
GAMUT_INLINE void multiplyBy(Group<V>& x, const Group<V>& a) {
  GAMUT_FOR_GROUP detail::multiplyBy(x.part[j], a.part[j]);
}
template <class V>
GAMUT_INLINE void invertPivot(Group<V>& x) {
  GAMUT_FOR_GROUP detail::invertPivot(x.part[j]);
}

/// A solution by the factors of L and D in rows, or their computation if there is no solution.
struct PositiveDefiniteTask {
  const TapeSystem& system;
  const TapeSolution* solution;
  double *slots, *factors;

  template <class V>
  GAMUT_INLINE void run(int sample) const {
    // The factors of a group lie side by side: its samples' rows would be 512 bytes apart, which caches dislike.
    double* const ofGroup = factors + static_cast<std::ptrdiff_t>(sample) * triangular(system.size, 0);
    const auto factor = [=](int i, int j) __attribute__((always_inline))->Group<V>& {
      return *reinterpret_cast<Group<V>*>(ofGroup + triangular(i, j) * Group<V>::samples);
    };
    const auto slot = [ this, sample ](std::int32_t number) __attribute__((always_inline))->Group<V>& {
      return *reinterpret_cast<Group<V>*>(slots + static_cast<std::ptrdiff_t>(number) * packWidth + sample);
    };
    const int n = system.size;
    if (solution == nullptr) {
      const std::int32_t* const entries = system.entries.data();
      factoriseLDLt<Group<V>>(
          n, [=](int i, int j) __attribute__((always_inline))->Group<V> & { return slot(entries[i * n + j]); }, factor);
    } else {
      const std::int32_t *const r = solution->rightSide.data(), *const x = solution->results.data();
      solveLDLt<Group<V>>(
          n, factor, [=](int i) __attribute__((always_inline))->Group<V> & { return slot(r[i]); },
          [=](int i) __attribute__((always_inline))->Group<V> & { return slot(x[i]); });
    }
  }
};

template <class V>
GAMUT_INLINE void runTask(const PositiveDefiniteTask& task, int sample, int count) {
  for (int end = sample + count; sample < end; sample += Group<V>::samples) task.run<V>(sample);
}

void runTaskOnBaseline(const PositiveDefiniteTask& task, int sample, int count) {
  runTask<Vector2>(task, sample, count);
}
GAMUT_AVX2 void runTaskOnAvx2(const PositiveDefiniteTask& task, int sample, int count) {
  runTask<Vector4>(task, sample, count);
}
GAMUT_AVX512 void runTaskOnAvx512(const PositiveDefiniteTask& task, int sample, int count) {
  runTask<Vector8>(task, sample, count);
}

template <class V>
GAMUT_INLINE void broadcast(V& to, double from) {
  to = from - V{};  // exactly: −0 stays −0
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

// The same where the right operand is one number for all samples: it is loaded once.
#define GAMUT_ACCUMULATE_UNIFORM(expression) \
  {                                          \
    V right;                                 \
    broadcast(right, *b);                    \
    GAMUT_FOR_BLOCK {                        \
      [[maybe_unused]] V left;               \
      load(left, a + j * lanes<V>);          \
      acc[j] = expression;                   \
    }                                        \
  }                                          \
  break

/// An instruction as a case of a switch.
constexpr int caseOf(TapeOp op, bool isUniform = false) { return 2 * static_cast<int>(op) + (isUniform ? 1 : 0); }

/// Runs the instructions on the block of samples from `sample` on. A case an operation, in one loop that keeps `acc` in
/// registers: longer than functions should be, and slower in parts.
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
    switch (caseOf(i->op, i->isUniform)) {
      case caseOf(TapeOp::value):
        GAMUT_ACCUMULATE(left);
      case caseOf(TapeOp::sum):
        GAMUT_ACCUMULATE(left + right);
      case caseOf(TapeOp::difference):
        GAMUT_ACCUMULATE(left - right);
      case caseOf(TapeOp::product):
        GAMUT_ACCUMULATE(left * right);
      case caseOf(TapeOp::plus):
        GAMUT_ACCUMULATE(acc[j] + left);
      case caseOf(TapeOp::minus):
        GAMUT_ACCUMULATE(acc[j] - left);
      case caseOf(TapeOp::plusProduct):
        GAMUT_ACCUMULATE(acc[j] + left * right);
      case caseOf(TapeOp::minusProduct):
        GAMUT_ACCUMULATE(acc[j] - left * right);
      case caseOf(TapeOp::negative):
        GAMUT_ACCUMULATE(-left);
      case caseOf(TapeOp::square):
        GAMUT_ACCUMULATE(left * left);
      case caseOf(TapeOp::reciprocal):
        GAMUT_ACCUMULATE(1.0 / left);
      case caseOf(TapeOp::sum, true):
        GAMUT_ACCUMULATE_UNIFORM(left + right);
      case caseOf(TapeOp::difference, true):
        GAMUT_ACCUMULATE_UNIFORM(left - right);
      case caseOf(TapeOp::product, true):
        GAMUT_ACCUMULATE_UNIFORM(left * right);
      case caseOf(TapeOp::plus, true):
        GAMUT_ACCUMULATE_UNIFORM(acc[j] + right);
      case caseOf(TapeOp::minus, true):
        GAMUT_ACCUMULATE_UNIFORM(acc[j] - right);
      case caseOf(TapeOp::plusProduct, true):
        GAMUT_ACCUMULATE_UNIFORM(acc[j] + left * right);
      case caseOf(TapeOp::minusProduct, true):
        GAMUT_ACCUMULATE_UNIFORM(acc[j] - left * right);
      // These store their results themselves and leave no accumulator behind.
      case caseOf(TapeOp::function):
        callFunction(i->function, pack.unit, span(a), span(result), span(b));
        GAMUT_FOR_BLOCK acc[j] = V{};
        continue;
      case caseOf(TapeOp::factorise):
        pack.factorise(i->result, sample, samples);
        GAMUT_FOR_BLOCK acc[j] = V{};
        continue;
      case caseOf(TapeOp::solution):
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
  const TapeSystem& system = tape.systems()[number];
  if (system.kind == MatrixKind::positiveDefinite) return runPositiveDefinite(number, nullptr, sample, count);
  for (int i = sample; i < sample + count; ++i)
    factors[number].samples[i].assign(system.kind, system.size,
                                      [&](int row, int column) { return slot(system.entry(row, column))[i]; });
}

void PackRun::solve(std::int32_t number, int sample, int count) const {
  const TapeSolution& solution = tape.solutions()[number];
  if (tape.systems()[solution.system].kind == MatrixKind::positiveDefinite)
    return runPositiveDefinite(solution.system, &solution, sample, count);
  std::vector<double> x(solution.results.size());
  for (int i = sample; i < sample + count; ++i) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = slot(solution.rightSide[k])[i];
    factors[solution.system].samples[i].solve(x, solution.transposed);
    for (std::size_t k = 0; k < x.size(); ++k) slot(solution.results[k])[i] = x[k];
  }
}

void PackRun::runPositiveDefinite(int system, const TapeSolution* solution, int sample, int count) const {
  const auto execute = unit == VectorUnit::avx512 ? runTaskOnAvx512
                       : unit == VectorUnit::avx2 ? runTaskOnAvx2
                                                  : runTaskOnBaseline;
  execute({tape.systems()[system], solution, slots, factors[system].rows.front().values}, sample, count);
}

PackEvaluator::PackEvaluator(const Program& program, VectorUnit unit)
    : tape_(program), unit_(unit), slots_(at(std::max(1, tape_.slots()))), factors_(tape_.systems().size()) {
  for (std::size_t k = 0; k < factors_.size(); ++k) {
    const TapeSystem& system = tape_.systems()[k];
    if (system.kind == MatrixKind::positiveDefinite)
      factors_[k].rows.resize(triangular(system.size, 0));
    else
      factors_[k].samples.resize(packWidth);
  }
  if (program.parameters() == 0) setParameters({});
}

void PackEvaluator::fill(int slot, const double* row) { std::copy_n(row, packWidth, slots_[slot].values); }

void PackEvaluator::run(const std::vector<Instruction>& instructions) {
  const auto execute = unit_ == VectorUnit::avx512 ? runOnAvx512
                       : unit_ == VectorUnit::avx2 ? runOnAvx2
                                                   : runOnBaseline;
  execute({tape_, unit_, slots_.front().values, factors_}, instructions);
}

void PackEvaluator::setParameters(std::span<const double> p) {
  for (const auto& [input, slot] : tape_.constantInputs())
    std::fill_n(slots_[slot].values, packWidth, midpoint(tape_.constants()[input]));
  for (const auto& [input, slot] : tape_.parameterInputs()) fill(slot, &p[at(input) * packWidth]);
  run(tape_.invariants());
}

void PackEvaluator::operator()(std::span<const double> t, std::span<const double> x, std::span<double> y) {
  for (const auto& [input, slot] : tape_.stateInputs()) fill(slot, &x[at(input) * packWidth]);
  if (tape_.timeSlot() >= 0) fill(tape_.timeSlot(), t.data());
  run(tape_.instructions());
  const auto& outputs = tape_.outputSlots();
  for (std::size_t i = 0; i < outputs.size(); ++i) std::copy_n(slots_[outputs[i]].values, packWidth, &y[i * packWidth]);
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
