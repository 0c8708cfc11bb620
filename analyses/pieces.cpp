#include "analyses/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace gamut {

void Pieces::fill(const std::vector<double>& values, const std::vector<double>& weights) {
  requireShape(values.size() >= 2 && weights.size() + 1 == values.size(),
               "a histogram needs at least two values and one weight fewer");
  support_ = Interval(values.front(), std::max(values.front(), values.back()));
  requireShape(isBounded(support_), "a distribution needs a bounded support, not " + toString(support_));
  Interval all(0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    requireShape(values[i] <= values[i + 1],
                 "the values of a histogram fall from " + toString(values[i]) + " to " + toString(values[i + 1]));
    requireShape(weights[i] >= 0 && std::isfinite(weights[i]),
                 "a weight of a histogram is not negative, unlike " + toString(weights[i]));
    all = all + Interval(weights[i]);
  }
  requireShape(all.lower() > 0, "a histogram needs a positive weight");
  Interval sum(0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum = sum + Interval(weights[i]);
    pieces_.push_back({values[i + 1], weights[i], intersection(sum / all, Interval(0.0, 1.0))});
  }
  pieces_.back().below = Interval(1.0);
}

double Pieces::quantile(double u) const {
  const auto piece = std::ranges::lower_bound(pieces_, u, {}, [](const Piece& p) { return midpoint(p.below); });
  if (piece == pieces_.end()) return support_.upper();
  const bool isFirst = piece == pieces_.begin();
  const double from = isFirst ? support_.lower() : std::prev(piece)->end,
               before = isFirst ? 0 : midpoint(std::prev(piece)->below), all = midpoint(piece->below) - before;
  return std::clamp(from + (all > 0 ? (u - before) / all : 1) * (piece->end - from), from, piece->end);
}

/// The piece that begins at or before a value inside the support, the last of them.
std::size_t Pieces::pieceAt(double value) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(pieces_, value, {}, &Piece::end) - pieces_.begin());
}

/// Whether some value has a probability of its own: F jumps there.
bool Pieces::hasSingleValues() const {
  double from = support_.lower();
  for (const Piece& piece : pieces_)
    if (std::exchange(from, piece.end) == piece.end && piece.weight > 0) return true;
  return false;
}

/// F rises linearly from one end to the next.
Interval Pieces::belowOf(double value) const {
  if (value < support_.lower()) return Interval(0.0);
  const std::size_t i = pieceAt(value);
  if (i == pieces_.size()) return Interval(1.0);
  const Interval before = i == 0 ? Interval(0.0) : pieces_[i - 1].below;
  const Interval from(i == 0 ? support_.lower() : pieces_[i - 1].end), end(pieces_[i].end);
  const Interval found = before + (pieces_[i].below - before) * ((Interval(value) - from) / (end - from));
  return intersection(found, hull(before, pieces_[i].below));
}

Interval Pieces::enclosedBelow(const Interval& value) const {
  return rising([&](double x) { return belowOf(x); }, value);
}

/// Even inside a piece.
bool Pieces::isMonotone(const Interval& values) const {
  return !hasSingleValues() && !isThin(values) &&
         pieceAt(values.lower()) == pieceAt(std::nextafter(values.upper(), values.lower()));
}

DensityBound Pieces::densityBound() const {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  if (hasSingleValues()) return {unlimited, unlimited};
  double most = 0;
  Interval variation(0.0), density(0.0), before(0.0), from(support_.lower());
  for (const Piece& piece : pieces_) {
    const Interval end(piece.end);
    if (piece.end == from.lower()) continue;  // without a weight
    const Interval next = abs(piece.below - before) / (end - from);
    variation = variation + abs(next - density);
    most = std::max(most, next.upper());
    before = piece.below, from = end, density = next;
  }
  return {most, (variation + density).upper()};
}

}  // namespace gamut
