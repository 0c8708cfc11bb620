// What one run of the flow starts from: programs, box, times, and the layouts of polynomials that its pieces may take.
// Nothing of it changes while the run goes on.
#pragma once

#include <memory>
#include <vector>

#include "analyses/flow/embedding.hpp"
#include "analyses/flow/flow.hpp"
#include "analyses/flow/monomials.hpp"

namespace gamut {

/// A set of monomials and the degree of the frame over it.
struct FlowLayout {
  std::shared_ptr<const Monomials> monomials;
  int frameDegree;
  bool expanded = false;  // with one more symbol a state, for the remainder
};

struct FlowTask {
  /// `differentiated` is f and ∂f/∂x of the motion f; the rest as for Flow::enclose. All is referred to. splitDefect is
  /// so many times `tighter` than the options say.
  FlowTask(const Program& motion, const Program& differentiated, const Program& outputs, const FlowOptions& options,
           const Box& box, double horizon, const std::vector<double>& outputTimes, const std::vector<Box>& levels,
           double tighter);

  /// Halving one of many symbols narrows the box by little: those are bisected only where a step fails otherwise.
  bool bisectsForWidth() const { return embedding.symbols <= 8; }

  const Program &motion, &differentiated, &outputs;
  const FlowOptions& options;
  const Box& box;
  const std::vector<Box>& levels;
  Embedding embedding;
  double horizon, quantum = 0, tolerance = 0, splitDefect = 0;
  int order = 0;
  std::vector<FlowLayout> layouts;  // degrees rising, then the expanded one
  std::size_t degrees = 0;          // how many are not expanded
  std::vector<double> times;        // 0, those asked for, the horizon
};

}  // namespace gamut
