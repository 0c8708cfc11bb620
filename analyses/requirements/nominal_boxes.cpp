// Polynomials that rise or fall all over a box are least in one of its corners, which their signs name.
#include "analyses/requirements/nominal_boxes.hpp"

#include <algorithm>
#include <cmath>

namespace gamut {

NominalBoxes::NominalBoxes(const FlowModels& models, Cells& cells, const std::vector<CellQuantity>& quantities)
    : models_(models), cells_(cells), quantities_(quantities), root_(cells.whole()) {
  constexpr double mostBytes = 2e9, least = 6, most = 64;
  patience_ = static_cast<int>(std::clamp(mostBytes / root_->bytes(), least, most));
}

/// Ends are rounded outward to multiples of 2^-24, so that parts are exact.
FlowPart NominalBoxes::partOf(const std::vector<Interval>& values) const {
  constexpr double unit = 0x1p-24;
  FlowPart part = root_->part();
  for (std::size_t q = 0; q < values.size(); ++q) {
    const FlowSymbol& of = models_.components[quantities_[q].component];
    if (of.symbol < 0) continue;
    const Interval xi = (values[q] - Interval(of.centre)) / Interval(of.half);
    const double lower = std::clamp(std::floor(std::max(xi.lower(), -2.0) / unit) * unit, -1.0, 1.0 - unit);
    const double upper = std::clamp(std::ceil(std::min(xi.upper(), 2.0) / unit) * unit, lower + unit, 1.0);
    part.centre[of.symbol] = 0.5 * (lower + upper);
    part.half[of.symbol] = 0.5 * (upper - lower);
  }
  return part;
}

bool NominalBoxes::isMet(const std::vector<Interval>& values) {
  return root_->verdict() == Cell::Verdict::met ||
         (root_->verdict() == Cell::Verdict::open &&
          cells_.tightlyWithin(*root_, partOf(values))->verdict() == Cell::Verdict::met);
}

std::optional<std::vector<double>> NominalBoxes::violationIn(const std::vector<Interval>& values) {
  if (root_->verdict() == Cell::Verdict::met) return std::nullopt;
  if (root_->verdict() == Cell::Verdict::violated) return violationNear(partOf(values).centre, values);
  const std::unique_ptr<Cell> cell = cells_.tightlyWithin(*root_, partOf(values));
  if (cell->verdict() == Cell::Verdict::met) return std::nullopt;
  if (cell->verdict() == Cell::Verdict::violated) return violationNear(cell->part().centre, values);
  for (const std::vector<double>& xi : cells_.lowestPoints(*cell))
    if (std::optional<std::vector<double>> found = violationNear(xi, values)) return found;
  return std::nullopt;
}

/// The value is a number, and what ξ it has is known to some roundings, as verdictAt asks: its distance from the centre
/// is, and so is the quotient.
std::optional<std::vector<double>> NominalBoxes::violationNear(const std::vector<double>& xi,
                                                               const std::vector<Interval>& values) {
  std::vector<double> found, place(xi.size(), 0.0);
  for (std::size_t q = 0; q < values.size(); ++q) {
    const FlowSymbol& of = models_.components[quantities_[q].component];
    const Interval inside = intersection(quantities_[q].uncertain->inside(), values[q]);
    if (isEmpty(inside)) return std::nullopt;
    if (of.symbol < 0) {
      found.push_back(midpoint(inside));
      continue;
    }
    found.push_back(std::clamp(of.centre + of.half * xi[of.symbol], inside.lower(), inside.upper()));
    place[of.symbol] = std::clamp((found.back() - of.centre) / of.half, -1.0, 1.0);
  }
  if (cells_.verdictAt(place) != Cell::Verdict::violated) return std::nullopt;
  return found;
}

}  // namespace gamut
