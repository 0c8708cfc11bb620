// Directions as turned axes: exact axes, and in front of them rotations that are not exact.
#include "mechanics/description/loop_structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/description/names.hpp"
#include "mechanics/description/refusal.hpp"
#include "scalars/program/linear_form.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

using Terms = std::vector<std::pair<double, Expression>>;

/// Σ factor·formula where it is linear in parameters that are known exactly: as rationals times powers of pi.
struct ExactSum {
  std::map<int, mpq_class> parts;
  std::set<std::string> parameters;

  bool isZero() const {
    return std::ranges::all_of(parts, [](const auto& part) { return sgn(part.second) == 0; });
  }
  double near() const {
    Interval sum(0.0);
    for (const auto& [power, value] : parts) sum += enclose(Amount{value, power, {}});
    return midpoint(sum);
  }
};

Recorded recordedOf(const Mechanism& mechanism, const Expression& formula, const std::vector<std::string>& names,
                    const std::vector<Recorded>& values) {
  return formula.evaluate<Recorded>([&](const std::string& name) -> Recorded {
    if (const auto* derived = mechanism.derived().find(name))
      return recordedOf(mechanism, derived->formula, names, values);
    return values[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())];
  });
}

bool addTo(ExactSum& sum, const Mechanism::NamedValue& parameter, double factor) {
  if (!parameter.exact && !isThin(parameter.nominal)) return false;
  const mpq_class value = parameter.exact ? parameter.exact->value : mpq_class(parameter.nominal.lower());
  sum.parts[parameter.exact ? parameter.exact->piPower : 0] += mpq_class(factor) * value;
  sum.parameters.insert(parameter.name);
  return true;
}

/// None where the form does not say it.
std::optional<ExactSum> sumOf(const Mechanism& mechanism, const Terms& terms) {
  std::vector<std::string> names;
  for (const auto& [factor, formula] : terms)
    for (const std::string& name : mechanism.needsOf(formula))
      if (mechanism.isParameter(name) && std::ranges::find(names, name) == names.end()) names.push_back(name);
  try {
    const Program program =
        record(static_cast<int>(names.size()), 0, 1, [&](auto, const auto& x, const auto&, auto& y) {
          const std::vector<Recorded> values(x.begin(), x.end());
          for (const auto& [factor, formula] : terms)
            y[0] = y[0] + Recorded(factor) * recordedOf(mechanism, formula, names, values);
        });
    const int node = program.outputNodes()[0];
    ExactSum sum;
    LinearForm form;
    if (program.nodes()[node].op == Op::constant) {
      form.constant = program.constants()[program.nodes()[node].a];
    } else if (const auto found = linearFormOf(program, node)) {
      form = *found;
    } else {
      return std::nullopt;
    }
    if (!isThin(form.constant)) return std::nullopt;
    sum.parts[0] = mpq_class(form.constant.lower());
    for (std::size_t i = 0; i < form.states.size(); ++i)
      if (form.states[i] != 0 && !addTo(sum, *mechanism.parameters().find(names[i]), form.states[i]))
        return std::nullopt;
    return sum;
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

/// Whether the sum is known to be zero; what that rests on is added.
bool isZero(const Mechanism& mechanism, const Terms& terms, std::set<std::string>& restsOn) {
  const std::optional<ExactSum> sum = sumOf(mechanism, terms);
  if (!sum || !sum->isZero()) return false;
  restsOn.insert(sum->parameters.begin(), sum->parameters.end());
  return true;
}

bool isAcross(const Axis& a, const Axis& b) {
  mpq_class product = 0;
  for (std::size_t i = 0; i < 3; ++i) product += mpq_class(a.direction()[i]) * mpq_class(b.direction()[i]);
  return sgn(product) == 0;
}

/// Of equal direction, not opposite.
bool isAlike(const Axis& a, const Axis& b) {
  mpq_class product = 0;
  for (std::size_t i = 0; i < 3; ++i) product += mpq_class(a.direction()[i]) * mpq_class(b.direction()[i]);
  return a.isParallelTo(b) && sgn(product) > 0;
}

/// The direction of axis in a frame, behind rotations that are known by formulas alone.
struct Direction {
  struct Turn {
    Axis axis;
    Terms angle;
    int quarterTurns;
  };
  Axis axis;
  std::vector<Turn> behind = {};
  bool isKnown = true;

  bool isExact() const { return isKnown && behind.empty(); }
};

Axis turnedByQuarters(const Axis& axis, const Axis& about, int quarters) {
  std::array<double, 3> x = axis.direction();
  const auto i = static_cast<std::size_t>((about.index() + 1) % 3),
             j = static_cast<std::size_t>((about.index() + 2) % 3);
  for (int k = (quarters % 4 + 4) % 4; k > 0; --k) x[j] = std::exchange(x[i], -x[j]);
  return {x[0], x[1], x[2]};
}

/// Follows a direction through a loop.
class Follower {
 public:
  explicit Follower(const Mechanism& mechanism) : m_(mechanism) {}

  /// `by` takes vectors of what is turned to those of what it is turned in; `inverse`: the other way.
  void turn(Direction& d, const FixedRotation& by, bool inverse) {
    if (by.quaternion) {
      d.isKnown = false;
      return;
    }
    const double sign = inverse ? -1 : 1;
    const Terms angle = {{sign, by.angle}};
    const int quarters = inverse ? -by.quarterTurns : by.quarterTurns;
    std::set<std::string> zero;
    const bool isRight = isZero(m_, angle, zero);
    if (isRight && quarters % 4 == 0) {
      restsOn.insert(zero.begin(), zero.end());
    } else if (d.behind.empty() && d.axis.isParallelTo(by.axis)) {
      return;
    } else if (d.behind.empty() && isRight && by.axis.isAligned()) {
      restsOn.insert(zero.begin(), zero.end());
      d.axis = turnedByQuarters(d.axis, by.axis, by.axis.sign() > 0 ? quarters : -quarters);
    } else if (!d.behind.empty() && isAlike(d.behind.back().axis, by.axis)) {
      Direction::Turn& last = d.behind.back();
      last.angle.push_back(angle[0]);
      last.quarterTurns += quarters;
      if (last.quarterTurns % 4 == 0 && isZero(m_, last.angle, restsOn)) d.behind.pop_back();
    } else {
      d.behind.push_back({by.axis, angle, quarters});
    }
  }

  std::set<std::string> restsOn;

 private:
  const Mechanism& m_;
};

/// Of an element that moves one frame, as it says so.
class MotionOf final : public Onlooker {
 public:
  void movedFrame(const Word& /*word*/, std::string& name, const std::string& /*from*/) override {
    frames.push_back(name);
  }
  void movesAs(const KnownMotion& motion) override { known = motion; }

  std::vector<std::string> frames;
  std::optional<KnownMotion> known;
};

/// Along a loop: rotations and offsets that are fixed, and what joints do, inwards or outwards.
struct Stage {
  KnownMotion motion;
  bool isInwards;
};

/// From one frame to the other; none where an element does not say how it moves.
std::optional<std::vector<Stage>> stagesBetween(const Mechanism& mechanism, const std::string& from,
                                                const std::string& to) {
  const auto inwards = [&](std::string frame) {
    std::vector<const Mechanism::Moved*> all;
    for (const auto* moved = mechanism.moved().find(frame); moved != nullptr;
         moved = mechanism.moved().find(moved->from))
      all.push_back(moved);
    return all;
  };
  std::vector<const Mechanism::Moved*> one = inwards(from), other = inwards(to);
  while (!one.empty() && !other.empty() && one.back() == other.back()) {
    one.pop_back();
    other.pop_back();
  }
  std::vector<Stage> stages;
  const auto add = [&](const Mechanism::Moved& moved, bool isInwards) {
    const auto element = std::ranges::find(mechanism.elements(), moved.element, &Described::name);
    MotionOf motion;
    Described(*element).describe(motion);
    if (!motion.known || motion.frames.size() != 1) return false;
    stages.push_back({*motion.known, isInwards});
    return true;
  };
  std::ranges::reverse(other);
  for (const auto* moved : one)
    if (!add(*moved, true)) return std::nullopt;
  for (const auto* moved : other)
    if (!add(*moved, false)) return std::nullopt;
  return stages;
}

Terms alongOf(const Axis& axis, const ExpressionVector& place, double sign) {
  Terms terms;
  for (std::size_t i = 0; i < 3; ++i)
    if (axis.direction()[i] != 0) terms.emplace_back(sign * axis.direction()[i], place[i]);
  return terms;
}

std::array<Terms, 3> acrossOf(const Axis& axis, const ExpressionVector& place) {
  std::array<Terms, 3> all;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (axis.direction()[j] != 0) all[i].emplace_back(axis.direction()[j], place[k]);
    if (axis.direction()[k] != 0) all[i].emplace_back(-axis.direction()[k], place[j]);
  }
  return all;
}

/// A walk along the loop with a direction, and what it finds.
class Walk {
 public:
  Walk(const Mechanism& mechanism, const std::vector<Stage>& stages, Direction direction)
      : m_(mechanism), follower_(mechanism), direction_(std::move(direction)), stages_(stages) {}

  void from(const ExpressionVector& point) { offset(point, -1); }
  void go() {
    for (const Stage& stage : stages_) {
      const KnownMotion& motion = stage.motion;
      if (stage.isInwards) {
        for (auto step = motion.steps.rbegin(); step != motion.steps.rend(); ++step) move(*step);
        for (auto turn = motion.rotation.rbegin(); turn != motion.rotation.rend(); ++turn)
          follower_.turn(direction_, *turn, false);
        offset(motion.place, -1);
      } else {
        offset(motion.place, 1);
        for (const FixedRotation& turn : motion.rotation) follower_.turn(direction_, turn, true);
        for (const KnownMotion::Step& step : motion.steps) move(step);
      }
    }
  }
  void to(const ExpressionVector& point) { offset(point, 1); }

  const Direction& direction() const { return direction_; }
  bool staysAtPoint() const { return staysAtPoint_; }
  bool staysOnAxis() const { return staysOnAxis_ && direction_.isKnown; }
  /// What points are apart along the direction, of its length; none where joints change it, or it is not known.
  std::optional<ExactSum> apart() const {
    return slidesAlong_ || !direction_.isKnown ? std::nullopt : sumOf(m_, along_);
  }
  /// What it rests on that directions, offsets along them, and that offsets are along them are known.
  const std::set<std::string>& directionRestsOn() const { return follower_.restsOn; }
  const std::set<std::string>& offsetsRestOn() const { return offsetsRestOn_; }
  const std::set<std::string>& axisRestsOn() const { return axisRestsOn_; }

 private:
  void move(const KnownMotion::Step& step) {
    if (step.turns && !(direction_.isExact() && direction_.axis.isParallelTo(step.axis))) direction_.isKnown = false;
    if (!step.slides) return;
    staysAtPoint_ = false;
    if (!direction_.isExact() || !direction_.axis.isParallelTo(step.axis)) staysOnAxis_ = false;
    if (!direction_.isExact() || !isAcross(direction_.axis, step.axis)) slidesAlong_ = true;
  }
  void offset(const ExpressionVector& place, double sign) {
    std::set<std::string> zero;
    if (std::ranges::all_of(place, [&](const Expression& each) { return isZero(m_, {{1.0, each}}, zero); })) {
      offsetsRestOn_.insert(zero.begin(), zero.end());
      return;
    }
    staysAtPoint_ = false;
    if (!direction_.isKnown || !isKeptBehind(place)) {
      staysOnAxis_ = false;
      slidesAlong_ = true;
      return;
    }
    for (const Terms& each : acrossOf(direction_.axis, place)) staysOnAxis_ = staysOnAxis_ && isZero(m_, each, zero);
    if (staysOnAxis_) axisRestsOn_.insert(zero.begin(), zero.end());
    std::ranges::move(alongOf(direction_.axis, place, sign), std::back_inserter(along_));
  }

  /// Whether the rotations behind which the direction is known turn about the offset itself.
  bool isKeptBehind(const ExpressionVector& place) {
    std::set<std::string> zero;
    for (const Direction::Turn& turn : direction_.behind)
      for (const Terms& each : acrossOf(turn.axis, place))
        if (!isZero(m_, each, zero)) return false;
    offsetsRestOn_.insert(zero.begin(), zero.end());
    return true;
  }

  const Mechanism& m_;
  Follower follower_;
  Direction direction_;
  const std::vector<Stage>& stages_;
  Terms along_;
  std::set<std::string> offsetsRestOn_, axisRestsOn_;
  bool staysAtPoint_ = true, staysOnAxis_ = true, slidesAlong_ = false;
};

/// The axis of the first turn, in the frame in which the walk begins; none where that is not exact.
std::optional<Axis> firstTurn(const Mechanism& mechanism, const std::vector<Stage>& stages) {
  std::vector<std::pair<const FixedRotation*, bool>> passed;
  const auto axisOf = [&](const KnownMotion::Step& step) -> std::optional<Axis> {
    Follower back(mechanism);
    Direction direction{step.axis};
    for (auto turn = passed.rbegin(); turn != passed.rend(); ++turn) back.turn(direction, *turn->first, turn->second);
    return direction.isExact() ? std::optional(direction.axis) : std::nullopt;
  };
  for (const Stage& stage : stages) {
    const KnownMotion& motion = stage.motion;
    const auto turning = [](const KnownMotion::Step& step) { return step.turns; };
    if (!stage.isInwards)
      for (const FixedRotation& turn : motion.rotation) passed.emplace_back(&turn, false);
    if (stage.isInwards) {
      const auto step = std::find_if(motion.steps.rbegin(), motion.steps.rend(), turning);
      if (step != motion.steps.rend()) return axisOf(*step);
    } else if (const auto step = std::ranges::find_if(motion.steps, turning); step != motion.steps.end()) {
      return axisOf(*step);
    }
    if (stage.isInwards)
      for (auto turn = motion.rotation.rbegin(); turn != motion.rotation.rend(); ++turn)
        passed.emplace_back(&*turn, true);
  }
  return std::nullopt;
}

}  // namespace

HoldsAnyway holdsAnyway(const Mechanism& mechanism, const std::string& name, const FixedPoint& from,
                        const FixedPoint& to, const HeldRows& wanted) {
  HoldsAnyway holds;
  const std::optional<std::vector<Stage>> stages = stagesBetween(mechanism, from.frame, to.frame);
  if (!stages) return holds;
  std::vector<Axis> axes;
  if (wanted.axis) {
    axes.push_back(*wanted.axis);
  } else {
    if (const std::optional<Axis> axis = firstTurn(mechanism, *stages)) axes.push_back(*axis);
    if (axes.empty()) axes = {axisZ, axisX, axisY};
  }
  for (const Axis& axis : axes) {
    Walk walk(mechanism, *stages, {axis});
    walk.from(from.place);
    walk.go();
    walk.to(to.place);
    holds = {};
    holds.axis = axis;
    const Direction& end = walk.direction();
    if (wanted.parallel && end.isExact()) {
      holds.parallel = end.axis.isParallelTo(wanted.toAxis);
      if (!holds.parallel)
        throw Refusal("the axes of " + inQuotes(name) + " are not parallel, which no joint between its frames changes",
                      "axes that are parallel, or a closure that holds no axis of `to` (`ball`, `pin`)");
    }
    const std::optional<ExactSum> apart = walk.apart();
    if (walk.staysAtPoint()) {
      holds.along = wanted.along;
      holds.across = wanted.across;
    } else {
      holds.across = wanted.across && walk.staysOnAxis();
      holds.along = wanted.along && apart && apart->isZero();
      if (wanted.along && apart && !apart->isZero())
        throw Refusal(
            fmt::format("the points of '{}' lie {:.6g} m apart along {}, which no joint between its frames changes",
                        name, std::abs(apart->near()) / midpoint(axis.length()),
                        wanted.axis ? "its axis" : "the axis about which these turn"),
            "offsets along it that add to zero, or a `pin`, which holds nothing along its axis");
    }
    const auto rest = [&](bool does, const std::set<std::string>& on) {
      if (does) holds.restsOn.insert(on.begin(), on.end());
    };
    rest(holds.along || holds.across, walk.offsetsRestOn());
    rest(holds.parallel || !walk.staysAtPoint(), walk.directionRestsOn());
    rest(holds.across, walk.axisRestsOn());
    if (apart) rest(holds.along && !walk.staysAtPoint(), apart->parameters);
    if (holds.along || holds.across || holds.parallel) return holds;
  }
  return holds;
}

}  // namespace gamut
