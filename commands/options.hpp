// What the options and arguments of several commands have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "mechanics/description/units.hpp"

namespace gamut {

/// Something the user asked for cannot be done; what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The argument STUDY.toml.
void addStudy(CLI::App& command, std::string& path);
/// A file alone, as standard input cannot be watched.
void addWatchedStudy(CLI::App& command, std::string& path);
/// The argument RESULTS.h5.
void addResults(CLI::App& command, std::string& path);

/// The argument RESULTS.h5, which may also be a robot's file.
void addResultsOrRobot(CLI::App& command, std::string& path);

/// Decimal digits alone, within bounds: no sign that wraps around, no number that is cut off.
CLI::Validator wholeNumber(std::uint64_t least, std::uint64_t most);

/// A number above 0, or text with a unit, as in a study; in its place the number of the dimension's own unit.
CLI::Validator positiveAmount(const Dimension& dimension, const std::string& what, const std::string& examples);

/// Likewise a time above 0 s; 0 in place of "off".
CLI::Validator timeOrOff(const std::string& what, const std::string& examples);

/// Likewise a time from 0 s on.
CLI::Validator outputTime();

}  // namespace gamut
