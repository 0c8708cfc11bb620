// What one run of the flow starts from: programs, box, times, and the layouts of polynomials that its pieces may take.
// Nothing of it changes while the run goes on.
#pragma once

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <vector>

#include "analyses/flow/embedding.hpp"
#include "analyses/flow/flow.hpp"
#include "analyses/flow/series/monomials.hpp"
#include "analyses/flow/step/jumps.hpp"
#include "analyses/flow/step/scales.hpp"
#include "analyses/flow/step/step.hpp"
#include "analyses/flow/step/time_kinks.hpp"

namespace gamut {

/// Work (work.hpp) that all runs of one flow may do.
struct FlowBudget {
  double limit;
  double spent = 0;
  std::size_t mostPieces = std::numeric_limits<std::size_t>::max();  ///< at a time; with more of them all is spent

  double left() const { return limit - spent; }
  void heed(std::size_t pieces) {
    if (pieces > mostPieces) limit = spent;
  }
};

/// What every run is of; all is referred to.
struct FlowQuestion {
  const Program &motion, &differentiated, &outputs;  ///< f; f and ∂f/∂x; g
  const FlowOptions& options;
  double horizon;
  const std::vector<double>& outputTimes;
  FlowBudget& budget;
  int clock = -1;                   ///< the state that is time; -1: none
  bool stopsEarly = false;          ///< solutions may be at times of their own from a first turn on, or without one
  const Program* starts = nullptr;  ///< FlowFormulation's, if it has any

  Embedding embed(const Box& box, const std::vector<int>& weights = {}) const {
    return {
        box, motion.states(), options.varying, weights, starts == nullptr ? 0 : starts->outputs(), options.remainders};
  }
};

/// A set of monomials and the degree of the frame over it.
struct FlowLayout {
  std::shared_ptr<const Monomials> monomials;
  int frameDegree;
  bool expanded = false;  // with one more symbol a state, for the remainder
};

/// What a repeated run does otherwise than the first.
struct FlowRound {
  double tighter = 1;                             ///< the share of truncation is so many times less than at first
  double finer = 1;                               ///< so is the tolerance
  std::size_t richer = 0;                         ///< the outputs' layout is so many further on
  bool isLast = true;                             ///< no tighter run comes
  bool isRich = false;                            ///< errors keep more powers of ξ
  double slideShare = 0;                          ///< SplitShares::slide
  int fixedDegree = 0;                            ///< if not 0: no bisection on the way, and up to this degree
  std::vector<int> cuts;                          ///< symbols, each halved on all pieces before the first step
  Emphasis emphasis;                              ///< none: every symbol alike
  std::vector<Box> reached;                       ///< what outputs reach at least, at every time; none: it is not known
  std::shared_ptr<const FlowScales> scales = {};  ///< null: they are not known
};

struct FlowTask {
  /// Box and levels as for Flow::enclose. All is referred to.
  FlowTask(const FlowQuestion& question, const Box& box, const std::vector<Box>& levels, const FlowRound& round);

  /// Halving one of many symbols narrows the box by little: those are bisected only where a step fails otherwise.
  /// Where not all symbols have weight 1, bisection may be for want of powers: a few pieces tell.
  int mostPieces() const {
    return active < embedding.symbols && !isLast ? std::min(options.maxPieces, 16) : options.maxPieces;
  }
  bool bisectsForWidth() const { return effective <= 8; }
  /// Of outputs, for states of this layout: they may bend more, and are not integrated, so that more terms are cheap.
  std::size_t outputLayout(std::size_t layout) const;
  bool hasRicherOutputs() const { return outputs.outputs() > 0 && outputLayout(0) + 1 < degrees; }
  /// The share of a width that remainder and range may add.
  double aim() const { return 0.9 * (options.tightness - 1); }
  /// Of their widths.
  double rangeTolerance() const { return std::min(1e-4, 0.02 * aim()); }
  /// Without symbols: all numbers beyond double precision, so that following them so is worth it.
  bool isKnownFinely() const;
  /// A tighter run may come.
  bool mayTighten() const { return !isLast && embedding.symbols > 0 && options.split && bisectsForWidth(); }

  const Program &motion, &differentiated, &outputs;
  const FlowOptions& options;
  FlowBudget& budget;
  const Box& box;
  const std::vector<Box>& levels;
  Embedding embedding;
  FlowJumps jumps;
  double horizon, quantum = 0, tolerance = 0;
  int order = 0, active = 0;  // symbols of weight 1
  int fineOrders = 0;         // in double-double, without symbols: where rounding would limit the width
  double effective;           // Emphasis
  SplitShares shares;
  bool isLast, mayBisect;
  bool mayGoOwnWays = false;                 // nothing but the states depends on time, nothing varies in it
  bool stopsEarly;                           // FlowQuestion
  std::vector<double> bends;                 // of each state, how much f bends in it, about; the clock does not count
  bool standsStill;                          // no state moves: loads of a given motion, which are functions of time
  const Program* starts;                     // FlowQuestion
  std::vector<int> cuts;                     // FlowRound
  std::vector<Box> reached;                  // FlowRound
  std::vector<int> varying;                  // parameters that are inputs
  std::vector<FlowLayout> layouts;           // degrees rising, then the expanded one
  std::size_t degrees = 0;                   // how many are not expanded
  std::size_t richer = 0;                    // FlowRound
  std::vector<double> times;                 // 0, those asked for, the horizon
  std::vector<char> looksAside;              // at each of them
  TimeKinks timeKinks;                       // of `differentiated`
  std::shared_ptr<const FlowScales> scales;  // FlowRound
  std::vector<double> ends;                  // of steps besides: next to kinks in time, of outputs too; rising

 private:
  void setTimes(const std::vector<double>& outputTimes);
  void setLayouts(const FlowRound& round);
  void setThresholds(const FlowRound& round);
};

}  // namespace gamut
