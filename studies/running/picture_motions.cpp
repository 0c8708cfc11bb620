// The picture's numbers: the machine's parts, a few motions, and where its points certainly are.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "analyses/flow/outputs/plain_outputs.hpp"
#include "analyses/samples/sampling.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/program/recorder.hpp"
#include "studies/printable.hpp"
#include "studies/running/sampled_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// A radius of a body that may have no mass is unknown, and not drawn.
double finiteOrZero(double x) { return std::isfinite(x) ? x : 0; }

void describeParts(const Study& study, const Skeleton& skeleton, PictureResult& machine) {
  const Mechanism& mechanism = study.mechanism;
  const auto nominal = [&](const Expression& number) { return midpoint(mechanism.rangeOf(number)); };
  machine.present = machine.places.present = true;
  for (std::size_t i = 0; i < 3; ++i)
    machine.directions.push_back({components[i], mechanism.gravity() ? nominal((*mechanism.gravity())[i]) : 0.0});
  for (const Skeleton::Point& point : skeleton.points)
    machine.points.push_back({printable(point.name), point.isFixed, point.isGround});
  for (const Skeleton::Part& part : skeleton.parts) {
    const auto told = study.units.find(part.name + ".mass");
    machine.parts.push_back({printable(part.name), printable(part.type), static_cast<PartKind>(part.kind), part.from,
                             part.to, part.turns, part.slides, nominal(part.mass),
                             told == study.units.end() ? std::string() : told->second,
                             finiteOrZero(std::fabs(nominal(part.radius))), finiteOrZero(nominal(part.ratio))});
  }
  for (const Skeleton::JointAxis& axis : skeleton.axes) machine.axes.push_back({printable(axis.name), axis.part});
}

/// Integrates one motion after the other, each alone.
class Follower {
 public:
  Follower(const Run& run, const Seen& seen, const UncertainMotion& motion)
      : motion_(motion.motion), tolerance_(run.study.ensemble.tolerance), seconds_(run.limits.sampleTime) {
    motion_.g = run.machine.alongCourses(seen.drawn);
    motion_.times = seen.at;
    witness_.emplace(motion_, run.study.ensemble.method, run.watch.stop());
  }

  /// [time][point and axis][direction]; what was not reached is NaN, but for the start, where nothing is integrated.
  Table follow(const std::vector<double>& start) {
    Table table(motion_.times.size(), motion_.outputs());
    witness_->integrate(start, tolerance_, table.data, seconds_);
    const auto states = static_cast<std::ptrdiff_t>(motion_.f.states());
    Evaluator<double> evaluate(motion_.g);
    evaluate.setParameters(std::vector<double>(start.begin() + states, start.end()));
    std::ranges::copy(evaluate(0.0, {start.begin(), start.begin() + states}), table.data.begin());
    return table;
  }

 private:
  Motion motion_;
  Tolerance tolerance_;
  double seconds_;
  std::optional<Witness> witness_;
};

/// As far as the machine is large at the start, or goes in a quarter of the motion.
double reachOf(const Places& places, std::size_t points, double speed) {
  double size = 0;
  for (std::size_t k = 0; k < 3 * points; ++k)
    for (std::size_t l = k % 3; l < k; l += 3) size = std::fmax(size, std::fabs(places.nominal[k] - places.nominal[l]));
  return size > 0 ? size : 0.25 * std::fabs(speed) * places.time.back();
}

/// The profiles of a machine.
class Roads {
 public:
  explicit Roads(const Run& run, const Program& heights)
      : run_(run),
        states_(static_cast<std::ptrdiff_t>(run.machine.states)),
        start_(run.machine.motion.nominal.begin(), run.machine.motion.nominal.begin() + states_),
        evaluate_(heights) {}

  /// What lies ahead by s is met s/v later: heights at all times, those before and behind the motion's too. Of a
  /// machine that stands as long as all is nominal, those that it meets from the start at the greatest speed it may
  /// have: they stay where they are, as it does.
  std::vector<double> heights(std::size_t number, const Expression& speed, const PictureResult& machine,
                              double& reach) {
    const Places& places = machine.places;
    setParameters(speed, false);
    double v = at(0, 2 * number + 1);
    const bool stands = v == 0;
    if (stands) setParameters(speed, true);
    if (stands) v = at(0, 2 * number + 1);
    reach = reachOf(places, machine.points.size(), v);
    std::vector<double> all;
    for (const double time : places.time)
      for (const double step : places.step) {
        const double now = stands ? 0 : time, then = v == 0 ? now : now + step * reach / v;
        all.push_back(at(then, 2 * number) - at(now, 2 * number));
      }
    return all;
  }

 private:
  double at(double t, std::size_t output) { return evaluate_(t, start_)[output]; }

  void setParameters(const Expression& speed, bool isFastest) {
    const Machine& machine = run_.machine;
    std::vector<double> parameters(machine.motion.nominal.begin() + states_, machine.motion.nominal.end());
    for (std::size_t i = 0; i < machine.freeParameters.size() && i < parameters.size(); ++i)
      if (isFastest && run_.study.mechanism.dependsOn(speed, machine.freeParameters[i]))
        parameters[i] = machine.box[machine.states + i].upper();
    evaluate_.setParameters(parameters);
  }

  const Run& run_;
  std::ptrdiff_t states_;
  std::vector<double> start_;
  Evaluator<double> evaluate_;
};

void lookAlongProfiles(const Run& run, const Seen& seen, PictureResult& machine) {
  if (seen.heights.outputs() == 0) return;
  const Program heights = run.machine.alongCourses(seen.heights);
  for (std::size_t k = 0; k <= 2 * seenSteps; ++k)
    machine.places.step.push_back(static_cast<double>(k) / static_cast<double>(seenSteps) - 1);
  Roads roads(run, heights);
  const std::vector<Skeleton::Part>& parts = seen.skeleton.parts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].kind != Skeleton::Kind::profile) continue;
    ProfileInfo profile{printable(parts[i].name), i, 0, {}};
    profile.heights = roads.heights(machine.profiles.size(), parts[i].speed, machine, profile.reach);
    machine.profiles.push_back(std::move(profile));
  }
}

/// Of each row the numbers from `first` to `last`.
void append(std::vector<double>& to, const Table& table, std::size_t first, std::size_t last) {
  for (std::size_t i = 0; i < table.times; ++i)
    for (std::size_t k = first; k < last; ++k) to.push_back(table(i, k));
}

/// Plans are such that their first samples lie apart, but for grids.
std::vector<std::size_t> shownSamples(const Sampling& sampling, Plan plan) {
  std::vector<std::size_t> numbers;
  const std::size_t count = std::min(seenSamples, sampling.samples());
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(plan == Plan::grid ? i * (sampling.samples() - 1) / std::max<std::size_t>(count - 1, 1) : i);
  return numbers;
}

/// The outputs, then what has to have one sign, as the arguments of roots and logarithms.
Program withArguments(const Program& program) {
  std::vector<int> nodes = program.outputNodes();
  for (const Node& node : program.nodes())
    if (isOneSided(domainOf(node.op))) nodes.push_back(node.a);
  return Recorder(program).finish(nodes);
}

/// Values over boxes; nothing is known of any where one of them may have none.
class BoxValues {
 public:
  BoxValues(const Program& program, std::span<const Interval> parameters)
      : outputs_(static_cast<std::size_t>(program.outputs())), evaluate_(withArguments(program)) {
    evaluate_.setParameters(parameters);
  }
  std::vector<Interval> over(const Interval& t, const std::vector<Interval>& states) {
    std::vector<Interval> values = evaluate_(t, states);
    const bool isDefined = std::all_of(values.begin() + static_cast<std::ptrdiff_t>(outputs_), values.end(),
                                       [](const Interval& argument) { return argument.lower() >= 0; });
    values.resize(outputs_, Interval(0.0));
    for (Interval& value : values)
      if (!isDefined || isEmpty(value)) value = Interval::entire();
    return values;
  }

 private:
  std::size_t outputs_;
  Evaluator<Interval> evaluate_;
};

/// Whether an output depends on a parameter that varies in time: then it may move without its velocity.
bool mayJump(const Program& program, const std::vector<VaryingParameter>& varying) {
  std::vector<char> isUsed(program.nodes().size(), 0);
  for (const int output : program.outputNodes()) isUsed[output] = 1;
  for (std::size_t i = isUsed.size(); i-- > 0;)
    if (isUsed[i] != 0)
      detail::forEachOperand(program.table(), static_cast<int>(i), [&](int operand) { isUsed[operand] = 1; });
  return std::ranges::any_of(varying, [&](const VaryingParameter& of) {
    for (std::size_t i = 0; i < isUsed.size(); ++i)
      if (isUsed[i] != 0 && program.nodes()[i].op == Op::parameter && program.nodes()[i].a == of.parameter) return true;
    return false;
  });
}

/// Bounds of how far points leave chords.
class Sags {
 public:
  Sags(const Machine& machine, const Seen& seen, const Tube& tube)
      : tube_(tube),
        parameters_(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end()),
        jumps_(mayJump(seen.positions, machine.varying)),
        values_(jumps_ ? seen.positions : seen.velocities, parameters_) {}

  /// Between output times i < j. A path that goes at speeds between l and u leaves the chord, of slope m, by no more
  /// than (u - m) s after the time s, nor by more than (m - l)(h - s), since it comes to its end: by (u - l) h / 4 at
  /// most; likewise downwards. A place that may jump is somewhere in its box, and a point of the chord is the middle of
  /// `end`.
  std::vector<double> between(std::size_t i, std::size_t j, const std::vector<Interval>& end) {
    std::vector<Interval> range;
    for (std::size_t k = i + 1; k <= j; ++k) {
      const Interval during(tube_.times()[k - 1], tube_.times()[k]);
      std::vector<Interval> own = values_.over(during, tube_.statesOver(k));
      if (range.empty())
        range = std::move(own);
      else
        for (std::size_t v = 0; v < range.size(); ++v) range[v] = hull(range[v], own[v]);
    }
    const Interval h = Interval(tube_.times()[j]) - Interval(tube_.times()[i]);
    std::vector<double> sags;
    for (std::size_t v = 0; v < range.size(); ++v) {
      sags.push_back(std::numeric_limits<double>::infinity());
      if (!isBounded(range[v])) continue;
      const Interval far = jumps_ ? abs(range[v] - Interval(midpoint(end[v])))
                                  : (Interval(range[v].upper()) - Interval(range[v].lower())) * h * Interval(0.25);
      sags.back() = far.upper();
    }
    return sags;
  }

 private:
  const Tube& tube_;
  std::vector<Interval> parameters_;
  bool jumps_;
  BoxValues values_;
};

void put(std::vector<double>& lower, std::vector<double>& upper, std::size_t row, const std::vector<Interval>& bounds) {
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    lower[row * bounds.size() + k] = bounds[k].lower();
    upper[row * bounds.size() + k] = bounds[k].upper();
  }
}

void makeRoom(const Seen& seen, Places& places) {
  const std::size_t numbers = seen.times.size() * 3 * seen.skeleton.points.size();
  for (std::vector<double>* of : {&places.lower, &places.upper, &places.sag})
    of->assign(numbers, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Seen lookAtMachine(Run& run, PictureResult& picture) try {
  run.watch.begin(Watch::Stage::firstSamples);
  Seen seen = whatIsSeen(run.machine);
  if (seen.empty()) return seen;
  describeParts(run.study, seen.skeleton, picture);
  Places& places = picture.places;
  places.time = seen.at;
  const Table nominal = Follower(run, seen, run.machine.motion).follow(run.machine.motion.nominal);
  const std::size_t coordinates = 3 * seen.skeleton.points.size();
  append(places.nominal, nominal, 0, coordinates);
  append(places.axes, nominal, coordinates, nominal.outputs);
  lookAlongProfiles(run, seen, picture);
  return seen;
} catch (const std::bad_alloc&) {  // the answers are worth more than a picture
  picture = {};
  return {};
}

void enclosePlaces(const Run& run, const Seen& seen, const Tube& tube, Places& places) {
  if (!seen.isEnclosed) return;
  makeRoom(seen, places);
  Sags sags(run.machine, seen, tube);
  const std::vector<std::size_t>& times = seen.times;
  for (std::size_t row = 0; row < times.size() && times[row] < tube.reachedTimes(); ++row) {
    const std::vector<Interval>& bounds = tube.asides(times[row]);
    put(places.lower, places.upper, row, bounds);
    const std::vector<double> sag =
        row == 0 ? std::vector<double>(bounds.size(), 0.0) : sags.between(times[row - 1], times[row], bounds);
    std::ranges::copy(sag, places.sag.begin() + static_cast<std::ptrdiff_t>(row * bounds.size()));
  }
}

void enclosePlaces(const Run& run, const Seen& seen, Places& places) {
  if (!seen.isEnclosed) return;
  const auto images = encloseImage(seen.positions, 0.0, run.machine.box, {}, run.study.flow.degree, run.watch.stop(),
                                   run.machine.remainders);
  std::vector<Interval> bounds = BoxValues(seen.positions, run.machine.box).over(Interval(0.0), {});
  for (std::size_t k = 0; k < bounds.size() && !images.empty(); ++k)
    bounds[k] = intersection(bounds[k], images.front()[k]);
  makeRoom(seen, places);
  put(places.lower, places.upper, 0, bounds);
  std::ranges::fill(places.sag, 0.0);
}

void showSamples(Run& run, const Seen& seen, const std::string& whyEnclosureEnded, const UncertainMotion& motion,
                 Results& results) try {
  if (seen.empty()) return;
  PictureResult& machine = results.picture;
  if (run.study.asksFor<IntervalResult>())
    machine.why = seen.isEnclosed
                      ? whyEnclosureEnded
                      : "of more than " + std::to_string(mostEnclosedPoints) + " moving points no places are enclosed";
  if (!run.study.asksFor<StochasticResult>() || *run.watch.stop()) return;
  run.watch.begin(Watch::Stage::rest);
  const EnsembleOptions options =
      ensembleOptions(run.machine, results, run.options.samples.value_or(run.study.ensemble.samples));
  Sampling sampling(options.plan, run.study.uncertain.size(), options.samples, options.seed);
  sampling.correlate(motion.dependence.copulas);
  Follower follower(run, seen, motion);
  for (const std::size_t number : shownSamples(sampling, options.plan)) {
    const Table sample = follower.follow(motion.start(sampling.values(number, motion.uncertain)));
    machine.places.sample.push_back(static_cast<std::int64_t>(number));
    append(machine.places.samples, sample, 0, 3 * seen.skeleton.points.size());
  }
} catch (const std::bad_alloc&) {
  results.picture.places.sample.clear();
  results.picture.places.samples.clear();
}

}  // namespace gamut
