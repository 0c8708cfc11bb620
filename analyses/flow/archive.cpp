// Member by member, in the order in which they are declared.
#include "analyses/flow/archive.hpp"

#include <utility>

#include "analyses/flow/run.hpp"
#include "analyses/flow/tightened_models.hpp"

namespace gamut {

/// Symbols by their weights, and the degree: the tables follow from these.
void archive(Archive& all, Monomials& monomials) {
  std::vector<int> weights;
  for (int l = 0; l < monomials.symbols(); ++l) weights.push_back(monomials.weight(l));
  int degree = monomials.degree();
  all(weights, degree);
}

std::shared_ptr<Monomials> archived(Archive& all, const Monomials*) {
  std::vector<int> weights;
  int degree = 0;
  all(weights, degree);
  return std::make_shared<Monomials>(std::move(weights), degree);
}

void archive(Archive& all, BoundedPolynomial& polynomial) { all(polynomial.c, polynomial.error); }

void archive(Archive& all, FlowCause& cause) { all(cause.kind, cause.what, cause.number); }

void archive(Archive& all, FlowPart& part) { all(part.centre, part.half); }

void archive(Archive& all, OutputModel& model) { all(model.c, model.radius, model.bound); }

void archive(Archive& all, FlowSnapshot& snapshot) {
  all(snapshot.time, snapshot.part, snapshot.monomials, snapshot.outputs, snapshot.path);
}

void archive(Archive& all, FlowChord& chord) { all(chord.part, chord.before, chord.behind, chord.sag, chord.bound); }

void archive(Archive& all, FlowSymbol& symbol) { all(symbol.centre, symbol.half, symbol.symbol); }

void archive(Archive& all, FlowModels& models) {
  all(models.components, models.symbols, models.modelled, models.areAlternatives, models.at, models.over);
}

void archive(Archive& all, OutputExtremes& extremes) {
  all(extremes.least, extremes.greatest, extremes.leastAt, extremes.greatestAt);
}

void archive(Archive& all, FlowSet& set) {
  all(set.t, set.p, set.low, set.C, set.R, set.W, set.powers, set.generators, set.inputs, set.inputsOfXi,
      set.parameters, set.centre, set.half, set.units, set.first, set.largest, set.arguments, set.ahead,
      set.unsettledUntil, set.unsettled, set.slideStep, set.hasSlid, set.nextStep, set.freeStep, set.dampedStep,
      set.caution);
}

void archive(Archive& all, FlowPiece::Known& known) { all(known.states, known.outputs); }

void archive(Archive& all, FlowPiece& piece) {
  all(piece.set, piece.layout, piece.next, piece.isPlaced, piece.last, piece.over, piece.lastOutputs, piece.overOutputs,
      piece.lastRadii, piece.lastModel, piece.modelled, piece.size, piece.wasKnown, piece.path, piece.timeError,
      piece.truncation, piece.tops, piece.refusedAt, piece.sinceRaised, piece.patience, piece.wasLowered,
      piece.isTurnLost, piece.hasTurned, piece.sinceTurned, piece.hasJustTurned, piece.fewer, piece.inFull,
      piece.looseRows, piece.mayPart, piece.known);
}

void archive(Archive& all, FlowCollected& collected) {
  all(collected.states, collected.statesOver, collected.outputs, collected.outputsOver, collected.asides,
      collected.outputsOfWhole, collected.reached, collected.cuts, collected.stateCore, collected.outputCore,
      collected.extremes, collected.models, collected.chords, collected.influence, collected.unproved,
      collected.narrowing, collected.metThreshold, collected.slideLoss, collected.steps, collected.cpu,
      collected.cutCpu);
}

void TightenedModels::archive(Archive& all) { all(models_, tightness_, firstTightness_, firstWork_, isWorkDone_); }

void TopGrades::archive(Archive& all) { all(variation_, high_, low_, halved_, quartered_); }

void FlowRun::archive(Archive& all, Tube& tube) {
  all(tube.times_, tube.states_, tube.statesOver_, tube.outputs_, tube.outputsOver_, tube.asides_, tube.cuts_,
      tube.excess_, tube.models_, tube.extremes_, tube.nonlinear_, tube.reached_, tube.why_, tube.shortfall_,
      tube.cause_, tube.limit_, tube.pieces_, tube.steps_, tube.cpu_, tube.cutCpu_, tube.levelWork_);
}

/// What is asked of a run once it has ended, and what it needs to go on.
void FlowRun::archiveFindings(Archive& all) {
  bool isAbandoned = isAbandoned_, areAlternatives = areAlternatives_;
  all(task_.budget.limit, task_.budget.spent, pieces_, mostPieces_, nextProbe_, ended_, endedAt_, degree_,
      outputDegree_, looseness_, timeShare_, metThreshold_, slideLoss_, timeError_, truncation_, influence_, tops_,
      needsDegree_, isOfOutputs_, ofPolynomials_, ofWhole_, reachedByOutputs_, narrowing_, isAbandoned,
      areAlternatives);
  isAbandoned_ = isAbandoned;
  areAlternatives_ = areAlternatives;
}

/// Between two turns. What threads have gathered becomes one.
void FlowRun::archiveState(Archive& all) {
  for (const FlowLayout& layout : task_.layouts) all.share(layout.monomials);  // some look whether they are the same
  archiveFindings(all);
  std::uint64_t modelBytes = modelBytes_, modelAtBytes = modelAtBytes_;
  all(sliceEnd_, overBudget_, everyModelAt_, keepsModelsAt_, modelBytes, modelAtBytes, failedAt_, unfinished_, cause_,
      failed_, work_);
  modelBytes_ = modelBytes;
  modelAtBytes_ = modelAtBytes;
  std::size_t pieces = all_.size(), parts = collected_.size();
  all(pieces, parts);
  all_.resize(pieces);
  for (Traveller& traveller : all_) all(traveller.piece);
  if (!all.isReading()) {
    for (FlowCollected& part : collected_) all(part);
    return;
  }
  for (std::size_t i = 0; i < parts; ++i) {
    FlowCollected part(task_.times.size(), task_.levels.size());
    all(part);
    collected_.front().join(std::move(part));
  }
}

}  // namespace gamut
