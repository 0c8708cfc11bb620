#include "analyses/flow/tightened_models.hpp"

#include <utility>

#include "analyses/work.hpp"

namespace gamut {

TightenedModels::TightenedModels(std::shared_ptr<const FlowModels> models, double tightness, double work,
                                 Enclose enclose)
    : models_(std::move(models)),
      tightness_(tightness),
      firstTightness_(tightness),
      firstWork_(work),
      enclose_(std::move(enclose)) {}

bool TightenedModels::tighten(double times, double work, FlowOptions options) {
  constexpr double hardly = 0.5;  // of the first flow's
  isWorkDone_ = !(work > hardly * firstWork_);
  if (isWorkDone_ || !mayTighten()) return false;
  options.tightness = 1 + excess() / times;
  options.budget = work / Work::perSecond;
  const double tightness = options.tightness;
  const Tube tube = enclose_(std::move(options));
  isWorkDone_ = tube.why() == Tube::overBudget;
  const std::shared_ptr<const FlowModels>& found = tube.models();
  if (!found || found->at.size() < models_->at.size() || found->modelled < models_->modelled) return false;
  models_ = found;
  tightness_ = tightness;
  return true;
}

}  // namespace gamut
