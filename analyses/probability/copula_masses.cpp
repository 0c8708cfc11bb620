#include "analyses/probability/copula_masses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/normal_distribution.hpp"
#include "analyses/probability/normal_grid.hpp"
#include "analyses/probability/quantity_masses.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut {
namespace {

/// Numbers z beyond that count as errors: they would have boxes bend that are linear otherwise.
constexpr double likely = 7, some = 0x1p-10;

/// A number z with Φ(z) on that side of a probability, next to it.
double normalQuantile(double p, int side) {
  if (p <= 0) return -std::numeric_limits<double>::infinity();
  if (p >= 1) return std::numeric_limits<double>::infinity();
  const double z = aboutNormalQuantile(p);
  for (double by = 1e-14 * (1 + std::fabs(z)); by < 100; by *= 4) {
    const Interval at = normalBelow(Interval(z + side * by));
    if (side > 0 ? at.lower() >= p : at.upper() <= p) return z + side * by;
  }
  return side * std::numeric_limits<double>::infinity();
}

}  // namespace

/// The marginal F(e) < Φ(z) where z > a with Φ(a) >= F(e), and Φ(z) <= F(e) where z <= b with Φ(b) <= F(e).
CopulaMasses::CopulaMasses(const GaussianCopula& copula, std::vector<std::size_t> rows,
                           const std::vector<std::vector<Interval>>& below)
    : axes_(rows.back() + 1) {
  for (std::size_t r = 0; r < rows.size(); ++r) {
    Row& row = rows_.emplace_back();
    for (std::size_t j = 0; j < axes_; ++j) {
      const Interval root = j <= rows[r] ? copula.root()[rows[r]][j] : Interval(0.0);
      row.root.push_back(midpoint(root));
      row.error +=
          NormalGrid::reach * (width(root) + 2 * static_cast<double>(axes_ + 2) * bounds::unit * magnitude(root));
    }
    row.error *= bounds::up;
    for (const Interval& p : below[r]) {
      row.above.push_back(normalQuantile(p.upper(), 1));
      row.notAbove.push_back(normalQuantile(p.lower(), -1));
    }
    // Rising, as those of which they are bounds.
    for (std::size_t i = 1; i < row.above.size(); ++i) row.above[i] = std::max(row.above[i], row.above[i - 1]);
    for (std::size_t i = row.notAbove.size() - 1; i-- > 0;)
      row.notAbove[i] = std::min(row.notAbove[i], row.notAbove[i + 1]);
  }
  // Of products of distributions Σ|error| is at most the sum of theirs; each z is beyond with that probability.
  const double unlikely = 2 * normalBelow(Interval(-likely)).upper();
  error_ =
      (static_cast<double>(axes_) * NormalGrid::error() + static_cast<double>(rows.size()) * unlikely) * bounds::up;
}

CopulaMasses::Box CopulaMasses::whole() const {
  return {std::vector<std::uint16_t>(axes_, 0), std::vector<std::uint16_t>(axes_, NormalGrid::count), 1.0};
}

std::pair<double, double> CopulaMasses::numbersOf(const Box& box, const Row& row) const {
  double low = -row.error, high = row.error;
  for (std::size_t j = 0; j < axes_; ++j) {
    const double a = row.root[j] * NormalGrid::at(box.from[j]), b = row.root[j] * NormalGrid::at(box.until[j]);
    low += std::min(a, b), high += std::max(a, b);
  }
  // Of what is wholly beyond, and counted as error, anything may be said.
  return {std::clamp(low, -likely, likely - some), std::clamp(high, some - likely, likely)};
}

/// From the last edge that it is above to the first that it is not above.
std::pair<long, long> CopulaMasses::binsOf(const Row& row, double low, double high) {
  constexpr long bins = QuantityMasses::bins;
  const long above = std::ranges::lower_bound(row.above, low) - row.above.begin();
  const long notAbove = std::ranges::lower_bound(row.notAbove, high) - row.notAbove.begin();
  const long from = std::clamp<long>(above - 1, 0, bins - 1);
  return {from, std::clamp<long>(notAbove, from + 1, bins)};
}

std::pair<long, long> CopulaMasses::binsOf(const Box& box, std::size_t row) const {
  const auto [low, high] = numbersOf(box, rows_[row]);
  return binsOf(rows_[row], low, high);
}

void CopulaMasses::halve(const Box& box, std::size_t axis, std::pair<Box&, Box&> into) const {
  const std::vector<double>& below = NormalGrid::below();
  const std::uint16_t middle = static_cast<std::uint16_t>((box.from[axis] + box.until[axis]) / 2);
  into.first = into.second = box;
  into.first.until[axis] = into.second.from[axis] = middle;
  for (Box* half : {&into.first, &into.second}) {
    half->mass = 1;
    for (std::size_t j = 0; j < axes_; ++j) half->mass *= below[half->until[j]] - below[half->from[j]];
  }
}

bool CopulaMasses::halve(const Box& box, std::size_t row, Box& lower, Box& upper) const {
  double most = 0;
  std::size_t axis = 0;
  for (std::size_t j = 0; j < axes_; ++j)
    if (const double by = std::fabs(rows_[row].root[j]) * (box.until[j] - box.from[j]);
        box.until[j] - box.from[j] > 1 && by > most)
      most = by, axis = j;
  if (most > 0) halve(box, axis, {lower, upper});
  return most > 0;
}

}  // namespace gamut
