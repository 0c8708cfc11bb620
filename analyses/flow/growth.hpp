// The comparison system ẏ = A y + δ of a step, A ≥ |∂f/∂x|: how far errors of the states can grow and reach into each
// other in h seconds, whatever the units of the states. docs/flow.md, section 2.
#pragma once

#include <vector>

namespace gamut {

class FlowGrowth {
 public:
  /// For n states and defects that grow like (σ/θ)^m.
  FlowGrowth(int n, int m);

  /// |∂f_i/∂x_j|, to be set before `compute`.
  double& A(int i, int j) { return A_[at(i, j)]; }
  /// The matrices below for h seconds; false if the system grows by more than e^60.
  bool compute(double h);

  double M0(int i, int j) const { return M0_[at(i, j)]; }  ///< ≥ e^{Ah}
  double M1(int i, int j) const { return M1_[at(i, j)]; }  ///< ≥ h Σ (Ah)^k/(k+1)!
  double M2(int i, int j) const { return M2_[at(i, j)]; }  ///< ≥ h Σ (Ah)^k m!/(m+k+1)!
  /// About the spectral radius of Ah: how fast the system grows.
  double growth() const { return growth_; }
  /// The binary exponents of units in which A is balanced: x_i = 2^{units()[i]} z_i.
  const std::vector<int>& units() const { return unit_; }
  /// Where the next `compute` begins to balance; none: all 0.
  void setUnits(const std::vector<int>& units);

 private:
  std::size_t at(int i, int j) const { return static_cast<std::size_t>(i * n_ + j); }
  double balance(double h);

  int n_, m_;
  double growth_ = 0;
  std::vector<int> unit_;
  std::vector<double> A_, M0_, M1_, M2_, X_, power_, next_, v_, w_;
};

}  // namespace gamut
