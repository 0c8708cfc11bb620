// What two results have in common: outputs and requirements by name, output times as the same double.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/comparing/both.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// Nothing of two results can be compared; what() is one sentence, "what; expected what".
class NotComparable : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Where the same thing stands in both.
using Match = Both<std::size_t>;

/// An output that both have, in two units.
struct TwoUnits {
  std::string name;
  Both<std::string> unit;
};

struct Shared {
  std::vector<Match> outputs, times, requirements;
  Both<std::vector<std::string>> otherOutputs, otherRequirements;  ///< names that only one has
  Both<std::size_t> otherTimes{0, 0};                              ///< how many only one has
  /// Compared in the unit of the first, being of one kind; and not compared, being of two.
  std::vector<TwoUnits> converted, incomparable;
  std::size_t answers = 0;                      ///< how many both have
  Both<std::vector<std::string>> otherAnswers;  ///< "enclosure", "samples", ...: what only one has
};

/// The places of equal numbers in two lists that rise.
std::vector<Match> sharedNumbers(const std::vector<double>& first, const std::vector<double>& second);

/// Throws NotComparable where there is no such output or time.
Shared sharedOf(const Results& first, const Results& second);

}  // namespace gamut
