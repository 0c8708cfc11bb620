// Distributions in doubles, by GSL and Boost.Math: what is probable proves nothing.
#include "analyses/uncertainty.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <stdexcept>

#include "scalars/elementary/rounding.hpp"

namespace gamut {
namespace {

void require(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument(what);
}

std::string shown(const Interval& value) { return isThin(value) ? toString(value.lower()) : toString(value); }

void requirePositive(const Interval& value, const char* what) {
  require(value.lower() > 0 && isBounded(value), std::string(what) + " must be positive, not " + shown(value));
}

void requireNotNegative(const Interval& support, const char* what) {
  require(support.lower() >= 0,
          std::string(what) + " distribution needs a support that is not negative, not " + toString(support));
}

double clamp(double value, const Interval& range) { return std::clamp(value, range.lower(), range.upper()); }

}  // namespace

// ---- Distribution ---------------------------------------------------------------------------------------------------

Distribution::Distribution(Shape shape, const Interval& support, const Interval& first, const Interval& second)
    : shape_(shape),
      support_(support),
      firstRange_(first),
      secondRange_(second),
      first_(midpoint(first)),
      second_(midpoint(second)) {
  require(!isEmpty(support) && isBounded(support), "a distribution needs a bounded support, not " + toString(support));
  if (hasPieces()) return;
  least_ = members(true);
  greatest_ = isPrecise() ? std::vector<Member>{} : members(false);
  if (!isTruncated() || isThin(support)) return;
  const auto hasMass = [&](const Member& member) {
    Distribution one = *this;
    one.first_ = midpoint(member.first), one.second_ = midpoint(member.second);
    return one.below(support.upper()) - one.below(support.lower()) > 0 ||
           one.above(support.lower()) - one.above(support.upper()) > 0;
  };
  require(std::ranges::all_of(least_, hasMass) && std::ranges::all_of(greatest_, hasMass),
          "the " + std::string(this->name()) + " distribution has no mass on its support " + toString(support) +
              (isPrecise() ? "" : " for some of its parameters"));
}

Distribution::Distribution() : Distribution(Shape::uniform, Interval(0.0), 0.0, 0.0) {}

Distribution Distribution::uniform(const Interval& support) { return {Shape::uniform, support, 0, 0}; }

Distribution Distribution::triangular(const Interval& support, const Interval& mode) {
  require(isSubset(mode, support),
          "the mode " + shown(mode) + " of a triangular distribution lies outside its support " + toString(support));
  return {Shape::triangular, support, mode, 0};
}

Distribution Distribution::normal(const Interval& support, const Interval& mean, const Interval& deviation) {
  require(isBounded(mean), "the mean of a normal distribution must be finite");
  requirePositive(deviation, "the deviation of a normal distribution");
  return {Shape::normal, support, mean, deviation};
}

Distribution Distribution::beta(const Interval& support, const Interval& a, const Interval& b) {
  requirePositive(a, "the first parameter of a beta distribution");
  requirePositive(b, "the second parameter of a beta distribution");
  return {Shape::beta, support, a, b};
}

Distribution Distribution::lognormal(const Interval& support, const Interval& logMean, const Interval& logDeviation) {
  require(isBounded(logMean), "the logarithmic mean of a lognormal distribution must be finite");
  requirePositive(logDeviation, "the logarithmic deviation of a lognormal distribution");
  requireNotNegative(support, "a lognormal");
  return {Shape::lognormal, support, logMean, logDeviation};
}

Distribution Distribution::weibull(const Interval& support, const Interval& shape, const Interval& scale) {
  requirePositive(shape, "the shape of a Weibull distribution");
  requirePositive(scale, "the scale of a Weibull distribution");
  requireNotNegative(support, "a Weibull");
  return {Shape::weibull, support, shape, scale};
}

Distribution Distribution::gamma(const Interval& support, const Interval& shape, const Interval& scale) {
  requirePositive(shape, "the shape of a gamma distribution");
  requirePositive(scale, "the scale of a gamma distribution");
  requireNotNegative(support, "a gamma");
  return {Shape::gamma, support, shape, scale};
}

Distribution Distribution::exponential(const Interval& support, const Interval& mean) {
  requirePositive(mean, "the mean of an exponential distribution");
  requireNotNegative(support, "an exponential");
  return {Shape::exponential, support, 1, mean};  // Weibull's of shape 1
}

Distribution Distribution::histogram(const std::vector<double>& values, const std::vector<double>& weights) {
  require(values.size() >= 2 && weights.size() + 1 == values.size(),
          "a histogram needs at least two values and one weight fewer");
  Distribution found(Shape::histogram, Interval(values.front(), std::max(values.front(), values.back())), 0, 0);
  Interval all(0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    require(values[i] <= values[i + 1],
            "the values of a histogram fall from " + toString(values[i]) + " to " + toString(values[i + 1]));
    require(weights[i] >= 0 && std::isfinite(weights[i]),
            "a weight of a histogram is not negative, unlike " + toString(weights[i]));
    all = all + Interval(weights[i]);
  }
  require(all.lower() > 0, "a histogram needs a positive weight");
  Interval sum(0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum = sum + Interval(weights[i]);
    found.pieces_.push_back({values[i + 1], weights[i], intersection(sum / all, Interval(0.0, 1.0))});
  }
  found.pieces_.back().below = Interval(1.0);
  return found;
}

Distribution Distribution::empirical(std::vector<double> values) {
  require(values.size() >= 2, "measurements are at least two values");
  std::ranges::sort(values);
  Distribution found = histogram(values, std::vector<double>(values.size() - 1, 1.0));
  found.shape_ = Shape::empirical;
  return found;
}

/// Where samples are: evenly in every interval, between all the ends as a histogram.
Distribution Distribution::evidence(std::vector<FocalInterval> focal) {
  require(!focal.empty(), "evidence needs an interval");
  std::vector<double> ends;
  double all = 0;
  for (const FocalInterval& each : focal) {
    require(!isEmpty(each.values) && isBounded(each.values),
            "evidence is about bounded intervals, unlike " + toString(each.values));
    require(each.mass.lower() >= 0 && isBounded(each.mass), "a mass is not negative, unlike " + shown(each.mass));
    all += midpoint(each.mass);
    ends.insert(ends.end(), {each.values.lower(), each.values.upper()});
    if (isThin(each.values)) ends.push_back(each.values.lower());
  }
  require(all > 0 && std::isfinite(all), "evidence needs a positive mass");
  std::erase_if(focal, [](const FocalInterval& each) { return each.mass.upper() == 0; });
  std::ranges::sort(ends);
  std::vector<double> edges;  // a value twice where an interval is but that value
  for (const double end : ends) {
    const auto same = std::ranges::count(edges, end);
    const bool isSingle = std::ranges::any_of(
        focal, [&](const FocalInterval& each) { return isThin(each.values) && each.values.lower() == end; });
    if (same < (isSingle ? 2 : 1)) edges.push_back(end);
  }
  std::vector<double> weights(edges.size() - 1, 0.0);
  for (const FocalInterval& each : focal)
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (isThin(each.values)) {
        if (edges[i] == edges[i + 1] && edges[i] == each.values.lower()) weights[i] += midpoint(each.mass);
      } else if (edges[i] >= each.values.lower() && edges[i + 1] <= each.values.upper()) {
        weights[i] += midpoint(each.mass) * ((edges[i + 1] - edges[i]) / (each.values.upper() - each.values.lower()));
      }
    }
  Distribution found = histogram(edges, weights);
  found.shape_ = Shape::evidence;
  found.focal_ = std::move(focal);
  return found;
}

bool Distribution::isPrecise() const {
  if (shape_ == Shape::evidence)
    return std::ranges::all_of(focal_, [](const FocalInterval& each) { return isThin(each.values); });
  return isThin(firstRange_) && isThin(secondRange_);
}

std::string_view Distribution::name() const {
  constexpr std::array names{"uniform", "triangular",  "normal",    "beta",      "lognormal", "weibull",
                             "gamma",   "exponential", "histogram", "empirical", "evidence"};
  return names[static_cast<std::size_t>(shape_)];
}

std::vector<ShapeNumber> Distribution::numbers() const {
  std::vector<ShapeNumber> numbers{{"lower", support_.lower()}, {"upper", support_.upper()}};
  const auto put = [&](const char* name, const Interval& value, bool hasUnit = true) {
    numbers.push_back({name, value.lower(), hasUnit});
    if (!isThin(value)) numbers.push_back({std::string(name) + ", at most", value.upper(), hasUnit});
  };
  switch (shape_) {
    case Shape::uniform:
      break;
    case Shape::triangular:
      put("mode", firstRange_);
      break;
    case Shape::normal:
      put("mean", firstRange_), put("deviation", secondRange_);
      break;
    case Shape::beta:
      put("a", firstRange_, false), put("b", secondRange_, false);
      break;
    case Shape::lognormal:
      put("log_mean", firstRange_, false), put("log_deviation", secondRange_, false);
      break;
    case Shape::weibull:
    case Shape::gamma:
      put("shape", firstRange_, false), put("scale", secondRange_);
      break;
    case Shape::exponential:
      put("mean", secondRange_);
      break;
    case Shape::evidence:
      for (std::size_t i = 0; i < focal_.size(); ++i) {
        const std::string of = std::to_string(i + 1);
        numbers.push_back({"lower " + of, focal_[i].values.lower()});
        numbers.push_back({"upper " + of, focal_[i].values.upper()});
        numbers.push_back({"mass " + of, midpoint(focal_[i].mass), false});
      }
      break;
    case Shape::histogram:
      for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const std::string of = std::to_string(i + 1);
        numbers.push_back({"value " + of, i == 0 ? support_.lower() : pieces_[i - 1].end});
        numbers.push_back({"weight " + of, pieces_[i].weight, false});
      }
      break;
    case Shape::empirical:
      numbers.push_back({"count", static_cast<double>(pieces_.size() + 1), false});
      for (std::size_t i = 0; i + 1 < pieces_.size(); ++i)
        numbers.push_back({"value " + std::to_string(i + 2), pieces_[i].end});
  }
  if (isTruncated()) numbers.push_back({"cut_off", cutOff(), false});
  return numbers;
}

bool Distribution::isTruncated() const {
  return shape_ != Shape::uniform && shape_ != Shape::triangular && shape_ != Shape::beta && !hasPieces();
}

double Distribution::below(double value) const {
  switch (shape_) {
    case Shape::gamma:
      return boost::math::gamma_p(first_, value / second_);
    case Shape::weibull:
    case Shape::exponential:
      return -std::expm1(-std::pow(value / second_, first_));
    default:
      return gsl_cdf_ugaussian_P(((shape_ == Shape::lognormal ? std::log(value) : value) - first_) / second_);
  }
}

double Distribution::above(double value) const {
  switch (shape_) {
    case Shape::gamma:
      return boost::math::gamma_q(first_, value / second_);
    case Shape::weibull:
    case Shape::exponential:
      return std::exp(-std::pow(value / second_, first_));
    default:
      return gsl_cdf_ugaussian_Q(((shape_ == Shape::lognormal ? std::log(value) : value) - first_) / second_);
  }
}

double Distribution::whereBelow(double probability) const {
  switch (shape_) {
    case Shape::gamma:
      return second_ * boost::math::gamma_p_inv(first_, probability);
    case Shape::weibull:
    case Shape::exponential:
      return second_ * std::pow(-std::log1p(-probability), 1 / first_);
    default:
      const double value = first_ + second_ * gsl_cdf_ugaussian_Pinv(probability);
      return shape_ == Shape::lognormal ? std::exp(value) : value;
  }
}

double Distribution::whereAbove(double probability) const {
  switch (shape_) {
    case Shape::gamma:
      return second_ * boost::math::gamma_q_inv(first_, probability);
    case Shape::weibull:
    case Shape::exponential:
      return second_ * std::pow(-std::log(probability), 1 / first_);
    default:
      const double value = first_ + second_ * gsl_cdf_ugaussian_Qinv(probability);
      return shape_ == Shape::lognormal ? std::exp(value) : value;
  }
}

double Distribution::cutOff() const { return isTruncated() ? below(support_.lower()) + above(support_.upper()) : 0.0; }

double Distribution::quantile(double u) const {
  require(u >= 0 && u <= 1, "a probability lies between 0 and 1, not at " + toString(u));
  const double lower = support_.lower(), upper = support_.upper(), span = upper - lower;
  if (u == 0 || lower == upper) return lower;
  if (u == 1) return upper;
  switch (shape_) {
    case Shape::histogram:
    case Shape::empirical:
    case Shape::evidence: {
      const auto piece = std::ranges::lower_bound(pieces_, u, {}, [](const Piece& p) { return midpoint(p.below); });
      if (piece == pieces_.end()) return upper;
      const bool isFirst = piece == pieces_.begin();
      const double from = isFirst ? lower : std::prev(piece)->end,
                   before = isFirst ? 0 : midpoint(std::prev(piece)->below), all = midpoint(piece->below) - before;
      return std::clamp(from + (all > 0 ? (u - before) / all : 1) * (piece->end - from), from, piece->end);
    }
    case Shape::uniform:
      return clamp(lower + u * span, support_);
    case Shape::triangular:
      // u = (v-lower)² / (span (mode-lower)) up to the mode, 1-u = (upper-v)² / (span (upper-mode)) beyond
      if (u * span < first_ - lower) return clamp(lower + std::sqrt(u * span * (first_ - lower)), support_);
      return clamp(upper - std::sqrt((1 - u) * span * (upper - first_)), support_);
    // GSL's inverse ends the process when its iteration does not converge; Boost.Math's holds for all parameters.
    case Shape::beta:
      return clamp(lower + boost::math::ibeta_inv(first_, second_, u) * span, support_);
    default:
      break;
  }
  // Where the support lies in the upper half, upper tails keep the digits that probabilities near 1 have lost.
  if (above(lower) + above(upper) < 1) {
    const double tail = above(upper) + (1 - u) * (above(lower) - above(upper));
    return clamp(whereAbove(tail), support_);
  }
  return clamp(whereBelow(below(lower) + u * (below(upper) - below(lower))), support_);
}

// ---- Uncertain ------------------------------------------------------------------------------------------------------

Interval Uncertain::inside() const {
  const double rounding = 32 * 0x1p-53 * std::max(magnitude(range), std::fabs(nominal)) + 4 * blur;
  const double lower = addUp(range.lower(), rounding), upper = subDown(range.upper(), rounding);
  return lower <= upper ? Interval(lower, upper) : Interval::empty();
}

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
