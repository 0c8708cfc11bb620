#include "analyses/family.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace gamut {
namespace {

const Interval wholeShare(0.0, 1.0);
constexpr double noDensityBound = std::numeric_limits<double>::infinity();

}  // namespace

Interval Family::anyDensity() { return {0.0, noDensityBound}; }

Family::Parameters Family::parameters() {
  class Gather : public ShapeFields {
   public:
    void parameter(const ShapeWord& /*word*/, Trend trend, Interval& number) override {
      found.emplace_back(&number, trend);
    }
    Parameters found;
  } gather;
  describe(gather);
  return gather.found;
}

void Family::settle() {
  check();
  requireShape(!isEmpty(on) && isBounded(on), "a distribution needs a bounded support, not " + toString(on));
  isPrecise_ = std::ranges::all_of(parameters(), [](const auto& parameter) { return isThin(*parameter.first); });
  const auto least = members(true), greatest = isPrecise_ ? decltype(least){} : members(false);
  least_ = least, greatest_ = greatest;
  if (isThin(on)) return;
  const auto hasMassOn = [](const auto& member) { return member->hasMass(); };
  requireShape(std::ranges::all_of(least_, hasMassOn) && std::ranges::all_of(greatest_, hasMassOn),
               "the " + std::string(this->name()) + " distribution has no mass on its support " + toString(on) +
                   (isPrecise_ ? "" : " for some of its parameters"));
}

/// `low`: of low values. By parameters on which the likelihood ratio depends monotonously: where densities are
/// h(x) exp(θ T(x)), T monotone in x, the quantity grows with θ, or falls, truncated or not (E. L. Lehmann, J. P.
/// Romano, Testing Statistical Hypotheses, lemma 3.4.2).
std::vector<std::shared_ptr<const Family>> Family::members(bool low) const {
  std::shared_ptr<Family> first = copy();
  for (const auto& [number, trend] : first->parameters())
    if (trend != Trend::none) *number = (trend == Trend::rises) == low ? number->lower() : number->upper();
  const auto prepared = [](const std::shared_ptr<Family>& family) {
    family->prepare();
    return family;
  };
  // Of F what is cut off alone keeps parameters that are not single numbers from being as good.
  constexpr int parts = 16;
  std::vector<std::shared_ptr<Family>> found{first};
  const std::size_t count = first->parameters().size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [range, trend] = first->parameters()[i];
    if (trend != Trend::none || isThin(*range) || prepared(first->copy())->hidden() < 1e-4) continue;
    std::vector<std::shared_ptr<Family>> divided;
    for (const auto& family : found)
      for (int k = 0; k < parts; ++k) {
        const double lower = range->lower(), upper = range->upper();
        const auto cutAt = [&](int at) {
          return at == 0 ? lower : at == parts ? upper : std::clamp(lower + (upper - lower) * at / parts, lower, upper);
        };
        divided.push_back(family->copy());
        *divided.back()->parameters()[i].first = Interval(cutAt(k), cutAt(k + 1));
      }
    found = std::move(divided);
  }
  std::vector<std::shared_ptr<const Family>> all;
  for (const auto& family : found) all.push_back(prepared(family));
  return all;
}

std::vector<ShapeNumber> Family::numbers() const {
  ShapeNumbers numbers(on);
  copy()->describe(numbers);
  return numbers.found;
}

bool Family::isPrecise() const { return isPrecise_; }

Interval Family::enclosedBelow(const Interval& value) const {
  if (value.lower() >= on.upper()) return Interval(1.0);
  if (value.upper() < on.lower() || (value.upper() == on.lower() && !isThin(on))) return Interval(0.0);
  if (isThin(on)) return wholeShare;  // it jumps there
  const Interval v = intersection(value, on);
  if (isPrecise_) return least_.front()->enclosed(v);
  double lower = 1, upper = 0;
  for (const auto& member : least_) upper = std::max(upper, member->enclosed(v).upper());
  for (const auto& member : greatest_) lower = std::min(lower, member->enclosed(v).lower());
  return {lower, upper};
}

/// It rises to its mode and falls from there.
DensityBound Family::densityBound() const {
  if (!isPrecise_) return {noDensityBound, noDensityBound};
  const double most = least_.front()->densest().upper();
  return {most, 2 * most};
}

// ---- Truncated ------------------------------------------------------------------------------------------------------

void Truncated::prepare() {
  cut_ = enclosedAll(Interval(on.lower()));
  all_ = enclosedAll(Interval(on.upper())) - cut_;
}

Interval Truncated::enclosed(const Interval& v) const {
  const Interval found = (enclosedAll(v) - cut_) / all_;
  return isEmpty(found) ? wholeShare : intersection(found, wholeShare);
}

bool Truncated::hasMass() const {
  return below(on.upper()) - below(on.lower()) > 0 || above(on.lower()) - above(on.upper()) > 0;
}

double Truncated::hidden() const {
  return enclosedAll(Interval(on.lower())).upper() + 1 - enclosedAll(Interval(on.upper())).lower();
}

std::vector<ShapeNumber> Truncated::numbers() const {
  std::vector<ShapeNumber> numbers = Family::numbers();
  numbers.push_back({"cut_off", cutOff(), false});
  return numbers;
}

double Truncated::quantile(double u) const {
  const double lower = on.lower(), upper = on.upper();
  // Where the support lies in the upper half, upper tails keep the digits that probabilities near 1 have lost.
  if (above(lower) + above(upper) < 1) {
    const double tail = above(upper) + (1 - u) * (above(lower) - above(upper));
    return std::clamp(whereAbove(tail), lower, upper);
  }
  return std::clamp(whereBelow(below(lower) + u * (below(upper) - below(lower))), lower, upper);
}

}  // namespace gamut
