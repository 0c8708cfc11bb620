// The certified step: recursion, comparison, linear part, update. Derivations: docs/flow.md, sections 2 and 3.
#include "analyses/flow/step.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

#include "analyses/flow/error_bounds.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double dumpedAt = 0.2;  // a frame column with more ξ-dependence than this goes back to a constant one
/// Steps whose errors are kept apart; older ones merge into the box R. What it costs grows as the rest of a step does,
/// so that long motions of many states, which lose most by merging, keep more.
int stepsKept(int n) { return std::clamp(30 * n, 60, 300); }

/// Generators, n numbers each, as the columns of a matrix.
template <class Generators>
auto columnsOf(Generators& generators, int n) {
  using Matrix = std::conditional_t<std::is_const_v<Generators>, const Eigen::MatrixXd, Eigen::MatrixXd>;
  return Eigen::Map<Matrix>(generators.data(), n, static_cast<Eigen::Index>(generators.size()) / n);
}

// A state is followed relative to its size, but a body at rest need not be: to what it was, or its box; nor one that
// symmetry keeps at zero: to what the others are in balanced units; and never below what bounds can tell from
// underflow, bounds::tiny over a tolerance.
constexpr double vanished = 0x1p-120, unheard = 0x1p-80, leastSize = 0x1p-530;

}  // namespace

FlowStepper::FlowStepper(const Program& motion, std::shared_ptr<const Monomials> monomials, int frameDegree, int order,
                         double tolerance, const std::atomic<bool>* cancelled)
    : n_(motion.states()),
      m_(order),
      tolerance_(tolerance),
      series_(motion, motion.states(), std::move(monomials), frameDegree, order, true, cancelled),
      growth_(motion.states(), order) {
  epsilon_.assign(at(n_ * n_), 0.0);
  for (auto* v :
       {&delta0_, &delta1_, &start_, &E_, &y_, &e1_, &nu0_, &nu1_, &scale_, &floor_, &second_, &third_, &turn_})
    v->assign(at(n_), 0.0);
}

void FlowStepper::load(const FlowSet& set) {
  totalRadius(set, total_);
  const auto unit = [&](std::size_t i) { return set.units.empty() ? 0 : set.units[i]; };
  double greatest = 0;  // of all states, in balanced units
  for (std::size_t i = 0; i < set.largest.size(); ++i)
    greatest = std::max(greatest, std::ldexp(set.largest[i], -unit(i)));
  for (std::size_t i = 0; i < at(n_); ++i) {
    floor_[i] = std::max(leastSize, std::ldexp(unheard * greatest, unit(i)));
    if (!set.largest.empty()) floor_[i] = std::max(floor_[i], vanished * set.largest[i]);
  }
  const int N = series_.count();
  for (int i = 0; i < n_; ++i) series_.setState(i, &set.p[at(i * N)]);
  for (std::size_t i = 0; i < set.parameters.size(); ++i) series_.setParameter(static_cast<int>(i), set.parameters[i]);
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) series_.setFrame(i, j, &set.C[at(i * n_ + j)], n_ * n_);
}

/// The step, in units of h0, at which the last two orders reach the tolerance.
double FlowStepper::suggestion(double theta) const {
  double best = 1e9;
  for (int i = 0; i < n_; ++i) {
    const double* x = series_.series(i);
    const auto norm = [&](int order) {
      double sum = 0;
      for (int g = 0; g < series_.count(); ++g) sum += std::fabs(x[g * series_.stride() + order]);
      return sum;
    };
    double size = 0;  // over the step; one that starts from rest moves by a later order
    for (int order = 3; order >= 0; --order) size = size * std::min(theta, 1.0) + norm(order);
    size = std::max(size, floor_[at(i)]);
    for (int order : {m_ - 1, m_}) {
      const double last = norm(order);
      if (!std::isfinite(last)) return std::nan("");
      if (last > 0) best = std::min(best, std::pow(tolerance_ * size / last, 1.0 / order));
    }
  }
  return best;
}

bool FlowStepper::boundGrowth(double h) {
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) growth_.A(i, j) = series_.jacobianBound(i, j);
  return growth_.compute(h);
}

bool FlowStepper::tryStep(const FlowSet& set, double theta) {
  const double h = theta * h0_;  // exact: h0 is a power of two
  obstacle_.clear();
  const auto refuse = [&] {
    obstacle_ = series_.obstacle();
    return false;
  };
  if (!series_.tabulate(theta) || !series_.bound(nullptr, false)) return refuse();
  for (int i = 0; i < n_; ++i) {
    const int f = series_.outputNode(i);
    // δ = x̃' - f(x̃): the bound of f's node, and one rounding in the division by i+1.
    delta0_[at(i)] = (series_.rho0(f) + bounds::unit * series_.norm(f)) * bounds::up + bounds::tiny;
    delta1_[at(i)] = series_.rho1(f);
    scale_[at(i)] = std::max(series_.norm(i), floor_[at(i)]);
    double start = set.W[at(i)];
    for (int g = 0; g < series_.frameCount(); ++g)
      for (int j = 0; j < n_; ++j) start += std::fabs(set.C[at((g * n_ + i) * n_ + j)]) * total_[at(j)];
    start_[at(i)] = start * bounds::up;
  }
  const auto tube = [&] {  // prop(δ) + e^{Ah} (|C|R + W)
    for (int i = 0; i < n_; ++i) {
      double y = 0;
      for (int j = 0; j < n_; ++j)
        y += growth_.M1(i, j) * delta0_[at(j)] + growth_.M2(i, j) * delta1_[at(j)] + growth_.M0(i, j) * start_[at(j)];
      y_[at(i)] = y * bounds::up + bounds::tiny;
    }
  };
  if (!boundGrowth(h)) return false;
  tube();
  bool proved = false;
  for (int attempt = 0; attempt < 4 && !proved; ++attempt) {
    for (int i = 0; i < n_; ++i) {
      E_[at(i)] = y_[at(i)] * (attempt == 0 ? 1.05 : 1.3);
      if (!(E_[at(i)] < bounds::largest)) return false;
    }
    if (!series_.bound(E_.data(), false)) return refuse();
    if (!boundGrowth(h)) return false;
    tube();
    proved = true;
    for (int i = 0; i < n_; ++i) proved = proved && y_[at(i)] <= E_[at(i)];
  }
  if (!proved) return false;
  timeError_ = truncation_ = 0;
  for (int i = 0; i < n_; ++i) {
    double time = 0, truncation = 0, kept = 0;
    for (int j = 0; j < n_; ++j) {
      truncation += growth_.M1(i, j) * delta0_[at(j)];
      time += growth_.M2(i, j) * delta1_[at(j)];
      kept += growth_.M0(i, j) * set.W[at(j)];
    }
    e1_[at(i)] = (time + truncation + kept) * bounds::up + bounds::tiny;
    timeError_ = std::max(timeError_, time / scale_[at(i)]);
    truncation_ = std::max(truncation_, truncation / scale_[at(i)]);
  }
  for (int j = 0; j < n_; ++j) {
    for (int i = 0; i < n_; ++i) series_.frameDefect(i, j, nu0_[at(i)], nu1_[at(i)]);
    for (int i = 0; i < n_; ++i) {
      double s = 0;
      for (int l = 0; l < n_; ++l) s += growth_.M1(i, l) * nu0_[at(l)] + growth_.M2(i, l) * nu1_[at(l)];
      epsilon_[at(i * n_ + j)] = s * bounds::up;
    }
  }
  return true;
}

/// The defect bound holds rounding too, which splitting does not cure: what counts is mass in the highest grades, of
/// any node, since what cancels in the states was truncated before.
bool FlowStepper::isTruncationTooLarge(double splitDefect) const {
  const double allowed = splitDefect * h_;
  return splitDefect > 0 && truncation_ > allowed && series_.reachesHighestGrades(1e-3 * allowed);
}

bool FlowStepper::isRemainderDominant(const FlowSet& set) const {
  const int N = series_.count();
  for (int i = 0; i < n_; ++i) {
    double width = 0, remainder = set.W[at(i)];
    const double centre = std::fabs(set.p[at(i * N)]);
    for (int g = 1; g < N; ++g) width += std::fabs(set.p[at(i * N + g)]);
    for (int j = 0; j < n_; ++j) remainder += std::fabs(set.C[at(i * n_ + j)]) * total_[at(j)];
    if (remainder > 0.02 * width && remainder > 1e-12 * (centre + width)) return true;
  }
  return false;
}

std::string FlowStepper::nameOf(int state) const {
  return at(state) < names_.size() ? names_[at(state)] : "state " + std::to_string(state);
}

/// A state that has grown a thousandfold and would double long before the time it took is on its way to infinity. Else
/// a state that is hardly known to one part in ten makes the set too wide. Else it is the step itself.
std::string FlowStepper::reason(const FlowSet& set) const {
  const int N = series_.count();
  std::string wide;
  double widest = 0.1;
  const auto text = [](double value) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.3g", value);
    return std::string(digits.data());
  };
  for (int i = 0; i < n_; ++i) {
    const double* p = &set.p[at(i * N)];
    const double centre = p[0], rate = series_.series(i)[1] / h0_;
    double half = 0, remainder = set.W[at(i)];
    for (int g = 1; g < N; ++g) half += std::fabs(p[g]);
    for (int j = 0; j < n_; ++j) remainder += std::fabs(set.C[at(i * n_ + j)]) * total_[at(j)];
    const double before = set.first.empty() ? std::fabs(centre) : set.first[at(i)], doubling = centre / rate;
    if (before > 0 && std::fabs(centre) > 1000 * before && doubling > 0 && doubling < 0.01 * set.t)
      return nameOf(i) + " grows without bound: it is about " + text(centre) + " and doubles within " + text(doubling) +
             " s";
    const double size = std::max(std::fabs(centre), floor_[at(i)] / vanished);
    if (const double share = (half + remainder) / size; share > widest) {
      widest = share;
      wide = "the set has grown too wide: " + nameOf(i) + " is " + text(centre) + " ± " + text(half + remainder) +
             (remainder > half ? ", most of it what steps have added" : "");
    }
  }
  const std::string step = "no step could be certified";
  const std::string edge = obstacle_.empty() ? series_.nearestEdge(1e-6 * set.t / h0_) : obstacle_;
  if (!edge.empty()) return step + ": " + edge + (wide.empty() ? "" : "; " + wide);
  return wide.empty() ? step + ": its errors would outgrow it" : wide;
}

StepOutcome FlowStepper::certify(const FlowSet& set, double end, double quantum, double splitDefect) {
  const double left = end - set.t;
  caution_ = set.caution;
  growth_.setUnits(set.units);
  const auto powerOfTwoAbove = [](double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return std::ldexp(1.0, exponent);
  };
  const auto onGrid = [&](double h) { return std::floor(h / quantum) * quantum; };
  double guess = set.nextStep > 0 ? set.nextStep : left / 16;
  const double smallest = 1024 * quantum;  // below this, time itself is too coarse
  double h = 0;
  for (int attempt = 0;; ++attempt) {
    h0_ = powerOfTwoAbove(std::min(guess, left));
    load(set);
    series_.compute(set.t, h0_);
    const double theta = suggestion(guess / h0_) * caution_;
    if (std::isfinite(theta)) {
      h = theta * h0_;
      // A scale far from the step loses digits to overflow and underflow: once more with a better one.
      const bool tooLarge = theta < 0x1p-4;
      const bool tooSmall = theta > 16 && h0_ < left && set.nextStep == 0;
      if (!(tooLarge || tooSmall) || attempt >= 8) break;
      guess = h;
    } else {
      series_.clear();
      guess /= 1024;
    }
    if (!(guess > smallest) || attempt > 40) {
      obstacle_ = std::isfinite(theta) ? "" : "a number that is not defined or too large";
      why_ = reason(set);
      return StepOutcome::failed;
    }
  }
  h = std::min({h, h0_, left});
  for (int attempt = 0; attempt < 24; ++attempt) {
    if (h < left) h = onGrid(h);
    if (!(h >= smallest || h == left) || h <= 0) break;
    if (tryStep(set, h / h0_)) {
      if (timeError_ > 5 * tolerance_ && attempt < 3) {
        const double factor = std::pow(tolerance_ / timeError_, 1.0 / (m_ + 1));
        caution_ *= factor;
        h *= factor;
        continue;
      }
      if (growth_.growth() > 4 &&
          attempt < 3) {  // stiff: the comparison with |Df| would lose a factor e^{growth} a step
        h *= 3 / growth_.growth();
        continue;
      }
      if (series_.haste() > 1 && attempt < 12) {
        h /= series_.haste();
        continue;
      }
      h_ = h;
      theta_ = h / h0_;
      boundDerivatives();
      if (h < left)
        caution_ *= std::clamp(std::pow(tolerance_ / std::max(timeError_, 1e-40), 1.0 / (m_ + 1)), 0.7, 1.15);
      caution_ = std::clamp(caution_, 0x1p-6, 2.0);
      return isTruncationTooLarge(splitDefect) ? StepOutcome::splitWanted : StepOutcome::stepped;
    }
    h *= std::min(0.6, 1 / series_.haste());
    caution_ = std::max(caution_ * 0.8, 0x1p-6);
  }
  why_ = reason(set);
  return StepOutcome::failed;
}

void FlowStepper::evaluate(const FlowSet& set, double tau, FlowPoint& point) {
  const int N = series_.count(), NJ = series_.frameCount(), stride = series_.stride();
  const double sigma = tau / h0_;
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
  for (int i = 0; i < n_; ++i) {
    double error = 0;
    for (int g = 0; g < N; ++g) point.p[at(i * N + g)] = horner(series_.series(i) + g * stride, error);
    point.loose[at(i)] = tau == 0 ? set.W[at(i)] : error + e1_[at(i)];  // the start itself is known
  }
  point.total = total_;
  for (int i = 0; i < n_; ++i) {
    double radius = 0, loose = point.loose[at(i)];
    for (int j = 0; j < n_; ++j) {
      double error = 0, sum = 0;
      const double* psi = series_.frame(i, j);
      for (int g = 0; g < NJ; ++g) {
        const double value = horner(psi + g * stride, error);
        point.psi[at((g * n_ + i) * n_ + j)] = value;
        sum += std::fabs(value);
      }
      point.psiSum[at(i * n_ + j)] = sum * bounds::up;
      // Ψ_0 r by the box R; Ψ_0 Γ s below; the higher Ψ_α by the whole radius.
      const double leading = std::fabs(point.psi[at(i * n_ + j)]);
      radius += leading * set.R[at(j)] + (sum * bounds::up - leading * bounds::down) * (NJ > 1 ? total_[at(j)] : 0.0);
      if (tau != 0) loose += (error + epsilon_[at(i * n_ + j)]) * total_[at(j)];
    }
    point.loose[at(i)] = loose;
    point.radius[at(i)] = radius;
  }
  // Ψ_0 Γ: n roundings an entry, together at most n u |Ψ_0| Σ|Γ_j|.
  const std::size_t n = set.R.size();
  point.zonotope.resize(set.generators.size());
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> psi(point.psi.data(),
                                                                                                     n_, n_);
  Eigen::Map<Eigen::MatrixXd> zonotope = columnsOf(point.zonotope, n_);
  zonotope.noalias() = psi * columnsOf(set.generators, n_);
  Eigen::Map<Eigen::VectorXd>(point.radius.data(), n_) += zonotope.cwiseAbs().rowwise().sum();
  for (std::size_t i = 0; i < n; ++i) {
    double size = 0;
    for (std::size_t k = 0; k < n; ++k) size += std::fabs(point.psi[i * n + k]) * total_[k];
    point.loose[i] = (point.loose[i] + (n_ + 1) * bounds::unit * size) * bounds::up;
    point.radius[i] = (point.radius[i] + point.loose[i]) * bounds::up + bounds::tiny;
  }
}

double FlowStepper::looseBound(int i) const {
  double loose = e1_[at(i)];
  for (int j = 0; j < n_; ++j) loose += epsilon_[at(i * n_ + j)] * total_[at(j)];
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
    bound.push_back(series_.sag(i, from / h0_, to / h0_, second_[at(i)], third_[at(i)], turn_[at(i)]));
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
  const double largestR = *std::max_element(total_.begin(), total_.end());
  std::vector<double> length(at(n_));
  for (int j = 0; j < n_; ++j) {
    double sum = 0;
    for (int i = 0; i < n_; ++i) sum += psi(0, i, j) * psi(0, i, j);
    length[at(j)] = std::sqrt(sum) * (largestR > 0 ? std::max(total_[at(j)], 1e-20 * largestR) : 1.0);
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
      if (!(largest < dumpedAt)) constant[at(j)] = 1;
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
  Eigen::VectorXd w(n_), box = Eigen::VectorXd::Zero(n_), R(n_), total(n_);
  for (int i = 0; i < n_; ++i) w(i) = end_.loose[at(i)];
  for (int j = 0; j < n_; ++j) {
    R(j) = set.R[at(order[at(j)])];
    total(j) = total_[at(order[at(j)])];
  }
  for (int g = 0; g < NJ; ++g) {
    const Matrix D = sorted[at(g)] - C[at(g)] * T;
    // n products, n sums and the difference: n + 2 roundings at most.
    const Matrix size = sorted[at(g)].cwiseAbs() + C[at(g)].cwiseAbs() * T.cwiseAbs();
    w += (n_ + 2) * bounds::unit * (size * total);
    box += (Q.transpose() * D).cwiseAbs() * total +
           (n_ + 1) * bounds::unit * (Q.cwiseAbs().transpose() * (D.cwiseAbs() * total));
  }
  w *= bounds::up;
  const Eigen::VectorXd turned = Q.cwiseAbs().transpose() * w;
  box.array() += slack * (box.maxCoeff() + turned.maxCoeff()) + bounds::tiny;
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
  const Eigen::Index oldest = std::max<Eigen::Index>(0, moved.cols() - stepsKept(n_) * own);
  const Eigen::VectorXd merged = moved.leftCols(oldest).cwiseAbs().rowwise().sum();
  const Eigen::VectorXd newR = (T.cwiseAbs() * R + merged + box) * bounds::up;
  set.generators.assign(moved.data() + oldest * n_, moved.data() + moved.size());

  set.t += h_;  // exact: both are multiples of the quantum
  set.p = end_.p;
  set.nextStep = h_ * 1.1;
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

double FlowStepper::relativeRemainder(const FlowSet& set) const {
  std::vector<double> total;
  totalRadius(set, total);
  double largest = 0;
  for (int i = 0; i < n_; ++i) {
    double remainder = set.W[at(i)];
    for (int j = 0; j < n_; ++j) remainder += std::fabs(set.C[at(i * n_ + j)]) * total[at(j)];
    largest = std::max(largest, remainder / scale_[at(i)]);
  }
  return largest;
}

int FlowStepper::worstSymbol() const {
  const Monomials& m = monomials();
  std::vector<double> weight(at(m.symbols()), 0.0);
  for (int from : {m.degree() - 1, 1}) {  // the highest powers; at a fresh start, the linear terms
    for (int i = 0; i < n_; ++i)
      for (int g = 1; g < m.count(); ++g) {
        if (m.grade(g) < from) continue;
        double size = 0, power = 1;
        for (int order = 0; order <= m_; ++order, power *= theta_)
          size += std::fabs(series_.series(i)[g * series_.stride() + order]) * power;
        for (int l = 0; l < m.symbols(); ++l) weight[at(l)] += m.exponent(g, l) * size / scale_[at(i)];
      }
    if (*std::max_element(weight.begin(), weight.end()) > 0) break;
  }
  return static_cast<int>(std::max_element(weight.begin(), weight.end()) - weight.begin());
}

FlowSet FlowStepper::bisect(FlowSet& set, int symbol, const PolynomialRange& shift) const {
  const int N = series_.count(), NJ = series_.frameCount();
  FlowSet halves[2] = {set, set};
  std::vector<double> total;
  totalRadius(set, total);
  std::vector<double> from(at(N)), to(at(N));
  for (int side : {0, 1}) {
    FlowSet& s = halves[side];
    const double middle = side == 0 ? -0.5 : 0.5;
    for (int i = 0; i < n_; ++i) {
      double norm = 0;
      for (int g = 0; g < N; ++g) norm += std::fabs(set.p[at(i * N + g)]);
      shift.substitute(symbol, middle, 0.5, &set.p[at(i * N)], &s.p[at(i * N)]);
      double rounding = shift.shiftError() * norm;
      for (int j = 0; j < n_; ++j) {
        std::fill(from.begin(), from.end(), 0.0);
        norm = 0;
        for (int g = 0; g < NJ; ++g) {
          from[at(g)] = set.C[at((g * n_ + i) * n_ + j)];
          norm += std::fabs(from[at(g)]);
        }
        shift.substitute(symbol, middle, 0.5, from.data(), to.data());
        for (int g = 0; g < NJ; ++g) s.C[at((g * n_ + i) * n_ + j)] = to[at(g)];
        if (NJ > 1) rounding += shift.shiftError() * norm * total[at(j)];
      }
      s.W[at(i)] = (set.W[at(i)] + rounding) * bounds::up + bounds::tiny;
    }
    for (Embedded& p : s.parameters)
      if (p.symbol == symbol) {
        const double moved = p.half * middle;  // exact: a power of two
        const double centre = p.centre + moved;
        p.radius = (p.radius + bounds::unit * std::fabs(centre)) * bounds::up + bounds::tiny;
        p.centre = centre;
        p.half *= 0.5;
      }
    if (symbol < static_cast<int>(s.centre.size())) {
      s.centre[at(symbol)] += s.half[at(symbol)] * middle;
      s.half[at(symbol)] *= 0.5;
    }
  }
  set = std::move(halves[0]);
  return std::move(halves[1]);
}

}  // namespace gamut
