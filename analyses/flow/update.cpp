// A certified step at any of its times, between two of them, and the set at its end. Derivations: docs/flow.md,
// sections 3 and 5.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "analyses/flow/embedding.hpp"
#include "analyses/flow/error_bounds.hpp"
#include "analyses/flow/step.hpp"
#include "scalars/elementary/double_double.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double dumpedAt = 0.2;  // a frame column with more ξ-dependence than this goes back to a constant one
/// Steps whose errors are kept apart; older ones merge into the box R. What it costs grows as the rest of a step does,
/// so that long motions of many states, which lose most by merging, keep more.
int stepsKept(int n) { return std::clamp(40 * n, 60, 300); }

/// As many where inputs are at work, whose rests are no roundings and would wrap: `perStep` numbers each.
Eigen::Index stepsBesideInputs(Eigen::Index perStep) { return std::max<Eigen::Index>(2000, 500000 / perStep); }
/// Of the generators of inputs, before pairs of them are merged.
constexpr std::size_t mostInputNumbers = 1000000;

/// So many symbols' corners are looked at: beyond, the sum of all.
constexpr std::size_t mostCorners = 5;

/// Generators, n numbers each, as the columns of a matrix.
template <class Generators>
auto columnsOf(Generators& generators, int n) {
  using Matrix = std::conditional_t<std::is_const_v<Generators>, const Eigen::MatrixXd, Eigen::MatrixXd>;
  return Eigen::Map<Matrix>(generators.data(), n, static_cast<Eigen::Index>(generators.size()) / n);
}

/// Ψ_g of the point.
auto frameOf(const FlowPoint& point, int g) {
  const auto n = static_cast<Eigen::Index>(point.loose.size());
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(point.psi.data() + g * n * n, n, n);
}

}  // namespace

void FlowStepper::evaluate(const FlowSet& set, double tau, FlowPoint& point, bool narrowed) {
  const int N = series_.count(), NJ = series_.frameCount(), stride = series_.stride();
  const double sigma = tau / h0_;
  const bool crosses = tau != 0 && narrowed && !crossings_.empty();
  point.p.assign(at(n_ * N), 0.0);
  point.psi.assign(at(NJ * n_ * n_), 0.0);
  point.psiSum.assign(at(n_ * n_), 0.0);
  point.loose.assign(at(n_), 0.0);
  point.radius.assign(at(n_), 0.0);
  // Horner's scheme with its running error: fl(fl(sσ) + c) is off by u|fl(sσ)| + u|result|, times the σ's that follow.
  const auto horner = [&](const double* c, double& error) {
    double s = c[m_], e = 0;
    for (int i = m_ - 1; i >= 0; --i) {
      const double product = s * sigma;
      s = product + c[i];
      e = e * sigma + bounds::unit * (std::fabs(product) + std::fabs(s));
    }
    error += sigma == 0 ? 0.0 : e * bounds::up + bounds::tiny;
    return s;
  };
  // Likewise with second doubles: (s + low)σ + c + l errs by less than 16u² of both.
  const auto fineHorner = [&](int state, double& low, double& error) {
    const double* c = series_.series(state);
    detail::DoubleDouble s{c[m_], 0};
    double e = 0;
    for (int i = m_ - 1; i >= 0; --i) {
      detail::DoubleDouble product = detail::exactProduct<false>(s.hi, sigma);
      product = detail::exactSum(product.hi, product.lo + s.lo * sigma);
      s = detail::exactSum(product.hi, c[i]);
      s = detail::exactSum(s.hi, s.lo + (product.lo + series_.low(state, i)));
      e = e * sigma + bounds::fine * (std::fabs(product.hi) + std::fabs(c[i]));
    }
    error += sigma == 0 ? 0.0 : e * bounds::up + bounds::tiny;
    low = s.lo;
    return s.hi;
  };
  point.low.assign(at(n_), 0.0);
  point.known.assign(at(n_), 0.0);
  for (int i = 0; i < n_; ++i) {
    double error = 0;
    if (series_.isFine())
      point.p[at(i)] = fineHorner(i, point.low[at(i)], error);
    else
      for (int g = 0; g < N; ++g) point.p[at(i * N + g)] = horner(series_.series(i) + g * stride, error);
    point.loose[at(i)] = tau == 0 ? set.W[at(i)] : error + (crosses ? crossed_ : e1_)[at(i)];  // the start is known
  }
  point.total = total_;
  for (int j = 0; j < n_ && tau != 0; ++j) point.total[at(j)] = (total_[at(j)] + inputs_.total(j)) * bounds::up;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      double error = 0;
      const double* psi = series_.frame(i, j);
      for (int g = 0; g < NJ; ++g) point.psi[at((g * n_ + i) * n_ + j)] = horner(psi + g * stride, error);
      if (tau != 0) point.loose[at(i)] += (error + epsilon_[at(i * n_ + j)]) * point.total[at(j)];
    }
  if (crosses) addCrossings(set, tau, point);
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      double sum = 0;
      for (int g = 0; g < NJ; ++g) sum += std::fabs(point.psi[at((g * n_ + i) * n_ + j)]);
      point.psiSum[at(i * n_ + j)] = sum * bounds::up;
      // Ψ_0 r by the box R; Ψ_0 Γ s below; the higher Ψ_α by the whole radius.
      const double leading = std::fabs(point.psi[at(i * n_ + j)]);
      point.radius[at(i)] +=
          leading * set.R[at(j)] + (sum * bounds::up - leading * bounds::down) * (NJ > 1 ? errors_[at(j)] : 0.0);
    }
  // Ψ_0 Γ: n roundings an entry, together at most n u |Ψ_0| Σ|Γ_j|. Of inputs n + 1 in what is linear in ξ, and one
  // more for each symbol in drivenRadius, which sums with signs: n + 1 + mostCorners ≤ 2n + 8.
  const std::size_t n = set.R.size();
  const std::vector<double>& fresh = inputs_.generators();
  const auto begun = static_cast<std::ptrdiff_t>(tau == 0 ? 0 : inputs_.begunBefore(tau / h_));
  std::vector<double> columns = set.generators;
  columns.insert(columns.end(), set.inputs.begin(), set.inputs.end());
  columns.insert(columns.end(), fresh.begin(), fresh.begin() + begun);
  point.zonotope.resize(columns.size());
  point.ofErrors = set.generators.size();
  point.ofR = errors_;
  Eigen::Map<Eigen::MatrixXd> zonotope = columnsOf(point.zonotope, n_);
  zonotope.noalias() = frameOf(point, 0) * columnsOf(columns, n_);
  Eigen::Map<Eigen::VectorXd>(point.radius.data(), n_) +=
      zonotope.leftCols(static_cast<Eigen::Index>(point.ofErrors / n)).cwiseAbs().rowwise().sum();
  evaluateInputs(set, columns, point);
  for (std::size_t i = 0; i < n; ++i) {
    double size = 0;
    for (std::size_t k = 0; k < n; ++k) size += point.psiSum[i * n + k] * point.total[k];
    point.loose[i] = (point.loose[i] + (2 * n_ + 8) * bounds::unit * size) * bounds::up;
    point.radius[i] =
        (point.radius[i] + point.driven[i] + point.beyond[i] + point.loose[i]) * bounds::up + bounds::tiny;
  }
  if (tau != 0 && narrowed) narrowArguments(set, tau, point);
}

/// What inputs did: (Ψ_0 + Σ_l Ψ_l ξ_l) (Γ + Σ_l Γ_l ξ_l) to the first order in ξ; the rest goes `beyond`.
void FlowStepper::evaluateInputs(const FlowSet& set, const std::vector<double>& columns, FlowPoint& point) const {
  const std::size_t n = at(n_), first = point.ofErrors, symbols = set.inputsOfXi.size();
  point.driven.assign(n, 0.0);
  point.beyond.assign(n, 0.0);
  point.drivenOfXi.assign(symbols, std::vector<double>(columns.size() - first, 0.0));
  if (columns.size() == first) return;
  const Eigen::Map<const Eigen::MatrixXd> own(columns.data() + first, n_,
                                              static_cast<Eigen::Index>((columns.size() - first) / n));
  std::vector<double> plain(n, 0.0), ofXi(n, 0.0);
  addColumns({columns.begin() + static_cast<std::ptrdiff_t>(first), columns.end()}, plain);
  Eigen::MatrixXd all(n_, n_);  // Σ_{α≠0} |Ψ_α|
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j)
      all(i, j) = point.psiSum[at(i * n_ + j)] - std::fabs(point.psi[at(i * n_ + j)]) * bounds::down;
  Eigen::MatrixXd higher = all;  // without those taken below
  for (std::size_t l = 0; l < symbols; ++l) {
    const int g = monomials().linear(static_cast<int>(l));
    addColumns(set.inputsOfXi[l], ofXi);
    Eigen::Map<Eigen::MatrixXd> linear = columnsOf(point.drivenOfXi[l], n_);
    const auto before = columnsOf(set.inputsOfXi[l], n_);
    linear.leftCols(before.cols()).noalias() = frameOf(point, 0) * before;
    if (g < 0 || g >= series_.frameCount()) continue;
    linear.noalias() += frameOf(point, g) * own;
    higher -= frameOf(point, g).cwiseAbs() * bounds::down;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      point.beyond[i] += std::max(0.0, higher(row, column)) * plain[j] + all(row, column) * ofXi[j];
    }
    point.beyond[i] *= bounds::up;
    point.driven[i] = drivenRadius(point.zonotope, point.drivenOfXi, first + i, n) * bounds::up;
  }
}

double drivenRadius(const std::vector<double>& a, const std::vector<std::vector<double>>& b, std::size_t first,
                    std::size_t stride) {
  const bool byCorners = b.size() <= mostCorners;
  double most = 0;
  for (std::size_t corner = 0; corner < (byCorners ? std::size_t{1} << b.size() : 1); ++corner) {
    double sum = 0;
    for (std::size_t c = first, k = first % stride; c < a.size(); c += stride, k += stride) {
      double value = a[c], size = 0;
      for (std::size_t l = 0; l < b.size(); ++l) {
        if (byCorners)
          value += ((corner >> l) & 1) != 0 ? b[l][k] : -b[l][k];
        else
          size += std::fabs(b[l][k]);
      }
      sum += std::fabs(value) + size;
    }
    most = std::max(most, sum);
  }
  return most;
}

double FlowStepper::looseBound(int i) const {
  double loose = e1_[at(i)] + driven_[at(i)];
  for (int j = 0; j < n_; ++j) loose += epsilon_[at(i * n_ + j)] * (total_[at(j)] + inputs_.total(j));
  loose += series_.lowNorm(i);
  return loose * bounds::up;
}

void FlowStepper::boundDerivatives() {
  for (int i = 0; i < n_; ++i) {
    second_[at(i)] = series_.derivativeNorm(i, 2, theta_);
    third_[at(i)] = series_.derivativeNorm(i, 3, theta_);
    turn_[at(i)] = 0;
    for (int j = 0; j < n_; ++j)
      if (total_[at(j)] > 0) turn_[at(i)] += series_.frameDerivativeNorm(i, j, 2, theta_) * total_[at(j)];
  }
}

void FlowStepper::sag(double from, double to, std::vector<Interval>& bound) const {
  bound.clear();
  for (int i = 0; i < n_; ++i)  // in σ, exactly
    bound.push_back(inflated(series_.sag(i, from / h0_, to / h0_, second_[at(i)], third_[at(i)], turn_[at(i)]),
                             (driven_[at(i)] + inputs_.rest(i)) * bounds::up));
}

void FlowStepper::advance(FlowSet& set) {
  using Matrix = Eigen::MatrixXd;
  evaluate(set, h_, end_);
  const int NJ = series_.frameCount();
  // All of it in balanced units z = D⁻¹x, D a diagonal of powers of two: lengths and angles mean something there.
  std::vector<double> unit(at(n_));
  for (int i = 0; i < n_; ++i) {
    unit[at(i)] = std::ldexp(1.0, growth_.units()[at(i)]);
    end_.loose[at(i)] /= unit[at(i)];
    for (int g = 0; g < NJ; ++g)
      for (int j = 0; j < n_; ++j) end_.psi[at((g * n_ + i) * n_ + j)] /= unit[at(i)];
  }
  const auto psi = [&](int g, int i, int j) { return end_.psi[at((g * n_ + i) * n_ + j)]; };

  // Q, T: QR of the constant part, columns sorted by length × R, so that the longest keeps its direction.
  std::vector<int> order(at(n_));
  std::iota(order.begin(), order.end(), 0);
  const std::vector<double>& all = end_.total;
  const double largestR = *std::max_element(all.begin(), all.end());
  std::vector<double> length(at(n_));
  for (int j = 0; j < n_; ++j) {
    double sum = 0;
    for (int i = 0; i < n_; ++i) sum += psi(0, i, j) * psi(0, i, j);
    length[at(j)] = std::sqrt(sum) * (largestR > 0 ? std::max(all[at(j)], 1e-20 * largestR) : 1.0);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length[at(a)] > length[at(b)]; });
  Matrix psi0(n_, n_);
  for (int j = 0; j < n_; ++j)
    for (int i = 0; i < n_; ++i) psi0(i, j) = psi(0, i, order[at(j)]);
  const Matrix Q = Eigen::HouseholderQR<Matrix>(psi0).householderQ();
  Matrix T = Q.transpose() * psi0;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < i; ++j) T(i, j) = 0;
  const double phi = orthogonalityDefect(Q);
  const double slack =
      phi < 0.5 ? phi / (1 - phi) * bounds::up : std::numeric_limits<double>::infinity();  // then the next step fails

  // C'_α = Ψ_α T⁻¹ for α ≠ 0, in floating point; what it misses is measured below.
  std::vector<Matrix> C(at(NJ), Matrix::Zero(n_, n_));
  C[0] = Q;
  bool invertible = true;
  for (int i = 0; i < n_; ++i) invertible = invertible && std::fabs(T(i, i)) > 1e-14 * std::fabs(T(0, 0));
  std::vector<char> constant(at(n_), static_cast<char>(!invertible));
  std::vector<Matrix> sorted(at(NJ), Matrix(n_, n_));
  for (int g = 0; g < NJ; ++g)
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) sorted[at(g)](i, j) = psi(g, i, order[at(j)]);
  Matrix N = Matrix::Zero(n_, n_);
  if (invertible && NJ > 1) {
    Matrix inverse = Matrix::Identity(n_, n_);
    T.triangularView<Eigen::Upper>().solveInPlace(inverse);
    for (int g = 1; g < NJ; ++g) {
      C[at(g)] = sorted[at(g)] * inverse;
      // N = Σ_{α≠0} |Q⁻¹C'_α|; each product has n roundings.
      N += (Q.transpose() * C[at(g)]).cwiseAbs() +
           (n_ + 1) * bounds::unit * Q.cwiseAbs().transpose() * C[at(g)].cwiseAbs();
    }
    for (int j = 0; j < n_; ++j) {
      const double largest = N.col(j).maxCoeff();
      N.col(j).array() += slack * largest;
      if (!(largest < dumpedAt) || !inputs_.empty()) constant[at(j)] = 1;
    }
    N *= bounds::up;
  }
  const auto makeConstant = [&](int j) {
    for (int g = 1; g < NJ; ++g) C[at(g)].col(j).setZero();
    N.col(j).setZero();
  };
  for (int j = 0; j < n_; ++j)
    if (constant[at(j)]) makeConstant(j);
  // (I - N)⁻¹ exists and is nonnegative when every row sum of N is below one.
  while (!(N.rowwise().sum().maxCoeff() < 0.9)) {
    int worst = 0;
    N.colwise().sum().maxCoeff(&worst);
    if (N.col(worst).maxCoeff() == 0) break;
    makeConstant(worst);
  }

  // C'⁻¹v with v = D(ξ)(r + Γs) + w, D = Σ_α ξ^α (Ψ_α - C'_α T). The part of D goes into the box, with |QᵀD| as the
  // absolute value of the product; w becomes generators Qᵀ diag(|w|), and what ξ adds to them goes into the box.
  // Of inputs what is linear in ξ is kept, so that frames are constant there.
  Eigen::VectorXd w(n_), box = Eigen::VectorXd::Zero(n_), R(n_), total(n_), plain(n_), kept = box;
  std::vector<double> ofInputs(at(n_), 0.0);
  addColumns(set.inputs, ofInputs);
  addColumns(inputs_.generators(), ofInputs);
  std::vector<Matrix> turnOfXi(inputs_.empty() ? 0 : set.half.size());
  for (int i = 0; i < n_; ++i) w(i) = end_.loose[at(i)];
  for (int j = 0; j < n_; ++j) {
    R(j) = set.R[at(order[at(j)])];
    total(j) = all[at(order[at(j)])];
    plain(j) = ofInputs[at(order[at(j)])] * bounds::down;  // no more than its part of the total
  }
  const auto symbolOf = [&](int g) {  // whose first power the monomial is, of those kept
    for (std::size_t l = 0; l < turnOfXi.size() && g > 0; ++l)
      if (monomials().linear(static_cast<int>(l)) == g) return l;
    return turnOfXi.size();
  };
  for (int g = 0; g < NJ; ++g) {
    const Matrix D = sorted[at(g)] - C[at(g)] * T;
    // n products, n sums and the difference: n + 2 roundings at most.
    const Matrix size = sorted[at(g)].cwiseAbs() + C[at(g)].cwiseAbs() * T.cwiseAbs();
    w += (n_ + 2) * bounds::unit * (size * total);
    const Matrix turnedD = Q.transpose() * D;
    if (const std::size_t l = symbolOf(g); l < turnOfXi.size()) {
      box += turnedD.cwiseAbs() * (total - plain);
      kept += turnedD.cwiseAbs() * total;
      turnOfXi[l].resize(n_, n_);
      for (int k = 0; k < n_; ++k) turnOfXi[l].col(order[at(k)]) = turnedD.col(k);
    } else {
      box += turnedD.cwiseAbs() * total;
    }
    // n products in QᵀD; where it is kept, as many again in the product with Γ.
    box += (2 * n_ + 3) * bounds::unit * (Q.cwiseAbs().transpose() * (D.cwiseAbs() * total));
  }
  w *= bounds::up;
  const Eigen::VectorXd turned = Q.cwiseAbs().transpose() * w;
  box.array() += slack * (box.maxCoeff() + turned.maxCoeff() + kept.maxCoeff()) + bounds::tiny;
  if (N.maxCoeff() > 0) {
    // y ≥ b + N y, checked, gives y ≥ (I - N)⁻¹ b: once for the box, once for N (I - N)⁻¹ |Qᵀ| w.
    const auto solve = [&](const Eigen::VectorXd& b) {
      Eigen::VectorXd y = b;
      for (int i = 0; i < 12; ++i) y = b + N * y;
      // Row sums of N are below 0.9, so adding c·1 with c large enough passes; what is not finite fails in the next
      // step.
      for (double c = 1e-8 * y.maxCoeff(); std::isfinite(c); c *= 8) {
        const Eigen::VectorXd z = y.array() + c;
        if ((((b + N * z) * bounds::up).array() <= z.array()).all()) return z;
      }
      return Eigen::VectorXd(Eigen::VectorXd::Constant(n_, std::numeric_limits<double>::infinity()));
    };
    box = solve(box) + N * solve(turned);
  }
  // Γ' = fl(T Γ), n roundings an entry, and fl(Qᵀ diag w), one: together (n+1) u (|T| Σ|Γ| + |Qᵀ| w) into the box.
  box += (n_ + 1) * bounds::unit * (T.cwiseAbs() * total + turned);
  Matrix turn(n_, n_);  // T, its columns where the generators' components stand
  for (int k = 0; k < n_; ++k) turn.col(order[at(k)]) = T.col(k);
  // What ξ leaves in the box is kept apart as well, in n further columns: in the box it would wrap.
  const auto before = columnsOf(set.generators, n_);
  const int own = NJ > 1 ? 2 * n_ : n_;
  Matrix moved(n_, before.cols() + own);
  moved.leftCols(before.cols()).noalias() = turn * before;
  moved.middleCols(before.cols(), n_) = (w.asDiagonal() * Q).transpose();
  if (NJ > 1) {
    moved.rightCols(n_) = (bounds::up * box).asDiagonal();
    box.setZero();
  }
  const Eigen::Index held = (inputs_.empty() ? stepsKept(n_) : stepsBesideInputs(n_ * own)) * own;
  const Eigen::Index oldest = std::max<Eigen::Index>(0, moved.cols() - held);
  const Eigen::VectorXd merged = moved.leftCols(oldest).cwiseAbs().rowwise().sum();
  const Eigen::VectorXd newR = (T.cwiseAbs() * R + merged + box) * bounds::up;
  set.generators.assign(moved.data() + oldest * n_, moved.data() + moved.size());
  if (!inputs_.empty()) {
    set.inputs.insert(set.inputs.end(), inputs_.generators().begin(), inputs_.generators().end());
    set.inputsOfXi.resize(turnOfXi.size());
    const auto inputs = columnsOf(std::as_const(set.inputs), n_);
    for (std::size_t l = 0; l < turnOfXi.size(); ++l) {
      set.inputsOfXi[l].resize(set.inputs.size(), 0.0);
      Matrix driven = turn * columnsOf(std::as_const(set.inputsOfXi[l]), n_);
      if (turnOfXi[l].size() > 0) driven += turnOfXi[l] * inputs;
      set.inputsOfXi[l].assign(driven.data(), driven.data() + driven.size());
    }
    const Matrix driven = turn * inputs;
    set.inputs.assign(driven.data(), driven.data() + driven.size());
    mergeInputs(set, at(inputs_.count()), mostInputNumbers);
  }

  set.t += h_;  // exact: both are multiples of the quantum
  set.arguments = argumentsBehind();
  set.slideStep = isSliding_ ? h_ : 0;
  set.p = end_.p;
  if (series_.isFine()) set.low = end_.low;
  // A step that jumps made short says little of the next: that is as long as the one before was, once none does.
  // After one that its end cut short, the next goes on as if nothing had been.
  if ((isShortened_ || isCut_) && set.freeStep == 0) set.freeStep = set.nextStep;
  if (isCut_)
    set.nextStep = std::max(set.nextStep, set.freeStep);
  else
    set.nextStep = isSliding_ ? 2 * h_ : std::max(h_ * 1.1, set.freeStep);
  if (!isShortened_ && !isCut_) set.freeStep = 0;
  set.caution = caution_;
  set.units = growth_.units();
  if (set.first.empty())
    for (int i = 0; i < n_; ++i) set.first.push_back(series_.norm(i));
  set.largest.resize(at(n_), 0.0);
  for (int i = 0; i < n_; ++i) set.largest[at(i)] = std::max(set.largest[at(i)], series_.norm(i));
  for (int i = 0; i < n_; ++i) {
    set.R[at(i)] = newR(i);
    set.W[at(i)] = 0;
  }
  for (int g = 0; g < NJ; ++g)
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) {
        double& entry = set.C[at((g * n_ + i) * n_ + j)];
        entry = C[at(g)](i, j) * unit[at(i)];
        if (entry / unit[at(i)] != C[at(g)](i, j)) set.W[at(i)] = bounds::tiny;  // underflow
      }
}

}  // namespace gamut
