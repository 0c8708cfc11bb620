// What cannot be a part of a machine, or go together with its other parts.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace gamut {

class UnfitPart : public std::invalid_argument {
 public:
  /// `part`: an element, or a coordinate of one.
  UnfitPart(std::string part, std::string problem, std::string expected)
      : std::invalid_argument(problem + "; expected " + expected),
        part_(std::move(part)),
        problem_(std::move(problem)),
        expected_(std::move(expected)) {}
  const std::string& part() const { return part_; }
  const std::string& problem() const { return problem_; }
  const std::string& expected() const { return expected_; }

 private:
  std::string part_, problem_, expected_;
};

}  // namespace gamut
