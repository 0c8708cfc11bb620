// Outputs over boxes by plain intervals: for the start, where all is known, and where polynomials prove nothing, as at
// a kink.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/extremes.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// Whether an operation takes time itself, or an output is time.
bool dependsOnTime(const Program& program);

/// What these nodes of g, `open`, take roots and logarithms of, nodes too.
std::vector<int> argumentsOfRoots(const Program& g, std::vector<int> open);

/// The nodes of a program over intervals. The greater and the lesser of two numbers are as exact as both.
class NodeValues {
 public:
  explicit NodeValues(std::shared_ptr<const Program> g);

  /// All that these nodes are computed from, they themselves included.
  std::vector<int> neededBy(const std::vector<int>& nodes) const;
  /// Of such nodes, all that they need among them.
  void evaluate(const std::vector<int>& nodes, const Interval& t, const std::vector<Interval>& states,
                const std::vector<Interval>& parameters);
  /// The whole line where it may have no value somewhere, as the root or logarithm of a negative number has none.
  Interval known(int node) const {
    return hasNone_[node] != 0 || isEmpty(value_[node]) ? Interval::entire() : value_[node];
  }

 private:
  void setValue(int node, const Interval& t, const std::vector<Interval>& states,
                const std::vector<Interval>& parameters);

  std::shared_ptr<const Program> g_;
  std::vector<char> isOneSided_;  // of each node: it takes a root or a logarithm
  std::vector<int> extremeOf_;    // of each node; -1: it is none
  std::vector<Extreme> extremes_;
  std::vector<Interval> value_;
  std::vector<char> hasNone_;
};

class PlainOutputs {
 public:
  /// Of y = g(t, x, p).
  explicit PlainOutputs(const Program& g);

  /// Output number `output` wherever time, states and parameters are in these intervals; the whole line if somewhere
  /// there it may have no value, as the root or logarithm of a negative number has none. An angle of two coordinates
  /// (atan2) that may be ±π is anything from -π to π.
  Interval over(int output, const Interval& t, const std::vector<Interval>& states,
                const std::vector<Interval>& parameters);
  /// All of them at one time over a box (states, then parameters).
  std::vector<Interval> over(double t, const Box& box);
  /// Whether there are such angles: near ±π polynomials say nothing of them.
  bool hasAngles() const { return hasAngles_; }

 private:
  /// Of an output of angles, which are known as wholes only.
  struct Angles {
    explicit Angles(Evaluator<Interval> whole) : value(std::move(whole)) {}
    Evaluator<Interval> value;                 // and all that it takes a root or logarithm of, then tangents of angles
    std::vector<Evaluator<Interval>> atWorst;  // likewise, with halves of angles as further parameters
    std::vector<Evaluator<Interval>> coordinates;  // y and x of each of these
    std::vector<char> isKnown;                     // of each of these: whether they are
    std::size_t count = 0;
  };
  struct Output {
    bool hasAngles = false;
    std::optional<Angles> angles;
    std::vector<int> needed;  // nodes; none: not asked for yet
  };

  NodeValues& values();
  Angles& anglesOf(int output);
  Interval overAngles(int output, const Interval& t, const std::vector<Interval>& states,
                      const std::vector<Interval>& parameters);

  std::shared_ptr<const Program> g_;
  bool hasAngles_ = false;
  std::optional<NodeValues> values_;  // of g_, where it is first asked for
  std::vector<Output> outputs_;
  std::vector<int> together_;  // nodes of all outputs without angles
};

}  // namespace gamut
