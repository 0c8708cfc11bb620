// A surrogate of models that may be tightened: with them it becomes tighter.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "analyses/flow/tightened_models.hpp"
#include "analyses/surrogate/surrogate.hpp"

namespace gamut {

/// What it is made of, besides models.
struct SurrogateForm {
  std::vector<int> components;        ///< of the box, one a quantity
  std::size_t from = 0, outputs = 0;  ///< the first, and how many, of the models' outputs
  /// Where an output is known to be at an output time, whatever part of the box it is of; none: nowhere.
  std::function<Interval(std::size_t row, std::size_t output)> known;
  std::function<FlowOptions()> tighter;  ///< of flows that tighten the models
  const std::atomic<bool>* cancelled = nullptr;
};

class TightenedSurrogate {
 public:
  /// Empty until it is taken of the models, which have to live longer.
  TightenedSurrogate(TightenedModels& models, SurrogateForm form);
  /// Of the models as they are; where there are none, it stays empty.
  void take();

  const Surrogate& get() const { return surrogate_; }
  const Surrogate* operator->() const { return &surrogate_; }
  bool isNone() const { return surrogate_.rows.empty(); }
  /// Of an output time; null where there are none.
  const std::vector<SurrogatePart>* partsAt(std::size_t row) const;
  /// Where there were too many output times, not all have polynomials.
  std::size_t nearestRow(std::size_t row) const;
  /// What does not depend on anything uncertain is known to some roundings: of an output, what counts for nothing.
  double negligible(std::size_t output) const { return negligible_[output]; }

  bool mayTighten() const { return !isNone() && models_->mayTighten() && models_->excess() > finest_; }
  /// By a flow of an eighth of the excess, with at most so much work (work.hpp); false if that finds nothing tighter.
  bool tighten(double work);

 private:
  TightenedModels* models_;
  SurrogateForm form_;
  double finest_;  // excess that is never gone below
  Surrogate surrogate_;
  std::vector<double> negligible_;
};

}  // namespace gamut
