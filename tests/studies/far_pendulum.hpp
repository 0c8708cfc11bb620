// A study whose proof may end before its horizon.
#pragma once

#include <string>

#include "tests/studies/pendulum_text.hpp"

namespace gamut {

/// A pendulum, let go far up, of one piece: known up to 2.6 s where its start is known to 15 %.
inline std::string farPendulum(const std::string& start, const std::string& others = "",
                               const std::string& plan = "sobol") {
  return R"([study]
title = "A pendulum from far up"
analysis = "dynamics"
horizon = 3
output_step = 0.1
compare = ["interval", "stochastic"]
)" + pendulumMechanism("initial = { angle = \"120 deg\", rate = 0 }\n", hangingRod("0.8"), "0.25") +
         uncertainStart(start) + R"([[uncertain]]
name = "length"
quantity = "rod.length"
interval = "± 1 %"
distribution = { type = "uniform" }
[[output]]
name = "angle"
quantity = "hinge.angle"
[[requirement]]
name = "late"
always = "abs(hinge.rate) < 5.9 rad/s"
from = 2.7
[[requirement]]
name = "surely"
always = "abs(hinge.rate) < 7 rad/s"
[[requirement]]
name = "early"
always = "hinge.angle > 0"
until = 0.2
[stochastic]
samples = 512
plan = ")" +
         plan + R"("
[distribution]
times = 0
[interval]
max_pieces = 1
)" + others;
}

}  // namespace gamut
