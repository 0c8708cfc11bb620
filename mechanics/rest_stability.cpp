#include "mechanics/rest_stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "scalars/algebra/decompositions.hpp"
#include "scalars/algebra/verified_algebra.hpp"
#include "scalars/eigen.hpp"

namespace gamut {
namespace {

using Matrix = Eigen::MatrixXd;
using Intervals = Eigen::Matrix<Interval, Eigen::Dynamic, Eigen::Dynamic>;

Intervals matrixOf(const std::vector<Interval>& entries, int rows, int columns) {
  using RowByRow = Eigen::Matrix<Interval, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowByRow>(entries.data(), rows, columns);
}

std::vector<Interval> entriesOf(const Intervals& m) {
  std::vector<Interval> entries;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) entries.push_back(m(i, j));
  return entries;
}

Intervals exactly(const Matrix& m) {
  return m.unaryExpr([](double x) { return Interval(x); });
}

Matrix middleOf(const Intervals& m) {
  return m.unaryExpr([](const Interval& x) { return midpoint(x); });
}

bool areBounded(const std::vector<Interval>& all) {
  return std::ranges::all_of(all, [](const Interval& x) { return isBounded(x); });
}

bool areAtLeast0(const std::vector<Interval>& all) {
  return std::ranges::all_of(all, [](const Interval& x) { return isBounded(x) && x.lower() >= 0; });
}

/// Of what there is so much of, in all.
bool isNear(const Interval& one, const Interval& other, double size) {
  constexpr double least = 1e-60;
  const double off = NearRest::rounding * size + least;
  return isSubset(other, one + Interval(-off, off));
}

bool isZero(const Interval& x) { return isEqual(x, Interval(0.0)); }

/// Whether a symmetric matrix has no eigenvalue below 0 (above 0 alone: `strictly`) for all values: by its pivots, of
/// which those that stand alone in row and column may be 0.
bool isPositive(Intervals m, bool strictly) {
  const Eigen::Index n = m.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    bool isAlone = !strictly && m(k, k).lower() >= 0;
    for (Eigen::Index j = k + 1; j < n; ++j) isAlone = isAlone && isZero(m(k, j));
    if (isAlone) continue;
    if (!(m(k, k).lower() > 0)) return false;
    for (Eigen::Index i = k + 1; i < n; ++i)
      for (Eigen::Index j = i; j < n; ++j) {
        m(i, j) -= i == j ? sqr(m(k, i)) / m(k, k) : m(k, i) * m(k, j) / m(k, k);
        m(j, i) = m(i, j);
      }
  }
  return true;
}

/// P ẏ = Q y, in units in which M and the greatest of K are about 1.
struct FirstOrder {
  Intervals p, q;

  FirstOrder(const Intervals& stiffness, const Intervals& damping, const Intervals& mass) {
    const Eigen::Index n = mass.rows();
    Eigen::VectorXd unit(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double inertia = std::abs(midpoint(mass(i, i)));
      unit[i] = inertia > 0 ? std::exp2(-std::round(0.5 * std::log2(inertia))) : 1.0;
    }
    double most = 0;
    for (Eigen::Index i = 0; i < n; ++i) most = std::max(most, std::abs(midpoint(stiffness(i, i))) * unit[i] * unit[i]);
    const Interval second(most > 0 ? std::exp2(-std::round(0.5 * std::log2(most))) : 1.0);
    p = q = Intervals::Constant(2 * n, 2 * n, Interval(0.0));
    for (Eigen::Index i = 0; i < n; ++i) {
      p(i, i) = q(i, n + i) = Interval(1.0);
      for (Eigen::Index j = 0; j < n; ++j) {
        const Interval both = Interval(unit[i]) * Interval(unit[j]);
        p(n + i, n + j) = mass(i, j) * both;
        q(n + i, n + j) = -damping(i, j) * both * second;
        q(n + i, j) = -stiffness(i, j) * both * sqr(second);
      }
    }
  }
};

/// X = Σ ∓ w w̄ᵀ, w the eigenvectors from the left of what has real parts ±; symmetric to the last bit.
std::optional<Matrix> lyapunovOf(const FirstOrder& motion) {
  const Matrix p = middleOf(motion.p);
  if (!isInvertible(p)) return {};
  const Matrix a = middleOf(motion.q) * inverseOf(p);  // of z = P y
  const std::optional<EigenPairs> pairs = eigenPairsOf(a.transpose());
  if (!pairs) return {};
  const Eigen::MatrixXcd& w = pairs->vectors;
  Matrix x = Matrix::Zero(a.rows(), a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    x -= (pairs->values[i].real() < 0 ? -1.0 : 1.0) * (w.col(i) * w.col(i).adjoint()).real();
  if (!x.array().isFinite().all()) return {};
  return Matrix(x.selfadjointView<Eigen::Lower>());
}

/// Of which X tells, if it tells anything.
RestStability byLyapunov(const FirstOrder& motion) {
  using enum RestStability;
  const std::optional<Matrix> x = lyapunovOf(motion);
  if (!x) return unknown;
  const Intervals product = motion.p.transpose() * (exactly(*x) * motion.q);
  if (!isPositive(-(product + product.transpose()), true)) return unknown;
  const std::optional<int> rising = negativeEigenvalues(entriesOf(exactly(*x)), static_cast<int>(x->rows()));
  return !rising ? unknown : *rising == 0 ? stable : unstable;
}

}  // namespace

NearRest NearRest::of(int coordinates, const std::vector<Interval>& matrices) {
  const auto begin = matrices.begin();
  const std::ptrdiff_t square = static_cast<std::ptrdiff_t>(coordinates) * coordinates;
  return {coordinates,
          {begin, begin + square},
          {begin + square, begin + 2 * square},
          {begin + 2 * square, begin + 3 * square},
          {begin + 3 * square, matrices.end()}};
}

Resistances Resistances::of(int coordinates, int resistances, int masses, const std::vector<Interval>& all) {
  const auto second = all.begin() + resistances, third = second + masses;
  return {coordinates, {all.begin(), second}, {second, third}, {third, all.end()}};
}

bool Resistances::areMassesPositive() const { return areAtLeast0(masses); }

bool Resistances::isSymmetric() const {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (i == j ? !isBounded(others[i * n + j]) : !isZero(others[i * n + j])) return false;
  return areBounded(coefficients);
}

bool Resistances::takesEnergy() const {
  if (!areAtLeast0(coefficients) || !areBounded(others)) return false;
  const Intervals r = matrixOf(others, n, n);
  return isPositive(Interval(0.5) * (r + r.transpose()), false);
}

double NearRest::sizeOfStiffness(int i, int j) const {
  const auto size = [this](int row, int column) { return magnitude(stiffness[row * n + column]); };
  return std::max({size(i, j), size(j, i), std::sqrt(size(i, i)) * std::sqrt(size(j, j))});
}

bool NearRest::hasPotential() const {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j)
      if (!(magnitude(stiffness[i * n + j] - stiffness[j * n + i]) <= rounding * sizeOfStiffness(i, j))) return false;
  return true;
}

bool NearRest::isSmooth(const NearRest& about) const {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (!isNear(stiffness[i * n + j], about.stiffness[i * n + j], sizeOfStiffness(i, j))) return false;
  return true;
}

bool Resistances::isSmooth(const Resistances& about) const {
  const auto areNear = [](const std::vector<Interval>& one, const std::vector<Interval>& other) {
    return std::ranges::equal(one, other,
                              [](const Interval& x, const Interval& y) { return isNear(x, y, magnitude(x)); });
  };
  return areNear(coefficients, about.coefficients) && areNear(others, about.others);
}

std::optional<NearRest> NearRest::reduced() const {
  const int loops = static_cast<int>(held.size()) / std::max(n, 1), f = n - loops;
  if (loops == 0) return *this;
  if (!areBounded(held)) return {};
  const Intervals g = matrixOf(held, loops, n);
  const Eigen::VectorXi order = columnOrderOf(middleOf(g));  // those that are solved for first
  Intervals solvedFor(loops, loops), others(loops, f);
  for (int j = 0; j < loops; ++j) solvedFor.col(j) = g.col(order[j]);
  for (int j = 0; j < f; ++j) others.col(j) = -g.col(order[loops + j]);
  const Verified<Intervals> solved = verifiedSolve(solvedFor, others);
  if (!solved) return {};
  Intervals tangents = Intervals::Constant(n, f, Interval(0.0));
  for (int j = 0; j < loops; ++j) tangents.row(order[j]) = solved->row(j);
  for (int j = 0; j < f; ++j) tangents(order[loops + j], j) = Interval(1.0);
  const auto along = [&](const std::vector<Interval>& m) {
    return entriesOf(tangents.transpose() * (matrixOf(m, n, n) * tangents));
  };
  return NearRest{f, along(stiffness), along(damping), along(mass), {}};
}

RestStability stabilityOf(const NearRest& reduced, int negatives) {
  using enum RestStability;
  const int n = reduced.n;
  const RestStability byStiffness = negatives == 0 ? stable : unstable;
  if (std::ranges::all_of(reduced.damping, [](const Interval& x) { return isZero(x); })) return byStiffness;
  for (const auto* matrix : {&reduced.stiffness, &reduced.damping, &reduced.mass})
    if (!areBounded(*matrix)) return unknown;
  const Intervals c = matrixOf(reduced.damping, n, n);
  if (isPositive(Interval(0.5) * (c + c.transpose()), negatives > 0)) return byStiffness;
  if (negatives % 2 == 1) return unstable;
  const Intervals mass = matrixOf(reduced.mass, n, n);
  const Verified<Intervals> decays = verifiedSolve(mass, c);
  if (decays && decays->trace().upper() < 0) return unstable;
  return byLyapunov(FirstOrder(matrixOf(reduced.stiffness, n, n), c, mass));
}

RestStability stabilityOf(const Resistances& of, int negatives) {
  using enum RestStability;
  if (!of.areMassesPositive()) return unknown;
  if (negatives == 0) return of.takesEnergy() ? stable : unknown;
  return of.isSymmetric() ? unstable : unknown;
}

std::optional<int> negativeEigenvalues(const std::vector<Interval>& k, int n) {
  Matrix middle(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (isEmpty(intersection(k[i * n + j], k[j * n + i])) || !isBounded(k[i * n + j])) return {};  // no potential
      middle(i, j) = midpoint(k[i * n + j]);
    }
  Eigen::VectorXd scale =
      middle.diagonal().cwiseAbs().unaryExpr([](double x) { return x > 0 ? 1 / std::sqrt(x) : 0.0; });
  for (int j = 0; j < n; ++j)
    if (scale[j] == 0) {
      const double most = (middle.col(j).cwiseAbs().array() * scale.array()).maxCoeff();
      scale[j] = most > 0 ? 1 / most : 1.0;
    }
  const Matrix scaled = scale.asDiagonal() * Matrix(0.5 * (middle + middle.transpose())) * scale.asDiagonal();
  const Matrix t = scale.asDiagonal() * symmetricEigenvectorsOf(scaled);
  int negatives = 0;
  for (int a = 0; a < n; ++a) {
    Interval disc(0.0);
    for (int b = 0; b < n; ++b) {
      Interval sum(0.0);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          sum += Interval(t(i, a)) * intersection(k[i * n + j], k[j * n + i]) * Interval(t(j, b));
      disc += a == b ? sum : Interval(-1.0, 1.0) * sum;
    }
    if (contains(disc, 0.0)) return {};
    negatives += disc.upper() < 0 ? 1 : 0;
  }
  return negatives;
}

}  // namespace gamut
