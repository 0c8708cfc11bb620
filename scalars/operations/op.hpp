// The operations of programs: those that every interpreter knows by itself, and elementary functions, of which all that
// scalars and programs need to know stands in a file of its name here.
#pragma once

#include <cstdint>
#include <string_view>

#include "scalars/operations/names.hpp"

namespace gamut {

#define GAMUT_ENUMERATOR(name) name,
/// `a` and `b` of a Node are node numbers, except for state, parameter and constant, where `a` counts states,
/// parameters or constants.
enum class Op : std::uint8_t {
  state,      ///< x[a]
  parameter,  ///< p[a]
  time,       ///< t
  constant,   ///< constants[a], an enclosed real number
  add,        ///< a + b
  sub,        ///< a - b
  neg,        ///< -a
  mul,        ///< a * b
  sqr,        ///< a * a
  GAMUT_FUNCTIONS(GAMUT_ENUMERATOR)
  /// component b of solutions()[a]; the components are nodes in a row, component 0 first
  solution
};
#undef GAMUT_ENUMERATOR

/// How many operations Op has.
constexpr int opCount = static_cast<int>(Op::solution) + 1;

/// "add", "sub", ...
std::string_view nameOf(Op op);
/// True unless op is an input or a constant.
constexpr bool isOperation(Op op) {
  return op != Op::state && op != Op::parameter && op != Op::time && op != Op::constant;
}
/// True for an elementary function of one number: then Function<op> knows it (function.hpp).
constexpr bool isFunction(Op op) { return op > Op::sqr && op < Op::solution; }
/// Where a function is defined.
enum class Domain : std::uint8_t { everywhere, nonzero, nonnegative, positive };
Domain domainOf(Op op);
/// True where an operation takes numbers of one sign alone.
constexpr bool isOneSided(Domain domain) { return domain == Domain::nonnegative || domain == Domain::positive; }
/// Whether it has derivatives where it is defined, but for the domain's edge.
bool isSmooth(Op op);

/// The number of nodes a, b from which op's value is computed: 0, 1 or 2 (the denominators of derivatives do not count;
/// a solution has its operands in a LinearSolution, forEachOperand knows them).
constexpr int operandsOf(Op op) {
  return !isOperation(op) || op == Op::solution ? 0 : op == Op::add || op == Op::sub || op == Op::mul ? 2 : 1;
}

/// The operation of the node that always follows one of `op`, on the same operand, and is computed with it; `op` itself
/// if there is none.
constexpr Op twinOf(Op op) {
#define GAMUT_TWIN(first, second) \
  if (op == Op::first) return Op::second;
  GAMUT_TWINS(GAMUT_TWIN)
#undef GAMUT_TWIN
  return op;
}
/// True for the first of such a pair.
constexpr bool hasTwin(Op op) { return twinOf(op) != op; }
/// The operation before a function, whose twin it may be.
constexpr Op before(Op op) { return static_cast<Op>(static_cast<int>(op) - 1); }
/// True for the second of such a pair.
constexpr bool isTwin(Op op) { return isFunction(op) && hasTwin(before(op)); }

}  // namespace gamut
