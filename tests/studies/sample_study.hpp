// A small study file to start from, what replaces one piece of it, and what is said of one that is wrong.
#pragma once

#include <stdexcept>
#include <string>

#include "studies/machine.hpp"
#include "tests/studies/pendulum_text.hpp"

namespace gamut {

/// A pendulum with one uncertain angle; line 1 is "[study]".
inline const std::string sampleStudy = R"([study]
title = "Pendulum"
analysis = "dynamics"
horizon = 0.5
output_step = 0.1
compare = ["interval", "stochastic", "fuzzy"]
)" + pendulumMechanism("initial = { angle = \"30 deg\", rate = 0.5 }\n", hangingRod("0.5"), "\"250 g\"") +
                                       uncertainStart("± 1 %") + R"(membership = { type = "triangular" }
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

/// What is said of a text called `name` that is read, and of the machine that it describes; "it was read" if nothing.
inline std::string messageOf(const std::string& text, const std::string& name = "s.toml") {
  try {
    Machine(readStudyText(text, name));
  } catch (const StudyError& error) {
    return error.what();
  }
  return "it was read";
}

}  // namespace gamut
