// What is possible in kinematics: the enclosures of the alpha-cuts' boxes, narrowed by fuzzy numbers that move the
// assembly.
#include <utility>

#include "scalars/fuzzy.hpp"
#include "studies/running/sampled_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// The machine's numbers, each uncertain one as the stack of its cuts.
std::vector<Fuzzy> fuzzyNumbers(const Machine& machine) {
  std::vector<Fuzzy> numbers(machine.box.begin(), machine.box.end());
  for (const int slot : machine.motion.slot) {
    std::vector<Interval> cuts;
    for (const Box& level : machine.levels) cuts.push_back(level[slot]);
    numbers[slot] = Fuzzy(std::move(cuts));
  }
  return numbers;
}

/// Both enclose, so their intersection does, but where nothing is known of the cuts.
void narrow(std::vector<Bounds>& cuts, const std::vector<Fuzzy>& outputs) {
  for (std::size_t level = 0; level < cuts.size(); ++level)
    for (std::size_t j = 0; j < outputs.size(); ++j) {
      double &lower = cuts[level].lower(0, j), &upper = cuts[level].upper(0, j);
      if (isEntire(Interval(lower, upper))) continue;
      const Interval both = intersection(Interval(lower, upper), outputs[j].cut(level));
      lower = both.lower();
      upper = both.upper();
    }
}

}  // namespace

void narrowByAssembly(Run& run, FuzzyResult& fuzzy) {
  const auto task = [&] { narrow(fuzzy.outer, assembledOutputs(run.machine, fuzzyNumbers(run.machine))); };
  if (!hasRoomFor(run, task)) fuzzy.why = run.watch.why();
}

}  // namespace gamut
