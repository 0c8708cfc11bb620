// The Recorder's memory: nodes, constants, and what is known to have a node already. The rules are in rules.cpp.
#include "scalars/program/recorder.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

#include "scalars/index.hpp"
#include "scalars/operations/all.hpp"
#include "scalars/program/angles.hpp"
#include "scalars/program/rules.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr int deepest = 16;  // rules inside one another; what is written by people and mechanisms needs a handful

std::vector<int> keyOf(const LinearMatrix& matrix) {
  std::vector<int> key{static_cast<int>(matrix.kind)};
  key.insert(key.end(), matrix.entries.begin(), matrix.entries.end());
  return key;
}

std::vector<int> keyOf(const LinearSolution& solution) {
  std::vector<int> key{solution.matrix, solution.transposed};
  key.insert(key.end(), solution.rightSide.begin(), solution.rightSide.end());
  return key;
}

/// Half of the angle of (x, 0): 0 or π/2, where the formula of (x, y) says 0 of both.
int halfAngleOfAxis(Recorder& r, int x) { return r.mul(r.atan(r.constant(1.0)), r.sub(r.constant(1.0), r.sign(x))); }

}  // namespace

void detail::NodeList::push(const Node& node) {
  const int number = static_cast<int>(nodes.size());
  nodes.push_back(node);
  const Signless inside = node.op == Op::neg ? signless[node.a] : Signless{number, true};
  signless.push_back({inside.node, !inside.isNegative});
}

bool detail::NodeList::isOnePlusSquare(int b, int a) const {
  const auto node = [&](int i) -> const Node& { return nodes[i]; };
  const auto value = [&](int i) { return node(i).op == Op::constant ? constants[node(i).a] : Interval::empty(); };
  const auto isSquare = [&](int q) {
    const bool isWritten = node(q).op == Op::sqr || (node(q).op == Op::mul && node(q).a == node(q).b);
    // Folded only where it is a double: then the number is known.
    const bool isFolded = isThin(value(a)) && isThin(value(q)) && isEqual(sqr(value(a)), value(q));
    return isFolded || (isWritten && signless[node(q).a].node == signless[a].node);
  };
  const auto isOne = [&](int i) { return isEqual(value(i), 1.0); };
  const Interval whole = 1.0 + sqr(value(a));
  if (isThin(whole) && isEqual(value(b), whole)) return true;
  const Node& sum = node(b);
  return sum.op == Op::add && ((isOne(sum.a) && isSquare(sum.b)) || (isOne(sum.b) && isSquare(sum.a)));
}

std::uint64_t Recorder::nextIdentity() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

Recorder*& Recorder::current() {
  thread_local Recorder* recorder = nullptr;
  return recorder;
}

Recorder::Recorder(int states, int parameters, RuleSet rules)
    : states_(states), parameters_(parameters), rules_(rules) {
  if (states < 0 || parameters < 0) throw std::invalid_argument("a program needs zero or more states and parameters");
  for (int i = 0; i < states; ++i) list_.push({Op::state, i});
  for (int i = 0; i < parameters; ++i) list_.push({Op::parameter, i});
  list_.push({Op::time});
}

Recorder::Recorder(const Program& program, RuleSet rules)
    : states_(program.states()), parameters_(program.parameters()), rules_(rules) {
  static_cast<detail::NodeTable&>(list_) = {{}, program.constants(), program.matrices(), program.solutions()};
  for (const Node& n : program.nodes()) list_.push(n);
  for (int i = 0; i < size(); ++i) {
    const Node& n = node(i);
    if (n.op == Op::constant && isThin(value(i))) knownDoubles_.emplace(value(i).lower(), i);
    if (n.op == Op::solution && n.b == 0)
      knownSolutions_.emplace(keyOf(list_.solutions[n.a]), i);
    else if (isOperation(n.op))
      known_.emplace(Key{n.op, n.a, n.b}, i);
  }
  for (std::size_t m = 0; m < list_.matrices.size(); ++m)
    knownMatrices_.emplace(keyOf(list_.matrices[m]), static_cast<int>(m));
}

bool Recorder::isExactly(int i, double number) const {
  return isConstant(i) && value(i).lower() == number && value(i).upper() == number;
}

int Recorder::unknown() {
  list_.push({Op::parameter, parameters_ + unknowns_++});
  return size() - 1;
}

int Recorder::constant(const Interval& number) {
  if (isEmpty(number) || !isBounded(number))
    throw std::domain_error("a recorded constant must be a bounded number, not " + toString(number));
  // -0.0 and 0.0 are one number: adding 0.0 maps both to 0.0.
  const double lower = number.lower() + 0.0, upper = number.upper() + 0.0;
  // Two real numbers may have the same enclosure: only a double is known by its value.
  if (lower == upper && rules_.has(RuleGroup::mergeEqual))
    if (const auto [known, isNew] = knownDoubles_.try_emplace(lower, size()); !isNew) return known->second;
  list_.push({Op::constant, static_cast<int>(list_.constants.size())});
  list_.constants.emplace_back(lower, upper);
  return size() - 1;
}

int Recorder::constantFrom(Op op, int a, int b, const Interval& number) {
  if (const auto known = derived_.find({op, a, b}); known != derived_.end()) return known->second;
  const int node = constant(number);
  derived_.emplace(Key{op, a, b}, node);
  return node;
}

int Recorder::negated(int c) {
  const int node = constantFrom(Op::neg, c, -1, -value(c));
  derived_.emplace(Key{Op::neg, node, -1}, c);
  return node;
}

int Recorder::scaled(int c, int d) {
  const Interval product = value(c) * value(d);
  if (!isBounded(product)) return -1;
  // Exact if both endpoints come back: divided by the power of two they are what they were.
  const auto [power, other] = isPowerOfTwo(value(c)) ? std::pair(c, d) : std::pair(d, c);
  if (!isEqual(product / value(power), value(other))) return -1;
  // Known by the value of the power, of which there may be several nodes: ±2^k is 2k, or 2k + 1 if negative.
  const double factor = value(power).lower();
  return constantFrom(Op::mul, other, 2 * std::ilogb(factor) + std::signbit(factor), product);
}

int Recorder::rewritten(Op op, int a, int b) {
  if (depth_ == deepest) return -1;
  struct Inside {
    int& depth;
    ~Inside() { --depth; }
  } const inside{++depth_};
  for (const Rule& rule : rulesOf(op)) {
    if (!rules_.has(rule.group)) continue;
    if (const int node = rule.apply(*this, a, b); node >= 0) return node;
  }
  return -1;
}

int Recorder::push(Op op, int a, int b) {
  const bool isPair = hasTwin(op);
  const auto append = [&] {
    list_.push({op, a, b});
    if (isPair) list_.push({twinOf(op), a, b});  // right behind: both are new or both are known
    return size() - (isPair ? 2 : 1);
  };
  const bool pairsByItself = isFunction(op) && withFunction(op, [](auto f) { return f.pairsByItself; });
  if (!rules_.has(pairsByItself ? RuleGroup::pairSinCos : RuleGroup::mergeEqual)) return append();
  // One order for a + b and b + a; a constant factor comes first.
  if (op == Op::add || (op == Op::mul && isConstant(a) == isConstant(b))) std::tie(a, b) = std::minmax({a, b});
  if (op == Op::mul && !isConstant(a) && isConstant(b)) std::swap(a, b);
  const auto [known, isNew] = known_.try_emplace(Key{op, a, b}, size());
  return isNew ? append() : known->second;
}

int Recorder::emit(Op op, int a, int b) {
  if (op == Op::solution) throw std::invalid_argument("a solution is recorded by solve(), not by emit()");
  if (hasTwin(op)) return pair(op, a).first;
  if (isTwin(op)) return pair(before(op), a).second;
  if (const int node = rewritten(op, a, b); node >= 0) return node;
  if (!isFunction(op)) return push(op, a, b);
  return withFunction(op, [&](auto f) {
    if constexpr (f.hasDenominator)
      if (b < 0 || !f.isDenominator(list_, b, a)) b = f.denominator(*this, a);
    return push(op, a, b);
  });
}

int Recorder::function(Op op, int a) {
  withFunction(op, [&](auto f) {
    if (isConstant(a) && !isDefinedOn(f.domain, value(a))) throw std::domain_error(std::string(f.refusal));
  });
  return emit(op, a);
}

std::pair<int, int> Recorder::pair(Op op, int a) {
  const int first = rewritten(op, a, -1), second = rewritten(twinOf(op), a, -1);
  if (first >= 0 && second >= 0) return {first, second};
  const int both = push(op, a, -1);
  return {first >= 0 ? first : both, second >= 0 ? second : both + 1};
}

int Recorder::matrix(LinearMatrix matrix) {
  if (matrix.size < 1 || matrix.entries.size() != at(matrix.size) * at(matrix.size))
    throw std::invalid_argument("a recorded matrix of " + std::to_string(matrix.size) + " rows needs as many columns");
  for (int i = 0; i < matrix.size; ++i)
    for (int j = 0; j < i && matrix.kind == MatrixKind::positiveDefinite; ++j)
      if (matrix.entry(i, j) != matrix.entry(j, i))
        throw std::invalid_argument("a positive definite matrix is recorded with one node for entries (i, j), (j, i)");
  const int next = static_cast<int>(list_.matrices.size());
  if (rules_.has(RuleGroup::mergeEqual))
    if (const auto [known, isNew] = knownMatrices_.try_emplace(keyOf(matrix), next); !isNew) return known->second;
  list_.matrices.push_back(std::move(matrix));
  return next;
}

std::vector<int> Recorder::solve(int matrix, bool transposed, const std::vector<int>& rightSide) {
  const LinearMatrix& of = list_.matrices.at(at(matrix));
  if (rightSide.size() != at(of.size))
    throw std::invalid_argument("a system of " + std::to_string(of.size) + " equations has as many right-hand sides");
  const auto isZero = [this](int r) { return isExactly(r, 0.0); };
  if (rules_.has(RuleGroup::simplify) && std::all_of(rightSide.begin(), rightSide.end(), isZero)) return rightSide;
  const LinearSolution solution{matrix, transposed && of.kind == MatrixKind::general, rightSide};
  int first = size();
  bool isNew = true;
  if (rules_.has(RuleGroup::mergeEqual)) {
    const auto [known, inserted] = knownSolutions_.try_emplace(keyOf(solution), first);
    first = known->second;
    isNew = inserted;
  }
  if (isNew) {
    const int number = static_cast<int>(list_.solutions.size());
    list_.solutions.push_back(solution);
    for (int k = 0; k < of.size; ++k) list_.push({Op::solution, number, k});
  }
  std::vector<int> components(rightSide.size());
  std::iota(components.begin(), components.end(), first);
  return components;
}

std::vector<int> Recorder::append(const Program& program, const std::vector<int>& parameters,
                                  const std::vector<int>& instead) {
  std::vector<int> here, matrices, components;
  here.reserve(program.nodes().size());
  const auto mapped = [&here](std::vector<int> nodes) {
    for (int& node : nodes) node = here[node];
    return nodes;
  };
  int twin = -1, solved = -1;
  const auto isReplaced = [&](std::size_t node) { return !instead.empty() && instead[node] >= 0; };
  matrices.assign(program.matrices().size(), -1);
  for (const Node& n : program.nodes()) {
    if (isReplaced(here.size())) {
      here.push_back(instead[here.size()]);
      continue;
    }
    if (n.op == Op::solution) {
      if (solved != n.a) {
        const LinearSolution& solution = program.solutions()[n.a];
        const LinearMatrix& of = program.matrices()[solution.matrix];
        int& number = matrices[solution.matrix];
        if (number < 0) number = matrix({of.kind, of.size, mapped(of.entries)});
        components = solve(number, solution.transposed, mapped(solution.rightSide));
        solved = n.a;
      }
      here.push_back(components[n.b]);
      continue;
    }
    const int a = isOperation(n.op) ? here[n.a] : -1, b = isOperation(n.op) && n.b >= 0 ? here[n.b] : -1;
    switch (n.op) {
      case Op::state:
        here.push_back(state(n.a));
        break;
      case Op::parameter:
        here.push_back(parameters.empty() ? parameter(n.a) : parameters[n.a]);
        break;
      case Op::time:
        here.push_back(time());
        break;
      case Op::constant:
        here.push_back(constant(program.constants()[n.a]));
        break;
      default:
        if (hasTwin(n.op)) {
          const auto [first, second] = pair(n.op, a);
          here.push_back(first);
          twin = second;
        } else if (const auto x = n.op == Op::atan && isExactly(a, 0)
                                      ? abscissaOf(program, static_cast<int>(here.size()))
                                      : std::nullopt) {
          here.push_back(halfAngleOfAxis(*this, x->isNegated ? neg(here[x->node]) : here[x->node]));
        } else {
          here.push_back(isTwin(n.op) && !isReplaced(here.size() - 1) ? twin : emit(n.op, a, b));
        }
    }
  }
  return here;
}

Program Recorder::program(const std::vector<int>& outputs) const {
  return selected(std::vector<char>(list_.nodes.size(), 1), outputs);
}

Program Recorder::finish(const std::vector<int>& outputs) const {
  std::vector<char> used(list_.nodes.size(), 0);
  for (int i = 0; i <= states_ + parameters_; ++i) used[i] = 1;
  for (int output : outputs) used[output] = 1;
  for (int i = size() - 1; i >= 0; --i) {
    if (!used[i]) continue;
    // Twins stay together; the last is met first on this way back, so the others are still to come.
    detail::forEachTwin(list_, i, [&](int twin) { used[twin] = 1; });
    detail::forEachOperand(list_, i, [&](int operand) { used[operand] = 1; });
  }
  return selected(used, outputs);
}

Program Recorder::selected(const std::vector<char>& wanted, const std::vector<int>& outputs) const {
  Program program;
  program.states_ = states_;
  program.parameters_ = parameters_;
  detail::NodeTable& table = program.table_;
  std::vector<int> renumbered(list_.nodes.size(), -1), matrices(list_.matrices.size(), -1);
  const auto moved = [&renumbered](std::vector<int> nodes) {
    for (int& node : nodes) node = renumbered[node];
    return nodes;
  };
  for (int i = 0; i < size(); ++i) {
    if (!wanted[i]) continue;
    Node n = node(i);
    if (n.op == Op::parameter && n.a >= parameters_)
      throw std::logic_error("a recorded program depends on an unknown that was to be eliminated");
    bool invariant = n.op == Op::parameter || n.op == Op::constant || isOperation(n.op);
    detail::forEachOperand(list_, i,
                           [&](int operand) { invariant = invariant && program.invariant_[renumbered[operand]]; });
    if (n.op == Op::constant) {
      table.constants.push_back(list_.constants[n.a]);
      n.a = static_cast<int>(table.constants.size()) - 1;
    } else if (n.op == Op::solution) {
      if (n.b == 0) {
        const LinearSolution& solution = list_.solutions[n.a];
        const LinearMatrix& matrix = list_.matrices[solution.matrix];
        int& number = matrices[solution.matrix];
        if (number < 0) {
          number = static_cast<int>(table.matrices.size());
          table.matrices.push_back({matrix.kind, matrix.size, moved(matrix.entries)});
        }
        table.solutions.push_back({number, solution.transposed, moved(solution.rightSide)});
      }
      n.a = static_cast<int>(table.solutions.size()) - 1;
    } else if (isOperation(n.op)) {
      n.a = renumbered[n.a];
      if (n.b >= 0) n.b = renumbered[n.b];
    }
    renumbered[i] = static_cast<int>(table.nodes.size());
    table.nodes.push_back(n);
    program.invariant_.push_back(invariant);
  }
  for (int output : outputs) program.outputs_.push_back(renumbered[output]);
  return program;
}

}  // namespace gamut
