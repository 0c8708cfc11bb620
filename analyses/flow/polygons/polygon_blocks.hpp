// A motion whose states move two at a time: blocks of states that depend on each other, one or two each, in an order in
// which each block depends on those before. Every block has a polygon; what it depends on is to it an input, anywhere
// in the polygons of the blocks before. docs/flow.md, section 6.
#pragma once

#include <optional>
#include <vector>

#include "analyses/flow/polygons/polygon.hpp"
#include "analyses/flow/polygons/polygon_motion.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class PolygonBlocks {
 public:
  /// Whether a motion is of this kind, and smooth.
  static bool suits(const Program& f);
  /// States of the polygon's two coordinates; -1: there is but one state, and the other coordinate is zero.
  struct Block {
    std::array<int, 2> states;
    PolygonMotion motion;
    std::vector<int> drivers = {};  // states of blocks before that it depends on
    Box parameters = {};            // and these behind the motion's
  };

  /// ẋ = f(t, x, p) with f of this kind; starts and parameters as in the box.
  PolygonBlocks(const Program& f, const Box& box, double horizon);

  double time() const { return time_; }
  double longestStep() const;
  const std::vector<Block>& blocks() const { return blocks_; }
  /// Goes on to `end` or to before it; false if it cannot.
  bool step(double end);
  /// Of all states at that time; and during the last step.
  std::vector<Interval> states() const;
  const std::vector<Interval>& statesOver() const { return over_; }
  /// In so many directions, how far each block reached at most since `forget`; [block][direction].
  static constexpr std::size_t directions = 32;
  static PlaneVector direction(std::size_t i);
  const std::vector<std::vector<double>>& reachOver() const { return reachOver_; }
  void forget();

 private:
  double time_ = 0;
  std::vector<Block> blocks_;
  std::vector<Interval> over_;
  std::vector<std::vector<double>> reachOver_;
};

}  // namespace gamut
