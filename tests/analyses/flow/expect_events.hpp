// Enclosures against trajectories whose kinks and jumps are located in 128 bits.
#pragma once

#include "tests/analyses/event_reference.hpp"
#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {

/// Trajectories from corners and inside, at output times and between them; there must be events.
inline Tube expectEvents(const Containment& c, int trajectories, bool hasEvents = true) {
  Tube tube = c.tube();
  EXPECT_EQ(tube.why(), "");
  if (tube.reachedTimes() < tube.times().size()) return tube;
  EventReference reference(c.f);
  Points points(17);
  std::vector<double> times;
  for (int i = 1; i <= 128; ++i) times.push_back(c.horizon * i / 128);
  std::optional<Evaluator<Precise>> outputs;
  if (c.g) outputs.emplace(*c.g);
  for (int trial = 0; trial < trajectories; ++trial) {
    const Vector start = trial % 2 == 0 ? points.corner(c.box) : points.inside(c.box);
    const std::vector<Vector> motion = reference(start, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      Vector y;
      if (outputs) {
        outputs->setParameters(Vector(start.begin() + c.f.states(), start.end()));
        y = (*outputs)(Precise(times[i]), motion[i]);
      }
      for (std::size_t row = 1; row < tube.times().size(); ++row) {
        const bool isAt = tube.times()[row] == times[i];
        if (!isAt && !(tube.times()[row - 1] < times[i] && times[i] < tube.times()[row])) continue;
        for (std::size_t s = 0; s < motion[i].size(); ++s)
          EXPECT_THAT(isAt ? tube.states(row)[s] : tube.statesOver(row)[s], Encloses(motion[i][s])) << times[i];
        for (std::size_t o = 0; o < y.size(); ++o)
          EXPECT_THAT(isAt ? tube.outputs(row)[o] : tube.outputsOver(row)[o], Encloses(y[o])) << times[i];
        if (::testing::Test::HasFailure()) return tube;
      }
    }
  }
  EXPECT_EQ(reference.events > 0, hasEvents);
  return tube;
}

}  // namespace gamut::testing
