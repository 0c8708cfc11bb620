// Is a requirement met? For every value of the uncertain quantities, for some, for none; how probable that is, how
// possible that it is not, and how far the quantities may be from their nominal values. All of it is proved, by
// bisecting the box and looking at a flow's models (cells.hpp).
#pragma once

#include <atomic>
#include <cstddef>
#include <limits>
#include <vector>

#include "analyses/probability/joint_masses.hpp"
#include "analyses/requirements/cells.hpp"
#include "analyses/uncertainty.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// A quantity that is constant in time: which number of the box it is.
struct CellQuantity {
  int component = 0;
  const Uncertain* uncertain = nullptr;
};

struct RequirementOptions {
  double gap = 0.002;             ///< between the bounds of the probability, aimed at
  double factorGap = 0.002;       ///< of the factor
  std::size_t mostCells = 40000;  ///< in each search
  double mostBytes = 3e8;
  double mostWork = std::numeric_limits<double>::infinity();  ///< of all searches, about (work.hpp)
  /// By the models' symbols; needed where quantities depend on each other or more than one distribution is possible.
  const JointMasses* masses = nullptr;
  const std::atomic<bool>* cancelled = nullptr;  ///< set from outside: what was found until then holds
};

/// Of what is met or violated by single values of the quantities, whatever varies in time does.
struct RequirementFinding {
  bool isAlwaysMet = false, isNeverMet = false;
  double met = 0, violated = 0;    ///< at least these parts of the box's volume
  Interval probability{0.0, 1.0};  ///< that it is met, whichever distributions the quantities have together
  Interval violationPossibility{0.0, 1.0};
  /// It is met for all values whose deviations from nominal are up to so many times those of their intervals; 1: all.
  double factor = 0;
  std::vector<double> violating;  ///< values for which it is proved to be violated, one a quantity; or empty
  std::vector<double> doubtful;   ///< values for which it most likely is, where that is not proved; or empty
  std::size_t cells = 0;          ///< that were looked at
};

/// What cells are asked for: what is said of these quantities holds whatever all else is.
CellQuestion withBesides(const FlowModels& models, CellQuestion question, const std::vector<CellQuantity>& quantities);

/// `quantities`: all numbers of the box with a symbol in the models, and those without that are uncertain.
RequirementFinding examine(const FlowModels& models, const CellQuestion& question,
                           const std::vector<CellQuantity>& quantities, const RequirementOptions& options = {});

/// How many times the deviations from nominal may be those of the intervals, at most 1, so that it is certainly met;
/// only those of the quantities that `deviate` names are made less, all others are what they are.
double guaranteedFactor(const FlowModels& models, const CellQuestion& question,
                        const std::vector<CellQuantity>& quantities, const std::vector<char>& deviate,
                        const RequirementOptions& options = {});

/// Encloses the greatest such part, at most 1, where one quantity alone deviates less: with the lower end it is
/// certainly met; beyond the upper end, if that is below 1, there are values that violate it. 0: these alone of the
/// others do, whatever that quantity is.
Interval factorAlone(const FlowModels& models, const CellQuestion& question,
                     const std::vector<CellQuantity>& quantities, std::size_t quantity,
                     const RequirementOptions& options = {});

}  // namespace gamut
