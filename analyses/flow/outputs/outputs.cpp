// Taylor models of the outputs at one time and over a step, from those of the states.
#include "analyses/flow/outputs/outputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/flow/series/column_kernels.hpp"
#include "analyses/flow/series/embedded.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

namespace {

Program alone(const Program& g, int output) { return Recorder(g).finish({g.outputNodes()[output]}); }

std::vector<int> placesOf(const Monomials& monomials, const Monomials& among) {
  std::vector<int> places;
  for (int m = 0; m < monomials.count(); ++m) places.push_back(among.find(monomials, m));
  return places;
}

}  // namespace

FlowOutputs::FlowOutputs(const Program& g, std::shared_ptr<const Monomials> monomials,
                         std::shared_ptr<const Monomials> ofStates, const std::vector<int>& varying,
                         const std::atomic<bool>* cancelled, std::size_t signs)
    : g_(g),
      differentiated_(g.differentiated()),
      n_(g.states()),
      outputs_(g.outputs()),
      monomials_(monomials->count()),
      signs_(signs),
      layout_(std::move(monomials)),
      ofStates_(std::move(ofStates)),
      cancelled_(cancelled),
      series_(differentiated_, outputs_, layout_, 0, 1, false, cancelled),
      varying_(varying),
      place_(placesOf(*ofStates_, *layout_)),
      plain_(g) {
  series_.setVarying(varying_);
  polynomial_.assign(outputs_ * monomials_, 0.0);
  radius_.assign(outputs_, 0.0);
  driven_ = radius_;
}

void FlowOutputs::evaluate(double t, const FlowPoint& point, const std::vector<double>& R,
                           const std::vector<Embedded>& parameters) {
  if (evaluateTogether(t, point, R, parameters) || outputs_ == 1) return;
  if (apart_.empty())
    for (int o = 0; o < outputs_; ++o)
      apart_.emplace_back(alone(g_, o), layout_, ofStates_, varying_, cancelled_, signs_);
  for (int o = 0; o < outputs_; ++o) {
    FlowOutputs& own = apart_[o];
    own.evaluate(t, point, R, parameters);
    radius_[o] = own.radius(0);
    driven_[o] = own.driven(0);
    std::copy_n(own.polynomial(0), monomials_, &polynomial_[o * monomials_]);
  }
}

/// The states' polynomials in monomials of the outputs; the rest goes into both bounds: the mean-value form holds about
/// what is kept, with so much more that is loose.
void FlowOutputs::setStates(const FlowPoint& point, std::vector<double>& radius, std::vector<double>& loose) {
  for (int i = 0; i < n_; ++i) {
    state_.assign(monomials_, 0.0);
    double dropped = 0;
    for (std::size_t m = 0; m < place_.size(); ++m) {
      const double coefficient = point.p[at(i) * place_.size() + m];
      if (place_[m] < 0)
        dropped += std::fabs(coefficient);
      else
        state_[place_[m]] = coefficient;
    }
    for (auto* bound : {&radius, &loose})
      if (dropped > 0) (*bound)[i] = ((*bound)[i] + dropped) * bounds::up;
    series_.setState(i, state_.data());
  }
}

/// |g(p) - its polynomial|, of the set bounded last.
double FlowOutputs::alongOf(int output) const {
  const int node = series_.outputNode(output);
  return series_.rho0(node) + series_.rho1(node);
}

/// What signs that may be this or that do to outputs.
void FlowOutputs::countSigns(const std::vector<Embedded>& parameters, const std::vector<double>& along) {
  const auto firstSign = parameters.end() - static_cast<std::ptrdiff_t>(signs_);
  if (!std::any_of(firstSign, parameters.end(), [](const Embedded& sign) { return sign.radius > 0; })) return;
  const auto give = [&](bool withRadius) {
    for (auto sign = firstSign; sign != parameters.end(); ++sign)
      series_.setParameter(static_cast<int>(sign - parameters.begin()),
                           {sign->centre, 0, withRadius ? sign->radius : 0.0});
  };
  give(false);
  const bool isBounded = series_.bound(nullptr, true);
  for (int o = 0; o < outputs_ && isBounded; ++o) {
    const int node = series_.outputNode(o);
    driven_[o] = std::max(0.0, along[o] - series_.rho0(node) - series_.rho1(node));
  }
  give(true);
}

/// y - g(p) = G (x - p) with G in ∂g/∂x on the hull, |G - G₀| ≤ ρ:  |y - g(p)| ≤ Σ_j |(G₀Ψ₀)_j| R_j + what is left, but
/// for generators. Adds that to `sums`; returns G₀, all outputs' rows.
std::vector<double> FlowOutputs::addBeside(const FlowPoint& point, const std::vector<double>& R,
                                           const std::vector<double>& loose, std::vector<double>& sums) {
  std::vector<double> centre(outputs_ * n_);
  for (int o = 0; o < outputs_; ++o) {
    double& sum = sums[o];
    double* G = centre.data() + at(o * n_);
    std::vector<double> spread(n_);
    for (int k = 0; k < n_; ++k) {
      const int node = series_.outputNode(outputs_ + o * n_ + k);
      G[k] = series_.series(node)[0];
      spread[k] =
          (series_.norm(node) - std::fabs(G[k]) * bounds::down + series_.rho0(node) + series_.rho1(node)) * bounds::up;
      const double slope = std::fabs(G[k]) + spread[k];
      sum += slope * (loose[k] + point.beyond[k]);
      driven_[o] += slope * point.known[k];
    }
    for (int j = 0; j < n_; ++j) {
      double along0 = 0, size = 0, wide = 0, rest = 0;
      for (int k = 0; k < n_; ++k) {
        const double psi0 = point.psi[k * n_ + j];
        along0 += G[k] * psi0;
        size += std::fabs(G[k]) * point.psiSum[k * n_ + j];
        wide += spread[k] * point.psiSum[k * n_ + j];
        rest += std::fabs(G[k]) * (point.psiSum[k * n_ + j] - std::fabs(psi0) * bounds::down);
      }
      sum +=
          std::fabs(along0) * R[j] + ((2 * n_ + 4) * bounds::unit * size + wide) * point.total[j] + rest * point.ofR[j];
    }
  }
  return centre;
}

/// Σ over generators |G₀ (Ψ₀Γ)_j|; its rounding is (n+1) u |G₀||Ψ₀||Γ|, of inputs (n+5) u with their five symbols at
/// most (drivenRadius): both are counted with `size` above.
void FlowOutputs::addGenerators(const FlowPoint& point, const std::vector<double>& centre, std::vector<double>& sums) {
  const auto count = [&](std::size_t numbers) { return n_ > 0 ? static_cast<int>(numbers / at(n_)) : 0; };  // columns
  kernels::addProductSizes(centre.data(), outputs_, n_, point.zonotope.data(), count(point.ofErrors), sums.data());
  if (point.zonotope.size() <= point.ofErrors) return;
  const auto along0 = [&](const double* columns, std::size_t numbers) {  // [column][output]
    std::vector<double> result(count(numbers) * outputs_);
    kernels::multiplyColumns({{0, 0, 0}}, centre.data(), outputs_, n_, columns, count(numbers), result.data());
    return result;
  };
  std::vector<std::vector<double>> ofXi;
  for (const std::vector<double>& columns : point.drivenOfXi) ofXi.push_back(along0(columns.data(), columns.size()));
  const std::vector<double> own = along0(&point.zonotope[point.ofErrors], point.zonotope.size() - point.ofErrors);
  for (int o = 0; o < outputs_; ++o) {
    const double driven = drivenRadius(own, ofXi, at(o), at(outputs_)) * bounds::up;
    driven_[o] += driven;
    sums[o] += driven;
  }
}

/// False if one could not be bounded: then nothing is known of any.
bool FlowOutputs::evaluateTogether(double t, const FlowPoint& point, const std::vector<double>& R,
                                   const std::vector<Embedded>& parameters) {
  const auto beside = [&](std::vector<double> bound) {  // p alone is seen here
    for (std::size_t i = 0; i < bound.size(); ++i) bound[i] += std::fabs(point.low[i]);
    return bound;
  };
  std::vector<double> radius = beside(point.radius), loose = beside(point.loose);
  setStates(point, radius, loose);
  for (std::size_t i = 0; i < parameters.size(); ++i) series_.setParameter(static_cast<int>(i), parameters[i]);
  series_.compute(t, 1.0);
  std::fill(radius_.begin(), radius_.end(), std::numeric_limits<double>::infinity());
  series_.kinks().forgetJumps();
  if (!series_.tabulate(1.0) || (series_.kinks().hasJumps() && !series_.bound(radius.data(), true)) ||
      !series_.bound(nullptr, true)) {
    series_.clear();
    return false;
  }
  std::vector<double> along(outputs_);
  for (int o = 0; o < outputs_; ++o) {
    for (int g = 0; g < monomials_; ++g)
      polynomial_[o * monomials_ + g] = series_.series(series_.outputNode(o))[g * series_.stride()];
    along[o] = alongOf(o);
    driven_[o] = 0;
  }
  countSigns(parameters, along);
  if (!varying_.empty()) {  // inputs enter outputs themselves: |g(p, w) - g(p, centre)|
    const std::vector<double> none(n_, 0.0);
    if (!series_.bound(none.data(), true)) return false;
    for (int o = 0; o < outputs_; ++o) {
      driven_[o] += std::max(0.0, alongOf(o) - along[o]);
      along[o] = std::max(along[o], alongOf(o));
    }
  }
  if (!series_.bound(radius.data(), false)) return false;
  addGenerators(point, addBeside(point, R, loose, along), along);
  for (int o = 0; o < outputs_; ++o) radius_[o] = along[o] * bounds::up;
  return true;
}

FlowOutputChords::FlowOutputChords(const Program& g, std::shared_ptr<const Monomials> monomials,
                                   std::shared_ptr<const Monomials> ofStates, int order, double length,
                                   double resolution, const std::atomic<bool>* cancelled)
    : g_(g),
      differentiated_(g.differentiated()),
      n_(g.states()),
      outputs_(g.outputs()),
      order_(order + 1),
      layout_(std::move(monomials)),
      ofStates_(std::move(ofStates)),
      cancelled_(cancelled),
      series_(differentiated_, outputs_, layout_, 0, order_, false, cancelled),
      place_(placesOf(*ofStates_, *layout_)),
      length_(length),
      resolution_(resolution),
      timeKinks_(differentiated_, length, resolution),
      dependsOnTime_(dependsOnTime(g)),
      second_(at(outputs_)),
      third_(at(outputs_)),
      turn_(at(outputs_)),
      rest_(at(outputs_)) {}

/// Monomials that the outputs have besides are 0, those that they do not have are left out.
void FlowOutputChords::setState(int i, const double* series, int stride) {
  if (layout_->count() == ofStates_->count()) return series_.setStateSeries(i, series, stride);
  stateRows_.assign(layout_->count() * stride, 0.0);
  for (std::size_t m = 0; m < place_.size(); ++m)
    if (place_[m] >= 0) std::copy_n(&series[m * at(stride)], stride, &stateRows_[place_[m] * stride]);
  series_.setStateSeries(i, stateRows_.data(), stride);
}

/// The states' polynomials from the step's start, or moved: p(a + σ) by synthetic division, m times. Its coefficient k
/// is the sum of C(j, k) a^(j-k) p_j with 2m + 1 roundings a term at most, so all are off by no more than (2m + 2) u
/// Σ_j |p_j| (a + θ)^j together, σ in [0, θ].
FlowOutputChords::Part FlowOutputChords::partOf(const FlowStepper& stepper, double from, double to) const {
  const PolynomialSeries& states = stepper.series();
  constexpr double mostOfStep = 0.75;  // θ of a part stays below 1
  Part part;
  part.rounding.assign(n_, 0.0);
  if (!(to - from <= mostOfStep * stepper.h())) {
    part.to = stepper.h();
    part.theta = stepper.theta();
    for (int i = 0; i < n_; ++i) part.states.push_back(states.series(i));
    return part;
  }
  part.from = from;
  part.to = to;
  part.theta = (to - from) / stepper.scale() * bounds::up;
  const double a = from / stepper.scale(), end = a + part.theta;
  const int stride = states.stride(), count = states.count();
  for (int i = 0; i < n_; ++i) {
    part.moved.insert(part.moved.end(), states.series(i), states.series(i) + at(count * stride));
    double size = 0;
    for (int g = 0; g < count; ++g) {
      double* c = &part.moved[(i * count + g) * stride];
      double sum = 0;
      for (int j = order_; j-- > 0;) sum = sum * end + std::fabs(c[j]);
      size += sum;
      for (int k = 0; k + 1 < order_; ++k)
        for (int j = order_ - 1; j-- > k;) c[j] += a * c[j + 1];
    }
    part.rounding[i] = ((2 * order_ + 2) * bounds::unit * size + bounds::tiny) * bounds::up;
  }
  for (int i = 0; i < n_; ++i) part.states.push_back(&part.moved[i * count * stride]);
  return part;
}

/// As few orders in time as do: what is dropped of every state is small against what is uncertain about it. So are, in
/// all orders, monomials that outputs do not have: `dropped` bounds what is left out, for every σ and ξ.
int FlowOutputChords::orderFor(const FlowStepper& stepper, const Part& part, std::vector<double>& dropped) const {
  const int stride = stepper.series().stride(), count = stepper.series().count();
  const auto norm = [&](int i, int order, int from) {
    double sum = 0;
    for (int g = from; g < count; ++g) sum += std::fabs(part.states[i][g * stride + order]);
    return sum * std::pow(part.theta, order);
  };
  // What time itself moves is followed further than the states tell.
  constexpr int ofTime = 14;
  int order = dependsOnTime_ ? std::min(order_, ofTime) : PolynomialSeries::leastOrder;
  for (int i = 0; i < n_; ++i) {
    const double allowed = 1e-4 * (norm(i, 0, 1) + stepper.tubeBound(i));
    double tail = 0;
    int needed = order_;
    while (needed > order && (tail += norm(i, needed - 1, 0)) <= allowed) --needed;
    order = std::max(order, needed);
  }
  dropped = part.rounding;
  for (int i = 0; i < n_; ++i) {
    for (int k = order; k < order_; ++k) dropped[i] += norm(i, k, 0) * bounds::up;
    double sum = 0;
    for (int g = 0; g < count; ++g) {
      double ofOne = 0;
      for (int k = place_[g] < 0 ? order : 0; k-- > 0;)
        ofOne = ofOne * part.theta + std::fabs(part.states[i][g * stride + k]);
      sum += ofOne;
    }
    dropped[i] += sum * bounds::up;
  }
  return order;
}

/// Along one solution y = g(p) + G (x - p), G in ∂g/∂x between p and x, and x - p = Ψ v + loose with v constant. With
/// g̃, G̃ the polynomials in σ that are kept of g(p) and, without ξ, of G:  y = z + ε,  z = g̃ + G̃ Ψ v, |ε| ≤ |g(p) - g̃| +
/// |G - G̃| |x - p| + |G̃| |loose|. z leaves its chord as far as its second derivative allows; the chord of z is within
/// |ε| of that of y, as z is of y: together 2 |ε|.
void FlowOutputChords::load(const FlowStepper& stepper, double t0, const std::vector<Embedded>& parameters, double from,
                            double to) {
  loadPart(stepper, t0, parameters, partOf(stepper, from, to));
}

void FlowOutputChords::loadPart(const FlowStepper& stepper, double t0, const std::vector<Embedded>& parameters,
                                const Part& part) {
  isApart_ = !loadTogether(stepper, t0, parameters, part) && outputs_ > 1;
  if (!isApart_) return;
  if (apart_.empty())
    for (int o = 0; o < outputs_; ++o)
      apart_.emplace_back(alone(g_, o), layout_, ofStates_, order_ - 1, length_, resolution_, cancelled_);
  for (FlowOutputChords& own : apart_) own.loadPart(stepper, t0, parameters, part);
}

bool FlowOutputChords::loadTogether(const FlowStepper& stepper, double t0, const std::vector<Embedded>& parameters,
                                    const Part& part) {
  const PolynomialSeries& states = stepper.series();
  const double theta = part.theta, infinite = std::numeric_limits<double>::infinity();
  scale_ = stepper.scale();
  from_ = part.from;
  std::fill(rest_.begin(), rest_.end(), infinite);
  std::vector<double> dropped;
  series_.setOrder(orderFor(stepper, part, dropped));
  for (int i = 0; i < n_; ++i) setState(i, part.states[i], states.stride());
  for (std::size_t i = 0; i < parameters.size(); ++i) series_.setParameter(static_cast<int>(i), parameters[i]);
  series_.kinks().forgetCrossings();
  timeKinks_.giveSides(parameters, t0 + part.from, t0 + part.to, series_);
  series_.compute(t0 + part.from, scale_);  // exact: docs/flow.md, "Time"
  std::vector<double> own(outputs_), tube(at(n_));
  for (int i = 0; i < n_; ++i) tube[i] = (stepper.tubeBound(i) + dropped[i]) * bounds::up;
  series_.kinks().forgetJumps();
  if (!series_.tabulate(theta) || (series_.kinks().hasJumps() && !series_.bound(tube.data(), true)) ||
      !series_.bound(dropped.data(), true)) {
    series_.clear();
    return false;
  }
  for (int o = 0; o < outputs_; ++o) {
    const int node = series_.outputNode(o);
    own[o] = series_.rho0(node) + series_.rho1(node);
    second_[o] = series_.derivativeNorm(node, 2, theta);
    third_[o] = series_.derivativeNorm(node, 3, theta);
  }
  if (!series_.bound(tube.data(), false)) return false;
  // Σ_j |Ψ^{(k)}| total_j and all of |x - p|, for every state, over the whole step.
  std::vector<double> moved(3 * n_, 0.0), loose(at(n_));
  for (int i = 0; i < n_; ++i) {
    loose[i] = stepper.looseBound(i);
    for (int j = 0; j < n_; ++j)
      if (const double total = stepper.totalBound(j); total > 0)
        for (int k = 0; k < 3; ++k) moved[3 * i + k] += states.frameDerivativeNorm(i, j, k, stepper.theta()) * total;
  }
  for (int o = 0; o < outputs_; ++o) {
    double rest = own[o], turn = 0;
    for (int i = 0; i < n_; ++i) {
      const int G = series_.outputNode(outputs_ + o * n_ + i);
      const double norm = series_.norm(G), off = series_.rho0(G) + series_.rho1(G);
      rest += off * tube[i] + norm * loose[i];
      turn += series_.derivativeNorm(G, 2, theta) * moved[3 * i] +
              2 * series_.derivativeNorm(G, 1, theta) * moved[3 * i + 1] + norm * moved[3 * i + 2];
    }
    rest_[o] = 2 * rest * bounds::up;
    turn_[o] = turn * bounds::up;
  }
  return true;
}

void FlowOutputChords::sag(double from, double to, std::vector<FlowSag>& sags) const {
  sags.clear();
  if (isApart_) {
    for (const FlowOutputChords& one : apart_) {
      std::vector<FlowSag> own;
      one.sag(from, to, own);
      sags.push_back(own.front());
    }
    return;
  }
  const double begin = (from - from_) / scale_, end = (to - from_) / scale_;
  for (int o = 0; o < outputs_; ++o)
    sags.push_back(
        isBounded(o)
            ? FlowSag{series_.sag(series_.outputNode(o), begin, end, second_[o], third_[o], turn_[o]), rest_[o]}
            : FlowSag{Interval::entire(), 0});
}

}  // namespace gamut
