#include "analyses/distribution.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace gamut {
namespace {

std::unique_ptr<DistributionLaw> settledLaw(std::unique_ptr<DistributionLaw> law) {
  law->settle();
  return law;
}

}  // namespace

const std::vector<FocalInterval>& DistributionLaw::focal() const {
  static const std::vector<FocalInterval> none;
  return none;
}

Distribution::Distribution() {
  static const Distribution zero = uniform(Interval(0.0));
  *this = zero;
}

Distribution::Distribution(std::unique_ptr<DistributionLaw> law)
    : law_(settledLaw(std::move(law))), support_(law_->support()) {}

double Distribution::quantile(double u) const {
  requireShape(u >= 0 && u <= 1, "a probability lies between 0 and 1, not at " + toString(u));
  if (u == 0 || isThin(support_)) return support_.lower();
  if (u == 1) return support_.upper();
  return law_->quantile(u);
}

bool Distribution::isMonotone(const Interval& values) const {
  if (isEmpty(intersection(values, support_))) return true;
  if (!isSubset(values, support_)) return false;  // it jumps from zero
  return isPrecise() && law_->isMonotone(values);
}

void requireShape(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument(what);
}

std::string shownNumber(const Interval& value) { return isThin(value) ? toString(value.lower()) : toString(value); }

void requirePositive(const char* key, const Interval& value, const char* what) {
  if (!(value.lower() > 0 && isBounded(value)))
    throw ShapeRefusal(key, std::nullopt, std::string(what) + " must be positive, not " + shownNumber(value),
                       "a number above 0");
}

void requireNotNegative(const Interval& support, const char* what) {
  requireShape(support.lower() >= 0,
               std::string(what) + " distribution needs a support that is not negative, not " + toString(support));
}

}  // namespace gamut
