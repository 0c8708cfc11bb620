// How the answers agree.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "analyses/table.hpp"
#include "studies/results/fields.hpp"

namespace gamut {

/// A sample that was found outside and looked at again.
struct DisputedSample {
  std::int64_t number = 0;   ///< of the sample; those without weight follow the others
  std::uint64_t time = 0;    ///< index of the output time of its greatest excursion
  std::uint64_t output = 0;  ///< index of the output
  double value = 0, lower = 0, upper = 0;
  double distance = 0;  ///< outside, after the last integration
  double error = 0;     ///< this sample's measured error; infinite if no second integration came so far
  std::string decided;  ///< by what: "Taylor 53 bits", "Taylor 128 bits"; "rounding": outside by no more than that,
                        ///< after worse ones were found inside; "unresolved", or "interrupted" before that
  bool outside = false;
  std::int64_t level = -1;       ///< of the alpha-cut that it was compared with; -1: the enclosure
  std::vector<double> farthest;  ///< one an output: how far it lies outside at most, after the last integration
};

/// It lies outside, but no farther than its own error.
bool isUnresolved(const DisputedSample& sample);
/// It lies outside by no more than rounding, and worse ones were found inside.
bool isRounding(const DisputedSample& sample);
/// It seemed outside when the run was interrupted.
bool isInterrupted(const DisputedSample& sample);

struct ComparisonResult {
  bool present = false;  ///< there were samples, and something to compare them with
  std::string verdict;   ///< "inside" | "outside" | "incomplete" | "unresolved"
  std::string why;       ///< why it ended before all was decided; empty if it did not
  double excursion = 0;  ///< greatest distance outside, in multiples of that sample's measured error
  Table overestimation;  ///< enclosure width over envelope width; NaN where the envelope is too narrow to tell, or
  /// the enclosure infinite
  Table excess;  ///< enclosure width minus envelope width
  double maximum = std::numeric_limits<double>::quiet_NaN();
  double median = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> maximumOf;  ///< one an output
  std::vector<DisputedSample> disputed;
};

/// Adds the groups of this part.
void describe(ComparisonResult& comparison, std::vector<Group>& groups);

}  // namespace gamut
