// What a step contributes to the tube: enclosures at the output times, and, between them, chords.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "analyses/flow/journey.hpp"
#include "analyses/flow/run.hpp"

namespace gamut {

namespace {

/// Bounds that are known besides are taken into account, in the core too where that leaves anything.
void meet(std::vector<Interval>& bounds, std::vector<Interval>& core, const std::vector<Interval>& known) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    bounds[i] = intersection(bounds[i], known[i]);
    if (const Interval both = intersection(core[i], bounds[i]); !isEmpty(both)) core[i] = both;
  }
}

}  // namespace

/// One step, from output time to output time and from chord to chord. Chords are those of what the step itself bounds:
/// what is known of jumps besides holds at single times.
class FlowFollower::Recording {
 public:
  Recording(FlowFollower& follower, FlowPiece& piece)
      : f_(follower),
        piece_(piece),
        stepper_(follower.tool_->stepper),
        t0_(piece.set.t),
        t1_(std::min(t0_ + stepper_.h(), follower.task_.horizon)),
        from_(t0_),
        loadedTo_(t0_),
        length_(0.5 * (t1_ - t0_)) {}

  /// False if the piece has grown too wide.
  bool record() {
    if (piece_.last.empty()) recordStart();
    begin();
    for (; piece_.next < times().size() && times()[piece_.next] <= t1_; ++piece_.next) {
      partUntil(times()[piece_.next]);
      recordOutputTime();
    }
    if (from_ < t1_) {
      partUntil(t1_);
      endPart(t1_);
    }
    return f_.isNarrowEnough(piece_, t1_, end_.states, end_.outputs);
  }

 private:
  /// What is known at one moment.
  struct Moment {
    std::vector<Interval> states, outputs, limits;  // limits: of outputs, on both sides where they jump
    std::shared_ptr<FlowSnapshot> model;
  };

  const std::vector<double>& times() const { return f_.task_.times; }
  bool isModelled() const { return !f_.task_.options.modelled.empty(); }
  bool hasOutputs() const { return f_.outputs_ != nullptr; }

  void recordStart() {
    std::vector<Interval> outputs;
    f_.extremes_.resize(f_.extremesAt(0));
    f_.enclose(piece_, 0.0, piece_.last, outputs);
    f_.lookAtLoose(piece_, 0, outputs);
    if (f_.signs_ == 0) joinHulls(f_.collected_.outputCore[0], f_.outputCore_);
    f_.takeExtremes(0);
    piece_.lastOutputs = f_.outputLimits_;
    piece_.lastRadii = f_.radii();
    piece_.lastModel = f_.modelOutputs(piece_, f_.outputLimits_, 0);
    FlowCollected& collected = f_.collected_;
    if (piece_.lastModel) collected.models[0].push_back(piece_.lastModel);
    for (std::size_t i = 0; i < piece_.last.size(); ++i) piece_.last[i] = intersection(piece_.last[i], f_.task_.box[i]);
    joinHulls(collected.states[0], piece_.last);
    joinHulls(collected.statesOver[0], piece_.last);
    joinHulls(collected.outputs[0], outputs);
    joinHulls(collected.outputsOver[0], outputs);
    f_.encloseLevels(piece_, 0);
    f_.lookAside(piece_, 0, piece_.last);
    piece_.over = piece_.last;
    piece_.overOutputs = outputs;
    piece_.next = 1;
  }

  void begin() {
    before_ = {piece_.last, {}, piece_.lastOutputs, piece_.lastModel};
    f_.between_ = nullptr;
    if (!hasOutputs() || f_.signs_ == 0 || !stepper_.narrows()) return;
    // A sign may be another from here on than it was until now.
    f_.enclose(piece_, 0.0, behind_.states, behind_.outputs, false);
    before_.limits = f_.outputLimits_;
    before_.model = f_.modelOutputs(piece_, before_.limits);
    piece_.lastRadii = f_.radii();
    turning_ = f_.turns(t1_ - t0_);
  }

  // ---- Chords -------------------------------------------------------------------------------------------------------

  /// From `from_` to `to`, where `end_` is known: the chord's hull, and how far a motion leaves a chord.
  void segment(double to) {
    if (stepper_.narrows()) {
      const std::vector<Interval> core = f_.stateCore_, outputCore = f_.outputCore_;  // of the end
      f_.enclose(piece_, to - t0_, behind_.states, behind_.outputs, false);
      f_.stateCore_ = core;
      f_.outputCore_ = outputCore;
      behind_.limits = f_.outputLimits_;
      behind_.model = f_.modelOutputs(piece_, behind_.limits);
    } else {
      behind_.states = end_.states;
      behind_.limits = end_.limits;
      behind_.model = end_.model;
    }
    const std::vector<Interval> between = statesBetween(to);
    if (hasOutputs()) outputsBetween(to, between);
    before_.states = behind_.states;
    before_.limits = behind_.limits;
    before_.model = behind_.model;
    piece_.last = end_.states;
    piece_.lastOutputs = end_.limits;
    piece_.lastRadii = f_.radii();
    piece_.lastModel = end_.model;
    from_ = to;
  }

  std::vector<Interval> statesBetween(double to) {
    stepper_.sag(from_ - t0_, to - t0_, f_.sag_);
    std::vector<Interval> between;
    for (std::size_t i = 0; i < behind_.states.size(); ++i)
      between.push_back(overChord(before_.states[i], behind_.states[i], f_.sag_[i]));
    if (stepper_.narrows()) stepper_.narrowOver(between);
    for (std::size_t i = 0; i < between.size(); ++i) piece_.over[i] = hull(piece_.over[i], between[i]);
    return between;
  }

  void outputsBetween(double to, const std::vector<Interval>& states) {
    f_.giveSigns(piece_, stepper_.signsOver(f_.signs_));
    f_.outputTool_->chords->sag(from_ - t0_, to - t0_, f_.sag_);
    const bool knowsMore = f_.knowsMoreByBoxes();
    f_.findBoxes(t0_, Interval(from_, to), states);
    std::vector<Interval> overs;
    for (std::size_t i = 0; i < behind_.limits.size(); ++i) {
      Interval over =
          stepper_.isUnsettled() ? Interval::entire() : overChord(before_.limits[i], behind_.limits[i], f_.sag_[i]);
      if (knowsMore || !isBounded(over)) {
        const Interval wherever = f_.overBoxes(static_cast<int>(i));
        over = isBounded(over) ? intersection(over, wherever) : wherever;
      }
      piece_.overOutputs[i] = hull(piece_.overOutputs[i], over);
      overs.push_back(over);
    }
    if (!before_.model || !behind_.model || piece_.next >= times().size() || !isModelled()) return;
    FlowChord chord{{piece_.set.centre, piece_.set.half}, before_.model, behind_.model, {}, {}};
    for (const int o : f_.task_.options.modelled) {
      chord.sag.push_back(stepper_.isUnsettled() ? Interval::entire() : f_.sag_[o].whole());
      chord.bound.push_back(overs[o]);
    }
    f_.run_.countChord();
    f_.collected_.chords[piece_.next].push_back(std::move(chord));
  }

  void endPart(double until) {
    f_.encloseBetween(piece_, until - t0_, end_.states, end_.outputs);
    end_.limits = f_.outputLimits_;
    end_.model = f_.modelOutputs(piece_, end_.limits);
    segment(until);
  }

  /// Further chords before `to`, where models are wanted.
  void modelUntil(double to) {
    if (!hasOutputs() || !f_.run_.keepsModels() || !before_.model || !isModelled()) return;
    const double begin = from_;
    const int parts = f_.chordsFor(piece_, before_.limits, from_ - t0_, to - t0_);
    for (int part = 1; part < parts; ++part) {
      const double until = begin + (to - begin) * part / parts;  // any double is exact enough: docs/flow.md, "Time"
      if (until > from_ && until < to) endPart(until);
    }
  }

  /// Whether chords miss an output that is known at one end of them.
  bool isLacking(const std::vector<char>& isKnown) {
    std::vector<int> open;
    for (int o = 0; o < f_.outputs_->count(); ++o)
      if (!f_.outputTool_->chords->isBounded(o)) open.push_back(o);
    if (open.empty()) return false;
    f_.enclose(piece_, loadedTo_ - t0_, end_.states, end_.outputs);
    return std::ranges::any_of(open, [&](int o) { return isKnown[o] != 0 || std::isfinite(f_.outputs_->radius(o)); });
  }

  /// What chords leave over at most of an output, as a part of what is uncertain about it, where there are kinks: over
  /// a short time fewer of these, and over less, are on both sides.
  double looseAtKinks() const {
    if (!f_.outputs_->hasKinks()) return 0;
    double most = 0;
    for (int o = 0; o < f_.outputs_->count(); ++o)
      if (f_.outputTool_->chords->isBounded(o))
        most = std::max(most, f_.outputTool_->chords->rest(o) / f_.extentOf(before_.limits[o]));
    return most;
  }

  /// Chords of the rest of the step, or of as much of it as they can be proved for: what is bounded at a moment may be
  /// so over a short time alone. What is not even then is left to plain intervals. Likewise at kinks, while it helps.
  void loadNext() {
    constexpr int enoughInVain = 12;
    constexpr double little = 0.1, helps = 0.75;
    const double least = (t1_ - t0_) / 64, leastAtKinks = (t1_ - t0_) / 8;
    double loose = std::numeric_limits<double>::infinity();
    std::vector<char> isKnown(f_.outputs_->count());
    for (int o = 0; o < f_.outputs_->count(); ++o) isKnown[o] = std::isfinite(piece_.lastRadii[o]) ? 1 : 0;
    for (length_ = std::max(2 * length_, least);; length_ *= 0.5) {
      const double until = from_ + length_;
      loadedTo_ = inVain_ < enoughInVain && from_ < until && until < t1_ ? until : t1_;
      f_.giveSigns(piece_, stepper_.signsOver(f_.signs_));
      f_.loadChords(piece_, before_.limits, from_ - t0_, loadedTo_ - t0_);
      if (inVain_ == enoughInVain) return;
      const bool lacks = isLacking(isKnown);
      const double before = std::exchange(loose, looseAtKinks());
      if (!lacks && !(length_ > leastAtKinks && loose > little && loose < helps * before)) return;
      if (!(length_ > least)) {
        inVain_ += lacks ? 1 : 0;
        return;
      }
    }
  }

  /// Lets chords reach to `to`, and, of models, as near to each other as they must be.
  void prepare(double to) {
    while (hasOutputs()) {
      if (!(loadedTo_ > from_)) loadNext();
      if (to <= loadedTo_) break;
      const double until = loadedTo_;
      modelUntil(until);
      endPart(until);
    }
    modelUntil(to);
  }

  /// A part for each way that signs are.
  void partUntil(double to) {
    for (const double turn : turning_) {
      const double until = t0_ + turn;
      if (!(until > from_ && until < to)) continue;
      prepare(until);
      endPart(until);
    }
    prepare(to);
  }

  // ---- Output times -------------------------------------------------------------------------------------------------

  /// piece_.next, up to which all is prepared.
  void recordOutputTime() {
    const std::size_t row = piece_.next;
    const double tau = times()[row] - t0_;  // exact: docs/flow.md, "Time"
    FlowCollected& collected = f_.collected_;
    f_.encloseWhileTurning(piece_, tau, ofParts_, outputsOfParts_);
    f_.extremes_.resize(f_.extremesAt(row));
    f_.enclose(piece_, tau, end_.states, end_.outputs);
    f_.lookAtLoose(piece_, row, end_.outputs);
    meet(end_.states, f_.stateCore_, ofParts_);
    meet(end_.outputs, f_.outputCore_, outputsOfParts_);
    end_.limits = f_.outputLimits_;
    end_.model = f_.modelOutputs(piece_, end_.limits, row);
    if (end_.model) collected.models[row].push_back(end_.model);
    joinHulls(collected.stateCore[row], f_.stateCore_);
    joinHulls(collected.outputCore[row], f_.outputCore_);
    f_.takeExtremes(row);
    f_.encloseLevels(piece_, row);
    f_.lookAside(piece_, row, end_.states);
    joinHulls(collected.states[row], end_.states);
    for (int o = 0; f_.symbols_ > 1 && hasOutputs() && o < f_.outputs_->count(); ++o)
      if (std::isfinite(f_.outputs_->radius(o)))
        measureInfluence(f_.outputs_->polynomial(o), *f_.outputs_->monomials(), collected.influence);
    joinHulls(collected.outputs[row], end_.outputs);
    segment(times()[row]);
    if (f_.signs_ > 0) joinHulls(piece_.overOutputs, end_.outputs);  // what a sign is at one moment alone
    joinHulls(collected.statesOver[row], piece_.over);
    joinHulls(collected.outputsOver[row], piece_.overOutputs);
    piece_.over = end_.states;
    piece_.overOutputs = end_.outputs;
  }

  FlowFollower& f_;
  FlowPiece& piece_;
  const FlowStepper& stepper_;
  double t0_, t1_;          // of the step
  double from_, loadedTo_;  // chords are known from before `from_` up to `loadedTo_`
  double length_;           // over which they were last
  int inVain_ = 0;          // so often not even over the least
  Moment before_, behind_, end_;
  std::vector<double> turning_;  // when signs turn, from the step's start
  std::vector<Interval> ofParts_, outputsOfParts_;
};

/// Adds what the step that was just certified contributes to the tube; false if the piece has grown too wide.
bool FlowFollower::record(FlowPiece& piece) { return Recording(*this, piece).record(); }

}  // namespace gamut
