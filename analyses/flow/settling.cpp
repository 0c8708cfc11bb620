#include "analyses/flow/settling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analyses/flow/embedding.hpp"
#include "analyses/flow/error_bounds.hpp"
#include "analyses/flow/step.hpp"
#include "scalars/index.hpp"

namespace gamut {

namespace {

/// How fast the position moves by its speed, P, and the speed, Q, on one side of the place: from it until the speed is
/// zero, and back to it.
struct Sides {
  Interval away, back;
};

/// Of the turn on one side of the place: what is left of a speed behind it, at most; seconds for each of its speed.
struct Turn {
  double share, duration;
};

/// From s = a with speed w: s rises until v = 0, to P w²/2Q at most, and falls to where |v|² = 2 (Q/P) (s - a).
Turn turnOf(const Sides& P, const Sides& Q) {
  const Interval share =
      sqrt(Interval(Q.back.upper()) * Interval(P.away.upper()) / (Interval(Q.away.lower()) * Interval(P.back.lower())));
  const Interval duration = Interval(1.0) / Interval(Q.away.lower()) + share / Interval(Q.back.lower());
  return {share.upper(), duration.upper()};
}

Box boxOf(const FlowSet& set, const std::vector<double>& total, const Monomials& monomials) {
  Box box;
  for (std::size_t i = 0; i < set.R.size(); ++i) {
    LinearForm own;
    own.states.assign(set.R.size(), 0.0);
    own.states[i] = 1;
    box.push_back(argumentOf(set, own, total, &monomials));
  }
  return box;
}

}  // namespace

const std::vector<Interval>& Settling::rates(const Interval& time, const Box& box, const std::vector<Interval>& signs) {
  Box all = parameters_;
  all.insert(all.end(), signs.begin(), signs.end());
  given_.setParameters(all);
  given_(time, box, results_);
  return results_;
}

std::optional<Settling::Found> Settling::find(const FlowSet& set, const Monomials& monomials,
                                              const std::vector<char>& held, double longest) {
  std::optional<Found> first;
  if (set.unsettledUntil > set.t) return first;  // one after the other
  for (std::size_t pair = 0; pair < jumps_.rests.size(); ++pair) {
    if (!held.empty() && held[jumps_.rests[pair].speed] == atRest) continue;
    const auto found = find(pair, set, monomials, held, longest);
    if (found && (!first || found->seconds < first->seconds)) first = found;
  }
  return first;
}

/// With |s - a| ≤ S, |v - b| ≤ V at first, and P, Q in intervals: the first time that s = a, |v - b| is
/// V₁ = √(V² + 2 (Q/P) S) at most, after V/Q + V₁/Q seconds; then each turn leaves a share < 1 of it.
std::optional<Settling::Found> Settling::find(std::size_t pair, const FlowSet& set, const Monomials& monomials,
                                              const std::vector<char>& held, double longest) {
  const RestingJumps& rest = jumps_.rests[pair];
  const std::size_t n = set.R.size(), count = jumps_.count(), s = at(rest.states.position), v = at(rest.states.speed);
  parameters_.clear();
  for (const Embedded& parameter : set.parameters) parameters_.push_back(rangeOf(parameter));
  std::vector<double> total;
  totalRadius(set, total);
  const Box start = boxOf(set, total, monomials);
  const LinearForm &position = *jumps_.forms[rest.position], &speed = *jumps_.forms[rest.speed];
  const Interval fromPlace = argumentOf(set, position, total, &monomials) / Interval(position.states[s]),
                 beforeStill = argumentOf(set, speed, total, &monomials) / Interval(speed.states[v]);
  const double S = magnitude(fromPlace), V = magnitude(beforeStill);
  const auto zeroOf = [&](const LinearForm& form, std::size_t state) {
    Interval sum = form.constant;
    for (std::size_t k = 0; k < parameters_.size(); ++k)
      if (form.parameters[k] != 0) sum += Interval(form.parameters[k]) * parameters_[k];
    return -sum / Interval(form.states[state]);
  };
  const Interval place = zeroOf(position, s), still = zeroOf(speed, v);
  const Interval far = Interval(0x1p20 * (1 + magnitude(still)));  // of which `still` is little
  if (!isBounded(fromPlace) || !isBounded(beforeStill) || !isBounded(place) || !isBounded(far)) return std::nullopt;

  double seconds = 0, farthest = S, fastest = V;  // so far; grown until they prove themselves
  std::vector<double> share(n, 0.0), besides(n, 0.0), apart(n, 0.0);
  Box box = start;
  constexpr int attempts = 12;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const Interval time = Interval(set.t) + Interval(0.0, seconds);
    box[s] = inflated(place, farthest);
    box[v] = inflated(still, fastest);
    std::vector<Interval> signs(count, Interval(-1.0, 1.0));
    {
      const std::vector<Interval>& arguments = rates(time, box, signs);
      for (std::size_t k = 0; k < count; ++k) {
        const Interval& argument = arguments[n + k];
        if (!held.empty() && held[k] == atRest)
          signs[k] = Interval(0.0);
        else if (argument.lower() > 0 || argument.upper() < 0)
          signs[k] = Interval(argument.lower() > 0 ? 1.0 : -1.0);
      }
    }
    for (const RestingJumps& other : jumps_.rests) {  // those that rest go on resting
      if (held.empty() || held[other.speed] != atRest) continue;
      std::vector<Interval> pressing = signs;
      pressing[other.position] = Interval(other.ofPosition(1));
      pressing[other.speed] = Interval(other.ofSpeed(-1));
      pressing[rest.position] = pressing[rest.speed] = Interval(-1.0, 1.0);
      if (!(rates(time, box, pressing)[at(other.states.speed)].upper() < 0)) return std::nullopt;
    }
    Sides P[2], Q[2];
    std::vector<Interval> moves(n, Interval::empty());
    std::vector<std::vector<Interval>> onSides;
    for (const double side : {1.0, -1.0})
      for (const double way : {1.0, -1.0}) {
        signs[rest.position] = Interval(rest.ofPosition(side));
        signs[rest.speed] = Interval(rest.ofSpeed(way));
        const std::vector<Interval>& here = rates(time, box, signs);
        for (std::size_t i = 0; i < n; ++i) moves[i] = hull(moves[i], here[i]);
        onSides.emplace_back(here.begin(), here.begin() + static_cast<std::ptrdiff_t>(n));
        const Interval q = Interval(-side) * here[v];
        Box once = box;
        once[v] = still + far;
        const Interval p = rates(time, once, signs)[s] / far;
        if (!(q.lower() > 0) || !(p.lower() > 0) || !isBounded(q) || !isBounded(p)) return std::nullopt;
        const std::size_t which = side > 0 ? 0 : 1;
        (side == way ? Q[which].away : Q[which].back) = q;
        (side == way ? P[which].away : P[which].back) = p;
      }
    const Turn turns[2] = {turnOf(P[0], Q[0]), turnOf(P[1], Q[1])};
    const double ofSpeed = std::max(turns[0].share, turns[1].share);
    if (!(ofSpeed < 1)) return std::nullopt;
    const auto most = [&](auto of) { return std::max(of(0), of(1)); };
    const double slowest = std::min({Q[0].away.lower(), Q[0].back.lower(), Q[1].away.lower(), Q[1].back.lower()});
    const double steepest =
        most([&](int k) { return (Interval(Q[k].back.upper()) / Interval(P[k].back.lower())).upper(); });
    const double rise =
        most([&](int k) { return (Interval(P[k].away.upper()) / Interval(Q[k].away.lower())).upper(); });
    const Interval first = sqrt(sqr(Interval(V)) + Interval(2.0) * Interval(steepest) * Interval(S));
    const Interval left =
        first * Interval(std::max(turns[0].duration, turns[1].duration)) / (Interval(1.0) - Interval(ofSpeed));
    const double all = ((Interval(V) + first) / Interval(slowest) + left).upper();
    const double high = (Interval(S) + Interval(0.5) * Interval(rise) * sqr(first)).upper();
    if (!(all <= longest)) return std::nullopt;
    // With both signs zero, at the place.
    signs[rest.position] = signs[rest.speed] = Interval(0.0);
    Box there = box;
    there[s] = place;
    there[v] = still;
    const std::vector<Interval>& resting = rates(time, there, signs);
    bool isProved = all <= seconds && high <= farthest && first.upper() <= fastest;
    constexpr double longer = 1.125, more = 1.25;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == s || i == v) continue;
      if (!isBounded(moves[i]) || !isBounded(resting[i])) return std::nullopt;
      // z = x - share (v - b) moves as at rest, but for f - share v̇ - f_rest.
      const double about =
          (midpoint(onSides[0][i]) - midpoint(onSides[3][i])) / (midpoint(onSides[0][v]) - midpoint(onSides[3][v]));
      share[i] = std::isfinite(about) ? about : 0;
      double leftOver = 0;
      for (const std::vector<Interval>& here : onSides)
        leftOver = std::max(leftOver, magnitude(here[i] - Interval(share[i]) * here[v] - resting[i]));
      besides[i] = (Interval(seconds) * Interval(leftOver)).upper();
      const double off = (besides[i] + std::fabs(share[i]) * fastest) * bounds::up;
      const Interval reach = start[i] + Interval(0.0, seconds) * hull(moves[i], resting[i]) + Interval(-off, off);
      isProved = isProved && isSubset(reach, box[i]);
      apart[i] = off + bounds::tiny;
      const Interval wider = start[i] + Interval(more) * (reach - start[i]);
      if (!isProved) box[i] = hull(box[i], wider);
    }
    if (isProved) {
      apart[s] = farthest;
      apart[v] = fastest;
      return Found{pair, contains(fromPlace, 0.0) && contains(beforeStill, 0.0), seconds, share, besides, apart};
    }
    seconds = std::max(seconds, longer * all);
    farthest = std::max(farthest, longer * high);
    fastest = std::max(fastest, longer * first.upper());
  }
  return std::nullopt;
}

void Settling::rest(FlowSet& set, const Monomials& monomials, const std::vector<char>& held, const Found& found,
                    double quantum) const {
  const RestingJumps& rest = jumps_.rests[found.pair];
  const std::size_t n = set.R.size(), N = at(monomials.count()), s = at(rest.states.position),
                    v = at(rest.states.speed);
  // Columns in the axes of the states: C becomes the identity, n roundings an entry.
  std::vector<double> total, sizes(n, 0.0);
  totalRadius(set, total);
  for (std::size_t i = 0; i < n; ++i) {
    double size = 0;
    for (std::size_t j = 0; j < n; ++j) size += std::fabs(set.C[i * n + j]) * total[j];
    sizes[i] = size;
    set.W[i] = (set.W[i] + static_cast<double>(n + 2) * bounds::unit * size) * bounds::up + bounds::tiny;
  }
  const auto turned = [&](const std::vector<double>& columns) {
    std::vector<double> result(columns.size(), 0.0);
    for (std::size_t c = 0; c < columns.size(); c += n) {
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) result[c + i] += set.C[i * n + j] * columns[c + j];
      for (std::size_t i = 0; i < n; ++i) result[c + i] -= found.share[i] * result[c + v];
      result[c + s] = result[c + v] = 0;
    }
    return result;
  };
  set.generators = turned(set.generators);
  set.inputs = turned(set.inputs);
  for (std::vector<double>& columns : set.inputsOfXi) columns = turned(columns);
  std::vector<double> R(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) R[i] += std::fabs(set.C[i * n + j]) * set.R[j] * bounds::up;
  for (std::size_t i = 0; i < n; ++i) R[i] = (R[i] + std::fabs(found.share[i]) * R[v]) * bounds::up;
  R[s] = R[v] = 0;
  set.R = R;
  set.C.assign(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) set.C[i * n + i] = 1;
  // z in place of x (find): a sum of three products in each coefficient, and of two in each generator.
  const LinearForm& speed = *jumps_.forms[rest.speed];
  const double perSpeed = speed.states[v];
  std::vector<double> still(N, 0.0);
  still[0] = -midpoint(speed.constant) / perSpeed;
  double looseOfStill = radius(speed.constant / Interval(perSpeed));
  for (std::size_t k = 0; k < speed.parameters.size(); ++k) {
    const Embedded& e = set.parameters[k];
    const double part = -speed.parameters[k] / perSpeed;
    if (part == 0) continue;
    still[0] += part * e.centre;
    if (e.symbol >= 0) still[at(monomials.linear(e.symbol))] += part * e.half;
    looseOfStill += std::fabs(part) * e.coarseRadius();
    sizes[v] += 4 * std::fabs(part) * (std::fabs(e.centre) + e.half);
  }
  for (std::size_t g = 0; g < N; ++g) sizes[v] += std::fabs(set.p[v * N + g]) + 4 * std::fabs(still[g]);
  for (std::size_t i = 0; i < n; ++i) {
    if (i == s || i == v) continue;
    const double by = std::fabs(found.share[i]);
    double size = sizes[i] + by * sizes[v];
    for (std::size_t g = 0; g < N; ++g) {
      size += std::fabs(set.p[i * N + g]);
      set.p[i * N + g] -= found.share[i] * (set.p[v * N + g] - still[g]);
    }
    const double roundings = 8 + 2 * static_cast<double>(speed.parameters.size());
    set.W[i] =
        (set.W[i] + by * (set.W[v] + looseOfStill) + roundings * bounds::unit * size + found.beside[i]) * bounds::up +
        bounds::tiny;
  }
  // x = -(Σ d_k p_k + constant)/c of both.
  for (const auto& [jump, state] : {std::pair(rest.position, s), std::pair(rest.speed, v)}) {
    const LinearForm& form = *jumps_.forms[jump];
    const double by = form.states[state];
    double* const p = &set.p[state * N];
    std::fill_n(p, N, 0.0);
    const Interval constant = -form.constant / Interval(by);
    p[0] = midpoint(constant);
    double loose = radius(constant), size = std::fabs(p[0]), terms = 2;
    for (std::size_t k = 0; k < form.parameters.size(); ++k) {
      const double part = -form.parameters[k] / by;
      const Embedded& e = set.parameters[k];
      if (part == 0) continue;
      p[0] += part * e.centre;
      if (e.symbol >= 0) p[at(monomials.linear(e.symbol))] += part * e.half;
      loose += std::fabs(part) * e.coarseRadius();
      size += std::fabs(part) * (std::fabs(e.centre) + e.half);
      terms += 2;
    }
    const bool isExact = terms == 2 && loose == 0;  // a number
    set.W[state] = isExact ? 0.0 : (loose + terms * bounds::unit * size) * bounds::up + bounds::tiny;
  }

  std::vector<Interval> known(jumps_.count(), Interval::entire());
  set.unsettled = found.apart;
  for (std::size_t pair = 0; pair < jumps_.rests.size(); ++pair) {
    const RestingJumps& of = jumps_.rests[pair];
    const bool isFound = pair == found.pair, rests = !held.empty() && held[of.speed] == atRest;
    if (isFound || rests) known[of.position] = known[of.speed] = Interval(0.0);
  }
  set.arguments = known;
  set.unsettledUntil = std::ceil((set.t + found.seconds) / quantum + 1) * quantum;
  set.hasSlid = true;
  set.nextStep = set.freeStep = set.slideStep = 0;
  set.caution = 1;
}

}  // namespace gamut
