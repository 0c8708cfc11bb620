// A motion whose equations jump, from one smooth piece to the next: on which sides of its jumps it is, and which sides
// it takes where it comes to the surface of one. The rules are the same for doubles and for 128 bits.
//
// A jump is held where both sides drive the motion to its surface, and released where the sign that holds it leaves
// [-1, 1]. Of several that depend on each other, one that does not agree with the motion is changed at a time, the
// first first, until all agree: that ends where solutions are unique (K. G. Murty, Opsearch 11 (1974), on linear
// complementarity), which is the case of dry friction. What turns around a place ever faster (RestingPair) rests there
// once it would after next to no time, and lifts off as what presses it there comes to zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analyses/samples/influence_of_signs.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "scalars/program/linear_form.hpp"
#include "scalars/program/resting.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

inline constexpr const char* noSidesAgree = "its equations jump, and no sides of the jumps agree with the motion";
inline constexpr const char* jumpsWithoutEnd = "its equations jump again and again, and the motion does not go on";
inline constexpr int mostEvents = 100'000;      // of one motion: a caution
inline constexpr int mostShortEvents = 20;      // in a row
inline constexpr double shortestPhase = 1e-12;  // between two events, of the horizon

/// ẋ = f on some sides, what is seen of it, and what is asked of it.
struct SidedPrograms {
  Program rates;    ///< f there
  Program outputs;  ///< g there, with a value at angles of ±π too
  Program watched;  ///< one a jump, below zero where the jump is not on its side: u, -u, 1 - s², of `between` -|u|
  Program judged;   ///< of the jumps the arguments u, then the signs s, then the rates of u
};

/// Nothing where no sign can hold a jump. `resting`: pairs that rest, `between` both their sides: watched of the speed
/// is what presses them to their place.
std::optional<SidedPrograms> sidedPrograms(const Program& f, const Program& g, std::span<const Side> sides,
                                           std::span<const RestingJumps> resting = {});

/// The sides of one motion after another. One a thread.
template <class Real>
class SidesOfMotion {
 public:
  struct Piece {
    explicit Piece(SidedPrograms&& p)
        : programs(std::move(p)),
          rates(programs.rates),
          outputs(programs.outputs),
          watched(programs.watched),
          judged(programs.judged) {}
    SidedPrograms programs;
    Evaluator<Real> rates, outputs, watched, judged;
  };

  /// `g` must outlive it. A motion rests once it would `soon`, in parts of the horizon: turns become too short for what
  /// integrates them, which may be `off` by so much where nothing has moved yet.
  SidesOfMotion(const Program& f, const Program& g, double horizon, std::span<const RestingPair> rests = {},
                double soon = 1e-11, double off = 0)
      : f_(withOneSignASurface(withBareSigns(f))),
        g_(g),
        horizon_(horizon),
        soon_(soon * horizon),
        off_(off),
        count_(jumpsOf(f_).size()) {
    if (count_ > 0) influence_.emplace(f_);
    for (const int jump : jumpsOf(f_)) forms_.push_back(linearFormOf(f_, f_.nodes()[jump].a));
    pairs_ = restingJumps(rests, forms_);
  }

  /// The number of jumps; without any there are no pieces, and nothing to begin or to turn.
  std::size_t count() const { return count_; }
  /// On these sides.
  Piece& piece() { return *piece_; }
  /// Whether jump k, at its surface, leaves it at once if its argument moves at all.
  bool isFree(std::size_t k) const { return sides_[k] == Side::between && lift_[k] == 0 && !isIn(resting_, k); }

  /// values: one a jump, below zero where it is not on its side. What is left to others is given some room.
  void watch(const Real& t, std::span<const Real> x, std::span<Real> values) {
    piece_->watched(t, x, values);
    for (std::size_t k = 0; k < count_; ++k) values[k] = values[k] + lift_[k];
  }

  /// Sets exactly the states that follow from arguments being zero: of held jumps, of pairs that rest, and of those
  /// that turn now.
  void rest(std::span<Real> x) {
    for (std::size_t i = 0; i < shift_.size(); ++i) x[i] = x[i] + shift_[i];
    shift_.clear();
    std::vector<const LinearForm*> forms;
    for (std::size_t k = 0; k < count_; ++k)
      if ((sides_[k] == Side::held || isIn(resting_, k) || isTurning_[k] != 0) && forms_[k])
        forms.push_back(&*forms_[k]);
    std::ranges::fill(isTurning_, char{0});
    for (const auto& [which, state] : statesThatFollow(forms)) {
      const LinearForm& form = *forms[which];
      const double own = form.states[state];
      Real others = constant<Real>(form.constant) / Real(own);
      for (std::size_t i = 0; i < parameters_.size(); ++i)
        if (form.parameters[i] != 0) others = others + parameters_[i] * Real(form.parameters[i]) / Real(own);
      for (std::size_t i = 0; i < x.size(); ++i)
        if (form.states[i] != 0 && i != detail::at(state)) others = others + Real(form.states[i] / own) * x[i];
      x[state] = -others;
    }
  }

  void setParameters(std::span<const Real> p) {
    parameters_.assign(p.begin(), p.end());
    if (influence_) influence_->setParameters(p);
    for (auto& [sides, piece] : pieces_)
      if (piece) setParametersOf(*piece);
  }

  /// Takes the sides of a motion that starts here. False if no sides agree.
  bool begin(const Real& t, std::span<const Real> x) {
    sides_.assign(count_, Side::between);
    isOnSurface_.assign(count_, 1);
    isReleased_.assign(count_, 0);
    resting_.assign(pairs_.size(), 0);
    lifted_.assign(pairs_.size(), 0);
    liftedAt_.assign(pairs_.size(), Real(-2 * soon_));
    room_.assign(pairs_.size(), Real(0.0));
    shift_.clear();
    isTurning_.assign(count_, 0);
    lastTurn_ = t;
    Judgement now;
    // A jump's argument may jump with another, hence more than once.
    for (std::size_t pass = 0; pass <= count_; ++pass) {
      if (!judge(sides_, t, x, now)) return false;
      for (std::size_t k = 0; k < count_; ++k) {
        sides_[k] = sideOf(now.u[k]);
        isOnSurface_[k] = sides_[k] == Side::between ? 1 : 0;
      }
    }
    std::vector<Side> chosen = sides_;
    for (std::size_t k = 0; k < count_; ++k)
      if (isOnSurface_[k] != 0) chosen[k] = sideOnSurface(k, t, x);
    sides_ = std::move(chosen);
    return agree(t, x, now.u);
  }

  /// Takes the sides from (t, x) on, where those watched functions that are marked in `fallen` have come to zero; a
  /// little later, at (later, xLater), they are beyond. False if no sides agree.
  bool turn(const Real& t, std::span<const Real> x, const Real& later, std::span<const Real> xLater,
            std::span<const char> fallen) {
    Judgement now, then;
    if (!judge(sides_, t, x, now) || !judge(sides_, later, xLater, then)) return false;
    std::vector<Side> chosen = sides_;
    turnPairs(t, x, fallen, chosen);
    for (std::size_t k = 0; k < count_; ++k) {
      if (isIn(resting_, k) || isIn(lifted_, k)) {
        isReleased_[k] = 0;
        isOnSurface_[k] = 1;
        continue;
      }
      const bool isReleased = (fallen[k] != 0 && sides_[k] == Side::held) || (isReleased_[k] != 0 && t == lastTurn_);
      isReleased_[k] = isReleased ? 1 : 0;
      isOnSurface_[k] = fallen[k] != 0 || !isSide(sides_[k]) ? 1 : 0;
      if (fallen[k] == 0) continue;
      if (sides_[k] == Side::held)
        chosen[k] = now.s[k] > 0 ? Side::above : Side::below;
      else if (sides_[k] == Side::between)
        chosen[k] = sideOf(then.u[k]);
      else
        chosen[k] = sideBehind(k, std::min(outwards(sides_[k], now.rate[k]), outwards(sides_[k], then.rate[k])), t, x);
    }
    sides_ = std::move(chosen);
    lastTurn_ = t;
    return agree(t, x, now.u);
  }

 private:
  struct Judgement {
    std::vector<Real> u, s, rate;
  };

  /// Whether jump k is one of such a pair.
  bool isIn(const std::vector<char>& ofPairs, std::size_t k) const {
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (ofPairs[p] != 0 && (pairs_[p].position == k || pairs_[p].speed == k)) return true;
    return false;
  }

  void give(const RestingJumps& pair, double side, double way, std::vector<Side>& sides) const {
    sides[pair.position] = sideOf(Real(pair.ofPosition(side)));
    sides[pair.speed] = sideOf(Real(pair.ofSpeed(way)));
  }

  /// Those that come to rest where they would turn, and those that lift off.
  void turnPairs(const Real& t, std::span<const Real> x, std::span<const char> fallen, std::vector<Side>& chosen) {
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const RestingJumps& pair = pairs_[p];
      const bool rested = resting_[p] != 0;
      for (const std::size_t k : {pair.position, pair.speed}) isTurning_[k] = !rested && fallen[k] != 0 ? 1 : 0;
      const bool turns = !rested && (fallen[pair.position] != 0 || fallen[pair.speed] != 0);
      const bool fallsBack = turns && t - liftedAt_[p] <= Real(soon_);  // what lifted it was rounding
      lifted_[p] = rested && fallen[pair.speed] != 0 ? 1 : 0;
      if (lifted_[p] != 0) {
        resting_[p] = 0;
        liftedAt_[p] = t;
        give(pair, 1, 1, chosen);
      } else if (fallsBack || (turns && isSoonAtRest(pair, t, x))) {
        constexpr double more = 16;
        room_[p] = fallsBack ? room_[p] * Real(more) : Real(0.0);
        resting_[p] = 1;
        chosen[pair.position] = chosen[pair.speed] = Side::between;
      }
    }
  }

  /// Where the argument of jump k, in which there is one state, is zero.
  Real zeroOf(std::size_t k, std::size_t state) const {
    Real sum = constant<Real>(forms_[k]->constant);
    for (std::size_t i = 0; i < parameters_.size(); ++i) sum = sum + parameters_[i] * Real(forms_[k]->parameters[i]);
    return Real(-sum / Real(forms_[k]->states[state]));
  }

  /// Whether a motion that turns at (t, x) comes to rest in next to no time. Then x is shifted to where it would rest:
  /// all that the signs do to other states is what the speed does (RestingPair).
  bool isSoonAtRest(const RestingJumps& pair, const Real& t, std::span<const Real> x) {
    using std::abs, std::sqrt;
    const std::size_t s = detail::at(pair.states.position), v = detail::at(pair.states.speed);
    std::vector<Real> there(x.begin(), x.end()), P, Q;
    const Real place = zeroOf(pair.position, s), still = zeroOf(pair.speed, v), speed = x[v] - still;
    there[s] = place;
    std::vector<std::vector<Real>> rates;
    for (const auto& [side, way] : {std::pair(1.0, 1.0), std::pair(1.0, -1.0), std::pair(-1.0, -1.0),
                                    std::pair(-1.0, 1.0)}) {  // away from the place and back, on both sides
      std::vector<Side> sides = sides_;
      give(pair, side, way, sides);
      Piece* const piece = pieceOn(sides);
      if (piece == nullptr) return false;
      std::vector<Real>& here = rates.emplace_back(x.size(), Real(0.0));
      there[v] = still + Real(1.0);
      piece->rates(t, there, here);
      P.push_back(here[s]);
      there[v] = still;
      piece->rates(t, there, here);
      Q.push_back(-Real(side) * here[v]);
      if (!(P.back() > 0) || !(Q.back() > 0)) return false;
    }
    Real share(0.0), duration(0.0);  // as analyses/flow/step/settling.cpp has them
    for (const std::size_t away : {0U, 2U}) {
      const Real own = sqrt(Q[away + 1] * P[away] / (Q[away] * P[away + 1]));
      share = std::max(share, own);
      duration = std::max(duration, Real(Real(1.0) / Q[away] + own / Q[away + 1]));
    }
    const Real first = sqrt(speed * speed + 2 * abs(x[s] - place) * std::max(Real(Q[1] / P[1]), Real(Q[3] / P[3])));
    const Real turn = first * duration;
    if (!(share < 1) || !(turn < Real(soon_) * (Real(1.0) - share))) return false;
    shift_.assign(x.size(), Real(0.0));
    for (std::size_t i = 0; i < x.size(); ++i)
      if (i != s && i != v) shift_[i] = -speed * (rates[0][i] - rates[2][i]) / (rates[0][v] - rates[2][v]);
    return true;
  }

  static bool isSide(Side side) { return side == Side::above || side == Side::below; }
  static Side sideOf(const Real& u) { return u > 0 ? Side::above : u < 0 ? Side::below : Side::between; }
  static Side opposite(Side side) { return side == Side::above ? Side::below : Side::above; }
  /// Of a value, as seen from a side: positive away from the surface.
  static Real outwards(Side side, const Real& value) { return side == Side::above ? value : Real(-value); }
  /// Whether nothing is left of `part` but what rounding may have left of `whole`.
  static bool isRounding(const Real& part, const Real& whole) {
    using std::abs;
    return abs(part) <= abs(whole) * Real(1024.0) * Real(std::numeric_limits<Real>::epsilon());
  }

  void setParametersOf(Piece& piece) {
    piece.rates.setParameters(parameters_);
    piece.outputs.setParameters(parameters_);
    piece.watched.setParameters(parameters_);
    piece.judged.setParameters(parameters_);
  }

  Piece* pieceOn(const std::vector<Side>& sides) {
    std::vector<RestingJumps> resting;
    std::vector<char> which(pairs_.size(), 0);
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      which[p] =
          resting_[p] != 0 && sides[pairs_[p].position] == Side::between && sides[pairs_[p].speed] == Side::between;
      if (which[p] != 0) resting.push_back(pairs_[p]);
    }
    const auto [place, isNew] = pieces_.try_emplace({sides, which});
    if (isNew) {
      if (auto programs = sidedPrograms(f_, g_, sides, resting)) {
        place->second = std::make_unique<Piece>(std::move(*programs));
        setParametersOf(*place->second);
      }
    }
    return place->second.get();
  }

  /// False if a jump that shall be held never can be.
  bool judge(const std::vector<Side>& sides, const Real& t, std::span<const Real> x, Judgement& result) {
    Piece* const piece = pieceOn(sides);
    if (piece == nullptr) return false;
    std::vector<Real> all(3 * count_, Real(0.0));
    piece->judged(t, x, all);
    const auto part = [&](std::size_t i) {
      const auto from = all.begin() + static_cast<std::ptrdiff_t>(i * count_);
      return std::vector<Real>(from, from + static_cast<std::ptrdiff_t>(count_));
    };
    result = {part(0), part(1), part(2)};
    return true;
  }

  /// The rate of u_k if it alone were on that side; zero if that is not known.
  Real rateOn(Side side, std::size_t k, const Real& t, std::span<const Real> x) {
    std::vector<Side> sides = sides_;
    sides[k] = side;
    Judgement there;
    return judge(sides, t, x, there) ? there.rate[k] : Real(0.0);
  }

  /// Of a jump whose surface a motion starts on: held if that is possible at all, or where its argument goes.
  Side sideOnSurface(std::size_t k, const Real& t, std::span<const Real> x) {
    using std::abs;
    const Real above = rateOn(Side::above, k, t, x), below = rateOn(Side::below, k, t, x);
    return isRounding(above - below, abs(above) + abs(below)) ? sideOf(above) : Side::held;
  }

  /// Of a jump that comes to its surface from its side, at this rate away from it: held if the other side drives it
  /// back.
  Side sideBehind(std::size_t k, const Real& rate, const Real& t, std::span<const Real> x) {
    const Side side = sides_[k];
    const Real other = rateOn(opposite(side), k, t, x);
    if (!(outwards(side, other) > 0)) return opposite(side);
    return rate < 0 ? Side::held : side;
  }

  /// Changes sides until all agree with the motion. uBefore: the arguments on the sides before.
  bool agree(const Real& t, std::span<const Real> x, std::span<const Real> uBefore) {
    influence_->evaluate(t, x, sides_);
    Judgement now;
    for (std::size_t change = 0; change <= 50 * (count_ + 1); ++change) {
      holdIndependent();
      if (!judge(sides_, t, x, now)) return false;
      std::size_t k = 0;
      Side better = Side::held;
      for (; k < count_; ++k)
        if (better = betterSide(k, now, t, x, uBefore); better != sides_[k]) break;
      if (k == count_) {
        settle(t, x, now);
        return true;
      }
      sides_[k] = better;
    }
    return false;
  }

  /// Of those that shall be held the first that are independent; the others between.
  void holdIndependent() {
    held_.clear();
    for (std::size_t k = 0; k < count_; ++k) {
      if (sides_[k] != Side::held) continue;
      if (influence_->isLeftTo(held_, k))
        sides_[k] = Side::between;
      else
        held_.push_back(k);
    }
  }

  bool isLeftToOthers(std::size_t k, const Judgement& now) const {
    const bool isAway = isOnSurface_[k] == 0 && isSide(sides_[k]) && outwards(sides_[k], now.u[k]) > 0;
    return sides_[k] != Side::held && !isAway && influence_->isNothing(now.rate[k], k) &&
           influence_->isLeftTo(held_, k);
  }

  void settle(const Real& t, std::span<const Real> x, const Judgement& now) {
    piece_ = pieceOn(sides_);
    lift_.assign(count_, Real(0.0));
    std::vector<Real> values(count_, Real(0.0));
    piece_->watched(t, x, values);
    using std::abs;
    const Real tiny(std::numeric_limits<Real>::epsilon());
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const RestingJumps& pair = pairs_[p];
      if (resting_[p] != 0) {  // it lifts off later by next to nothing, so as not to fall back
        if (room_[p] == 0) room_[p] = Real(4096.0) * tiny * abs(values[pair.speed]);
        lift_[pair.speed] = room_[p];
        continue;
      }
      constexpr double roundings = 8;  // of a place: what has just turned there does not fall by these
      for (const auto& [k, state] :
           {std::pair(pair.position, pair.states.position), std::pair(pair.speed, pair.states.speed)})
        if (isSide(sides_[k]))
          lift_[k] = std::max(Real(off_), Real(Real(roundings) * tiny * abs(zeroOf(k, detail::at(state)))));
    }
    for (std::size_t k = 0; k < count_; ++k)
      if (!isIn(resting_, k) && isLeftToOthers(k, now))
        lift_[k] = influence_->small() * influence_->own(k) * Real(horizon_) - values[k];
  }

  Side betterSide(std::size_t k, const Judgement& now, const Real& t, std::span<const Real> x,
                  std::span<const Real> uBefore) {
    using std::abs;
    const Side side = sides_[k];
    if (isIn(resting_, k) || isIn(lifted_, k)) return side;
    if (side == Side::held) {
      if (isRounding(Real(std::max(Real(abs(now.s[k])), Real(1.0)) - 1), Real(1.0))) return side;
      isReleased_[k] = 1;
      return now.s[k] > 0 ? Side::above : Side::below;
    }
    if (isLeftToOthers(k, now)) return side;
    if (side == Side::between) return sideOf(now.rate[k]);
    const Real distance = outwards(side, now.u[k]);
    const bool hasJumped = isOnSurface_[k] == 0 && outwards(side, uBefore[k]) > 0 && distance < 0;
    if (hasJumped) return opposite(side);
    if ((isOnSurface_[k] == 0 && distance > 0) || !(outwards(side, now.rate[k]) < 0)) return side;
    const Real other = rateOn(opposite(side), k, t, x);
    if (!(outwards(side, other) > 0)) return opposite(side);
    // At its release the sign of a jump is that of its side: what drives it back is rounding.
    return isReleased_[k] != 0 && isRounding(now.rate[k], other) ? side : Side::held;
  }

  const Program f_;
  const Program& g_;
  double horizon_, soon_, off_;
  std::size_t count_;
  std::optional<InfluenceOfSigns<Real>> influence_;
  std::vector<std::optional<LinearForm>> forms_;  // of each argument that is one
  std::vector<Real> parameters_;
  std::map<std::pair<std::vector<Side>, std::vector<char>>, std::unique_ptr<Piece>> pieces_;  // and pairs that rest
  Piece* piece_ = nullptr;
  std::vector<Side> sides_;
  std::vector<char> isOnSurface_, isReleased_;
  Real lastTurn_{0.0};
  std::vector<std::size_t> held_;
  std::vector<RestingJumps> pairs_;
  std::vector<char> resting_, lifted_;  // of each pair: whether it rests; whether it lifted off at the last turn
  std::vector<Real> liftedAt_, room_;   // when it last did; by how much less than nothing presses it then
  std::vector<char> isTurning_;         // of each jump, of a pair: it does at this very time
  std::vector<Real> shift_;             // of states, where a pair came to rest
  std::vector<Real> lift_;              // of the watched functions: zero but for what is left to others
};

}  // namespace gamut
