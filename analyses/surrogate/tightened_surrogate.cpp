#include "analyses/surrogate/tightened_surrogate.hpp"

#include <algorithm>
#include <utility>

namespace gamut {

TightenedSurrogate::TightenedSurrogate(TightenedModels& models, SurrogateForm form)
    : models_(&models), form_(std::move(form)), finest_(0x1p-10 * models.firstExcess()) {}

void TightenedSurrogate::take() {
  if (!*models_) return;
  surrogate_ = surrogateOf(**models_, form_.components, form_.from, form_.from + form_.outputs, form_.cancelled);
  constexpr double part = 1e-9;  // of the greatest value
  negligible_.assign(form_.outputs, 0.0);
  for (std::size_t i = 0; i < surrogate_.rows.size(); ++i)
    for (SurrogatePart& each : surrogate_.at[i])
      for (std::size_t k = 0; k < form_.outputs; ++k) {
        Interval& bound = each.outputs[k].bound;
        const Interval known = form_.known ? form_.known(surrogate_.rows[i], k) : Interval::entire();
        if (const Interval both = intersection(bound, known); !isEmpty(both)) bound = both;
        if (isBounded(bound)) negligible_[k] = std::max(negligible_[k], part * magnitude(bound));
      }
}

bool TightenedSurrogate::tighten(double work) {
  constexpr double times = 8;
  if (!models_->tighten(times, work, form_.tighter())) return false;
  take();
  return true;
}

const std::vector<SurrogatePart>* TightenedSurrogate::partsAt(std::size_t row) const {
  const auto place = std::ranges::lower_bound(surrogate_.rows, row);
  if (place == surrogate_.rows.end() || *place != row) return nullptr;
  return &surrogate_.at[place - surrogate_.rows.begin()];
}

std::size_t TightenedSurrogate::nearestRow(std::size_t row) const {
  const auto behind = std::ranges::lower_bound(surrogate_.rows, row);
  if (behind == surrogate_.rows.end()) return surrogate_.rows.back();
  return behind > surrogate_.rows.begin() && row - behind[-1] < *behind - row ? behind[-1] : *behind;
}

}  // namespace gamut
