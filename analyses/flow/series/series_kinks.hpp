// The kinks of a series, its nodes |u| and sign u: what polynomials take for them, and what is known of where u is.
#pragma once

#include <optional>
#include <vector>

#include "analyses/flow/series/series_plan.hpp"
#include "scalars/interval.hpp"

namespace gamut {

class SeriesKinks {
 public:
  explicit SeriesKinks(const std::vector<SeriesNode>& nodes);

  /// |u| ≈ slope u + middle.
  struct Chord {
    double slope = 0, middle = 0;
    bool isExact() const { return (slope == 1 || slope == -1) && middle == 0; }  // where u stays on one side
  };
  struct Kink {
    int argument;                   // u
    Chord chord;                    // of |u|
    double jump = 0;                // radius of a sign in outputs
    std::optional<Interval> given;  // what a sign is
    double about = 0;               // and what polynomials take for it
    bool isApart = false;           // its push is reckoned apart
    bool isSided = false;           // of |u|, bounded last: u is on one side
  };
  struct Argument {
    double side = 0;                   // if known for all solutions: 1, -1
    double passed = 0;                 // whose kink all pass: the side they come from
    double crossing = 0, reached = 0;  // what a chord spans; may have to
    bool isCalm = false;               // it needs no haste
  };
  const Kink& operator[](int kink) const { return kinks_[kink]; }
  Kink& operator[](int kink) { return kinks_[kink]; }
  const Argument& argument(int u) const { return arguments_[u]; }

  /// The signs in outputs themselves, in the program's order.
  const std::vector<int>& jumps() const { return jumps_; }
  /// Whether there are any, and, since forgetJumps, the bounds of a set found one that may be either way there. From
  /// then on it counts so along the polynomial too: not as something that follows the states, but as an input.
  bool hasJumps() const { return !jumps_.empty(); }
  bool hasJumped() const { return hasJumped_; }
  void forgetJumps();
  /// The radius of a sign in outputs, this one or what it was before if that is more.
  double widenJump(int jump, double radius);
  /// On the set bounded last it may be either.
  bool mayTurn(int jump) const { return arguments_[kinks_[jump].argument].reached > 0; }

  /// The sign, or means of it, until forgetCrossings, as for the next computations. Its argument asks for no haste
  /// then, and where that is nowhere on one side, |u| and its derivative are those of the other. The polynomials take
  /// `about` for it.
  void giveSign(int jump, const Interval& sign, const Interval& argument, double about);
  /// Whether along the polynomial the sign, or |u|, counts as what it is there, since its push is reckoned apart.
  void setApart(int kink, bool isApart) { kinks_[kink].isApart = isApart; }
  /// What all solutions pass in the step: the next computations take |u| as `side` times u, 1 or -1, until
  /// forgetCrossings. False if they did already.
  bool passKink(int kink, double side);
  /// On which side u is for all solutions in the step, until forgetCrossings; of |u| and of sign u. False if that is
  /// known.
  bool giveSide(int kink, double side);
  /// What the next computations take of those that the set bounded last may cross: chords over all that it reaches, and
  /// 0 for a sign in outputs themselves. False if none are crossed. Until forgetCrossings.
  bool adaptToCrossings();
  void forgetCrossings();

  /// How far u may be from what it is about, until forgetAtStart: at the start of the step.
  void keepAtStart(const std::vector<double>& uncertain) { atStart_ = uncertain; }
  void forgetAtStart() { atStart_.clear(); }
  double atStart(int u) const { return atStart_[u]; }
  /// Whether u = centre, which moves by M of the V that it varies by, ± rho may change its sign, or be zero, in the
  /// step; centre is not negative. Then the step should end before, or be so short that u moves by less than what is
  /// uncertain about it: raises `haste`.
  bool mayCross(int u, double centre, double V, double M, double rho, double& haste);

 private:
  std::vector<Kink> kinks_;          // [node]
  std::vector<Argument> arguments_;  // [node]
  std::vector<int> jumps_;
  bool hasJumped_ = false;
  std::vector<double> atStart_;
};

}  // namespace gamut
