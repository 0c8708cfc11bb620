#include "analyses/flow/step/turn.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "scalars/index.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

namespace {

/// f with the signs that are not held as parameters behind its own, one a sign of f.
Program withOpenSignsGiven(const Program& f, const std::vector<char>& held) {
  const int k = f.parameters(), count = static_cast<int>(held.size());
  Recorder recorder(f.states(), k + count);
  const std::vector<int> jumps = jumpsOf(f);
  std::vector<int> instead(f.nodes().size(), -1), outputs;
  for (int j = 0; j < count; ++j)
    if (held[j] == 0) instead[jumps[j]] = recorder.parameter(k + j);
  const std::vector<int> here = recorder.append(f, {}, instead);
  for (const int output : f.outputNodes()) outputs.push_back(here[output]);
  return recorder.finish(outputs);
}

/// What FlowTurn asks for, of the nodes of f_a, the guard and its rate, and two that have to be above zero.
Program turnOf(Recorder& recorder, const std::vector<int>& after, int guard, int growth, int isAhead, int isAttracted) {
  std::vector<int> outputs{guard, growth, isAhead, isAttracted};
  outputs.insert(outputs.end(), after.begin(), after.end());
  return recorder.finish(outputs);
}

/// The nodes of ẋ = f on these sides.
std::vector<int> ratesOn(Recorder& recorder, const Program& f, const std::vector<Side>& sides) {
  const Program program = onSides(f, sides);
  const std::vector<int> here = recorder.append(program);
  std::vector<int> rates;
  for (int i = 0; i < f.states(); ++i) rates.push_back(here[program.outputNodes()[i]]);
  return rates;
}

/// The guard's rate along ẋ = these.
int growthAlong(Recorder& recorder, int guard, const std::vector<int>& rates) {
  std::vector<std::pair<int, int>> seeds{{recorder.time(), recorder.constant(1.0)}};
  for (std::size_t i = 0; i < rates.size(); ++i) seeds.emplace_back(recorder.state(static_cast<int>(i)), rates[i]);
  return tangents(recorder, {guard}, seeds).front();
}

/// withOpenSignsGiven of jumps of which all but the open ones are left.
Program onlyHeld(const FlowJumps& jumps, const std::vector<char>& held) {
  Program f = withOpenSignsGiven(jumps.f, held);
  if (jumpsOf(f).size() != held.size() - static_cast<std::size_t>(std::ranges::count(held, 0)))
    throw std::logic_error("signs become one or zero where others are given");
  return f;
}

/// Outputs of jumps.given, where this sign is one or the other.
std::vector<int> outputsOn(Recorder& recorder, const FlowJumps& jumps, std::size_t jump, double sign) {
  const Program& given = jumps.given;
  std::vector<int> values, outputs;
  for (int i = 0; i < given.parameters(); ++i) values.push_back(recorder.parameter(i));
  values[at(given.parameters()) - jumps.count() + jump] = recorder.constant(sign);
  const std::vector<int> here = recorder.append(given, values);
  for (const int output : given.outputNodes()) outputs.push_back(here[output]);
  return outputs;
}

/// Its last outputs, as many as states.
Program followingOf(const Program& along) {
  const std::vector<int>& outputs = along.outputNodes();
  return Recorder(along).finish({outputs.end() - along.states(), outputs.end()});
}

}  // namespace

Program releaseOf(const FlowJumps& jumps, const std::vector<char>& held, std::size_t jump, double side) {
  const Program f = onlyHeld(jumps, held);
  Recorder recorder(f.states(), f.parameters());
  std::vector<Side> sides;
  std::size_t which = 0;
  for (std::size_t j = 0; j < held.size(); ++j) {
    if (j == jump) which = sides.size();
    if (held[j] != 0) sides.push_back(Side::held);
  }
  const auto ratesWith = [&](Side of) {
    sides[which] = of;
    return ratesOn(recorder, f, sides);
  };
  const std::vector<int> whileHeld = ratesWith(Side::held), free = ratesWith(side > 0 ? Side::above : Side::below),
                         other = ratesWith(side > 0 ? Side::below : Side::above);
  const auto towardsSide = [&](const std::vector<int>& rates) {
    const LinearForm& form = *jumps.forms[jump];
    int sum = recorder.constant(0.0);
    for (std::size_t i = 0; i < rates.size(); ++i)
      if (form.states[i] != 0)
        sum = recorder.add(sum, recorder.mul(recorder.constant(side * form.states[i]), rates[i]));
    return sum;
  };
  const int guard = towardsSide(free), attracted = towardsSide(other);
  const int ahead = growthAlong(recorder, guard, free), growth = growthAlong(recorder, guard, whileHeld);
  return turnOf(recorder, free, guard, growth, ahead, attracted);
}

Program liftOf(const FlowJumps& jumps, const std::vector<char>& held, std::size_t speed) {
  const auto isOf = [&](const RestingJumps& rest) { return rest.speed == speed; };
  const RestingJumps& rest = *std::ranges::find_if(jumps.rests, isOf);
  std::vector<char> open = FlowJumps::bySigns(held);
  open[rest.position] = open[rest.speed] = atRest;
  const Program f = onlyHeld(jumps, open);
  Recorder recorder(f.states(), f.parameters());
  const auto ratesIf = [&](bool isLifted) {
    const auto leaving = [](bool rises) { return rises ? Side::above : Side::below; };
    std::vector<Side> sides;
    for (std::size_t j = 0; j < open.size(); ++j) {
      if (open[j] == byItsSign) sides.push_back(Side::held);
      if (open[j] != atRest) continue;
      sides.push_back(!isLifted ? Side::between : leaving(j == rest.position ? rest.positionRises : rest.speedRises));
    }
    return ratesOn(recorder, f, sides);
  };
  std::vector<int> atPlace = ratesIf(false);
  atPlace[rest.states.position] = atPlace[rest.states.speed] = recorder.constant(0.0);
  const std::vector<int> lifted = ratesIf(true);
  const double scale = std::fabs(jumps.forms[speed]->states[rest.states.speed]);
  const int guard = recorder.mul(recorder.constant(scale), lifted[rest.states.speed]);
  const int always = recorder.constant(1.0);
  const int ahead = growthAlong(recorder, guard, lifted), growth = growthAlong(recorder, guard, atPlace);
  return turnOf(recorder, lifted, guard, growth, ahead, always);
}

/// u̇ is affine in the sign: from u̇_b to u̇_-b, f as well, so that it is zero at f_b + u̇_b/(u̇_b - u̇_-b) (f_-b - f_b).
Program arrivalOf(const FlowJumps& jumps, std::size_t jump, double side) {
  const Program& given = jumps.given;
  const std::size_t n = at(given.states()), count = jumps.count();
  Recorder recorder(given.states(), given.parameters());
  const std::vector<int> own = outputsOn(recorder, jumps, jump, side), other = outputsOn(recorder, jumps, jump, -side);
  const std::size_t rate = n + count + jump;
  const int share = recorder.mul(own[rate], recorder.recip(recorder.sub(own[rate], other[rate])));
  std::vector<int> after;
  for (std::size_t i = 0; i < n; ++i)
    after.push_back(recorder.add(own[i], recorder.mul(share, recorder.sub(other[i], own[i]))));
  const auto towardsOther = [&](int node) { return side > 0 ? recorder.neg(node) : node; };
  const auto towardsSide = [&](int node) { return side > 0 ? node : recorder.neg(node); };
  const int growth = towardsOther(own[rate]);
  return turnOf(recorder, after, towardsOther(own[n + jump]), growth, growth, towardsSide(other[rate]));
}

Program passageOf(const FlowJumps& jumps, std::size_t jump, double side) {
  const std::size_t n = at(jumps.given.states()), rate = n + jumps.count() + jump;
  Recorder recorder(jumps.given.states(), jumps.given.parameters());
  const std::vector<int> before = outputsOn(recorder, jumps, jump, side),
                         after = outputsOn(recorder, jumps, jump, -side);
  const auto ahead = [&](int node) { return side > 0 ? recorder.neg(node) : node; };
  const std::vector<int> rates(after.begin(), after.begin() + static_cast<std::ptrdiff_t>(n));
  return turnOf(recorder, rates, ahead(before[n + jump]), ahead(before[rate]), ahead(after[rate]),
                recorder.constant(1.0));
}

Program passageOf(const Program& f, const KinkArgument& u, double side) {
  Recorder recorder(f.states(), f.parameters());
  const std::vector<int> itself = recorder.append(f);
  std::vector<int> kinks;  // the nodes |u|
  for (std::size_t i = 0; i < f.nodes().size(); ++i)
    if (f.nodes()[i].op == Op::abs && isArgument(u, f, f.nodes()[i].a)) kinks.push_back(static_cast<int>(i));
  if (kinks.empty()) throw std::logic_error("a kink is passed that there is not");
  const auto ratesWith = [&](double sign) {  // sign u in place of |u|
    std::vector<int> instead(f.nodes().size(), -1), rates;
    for (const int kink : kinks) {
      const int argument = itself[f.nodes()[kink].a];
      instead[kink] = sign > 0 ? argument : recorder.neg(argument);
    }
    const std::vector<int> here = recorder.append(f, {}, instead);
    for (int i = 0; i < f.states(); ++i) rates.push_back(here[f.outputNodes()[i]]);
    return rates;
  };
  const std::vector<int> before = ratesWith(side), after = ratesWith(-side);
  const int argument = itself[f.nodes()[kinks.front()].a], guard = side > 0 ? recorder.neg(argument) : argument;
  return turnOf(recorder, after, guard, growthAlong(recorder, guard, before), growthAlong(recorder, guard, after),
                recorder.constant(1.0));
}

FlowTurn::FlowTurn(const Program& along, std::shared_ptr<const Monomials> monomials, int order, double length,
                   double resolution, const std::atomic<bool>* cancelled)
    : AlongStep(along, monomials, order, length, resolution, cancelled),
      states_(along.states()),
      following_(followingOf(along), monomials, order, length, resolution, cancelled),
      slopes_(forwardDifferentiated(followingOf(along))),
      derivatives_(slopes_),
      makeAlong_([=, this] {
        return std::make_unique<AlongStep>(slopes_, monomials, order, length, resolution, cancelled);
      }) {}

AlongStep& FlowTurn::alongDerivatives() {
  if (!alongDerivatives_) alongDerivatives_ = makeAlong_();
  return *alongDerivatives_;
}

std::vector<Interval> FlowTurn::derivatives(const Interval& time, const Box& states, const Box& parameters) {
  const std::size_t n = detail::at(states_);
  std::vector<Interval> all(n + n * n);
  derivatives_.setParameters(parameters);
  derivatives_(time, states, all);
  return {all.begin() + static_cast<std::ptrdiff_t>(n), all.end()};
}

}  // namespace gamut
