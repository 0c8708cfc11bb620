// The Recorder's memory: nodes, constants, and what is known to have a node already. The rules are in rules.cpp.
#include "scalars/recorder.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "scalars/rules.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr int deepest = 16;  // rules inside one another; what is written by people and mechanisms needs a handful

}  // namespace

void detail::NodeList::push(const Node& node) {
  const int number = static_cast<int>(nodes.size());
  nodes.push_back(node);
  const Signless inside = node.op == Op::neg ? signless[at(node.a)] : Signless{number, true};
  signless.push_back({inside.node, !inside.isNegative});
}

bool detail::NodeList::isOnePlusSquare(int b, int a) const {
  const auto node = [&](int i) -> const Node& { return nodes[at(i)]; };
  const auto value = [&](int i) { return node(i).op == Op::constant ? constants[at(node(i).a)] : Interval::empty(); };
  const auto isSquare = [&](int q) {
    const bool isWritten = node(q).op == Op::sqr || (node(q).op == Op::mul && node(q).a == node(q).b);
    // Folded only where it is a double: then the number is known.
    const bool isFolded = isThin(value(a)) && isThin(value(q)) && isEqual(sqr(value(a)), value(q));
    return isFolded || (isWritten && signless[at(node(q).a)].node == signless[at(a)].node);
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
  list_.constants = program.constants();
  for (const Node& n : program.nodes()) list_.push(n);
  for (int i = 0; i < size(); ++i) {
    const Node& n = node(i);
    if (n.op == Op::constant && isThin(value(i))) knownDoubles_.emplace(value(i).lower(), i);
    if (isOperation(n.op)) known_.emplace(Key{n.op, n.a, n.b}, i);
  }
}

bool Recorder::isExactly(int i, double number) const {
  return isConstant(i) && value(i).lower() == number && value(i).upper() == number;
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
  const bool isPair = op == Op::sin;
  const auto append = [&] {
    list_.push({op, a, b});
    if (isPair) list_.push({Op::cos, a, b});  // right behind its sine: both are new or both are known
    return size() - (isPair ? 2 : 1);
  };
  if (!rules_.has(isPair ? RuleGroup::pairSinCos : RuleGroup::mergeEqual)) return append();
  // One order for a + b and b + a; a constant factor comes first.
  if (op == Op::add || (op == Op::mul && isConstant(a) == isConstant(b))) std::tie(a, b) = std::minmax({a, b});
  if (op == Op::mul && !isConstant(a) && isConstant(b)) std::swap(a, b);
  const auto [known, isNew] = known_.try_emplace(Key{op, a, b}, size());
  return isNew ? append() : known->second;
}

int Recorder::emit(Op op, int a, int b) {
  if (op == Op::sin) return sinCos(a).first;
  if (op == Op::cos) return sinCos(a).second;
  if (op == Op::atan && !list_.isOnePlusSquare(b, a)) return atan(a);
  const int node = rewritten(op, a, b);
  return node >= 0 ? node : push(op, a, b);
}

int Recorder::recip(int a) {
  if (isConstant(a) && contains(value(a), 0.0))
    throw std::domain_error("recorded division by a constant that may be zero");
  return emit(Op::recip, a);
}

int Recorder::sqrt(int a) {
  if (isConstant(a) && value(a).lower() < 0)
    throw std::domain_error("recorded square root of a constant that may be negative");
  return emit(Op::sqrt, a);
}

int Recorder::log(int a) {
  if (isConstant(a) && value(a).lower() <= 0)
    throw std::domain_error("recorded logarithm of a constant that may not be positive");
  return emit(Op::log, a, a);
}

int Recorder::atan(int a) {
  if (const int node = rewritten(Op::atan, a, -1); node >= 0) return node;
  const int square = sqr(a);
  return push(Op::atan, a, add(constant(Interval(1.0)), square));
}

std::pair<int, int> Recorder::sinCos(int a) {
  const int sine = rewritten(Op::sin, a, -1), cosine = rewritten(Op::cos, a, -1);
  if (sine >= 0 && cosine >= 0) return {sine, cosine};
  const int pair = push(Op::sin, a, -1);
  return {sine >= 0 ? sine : pair, cosine >= 0 ? cosine : pair + 1};
}

std::vector<int> Recorder::append(const Program& program) {
  std::vector<int> here;
  here.reserve(program.nodes().size());
  int cosine = -1;
  for (const Node& n : program.nodes()) {
    const int a = isOperation(n.op) ? here[at(n.a)] : -1, b = isOperation(n.op) && n.b >= 0 ? here[at(n.b)] : -1;
    switch (n.op) {
      case Op::state:
        here.push_back(state(n.a));
        break;
      case Op::parameter:
        here.push_back(parameter(n.a));
        break;
      case Op::time:
        here.push_back(time());
        break;
      case Op::constant:
        here.push_back(constant(program.constants()[at(n.a)]));
        break;
      case Op::sin: {
        const auto [s, c] = sinCos(a);
        here.push_back(s);
        cosine = c;
        break;
      }
      case Op::cos:
        here.push_back(cosine);
        break;
      default:
        here.push_back(emit(n.op, a, b));
    }
  }
  return here;
}

Program Recorder::program(const std::vector<int>& outputs) const {
  return selected(std::vector<char>(list_.nodes.size(), 1), outputs);
}

Program Recorder::finish(const std::vector<int>& outputs) const {
  std::vector<char> used(list_.nodes.size(), 0);
  for (int i = 0; i <= states_ + parameters_; ++i) used[at(i)] = 1;
  for (int output : outputs) used[at(output)] = 1;
  for (int i = size() - 1; i >= 0; --i) {
    const Node& n = node(i);
    // A sine and its cosine stay together (the cosine is met first on this way back).
    if (n.op == Op::cos && used[at(i)]) used[at(i - 1)] = 1;
    if (n.op == Op::sin && used[at(i)]) used[at(i + 1)] = 1;
    if (!used[at(i)] || !isOperation(n.op)) continue;
    used[at(n.a)] = 1;
    if (n.b >= 0) used[at(n.b)] = 1;
  }
  return selected(used, outputs);
}

Program Recorder::selected(const std::vector<char>& wanted, const std::vector<int>& outputs) const {
  Program program;
  program.states_ = states_;
  program.parameters_ = parameters_;
  std::vector<int> renumbered(list_.nodes.size(), -1);
  for (int i = 0; i < size(); ++i) {
    if (!wanted[at(i)]) continue;
    Node n = node(i);
    bool invariant = n.op == Op::parameter || n.op == Op::constant;
    if (n.op == Op::constant) {
      program.constants_.push_back(list_.constants[at(n.a)]);
      n.a = static_cast<int>(program.constants_.size()) - 1;
    } else if (isOperation(n.op)) {
      n.a = renumbered[at(n.a)];
      invariant = program.invariant_[at(n.a)];
      if (n.b >= 0) {
        n.b = renumbered[at(n.b)];
        invariant = invariant && program.invariant_[at(n.b)];
      }
    }
    renumbered[at(i)] = static_cast<int>(program.nodes_.size());
    program.nodes_.push_back(n);
    program.invariant_.push_back(invariant);
  }
  for (int output : outputs) program.outputs_.push_back(renumbered[at(output)]);
  return program;
}

}  // namespace gamut
