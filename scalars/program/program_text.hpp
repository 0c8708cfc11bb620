// Programs as text, in two forms. print: formulas for people. saveProgram and loadProgram: every node, exactly, so that
// a program can be kept, compared and read again. The kept form is
//
//   gamut-program 1            the version of this form
//   states 2
//   parameters 1
//   nodes 8                    one line each: its number, its operation, its operands
//   0 state 0
//   1 state 1
//   2 parameter 0
//   3 time
//   4 constant -0x1.39eb851eb851fp+3 -0x1.39eb851eb851ep+3     both ends of the enclosure, in hexadecimal: exact
//   5 sin 0
//   6 cos 0                    every sine is followed by its cosine, every tanh by its sech2
//   7 mul 4 5
//   outputs 2
//   1
//   7
//   end
//
// Linear systems begin with the version 2. A matrix has a line before its first solution, and a number, 0, 1, …, by its
// place; the components of a solution are nodes in a row.
//
//   matrix positiveDefinite 4 5 6 5 7 8 6 8 9      or general; the entries' nodes row by row
//   14 solution 0 1 2 3        of matrix 0; the right-hand side's nodes
//   15 component 1
//   16 component 2
//   17 solution 0 transposed 1 2 3                 of a general matrix
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "scalars/program/program.hpp"

namespace gamut {

/// Names for print; what has no name here is called x0, x1, … (states), p0, … (parameters), y0, … (outputs).
struct ProgramNames {
  std::vector<std::string> states, parameters, outputs;
};

/// Formulas, one line for everything that is used more than once and one for each output, in the order of evaluation:
/// `v7 = ...` is node 7. First what depends on parameters alone. A constant in braces, {9.81}, is not a double: it is
/// enclosed by neighbouring doubles around the decimal shown. Time is t. A matrix has a line before its first solution,
/// `M0 = [[...], ...]`; `[v7, v8, v9] = solve(M0, [...])` are its components.
void print(std::ostream& out, const Program& program, const ProgramNames& names = {});

/// Writes the kept form.
void saveProgram(std::ostream& out, const Program& program);

/// Reads the kept form; the result is identical to what was saved. Throws std::invalid_argument, with the number of the
/// line and what is wrong there, for any other text.
Program loadProgram(std::istream& in);

}  // namespace gamut
