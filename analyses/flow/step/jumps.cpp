// Rates by intervals, and what follows from them. Derivations: docs/flow.md, section 7.
#include "analyses/flow/step/jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "analyses/flow/series/embedded.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

/// An argument with an input in it moves at rates that nobody knows.
FlowJumps::FlowJumps(const Program& differentiated, const std::vector<int>& varying, std::span<const RestingPair> pairs)
    : f(Recorder(differentiated)
            .finish({differentiated.outputNodes().begin(),
                     differentiated.outputNodes().begin() + differentiated.states()})),
      given(f) {
  const std::vector<int> jumps = jumpsOf(f);
  if (jumps.empty()) return;
  isAffine = isAffineInSigns(f);
  given = withSignsGiven(f);
  for (const int jump : jumps) {
    forms.push_back(linearFormOf(f, f.nodes()[jump].a));
    for (const int parameter : varying)
      if (forms.back() && forms.back()->parameters[parameter] != 0) forms.back().reset();
  }
  rests = restingJumps(pairs, forms);
}

std::vector<char> FlowJumps::bySigns(std::vector<char> held) {
  std::ranges::replace(held, atRest, char{0});
  return held;
}

namespace {

std::vector<Side> sidesOf(const std::vector<char>& held) {
  std::vector<Side> sides;
  for (const char how : held)
    sides.push_back(how == byItsSign ? Side::held : how == atRest ? Side::between : Side::open);
  return sides;
}

/// 1, or -1 where one is the negative of the other, as far as numbers are known; 0: another.
double ratioAsWritten(const LinearForm& a, const LinearForm& b) {
  for (const double sign : {1.0, -1.0}) {
    const auto isSame = [&](double x, double y) { return x == sign * y; };
    if (std::ranges::equal(a.states, b.states, isSame) && std::ranges::equal(a.parameters, b.parameters, isSame) &&
        isEqual(a.constant, Interval(sign) * b.constant))
      return sign;
  }
  return 0.0;
}

}  // namespace

/// At rest the outputs of an unfolded motion are the same whatever these signs: of a place that is known by an
/// enclosure alone it cannot be told that two are one.
Program FlowJumps::withoutSignsAtRest(const Program& g, const std::vector<char>& held) const {
  if (std::ranges::find(held, atRest) == held.end()) return g;
  Recorder recorder(g.states(), g.parameters());
  std::vector<int> instead(g.nodes().size(), -1), outputs;
  for (const int jump : jumpsOf(g)) {
    const std::optional<LinearForm> own = linearFormOf(g, g.nodes()[jump].a);
    for (std::size_t k = 0; k < held.size() && own; ++k)
      if (held[k] == atRest && ratioAsWritten(*own, *forms[k]) != 0) instead[jump] = recorder.constant(0.0);
  }
  const std::vector<int> here = recorder.append(g, {}, instead);
  for (const int output : g.outputNodes()) outputs.push_back(here[output]);
  return recorder.finish(outputs);
}

Program FlowJumps::outputsGiven(const Program& g, const std::vector<char>& held) const {
  if (jumpsOf(f).empty()) return g;
  const Program bare = withBareKinks(g);  // as f is, so that its surfaces are found again
  return held.empty() ? withSignsGiven(f, bare)
                      : outputsWithOpenSignsGiven(f, withoutSignsAtRest(bare, held), sidesOf(held));
}

FlowJumps::Held FlowJumps::heldProgram(const std::vector<char>& held) const {
  const Program all = onSides(f, sidesOf(held));
  const std::vector<int>& outputs = all.outputNodes();
  const std::size_t n = at(f.states()), count = held.size();
  Recorder recorder(all);
  std::vector<int> rates(outputs.begin(), outputs.begin() + f.states());
  std::vector<char> stands(n, 0);
  for (const RestingJumps& rest : rests)
    if (held[rest.speed] == atRest)
      for (const int state : {rest.states.position, rest.states.speed}) {
        stands[state] = 1;
        rates[state] = recorder.constant(0.0);  // exactly
      }
  Held result{recorder.finish(rates), std::vector<int>(count, -1), std::vector<double>(count, 1.0)};
  std::vector<int> nodes(count, -1);  // of the signs left; where surfaces meet, two that agree elsewhere are still two
  for (std::size_t k = 0; k < count; ++k) {
    if (held[k] != 0) continue;
    int node = outputs[n + count + k];
    if (all.nodes()[node].op == Op::neg) {
      node = all.nodes()[node].a;
      result.factor[k] = -1;
    }
    const Node& sign = all.nodes()[node];
    const bool isFixed =
        sign.op == Op::constant && magnitude(all.constants()[sign.a]) == 1 && isThin(all.constants()[sign.a]);
    if (isFixed) continue;
    if (sign.op != Op::sign || std::ranges::find(nodes, node) != nodes.end())
      throw std::logic_error("signs become one or zero where others are held");
    nodes[k] = node;
  }
  std::vector<char> isUsed(all.nodes().size(), 0);
  for (std::size_t i = 0; i < n; ++i)
    if (stands[i] == 0) isUsed[outputs[i]] = 1;
  for (std::size_t i = isUsed.size(); i-- > 0;)
    if (isUsed[i] != 0)
      detail::forEachOperand(all.table(), static_cast<int>(i), [&](int operand) { isUsed[operand] = 1; });
  int next = 0;
  for (const int jump : jumpsOf(all)) {
    const auto place = std::ranges::find(nodes, jump);
    if (isUsed[jump] == 0) continue;
    if (place == nodes.end()) throw std::logic_error("a sign of which it is not known what it was");
    result.left[place - nodes.begin()] = next++;
  }
  return result;
}

void FlowJumps::Held::matchTo(const FlowJumps& jumps) {
  const std::vector<int> own = jumpsOf(f);
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (left[k] < 0) continue;
    const auto form = linearFormOf(f, f.nodes()[own[left[k]]].a);
    left[k] = -1;
    for (std::size_t j = 0; j < jumps.forms.size() && form && left[k] < 0 && jumps.count() == own.size(); ++j) {
      const double sign = jumps.forms[j] ? ratioAsWritten(*jumps.forms[j], *form) : 0;
      if (sign == 0) continue;
      left[k] = static_cast<int>(j);
      factor[k] *= sign;
    }
  }
}

JumpBounder::JumpBounder(const FlowJumps& jumps)
    : jumps_(jumps), given_(jumps.given), results_(at(jumps.given.outputs())) {}

void JumpBounder::setParameters(const std::vector<Embedded>& parameters) { parameters_ = rangesOf(parameters); }

/// Of the argument, with its sign given.
Interval JumpBounder::rate(std::size_t jump, double sign, const Interval& time, const Box& box,
                           const std::vector<JumpBound>& bounds) {
  Box all = parameters_;
  for (const JumpBound& bound : bounds) all.push_back(bound.sign);
  all[parameters_.size() + jump] = Interval(sign);
  given_.setParameters(all);
  given_(time, box, results_);
  const Interval& byIntervals = results_[box.size() + bounds.size() + jump];
  if (known_.empty()) return byIntervals;
  const Interval& known = sign > 0 ? known_[jump].up : known_[jump].down;
  const Interval both = intersection(byIntervals, known);
  return isEmpty(both) ? known : both;
}

/// u̇ = r - G s for s in [-1, 1], u̇ >= 0 where s = 1, and <= 0 where -1: a linear complementarity problem, by projected
/// Gauss-Seidel iteration (R. Cottle, J.-S. Pang, R. Stone, The Linear Complementarity Problem, 1992, chapter 5).
std::vector<double> JumpBounder::signsFromRest(double time, const Box& states, std::vector<double> signs,
                                               const std::vector<char>& isZero) {
  const std::size_t count = signs.size();
  const auto ratesAt = [&](const std::vector<double>& at) {
    Box all;
    for (const Interval& parameter : parameters_) all.emplace_back(midpoint(parameter));
    for (const double sign : at) all.emplace_back(sign);
    given_.setParameters(all);
    given_(Interval(time), states, results_);
    std::vector<double> rates;
    for (std::size_t k = 0; k < count; ++k) rates.push_back(midpoint(results_[states.size() + count + k]));
    return rates;
  };
  for (std::size_t k = 0; k < count; ++k)
    if (isZero[k] != 0) signs[k] = 0;
  const std::vector<double> r = ratesAt(signs);
  std::vector<std::vector<double>> G(count);  // by columns
  for (std::size_t j = 0; j < count; ++j) {
    if (isZero[j] == 0) continue;
    std::vector<double> one = signs;
    one[j] = 1;
    G[j] = ratesAt(one);
    for (std::size_t k = 0; k < count; ++k) G[j][k] = r[k] - G[j][k];
    if (!(G[j][j] > 0)) return {};
  }
  constexpr int rounds = 1000;
  double change = 1;
  for (int round = 0; round < rounds && change > 0; ++round) {
    change = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (isZero[k] == 0) continue;
      double rate = r[k];
      for (std::size_t j = 0; j < count; ++j)
        if (isZero[j] != 0) rate -= G[j][k] * signs[j];
      const double next = std::clamp(signs[k] + rate / G[k][k], -1.0, 1.0);
      if (!(std::fabs(next) <= 1)) return {};
      change = std::max(change, std::fabs(next - signs[k]));
      signs[k] = next;
    }
    if (change < 1e-15) break;
  }
  return signs;
}

Interval JumpBounder::pressure(const RestingJumps& rest, const Interval& time, const Box& box,
                               const std::vector<JumpBound>& bounds) {
  Box all = parameters_;
  for (const JumpBound& bound : bounds) all.push_back(bound.sign);
  all[parameters_.size() + rest.position] = Interval(rest.ofPosition(1));
  all[parameters_.size() + rest.speed] = Interval(rest.ofSpeed(-1));
  given_.setParameters(all);
  given_(time, box, results_);
  return -results_[rest.states.speed];
}

void JumpBounder::narrow(const LinearForm& form, const Interval& argument, Box& box) const {
  const Interval others = rangeWithout(at(form.pivot), form, box, parameters_);
  Interval& pivot = box[form.pivot];
  const Interval both = intersection(pivot, (argument - others) / Interval(form.states[form.pivot]));
  if (!isEmpty(both)) pivot = both;
}

void JumpBounder::bound(const Interval& time, const Box& box, const std::vector<Interval>& start, double h,
                        std::vector<JumpBound>& bounds, std::span<const SideRates> known) {
  known_ = known;
  constexpr int rounds = 2;  // what is known of arguments narrows the states, and these the rates
  Box narrowed = box, all = parameters_;
  for (const JumpBound& bound : bounds) all.push_back(bound.sign);
  given_.setParameters(all);
  given_(time, box, results_);
  for (std::size_t k = 0; k < bounds.size(); ++k) {  // arguments that are on one side all the time
    const Interval& argument = results_[box.size() + k];
    const double side = argument.lower() > 0 ? 1 : argument.upper() < 0 ? -1 : 0;
    if (side != 0 && contains(bounds[k].sign, side)) bounds[k].sign = Interval(side);
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < bounds.size(); ++k) {
      if (!isCommon(start[k])) continue;
      boundOne(k, time, narrowed, start[k], h, bounds);
      if (jumps_.forms[k]) narrow(*jumps_.forms[k], bounds[k].over, narrowed);
    }
}

/// So long as it is on one side it goes no further than the rates there take it, and once at zero it stays or leaves to
/// where its rate points away.
JumpBound::Reach JumpBound::after(double seconds) const {
  const Interval length(seconds), passed(0.0, seconds);
  const double low = start.lower(), high = start.upper();
  // Seen from above; from below the same, mirrored.
  const auto above = [&](double from, const Interval& own) {  // {at all times, at the end}, upper bounds
    const double begin = std::max(from, 0.0);
    const double most = (Interval(begin) + passed * Interval(own.upper())).upper();
    const double end =
        own.upper() <= 0 ? std::max(0.0, (Interval(from) + length * Interval(own.upper())).upper()) : most;
    return std::pair(most, end);
  };
  auto [mostEver, mostEnd] = above(high, up);
  auto [mirroredEver, mirroredEnd] = above(-low, -down);
  double leastEver = -mirroredEver, leastEnd = -mirroredEnd;
  // Those that are on one side at all times, and those that leave from zero to one side for good.
  const auto away = [&](double from, const Interval& own, const Interval& other, double& ever, double& end) {
    const double reached = (Interval(from) + passed * Interval(own.lower())).lower();
    const bool staysThere = from > 0 && reached > 0, leaves = from >= 0 && own.lower() > 0 && other.lower() > 0;
    if (!staysThere && !leaves) return;
    ever = staysThere ? reached : from;
    end = (Interval(from) + length * Interval(own.lower())).lower();
  };
  away(low, up, down, leastEver, leastEnd);
  double mirrored = -mostEver, mirroredAtEnd = -mostEnd;
  away(-high, -down, -up, mirrored, mirroredAtEnd);
  const auto between = [](double lower, double upper) {  // no number fits both only if there are no solutions
    return lower <= upper ? Interval(lower, upper) : Interval::entire();
  };
  return {between(leastEver, -mirrored), between(leastEnd, -mirroredAtEnd)};
}

Interval SignCases::hull() const {
  Interval result = between;
  if (above) result = gamut::hull(result, Interval(1.0));
  if (below) result = gamut::hull(result, Interval(-1.0));
  return result;
}

SignCases SignCases::during(const Interval& seconds) const {
  SignCases left = *this;
  left.above = above && !isEmpty(intersection(whileAbove, seconds));
  left.below = below && !isEmpty(intersection(whileBelow, seconds));
  if (isEmpty(intersection(whileBetween, seconds))) left.between = Interval::empty();
  return left.above || left.below || !isEmpty(left.between) ? left : *this;
}

/// Of those at zero at first none stays: their sign then is that of the step before.
bool JumpBound::leaves() const {
  return (start.lower() >= 0 && up.lower() > 0 && down.lower() > 0) ||
         (start.upper() <= 0 && up.upper() < 0 && down.upper() < 0);
}

JumpBound JumpBound::held(const Interval& sign) {
  const Interval towards(1.0, 2.0);  // whatever the rates are
  return {.start = Interval(0.0),
          .up = -towards,
          .down = towards,
          .over = Interval(0.0),
          .sign = sign,
          .slid = sign,
          .holds = true};
}

/// Only what `sign` allows, if anything.
SignCases JumpBound::within(SignCases cases) const {
  cases.above = cases.above && sign.upper() >= 1;
  cases.below = cases.below && sign.lower() <= -1;
  cases.between = intersection(cases.between, sign);
  return cases.above || cases.below || !isEmpty(cases.between) ? cases : SignCases{};
}

/// What has not been at zero by then has its first sign; it may have where u(0) + t sup U₊ >= 0, which is not cut at
/// zero as `after` is: the moment of arriving counts for both. What leaves at once has no sign at that moment.
SignCases JumpBound::signAfter(double seconds) const {
  if (!isKnown()) return within({});
  const auto [ever, then] = after(seconds);
  const auto reach = [&](double from, const Interval& own) {
    return (Interval(from) + Interval(seconds) * own).upper();
  };
  const bool mayBeZero = contains(then, 0.0);
  SignCases cases;
  cases.above = then.upper() > 0 || (mayBeZero && ever.upper() > 0 && reach(start.upper(), up) >= 0);
  cases.below = then.lower() < 0 || (mayBeZero && ever.lower() < 0 && reach(-start.lower(), -down) >= 0);
  const bool slides = maySlide && (holds || seconds > 0);
  cases.between = !mayBeZero ? Interval::empty() : slides ? slid : Interval(-1.0, 1.0);
  cases.isHeldBetween = maySlide && holds;
  return mayBeZero && !slides ? cases : within(cases);
}

SignCases JumpBound::signOver() const {
  if (!isKnown()) return within({});
  SignCases cases;
  cases.above = over.upper() > 0;
  cases.below = over.lower() < 0;
  const bool passes = contains(over, 0.0) && !leaves();
  cases.between = maySlide ? slid : passes ? Interval(-1.0, 1.0) : Interval::empty();
  cases.isHeldBetween = maySlide && holds;
  if (!(passes && !maySlide)) cases = within(cases);
  // None is on a side any longer once all have left it and none comes to it; nor at zero or beyond before one is there.
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (up.upper() < 0) cases.whileAbove = Interval(0.0, std::max(0.0, (Interval(start.upper()) / -up).upper()));
  if (down.lower() > 0) cases.whileBelow = Interval(0.0, std::max(0.0, (Interval(-start.lower()) / down).upper()));
  const auto onlyFrom = [&](double away, const Interval& rate, Interval& beyond) {
    const double first = rate.lower() < 0 ? (Interval(away) / Interval(-rate.lower())).lower() : infinite;
    if (!(away > 0) || !(first < infinite)) return;
    cases.whileBetween = Interval(first, infinite);
    beyond = intersection(beyond, cases.whileBetween);
    if (isEmpty(beyond)) beyond = cases.whileBetween;
  };
  onlyFrom(start.lower(), up, cases.whileBelow);
  onlyFrom(-start.upper(), -down, cases.whileAbove);
  return cases;
}

SignsWithin::SignsWithin(const FlowJumps& jumps)
    : jumps_(jumps), evaluator_(argumentsOfSigns(jumps.f)), arguments_(jumpsOf(jumps.f).size()) {}

void SignsWithin::narrow(const Interval& time, std::span<const Interval> states, std::span<const Interval> parameters,
                         std::vector<SignCases>& signs) {
  std::vector<Interval> all(parameters.begin(), parameters.end());
  for (const SignCases& sign : signs) all.push_back(sign.hull());
  evaluator_.setParameters(all);
  evaluator_(time, states, arguments_);
  for (std::size_t k = 0; k < signs.size(); ++k) {
    SignCases left = signs[k];
    left.above = left.above && arguments_[k].upper() > 0;
    left.below = left.below && arguments_[k].lower() < 0;
    if (!contains(arguments_[k], 0.0)) left.between = Interval::empty();
    if (left.above || left.below || !isEmpty(left.between)) signs[k] = left;
  }
}

namespace {

/// Every state of the form by what the form is; false if there is none.
bool narrowAll(const LinearForm& form, const Interval& argument, const Box& parameters, Box& states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (form.states[i] == 0) continue;
    const Interval others = rangeWithout(i, form, states, parameters);
    states[i] = intersection(states[i], (argument - others) / Interval(form.states[i]));
    if (isEmpty(states[i])) return false;
  }
  return true;
}

}  // namespace

std::vector<SignBox> SignsWithin::boxes(double began, const Interval& time, const Box& states, const Box& parameters,
                                        std::vector<SignCases> signs) {
  constexpr std::size_t most = 9;  // of cases
  for (SignCases& sign : signs) sign = sign.during(time - Interval(began));
  narrow(time, states, parameters, signs);
  std::vector<SignBox> result{{time, states, {}, {}}};
  const auto giveAll = [](const Interval& sign, std::vector<SignBox>& boxes) {
    for (SignBox& box : boxes) {
      box.signs.push_back(sign);
      box.held.push_back(0);
    }
  };
  for (std::size_t k = 0; k < signs.size(); ++k) {
    const std::size_t cases = signs[k].above + signs[k].below + (isEmpty(signs[k].between) ? 0U : 1U);
    if (!signs[k].isOpen() || cases * result.size() > most) {
      giveAll(signs[k].hull(), result);
      continue;
    }
    std::vector<SignBox> next;
    const auto add = [&](const Interval& sign, const Interval& argument, const Interval& when, bool isHeld) {
      for (const SignBox& box : result) {
        SignBox own = box;
        own.signs.push_back(sign);
        own.held.push_back(static_cast<char>(isHeld));
        own.time = intersection(own.time, Interval(began) + when);
        if (isEmpty(own.time)) continue;
        const bool isLinear = k < jumps_.forms.size() && jumps_.forms[k];
        if (!isLinear || narrowAll(*jumps_.forms[k], argument, parameters, own.states)) next.push_back(std::move(own));
      }
    };
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (signs[k].above) add(Interval(1.0), Interval(0.0, infinite), signs[k].whileAbove, false);
    if (signs[k].below) add(Interval(-1.0), Interval(-infinite, 0.0), signs[k].whileBelow, false);
    if (!isEmpty(signs[k].between)) add(signs[k].between, Interval(0.0), signs[k].whileBetween, signs[k].isHeldBetween);
    if (next.empty()) {
      giveAll(signs[k].hull(), result);
      continue;
    }
    result = std::move(next);
  }
  return result;
}

/// While u > 0 it moves by a mean of rates in `up`: it is zero after -u(0)/rate, and goes on where `down` points the
/// same way.
std::optional<JumpBound::Crossing> JumpBound::crossing(bool mayArrive) const {
  const bool arrives = mayArrive && holds && magnitude(start) > 0;
  const bool falls = start.lower() >= 0 && up.upper() < 0 && (down.upper() < 0 || arrives);
  const bool rises = start.upper() <= 0 && down.lower() > 0 && (up.lower() > 0 || arrives);
  if (!isKnown() || !(falls || rises)) return std::nullopt;
  const Interval moment = -start / (falls ? up : down);
  if (!isCommon(moment)) return std::nullopt;
  return Crossing{falls ? 1.0 : -1.0, Interval(std::max(0.0, moment.lower()), moment.upper()), arrives};
}

/// From above u comes down to zero by rates of `up`, and does not leave it any more; from below likewise. What has not
/// been at zero at first is no farther than its own rates take it.
Interval JumpBound::whileArriving(double seconds) const {
  const auto reached = [&](double from, double rate) { return Interval(from) + Interval(seconds) * Interval(rate); };
  const double a = start.lower(), b = start.upper();
  const double most = b < 0 ? reached(b, down.upper()).upper() : std::max(0.0, reached(b, up.upper()).upper());
  const double least = a > 0 ? reached(a, up.lower()).lower() : std::min(0.0, reached(a, down.lower()).lower());
  return least <= most ? Interval(least, most) : Interval::entire();
}

/// Of those that stay at u = 0, by rates there: s = (up + down)/(down - up) rises with both, as long as up ≤ 0 ≤ down.
Interval JumpBounder::slidingSign(std::size_t jump, const Interval& time, const Box& box,
                                  const std::vector<JumpBound>& bounds, double& turned) {
  Box there = box;
  if (jumps_.forms[jump]) narrow(*jumps_.forms[jump], Interval(0.0), there);
  const Interval up = rate(jump, 1.0, time, there, bounds), down = rate(jump, -1.0, time, there, bounds);
  if (!isCommon(up) || !isCommon(down)) return {-1.0, 1.0};
  const double most = down.upper() - up.upper(), least = down.lower() - up.lower();
  turned = most > 0 && least > 0 ? (up.upper() + down.upper()) / most - (up.lower() + down.lower()) / least
                                 : std::numeric_limits<double>::infinity();
  const auto sliding = [](double u, double d) {
    const Interval sum = Interval(u) + Interval(d), difference = Interval(d) - Interval(u);
    return difference.lower() > 0 ? sum / difference : Interval(-1.0, 1.0);
  };
  const bool mayRepel = up.upper() >= 0 && down.lower() <= 0;
  if (mayRepel || up.lower() > 0 || down.upper() < 0) return {-1.0, 1.0};
  return {sliding(up.lower(), std::max(down.lower(), 0.0)).lower(),
          sliding(std::min(up.upper(), 0.0), down.upper()).upper()};
}

void JumpBounder::boundOne(std::size_t jump, const Interval& time, const Box& box, const Interval& start, double h,
                           std::vector<JumpBound>& bounds) {
  JumpBound& bound = bounds[jump];
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto onSide = [&](double sign) {  // its argument is on that side, or zero
    Box there = box;
    const Interval side = sign > 0 ? Interval(0.0, infinite) : Interval(-infinite, 0.0);
    if (jumps_.forms[jump]) narrow(*jumps_.forms[jump], side, there);
    return rate(jump, sign, time, there, bounds);
  };
  const Interval up = onSide(1.0), down = onSide(-1.0);
  if (!isCommon(up) || !isCommon(down)) return;
  bound.start = start;
  bound.up = up;
  bound.down = down;
  bound.over = bound.after(h).ever;
  if (!bound.isKnown()) return;
  const double leastEver = bound.over.lower(), greatestEver = bound.over.upper();
  bound.holds = up.upper() < 0 && down.lower() > 0;
  // Those at zero pass, or leave, where both sides point to the same side. A rate of zero lets them stay on its side.
  const bool passes = (up.lower() > 0 && down.lower() > 0) || (up.upper() < 0 && down.upper() < 0);
  bound.maySlide = leastEver <= 0 && greatestEver >= 0 && !passes;
  bound.turned = 0;
  bound.slid = Interval(-1.0, 1.0);
  Interval sign = Interval::empty();
  if (greatestEver > 0) sign = hull(sign, Interval(1.0));
  if (leastEver < 0) sign = hull(sign, Interval(-1.0));
  if (bound.maySlide) {
    bound.slid = slidingSign(jump, time, box, bounds, bound.turned);
    sign = hull(sign, bound.slid);
  }
  sign = intersection(sign, bound.sign);
  if (!isEmpty(sign)) bound.sign = sign;
}

}  // namespace gamut
