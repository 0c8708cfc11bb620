// Results describe themselves, field by field: so they are archived.
#include "studies/running/run_memory.hpp"

#include <string>
#include <variant>
#include <vector>

#include "analyses/communicator.hpp"
#include "analyses/flow/archive.hpp"
#include "analyses/samples/archive.hpp"
#include "scalars/archive.hpp"
#include "studies/running/sample_keeper.hpp"

namespace gamut {

void archive(Archive& all, Grid& grid) { all(grid.extents, grid.data); }

namespace {

void archiveField(Archive& all, const FieldValue& value) {
  std::visit(Visitor{[&](const WholeText& text) { all(*text.text); }, [&](const Choice& choice) { all(*choice.value); },
                     [&](const Numbers& numbers) { std::visit([&](auto* holder) { all(*holder); }, numbers.holder()); },
                     [&](auto* single) { all(*single); }},
             value);
}

}  // namespace

void archiveGroups(Archive& all, const std::vector<Group>& groups) {
  for (const Group& group : groups) {
    std::size_t size = group.size;
    all(size);
    if (all.isReading()) group.resize(size);
    for (std::size_t i = 0; i < size; ++i)
      for (const Field& field : group.fields(i)) archiveField(all, field.value);
  }
}

void archive(Archive& all, Results& results) {
  archiveGroups(all, describe(results));
  ExtremeSamples& extremes = results.stochastic.extremes;  // said to be there once they are numbered
  SwitchingResult& switching = results.stochastic.switching;
  all(extremes.number, extremes.values, switching.entry, switching.number, switching.quantity, switching.from,
      switching.value);
}

void archive(Archive& all, Suspect& suspect) { all(suspect.values, suspect.sample, suspect.margin, suspect.violates); }

void Suspects::archive(Archive& all) { all(all_); }

void archive(Archive& all, KeptSamples& kept) {
  all(kept.present, kept.storage, kept.valuesEvery, kept.motionsEvery, kept.number, kept.values, kept.motionNumber,
      kept.motions);
}

void SampleKeeper::archive(Archive& all) { all(samples_, beside_); }

void archive(Archive& all, Enclosure& enclosure) {
  all(enclosure.reachedTimes, enclosure.reached, enclosure.why, enclosure.advice, enclosure.cause, enclosure.nonlinear,
      enclosure.models, enclosure.extremes, enclosure.levelExtremes);
}

void archiveSamples(Archive& all, const Run& run, SampledMotion& samples, Results& results) {
  bool isEnsemble = samples.ensemble.has_value();
  all(isEnsemble, samples.motion.switching.courses, samples.scales, samples.suspects);
  for (FirstOrder& margins : samples.worstMargins) all(margins);
  if (samples.former) all(*samples.former);
  if (isEnsemble && !samples.ensemble) samples.ensemble.emplace(samples.motion, ensembleOptions(run, results));
  if (isEnsemble)
    all(*samples.ensemble);
  else
    samples.ensemble.reset();
  all(results);
}

RunMemory::RunMemory(Run& run, SampledMotion& samples, Enclosure& enclosure, ModelMasses& masses, Results& results)
    : run_(run),
      samples_(samples),
      enclosure_(enclosure),
      masses_(masses),
      results_(results),
      checkpoint_(run.options.checkpoints) {
  if (run.options.checkpoints != nullptr) run.options.checkpoints->heed(run.watch.stop());
  checkpoint_.recall({}, [this](Archive& all) { archiveAll(all); });
}

RunMemory::~RunMemory() {
  if (run_.options.checkpoints != nullptr) run_.options.checkpoints->heed(nullptr);
}

void RunMemory::operator()(const std::function<void()>& unit) {
  Communicator* others = run_.options.communicator;
  if (others != nullptr && others->isFirst() && others->areParted() && !run_.watch.isToEnd()) {
    done_ = next_;
    others->callBack([this](Archive& all) { archiveAll(all); });
    run_.watch.forgetStops();
  }
  if (next_++ < done_) return;
  try {
    unit();
  } catch (const Communicator::Parted&) {
    const auto become = [this](Archive& all) {
      samples_.ensemble.reset();
      archiveAll(all);
    };
    if (!others->wait(become)) throw;
    run_.watch.forgetStops();
    return;
  }
  note();
  if (run_.options.found) run_.options.found(results_);
}

void RunMemory::note() {
  done_ = next_;
  if (checkpoint_.isWorth()) checkpoint_.record([this](Archive& all) { archiveAll(all); });
}

void RunMemory::archiveAll(Archive& all) {
  std::string stop = run_.watch.firstStop();
  if (all.isReading()) enclosure_.models = TightenedModels(nullptr, 1, 0, tighterFlow(run_));
  all(done_, run_.spent, stop, enclosure_, masses_);
  archiveSamples(all, run_, samples_, results_);
  if (all.isReading() && !stop.empty()) run_.watch.noteFormerStop(stop);
}

}  // namespace gamut
