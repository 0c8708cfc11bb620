// SUNDIALS CVODE behind a pointer, so that nobody else includes SUNDIALS: one initial value problem after the other,
// of one sample or of a whole pack of samples that share their steps.
#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scalars/elementary/vector_unit.hpp"

namespace gamut {

/// Tolerances of CVODE's local error test: relative * |x| + absolute, for every state.
struct Tolerance {
  double relative = 1e-10;
  double absolute = 1e-12;

  /// So many times tighter, but relative no tighter than 1e-14: beyond that doubles end what a solver can do.
  Tolerance tightened(double factor) const;
};

/// CVODE's method family: Adams with functional iteration is the fastest for mechanisms without stiff springs; the
/// backward differentiation formulas with Newton iteration are for those with them.
enum class Method { adams, bdf };

/// How far an integration got.
struct Integration {
  /// Whys of where a motion is singular.
  static constexpr std::string_view stepsTooShort =
      "its steps became too short, as where the motion runs into a singularity or springs are too stiff";
  static constexpr std::string_view ratesNotFinite =
      "its accelerations are no finite numbers there, as where the motion is not determined";

  std::size_t times = 0;  ///< number of output times reached
  double reached = 0;     ///< s
  std::string why;        ///< if it ended early, what that means; otherwise empty
};

/// What CVODE integrates: ẋ = f(t, x), whatever the states stand for.
class CvodeProblem {
 public:
  virtual ~CvodeProblem() = default;
  /// rates = f(t, x). Rates that are no finite numbers make CVODE try a shorter step.
  virtual void differentiate(double t, std::span<const double> x, std::span<double> rates) = 0;
  /// Takes down the outputs of output time number i; false if one of them is not finite, which ends the integration.
  virtual bool observe(std::size_t i, double t, std::span<const double> x) = 0;
  /// Of outputs that observe could not take down: which is not finite.
  virtual std::string whatIsNotFinite() const { return "an output is not finite"; }

  /// How many functions of time and states end a piece of the motion where they fall below zero, since other equations
  /// hold from there on. The same number for all motions of a Cvode; packs have none.
  virtual std::size_t watched() const { return 0; }
  /// values: one a watched function.
  virtual void watch(double, std::span<const double>, std::span<double>) {}
  /// Those marked in `fallen` have come to zero at t and x, and are below at `later`: other equations hold from t on.
  /// Returns why there are none, or nothing.
  virtual std::string turn(double /*t*/, std::span<double> /*x*/, double /*later*/, std::span<const double> /*xLater*/,
                           std::span<const char> /*fallen*/) {
    return {};
  }
};

/// CVODE's memory for problems of one size. One a thread.
class Cvode {
 public:
  /// For `states` states of one sample.
  Cvode(std::size_t states, const std::vector<double>& times, Method method, const std::atomic<bool>* cancelled);
  /// For packs: packWidth samples in rows, one row a state, by Adams's method. A vector's norm is the greatest of its
  /// samples' norms: steps and iterations go on until every sample has what CVODE asks of a sample alone. The unit
  /// changes the speed, not the values.
  Cvode(std::size_t states, const std::vector<double>& times, VectorUnit unit, const std::atomic<bool>* cancelled);
  ~Cvode();
  Cvode(Cvode&&) noexcept;
  Cvode& operator=(Cvode&&) noexcept;

  /// From x at time 0 to each of the output times, CVODE beginning anew where equations turn; fails once it has taken
  /// `seconds` of CPU. No step passes over a whole one of the cells (TimeCells) that end at these times, rising to the
  /// last output time; none: steps are as long as the tolerance allows. The states depend on the arguments alone; how
  /// far they come, on `seconds` and `cancelled` too, and so on the machine.
  Integration integrate(CvodeProblem& problem, std::span<const double> x, const Tolerance& tolerance,
                        std::span<const double> cells = {}, double seconds = std::numeric_limits<double>::infinity());

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace gamut
