#include "analyses/flow/step/settling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "analyses/flow/series/embedded.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/step/step.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

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

/// Until they rest: seconds at most, |s - a| at most, |v - b| the first time that s = a.
struct Fall {
  double seconds, high, speed;
};

/// From |s - a| ≤ S and |v - b| ≤ V; nothing where turns might leave as much as there was.
std::optional<Fall> fallOf(const std::array<Sides, 2>& P, const std::array<Sides, 2>& Q, double S, double V) {
  const Turn turns[2] = {turnOf(P[0], Q[0]), turnOf(P[1], Q[1])};
  const double ofSpeed = std::max(turns[0].share, turns[1].share);
  if (!(ofSpeed < 1)) return std::nullopt;
  const auto most = [&](auto of) { return std::max(of(0), of(1)); };
  const double slowest = std::min({Q[0].away.lower(), Q[0].back.lower(), Q[1].away.lower(), Q[1].back.lower()});
  const double steepest =
      most([&](std::size_t k) { return (Interval(Q[k].back.upper()) / Interval(P[k].back.lower())).upper(); });
  const double rise =
      most([&](std::size_t k) { return (Interval(P[k].away.upper()) / Interval(Q[k].away.lower())).upper(); });
  const Interval first = sqrt(sqr(Interval(V)) + Interval(2.0) * Interval(steepest) * Interval(S));
  const Interval left =
      first * Interval(std::max(turns[0].duration, turns[1].duration)) / (Interval(1.0) - Interval(ofSpeed));
  return Fall{((Interval(V) + first) / Interval(slowest) + left).upper(),
              (Interval(S) + Interval(0.5) * Interval(rise) * sqr(first)).upper(), first.upper()};
}

/// Columns in the axes of the states, and of z in place of x (Settling::Search): C becomes the identity, n roundings an
/// entry. The size of each state's columns before.
std::vector<double> turnToAxes(FlowSet& set, const std::vector<double>& share, std::size_t s, std::size_t v) {
  const std::size_t n = set.R.size();
  std::vector<double> total, sizes(n, 0.0);
  totalRadius(set, total);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) sizes[i] += std::fabs(set.C[i * n + j]) * total[j];
    set.W[i] = (set.W[i] + static_cast<double>(n + 2) * bounds::unit * sizes[i]) * bounds::up + bounds::tiny;
  }
  const auto turned = [&](const std::vector<double>& columns) {
    std::vector<double> result(columns.size(), 0.0);
    for (std::size_t c = 0; c < columns.size(); c += n) {
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) result[c + i] += set.C[i * n + j] * columns[c + j];
      for (std::size_t i = 0; i < n; ++i) result[c + i] -= share[i] * result[c + v];
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
  for (std::size_t i = 0; i < n; ++i) R[i] = (R[i] + std::fabs(share[i]) * R[v]) * bounds::up;
  R[s] = R[v] = 0;
  set.R = R;
  set.C.assign(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) set.C[i * n + i] = 1;
  return sizes;
}

/// z in place of x (Settling::Search) of all states but these two: a sum of three products in each coefficient, and of
/// two in each generator.
void restOthers(FlowSet& set, const Monomials& monomials, const LinearForm& speed, const Settling::Found& found,
                const std::vector<double>& sizes, std::size_t s, std::size_t v) {
  const std::size_t n = set.R.size(), N = at(monomials.count());
  const double perSpeed = speed.states[v];
  LooseSum still{std::vector<double>(N, 0.0)};
  still.p[0] = -midpoint(speed.constant) / perSpeed;
  still.loose = radius(speed.constant / Interval(perSpeed));
  still.size = 0.25 * sizes[v];  // the others count four times
  still.addParameters(speed, -perSpeed, set.parameters, monomials);
  double ofSpeed = 4 * still.size;
  for (std::size_t g = 0; g < N; ++g) ofSpeed += std::fabs(set.p[v * N + g]) + 4 * std::fabs(still.p[g]);
  for (std::size_t i = 0; i < n; ++i) {
    if (i == s || i == v) continue;
    const double by = std::fabs(found.share[i]);
    double size = sizes[i] + by * ofSpeed;
    for (std::size_t g = 0; g < N; ++g) {
      size += std::fabs(set.p[i * N + g]);
      set.p[i * N + g] -= found.share[i] * (set.p[v * N + g] - still.p[g]);
    }
    const double roundings = 8 + 2 * static_cast<double>(speed.parameters.size());
    set.W[i] =
        (set.W[i] + by * (set.W[v] + still.loose) + roundings * bounds::unit * size + found.beside[i]) * bounds::up +
        bounds::tiny;
  }
}

/// The state that makes the form zero: -(Σ d_k p_k + constant)/c.
void makeZero(FlowSet& set, const Monomials& monomials, const LinearForm& form, std::size_t state) {
  const double by = form.states[state];
  const Interval constant = -form.constant / Interval(by);
  LooseSum sum{std::vector<double>(monomials.count(), 0.0), radius(constant), std::fabs(midpoint(constant))};
  sum.p[0] = midpoint(constant);
  const int terms = 2 + 2 * sum.addParameters(form, -by, set.parameters, monomials);
  const bool isExact = terms == 2 && sum.loose == 0;  // a number
  std::ranges::copy(sum.p, set.p.begin() + static_cast<std::ptrdiff_t>(state * sum.p.size()));
  set.W[state] = isExact ? 0.0 : (sum.loose + terms * bounds::unit * sum.size) * bounds::up + bounds::tiny;
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

/// What is known of solutions on their way to rest at a pair, grown until it proves itself. With |s - a| ≤ S, |v - b| ≤
/// V at first, and P, Q in intervals: the first time that s = a, |v - b| is V₁ = √(V² + 2 (Q/P) S) at most, after V/Q +
/// V₁/Q seconds; then each turn leaves a share < 1 of it.
class Settling::Search {
 public:
  Search(Settling& settling, std::size_t pair, const FlowSet& set, const Monomials& monomials,
         const std::vector<char>& held)
      : settling_(settling),
        rest_(settling.jumps_.rests[pair]),
        pair_(pair),
        s_(at(rest_.states.position)),
        v_(at(rest_.states.speed)),
        began_(set.t),
        held_(held),
        share_(set.R.size(), 0.0),
        besides_(share_),
        apart_(share_) {
    settling_.parameters_ = rangesOf(set.parameters);
    std::vector<double> total;
    totalRadius(set, total);
    box_ = start_ = boxOf(set, total, monomials);
    const LinearForm& position = *settling.jumps_.forms[rest_.position];
    const LinearForm& speed = *settling.jumps_.forms[rest_.speed];
    fromPlace_ = argumentOf(set, position, total, &monomials) / Interval(position.states[s_]);
    beforeStill_ = argumentOf(set, speed, total, &monomials) / Interval(speed.states[v_]);
    place_ = -rangeOf(position, {}, settling_.parameters_) / Interval(position.states[s_]);
    still_ = -rangeOf(speed, {}, settling_.parameters_) / Interval(speed.states[v_]);
    far_ = Interval(0x1p20 * (1 + magnitude(still_)));
  }

  std::optional<Found> find(double longest) {
    if (!isBounded(fromPlace_) || !isBounded(beforeStill_) || !isBounded(place_) || !isBounded(far_))
      return std::nullopt;
    const double S = farthest_ = magnitude(fromPlace_), V = fastest_ = magnitude(beforeStill_);
    constexpr int attempts = 12;
    constexpr double longer = 1.125;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      time_ = Interval(began_) + Interval(0.0, seconds_);
      box_[s_] = inflated(place_, farthest_);
      box_[v_] = inflated(still_, fastest_);
      findSigns();
      if (!doOthersRest() || !lookAround()) return std::nullopt;
      const std::optional<Fall> fall = fallOf(P_, Q_, S, V);
      if (!fall || !(fall->seconds <= longest)) return std::nullopt;
      bool isProved = fall->seconds <= seconds_ && fall->high <= farthest_ && fall->speed <= fastest_;
      if (!followOthers(isProved)) return std::nullopt;
      if (isProved) {
        apart_[s_] = farthest_;
        apart_[v_] = fastest_;
        return Found{pair_, contains(fromPlace_, 0.0) && contains(beforeStill_, 0.0), seconds_, share_, besides_,
                     apart_};
      }
      seconds_ = std::max(seconds_, longer * fall->seconds);
      farthest_ = std::max(farthest_, longer * fall->high);
      fastest_ = std::max(fastest_, longer * fall->speed);
    }
    return std::nullopt;
  }

 private:
  const std::vector<Interval>& rates(const Box& box) { return settling_.rates(time_, box, signs_); }
  bool isAtRest(std::size_t jump) const { return !held_.empty() && held_[jump] == atRest; }

  /// Of the others what they are in the box; of the pair any.
  void findSigns() {
    signs_.assign(settling_.jumps_.count(), Interval(-1.0, 1.0));
    const std::vector<Interval>& arguments = rates(box_);
    for (std::size_t k = 0; k < signs_.size(); ++k) {
      const Interval& argument = arguments[share_.size() + k];
      if (isAtRest(k))
        signs_[k] = Interval(0.0);
      else if (argument.lower() > 0 || argument.upper() < 0)
        signs_[k] = Interval(argument.lower() > 0 ? 1.0 : -1.0);
    }
  }

  /// Whether those that rest go on resting.
  bool doOthersRest() {
    return std::ranges::all_of(settling_.jumps_.rests, [&](const RestingJumps& other) {
      if (!isAtRest(other.speed)) return true;
      std::vector<Interval> pressing = signs_;
      pressing[other.position] = Interval(other.ofPosition(1));
      pressing[other.speed] = Interval(other.ofSpeed(-1));
      pressing[rest_.position] = pressing[rest_.speed] = Interval(-1.0, 1.0);
      return settling_.rates(time_, box_, pressing)[other.states.speed].upper() < 0;
    });
  }

  /// Rates on both sides of the place, on the way to either; false unless P and Q are above zero.
  bool lookAround() {
    const std::size_t n = share_.size();
    moves_.assign(n, Interval::empty());
    onSides_.clear();
    for (const double side : {1.0, -1.0})
      for (const double way : {1.0, -1.0}) {
        signs_[rest_.position] = Interval(rest_.ofPosition(side));
        signs_[rest_.speed] = Interval(rest_.ofSpeed(way));
        const std::vector<Interval>& here = rates(box_);
        for (std::size_t i = 0; i < n; ++i) moves_[i] = hull(moves_[i], here[i]);
        onSides_.emplace_back(here.begin(), here.begin() + static_cast<std::ptrdiff_t>(n));
        const Interval q = Interval(-side) * here[v_];
        Box once = box_;
        once[v_] = still_ + far_;
        const Interval p = rates(once)[s_] / far_;
        if (!(q.lower() > 0) || !(p.lower() > 0) || !isBounded(q) || !isBounded(p)) return false;
        const std::size_t which = side > 0 ? 0 : 1;
        (side == way ? Q_[which].away : Q_[which].back) = q;
        (side == way ? P_[which].away : P_[which].back) = p;
      }
    return true;
  }

  /// What becomes of the other states: z = x - share (v - b) moves as at rest, but for f - share v̇ - f_rest. Where
  /// they leave the box it grows, and nothing is proved. False if one is not bounded.
  bool followOthers(bool& isProved) {
    signs_[rest_.position] = signs_[rest_.speed] = Interval(0.0);  // at the place
    Box there = box_;
    there[s_] = place_;
    there[v_] = still_;
    const std::vector<Interval>& resting = rates(there);
    constexpr double more = 1.25;
    for (std::size_t i = 0; i < share_.size(); ++i) {
      if (i == s_ || i == v_) continue;
      if (!isBounded(moves_[i]) || !isBounded(resting[i])) return false;
      const double about = (midpoint(onSides_[0][i]) - midpoint(onSides_[3][i])) /
                           (midpoint(onSides_[0][v_]) - midpoint(onSides_[3][v_]));
      share_[i] = std::isfinite(about) ? about : 0;
      double leftOver = 0;
      for (const std::vector<Interval>& here : onSides_)
        leftOver = std::max(leftOver, magnitude(here[i] - Interval(share_[i]) * here[v_] - resting[i]));
      besides_[i] = (Interval(seconds_) * Interval(leftOver)).upper();
      const double off = (besides_[i] + std::fabs(share_[i]) * fastest_) * bounds::up;
      const Interval reach = start_[i] + Interval(0.0, seconds_) * hull(moves_[i], resting[i]) + Interval(-off, off);
      isProved = isProved && isSubset(reach, box_[i]);
      apart_[i] = off + bounds::tiny;
      if (!isProved) box_[i] = hull(box_[i], start_[i] + Interval(more) * (reach - start_[i]));
    }
    return true;
  }

  Settling& settling_;
  const RestingJumps& rest_;
  std::size_t pair_, s_, v_;  // states: position, speed
  double began_;
  const std::vector<char>& held_;
  Box start_, box_;
  Interval fromPlace_, beforeStill_;  // s - a, v - b at first
  Interval place_, still_;            // a, b
  Interval far_;                      // of which `still` is little
  double seconds_ = 0, farthest_ = 0, fastest_ = 0;
  Interval time_;
  std::vector<Interval> signs_, moves_;          // moves: on any side
  std::vector<std::vector<Interval>> onSides_;   // above and away, above and back, below and back, below and away
  std::array<Sides, 2> P_, Q_;                   // above, below
  std::vector<double> share_, besides_, apart_;  // Found
};

std::optional<Settling::Found> Settling::find(const FlowSet& set, const Monomials& monomials,
                                              const std::vector<char>& held, double longest) {
  std::optional<Found> first;
  if (set.unsettledUntil > set.t) return first;  // one after the other
  for (std::size_t pair = 0; pair < jumps_.rests.size(); ++pair) {
    if (!held.empty() && held[jumps_.rests[pair].speed] == atRest) continue;
    const auto found = Search(*this, pair, set, monomials, held).find(longest);
    if (found && (!first || found->seconds < first->seconds)) first = found;
  }
  return first;
}

void Settling::rest(FlowSet& set, const Monomials& monomials, const std::vector<char>& held, const Found& found,
                    double quantum) const {
  const RestingJumps& rest = jumps_.rests[found.pair];
  const std::size_t s = at(rest.states.position), v = at(rest.states.speed);
  const LinearForm &position = *jumps_.forms[rest.position], &speed = *jumps_.forms[rest.speed];
  const std::vector<double> sizes = turnToAxes(set, found.share, s, v);
  restOthers(set, monomials, speed, found, sizes, s, v);
  makeZero(set, monomials, position, s);
  makeZero(set, monomials, speed, v);

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
