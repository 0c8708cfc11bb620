// What is refused, and what is expected in its place: the shape of all complaints about what users describe.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace gamut {

/// what() is "PROBLEM; expected WHAT", or the problem alone.
class Refusal : public std::invalid_argument {
 public:
  explicit Refusal(std::string problem, std::string expected = "")
      : std::invalid_argument(expected.empty() ? problem : problem + "; expected " + expected),
        problem_(std::move(problem)),
        expected_(std::move(expected)) {}
  const std::string& problem() const { return problem_; }
  const std::string& expected() const { return expected_; }

 protected:
  /// With another sentence for what().
  Refusal(const std::string& sentence, std::string problem, std::string expected)
      : std::invalid_argument(sentence), problem_(std::move(problem)), expected_(std::move(expected)) {}

 private:
  std::string problem_, expected_;
};

/// What cannot be a part of a machine, or go together with its other parts.
class UnfitPart : public Refusal {
 public:
  /// `part`: an element, or a coordinate of one.
  UnfitPart(std::string part, std::string problem, std::string expected)
      : Refusal(std::move(problem), std::move(expected)), part_(std::move(part)) {}
  const std::string& part() const { return part_; }

 private:
  std::string part_;
};

}  // namespace gamut
