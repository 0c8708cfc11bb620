// Distributions and sensitivities come from the outputs' polynomials in the uncertain quantities; where their errors
// are too great, from those of a tighter flow.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <optional>
#include <span>

#include "analyses/probability/output_distribution.hpp"
#include "analyses/probability/quantity_masses.hpp"
#include "analyses/probability/sobol_estimates.hpp"
#include "analyses/probability/sobol_indices.hpp"
#include "analyses/surrogate/pinching.hpp"
#include "analyses/surrogate/surrogate_evaluator.hpp"
#include "analyses/workers.hpp"
#include "studies/results/instants.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

class Probabilities {
 public:
  explicit Probabilities(Run& run)
      : run_(run),
        rows_(distributionRows(run.study)),
        outputs_(plainOutputs(run.study)),
        count_(run.study.outputs.size()) {
    for (const auto [number, slot] : run.machine.constants) {
      quantities_.push_back(number);
      components_.push_back(slot);
      uncertain_.push_back(&run.study.uncertain[number].uncertain);
    }
    found_.resize(rows_.size() * outputs_.size());
    tried_.resize(found_.size());
  }

  /// Coarsely of all first, which tells what the polynomials are good for; then as closely as can be.
  void find() {
    if (!run_.enclosed.models) return;
    take(*run_.enclosed.models);
    const double wanted = run_.study.distribution.gap, coarse = 16 * wanted;
    constexpr double first = 1.0 / 8;
    boundAll(first, coarse, coarse);
    tighten();
    do boundAll(1, coarse, wanted);
    while (tighten());
    for (std::size_t i = 0; i < found_.size(); ++i)
      isLimited_ = isLimited_ || (found_[i].gap > wanted && tried_[i].isLimited);
  }

  void describe() {
    DistributionResult& result = run_.results.distribution;
    result.wanted = run_.study.distribution.gap;
    std::size_t most = 0;
    for (const DistributionBounds& bounds : found_) most = std::max(most, bounds.value.size());
    for (const std::size_t row : rows_) result.time.push_back(run_.study.times[row]);
    for (std::size_t i = 0; i < most; ++i) result.point.push_back(static_cast<double>(i));
    for (std::vector<double>* numbers : {&result.value, &result.lower, &result.upper})
      numbers->assign(rows_.size() * count_ * most, unknown);
    result.gaps.assign(rows_.size() * count_, unknown);
    bool areAllKnown = true;
    for (std::size_t at = 0; at < rows_.size(); ++at)
      for (std::size_t k = 0; k < outputs_.size(); ++k) {
        const auto output = static_cast<std::size_t>(outputs_[k]);
        if (isNothing(output)) continue;  // one value, with all of the probability
        const DistributionBounds& bounds = found_[at * outputs_.size() + k];
        const std::size_t begin = result.begin(at, output, count_), cell = at * count_ + output;
        areAllKnown = areAllKnown && !bounds.value.empty();
        if (bounds.value.empty()) continue;
        const auto put = [&](const std::vector<double>& from, std::vector<double>& to) {
          std::ranges::copy(from, to.begin() + static_cast<std::ptrdiff_t>(begin));
        };
        put(bounds.value, result.value);
        put(bounds.lower, result.lower);
        put(bounds.upper, result.upper);
        result.gaps[cell] = bounds.gap;
        result.gap = std::max(result.gap, bounds.gap);
      }
    if (!areAllKnown) result.gap = 1;
    if (result.gap > result.wanted) result.why = why();
    describeIndices();
    keepSurrogate();
    if (*run_.watch.stop()) result.stopped = run_.watch.why();
  }

 private:
  bool isNothing(std::size_t output) const { return !run_.scales.empty() && run_.scales[output].isNothing(); }

  /// Whether errors of the polynomials keep bounds apart: more than is asked for, and not less than all else does.
  bool isVague() const {
    constexpr double part = 0.05, mostly = 0.3, density = 2.5;  // about, of an output that is 1 wide
    const double wanted = run_.study.distribution.gap;
    for (std::size_t at = 0; at < rows_.size(); ++at) {
      const auto parts = partsAt(surrogate_, rows_[at]);
      if (!parts) return true;
      for (std::size_t k = 0; k < outputs_.size(); ++k) {
        if (isNothing(static_cast<std::size_t>(outputs_[k]))) continue;
        const DistributionBounds& bounds = found_[at * outputs_.size() + k];
        Interval all = Interval::empty();
        double off = 0;
        for (const SurrogatePart& each : *parts) {
          const OutputModel& model = each.outputs[k];
          double varies = model.c.empty() ? width(model.bound) : 0;
          for (std::size_t g = 1; g < model.c.size(); ++g) varies += std::fabs(model.c[g]);
          const double radius = model.c.empty() ? varies : model.radius;
          if (radius <= negligible_[k] || radius <= part * wanted * varies) continue;
          off = std::max(off, radius);
          all = hull(all, model.bound);
        }
        if (off == 0) continue;
        for (const SurrogatePart& each : *parts) all = hull(all, each.outputs[k].bound);
        const bool isMost = bounds.value.empty() || density * 2 * off > mostly * bounds.gap * width(all);
        if (isMost && (bounds.value.empty() || bounds.gap > wanted)) return true;
      }
    }
    return false;
  }

  /// By tighter flows, as long as they cost no more than half of what may still be done. Bounds are to be found again.
  bool tighten() {
    const double tightness = run_.study.flow.tightness;
    double excess = (run_.enclosed.modelTightness > 0 ? run_.enclosed.modelTightness : tightness) - 1;
    constexpr double finest = 1.0 / 1024;
    double forFlows = 0.5 * workLeft();
    bool isTighter = false;
    while (run_.study.analysis != Study::Analysis::kinematics && !surrogate_.rows.empty() && isVague() &&
           !*run_.watch.stop() && excess > finest * (tightness - 1)) {
      const std::uint64_t counted = Work::counted();
      if (!tightenModels(run_, 1 + (excess /= 8), forFlows, run_.study.horizon, "probabilities")) break;
      forFlows -= static_cast<double>(Work::counted() - counted);
      take(*run_.enclosed.models);
      isTighter = true;
    }
    if (isTighter) std::ranges::fill(tried_, Tried{});
    return isTighter;
  }

  void take(const FlowModels& models) {
    const std::size_t margins = marginOutputs(run_.study).size();
    surrogate_ = surrogateOf(models, components_, margins, margins + outputs_.size(), run_.watch.stop());
    meetEnclosure();
    measureNegligible(surrogate_);
  }

  /// Outputs lie in their enclosure, whatever part of the box they are of.
  void meetEnclosure() {
    const Bounds& at = run_.results.interval.at;
    for (std::size_t i = 0; i < surrogate_.rows.size() && surrogate_.rows[i] < at.lower.times; ++i)
      for (SurrogatePart& part : surrogate_.at[i])
        for (std::size_t k = 0; k < outputs_.size(); ++k) {
          const auto output = static_cast<std::size_t>(outputs_[k]);
          const double lower = at.lower(surrogate_.rows[i], output), upper = at.upper(surrogate_.rows[i], output);
          if (!(lower <= upper)) continue;  // nothing is known of it
          Interval& bound = part.outputs[k].bound;
          if (const Interval both = intersection(bound, Interval(lower, upper)); !isEmpty(both)) bound = both;
        }
  }

  /// Those that are wider than the coarsest of these gaps to it, then those that are wider than half of it to that, and
  /// so on, the widest first, until so much of the work that is left for bounds is done.
  void boundAll(double share, double coarsest, double finest) {
    if (surrogate_.rows.empty()) return;
    const JointMasses& masses = jointMasses(run_, surrogate_.symbols, surrogate_.quantities);
    constexpr double forIndices = 0.2, hardly = 1e-3;
    const double all = share * (1 - forIndices) * workLeft(), least = workLeft() - all;
    for (double gap = coarsest; !*run_.watch.stop(); gap = std::max(0.5 * gap, finest)) {
      std::vector<std::size_t> open;
      for (std::size_t i = 0; i < found_.size(); ++i)
        if (found_[i].gap > gap && tried_[i].mayHelp) open.push_back(i);
      std::ranges::stable_sort(open, std::greater<>(), [&](std::size_t i) { return found_[i].gap; });
      // Some together, as many however many threads there are; what they leave, those behind them have.
      constexpr std::size_t together = 8;
      constexpr double more = 4;  // than each would have of what is left: most take less
      double left = workLeft() - least;
      for (std::size_t done = 0; done < open.size() && left > hardly * all; left = workLeft() - least) {
        const std::size_t count = std::min(together, open.size() - done);
        const double each =
            std::min(left / static_cast<double>(count), more * left / static_cast<double>(open.size() - done));
        boundThese(std::span(open).subspan(done, count), masses, gap, each);
        done += count;
      }
      if (gap <= finest && (open.empty() || gap > run_.study.distribution.gap || !(left > hardly * all))) break;
    }
  }

  /// To that gap, each with so much work at most.
  void boundThese(std::span<const std::size_t> these, const JointMasses& masses, double gap, double work) {
    DistributionOptions options;
    options.gap = gap;
    options.cancelled = run_.watch.stop();
    options.mostWork = work;
    options.mostCells = mostCells();
    std::atomic<std::size_t> done{0};
    const auto progress = run_.progressOf("probabilities");
    forEachIndex(run_.options.jobs, these.size(), run_.watch.stop(), [&] {
      return [&](std::size_t number) {
        const std::size_t i = these[number], output = i % outputs_.size();
        Tried& tried = tried_[i];
        const auto parts = partsAt(surrogate_, rows_[i / outputs_.size()]);
        if (!parts) {
          tried.mayHelp = false;
          return;
        }
        DistributionOptions own = options;
        own.negligible = negligible_[output];
        DistributionBounds bounds = boundDistribution(*parts, output, masses, own);
        constexpr double hardlyMore = 1.5;
        const bool isFinest = gap <= run_.study.distribution.gap;
        tried.isLimited = bounds.isLimited;
        tried.mayHelp = !isFinest || (bounds.isLimited && work > hardlyMore * tried.work);
        tried.work = isFinest ? work : 0;
        if (!bounds.value.empty() && (found_[i].value.empty() || bounds.gap < found_[i].gap))
          found_[i] = std::move(bounds);
        if (progress) progress(static_cast<double>(++done) / static_cast<double>(these.size()));
      };
    });
  }

  /// Into which the box is cut for one of them.
  std::size_t mostCells() const {
    constexpr std::size_t cells = 10240, fewest = 64;  // of all together; of one
    return std::clamp(cells / found_.size(), fewest, mostCells_);
  }

  double workLeft() const {
    return workForProbabilities(run_) - static_cast<double>(Work::counted() - began_);  // not yet counted as spent
  }

  /// What does not depend on anything uncertain is known to some roundings.
  void measureNegligible(const Surrogate& surrogate) {
    constexpr double part = 1e-9;  // of the greatest value
    negligible_.assign(outputs_.size(), 0.0);
    for (const std::vector<SurrogatePart>& parts : surrogate.at)
      for (const SurrogatePart& each : parts)
        for (std::size_t k = 0; k < outputs_.size(); ++k)
          if (isBounded(each.outputs[k].bound))
            negligible_[k] = std::max(negligible_[k], part * magnitude(each.outputs[k].bound));
  }

  static const std::vector<SurrogatePart>* partsAt(const Surrogate& surrogate, std::size_t row) {
    const auto place = std::ranges::lower_bound(surrogate.rows, row);
    if (place == surrogate.rows.end() || *place != row) return nullptr;
    return &surrogate.at[static_cast<std::size_t>(place - surrogate.rows.begin())];
  }

  /// Where there were too many output times, not all have polynomials.
  std::size_t nearestRow(std::size_t row) const {
    const auto behind = std::ranges::lower_bound(surrogate_.rows, row);
    if (behind == surrogate_.rows.end()) return surrogate_.rows.back();
    return behind > surrogate_.rows.begin() && row - behind[-1] < *behind - row ? behind[-1] : *behind;
  }

  /// Of many output times, since shares change quickly; of fewer where polynomials are long.
  std::vector<std::size_t> rowsOfIndices() const {
    constexpr double most = 64, mostTerms = 1200, pair = 12, share = 0.4;
    const double work = std::max(0.0, share * workLeft() / Work::of(Work::momentTerm, pair));
    double perRow = 1;
    for (const SurrogatePart& part : surrogate_.at.back())
      for (const OutputModel& model : part.outputs) {
        const double terms = std::min(mostTerms, static_cast<double>(model.c.size()));
        perRow += terms * (terms + static_cast<double>(components_.size()));
      }
    const auto count = static_cast<std::size_t>(std::clamp(work / perRow, 1.0, most));
    std::vector<std::size_t> rows;
    for (const std::size_t row : rows_)
      if (partsAt(surrogate_, row) != nullptr) rows.push_back(row);
    for (const std::size_t row : decisiveRows()) rows.push_back(nearestRow(row));
    const std::size_t last = surrogate_.rows.size() - 1;
    for (std::size_t i = 0; i <= count && last > 0; ++i) rows.push_back(surrogate_.rows[i * last / count]);
    std::ranges::sort(rows);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
  }

  /// The output times at which requirements come nearest to their limits, and outputs vary most: there shares are told.
  std::vector<std::size_t> decisiveRows() const {
    constexpr std::size_t most = 16;
    std::vector<double> times;
    for (const RequirementResult& requirement : run_.results.requirements)
      times.push_back(decisiveTime(run_.results, requirement));
    for (const int output : outputs_) times.push_back(widestTime(run_.results, static_cast<std::size_t>(output)));
    std::vector<std::size_t> rows;
    const std::vector<double>& all = run_.study.times;
    for (const double time : times)
      if (!std::isnan(time) && rows.size() < most) rows.push_back(std::min(rowOf(all, time), all.size() - 1));
    return rows;
  }

  void describeIndices() {
    if (surrogate_.rows.empty()) return;
    SensitivityResult& result = run_.results.sensitivity;
    const std::size_t all = run_.study.uncertain.size();
    const std::vector<std::size_t> rows = rowsOfIndices();
    if (rows.empty()) return;  // the enclosure ended at once
    result.present = true;
    for (const std::size_t row : rows) result.time.push_back(run_.study.times[row]);
    for (auto* numbers : {&result.meanLower, &result.meanUpper, &result.deviationLower, &result.deviationUpper})
      numbers->assign(rows.size() * count_, unknown);
    for (auto* numbers : {&result.firstLower, &result.firstUpper, &result.totalLower, &result.totalUpper,
                          &result.firstSampled, &result.firstError, &result.totalSampled, &result.totalError})
      numbers->assign(rows.size() * count_ * all, unknown);
    pinch(rows);
    if (!isPlain(run_.study)) {
      const bool areDependent = !run_.study.dependence.copulas.empty() || !run_.study.dependence.unknown.empty();
      result.why = areDependent ? "quantities depend on each other" : "a distribution is not known exactly";
      return;
    }
    const QuantityMasses masses(surrogate_, uncertain_);
    forEachIndex(run_.options.jobs, rows.size() * outputs_.size(), run_.watch.stop(), [&] {
      return [&](std::size_t i) {
        const std::size_t at = i / outputs_.size(), k = i % outputs_.size();
        const SobolIndices indices = sobolIndices(surrogate_, *partsAt(surrogate_, rows[at]), k, masses);
        const std::size_t cell = at * count_ + static_cast<std::size_t>(outputs_[k]);
        const auto put = [](const Interval& bounds, double& lower, double& upper) {
          if (isBounded(bounds)) lower = bounds.lower(), upper = bounds.upper();
        };
        put(indices.mean, result.meanLower[cell], result.meanUpper[cell]);
        put(indices.deviation, result.deviationLower[cell], result.deviationUpper[cell]);
        for (std::size_t q = 0; q < quantities_.size(); ++q) {
          const std::size_t of = cell * all + quantities_[q];
          put(indices.first[q], result.firstLower[of], result.firstUpper[of]);
          put(indices.total[q], result.totalLower[of], result.totalUpper[of]);
        }
      };
    });
    estimateIndices(rows);
  }

  void pinch(const std::vector<std::size_t>& rows) {
    const std::size_t all = run_.study.uncertain.size();
    std::vector<double>& pinched = run_.results.sensitivity.pinched;
    pinched.assign(rows.size() * count_ * all, unknown);
    std::vector<double> nominal;
    for (const std::size_t q : quantities_) nominal.push_back(run_.study.uncertain[q].uncertain.nominal);
    forEachIndex(run_.options.jobs, rows.size() * outputs_.size(), run_.watch.stop(), [&] {
      return [&](std::size_t i) {
        const std::size_t row = i / outputs_.size(), k = i % outputs_.size();
        if (!std::ranges::binary_search(rows_, rows[row])) return;
        const std::vector<double> shares = pinchedShares(surrogate_, *partsAt(surrogate_, rows[row]), k, nominal);
        for (std::size_t q = 0; q < quantities_.size(); ++q)
          pinched[(row * count_ + static_cast<std::size_t>(outputs_[k])) * all + quantities_[q]] = shares[q];
      };
    });
  }

  void estimateIndices(const std::vector<std::size_t>& rows) {
    SensitivityResult& result = run_.results.sensitivity;
    const std::size_t all = run_.study.uncertain.size(), n = components_.size();
    if (n == 0 || *run_.watch.stop()) return;
    constexpr double least = 256, most = 8192, beside = 30;
    double terms = 0;  // of all outputs at all these times, in all
    for (const std::size_t row : rows)
      for (const OutputModel& model : partsAt(surrogate_, row)->front().outputs)
        terms += static_cast<double>(model.c.size()) + beside;
    const double work = Work::of(Work::evaluatedTerm, terms * static_cast<double>(n + 2));
    result.samples = static_cast<std::int64_t>(std::clamp(workLeft() / work, least, most));
    std::vector<std::size_t> outputs;
    for (const int output : outputs_) outputs.push_back(static_cast<std::size_t>(output));
    Work::count(Work::evaluatedTerm, terms * static_cast<double>(n + 2) * static_cast<double>(result.samples));
    const SurrogateEvaluator evaluator(pack(surrogate_, rows, outputs_, count_), rows, outputs);
    const SobolEstimates estimates =
        estimateSobolIndices(evaluator, rows.size(), outputs.size(), uncertain_,
                             static_cast<std::size_t>(result.samples), run_.results.seed, run_.watch.stop());
    for (std::size_t cell = 0; cell < rows.size() * outputs.size(); ++cell)
      for (std::size_t q = 0; q < n; ++q) {
        const std::size_t from = cell * n + q;
        const std::size_t to = (cell / outputs.size() * count_ + outputs[cell % outputs.size()]) * all + quantities_[q];
        result.firstSampled[to] = estimates.first[from];
        result.firstError[to] = estimates.firstError[from];
        result.totalSampled[to] = estimates.total[from];
        result.totalError[to] = estimates.totalError[from];
      }
  }

  /// Of as many output times as there is room for: all, or every so manyth, the last and those of distributions among
  /// them.
  void keepSurrogate() {
    SurrogateResult& result = run_.results.surrogate;
    if (surrogate_.rows.empty() || components_.size() < run_.study.uncertain.size()) return;
    std::vector<std::size_t> rows;
    for (std::size_t every = 1; every < 2 * surrogate_.rows.size(); every *= 2) {
      rows.clear();
      for (const std::size_t row : surrogate_.rows)
        if ((surrogate_.rows.back() - row) % every == 0 || std::ranges::binary_search(rows_, row)) rows.push_back(row);
      if (bytesOf(surrogate_, rows) <= run_.study.distribution.storage) {
        static_cast<PackedSurrogate&>(result) = pack(surrogate_, rows, outputs_, count_);
        result.present = true;
        const auto numbers = [](std::size_t count) {
          std::vector<double> all(count);
          for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<double>(i);
          return all;
        };
        result.part = numbers(result.row.size());
        result.term = numbers(result.exponent.size() / std::max<std::size_t>(components_.size(), 1));
        result.number = numbers(result.coefficient.size());
        return;
      }
    }
  }

  std::string why() const {
    if (*run_.watch.stop()) return run_.watch.why();
    if (!run_.enclosed.models) return run_.enclosed.why.empty() ? "models of outputs found no room" : run_.enclosed.why;
    if (surrogate_.rows.empty()) return "models of outputs found no room";
    if (run_.study.times[surrogate_.rows.back()] < run_.results.distribution.time.back()) return run_.enclosed.why;
    if (isLimited_) return "the work that limits.probabilities allows is done";
    const bool isOne = run_.study.dependence.unknown.empty() &&
                       std::ranges::all_of(uncertain_, [](const Uncertain* u) { return u->distribution.isPrecise(); });
    if (isVague()) return "the enclosure is not tight enough";
    if (!isOne) return "more than one joint distribution is possible";
    if (!isPlain(run_.study)) return "bounds of correlated quantities are coarser";
    return fmt::format("each of them may cut the box into {} parts{}", mostCells(),
                       mostCells() < mostCells_ ? "; fewer distribution.times allow more" : "");
  }

  Run& run_;
  const std::uint64_t began_ = Work::counted();
  static constexpr std::size_t mostCells_ = 4096;  // of few outputs at few times
  const std::vector<std::size_t> rows_;
  const std::vector<int> outputs_;
  const std::size_t count_;              // of outputs, margins among them
  std::vector<std::size_t> quantities_;  // of the study that are constant
  std::vector<int> components_;          // of these
  std::vector<const Uncertain*> uncertain_;
  struct Tried {
    double work = 0;         // that might be done, the last time for the gap that is asked for
    bool isLimited = false;  // by that
    bool mayHelp = true;     // to do it with more, or for a smaller gap
  };
  std::vector<DistributionBounds> found_;  // [row][output]
  std::vector<Tried> tried_;
  Surrogate surrogate_;
  bool isLimited_ = false;          // by work
  std::vector<double> negligible_;  // width of each output
};

}  // namespace

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

void boundProbabilities(Run& run) {
  if (!asksForDistributions(run.study)) return;
  run.watch.begin(Watch::Stage::rest);
  const double start = processCpuSeconds();
  const Spending spending(run.spent.probabilities);
  run.results.distribution.present = true;
  Probabilities probabilities(run);
  try {
    probabilities.find();
  } catch (const std::bad_alloc&) {
    run.watch.memoryFailed();
  }
  probabilities.describe();
  run.enclosed.models.reset();
  run.results.distribution.cpu = processCpuSeconds() - start;
}

}  // namespace gamut
