// Margins as sums of functions of one symbol each, whose distributions are known where those of the symbols are.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/probability/curved_sum.hpp"
#include "analyses/requirements/cells.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut {

namespace {

using Functions = std::vector<std::vector<double>>;

double sizeOf(const Functions& f) {
  double size = 0;
  for (const std::vector<double>& own : f)
    for (const double c : own) size += std::fabs(c);
  return size * bounds::up;
}

/// Σ|coefficients| of the difference, by symbol: the difference is no more, |η| <= 1.
std::vector<double> apartOf(const Functions& a, const Functions& b) {
  std::vector<double> apart(a.size(), 0.0);
  for (std::size_t l = 0; l < a.size(); ++l)
    for (std::size_t n = 0; n < std::max(a[l].size(), b[l].size()); ++n)
      apart[l] += std::fabs((n < a[l].size() ? a[l][n] : 0.0) - (n < b[l].size() ? b[l][n] : 0.0));
  return apart;
}

double sumOf(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number;
  return sum * bounds::up;
}

/// Below all of them (sign 1), or above (-1): the shape of the one that comes lowest, Σ f_l, and the least of the
/// constants, less what shapes differ by. Adds to `mixedOf` what keeps it from these.
template <class Bounded>
CellSum beside(const std::vector<Bounded>& margins, int sign, std::vector<double>& mixedOf) {
  const auto extreme = [&](const Bounded& b) { return sign > 0 ? b.from - sizeOf(b.f) : -b.to - sizeOf(b.f); };
  const Bounded& lowest = *std::ranges::min_element(margins, {}, extreme);
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> between(mixedOf.size(), 0.0);  // of the one that decides
  for (const Bounded& b : margins) {
    std::vector<double> apart = apartOf(b.f, lowest.f);
    const double constant = subDown(sign > 0 ? b.from : -b.to, sumOf(apart));
    if (!(constant < least)) continue;
    least = constant;
    for (std::size_t l = 0; l < apart.size(); ++l) apart[l] += b.mixedOf[l];
    between = std::move(apart);
  }
  for (std::size_t l = 0; l < mixedOf.size(); ++l) mixedOf[l] += between[l];
  return {lowest.f, sign * least};
}

}  // namespace

double sizeOf(const CellSum& sum) { return sizeOf(sum.f); }

/// Where the polynomial covers the cell. A margin is φ(Σ f_l) + what is not known, and φ rises: above zero where Σ f_l
/// is above a number, below zero where it is below another.
std::optional<Cells::Separated> Cells::separated(const Cell& cell, std::size_t place, std::size_t margin,
                                                 const Interval& sag) const {
  const Cell::Local& local = cell.locals_[place];
  const std::vector<double>& c = local.c[margin];
  if (c.empty() || !isBounded(sag) || !isInside(cell.part_, local.part)) return std::nullopt;
  std::vector<char> isOwn(models_.symbols, 1);
  for (const int l : question_.besides) isOwn[l] = 0;
  CurvedSum sum = curvedSumOf(c, *local.of->monomials, isOwn);
  const double radius = local.radius[margin];
  const double least = subDown(addDown(sum.constant, sag.lower()), addUp(sum.down, radius));
  const double most = addUp(addUp(sum.constant, sag.upper()), addUp(sum.up, radius));
  const double from = -sum.above(-least), to = -sum.below(-most);
  return Separated{std::move(sum.f), std::move(sum.mixedOf), from, to, 2 * radius + width(sag)};
}

CellSums Cells::sums(const Cell& cell, const std::vector<std::size_t>& margins) const {
  const bool isAlways = question_.when == CellQuestion::When::always;
  CellSums sums;
  sums.mixedOf.assign(models_.symbols, 0.0);
  // Throughout: on all chords, and at the output time where there is one alone.
  std::vector<Separated> throughout;
  bool isKnown = isAlways || margins.size() == 1;
  const auto include = [&](std::size_t local, std::size_t margin, const Interval& sag) {
    std::optional<Separated> bounded = separated(cell, local, margin, sag);
    isKnown = isKnown && bounded;
    if (!isKnown) return;
    sums.rest = std::max(sums.rest, bounded->rest);
    throughout.push_back(std::move(*bounded));
  };
  for (const std::size_t i : margins) {
    for (const Cell::Chord& chord : cell.chords_)
      for (const std::size_t local : {chord.before, chord.behind})
        if (isKnown) include(local, i, chord.of->sag[question_.margins[i]]);
    if (question_.from == question_.until)
      for (const Cell::Moment& moment : cell.moments_)
        for (const std::size_t local : moment.snapshots)
          if (isKnown) include(local, i, Interval(0.0));
  }
  if (isKnown && !throughout.empty())
    (isAlways ? sums.met : sums.violated) = beside(throughout, isAlways ? 1 : -1, sums.mixedOf);
  // Once: at the output time that decides most, beside what is uncertain about it.
  const auto scoreOf = [](const CellSum& sum, double way) { return way / (sizeOf(sum.f) + bounds::tiny); };
  double best = -std::numeric_limits<double>::infinity();
  std::vector<double> mixedOf;
  for (const Cell::Moment& moment : cell.moments_) {
    if (moment.snapshots.size() != 1) continue;
    std::vector<Separated> all;
    for (const std::size_t i : margins)
      if (std::optional<Separated> bounded = separated(cell, moment.snapshots[0], i, Interval(0.0)))
        all.push_back(std::move(*bounded));
    if (all.size() != margins.size()) continue;
    if (isAlways) {
      for (Separated& margin : all) {
        CellSum sum{std::move(margin.f), margin.to};
        const double score = scoreOf(sum, -margin.to);
        if (!(score > best)) continue;
        best = score;
        mixedOf = std::move(margin.mixedOf);
        sums.violated = std::move(sum);
      }
    } else {
      std::vector<double> own(sums.mixedOf.size(), 0.0);
      CellSum sum = beside(all, 1, own);
      const double score = scoreOf(sum, sum.constant);
      if (!(score > best)) continue;
      best = score;
      mixedOf = std::move(own);
      sums.met = std::move(sum);
    }
  }
  for (std::size_t l = 0; l < mixedOf.size(); ++l) sums.mixedOf[l] += mixedOf[l];
  return sums;
}

}  // namespace gamut
