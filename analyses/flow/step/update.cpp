// A certified step at any of its times, between two of them, and the set at its end. Derivations: docs/flow.md,
// sections 3 and 5.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "analyses/flow/series/column_kernels.hpp"
#include "analyses/flow/series/embedded.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/step/step.hpp"
#include "analyses/work.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/elementary/double_double.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// Of generators with symbols so many a state are kept apart, a hundred at least. Of many symbols, whose steps are dear
/// and where what merges is missed most, more: as long as what they take is no more than this share of the work for a
/// step's certificate, and they are no more than so many numbers.
constexpr double keptAState = 16, leastKept = 100, carriedShare = 0.4, mostNumbers = 1e6;
/// What of their products is so little beside what a step leaves over is not carried out. Of long motions that is too
/// much: what is left out is missing where higher powers of ξ cancel, step after step.
constexpr double littleOfMany = 0.1, littleOfFew = 1e-3;
constexpr int few = 4;  // symbols, whose products are cheap
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

/// Σ c_i σ^i up to order m by Horner's scheme with its running error: fl(fl(sσ) + c) is off by u|fl(sσ)| + u|result|,
/// times the σ's that follow.
inline double hornerWithError(const double* c, int m, double sigma, double& error) {
  double s = c[m], e = 0;
  for (int i = m - 1; i >= 0; --i) {
    const double product = s * sigma;
    s = product + c[i];
    e = e * sigma + bounds::unit * (std::fabs(product) + std::fabs(s));
  }
  error += sigma == 0 ? 0.0 : e * bounds::up + bounds::tiny;
  return s;
}

/// Likewise of a state with second doubles, up to order m: (s + low)σ + c + l errs by less than 16u² of both.
detail::DoubleDouble fineHornerOf(const PolynomialSeries& series, int state, int m, double sigma, double& error) {
  const double* c = series.series(state);
  detail::DoubleDouble s{c[m], 0};
  double e = 0;
  for (int i = m - 1; i >= 0; --i) {
    detail::DoubleDouble product = detail::exactProduct<false>(s.hi, sigma);
    product = detail::exactSum(product.hi, product.lo + s.lo * sigma);
    s = detail::exactSum(product.hi, c[i]);
    s = detail::exactSum(s.hi, s.lo + (product.lo + series.low(state, i)));
    e = e * sigma + bounds::fine * (std::fabs(product.hi) + std::fabs(c[i]));
  }
  error += sigma == 0 ? 0.0 : e * bounds::up + bounds::tiny;
  return s;
}

/// The columns of Ψ, by how long they make a box of these radii: the longest first.
std::vector<int> byLength(const Eigen::MatrixXd& psi, const std::vector<double>& radii) {
  std::vector<int> order(radii.size());
  std::iota(order.begin(), order.end(), 0);
  const double largest = *std::max_element(radii.begin(), radii.end());
  std::vector<double> length;
  for (const int j : order)
    length.push_back(psi.col(j).norm() * (largest > 0 ? std::max(radii[j], 1e-20 * largest) : 1.0));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length[a] > length[b]; });
  return order;
}

}  // namespace

/// What is left of generators, a box: its radii, and Σ_α |Ψ_α|.
struct FlowStepper::GeneratorRest {
  Eigen::VectorXd sum;
  Eigen::MatrixXd frame;
};

void FlowStepper::evaluate(const FlowSet& set, double tau, FlowPoint& point, bool narrowed,
                           std::optional<Interval> moments) {
  evaluateMotion(set, tau, point, narrowed, moments);
  countAsGenerators([&] { evaluateRemainder(set, tau, point); });
  if (tau != 0 && narrowed) narrowArguments(set, tau, point, moments);
  if (assumed_.unsettled.empty() || set.t + tau >= set.unsettledUntil) return;
  for (std::size_t i = 0; i < at(n_); ++i)
    for (std::vector<double>* of : {&point.loose, &point.known, &point.radius})
      (*of)[i] = ((*of)[i] + assumed_.unsettled[i]) * bounds::up;
}

/// p, Ψ and what is loose.
void FlowStepper::evaluateMotion(const FlowSet& set, double tau, FlowPoint& point, bool narrowed,
                                 std::optional<Interval> moments) {
  const int N = series_.count(), NJ = series_.frameCount(), stride = series_.stride();
  const double sigma = tau / h0_;
  if (turn_ && !moments) moments = turn_->moments;
  const bool isHeldStill = turn_ && tau <= moments->lower();
  const bool crosses = tau != 0 && narrowed && (!crossings_.empty() || turn_);
  const std::vector<double>& left = !crosses ? e1_ : isHeldStill ? turn_->before : crossed_;
  point.p.assign(n_ * N, 0.0);
  point.psi.assign(NJ * n_ * n_, 0.0);
  point.psiSum.assign(n_ * n_, 0.0);
  point.loose.assign(n_, 0.0);
  point.low.assign(n_, 0.0);
  point.known.assign(n_, 0.0);
  for (int i = 0; i < n_; ++i) {
    double error = 0;
    if (series_.isFine()) {
      const detail::DoubleDouble x = fineHornerOf(series_, i, m_, sigma, error);
      point.p[i] = x.hi;
      point.low[i] = x.lo;
    } else {
      for (int g = 0; g < N; ++g)
        point.p[i * N + g] = hornerWithError(series_.series(i) + g * stride, m_, sigma, error);
    }
    point.loose[i] = tau == 0 ? set.W[i] : error + left[i];  // the start is known
  }
  point.total = total_;
  for (int j = 0; j < n_ && tau != 0; ++j) point.total[j] = (total_[j] + inputs_.total(j)) * bounds::up;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      double error = 0;
      const double* psi = series_.frame(i, j);
      for (int g = 0; g < NJ; ++g)
        point.psi[(g * n_ + i) * n_ + j] = hornerWithError(psi + g * stride, m_, sigma, error);
      if (tau != 0) point.loose[i] += (error + epsilon_[i * n_ + j]) * point.total[j];
    }
  for (std::size_t k = 0; crosses && k < crossings_.size(); ++k) addCrossing(set, crossings_[k], tau, point);
  if (crosses && turn_ && !isHeldStill) addTurn(tau, point, *moments);
  // Ψ_0 Γ: n roundings an entry, together at most n u |Ψ_0| Σ|Γ_j|. Of inputs n + 1 in what is linear in ξ, and one
  // more for each symbol in drivenRadius, which sums with signs: n + 1 + mostCorners ≤ 2n + 8.
  for (int i = 0; i < n_; ++i) {
    double size = 0;
    for (int j = 0; j < n_; ++j) {
      double sum = 0;
      for (int g = 0; g < NJ; ++g) sum += std::fabs(point.psi[(g * n_ + i) * n_ + j]);
      point.psiSum[i * n_ + j] = sum * bounds::up;
      size += sum * bounds::up * point.total[j];
    }
    point.loose[i] = (point.loose[i] + (2 * n_ + 8) * bounds::unit * size) * bounds::up;
  }
  Work::count(Work::coefficient, static_cast<double>(m_) * n_ * (N + n_ * NJ));
}

/// What the generators are by then, and the radius: Ψ_0 r by the box R, Ψ_0 Γ s power by power of ξ, the higher Ψ_α by
/// the whole radius.
void FlowStepper::evaluateRemainder(const FlowSet& set, double tau, FlowPoint& point) const {
  const std::size_t n = set.R.size();
  point.radius.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double leading = std::fabs(point.psi[i * n + j]);
      point.radius[i] += leading * set.R[j];
      if (series_.frameCount() > 1) point.radius[i] += (point.psiSum[i * n + j] - leading * bounds::down) * errors_[j];
    }
  const std::vector<double>& fresh = inputs_.generators();
  const auto begun = static_cast<std::ptrdiff_t>(tau == 0 ? 0 : inputs_.begunBefore(tau / h_));
  std::vector<double> driven = set.inputs;
  driven.insert(driven.end(), fresh.begin(), fresh.begin() + begun);
  point.ofErrors = set.generators.size();
  point.ofR = errors_;
  point.zonotope.resize(point.ofErrors + driven.size());
  const auto carry = [&](const std::vector<double>& columns, double* to) {
    kernels::multiplyColumns({{0, 0, 0}}, point.psi.data(), n_, n_, columns.data(),
                             static_cast<int>(columns.size() / n), to);
  };
  carry(set.generators, point.zonotope.data());
  carry(driven, point.zonotope.data() + point.ofErrors);
  kernels::addColumnSizes(point.zonotope.data(), n_, static_cast<int>(point.ofErrors / n), point.radius.data());
  evaluateInputs(set, driven, point);
  for (std::size_t i = 0; i < n; ++i)
    point.radius[i] =
        (point.radius[i] + point.driven[i] + point.beyond[i] + point.loose[i]) * bounds::up + bounds::tiny;
}

/// What inputs did: (Ψ_0 + Σ_l Ψ_l ξ_l) (Γ + Σ_l Γ_l ξ_l) to the first order in ξ; the rest goes `beyond`.
void FlowStepper::evaluateInputs(const FlowSet& set, const std::vector<double>& columns, FlowPoint& point) const {
  const std::size_t n = at(n_), symbols = set.inputsOfXi.size();
  point.driven.assign(n, 0.0);
  point.beyond.assign(n, 0.0);
  point.drivenOfXi.assign(symbols, std::vector<double>(columns.size(), 0.0));
  if (columns.empty()) return;
  const auto own = columnsOf(columns, n_);
  std::vector<double> plain(n, 0.0), ofXi(n, 0.0);
  addColumnSizes(columns, plain);
  Eigen::MatrixXd all(n_, n_);  // Σ_{α≠0} |Ψ_α|
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) all(i, j) = point.psiSum[i * n_ + j] - std::fabs(point.psi[i * n_ + j]) * bounds::down;
  Eigen::MatrixXd higher = all;  // without those taken below
  for (std::size_t l = 0; l < symbols; ++l) {
    const int g = monomials().linear(static_cast<int>(l));
    addColumnSizes(set.inputsOfXi[l], ofXi);
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
    point.driven[i] = drivenRadius(point.zonotope, point.drivenOfXi, point.ofErrors + i, n) * bounds::up;
  }
}

double drivenRadius(const std::vector<double>& a, const std::vector<std::vector<double>>& b, std::size_t first,
                    std::size_t stride) {
  const bool byCorners = b.size() <= mostCorners;
  double most = 0;
  const double sums = static_cast<double>(byCorners ? std::size_t{1} << b.size() : 1);
  const std::size_t terms = (a.size() - first) / stride * (1 + b.size());
  Work::count(Work::matrixTerm, sums * static_cast<double>(terms));
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
  double loose = e1_[i] + driven_[i];
  for (int j = 0; j < n_; ++j) loose += epsilon_[i * n_ + j] * (total_[j] + inputs_.total(j));
  loose += series_.lowNorm(i);
  if (isUnsettled()) loose += assumed_.unsettled[i];
  return loose * bounds::up;
}

double FlowStepper::tubeBound(int i) const {
  return (E_[i] + series_.lowNorm(i) + (isUnsettled() ? assumed_.unsettled[i] : 0.0)) * bounds::up;
}

void FlowStepper::boundDerivatives() {
  for (int i = 0; i < n_; ++i) {
    second_[i] = series_.derivativeNorm(i, 2, theta_);
    third_[i] = series_.derivativeNorm(i, 3, theta_);
    turning_[i] = 0;
    for (int j = 0; j < n_; ++j)
      if (total_[j] > 0) turning_[i] += series_.frameDerivativeNorm(i, j, 2, theta_) * total_[j];
  }
}

void FlowStepper::sag(double from, double to, std::vector<FlowSag>& sags) const {
  sags.clear();
  for (int i = 0; i < n_; ++i) {  // in σ, exactly; what is damped is no convex function of time
    double besides =
        growth_.isDamped() || growth_.isAbout() ? looseBound(i) : (driven_[i] + inputs_.rest(i)) * bounds::up;
    // Of l = x - p - Ψ (r + Γs), |l| ≤ looseBound, chords leave out λ l(0) at the part 1 - λ of the way: it may have
    // turned about by then.
    if (growth_.isAbout() && from == 0) besides = (besides + looseAtStart_[i]) * bounds::up;
    if (!bent_.empty()) besides = (besides + bent_[i]) * bounds::up;
    if (isUnsettled())
      besides = (besides + 2 * assumed_.unsettled[i]) * bounds::up;  // chords begin where solutions were
    sags.push_back({series_.sag(i, from / h0_, to / h0_, second_[i], third_[i], turning_[i]), besides});
  }
}

/// Generators become `turn` times these and the columns of `fresh`, and the oldest errors' a box: what that is, but for
/// roundings.
Eigen::VectorXd FlowStepper::turnGenerators(FlowSet& set, const Eigen::MatrixXd& turn, const Eigen::MatrixXd& fresh) {
  using Matrix = Eigen::MatrixXd;
  const auto before = columnsOf(set.generators, n_);
  Matrix moved(n_, before.cols() + n_);
  moved.leftCols(before.cols()).noalias() = turn * before;
  moved.rightCols(n_) = fresh;
  const Eigen::Index held = (inputs_.empty() ? stepsKept(n_) : stepsBesideInputs(n_ * n_)) * n_;
  const Eigen::Index oldest = std::max<Eigen::Index>(0, moved.cols() - held);
  const Eigen::VectorXd merged = moved.leftCols(oldest).cwiseAbs().rowwise().sum();
  set.generators.assign(moved.data() + oldest * n_, moved.data() + moved.size());
  if (!inputs_.empty()) {
    set.inputs.insert(set.inputs.end(), inputs_.generators().begin(), inputs_.generators().end());
    const Matrix driven = turn * columnsOf(std::as_const(set.inputs), n_);
    set.inputs.assign(driven.data(), driven.data() + driven.size());
  }
  return merged;
}

/// Without symbols: QR of the frame, so that the oldest errors' box turns with the motion.
void FlowStepper::turnFrame(FlowSet& set) {
  using Matrix = Eigen::MatrixXd;
  Work::count(Work::matrixTerm, static_cast<double>(n_) * n_ *
                                    (24.0 * n_ + static_cast<double>(set.generators.size() + set.inputs.size()) / n_));
  // All of it in balanced units z = D⁻¹x, D a diagonal of powers of two: lengths and angles mean something there.
  Eigen::VectorXd unit(n_);
  for (int i = 0; i < n_; ++i) unit(i) = std::ldexp(1.0, growth_.units()[i]);
  const Matrix psi = unit.cwiseInverse().asDiagonal() * frameOf(end_, 0);

  // Q, T: QR of Ψ, columns sorted by length × R, so that the longest keeps its direction.
  const std::vector<int> order = byLength(psi, end_.total);
  Matrix sorted(n_, n_);
  Eigen::VectorXd R(n_), total(n_), w(n_);
  for (int j = 0; j < n_; ++j) {
    sorted.col(j) = psi.col(order[j]);
    R(j) = set.R[order[j]];
    total(j) = end_.total[order[j]];
    w(j) = end_.loose[j] / unit(j);
  }
  const Matrix Q = orthogonalFactorOf(sorted, n_);
  Matrix T = Q.transpose() * sorted;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < i; ++j) T(i, j) = 0;
  const double phi = orthogonalityDefect(Q);
  const double slack =
      phi < 0.5 ? phi / (1 - phi) * bounds::up : std::numeric_limits<double>::infinity();  // then the next step fails

  // Q⁻¹v with v = D(r + Γs) + w, D = Ψ - Q T. The part of D goes into the box, with |QᵀD| as the absolute value of the
  // product; w becomes generators Qᵀ diag(|w|).
  const Matrix D = sorted - Q * T;
  // n products, n sums and the difference: n + 2 roundings at most.
  w += (n_ + 2) * bounds::unit * ((sorted.cwiseAbs() + Q.cwiseAbs() * T.cwiseAbs()) * total);
  w *= bounds::up;
  // n products in QᵀD.
  Eigen::VectorXd box = (Q.transpose() * D).cwiseAbs() * total +
                        (n_ + 2) * bounds::unit * (Q.cwiseAbs().transpose() * (D.cwiseAbs() * total));
  const Eigen::VectorXd turned = Q.cwiseAbs().transpose() * w;
  box.array() += slack * (box.maxCoeff() + turned.maxCoeff()) + bounds::tiny;
  // Γ' = fl(T Γ), n roundings an entry, and fl(Qᵀ diag w), one: together (n+1) u (|T| Σ|Γ| + |Qᵀ| w) into the box.
  box += (n_ + 1) * bounds::unit * (T.cwiseAbs() * total + turned);
  Matrix turn(n_, n_);  // T, its columns where the generators' components stand
  for (int k = 0; k < n_; ++k) turn.col(order[k]) = T.col(k);
  const Eigen::VectorXd merged = turnGenerators(set, turn, (w.asDiagonal() * Q).transpose());
  Eigen::Map<Eigen::VectorXd>(set.R.data(), n_) = (T.cwiseAbs() * R + merged + box) * bounds::up;
  if (!inputs_.empty()) mergeInputs(set, at(inputs_.count()), mostInputNumbers);
  for (int i = 0; i < n_; ++i) {
    set.W[i] = 0;
    for (int j = 0; j < n_; ++j) {
      double& entry = set.C[i * n_ + j];
      entry = Q(i, j) * unit(i);
      if (entry / unit(i) != Q(i, j)) set.W[i] = bounds::tiny;  // underflow
    }
  }
}

/// Ψ(ξ) Γ_j(ξ) up to the generators' degree, of what is not little beside what the step leaves over; and what that
/// leaves out, |Ψ_α| Σ_j |Γ_j|_β: what is beyond the degree, and little.
void FlowStepper::multiplyGenerators(FlowSet& set, GeneratorRest& rest) {
  using Matrix = Eigen::MatrixXd;
  const Monomials& m = monomials();
  const int powers = series_.frameCount(), degree = m.grade(powers - 1);
  const auto block = static_cast<Eigen::Index>(set.generators.size() / set.powers), count = block / n_;
  std::vector<Matrix> frames, high(at(degree) + 1, Matrix::Zero(n_, n_));            // Σ |Ψ_α| of grades ≥ q
  std::vector<Eigen::VectorXd> sizes, size(high.size(), Eigen::VectorXd::Zero(n_));  // of a monomial, of a grade
  Eigen::VectorXd all = Eigen::VectorXd::Zero(n_);
  for (int g = 0; g < powers; ++g) {
    frames.emplace_back(frameOf(end_, g).cwiseAbs());
    for (int q = 0; q <= m.grade(g); ++q) high[q] += frames.back();
    sizes.emplace_back(Eigen::VectorXd::Zero(n_));
    countAsGenerators([&] {
      kernels::addColumnSizes(set.generators.data() + g * block, n_, static_cast<int>(count), sizes.back().data());
    });
    size[m.grade(g)] += sizes.back();
    all += sizes.back();
  }
  rest.sum = Eigen::Map<const Eigen::VectorXd>(end_.loose.data(), n_);
  Eigen::VectorXd little = (m.symbols() > few ? littleOfMany : littleOfFew) * rest.sum;
  for (int q = 1; q <= degree; ++q) rest.sum += high[degree - q + 1] * size[q];
  std::vector<kernels::ColumnTerm> terms;
  int most = 1;
  for (int g = powers; g-- > 0;) {
    const int begin = m.first()[g], end = m.first()[at(g) + 1];
    for (int pair = begin; pair < end; ++pair) {
      const auto [a, b] = m.pairs()[pair];
      const Eigen::VectorXd product = frames[a] * sizes[b];
      if ((product.array() <= little.array()).all()) {
        little -= product;
        rest.sum += product;
      } else {
        terms.push_back({g, a, b});
      }
    }
    most = std::max(most, end - begin);
  }
  carried_.assign(set.generators.size(), 0.0);
  countAsGenerators([&] {
    kernels::multiplyColumns(terms, end_.psi.data(), n_, n_, set.generators.data(), static_cast<int>(count),
                             carried_.data());
  });
  // Entries are sums of n products for each pair, at most; those of inputs of n for their own and one symbol.
  rest.sum += (n_ * most + 2) * bounds::unit * (high[0] * all);
  rest.frame = high[0];
}

/// Likewise what inputs did, to the first order in ξ.
void FlowStepper::carryInputs(FlowSet& set, GeneratorRest& rest) {
  using Matrix = Eigen::MatrixXd;
  const Monomials& m = monomials();
  Work::count(Work::matrixTerm,
              static_cast<double>(set.inputs.size()) * (n_ + 4) * static_cast<double>(1 + 2 * set.half.size()));
  std::vector<double> own(n_, 0.0), ofXi(at(n_), 0.0);
  set.inputs.insert(set.inputs.end(), inputs_.generators().begin(), inputs_.generators().end());
  set.inputsOfXi.resize(set.half.size());
  addColumnSizes(set.inputs, own);
  const auto inputs = columnsOf(std::as_const(set.inputs), n_);
  Matrix higher = rest.frame * bounds::up - frameOf(end_, 0).cwiseAbs() * bounds::down, any = higher;
  for (std::size_t l = 0; l < set.inputsOfXi.size(); ++l) {
    set.inputsOfXi[l].resize(set.inputs.size(), 0.0);
    addColumnSizes(set.inputsOfXi[l], ofXi);
    Matrix driven = frameOf(end_, 0) * columnsOf(std::as_const(set.inputsOfXi[l]), n_);
    if (const int g = m.linear(static_cast<int>(l)); g >= 0 && g < series_.frameCount()) {
      driven += frameOf(end_, g) * inputs;
      higher -= frameOf(end_, g).cwiseAbs() * bounds::down;
    }
    set.inputsOfXi[l].assign(driven.data(), driven.data() + driven.size());
  }
  const Eigen::Map<const Eigen::VectorXd> ownSize(own.data(), n_), ofXiSize(ofXi.data(), n_);
  rest.sum += higher.cwiseMax(0.0) * ownSize + any * ofXiSize +
              (2 * n_ + 3) * bounds::unit * (rest.frame * (ownSize + ofXiSize));
  const Matrix driven = frameOf(end_, 0) * inputs;
  set.inputs.assign(driven.data(), driven.data() + driven.size());
}

/// With symbols: generators Γ_j(ξ) become Ψ(ξ) Γ_j(ξ), up to their degree; nothing is inverted, whatever Ψ has of ξ. C
/// is the identity from then on. What is cut off and w enter as generators of their own.
void FlowStepper::carryGenerators(FlowSet& set) {
  const int powers = series_.frameCount();
  if (std::ranges::any_of(set.R, [](double r) { return r > 0; })) countAsGenerators([&] { appendBox(set, set.R); });
  set.R.assign(n_, 0.0);
  // All columns of which ofGenerators_ is the work.
  const std::size_t ofInputs = (set.inputs.size() + inputs_.generators().size()) / at(n_);
  const double columns =
      static_cast<double>(set.generators.size() / set.powers / at(n_)) + static_cast<double>(ofInputs);
  GeneratorRest rest;
  multiplyGenerators(set, rest);
  if (!inputs_.empty()) carryInputs(set, rest);
  set.generators.swap(carried_);
  std::vector<double> fresh(n_);
  for (int i = 0; i < n_; ++i) fresh[i] = rest.sum(i) * bounds::up + bounds::tiny;
  set.W.assign(n_, 0.0);
  for (std::size_t i = 0; i < arrives_.size(); ++i)  // of what arrives a hull alone is known: boundArrivals
    if (arrives_[i] != 0 && end_.known[i] > 0) std::swap(set.W[i], fresh[i]);
  appendBox(set, fresh);
  mergeInputs(set, at(inputs_.count()), mostInputNumbers);
  double kept = std::max(leastKept, keptAState * n_);
  if (monomials().symbols() > few && ofGenerators_ > 0) {
    const double affordable = carriedShare * certified_ * columns / ofGenerators_;
    kept = std::max(kept, std::min(affordable, mostNumbers / (static_cast<double>(powers) * n_)));
  }
  const std::size_t there = set.generators.size() / (set.powers * at(n_));
  if (static_cast<double>(there) > kept) mergeGenerators(set, monomials(), static_cast<std::size_t>(kept / 2));
  set.C.assign(n_ * n_, 0.0);
  for (int i = 0; i < n_; ++i) set.C[i * n_ + i] = 1;
}

void FlowStepper::advance(FlowSet& set) {
  evaluateMotion(set, h_, end_, true);
  if (narrows()) {
    evaluateRemainder(set, h_, end_);
    narrowArguments(set, h_, end_, {});
  }
  if (monomials().symbols() > 0)
    carryGenerators(set);
  else
    turnFrame(set);
  set.t += h_;  // exact: both are multiples of the quantum
  set.arguments = argumentsBehind();
  endStep(set);
}

/// What the next step starts from besides.
void FlowStepper::endStep(FlowSet& set) {
  set.slideStep = course_.isSliding ? h_ : 0;
  set.hasSlid = set.hasSlid || course_.isSliding;
  set.p = end_.p;
  if (series_.isFine()) set.low = end_.low;
  // A step that jumps made short says little of the next: that is as long as the one before was, once none does.
  // After one that its end cut short, the next goes on as if nothing had been.
  if ((course_.isShortened || course_.isCut) && set.freeStep == 0) set.freeStep = set.nextStep;
  if (course_.isCut)
    set.nextStep = std::max(set.nextStep, set.freeStep);
  else
    set.nextStep = course_.isSliding ? 2 * h_ : std::max(h_ * 1.1, set.freeStep);
  if (!course_.isShortened && !course_.isCut) set.freeStep = 0;
  if (!course_.isCut) set.dampedStep = dampedStep();
  set.caution = caution_;
  set.units = growth_.units();
  if (set.first.empty())
    for (int i = 0; i < n_; ++i) set.first.push_back(series_.norm(i));
  set.largest.resize(n_, 0.0);
  for (int i = 0; i < n_; ++i) set.largest[i] = std::max(set.largest[i], series_.norm(i));
}

}  // namespace gamut
