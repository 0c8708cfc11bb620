// What is guaranteed and what is possible come from one flow over nested boxes, or, where nothing moves, from one
// image.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "analyses/flow/circles.hpp"
#include "analyses/flow/flow.hpp"
#include "analyses/flow/image.hpp"
#include "scalars/program/time_given.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/sampled_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

void setRow(Bounds& bounds, std::size_t row, const std::vector<Interval>& values) {
  for (std::size_t j = 0; j < values.size(); ++j) {
    bounds.lower(row, j) = values[j].lower();
    bounds.upper(row, j) = values[j].upper();
  }
}

class Encloser {
 public:
  Encloser(Run& run, const Seen& seen, const OutputScales& scales, Places& places)
      : run_(run), study_(run.study), seen_(seen), scales_(scales), places_(places) {}

  void find() {
    double work = 0, cpu = 0;
    {
      const Charge charge(&work, &cpu);
      run_.watch.begin(Watch::Stage::enclosure);
      clear();
      if (!hasRoomFor(run_, [&] { run_.moves() ? encloseMotion() : encloseConfiguration(); })) {
        clear();
        found.why = run_.watch.why();
      }
    }
    run_.spent.enclosure += work - levelWork_;
    run_.spent.cuts += levelWork_;
    found.models = {std::move(models_), study_.flow.tightness, run_.spent.enclosure, tighterFlow(run_)};
    interval.cpu = cpu - cutCpu_;
    if (!study_.asksFor<IntervalResult>()) cutCpu_ = cpu;  // no other answer is there to be charged
    interval.reached = found.reached;
    interval.why = found.why;
    interval.advice = found.advice;
  }

  void givePossibilities(FuzzyResult& fuzzy) {
    fuzzy.present = true;
    fuzzy.alpha = run_.machine.alpha;
    fuzzy.outer = std::move(cuts_);
    fuzzy.reached = found.reached;
    fuzzy.why = found.why;
    fuzzy.cpu = cutCpu_;
    const Charge charge(nullptr, &fuzzy.cpu);
    if (!run_.moves() && found.reachedTimes > 0) narrowByAssembly(run_, fuzzy);
  }

  Enclosure found;
  IntervalResult interval;

 private:
  void encloseMotion() {
    const Motion& motion = run_.machine.equations();  // of the samples', what varies in time has a course
    constexpr std::size_t few = 2, many = 8;  // angles, quantities: beyond, a flow does nothing about far angles
    const std::size_t far = run_.machine.isMotionGiven() ? countFarAngles(motion.g, 0, run_.machine.box) : 0;
    const bool isRough = far > few || (far > 0 && study_.uncertain.size() > many);
    const Tube tube =
        gamut::encloseMotion(motion, run_.machine.regular, motion.g, isRough ? roughly(options()) : options(),
                             run_.machine.box, study_.horizon, study_.times, run_.machine.levels);
    if (tube.times() != study_.times) throw std::logic_error("the flow's output times are not the study's");
    found.reachedTimes = tube.reachedTimes();
    interval.over = run_.emptyBounds();
    for (std::size_t i = 0; i < found.reachedTimes; ++i) {
      setRow(interval.at, i, tube.outputs(i));
      setRow(interval.over, i, tube.outputsOver(i));
      for (std::size_t level = 0; level < cuts_.size(); ++level) setRow(cuts_[level], i, tube.cut(level, i));
    }
    found.reached = tube.reached();
    models_ = tube.models();
    found.extremes = tube.extremes();
    found.nonlinear = tube.nonlinear();
    tellEnd(tube);
    interval.tightness = tube.tightness();
    interval.pieces = tube.pieces();
    interval.steps = tube.steps();
    cutCpu_ = tube.cutCpuSeconds();
    levelWork_ = tube.levelWork();
    enclosePlaces(run_, seen_, tube, places_);
    const bool isPlain = !isRough && varies();
    const std::string unused = far == 0 && !isPlain ? "" : narrowByImages(motion.g, isPlain);
    if (isRough) {
      interval.tightness = std::nan("");
      interval.shortfall.clear();
    }
    if (!unused.empty() && interval.shortfall.empty())
      interval.shortfall = fmt::format("what is known of {} was not used to the end: {}",
                                       far > 0 ? "angles that go far round" : "what varies in time", unused);
  }

  /// For what circles tell more of.
  static FlowOptions roughly(FlowOptions flow) {
    constexpr double loose = 1e6;
    flow.split = false;
    flow.degree = 2;
    flow.tightness = loose;
    flow.tightnessOf.assign(flow.tightnessOf.size(), loose);
    flow.levelShare = flow.levelBudget = 0;
    return flow;
  }

  /// Whether nothing is left to follow, and something varies in time.
  bool varies() const {
    return run_.machine.isMotionGiven() && std::ranges::any_of(study_.uncertain, &UncertainQuantity::varies);
  }

  /// `isPlain`: of polynomials as well, at whose extremes no sample is. None where it was cancelled.
  std::optional<CircleImage> imageOf(const Program& program, double t, const Box& box, const std::vector<Box>& levels,
                                     bool isPlain) {
    const std::vector<int>& remainders = run_.machine.remainders;
    if (!isPlain)
      return imageUnlessCancelled(program, t, box, levels, study_.flow.degree, run_.watch.stop(), remainders);
    constexpr double least = 1e6;
    const double work = std::max(least, imageWork / static_cast<double>(2 * study_.times.size()));
    Image image = findImage(program, t, box, levels, {}, study_.flow.degree, run_.watch.stop(), work, remainders);
    if (image.ranges.empty()) return std::nullopt;
    CircleImage result;
    result.ranges = std::move(image.ranges);
    return result;
  }

  /// With time as the last parameter, in halves of it, so often at most, while an output is far wider than at `ends`.
  /// Empty where it was cancelled.
  std::vector<Interval> imageOver(const Program& overTime, const Interval& time, const std::vector<Interval>& ends,
                                  int halves, bool isPlain) {
    constexpr double far = 1.5;
    Box box = run_.machine.box;
    box.push_back(time);
    const std::optional<CircleImage> image = imageOf(overTime, 0, box, {}, isPlain);
    if (!image) return {};
    std::vector<Interval> all(ends.size(), Interval::entire());
    if (!image->ranges.empty()) all = image->ranges[0];
    bool isFar = false;
    for (std::size_t j = 0; j < all.size(); ++j) isFar = isFar || !(width(all[j]) <= far * width(ends[j]));
    const double middle = midpoint(time);
    if (!isFar || halves == 0 || !(time.lower() < middle && middle < time.upper())) return all;
    const std::vector<Interval> first = imageOver(overTime, Interval(time.lower(), middle), ends, halves - 1, isPlain);
    if (first.empty()) return {};
    const std::vector<Interval> second = imageOver(overTime, Interval(middle, time.upper()), ends, halves - 1, isPlain);
    if (second.empty()) return {};
    for (std::size_t j = 0; j < all.size(); ++j) all[j] = intersection(all[j], hull(first[j], second[j]));
    return all;
  }

  static std::vector<Interval> rowOf(const Bounds& bounds, std::size_t i, std::size_t outputs) {
    std::vector<Interval> row;
    for (std::size_t j = 0; j < outputs; ++j) row.emplace_back(bounds.lower(i, j), bounds.upper(i, j));
    return row;
  }

  static void narrow(std::size_t i, Bounds& bounds, const std::vector<Interval>& by) {
    for (std::size_t j = 0; j < by.size(); ++j) {
      const Interval both = intersection(Interval(bounds.lower(i, j), bounds.upper(i, j)), by[j]);
      bounds.lower(i, j) = both.lower();
      bounds.upper(i, j) = both.upper();
    }
  }

  void takeImage(std::size_t i, const CircleImage& image) {
    if (image.ranges.empty()) return;
    narrow(i, interval.at, image.ranges[0]);
    for (std::size_t level = 0; level < cuts_.size(); ++level) narrow(i, cuts_[level], image.ranges[level + 1]);
    if (image.extremes.empty()) return;
    if (i < found.extremes.size()) found.extremes[i] = image.extremes[0];
    found.levelExtremes.insert(found.levelExtremes.end(), image.extremes.begin() + 1, image.extremes.end());
  }

  /// A motion that is given is an image at each time, and with time as one quantity more from each to the next. What
  /// varies is any number there, as what is constant, of which more is known than of what varies along a flow; of
  /// angles that go far round, circles know more. `isPlain`: of polynomials as well, as long as that costs no more than
  /// the run until then. What ended it before all of it was used.
  std::string narrowByImages(const Program& g, bool isPlain) {
    const std::size_t rows = found.reachedTimes, outputs = study_.outputs.size();
    const Program overTime = withTimeGiven(g);
    const double most = run_.basis(), before = static_cast<double>(Work::counted());
    const auto isSpent = [&](double part) {
      return isPlain && static_cast<double>(Work::counted()) - before > part * most;
    };
    std::string why;
    for (std::size_t i = 0; i < 2 * rows && why.empty(); ++i) {
      const std::size_t row = i % rows;
      if (isSpent(1)) {
        why = "it costs more than the rest";
      } else if (i < rows) {
        const auto image = imageOf(g, study_.times[row], run_.machine.box, run_.machine.levels, isPlain);
        if (image)
          takeImage(row, *image);
        else
          why = run_.watch.why();
      } else {
        const std::size_t last = row > 0 ? row - 1 : 0;
        std::vector<Interval> ends = rowOf(interval.at, row, outputs);
        const std::vector<Interval> ofLast = rowOf(interval.at, last, outputs);
        for (std::size_t j = 0; j < outputs; ++j) ends[j] = hull(ends[j], ofLast[j]);
        constexpr int often = 5;
        const std::vector<Interval> over = imageOver(overTime, Interval(study_.times[last], study_.times[row]), ends,
                                                     isPlain && !isSpent(0.5) ? often : 0, isPlain);
        if (over.empty()) why = run_.watch.why();
        narrow(row, interval.over, over);
      }
    }
    // What holds over an interval holds at its ends, and what holds at a level at those above it.
    for (std::size_t i = 0; i < rows; ++i) {
      narrow(i, interval.at, rowOf(interval.over, i, outputs));
      if (i + 1 < rows) narrow(i, interval.at, rowOf(interval.over, i + 1, outputs));
      for (std::size_t level = 0; level < cuts_.size(); ++level)
        narrow(i, cuts_[level], rowOf(level == 0 ? interval.at : cuts_[level - 1], i, outputs));
    }
    return why;
  }

  FlowOptions options() const {
    FlowOptions flow = enclosureOptions(run_, scales_);
    flow.progress = run_.progressOf("enclosure");
    constexpr double ofCounted = 0.75;  // of a second of CPU: what is counted takes longer on a busy machine
    flow.planned = ofCounted * run_.limits.enclosureTime;
    if (seen_.isEnclosed) flow.aside = {seen_.positions, seen_.at};
    flow.modelled = flow.uncounted;
    if (asksForDistributions(study_)) flow.modelledAt = plainOutputs(study_);
    boundModels(run_, flow);
    flow.extremesAt = rowsOfExtremes(study_);
    const Shares& shares = study_.shares;
    const bool areAlone = study_.requirements.empty() && !asksForDistributions(study_);  // no other answers follow
    flow.levelShare = shares.cuts + (areAlone ? shares.requirements + shares.probabilities : 0);
    flow.levelBudget = flow.levelShare * std::max(run_.spent.samples / Work::perSecond, Shares::least);
    return flow;
  }

  /// Why it ended early, or is loose, and what may help.
  void tellEnd(const Tube& tube) {
    if (tube.why() == Tube::outOfMemory) run_.watch.memoryFailed();
    found.why = tube.wasStopped() ? run_.watch.why() : tube.why();
    found.advice = tube.wasStopped() ? adviceOf(run_.watch) : tube.cause().advice();
    found.cause = tube.cause();
    if (tube.shortfall().empty()) return;
    const FlowCause& limit = tube.limitCause();
    const bool isWatch = limit.kind == FlowCause::Kind::interrupted || limit.kind == FlowCause::Kind::outOfMemory;
    const std::string why = isWatch ? run_.watch.why() : limit.sentence();
    interval.shortfall = tube.shortfall() + (why.empty() ? "" : ": " + why);
    if (found.why.empty()) found.advice = isWatch ? adviceOf(run_.watch) : limit.advice();
  }

  /// Plain intervals and polynomials both enclose, so their intersection does; but where these found nothing, an output
  /// may have no value, of which those say nothing. What ends early leaves the former.
  void encloseConfiguration() {
    const std::vector<Interval> direct = assembledOutputs(run_.machine, run_.machine.box);
    std::vector<int> modelled = marginOutputs(study_);
    std::ranges::copy(plainOutputs(study_), std::back_inserter(modelled));
    const Image image =
        findImage(run_.machine.motion.motion.g, 0.0, run_.machine.box, run_.machine.levels, modelled,
                  study_.flow.degree, run_.watch.stop(), imageWork, run_.machine.remainders, run_.machine.plainly());
    std::vector<Interval> enclosure = direct;
    const auto narrow = [&](std::size_t which, Bounds& bounds) {
      for (std::size_t j = 0; j < enclosure.size() && !image.ranges.empty(); ++j) {
        const Interval& range = image.ranges[which][j];
        enclosure[j] = isEntire(range) ? Interval::entire() : intersection(direct[j], range);
      }
      setRow(bounds, 0, enclosure);
    };
    narrow(0, interval.at);
    interval.direct = run_.emptyBounds();
    setRow(interval.direct, 0, direct);
    for (std::size_t level = 0; level < cuts_.size(); ++level) narrow(level + 1, cuts_[level]);
    if (image.ranges.empty()) found.why = run_.watch.why();
    if (!study_.requirements.empty() || asksForDistributions(study_)) models_ = image.models;
    found.extremes = {image.extremes};
    found.levelExtremes = image.levelExtremes;
    enclosePlaces(run_, seen_, places_);
    interval.pieces = static_cast<std::int64_t>(std::max<std::size_t>(image.parts, 1));
    found.reachedTimes = 1;
  }

  /// As if nothing had been found yet.
  void clear() {
    found = {};
    interval = {};
    models_.reset();
    levelWork_ = cutCpu_ = 0;
    interval.at = run_.emptyBounds();
    cuts_.assign(run_.machine.levels.size(), run_.emptyBounds());
    places_.lower = places_.upper = places_.sag = {};
  }

  Run& run_;
  const Study& study_;
  const Seen& seen_;
  const OutputScales& scales_;
  Places& places_;
  std::vector<Bounds> cuts_;  // one a level
  std::shared_ptr<const FlowModels> models_;
  double levelWork_ = 0, cutCpu_ = 0;  // of the alpha-cuts
};

}  // namespace

FlowOptions enclosureOptions(const Run& run, const OutputScales& scales) {
  FlowOptions flow = flowOptions(run.machine, run.options.jobs, run.watch.stop());
  flow.checkpoints = run.options.checkpoints;
  flow.communicator = run.options.communicator;
  for (const OutputInfo& output : run.study.outputs) flow.outputNames.push_back(output.name);
  flow.floors = floorsOf(run.study, scales);
  for (const OutputInfo& output : run.study.outputs)
    flow.tightnessOf.push_back(std::isnan(output.tightness) ? flow.tightness : output.tightness);
  constexpr double saysNothing = 1e6;
  for (std::size_t o = 0; o < scales.size(); ++o)
    flow.mostWidth.push_back(scales[o].vanishes
                                 ? std::numeric_limits<double>::infinity()
                                 : saysNothing * std::max({scales[o].size, scales[o].span, flow.floors[o]}));
  flow.uncounted = marginOutputs(run.study);  // a flow of their own comes where these are too loose
  return flow;
}

TightenedModels::Enclose tighterFlow(const Run& run) {
  if (!run.moves()) return {};
  return [&machine = run.machine](FlowOptions flow) {
    const auto model = asksForDistributions(machine.study) ? modelAll : modelMargins;
    return model(machine, std::move(flow), machine.box);
  };
}

void boundModels(const Run& run, FlowOptions& options) {
  constexpr double mostAt = 1.28e8;  // bytes, but at the times of distributions: of more output times there are fewer
  options.modelAtBytes = options.modelBytes = std::min(options.modelBytes, 0.25 * run.limits.enclosureMemory);
  options.thinAtBytes = std::min(mostAt, options.modelAtBytes);
  options.firstAt = distributionRows(run.study);
}

FlowOptions tighterOptions(const Run& run, double longestStep, const char* task) {
  FlowOptions options = flowOptions(run.machine, run.options.jobs, run.watch.stop());
  options.longestStep = std::min(options.longestStep, longestStep);
  options.progress = run.progressOf(task);
  options.checkpoints = run.options.checkpoints;
  options.communicator = run.options.communicator;
  boundModels(run, options);
  return options;
}

Enclosure enclose(Run& run, const Seen& seen, const OutputScales& scales, Results& results) {
  if (!run.isEnclosed()) return {};
  Encloser encloser(run, seen, scales, results.picture.places);
  encloser.find();
  if (run.study.asksFor<FuzzyResult>()) encloser.givePossibilities(results.fuzzy);
  if (run.study.asksFor<IntervalResult>()) {
    results.interval = std::move(encloser.interval);
    results.interval.present = true;
  }
  return std::move(encloser.found);
}

}  // namespace gamut
