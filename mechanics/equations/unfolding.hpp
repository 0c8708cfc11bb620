// Motions that strike rigid ends of their joints' travel, unfolded: stated so that nothing but ẋ = f jumps.
//
// A coordinate q with speed u strikes the end a of its travel, above which it stays, and leaves it by Newton's law of
// impact, u⁺ = −e u⁻. What strikes goes on beyond a as its mirror image: a position s with q = a + |s − a|, and with
// σ = sign(s − a) a speed v, u = g v,
//
//   g = σ(1 + e)/2 − sign(v)(1 − e)/2:  1 before the end (σ = 1, v < 0), −e behind it; −1, then e, on the way back.
//
// So s and v go on where q strikes: u before is v, u behind −e v. Where u is zero, g changes by the factor e, and v is
// zero. The other speeds of the machine get (M⁻¹)ⱼᵢ/(M⁻¹)ᵢᵢ = cⱼ of what u_i gets, as its impulse has no other
// component; therefore wⱼ = uⱼ − cⱼ(u − v) goes on. With g' = 0 the rates are ṡ = σ u, v̇ = u̇/g and
// ẇⱼ = u̇ⱼ − ċⱼ(u − v) − cⱼ(g − 1) v̇. Of an end below which q stays, all this with −q.
//
// A motion starts with s, v, w the machine's own position and speeds: where the joint starts away from the end, u > 0,
// by g divided by e.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/description/refusal.hpp"
#include "mechanics/equations/system.hpp"
#include "mechanics/rigid_end.hpp"

namespace gamut {

template <class S>
class Unfolding {
 public:
  /// `position`, `speed`: where states have those of each end's coordinate; `firstSpeed`: where the system's begin.
  struct Struck {
    RigidEnd<S> end;
    std::size_t position, speed;
  };
  /// Throws UnfitPart for a system with constraints.
  Unfolding(std::vector<Struck> struck, std::size_t firstSpeed, System<S>& system);

  bool isEmpty() const { return folds_.empty(); }
  /// σ and the sign of v of each end.
  std::vector<S> signsAt(const std::vector<S>& x) const;
  /// From unfolded states x to the machine's, of these signs; `isSmooth`: σ goes on beyond an end. `move` moves it by
  /// states. Throws UnfitPart where Recorded is not known to keep the impulse at one end from what strikes another.
  void fold(std::vector<S>& x, const std::vector<S>& signs, bool isSmooth,
            const std::function<void(const std::vector<S>&)>& move);
  /// After fold(): from the machine's ẋ to the rates of the unfolded states, which are recorded as `x` and `time`.
  void unfold(std::vector<S>& rates, std::span<const S> x, const S& time) const requires std::same_as<S, Recorded>;

 private:
  struct Fold {
    Struck of;
    S pace = S(0.0), inverse = S(0.0), surplus = S(0.0), scaleRate = S(0.0);  // ṡ, 1/g, u − v, its derivative by v
    std::vector<S> shares = {};                                               // c
  };
  void findShares(Fold& fold, const Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>& m) const;

  std::vector<Fold> folds_;
  std::size_t firstSpeed_;
  System<S>& system_;
};

GAMUT_COMPILED_ELSEWHERE(Unfolding)

/// `what` of signs, as what it is of each sign ±1 times (1 ± s)/2: affine in each. Of two ends these are sixteen copies
/// of it; further signs stay what they are.
std::vector<Recorded> ofBothSides(std::vector<Recorded> signs,
                                  const std::function<std::vector<Recorded>(const std::vector<Recorded>&)>& what,
                                  std::size_t first = 0);

}  // namespace gamut
