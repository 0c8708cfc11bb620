// Plans by GSL's and Boost's generators and by hashes. Points are made when they are asked for.
#include "analyses/samples/sampling.hpp"

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <array>
#include <boost/random/sobol.hpp>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace gamut {
namespace {

constexpr std::array<std::string_view, 5> planNames = {"sobol", "random", "latin-hypercube", "halton", "grid"};
constexpr std::size_t cornerBits = 10;
constexpr std::size_t largestGrid = std::size_t{1} << 24;  // points: more than anybody asks for

using Random = std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)>;

Random seeded(std::uint64_t seed) {
  Random random(gsl_rng_alloc(gsl_rng_mt19937), &gsl_rng_free);
  gsl_rng_set(random.get(), static_cast<unsigned long>((seed ^ (seed >> 32)) & 0xffffffffu));  // it takes 32 bits
  return random;
}

class RandomPoints : public PointSequence {
 public:
  explicit RandomPoints(std::uint64_t seed) : random_(seeded(seed)) {}
  void next(std::span<double> point) override {
    for (double& u : point) u = gsl_rng_uniform(random_.get());
  }

 private:
  Random random_;
};

/// A hash of 64 bits, each of which depends on all of x (the finalizer of Steele, Lea & Flood, "Fast splittable
/// pseudorandom number generators", OOPSLA 2014).
std::uint64_t hashed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// A pseudo-random permutation of 0 … n-1 that needs no table: a Feistel network of hashes on the least even number of
/// bits that holds n, gone through again until the result is below n (Black & Rogaway, CT-RSA 2002).
class Permutation {
 public:
  Permutation(std::size_t n, std::uint64_t key) : n_(n), key_(key) {
    while (half_ < 32 && (std::uint64_t{1} << (2 * half_)) < n) ++half_;
  }

  std::size_t operator()(std::size_t i) const {
    std::uint64_t x = i;
    do x = network(x);
    while (x >= n_);
    return x;
  }

 private:
  static constexpr std::uint64_t rounds = 6;

  std::uint64_t network(std::uint64_t x) const {
    const std::uint64_t mask = (std::uint64_t{1} << half_) - 1;
    std::uint64_t left = x >> half_, right = x & mask;
    for (std::uint64_t round = 0; round < rounds; ++round) {
      const std::uint64_t mixed = left ^ (hashed(key_ + (round << 32) + right) & mask);
      left = right;
      right = mixed;
    }
    return (left << half_) | right;
  }

  std::uint64_t n_, key_;
  unsigned half_ = 1;
};

/// In [0, 1).
double uniform(std::uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1p-53; }

void checkQuantities(Plan plan, std::size_t k) {
  const std::size_t most = mostQuantities(plan);
  if (k > most)
    throw std::invalid_argument("the plan '" + std::string(nameOf(plan)) + "' serves at most " + std::to_string(most) +
                                " uncertain quantities, not " + std::to_string(k));
}

/// Every digit is permuted at random, each as those before it say: points stay as evenly spread as they were, and each
/// is uniformly distributed (A. B. Owen, "Scrambling Sobol' and Niederreiter-Xing points", J. Complexity 14, 1998).
/// Up to 40 axes are GSL's, which leaves out the sequence's first point, zero. More are Boost's, with the directions of
/// S. Joe & F. Y. Kuo (SIAM J. Sci. Comput. 30, 2008), and begin with zero, so that the first 2^m points of every axis
/// lie in 2^m strata (A. B. Owen, "On dropping the first Sobol' point", MCQMC 2020).
class SobolPoints : public PointSequence {
 public:
  SobolPoints(std::size_t k, std::uint64_t seed) : keys_(k), digits_(k) {
    checkQuantities(Plan::sobol, k);
    if (k <= gsl_qrng_sobol->max_dimension)
      few_.reset(gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(k)));
    else
      many_.emplace(k);
    for (std::uint64_t j = 0; j < k; ++j) keys_[j] = hashed(hashed(seed) + j);
  }

  void next(std::span<double> point) override {
    if (many_) {
      if (number_ > 0)  // Boost's first is the one after zero
        for (std::uint64_t& digits : digits_) digits = (*many_)();
    } else {
      gsl_qrng_get(few_.get(), point.data());
      for (std::size_t j = 0; j < digits_.size(); ++j)
        digits_[j] = static_cast<std::uint64_t>(point[j] * 0x1p32);  // exact: there are 30
    }
    for (std::size_t j = 0; j < keys_.size(); ++j) {
      std::uint64_t scrambled = 0;
      for (std::uint64_t k = 0; k < 32; ++k) {
        const std::uint64_t before = digits_[j] >> (32 - k), digit = digits_[j] >> (31 - k) & 1;
        scrambled = 2 * scrambled + (digit ^ (hashed(keys_[j] + (k << 32) + before) & 1));
      }
      point[j] = (static_cast<double>(scrambled) + uniform(hashed(~keys_[j] + number_))) * 0x1p-32;
    }
    ++number_;
  }

  using Many = boost::random::sobol_engine<std::uint32_t, 32>;
  static constexpr std::size_t mostAxes = boost::random::default_sobol_table::max_dimension;

 private:
  std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> few_{nullptr, &gsl_qrng_free};
  std::optional<Many> many_;
  std::vector<std::uint64_t> keys_, digits_;  // digits: the next point times 2^32
  std::uint64_t number_ = 0;
};

/// Radical inverses in the first primes, scrambled likewise (J. H. Halton, Numerische Mathematik 2, 1960).
class HaltonPoints : public PointSequence {
 public:
  HaltonPoints(std::size_t k, std::uint64_t seed) {
    checkQuantities(Plan::halton, k);
    const auto isPrime = [&](std::uint64_t x) {
      return std::ranges::none_of(primes_, [&](std::uint64_t prime) { return x % prime == 0; });
    };
    for (std::uint64_t x = 2; primes_.size() < k; ++x)
      if (isPrime(x)) primes_.push_back(x);
    for (std::uint64_t j = 0; j < k; ++j) keys_.push_back(hashed(hashed(seed) + j));
  }

  void next(std::span<double> point) override {
    for (std::size_t j = 0; j < primes_.size(); ++j) {
      const std::uint64_t prime = primes_[j];
      double unit = 1, sum = 0;
      std::uint64_t rest = number_, before = 0, power = 1;
      for (std::uint64_t k = 0; unit > 0x1p-48; ++k, power *= prime) {
        const std::uint64_t key = hashed(hashed(keys_[j] + k) + before);
        const std::uint64_t digit = (Permutation(prime, key)(rest % prime) + hashed(~key)) % prime;  // each as probable
        unit /= static_cast<double>(prime);
        sum += unit * static_cast<double>(digit);
        before += rest % prime * power;
        rest /= prime;
      }
      point[j] = std::min(sum + unit * uniform(hashed(~keys_[j] + number_)), 1 - 0x1p-53);
    }
    ++number_;
  }

  static constexpr std::size_t mostAxes = 1229;

 private:
  std::vector<std::uint64_t> primes_, keys_;
  std::uint64_t number_ = 0;
};

class LatinHypercube : public PointSequence {
 public:
  LatinHypercube(std::size_t k, std::size_t n, std::uint64_t seed) : n_(n) {
    for (std::uint64_t j = 0; j < k; ++j) {
      keys_.push_back(hashed(hashed(seed) + j));
      strata_.emplace_back(n, keys_.back());
    }
  }

  void next(std::span<double> point) override {
    for (std::size_t j = 0; j < strata_.size(); ++j) {
      const double within = uniform(hashed(~keys_[j] + number_));
      point[j] = (static_cast<double>(strata_[j](number_)) + within) / static_cast<double>(n_);
    }
    ++number_;
  }

 private:
  std::size_t n_, number_ = 0;
  std::vector<std::uint64_t> keys_;
  std::vector<Permutation> strata_;
};

class GridPoints : public PointSequence {
 public:
  explicit GridPoints(std::size_t perAxis) : perAxis_(perAxis) {}
  void next(std::span<double> point) override {
    std::size_t rest = number_++;
    for (double& u : point) {
      u = static_cast<double>(rest % perAxis_) / static_cast<double>(perAxis_ - 1);
      rest /= perAxis_;
    }
  }

 private:
  std::size_t perAxis_, number_ = 0;
};

/// base^exponent, or `limit` if that is less.
std::size_t cappedPower(std::size_t base, std::size_t exponent, std::size_t limit) {
  std::size_t power = 1;
  for (std::size_t i = 0; i < exponent && power < limit; ++i) power = power > limit / base ? limit : power * base;
  return std::min(power, limit);
}

/// Values of every axis of a grid: at least two.
std::size_t gridCount(std::size_t k, std::size_t samples) {
  std::size_t count = 2;
  while (cappedPower(count, k, samples) < samples) ++count;
  return count;
}

std::unique_ptr<PointSequence> oneSequence(Plan plan, std::size_t k, std::size_t n, std::uint64_t seed) {
  switch (plan) {
    case Plan::sobol:
      return std::make_unique<SobolPoints>(k, seed);
    case Plan::halton:
      return std::make_unique<HaltonPoints>(k, seed);
    case Plan::latinHypercube:
      return std::make_unique<LatinHypercube>(k, n, seed);
    case Plan::random:
      return std::make_unique<RandomPoints>(seed);
    case Plan::grid:
      return std::make_unique<GridPoints>(gridCount(k, n));
  }
  throw std::invalid_argument("there is no such sampling plan");
}

/// Sequences that take turns.
class Batches : public PointSequence {
 public:
  explicit Batches(std::vector<std::unique_ptr<PointSequence>> batches) : batches_(std::move(batches)) {}
  void next(std::span<double> point) override { batches_[number_++ % batches_.size()]->next(point); }

 private:
  std::vector<std::unique_ptr<PointSequence>> batches_;
  std::size_t number_ = 0;
};

std::unique_ptr<PointSequence> sequenceOf(Plan plan, std::size_t k, std::size_t n, std::size_t count,
                                          std::uint64_t seed) {
  if (count == 1) return oneSequence(plan, k, n, seed);
  std::vector<std::unique_ptr<PointSequence>> batches;
  for (std::size_t i = 0; i < count; ++i) batches.push_back(oneSequence(plan, k, n / count, hashed(hashed(seed) + i)));
  return std::make_unique<Batches>(std::move(batches));
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

std::size_t mostQuantities(Plan plan) {
  return plan == Plan::sobol    ? SobolPoints::mostAxes
         : plan == Plan::halton ? HaltonPoints::mostAxes
                                : std::numeric_limits<std::size_t>::max();
}

bool keepsFirstPoints(Plan plan) { return plan != Plan::latinHypercube && plan != Plan::grid; }

Sampling::Sampling(Plan plan, std::size_t quantities, std::size_t samples, std::uint64_t seed, std::vector<Box> boxes)
    : plan_(plan),
      quantities_(quantities),
      samples_(quantities == 0 ? 1 : samples),
      seed_(seed),
      boxes_(quantities == 0 ? std::vector<Box>{} : std::move(boxes)) {
  if (samples == 0) throw std::invalid_argument("a sampling plan needs at least one sample");
  for (const Box& box : boxes_)
    if (box.size() != quantities) throw std::invalid_argument("a box needs one interval for each quantity");
  if (quantities == 0) {
    zones_ = {1, 2};
    return;
  }
  if (plan == Plan::grid) {
    samples_ = cappedPower(gridCount(quantities, samples), quantities, largestGrid + 1);
    if (samples_ > largestGrid)
      throw std::invalid_argument("a grid with both ends of " + std::to_string(quantities) +
                                  " uncertain quantities has too many points");
  }
  const bool hasBatches = plan != Plan::grid && plan != Plan::random, isLarge = samples >= 2 * batchCount;
  if (hasBatches && isLarge) samples_ = (samples + batchCount - 1) / batchCount * batchCount;
  // The points of a sequence do not depend on how many there are.
  if (hasBatches && (isLarge || plan != Plan::latinHypercube)) batches_ = batchCount;
  sequence_ = sequenceOf(plan_, quantities_, samples_, batches_, seed_);
  ends_ = Ends(std::min(quantities, cornerBits));
  std::size_t bits = 1;
  while (bits < std::min(quantities, cornerBits) && boxes_.size() << (bits + 1) <= mostBoxCorners) ++bits;
  boxEnds_ = Ends(bits);
  zones_ = {samples_, centre() + 1};
}

void Sampling::add(TransformationPoints points) {
  if (points.size() == 0) return;
  zones_.push_back(zones_.back() + points.size());
  added_.push_back(std::move(points));
}

Sampling::Zone Sampling::zoneOf(std::size_t number) const {
  const auto end = std::ranges::upper_bound(zones_, number);
  if (end == zones_.end()) throw std::out_of_range("the sampling plan has no such number");
  return {end == zones_.begin() ? 0 : *std::prev(end), *end};
}

void Sampling::unitPoint(std::size_t number, std::span<double> point) {
  if (number >= centre()) throw std::out_of_range("only samples and corners have a point in the unit cube");
  if (number >= samples_) {
    const std::size_t corner = number - samples_, inner = corner - std::min(corner, corners());
    for (std::size_t j = 0; j < quantities_; ++j)
      point[j] = corner < corners() ? ends_.isUpper(corner, j) : boxEnds_.isUpper(inner % boxEnds_.count(), j);
    return;
  }
  if (quantities_ == 0) return;
  if (number < position_) {
    sequence_ = sequenceOf(plan_, quantities_, samples_, batches_, seed_);
    position_ = 0;
  }
  for (; position_ <= number; ++position_) sequence_->next(point);
}

std::vector<double> Sampling::unitPoint(std::size_t number) {
  std::vector<double> point(quantities_);
  unitPoint(number, point);
  return point;
}

void Sampling::toValues(std::size_t number, const std::vector<Uncertain>& uncertain, std::span<double> point) const {
  if (uncertain.size() != quantities_ || point.size() != quantities_)
    throw std::invalid_argument("the sampling plan is for another number of quantities");
  if (number >= size()) throw std::out_of_range("the sampling plan has no such number");
  if (number < samples_)
    for (const GaussianCopula& copula : copulas_) copula.correlate(point);
  if (number > centre()) {
    constexpr std::size_t others = 2;  // zones before
    const auto zone = static_cast<std::size_t>(std::ranges::upper_bound(zones_, number) - zones_.begin());
    added_[zone - others].point(number - zones_[zone - 1], point);
    return;
  }
  const std::size_t firstInner = samples_ + corners();
  for (std::size_t j = 0; j < quantities_; ++j) {
    const Uncertain& q = uncertain[j];
    if (number == centre()) {
      point[j] = q.nominal;
    } else if (number < samples_) {
      point[j] = q.distribution.quantile(point[j]);
    } else {
      const Interval& side = number < firstInner ? q.range : boxes_[(number - firstInner) / boxEnds_.count()][j];
      point[j] = point[j] > 0 ? side.upper() : side.lower();
    }
  }
}

std::vector<double> Sampling::values(std::size_t number, const std::vector<Uncertain>& uncertain) {
  std::vector<double> point = number < centre() ? unitPoint(number) : std::vector<double>(quantities_);
  toValues(number, uncertain, point);
  return point;
}

}  // namespace gamut
