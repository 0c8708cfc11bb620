// What a sweep found, as plain data: of every point how its run ended, and of its results what can be told over a
// sweep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studies/results/fields.hpp"
#include "studies/results/grid.hpp"
#include "studies/results/results.hpp"
#include "studies/sweep_plan.hpp"

namespace gamut {

/// How a point ended.
enum class PointState : unsigned char {
  open,     ///< not run yet
  done,     ///< all was found
  early,    ///< an analysis ended before its end
  refused,  ///< it cannot be run: the study makes no sense there, as where a loop does not close
  failed    ///< an internal failure
};
template <>
inline constexpr std::array<std::string_view, 5> words<PointState>{"open", "done", "early", "refused", "failed"};

struct SweepPoint {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::int64_t number = 0;  ///< the last axis of a grid runs fastest
  PointState state = PointState::open;
  std::string why;           ///< why not all was found; empty if it was
  std::string verdict;       ///< whether samples stay inside, a word of Agreement; empty where nothing was compared
  double reached = unknown;  ///< s: up to where all analyses came
  double cpu = 0;            ///< s
};

struct SweepDemand {
  std::string name, statement;
};

/// A number that is kept of each requirement, or output, of every point; NaN where there is none.
struct SweepColumn {
  std::string_view name, unit, meaning;
  double (*of)(const Results& results, std::size_t number);
};

/// Of requirements, by their number.
enum class OfRequirement : std::size_t {
  word,
  met,
  violated,
  factor,
  metUntil,
  probabilityLower,
  probabilityUpper,
  samples,
  violating,
  estimateLower,
  estimateUpper,
  possibilityLower,
  possibilityUpper,
  worstMargin
};
std::span<const SweepColumn> requirementColumns();

/// Of outputs.
enum class OfOutput : std::size_t {
  least,
  greatest,
  sampledLeast,
  sampledGreatest,
  lastLower,
  lastUpper,
  lastSampledLeast,
  lastSampledGreatest,
  lastMean,
  lastDeviation
};
std::span<const SweepColumn> outputColumns();

struct SweepResults {
  SweepPlan plan;
  std::string studyText, robotText, tablesText, studyFile, title, analysis, version, host, date;
  std::int64_t seed = -1, samples = 0;  ///< in place of the study's; -1 and 0: the study's
  std::vector<OutputInfo> outputs;      ///< without margins of requirements
  std::vector<SweepDemand> requirements;
  std::vector<SweepPoint> points;
  std::vector<Grid> ofRequirements, ofOutputs;  ///< [column], of the plan's dimensions, then requirements or outputs

  /// Paths of the plan's dimensions in the file.
  std::vector<std::string> paths;
  std::vector<std::int64_t> places;  ///< of a list: 0, 1, ...

  /// Points in this state.
  std::size_t count(PointState state) const;
  double at(OfRequirement column, std::size_t point, std::size_t requirement) const {
    return numberAt(ofRequirements[static_cast<std::size_t>(column)], point, requirements.size(), requirement);
  }
  double at(OfOutput column, std::size_t point, std::size_t output) const {
    return numberAt(ofOutputs[static_cast<std::size_t>(column)], point, outputs.size(), output);
  }

 private:
  static double numberAt(const Grid& grid, std::size_t point, std::size_t extent, std::size_t number) {
    return grid.data[point * extent + number];
  }
};

/// Makes room for all points, none of which was run: plan, outputs and requirements are known.
void prepare(SweepResults& sweep);

/// Puts a point's numbers in their places: those of requirements, column by column, then those of outputs.
void put(SweepResults& sweep, const SweepPoint& point, std::span<const double> numbers);

/// These numbers of the results of a point.
std::vector<double> numbersOf(const Results& results, std::size_t outputs);

/// Whether two ask for the same: all words, all values, by the same version. What is costs, host and date counts not.
bool asksTheSame(const SweepResults& one, const SweepResults& other);

/// The groups of the file.
std::vector<Group> describe(SweepResults& sweep);

/// Rows of a table in Markdown: the fields of a file that has these axes.
std::string guideToSweepFile();

}  // namespace gamut
