// The way of one piece of the box through time, step by step, and what it contributes to the tube on its way.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analyses/flow/outputs/asides.hpp"
#include "analyses/flow/outputs/mean_value_outputs.hpp"
#include "analyses/flow/outputs/outputs.hpp"
#include "analyses/flow/series/polynomial_range.hpp"
#include "analyses/flow/series/top_grades.hpp"
#include "analyses/flow/step/settling.hpp"
#include "analyses/flow/step/step.hpp"
#include "analyses/flow/task.hpp"
#include "analyses/workers.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

class FlowRun;

/// One sub-box on its way, with what is known at its last boundary.
struct FlowPiece {
  /// By output time.
  struct Known {
    std::vector<std::vector<Interval>> states, outputs;
  };

  FlowSet set;
  std::size_t layout = 0;                          // which monomials it uses
  std::size_t next = 0;                            // index of its next output time
  bool isPlaced = false;                           // at its start, in this layout (placeSurfaces)
  std::vector<Interval> last, over;                // states at set.t; states since the last output time
  std::vector<Interval> lastOutputs, overOutputs;  // likewise for the outputs; lastOutputs: outputLimits_
  std::vector<double> lastRadii;                   // beside polynomials of these; infinite: not known
  std::shared_ptr<FlowSnapshot> lastModel;         // of these
  std::vector<Interval> modelled;                  // of modelled outputs: all that they were so far
  std::vector<double> size;                        // the greatest that each output (or state) was, as far as is known
  std::vector<char> wasKnown;                      // and whether it was once known to within that
  std::string path;                                // which halves it is of: what pieces leave is in this order
  double timeError = 0, truncation = 0;            // of its steps
  TopGrades tops;                     // likewise, in the highest layout; where it is not bisected for these
  double refusedAt = -1;              // when it was not bisected, last
  int sinceRaised = 0, patience = 1;  // steps since its degree was raised, and to wait before it is lowered
  bool wasLowered = false;            // after the last step
  bool isTurnLost = false;            // since it turned last, by the highest degree as well
  bool hasTurned = false;             // in some step
  double sinceTurned = 0;             // s, about; or since the start
  bool hasJustTurned = false;         // its solutions each at a time of its own (FlowSet::ahead)
  std::size_t fewer = 2;              // layouts by which outputs have less than states between two output times
  std::size_t inFull = 0;             // times that chords were loaded since that was 0
  std::size_t looseRows = 0;          // output times at which an output was looser than states
  int mayPart = 0;                    // into so many parts the next of these may be put, for its bounds alone
  /// At own times, the hulls of stateCore_ and outputCore_ so far: ranges inside need not be found closely. Not of
  /// other pieces, which other threads may have followed.
  Known known;
};

/// A piece that goes on as two, if it may.
struct FlowHalves {
  FlowSet first, second;
  bool areAlternatives = false;  // of a remainder's own symbol
};

enum class FlowJourney { goesOn, bisected, ended, cancelled };

/// Everything that pieces contributed at the output times.
struct FlowCollected {
  std::vector<std::vector<Interval>> states, statesOver, outputs, outputsOver, asides;
  std::vector<std::vector<Interval>> outputsOfWhole;  // outputs, but for what parts of pieces tell
  std::vector<std::vector<Interval>> reached;         // what outputs certainly reach, but for remainders
  std::vector<std::vector<std::vector<Interval>>> cuts;
  std::vector<std::vector<Interval>> stateCore, outputCore;  // see FlowFollower; their hulls
  std::vector<std::vector<OutputExtremes>> extremes;
  std::vector<std::vector<std::shared_ptr<FlowSnapshot>>> models;  // FlowModels
  std::vector<std::vector<FlowChord>> chords;
  std::vector<Influence> influence;         // of every symbol
  bool metThreshold = false;                // a degree or bisection was wanted
  std::vector<std::vector<char>> unproved;  // of each output, whether plain intervals alone bounded it; or none
  std::vector<std::uint64_t> narrowing;     // of every symbol, how often halving it would narrow loose outputs most
  double slideLoss = 0;                     // FlowStepper's, the greatest of all steps
  long steps = 0;
  double cpu = 0, cutCpu = 0;
  FlowCollected(std::size_t times, std::size_t levels)
      : states(times),
        statesOver(times),
        outputs(times),
        outputsOver(times),
        asides(times),
        outputsOfWhole(times),
        reached(times),
        cuts(levels, std::vector<std::vector<Interval>>(times)),
        stateCore(times),
        outputCore(times),
        extremes(times),
        models(times),
        chords(times),
        unproved(times) {}

  /// Adds what another gathered.
  void join(FlowCollected&& other);
};

/// `into` becomes the hull of both, component by component; empty, it becomes `from`.
void joinHulls(std::vector<Interval>& into, const std::vector<Interval>& from);

/// Without `excess` at both ends; a point where that is more than all of it.
Interval without(const Interval& bound, double excess);

/// Follows one piece after the other. Holds the workspace: one a thread.
class FlowFollower {
 public:
  /// Halves of pieces, and why one cannot be followed, go to the run.
  FlowFollower(FlowRun& run, const FlowTask& task, FlowCollected& collected)
      : run_(run), task_(task), collected_(collected) {
    collected_.influence.resize(static_cast<std::size_t>(task.embedding.symbols));
    collected_.narrowing.resize(static_cast<std::size_t>(task.embedding.symbols));
    if (signs_ > 0) signsWithin_.emplace(task.jumps);
  }

  /// Advances `piece` to `end`, until it has done so much work, until it would rather be two (`halves`, which begin
  /// where it is), or to its failure. What ends within a step leaves the piece at the step's start; what the step had
  /// given already is proved. All of that depends on the piece alone.
  FlowJourney followWhilePossible(FlowPiece& piece, double end, double allowed);
  FlowHalves& halves() { return halves_; }

 private:
  /// The workspace for outputs in some monomials.
  struct OutputTools {
    FlowOutputs outputs;
    PolynomialRange range;
    std::unique_ptr<FlowOutputChords> chords;  // where there are fewer monomials than the states have
    bool isPrefix = false;                     // of the states' monomials, these are the first
  };
  /// The workspace of one layout, and of the motion or of that in which some of its jumps are held.
  struct Tools {
    std::unique_ptr<FlowJumps> jumps;  // where some of the motion's are held, those of what is left
    FlowStepper stepper;
    PolynomialRange range;
    Program g;        // the outputs, with the signs that are given behind the parameters
    Program besides;  // the values looked at besides, likewise
    std::vector<char> held;
    std::unique_ptr<OutputTools> outputs = nullptr;
    std::unique_ptr<FlowOutputChords> plainChords = nullptr, richChords = nullptr;  // once needed
    FlowOutputChords* chords = nullptr;                                             // of which these are loaded
    std::map<std::size_t, OutputTools> between = {};  // of layouts of fewer monomials, once needed
    std::unique_ptr<FlowAsides> asides = nullptr;     // of `besides`, once needed
    std::unique_ptr<OutputTools> onSides = nullptr;   // null: as `outputs`
    bool areSidesKnown = false;
    /// The outputs where these are held (a SignBox's); null where they cannot be held together.
    std::map<std::vector<char>, std::unique_ptr<MeanValueOutputs>> whileHeld = {};
  };

  FlowJourney follow(FlowPiece& piece, double end, double allowed);
  FlowJourney bisect(const FlowPiece& piece, int symbol, bool areAlternatives);
  std::optional<FlowJourney> insteadOfLosingTurn(FlowPiece& piece);
  std::optional<FlowJourney> insteadOfStep(FlowPiece& piece, StepOutcome outcome);
  bool advance(FlowPiece& piece, bool meets);
  StepOutcome certify(const FlowPiece& piece);
  StepOutcome certify(const FlowPiece& piece, bool stops);
  void giveSigns(const FlowPiece& piece, std::vector<SignCases> signs);
  bool knowsMoreByBoxes() const;
  void lookAt(double time);
  void findBoxes(double began, const Interval& t, const std::vector<Interval>& states);
  std::vector<double> turns(double h) const;
  Interval overBoxes(int output);
  MeanValueOutputs* outputsWhileHeld(std::vector<char> held);
  std::unique_ptr<Tools> toolsFor(const FlowPiece& piece, const std::vector<char>& held) const;
  void goOnUnlessCancelled() const;
  OutputTools outputToolsFor(const Program& g, std::size_t layout, std::size_t ofStates) const;
  std::unique_ptr<FlowOutputChords> chordsIn(const Program& g, std::size_t layout, std::size_t ofStates) const;
  enum class Settle : char { unnoticed, ratherThanBisect, surely };
  bool settle(FlowPiece& piece, Settle how);
  bool use(const FlowPiece& piece, const std::vector<char>& held);
  void useOutputsOf(Tools& tools);
  void useOutputsOfLeaving(const FlowPiece& piece);
  bool isDegreeWorthwhile(const FlowPiece& piece, StepOutcome outcome) const;
  bool isOfDroppedTerms() const;
  void changeLayout(FlowPiece& piece, std::size_t to);
  bool expand(FlowPiece& piece);
  void lowerDegree(FlowPiece& piece);
  void enclose(const FlowPiece& piece, double tau, std::vector<Interval>& states, std::vector<Interval>& outputs,
               bool narrowed = true, OutputTools* with = nullptr);
  void encloseBetween(const FlowPiece& piece, double tau, std::vector<Interval>& states,
                      std::vector<Interval>& outputs);
  void encloseWhileTurning(const FlowPiece& piece, double tau, std::vector<Interval>& states,
                           std::vector<Interval>& outputs);
  void appendOutputs(const FlowPiece& piece, const std::vector<Interval>& states, const Box& xi,
                     std::vector<Interval>& outputs);
  std::size_t extremesAt(std::size_t row) const;
  void takeExtremes(std::size_t row);
  void encloseLevels(const FlowPiece& piece, std::size_t row);
  std::shared_ptr<FlowSnapshot> modelOutputs(const FlowPiece& piece, const std::vector<Interval>& outputs,
                                             std::optional<std::size_t> row = {});
  Interval valueAt(int output, const Box& place, bool hasRest = false);
  class Reached;
  Reached reachedBy(int output);
  std::vector<double> ifKnown(const std::vector<int>& outputs);
  struct Part;
  Part wholePart() const;
  Part halfOf(const Part& part, int symbol, double middle) const;
  void lookOver(const FlowPiece& piece, const std::vector<int>& outputs, Part& part);
  class Parts;
  std::vector<int> looseOutputs(const std::vector<Interval>& bounds) const;
  void lookAtLoose(FlowPiece& piece, std::size_t row, std::vector<Interval>& bounds);
  void lookAside(const FlowPiece& piece, std::size_t row, const std::vector<Interval>& states);
  void loadChords(FlowPiece& piece, const std::vector<Interval>& before, double from, double to);
  OutputTools& toolsBetween(std::size_t layout, std::size_t ofStates);
  static double extentOf(const Interval& output);
  bool leavesOver(double times, const FlowPiece& piece, const std::vector<Interval>& outputs) const;
  std::vector<double> radii() const;
  int chordsFor(FlowPiece& piece, const std::vector<Interval>& before, double from, double to);
  class Recording;
  bool record(FlowPiece& piece);
  bool goesOwnWays(const FlowPiece& piece) const;
  bool meetsBeside(const FlowPiece& piece, StepOutcome outcome);
  struct OwnCell;
  struct OwnMoment;
  class OwnChords;
  class OwnRows;
  bool recordOwnTimes(FlowPiece& piece, bool stopsOnceTurned);
  void recordOver(FlowPiece& piece, const std::vector<std::size_t>& rows);
  OwnCell wholeCell(const FlowPiece& piece) const;
  OutputTools* outputsOnSides(const FlowPiece& piece);
  OwnCell half(const OwnCell& cell, int symbol, double middle) const;
  double locate(const FlowPiece& piece, const OwnCell& cell, const OwnMoment& when, bool hasTurned,
                FlowPoint& point) const;
  bool encloseWithin(const std::vector<BoundedPolynomial>& limits, std::size_t row, std::vector<Interval>& states);
  void appendWithin(OutputTools& tools, const FlowPiece& own, const std::vector<BoundedPolynomial>& limits,
                    std::size_t row, const std::vector<Interval>& states, std::vector<Interval>& outputs);
  void collect(const FlowPiece& piece, const OwnCell& cell, FlowPoint point, const Interval& when,
               const std::vector<BoundedPolynomial>& limits, bool hasTurned, std::size_t row);
  void endRows(FlowPiece& piece);
  bool isNarrowEnough(FlowPiece& piece, double t, const std::vector<Interval>& states,
                      const std::vector<Interval>& outputs);
  int tooWide(FlowPiece& piece, const std::vector<Interval>& states, const std::vector<Interval>& outputs) const;

  FlowRun& run_;
  const FlowTask& task_;
  FlowCollected& collected_;
  /// One a layout and jumps held, made when first needed; null where these cannot be held together.
  std::map<std::pair<std::size_t, std::vector<char>>, std::unique_ptr<Tools>> tools_;
  Tools* tool_ = nullptr;  // of the piece at hand, as are the next three
  bool hasTriedTurn_ = false, hasLostTurn_ = false, isTurnMixed_ = false;  // FlowStepper's, of the last step
  int turnSymbol_ = -1;
  std::optional<Settling> settling_;  // once needed
  Tools* outputTool_ = nullptr;       // of its outputs: that one, or of those that are held behind the step
  FlowOutputs* outputs_ = nullptr;
  PolynomialRange* outputRange_ = nullptr;  // of these
  OutputTools* between_ = nullptr;          // which do for the part of the step that chords are loaded for
  int monomialCount_ = 0, symbols_ = 0;
  FlowPoint point_;
  double at_ = 0;              // its time
  Interval signTimes_;         // when signs are looked up: then, or where each solution is in the step
  double rangeTolerance_ = 0;  // of it
  FlowHalves halves_;
  std::size_t signs_ = jumpsOf(task_.jumps.f).size();
  std::optional<SignsWithin> signsWithin_;
  std::vector<SignCases> given_;      // signs of the motion, as outputs take them at present
  std::vector<Embedded> parameters_;  // those of the piece at hand, and these
  Box parameterBox_;                  // ranges of those of the piece
  std::vector<SignBox> boxes_;
  Box whole_;
  std::vector<FlowSag> sag_;
  std::vector<Interval> outputLimits_;            // of `enclose` too: the outputs, and their limits where they jump
  std::vector<OutputExtremes> extremes_;          // of outputs that are being enclosed; none unless they are wanted
  std::vector<Interval> stateCore_, outputCore_;  // bounds of `enclose` without what remainder and range add at most
  FlowPiece::Known known_;                        // of the piece at hand
};

}  // namespace gamut
