// Outputs at the start, where the box says all: by plain intervals, which find exactly what is known exactly.
#pragma once

#include <optional>
#include <vector>

#include "analyses/flow/outputs/plain_outputs.hpp"
#include "analyses/flow/step/jumps.hpp"
#include "analyses/flow/task.hpp"

namespace gamut {

class StartOutputs {
 public:
  /// Of g(t, x, p). Both are referred to.
  StartOutputs(const FlowTask& task, const Program& g);

  /// Over start values and parameters. A sign of the motion whose argument may be zero is anything from -1 to 1; where
  /// jumps hold the motion from the start on, what holds it.
  std::vector<Interval> over(const Box& box);

 private:
  /// Which jumps hold the motion; none: empty.
  std::vector<char> held(const Box& states, const Box& parameters);

  const FlowTask& task_;
  const Program& g_;
  PlainOutputs outputs_;                    // with the signs of jumps as further parameters
  std::optional<SignsWithin> signsWithin_;  // none: f has none
};

}  // namespace gamut
