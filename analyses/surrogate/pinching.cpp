// Ranges of the polynomials, one symbol of which is a number.
#include "analyses/surrogate/pinching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "analyses/flow/series/polynomial_range.hpp"

namespace gamut {
namespace {

class Ranges {
 public:
  Ranges(const std::vector<SurrogatePart>& parts, std::size_t output) : parts_(parts), output_(output) {}

  /// Over all parts, where a symbol is no number; over those that hold it, where it is `xi`.
  Interval over(int symbol, const Interval& xi) {
    Interval range = Interval::empty();
    for (const SurrogatePart& each : parts_) {
      Box box(each.part.centre.size(), Interval(-1.0, 1.0));
      if (symbol >= 0) {
        const Interval own = (xi - Interval(each.part.centre[symbol])) / Interval(each.part.half[symbol]);
        box[symbol] = intersection(own, Interval(-1.0, 1.0));
        if (isEmpty(box[symbol])) continue;
      }
      range = hull(range, of(each, box));
    }
    return range;
  }

 private:
  Interval of(const SurrogatePart& part, const Box& box) {
    const OutputModel& model = part.outputs[output_];
    if (model.c.empty()) return model.bound;
    const auto [place, isNew] = evaluators_.try_emplace(part.monomials.get(), part.monomials);
    std::vector<double> c = model.c;
    c.resize(part.monomials->count(), 0.0);
    const Interval range = place->second(c.data(), box, 1e-3) + Interval(-model.radius, model.radius);
    return intersection(range, model.bound);
  }

  const std::vector<SurrogatePart>& parts_;
  std::size_t output_;
  std::map<const Monomials*, PolynomialRange> evaluators_;
};

}  // namespace

std::vector<double> pinchedShares(const Surrogate& surrogate, const std::vector<SurrogatePart>& parts,
                                  std::size_t output, const std::vector<double>& nominal) {
  std::vector<double> shares(surrogate.quantities.size(), std::numeric_limits<double>::quiet_NaN());
  Ranges ranges(parts, output);
  const Interval all = ranges.over(-1, Interval(0.0));
  if (!isBounded(all) || !(width(all) > 0)) return shares;
  for (std::size_t q = 0; q < shares.size(); ++q) {
    const FlowSymbol& of = surrogate.quantities[q];
    shares[q] = 0;
    if (of.symbol < 0) continue;
    const Interval xi = (Interval(nominal[q]) - Interval(of.centre)) / Interval(of.half);
    shares[q] = std::clamp(1 - width(ranges.over(of.symbol, xi)) / width(all), 0.0, 1.0);
  }
  return shares;
}

}  // namespace gamut
