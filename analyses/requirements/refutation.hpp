// Whether single values violate a requirement: by thin flows, at the output times, and, where bounds in between leave
// doubt, at more and more instants.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "analyses/flow/models.hpp"
#include "analyses/requirements/cells.hpp"

namespace gamut {

/// What a flow of single values knows of the margins.
struct ThinMargins {
  std::shared_ptr<const FlowModels> models;
  std::vector<double> times;                     ///< s: rows of the models
  std::vector<std::vector<Interval>> over = {};  ///< [row][margin]: since the time before
};

/// What is asked of them: of `question` all but its rows.
struct ThinQuestion {
  CellQuestion question;
  double from = 0, until = 0;                    ///< s: the window
  std::vector<double> times = {};                ///< s: the output times, one at least
  bool looksBetween = false;                     ///< also at others
  const std::atomic<bool>* cancelled = nullptr;  ///< null: never
};

/// A proof that the values violate it, whatever else of the motion is not known.
struct Refutation {
  /// When it is missed most (of what must be met once: least), and by how much, as far as that is told; at an output
  /// time, if there is one.
  double time = std::numeric_limits<double>::quiet_NaN();
  std::optional<Interval> margin;
  bool isBetween = false;  ///< between output times alone is it proved
};

/// `flow`: their motion, with margins at these times. None where that is not proved, or once cancelled.
std::optional<Refutation> refute(const ThinQuestion& asked,
                                 const std::function<ThinMargins(const std::vector<double>&)>& flow);

}  // namespace gamut
