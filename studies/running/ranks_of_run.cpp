#include "studies/running/ranks_of_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "analyses/communicator.hpp"
#include "scalars/archive.hpp"
#include "studies/checkpoint_file.hpp"
#include "studies/named_texts.hpp"

namespace gamut {

LastOfRanks::~LastOfRanks() {
  if (communicator != nullptr) communicator->end();
}

void checkRanks(Communicator* communicator, const std::string& own, const std::string& what) {
  if (communicator == nullptr) return;
  std::string mine = fmt::format("{}\n{}\n{}", builtBy(), processor(), own);
  int other = -1;
  SharedWork shared(communicator);
  shared.exchange(
      0, [&](Archive& all) { all(mine); },
      [&](int rank, Archive& all) {
        std::string theirs;
        all(theirs);
        if (theirs != mine && other < 0) other = rank;
      });
  shared.end();
  if (other >= 0)
    throw std::invalid_argument(
        fmt::format("rank {} has another {} than rank {}, so that its numbers might differ in their last digits; "
                    "expected the same on all ranks",
                    other, what, shared.rank()));
}

void checkRanks(const Machine& machine, const RunOptions& options, const std::string& own) {
  if (options.communicator == nullptr) return;
  const Study& study = machine.study;
  std::string all = fmt::format("{}\n{}\n{}\n{}", own, study.text, study.robot, inOneText(study.tables));
  for (const Interval& component : machine.box) all += fmt::format(" {} {}", component.lower(), component.upper());
  const Motion& motion = machine.equations();  // proofs that loops close take time, and may have ended otherwise
  all += fmt::format("\n{} of {}, {} of {}, {}", motion.f.states(), motion.f.nodes().size(), motion.g.outputs(),
                     motion.g.nodes().size(), fmt::join(machine.remainders, " "));
  checkRanks(options.communicator, all,
             own.empty() ? "program, processor or study" : "program, processor, study or results");
}

Limits agreedLimits(Limits limits, Communicator* communicator) {
  if (communicator == nullptr) return limits;
  for (double* limit :
       {&limits.time, &limits.memory, &limits.enclosureTime, &limits.enclosureMemory, &limits.sampleTime})
    *limit = communicator->agreed(*limit);
  return limits;
}

void addCostsOfRanks(Communicator* communicator, double& cpu, double& memory) {
  double ownCpu = cpu, ownMemory = memory;
  SharedWork shared(communicator);
  shared.exchange(
      0, [&](Archive& all) { all(ownCpu, ownMemory); },
      [&](int, Archive& all) {
        double theirs = 0, theirMemory = 0;
        all(theirs, theirMemory);
        cpu += theirs;
        memory = std::max(memory, theirMemory);
      });
  shared.end();
}

}  // namespace gamut
