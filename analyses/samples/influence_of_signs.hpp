// What each sign of a motion whose equations jump does to the rates of the signs' arguments. Surfaces may depend on
// each other: where two blocks rest on the floor and rub at each other, two of their three speeds being zero, the third
// is. Of such jumps as many are held as are independent, and the others are left to these.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

template <class Real>
class InfluenceOfSigns {
 public:
  /// f must have jumps.
  explicit InfluenceOfSigns(const Program& f)
      : states_(detail::at(f.states())), count_(jumpsOf(f).size()), given_(withSignsGiven(f)) {}

  void setParameters(std::span<const Real> p) { parameters_.assign(p.begin(), p.end()); }

  /// On these sides, those that are held taken at zero.
  void evaluate(const Real& t, std::span<const Real> x, std::span<const Side> sides) {
    std::vector<Real> signs;
    for (const Side side : sides) signs.push_back(Real(side == Side::held ? 0.0 : static_cast<double>(side)));
    influence_.assign(count_ * count_, Real(0.0));
    for (std::size_t k = 0; k < count_; ++k) {
      const std::vector<Real> above = rates(t, x, signs, k, Real(1.0)), below = rates(t, x, signs, k, Real(-1.0));
      for (std::size_t j = 0; j < count_; ++j) influence_[j * count_ + k] = (above[j] - below[j]) / 2;
    }
  }

  /// Of its own sign on a jump: the size of rates that matter to it.
  Real own(std::size_t k) const {
    using std::abs;
    return abs(influence_[k * count_ + k]);
  }
  /// Whether a rate is no more than what inexact arithmetic leaves of it.
  bool isNothing(const Real& rate, std::size_t k) const {
    using std::abs;
    return abs(rate) <= small() * own(k);
  }
  static Real small() {
    using std::sqrt;
    return sqrt(Real(std::numeric_limits<Real>::epsilon()));
  }

  /// Whether jump k stays where it is while those `held` are, whatever its own sign.
  bool isLeftTo(std::span<const std::size_t> held, std::size_t k) const {
    if (held.empty() || own(k) == 0) return false;
    std::vector<Real> matrix, column;
    for (const std::size_t i : held) {
      for (const std::size_t j : held) matrix.push_back(influence_[i * count_ + j]);
      column.push_back(influence_[i * count_ + k]);
    }
    LinearSystem<Real>(MatrixKind::general, static_cast<int>(held.size()), std::move(matrix)).solve(column);
    Real left = influence_[k * count_ + k];
    for (std::size_t i = 0; i < held.size(); ++i) left = left - influence_[k * count_ + held[i]] * column[i];
    return isNothing(left, k);
  }

 private:
  std::vector<Real> rates(const Real& t, std::span<const Real> x, const std::vector<Real>& signs, std::size_t k,
                          const Real& sign) {
    std::vector<Real> p = parameters_, all(states_ + 2 * count_, Real(0.0));
    p.insert(p.end(), signs.begin(), signs.end());
    p[parameters_.size() + k] = sign;
    given_.setParameters(p);
    given_(t, x, all);
    return {all.end() - static_cast<std::ptrdiff_t>(count_), all.end()};
  }

  std::size_t states_, count_;
  Evaluator<Real> given_;
  std::vector<Real> parameters_;
  std::vector<Real> influence_;  // row by row one argument, one column a sign
};

}  // namespace gamut
