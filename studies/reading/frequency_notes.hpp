// Hertz in the place of radians per second: a formula counts radians as 1, so that it cannot tell 25 Hz from 25 rad/s.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "studies/reading/toml_source.hpp"

namespace gamut {

/// One line with its place for each number in Hz, a parameter or one in the formula itself, that stands beside time in
/// an angle, which is a driven joint's position or what a sine, cosine or tangent is of, without pi.
std::vector<std::string> notesOnFrequencies(const TomlSource& source, const Mechanism& mechanism);

}  // namespace gamut
