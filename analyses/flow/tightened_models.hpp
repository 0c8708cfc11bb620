// Models of outputs, tightened as far as work allows: where what a flow knew of outputs does not decide a question, a
// tighter flow over the same box may.
#pragma once

#include <functional>
#include <memory>

#include "analyses/flow/flow.hpp"
#include "analyses/flow/models.hpp"

namespace gamut {

class Archive;

class TightenedModels {
 public:
  /// Another flow over the same box, that keeps models of the same outputs.
  using Enclose = std::function<Tube(FlowOptions)>;

  TightenedModels() = default;
  /// `models`, if not null: of a flow of this tightness, which took so much work (work.hpp). Without `enclose` they
  /// stay as they are.
  TightenedModels(std::shared_ptr<const FlowModels> models, double tightness, double work, Enclose enclose = {});

  const std::shared_ptr<const FlowModels>& get() const { return models_; }
  const FlowModels& operator*() const { return *models_; }
  const FlowModels* operator->() const { return models_.get(); }
  explicit operator bool() const { return models_ != nullptr; }
  void reset() { models_.reset(); }

  /// How much wider than necessary outputs may be in the flow of the models, less one.
  double excess() const { return tightness_ - 1; }
  /// The same of the models that were there first.
  double firstExcess() const { return firstTightness_ - 1; }
  bool mayTighten() const { return models_ && enclose_; }
  /// Models by a flow of an excess so many times less, with at most so much work: they take the place of those that
  /// there are. False if it comes less far than these, or that is too little work: a tighter flow takes more than the
  /// first. `options`: all but tightness and budget.
  bool tighten(double times, double work, FlowOptions options);
  /// Whether the last try found too little work left.
  bool isWorkDone() const { return isWorkDone_; }
  /// But for what encloses.
  void archive(Archive& all);

 private:
  std::shared_ptr<const FlowModels> models_;
  double tightness_ = 1, firstTightness_ = 1, firstWork_ = 0;
  Enclose enclose_;
  bool isWorkDone_ = false;
};

}  // namespace gamut
