// The image of a box, y = g(t, x, p), by polynomials on parts of the box: what encloseImage and modelImage of flow.hpp
// are made of, both at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "analyses/flow/models.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

struct Image {
  /// [0] over the box, [i] over levels[i-1]; empty if `cancelled` was set before all was found.
  std::vector<std::vector<Interval>> ranges;
  std::shared_ptr<const FlowModels> models;                ///< at the one time t; null if none are asked for
  std::vector<OutputExtremes> extremes;                    ///< over the box, one an output
  std::vector<std::vector<OutputExtremes>> levelExtremes;  ///< likewise over levels[i], where angles go far round
  std::size_t parts = 0;                                   ///< of the box
};

/// So many products of coefficients are for parts of the box, at most.
inline constexpr double imageWork = 3e8;

/// Over a box (states, then parameters) and the boxes inside it, each inside the one before. The box is bisected until
/// the outputs that are modelled (without: all) are known well enough, or it costs more than `work`. degree -1: chosen
/// by the number of quantities. `remainders` are carried as errors, not as quantities; those of levels need not lie
/// inside one another. `plain`: the same outputs once more, as plain intervals know most of them.
Image findImage(const Program& g, double t, const Box& box, const std::vector<Box>& levels,
                const std::vector<int>& modelled, int degree, const std::atomic<bool>* cancelled,
                double work = imageWork, const std::vector<int>& remainders = {}, const Program* plain = nullptr);

/// The polynomials of an image over a box of parameters, without what they may be off by and what is small of them all:
/// a program of parameters, like g, that has no states. g itself where there are none.
Program recordPolynomials(const Program& g, const Box& box, int degree);

}  // namespace gamut
