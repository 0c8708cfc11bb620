// The validated flow: encloses every solution of ẋ = f(t, x, p) for all initial values and parameters in a box.
//
//     Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = x[1]; dx[1] = -sin(x[0]); });
//     Tube tube = Flow(f).enclose({Interval(0.9, 1.1), 0.0}, 10.0, {1.0, 5.0, 10.0});
//     tube.at(5.0)[0];    // an Interval that contains x[0](5 s) for every start in the box
//
// The set is kept as polynomials in the uncertain quantities plus a remainder whose directions depend on them; every
// step is computed in floating point and certified afterwards. Method, theorems and bounds: docs/flow.md.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "analyses/flow/cause.hpp"
#include "analyses/flow/models.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"
#include "scalars/program/resting.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

class Checkpoints;
class Communicator;

/// An input: a parameter that varies in time within its interval of the box, in any measurable way. The enclosures hold
/// every absolutely continuous solution of ẋ = f(t, x, p(t)) almost everywhere (of the differential inclusion).
struct VaryingParameter {
  int parameter = 0;                                      ///< its number among the parameters
  double rate = std::numeric_limits<double>::infinity();  ///< bound of |ṗ|, per s, where there is one
};

/// A component of the box that is known beyond double precision: |value - (high + low)| ≤ radius. Where the whole box
/// is thin the enclosures know it so; elsewhere the box alone counts.
struct PreciseValue {
  int component = 0;  ///< initial values first, then parameters
  double high = 0, low = 0, radius = 0;
};

/// Values y = a(t, x, p) that are looked at besides, at some of the output times: proved, but nothing that a flow does
/// depends on them.
struct FlowAside {
  Program values;             ///< of the flow's states and parameters; without outputs: none
  std::vector<double> times;  ///< s, rising; those that are no output times do not count
};

/// Options of a flow; the defaults choose for themselves. One says how tight the enclosure is to be, from which the
/// others follow.
struct FlowOptions {
  double tightness = 1.02;  ///< overestimation aimed at: what the remainder may add to the width of an output (without
                            ///< outputs: of a state) at the output times is the part above 1
  int order = 0;            ///< in time: Taylor coefficients kept a step (4 … 30); 0: by the tolerance
  int degree = -1;          ///< of the polynomials in the uncertain quantities; -1: adapted on the way
  int frameDegree = -1;     ///< of the remainder's directions; -1: by the number of uncertain quantities
  double tolerance = 0;    ///< truncation error in time aimed at in a step, relative to the state; 0: by tightness, box
                           ///< and number of uncertain quantities
  bool split = true;       ///< bisect the box where one piece cannot be followed tightly
  double splitDefect = 0;  ///< raise the degree or bisect where the truncation defect per second exceeds this
                           ///< fraction of the box's relative width, at first: it is adapted to `tightness`;
                           ///< 0: by the number of uncertain quantities
  int maxPieces = 2000;    ///< give up beyond this many pieces
  double maxWidth = std::numeric_limits<double>::infinity();  ///< end when an enclosure of a state becomes wider
  double budget = std::numeric_limits<double>::infinity();    ///< s of counted work (work.hpp); when it is spent, what
                                                              ///< was proved until then is the result, on any machine
  double planned = std::numeric_limits<double>::infinity();   ///< likewise; no round of pieces that are not bisected
                                                              ///< on the way is begun that is expected to need more
  double levelBudget = std::numeric_limits<double>::infinity();  ///< the same, of all sub-boxes' own flows; or, if that
  double levelShare = 0;                                         ///< is more, this part of the whole box's work
  double longestStep = std::numeric_limits<double>::infinity();  ///< s; between output times, outputs that depend on
                                                                 ///< time itself are followed as far as a step
  double enough = 0;  ///< rounds end once one came to the horizon and is looser by no more than this part of a width
  int jobs = 1;       ///< threads that follow pieces
  std::vector<VaryingParameter> varying;  ///< all other parameters are constant in time
  std::vector<PreciseValue> precise;      ///< each within its component of the box
  std::vector<int> remainders;            ///< initial values that are narrow beside what they are added to: carried as
                                          ///< rounding is
  std::vector<RestingPair> rests;         ///< where solutions may come to rest by ever shorter turns
  FlowAside aside;                        ///< for Tube::asides
  bool dropsUnneeded = false;   ///< states that neither outputs nor what is looked at besides depend on stay at their
                                ///< initial values: Tube::states encloses nothing of them
  std::vector<int> modelled;    ///< outputs of which models are kept, at output times and between, for Tube::models
  std::vector<int> modelledAt;  ///< behind these in the snapshots of output times: models at these times alone
  std::vector<std::size_t> firstAt;  ///< rows of Tube::times() at which the latter are kept first of all, rising
  double thinAtBytes = 1e9;          ///< where the latter take more, they are kept at every second, fourth, ... output
                                     ///< time alone, counted from the last, and at those
  double modelAtBytes = 1e9;         ///< that they may take at last; of more, none are kept
  double modelBytes = 1e9;           ///< that the former may take; of more, none are kept
  std::vector<std::size_t> extremesAt;  ///< rows of Tube::times() for Tube::extremes(), rising
  std::vector<int> uncounted;           ///< outputs that need not be as tight as `tightness` says
  std::vector<double> tightnessOf;      ///< one an output, in place of `tightness`; or none
  std::vector<double> floors;  ///< one an output: what is left over of it up to this counts for nothing; or none
  /// One an output: wider than this its enclosure says nothing, and the flow ends; without, a million times the size
  /// that a state has had, of one that was once known to within that size.
  std::vector<double> mostWidth;
  std::vector<std::string> stateNames;   ///< for Tube::why() and shortfall(); without them "state 0", "state 1", ...
  std::vector<std::string> outputNames;  ///< likewise
  std::function<void(double)> progress;  ///< called with the fraction done (0 … 1), from any thread
  const std::atomic<bool>* cancelled = nullptr;  ///< set from outside to end early; what was proved is kept
  Checkpoints* checkpoints = nullptr;            ///< what the computation remembers of itself, if anything
  Communicator* communicator = nullptr;          ///< of the ranks that share it out, if any
};

/// Enclosures of all solutions that start in a box. Times are those asked for, and the horizon.
class Tube {
 public:
  /// One enclosure a state at `time` if it is an output time; otherwise over the output interval that contains it.
  /// Throws std::out_of_range beyond `reached()`.
  const std::vector<Interval>& at(double time) const;
  /// Proved up to here (s): the horizon, or the last time before the flow ended early.
  double reached() const { return reached_; }
  /// Why it ended before the horizon: at which time, which state, whether that grows without bound, is not known well
  /// enough any more, or what else could not be proved. `interrupted` if `cancelled` was set before, `outOfMemory` if a
  /// request for memory failed. Empty if it did not end early.
  const std::string& why() const { return why_; }
  static constexpr const char* interrupted = FlowCause::interrupted;
  static constexpr const char* outOfMemory = FlowCause::outOfMemory;
  static constexpr const char* overBudget = FlowCause::overBudget;
  /// Whether it ended early for one of these three, not for the motion's sake.
  bool wasStopped() const { return cause_.isStop(); }
  /// The cause of an early end, of which why() is the sentence.
  const FlowCause& cause() const { return cause_; }
  /// Overestimation at the output times that were reached: 1 + the greatest part that remainders (and ranges not found
  /// to the end) add to the width of an output (without outputs: of a state). Of what plain intervals bound it is what
  /// they add to what the output is at some values of the quantities. Of what comes to a jump's surface or leaves it,
  /// of what is known far better than the box or than at other times (invariants among them), and without uncertain
  /// quantities, nothing is measured.
  double tightness() const;
  /// Where that is more than was asked for: "at 2 s state 1 may be 1.13 times as wide as necessary". Empty otherwise.
  const std::string& shortfall() const { return shortfall_; }
  /// Why no run became tighter then: which limit it met, `interrupted` and its like among them.
  std::string limit() const { return limit_.sentence(); }
  const FlowCause& limitCause() const { return limit_; }

  /// Output times, rising, the start 0 first.
  const std::vector<double>& times() const { return times_; }
  /// Number of output times that were reached: rows 0 … reachedTimes()-1 below exist.
  std::size_t reachedTimes() const { return states_.size(); }
  /// States at times()[i], but for those that FlowOptions::dropsUnneeded drops.
  const std::vector<Interval>& states(std::size_t i) const { return states_[i]; }
  /// States over the whole interval [times()[i-1], times()[i]]; for i = 0 those at the start.
  const std::vector<Interval>& statesOver(std::size_t i) const { return statesOver_[i]; }
  /// Outputs y = g(t, x, p) at times()[i]; empty without an output program.
  const std::vector<Interval>& outputs(std::size_t i) const { return outputs_[i]; }
  /// Outputs over the whole interval [times()[i-1], times()[i]].
  const std::vector<Interval>& outputsOver(std::size_t i) const { return outputsOver_[i]; }
  /// Values looked at besides at times()[i]; empty at times that FlowAside does not name.
  const std::vector<Interval>& asides(std::size_t i) const { return asides_[i]; }
  /// Outputs at times()[i] when the uncertain quantities are confined to sub-box `level` (nested: intersected).
  const std::vector<Interval>& cut(std::size_t level, std::size_t i) const { return cuts_[level][i]; }

  /// Outputs as functions of the uncertain quantities, of FlowOptions::modelled, of the tightest run; of inputs with a
  /// bounded rate, without heed to that. Null if none are asked for, or kept.
  const std::shared_ptr<const FlowModels>& models() const { return models_; }

  /// [time][output]; empty at times that FlowOptions::extremesAt does not name.
  const std::vector<std::vector<OutputExtremes>>& extremes() const { return extremes_; }

  /// Of each component of the box, how much of what a state varies by is in terms of more than the first order that
  /// hold it, at most: what asks for high degrees and for bisection. Empty where no piece was followed.
  const std::vector<double>& nonlinear() const { return nonlinear_; }

  int pieces() const { return pieces_; }            ///< sub-boxes followed to the end
  long steps() const { return steps_; }             ///< steps of all pieces
  double cpuSeconds() const { return cpu_; }        ///< s, all threads, without the sub-boxes' ranges
  double cutCpuSeconds() const { return cutCpu_; }  ///< s, for the ranges over sub-boxes
  double levelWork() const { return levelWork_; }   ///< of their own flows (work.hpp)

 private:
  friend class FlowRun;
  friend class PolygonTube;
  std::vector<double> times_;
  std::vector<std::vector<Interval>> states_, statesOver_, outputs_, outputsOver_, asides_;
  std::vector<std::vector<std::vector<Interval>>> cuts_;
  std::vector<std::vector<double>> excess_;  // tightness() - 1 of each, [time][output or state]
  std::shared_ptr<const FlowModels> models_;
  std::vector<std::vector<OutputExtremes>> extremes_;
  std::vector<double> nonlinear_;
  double reached_ = 0;
  std::string why_, shortfall_;
  FlowCause cause_, limit_;
  int pieces_ = 0;
  long steps_ = 0;
  double cpu_ = 0, cutCpu_ = 0, levelWork_ = 0;
};

/// The flow of ẋ = f(t, x, p).
class Flow {
 public:
  /// f: one output a state. Throws std::invalid_argument if the program's shape or the options make no sense.
  explicit Flow(Program f, FlowOptions options = {});
  /// With outputs y = g(t, x, p): g has the states and parameters of f.
  Flow(Program f, Program g, FlowOptions options = {});
  ~Flow();
  Flow(Flow&&) noexcept;
  Flow& operator=(Flow&&) noexcept;

  /// box: the n initial values, then the k parameters; thin ones included. horizon > 0 and output times in [0,
  /// horizon], rising, in s. levels: boxes inside `box`, each inside the one before, for Tube::cut.
  /// Throws std::invalid_argument, saying which argument makes no sense, and std::runtime_error if this thread does not
  /// round to nearest.
  Tube enclose(const Box& box, double horizon, const std::vector<double>& outputTimes = {},
               const std::vector<Box>& levels = {}) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

/// Range of y = g(t, x, p) over a box (states, then parameters) by polynomials in the uncertain quantities; result[0]
/// is over the box, result[i] over levels[i-1] (each inside the one before). degree -1: chosen by the number of
/// quantities. `remainders`: components that are narrow beside what they are added to, as in FlowOptions. Empty if
/// `cancelled` was set before all was found.
std::vector<std::vector<Interval>> encloseImage(const Program& g, double t, const Box& box,
                                                const std::vector<Box>& levels = {}, int degree = -1,
                                                const std::atomic<bool>* cancelled = nullptr,
                                                const std::vector<int>& remainders = {});

/// Models of these outputs of the image over the box, at the one time t. Null if `cancelled` was set before.
std::shared_ptr<const FlowModels> modelImage(const Program& g, double t, const Box& box,
                                             const std::vector<int>& modelled, int degree = -1,
                                             const std::atomic<bool>* cancelled = nullptr,
                                             const std::vector<int>& remainders = {});

}  // namespace gamut
