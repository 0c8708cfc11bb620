// Outputs that need no motion, as polynomials in what is uncertain.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/probability/output_distribution.hpp"
#include "analyses/surrogate/surrogate.hpp"
#include "analyses/uncertainty.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {

inline Uncertain uncertain(const Distribution& distribution) {
  Uncertain u;
  u.name = "q";
  u.range = distribution.support();
  u.nominal = midpoint(u.range);
  u.distribution = distribution;
  u.membership = Membership::triangular(u.range.lower(), u.nominal, u.range.upper());
  return u;
}

inline Uncertain uniform(double lower, double upper) { return uncertain(Distribution::uniform({lower, upper})); }

/// A function of independent quantities, by a flow whose states are at rest.
struct Function {
  std::vector<Uncertain> quantities;
  Program g;  ///< of so many states
  Surrogate surrogate;

  template <class Output>
  Function(std::vector<Uncertain> of, const Output& output, int outputs = 1, FlowOptions options = {})
      : quantities(std::move(of)) {
    const int n = static_cast<int>(quantities.size());
    g = record(n, 0, outputs, [&](auto, const auto& x, const auto&, auto& y) { output(x, y); });
    const Program f = record(n, 0, [&](auto, const auto&, const auto&, auto& dx) {
      for (auto& rate : dx) rate = 0.0;
    });
    for (int o = 0; o < outputs; ++o) options.modelledAt.push_back(o);
    Box box;
    std::vector<int> components;
    for (int i = 0; i < n; ++i) {
      box.push_back(quantities[static_cast<std::size_t>(i)].range);
      components.push_back(i);
    }
    const Tube tube = Flow(f, g, options).enclose(box, 1.0);
    EXPECT_EQ(tube.why(), "");
    surrogate = surrogateOf(*tube.models(), components, 0, static_cast<std::size_t>(outputs));
    EXPECT_EQ(surrogate.rows.size(), tube.reachedTimes());
  }

  std::vector<const Uncertain*> uncertain() const {
    std::vector<const Uncertain*> all;
    for (const Uncertain& u : quantities) all.push_back(&u);
    return all;
  }
};

/// Independent samples leave the bounds by no more than their band at one in 1e9 (Dvoretzky, Kiefer, Wolfowitz,
/// Massart).
inline void expectHoldsSamples(const DistributionBounds& bounds, std::vector<double> samples, int round) {
  std::ranges::sort(samples);
  const auto count = static_cast<double>(samples.size());
  const double band = std::sqrt(std::log(2 / 1e-9) / (2.0 * count));
  for (std::size_t i = 0; i < bounds.value.size(); ++i) {
    const double share =
        static_cast<double>(std::ranges::upper_bound(samples, bounds.value[i]) - samples.begin()) / count;
    EXPECT_LE(bounds.lower[i], share + band) << round;
    EXPECT_GE(bounds.upper[i], share - band) << round;
  }
}

}  // namespace gamut::testing
