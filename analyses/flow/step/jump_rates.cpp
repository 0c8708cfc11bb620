#include "analyses/flow/step/jump_rates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analyses/flow/series/embedded.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/horner.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

namespace {

/// Of each jump the rate of its argument with the sign 1, and with -1; then all arguments. Signs, others in rates, are
/// parameters behind f's.
Program ratesOf(const FlowJumps& jumps) {
  const Program& given = jumps.given;
  const int n = given.states(), count = static_cast<int>(jumps.count()), k = given.parameters() - count;
  Recorder recorder(n, k + count);
  std::vector<int> parameters, outputs;
  for (int i = 0; i < k + count; ++i) parameters.push_back(recorder.parameter(i));
  for (int jump = 0; jump < count; ++jump)
    for (const double sign : {1.0, -1.0}) {
      std::vector<int> values = parameters;
      values[k + jump] = recorder.constant(sign);
      const std::vector<int> here = recorder.append(given, values);
      outputs.push_back(here[given.outputNodes()[n + count + jump]]);
    }
  const std::vector<int> here = recorder.append(given, parameters);
  for (int jump = 0; jump < count; ++jump) outputs.push_back(here[given.outputNodes()[n + jump]]);
  return recorder.finish(outputs);
}

}  // namespace

/// u̇ is affine in the sign s: from u̇_b to u̇_-b, f as well, so that it is zero at f_b + u̇_b/(u̇_b - u̇_-b) (f_-b - f_b).
Program heldPushOf(const FlowJumps& jumps, std::size_t jump, double before) {
  const Program& given = jumps.given;
  const int n = given.states(), count = static_cast<int>(jumps.count());
  Recorder recorder(n, given.parameters());
  const auto outputsWith = [&](double sign) {
    std::vector<int> values, outputs;
    for (int i = 0; i < given.parameters(); ++i) values.push_back(recorder.parameter(i));
    values[detail::at(given.parameters() - count) + jump] = recorder.constant(sign);
    const std::vector<int> here = recorder.append(given, values);
    for (const int output : given.outputNodes()) outputs.push_back(here[output]);
    return outputs;
  };
  const std::vector<int> own = outputsWith(before), other = outputsWith(-before);
  const std::size_t rate = detail::at(n + count) + jump;
  const int share = recorder.mul(own[rate], recorder.recip(recorder.sub(own[rate], other[rate])));
  std::vector<int> outputs;
  for (std::size_t i = 0; i < detail::at(n); ++i)
    outputs.push_back(recorder.mul(share, recorder.sub(other[i], own[i])));
  return recorder.finish(outputs);
}

Program pressuresOf(const FlowJumps& jumps) {
  const Program& given = jumps.given;
  const int signs = given.parameters() - static_cast<int>(jumps.count());
  Recorder recorder(given.states(), given.parameters());
  std::vector<int> outputs;
  for (const RestingJumps& rest : jumps.rests) {
    std::vector<int> values;
    for (int i = 0; i < given.parameters(); ++i) values.push_back(recorder.parameter(i));
    values[detail::at(signs) + rest.position] = recorder.constant(rest.ofPosition(1));
    values[detail::at(signs) + rest.speed] = recorder.constant(rest.ofSpeed(-1));
    const std::vector<int> here = recorder.append(given, values);
    outputs.push_back(recorder.neg(here[given.outputNodes()[rest.states.speed]]));
  }
  return recorder.finish(outputs);
}

AlongStep::AlongStep(const Program& g, std::shared_ptr<const Monomials> monomials, int order, double length,
                     double resolution, const std::atomic<bool>* cancelled)
    : orders_(order + 1),
      series_(g, g.outputs(), std::move(monomials), 0, order + 1, false, cancelled),
      timeKinks_(g, length, resolution) {
  for (std::size_t i = 0; i < g.nodes().size(); ++i)
    if (g.nodes()[i].op == Op::abs) kinks_.emplace_back(static_cast<int>(i), linearFormOf(g, g.nodes()[i].a));
  if (!kinks_.empty()) g_ = g;
}

JumpRates::JumpRates(const FlowJumps& jumps, std::shared_ptr<const Monomials> monomials, int order, double length,
                     double resolution, const std::atomic<bool>* cancelled)
    : AlongStep(ratesOf(jumps), std::move(monomials), order, length, resolution, cancelled), jumps_(jumps.count()) {}

bool AlongStep::load(const PolynomialSeries& states, double t0, double scale, double theta,
                     const std::vector<Embedded>& parameters, const std::vector<Interval>& signs,
                     const std::vector<double>& tube) {
  for (int i = 0; i < states.states(); ++i) series_.setStateSeries(i, states.series(i), states.stride());
  compute(t0, scale, theta, parameters, signs);
  return isBounded(tube);
}

bool AlongStep::load(const std::vector<double>& states, double t0, double scale, double theta,
                     const std::vector<Embedded>& parameters, const std::vector<Interval>& signs,
                     const std::vector<double>& tube) {
  compute(states, t0, scale, theta, parameters, signs);
  return isBounded(tube);
}

void AlongStep::compute(const std::vector<double>& states, double t0, double scale, double theta,
                        const std::vector<Embedded>& parameters, const std::vector<Interval>& signs) {
  const std::size_t each = states.size() / detail::at(series_.states());
  for (int i = 0; i < series_.states(); ++i)
    series_.setStateSeries(i, &states[detail::at(i) * each], static_cast<int>(each) / series_.count());
  compute(t0, scale, theta, parameters, signs);
}

void AlongStep::compute(double t0, double scale, double theta, const std::vector<Embedded>& parameters,
                        const std::vector<Interval>& signs) {
  theta_ = theta;
  std::vector<Embedded> all = parameters;
  for (const Interval& sign : signs) all.push_back({midpoint(sign), 0, radius(sign)});
  for (std::size_t i = 0; i < all.size(); ++i) series_.setParameter(static_cast<int>(i), all[i]);
  series_.kinks().forgetCrossings();
  timeKinks_.giveSides(all, t0, t0 + theta * scale, series_);
  for (const auto& [u, side] : sides_)
    for (const int node : kinksOf(*u)) series_.kinks().giveSide(node, side);
  series_.compute(t0, scale);
}

/// The nodes |u|.
const std::vector<int>& AlongStep::kinksOf(const KinkArgument& u) {
  const auto [place, isNew] = kinksOfTaken_.try_emplace(&u);
  for (const auto& [node, form] : kinks_)
    if (isNew && (form ? u.form && isSameForm(*form, *u.form) : isArgument(u, *g_, g_->nodes()[node].a)))
      place->second.push_back(node);
  return place->second;
}

bool AlongStep::isBounded(const std::vector<double>& tube) {
  series_.kinks().forgetJumps();
  if (series_.tabulate(theta_) && series_.bound(tube.data(), true)) return true;
  series_.clear();
  return false;
}

/// Horner's method: 2(m + 1) roundings of what all coefficients are together, and one a monomial.
Interval AlongStep::atMoment(int node, double sigma) const {
  double leading = 0, others = 0;
  hornerRows(
      series_.series(node), series_.count(node), series_.stride(), 0, orders_ - 1, sigma,
      [](int, double c) { return c; },
      [&](int g, double sum) { (g == 0 ? leading : others) += g == 0 ? sum : std::fabs(sum); });
  const double roundings = (2 * orders_ + series_.count(node) + 2) * bounds::unit * series_.norm(node);
  return inflated(Interval(leading),
                  (others + roundings + series_.rho0(node) + series_.rho1(node)) * bounds::up + bounds::tiny);
}

/// Between two moments a polynomial is in the hull of what it is at both and its sag.
Interval AlongStep::over(int output, double from, double to) const {
  constexpr int parts = 8;
  const int node = series_.outputNode(output);
  Interval before = atMoment(node, from), result = before;
  if (to <= from) return result;
  const double second = series_.derivativeNorm(node, 2, theta_), third = series_.derivativeNorm(node, 3, theta_);
  double begin = from;
  for (int part = 1; part <= parts; ++part) {
    const double end = part == parts ? to : from + (to - from) * part / parts;
    const Interval then = atMoment(node, end);
    result = hull(result, hull(before, then) + series_.sag(node, begin, end, second, third, 0));
    before = then;
    begin = end;
  }
  return result;
}

/// Part by part, each as long as it can be proved, or half as long; as close as a 4096th of the way.
double AlongStep::awayUntil(int output, double side, double from, double to) const {
  const int node = series_.outputNode(output);
  const auto isAway = [&](const Interval& number) { return side > 0 ? number.lower() > 0 : number.upper() < 0; };
  Interval before = atMoment(node, from);
  if (!isAway(before)) return from;
  const double second = series_.derivativeNorm(node, 2, theta_), third = series_.derivativeNorm(node, 3, theta_);
  const double least = 0x1p-12 * (to - from);
  double reached = from;
  for (double length = to - from; reached < to && length >= least;) {
    const double end = std::min(reached + length, to);
    if (!(end > reached)) break;
    const Interval then = atMoment(node, end);
    if (isAway(then) && isAway(hull(before, then) + series_.sag(node, reached, end, second, third, 0))) {
      before = then;
      reached = end;
      length *= 2;
    } else {
      length *= 0.5;
    }
  }
  return reached;
}

}  // namespace gamut
