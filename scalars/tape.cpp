// From a Program to a Tape, in four steps: what the outputs need; which sums take in the products and sums that only
// they use; in what order; and which slot each value gets (a linear scan, M. Poletto and V. Sarkar 1999).
#include "scalars/tape.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <ostream>

namespace gamut {
namespace {

using detail::at;

constexpr int longestChain = 8;  // instructions between two stores: the operands of all are alive at once

bool isSum(Op op) { return op == Op::add || op == Op::sub; }

TapeOp unary(Op op) {
  switch (op) {
    case Op::neg:
      return TapeOp::negative;
    case Op::sqr:
      return TapeOp::square;
    case Op::recip:
      return TapeOp::reciprocal;
    case Op::sqrt:
      return TapeOp::squareRoot;
    case Op::exp:
      return TapeOp::exponential;
    case Op::log:
      return TapeOp::logarithm;
    case Op::atan:
      return TapeOp::arcTangent;
    default:
      return TapeOp::sineCosine;
  }
}

bool usesB(TapeOp op) {
  return op == TapeOp::sum || op == TapeOp::difference || op == TapeOp::product || op == TapeOp::plusProduct ||
         op == TapeOp::minusProduct;
}

/// Instructions whose a and b are nodes, from the first to the one that stores; `node` is what it stores.
struct Step {
  int node;
  std::vector<Instruction> chain;
};

}  // namespace

class TapeWriter {
 public:
  TapeWriter(const Program& program, Tape& tape) : program_(program), nodes_(program.nodes()), tape_(tape) {}

  void write() {
    countUses();
    fuse();
    slot_.assign(nodes_.size(), -1);
    tape_.constants_ = program_.constants();
    const std::vector<Step> invariants = stepsInOrder(true), steps = shortestLived();
    keep(invariants);
    tape_.slots_ = tape_.keptSlots_;
    tape_.invariants_ = allocate(invariants, true);
    tape_.instructions_ = allocate(steps, false);
    for (int output : program_.outputNodes()) tape_.outputSlots_.push_back(slot_[at(output)]);
  }

 private:
  const Node& node(int i) const { return nodes_[at(i)]; }
  int count() const { return static_cast<int>(nodes_.size()); }
  bool isNeeded(int i) const { return uses_[at(i)] > 0; }

  void countUses() {
    uses_.assign(nodes_.size(), 0);
    isOutput_.assign(nodes_.size(), false);
    for (int output : program_.outputNodes()) ++uses_[at(output)], isOutput_[at(output)] = true;
    for (int i = count() - 1; i >= 0; --i) {
      if (!isNeeded(i) || !isOperation(node(i).op)) continue;
      // A cosine comes from its sine's step: the sine is needed, the angle is used by the sine alone.
      ++uses_[at(node(i).op == Op::cos ? i - 1 : node(i).a)];
      if (operandsOf(node(i).op) == 2) ++uses_[at(node(i).b)];
    }
  }

  /// Only `user` uses node i, so that its value need not be stored.
  bool isOnlyFor(int i, int user) const {
    return uses_[at(i)] == 1 && !isOutput_[at(i)] && program_.isInvariant(i) == program_.isInvariant(user);
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
        return isSum(node(operand).op) && isOnlyFor(operand, i) && length[at(operand)] < longestChain;
      };
      // The later of two sums: the earlier one is a value that waits. A difference can continue its minuend alone.
      int first = -1;
      if (fits(n.a)) first = n.a;
      if (n.op == Op::add && fits(n.b) && n.b > first) first = n.b;
      for (int operand : {n.a, n.b})
        if (operand == first || (node(operand).op == Op::mul && isOnlyFor(operand, i))) absorbed_[at(operand)] = true;
      accumulator_[at(i)] = first;
      length[at(i)] = first >= 0 ? length[at(first)] + 1 : 2;
    }
  }

  bool isAbsorbedProduct(int i) const { return node(i).op == Op::mul && absorbed_[at(i)]; }

  static Instruction instruction(TapeOp op, int a, int b) { return {op, false, 0, a, b}; }

  /// acc ± node i, a product if only this sum uses it.
  Instruction term(int i, bool negative) const {
    if (isAbsorbedProduct(i))
      return instruction(negative ? TapeOp::minusProduct : TapeOp::plusProduct, node(i).a, node(i).b);
    return instruction(negative ? TapeOp::minus : TapeOp::plus, i, i);
  }

  void appendSum(int i, std::vector<Instruction>& chain) const {
    const Node& n = node(i);
    const bool negative = n.op == Op::sub;
    if (const int first = accumulator_[at(i)]; first >= 0) {
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

  Step step(int i) const {
    const Node& n = node(i);
    Step result{i, {}};
    if (isSum(n.op))
      appendSum(i, result.chain);
    else if (n.op == Op::mul)
      result.chain.push_back(instruction(TapeOp::product, n.a, n.b));
    else
      result.chain.push_back(instruction(unary(n.op), n.a, n.a));
    result.chain.back().stores = true;
    return result;
  }

  bool hasStep(int i, bool invariant) const {
    return isNeeded(i) && !absorbed_[at(i)] && isOperation(node(i).op) && node(i).op != Op::cos &&
           program_.isInvariant(i) == invariant;
  }

  /// The steps of a section as recorded.
  std::vector<Step> stepsInOrder(bool invariant) const {
    std::vector<Step> steps;
    for (int i = 0; i < count(); ++i)
      if (hasStep(i, invariant)) steps.push_back(step(i));
    return steps;
  }

  /// The varying steps, each just before its first use, seen from the outputs.
  std::vector<Step> stepsOnDemand() const {
    std::vector<Step> steps;
    std::vector<char> done(nodes_.size(), 0);
    std::vector<int> waiting;  // an explicit stack: programs are deep
    for (int output : program_.outputNodes()) {
      waiting.push_back(output);
      while (!waiting.empty()) {
        const int i = node(waiting.back()).op == Op::cos ? waiting.back() - 1 : waiting.back();
        if (done[at(i)] != 0 || !hasStep(i, false)) {
          waiting.pop_back();
          continue;
        }
        Step next = step(i);
        const std::size_t before = waiting.size();
        for (const Instruction& part : next.chain)
          for (int operand : {part.a, part.b}) {
            const int source = node(operand).op == Op::cos ? operand - 1 : operand;
            if (done[at(source)] == 0 && hasStep(source, false)) waiting.push_back(source);
          }
        if (waiting.size() > before) continue;
        waiting.pop_back();
        done[at(i)] = 1;
        steps.push_back(std::move(next));
      }
    }
    return steps;
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
      for (const Instruction& part : steps[s].chain) last[at(part.a)] = last[at(part.b)] = static_cast<int>(s);
    for (int output : program_.outputNodes()) last[at(output)] = forever;
    return last;
  }

  int mostAlive(const std::vector<Step>& steps) const {
    const std::vector<int> last = lastReads(steps);
    std::vector<int> change(steps.size() + 1, 0);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto born = [&](int i) {
        ++change[s];
        if (last[at(i)] != forever) --change[std::max(s + 1, at(std::max(last[at(i)], 0)))];
      };
      born(steps[s].node);
      if (node(steps[s].node).op == Op::sin) born(steps[s].node + 1);
    }
    int alive = 0, most = 0;
    for (int difference : change) most = std::max(most, alive += difference);
    return most;
  }

  /// Slots that outlive the invariant section: what the other section, or an output, reads of it.
  void keep(const std::vector<Step>& invariants) {
    std::vector<char> isKept(nodes_.size(), 0);
    const auto mark = [&](int i) { isKept[at(i)] |= program_.isInvariant(i) ? 1 : 0; };
    for (int i = 0; i < count(); ++i) {
      if (!isNeeded(i) || !isOperation(node(i).op) || program_.isInvariant(i)) continue;
      mark(node(i).a);
      if (operandsOf(node(i).op) == 2) mark(node(i).b);
    }
    for (int output : program_.outputNodes()) mark(output);
    for (int i = 0; i < count(); ++i)
      if (isKept[at(i)] != 0 && !isOperation(node(i).op)) slot_[at(i)] = tape_.keptSlots_++;
    for (const Step& s : invariants)
      for (int i : {s.node, s.node + 1})
        if ((i == s.node || node(s.node).op == Op::sin) && isKept[at(i)] != 0) slot_[at(i)] = tape_.keptSlots_++;
  }

  /// Gives every value of a section a slot, reused after the value's last read, and writes the instructions.
  std::vector<Instruction> allocate(const std::vector<Step>& steps, bool invariant) {
    const std::vector<int> last = lastReads(steps);
    std::vector<int> free;  // the slot freed last is taken first: it is in the cache
    int next = tape_.keptSlots_;
    const auto take = [&](int i) {
      if (slot_[at(i)] >= 0) return;  // kept
      if (free.empty()) free.push_back(next++);
      slot_[at(i)] = free.back();
      free.pop_back();
    };
    std::vector<std::vector<int>> dying(steps.size());
    const auto lives = [&](int i) {
      const bool isTemporary = slot_[at(i)] >= tape_.keptSlots_;
      if (isTemporary && last[at(i)] >= 0 && last[at(i)] != forever) dying[at(last[at(i)])].push_back(i);
    };
    for (int i = 0; i < count(); ++i) {
      const Node& n = node(i);
      if (!isNeeded(i) || isOperation(n.op) || program_.isInvariant(i) != invariant) continue;
      take(i);
      lives(i);
      const int slot = slot_[at(i)];
      if (n.op == Op::constant) tape_.constantInputs_.push_back({n.a, slot});
      if (n.op == Op::parameter) tape_.parameterInputs_.push_back({n.a, slot});
      if (n.op == Op::state) tape_.stateInputs_.push_back({n.a, slot});
      if (n.op == Op::time) tape_.timeSlot_ = slot;
    }
    std::vector<Instruction> written;
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const int result = steps[s].node;
      const bool isSine = node(result).op == Op::sin;
      std::vector<Instruction> chain = steps[s].chain;
      for (Instruction& part : chain) part.a = slot_[at(part.a)], part.b = slot_[at(part.b)];
      // The result may take the slot of an operand that dies here: it is stored after all operands have been read.
      for (int i : dying[s]) free.push_back(slot_[at(i)]);
      for (int i : {result, result + 1}) {
        if (i != result && !isSine) continue;
        take(i);
        lives(i);
      }
      chain.back().result = slot_[at(result)];
      if (isSine) chain.back().b = slot_[at(result + 1)];
      for (int i : {result, result + 1})  // a sine without its cosine, or the reverse: the other is never read
        if (isSine && last[at(i)] < 0 && slot_[at(i)] >= tape_.keptSlots_) free.push_back(slot_[at(i)]);
      written.insert(written.end(), chain.begin(), chain.end());
    }
    tape_.slots_ = std::max(tape_.slots_, next);
    return written;
  }

  const Program& program_;
  const std::vector<Node>& nodes_;
  Tape& tape_;
  std::vector<int> uses_, accumulator_, slot_;
  std::vector<bool> isOutput_, absorbed_;
};

Tape::Tape(const Program& program) : states_(program.states()), parameters_(program.parameters()) {
  TapeWriter(program, *this).write();
}

int Tape::operations() const {
  int operations = 0;
  for (const Instruction& i : instructions_) {
    const bool isTwo = i.op == TapeOp::plusProduct || i.op == TapeOp::minusProduct || i.op == TapeOp::sineCosine;
    operations += i.op == TapeOp::value ? 0 : isTwo ? 2 : 1;
  }
  return operations;
}

std::ostream& operator<<(std::ostream& out, const Tape& tape) {
  static const char* const names[] = {
      "value",    "sum",    "difference", "product",    "plus",        "minus",     "plusProduct", "minusProduct",
      "negative", "square", "reciprocal", "squareRoot", "exponential", "logarithm", "arcTangent",  "sineCosine"};
  out << "tape: " << tape.states() << " states, " << tape.parameters() << " parameters, " << tape.outputs()
      << " outputs, " << tape.operations() << " operations, " << tape.slots() << " slots (" << tape.keptSlots()
      << " kept)\n";
  for (const TapeInput& i : tape.constantInputs())
    out << "  s" << i.slot << " = " << tape.constants()[at(i.input)] << '\n';
  for (const TapeInput& i : tape.parameterInputs()) out << "  s" << i.slot << " = p[" << i.input << "]\n";
  const auto list = [&](const std::vector<Instruction>& section) {
    for (const Instruction& i : section) {
      out << "  " << names[static_cast<int>(i.op)] << " s" << i.a;
      if (usesB(i.op)) out << " s" << i.b;
      if (i.stores) out << " -> s" << i.result;
      if (i.op == TapeOp::sineCosine) out << " s" << i.b;
      out << '\n';
    }
  };
  list(tape.invariants());
  out << "  for each t, x:\n";
  for (const TapeInput& i : tape.stateInputs()) out << "  s" << i.slot << " = x[" << i.input << "]\n";
  if (tape.timeSlot() >= 0) out << "  s" << tape.timeSlot() << " = t\n";
  list(tape.instructions());
  out << "  outputs:";
  for (int slot : tape.outputSlots()) out << " s" << slot;
  return out << '\n';
}

}  // namespace gamut
