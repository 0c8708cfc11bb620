// Analyses of their own files.
#include "analyses/checkpoints.hpp"
#include "scalars/archive.hpp"
#include "studies/running/run_memory.hpp"
#include "studies/running/units.hpp"

namespace gamut {

void findFurther(Run& run, Results& results) {
  for (std::size_t i = 0; i < run.study.analyses.size(); ++i) {
    const FurtherAnalysis& analysis = *run.study.analyses[i];
    if (!analysis.isAsked()) continue;
    run.watch.begin(Watch::Stage::rest);
    FurtherPart& part = *results.further[i];
    const Charge charge(nullptr, &part.cpu);
    part.present = true;
    CheckpointedTask checkpoint(run.options.checkpoints);
    const auto end = [&](Archive& all) {
      std::vector<Group> groups;
      part.describe(groups);
      archiveGroups(all, groups);
    };
    if (checkpoint.recall(end, {}) == CheckpointedTask::Recalled::end) continue;
    if (!hasRoomFor(run, [&] { analysis.find(run, results, part); })) part.why = run.watch.why();
    if (*run.watch.stop()) part.stopped = run.watch.why();
    checkpoint.end(end);
  }
}

}  // namespace gamut
