// Why a flow ended before its horizon, or is looser than was asked for: one cause, one sentence, and what to do about
// it.
#pragma once

#include <string>

namespace gamut {

struct FlowCause {
  enum class Kind {
    none,
    interrupted,
    outOfMemory,
    overBudget,
    // Of the motion.
    escape,  ///< a state grows without bound
    edge,    ///< an operation comes to the edge of where it is defined
    // Of the set.
    remainder,  ///< what steps have added has outgrown what is known
    inputs,     ///< what varies in time has spread the set
    wide,       ///< the uncertain quantities have, and nothing may be bisected any more
    step,       ///< no step could be proved
    start,      ///< not even a single start of the box comes much farther
    stated,     ///< it is wider than the limit that was stated
    // Of what may be done about it.
    unsplit,
    pieces,
    many,  ///< quantities
    rounding,
    vain,  ///< a stricter run left as much over
    rounds
  };
  static constexpr const char* interrupted = "interrupted";
  static constexpr const char* outOfMemory = "out of memory";
  static constexpr const char* overBudget = "the work that may be done is done";

  Kind kind = Kind::none;
  std::string what = {};  ///< of the motion, in words
  int number = 0;         ///< pieces that are allowed; of `vain`, `rounds`, `remainder`: a degree to try

  bool isNone() const { return kind == Kind::none; }
  bool isStop() const { return kind == Kind::interrupted || kind == Kind::outOfMemory || kind == Kind::overBudget; }
  /// Without a time: "x grows without bound: …".
  std::string sentence() const;
  /// What may help: "interval.max_pieces = 8000". Empty where nothing does.
  std::string advice() const;
};

}  // namespace gamut
