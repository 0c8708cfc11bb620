// How the answers agree.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "analyses/table.hpp"
#include "studies/results/part.hpp"

namespace gamut {

/// By what a sample that seemed outside was decided.
enum class Decider : unsigned char {
  inDoubles,    ///< a Taylor series
  in128Bits,    ///< likewise
  rounding,     ///< it lies outside by no more than that, after worse ones were found inside
  unresolved,   ///< by nothing
  interrupted,  ///< before that
};
template <>
inline constexpr std::array<std::string_view, 5> words<Decider>{"Taylor 53 bits", "Taylor 128 bits", "rounding",
                                                                "unresolved", "interrupted"};

/// A sample that was found outside and looked at again.
struct DisputedSample {
  std::int64_t number = 0;   ///< of the sample; those without weight follow the others
  std::uint64_t time = 0;    ///< index of the output time of its greatest excursion
  std::uint64_t output = 0;  ///< index of the output
  double value = 0, lower = 0, upper = 0;
  double distance = 0;  ///< outside, after the last integration
  double error = 0;     ///< this sample's measured error; infinite if no second integration came so far
  Decider decided = Decider::inDoubles;
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

/// Whether every sample lies in what is guaranteed.
enum class Agreement : unsigned char {
  incomplete,  ///< as far as it is known; but not all was compared
  inside,      ///< over the whole horizon
  outside,     ///< at least one does not
  unresolved   ///< at least one may or may not
};
template <>
inline constexpr std::array<std::string_view, 4> words<Agreement>{"incomplete", "inside", "outside", "unresolved"};

/// Present where there were samples, and something to compare them with.
struct ComparisonResult final : Part {
  Agreement verdict = Agreement::incomplete;
  double excursion = 0;  ///< greatest distance outside, in multiples of that sample's measured error
  Table overestimation;  ///< enclosure width over envelope width; NaN where the envelope is too narrow to tell, or
  /// the enclosure infinite
  Table excess;  ///< enclosure width minus envelope width
  double maximum = std::numeric_limits<double>::quiet_NaN();
  double median = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> maximumOf;  ///< one an output
  std::vector<DisputedSample> disputed;

  std::string title() const override { return "comparison"; }
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
