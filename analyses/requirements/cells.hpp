// Parts of a box on which it is decided whether a requirement is met: bisected, the most important first, until what is
// asked is known well enough. What is known of a cell comes from a flow's models alone.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "analyses/flow/models.hpp"
#include "analyses/flow/series/polynomial_range.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// What is to be found out of models.
struct CellQuestion {
  /// At all times of the window, or at one of them at least.
  enum class When { always, eventually };

  When when = When::always;
  std::vector<int> margins;         ///< numbers of outputs in the models: met at a time where all are above zero,
  std::vector<char> isStrict;       ///< or not below zero, where this is 0; one a margin
  std::size_t from = 0, until = 0;  ///< the window: output times, both included
  std::vector<int> besides = {};    ///< symbols of no quantity: what is said holds for all that they may be
};

/// Where a cell is decided, in its own η ∈ [-1,1]^k: met where met·η + metAbove > 0, violated where violated·η +
/// violatedBelow < 0. Nothing is said where slopes are empty.
struct CellPlanes {
  std::vector<double> met, violated;
  double metAbove = 0, violatedBelow = 0;
  double rest = 0;  ///< so much of what lies between both no bisection would take away
};

/// constant + Σ f_l(η_l), of a cell's own η in [-1,1]^k.
struct CellSum {
  std::vector<std::vector<double>> f;  ///< [symbol][power], powers above 0; none: nothing is known
  double constant = 0;
};
/// Σ|coefficients| of the functions.
double sizeOf(const CellSum& sum);

/// Where some margins of an open cell are decided: all met where `met` is above zero, one violated where `violated` is
/// below zero.
struct CellSums {
  CellSum met, violated;
  std::vector<double> mixedOf;  ///< [symbol]: what of the distance between both bisections of it take away, about
  double rest = 0;              ///< what none takes away
};

/// A part of the box and what is left to be known of it.
class Cell {
 public:
  enum class Verdict { met, violated, open };

  const FlowPart& part() const { return part_; }
  Verdict verdict() const { return verdict_; }
  /// The least that a margin may be at an output time of the window where it counts: the least at all of them for
  /// `always`, the greatest for `eventually`.
  double least() const { return least_; }
  double bytes() const;

 private:
  friend class Cells;
  /// One snapshot's polynomials in the symbols of what both it and the cell cover.
  struct Local {
    const FlowSnapshot* of;
    FlowPart part;
    std::vector<std::vector<double>> c;  // [margin]
    std::vector<double> radius;
    std::vector<Interval> range;
  };
  struct Chord {
    const FlowChord* of;
    std::size_t before, behind;  // among the locals
  };
  struct Moment {
    std::vector<std::size_t> snapshots;  // of one output time, among the locals
  };

  FlowPart part_;
  Verdict verdict_ = Verdict::open;
  double least_ = 0;
  std::vector<Local> locals_;
  std::vector<Chord> chords_;
  std::vector<Moment> moments_;
};

class Cells {
 public:
  /// The models must outlive it. Throws std::invalid_argument for a window that they do not reach.
  Cells(const FlowModels& models, CellQuestion question);

  const CellQuestion& question() const { return question_; }
  /// The whole box.
  std::unique_ptr<Cell> whole();
  /// The symbols on which most depends, the first most of all; none where no bisection would help.
  std::vector<int> symbolsOf(const Cell& cell) const;
  /// Both halves in the first of these; nothing where there is none.
  std::vector<std::unique_ptr<Cell>> halves(const Cell& cell);
  /// What is known of a part of the cell.
  std::unique_ptr<Cell> within(const Cell& cell, const FlowPart& part);
  /// Of an open cell.
  CellPlanes planes(const Cell& cell) const;
  /// Of an open cell and those of the question's margins with these places (cell_sums.cpp).
  CellSums sums(const Cell& cell, const std::vector<std::size_t>& margins) const;
  /// Of one point of the box, in its symbols.
  Cell::Verdict verdictAt(const std::vector<double>& xi);
  /// The same as `within`, but ranges of polynomials are found to the end, and parts need not be nested.
  std::unique_ptr<Cell> tightlyWithin(const Cell& cell, const FlowPart& part);
  /// Points of an open cell, in the symbols of the box, where a margin is least, as far as one goes from the middle
  /// along one axis after the other; of the margins and times that are lowest.
  std::vector<std::vector<double>> lowestPoints(const Cell& cell);

 private:
  enum class Outcome { met, violated, open };
  /// A margin in a cell: constant + slope·η + [-down, up].
  struct Form {
    double constant = 0, down = 0, up = 0;
    double radius = 0;  // in `down` and `up`
    std::vector<double> slope;
  };
  /// A margin at a moment, or along a chord: above zero where Σ f_l(η_l) + from is, below where Σ f_l(η_l) + to is.
  struct Separated {
    std::vector<std::vector<double>> f;
    std::vector<double> mixedOf;        // of the terms that hold a symbol and others
    double from = 0, to = 0, rest = 0;  // the latter: no bisection takes it away
  };
  void decide(Cell& cell);
  std::optional<Separated> separated(const Cell& cell, std::size_t local, std::size_t margin,
                                     const Interval& sag) const;
  std::optional<Form> formOf(const Cell& cell, std::size_t local, std::size_t margin) const;
  struct Bounded;
  std::optional<Bounded> boundedOf(const Cell& cell, std::size_t local, std::size_t margin, const Interval& sag,
                                   CellPlanes& planes) const;
  static std::pair<std::vector<double>, double> planeBeside(const std::vector<Bounded>& margins, int sign);
  std::vector<Bounded> throughout(const Cell& cell, CellPlanes& planes) const;
  void narrow(Cell::Local& local, int l, double middle, double half) const;
  Outcome outcomeOf(const std::vector<Interval>& margins) const;
  Outcome outcomeOf(const Cell& cell, const Cell::Chord& chord) const;
  void dropUnused(Cell& cell) const;
  Interval rangeOf(const Cell::Local& local, std::size_t margin) const;
  Interval tightRangeOf(const Cell::Local& local, std::size_t margin, const Interval& known) const;
  std::vector<double> lowestPoint(const Cell::Local& local, std::size_t margin) const;
  /// What is asked of a layout's monomials again and again.
  struct Tables {
    mutable PolynomialRange range;          // a workspace too
    std::vector<char> isEven;               // in all symbols
    std::vector<int> linear;                // the symbol that it is; -1: none
    std::vector<std::vector<int>> symbols;  // that it holds
  };
  const Tables& tablesOf(const FlowSnapshot& snapshot) const;

  const FlowModels& models_;
  CellQuestion question_;
  mutable std::map<const Monomials*, std::unique_ptr<Tables>> tables_;
  bool isTight_ = false;  // at present
};

}  // namespace gamut
