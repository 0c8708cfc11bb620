// The evaluator gives numbers and errors: a sum of both is rounded once, which the next number beyond covers.
#include "studies/varied_alone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analyses/surrogate/surrogate_evaluator.hpp"

namespace gamut {
namespace {

/// Of the output times of the polynomials the nearest; of none, none.
std::size_t nearestRow(const Results& results, std::size_t row) {
  std::size_t nearest = results.time.size();
  for (const double number : results.surrogate.row) {
    const auto other = static_cast<std::size_t>(number);
    if (other >= results.time.size()) continue;
    if (nearest == results.time.size() ||
        std::abs(results.time[other] - results.time[row]) < std::abs(results.time[nearest] - results.time[row]))
      nearest = other;
  }
  return nearest;
}

ProvedValue valueOf(double value, double error) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return {std::nextafter(value - error, -infinite), std::nextafter(value + error, infinite)};
}

bool isKnown(const ProvedValue& value) { return std::isfinite(value.lower) && std::isfinite(value.upper); }

}  // namespace

double VariedAlone::low() const { return std::min(atLeast.lower, atGreatest.lower); }
double VariedAlone::high() const { return std::max(atLeast.upper, atGreatest.upper); }

AllVariedAlone variedAlone(const Results& results, std::size_t output, std::size_t row) {
  AllVariedAlone all;
  if (!results.surrogate.present || row >= results.time.size()) return all;
  all.row = nearestRow(results, row);
  if (all.row == results.time.size()) return all;
  const std::size_t quantities = results.uncertain.size(), samples = 2 * quantities + 1;
  std::vector<double> values, outputs(samples), errors(samples);
  for (std::size_t i = 0; i < samples; ++i)
    for (std::size_t q = 0; q < quantities; ++q) {
      const UncertainInfo& info = results.uncertain[q];
      values.push_back(i == 2 * q + 1 ? info.lower : i == 2 * q + 2 ? info.upper : info.nominal);
    }
  try {
    const SurrogateEvaluator evaluator(results.surrogate, {all.row}, {output});
    evaluator.settle(values);
    evaluator.evaluate(values, outputs, errors);
  } catch (const std::invalid_argument&) {
    return all;
  }
  all.nominal = valueOf(outputs[0], errors[0]);
  if (!isKnown(all.nominal)) return all;
  for (std::size_t q = 0; q < quantities; ++q) {
    const VariedAlone one{q, valueOf(outputs[2 * q + 1], errors[2 * q + 1]),
                          valueOf(outputs[2 * q + 2], errors[2 * q + 2])};
    if (isKnown(one.atLeast) && isKnown(one.atGreatest)) all.quantities.push_back(one);
  }
  return all;
}

}  // namespace gamut
