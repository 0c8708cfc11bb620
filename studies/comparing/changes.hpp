// How two results differ where nothing contradicts: what became wider or narrower, what ends earlier, what is known of
// requirements, and what it cost.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "studies/comparing/shared.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// Widths of the second over those of the first, at the output times at which both are known.
struct WidthRatio {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double least = unknown, greatest = unknown;  ///< NaN: nothing is known in both
  double leastTime = 0, greatestTime = 0;      ///< s
};

struct OutputChange {
  std::string name, unit;
  bool isMargin = false;  ///< of a requirement, whose own answer says what its width is good for
  WidthRatio enclosure;
  /// 1 and what a cut is wider by, of all levels that both have, as a part of the first's widest cut at that time:
  /// narrow cuts are of hardly any value, and as wide as what steps leave over.
  WidthRatio alphaCuts;
  Both<double> overestimation{WidthRatio::unknown, WidthRatio::unknown};  ///< the greatest; NaN where unknown
  Both<double> gap{WidthRatio::unknown, WidthRatio::unknown};  ///< of the bounds of probabilities, likewise, at times
                                                               ///< that both have
};

/// An analysis that both have.
struct AnswerChange {
  std::string name;  ///< "enclosure", "samples", "alpha-cuts"
  Both<double> reached;
  Both<bool> endsEarly;
  Both<std::string> why;
};

struct RequirementChange {
  std::string name;
  bool isSameDemand = true;
  Both<std::string> word;
  Both<double> met, factor;
  bool isLost = false;  ///< less is guaranteed: met no more, violated now, or not known any more
};

struct Changes {
  std::vector<OutputChange> outputs;
  std::vector<AnswerChange> answers;
  std::vector<RequirementChange> requirements;
  Both<std::string> verdict;  ///< as findVerdict finds them; empty of results that compare no samples with bounds
  bool isVerdictWorse = false;
  Both<double> gap{WidthRatio::unknown, WidthRatio::unknown};  ///< the greatest of all outputs; NaN without bounds
  Both<std::int64_t> samples{0, 0};                            ///< that were followed
  Both<double> cpu, memory;                                    ///< s, bytes
};

/// `isSameQuestion`: then an answer that is not known any more is a loss too where it was "violated", and so is a
/// verdict that is none any more.
Changes changesOf(const Results& first, const Results& second, const Shared& shared, bool isSameQuestion);

}  // namespace gamut
