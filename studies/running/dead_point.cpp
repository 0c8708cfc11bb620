// The nominal motion in doubles; the side on which coordinates close their loops changes at a dead point.
#include "studies/running/dead_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "analyses/samples/witness.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/equations/loop_rows.hpp"
#include "mechanics/model.hpp"
#include "studies/watch.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// What of a mechanism's numbers is not nominal.
struct OwnValues {
  std::vector<std::string> parameters = {}, states = {};
  std::vector<double> ofParameters = {}, atStart = {};
};

/// Along the motion of these values, its loops held.
class Search {
 public:
  Search(const Mechanism& held, const OwnValues& own, double seconds)
      : held_(held), assembly_(held, own.parameters, own.ofParameters), names_(held.stateNames()), seconds_(seconds) {
    motion_.f = recordMotion(held, own.parameters, Formulation::articulated);
    motion_.g = recordOutputs(held, own.parameters, names_);
    start_ = assembly_.initialState();
    for (std::size_t i = 0; i < own.states.size(); ++i) start_[placeOf(own.states[i])] = own.atStart[i];
    // Of what loops or parameters tell, differences.
    const std::vector<bool> isTold = held.startsWith(own.parameters);
    for (std::size_t i = 0; i < isTold.size(); ++i)
      if (isTold[i]) start_[i] = 0;
    std::vector<std::string> dependents = held.dependents(), rates = held.dependentRates();
    dependents.insert(dependents.end(), rates.begin(), rates.end());
    for (const std::string& name : dependents) start_[placeOf(name)] = 0;
    start_.insert(start_.end(), own.ofParameters.begin(), own.ofParameters.end());
    atStart_ = gripOfLoops(held_, assembly_.system());
  }

  struct Found {
    double from, to;
    LoopGrip grip;  // the looser one of both ends
    bool isFlat;    // the rows depend on each other there
    std::vector<std::string> alike;
  };

  std::optional<Found> find(double horizon) {
    constexpr int coarse = 400, fine = 64;
    std::optional<Found> found = look(0, horizon, coarse);
    if (!found) return {};
    if (std::optional<Found> closer = look(found->from, found->to, fine)) found = std::move(closer);
    return found;
  }

  /// Where the motion comes to an end by equations in which dependent coordinates follow.
  std::optional<Found> lookBefore(double end) {
    std::vector<double> times;
    for (const double before : nearly) times.push_back((1 - before) * end);
    const std::size_t reached = follow(times);
    return isLate_ ? std::nullopt : among(times, reached, false);
  }

 private:
  static constexpr std::array nearly{1e-3, 1e-4, 1e-5, 1e-6, 1e-7};  // of a time, how long before

  std::size_t placeOf(const std::string& state) const {
    return static_cast<std::size_t>(std::ranges::find(names_, state) - names_.begin());
  }

  /// In so many parts of a span of time.
  std::optional<Found> look(double begin, double end, int parts) {
    std::vector<double> times;
    if (begin > 0) times.push_back(begin);
    for (int i = 1; i <= parts; ++i) times.push_back(i == parts ? end : begin + (end - begin) * i / parts);
    std::size_t reached = follow(times);
    if (isLate_) return {};
    const bool isWhole = reached == times.size();
    if (!isWhole) {  // close to where it ends
      const double last = ended_;
      times.resize(reached);
      for (const double before : nearly)
        if (const double time = (1 - before) * last; time > (times.empty() ? begin : times.back()))
          times.push_back(time);
      reached = times.empty() ? 0 : follow(times);
    }
    return among(times, reached, isWhole);
  }

  std::optional<Found> among(const std::vector<double>& times, std::size_t reached, bool isWhole) {
    constexpr double dead = 1e-4, deadAtEnd = 1e-2;  // come to as the root of time
    const double first = std::abs(atStart_.determinant);
    LoopGrip before = atStart_;
    for (std::size_t i = 0; i < reached; ++i) {
      LoopGrip grip = gripAt(i, times[i]);
      const double own = std::abs(grip.determinant), other = std::abs(before.determinant);
      const bool isPassed = grip.determinant * before.determinant < 0, isLast = !isWhole && i + 1 == reached;
      if (isPassed || own < (isLast ? deadAtEnd : dead) * first) {
        constexpr double flat = 0.02;  // of how firmly loops can be held at the start
        const bool isFlat = std::min(grip.firmness, before.firmness) < flat * atStart_.firmness;
        const std::size_t nearer = isPassed && other < own && i > 0 ? i - 1 : i;
        gripAt(nearer, times[nearer]);
        std::vector<std::string> alike = isFlat ? loopsAlike(held_, assembly_.system()) : std::vector<std::string>();
        return Found{i > 0 ? times[i - 1] : 0,
                     isLast ? endBehind(times[i], times[i] - (i > 0 ? times[i - 1] : 0), own, other) : times[i],
                     isPassed && other < own ? std::move(before) : std::move(grip), isFlat, std::move(alike)};
      }
      before = std::move(grip);
    }
    return {};
  }

  /// The latest time at which |det J_d|, a root of what is left of time, may be zero: twice as far as its square tells.
  double endBehind(double time, double step, double own, double other) const {
    const double left = own < other ? step * own * own / (other * other - own * own) : step;
    return std::max(ended_, time + 2 * left);
  }

  /// Returns how many of the times it comes to.
  std::size_t follow(const std::vector<double>& times) {
    motion_.times = times;
    trajectory_.resize(names_.size() * times.size());
    const double began = processCpuSeconds();
    const Integration run = Witness(motion_).integrate(start_, {}, trajectory_, seconds_);
    const double spent = processCpuSeconds() - began;
    isLate_ = run.times < times.size() && spent >= seconds_;
    seconds_ = std::max(0.0, seconds_ - spent);
    ended_ = run.reached;
    return run.times;
  }

  LoopGrip gripAt(std::size_t i, double time) {
    assembly_.setState(std::span(trajectory_).subspan(i * names_.size(), names_.size()), time);
    return gripOfLoops(held_, assembly_.system());
  }

  const Mechanism& held_;
  Assembly<double> assembly_;
  std::vector<std::string> names_;
  double seconds_;
  Motion motion_;
  std::vector<double> start_, trajectory_;  // all states and parameters; the states at each time
  LoopGrip atStart_;
  double ended_ = 0;
  bool isLate_ = false;
};

std::string listed(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

/// `ended`: the time, if any, at which that motion is known to have ended.
std::optional<DeadPoint> deadPointOf(const Study& study, const OwnValues& own, double seconds, double ended = 0) {
  if (!study.moves() || !study.mechanism.isClosed()) return std::nullopt;
  Mechanism held = study.mechanism;
  held.holdLoops();
  const bool isDriven = static_cast<std::size_t>(held.degreesOfFreedom()) == held.dependents().size();
  Search search(held, own, seconds);
  std::optional<Search::Found> found = search.find(study.horizon);
  if (!found && ended > 0) found = search.lookBefore(ended);
  if (!found) return std::nullopt;
  if (isDriven) found->isFlat = false, found->alike.clear();  // of what drives move no rows tell
  if (study.mechanism.areLoopsHeld() && !isDriven && !found->isFlat) return std::nullopt;
  return DeadPoint{found->from,
                   found->to,
                   std::move(found->grip.loose),
                   std::move(found->grip.best),
                   isDriven,
                   std::move(found->alike)};
}

}  // namespace

std::optional<DeadPoint> deadPointOf(const Study& study, double seconds) { return deadPointOf(study, {}, seconds); }

std::optional<DeadPoint> deadPointOf(const Machine& machine, std::span<const double> values, double ended,
                                     double seconds) {
  OwnValues own{.parameters = machine.freeParameters};
  const std::vector<double> start = machine.motion.start(values);
  own.ofParameters.assign(start.begin() + static_cast<std::ptrdiff_t>(machine.states), start.end());
  const std::vector<std::string> states = machine.study.mechanism.stateNames();
  for (const int slot : machine.motion.slot)
    if (const auto i = static_cast<std::size_t>(slot); i < machine.states) {
      own.states.push_back(states[i]);
      own.atStart.push_back(start[i]);
    }
  return deadPointOf(machine.study, own, seconds, ended);
}

std::string DeadPoint::sentence(std::string_view whose) const {
  constexpr int digits = 4;
  const auto [earliest, latest] = outwardText(from, to, std::max(digits, digitsFor(to, to - from, 1)));
  const std::string when = fmt::format("between {} s and {} s", earliest, latest);
  if (!alike.empty())
    return fmt::format(
        "{} comes {} to where rows of {} depend on each other, so that {} may go on in more ways than one", whose, when,
        listed(alike), alike.size() == 1 ? "it" : "they");
  return fmt::format("{} comes to a dead point of {} {}, where {} from no others", whose, listed(coordinates), when,
                     coordinates.size() == 1 ? "it follows" : "they follow");
}

std::string DeadPoint::advice() const {
  std::string names;
  for (const std::string& name : others) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  if (!alike.empty())
    return fmt::format(
        "numbers by which the motion does not come to where all of a loop lies in line, or a horizon "
        "before {} s: nothing passes such a point",
        outwardText(from, from, 4).first);
  if (isDriven) return "a drive of another joint, or a motion that stays off the dead point";
  return fmt::format("mechanism.loops = \"multipliers\"{}",
                     names.empty() ? "" : fmt::format(", or dependent = [{}], which are firm there", names));
}

std::string noteOfDeadPoint(const Study& study) try {
  constexpr double seconds = 2;
  const std::optional<DeadPoint> dead = deadPointOf(study, seconds);
  if (!dead) return {};
  return fmt::format("{}: note: {}; what helps: {}", study.places.of(study.mechanism.loops().front().element),
                     dead->sentence(), dead->advice());
} catch (const std::domain_error&) {  // the motion has no value: a run says so
  return {};
} catch (const std::invalid_argument&) {  // what cannot be held
  return {};
}

}  // namespace gamut
