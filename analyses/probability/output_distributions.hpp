// The distribution functions of several outputs at several times, bounded as closely as work allows: of all coarsely
// first, which tells what the polynomials are good for; then the widest more closely, by tighter polynomials where
// those keep bounds apart.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "analyses/probability/model_masses.hpp"
#include "analyses/probability/output_distribution.hpp"
#include "analyses/surrogate/tightened_surrogate.hpp"

namespace gamut {

class Communicator;

struct OutputDistributionsOptions {
  double gap = 0.005;  ///< between the bounds, aimed at
  int jobs = 1;        ///< threads
  const std::atomic<bool>* cancelled = nullptr;
  /// That may still be done (work.hpp), of which a fifth is left to others. Has to be there.
  std::function<double()> workLeft;
  std::function<void(double)> progress = {};  ///< from any thread
  Communicator* communicator = nullptr;       ///< of the ranks that share it out, if any
};

class OutputDistributions {
 public:
  /// Of the surrogate's outputs, but for those marked as `nothing`, at these output times, rising.
  OutputDistributions(std::vector<std::size_t> rows, std::vector<char> nothing, OutputDistributionsOptions options);

  /// What was found until it was cancelled, or memory failed (std::bad_alloc), holds.
  void find(TightenedSurrogate& surrogate, ModelMasses& masses);

  /// Of the time-th of the times; empty where nothing is known.
  const DistributionBounds& at(std::size_t time, std::size_t output) const { return found_[time * outputs() + output]; }
  /// Whether more work would bring some of them closer, that are farther apart than was aimed at.
  bool isLimited() const { return isLimited_; }
  /// Whether errors of the polynomials keep bounds apart: more than is asked for, and not less than all else does.
  bool isVague(const TightenedSurrogate& surrogate) const;
  /// Into so many cells one of them may cut the box; where there are few, into `mostOfFew`.
  std::size_t mostCells() const;
  static constexpr std::size_t mostOfFew = 4096;

 private:
  bool isCancelled() const { return options_.cancelled != nullptr && *options_.cancelled; }
  std::size_t outputs() const { return nothing_.size(); }
  bool tighten(TightenedSurrogate& surrogate);
  /// How far apart errors of the polynomials alone keep the i-th bounds, about.
  double leftByErrors(const TightenedSurrogate& surrogate, std::size_t i) const;
  void boundAll(const TightenedSurrogate& surrogate, ModelMasses& masses, double share, double coarsest, double finest);
  void boundThese(std::span<const std::size_t> these, const TightenedSurrogate& surrogate, const JointMasses& masses,
                  double gap, double work);

  struct Tried {
    double work = 0;         // that might be done, the last time for the gap that is asked for
    bool isLimited = false;  // by that
    bool mayHelp = true;     // to do it with more, or for a smaller gap
  };
  std::vector<std::size_t> rows_;
  std::vector<char> nothing_;
  OutputDistributionsOptions options_;
  std::vector<DistributionBounds> found_;  // [time][output]
  std::vector<Tried> tried_;
  bool isLimited_ = false;
};

}  // namespace gamut
