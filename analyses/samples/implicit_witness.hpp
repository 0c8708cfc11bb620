// A witness of motions whose equations are not solved for the rates: differential-algebraic equations of index 1, by
// SUNDIALS IDA (Hindmarsh et al., ACM TOMS 31, 2005), backward differentiation of variable order and step. Of a
// mechanism these are its forces and the multipliers of its loops (mechanics/balance.hpp): no mass matrix is solved,
// and no rate eliminated, so that it shares no more than the elements with what the flow and the samples follow.
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "analyses/samples/cvode.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// r(t, y, ẏ, p) = 0, v = g(t, y, p), watched at `times`.
struct ImplicitMotion {
  Program r;                      ///< of 2n states, y and then ẏ; n outputs
  Program g;                      ///< of n states and the parameters of r
  std::vector<bool> isAlgebraic;  ///< of each y: r does not know its rate
  std::vector<double> times;      ///< rising, s; the motion starts at 0
};

/// Integrates one motion after another. One a thread; it must not outlive the motion.
class ImplicitWitness {
 public:
  explicit ImplicitWitness(const ImplicitMotion& motion, const std::atomic<bool>* cancelled = nullptr);
  ~ImplicitWitness();
  ImplicitWitness(ImplicitWitness&&) noexcept;
  ImplicitWitness& operator=(ImplicitWitness&&) noexcept;

  /// `start`: y at time 0, where algebraic ones may be anything near; likewise all rates, from zero. values: row by row
  /// one output time, one column an output; NaN beyond what was reached.
  Integration integrate(std::span<const double> start, std::span<const double> parameters, const Tolerance& tolerance,
                        std::span<double> values);

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace gamut
