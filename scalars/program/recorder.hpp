// A Recorder writes a Program down, one operation a call, and applies the rewriting rules that it was given
// (rules.hpp): none, and the program is what was recorded, operation by operation; all, and equal work is merged, exact
// constants are folded and the like while the code runs, so that what generic code does in vain (times zero, plus zero)
// costs nothing. The same rules, one group at a time, are the passes of passes.hpp.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// Groups of rewriting rules; what each does is said where it is a pass, in passes.hpp.
enum class RuleGroup : std::uint8_t {
  foldConstants = 1,
  simplify = 2,
  moveSigns = 4,
  movePowersOfTwo = 8,
  recogniseSquares = 16,
  pairSinCos = 32,
  mergeEqual = 64,
};

/// A set of rule groups: RuleGroup::simplify | RuleGroup::mergeEqual.
class RuleSet {
 public:
  constexpr RuleSet(RuleGroup group) : groups_(static_cast<unsigned>(group)) {}  // NOLINT(google-explicit-*): a set
  static constexpr RuleSet none() { return RuleSet(0u); }
  static constexpr RuleSet all() { return RuleSet(127u); }
  constexpr bool has(RuleGroup group) const { return (groups_ & static_cast<unsigned>(group)) != 0; }
  friend constexpr RuleSet operator|(RuleSet a, RuleSet b) { return RuleSet(a.groups_ | b.groups_); }

 private:
  explicit constexpr RuleSet(unsigned groups) : groups_(groups) {}
  unsigned groups_;
};

constexpr RuleSet operator|(RuleGroup a, RuleGroup b) { return RuleSet(a) | RuleSet(b); }

namespace detail {

/// What is left of a node when all signs are taken off: its value is that of `node`, or the negative of it.
struct Signless {
  int node;
  bool isNegative;
};

/// A NodeTable that grows node by node.
struct NodeList : NodeTable {
  std::vector<Signless> signless;  // of each node: looked up, since a chain of signs may be as long as the program

  void push(const Node& node);
  /// True if node b is certainly 1 + a², as the second operand of an arc tangent has to be: the sum of 1 and a square
  /// of a or -a, written as such or folded.
  bool isOnePlusSquare(int b, int a) const;
};

}  // namespace detail

/// Builds a Program. Every function returns the number of a node that has the value asked for.
class Recorder {
 public:
  /// Nodes 0 … n-1 are the states, the next k the parameters, the next one is time.
  Recorder(int states, int parameters, RuleSet rules = RuleSet::all());
  /// Starts with the nodes of `program`, numbered as there.
  explicit Recorder(const Program& program, RuleSet rules = RuleSet::all());

  int state(int i) const { return i; }
  int parameter(int i) const { return states_ + i; }
  int time() const { return states_ + parameters_; }
  /// A variable to differentiate by, of which the program's outputs must be free in the end.
  int unknown();
  /// A double has one node if equal work is merged; of any other enclosure every call makes a new one, since it may be
  /// another number. Throws std::domain_error unless the value is bounded and not empty.
  int constant(const Interval& value);

  int add(int a, int b) { return emit(Op::add, a, b); }
  int sub(int a, int b) { return emit(Op::sub, a, b); }
  int neg(int a) { return emit(Op::neg, a); }
  int mul(int a, int b) { return emit(Op::mul, a, b); }
  int sqr(int a) { return emit(Op::sqr, a); }
#define GAMUT_FUNCTION(name) \
  int name(int a) { return function(Op::name, a); }
  GAMUT_FUNCTIONS(GAMUT_FUNCTION)
#undef GAMUT_FUNCTION
  /// Throws std::domain_error for a constant that may lie outside the function's domain.
  int function(Op op, int a);
  /// Operation `op` on a, and its twin: sine and cosine, tanh and sech2.
  std::pair<int, int> pair(Op op, int a);

  /// The number of a matrix; equal ones are one if equal work is merged.
  int matrix(LinearMatrix matrix);
  /// The components' nodes: of a new solution, of a known one, or zeros for a right-hand side of known zeros (the
  /// matrix being regular, as whoever records it promises: nothing then proves it).
  std::vector<int> solve(int matrix, bool transposed, const std::vector<int>& rightSide);

  /// Any operation but a solution on operands as in Node. (Rules may have moved a sign out of one operand only: then
  /// the denominator of a function's derivative is written anew.)
  int emit(Op op, int a, int b = -1);

  /// Writes the program's operations down once more, by this recorder's rules: for each of its nodes the node here that
  /// has the value. It may have fewer states and parameters than this recorder.
  std::vector<int> append(const Program& program) { return append(program, {}); }
  /// The same with the nodes `parameters` in place of its parameters (empty: this recorder's), and, where `instead` has
  /// one (not -1) for a node of the program, with that in its place. Angles of y = 0 become the axis' (angles.hpp).
  std::vector<int> append(const Program& program, const std::vector<int>& parameters,
                          const std::vector<int>& instead = {});

  const Node& node(int i) const { return list_.nodes[i]; }
  /// The nodes and what they refer to.
  const detail::NodeTable& table() const { return list_; }
  int size() const { return static_cast<int>(list_.nodes.size()); }
  /// The value of a constant node.
  const Interval& value(int node) const { return list_.constants[this->node(node).a]; }
  detail::Signless signless(int node) const { return list_.signless[node]; }
  bool isConstant(int node) const { return this->node(node).op == Op::constant; }
  /// True if the node is the constant `number` and nothing else.
  bool isExactly(int node, double number) const;

  /// The constant -c of a constant c: asked twice it is one number, and its own negative is c.
  int negated(int c);
  /// The constant c * d of constants of which one is a power of two, one number if asked twice, in either order; -1 if
  /// the product of the enclosures is not exact (beyond the range of doubles).
  int scaled(int c, int d);

  /// The program with these output nodes: all that was written, in that order.
  Program program(const std::vector<int>& outputs) const;
  /// The same without what the outputs do not need.
  Program finish(const std::vector<int>& outputs) const;

  /// The recorder that `Recorded` numbers of this thread write to; null outside `record`.
  static Recorder*& current();
  /// Differs from that of every other recorder of the program.
  std::uint64_t identity() const { return identity_; }

 private:
  static std::uint64_t nextIdentity();
  struct Key {
    Op op;
    int a, b;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const {  // multiplicative hashing, by odd constants (Knuth, vol. 3, 6.4)
      const auto word = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
      const std::uint64_t mixed =
          (word(key.a) << 32 | word(key.b)) * 0x9e3779b97f4a7c15u + static_cast<unsigned>(key.op);
      return static_cast<std::size_t>((mixed ^ mixed >> 29) * 0xbf58476d1ce4e5b9u >> 16);
    }
  };
  using Known = std::unordered_map<Key, int, KeyHash>;

  /// The node that a rule gives for op(a, b); -1 if none applies, or if so many rules are being applied one inside
  /// another that this one is better left out: no program makes the stack grow without bound.
  int rewritten(Op op, int a, int b);
  /// The node op(a, b), a new one unless equal work is merged.
  int push(Op op, int a, int b);
  int constantFrom(Op op, int a, int b, const Interval& number);
  Program selected(const std::vector<char>& wanted, const std::vector<int>& outputs) const;

  std::uint64_t identity_ = nextIdentity();
  int states_;
  int parameters_;
  RuleSet rules_;
  int depth_ = 0;     // of rules being applied
  int unknowns_ = 0;  // numbered behind the parameters
  detail::NodeList list_;
  Known known_;    // operations
  Known derived_;  // constants, by the operation on constants that gave them
  std::unordered_map<double, int> knownDoubles_;
  std::map<std::vector<int>, int> knownMatrices_;   // by kind and entries
  std::map<std::vector<int>, int> knownSolutions_;  // component 0, by matrix, transposition and right-hand side
};

}  // namespace gamut
