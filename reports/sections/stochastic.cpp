// What is probable.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "reports/sections/contribution.hpp"
#include "reports/words.hpp"
#include "studies/results/instants.hpp"

namespace gamut {
namespace {

std::vector<Column> probableColumns(const Results& results, const Finding&) {
  if (!results.stochastic.present) return {};
  return {{"sampled", &results.stochastic.envelope, {}}};
}

/// The quantile whose probability is nearest.
std::size_t nearest(const std::vector<double>& probabilities, double wanted) {
  const auto closer = [&](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); };
  return static_cast<std::size_t>(std::ranges::min_element(probabilities, closer) - probabilities.begin());
}

/// What samples span from the last time on at which something is proved: an estimate of what all cases span.
Band behindProof(const Results& results, std::size_t output, double end) {
  Band band = bandOf(results.stochastic.envelope, output);
  const auto behind = std::ranges::upper_bound(results.time, end) - results.time.begin();
  for (std::ptrdiff_t i = 0; i + 1 < behind; ++i) band.lower[i] = band.upper[i] = std::nan("");
  return band;
}

void drawProbable(const Results& results, std::size_t output, Plot& plot) {
  const StochasticResult& stochastic = results.stochastic;
  if (!stochastic.present) return;
  const std::vector<double>& probabilities = stochastic.probabilities;
  const auto quantile = [&](std::size_t i) { return lineOf(stochastic.quantiles[i], output); };
  const bool hasQuantiles = !probabilities.empty() && stochastic.quantiles.size() == probabilities.size();
  const std::size_t low = nearest(probabilities, 0.05), middle = nearest(probabilities, 0.5),
                    high = nearest(probabilities, 0.95);
  if (const std::optional<double> end = endOfProof(results); end && !stochastic.envelope.empty())
    plot.layers.push_back({.name = "estimated",
                           .words = fmt::format("estimated behind the proof, which ends at {} s: where the samples are",
                                                numberText(*end, 4)),
                           .readout = "estimated, not proved",
                           .style = {colour::pink, 0, 1.2, true},
                           .bands = {behindProof(results, output, *end)}});
  if (hasQuantiles && low < high)
    plot.layers.push_back({.name = "probable",
                           .words = fmt::format("probable: {:g} to {:g} % of the samples", 100 * probabilities[low],
                                                100 * probabilities[high]),
                           .readout = "probable",
                           .style = {colour::blue, 0.3},
                           .bands = {{quantile(low), quantile(high)}}});
  if (hasQuantiles && probabilities[middle] == 0.5)
    plot.layers.push_back({.name = "median",
                           .words = "median",
                           .readout = "median",
                           .style = {colour::blue, 0, 1.6},
                           .kind = Layer::Kind::line,
                           .bands = {{quantile(middle), {}}}});
  if (!stochastic.envelope.empty())
    plot.layers.push_back({.name = "sampled",
                           .words = "least and greatest sample",
                           .readout = "sampled",
                           .style = {colour::blue, 0, 1, true},
                           .bands = {bandOf(stochastic.envelope, output)}});
}

}  // namespace

const Contribution probable{probableColumns, drawProbable};

}  // namespace gamut
