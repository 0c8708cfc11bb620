// What was found of each requirement.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

/// What is guaranteed of a requirement.
enum class Decision : unsigned char {
  open,
  met,       ///< of all values
  violated,  ///< of all values
  partly     ///< it is violated for some
};
template <>
inline constexpr std::array<std::string_view, 4> words<Decision>{"open", "met", "violated", "partly"};

/// What is only estimated of a requirement whose window lasts longer than anything is proved: nothing of it is proved.
struct RequirementEstimate {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::int64_t samples = 0;                 ///< independent ones that were followed
  std::int64_t met = 0, violated = 0;       ///< of these, at the output times; the others did not arrive
  double lower = unknown, upper = unknown;  ///< 95 % confidence of the probability that it is met at the output times
  double firstOrder = unknown;  ///< that probability, if the worst margin were a linear function of the quantities
};

struct RequirementResult {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string name, statement;  ///< "clearance", "always tip.position.z > 0.2 m"
  bool isAlways = true;         ///< at all times of the window; otherwise once at least
  double from = 0, until = 0;   ///< s: output times
  std::uint64_t margin = 0;     ///< index of the output that is its first margin
  std::int64_t margins = 1;     ///< so many outputs from there on are above zero where it is met
  // What is guaranteed.
  Decision word = Decision::open;
  std::string why;               ///< why no more is known, one cause; empty if all is
  std::string advice;            ///< what may help: "interval.tightness = 1.005"; empty if nothing is known to
  double metUntil = unknown;     ///< s: of what is always to be, met for every value so long; NaN: not even at first
  double met = 0, violated = 0;  ///< of at least so much of the uncertain box, by volume
  double factor = 0;             ///< met for deviations from nominal up to so many times those stated
  /// Bounds of the greatest such factor where one quantity alone deviates less, one a quantity; none in older files.
  std::vector<double> aloneLower, aloneUpper;
  /// Values for which it is violated, one a quantity; of what varies in time, the number that chooses its course. NaN:
  /// none are known, or it is violated whatever that one is.
  std::vector<double> violation;
  /// These are of a sample, or some roundings from it where that lies at an interval's end: its number; -1: of none.
  std::int64_t violationSample = -1;
  bool isViolatedBetween = false;  ///< these violate it between output times alone, as far as that is proved
  double violationTime = unknown;  ///< s; NaN: it is not known at which instant
  double violationLower = unknown, violationUpper = unknown;  ///< the margin there, proved
  // What is probable.
  double probabilityLower = 0, probabilityUpper = 1;  ///< that it is met, proved
  std::int64_t samples = 0, violating = 0;            ///< that arrived; of these, violate it at an output time
  double shareLower = unknown, shareUpper = unknown;  ///< 95 % confidence of the share that is met; NaN: none holds
  std::int64_t worstSample = -1;                      ///< with the least margin, those without weight among them
  double worstTime = unknown, worstMargin = unknown;  ///< of it: s, and the margin there
  /// Nothing is proved, but it misses the requirement by more than the error of its integration.
  bool isViolatedInSimulation = false;
  RequirementEstimate estimate;  ///< where the proof ends before the window does
  // What is possible.
  double violationLeast = 0, violationMost = 1;  ///< bounds of the possibility that it is violated; 1 - that: necessity
};

/// A margin is an output, above zero where something lies above or below its limit.
struct MarginInfo {
  std::uint64_t output = 0;   ///< index of the margin
  std::string what;           ///< as it is stated: "tip.position.z"
  bool isAbove = true;        ///< where it is to be; otherwise below
  std::string limitText;      ///< as it is stated: "0.2 m"
  std::string unit = {};      ///< in which the limit is stated; empty where it is no number with a unit
  bool isStrict = true;       ///< otherwise the limit itself is allowed
  std::uint64_t limited = 0;  ///< index of the output that a line at `limit` bounds; of the margin where none is
  double limit = 0;           ///< in the unit of that output
  bool isNumber = false;      ///< the limit is stated as a number, what lies there is none
};

/// A part of the box of the quantities, and what is proved there of a requirement: met or violated by all of their
/// values, whatever varies in time does; else open.
struct RequirementCell {
  std::int64_t number = 0;
  std::uint64_t requirement = 0;  ///< index
  Decision word = Decision::open;
  /// One a quantity: -1 and 1 are the ends of its interval, outward by a rounding; these of what varies in time.
  std::vector<double> lower, upper;
};

/// Of all requirements, as the study states them. The part is not present, though they are there, where nothing was
/// proved yet, and in files that were written before it was kept.
struct RequirementsResult final : TimedPart, std::vector<RequirementResult> {
  /// Those of a requirement together are the whole box; none where there are no models of all of its window, and in
  /// older files.
  std::vector<RequirementCell> cells;

  std::string title() const override { return "requirements"; }
  void describe(std::vector<Group>& groups) override;
};

void describe(std::vector<MarginInfo>& margins, std::vector<Group>& groups);

}  // namespace gamut
