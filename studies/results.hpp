// Everything a study produced, as plain data: what the HDF5 file holds, what the JSON summary and the report show.
// The report and the verdict are computed from this alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "analyses/table.hpp"

namespace gamut {

/// One number for every output at every output time; NaN where there is none. Shape: times x outputs.
using Grid = Table;

/// Lower and upper bounds of every output at every output time.
using Bounds = Envelope;

/// One uncertain quantity as the study states it.
struct UncertainInfo {
  std::string name, quantity, unit;
  double lower = 0, nominal = 0, upper = 0;
  std::string distribution, membership;  ///< in words: "uniform", "triangular", …
};

struct OutputInfo {
  std::string name, quantity, unit;
};

/// What is guaranteed.
struct IntervalResult {
  bool present = false;
  double reached = 0;  ///< s: proved up to here
  std::string why;     ///< why it ended before the horizon; empty if it did not
  Bounds at;           ///< at the output times
  Bounds over;         ///< row i: over the whole output interval [time(i-1), time(i)] (row 0: at time 0)
  Bounds direct;       ///< kinematics only: the assembly moved by plain intervals, without polynomials
  int pieces = 0;      ///< sub-boxes at the end
  std::int64_t steps = 0;
  double cpu = 0;  ///< s
};

/// What is probable.
struct StochasticResult {
  /// The plan's samples, the corners and the centre.
  std::int64_t planned() const { return samples + corners + alphaCorners + 1; }

  bool present = false;
  std::string plan;
  std::int64_t samples = 0;       ///< that count in the statistics
  std::int64_t corners = 0;       ///< of the uncertain box, integrated besides, without weight
  std::int64_t alphaCorners = 0;  ///< of the alpha-cuts' boxes, likewise
  std::int64_t integrated = 0;    ///< how many of samples, corners and centre were followed before the analysis ended
  double relativeTolerance = 0, absoluteTolerance = 0;
  std::int64_t packWidth = 1;  ///< samples of one number / packWidth were integrated together
  std::string stopped;         ///< why not all were followed; empty if they were
  double reached = 0;          ///< s: all that were followed arrived there; envelope and statistics end there
  std::string why;             ///< why that is before the horizon; empty if it is not
  Bounds envelope;             ///< of all samples, corners and centre
  Grid mean, deviation;
  std::vector<double> probabilities;  ///< of the quantiles
  std::vector<Grid> quantiles;        ///< one grid a probability
  Grid resolution;                    ///< no quantile is farther than this from that of the samples themselves
  Grid error;                         ///< the witness's own error, measured at tighter tolerance
  double cpu = 0;
};

/// What is possible: alpha-cuts, level 0 the widest.
struct FuzzyResult {
  bool present = false;
  double reached = 0;  ///< s
  std::string why;
  std::vector<double> alpha;
  std::vector<Bounds> outer;  ///< proved, one a level
  std::vector<Bounds> inner;  ///< of the samples with at least this membership, one a level (empty without samples)
  double cpu = 0;
};

/// A sample that was found outside and looked at again.
struct DisputedSample {
  std::int64_t number = 0;  ///< of the sample; corners and centre follow the samples
  std::size_t time = 0;     ///< index of the output time of its greatest excursion
  std::size_t output = 0;   ///< index of the output
  double value = 0, lower = 0, upper = 0;
  double distance = 0;  ///< outside, after the last integration
  double error = 0;     ///< this sample's measured error
  std::string decided;  ///< by what: "Taylor 53 bits", "Taylor 128 bits"; "unresolved", or "interrupted" before that
  bool outside = false;
  int level = -1;                ///< of the alpha-cut that it was compared with; -1: the enclosure
  std::vector<double> farthest;  ///< one an output: how far it lies outside at most, after the last integration
};

/// How the answers agree.
struct ComparisonResult {
  bool present = false;
  std::string verdict;   ///< "inside" | "outside" | "incomplete" | "unresolved"
  std::string why;       ///< why it ended before all was decided; empty if it did not
  double excursion = 0;  ///< greatest distance outside, in multiples of that sample's measured error
  Grid overestimation;   ///< enclosure width over envelope width; NaN where the envelope is too narrow to tell
  Grid excess;           ///< enclosure width minus envelope width
  double maximum = std::numeric_limits<double>::quiet_NaN();
  double median = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> maximumOf;  ///< one an output
  std::vector<DisputedSample> disputed;
};

/// What a run was allowed to spend: CPU time of all threads, s, and memory, bytes.
struct Limits {
  double time = std::numeric_limits<double>::infinity(), memory = time;                    ///< of the whole run
  double enclosureTime = std::numeric_limits<double>::infinity(), enclosureMemory = time;  ///< of the guarantee
  double sampleTime = std::numeric_limits<double>::infinity();                             ///< of each sample
};

struct Results {
  std::string studyText, studyFile, title, analysis;
  std::uint64_t seed = 0;
  std::string version, host, date;
  std::map<std::string, std::string> libraries;  ///< name → version
  std::vector<UncertainInfo> uncertain;
  std::vector<OutputInfo> outputs;
  double horizon = 0;        ///< s
  std::vector<double> time;  ///< output times, s
  IntervalResult interval;
  StochasticResult stochastic;
  FuzzyResult fuzzy;
  ComparisonResult comparison;
  double reportCpu = 0;  ///< s
  Limits limits;
  double cpu = 0;     ///< s, of all analyses
  double memory = 0;  ///< bytes: the most that the process had at a time
};

}  // namespace gamut
