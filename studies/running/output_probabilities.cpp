// Distributions and sensitivities come from the outputs' polynomials in the uncertain quantities; where their errors
// are too great, from those of a tighter flow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include "analyses/flow/circles.hpp"
#include "analyses/flow/flow.hpp"
#include "analyses/probability/output_distributions.hpp"
#include "analyses/probability/quantity_masses.hpp"
#include "analyses/probability/sobol_estimates.hpp"
#include "analyses/probability/sobol_indices.hpp"
#include "analyses/shared_indices.hpp"
#include "analyses/surrogate/pinching.hpp"
#include "analyses/surrogate/surrogate_evaluator.hpp"
#include "analyses/workers.hpp"
#include "scalars/evaluation/sample_pack.hpp"
#include "studies/results/instants.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

class Probabilities {
 public:
  Probabilities(Run& run, const OutputScales& scales, TightenedModels& models, ModelMasses& masses,
                const std::string& whyEnclosureEnded, Results& results)
      : run_(run),
        scales_(scales),
        masses_(masses),
        whyEnclosureEnded_(whyEnclosureEnded),
        results_(results),
        hasModels_(models),
        rows_(distributionRows(run.study)),
        outputs_(plainOutputs(run.study)),
        count_(run.study.outputs.size()),
        surrogate_(models, surrogateForm()),
        found_(rows_, nothing(), distributionOptions()) {
    for (const auto [number, slot] : run.machine.constants) {
      quantities_.push_back(number);
      uncertain_.push_back(&run.study.uncertain[number].uncertain);
    }
  }

  void find() {
    surrogate_.take();
    found_.find(surrogate_, masses_);
  }

  void describe() {
    DistributionResult& result = results_.distribution;
    result.wanted = run_.study.distribution.gap;
    std::size_t most = 0;
    for (std::size_t at = 0; at < rows_.size(); ++at)
      for (std::size_t k = 0; k < outputs_.size(); ++k) most = std::max(most, found_.at(at, k).value.size());
    for (const std::size_t row : rows_) result.time.push_back(run_.study.times[row]);
    for (std::size_t i = 0; i < most; ++i) result.point.push_back(static_cast<double>(i));
    result.value = result.lower = result.upper = Grid({rows_.size(), count_, most});
    result.gaps = Grid({rows_.size(), count_});
    bool areAllKnown = true;
    for (std::size_t at = 0; at < rows_.size(); ++at)
      for (std::size_t k = 0; k < outputs_.size(); ++k) {
        const auto output = static_cast<std::size_t>(outputs_[k]);
        if (isNothing(output)) continue;  // one value, with all of the probability
        const DistributionBounds& bounds = found_.at(at, k);
        areAllKnown = areAllKnown && !bounds.value.empty();
        if (bounds.value.empty()) continue;
        std::ranges::copy(bounds.value, result.value.row(at, output).begin());
        std::ranges::copy(bounds.lower, result.lower.row(at, output).begin());
        std::ranges::copy(bounds.upper, result.upper.row(at, output).begin());
        result.gaps(at, output) = bounds.gap;
        result.gap = std::max(result.gap, bounds.gap);
      }
    if (!areAllKnown) result.gap = 1;
    if (result.gap > result.wanted) result.why = why();
    describeIndices();
    keepSurrogate();
    if (*run_.watch.stop()) result.stopped = run_.watch.why();
  }

 private:
  bool isNothing(std::size_t output) const { return !scales_.empty() && scales_[output].isNothing(); }

  std::vector<char> nothing() const {
    std::vector<char> marks;
    for (const int output : outputs_) marks.push_back(isNothing(static_cast<std::size_t>(output)) ? 1 : 0);
    return marks;
  }

  SurrogateForm surrogateForm() const {
    SurrogateForm form;
    for (const ConstantQuantity& of : run_.machine.constants) form.components.push_back(of.slot);
    form.from = marginOutputs(run_.study).size();
    form.outputs = outputs_.size();
    form.known = [this](std::size_t row, std::size_t k) {
      const Bounds& at = results_.interval.at;
      const auto output = static_cast<std::size_t>(outputs_[k]);
      const bool isKnown = row < at.lower.times && at.lower(row, output) <= at.upper(row, output);
      return isKnown ? Interval(at.lower(row, output), at.upper(row, output)) : Interval::entire();
    };
    form.tighter = [this] { return tighterOptions(run_, run_.study.horizon, "probabilities"); };
    form.cancelled = run_.watch.stop();
    return form;
  }

  OutputDistributionsOptions distributionOptions() const {
    return {
        run_.study.distribution.gap,      run_.options.jobs,        run_.watch.stop(), [this] { return workLeft(); },
        run_.progressOf("probabilities"), run_.options.communicator};
  }

  double workLeft() const {
    return workForProbabilities(run_) - static_cast<double>(Work::counted() - began_);  // not yet counted as spent
  }

  /// Of many output times, since shares change quickly; of fewer where polynomials are long.
  std::vector<std::size_t> rowsOfIndices() const {
    constexpr double most = 64, mostTerms = 1200, pair = 12, share = 0.4;
    const double work = std::max(0.0, share * workLeft() / Work::of(Work::momentTerm, pair));
    double perRow = 1;
    for (const SurrogatePart& part : surrogate_->at.back())
      for (const OutputModel& model : part.outputs) {
        const double terms = std::min(mostTerms, static_cast<double>(model.c.size()));
        perRow += terms * (terms + static_cast<double>(quantities_.size()));
      }
    const auto count = static_cast<std::size_t>(std::clamp(work / perRow, 1.0, most));
    std::vector<std::size_t> rows;
    for (const std::size_t row : rows_)
      if (surrogate_.partsAt(row) != nullptr) rows.push_back(row);
    for (const std::size_t row : decisiveRows()) rows.push_back(surrogate_.nearestRow(row));
    const std::size_t last = surrogate_->rows.size() - 1;
    for (std::size_t i = 0; i <= count && last > 0; ++i) rows.push_back(surrogate_->rows[i * last / count]);
    std::ranges::sort(rows);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
  }

  /// The output times at which requirements come nearest to their limits, and outputs vary most: there shares are told.
  std::vector<std::size_t> decisiveRows() const {
    constexpr std::size_t most = 16;
    std::vector<double> times;
    for (const RequirementResult& requirement : results_.requirements)
      times.push_back(decisiveTime(results_, requirement));
    for (const int output : outputs_) times.push_back(widestTime(results_, static_cast<std::size_t>(output)));
    std::vector<std::size_t> rows;
    const std::vector<double>& all = run_.study.times;
    for (const double time : times)
      if (!std::isnan(time) && rows.size() < most) rows.push_back(std::min(rowOf(all, time), all.size() - 1));
    return rows;
  }

  void describeIndices() {
    if (surrogate_.isNone()) return;
    SensitivityResult& result = results_.sensitivity;
    const std::size_t all = run_.study.uncertain.size();
    const std::vector<std::size_t> rows = rowsOfIndices();
    if (rows.empty()) return;  // the enclosure ended at once
    result.present = true;
    for (const std::size_t row : rows) result.time.push_back(run_.study.times[row]);
    result.mean = result.deviation = BoundGrids({rows.size(), count_});
    result.first = result.total = BoundGrids({rows.size(), count_, all});
    result.firstSampled = result.firstError = result.totalSampled = result.totalError = result.first.lower;
    pinch(rows);
    if (!isPlain(run_.study)) {
      const bool areDependent = !run_.study.dependence.copulas.empty() || !run_.study.dependence.unknown.empty();
      result.why = areDependent ? "quantities depend on each other" : "a distribution is not known exactly";
      return;
    }
    const QuantityMasses masses(surrogate_.get(), uncertain_);
    const double work = std::max(workLeft(), Work::perSecond) /
                        static_cast<double>(rows.size() * std::max<std::size_t>(outputs_.size(), 1));
    std::vector<SobolIndices> found(rows.size() * outputs_.size());
    const auto bound = [&] {
      return [&](std::size_t i) {
        const std::size_t at = i / outputs_.size(), k = i % outputs_.size();
        found[i] = sobolIndices(surrogate_.get(), *surrogate_.partsAt(rows[at]), k, masses, work);
      };
    };
    forEachShared(
        run_.options.communicator, run_.options.jobs, found.size(), run_.watch.stop(), bound,
        [&](Archive& one, std::size_t i) { one(found[i].mean, found[i].deviation, found[i].first, found[i].total); });
    for (std::size_t i = 0; i < found.size(); ++i)
      putIndices(found[i], i / outputs_.size(), outputs_[i % outputs_.size()]);
    estimateIndices(rows);
  }

  void putIndices(const SobolIndices& indices, std::size_t at, int output) {
    if (indices.first.empty()) return;  // there was no time for it
    SensitivityResult& result = results_.sensitivity;
    const auto put = [&](const Interval& bounds, BoundGrids& to, auto... quantity) {
      if (!isBounded(bounds)) return;
      to.lower(at, output, quantity...) = bounds.lower();
      to.upper(at, output, quantity...) = bounds.upper();
    };
    put(indices.mean, result.mean);
    put(indices.deviation, result.deviation);
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      put(indices.first[q], result.first, quantities_[q]);
      put(indices.total[q], result.total, quantities_[q]);
    }
  }

  void pinch(const std::vector<std::size_t>& rows) {
    Grid& pinched = results_.sensitivity.pinched;
    pinched = Grid({rows.size(), count_, run_.study.uncertain.size()});
    std::vector<double> nominal;
    for (const std::size_t q : quantities_) nominal.push_back(run_.study.uncertain[q].uncertain.nominal);
    const Machine& machine = run_.machine;
    if (!run_.moves() && countFarAngles(machine.motion.motion.g, 0, machine.box) > 0) {
      pinchImage(nominal);
      return;
    }
    const auto pinchOne = [&] {
      return [&](std::size_t i) {
        const std::size_t row = i / outputs_.size(), k = i % outputs_.size();
        if (!std::ranges::binary_search(rows_, rows[row])) return;
        const std::vector<double> shares = pinchedShares(surrogate_.get(), *surrogate_.partsAt(rows[row]), k, nominal);
        for (std::size_t q = 0; q < quantities_.size(); ++q) pinched(row, outputs_[k], quantities_[q]) = shares[q];
      };
    };
    const auto told = [&](Archive& one, std::size_t i) {
      for (const std::size_t q : quantities_) one(pinched(i / outputs_.size(), outputs_[i % outputs_.size()], q));
    };
    forEachShared(run_.options.communicator, run_.options.jobs, rows.size() * outputs_.size(), run_.watch.stop(),
                  pinchOne, told);
  }

  /// By an image for each quantity: of far angles it knows more than polynomials of them do.
  void pinchImage(const std::vector<double>& nominal) {
    const Machine& machine = run_.machine;
    const auto rangesOver = [&](const Box& box) {
      const auto found = encloseImage(machine.motion.motion.g, 0, box, {}, run_.study.flow.degree, run_.watch.stop(),
                                      machine.remainders);
      return found.empty() ? std::vector<Interval>(count_, Interval::entire()) : found[0];
    };
    const std::vector<Interval> all = rangesOver(machine.box);
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      Box box = machine.box;
      box[static_cast<std::size_t>(machine.constants[q].slot)] = Interval(nominal[q]);
      const std::vector<Interval> ranges = rangesOver(box);
      for (const int output : outputs_) {
        const auto o = static_cast<std::size_t>(output);
        const bool isKnown = isBounded(all[o]) && isBounded(ranges[o]) && width(all[o]) > 0;
        results_.sensitivity.pinched(0, o, quantities_[q]) =
            isKnown ? std::clamp(1 - width(ranges[o]) / width(all[o]), 0.0, 1.0) : std::nan("");
      }
    }
  }

  void estimateIndices(const std::vector<std::size_t>& rows) {
    SensitivityResult& result = results_.sensitivity;
    const std::size_t n = quantities_.size();
    if (n == 0 || *run_.watch.stop()) return;
    constexpr double least = 256, most = 8192, beside = 30;
    const Program& g = run_.machine.motion.motion.g;
    double terms = 0;  // of all outputs at all these times, in all; or operations, where nothing moves
    for (const std::size_t row : rows)
      for (const OutputModel& model : surrogate_.partsAt(row)->front().outputs)
        terms += static_cast<double>(model.c.size()) + beside;
    if (!run_.moves()) terms = static_cast<double>(g.nodes().size()) + beside;
    const double work = Work::of(Work::evaluatedTerm, terms * static_cast<double>(n + 2));
    result.samples = static_cast<std::int64_t>(std::clamp(workLeft() / work, least, most));
    const auto samples = static_cast<std::size_t>(result.samples);
    std::vector<std::size_t> outputs;
    for (const int output : outputs_) outputs.push_back(static_cast<std::size_t>(output));
    Work::count(Work::evaluatedTerm, terms * static_cast<double>(n + 2) * static_cast<double>(result.samples));
    SobolEstimates estimates;
    if (run_.moves()) {
      const SurrogateEvaluator evaluator(pack(surrogate_.get(), rows, outputs_, count_), rows, outputs);
      estimates = estimateSobolIndices(evaluator, rows.size(), outputs.size(), uncertain_, samples, results_.seed,
                                       run_.watch.stop());
    } else {
      const SampledOutputs positions{{{0, 1}}, [](std::span<double>) {}, positionsOfSamples()};
      estimates =
          estimateSobolIndices(positions, 1, outputs.size(), uncertain_, samples, results_.seed, run_.watch.stop());
    }
    for (std::size_t cell = 0; cell < rows.size() * outputs.size(); ++cell)
      for (std::size_t q = 0; q < n; ++q) {
        const auto put = [&](const std::vector<double>& from, Grid& to) {
          to(cell / outputs.size(), outputs[cell % outputs.size()], quantities_[q]) = from[cell * n + q];
        };
        put(estimates.first, result.firstSampled);
        put(estimates.firstError, result.firstError);
        put(estimates.total, result.totalSampled);
        put(estimates.totalError, result.totalError);
      }
  }

  /// Where nothing moves the outputs themselves cost no more than their polynomials.
  std::function<void(std::size_t, std::span<const double>, std::span<double>)> positionsOfSamples() const {
    return [this](std::size_t, std::span<const double> values, std::span<double> found) {
      const Program& g = run_.machine.motion.motion.g;
      const std::vector<double>& nominal = run_.machine.motion.nominal;
      const std::size_t n = quantities_.size(), samples = values.size() / n;
      std::vector<double> numbers(nominal.size() * samples), all(static_cast<std::size_t>(g.outputs()) * samples);
      for (std::size_t slot = 0; slot < nominal.size(); ++slot)
        std::fill_n(numbers.begin() + static_cast<std::ptrdiff_t>(slot * samples), samples, nominal[slot]);
      for (std::size_t q = 0; q < n; ++q)
        for (std::size_t i = 0; i < samples; ++i)
          numbers[static_cast<std::size_t>(run_.machine.constants[q].slot) * samples + i] = values[i * n + q];
      evaluateSamples(g, samples, 0, {}, numbers, all);
      for (std::size_t i = 0; i < samples; ++i)
        for (std::size_t k = 0; k < outputs_.size(); ++k)
          found[i * outputs_.size() + k] = all[static_cast<std::size_t>(outputs_[k]) * samples + i];
    };
  }

  /// Of as many output times as there is room for: all, or every so manyth, the last and those of distributions among
  /// them.
  void keepSurrogate() {
    SurrogateResult& result = results_.surrogate;
    if (surrogate_.isNone() || quantities_.size() < run_.study.uncertain.size()) return;
    std::vector<std::size_t> rows;
    for (std::size_t every = 1; every < 2 * surrogate_->rows.size(); every *= 2) {
      rows.clear();
      for (const std::size_t row : surrogate_->rows)
        if ((surrogate_->rows.back() - row) % every == 0 || std::ranges::binary_search(rows_, row)) rows.push_back(row);
      if (bytesOf(surrogate_.get(), rows) <= run_.study.distribution.storage) {
        static_cast<PackedSurrogate&>(result) = pack(surrogate_.get(), rows, outputs_, count_);
        result.present = true;
        const auto numbers = [](std::size_t count) {
          std::vector<double> all(count);
          for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<double>(i);
          return all;
        };
        result.part = numbers(result.row.size());
        result.term = numbers(result.exponent.size() / std::max<std::size_t>(quantities_.size(), 1));
        result.number = numbers(result.coefficient.size());
        return;
      }
    }
  }

  std::string why() const {
    if (*run_.watch.stop()) return run_.watch.why();
    if (!hasModels_) return whyEnclosureEnded_.empty() ? "models of outputs found no room" : whyEnclosureEnded_;
    if (surrogate_.isNone()) return "models of outputs found no room";
    if (run_.study.times[surrogate_->rows.back()] < results_.distribution.time.back()) return whyEnclosureEnded_;
    if (found_.isLimited()) return "the work that limits.probabilities allows is done";
    const bool isOne = run_.study.dependence.unknown.empty() &&
                       std::ranges::all_of(uncertain_, [](const Uncertain* u) { return u->distribution.isPrecise(); });
    if (found_.isVague(surrogate_)) return "the enclosure is not tight enough";
    if (!isOne) return "more than one joint distribution is possible";
    if (!isPlain(run_.study)) return "bounds of correlated quantities are coarser";
    return fmt::format(
        "each of them may cut the box into {} parts{}", found_.mostCells(),
        found_.mostCells() < OutputDistributions::mostOfFew ? "; fewer distribution.times allow more" : "");
  }

  Run& run_;
  const OutputScales& scales_;
  ModelMasses& masses_;
  const std::string& whyEnclosureEnded_;
  Results& results_;
  const bool hasModels_;
  const std::uint64_t began_ = Work::counted();
  const std::vector<std::size_t> rows_;
  const std::vector<int> outputs_;
  const std::size_t count_;              // of outputs, margins among them
  std::vector<std::size_t> quantities_;  // of the study that are constant
  std::vector<const Uncertain*> uncertain_;
  TightenedSurrogate surrogate_;
  OutputDistributions found_;
};

}  // namespace

bool asksForDistributions(const Study& study) {
  return study.distribution.count > 0 && study.asksFor<StochasticResult>() &&
         (study.asksFor<IntervalResult>() || study.asksFor<FuzzyResult>()) &&
         study.outputs.size() > marginOutputs(study).size();
}

std::vector<std::size_t> distributionRows(const Study& study) {
  const std::vector<double>& times = study.times;
  std::vector<std::size_t> rows;
  for (const double time : study.distribution.times) rows.push_back(rowOf(times, time));
  if (!rows.empty()) return rows;
  const std::size_t count = study.distribution.count, last = times.size() - 1;
  if (last == 0) return {0};
  for (std::size_t i = 1; i <= count; ++i)
    if (const std::size_t row = (i * last + count / 2) / count; row > 0 && (rows.empty() || row > rows.back()))
      rows.push_back(row);
  return rows;
}

void boundProbabilities(Run& run, const OutputScales& scales, Enclosure& enclosure, ModelMasses& masses,
                        Results& results) {
  if (!asksForDistributions(run.study)) return;
  run.watch.begin(Watch::Stage::rest);
  const Charge charge(&run.spent.probabilities, &results.distribution.cpu);
  results.distribution.present = true;
  Probabilities probabilities(run, scales, enclosure.models, masses, enclosure.why, results);
  hasRoomFor(run, [&] { probabilities.find(); });  // what was found until then is told
  probabilities.describe();
  enclosure.models.reset();
}

}  // namespace gamut
