// The certificate, second part: bounds for every node, from what each adds itself (polynomial_series_errors.cpp, whose
// notation this is) and what its operands have. Also what follows from them: chords, the Jacobian, the frame's defect.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/horner.hpp"
#include "analyses/flow/series/operations/all.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/work.hpp"

namespace gamut {

namespace {

/// What a sum is twice, or its negative: x or y, of a sum of x ± y and |x ∓ y|, either with any sign, where the
/// argument of |x ∓ y| is on one side; -1 if it is none. Then what the other one leaves open is in neither: as
/// polynomials the sum is 2x or 2y but for what its two operands and the argument add themselves.
struct SidedExtreme {
  int one = -1, plain = -1, kink = -1;
};
template <class Plan, class Kinks>
SidedExtreme sidedExtreme(const Plan& plan, const Kinks& kinks, const SeriesNode& sum) {
  for (const bool isFirst : {true, false}) {
    const int kink = isFirst ? sum.a : sum.b, plain = isFirst ? sum.b : sum.a;
    if (plan[kink].op != Op::abs || !kinks[kink].isSided) continue;
    const SeriesNode &s = plan[plain], &u = plan[plan[kink].a];
    const auto isSum = [](const SeriesNode& n) { return n.op == Op::add || n.op == Op::sub; };
    if (!isSum(s) || !isSum(u) || s.op == u.op) continue;
    const bool isSwapped = s.a == u.b && s.b == u.a;
    if (s.a == s.b || !(isSwapped || (s.a == u.a && s.b == u.b))) continue;
    // Signs of s.a and s.b in the sum, once from `plain`, once from ±u.
    const double ofPlain = sum.op == Op::sub && isFirst ? -1 : 1;
    const double ofKink = (sum.op == Op::sub && !isFirst ? -1 : 1) * kinks[kink].chord.slope;
    const double a = ofPlain + ofKink * (isSwapped && u.op == Op::sub ? -1 : 1);
    return {a != 0 ? s.a : s.b, plain, kink};
  }
  return {};
}

/// The √d of a node atan(y √(1/d)²), as angles of two coordinates have them; or -1.
int rootOfHalfAngle(const SeriesPlan& plan, const SeriesNode& angle) {
  if (angle.op != Op::atan) return -1;
  for (std::vector<int> open{angle.a}; !open.empty();) {
    const SeriesNode& factor = plan[open.back()];
    open.pop_back();
    if (factor.op == Op::mul) open.push_back(factor.b);
    if (factor.op == Op::mul || factor.op == Op::neg) open.push_back(factor.a);
    if (factor.op != Op::sqr || plan[factor.a].op != Op::recip) continue;
    if (const int root = plan[factor.a].a; plan[root].op == Op::sqrt) return root;
  }
  return -1;
}

/// Whether d, or 1 + y² / d² in the angle's derivative, is what this node divides by, or has the root of.
bool isOfHalfAngle(const SeriesPlan& plan, int node) {
  const int of = plan[node].op == Op::recip ? plan[node].a : node;
  for (int i = 0; i < plan.ofProgram; ++i)
    if (const int root = rootOfHalfAngle(plan, plan[i]); root >= 0 && (of == root || of == plan[i].b || of == i))
      return true;
  return false;
}

}  // namespace

bool PolynomialSeries::boundNode(int node) {
  const SeriesNode& v = plan_[node];
  const Operands of{*this, isFine(node)};
  SeriesError z;
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
      if (norm_[node] == 0 && isNothing(v)) break;
      if (const auto [one, plain, kink] = sidedExtreme(plan_, kinks_, v); one >= 0) {
        z = {2 * of.r0(one) + own_[plain].e0 + own_[plan_[kink].a].e0 + own_[kink].e0 + own_[node].e0, 2 * of.r1(one)};
        break;
      }
      z = {of.r0(v.a) + of.r0(v.b) + own_[node].e0, of.r1(v.a) + of.r1(v.b)};
      break;
    case Op::neg:
      z = {of.r0(v.a) + own_[node].e0, of.r1(v.a)};
      break;
    case Op::mul:
    case Op::sqr: {  // ab - ãb̃ = ã δb + b̃ δa + δa δb
      const int b = v.op == Op::sqr ? v.a : v.b;
      z = {norm_[v.a] * of.r0(b) + norm_[b] * of.r0(v.a) + of.r(v.a) * of.r(b) + own_[node].e0,
           norm_[v.a] * of.r1(b) + norm_[b] * of.r1(v.a) + own_[node].e1};
      break;
    }
    default:
      return withFunction<FlowFunction>(v.op, [&](auto f) { return f.bound(*this, node, of); });
  }
  return setBounds(node, z);
}

/// Whether a sum is |u| + u, or |u| - u, where that is zero: exactly, whatever is known of u.
bool PolynomialSeries::isNothing(const SeriesNode& sum) const {
  const auto is = [&](int kink, int u, double sign) {
    return plan_[kink].op == Op::abs && plan_[kink].a == u && kinks_[kink].isSided && kinks_[kink].chord.slope == sign;
  };
  const double cancelling = sum.op == Op::add ? -1 : 1;
  return is(sum.a, sum.b, cancelling) || is(sum.b, sum.a, cancelling);
}

bool PolynomialSeries::mayCross(int u) {
  return kinks_.mayCross(u, leading(u), rest(u), moved(u), (rho_[u].e0 + rho_[u].e1) * bounds::up, haste_);
}

void PolynomialSeries::keepAtStart() {
  std::vector<double> uncertain;
  for (const SeriesError& rho : rho_) uncertain.push_back(rho.e0);
  kinks_.keepAtStart(uncertain);
}

Interval PolynomialSeries::rangeOf(int i, double error) const {
  const double radius = (rest(i) + top_[i] + lowOf(i) + error) * bounds::up;
  return Interval(leadingOf(i)) + Interval(-radius, radius);
}

int PolynomialSeries::symbolAcross() const {
  int symbol = -1;
  double most = 0;
  for (int u = 0; u < plan_.ofProgram; ++u) {
    const double crossing = kinks_.argument(u).crossing;
    if (!(crossing > 0)) continue;
    const SeriesNode& v = plan_[u];
    std::vector<double> mass(monomials().symbols(), 0.0);
    for (int g = 1; g < v.count; ++g) monomials().addMass(g, std::fabs(series(v, g)[0]), mass);
    for (std::size_t l = 0; l < mass.size(); ++l)
      if (const double share = mass[l] / crossing; share > most && share * crossing > 4 * kinks_.atStart(u))
        most = share, symbol = static_cast<int>(l);
  }
  return symbol;
}

bool PolynomialSeries::bound(const double* E, bool primaryOnly) {
  for (System& system : systems_) system.isBounded = false;
  isAlong_ = E == nullptr;
  haste_ = 0;
  Work::count(Work::boundedNode, 0.5 * plan_.ofProgram);
  for (int i = 0; i < plan_.time; ++i) {
    const bool state = i < plan_.states;
    rho_[i].e0 = !state ? radius_[i] : E != nullptr ? E[i] : 0.0;
    if (!state && E == nullptr && (knowsParameters_ || varies_[i - plan_.states] != 0)) rho_[i].e0 = 0;
    rho_[i].e1 = state ? top_[i] : 0.0;  // the order that x keeps and nodes do not
  }
  for (int node = plan_.time + 1; node < plan_.ofProgram; ++node) {
    if (plan_[node].constant) rho_[node].e0 = knowsParameters_ ? 0.0 : radius_[node];
    if (primaryOnly && !plan_[node].primary) continue;
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

bool PolynomialSeries::refuse(int node) {
  obstacle_ = node;
  return false;
}

std::string PolynomialSeries::nearestEdge(double within) const {
  int nearest = -1;
  for (int i = 0; i < plan_.ofProgram; ++i) {
    const SeriesNode& v = plan_[i];
    if (domainOf(v.op) == Domain::everywhere) continue;
    const double* argument = series(v.a);
    if (const double edge = -argument[0] / argument[1]; edge > 0 && edge < within) nearest = i, within = edge;
  }
  return nearest < 0 ? "" : edgeOf(nearest);
}

std::string PolynomialSeries::edgeOf(int node) const {
  const Op op = plan_[node].op;
  if (op == Op::solution) return "a linear system that may be singular";
  if (isOfHalfAngle(plan_, node)) return "an angle of two coordinates (atan2) that may be half a turn, where it jumps";
  return std::string(isFunction(op) ? withFunction<FlowFunction>(op, [](auto f) { return f.edge; })
                                    : AnyFlowFunction::edge);
}

/// Σ_α |c_{iα}|.
double PolynomialSeries::orderNorm(const SeriesNode& v, int i) const {
  double sum = 0;
  if (plan_.isByGrades)
    for (int q = 0; q <= v.degree; ++q) sum += grades_.sums[v.t + at(q * stride() + i)];
  else
    for (int g = 0; g < v.count; ++g) sum += std::fabs(series(v, g)[i]);
  return sum;
}

double PolynomialSeries::derivativeNorm(const SeriesNode& v, int k, double theta) const {
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
  const SeriesNode& v = plan_[node];
  const double middle = 0.5 * (from + to), half = std::max(to - middle, middle - from) * bounds::up;
  double leading = 0, others = 0;
  hornerRows(
      series(v), v.count, stride(), 2, last(), middle, [](int i, double c) { return i * (i - 1) * c; },
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
  const int node = plan_.jacobian(i, j);
  const double bound = (norm_[node] + lowOf(node) + rho_[node].e0 + rho_[node].e1) * bounds::up;
  return bound > 0 ? bound + bounds::tiny : 0.0;  // never so small that balancing it would underflow
}

/// c + (‖ṽ‖ - |c|) + ρ of the constant coefficient c: of a negative one ‖ṽ‖ + ρ - 2|c|, one rounding of the difference.
double PolynomialSeries::dampingBound(int i) const {
  const double c = leadingOf(plan_.jacobian(i, i)), bound = jacobianBound(i, i);
  return c < 0 ? bound * (1 + 0x1p-50) - 2 * std::fabs(c) * bounds::down : bound;
}

/// a + ½bθ of the coefficients a + bσ of 1; |a| + ½|b|θ of the norm is then no part of the spread, but for two
/// roundings.
double PolynomialSeries::jacobianCentre(int i, int j, double theta, double& spread) const {
  const SeriesNode& v = plan_[plan_.jacobian(i, j)];
  const double a = series(v)[0], b = v.constant || last() < 1 ? 0.0 : 0.5 * theta * f_[v.f + 1];
  const double bound = jacobianBound(i, j), known = (std::fabs(a) + std::fabs(b)) * bounds::down;
  spread = bound == 0 ? 0.0 : std::max(0.0, bound * (1 + 0x1p-50) - known) + bound * 0x1p-50;
  return a + b;
}

SeriesError PolynomialSeries::frameDefect(int i, int j) const {
  double z0 = 0, z1 = 0, rounding = 0;
  int terms = 0;
  for (int k = 0; k < plan_.states; ++k) {
    const int a = plan_.jacobian(i, k), b = plan_.frameNode(k, j);
    if (plan_[a].isZero) continue;
    ++terms;
    const SeriesError mean = meanRho(a);
    const double ra0 = mean.e0 + lowOf(a), ra1 = mean.e1, top = top_[b];
    z0 += norm_[b] * ra0 + (ra0 + ra1) * top;
    z1 += norm_[b] * ra1 + norm_[a] * top + tailTime(a, b);
    if (isGraded()) z0 += tailDegree(a, b, plan_.frameDegree, 0);
    rounding += weighted_[a] * weighted_[b];
  }
  // A sum of `terms` products has at most terms·N roundings a term, and one more in the division by i+1.
  return SeriesError{z0 + (terms + 1) * bounds::unit * rounding, z1}.up();
}

}  // namespace gamut
