// Studies in which spheres touch planes: enclosures come to the horizon, hold all samples and are no wider than these.
#include <gmock/gmock.h>

#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

const std::string contactHead = R"([study]
title = "Contact"
analysis = "dynamics"
horizon = 0.4
output_step = 0.02
[mechanism]
gravity = [0, 0, -9.81]
)";
const std::string contactTail = R"([stochastic]
samples = 64
[fuzzy]
levels = 3
[distribution]
times = 0
)";

/// Of enclosure by envelope, the greatest of all outputs and output times but the first.
void expectTightContact(const std::string& text, double ratio) {
  const Results results = run(readStudyText(contactHead + text + contactTail, "contact.toml"));
  EXPECT_EQ(results.interval.why, "");
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LE(results.comparison.maximum, ratio);
}

TEST(PlaneContactStudy, FollowsASphereThatFallsAndBounces) {
  expectTightContact(R"(
[[mechanism.element]]
type = "prismatic"
name = "lift"
from = "inertial"
to = "ball"
axis = "z"
initial = { displacement = "300 mm" }
[[mechanism.element]]
type = "mass"
name = "body"
at = "ball"
mass = "1 kg"
[[mechanism.element]]
type = "plane-contact"
name = "ground"
from = "inertial"
to = "ball"
radius = "100 mm"
stiffness = "5 kN/m"
damping = "0.2 s/m"
[[uncertain]]
quantity = "ground.stiffness"
interval = "± 10 %"
[[uncertain]]
quantity = "body.mass"
interval = "± 5 %"
[[uncertain]]
quantity = "lift.displacement"
interval = "± 5 mm"
[[output]]
quantity = "lift.displacement"
[[output]]
quantity = "lift.rate"
)",
                     1.05);
}

/// At first the wheel slips by 2.4 m/s; it rolls after some 0.2 s.
TEST(PlaneContactStudy, FollowsAWheelThatSlipsAndThenRolls) {
  expectTightContact(R"(
[[mechanism.element]]
type = "prismatic"
name = "path"
from = "inertial"
to = "X"
axis = "x"
[[mechanism.element]]
type = "prismatic"
name = "lift"
from = "X"
to = "hub"
axis = "z"
initial = { displacement = "299 mm" }
[[mechanism.element]]
type = "revolute"
name = "turn"
from = "hub"
to = "wheel"
axis = "y"
initial = { rate = "8 rad/s" }
[[mechanism.element]]
type = "mass"
name = "body"
at = "wheel"
mass = "2 kg"
inertia = [0.05, 0.09, 0.05, 0, 0, 0]
[[mechanism.element]]
type = "plane-contact"
name = "road"
from = "inertial"
to = "wheel"
radius = "300 mm"
stiffness = "20 kN/m"
damping = "0.5 s/m"
friction = 0.4
slip_rate = "50 mm/s"
[[uncertain]]
quantity = "road.friction"
interval = "± 10 %"
[[output]]
quantity = "path.rate"
[[output]]
quantity = "turn.rate"
[[output]]
quantity = "road.slip.x"
[[output]]
quantity = "road.force.x"
)",
                     1.01);
}

}  // namespace
}  // namespace gamut
