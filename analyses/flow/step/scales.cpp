// Errors carried back through the linearised motion, in parts of it.
#include "analyses/flow/step/scales.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"

namespace gamut {

void FlowScales::add(double t, std::vector<double> sizes, std::vector<double> turned) {
  steps_.push_back({t, std::move(sizes), std::move(turned)});
}

void FlowScales::finish() {
  constexpr std::size_t parts = 6;  // few: what is lost is lost once a part
  const std::size_t every = std::max<std::size_t>(steps_.size() / parts, 1);
  Eigen::MatrixXd turned;
  Eigen::VectorXd goal;
  for (std::size_t k = steps_.size(); k-- > 1;) {
    const auto n = static_cast<Eigen::Index>(steps_[k].sizes.size());
    if (k % every == 0 || k + 1 == steps_.size()) {
      turned = Eigen::MatrixXd::Identity(n, n);
      goal = Eigen::Map<const Eigen::VectorXd>(steps_[k].sizes.data(), n);
    }
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    turned = turned * Eigen::Map<const RowMajor>(steps_[k].turned.data(), n, n);
    Eigen::VectorXd alone = Eigen::VectorXd::Constant(n, bounds::largest);
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = 0; i < n; ++i)
        if (goal(j) > 0 && turned(j, i) != 0) alone(i) = std::min(alone(i), goal(j) / std::fabs(turned(j, i)));
    double share = 1;
    for (Eigen::Index j = 0; j < n; ++j)
      if (goal(j) > 0) share = std::min(share, goal(j) / turned.row(j).cwiseAbs().dot(alone));
    for (Eigen::Index i = 0; i < n; ++i) {
      double& size = steps_[k - 1].sizes[i];
      if (share > 0 && alone(i) < bounds::largest) size = std::max(size, share * alone(i));
    }
  }
}

double FlowScales::of(std::size_t i, double t) const {
  if (steps_.empty()) return 0;
  const auto later = std::ranges::upper_bound(steps_, t, {}, &Step::t);
  if (later == steps_.begin()) return later->sizes[i];
  if (later == steps_.end()) return steps_.back().sizes[i];
  return std::min(std::prev(later)->sizes[i], later->sizes[i]);
}

}  // namespace gamut
