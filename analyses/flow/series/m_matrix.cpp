// M-matrices by a positive vector.
#include "analyses/flow/series/m_matrix.hpp"

#include <algorithm>

#include "analyses/flow/series/error_bounds.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

double* Amplifier::matrix(int size) {
  n_ = size;
  for (auto* matrix : {&H_, &Y_, &next_}) matrix->resize(at(n_ * n_));
  for (auto* vector : {&w_, &v_, &Hv_}) vector->resize(at(n_));
  return H_.data();
}

/// Some v > 0 and the share < 1 for which H v ≤ share v, which proves that I - H is an M-matrix; 1 if none is found: v
/// = Σ_k H^k w for any w > 0; in the units of x, so that few terms do: the greatest entries of C's rows.
double Amplifier::contraction(const std::vector<double>& C) {
  for (int i = 0; i < n_; ++i) {
    w_[i] = 0;
    for (int j = 0; j < n_; ++j) w_[i] = std::max(w_[i], C[i * n_ + j]);
    v_[i] = w_[i];
  }
  double share = 1;
  for (int iteration = 0; iteration < 40 && share >= 0.9; ++iteration) {
    if (iteration > 0)
      for (int i = 0; i < n_; ++i) v_[i] = w_[i] + Hv_[i];
    share = 0;
    for (int i = 0; i < n_; ++i) {
      double s = 0;
      for (int j = 0; j < n_; ++j) s += H_[i * n_ + j] * v_[j];
      Hv_[i] = s * bounds::up + bounds::tiny;
      if (!(v_[i] > 0 && v_[i] < bounds::largest)) return 1;
      share = std::max(share, Hv_[i] / v_[i] * bounds::up);
    }
  }
  return share;
}

bool Amplifier::bound(const std::vector<double>& C) {
  for (std::size_t i = 0; i < C.size(); ++i)
    if (!(H_[i] < bounds::largest && C[i] < bounds::largest)) return false;
  const double share = contraction(C);
  if (!(share < 0.99)) return false;
  // Y about (I - H)⁻¹|C|, column by column; Z = Y + s v obeys Z ≥ |C| + H Z where s (1 - share) v ≥ |C| + H Y - Y.
  for (std::size_t i = 0; i < C.size(); ++i) Y_[i] = C[i];
  for (double left = share, iteration = 0; iteration < 20 && (iteration == 0 || left > 1e-4);
       ++iteration, left *= share) {
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) {
        double s = C[i * n_ + j];
        for (int k = 0; k < n_; ++k) s += H_[i * n_ + k] * Y_[k * n_ + j];
        next_[i * n_ + j] = s;
      }
    std::copy_n(next_.begin(), Y_.size(), Y_.begin());
  }
  for (int j = 0; j < n_; ++j) {
    double shift = 0;
    for (int i = 0; i < n_; ++i) {
      double s = C[i * n_ + j];
      for (int k = 0; k < n_; ++k) s += H_[i * n_ + k] * Y_[k * n_ + j];
      const double defect = s * bounds::up + bounds::tiny - Y_[i * n_ + j];
      if (defect > 0) shift = std::max(shift, defect / (v_[i] * (1 - share)) * bounds::up);
    }
    for (int i = 0; i < n_; ++i) {
      Y_[i * n_ + j] = (Y_[i * n_ + j] + shift * v_[i]) * bounds::up;
      if (!(Y_[i * n_ + j] < bounds::largest)) return false;
    }
  }
  return true;
}

}  // namespace gamut
