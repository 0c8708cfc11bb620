// Passes: Program to Program, each for one purpose, each by the rules of one group (rules.hpp), which are exact on real
// numbers: wherever the program was defined, the result has the same value. (Doubles differ by their rounding; and by
// overflow or underflow near the ends of their range, where movePowersOfTwo reorders a product.) What a pass makes
// superfluous stays where it is until dropUnused. Recording applies the same rules at once, so that a recorded program
// seldom gains by them; programs that were recorded without rules, loaded or put together do.
//
//   Program f = record<2>(...);
//   Program g = optimised(loadProgram(file));
//   for (const Pass& pass : passes()) std::cout << pass.name << ": " << pass.apply(f).operations() << '\n';
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "scalars/program/program.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

struct Pass {
  std::string_view name;
  Program (*apply)(const Program&);
  /// True if it never adds an operation that an output needs. (Moving a sign or a factor outwards may: what stood
  /// inside may be needed elsewhere.)
  bool neverMoreOperations;
};

/// All passes, in the order in which `optimised` runs them.
std::span<const Pass> passes();

/// Operations on doubles whose result is a double, -c and ±2^k·c of an enclosed constant become constants.
Program foldConstants(const Program& program);
/// Neutral elements and inverses vanish: x + 0, 1·x, 0·x, x - x, -(-x), x·(1/x), 1/(1/x).
Program simplify(const Program& program);
/// Signs move outwards and into sums and constants, where they meet: (-x)·y = -(x·y), x + (-y) = x - y.
Program moveSigns(const Program& program);
/// Powers of two move outwards, where they meet: (2·x)·y = 2·(x·y), 2·(c·x) = (2c)·x. The first is for 2^-64 to 2^64
/// only: the further a factor is from 1, the more products overflow or underflow without it.
Program movePowersOfTwo(const Program& program);
/// x·x becomes the square of x, whose range is tighter and whose derivative is shorter.
Program recogniseSquares(const Program& program);
/// A sine and a cosine of the same argument are computed as one pair.
Program pairSinCos(const Program& program);
/// Equal operations on equal nodes, and equal doubles, become one. Two constants that only have the same enclosure may
/// be different numbers: they stay two.
Program mergeEqual(const Program& program);
/// What no output needs goes.
Program dropUnused(const Program& program);

/// All passes again and again while they make the program cheaper: fewer operations, or as many with fewer nodes. Never
/// dearer than `program`; a second call changes nothing.
Program optimised(const Program& program);

/// How often each operation occurs and what evaluators can make of it. Nodes that depend on parameters alone are not
/// counted, since they are computed once.
struct ProgramCounts {
  std::array<int, opCount> of{};  ///< by Op; a solution of a linear system is one
  int operations = 0;             ///< all of them, in place of solutions the arithmetic of solving
  int invariant = 0;              ///< operations that depend on parameters alone
  int sums = 0;                   ///< sums of products: an evaluator can compute each in one go
  int fusedProducts = 0;          ///< products that occur in them
};
ProgramCounts countsOf(const Program& program);

/// sign·a·b, or sign·a where b < 0.
struct ProductTerm {
  int sign;
  int a, b;
};
/// The sum of its terms is the value of `node`.
struct ProductSum {
  int node;
  std::vector<ProductTerm> terms;
};
/// The largest sums with a product that nothing else needs: ±a·b ± c·d ± e …, written as a tree of additions,
/// subtractions and negations whose inner nodes nothing else needs either. Terms from left to right.
std::vector<ProductSum> sumsOfProducts(const Program& program);

}  // namespace gamut
