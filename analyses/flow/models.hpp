// Outputs as functions of the uncertain quantities: what a flow knew of them on every part of the box, kept. From these
// follow answers for parts of the box, for a probability, for a single sample, without another flow.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "analyses/flow/series/monomials.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// A part of the box: ξ = centre + half·η, η in [-1,1]^k; exact, since its ends are multiples of some 2^-n.
struct FlowPart {
  std::vector<double> centre, half;  ///< one a symbol
};

/// Whether two parts have more than a face in common. (Their ends are multiples of some 2^-n, so that it is decided
/// exactly.)
bool meet(const FlowPart& a, const FlowPart& b);
bool isInside(const FlowPart& inner, const FlowPart& outer);

/// One output on a part: y lies in `bound`, and for every η in P(η) ± radius.
struct OutputModel {
  std::vector<double> c;  ///< of P, one a monomial, those of the highest grades left out; none: nothing but the bound
  double radius = 0;
  Interval bound;
};

/// Outputs at one time on one part (but FlowModels::areAlternatives). Its monomials may have symbols behind those of
/// the part, which no term here holds.
struct FlowSnapshot {
  double time = 0;  ///< s
  FlowPart part;
  std::shared_ptr<const Monomials> monomials;
  std::vector<OutputModel> outputs;  ///< FlowOptions::modelled; at output times that are kept, `modelledAt` behind them
  std::string path;                  ///< of the flow's piece: snapshots and chords of a time are in this order
};

/// Outputs on a part from one time to another: each in the hull of the two snapshots, whose parts hold this one, plus
/// `sag`; and in `bound`.
struct FlowChord {
  FlowPart part;
  std::shared_ptr<const FlowSnapshot> before, behind;
  std::vector<Interval> sag, bound;  ///< one an output; a sag of the whole line: the bound alone is known
};

/// How a number of the box is written in symbols: centre + half·ξ[symbol]; of one without a symbol, -1, the models hold
/// for all that it may be.
struct FlowSymbol {
  double centre = 0, half = 0;
  int symbol = -1;
};

/// Of every part of the box, at the output times that were reached and between them.
struct FlowModels {
  std::vector<FlowSymbol> components;  ///< of the box
  int symbols = 0;
  std::size_t modelled = 0;  ///< so many outputs of each snapshot of an output time count, or, where there was no room,
                             ///< the first of them alone; there may be others behind
  /// Several of a time and part: the motion is in one of them, nobody knows in which. So it is where a remainder was
  /// bisected. Else what one says of its part is so.
  bool areAlternatives = false;
  std::vector<std::vector<std::shared_ptr<const FlowSnapshot>>> at;  ///< [time]: at the time, all parts of the box
  std::vector<std::vector<FlowChord>> over;  ///< [time]: since the output time before, all parts of box and time
};

/// Where in the box an output is least and greatest at a time, as far as its polynomials tell: not proved.
struct OutputExtremes {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;  ///< that it is there, about
  std::vector<double> leastAt, greatestAt;  ///< values of the box's components; none: not known

  /// Those of both; of equal ones whichever comes first in order.
  void join(const OutputExtremes& other);
};

/// Polynomial ± radius in as few grades as cost next to nothing; what is left out counts in the radius, as do terms in
/// more than the first `symbols` symbols.
OutputModel modelOf(const double* polynomial, double radius, const Monomials& monomials, int symbols,
                    const Interval& bound);

/// About how many bytes it takes.
double bytesOf(const FlowSnapshot& snapshot);

}  // namespace gamut
