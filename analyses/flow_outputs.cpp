// Taylor models of the outputs at one time, from those of the states.
#include "analyses/flow_outputs.hpp"

#include <cmath>
#include <limits>

#include "analyses/error_bounds.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

FlowOutputs::FlowOutputs(const Program& g, std::shared_ptr<const Monomials> monomials,
                         const std::atomic<bool>* cancelled)
    : differentiated_(g.differentiated()),
      n_(g.states()),
      outputs_(g.outputs()),
      monomials_(monomials->count()),
      series_(differentiated_, outputs_, std::move(monomials), 0, 1, false, cancelled) {
  polynomial_.assign(at(outputs_ * monomials_), 0.0);
  radius_.assign(at(outputs_), 0.0);
}

void FlowOutputs::evaluate(double t, const FlowPoint& point, const std::vector<double>& R,
                           const std::vector<Embedded>& parameters) {
  for (int i = 0; i < n_; ++i) series_.setState(i, &point.p[at(i * monomials_)]);
  for (std::size_t i = 0; i < parameters.size(); ++i) series_.setParameter(static_cast<int>(i), parameters[i]);
  series_.compute(t, 1.0);
  const double infinite = std::numeric_limits<double>::infinity();
  std::fill(radius_.begin(), radius_.end(), infinite);
  if (!series_.tabulate(1.0) || !series_.bound(nullptr, true)) {
    series_.clear();
    return;
  }
  std::vector<double> along(at(outputs_));
  for (int o = 0; o < outputs_; ++o) {
    const int node = series_.outputNode(o);
    for (int g = 0; g < monomials_; ++g)
      polynomial_[at(o * monomials_ + g)] = series_.series(node)[g * series_.stride()];
    along[at(o)] = series_.rho0(node) + series_.rho1(node);
  }
  // y - g(p) = G (x - p) with G in ∂g/∂x on the hull, |G - G₀| ≤ ρ:  |y - g(p)| ≤ Σ_j |(G₀Ψ₀)_j| R_j + what is left.
  if (!series_.bound(point.radius.data(), false)) return;
  for (int o = 0; o < outputs_; ++o) {
    double sum = along[at(o)];
    std::vector<double> centre(at(n_)), spread(at(n_));
    for (int k = 0; k < n_; ++k) {
      const int node = series_.outputNode(outputs_ + o * n_ + k);
      centre[at(k)] = series_.series(node)[0];
      spread[at(k)] =
          (series_.norm(node) - std::fabs(centre[at(k)]) * bounds::down + series_.rho0(node) + series_.rho1(node)) *
          bounds::up;
      sum += (std::fabs(centre[at(k)]) + spread[at(k)]) * point.loose[at(k)];
    }
    for (int j = 0; j < n_; ++j) {
      double along0 = 0, size = 0, rest = 0;
      for (int k = 0; k < n_; ++k) {
        const double psi0 = point.psi[at(k * n_ + j)];
        along0 += centre[at(k)] * psi0;
        size += std::fabs(centre[at(k)] * psi0);
        rest += spread[at(k)] * point.psiSum[at(k * n_ + j)] +
                std::fabs(centre[at(k)]) * (point.psiSum[at(k * n_ + j)] - std::fabs(psi0) * bounds::down);
      }
      sum += std::fabs(along0) * R[at(j)] + ((n_ + 1) * bounds::unit * size + rest) * point.total[at(j)];
    }
    // Σ over generators |G₀ (Ψ₀Γ)_j|; its rounding is (n+1) u |G₀||Ψ₀||Γ|, counted with `size` above.
    for (std::size_t column = 0; column < point.zonotope.size(); column += at(n_)) {
      double along0 = 0;
      for (int k = 0; k < n_; ++k) along0 += centre[at(k)] * point.zonotope[column + at(k)];
      sum += std::fabs(along0);
    }
    radius_[at(o)] = sum * bounds::up;
  }
}

}  // namespace gamut
