// Program and the Recorder's rewrites. Each is exact on real numbers (on the domain of what was recorded), so that a
// rewritten program has the values of the code it was recorded from.
#include "scalars/program.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

namespace gamut {
namespace {

using detail::at;

bool hasOperands(Op op) { return op != Op::state && op != Op::parameter && op != Op::time && op != Op::constant; }

const char* nameOf(Op op) {
  static const char* const names[] = {"state", "parameter", "time", "constant", "add", "sub",  "neg", "mul",
                                      "sqr",   "recip",     "sqrt", "exp",      "log", "atan", "sin", "cos"};
  return names[static_cast<int>(op)];
}

/// Folding is allowed where the operands are doubles and the result is one: then nothing is lost.
bool isExactFold(const Interval& result) { return !isEmpty(result) && isThin(result) && isBounded(result); }

bool isPowerOfTwo(const Interval& c) {
  int exponent = 0;
  return isThin(c) && std::fabs(std::frexp(c.lower(), &exponent)) == 0.5;
}

}  // namespace

int Program::operations() const {
  int count = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) count += hasOperands(nodes_[i].op) && invariant_[i] == 0;
  return count;
}

Program Program::differentiated(bool withParameters) const {
  Recorder recorder(*this);
  const int columns = states_ + (withParameters ? parameters_ : 0);
  std::vector<std::vector<int>> column;
  for (int j = 0; j < columns; ++j)
    column.push_back(recorder.derivatives(outputs_, {{j, recorder.constant(Interval(1.0))}}));
  std::vector<int> outputs = outputs_;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    for (int j = 0; j < states_; ++j) outputs.push_back(column[at(j)][i]);
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    for (int j = states_; j < columns; ++j) outputs.push_back(column[at(j)][i]);
  return recorder.finish(outputs);
}

std::ostream& operator<<(std::ostream& out, const Program& program) {
  out << "program: " << program.states() << " states, " << program.parameters() << " parameters, " << program.outputs()
      << " outputs, " << program.operations() << " operations\n";
  for (std::size_t i = 0; i < program.nodes_.size(); ++i) {
    const Node& node = program.nodes_[i];
    out << "  %" << i << (program.invariant_[i] != 0 ? "* = " : " = ") << nameOf(node.op);
    if (node.op == Op::constant)
      out << ' ' << program.constants_[at(node.a)];
    else if (node.op == Op::state || node.op == Op::parameter)
      out << ' ' << node.a;
    else
      for (int operand : {node.a, node.b})
        if (hasOperands(node.op) && operand >= 0) out << " %" << operand;
    out << '\n';
  }
  out << "  outputs:";
  for (int output : program.outputs_) out << " %" << output;
  return out << '\n';
}

Recorder*& Recorder::current() {
  thread_local Recorder* recorder = nullptr;
  return recorder;
}

Recorder::Recorder(int states, int parameters) : states_(states), parameters_(parameters) {
  if (states < 0 || parameters < 0) throw std::invalid_argument("a program needs zero or more states and parameters");
  for (int i = 0; i < states; ++i) nodes_.push_back({Op::state, i});
  for (int i = 0; i < parameters; ++i) nodes_.push_back({Op::parameter, i});
  nodes_.push_back({Op::time});
}

Recorder::Recorder(const Program& program)
    : states_(program.states()),
      parameters_(program.parameters()),
      nodes_(program.nodes()),
      constants_(program.constants()) {
  for (int i = 0; i < size(); ++i) {
    const Node& n = node(i);
    if (n.op == Op::constant && isThin(value(i))) knownConstants_.emplace(value(i).lower(), i);
    if (hasOperands(n.op)) known_.emplace(std::tuple(n.op, n.a, n.b), i);
  }
}

int Recorder::push(Op op, int a, int b) {
  const auto [entry, isNew] = known_.try_emplace(std::tuple(op, a, b), size());
  if (isNew) nodes_.push_back({op, a, b});
  return entry->second;
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
  if (lower == upper)
    if (const auto [known, isNew] = knownConstants_.try_emplace(lower, size()); !isNew) return known->second;
  nodes_.push_back({Op::constant, static_cast<int>(constants_.size())});
  constants_.emplace_back(lower, upper);
  return size() - 1;
}

int Recorder::derived(Op op, int a, int b, const Interval& number) {
  if (const auto known = known_.find(std::tuple(op, a, b)); known != known_.end()) return known->second;
  const int node = constant(number);
  known_.emplace(std::tuple(op, a, b), node);
  if (op == Op::neg) known_.emplace(std::tuple(op, node, -1), a);
  return node;
}

int Recorder::add(int a, int b) {
  if (isExactly(a, 0)) return b;
  if (isExactly(b, 0)) return a;
  if (isConstant(a) && isConstant(b) && isThin(value(a)) && isThin(value(b)))
    if (const Interval sum = value(a) + value(b); isExactFold(sum)) return constant(sum);
  if (node(b).op == Op::neg) return sub(a, node(b).a);
  if (node(a).op == Op::neg) return sub(b, node(a).a);
  if (a == b) return mul(constant(Interval(2.0)), a);
  return push(Op::add, std::min(a, b), std::max(a, b));
}

int Recorder::sub(int a, int b) {
  if (a == b) return constant(Interval(0.0));
  if (isExactly(b, 0)) return a;
  if (isExactly(a, 0)) return neg(b);
  if (isConstant(a) && isConstant(b) && isThin(value(a)) && isThin(value(b)))
    if (const Interval difference = value(a) - value(b); isExactFold(difference)) return constant(difference);
  if (node(b).op == Op::neg) return add(a, node(b).a);
  if (node(a).op == Op::neg) return neg(add(node(a).a, b));
  return push(Op::sub, a, b);
}

int Recorder::neg(int a) {
  if (isConstant(a)) return derived(Op::neg, a, -1, -value(a));
  if (node(a).op == Op::neg) return node(a).a;
  if (node(a).op == Op::sub) return push(Op::sub, node(a).b, node(a).a);
  return push(Op::neg, a);
}

int Recorder::mul(int a, int b) {
  if (isConstant(b)) std::swap(a, b);  // a constant factor comes first
  if (isConstant(a)) {
    const Interval factor = value(a);
    if (isExactly(a, 0)) return a;
    if (isExactly(a, 1)) return b;
    if (isExactly(a, -1)) return neg(b);
    if (isConstant(b)) {
      if (isExactly(b, 0)) return b;
      if (isExactly(b, 1)) return a;
      if (isExactly(b, -1)) return neg(a);
      const Interval product = factor * value(b);
      // Scaling an enclosed constant by a power of two is exact as well.
      if ((isThin(factor) && isThin(value(b)) && isExactFold(product)) || isPowerOfTwo(factor) ||
          isPowerOfTwo(value(b)))
        return derived(Op::mul, a, b, product);
    }
    if (node(b).op == Op::neg) return mul(neg(a), node(b).a);
    if (node(b).op == Op::mul && isConstant(node(b).a) && (isPowerOfTwo(factor) || isPowerOfTwo(value(node(b).a))))
      return mul(mul(a, node(b).a), node(b).b);
    return push(Op::mul, a, b);
  }
  if (a == b) return sqr(a);
  // x·(1/x) and x·((1/x)·y), on their domain: what a quotient divided before is taken back.
  for (auto [x, y] : {std::pair(a, b), std::pair(b, a)}) {
    const auto isInverse = [&, x = x](int i) { return node(i).op == Op::recip && node(i).a == x; };
    if (isInverse(y)) return constant(Interval(1.0));
    if (node(y).op == Op::mul && isInverse(node(y).a)) return node(y).b;
    if (node(y).op == Op::mul && isInverse(node(y).b)) return node(y).a;
  }
  if (node(a).op == Op::neg) return neg(mul(node(a).a, b));
  if (node(b).op == Op::neg) return neg(mul(a, node(b).a));
  // Powers of two move outwards, where they meet and cancel.
  for (auto [x, y] : {std::pair(a, b), std::pair(b, a)})
    if (node(x).op == Op::mul && isConstant(node(x).a) && isPowerOfTwo(value(node(x).a)))
      return mul(node(x).a, mul(node(x).b, y));
  return push(Op::mul, std::min(a, b), std::max(a, b));
}

int Recorder::sqr(int a) {
  if (isConstant(a) && isThin(value(a)))
    if (const Interval square = gamut::sqr(value(a)); isExactFold(square)) return constant(square);
  if (node(a).op == Op::neg) return sqr(node(a).a);
  return push(Op::sqr, a);
}

int Recorder::recip(int a) {
  if (isConstant(a)) {
    if (contains(value(a), 0.0)) throw std::domain_error("recorded division by a constant that may be zero");
    if (isThin(value(a)))
      if (const Interval inverse = Interval(1.0) / value(a); isExactFold(inverse)) return constant(inverse);
  }
  if (node(a).op == Op::recip) return node(a).a;
  if (node(a).op == Op::neg) return neg(recip(node(a).a));
  return push(Op::recip, a);
}

int Recorder::sqrt(int a) {
  if (isConstant(a)) {
    if (value(a).lower() < 0) throw std::domain_error("recorded square root of a constant that may be negative");
    if (isThin(value(a)))
      if (const Interval root = gamut::sqrt(value(a)); isExactFold(root)) return constant(root);
  }
  return push(Op::sqrt, a);
}

int Recorder::exp(int a) { return isExactly(a, 0) ? constant(Interval(1.0)) : push(Op::exp, a); }

int Recorder::log(int a) {
  if (isConstant(a) && value(a).lower() <= 0)
    throw std::domain_error("recorded logarithm of a constant that may not be positive");
  return isExactly(a, 1) ? constant(Interval(0.0)) : push(Op::log, a, a);
}

int Recorder::atan(int a) {
  if (isExactly(a, 0)) return a;
  return push(Op::atan, a, add(constant(Interval(1.0)), sqr(a)));
}

int Recorder::sin(int a) {
  if (isExactly(a, 0)) return a;
  if (node(a).op == Op::neg) return neg(sin(node(a).a));
  const int s = push(Op::sin, a);
  push(Op::cos, a);  // right behind its sine: both are new or both are known
  return s;
}

int Recorder::cos(int a) {
  if (isExactly(a, 0)) return constant(Interval(1.0));
  if (node(a).op == Op::neg) return cos(node(a).a);
  return sin(a) + 1;
}

std::vector<int> Recorder::derivatives(const std::vector<int>& of, const std::vector<std::pair<int, int>>& seeds) {
  int last = -1;
  for (int node : of) last = std::max(last, node);
  std::vector<int> d(at(last + 1), -1);  // -1: zero
  for (const auto& [input, value] : seeds)
    if (input <= last && !isExactly(value, 0)) d[at(input)] = value;
  for (int i = 0; i <= last; ++i) {
    const Node n = node(i);
    if (!hasOperands(n.op)) continue;
    const int da = d[at(n.a)];
    const int db = n.b >= 0 ? d[at(n.b)] : -1;
    if (da < 0 && db < 0) continue;
    int r = -1;
    switch (n.op) {
      case Op::add:
        r = da < 0 ? db : db < 0 ? da : add(da, db);
        break;
      case Op::sub:
        r = da < 0 ? neg(db) : db < 0 ? da : sub(da, db);
        break;
      case Op::neg:
        r = neg(da);
        break;
      case Op::mul: {
        const int left = da < 0 ? -1 : mul(da, n.b);
        const int right = db < 0 ? -1 : mul(n.a, db);
        r = left < 0 ? right : right < 0 ? left : add(left, right);
        break;
      }
      case Op::sqr:
        r = mul(constant(Interval(2.0)), mul(n.a, da));
        break;
      case Op::recip:
        r = neg(mul(sqr(i), da));
        break;  // (1/a)' = -a'/a^2
      case Op::sqrt:
        r = mul(mul(constant(Interval(0.5)), recip(i)), da);
        break;  // (√a)' = a'/(2√a)
      case Op::exp:
        r = mul(i, da);
        break;
      case Op::log:
        r = mul(recip(n.a), da);
        break;
      case Op::atan:
        r = mul(recip(n.b), da);
        break;  // a'/(1+a²)
      case Op::sin:
        r = mul(i + 1, da);
        break;
      case Op::cos:
        r = neg(mul(i - 1, da));
        break;
      case Op::state:
      case Op::parameter:
      case Op::time:
      case Op::constant:
        break;
    }
    d[at(i)] = r >= 0 && isExactly(r, 0) ? -1 : r;
  }
  std::vector<int> result;
  for (int node : of) result.push_back(d[at(node)] < 0 ? constant(Interval(0.0)) : d[at(node)]);
  return result;
}

Program Recorder::finish(const std::vector<int>& outputs) const {
  std::vector<char> used(nodes_.size(), 0);
  for (int i = 0; i <= states_ + parameters_; ++i) used[at(i)] = 1;
  for (int output : outputs) used[at(output)] = 1;
  for (int i = size() - 1; i >= 0; --i) {
    const Node& n = node(i);
    // A sine and its cosine stay together (the cosine is met first on this way back).
    if (n.op == Op::cos && used[at(i)]) used[at(i - 1)] = 1;
    if (n.op == Op::sin && used[at(i)]) used[at(i + 1)] = 1;
    if (!used[at(i)] || !hasOperands(n.op)) continue;
    used[at(n.a)] = 1;
    if (n.b >= 0) used[at(n.b)] = 1;
  }
  Program program;
  program.states_ = states_;
  program.parameters_ = parameters_;
  std::vector<int> renumbered(nodes_.size(), -1);
  for (int i = 0; i < size(); ++i) {
    if (!used[at(i)]) continue;
    Node n = node(i);
    bool invariant = n.op == Op::parameter || n.op == Op::constant;
    if (n.op == Op::constant) {
      program.constants_.push_back(constants_[at(n.a)]);
      n.a = static_cast<int>(program.constants_.size()) - 1;
    } else if (hasOperands(n.op)) {
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
