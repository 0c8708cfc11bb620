// The analyses one after the other: enclosure with its alpha-cuts, samples with theirs, comparison.
#include "studies/driver.hpp"

#include <algorithm>
#include <new>
#include <span>
#include <stdexcept>
#include <utility>

#include "analyses/comparison.hpp"
#include "mechanics/assembly.hpp"
#include "scalars/fuzzy.hpp"
#include "scalars/samples.hpp"
#include "studies/problem.hpp"
#include "studies/version.hpp"
#include "studies/watch.hpp"

namespace gamut {
namespace {

void setRow(Bounds& bounds, std::size_t row, const std::vector<Interval>& values) {
  for (std::size_t j = 0; j < values.size(); ++j) {
    bounds.lower(row, j) = values[j].lower();
    bounds.upper(row, j) = values[j].upper();
  }
}

class Driver {
 public:
  Driver(const Study& study, const RunOptions& options)
      : study_(study), options_(options), watch_(limitsOf(study, options), options.cancelled, {options.overdue}) {
    describe();
    const double start = processCpuSeconds();
    problem_ = makeProblem(study_);
    recordingCpu_ = processCpuSeconds() - start;
  }

  Results run() {
    if (study_.interval || study_.fuzzy) enclose();
    if (study_.stochastic) sample();
    if (study_.stochastic && (study_.interval || study_.fuzzy)) compareAnswers();
    if (hasSamples()) describeSamples();
    results_.interval.present = study_.interval;
    if (!study_.interval) results_.interval = {};
    results_.cpu = watch_.spent();
    results_.memory = peakMemory();
    return std::move(results_);
  }

 private:
  void describe() {
    results_.studyText = study_.text;
    results_.studyFile = study_.file;
    results_.title = study_.title;
    results_.analysis = study_.analysisName();
    results_.limits = limitsOf(study_, options_);
    results_.seed = options_.seed.value_or(study_.ensemble.seed);
    results_.version = version();
    results_.host = hostName();
    results_.date = dateTime();
    results_.libraries = libraryVersions();
    results_.outputs = study_.outputs;
    results_.horizon = study_.horizon;
    results_.time = study_.time;
    for (const UncertainQuantity& q : study_.uncertain) {
      const Uncertain& u = q.uncertain;
      results_.uncertain.push_back({u.name, q.quantity, q.unit, u.range.lower(), u.nominal, u.range.upper(),
                                    std::string(u.distribution.name()), std::string(u.membership.name())});
    }
  }

  Bounds emptyBounds() const { return {study_.time.size(), study_.outputs.size()}; }

  std::function<void(double)> progressOf(const std::string& task) const {
    if (!options_.progress) return {};
    return [this, task](double fraction) { options_.progress(task, fraction); };
  }

  // ---- Guaranteed and possible --------------------------------------------------------------------------------------

  void enclose() {
    watch_.begin(Watch::Stage::enclosure);
    results_.interval.at = emptyBounds();
    try {
      if (study_.analysis == Study::Analysis::dynamics) {
        encloseMotion();
      } else {
        encloseConfiguration();
      }
    } catch (const std::bad_alloc&) {
      watch_.memoryFailed();
      encloseNothing();
    }
  }

  void encloseNothing() {
    reachedTimes_ = 0;
    results_.interval = {};
    results_.interval.at = emptyBounds();
    results_.interval.why = watch_.why();
    if (study_.fuzzy) startFuzzy().why = watch_.why();
  }

  void encloseMotion() {
    const double start = processCpuSeconds();
    FlowOptions flow = study_.flow;
    flow.jobs = options_.jobs;
    flow.progress = progressOf("enclosure");
    flow.cancelled = watch_.stop();
    flow.stateNames = study_.mechanism.stateNames();
    const Motion& motion = problem_.motion.motion;
    const Tube tube =
        Flow(motion.f, motion.g, flow).enclose(problem_.box, study_.horizon, study_.time, problem_.levels);
    if (tube.times() != study_.time) throw std::logic_error("the flow's output times are not the study's");
    reachedTimes_ = tube.reachedTimes();

    IntervalResult& interval = results_.interval;
    interval.over = emptyBounds();
    for (std::size_t i = 0; i < reachedTimes_; ++i) {
      setRow(interval.at, i, tube.outputs(i));
      setRow(interval.over, i, tube.outputsOver(i));
    }
    interval.reached = tube.reached();
    if (tube.why() == Tube::outOfMemory) watch_.memoryFailed();
    interval.why = tube.wasStopped() ? watch_.why() : tube.why();
    interval.pieces = tube.pieces();
    interval.steps = tube.steps();
    const double cpu = recordingCpu_ + processCpuSeconds() - start;
    interval.cpu = study_.interval ? cpu - tube.cutCpuSeconds() : 0;

    if (!study_.fuzzy) return;
    FuzzyResult& fuzzy = startFuzzy();
    for (std::size_t level = 0; level < problem_.levels.size(); ++level)
      for (std::size_t i = 0; i < reachedTimes_; ++i) setRow(fuzzy.outer[level], i, tube.cut(level, i));
    fuzzy.reached = tube.reached();
    fuzzy.why = interval.why;
    fuzzy.cpu = cpu - interval.cpu;
  }

  FuzzyResult& startFuzzy() {
    FuzzyResult& fuzzy = results_.fuzzy;
    fuzzy.present = true;
    fuzzy.alpha = problem_.alpha;
    fuzzy.outer.assign(problem_.levels.size(), emptyBounds());
    return fuzzy;
  }

  /// The assembly itself moved by the scalar, as a vector of the outputs.
  template <class S>
  std::vector<S> move(const std::vector<S>& numbers) const {
    const std::span<const S> values(numbers);
    Assembly<S> assembly(study_.mechanism, problem_.freeParameters, values.subspan(problem_.states));
    assembly.setState(values.first(problem_.states));
    std::vector<S> outputs;
    for (const std::string& output : problem_.outputs) outputs.push_back(assembly.output(output));
    return outputs;
  }

  /// Plain intervals and polynomials both enclose, so their intersection does.
  void encloseConfiguration() {
    double start = processCpuSeconds();
    const std::vector<Interval> direct = move<Interval>(problem_.box);
    const auto images = encloseImage(problem_.motion.motion.g, 0.0, problem_.box, problem_.levels, study_.flow.degree);
    std::vector<Interval> enclosure;
    for (std::size_t j = 0; j < direct.size(); ++j) enclosure.push_back(intersection(direct[j], images[0][j]));
    IntervalResult& interval = results_.interval;
    interval.direct = emptyBounds();
    setRow(interval.at, 0, enclosure);
    setRow(interval.direct, 0, direct);
    interval.pieces = 1;
    reachedTimes_ = 1;
    interval.cpu = recordingCpu_ + processCpuSeconds() - start;
    if (!study_.fuzzy) return;

    start = processCpuSeconds();
    FuzzyResult& fuzzy = startFuzzy();
    const std::vector<Fuzzy> moved = move<Fuzzy>(fuzzyNumbers());
    for (std::size_t level = 0; level < problem_.levels.size(); ++level) {
      for (std::size_t j = 0; j < enclosure.size(); ++j)
        enclosure[j] = intersection(enclosure[j], intersection(images[level + 1][j], moved[j].cut(level)));
      setRow(fuzzy.outer[level], 0, enclosure);
    }
    fuzzy.cpu = processCpuSeconds() - start;
  }

  std::vector<Fuzzy> fuzzyNumbers() const {
    std::vector<Fuzzy> numbers(problem_.box.begin(), problem_.box.end());
    for (const int slot : problem_.motion.slot) {
      std::vector<Interval> cuts;
      for (const Box& level : problem_.levels) cuts.push_back(level[static_cast<std::size_t>(slot)]);
      numbers[static_cast<std::size_t>(slot)] = Fuzzy(std::move(cuts));
    }
    return numbers;
  }

  // ---- Probable -----------------------------------------------------------------------------------------------------

  void sample() {
    watch_.begin(Watch::Stage::rest);
    EnsembleOptions ensemble = study_.ensemble;
    ensemble.seed = options_.seed.value_or(ensemble.seed);
    ensemble.samples = options_.samples.value_or(ensemble.samples);
    ensemble.jobs = options_.jobs;
    ensemble.secondsPerSample = results_.limits.sampleTime;
    ensemble.progress = progressOf("samples");
    ensemble.cancelled = watch_.stop();
    const double start = processCpuSeconds();
    StochasticResult& stochastic = results_.stochastic;
    stochastic.present = true;
    stochastic.plan = std::string(nameOf(ensemble.plan));
    stochastic.samples = static_cast<std::int64_t>(ensemble.samples);
    stochastic.relativeTolerance = ensemble.tolerance.relative;
    stochastic.absoluteTolerance = ensemble.tolerance.absolute;
    try {
      ensemble_ = sampleEnsemble(problem_.motion, ensemble);
      if (study_.analysis == Study::Analysis::kinematics && ensemble_.complete) moveSamples();
      describeEnsemble();
    } catch (const std::bad_alloc&) {
      watch_.memoryFailed();
      ensemble_ = {};
      stochastic.stopped = watch_.why();
    }
    stochastic.cpu = processCpuSeconds() - start;
  }

  void describeEnsemble() {
    StochasticResult& stochastic = results_.stochastic;
    stochastic.samples = static_cast<std::int64_t>(ensemble_.samples);
    stochastic.corners = static_cast<std::int64_t>(ensemble_.corners);
    stochastic.integrated = static_cast<std::int64_t>(ensemble_.integrated);
    stochastic.packWidth = static_cast<std::int64_t>(ensemble_.packWidth);
    stochastic.reached = ensemble_.reached;
    if (!ensemble_.failed.empty()) stochastic.why = ensemble_.why;
    if (!ensemble_.complete) stochastic.stopped = watch_.why();
    stochastic.envelope = ensemble_.envelope();
  }

  /// There are none if their motions found no room.
  bool hasSamples() const { return !ensemble_.data.empty(); }

  /// Kinematics: the same samples once more, all at once, by the assembly itself instead of its recording.
  void moveSamples() {
    std::vector<Samples> numbers;
    const UncertainMotion& motion = problem_.motion;
    for (const double value : motion.nominal) numbers.emplace_back(value);
    for (std::size_t i = 0; i < motion.uncertain.size(); ++i) {
      std::vector<double> values;
      for (std::size_t number = 0; number < ensemble_.size(); ++number) values.push_back(ensemble_.valuesOf(number)[i]);
      numbers[static_cast<std::size_t>(motion.slot[i])] = Samples(std::move(values));
    }
    const std::vector<Samples> moved = move<Samples>(numbers);
    for (std::size_t number = 0; number < ensemble_.size(); ++number)
      for (std::size_t j = 0; j < moved.size(); ++j)
        ensemble_.trajectory(number)[j] = moved[j][moved[j].isConstant() ? 0 : number];
  }

  // ---- Together -----------------------------------------------------------------------------------------------------

  /// Samples against the enclosure, then, from the narrowest to the widest, against the alpha-cuts they belong to.
  void compareAnswers() {
    watch_.begin(Watch::Stage::rest);
    const double start = processCpuSeconds();
    ComparisonResult& comparison = results_.comparison;
    comparison.present = true;
    comparison.verdict = "incomplete";
    if (!hasSamples()) return;
    const bool complete = reachedTimes_ == study_.time.size() && ensemble_.complete && ensemble_.failed.empty();
    comparison.verdict = complete ? "inside" : "incomplete";
    if (study_.interval) {
      const Comparison found =
          compare({results_.interval.at, reachedTimes_}, ensemble_, problem_.motion, comparisonOptions());
      takeDisputes(found, -1, [](std::size_t number) { return number; });
      comparison.overestimation = found.overestimation;
      comparison.excess = found.excess;
      comparison.maximum = found.maximum;
      comparison.median = found.median;
      comparison.maximumOf = found.maximumOf;
    }
    for (std::size_t level = problem_.levels.size(); level-- > 0;) compareCut(level);
    results_.stochastic.envelope = ensemble_.envelope();
    results_.stochastic.cpu += processCpuSeconds() - start;
  }

  ComparisonOptions comparisonOptions() const {
    ComparisonOptions options;
    options.jobs = options_.jobs;
    options.progress = progressOf("comparison");
    options.cancelled = watch_.stop();
    return options;
  }

  /// The samples that lie in the level's box but outside its cut are looked at again, as a small ensemble of their own.
  void compareCut(std::size_t level) {
    const Bounds& cut = results_.fuzzy.outer[level];
    std::vector<std::size_t> numbers;
    for (std::size_t number = 0; number < ensemble_.size(); ++number)
      if (belongsTo(level, number) && leaves(cut, number)) numbers.push_back(number);
    if (numbers.empty()) return;
    Ensemble part = partOf(numbers);
    takeDisputes(compare({cut, reachedTimes_}, part, problem_.motion, comparisonOptions()), static_cast<int>(level),
                 [&](std::size_t number) { return numbers[number]; });
    for (std::size_t i = 0; i < numbers.size(); ++i)
      std::ranges::copy(std::as_const(part).trajectory(i), ensemble_.trajectory(numbers[i]).begin());
  }

  bool belongsTo(std::size_t level, std::size_t number) const {
    const UncertainMotion& motion = problem_.motion;
    for (std::size_t i = 0; i < motion.uncertain.size(); ++i) {
      const Interval& values = problem_.levels[level][static_cast<std::size_t>(motion.slot[i])];
      if (!contains(values, ensemble_.valuesOf(number)[i])) return false;
    }
    return true;
  }

  bool leaves(const Bounds& cut, std::size_t number) const {
    const std::span<const double> trajectory = std::as_const(ensemble_).trajectory(number);
    for (std::size_t i = 0; i < reachedTimes_ * ensemble_.outputs; ++i)
      if (trajectory[i] < cut.lower.data[i] || trajectory[i] > cut.upper.data[i]) return true;
    return false;
  }

  /// An ensemble of these samples alone, the last one in the centre's place.
  Ensemble partOf(const std::vector<std::size_t>& numbers) const {
    Ensemble part;
    part.times = ensemble_.times;
    part.outputs = ensemble_.outputs;
    part.quantities = ensemble_.quantities;
    part.samples = numbers.size() - 1;
    part.integrated = numbers.size();
    part.complete = ensemble_.complete;
    part.tolerance = ensemble_.tolerance;
    part.method = ensemble_.method;
    part.packWidth = ensemble_.packWidth;
    part.error = ensemble_.error;
    for (const std::size_t number : numbers) {
      const auto values = ensemble_.valuesOf(number), trajectory = std::as_const(ensemble_).trajectory(number);
      part.values.insert(part.values.end(), values.begin(), values.end());
      part.data.insert(part.data.end(), trajectory.begin(), trajectory.end());
    }
    return part;
  }

  /// The findings about an alpha-cut, or, level -1, about the enclosure.
  template <class NumberOf>
  void takeDisputes(const Comparison& found, int level, const NumberOf& numberOf) {
    ComparisonResult& comparison = results_.comparison;
    for (const Dispute& d : found.disputes) {
      comparison.disputed.push_back({static_cast<std::int64_t>(numberOf(d.number)), d.time, d.output, d.value, d.lower,
                                     d.upper, d.distance, d.error, d.decided, d.outside, level, d.farthest});
      if (d.outside) comparison.verdict = "outside";
      if (d.decided == "unresolved" && comparison.verdict != "outside") comparison.verdict = "unresolved";
      if (d.decided != "interrupted") continue;
      if (comparison.verdict == "inside") comparison.verdict = "incomplete";
      comparison.why = watch_.why();
    }
    comparison.excursion = std::max(comparison.excursion, found.excursion);
  }

  void describeSamples() {
    double start = processCpuSeconds();
    StochasticResult& stochastic = results_.stochastic;
    const Statistics numbers = statistics(ensemble_);
    stochastic.mean = numbers.mean;
    stochastic.deviation = numbers.deviation;
    stochastic.error = ensemble_.error;
    stochastic.probabilities = numbers.probabilities;
    stochastic.quantiles = numbers.quantiles;
    stochastic.cpu += processCpuSeconds() - start;
    if (!study_.fuzzy) return;
    start = processCpuSeconds();
    results_.fuzzy.inner = innerCuts(ensemble_, problem_.motion.uncertain, problem_.alpha);
    results_.fuzzy.cpu += processCpuSeconds() - start;
  }

  const Study& study_;
  const RunOptions& options_;
  Watch watch_;
  Problem problem_;
  Results results_;
  Ensemble ensemble_;
  std::size_t reachedTimes_ = 0;
  double recordingCpu_ = 0;
};

}  // namespace

Limits limitsOf(const Study& study, const RunOptions& options) {
  StatedLimits limits = study.limits;
  if (options.timeLimit) limits.time = options.timeLimit;
  if (options.memoryLimit) limits.memory = options.memoryLimit;
  return limits.resolved();
}

Results run(const Study& study, const RunOptions& options) { return Driver(study, options).run(); }

}  // namespace gamut
