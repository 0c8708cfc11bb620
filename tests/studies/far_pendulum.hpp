// A study whose proof may end before its horizon.
#pragma once

#include <string>

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
[mechanism]
gravity = [0, 0, -9.81]
[[mechanism.element]]
type = "revolute"
name = "hinge"
from = "inertial"
to = "K1"
axis = "x"
initial = { angle = "120 deg", rate = 0 }
[[mechanism.element]]
type = "link"
name = "rod"
from = "K1"
to = "tip"
vector = [0, 0, "-rod.length"]
parameters = { length = 0.8 }
[[mechanism.element]]
type = "mass"
name = "bob"
at = "tip"
mass = 0.25
[[uncertain]]
name = "start"
quantity = "hinge.angle"
interval = ")" +
         start + R"("
distribution = { type = "uniform" }
[[uncertain]]
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
