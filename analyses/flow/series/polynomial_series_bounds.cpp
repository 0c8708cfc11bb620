// The certificate, second part: bounds for every node, from what each adds itself (polynomial_series_errors.cpp, whose
// notation this is) and what its operands have. Also what follows from them: chords, the Jacobian, the frame's defect.
#include <algorithm>
#include <cmath>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/horner.hpp"
#include "analyses/flow/series/operations/all.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/work.hpp"

namespace gamut {

bool PolynomialSeries::boundNode(int node) {
  const Plan& v = plan_[at(node)];
  const Operands of{*this, isFine(node)};
  Errors z;
  switch (v.op) {
    case Op::state:
    case Op::parameter:
    case Op::time:
    case Op::constant:
      return true;
    case Op::solution:
      return v.b > 0 || boundSolution(node);
    case Op::add:
    case Op::sub:
      if (norm_[at(node)] == 0 && isNothing(v)) break;
      z = {of.r0(v.a) + of.r0(v.b) + own0_[at(node)], of.r1(v.a) + of.r1(v.b)};
      break;
    case Op::neg:
      z = {of.r0(v.a) + own0_[at(node)], of.r1(v.a)};
      break;
    case Op::mul:
    case Op::sqr: {  // ab - ãb̃ = ã δb + b̃ δa + δa δb
      const int b = v.op == Op::sqr ? v.a : v.b;
      z = {norm_[at(v.a)] * of.r0(b) + norm_[at(b)] * of.r0(v.a) + of.r(v.a) * of.r(b) + own0_[at(node)],
           norm_[at(v.a)] * of.r1(b) + norm_[at(b)] * of.r1(v.a) + own1_[at(node)]};
      break;
    }
    default:
      return withFunction<FlowFunction>(v.op, [&](auto f) { return f.bound(*this, node, of); });
  }
  return setBounds(node, z);
}

/// Whether a sum is |u| + u, or |u| - u, where that is zero: exactly, whatever is known of u.
bool PolynomialSeries::isNothing(const Plan& sum) const {
  const auto is = [&](int kink, int u, double sign) {
    return plan_[at(kink)].op == Op::abs && plan_[at(kink)].a == u && isSided_[at(kink)] != 0 &&
           chords_[at(kink)].slope == sign;
  };
  const double cancelling = sum.op == Op::add ? -1 : 1;
  return is(sum.a, sum.b, cancelling) || is(sum.b, sum.a, cancelling);
}

/// Whether u may change its sign, or be zero, in the step. Then the step should end before, or be so short that u moves
/// by less than what is uncertain about it.
bool PolynomialSeries::mayCross(int u) {
  constexpr double ahead = 0.9, across = 0.5, farTooLong = 16;  // of the way, of the uncertainty
  const double centre = leading(u), V = rest(u), M = moved(u), rho = (rho0_[at(u)] + rho1_[at(u)]) * bounds::up;
  reached_[at(u)] = 0;
  if (centre * bounds::down > (V + rho) * bounds::up) return false;
  const double apart = V - M + (atStart_.empty() ? rho : atStart_[at(u)]);
  reached_[at(u)] = apart + M + bounds::tiny;  // of what is exactly at zero too
  if (isCalm_[at(u)] != 0) return true;
  const double allowed = std::max(ahead * (centre - apart), across * apart);
  haste_ = std::max(haste_, M < farTooLong * allowed ? M / allowed : farTooLong);
  return true;
}

/// |u| - (slope u + middle) is greatest at an end of what u reaches, or where it is zero; the rest is slope (u - ũ).
void PolynomialSeries::boundAbs(int node) {
  const int u = plan_[at(node)].a;
  const auto [slope, middle] = chords_[at(node)];
  double off = 0;
  const bool isReckonedApart = isAlong_ && isApart_[at(node)] != 0;
  isSided_[at(node)] = static_cast<char>(chords_[at(node)].isExact());
  if (!isReckonedApart && side_[at(u)] == 0 && (mayCross(u) || !chords_[at(node)].isExact())) {
    isSided_[at(node)] = 0;
    const double centre = f_[plan_[at(u)].f], size = (rest(u) + rho0_[at(u)] + rho1_[at(u)]) * bounds::up;
    off = middle;
    for (const double end : {centre - size, centre + size})
      off = std::max(off, std::fabs(std::fabs(end) - (slope * end + middle)));
    off += 8 * bounds::unit * (std::fabs(centre) + size + middle);  // of centre ± size, the chord and the differences
  }
  rho0_[at(node)] = (off + own0_[at(node)] + std::fabs(slope) * rho0_[at(u)]) * bounds::up + bounds::tiny;
  rho1_[at(node)] = std::fabs(slope) * rho1_[at(u)] * bounds::up;
}

/// Exact on one side, else anything between -1 and 1.
void PolynomialSeries::boundSign(int node) {
  const Plan& v = plan_[at(node)];
  const double value = f_[v.f];
  if (isAlong_ && isApart_[at(node)] != 0) {
    rho0_[at(node)] = rho1_[at(node)] = 0;
    return;
  }
  if (given_[at(node)]) {
    mayCross(v.a);  // for what it reaches
    rho0_[at(node)] = magnitude(*given_[at(node)] - Interval(value)) * bounds::up;
    rho1_[at(node)] = 0;
    return;
  }
  const bool isOnOneSide = side_[at(v.a)] != 0;
  double radius = !isOnOneSide && (mayCross(v.a) || std::fabs(value) != 1) ? 1 + std::fabs(value) : 0.0;
  if (v.primary) {
    if (radius > jump_[at(node)]) hasJumped_ = true;
    radius = jump_[at(node)] = std::max(radius, jump_[at(node)]);
  }
  rho0_[at(node)] = radius * bounds::up;
  rho1_[at(node)] = 0;
}

void PolynomialSeries::giveSign(int jump, const Interval& sign, const Interval& argument, double about) {
  given_[at(jump)] = sign;
  about_[at(jump)] = about;
  const std::size_t u = at(plan_[at(jump)].a);
  isCalm_[u] = 1;
  side_[u] = argument.lower() >= 0 ? 1 : argument.upper() <= 0 ? -1 : 0;
}

void PolynomialSeries::forgetCrossings() {
  std::fill(crossing_.begin(), crossing_.end(), 0.0);
  for (const int jump : jumps_) given_[at(jump)].reset();
  std::ranges::fill(isCalm_, 0);
  std::ranges::fill(side_, 0.0);
  std::ranges::fill(passed_, 0.0);
}

bool PolynomialSeries::giveSide(int kink, double side) {
  reached_[at(plan_[at(kink)].a)] = 0;
  return noteSide(side_, kink, side);
}

bool PolynomialSeries::noteSide(std::vector<double>& sides, int kink, double side) {
  const std::size_t u = at(plan_[at(kink)].a);
  isCalm_[u] = 1;
  return std::exchange(sides[u], side) != side;
}

Interval PolynomialSeries::rangeOf(int i, double error) const {
  const double radius = (rest(i) + top_[at(i)] + lowOf(i) + error) * bounds::up;
  return Interval(f_[plan_[at(i)].f]) + Interval(-radius, radius);
}

bool PolynomialSeries::adaptToCrossings() {
  crossing_ = reached_;
  return std::ranges::any_of(crossing_, [](double half) { return half > 0; });
}

int PolynomialSeries::symbolAcross() const {
  int symbol = -1;
  double most = 0;
  for (std::size_t u = 0; u < crossing_.size(); ++u) {
    if (!(crossing_[u] > 0)) continue;
    const Plan& v = plan_[u];
    std::vector<double> mass(at(monomials_->symbols()), 0.0);
    for (int g = 1; g < v.count; ++g) monomials_->addMass(g, std::fabs(f_[v.f + at(g * stride_)]), mass);
    for (std::size_t l = 0; l < mass.size(); ++l)
      if (const double share = mass[l] / crossing_[u]; share > most && share * crossing_[u] > 4 * atStart_[u])
        most = share, symbol = static_cast<int>(l);
  }
  return symbol;
}

void PolynomialSeries::forgetJumps() {
  std::fill(jump_.begin(), jump_.end(), 0.0);
  hasJumped_ = false;
}

bool PolynomialSeries::bound(const double* E, bool primaryOnly) {
  for (System& system : systems_) system.isBounded = false;
  isAlong_ = E == nullptr;
  haste_ = 0;
  Work::count(Work::boundedNode, 0.5 * nodes_);
  for (int i = 0; i < time_; ++i) {
    const bool state = i < n_;
    rho0_[at(i)] = !state ? radius_[at(i)] : E != nullptr ? E[i] : 0.0;
    if (!state && E == nullptr && (knowsParameters_ || varies_[at(i - n_)] != 0)) rho0_[at(i)] = 0;
    rho1_[at(i)] = state ? top_[at(i)] : 0.0;  // the order that x keeps and nodes do not
  }
  for (int node = time_ + 1; node < nodes_; ++node) {
    if (plan_[at(node)].constant) rho0_[at(node)] = knowsParameters_ ? 0.0 : radius_[at(node)];
    if (primaryOnly && !plan_[at(node)].primary) continue;
    if (!boundNode(node)) return refuse(node);
  }
  return true;
}

bool PolynomialSeries::boundWithoutRadii() {
  knowsParameters_ = true;
  const bool isBounded = bound(nullptr, true);
  knowsParameters_ = false;
  return isBounded;
}

void PolynomialSeries::keepAlong() {
  along0_ = rho0_;
  along1_ = rho1_;
}

bool PolynomialSeries::refuse(int node) {
  obstacle_ = node;
  return false;
}

std::string PolynomialSeries::nearestEdge(double within) const {
  int nearest = -1;
  for (int i = 0; i < nodes_; ++i) {
    const Plan& v = plan_[at(i)];
    if (domainOf(v.op) == Domain::everywhere) continue;
    const double* argument = series(v.a);
    if (const double edge = -argument[0] / argument[1]; edge > 0 && edge < within) nearest = i, within = edge;
  }
  return nearest < 0 ? "" : edgeOf(nearest);
}

std::string PolynomialSeries::edgeOf(int node) const {
  const Op op = plan_[at(node)].op;
  if (op == Op::solution) return "a linear system that may be singular";
  return std::string(isFunction(op) ? withFunction<FlowFunction>(op, [](auto f) { return f.edge; })
                                    : AnyFlowFunction::edge);
}

/// Σ_α |c_{iα}|.
double PolynomialSeries::orderNorm(const Plan& v, int i) const {
  double sum = 0;
  if (isByGrades_)
    for (int q = 0; q <= v.degree; ++q) sum += sums_[v.t + at(q * stride_ + i)];
  else
    for (int g = 0; g < v.count; ++g) sum += std::fabs(f_[v.f + at(g * stride_ + i)]);
  return sum;
}

double PolynomialSeries::derivativeNorm(const Plan& v, int k, double theta) const {
  double sum = 0, power = 1;
  for (int i = k; i <= last(); ++i, power *= theta) {
    double factor = 1;
    for (int j = 0; j < k; ++j) factor *= i - j;
    sum += factor * orderNorm(v, i) * power;
  }
  return sum * bounds::up + bounds::tiny;
}

/// y = chord - ½ (σ - from)(to - σ) ÿ(somewhere), so y leaves it by -share²/8 times a value of ÿ or of zero. About the
/// middle ÿ = Σ_α ÿ_α(middle) ξ^α + at most half times the third derivative; Horner's scheme for ÿ_α has 2m roundings,
/// one more in i(i-1)c, and one for a second double.
Interval PolynomialSeries::sag(int node, double from, double to, double second, double third, double more) const {
  const Plan& v = plan_[at(node)];
  const double middle = 0.5 * (from + to), half = std::max(to - middle, middle - from) * bounds::up;
  double leading = 0, others = 0;
  hornerRows(
      &f_[v.f], v.count, stride_, 2, last(), middle, [](int i, double c) { return i * (i - 1) * c; },
      [&](int g, double sum) { (g == 0 ? leading : others) += g == 0 ? sum : std::fabs(sum); });
  others = (others + half * third + (2 * m_ + 3) * bounds::unit * second + more) * bounds::up;
  const double share = to - from, eighth = share * share / 8, most = (second + more) * bounds::up;
  const auto bound = [&](double slope) {
    const double curvature = std::min(most, slope + others + bounds::unit * std::fabs(slope));
    return std::max(0.0, curvature) * eighth * bounds::up + bounds::tiny;
  };
  return Interval(-bound(leading), bound(-leading));
}

double PolynomialSeries::jacobianBound(int i, int j) const {
  const int node = outputs_[at(n_ + i * n_ + j)];
  const double bound = (norm_[at(node)] + lowOf(node) + rho0_[at(node)] + rho1_[at(node)]) * bounds::up;
  return bound > 0 ? bound + bounds::tiny : 0.0;  // never so small that balancing it would underflow
}

/// c + (‖ṽ‖ - |c|) + ρ of the constant coefficient c: of a negative one ‖ṽ‖ + ρ - 2|c|, one rounding of the difference.
double PolynomialSeries::dampingBound(int i) const {
  const double c = f_[plan_[at(outputs_[at(n_ + i * n_ + i)])].f], bound = jacobianBound(i, i);
  return c < 0 ? bound * (1 + 0x1p-50) - 2 * std::fabs(c) * bounds::down : bound;
}

/// a + ½bθ of the coefficients a + bσ of 1; |a| + ½|b|θ of the norm is then no part of the spread, but for two
/// roundings.
double PolynomialSeries::jacobianCentre(int i, int j, double theta, double& spread) const {
  const Plan& v = plan_[at(outputs_[at(n_ + i * n_ + j)])];
  const double a = f_[v.f], b = v.constant || last() < 1 ? 0.0 : 0.5 * theta * f_[v.f + 1];
  const double bound = jacobianBound(i, j), known = (std::fabs(a) + std::fabs(b)) * bounds::down;
  spread = bound == 0 ? 0.0 : std::max(0.0, bound * (1 + 0x1p-50) - known) + bound * 0x1p-50;
  return a + b;
}

void PolynomialSeries::frameDefect(int i, int j, double& nu0, double& nu1) const {
  double z0 = 0, z1 = 0, rounding = 0;
  int terms = 0;
  for (int k = 0; k < n_; ++k) {
    const int a = outputs_[at(n_ + i * n_ + k)], b = frameNode(k, j);
    if (isKnownZero(a)) continue;
    ++terms;
    const double ra0 = meanRho0(a) + lowOf(a), ra1 = meanRho1(a), top = top_[at(b)];
    z0 += norm_[at(b)] * ra0 + (ra0 + ra1) * top;
    z1 += norm_[at(b)] * ra1 + norm_[at(a)] * top + tailTime(a, b);
    if (monomials_->degree() > 0) z0 += tailDegree(a, b, frameDegree_, 0);
    rounding += weighted_[at(a)] * weighted_[at(b)];
  }
  // A sum of `terms` products has at most terms·N roundings a term, and one more in the division by i+1.
  nu0 = (z0 + (terms + 1) * bounds::unit * rounding) * bounds::up + bounds::tiny;
  nu1 = z1 * bounds::up;
}

}  // namespace gamut
