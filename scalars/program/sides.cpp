// Signs become parameters first; sides are values of these.
#include "scalars/program/sides.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "scalars/index.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/linear_form.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

std::vector<int> jumpsOf(const Program& program) {
  std::vector<int> jumps;
  for (std::size_t i = 0; i < program.nodes().size(); ++i)
    if (program.nodes()[i].op == Op::sign) jumps.push_back(static_cast<int>(i));
  return jumps;
}

namespace {

/// Of each node, whether it depends on a state.
std::vector<char> ofStates(const Program& f) {
  std::vector<char> result;
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    bool does = f.nodes()[i].op == Op::state;
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) { does = does || result[operand] != 0; });
    result.push_back(static_cast<char>(does));
  }
  return result;
}

/// What a sign is of, without factors of which the sign is known: sign u = sign of `node`, times `by`.
struct Argument {
  int node;
  double by = 1;
};

Argument bareArgumentOf(const Program& f, int jump) {
  Argument result{f.nodes()[jump].a};
  for (;;) {
    const Node& u = f.nodes()[result.node];
    const auto signOf = [&](int node) {  // 0: not known
      if (f.nodes()[node].op == Op::recip) node = f.nodes()[node].a;
      const Node& of = f.nodes()[node];
      if (of.op != Op::constant) return 0.0;
      const Interval& value = f.constants()[of.a];
      return value.lower() > 0 ? 1.0 : value.upper() < 0 ? -1.0 : 0.0;
    };
    if (u.op == Op::neg)
      result = {u.a, -result.by};
    else if (u.op == Op::mul && signOf(u.a) != 0)
      result = {u.b, signOf(u.a) * result.by};
    else if (u.op == Op::mul && signOf(u.b) != 0)
      result = {u.a, signOf(u.b) * result.by};
    else
      return result;
  }
}

/// Where a node is zero.
struct Surface {
  int node;
  std::optional<LinearForm> form;
};

Surface surfaceOf(const Program& f, int node) { return {node, linearFormOf(f, node)}; }

/// ±1 if the node of one is that of the other times a number of this sign; 0 if that is not known.
double signOfRatio(const Surface& a, const Surface& b) {
  return a.node == b.node ? 1 : a.form && b.form ? signOfRatio(*a.form, *b.form) : 0;
}

/// What |u| or sign u is of: u, but for its sign and for factors in which no state is.
struct BareArgument {
  int u;
  std::vector<int> factors;
  bool isNegative = false;
};

BareArgument bareArgument(const Program& f, const std::vector<char>& moves, int u) {
  BareArgument bare{u, {}};
  for (;;) {
    const Node& node = f.nodes()[bare.u];
    const bool isProduct = node.op == Op::mul && (moves[node.a] == 0 || moves[node.b] == 0);
    if (node.op != Op::neg && !isProduct) return bare;
    bare.isNegative = bare.isNegative != (node.op == Op::neg);
    if (isProduct) bare.factors.push_back(moves[node.a] == 0 ? node.a : node.b);
    bare.u = isProduct && moves[node.a] == 0 ? node.b : node.a;
  }
}

/// f with factors in which no state is taken off the arguments of all its nodes of this kind that move: |k u| = |k||u|,
/// or sign(k u) = sign k sign u.
Program withBareArguments(const Program& f, Op kind) {
  const std::vector<char> moves = ofStates(f);
  std::vector<std::pair<std::size_t, BareArgument>> found;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (f.nodes()[i].op != kind || moves[i] == 0) continue;
    BareArgument bare = bareArgument(f, moves, f.nodes()[i].a);
    if (!bare.factors.empty()) found.emplace_back(i, std::move(bare));
  }
  if (found.empty()) return f;
  Recorder result(f.states(), f.parameters());
  std::vector<int> instead(f.nodes().size(), -1), outputs;
  const std::vector<int> plain = result.append(f);
  const auto of = [&](int node) { return kind == Op::abs ? result.abs(plain[node]) : result.sign(plain[node]); };
  for (const auto& [i, bare] : found) {
    int factor = of(bare.factors.front());
    for (std::size_t k = 1; k < bare.factors.size(); ++k) factor = result.mul(factor, of(bare.factors[k]));
    const int node = result.mul(factor, of(bare.u));
    instead[i] = kind == Op::sign && bare.isNegative ? result.neg(node) : node;
  }
  const std::vector<int> here = result.append(f, {}, instead);
  for (const int output : f.outputNodes()) outputs.push_back(here[output]);
  return result.finish(outputs);
}

}  // namespace

Program withBareKinks(const Program& f) { return withBareArguments(f, Op::abs); }

Program withBareSigns(const Program& f) { return withBareArguments(f, Op::sign); }

namespace {

/// g with u sign u for |u| where f jumps at u = 0.
std::optional<Program> withKinksThatJump(const Program& f, const Program& g) {
  std::vector<Surface> surfaces;
  for (const int jump : jumpsOf(f)) surfaces.push_back(surfaceOf(f, bareArgumentOf(f, jump).node));
  if (surfaces.empty()) return {};
  const std::vector<char> moves = ofStates(g);
  Recorder result(g.states(), g.parameters());
  std::vector<int> instead(g.nodes().size(), -1), outputs;
  const std::vector<int> plain = result.append(g);
  bool isNew = false;
  for (std::size_t i = 0; i < instead.size(); ++i) {
    if (g.nodes()[i].op != Op::abs || moves[i] == 0) continue;
    const Surface kink = surfaceOf(g, bareArgumentOf(g, static_cast<int>(i)).node);
    if (std::ranges::none_of(surfaces, [&](const Surface& surface) { return signOfRatio(kink, surface) != 0; }))
      continue;
    const int u = plain[g.nodes()[i].a];
    instead[i] = result.mul(u, result.sign(u));
    isNew = true;
  }
  if (!isNew) return {};
  const std::vector<int> here = result.append(g, {}, instead);
  for (const int output : g.outputNodes()) outputs.push_back(here[output]);
  return result.finish(outputs);
}

}  // namespace

Program withJumpingKinks(const Program& f) {
  std::optional<Program> jumping = withKinksThatJump(f, f);
  if (!jumping) return f;
  return isAffineInSigns(f) && !isAffineInSigns(*jumping) ? f : *std::move(jumping);
}

std::optional<Program> withJumpingKinks(const Program& f, const Program& g) {
  return withKinksThatJump(f, withBareKinks(g));
}

Program withOneSignASurface(const Program& f) {
  const std::vector<int> jumps = jumpsOf(f);
  std::vector<Surface> surfaces;
  std::vector<std::pair<std::size_t, double>> of;  // of each sign, which surface, and the sign's sign
  bool isNew = false;
  for (const int jump : jumps) {
    const auto [node, by] = bareArgumentOf(f, jump);
    const Surface surface = surfaceOf(f, node);
    double ratio = 0;
    std::size_t k = 0;
    for (; k < surfaces.size() && ratio == 0; ++k) ratio = signOfRatio(surface, surfaces[k]);
    isNew = isNew || ratio != 0 || node != f.nodes()[jump].a;
    if (ratio == 0) surfaces.push_back(surface);
    of.emplace_back(ratio == 0 ? k : k - 1, by * (ratio == 0 ? 1 : ratio));
  }
  if (!isNew) return f;
  // Written anew; once more, for signs within arguments.
  Recorder result(f.states(), f.parameters());
  std::vector<int> signs(f.nodes().size(), -1), here, outputs;
  for (int pass = 0; pass < 2; ++pass) {
    here = result.append(f, {}, signs);
    for (std::size_t j = 0; j < jumps.size(); ++j) {
      const auto [surface, by] = of[j];
      const int sign = result.sign(here[surfaces[surface].node]);
      signs[jumps[j]] = by > 0 ? sign : result.neg(sign);
    }
  }
  here = result.append(f, {}, signs);
  for (const int output : f.outputNodes()) outputs.push_back(here[output]);
  return result.finish(outputs);
}

Program withSignsGiven(const Program& f) {
  if (f.outputs() != f.states()) throw std::invalid_argument("sides need one rate for each state");
  const std::vector<int> jumps = jumpsOf(f);
  const int n = f.states(), k = f.parameters();
  Recorder recorder(n, k + static_cast<int>(jumps.size()));
  std::vector<int> instead(f.nodes().size(), -1);
  for (std::size_t j = 0; j < jumps.size(); ++j) instead[jumps[j]] = recorder.parameter(k + static_cast<int>(j));
  const std::vector<int> here = recorder.append(f, {}, instead);
  std::vector<int> outputs, arguments;
  std::vector<std::pair<int, int>> seeds{{recorder.time(), recorder.constant(1.0)}};
  for (int i = 0; i < n; ++i) {
    outputs.push_back(here[f.outputNodes()[i]]);
    seeds.emplace_back(recorder.state(i), outputs.back());
  }
  for (const int jump : jumps) arguments.push_back(here[f.nodes()[jump].a]);
  const std::vector<int> rates = tangents(recorder, arguments, seeds);
  outputs.insert(outputs.end(), arguments.begin(), arguments.end());
  outputs.insert(outputs.end(), rates.begin(), rates.end());
  return recorder.finish(outputs);
}

namespace {

/// The product of a parameter with what depends on none from `signs` on, where nothing else depends on that parameter.
struct OnlyProduct {
  int node;
  std::vector<int> factors;
  bool isNegative = false;
};

OnlyProduct onlyProductOf(const Program& given, int signs, int parameter) {
  const std::size_t size = given.nodes().size();
  std::vector<int> uses(size, 0), user(size, -1);
  std::vector<char> ofSigns(size, 0);
  int node = -1;
  for (std::size_t i = 0; i < size; ++i) {
    const Node& own = given.nodes()[i];
    if (own.op == Op::parameter && own.a == parameter) node = static_cast<int>(i);
    ofSigns[i] = static_cast<char>(own.op == Op::parameter && own.a >= signs);
    detail::forEachOperand(given.table(), static_cast<int>(i), [&](int operand) {
      ++uses[operand];
      user[operand] = static_cast<int>(i);
      ofSigns[i] |= ofSigns[operand];
    });
  }
  for (const int output : given.outputNodes()) ++uses[output];
  OnlyProduct result{node, {}};
  while (result.node >= 0 && uses[result.node] == 1 && user[result.node] >= 0) {
    const int next = user[result.node];
    const Node& product = given.nodes()[next];
    if (product.op == Op::neg) {
      result.isNegative = !result.isNegative;
    } else {
      const int other = product.a == result.node ? product.b : product.a;
      if (product.op != Op::mul || ofSigns[other] != 0) break;
      result.factors.push_back(other);
    }
    result.node = next;
  }
  return result;
}

}  // namespace

Program withHeldGiven(const Program& f, std::span<const char> held) {
  const Program given = withSignsGiven(f);
  const int n = f.states(), k = f.parameters(), jumps = static_cast<int>(held.size());
  Recorder recorder(n, given.parameters());
  std::vector<int> instead(given.nodes().size(), -1);
  std::vector<OnlyProduct> products;
  for (int j = 0; j < jumps; ++j) {
    if (held[j] == 0) continue;
    products.push_back(onlyProductOf(given, k, k + j));
    if (products.back().node >= 0) instead[products.back().node] = recorder.parameter(k + j);
  }
  const std::vector<int> here = recorder.append(given, {}, instead);
  std::vector<int> outputs, moves;
  for (const int output : given.outputNodes()) outputs.push_back(here[output]);
  for (int i = 0; i < n; ++i) moves.push_back(outputs[i]);
  for (int j = 0; j < jumps; ++j) moves.push_back(outputs[n + jumps + j]);
  auto product = products.begin();
  for (int j = 0; j < jumps; ++j) {
    if (held[j] == 0) continue;
    int factor = recorder.constant(product->isNegative ? -1.0 : 1.0);
    for (const int other : product->factors) factor = recorder.mul(factor, here[other]);
    outputs.push_back(factor);
    const std::vector<int> rise = tangents(recorder, moves, {{recorder.parameter(k + j), recorder.constant(1.0)}});
    outputs.insert(outputs.end(), rise.begin(), rise.end());
    ++product;
  }
  return recorder.finish(outputs);
}

namespace {

/// Whether f depends on its signs by sums and by products, of which both factors may depend on signs if `anyPower`. One
/// of what does not depend on states is as good as any number: no solution is held at it.
bool isPolynomialInSigns(const Program& f, bool anyPower) {
  std::vector<char> depends;
  const std::vector<char> moves = ofStates(f);
  const auto of = [&](int node) { return node >= 0 && depends[node] != 0; };
  for (const Node& node : f.nodes()) {
    bool does = node.op == Op::sign && moves[node.a] != 0, isAllowed = !does || !of(node.a);
    if (node.op == Op::solution) {
      const LinearSolution& solution = f.solutions()[node.a];
      for (const int entry : f.matrices()[solution.matrix].entries) isAllowed = isAllowed && !of(entry);
      for (const int entry : solution.rightSide) does = does || of(entry);
    } else if (isOperation(node.op) && !does) {
      does = of(node.a) || of(node.b);
      isAllowed = !does || node.op == Op::add || node.op == Op::sub || node.op == Op::neg ||
                  (node.op == Op::mul && (anyPower || !(of(node.a) && of(node.b)))) || (node.op == Op::sqr && anyPower);
    }
    if (!isAllowed) return false;
    depends.push_back(static_cast<char>(does));
  }
  return true;
}

}  // namespace

bool isAffineInSigns(const Program& f) { return isPolynomialInSigns(f, false); }

Program affineInSign(const Program& f) {
  const std::vector<int> jumps = jumpsOf(f);
  if (jumps.size() != 1 || isAffineInSigns(f) || !isPolynomialInSigns(f, true)) return f;
  const Program given = withSignsGiven(f);
  Recorder recorder(f.states(), f.parameters());
  std::vector<int> parameters;
  for (int i = 0; i < f.parameters(); ++i) parameters.push_back(recorder.parameter(i));
  const auto outputsWith = [&](double sign) {
    parameters.resize(f.parameters());
    parameters.push_back(recorder.constant(sign));
    const std::vector<int> here = recorder.append(given, parameters);
    std::vector<int> outputs;
    for (const int output : given.outputNodes()) outputs.push_back(here[output]);
    return outputs;
  };
  const std::vector<int> above = outputsWith(1), below = outputsWith(-1);
  const int sign = recorder.sign(above[f.states()]), half = recorder.constant(0.5);
  std::vector<int> rates;
  for (int i = 0; i < f.states(); ++i) {
    const int mean = recorder.mul(half, recorder.add(above[i], below[i]));
    rates.push_back(recorder.add(mean, recorder.mul(sign, recorder.mul(half, recorder.sub(above[i], below[i])))));
  }
  return recorder.finish(rates);
}

namespace {

/// Which of f's signs, or its negative, a sign of another program is.
struct SharedSign {
  int jump;
  std::size_t which;
  double by;
};

/// The signs of states in g that are signs of f's surfaces.
std::vector<SharedSign> sharedSigns(const Program& f, const Program& g) {
  if (jumpsOf(f).empty()) return {};
  Recorder both(f.states(), f.parameters());
  const std::vector<int> ofF = both.append(f), ofG = both.append(g);
  std::vector<std::pair<Surface, double>> surfaces;
  for (const int jump : jumpsOf(f)) {
    const auto [node, by] = bareArgumentOf(f, jump);
    surfaces.push_back({{ofF[node], linearFormOf(f, node)}, by});
  }
  std::vector<SharedSign> shared;
  const std::vector<char> moves = ofStates(g);
  for (const int jump : jumpsOf(g)) {
    if (moves[jump] == 0) continue;
    const auto [node, by] = bareArgumentOf(g, jump);
    const Surface own{ofG[node], linearFormOf(g, node)};
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      const auto& [surface, bySurface] = surfaces[k];
      const double ratio = signOfRatio(own, surface);
      if (ratio == 0) continue;
      shared.push_back({jump, k, by * bySurface * ratio});
      break;
    }
  }
  return shared;
}

/// What the sign at zero of an argument is that is no surface of f as far as its formula tells.
enum class Unknown {
  number,   ///< 0, that of a number
  anything  ///< and all from -1 to 1: it may be a surface of f that is written otherwise, at which f holds solutions
};

/// g's outputs with nodes of `recorder` for the signs of f.
Program withSigns(Recorder& recorder, const std::vector<int>& signs, const Program& f, const Program& asWritten,
                  Unknown unknown) {
  const Program g = withBareSigns(asWritten);
  std::vector<int> parameters, instead(g.nodes().size(), -1), outputs;
  for (int i = 0; i < g.parameters(); ++i) parameters.push_back(recorder.parameter(i));
  for (const auto& [jump, which, by] : sharedSigns(f, g))
    instead[jump] = by > 0 ? signs[which] : recorder.neg(signs[which]);
  const std::vector<char> moves = ofStates(g), jumps = ofStates(f);
  const bool mayHold = std::ranges::any_of(jumpsOf(f), [&](int jump) { return jumps[jump] != 0; });
  std::vector<int> others;
  for (const int jump : jumpsOf(g))
    if (unknown == Unknown::anything && mayHold && moves[jump] != 0 && instead[jump] < 0) others.push_back(jump);
  // With what may be on either side added to it; once more, for signs within arguments.
  for (int pass = 0; pass < 2 && !others.empty(); ++pass) {
    constexpr double tiny = 0x1p-1000;
    const int eitherSide = recorder.constant(Interval(-tiny, tiny));
    const std::vector<int> here = recorder.append(g, parameters, instead);
    for (const int jump : others) instead[jump] = recorder.sign(recorder.add(here[g.nodes()[jump].a], eitherSide));
  }
  const std::vector<int> here = recorder.append(g, parameters, instead);
  for (const int output : g.outputNodes()) outputs.push_back(here[output]);
  return recorder.finish(outputs);
}

}  // namespace

Program outputsOnSides(const Program& f, const Program& g, std::span<const Side> sides) {
  const Program sided = onSides(f, sides);
  Recorder recorder(sided);
  const auto signs = sided.outputNodes().end() - static_cast<std::ptrdiff_t>(sides.size());
  return withSigns(recorder, {signs, sided.outputNodes().end()}, f, g, Unknown::number);
}

Program outputsWithOpenSignsGiven(const Program& f, const Program& g, std::span<const Side> sides) {
  const Program sided = onSides(f, sides);
  const int k = f.parameters(), jumps = static_cast<int>(sides.size());
  Recorder recorder(f.states(), k + jumps);
  std::vector<int> parameters, instead(sided.nodes().size(), -1), signs;
  for (int i = 0; i < k; ++i) parameters.push_back(recorder.parameter(i));
  const auto first = sided.outputNodes().end() - jumps;
  for (int j = 0; j < jumps; ++j) {  // an open sign is one of the sided program's, or the negative
    if (sides[j] != Side::open) continue;
    const int node = first[j], given = recorder.parameter(k + j);
    const Node& sign = sided.nodes()[node];
    if (sign.op == Op::neg && instead[sign.a] < 0) instead[sign.a] = recorder.neg(given);
    if (sign.op == Op::sign && instead[node] < 0) instead[node] = given;
  }
  const std::vector<int> here = recorder.append(sided, parameters, instead);
  for (int j = 0; j < jumps; ++j) signs.push_back(sides[j] == Side::open ? recorder.parameter(k + j) : here[first[j]]);
  return withSigns(recorder, signs, f, g, Unknown::anything);
}

Program argumentsOfSigns(const Program& f) {
  const Program given = withSignsGiven(f);
  const auto first = given.outputNodes().begin() + f.states();
  return Recorder(given).finish({first, first + static_cast<std::ptrdiff_t>(jumpsOf(f).size())});
}

Program withSignsGiven(const Program& f, const Program& g) {
  const int k = g.parameters(), jumps = static_cast<int>(jumpsOf(f).size());
  Recorder recorder(g.states(), k + jumps);
  std::vector<int> signs;
  for (int j = 0; j < jumps; ++j) signs.push_back(recorder.parameter(k + j));
  return withSigns(recorder, signs, f, g, Unknown::anything);
}

namespace {

/// f on its sides, while it is written down.
class SidedMotion {
 public:
  SidedMotion(const Program& f, std::span<const Side> sides)
      : f_(f),
        sides_(sides),
        isAffine_(isAffineInSigns(f)),
        n_(f.states()),
        k_(f.parameters()),
        jumps_(static_cast<int>(sides.size())),
        given_(isAffine_ ? withHeldGiven(f, isHeld(sides)) : withSignsGiven(f)),
        recorder_(n_, k_),
        instead_(given_.nodes().size(), -1) {
    for (int i = 0; i < k_; ++i) parameters_.push_back(recorder_.parameter(i));
    for (int j = 0; j < jumps_; ++j) {
      const Side side = sides[j];
      const bool isFixed = side != Side::held && side != Side::open;
      if (side == Side::held) held_.push_back(j);
      parameters_.push_back(recorder_.constant(isFixed                           ? static_cast<double>(side)
                                               : isAffine_ && side == Side::held ? 0.0
                                                                                 : -1.0));
    }
    // What is held is zero, wherever it stands.
    for (const int j : held_) instead_[given_.outputNodes()[n_ + j]] = recorder_.constant(0.0);
    outputs_ = outputsWith(parameters_);
  }

  Program write() {
    giveOpen();
    hold();
    followForms();
    outputs_.resize(n_ + jumps_);
    outputs_.insert(outputs_.end(), parameters_.begin() + k_, parameters_.end());
    return recorder_.finish(outputs_);
  }

 private:
  static std::vector<char> isHeld(std::span<const Side> sides) {
    std::vector<char> result;
    for (const Side side : sides) result.push_back(static_cast<char>(side == Side::held));
    return result;
  }

  std::vector<int> outputsWith(const std::vector<int>& values) {
    const std::vector<int> here = recorder_.append(given_, values, instead_);
    std::vector<int> outputs;
    for (const int output : given_.outputNodes()) outputs.push_back(here[output]);
    return outputs;
  }

  /// f and all rates, of these outputs.
  std::vector<int> moved(const std::vector<int>& of) const {
    std::vector<int> result(of.begin(), of.begin() + n_);
    result.insert(result.end(), of.begin() + n_ + jumps_, of.begin() + n_ + 2 * jumps_);
    return result;
  }

  void giveOpen() {
    if (std::ranges::find(sides_, Side::open) == sides_.end()) return;
    for (int j = 0; j < jumps_; ++j)
      if (sides_[j] == Side::open) parameters_[k_ + j] = recorder_.sign(outputs_[n_ + j]);
    const std::vector<int> arguments(outputs_.begin() + n_, outputs_.begin() + n_ + jumps_);
    outputs_ = outputsWith(parameters_);
    if (!std::equal(arguments.begin(), arguments.end(), outputs_.begin() + n_))
      throw std::invalid_argument("a jump that depends on another one cannot be left open");
  }

  /// What each of those held adds to f and all rates: a step from below to above; of affine f by its product, whose
  /// factor is told.
  std::vector<std::vector<int>> stepsOfHeld(std::vector<int>& factors) {
    std::vector<std::vector<int>> steps;
    auto next = outputs_.begin() + n_ + 2 * jumps_;
    for (const int j : held_) {
      if (isAffine_) {
        factors.push_back(*next++);
        steps.emplace_back(next, next + n_ + jumps_);
        next += n_ + jumps_;
        continue;
      }
      std::vector<int> values = parameters_;
      values[k_ + j] = recorder_.constant(1.0);
      const std::vector<int> above = moved(outputsWith(values)), below = moved(outputs_);
      steps.emplace_back();
      for (std::size_t o = 0; o < above.size(); ++o) steps.back().push_back(recorder_.sub(above[o], below[o]));
    }
    return steps;
  }

  /// How much of each step makes all rates of those held zero.
  std::vector<int> sharesOf(const std::vector<std::vector<int>>& steps) {
    const std::vector<int> from = moved(outputs_);
    if (held_.empty()) return {};
    if (held_.size() == 1)
      return {recorder_.neg(recorder_.mul(from[n_ + held_[0]], recorder_.recip(steps[0][n_ + held_[0]])))};
    LinearMatrix matrix{MatrixKind::general, static_cast<int>(held_.size()), {}};
    std::vector<int> rightSide;
    for (const int j : held_) {
      for (const std::vector<int>& step : steps) matrix.entries.push_back(step[n_ + j]);
      rightSide.push_back(recorder_.neg(from[n_ + j]));
    }
    return recorder_.solve(recorder_.matrix(std::move(matrix)), false, rightSide);
  }

  void hold() {
    std::vector<int> factors;
    const std::vector<std::vector<int>> steps = stepsOfHeld(factors);
    const std::vector<int> shares = sharesOf(steps);
    for (std::size_t h = 0; h < held_.size(); ++h) {
      for (std::size_t o = 0; o < at(n_); ++o)
        outputs_[o] = recorder_.add(outputs_[o], recorder_.mul(shares[h], steps[h][o]));
      parameters_[k_ + held_[h]] =
          isAffine_ ? recorder_.mul(shares[h], recorder_.recip(factors[h]))
                    : recorder_.sub(recorder_.mul(recorder_.constant(2.0), shares[h]), recorder_.constant(1.0));
    }
  }

  /// Rates of states that follow from what is held: exactly, not only up to rounding.
  void followForms() {
    const std::vector<int> signs = jumpsOf(f_);
    std::vector<LinearForm> forms;
    for (const int j : held_)
      if (const auto form = linearFormOf(f_, f_.nodes()[signs[j]].a)) forms.push_back(*form);
    std::vector<const LinearForm*> all;
    for (const LinearForm& form : forms) all.push_back(&form);
    for (const auto& [which, state] : statesThatFollow(all)) {
      const std::vector<double>& c = forms[which].states;
      int sum = recorder_.constant(0.0);
      for (int i = 0; i < n_; ++i)
        if (c[i] != 0 && i != state)
          sum = recorder_.sub(sum, recorder_.mul(recorder_.constant(c[i] / c[state]), outputs_[i]));
      outputs_[state] = sum;
    }
  }

  const Program& f_;
  std::span<const Side> sides_;
  bool isAffine_;
  int n_, k_, jumps_;
  Program given_;
  Recorder recorder_;
  std::vector<int> instead_, parameters_, held_, outputs_;  // parameters: with signs behind; held: jumps
};

}  // namespace

Program onSides(const Program& f, std::span<const Side> sides) {
  if (jumpsOf(f).size() != sides.size()) throw std::invalid_argument("sides need one for each jump");
  return SidedMotion(f, sides).write();
}

}  // namespace gamut
