// The comparison system ẏ = A y + δ of a step, A ≥ |∂f/∂x|, or, of what is damped, with what is known of the sign of
// its diagonal: how far errors of the states can grow and reach into each other in h seconds, whatever the units of the
// states. docs/flow.md, section 2.
#pragma once

#include <vector>

namespace gamut {

class FlowGrowth {
 public:
  /// For n states and defects that grow like (σ/θ)^m.
  FlowGrowth(int n, int m);

  /// |∂f_i/∂x_j|, to be set before `compute`.
  double& A(int i, int j) { return A_[at(i, j)]; }
  /// ∂f_i/∂x_i at most, below zero where a state is damped; for the next `compute` alone, no more than A(i, i).
  double& diagonal(int i) { return diagonal_[static_cast<std::size_t>(i)]; }
  /// A constant matrix with the sign of its entries, by row, and how far ∂f/∂x is from it, |∂f/∂x - centre| ≤ spread:
  /// for the computes that follow; empty for none.
  void setCentre(const std::vector<double>& centre, const std::vector<double>& spread);
  /// The matrices below for h seconds; false if the system grows by more than e^60. B is A, or, if damping decides
  /// (isDamped), A with that diagonal; about a centre they are those of its flow where that is less (isAbout).
  bool compute(double h);
  bool isDamped() const { return isDamped_; }
  bool isAbout() const { return isAbout_; }

  double M0(int i, int j) const { return M0_[at(i, j)]; }  ///< ≥ e^{Bt} at every time t of the h seconds
  double M1(int i, int j) const { return M1_[at(i, j)]; }  ///< ≥ ∫ e^{Bt} over them, h Σ (Bh)^k/(k+1)!
  double M2(int i, int j) const { return M2_[at(i, j)]; }  ///< ≥ ∫ e^{B(h-t)} (t/h)^m, h Σ (Bh)^k m!/(m+k+1)!
  /// About the spectral radius of Ah, or how fast e^{Bt} grows in the h seconds: its exponent.
  double growth() const { return growth_; }
  /// The binary exponents of units in which A is balanced: x_i = 2^{units()[i]} z_i.
  const std::vector<int>& units() const { return unit_; }
  /// Where the next `compute` begins to balance; none: all 0.
  void setUnits(const std::vector<int>& units);

 private:
  std::size_t at(int i, int j) const { return static_cast<std::size_t>(i * n_ + j); }
  double balance(double h);
  void estimateGrowth();
  bool sumSeries();
  void toUnits(double h);
  bool computePlain(double h);
  bool computeDamped(double h);
  bool computeAbout(double h);
  double normOf(const std::vector<double>& a) const;
  std::vector<double> exponentialOf(const std::vector<double>& Z, int K);
  bool follow(double h);
  double exponentOf(const std::vector<double>& matrix);
  void integrate(double rate, std::vector<double>& exponential, std::vector<double>& integral);
  void multiply(const std::vector<double>& a, const std::vector<double>& b, std::vector<double>& product) const;

  int n_, m_;
  double growth_ = 0;
  bool isDamped_ = false, isAbout_ = false;
  std::vector<int> unit_, followedUnit_;
  std::vector<double> A_, diagonal_, M0_, M1_, M2_, X_, power_, next_, v_, w_, centre_, spread_;
  double followed_ = 0;              // seconds that the centre's flow is known for
  std::vector<double> P_, Q1_, Q2_;  // |e^{centre t}| at most, its integral, and that against (1 - t/h)^m, h = 1
};

}  // namespace gamut
