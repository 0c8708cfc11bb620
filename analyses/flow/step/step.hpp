// One step of the flow: the set of one piece, its certified step, its values in between and its update. docs/flow.md
// states the theorem behind every function.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "analyses/flow/cause.hpp"
#include "analyses/flow/series/bounded_polynomial.hpp"
#include "analyses/flow/series/polynomial_range.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/flow/step/chord.hpp"
#include "analyses/flow/step/growth.hpp"
#include "analyses/flow/step/held_signs.hpp"
#include "analyses/flow/step/inputs.hpp"
#include "analyses/flow/step/jump_rates.hpp"
#include "analyses/flow/step/jumps.hpp"
#include "analyses/flow/step/kinks.hpp"
#include "analyses/flow/step/scales.hpp"
#include "analyses/flow/step/set.hpp"
#include "analyses/flow/step/step_crossing.hpp"
#include "analyses/flow/step/step_turn.hpp"
#include "analyses/flow/step/time_kinks.hpp"
#include "analyses/flow/step/turn.hpp"
#include "analyses/work.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// p(σ), Ψ(σ) and what bounds their distance from the truth at one time of the step.
struct FlowPoint {
  std::vector<double> p;                        // [state][monomial]
  std::vector<double> low;                      // of each state, p's second double
  std::vector<double> psi;                      // [monomial][row][column]
  std::vector<double> psiSum;                   // Σ_α |Ψ_α| [row][column]
  std::vector<double> zonotope;                 // Ψ_0 Γ [generator][row], errors' first, then those of inputs
  std::size_t ofErrors = 0;                     // how many of these numbers are the errors'
  std::vector<std::vector<double>> drivenOfXi;  // linear in each symbol, of those of inputs
  std::vector<double> total;                    // R + Σ_j |Γ_j|, inputs included
  std::vector<double> ofR;                      // the same of errors alone
  std::vector<double> beyond;                   // of each state, what is of higher order in ξ of inputs
  std::vector<double> loose;                    // everything but Ψ (r + Γs), a bound for each state
  std::vector<double> radius;                   // |x - p - low| ≤ radius
  std::vector<double> driven;                   // what of that inputs did
  std::vector<double> known;                    // what of that is known of jumps' arguments besides
};

/// How the polynomials of a step fade with their grade.
struct GradeDecay {
  double ratio;    // of what one grade holds to what the grade before holds, among the highest
  double symbols;  // how many symbols share in the highest grades
  double highest;  // what the two highest grades hold of what is linear
};

/// Of a number that inputs drive, Σ_c |a_c + Σ_l ξ_l b_lc| at most, c every `stride`: convex in ξ, so greatest at a
/// corner. In a from `first` on; in each b from the beginning, but for the same place within a stride.
double drivenRadius(const std::vector<double>& a, const std::vector<std::vector<double>>& b, std::size_t first,
                    std::size_t stride);

/// What the argument of a jump is on the set, `total` being its totalRadius; by its dependence on ξ where monomials are
/// given.
Interval argumentOf(const FlowSet& set, const LinearForm& form, const std::vector<double>& total,
                    const Monomials* monomials = nullptr);

/// A sum of terms in ξ as it is computed: what they are together in size tells its roundings; `loose`, what else it is
/// off.
struct LooseSum {
  std::vector<double> p;  // [monomial]
  double loose = 0, size = 0;

  /// += Σ_k (d_k/by) p_k of the form; returns of how many terms.
  int addParameters(const LinearForm& form, double by, const std::vector<Embedded>& parameters,
                    const Monomials& monomials);
};

/// How much longer than until the last solution has passed a jump or kink a step is, so that rates over all of it still
/// say so.
constexpr double beyondTheLast = 1.0625;

/// What a step may add, beyond which the set is to be split. 0: none is asked for.
struct SplitShares {
  double truncation = 0;  ///< in ξ, per second, relative to the state
  double kink = 0;        ///< what crossing kinks and jumps adds to a state, as a share of its width in the whole box
  /// What solutions that come to be held in this step add to a state that follows them, as a share of its width in the
  /// whole box.
  double slide = 0;
};

/// What a step takes for granted from its start on, until it is proved. Sides: 1 or -1; 0: none is assumed.
struct StepAssumptions {
  std::vector<double> sides;      ///< of each own jump, on which all solutions are; none: nowhere
  std::vector<char> leaving;      ///< of each own jump, whether it is so since others push it there; none: of none
  std::vector<double> kinkSides;  ///< of each kink
  std::size_t passing = StepTurn::none;  ///< the kink that all solutions pass as a turn, from the side passingFrom
  double passingFrom = 0;
  bool isPassing = false;  ///< whether any comes so far or not
  bool mayTurn = true, mayPass = true;
  std::vector<double> unsettled;  ///< how far solutions may be beside the set; none: they are not
  std::vector<double> lift;       ///< how much wider the tube is for those that have turned; none: it is not
  bool isLiftOfSurface = false;
  double beyondLast = 0;  ///< how much longer the step is than until the last has turned, s; 0: not known yet
  double signsAt = 0;     ///< the step when signs were given; 0: none were
  double givenAt = 0;     ///< the longest step that what was given holds for: signs, sides
  double reach = 0;       ///< how long a step may be in which solutions turn, s
};

/// What the search for a step met.
struct StepCourse {
  bool isSliding = false, isShortened = false;
  bool isCut = false;  ///< by the end that was given
  int lengthened = 0;  ///< so often, for all solutions to pass a jump in one step
  int turnTries = 0;
  bool hasLostTurn = false, isTurnMixed = false;
  bool leavesOnceTurned = false;           ///< another side, before the step's end
  int turnSymbol = -1, symbolAcross = -1;  ///< that decide most: about a turn's moment; about when kinks are crossed
  double slideLoss = 0;
};

/// What a step left out: orders in time, of the states and of the frame; grades in ξ, and roundings.
struct StepLosses {
  double time = 0, frame = 0, truncation = 0;
};

/// `released`: solutions that were held may leave.
enum class StepOutcome { stepped, splitWanted, failed, released };

/// Steps sets of one layout (monomials, degrees, order). Holds the workspace: one a thread. Once `cancelled`, if not
/// null, is set, certify throws Cancelled.
class FlowStepper {
 public:
  /// `motion`: f, ∂f/∂x, and, of each f_i, ∂f_i/∂w of all `inputs`.
  FlowStepper(const Program& motion, std::shared_ptr<const Monomials> monomials, int frameDegree, int order,
              double tolerance, FlowInputs inputs, const std::atomic<bool>* cancelled = nullptr);

  /// Certifies a step from `set` that ends no later than `end`; beyond it if that is the horizon and not all that turn
  /// have turned. What adds more than its share is answered by
  /// splitWanted. h(), evaluate() and advance() refer to the step until the next call.
  StepOutcome certify(const FlowSet& set, double end, double quantum, const SplitShares& shares = {});
  double h() const { return h_; }
  /// So many first orders in double-double, where there are no symbols (PolynomialSeries).
  void setFineOrders(int orders) { series_.setFineOrders(orders); }
  /// What the step left out: orders in time; grades in ξ, and roundings. Of the states, relative to their size.
  double timeError() const { return lost_.time; }
  double truncation() const { return lost_.truncation; }
  /// Moves the polynomials of `set` on by a step that nothing is proved of; false if there is none. `turned`: what
  /// becomes in it of errors, about, [row][column].
  bool drift(FlowSet& set, double end, std::vector<double>& turned);
  /// Whether the step's comparison knew the sign of what damps the motion (FlowGrowth).
  bool isDamped() const { return growth_.isDamped(); }
  bool isAboutCentre() const { return growth_.isAbout(); }
  /// How many jumps and kinks all solutions pass, come to or leave in the step, or before the horizon.
  std::size_t crossings() const { return crossings_.size() + (turn_ ? 1 : 0); }
  /// After a failure: what could not be proved, of which state.
  const FlowCause& why() const { return why_; }
  /// A state that has grown a thousandfold and would double long before the time it took; -1 if none has.
  int escaping(const FlowSet& set) const;
  /// `own`: of the stepper's motion. That is the one of the jumps `of`, or, if `held` is not empty, the one in which
  /// those are held: of these, arguments have to be zero in every set. left, factor: as of FlowJumps::heldProgram.
  void setJumps(const FlowJumps& own, const FlowJumps& of, std::vector<char> held, std::vector<int> left,
                std::vector<double> factor);
  /// After `released`: of each jump, whether solutions at it stay held.
  const std::vector<char>& stillHeld() const { return stillHeld_; }
  /// Those held at the step's end, where all solutions leave one of those held in the step; else none.
  const std::vector<char>& heldBehind() const { return turn_ && turn_->releases() ? stillHeld_ : nothingHeld_; }
  /// Whether a turn was looked at in the last step of which polynomials of a higher degree might tell more.
  bool hasLostTurn() const { return course_.hasLostTurn; }
  bool hasTurned() const { return turn_.has_value(); }
  bool hasToStop() const { return turn_ && !turn_->fromMoment.empty(); }
  /// Or was refused, and smaller parts may tell: in some of them another jump holds or lets go before, or no degree
  /// helps.
  bool isTurnMixed() const { return course_.isTurnMixed; }
  /// The symbol that decides most about when; -1 if none does.
  int turnSymbol() const { return course_.turnSymbol; }
  /// Of each jump, whether its argument is zero for all solutions in the set; empty if none is.
  static std::vector<char> resting(const FlowSet& set, const FlowJumps& jumps);
  /// Before setJumps. `length`, `resolution`: of time, s; `kinks`: of the stepper's motion.
  void setTime(double length, double resolution, TimeKinks kinks);
  /// Whether solutions may be stopped once they have turned.
  void setMayStop(bool mayStop) { mayStop_ = mayStop; }
  /// Whether they may from a first turn on: what kinks do is assumed then.
  void setMayStopEarly(bool may) { mayStopEarly_ = may; }
  /// Whether they have to be: then nothing is proved of what follows, and moments may be far apart.
  void setStops(bool stops) { stops_ = stops; }
  /// Whether a turn was looked at in the last step, or some pass a kink.
  bool hasTriedTurn() const { return course_.turnTries > 0 || !crossings_.empty(); }
  /// Whether a kink may have come to zero, and f has one of a surface at which it does not jump.
  bool meetsKinks() const;
  void setStateNames(const std::vector<std::string>& names) { names_ = names; }
  /// Steps are relative to no less than a share of these. Null: they are not known.
  void setScales(std::shared_ptr<const FlowScales> scales) { scales_ = std::move(scales); }
  std::string nameOf(int state) const;
  /// After a failure: the remainder, not ξ, makes the set too wide; bisecting ξ cannot help.
  bool isRemainderDominant(const FlowSet& set) const;
  /// The remainder is about as large as the set, in balanced units: what grows from there is never tight again.
  bool isRemainderTooLarge(const FlowSet& set) const;

  /// The set τ seconds into the step, 0 ≤ τ ≤ h; what is known of jumps' arguments besides counts if `narrowed`. Of
  /// those alone that turn in `moments`, if there are any, s.
  void evaluate(const FlowSet& set, double tau, FlowPoint& point, bool narrowed = true,
                std::optional<Interval> moments = {});
  /// Whether solutions in the step are beside what the set says (FlowSet::unsettled).
  bool isUnsettled() const { return !assumed_.unsettled.empty(); }
  /// Whether some may have turned by then, and others not yet.
  bool isTurning(double tau) const { return turn_ && turn_->moments.lower() < tau && tau < turn_->moments.upper(); }
  /// When they do so, in units of `scale`, as a polynomial in ξ; and in seconds, what solutions do so where that is
  /// within `moment`.
  const std::vector<double>& turnMoment() const { return turn_->when.c; }
  Interval momentsOf(const Interval& moment) const {
    return Interval(h0_) * moment + Interval(-turn_->away, turn_->away);
  }
  /// Whether more is known of these in this step than the set says.
  bool narrows() const { return !ownBounds_.empty() || !heldBounds_.empty() || !crossings_.empty() || turn_; }
  /// Narrows what the states are during the whole step by what is known of these.
  void narrowOver(std::vector<Interval>& states) const;
  /// Of each sign of the motion in which none is held (`count` of them) what it may be: so many seconds into the step,
  /// and over all of it (JumpBound). Nothing is told of those held.
  std::vector<SignCases> signsAfter(double seconds, std::size_t count, std::optional<Interval> moments = {}) const;
  std::vector<SignCases> signsOver(std::size_t count) const;
  /// How far solutions leave their chords between two moments of the step, in seconds from its start, for each state:
  /// p + Ψ (r + Γs) bends, the rest is what is left over; at the start itself that is the chord from where solutions
  /// are, whatever is known of them there.
  void sag(double from, double to, std::vector<FlowSag>& sags) const;
  /// The step for others: x = p + Ψ (r + Γs) + loose, p and Ψ polynomials in σ ∈ [0, θ], σ = (t - set.t) / scale.
  const PolynomialSeries& series() const { return series_; }
  double scale() const { return h0_; }
  double theta() const { return theta_; }
  double totalBound(int j) const { return total_[j]; }  ///< R + Σ_j |Γ_j|, at the start
  double tubeBound(int i) const;                        ///< |x - p|, always
  double looseBound(int i) const;                       ///< |loose| and what inputs do in the step, at every time
  /// The set at the end of the step.
  void advance(FlowSet& set);
  /// Whether all solutions turn so soon that each may be stopped where it just has, at a time of its own; and when they
  /// do, s.
  bool mayStopOnceTurned(const FlowSet& set) const;
  Interval turnMoments() const { return turn_->moments; }
  double turnAway() const { return turn_->away; }  ///< s, of solutions' own moments from turnMoment, at most
  double turnLag() const { return turn_->lag; }    ///< s, by which they are stopped later than that
  /// The set of what they are there (FlowSet::ahead), in place of that at the step's end.
  void advanceOnceTurned(FlowSet& set);
  /// Whether there are moments of the step at which solutions are much nearer to each other than at any one time: each
  /// is to go on from there. `weights`: how much each state counts.
  bool findMeeting(const std::vector<double>& weights);
  /// The set of what they are there.
  void advanceToMeeting(FlowSet& set);
  /// |x - x̃ - D| of any solution that has turned, or that has not, at any time of the step.
  double radiusOver(int state, bool hasTurned) const;
  /// Whether solutions that turn are known since their moments until they are stopped.
  bool isSinceMoment() const { return !turn_->fromMoment.empty(); }
  /// If so, a state by orders of that time, in units of σ; else what turning adds to its polynomials, by orders of σ.
  const std::vector<BoundedPolynomial>& turnedTo(int state) const {
    return (isSinceMoment() ? turn_->fromMoment : turn_->D)[state];
  }
  /// Whether the set at one time tells nothing but what the step as a whole does.
  bool isOpaque() const { return !crossings_.empty() || isUnsettled(); }
  /// As signsOver, of those that have turned, or that have not.
  std::vector<SignCases> signsOver(std::size_t count, bool hasTurned) const;
  /// The greatest remainder of all states, relative to the state's size over the step.
  double relativeRemainder(const FlowSet& set) const;
  /// The symbol whose high powers weigh most in the step.
  int worstSymbol() const;
  /// Whether that is what is wanted of it: no higher degree helps.
  bool isAcrossKink() const { return course_.symbolAcross >= 0; }
  /// What solutions that come to be held in this step add to a state that follows them, as a share of its width in the
  /// whole box.
  double slideLoss() const { return course_.slideLoss; }
  GradeDecay decay() const;
  /// Bisects `set` in a symbol; `set` becomes one half, the other is returned.
  FlowSet bisect(FlowSet& set, int symbol, const PolynomialRange& shift) const;

  const Monomials& monomials() const { return series_.monomials(); }
  int frameCount() const { return series_.frameCount(); }

 private:
  void evaluateMotion(const FlowSet& set, double tau, FlowPoint& point, bool narrowed,
                      std::optional<Interval> moments = {});
  void evaluateRemainder(const FlowSet& set, double tau, FlowPoint& point) const;
  void turnFrame(FlowSet& set);
  struct GeneratorRest;
  Eigen::VectorXd turnGenerators(FlowSet& set, const Eigen::MatrixXd& turn, const Eigen::MatrixXd& fresh);
  void multiplyGenerators(FlowSet& set, GeneratorRest& rest);
  void carryInputs(FlowSet& set, GeneratorRest& rest);
  void carryGenerators(FlowSet& set);
  void evaluateAt(const BoundedPolynomial& moment, FlowPoint& point) const;
  void advanceTo(const BoundedPolynomial& moment, FlowSet& set);
  BoundedPolynomial momentOnceTurned() const;
  BoundedPolynomial frameAt(std::size_t i, std::size_t j, const BoundedPolynomial& moment) const;
  void endStep(FlowSet& set);
  void evaluateInputs(const FlowSet& set, const std::vector<double>& columns, FlowPoint& point) const;
  bool boundGrowth(const FlowSet& set, double h);
  bool mayDamp(const FlowSet& set) const;
  bool areJumpsClear(const FlowSet& set) const;
  bool isSmooth() const;
  double dampedStep() const;
  double worstColumn(const FlowSet& set) const;
  bool refuse();
  bool boundAlong();
  void boundTube();
  bool proveTube(const FlowSet& set, double h);
  void adjustScales();
  void boundErrors(const FlowSet& set);
  void boundFrameErrors(const FlowSet& set);
  bool tryStep(const FlowSet& set, double theta);
  void load(const FlowSet& set);
  double expand(const FlowSet& set, double left, double smallest, double share = 0);
  void boundDerivatives();
  double suggestion(double theta, double share) const;
  FlowCause reason(const FlowSet& set) const;
  double doubling(const FlowSet& set, int state) const;
  bool isTruncationTooLarge(double share);
  bool isLooserThanDriven() const;
  bool isKinkTooWide(const FlowSet& set, const SplitShares& shares);
  static constexpr std::size_t none = StepTurn::none;
  enum class Look { goOn, again, shorter, longer, unsided, released };
  bool mayPassKink(const FlowSet& set) const;
  std::vector<JumpBound> sidedBounds() const;
  struct Around;
  std::optional<Look> lookAtSides(const FlowSet& set, const Box& box, double& h, double smallest);
  std::optional<Look> withoutTurn();
  std::optional<Look> withoutLift();
  std::vector<SideRates> ratesUntil(const JumpRates& rates, double until, std::size_t count) const;
  std::optional<double> longestHeldIn(const FlowSet& set, Around& around, double& h, double smallest);
  std::optional<Look> lookAtHeld(const FlowSet& set, Around& around, double& h, double smallest);
  Look lookAtCrossings(const FlowSet& set, const Around& around, double& h, double smallest, double left);
  Look giveNarrower(const std::vector<std::size_t>& narrower, double h);
  Look lookAtJumps(const FlowSet& set, double& h, double smallest, double left);
  Interval kinkAtStart(const FlowSet& set, std::size_t kink, const Interval& found) const;
  void boundCurves(const FlowSet& set, double h, std::vector<Interval>& u, std::vector<JumpBound>& bounds,
                   std::vector<JumpBound>& atStart);
  bool leavesKinkSides(const std::vector<JumpBound>& atStart, const std::vector<Interval>& u, double h);
  Look passKinks(const std::vector<JumpBound>& bounds, double h, double left);
  Look lookAtKinks(const FlowSet& set, double& h, double smallest, double left);
  struct Search;
  void begin(const FlowSet& set, double end);
  void forgetCrossings(const FlowSet& set, double end);
  void compute(const FlowSet& set);
  void computeAnew(Search& search);
  bool adapts(Search& search);
  bool isShortenedForErrors(Search& search);
  Look lookAround(Search& search);
  bool isShortenedForHaste(Search& search);
  void shortenFailed(Search& search);
  void take(const Search& search);
  bool passesAsTurn(Search& search);
  static double longestToCross(const std::vector<JumpBound>& bounds, const std::vector<JumpBound>& atStart, double h,
                               double smallest, bool mayArrive = false);
  Box boxAtStart(const FlowSet& set) const;
  Box boxWithin(const std::vector<double>& reach) const;
  void boundCrossings(const FlowSet& set);
  std::vector<BoundedPolynomial> argumentAlong(const FlowSet& set, const LinearForm& form) const;
  void addBesides(const StepCrossing& crossing, double last, double& sum) const;
  double changedBy(const StepCrossing& other, const StepCrossing& crossing) const;
  std::vector<BoundedPolynomial> areaOf(const std::vector<BoundedPolynomial>& u, const BoundedPolynomial& moment) const;
  bool boundMoment(const FlowSet& set, StepCrossing& crossing) const;
  /// What is added to f from the moment on, over change().
  struct Push {
    const PolynomialSeries* of;
    int node;
    double norm() const { return of->norm(node); }
    double leading() const { return of->series(node)[0]; }
  };
  Push pushOf(const StepCrossing& crossing, std::size_t state) const;
  bool loadHeldPush(const FlowSet& set, StepCrossing& crossing);
  void boundCurvature(StepCrossing& crossing, double longest, std::vector<double>& rest) const;
  bool boundCurvatureOfKink(StepCrossing& crossing, double longest, std::vector<double>& rest);
  static std::pair<BoundedPolynomial, double> sinceCrossing(const StepCrossing& crossing, double tau);
  BoundedPolynomial areaSince(const StepCrossing& crossing, double tau, const BoundedPolynomial& l) const;
  BoundedPolynomial pushAt(const StepCrossing& crossing, std::size_t state, double tau) const;
  void addCrossing(const FlowSet& set, const StepCrossing& crossing, double tau, FlowPoint& point) const;
  int symbolOfSliding(const FlowSet& set, const SplitShares& shares);
  double longestWhileSliding(const JumpBound& bound, const JumpBound& atStart, double h, double last) const;
  bool boundOwnJumps(const FlowSet& set, const Interval& time, const Box& box, double h, std::vector<JumpBound>& bounds,
                     std::span<const SideRates> known = {});
  void boundHeldJumps(const FlowSet& set, const Interval& time, const Box& box, double h,
                      const std::vector<JumpBound>& own, std::vector<JumpBound>& bounds,
                      std::span<const SideRates> known = {});
  Interval argumentAtStart(const FlowSet& set, std::size_t own) const;
  void assumeSides(const FlowSet& set);
  void assumeKinks(const FlowSet& set);
  void takeKinkSides(AlongStep& along, double ofPassing) const;
  bool staysOnSides(const FlowSet& set, const Box& box) const;
  double longestOnSides(double h) const;
  bool loadRates(JumpRates& rates, const FlowSet& set, double h, const std::vector<JumpBound>& bounds,
                 const std::vector<double>& tube);
  AlongStep* pressures(const FlowSet& set, double h, const std::vector<double>& tube);
  double longestPressed(const FlowSet& set, double h, const std::vector<double>& tube);
  bool areHeld(const std::vector<JumpBound>& bounds) const;
  double longestHeld(const JumpRates& rates, double h) const;
  std::vector<double> withLow(std::vector<double> tube) const;
  HeldSigns* heldSignsFor(const std::vector<char>& held);
  std::optional<std::vector<Interval>> signsBeside(const std::vector<JumpBound>& bounds) const;
  HeldSigns* heldTogether(const FlowSet& set, double h, const std::vector<double>& tube);
  bool areTogether(const HeldSigns& together, const std::vector<char>& held, double from, double to,
                   std::size_t but = none) const;
  void noteOther(const HeldSigns& together, std::size_t jump, double seconds);
  double longestTogether(const HeldSigns& together, double h) const;
  void giveTogether(const HeldSigns& together, double until, std::vector<JumpBound>& bounds) const;
  void leaveTogether(const FlowSet& set, const std::vector<Interval>& start, const std::vector<JumpBound>& bounds);
  bool leavesTogether(const FlowSet& set, double h);
  void letGo(const FlowSet& set, const std::vector<JumpBound>& bounds);
  FlowTurn* turnFor(std::size_t jump, double side, TurnKind kind);
  FlowTurn* passageFor(std::size_t kink, double side);
  Look lookAtRelease(const FlowSet& set, double& h, double smallest);
  Look lookAtSurface(const FlowSet& set, double& h, double smallest);
  bool mayPassAsTurn(std::size_t kink) const;
  void findKinksThatJump();
  Look lookAtPassage(const FlowSet& set, double& h, double smallest);
  /// How much longer than until the last turns a step is, in times of what there is between first and last: all are
  /// known to have turned, then.
  double shareOfSpread() const { return stops_ ? 0.125 : 0.25; }
  std::optional<Look> timeTurn(FlowTurn& of, double& h, double smallest, Interval& moments);
  Look lookAtTurn(const FlowSet& set, double& h, double smallest, StepTurn turn, const std::vector<Interval>& signs);
  Look takeTurn(const FlowSet& set, double& h, double smallest, StepTurn turn, const std::vector<Interval>& signs);
  void holdBeside(const std::vector<char>& held);
  bool pressBeside(const FlowSet& set, const StepTurn& turn);
  bool holdUntilTurned(const FlowSet& set, const StepTurn& turn);
  Interval onceTurned(const AlongStep& along, int output, const StepTurn& turn) const;
  bool stayOnceTurned(const FlowSet& set, StepTurn& turn, const std::vector<double>& states,
                      const std::vector<double>& tube);
  bool holdOnceTurned(const FlowSet& set, const StepTurn& turn, const std::vector<double>& states,
                      const std::vector<double>& tube);
  std::vector<double> statesWith(const StepTurn& turn) const;
  std::vector<double> statesSince(const StepTurn& turn) const;
  void followOnceTurned(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn);
  bool describeSince(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn);
  bool describeInStep(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn);
  static double lagOf(double away, double h) { return std::max(2 * away, 0x1p-8 * h); }
  void describeLeap(StepTurn& turn, const std::vector<BoundedPolynomial>& guard) const;
  bool describeTurn(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn);
  std::vector<BoundedPolynomial> guardOfFrame(const StepTurn& turn) const;
  void boundSoon(StepTurn& turn, const std::vector<Interval>& J, const std::vector<double>& before,
                 const std::vector<double>& rest, const std::vector<double>& slack);
  bool turnFrameWith(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn);
  std::pair<double, double> valueOfFrame(std::size_t i, std::size_t j, double sigma) const;
  double variationOfFrame(std::size_t i, std::size_t j, double middle, double span) const;
  std::vector<double> jumpAtMoment(const StepTurn& turn, const std::vector<double>& before) const;
  std::vector<double> restOfFrame(const StepTurn& turn, const std::vector<Interval>& J, double longest) const;
  struct TurnProof;
  bool boundDefect(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn, TurnProof& proof,
                   double& relativeDefect);
  void meetDerivatives(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn,
                       const std::vector<double>& most, bool isFirst, TurnProof& proof);
  bool boundOnceTurned(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn, TurnProof& proof);
  bool isTurnLost(const StepTurn& turn, const TurnProof& proof);
  bool isTurnInTube(const StepTurn& turn, const TurnProof& proof);
  std::vector<double> tubeOnceTurned(StepTurn& turn, const TurnProof& proof);
  bool proveTurn(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn, double& relativeDefect);
  void addTurn(double tau, FlowPoint& point, const Interval& moments) const;
  /// What comes to be held, |u - ũ| ≤ g on a chord from its first to its last number, with the state that it decides.
  struct Arrival {
    const LinearForm* form;
    double begin, end;
  };
  std::optional<Arrival> arrivalOf(const FlowSet& set, const LinearForm& form, const JumpBound& bound) const;
  void boundArrivals(const FlowSet& set);
  bool isZeroBehind(const LinearForm& form) const;
  std::vector<Interval> argumentsBehind(bool onceTurned = false) const;
  template <class Visit>
  void forEachKnown(Visit visit) const;
  template <class Of>
  std::vector<SignCases> signs(std::size_t count, Of of) const;
  void giveTurning(const Interval& seconds, std::vector<SignCases>& signs) const;
  bool isNarrower(const LinearForm& form, const JumpBound& bound, const Interval& u, const FlowPoint& point) const;
  void takeArgument(const FlowSet& set, const LinearForm& form, const Interval& u, FlowPoint& point) const;
  void narrowArguments(const FlowSet& set, double tau, FlowPoint& point, std::optional<Interval> moments,
                       bool onceTurned = false) const;
  std::vector<double> symbolMass(std::vector<double>& byGrade) const;
  template <class F>
  void countAsGenerators(F f) {
    const std::uint64_t from = Work::counted();
    f();
    ofGenerators_ += static_cast<double>(Work::counted() - from);
  }

  int n_, m_;
  int pushes_;  // outputs of the motion that are ∂f/∂(a sign)
  double tolerance_;
  PolynomialSeries series_;
  FlowGrowth growth_;
  FlowInputs inputs_;
  double h0_ = 0, h_ = 0, theta_ = 0;
  StepLosses lost_;
  StepAssumptions assumed_;
  StepCourse course_;
  double caution_ = 1;
  std::vector<std::string> names_;
  std::shared_ptr<const FlowScales> scales_;
  const FlowJumps* of_ = nullptr;                    // without any held
  std::optional<JumpBounder> own_, holding_;         // of the stepper's own jumps; of those of which some are held
  std::vector<char> held_, stillHeld_;               // of each of these; none: none
  std::vector<int> left_;                            // of each of these, which own jump it is; -1: none
  std::vector<double> factor_;                       // its argument is that one's, times this
  std::vector<JumpBound> ownBounds_, heldBounds_;    // over the step; none: nothing is known
  std::unique_ptr<JumpRates> ownRates_, heldRates_;  // likewise
  std::map<std::vector<char>, std::unique_ptr<HeldSigns>> heldSigns_;  // once needed; null where there are none
  std::unique_ptr<AlongStep> pressures_;                               // of pairs that may rest; once needed
  std::map<std::pair<int, bool>, AlongStep> heldPushes_;               // of own jumps, from above or not; once needed
  double length_ = 0, resolution_ = 0;                                 // of time, s
  std::unique_ptr<FlowKinks> kinks_;                                   // null: there are none
  std::vector<char> kinksThatJump_;                                    // of each, whether a jump has its surface
  std::unique_ptr<AlongStep> curves_;                                  // FlowKinks::curvesAlong; once needed
  TimeKinks timeKinks_;
  std::vector<Interval> kinkRates_;  // over the step
  std::vector<StepCrossing> crossings_;
  // Of jumps held, by the side to which they let go (above or not), and of own ones, by that from which solutions come;
  // once needed, null where there is none.
  std::map<std::tuple<std::size_t, bool, TurnKind>, std::unique_ptr<FlowTurn>> turns_;
  std::map<std::pair<std::size_t, bool>, std::unique_ptr<FlowTurn>> passages_;  // of kinks, from above or not
  std::optional<StepTurn> turn_;                                                // of this step
  std::vector<double> heldTube_;                                                // before it
  bool mayStop_ = false, mayStopEarly_ = false, stops_ = false;
  BoundedPolynomial meeting_;  // when solutions are nearest to each other, in units of σ
  const std::vector<char> nothingHeld_ = {};
  std::vector<double> crossed_;  // like e1_, if what these do is known
  FlowGrowth following_;         // of the states but those that arrivals decide
  std::vector<char> arrives_;    // of each state, whether one decides it; none: there are none
  std::vector<double> bent_;     // of each state, how far what arrivals do rises above its chord
  bool areSidesClear_ = true;    // by intervals
  FlowCause why_;
  std::string obstacle_;                 // of the last attempt
  std::vector<SeriesError> delta_, nu_;  // of x̃ and of a column of Ψ̃
  std::vector<double> start_, E_, y_, e1_, epsilon_, inTime_, scale_, floor_;
  std::vector<double> pace_;   // of a state, what is less sets no pace
  std::vector<double> least_;  // the floor, or what counts of the state's size over the motion, if that is more
  std::vector<double> total_, errors_;            // R + Σ_j |Γ_j| of the set being stepped; without inputs
  std::vector<double> looseAtStart_;              // its W
  std::vector<double> driven_;                    // what inputs do to a state within the step, at most
  std::vector<double> second_, third_, turning_;  // bounds of derivatives by σ: p'' and the next, Ψ''(r + Γs)
  FlowPoint end_;
  double certified_ = 0;         // work of the step's certificate, without that for generators
  double ofGenerators_ = 0;      // work for generators, since the certificate was begun
  std::vector<double> carried_;  // generators at the step's end
};

}  // namespace gamut
