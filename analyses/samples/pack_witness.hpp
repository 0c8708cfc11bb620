// The witness for packs: as many samples at once as a pack holds, in the same steps of CVODE. The steps are those of
// the sample that needs the shortest, so every sample is integrated as accurately as alone, but at a fraction of the
// cost: a double pendulum's samples at a twelfth with AVX2 or AVX-512, at a sixth without (ensemble_benchmark).
#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <span>

#include "analyses/samples/witness.hpp"
#include "scalars/evaluation/sample_pack.hpp"

namespace gamut {

/// Integrates one pack after another by Adams's method. One a thread; it must not outlive the motion's programs.
class PackWitness {
 public:
  /// The unit changes the speed, not the values.
  explicit PackWitness(const Motion& motion, const std::atomic<bool>* cancelled = nullptr,
                       VectorUnit unit = usableUnits().back());
  ~PackWitness();
  PackWitness(PackWitness&&) noexcept;
  PackWitness& operator=(PackWitness&&) noexcept;

  /// starts: one row of packWidth a start value, the initial values, then the parameters; of a pack that is not full,
  /// fill the rest with copies of a sample. trajectories: packWidth values of the first output at the first output
  /// time, then of the next output, then the next time; to be used only if all times were reached, since it ends with
  /// the first sample that cannot go on. The values depend on starts and tolerance alone; how far they come, on
  /// `seconds` and `cancelled` too.
  Integration integrate(std::span<const double> starts, const Tolerance& tolerance, std::span<double> trajectories,
                        double seconds = std::numeric_limits<double>::infinity());

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace gamut
