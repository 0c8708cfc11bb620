// Where the transformation method puts points, so that the least and the greatest output of those in an alpha-cut come
// near the cut of the output (M. Hanss, Fuzzy Sets and Systems 130, 2002; the extended method: Int. J. of Uncertainty,
// Fuzziness and Knowledge-Based Systems 11, 2003; both in Applied Fuzzy Arithmetic, 2005, chapter 4). Corners of the
// cuts are enough where an output is monotone in every quantity; values between them are needed where it turns.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "analyses/samples/sample_block.hpp"
#include "analyses/table.hpp"
#include "scalars/interval.hpp"

namespace gamut {

class Archive;

enum class Transformation {
  reduced,   ///< corners of the cuts alone
  general,   ///< all combinations of values inside the cuts, too
  extended,  ///< these of the quantities in which outputs turn, corners in the others
};

/// "reduced", "general", "extended".
std::string_view nameOf(Transformation method);
/// Throws std::invalid_argument, naming the choices, for another name.
Transformation transformationNamed(std::string_view name);

/// So many points at most by the general method, and by the extended one, those that look for turns included.
inline constexpr std::size_t mostGeneralPoints = 65536, mostExtendedPoints = 5000;

/// Which end of its range each quantity has in 2^bits corners: all combinations for up to so many quantities, otherwise
/// an orthogonal array, in which any two meet in all four combinations equally often (up to 2^bits - 1 quantities).
class Ends {
 public:
  Ends() = default;
  explicit Ends(std::size_t bits);
  std::size_t count() const { return masks_.empty() ? 0 : masks_.size() + 1; }
  bool isUpper(std::size_t corner, std::size_t quantity) const;

 private:
  std::vector<std::size_t> masks_;
};

/// [level]: values of one quantity by the general method, from its cuts, the widest first, level m the last. At level j
/// there are m + 1 - j, c_1 … c_{m+1-j}: both ends of the cut, and between them c_l = (c_{l-1} + c_l) / 2 of the values
/// at level j + 1. At level m there is one, or both ends of a core with an inside. Equal values are there once.
std::vector<std::vector<double>> generalValues(const std::vector<Interval>& cuts);

/// Points that are made when they are asked for.
class TransformationPoints {
 public:
  std::size_t size() const { return first_.empty() ? 0 : first_.back(); }
  /// Values of the quantities at point i < size().
  void point(std::size_t i, std::span<double> values) const;

  /// All combinations of these values of quantities that are `stepped`; of the others, which have one value or two,
  /// 2^bits combinations with each of them.
  void add(std::vector<std::vector<double>> values, const std::vector<std::size_t>& stepped, std::size_t bits);

 private:
  struct Grid {
    std::vector<std::vector<double>> values;
    std::vector<std::size_t> stepped, others;
    Ends ends;
  };
  std::vector<Grid> grids_;
  std::vector<std::size_t> first_;  // of the grid behind each
};

/// How many points the general method has of these cuts (the widest first, an interval a quantity in each): for m + 1
/// cuts that narrow to a point the sum of k^quantities for k = 1 … m + 1.
double generalCount(const std::vector<Box>& cuts);
TransformationPoints generalPoints(const std::vector<Box>& cuts);

/// Those of the extended method: all combinations of general values of the quantities `turning`, with the ends of the
/// others, no more than `most`. Where all are more, with fewer combinations of the others' ends (eight at least, if
/// there are three others), then by fewer of the cuts (five at least). None if these are too many, too. What then is
/// left goes to all corners of the cuts, if these are missing elsewhere and that is enough for all.
TransformationPoints extendedPoints(const std::vector<Box>& cuts, const std::vector<std::size_t>& turning,
                                    std::size_t most, bool areCornersMissing);

/// Looks for quantities in which outputs turn, along lines on which one quantity takes its values of the widest cut and
/// the others stay: at their nominal values, all at their lower ends, all at their upper ends. (Along the first only,
/// where the points would be more than half of mostExtendedPoints; nowhere, where those would be.)
class TurnScan {
 public:
  TurnScan() = default;
  TurnScan(const std::vector<Box>& cuts, const std::vector<double>& nominal);

  const TransformationPoints& points() const { return points_; }

  /// Before the first point: what is known of the outputs' ranges; differences up to a hundredth of these are of no
  /// account, nor are those up to `absolute` + `relative` times the greatest value at any time.
  void begin(const Envelope& range, double absolute, double relative);
  /// The block's samples are the next points.
  void include(const SampleBlock& block);

  /// Of each quantity: how far an output goes back along a line, after it has risen (fallen), as a share of its range
  /// at that time, at most.
  const std::vector<double>& turns() const { return turns_; }
  /// The quantities in which outputs turn, those with the greatest share first, as many as extendedPoints() has points
  /// of.
  std::vector<std::size_t> turning(const std::vector<Box>& cuts) const;
  /// But for its points and lines, which follow from the cuts.
  void archive(Archive& all);

 private:
  struct Line {
    std::size_t quantity, points;
  };
  struct Course {  // of an output at a time along a line
    double least = 0, greatest = 0, risen = 0, fallen = 0;
  };
  void startLine(const SampleBlock& block, std::size_t sample);
  void goOn(const SampleBlock& block, std::size_t sample);
  void endLine();

  TransformationPoints points_;
  std::vector<Line> lines_;
  std::vector<double> turns_;
  std::size_t line_ = 0, place_ = 0;
  std::vector<double> width_, noise_;  // of outputs at times
  std::vector<Course> courses_;
};

}  // namespace gamut
