// Fewer generators in place of many. docs/flow.md, section 3.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/step/set.hpp"
#include "analyses/work.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Matrices = std::vector<Matrix>;  // one a power of ξ

/// So many times as large as before all generators together may be for directions, in balanced units.
constexpr double mostGrown = 1.25;

/// Γ_j(ξ) = Σ_k c_kj(ξ) P_k(ξ) + ρ_j(ξ) for all generators: n directions P_k, of which the first is the longest
/// generator, each further one what the longest has across those before.
struct Directions {
  Matrices p;      // [row][k]
  Matrix most;     // Σ_α |c_α|: [k][j]
  Matrix rest;     // ≥ |ρ|: [row][j]
  Matrix inverse;  // |P_0⁻¹|, about
};

/// For all powers at once rows of Y_α = QᵀD⁻¹Γ_α are eliminated one by one, Q of the QR decomposition of Y_0.
Directions directionsOf(const Matrices& generators, const Monomials& m, const Vector& unit) {
  const Eigen::Index n = unit.size(), count = generators[0].cols();
  const std::size_t powers = generators.size();
  const PivotedFactor qr = pivotedFactorOf(unit.cwiseInverse().asDiagonal() * generators[0]);
  const Matrix turn = qr.q.transpose() * unit.cwiseInverse().asDiagonal();  // QᵀD⁻¹
  Matrices y, c(powers, Matrix::Zero(n, count)), across(powers, Matrix::Zero(n, n));
  for (const Matrix& power : generators) y.emplace_back(turn * power);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index pivot = qr.order(k), below = n - k;
    for (std::size_t g = 0; g < powers; ++g) across[g].col(k).tail(below) = y[g].col(pivot).tail(below);
    for (std::size_t g = 0; g < powers; ++g) {  // the product of powers a and b is g; c_g is still zero
      const auto pairs = std::span(m.pairs()).subspan(at(m.first()[g]), at(m.first()[g + 1] - m.first()[g]));
      Eigen::RowVectorXd row = y[g].row(k);
      for (const auto& [a, b] : pairs) row -= across[a](k, k) * c[b].row(k);
      c[g].row(k) = row / across[0](k, k);
      for (const auto& [a, b] : pairs) y[g].bottomRows(below) -= across[a].col(k).tail(below) * c[b].row(k);
    }
  }
  Directions found;
  for (const Matrix& power : across) found.p.emplace_back(unit.asDiagonal() * (qr.q * power));
  found.inverse = lowerSolved(across[0], turn).cwiseAbs();
  // ρ: what is left, of p pairs n products and as many sums, p (n + 1) + 1 roundings; and what lies beyond the degree.
  const int degree = m.grade(static_cast<int>(powers) - 1);
  Matrices high(at(degree) + 1, Matrix::Zero(n, n)), size(high.size(), Matrix::Zero(n, count));  // by grade
  found.rest = found.most = Matrix::Zero(n, count);
  for (std::size_t g = 0; g < powers; ++g) {
    Matrix rest = generators[g], sizes = rest.cwiseAbs();
    const int begin = m.first()[g], end = m.first()[g + 1], grade = m.grade(static_cast<int>(g));
    for (int pair = begin; pair < end; ++pair) {
      const auto [a, b] = m.pairs()[pair];
      rest -= found.p[a] * c[b];
      sizes += found.p[a].cwiseAbs() * c[b].cwiseAbs();
    }
    found.rest += rest.cwiseAbs() + (static_cast<double>((end - begin) * (n + 1)) + 1) * bounds::unit * sizes;
    found.most += c[g].cwiseAbs();
    size[grade] += c[g].cwiseAbs();
    for (int q = 0; q <= grade; ++q) high[q] += found.p[g].cwiseAbs();
    Work::count(Work::matrixTerm, static_cast<double>(3 * (end - begin) * n * rest.size()));
  }
  for (int q = 1; q <= degree; ++q) found.rest += high[degree - q + 1] * size[q];
  return found;
}

/// Of each generator, in a sum of boxes.
std::vector<std::pair<double, std::size_t>> lossesOf(const Matrix& extent, const Vector& unit) {
  std::vector<std::pair<double, std::size_t>> losses;
  for (Eigen::Index j = 0; j < extent.cols(); ++j) {
    const Vector size = extent.col(j).cwiseQuotient(unit);
    losses.emplace_back(size.sum() - size.maxCoeff(), at(j));
  }
  return losses;
}

/// Those that lose least.
std::vector<char> least(std::vector<std::pair<double, std::size_t>> losses, std::size_t count) {
  for (auto& [loss, generator] : losses)
    if (std::isnan(loss)) loss = std::numeric_limits<double>::infinity();
  std::ranges::nth_element(losses, losses.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<char> isLeast(losses.size(), 0);
  for (std::size_t k = 0; k < count; ++k) isLeast[losses[k].second] = 1;
  return isLeast;
}

/// Without those that are merged, with `sums` of them, as the oldest, and diag(box).
void replace(FlowSet& set, const Matrices& generators, const std::vector<char>& isMerged, const Matrices& sums,
             const Vector& box) {
  std::vector<double> kept;
  kept.reserve(set.generators.size());
  for (std::size_t g = 0; g < generators.size(); ++g) {
    if (!sums.empty()) kept.insert(kept.end(), sums[g].data(), sums[g].data() + sums[g].size());
    for (std::size_t j = 0; j < isMerged.size(); ++j)
      if (isMerged[j] == 0)
        for (const double value : generators[g].col(static_cast<Eigen::Index>(j))) kept.push_back(value);
  }
  set.generators = std::move(kept);
  std::vector<double> size;
  for (const double value : box) size.push_back(value * bounds::up + bounds::tiny);
  appendBox(set, size);
}

}  // namespace

/// What a generator loses in a sum of boxes is Σ_i |Γ_i| - max_i |Γ_i| in balanced units (Girard 2005): those that lose
/// least become a box. Where that has much of what all generators have along some direction, as in a motion that
/// shears, where what is short across grows, the loss is taken along directions instead, each measured by what all have
/// of it.
void mergeGenerators(FlowSet& set, const Monomials& monomials, std::size_t most) {
  const auto n = static_cast<Eigen::Index>(set.R.size());
  const std::size_t block = set.generators.size() / set.powers, count = block / at(n);
  if (count <= most || most < at(n)) return;
  const auto columns = static_cast<Eigen::Index>(count);
  Matrices generators;
  Matrix extent = Matrix::Zero(n, columns);  // Σ_α |Γ_α|
  for (std::size_t g = 0; g < set.powers; ++g) {
    generators.emplace_back(Eigen::Map<const Matrix>(set.generators.data() + g * block, n, columns));
    extent += generators.back().cwiseAbs();
  }
  if (!extent.allFinite()) return;  // the next step fails
  Vector unit = Vector::Ones(n);
  for (Eigen::Index i = 0; i < n && !set.units.empty(); ++i) unit(i) = std::ldexp(1.0, set.units[i]);

  const std::vector<char> isMerged = least(lossesOf(extent, unit), count - most + at(n));
  Vector box = Vector::Zero(n);
  for (Eigen::Index j = 0; j < columns; ++j)
    if (isMerged[j] != 0) box += extent.col(j);

  // Of a motion that damps, what is little is what is old.
  const auto old = std::count(isMerged.begin(), isMerged.begin() + static_cast<std::ptrdiff_t>(count / 2), 1);
  if (2 * at(old) > count - most + at(n) || most < 2 * at(n)) return replace(set, generators, isMerged, {}, box);

  const Directions directions = directionsOf(generators, monomials, unit);
  if (!directions.most.allFinite() || !directions.rest.allFinite())  // fewer directions than states
    return replace(set, generators, isMerged, {}, box);
  const Vector whole = directions.most.rowwise().sum();
  std::vector<std::pair<double, std::size_t>> losses;
  for (Eigen::Index j = 0; j < columns; ++j) {
    const Vector own = directions.most.col(j).cwiseQuotient(whole);
    const double rest = (directions.inverse * directions.rest.col(j)).cwiseQuotient(whole).sum();
    losses.emplace_back(own.sum() - own.maxCoeff() + rest, at(j));
  }
  const std::vector<char> isAlong = least(std::move(losses), count - most + 2 * at(n));
  Vector along = Vector::Zero(n), rest = along, apart = along;
  for (Eigen::Index j = 0; j < columns; ++j) {
    if (isAlong[j] == 0) {
      apart += extent.col(j);
      continue;
    }
    along += directions.most.col(j);
    rest += directions.rest.col(j);
  }
  // Σ_j c_kj(ξ) P_k s_j = Σ_jα |c_kjα| P_k s with |s| ≤ 1; the rounding of that product goes into the box.
  Matrices sums;
  for (const Matrix& power : directions.p) {
    sums.emplace_back(power * (along * bounds::up).asDiagonal());
    apart += sums.back().cwiseAbs().rowwise().sum();
    rest += bounds::unit * sums.back().cwiseAbs().rowwise().sum();
  }
  // Where what depends on ξ is more than what does not, a quotient of the two is no short series: then it is boxes.
  const auto size = [&](const Vector& of) { return of.cwiseQuotient(unit).sum(); };
  if (!(size(apart + rest) <= mostGrown * size(extent.rowwise().sum())))
    return replace(set, generators, isMerged, {}, box);
  replace(set, generators, isAlong, sums, rest);
}

}  // namespace gamut
