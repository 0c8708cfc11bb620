#include "mechanics/equations/unfolding.hpp"

#include <algorithm>
#include <ranges>
#include <stdexcept>
#include <utility>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/program/differentiation.hpp"

namespace gamut {
namespace {

/// d/dt of numbers of the states and of time that change by these rates.
std::vector<Recorded> changes(const std::vector<Recorded>& of, std::span<const Recorded> x, const Recorded& time,
                              const std::vector<Recorded>& rates) {
  Recorder& recorder = *Recorder::current();
  std::vector<int> nodes;
  for (const Recorded& value : of) nodes.push_back(value.node());
  std::vector<std::pair<int, int>> seeds = {{time.node(), recorder.constant(1.0)}};
  for (std::size_t i = 0; i < rates.size(); ++i) seeds.emplace_back(x[i].node(), rates[i].node());
  std::vector<Recorded> found;
  for (const int node : tangents(recorder, nodes, seeds)) found.push_back(Recorded::node(node));
  return found;
}

}  // namespace

template <class S>
Unfolding<S>::Unfolding(std::vector<Struck> struck, std::size_t firstSpeed, System<S>& system)
    : firstSpeed_(firstSpeed), system_(system) {
  for (Struck& of : struck) folds_.push_back({std::move(of)});
  if (!isEmpty() && system.isConstrained())
    throw UnfitPart(
        folds_.front().of.end.coordinate,
        "the joint '" + folds_.front().of.end.coordinate + "' strikes a rigid end in a machine with constraints",
        "an elastic end (joint-stop), or a machine without constraints");
}

template <class S>
std::vector<S> Unfolding<S>::signsAt(const std::vector<S>& x) const {
  std::vector<S> signs;
  for (const auto& [end, position, speed] : std::views::transform(folds_, &Fold::of))
    for (const S& rising : {S(x[position] - end.at), x[speed]})
      signs.push_back(signOf(end.isUpper ? S(-rising) : rising));
  return signs;
}

template <class S>
void Unfolding<S>::fold(std::vector<S>& x, const std::vector<S>& signs, bool isSmooth,
                        const std::function<void(const std::vector<S>&)>& move) {
  using std::abs;
  for (std::size_t k = 0; k < folds_.size(); ++k) {
    Fold& fold = folds_[k];
    const S &side = signs[2 * k], &way = signs[2 * k + 1], one(1.0), half(0.5);
    const auto& [end, position, speed] = fold.of;
    const S v = x[speed];
    // |g| and 1/|g| before and behind the end
    const S before = end.startsAway ? S(one / end.restitution) : one, behind = end.startsAway ? one : end.restitution;
    const S most = half * (before + behind), least = half * (before - behind);
    const S slower = half * (one / behind + one / before), faster = half * (one / behind - one / before);
    const S beyond = x[position] - end.at;
    x[position] = isSmooth      ? S(end.at + side * beyond)
                  : end.isUpper ? S(end.at - abs(beyond))
                                : S(end.at + abs(beyond));
    x[speed] = (most * side - least * way) * v;
    fold.pace = (most - least * (side * way)) * v;
    fold.scaleRate = most * side - least * way - one;
    fold.inverse = slower * side + faster * way;
    fold.surplus = fold.scaleRate * v;
  }
  if (isEmpty() || system_.degreesOfFreedom() == 1) return;
  move(x);
  const auto m = system_.inertiaMatrix();
  for (Fold& fold : folds_) findShares(fold, m);
  for (const Fold& fold : folds_)
    for (std::size_t j = 0; j < fold.shares.size(); ++j)
      if (!isKnownZero(fold.shares[j])) x[firstSpeed_ + j] = x[firstSpeed_ + j] + fold.shares[j] * fold.surplus;
}

/// Σ_j M_kj c_j = −M_ki for all k ≠ i.
template <class S>
void Unfolding<S>::findShares(Fold& fold, const Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>& m) const {
  const auto i = static_cast<Eigen::Index>(fold.of.speed - firstSpeed_);
  std::vector<S> entries, shares;
  for (Eigen::Index k = 0; k < m.rows(); ++k) {
    if (k == i) continue;
    shares.push_back(-m(k, i));
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      if (j != i) entries.push_back(m(k, j));
  }
  LinearSystem<S>(MatrixKind::positiveDefinite, static_cast<int>(shares.size()), std::move(entries)).solve(shares);
  shares.insert(shares.begin() + i, S(0.0));
  if constexpr (std::is_same_v<S, Recorded>)
    for (const Fold& other : folds_)
      if (&other != &fold && !isKnownZero(shares[other.of.speed - firstSpeed_]))
        throw UnfitPart(other.of.end.coordinate,
                        "an impulse at the rigid end of '" + fold.of.end.coordinate + "' moves the joint '" +
                            other.of.end.coordinate + "', which has a rigid end too",
                        "an elastic end (joint-stop) for one of them");
  fold.shares = std::move(shares);
}

template <class S>
void Unfolding<S>::unfold(std::vector<S>& rates, std::span<const S> x,
                          const S& time) const requires std::same_as<S, Recorded> {
  const std::vector<S> accelerations = rates;
  for (const Fold& fold : folds_) {
    rates[fold.of.position] = fold.pace;
    rates[fold.of.speed] = accelerations[fold.of.speed] * fold.inverse;
  }
  std::vector<S> moved(rates.begin(), rates.begin() + static_cast<std::ptrdiff_t>(firstSpeed_));
  for (const Fold& fold : folds_) {
    if (fold.shares.empty()) continue;
    const std::vector<S> shareRates = changes(fold.shares, x, time, moved);
    for (std::size_t j = 0; j < fold.shares.size(); ++j)
      if (!isKnownZero(fold.shares[j]))
        rates[firstSpeed_ + j] = rates[firstSpeed_ + j] - shareRates[j] * fold.surplus -
                                 fold.shares[j] * (fold.scaleRate * rates[fold.of.speed]);
  }
}

GAMUT_COMPILED_HERE(Unfolding)

std::vector<Recorded> ofBothSides(std::vector<Recorded> signs,
                                  const std::function<std::vector<Recorded>(const std::vector<Recorded>&)>& what,
                                  std::size_t first) {
  if (first == std::min<std::size_t>(signs.size(), 4)) return what(signs);
  const Recorded sign = std::exchange(signs[first], 1.0);
  std::vector<Recorded> found = ofBothSides(signs, what, first + 1);
  signs[first] = -1.0;
  const std::vector<Recorded> other = ofBothSides(signs, what, first + 1);
  const Recorded share = 0.5 + 0.5 * sign, otherShare = 0.5 - 0.5 * sign;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!isKnownSame(found[i], other[i])) found[i] = share * found[i] + otherShare * other[i];
  return found;
}

}  // namespace gamut
