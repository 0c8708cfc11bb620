// The analyses one after the other: a first block of samples, the enclosure with its alpha-cuts, all other samples,
// each compared as it arrives.
#include "studies/driver.hpp"

#include <algorithm>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "analyses/comparison/comparison.hpp"
#include "analyses/comparison/settlement.hpp"
#include "scalars/fuzzy.hpp"
#include "studies/problem.hpp"
#include "studies/sampled_study.hpp"
#include "studies/running/sample_keeper.hpp"
#include "studies/summary.hpp"
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
    if (study_.stochastic) sampleFirst();
    if (study_.interval || study_.fuzzy) enclose();
    if (study_.stochastic) sampleOthers();
    if (study_.stochastic && (study_.interval || study_.fuzzy)) compareAnswers();
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
      const auto add = [&](const char* shape, const std::vector<ShapeNumber>& numbers) {
        for (const ShapeNumber& n : numbers)
          results_.shapes.push_back({u.name, shape, n.name, n.value, n.isOfQuantity ? q.unit : "1"});
      };
      add("distribution", u.distribution.numbers());
      add("membership", u.membership.numbers());
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

  /// Plain intervals and polynomials both enclose, so their intersection does. What ends early leaves the former.
  void encloseConfiguration() {
    double start = processCpuSeconds();
    const std::vector<Interval> direct = assembledOutputs(study_, problem_, problem_.box);
    const auto images =
        encloseImage(problem_.motion.motion.g, 0.0, problem_.box, problem_.levels, study_.flow.degree, watch_.stop());
    std::vector<Interval> enclosure = direct;
    const auto narrow = [&](std::size_t image) {
      for (std::size_t j = 0; j < enclosure.size() && !images.empty(); ++j)
        enclosure[j] = intersection(enclosure[j], images[image][j]);
    };
    narrow(0);
    IntervalResult& interval = results_.interval;
    interval.direct = emptyBounds();
    setRow(interval.at, 0, enclosure);
    setRow(interval.direct, 0, direct);
    interval.pieces = 1;
    if (images.empty()) interval.why = watch_.why();
    reachedTimes_ = 1;
    interval.cpu = recordingCpu_ + processCpuSeconds() - start;
    if (!study_.fuzzy) return;

    start = processCpuSeconds();
    FuzzyResult& fuzzy = startFuzzy();
    fuzzy.why = interval.why;
    const std::vector<Fuzzy> moved = assembledOutputs(study_, problem_, fuzzyNumbers());
    for (std::size_t level = 0; level < problem_.levels.size(); ++level) {
      narrow(level + 1);
      for (std::size_t j = 0; j < enclosure.size(); ++j) enclosure[j] = intersection(enclosure[j], moved[j].cut(level));
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

  /// What finds no room is given up.
  template <class Sample>
  void sampleWhileThereIsRoom(Watch::Stage stage, const Sample& sample) {
    const double start = processCpuSeconds();
    watch_.begin(stage);
    try {
      sample();
    } catch (const std::bad_alloc&) {
      watch_.memoryFailed();
      ensemble_.reset();
      results_.stochastic.stopped = watch_.why();
    }
    results_.stochastic.cpu += processCpuSeconds() - start;
  }

  /// Before the enclosure, so that one that ends early has something to be compared with.
  void sampleFirst() {
    EnsembleOptions options =
        ensembleOptions(study_, problem_, results_.seed, options_.samples.value_or(study_.ensemble.samples));
    options.jobs = options_.jobs;
    options.secondsPerSample = results_.limits.sampleTime;
    options.progress = progressOf("samples");
    options.cancelled = watch_.stop();
    StochasticResult& stochastic = results_.stochastic;
    stochastic.present = true;
    stochastic.plan = std::string(nameOf(options.plan));
    stochastic.samples = static_cast<std::int64_t>(options.samples);
    stochastic.relativeTolerance = options.tolerance.relative;
    stochastic.absoluteTolerance = options.tolerance.absolute;
    const bool isAllThereIs = !study_.interval && !study_.fuzzy;
    sampleWhileThereIsRoom(isAllThereIs ? Watch::Stage::rest : Watch::Stage::firstSamples, [&] {
      ensemble_.emplace(problem_.motion, options);
      stochastic.samples = static_cast<std::int64_t>(ensemble_->sampling().samples());
      stochastic.corners = static_cast<std::int64_t>(ensemble_->sampling().corners());
      stochastic.alphaCorners = static_cast<std::int64_t>(ensemble_->sampling().boxCorners());
      stochastic.packWidth = static_cast<std::int64_t>(ensemble_->packWidth());
      ensemble_->integrateFirst();
      if (*watch_.stop()) stochastic.stopped = watch_.why();
    });
  }

  void sampleOthers() {
    results_.comparison.verdict = "inside";
    if (!ensemble_) return;
    sampleWhileThereIsRoom(Watch::Stage::rest, [&] {
      const Proved proved{study_.interval ? results_.interval.at : Bounds(), results_.fuzzy.outer, reachedTimes_};
      Settlement settlement(proved, problem_.motion, comparisonOptions());
      SampleKeeper keeper(ensemble_->sampling().size(), study_.uncertain.size(),
                          study_.time.size() * study_.outputs.size(), study_.storage);
      ensemble_->integrateOthers(settlement.boundsOf(0), [&](SampleBlock& block) {
        if (study_.analysis == Study::Analysis::kinematics) moveSamples(study_, problem_, block);
        settlement.settle(block, [this](const Comparison& found, int level) { takeDisputes(found, level); });
        keeper.keep(block);
      });
      describeSamples();
      results_.stochastic.kept = keeper.take();
    });
  }

  void describeSamples() {
    StochasticResult& stochastic = results_.stochastic;
    Statistics numbers = ensemble_->statistics();
    stochastic.mean = std::move(numbers.mean);
    stochastic.deviation = std::move(numbers.deviation);
    stochastic.probabilities = std::move(numbers.probabilities);
    stochastic.quantiles = std::move(numbers.quantiles);
    stochastic.resolution = std::move(numbers.resolution);
    stochastic.error = ensemble_->error();
    if (study_.fuzzy) results_.fuzzy.inner = ensemble_->innerCuts();
    stochastic.why = ensemble_->why();
    stochastic.envelope = ensemble_->envelope();
    stochastic.reached = ensemble_->reached();
    stochastic.integrated = static_cast<std::int64_t>(ensemble_->integrated());
    if (ensemble_->isComplete()) {
      stochastic.stopped.clear();
    } else if (*watch_.stop()) {
      stochastic.stopped = watch_.why();
    }
  }

  /// There are none if the first of them were not all followed.
  bool hasSamples() const { return ensemble_ && ensemble_->integrated() > 0; }

  // ---- Together -----------------------------------------------------------------------------------------------------

  void compareAnswers() {
    ComparisonResult& comparison = results_.comparison;
    comparison.present = true;
    if (comparison.verdict == "inside" && !whyEnded(results_).empty()) comparison.verdict = "incomplete";
    const std::size_t compared = std::min(reachedTimes_, hasSamples() ? ensemble_->reachedTimes() : 0);
    const bool isOfTheStartAlone = study_.time.size() > 1 && compared <= 1;
    if (!study_.interval || !hasSamples() || isOfTheStartAlone) return;
    Overestimation found = measureOverestimation({results_.interval.at, reachedTimes_}, results_.stochastic.envelope,
                                                 results_.stochastic.error);
    comparison.overestimation = std::move(found.ratio);
    comparison.excess = std::move(found.excess);
    comparison.maximum = found.maximum;
    comparison.median = found.median;
    comparison.maximumOf = std::move(found.maximumOf);
  }

  ComparisonOptions comparisonOptions() const {
    ComparisonOptions options;
    options.jobs = options_.jobs;
    options.progress = progressOf("comparison");
    options.cancelled = watch_.stop();
    return options;
  }

  /// The findings about an alpha-cut, or, level -1, about the enclosure.
  void takeDisputes(const Comparison& found, int level) {
    ComparisonResult& comparison = results_.comparison;
    for (const Dispute& d : found.disputes) {
      comparison.disputed.push_back({static_cast<std::int64_t>(d.number), d.time, d.output, d.value, d.lower, d.upper,
                                     d.distance, d.error, d.decided, d.outside, level, d.farthest});
      if (d.outside) comparison.verdict = "outside";
      if (d.decided == "unresolved" && comparison.verdict != "outside") comparison.verdict = "unresolved";
      if (d.decided != "interrupted") continue;
      if (comparison.verdict == "inside") comparison.verdict = "incomplete";
      comparison.why = watch_.why();
    }
    comparison.excursion = std::max(comparison.excursion, found.excursion);
  }

  const Study& study_;
  const RunOptions& options_;
  Watch watch_;
  Problem problem_;
  Results results_;
  std::optional<EnsembleRun> ensemble_;
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

double memoryNeeded(const Study& study, const RunOptions& options) {
  if (!study.stochastic) return 0;
  const std::size_t levels = study.fuzzy ? static_cast<std::size_t>(study.levels) : 0;
  const std::size_t times = study.time.size(), outputs = study.outputs.size(), quantities = study.uncertain.size();
  constexpr double beside = 2049;  // corners and centre at most
  const double samples = static_cast<double>(options.samples.value_or(study.ensemble.samples)) + beside;
  const double all = samples * static_cast<double>(sizeof(double) * (2 + quantities + times * outputs));
  constexpr double copies = 3;  // the samples, the file in HDF5's hands and in ours
  return ensembleBytes(times, outputs, quantities, levels) + copies * std::min(study.storage, all);
}

Results run(const Study& study, const RunOptions& options) { return Driver(study, options).run(); }

}  // namespace gamut
