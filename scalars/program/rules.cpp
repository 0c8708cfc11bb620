// The table of rules. Why rewriting ends, whatever groups are enabled: a rule gives a node that is there already, or a
// constant, or moves a sign or a power of two outwards (into a constant where there is one), or turns an operation into
// one that no rule turns back (x + x into 2x, x·x into a square, a + (-b) into a - b). Signs are taken off all at once,
// so that rules seldom nest deeply; the Recorder sees to it that they never do.
#include "scalars/program/rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

#include "scalars/operations/all.hpp"

namespace gamut {
namespace {

using enum RuleGroup;

constexpr int none = -1;
constexpr std::string_view everywhere = "all reals";

bool isOf(const Recorder& r, int node, Op op) { return r.node(node).op == op; }
bool isThinConstant(const Recorder& r, int node) { return r.isConstant(node) && isThin(r.value(node)); }
bool isPower(const Recorder& r, int node) { return r.isConstant(node) && isPowerOfTwo(r.value(node)); }

/// The constant with this value if it is one double: then nothing is lost.
int folded(Recorder& r, const Interval& result) {
  return !isEmpty(result) && isThin(result) && isBounded(result) ? r.constant(result) : none;
}

template <class Function>
int foldedOf(Recorder& r, int a, Function function) {
  return isThinConstant(r, a) ? folded(r, function(r.value(a))) : none;
}

template <class Function>
int foldedOf(Recorder& r, int a, int b, Function function) {
  return isThinConstant(r, a) && isThinConstant(r, b) ? folded(r, function(r.value(a), r.value(b))) : none;
}

/// True for a factor ±2^k that may move outwards: so near to 1 that products overflow or underflow for it only at the
/// ends of the range of doubles.
bool isMovable(const Recorder& r, int node) {
  return isPower(r, node) && std::fabs(std::log2(magnitude(r.value(node)))) <= 64;
}

/// -x or x.
int withSign(Recorder& r, bool isNegative, int x) { return isNegative ? r.neg(x) : x; }

/// The operands of a product with a constant one first.
std::pair<int, int> constantFirst(const Recorder& r, int a, int b) {
  return r.isConstant(b) ? std::pair(b, a) : std::pair(a, b);
}

/// The constant factor and the other factor of the node c·x; {-1, -1} for any other.
std::pair<int, int> scaledNode(const Recorder& r, int node) {
  if (!isOf(r, node, Op::mul)) return {none, none};
  const auto [c, x] = constantFirst(r, r.node(node).a, r.node(node).b);
  return r.isConstant(c) ? std::pair(c, x) : std::pair(none, none);
}

/// The first that applies of f(a, b) and f(b, a).
template <class Function>
int eitherWay(int a, int b, Function f) {
  const int node = f(a, b);
  return node >= 0 ? node : f(b, a);
}

bool isInverse(const Recorder& r, int y, int x) { return isOf(r, y, Op::recip) && r.node(y).a == x; }

int product(Recorder& r, int a, int b) {
  std::tie(a, b) = constantFirst(r, a, b);
  if (!r.isConstant(a) || !r.isConstant(b)) return none;
  if (isPower(r, a) || isPower(r, b)) return r.scaled(a, b);
  return foldedOf(r, a, b, [](const Interval& x, const Interval& y) { return x * y; });
}

/// The factors of a product of products, in rising order; of constants those that are not negative, whose signs are the
/// whole's.
struct Factors {
  static constexpr std::size_t most = 8;
  std::array<int, most> nodes{};
  std::size_t count = 0;
  bool isNegative = false;

  /// False if there are more.
  bool multiply(Recorder& r, int node) {
    const auto [x, negated] = r.signless(node);
    isNegative = isNegative != negated;
    if (isOf(r, x, Op::mul)) return multiply(r, r.node(x).a) && multiply(r, r.node(x).b);
    if (isOf(r, x, Op::sqr)) return multiply(r, r.node(x).a) && multiply(r, r.node(x).a);
    if (count == most) return false;
    const bool isBelow = r.isConstant(x) && r.value(x).upper() < 0;
    isNegative = isNegative != isBelow;
    nodes[count++] = isBelow ? r.negated(x) : x;
    return true;
  }
};

/// 1 or -1 if a and b are products of the same factors, with the same or the other sign; else 0.
int sameProduct(Recorder& r, int a, int b) {
  const auto isProduct = [&](int node) {
    const Op op = r.node(r.signless(node).node).op;
    return op == Op::mul || op == Op::sqr;
  };
  Factors x, y;
  if (!isProduct(a) || !isProduct(b) || !x.multiply(r, a) || !y.multiply(r, b) || x.count != y.count) return 0;
  std::sort(x.nodes.begin(), x.nodes.begin() + x.count);
  std::sort(y.nodes.begin(), y.nodes.begin() + y.count);
  return x.nodes != y.nodes ? 0 : x.isNegative == y.isNegative ? 1 : -1;
}

constexpr std::string_view withoutOverflow = "where the products are defined; doubles where none of them overflows";

constexpr Rule table[] = {
    {Op::add, simplify, "x + 0 = x", everywhere,
     [](Recorder& r, int a, int b) { return r.isExactly(a, 0)   ? b
                                            : r.isExactly(b, 0) ? a
                                                                : none; }},
    {Op::add, foldConstants, "c + d, where it is a double", everywhere,
     [](Recorder& r, int a, int b) {
       return foldedOf(r, a, b, [](const Interval& x, const Interval& y) { return x + y; });
     }},
    {Op::add, moveSigns, "x + (-y) = x - y", everywhere,
     [](Recorder& r, int a, int b) {
       return eitherWay(a, b, [&](int x, int minus) {
         if (!isOf(r, minus, Op::neg)) return none;
         const auto [y, isNegative] = r.signless(minus);
         return isNegative ? r.sub(x, y) : r.add(x, y);
       });
     }},
    {Op::add, simplify, "x + x = 2·x", everywhere,
     [](Recorder& r, int a, int b) { return a == b ? r.mul(r.constant(2.0), a) : none; }},
    {Op::add, simplify, "x·(y·z) + (-y)·(x·z) = 0, however many factors are in whichever order", withoutOverflow,
     [](Recorder& r, int a, int b) { return sameProduct(r, a, b) < 0 ? r.constant(0.0) : none; }},

    {Op::sub, simplify, "x - x = 0", everywhere,
     [](Recorder& r, int a, int b) { return a == b ? r.constant(0.0) : none; }},
    {Op::sub, simplify, "x - 0 = x", everywhere,
     [](Recorder& r, int a, int b) { return r.isExactly(b, 0) ? a : none; }},
    {Op::sub, simplify, "0 - x = -x", everywhere,
     [](Recorder& r, int a, int b) { return r.isExactly(a, 0) ? r.neg(b) : none; }},
    {Op::sub, foldConstants, "c - d, where it is a double", everywhere,
     [](Recorder& r, int a, int b) {
       return foldedOf(r, a, b, [](const Interval& x, const Interval& y) { return x - y; });
     }},
    {Op::sub, simplify, "x·(y·z) - y·(x·z) = 0, however many factors are in whichever order", withoutOverflow,
     [](Recorder& r, int a, int b) { return sameProduct(r, a, b) > 0 ? r.constant(0.0) : none; }},
    {Op::sub, moveSigns, "x - (-y) = x + y", everywhere,
     [](Recorder& r, int a, int b) {
       if (!isOf(r, b, Op::neg)) return none;
       const auto [y, isNegative] = r.signless(b);
       return isNegative ? r.add(a, y) : r.sub(a, y);
     }},
    {Op::sub, moveSigns, "(-x) - y = -(x + y)", everywhere,
     [](Recorder& r, int a, int b) {
       if (!isOf(r, a, Op::neg)) return none;
       const auto [x, isNegative] = r.signless(a);
       return isNegative ? r.neg(r.add(x, b)) : r.sub(x, b);
     }},

    {Op::neg, foldConstants, "-c", everywhere,
     [](Recorder& r, int a, int) { return r.isConstant(a) ? r.negated(a) : none; }},
    {Op::neg, simplify, "-(-x) = x", everywhere,
     [](Recorder& r, int a, int) { return isOf(r, a, Op::neg) ? r.node(a).a : none; }},
    {Op::neg, moveSigns, "-(x - y) = y - x", everywhere,
     [](Recorder& r, int a, int) { return isOf(r, a, Op::sub) ? r.sub(r.node(a).b, r.node(a).a) : none; }},

    {Op::mul, simplify, "0·x = 0", everywhere,
     [](Recorder& r, int a, int b) { return r.isExactly(a, 0)   ? a
                                            : r.isExactly(b, 0) ? b
                                                                : none; }},
    {Op::mul, simplify, "1·x = x", everywhere,
     [](Recorder& r, int a, int b) { return r.isExactly(a, 1)   ? b
                                            : r.isExactly(b, 1) ? a
                                                                : none; }},
    {Op::mul, simplify, "(-1)·x = -x", everywhere,
     [](Recorder& r, int a, int b) { return r.isExactly(a, -1)   ? r.neg(b)
                                            : r.isExactly(b, -1) ? r.neg(a)
                                                                 : none; }},
    {Op::mul, foldConstants, "c·d, where it is a double or one of them is a power of two", everywhere, product},
    {Op::mul, moveSigns, "c·(-x) = (-c)·x", everywhere,
     [](Recorder& r, int a, int b) {
       const auto [c, x] = constantFirst(r, a, b);
       if (!r.isConstant(c) || !isOf(r, x, Op::neg)) return none;
       const auto [y, isNegative] = r.signless(x);
       return r.mul(isNegative ? r.negated(c) : c, y);
     }},
    {Op::mul, movePowersOfTwo, "c·(d·x) = (c·d)·x, where c or d is a power of two", everywhere,
     [](Recorder& r, int a, int b) {
       const auto [c, y] = constantFirst(r, a, b);
       const auto [d, x] = scaledNode(r, y);
       if (!r.isConstant(c) || d < 0 || !(isPower(r, c) || isPower(r, d))) return none;
       const int cd = r.scaled(c, d);
       return cd < 0 ? none : r.mul(cd, x);
     }},
    {Op::mul, recogniseSquares, "x·x = x²", everywhere,
     [](Recorder& r, int a, int b) { return a == b ? r.sqr(a) : none; }},
    {Op::mul, simplify, "x·(1/x) = 1", "x ≠ 0",
     [](Recorder& r, int a, int b) { return isInverse(r, b, a) || isInverse(r, a, b) ? r.constant(1.0) : none; }},
    {Op::mul, simplify, "x·((1/x)·y) = y", "x ≠ 0",
     [](Recorder& r, int a, int b) {
       return eitherWay(a, b, [&](int x, int y) {
         if (!isOf(r, y, Op::mul)) return none;
         return isInverse(r, r.node(y).a, x) ? r.node(y).b : isInverse(r, r.node(y).b, x) ? r.node(y).a : none;
       });
     }},
    {Op::mul, moveSigns, "(-x)·y = -(x·y)", everywhere,
     [](Recorder& r, int a, int b) {
       return eitherWay(a, b, [&](int minus, int y) {
         if (!isOf(r, minus, Op::neg)) return none;
         const auto [x, isNegative] = r.signless(minus);
         return withSign(r, isNegative, r.mul(x, y));
       });
     }},
    {Op::mul, movePowersOfTwo,
     "(c·x)·y = c·(x·y), where c = ±2^k, |k| ≤ 64, y is no constant and x no multiple of a power of two",
     "all reals; doubles where x·y neither overflows nor underflows",
     [](Recorder& r, int a, int b) {
       return eitherWay(a, b, [&](int x, int y) {
         const auto [c, factor] = scaledNode(r, x);
         if (c < 0 || !isMovable(r, c) || r.isConstant(y)) return none;
         // Two powers in a row have no product that is a double: they stay, or one would be left behind for each use.
         if (const int inner = scaledNode(r, factor).first; inner >= 0 && isPower(r, inner)) return none;
         return r.mul(c, r.mul(factor, y));
       });
     }},

    {Op::sqr, foldConstants, "c², where it is a double", everywhere,
     [](Recorder& r, int a, int) { return foldedOf(r, a, [](const Interval& x) { return sqr(x); }); }},
    {Op::sqr, moveSigns, "(-x)² = x²", everywhere,
     [](Recorder& r, int a, int) { return isOf(r, a, Op::neg) ? r.sqr(r.signless(a).node) : none; }},

    {Op::recip, foldConstants, "1/c, where it is a double", "c ≠ 0",
     [](Recorder& r, int a, int) { return foldedOf(r, a, [](const Interval& x) { return 1.0 / x; }); }},
    {Op::recip, simplify, "1/(1/x) = x", "x ≠ 0",
     [](Recorder& r, int a, int) { return isOf(r, a, Op::recip) ? r.node(a).a : none; }},
    {Op::recip, moveSigns, "1/(-x) = -(1/x)", "x ≠ 0",
     [](Recorder& r, int a, int) {
       if (!isOf(r, a, Op::neg)) return none;
       const auto [x, isNegative] = r.signless(a);
       return withSign(r, isNegative, r.emit(Op::recip, x));
     }},
};

constexpr std::string_view nameOf(Domain domain) {
  return domain == Domain::nonzero ? "c ≠ 0" : domain == Domain::nonnegative ? "c ≥ 0" : everywhere;
}

/// Those of a function, by what its file says of it.
template <Op op>
void addRulesOf(std::vector<Rule>& rules) {
  using F = Function<op>;
  if constexpr (!F::exact.empty())
    rules.push_back({op, foldConstants, F::exact, nameOf(F::domain), [](Recorder& r, int a, int) {
                       return foldedOf(r, a, [](const Interval& x) {
                         return isDefinedOn(F::domain, x) ? F::of(x) : Interval::empty();
                       });
                     }});
  if constexpr (!F::known.empty())
    rules.push_back({op, foldConstants, F::known, everywhere, [](Recorder& r, int a, int) {
                       if (!r.isExactly(a, F::point)) return none;
                       return F::value == F::point ? a : r.constant(F::value);
                     }});
  if constexpr (!F::odd.empty())
    rules.push_back({op, moveSigns, F::odd, everywhere, [](Recorder& r, int a, int) {
                       if (!isOf(r, a, Op::neg)) return none;
                       const auto [x, isNegative] = r.signless(a);
                       return withSign(r, isNegative, r.emit(op, x));
                     }});
  if constexpr (!F::even.empty())
    rules.push_back({op, moveSigns, F::even, everywhere, [](Recorder& r, int a, int) {
                       return isOf(r, a, Op::neg) ? r.emit(op, r.signless(a).node) : none;
                     }});
}

/// In the order of Op.
const std::vector<Rule>& allRules() {
  static const std::vector<Rule> all = [] {
    std::vector<Rule> rules(std::begin(table), std::end(table));
#define GAMUT_RULES(name) addRulesOf<Op::name>(rules);
    GAMUT_FUNCTIONS(GAMUT_RULES)
#undef GAMUT_RULES
    return rules;
  }();
  return all;
}

}  // namespace

std::span<const Rule> rules() { return allRules(); }

std::span<const Rule> rulesOf(Op op) { return std::ranges::equal_range(allRules(), op, {}, &Rule::op); }

bool isPowerOfTwo(const Interval& c) {
  int exponent = 0;
  return isThin(c) && std::fabs(std::frexp(c.lower(), &exponent)) == 0.5;
}

}  // namespace gamut
