// What of a polynomial is worth keeping.
#include "analyses/flow/models.hpp"

#include <algorithm>
#include <cmath>

#include "analyses/flow/series/error_bounds.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

bool isOf(const Monomials& m, int g, int symbols) {
  for (int l = symbols; l < m.symbols(); ++l)
    if (m.exponent(g, l) > 0) return false;
  return true;
}

}  // namespace

bool meet(const FlowPart& a, const FlowPart& b) {
  for (std::size_t l = 0; l < a.centre.size(); ++l)
    if (!(std::fabs(a.centre[l] - b.centre[l]) < a.half[l] + b.half[l])) return false;
  return true;
}

bool isInside(const FlowPart& inner, const FlowPart& outer) {
  for (std::size_t l = 0; l < inner.half.size(); ++l)
    if (std::fabs(inner.centre[l] - outer.centre[l]) > outer.half[l] - inner.half[l]) return false;
  return meet(inner, outer);
}

OutputModel modelOf(const double* polynomial, double radius, const Monomials& monomials, int symbols,
                    const Interval& bound) {
  constexpr double next = 1e-7, ofRadius = 0.01;  // of the variation; of what is not known anyway
  OutputModel model{{}, radius, bound};
  if (!std::isfinite(radius)) return model;
  double variation = 0, beside = 0;  // Σ|c|: of all that varies; of the terms that are left out, |ξ^α| ≤ 1
  model.c.assign(polynomial, polynomial + monomials.count());
  for (int g = 1; g < monomials.count(); ++g) {
    const double size = std::fabs(polynomial[g]);
    variation += size;
    if (isOf(monomials, g, symbols)) continue;
    beside += size;
    model.c[g] = 0;
  }
  int grade = monomials.degree();
  for (double dropped = 0; grade > 0; --grade) {
    for (int g = monomials.firstOf(grade); g < monomials.countUpTo(grade); ++g) dropped += std::fabs(model.c[g]);
    if (!(dropped <= next * variation + ofRadius * radius)) break;
  }
  for (std::size_t g = at(monomials.countUpTo(grade)); g < model.c.size(); ++g) beside += std::fabs(model.c[g]);
  model.c.resize(monomials.countUpTo(grade));
  model.c.shrink_to_fit();  // there may be one of each output at each time, on each of many parts
  model.radius = (radius + beside) * bounds::up;
  return model;
}

void OutputExtremes::join(const OutputExtremes& other) {
  if (other.least < least || (other.least == least && other.leastAt < leastAt))
    least = other.least, leastAt = other.leastAt;
  if (other.greatest > greatest || (other.greatest == greatest && other.greatestAt < greatestAt))
    greatest = other.greatest, greatestAt = other.greatestAt;
}

double bytesOf(const FlowSnapshot& snapshot) {
  double bytes = sizeof(FlowSnapshot) + 16.0 * static_cast<double>(snapshot.part.centre.size());
  for (const OutputModel& model : snapshot.outputs)
    bytes += static_cast<double>(sizeof(OutputModel) + sizeof(double) * model.c.size());
  return bytes;
}

}  // namespace gamut
