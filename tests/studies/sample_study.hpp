// A small study file to start from, what replaces one piece of it, and what is said of one that is wrong.
#pragma once

#include <stdexcept>
#include <string>

#include "studies/study.hpp"

namespace gamut {

/// A pendulum with one uncertain angle; line 1 is "[study]".
inline const std::string sampleStudy = R"([study]
title = "Pendulum"
analysis = "dynamics"
horizon = 0.5
output_step = 0.1
compare = ["interval", "stochastic", "fuzzy"]
[mechanism]
gravity = [0, 0, -9.81]
[[mechanism.element]]
type = "revolute"
name = "hinge"
from = "inertial"
to = "K1"
axis = "x"
initial = { angle = "30 deg", rate = 0.5 }
[[mechanism.element]]
type = "link"
name = "rod"
from = "K1"
to = "tip"
vector = [0, 0, "-rod.length"]
parameters = { length = 0.5 }
[[mechanism.element]]
type = "mass"
name = "bob"
at = "tip"
mass = "250 g"
[[uncertain]]
name = "start"
quantity = "hinge.angle"
interval = "± 1 %"
distribution = { type = "uniform" }
membership = { type = "triangular" }
[[output]]
name = "angle"
quantity = "hinge.angle"
[[output]]
quantity = "tip.position.z"
[stochastic]
samples = 16
plan = "sobol"
seed = 7
)";

/// sampleStudy with its first `old` replaced.
inline std::string sampleStudyWith(const std::string& old, const std::string& replacement) {
  std::string text = sampleStudy;
  const auto place = text.find(old);
  if (place == std::string::npos) throw std::logic_error("not in the sample study: " + old);
  return text.replace(place, old.size(), replacement);
}

/// What the reader says of a text called `name`; "it was read" if nothing.
inline std::string messageOf(const std::string& text, const std::string& name = "s.toml") {
  try {
    readStudyText(text, name);
  } catch (const StudyError& error) {
    return error.what();
  }
  return "it was read";
}

}  // namespace gamut
