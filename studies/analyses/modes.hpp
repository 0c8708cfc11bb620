// How a mechanism moves in its modes about rest.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

/// Shapes of modes, for all values of the uncertain quantities: each is 1 at its reference, the coordinate that takes
/// most energy in it. Modes that are not told apart have shapes that span what they move, 0 at each other's references.
struct ModesResult final : FurtherPart {
  std::string coordinates;  ///< that loops leave free: their names, with commas
  std::vector<double> coordinate, number;
  std::vector<std::int64_t> mode;         ///< of each shape, 1 the slowest
  std::vector<std::int64_t> first, last;  ///< those that it is not told apart from, itself among them
  std::vector<std::int64_t> reference;    ///< numbers of coordinates
  std::vector<double> slowest, fastest;   ///< Hz
  Grid lower, upper;                      ///< shape, coordinate: real parts, by the reference's rad or m
  Grid imaginaryLower, imaginaryUpper;    ///< likewise, where something damps

  std::string_view key() const override { return "modes"; }
  std::string title() const override { return "shapes of modes"; }
  std::string_view verb() const override { return "enclosed"; }
  std::vector<std::string> told() const override;
  std::unique_ptr<FurtherPart> copy() const override { return std::make_unique<ModesResult>(*this); }
  void describe(std::vector<Group>& groups) override;

  std::vector<std::string> names() const;
  /// "mode 2, [1.2, 1.3] Hz", "mode 2 of 2 to 3, which are not told apart, [1.2, 1.3] Hz".
  std::string nameOf(std::size_t k) const;
  /// "1", "[0.5, 0.51]", "[0.5, 0.51] + [0.01, 0.02] i".
  std::string boundsOf(std::size_t k, std::size_t i) const;
};

}  // namespace gamut
