// The image of a box in which angles go far round, as directions of play do: sine and cosine of such an angle are known
// as a point of a circle, not as polynomials of the angle.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "analyses/flow/models.hpp"
#include "analyses/flow/series/monomials.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// How many angles go far round: their range over the box is wider than polynomials of them are good for.
std::size_t countFarAngles(const Program& g, double t, const Box& box);

/// [0] over the box, [i] over levels[i-1]; both empty where no angle goes far round, or nothing was found.
struct CircleImage {
  std::vector<std::vector<Interval>> ranges;
  std::vector<std::vector<OutputExtremes>> extremes;  ///< at values inside the box, and inside the level
  /// Over the box, one an output: y = P(ξ) ± radius, whatever far angles are. Infinite where nothing is known.
  std::shared_ptr<const Monomials> monomials;
  std::vector<int> component;  ///< [symbol]: of the box; -1 of those that are no part of P
  std::vector<std::vector<double>> polynomial;
  std::vector<double> radius;
  std::size_t angles = 0;  ///< so many go far round
  bool areWhole = false;   ///< all of these go all round, nearly at least: polynomials of them know nothing
};

/// Of y = g(t, x, p) over a box and over the boxes inside it; degree, `cancelled` and `remainders` as of findImage. The
/// cost grows with the number of angles as with that of quantities, not with bisections. docs/flow.md, section 4.
CircleImage imageByCircles(const Program& g, double t, const Box& box, const std::vector<Box>& levels, int degree,
                           const std::atomic<bool>* cancelled, const std::vector<int>& remainders);
/// The same; none where it was cancelled before it was found.
std::optional<CircleImage> imageUnlessCancelled(const Program& g, double t, const Box& box,
                                                const std::vector<Box>& levels, int degree,
                                                const std::atomic<bool>* cancelled, const std::vector<int>& remainders);

}  // namespace gamut
