// One step of the flow: the set of one piece, its certified step, its values in between and its update. docs/flow.md
// states the theorem behind every function.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analyses/polynomial_range.hpp"
#include "analyses/polynomial_series.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// One uncertain number: value = centre + half·ξ_symbol ± radius (symbol -1: no dependence).
struct Embedded {
  double centre = 0, half = 0, radius = 0;
  int symbol = -1;
};

/// For every ξ in [-1,1]^k there are |r| ≤ R, |s_j| ≤ 1, |w| ≤ W with x(t; ξ) = p(ξ) + C(ξ) (r + Σ_j Γ_j s_j) + w.
/// Every step's local error becomes generators Γ_j of its own: boxes would wrap, zonotopes do not.
struct FlowSet {
  double t = 0;
  std::vector<double> p;  // [state][monomial]
  std::vector<double> C;  // [monomial ≤ frameDegree][row][column]
  std::vector<double> R, W;
  std::vector<double> generators;  // [generator][row], oldest first
  std::vector<Embedded> parameters;
  std::vector<double> centre, half;  // ξ of the study = centre + half·ξ of this piece (exact: dyadic)
  double nextStep = 0;               // s, a guess
  double caution = 1;                // factor on the step that the last coefficients suggest
};

/// p(σ), Ψ(σ) and what bounds their distance from the truth at one time of the step.
struct FlowPoint {
  std::vector<double> p;         // [state][monomial]
  std::vector<double> psi;       // [monomial][row][column]
  std::vector<double> psiSum;    // Σ_α |Ψ_α| [row][column]
  std::vector<double> zonotope;  // Ψ_0 Γ [generator][row]
  std::vector<double> total;     // R + Σ_j |Γ_j|
  std::vector<double> loose;     // everything but Ψ (r + Γs), a bound for each state
  std::vector<double> radius;    // |x - p| ≤ radius
};

enum class StepOutcome { stepped, splitWanted, failed };

/// Σ over grades in (above, below] of |p|, for each state, relative to Σ|p|; the largest of the states.
double relativeMass(const FlowSet& set, const Monomials& monomials, int above, int below);

/// Rewrites a set for monomials of another degree in the same symbols; what does not fit goes into W.
void changeDegree(FlowSet& set, const Monomials& from, int fromFrameDegree, const Monomials& to, int toFrameDegree);

/// Turns the remainder into n fresh symbols, one a principal axis of the zonotope: `to` has the symbols of `from` and n
/// more behind them. From then on it is kept to higher order than the first.
void expandRemainder(FlowSet& set, const Monomials& from, int fromFrameDegree, const Monomials& to, int toFrameDegree);

/// Steps sets of one layout (monomials, degrees, order). Holds the workspace: one a thread.
class FlowStepper {
 public:
  FlowStepper(const Program& motion, std::shared_ptr<const Monomials> monomials, int frameDegree, int order,
              double tolerance);

  /// Certifies a step from `set` that ends no later than `end`. A truncation defect in ξ above `splitDefect` per second
  /// (relative to the state; 0: any) is answered by splitWanted. h(), evaluate() and advance() refer to the step until
  /// the next call.
  StepOutcome certify(const FlowSet& set, double end, double quantum, double splitDefect);
  double h() const { return h_; }
  const std::string& why() const { return why_; }
  /// After a failure: the remainder, not ξ, makes the set too wide; bisecting ξ cannot help.
  bool isRemainderDominant(const FlowSet& set) const;

  /// The set τ seconds into the step, 0 ≤ τ ≤ h.
  void evaluate(const FlowSet& set, double tau, FlowPoint& point);
  /// How far p + Ψ (r + Γs) leaves its chord over a part of the step that is `length` seconds long, for each state:
  /// length²/8 times a bound of its second derivative.
  void bulge(double length, std::vector<double>& bound) const;
  /// The set at the end of the step.
  void advance(FlowSet& set);
  /// The greatest remainder of all states, relative to the state's size over the step.
  double relativeRemainder(const FlowSet& set) const;
  /// The symbol whose high powers weigh most in the step.
  int worstSymbol() const;
  /// Bisects `set` in a symbol; `set` becomes one half, the other is returned.
  FlowSet bisect(FlowSet& set, int symbol, const PolynomialRange& shift) const;

  const Monomials& monomials() const { return series_.monomials(); }
  int frameCount() const { return series_.frameCount(); }

 private:
  bool matrices(double h);
  bool tryStep(const FlowSet& set, double theta);
  void load(const FlowSet& set);
  double suggestion(double theta) const;
  bool isTruncationTooLarge(double splitDefect) const;

  int n_, m_;
  double tolerance_;
  PolynomialSeries series_;
  double h0_ = 0, h_ = 0, theta_ = 0;
  double timeError_ = 0, truncation_ = 0, growth_ = 0;
  double caution_ = 1;
  std::string why_;
  std::vector<double> A_, M0_, M1_, M2_, term_, next_;
  std::vector<double> delta0_, delta1_, start_, E_, y_, e1_, epsilon_, nu0_, nu1_, scale_;
  std::vector<double> total_;  // R + Σ_j |Γ_j| of the set being stepped
  FlowPoint end_;
};

}  // namespace gamut
