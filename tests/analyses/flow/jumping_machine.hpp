// Motions whose rates jump, and the judgement of their enclosures: trajectories whose events are located in 128 bits
// must lie inside, exactly; and enclosures are hardly wider than they.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/sliding_reference.hpp"

namespace gamut::testing {

struct JumpingMachine {
  std::string name;
  Program f;
  Box centre, spread;  // spread: times the width
  double horizon;
  SlidingReference::Rest rest;
  double loosest;                     // of the first state's width over that of the trajectories, at the end
  std::optional<Program> truth = {};  // with u sign u for |u|: references locate signs
};

/// Of the box's wide components, each number's corner.
inline Vector cornerOf(const Box& box, int number) {
  Vector corner;
  for (const Interval& x : box) {
    corner.emplace_back(number % 2 == 0 ? x.lower() : x.upper());
    if (!isThin(x)) number /= 2;
  }
  return corner;
}

/// At all of so many rows, and eight times as many moments.
inline void holdsTrajectories(const JumpingMachine& machine, const std::vector<double>& widths, int rows) {
  for (const double width : widths) {
    SCOPED_TRACE(width);
    Box box = machine.centre;
    int wide = 0;
    for (std::size_t i = 0; i < box.size(); ++i) {
      box[i] = machine.centre[i] + Interval(width) * machine.spread[i];
      wide += isThin(box[i]) ? 0 : 1;
    }
    const int corners = std::min(8, 1 << wide), trials = width == 0 ? 1 : corners + 2;
    std::vector<double> outputTimes, times;
    for (int i = 1; i <= rows; ++i) outputTimes.push_back(machine.horizon * i / rows);
    for (int i = 1; i <= 8 * rows; ++i) times.push_back(machine.horizon * i / (8 * rows));
    const Tube tube = Flow(machine.f).enclose(box, machine.horizon, outputTimes);
    ASSERT_EQ(tube.why(), "");
    SlidingReference reference(machine.truth.value_or(machine.f), machine.rest);
    Points points(17);
    std::vector<Interval> seen;
    for (int trial = 0; trial < trials; ++trial) {
      const std::vector<Vector> motion = reference(trial < corners ? cornerOf(box, trial) : points.inside(box), times);
      for (std::size_t i = 0; i < times.size(); ++i)
        for (std::size_t row = 1; row < tube.times().size(); ++row)
          for (std::size_t s = 0; s < motion[i].size(); ++s) {
            const bool isAt = times[i] == tube.times()[row];
            if (!isAt && !(tube.times()[row - 1] < times[i] && times[i] < tube.times()[row])) continue;
            ASSERT_THAT(isAt ? tube.states(row)[s] : tube.statesOver(row)[s], Encloses(motion[i][s]))
                << times[i] << " state " << s;
          }
      for (std::size_t s = 0; s < motion.back().size(); ++s) {
        const Interval value(motion.back()[s].convert_to<double>());
        if (trial == 0)
          seen.push_back(value);
        else
          seen[s] = hull(seen[s], value);
      }
    }
    EXPECT_GT(reference.events, 0);
    const Interval& last = tube.states(tube.reachedTimes() - 1)[0];
    const double widest = width == 0 ? 1e-6 : machine.loosest * gamut::width(seen[0]) + 1e-9;
    EXPECT_LE(gamut::width(last), widest);
  }
}

}  // namespace gamut::testing
