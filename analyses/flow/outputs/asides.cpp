// Every node carries how far it is from its polynomial while states and inputs are as far from theirs as they may be.
#include "analyses/flow/outputs/asides.hpp"

#include <cmath>
#include <utility>

#include "analyses/flow/series/embedded.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

FlowAsides::FlowAsides(const Program& values, std::shared_ptr<const Monomials> monomials,
                       std::shared_ptr<const Monomials> ofStates, const std::vector<int>& varying,
                       const std::atomic<bool>* cancelled)
    : values_(values),
      layout_(std::move(monomials)),
      series_(values_, values.outputs(), layout_, 0, 1, false, cancelled),
      range_(layout_) {
  series_.setVarying(varying);
  for (int m = 0; m < ofStates->count(); ++m) place_.push_back(layout_->find(*ofStates, m));
}

std::vector<Interval> FlowAsides::enclose(double t, const FlowPoint& point, const std::vector<Interval>& states,
                                          const std::vector<Embedded>& parameters) {
  std::vector<double> polynomial, away;
  for (int i = 0; i < values_.states(); ++i) {
    polynomial.assign(layout_->count(), 0.0);
    for (std::size_t m = 0; m < place_.size(); ++m) polynomial[place_[m]] = point.p[at(i) * place_.size() + m];
    series_.setState(i, polynomial.data());
    away.push_back((point.radius[i] + std::fabs(point.low[i])) * bounds::up);
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) series_.setParameter(static_cast<int>(i), parameters[i]);
  series_.compute(t, 1.0);
  series_.kinks().forgetJumps();
  // The first bound of values that jump says where they may.
  const bool isBounded = series_.tabulate(1.0) && (!series_.kinks().hasJumps() || series_.bound(away.data(), true)) &&
                         series_.bound(away.data(), true);
  std::vector<Interval> found(values_.outputs(), Interval::entire());
  const Box whole(at(layout_->symbols()), Interval(-1.0, 1.0));
  constexpr double tolerance = 1e-3;  // of what is shown, not compared
  for (std::size_t o = 0; isBounded && o < found.size(); ++o) {
    const int node = series_.outputNode(static_cast<int>(o));
    const double radius = (series_.rho0(node) + series_.rho1(node)) * bounds::up;
    for (int g = 0; g < layout_->count(); ++g) polynomial[g] = series_.series(node)[g * series_.stride()];
    if (std::isfinite(radius)) found[o] = inflated(range_(polynomial.data(), whole, tolerance), radius);
  }
  if (!isBounded) series_.clear();
  if (isBounded && !series_.hasKinks() && !series_.kinks().hasJumps()) return found;
  if (!plain_) plain_.emplace(values_);  // knows more at kinks, and of the others where one has no value for some ξ
  const Box ranges = rangesOf(parameters);
  for (std::size_t o = 0; o < found.size(); ++o)
    found[o] = intersection(found[o], plain_->over(static_cast<int>(o), Interval(t), states, ranges));
  return found;
}

}  // namespace gamut
