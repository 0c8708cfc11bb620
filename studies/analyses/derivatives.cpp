// By a flow of its own, along the derivatives.
#include "studies/analyses/derivatives.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "analyses/flow/derivatives.hpp"
#include "studies/analysis.hpp"
#include "studies/running/context.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/settings.hpp"

namespace gamut {
namespace {

std::vector<Field> fieldsOf(DerivativeResult& d) {
  using namespace dimension;
  constexpr std::string_view when = "/derivatives/time";
  return d.fieldsAnd(
      {{"time", &d.time, unit::second, "some output times", {when}},
       {"lower",
        &d.lower,
        unit::none,
        "proved bound of the output's derivative by the quantity, for all values in the intervals, in the output's "
        "unit by the quantity's; NaN by what varies in time",
        {when, output, quantity}},
       {"upper", &d.upper, unit::none, "upper bound", {when, output, quantity}}});
}

/// At some output times, as far as the tube reaches.
void take(const Study& study, const DerivativeFlow& flow, const std::vector<std::size_t>& quantities, const Tube& tube,
          DerivativeResult& result) {
  constexpr std::size_t most = 64;
  const std::size_t last = study.times.size() - 1, count = std::min(last, most);
  const auto rowOf = [&](std::size_t i) { return i * last / count; };
  for (std::size_t i = 0; i <= count && rowOf(i) < tube.reachedTimes(); ++i)
    result.time.push_back(study.times[rowOf(i)]);
  result.lower = result.upper = Grid({result.time.size(), study.outputs.size(), study.uncertain.size()});
  for (std::size_t i = 0; i < result.time.size(); ++i) {
    const std::vector<Interval>& values = tube.outputs(rowOf(i));
    for (std::size_t output = 0; output < study.outputs.size(); ++output)
      for (std::size_t which = 0; which < quantities.size(); ++which) {
        const Interval bounds = values[flow.outputDerivative(static_cast<int>(output), static_cast<int>(which))];
        result.lower(i, output, quantities[which]) = bounds.lower();
        result.upper(i, output, quantities[which]) = bounds.upper();
      }
  }
}

class DerivativeAnalysis final : public AnalysisOf<DerivativeAnalysis, DerivativeResult> {
 public:
  std::string_view section() const override { return "sensitivity"; }
  std::string_view meaning() const override { return "derivatives by the uncertain quantities"; }
  void describe(Settings& s) override {
    s.flag({"derivatives",
            "whether derivatives of all outputs by the uncertain quantities are enclosed too, by a flow of its own, as "
            "far as `limits.derivatives` allows; in dynamics, where nothing jumps",
            "false"},
           isAsked_);
  }
  bool isAsked() const override { return isAsked_; }
  std::optional<Refusal> refusal(const Study& study) const override {
    if (!isAsked_) return {};
    if (study.analysis != Study::Analysis::dynamics)
      return Refusal{"derivatives", "derivatives are enclosed in dynamics alone", "no such key"};
    if (study.mechanism.isClosed())  // where it starts follows from the quantities by more than what is recorded
      return Refusal{"derivatives", "derivatives are not enclosed of what closes on itself", "no such key"};
    return {};
  }

  void find(Run& run, const Results& /*before*/, DerivativeResult& result) const {
    std::vector<std::size_t> quantities;
    std::vector<int> by;
    for (const auto [number, slot] : run.machine.constants) {
      quantities.push_back(number);
      by.push_back(slot);
    }
    FlowOptions options = flowOptions(run.machine, run.options.jobs, run.watch.stop());
    options.progress = run.progressOf("derivatives");
    options.communicator = run.options.communicator;
    options.budget = run.study.shares.derivatives * std::max(run.spent.enclosure / Work::perSecond, 1.0);
    try {
      if (!(options.budget > 0)) throw std::invalid_argument("limits.derivatives leaves them nothing");
      const DerivativeFlow flow(run.machine.equations().f, run.machine.equations().g, by, std::move(options));
      const Tube tube = flow.enclose(run.machine.box, run.study.horizon, run.study.times);
      result.reached = tube.reached();
      if (tube.why() == Tube::outOfMemory) run.watch.memoryFailed();
      result.why = tube.why() == Tube::overBudget ? "the work that limits.derivatives allows is done"
                   : tube.wasStopped()            ? run.watch.why()
                                                  : tube.why();
      take(run.study, flow, quantities, tube, result);
    } catch (const std::invalid_argument& error) {  // of what jumps there is none
      result.why = error.what();
    }
  }

 private:
  bool isAsked_ = false;
};

}  // namespace

void DerivativeResult::describe(std::vector<Group>& groups) {
  groups.push_back(
      groupOf("/derivatives", "how outputs change with the uncertain quantities, proved", *this, fieldsOf));
  groups.back().inJson = {{"lower", "*/0"}, {"upper", "*/1"}};
  groups.back().makesSense = [this](std::size_t) {
    for (std::size_t i = 0; i < lower.data.size(); ++i)
      if (lower.data[i] > upper.data[i]) return false;
    return true;
  };
}

std::unique_ptr<FurtherAnalysis> derivativesAnalysis() { return std::make_unique<DerivativeAnalysis>(); }

}  // namespace gamut
