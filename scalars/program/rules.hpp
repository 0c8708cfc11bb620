// The rewriting rules, one entry each: what a Recorder may write instead of an operation. Every law is one of real
// numbers, true wherever the left side is defined; no rule rounds. The order of the table is the order of trial.
// Doubles that overflow or underflow on the way may do so on one side only; where a rule can bring that about, its
// domain says so.
#pragma once

#include <span>
#include <string_view>

#include "scalars/program/recorder.hpp"

namespace gamut {

struct Rule {
  Op op;                    ///< the operation that is asked for
  RuleGroup group;          ///< the pass it belongs to
  std::string_view law;     ///< "x + 0 = x"; c and d are constants
  std::string_view domain;  ///< where the law holds
  /// The node with the value of op(a, b), or -1 where the law does not apply.
  int (*apply)(Recorder& recorder, int a, int b);
};

/// All rules, those of one operation together.
std::span<const Rule> rules();
/// The rules of one operation.
std::span<const Rule> rulesOf(Op op);

/// True for a thin ±2^k.
bool isPowerOfTwo(const Interval& c);

}  // namespace gamut
