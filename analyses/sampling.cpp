// Plans by GSL's generators, and the corners' orthogonal array. A plan is made at once; its points are kept.
#include "analyses/sampling.hpp"

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

namespace gamut {
namespace {

constexpr std::array<std::string_view, 5> planNames = {"sobol", "random", "latin-hypercube", "halton", "grid"};
constexpr std::size_t cornerBits = 10;
constexpr std::size_t largestGrid = std::size_t{1} << 24;  // points: beyond, a trajectory each would not fit in memory

using Random = std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)>;
using QuasiRandom = std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)>;

Random seeded(std::uint64_t seed) {
  Random random(gsl_rng_alloc(gsl_rng_mt19937), &gsl_rng_free);
  gsl_rng_set(random.get(), static_cast<unsigned long>((seed ^ (seed >> 32)) & 0xffffffffu));  // it takes 32 bits
  return random;
}

/// Rotation by a random vector keeps the points evenly spread and makes them depend on the seed
/// (Cranley & Patterson, SIAM J. Numer. Anal. 13, 1976).
void fillQuasiRandom(const gsl_qrng_type* type, Plan plan, std::size_t k, std::size_t n, gsl_rng* random,
                     double* unit) {
  if (k > type->max_dimension)
    throw std::invalid_argument("the plan '" + std::string(nameOf(plan)) + "' serves at most " +
                                std::to_string(type->max_dimension) + " uncertain quantities, not " +
                                std::to_string(k));
  QuasiRandom sequence(gsl_qrng_alloc(type, static_cast<unsigned>(k)), &gsl_qrng_free);
  std::vector<double> shift(k);
  for (double& s : shift) s = gsl_rng_uniform(random);
  for (std::size_t i = 0; i < n; ++i, unit += k) {
    gsl_qrng_get(sequence.get(), unit);
    for (std::size_t j = 0; j < k; ++j) {
      unit[j] += shift[j];
      if (unit[j] >= 1) unit[j] -= 1;
    }
  }
}

void fillLatinHypercube(std::size_t k, std::size_t n, gsl_rng* random, double* unit) {
  std::vector<std::size_t> stratum(n);
  for (std::size_t j = 0; j < k; ++j) {
    std::iota(stratum.begin(), stratum.end(), std::size_t{0});
    gsl_ran_shuffle(random, stratum.data(), n, sizeof(std::size_t));
    for (std::size_t i = 0; i < n; ++i)
      unit[i * k + j] = (static_cast<double>(stratum[i]) + gsl_rng_uniform(random)) / static_cast<double>(n);
  }
}

/// base^exponent, or `limit` if that is less.
std::size_t cappedPower(std::size_t base, std::size_t exponent, std::size_t limit) {
  std::size_t power = 1;
  for (std::size_t i = 0; i < exponent && power < limit; ++i) power = power > limit / base ? limit : power * base;
  return std::min(power, limit);
}

std::size_t gridCount(std::size_t k, std::size_t samples) {
  std::size_t count = 2;
  while (cappedPower(count, k, samples) < samples) ++count;
  return count;
}

/// Column j of the corners' array has bit parity(corner & mask): masks of one bit first (all combinations of the first
/// ten quantities), then the others with an odd number of bits, then those with an even number.
std::vector<std::size_t> cornerMasks() {
  std::vector<std::size_t> masks((std::size_t{1} << cornerBits) - 1);
  std::iota(masks.begin(), masks.end(), std::size_t{1});
  const auto rank = [](std::size_t mask) {
    const int bits = std::popcount(mask);
    return bits % 2 == 1 ? bits : static_cast<int>(cornerBits) + bits;
  };
  std::stable_sort(masks.begin(), masks.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return masks;
}

}  // namespace

std::string_view nameOf(Plan plan) { return planNames[static_cast<std::size_t>(plan)]; }

Plan planNamed(std::string_view name) {
  std::string choices;
  for (std::size_t i = 0; i < planNames.size(); ++i) {
    if (planNames[i] == name) return static_cast<Plan>(i);
    choices += (i == 0 ? "" : ", ") + std::string(planNames[i]);
  }
  throw std::invalid_argument("no sampling plan is called '" + std::string(name) + "'; there are " + choices);
}

Sampling::Sampling(Plan plan, std::size_t quantities, std::size_t samples, std::uint64_t seed)
    : quantities_(quantities),
      samples_(quantities == 0 ? 1 : samples),
      corners_(quantities == 0 ? 0 : std::size_t{1} << std::min(quantities, cornerBits)) {
  if (samples == 0) throw std::invalid_argument("a sampling plan needs at least one sample");
  if (quantities == 0) return;
  std::size_t perAxis = 0;
  if (plan == Plan::grid) {
    perAxis = gridCount(quantities, samples);
    samples_ = cappedPower(perAxis, quantities, largestGrid + 1);
    if (samples_ > largestGrid)
      throw std::invalid_argument("a grid with both ends of " + std::to_string(quantities) +
                                  " uncertain quantities has too many points; choose another plan");
  }
  unit_.resize(samples_ * quantities_);
  const Random random = seeded(seed);
  switch (plan) {
    case Plan::sobol:
      fillQuasiRandom(gsl_qrng_sobol, plan, quantities_, samples_, random.get(), unit_.data());
      break;
    case Plan::halton:
      fillQuasiRandom(gsl_qrng_halton, plan, quantities_, samples_, random.get(), unit_.data());
      break;
    case Plan::latinHypercube:
      fillLatinHypercube(quantities_, samples_, random.get(), unit_.data());
      break;
    case Plan::random:
      for (double& u : unit_) u = gsl_rng_uniform(random.get());
      break;
    case Plan::grid:
      for (std::size_t i = 0; i < samples_; ++i)
        for (std::size_t j = 0, rest = i; j < quantities_; ++j, rest /= perAxis)
          unit_[i * quantities_ + j] = static_cast<double>(rest % perAxis) / static_cast<double>(perAxis - 1);
      break;
  }
}

bool Sampling::isUpper(std::size_t corner, std::size_t quantity) const {
  static const std::vector<std::size_t> masks = cornerMasks();
  return std::popcount(corner & masks[quantity % masks.size()]) % 2 == 1;
}

std::vector<double> Sampling::unitPoint(std::size_t number) const {
  if (number >= centre()) throw std::out_of_range("only samples and corners have a point in the unit cube");
  std::vector<double> point(quantities_);
  for (std::size_t j = 0; j < quantities_; ++j)
    point[j] = number < samples_ ? unit_[number * quantities_ + j] : isUpper(number - samples_, j) ? 1.0 : 0.0;
  return point;
}

std::vector<double> Sampling::values(std::size_t number, const std::vector<Uncertain>& uncertain) const {
  if (uncertain.size() != quantities_)
    throw std::invalid_argument("the sampling plan is for another number of quantities");
  if (number >= size()) throw std::out_of_range("the sampling plan has no such number");
  std::vector<double> value(quantities_);
  for (std::size_t j = 0; j < quantities_; ++j) {
    const Uncertain& q = uncertain[j];
    if (number == centre())
      value[j] = q.nominal;
    else if (number < samples_)
      value[j] = q.distribution.quantile(unit_[number * quantities_ + j]);
    else
      value[j] = isUpper(number - samples_, j) ? q.range.upper() : q.range.lower();
  }
  return value;
}

}  // namespace gamut
