// Rewriting a set: other degrees, symbols for its remainder.
#include "analyses/flow/step/set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "analyses/flow/series/column_kernels.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

void appendBox(FlowSet& set, const std::vector<double>& size) {
  const std::size_t n = size.size(), before = set.generators.size() / set.powers, behind = before + n * n;
  set.generators.resize(set.powers * behind);
  Work::count(Work::columnTerm, static_cast<double>(3 * set.generators.size()));
  for (std::size_t g = set.powers; g-- > 0;) {  // in place, the last first
    const auto from = set.generators.begin() + static_cast<std::ptrdiff_t>(g * before),
               to = set.generators.begin() + static_cast<std::ptrdiff_t>(g * behind);
    if (g > 0)
      std::copy_backward(from, from + static_cast<std::ptrdiff_t>(before), to + static_cast<std::ptrdiff_t>(before));
    std::fill_n(to + static_cast<std::ptrdiff_t>(before), n * n, 0.0);
  }
  for (std::size_t i = 0; i < n; ++i) set.generators[before + i * n + i] = size[i];
}

void addColumnSizes(const std::vector<double>& columns, std::vector<double>& total) {
  const auto n = static_cast<int>(total.size());
  kernels::addColumnSizes(columns.data(), n, static_cast<int>(columns.size()) / n, total.data());
}

void errorRadius(const FlowSet& set, std::vector<double>& total) {
  total = set.R;
  addColumnSizes(set.generators, total);
  for (double& value : total) value *= bounds::up;
}

void totalRadius(const FlowSet& set, std::vector<double>& total) {
  errorRadius(set, total);
  addColumnSizes(set.inputs, total);
  for (const std::vector<double>& columns : set.inputsOfXi) addColumnSizes(columns, total);
  for (double& value : total) value *= bounds::up;
}

void mergeInputs(FlowSet& set, std::size_t count, std::size_t most) {
  if (set.inputs.size() * (1 + set.inputsOfXi.size()) <= most) return;
  const std::size_t n = set.R.size(), part = count * n, pairs = set.inputs.size() / (4 * part);
  std::vector<double> apart(n, 0.0);
  const auto merge = [&](std::vector<double>& columns) {
    std::vector<double> merged;
    for (std::size_t pair = 0; pair < pairs; ++pair)
      for (std::size_t i = 0; i < part; ++i) {
        const double a = columns[2 * pair * part + i], b = columns[(2 * pair + 1) * part + i];
        merged.push_back(a + b);
        apart[i % n] += (std::fabs(a - b) + bounds::unit * std::fabs(a + b)) * bounds::up;  // and the sum's rounding
      }
    merged.insert(merged.end(), columns.begin() + static_cast<std::ptrdiff_t>(2 * pairs * part), columns.end());
    columns = std::move(merged);
  };
  merge(set.inputs);
  for (std::vector<double>& columns : set.inputsOfXi) merge(columns);
  for (double& size : apart) size *= bounds::up;
  appendBox(set, apart);
}

double remainderOf(const FlowSet& set, int state, const std::vector<double>& total) {
  const std::size_t n = total.size(), i = at(state);
  double remainder = set.W[i];
  for (std::size_t j = 0; j < n; ++j) remainder += std::fabs(set.C[i * n + j]) * total[j];
  return remainder;
}

double orthogonalityDefect(const Eigen::MatrixXd& Q) {
  if (!Q.allFinite()) return std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd defect = Q.transpose() * Q - Eigen::MatrixXd::Identity(Q.cols(), Q.cols());
  // A row of defects, and n + 2 roundings in each of its n entries, where Σ|q||q| < 2.
  const auto n = static_cast<double>(Q.cols());
  return ((defect.cwiseAbs() * Eigen::VectorXd::Ones(Q.cols())).maxCoeff() + n * 2 * (n + 2) * bounds::unit) *
         bounds::up;
}

double relativeMass(const FlowSet& set, const Monomials& monomials, int above, int below) {
  const std::size_t N = at(monomials.count()), n = set.p.size() / N;
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double mass = 0, all = 0;
    for (std::size_t g = 0; g < N; ++g) {
      const double size = std::fabs(set.p[i * N + g]);
      const int grade = monomials.grade(static_cast<int>(g));
      all += size;
      if (grade > above && grade <= below) mass += size;
    }
    if (all > 0) largest = std::max(largest, mass / all);
  }
  return largest;
}

namespace {

/// In other monomials; what does not fit is an error.
void changeMonomials(BoundedPolynomial& polynomial, const Monomials& from, const Monomials& to) {
  if (polynomial.c.empty()) return;
  BoundedPolynomial result{std::vector<double>(to.count(), 0.0), polynomial.error};
  for (std::size_t g = 0; g < polynomial.c.size(); ++g)
    if (const int number = to.find(from, static_cast<int>(g)); number >= 0)
      result.c[number] = polynomial.c[g];
    else
      result.error += std::fabs(polynomial.c[g]);
  result.error *= bounds::up;
  polynomial = std::move(result);
}

}  // namespace

void changeDegree(FlowSet& set, const Monomials& from, const Monomials& to, int frameDegree) {
  const std::size_t n = set.R.size(), N = at(from.count()), newN = at(to.count());
  const std::size_t powers = at(to.countUpTo(frameDegree)), block = set.generators.size() / set.powers;
  std::vector<double> p(n * newN, 0.0), generators(powers * block, 0.0), dropped(n, 0.0), lost(n, 0.0);
  for (std::size_t g = 0; g < N; ++g) {
    const int number = to.find(from, static_cast<int>(g));  // weights may differ as well, so that grades do
    for (std::size_t i = 0; i < n; ++i) {
      const double coefficient = set.p[i * N + g];
      if (number >= 0)
        p[i * newN + at(number)] = coefficient;
      else
        dropped[i] += std::fabs(coefficient);
    }
    if (g >= set.powers) continue;
    const auto columns = set.generators.begin() + static_cast<std::ptrdiff_t>(g * block);
    if (number >= 0 && at(number) < powers)
      std::copy_n(columns, block, generators.begin() + static_cast<std::ptrdiff_t>(at(number) * block));
    else
      addColumnSizes({columns, columns + static_cast<std::ptrdiff_t>(block)}, lost);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) dropped[i] += std::fabs(set.C[i * n + j]) * lost[j];
    if (!set.low.empty()) dropped[i] += std::fabs(set.low[i]);
  }
  set.low.clear();
  for (std::size_t i = 0; i < n; ++i)
    if (!(dropped[i] == 0)) set.W[i] = (set.W[i] + dropped[i]) * bounds::up + bounds::tiny;
  changeMonomials(set.ahead, from, to);
  set.p = std::move(p);
  set.powers = powers;
  set.generators = std::move(generators);
}

namespace {

/// Principal axes of C (r + Γs), columns, and half-widths along them, in units of the states.
struct PrincipalAxes {
  Eigen::MatrixXd axes;
  Eigen::VectorXd half, unit;
};

std::optional<PrincipalAxes> principalAxesOf(const FlowSet& set) {
  using Matrix = Eigen::MatrixXd;
  const int n = static_cast<int>(set.R.size());
  std::vector<double> total;
  totalRadius(set, total);
  // H: the directions of C (r + Γs), of every power of ξ by themselves; its entries are off by n roundings, at most n u
  // |C| Σ|Γ|.
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> C(set.C.data(), n, n);
  const Eigen::Map<const Eigen::VectorXd> R(set.R.data(), n), radius(total.data(), n);
  const Eigen::Map<const Matrix> generators(set.generators.data(), n, static_cast<int>(set.generators.size()) / n);
  // In the units of the last step, powers of two: principal axes mean something there.
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(n);
  for (std::size_t i = 0; i < set.units.size(); ++i) unit(static_cast<int>(i)) = std::ldexp(1.0, set.units[i]);
  const Eigen::VectorXd inverse = unit.cwiseInverse();
  Matrix H(n, n + generators.cols());
  H.leftCols(n) = inverse.asDiagonal() * (C * R.asDiagonal());
  H.rightCols(generators.cols()) = inverse.asDiagonal() * (C * generators);
  const Eigen::VectorXd rounding = inverse.asDiagonal() * ((n + 1) * bounds::unit * (C.cwiseAbs() * radius));
  const Matrix U = symmetricEigenvectorsOf(H * H.transpose());
  const double phi = orthogonalityDefect(U);
  if (!(phi < 0.5)) return std::nullopt;
  // |U⁻¹H_j s_j| summed: the half-widths along the axes; the product UᵀH has n roundings an entry.
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(H.cols());
  Eigen::VectorXd half = (U.transpose() * H).cwiseAbs() * ones +
                         (n + 1) * bounds::unit * (U.cwiseAbs().transpose() * (H.cwiseAbs() * ones)) +
                         U.cwiseAbs().transpose() * rounding;
  half.array() += phi / (1 - phi) * half.maxCoeff();
  half *= bounds::up;
  return PrincipalAxes{U, half, unit};
}

/// Inputs as they are in the axes of the states, C the identity: C Γ, n roundings an entry.
void reframe(FlowSet& set, const Eigen::MatrixXd& C, std::vector<double>& columns) {
  const int n = static_cast<int>(set.R.size());
  const Eigen::Map<const Eigen::MatrixXd> before(columns.data(), n, static_cast<int>(columns.size()) / n);
  const Eigen::MatrixXd driven = C * before;
  const Eigen::VectorXd rounded =
      (n + 1) * bounds::unit * (C.cwiseAbs() * (before.cwiseAbs() * Eigen::VectorXd::Ones(before.cols())));
  for (int i = 0; i < n; ++i) set.W[i] = (set.W[i] + rounded(i)) * bounds::up;
  columns.assign(driven.data(), driven.data() + driven.size());
}

}  // namespace

bool expandRemainder(FlowSet& set, const Monomials& from, const Monomials& to, int frameDegree) {
  const int n = static_cast<int>(set.R.size()), N = from.count(), newN = to.count();
  const std::optional<PrincipalAxes> principal = principalAxesOf(set);
  if (!principal) return false;
  std::vector<double> p(n * newN, 0.0);
  for (int i = 0; i < n; ++i) {
    double dropped = 0;
    for (int g = 0; g < N; ++g)
      if (const int number = to.find(from, g); number >= 0)
        p[i * newN + number] = set.p[i * N + g];
      else
        dropped += std::fabs(set.p[i * N + g]);
    if (!set.low.empty()) dropped += std::fabs(set.low[i]);
    set.W[i] += dropped;
  }
  set.low.clear();
  for (int i = 0; i < n; ++i) {
    double rounded = 0;
    for (int j = 0; j < n; ++j) {
      const double coefficient = principal->axes(i, j) * principal->half(j) * principal->unit(i);  // one rounding
      p[i * newN + to.linear(from.symbols() + j)] = coefficient;
      rounded += bounds::unit * std::fabs(coefficient);
    }
    set.W[i] = (set.W[i] + rounded) * bounds::up + bounds::tiny;
  }
  changeMonomials(set.ahead, from, to);
  set.p = std::move(p);
  const Eigen::MatrixXd C =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(set.C.data(), n, n);
  reframe(set, C, set.inputs);
  for (std::vector<double>& columns : set.inputsOfXi) reframe(set, C, columns);
  set.C.assign(n * n, 0.0);
  for (int i = 0; i < n; ++i) set.C[i * n + i] = 1;
  set.R.assign(n, 0.0);
  set.generators.clear();
  set.powers = at(to.countUpTo(frameDegree));
  return true;
}

}  // namespace gamut
