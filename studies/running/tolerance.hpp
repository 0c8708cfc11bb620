// How far the uncertain quantities of a study may deviate from their nominal values so that its requirements are met.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "scalars/interval.hpp"
#include "studies/machine.hpp"

namespace gamut {

struct ToleranceOptions {
  int jobs = 1;
  double most = 16;        ///< greater factors are not looked for
  double accuracy = 0.01;  ///< of a factor, relative
  double budget = 1800;    ///< work of all (analyses/work.hpp), in what is worth a second of CPU time
  std::function<void(double)> progress;
  const std::atomic<bool>* cancelled = nullptr;  ///< set from outside: what was found until then holds
};

/// Deviations `factor` times those of the intervals are proved to be allowed.
struct AllowedDeviation {
  std::string name;        ///< of the quantity; empty for all of them together
  double factor = 0;       ///< 0: none is; `most` of the options: none greater was looked for
  Interval interval{0.0};  ///< of one quantity: what it may then be
  std::string limit;       ///< the requirement that a greater factor is not proved of; or why that is not known
  bool isUnknown = false;  ///< the search was ended before
};

struct AllowedDeviations {
  std::string nominal;                  ///< the requirement that the nominal values violate; empty: none is known
  AllowedDeviation together;            ///< of all quantities
  std::vector<AllowedDeviation> alone;  ///< of each, where all others may be what they may
};

/// Throws std::invalid_argument for a study without requirements or without uncertain quantities.
AllowedDeviations findTolerances(const Machine& machine, const ToleranceOptions& options = {});

}  // namespace gamut
