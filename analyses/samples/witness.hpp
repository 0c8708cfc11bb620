// The independent witness: one motion at a time, integrated by SUNDIALS CVODE (Hindmarsh et al., ACM TOMS 31, 2005) in
// ordinary double arithmetic. With the validated flow it shares the mechanism and the outputs' Program; its equations
// are recorded apart (Motion::sampled), and are those of the flow only where that is one form. Where they jump, CVODE
// goes from one smooth piece to the next (SidesOfMotion).
#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "analyses/samples/cvode.hpp"
#include "scalars/program/program.hpp"
#include "scalars/program/resting.hpp"

namespace gamut {

/// ẋ = f(t, x, p), y = g(t, x, p), watched at `times`.
struct Motion {
  Program f;                  ///< one output a state; no states at all: y is a function of time and parameters
  Program g;                  ///< the states and parameters of f; one output a watched quantity
  Program sampled;            ///< f once more, recorded as suits samples; without outputs: f itself
  std::vector<double> times;  ///< output times, rising, s; the motion starts at 0
  std::vector<std::string> outputNames = {};  ///< for messages; one an output, or none
  std::vector<RestingPair> rests = {};        ///< of the states of f

  /// What samples, and their arbiter, integrate, and see: g, which has a value at angles of ±π too.
  const Program& forSamples() const { return sampled.outputs() > 0 ? sampled : f; }
  Program outputsForSamples() const;
  /// Says which of these outputs, the first, is not finite.
  std::string whatIsNotFinite(std::span<const double> outputs) const;
  /// Number of start values: the states, then the parameters.
  std::size_t startValues() const { return static_cast<std::size_t>(f.states() + f.parameters()); }
  std::size_t outputs() const { return static_cast<std::size_t>(g.outputs()); }
  /// The last output time, s.
  double horizon() const { return times.empty() ? 0 : times.back(); }
  /// Throws std::invalid_argument, saying what does not fit together.
  void check() const;
};

/// From this time [s] on a motion has these parameters.
struct ParameterChange {
  double time = 0;
  std::vector<double> parameters;
};

/// Integrates one motion after another. One a thread; it must not outlive the motion's programs.
class Witness {
 public:
  explicit Witness(const Motion& motion, Method method = Method::adams, const std::atomic<bool>* cancelled = nullptr);
  ~Witness();
  Witness(Witness&&) noexcept;
  Witness& operator=(Witness&&) noexcept;

  /// start: the initial values, then the parameters. trajectory: row by row one output time, one column an output;
  /// NaN beyond what was reached. The values depend on start and tolerance alone, not on what was integrated before;
  /// how far they come, on `seconds` and `cancelled` too.
  Integration integrate(std::span<const double> start, const Tolerance& tolerance, std::span<double> trajectory,
                        double seconds = std::numeric_limits<double>::infinity());
  /// The same where parameters change at times that rise from above 0; one that does so once does nothing else. Not of
  /// equations that jump.
  Integration integrate(std::span<const double> start, std::span<const ParameterChange> changes,
                        const Tolerance& tolerance, std::span<double> trajectory,
                        double seconds = std::numeric_limits<double>::infinity());

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace gamut
