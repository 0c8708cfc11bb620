// From a Program to a Tape, in four steps: what the outputs need; which sums take in the products and sums that only
// they use; in what order; and which slot each value gets (a linear scan, M. Poletto and V. Sarkar 1999).
#include "scalars/evaluation/tape.hpp"
#include "scalars/index.hpp"
#include "scalars/program/angles.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace gamut {
namespace {

using detail::at;

constexpr int longestChain = 8;  // instructions between two stores: the operands of all are alive at once

bool isSum(Op op) { return op == Op::add || op == Op::sub; }

TapeOp unary(Op op) {
  return op == Op::neg     ? TapeOp::negative
         : op == Op::sqr   ? TapeOp::square
         : op == Op::recip ? TapeOp::reciprocal
                           : TapeOp::function;
}

/// A second result goes to slot b.
bool hasTwin(const Instruction& i) { return i.op == TapeOp::function && gamut::hasTwin(i.function); }

/// Instructions whose a and b are nodes, from the first to the one that stores. A step is known by the node that it
/// stores, the first of its twins; the factorisation of matrix m by the number m behind all nodes.
struct Step {
  int id;
  std::vector<Instruction> chain;
  std::vector<int> reads;    // nodes
  std::vector<int> results;  // nodes that get slots
};

}  // namespace

class TapeWriter {
 public:
  TapeWriter(const Program& program, Tape& tape) : program_(program), nodes_(program.nodes()), tape_(tape) {}

  void write() {
    denominator_.assign(nodes_.size(), -1);
    for (const int angle : halfAnglesOf(program_)) denominator_[angle] = denominatorOf(program_, angle);
    countUses();
    fuse();
    findUniform();
    system_.assign(program_.matrices().size(), -1);
    slot_.assign(nodes_.size(), -1);
    tape_.constants_ = program_.constants();
    const std::vector<Step> invariants = stepsInOrder(true), steps = shortestLived();
    keep(invariants);
    tape_.slots_ = tape_.keptSlots_;
    tape_.invariants_ = allocate(invariants, true);
    tape_.instructions_ = allocate(steps, false);
    for (int output : program_.outputNodes()) tape_.outputSlots_.push_back(slot_[output]);
  }

 private:
  const Node& node(int i) const { return nodes_[i]; }
  int count() const { return static_cast<int>(nodes_.size()); }
  int steps() const { return count() + static_cast<int>(program_.matrices().size()); }
  bool isNeeded(int i) const { return uses_[i] > 0; }

  const LinearSolution& solution(int i) const { return program_.solutions()[node(i).a]; }
  const LinearMatrix& matrix(int m) const { return program_.matrices()[m]; }

  /// The node whose step computes node i: a cosine comes from its sine's, a component with component 0.
  int source(int i) const {
    if (isTwin(node(i).op)) return i - 1;
    return node(i).op == Op::solution ? i - node(i).b : i;
  }

  void countUses() {
    uses_.assign(nodes_.size(), 0);
    isOutput_.assign(nodes_.size(), false);
    isMatrixNeeded_.assign(program_.matrices().size(), false);
    for (int output : program_.outputNodes()) ++uses_[output], isOutput_[output] = true;
    for (int i = count() - 1; i >= 0; --i) {
      if (!isNeeded(i) || !isOperation(node(i).op)) continue;
      if (source(i) != i) {  // the operands are used by the source alone
        ++uses_[source(i)];
      } else if (node(i).op == Op::solution) {
        for (int r : solution(i).rightSide) ++uses_[r];
        const int m = solution(i).matrix;
        if (isMatrixNeeded_[m]) continue;
        isMatrixNeeded_[m] = true;
        for (int entry : matrix(m).entries) ++uses_[entry];
      } else {
        ++uses_[node(i).a];
        if (operandsOf(node(i).op) == 2) ++uses_[node(i).b];
        if (denominator_[i] >= 0) ++uses_[denominator_[i]];
      }
    }
  }

  /// Constants, and what follows from them alone.
  void findUniform() {
    isUniform_.assign(nodes_.size(), true);
    for (int i = 0; i < count(); ++i) {
      if (!isOperation(node(i).op)) isUniform_[i] = node(i).op == Op::constant;
      if (node(i).op == Op::solution) isUniform_[i] = false;
      for (int operand = 0; operand < operandsOf(node(i).op); ++operand)
        if (!isUniform_[operand == 0 ? node(i).a : node(i).b]) isUniform_[i] = false;
    }
  }

  /// Only `user` uses node i, so that its value need not be stored.
  bool isOnlyFor(int i, int user) const {
    return uses_[i] == 1 && !isOutput_[i] && program_.isInvariant(i) == program_.isInvariant(user);
  }

  /// Each sum takes in a sum that only it uses, as the accumulator's value, and products that only it uses.
  void fuse() {
    absorbed_.assign(nodes_.size(), false);
    accumulator_.assign(nodes_.size(), -1);
    std::vector<int> length(nodes_.size(), 1);
    for (int i = 0; i < count(); ++i) {
      const Node& n = node(i);
      if (!isNeeded(i) || !isSum(n.op)) continue;
      const auto fits = [&](int operand) {
        return isSum(node(operand).op) && isOnlyFor(operand, i) && length[operand] < longestChain;
      };
      // The later of two sums: the earlier one is a value that waits. A difference can continue its minuend alone.
      int first = -1;
      if (fits(n.a)) first = n.a;
      if (n.op == Op::add && fits(n.b) && n.b > first) first = n.b;
      for (int operand : {n.a, n.b})
        if (operand == first || (node(operand).op == Op::mul && isOnlyFor(operand, i))) absorbed_[operand] = true;
      accumulator_[i] = first;
      length[i] = first >= 0 ? length[first] + 1 : 2;
    }
  }

  bool isAbsorbedProduct(int i) const { return node(i).op == Op::mul && absorbed_[i]; }

  static Instruction instruction(TapeOp op, int a, int b) { return {.op = op, .stores = false, .a = a, .b = b}; }

  /// acc ± node i, a product if only this sum uses it.
  Instruction term(int i, bool negative) const {
    if (isAbsorbedProduct(i))
      return instruction(negative ? TapeOp::minusProduct : TapeOp::plusProduct, node(i).a, node(i).b);
    return instruction(negative ? TapeOp::minus : TapeOp::plus, i, i);
  }

  void appendSum(int i, std::vector<Instruction>& chain) const {
    const Node& n = node(i);
    const bool negative = n.op == Op::sub;
    if (const int first = accumulator_[i]; first >= 0) {
      appendSum(first, chain);
      chain.push_back(term(first == n.a ? n.b : n.a, negative));
    } else if (isAbsorbedProduct(n.a)) {
      chain.push_back(instruction(TapeOp::product, node(n.a).a, node(n.a).b));
      chain.push_back(term(n.b, negative));
    } else if (isAbsorbedProduct(n.b) && !negative) {
      chain.push_back(instruction(TapeOp::product, node(n.b).a, node(n.b).b));
      chain.push_back(term(n.a, false));
    } else if (isAbsorbedProduct(n.b)) {
      chain.push_back(instruction(TapeOp::value, n.a, n.a));
      chain.push_back(term(n.b, true));
    } else {
      chain.push_back(instruction(negative ? TapeOp::difference : TapeOp::sum, n.a, n.b));
    }
  }

  /// What is uniform comes second, where the order is free.
  void markUniform(Instruction& part) const {
    switch (part.op) {
      case TapeOp::sum:
      case TapeOp::product:
      case TapeOp::plusProduct:
      case TapeOp::minusProduct:
        if (isUniform_[part.a]) std::swap(part.a, part.b);
        [[fallthrough]];
      case TapeOp::difference:
      case TapeOp::plus:
      case TapeOp::minus:
        part.isUniform = isUniform_[part.b];
        break;
      default:
        break;
    }
  }

  Step step(int id) const {
    if (id >= count()) return {id, {{TapeOp::factorise, false}}, matrix(id - count()).entries, {}};
    const int i = id;
    const Node& n = node(i);
    Step result{i, {}, {}, {}};
    detail::forEachTwin(program_.table(), i, [&](int twin) { result.results.push_back(twin); });
    if (n.op == Op::solution) {
      result.chain.push_back({TapeOp::solution, false});
      result.reads = solution(i).rightSide;
      return result;
    }
    if (isSum(n.op))
      appendSum(i, result.chain);
    else if (n.op == Op::mul)
      result.chain.push_back(instruction(TapeOp::product, n.a, n.b));
    else
      result.chain.push_back({.op = unary(n.op),
                              .stores = false,
                              .function = n.op,
                              .a = n.a,
                              .b = denominator_[i] >= 0 ? denominator_[i] : n.a});
    result.chain.back().stores = true;
    for (Instruction& part : result.chain) markUniform(part);
    for (const Instruction& part : result.chain) result.reads.insert(result.reads.end(), {part.a, part.b});
    return result;
  }

  bool hasStep(int id, bool invariant) const {
    if (id >= count()) return isMatrixNeeded_[id - count()] && program_.isInvariantMatrix(id - count()) == invariant;
    return isNeeded(id) && !absorbed_[id] && isOperation(node(id).op) && source(id) == id &&
           program_.isInvariant(id) == invariant;
  }

  /// visit(step) for the steps that a step waits for.
  template <class Visit>
  void forEachSource(const Step& step, Visit visit) const {
    for (int operand : step.reads) visit(source(operand));
    if (step.id < count() && node(step.id).op == Op::solution) visit(count() + solution(step.id).matrix);
  }

  /// The steps of a section as recorded, each matrix factorised before its first solution, in whichever section that
  /// is.
  std::vector<Step> stepsInOrder(bool invariant) const {
    std::vector<Step> written;
    std::vector<char> isFactorised(program_.matrices().size(), 0);
    for (int i = 0; i < count(); ++i) {
      if (node(i).op == Op::solution && isFactorised[solution(i).matrix] == 0) {
        isFactorised[solution(i).matrix] = 1;
        if (const int id = count() + solution(i).matrix; hasStep(id, invariant)) written.push_back(step(id));
      }
      if (hasStep(i, invariant)) written.push_back(step(i));
    }
    return written;
  }

  /// The varying steps, each just before its first use, seen from the outputs.
  std::vector<Step> stepsOnDemand() const {
    std::vector<Step> written;
    std::vector<char> done(steps(), 0);
    std::vector<int> waiting;  // an explicit stack: programs are deep
    for (int output : program_.outputNodes()) {
      waiting.push_back(source(output));
      while (!waiting.empty()) {
        const int id = waiting.back();
        if (done[id] != 0 || !hasStep(id, false)) {
          waiting.pop_back();
          continue;
        }
        Step next = step(id);
        const std::size_t before = waiting.size();
        forEachSource(next, [&](int other) {
          if (done[other] == 0 && hasStep(other, false)) waiting.push_back(other);
        });
        if (waiting.size() > before) continue;
        waiting.pop_back();
        done[id] = 1;
        written.push_back(std::move(next));
      }
    }
    return written;
  }

  /// The order that needs fewer slots.
  std::vector<Step> shortestLived() const {
    std::vector<Step> recorded = stepsInOrder(false), onDemand = stepsOnDemand();
    return mostAlive(onDemand) < mostAlive(recorded) ? onDemand : recorded;
  }

  static constexpr int forever = std::numeric_limits<int>::max();

  /// For each node the last step that reads it, -1 for none; outputs are read after the end.
  std::vector<int> lastReads(const std::vector<Step>& steps) const {
    std::vector<int> last(nodes_.size(), -1);
    for (std::size_t s = 0; s < steps.size(); ++s)
      for (int operand : steps[s].reads) last[operand] = static_cast<int>(s);
    for (int output : program_.outputNodes()) last[output] = forever;
    return last;
  }

  int mostAlive(const std::vector<Step>& steps) const {
    const std::vector<int> last = lastReads(steps);
    std::vector<int> change(steps.size() + 1, 0);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      for (int i : steps[s].results) {
        ++change[s];
        if (last[i] != forever) --change[std::max(s + 1, at(std::max(last[i], 0)))];
      }
    }
    int alive = 0, most = 0;
    for (int difference : change) most = std::max(most, alive += difference);
    return most;
  }

  /// Slots that outlive the invariant section: what the other section, or an output, reads of it.
  void keep(const std::vector<Step>& invariants) {
    std::vector<char> isKept(nodes_.size(), 0);
    const auto mark = [&](int i) { isKept[i] |= program_.isInvariant(i) ? 1 : 0; };
    for (int i = 0; i < count(); ++i) {
      if (!isNeeded(i) || !isOperation(node(i).op) || program_.isInvariant(i) || source(i) != i) continue;
      if (node(i).op == Op::solution) {
        for (int r : solution(i).rightSide) mark(r);
        if (const int m = solution(i).matrix; !program_.isInvariantMatrix(m))
          for (int entry : matrix(m).entries) mark(entry);
        continue;
      }
      mark(node(i).a);
      if (operandsOf(node(i).op) == 2) mark(node(i).b);
      if (denominator_[i] >= 0) mark(denominator_[i]);
    }
    for (int output : program_.outputNodes()) mark(output);
    for (int i = 0; i < count(); ++i)
      if (isKept[i] != 0 && !isOperation(node(i).op)) slot_[i] = tape_.keptSlots_++;
    for (const Step& s : invariants)
      for (int i : s.results)
        if (isKept[i] != 0) slot_[i] = tape_.keptSlots_++;
  }

  /// The instructions of a step with the slots that they read and write.
  void complete(const Step& step, const std::vector<std::int32_t>& reads, std::vector<Instruction>& chain) {
    if (chain.back().op == TapeOp::solution) {
      chain.back().result = static_cast<int>(tape_.solutions_.size());
      const LinearSolution& of = solution(step.id);
      tape_.solutions_.push_back({system_[of.matrix], of.transposed, reads, slotsOf(step.results)});
    } else if (chain.back().op == TapeOp::factorise) {
      const LinearMatrix& of = matrix(step.id - count());
      chain.back().result = system_[step.id - count()] = static_cast<int>(tape_.systems_.size());
      tape_.systems_.push_back({of.kind, of.size, reads, detail::solvingOperations(program_.table(), of)});
    } else {
      for (std::size_t part = 0; part < chain.size(); ++part)
        chain[part].a = reads[2 * part], chain[part].b = reads[2 * part + 1];
      chain.back().result = slot_[step.id];
      if (hasTwin(chain.back())) chain.back().b = slot_[step.id + 1];
    }
  }

  /// Gives every value of a section a slot, reused after the value's last read, and writes the instructions.
  std::vector<Instruction> allocate(const std::vector<Step>& steps, bool invariant) {
    const std::vector<int> last = lastReads(steps);
    std::vector<int> free;  // the slot freed last is taken first: it is in the cache
    int next = tape_.keptSlots_;
    const auto take = [&](int i) {
      if (slot_[i] >= 0) return;  // kept
      if (free.empty()) free.push_back(next++);
      slot_[i] = free.back();
      free.pop_back();
    };
    std::vector<std::vector<int>> dying(steps.size());
    const auto lives = [&](int i) {
      const bool isTemporary = slot_[i] >= tape_.keptSlots_;
      if (isTemporary && last[i] >= 0 && last[i] != forever) dying[last[i]].push_back(i);
    };
    for (int i = 0; i < count(); ++i) {
      const Node& n = node(i);
      if (!isNeeded(i) || isOperation(n.op) || program_.isInvariant(i) != invariant) continue;
      take(i);
      lives(i);
      const int slot = slot_[i];
      if (n.op == Op::constant) tape_.constantInputs_.push_back({n.a, slot});
      if (n.op == Op::parameter) tape_.parameterInputs_.push_back({n.a, slot});
      if (n.op == Op::state) tape_.stateInputs_.push_back({n.a, slot});
      if (n.op == Op::time) tape_.timeSlot_ = slot;
    }
    std::vector<Instruction> written;
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const Step& step = steps[s];
      const auto takeResults = [&] {
        for (int i : step.results) {
          take(i);
          lives(i);
        }
      };
      // The result may take the slot of an operand that dies here: it is stored after all operands have been read. Not
      // so a solution's components, which are worked out in place.
      std::vector<Instruction> chain = step.chain;
      const bool isSolution = chain.back().op == TapeOp::solution;
      if (isSolution) takeResults();
      const std::vector<std::int32_t> reads = slotsOf(step.reads);
      for (int i : dying[s]) free.push_back(slot_[i]);
      if (!isSolution) takeResults();
      complete(step, reads, chain);
      for (int i : step.results)  // a sine without its cosine, say, or the reverse: the other is never read
        if (last[i] < 0 && slot_[i] >= tape_.keptSlots_) free.push_back(slot_[i]);
      written.insert(written.end(), chain.begin(), chain.end());
    }
    tape_.slots_ = std::max(tape_.slots_, next);
    return written;
  }

  std::vector<std::int32_t> slotsOf(const std::vector<int>& nodes) const {
    std::vector<std::int32_t> slots;
    for (int i : nodes) slots.push_back(slot_[i]);
    return slots;
  }

  const Program& program_;
  const std::vector<Node>& nodes_;
  Tape& tape_;
  std::vector<int> uses_, accumulator_, slot_;
  std::vector<int> denominator_;  // of each node that is half of an angle, else -1
  std::vector<int> system_;       // of each matrix, -1 before its factorisation
  std::vector<bool> isOutput_, isMatrixNeeded_, absorbed_, isUniform_;
};

Tape::Tape(const Program& program) { TapeWriter(program, *this).write(); }

int Tape::operations() const {
  int operations = 0;
  for (const Instruction& i : instructions_) {
    const bool isTwo = i.op == TapeOp::plusProduct || i.op == TapeOp::minusProduct || hasTwin(i);
    if (i.op == TapeOp::factorise) {
      operations += systems_[i.result].operations.factorisation;
    } else if (i.op == TapeOp::solution) {
      operations += systems_[solutions_[i.result].system].operations.solution;
    } else {
      operations += i.op == TapeOp::value ? 0 : isTwo ? 2 : 1;
    }
  }
  return operations;
}

}  // namespace gamut
