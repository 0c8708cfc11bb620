// Distributions in doubles, by GSL and Boost.Math: what is probable proves nothing.
#include "analyses/uncertainty.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <stdexcept>

namespace gamut {
namespace {

void require(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument(what);
}

void requirePositive(double value, const char* what) {
  require(value > 0 && std::isfinite(value), std::string(what) + " must be positive, not " + toString(value));
}

double clamp(double value, const Interval& range) { return std::clamp(value, range.lower(), range.upper()); }

}  // namespace

// ---- Distribution ---------------------------------------------------------------------------------------------------

Distribution::Distribution(Shape shape, const Interval& support, double first, double second)
    : shape_(shape), support_(support), first_(first), second_(second) {
  require(!isEmpty(support) && isBounded(support), "a distribution needs a bounded support, not " + toString(support));
  if ((shape == Shape::normal || shape == Shape::lognormal) && !isThin(support)) {
    const bool logarithmic = shape == Shape::lognormal;
    const double lower = logarithmic ? std::log(support.lower()) : support.lower();
    const double upper = logarithmic ? std::log(support.upper()) : support.upper();
    require(truncatedNormalCumulative(upper, lower, upper) == 1,  // 0/0 without mass
            "the " + std::string(name()) + " distribution has no mass on its support " + toString(support));
  }
}

Distribution Distribution::uniform(const Interval& support) { return {Shape::uniform, support, 0, 0}; }

Distribution Distribution::triangular(const Interval& support, double mode) {
  require(contains(support, mode),
          "the mode " + toString(mode) + " of a triangular distribution lies outside its support " + toString(support));
  return {Shape::triangular, support, mode, 0};
}

Distribution Distribution::normal(const Interval& support, double mean, double deviation) {
  require(std::isfinite(mean), "the mean of a normal distribution must be finite");
  requirePositive(deviation, "the deviation of a normal distribution");
  return {Shape::normal, support, mean, deviation};
}

Distribution Distribution::beta(const Interval& support, double a, double b) {
  requirePositive(a, "the first parameter of a beta distribution");
  requirePositive(b, "the second parameter of a beta distribution");
  return {Shape::beta, support, a, b};
}

Distribution Distribution::lognormal(const Interval& support, double logMean, double logDeviation) {
  require(std::isfinite(logMean), "the logarithmic mean of a lognormal distribution must be finite");
  requirePositive(logDeviation, "the logarithmic deviation of a lognormal distribution");
  require(support.lower() >= 0,
          "a lognormal distribution needs a support that is not negative, not " + toString(support));
  return {Shape::lognormal, support, logMean, logDeviation};
}

std::string_view Distribution::name() const {
  switch (shape_) {
    case Shape::uniform:
      return "uniform";
    case Shape::triangular:
      return "triangular";
    case Shape::normal:
      return "normal";
    case Shape::beta:
      return "beta";
    case Shape::lognormal:
      return "lognormal";
  }
  return {};
}

std::vector<ShapeNumber> Distribution::numbers() const {
  std::vector<ShapeNumber> numbers{{"lower", support_.lower()}, {"upper", support_.upper()}};
  switch (shape_) {
    case Shape::uniform:
      break;
    case Shape::triangular:
      numbers.push_back({"mode", first_});
      break;
    case Shape::normal:
      numbers.insert(numbers.end(), {{"mean", first_}, {"deviation", second_}});
      break;
    case Shape::beta:
      numbers.insert(numbers.end(), {{"a", first_, false}, {"b", second_, false}});
      break;
    case Shape::lognormal:
      numbers.insert(numbers.end(), {{"log_mean", first_, false}, {"log_deviation", second_, false}});
  }
  return numbers;
}

double Distribution::truncatedNormal(double u, double lower, double upper) const {
  const double a = (lower - first_) / second_, b = (upper - first_) / second_;
  // Where the support lies right of the mean, upper tails keep the digits that probabilities near 1 have lost; the
  // inverse is taken on the side on which the result lies.
  if (a + b > 0) {
    const double tail = gsl_cdf_ugaussian_Q(b) + (1 - u) * (gsl_cdf_ugaussian_Q(a) - gsl_cdf_ugaussian_Q(b));
    return first_ + second_ * gsl_cdf_ugaussian_Qinv(tail);
  }
  const double tail = gsl_cdf_ugaussian_P(a) + u * (gsl_cdf_ugaussian_P(b) - gsl_cdf_ugaussian_P(a));
  return first_ + second_ * gsl_cdf_ugaussian_Pinv(tail);
}

double Distribution::truncatedNormalCumulative(double value, double lower, double upper) const {
  const double a = (lower - first_) / second_, b = (upper - first_) / second_, v = (value - first_) / second_;
  if (a + b > 0)
    return (gsl_cdf_ugaussian_Q(a) - gsl_cdf_ugaussian_Q(v)) / (gsl_cdf_ugaussian_Q(a) - gsl_cdf_ugaussian_Q(b));
  return (gsl_cdf_ugaussian_P(v) - gsl_cdf_ugaussian_P(a)) / (gsl_cdf_ugaussian_P(b) - gsl_cdf_ugaussian_P(a));
}

double Distribution::quantile(double u) const {
  require(u >= 0 && u <= 1, "a probability lies between 0 and 1, not at " + toString(u));
  const double lower = support_.lower(), upper = support_.upper(), span = upper - lower;
  if (u == 0 || lower == upper) return lower;
  if (u == 1) return upper;
  switch (shape_) {
    case Shape::uniform:
      return clamp(lower + u * span, support_);
    case Shape::triangular:
      // u = (v-lower)² / (span (mode-lower)) up to the mode, 1-u = (upper-v)² / (span (upper-mode)) beyond
      if (u * span < first_ - lower) return clamp(lower + std::sqrt(u * span * (first_ - lower)), support_);
      return clamp(upper - std::sqrt((1 - u) * span * (upper - first_)), support_);
    case Shape::normal:
      return clamp(truncatedNormal(u, lower, upper), support_);
    // GSL's inverse ends the process when its iteration does not converge; Boost.Math's holds for all parameters.
    case Shape::beta:
      return clamp(lower + boost::math::ibeta_inv(first_, second_, u) * span, support_);
    case Shape::lognormal:
      return clamp(std::exp(truncatedNormal(u, std::log(lower), std::log(upper))), support_);
  }
  return lower;
}

// ---- Uncertain ------------------------------------------------------------------------------------------------------

void Uncertain::check() const {
  const std::string of = "uncertain quantity '" + name + "': ";
  require(!isEmpty(range) && isBounded(range), of + "its interval must be bounded, not " + toString(range));
  require(contains(range, nominal),
          of + "the nominal value " + toString(nominal) + " lies outside its interval " + toString(range));
  require(isSubset(distribution.support(), range),
          of + "the distribution reaches beyond its interval " + toString(range));
  require(isSubset(membership.support(), range),
          of + "the membership function reaches beyond its interval " + toString(range));
}

}  // namespace gamut
